//! Profiles: the policies of a whole picture under one name, so that a signature carries one parameter.
//!
//! | profile | for | interpolation | depth | subpixels | bytes a pixel |
//! |---|---|---|---|---|---|
//! | [`Reference`] | what others are compared with | [`Exact`] | [`F32Reversed`] | 8 bits | 8 |
//! | [`Desktop`] | machines with vector registers | [`Exact`] | [`F32`] | 8 bits | 8 |
//! | [`Mcu`] | microcontrollers | [`Spans<16>`](Spans) in [`FixedPoint`] | [`D16`] | 4 bits | 4 |
//! | [`Tiny`] | the smallest of them | [`Affine`] in [`FixedPoint`] | [`NoDepth`] | 4 bits | 2 |
//!
//! | profile | precision of attributes | cost of a fragment |
//! |---|---|---|
//! | [`Reference`], [`Desktop`] | 9ε | a division; a component adds four products |
//! | [`Mcu`] | 19 steps of 2^-16, and what a line misses along 16 columns | an addition a component; a table every 16 columns |
//! | [`Tiny`] | 67 steps of 2^-16, and what a line misses along the triangle | an addition a component |
//!
//! A profile is for code that is to be drawn in several ways. Code that knows its way names the policies themselves.

use crate::pipeline::Pass;
use crate::prepared::ScreenTriangle;
use crate::vertex::Slot;
use alberti_math::{Rgba8, Sub4, Sub8, Subpixel};
use alberti_projection::{Parallel, Perspective, Projection};
use alberti_raster::{
    Affine, Band, ColorFormat, D16, DepthFormat, Exact, F32, F32Reversed, FixedPoint, Interpolation, NoDepth,
    Rgb565Be, Spans, Store,
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
/// fn frame<P: Profile>(band: &mut BandOf<'_, P>) -> Result<(), ViewError> {
///     let pass = Pass {
///         view: View {
///             to_eye: Frame::at(Point3::new(Vec3::new(0.0, 0.0, 2.0))),
///             projection: Perspective::new(1.0, 32.0 / 24.0, 0.1, 10.0)?,
///             viewport: Viewport::new(0, 0, 32, 24)?,
///         },
///         vertices: &[(-0.9, -0.8, 0.0), (0.9, -0.8, 0.0), (0.0, 0.8, 1.0)],
///         triangles: &[[0u16, 1, 2]],
///         vertex_stage: |&(x, y, z): &(f32, f32, f32)| (Point3::new(Vec3::new(x, y, z)), Vec3::new(1.0, z, 0.0)),
///         fragment_stage: VertexColor,
///         cull: Cull::None,
///         sides: Sides::GuardBand,
///         interpolation: P::INTERPOLATION,
///     };
///     band.clear(Rgba8::BLACK);
///     draw(&pass, band, &mut [SlotOf::<P, _>::EMPTY; 3], &mut ());
///     Ok(())
/// }
///
/// let (mut color, mut depth) = ([0; 32 * 24], [0.0; 32 * 24]);
/// frame::<Desktop>(&mut Band::new(32, 0, &mut color, &mut depth)?)?;
/// let (mut small, mut none) = ([0; 32 * 24], [(); 32 * 24]);
/// frame::<Tiny>(&mut Band::new(32, 0, &mut small, &mut none)?)?;
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
/// One's own is a type with nothing in it:
///
/// ```
/// # use alberti::*;
/// /// Sixteen bits a pixel and a depth test, in fixed point.
/// #[derive(Clone, Copy, Debug)]
/// enum Mine {}
///
/// impl Profile for Mine {
///     type Interpolation = FixedPoint<Bounded>;
///     const INTERPOLATION: FixedPoint<Bounded> = FixedPoint(Bounded { budget: 1.0 / 256.0 });
///     type Depth = D16;
///     type Color = Rgb565Le;
///     type Subpixel = Sub4;
/// }
/// assert_eq!(Mine::PIXEL_BYTES, 4);
/// ```
///
/// What makes no sense does not compile: fixed point takes policies of straight lines, and `Exact` and `Plane` are
/// none.
///
/// ```compile_fail,E0277
/// # use alberti::*;
/// # #[derive(Clone, Copy, Debug)]
/// # enum Mine {}
/// impl Profile for Mine {
///     type Interpolation = FixedPoint<Exact>;
///     const INTERPOLATION: FixedPoint<Exact> = FixedPoint(Exact);
/// #    type Depth = D16;
/// #    type Color = Rgb565Le;
/// #    type Subpixel = Sub4;
/// }
/// ```
pub trait Profile: Copy + Debug + 'static {
    /// Perspective, and the numbers it is computed in.
    type Interpolation: Interpolation;
    /// The interpolation with its settings, where it has any.
    const INTERPOLATION: Self::Interpolation;
    /// What a depth is stored as.
    type Depth: DepthFormat;
    /// What a colour is stored as: any format that takes what most fragment stages make.
    type Color: Store<Rgba8>;
    /// How finely vertices are snapped.
    type Subpixel: Subpixel;
    /// Memory for a pixel, with its depth.
    const PIXEL_BYTES: usize = size_of::<PixelOf<Self>>() + size_of::<StoredOf<Self>>();
}

