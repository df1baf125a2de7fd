//! Holes: fragments of another stage that its alpha, or a colour, leaves out.

use alberti_math::Varying;
use alberti_math::lanes::Lanes;
use alberti_raster::color::Pattern;
use alberti_raster::{FragmentColor, FragmentStage, Fragments, Gradient};

/// The alpha test: of another stage's fragments, those with an alpha of at least so much, as they are. For leaves and
/// fences, in any order and with a depth buffer. Colours are [`Rgba8`](alberti_math::Rgba8), or the four bytes of such
/// texels; words without alpha do not compile, and have [`ColorKey`].
///
/// # Precision
/// Exact.
///
/// # Cost
/// A shift and a comparison. A textured pixel in fixed point takes 37 instructions on a Cortex-M4F where 41 % are
/// drawn, and 50 without the test; on a Cortex-M0+ 73 and 89.
#[derive(Clone, Copy, Debug)]
pub struct AlphaTest<S> {
    /// The stage.
    pub surface: S,
    /// The least alpha that is drawn; 0 draws all.
    pub least: u8,
}

/// A colour key: of another stage's fragments, those of any other colour, as they are. It cuts holes into textures
/// without alpha, such as RGB565 or indices into a palette, as the target [stores](super::Stored) them.
///
/// ```
/// use alberti::FragmentStage;
/// use alberti::glam::Vec2;
/// use alberti::shaders::{ColorKey, Stored};
/// use alberti::texture::{Nearest, Repeat, Texture, format::Rgb565};
///
/// let texture = Texture::new(Rgb565, &[0xf81f, 0x07e0], 2, 1)?;
/// let stage = ColorKey { surface: Stored(texture.sampler(Nearest, Repeat)), key: 0xf81f };
/// assert_eq!(stage.shade_one(Vec2::new(0.25, 0.5)), None);
/// assert_eq!(stage.shade_one(Vec2::new(0.75, 0.5)), Some(0x07e0));
/// # Ok::<(), alberti::texture::TextureError>(())
/// ```
///
/// Filters that mix texels mix the key into their neighbours. [`Nearest`](alberti_texture::Nearest) and
/// [`TexelDither`](super::TexelDither) mix none. Stages that change colours, as [`Lit565`](super::Lit565) or
/// [`Fogged`](super::fog::Fogged), belong around it.
///
/// # Precision
/// Exact: all bits of the word are compared, alpha among them.
///
/// # Cost
/// A comparison: 3 instructions more a pixel on a Cortex-M4F and on a Cortex-M0+.
#[derive(Clone, Copy, Debug)]
pub struct ColorKey<S, C> {
    /// The stage.
    pub surface: S,
    /// The colour that is not drawn.
    pub key: C,
}

/// Screen-door transparency: of another stage's fragments, a part as large as their alpha, by a pattern of pixels.
/// Glass in any order, with a depth buffer and without blending; seen from near it is a grid.
///
/// # Precision
/// Of an alpha a, so many of the thresholds of the pattern are below it, which are (k + ½)/64 or (k + ½)/1024. None at
/// 0, all at 255.
///
/// # Cost
/// A load from the pattern's table, a shift and a comparison. A textured pixel in fixed point takes 45 instructions on
/// a Cortex-M4F where 37 % are drawn, and 50 without the pattern; on a Cortex-M0+ 82 and 89.
#[derive(Clone, Copy, Debug)]
pub struct AlphaDither<S, P> {
    /// The stage.
    pub surface: S,
    /// The pattern: [`Bayer`](alberti_raster::color::Bayer) or [`BlueNoise`](alberti_raster::color::BlueNoise).
    pub by: P,
}

/// The alpha of colours that have one.
#[inline(always)]
fn alpha<L: Lanes, C: FragmentColor>(lanes: L, colors: L::U32) -> L::U32 {
    const { assert!(C::IS_COLOR, "the stage's colours have no alpha: ColorKey leaves out one of them") };
    lanes.shr(colors, 24)
}

