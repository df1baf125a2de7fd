//! Depth buffers: the formats of depths, and the comparisons that tell which of two is seen.

use alberti_math::lanes::Lanes;
use core::fmt::Debug;

/// A format of depth values, and the comparison that goes with it: [`D16`] and the others of this module, or
/// [`AnyDepth`] for one that is chosen at run time.
///
/// Depths reach the buffer as zs in [0, 1], 0 at the near plane, or 1 there where the format is
/// [`reversed`](Self::reversed). A new fragment is seen if it is strictly nearer than the stored depth; of two equal
/// ones, the first drawn stays.
pub trait DepthFormat: Copy + Debug + Send + Sync + 'static {
    /// The buffer's value for a pixel.
    type Stored: Copy + Debug + Send + Sync + 'static;

    /// Whether zs falls with distance.
    #[inline(always)]
    fn reversed(self) -> bool {
        false
    }

    /// The farthest depth.
    fn farthest(self) -> Self::Stored;

    /// The stored value nearest to `zs`, which must be in [0, 1].
    fn encode(self, zs: f32) -> Self::Stored;

    /// The bits of a stored integer that is zs·(2^bits − 1) to the nearest, at most 31; 31 as well for all else. Where
    /// nothing is stored there are 16: with few, more small triangles have a short way in fixed point.
    #[inline(always)]
    fn bits(self) -> u32 {
        31
    }

    /// [`encode`](Self::encode) for an even word of which the highest [`bits`](Self::bits) count, and have been
    /// rounded.
    #[inline]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
    fn encode_integer(self, zs: u32) -> Self::Stored {
        self.encode((zs as f32 * (1.0 / 4_294_967_296.0)).min(1.0))
    }

    /// Whether triangles are moved by [`bias`](Self::bias).
    const BIASED: bool = false;

    /// The zs that is added to a triangle. Its own zs is at most `greatest`, and changes by at most `slope` from a
    /// pixel to the next, by column or by row.
    #[inline]
    fn bias(self, slope: f32, greatest: f32) -> f32 {
        let _ = (slope, greatest);
        0.0
    }

    /// The same for fixed point, in steps of 2^-31.
    #[inline]
    fn bias_steps(self, slope: u32, greatest: u32) -> i64 {
        let _ = (slope, greatest);
        0
    }

    /// Whether `new` is seen in front of `old`.
    fn nearer(self, new: Self::Stored, old: Self::Stored) -> bool;

    /// [`encode`](Self::encode) for several samples.
    #[inline(always)]
    fn encode_lanes<L: Lanes>(self, lanes: L, zs: L::Depth) -> L::Each<Self::Stored> {
        lanes.each_depth(zs, |zs| self.encode(zs), |zs| self.encode_integer(zs))
    }

    /// Those of the samples in `mask` for which `new` is [`nearer`](Self::nearer) than `old`.
    #[inline(always)]
    fn seen<L: Lanes>(
        self,
        lanes: L,
        new: &L::Each<Self::Stored>,
        old: &L::Each<Self::Stored>,
        mask: L::Mask,
    ) -> L::Mask {
        let nearer = lanes.each(|k| match (new.as_ref().get(k), old.as_ref().get(k)) {
            (Some(&new), Some(&old)) => u32::from(self.nearer(new, old)) << k,
            _ => 0,
        });
        mask & lanes.mask(nearer.as_ref().iter().fold(0, |bits, bit| bits | bit))
    }

    /// Stores `new` for the samples in `mask`.
    #[inline(always)]
    fn keep<L: Lanes>(
        self,
        lanes: L,
        new: &L::Each<Self::Stored>,
        mask: L::Mask,
        stored: &mut L::Each<Self::Stored>,
    ) {
        let bits = lanes.bits(mask);
        for (k, (stored, new)) in stored.as_mut().iter_mut().zip(new.as_ref()).enumerate() {
            *stored = if bits >> k & 1 != 0 { *new } else { *stored };
        }
    }
}

/// No depth buffer: everything is seen, in drawing order. Its buffer is a slice of `()`, which takes no memory; depth
/// is not computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoDepth;

