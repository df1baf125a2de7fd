//! Policies, which trade precision for time or memory: interpolation, arithmetic, formats, and profiles of all three.

use std::fmt;
use std::str::FromStr;

use clap::ValueEnum;

use super::Dither;
use super::values::{one_of, words};
use crate::error::Error;

/// The format of the depth buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum DepthFormat {
    /// 32-bit float, 0 at the near plane.
    #[default]
    F32,
    /// 32-bit float, 1 at the near plane: precision spread over the distance.
    F32Reversed,
    /// 32-bit integer: no finer than the floats that depths are computed in.
    U32,
    /// 24-bit integer.
    U24,
    /// 16-bit integer: for seeing what too little precision looks like.
    U16,
    /// No depth buffer: later triangles cover earlier ones.
    None,
}

/// The way of texture coordinates, colours and normals from the vertices to the pixels between them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Interpolation {
    /// With perspective, from exact integer edges.
    #[default]
    Exact,
    /// With perspective, from plane equations.
    Plane,
    /// Straight lines between columns with perspective, so many apart.
    Spans(SpanLength),
    /// Straight lines for as long as they miss no more than this, in texels of the model's largest texture.
    Bounded(f32),
    /// Straight lines across the whole triangle.
    Affine,
}

impl Interpolation {
    /// The straight lines, which alone exist in fixed point.
    const STRAIGHT: &str = "spans:4, spans:8, spans:16, spans:32, bounded:TEXELS or affine";
}

impl FromStr for Interpolation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        let texels = |text: &str| text.parse().ok().filter(|x: &f32| x.is_finite() && *x >= 0.0);
        let found = match text.split_once(':') {
            None => [Self::Exact, Self::Plane, Self::Affine].into_iter().find(|i| i.to_string() == text),
            Some(("spans", length)) => {
                SpanLength::ALL.into_iter().find(|l| l.columns().to_string() == length).map(Self::Spans)
            }
            Some(("bounded", budget)) => texels(budget).map(Self::Bounded),
            Some(_) => None,
        };
        found.ok_or_else(|| {
            format!("exact, plane, {}, TEXELS a number from 0 on, such as 0.0625", Self::STRAIGHT)
        })
    }
}

impl fmt::Display for Interpolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact => f.write_str("exact"),
            Self::Plane => f.write_str("plane"),
            Self::Spans(length) => write!(f, "spans:{}", length.columns()),
            Self::Bounded(texels) => write!(f, "bounded:{texels}"),
            Self::Affine => f.write_str("affine"),
        }
    }
}

/// Columns from one that has perspective to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SpanLength {
    /// 4.
    Four,
    /// 8.
    Eight,
    /// 16.
    Sixteen,
    /// 32.
    ThirtyTwo,
}

impl SpanLength {
    const ALL: [Self; 4] = [Self::Four, Self::Eight, Self::Sixteen, Self::ThirtyTwo];

    /// The number.
    pub(crate) fn columns(self) -> i32 {
        match self {
            Self::Four => 4,
            Self::Eight => 8,
            Self::Sixteen => 16,
            Self::ThirtyTwo => 32,
        }
    }
}

/// The arithmetic by which that is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Arithmetic {
    /// 32-bit floats, several pixels at a time.
    #[default]
    Float,
    /// Integers, as on a chip without floating point: steps of 2^-16, coordinates within ±4096, straight lines only,
    /// one pixel at a time.
    Fixed,
}

/// The format of a pixel's colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum ColorFormat {
    /// 8 bits a channel.
    #[default]
    Rgba8,
    /// 5 bits of red, 6 of green, 5 of blue, as small displays have them: gradients show steps.
    Rgb565,
    /// 4 bits a channel.
    Rgb444,
    /// 6 bits a channel, in a byte each.
    Rgb666,
    /// 8 bits a channel, in three bytes.
    Rgb888,
    /// The same in a word, whose highest byte is unused.
    Xrgb8888,
    /// 3 bits of red, 3 of green, 2 of blue.
    Rgb332,
    /// Indices into a palette of 216 colours, 6 levels a channel.
    Indexed8,
    /// 256 levels of luminance.
    Grey8,
    /// 16 levels of luminance.
    Grey4,
    /// 4 levels of luminance.
    Grey2,
    /// Black and white.
    Grey1,
}

