//! A stage that writes down numbers of fragments instead of making colours, in the kernels that draw the pictures.

use super::clothed::{Clothed, Number, Triangles};
use super::erased::Attributes;
use super::used::Used;
use super::{CHUNK, Canvas, Drawing};
use crate::error::Error;
use crate::scene::Part;
use alberti::lanes::Lanes;
use alberti::raster::PerPixel;
use alberti::raster::color::AnyBlend;
use alberti::{FragmentStage, Fragments, Rgba8};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// A number that is written down for each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    /// Of the texture coordinates, the bits of an `f32`, or units of 2^-16 in fixed point.
    U,
    /// The other one.
    V,
    /// The bits of an `f32`: the level of detail of the surface's texture, if there is one.
    Lod,
    /// The number of the triangle that was seen last.
    Triangle,
    /// The fragments that passed the depth test.
    Shaded,
    /// The fragments that arrived at it.
    Covered,
    /// The first column of the run.
    RunStart,
    /// The columns of the run, or [`WHOLE`]; 0 without one.
    RunLength,
}

/// The length of a run that is a whole triangle.
pub(crate) const WHOLE: u32 = u32::MAX;

const WORDS: usize = Word::RunLength as usize + 1;

impl From<Word> for usize {
    fn from(word: Word) -> Self {
        word as Self
    }
}

/// The part of a fragment's numbers that a drawing takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Taken {
    /// Texture coordinates, the level of detail, the triangle, and that it was shaded.
    Values,
    /// The triangle alone, where the image of a projector is carried instead of it with the rest.
    Triangle,
    /// That it arrived: for a target that tests no depths.
    Arrival,
}

/// The numbers of all pixels, so many each. Threads draw different pixels, so that each word has one writer.
#[derive(Debug)]
pub(crate) struct Tap<const COUNT: usize = WORDS> {
    width: u32,
    pixels: Vec<[AtomicU32; COUNT]>,
}

impl<const COUNT: usize> Tap<COUNT> {
    /// Zeros, or an error where memory is short.
    pub(crate) fn new(width: u32, height: u32) -> Result<Self, Error> {
        let count = width as usize * height as usize;
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(count).map_err(|_| {
            let found = format!("too little memory for the numbers of {width}x{height} pixels");
            let expected = format!("{} MiB", (count * size_of::<[AtomicU32; COUNT]>()) >> 20);
            Error::new(found, expected).place("--size").hint("choose a smaller size")
        })?;
        pixels.resize_with(count, || [const { AtomicU32::new(0) }; COUNT]);
        Ok(Self { width, pixels })
    }

    /// A number of the pixel with this index.
    pub(crate) fn read(&self, index: usize, word: impl Into<usize>) -> u32 {
        self.pixels.get(index).and_then(|words| words.get(word.into())).map_or(0, |word| word.load(Relaxed))
    }

    pub(super) fn write(&self, [column, row]: [i32; 2], word: impl Into<usize>, value: u32) {
        if let Some(at) = self.at([column, row], word) {
            at.store(value, Relaxed);
        }
    }

    fn count(&self, place: [i32; 2], word: impl Into<usize>) {
        if let Some(at) = self.at(place, word) {
            at.fetch_add(1, Relaxed);
        }
    }

    fn at(&self, place: [i32; 2], word: impl Into<usize>) -> Option<&AtomicU32> {
        let [column, row] = place.map(i32::cast_unsigned);
        let words = self.pixels.get(row as usize * self.width as usize + column as usize)?;
        words.get(word.into())
    }
}

/// The stage.
#[derive(Clone, Copy)]
struct Tapped<'a> {
    tap: &'a Tap,
    taken: Taken,
    /// Whether a triangle's number is carried.
    numbered: bool,
    /// The sides of the surface's texture.
    size: Option<[u32; 2]>,
}

