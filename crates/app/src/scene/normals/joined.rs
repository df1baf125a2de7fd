//! The corners that share a normal, and the faces that are flat.

use std::collections::HashMap;

use super::{Group, across, all, cross, dot, length, narrowed, normalize, sub};
use crate::scene::{Model, Vertex};

/// The turn in radians below which two triangles are parts of a flat face.
const FLAT: f64 = 1e-3;

/// The turn in radians from which on an edge is sharp that is smooth nevertheless: 75 degrees.
const SHARP: f64 = 1.309;

/// Triangles at one edge, each of which is compared with so many after it. More than two share it only where a surface
/// has branches, or two sides that both are modelled.
const NEIGHBOURS: usize = 8;

/// The corners and the triangles that belong together.
pub(super) struct Joined {
    /// For each corner the number of the set whose normal it gets.
    pub(super) sets: Vec<u32>,
    /// The number of sets.
    pub(super) count: usize,
    /// For each triangle the width of the flat face that it is of.
    pub(super) widths: Vec<f64>,
    /// For each corner whether it is joined to another across a sharp edge.
    pub(super) at_sharp: Vec<bool>,
}

pub(super) fn joined(model: &Model, groups: &[Group], crease: f32) -> Joined {
    let mut places = HashMap::with_capacity(model.vertices.len());
    let place_of = |vertex: &Vertex| {
        // Adding 0 makes -0 and 0 the same position.
        let next = u32::try_from(places.len()).unwrap_or(u32::MAX);
        *places.entry(vertex.position.map(|x| (x + 0.0).to_bits())).or_insert(next)
    };
    let places_of: Vec<u32> = model.vertices.iter().map(place_of).collect();
    let count = places.len();
    drop(places);
    let place = |index: u32| places_of[index as usize];
    let corners = 3 * model.parts.iter().map(|part| part.triangles.len()).sum::<usize>();
    let mut sets = Sets((0..u32::try_from(corners).unwrap_or(u32::MAX)).collect());

    let (mut numbered, mut polygon) = (HashMap::new(), (Group::ALONE, HashMap::new()));
    let mut has_edges = false;
    for ((triangle, &group), first) in all(model).zip(groups).zip((0_u32..).step_by(3)) {
        has_edges |= group.has_edges();
        if group == Group::ALONE {
            // One sum serves all three.
            sets.join(first, first + 1);
            sets.join(first, first + 2);
        }
        if group == Group::BY_ANGLE || group == Group::ALONE {
            continue;
        }
        for (corner, index) in (first..).zip(triangle) {
            let known = if group.0 < Group::POLYGONS {
                *numbered.entry((place(index), group.0)).or_insert(corner)
            } else {
                if polygon.0 != group {
                    polygon = (group, HashMap::new());
                }
                *polygon.1.entry(place(index)).or_insert(corner)
            };
            sets.join(known, corner);
        }
    }
    drop((numbered, polygon));
    let mut at_sharp = vec![false; corners];
    let mut faces = Faces::of(corners / 3);
    if has_edges {
        sets.join_across((&mut faces, &mut at_sharp), model, groups, f64::from(crease), count, place);
    }
    let widths = faces.widths(model);
    let (sets, count) = sets.number();
    Joined { sets, count, widths, at_sharp }
}

/// The triangles of flat faces.
struct Faces {
    sets: Sets,
    /// For each triangle the lengths of its sides that are within its face.
    within: Vec<f64>,
}

impl Faces {
    /// So many triangles alone.
    fn of(triangles: usize) -> Self {
        Self { sets: Sets((0..narrowed(triangles)).collect()), within: vec![0.0; triangles] }
    }

    /// Joins two triangles at a side of that length.
    fn join(&mut self, [one, other]: [u32; 2], side: f64) {
        self.sets.join(one, other);
        self.within[one as usize] += 2.0 * side;
    }

    /// The width of each triangle's face.
    fn widths(mut self, model: &Model) -> Vec<f64> {
        // The area and the outline of each face, at its first triangle.
        let mut sums = vec![[0.0; 2]; self.within.len()];
        for ((triangle, within), number) in all(model).zip(&self.within).zip(0..) {
            let [a, b, c] = triangle.map(|i| model.vertices[i as usize].position.map(f64::from));
            let around = [sub(b, a), sub(c, b), sub(a, c)].map(length).iter().sum::<f64>();
            let [area, outline] = &mut sums[self.sets.first_of(number) as usize];
            *area += length(across(model, triangle)) / 2.0;
            *outline += around - within;
        }
        let width = |number: u32| {
            let [area, outline] = sums[self.sets.first_of(number) as usize];
            // No outline is shorter than a circle's; sides that several triangles share may count too often.
            let shortest = 2.0 * (std::f64::consts::PI * area).sqrt();
            4.0 * area / outline.max(shortest).max(f64::MIN_POSITIVE)
        };
        (0..narrowed(sums.len())).map(width).collect()
    }
}

