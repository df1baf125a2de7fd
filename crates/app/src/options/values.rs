//! The kinds of values that options have: each reads a word of the command line and a value of a scene file, and says
//! what it expects.

use std::fmt;
use std::marker::PhantomData;
use std::num::NonZero;
use std::str::FromStr;

use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::de::{Deserialize, Deserializer, Error, Expected, SeqAccess, Unexpected, Visitor};

use crate::error::quote;
use crate::scene::normals::{narrow, sub};

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: u32 = 16384;

/// The greatest exponent of a highlight: that of the library, 2^16.
pub const MAX_SHININESS: f32 = 65536.0;

/// A range of numbers.
pub trait Kind {
    /// One of them, with its article.
    const ONE: &'static str;
    /// Several of them.
    const MANY: &'static str;
    /// Whether one number may stand for all.
    const ONE_FOR_ALL: bool = false;
    /// Whether it is one of them. Only finite numbers are asked about.
    fn contains(x: f32) -> bool;
}

macro_rules! kinds {
    ($($(#[$doc:meta])* $Name:ident, $one:literal, $many:literal, $contains:expr $(, $one_for_all:literal)?;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $Name;

        impl Kind for $Name {
            const ONE: &'static str = $one;
            const MANY: &'static str = $many;
            $(const ONE_FOR_ALL: bool = $one_for_all;)?

            fn contains(x: f32) -> bool {
                let contains: fn(f32) -> bool = $contains;
                contains(x)
            }
        })*
    };
}

kinds! {
    /// Any number.
    Finite, "a finite number", "finite numbers", |_| true;
    /// An angle above a plane.
    Elevation, "an angle from -90 to 90 degrees", "angles from -90 to 90 degrees", |x| x.abs() <= 90.0;
    /// A factor of sizes.
    Zoom, "a number from 0.01 to 100", "numbers from 0.01 to 100", |x| (0.01..=100.0).contains(&x);
    /// A share.
    Share, "a number from 0 to 1", "numbers from 0 to 1", |x| (0.0..=1.0).contains(&x);
    /// The steepness of normals.
    Strength, "a number from 0 to 100", "numbers from 0 to 100", |x| (0.0..=100.0).contains(&x);
    /// A factor of light.
    Intensity, "a number from 0 to 1000000", "numbers from 0 to 1000000", |x| (0.0..=1e6).contains(&x);
    /// A length, in units of the world.
    Length, "a number from 1e-6 to 1e6", "numbers from 1e-6 to 1e6", |x| (1e-6..=1e6).contains(&x);
    /// Repeats of a texture.
    Repeats, "a number from 1e-6 to 1e6", "numbers from 1e-6 to 1e6", |x| (1e-6..=1e6).contains(&x), true;
    /// A scale, negative to mirror.
    Scale, "a number, not 0, from -1e6 to 1e6", "numbers, not 0, from -1e6 to 1e6", |x| {
        (1e-6..=1e6).contains(&x.abs())
    }, true;
    /// A coordinate, in units of the world.
    Place, "a number from -1e9 to 1e9", "numbers from -1e9 to 1e9", |x| x.abs() <= 1e9;
    /// Half of an opening angle, in degrees.
    HalfAngle, "an angle above 0 and up to 90 degrees", "angles above 0 and up to 90 degrees", |x| {
        x > 0.0 && x <= 90.0
    }, true;
    /// An exponent of highlights.
    Exponent, "a number from 0 to 65536", "numbers from 0 to 65536", |x| (0.0..=MAX_SHININESS).contains(&x), true;
    /// The side of a picture or of a grid.
    Side, "a whole number from 1 to 16384", "whole numbers from 1 to 16384", |x| {
        x.fract().abs() <= 0.0 && (1.0..=16384.0).contains(&x)
    };
}

/// `N` numbers of a kind: `X,Y,Z` on the command line, `[x, y, z]` in a scene file. They are finite as f32 too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuple<const N: usize, K>([f64; N], PhantomData<K>);

/// A single number of a kind.
pub type Number<K> = Tuple<1, K>;

/// A point or a direction: right-handed, y up.
pub type Point = Tuple<3, Finite>;

impl<const N: usize, K> From<[f32; N]> for Tuple<N, K> {
    fn from(numbers: [f32; N]) -> Self {
        Self(numbers.map(f64::from), PhantomData)
    }
}

impl<K> From<f32> for Number<K> {
    fn from(number: f32) -> Self {
        [number].into()
    }
}

impl<const N: usize, K> From<Tuple<N, K>> for [f32; N] {
    fn from(tuple: Tuple<N, K>) -> Self {
        tuple.0.map(narrow)
    }
}

impl<const N: usize, K> From<Tuple<N, K>> for [f64; N] {
    fn from(tuple: Tuple<N, K>) -> Self {
        tuple.0
    }
}

impl<K> From<Number<K>> for f32 {
    fn from(Tuple([number], _): Number<K>) -> Self {
        narrow(number)
    }
}

impl Point {
    /// The point, counted from `origin`.
    #[must_use]
    pub(crate) fn counted_from(self, origin: [f64; 3]) -> Self {
        Self(sub(self.0, origin), PhantomData)
    }
}

impl Tuple<2, Side> {
    /// The sides as whole numbers.
    #[must_use]
    pub fn whole(self) -> [u32; 2] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
        self.0.map(|side| side as u32)
    }
}

