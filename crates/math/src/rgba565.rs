//! A colour of 16 bits with alpha, ready to be mixed with a pixel by one product.

use crate::Rgba8;

/// Red, green and blue of 5, 6 and 5 bits, multiplied by alpha. And the share that stays of a pixel behind, in 32nds
/// from 0 to 32.
///
/// ```text
/// bit 31   26 25 24     21 20  16 15     10 9    5 4 3     0
///      green   1   0 ... 0   red    share    blue  1 0 ... 0
/// ```
///
/// The fields are apart as in a 16-bit pixel that is repeated in both halves of a word and masked. That times the
/// share, and this word, add up to the mean, times 32: ones below green and blue round it, the share does below red.
///
/// # Precision
/// Of a mean in RGB565: each channel is within 1.5 levels, green 2, of that in reals of the colour and the pixel. An
/// opaque colour replaces the pixel, and one with an alpha of 3 and less keeps it. No sum with a word of
/// [`new`](Self::new) carries from one field to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Rgba565(u32);

/// The place of a channel, and its greatest level.
const CHANNELS: [(u32, u32); 3] = [(16, 31), (26, 63), (5, 31)];
/// The place of the share.
const SHARE: u32 = 10;
/// The ones that round.
const HALVES: u32 = 1 << 25 | 1 << 4;

impl Rgba565 {
    /// The word of a colour. Where a level were so large that the sum left its field, it is the largest that does not.
    ///
    /// ```
    /// use alberti_math::{Rgba8, Rgba565};
    ///
    /// let red = Rgba565::new(Rgba8::new(255, 0, 0, 255));
    /// assert_eq!(red.to_bits() & 31 << 16, 31 << 16);
    /// assert_eq!(red.to_rgba8(), Rgba8::new(255, 0, 0, 255));
    /// ```
    #[must_use]
    pub const fn new(color: Rgba8) -> Self {
        let channels = color.to_bytes();
        let alpha = channels[3] as u32;
        let share = ((255 - alpha) * 32 + 127) / 255;
        let mut word = HALVES | share << SHARE;
        let mut k = 0;
        while k < CHANNELS.len() {
            let (place, greatest) = CHANNELS[k];
            let halves = below(k, share);
            // In 64ths of 255 · 255ths.
            let level = (64 * greatest * channels[k] as u32 * alpha + (64 - halves) * 65025) / (64 * 65025);
            let most = (64 * greatest + 62 - halves - 2 * greatest * share) / 64;
            word |= (if level < most { level } else { most }) << place;
            k += 1;
        }
        Self(word)
    }

    /// The colour nearest to the word's, not multiplied by alpha: black where alpha is 0.
    ///
    /// # Precision
    /// [`new`](Self::new) of it is the word, if that is one of `new`.
    #[must_use]
    pub const fn to_rgba8(self) -> Rgba8 {
        let share = self.0 >> SHARE & 63;
        let alpha = (32_u32.saturating_sub(share) * 255 + 16) / 32;
        let mut channels = [0; 3];
        let mut k = 0;
        while k < CHANNELS.len() && alpha > 0 {
            let (place, greatest) = CHANNELS[k];
            let level = (64 * (self.0 >> place & greatest) + below(k, share)).saturating_sub(32);
            let unit = 64 * greatest * alpha;
            let byte = (level * 65025 + unit / 2) / unit;
            channels[k] = if byte < 255 { byte.to_le_bytes()[0] } else { 255 };
            k += 1;
        }
        let [r, g, b] = channels;
        Rgba8::new(r, g, b, alpha.to_le_bytes()[0])
    }

    /// The word with these bits. Of others than [`new`](Self::new) has, sums carry from field to field.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The bits of the word.
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }
}

/// The part of a channel below its level, in 64ths of it: a half, or the share. That of a colour alone rounds nothing.
const fn below(channel: usize, share: u32) -> u32 {
    if channel == 0 && 0 < share && share < 32 { share } else { 32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Red, green and blue of a 16-bit pixel.
    fn levels(pixel: u32) -> [u32; 3] {
        [pixel >> 11 & 31, pixel >> 5 & 63, pixel & 31]
    }

    /// All alphas, all bytes of a channel, and all levels of a pixel.
    #[test]
    fn sums_are_means_and_stay_in_their_fields() {
        for (alpha, byte) in (0..=255).flat_map(|alpha| (0..=255).map(move |byte| (alpha, byte))) {
            let word = Rgba565::new(Rgba8::new(byte, byte, byte, alpha)).to_bits();
            let share = u64::from(word >> 10 & 63);
            let [real, a] = [byte, alpha].map(|part| f64::from(part) / 255.0);
            for old in 0..64 {
                let before = [old.min(31), old, old.min(31)];
                let apart = u64::from(before[1] << 21 | before[0] << 11 | before[2]);
                let sum = u32::try_from(apart * share + u64::from(word)).expect("32 bits");
                let mean = sum >> 5 & 0x07e0_f81f;
                let found = levels(mean | mean >> 16);
                for (channel, greatest) in [31.0, 63.0, 31.0].into_iter().enumerate() {
                    let mean = greatest * real * a + f64::from(before[channel]) * (1.0 - a);
                    let off = (f64::from(found[channel]) - mean).abs();
                    assert!(off < [1.5, 2.0, 1.5][channel], "{byte} {alpha} over {before:?}: {found:?}");
                    match alpha {
                        // An opaque one is the nearest.
                        255 => assert!(off <= 0.5, "{byte} over {before:?}: {found:?}"),
                        0..=3 => assert_eq!(found, before, "{byte} {alpha}"),
                        _ => {}
                    }
                }
            }
        }
    }

    #[test]
    fn words_are_those_of_their_colors() {
        let mut words = 0;
        for (alpha, byte) in (0..=255).flat_map(|alpha| (0..=255).map(move |byte| (alpha, byte))) {
            let word = Rgba565::new(Rgba8::new(byte, 255 - byte, byte, alpha));
            let color = word.to_rgba8();
            assert_eq!(Rgba565::new(color), word, "{byte} {alpha}: {color:?}");
            // Half a step of alpha, and of a level a whole one, as the sum may have had no room for it.
            let [r, g, b, a] = color.to_bytes().map(f64::from);
            assert!((a - f64::from(alpha)).abs() < 4.5, "{alpha}: {color:?}");
            let step = |greatest: f64| 255.0 * 255.0 / (greatest * a) + 255.0 * 4.5 / a;
            for (found, byte, step) in [(r, byte, 31.0), (g, 255 - byte, 63.0), (b, byte, 31.0)]
                .map(|(found, byte, greatest)| (found, byte, step(greatest)))
            {
                assert!(a == 0.0 || (found - f64::from(byte)).abs() <= step, "{byte} {alpha}: {color:?}");
            }
            words += 1;
        }
        assert_eq!(words, 65536);
        // A colour there is of any bits.
        for k in 0..100_000_u32 {
            let _ = Rgba565::from_bits(k.wrapping_mul(0x9e37_79b1)).to_rgba8();
        }
    }
}
