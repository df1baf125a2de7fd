//! Animated WebP: lossless pictures in the container of RFC 9649.

use image::ExtendedColorType;
use image::codecs::webp::WebPEncoder;

use crate::error::Error;
use crate::scene::Image;

/// Bits of a file's features.
const ALPHA: u8 = 0x10;
const ANIMATION: u8 = 0x02;

/// Bits of a frame: it is not mixed with what is there, and leaves nothing.
const ALONE: u8 = 0x03;

/// The file's beginning, without its length: size, features, endless repetition before nothing.
pub(super) fn header([width, height]: [u32; 2], alpha: bool) -> Vec<u8> {
    let mut file = b"RIFF\0\0\0\0WEBP".to_vec();
    let features = ANIMATION | if alpha { ALPHA } else { 0 };
    let mut extended = vec![features, 0, 0, 0];
    extended.extend(short(width - 1));
    extended.extend(short(height - 1));
    chunk(&mut file, *b"VP8X", &extended);
    chunk(&mut file, *b"ANIM", &[0; 6]);
    file
}

/// Appends a frame that is seen for so many milliseconds.
///
/// # Errors
/// It cannot be encoded.
pub(super) fn push(file: &mut Vec<u8>, frame: &Image, duration: u32) -> Result<(), Error> {
    let mut still = Vec::new();
    let (bytes, colors) = (frame.texels.as_flattened(), ExtendedColorType::Rgba8);
    let encoded = WebPEncoder::new_lossless(&mut still).encode(bytes, frame.width, frame.height, colors);
    encoded.map_err(|error| Error::new(format!("that encoding fails ({error})"), "another format"))?;
    let mut body = [short(0), short(0), short(frame.width - 1), short(frame.height - 1)].concat();
    body.extend(short(duration));
    body.push(ALONE);
    // The picture's own chunk, behind `RIFF`, a length and `WEBP`.
    body.extend_from_slice(still.get(12..).unwrap_or_default());
    chunk(file, *b"ANMF", &body);
    Ok(())
}

/// The file with its length.
pub(super) fn finish(mut file: Vec<u8>) -> Result<Vec<u8>, Error> {
    let length = u32::try_from(file.len() - 8);
    let length = length.map_err(|_| Error::new("a film of 4 GiB or more", "fewer or smaller frames"))?;
    file[4..8].copy_from_slice(&length.to_le_bytes());
    Ok(file)
}

/// Three bytes.
fn short(number: u32) -> [u8; 3] {
    let [a, b, c, _] = number.to_le_bytes();
    [a, b, c]
}

fn chunk(file: &mut Vec<u8>, name: [u8; 4], body: &[u8]) {
    file.extend_from_slice(&name);
    // One that is longer makes a file that is refused at the end.
    file.extend_from_slice(&u32::try_from(body.len()).unwrap_or(u32::MAX).to_le_bytes());
    file.extend_from_slice(body);
    if body.len() % 2 == 1 {
        file.push(0);
    }
}
