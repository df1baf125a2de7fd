//! Targets: the frame that is drawn, or a band of its rows.

use crate::color::{ColorFormat, FragmentColor};
use crate::depth::DepthFormat;
use crate::error::TargetError;
use crate::pixels::{Pixels, Rows, fill, narrowed};
use alberti_math::map2;
use core::iter::from_fn;
use core::mem::{replace, take};
use core::ops::Range;

/// Consecutive rows of a frame, in buffers of the caller's, whose pixels do not depend on the division:
///
/// * all of them ([`new`](Self::new)),
/// * a band of a frame that does not fit in memory ([`band`](Self::band), or [`Bands`](crate::Bands) for one band after
///   the other),
/// * all of a window into a larger picture, or a band of it ([`window`](Self::window), or
///   [`Bands::window`](crate::Bands::window)).
///
/// Rows count from the top. The depth buffer holds `width` values a row, without padding.
///
/// ```
/// use alberti_math::{Rgb565Be, Rgba8};
/// use alberti_raster::{D16, Target};
///
/// let (mut color, mut depth) = ([0u16; 4 * 3], [0u16; 4 * 3]);
/// let mut target = Target::new(Rgb565Be, D16, 4, 3, &mut color, &mut depth)?;
/// target.clear(Rgba8::WHITE);
/// assert_eq!(target.pixels(), [0xffff; 12]);
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
#[derive(Debug)]
pub struct Target<'a, C: ColorFormat, D: DepthFormat> {
    color_format: C,
    depth_format: D,
    color: &'a mut [C::Pixel],
    pub(crate) depth: &'a mut [D::Stored],
    /// Columns and rows of the frame.
    size: [u32; 2],
    /// Pixels from a row to the next: of the colours, and of the depths.
    pub(crate) strides: [usize; 2],
    pub(crate) first_row: usize,
    /// The columns and rows of the frame that may be drawn to.
    limits: [Range<i32>; 2],
}

/// The largest width and height of a frame.
pub(crate) const LARGEST: u32 = 1 << 14;

impl<'a, C: ColorFormat, D: DepthFormat> Target<'a, C, D> {
    /// A whole frame of `width` x `height` pixels, to be [cleared](Self::clear) before drawing: depths of 0 are
    /// nearest.
    ///
    /// For [`NoDepth`](crate::NoDepth), `depth` is a slice of `()`, for example `&mut [(); 320 * 240]`, without bytes.
    ///
    /// # Errors
    /// [`TargetError`] when the buffers' lengths do not fit the size, or this the limits.
    pub fn new(
        color_format: C,
        depth_format: D,
        width: u32,
        height: u32,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        if width > LARGEST || height > LARGEST {
            return Err(TargetError::Size);
        }
        let (found, expected) = (color.len(), width as usize * height as usize);
        if found != expected {
            return Err(TargetError::Color { found, expected });
        }
        let (formats, size) = ((color_format, depth_format), [width, height]);
        Self::of_rows(formats, size, [0, height], width as usize, color, depth)
    }

    /// The rows from `first_row` on of a frame of these columns and rows, as many as `color` has.
    ///
    /// # Errors
    /// [`TargetError`] when the buffers' lengths do not fit each other, the frame or the limits.
    pub fn band(
        color_format: C,
        depth_format: D,
        [width, height]: [u32; 2],
        first_row: u32,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        let pixels = color.len();
        if width == 0 || pixels == 0 {
            return Err(TargetError::Size);
        }
        if !pixels.is_multiple_of(width as usize) {
            return Err(TargetError::Rows { pixels, width });
        }
        let rows = u32::try_from(pixels / width as usize).map_err(|_| TargetError::Size)?;
        let formats = (color_format, depth_format);
        Self::of_rows(formats, [width, height], [first_row, rows], width as usize, color, depth)
    }

