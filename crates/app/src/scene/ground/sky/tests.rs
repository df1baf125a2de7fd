//! Shadows by their view factors.

use super::*;
use std::f64::consts::{PI, TAU};

const GROUND: Ground = Ground {
    goes_on: true,
    is_flat: false,
    up: (1, 1.0),
    corner: [-2.0, -2.0],
    side: 4.0,
    low: 0.0,
    near: 0.0,
    on_floor: false,
    height: 2.0,
    reach: 4.0,
    cells: 256,
};

/// The share that a place on the ground does not see of the sky, of a model under which nothing is left out.
fn dark(model: &Model, [x, z]: [f64; 2]) -> f64 {
    let sky = Sky::over(&GROUND, model, Wrap::Repeat, 128.0);
    let dark = sky.darkness(f64::INFINITY);
    let [column, row, _] = GROUND.cells([x, 0.0, z]);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    let [column, row] = [column, row].map(|cell| cell as usize / 2);
    // With the neighbours, which look between its directions.
    let square = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(a, b)| dark[(row + a) * 128 + column + b]);
    mean(square.into_iter())
}

fn model(places: &[[f64; 3]], triangles: Vec<[u32; 3]>) -> Model {
    let vertex = |place: &[f64; 3]| Vertex { position: place.map(narrow), ..Vertex::default() };
    let part = Part { triangles, ..Part::default() };
    Model { vertices: places.iter().map(vertex).collect(), parts: vec![part], ..Model::default() }
}

/// A ball of radius r whose middle is h above a place hides (r / h)² of its sky.
#[test]
fn a_ball_hides_the_square_of_its_sine() {
    for (radius, height) in [(0.5, 1.0), (0.3, 1.5), (0.9, 1.0)] {
        let place = |k: u32| {
            let [across, down] = [k % 64, k / 64].map(|k| f64::from(k) * TAU / 64.0);
            let ring = radius * (down / 2.0).sin();
            [ring * across.cos(), height + radius * (down / 2.0).cos(), ring * across.sin()]
        };
        let places: Vec<_> = (0..65 * 64).map(place).collect();
        let square = |k: u32| {
            let next = k / 64 * 64 + (k + 1) % 64;
            [[k, next, k + 64], [next, next + 64, k + 64]]
        };
        let ball = model(&places, (0..64 * 64).flat_map(square).collect());
        let (found, right) = (dark(&ball, [0.0, 0.0]), (radius / height).powi(2));
        assert!((found - right).abs() < 0.04, "{radius} {height}: {found}, not {right}");
        // Beside it, the part of that direction counts.
        let away = f64::hypot(1.5, height);
        let right = (radius / away).powi(2) * height / away;
        let found = dark(&ball, [1.5, 0.0]);
        assert!((found - right).abs() < 0.03, "{radius} {height}: {found}, not {right}");
    }
}

/// The view factor of an upright rectangle for a place before its middle.
#[test]
fn a_wall_hides_its_view_factor() {
    for (width, height, away) in [(3.8, 1.0, 0.5), (3.8, 1.9, 0.25), (1.0, 0.3, 0.3), (2.0, 0.5, 1.5)] {
        let half = width / 2.0;
        let corners = [[0.0, 0.0, -half], [0.0, 0.0, half], [0.0, height, half], [0.0, height, -half]];
        let wall = model(&corners, vec![[0, 1, 2], [0, 2, 3]]);
        let slant = f64::hypot(height, away);
        let right = ((half / away).atan() - away / slant * (half / slant).atan()) / PI;
        for (at, side) in [([-away, 0.0], "left"), ([away, 0.0], "right")] {
            let found = dark(&wall, at);
            assert!((found - right).abs() < 0.03, "{width} {height} {away} {side}: {found}, not {right}");
        }
    }
}

/// A plate with a hole is none over the hole, and as much as a plate beside it.
#[test]
fn a_low_plate_hides_all_and_its_hole_nothing() {
    let corners = [-1.0, 1.0].map(|x| [-1.0, -0.5, 0.5, 1.0].map(|z| [x, 0.02, z])).concat();
    let plates = vec![[0, 1, 5], [0, 5, 4], [2, 3, 7], [2, 7, 6]];
    let plate = model(&corners, plates);
    assert!(dark(&plate, [0.0, 0.75]) > 0.97 && dark(&plate, [0.0, -0.75]) > 0.97);
    assert!(dark(&plate, [0.0, 0.0]) < 0.03);
}

#[test]
fn what_is_not_finite_or_beside_the_ground_hides_nothing() {
    let far = [[f64::NAN, 1.0, 0.0], [1e30, 1.0, 1.0], [-1.0, 1.0, 1e30], [5.0, 1.0, 5.0], [6.0, 1.0, 5.0]];
    let none = model(&far, vec![[0, 1, 2], [3, 4, 4], [0, 0, 0], [9, 1, 2]]);
    assert!(dark(&none, [0.0, 0.0]).abs() < f64::EPSILON);
}

