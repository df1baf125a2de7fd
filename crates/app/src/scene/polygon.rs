//! Polygons as triangles.
//!
//! ```text
//!   4-------3         ears of the L: 0 1 2, then 0 2 5 of the rest,
//!   |     / |         and so on; 2 is reflex, so 1 2 3 is none
//!   |   2---1         A ring is one polygon too, cut open along a bridge
//!   | /   /           whose two ends come twice.
//!   5---0
//! ```

use robust::{Coord, orient2d};

use crate::scene::normals::{cross, dot, length, normalize, sub};

mod tree;

use tree::Tree;

/// Ears are few if the next is farther than so many corners.
const SCARCE: usize = 64;

/// The looks at corners, and at groups of them, that a polygon may take: for each corner, and beside that.
const EFFORT: [usize; 2] = [500, 25_000_000];

/// Cuts a polygon in space into triangles of its corners' numbers, always two fewer than it has corners, and turned as
/// it is. Whether it could: what crosses itself on its plane has no inside, and gets some triangles. Four corners that
/// are not in a plane are two triangles in any case, those that face more alike.
///
/// It is cut on the plane of two axes that its normal (Newell's, the sum over edges) is nearest to. Where all triangles
/// of a fan about corner 0 have areas of the polygon's sign, as in convex polygons, it is that fan. Otherwise ears are
/// clipped (Meisters, Polygons have ears, 1975), with exact signs of areas (Shewchuk, Adaptive precision floating-point
/// arithmetic, 1997). An outline may touch itself, as along the bridge to a hole. Corners in a line get triangles with
/// an area where they can, so that neighbours who share them leave no gap.
///
/// # Cost
/// Linear for fans. An ear asks a tree for the blunt corners within: a ring of a million corners takes a second.
/// After about a second of steps, and 20 microseconds a corner, which it counts, it gives up, as if the polygon crossed
/// itself. Outlines that cross nowhere come to that if all of a million corners get in each other's way.
pub(crate) fn triangulate(points: &[[f64; 3]], triangles: &mut Vec<[u32; 3]>) -> bool {
    let corners = u32::try_from(points.len()).unwrap_or(u32::MAX);
    let fan = (1..corners.saturating_sub(1)).map(|i| [0, i, i + 1]);
    if corners <= 3 {
        triangles.extend(fan);
        return true;
    }
    let flat = on_plane(points);
    if fan.clone().all(|[a, b, c]| turn(&flat, a, b, c) > 0.0) {
        triangles.extend(fan);
        return true;
    }
    let before = triangles.len();
    if Ears::new(&flat).clip(triangles) {
        return true;
    }
    let Some(two) = two_of_four(points) else { return false };
    triangles.truncate(before);
    triangles.extend(two);
    true
}

/// The share of the cube over their distances that four corners span which are not in a plane.
const SKEW: f64 = 1e-4;

/// The two triangles of four corners that are not in a plane.
fn two_of_four(points: &[[f64; 3]]) -> Option<[[u32; 3]; 2]> {
    let &[a, b, c, d] = points else { return None };
    let sides = [b, c, d].map(|corner| sub(corner, a));
    let size = sides.map(length).into_iter().fold(0.0, f64::max);
    if dot(cross(sides[0], sides[1]), sides[2]).abs() <= SKEW * size.powi(3) {
        return None;
    }
    let ways = [[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]];
    let alike = |way: &[[u32; 3]; 2]| {
        let normals = way.map(|triangle| {
            let [a, b, c] = triangle.map(|k| points[k as usize]);
            normalize(cross(sub(b, a), sub(c, a))).unwrap_or_default()
        });
        dot(normals[0], normals[1])
    };
    ways.into_iter().max_by(|one, other| alike(one).total_cmp(&alike(other)))
}

/// The corners on the plane that the polygon's normal is nearest to, counter-clockwise as a whole.
fn on_plane(points: &[[f64; 3]]) -> Vec<Coord<f64>> {
    let Some(&origin) = points.first() else { return Vec::new() };
    let mut normal = [0.0; 3];
    for (i, &point) in points.iter().enumerate() {
        let next = points[(i + 1) % points.len()];
        // From the first corner on, so that a place far away costs no digits.
        let across = cross(sub(point, origin), sub(next, origin));
        normal = [0, 1, 2].map(|axis| normal[axis] + across[axis]);
    }
    let [x, y, z] = normal.map(f64::abs);
    let (u, v, along) = if z >= x && z >= y {
        (0, 1, normal[2])
    } else if x >= y {
        (1, 2, normal[0])
    } else {
        (2, 0, normal[1])
    };
    let (u, v) = if along < 0.0 { (v, u) } else { (u, v) };
    points.iter().map(|point| Coord { x: point[u], y: point[v] }).collect()
}

/// Twice the area, above 0 if counter-clockwise; its sign is exact.
fn turn(points: &[Coord<f64>], a: u32, b: u32, c: u32) -> f64 {
    let [a, b, c] = [a, b, c].map(|i| points[i as usize]);
    orient2d(a, b, c)
}

