//! Built-in fragment stages. Those from [`Tinted`] on wrap another, so that a scene pays for what it uses.
//!
//! | stage | varying | colour |
//! |---|---|---|
//! | [`Solid`] | any | one for all |
//! | [`VertexColor`] | `Vec3` | the varying, red, green, blue in [0, 1] |
//! | [`VertexColor565`] | [`Ready565`] | the same in 16 bits |
//! | [`Unlit`] | `Vec2` | a [`Map`]'s, a texture's for one, at the varying |
//! | [`Stored`] | `Vec2` | the same, in the texture's own format |
//! | [`StoredAlpha`] | `Vec2` | texels with alpha, ready for [`Over`](alberti_raster::color::Over) on RGB565 |
//! | [`TexelDither`] | `Vec2` | the same, a texel of those that a filter would mix |
//! | [`Tinted`] | the wrapped stage's | the wrapped stage's times a colour |
//! | [`Sunlit`] | `(Vec3, V)`: a normal and the wrapped stage's | the wrapped stage's, lit |
//! | [`Lit565`] | `(Light, V)`: a [`Light`] and the wrapped stage's | the wrapped stage's in 16 bits, lit |
//! | [`AlphaTest`], [`ColorKey`], [`AlphaDither`] | the wrapped stage's | the wrapped stage's, with holes |
//! | [`Fogged`](fog::Fogged) | `(f32, V)`: a fog's coordinate and the wrapped stage's | the wrapped stage's, fading |
//! | [`Slide`] | `(Homogeneous, V)`: a place on an image and the wrapped stage's | the wrapped stage's, the image on it |
//!
//! [`material`] has stages that are composed of maps and lights, [`wide`] the arithmetic for stages of yours.
//!
//! All arithmetic is on sRGB bytes, as they are stored.

/// Items of a wrapping stage that are those of the stage `S` in its field `surface`: all but how it shades. The part of
/// derivatives that this stage has is named.
macro_rules! as_surface {
    ($varying:ty, |$gradient:ident| $part:expr) => {
        type Color = S::Color;
        type Derivatives = S::Derivatives;
        const WIDE: bool = S::WIDE;
        const SETTLES: bool = S::SETTLES;

        #[inline(always)]
        fn settled<L: Lanes>(
            &self,
            lanes: L,
            $gradient: &Gradient<<$varying as Varying>::Of<L::Number>>,
        ) -> Self {
            Self { surface: self.surface.settled(lanes, $part), ..*self }
        }

        const BY_ROWS: bool = S::BY_ROWS;

        #[inline(always)]
        fn in_row(&self, row: i32) -> Self {
            Self { surface: self.surface.in_row(row), ..*self }
        }

        #[inline(always)]
        fn derivatives(&self) -> S::Derivatives {
            self.surface.derivatives()
        }
    };
}

mod color;
mod cutout;
pub mod fog;
mod lit;
mod map;
pub mod material;
mod slide;
mod stored_alpha;
mod sunlit;
#[macro_use]
mod texture;
mod texel_dither;
mod tinted;
pub mod wide;

pub use color::{Ready565, Solid, VertexColor, VertexColor565};
pub use cutout::{AlphaDither, AlphaTest, ColorKey};
pub use lit::{Light, Lit565};
pub use map::{Called, Map, Times};
pub use slide::{Mix, Slide};
pub use stored_alpha::StoredAlpha;
pub use sunlit::{Sunlit, face_normal};
pub use texel_dither::TexelDither;
pub use texture::{Differentiated, Stored, Unlit};
pub use tinted::Tinted;

#[cfg(test)]
mod tests {
    use super::fog::{Fogged, LinearFog};
    use super::{Differentiated, Solid, Tinted};
    use alberti_math::Rgba8;
    use alberti_raster::{AnyDerivatives, FragmentStage};

    #[test]
    fn a_wrapped_stage_says_how_it_is_differentiated() {
        for policy in [AnyDerivatives::PerPixel, AnyDerivatives::PerRun, AnyDerivatives::PerTriangle] {
            let surface = Differentiated::by(policy, Solid(Rgba8::WHITE));
            let surface = Tinted { surface, tint: Rgba8::WHITE };
            assert_eq!(FragmentStage::<()>::derivatives(&surface), policy);
            let fog = LinearFog { start: 1.0, end: 2.0 };
            let fogged = Fogged { surface, fog, color: Rgba8::BLACK };
            assert_eq!(FragmentStage::<(f32, ())>::derivatives(&fogged), policy);
        }
    }
}
