//! The ways of a fragment's colour into a picture: a fog before it, its mixture with what is behind it, its rounding.

use std::fmt;
use std::str::FromStr;

use clap::ValueEnum;

use super::values::{one_of, words};
use alberti::lanes::Lanes;
use alberti::raster::color::{AnyBlend, Bayer, BlueNoise, Pattern};
use alberti::shaders::fog::{AnyFog, ExponentialFog, LinearFog, SquaredFog};

/// The rounding of colours between two that a format has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Dither {
    /// To the nearest.
    #[default]
    None,
    /// To either, by the ordered pattern of 8x8 pixels.
    Bayer,
    /// To either, by blue noise.
    BlueNoise,
}

/// To the nearest is to either by the same threshold everywhere.
impl Pattern for Dither {
    #[inline]
    fn threshold(self, place: [i32; 2]) -> u32 {
        match self {
            Self::None => 127,
            Self::Bayer => Bayer.threshold(place),
            Self::BlueNoise => BlueNoise.threshold(place),
        }
    }

    #[inline(always)]
    fn thresholds<L: Lanes>(self, lanes: L, place: [i32; 2]) -> L::U32 {
        match self {
            Self::None => lanes.word(127),
            Self::Bayer => Bayer.thresholds(lanes, place),
            Self::BlueNoise => BlueNoise.thresholds(lanes, place),
        }
    }
}

/// The law of a fog, by distances along the line of sight; `None` takes that of a scene file away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog(pub Option<AnyFog>);

impl Fog {
    const EXPECTED: &'static str =
        "none, linear:START,END with START below END, exp:DENSITY or exp2:DENSITY above 0";
}

impl FromStr for Fog {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        let number = |text: &str| text.parse().ok().filter(|x: &f32| x.is_finite());
        let density = |text: &str| number(text).filter(|&density| density > 0.0);
        if text == "none" {
            return Ok(Self(None));
        }
        let fog = match text.split_once(':') {
            Some(("linear", range)) => range.split_once(',').and_then(|(start, end)| {
                let (start, end) = (number(start)?, number(end)?);
                (start < end).then_some(AnyFog::Linear(LinearFog { start, end }))
            }),
            Some(("exp", text)) => {
                density(text).map(|density| AnyFog::Exponential(ExponentialFog { density }))
            }
            Some(("exp2", text)) => density(text).map(|density| AnyFog::Squared(SquaredFog { density })),
            _ => None,
        };
        fog.map(|fog| Self(Some(fog))).ok_or_else(|| format!("{}, such as linear:2,10", Self::EXPECTED))
    }
}

impl fmt::Display for Fog {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            None => f.write_str("none"),
            Some(AnyFog::Linear(LinearFog { start, end })) => write!(f, "linear:{start},{end}"),
            Some(AnyFog::Exponential(ExponentialFog { density })) => write!(f, "exp:{density}"),
            Some(AnyFog::Squared(SquaredFog { density })) => write!(f, "exp2:{density}"),
        }
    }
}

/// A fog and its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Haze {
    /// The law.
    pub fog: AnyFog,
    /// sRGB.
    pub color: [u8; 3],
}

/// The mixture of a surface with what is behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blend(pub AnyBlend);

impl FromStr for Blend {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        let share = |text: &str| text.parse().ok().filter(|x: &f32| (0.0..=1.0).contains(x));
        let blend = match (text, text.split_once(':')) {
            ("over", _) => Some(AnyBlend::Over),
            ("additive", _) => Some(AnyBlend::Additive),
            ("multiply", _) => Some(AnyBlend::Multiply),
            (_, Some(("constant", alpha))) => share(alpha).map(|alpha| AnyBlend::Constant(byte(alpha))),
            _ => None,
        };
        let expected = "over, additive, multiply or constant:ALPHA, ALPHA from 0 to 1, such as constant:0.5";
        blend.map(Self).ok_or_else(|| expected.to_owned())
    }
}

/// The nearest byte to a share.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
pub(crate) fn byte(share: f32) -> u8 {
    (share * 255.0).round() as u8
}

words!(one_of: Dither);
words!(str::parse: Fog, Blend);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fogs_and_blends_are_read() {
        let read = |text: &str| text.parse::<Fog>().map(|fog| fog.to_string());
        for text in ["none", "linear:2,10", "linear:-1.5,0.25", "exp:0.05", "exp2:3"] {
            assert_eq!(read(text).as_deref(), Ok(text));
        }
        for text in [
            "",
            "linear",
            "linear:2",
            "linear:3,3",
            "linear:4,3",
            "linear:nan,3",
            "exp:0",
            "exp:-1",
            "exp2:inf",
            "fog:1",
        ] {
            assert!(read(text).is_err_and(|expected| expected.contains("exp:DENSITY")), "{text}");
        }
        let read = |text: &str| text.parse::<Blend>().map(|blend| blend.0);
        assert_eq!(read("over"), Ok(AnyBlend::Over));
        assert_eq!(read("Over"), Ok(AnyBlend::Over));
        assert_eq!(read("constant:0.5"), Ok(AnyBlend::Constant(128)));
        assert_eq!(read("constant:1"), Ok(AnyBlend::Constant(255)));
        for text in
            ["", "constant", "constant:", "constant:1.5", "constant:-0.1", "constant:nan", "overs", "replace"]
        {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
