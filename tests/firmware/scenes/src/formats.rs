//! The nearest texel in the formats of other displays, without perspective, in fixed point, as it is sent.

use crate::draws::{draw, mapped};
use crate::shapes::{INDICES, Model, TEXTURE};
use crate::{Camera, HEIGHT, PIXELS, Target, WIDTH};
use alberti::glam::Vec2;
use alberti::raster::color::{
    Bayer, Dithered, Grey1, Grey2, Grey4, Grey8, Indexed, Rgb332, Rgb444, Rgb666, Rgb888, Xrgb8888, pack,
};
use alberti::shaders::{Stored, Unlit};
use alberti::texture::{Nearest, Repeat};
use alberti::{Affine, ColorFormat, Counters, D16, FixedPoint, FragmentStage, Mesh, Rgba8};

/// The bytes, or the words, of a frame in these formats, and how many of each a scene has drawn.
#[derive(Debug)]
pub(crate) struct Pixels {
    bytes: [u8; 3 * PIXELS],
    words: [u32; PIXELS],
    drawn: [usize; 2],
}

impl Pixels {
    pub(crate) const EMPTY: Self = Self { bytes: [0; 3 * PIXELS], words: [0; PIXELS], drawn: [0; 2] };

    /// None drawn.
    pub(crate) fn clear(&mut self) {
        self.bytes.fill(0);
        self.words.fill(0);
        self.drawn = [0; 2];
    }

    /// Those that were drawn, as bytes.
    pub(crate) fn drawn(&self) -> impl Iterator<Item = u8> {
        let [bytes, words] = self.drawn;
        let words = self.words.iter().take(words).flat_map(|word| word.to_ne_bytes());
        self.bytes.iter().take(bytes).copied().chain(words)
    }

    /// Pixels of so many bytes, to draw to.
    fn of_bytes<const N: usize>(&mut self) -> &mut [[u8; N]] {
        self.drawn = [N * PIXELS, 0];
        self.bytes.get_mut(..N * PIXELS).unwrap_or_default().as_chunks_mut().0
    }

    /// Pixels of one byte, to draw to.
    fn of_single_bytes(&mut self) -> &mut [u8] {
        self.of_bytes::<1>().as_flattened_mut()
    }

    /// Pixels of a word, to draw to.
    fn of_words(&mut self) -> &mut [u32] {
        self.drawn = [0, PIXELS];
        &mut self.words
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

/// Defines ways of drawing pixels in a format, and what is done with them then.
macro_rules! formats {
    ($($(#[$doc:meta])* $name:ident: $format:expr, $stage:expr,
        |$other:ident| $pixels:expr $(, |$drawn:ident| $send:expr)?;)*) => {$(
        $(#[$doc])*
        pub fn $name<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
            let ($other, depth) = (&mut target.other, &mut target.depth);
            let pixels = $pixels;
            frame(($format, $stage), (&mut *pixels, depth), (camera, model), counters);
            $(
                let $drawn = pixels;
                $send;
            )?
        }
    )*};
}

formats! {
    /// 12 bits a pixel, two pixels in three bytes.
    rgb444: Rgb444, texels(), |other| other.of_bytes(), |pixels| pack::rgb444(pixels);

    /// 18 bits in three bytes.
    rgb666: Rgb666, texels(), |other| other.of_bytes();

    /// Three bytes.
    rgb888: Rgb888, texels(), |other| other.of_bytes();

    /// A word.
    xrgb8888: Xrgb8888, texels(), |other| other.of_words();

    /// A byte of three channels.
    rgb332: Rgb332, texels(), |other| other.of_single_bytes();

    /// A byte of grey.
    grey8: Grey8, texels(), |other| other.of_single_bytes();

    /// 16 levels of grey in a pattern, two pixels in a byte.
    grey4: Dithered { format: Grey4, by: Bayer }, texels(),
        |other| other.of_single_bytes(), |pixels| pack::grey4(pixels, WIDTH as usize);

    /// Four levels, four pixels in a byte.
    grey2: Dithered { format: Grey2, by: Bayer }, texels(),
        |other| other.of_single_bytes(), |pixels| pack::grey2(pixels, WIDTH as usize);

    /// Black and white, eight pixels in a byte.
    grey1: Dithered { format: Grey1, by: Bayer }, texels(),
        |other| other.of_single_bytes(), |pixels| pack::grey1(pixels, WIDTH as usize);

    /// Texels that are indices into the target's palette.
    indexed: Indexed(&[Rgba8::BLACK, Rgba8::WHITE]), Stored(INDICES.sampler(Nearest, Repeat)),
        |other| other.of_single_bytes();
}
