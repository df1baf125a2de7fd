//! A picture's ingredients: a model, a camera, and its surfaces' looks. Plain data, so that a test can
//! hand the same scene to an independent renderer.

use std::path::PathBuf;
use std::sync::Arc;

pub mod backdrop;
pub mod camera;
pub mod normals;
pub mod scenes;
pub mod slide;
pub(crate) mod swept;

pub(crate) mod displace;
pub(crate) mod ground;
pub(crate) mod order;
pub(crate) mod origin;
pub(crate) mod place;
pub(crate) mod polygon;
pub(crate) mod surfaces;
pub(crate) mod tangents;

mod detail;

pub use detail::{
    Detail, Environment, EnvironmentKind, Glow, HeightImage, HeightMap, Light, Map, NormalMap, NormalSpace,
    Relief,
};

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
    /// Object space, as in glTF: the unit vector along which u grows, and 1 or -1. By the latter, normal × tangent is
    /// to be multiplied for the vector along which v grows. (0, 0, 0, 0) where no map needs it.
    pub tangent: [f32; 4],
}

impl Default for Vertex {
    /// White at the origin, without a normal.
    fn default() -> Self {
        Self { position: [0.0; 3], normal: [0.0; 3], uv: [0.0; 2], color: [1.0; 3], tangent: [0.0; 4] }
    }
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
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// The object's or group's name, else that of its material in a scene file; for messages.
    pub name: String,
    /// Indices into [`Model::vertices`], counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// The material's name in its file, or nothing; for reports.
    pub material: String,
    /// Diffuse colour, sRGB in 0..=1.
    pub diffuse: [f32; 3],
    /// Index into [`Model::textures`].
    pub texture: Option<usize>,
    /// All else.
    pub detail: Detail,
}

impl Part {
    /// Whether it has images that lie on it.
    pub(crate) fn has_maps(&self) -> bool {
        self.texture.is_some() || self.detail.has_maps()
    }
}

/// Everything that is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Shared by all parts.
    pub vertices: Vec<Vertex>,
    /// In drawing order.
    pub parts: Vec<Part>,
    /// Shared by all parts, and by copies of the model.
    pub textures: Vec<Arc<Image>>,
    /// Shared in the same way.
    pub heights: Vec<Arc<HeightImage>>,
    /// Without any, there is a lamp beside the camera.
    pub lights: Vec<Light>,
    /// Light from everywhere; `None`: as much as suits the lamp beside the camera.
    pub ambient: Option<Glow>,
    /// The projector and its image.
    pub slide: Option<Slide>,
    /// The file that it came from.
    pub source: Option<PathBuf>,
    /// The point of the file's coordinates that is (0, 0, 0) here: all positions in the model, of lights and of cameras
    /// are less by it. It is 0 unless the model is far from its own origin.
    pub origin: [f64; 3],
    /// Things that its files say and that are not drawn as such.
    pub notes: Notes,
}

/// Things that files say of a model and that are not drawn as such: for reports.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notes {
    /// The vertices whose normals are a file's; all others were made.
    pub normals: usize,
    /// The materials of the parts.
    pub materials: Vec<MaterialNote>,
}

/// The images that a material names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MaterialNote {
    /// The material's name.
    pub name: String,
    /// Its maps.
    pub maps: Vec<MapNote>,
}

/// An image that a material names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapNote {
    /// The key in a scene file, or one of `alpha-map`, `roughness-map` and `metallic-map`, which only MTL files have.
    pub key: &'static str,
    /// The file that was looked for.
    pub path: PathBuf,
    /// Width and height; `None` where it could not be read.
    pub size: Option<[u32; 2]>,
}

impl Model {
    /// Bytes of its vertices and triangles.
    pub(crate) fn bytes(&self) -> u64 {
        let triangles: usize = self.parts.iter().map(|part| size_of_val(&part.triangles[..])).sum();
        (size_of_val(&self.vertices[..]) + triangles) as u64
    }

    /// The longest side of the textures, or, without any, the steps of a colour.
    #[must_use]
    pub fn largest_side(&self) -> u16 {
        let sides = self.textures.iter().map(|image| image.width.max(image.height));
        sides.max().and_then(|side| side.try_into().ok()).unwrap_or(COLOR_STEPS)
    }
}

/// The steps of a colour from 0 to 1.
pub(crate) const COLOR_STEPS: u16 = 255;

/// An image that a projector throws on the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide {
    /// The image.
    pub image: Arc<Image>,
    /// The projector's place, direction and vertical opening angle; its planes have no meaning.
    pub projector: Camera,
}

/// A camera in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The view point.
    pub eye: [f32; 3],
    /// The point looked at.
    pub target: [f32; 3],
    /// Upwards in the world.
    pub up: [f32; 3],
    /// Degrees by which the camera leans to the right. Where it looks along `up`, they are counted from the view of one
    /// who has come from the front.
    pub roll: f64,
    /// Full vertical opening angle, degrees.
    pub fov: f32,
    /// The front clipping plane, z = A.
    pub near: f32,
    /// The back clipping plane, z = B.
    pub far: f32,
}
