//! The order of parts and of triangles: what is seen through comes after what is behind it.

use super::normals::{cross, dot, sub};
use super::{Camera, Model, Part};
use alberti::raster::color::AnyBlend;

/// The end of a part that says how far it is.
#[derive(Clone, Copy, PartialEq)]
enum End {
    Middle,
    /// That of a half that faces away.
    Far,
    /// That of a half that faces the camera.
    Near,
}

/// Puts parts that are mixed with what is behind them last, those farthest from the camera first; the others stay as
/// they are. The distance is that of the middle of a part's box along the line of sight. Within such a part, triangles
/// whose middles are farthest come first.
pub(crate) fn back_to_front(model: &mut Model, camera: &Camera) {
    let ends = vec![End::Middle; model.parts.len()];
    sort(model, camera, &ends);
}

/// [`back_to_front`] with two halves of each such part: what faces away from the camera, by its far end, and what faces
/// it, by its near end. So shells within each other have an order, from the far side of the outer to its near side.
/// `eye` is where the camera is, or without a place the direction towards it.
pub(crate) fn shells(model: &mut Model, camera: &Camera, eye: Result<[f64; 3], [f64; 3]>) {
    let Model { vertices, parts, .. } = model;
    let faces = |triangle: &[u32; 3]| {
        let place = |k: u32| vertices.get(k as usize).map_or([0.0; 3], |v| v.position.map(f64::from));
        let [a, b, c] = triangle.map(place);
        dot(cross(sub(b, a), sub(c, a)), eye.map_or_else(|towards| towards, |eye| sub(eye, a))) > 0.0
    };
    let (mut halves, mut ends) = (Vec::new(), vec![End::Middle; parts.len()]);
    for (part, end) in parts.iter_mut().zip(&mut ends).filter(|(part, _)| is_mixed(part)) {
        let (near, far): (Vec<_>, Vec<_>) = std::mem::take(&mut part.triangles).into_iter().partition(faces);
        if near.is_empty() || far.is_empty() {
            part.triangles = if near.is_empty() { far } else { near };
            continue;
        }
        halves.push(Part { triangles: near, ..part.clone() });
        (part.triangles, *end) = (far, End::Far);
    }
    ends.extend(halves.iter().map(|_| End::Near));
    parts.append(&mut halves);
    sort(model, camera, &ends);
}

/// Whether something of a model is mixed with what is behind it, so that the order of its parts counts.
pub(crate) fn counts(model: &Model) -> bool {
    model.parts.iter().any(is_mixed)
}

/// Whether a part is mixed with what is behind it.
fn is_mixed(part: &Part) -> bool {
    part.detail.blend != AnyBlend::Replace
}

fn sort(model: &mut Model, camera: &Camera, ends: &[End]) {
    if !counts(model) {
        return;
    }
    let forward = [0, 1, 2].map(|axis| f64::from(camera.target[axis]) - f64::from(camera.eye[axis]));
    let along = |place: [f32; 3]| dot(place.map(f64::from), forward);
    let distance = |(part, end): (&Part, &End)| {
        let places = part.triangles.iter().flatten().filter_map(|&k| model.vertices.get(k as usize));
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for vertex in places {
            for (axis, c) in vertex.position.into_iter().map(f64::from).enumerate() {
                bounds[0][axis] = bounds[0][axis].min(c);
                bounds[1][axis] = bounds[1][axis].max(c);
            }
            let far = along(vertex.position);
            range = [range[0].min(far), range[1].max(far)];
        }
        match end {
            // A part without triangles is nowhere.
            End::Middle => dot([0, 1, 2].map(|axis| (bounds[0][axis] + bounds[1][axis]) / 2.0), forward),
            End::Far => range[1],
            End::Near => range[0],
        }
    };
    let keys = model.parts.iter().zip(ends);
    let keys: Vec<_> = keys.map(|(part, end)| is_mixed(part).then(|| distance((part, end)))).collect();
    let mut parts: Vec<_> = std::mem::take(&mut model.parts).into_iter().zip(keys).collect();
    parts.sort_by(|(_, a), (_, b)| match (a, b) {
        (Some(a), Some(b)) => b.total_cmp(a),
        _ => a.is_some().cmp(&b.is_some()),
    });
    let along = |index: &u32| along(model.vertices.get(*index as usize).map_or([0.0; 3], |v| v.position));
    for (part, _) in parts.iter_mut().filter(|(_, key)| key.is_some()) {
        let far = |triangle: [u32; 3]| (triangle.iter().map(along).sum::<f64>(), triangle);
        let mut triangles: Vec<_> = std::mem::take(&mut part.triangles).into_iter().map(far).collect();
        triangles.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        part.triangles = triangles.into_iter().map(|(_, triangle)| triangle).collect();
    }
    model.parts = parts.into_iter().map(|(part, _)| part).collect();
}

