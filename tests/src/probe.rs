//! Asking the rasterizer about single pixels of the largest frame there can be.

use crate::for_widest;
use alberti_math::{Fixed, Subpixel, Varying};
use alberti_raster::{
    ColorFormat, Counters, Cull, DepthFormat, Exact, FragmentStage, NoDepth, Outcome, Paint, Rgba8888,
    Target, Vertex,
};
use std::cell::{Cell, RefCell};
use std::ops::Range;

/// Columns and rows of the largest frame.
pub const LARGEST: i32 = 1 << 14;

/// A vertex at `p`, in subpixels.
///
/// # Panics
/// When `p` lies beyond the guard band.
#[must_use]
pub fn vertex<V>(p: [i64; 2], zs: f32, q: f32, varying: V) -> Vertex<V> {
    let at = |c: i64| i32::try_from(c).ok().and_then(Fixed::from_subpixels);
    let [Some(x), Some(y)] = p.map(at) else { panic!("{p:?} lies beyond the guard band") };
    Vertex { x, y, zs, q, varying }
}

/// A vertex that was at `p`, in 256ths of subpixels, and was snapped from there.
///
/// # Panics
/// When `p` lies beyond the guard band.
#[must_use]
pub fn unsnapped<V>(p: [i64; 2], zs: f32, q: f32, varying: V) -> Vertex<V> {
    let [x, y] = p.map(|c| {
        let bits = i32::try_from(c + 128).unwrap_or_else(|_| panic!("{p:?} lies beyond the guard band"));
        Fixed::from_bits(bits.cast_unsigned())
    });
    Vertex { x, y, zs, q, varying }
}

/// The subpixel that such a place is snapped to.
#[must_use]
pub fn snapped(p: [i64; 2]) -> [i64; 2] {
    p.map(|c| (c + 128).div_euclid(256))
}

/// Three vertices that carry nothing.
#[must_use]
pub fn bare(tri: [[i64; 2]; 3]) -> [Vertex<()>; 3] {
    tri.map(|p| vertex(p, 0.5, 1.0, ()))
}

/// Counts covered samples, and hears the fate of the last triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Covered {
    /// The samples.
    pub samples: u64,
    /// The fate.
    pub outcome: Option<Outcome>,
}

impl Counters for Covered {
    fn rasterized(&mut self, outcome: Outcome) {
        self.outcome = Some(outcome);
    }

    fn span(&mut self, covered: u32, _: u32) {
        self.samples += u64::from(covered);
    }

    fn add(&mut self, Self { samples, outcome }: Self) {
        self.samples += samples;
        self.outcome = outcome.or(self.outcome);
    }
}

/// A depth format that shows whatever comes and keeps it: the buffer then holds what was interpolated.
#[derive(Clone, Copy, Debug)]
pub struct Recorded;

impl DepthFormat for Recorded {
    type Stored = f32;

    fn farthest(self) -> f32 {
        1.0
    }

    fn encode(self, zs: f32) -> f32 {
        zs
    }

    fn nearer(self, _: f32, _: f32) -> bool {
        true
    }
}

/// The varyings of fragments, bit for bit: a fragment's colour is its place in this list.
#[derive(Debug, Default)]
pub struct Seen<V>(RefCell<Vec<V>>);

impl<V: Copy> Seen<V> {
    /// Keeps a value. Places count from 1.
    pub fn keep(&self, value: V) -> Option<u32> {
        self.0.borrow_mut().push(value);
        u32::try_from(self.0.borrow().len()).ok()
    }

    /// The value of a pixel of [`Rgba8888`].
    ///
    /// # Panics
    /// Where there is none.
    pub fn at(&self, pixel: u32) -> V {
        self.0.borrow()[u32::from_le(pixel) as usize - 1]
    }
}

/// Draws exactly, with the widest lanes that there are.
pub fn draw_widest<V, F, C, D, K>(
    subpixel: Subpixel,
    target: &mut Target<'_, C, D>,
    vertices: [&Vertex<V>; 3],
    cull: Cull,
    stage: F,
    counters: &mut K,
) where
    V: Varying,
    F: FragmentStage<V>,
    C: ColorFormat,
    D: DepthFormat,
    K: Counters,
{
    let paint = Paint { stage, interpolation: Exact, subpixel, cull };
    for_widest!(lanes => paint.triangle(lanes, target, vertices, counters));
}

/// The number of subpixels of a pixel, and of half a pixel.
#[must_use]
pub fn steps(subpixel: Subpixel) -> [i64; 2] {
    [1 << subpixel.bits(), 1 << (subpixel.bits() - 1)]
}

/// One row of buffers, that serves as any row of the frame.
#[derive(Debug)]
pub struct Probe<D: DepthFormat> {
    subpixel: Subpixel,
    format: D,
    color: Vec<u32>,
    depth: Vec<D::Stored>,
}

impl<D: DepthFormat> Probe<D> {
    /// A row for triangles on this grid.
    #[must_use]
    pub fn new(format: D, subpixel: Subpixel) -> Self {
        let pixels = LARGEST.unsigned_abs() as usize;
        Self { subpixel, format, color: vec![0; pixels], depth: vec![format.farthest(); pixels] }
    }

    fn target(&mut self, row: i32) -> Target<'_, Rgba8888, D> {
        let (size, row) = ([LARGEST.unsigned_abs(); 2], row.unsigned_abs());
        Target::band(Rgba8888, self.format, size, row, &mut self.color, &mut self.depth)
            .expect("one row of the frame")
    }
}

impl Probe<NoDepth> {
    /// The coverage of these pixels of `row` by a triangle: 1 or 0 for each.
    ///
    /// # Panics
    /// When the pixels lie outside the frame, or when others than these are written.
    pub fn covered(&mut self, tri: [[i64; 2]; 3], columns: Range<i32>, row: i32) -> &[u32] {
        let places = columns.start.unsigned_abs() as usize..columns.end.unsigned_abs() as usize;
        self.color[places.clone()].fill(0);
        let (subpixel, mut target) = (self.subpixel, self.target(row));
        let [a, b, c] = bare(tri);
        let mut count = Covered::default();
        let mut target = target.scissor(columns, 0..LARGEST);
        draw_widest(subpixel, &mut target, [&a, &b, &c], Cull::None, |()| Some(1u32), &mut count);
        let found = &self.color[places];
        let seen: u64 = found.iter().map(|&pixel| u64::from(pixel.to_le())).sum();
        assert_eq!(seen, count.samples, "a span reached beyond the scissor: {tri:?} in row {row}");
        found
    }
}

impl Probe<Recorded> {
    /// The varying and zs that the rasterizer interpolates at this pixel; `None` where the triangle does not cover it.
    pub fn interpolated<V: Varying>(
        &mut self,
        [a, b, c]: &[Vertex<V>; 3],
        [column, row]: [i32; 2],
    ) -> Option<(V, f32)> {
        let found = Cell::new(None);
        let stage = |v: V| {
            found.set(Some(v));
            Some(u32::MAX)
        };
        let (subpixel, mut target) = (self.subpixel, self.target(row));
        let mut pixel = target.scissor(column..column + 1, row..row + 1);
        let mut count = Covered::default();
        draw_widest(subpixel, &mut pixel, [a, b, c], Cull::None, stage, &mut count);
        assert!(found.get().is_none() || count.outcome == Some(Outcome::Drawn));
        let zs = self.depth[column.unsigned_abs() as usize];
        found.get().map(|v| (v, zs))
    }
}
