//! Textures from image files.

use std::io::{self, Cursor};
use std::path::Path;

use image::codecs::gif::GifDecoder;
use image::codecs::png::PngDecoder;
use image::codecs::webp::WebPDecoder;
use image::metadata::Orientation;
use image::{
    AnimationDecoder, ColorType, DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits,
    Rgb,
};

use crate::error::Error;
use crate::load::input;
use crate::memory;
use crate::scene::{HeightImage, Image};

/// The longest side of a texture.
pub const MAX_SIDE: u32 = 16384;

/// The most texels that all textures of a model may have together: half a gibibyte in memory.
pub const MAX_TEXELS: u64 = 1 << 27;

/// The largest image file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// The most bytes of a texel that is kept.
const KEPT: u64 = 4;

const KIND: &str = "a PNG, JPEG, BMP, TGA, GIF, WebP, QOI or PPM image";

/// # Errors
/// The file cannot be opened.
pub(crate) fn check(path: &Path) -> Result<(), Error> {
    input::check(path, KIND)
}

/// Reads an image of at most `budget` texels, and of [`MAX_SIDE`] a side. The format is told by the contents, or
/// else by the extension (TGA files have no mark of their own). A photograph's note of how the camera was held is left
/// aside, since texture coordinates count from the image as it is stored.
///
/// # Errors
/// The file cannot be read, is not an image, is broken, or is too large. The size is taken from the header and
/// checked before anything is decoded.
pub fn load(path: &Path, budget: u64) -> Result<Image, Error> {
    let bytes = input::read(path, KIND, MAX_FILE_BYTES)?;
    decode(path, bytes, budget, false).map(as_texels)
}

/// The same of a picture that the user names, which may be a pipe, or [`input::STDIN`]. It is turned as its note says.
///
/// # Errors
/// As those of [`load`].
pub(crate) fn load_given(path: &Path, budget: u64) -> Result<Image, Error> {
    let bytes = input::read_given(path, KIND, MAX_FILE_BYTES)?;
    decode(input::shown(path), bytes, budget, true).map(as_texels)
}

/// Whether a picture has an alpha, by its header. One that is none has not: [`load`] says what it is.
pub(crate) fn has_alpha(path: &Path) -> bool {
    let reader = ImageReader::open(path).and_then(ImageReader::with_guessed_format);
    let decoder = reader.map(ImageReader::into_decoder);
    matches!(decoder, Ok(Ok(decoder)) if decoder.color_type().has_alpha())
}

/// The same, and whether it is the first frame of a film.
///
/// # Errors
/// As those of [`load`].
pub(crate) fn load_frame(path: &Path, budget: u64) -> Result<(Image, bool), Error> {
    let bytes = input::read_given(path, KIND, MAX_FILE_BYTES)?;
    let is_film = is_film(&bytes);
    decode(input::shown(path), bytes, budget, true).map(|picture| (as_texels(picture), is_film))
}

/// Whether an image has more than one frame.
fn is_film(bytes: &[u8]) -> bool {
    let film = match image::guess_format(bytes) {
        Ok(ImageFormat::Png) => PngDecoder::new(Cursor::new(bytes)).and_then(|decoder| decoder.is_apng()),
        Ok(ImageFormat::WebP) => WebPDecoder::new(Cursor::new(bytes)).map(|decoder| decoder.has_animation()),
        Ok(ImageFormat::Gif) => {
            let frames = GifDecoder::new(Cursor::new(bytes)).map(AnimationDecoder::into_frames);
            frames.map(|frames| frames.take(2).filter(Result::is_ok).count() == 2)
        }
        _ => return false,
    };
    film.unwrap_or(false)
}

/// The same of a picture that is not held: its memory is given back.
///
/// # Errors
/// As those of [`load`].
pub(crate) fn load_for_once(path: &Path) -> Result<Image, Error> {
    memory::for_once(|| load(path, MAX_TEXELS))
}

fn as_texels(picture: DynamicImage) -> Image {
    let (width, height) = (picture.width(), picture.height());
    let texels = match picture {
        // Most are such, and `into_rgba8` takes longer.
        DynamicImage::ImageRgb8(picture) => picture.pixels().map(|&Rgb([r, g, b])| [r, g, b, 255]).collect(),
        picture => picture.into_rgba8().pixels().map(|p| p.0).collect(),
    };
    Image { width, height, texels }
}

