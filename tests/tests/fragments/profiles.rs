//! A profile is its policies: what `Pass::with` and `Profile::target` draw is drawn by these as well, one by one.
//!
//! The four built-in ones and one of this file; the policies named here are those of the documentation's table.

use alberti::glam::Vec3;
use alberti::lanes::One;
use alberti::{
    Affine, Camera, ColorFormat, Cull, D16, D24, DESKTOP, DepthFormat, Exact, F32, F32Reversed, FixedPoint,
    Interpolation, Lines, MCU, Mesh, NoDepth, Pass, Profile, REFERENCE, Rgb565Be, Rgb565Le, Rgba8, Rgba8888,
    Spans16, Sub4, Sub8, Subpixel, TINY, Target,
};
use std::fmt::Debug;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// Three sheets through each other that lean away: vertices with their colours.
const VERTICES: [(Vec3, Vec3); 9] = [
    (Vec3::new(-1.3, -0.9, 0.5), Vec3::new(1.0, 0.2, 0.1)),
    (Vec3::new(1.2, -0.8, 0.4), Vec3::new(0.1, 0.9, 0.3)),
    (Vec3::new(0.1, 1.1, -3.0), Vec3::new(0.2, 0.3, 1.0)),
    (Vec3::new(-1.1, 0.9, 0.3), Vec3::new(0.9, 0.8, 0.1)),
    (Vec3::new(0.2, -1.2, -2.0), Vec3::new(0.1, 0.8, 0.9)),
    (Vec3::new(1.4, 0.7, 0.6), Vec3::new(0.7, 0.1, 0.8)),
    (Vec3::new(-2.0, -0.2, -4.0), Vec3::new(1.0, 1.0, 1.0)),
    (Vec3::new(2.0, -0.3, 0.9), Vec3::new(0.5, 0.4, 0.3)),
    (Vec3::new(-0.3, 0.4, 0.2), Vec3::new(0.0, 0.1, 0.2)),
];

/// Both ways' pixels and depths.
fn assert_same<I, C, D>(
    profile: Profile<I, C, D>,
    (interpolation, subpixel): (impl Interpolation, Subpixel),
    (color_format, depth_format): (C, D),
) where
    I: Interpolation,
    C: ColorFormat<Pixel: Default + PartialEq + Debug>,
    D: DepthFormat<Stored: PartialEq>,
{
    let triangles = [[0u16, 1, 2], [3, 4, 5], [6, 7, 8]];
    let mesh = Mesh::new(&VERTICES, &triangles, |v| *v);
    let camera = Camera::look_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y).expect("a camera");
    let view = camera.perspective(1.0, 0.1..10.0).expect("a view");
    let stage = |v: Vec3| {
        let [r, g, b] = (v * 255.0).to_array().map(f32::to_bits);
        Some(Rgba8::from_bits(r ^ g.rotate_left(8) ^ b.rotate_left(16)))
    };
    let buffers = || (vec![C::Pixel::default(); PIXELS], vec![depth_format.farthest(); PIXELS]);

    let mut found = buffers();
    let mut target = profile.target(WIDTH, HEIGHT, &mut found.0, &mut found.1).expect("a target");
    target.clear(Rgba8::BLACK);
    let black = target.pixels()[0];
    Pass::new(&view, &mesh, stage).cull(Cull::None).with(profile).draw_by(One, &mut target);

    let mut expected = buffers();
    let (color, depth) = (&mut expected.0, &mut expected.1);
    let mut target = Target::new(color_format, depth_format, WIDTH, HEIGHT, color, depth).expect("a target");
    target.clear(Rgba8::BLACK);
    Pass::new(&view, &mesh, stage)
        .cull(Cull::None)
        .interpolation(interpolation)
        .subpixel(subpixel)
        .draw_by(One, &mut target);
    assert!(found == expected, "{profile:?}");
    assert!(found.0.iter().filter(|&&pixel| pixel != black).count() > PIXELS / 4, "{profile:?}");

    // And its bands are the frame's.
    let mut memory = (vec![C::Pixel::default(); PIXELS / 4], vec![depth_format.farthest(); PIXELS / 4]);
    let mut bands = profile.bands(WIDTH, HEIGHT, &mut memory.0, &mut memory.1).expect("bands");
    let mut pass = Pass::new(&view, &mesh, stage).cull(Cull::None).with(profile);
    let mut frame = Vec::new();
    while let Some(mut band) = bands.next_band() {
        band.clear(Rgba8::BLACK);
        pass.draw_by(One, &mut band);
        frame.extend_from_slice(band.pixels());
    }
    assert!(frame == expected.0, "{profile:?} in bands");
}

#[test]
fn a_profile_is_its_policies() {
    assert_same(REFERENCE, (Exact, Sub8), (Rgba8888, F32Reversed));
    assert_same(DESKTOP, (Exact, Sub8), (Rgba8888, F32));
    assert_same(MCU, (FixedPoint(Spans16), Sub4), (Rgb565Be, D16));
    assert_same(TINY, (FixedPoint(Affine), Sub4), (Rgb565Be, NoDepth));
    let lines = Lines::bounded(1.0 / 256.0);
    let mine = Profile { interpolation: lines, subpixel: Sub4, color: Rgb565Le, depth: D24 };
    assert_same(mine, (lines, Sub4), (Rgb565Le, D24));
}

/// Those of the documentation's table.
#[test]
fn a_pixel_takes_the_bytes_that_the_table_says() {
    fn bytes<I, C: ColorFormat, D: DepthFormat>(_: Profile<I, C, D>) -> usize {
        size_of::<C::Pixel>() + size_of::<D::Stored>()
    }
    assert_eq!([bytes(REFERENCE), bytes(DESKTOP), bytes(MCU), bytes(TINY)], [8, 8, 4, 2]);
}
