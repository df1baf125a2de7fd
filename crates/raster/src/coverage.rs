//! Smooth silhouettes: the part of each pixel that triangles cover, from the edges of the snapped triangles.
//!
//! ```text
//!     ......|......|......|         A row of pixels. The edge adds to a pixel the area on its right, and to the next
//!     .     | ..../|xxxxxx|         one what is left of the edge's height: sums along the row are the areas.
//!     .   ..|/xxxxx|xxxxxx|
//!     . /xxx|xxxxxx|xxxxxx|         What an edge adds, another triangle at it takes away again, exactly.
//! ```

mod edge;
mod edges;
mod fringe;
mod pieces;

use crate::color::{Average, Blended, ColorFormat, InLight, Over, ReadColor};
use crate::depth::DepthFormat;
use crate::draw::Paint;
use crate::error::TargetError;
use crate::interpolation::Interpolation;
use crate::pixels::narrowed;
use crate::target::Target;
use crate::triangle::{Corner, Corners, Cull, Outcome, doubled_area};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{GUARD_PIXELS, Rgba8, Varying, map3};
use core::ops::Range;
use edge::Edge;
pub use edges::Edges;
use edges::Place;
use pieces::Piece;

/// The edges of triangles in the rows of a target, of which [`coverage`](Self::coverage) makes the covered part of each
/// pixel.
///
/// Smooth edges take four steps, in a band as in a whole frame, of which the first knows nothing of the others:
///
/// 1. the picture is drawn;
/// 2. the same triangles add their edges to a silhouette: [`Paint::edges`];
/// 3. its coverage is summed, and pixels that are covered beside their centre get the colour of the edge:
///    [`Paint::fringe`];
/// 4. pixels that are covered in part are mixed with the background: [`Coverage::resolve`].
///
/// Colours never come from other pixels. So bands need no rows of their neighbours, and what is narrower than a pixel
/// is thin, instead of a row of dots.
///
/// ```
/// use alberti_math::lanes::One;
/// use alberti_math::{Fixed, Rgba8, Sub8};
/// use alberti_raster::color::Average;
/// use alberti_raster::{Corner, Cull, Exact, NoDepth, Paint, Rgba8888, Silhouette, Target, Vertex};
///
/// let (mut color, mut depth, mut cells) = ([0; 4 * 2], [(); 4 * 2], [0; 4 * 2]);
/// let mut target = Target::new(Rgba8888, NoDepth, 4, 2, &mut color, &mut depth)?;
/// target.clear(Rgba8::BLACK);
///
/// // Half of a square from (0.75, 0) to (2.75, 2).
/// let vertex = |x, y| {
///     let [x, y] = [x, y].map(|c| Fixed::from_subpixels(c).expect("near"));
///     Vertex { x, y, zs: 0.5, q: 1.0, varying: () }
/// };
/// let corners = [vertex(192, 0), vertex(192, 512), vertex(704, 0)];
/// let white = |()| Some(Rgba8::WHITE);
/// let paint = Paint { stage: white, interpolation: Exact, subpixel: Sub8, cull: Cull::Back };
/// paint.triangle(One, &mut target, corners.each_ref(), &mut ());
///
/// let mut silhouette = Silhouette::new(&target, &mut cells)?;
/// let corners = corners.map(|vertex| Corner::new(paint.numbers(NoDepth), &vertex));
/// paint.cover(&mut silhouette, corners.each_ref());
/// let coverage = silhouette.coverage();
/// assert_eq!([0, 1, 2, 3].map(|column| coverage.part([column, 0])), [16384, 63488, 18432, 0]);
/// paint.fringe(&mut target, &coverage, corners.each_ref(), &mut ());
/// coverage.resolve(&mut target, Average::Bytes, |_| Rgba8::BLACK);
/// assert_eq!([0, 1, 2, 3].map(|column| color[column].to_ne_bytes()[0]), [64, 247, 72, 0]);
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
///
/// # Precision
/// Sums are exact, in 2^-16 of a pixel, and edges that two triangles share leave nothing. So a pixel through which no
/// silhouette passes is covered wholly or not at all, to the bit. An edge's area in a pixel is within 1.5·2^-16 of that
/// of the snapped edge, and so a triangle's within 4.5·2^-16. Where the edge crosses the sides of pixels is rounded to
/// 2^-16: half of a step sideways, and a quarter of one at each of two columns. The area is rounded by the last half.
///
/// Areas are added, whatever part of the pixel they are, up to the whole: two surfaces that cover a half each are the
/// whole. So coverage is exact where one silhouette over the background passes a pixel, and too great where another
/// begins in the same pixel. Both faces of a closed surface would be twice the area, which [`Cull::Back`] keeps out. Up
/// to 511 surfaces may be over one another; with more, a pixel may count as not covered.
///
/// Silhouettes before another surface, instead of the background, stay as they are.
///
/// # Cost
/// Four bytes a pixel, cleared, summed and read once. An edge: up to four divisions of 64 bits, and up to two more in
/// each row in which it crosses columns. A pixel on it: a product of 64 bits, and two sums in memory. Interiors of
/// triangles cost nothing, and most inner edges of a mesh little, if there are words for them to wait: see [`Edges`].
///
/// # Source
/// Areas and heights in cells are those of `FreeType`'s smooth rasterizer (D. Turner); sums of differences along rows
/// those of font-rs (R. Levien).
#[derive(Debug)]
pub struct Silhouette<'a> {
    cells: Cells<'a>,
    /// Columns and rows of the frame.
    size: [u32; 2],
    /// The columns and rows whose pixels are asked for.
    limits: [Range<i32>; 2],
    /// Places for edges that wait for their others.
    waiting: &'a mut [Place],
}

