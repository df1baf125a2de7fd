//! The place of an object in a scene.

use crate::scene::normals::{dot, narrow, normalize};
use crate::scene::tangents;
use crate::scene::{HeightMap, Model, Relief};

/// First the scale, then the turns about x, y and z, then the shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    pub(crate) position: [f64; 3],
    /// Degrees about x, y and z, one after the other, counter-clockwise seen from the axis' end.
    pub(crate) rotation: [f64; 3],
    /// Not 0. Negative ones mirror.
    pub(crate) scale: [f64; 3],
}

impl Placement {
    /// The places of a model's points, counted from a new origin.
    pub(crate) fn places(&self, model: &Model, origin: [f64; 3]) -> impl Fn([f32; 3]) -> [f64; 3] + use<> {
        let (rows, scale) = (self.turned(), self.scale);
        let turned = move |v: [f64; 3]| {
            let scaled = [0, 1, 2].map(|axis| v[axis] * scale[axis]);
            rows.map(|row| dot(row, scaled))
        };
        let from = turned(model.origin);
        let shift = [0, 1, 2].map(|axis| from[axis] + self.position[axis] - origin[axis]);
        move |position| {
            let point = turned(position.map(f64::from));
            [0, 1, 2].map(|axis| point[axis] + shift[axis])
        }
    }

    /// Puts all vertices of a model there, counted from a new origin. Front faces stay front faces, and unit vectors
    /// stay unit vectors.
    ///
    /// Heights are stretched along the normal, as the parts of the surface are on average over their area: by their
    /// volume's growth over their area's. Where scales are unequal that is the mean on a curved surface, and that
    /// heights lean is left out.
    pub(crate) fn apply(&self, model: &mut Model, origin: [f64; 3]) {
        let still = Self { position: [0.0; 3], rotation: [0.0; 3], scale: [1.0; 3] };
        if *self == still && model.origin == origin {
            return;
        }
        let rows = self.turned();
        let turn = |v: [f64; 3]| rows.map(|row| dot(row, v));
        let scaled = |v: [f64; 3]| [0, 1, 2].map(|axis| v[axis] * self.scale[axis]);
        let unscaled = |v: [f64; 3]| [0, 1, 2].map(|axis| v[axis] / self.scale[axis]);
        let volume = self.scale.iter().product::<f64>();
        let mirrored = volume < 0.0;
        let areas: Vec<f64> = model.parts.iter().map(|part| tangents::area(&model.vertices, part)).collect();
        let place = self.places(model, origin);
        model.origin = origin;
        for vertex in &mut model.vertices {
            vertex.position = place(vertex.position).map(narrow);
            let normal = normalize(turn(unscaled(vertex.normal.map(f64::from)))).unwrap_or([0.0, 0.0, 1.0]);
            vertex.normal = normal.map(narrow);
            let [x, y, z, handedness] = vertex.tangent;
            let along = turn(scaled([x, y, z].map(f64::from)));
            // A scale that is not the same everywhere leaves no right angles.
            let off = dot(along, normal);
            let across = [0, 1, 2].map(|axis| along[axis] - normal[axis] * off);
            if let Some(tangent) = normalize(across) {
                let [x, y, z] = tangent.map(narrow);
                vertex.tangent = [x, y, z, if mirrored { -handedness } else { handedness }];
            }
        }
        // Normals are turned by the inverse transpose.
        let axis = |k: usize| {
            let unit = [0, 1, 2].map(|axis| if axis == k { 1.0 } else { 0.0 });
            turn(unscaled(unit)).map(narrow)
        };
        for (part, before) in model.parts.iter_mut().zip(areas) {
            if let Some(normal) = &mut part.detail.normal {
                normal.axes = [axis(0), axis(1), axis(2)];
            }
            // Displaced surfaces are where they should be.
            let after = tangents::area(&model.vertices, part);
            let extent = tangents::extent(&model.vertices, part);
            let drawn = |height: &&mut HeightMap| height.relief != Relief::Displacement && after > 0.0;
            if let Some(height) = part.detail.height.as_mut().filter(drawn) {
                let stretch = volume.abs() * before / after;
                height.range = height.range.map(|bound| narrow(f64::from(bound) * stretch));
                height.extent = extent;
            }
            if mirrored {
                part.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
            }
        }
    }

