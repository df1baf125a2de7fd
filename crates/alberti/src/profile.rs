//! Profiles: the policies of a whole picture under one name, so that a signature carries one parameter.
//!
//! | profile | for | interpolation | depth | subpixels | bytes a pixel |
//! |---|---|---|---|---|---|
//! | [`Reference`] | comparisons | [`Exact`] | [`F32Reversed`] | 8 bits | 8 |
//! | [`Desktop`] | machines with vector registers | [`Exact`] | [`F32`] | 8 bits | 8 |
//! | [`Mcu`] | microcontrollers | [`Spans16`] in [`FixedPoint`] | [`D16`] | 4 bits | 4 |
//! | [`Tiny`] | the smallest of them | [`Affine`] in [`FixedPoint`] | [`NoDepth`] | 4 bits | 2 |
//!
//! | profile | precision of attributes | cost of a fragment |
//! |---|---|---|
//! | [`Reference`], [`Desktop`] | 9ε | a division; a component adds four products |
//! | [`Mcu`] | 19 steps of 2^-16, and the miss of a line along 16 columns | an addition a component; a table every 16 columns |
//! | [`Tiny`] | 67 steps of 2^-16, and the miss of a line along the triangle | an addition a component |
//!
//! A profile is for code that is to be drawn in several ways. Code that knows its way names the policies themselves.

use alberti_math::{Rgb565Be, Rgba8888, Sub4, Sub8, Subpixel};
use alberti_raster::{
    Affine, Bands, ColorFormat, D16, DepthFormat, Exact, F32, F32Reversed, FixedPoint, Interpolation,
    NoDepth, Spans16, Target, TargetError,
};
use core::fmt::Debug;

/// A choice of one policy from each family. The built-in ones are [`Reference`], [`Desktop`], [`Mcu`] and [`Tiny`].
///
/// The same scene under two of them:
///
/// ```
/// use alberti::{glam::Vec3, shaders::VertexColor, *};
///
/// /// A triangle that leans away from the viewer.
/// fn frame<P: Profile>(
///     profile: P,
///     target: &mut Target<'_, P::Color, P::Depth>,
/// ) -> Result<(), Box<dyn core::error::Error>> {
///     let vertices = [(-0.9, -0.8, 0.0), (0.9, -0.8, 0.0), (0.0, 0.8, -1.0)];
///     let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |&(x, y, z)| {
///         (Vec3::new(x, y, z), Vec3::new(1.0, -z, 0.0))
///     });
///     let view = Camera::look_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
///     target.clear(Rgba8::BLACK);
///     Pass::new(&view, &mesh, VertexColor).with(profile).draw(target);
///     Ok(())
/// }
///
/// let (mut color, mut depth) = ([0; 32 * 24], [0.0; 32 * 24]);
/// frame(Desktop, &mut Desktop.target(32, 24, &mut color, &mut depth)?)?;
/// let (mut small, mut none) = ([0; 32 * 24], [(); 32 * 24]);
/// frame(Tiny, &mut Tiny.target(32, 24, &mut small, &mut none)?)?;
///
/// // Full red, and green growing upwards: later with perspective, as the upper corner is farther.
/// let middle = 11 * 32 + 16;
/// let [red, green, ..] = color[middle].to_ne_bytes();
/// let packed = u16::from_be(small[middle]);
/// assert_eq!((red, packed >> 11), (255, 31));
/// assert!(u32::from(green) * 63 < u32::from(packed >> 5 & 63) * 255);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// One's own is a type and its choices:
///
/// ```
/// # use alberti::*;
/// /// Sixteen bits a pixel and a depth test, in fixed point.
/// #[derive(Clone, Copy, Debug)]
/// struct Mine;
///
/// impl Profile for Mine {
///     type Interpolation = FixedPoint<Lines>;
///     type Subpixel = Sub4;
///     type Color = Rgb565Le;
///     type Depth = D16;
///
///     fn interpolation(self) -> FixedPoint<Lines> {
///         FixedPoint(Lines::bounded(1.0 / 256.0))
///     }
///
///     fn subpixel(self) -> Sub4 {
///         Sub4
///     }
///
///     fn color(self) -> Rgb565Le {
///         Rgb565Le
///     }
///
///     fn depth(self) -> D16 {
///         D16
///     }
/// }
/// assert_eq!(Mine::PIXEL_BYTES, 4);
/// ```
///
/// A combination without sense does not compile: fixed point takes policies of straight lines, and `Exact` and `Planes`
/// are none.
///
/// ```compile_fail,E0277
/// # use alberti::*;
/// fn interpolation() -> impl Interpolation {
///     FixedPoint(Exact)
/// }
/// ```
pub trait Profile: Copy + Debug + 'static {
    /// Perspective, and the numbers it is computed in.
    type Interpolation: Interpolation;
    /// The grid of the vertices.
    type Subpixel: Subpixel;
    /// The format of colours.
    type Color: ColorFormat;
    /// The format of depths.
    type Depth: DepthFormat;
    /// Memory for a pixel, with its depth.
    const PIXEL_BYTES: usize =
        size_of::<<Self::Color as ColorFormat>::Pixel>() + size_of::<<Self::Depth as DepthFormat>::Stored>();

    /// Perspective, and the numbers it is computed in.
    fn interpolation(self) -> Self::Interpolation;

    /// The grid of the vertices.
    fn subpixel(self) -> Self::Subpixel;

    /// The format of colours.
    fn color(self) -> Self::Color;

    /// The format of depths.
    fn depth(self) -> Self::Depth;

    /// A target of the profile's formats: [`Target::new`].
    ///
    /// # Errors
    /// Those of [`Target::new`].
    fn target<'a>(
        self,
        width: u32,
        height: u32,
        color: &'a mut [<Self::Color as ColorFormat>::Pixel],
        depth: &'a mut [<Self::Depth as DepthFormat>::Stored],
    ) -> Result<Target<'a, Self::Color, Self::Depth>, TargetError> {
        Target::new(self.color(), self.depth(), width, height, color, depth)
    }

    /// The bands of a frame in the profile's formats: [`Bands::new`].
    ///
    /// # Errors
    /// Those of [`Bands::new`].
    fn bands<'a>(
        self,
        width: u32,
        height: u32,
        color: &'a mut [<Self::Color as ColorFormat>::Pixel],
        depth: &'a mut [<Self::Depth as DepthFormat>::Stored],
    ) -> Result<Bands<'a, Self::Color, Self::Depth>, TargetError> {
        Bands::new(self.color(), self.depth(), width, height, color, depth)
    }
}

