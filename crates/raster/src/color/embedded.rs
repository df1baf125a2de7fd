//! Formats whose pixels are colours of embedded-graphics.

use super::{
    Blend, Blended, ColorFormat, Dithered, Grey1, Grey2, Grey4, Grey8, Levels, Pattern, ReadColor, Rgb666,
    Rgb888, Xrgb8888,
};
use alberti_math::{Rgb565Be, Rgb565Le, Rgba8888};
use embedded_graphics::pixelcolor::raw::{BigEndian, ByteOrder, LittleEndian, RawData};
use embedded_graphics::pixelcolor::{self as embedded, BinaryColor, GrayColor, PixelColor, RgbColor};

/// A format whose pixels are colours of embedded-graphics, without loss. Behind the feature `embedded-graphics`.
///
/// | formats | colour |
/// |---|---|
/// | [`Rgb565Be`], [`Rgb565Le`] | `Rgb565` |
/// | [`Rgb888`], [`Rgba8888`], [`Xrgb8888`] | `Rgb888`; alpha is 255 where there is one |
/// | [`Rgb666`] | `Rgb666` |
/// | [`Grey8`], [`Grey4`], [`Grey2`], [`Grey1`] | `Gray8`, `Gray4`, `Gray2`, `BinaryColor` |
/// | [`Dithered`], [`Blended`] | that of their format: what embedded-graphics draws is stored as it is |
pub trait EmbeddedColor: ColorFormat {
    /// The colour in embedded-graphics.
    type Color: PixelColor;

    /// The colour of a pixel.
    fn to_embedded(self, pixel: Self::Pixel) -> Self::Color;

    /// The pixel of a colour.
    fn of_embedded(self, color: Self::Color) -> Self::Pixel;
}

/// A format whose pixels lie in memory as those of an `ImageRaw`: [`Rgb565Be`], [`Rgb565Le`], [`Rgb888`] and [`Grey8`],
/// also [`Dithered`] or [`Blended`].
///
/// Greys of less than a byte do so after they are [packed](super::pack): `ImageRaw::new(pack::grey4(..), width)`.
pub trait EmbeddedBytes: EmbeddedColor<Color: From<<Self::Color as PixelColor>::Raw>> {
    /// The order of a pixel's bytes.
    type Order: ByteOrder;
}

macro_rules! embedded {
    ($($name:ident: $color:ty, $to:expr, $of:expr;)*) => {$(
        impl EmbeddedColor for $name {
            type Color = $color;

            #[inline]
            fn to_embedded(self, pixel: Self::Pixel) -> $color {
                $to(pixel)
            }

            #[inline]
            fn of_embedded(self, color: $color) -> Self::Pixel {
                $of(color)
            }
        }
    )*};
}
embedded! {
    Rgb565Le: embedded::Rgb565, |pixel| of_word(u16::from_le(pixel)), |color| word(color).to_le();
    Rgb565Be: embedded::Rgb565, |pixel| of_word(u16::from_be(pixel)), |color| word(color).to_be();
    Rgb888: embedded::Rgb888, of_channels, channels;
    Rgba8888: embedded::Rgb888,
        |pixel: u32| { let [r, g, b, _] = pixel.to_ne_bytes(); of_channels([r, g, b]) },
        |color| { let [r, g, b] = channels(color); u32::from_ne_bytes([r, g, b, 255]) };
    Xrgb8888: embedded::Rgb888,
        |pixel: u32| { let [b, g, r, _] = pixel.to_ne_bytes(); of_channels([r, g, b]) },
        |color| { let [r, g, b] = channels(color); u32::from_ne_bytes([b, g, r, 0]) };
    Rgb666: embedded::Rgb666,
        |pixel: [u8; 3]| { let [r, g, b] = pixel.map(|byte| byte >> 2); embedded::Rgb666::new(r, g, b) },
        |color: embedded::Rgb666| [color.r(), color.g(), color.b()].map(|level| level << 2);
    Grey8: embedded::Gray8, embedded::Gray8::new, |color: embedded::Gray8| color.luma();
    Grey4: embedded::Gray4, embedded::Gray4::new, |color: embedded::Gray4| color.luma();
    Grey2: embedded::Gray2, embedded::Gray2::new, |color: embedded::Gray2| color.luma();
    Grey1: BinaryColor, |pixel: u8| BinaryColor::from(pixel != 0), |color: BinaryColor| color.is_on().into();
}

/// Formats around a format, whose pixels are those of this one.
macro_rules! around {
    ($($name:ident<C: $format:ident, W: $way:ident>;)*) => {$(
        impl<C: $format + EmbeddedColor, W: $way> EmbeddedColor for $name<C, W> {
            type Color = C::Color;

            #[inline]
            fn to_embedded(self, pixel: C::Pixel) -> C::Color {
                self.format.to_embedded(pixel)
            }

            #[inline]
            fn of_embedded(self, color: C::Color) -> C::Pixel {
                self.format.of_embedded(color)
            }
        }

        impl<C: $format + EmbeddedBytes, W: $way> EmbeddedBytes for $name<C, W> {
            type Order = C::Order;
        }
    )*};
}
around! {
    Dithered<C: Levels, W: Pattern>;
    Blended<C: ReadColor, W: Blend>;
}

impl EmbeddedBytes for Rgb565Le {
    type Order = LittleEndian;
}
impl EmbeddedBytes for Rgb565Be {
    type Order = BigEndian;
}
impl EmbeddedBytes for Rgb888 {
    type Order = BigEndian;
}
impl EmbeddedBytes for Grey8 {
    type Order = BigEndian;
}

fn of_word(word: u16) -> embedded::Rgb565 {
    <embedded::Rgb565 as PixelColor>::Raw::new(word).into()
}

fn word(color: embedded::Rgb565) -> u16 {
    <embedded::Rgb565 as PixelColor>::Raw::from(color).into_inner()
}

fn of_channels([r, g, b]: [u8; 3]) -> embedded::Rgb888 {
    embedded::Rgb888::new(r, g, b)
}

fn channels(color: embedded::Rgb888) -> [u8; 3] {
    [color.r(), color.g(), color.b()]
}
