//! Derivatives in `f32`.
#![expect(missing_debug_implementations, reason = "states of drawing, which have no name outside")]

use super::{Quotients, Samples, of_pairs};
use crate::edge::EdgeInt;
use crate::interpolation::{Oriented, Row, scaled_q};
use crate::spans::Span;
use crate::triangle::Corners;
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Gradient, Mode, Varying};

/// The quotients of a triangle, in floats.
#[derive(Clone, Copy)]
pub struct FloatQuotients<V: Varying> {
    corners: Corners,
    /// Bits of the subpixels.
    bits: u32,
    q: [f32; 3],
    /// Of hyperbolic components twice the area times ga, gb and gc, for distances in subpixels and derivatives by
    /// pixels; of others the derivatives themselves.
    numerators: V::Of<[f32; 3]>,
}

impl<L: Floating, V: Varying> Quotients<L, V> for FloatQuotients<V> {
    type Area = ();
    type Run = RunQuotients<L, V>;

    #[inline(always)]
    fn area(_: i64) {}

    #[inline(always)]
    fn new(triangle: &Oriented<'_, V>, (): ()) -> Self {
        let q = scaled_q(triangle);
        let [qa, qb, qc] = q;
        let [a, b, c] = triangle.corners;
        let one = number(triangle.one());
        let common = triangle.area() * one;
        let factors = [qb * qc * common, qc * qa * common, qa * qb * common];
        // Increments of the edge functions of the second and the third vertex: for a pixel to the right, and for one
        // down.
        let of_b = [number(c[1] - a[1]), number(a[0] - c[0])];
        let of_c = [number(a[1] - b[1]), number(b[0] - a[0])];
        let per_area = one / triangle.area();
        let numerators = V::map_by_mode(&triangle.words(), &|mode, [u, v, w, _]: [u32; 4]| {
            let less = |u: u32, v: u32| f32::from_bits(u) - f32::from_bits(v);
            match mode {
                Mode::Hyperbolic => {
                    [factors[0] * less(v, w), factors[1] * less(w, u), factors[2] * less(u, v)]
                }
                Mode::Linear => {
                    let [v, w] = [less(v, u), less(w, u)];
                    let per = |k: usize| (of_b[k] * v + of_c[k] * w) * per_area;
                    [per(0), per(1), 0.0]
                }
                Mode::Flat => [0.0; 3],
            }
        });
        Self { corners: triangle.corners, bits: triangle.bits, q, numerators }
    }

    #[inline(always)]
    fn in_centroid(lanes: L, triangle: &Oriented<'_, V>, (): ()) -> V::Of<[L::Number; 2]> {
        let of = <Self as Quotients<L, V>>::new(triangle, ());
        let ([a, b, c], [qa, qb, qc]) = (of.corners, of.q);
        // Three times the distances, and three times T.
        let t = triangle.area() * (qa + qb + qc);
        of.derivatives(lanes, of.distances([a[0] + b[0] + c[0], a[1] + b[1] + c[1]], 3), 3.0 / (t * t))
    }

    #[inline(always)]
    fn in_middle<I: EdgeInt>(&self, lanes: L, row: &Row<'_, I>, run: Span) -> V::Of<[L::Number; 2]> {
        let column = run.start + ((run.end - run.start) >> 1);
        let t = sum(row.at(column).map(I::to_f32), self.q);
        self.derivatives(lanes, self.distances(self.sample([column, row.row]), 1), 1.0 / (t * t))
    }

    #[inline(always)]
    fn run<I: EdgeInt>(&self, lanes: L, row: &Row<'_, I>, run: Span) -> RunQuotients<L, V> {
        let splat = |x: f32| lanes.splat(x);
        let [rows, columns] = self.distances(self.sample([run.start, row.row]), 1);
        let one = number(1 << self.bits);
        RunQuotients {
            start: run.start,
            numerators: V::map_by_mode(&self.numerators, &|mode, g: [f32; 3]| match mode {
                Mode::Hyperbolic => [sum(rows, g), sum(columns, g), (g[0] + g[1] + g[2]) * one].map(splat),
                _ => g.map(splat),
            }),
        }
    }

    #[inline(always)]
    fn at(&self, lanes: L, run: &RunQuotients<L, V>, at: &Samples<'_, L, V>) -> Gradient<V::Of<L::Number>> {
        let per = at.reciprocal.unwrap_or_else(
            #[inline(always)]
            || {
                let ([ea, eb, ec], [qa, qb, qc]) = (*at.weights, self.q.map(|q| lanes.splat(q)));
                lanes.splat(1.0) / (ea * qa + eb * qb + ec * qc)
            },
        );
        let per = per * per;
        #[expect(clippy::cast_precision_loss, reason = "columns are below 2^24")]
        let x = lanes.ramp() + lanes.splat((at.column - run.start) as f32);
        of_pairs::<V, _>(&V::map_by_mode(&run.numerators, &|mode, [a, b, j]: [L::Number; 3]| match mode {
            Mode::Hyperbolic => [a * per, (b - j * x) * per],
            _ => [a, b],
        }))
    }
}

impl<V: Varying> FloatQuotients<V> {
    /// The derivatives by column and row at a place with these [distances](Self::distances), where `per` is 1/T².
    #[inline(always)]
    fn derivatives<L: Lanes>(&self, lanes: L, distances: [[f32; 3]; 2], per: f32) -> V::Of<[L::Number; 2]> {
        V::map_by_mode(&self.numerators, &|mode, g: [f32; 3]| {
            let pair = if mode == Mode::Hyperbolic {
                distances.map(|along| sum(along, g) * per)
            } else {
                [g[0], g[1]]
            };
            pair.map(|derivative| lanes.splat(derivative))
        })
    }

    /// The distances of a place from the corners by rows, and of the corners from it by columns, times a factor. The
    /// place and the distances are in subpixels, and times that factor.
    #[inline(always)]
    fn distances(&self, [x, y]: [i32; 2], factor: i32) -> [[f32; 3]; 2] {
        [self.corners.map(|[_, k]| number(y - factor * k)), self.corners.map(|[k, _]| number(factor * k - x))]
    }

    /// A sample's place in subpixels.
    #[inline(always)]
    fn sample(&self, place: [i32; 2]) -> [i32; 2] {
        place.map(|k| (k << self.bits) + (1 << self.bits >> 1))
    }
}

/// A distance as a number: exactly, but for three times one.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "at most 2^24, and three times that is rounded")]
fn number(distance: i32) -> f32 {
    distance as f32
}

#[inline(always)]
fn sum([a, b, c]: [f32; 3], [x, y, z]: [f32; 3]) -> f32 {
    a * x + b * y + c * z
}

/// A run, to differentiate at its samples.
#[derive(Clone, Copy)]
pub struct RunQuotients<L: Lanes, V: Varying> {
    /// The column from which x is counted.
    start: i32,
    /// The numerators by column and by row at `start`, and what the second loses by column, of hyperbolic components;
    /// of others the derivatives themselves.
    numerators: V::Of<[L::Number; 3]>,
}