    /// The rows of the rotation.
    fn turned(&self) -> [[f64; 3]; 3] {
        let [[sx, cx], [sy, cy], [sz, cz]] = self.rotation.map(|degrees| {
            // Quarters are exact.
            let (quarters, rest) = ((degrees / 90.0).round(), degrees % 90.0);
            let (sine, cosine) = (degrees - 90.0 * quarters).to_radians().sin_cos();
            let exact = if rest.abs() <= 0.0 { (0.0, 1.0) } else { (sine, cosine) };
            match quarters.rem_euclid(4.0) {
                q if q < 0.5 => [exact.0, exact.1],
                q if q < 1.5 => [exact.1, -exact.0],
                q if q < 2.5 => [-exact.0, -exact.1],
                _ => [-exact.1, exact.0],
            }
        });
        [
            [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
            [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
            [-sy, cy * sx, cy * cx],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::normals::{cross, sub};
    use crate::scene::{Map, NormalMap, NormalSpace, Part, Vertex};

    const STILL: Placement = Placement { position: [0.0; 3], rotation: [0.0; 3], scale: [1.0; 3] };

    fn model() -> Model {
        let vertex = |position: [f32; 3]| Vertex {
            position,
            normal: [0.0, 0.0, 1.0],
            uv: [position[0], position[1]],
            tangent: [1.0, 0.0, 0.0, 1.0],
            ..Vertex::default()
        };
        let vertices = vec![vertex([1.0, 2.0, 3.0]), vertex([2.0, 2.0, 3.0]), vertex([1.0, 3.0, 3.0])];
        let parts = vec![Part { triangles: vec![[0, 1, 2]], ..Part::default() }];
        Model { vertices, parts, ..Model::default() }
    }

    fn first(placement: Placement) -> [f32; 3] {
        let mut model = model();
        placement.apply(&mut model, [0.0; 3]);
        model.vertices[0].position
    }

    #[test]
    fn turns_go_about_x_then_y_then_z() {
        assert_eq!(first(Placement { rotation: [90.0, 0.0, 0.0], ..STILL }), [1.0, -3.0, 2.0]);
        assert_eq!(first(Placement { rotation: [0.0, 90.0, 0.0], ..STILL }), [3.0, 2.0, -1.0]);
        assert_eq!(first(Placement { rotation: [0.0, 0.0, -270.0], ..STILL }), [-2.0, 1.0, 3.0]);
        assert_eq!(first(Placement { rotation: [90.0, 90.0, 0.0], ..STILL }), [2.0, -3.0, -1.0]);
        let all =
            Placement { position: [10.0, 0.0, 0.0], rotation: [0.0, 180.0, 0.0], scale: [2.0, 1.0, 1.0] };
        assert_eq!(first(all), [8.0, 2.0, -3.0]);
        let small = first(Placement { rotation: [0.0, 0.0, 30.0], ..STILL });
        let wanted = [0.75_f32.sqrt() - 1.0, 0.5 + 2.0 * 0.75_f32.sqrt(), 3.0];
        assert!(small.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6), "{small:?}");
    }

    #[test]
    fn normals_tangents_and_front_faces_go_along() {
        for scale in [[1.0, 1.0, 1.0], [-2.0, 1.0, 3.0], [1.0, -1.0, -1.0], [0.5, 4.0, -1.0]] {
            let mut model = model();
            Placement { position: [1.0, 2.0, 3.0], rotation: [20.0, 30.0, 40.0], scale }
                .apply(&mut model, [0.0; 3]);
            let [a, b, c] = model.parts[0].triangles[0].map(|i| model.vertices[i as usize]);
            let [p, q, r] = [a, b, c].map(|v| v.position.map(f64::from));
            let across = normalize(cross(sub(q, p), sub(r, p))).unwrap();
            assert!(dot(across, a.normal.map(f64::from)) > 1.0 - 1e-6, "{scale:?}");
            // u grows from vertex 0 to 1 of the file, v from 0 to 2, whichever way the triangle turns now.
            let at = |i: usize| model.vertices[i].position.map(f64::from);
            let (du, dv) = (sub(at(1), at(0)), sub(at(2), at(0)));
            let [x, y, z, w] = a.tangent.map(f64::from);
            assert!(dot(normalize(du).unwrap(), [x, y, z]) > 1.0 - 1e-6, "{scale:?}");
            let up = cross(a.normal.map(f64::from), [x, y, z]).map(|x| x * w);
            assert!(dot(normalize(dv).unwrap(), up) > 1.0 - 1e-6, "{scale:?}");
        }
    }

    #[test]
    fn normals_of_a_map_stay_across_what_is_stretched() {
        let map = Map { image: 0, filter: None, wrap: None };
        let space = NormalSpace::Object;
        let normal = NormalMap { map, space, strength: 1.0, axes: NormalMap::UNTURNED };
        for scale in [[2.0, 1.0, 4.0], [1.0, -3.0, 0.5], [-0.25, 5.0, 5.0]] {
            let mut model = model();
            model.parts[0].detail.normal = Some(normal);
            Placement { rotation: [20.0, 30.0, 40.0], scale, ..STILL }.apply(&mut model, [0.0; 3]);
            let axes = model.parts[0].detail.normal.unwrap().axes.map(|axis| axis.map(f64::from));
            // Of the plane x + 2y + 3z = 0, and two directions in it.
            let placed = [0, 1, 2].map(|k| axes[0][k] + 2.0 * axes[1][k] + 3.0 * axes[2][k]);
            let placed = normalize(placed).unwrap();
            let turn = Placement { rotation: [20.0, 30.0, 40.0], ..STILL }.turned();
            for along in [[2.0, -1.0, 0.0], [0.0, 3.0, -2.0]] {
                let moved = turn.map(|row| dot(row, [0, 1, 2].map(|k| along[k] * scale[k])));
                assert!(dot(placed, moved).abs() < 1e-6, "{scale:?}");
            }
            // And on the same side: that of a point above the plane.
            let above = turn.map(|row| dot(row, scale));
            assert!(dot(placed, above) > 0.0, "{scale:?}");
        }
    }

    #[test]
    fn heights_are_stretched_along_the_normal() {
        let placed = |relief, scale| {
            let mut model = model();
            let height = HeightMap { heights: 0, wrap: None, relief, range: [-1.0, 2.0], extent: [1.0; 2] };
            model.parts[0].detail.height = Some(height);
            Placement { rotation: [20.0, 30.0, 40.0], scale, ..STILL }.apply(&mut model, [0.0; 3]);
            model.parts[0].detail.height.unwrap()
        };
        // The triangle faces z, with u along x and v along y.
        for scale in [[1.0, 1.0, 3.0], [2.0, 5.0, 0.5], [-2.0, 2.0, 2.0], [7.0, 1.0, -1.0]] {
            let height = placed(Relief::Bump, scale);
            let [x, y, z] = scale.map(|s| narrow(s.abs()));
            let found = [height.extent[0], height.extent[1], height.range[0], height.range[1]];
            let right = found.iter().zip([x, y, -z, 2.0 * z]).all(|(a, b)| (a - b).abs() < 1e-5 * b.abs());
            assert!(right, "{scale:?} {height:?}");
        }
        // A displaced surface has grown with the object.
        assert_eq!(placed(Relief::Displacement, [1.0, 1.0, 3.0]).range, [-1.0, 2.0]);
    }
}
