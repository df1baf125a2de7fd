//! Normals for vertices that have none.

use std::collections::HashMap;

use crate::scene::Model;

/// Normalizes the model's normals, and gives each vertex whose normal is (0, 0, 0) a smooth one. That is the mean of
/// the normals of the triangles at its position, weighted by their angles there (Thürmer and Wüthrich, Computing vertex
/// normals from polygonal facets, 1998). So the result depends on the surface, not on how a polygon was cut into
/// triangles or where a seam in the texture parts two vertices. Triangles of all parts count.
///
/// Where the mean vanishes, at a vertex of degenerate triangles only or of a folded surface, it is (0, 0, 1).
///
/// # Cost
/// Linear in vertices and triangles; one hash table entry a vertex, and nothing where no normal is missing.
pub fn complete(model: &mut Model) {
    let mut missing = false;
    for vertex in &mut model.vertices {
        let unit = normalize(vertex.normal.map(f64::from)).unwrap_or([0.0; 3]);
        vertex.normal = unit.map(narrow);
        missing |= unit == [0.0; 3];
    }
    if !missing {
        return;
    }
    let mut sums: Vec<[f64; 3]> = Vec::new();
    let mut sum_at = HashMap::with_capacity(model.vertices.len());
    let sum_of: Vec<usize> = model
        .vertices
        .iter()
        .map(|vertex| {
            // Adding 0 makes -0 and 0 the same position.
            let key = vertex.position.map(|x| (x + 0.0).to_bits());
            *sum_at.entry(key).or_insert_with(|| {
                sums.push([0.0; 3]);
                sums.len() - 1
            })
        })
        .collect();
    for triangle in model.parts.iter().flat_map(|part| &part.triangles) {
        let corners = triangle.map(|i| i as usize);
        let points = corners.map(|i| model.vertices[i].position.map(f64::from));
        for i in 0..3 {
            let to_next = sub(points[(i + 1) % 3], points[i]);
            let to_last = sub(points[(i + 2) % 3], points[i]);
            let across = cross(to_next, to_last);
            let (Some(normal), sine) = (normalize(across), length(across)) else { continue };
            let angle = sine.atan2(dot(to_next, to_last));
            let sum = &mut sums[sum_of[corners[i]]];
            for axis in 0..3 {
                sum[axis] += normal[axis] * angle;
            }
        }
    }
    for (vertex, &index) in model.vertices.iter_mut().zip(&sum_of) {
        if vertex.normal.iter().all(|x| x.abs() <= 0.0) {
            vertex.normal = normalize(sums[index]).unwrap_or([0.0, 0.0, 1.0]).map(narrow);
        }
    }
}

pub(crate) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector in the direction of `a`, unless it has none.
pub(crate) fn normalize(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = length(a);
    // Sums of opposite unit normals leave a residue of rounding, which has no direction worth keeping; vectors of
    // this length do not come from f32 input otherwise, except as products of two tiny edges.
    (length > 1e-30 && length.is_finite()).then(|| a.map(|x| x / length))
}

/// The nearest f32.
#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is the purpose")]
pub(crate) fn narrow(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Part, Vertex};

    fn model(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Model {
        let vertex = |&position| Vertex { position, ..Vertex::default() };
        let part = Part { triangles: triangles.to_vec(), ..Part::default() };
        Model { vertices: positions.iter().map(vertex).collect(), parts: vec![part], ..Model::default() }
    }

    fn close(a: [f32; 3], b: [f32; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    #[test]
    fn a_cube_corner_is_diagonal_however_its_faces_are_cut() {
        // Three unit squares at the origin, of which only one has its diagonal there.
        let positions = [
            [0., 0., 0.],
            [1., 0., 0.],
            [1., 1., 0.],
            [0., 1., 0.],
            [0., 1., 1.],
            [0., 0., 1.],
            [1., 0., 1.],
        ];
        let triangles = [[0, 2, 1], [0, 3, 2], [0, 5, 3], [3, 5, 4], [0, 1, 5], [1, 6, 5]];
        let mut model = model(&positions, &triangles);
        complete(&mut model);
        let d = -1.0 / 3.0_f32.sqrt();
        assert!(close(model.vertices[0].normal, [d, d, d]), "{:?}", model.vertices[0].normal);
    }

    #[test]
    fn vertices_at_one_position_share_a_normal() {
        let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [-0., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
        let mut model = model(&positions, &[[0, 1, 2], [3, 4, 5]]);
        complete(&mut model);
        assert_eq!(model.vertices[0].normal, model.vertices[3].normal);
        let d = 0.5_f32.sqrt();
        assert!(close(model.vertices[0].normal, [d, 0.0, d]));
    }

    #[test]
    fn given_normals_are_kept_and_made_unit() {
        let mut model = model(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]]);
        model.vertices[1].normal = [0.0, 3.0, 4.0];
        complete(&mut model);
        assert!(close(model.vertices[0].normal, [0.0, 0.0, 1.0]));
        assert!(close(model.vertices[1].normal, [0.0, 0.6, 0.8]));
    }

    #[test]
    fn degenerate_triangles_leave_a_unit_normal() {
        let mut model = model(&[[0., 0., 0.], [1e15, 0., 0.], [1e15, 0., 0.]], &[[0, 1, 2], [0, 0, 0]]);
        complete(&mut model);
        assert_eq!(model.vertices[0].normal, [0.0, 0.0, 1.0]);
    }
}
