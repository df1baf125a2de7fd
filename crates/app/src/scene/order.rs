//! The order of parts and of triangles: what is seen through comes after what is behind it.

use super::{Camera, Model, Part};
use alberti::raster::color::AnyBlend;

/// Puts parts that are mixed with what is behind them last, those farthest from the camera first; the others stay as
/// they are. The distance is that of the middle of a part's box along the line of sight. Within such a part, triangles
/// whose middles are farthest come first.
pub(crate) fn back_to_front(model: &mut Model, camera: &Camera) {
    if model.parts.iter().all(|part| part.detail.blend == AnyBlend::Replace) {
        return;
    }
    let forward = [0, 1, 2].map(|axis| f64::from(camera.target[axis]) - f64::from(camera.eye[axis]));
    let distance = |part: &Part| {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for vertex in part.triangles.iter().flatten().filter_map(|&k| model.vertices.get(k as usize)) {
            for (axis, c) in vertex.position.into_iter().map(f64::from).enumerate() {
                bounds[0][axis] = bounds[0][axis].min(c);
                bounds[1][axis] = bounds[1][axis].max(c);
            }
        }
        // A part without triangles is nowhere.
        let middle = [0, 1, 2].map(|axis| (bounds[0][axis] + bounds[1][axis]) / 2.0);
        (0..3).map(|axis| middle[axis] * forward[axis]).sum::<f64>()
    };
    let keys: Vec<Option<f64>> = model
        .parts
        .iter()
        .map(|part| (part.detail.blend != AnyBlend::Replace).then(|| distance(part)))
        .collect();
    let mut parts: Vec<_> = std::mem::take(&mut model.parts).into_iter().zip(keys).collect();
    parts.sort_by(|(_, a), (_, b)| match (a, b) {
        (Some(a), Some(b)) => b.total_cmp(a),
        _ => a.is_some().cmp(&b.is_some()),
    });
    let along = |index: &u32| {
        let place = model.vertices.get(*index as usize).map_or([0.0; 3], |v| v.position);
        (0..3).map(|axis| f64::from(place[axis]) * forward[axis]).sum::<f64>()
    };
    for (part, _) in parts.iter_mut().filter(|(_, key)| key.is_some()) {
        let far = |triangle: [u32; 3]| (triangle.iter().map(along).sum::<f64>(), triangle);
        let mut triangles: Vec<_> = std::mem::take(&mut part.triangles).into_iter().map(far).collect();
        triangles.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        part.triangles = triangles.into_iter().map(|(_, triangle)| triangle).collect();
    }
    model.parts = parts.into_iter().map(|(part, _)| part).collect();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Vertex;

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
