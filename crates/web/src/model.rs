//! Station 8: a model of the visitor's, or a lump of clay.
//!
//! ```text
//!   parameters  0 turn   1 tilt, degrees   2 zoom   3 strength of the normal map   4 side of the lamp, degrees
//!   results     0 vertices   1 triangles submitted   2 fragments   3 whether it has coordinates
//! ```

mod obj;

use crate::canvas::Canvas;
use crate::numbers::{byte, float, index, turn};
use crate::shading::{self, detail, lit};
use crate::textures::{Levels, Texel};
use crate::{Drawn, Fault, Parameters};
use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::shaders::material::Framed;
use alberti::texture::format::{Normals, Rgba8888};
use alberti::texture::surface::{
    Grid, MeshBuffers, Relief, Sphere, displaced_mesh, frame_of_tangent, vertex_normals, vertex_tangents,
};
use alberti::*;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use core::error::Error;
use core::fmt;

/// The largest file that is taken, in bytes.
pub const MAX_BYTES: usize = 64 << 20;

/// The largest side of a map, in texels.
const MAX_SIDE: u32 = 4096;

/// The content of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Colours.
    Colors,
    /// Normals in the tangent frame.
    Normals,
}

/// The reason that a file was not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ModelError {
    /// More than [`MAX_BYTES`].
    Large(usize),
    /// A map whose sides are out of range, or do not belong to its texels.
    Map([u32; 2]),
    /// A line of the mesh, counted from 1, and its fault.
    Line(usize, String),
    /// A mesh without faces.
    Empty,
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Large(bytes) => {
                write!(f, "a file of {} MB: it takes at most {} MB", bytes >> 20, MAX_BYTES >> 20)
            }
            Self::Map([width, height]) => {
                write!(f, "an image of {width} x {height}: sides are from 1 to {MAX_SIDE}")
            }
            Self::Line(line, fault) => write!(f, "line {line} of the model: {fault}"),
            Self::Empty => f.write_str("this model has no faces: it takes lines like `f 1 2 3`"),
        }
    }
}

impl Error for ModelError {}

/// A mesh with all that its vertices carry.
#[derive(Debug, Default)]
struct Shape {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
    has_uvs: bool,
}

/// The model, its maps, and room for a file.
#[derive(Debug)]
pub struct Model {
    file: Vec<u8>,
    vertices: Vec<Framed>,
    triangles: Vec<[u32; 3]>,
    has_uvs: bool,
    colors: Option<Levels>,
    normals: Option<Levels>,
}

impl Model {
    pub(crate) const fn new() -> Self {
        Self {
            file: Vec::new(),
            vertices: Vec::new(),
            triangles: Vec::new(),
            has_uvs: false,
            colors: None,
            normals: None,
        }
    }

    /// Room for a file of so many bytes.
    ///
    /// # Errors
    /// [`ModelError::Large`].
    pub fn reserve(&mut self, bytes: usize) -> Result<&mut [u8], ModelError> {
        if bytes > MAX_BYTES {
            return Err(ModelError::Large(bytes));
        }
        self.file.clear();
        self.file.resize(bytes, 0);
        Ok(&mut self.file)
    }

    /// Takes the file in the room as a mesh, of which it keeps the old maps.
    ///
    /// # Errors
    /// Those of a model that is not OBJ: the old one stays.
    pub fn load_mesh(&mut self) -> Result<(), ModelError> {
        let shape = obj::read(&core::mem::take(&mut self.file))?;
        self.take(shape);
        Ok(())
    }

