//! The demo in a window, or as an animated picture.
//!
//!     cargo run --release                 # a window: space for the numbers, escape to leave
//!     cargo run --release -- demo.gif     # one turn, the left half in fixed point, the right one in floats
//!     cargo run --release -- bytes        # those that a display is sent for a frame, on average over a turn

use alberti::Rgb565Be;
use alberti::texture::TexelFormat;
use alberti_demo::{Demo, FIXED, FLOAT, TURN};
use color_quant::NeuQuant;
use embassy_futures::block_on;
use minifb::{Key, KeyRepeat, Scale, Window, WindowOptions};
use panel::{Display, HEIGHT, WIDTH};
use std::convert::Infallible;
use std::error::Error;
use std::fs;
use std::ops::Range;
use std::process::ExitCode;

/// Frames of a second.
const RATE: usize = 30;
/// Frames of the animated picture.
const FRAMES: u32 = 32;
/// Colours of its palette.
const COLORS: usize = 64;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.as_slice() {
        [] => window(),
        [file] if file.ends_with(".gif") => fs::write(file, animation()).map_err(Into::into),
        [word] if word == "bytes" => {
            println!("{} bytes a frame", mean_of_bytes());
            Ok(())
        }
        _ => Err(format!("expected nothing, the name of a .gif or `bytes`, found `{}`", arguments.join(" "))
            .into()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("desktop: {error}");
            ExitCode::FAILURE
        }
    }
}

/// A display that keeps what it is sent: red, green and blue in the lower 24 bits of each pixel.
struct Memory {
    pixels: Vec<u32>,
    /// Bytes that it was sent.
    sent: usize,
}

impl Memory {
    fn new() -> Self {
        Self { pixels: vec![0; usize::from(WIDTH) * usize::from(HEIGHT)], sent: 0 }
    }
}

impl Display for Memory {
    type Error = Infallible;

    async fn begin(&mut self) -> Result<(), Infallible> {
        Ok(())
    }

    async fn send(&mut self, columns: Range<u16>, rows: Range<u16>, bytes: &[u8]) -> Result<(), Infallible> {
        let (left, width) = (usize::from(columns.start), columns.len());
        let frame = self.pixels.chunks_exact_mut(WIDTH.into()).skip(rows.start.into());
        for (row, bytes) in frame.zip(bytes.chunks_exact(2 * width)) {
            for (pixel, bytes) in row[left..left + width].iter_mut().zip(bytes.as_chunks().0) {
                let [red, green, blue, _] = Rgb565Be.decode(u16::from_ne_bytes(*bytes)).to_bytes();
                *pixel = u32::from_be_bytes([0, red, green, blue]);
            }
        }
        self.sent += bytes.len();
        Ok(())
    }
}

/// Draws the next frame into the memory.
fn draw(demo: &mut Demo, fixed: bool, memory: &mut Memory) {
    let Ok(()) = block_on(async {
        if fixed { demo.frame(FIXED, memory).await } else { demo.frame(FLOAT, memory).await }
    });
}

fn window() -> Result<(), Box<dyn Error>> {
    let (mut demo, mut memory, mut fixed) = (Box::new(Demo::new()), Memory::new(), true);
    let options = WindowOptions { scale: Scale::X2, ..WindowOptions::default() };
    let mut window = Window::new("alberti", WIDTH.into(), HEIGHT.into(), options)?;
    window.set_target_fps(RATE);
    while window.is_open() && !window.is_key_down(Key::Escape) {
        fixed ^= window.is_key_pressed(Key::Space, KeyRepeat::No);
        window.set_title(if fixed { "alberti, in fixed point" } else { "alberti, in f32" });
        draw(&mut demo, fixed, &mut memory);
        window.update_with_buffer(&memory.pixels, WIDTH.into(), HEIGHT.into())?;
    }
    Ok(())
}

/// The bytes that are sent for a frame, but for the first.
fn mean_of_bytes() -> usize {
    let (mut demo, mut memory) = (Box::new(Demo::new()), Memory::new());
    draw(&mut demo, true, &mut memory);
    memory.sent = 0;
    (0..TURN).for_each(|_| draw(&mut demo, true, &mut memory));
    memory.sent / TURN as usize
}

/// Frames of a turn, endless, with one palette for all: the left half in fixed point, the right one in floats.
fn animation() -> Vec<u8> {
    let mut halves = [true, false].map(|fixed| (fixed, Box::new(Demo::new()), Memory::new()));
    let frames: [Vec<u8>; FRAMES as usize] = std::array::from_fn(|_| {
        for (fixed, demo, memory) in &mut halves {
            draw(demo, *fixed, memory);
            demo.skip(TURN / FRAMES - 1);
        }
        let [left, right] = halves.each_ref().map(|(_, _, memory)| memory.pixels.chunks(WIDTH.into()));
        let half = usize::from(WIDTH / 2);
        let rows = left.zip(right).flat_map(|(left, right)| left[..half].iter().chain(&right[half..]));
        rows.flat_map(|pixel| (pixel << 8 | 0xff).to_be_bytes()).collect()
    });
    let palette = NeuQuant::new(10, COLORS, &frames.concat());
    let mut file = vec![];
    let mut encoder =
        gif::Encoder::new(&mut file, WIDTH, HEIGHT, &palette.color_map_rgb()).expect("a size of 16 bits");
    encoder.set_repeat(gif::Repeat::Infinite).expect("memory takes all");
    for pixels in &frames {
        let indices: Vec<u8> = pixels.chunks_exact(4).map(|pixel| palette.index_of(pixel) as u8).collect();
        let mut frame = gif::Frame::from_indexed_pixels(WIDTH, HEIGHT, indices, None);
        frame.delay = 10;
        encoder.write_frame(&frame).expect("memory takes all");
    }
    drop(encoder);
    file
}