/// 16-bit integers: zs·65535 to the nearest, halves upwards.
///
/// # Precision
/// Steps of 2^-16 in zs: at far plane B and near plane 1, surfaces 0.15 apart can be told apart for B = 100, 15 for
/// B = 1000.
///
/// # Cost
/// Two bytes a pixel. From `f32`, rounding is a product of 64 bits: eight operations with several lanes, some 60
/// instructions on a Cortex-M4F; in fixed point it is a shift.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct D16;

/// 24-bit integers in a `u32`: zs·(2^24 − 1) to the nearest, halves upwards.
///
/// # Precision
/// Steps of 2^-24 in zs: 256 times finer than [`D16`].
///
/// # Cost
/// Four bytes a pixel; else that of [`D16`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct D24;

/// 32-bit integers: zs·(2^32 − 1) to the nearest, halves upwards.
///
/// # Precision
/// Finer than the `f32` that depths are computed in, for which see [`F32`]; the same for every distance.
///
/// # Cost
/// That of [`D24`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct D32;

/// `f32`, growing with distance.
///
/// # Precision
/// Steps of 2^-24 near zs = 1, where perspective puts nearly everything: no better than [`D24`].
///
/// # Cost
/// Four bytes a pixel, stored as computed: the cheapest where there are floats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct F32;

/// `f32`, falling with distance: the best there is, and no slower.
///
/// # Precision
/// Relative steps of 2^-24 in z itself, at any ratio of the planes.
///
/// # Cost
/// That of [`F32`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct F32Reversed;

impl DepthFormat for NoDepth {
    type Stored = ();
    #[inline(always)]
    fn farthest(self) {}
    #[inline]
    fn encode(self, _: f32) {}
    #[inline]
    fn encode_integer(self, _: u32) {}
    #[inline(always)]
    fn bits(self) -> u32 {
        16
    }
    #[inline]
    fn nearer(self, (): (), (): ()) -> bool {
        true
    }
    #[inline(always)]
    fn seen<L: Lanes>(self, _: L, _: &L::Each<()>, _: &L::Each<()>, mask: L::Mask) -> L::Mask {
        mask
    }
}

impl DepthFormat for D16 {
    type Stored = u16;
    #[inline(always)]
    fn farthest(self) -> u16 {
        u16::MAX
    }
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^16 - 1")]
    fn encode(self, zs: f32) -> u16 {
        quantize::<16>(zs) as u16
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        16
    }
    #[inline]
    fn encode_integer(self, zs: u32) -> u16 {
        (zs >> 16) as u16
    }
    #[inline]
    fn nearer(self, new: u16, old: u16) -> bool {
        new < old
    }
}

impl DepthFormat for D24 {
    type Stored = u32;
    #[inline(always)]
    fn farthest(self) -> u32 {
        (1 << 24) - 1
    }
    #[inline]
    fn encode(self, zs: f32) -> u32 {
        quantize::<24>(zs)
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        24
    }
    #[inline]
    fn encode_integer(self, zs: u32) -> u32 {
        zs >> 8
    }
    #[inline]
    fn nearer(self, new: u32, old: u32) -> bool {
        new < old
    }
}

impl DepthFormat for D32 {
    type Stored = u32;
    #[inline(always)]
    fn farthest(self) -> u32 {
        u32::MAX
    }
    #[inline]
    fn encode(self, zs: f32) -> u32 {
        quantize::<32>(zs)
    }
    #[inline]
    fn encode_integer(self, zs: u32) -> u32 {
        // The highest bit again as the last, so that the greatest becomes the greatest.
        zs | zs >> 31
    }
    #[inline]
    fn nearer(self, new: u32, old: u32) -> bool {
        new < old
    }
}

impl DepthFormat for F32 {
    type Stored = f32;
    #[inline(always)]
    fn farthest(self) -> f32 {
        1.0
    }
    #[inline]
    fn encode(self, zs: f32) -> f32 {
        zs
    }
    #[inline]
    fn nearer(self, new: f32, old: f32) -> bool {
        new < old
    }
    #[inline(always)]
    fn seen<L: Lanes>(self, lanes: L, new: &L::Each<f32>, old: &L::Each<f32>, mask: L::Mask) -> L::Mask {
        mask & lanes.less_in_memory(new, old)
    }
    #[inline(always)]
    fn keep<L: Lanes>(self, lanes: L, new: &L::Each<f32>, mask: L::Mask, stored: &mut L::Each<f32>) {
        lanes.copy_where(mask, new, stored);
    }
}

