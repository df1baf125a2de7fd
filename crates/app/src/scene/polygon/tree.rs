//! Corners of a polygon by their places, to find those that are in a triangle.

use robust::{Coord, orient2d};

/// The most corners of a node without children.
const LEAF: usize = 8;

/// The leaf of a corner that is in none.
const NONE: u32 = u32::MAX;

/// Corners, halved by their places until few are left (Bentley, Multidimensional binary search trees, 1975).
pub(super) struct Tree {
    /// The children of node n are 2n + 1 and 2n + 2.
    nodes: Vec<Node>,
    corners: Vec<u32>,
    /// Of each corner of the polygon.
    leaves: Vec<u32>,
}

/// A part of the corners.
#[derive(Clone)]
struct Node {
    low: Coord<f64>,
    high: Coord<f64>,
    /// The corners of `Tree::corners`, of which so many are left.
    corners: std::ops::Range<u32>,
    left: u32,
}

impl Tree {
    pub(super) fn new(points: &[Coord<f64>], mut corners: Vec<u32>) -> Self {
        let leaves = corners.len().div_ceil(LEAF).next_power_of_two();
        let none = Coord { x: 0.0, y: 0.0 };
        let nodes = vec![Node { low: none, high: none, corners: 0..0, left: 0 }; 2 * leaves - 1];
        let mut tree = Self { nodes, corners: Vec::new(), leaves: vec![NONE; points.len()] };
        tree.fill(points, &mut corners, 0, 0);
        tree.corners = corners;
        tree
    }

    /// Gives node `n` these corners, which begin at `first` of all.
    fn fill(&mut self, points: &[Coord<f64>], corners: &mut [u32], n: u32, first: u32) {
        let at = |i: u32| points[i as usize];
        let (mut low, mut high) = (Coord { x: f64::MAX, y: f64::MAX }, Coord { x: f64::MIN, y: f64::MIN });
        for point in corners.iter().map(|&i| at(i)) {
            low = Coord { x: low.x.min(point.x), y: low.y.min(point.y) };
            high = Coord { x: high.x.max(point.x), y: high.y.max(point.y) };
        }
        let left = u32::try_from(corners.len()).unwrap_or(NONE);
        let nodes = self.nodes.len();
        self.nodes[n as usize] = Node { low, high, corners: first..first + left, left };
        if 2 * n as usize + 2 >= nodes {
            corners.iter().for_each(|&i| self.leaves[i as usize] = n);
            return;
        }
        let half = left / 2;
        if left > 1 {
            let wide = high.x - low.x > high.y - low.y;
            let along = |i: u32| if wide { at(i).x } else { at(i).y };
            corners.select_nth_unstable_by(half as usize, |&a, &b| along(a).total_cmp(&along(b)));
        }
        let (before, after) = corners.split_at_mut(half as usize);
        self.fill(points, before, 2 * n + 1, first);
        self.fill(points, after, 2 * n + 2, first + half);
    }

    pub(super) fn has(&self, corner: u32) -> bool {
        self.leaves[corner as usize] != NONE
    }

    pub(super) fn remove(&mut self, corner: u32) {
        let leaf = std::mem::replace(&mut self.leaves[corner as usize], NONE);
        let mut node = Some(leaf).filter(|&leaf| leaf != NONE);
        while let Some(n) = node {
            self.nodes[n as usize].left -= 1;
            node = n.checked_sub(1).map(|n| n / 2);
        }
    }

    /// Whether such a one is among the corners that may be in a triangle, counter-clockwise, or on its edges.
    /// `looked` counts nodes and corners.
    pub(super) fn any(
        &self,
        triangle: [Coord<f64>; 3],
        looked: &mut usize,
        is: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        self.any_of(0, triangle, looked, is)
    }

    fn any_of(
        &self,
        n: usize,
        triangle: [Coord<f64>; 3],
        looked: &mut usize,
        is: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        let node = &self.nodes[n];
        *looked += 1;
        if node.left == 0 || node.is_beside(triangle) {
            return false;
        }
        if 2 * n + 2 < self.nodes.len() {
            return (2 * n + 1..=2 * n + 2).any(|child| self.any_of(child, triangle, looked, is));
        }
        let corners = &self.corners[node.corners.start as usize..node.corners.end as usize];
        corners.iter().filter(|&&i| self.has(i)).any(|&i| {
            *looked += 1;
            is(i)
        })
    }
}

impl Node {
    /// Whether the whole box lies behind an edge of the triangle, or beside the triangle's own box.
    fn is_beside(&self, [p, q, r]: [Coord<f64>; 3]) -> bool {
        let beside =
            |low: f64, high: f64, [a, b, c]: [f64; 3]| high < a.min(b).min(c) || low > a.max(b).max(c);
        // The corner of the box that is farthest to the left of an edge, where inside is.
        let farthest = |a: Coord<f64>, b: Coord<f64>| Coord {
            x: if b.y > a.y { self.low.x } else { self.high.x },
            y: if b.x > a.x { self.high.y } else { self.low.y },
        };
        beside(self.low.x, self.high.x, [p.x, q.x, r.x])
            || beside(self.low.y, self.high.y, [p.y, q.y, r.y])
            || [(p, q), (q, r), (r, p)].iter().any(|&(a, b)| orient2d(a, b, farthest(a, b)) < 0.0)
    }
}
