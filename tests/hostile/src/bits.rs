//! Cases made of bytes: every byte counts, and after the last come zeros, so that any bytes are a case.

/// Bytes that are taken from the front.
#[derive(Clone, Debug)]
pub struct Bits<'a> {
    rest: &'a [u8],
}

/// Numbers that go wrong first.
const NASTY: [f32; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    0.1,
    10.0,
    f32::MAX,
    f32::MIN,
    f32::MAX / 16.0,
    f32::MIN_POSITIVE,
    1e-45,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    1e9,
    1e30,
    1e-30,
    16_777_217.0,
    2_147_483_648.0,
    -32768.0,
    255.0 / 256.0,
    1.0 + f32::EPSILON,
    1.0 - f32::EPSILON / 2.0,
];

impl<'a> Bits<'a> {
    /// A case of these bytes.
    #[must_use]
    pub const fn new(rest: &'a [u8]) -> Self {
        Self { rest }
    }

    /// Whether all bytes are taken.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// The bytes that are left.
    #[must_use]
    pub const fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next bytes.
    pub fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut taken = [0; N];
        let count = N.min(self.rest.len());
        let (head, rest) = self.rest.split_at(count);
        taken[..count].copy_from_slice(head);
        self.rest = rest;
        taken
    }

    /// A byte.
    pub fn byte(&mut self) -> u8 {
        let [byte] = self.bytes();
        byte
    }

    /// A bit.
    pub fn bit(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// A word.
    pub fn word(&mut self) -> u32 {
        u32::from_le_bytes(self.bytes())
    }

    /// A number below `count`, which is at most 65536 and not 0.
    pub fn below(&mut self, count: usize) -> usize {
        if count <= 256 {
            return usize::from(self.byte()) % count.max(1);
        }
        usize::from(u16::from_le_bytes(self.bytes())) % count
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// An integer between two, both of which it may be.
    pub fn between(&mut self, least: i64, most: i64) -> i64 {
        let span = (most - least).cast_unsigned() + 1;
        least + (u64::from_le_bytes(self.bytes()) % span).cast_signed()
    }

    /// A float: of any bits, one of those that go wrong first, or a moderate one.
    pub fn float(&mut self) -> f32 {
        match self.byte() {
            0..96 => self.moderate(),
            96..160 => {
                let [low, high] = self.bytes();
                f32::from(i16::from_le_bytes([low, high])) * 2f32.powi(i32::from(self.byte()) - 140)
            }
            160..192 => self.pick(&NASTY),
            _ => f32::from_bits(self.word()),
        }
    }

    /// A float from -8 to 8, in steps of 1/4096.
    pub fn moderate(&mut self) -> f32 {
        f32::from(i16::from_le_bytes(self.bytes())) / 4096.0
    }

    /// Several floats.
    pub fn floats<const N: usize>(&mut self) -> [f32; N] {
        [(); N].map(|()| self.float())
    }

    /// A float that is finite.
    pub fn finite(&mut self) -> f32 {
        let x = self.float();
        if x.is_finite() { x } else { 0.0 }
    }
}