    /// These rows of a frame of `width` x `height` pixels, in a larger picture, such as a window of a user interface:
    /// `0..height` for all of it. `color` begins with the first pixel of the first of them, and each row begins
    /// `stride` pixels after the one above. So for n rows `color` has at least (n − 1)·`stride` + `width` pixels, and
    /// `depth` has n·`width`.
    ///
    /// ```
    /// use alberti_math::{Rgba8, Rgba8888};
    /// use alberti_raster::{NoDepth, Target};
    ///
    /// // A window of 2 x 3 pixels, at column 1 of row 2 of a picture of 4 x 6.
    /// let (mut picture, mut depth) = ([0; 4 * 6], [(); 2 * 3]);
    /// let place = &mut picture[2 * 4 + 1..];
    /// Target::window(Rgba8888, NoDepth, [2, 3], 0..3, 4, place, &mut depth)?.clear(Rgba8::WHITE);
    /// assert_eq!(picture[2 * 4..3 * 4], [0, u32::MAX, u32::MAX, 0]);
    ///
    /// // The same in memory for two rows of the picture: the last two, which are rows 1 and 2 of the window.
    /// let mut part = [0; 4 * 2];
    /// let mut band = Target::window(Rgba8888, NoDepth, [2, 3], 1..3, 4, &mut part[1..], &mut depth[..2 * 2])?;
    /// band.clear(Rgba8::WHITE);
    /// assert_eq!(part, [0, u32::MAX, u32::MAX, 0, 0, u32::MAX, u32::MAX, 0]);
    /// # Ok::<(), alberti_raster::TargetError>(())
    /// ```
    ///
    /// # Errors
    /// [`TargetError`] when the buffers' lengths do not fit the rows and the stride, or these the frame or the limits.
    pub fn window(
        color_format: C,
        depth_format: D,
        size: [u32; 2],
        rows: Range<u32>,
        stride: usize,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        let count = rows.end.saturating_sub(rows.start);
        must_reach(color.len(), [size[0], count], stride)?;
        Self::of_rows((color_format, depth_format), size, [rows.start, count], stride, color, depth)
    }

    /// So many rows from one on, whose buffers of colours are long enough for the stride.
    pub(crate) fn of_rows(
        (color_format, depth_format): (C, D),
        [width, height]: [u32; 2],
        [first_row, rows]: [u32; 2],
        stride: usize,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        let last = first_row.checked_add(rows).ok_or(TargetError::Size)?;
        if width == 0 || rows == 0 || width > LARGEST || height > LARGEST || last > height {
            return Err(TargetError::Size);
        }
        let expected = width as usize * rows as usize;
        if depth.len() != expected {
            return Err(TargetError::Depth { found: depth.len(), expected });
        }
        let limits = [0..width.cast_signed(), first_row.cast_signed()..last.cast_signed()];
        let strides = [stride, width as usize];
        let (size, first_row) = ([width, height], first_row as usize);
        Ok(Self { color_format, depth_format, color, depth, size, strides, first_row, limits })
    }

    /// Columns and rows of the frame.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The frame's columns and rows that may be drawn to.
    #[must_use]
    pub fn limits(&self) -> [Range<i32>; 2] {
        self.limits.clone()
    }

    /// The colour format.
    #[must_use]
    #[inline(always)]
    pub fn color_format(&self) -> C {
        self.color_format
    }

    /// The depth format.
    #[must_use]
    #[inline(always)]
    pub fn depth_format(&self) -> D {
        self.depth_format
    }

    /// The colours, row by row from the top, as they lie in memory.
    #[must_use]
    pub fn pixels(&self) -> &[C::Pixel] {
        self.color
    }

    /// The bytes of the colours, in the order in which a display or a file wants them: for its driver's DMA, without a
    /// copy. Of a window, all of the slice that it was made of. Formats of less than a byte a pixel, and `Rgb444`,
    /// have a word for each in memory: [`pack`](crate::color::pack) puts these together. Behind the feature `bytemuck`.
    ///
    /// ```
    /// use alberti_math::{Rgb565Be, Rgba8};
    /// use alberti_raster::{NoDepth, Target};
    ///
    /// let (mut color, mut depth) = ([0u16; 2], [(); 2]);
    /// let mut target = Target::new(Rgb565Be, NoDepth, 2, 1, &mut color, &mut depth)?;
    /// target.clear(Rgba8::from_rgb24(0xff_00_00));
    /// assert_eq!(target.bytes(), [0xf8, 0x00, 0xf8, 0x00]);
    /// # Ok::<(), alberti_raster::TargetError>(())
    /// ```
    #[cfg(feature = "bytemuck")]
    #[must_use]
    pub fn bytes(&self) -> &[u8]
    where
        C::Pixel: bytemuck::NoUninit,
    {
        bytemuck::cast_slice(self.color)
    }

