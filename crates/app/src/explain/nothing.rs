//! A pixel that nothing covers: where all triangles are instead.

use super::report::{Block, Cell};
use super::{Scene, theory};
use crate::draw::Traced;
use crate::error::Error;
use crate::options::Cull;
use crate::scene::Model;
use alberti::Fixed;

impl Scene<'_> {
    /// The fates of the triangles, and the one that comes nearest.
    pub(super) fn nothing(&self, model: &Model, traced: &Traced) -> Result<Block, Error> {
        let title = "the background is seen";
        let mut block = Block::new("nothing", title, &[theory::EDGES]);
        let stats = traced.stats;
        let count = |n: u64| i64::try_from(n).unwrap_or(i64::MAX);
        block.value("triangles", "triangles of the model", count(stats.submitted));
        block.value("outside", "outside the view, or before or behind its planes", count(stats.dropped));
        block.value("clipped", "cut at a plane", count(stats.clipped));
        block.value("culled", "left out by their side, or without area", count(stats.culled));
        block.value("elsewhere", "drawn without this pixel", count(stats.missed + stats.drawn));
        if self.options.cull != Cull::None {
            let all = self.drawing.trace(self.pixel, alberti::Cull::None)?;
            let row = |arrival: &crate::draw::Arrival| vec![arrival.part.into(), arrival.triangle.into()];
            let rows: Vec<Vec<Cell>> = all.arrivals.iter().map(row).collect();
            if !rows.is_empty() {
                block.note("left_out", "but for --cull these would cover it:");
                block.table("culled_here", &["part", "triangle"], rows);
            }
        }
        if let Some((distance, part, triangle)) = self.nearest(model) {
            block.value("nearest", "pixels to the nearest triangle", distance);
            block.values("nearest_triangle", "its part and number", [part, triangle]);
        }
        Ok(block)
    }

    /// The distance of the nearest triangle on the screen, in pixels, with its part and its number.
    fn nearest(&self, model: &Model) -> Option<(f64, usize, usize)> {
        let one = f64::from(1 << self.drawing.subpixel().bits());
        let sample = self.pixel.map(|at| f64::from(at) + 0.5);
        let mut nearest: Option<(f64, usize, usize)> = None;
        for (number, part) in model.parts.iter().enumerate() {
            for (triangle, indices) in part.triangles.iter().enumerate() {
                self.drawing.each_place(*indices, |corners: [[Fixed; 2]; 3]| {
                    let corners = corners.map(|corner| corner.map(|x| f64::from(x.subpixels()) / one));
                    let distance = distance(corners, sample);
                    if nearest.is_none_or(|(least, ..)| distance < least) {
                        nearest = Some((distance, number, triangle));
                    }
                });
            }
        }
        nearest
    }
}

/// The distance of a place from the nearest side of a triangle that does not hold it.
fn distance([a, b, c]: [[f64; 2]; 3], place: [f64; 2]) -> f64 {
    let side = |p: [f64; 2], q: [f64; 2]| {
        let [along, to] = [[q[0] - p[0], q[1] - p[1]], [place[0] - p[0], place[1] - p[1]]];
        let square = along[0] * along[0] + along[1] * along[1];
        let t = if square > 0.0 { (along[0] * to[0] + along[1] * to[1]) / square } else { 0.0 };
        let t = t.clamp(0.0, 1.0);
        (to[0] - t * along[0]).hypot(to[1] - t * along[1])
    };
    side(a, b).min(side(b, c)).min(side(c, a))
}