impl<const N: usize, K: Kind> Tuple<N, K> {
    fn of(numbers: &[f64]) -> Option<Self> {
        let numbers = match numbers {
            [one] if K::ONE_FOR_ALL => [*one; N],
            many => many.try_into().ok()?,
        };
        let all = numbers.iter().map(|&x| narrow(x)).all(|x| x.is_finite() && K::contains(x));
        all.then_some(Self(numbers, PhantomData))
    }
}

impl<const N: usize, K: Kind> FromStr for Tuple<N, K> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
        numbers.and_then(|numbers| Self::of(&numbers)).ok_or_else(|| match N {
            1 => K::ONE.to_owned(),
            2 => format!("two {} LO,HI without spaces, such as -0.05,0", K::MANY),
            _ => format!("three {} X,Y,Z without spaces, such as 0,1.5,-3", K::MANY),
        })
    }
}

impl<'de, const N: usize, K: Kind> Deserialize<'de> for Tuple<N, K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Components(PhantomData))
    }
}

struct Components<const N: usize, K>(PhantomData<K>);

impl<'de, const N: usize, K: Kind> Visitor<'de> for Components<N, K> {
    type Value = Tuple<N, K>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let several = if N == 2 { "two" } else { "three" };
        match N {
            1 => f.write_str(K::ONE),
            _ if K::ONE_FOR_ALL => write!(f, "{}, or {several} in brackets", K::ONE),
            _ => write!(f, "{several} {} in brackets", K::MANY),
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "it becomes an f64 anyway")]
    fn visit_i64<E: Error>(self, x: i64) -> Result<Self::Value, E> {
        self.visit_f64(x as f64)
    }

    fn visit_f64<E: Error>(self, x: f64) -> Result<Self::Value, E> {
        Tuple::of(&[x]).ok_or_else(|| E::custom(format_args!("{x}, expected {}", &self as &dyn Expected)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        if N == 1 {
            return Err(A::Error::invalid_type(Unexpected::Seq, &self));
        }
        let mut numbers = Vec::new();
        while let Some(Tuple([x], _)) = seq.next_element::<Number<K>>()? {
            numbers.push(x);
        }
        let wrong = |found| {
            let noun = if found == 1 { "number" } else { "numbers" };
            A::Error::custom(format_args!("{found} {noun} in brackets, expected {}", &self as &dyn Expected))
        };
        numbers
            .as_slice()
            .try_into()
            .map(|numbers: [f64; N]| Tuple(numbers, PhantomData))
            .map_err(|_| wrong(numbers.len()))
    }
}

/// The exponents of highlights: a least and a greatest, which is that of surfaces without a map of them. Of a single
/// one the least is 1, or less if it is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(try_from = "Tuple<2, Exponent>")]
pub struct Shininess(pub [f32; 2]);

impl Shininess {
    const EXPECTED: &'static str = "a number from 0 to 65536, or a least and a greatest";
}

impl TryFrom<Tuple<2, Exponent>> for Shininess {
    type Error = String;

    fn try_from(pair: Tuple<2, Exponent>) -> Result<Self, String> {
        let pair @ [least, greatest]: [f32; 2] = pair.into();
        let pair = if least == greatest { [least.min(1.0), greatest] } else { pair };
        let ordered = (least <= greatest).then_some(Self(pair));
        ordered.ok_or_else(|| format!("{least} and {greatest}, expected {}", Self::EXPECTED))
    }
}

impl FromStr for Shininess {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let pair = text.parse::<Tuple<2, Exponent>>().and_then(Self::try_from);
        pair.map_err(|_| format!("{}, without spaces, such as 8,64", Self::EXPECTED))
    }
}

