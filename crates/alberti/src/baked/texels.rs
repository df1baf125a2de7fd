//! Textures of files.

use super::count;
use super::error::{BakedError, Fault};
use super::sections::{half, word};
use alberti_texture::Mipmap;
use alberti_texture::format::{
    InBytes, Indexed, Indexed1, Indexed2, Indexed4, Indexed8, L8, L16, Rgb8, Rgb332, Rgb565, Rgb565Alpha,
    Rgb565Be, Rgb565Pairs, Rgba4444, Rgba8888, Storage,
};

/// A texture with its levels, by the format of its texels. [`Mipmap::level`] of 0 is the largest; a texture that is
/// not for a mip map has no other.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Texels<'a> {
    /// Colours of 16 bits.
    Rgb565(Mipmap<'a, InBytes<Rgb565>>),
    /// Colours and alpha of 4 bits each.
    Rgba4444(Mipmap<'a, InBytes<Rgba4444>>),
    /// Luminance, or numbers.
    L8(Mipmap<'a, L8>),
    /// Colours of a palette of 16.
    Indexed4(Mipmap<'a, Indexed4<'a, [u8; 4]>>),
    /// Colours of a palette of 256.
    Indexed8(Mipmap<'a, Indexed8<'a, [u8; 4]>>),
    /// Colours and alpha of 8 bits each.
    Rgba8888(Mipmap<'a, Rgba8888>),
    /// Colours of 8 bits a channel, or normals.
    Rgb8(Mipmap<'a, Rgb8>),
    /// Heights.
    L16(Mipmap<'a, InBytes<L16>>),
    /// Colours of 16 bits, the high byte first, as displays take them.
    Rgb565Be(Mipmap<'a, InBytes<Rgb565Be>>),
    /// Colours of a byte.
    Rgb332(Mipmap<'a, Rgb332>),
    /// Colours of a palette of 2.
    Indexed1(Mipmap<'a, Indexed1<'a, [u8; 4]>>),
    /// Colours of a palette of 4.
    Indexed2(Mipmap<'a, Indexed2<'a, [u8; 4]>>),
    /// Colours of 16 bits, each with the next, for bilinear filters of stages in integers.
    Rgb565Pairs(Mipmap<'a, InBytes<Rgb565Pairs>>),
    /// Colours of 16 bits with alpha, for what is drawn over RGB565.
    Rgb565Alpha(Mipmap<'a, InBytes<Rgb565Alpha>>),
}

/// The number of a format of texels in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u16)]
pub enum TexelCode {
    /// [`Texels::Rgb565`].
    Rgb565 = 1,
    /// [`Texels::Rgba4444`].
    Rgba4444 = 2,
    /// [`Texels::L8`].
    L8 = 3,
    /// [`Texels::Indexed4`].
    Indexed4 = 4,
    /// [`Texels::Indexed8`].
    Indexed8 = 5,
    /// [`Texels::Rgba8888`].
    Rgba8888 = 6,
    /// [`Texels::Rgb8`].
    Rgb8 = 7,
    /// [`Texels::L16`].
    L16 = 8,
    /// [`Texels::Rgb565Be`].
    Rgb565Be = 9,
    /// [`Texels::Rgb332`].
    Rgb332 = 10,
    /// [`Texels::Indexed1`].
    Indexed1 = 11,
    /// [`Texels::Indexed2`].
    Indexed2 = 12,
    /// [`Texels::Rgb565Pairs`].
    Rgb565Pairs = 13,
    /// [`Texels::Rgb565Alpha`].
    Rgb565Alpha = 14,
}

impl<'a> Texels<'a> {
    /// The texture of an entry, which is at a place of the file.
    pub(super) fn read(
        file: &'a [u8],
        entry: &[u8; 16],
        place: impl Fn() -> u32,
    ) -> Result<Self, BakedError> {
        let [code, colors, width, height] = [0, 2, 4, 6].map(|at| half(entry, at));
        let (start, length) = (word(entry, 8) as usize, word(entry, 12) as usize);
        let wrong = |fault, found, expected| BakedError { fault, offset: place(), found, expected };
        let bytes = start.checked_add(length).and_then(|end| file.get(start..end));
        let bytes = bytes.ok_or_else(|| wrong(Fault::Texels, word(entry, 12), count(file.len())))?;
        let palette = bytes.split_at_checked(usize::from(colors) * 4);
        let (palette, texels) =
            palette.ok_or_else(|| wrong(Fault::Texels, word(entry, 12), colors.into()))?;
        let palette = palette.as_chunks().0;

        let levels = Levels { size: [width, height].map(u32::from), length: texels.len() };
        let map = match code {
            1 => levels.chunks(InBytes(Rgb565), texels).map(Self::Rgb565),
            2 => levels.chunks(InBytes(Rgba4444), texels).map(Self::Rgba4444),
            3 => levels.of(L8, texels).map(Self::L8),
            4 => levels.of(Indexed { palette }, texels).map(Self::Indexed4),
            5 => levels.of(Indexed { palette }, texels).map(Self::Indexed8),
            6 => levels.chunks(Rgba8888, texels).map(Self::Rgba8888),
            7 => levels.chunks(Rgb8, texels).map(Self::Rgb8),
            8 => levels.chunks(InBytes(L16), texels).map(Self::L16),
            9 => levels.chunks(InBytes(Rgb565Be), texels).map(Self::Rgb565Be),
            10 => levels.of(Rgb332, texels).map(Self::Rgb332),
            11 => levels.of(Indexed { palette }, texels).map(Self::Indexed1),
            12 => levels.of(Indexed { palette }, texels).map(Self::Indexed2),
            13 => levels.chunks(InBytes(Rgb565Pairs), texels).map(Self::Rgb565Pairs),
            14 => levels.chunks(InBytes(Rgb565Alpha), texels).map(Self::Rgb565Alpha),
            _ => return Err(wrong(Fault::Format, code.into(), 14)),
        };
        let expected = u32::from(width) * u32::from(height);
        map.ok_or_else(|| wrong(Fault::Texels, count(levels.length), expected))
    }
}

/// The size of a texture, and the bytes that its texels have.
struct Levels {
    size: [u32; 2],
    length: usize,
}

impl Levels {
    fn of<'a, F: Storage>(&self, format: F, texels: &'a [F::Element]) -> Option<Mipmap<'a, F>> {
        let [width, height] = self.size;
        Mipmap::new(format, texels, width, height).ok()
    }

    /// The same of texels of several bytes, of which none may be left over.
    fn chunks<'a, F: Storage<Element = [u8; N]>, const N: usize>(
        &self,
        format: F,
        bytes: &'a [u8],
    ) -> Option<Mipmap<'a, F>> {
        let (texels, rest) = bytes.as_chunks();
        self.of(format, texels).filter(|_| rest.is_empty())
    }
}
