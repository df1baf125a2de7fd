//! Supersampling: pixels of a picture that was drawn larger.

use super::{ColorFormat, ReadColor};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Rgba8, srgb};

/// The mean of several colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Average {
    /// Of their light: edges look as smooth as they are.
    #[default]
    Light,
    /// Of their bytes: fewer operations and no tables, and bright edges look thinner.
    Bytes,
}

/// Makes a pixel of each square of `factor` x `factor` pixels, with a factor of at most 16. `from` has `factor` times
/// as many columns as `width`, and `to` whole rows of `width`, from `first_row` of the frame on, as far as there are
/// enough rows in `from`.
///
/// So a frame is supersampled band by band, without a large frame anywhere. Bands of `factor` times as many rows and
/// columns are drawn, and each is made one of the display's.
///
/// ```
/// use alberti_math::{Rgb565Be, Rgba8, Rgba8888};
/// use alberti_raster::color::{Average, resolve};
/// use alberti_raster::{Bands, NoDepth};
///
/// // 8 x 6 pixels, in bands of 2 rows, each of 4 samples.
/// let (mut color, mut depth, mut display) = ([0; 16 * 4], [(); 16 * 4], [0; 8 * 2]);
/// let mut bands = Bands::new(Rgba8888, NoDepth, 16, 12, &mut color, &mut depth)?;
/// bands.draw(Rgba8::WHITE, |band| {
///     // ... what is drawn into each band ...
///     let first_row = band.limits()[1].start / 2;
///     resolve((Rgba8888, band.pixels()), (Rgb565Be, &mut display), 8, first_row, 2, Average::Light);
///     assert_eq!(display, [0xffff; 16]);
/// });
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
///
/// # Precision
/// Correctly rounded, of light in 65535ths; then stored as any colour.
///
/// # Cost
/// A square of one colour: a load and a comparison a sample, its colour and a store. Another, a sample: its colour,
/// three loads from a table and sums; a pixel: four divisions, six loads from tables, and a store. Of bytes, no tables.
#[inline(never)]
pub fn resolve<C: ReadColor<Pixel: PartialEq>, E: ColorFormat>(
    (format, from): (C, &[C::Pixel]),
    (to_format, to): (E, &mut [E::Pixel]),
    width: usize,
    first_row: i32,
    factor: usize,
    average: Average,
) {
    let (width, factor) = (width.max(1), factor.clamp(1, 16));
    let rows = from.chunks_exact(width * factor * factor);
    for ((row, samples), pixels) in (first_row..).zip(rows).zip(to.chunks_exact_mut(width)) {
        for (((column, pixel), k), _) in (0..).zip(pixels).zip((0..).step_by(factor)).zip(0..width) {
            let square = (0..factor).flat_map(|down| {
                let first = down * width * factor + k;
                samples.get(first..first + factor).unwrap_or_default()
            });
            // Most squares are of one colour, which is its own mean.
            let mut others = square.clone();
            let color = match others.next() {
                Some(first) if others.all(|other| other == first) => {
                    u32::from_le_bytes(format.color(*first).to_bytes())
                }
                _ => mean(square.map(|&sample| format.color(sample)), average),
            };
            let mut stored = [*pixel];
            to_format.store::<One, Rgba8>(One, One.word(color), true, [column, row], &mut stored);
            [*pixel] = stored;
        }
    }
}

/// The mean of up to 256 colours.
fn mean(colors: impl Iterator<Item = Rgba8>, average: Average) -> u32 {
    let (mut sums, mut count) = ([0_u32; 4], 0);
    for color in colors {
        let [r, g, b, a] = color.to_bytes();
        let parts = match average {
            Average::Light => [r, g, b].map(|byte| u32::from(srgb::to_light(byte))),
            Average::Bytes => [r, g, b].map(u32::from),
        };
        let [red, green, blue] = parts;
        sums.iter_mut().zip([red, green, blue, a.into()]).for_each(|(sum, part)| *sum += part);
        count += 1;
    }
    let count = count.max(1);
    let [red, green, blue, alpha] = sums.map(|sum| (sum + count / 2) / count);
    let byte = |part: u32| match average {
        Average::Light => srgb::to_byte(u16::try_from(part).unwrap_or(u16::MAX)),
        Average::Bytes => part.to_le_bytes()[0],
    };
    u32::from_le_bytes([byte(red), byte(green), byte(blue), alpha.to_le_bytes()[0]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::Rgba8888;

    #[test]
    fn a_square_is_its_mean() {
        let light = |byte: u8| {
            let s = f64::from(byte) / 255.0;
            if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
        };
        let from: [u32; 6 * 4] = core::array::from_fn(|k| {
            u32::try_from(k).expect("few").wrapping_mul(0x9e37_79b1).rotate_left(9) | 0xff00_0000
        });
        for average in [Average::Light, Average::Bytes] {
            let mut to = [0; 3 * 2];
            resolve((Rgba8888, &from), (Rgba8888, &mut to), 3, 0, 2, average);
            for (k, found) in to.into_iter().enumerate() {
                let first = k / 3 * 12 + k % 3 * 2;
                let square = [0, 1, 6, 7].map(|at| from[first + at].to_ne_bytes());
                for (channel, found) in found.to_ne_bytes().into_iter().enumerate() {
                    let bytes = square.map(|color| color[channel]);
                    if average == Average::Bytes || channel == 3 {
                        let mean = bytes.iter().map(|byte| f64::from(*byte)).sum::<f64>() / 4.0;
                        assert!((f64::from(found) - mean).abs() <= 0.5);
                    } else {
                        let mean = bytes.iter().map(|byte| light(*byte)).sum::<f64>() / 4.0;
                        let apart = |byte: u8| (light(byte) - mean).abs();
                        for other in [found.saturating_sub(1), found.saturating_add(1)] {
                            assert!(apart(found) <= apart(other) * 1.1 + 1e-4, "{found} {mean}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_square_of_one_colour_stays() {
        for color in [0x8040_2010_u32, 0xff01_02fe, 0x00ff_8011] {
            for (factor, average) in [(2, Average::Light), (3, Average::Bytes), (3, Average::Light)] {
                let mut to = [0];
                let mut from = [color; 9];
                let from = &mut from[..factor * factor];
                resolve((Rgba8888, from), (Rgba8888, &mut to), 1, 0, factor, average);
                assert_eq!(to, [color]);
                // Beside one that differs only in its last sample.
                from[factor * factor - 1] = !color;
                resolve((Rgba8888, from), (Rgba8888, &mut to), 1, 0, factor, average);
                assert_ne!(to, [color]);
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_left_alone() {
        let from = [u32::MAX; 4 * 3];
        let mut to = [7; 2 * 2];
        resolve((Rgba8888, &from), (Rgba8888, &mut to), 2, 0, 2, Average::Light);
        assert_eq!(to, [u32::MAX, u32::MAX, 7, 7]);
        resolve((Rgba8888, &from), (Rgba8888, &mut to), 0, 0, 0, Average::Light);
    }
}
