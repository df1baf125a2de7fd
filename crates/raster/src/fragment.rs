//! The fragment stage: from interpolated attributes to a colour.

use crate::color::FragmentColor;
use crate::differentiation::{Differentiation, NoDerivatives};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Gradient, Varying};
use core::fmt;

/// A map from the varying of a covered sample that passed the depth test to a colour, or to none, which leaves the
/// pixel and its depth as they are.
///
/// Any closure `Fn(V) -> Option<Color>` that is `Copy` is one, called for one sample after the other: it captures
/// nothing, references, or, with `move`, values that are `Copy`. A part of the varying that it does not use is not
/// computed. Stages are copied to the loop over the pixels, so that their fields may be kept in registers.
///
/// A stage that is a type shades all lanes at once, with the arithmetic of [`Lanes`]:
///
/// ```
/// use alberti_math::lanes::Lanes;
/// use alberti_raster::{FragmentStage, Fragments, NoDerivatives};
/// use alberti_math::Rgba8;
///
/// /// Shades of grey, in a pattern of pixels.
/// #[derive(Clone, Copy)]
/// struct Hatched;
///
/// impl FragmentStage<f32> for Hatched {
///     type Color = Rgba8;
///     type Derivatives = NoDerivatives;
///
///     fn shade<L: Lanes>(&self, fragments: &Fragments<L, f32>) -> (L::U32, L::Mask) {
///         let Fragments { lanes, varying, mask, place: [_, row], .. } = *fragments;
///         let factor = if row % 2 == 0 { 255.0 } else { 200.0 };
///         let grey = lanes.nearest_byte(varying * lanes.splat(factor));
///         (grey * lanes.word(0x0001_0101) | lanes.word(0xff00_0000), mask)
///     }
/// }
/// assert_eq!(Hatched.shade_one(0.5), Some(Rgba8::from_rgb24(0x80_80_80)));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a fragment stage for vertices that carry `{V}`",
    note = "a closure `Fn({V}) -> Option<Rgba8>` is one, if it is `Copy`: with `move`, or capturing references only"
)]
pub trait FragmentStage<V: Varying>: Copy {
    /// The colour it makes: an [`Rgba8`](alberti_math::Rgba8), or a word of the target's pixels.
    type Color: FragmentColor;
    /// The policy for derivatives of the varying: [`NoDerivatives`], unless it needs them.
    type Derivatives: Differentiation;

    /// Whether wide rows are shaded as many samples at a time as [`Floating::Wide`](alberti_math::lanes::Floating) has.
    /// A stage that hands on all attributes through memory is faster with fewer.
    const WIDE: bool = true;

    /// Whether a depth is stored before its colour, whatever the format says: see
    /// [`ColorFormat`](crate::ColorFormat::DEPTH_FIRST).
    const DEPTH_FIRST: bool = false;

    /// That policy.
    #[inline(always)]
    fn derivatives(&self) -> Self::Derivatives {
        Self::Derivatives::default()
    }

    /// Whether derivatives are to be the same in all of a triangle: then [`settled`](Self::settled) has them. Otherwise
    /// the stage does not compile.
    const SETTLES: bool = false;

    /// The stage for a triangle in which all samples have these derivatives: what depends on them alone is found once.
    /// A stage in another hands it on, and [`SETTLES`](Self::SETTLES).
    #[inline(always)]
    #[must_use]
    fn settled<L: Lanes>(&self, lanes: L, gradient: &Gradient<V::Of<L::Number>>) -> Self {
        let _ = (lanes, gradient);
        *self
    }

    /// Whether there is a stage for each row: then [`in_row`](Self::in_row) has it.
    const BY_ROWS: bool = false;

    /// The stage for the fragments of a row, which is asked for before these. A stage in another hands it on, and
    /// [`BY_ROWS`](Self::BY_ROWS).
    #[inline(always)]
    #[must_use]
    fn in_row(&self, row: i32) -> Self {
        let _ = row;
        *self
    }

    /// The colours of several fragments, as words, and those of them that are not discarded. Samples beside the mask
    /// may get any colour: they are not drawn, whether or not they are discarded. Under
    /// [`FixedPoint`](crate::FixedPoint) numbers are `Q16`: within ±32768, in steps of 2^-16.
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask);

    /// The colour of one fragment, or `None` if it is discarded; of a varying that does not change between pixels, in
    /// column 0 of row 0.
    fn shade_one(&self, varying: V) -> Option<Self::Color> {
        let varying = V::map(&V::gather([varying]), &|[x]: [f32; 1]| x);
        let steady = V::map(&varying, &|_| 0.0);
        let gradient = Gradient { dx: steady, dy: steady };
        let (word, kept) =
            self.shade(&Fragments { lanes: One, varying, gradient, mask: true, place: [0; 2] });
        kept.then_some(Self::Color::from_word(word.0))
    }
}

/// Fragments side by side in a row, one for each lane.
pub struct Fragments<L: Lanes, V: Varying> {
    /// The lanes.
    pub lanes: L,
    /// The attributes of each; beside the mask finite, but without a meaning.
    pub varying: V::Of<L::Number>,
    /// The derivatives of the attributes by column and row: 0 for [`NoDerivatives`], without a meaning beside the mask.
    pub gradient: Gradient<V::Of<L::Number>>,
    /// The samples that are asked for.
    pub mask: L::Mask,
    /// The column of the first lane, and the row, in the frame, whatever band is drawn.
    pub place: [i32; 2],
}

impl<L: Lanes, V: Varying> Fragments<L, V> {
    /// The same fragments with a part of their attributes, for a stage inside of another.
    #[inline(always)]
    pub fn part<W: Varying>(&self, part: impl Fn(&V::Of<L::Number>) -> W::Of<L::Number>) -> Fragments<L, W> {
        let Self { lanes, varying, gradient: Gradient { dx, dy }, mask, place } = self;
        let gradient = Gradient { dx: part(dx), dy: part(dy) };
        Fragments { lanes: *lanes, varying: part(varying), gradient, mask: *mask, place: *place }
    }
}

impl<L: Lanes, V: Varying> Clone for Fragments<L, V> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<L: Lanes, V: Varying> Copy for Fragments<L, V> {}

impl<L: Lanes, V: Varying> fmt::Debug for Fragments<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mask = self.lanes.bits(self.mask);
        f.debug_struct("Fragments").field("place", &self.place).field("mask", &mask).finish_non_exhaustive()
    }
}

impl<V: Varying, C: FragmentColor, F: Fn(V) -> Option<C> + Copy> FragmentStage<V> for F {
    type Color = C;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying, mask, .. } = fragments;
        let in_memory = V::map(varying, &|numbers: L::Number| lanes.store(numbers));
        let mut bits = lanes.bits(*mask);
        let colors = lanes.each(|k| {
            if bits >> k & 1 == 0 {
                return 0;
            }
            let lane = |each: L::Each<f32>| each.as_ref().get(k).copied().unwrap_or_default();
            let color = self(V::from_components(&V::map(&in_memory, &lane)));
            if color.is_none() {
                bits &= !(1 << k);
            }
            color.map_or(0, C::to_word)
        });
        (lanes.load_words(&colors), lanes.mask(bits))
    }
}
