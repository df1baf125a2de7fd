//! Every float from the near to the far plane: no later depth comes before an earlier one.

use super::{ensure, rng};
use crate::Found;
use alberti_projection::DepthMap;
use alberti_raster::{AnyDepth, DepthFormat as _};

/// The blocks of a pair of planes.
pub const PARTS: u64 = 16;

const FORMATS: [AnyDepth; 5] =
    [AnyDepth::F32, AnyDepth::F32Reversed, AnyDepth::D32, AnyDepth::D24, AnyDepth::D16];

/// A part of the floats between two planes, each with its neighbour.
///
/// # Errors
/// Two neighbours in the wrong order.
pub fn block(block: u64, seed: u64) -> Result<Found, String> {
    let (pair, part) = (block / PARTS, block % PARTS);
    let mut rng = rng(pair, seed);
    let near = rng.log_uniform(1e-4, 1e3);
    let far = near * rng.log_uniform(1.001, 1e9);
    let maps = [DepthMap::forward(near, far), DepthMap::reversed(near, far)];
    let [Ok(forward), Ok(reversed)] = maps else { return Err(format!("{near} and {far} are no planes")) };
    let [first, last] = [near, far].map(|z| u64::from(z.to_bits()));
    let [from, to] = [part, part + 1].map(|part| first + (last - first) * part / PARTS);
    let at = |bits: u64| {
        let z = f32::from_bits(bits as u32);
        let (zs, back) = (forward.zs(z), reversed.zs(z));
        let stored = FORMATS.map(|format| format.encode(if format.reversed() { back } else { zs }));
        (zs, back, stored)
    };
    let mut before = at(from);
    for bits in from + 1..=to {
        let now = at(bits);
        let stored = FORMATS.iter().enumerate().all(|(k, format)| !format.nearer(now.2[k], before.2[k]));
        ensure!(
            before.0 <= now.0 && before.1 >= now.1 && stored,
            "at {} between {near} and {far}: {before:?} before {now:?}",
            f32::from_bits(bits as u32)
        );
        before = now;
    }
    Ok(Found { cases: to - from, worst: 0.0 })
}
