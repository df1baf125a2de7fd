//! Exact coverage of a sample by a triangle, with no tie rule. Screen space in subpixels, y down.
//!
//! A sample belongs to a triangle if and only if the sample moved by `(e, e^2)`, for every small enough `e > 0`, lies
//! strictly inside it. A moved sample never lies on a line through two lattice points: the edge function
//!
//! ```text
//! E(P) = dx (Py - Ay) - dy (Px - Ax)            d = B - A
//! E(P + (e, e^2)) = E(P)  -  dy e  +  dx e^2
//! ```
//!
//! is a polynomial in `e` that vanishes for all `e` only when `d = 0`. Its sign as `e` goes to zero is the sign of its
//! first non-zero coefficient, which integers give exactly. So the moved samples of a subdivision of the plane fall
//! into exactly one triangle each; that this equals the top-left rule is a theorem, not a line of code here.

/// A triangle whose vertices are `[x, y]` in subpixels.
pub type Triangle = [[i64; 2]; 3];

/// Twice the signed area of `tri`: positive when its vertices run clockwise on the screen (y points down).
#[must_use]
pub fn area2(tri: Triangle) -> i128 {
    edge(tri[0], tri[1], tri[2])
}

/// The edge function of the directed edge from `a` to `b` at `p`: twice the signed area of the triangle `abp`.
///
/// Exact for coordinates up to `2^61` in magnitude.
#[must_use]
pub fn edge(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> i128 {
    let [dx, dy] = delta(a, b);
    let [px, py] = delta(a, p);
    dx * py - dy * px
}

/// The three edge functions of `tri` at `sample`, each opposite to the vertex of its index; their sum is [`area2`].
///
/// Up to that sum they are the barycentric weights of the three vertices.
#[must_use]
pub fn weights(tri: Triangle, sample: [i64; 2]) -> [i128; 3] {
    [edge(tri[1], tri[2], sample), edge(tri[2], tri[0], sample), edge(tri[0], tri[1], sample)]
}

/// Whether `sample` belongs to `tri`, whichever way the vertices run. Triangles without area own no sample.
#[must_use]
pub fn covers(tri: Triangle, sample: [i64; 2]) -> bool {
    let side = |i: usize, j: usize| moved_side(tri[i], tri[j], sample);
    let first = side(0, 1);
    first != 0 && side(1, 2) == first && side(2, 0) == first
}

/// The side of the line from `a` to `b` on which the moved sample lies, as the sign of the edge function; 0 if `a = b`.
#[must_use]
pub fn moved_side(a: [i64; 2], b: [i64; 2], sample: [i64; 2]) -> i32 {
    let [dx, dy] = delta(a, b);
    leading_sign([edge(a, b, sample), -dy, dx])
}

/// The sign of `c[0] + c[1] e + c[2] e^2` as `e` goes to zero from above.
#[must_use]
pub fn leading_sign(coefficients: [i128; 3]) -> i32 {
    coefficients.into_iter().find(|&c| c != 0).map_or(0, |c| c.signum() as i32)
}

/// [`covers`] by numbers instead of symbols: everything scaled by `K^2` and the sample really moved, by `(K, 1)`.
///
/// This is the point `e = 1/K` of the same argument. It holds no decision about ties in any form, but only small
/// coordinates fit; its use is to check [`covers`].
///
/// # Panics
/// When a coordinate exceeds `2^19` in magnitude.
#[must_use]
pub fn covers_scaled(tri: Triangle, sample: [i64; 2]) -> bool {
    // With coordinates up to M no difference exceeds D = 2M. The scaled edge function is K^2 (K^2 E - dy K + dx).
    //   E != 0: K^2 |E| >= K^2, while |dy K - dx| <= D K + D < K^2 as soon as K >= D + 2.
    //   E == 0, dy != 0: |dy| K >= K > D >= |dx|.
    // So K = 4M (at least 4) lets no perturbation jump a lattice decision.
    // With M = 2^19: K = 2^21, coordinates 2^61, their differences 2^62 + 2^21, an edge function below 2^126.
    const LIMIT: i64 = 1 << 19;
    let points = [tri[0], tri[1], tri[2], sample];
    let magnitude = points.iter().flatten().map(|c| c.abs()).max().map_or(1, |m| m.max(1));
    assert!(magnitude <= LIMIT, "coordinate {magnitude} is too large");
    let k = 4 * i128::from(magnitude);
    let scale = |p: [i64; 2]| p.map(|c| i128::from(c) * k * k);
    let vertices = tri.map(scale);
    let [x, y] = scale(sample);
    let moved = [x + k, y + 1];
    let side = |i: usize, j: usize| {
        let (a, b) = (vertices[i], vertices[j]);
        ((b[0] - a[0]) * (moved[1] - a[1]) - (b[1] - a[1]) * (moved[0] - a[0])).signum()
    };
    let signs = [side(0, 1), side(1, 2), side(2, 0)];
    signs[0] != 0 && signs.iter().all(|&s| s == signs[0])
}

fn delta(a: [i64; 2], b: [i64; 2]) -> [i128; 2] {
    [i128::from(b[0]) - i128::from(a[0]), i128::from(b[1]) - i128::from(a[1])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Rng, run_seed};

    #[test]
    fn an_edge_through_a_sample_belongs_to_one_side() {
        // Clockwise on the screen, so the first edge is a top edge and the last one a left edge: both are owned.
        let tri = [[0, 0], [32, 0], [0, 32]];
        assert!(area2(tri) > 0);
        assert!(covers(tri, [0, 0]));
        assert!(covers(tri, [8, 0]));
        assert!(covers(tri, [0, 8]));
        assert!(!covers(tri, [16, 16]));
        assert!(!covers(tri, [32, 0]));
        assert!(!covers(tri, [0, 32]));
        assert!(covers(tri, [15, 16]));
    }

    #[test]
    fn orientation_and_vertex_order_do_not_matter() {
        let [a, b, c] = [[0, 0], [32, 0], [0, 32]];
        for x in -1..34 {
            for y in -1..34 {
                let expected = covers([a, b, c], [x, y]);
                for tri in [[b, c, a], [c, a, b], [c, b, a], [b, a, c], [a, c, b]] {
                    assert_eq!(covers(tri, [x, y]), expected, "{tri:?} at {x}, {y}");
                }
            }
        }
    }

    #[test]
    fn symbols_and_numbers_agree_on_every_small_triangle() {
        // All ordered triples on a 4x4 lattice against all samples on it and one beyond, most of which are ties.
        let points: Vec<[i64; 2]> = (0..16).map(|i| [i % 4, i / 4]).collect();
        let (mut ties, mut covered) = (0u32, 0u32);
        for &a in &points {
            for &b in &points {
                for &c in &points {
                    let tri = [a, b, c];
                    for sample in (0..36).map(|i| [i % 6 - 1, i / 6 - 1]) {
                        let got = covers(tri, sample);
                        assert_eq!(got, covers_scaled(tri, sample), "{tri:?} at {sample:?}");
                        ties += u32::from(weights(tri, sample).contains(&0));
                        covered += u32::from(got);
                    }
                }
            }
        }
        assert!(ties > 40_000, "only {ties} ties");
        assert!(covered > 4_000, "only {covered} covered");
    }

    #[test]
    fn symbols_and_numbers_agree_up_to_the_limit_of_the_numbers() {
        let mut rng = Rng::new(run_seed());
        let mut covered = 0;
        for _ in 0..200_000 {
            let size = rng.log_integer(1 << 19);
            let mut point = || [rng.range(-size, size), rng.range(-size, size)];
            let (tri, sample) = ([point(), point(), point()], point());
            assert_eq!(covers(tri, sample), covers_scaled(tri, sample));
            covered += u32::from(covers(tri, sample));
        }
        assert!(covered > 4_000, "only {covered} covered");
    }

    #[test]
    fn a_fan_around_a_sample_owns_it_once() {
        let mut rng = Rng::new(run_seed());
        let ring: [[i64; 2]; 8] =
            [[64, 0], [50, 50], [0, 64], [-50, 50], [-64, 0], [-50, -50], [0, -64], [50, -50]];
        for _ in 0..1_000 {
            let hub = [rng.range(-30, 30), rng.range(-30, 30)];
            for sample in [hub, [0, 0], [hub[0], 0], [0, hub[1]]] {
                let owners = (0..8).filter(|&i| covers([hub, ring[i], ring[(i + 1) % 8]], sample)).count();
                assert_eq!(owners, 1, "hub {hub:?}, sample {sample:?}");
            }
        }
    }

    #[test]
    fn degenerate_triangles_own_nothing() {
        for tri in [[[0, 0]; 3], [[0, 0], [8, 8], [16, 16]]] {
            assert!((-1..18).all(|i| !covers(tri, [i, i])));
        }
    }

    #[test]
    fn the_guard_band_fits() {
        let far = 1 << 23;
        let tri = [[-far, -far], [far, -far], [-far, far]];
        assert_eq!(area2(tri), 1 << 48);
        assert_eq!(weights(tri, [0, 0]).iter().sum::<i128>(), area2(tri));
        // The long edge passes through the origin going down-left, so it is not owned; one subpixel inside is.
        assert!(!covers(tri, [0, 0]));
        assert!(covers(tri, [-1, 0]));
    }
}
