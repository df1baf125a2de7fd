//! Samples a pixel.

use clap::ValueEnum;

use super::MAX_SIDE;
use crate::error::Error;

/// Samples a pixel, on an ordered grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, serde::Deserialize)]
#[serde(try_from = "u32")]
pub enum Samples {
    /// One in its middle.
    #[value(name = "1")]
    One,
    /// 2 x 2.
    #[value(name = "4")]
    Four,
    /// 4 x 4.
    #[value(name = "16")]
    Sixteen,
}

impl Samples {
    /// Columns, and rows, of samples in a pixel.
    #[must_use]
    pub fn side(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 2,
            Self::Sixteen => 4,
        }
    }

    /// # Errors
    /// A picture of that size would have too many.
    pub(crate) fn check(self, width: u32, height: u32) -> Result<(), Error> {
        let most = MAX_SIDE / self.side();
        if width.max(height) <= most {
            return Ok(());
        }
        let found = format!("{} a pixel of {width}x{height}", self.side() * self.side());
        let error = Error::new(found, format!("pictures of at most {most}x{most}"));
        Err(error.place("--samples").hint("choose fewer samples, or a smaller --size"))
    }

    /// Four, where the picture is not too large for them.
    #[must_use]
    pub fn usual(width: u32, height: u32) -> Self {
        if Self::Four.check(width, height).is_ok() { Self::Four } else { Self::One }
    }
}

impl TryFrom<u32> for Samples {
    type Error = String;

    fn try_from(count: u32) -> Result<Self, String> {
        let all = [Self::One, Self::Four, Self::Sixteen];
        let found = all.into_iter().find(|samples| samples.side() * samples.side() == count);
        found.ok_or_else(|| format!("{count}, expected 1, 4 or 16"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_have_a_square() {
        for (count, side) in [(1, 1), (4, 2), (16, 4)] {
            assert_eq!(Samples::try_from(count).map(Samples::side), Ok(side));
        }
        assert!(Samples::try_from(2).is_err());
        assert_eq!([8192, 8193].map(|side| Samples::usual(side, 1)), [Samples::Four, Samples::One]);
        let message = Samples::Sixteen.check(4097, 9).unwrap_err().to_string();
        assert!(message.starts_with("--samples: found 16 a pixel of 4097x9, expected"), "{message}");
    }
}
