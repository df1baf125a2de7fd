//! Texels with alpha as they are stored.

use alberti_math::glam::Vec2;
use alberti_math::lanes::Lanes;
use alberti_math::{Gradient, Rgba8, Rgba565};
use alberti_raster::{FragmentStage, Fragments, NoDerivatives, PerTriangle};
use alberti_texture::{Leveled, Nearest, NearestLevel, Sampler, Size, TexelFormat, Wrap};

/// A texture's colours with alpha, for targets of RGB565 that are mixed [`Over`](alberti_raster::color::Over): nearest
/// texels, best of the format [`Rgb565Alpha`](alberti_texture::format::Rgb565Alpha), which is drawn as it is stored. Of
/// a mip map whose levels are chosen once a triangle ([`Leveled`]), those of its level.
///
/// ```
/// use alberti::raster::color::{Blended, Over};
/// use alberti::shaders::StoredAlpha;
/// use alberti::texture::{Nearest, Repeat, Texture, format::Rgb565Alpha};
/// use alberti::{NoDepth, Rgb565Le, Rgba8, Target};
///
/// static PANE: [u32; 1] = Rgb565Alpha::of(&[[0, 0, 255, 128]]);
/// let stage = StoredAlpha(Texture::new(Rgb565Alpha, &PANE, 1, 1)?.sampler(Nearest, Repeat));
/// let (mut color, mut depth) = ([0; 64], [(); 64]);
/// let mut target = Target::new(Rgb565Le, NoDepth, 8, 8, &mut color, &mut depth)?;
/// let mut glass = target.with_color(Blended { format: Rgb565Le, by: Over });
/// # let _ = (stage, &mut glass);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Precision
/// That of [`Rgba565`].
///
/// # Cost
/// On RGB565 that of [`Stored`](super::Stored), and one product of a word. In other formats, and other targets, three
/// divisions.
#[derive(Clone, Copy, Debug)]
pub struct StoredAlpha<S>(
    /// The texture with its wrap mode.
    pub S,
);

impl<F: TexelFormat, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for StoredAlpha<Sampler<'_, F, Nearest, U, V, Z>>
{
    type Color = Rgba565;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        const NOTHING: Rgba565 = Rgba565::new(Rgba8::new(0, 0, 0, 0));
        let Fragments { lanes, varying: [u, v], mask, .. } = *fragments;
        let format = self.0.texture().format();
        let word = |texel: Option<F::Texel>| texel.map_or(NOTHING, |texel| format.rgba565(texel)).to_bits();
        (self.0.stored_lanes(lanes, u, v, word), mask)
    }
}

impl<F: TexelFormat, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for StoredAlpha<Leveled<'_, F, NearestLevel<Nearest>, U, V, Z>>
{
    type Color = Rgba565;
    type Derivatives = PerTriangle;
    const SETTLES: bool = true;

    #[inline(always)]
    fn settled<L: Lanes>(&self, lanes: L, gradient: &Gradient<[L::Number; 2]>) -> Self {
        Self(self.0.settled(lanes, gradient))
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        StoredAlpha(self.0.level()).shade(fragments)
    }
}
