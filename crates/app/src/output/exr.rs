//! OpenEXR files: one part of scan lines, 32 bits a channel, compressed by ZIP.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;

/// The kind of a channel's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `u32`.
    Uint = 0,
    /// `f32`.
    Float = 2,
}

/// A channel: one number for each pixel, rows from the top.
#[derive(Clone, Debug)]
pub struct Channel {
    /// The layer, a dot and the channel's own name, or that alone; at most 31 bytes.
    pub name: &'static str,
    /// The kind of its numbers.
    pub kind: Kind,
    /// The numbers' bits.
    pub words: Vec<u32>,
}

/// The rows that are compressed together.
const ROWS: usize = 16;
const MAGIC: u32 = 20_000_630;
const VERSION: u32 = 2;
const ZIP: u8 = 3;

/// The file of an image with these channels, each of `width` times `height` numbers.
#[must_use]
pub fn encode(width: u32, height: u32, mut channels: Vec<Channel>) -> Vec<u8> {
    channels.sort_by_key(|channel| channel.name);
    let mut file = [MAGIC, VERSION].map(u32::to_le_bytes).concat();
    file.extend(header(width, height, &channels));
    let row = width as usize;
    let blocks: Vec<Vec<u8>> = (0..height as usize)
        .step_by(ROWS)
        .map(|first| {
            let rows = first..(first + ROWS).min(height as usize);
            let words = rows.flat_map(|y| {
                channels.iter().flat_map(move |channel| channel.words.get(row * y..row * (y + 1)))
            });
            deflated(words.flatten().flat_map(|word| word.to_le_bytes()).collect())
        })
        .collect();
    let mut place = (file.len() + 8 * blocks.len()) as u64;
    for block in &blocks {
        file.extend(place.to_le_bytes());
        place += 8 + block.len() as u64;
    }
    for (block, first) in blocks.iter().zip((0u32..).step_by(ROWS)) {
        file.extend(first.to_le_bytes());
        file.extend(length(block).to_le_bytes());
        file.extend(block);
    }
    file
}

/// The attributes that every file must have.
fn header(width: u32, height: u32, channels: &[Channel]) -> Vec<u8> {
    let mut list = Vec::new();
    for Channel { name, kind, .. } in channels {
        list.extend(name.bytes().chain([0]));
        // The last two are the steps between samples.
        for word in [*kind as u32, 0, 1, 1] {
            list.extend(word.to_le_bytes());
        }
    }
    list.push(0);
    let window = [0, 0, width - 1, height - 1].map(u32::to_le_bytes).concat();
    let mut header = Vec::new();
    for (name, kind, value) in [
        ("channels", "chlist", list),
        ("compression", "compression", vec![ZIP]),
        ("dataWindow", "box2i", window.clone()),
        ("displayWindow", "box2i", window),
        ("lineOrder", "lineOrder", vec![0]),
        ("pixelAspectRatio", "float", 1.0_f32.to_le_bytes().to_vec()),
        ("screenWindowCenter", "v2f", vec![0; 8]),
        ("screenWindowWidth", "float", 1.0_f32.to_le_bytes().to_vec()),
    ] {
        header.extend(name.bytes().chain([0]).chain(kind.bytes()).chain([0]));
        header.extend(length(&value).to_le_bytes());
        header.extend(value);
    }
    header.push(0);
    header
}

/// Bytes at even places before those at odd ones, each as the difference to the one before, deflated; or as they are,
/// where that is shorter.
fn deflated(bytes: Vec<u8>) -> Vec<u8> {
    let apart = bytes.iter().step_by(2).chain(bytes.iter().skip(1).step_by(2));
    let mut last = 128_u8;
    let differences =
        apart.map(|&byte| byte.wrapping_sub(std::mem::replace(&mut last, byte)).wrapping_add(128));
    let differences: Vec<u8> = differences.collect();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    // Writing to memory does not fail.
    match encoder.write_all(&differences).and_then(|()| encoder.finish()) {
        Ok(short) if short.len() < bytes.len() => short,
        _ => bytes,
    }
}

/// Blocks of sixteen rows of at most 2^14 pixels are far shorter than 2^31 bytes.
fn length(bytes: &[u8]) -> u32 {
    u32::try_from(bytes.len()).unwrap_or(u32::MAX)
}
