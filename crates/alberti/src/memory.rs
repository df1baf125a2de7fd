//! All memory of a renderer as one value, whose size is known when the program is built.

use crate::{PreparedTriangle, Slot};
use alberti_math::Varying;
use alberti_raster::{ColorFormat, DepthFormat};

/// The memory of a renderer in bands. It has the colours of two bands, one that is drawn and one that is sent, the
/// depths of one, slots for vertices, and a list of triangles. It is for a `static`: too much for the RAM of a chip
/// does not link, and too much for a budget of yours does not compile.
///
/// ```
/// use alberti::{D16, Memory, Rgb565Be, glam::Vec2};
///
/// // 320 columns, bands of 16 rows, 600 vertices with texture coordinates, 1,000 triangles.
/// type Frame = Memory<Rgb565Be, D16, Vec2, { 320 * 16 }, 600, 1000>;
/// const _: () = Frame::must_fit(56 * 1024);
/// static mut MEMORY: Frame = Frame::new(0, u16::MAX);
/// assert_eq!(size_of::<Frame>(), 2 * 320 * 16 * 2 + 320 * 16 * 2 + 600 * 32 + 1000 * 4);
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

    /// Does nothing, unless it takes more bytes than there are: then the program does not compile.
    ///
    /// ```compile_fail,E0080
    /// use alberti::glam::Vec2;
    /// use alberti::{D16, Memory, Rgb565Be};
    ///
    /// // A band alone takes 2560 * (2 * 2 + 2) bytes.
    /// const _: () = Memory::<Rgb565Be, D16, Vec2, 2560, 0, 0>::must_fit(15_359);
    /// ```
    ///
    /// # Panics
    /// While compiling, in a constant.
    pub const fn must_fit(bytes: usize) {
        assert!(Self::BYTES <= bytes, "the renderer's memory is larger than its budget");
    }
}
