//! A limit of error, as users write it: a number and its unit.

use std::fmt;
use std::str::FromStr;

use super::Measures;
use crate::error::quote;

/// A limit of error. The unit says which measure has to keep it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaxError {
    /// `2lsb`: the 99.9 % percentile of the pixels' differences, in steps of a byte, at most.
    ///
    /// Not the largest: where an edge passes a sample on its other side, a pixel shows something else altogether,
    /// however accurate both pictures are. One pixel in a thousand is left to edges; outliers are counted beside it.
    Lsb(f64),
    /// `0.01flip`: the mean FLIP over the picture, at most.
    Flip(f64),
    /// `40db`: the peak signal-to-noise ratio in dB, at least.
    Db(f64),
    /// `0.5texel`: the 99.9 % percentile of how far texture coordinates are off, in texels, at most. No two pictures
    /// have it: it takes the scene.
    Texel(f64),
}

impl MaxError {
    /// Whether this figure, in the unit of the limit, keeps it. NaN keeps none.
    #[must_use]
    pub fn admits(self, figure: f64) -> bool {
        match self {
            Self::Lsb(most) | Self::Flip(most) | Self::Texel(most) => figure <= most,
            Self::Db(least) => figure >= least,
        }
    }

    /// The measure that has to keep the limit; none for texels.
    #[must_use]
    pub fn figure(self, measures: &Measures) -> Option<f64> {
        match self {
            Self::Lsb(_) => Some(f64::from(measures.most)),
            Self::Flip(_) => Some(measures.flip),
            Self::Db(_) => Some(measures.psnr()),
            Self::Texel(_) => None,
        }
    }

    /// The measure and the limit that it exceeds, if it does, as a clause. Texels are not asked about.
    #[must_use]
    pub fn excess(self, measures: &Measures) -> Option<String> {
        let figure = self.figure(measures).filter(|&figure| !self.admits(figure))?;
        Some(match self {
            Self::Lsb(_) | Self::Texel(_) => {
                format!("the 99.9 % percentile is {figure} {}, above {self}", self.unit())
            }
            Self::Flip(_) => format!("the mean FLIP is {figure:.6}, above {self}"),
            Self::Db(_) => format!("the PSNR is {figure:.3} dB, below {self}"),
        })
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Lsb(_) => "lsb",
            Self::Flip(_) => "flip",
            Self::Db(_) => "db",
            Self::Texel(_) => "texel",
        }
    }

    fn limit(self) -> f64 {
        let (Self::Lsb(limit) | Self::Flip(limit) | Self::Db(limit) | Self::Texel(limit)) = self;
        limit
    }
}

impl fmt::Display for MaxError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.limit(), self.unit())
    }
}

impl FromStr for MaxError {
    /// The expectation that the text does not meet.
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = text.trim_end().trim_end_matches(|c: char| c.is_alphabetic());
        let word = text[number.len()..].trim();
        let (unit, greatest): (fn(f64) -> Self, f64) = match word.to_ascii_lowercase().as_str() {
            "lsb" => (Self::Lsb, 255.0),
            "flip" => (Self::Flip, 1.0),
            "db" => (Self::Db, f64::MAX),
            "texel" => (Self::Texel, f64::MAX),
            "" => return Err(format!("a number with its unit, {EXAMPLES}")),
            _ => {
                let word = quote(word.as_bytes());
                return Err(format!(
                    "one of the units lsb, flip, db and texel instead of {word}, {EXAMPLES}"
                ));
            }
        };
        let number = number.trim();
        let Ok(limit) = number.parse() else {
            return Err(format!(
                "a number before the unit instead of {}, {EXAMPLES}",
                quote(number.as_bytes())
            ));
        };
        let range =
            if greatest < f64::MAX { format!("from 0 to {greatest}") } else { "of at least 0".to_owned() };
        if !(0.0..=greatest).contains(&limit) {
            return Err(format!("a number {range} before {word}"));
        }
        Ok(unit(limit))
    }
}

const EXAMPLES: &str = "as in 2lsb, 0.01flip or 40db";

#[cfg(test)]
mod tests {
    use super::*;

    const MEASURES: Measures = Measures {
        size: [10, 10],
        largest: 200,
        largest_at: Some([3, 4]),
        most: 3,
        outliers: 1,
        // 255² / 100, which is 20 dB.
        mse: 650.25,
        flip: 0.25,
    };

    #[test]
    fn a_limit_is_a_number_and_a_unit() {
        for (text, expected) in [
            ("2lsb", MaxError::Lsb(2.0)),
            ("0LSB", MaxError::Lsb(0.0)),
            (" 2.5 lsb ", MaxError::Lsb(2.5)),
            ("0.01flip", MaxError::Flip(0.01)),
            ("1e-2flip", MaxError::Flip(0.01)),
            ("40dB", MaxError::Db(40.0)),
            (".5texel", MaxError::Texel(0.5)),
        ] {
            assert_eq!(text.parse(), Ok(expected), "{text}");
            assert_eq!(expected.to_string().parse(), Ok(expected));
        }
    }

    #[test]
    fn what_is_no_limit_is_told_what_is_wrong_with_it() {
        for (text, part) in [
            ("2", "a number with its unit, as in 2lsb"),
            ("", "a number with its unit"),
            ("2furlong", "instead of \"furlong\""),
            ("2lsbs", "instead of \"lsbs\""),
            ("lsb", "a number before the unit instead of \"\""),
            ("twoélsb", "one of the units lsb, flip, db and texel instead of \"twoélsb\""),
            ("1,5lsb", "a number before the unit instead of \"1,5\""),
            ("-1lsb", "a number from 0 to 255 before lsb"),
            ("256lsb", "a number from 0 to 255 before lsb"),
            ("1.01flip", "a number from 0 to 1 before flip"),
            ("1e400db", "a number of at least 0 before db"),
            ("-1texel", "a number of at least 0 before texel"),
            ("nanlsb", "one of the units"),
            ("nan lsb", "a number from 0 to 255 before lsb"),
        ] {
            let message = text.parse::<MaxError>().unwrap_err();
            assert!(message.contains(part), "{text}: {message}");
        }
    }

    #[test]
    fn each_unit_has_its_measure() {
        let excess = |limit: MaxError| limit.excess(&MEASURES);
        assert_eq!(excess(MaxError::Lsb(3.0)), None);
        assert_eq!(excess(MaxError::Lsb(2.0)).unwrap(), "the 99.9 % percentile is 3 lsb, above 2lsb");
        assert_eq!(excess(MaxError::Flip(0.25)), None);
        assert_eq!(excess(MaxError::Flip(0.2)).unwrap(), "the mean FLIP is 0.250000, above 0.2flip");
        assert_eq!(excess(MaxError::Db(20.0)), None);
        assert_eq!(excess(MaxError::Db(21.0)).unwrap(), "the PSNR is 20.000 dB, below 21db");
        assert_eq!(excess(MaxError::Texel(0.0)), None);
        assert_eq!(MaxError::Texel(0.5).figure(&MEASURES), None);
        assert_eq!([0.5, 0.75, f64::NAN].map(|x| MaxError::Texel(0.5).admits(x)), [true, false, false]);
        let equal = Measures { mse: 0.0, ..MEASURES };
        assert!(MaxError::Db(f64::MAX).excess(&equal).is_none());
    }
}
