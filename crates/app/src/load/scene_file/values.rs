//! The kinds of values that a scene file has, each of which says what it expects.

use std::fmt;
use std::marker::PhantomData;

use clap::ValueEnum;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};

use super::tables::At;
use crate::cli::values::{MAX_SHININESS, SHININESS, is_shininess};
use crate::options::{Filter, Interpolation, MAX_SIDE, Wrap};

/// Numbers of a range.
pub(super) trait Range {
    /// One of them, with its article.
    const EXPECTED: &'static str;
    /// Several of them.
    const PLURAL: &'static str;
    fn contains(x: f64) -> bool;
}

macro_rules! ranges {
    ($($name:ident, $expected:literal, $plural:literal, $contains:expr;)*) => {
        $(#[derive(Clone, Copy, Debug)]
        pub(super) struct $name;

        impl Range for $name {
            const EXPECTED: &'static str = $expected;
            const PLURAL: &'static str = $plural;

            fn contains(x: f64) -> bool {
                // As an f32, in which it is stored.
                #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
                let x = x as f32;
                let contains: fn(f32) -> bool = $contains;
                x.is_finite() && contains(x)
            }
        })*
    };
}

ranges! {
    Finite, "a finite number", "finite numbers", |_| true;
    Share, "a number from 0 to 1", "numbers from 0 to 1", |x| (0.0..=1.0).contains(&x);
    Strength, "a number from 0 to 100", "numbers from 0 to 100", |x| (0.0..=100.0).contains(&x);
    Intensity, "a number from 0 to 1000000", "numbers from 0 to 1000000", |x| (0.0..=1e6).contains(&x);
    Length, "a number from 1e-6 to 1e6", "numbers from 1e-6 to 1e6", |x| (1e-6..=1e6).contains(&x);
    Factor, "a number, not 0, from -1e6 to 1e6", "numbers, not 0, from -1e6 to 1e6", |x| {
        (1e-6..=1e6).contains(&x.abs())
    };
    Place, "a number from -1e9 to 1e9", "numbers from -1e9 to 1e9", |x| x.abs() <= 1e9;
    HalfAngle, "an angle above 0 and up to 90 degrees", "angles above 0 and up to 90 degrees", |x| x > 0.0 && x <= 90.0;
    Exponent, "a number from 0 to 65536", "numbers from 0 to 65536", |x| (0.0..=MAX_SHININESS).contains(&x);
    Side, "a whole number from 1 to 16384", "whole numbers from 1 to 16384", |x| {
        #[expect(clippy::cast_precision_loss, reason = "2^14")]
        let most = MAX_SIDE as f32;
        x.fract().abs() <= 0.0 && (1.0..=most).contains(&x)
    };
}

/// A number within a range.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number<R>(pub(super) f32, PhantomData<R>);

impl<'de, R: Range> Deserialize<'de> for Number<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Seek<R>(PhantomData<R>);
        impl<R: Range> Visitor<'_> for Seek<R> {
            type Value = Number<R>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(R::EXPECTED)
            }

            #[expect(clippy::cast_precision_loss, reason = "it becomes an f32 anyway")]
            fn visit_i64<E: Error>(self, x: i64) -> Result<Self::Value, E> {
                self.visit_f64(x as f64)
            }

            fn visit_f64<E: Error>(self, x: f64) -> Result<Self::Value, E> {
                if R::contains(x) {
                    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
                    return Ok(Number(x as f32, PhantomData));
                }
                Err(E::custom(format_args!("{x}, expected {}", R::EXPECTED)))
            }
        }
        deserializer.deserialize_any(Seek(PhantomData))
    }
}

/// `N` numbers of a range.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers<const N: usize, R = Finite>(pub(super) [f32; N], PhantomData<R>);

/// How many, in words.
fn words(n: usize) -> &'static str {
    if n == 2 { "two" } else { "three" }
}

struct SeekMany<const N: usize, R> {
    /// Whether one number stands for all.
    or_one: bool,
    range: PhantomData<R>,
}

