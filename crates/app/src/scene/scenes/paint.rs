//! Painting textures from formulas: integer noise, a few stones, and the loop over the texels.

use super::build::Vec3;
use crate::scene::Image;
use crate::threads::available;

/// An image from a colour (sRGB, 0..=1) for each texel's centre in 0..1 by 0..1, v up.
///
/// Rows are shared out among threads; a texel does not depend on which one painted it.
pub(super) fn paint(width: u32, height: u32, color: impl Fn(f64, f64) -> Vec3 + Sync) -> Image {
    let row = |row: u32| {
        let v = 1.0 - (f64::from(row) + 0.5) / f64::from(height);
        let texel = |column: u32| {
            let u = (f64::from(column) + 0.5) / f64::from(width);
            let [r, g, b] = color(u, v).map(byte);
            [r, g, b, 255]
        };
        (0..width).map(texel).collect::<Vec<_>>()
    };
    let threads = u32::try_from(available().get()).unwrap_or(1);
    let share = height.div_ceil(threads);
    let texels = std::thread::scope(|scope| {
        let painters: Vec<_> = (0..height)
            .step_by(share as usize)
            .map(|top| scope.spawn(move || (top..height.min(top + share)).flat_map(row).collect::<Vec<_>>()))
            .collect();
        painters.into_iter().flat_map(|painter| painter.join().expect("formulas do not panic")).collect()
    });
    Image { width, height, texels }
}

/// The colour of `image` at a place, between texels their weighted mean; it repeats.
///
/// Stones are painted once and laid by looking: their noise is much dearer than four texels.
pub(super) fn look(image: &Image, u: f64, v: f64) -> Vec3 {
    let (x, y) = (u * f64::from(image.width) - 0.5, -v * f64::from(image.height) - 0.5);
    let (fx, fy) = (x - x.floor(), y - y.floor());
    let stride = image.texels.len() / image.height as usize;
    let wrap = |at: i32, n: u32| at.rem_euclid(n.cast_signed()).cast_unsigned() as usize;
    let [left, right] = [0, 1].map(|d| wrap(cell(x) + d, image.width));
    let [above, below] = [0, 1].map(|d| wrap(cell(y) + d, image.height) * stride);
    let texel = |row: usize, column: usize| {
        let [r, g, b, _] = image.texels[row + column];
        [r, g, b].map(|c| f64::from(c) / 255.0)
    };
    mix(
        mix(texel(above, left), texel(above, right), fx),
        mix(texel(below, left), texel(below, right), fx),
        fy,
    )
}

/// The nearest 8-bit value.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0..=255 first")]
fn byte(x: f64) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// From `a` at 0 to `b` at 1, constant outside.
pub(super) fn mix(a: Vec3, b: Vec3, t: f64) -> Vec3 {
    let t = t.clamp(0.0, 1.0);
    [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t]
}

/// 0 below `low`, 1 above `high`, smooth between.
pub(super) fn ramp(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A colour from its usual notation, 0xRRGGBB.
pub(super) fn rgb(hex: u32) -> Vec3 {
    [16, 8, 0].map(|shift| f64::from((hex >> shift) & 255) / 255.0)
}

/// A hash of a lattice point, 0..1. Integers only, hence the same everywhere.
pub(super) fn hash(x: i32, y: i32, seed: u32) -> f64 {
    let mix = |h: u32| {
        let h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
        let h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
        h ^ (h >> 16)
    };
    let [x, y] = [x, y].map(i32::cast_unsigned);
    f64::from(mix(mix(mix(seed).wrapping_add(x)).wrapping_add(y))) / 4_294_967_296.0
}

/// The lattice cell below `x`.
#[allow(clippy::cast_possible_truncation, reason = "coordinates of a texture are small")]
pub(super) fn cell(x: f64) -> i32 {
    x.floor() as i32
}

/// Smooth noise in 0..1 with features of size 1; the same again after `period` in both directions.
pub(super) fn noise(x: f64, y: f64, period: i32, seed: u32) -> f64 {
    let (i, j) = (cell(x), cell(y));
    let (fx, fy) = (ramp(0.0, 1.0, x - x.floor()), ramp(0.0, 1.0, y - y.floor()));
    let [left, right, low, high] = [i, i + 1, j, j + 1].map(|c| c.rem_euclid(period));
    let row = |j: i32| {
        let (a, b) = (hash(left, j, seed), hash(right, j, seed));
        a + (b - a) * fx
    };
    let (low, high) = (row(low), row(high));
    low + (high - low) * fy
}

/// Four octaves of [`noise`], in 0..1 with a mean of one half.
pub(super) fn cloud(x: f64, y: f64, period: i32, seed: u32) -> f64 {
    let octave =
        |k: i32, weight: f64, seed: u32| weight * noise(x * f64::from(k), y * f64::from(k), period * k, seed);
    octave(1, 8.0 / 15.0, seed)
        + octave(2, 4.0 / 15.0, seed + 1)
        + octave(4, 2.0 / 15.0, seed + 2)
        + octave(8, 1.0 / 15.0, seed + 3)
}

/// Veined marble over a unit square that repeats, between two colours; `period` sets how fine it is.
pub(super) fn marble(u: f64, v: f64, period: i32, seed: u32, light: Vec3, vein: Vec3) -> Vec3 {
    let times = f64::from(period);
    let (x, y) = (u * times, v * times);
    let warp = cloud(x, y, period, seed);
    // A vein is where a warped noise crosses one half.
    let line = (cloud(x + 2.0 * warp, y + 1.3 * warp, period, seed + 7) - 0.5).abs();
    let veined = mix(vein, light, ramp(0.0, 0.09, line));
    mix(veined, light, 0.55 + 0.6 * (warp - 0.5))
}

/// Fine-grained stone or plaster over a unit square that repeats.
pub(super) fn grain(u: f64, v: f64, period: i32, seed: u32, color: Vec3, depth: f64) -> Vec3 {
    let times = f64::from(period);
    let shade = 1.0 + depth * (cloud(u * times, v * times, period, seed) - 0.5);
    [color[0] * shade, color[1] * shade, color[2] * shade]
}

/// The part of a texel of size `width` that lies inside, given the signed distance to an edge (inside is negative).
pub(super) fn cover(distance: f64, width: f64) -> f64 {
    (0.5 - distance / width).clamp(0.0, 1.0)
}
