//! Answers in integers of 128 bits, by the definitions, and random numbers.

use alberti_math::Rgba8;
use alberti_texture::TexelFormat;

/// A format of another crate: the texel is its own index, so that a sample says which texel it has taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Index;

impl TexelFormat for Index {
    type Texel = u16;

    fn decode(self, texel: u16) -> Rgba8 {
        Rgba8::from_bits(u32::from(texel))
    }

    fn encode(self, color: Rgba8) -> u16 {
        let [low, high, ..] = color.to_bytes();
        u16::from_le_bytes([low, high])
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mode {
    Repeat,
    Clamp,
    Mirror,
}

pub(crate) const MODES: [Mode; 3] = [Mode::Repeat, Mode::Clamp, Mode::Mirror];

impl Mode {
    /// The texel at an index of the continued row.
    pub(crate) fn index(self, n: i128, size: u32) -> u32 {
        let size = i128::from(size);
        let index = match self {
            Self::Repeat => n.rem_euclid(size),
            Self::Clamp => n.clamp(0, size - 1),
            Self::Mirror if n.rem_euclid(2 * size) < size => n.rem_euclid(2 * size),
            Self::Mirror => size - 1 - n.rem_euclid(size),
        };
        u32::try_from(index).unwrap()
    }

    /// The coordinate as a whole number of 2^-150ths or more: a significand and a number of halvings (negative:
    /// doublings). The values that have no place on the number line get the one that is documented.
    pub(crate) fn rational(self, u: f32) -> (i128, i32) {
        let bits = u.to_bits();
        let exponent = i32::try_from(bits >> 23 & 255).unwrap();
        let fraction = i128::from(bits & 0x7f_ffff);
        let magnitude = if exponent == 0 { fraction } else { fraction + 0x80_0000 };
        let significand = if u.is_sign_negative() { -magnitude } else { magnitude };
        let halvings = 150 - exponent.max(1);
        match self {
            _ if u.is_nan() => (0, 0),
            Self::Clamp if u >= 1e6 => (1_000_000, 0),
            Self::Clamp if u <= -1e6 => (-1_000_000, 0),
            // A multiple of 2.
            _ if halvings < 0 => (0, 0),
            _ => (significand, halvings),
        }
    }

    /// floor(u * size), then the texel there.
    pub(crate) fn cell(self, u: f32, size: u32) -> u32 {
        let (significand, halvings) = self.rational(u);
        let n = match significand * i128::from(size) {
            scaled if halvings > 100 => -i128::from(scaled < 0),
            scaled => scaled.div_euclid(1 << halvings),
        };
        self.index(n, size)
    }
}

/// Xorshift with a multiplication (Vigna 2016, xorshift64*).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        u32::try_from(self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 32).unwrap()
    }

    /// Any float.
    pub(crate) fn float(&mut self) -> f32 {
        f32::from_bits(self.bits())
    }

    /// A float from -4 to 4, more of them near 0, where there are more.
    pub(crate) fn near_zero(&mut self) -> f32 {
        let sign_and_significand = self.bits() & 0x807f_ffff;
        f32::from_bits(sign_and_significand | (128 - (self.bits() % 45).min(self.bits() % 45)) << 23)
    }
}

pub(crate) const SPECIAL: [f32; 26] = [
    0.0,
    -0.0,
    f32::NAN,
    -f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    f32::MIN,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-45,
    -1e-45,
    -1.8e-12,
    -1.9e-12,
    -1e-8,
    -5.9e-8,
    0.999_999_94,
    -0.999_999_94,
    1.0,
    -1.0,
    8_388_608.0,
    -8_388_608.0,
    8_388_609.0,
    -8_388_607.5,
    8191.999,
    -8192.0,
];
