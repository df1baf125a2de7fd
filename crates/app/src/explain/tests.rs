//! Explanations agree with the pictures; their numbers are those of rays in `f64`.

use super::{Journey, explain, explain_each, theory};
use crate::options::{
    Arithmetic, ColorFormat, Cull, DepthFormat, Dither, Filter, Interpolation, LightOptions, Lod, Policies,
    Probes, Projection, RenderOptions, Shading, SpanLength, Subpixel, Wrap,
};
use crate::scene::surfaces::Surface;
use crate::scene::{Camera, Image, Model, Part, Vertex, scenes};
use serde_json::Value;
use std::num::NonZero;

mod rays;

const SIZE: [u32; 2] = [96, 72];

fn options(interpolation: Interpolation) -> RenderOptions {
    RenderOptions {
        width: SIZE[0],
        height: SIZE[1],
        background: [1, 2, 3],
        shading: Shading::Lambert,
        filter: Filter::Bilinear,
        wrap: Wrap::Repeat,
        cull: Cull::None,
        depth: DepthFormat::F32,
        projection: Projection::Perspective,
        haze: None,
        light: LightOptions::default(),
        threads: NonZero::<usize>::MIN,
        policies: Policies { interpolation, ..Policies::default() },
    }
}

/// Pixels all over the picture.
fn pixels(columns: u32, rows: u32) -> Vec<[u32; 2]> {
    let at = |k: u32, of: u32, length: u32| k * (length - 1) / (of - 1);
    let row = |j| (0..columns).map(move |k| [at(k, columns, SIZE[0]), at(j, rows, SIZE[1])]);
    (0..rows).flat_map(row).collect()
}

/// Every policy in one of its forms.
fn policies() -> Vec<(Policies, DepthFormat)> {
    use Interpolation::{Affine, Bounded, Exact, Plane, Spans};
    let float = |interpolation| Policies { interpolation, ..Policies::default() };
    let fixed = |interpolation, subpixel| Policies {
        interpolation,
        arithmetic: Arithmetic::Fixed,
        color: ColorFormat::Rgb565,
        dither: Dither::None,
        subpixel,
        lod: if interpolation == Affine { Lod::Triangle } else { Lod::Pixel },
    };
    vec![
        (float(Exact), DepthFormat::F32Reversed),
        (Policies { subpixel: Subpixel::Sub4, ..float(Exact) }, DepthFormat::U32),
        (Policies { lod: Lod::Run, ..float(Plane) }, DepthFormat::U24),
        (float(Spans(SpanLength::Eight)), DepthFormat::F32),
        (float(Bounded(0.0625)), DepthFormat::U16),
        (Policies { lod: Lod::Triangle, ..float(Affine) }, DepthFormat::None),
        (fixed(Spans(SpanLength::Sixteen), Subpixel::Sub4), DepthFormat::U16),
        (fixed(Bounded(0.25), Subpixel::Sub8), DepthFormat::F32Reversed),
        (fixed(Affine, Subpixel::Sub4), DepthFormat::None),
        (fixed(Spans(SpanLength::Four), Subpixel::Sub8), DepthFormat::U24),
    ]
}

/// No attribute is farther from its hyperbolic value than the policy says.
fn within_bounds(journey: &Value, of: &str) {
    for row in journey["attributes"]["values"].as_array().into_iter().flatten() {
        let [off, bound] = ["drawn_less_hyperbolic", "bound"].map(|key| row[key].as_f64().expect("a number"));
        assert!(off.abs() <= bound, "{row} {of}");
    }
}

/// The colours of texels, mixed by the formulas of `Bilinear`, `BetweenLevels` and `Anisotropic`, are the value.
fn texels_make_the_value(journey: &Value) -> usize {
    let texture = &journey["texture"];
    let Some(texels) = texture["texels"].as_array() else { return 0 };
    let number = |texel: &Value, key: &str| texel[key].as_u64().expect("an integer");
    let probes = texels.iter().map(|texel| number(texel, "place")).max().expect("texels") + 1;
    let mixed = [0, 1, 2, 3].map(|channel| {
        let of_probe = |probe: u64| {
            let here = texels.iter().filter(|texel| number(texel, "place") == probe);
            let weighted = |texel: &Value| {
                let byte = &texel["color"].as_str().expect("a colour")[1 + 2 * channel..][..2];
                let byte = u64::from_str_radix(byte, 16).expect("two digits");
                number(texel, "256ths_of_level") * number(texel, "65536ths_of_texel") * byte
            };
            // One rounding, of 2^24ths; a single level has all 256ths of them.
            (here.map(weighted).sum::<u64>() + (1 << 23)) >> 24
        };
        ((0..probes).map(of_probe).sum::<u64>() + probes / 2) / probes
    });
    let [r, g, b, a] = mixed;
    assert_eq!(texture["value"], format!("#{r:02x}{g:02x}{b:02x}{a:02x}"), "{texture}");
    texels.len()
}

