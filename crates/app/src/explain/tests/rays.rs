//! A ray through a pixel's centre, in `f64`: which triangle it meets first, where, and how far away.

use super::{pixels, within_bounds};
use crate::explain::explain_each;
use crate::options::{DepthFormat, Projection, RenderOptions};
use crate::scene::{Camera, Model};
use serde_json::Value;

type V = [f64; 3];

/// The weights of a triangle's vertices at a place, and its distance along the view.
type Hit = ([f64; 3], f64);

fn sub(a: V, b: V) -> V {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: V) -> V {
    a.map(|x| x / dot(a, a).sqrt())
}

/// A ray: its origin, and its direction, which is one unit long along the view.
fn ray(camera: &Camera, options: &RenderOptions, place: [f64; 2]) -> [V; 2] {
    let [eye, target, up] = [camera.eye, camera.target, camera.picture_up()].map(|v| v.map(f64::from));
    let forward = unit(sub(target, eye));
    let right = unit(cross(forward, up));
    let above = cross(right, forward);
    let [width, height] = [options.width, options.height].map(f64::from);
    let half = match options.projection {
        Projection::Perspective => (f64::from(camera.fov).to_radians() / 2.0).tan(),
        Projection::Parallel { height } => f64::from(height) / 2.0,
    };
    let x = (place[0] / width * 2.0 - 1.0) * half * width / height;
    let y = (1.0 - place[1] / height * 2.0) * half;
    let aside = [0, 1, 2].map(|k| x * right[k] + y * above[k]);
    match options.projection {
        Projection::Perspective => [eye, [0, 1, 2].map(|k| forward[k] + aside[k])],
        Projection::Parallel { .. } => [[0, 1, 2].map(|k| eye[k] + aside[k]), forward],
    }
}

/// The weights of a triangle's vertices where the ray meets its plane, and the distance along the view.
fn meet([a, b, c]: [V; 3], [origin, direction]: [V; 2]) -> Hit {
    let (e1, e2) = (sub(b, a), sub(c, a));
    let p = cross(direction, e2);
    let determinant = dot(e1, p);
    let from = sub(origin, a);
    let q = cross(from, e1);
    let [v, w] = [dot(from, p) / determinant, dot(direction, q) / determinant];
    ([1.0 - v - w, v, w], dot(e2, q) / determinant)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("numbers").iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// Judges explanations all over a picture, of which at least `least` are of covered pixels.
pub(super) fn judge(model: &Model, camera: &Camera, options: &RenderOptions, least: usize) {
    let places = pixels(9, 7);
    let journeys = explain_each(model, camera, options, &places).expect("journeys");
    let mut judged = 0;
    for (pixel, journey) in places.into_iter().zip(journeys) {
        let json = journey.json();
        assert!(journey.agrees(), "{json}");
        within_bounds(&json, "");
        let place = pixel.map(|at| f64::from(at) + 0.5);
        let part = &model.parts[0];
        let at = |place| {
            let ray = ray(camera, options, place);
            part.triangles.iter().map(move |t| meet(corners(model, *t), ray)).collect::<Vec<_>>()
        };
        // A vertex may move by half a 256th of a pixel on each axis.
        let near = f64::from(camera.near)..f64::from(camera.far);
        let hits = at(place);
        let inside = |slack: f64| {
            let hits = hits.iter().enumerate();
            let inside = hits
                .filter(|(_, (w, z))| near.contains(z) && w.iter().all(|&w| w > slack))
                .map(|(t, (_, z))| (t, *z));
            inside.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(t, _)| t)
        };
        let (Some(certain), Some(possible)) = (inside(0.01), inside(-0.01)) else {
            assert!(inside(0.01).is_none() || journey.is_covered(), "{pixel:?}");
            assert!(inside(-0.01).is_some() || !journey.is_covered(), "{pixel:?}");
            continue;
        };
        if certain != possible {
            continue;
        }
        judged += 1;
        assert_eq!(json["object"]["triangle"], certain, "{pixel:?}");
        let [right, below] = [at([place[0] + 1.0, place[1]]), at([place[0], place[1] + 1.0])];
        let (weights, z) = hits[certain];
        let slack = |of: &dyn Fn(&Hit) -> f64| {
            let here = of(&hits[certain]);
            ((of(&right[certain]) - here).abs() + (of(&below[certain]) - here).abs()) / 256.0
                + 2e-6 * (1.0 + here.abs())
        };
        let close = |found: f64, expected: f64, slack: f64, what: &str| {
            assert!(
                (found - expected).abs() <= slack,
                "{what} {found} {expected} ± {slack} at {pixel:?}: {json}"
            );
        };
        let of_json = &json["weights"];
        let whole =
            if of_json["of_vertices"].is_null() { &of_json["space"] } else { &of_json["of_vertices"] };
        for (k, found) in numbers(whole).into_iter().enumerate() {
            close(found, weights[k], slack(&|hit| hit.0[k]), "weight");
        }
        close(json["depth"]["z"].as_f64().expect("a number"), z, slack(&|hit| hit.1), "z");
        let zs = |z: f64| {
            let [near, far] = [camera.near, camera.far].map(f64::from);
            let forward = match options.projection {
                Projection::Perspective => far / (far - near) * (1.0 - near / z),
                Projection::Parallel { .. } => (z - near) / (far - near),
            };
            if options.depth == DepthFormat::F32Reversed { 1.0 - forward } else { forward }
        };
        for key in ["zs", "zs_drawn"] {
            close(json["depth"][key].as_f64().expect("a number"), zs(z), slack(&|hit| zs(hit.1)), key);
        }
        let vertices = part.triangles[certain].map(|index| model.vertices[index as usize]);
        let mean = |w: [f64; 3], component: &dyn Fn(usize) -> f32| -> f64 {
            (0..3).map(|k| w[k] * f64::from(component(k))).sum()
        };
        let mut rows = 0;
        for row in json["attributes"]["values"].as_array().expect("rows") {
            let name = row["name"].as_str().expect("a name");
            let component = |k: usize| match name {
                "u" => vertices[k].uv[0],
                "v" => vertices[k].uv[1],
                "normal x" => vertices[k].normal[0],
                "normal y" => vertices[k].normal[1],
                "normal z" => vertices[k].normal[2],
                name => panic!("{name}"),
            };
            for key in ["hyperbolic", "drawn"] {
                let found = row[key].as_f64().expect("a number");
                close(found, mean(weights, &component), slack(&|hit| mean(hit.0, &component)), name);
            }
            rows += 1;
        }
        assert_eq!(rows, 5, "{json}");
        // The derivative of u in the middle of half a pixel to either side.
        let u = |place| mean(at(place)[certain].0, &|k| vertices[k].uv[0]);
        let du = (u([place[0] + 0.01, place[1]]) - u([place[0] - 0.01, place[1]])) / 0.02;
        let found = json["derivatives"]["derivatives"][0]["d/dx_exact"].as_f64().expect("a number");
        close(found, du, 0.02 * du.abs() + 1e-4, "du/dx");
        let drawn = json["derivatives"]["derivatives"][0]["d/dx"].as_f64().expect("a number");
        close(drawn, found, 1e-4 * found.abs() + 1e-6, "du/dx as drawn");
        light(model, camera, &json, (weights, certain));
    }
    assert!(judged >= least, "{judged}");
}

