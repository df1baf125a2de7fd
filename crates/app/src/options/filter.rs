//! Filters of textures.

use std::fmt;
use std::str::FromStr;

/// A filter, for places between a texture's texels and for textures smaller on the screen than in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The texel that contains the point.
    Nearest,
    /// A weighted mean of the four texels around the point.
    #[default]
    Bilinear,
    /// A mean of that in the two nearest levels of a mip map: no shimmer in the distance, but blurred where the surface
    /// is seen at a flat angle.
    Trilinear,
    /// As many of those along the direction in which the texture is squeezed most: sharp at flat angles too.
    Anisotropic(Probes),
}

impl Filter {
    const NAMES: [(&str, Self); 7] = [
        ("nearest", Self::Nearest),
        ("bilinear", Self::Bilinear),
        ("trilinear", Self::Trilinear),
        ("anisotropic:2", Self::Anisotropic(Probes::Two)),
        ("anisotropic:4", Self::Anisotropic(Probes::Four)),
        ("anisotropic:8", Self::Anisotropic(Probes::Eight)),
        ("anisotropic:16", Self::Anisotropic(Probes::Sixteen)),
    ];
}

impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = Self::NAMES.into_iter().find(|(_, filter)| filter == self);
        f.write_str(name.map_or("", |(name, _)| name))
    }
}

impl FromStr for Filter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        let found = Self::NAMES.into_iter().find(|(name, _)| *name == text);
        found
            .map(|(_, filter)| filter)
            .ok_or_else(|| "nearest, bilinear, trilinear or anisotropic:N with N = 2, 4, 8 or 16".to_owned())
    }
}

super::values::words!(str::parse: Filter);

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
    /// The number.
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
        assert_eq!("Trilinear".parse(), Ok(Filter::Trilinear));
        assert_eq!("anisotropic:16".parse(), Ok(Filter::Anisotropic(Probes::Sixteen)));
        for text in ["", "cubic", "anisotropic", "anisotropic:", "anisotropic:3", "anisotropic:02", "nearer"]
        {
            assert!(text.parse::<Filter>().is_err(), "{text}");
        }
    }
}