impl FragmentStage<Attributes> for Tapped<'_> {
    type Color = Rgba8;
    type Derivatives = PerPixel;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Attributes>) -> (L::U32, L::Mask) {
        let &Fragments { lanes, varying: ([low, high, _], framed), gradient, mask, place } = fragments;
        let tap = self.tap;
        let shaded = |write: &dyn Fn(usize, [i32; 2])| {
            let [column, row] = place;
            for (k, column) in (0..L::COUNT).zip(column..).filter(|(k, _)| lanes.bits(mask) >> k & 1 != 0) {
                write(k, [column, row]);
            }
        };
        let put = |word, values: L::Each<u32>| {
            shaded(&|k, place| tap.write(place, word, values.as_ref().get(k).copied().unwrap_or_default()));
        };
        let bits = |number: L::Number| {
            if L::FIXED {
                return lanes.store_words(lanes.floor_scaled(number, 16));
            }
            let floats = lanes.store(number);
            lanes.each(|k| floats.as_ref().get(k).map_or(0, |float: &f32| float.to_bits()))
        };
        match self.taken {
            Taken::Arrival => shaded(&|_, place| tap.count(place, Word::Covered)),
            Taken::Triangle => {}
            Taken::Values => {
                shaded(&|_, place| tap.count(place, Word::Shaded));
                put(Word::U, bits(framed.uv[0]));
                put(Word::V, bits(framed.uv[1]));
                if let Some(size) = self.size {
                    let lod = gradient.map(|(_, framed)| framed.uv).lod_lanes(lanes, size);
                    let floats = lanes.store(lod);
                    put(Word::Lod, lanes.each(|k| floats.as_ref().get(k).map_or(0, |lod| lod.to_bits())));
                }
            }
        }
        if self.numbered {
            let part = |number| lanes.store_words(lanes.floor_scaled(number, Number::BITS));
            let (low, high) = (part(low), part(high));
            let word = |each: &L::Each<u32>, k| each.as_ref().get(k).copied().unwrap_or_default();
            put(Word::Triangle, lanes.each(|k| Number::of([word(&low, k), word(&high, k)])));
        }
        (lanes.word(0), mask)
    }
}

impl Drawing<'_> {
    /// Draws the whole model into a cleared target, by the options' policies, and writes down numbers of its pixels.
    pub(crate) fn tap(&self, tap: &Tap, taken: Taken, target: &mut Canvas<'_>) {
        let numbered = match taken {
            Taken::Values => self.slide.is_none(),
            Taken::Triangle => true,
            Taken::Arrival => false,
        };
        self.each_chunk(numbered, |part, mesh| {
            let texture = part.texture.and_then(|texture| self.textures.get(texture));
            let size = texture.filter(|_| mesh.clothed.textured).map(|t| [t.width(), t.height()]);
            let tapped = Tapped { tap, taken, numbered, size };
            let _ = self.by_policies(mesh, tapped, AnyBlend::Replace, target);
        });
    }

    /// Calls `draw` for all triangles, in drawing order, with or without their numbers.
    pub(super) fn each_chunk(&self, numbered: bool, draw: impl FnMut(&Part, &Triangles<'_, '_>)) {
        self.each_chunk_clothed(|part| self.clothed(part), numbered, draw);
    }

    /// The same with surfaces of one's own.
    pub(super) fn each_chunk_clothed<'c>(
        &self,
        clothe: impl Fn(&Part) -> Clothed<'c>,
        numbered: bool,
        mut draw: impl FnMut(&Part, &Triangles<'_, '_>),
    ) {
        let mut first = 0;
        for part in &self.model.parts {
            let clothed = clothe(part);
            for triangles in part.triangles.chunks(CHUNK) {
                let Used { vertices, triangles } = self.sided(triangles);
                let numbers = numbered.then_some(first);
                let mesh = Triangles {
                    clothed: &clothed,
                    vertices: &vertices,
                    triangles: &triangles,
                    numbers,
                    bare: false,
                };
                draw(part, &mesh);
                first += u32::try_from(triangles.len()).unwrap_or(0);
            }
        }
    }

    /// Whether each part has texture coordinates.
    pub(crate) fn textured(&self) -> Vec<bool> {
        self.model.parts.iter().map(|part| self.clothed(part).textured).collect()
    }

    /// Whether the model has more triangles than there are numbers.
    pub(crate) fn is_numberable(&self) -> bool {
        let total: usize = self.model.parts.iter().map(|part| part.triangles.len()).sum();
        total < Number::LIMIT as usize
    }

    /// Whether triangles are numbered in a drawing of their own.
    pub(crate) fn numbers_apart(&self) -> bool {
        self.slide.is_some()
    }
}
