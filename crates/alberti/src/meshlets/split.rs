//! Meshes divided into meshlets, on a machine with memory to spare.

use super::{Ball, Meshlet};
use crate::geometry::Geometry;
use alberti_math::glam::Vec3;
use core::ops::Range;
use std::vec::Vec;

/// A mesh's triangles in another order, in which those of a meshlet follow each other.
#[derive(Clone, Debug, Default)]
pub struct Split {
    /// The triangles; without those with a vertex that is not there.
    pub triangles: Vec<[u32; 3]>,
    /// Those of each meshlet.
    pub meshlets: Vec<Range<u32>>,
}

impl Split {
    /// Divides a mesh with these places of its vertices into meshlets of at most so many triangles. They are grown from
    /// triangle to triangle, such as have their vertices, are near, and face the same way.
    ///
    /// # Cost
    /// That of sorting the triangles, and of a few hundred operations for each.
    #[must_use]
    pub fn new(places: &[Vec3], triangles: &[[u32; 3]], most: usize) -> Self {
        let mut growth = Growth::new(places, triangles);
        let mut split = Self::default();
        for seed in 0..growth.triangles.len() {
            if !growth.used[seed] {
                growth.meshlet(seed, most, &mut split);
            }
        }
        split
    }

    /// The meshlets of the mesh of these triangles, and the ball around it.
    #[must_use]
    pub fn bounds(&self, mesh: &impl Geometry) -> (Vec<Meshlet>, Ball) {
        let ball = Ball::of(mesh);
        (self.meshlets.iter().map(|triangles| Meshlet::new(mesh, &ball, triangles.clone())).collect(), ball)
    }
}

/// The price of a triangle whose centre is as far from the meshlet's as triangles are wide, where a vertex more is 1.
const FAR: f32 = 0.1;
/// The price of a triangle whose normal is at a right angle to the mean of the meshlet's.
const TURNED: f32 = 25.0;

/// The state of a division.
struct Growth<'a> {
    places: &'a [Vec3],
    triangles: Vec<[u32; 3]>,
    used: Vec<bool>,
    /// The triangles of each vertex, from `first[vertex]` to `first[vertex + 1]`.
    first: Vec<usize>,
    around: Vec<usize>,
    /// Of each vertex the last meshlet that has it.
    meshlet: Vec<usize>,
    /// The mean distance of vertices that a triangle joins.
    side: f32,
}

impl<'a> Growth<'a> {
    fn new(places: &'a [Vec3], triangles: &[[u32; 3]]) -> Self {
        let there = |index: u32| (index as usize) < places.len();
        let triangles: Vec<_> = triangles.iter().copied().filter(|t| t.iter().all(|&i| there(i))).collect();
        let mut first = std::vec![0; places.len() + 1];
        for &vertex in triangles.as_flattened() {
            first[vertex as usize + 1] += 1;
        }
        for vertex in 0..places.len() {
            first[vertex + 1] += first[vertex];
        }
        let mut next = first.clone();
        let mut around = std::vec![0; triangles.len() * 3];
        for (triangle, vertices) in triangles.iter().enumerate() {
            for &vertex in vertices {
                around[next[vertex as usize]] = triangle;
                next[vertex as usize] += 1;
            }
        }
        let sides = triangles.iter().map(|&[a, b, _]| places[a as usize].distance(places[b as usize]));
        #[expect(clippy::cast_precision_loss, reason = "a mean")]
        let side = sides.sum::<f32>() / triangles.len().max(1) as f32;
        let used = std::vec![false; triangles.len()];
        Self { places, used, first, around, meshlet: std::vec![0; places.len()], side, triangles }
    }

    /// The centre and the normal of a triangle.
    fn plane(&self, triangle: usize) -> [Vec3; 2] {
        let [a, b, c] = self.triangles[triangle].map(|vertex| self.places[vertex as usize]);
        [(a + b + c) / 3.0, (b - a).cross(c - a).normalize_or_zero()]
    }

    /// Appends the meshlet that grows from a triangle.
    fn meshlet(&mut self, seed: usize, most: usize, split: &mut Split) {
        let first = split.triangles.len();
        let number = split.meshlets.len() + 1;
        let (mut border, mut sum) = (Vec::from([seed]), [Vec3::ZERO; 2]);
        loop {
            let count = split.triangles.len() - first;
            border.retain(|&triangle| !self.used[triangle]);
            #[expect(clippy::cast_precision_loss, reason = "a mean")]
            let (center, axis) = (sum[0] / count.max(1) as f32, sum[1].normalize_or_zero());
            let cost = |triangle: usize| {
                let [place, normal] = self.plane(triangle);
                let missing = |vertex: &&u32| self.meshlet[**vertex as usize] != number;
                #[expect(clippy::cast_precision_loss, reason = "at most 3")]
                let missing = self.triangles[triangle].iter().filter(missing).count() as f32;
                missing + FAR * place.distance(center) / self.side + TURNED * (1.0 - normal.dot(axis))
            };
            let best = border.iter().copied().min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
            let Some(triangle) = best.filter(|_| count < most.max(1)) else { break };
            let [place, normal] = self.plane(triangle);
            sum = [sum[0] + place, sum[1] + normal];
            self.used[triangle] = true;
            let vertices = self.triangles[triangle];
            split.triangles.push(vertices);
            for vertex in vertices.map(|vertex| vertex as usize) {
                self.meshlet[vertex] = number;
                border.extend(&self.around[self.first[vertex]..self.first[vertex + 1]]);
            }
            border.sort_unstable();
            border.dedup();
        }
        #[expect(clippy::cast_possible_truncation, reason = "numbers of triangles of 32 bits")]
        split.meshlets.push(first as u32..split.triangles.len() as u32);
    }
}
