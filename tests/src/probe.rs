//! Asking the rasterizer about single pixels of the largest frame there can be.

use alberti_math::lanes::Machine;
use alberti_math::{Fixed, Rgba8, Subpixel, Varying, for_lanes};
use alberti_raster::{
    Band, ColorFormat, Counters, Cull, DepthFormat, Exact, FragmentStage, NoDepth, Outcome, Store, Vertex,
    draw_triangle,
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
pub fn vertex<S: Subpixel, V>(p: [i64; 2], zs: f32, q: f32, varying: V) -> Vertex<S, V> {
    let at = |c: i64| i32::try_from(c).ok().and_then(Fixed::from_subpixels);
    let [Some(x), Some(y)] = p.map(at) else { panic!("{p:?} lies beyond the guard band") };
    Vertex { x, y, zs, q, varying }
}

/// Three vertices that carry nothing.
#[must_use]
pub fn bare<S: Subpixel>(tri: [[i64; 2]; 3]) -> [Vertex<S, ()>; 3] {
    tri.map(|p| vertex(p, 0.5, 1.0, ()))
}

/// Counts covered samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct Covered(pub u64);

impl Counters for Covered {
    fn span(&mut self, covered: u32, _: u32) {
        self.0 += u64::from(covered);
    }
}

/// A depth format that shows whatever comes and keeps it: the buffer then holds what was interpolated.
#[derive(Clone, Copy, Debug)]
pub enum Recorded {}

impl DepthFormat for Recorded {
    type Stored = f32;
    const REVERSED: bool = false;
    const FARTHEST: f32 = 1.0;
    fn encode(zs: f32) -> f32 {
        zs
    }
    fn nearer(_: f32, _: f32) -> bool {
        true
    }
}

/// A colour format whose pixels are words as they come.
#[derive(Clone, Copy, Debug)]
pub enum Words {}

impl ColorFormat for Words {
    type Pixel = u32;
}

impl Store<u32> for Words {
    fn pixel(color: u32) -> u32 {
        color
    }
}

/// What fragments carried, to see interpolated values as they are: the colour is the place in this list.
#[derive(Debug, Default)]
pub struct Seen<V>(RefCell<Vec<V>>);

impl<V: Copy> Seen<V> {
    /// Keeps a value. Places count from 1.
    pub fn keep(&self, value: V) -> Option<u32> {
        self.0.borrow_mut().push(value);
        u32::try_from(self.0.borrow().len()).ok()
    }

    /// The value at a place.
    ///
    /// # Panics
    /// Where there is none.
    pub fn at(&self, place: u32) -> V {
        self.0.borrow()[place as usize - 1]
    }
}

/// Draws with the widest lanes that there are.
pub fn draw_widest<S, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    vertices: [&Vertex<S, V>; 3],
    cull: Cull,
    fragment: &F,
    counters: &mut K,
) -> Outcome
where
    S: Subpixel,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    let machine = Machine::all().next().expect("every machine has lanes");
    for_lanes!(machine, lanes => draw_triangle(Exact, lanes, band, vertices, cull, fragment, counters))
}

/// One row of buffers, that serves as any row of the frame.
#[derive(Debug)]
pub struct Probe<D: DepthFormat> {
    color: Vec<u32>,
    depth: Vec<D::Stored>,
}

impl<D: DepthFormat> Default for Probe<D> {
    fn default() -> Self {
        let pixels = LARGEST.unsigned_abs() as usize;
        Self { color: vec![0; pixels], depth: vec![D::FARTHEST; pixels] }
    }
}

impl Probe<NoDepth> {
    /// Which of these pixels of `row` the triangle covers: 1 or 0 for each.
    ///
    /// # Panics
    /// When the pixels lie outside the frame, or when others than these are written.
    pub fn covered<S: Subpixel>(&mut self, tri: [[i64; 2]; 3], columns: Range<i32>, row: i32) -> &[u32] {
        let places = columns.start.unsigned_abs() as usize..columns.end.unsigned_abs() as usize;
        self.color[places.clone()].fill(0);
        let mut band = band::<NoDepth>(&mut self.color, &mut self.depth, row);
        let [a, b, c] = bare::<S>(tri);
        let mut count = Covered::default();
        let fragment = |()| Some(Rgba8::from_bits(1));
        draw_widest(&mut band.scissor(columns, 0..LARGEST), [&a, &b, &c], Cull::None, &fragment, &mut count);
        let found = &self.color[places];
        let seen: u64 = found.iter().map(|&pixel| u64::from(pixel.to_le())).sum();
        assert_eq!(seen, count.0, "a span reached beyond the scissor: {tri:?} in row {row}");
        found
    }
}

impl Probe<Recorded> {
    /// What the rasterizer interpolates at this pixel: the varying and zs; `None` where it does not cover it.
    pub fn interpolated<S: Subpixel, V: Varying>(
        &mut self,
        [a, b, c]: &[Vertex<S, V>; 3],
        [column, row]: [i32; 2],
    ) -> Option<(V, f32)> {
        let found = Cell::new(None);
        let fragment = |v: V| {
            found.set(Some(v));
            Some(Rgba8::WHITE)
        };
        let mut band = band::<Recorded>(&mut self.color, &mut self.depth, row);
        let mut pixel = band.scissor(column..column + 1, row..row + 1);
        let outcome = draw_widest(&mut pixel, [a, b, c], Cull::None, &fragment, &mut ());
        assert!(found.get().is_none() || outcome == Outcome::Drawn);
        let zs = self.depth[column.unsigned_abs() as usize];
        found.get().map(|v| (v, zs))
    }
}

fn band<'a, D: DepthFormat>(
    color: &'a mut [u32],
    depth: &'a mut [D::Stored],
    row: i32,
) -> Band<'a, Rgba8, D> {
    Band::new(LARGEST.unsigned_abs(), row.unsigned_abs(), color, depth).expect("one row of the frame")
}