impl DepthFormat for F32Reversed {
    type Stored = f32;
    #[inline(always)]
    fn reversed(self) -> bool {
        true
    }
    #[inline(always)]
    fn farthest(self) -> f32 {
        0.0
    }
    #[inline]
    fn encode(self, zs: f32) -> f32 {
        zs
    }
    #[inline]
    fn nearer(self, new: f32, old: f32) -> bool {
        new > old
    }
    #[inline(always)]
    fn seen<L: Lanes>(self, lanes: L, new: &L::Each<f32>, old: &L::Each<f32>, mask: L::Mask) -> L::Mask {
        mask & lanes.less_in_memory(old, new)
    }
    #[inline(always)]
    fn keep<L: Lanes>(self, lanes: L, new: &L::Each<f32>, mask: L::Mask, stored: &mut L::Each<f32>) {
        lanes.copy_where(mask, new, stored);
    }
}

/// One of the formats, chosen at run time. Depths are words of 32 bits, of which the lesser is the nearer one.
///
/// # Precision
/// That of the format, whose pictures it makes, bit for bit.
///
/// # Cost
/// Four bytes a pixel. For the samples that are worked on together a match, which is predictable, and with `f32` an
/// operation or two; rounding to integers as for these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyDepth {
    /// [`NoDepth`], but with a buffer.
    NoDepth,
    /// [`D16`].
    D16,
    /// [`D24`].
    D24,
    /// [`D32`].
    D32,
    /// [`F32`].
    F32,
    /// [`F32Reversed`].
    F32Reversed,
}

impl DepthFormat for AnyDepth {
    type Stored = u32;

    #[inline(always)]
    fn reversed(self) -> bool {
        self == Self::F32Reversed
    }

    #[inline]
    fn farthest(self) -> u32 {
        match self {
            Self::NoDepth | Self::D32 | Self::F32Reversed => u32::MAX,
            Self::D16 => D16.farthest().into(),
            Self::D24 => D24.farthest(),
            Self::F32 => F32.farthest().to_bits(),
        }
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        match self {
            Self::NoDepth => NoDepth.bits(),
            Self::D16 => D16.bits(),
            Self::D24 => D24.bits(),
            _ => 31,
        }
    }

    // Numbers that are not negative are in the order of their words.
    #[inline(always)]
    fn encode(self, zs: f32) -> u32 {
        match self {
            Self::NoDepth => 0,
            Self::D16 => D16.encode(zs).into(),
            Self::D24 => D24.encode(zs),
            Self::D32 => D32.encode(zs),
            Self::F32 => zs.to_bits() & 0x7fff_ffff,
            Self::F32Reversed => !(zs.to_bits() & 0x7fff_ffff),
        }
    }

    #[inline(always)]
    fn encode_integer(self, zs: u32) -> u32 {
        match self {
            Self::NoDepth => 0,
            Self::D16 => D16.encode_integer(zs).into(),
            Self::D24 => D24.encode_integer(zs),
            Self::D32 => D32.encode_integer(zs),
            Self::F32 => F32.encode_integer(zs).to_bits(),
            Self::F32Reversed => !F32Reversed.encode_integer(zs).to_bits(),
        }
    }

    #[inline]
    fn nearer(self, new: u32, old: u32) -> bool {
        new < old || self == Self::NoDepth
    }

    // A match around the lanes, not in each. Rounding to integers is not inlined: it is long, and its call little.
    #[inline(always)]
    fn encode_lanes<L: Lanes>(self, lanes: L, zs: L::Depth) -> L::Each<u32> {
        let flip = match self {
            Self::NoDepth => return lanes.each(|_| 0),
            Self::F32 => 0,
            Self::F32Reversed => u32::MAX,
            _ => return self.encode_integers(lanes, zs),
        };
        lanes.each_depth(
            zs,
            |zs| (zs.to_bits() & 0x7fff_ffff) ^ flip,
            |zs| F32.encode_integer(zs).to_bits() ^ flip,
        )
    }

