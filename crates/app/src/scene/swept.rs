//! The places that things which move come to: the outermost of some moments, for what has to hold at all times.

use super::normals::{dot, narrow};
use super::{Model, Part, Vertex};

/// The greatest component of a direction in which the outermost place is kept. Directions are 20 degrees apart at most:
/// of a ball nearly 2 % may be missing in the midst between them.
const FINENESS: i8 = 3;

/// Places in the coordinates of files.
#[derive(Clone, Debug, Default)]
pub(crate) struct Swept(Vec<[f64; 3]>);

impl Swept {
    /// Adds the outermost places of a model.
    pub(crate) fn add(&mut self, model: &Model) {
        let range = || -FINENESS..=FINENESS;
        let all = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
        // One of each direction; the others are as many times as long.
        let directions = all.filter(|d| divisor(divisor(d[0], d[1]), d[2]) == 1).map(|d| d.map(f64::from));
        let mut ends: Vec<_> = directions.map(|along| (along, f64::NEG_INFINITY, None)).collect();
        for triangle in model.parts.iter().flat_map(|part| &part.triangles) {
            for vertex in triangle.iter().filter_map(|&index| model.vertices.get(index as usize)) {
                let place = vertex.position.map(f64::from);
                for (along, most, end) in &mut ends {
                    let reach = dot(*along, place);
                    if reach > *most {
                        (*most, *end) = (reach, Some(place));
                    }
                }
            }
        }
        let places = ends.into_iter().filter_map(|(.., end)| end);
        self.0.extend(places.map(|place| [0, 1, 2].map(|k| place[k] + model.origin[k])));
    }

    /// A model of these places, counted from an origin. It has no surface.
    pub(crate) fn model(&self, origin: [f64; 3]) -> Model {
        let position = |place: &[f64; 3]| [0, 1, 2].map(|k| narrow(place[k] - origin[k]));
        let vertices = self.0.iter().map(|place| Vertex { position: position(place), ..Vertex::default() });
        let vertices: Vec<_> = vertices.collect();
        let triangles = (0..).take(vertices.len()).map(|index| [index; 3]).collect();
        Model { vertices, parts: vec![Part { triangles, ..Part::default() }], origin, ..Model::default() }
    }
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
        swept.add(&ball(middles[0], [0.0; 3]));
        swept.add(&ball(middles[1], [2.0, 1.0, 0.0]));
        let origin = [1.0, 2.0, 3.0];
        let model = swept.model(origin);
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
            assert!((right - 0.03..right + 1e-5).contains(&found), "{along:?}: {found}, not {right}");
        }
    }
}