/// Things that belong together: each has another of its set, with a lower number, or itself.
struct Sets(Vec<u32>);

impl Sets {
    fn first_of(&mut self, mut one: u32) -> u32 {
        loop {
            let next = self.0[one as usize];
            if next == one {
                return one;
            }
            self.0[one as usize] = self.0[next as usize];
            one = next;
        }
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.first_of(a), self.first_of(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// Joins the corners at both ends of edges that are not sharp, and the triangles of flat faces.
    fn join_across(
        &mut self,
        (faces, at_sharp): (&mut Faces, &mut [bool]),
        model: &Model,
        groups: &[Group],
        crease: f64,
        places: usize,
        place: impl Fn(u32) -> u32,
    ) {
        // Each edge is known by its lower place: there, its other place, and the corner from which its triangle has it.
        let edges = || {
            let triangles = all(model).zip(groups).zip((0_u32..).step_by(3));
            triangles.filter(|((_, group), _)| group.has_edges()).flat_map(|((triangle, _), first)| {
                let [a, b, c] = triangle.map(&place);
                [(a, b, first), (b, c, first + 1), (c, a, first + 2)]
            })
        };
        let mut starts = vec![0_u32; places + 1];
        for (a, b, _) in edges().filter(|(a, b, _)| a != b) {
            starts[a.min(b) as usize + 1] += 1;
        }
        for i in 0..places {
            starts[i + 1] += starts[i];
        }
        let mut sorted = vec![(0_u32, 0_u32); starts[places] as usize];
        for (a, b, corner) in edges().filter(|(a, b, _)| a != b) {
            // The start moves on with each that is filled, and ends as that of the next.
            let at = &mut starts[a.min(b) as usize];
            sorted[*at as usize] = (a.max(b), corner);
            *at += 1;
        }
        let triangles: Vec<[u32; 3]> = all(model).collect();
        let sharp = crease.to_radians();
        let mut begin = 0;
        for (low, &end) in (0_u32..).zip(&starts[..places]) {
            let at_low = &mut sorted[begin..end as usize];
            begin = end as usize;
            at_low.sort_unstable();
            for edge in at_low.chunk_by(|a, b| a.0 == b.0).filter(|edge| edge.len() > 1) {
                for (i, &(_, one)) in edge.iter().enumerate() {
                    for &(_, other) in edge[i + 1..].iter().take(NEIGHBOURS) {
                        let of = |corner: u32| triangles[corner as usize / 3];
                        let normals = [one, other].map(|corner| normalize(across(model, of(corner))));
                        let [Some(a), Some(b)] = normals else { continue };
                        // Right for small angles too, where a cosine is not. A turn of the very angle is sharp,
                        // although its corners have been rounded.
                        let turn = length(cross(a, b)).atan2(dot(a, b));
                        let ends = |corner: u32| {
                            let next = corner - corner % 3 + (corner + 1) % 3;
                            let here = place(of(corner)[corner as usize % 3]) == low;
                            if here { [corner, next] } else { [next, corner] }
                        };
                        if turn < FLAT {
                            let at = |corner: u32| {
                                let index = of(corner)[corner as usize % 3];
                                model.vertices[index as usize].position.map(f64::from)
                            };
                            let [from, to] = ends(one).map(at);
                            faces.join([one / 3, other / 3], length(sub(to, from)));
                        }
                        let [group, next] = [one, other].map(|corner| groups[corner as usize / 3]);
                        let is_joined = group == next && (group != Group::BY_ANGLE || turn < sharp - 1e-5);
                        if is_joined && turn > SHARP {
                            for corner in [ends(one), ends(other)].concat() {
                                at_sharp[corner as usize] = true;
                            }
                        }
                        if !is_joined || group != Group::BY_ANGLE {
                            continue;
                        }
                        let (a, b) = (ends(one), ends(other));
                        self.join(a[0], b[0]);
                        self.join(a[1], b[1]);
                    }
                }
            }
        }
    }

    /// Numbers the sets without gaps.
    fn number(mut self) -> (Vec<u32>, usize) {
        for corner in 0..self.0.len() {
            // That of a lower corner is final.
            self.0[corner] = self.0[self.0[corner] as usize];
        }
        let mut count = 0;
        for corner in 0..self.0.len() {
            let first = self.0[corner] as usize;
            self.0[corner] = if first == corner {
                count += 1;
                count - 1
            } else {
                self.0[first]
            };
        }
        (self.0, count as usize)
    }
}