impl<'de, const N: usize, R: Range> Visitor<'de> for SeekMany<N, R> {
    type Value = Numbers<N, R>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.or_one {
            write!(f, "{}, or {} in brackets", R::EXPECTED, words(N))
        } else {
            write!(f, "{} {} in brackets", words(N), R::PLURAL)
        }
    }

    fn visit_i64<E: Error>(self, x: i64) -> Result<Self::Value, E> {
        #[expect(clippy::cast_precision_loss, reason = "it becomes an f32 anyway")]
        self.visit_f64(x as f64)
    }

    fn visit_f64<E: Error>(self, x: f64) -> Result<Self::Value, E> {
        if self.or_one && R::contains(x) {
            #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
            return Ok(Numbers([x as f32; N], PhantomData));
        }
        Err(E::custom(format_args!("{x}, expected {}", &self as &dyn serde::de::Expected)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut numbers = Vec::new();
        while let Some(Number(x, _)) = seq.next_element::<Number<R>>()? {
            numbers.push(x);
        }
        let found = numbers.len();
        let numbers = numbers.try_into().map_err(|_| {
            let expected = &self as &dyn serde::de::Expected;
            A::Error::custom(format_args!("{found} in brackets, expected {expected}"))
        })?;
        Ok(Numbers(numbers, PhantomData))
    }
}

impl<'de, const N: usize, R: Range> Deserialize<'de> for Numbers<N, R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SeekMany { or_one: false, range: PhantomData })
    }
}

/// `N` numbers, or one that stands for all.
#[derive(Clone, Copy, Debug)]
pub(super) struct OneOrMore<const N: usize, R>(pub(super) [f32; N], PhantomData<R>);

impl<'de, const N: usize, R: Range> Deserialize<'de> for OneOrMore<N, R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let seek = SeekMany { or_one: true, range: PhantomData::<R> };
        deserializer.deserialize_any(seek).map(|Numbers(numbers, _)| Self(numbers, PhantomData))
    }
}

/// The exponents of highlights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shininess(pub(super) [f32; 2]);

impl<'de> Deserialize<'de> for Shininess {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let OneOrMore(pair, _) = OneOrMore::<2, Exponent>::deserialize(deserializer)?;
        if is_shininess(&pair) {
            return Ok(Self(pair));
        }
        Err(D::Error::custom(format_args!("{} and {}, expected {SHININESS}", pair[0], pair[1])))
    }
}

/// A value that the command line writes as a word.
pub(super) trait Word: Sized {
    fn parse(text: &str) -> Result<Self, String>;
}

/// A string that stands for a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Text<T>(pub(super) T);

impl<'de, T: Word> Deserialize<'de> for Text<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let refused = |expected| {
            D::Error::custom(format_args!("{}, expected {expected}", crate::error::quote(text.as_bytes())))
        };
        T::parse(&text).map(Self).map_err(refused)
    }
}

impl Word for [u8; 3] {
    fn parse(text: &str) -> Result<Self, String> {
        crate::cli::values::color(text)
    }
}

impl Word for Filter {
    fn parse(text: &str) -> Result<Self, String> {
        Self::parse(text)
    }
}

impl Word for Interpolation {
    fn parse(text: &str) -> Result<Self, String> {
        Self::parse(text)
    }
}

/// One of the names that the command line has for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Named<T>(pub(super) T);

impl<T: ValueEnum> Word for Named<T> {
    fn parse(text: &str) -> Result<Self, String> {
        let names = T::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let names = || names.clone().map(|value| value.get_name().to_owned()).collect::<Vec<_>>().join(", ");
        T::from_str(text, false).map(Self).map_err(|_| format!("one of {}", names()))
    }
}

/// A map: the name of a file, or that and how it is read.
#[derive(Clone, Debug)]
pub(super) struct MapEntry {
    pub(super) file: String,
    pub(super) filter: At<Text<Filter>>,
    pub(super) wrap: At<Text<Named<Wrap>>>,
}

impl<'de> Deserialize<'de> for MapEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table {
            file: String,
            filter: At<Text<Filter>>,
            wrap: At<Text<Named<Wrap>>>,
        }
        struct Seek;
        impl<'de> Visitor<'de> for Seek {
            type Value = MapEntry;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "the name of a file, or { file = \"NAME\", filter = \"FILTER\", wrap = \"WRAP\" }",
                )
            }

            fn visit_str<E: Error>(self, file: &str) -> Result<MapEntry, E> {
                Ok(MapEntry { file: file.to_owned(), filter: None, wrap: None })
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MapEntry, A::Error> {
                let Table { file, filter, wrap } = Table::deserialize(MapAccessDeserializer::new(map))?;
                Ok(MapEntry { file, filter, wrap })
            }
        }
        deserializer.deserialize_any(Seek)
    }
}
