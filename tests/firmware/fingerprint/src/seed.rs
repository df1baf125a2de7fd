//! The numbers that a scene is made of, and the memory of its frame.

use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::texture::format::Rgba8888;
use alberti::texture::mipmap;
use alberti::texture::{AnyFilter, AnyMipFilter, AnyWrap};
use alberti::{
    AnyDepth, AnyProjection, Cull, Frame, Object, Parallel, Perspective, Point3, Sides, Subpixel, World,
};

/// Columns of a frame.
pub const WIDTH: u32 = 40;
/// Rows of a frame.
pub const HEIGHT: u32 = 30;
/// Pixels of a frame.
pub const PIXELS: usize = (WIDTH * HEIGHT) as usize;
/// A side of the texture.
pub const SIDE: u32 = 16;
/// Texels of all its levels.
pub const TEXELS: usize = mipmap::texel_count(SIDE, SIDE);
/// Corners and triangles of a mesh.
pub const CORNERS: usize = 18;
/// See [`CORNERS`].
pub const TRIANGLES: usize = 14;

/// A sequence of numbers: integers alone, so that it is the same everywhere.
#[derive(Clone, Debug)]
pub struct Seed(u64);

/// The memory of a frame, and of the images that its surfaces have.
#[derive(Debug)]
pub struct Memory {
    /// Colours of up to four bytes a pixel.
    pub color: [u32; PIXELS],
    /// The same in two bytes.
    pub half: [u16; PIXELS],
    /// The same in three bytes, or in fewer.
    pub bytes: [[u8; 3]; PIXELS],
    /// Depths.
    pub depth: [u32; PIXELS],
    /// A texture and its levels.
    pub texels: [[u8; 4]; TEXELS],
}

impl Memory {
    /// Memory as it is before the start.
    pub const EMPTY: Self = Self {
        color: [0; PIXELS],
        half: [0; PIXELS],
        bytes: [[0; 3]; PIXELS],
        depth: [0; PIXELS],
        texels: [[0; 4]; TEXELS],
    };

    /// Fills it with what is not drawn.
    pub fn clear(&mut self) {
        self.color.fill(0x2030_4050);
        self.half.fill(0x1234);
        self.bytes.fill([1, 2, 3]);
        self.depth.fill(0);
        self.texels.fill([0; 4]);
    }

    /// The hash of all that is drawn, whatever the order of bytes in words.
    #[must_use]
    pub fn hash(&self) -> u64 {
        let mut hash = Hash::new();
        self.color.iter().for_each(|pixel| hash.add(*pixel));
        self.half.iter().for_each(|pixel| hash.add(u32::from(*pixel)));
        self.bytes.iter().for_each(|[a, b, c]| hash.add(u32::from_be_bytes([0, *a, *b, *c])));
        self.depth.iter().for_each(|depth| hash.add(*depth));
        self.texels.iter().for_each(|texel| hash.add(u32::from_be_bytes(*texel)));
        hash.value()
    }
}

/// FNV-1a of 64 bits, of words.
#[derive(Clone, Debug)]
pub struct Hash(u64);

impl Hash {
    /// The hash of nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// Adds a word, low byte first.
    pub fn add(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Adds a number by its bits. All that are not numbers are one.
    pub fn number(&mut self, x: f32) {
        self.add(if x.is_nan() { 0x7fc0_0000 } else { x.to_bits() });
    }

    /// The hash so far.
    #[must_use]
    pub const fn value(&self) -> u64 {
        self.0
    }
}

impl Default for Hash {
    fn default() -> Self {
        Self::new()
    }
}

impl Seed {
    /// That of a scene.
    #[must_use]
    pub const fn new(scene: u32) -> Self {
        Self((scene as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    /// Any word: SplitMix64, by Sebastiano Vigna.
    pub fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 32) as u32
    }

    /// A number below `count`.
    pub fn below(&mut self, count: u32) -> u32 {
        self.word() % count.max(1)
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> Option<T> {
        let count = u32::try_from(of.len()).unwrap_or(u32::MAX);
        of.get(self.below(count) as usize).copied()
    }

    /// A number between two, in 65536 steps: powers of two alone, so that each operation is exact but the last.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        #[expect(clippy::cast_precision_loss, reason = "16 bits")]
        let share = (self.word() >> 16) as f32 / 65536.0;
        low + (high - low) * share
    }

    /// Three such numbers.
    pub fn vector(&mut self, low: f32, high: f32) -> Vec3 {
        Vec3::new(self.between(low, high), self.between(low, high), self.between(low, high))
    }

    /// A float of any bits but those of infinities and of what is no number.
    pub fn float(&mut self) -> f32 {
        let x = f32::from_bits(self.word());
        if x.is_finite() { x } else { self.between(-2.0, 2.0) }
    }

    /// A perspective or, of one in four, a parallel projection.
    pub fn projection(&mut self) -> Option<AnyProjection> {
        const ASPECT: f32 = 4.0 / 3.0;
        let [near, far] = self.pick(&[[0.5, 20.0], [0.1, 1000.0], [1.0, 6.0]])?;
        if self.below(4) == 0 {
            return Some(Parallel::new(self.between(2.0, 6.0), ASPECT, near, far).ok()?.into());
        }
        Some(Perspective::new(self.between(0.3, 2.2), ASPECT, near, far).ok()?.into())
    }

    /// A turn about an axis, by angles of whole triples, and a place before the eye.
    pub fn frame(&mut self) -> Frame<Object, World> {
        let turns = [[0.6, 0.8], [0.8, -0.6], [1.0, 0.0], [0.28, 0.96], [-0.96, 0.28]];
        let [cos, sin] = self.pick(&turns).unwrap_or([1.0, 0.0]);
        let axes = [
            Mat3::from_cols(Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0), Vec3::Z),
            Mat3::from_cols(Vec3::X, Vec3::new(0.0, cos, sin), Vec3::new(0.0, -sin, cos)),
        ];
        let axes = self.pick(&axes).unwrap_or(Mat3::IDENTITY);
        Frame::from_mat3(axes, Point3::new(Vec3::new(0.0, 0.0, self.between(1.0, 5.0))))
    }

