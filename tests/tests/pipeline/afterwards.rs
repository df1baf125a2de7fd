//! Blends, dithers, fogs and holes, drawn by passes over a whole frame: in floats by one lane and by several, and in
//! fixed point. Each is held against its formula in `f64`. The places that a pixel shows are found by rays, or, without
//! perspective, on the screen.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "bytes, and frames are small"
)]

mod blends;
mod formats;
mod stages;

use alberti::glam::{Vec2, Vec3};
use alberti::texture::{Nearest, Repeat, Sampler, Texture, format};
use alberti::{
    Affine, Camera, ColorFormat, Cull, Exact, FixedPoint, FragmentStage, Interpolation, Mesh, NoDepth, Pass,
    Target, Varying, View,
};
use alberti_math::lanes::{Floating, One};
use alberti_oracle::coverage::weights;
use alberti_oracle::ideal::see_ideal;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_oracle::{cases, dd, material, scene, snapped};
use alberti_tests::for_widest;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const FOV: f64 = 60.0;
const NEAR: f32 = 0.5;
const FAR: f32 = 20.0;

/// A triangle over the whole frame: places on the screen, distances, and u. The other coordinate is half the distance.
const CORNERS: [([f64; 2], f64, f32); 3] =
    [([-40.33, -30.71], 2.0, -0.3), ([330.28, -20.42], 8.0, 5.7), ([-20.67, 300.37], 6.0, 1.1)];

/// A vertex: its place in the world, its distance, its texture coordinates.
#[derive(Clone, Copy, Debug)]
struct Corner {
    place: Vec3,
    uv: Vec2,
}

fn corners() -> [Corner; 3] {
    let scale = f64::from(HEIGHT) / 2.0 / (FOV.to_radians() / 2.0).tan();
    CORNERS.map(|([x, y], z, u)| {
        let [x, y] =
            [x - f64::from(WIDTH) / 2.0, f64::from(HEIGHT) / 2.0 - y].map(|c| (c / scale * z) as f32);
        Corner { place: Vec3::new(x, y, -z as f32), uv: Vec2::new(u, (z / 2.0) as f32) }
    })
}

/// The coordinates at each pixel, by rays in space.
fn in_space() -> Vec<[f64; 2]> {
    let vertex = |corner: Corner| scene::Vertex {
        position: corner.place.to_array().map(f64::from),
        normal: [0.0, 0.0, 1.0],
        uv: corner.uv.to_array().map(f64::from),
        color: [0.0; 3],
    };
    let vertices = corners().map(vertex);
    let part = scene::Part { triangles: &[[0, 1, 2]], diffuse: [1.0; 3], texture: None };
    let seen = see_ideal(&scene::Scene {
        vertices: &vertices,
        parts: &[part],
        textures: &[],
        camera: scene::Camera {
            eye: [0.0; 3],
            target: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            fov: FOV,
            near: NEAR.into(),
            far: FAR.into(),
        },
        width: WIDTH,
        height: HEIGHT,
        cull: scene::Cull::None,
        shading: scene::Shading::Unlit,
        filter: scene::Filter::Nearest,
        wrap: scene::Wrap::Repeat,
        background: [0; 3],
    });
    seen.into_iter().map(|seen| seen.expect("the whole frame is covered").uv).collect()
}

/// The coordinates at each pixel, by a plane over the screen through those of the snapped vertices.
fn on_screen() -> Vec<[f64; 2]> {
    let corners = corners();
    let tri = CORNERS.map(|(at, ..)| at.map(|c| snapped::snap(c, 8)));
    let at = |k: usize| {
        let sample = cases::pixel_centre((k % WIDTH as usize) as i64, (k / WIDTH as usize) as i64, 8);
        assert!(
            weights(tri, sample).iter().all(|weight| weight.signum() == weights(tri, sample)[0].signum())
        );
        [0, 1].map(|axis| dd::linear(tri, sample, corners.map(|corner| corner.uv[axis])).to_f64())
    };
    (0..PIXELS).map(at).collect()
}

/// A pixel: its number, the coordinates that it shows, and how far off these may be.
#[derive(Clone, Copy, Debug)]
struct Place {
    k: usize,
    uv: [f64; 2],
    off: f64,
}

