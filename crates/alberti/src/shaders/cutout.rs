//! Holes: fragments of another stage that its alpha leaves out.

use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Varying};
use alberti_raster::color::Pattern;
use alberti_raster::{FragmentStage, Fragments, Gradient};

/// The alpha test: of another stage's fragments, those with an alpha of at least so much, as they are. For leaves and
/// fences, in any order and with a depth buffer.
///
/// # Cost
/// A shift and a comparison.
#[derive(Clone, Copy, Debug)]
pub struct AlphaTest<S> {
    /// The stage.
    pub surface: S,
    /// The least alpha that is drawn; 0 draws all.
    pub least: u8,
}

/// Screen-door transparency: of another stage's fragments, a part as large as their alpha, by a pattern of pixels.
/// Glass in any order, with a depth buffer and without blending; seen from near it is a grid.
///
/// # Precision
/// Of an alpha a, so many of the thresholds of the pattern are below it, which are (k + ½)/64 or (k + ½)/1024. None at
/// 0, all at 255.
///
/// # Cost
/// A load from the pattern's table, a shift and a comparison.
#[derive(Clone, Copy, Debug)]
pub struct AlphaDither<S, P> {
    /// The stage.
    pub surface: S,
    /// The pattern: [`Bayer`](alberti_raster::color::Bayer) or [`BlueNoise`](alberti_raster::color::BlueNoise).
    pub by: P,
}

/// A wrapping stage whose fragments are kept where `kept` says.
macro_rules! keeps {
    ($(<$($generic:ident: $bound:path),*> $name:ty: |$self:ident, $fragments:ident, $alpha:ident| $kept:expr;)*) => {$(
        impl<V: Varying, S: FragmentStage<V, Color = Rgba8> $(, $generic: $bound)*> FragmentStage<V> for $name {
            as_surface!(V, |gradient| gradient);

            #[inline(always)]
            fn shade<L: Lanes>(&$self, $fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
                let (colors, mask) = $self.surface.shade($fragments);
                let $alpha = $fragments.lanes.shr(colors, 24);
                (colors, mask & $kept)
            }
        }
    )*};
}
keeps! {
    <> AlphaTest<S>: |self, fragments, alpha| {
        let lanes = fragments.lanes;
        !lanes.less_words(alpha, lanes.word(self.least.into()))
    };
    <P: Pattern> AlphaDither<S, P>: |self, fragments, alpha| {
        let (lanes, [column, row]) = (fragments.lanes, fragments.place);
        let columns = lanes.each(|k| {
            let column = column.wrapping_add(i32::try_from(k).unwrap_or(0));
            self.by.threshold([column, row])
        });
        lanes.less_words(lanes.load_words(&columns), alpha)
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;
    use alberti_math::Gradient;
    use alberti_math::lanes::One;
    use alberti_raster::color::{Bayer, BlueNoise};

    #[test]
    fn an_alpha_test_keeps_what_is_as_opaque() {
        for (alpha, least, kept) in
            [(128, 128, true), (127, 128, false), (0, 0, true), (255, 255, true), (254, 255, false)]
        {
            let color = Rgba8::new(1, 2, 3, alpha);
            let found = AlphaTest { surface: Solid(color), least }.shade_one(());
            assert_eq!(found, kept.then_some(color), "{alpha} {least}");
        }
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