    /// Takes the file in the room as texels, row by row from the top, of the bytes R, G, B, A.
    ///
    /// # Errors
    /// [`ModelError::Map`].
    pub fn load_map(&mut self, kind: Kind, size: [u32; 2]) -> Result<(), ModelError> {
        let file = core::mem::take(&mut self.file);
        let wrong = ModelError::Map(size);
        if size.iter().any(|side| !(1..=MAX_SIDE).contains(side))
            || file.len() != (4 * size[0] * size[1]) as usize
        {
            return Err(wrong);
        }
        let texels: Vec<Texel> =
            file.chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2], 255]).collect();
        match kind {
            Kind::Colors => self.colors = Some(Levels::build(Rgba8888, &texels, size).map_err(|_| wrong)?),
            Kind::Normals => {
                self.normals = Some(Levels::build(Normals(Rgba8888), &texels, size).map_err(|_| wrong)?);
            }
        }
        Ok(())
    }

    /// Goes back to the lump of clay.
    ///
    /// # Errors
    /// None.
    pub fn forget(&mut self) -> Result<(), ModelError> {
        *self = Self::new();
        Ok(())
    }

    /// Draws the model in the middle of the picture.
    pub(crate) fn draw(
        &mut self,
        canvas: &mut Canvas,
        results: &mut Vec<f32>,
        parameters: &Parameters,
    ) -> Drawn {
        if self.triangles.is_empty() {
            self.take(clay()?);
        }
        let [degrees, tilt, zoom, strength, lamp, ..] = *parameters;
        let colors = match self.colors.take() {
            Some(colors) => colors,
            None => Levels::build(Rgba8888, &[[196, 150, 118, 255]], [1; 2])?,
        };
        let normals = match self.normals.take() {
            Some(normals) => normals,
            None => Levels::build(Normals(Rgba8888), &dents(), [DENTS; 2])?,
        };
        let (colors, normals) = (self.colors.insert(colors), self.normals.insert(normals));

        // The eye goes around the model, which stays in the world where it is.
        let ([cos, sin], [level, up]) = (turn(degrees), turn(tilt.clamp(-89.0, 89.0)));
        let towards = Vec3::new(level * sin, up, level * cos);
        let eye = towards * (3.4 / zoom.clamp(0.1, 16.0));
        let [cos, sin] = turn(degrees + lamp);
        let lamp = (Vec3::new(1.8 * sin, 1.4, 1.8 * cos), 1.1);
        let view = Camera::look_at(eye, Vec3::ZERO, Vec3::Y)?.perspective(0.62, 0.02..50.0)?;
        let mut target = canvas.target()?;
        let stage = lit(detail(colors, normals, strength)?, eye, lamp);
        let mesh = shading::mesh(&self.vertices, &self.triangles);
        let stats = shading::draw(&mut target, &view, &mesh, stage);
        let count = |count: u64| float(usize::try_from(count).unwrap_or(usize::MAX));
        results.extend([float(self.vertices.len()), count(stats.submitted), count(stats.fragments)]);
        results.push(if self.has_uvs { 1.0 } else { 0.0 });
        Ok(())
    }

    /// Makes a shape the model: within a ball of radius 1, with a tangent frame at each vertex.
    fn take(&mut self, mut shape: Shape) {
        let least = shape.positions.iter().fold(Vec3::MAX, |least, p| least.min(*p));
        let most = shape.positions.iter().fold(Vec3::MIN, |most, p| most.max(*p));
        let middle = (least + most) / 2.0;
        let radius = shape.positions.iter().map(|p| (*p - middle).length()).fold(0.0, f32::max);
        let scale = if radius > 0.0 { 1.0 / radius } else { 1.0 };
        for position in &mut shape.positions {
            *position = (*position - middle) * scale;
        }
        let mut tangents = vec![[0.0; 4]; shape.positions.len()];
        let Shape { positions, normals, uvs, triangles, has_uvs } = shape;
        // All of them are as long as there are positions.
        if vertex_tangents(&positions, &normals, &uvs, &triangles, &mut tangents).is_err() {
            return;
        }
        let vertex = |k: usize| {
            let frame = frame_of_tangent(Point3::new(positions[k]), Vector3::new(normals[k]), tangents[k]);
            let Mat3 { x_axis, y_axis, z_axis } = frame.axes();
            Framed { position: positions[k], axes: [x_axis, y_axis, z_axis], uv: uvs[k] }
        };
        self.vertices = (0..positions.len()).map(vertex).collect();
        self.triangles = triangles;
        self.has_uvs = has_uvs;
    }
}