impl Place {
    /// The nearest texel, unless another is as near as coordinates may be off.
    fn texel(self, texels: &[[u8; 4]]) -> Option<[u8; 4]> {
        let texture = scene::Texture { width: SIDE, height: SIDE, texels };
        let at = |[u, v]: [f64; 2]| {
            material::nearest(&texture, [self.uv[0] + u * self.off, self.uv[1] + v * self.off])
        };
        let [first, others @ ..] = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]].map(at);
        others.iter().all(|other| *other == first).then_some(first)
    }

    /// The column and the row.
    fn of_frame(self) -> [usize; 2] {
        [self.k % WIDTH as usize, self.k / WIDTH as usize]
    }
}

const SIDE: u32 = 8;

/// Texels of odd red and any alpha, a quarter of which are the same.
fn texels() -> Vec<[u8; 4]> {
    let mut rng = Rng::stream(run_seed(), 77);
    let texel = |k: u32| if k % 4 == 1 { KEY } else { (rng.u64() as u32 | 1).to_le_bytes() };
    (0..SIDE * SIDE).map(texel).collect()
}

const KEY: [u8; 4] = [0x1f, 0x7a, 0, 200];

/// The first two bytes of the texels, the low one first.
fn words(texels: &[[u8; 4]]) -> Vec<u16> {
    texels.iter().map(|&[low, high, ..]| u16::from_le_bytes([low, high])).collect()
}

fn sampler<F: format::TexelFormat>(
    format: F,
    texels: &[F::Texel],
) -> Sampler<'_, F, Nearest, Repeat, Repeat> {
    Texture::new(format, texels, SIDE, SIDE).expect("a texture").sampler(Nearest, Repeat)
}

fn drawn<C: ColorFormat, V: Varying>(
    format: C,
    before: &[C::Pixel],
    vertex: impl Fn(&Corner) -> (Vec3, V),
    stage: impl FragmentStage<V>,
    interpolation: impl Interpolation,
    lanes: impl Floating,
) -> Vec<C::Pixel> {
    let (mut color, mut depth) = (before.to_vec(), vec![(); PIXELS]);
    let view: View = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y)
        .and_then(|camera| camera.perspective((FOV.to_radians()) as f32, NEAR..FAR))
        .expect("a view");
    let corners = corners();
    let mesh = Mesh::new(&corners, &[[0_u16, 1, 2]], vertex);
    let mut target = Target::new(format, NoDepth, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    let pass = Pass::new(&view, &mesh, stage).cull(Cull::None);
    pass.interpolation(interpolation).draw_by(lanes, &mut target);
    color
}

/// Draws over `before` and hands each pixel to `check`, which says whether it was any; most have to be.
fn each<C: ColorFormat<Pixel: PartialEq>, V: Varying>(
    format: C,
    before: impl Fn(usize) -> C::Pixel,
    vertex: impl Fn(&Corner) -> (Vec3, V) + Copy,
    stage: impl FragmentStage<V>,
    mut check: impl FnMut(Place, C::Pixel) -> bool,
) {
    let before: Vec<C::Pixel> = (0..PIXELS).map(before).collect();
    let exact = drawn(format, &before, vertex, stage, Exact, One);
    let several = for_widest!(lanes => drawn(format, &before, vertex, stage, Exact, lanes));
    assert!(exact == several, "{format:?}: lanes change pixels");
    let fixed = drawn(format, &before, vertex, stage, FixedPoint(Affine), One);
    // In space the way of a vertex is rounded to 2^-16 pixel; on the screen a step of 2^-16 is lost by column.
    let ways = [(exact, in_space(), 1e-4), (fixed, on_screen(), f64::from(WIDTH + 4) / 65536.0)];
    for (pixels, places, off) in ways {
        let mut checked = 0;
        for (k, (pixel, uv)) in pixels.into_iter().zip(places).enumerate() {
            checked += u32::from(check(Place { k, uv, off }, pixel));
        }
        assert!(checked > WIDTH * HEIGHT * 3 / 4, "{format:?}: {checked} pixels");
    }
}

fn bare(corner: &Corner) -> (Vec3, Vec2) {
    (corner.place, corner.uv)
}

/// Red, green and blue of a word, and their greatest levels.
fn levels(word: u16) -> [f64; 3] {
    [word >> 11, word >> 5 & 63, word & 31].map(f64::from)
}

const GREATEST: [f64; 3] = [31.0, 63.0, 31.0];

/// The order of the thresholds of 2n by 2n pixels, from that of n by n.
fn bayer([column, row]: [usize; 2]) -> usize {
    let (mut rank, mut factor) = (0, 16);
    for bit in 0..3 {
        let quarter = [[0, 2], [3, 1]][row >> bit & 1][column >> bit & 1];
        rank += quarter * factor;
        factor /= 4;
    }
    rank
}
