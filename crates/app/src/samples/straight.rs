//! Pixels of a transparent picture, of samples that were drawn before black and before white.
//!
//! A sample of alpha a and colour c is ac before black and ac + 255(1 − a) before white, however it was mixed. So both
//! tell a and c, and surfaces need not know that nothing is behind them.

use alberti::math::srgb;

/// Makes a pixel of each square of `side` x `side` samples. Its alpha is their mean; its colour, which is not
/// multiplied by it, is the mean of their light, each as heavy as its alpha.
pub(super) fn resolve([black, white]: [&[u32]; 2], pixels: &mut [u32], side: usize) {
    let columns = pixels.len() * side;
    for (k, pixel) in pixels.iter_mut().enumerate() {
        let (mut light, mut alphas) = ([0_u64; 3], 0_u64);
        for row in 0..side {
            let first = row * columns + k * side;
            let of = |samples: &[u32], at: usize| samples.get(at).copied().unwrap_or_default().to_ne_bytes();
            for at in first..first + side {
                let (alpha, color) = sample(of(black, at), of(white, at));
                alphas += u64::from(alpha);
                for (sum, byte) in light.iter_mut().zip(color) {
                    *sum += u64::from(alpha) * u64::from(srgb::to_light(byte));
                }
            }
        }
        let count = (side * side) as u64;
        let [r, g, b] = light.map(|sum| {
            let mean = (sum + alphas / 2) / alphas.max(1);
            srgb::to_byte(u16::try_from(mean).unwrap_or(u16::MAX))
        });
        let alpha = u8::try_from((alphas + count / 2) / count).unwrap_or(u8::MAX);
        *pixel = u32::from_ne_bytes([r, g, b, alpha]);
    }
}

/// A sample's alpha, and its colour.
fn sample([r, g, b, _]: [u8; 4], [x, y, z, _]: [u8; 4]) -> (u8, [u8; 3]) {
    let through = [(r, x), (g, y), (b, z)].map(|(black, white)| u32::from(white.saturating_sub(black)));
    let through = (through.iter().sum::<u32>() + 1) / 3;
    let alpha = 255 - u8::try_from(through).unwrap_or(u8::MAX);
    let whole = u32::from(alpha).max(1);
    let color =
        [r, g, b].map(|byte| u8::try_from((u32::from(byte) * 255 + whole / 2) / whole).unwrap_or(u8::MAX));
    (alpha, if alpha == 0 { [0; 3] } else { color })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alpha_and_colour_come_back() {
        for alpha in 1..=255_u8 {
            let share = f64::from(alpha) / 255.0;
            for color in [[255, 0, 17], [128, 128, 128], [3, 200, 90]] {
                let before = |behind: f64| {
                    let [r, g, b] = color.map(|byte: u8| {
                        let mixed = f64::from(byte) * share + behind * (1.0 - share);
                        // The nearest byte.
                        (0..=255).find(|whole| f64::from(*whole) + 0.5 > mixed).unwrap_or(255)
                    });
                    [r, g, b, 255]
                };
                let (found, back) = sample(before(0.0), before(255.0));
                assert!(found.abs_diff(alpha) <= 1, "{found} {alpha}");
                for (back, right) in back.into_iter().zip(color) {
                    // Half a step before black, and an alpha that is off by one.
                    assert!(f64::from(back.abs_diff(right)) <= 1.0 + 2.0 / share, "{alpha} {back} {right}");
                }
            }
        }
        assert_eq!(sample([0, 0, 0, 255], [255; 4]), (0, [0; 3]));
        assert_eq!(sample([9, 8, 7, 0], [9, 8, 7, 3]), (255, [9, 8, 7]));
    }

    #[test]
    fn light_is_as_heavy_as_its_alpha() {
        // Two opaque samples, white and black, and two with nothing.
        let [opaque, dark, nothing] = [[255; 4], [0, 0, 0, 255], [0; 4]].map(u32::from_ne_bytes);
        let mut pixels = [0];
        resolve([&[opaque, dark, nothing, nothing], &[opaque, dark, u32::MAX, u32::MAX]], &mut pixels, 2);
        // Half of the light of white is 188 of 255.
        assert_eq!(pixels.map(u32::to_ne_bytes), [[188, 188, 188, 128]]);
    }
}
