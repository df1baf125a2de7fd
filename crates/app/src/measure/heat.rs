//! False colours: from black through purple and orange to nearly white, ever lighter, so that grey prints keep the
//! order.

use flip_rs::MAGMA;

/// The colour of an error from 0 to 1, by the map "magma" of matplotlib in 256 steps. Exactly 0 is black, and the least
/// of others is nearly so. Errors above 1 have the colour of 1, as has NaN.
#[must_use]
pub fn color(error: f32) -> [u8; 4] {
    if error <= 0.0 {
        return [0, 0, 0, 255];
    }
    let shade = if error < 1.0 { byte(error) } else { 255 };
    let [red, green, blue] = MAGMA[usize::from(shade)].map(byte);
    [red, green, blue, 255]
}

/// The nearest of 256 steps from 0 to 1.
fn byte(share: f32) -> u8 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 1, and `as` saturates")]
    let byte = (share * 255.0).round() as u8;
    byte
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn larger_errors_are_lighter() {
        let luminance = |error: f32| {
            let [red, green, blue, alpha] = color(error).map(f32::from);
            assert_eq!(alpha, 255.0);
            0.2126 * red + 0.7152 * green + 0.0722 * blue
        };
        let scale: Vec<f32> = (0_u8..=64).map(|i| luminance(f32::from(i) / 64.0)).collect();
        assert!(scale.is_sorted_by(|a, b| a < b), "{scale:?}");
    }

    /// `matplotlib.colormaps["magma"](64)` of matplotlib 3.11.2 is (0.316654, 0.07169, 0.48538), of 127 (0.709962,
    /// 0.212797, 0.477201), of 255 (0.987053, 0.991438, 0.749504).
    #[test]
    fn the_map_is_magma() {
        assert_eq!(color(0.0), [0, 0, 0, 255]);
        assert_eq!(color(64.0 / 255.0), [81, 18, 124, 255]);
        assert_eq!(color(127.0 / 255.0), [181, 54, 122, 255]);
        assert_eq!([1.0, 7.0, f32::INFINITY, f32::NAN].map(color), [[252, 253, 191, 255]; 4]);
    }
}
