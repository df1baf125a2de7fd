//! A pipeline in f64 that snaps vertices like the one under test: eye space in, pixels out.
//!
//! Triangles are clipped to near and far, projected, clipped to the guard band, snapped to the subpixel grid, drawn as
//! fans by [`crate::coverage`]'s exact argument, and interpolated from the snapped positions with f64 weights. Against
//! [`crate::ideal`] this shows what snapping alone does to a picture; against the pipeline, what f32 does.

use crate::coverage::{Triangle, area2, edge, leading_sign};
use crate::image::Image;
use crate::polygon::{clip_depth, clip_guard, corners};
use crate::scene::Scene;
use crate::vec3::{Vec3, blend};
use crate::view::View;
use crate::visibility::{Place, Visibility, culled, triangles};
use std::ops::Range;

/// Screen positions beyond this many pixels from the origin are clipped away before snapping.
pub const GUARD: f64 = 32768.0;

/// Renders `scene` with its vertices snapped to multiples of `2^-bits` pixels, halves upwards.
///
/// # Panics
/// When `bits` is not in `1..=14`: a pixel centre needs one bit, and edge functions are to fit an i64.
#[must_use]
pub fn render_snapped(scene: &Scene<'_>, bits: u32) -> Image {
    assert!((1..=14).contains(&bits), "{bits} subpixel bits; expected 1 to 14");
    let view = View::new(scene);
    let mut visible = Visibility::new(scene);
    for (place, world) in triangles(scene) {
        let eye = world.map(|p| view.to_eye(p));
        let polygon = clip_guard(clip_depth(&corners(eye), &view), &view, GUARD);
        let snapped: Vec<Snapped> = polygon
            .iter()
            .map(|corner| Snapped {
                at: view.project(corner.eye).map(|c| snap(c, bits)),
                q: 1.0 / corner.eye[2],
                weights: corner.weights,
            })
            .collect();
        for i in 2..snapped.len() {
            let fan = [snapped[0], snapped[i - 1], snapped[i]];
            draw(scene, &mut visible, place, fan, bits);
        }
    }
    visible.resolve(scene)
}

/// The subpixel nearest to `pixel`, halves upwards.
#[must_use]
pub fn snap(pixel: f64, bits: u32) -> i64 {
    (pixel * f64::from(bits).exp2() + 0.5).floor() as i64
}

/// A corner on the subpixel grid.
#[derive(Clone, Copy, Debug)]
struct Snapped {
    at: [i64; 2],
    /// `1/z`.
    q: f64,
    weights: Vec3,
}

/// An edge function over pixels: its value at the centre of pixel (0, 0), its steps, and which way a tie goes.
#[derive(Clone, Copy, Debug)]
struct Edge {
    origin: i64,
    step: [i64; 2],
    tie: i64,
}

impl Edge {
    fn new(a: [i64; 2], b: [i64; 2], bits: u32) -> Self {
        let half = 1 << (bits - 1);
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        // Positions below 2^(15 + bits) in magnitude: the value is below 2^(33 + 2 bits), at most 2^61.
        let origin = edge(a, b, [half, half]) as i64;
        Self {
            origin,
            step: [-dy << bits, dx << bits],
            // The moved sample's side when its first coefficient, the value itself, vanishes.
            tie: i64::from(leading_sign([0, -i128::from(dy), i128::from(dx)])),
        }
    }

    fn at(&self, x: usize, y: usize) -> i64 {
        self.origin + self.step[0] * x as i64 + self.step[1] * y as i64
    }

    fn side(&self, value: i64) -> i64 {
        if value == 0 { self.tie } else { value.signum() }
    }
}

fn draw(scene: &Scene<'_>, visible: &mut Visibility, place: Place, fan: [Snapped; 3], bits: u32) {
    let tri: Triangle = fan.map(|v| v.at);
    let area = area2(tri) as i64;
    // Screen y points down, so that triangles seen counter-clockwise have negative area.
    if area == 0 || culled(scene.cull, -area as f64) {
        return;
    }
    let edges = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| Edge::new(tri[i], tri[j], bits));
    let columns = centres(tri.map(|v| v[0]), scene.width, bits);
    for y in centres(tri.map(|v| v[1]), scene.height, bits) {
        for x in columns.clone() {
            let values = edges.map(|e| e.at(x, y));
            if (0..3).any(|i| edges[i].side(values[i]) != area.signum()) {
                continue;
            }
            let shares: Vec3 = std::array::from_fn(|i| values[i] as f64 * fan[i].q);
            let sum = shares[0] + shares[1] + shares[2];
            visible.offer([x, y], area as f64 / sum, place, || {
                blend(shares.map(|s| s / sum), fan.map(|v| v.weights))
            });
        }
    }
}

/// The pixels on one axis whose centres lie between the least and the greatest of `positions`, both included.
fn centres(positions: [i64; 3], size: u32, bits: u32) -> Range<usize> {
    let half = 1 << (bits - 1);
    let size = i64::from(size);
    let (low, high) =
        positions.iter().fold((i64::MAX, i64::MIN), |(low, high), &p| (low.min(p), high.max(p)));
    let first = -((half - low) >> bits);
    let end = ((high - half) >> bits) + 1;
    let first = first.clamp(0, size);
    first as usize..end.clamp(first, size) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::coverage::covers;
    use crate::rng::{Rng, run_seed};

    #[test]
    fn halves_snap_upwards() {
        assert_eq!(snap(0.5, 1), 1);
        assert_eq!(snap(0.25, 1), 1);
        assert_eq!(snap(-0.25, 1), 0);
        assert_eq!(snap(-0.26, 1), -1);
        assert_eq!(snap(GUARD, 8), 1 << 23);
    }

    #[test]
    fn pixel_ranges_hold_exactly_the_centres_between() {
        let bits = 2;
        for low in -20..60 {
            for high in low..60 {
                let range = centres([high, low, low], 10, bits);
                let expected: Vec<usize> =
                    (0..10).filter(|&x| (low..=high).contains(&(x as i64 * 4 + 2))).collect();
                assert_eq!(range.collect::<Vec<_>>(), expected, "{low} to {high}");
            }
        }
    }

    #[test]
    fn stepped_edges_cover_what_the_definition_covers() {
        let mut rng = Rng::new(run_seed());
        for i in 0..20_000 {
            let bits = 1 + i % 8;
            let case = cases::any(&mut rng, bits, 16 << bits);
            let [a, b, c] = case.tri;
            let edges = [(b, c), (c, a), (a, b)].map(|(p, q)| Edge::new(p, q, bits));
            let area = area2(case.tri) as i64;
            for y in 0..16 {
                for x in 0..16 {
                    let sample = cases::pixel_centre(x as i64, y as i64, bits);
                    let got = edges.iter().all(|e| e.side(e.at(x, y)) == area.signum());
                    assert_eq!(got, covers(case.tri, sample), "{case:?} at {x}, {y}");
                }
            }
        }
    }
}