/// A wrapping stage whose fragments are kept where `kept` says.
macro_rules! keeps {
    ($(<$($generic:ident: $bound:path),*> $name:ty: |$self:ident, $fragments:ident, $colors:ident| $kept:expr;)*) => {$(
        impl<V: Varying, C: FragmentColor, S: FragmentStage<V, Color = C> $(, $generic: $bound)*> FragmentStage<V>
            for $name
        {
            as_surface!(V, |gradient| gradient);

            #[inline(always)]
            fn shade<L: Lanes>(&$self, $fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
                let ($colors, mask) = $self.surface.shade($fragments);
                ($colors, mask & $kept)
            }
        }
    )*};
}
keeps! {
    <> AlphaTest<S>: |self, fragments, colors| {
        let lanes = fragments.lanes;
        !lanes.less_words(alpha::<L, C>(lanes, colors), lanes.word(self.least.into()))
    };
    <> ColorKey<S, C>: |self, fragments, colors| {
        let lanes = fragments.lanes;
        !lanes.equal_words(colors, lanes.word(self.key.to_word()))
    };
    <P: Pattern> AlphaDither<S, P>: |self, fragments, colors| {
        let lanes = fragments.lanes;
        lanes.less_words(self.by.thresholds(lanes, fragments.place), alpha::<L, C>(lanes, colors))
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;
    use alberti_math::lanes::One;
    use alberti_math::{Gradient, Rgba8};
    use alberti_raster::color::{Bayer, BlueNoise};

    #[test]
    fn an_alpha_test_keeps_what_is_as_opaque() {
        for (alpha, least, kept) in
            [(128, 128, true), (127, 128, false), (0, 0, true), (255, 255, true), (254, 255, false)]
        {
            let color = Rgba8::new(1, 2, 3, alpha);
            let found = AlphaTest { surface: Solid(color), least }.shade_one(());
            assert_eq!(found, kept.then_some(color), "{alpha} {least}");
            let texel = Solid(color.to_bytes());
            assert_eq!(AlphaTest { surface: texel, least }.shade_one(()), kept.then_some(color.to_bytes()));
        }
    }

    #[test]
    fn a_key_leaves_out_one_colour() {
        fn keyed<C: FragmentColor>(color: C, key: C) -> bool {
            ColorKey { surface: Solid(color), key }.shade_one(()).is_none()
        }
        for bit in 0..16 {
            assert!(keyed(0xa5c3_u16, 0xa5c3) && !keyed(0xa5c3_u16, 0xa5c3 ^ 1 << bit));
            assert!(
                keyed([0xc3, 0xa5], [0xc3, 0xa5])
                    && !keyed([0xc3, 0xa5], (0xa5c3_u16 ^ 1 << bit).to_le_bytes())
            );
        }
        assert!(keyed(7_u8, 7) && !keyed(7_u8, 6));
        let [clear, opaque] = [0, 255].map(|alpha| Rgba8::new(1, 2, 3, alpha));
        assert!(keyed(clear, clear) && !keyed(clear, opaque));
    }

    fn drawn(by: impl Pattern, alpha: u8, side: i32) -> u32 {
        let stage = AlphaDither { surface: Solid(Rgba8::new(9, 9, 9, alpha)), by };
        let places = (0..side).flat_map(|y| (0..side).map(move |x| [x, y]));
        places
            .map(|place| {
                let gradient = Gradient { dx: (), dy: () };
                let fragments = Fragments::<One, ()> { lanes: One, varying: (), gradient, mask: true, place };
                u32::from(stage.shade(&fragments).1)
            })
            .sum()
    }

    #[test]
    fn alpha_is_the_part_of_the_pixels_that_are_drawn() {
        for alpha in 0..=255_u8 {
            for (found, count) in [(drawn(Bayer, alpha, 8), 64.0), (drawn(BlueNoise, alpha, 32), 1024.0)] {
                let part = f64::from(found) / count;
                let off = (part - f64::from(alpha) / 255.0).abs();
                assert!(off <= 0.5 / count + 1.0 / 255.0, "{alpha}: {part}");
                assert!((alpha > 0 || found == 0) && (alpha < 255 || part == 1.0));
            }
        }
    }
}
