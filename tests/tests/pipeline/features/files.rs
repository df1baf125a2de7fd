//! `serde`: the texts of values in files, written here by hand, and those that are refused.

use alberti::glam::{Vec2, Vec3};
use alberti::raster::color::{AnyBlend, Bayer, Blended, Dithered, Grey4, Over};
use alberti::shaders::Mix;
use alberti::shaders::material::{AnyLight, AnyReflectance, Directional, PointLight, SpotLight};
use alberti::texture::environment::{AnyEnvironment, CubeMap};
use alberti::texture::surface::{AnyParallax, Grid, NormalEncoding, Subdivision};
use alberti::texture::{
    Anisotropic, AnyFilter, AnyMipFilter, AnyWrap, Bilinear, Bounded, LodBounds, Minify, NearestLevel,
    Trilinear,
};
use alberti::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// Checks the text of a value, and that it is read again as the same.
fn is<T: Serialize + DeserializeOwned + Debug>(value: T, text: &str) {
    let written = serde_json::to_string(&value).expect("plain values");
    assert_eq!(written, text);
    let read: T = serde_json::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    assert_eq!(format!("{read:?}"), format!("{value:?}"));
}

/// Checks that a text is no value of the type, and why.
fn refused<T: DeserializeOwned + Debug>(text: &str, reason: &str) {
    let error = serde_json::from_str::<T>(text).expect_err(text).to_string();
    assert!(error.contains(reason), "{text}: {error}");
}

