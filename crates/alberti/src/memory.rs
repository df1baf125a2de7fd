//! All memory of a renderer as one value, whose size is known when the program is built.

use crate::{PreparedTriangle, Slot};
use alberti_math::Varying;
use alberti_raster::{ColorFormat, DepthFormat};

/// The memory of a renderer in bands. It has the colours of two bands, for a [`PingPong`](crate::PingPong), the
/// depths of one, slots for vertices, and a list of triangles. It is for a `static`: too much for the RAM of a chip
/// does not link, and too much for a budget of yours does not compile.
///
/// ```
/// use alberti::{D16, Memory, Rgb565Be, glam::Vec2};
/// use std::sync::Mutex;
///
/// // 320 columns, bands of 16 rows, 600 vertices with texture coordinates, 1,000 triangles.
/// type Frame = Memory<Rgb565Be, D16, Vec2, { 320 * 16 }, 600, 1000>;
/// const _: () = Frame::must_fit(56 * 1024);
/// // Firmware has a `ConstStaticCell` of the crate `static_cell` for the mutex, and takes the memory out of it once.
/// static MEMORY: Mutex<Frame> = Mutex::new(Frame::new(0, u16::MAX));
/// let Ok(mut memory) = MEMORY.lock() else { return };
/// let Memory { colors: [first, second], depths, slots, list } = &mut *memory;
/// assert_eq!(Frame::BYTES, 2 * 320 * 16 * 2 + 320 * 16 * 2 + 600 * 32 + 1000 * 4);
/// ```
#[derive(Clone, Debug)]
pub struct Memory<
    C: ColorFormat,
    D: DepthFormat,
    V: Varying,
    const PIXELS: usize,
    const VERTICES: usize,
    const TRIANGLES: usize,
> {
    /// The colours of two bands.
    pub colors: [[C::Pixel; PIXELS]; 2],
    /// The depths of one.
    pub depths: [D::Stored; PIXELS],
    /// Transformed vertices.
    pub slots: [Slot<V>; VERTICES],
    /// The triangles of a frame.
    pub list: [PreparedTriangle; TRIANGLES],
}

impl<
    C: ColorFormat,
    D: DepthFormat,
    V: Varying,
    const PIXELS: usize,
    const VERTICES: usize,
    const TRIANGLES: usize,
> Memory<C, D, V, PIXELS, VERTICES, TRIANGLES>
{
    /// The bytes of all of it.
    pub const BYTES: usize = size_of::<Self>();

    /// Memory that holds this pixel and this depth everywhere: zeros need no room in a program's image.
    #[must_use]
    pub const fn new(pixel: C::Pixel, depth: D::Stored) -> Self {
        Self {
            colors: [[pixel; PIXELS]; 2],
            depths: [depth; PIXELS],
            slots: [Slot::EMPTY; VERTICES],
            list: [PreparedTriangle::EMPTY; TRIANGLES],
        }
    }

    /// Does nothing, unless it takes more bytes than there are: then the program does not compile, and the compiler
    /// says how many bytes are wanted, and how many there are. The stack is not counted: drawing takes some 4 KB of it.
    ///
    /// ```compile_fail,E0080
    /// use alberti::glam::Vec2;
    /// use alberti::{D16, Memory, Rgb565Be};
    ///
    /// // A band alone takes 2560 * (2 * 2 + 2) bytes: "the renderer's memory takes 15360 bytes, 1 more than 15359".
    /// const _: () = Memory::<Rgb565Be, D16, Vec2, 2560, 0, 0>::must_fit(15_359);
    /// ```
    ///
    /// # Panics
    /// While compiling, in a constant.
    pub const fn must_fit(bytes: usize) {
        if Self::BYTES > bytes {
            panic!("{}", Message::exceeded(Self::BYTES, bytes).text());
        }
    }
}

/// A message that is put together while compiling, where nothing is formatted.
struct Message {
    bytes: [u8; Self::ROOM],
    length: usize,
}

impl Message {
    /// The bytes of the longest one: its words, and three numbers of twenty digits.
    const ROOM: usize = 120;

    /// The message of a budget that is exceeded.
    const fn exceeded(found: usize, budget: usize) -> Self {
        Self { bytes: [0; Self::ROOM], length: 0 }
            .words(b"the renderer's memory takes ")
            .number(found)
            .words(b" bytes, ")
            .number(found - budget)
            .words(b" more than ")
            .number(budget)
    }

    const fn words(mut self, mut words: &[u8]) -> Self {
        while let [first, rest @ ..] = words {
            self.bytes[self.length] = *first;
            self.length += 1;
            words = rest;
        }
        self
    }

    const fn number(self, number: usize) -> Self {
        let before = if number < 10 { self } else { self.number(number / 10) };
        before.words(b"0123456789".split_at(number % 10).1.split_at(1).0)
    }

    const fn text(&self) -> &str {
        match core::str::from_utf8(self.bytes.split_at(self.length).0) {
            Ok(text) => text,
            Err(_) => "",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn a_budget_that_is_exceeded_is_told_in_numbers() {
        for (found, budget) in
            [(1, 0), (10, 9), (51_789, 49_152), (usize::MAX, 0), (usize::MAX, usize::MAX - 1)]
        {
            let expected =
                format!("the renderer's memory takes {found} bytes, {} more than {budget}", found - budget);
            assert_eq!(Message::exceeded(found, budget).text(), expected);
        }
        let longest = format!("the renderer's memory takes {0} bytes, {0} more than {0}", u64::MAX);
        assert!(longest.len() <= Message::ROOM, "{}", longest.len());
    }
}
