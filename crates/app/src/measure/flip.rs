//! LDR-FLIP, by Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020: per pixel, how much is
//! seen by somebody who flips between two pictures.
//!
//! The crate `flip-rs` computes it; pictures are handed to it in bands of rows. The filters of FLIP reach
//! [`REACH`] rows, so that a band which has these above and below has the values that the whole picture has, bit for
//! bit. Bands go to threads, and keep what large pictures need of memory to a few of them.

use std::sync::{Mutex, PoisonError};
use std::thread;

use flip_rs::{DEFAULT_PPD, FlipError, RgbImage, ldr_flip};

use crate::error::Error;
use crate::scene::Image;
use crate::threads::available;

/// The rows of a band: enough that those around it add little to the time.
const BAND: usize = 128;

/// The radius of the widest filter at the default of 67.02 pixels per degree.
const REACH: usize = 10;

/// The FLIP of each pixel, from the top. Both pictures have the same size, and pixels.
pub(super) fn map(first: &Image, second: &Image) -> Result<Vec<f32>, Error> {
    let width = first.width as usize;
    let mut errors = vec![0.0; first.texels.len()];
    let rows = first.texels.len().checked_div(width).unwrap_or_default();
    let bands = Mutex::new(errors.chunks_mut(width.max(1) * BAND).enumerate());
    let work = || {
        loop {
            let next = bands.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((number, errors)) = next else { return Ok(()) };
            fill(errors, number * BAND, width, first, second)?;
        }
    };
    let threads = available().get().min(rows.div_ceil(BAND));
    thread::scope(|scope| {
        // A thread that does not start leaves its bands to the others.
        let start = |_| thread::Builder::new().spawn_scoped(scope, work).ok();
        let others: Vec<_> = (1..threads).filter_map(start).collect();
        let done = work();
        let join = |other: thread::ScopedJoinHandle<'_, _>| {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        others.into_iter().map(join).fold(done, Result::and)
    })
    .map_err(|error: FlipError| {
        Error::new(format!("that FLIP fails ({error})"), "memory enough for both pictures")
    })?;
    Ok(errors)
}

/// The FLIP of the rows from `top` on.
fn fill(
    errors: &mut [f32],
    top: usize,
    width: usize,
    first: &Image,
    second: &Image,
) -> Result<(), FlipError> {
    let rows = errors.len() / width;
    let begin = top.saturating_sub(REACH);
    let band = |picture: &Image| {
        let end = (top + rows + REACH).min(picture.texels.len() / width);
        let colors = picture.texels[begin * width..end * width].iter();
        RgbImage::new(width, end - begin, colors.flat_map(|&[r, g, b, _]| [r, g, b]).collect())
    };
    let found = ldr_flip(&band(first)?, &band(second)?, DEFAULT_PPD)?;
    let skipped = (top - begin) * width;
    errors.copy_from_slice(&found.pixels()[skipped..skipped + errors.len()]);
    Ok(())
}

#[cfg(test)]
mod tests;