/// The covered part of each pixel of a [`Silhouette`].
#[derive(Debug)]
pub struct Coverage<'a> {
    cells: Cells<'a>,
}

/// A word for each pixel: area in 2^-16 of it above [`COUNT`] bits, in which its centre is counted.
///
/// Words wrap, so that sums are right whatever the order, as long as they fit at the end.
#[derive(Debug)]
struct Cells<'a> {
    words: &'a mut [i32],
    /// The columns and rows that there are words for.
    limits: [Range<i32>; 2],
}

/// Bits of the number of triangles that cover a pixel's centre. What is more carries to the area, and is nothing there.
const COUNT: u32 = 6;

/// The area of a pixel.
const WHOLE: i32 = 1 << 16;

impl Cells<'_> {
    fn index(&self, [column, row]: [i32; 2]) -> Option<usize> {
        let [columns, rows] = &self.limits;
        if !columns.contains(&column) || !rows.contains(&row) {
            return None;
        }
        let [column, row] = [column - columns.start, row - rows.start].map(i32::unsigned_abs);
        Some(row as usize * columns.len() + column as usize)
    }

    /// Adds to a pixel's word, and so to those of all pixels on its right.
    #[inline(always)]
    fn add(&mut self, place: [i32; 2], area: i32, count: i32) {
        if let Some(word) = self.index(place).and_then(|index| self.words.get_mut(index)) {
            *word = word.wrapping_add((area << COUNT).wrapping_add(count));
        }
    }

    /// Adds an edge as often as it counts: once for a triangle on its right, and once less for one on its left.
    #[inline(never)]
    fn add_edge(&mut self, edge: Edge, times: i32, bits: u32, limits: &[Range<i32>; 2]) {
        if times == 0 {
            return;
        }
        edge.pieces(bits, limits, |Piece { place: [column, row], height, left, .. }| {
            self.add([column, row], times.wrapping_mul(height - left), 0);
            if left != 0 {
                self.add([column + 1, row], times.wrapping_mul(left), 0);
            }
        });
        edge.centres(bits, limits, |place| self.add(place, 0, times));
    }

    fn word(&self, place: [i32; 2]) -> i32 {
        self.index(place).and_then(|index| self.words.get(index)).copied().unwrap_or_default()
    }
}

/// The covered part of a pixel.
#[derive(Clone, Copy, Debug)]
struct Part(i32);

