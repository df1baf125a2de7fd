//! The mean of texels, for each content.

use alberti_math::{Rgba8, srgb};

use crate::format::Content;

/// The mean of colours that count so many times: together from 1 to 2^28 times.
#[inline]
pub(crate) fn of_colors(content: Content, colors: impl Iterator<Item = (Rgba8, u64)>) -> Rgba8 {
    let colors = colors.map(|(color, weight)| (color.to_bytes(), weight));
    let [r, g, b, a] = match content {
        Content::Srgb => {
            let light =
                |[r, g, b, a]: [u8; 4]| [srgb::to_light(r), srgb::to_light(g), srgb::to_light(b), a.into()];
            let ([r, g, b, a], weights) = sums(colors.map(|(color, weight)| (light(color), weight)));
            let [r, g, b] = [r, g, b].map(|sum| srgb::to_byte(rounded(sum, weights)));
            [r, g, b, byte(a, weights)]
        }
        Content::Scalars => {
            let (sums, weights) = sums(colors);
            sums.map(|sum| byte(sum, weights))
        }
        Content::Normals => {
            let ([x, y, z, alpha], weights) = sums(colors);
            // In units of 1/255 of the weights: at most 2^36 either way.
            let vector = [x, y, z].map(|sum| (2 * sum).cast_signed() - (255 * weights).cast_signed());
            let [r, g, b] = unit(vector).unwrap_or([128, 128, 255]);
            [r, g, b, byte(alpha, weights)]
        }
    };
    Rgba8::new(r, g, b, a)
}

/// The mean of numbers that count so many times.
#[inline]
pub(crate) fn of_numbers(numbers: impl Iterator<Item = (u16, u64)>) -> u16 {
    let ([sum], weights) = sums(numbers.map(|(number, weight)| ([number], weight)));
    rounded(sum, weights)
}

/// The sums of the channels times their weights, and that of the weights.
#[inline]
fn sums<T: Into<u64>, const N: usize>(texels: impl Iterator<Item = ([T; N], u64)>) -> ([u64; N], u64) {
    texels.fold(([0; N], 0), |(mut sums, weights), (channels, weight)| {
        for (sum, channel) in sums.iter_mut().zip(channels) {
            *sum += weight * channel.into();
        }
        (sums, weights + weight)
    })
}

/// `sum / weights`, rounded to nearest, halves up; at most 65535.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "a mean of such numbers")]
fn rounded(sum: u64, weights: u64) -> u16 {
    ((2 * sum + weights) / (2 * weights).max(1)) as u16
}

/// The same for a mean of bytes.
#[inline]
fn byte(sum: u64, weights: u64) -> u8 {
    rounded(sum, weights).to_le_bytes()[0]
}

/// A vector divided by its length, -1 to 1 as 0 to 255; `None` if it is 0. Components are below 2^40.
fn unit(vector: [i64; 3]) -> Option<[u8; 3]> {
    let greatest = vector.iter().fold(0, |greatest, x| x.unsigned_abs().max(greatest));
    if greatest == 0 {
        return None;
    }
    // The greatest gets 30 bits, so that the sum of squares fits.
    let bits = 64 - greatest.leading_zeros();
    let vector = vector.map(|x| if bits > 30 { x >> (bits - 30) } else { x << (30 - bits) });
    let squares: u64 = vector.iter().map(|x| x.unsigned_abs() * x.unsigned_abs()).sum();
    let length = squares.isqrt().cast_signed();
    // 255 (1 + x) / 2, where rounding may have left the length a little less than a component.
    Some(vector.map(|x| {
        let steps = (255 * (x + length) + length) / (2 * length).max(1);
        steps.clamp(0, 255).to_le_bytes()[0]
    }))
}
