//! All triangles of two by two pixels on the grid of 16ths of a pixel: a block for each first corner.

use super::ensure;
use crate::Found;
use alberti_math::Subpixel;
use alberti_oracle::coverage::{area2, covers};
use alberti_raster::{Cull, NoDepth, Rgba8888, Target};
use alberti_tests::probe::{bare, draw_widest};

/// Corners: 33 by 33.
pub const POINTS: u64 = 33 * 33;

/// The samples, in the order of the pixels.
const SAMPLES: [[i64; 2]; 4] = [[8, 8], [24, 8], [8, 24], [24, 24]];

/// The triangles with this first corner.
///
/// # Errors
/// A triangle that covers other samples than it should.
pub fn block(first: u64, _: u64) -> Result<Found, String> {
    let point = |k: u64| [k % 33, k / 33].map(u64::cast_signed);
    let (mut color, mut depth) = ([0_u32; 4], [(); 4]);
    for second in 0..POINTS {
        for third in 0..POINTS {
            let tri = [first, second, third].map(point);
            color.fill(0);
            let mut target = Target::new(Rgba8888, NoDepth, 2, 2, &mut color, &mut depth)
                .map_err(|error| error.to_string())?;
            let [a, b, c] = bare(tri);
            draw_widest(Subpixel::Sub4, &mut target, [&a, &b, &c], Cull::None, |()| Some(1_u32), &mut ());
            for (pixel, sample) in color.iter().zip(SAMPLES) {
                let covered = area2(tri) != 0 && covers(tri, sample);
                ensure!(
                    (*pixel != 0) == covered,
                    "{tri:?} at {sample:?}: drawn {}, covered {covered}",
                    *pixel != 0
                );
            }
        }
    }
    Ok(Found { cases: POINTS * POINTS, worst: 0.0 })
}
