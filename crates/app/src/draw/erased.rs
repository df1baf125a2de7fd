//! Fragment stages behind a pointer, so that a kernel is compiled once for all of them. The pixels are the stage's own.
//!
//! What such a stage is handed is a place on a projector's image, and (a normal or a colour, texture coordinates); what
//! it does not use of them is computed nevertheless. No stage discards.

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Floating, Lanes, One, OneFixed};
use alberti::raster::{Gradient, NoDerivatives};
use alberti::shaders::Slide;
use alberti::texture::{Clamp, Filter, Sampler};
use alberti::{FragmentStage, Homogeneous, Q16, Rgba8};

/// What a vertex carries to such a stage.
pub(super) type Carried = (Homogeneous, Looks);

/// What a surface needs of that: a normal or a colour, and texture coordinates.
pub(super) type Looks = (Vec3, Vec2);

/// A stage for so many samples at a time as there are lanes of floats: their numbers in memory, colours back.
///
/// # Cost
/// For the lanes together, a call and a copy each way.
#[derive(Clone, Copy)]
pub(super) struct Erased<'a, L: Lanes> {
    lanes: L,
    shade: &'a Shade<'a, L>,
}

type Shade<'a, L> = dyn Fn(&[<L as Lanes>::Each<f32>; 8]) -> <L as Lanes>::Each<u32> + 'a;

/// Calls `then` with `stage`, behind a pointer.
pub(super) fn erase<L: Floating>(
    lanes: L,
    stage: impl FragmentStage<Carried, Color = Rgba8>,
    then: &mut dyn FnMut(Erased<'_, L>),
) {
    let shade = |values: &[L::Each<f32>; 8]| {
        lanes.vectorize(
            #[inline(always)]
            || {
                let [p, q, r, x, y, z, u, v] = values.map(|value| lanes.load(&value));
                let carried = ([p, q, r], ([x, y, z], [u, v]));
                let (words, _) = stage.shade_lanes(lanes, &carried, &steady(lanes), lanes.mask(all::<L>()));
                lanes.store_words(words)
            },
        )
    };
    then(Erased { lanes, shade: &shade });
}

impl<L: Lanes> FragmentStage<Carried> for Erased<'_, L> {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, carried: Carried) -> Option<Rgba8> {
        let (word, _) = self.shade_lanes(One, &components(carried), &steady(One), true);
        Some(Rgba8::from_bits(word.0))
    }

    /// `M` is `L` under another name, or fewer.
    #[inline(always)]
    fn shade_lanes<M: Lanes>(
        &self,
        lanes: M,
        ([p, q, r], ([x, y, z], [u, v])): &Numbers<M>,
        _: &Gradient<Numbers<M>>,
        mask: M::Mask,
    ) -> (M::U32, M::Mask) {
        let values = [p, q, r, x, y, z, u, v].map(|number| {
            let values = lanes.store(*number);
            self.lanes.each(|k| values.as_ref().get(k).copied().unwrap_or_default())
        });
        let words = (self.shade)(&values);
        let words = lanes.each(|k| words.as_ref().get(k).copied().unwrap_or_default());
        (lanes.load_words(&words), mask)
    }
}

/// A stage for one sample in fixed point.
#[derive(Clone, Copy)]
pub(super) struct ErasedFixed<'a>(&'a dyn Fn([Q16; 8]) -> u32);