/// Glass hides as much as it says of what a wall hides, and wires as much as they have area.
#[test]
fn glass_and_wires_hide_their_share() {
    let rectangle = |left: f64, right: f64, first: u32| {
        let corners = [[0.0, left], [0.0, right], [1.0, right], [1.0, left]];
        (corners.map(|[y, z]| [0.0, y, z]), [[first, first + 1, first + 2], [first, first + 2, first + 3]])
    };
    let wall = rectangle(-1.5, 1.5, 0);
    let mut glass = model(&wall.0, wall.1.to_vec());
    let whole = dark(&glass, [0.4, 0.0]);
    glass.parts[0].detail.blend = AnyBlend::Constant(51);
    let found = dark(&glass, [0.4, 0.0]);
    assert!((found - 0.2 * whole).abs() < 1e-9, "{found} {whole}");
    // A twentieth of a cell wide, each second cell: with half of the area of a surface a cell counts as whole.
    let wires = (0..96_u32).map(|k| {
        let left = -1.5 + f64::from(k) / 32.0;
        rectangle(left + 0.001, left + 0.001 + 1.0 / 1280.0, 4 * k)
    });
    let (corners, triangles): (Vec<_>, Vec<_>) = wires.unzip();
    let wires = model(&corners.concat(), triangles.concat());
    let found = dark(&wires, [0.4, 0.0]) / whole;
    assert!((0.02..0.3).contains(&found), "{found}");
}

/// In any block of boxes about as many are kept as the share says.
#[test]
fn as_many_boxes_are_kept_as_the_share_says() {
    for share in [0.02, 0.2, 0.5, 0.9] {
        for corner in [[0, 0], [100, 37]] {
            let cells = (0..100).map(|k| [corner[0] + k % 10, corner[1] + k / 10]);
            let kept: u32 = cells.map(|cell| some(cell, share).count_ones()).sum();
            assert!((f64::from(kept) / 6400.0 - share).abs() < 0.01, "{share}: {kept}");
        }
    }
}

/// A sheet that lies on the ground has no rim, and nothing is dark where nothing is near.
#[test]
fn sheets_on_the_ground_and_far_places_are_not_dark() {
    let mut sheet =
        model(&[-1.0, 1.0].map(|x| [-1.0, 1.0].map(|z| [x, 1e-5, z])).concat(), vec![[0, 1, 3], [0, 3, 2]]);
    for at in [[0.0, 1.02], [1.02, 0.5], [-1.02, 0.0], [1.5, 1.5]] {
        assert!(dark(&sheet, at) < 0.02, "{at:?}: {}", dark(&sheet, at));
    }
    // Far below it nothing is seen: a filter that reads from there makes no rim lighter.
    assert!(dark(&sheet, [0.0, 0.0]) == 1.0);
    // Through glass all is seen.
    sheet.parts[0].detail.blend = AnyBlend::Constant(3);
    assert!(dark(&sheet, [0.0, 0.0]) == 0.0);
    let raised =
        model(&[-1.0, 1.0].map(|x| [-1.0, 1.0].map(|z| [x, 0.5, z])).concat(), vec![[0, 1, 3], [0, 3, 2]]);
    let sky = Sky::over(&GROUND, &raised, Wrap::Repeat, 128.0);
    let near = sky.darkness(20.0);
    assert!(
        near[0] == 0.0
            && sky.layers[0].is_empty([0, 0], 20.0, 256)
            && !sky.layers[0].is_empty([64, 64], 20.0, 256)
    );
}

/// A box with the ground around its middle: as dark on all of its sides.
#[test]
fn opposite_sides_are_equally_dark() {
    let corners = [-1.0, 1.0].map(|x| [0.0, 2.0].map(|y| [-1.0, 1.0].map(|z| [x, y, z])).concat()).concat();
    let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]);
    let block = model(&corners, triangles.collect());
    for side in [4.0, 4.1, 4.2, 4.4, 5.1177] {
        let ground = Ground { side, corner: [-side / 2.0; 2], ..GROUND };
        let dark = Sky::over(&ground, &block, Wrap::Repeat, 512.0 / side).darkness(60.0);
        let of = |row: usize, column: usize| dark[row * 128 + column];
        // Two by two, which look in directions between each other's.
        for k in 0..64 {
            let pair = |column: usize| f64::midpoint(of(63, column), of(64, column));
            let mean = |a: usize, b: usize| f64::midpoint(pair(a), pair(b));
            let [left, right] = [mean(k, (k + 1).min(63)), mean(127 - k, 126 - k.min(62))];
            assert!((left - right).abs() < 0.06, "{side} {k}: {left} {right}");
        }
    }
}