    /// The same target, of which only these columns and rows of the frame may be drawn to or cleared.
    pub fn scissor(&mut self, columns: Range<i32>, rows: Range<i32>) -> Target<'_, C, D> {
        let limits = [narrowed(&self.limits[0], columns), narrowed(&self.limits[1], rows)];
        Target { color: self.color, depth: self.depth, limits, ..*self }
    }

    /// The same target with another depth format of the same memory, for passes that compare otherwise:
    /// `target.with_depth(Equal(F32))`.
    pub fn with_depth<E: DepthFormat<Stored = D::Stored>>(&mut self, depth_format: E) -> Target<'_, C, E> {
        let Self { color_format, size, strides, first_row, .. } = *self;
        let (color, depth, limits) = (&mut *self.color, &mut *self.depth, self.limits.clone());
        Target { color_format, depth_format, color, depth, size, strides, first_row, limits }
    }

    /// The same target with another colour format of the same pixels, for passes that store otherwise:
    /// `target.with_color(Blended { format: Rgb565Le, by: Over })`.
    pub fn with_color<E: ColorFormat<Pixel = C::Pixel>>(&mut self, color_format: E) -> Target<'_, E, D> {
        let Self { depth_format, size, strides, first_row, .. } = *self;
        let (color, depth, limits) = (&mut *self.color, &mut *self.depth, self.limits.clone());
        Target { color_format, depth_format, color, depth, size, strides, first_row, limits }
    }

    /// Gives every pixel this colour and the farthest depth.
    pub fn clear<Shade: FragmentColor>(&mut self, color: Shade) {
        let pixel = Shade::pixel(self.color_format, color.to_word());
        let farthest = self.depth_format.farthest();
        let [columns, rows] = self.limits();
        for row in rows {
            let (color, depth) = self.pixels_from(row, columns.start);
            let count = columns.len();
            fill(color, count, pixel);
            fill(depth, count, farthest);
        }
    }

    /// As many pixels as depths from `column` of the frame's row `row` on, to the end of the target or beyond the
    /// window; none where there are none.
    #[inline]
    pub(crate) fn pixels_from(&mut self, row: i32, column: i32) -> Pixels<'_, C::Pixel, D::Stored> {
        self.rows_from(row, column).pixels()
    }

    /// The same for that row and then those below.
    #[inline]
    pub(crate) fn rows_from(&mut self, row: i32, column: i32) -> Rows<'_, C::Pixel, D::Stored> {
        let strides = self.strides;
        let place = |row: i32| {
            let row = usize::try_from(row).ok()?.checked_sub(self.first_row)?;
            Some((row, usize::try_from(column).ok()?))
        };
        let Some((row, column)) = place(row) else {
            return Rows { colors: &mut [], depths: &mut [], strides };
        };
        let colors = self.color.get_mut(row * strides[0] + column..).unwrap_or_default();
        let depths = self.depth.get_mut(row * strides[1] + column..).unwrap_or_default();
        Rows { colors, depths, strides }
    }

    /// One pixel within the [limits](Self::limits), and its depth.
    #[inline(always)]
    #[expect(clippy::cast_sign_loss, reason = "what is above or on the left wraps")]
    pub(crate) fn pixel(&mut self, row: i32, column: i32) -> Option<(&mut C::Pixel, &mut D::Stored)> {
        let (row, column) = ((row as usize).wrapping_sub(self.first_row), column as usize);
        let [color, depth] = map2(self.strides, |stride| row.wrapping_mul(stride).wrapping_add(column));
        Some((self.color.get_mut(color)?, self.depth.get_mut(depth)?))
    }

    /// The target in parts of so many rows, at least one, from the top of its memory; the last may have fewer. Parts
    /// above a [`scissor`](Self::scissor) have no rows to be drawn. Several threads may draw to one part each.
    pub fn split(&mut self, rows: usize) -> impl Iterator<Item = Target<'_, C, D>> {
        let Self { color_format, depth_format, size, strides, .. } = *self;
        let [columns, limits] = self.limits.clone();
        let mut first_row = self.first_row;
        let (mut color, mut depth) = (&mut *self.color, &mut *self.depth);
        from_fn(move || {
            let from = i32::try_from(first_row).ok()?;
            let end = from.saturating_add(i32::try_from(rows.max(1)).unwrap_or(i32::MAX)).min(limits.end);
            let count = usize::try_from(end.checked_sub(from)?).ok().filter(|&count| count > 0)?;
            let (own_color, own_depth);
            (own_color, color) = split_off(take(&mut color), count * strides[0]);
            (own_depth, depth) = split_off(take(&mut depth), count * strides[1]);
            let limits = [columns.clone(), limits.start.max(from).min(end)..end];
            let below = first_row + count;
            let first = replace(&mut first_row, below);
            let (color, depth) = (own_color, own_depth);
            Some(Target { color_format, depth_format, color, depth, size, strides, first_row: first, limits })
        })
    }

    /// The rows from one on, whose columns count from `left`, which may lie outside.
    #[inline(always)]
    #[expect(clippy::cast_sign_loss, reason = "sums wrap back")]
    pub(crate) fn lines(&mut self, row: i32, left: i32) -> Lines<'_, C::Pixel, D::Stored> {
        let place = |place: i32| place as usize;
        let row = place(row).wrapping_sub(self.first_row);
        let first = map2(self.strides, |stride| row.wrapping_mul(stride).wrapping_add(place(left)));
        Lines { color: self.color, depth: self.depth, strides: self.strides, first }
    }
}

