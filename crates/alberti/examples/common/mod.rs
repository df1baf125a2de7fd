//! The common part of all examples: the file to write, its format, and the message if that fails.

#![allow(dead_code, reason = "each example uses a part")]

use alberti::Rgba8;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

/// The bytes of an image file, or why there are none.
pub(crate) type File = Result<Vec<u8>, Box<dyn Error>>;

/// The dark blue behind every picture.
pub(crate) const BACKGROUND: Rgba8 = Rgba8::from_rgb24(0x20_28_38);

/// Writes what `draw` makes to the file that the command line names, or else to `default` in the current directory.
pub(crate) fn write(default: &str, draw: fn() -> File) -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    let path = PathBuf::from(arguments.next().unwrap_or_else(|| default.into()));
    if arguments.next().is_some() || path.as_os_str().as_encoded_bytes().starts_with(b"-") {
        eprintln!("error: expected at most one argument, the file to write, such as {default}");
        return ExitCode::from(2);
    }
    let written = draw().and_then(|bytes| Ok(std::fs::write(&path, bytes)?));
    match written {
        Ok(()) => {
            println!("wrote {}", path.display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: cannot write {}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

/// A PNG file of these pixels, row by row from the top.
pub(crate) fn png(width: u32, pixels: &[u32]) -> File {
    let image = image::RgbImage::from_fn(width, u32::try_from(pixels.len())? / width, |x, y| {
        let [r, g, b, _] = Rgba8::from_bits(pixels[(y * width + x) as usize]).to_bytes();
        image::Rgb([r, g, b])
    });
    let mut file = std::io::Cursor::new(Vec::new());
    image.write_to(&mut file, image::ImageFormat::Png)?;
    Ok(file.into_inner())
}

/// Red, green and blue have so many levels in the palette of [`gif`]; the background comes after them.
const LEVELS: u8 = 6;

/// An endlessly repeated GIF file of these frames, each shown for so many hundredths of a second.
pub(crate) fn gif(width: u16, height: u16, delay: u16, frames: &[Vec<u32>]) -> File {
    let levels = |number: u8| [number / (LEVELS * LEVELS), number / LEVELS % LEVELS, number % LEVELS];
    let mut palette: Vec<u8> =
        (0..LEVELS.pow(3)).flat_map(levels).map(|level| level * (u8::MAX / (LEVELS - 1))).collect();
    palette.extend(&BACKGROUND.to_bytes()[..3]);

    let nearest = |&pixel: &u32| {
        let step = u8::MAX / (LEVELS - 1);
        let [r, g, b, _] =
            Rgba8::from_bits(pixel).to_bytes().map(|c| c / step + u8::from(c % step > step / 2));
        let background = pixel == BACKGROUND.to_bits();
        if background { LEVELS.pow(3) } else { (r * LEVELS + g) * LEVELS + b }
    };
    let mut file = Vec::new();
    let mut encoder = gif::Encoder::new(&mut file, width, height, &palette)?;
    encoder.set_repeat(gif::Repeat::Infinite)?;
    for pixels in frames {
        let indices: Vec<u8> = pixels.iter().map(nearest).collect();
        let frame = gif::Frame::from_indexed_pixels(width, height, indices, None);
        encoder.write_frame(&gif::Frame { delay, ..frame })?;
    }
    drop(encoder);
    Ok(file)
}
