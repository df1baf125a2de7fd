//! Triangles that are hard to get right: exact ties, their neighbours one subpixel away, and slivers.
//!
//! Random triangles almost never put a sample exactly on an edge, so ties are built: pick the sample `P` and a
//! primitive direction `d`, and let `A = P - k d` and `B = P + m d`.
//!
//! ```text
//!   A ----- d ----- d ----- P ----- d ----- B        C anywhere, or as near to the line as the lattice allows
//! ```
//!
//! All coordinates are subpixels with `bits` fraction bits, and no vertex exceeds `guard` in magnitude.

use crate::coverage::{Triangle, area2};
use crate::rng::Rng;

/// How a [`Case`] was built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The sample lies exactly on an edge, between its ends.
    OnEdge,
    /// The sample is a vertex.
    OnVertex,
    /// A tie in which one vertex was moved by one subpixel.
    NearTie,
    /// As thin as the lattice allows for its length, with the sample on the long edge.
    SliverTie,
    /// As thin as the lattice allows, with the sample one subpixel off the long edge.
    Sliver,
    /// Three random vertices around the sample.
    Plain,
}

/// A triangle with area, and the pixel centre to ask about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Case {
    /// Vertices in subpixels.
    pub tri: Triangle,
    /// A pixel centre in subpixels.
    pub sample: [i64; 2],
    /// How it was built.
    pub kind: Kind,
}

/// A case of a random kind; half of all are exact ties.
pub fn any(rng: &mut Rng, bits: u32, guard: i64) -> Case {
    match rng.index(8) {
        0 | 1 => on_edge(rng, bits, guard),
        2 => on_vertex(rng, bits, guard),
        3 | 4 => near_tie(rng, bits, guard),
        5 => sliver_tie(rng, bits, guard),
        6 => sliver(rng, bits, guard),
        _ => plain(rng, bits, guard),
    }
}

/// A triangle with an edge that passes exactly through the sample.
pub fn on_edge(rng: &mut Rng, bits: u32, guard: i64) -> Case {
    build(rng, bits, guard, Kind::OnEdge, |rng, p, reach| {
        let (a, b, _) = edge_through(rng, p, reach, guard)?;
        Some([a, b, point_near(rng, p, reach, guard)])
    })
}

/// A triangle with a vertex on the sample.
pub fn on_vertex(rng: &mut Rng, bits: u32, guard: i64) -> Case {
    build(rng, bits, guard, Kind::OnVertex, |rng, p, reach| {
        let mut other = || point_near(rng, p, reach, guard);
        Some([p, other(), other()])
    })
}

/// A tie in which one coordinate of one vertex was then moved by one subpixel.
pub fn near_tie(rng: &mut Rng, bits: u32, guard: i64) -> Case {
    loop {
        let tie = if rng.one_in(4) { on_vertex(rng, bits, guard) } else { on_edge(rng, bits, guard) };
        let all: Vec<Triangle> = neighbours(tie.tri, guard).collect();
        if !all.is_empty() {
            return Case { tri: all[rng.index(all.len())], sample: tie.sample, kind: Kind::NearTie };
        }
    }
}

/// A sliver whose long edge passes exactly through the sample. Its third vertex is a lattice point nearest to the line,
/// so that its doubled area is the number of primitive steps along the edge: often 2, over lengths up to the guard
/// band.
pub fn sliver_tie(rng: &mut Rng, bits: u32, guard: i64) -> Case {
    build(rng, bits, guard, Kind::SliverTie, |rng, p, reach| sliver_through(rng, p, reach, guard))
}

/// A sliver whose long edge misses the sample by at most one subpixel on each axis.
pub fn sliver(rng: &mut Rng, bits: u32, guard: i64) -> Case {
    build(rng, bits, guard, Kind::Sliver, |rng, p, reach| {
        let off = [rng.range(-1, 1), rng.range(-1, 1)];
        sliver_through(rng, add(p, off, 1), reach, guard)
    })
}

