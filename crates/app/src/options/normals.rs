//! The normals of a model's surfaces, as options have them.

use std::str::FromStr;

use super::values::words;

/// The angle from which an edge is sharp, unless the user gives one, in degrees.
pub const DEFAULT_CREASE: f32 = 60.0;

/// The making of normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Normals {
    /// One at each position: no edge is seen.
    Smooth,
    /// One for each face: every edge is seen.
    Flat,
    /// Edges at which faces turn by so many degrees or more are sharp, 0 to 180.
    Crease(f32),
}

impl FromStr for Normals {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        let angle = |text: &str| text.parse().ok().filter(|angle| (0.0..=180.0).contains(angle));
        let found = match text {
            "smooth" => Some(Self::Smooth),
            "flat" => Some(Self::Flat),
            "crease" => Some(Self::Crease(DEFAULT_CREASE)),
            _ => text.strip_prefix("crease:").and_then(angle).map(Self::Crease),
        };
        found.ok_or_else(|| "smooth, flat or crease:DEG with 0 to 180 degrees, such as crease:60".to_owned())
    }
}

words!(str::parse: Normals);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_words() {
        for (text, wanted) in [
            ("smooth", Normals::Smooth),
            ("flat", Normals::Flat),
            ("crease", Normals::Crease(60.0)),
            ("crease:0", Normals::Crease(0.0)),
            ("crease:30.5", Normals::Crease(30.5)),
            ("crease:180", Normals::Crease(180.0)),
            ("Crease:60", Normals::Crease(60.0)),
        ] {
            assert_eq!(text.parse(), Ok(wanted), "{text}");
        }
        for bad in ["", "smoother", "crease:", "crease:-1", "crease:181", "crease:nan", "crease 60", "60"] {
            assert!(bad.parse::<Normals>().is_err(), "{bad}");
        }
    }
}
