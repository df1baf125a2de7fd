//! Tests of pictures of many samples, against one that is drawn larger and averaged in 64 bits.

use super::*;
use crate::options::values::Color;
use crate::options::{LightOptions, Shading};
use crate::render::render;
use crate::scenes;

const PLAIN: Backdrop = Backdrop::Color([20, 40, 60]);

fn scene(name: &str, width: u32, height: u32) -> (Model, Camera, RenderOptions) {
    let scene = scenes::by_name(name).expect("a scene");
    let options = RenderOptions {
        width,
        height,
        background: [20, 40, 60],
        haze: None,
        shading: scene.shading,
        filter: scene.filter,
        wrap: scene.wrap,
        light: LightOptions::default(),
        cull: scene.cull,
        depth: scene.depth,
        projection: crate::options::Projection::Perspective,
        threads: NonZero::<usize>::MIN,
        policies: crate::options::Policies::default(),
    };
    (scene.model, scene.camera, options)
}

fn light(byte: u8) -> f64 {
    let s = f64::from(byte) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
}

fn byte(light: f64) -> f64 {
    255.0 * if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn pixels_are_the_mean_light_of_a_larger_picture() {
    for (name, samples) in [("mesh", Samples::Four), ("cube", Samples::Sixteen), ("mesh", Samples::One)] {
        let (model, camera, options) = scene(name, 75, 50);
        let made =
            supersampled(&model, &camera, &options, samples, &PLAIN, &mut |_, _| ()).expect("a picture");
        let n = samples.side() as usize;
        let larger = RenderOptions { width: 75 * samples.side(), height: 50 * samples.side(), ..options };
        let large = render(&model, &camera, &larger, &mut |_, _| ()).expect("a picture").image.texels;
        for (k, texel) in made.image.texels.iter().enumerate() {
            let (x, y) = (k % 75 * n, k / 75 * n);
            for channel in 0..3 {
                let of = (0..n * n).map(|s| light(large[(y + s / n) * 75 * n + x + s % n][channel]));
                let right = byte(of.sum::<f64>() / f64::from(samples.side().pow(2)));
                assert!((f64::from(texel[channel]) - right).abs() <= 1.0, "{name} {k} {texel:?} {right}");
            }
            assert_eq!(texel[3], 255);
        }
    }
}

#[test]
fn bands_and_threads_leave_the_picture_as_it_is() {
    let (model, camera, options) = scene("mesh", 64, 48);
    let alone =
        supersampled(&model, &camera, &options, Samples::Four, &PLAIN, &mut |_, _| ()).expect("a picture");
    let many = RenderOptions { threads: NonZero::new(5).expect("five"), ..options };
    let by_many =
        supersampled(&model, &camera, &many, Samples::Four, &PLAIN, &mut |_, _| ()).expect("a picture");
    assert_eq!(alone.image, by_many.image);
    let studio = Studio::new(&model, &camera, &options).expect("a studio");
    let mut drawing = Drawing::new(&model, &camera, &options, &studio).expect("a drawing");
    let mut band = Band { rows: 7, ..Band::new(&options, Samples::Four, &PLAIN).expect("memory") };
    let mut texels = vec![[0; 4]; 64 * 48];
    for (texels, first) in texels.chunks_mut(64 * 7).zip((0..).step_by(7)) {
        band.draw(&mut drawing, first, texels.len() / 64, &mut |_, _| ()).expect("a band");
        band.resolve(first, texels);
    }
    assert!(texels == alone.image.texels);
}

/// A triangle whose edge passes pixels at a known height.
#[test]
fn edges_cover_as_much_as_they_do() {
    // An edge from the left side, 10.25 rows from the top, to the right, 12.75 rows from it, of 32 columns.
    let (mut model, _, options) = scene("cube", 32, 24);
    let camera = Camera {
        eye: [0.0, 0.0, 12.0],
        target: [0.0; 3],
        near: 1.0,
        far: 100.0,
        fov: 90.0,
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
    };
    let at =
        |x: f32, y: f32| crate::scene::Vertex { position: [x - 16.0, 12.0 - y, 0.0], ..Default::default() };
    model.vertices = vec![at(-32.0, 7.75), at(64.0, 15.25), at(16.0, 400.0)];
    model.parts.truncate(1);
    model.parts[0].triangles = vec![[0, 1, 2], [0, 2, 1]];
    model.parts[0].diffuse = [1.0; 3];
    model.parts[0].texture = None;
    let options = RenderOptions { shading: Shading::Unlit, ..options };
    let made =
        supersampled(&model, &camera, &options, Samples::Sixteen, &Backdrop::Transparent, &mut |_, _| ());
    let (mut found, mut right) = (0.0, 0.0);
    for (k, texel) in (0_u16..).zip(&made.expect("a picture").image.texels) {
        let (x, y) = (f64::from(k % 32), f64::from(k / 32));
        let edge = |x: f64| 7.75 + (x + 32.0) * 7.5 / 96.0;
        // The mean over a thousand columns of the part that is below the edge.
        let part = (0..1000).map(|s| (y + 1.0 - edge(x + (f64::from(s) + 0.5) / 1000.0)).clamp(0.0, 1.0));
        let part = part.sum::<f64>() / 1000.0;
        let covered = f64::from(texel[3]) / 255.0;
        assert!((covered - part).abs() <= 0.13, "{x} {y}: {covered} of {part}");
        assert!(texel[3] == 0 || texel[..3] == [255; 3], "{texel:?}");
        found += covered;
        right += part;
    }
    assert!((found - right).abs() < 0.005 * right, "{found} {right}");
}

#[test]
fn a_transparent_picture_before_a_colour_is_the_opaque_one() {
    let (model, camera, options) = scene("mesh", 64, 48);
    let of = |backdrop: &Backdrop| {
        supersampled(&model, &camera, &options, Samples::Four, backdrop, &mut |_, _| ())
            .expect("a picture")
            .image
    };
    let (clear, opaque) = (of(&Backdrop::Transparent), of(&PLAIN));
    assert!(clear.texels.iter().any(|t| t[3] == 0) && clear.texels.iter().any(|t| (1..255).contains(&t[3])));
    let behind = Color::from([20, 40, 60]).bytes();
    for (clear, opaque) in clear.texels.iter().zip(&opaque.texels) {
        let share = f64::from(clear[3]) / 255.0;
        for channel in 0..3 {
            let mixed = byte(light(clear[channel]) * share + light(behind[channel]) * (1.0 - share));
            assert!((mixed - f64::from(opaque[channel])).abs() <= 2.0, "{clear:?} {opaque:?}");
        }
    }
}
