//! Windows: rows of a frame with a stride, as whole frames, bands in any order, or bands one after the other.

use super::bands::{HEIGHT, Picture, SIZE, Soup, WIDTH};
use alberti::{AnyDepth, Bands, PreparedTriangle, Rgba8, Rgba8888, Sides, Slot, Target};
use alberti_oracle::rng::{Rng, run_seed};

/// A pixel beside a window.
const BESIDE: u32 = 0xdead_beef;

/// A picture with a window somewhere in it, whose last row may be the end of it all.
struct Framed {
    stride: usize,
    corner: usize,
    pixels: Vec<u32>,
}

impl Framed {
    fn new(rng: &mut Rng, rows: usize) -> Self {
        let [left, right, above] = [(); 3].map(|()| rng.index(4) * rng.index(9));
        let stride = left + WIDTH as usize + right;
        let corner = above * stride + left;
        let below = rng.index(2) * (right + rng.index(3) * stride);
        let pixels = vec![BESIDE; corner + (rows - 1) * stride + WIDTH as usize + below];
        Self { stride, corner, pixels }
    }

    fn window(&mut self) -> &mut [u32] {
        &mut self.pixels[self.corner..]
    }

    /// Fails unless the window has these pixels, and all others are as they were.
    fn check(&self, expected: &[u32], case: &str) {
        let width = WIDTH as usize;
        let mut picture = vec![BESIDE; self.pixels.len()];
        for (row, pixels) in expected.chunks_exact(width).enumerate() {
            let first = self.corner + row * self.stride;
            picture[first..first + width].copy_from_slice(pixels);
        }
        assert!(self.pixels == picture, "{case}, in rows of {} from {}", self.stride, self.corner);
    }
}

/// Bands of a window are the rows of the frame, prepared or not: in memory of their own each, in any order, or one
/// after the other in the memory of the picture, with the depths of a band.
#[test]
fn bands_of_a_window_make_the_frame_and_nothing_beside_it() {
    let mut rng = Rng::stream(run_seed(), 3);
    let format = AnyDepth::D16;
    for case in 0..24 {
        let soup = match case % 3 {
            0 => Soup::built_in("mesh"),
            1 => Soup::random(&mut rng, Sides::GuardBand, [0, 0, 200, 150]),
            _ => Soup::random(&mut rng, Sides::Cube, [13, 21, 170, 100]),
        };
        let mesh = soup.mesh(0..soup.triangles.len());
        let slots = &mut [Slot::EMPTY; 64];
        let mut pass = soup.pass(&mesh, slots);
        let mut whole = Picture::new(format);
        whole.bands(&[HEIGHT], |frame| {
            frame.clear(Rgba8::BLACK);
            pass.draw(frame);
        });
        assert!(whole.color.iter().any(|&pixel| pixel != whole.color[0]), "{}", soup.name);
        let room = &mut vec![PreparedTriangle::EMPTY; 9000];
        let (mut prepared, _) = pass.count_prepare(SIZE, format, room, &mut ());
        let mut draw = |band: &mut Target<'_, Rgba8888, AnyDepth>| {
            if case % 2 == 0 {
                prepared.draw(band);
            } else {
                soup.pass(&mesh, &mut [Slot::EMPTY; 9]).draw(band);
            }
        };

        let height = [1, 7, 16, 61, 149, HEIGHT][case / 2 % 6];
        let mut tops: Vec<u32> = (0..HEIGHT).step_by(height as usize).collect();
        tops.reverse();
        for top in tops {
            let rows = top..HEIGHT.min(top + height);
            let pixels = (rows.start * WIDTH) as usize..(rows.end * WIDTH) as usize;
            let mut framed = Framed::new(&mut rng, rows.len());
            let (stride, mut depth) = (framed.stride, vec![9; pixels.len()]);
            let band =
                Target::window(Rgba8888, format, SIZE, rows.clone(), stride, framed.window(), &mut depth);
            let mut band = band.expect("rows of the frame");
            band.clear(Rgba8::BLACK);
            draw(&mut band);
            framed.check(&whole.color[pixels.clone()], &format!("{}: rows {rows:?}", soup.name));
            assert!(depth == whole.depth[pixels], "{}: depths of rows {rows:?}", soup.name);
        }

        let (mut framed, mut depth) =
            (Framed::new(&mut rng, HEIGHT as usize), vec![9; (WIDTH * height) as usize]);
        let stride = framed.stride;
        let bands = Bands::window(Rgba8888, format, SIZE, stride, framed.window(), &mut depth);
        bands.expect("a window").draw(Rgba8::BLACK, &mut draw);
        framed.check(&whole.color, &format!("{}: bands of {height} rows", soup.name));
    }
}