impl Shape {
    /// Gives vertices whose normals are zero those of the triangles around them.
    fn complete(mut self) -> Self {
        let mut found = vec![Vec3::ZERO; self.positions.len()];
        if vertex_normals(&self.positions, &self.triangles, &mut found).is_ok() {
            for (normal, found) in self.normals.iter_mut().zip(found) {
                if *normal == Vec3::ZERO {
                    *normal = found;
                }
            }
        }
        self
    }
}

/// The side of the clay's normal map, in texels.
const DENTS: u32 = 64;

/// The normals of low waves across each other.
fn dents() -> Vec<Texel> {
    let wave = |k: u32| {
        let [cos, _] = turn(float(k as usize) * 2.0 * 360.0 / float(DENTS as usize));
        0.25 * cos
    };
    let texel = |k: u32| {
        let normal = Vec3::new(wave(k % DENTS), wave(k / DENTS), 1.0).normalize() * 127.0 + 128.0;
        let [x, y, z] = normal.to_array().map(byte);
        [x, y, z, 255]
    };
    (0..DENTS * DENTS).map(texel).collect()
}

/// A sphere with waves on it.
fn clay() -> Result<Shape, Fault> {
    const GRID: Grid = Grid::new(96, 64);
    let count = GRID.vertices();
    let mut shape = Shape {
        positions: vec![Vec3::ZERO; count],
        normals: vec![Vec3::ZERO; count],
        uvs: vec![Vec2::ZERO; count],
        triangles: vec![[0; 3]; GRID.triangles()],
        has_uvs: true,
    };
    let wave = |uv: Vec2| {
        let [_, around] = turn(uv.x * 360.0 * 6.0 + uv.y * 540.0);
        let [_, down] = turn(uv.y * 180.0);
        0.5 + 0.5 * around * down
    };
    let relief = Relief { map: wave, low: -0.12, high: 0.12, extent: Vec2::ONE };
    let buffers = MeshBuffers {
        positions: &mut shape.positions,
        normals: &mut shape.normals,
        uvs: &mut shape.uvs,
        triangles: &mut shape.triangles,
    };
    displaced_mesh(&Sphere { radius: 1.0 }, &relief, GRID, buffers)?;
    // Both borders of u have the normals of one.
    let across = index(count) / 65;
    for row in 0..65 {
        let (first, last) = ((row * across) as usize, (row * across + across - 1) as usize);
        let sum = (shape.normals[first] + shape.normals[last]).normalize_or_zero();
        shape.normals[first] = sum;
        shape.normals[last] = sum;
    }
    Ok(shape.complete())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Page, Station};

    fn loaded(page: &mut Page, text: &str) -> Result<(), ModelError> {
        page.model().reserve(text.len()).unwrap().copy_from_slice(text.as_bytes());
        page.model().load_mesh()
    }

    #[test]
    fn a_quad_is_drawn_and_a_mistake_leaves_it() {
        let mut page = Page::new();
        let parameters = [0.0, 10.0, 1.0, 1.0, 30.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        loaded(&mut page, "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n").unwrap();
        page.draw(Station::Model, [64, 48], &parameters).unwrap();
        assert_eq!(page.results[..2], [4.0, 2.0]);
        assert!(loaded(&mut page, "v 1 2\n").is_err());
        assert_eq!(loaded(&mut page, "v 1 2 3\n"), Err(ModelError::Empty));
        page.draw(Station::Model, [64, 48], &parameters).unwrap();
        assert_eq!(page.results[0], 4.0);
        page.model().forget().unwrap();
        page.draw(Station::Model, [64, 48], &parameters).unwrap();
        assert!(page.results[2] > 300.0);
    }

    #[test]
    fn maps_are_checked() {
        let mut page = Page::new();
        page.model().reserve(16).unwrap();
        assert_eq!(page.model().load_map(Kind::Colors, [2, 3]), Err(ModelError::Map([2, 3])));
        page.model().reserve(16).unwrap();
        assert_eq!(page.model().load_map(Kind::Normals, [2, 2]), Ok(()));
        assert_eq!(page.model().reserve(MAX_BYTES + 1).err(), Some(ModelError::Large(MAX_BYTES + 1)));
    }
}
