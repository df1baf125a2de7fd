//! Colour maps for numbers: readable in print, and without telling red from green, since lightness alone tells more
//! from less.

/// Colours at equal distances along viridis, the map of matplotlib by van der Walt and Smith.
const VIRIDIS: [[u8; 3]; 9] = [
    [0x44, 0x01, 0x54],
    [0x47, 0x2d, 0x7b],
    [0x3b, 0x52, 0x8b],
    [0x2c, 0x72, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x28, 0xae, 0x80],
    [0x5e, 0xc9, 0x62],
    [0xad, 0xdc, 0x30],
    [0xfd, 0xe7, 0x25],
];

/// From dark violet at 0 to light yellow at 1; NaN and all below are 0.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "from 0 to 255"
)]
pub fn viridis(t: f32) -> [u8; 3] {
    let along = if t > 0.0 { t.min(1.0) } else { 0.0 } * (VIRIDIS.len() - 1) as f32;
    let first = (along as usize).min(VIRIDIS.len() - 2);
    let part = along - first as f32;
    let between = |k: usize| {
        let [from, to] = [VIRIDIS[first][k], VIRIDIS[first + 1][k]].map(f32::from);
        (from + (to - from) * part + 0.5) as u8
    };
    [between(0), between(1), between(2)]
}

/// The lightness of an sRGB colour, from 0 to 255, as the eye weighs its channels.
#[must_use]
pub fn luma([r, g, b]: [u8; 3]) -> f32 {
    0.299 * f32::from(r) + 0.587 * f32::from(g) + 0.114 * f32::from(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear light, in which eyes of all kinds add.
    fn linear(color: [u8; 3]) -> [f64; 3] {
        color.map(|c| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        })
    }

    /// L* of CIELAB, of which a step of 1 is about the least that is seen.
    fn lightness(color: [u8; 3]) -> f64 {
        let [r, g, b] = linear(color);
        116.0 * (0.2126 * r + 0.7152 * g + 0.0722 * b).cbrt() - 16.0
    }

    /// The colour as those see it who have no cones for red, or for green, by the matrices of Viénot, Brettel and
    /// Mollon (1999); as a lightness.
    fn without(green: bool, color: [u8; 3]) -> f64 {
        let [r, g, b] = linear(color);
        let seen = if green { 0.29275 * r + 0.70725 * g } else { 0.11238 * r + 0.88762 * g };
        116.0 * (0.9278 * seen + 0.0722 * b).cbrt() - 16.0
    }

    #[test]
    fn more_is_lighter_for_every_eye_and_in_print() {
        let colors: Vec<_> = (0..=32u8).map(|k| viridis(f32::from(k) / 32.0)).collect();
        for pair in colors.windows(2) {
            let eyes: [&dyn Fn([u8; 3]) -> f64; 3] =
                [&lightness, &|color| without(true, color), &|color| without(false, color)];
            for eye in eyes {
                let step = eye(pair[1]) - eye(pair[0]);
                assert!((1.0..4.5).contains(&step), "{pair:x?} {step}");
            }
        }
    }

    #[test]
    fn the_ends_are_the_ends() {
        assert_eq!([viridis(0.0), viridis(-3.0), viridis(f32::NAN)], [[0x44, 0x01, 0x54]; 3]);
        assert_eq!([viridis(1.0), viridis(f32::INFINITY)], [[0xfd, 0xe7, 0x25]; 2]);
    }
}
