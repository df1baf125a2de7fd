//! What a picture is made of: a model, a camera, and how its surface is drawn. Plain data, so that a test can
//! hand the same scene to an independent renderer.

use std::path::PathBuf;

/// A vertex as a file or a generator gives it. Positions and normals are in object space (right-handed, y up).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Object space.
    pub position: [f32; 3],
    /// Object space, unit length.
    pub normal: [f32; 3],
    /// Texture coordinates, v up.
    pub uv: [f32; 2],
    /// sRGB in 0..=1.
    pub color: [f32; 3],
}

/// An image in memory: rows from the top, R, G, B, A per texel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` texels.
    pub texels: Vec<[u8; 4]>,
}

/// Triangles that share a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The object's or group's name, for messages.
    pub name: String,
    /// Indices into [`Model::vertices`], counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Diffuse colour, sRGB in 0..=1.
    pub diffuse: [f32; 3],
    /// Index into [`Model::textures`].
    pub texture: Option<usize>,
}

/// Everything that is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Shared by all parts.
    pub vertices: Vec<Vertex>,
    /// In drawing order.
    pub parts: Vec<Part>,
    /// Shared by all parts.
    pub textures: Vec<Image>,
    /// What a projector throws on all parts, if anything.
    pub slide: Option<Slide>,
    /// Where it came from, when it came from a file.
    pub source: Option<PathBuf>,
}

/// An image that a projector throws on the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide {
    /// What is thrown.
    pub image: Image,
    /// Where the projector stands and points to, and its vertical opening angle; its planes have no meaning.
    pub projector: Camera,
}

/// A camera in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The view point.
    pub eye: [f32; 3],
    /// The point looked at.
    pub target: [f32; 3],
    /// Upwards.
    pub up: [f32; 3],
    /// Full vertical opening angle, degrees.
    pub fov: f32,
    /// The front clipping plane, z = A.
    pub near: f32,
    /// The back clipping plane, z = B.
    pub far: f32,
}
