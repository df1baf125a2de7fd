//! Attributes at the pixel: hyperbolic, affine and as drawn, and the bound that the policy states; derivatives.

use super::report::{Block, Cell};
use super::shape::Shape;
use super::{Fragment, Scene, theory};
use crate::draw::components;
use crate::options::{Interpolation, Subpixel};
use alberti::Lines;
use alberti::raster::Gradient;

/// Half the distance from 1 to the next `f32`.
const EPSILON: f64 = 1.0 / 16_777_216.0;

impl Scene<'_> {
    /// All of them.
    pub(super) fn attributes(&self, fragment: &Fragment<'_>) -> Vec<Block> {
        let used = self.drawing.used(fragment.part);
        let mut blocks = vec![self.values(fragment, &used)];
        if let Some(size) = self.drawing.texture_size(fragment.part) {
            blocks.push(self.derivatives(fragment, &used, size));
        }
        blocks
    }

    /// A component as it was drawn.
    fn drawn(&self, bits: u32) -> f64 {
        if self.is_fixed() { f64::from(bits.cast_signed()) / 65536.0 } else { f32::from_bits(bits).into() }
    }

    fn drawn_cell(&self, bits: u32) -> Cell {
        if self.is_fixed() { self.drawn(bits).into() } else { f32::from_bits(bits).into() }
    }

    fn values(&self, fragment: &Fragment<'_>, used: &[(&'static str, usize)]) -> Block {
        let shape = &fragment.shape;
        let title = format!("attributes, by {}", self.options.policies.interpolation);
        let mut block = Block::new("attributes", title, &[theory::HYPERBOLIC, theory::AFFINE]);
        if used.is_empty() {
            block.note("none", "the surface uses none: it has one colour");
            return block;
        }
        let drawn = components(&fragment.arrival.varying);
        let row = |&(name, component): &(&'static str, usize)| {
            let hyperbolic = shape.hyperbolic_beside(component, 0);
            let [p, q, r] = shape.corners_of(component);
            vec![
                name.into(),
                p.into(),
                q.into(),
                r.into(),
                hyperbolic.into(),
                shape.affine(component).into(),
                self.drawn_cell(drawn[component]),
                (self.drawn(drawn[component]) - hyperbolic).into(),
                self.bound(shape, component).into(),
            ]
        };
        let columns = [
            "name",
            "at P",
            "at Q",
            "at R",
            "hyperbolic",
            "affine",
            "drawn",
            "drawn less hyperbolic",
            "bound",
        ];
        block.table("values", &columns, used.iter().map(row).collect());
        block
    }

    /// The distance that the policy's documentation allows from the hyperbolic value.
    pub(super) fn bound(&self, shape: &Shape, component: usize) -> f64 {
        let corners = shape.corners_of(component);
        let greatest = corners.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        let range =
            corners.iter().fold(f64::MIN, |a, x| a.max(*x)) - corners.iter().fold(f64::MAX, |a, x| a.min(*x));
        let ratio = ratio(&shape.q);
        let over_triangle = range * miss(ratio);
        let [first, last] = shape.span();
        let (float, run) = match self.options.policies.interpolation {
            Interpolation::Exact => (9.0 * EPSILON * greatest, 0),
            Interpolation::Plane => {
                let ends = self.run(64, [first, last]).map(|column| shape.q_beside(column));
                ((15.0 * ratio_of(ends) + 5.0) * EPSILON * greatest, 0)
            }
            Interpolation::Spans(length) => {
                let ends = self.run(length.columns(), [first, last]);
                let [a, b] = ends.map(|column| shape.hyperbolic_beside(component, column));
                let line = (a - b).abs() * miss(ratio_of(ends.map(|column| shape.q_beside(column))));
                (line + 15.0 * EPSILON * greatest, length.columns())
            }
            Interpolation::Bounded(texels) => {
                let budget = f64::from(texels / f32::from(self.drawing.model.largest_side().max(1)));
                let least = if self.is_fixed() { 4.0 / 65536.0 } else { 0.0 };
                (budget.max(least) + 19.0 * EPSILON * greatest, Lines::LONGEST)
            }
            Interpolation::Affine => (over_triangle + 12.0 * EPSILON * greatest, Lines::LONGEST),
        };
        if !self.is_fixed() {
            return float;
        }
        let columns = f64::from(last - first + 1);
        let steps = (f64::from(run) + 3.0) / 65536.0;
        let in_runs = float + steps + range * (0.5f64.powi(17) + ratio * (columns + 4.0) * 0.5f64.powi(28));
        let small = match self.options.policies.subpixel {
            Subpixel::Sub4 => 32.0,
            Subpixel::Sub8 => 16.0,
        };
        let bounded = matches!(self.options.policies.interpolation, Interpolation::Bounded(_));
        // Small ones are one run.
        if shape.extent() < small && !bounded { in_runs.max(over_triangle + 1.5 / 65536.0) } else { in_runs }
    }

    /// The ends of the run that the pixel is in, counted from it: multiples of the length, or the row's ends.
    fn run(&self, length: i32, [first, last]: [i32; 2]) -> [i32; 2] {
        let along = self.pixel[0].cast_signed() & (length - 1);
        [first.max(-along), last.min(length - along)]
    }

    fn derivatives(&self, fragment: &Fragment<'_>, used: &[(&'static str, usize)], size: [u32; 2]) -> Block {
        let shape = &fragment.shape;
        let title = "derivatives of u and v by the column and the row of a pixel";
        let mut block = Block::new("derivatives", title, &[theory::DERIVATIVES, theory::LEVEL]);
        let gradient = fragment.arrival.gradient.map(|bundle| components(&bundle));
        let uv: Vec<_> = used.iter().filter(|(name, _)| ["u", "v"].contains(name)).collect();
        let mut texels = [[0.0; 2]; 2];
        let mut rows = Vec::new();
        for ((name, component), (side, length)) in uv.into_iter().zip(size.into_iter().enumerate()) {
            let [dx, dy] = [gradient.dx, gradient.dy].map(|by| by[*component]);
            let [exact_dx, exact_dy] = shape.derivatives(*component);
            let length = f64::from(length);
            texels[0][side] = self.drawn(dx) * length;
            texels[1][side] = self.drawn(dy) * length;
            rows.push(vec![
                (*name).into(),
                self.drawn_cell(dx),
                self.drawn_cell(dy),
                exact_dx.into(),
                exact_dy.into(),
                texels[0][side].into(),
                texels[1][side].into(),
            ]);
        }
        let columns = ["name", "d/dx", "d/dy", "d/dx exact", "d/dy exact", "d/dx texels", "d/dy texels"];
        block.table("derivatives", &columns, rows);
        let lengths = texels.map(|[u, v]| u.hypot(v));
        block.values("lengths", "lengths in texels, by column and by row", lengths);
        let lambda = lengths[0].max(lengths[1]).log2();
        block.value("lambda", "level of detail: log2 of the longer", lambda);
        #[expect(clippy::cast_possible_truncation, reason = "they were floats, or are shown as such")]
        let of = |by: [u32; 17]| [15, 16].map(|k| self.drawn(by[k]) as f32);
        let [width, height] = size;
        let drawn = Gradient { dx: of(gradient.dx), dy: of(gradient.dy) }.lod(width, height);
        block.value("lambda_drawn", "the same as the pipeline has it", drawn);
        block
    }
}

/// The share of a difference that a straight line misses, where q changes by this ratio.
fn miss(ratio: f64) -> f64 {
    (ratio.sqrt() - 1.0) / (ratio.sqrt() + 1.0)
}

fn ratio(q: &[f64]) -> f64 {
    q.iter().fold(0.0, |a, x| f64::max(a, *x)) / q.iter().fold(f64::MAX, |a, x| a.min(*x))
}

fn ratio_of(ends: [f64; 2]) -> f64 {
    ratio(&ends)
}