#[test]
fn geometry_is_its_numbers() {
    is(Point3::<World>::new(Vec3::new(1.0, -2.5, 3.0)), "[1.0,-2.5,3.0]");
    is(math::Vector2::<Eye>::new(Vec2::new(0.1, 1e30)), "[0.1,1e+30]");
    is(
        Frame::<Object, World>::at(Point3::new(Vec3::new(7.0, 8.0, 9.0))),
        r#"{"axes":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],"origin":[7.0,8.0,9.0]}"#,
    );
    is(math::Frame2::<Object, World>::IDENTITY, r#"{"axes":[1.0,0.0,0.0,1.0],"origin":[0.0,0.0]}"#);
    is((Flat(2.0_f32), Linear(3.0_f32)), "[2.0,3.0]");
    is(Rgba8::new(1, 2, 3, 4), "[1,2,3,4]");
    is(Rgba565::from_bits(1234), "1234");
    refused::<Point3<World>>("[1.0,2.0]", "expected");
    refused::<Rgba8>("[1,2,3,256]", "256");
}

#[test]
fn policies_are_their_names() {
    is(
        MCU,
        r#"{"interpolation":{"FixedPoint":"Spans16"},"subpixel":"Sub4","color":"Rgb565Be","depth":"D16"}"#,
    );
    is(REFERENCE, r#"{"interpolation":"Exact","subpixel":"Sub8","color":"Rgba8888","depth":"F32Reversed"}"#);
    is(OrEqual(D24), r#"{"OrEqual":"D24"}"#);
    is(
        Biased { format: D16, constant: -2.0, slope: 0.5, clamp: 0.0 },
        r#"{"format":"D16","constant":-2.0,"slope":0.5,"clamp":0.0}"#,
    );
    is((AnyDepth::F32, Cull::None, Sides::Cube, AnyDerivatives::PerRun), r#"["F32","None","Cube","PerRun"]"#);
    is(Dithered { format: Grey4, by: Bayer }, r#"{"format":"Grey4","by":"Bayer"}"#);
    is(Blended { format: Rgb565Le, by: Over }, r#"{"format":"Rgb565Le","by":"Over"}"#);
    is((AnyBlend::Constant(128), AnyBlend::Replace), r#"[{"Constant":128},"Replace"]"#);
    is((AnyWrap::Border(Rgba8::BLACK), AnyFilter::Bilinear), r#"[{"Border":[0,0,0,255]},"Bilinear"]"#);
    is(AnyMipFilter::Anisotropic { probes: 8 }, r#"{"Anisotropic":{"probes":8}}"#);
    let filter = Minify { min: NearestLevel(Bilinear), mag: Bilinear };
    is(filter, r#"{"min":{"NearestLevel":"Bilinear"},"mag":"Bilinear"}"#);
    let bounds = LodBounds { bias: -0.5, least: 0.0, greatest: 4.0 };
    is(
        Bounded { filter: Anisotropic { probes: 2, filter: Trilinear }, bounds },
        r#"{"filter":{"probes":2,"filter":"Trilinear"},"bounds":{"bias":-0.5,"least":0.0,"greatest":4.0}}"#,
    );
    is(
        (AnyParallax::Steep { layers: 16 }, NormalEncoding::Centred),
        r#"[{"Steep":{"layers":16}},"Centred"]"#,
    );
    is(AnyEnvironment::CubeMap(CubeMap { side: 64 }), r#"{"CubeMap":{"side":64}}"#);
    is((AnyReflectance::Phong([1, 64]), Mix::Add), r#"[{"Phong":[1,64]},"Add"]"#);
    is((ClipSpace::Vulkan, Handedness::Left), r#"["Vulkan","Left"]"#);

    refused::<D16>("\"D24\"", "unknown variant `D24`, expected `D16`");
    refused::<FixedPoint<Spans16>>("\"Spans16\"", "expected `FixedPoint`");
    refused::<FixedPoint<Spans16>>(r#"{"FixedPoint":"Affine"}"#, "expected `Spans16`");
    refused::<AnyDepth>("\"D20\"", "expected one of `NoDepth`, `D16`");
}

#[test]
fn lines_are_one_of_their_constructors() {
    is(Lines::affine(), "\"Affine\"");
    is(Lines::spans(32).expect("a power of two"), r#"{"Spans":32}"#);
    is(Lines::bounded(0.25), r#"{"Bounded":0.25}"#);
    for length in [0, -4, 12, 128] {
        let text = format!(r#"{{"Spans":{length}}}"#);
        refused::<Lines>(&text, &format!("spans of {length} columns, expected a power of two from 1 to 64"));
    }
}

/// A value that is read again as the same bit by bit.
fn stays<T: Serialize + DeserializeOwned + Debug + PartialEq>(value: T) -> String {
    let text = serde_json::to_string(&value).expect("plain values");
    assert_eq!(serde_json::from_str::<T>(&text).expect("as written"), value, "{text}");
    text
}

#[test]
fn views_are_checked_on_the_way_in() {
    is(Viewport::new(-3, 5, 320, 240).expect("within reach"), r#"{"x":-3,"y":5,"width":320,"height":240}"#);
    refused::<Viewport>(r#"{"x":0,"y":0,"width":0,"height":9}"#, "the viewport is empty");
    refused::<Viewport>(r#"{"x":16000,"y":0,"width":400,"height":9}"#, "more than 16384 pixels");

    // An opening of a right angle has cot 45° = 1.
    let lens = r#"{"scale":1.0,"scale_x":0.5,"near":0.5,"far":20.0}"#;
    let read: Perspective = serde_json::from_str(lens).expect("a lens");
    let right = Perspective::new(std::f32::consts::FRAC_PI_2, 2.0, 0.5, 20.0).expect("a lens");
    let at = Point3::new(Vec3::new(3.0, 4.0, 5.0));
    assert!((read.scale(at).coords - right.scale(at).coords).length() < 1e-6);
    assert_eq!(read.depth_map(true), right.depth_map(true));
    is(read, lens);
    is(
        Parallel::new(4.0, 2.0, -1.0, 3.0).expect("a box"),
        r#"{"scale":0.5,"scale_x":0.25,"near":-1.0,"far":3.0}"#,
    );

    for (from, to, reason) in [
        ("0.5,\"far\"", "30.0,\"far\"", "near < far"),
        ("1.0", "-1.0", "opening angle"),
        ("1.0", "1e300", "opening angle"),
        (":0.5,\"near", ":0.0,\"near", "aspect"),
        (":0.5,\"near", ":-2.0,\"near", "aspect"),
    ] {
        let bad = lens.replacen(from, to, 1);
        assert_ne!(bad, lens);
        refused::<Perspective>(&bad, reason);
        refused::<AnyProjection>(&format!(r#"{{"Perspective":{bad}}}"#), reason);
    }
    refused::<Parallel>(r#"{"scale":0.0,"scale_x":0.25,"near":-1.0,"far":3.0}"#, "height");
    refused::<Parallel>(r#"{"scale":0.5,"scale_x":0.25,"near":4.0,"far":3.0}"#, "near < far");

    let camera = Camera::look_at(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y).expect("a direction");
    stays(camera);
    for step in 1_u8..60 {
        let part = f32::from(step) / 20.0;
        stays(Perspective::new(part, 1.0 / part, 0.1 * part, 7.0 + part).expect("a lens"));
        stays(Projection::with_aspect(Parallel::new(part, 2.0, -part, 7.0 + part).expect("a box"), 1.7));
        stays(View::<AnyProjection>::from(camera.perspective(part, 0.1..10.0).expect("a view")));
    }
}

#[test]
fn counts_and_parts_of_meshes_stay() {
    assert!(stays(Stats { drawn: u64::MAX, ..Stats::default() }).contains("\"drawn\":18446744073709551615"));
    stays(Ball { center: Vec3::new(0.1, 0.2, 0.3), radius: 0.4 });
    let vertices = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |place| (*place, ()));
    stays(Meshlet::new(&mesh, &Ball { center: Vec3::ZERO, radius: 1.0 }, 0..1));
}

#[test]
fn lights_are_made_as_by_their_constructors() {
    let white = Vec3::new(1.0, 0.5, 0.25);
    is(
        Directional::new(Vector3::new(Vec3::Y * 9.0), white),
        r#"{"to_light":[0.0,1.0,0.0],"color":[1.0,0.5,0.25]}"#,
    );
    // A direction of any length in a file, and none where there is none.
    let read = |text: &str| serde_json::from_str::<Directional>(text).expect("a light");
    let sun = |x, y, z| Directional::new(Vector3::new(Vec3::new(x, y, z)), white);
    assert_eq!(read(r#"{"to_light":[3.0,0.0,-4.0],"color":[1.0,0.5,0.25]}"#), sun(0.6, 0.0, -0.8));
    assert_eq!(read(r#"{"to_light":[0.0,0.0,0.0],"color":[1.0,0.5,0.25]}"#), sun(0.0, 0.0, 0.0));
    let bulb = PointLight { position: Point3::new(Vec3::X), color: white, falloff: [1.0, 0.0, 0.25] };
    let text = r#"{"position":[1.0,0.0,0.0],"color":[1.0,0.5,0.25],"falloff":[1.0,0.0,0.25]}"#;
    is(bulb, text);
    is(
        AnyLight::Spot(SpotLight::new(bulb, Vector3::new(Vec3::NEG_Y), [0.9, 0.8])),
        &format!(r#"{{"Spot":{{"point":{text},"axis":[0.0,-1.0,0.0],"cosines":[0.9,0.8]}}}}"#),
    );
    for step in 1_u8..100 {
        let part = f32::from(step) / 20.0;
        let along = Vector3::new(Vec3::new(part, 1.0 - part, 0.3));
        stays(Directional::new(along, white));
        // An edge that is too sharp stays as sharp as it can be.
        stays(SpotLight::new(bulb, along, [0.5, 0.5 - 0.001 * part]));
    }
    refused::<AnyLight>(r#"{"Sun":[]}"#, "expected one of `Directional`, `Point`, `Spot`");
}

#[test]
fn grids_and_projectors_are_checked_on_the_way_in() {
    is(Grid::new(4, 16384), r#"{"columns":4,"rows":16384,"of_texels":false}"#);
    is(Grid::of_texels(64, 32), r#"{"columns":63,"rows":31,"of_texels":true}"#);
    is(Subdivision::new(7), r#"{"parts":7}"#);
    refused::<Grid>(r#"{"columns":0,"rows":4,"of_texels":false}"#, "0 pieces of a side, expected 1 to 16384");
    refused::<Grid>(r#"{"columns":4,"rows":16385,"of_texels":true}"#, "16385 pieces of a side");
    refused::<Subdivision>(r#"{"parts":0}"#, "expected 1 to 16384");

    // A right angle, and an image twice as wide as high: to the right it is scaled by a half.
    let text = r#"{"eye":[0.0,2.0,0.0],"right":[0.5,0.0,0.0],"up":[0.0,1.0,0.0],"forward":[0.0,0.0,-1.0]}"#;
    let read: Projector = serde_json::from_str(text).expect("a projector");
    let shown = read.project(Point3::new(Vec3::new(3.0, 4.0, -5.0)));
    assert_eq!([shown.u, shown.v, shown.q], [1.5, 2.0, 5.0]);
    is(read, text);
    let mut far: serde_json::Value = serde_json::from_str(text).expect("a value");
    far["up"][1] = 1e39.into();
    let error = serde_json::from_value::<Projector>(far).expect_err("infinite as f32").to_string();
    assert!(error.contains("finite"), "{error}");
    for step in 1_u8..60 {
        let at = Point3::new(Vec3::splat(f32::from(step)));
        let place = look_at(at, Point3::new(Vec3::X), Vector3::new(Vec3::Y)).expect("a place");
        stays(Projector::new(place, f32::from(step) / 20.0, 1.5).expect("a projector"));
    }
}