/// Reads an image as heights: its grey, or the luminance of its colours. 16 bits stay as they are, 8 bits are widened
/// so that white stays white.
///
/// # Errors
/// As those of [`load`].
pub fn load_heights(path: &Path, budget: u64) -> Result<HeightImage, Error> {
    let picture = decode(path, input::read(path, KIND, MAX_FILE_BYTES)?, budget, false)?;
    let wide = matches!(
        picture.color(),
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 | ColorType::Rgb32F
    );
    let (width, height) = (picture.width(), picture.height());
    let heights = if wide {
        picture.into_luma16().into_raw()
    } else {
        picture.into_luma8().into_raw().into_iter().map(|byte| u16::from(byte) * 257).collect()
    };
    Ok(HeightImage { width, height, heights })
}

/// Decodes an image, and `turns` it as its note says.
fn decode(path: &Path, bytes: Vec<u8>, budget: u64, turns: bool) -> Result<DynamicImage, Error> {
    // Of the others, the name does not count.
    let unmarked = || ImageFormat::from_path(path).ok().filter(|format| *format == ImageFormat::Tga);
    let format = image::guess_format(&bytes).ok().or_else(unmarked);
    let format = format.filter(ImageFormat::reading_enabled).ok_or_else(|| {
        let found = if bytes.is_empty() { "an empty file" } else { "a file of another format" };
        Error::new(found, KIND).file(path).hint("convert it to PNG")
    })?;
    if format == ImageFormat::Jpeg && is_cut_off(&bytes) {
        return Err(broken(path, format, &ImageError::IoError(io::ErrorKind::UnexpectedEof.into())));
    }
    let broken = |error: ImageError| broken(path, format, &error);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    // 16 bits a channel, and something for the decoder itself. This limit is not strict for all formats, which
    // is why the header is checked below.
    limits.max_alloc = Some(budget.saturating_mul(8).saturating_add(1 << 26));
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let texels = u64::from(width) * u64::from(height);
    if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE || texels > budget {
        return Err(too_large(format!("an image of {width}x{height}"), budget).file(path));
    }
    let what = format!("an image of {width}x{height}");
    // As it is decoded, as bytes, and as it is kept.
    let bytes = decoder.total_bytes().saturating_add(2 * KEPT * texels);
    memory::need(bytes, &what).and_then(|()| memory::hold(KEPT * texels, what)).map_err(|e| e.file(path))?;
    let orientation = if turns { decoder.orientation().map_err(broken)? } else { Orientation::NoTransforms };
    let mut picture = DynamicImage::from_decoder(decoder).map_err(broken)?;
    picture.apply_orientation(orientation);
    Ok(picture)
}

/// Whether a JPEG file has no marker of an end behind its picture, about which decoders say nothing: they make up the
/// rest. Markers and their lengths are those of ITU-T T.81, annex B; one in a thumbnail does not count.
fn is_cut_off(jpeg: &[u8]) -> bool {
    const END: u8 = 0xd9;
    let mut rest = jpeg.get(2..).unwrap_or_default();
    loop {
        // In the data of a scan 0xff is followed by 0, or by the number of a restart.
        let marker = |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7 | 0xff);
        let Some(at) = rest.windows(2).position(marker) else { return true };
        let (kind, behind) = (rest[at + 1], &rest[at + 2..]);
        if kind == END {
            return false;
        }
        let Some(length) = behind.first_chunk().map(|bytes| usize::from(u16::from_be_bytes(*bytes))) else {
            return true;
        };
        rest = behind.get(length..).unwrap_or_default();
    }
}

fn too_large(found: String, budget: u64) -> Error {
    let texels = match budget {
        MAX_TEXELS => format!("at most {MAX_TEXELS} in all"),
        left => format!("no more than are left of {MAX_TEXELS} for all images, {left}"),
    };
    Error::new(found, format!("1 to {MAX_SIDE} texels a side and {texels}")).hint("resize it")
}

