//! A torus and needles before a sky, three times as large as they are drawn: with a sample a pixel, with smooth edges
//! by the covered part of each pixel, and with 16 samples a pixel.
//!
//!     cargo run --release -p alberti --example smooth_edges -- smooth_edges.png

mod common;

use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::raster::color::{Average, resolve};
use alberti::shaders::{Solid, Sunlit};
use alberti::texture::surface::{Grid, Parametric, Torus};
use alberti::*;
use std::process::ExitCode;

/// Of each of the pictures, before they are made larger.
const SIZE: [u32; 2] = [80, 72];
const PIXELS: usize = (SIZE[0] * SIZE[1]) as usize;
/// The side of a pixel then.
const ZOOM: usize = 3;

fn main() -> ExitCode {
    common::write("smooth_edges.png", picture)
}

fn picture() -> common::File {
    let scene = Scene::new()?;
    let pictures = [scene.plain()?, scene.covered()?, scene.sampled()?];
    let columns = SIZE[0] as usize;
    let mut pixels = Vec::new();
    for row in (0..SIZE[1] as usize).flat_map(|row| [row; ZOOM]) {
        for picture in &pictures {
            let row = &picture[row * columns..][..columns];
            pixels.extend(row.iter().flat_map(|pixel| [*pixel; ZOOM]));
        }
    }
    common::png(3 * SIZE[0] * u32::try_from(ZOOM)?, &pixels)
}

type Pixels = Vec<u32>;
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// A point of a surface and its normal.
struct Point {
    position: Vec3,
    normal: Vec3,
}

type VertexStage = fn(&Point) -> (Vec3, (Vec3, ()));

fn lit() -> Sunlit<Solid> {
    Sunlit::new(Solid(Rgba8::from_rgb24(0xe0_b0_68)), Vector3::new(Vec3::new(0.4, 0.7, 0.6)), 0.25, 0.8)
}

struct Scene {
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    view: View,
}

/// The sky, darker towards the top. `rows` are the picture's.
fn sky(row: i32, rows: u32) -> Rgba8 {
    let [row, rows] = [row.unsigned_abs(), rows];
    let between =
        |from: u32, to: u32| u8::try_from((from * (rows - row) + to * row) / rows).unwrap_or(u8::MAX);
    Rgba8::new(between(24, 200), between(40, 170), between(80, 150), 255)
}

/// Clears each row to the sky.
fn clear(target: &mut Target<'_, Rgba8888, F32Reversed>) {
    let ([columns, rows], [_, height]) = (target.limits(), target.size());
    for row in rows {
        target.scissor(columns.clone(), row..row + 1).clear(sky(row, height));
    }
}

impl Scene {
    fn new() -> Result<Self> {
        let (torus, grid) = (Torus { major: 0.8, minor: 0.3 }, Grid::new(36, 18));
        let turned = Mat3::from_rotation_x(0.9) * Mat3::from_rotation_z(0.3);
        let point = |k| {
            let uv: Vec2 = grid.uv(k);
            let frame = torus.orthonormal_frame(uv);
            let position: Point3<Object> = frame.origin();
            Point { position: turned * position.coords, normal: turned * frame.axes().z_axis }
        };
        let count = |n: usize| u32::try_from(n).unwrap_or(0);
        let mut vertices: Vec<Point> = (0..count(grid.vertices())).map(point).collect();
        let mut triangles: Vec<[u32; 3]> = (0..count(grid.triangles())).map(|k| grid.triangle(k)).collect();
        // Two pixels wide in the middle, behind the torus, and pointed.
        for k in 0_u8..11 {
            let along = Mat3::from_rotation_z(0.2 + f32::from(k) * 0.571);
            let first = count(vertices.len());
            let corners = [Vec3::new(0.0, -0.02, 0.0), Vec3::new(1.5, 0.0, 0.0), Vec3::new(0.0, 0.02, 0.0)];
            vertices.extend(corners.map(|p| Point { position: along * p, normal: Vec3::new(0.4, 0.7, 0.6) }));
            triangles.push([first, first + 1, first + 2]);
        }
        let view = Camera::look_at(Vec3::Z * 4.2, Vec3::ZERO, Vec3::Y)?.perspective(0.66, 1.0..10.0)?;
        Ok(Self { vertices, triangles, view })
    }

    fn mesh(&self) -> Mesh<'_, Point, u32, VertexStage> {
        Mesh::new(&self.vertices, &self.triangles, |v| (v.position, (v.normal, ())))
    }

    /// A sample a pixel.
    fn plain(&self) -> Result<Pixels> {
        let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
        let mut target = Target::new(Rgba8888, F32Reversed, SIZE[0], SIZE[1], &mut color, &mut depth)?;
        clear(&mut target);
        draw(&mut target, &self.view, &self.mesh(), lit());
        Ok(color)
    }

    /// The same, and then silhouettes by the part of each pixel that is covered.
    fn covered(&self) -> Result<Pixels> {
        let (mut color, mut depth, mut cells) = (vec![0; PIXELS], vec![0.0; PIXELS], vec![0; PIXELS]);
        let mut target = Target::new(Rgba8888, F32Reversed, SIZE[0], SIZE[1], &mut color, &mut depth)?;
        clear(&mut target);
        let mesh = self.mesh();
        let mut pass = Pass::new(&self.view, &mesh, lit());
        pass.draw(&mut target);
        let mut silhouette = Silhouette::new(&target, &mut cells)?;
        pass.cover(&mut silhouette);
        let coverage = silhouette.coverage();
        pass.draw_fringe(&mut target, &coverage);
        coverage.resolve(&mut target, Average::Light, |[_, row]| sky(row, SIZE[1]));
        Ok(color)
    }

    /// 16 samples a pixel.
    fn sampled(&self) -> Result<Pixels> {
        let [width, height] = SIZE.map(|side| side * 4);
        let samples = 16 * PIXELS;
        let (mut color, mut depth) = (vec![0; samples], vec![0.0; samples]);
        let mut target = Target::new(Rgba8888, F32Reversed, width, height, &mut color, &mut depth)?;
        clear(&mut target);
        draw(&mut target, &self.view, &self.mesh(), lit());
        let mut pixels = vec![0; PIXELS];
        resolve((Rgba8888, &color), (Rgba8888, &mut pixels), SIZE[0] as usize, 0, 4, Average::Light);
        Ok(pixels)
    }
}
