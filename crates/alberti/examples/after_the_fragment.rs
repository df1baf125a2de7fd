//! A torus six times: behind glass, in light that is added, in fog, with holes, as wires on its surface, and
//! supersampled beside itself. Below the first three in the 16 greys of a small display, dithered.
//!
//!     cargo run --release -p alberti --example after_the_fragment -- after_the_fragment.png

mod common;

use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::raster::color::{
    Additive, Average, Bayer, Blended, BlueNoise, Dithered, Grey4, Over, ReadColor, resolve,
};
use alberti::shaders::fog::{ExponentialFog, Fog, Fogged};
use alberti::shaders::{AlphaDither, Solid, Sunlit};
use alberti::texture::surface::{Grid, Parametric, Torus};
use alberti::*;
use std::process::ExitCode;

/// Of each of the pictures.
const SIZE: [u32; 2] = [100, 75];
const PIXELS: usize = (SIZE[0] * SIZE[1]) as usize;
const GRID: Grid = Grid::new(36, 18);
const SAND: Rgba8 = Rgba8::from_rgb24(0xe0_b0_68);

/// A point of the torus and its normal.
#[derive(Clone, Copy)]
struct Point {
    position: Vec3,
    normal: Vec3,
}

fn main() -> ExitCode {
    common::write("after_the_fragment.png", picture)
}

fn picture() -> common::File {
    let colored = [glass()?, glow()?, fog()?, holes()?, wires()?, smooth()?];
    let greys = [grey(&colored[0], Bayer), grey(&colored[1], BlueNoise), grey(&colored[2], BlueNoise)];
    let columns = SIZE[0] as usize;
    let mut pixels = Vec::new();
    for pictures in [&colored[..3], &colored[3..], &greys] {
        for row in 0..SIZE[1] as usize {
            pixels.extend(pictures.iter().flat_map(|picture| &picture[row * columns..][..columns]));
        }
    }
    common::png(3 * SIZE[0], &pixels)
}

type Pixels = Vec<u32>;
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn torus() -> (Vec<Point>, Vec<[u32; 3]>) {
    let torus = Torus { major: 1.0, minor: 0.42 };
    let turned = Mat3::from_rotation_x(0.9) * Mat3::from_rotation_z(0.3);
    let point = |k| {
        let uv: Vec2 = GRID.uv(k);
        let frame = torus.orthonormal_frame(uv);
        let position: Point3<Object> = frame.origin();
        Point { position: turned * position.coords, normal: turned * frame.axes().z_axis }
    };
    let count = |n: usize| u32::try_from(n).unwrap_or(0);
    let triangles = (0..count(GRID.triangles())).map(|k| GRID.triangle(k)).collect();
    ((0..count(GRID.vertices())).map(point).collect(), triangles)
}

fn view() -> std::result::Result<View, ViewError> {
    Camera::look_at(Vec3::Z * 4.2, Vec3::ZERO, Vec3::Y)?.perspective(0.66, 1.0..10.0)
}

fn lit(color: Rgba8) -> Sunlit<Solid> {
    Sunlit::new(Solid(color), Vector3::new(Vec3::new(0.4, 0.7, 0.6)), 0.25, 0.8)
}

/// A picture with the torus in it; `then` draws the rest.
fn with_torus(
    then: impl FnOnce(&mut Target<'_, Rgba8888, F32Reversed>, &View) -> Result<()>,
) -> Result<Pixels> {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
    let mut target = Target::new(Rgba8888, F32Reversed, SIZE[0], SIZE[1], &mut color, &mut depth)?;
    target.clear(common::BACKGROUND);
    let view = view()?;
    let (vertices, triangles) = torus();
    let mesh = Mesh::new(&vertices, &triangles, |v: &Point| (v.position, (v.normal, ())));
    draw(&mut target, &view, &mesh, lit(SAND));
    then(&mut target, &view)?;
    Ok(color)
}

/// A square of this half side through a point, seen from the front.
fn square(at: Vec3, half: f32) -> [Vec3; 4] {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| at + Vec3::new(x * half, y * half, 0.0))
}

const SQUARE: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

fn glass() -> Result<Pixels> {
    with_torus(|target, view| {
        let mut glass = target.with_color(Blended { format: Rgba8888, by: Over });
        for (at, color) in
            [(Vec3::new(-0.35, 0.2, 0.9), 0x30_c0_a0), (Vec3::new(0.4, -0.25, 1.2), 0xd0_40_60)]
        {
            let [r, g, b, _] = Rgba8::from_rgb24(color).to_bytes();
            let vertices = square(at, 0.55);
            let mesh = Mesh::new(&vertices, &SQUARE, |v: &Vec3| (*v, ()));
            draw(&mut glass, view, &mesh, Solid(Rgba8::new(r, g, b, 130)));
        }
        Ok(())
    })
}