fn check(journeys: &[Journey], of: &str) -> [usize; 2] {
    let mut found = [0; 2];
    for journey in journeys {
        let json = journey.json();
        assert!(journey.agrees(), "{of}: {}", journey.text());
        within_bounds(&json, of);
        found[1] += texels_make_the_value(&json);
        found[0] += usize::from(journey.is_covered());
    }
    found
}

#[test]
fn every_explanation_ends_with_the_pixel_of_the_picture() {
    let filters = [Filter::Bilinear, Filter::Trilinear, Filter::Anisotropic(Probes::Four), Filter::Nearest];
    let shadings = [
        Shading::Lambert,
        Shading::Unlit,
        Shading::Blinn,
        Shading::Gouraud,
        Shading::Phong,
        Shading::VertexColor,
    ];
    let mut found = [0; 2];
    let mut turn = 0;
    for name in ["floor", "mesh", "cube", "inside"] {
        let scene = scenes::by_name(name).expect("a scene");
        for (policies, depth) in policies() {
            turn += 1;
            let filter = filters[turn % filters.len()];
            let shading = shadings[turn % shadings.len()];
            let options = RenderOptions {
                filter,
                shading,
                depth,
                cull: scene.cull,
                policies,
                ..options(Interpolation::Exact)
            };
            let journeys =
                explain_each(&scene.model, &scene.camera, &options, &pixels(7, 5)).expect("journeys");
            let [covered, texels] = check(&journeys, &format!("{name} {options:?}"));
            found = [found[0] + covered, found[1] + texels];
        }
    }
    assert!(found[0] > 600 && found[1] > 1500, "{found:?}");
}

#[test]
fn sections_and_relations_are_those_of_the_page() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/theory.md");
    let page = std::fs::read_to_string(page).expect("docs/theory.md");
    let section = |name: &str| {
        let heading = format!("## {name}");
        page.split("\n## ").find(|section| format!("## {section}").lines().next() == Some(&heading))
    };
    for relation in theory::ALL {
        let text = section(relation.section).unwrap_or_else(|| panic!("no section {}", relation.section));
        assert!(text.contains(relation.words), "{relation:?}");
    }
    assert!(section("Weather").is_none());
}

