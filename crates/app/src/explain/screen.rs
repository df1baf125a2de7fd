//! The steps on the screen: facing, edges, weights, depth.

use super::report::Block;
use super::{Fragment, Scene, theory};
use crate::options::DepthFormat;
use alberti::projection::DepthSteps;
use alberti::raster::Edge;
use alberti::{AnyProjection, Projection as _};

impl Scene<'_> {
    /// All of them.
    pub(super) fn on_screen(&self, fragment: &Fragment<'_>) -> Vec<Block> {
        vec![self.facing(fragment), self.edges(fragment), self.weights(fragment), self.depth(fragment)]
    }

    fn facing(&self, fragment: &Fragment<'_>) -> Block {
        let shape = &fragment.shape;
        let mut block = Block::new("facing", "facing, by twice the signed area", &[theory::AREAS]);
        block.value("doubled_area", "area x 2, in subpixels squared", shape.area);
        let side = if shape.area < 0 {
            "the front: counter-clockwise as seen"
        } else {
            "the back: clockwise as seen"
        };
        block.value("side", "it shows", side);
        let moved = fragment.pieces.get(fragment.number).is_some_and(|piece| {
            piece
                .given
                .iter()
                .zip(&piece.drawn)
                .any(|(a, b)| (a.q, a.zs) != (b.q, b.zs) || a.varying != b.varying)
        });
        if moved {
            let text = "large: what it carries was taken from the unsnapped corners to the snapped ones";
            block.note("large", text);
        }
        block
    }

    fn edges(&self, fragment: &Fragment<'_>) -> Block {
        let shape = &fragment.shape;
        let title = "edge functions at the pixel's centre, in integers";
        let mut block = Block::new("edges", title, &[theory::EDGES, theory::TIES]);
        block.values("sample", "the sample, in subpixels", shape.sample);
        let row = |(name, edge): (&str, &Edge<i64>)| {
            let kind = match (edge.bias, edge.value) {
                (0, 0) => "top or left; the sample is on it, which counts",
                (0, _) => "top or left",
                (_, _) => "",
            };
            vec![name.into(), edge.value.into(), edge.step_x.into(), edge.step_y.into(), kind.into()]
        };
        let columns = ["opposite", "value", "step by column", "step by row", "edge"];
        block.table("edges", &columns, CORNERS.into_iter().zip(&shape.edges).map(row).collect());
        block
    }

    fn weights(&self, fragment: &Fragment<'_>) -> Block {
        let shape = &fragment.shape;
        let title = "weights of the corners P, Q, R";
        let mut block = Block::new("weights", title, &[theory::AREAS, theory::INVERSES]);
        block.values("screen", "on the screen: edges over the area", shape.screen());
        block.values("q", "q of the corners, at their subpixels", shape.q);
        block.values("space", "in space: times q, over the sum", shape.space());
        if !shape.is_whole() {
            block.values("of_vertices", "the same of the three vertices", shape.space_of_whole());
        }
        block
    }

    fn depth(&self, fragment: &Fragment<'_>) -> Block {
        let shape = &fragment.shape;
        let format = self.options.depth;
        let title = "depth";
        let mut block = match self.projection {
            AnyProjection::Perspective(_) => Block::new(
                "depth",
                title,
                &[theory::ONE_OVER_Z, theory::DEPTH, theory::RESOLUTION, theory::DRAWN_RESOLUTION],
            ),
            AnyProjection::Parallel(_) => Block::new("depth", title, &[theory::LINEAR_DEPTH]),
        };
        let q = shape.q_beside(0);
        block.value("zs", "zs on the plane of the corners", shape.depth());
        block.value("zs_drawn", "zs as drawn", self.zs(fragment.arrival.zs));
        block.value("word", "the word of the depth format", self.word(fragment.arrival.depth));
        block.value("q", "q", q);
        #[expect(clippy::cast_possible_truncation, reason = "rounded for the map")]
        let z = match self.projection {
            AnyProjection::Perspective(_) => 1.0 / q,
            AnyProjection::Parallel(parallel) => {
                parallel.depth_map(self.is_reversed()).z(shape.depth() as f32).into()
            }
        };
        block.value("z", "z, the distance before the eye", z);
        if let Some(steps) = steps(format) {
            #[expect(clippy::cast_possible_truncation, reason = "rounded for the map")]
            let (z, slope) = (z as f32, shape.slope_of_z() as f32);
            match self.projection {
                AnyProjection::Perspective(perspective) => {
                    let map = perspective.depth_map(self.is_reversed());
                    block.value("resolution", "dz of the format there", map.resolution(steps, z));
                    let drawn = map.drawn_resolution(steps, z, slope, self.drawing.subpixel());
                    block.value("drawn_resolution", "dz of surfaces as drawn", drawn);
                }
                AnyProjection::Parallel(parallel) => {
                    let depth = f64::from(parallel.far()) - f64::from(parallel.near());
                    block.value("resolution", "dz of the format there", step(steps, shape.depth()) * depth);
                }
            }
        }
        if self.is_fixed() && matches!(format, DepthFormat::U16 | DepthFormat::U24) {
            block.note(
                "rounding",
                "zs of both has half a step in it, so that cutting it to the format rounds it",
            );
        }
        block
    }

    fn is_reversed(&self) -> bool {
        self.options.depth == DepthFormat::F32Reversed
    }
}

/// The names of the corners on the screen.
const CORNERS: [&str; 3] = ["P", "Q", "R"];

/// The steps of a depth format, if it has some.
fn steps(format: DepthFormat) -> Option<DepthSteps> {
    match format {
        DepthFormat::F32 | DepthFormat::F32Reversed => Some(DepthSteps::F32),
        DepthFormat::U32 => Some(DepthSteps::D32),
        DepthFormat::U24 => Some(DepthSteps::D24),
        DepthFormat::U16 => Some(DepthSteps::D16),
        DepthFormat::None => None,
    }
}

/// The step of zs to the next depth that is told apart: the format's, or that of `f32`.
fn step(steps: DepthSteps, zs: f64) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "the float that is there")]
    let zs = zs as f32;
    let float = f64::from(zs.next_up()) - f64::from(zs);
    let even = match steps {
        DepthSteps::D16 => 1.0 / 65_535.0,
        DepthSteps::D24 => 1.0 / 16_777_215.0,
        DepthSteps::D32 => 1.0 / 4_294_967_295.0,
        DepthSteps::F32 => 0.0,
    };
    f64::max(even, float)
}
