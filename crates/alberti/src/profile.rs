//! Profiles: the policies of a whole picture under one name, so that a function takes one argument.

use alberti_math::{Rgb565Be, Rgba8888, Sub4, Sub8, Subpixel};
use alberti_raster::{
    Affine, Bands, ColorFormat, D16, DepthFormat, Exact, F32, F32Reversed, FixedPoint, NoDepth, Spans16,
    Target, TargetError,
};

/// A choice of one policy from each family. The built-in ones are [`REFERENCE`], [`DESKTOP`], [`MCU`] and [`TINY`].
///
/// | profile | for | interpolation | depth | subpixels | bytes a pixel |
/// |---|---|---|---|---|---|
/// | [`REFERENCE`] | comparisons | [`Exact`] | [`F32Reversed`] | 8 bits | 8 |
/// | [`DESKTOP`] | machines with vector registers | [`Exact`] | [`F32`] | 8 bits | 8 |
/// | [`MCU`] | microcontrollers | [`Spans16`] in [`FixedPoint`] | [`D16`] | 4 bits | 4 |
/// | [`TINY`] | the smallest of them | [`Affine`] in [`FixedPoint`] | [`NoDepth`] | 4 bits | 2 |
///
/// | profile | precision of attributes | cost of a fragment |
/// |---|---|---|
/// | [`REFERENCE`], [`DESKTOP`] | 9ε | a division; a component adds four products |
/// | [`MCU`] | 19 steps of 2^-16, and the miss of a line along 16 columns | an addition a component; a table every 16 columns |
/// | [`TINY`] | 67 steps of 2^-16, and the miss of a line along the triangle | an addition a component |
///
/// A profile is for code that is to be drawn in several ways. Code that knows its way names the policies themselves.
///
/// The same scene under two of them, and under one's own:
///
/// ```
/// use alberti::{glam::Vec3, shaders::VertexColor, *};
///
/// /// A triangle that leans away from the viewer.
/// fn frame<I: Interpolation, C: ColorFormat, D: DepthFormat>(
///     profile: Profile<I, C, D>,
///     target: &mut Target<'_, C, D>,
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
/// frame(DESKTOP, &mut DESKTOP.target(32, 24, &mut color, &mut depth)?)?;
/// let (mut small, mut none) = ([0; 32 * 24], [(); 32 * 24]);
/// frame(TINY, &mut TINY.target(32, 24, &mut small, &mut none)?)?;
///
/// // Full red, and green growing upwards: later with perspective, as the upper corner is farther.
/// let middle = 11 * 32 + 16;
/// let [red, green, ..] = color[middle].to_ne_bytes();
/// let packed = u16::from_be(small[middle]);
/// assert_eq!((red, packed >> 11), (255, 31));
/// assert!(u32::from(green) * 63 < u32::from(packed >> 5 & 63) * 255);
///
/// let interpolation = FixedPoint(Lines::bounded(1.0 / 256.0));
/// let mine = Profile { interpolation, subpixel: Sub4, color: Rgb565Be, depth: D16 };
/// frame(mine, &mut mine.target(32, 24, &mut small, &mut [0; 32 * 24])?)?;
/// # Ok::<(), Box<dyn core::error::Error>>(())
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Profile<I, C, D> {
    /// Perspective, and the numbers it is computed in.
    pub interpolation: I,
    /// The grid of the vertices.
    pub subpixel: Subpixel,
    /// The format of colours.
    pub color: C,
    /// The format of depths.
    pub depth: D,
}

impl<I, C: ColorFormat, D: DepthFormat> Profile<I, C, D> {
    /// A target of the profile's formats: [`Target::new`].
    ///
    /// # Errors
    /// Those of [`Target::new`].
    pub fn target<'a>(
        self,
        width: u32,
        height: u32,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Target<'a, C, D>, TargetError> {
        Target::new(self.color, self.depth, width, height, color, depth)
    }

    /// The bands of a frame in the profile's formats: [`Bands::new`].
    ///
    /// # Errors
    /// Those of [`Bands::new`].
    pub fn bands<'a>(
        self,
        width: u32,
        height: u32,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Bands<'a, C, D>, TargetError> {
        Bands::new(self.color, self.depth, width, height, color, depth)
    }
}

/// The most precise of each family, for comparisons with other pictures.
///
/// # Precision
/// Attributes within 9ε, of the greatest value at a vertex; depth in relative steps of 2^-24 at any distance; vertices
/// within 2^-9 pixel; 8 bits a channel.
///
/// # Cost
/// [`Exact`]: a division a fragment. 8 bytes a pixel.
pub const REFERENCE: Profile<Exact, Rgba8888, F32Reversed> =
    Profile { interpolation: Exact, subpixel: Sub8, color: Rgba8888, depth: F32Reversed };

/// For machines with vector registers: [`REFERENCE`] with depth as it is taught, growing with distance.
///
/// # Precision
/// As [`REFERENCE`], but depth has steps of 2^-24 in zs, which are coarse in the distance: see [`F32`].
///
/// # Cost
/// [`Exact`]: a division a fragment. 8 bytes a pixel.
pub const DESKTOP: Profile<Exact, Rgba8888, F32> =
    Profile { interpolation: Exact, subpixel: Sub8, color: Rgba8888, depth: F32 };

/// For microcontrollers with or without floating point, and a display of 16 bits a pixel.
///
/// # Precision
/// Attributes in steps of 2^-16 within ±4096, right to a few of them every 16 columns. Between these they are off by
/// one a column and the miss of a straight line: see [`FixedPoint`] and [`Spans16`]. Depth in steps of 2^-16 of zs;
/// vertices within 2^-5 pixel; 5 or 6 bits a channel.
///
/// # Cost
/// A fragment: an addition for the depth and one a component. Every 16 columns: a look into a table instead of a
/// division. 4 bytes a pixel; edge functions of 64 bits.
pub const MCU: Profile<FixedPoint<Spans16>, Rgb565Be, D16> =
    Profile { interpolation: FixedPoint(Spans16), subpixel: Sub4, color: Rgb565Be, depth: D16 };

/// For the least memory and the fewest instructions. There is no depth buffer, so that triangles have to come from back
/// to front. There is no perspective within a triangle, so that textured ones have to be small, or face the viewer.
///
/// # Precision
/// Attributes as the [`FixedPoint`] of [`Affine`]: linear on the screen, in steps of 2^-16 within ±4096. Vertices
/// within 2^-5 pixel; 5 or 6 bits a channel.
///
/// # Cost
/// A fragment: an addition a component. 2 bytes a pixel; edge functions of 64 bits.
pub const TINY: Profile<FixedPoint<Affine>, Rgb565Be, NoDepth> =
    Profile { interpolation: FixedPoint(Affine), subpixel: Sub4, color: Rgb565Be, depth: NoDepth };