/// Three random vertices at a random scale around the sample.
pub fn plain(rng: &mut Rng, bits: u32, guard: i64) -> Case {
    build(rng, bits, guard, Kind::Plain, |rng, p, reach| {
        let mut vertex = || point_near(rng, p, reach, guard);
        Some([vertex(), vertex(), vertex()])
    })
}

/// Every triangle with area that differs from `tri` by one vertex moved to one of its eight lattice neighbours.
pub fn neighbours(tri: Triangle, guard: i64) -> impl Iterator<Item = Triangle> {
    (0..24).filter_map(move |i| {
        // Steps 0 to 8 without 4 are the eight neighbours.
        let step = i % 8 + i64::from(i % 8 >= 4);
        let mut moved = tri;
        let vertex = &mut moved[(i / 8) as usize];
        *vertex = add(*vertex, [step % 3 - 1, step / 3 - 1], 1);
        (within(*vertex, guard) && area2(moved) != 0).then_some(moved)
    })
}

/// The centre of the pixel in column `x` and row `y`.
///
/// # Panics
/// When `bits` is zero, as no centre is then a subpixel.
#[must_use]
pub fn pixel_centre(x: i64, y: i64, bits: u32) -> [i64; 2] {
    assert!(bits > 0, "a pixel centre needs a fraction bit");
    [x, y].map(|c| (c << bits) + (1 << (bits - 1)))
}

/// Draws samples and scales until `vertices` finds a triangle with area, then turns and mirrors the vertex order.
fn build(
    rng: &mut Rng,
    bits: u32,
    guard: i64,
    kind: Kind,
    mut vertices: impl FnMut(&mut Rng, [i64; 2], i64) -> Option<Triangle>,
) -> Case {
    let pixels = guard >> bits;
    assert!(pixels >= 2, "a guard band of {guard} holds no pixels");
    loop {
        let spread = rng.log_integer(pixels - 1);
        let sample = pixel_centre(rng.range(-spread, spread - 1), rng.range(-spread, spread - 1), bits);
        let reach = rng.log_integer(guard);
        let Some(mut tri) = vertices(rng, sample, reach) else {
            continue;
        };
        if area2(tri) == 0 || tri.iter().any(|&v| !within(v, guard)) {
            continue;
        }
        tri.rotate_left(rng.index(3));
        if rng.one_in(2) {
            tri.swap(0, 1);
        }
        return Case { tri, sample, kind };
    }
}

/// The ends of an edge through `p`, and its primitive direction.
fn edge_through(
    rng: &mut Rng,
    p: [i64; 2],
    reach: i64,
    guard: i64,
) -> Option<([i64; 2], [i64; 2], [i64; 2])> {
    let longest = rng.log_integer(reach);
    // Axis-parallel edges are where tie rules tell left from right, so one in four is.
    let (x, y) = match rng.index(8) {
        0 => (rng.range(-1, 1), 0),
        1 => (0, rng.range(-1, 1)),
        _ => (rng.range(-longest, longest), rng.range(-longest, longest)),
    };
    let divisor = gcd(x, y);
    if divisor == 0 {
        return None;
    }
    let d = [x / divisor, y / divisor];
    let steps = (reach / d[0].abs().max(d[1].abs())).max(1);
    let a = add(p, d, -rng.log_integer(steps));
    let b = add(p, d, rng.log_integer(steps));
    (within(a, guard) && within(b, guard)).then_some((a, b, d))
}

fn sliver_through(rng: &mut Rng, p: [i64; 2], reach: i64, guard: i64) -> Option<Triangle> {
    let (a, b, d) = edge_through(rng, p, reach, guard)?;
    // A lattice point next to the line through p: dx ry - dy rx = 1, on either side.
    let r = bezout(d[0], d[1]);
    let side = if rng.one_in(2) { 1 } else { -1 };
    Some([a, b, add(p, r, side)])
}

fn point_near(rng: &mut Rng, p: [i64; 2], reach: i64, guard: i64) -> [i64; 2] {
    p.map(|c| rng.range((c - reach).max(-guard), (c + reach).min(guard)))
}

fn add(p: [i64; 2], d: [i64; 2], times: i64) -> [i64; 2] {
    [p[0] + times * d[0], p[1] + times * d[1]]
}