impl Part {
    /// In 2^-16, at most the whole. Less than nothing comes from rounding.
    #[inline(always)]
    fn area(self) -> u32 {
        (self.0 >> COUNT).clamp(0, WHOLE).unsigned_abs()
    }

    /// In 255ths, to the nearest.
    #[inline(always)]
    fn share(self) -> u32 {
        (self.area() * 255 + (1 << 15)) >> 16
    }

    /// Whether there is a colour to be mixed, but none that was drawn.
    #[inline(always)]
    fn is_fringe(self) -> bool {
        !self.has_centre() && self.share() > 0
    }

    #[inline(always)]
    fn has_centre(self) -> bool {
        self.0 & ((1 << COUNT) - 1) != 0
    }
}

impl<'a> Silhouette<'a> {
    /// The words of a place to wait at.
    pub const PLACE: usize = 5;

    /// No edges, in the columns and rows that may be drawn to in `target`, for each of which `cells` has at least a
    /// word. The words after these are [places](Self::PLACE) at which edges wait for the other triangle at them: see
    /// [`Edges`]. It may be another's buffer; the words are cleared.
    ///
    /// # Errors
    /// [`TargetError::Coverage`] if there are fewer words.
    pub fn new<C: ColorFormat, D: DepthFormat>(
        target: &Target<'_, C, D>,
        cells: &'a mut [i32],
    ) -> Result<Self, TargetError> {
        let limits = target.limits();
        let (found, expected) = (cells.len(), limits[0].len() * limits[1].len());
        cells.fill(0);
        let (words, rest) =
            cells.split_at_mut_checked(expected).ok_or(TargetError::Coverage { found, expected })?;
        let (waiting, _) = rest.as_chunks_mut();
        Ok(Self { cells: Cells { words, limits: limits.clone() }, size: target.size(), limits, waiting })
    }

    /// The same silhouette, of which only these columns and rows of the frame can be covered from now on.
    pub fn scissor(&mut self, columns: Range<i32>, rows: Range<i32>) -> Silhouette<'_> {
        let limits = [narrowed(&self.limits[0], columns), narrowed(&self.limits[1], rows)];
        let words = &mut *self.cells.words;
        let cells = Cells { words, limits: self.cells.limits.clone() };
        Silhouette { cells, size: self.size, limits, waiting: self.waiting }
    }

    /// Columns and rows of the frame.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The columns and rows of the frame that can be covered.
    #[must_use]
    pub fn limits(&self) -> [Range<i32>; 2] {
        self.limits.clone()
    }

    /// The sums along the rows.
    #[must_use]
    pub fn coverage(self) -> Coverage<'a> {
        let cells = self.cells;
        for row in cells.words.chunks_exact_mut(cells.limits[0].len().max(1)) {
            let mut sum = 0_i32;
            for word in row {
                sum = sum.wrapping_add(*word);
                *word = sum;
            }
        }
        Coverage { cells }
    }
}

