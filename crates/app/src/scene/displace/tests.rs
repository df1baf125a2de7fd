use super::*;
use crate::scene::Detail;

const ROUGH: [u16; 16] = [0, 9000, 40000, 65535, 1, 2, 3, 50000, 60000, 7, 8, 9, 30000, 20000, 10000, 123];

fn images(heights: &[u16], width: u32) -> Images {
    let height = u32::try_from(heights.len()).unwrap() / width;
    let mut model = Model::default();
    model.heights.push(HeightImage { width, height, heights: heights.to_vec() }.into());
    let mut images = Images::new();
    images.adopt(&mut model);
    images
}

fn displacing(range: [f32; 2]) -> Detail {
    let height = HeightMap { heights: 0, wrap: None, relief: Relief::Displacement, range, extent: [1.0; 2] };
    Detail { height: Some(height), ..Detail::default() }
}

/// A cube with the whole map on each of its faces, each with normals of its own, in two parts.
fn cube() -> Model {
    let mut model = Model::default();
    for axis in 0..3 {
        for side in [0.0, 1.0] {
            let first = u32::try_from(model.vertices.len()).unwrap();
            for uv in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                let (mut position, mut normal) = ([side; 3], [0.0; 3]);
                (position[(axis + 1) % 3], position[(axis + 2) % 3]) = (uv[0], uv[1]);
                normal[axis] = 2.0 * side - 1.0;
                model.vertices.push(Vertex { position, normal, uv, ..Vertex::default() });
            }
            let quad = [[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|i| first + i));
            let triangles = quad.map(|[a, b, c]| if side > 0.5 { [a, b, c] } else { [a, c, b] }).to_vec();
            model.parts.push(Part { triangles, detail: displacing([0.0, 0.25]), ..Part::default() });
        }
    }
    model
}

fn run(model: &mut Model, images: &Images) -> Vec<String> {
    let mut warnings = Warnings::default();
    displace(model, images, Wrap::Repeat, &mut warnings);
    warnings.lines().collect()
}

#[test]
fn a_closed_surface_stays_closed() {
    let mut model = cube();
    assert!(run(&mut model, &images(&ROUGH, 4)).is_empty());
    let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
    for triangle in model.parts.iter().flat_map(|part| &part.triangles) {
        let at = triangle.map(|i| bits(model.vertices[i as usize].position));
        for (a, b) in [(at[0], at[1]), (at[1], at[2]), (at[2], at[0])] {
            *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    // Each edge is passed as often one way as the other.
    assert!(edges.len() > 100 && edges.values().all(|&n| n == 0));
    // Creases are still creases: a corner of the cube has three normals.
    let corner = model.vertices.iter().filter(|v| v.position.iter().all(|&x| x > 0.99));
    let normals: std::collections::HashSet<_> = corner.map(|v| bits(v.normal)).collect();
    assert!(normals.len() >= 3, "{normals:?}");
}

#[test]
fn vertices_rise_by_the_heights_of_their_texels() {
    let vertex = |x: f32, y: f32| Vertex {
        position: [2.0 * x, 2.0 * y, 5.0],
        normal: [0.0, 0.0, 1.0],
        uv: [x, y],
        ..Vertex::default()
    };
    let vertices = vec![vertex(0.0, 0.0), vertex(1.0, 0.0), vertex(0.0, 1.0)];
    let part = Part { triangles: vec![[0, 1, 2]], detail: displacing([-1.0, 1.0]), ..Part::default() };
    let mut model = Model { vertices, parts: vec![part], ..Model::default() };
    assert!(run(&mut model, &images(&[65535; 64], 8)).is_empty());
    assert_eq!((model.vertices.len(), model.parts[0].triangles.len()), (45, 64));
    assert!(model.vertices.iter().all(|v| v.position[2].to_bits() == 6.0_f32.to_bits()));
    assert!(model.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]));
}

#[test]
fn heights_are_means_of_texels_and_keep_16_bits() {
    let image = HeightImage { width: 2, height: 2, heights: vec![1, 3, 5, 9] };
    let at = |wrap, uv| height_at(&image, wrap, uv) * 65535.0;
    let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
    // The first row is at the top.
    near(at(Wrap::Repeat, [0.25, 0.75]), 1.0);
    near(at(Wrap::Repeat, [0.75, 0.25]), 9.0);
    near(at(Wrap::Repeat, [0.5, 0.5]), 4.5);
    near(at(Wrap::Repeat, [0.0, 0.75]), 2.0);
    near(at(Wrap::Clamp, [0.0, 0.75]), 1.0);
    near(at(Wrap::Mirror, [1.25, 0.75]), 3.0);
    near(at(Wrap::Repeat, [-0.75, 1.75]), 1.0);
}

#[test]
fn too_many_vertices_are_too_many() {
    let mut model = cube();
    let wide = vec![0; 2048 * 2];
    let warnings = run(&mut model, &images(&wide, 2048));
    assert_eq!(warnings.len(), 1);
    let start =
        "found 2048 texels of heights along an edge of a triangle, expected at most 418 for 12 triangles";
    assert!(warnings[0].starts_with(start), "{warnings:?}");
    assert!((model.vertices.len() as u64) < MAX_VERTICES + MAX_VERTICES / 50);
}

#[test]
fn parts_without_heights_stay() {
    let mut model = cube();
    model.parts[0].detail = Detail::default();
    let before: Vec<_> =
        model.parts[0].triangles.iter().flatten().map(|&i| model.vertices[i as usize]).collect();
    run(&mut model, &images(&ROUGH, 4));
    let after: Vec<_> =
        model.parts[0].triangles.iter().flatten().map(|&i| model.vertices[i as usize]).collect();
    assert_eq!(before, after);
}

#[test]
fn what_looks_smooth_stays_smooth() {
    // One triangle, bulging by its normals, which all stay where no height moves them.
    let corners = [[0.0f32, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let vertices = corners.map(|[x, y]| {
        let normal = normalize([f64::from(x) - 0.3, f64::from(y) - 0.3, 1.0]).expect("not zero").map(narrow);
        Vertex { position: [x, y, 0.0], normal, uv: [x, y], ..Vertex::default() }
    });
    let part = |range| Part { triangles: vec![[0, 1, 2]], detail: displacing(range), ..Part::default() };
    let model = |range| {
        let mut model = Model { vertices: vertices.to_vec(), parts: vec![part(range)], ..Model::default() };
        assert!(run(&mut model, &images(&ROUGH, 4)).is_empty());
        model
    };
    let (even, rough) = (model([0.0, 0.0]), model([0.0, 0.1]));
    assert!(even.vertices.len() > 10);
    let off = |model: &Model| {
        let miss = |v: &Vertex| {
            let [x, y, _] = v.position.map(f64::from);
            // Between the corners normals are means of theirs.
            let mean =
                [(1.0 - x - y, 0), (x, 1), (y, 2)].map(|(w, k)| vertices[k].normal.map(|n| w * f64::from(n)));
            let normal =
                normalize([0, 1, 2].map(|k| mean[0][k] + mean[1][k] + mean[2][k])).expect("not zero");
            sub(normal, v.normal.map(f64::from)).into_iter().fold(0.0_f64, |most, x| most.max(x.abs()))
        };
        model.vertices.iter().map(miss).fold(0.0_f64, f64::max)
    };
    assert!(off(&even) < 1e-6, "{}", off(&even));
    assert!(off(&rough) > 0.1, "{}", off(&rough));
}