/// The factor of the light beside the camera: 0.3 + 0.7 max(0, n·l).
fn light(model: &Model, camera: &Camera, json: &Value, (weights, triangle): ([f64; 3], usize)) {
    let normals =
        model.parts[0].triangles[triangle].map(|i| model.vertices[i as usize].normal.map(f64::from));
    let normal = unit([0, 1, 2].map(|axis| (0..3).map(|k| weights[k] * normals[k][axis]).sum()));
    let [eye, target, up] = [camera.eye, camera.target, camera.picture_up()].map(|v| v.map(f64::from));
    let forward = unit(sub(target, eye));
    let right = unit(cross(forward, up));
    let above = cross(right, forward);
    // From beside, above and behind the camera.
    let to_light = unit([0, 1, 2].map(|k| -0.45 * right[k] + 0.6 * above[k] - forward[k]));
    let factor = json["light"]["factor"].as_f64().expect("a number");
    let expected = 0.3 + 0.7 * dot(normal, to_light).max(0.0);
    assert!((factor - expected).abs() < 2e-3, "{factor} {expected} {json}");
}

fn corners(model: &Model, triangle: [u32; 3]) -> [V; 3] {
    triangle.map(|index| model.vertices[index as usize].position.map(f64::from))
}

/// The distance, in pixels, from a pixel's centre to the sphere of radius 1.5 about the origin, as it is seen. It is
/// that of the nearest of places half a pixel apart.
pub(super) fn to_outline(camera: &Camera, pixel: [u32; 2]) -> f64 {
    let options = super::options(crate::options::Interpolation::Exact);
    let misses = |place: [f64; 2]| {
        let [eye, direction] = ray(camera, &options, place);
        let along = unit(direction);
        let t = -dot(eye, along);
        let nearest = [0, 1, 2].map(|k| eye[k] + t * along[k]);
        dot(nearest, nearest).sqrt() > 1.5
    };
    let from = pixel.map(|at| f64::from(at) + 0.5);
    // The nearest place of all that hit.
    let mut least = f64::MAX;
    for row in 0..144 {
        for column in 0..192 {
            let place = [f64::from(column) / 2.0, f64::from(row) / 2.0];
            if !misses(place) {
                least = least.min((place[0] - from[0]).hypot(place[1] - from[1]));
            }
        }
    }
    least
}
