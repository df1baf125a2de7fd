//! Alpha that is tested, not blended.

use alberti_math::Rgba8;

use super::{level_count, size_of_level};
use crate::format::TexelFormat;

/// Scales the alpha of each smaller level so that as many of its texels pass a test of alpha, in proportion, as of
/// level 0. So leaves and fences do not thin out with distance (Castaño, "Computing Alpha Mipmaps", 2010).
///
/// `texels` is a chain that [`build`](super::build) has filled, and texels pass if their alpha is at least `threshold`.
///
/// # Precision
/// No scale of alpha comes nearer to the proportion; where two are as near, more texels pass.
///
/// # Cost
/// Two passes over each level, and a kilobyte of stack.
pub fn preserve_coverage<F: TexelFormat>(
    format: F,
    texels: &mut [F::Texel],
    width: u32,
    height: u32,
    threshold: u8,
) {
    if threshold == 0 {
        return;
    }
    let alpha = |texel: F::Texel| format.decode(texel).to_bytes()[3];
    let area = u64::from(width) * u64::from(height);
    let mut rest = texels;
    let mut covered = 0;
    for level in 0..level_count(width, height) {
        let [columns, rows] = size_of_level([width, height], level);
        let count = columns.saturating_mul(rows);
        let Some((own, below)) = rest.split_at_mut_checked(count as usize) else { return };
        rest = below;
        if level == 0 {
            covered = own.iter().filter(|&&texel| alpha(texel) >= threshold).count() as u64;
            continue;
        }
        let mut histogram = [0u32; 256];
        for &mut texel in &mut *own {
            if let Some(bin) = histogram.get_mut(usize::from(alpha(texel))) {
                *bin += 1;
            }
        }
        let scale = |alpha: u8, from: u32| u32::from(alpha) * u32::from(threshold) / from.max(1);
        let from = passing(&histogram, covered * u64::from(count), area);
        for texel in own {
            let [r, g, b, a] = format.decode(*texel).to_bytes();
            *texel = format.encode(Rgba8::new(r, g, b, scale(a, from).min(255).to_le_bytes()[0]));
        }
    }
}

/// The alpha from 1 to 256 from which on most nearly `wanted / unit` texels are.
fn passing(histogram: &[u32; 256], wanted: u64, unit: u64) -> u32 {
    let mut best = (wanted, 256);
    let mut above = 0;
    for (&bin, alpha) in histogram.iter().rev().zip((1..256).rev()) {
        above += u64::from(bin);
        let distance = (above * unit).abs_diff(wanted);
        if bin > 0 && distance <= best.0 {
            best = (distance, alpha);
        }
    }
    best.1
}
