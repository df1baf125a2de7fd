//! The packed colour that texels are read as and pixels are written from, and the formats that both are stored in.

/// A colour of four bytes, red in the low byte: in memory R, G, B, A on little-endian machines.
///
/// The bytes are sRGB-encoded wherever they come from a texture or go to a target; alpha is linear.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "[u8; 4]", into = "[u8; 4]"))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Rgba8(u32);

impl Rgba8 {
    /// Opaque black.
    pub const BLACK: Self = Self::new(0, 0, 0, 255);
    /// Opaque white.
    pub const WHITE: Self = Self::new(255, 255, 255, 255);

    /// The colour with these four bytes.
    #[must_use]
    pub const fn new(r: u8, g: u8, b: u8, a: u8) -> Self {
        Self(u32::from_le_bytes([r, g, b, a]))
    }

    /// The opaque colour `0xRRGGBB`.
    #[must_use]
    pub const fn from_rgb24(rgb: u32) -> Self {
        let [_, r, g, b] = rgb.to_be_bytes();
        Self::new(r, g, b, 255)
    }

    /// The colour whose bytes are R, G, B, A from the lowest to the highest.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// R, G, B, A from the lowest byte to the highest.
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }

    /// The four bytes R, G, B, A.
    #[must_use]
    pub const fn to_bytes(self) -> [u8; 4] {
        self.0.to_le_bytes()
    }
}

/// Four bytes: in memory red, green, blue, alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgba8888;

/// Two bytes, the low one first: RRRRRGGG GGGBBBBB as a little-endian word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb565Le;

/// Two bytes, the high one first, as most SPI displays want them: RRRRRGGG GGGBBBBB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb565Be;

/// A byte: RRRGGGBB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb332;

named!(Rgba8888, Rgb565Le, Rgb565Be, Rgb332);

/// Red, green, blue, alpha.
impl From<[u8; 4]> for Rgba8 {
    fn from([r, g, b, a]: [u8; 4]) -> Self {
        Self::new(r, g, b, a)
    }
}

/// Red, green, blue, alpha.
impl From<Rgba8> for [u8; 4] {
    fn from(color: Rgba8) -> Self {
        color.to_bytes()
    }
}

impl core::fmt::Debug for Rgba8 {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let [r, g, b, a] = self.to_bytes();
        write!(f, "Rgba8({r}, {g}, {b}, {a})")
    }
}
