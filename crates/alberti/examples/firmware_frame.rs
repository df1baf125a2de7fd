//! A frame as firmware draws it: nothing is allocated on the way, no `f32` per pixel, a constant lens, and memory for
//! sixteen of its 240 rows. A display of 320 x 240 pixels in big-endian RGB565 gets one band after the other; here it
//! is a PNG file.
//!
//!     cargo run --release -p alberti --features bytemuck --example firmware_frame -- firmware_frame.png

mod common;

use alberti::glam::{Vec2, Vec3};
use alberti::shaders::Stored;
use alberti::texture::{Known, Nearest, Repeat, TexelFormat, Texture, format::Rgb565};
use alberti::*;
use std::process::ExitCode;

const WIDTH: u16 = 320;
const HEIGHT: u16 = 240;
/// Pixels of the sixteen rows that there is memory for.
const PIXELS: usize = WIDTH as usize * 16;

/// The lens, so that the board computes none of it.
const LENS: Perspective = match Perspective::new(0.8, WIDTH as f32 / HEIGHT as f32, 0.5, 20.0) {
    Ok(lens) => lens,
    Err(_) => panic!("an impossible lens"),
};

/// Squares of two colours, in flash. Sides that are known when compiling are the fastest.
static SQUARES: Texture<'static, Rgb565, Known<16, 16>> = match Texture::new(Rgb565, &TEXELS, 16, 16) {
    Ok(texture) => texture.known().expect("16 x 16"),
    Err(_) => panic!("as many texels as that takes"),
};
static TEXELS: [u16; 16 * 16] = {
    let mut texels = [0xe6b4; 16 * 16];
    let mut k = 0;
    while k < texels.len() {
        if (k / 16 / 4 + k % 16 / 4) % 2 == 0 {
            texels[k] = 0x8a24;
        }
        k += 1;
    }
    texels
};

/// A pyramid: places in units of a quarter, as small meshes are kept, and texture coordinates in quarters.
static VERTICES: [([i8; 3], [u8; 2]); 5] = [
    ([-6, -4, -6], [0, 0]),
    ([6, -4, -6], [8, 0]),
    ([6, -4, 6], [0, 0]),
    ([-6, -4, 6], [8, 0]),
    ([0, 6, 0], [4, 8]),
];
static TRIANGLES: [[u8; 3]; 4] = [[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]];

/// All memory, as a board has it in a `static`: a fifth of what the frame's colours would take.
type Room = Memory<Rgb565Be, D16, Vec2, PIXELS, { VERTICES.len() }, { TRIANGLES.len() }>;
const _: () = Room::must_fit(32 * 1024);

fn main() -> ExitCode {
    common::write("firmware_frame.png", picture)
}

fn picture() -> common::File {
    let mut room = Box::new(Room::new(0, 0));
    let mut display = Vec::new();
    frame(&mut room, |bytes| display.extend_from_slice(bytes))?;
    let shown = |bytes: &[u8; 2]| Rgb565Be.decode(u16::from_ne_bytes(*bytes)).to_bits();
    let pixels: Vec<u32> = display.as_chunks().0.iter().map(shown).collect();
    common::png(WIDTH.into(), &pixels)
}

/// Draws a frame, whose bytes `send` gets in the display's order.
fn frame(room: &mut Room, mut send: impl FnMut(&[u8])) -> Result<(), Error> {
    // `send` is done when it returns, so one band of colours is enough.
    let Room { colors: [colors, _], depths, slots, list } = room;
    let view = Camera::look_at(Vec3::new(1.2, 1.5, -5.0), Vec3::Y * 0.1, Vec3::Y)?.through(LENS);
    let stage = Stored(SQUARES.sampler(Nearest, Repeat));
    let mesh = Mesh::new(&VERTICES, &TRIANGLES, |(place, uv)| {
        (Vec3::from(place.map(f32::from)) / 4.0, Vec2::from(uv.map(f32::from)) / 4.0)
    });

    // The geometry once, then sixteen rows at a time.
    let mut bands = Bands::new(Rgb565Be, D16, WIDTH.into(), HEIGHT.into(), colors, depths)?;
    let mut pass = Pass::new(&view, &mesh, stage).with(MCU).slots(slots);
    let (mut triangles, _) = pass.prepare(&bands, list);
    bands.draw(common::BACKGROUND, |band| {
        triangles.draw(band);
        send(band.bytes());
    });
    Ok(())
}
