//! The options of the command line, of scene files, and of built-in scenes for themselves.

use clap::ValueEnum;
use std::num::NonZero;

mod afterwards;
mod aov;
mod background;
mod colors;
mod filter;
mod light;
mod material;
mod normals;
mod policies;
mod samples;
mod table;
pub mod values;

pub(crate) use afterwards::byte;
pub use afterwards::{Blend, Dither, Fog, Haze};
pub use aov::{Aov, AovFormat, Aovs};
pub use background::Background;
pub use filter::{Filter, Probes};
pub use light::{KeyLight, LightOptions, LightSpace};
pub(crate) use material::Base;
pub use material::{MapFile, Material, Origin};
pub use normals::{DEFAULT_CREASE, Normals};
pub use policies::{
    Arithmetic, ColorFormat, DepthFormat, Interpolation, Lod, Policies, Profile, SpanLength, Subpixel,
};
pub use samples::Samples;
pub use table::{CameraTable, ProjectorTable, RenderTable};
pub(crate) use table::{shared, upwards};
pub use values::MAX_SIDE;
use values::{one_of, words};

/// A picture's file, unless the user names one.
pub const DEFAULT_OUTPUT: &str = "alberti.png";

/// A picture's width and height in pixels, unless the user gives them.
pub const DEFAULT_SIZE: values::Size = values::Size(640, 480);

/// The colour behind a model, unless the user gives one.
pub const DEFAULT_BACKGROUND: [u8; 3] = [0x20, 0x24, 0x2c];

/// The same where a ground is to show a shadow.
pub const GROUND_BACKGROUND: [u8; 3] = [0xa8, 0xb0, 0xb8];

/// The vertical opening angle of a camera and of a projector, unless the user gives one, in degrees.
pub const DEFAULT_FOV: f32 = 40.0;

/// The share of an environment that is mirrored, unless the user gives one.
pub const DEFAULT_REFLECTION: f32 = 0.5;

/// The height of white, as a share of the model's radius, unless the user gives one.
pub const DEFAULT_HEIGHT: f32 = 0.02;

/// The way to a fragment's colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Shading {
    /// The texture or the material's colour, as it is.
    Unlit,
    /// The vertices' colours, interpolated.
    VertexColor,
    /// Diffuse light on the texture or the material's colour.
    #[default]
    Lambert,
    /// Diffuse light and highlights, found at the vertices and interpolated: small highlights are lost.
    Gouraud,
    /// Diffuse light and highlights about the mirrored light, found at each pixel.
    Phong,
    /// Diffuse light and highlights about the direction halfway between light and eye, found at each pixel.
    Blinn,
}

impl Shading {
    /// Whether light has a part in it.
    #[must_use]
    pub fn is_lit(self) -> bool {
        !matches!(self, Self::Unlit | Self::VertexColor)
    }
}

/// The wrap mode: the continuation of a texture outside 0..=1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The texel at the edge.
    Clamp,
    /// The image again, every other time mirrored.
    Mirror,
}

/// The side whose triangles are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Cull {
    /// Those seen from behind (clockwise on the screen).
    Back,
    /// Those seen from the front (counter-clockwise on the screen).
    Front,
    /// Neither: both sides are drawn. OBJ files are not reliably wound, hence the default.
    #[default]
    None,
}

words!(one_of: Shading, Wrap, Cull, ProjectionKind, ViewSide, FileFormat, AovFormat);

/// The format of a picture's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FileFormat {
    /// PNG.
    Png,
    /// JPEG.
    #[value(alias = "jpeg")]
    Jpg,
    /// BMP.
    Bmp,
    /// TGA.
    Tga,
    /// WebP without loss.
    #[value(name = "webp")]
    WebP,
    /// QOI.
    Qoi,
    /// PPM.
    Ppm,
}

/// The side of a model that is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewSide {
    /// From +z where y is up, and from -y where z is.
    Front,
    /// From behind.
    Back,
    /// From -x.
    Left,
    /// From +x.
    Right,
    /// From above.
    Top,
    /// From below.
    Bottom,
    /// From the front, the right and above, along a cube's diagonal.
    Iso,
}

impl ViewSide {
    /// Its azimuth and its elevation, in degrees; `None` of one that is no number of degrees.
    pub(crate) fn angles(self) -> Option<[f32; 2]> {
        Some(match self {
            Self::Front => [0.0, 0.0],
            Self::Right => [90.0, 0.0],
            Self::Back => [180.0, 0.0],
            Self::Left => [-90.0, 0.0],
            Self::Top => [0.0, 90.0],
            Self::Bottom => [0.0, -90.0],
            Self::Iso => return None,
        })
    }
}

/// The projection, as options have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ProjectionKind {
    /// Lines of sight from one point: farther things are smaller.
    Perspective,
    /// Parallel lines of sight: parallels stay parallel; straight lines unless --interpolation says otherwise, as they
    /// are exact then.
    Parallel,
}

/// The projection.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Projection {
    /// With the camera's opening angle.
    #[default]
    Perspective,
    /// Along parallel lines.
    Parallel {
        /// The height of the window in units of the world, above 0, from the bottom of the picture to the top.
        height: f32,
    },
}

/// Everything about a picture that is neither model nor camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderOptions {
    /// Pixels a row, 1 to [`MAX_SIDE`].
    pub width: u32,
    /// Rows, 1 to [`MAX_SIDE`].
    pub height: u32,
    /// Behind the model, sRGB.
    pub background: [u8; 3],
    /// The way to fragments' colours.
    pub shading: Shading,
    /// Filters of textures.
    pub filter: Filter,
    /// The textures' wrap mode.
    pub wrap: Wrap,
    /// The side that is left out.
    pub cull: Cull,
    /// The depth buffer.
    pub depth: DepthFormat,
    /// The projection.
    pub projection: Projection,
    /// The fog before all surfaces, not before the background.
    pub haze: Option<Haze>,
    /// The light.
    pub light: LightOptions,
    /// Threads that draw. The pixels are the same for any number; of more than one, each has its own fate of a triangle
    /// in the counts.
    pub threads: NonZero<usize>,
    /// The other policies, which [`render`](crate::render::render) takes for ones that go together.
    pub policies: Policies,
}

impl RenderOptions {
    /// Whether surfaces are lit in amounts of light.
    #[must_use]
    pub fn in_linear_light(&self) -> bool {
        self.light.space == LightSpace::Linear && self.shading.is_lit()
    }
}