fn within(p: [i64; 2], guard: i64) -> bool {
    p.iter().all(|c| c.abs() <= guard)
}

fn gcd(a: i64, b: i64) -> i64 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// A vector `r`, no longer than `(dx, dy)` on either axis (or a unit vector), with `dx ry - dy rx = 1`.
fn bezout(dx: i64, dy: i64) -> [i64; 2] {
    // Extended Euclid on (dx, dy): keeps a = dx s + dy t for both rows.
    let (mut a, mut s, mut t) = (dx, 1, 0);
    let (mut b, mut s2, mut t2) = (dy, 0, 1);
    while b != 0 {
        let quotient = a / b;
        (a, s, t, b, s2, t2) = (b, s2, t2, a - quotient * b, s - quotient * s2, t - quotient * t2);
    }
    // a is +1 or -1, as the direction is primitive.
    [-t * a, s * a]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coverage::{covers, covers_scaled, weights};
    use crate::rng::run_seed;

    const GUARD: i64 = 1 << 23;

    fn on_a_line(case: &Case) -> bool {
        weights(case.tri, case.sample).contains(&0)
    }

    #[test]
    fn every_kind_is_what_it_says() {
        let mut rng = Rng::new(run_seed());
        let (mut ties, mut covered, mut thin) = (0, 0, 0);
        for i in 0..100_000 {
            let bits = 1 + i % 8;
            let case = any(&mut rng, bits, GUARD);
            let centre = case.sample.map(|c| c.rem_euclid(1 << bits));
            assert_eq!(centre, [1 << (bits - 1); 2], "{case:?}");
            assert!(case.tri.iter().all(|&v| within(v, GUARD)), "{case:?}");
            assert_ne!(area2(case.tri), 0);
            match case.kind {
                Kind::OnEdge | Kind::SliverTie => assert!(on_a_line(&case), "{case:?}"),
                Kind::OnVertex => assert!(case.tri.contains(&case.sample), "{case:?}"),
                Kind::NearTie | Kind::Sliver | Kind::Plain => {}
            }
            ties += u32::from(on_a_line(&case));
            covered += u32::from(covers(case.tri, case.sample));
            thin += u32::from(area2(case.tri).abs() <= 4);
        }
        assert!(ties > 50_000, "only {ties} ties");
        assert!(covered > 20_000, "only {covered} covered");
        assert!(thin > 2_000, "only {thin} slivers");
    }

    #[test]
    fn slivers_reach_across_the_guard_band() {
        let mut rng = Rng::new(run_seed());
        let longest = (0..20_000)
            .map(|_| sliver_tie(&mut rng, 8, GUARD).tri)
            .filter(|&tri| area2(tri).abs() <= 2)
            .map(|tri| (tri[0][0] - tri[1][0]).abs())
            .max();
        assert!(longest > Some(GUARD / 2), "{longest:?}");
    }

    #[test]
    fn symbols_and_numbers_agree_on_hard_cases() {
        let mut rng = Rng::new(run_seed());
        for i in 0..200_000 {
            let case = any(&mut rng, 1 + i % 8, 1 << 18);
            assert_eq!(covers(case.tri, case.sample), covers_scaled(case.tri, case.sample), "{case:?}");
        }
    }

    #[test]
    fn neighbours_are_all_different() {
        let tri = [[0, 0], [100, 7], [3, 90]];
        let mut all: Vec<Triangle> = neighbours(tri, GUARD).collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 24);
        assert!(!all.contains(&tri));
        assert_eq!(neighbours([[0, 0], [100, 7], [3, 90]], 100).count(), 21);
    }

    #[test]
    fn the_nearest_lattice_point_has_area_one() {
        for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1), (3, 5), (-7, 4), (8_388_607, -8_388_608)] {
            let [rx, ry] = bezout(dx, dy);
            assert_eq!(dx * ry - dy * rx, 1, "{dx} {dy}");
            assert!(rx.abs() <= dx.abs().max(1) && ry.abs() <= dy.abs().max(1));
        }
    }
}
