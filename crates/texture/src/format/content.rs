//! The content of texels: colours, numbers or directions.

use alberti_math::Rgba8;

use super::TexelFormat;
use crate::mipmap::Weights;

/// The meaning of a format's texels, and so of their mean: the texels of smaller levels of a mip map, which
/// [`build`](crate::mipmap::build) makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Content {
    /// Colours in sRGB, whose mean is that of their light; alpha is linear. Colours are not weighted by alpha.
    ///
    /// # Precision
    /// A channel of 8 bits is within 0.55 of the mean in real numbers: 0.5 of the last rounding, and 0.05 of light in
    /// 16 bits. The mean of the bytes themselves would be off by up to 73.3.
    #[default]
    Srgb,
    /// Numbers, heights or masks for example, whose mean is that of their values.
    ///
    /// # Precision
    /// Correctly rounded, halves up: to 8 bits, and [`L16`](super::L16) to 16.
    Scalars,
    /// Directions: red, green and blue are x, y and z from -1 to 1 as 2c/255 - 1. The mean of the vectors is made a
    /// unit vector again; where they cancel out it is (0, 0, 1). Alpha is linear.
    ///
    /// # Precision
    /// A component is within 0.501 steps of the exact unit vector.
    Normals,
}

/// The format `F` for numbers, [`Content::Scalars`]. It is stored and sampled as `F` is.
///
/// ```
/// use alberti_texture::format::{L8, Scalars};
/// use alberti_texture::{Mipmap, mipmap};
///
/// let mut heights = [0, 255, 255, 0, 0];
/// mipmap::build(Scalars(L8), &mut heights, 2, 2)?;
/// assert_eq!(Mipmap::new(Scalars(L8), &heights, 2, 2)?.level(1).texels(), [128]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Scalars<F>(
    /// The format.
    pub F,
);

/// The format `F` for directions, [`Content::Normals`], as of normal maps. It is stored and sampled as `F` is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Normals<F>(
    /// The format.
    pub F,
);

/// The same texels with another content.
macro_rules! stands_for {
    ($($wrapper:ident)*) => {$(
        impl<F: TexelFormat> TexelFormat for $wrapper<F> {
            type Texel = F::Texel;

            #[inline]
            fn content(self) -> Content {
                Content::$wrapper
            }

            #[inline]
            fn decode(self, texel: F::Texel) -> Rgba8 {
                self.0.decode(texel)
            }

            #[inline]
            fn scalar(self, texel: F::Texel) -> u16 {
                self.0.scalar(texel)
            }

            #[inline]
            fn encode(self, color: Rgba8) -> F::Texel {
                self.0.encode(color)
            }

            #[inline]
            fn addends(self, content: Content, texel: F::Texel) -> [u16; 4] {
                self.0.addends(content, texel)
            }

            #[inline]
            fn mean(self, content: Content, sums: [u64; 4], weights: Weights) -> F::Texel {
                self.0.mean(content, sums, weights)
            }
        }
    )*};
}

stands_for! { Scalars Normals }

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::{L8, L16, Rgb565, Rgba4444, Rgba8888};

    /// Every texel of 16 bits.
    #[test]
    fn wrappers_store_the_same() {
        fn check<F: TexelFormat<Texel = u16>, G: TexelFormat<Texel = u16>>(
            format: F,
            wrapped: G,
            texel: u16,
        ) {
            let color = format.decode(texel);
            assert_eq!((wrapped.decode(texel), wrapped.scalar(texel)), (color, format.scalar(texel)));
            assert_eq!(wrapped.encode(color), format.encode(color));
        }
        for texel in 0..=u16::MAX {
            check(Rgb565, Scalars(Rgb565), texel);
            check(Rgba4444, Normals(Rgba4444), texel);
            assert_eq!(Scalars(L16).scalar(texel), texel);
        }
    }

    #[test]
    fn formats_say_the_content() {
        let found =
            [L8.content(), Rgba8888.content(), L16.content(), Scalars(L8).content(), Normals(L8).content()];
        let (linear, srgb) = (Content::Scalars, Content::Srgb);
        assert_eq!(found, [srgb, srgb, linear, linear, Content::Normals]);
    }
}
