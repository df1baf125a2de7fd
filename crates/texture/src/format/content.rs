//! What colours stand for.

use core::marker::PhantomData;

use alberti_math::Rgba8;

use super::{Encode, TexelFormat};

/// What the texels of a format stand for, and so what their mean is: the texels of smaller levels of a mip map, which
/// [`build`](crate::mipmap::build) makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Content {
    /// Colours in sRGB, whose mean is that of their light; alpha is linear. Colours are not weighted by alpha.
    ///
    /// # Precision
    /// A channel of 8 bits is within 0.55 of the mean in real numbers: 0.5 of the last rounding, and 0.05 of light in
    /// 16 bits. The mean of the bytes themselves would be off by up to 70.
    #[default]
    Srgb,
    /// Numbers, heights or masks for example, whose mean is that of their values.
    ///
    /// # Precision
    /// Correctly rounded, halves up: to 8 bits, and [`L16`](super::L16) to 16.
    Linear,
    /// Directions: red, green and blue are x, y and z from -1 to 1 as 2c/255 - 1. The mean of the vectors is made a
    /// unit vector again; where they cancel out it is (0, 0, 1). Alpha is linear.
    ///
    /// # Precision
    /// A component is within 0.501 steps of the exact unit vector.
    Normals,
}

/// The format `F` for numbers, [`Content::Linear`]. It is stored and sampled as `F` is.
///
/// ```
/// use alberti_texture::format::{L8, Linear};
/// use alberti_texture::{Mipmap, mipmap};
///
/// let mut heights = [0, 255, 255, 0, 0];
/// mipmap::build::<Linear<L8>>(&mut heights, 2, 2)?;
/// assert_eq!(Mipmap::<Linear<L8>>::new(&heights, 2, 2)?.level(1).texels(), [128]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Linear<F>(PhantomData<F>);

/// The format `F` for directions, [`Content::Normals`]: what a normal map is. It is stored and sampled as `F` is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Normals<F>(PhantomData<F>);

/// The same texels with another content.
macro_rules! stands_for {
    ($($wrapper:ident)*) => {$(
        impl<F: TexelFormat> TexelFormat for $wrapper<F> {
            type Texel = F::Texel;
            const CONTENT: Content = Content::$wrapper;

            #[inline]
            fn decode(texel: F::Texel) -> Rgba8 {
                F::decode(texel)
            }

            #[inline]
            fn scalar(texel: F::Texel) -> u16 {
                F::scalar(texel)
            }
        }

        impl<F: Encode> Encode for $wrapper<F> {
            #[inline]
            fn encode(color: Rgba8) -> F::Texel {
                F::encode(color)
            }
        }
    )*};
}

stands_for! { Linear Normals }

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::{L8, L16, Rgb565, Rgba4444};

    /// Every texel of 16 bits.
    #[test]
    fn wrappers_store_the_same() {
        fn check<F: Encode<Texel = u16>, G: Encode<Texel = u16>>(texel: u16) {
            let color = F::decode(texel);
            assert_eq!((G::decode(texel), G::scalar(texel)), (color, F::scalar(texel)));
            assert_eq!(G::encode(color), F::encode(color));
        }
        for texel in 0..=u16::MAX {
            check::<Rgb565, Linear<Rgb565>>(texel);
            check::<Rgba4444, Normals<Rgba4444>>(texel);
            assert_eq!(Linear::<L16>::scalar(texel), texel);
        }
    }

    #[test]
    fn types_say_the_content() {
        let found =
            [L8::CONTENT, Rgba8::CONTENT, L16::CONTENT, Linear::<L8>::CONTENT, Normals::<L8>::CONTENT];
        let (linear, srgb) = (Content::Linear, Content::Srgb);
        assert_eq!(found, [srgb, srgb, linear, linear, Content::Normals]);
    }
}