fn glow() -> Result<Pixels> {
    with_torus(|target, view| {
        let mut light = target.with_color(Blended { format: Rgba8888, by: Additive });
        // Brighter towards the middle, whose alpha is the greatest.
        let stage = |uv: Vec2| {
            let bright = (1.0 - uv.length()).max(0.0);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
            let alpha = (bright * bright * 255.0) as u8;
            Some(Rgba8::new(255, 150, 60, alpha))
        };
        for at in [Vec3::new(0.9, 0.5, 0.2), Vec3::new(-0.8, -0.4, 0.5)] {
            let vertices = square(at, 0.9);
            let mesh = Mesh::new(&vertices, &SQUARE, move |v: &Vec3| (*v, ((*v - at) / 0.9).truncate()));
            draw(&mut light, view, &mesh, stage);
        }
        Ok(())
    })
}

fn fog() -> Result<Pixels> {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
    let mut target = Target::new(Rgba8888, F32Reversed, SIZE[0], SIZE[1], &mut color, &mut depth)?;
    target.clear(common::BACKGROUND);
    let (view, fog) = (view()?, ExponentialFog { density: 0.9 });
    let to_eye = view.object_to_eye(None);
    let (vertices, triangles) = torus();
    let mesh = Mesh::new(&vertices, &triangles, |v: &Point| {
        // It begins at the nearest part.
        let distance = to_eye.to_parent(Point3::new(v.position)).coords.z - 3.2;
        (v.position, (fog.coordinate(distance), (v.normal, ())))
    });
    draw(&mut target, &view, &mesh, Fogged { surface: lit(SAND), fog, color: common::BACKGROUND });
    Ok(color)
}

fn holes() -> Result<Pixels> {
    with_torus(|target, view| {
        for (at, alpha) in [(Vec3::new(-0.35, 0.2, 0.9), 96), (Vec3::new(0.4, -0.25, 1.2), 160)] {
            let vertices = square(at, 0.55);
            let mesh = Mesh::new(&vertices, &SQUARE, |v: &Vec3| (*v, ()));
            let color = Rgba8::new(0x30, 0xc0, 0xa0, alpha);
            draw(target, view, &mesh, AlphaDither { surface: Solid(color), by: Bayer });
        }
        Ok(())
    })
}

fn wires() -> Result<Pixels> {
    let (vertices, triangles) = torus();
    with_torus(|target, view| {
        let mesh = Mesh::new(&vertices, &triangles, |v: &Point| (v.position, ()));
        let bias = Biased { format: F32Reversed, constant: -2.0, slope: -1.0, clamp: 0.0 };
        let mut pass = Pass::new(view, &mesh, Solid(Rgba8::from_rgb24(0x90_58_18)));
        let mut room = vec![[0; 2]; 3 * triangles.len()];
        let edges = mesh.unique_edges(&mut room).unwrap_or_default();
        pass.draw_lines(&mut target.with_depth(bias), edges.iter().copied());
        // A point has no slope, so that what it stands on has to be left behind by steps.
        let bias = Biased { constant: -60_000.0, slope: 0.0, ..bias };
        let mut pass = Pass::new(view, &mesh, Solid(Rgba8::WHITE));
        pass.draw_points(&mut target.with_depth(bias), (0..mesh.vertices()).step_by(19), 2);
        Ok(())
    })
}

/// Without supersampling on the left, with 16 samples on the right.
fn smooth() -> Result<Pixels> {
    const FACTOR: u32 = 4;
    let plain = with_torus(|_, _| Ok(()))?;
    let [width, height] = SIZE.map(|side| side * FACTOR);
    let rows = (15 * FACTOR * width) as usize;
    let (mut color, mut depth) = (vec![0; rows], vec![0.0; rows]);
    let mut bands = Bands::new(Rgba8888, F32Reversed, width, height, &mut color, &mut depth)?;
    let view = view()?;
    let (vertices, triangles) = torus();
    let mesh = Mesh::new(&vertices, &triangles, |v: &Point| (v.position, (v.normal, ())));
    let mut pixels = vec![0; PIXELS];
    let columns = SIZE[0] as usize;
    bands.draw(common::BACKGROUND, |band| {
        draw(band, &view, &mesh, lit(SAND));
        let first = band.limits()[1].start / 4;
        let own = &mut pixels[first.unsigned_abs() as usize * columns..];
        resolve((Rgba8888, band.pixels()), (Rgba8888, own), columns, first, 4, Average::Light);
    });
    let half = columns / 2;
    for (smooth, plain) in pixels.chunks_mut(columns).zip(plain.chunks(columns)) {
        smooth[..half].copy_from_slice(&plain[..half]);
    }
    Ok(pixels)
}

/// The same in 16 greys.
fn grey(picture: &[u32], by: impl raster::color::Pattern) -> Pixels {
    let mut greys = vec![0; PIXELS];
    let format = Dithered { format: Grey4, by };
    resolve((Rgba8888, picture), (format, &mut greys), SIZE[0] as usize, 0, 1, Average::Bytes);
    greys.into_iter().map(|level| Grey4.color(level).to_bits()).collect()
}
