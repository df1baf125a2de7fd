//! The right pictures: by rays in `f64`.

use crate::row::pixels;
use crate::scenes::Scene;
use alberti_app::options::{Filter, RenderOptions};
use alberti_oracle::ideal::{Seen, render_ideal, see_ideal};
use alberti_oracle::scene as oracle;
use alberti_tests::reference::with_scene;

/// The picture of a ray through each pixel's centre, with the nearest texel.
pub fn by_rays(scene: &Scene, size: [u32; 2]) -> Vec<[u8; 4]> {
    drawn(scene, &scene.options(size, Filter::Nearest), |drawn| render_ideal(drawn).pixels)
}

/// The point that each of these rays meets.
pub fn points(scene: &Scene, size: [u32; 2]) -> Vec<Option<Seen>> {
    drawn(scene, &scene.options(size, Filter::Nearest), see_ideal)
}

/// Rays along a side of a pixel.
const ALONG: u32 = 8;

/// The mean light of 64 rays a pixel, with a bilinear filter at each.
pub fn by_area(scene: &Scene, size: [u32; 2]) -> Vec<[u8; 4]> {
    let [width, height] = size.map(|side| side * ALONG);
    let options = RenderOptions { width, height, ..scene.options(size, Filter::Bilinear) };
    let fine = drawn(scene, &options, |drawn| render_ideal(drawn).pixels);
    let light = light_of_bytes();
    let mut sums = vec![[0.0; 3]; pixels(size)];
    for (row, line) in fine.chunks(width as usize).enumerate() {
        let first = row / ALONG as usize * size[0] as usize;
        for (k, [r, g, b, _]) in line.iter().enumerate() {
            let sum: &mut [f64; 3] = &mut sums[first + k / ALONG as usize];
            for (sum, byte) in sum.iter_mut().zip([r, g, b]) {
                *sum += light[usize::from(*byte)];
            }
        }
    }
    let byte = |sum: f64| encode(sum / f64::from(ALONG * ALONG));
    sums.into_iter()
        .map(|sum| {
            let [r, g, b] = sum.map(byte);
            [r, g, b, 255]
        })
        .collect()
}

fn drawn<R>(scene: &Scene, options: &RenderOptions, draw: impl FnOnce(&oracle::Scene<'_>) -> R) -> R {
    with_scene(&scene.model, &scene.camera, options, draw)
}

/// The light of each sRGB byte, by IEC 61966-2-1.
fn light_of_bytes() -> [f64; 256] {
    std::array::from_fn(|byte| {
        let c = f64::from(u8::try_from(byte).unwrap_or(u8::MAX)) / 255.0;
        if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

fn encode(light: f64) -> u8 {
    let c = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    let byte = (c * 255.0).round() as u8;
    byte
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_back_from_their_light() {
        for (byte, light) in (0..=255).zip(light_of_bytes()) {
            assert_eq!(encode(light), byte);
        }
        // The mean of black and white, as photographers know it.
        assert_eq!(encode(0.5), 188);
    }
}