/// Fails unless so many pixels hold a window of these columns and rows.
pub(crate) fn must_reach(found: usize, [width, rows]: [u32; 2], stride: usize) -> Result<(), TargetError> {
    let above = (rows as usize).checked_sub(1).ok_or(TargetError::Size)?;
    if stride < width as usize {
        return Err(TargetError::Stride { stride, width });
    }
    let reached = above.checked_mul(stride).and_then(|above| above.checked_add(width as usize));
    let expected = reached.unwrap_or(usize::MAX);
    if found < expected { Err(TargetError::Color { found, expected }) } else { Ok(()) }
}

/// The first elements, and the others.
fn split_off<T>(all: &mut [T], count: usize) -> (&mut [T], &mut [T]) {
    let count = count.min(all.len());
    all.split_at_mut_checked(count).unwrap_or_default()
}

/// Rows of a target, from top to bottom.
pub(crate) struct Lines<'a, C, D> {
    color: &'a mut [C],
    depth: &'a mut [D],
    strides: [usize; 2],
    /// The row's first pixel.
    first: [usize; 2],
}

impl<C, D> Lines<'_, C, D> {
    /// The colours and the depths of so many columns of the row from `start` on; none where there are none.
    #[inline(always)]
    #[expect(clippy::cast_sign_loss, reason = "sums wrap back")]
    pub(crate) fn run(&mut self, start: i32, count: i32) -> Option<Pixels<'_, C, D>> {
        // Negative numbers wrap, or are too large.
        let [start, count] = [start as usize, count as usize];
        let [color, depth] = map2(self.first, |first| first.wrapping_add(start));
        let (color, depth) = (self.color.get_mut(color..)?, self.depth.get_mut(depth..)?);
        Some((color.get_mut(..count)?, depth.get_mut(..count)?))
    }

    /// Goes down one row.
    #[inline(always)]
    pub(crate) fn next_row(&mut self) {
        let [color, depth] = self.first;
        self.first = [color.wrapping_add(self.strides[0]), depth.wrapping_add(self.strides[1])];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::depth::{D16, NoDepth};
    use alberti_math::{Rgba8, Rgba8888};

    #[test]
    fn buffers_must_fit() {
        let (mut color, mut depth) = ([0u32; 12], [0u16; 12]);
        assert!(
            Target::band(Rgba8888, D16, [4, 12], 9, &mut color, &mut depth)
                .is_ok_and(|b| b.limits() == [0..4, 9..12])
        );
        let error = |width, row, color: &mut [u32], depth: &mut [u16]| {
            Target::band(Rgba8888, D16, [width, 16384], row, color, depth).expect_err("must not fit")
        };
        assert_eq!(error(5, 0, &mut color, &mut depth), TargetError::Rows { pixels: 12, width: 5 });
        assert_eq!(error(4, 0, &mut color, &mut depth[1..]), TargetError::Depth { found: 11, expected: 12 });
        assert_eq!(error(0, 0, &mut color, &mut depth), TargetError::Size);
        assert_eq!(error(4, 0, &mut [], &mut []), TargetError::Size);
        assert_eq!(error(4, 16382, &mut color, &mut depth), TargetError::Size);
        assert_eq!(error(4, u32::MAX, &mut color, &mut depth), TargetError::Size);
    }

    #[test]
    fn a_depth_buffer_of_nothing_costs_nothing() {
        let (mut color, mut depth) = ([0u32; 6], [(); 6]);
        assert_eq!(size_of_val(&depth), 0);
        let mut band = Target::new(Rgba8888, NoDepth, 3, 2, &mut color, &mut depth).expect("fits");
        band.clear(Rgba8::WHITE);
        assert_eq!(color, [u32::MAX; 6]);
    }

    #[test]
    fn a_scissor_keeps_what_is_outside() {
        let (mut color, mut depth) = ([0u32; 12], [(); 12]);
        let mut band = Target::band(Rgba8888, NoDepth, [4, 10], 7, &mut color, &mut depth).expect("fits");
        band.scissor(-3..3, 8..100).clear(Rgba8::WHITE);
        let w = u32::MAX;
        assert_eq!(color, [0, 0, 0, 0, w, w, w, 0, w, w, w, 0]);
    }

    #[test]
    fn there_are_no_pixels_outside_the_band() {
        let (mut color, mut depth) = ([0u32; 6], [(); 6]);
        let mut band = Target::band(Rgba8888, NoDepth, [3, 7], 5, &mut color, &mut depth).expect("fits");
        assert_eq!(band.pixels_from(5, 1).0.len(), 5);
        assert_eq!(band.pixels_from(6, 2).0.len(), 1);
        assert_eq!(band.pixels_from(4, 1).0.len(), 0);
        assert_eq!(band.pixels_from(7, 1).0.len(), 0);
        assert_eq!(band.pixels_from(-1, -1).0.len(), 0);
    }

    #[test]
    fn a_frame_is_as_large_as_it_says() {
        let (mut color, mut depth) = ([0u32; 12], [0u16; 12]);
        let mut error = |w, h| Target::new(Rgba8888, D16, w, h, &mut color, &mut depth).map(|_| ()).err();
        assert_eq!([error(4, 3), error(12, 1)], [None; 2]);
        for [w, h] in [[4, 4], [4, 2], [5, 2], [0, 3], [4, 0]] {
            let expected = (w * h) as usize;
            assert_eq!(error(w, h), Some(TargetError::Color { found: 12, expected }));
        }
        assert_eq!(error(20_000, 1), Some(TargetError::Size));
        let mut none = Target::new(Rgba8888, D16, 0, 0, &mut [], &mut []);
        assert_eq!(none.as_mut().map(|_| ()).err(), Some(&mut TargetError::Size));
    }

    #[test]
    fn a_window_leaves_what_is_beside_it() {
        // 3 x 2 in rows of 5, the last of which ends with the window.
        let (mut color, mut depth) = ([0u32; 8], [0u16; 6]);
        let mut window =
            Target::window(Rgba8888, D16, [3, 2], 0..2, 5, &mut color, &mut depth).expect("fits");
        window.clear(Rgba8::WHITE);
        assert_eq!((window.pixels_from(0, 1).0.len(), window.pixels_from(1, 1).0.len()), (5, 2));
        let w = u32::MAX;
        assert_eq!(color, [w, w, w, 0, 0, w, w, w]);
        let mut error = |size: [u32; 2], rows, stride, pixels: usize| {
            Target::window(Rgba8888, D16, size, rows, stride, &mut color[..pixels], &mut depth)
                .map(|_| ())
                .err()
        };
        // Both rows of the frame, or the last two of the largest.
        for (height, rows) in [(2, 0..2), (LARGEST, LARGEST - 2..LARGEST)] {
            let mut error = |width, stride, pixels| error([width, height], rows.clone(), stride, pixels);
            assert_eq!(error(3, 5, 8), None);
            assert_eq!(error(3, 5, 7), Some(TargetError::Color { found: 7, expected: 8 }));
            assert_eq!(error(3, 2, 8), Some(TargetError::Stride { stride: 2, width: 3 }));
            assert_eq!(error(2, 5, 8), Some(TargetError::Depth { found: 6, expected: 4 }));
            let expected = usize::MAX;
            assert_eq!(error(3, expected, 8), Some(TargetError::Color { found: 8, expected }));
        }
        let (none, after) = (1..1, LARGEST - 1..LARGEST + 1);
        #[expect(clippy::reversed_empty_ranges, reason = "no rows either")]
        let turned = 2..1;
        for (height, rows) in
            [(0, 0..0), (2, none), (2, turned), (2, 1..3), (LARGEST, after), (LARGEST + 1, 0..2)]
        {
            assert_eq!(
                error([3, height], rows.clone(), 3, 8),
                Some(TargetError::Size),
                "{rows:?} of {height}"
            );
        }
        // One row, and no pixel behind it, whatever the stride is.
        let mut row =
            Target::window(Rgba8888, D16, [3, 9], 8..9, usize::MAX, &mut color[..3], &mut depth[..3]);
        row.as_mut().expect("fits").clear(Rgba8::BLACK);
        assert_eq!(color[3..], [0, 0, w, w, w]);
    }
}
