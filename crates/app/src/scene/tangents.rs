//! Tangents for vertices whose surface has a map that needs them, and how large textures are on surfaces.

use std::collections::HashMap;

use alberti::glam::{Vec2, Vec3};
use alberti::math::{Object, Point3, Vector3};
use alberti::texture::surface::{frame_of_tangent, mikktspace, vertex_tangents};

use crate::scene::normals::{cross, length, narrow, sub};
use crate::scene::{Model, Part, Relief, Vertex};

/// Gives the vertices of each of `these` parts tangents by MikkTSpace, in which most normal maps are made, unless
/// they have some. A vertex whose triangles ask for different ones, as at the seam of a mirrored texture, becomes
/// several. Where the texture has no area, any direction on the surface does. A displaced part gets the mean of its
/// triangles' tangents.
///
/// # Cost
/// Some 500 bytes a triangle while it runs, 40 a vertex for a displaced part; nothing for other parts.
pub(crate) fn complete(model: &mut Model, these: impl Fn(&Part) -> bool) {
    let Model { vertices, parts, .. } = model;
    let mut split: HashMap<(u32, [u32; 4]), u32> = HashMap::new();
    for part in parts.iter_mut().filter(|part| these(part)) {
        let all = part.triangles.iter().flatten();
        if all.clone().all(|&i| vertices[i as usize].tangent[3].abs() > 0.0) {
            continue;
        }
        let positions: Vec<_> = vertices.iter().map(|v| Vec3::from_array(v.position)).collect();
        let normals: Vec<_> = vertices.iter().map(|v| Vec3::from_array(v.normal)).collect();
        let uvs: Vec<_> = vertices.iter().map(|v| Vec2::from_array(v.uv)).collect();
        if part.detail.height.is_some_and(|height| height.relief == Relief::Displacement) {
            // No tool has made a map for these triangles, of which there may be millions.
            let mut tangents = vec![[0.0; 4]; vertices.len()];
            if vertex_tangents(&positions, &normals, &uvs, &part.triangles, &mut tangents).is_ok() {
                for &i in part.triangles.iter().flatten() {
                    vertices[i as usize].tangent = tangents[i as usize];
                }
            }
            continue;
        }
        let mut corners = vec![[[0.0; 4]; 3]; part.triangles.len()];
        // The buffers are of one length.
        if mikktspace(&positions, &normals, &uvs, &part.triangles, &mut corners).is_err() {
            continue;
        }
        let indices = part.triangles.iter_mut().flatten();
        for (index, tangent) in indices.zip(corners.into_iter().flatten()) {
            let vertex = vertices[*index as usize];
            let tangent = on_surface(&vertex, tangent);
            let key = (*index, tangent.map(f32::to_bits));
            *index = *split.entry(key).or_insert_with(|| {
                if vertex.tangent[3].abs() > 0.0 {
                    vertices.push(Vertex { tangent, ..vertex });
                    u32::try_from(vertices.len() - 1).unwrap_or(*index)
                } else {
                    vertices[*index as usize].tangent = tangent;
                    *index
                }
            });
        }
    }
}

/// The tangent itself where it is across the normal, as it is but where nothing says how the texture lies.
fn on_surface(vertex: &Vertex, tangent: [f32; 4]) -> [f32; 4] {
    let normal = Vec3::from_array(vertex.normal);
    if normal.dot(Vec3::new(tangent[0], tangent[1], tangent[2])).abs() < 0.01 {
        return tangent;
    }
    let point = Point3::<Object>::new(Vec3::from_array(vertex.position));
    let [x, y, z] = frame_of_tangent(point, Vector3::new(normal), tangent).axes().x_axis.to_array();
    [x, y, z, tangent[3]]
}

/// The lengths of a unit of u and of v on a part, on average over its area; 1 for a texture without area.
pub(crate) fn extent(vertices: &[Vertex], part: &Part) -> [f32; 2] {
    let (mut sums, mut area) = ([0.0; 2], 0.0);
    for triangle in &part.triangles {
        let [a, b, c] = triangle.map(|i| vertices[i as usize]);
        let [p, q, r] = [a, b, c].map(|v| v.position.map(f64::from));
        let [s, t, w] = [a, b, c].map(|v| v.uv.map(f64::from));
        let (e1, e2) = (sub(q, p), sub(r, p));
        let (d1, d2) = ([t[0] - s[0], t[1] - s[1]], [w[0] - s[0], w[1] - s[1]]);
        let doubled = d1[0] * d2[1] - d1[1] * d2[0];
        let along = |f: f64, g: f64| length([0, 1, 2].map(|axis| (e1[axis] * f - e2[axis] * g) / doubled));
        let lengths = [along(d2[1], d1[1]), along(d2[0], d1[0])];
        let weight = length(cross(e1, e2));
        if lengths.into_iter().all(f64::is_finite) && weight > 0.0 {
            area += weight;
            sums = [sums[0] + lengths[0] * weight, sums[1] + lengths[1] * weight];
        }
    }
    sums.map(|sum| if sum > 0.0 && area > 0.0 { narrow(sum / area) } else { 1.0 })
}

