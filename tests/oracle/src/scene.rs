//! What the reference renderers draw: plain data, borrowed.

/// A scene and the way to show it.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// All vertices, in world space.
    pub vertices: &'a [Vertex],
    /// Groups of triangles that share a material, in drawing order.
    pub parts: &'a [Part<'a>],
    /// The textures that parts refer to.
    pub textures: &'a [Texture<'a>],
    /// Where the scene is seen from.
    pub camera: Camera,
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// Which faces are dropped.
    pub cull: Cull,
    /// How a visible point gets its colour.
    pub shading: Shading,
    /// How a texture is sampled.
    pub filter: Filter,
    /// What lies outside a texture.
    pub wrap: Wrap,
    /// The colour of pixels that nothing covers.
    pub background: [u8; 3],
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// In world space.
    pub position: [f64; 3],
    /// In world space, of any length.
    pub normal: [f64; 3],
    /// `u` to the right and `v` up in the texture.
    pub uv: [f64; 2],
    /// Red, green and blue, from 0 to 1.
    pub color: [f64; 3],
}

/// Triangles of one material.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Indices of vertices, three a triangle; counter-clockwise triangles are front faces.
    pub triangles: &'a [[u32; 3]],
    /// The colour of the material, from 0 to 1; it multiplies the texture.
    pub diffuse: [f64; 3],
    /// An index into [`Scene::textures`].
    pub texture: Option<usize>,
}

/// An image of sRGB texels, top row first.
#[derive(Clone, Copy, Debug)]
pub struct Texture<'a> {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue and alpha, of which alpha is ignored; row by row.
    pub texels: &'a [[u8; 4]],
}

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: [f64; 3],
    /// What it looks at.
    pub target: [f64; 3],
    /// A direction that points upwards in the picture; not along the line of sight.
    pub up: [f64; 3],
    /// The full vertical field of view, in degrees.
    pub fov: f64,
    /// The distance of the near plane, along the line of sight.
    pub near: f64,
    /// The distance of the far plane.
    pub far: f64,
}

/// Which faces are dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cull {
    /// Faces that run clockwise as seen.
    Back,
    /// Faces that run counter-clockwise as seen.
    Front,
    /// Both sides are drawn.
    None,
}

/// How a visible point gets its colour. All arithmetic is on the sRGB values as stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shading {
    /// The material: the texel times the diffuse colour, or the latter alone.
    Unlit,
    /// The interpolated vertex colour.
    VertexColor,
    /// The material times `ambient + diffuse * max(0, n.l)`.
    Lambert {
        /// Towards the light, in world space, of any length.
        light_dir: [f64; 3],
        /// The light that reaches every face.
        ambient: f64,
        /// The light that reaches a face turned to it.
        diffuse: f64,
    },
}

/// How a texture is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// The texel that contains the point.
    Nearest,
    /// The four texels whose centres surround the point.
    Bilinear,
}

/// What lies outside a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The texture again.
    Repeat,
    /// The nearest texel of the border.
    Clamp,
    /// The texture again, every second time reflected.
    Mirror,
}
