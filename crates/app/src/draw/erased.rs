//! Fragment stages behind a pointer, so that a kernel is compiled once for all of them. The pixels are the stage's own.
//!
//! What such a stage is handed is one of two bundles, [`Carried`]; what it does not use of it is computed nevertheless,
//! but for derivatives, of which there are only those of the texture coordinates. No stage discards.

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Floating, Lanes, One, OneFixed};
use alberti::raster::{Differentiation, Gradient, NoDerivatives, PerPixel};
use alberti::shaders::Slide;
use alberti::shaders::material::Framed;
use alberti::texture::{Clamp, Filter, Sampler};
use alberti::{FragmentStage, Homogeneous, Q16, Rgba8, Varying};

/// What a vertex carries to such a stage: a place on a projector's image, and [`Looks`] or [`Framed`].
pub(super) type Carried<V> = (Homogeneous, V);

/// What a plain surface needs: a normal or a colour, and texture coordinates.
pub(super) type Looks = (Vec3, Vec2);

/// A bundle of which stages behind a pointer may have the derivatives of two components.
pub(super) trait Differentiable: Varying + 'static {
    /// How they are found.
    type Derivatives: Differentiation;

    /// The two.
    fn uv<N: Copy>(bundle: &mut Self::Of<N>) -> &mut [N; 2];
}

impl Differentiable for Looks {
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn uv<N: Copy>((_, uv): &mut ([N; 3], [N; 2])) -> &mut [N; 2] {
        uv
    }
}

impl Differentiable for Framed {
    type Derivatives = PerPixel;

    #[inline(always)]
    fn uv<N: Copy>((_, _, uv): &mut Self::Of<N>) -> &mut [N; 2] {
        uv
    }
}

/// A bundle whose other components do not change from pixel to pixel.
#[inline(always)]
fn with_uv<V: Differentiable, N: Copy, L: Lanes<Number = N>>(
    lanes: L,
    like: &<Carried<V> as Varying>::Of<N>,
    uv: [N; 2],
) -> <Carried<V> as Varying>::Of<N> {
    let mut bundle = Carried::<V>::map(like, &|_| lanes.splat(0.0));
    *V::uv(&mut bundle.1) = uv;
    bundle
}

/// What is handed over, in memory: the bundle, and the derivatives of u and v by column and row.
type Handed<V, N> = (<Carried<V> as Varying>::Of<N>, Gradient<[N; 2]>);

/// A stage for so many samples at a time as there are lanes of floats: their numbers in memory, colours back.
///
/// # Cost
/// For the lanes together, a call and a copy each way.
#[derive(Clone, Copy)]
pub(super) struct Erased<'a, L: Lanes + 'a, V: Differentiable> {
    lanes: L,
    shade: &'a Shade<'a, L, V>,
}

type Shade<'a, L, V> = dyn Fn(&Handed<V, <L as Lanes>::Each<f32>>) -> <L as Lanes>::Each<u32> + 'a;

/// Calls `then` with `stage`, behind a pointer.
pub(super) fn erase<L: Floating, V: Differentiable>(
    lanes: L,
    stage: impl FragmentStage<Carried<V>, Color = Rgba8>,
    then: &mut dyn FnMut(Erased<'_, L, V>),
) {
    let shade = |(values, gradient): &Handed<V, L::Each<f32>>| {
        lanes.vectorize(
            #[inline(always)]
            || {
                let carried = Carried::<V>::map(values, &|each: L::Each<f32>| lanes.load(&each));
                let gradient = gradient
                    .map(|[u, v]| with_uv::<V, _, L>(lanes, &carried, [lanes.load(&u), lanes.load(&v)]));
                let (words, _) = stage.shade_lanes(lanes, &carried, &gradient, lanes.mask(all::<L>()));
                lanes.store_words(words)
            },
        )
    };
    then(Erased { lanes, shade: &shade });
}

impl<L: Lanes, V: Differentiable> FragmentStage<Carried<V>> for Erased<'_, L, V> {
    type Color = Rgba8;
    type Derivatives = V::Derivatives;

    #[inline(always)]
    fn shade(&self, carried: Carried<V>) -> Option<Rgba8> {
        Some(alone(self, carried))
    }

    /// `M` is `L` under another name, or fewer.
    #[inline(always)]
    fn shade_lanes<M: Lanes>(
        &self,
        lanes: M,
        carried: &<Carried<V> as Varying>::Of<M::Number>,
        gradient: &Gradient<<Carried<V> as Varying>::Of<M::Number>>,
        mask: M::Mask,
    ) -> (M::U32, M::Mask) {
        let each = |number: M::Number| {
            let values = lanes.store(number);
            self.lanes.each(|k| values.as_ref().get(k).copied().unwrap_or_default())
        };
        let gradient = gradient.map(|mut bundle| V::uv(&mut bundle.1).map(each));
        let words = (self.shade)(&(Carried::<V>::map(carried, &each), gradient));
        let words = lanes.each(|k| words.as_ref().get(k).copied().unwrap_or_default());
        (lanes.load_words(&words), mask)
    }
}