impl Coverage<'_> {
    /// The covered part of a pixel, in 65536ths; 0 outside of the silhouette's columns and rows.
    #[must_use]
    pub fn part(&self, place: [i32; 2]) -> u32 {
        Part(self.cells.word(place)).area()
    }

    /// Whether a pixel's centre is covered, and so its colour drawn. The same as [`Paint::triangle`] finds, unless 64
    /// triangles, or a multiple of these, cover the centre.
    #[must_use]
    pub fn has_centre(&self, place: [i32; 2]) -> bool {
        Part(self.cells.word(place)).has_centre()
    }

    /// Mixes each pixel that is covered in part with its `background`: as much of the colour that is there as is
    /// covered, and of the background as is not. `average` is that of both. All others stay.
    ///
    /// A closure gives backgrounds by column and row: one for all, or those of a gradient, or of another picture. As
    /// the colour is shown opaque, alpha is that of the background above what is covered.
    ///
    /// # Precision
    /// The part is rounded to 255ths, of bytes or of light; then each channel correctly.
    ///
    /// # Cost
    /// A word a pixel. One that is covered in part: both colours, and [`Over`], of light in [`InLight`]. Of bytes in
    /// RGB565, with a torus in the frame, 8.5 instructions a pixel of it on a Cortex-M4F, 12 on a Cortex-M0+.
    pub fn resolve<C: ReadColor, D: DepthFormat>(
        &self,
        target: &mut Target<'_, C, D>,
        average: Average,
        mut background: impl FnMut([i32; 2]) -> Rgba8,
    ) {
        let format = target.color_format();
        let [columns, rows] = self.within(target);
        for row in rows {
            let Some(first) = self.cells.index([columns.start, row]) else { continue };
            let words = self.cells.words.get(first..).unwrap_or_default();
            let (pixels, _) = target.pixels_from(row, columns.start);
            for ((column, word), pixel) in columns.clone().zip(words).zip(pixels) {
                let (part, place) = (Part(*word), [column, row]);
                // Most pixels are the background's.
                if part.0 == 0 {
                    continue;
                }
                let share = part.share();
                if share >= 255 || (share == 0 && !part.has_centre()) {
                    continue;
                }
                // Colours with alpha in their highest byte.
                let shown = format.color(*pixel).to_bits() & 0x00ff_ffff | share << 24;
                let mut stored = [format.pixel(background(place))];
                let word = One.word(shown);
                match average {
                    Average::Light => Blended { format, by: InLight(Over) }.store::<One, Rgba8>(
                        One,
                        word,
                        true,
                        place,
                        &mut stored,
                    ),
                    Average::Bytes => {
                        Blended { format, by: Over }.store::<One, Rgba8>(One, word, true, place, &mut stored);
                    }
                }
                [*pixel] = stored;
            }
        }
    }

    /// The columns and rows that a target has too.
    fn within<C: ColorFormat, D: DepthFormat>(&self, target: &Target<'_, C, D>) -> [Range<i32>; 2] {
        let [columns, rows] = target.limits();
        [narrowed(&self.cells.limits[0], columns), narrowed(&self.cells.limits[1], rows)]
    }
}

impl<F, P: Interpolation> Paint<F, P> {
    /// The rows of those pixels among the columns and rows of `limits` of which a triangle may cover a part.
    ///
    /// # Errors
    /// [`Outcome::Culled`] if it faces the wrong way or has no area, [`Outcome::Missed`] if its box passes none.
    pub fn touched<V: Varying>(
        &self,
        corners: [&Corner<V>; 3],
        limits: &[Range<i32>; 2],
    ) -> Result<Range<i32>, Outcome> {
        let (fixed, bits) = (const { <P::Lanes<One> as Lanes>::FIXED }, self.subpixel.bits());
        let corners = map3(corners, |corner| corner.place(fixed));
        seen(&corners, self.cull, bits).ok_or(Outcome::Culled)?;
        if misses(&corners, bits, limits) {
            return Err(Outcome::Missed);
        }
        let [[_, a], [_, b], [_, c]] = corners;
        Ok(narrowed(&limits[1], a.min(b).min(c) >> bits..((a.max(b).max(c) - 1) >> bits) + 1))
    }
}

/// Twice the area of a triangle, if it is not left out, and within the guard band.
fn seen(corners: &Corners, cull: Cull, bits: u32) -> Option<i64> {
    let guard = GUARD_PIXELS << bits;
    if corners.as_flattened().iter().any(|c| !(-guard..=guard).contains(c)) {
        return None;
    }
    let area = doubled_area(corners);
    (area != 0 && !cull.drops(area)).then_some(area)
}

/// Whether a triangle covers nothing of these columns and rows, as far as its box tells.
fn misses(corners: &Corners, bits: u32, [columns, rows]: &[Range<i32>; 2]) -> bool {
    let [xs, ys] = [map3(*corners, |[x, _]| x), map3(*corners, |[_, y]| y)];
    [(xs, columns), (ys, rows)].into_iter().any(|(its, Range { start, end })| {
        its.iter().all(|c| c >> bits >= *end) || its.iter().all(|c| (c - 1) >> bits < *start)
    })
}

#[cfg(test)]
mod tests;
