//! The demo of all boards: a lit, textured object of a thousand triangles that turns, drawn in bands.
//!
//! It knows no board. A [`panel::Display`] sends bytes, and while it sends those of one band the next one is drawn.

#![no_std]

mod object;

use alberti::glam::Vec2;
use alberti::raster::color::pack;
use alberti::shaders::Light;
use alberti::*;
use core::mem::{offset_of, replace};
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

const _: () = assert!(
    align_of::<Demo>().is_multiple_of(4) && offset_of!(Demo, buffers.colors).is_multiple_of(4),
    "colours are sent as words of two pixels"
);

const NOTHING: Touched = Touched::new(0..0, 0..0);

/// The demo's memory, for a `static`: about 46 KB.
#[derive(Debug)]
pub struct Demo {
    buffers: Buffers,
    /// Where in each band the object was in the frame before; before the first frame nowhere.
    shown: [Touched; BANDS],
    /// Frames that were drawn or left out.
    frame: u32,
}

impl Demo {
    /// The demo before its first frame: zeros, which take no flash.
    #[must_use]
    pub const fn new() -> Self {
        Self { buffers: Buffers::new(0, 0), shown: [const { NOTHING }; BANDS], frame: 0 }
    }

    /// Leaves out so many frames.
    pub const fn skip(&mut self, frames: u32) {
        self.frame = self.frame.wrapping_add(frames);
    }

    /// Draws the next frame by `interpolation`, and sends of each band the rectangle that changes.
    ///
    /// # Errors
    /// Those of the display.
    pub async fn frame<D: Display>(
        &mut self,
        interpolation: impl Interpolation,
        display: &mut D,
    ) -> Result<(), D::Error> {
        let Self { buffers: Memory { colors: [first, second], depths, slots, list }, shown, frame } = self;
        let turn = *frame;
        *frame = frame.wrapping_add(1);
        let scene = object::Scene::at(turn);
        let mesh = scene.mesh();
        let mut pass = scene.pass(&mesh).interpolation(interpolation).slots(slots);
        let size = [WIDTH, HEIGHT].map(u32::from);
        let (mut triangles, _) = pass.count_prepare(size, D16, list, &mut ());

        display.begin().await?;
        let Ok(mut bands) = PingPong::new(Rgb565Be, D16, size, [first, second], depths) else {
            return Ok(());
        };
        let mut shown = shown.iter_mut();
        let mut changed = NOTHING;
        while let Some(Turn { band, ready }) = bands.turn() {
            let [columns, rows] = [changed.columns(), changed.rows()].map(of_frame);
            let bytes = ready.map_or(&[][..], |ready| bytes_of(ready.pixels, &columns, &rows));
            let sending =
                async { if bytes.is_empty() { Ok(()) } else { display.send(columns, rows, bytes).await } };
            let drawing = async {
                let (Some(mut band), Some(shown)) = (band, shown.next()) else { return NOTHING };
                band.clear(BACKGROUND);
                let mut now = Touched::default();
                triangles.count_by(lanes::One, &mut band, &mut now);
                let before = replace(shown, now.clone());
                let [columns, rows] = band.limits();
                // In the first frame all, for the background.
                if turn == 0 { Touched::new(columns, rows) } else { before.with(&now).aligned(2) }
            };
            // The transfer is begun first.
            let (sent, now) = join(sending, drawing).await;
            sent?;
            changed = now;
        }
        Ok(())
    }
}

impl Default for Demo {
    fn default() -> Self {
        Self::new()
    }
}

/// Columns or rows as the display counts them.
fn of_frame(range: Range<i32>) -> Range<u16> {
    let [start, end] = [range.start, range.end].map(|place| u16::try_from(place).unwrap_or_default());
    start..end
}

/// The bytes of a rectangle of the frame between even columns, whose rows are in this band. Pixels move as words of
/// two, which takes half as long.
fn bytes_of<'a>(band: &'a mut [u16], columns: &Range<u16>, rows: &Range<u16>) -> &'a [u8] {
    let pairs: &mut [u32] = bytemuck::try_cast_slice_mut(band).unwrap_or_default();
    let [left, right, width] = [columns.start, columns.end, WIDTH].map(|column| usize::from(column / 2));
    let first = usize::from(rows.start % ROWS);
    bytemuck::cast_slice(pack::rectangle(pairs, width, left..right, first..first + rows.len()))
}