/// A profile's types and values, which are the same words.
macro_rules! profile {
    ($name:ident: $interpolation:ty = $value:expr, $subpixel:ident, $color:ident, $depth:ident) => {
        impl Profile for $name {
            type Interpolation = $interpolation;
            type Subpixel = $subpixel;
            type Color = $color;
            type Depth = $depth;

            #[inline(always)]
            fn interpolation(self) -> $interpolation {
                $value
            }

            #[inline(always)]
            fn subpixel(self) -> $subpixel {
                $subpixel
            }

            #[inline(always)]
            fn color(self) -> $color {
                $color
            }

            #[inline(always)]
            fn depth(self) -> $depth {
                $depth
            }
        }
    };
}

/// The most precise of each family, for comparisons with other pictures.
///
/// # Precision
/// Attributes within 9ε, of the greatest value at a vertex; depth in relative steps of 2^-24 at any distance; vertices
/// within 2^-9 pixel; 8 bits a channel.
///
/// # Cost
/// [`Exact`]: a division a fragment. 8 bytes a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reference;

profile!(Reference: Exact = Exact, Sub8, Rgba8888, F32Reversed);

/// For machines with vector registers: [`Reference`] with depth as it is taught, growing with distance.
///
/// # Precision
/// As [`Reference`], but depth has steps of 2^-24 in zs, which are coarse in the distance: see [`F32`].
///
/// # Cost
/// [`Exact`]: a division a fragment. 8 bytes a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Desktop;

profile!(Desktop: Exact = Exact, Sub8, Rgba8888, F32);

/// For microcontrollers with or without floating point, and a display of 16 bits a pixel.
///
/// # Precision
/// Attributes in steps of 2^-16 within ±4096, right to a few of them every 16 columns. Between these they are off by
/// one a column and the miss of a straight line: see [`FixedPoint`] and [`Spans16`]. Depth in steps of 2^-16 of zs;
/// vertices within 2^-5 pixel; 5 or 6 bits a channel.
///
/// # Cost
/// A fragment: an addition for the depth and one a component. Every 16 columns: a look into a table instead of a
/// division. 4 bytes a pixel; edge functions of 32 bits up to 2,890 pixels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mcu;

profile!(Mcu: FixedPoint<Spans16> = FixedPoint(Spans16), Sub4, Rgb565Be, D16);

/// For the least memory and the fewest instructions. There is no depth buffer, so that triangles have to come from back
/// to front. There is no perspective within a triangle, so that textured ones have to be small, or face the viewer.
///
/// # Precision
/// Attributes as the [`FixedPoint`] of [`Affine`]: linear on the screen, in steps of 2^-16 within ±4096. Vertices
/// within 2^-5 pixel; 5 or 6 bits a channel.
///
/// # Cost
/// A fragment: an addition a component. 2 bytes a pixel; edge functions of 32 bits up to 2,890 pixels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tiny;

profile!(Tiny: FixedPoint<Affine> = FixedPoint(Affine), Sub4, Rgb565Be, NoDepth);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_takes_the_bytes_that_the_table_says() {
        let bytes = [Reference::PIXEL_BYTES, Desktop::PIXEL_BYTES, Mcu::PIXEL_BYTES, Tiny::PIXEL_BYTES];
        assert_eq!(bytes, [8, 8, 4, 2]);
    }
}
