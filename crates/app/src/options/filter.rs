//! How textures are read.

use std::fmt;
use std::str::FromStr;

/// How a texture is read between its texels, and where it is smaller on the screen than in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The texel that contains the point.
    Nearest,
    /// A weighted mean of the four texels around the point.
    #[default]
    Bilinear,
    /// The same in the two nearest levels of a mip map, and a mean of both: no shimmer in the distance, but blurred
    /// where the surface is seen at a flat angle.
    Trilinear,
    /// As many of those along the direction in which the texture is squeezed most: sharp at flat angles too.
    Anisotropic(Probes),
}

impl FromStr for Filter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let probes = Probes::ALL.map(Self::Anisotropic);
        let mut all = [Self::Nearest, Self::Bilinear, Self::Trilinear].into_iter().chain(probes);
        all.find(|filter| filter.to_string() == text)
            .ok_or_else(|| "nearest, bilinear, trilinear or anisotropic:N with N = 2, 4, 8 or 16".to_owned())
    }
}

super::values::words!(str::parse: Filter);

impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nearest => f.write_str("nearest"),
            Self::Bilinear => f.write_str("bilinear"),
            Self::Trilinear => f.write_str("trilinear"),
            Self::Anisotropic(probes) => write!(f, "anisotropic:{}", probes.count()),
        }
    }
}

/// The most places at which an anisotropic filter reads a texture for one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Probes {
    /// 2.
    Two,
    /// 4.
    Four,
    /// 8.
    Eight,
    /// 16.
    Sixteen,
}

impl Probes {
    const ALL: [Self; 4] = [Self::Two, Self::Four, Self::Eight, Self::Sixteen];

    /// How many.
    #[must_use]
    pub fn count(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Eight => 8,
            Self::Sixteen => 16,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_have_names() {
        assert_eq!("nearest".parse(), Ok(Filter::Nearest));
        assert_eq!("trilinear".parse(), Ok(Filter::Trilinear));
        assert_eq!("anisotropic:16".parse(), Ok(Filter::Anisotropic(Probes::Sixteen)));
        for text in ["", "cubic", "anisotropic", "anisotropic:", "anisotropic:3", "anisotropic:02", "Nearest"]
        {
            assert!(text.parse::<Filter>().is_err(), "{text}");
        }
    }
}