/// A number of threads, 1 to [`MAX_THREADS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Threads(pub NonZero<usize>);

/// The most threads that draw a picture.
pub const MAX_THREADS: usize = 256;

impl FromStr for Threads {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = text.parse::<NonZero<usize>>().ok().filter(|number| number.get() <= MAX_THREADS);
        number.map(Self).ok_or_else(|| format!("a whole number from 1 to {MAX_THREADS}"))
    }
}

/// The width and height of a picture in pixels, each 1 to [`MAX_SIDE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(from = "Tuple<2, Side>")]
pub struct Size(pub u32, pub u32);

impl From<Tuple<2, Side>> for Size {
    fn from(sides: Tuple<2, Side>) -> Self {
        let [width, height] = sides.whole();
        Self(width, height)
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
        let sides = text.split_once(['x', 'X', '×']);
        sides
            .and_then(|(width, height)| Some(Self(side(width)?, side(height)?)))
            .ok_or_else(|| format!("WIDTHxHEIGHT with 1 to {MAX_SIDE} pixels each, such as 640x480"))
    }
}

/// A colour: sRGB, each channel 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color(pub [f32; 3]);

impl Color {
    /// The values.
    pub(crate) const EXPECTED: &'static str =
        "hexadecimal digits RRGGBB or RGB, or a name of CSS such as teal";

    /// The channels from 0 to 255.
    #[must_use]
    pub fn bytes(self) -> [u8; 3] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
        self.0.map(|share| (share * 255.0).round() as u8)
    }
}

impl From<[u8; 3]> for Color {
    fn from(bytes: [u8; 3]) -> Self {
        Self(bytes.map(|byte| f32::from(byte) / 255.0))
    }
}

impl FromStr for Color {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(rgb) = super::colors::named(text) {
            return Ok(rgb.into());
        }
        let digits = text.strip_prefix('#').or(text.strip_prefix("0x")).unwrap_or(text);
        let value = u32::from_str_radix(digits, 16).ok();
        // from_str_radix takes a sign as well.
        let value = value.filter(|_| digits.bytes().all(|b| b.is_ascii_hexdigit()));
        match (value.map(u32::to_be_bytes), digits.len()) {
            (Some([_, r, g, b]), 6) => Ok([r, g, b].into()),
            (Some([.., high, low]), 3) => Ok([high & 15, low >> 4, low & 15].map(|digit| 17 * digit).into()),
            _ => Err(format!("{}{}", Self::EXPECTED, super::colors::meant(text))),
        }
    }
}

/// A value in a scene file that is written as on the command line.
pub(crate) fn word<'de, T, D: Deserializer<'de>>(
    deserializer: D,
    parse: impl Fn(&str) -> Result<T, String>,
) -> Result<T, D::Error> {
    deserializer.deserialize_any(Text(PhantomData, parse))
}

/// A reader of text, which says what text is expected where there is something else.
struct Text<T, P>(PhantomData<T>, P);