/// A projection that knows the interpolation it needs: for scenes that are drawn through either.
///
/// | projection | interpolation | precision of attributes | divisions |
/// |---|---|---|---|
/// | [`Perspective`] | [`Exact`] | 9ε | one a fragment |
/// | [`Parallel`] | [`Affine`] | 6ε | one every 64 columns |
///
/// In parallel projection all policies have the same result within their rounding, and [`Affine`] (in fixed point
/// [`FixedPoint<Affine>`](FixedPoint)) does the least for a pixel. Where triangles have a few pixels each, what a run
/// costs counts for more, and with several lanes [`Exact`] may be faster.
///
/// ```
/// use alberti::{glam::Vec3, shaders::VertexColor, *};
///
/// /// A triangle that leans away from the viewer; how many pixels it covers.
/// fn pixels<Pr: Interpolated>(projection: Pr) -> Result<u64, Box<dyn core::error::Error>> {
///     let pass = Pass {
///         view: View {
///             to_eye: Frame::at(Point3::new(Vec3::new(0.0, 0.0, 2.0))),
///             projection,
///             viewport: Viewport::new(0, 0, 32, 24)?,
///         },
///         vertices: &[(-0.9, -0.8, 0.0), (0.9, -0.8, 0.0), (0.0, 0.8, 1.0)],
///         triangles: &[[0u16, 1, 2]],
///         vertex_stage: |&(x, y, z): &(f32, f32, f32)| (Point3::new(Vec3::new(x, y, z)), Vec3::splat(z)),
///         fragment_stage: VertexColor,
///         cull: Cull::None,
///         sides: Sides::GuardBand,
///         interpolation: Pr::INTERPOLATION,
///     };
///     let (mut color, mut depth, mut stats) = ([0; 32 * 24], [1.0; 32 * 24], Stats::default());
///     let mut band = Band::<Rgba8, F32>::new(32, 0, &mut color, &mut depth)?;
///     draw(&pass, &mut band, &mut [Slot::<Sub8, _>::EMPTY; 3], &mut stats);
///     Ok(stats.written)
/// }
///
/// // Two units of height are seen at the distance 2, in parallel projection everywhere: nothing gets smaller.
/// let perspective = pixels(Perspective::new(0.927_295_2, 32.0 / 24.0, 0.1, 10.0)?)?;
/// let parallel = pixels(Parallel::new(2.0, 32.0 / 24.0, 0.1, 10.0)?)?;
/// assert!(perspective < parallel);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub trait Interpolated: Projection {
    /// The cheapest policy that is exact, but for rounding.
    type Interpolation: Interpolation;
    /// The same as a value.
    const INTERPOLATION: Self::Interpolation;
}

impl Interpolated for Perspective {
    type Interpolation = Exact;
    const INTERPOLATION: Exact = Exact;
}

impl Interpolated for Parallel {
    type Interpolation = Affine;
    const INTERPOLATION: Affine = Affine;
}

/// What a profile's colour buffer holds for a pixel.
pub type PixelOf<P> = <<P as Profile>::Color as ColorFormat>::Pixel;

