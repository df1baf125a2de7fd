//! The nearest texel in the formats of other displays, without perspective, in fixed point, as it is sent.

use crate::draws::{draw, mapped};
use crate::shapes::{INDICES, Model, TEXTURE};
use crate::{Camera, HEIGHT, PIXELS, Target, WIDTH};
use alberti::glam::Vec2;
use alberti::raster::color::{Bayer, Dithered, Grey4, Indexed, Rgb332, Rgb444, Rgb666, pack};
use alberti::shaders::{Stored, Unlit};
use alberti::texture::{Nearest, Repeat};
use alberti::{Affine, ColorFormat, Counters, D16, FixedPoint, FragmentStage, Mesh, Rgba8};

/// The bytes of a frame in these formats, and how many of them a scene has drawn.
#[derive(Debug)]
pub(crate) struct Bytes {
    bytes: [u8; 3 * PIXELS],
    drawn: usize,
}

impl Bytes {
    pub(crate) const EMPTY: Self = Self { bytes: [0; 3 * PIXELS], drawn: 0 };

    /// None drawn.
    pub(crate) fn clear(&mut self) {
        self.bytes.fill(0);
        self.drawn = 0;
    }

    /// Those that were drawn.
    pub(crate) fn drawn(&self) -> &[u8] {
        self.bytes.get(..self.drawn).unwrap_or_default()
    }

    /// Pixels of so many bytes, to draw to.
    fn pixels<const N: usize>(&mut self) -> &mut [[u8; N]] {
        self.drawn = N * PIXELS;
        self.bytes.get_mut(..self.drawn).unwrap_or_default().as_chunks_mut().0
    }
}

/// Draws a format's pixels.
#[inline]
fn frame<C: ColorFormat, K: Counters>(
    (format, stage): (C, impl FragmentStage<Vec2>),
    (pixels, depth): (&mut [C::Pixel], &mut [u16]),
    (camera, model): (&Camera, &Model),
    counters: &mut K,
) {
    let mesh = Mesh::new(model.vertices, model.triangles, mapped);
    let target = alberti::Target::new(format, D16, WIDTH, HEIGHT, pixels, depth);
    draw(target, camera, model, &mesh, stage, FixedPoint(Affine), &mut [], counters);
}

#[inline]
fn texels() -> impl FragmentStage<Vec2, Color = Rgba8> {
    Unlit(TEXTURE.sampler(Nearest, Repeat))
}

/// 12 bits a pixel, two pixels in three bytes.
pub fn rgb444<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let pixels = target.bytes.pixels();
    frame((Rgb444, texels()), (pixels, &mut target.depth), (camera, model), counters);
    pack::rgb444(pixels);
}

/// 18 bits in three bytes.
pub fn rgb666<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let pixels = target.bytes.pixels();
    frame((Rgb666, texels()), (pixels, &mut target.depth), (camera, model), counters);
}

/// A byte of three channels.
pub fn rgb332<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let pixels = target.bytes.pixels::<1>().as_flattened_mut();
    frame((Rgb332, texels()), (pixels, &mut target.depth), (camera, model), counters);
}

/// 16 levels of grey in a pattern, two pixels in a byte.
pub fn grey4<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let pixels = target.bytes.pixels::<1>().as_flattened_mut();
    let format = Dithered { format: Grey4, by: Bayer };
    frame((format, texels()), (pixels, &mut target.depth), (camera, model), counters);
    pack::grey4(pixels, WIDTH as usize);
}

/// Texels that are indices into the target's palette.
pub fn indexed<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let pixels = target.bytes.pixels::<1>().as_flattened_mut();
    let stage = Stored(INDICES.sampler(Nearest, Repeat));
    frame(
        (Indexed(&[Rgba8::BLACK, Rgba8::WHITE]), stage),
        (pixels, &mut target.depth),
        (camera, model),
        counters,
    );
}
