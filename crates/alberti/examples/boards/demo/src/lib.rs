//! The demo of all boards: a lit, textured object of a thousand triangles that turns, drawn in bands.
//!
//! It knows no board. A [`panel::Display`] sends bytes, and while it sends those of one band the next one is drawn.

#![no_std]

mod object;

use alberti::glam::Vec2;
use alberti::shaders::Light;
use alberti::*;
use core::mem::{replace, swap};
use core::ops::Range;
use embassy_futures::join::join;
use object::TRIANGLES;
use panel::{Display, HEIGHT, WIDTH};

/// Rows of a band.
pub const ROWS: u16 = 16;

const BANDS: usize = (HEIGHT / ROWS) as usize;
const PIXELS: usize = WIDTH as usize * ROWS as usize;

/// The frames of a whole turn.
pub const TURN: u32 = 256;

/// The numbers of most cores. Triangles are so small that straight lines across them miss less than a quarter of a
/// texel.
pub const FIXED: FixedPoint<Affine> = FixedPoint(Affine);
/// The same in floats.
pub const FLOAT: Affine = Affine;

/// Vertices that are kept; the others are transformed again in each band that has them.
const SLOTS: usize = 320;

/// The background.
const BACKGROUND: Rgba8 = Rgba8::from_rgb24(0x10_18_28);

type Buffers = Memory<Rgb565Be, D16, (Light, Vec2), PIXELS, SLOTS, { TRIANGLES.len() }>;

/// The bytes of RAM that all of it may take, but for the stack.
const BUDGET: usize = 46 * 1024;
const _: () = assert!(size_of::<Demo>() <= BUDGET, "the demo's memory is larger than its budget");

/// The demo's memory, for a `static`: about 46 KB.
#[derive(Debug)]
pub struct Demo {
    buffers: Buffers,
    /// The rows of each band on which the object was in the frame before; before the first frame none.
    shown: [Range<u16>; BANDS],
    /// Frames that were drawn or left out.
    frame: u32,
}

impl Demo {
    /// The demo before its first frame: zeros, which take no flash.
    #[must_use]
    pub const fn new() -> Self {
        Self { buffers: Buffers::new(0, 0), shown: [const { 0..0 }; BANDS], frame: 0 }
    }

    /// Leaves out so many frames.
    pub const fn skip(&mut self, frames: u32) {
        self.frame = self.frame.wrapping_add(frames);
    }

    /// Draws the next frame by `interpolation`, and sends those of its rows that change.
    ///
    /// # Errors
    /// Those of the display.
    pub async fn frame<D: Display>(
        &mut self,
        interpolation: impl Interpolation,
        display: &mut D,
    ) -> Result<(), D::Error> {
        let Self { buffers: Memory { colors: [drawn, sent], depths, slots, list }, shown, frame } = self;
        let turn = *frame;
        *frame = frame.wrapping_add(1);
        let scene = object::Scene::at(turn);
        let mesh = scene.mesh();
        let mut pass = scene.pass(&mesh).interpolation(interpolation).slots(slots);
        let size = [WIDTH, HEIGHT].map(u32::from);
        let (mut triangles, _) = pass.count_prepare(size, D16, list, &mut ());

        display.begin().await?;
        let (mut drawn, mut sent) = (drawn, sent);
        let mut ready = 0..0;
        // One turn more than there are bands, as the last is sent while nothing is drawn.
        for (number, shown) in shown.iter_mut().map(Some).chain([None]).enumerate() {
            let first = number * usize::from(ROWS);
            let (rows, bytes) = (ready.clone(), bytes_of(&*sent, &ready));
            let sending = async { if rows.is_empty() { Ok(()) } else { display.send(rows, bytes).await } };
            let drawing = async {
                let Some(shown) = shown else { return 0..0 };
                let band = Target::band(Rgb565Be, D16, size, first as u32, &mut *drawn, depths);
                let Ok(mut band) = band else { return 0..0 };
                band.clear(BACKGROUND);
                let mut touched = Touched::default();
                triangles.count_by(lanes::One, &mut band, &mut touched);
                let now = rows_of(&touched);
                let before = replace(shown, now.clone());
                // In the first frame all, for the background.
                if turn == 0 { first as u16..first as u16 + ROWS } else { about(&before, &now) }
            };
            // The transfer is begun first.
            let (sending, rows) = join(sending, drawing).await;
            sending?;
            ready = rows;
            swap(&mut drawn, &mut sent);
        }
        Ok(())
    }
}

impl Default for Demo {
    fn default() -> Self {
        Self::new()
    }
}

/// The rows of a band that triangles have touched.
fn rows_of(touched: &Touched) -> Range<u16> {
    let rows = touched.rows();
    let row = |row: i32| u16::try_from(row).unwrap_or_default();
    row(rows.start)..row(rows.end)
}

/// The rows of both, and those between.
fn about(a: &Range<u16>, b: &Range<u16>) -> Range<u16> {
    match (a.is_empty(), b.is_empty()) {
        (true, _) => b.clone(),
        (_, true) => a.clone(),
        _ => a.start.min(b.start)..a.end.max(b.end),
    }
}

/// The bytes of these rows of the frame, of those of the band that they are in.
fn bytes_of<'a>(band: &'a [u16], rows: &Range<u16>) -> &'a [u8] {
    let (first, count) = (rows.start % ROWS, rows.len());
    let width = usize::from(WIDTH);
    let pixels = band.get(usize::from(first) * width..).and_then(|rest| rest.get(..count * width));
    bytemuck::cast_slice(pixels.unwrap_or_default())
}