/// A stage for one sample in fixed point.
#[derive(Clone, Copy)]
pub(super) struct ErasedFixed<'a, V: Differentiable>(&'a dyn Fn(&Handed<V, Q16>) -> u32);

/// Calls `then` with `stage` in fixed point, behind a pointer.
pub(super) fn erase_fixed<V: Differentiable>(
    stage: impl FragmentStage<Carried<V>, Color = Rgba8>,
    then: &mut dyn FnMut(ErasedFixed<'_, V>),
) {
    let shade = |(carried, gradient): &Handed<V, Q16>| {
        let gradient = gradient.map(|uv| with_uv::<V, _, OneFixed>(OneFixed, carried, uv));
        let (word, _) = stage.shade_lanes(OneFixed, carried, &gradient, true);
        word.0
    };
    then(ErasedFixed(&shade));
}

impl<V: Differentiable> FragmentStage<Carried<V>> for ErasedFixed<'_, V> {
    type Color = Rgba8;
    type Derivatives = V::Derivatives;

    #[inline(always)]
    fn shade(&self, carried: Carried<V>) -> Option<Rgba8> {
        Some(alone(self, carried))
    }

    #[inline(always)]
    fn shade_lanes<M: Lanes>(
        &self,
        lanes: M,
        carried: &<Carried<V> as Varying>::Of<M::Number>,
        gradient: &Gradient<<Carried<V> as Varying>::Of<M::Number>>,
        mask: M::Mask,
    ) -> (M::U32, M::Mask) {
        // In units of 2^-16, which is what numbers in fixed point are.
        let bits = |number: M::Number| lanes.store_words(lanes.floor_scaled(number, 16));
        let carried = Carried::<V>::map(carried, &bits);
        let gradient = gradient.map(|mut bundle| V::uv(&mut bundle.1).map(bits));
        let words = lanes.each(|k| {
            let at = |words: M::Each<u32>| {
                Q16::from_bits(words.as_ref().get(k).copied().unwrap_or_default().cast_signed())
            };
            (self.0)(&(Carried::<V>::map(&carried, &at), gradient.map(|uv| uv.map(at))))
        });
        (lanes.load_words(&words), mask)
    }
}

/// One sample's colour, by way of the code for several.
#[inline(always)]
fn alone<V: Differentiable>(
    stage: &impl FragmentStage<Carried<V>, Color = Rgba8>,
    carried: Carried<V>,
) -> Rgba8 {
    let carried = Carried::<V>::map(&Carried::<V>::gather([carried]), &|[x]: [f32; 1]| x);
    let steady = with_uv::<V, _, One>(One, &carried, [0.0; 2]);
    let (word, _) = stage.shade_lanes(One, &carried, &Gradient { dx: steady, dy: steady }, true);
    Rgba8::from_bits(word.0)
}

/// Stages that hand on a part of what they get, for which there is a place.
macro_rules! hand_on {
    ($([$($generics:tt)*] $stage:ty: $from:ty => |$bundle:ident| $part:expr;)+) => {$(
        impl<$($generics)*> FragmentStage<$from> for $stage {
            type Color = Rgba8;
            type Derivatives = NoDerivatives;

            #[inline(always)]
            fn shade(&self, $bundle: $from) -> Option<Rgba8> {
                self.0.shade($part)
            }

            #[inline(always)]
            fn shade_lanes<L: Lanes>(
                &self,
                lanes: L,
                $bundle: &<$from as Varying>::Of<L::Number>,
                gradient: &Gradient<<$from as Varying>::Of<L::Number>>,
                mask: L::Mask,
            ) -> (L::U32, L::Mask) {
                let $bundle = *$bundle;
                self.0.shade_lanes(lanes, &$part, &gradient.map(|$bundle| $part), mask)
            }
        }
    )+};
}

/// A surface, without an image on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bare<F>(pub(super) F);

/// A stage with an image on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thrown<F, I>(pub(super) Slide<F, I>);

/// A surface that takes the first of what is carried.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfFirst<F>(pub(super) F);

/// A stage that takes the texture coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfUv<F>(pub(super) F);

hand_on! {
    [V: Varying, F: FragmentStage<V, Color = Rgba8>] Bare<F>: Carried<V> => |carried| carried.1;
    [V: Varying, F: FragmentStage<Carried<V>, Color = Rgba8>, Fl: Filter]
        Thrown<F, Sampler<'_, Rgba8, Fl, Clamp>>: Carried<V> => |carried| (carried.0, carried);
    [F: FragmentStage<Vec3, Color = Rgba8>] OfFirst<F>: Looks => |looks| looks.0;
    [F: FragmentStage<Vec2, Color = Rgba8>] OfUv<F>: Looks => |looks| looks.1;
}

/// A bit for each lane.
fn all<L: Lanes>() -> u32 {
    (1 << L::COUNT) - 1
}