    /// A format of depths.
    pub fn depth(&mut self) -> AnyDepth {
        use AnyDepth::{D16, D24, D32, F32, F32Reversed, NoDepth};
        self.pick(&[F32, F32Reversed, D32, D24, D16, NoDepth]).unwrap_or(F32)
    }

    /// Which triangles are drawn, how they are clipped, and on which grid.
    pub fn shapes(&mut self) -> (Cull, Sides, Subpixel) {
        let cull = self.pick(&[Cull::None, Cull::Back, Cull::Front]).unwrap_or_default();
        let sides = self.pick(&[Sides::GuardBand, Sides::Cube]).unwrap_or_default();
        (cull, sides, self.pick(&[Subpixel::Sub4, Subpixel::Sub8]).unwrap_or_default())
    }

    /// The continuation of textures.
    pub fn wrap(&mut self) -> AnyWrap {
        self.pick(&[AnyWrap::Repeat, AnyWrap::Clamp, AnyWrap::Mirror]).unwrap_or(AnyWrap::Repeat)
    }

    /// A filter of one level.
    pub fn filter(&mut self) -> AnyFilter {
        self.pick(&[AnyFilter::Nearest, AnyFilter::Bilinear]).unwrap_or(AnyFilter::Nearest)
    }

    /// A filter of a mip map.
    pub fn mip_filter(&mut self) -> AnyMipFilter {
        let base = AnyMipFilter::Base(self.filter());
        let anisotropic = AnyMipFilter::Anisotropic { probes: 1 << self.below(5) };
        self.pick(&[base, AnyMipFilter::Trilinear, anisotropic]).unwrap_or(base)
    }

    /// Texels of any colours, or of blocks, and their levels.
    pub fn texels(&mut self, texels: &mut [[u8; 4]; TEXELS]) {
        let blocks = self.below(2) == 0;
        for k in 0..SIDE * SIDE {
            let (x, y) = (k % SIDE, k / SIDE);
            let word = self.word();
            let block = ((x / 4 + y / 3) % 5).wrapping_mul(0x3ad1_7c95) | 0x8000_0000;
            if let Some(texel) = texels.get_mut(k as usize) {
                *texel = (if blocks { block } else { word }).to_le_bytes();
            }
        }
        // The sides are those of the array.
        let _ = mipmap::build(Rgba8888, texels, SIDE, SIDE);
    }

    /// A mesh of any triangles, some of them through the eye's plane.
    pub fn mesh(&mut self) -> ([Corner; CORNERS], [[u16; 3]; TRIANGLES]) {
        let mut corners = [Corner::default(); CORNERS];
        for corner in &mut corners {
            *corner = Corner {
                place: self.vector(-3.0, 3.0),
                normal: self.vector(-1.0, 1.0),
                uv: Vec2::new(self.between(-2.0, 3.0), self.between(-2.0, 3.0)),
                color: self.vector(0.0, 1.0),
            };
        }
        let mut triangles = [[0; 3]; TRIANGLES];
        let count = u32::try_from(CORNERS).unwrap_or(1);
        for triangle in &mut triangles {
            *triangle = [(); 3].map(|()| u16::try_from(self.below(count)).unwrap_or(0));
        }
        (corners, triangles)
    }
}

/// A corner of a mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct Corner {
    /// In object space.
    pub place: Vec3,
    /// Of any length.
    pub normal: Vec3,
    /// In textures.
    pub uv: Vec2,
    /// From 0 to 1.
    pub color: Vec3,
}
