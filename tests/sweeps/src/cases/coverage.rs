//! Samples on, beside and near edges, up to the guard band.

use super::{ensure, rng};
use crate::Found;
use alberti_math::{GUARD_PIXELS, Subpixel};
use alberti_oracle::cases;
use alberti_oracle::coverage::covers;
use alberti_raster::NoDepth;
use alberti_tests::probe::{LARGEST, Probe};

/// Samples of a block.
const SAMPLES: u64 = 250_000;

/// So many samples, and those beside them: even blocks on the grid of 256ths, odd ones on that of 16ths.
///
/// # Errors
/// A sample that is covered and not drawn, or drawn and not covered.
pub fn block(block: u64, seed: u64) -> Result<Found, String> {
    let subpixel = if block.is_multiple_of(2) { Subpixel::Sub8 } else { Subpixel::Sub4 };
    let (bits, guard) = (subpixel.bits(), i64::from(GUARD_PIXELS) << subpixel.bits());
    let (mut rng, mut probe) = (rng(block, seed), Probe::new(NoDepth, subpixel));
    let mut looked = 0;
    while looked < SAMPLES {
        let case = cases::any(&mut rng, bits, guard);
        // A frame has rows and columns from 0 on: mirrored there, the case is as hard.
        let mirror = case.sample.map(i64::signum);
        let flip = |p: [i64; 2]| [p[0] * mirror[0], p[1] * mirror[1]];
        let (tri, sample) = (case.tri.map(flip), flip(case.sample));
        let [column, row] = sample.map(|c| (c >> bits) as i32);
        // The guard band has its lower end alone, which a mirror makes the upper one.
        if tri.iter().flatten().any(|&x| x >= guard) {
            continue;
        }
        if column >= LARGEST || row >= LARGEST {
            continue;
        }
        let columns = (column - 1).max(0)..(column + 2).min(LARGEST);
        let drawn = probe.covered(tri, columns.clone(), row);
        for (pixel, at) in drawn.iter().zip(columns) {
            let beside = [sample[0] + (i64::from(at - column) << bits), sample[1]];
            let covered = covers(tri, beside);
            ensure!((*pixel != 0) == covered, "{tri:?} at {beside:?}, {bits} bits: covered {covered}");
            looked += 1;
        }
    }
    Ok(Found { cases: looked, worst: 0.0 })
}
