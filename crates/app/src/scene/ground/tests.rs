//! Grounds, and how dark their shadows are.

use super::*;
use crate::scene::normals::normalize;

const CAMERA: Camera = Camera {
    eye: [3.0, 2.0, 4.0],
    target: [0.0; 3],
    up: [0.0, 1.0, 0.0],
    roll: 0.0,
    fov: 40.0,
    near: 4.0,
    far: 6.0,
};

/// A square of 2 by 2 at this height, over a speck on the ground at the origin.
fn square(height: f32) -> Model {
    let corner = |[x, z]: [f32; 2]| Vertex { position: [x, height, z], ..Vertex::default() };
    let mut vertices = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner).to_vec();
    vertices.push(Vertex::default());
    let triangles = vec![[0, 1, 2], [0, 2, 3], [4, 4, 4]];
    Model { vertices, parts: vec![Part { triangles, ..Part::default() }], ..Model::default() }
}

fn alpha(model: &Model, [x, z]: [f64; 2]) -> u8 {
    let ground = Ground::of(model, CAMERA.up, 1e-4).expect("a ground");
    let [column, row, _] = ground.cells([x, 0.0, z]);
    let texels = ground.shadow(model, Wrap::Repeat);
    // Rows come from the top of the image.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    let (column, row) = (column as usize / 2, row as usize / 2);
    let side = ground.cells as usize / 2;
    // Beside the ground there is no shadow.
    let index = (side - 1).checked_sub(row).map(|row| row * side + column).filter(|_| column < side);
    index.map_or(0, |index| texels[index])
}

#[test]
fn what_is_near_is_darker_and_sharper() {
    let [low, high] = [0.01, 0.8].map(square);
    assert!(alpha(&low, [0.0, 0.0]) > 100, "{}", alpha(&low, [0.0, 0.0]));
    assert!(alpha(&low, [0.9, 0.0]) > alpha(&high, [0.9, 0.0]));
    // Beyond the rim there is nothing of what is near, and something of what is high.
    assert!(alpha(&low, [1.2, 0.0]) < 5 && alpha(&high, [1.2, 0.0]) > 10);
    // Nothing ends at the sides of the ground.
    assert_eq!([[2.2, 0.0], [0.0, -2.2]].map(|at| alpha(&high, at)), [0; 2]);
    for model in [&low, &high] {
        assert_eq!(
            [[0.7, 0.0], [0.0, 0.7], [-0.7, 0.0]]
                .map(|at| alpha(model, at).abs_diff(alpha(model, [0.0, -0.7])))
                .map(|off| off < 9),
            [true; 3]
        );
    }
}

/// Steps of alpha by which neighbours differ that look in different directions.
const NOISE: u8 = 3;

