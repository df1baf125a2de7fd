//! How a scene is drawn: the choices that the command line offers and that a built-in scene makes for itself.

use clap::ValueEnum;

/// How a fragment gets its colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Shading {
    /// The texture or the material's colour, as it is.
    Unlit,
    /// The vertices' colours, interpolated.
    VertexColor,
    /// Diffuse light from beside the camera on the texture or the material's colour.
    #[default]
    Lambert,
}

/// How a texture is read between its texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Filter {
    /// The texel that contains the point.
    Nearest,
    /// A weighted mean of the four texels around the point.
    #[default]
    Bilinear,
}

/// What a texture shows outside 0..=1.
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

/// Which triangles are left out by the side they show.
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

/// What the depth buffer stores.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum DepthFormat {
    /// 32-bit float, 0 at the near plane.
    #[default]
    F32,
    /// 32-bit float, 1 at the near plane: precision spread over the distance.
    F32Reversed,
    /// 24-bit integer.
    U24,
    /// 16-bit integer: for seeing what too little precision looks like.
    U16,
    /// No depth buffer: later triangles cover earlier ones.
    None,
}

/// Everything about a picture that is neither model nor camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderOptions {
    /// Pixels a row, 1 to [`MAX_SIDE`].
    pub width: u32,
    /// Rows, 1 to [`MAX_SIDE`].
    pub height: u32,
    /// Behind the model, sRGB.
    pub background: [u8; 3],
    /// How fragments are coloured.
    pub shading: Shading,
    /// How textures are read.
    pub filter: Filter,
    /// How textures continue.
    pub wrap: Wrap,
    /// Which side is left out.
    pub cull: Cull,
    /// The depth buffer.
    pub depth: DepthFormat,
}

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: u32 = 16384;

/// Behind a model, unless the command line says otherwise.
pub const DEFAULT_BACKGROUND: [u8; 3] = [0x20, 0x24, 0x2c];
