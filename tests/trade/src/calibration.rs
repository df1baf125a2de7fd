//! Small scenes that load one part of a renderer each: vertices, triangles that are not seen, rows, pixels.

use crate::scenes::{Scene, camera, scene, sheet, tiled};
use alberti_app::scene::{Model, Part};
use std::sync::LazyLock;

/// Half the height and the width of what the eye sees, at distance 1.
const SEEN: [f32; 2] = [0.6218, 0.4663];

/// Those by which the costs of chips are fitted.
pub static CALIBRATION: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    let whole = |cells| wall(cells, 1.0, 2.0);
    vec![
        new("one-quad", whole([1, 1])),
        new("48-cells", whole([8, 6])),
        new("768-cells", whole([32, 24])),
        new("3072-cells", whole([60, 48])),
        new("specks", wall([60, 48], 0.2, 2.0)),
        new("far-first", layers([4.0, 3.5, 3.0, 2.5])),
        new("near-first", layers([2.5, 3.0, 3.5, 4.0])),
        new("turned-away", turned(whole([32, 24]))),
        new("outside", moved(whole([32, 24]), 20.0)),
        new("columns", whole([64, 1])),
        new("rows", whole([1, 48])),
        new("receding", receding([4, 4])),
        new("clipped", floor([40, 1])),
        new("strips", floor([1, 24])),
        new("ground", sheet([1, 1], |s, t| [240.0 * (s - 0.5), -0.8, 1.0 - 240.0 * t], [200.0, 200.0])),
        new("steep", sheet([2, 1], |s, t| [90.0 * (s - 0.5), 3.0 * (t - 0.5), -0.3 - 60.0 * t], [9.0, 9.0])),
        new("soup", soup(&whole([16, 12]))),
        new("half", wall([6, 6], 0.5, 2.0)),
        new("300-cells", whole([20, 15])),
        new("crumbs", whole([80, 50])),
        new("small-layers", together([2.5, 2.3, 2.1].map(|distance| wall([40, 30], 0.6, distance)))),
        new("beyond", wall([1, 1], 14.0, 2.0)),
        new("far-beyond", wall([9, 1], 24.0, 2.0)),
        new("beyond-twice", together([3.0, 2.0].map(|distance| wall([1, 1], 16.0, distance)))),
        new("beyond-behind", together([2.0, 3.0].map(|distance| wall([1, 1], 18.0, distance)))),
        Scene { name: "torus", about: "", ..clone(scene("lit")) },
        Scene { name: "plane", about: "", ..clone(scene("minified")) },
    ]
});

fn new(name: &'static str, model: Model) -> Scene {
    Scene::new(name, "", tiled(model), camera(0.1, 40.0))
}

fn clone(scene: &Scene) -> Scene {
    Scene::new(scene.name, scene.about, scene.model.clone(), scene.camera)
}

/// A wall over so much of the frame, at a distance. It is a little tilted.
fn wall(cells: [u16; 2], share: f32, distance: f32) -> Model {
    let at = |s: f32, t: f32| {
        let z = distance + 0.2 * (s - 0.5);
        let [x, y] = [2.2 * SEEN[0] * (s - 0.5), 2.2 * SEEN[1] * (t - 0.5)];
        [share * distance * x, share * distance * y, -z]
    };
    sheet(cells, at, [2.0, 1.5])
}

/// A wall whose far end is ten times as far as its near one.
fn receding(cells: [u16; 2]) -> Model {
    let at = |s: f32, t: f32| {
        let z = 0.5 + 4.5 * s;
        [1.4 * SEEN[0] * z * (s - 0.5), 1.4 * SEEN[1] * z * (t - 0.5), -z]
    };
    sheet(cells, at, [4.0, 2.0])
}

/// A floor from behind the eye to the distance.
fn floor(cells: [u16; 2]) -> Model {
    sheet(cells, |s, t| [30.0 * (s - 0.5), -0.5, 1.0 - 20.0 * t], [30.0, 20.0])
}

fn layers(distances: [f32; 4]) -> Model {
    together(distances.map(|distance| wall([4, 3], 1.0, distance)))
}

/// Models in one part.
fn together<const N: usize>(models: [Model; N]) -> Model {
    let mut all = Model::default();
    let mut triangles = vec![];
    for Model { vertices, parts, .. } in models {
        let base = u32::try_from(all.vertices.len()).expect("few vertices");
        all.vertices.extend(vertices);
        triangles.extend(parts[0].triangles.iter().map(|triangle| triangle.map(|index| base + index)));
    }
    all.parts = vec![Part { triangles, diffuse: [1.0; 3], ..Part::default() }];
    all
}

fn turned(mut model: Model) -> Model {
    for [_, b, c] in &mut model.parts[0].triangles {
        std::mem::swap(b, c);
    }
    model
}

fn moved(mut model: Model, by: f32) -> Model {
    for vertex in &mut model.vertices {
        vertex.position[0] += by;
    }
    model
}

/// The same with three vertices for each triangle.
fn soup(model: &Model) -> Model {
    let corners = model.parts[0].triangles.iter().flatten();
    let vertices: Vec<_> = corners.map(|&index| model.vertices[index as usize]).collect();
    let count = u32::try_from(vertices.len()).expect("few vertices");
    let triangles = (0..count).step_by(3).map(|k| [k, k + 1, k + 2]).collect();
    Model { vertices, parts: vec![Part { triangles, ..model.parts[0].clone() }], ..Model::default() }
}
