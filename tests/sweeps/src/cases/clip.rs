//! Edges over the near or the far plane, in two triangles: the new vertex lies on the plane, between its ends, and is
//! the same from both.

use super::{ensure, rng};
use crate::Found;
use alberti_math::glam::Vec3;
use alberti_math::{Eye, Point3};
use alberti_oracle::rng::Rng;
use alberti_projection::{EyeVertex, clip_near_far};
use alberti_tests::random::{any_number, beside};

/// Edges of a block.
const EDGES: u64 = 500_000;

/// Or of any size at all.
fn anything(rng: &mut Rng) -> f32 {
    let number = any_number(rng);
    if rng.one_in(4) { number.signum() * rng.log_uniform(1e-37, 1e30) } else { number }
}

/// So many edges.
///
/// # Errors
/// An edge that is cut in two ways.
pub fn block(block: u64, seed: u64) -> Result<Found, String> {
    let mut rng = rng(block, seed);
    for _ in 0..EDGES {
        let plane = rng.log_uniform(1e-3, 1e3);
        let (range, inward) = if rng.one_in(2) { ([plane, 1e30], 1.0) } else { ([-1e30, plane], -1.0) };
        let mut at = |side: f32| {
            let [x, y, varying] = [(); 3].map(|()| anything(&mut rng));
            EyeVertex {
                position: Point3::<Eye>::new(Vec3::new(x, y, beside(&mut rng, plane, side))),
                varying,
            }
        };
        let (inside, outside, others) = (at(inward), at(-inward), [at(inward), at(inward)]);
        let [one, two] = [[inside, outside, others[0]], [outside, inside, others[1]]]
            .map(|t| clip_near_far(t, range[0], range[1]));
        let bits = |v: &EyeVertex<f32>| {
            let p = v.position.coords;
            [p.x, p.y, p.z, v.varying].map(f32::to_bits)
        };
        let (Some(cut), Some(same)) = (one.vertices().get(1), two.vertices().get(1)) else {
            return Err(format!("{inside:?} and {outside:?} are not cut"));
        };
        ensure!(bits(cut) == bits(same), "neighbours differ: {inside:?} {outside:?}");
        ensure!(
            cut.position.coords.z.to_bits() == plane.to_bits(),
            "beside the plane: {inside:?} {outside:?}"
        );
        let between = |x: f32, a: f32, b: f32| a.min(b) <= x && x <= a.max(b);
        let [c, i, o] =
            [cut, &inside, &outside].map(|v| [v.position.coords.x, v.position.coords.y, v.varying]);
        ensure!((0..3).all(|k| between(c[k], i[k], o[k])), "{c:?} is not between {i:?} and {o:?}");
    }
    Ok(Found { cases: EDGES, worst: 0.0 })
}
