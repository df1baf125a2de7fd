//! The places that things which move come to: the outermost of each at some moments, for what has to hold at all times.

use super::ground::bounds;
use super::normals::{dot, narrow};
use super::place::Placement;
use super::{Model, Part, Vertex};

/// The greatest component of a direction in which the outermost place is kept. Directions are 20 degrees apart at most:
/// of a ball nearly 2 % may be missing in the midst between them, and as much again of one that turns.
const FINENESS: i8 = 3;

/// The coordinates' own directions.
const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Places in the coordinates of files.
#[derive(Clone, Debug, Default)]
pub(crate) struct Swept {
    places: Vec<[f64; 3]>,
    /// The least and the greatest coordinates of each thing that moves.
    moving: Vec<[[f64; 3]; 2]>,
}

/// The same, counted from an origin.
#[derive(Clone, Debug)]
pub(crate) struct Reached {
    /// A model of all places. It has no surface.
    pub(crate) whole: Model,
    /// The least and the greatest coordinates of each thing that moves.
    pub(crate) moving: Vec<[[f64; 3]; 2]>,
}

impl Swept {
    /// Adds the outermost places of a thing, which comes to all of these: one of them, if it stands.
    pub(crate) fn add(&mut self, model: &Model, placements: &[Placement]) {
        let mut is_used = vec![false; model.vertices.len()];
        for &index in model.parts.iter().flat_map(|part| part.triangles.iter().flatten()) {
            if let Some(is_used) = is_used.get_mut(index as usize) {
                *is_used = true;
            }
        }
        let used = model.vertices.iter().zip(is_used).filter(|(_, is_used)| *is_used);
        let used: Vec<_> = used.map(|(vertex, _)| vertex.position.map(f64::from)).collect();
        let hull = outermost(used.iter().copied(), &directions());
        let placed = |of: &[[f64; 3]]| {
            let at = |placement: &Placement| {
                let place = placement.places(model, [0.0; 3]);
                of.iter().map(|v| place(v.map(narrow))).collect::<Vec<_>>()
            };
            placements.iter().flat_map(at).collect::<Vec<_>>()
        };
        if placements.len() < 2 {
            self.places.extend(placed(&hull));
            return;
        }
        // A ground stands still below the lowest of all.
        let mut ends = Vec::new();
        for placement in placements {
            let place = placement.places(model, [0.0; 3]);
            ends.extend(outermost(used.iter().map(|v| place(v.map(narrow))), &AXES));
        }
        let ends = outermost(ends.into_iter(), &AXES);
        self.moving.push(bounds(ends.iter().copied()));
        self.places.extend(ends);
        self.places.extend(outermost(placed(&hull).into_iter(), &directions()));
    }

    /// Whether a thing moves.
    pub(crate) fn moves(&self) -> bool {
        !self.moving.is_empty()
    }

    pub(crate) fn counted_from(&self, origin: [f64; 3]) -> Reached {
        let from = |place: [f64; 3]| [0, 1, 2].map(|k| place[k] - origin[k]);
        let vertex = |&place: &[f64; 3]| Vertex { position: from(place).map(narrow), ..Vertex::default() };
        let vertices: Vec<_> = self.places.iter().map(vertex).collect();
        let triangles = (0..).take(vertices.len()).map(|index| [index; 3]).collect();
        let parts = vec![Part { triangles, ..Part::default() }];
        let whole = Model { vertices, parts, origin, ..Model::default() };
        Reached { whole, moving: self.moving.iter().map(|bounds| bounds.map(from)).collect() }
    }
}

/// One of each direction and the opposite one: others are as many times as long.
fn directions() -> Vec<[f64; 3]> {
    let range = || -FINENESS..=FINENESS;
    let all = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
    all.filter(|d| *d > [0; 3] && divisor(divisor(d[0], d[1]), d[2]) == 1).map(|d| d.map(f64::from)).collect()
}

/// The outermost of some places both ways along each of these directions.
fn outermost(places: impl Iterator<Item = [f64; 3]>, along: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let none = [(f64::INFINITY, [0.0; 3]), (f64::NEG_INFINITY, [0.0; 3])];
    let mut ends = vec![none; along.len()];
    for place in places {
        for (along, [least, most]) in along.iter().zip(&mut ends) {
            let at = dot(*along, place);
            if at < least.0 {
                *least = (at, place);
            }
            if at > most.0 {
                *most = (at, place);
            }
        }
    }
    ends.into_iter().flatten().filter(|(at, _)| at.is_finite()).map(|(_, place)| place).collect()
}

/// The greatest common divisor.
fn divisor(a: i8, b: i8) -> i8 {
    if b == 0 { a.abs() } else { divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A ball, at two places: in any direction nearly as far as it is.
    #[test]
    fn the_outermost_places_are_nearly_as_far_out_as_all() {
        let ball = |middle: [f64; 3], origin: [f64; 3]| {
            let place = |k: u32| {
                let [across, down] = [k % 64, k / 64].map(|k| f64::from(k) * TAU / 64.0);
                let ring = (down / 2.0).sin();
                let at = [ring * across.cos(), (down / 2.0).cos(), ring * across.sin()];
                [0, 1, 2].map(|k| narrow(at[k] + middle[k] - origin[k]))
            };
            let vertices = (0..65 * 64).map(|k| Vertex { position: place(k), ..Vertex::default() }).collect();
            let triangles = (0..65 * 64).map(|k| [k; 3]).collect();
            Model { vertices, parts: vec![Part { triangles, ..Part::default() }], origin, ..Model::default() }
        };
        let middles = [[0.0; 3], [3.0, 1.0, -2.0]];
        let mut swept = Swept::default();
        let still = Placement { position: [0.0; 3], rotation: [0.0; 3], scale: [1.0; 3] };
        swept.add(&ball(middles[0], [0.0; 3]), &[still]);
        assert!(!swept.moves());
        // It rises, and is turned meanwhile.
        let turned = Placement { position: [0.0, 2.0, 0.0], rotation: [0.0, 90.0, 0.0], ..still };
        swept.add(&ball(middles[1], [2.0, 1.0, 0.0]), &[still, turned]);
        let middles = [middles[0], middles[1], [-2.0, 3.0, -3.0]];
        let origin = [1.0, 2.0, 3.0];
        let Reached { whole: model, moving } = swept.counted_from(origin);
        let [box_of_both] = &moving[..] else { panic!("{moving:?}") };
        let right =
            [[-3.0, 0.0, -4.0], [4.0, 4.0, -1.0]].map(|place| [0, 1, 2].map(|k| place[k] - origin[k]));
        let off = box_of_both.iter().flatten().zip(right.iter().flatten()).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 2e-3, "{box_of_both:?}");
        assert!(model.vertices.len() < 1000, "{}", model.vertices.len());
        for k in 0..1000_u32 {
            let [across, down] = [k % 40, k / 40].map(|k| f64::from(k) * TAU / 40.0);
            let along = [across.cos() * down.sin(), down.cos(), across.sin() * down.sin()];
            let found = model.vertices.iter().map(|v| {
                let place = v.position.map(f64::from);
                dot(along, [0, 1, 2].map(|k| place[k] + origin[k]))
            });
            let found = found.fold(f64::NEG_INFINITY, f64::max);
            let right = middles.map(|middle| dot(along, middle) + 1.0).into_iter().fold(f64::MIN, f64::max);
            assert!((right - 0.04..right + 1e-5).contains(&found), "{along:?}: {found}, not {right}");
        }
    }
}