/// A square on the ground from behind the camera to the distance, with a texture.
fn ground() -> (Model, Camera) {
    let corners =
        [[-9.0, 4.0, 0.0, 0.0], [9.0, 4.0, 3.0, 0.0], [9.0, -14.0, 3.0, 3.0], [-9.0, -14.0, 0.0, 3.0]];
    let vertex = |[x, z, u, v]: [f32; 4]| Vertex {
        position: [x, 0.0, z],
        normal: [0.0, 1.0, 0.0],
        uv: [u, v],
        ..Vertex::default()
    };
    let texels = (0..64u8).map(|k| [k.wrapping_mul(5), k * 3, 255 - k, 255]).collect();
    let part = Part {
        name: "ground".to_owned(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        diffuse: [1.0; 3],
        texture: Some(0),
        ..Part::default()
    };
    let model = Model {
        vertices: corners.map(vertex).to_vec(),
        parts: vec![part],
        textures: vec![Image { width: 8, height: 8, texels }.into()],
        ..Model::default()
    };
    let camera = Camera {
        eye: [0.3, 1.2, 2.0],
        target: [0.0, 0.4, -3.0],
        up: [0.1, 1.0, 0.0],
        roll: 0.0,
        fov: 60.0,
        near: 0.25,
        far: 40.0,
    };
    (model, camera)
}

/// A sphere with a texture.
fn ball() -> (Model, Camera) {
    let mut model = Surface::Sphere { radius: 1.5 }.mesh([24, 12], [2.0, 1.0]);
    model.textures = ground().0.textures;
    model.parts[0].texture = Some(0);
    model.parts[0].diffuse = [1.0; 3];
    let camera = Camera {
        eye: [2.0, 1.5, 4.0],
        target: [0.1, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 35.0,
        near: 1.0,
        far: 9.0,
    };
    (model, camera)
}

#[test]
fn a_floor_through_the_near_plane() {
    let (model, camera) = ground();
    rays::judge(&model, &camera, &options(Interpolation::Exact), 30);
}

#[test]
fn a_mesh() {
    let (model, camera) = ball();
    let reversed = RenderOptions { depth: DepthFormat::F32Reversed, ..options(Interpolation::Exact) };
    rays::judge(&model, &camera, &reversed, 12);
}

#[test]
fn a_parallel_projection() {
    let (model, camera) = ball();
    let projection = Projection::Parallel { height: 4.0 };
    rays::judge(&model, &camera, &RenderOptions { projection, ..options(Interpolation::Affine) }, 12);
}

#[test]
fn pixels_that_nothing_covers_and_those_that_are_not_there() {
    let (model, camera) = ball();
    let exact = options(Interpolation::Exact);
    let journey = explain(&model, &camera, &exact, [0, 0]).expect("a journey");
    let json = journey.json();
    assert!(!journey.is_covered() && journey.agrees(), "{json}");
    assert_eq!(json["stored"]["picture"], serde_json::json!([1, 2, 3, 255]));
    assert_eq!(json["nothing"]["triangles"], model.parts[0].triangles.len());
    let distance = json["nothing"]["nearest"].as_f64().expect("a distance");
    // From the corner to the outline, a circle as good as.
    assert!((distance - rays::to_outline(&camera, [0, 0])).abs() < 1.0, "{distance}");
    // All faces that would be seen are left out.
    let front = RenderOptions { cull: Cull::Front, ..exact };
    let middle = explain(&model, &camera, &front, [48, 36]).expect("a journey").json();
    assert_eq!(middle["facing"]["side"], "the back: clockwise as seen", "{middle}");
    let mut flat = model.clone();
    flat.parts[0].triangles.retain(|t| t.iter().all(|&i| flat.vertices[i as usize].normal[2] > 0.2));
    let gone = explain(&flat, &camera, &front, [48, 36]).expect("a journey").json();
    assert_eq!(gone["nothing"]["culled_here"].as_array().map(Vec::len), Some(1), "{gone}");
    for outside in [[96, 0], [0, 72]] {
        let error = explain(&model, &camera, &exact, outside).expect_err("outside").to_string();
        assert!(error.contains("96x72: 0,0 to 95,71"), "{error}");
    }
}

/// Two squares, of which the nearer is drawn first, then last: the other is hidden, or seen before.
#[test]
fn fragments_are_listed_in_drawing_order() {
    let square = |z: f32| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vertex {
            position: [x, y, z],
            normal: [0.0, 0.0, 1.0],
            ..Vertex::default()
        })
    };
    let part = |first: u32| Part {
        triangles: vec![[first, first + 1, first + 2], [first, first + 2, first + 3]],
        diffuse: [0.5; 3],
        ..Part::default()
    };
    let vertices = [square(0.0), square(1.0)].concat();
    let camera = Camera {
        eye: [0.0, 0.0, 5.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 40.0,
        near: 1.0,
        far: 9.0,
    };
    for (order, seen) in [([4, 0], [true, false]), ([0, 4], [true, true])] {
        let model = Model { vertices: vertices.clone(), parts: order.map(part).to_vec(), ..Model::default() };
        let json =
            explain(&model, &camera, &options(Interpolation::Exact), [50, 30]).expect("a journey").json();
        let arrived = json["fragments"]["arrived"].as_array().expect("a list").clone();
        let tests: Vec<bool> =
            arrived.iter().map(|row| row["test"].as_str().expect("words").starts_with("seen")).collect();
        assert_eq!(tests, seen, "{json}");
        let explained = usize::from(order[0] == 0);
        assert_eq!(json["fragments"]["explained"], explained);
        assert_eq!(json["object"]["part"], explained);
        // z = 4 and 5 between the planes 1 and 9: zs = 9/8 (1 - 1/z).
        for (row, first) in arrived.iter().zip(order) {
            let z = if first == 4 { 4.0 } else { 5.0 };
            let zs = row["zs"].as_f64().expect("a number");
            assert!((zs - 1.125 * (1.0 - 1.0 / z)).abs() < 1e-6, "{row}");
        }
    }
}