/// A polygon whose ears are being clipped: what is left is a ring of corners.
struct Ears<'a> {
    points: &'a [Coord<f64>],
    next: Vec<u32>,
    last: Vec<u32>,
    /// Whether it may be in the way of an ear: the inner angle is not below 180 degrees, or 0 as at the tip of a slit.
    /// Clipping makes angles smaller, so none comes to be so.
    blunt: Tree,
    effort: usize,
}

impl<'a> Ears<'a> {
    fn new(points: &'a [Coord<f64>]) -> Self {
        let corners = u32::try_from(points.len()).unwrap_or(u32::MAX);
        let next: Vec<u32> = (0..corners).map(|i| (i + 1) % corners).collect();
        let last: Vec<u32> = (0..corners).map(|i| (i + corners - 1) % corners).collect();
        let is_blunt = |&i: &u32| turn(points, last[i as usize], i, next[i as usize]) <= 0.0;
        let blunt = Tree::new(points, (0..corners).filter(is_blunt).collect());
        let effort = points.len().saturating_mul(EFFORT[0]).saturating_add(EFFORT[1]);
        Self { points, next, last, blunt, effort }
    }

    fn turn(&self, a: u32, b: u32, c: u32) -> f64 {
        turn(self.points, a, b, c)
    }

    /// All triangles, and whether none had to be forced.
    fn clip(mut self, triangles: &mut Vec<[u32; 3]>) -> bool {
        let (mut at, mut left, mut simple) = (0, self.points.len(), true);
        // Corners looked at since the last was clipped.
        let (mut since, mut scarce) = (0, false);
        while left > 3 {
            if self.effort == 0 {
                // Too complicated: a fan of what is left.
                let ring = std::iter::successors(Some(at), |&i| Some(self.next[i as usize]));
                let pairs = ring.clone().skip(1).zip(ring.skip(2)).take(left - 2);
                triangles.extend(pairs.map(|(b, c)| [at, b, c]));
                return false;
            }
            if since < left && !self.is_ear(at) {
                at = self.next[at as usize];
                since += 1;
                continue;
            }
            if since >= left {
                self.effort = self.effort.saturating_sub(left);
                let flat = self.find(at, left, |turn| turn.abs() <= 0.0);
                // A rest with neither ears nor corners in a line crosses itself.
                simple &= flat.is_some();
                at = flat.or_else(|| self.find(at, left, |turn| turn > 0.0)).unwrap_or(at);
            }
            let (last, next) = (self.last[at as usize], self.next[at as usize]);
            triangles.push([last, at, next]);
            self.next[last as usize] = next;
            self.last[next as usize] = last;
            self.blunt.remove(at);
            for i in [last, next] {
                let (before, after) = (self.last[i as usize], self.next[i as usize]);
                if self.turn(before, i, after) > 0.0 {
                    self.blunt.remove(i);
                }
            }
            // Every other corner, so that triangles stay rounder; but where ears are few, the next is beside the last.
            scarce |= since > SCARCE;
            at = if scarce { last } else { self.next[next as usize] };
            (left, since) = (left - 1, 0);
        }
        let (last, next) = (self.last[at as usize], self.next[at as usize]);
        simple &= self.turn(last, at, next) >= 0.0;
        triangles.push([last, at, next]);
        simple
    }

    /// The first corner from here on with such a turn.
    fn find(&self, from: u32, left: usize, is: impl Fn(f64) -> bool) -> Option<u32> {
        let mut ring = std::iter::successors(Some(from), |&i| Some(self.next[i as usize])).take(left);
        ring.find(|&i| is(self.turn(self.last[i as usize], i, self.next[i as usize])))
    }

    /// Whether the triangle of a corner and its neighbours is inside, with an area, and nothing else in it.
    fn is_ear(&mut self, at: u32) -> bool {
        let (a, b, c) = (self.last[at as usize], at, self.next[at as usize]);
        self.effort = self.effort.saturating_sub(1);
        if self.turn(a, b, c) <= 0.0 || !self.between(a, c) || !self.between(c, a) {
            return false;
        }
        let [p, q, r] = [a, b, c].map(|i| self.points[i as usize]);
        let mut looked = 0;
        let blocked = self.blunt.any([p, q, r], &mut looked, &mut |i| {
            // The ends of a bridge come twice. Which side of them is inside has been seen.
            let known = [p, q, r].contains(&self.points[i as usize]);
            !known && self.turn(a, b, i) >= 0.0 && self.turn(b, c, i) >= 0.0 && self.turn(c, a, i) >= 0.0
        });
        self.effort = self.effort.saturating_sub(looked);
        !blocked
    }

    /// Whether the line from corner `i` to `to` begins inside.
    fn between(&self, i: u32, to: u32) -> bool {
        let (last, next) = (self.last[i as usize], self.next[i as usize]);
        let (left, right) = (self.turn(i, next, to) >= 0.0, self.turn(last, i, to) >= 0.0);
        if self.turn(last, i, next) < 0.0 { left || right } else { left && right }
    }
}

#[cfg(test)]
mod tests;