/// Calls `then` with `stage` in fixed point, behind a pointer.
pub(super) fn erase_fixed(
    stage: impl FragmentStage<Carried, Color = Rgba8>,
    then: &mut dyn FnMut(ErasedFixed<'_>),
) {
    let shade = |[p, q, r, x, y, z, u, v]: [Q16; 8]| {
        let (word, _) =
            stage.shade_lanes(OneFixed, &([p, q, r], ([x, y, z], [u, v])), &steady(OneFixed), true);
        word.0
    };
    then(ErasedFixed(&shade));
}

impl FragmentStage<Carried> for ErasedFixed<'_> {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, carried: Carried) -> Option<Rgba8> {
        let (word, _) = self.shade_lanes(One, &components(carried), &steady(One), true);
        Some(Rgba8::from_bits(word.0))
    }

    #[inline(always)]
    fn shade_lanes<M: Lanes>(
        &self,
        lanes: M,
        ([p, q, r], ([x, y, z], [u, v])): &Numbers<M>,
        _: &Gradient<Numbers<M>>,
        mask: M::Mask,
    ) -> (M::U32, M::Mask) {
        // In units of 2^-16, which is what numbers in fixed point are.
        let bits = [p, q, r, x, y, z, u, v].map(|number| lanes.store_words(lanes.floor_scaled(*number, 16)));
        let words = lanes.each(|k| {
            let at = |words: &M::Each<u32>| words.as_ref().get(k).copied().unwrap_or_default();
            (self.0)(bits.each_ref().map(|words| Q16::from_bits(at(words).cast_signed())))
        });
        (lanes.load_words(&words), mask)
    }
}

/// What is carried, as numbers.
type Numbers<L> = ([<L as Lanes>::Number; 3], ([<L as Lanes>::Number; 3], [<L as Lanes>::Number; 2]));

/// What does not change between pixels.
fn steady<L: Lanes>(lanes: L) -> Gradient<Numbers<L>> {
    let zero = lanes.splat(0.0);
    let zeros = ([zero; 3], ([zero; 3], [zero; 2]));
    Gradient { dx: zeros, dy: zeros }
}

fn components((Homogeneous { u, v, q }, (first, uv)): Carried) -> Numbers<One> {
    ([u, v, q], (first.to_array(), uv.to_array()))
}

/// A surface, without an image on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bare<F>(pub(super) F);

impl<F: FragmentStage<Looks, Color = Rgba8>> FragmentStage<Carried> for Bare<F> {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, (_, looks): Carried) -> Option<Rgba8> {
        self.0.shade(looks)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        (_, looks): &Numbers<L>,
        gradient: &Gradient<Numbers<L>>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        self.0.shade_lanes(lanes, looks, &gradient.map(|(_, looks)| looks), mask)
    }
}

/// A stage with an image on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thrown<F, I>(pub(super) Slide<F, I>);

impl<F, Fl> FragmentStage<Carried> for Thrown<F, Sampler<'_, Rgba8, Fl, Clamp>>
where
    F: FragmentStage<Carried, Color = Rgba8>,
    Fl: Filter,
{
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, carried: Carried) -> Option<Rgba8> {
        self.0.shade((carried.0, carried))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        carried: &Numbers<L>,
        gradient: &Gradient<Numbers<L>>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        self.0.shade_lanes(lanes, &(carried.0, *carried), &gradient.map(|carried| (carried.0, carried)), mask)
    }
}

/// A surface that takes the first of what is carried.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfFirst<F>(pub(super) F);

impl<F: FragmentStage<Vec3, Color = Rgba8>> FragmentStage<Looks> for OfFirst<F> {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, (first, _): Looks) -> Option<Rgba8> {
        self.0.shade(first)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        (first, _): &([L::Number; 3], [L::Number; 2]),
        gradient: &Gradient<([L::Number; 3], [L::Number; 2])>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        self.0.shade_lanes(lanes, first, &gradient.map(|(first, _)| first), mask)
    }
}

/// A stage that takes the texture coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfUv<F>(pub(super) F);

impl<F: FragmentStage<Vec2, Color = Rgba8>> FragmentStage<Looks> for OfUv<F> {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, (_, uv): Looks) -> Option<Rgba8> {
        self.0.shade(uv)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        (_, uv): &([L::Number; 3], [L::Number; 2]),
        gradient: &Gradient<([L::Number; 3], [L::Number; 2])>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        self.0.shade_lanes(lanes, uv, &gradient.map(|(_, uv)| uv), mask)
    }
}

/// A bit for each lane.
fn all<L: Lanes>() -> u32 {
    (1 << L::COUNT) - 1
}