/// The area of a part.
pub(crate) fn area(vertices: &[Vertex], part: &Part) -> f64 {
    let doubled = part.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|i| vertices[i as usize].position.map(f64::from));
        length(cross(sub(b, a), sub(c, a)))
    });
    doubled.sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Detail, HeightMap, Map, NormalMap, NormalSpace};

    fn mapped() -> Detail {
        let map = Map { image: 0, filter: None, wrap: None };
        let space = NormalSpace::Tangent;
        let normal = NormalMap { map, space, strength: 1.0, axes: NormalMap::UNTURNED };
        Detail { normal: Some(normal), ..Detail::default() }
    }

    /// Two triangles in the plane z = 0 that share the edge x = 0, with u = |x| on both.
    fn mirrored() -> Model {
        let vertex =
            |position: [f32; 3], uv| Vertex { position, normal: [0.0, 0.0, 1.0], uv, ..Vertex::default() };
        let vertices = vec![
            vertex([0.0, 0.0, 0.0], [0.0, 0.0]),
            vertex([0.0, 2.0, 0.0], [0.0, 1.0]),
            vertex([1.0, 0.0, 0.0], [1.0, 0.0]),
            vertex([-1.0, 0.0, 0.0], [1.0, 0.0]),
        ];
        let part = Part { triangles: vec![[0, 2, 1], [0, 1, 3]], detail: mapped(), ..Part::default() };
        Model { vertices, parts: vec![part], ..Model::default() }
    }

    #[test]
    fn mirrored_textures_have_both_tangents_at_their_seam() {
        let mut model = mirrored();
        complete(&mut model, |part| part.detail.needs_tangents());
        assert_eq!(model.vertices.len(), 6);
        let tangents = |t: usize| model.parts[0].triangles[t].map(|i| model.vertices[i as usize].tangent);
        assert_eq!(tangents(0), [[1.0, 0.0, 0.0, 1.0]; 3]);
        assert_eq!(tangents(1), [[-1.0, 0.0, 0.0, -1.0]; 3]);
        // Twice is as once.
        let before = model.clone();
        complete(&mut model, |part| part.detail.needs_tangents());
        assert_eq!(model, before);
    }

    #[test]
    fn displaced_parts_have_tangents_too() {
        let mut model = mirrored();
        let map = HeightMap {
            heights: 0,
            wrap: None,
            relief: Relief::Displacement,
            range: [0.0, 1.0],
            extent: [1.0; 2],
        };
        model.parts[0].detail.height = Some(map);
        model.parts[0].triangles.pop();
        complete(&mut model, |part| part.detail.needs_tangents());
        assert!(
            model.parts[0].triangles[0]
                .iter()
                .all(|&i| model.vertices[i as usize].tangent == [1.0, 0.0, 0.0, 1.0])
        );
    }

    #[test]
    fn surfaces_without_such_maps_are_left_alone() {
        let mut model = mirrored();
        model.parts[0].detail = Detail::default();
        let before = model.clone();
        complete(&mut model, |part| part.detail.needs_tangents());
        assert_eq!(model, before);
    }

    #[test]
    fn without_an_area_in_the_texture_a_tangent_still_lies_on_the_surface() {
        let mut model = mirrored();
        for vertex in &mut model.vertices {
            vertex.uv = [0.0; 2];
            // Turned, so that the default tangent is the normal.
            let [x, y, z] = vertex.position;
            (vertex.position, vertex.normal) = ([z, y, -x], [1.0, 0.0, 0.0]);
        }
        complete(&mut model, |part| part.detail.needs_tangents());
        for vertex in &model.vertices {
            let [x, y, z, _] = vertex.tangent;
            assert!(x.abs() < 1e-6 && (y * y + z * z - 1.0).abs() < 1e-6, "{vertex:?}");
        }
    }

    #[test]
    fn an_extent_is_the_length_of_a_unit_of_texture() {
        let mut model = mirrored();
        assert_eq!(extent(&model.vertices, &model.parts[0]), [1.0, 2.0]);
        model.vertices.iter_mut().for_each(|v| v.uv = [0.0; 2]);
        assert_eq!(extent(&model.vertices, &model.parts[0]), [1.0, 1.0]);
    }
}
