//! The light of a picture, as far as it is not that of a scene.

use std::fmt;
use std::str::FromStr;

use super::values::{one_of, words};
use clap::ValueEnum;

/// Policies of light. The default is that of a program that does without: surfaces of one side, and one lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightOptions {
    /// Whether surfaces that are seen from behind are lit as if they faced the viewer.
    pub two_sided: bool,
    /// The light of a scene that has none.
    pub key: KeyLight,
    /// The space in which it is computed.
    pub space: LightSpace,
    /// A factor of all light, from 0 to 100.
    pub brightness: f32,
}

impl Default for LightOptions {
    fn default() -> Self {
        Self { two_sided: false, key: KeyLight::Lamp, space: LightSpace::Srgb, brightness: 1.0 }
    }
}

/// The space in which light is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LightSpace {
    /// The bytes of colours as they are.
    #[default]
    Srgb,
    /// Amounts of light, of which what is brighter than the screen is tone-mapped.
    Linear,
}

/// The light of a scene that has none of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum KeyLight {
    /// One lamp beside the camera.
    #[default]
    Lamp,
    /// A key light in this direction as seen from the model: degrees to the right of the camera and above it. With it
    /// come a weaker light from the other side, and one from behind.
    Studio([f32; 2]),
}

impl KeyLight {
    /// From the upper left.
    pub const STUDIO: Self = Self::Studio([-35.0, 50.0]);
}

impl FromStr for KeyLight {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        let number = |text: &str, most: f32| text.trim().parse().ok().filter(|x: &f32| x.abs() <= most);
        let angles =
            |(azimuth, elevation): (&str, &str)| Some([number(azimuth, 360.0)?, number(elevation, 90.0)?]);
        match text {
            "lamp" => Some(Self::Lamp),
            _ => text.split_once(',').and_then(angles).map(Self::Studio),
        }
        .ok_or_else(|| "lamp, or two angles up to 360 and 90 degrees, such as -35,50".to_owned())
    }
}

impl fmt::Display for KeyLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lamp => f.write_str("lamp"),
            Self::Studio([azimuth, elevation]) => write!(f, "{azimuth},{elevation}"),
        }
    }
}

words!(str::parse: KeyLight);
words!(one_of: LightSpace);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_read() {
        for text in ["lamp", "-35,40", "0,-90", "360,12.5"] {
            assert_eq!(text.parse::<KeyLight>().map(|light| light.to_string()).as_deref(), Ok(text));
        }
        for text in ["", "lamps", "1", "1,2,3", "361,0", "0,91", "nan,0", "0,inf"] {
            assert!(text.parse::<KeyLight>().is_err_and(|expected| expected.contains("-35,50")), "{text}");
        }
    }
}
