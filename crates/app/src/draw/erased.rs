//! Fragment stages behind a pointer, so that a kernel is compiled once for all of them. The pixels are the stage's own.
//!
//! Such a stage gets one bundle, [`Attributes`]. The components that it does not use are interpolated nevertheless. Of
//! the derivatives there are only those of the texture coordinates.

use alberti::lanes::{Floating, Lanes, OneFixed};
use alberti::raster::{AnyDerivatives, Gradient};
use alberti::shaders::material::Framed;
use alberti::{FragmentStage, Fragments, Homogeneous, Q16, Rgba8, Varying};

/// The attributes for such a stage: a place on a projector's image, and a place on a surface with its tangent frame.
pub(super) type Attributes = (Homogeneous, Framed);

/// The bundle of these.
type Bundle<N> = <Attributes as Varying>::Of<N>;

/// A bundle of derivatives, of which only those of the texture coordinates are not 0.
#[inline(always)]
fn with_uv<L: Lanes>(lanes: L, like: &Bundle<L::Number>, uv: [L::Number; 2]) -> Bundle<L::Number> {
    let zero = lanes.splat(0.0);
    let (place, mut framed) = Attributes::map(like, &|_| zero);
    framed.uv = uv;
    (place, framed)
}

/// The arguments in memory.
struct Handed<N: Copy> {
    varying: Bundle<N>,
    /// The derivatives of u and v by column and row.
    gradient: Gradient<[N; 2]>,
    /// The samples that are asked for, a bit each.
    mask: u32,
    place: [i32; 2],
}

/// A stage for so many samples at a time as there are lanes of floats: their numbers in memory, colours back, and a bit
/// for each that is kept.
///
/// # Cost
/// For the lanes together, a call and a copy each way.
#[derive(Clone, Copy)]
pub(super) struct Erased<'a, L: Lanes + 'a> {
    lanes: L,
    derivatives: AnyDerivatives,
    shade: &'a Shade<'a, L>,
}

type Shade<'a, L> = dyn Fn(&Handed<<L as Lanes>::Each<f32>>) -> (<L as Lanes>::Each<u32>, u32) + Sync + 'a;

/// Calls `then` with `stage`, behind a pointer.
pub(super) fn erase<L: Floating>(
    lanes: L,
    derivatives: AnyDerivatives,
    stage: impl FragmentStage<Attributes, Color = Rgba8> + Sync,
    then: impl FnOnce(Erased<'_, L>),
) {
    let shade = |handed: &Handed<L::Each<f32>>| {
        lanes.vectorize(
            #[inline(always)]
            || {
                let varying = Attributes::map(&handed.varying, &|each: L::Each<f32>| lanes.load(&each));
                let gradient = handed.gradient.map(
                    #[inline(always)]
                    |[u, v]| with_uv(lanes, &varying, [lanes.load(&u), lanes.load(&v)]),
                );
                let (mask, place) = (lanes.mask(handed.mask), handed.place);
                let (words, kept) = stage.shade(&Fragments { lanes, varying, gradient, mask, place });
                (lanes.store_words(words), lanes.bits(kept))
            },
        )
    };
    then(Erased { lanes, derivatives, shade: &shade });
}

impl<L: Lanes> FragmentStage<Attributes> for Erased<'_, L> {
    type Color = Rgba8;
    type Derivatives = AnyDerivatives;
    const WIDE: bool = false;

    fn derivatives(&self) -> AnyDerivatives {
        self.derivatives
    }

    /// `M` is `L` under another name, or fewer.
    #[inline(always)]
    fn shade<M: Lanes>(&self, fragments: &Fragments<M, Attributes>) -> (M::U32, M::Mask) {
        let Fragments { lanes, varying, gradient, mask, place } = fragments;
        let each = |number: M::Number| {
            let values = lanes.store(number);
            self.lanes.each(|k| values.as_ref().get(k).copied().unwrap_or_default())
        };
        let (words, kept) = (self.shade)(&Handed {
            varying: Attributes::map(varying, &each),
            gradient: gradient.map(|(_, framed)| framed.uv.map(each)),
            mask: lanes.bits(*mask),
            place: *place,
        });
        let words = lanes.each(|k| words.as_ref().get(k).copied().unwrap_or_default());
        (lanes.load_words(&words), *mask & lanes.mask(kept))
    }
}

/// A stage for one sample in fixed point.
#[derive(Clone, Copy)]
pub(super) struct ErasedFixed<'a> {
    derivatives: AnyDerivatives,
    shade: &'a (dyn Fn(&Handed<Q16>) -> (u32, bool) + Sync),
}

/// Calls `then` with `stage` in fixed point, behind a pointer.
pub(super) fn erase_fixed(
    derivatives: AnyDerivatives,
    stage: impl FragmentStage<Attributes, Color = Rgba8> + Sync,
    then: impl FnOnce(ErasedFixed<'_>),
) {
    let shade = |&Handed { varying, gradient, mask, place }: &Handed<Q16>| {
        let gradient = gradient.map(|uv| with_uv(OneFixed, &varying, uv));
        let (word, kept) =
            stage.shade(&Fragments { lanes: OneFixed, varying, gradient, mask: mask != 0, place });
        (word.0, kept)
    };
    then(ErasedFixed { derivatives, shade: &shade });
}

impl FragmentStage<Attributes> for ErasedFixed<'_> {
    type Color = Rgba8;
    type Derivatives = AnyDerivatives;

    fn derivatives(&self) -> AnyDerivatives {
        self.derivatives
    }

    #[inline(always)]
    fn shade<M: Lanes>(&self, fragments: &Fragments<M, Attributes>) -> (M::U32, M::Mask) {
        let Fragments { lanes, varying, gradient, mask, place } = fragments;
        // In units of 2^-16, in which numbers in fixed point are.
        let bits = |number: M::Number| lanes.store_words(lanes.floor_scaled(number, 16));
        let (carried, samples) = (Attributes::map(varying, &bits), lanes.bits(*mask));
        let gradient = gradient.map(|(_, framed)| framed.uv.map(bits));
        let mut kept = 0;
        let mut word = |k: usize| {
            let at = |words: M::Each<u32>| {
                Q16::from_bits(words.as_ref().get(k).copied().unwrap_or_default().cast_signed())
            };
            let (word, keeps) = (self.shade)(&Handed {
                varying: Attributes::map(&carried, &at),
                gradient: gradient.map(|uv| uv.map(at)),
                mask: samples >> k & 1,
                place: *place,
            });
            kept |= u32::from(keeps) << k;
            word
        };
        let mut words = lanes.each(|_| 0);
        words.as_mut().iter_mut().enumerate().for_each(|(k, slot)| *slot = word(k));
        (lanes.load_words(&words), *mask & lanes.mask(kept))
    }
}
