//! Numbers of pixels in files beside the picture.

use std::str::FromStr;

use clap::ValueEnum;

use super::values::{name_of, words};

/// A number of the surface that is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Aov {
    /// z in eye space.
    Depth,
    /// The normal in world space.
    Normal,
    /// Texture coordinates.
    Uv,
    /// The numbers of the object and of the triangle.
    Id,
    /// The level of detail of the texture.
    Lod,
}

/// Some of them, in the order of the type.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Aovs(Vec<Aov>);

impl Aovs {
    /// Each once.
    pub fn iter(&self) -> impl Iterator<Item = Aov> + '_ {
        self.0.iter().copied()
    }

    /// Whether one is among them.
    #[must_use]
    pub fn has(&self, aov: Aov) -> bool {
        self.0.contains(&aov)
    }
}

impl FromStr for Aovs {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        let all = Aov::value_variants();
        let mut named = Vec::new();
        for name in text.split(',').map(str::trim) {
            let found = all.iter().find(|aov| name_of(**aov) == name);
            named.push(*found.ok_or_else(|| {
                let names: Vec<_> = all.iter().map(|aov| name_of(*aov)).collect();
                format!("one or more of {}, with commas between", names.join(", "))
            })?);
        }
        Ok(Self(all.iter().copied().filter(|aov| named.contains(aov)).collect()))
    }
}

words!(str::parse: Aovs);

/// The format of such files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum AovFormat {
    /// PNG with 16 bits a channel, a file for each.
    #[default]
    Png16,
    /// One OpenEXR file with the picture and all of them, in 32 bits a channel.
    Exr,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_in_any_order() {
        assert_eq!("lod, Depth,lod".parse(), Ok(Aovs(vec![Aov::Depth, Aov::Lod])));
        assert!("id,uv,normal".parse::<Aovs>().is_ok_and(|aovs| aovs.has(Aov::Uv) && !aovs.has(Aov::Lod)));
        for bad in ["", "depth,", "depths", "z", "depth normal"] {
            let message = bad.parse::<Aovs>().unwrap_err();
            assert_eq!(message, "one or more of depth, normal, uv, id, lod, with commas between", "{bad}");
        }
    }
}