impl ColorFormat {
    /// Bytes of a pixel as long as it is drawn; those of less than a byte, and of 12 bits, are packed to be sent.
    #[must_use]
    pub fn bytes(self) -> usize {
        match self {
            Self::Rgba8 | Self::Xrgb8888 => 4,
            Self::Rgb666 | Self::Rgb888 => 3,
            Self::Rgb565 | Self::Rgb444 => 2,
            Self::Rgb332 | Self::Indexed8 | Self::Grey8 | Self::Grey4 | Self::Grey2 | Self::Grey1 => 1,
        }
    }
}

/// The grid to which vertices are snapped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Subpixel {
    /// To 1/16 pixel: what moves slowly may be seen to jitter.
    #[value(name = "4")]
    Sub4,
    /// To 1/256 pixel.
    #[default]
    #[value(name = "8")]
    Sub8,
}

/// The places at which levels of detail are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Lod {
    /// At each pixel; in fixed point as for run.
    #[default]
    Pixel,
    /// In the middle of each run: a row of a triangle, or a straight line of it.
    Run,
    /// In the middle of each triangle.
    Triangle,
}

/// The policies beside the depth buffer's format.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Policies {
    /// From vertices to pixels.
    pub interpolation: Interpolation,
    /// By which arithmetic.
    pub arithmetic: Arithmetic,
    /// The format of colours.
    pub color: ColorFormat,
    /// Their rounding to it.
    pub dither: Dither,
    /// The vertices' grid.
    pub subpixel: Subpixel,
    /// Levels of detail.
    pub lod: Lod,
}

impl Policies {
    /// # Errors
    /// Fixed point without straight lines.
    pub fn check(&self) -> Result<(), Error> {
        let Self { interpolation, arithmetic, .. } = self;
        match (interpolation, arithmetic) {
            (Interpolation::Exact | Interpolation::Plane, Arithmetic::Fixed) => {
                Err(Error::new(format!("fixed with {interpolation}"), Interpolation::STRAIGHT)
                    .place("--arithmetic")
                    .hint("choose one with --interpolation, or --arithmetic float"))
            }
            _ => Ok(()),
        }
    }
}

/// A choice of each, as the library bundles them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum Profile {
    /// exact, float, f32-reversed, rgba8, 8: the most precise; 8 bytes a pixel.
    Reference,
    /// exact, float, f32, rgba8, 8: depth as it is taught, coarse in the distance; 8 bytes a pixel.
    Desktop,
    /// spans:16, fixed, u16, rgb565, 4: for microcontrollers; 4 bytes a pixel.
    Mcu,
    /// affine, fixed, no depth, rgb565, 4: textures swim, later triangles cover earlier ones; 2 bytes a pixel.
    Tiny,
}

impl Profile {
    /// The policies of the profile, and its depth buffer.
    #[must_use]
    pub fn policies(self) -> (Policies, DepthFormat) {
        let small = |interpolation| Policies {
            interpolation,
            arithmetic: Arithmetic::Fixed,
            color: ColorFormat::Rgb565,
            dither: Dither::None,
            subpixel: Subpixel::Sub4,
            lod: Lod::default(),
        };
        match self {
            Self::Reference => (Policies::default(), DepthFormat::F32Reversed),
            Self::Desktop => (Policies::default(), DepthFormat::F32),
            Self::Mcu => (small(Interpolation::Spans(SpanLength::Sixteen)), DepthFormat::U16),
            Self::Tiny => (small(Interpolation::Affine), DepthFormat::None),
        }
    }
}

words!(one_of: DepthFormat, Arithmetic, ColorFormat, Subpixel, Lod, Profile);
words!(str::parse: Interpolation);