impl<T, P: Fn(&str) -> Result<T, String>> Visitor<'_> for Text<T, P> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Nothing is no value of any kind.
        match (self.1)("") {
            Err(expected) => write!(f, "text in quotes: {expected}"),
            Ok(_) => f.write_str("text in quotes"),
        }
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        let refused = |expected| E::custom(format_args!("{}, expected {expected}", quote(text.as_bytes())));
        (self.1)(text).map_err(refused)
    }

    /// A number is as good without quotes.
    fn visit_i64<E: Error>(self, number: i64) -> Result<T, E> {
        (self.1)(&number.to_string()).map_err(|_| E::invalid_type(Unexpected::Signed(number), &self))
    }
}

/// The choice of that name.
pub(crate) fn one_of<T: ValueEnum>(text: &str) -> Result<T, String> {
    T::from_str(text, true).map_err(|_| {
        let values = T::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let names: Vec<_> = values.map(|value| value.get_name().to_owned()).collect();
        format!("one of {}", names.join(", "))
    })
}

/// The option's word for a value.
pub(crate) fn name_of(value: impl ValueEnum) -> String {
    value.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// `true` or `false` on the command line, as words whose case may be ignored.
pub(crate) fn truth() -> impl TypedValueParser<Value = bool> {
    PossibleValuesParser::new(["true", "false"]).map(|word| word.eq_ignore_ascii_case("true"))
}

/// Types that scene files write as the command line does, read by one function.
macro_rules! words {
    ($parse:path: $($T:ty),*) => {
        $(impl<'de> serde::Deserialize<'de> for $T {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::options::values::word(deserializer, $parse)
            }
        })*
    };
}

pub(crate) use words;

words!(str::parse: Color);

#[cfg(test)]
mod tests {
    use super::*;

    fn read<T: FromStr<Err = String>>(text: &str) -> Result<T, String> {
        text.parse()
    }

    #[test]
    fn values_are_read() {
        assert_eq!(read("640x480"), Ok(Size(640, 480)));
        assert_eq!(read("16384X1"), Ok(Size(16384, 1)));
        assert_eq!(read("-1,2.5,3e2"), Ok(Point::from([-1.0, 2.5, 300.0])));
        assert_eq!(read("20242c").map(Color::bytes), Ok([0x20, 0x24, 0x2c]));
        assert_eq!(read("#FFffFF"), Ok(Color([1.0; 3])));
        assert_eq!(read("#2aC").map(Color::bytes), Ok([0x22, 0xaa, 0xcc]));
        assert_eq!(read("0x20242c").map(Color::bytes), Ok([0x20, 0x24, 0x2c]));
        assert_eq!(read("-0.5,1"), Ok(Tuple::<2, Finite>::from([-0.5, 1.0])));
        assert_eq!(read("8"), Ok(Shininess([1.0, 8.0])));
        assert_eq!(read("8,64"), Ok(Shininess([8.0, 64.0])));
        assert_eq!(read("65536"), Ok(Shininess([1.0, 65536.0])));
        assert_eq!(read("0.5"), Ok(Shininess([0.5; 2])));
        assert!((0..=255).all(|byte| Color::from([byte; 3]).bytes() == [byte; 3]));
    }

    #[test]
    fn what_is_no_value_is_refused() {
        for text in ["", "640", "0x480", "640x0", "100000x100000", "16385x1", "-1x5", "axb", "1x2x3"] {
            assert!(read::<Size>(text).is_err(), "{text}");
        }
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "inf,0,0", "1e400,0,0"] {
            assert!(read::<Point>(text).is_err(), "{text}");
        }
        for text in ["", "ffff", "gggggg", "+12345", "-12345", "+12", "1234567", "#0xfff", "ééé"] {
            assert!(read::<Color>(text).is_err(), "{text}");
        }
        for text in ["", "1", "1,2,3", "nan,1", "1, "] {
            assert!(read::<Tuple<2, Finite>>(text).is_err(), "{text}");
        }
        for text in ["", "-1", "9,8", "1,2,3", "65537"] {
            assert!(read::<Shininess>(text).is_err(), "{text}");
        }
        let (share, strength) = (read::<Number<Share>>, read::<Number<Strength>>);
        assert!(share("1.5").is_err() && share("-0.1").is_err() && strength("101").is_err());
        assert!(read::<Number<Finite>>("nan").is_err() && read::<Number<Finite>>("1e400").is_err());
    }
}