/// Puts a part before all that are mixed with what is behind them: it is behind them all.
pub(crate) fn behind_all(model: &mut Model, part: Part) {
    let at = model.parts.iter().position(is_mixed).unwrap_or(model.parts.len());
    model.parts.insert(at, part);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Vertex;

    /// Two boxes of which one is in the other, seen from z: far sides from the outer on, then near sides.
    #[test]
    fn shells_are_mixed_from_the_outside_in_and_out_again() {
        let corner = |k: u32, size: f32| {
            let place = [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { size } else { -size });
            Vertex { position: place, ..Vertex::default() }
        };
        // All sides of both boxes, each facing outwards: those along z reach from the far to the near end.
        let vertices = [3.0, 1.0].into_iter().flat_map(|size| (0..8).map(move |k| corner(k, size))).collect();
        let part = |first: u32| {
            let sides = [[4, 5, 7, 6], [0, 2, 3, 1], [1, 3, 7, 5], [0, 4, 6, 2], [2, 6, 7, 3], [0, 1, 5, 4]];
            let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
            let triangles = sides.into_iter().flat_map(halves);
            let triangles = triangles.map(|side| side.map(|k| first + k)).collect();
            let mut part = Part { name: first.to_string(), triangles, ..Part::default() };
            part.detail.blend = AnyBlend::Constant(128);
            part
        };
        let camera = Camera {
            eye: [0.0, 0.0, 9.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 40.0,
            near: 1.0,
            far: 20.0,
        };
        for order in [[0, 8], [8, 0]] {
            for eye in [Ok(camera.eye.map(f64::from)), Err([0.0, 0.0, 1.0])] {
                let mut model = Model {
                    vertices: Vec::clone(&vertices),
                    parts: order.map(part).to_vec(),
                    ..Model::default()
                };
                shells(&mut model, &camera, eye);
                let found: Vec<_> =
                    model.parts.iter().map(|part| (part.name.as_str(), part.triangles[0][0] & 4)).collect();
                assert_eq!(found, [("0", 0), ("8", 0), ("8", 4), ("0", 4)]);
            }
        }
    }

    #[test]
    fn within_a_part_the_farthest_triangle_comes_first() {
        let vertices: Vec<_> =
            [2.0, 7.0, 4.0].map(|z| Vertex { position: [0.0, 0.0, -z], ..Vertex::default() }).to_vec();
        let mut part = Part { triangles: vec![[0; 3], [0, 1, 1], [2; 3], [1; 3]], ..Part::default() };
        let solid = part.clone();
        part.detail.blend = AnyBlend::Over;
        let mut model = Model { vertices, parts: vec![part, solid], ..Model::default() };
        let camera = Camera {
            eye: [0.0; 3],
            target: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 40.0,
            near: 0.1,
            far: 20.0,
        };
        back_to_front(&mut model, &camera);
        assert_eq!(model.parts[0].triangles, [[0; 3], [0, 1, 1], [2; 3], [1; 3]]);
        assert_eq!(model.parts[1].triangles, [[1; 3], [0, 1, 1], [2; 3], [0; 3]]);
    }

    #[test]
    fn what_is_mixed_comes_last_and_the_farthest_first() {
        let (vertices, mut parts): (Vec<_>, Vec<_>) = [(1.0, true), (9.0, false), (5.0, true), (2.0, false)]
            .into_iter()
            .zip(0..)
            .map(|((distance, mixed), k)| {
                let mut part = Part { name: k.to_string(), triangles: vec![[k; 3]], ..Part::default() };
                part.detail.blend = if mixed { AnyBlend::Over } else { AnyBlend::Replace };
                (Vertex { position: [0.0, 0.0, -distance], ..Vertex::default() }, part)
            })
            .unzip();
        parts.push(Part { name: "none".into(), ..parts[0].clone() });
        parts[4].triangles.clear();
        let mut model = Model { vertices, parts, ..Model::default() };
        let camera = |z| Camera {
            eye: [0.0; 3],
            target: [0.0, 0.0, z],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 40.0,
            near: 0.1,
            far: 20.0,
        };
        let mut order = |z| {
            back_to_front(&mut model, &camera(z));
            let names = model.parts.iter().map(|part| part.name.clone());
            names.filter(|name| name != "none").collect::<Vec<_>>()
        };
        assert_eq!(order(-1.0), ["1", "3", "2", "0"]);
        // From the other side.
        assert_eq!(order(1.0), ["1", "3", "0", "2"]);
    }
}
