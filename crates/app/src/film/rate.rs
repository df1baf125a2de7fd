//! Frames a second.

use std::fmt;
use std::str::FromStr;

/// So many frames in so many seconds, without a common factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    pub(crate) frames: u16,
    pub(crate) seconds: u16,
}

impl Rate {
    /// The most frames a second, of which some formats count hundredths.
    const FASTEST: u16 = 100;

    /// Broadcasting's rates: 1000/1001 of whole ones.
    const BROADCAST: [(&str, u16); 4] = [("23.976", 24), ("23.98", 24), ("29.97", 30), ("59.94", 60)];

    /// The rate at which so many frames take so many seconds, to a hundredth.
    pub(crate) fn of(frames: u32, seconds: f64) -> Self {
        let rate = (f64::from(frames) / seconds).clamp(0.01, f64::from(Self::FASTEST));
        let hundredth = format!("{rate:.2}").parse();
        hundredth.unwrap_or(Self { frames: Self::FASTEST, seconds: 1 })
    }

    /// The time at which a frame begins, in seconds.
    pub(crate) fn time(self, frame: u32) -> f64 {
        f64::from(frame) * f64::from(self.seconds) / f64::from(self.frames)
    }

    /// The same in parts of a second: rounded from the beginning, so that no error grows.
    pub(crate) fn parts(self, frame: u32, parts: u64) -> u32 {
        let (frames, seconds) = (u64::from(self.frames.max(1)), u64::from(self.seconds));
        u32::try_from((u64::from(frame) * parts * seconds + frames / 2) / frames).unwrap_or(u32::MAX)
    }

    /// The frames that begin in so many seconds, one at least.
    pub(crate) fn lasting(self, seconds: f64, most: u32) -> u32 {
        let frames = seconds * f64::from(self.frames) / f64::from(self.seconds.max(1));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within these limits")]
        let frames = frames.round().clamp(1.0, f64::from(most)) as u32;
        frames
    }

    /// Whether there are more than so many a second.
    pub(crate) fn is_above(self, most: u16) -> bool {
        u32::from(self.frames) > u32::from(most) * u32::from(self.seconds)
    }
}

impl FromStr for Rate {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((_, whole)) = Self::BROADCAST.iter().find(|(name, _)| *name == text) {
            return Ok(Self { frames: whole * 1000, seconds: 1001 });
        }
        let hundredths = text.parse::<f64>().ok().map(|rate| (rate * 100.0, (rate * 100.0).round()));
        // The product is rounded: 1.1 times 100 is 110.00000000000001.
        let hundredths =
            hundredths.filter(|(of, whole)| (of - whole).abs() < 1e-9 && (1.0..=10_000.0).contains(whole));
        let expected = || format!("a number from 0.01 to {}, of at most two decimals", Self::FASTEST);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
        let frames = hundredths.ok_or_else(expected)?.1 as u16;
        let common = |mut a: u16, mut b: u16| {
            while b != 0 {
                (a, b) = (b, a % b);
            }
            a
        };
        let by = common(frames, 100);
        Ok(Self { frames: frames / by, seconds: 100 / by })
    }
}

impl fmt::Display for Rate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match Self::BROADCAST.iter().find(|(_, whole)| (self.frames, self.seconds) == (whole * 1000, 1001)) {
            Some((name, _)) => f.write_str(name),
            None => write!(f, "{}", f64::from(self.frames) / f64::from(self.seconds)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_that_of_frames_in_a_time() {
        for (frames, seconds, rate) in [
            (8, 1.0, (8, 1)),
            (1, 3.0, (33, 100)),
            (25, 0.1, (100, 1)),
            (1, 1e9, (1, 100)),
            (90, 2.0, (45, 1)),
        ] {
            let found = Rate::of(frames, seconds);
            assert_eq!((found.frames, found.seconds), rate, "{frames} in {seconds} s");
        }
    }

    #[test]
    fn rates_are_fractions() {
        for (text, frames, seconds) in [
            ("30", 30, 1),
            ("12.5", 25, 2),
            ("29.97", 30_000, 1001),
            ("23.976", 24_000, 1001),
            ("0.01", 1, 100),
            ("100", 100, 1),
            ("33.33", 3333, 100),
            ("1.1", 11, 10),
            ("0.29", 29, 100),
        ] {
            let rate: Rate = text.parse().expect(text);
            assert_eq!((rate, rate.to_string()), (Rate { frames, seconds }, text.to_owned()));
        }
        for text in ["0", "101", "-3", "nan", "1e9", "29.971", "", "30/1"] {
            assert!(text.parse::<Rate>().is_err(), "{text}");
        }
    }

    #[test]
    fn times_are_those_of_the_fraction() {
        let rate: Rate = "29.97".parse().expect("a rate");
        // 30000 frames of it take 1001 seconds.
        assert_eq!(
            (rate.lasting(1001.0, 100_000), rate.lasting(0.0, 9), rate.lasting(9.0, 9)),
            (30_000, 1, 9)
        );
        assert!((rate.time(30_000) - 1001.0).abs() < 1e-9);
        assert_eq!((rate.parts(30_000, 1000), rate.parts(1, 100)), (1_001_000, 3));
        assert!(rate.is_above(29) && !rate.is_above(30));
    }
}