/// What a profile's depth buffer holds for a pixel.
pub type StoredOf<P> = <<P as Profile>::Depth as DepthFormat>::Stored;

/// A band of a profile.
pub type BandOf<'a, P> = Band<'a, <P as Profile>::Color, <P as Profile>::Depth>;

/// A slot of a profile, for vertices that carry a `V`.
pub type SlotOf<P, V> = Slot<<P as Profile>::Subpixel, V>;

/// Room for a triangle of a profile, with vertices that carry a `V`.
pub type ScreenTriangleOf<P, V> = ScreenTriangle<<P as Profile>::Subpixel, V>;

/// A pass of a profile.
pub type PassOf<'a, P, T, I, Vs, Fs> = Pass<'a, T, I, Vs, Fs, <P as Profile>::Interpolation>;

/// The most precise of each family: what other pictures are compared with.
///
/// # Precision
/// Attributes within 9ε, of the greatest value at a vertex; depth in relative steps of 2^-24 at any distance; vertices
/// within 2^-9 pixel; 8 bits a channel.
///
/// # Cost
/// [`Exact`]: a division a fragment. 8 bytes a pixel.
#[derive(Clone, Copy, Debug)]
pub enum Reference {}

impl Profile for Reference {
    type Interpolation = Exact;
    const INTERPOLATION: Exact = Exact;
    type Depth = F32Reversed;
    type Color = Rgba8;
    type Subpixel = Sub8;
}

/// For machines with vector registers: [`Reference`] with depth as it is taught, growing with distance.
///
/// # Precision
/// As [`Reference`], but depth has steps of 2^-24 in zs, which are coarse in the distance: see [`F32`].
///
/// # Cost
/// [`Exact`]: a division a fragment. 8 bytes a pixel.
#[derive(Clone, Copy, Debug)]
pub enum Desktop {}

impl Profile for Desktop {
    type Interpolation = Exact;
    const INTERPOLATION: Exact = Exact;
    type Depth = F32;
    type Color = Rgba8;
    type Subpixel = Sub8;
}

/// For microcontrollers with or without floating point, and a display of 16 bits a pixel.
///
/// # Precision
/// Attributes in steps of 2^-16 within ±4096, right to a few of them every 16 columns, and off between by one a column
/// and by what a straight line misses: see [`FixedPoint`] and [`Spans`]. Depth in steps of 2^-16 of zs; vertices within
/// 2^-5 pixel; 5 or 6 bits a channel.
///
/// # Cost
/// A fragment: an addition for the depth and one a component. Every 16 columns: a look into a table instead of a
/// division. 4 bytes a pixel; edge functions of 32 bits up to 2,890 pixels.
#[derive(Clone, Copy, Debug)]
pub enum Mcu {}

impl Profile for Mcu {
    type Interpolation = FixedPoint<Spans<16>>;
    const INTERPOLATION: FixedPoint<Spans<16>> = FixedPoint(Spans);
    type Depth = D16;
    type Color = Rgb565Be;
    type Subpixel = Sub4;
}

/// For the least memory and the fewest instructions: no depth buffer, so that triangles have to come from back to
/// front, and no perspective within a triangle, so that they have to be small, or face the viewer, where they carry
/// textures.
///
/// # Precision
/// Attributes as the [`FixedPoint`] of [`Affine`]: linear on the screen, in steps of 2^-16 within ±4096. Vertices
/// within 2^-5 pixel; 5 or 6 bits a channel.
///
/// # Cost
/// A fragment: an addition a component. 2 bytes a pixel; edge functions of 32 bits up to 2,890 pixels.
#[derive(Clone, Copy, Debug)]
pub enum Tiny {}

impl Profile for Tiny {
    type Interpolation = FixedPoint<Affine>;
    const INTERPOLATION: FixedPoint<Affine> = FixedPoint(Affine);
    type Depth = NoDepth;
    type Color = Rgb565Be;
    type Subpixel = Sub4;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_takes_the_bytes_that_the_table_says() {
        let bytes = [Reference::PIXEL_BYTES, Desktop::PIXEL_BYTES, Mcu::PIXEL_BYTES, Tiny::PIXEL_BYTES];
        assert_eq!(bytes, [8, 8, 4, 2]);
    }
}