    #[inline(always)]
    fn seen<L: Lanes>(self, lanes: L, new: &L::Each<u32>, old: &L::Each<u32>, mask: L::Mask) -> L::Mask {
        if self == Self::NoDepth {
            return mask;
        }
        mask & lanes.less_words(lanes.load_words(new), lanes.load_words(old))
    }

    #[inline(always)]
    fn keep<L: Lanes>(self, lanes: L, new: &L::Each<u32>, mask: L::Mask, stored: &mut L::Each<u32>) {
        *stored =
            lanes.store_words(lanes.select_words(mask, lanes.load_words(new), lanes.load_words(stored)));
    }
}

impl AnyDepth {
    #[inline(never)]
    fn encode_integers<L: Lanes>(self, lanes: L, zs: L::Depth) -> L::Each<u32> {
        lanes.vectorize(
            #[inline(always)]
            || lanes.each_depth(zs, |zs| self.encode(zs), |zs| self.encode_integer(zs)),
        )
    }
}

/// zs·(2^BITS − 1) to the nearest integer, halves upwards, from the bits of `zs` in [0, 1]: exact, where a product in
/// `f32` would round twice.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the result has BITS <= 32 bits")]
fn quantize<const BITS: u32>(zs: f32) -> u32 {
    // Without the sign, so that -0 is 0.
    let bits = zs.to_bits() & 0x7fff_ffff;
    // zs = mantissa * 2^-shift; the product has at most 56 bits, and from a shift of 57 on it rounds to 0.
    let mantissa = u64::from((bits & 0x007f_ffff) | 0x0080_0000);
    let shift = 150u32.saturating_sub(bits >> 23).clamp(1, 63);
    ((mantissa * ((1 << BITS) - 1) + (1 << (shift - 1))) >> shift) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In 128 bits: floor((2 m (2^n - 1) + 2^s) / 2^(s+1)) with zs = m / 2^s and s fixed at 90.
    fn exact(zs: f32, max: u128) -> u128 {
        let scaled = f64::from(zs) * 2f64.powi(90);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an integer below 2^91")]
        let m = scaled as u128;
        (2 * m * max + (1 << 90)) >> 91
    }

    #[test]
    fn quantisation_is_correctly_rounded() {
        for bits in (0..=1.0f32.to_bits()).step_by(1013).chain([1.0f32.to_bits()]) {
            let zs = f32::from_bits(bits);
            if zs < 2f32.powi(-60) {
                assert_eq!((D16.encode(zs), D24.encode(zs), D32.encode(zs)), (0, 0, 0), "{zs:e}");
                continue;
            }
            assert_eq!(u128::from(D16.encode(zs)), exact(zs, 0xffff), "{zs:e}");
            assert_eq!(u128::from(D24.encode(zs)), exact(zs, 0xff_ffff), "{zs:e}");
            assert_eq!(u128::from(D32.encode(zs)), exact(zs, 0xffff_ffff), "{zs:e}");
        }
    }

    #[test]
    fn halves_go_up_and_the_ends_are_the_ends() {
        assert_eq!((D16.encode(0.0), D16.encode(1.0)), (0, D16.farthest()));
        assert_eq!((D24.encode(0.0), D24.encode(1.0)), (0, D24.farthest()));
        assert_eq!((D16.encode(-0.0), D24.encode(-0.0)), (0, 0));
        assert_eq!(D16.encode(0.5), 32768);
        assert_eq!(D24.encode(0.5), 1 << 23);
    }

    #[test]
    fn the_farthest_is_never_seen_before_itself() {
        assert!(!D16.nearer(D16.farthest(), D16.farthest()));
        assert!(F32.nearer(0.5, F32.farthest()) && !F32.nearer(1.0, F32.farthest()));
        assert!(F32Reversed.nearer(0.5, F32Reversed.farthest()) && !F32Reversed.nearer(0.0, 0.0));
    }
}