/// A foot that stands flat on the ground below an overhang: darker and darker up to where they meet, and below it.
#[test]
fn contacts_are_darkest() {
    let ring = |half: f32, y: f32| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, z]: [f32; 2]| Vertex { position: [half * x, y, half * z], ..Vertex::default() })
    };
    let vertices = [ring(0.5, 0.0), ring(0.9, 0.2), ring(1.0, 0.5)].concat();
    let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
    for level in [0, 4] {
        for k in 0..4 {
            let [a, b, c, d] = [k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k].map(|corner| level + corner);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let model = Model { vertices, parts: vec![Part { triangles, ..Part::default() }], ..Model::default() };
    for along in [[1.0, 0.0], [0.0, -1.0]] {
        // From under the rim to just below the foot.
        let from = |k: i32| 0.95 - f64::from(k) / 100.0;
        let found: Vec<u8> = (0..48).map(|k| alpha(&model, along.map(|x: f64| x * from(k)))).collect();
        let rises = |pair: &[u8]| pair[0] <= pair[1].saturating_add(NOISE);
        assert!(found.windows(2).all(rises), "{along:?} {found:?}");
        let most = found.iter().max().copied().unwrap_or_default();
        assert!(most > 150 && found[47] + NOISE >= most, "{along:?} {found:?}");
    }
}

#[test]
fn the_ground_is_under_all_and_between_the_planes() {
    let mut model = square(0.5);
    let mut camera = CAMERA;
    add(&mut model, (None, CAMERA.up), std::slice::from_mut(&mut camera), Manner::default());
    let part = model.parts.last().expect("a part");
    assert_eq!((model.parts.len(), part.triangles.len(), model.textures.len()), (2, 2, 1));
    let eye = CAMERA.eye.map(f64::from);
    let forward = normalize(sub([0.0; 3], eye)).expect("a direction");
    for vertex in &model.vertices[5..] {
        assert!(vertex.position[1] < 0.0 && vertex.position[1] > -0.01);
        let along = dot(sub(vertex.position.map(f64::from), eye), forward);
        assert!((f64::from(camera.near)..f64::from(camera.far)).contains(&along));
    }
    // The image's first row is at v = 1, and the front of the ground is above.
    let [a, b, c] = part.triangles[0].map(|k| model.vertices[k as usize].position.map(f64::from));
    assert!(crate::scene::normals::cross(sub(b, a), sub(c, a))[1] > 0.0);
    let below = Camera { eye: [3.0, -2.0, 4.0], ..CAMERA };
    let mut model = square(0.5);
    add(&mut model, (None, CAMERA.up), &mut [below], Manner { affine: true, ..Manner::default() });
    assert_eq!(model.parts.len(), 1);
}

/// A camera with the ground on all sides of it.
#[test]
fn a_ground_up_to_the_eye_is_not_cut_off() {
    // Its picture begins 0.5/sin 61.5° before the eye, 20° off its middle.
    let mut camera = Camera { eye: [0.4, 0.5, 0.4], target: [0.0; 3], near: 0.9, ..CAMERA };
    let manner = Manner { sight: Some(Sight { aspect: 1.0, reach: 1e5 }), ..Manner::default() };
    add(&mut square(0.5), (None, CAMERA.up), std::slice::from_mut(&mut camera), manner);
    assert!(camera.near > 0.5 && camera.near < 0.535, "{camera:?}");
    let mut fixed = Camera { near: 0.3, ..camera };
    add(
        &mut square(0.5),
        (None, CAMERA.up),
        std::slice::from_mut(&mut fixed),
        Manner { fixed: [true, false], ..Manner::default() },
    );
    assert!((fixed.near - 0.3).abs() < f32::EPSILON);
}

/// Squares lie side by side, each with the coordinates of its place, and are as large as the whole.
#[test]
fn squares_are_the_ground() {
    let grounds = [false, true].map(|affine| {
        let mut model = square(0.5);
        add(&mut model, (None, CAMERA.up), &mut [CAMERA], Manner { affine, ..Manner::default() });
        model
    });
    let area = |model: &Model| -> f64 {
        let triangles = model.parts[1].triangles.iter();
        let areas = triangles.map(|triangle| {
            let [a, b, c] = triangle.map(|k| model.vertices[k as usize].position.map(f64::from));
            crate::scene::normals::cross(sub(b, a), sub(c, a))[1] / 2.0
        });
        // All face upwards.
        areas.inspect(|&area| assert!(area > 0.0)).sum()
    };
    let [one, many] = [&grounds[0], &grounds[1]];
    assert!(many.parts[1].triangles.len() > 4000);
    assert!((area(many) / area(one) - 1.0).abs() < 1e-4);
    let [first, last] = [one.vertices[5], one.vertices[8]];
    for vertex in &many.vertices[5..] {
        for (axis, share) in others(1).into_iter().zip(vertex.uv) {
            let [low, high] = [first, last].map(|corner| corner.position[axis]);
            assert!((vertex.position[axis] - (low + (high - low) * share)).abs() < 1e-5, "{vertex:?}");
        }
    }
}

/// The weights of a texel and its eight neighbours, one by one.
#[test]
fn a_blur_is_a_weighted_mean() {
    let mut texels: Vec<f64> = (0..16384_u32).map(|k| f64::from(k * 7919 % 101)).collect();
    let before = texels.clone();
    blur(&mut texels, 128);
    for (row, column) in [(0, 0), (100, 37), (127, 126), (2, 127)] {
        let mut sum = 0.0;
        for (k, &texel) in before.iter().enumerate() {
            let weight = |at: usize, of: usize| match at.abs_diff(of) {
                0 => 2.0,
                1 => 1.0,
                _ => 0.0,
            };
            sum += texel * weight(k / 128, row) * weight(k % 128, column);
        }
        let found: f64 = texels[row * 128 + column];
        assert!((found - sum / 16.0).abs() < 1e-9, "{found} {}", sum / 16.0);
    }
}
