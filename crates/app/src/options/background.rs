//! The background, as options have it.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::values::{Color, words};

/// The background of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// One colour.
    Color(Color),
    /// Nothing, with an alpha in the picture.
    Transparent,
    /// From the top to the bottom.
    Gradient([Color; 2]),
    /// An image, which covers the picture.
    Image(PathBuf),
}

/// Extensions of images.
const EXTENSIONS: [&str; 11] =
    ["png", "jpg", "jpeg", "bmp", "tga", "gif", "webp", "qoi", "ppm", "pgm", "pbm"];

impl Background {
    /// The colour of a fog, and of pictures in false colours: of a gradient its middle.
    pub(crate) fn flat(&self) -> Option<[u8; 3]> {
        match self {
            Self::Color(color) => Some(color.bytes()),
            Self::Gradient([Color(top), Color(bottom)]) => {
                Some(Color([0, 1, 2].map(|k| f32::midpoint(top[k], bottom[k]))).bytes())
            }
            Self::Transparent | Self::Image(_) => None,
        }
    }

    /// The file of an image.
    pub(crate) fn file(&mut self) -> Option<&mut PathBuf> {
        match self {
            Self::Image(path) => Some(path),
            _ => None,
        }
    }
}

impl FromStr for Background {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.eq_ignore_ascii_case("transparent") {
            return Ok(Self::Transparent);
        }
        if let Ok(color) = text.parse() {
            return Ok(Self::Color(color));
        }
        if let Some((top, bottom)) = text.split_once("..")
            && let (Ok(top), Ok(bottom)) = (top.parse(), bottom.parse())
        {
            return Ok(Self::Gradient([top, bottom]));
        }
        let extension =
            Path::new(text).extension().map(|extension| extension.to_string_lossy().to_lowercase());
        // The contents of a file of another name say whether it is one.
        let is_named = extension.is_some_and(|extension| EXTENSIONS.contains(&&*extension));
        if is_named || Path::new(text).is_file() {
            return Ok(Self::Image(text.into()));
        }
        let meant = super::colors::meant(text);
        Err(format!("{}, transparent, TOP..BOTTOM of two colours, or an image file{meant}", Color::EXPECTED))
    }
}

words!(str::parse: Background);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backgrounds_are_read() {
        let read = |text: &str| text.parse::<Background>();
        assert_eq!(read("0a141e").map(|b| b.flat()), Ok(Some([10, 20, 30])));
        assert_eq!(read("white").map(|b| b.flat()), Ok(Some([255; 3])));
        assert_eq!(read("white..000000").map(|b| b.flat()), Ok(Some([128; 3])));
        assert_eq!(read("transparent"), Ok(Background::Transparent));
        assert_eq!(read("Transparent"), Ok(Background::Transparent));
        assert_eq!(read("a/sky.JPG"), Ok(Background::Image("a/sky.JPG".into())));
        assert_eq!(read("sky.webp"), Ok(Background::Image("sky.webp".into())));
        for text in
            ["", "ff", "whitee", "white..", "..", "white..ff", "transparent..white", "sky", "sky.tiff"]
        {
            assert!(read(text).is_err_and(|expected| expected.contains("transparent")), "{text}");
        }
    }
}