/// The error of a decoder in words that are not its own.
fn broken(path: &Path, format: ImageFormat, error: &ImageError) -> Error {
    let ends = |error: &io::Error| error.kind() == io::ErrorKind::UnexpectedEof;
    let fault = match error {
        ImageError::Limits(_) => {
            return too_large("an image that is too large".to_owned(), MAX_TEXELS).file(path);
        }
        ImageError::IoError(error) if ends(error) => "that ends too early",
        ImageError::Unsupported(_) => "of a kind that is not read",
        _ => "that is damaged",
    };
    let name = match format {
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::WebP => "WebP",
        ImageFormat::Pnm => "PPM",
        ImageFormat::Bmp => "BMP",
        ImageFormat::Qoi => "QOI",
        ImageFormat::Tga => "TGA",
        ImageFormat::Gif => "GIF",
        _ => "PNG",
    };
    Error::new(format!("a {name} image {fault}"), "a whole one").file(path).hint("save it again")
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::PathBuf;

    use super::*;

    fn file(folder: &tempfile::TempDir, name: &str, bytes: &[u8]) -> PathBuf {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    }

    /// An uncompressed 24-bit TGA; a size that the data do not back is what a hostile file would claim.
    fn tga(width: u16, height: u16, data: &[u8]) -> Vec<u8> {
        let mut bytes = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        bytes.extend(width.to_le_bytes());
        bytes.extend(height.to_le_bytes());
        bytes.extend([24, 0x20]);
        bytes.extend(data);
        bytes
    }

    #[test]
    fn rows_come_from_the_top() {
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, "a.tga", &tga(1, 2, &[1, 2, 3, 4, 5, 6]));
        let image = load(&path, MAX_TEXELS).unwrap();
        assert_eq!(image, Image { width: 1, height: 2, texels: vec![[3, 2, 1, 255], [6, 5, 4, 255]] });
    }

    #[test]
    fn heights_keep_their_bits() {
        let folder = tempfile::tempdir().unwrap();
        let deep = [0, 1, 255, 256, 257, 0x1234, 0x8001, 0xffff];
        let grey = |values: [u16; 8]| image::ImageBuffer::from_raw(4, 2, values.to_vec()).unwrap();
        let path = folder.path().join("deep.png");
        DynamicImage::ImageLuma16(grey(deep)).save(&path).unwrap();
        let found = load_heights(&path, MAX_TEXELS).unwrap();
        assert_eq!((found.width, found.height, found.heights), (4, 2, deep.to_vec()));
        let three = deep.into_iter().flat_map(|x| [x; 3]).collect();
        let colors = image::ImageBuffer::from_raw(4, 2, three).unwrap();
        DynamicImage::ImageRgb16(colors).save(&path).unwrap();
        assert_eq!(load_heights(&path, MAX_TEXELS).unwrap().heights, deep);
        // Blue, green, red; the first row at the top.
        let path = file(&folder, "a.tga", &tga(1, 3, &[0, 0, 0, 7, 7, 7, 255, 255, 255]));
        assert_eq!(load_heights(&path, MAX_TEXELS).unwrap().heights, [0, 7 * 257, 0xffff]);
        let path = folder.path().join("a.jpg");
        image::GrayImage::from_pixel(8, 8, image::Luma([100])).save(&path).unwrap();
        assert_eq!(load_heights(&path, MAX_TEXELS).unwrap().heights, [100 * 257; 64]);
    }

    #[test]
    fn sizes_are_checked_before_decoding() {
        let folder = tempfile::tempdir().unwrap();
        for (w, h) in [(0, 5), (5, 0), (65535, 65535), (16384, 16384), (16385, 1)] {
            let path = file(&folder, "a.tga", &tga(w, h, &[]));
            let message = load(&path, MAX_TEXELS).unwrap_err().to_string();
            assert!(message.contains("a.tga: found") && message.contains("expected"), "{message}");
        }
        let path = file(&folder, "a.tga", &tga(3, 3, &[0; 27]));
        assert!(load(&path, 9).is_ok());
        assert!(load(&path, 8).unwrap_err().to_string().contains("3x3"));
    }

    #[test]
    fn faults_are_told_in_plain_words() {
        let folder = tempfile::tempdir().unwrap();
        let picture = image::RgbImage::from_fn(40, 40, |x, y| {
            image::Rgb([x, y, x * y].map(|c| u8::try_from(c % 251).unwrap_or_default()))
        });
        for (name, kind) in [
            ("a.png", "PNG"),
            ("a.jpg", "JPEG"),
            ("a.bmp", "BMP"),
            ("a.tga", "TGA"),
            ("a.qoi", "QOI"),
            ("a.webp", "WebP"),
            ("a.ppm", "PPM"),
        ] {
            let path = folder.path().join(name);
            picture.save(&path).unwrap();
            let bytes = fs::read(&path).unwrap();
            // Cut off, or a byte in the head turned over: whatever its decoder says is not in the message.
            let mut turned = bytes.clone();
            turned[17] ^= 0x55;
            for bytes in [&bytes[..bytes.len() / 2], &bytes[..12], &turned[..]] {
                fs::write(&path, bytes).unwrap();
                let Err(error) = load(&path, MAX_TEXELS) else { continue };
                let message = error.to_string();
                let message = message.split_once(": found ").unwrap().1;
                let faults = ["that ends too early", "of a kind that is not read", "that is damaged"];
                let known = faults
                    .map(|fault| format!("a {kind} image {fault}, expected a whole one; save it again"))
                    .contains(&message.to_owned());
                let size = message.starts_with("an image ") && message.ends_with("in all; resize it");
                assert!(known || size, "{message}");
            }
        }
        let path = file(&folder, "a.png", &fs::read(folder.path().join("a.ppm")).unwrap());
        let message = load(&path, MAX_TEXELS).map(|_| ()).unwrap_err().to_string();
        assert!(message.contains("PPM"), "{message}");
        let path = file(&folder, "a.tga", &tga(3, 3, &[0; 27]));
        let message = load(&path, 0).unwrap_err().to_string();
        assert!(message.contains("no more than are left of 134217728 for all images, 0;"), "{message}");
    }

    /// Wherever its data are cut, and whatever a thumbnail has; what stands behind the end is no fault.
    #[test]
    fn a_jpeg_that_is_cut_off_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.jpg");
        let picture = image::RgbImage::from_fn(64, 64, |x, y| {
            image::Rgb([x, y, x ^ y].map(|c| u8::try_from(4 * c).unwrap_or_default()))
        });
        picture.save(&path).unwrap();
        let whole = fs::read(&path).unwrap();
        let thumbnail = [&[0xff, 0xe1, 0, 6, 0xff, 0xd9, 0xff, 0xd9], &whole[2..]].concat();
        let with_thumbnail = [&whole[..2], &thumbnail].concat();
        for bytes in [&whole, &with_thumbnail] {
            let expected = load(&path, MAX_TEXELS).unwrap();
            fs::write(&path, [bytes, &b"more"[..]].concat()).unwrap();
            assert_eq!(load(&path, MAX_TEXELS).unwrap(), expected);
            for end in [bytes.len() - 1, bytes.len() - 2, bytes.len() * 9 / 10, bytes.len() * 2 / 3] {
                let cut = file(&folder, "cut.jpg", &bytes[..end]);
                let message = load(&cut, MAX_TEXELS).map(|_| ()).unwrap_err().to_string();
                assert!(
                    message.contains("found a JPEG image that ends too early, expected"),
                    "{end}: {message}"
                );
            }
        }
    }

    /// A photograph that was held on its side: texture coordinates count from what is stored, and a viewer turns it.
    #[test]
    fn notes_of_how_a_camera_was_held_are_for_viewers() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.jpg");
        let picture =
            image::RgbImage::from_fn(
                32,
                16,
                |x, _| if x < 16 { image::Rgb([250; 3]) } else { image::Rgb([5; 3]) },
            );
        picture.save(&path).unwrap();
        let bytes = fs::read(&path).unwrap();
        // One entry, 0x112, a short of 6: the first row is at the right.
        let note = b"\xff\xe1\0\x22Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0";
        let path = file(&folder, "noted.jpg", &[&bytes[..2], note, &bytes[2..]].concat());
        let stored = load(&path, MAX_TEXELS).unwrap();
        assert_eq!((stored.width, stored.height), (32, 16));
        assert_eq!(stored, load(&folder.path().join("a.jpg"), MAX_TEXELS).unwrap());
        assert_eq!(load_heights(&path, MAX_TEXELS).unwrap().width, 32);
        let seen = load_given(&path, MAX_TEXELS).unwrap();
        assert_eq!((seen.width, seen.height), (16, 32));
        assert!(seen.texels[0][0] > 200 && seen.texels[16 * 31][0] < 50);
    }

    /// Of a film, the first frame.
    #[test]
    fn gif_images_are_read() {
        let mut bytes = Vec::new();
        let mut encoder = gif::Encoder::new(&mut bytes, 2, 1, &[10, 20, 30, 200, 100, 50]).unwrap();
        for pixels in [vec![0, 1], vec![1, 1]] {
            encoder.write_frame(&gif::Frame::from_indexed_pixels(2, 1, pixels, None)).unwrap();
        }
        drop(encoder);
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, "a.gif", &bytes);
        let image = load(&path, MAX_TEXELS).unwrap();
        assert!(load_frame(&path, MAX_TEXELS).unwrap().1);
        let texels = vec![[10, 20, 30, 255], [200, 100, 50, 255]];
        assert_eq!(image, Image { width: 2, height: 1, texels });
    }

    #[test]
    fn what_is_not_an_image_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in
            [("a.png", &b""[..]), ("a.txt", b"hello"), ("a.png", b"\x89PNG\r\n\x1a\n"), ("a.gif", b"GIF89a")]
        {
            let path = file(&folder, name, bytes);
            let message = load(&path, MAX_TEXELS).unwrap_err().to_string();
            let expected =
                ["expected a PNG, JPEG, BMP, TGA, GIF, WebP, QOI or PPM image", "expected a whole one"];
            assert!(expected.iter().any(|expected| message.contains(expected)), "{message}");
            assert_eq!(message.lines().count(), 1);
        }
        assert!(load(folder.path(), MAX_TEXELS).unwrap_err().to_string().contains("found a directory"));
        assert!(
            load(&folder.path().join("no.png"), 1).unwrap_err().to_string().contains("found no such file")
        );
    }
}
