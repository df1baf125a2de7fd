//! Times of frames beside that of a reference, taken in turns so that a machine's moods fall on all alike.

use crate::row::Row;
use std::time::{Duration, Instant};

/// Turns of all rows.
const ROUNDS: usize = 15;
/// The least time of a measurement: shorter frames are drawn several times.
const LEAST: Duration = Duration::from_millis(3);

/// A frame's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The least of all turns, in milliseconds.
    pub least: f64,
    /// Multiples of the reference's time in the same turn: the lower quartile, the median, the upper quartile.
    pub ratio: [f64; 3],
}

/// Times rows of one scene, of which one is the reference.
///
/// # Panics
/// Without a reference.
pub fn times(rows: &mut [Row]) -> Vec<Time> {
    let count = rows.len();
    let reference = rows.iter().position(|row| row.reference).expect("a reference");
    let mut pixels = vec![0; rows[0].pixels()];
    let repeats: Vec<u32> = rows
        .iter_mut()
        .map(|row| {
            (row.frame)(&mut pixels);
            let once = frame_time(row, &mut pixels, 1).max(1e-9);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few")]
            let repeats = (LEAST.as_secs_f64() / once).ceil() as u32;
            repeats.clamp(1, 100)
        })
        .collect();
    let mut taken = vec![vec![]; count];
    for round in 0..ROUNDS {
        // Another one begins each turn.
        for k in (0..count).map(|k| (k + round) % count) {
            taken[k].push(frame_time(&mut rows[k], &mut pixels, repeats[k]));
        }
    }
    let own = taken[reference].clone();
    let of_row = |times: &Vec<f64>| {
        let mut ratios: Vec<f64> = times.iter().zip(&own).map(|(time, reference)| time / reference).collect();
        ratios.sort_by(f64::total_cmp);
        let least = times.iter().copied().fold(f64::INFINITY, f64::min) * 1e3;
        Time { least, ratio: [ROUNDS / 4, ROUNDS / 2, ROUNDS - 1 - ROUNDS / 4].map(|k| ratios[k]) }
    };
    taken.iter().map(of_row).collect()
}

/// Seconds a frame, over several.
fn frame_time(row: &mut Row, pixels: &mut [u32], repeats: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..repeats {
        (row.frame)(pixels);
    }
    start.elapsed().as_secs_f64() / f64::from(repeats)
}
