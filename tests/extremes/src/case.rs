//! Single triangles on the screen, and a pixel that each covers: what the rasterizer interpolates there, and the truth.

use crate::EPS;
use crate::measured::Sample;
use crate::policy::Policy;
use alberti::lanes::One;
use alberti::raster::Vertex;
use alberti::{
    Cull, DepthFormat, Exact, Fixed, FixedPoint, Interpolation, Lines, Planes, Rgba8888, Sub8, Target,
};
use alberti_oracle::cases::pixel_centre;
use alberti_oracle::coverage::{Triangle, covers, weights};
use alberti_oracle::dd;
use std::cell::{Cell, RefCell};
use std::ops::Range;

/// Subpixels of a pixel, as a number of bits.
pub(crate) const BITS: u32 = 8;
/// Columns and rows of the largest frame.
pub(crate) const LARGEST: i64 = 1 << 14;

/// A depth format that keeps what was interpolated.
#[derive(Clone, Copy, Debug)]
struct Recorded;

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

thread_local! {
    /// One row of colours and depths, which serves as any row of any frame.
    static ROW: RefCell<(Vec<u32>, Vec<f32>)> =
        RefCell::new((vec![0; LARGEST as usize], vec![0.0; LARGEST as usize]));
}

/// A triangle in subpixels with what it carries, and a pixel that it covers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) tri: Triangle,
    /// 256ths of a subpixel by which snapping moved the vertices.
    pub(crate) moved: [[i64; 2]; 3],
    pub(crate) pixel: [i64; 2],
    pub(crate) q: [f32; 3],
    pub(crate) zs: [f32; 3],
    pub(crate) u: [f32; 3],
}

/// A constructor said no.
#[derive(Debug)]
pub(crate) struct Refused;

impl Case {
    /// A triangle that carries a constant.
    pub(crate) fn new(tri: Triangle, pixel: [i64; 2]) -> Self {
        Self { tri, moved: [[0; 2]; 3], pixel, q: [1.0; 3], zs: [0.5; 3], u: [1.0; 3] }
    }

    fn at(column: i64, row: i64) -> [i64; 2] {
        pixel_centre(column, row, BITS)
    }

    pub(crate) fn is_covered(&self) -> bool {
        covers(self.tri, Self::at(self.pixel[0], self.pixel[1]))
    }

    /// The columns of the pixel's row that are covered, also beyond the frame.
    pub(crate) fn covered(&self) -> Range<i64> {
        let [column, row] = self.pixel;
        let edge = |out: i64| {
            let (mut inside, mut outside) = (column, out);
            while (inside - outside).abs() > 1 {
                let middle = i64::midpoint(inside, outside);
                if covers(self.tri, Self::at(middle, row)) { inside = middle } else { outside = middle }
            }
            inside
        };
        let x = self.tri.map(|corner| corner[0] >> BITS);
        let [first, last] =
            [x.iter().min().map_or(0, |x| x - 2), x.iter().max().map_or(0, |x| x + 2)].map(edge);
        first..last + 1
    }

    pub(crate) fn q_at(&self, column: i64) -> f64 {
        dd::linear(self.tri, Self::at(column, self.pixel[1]), self.q).to_f64()
    }

    /// The exact value of what is carried.
    pub(crate) fn hyperbolic(&self, column: i64) -> f64 {
        dd::hyperbolic(self.tri, Self::at(column, self.pixel[1]), self.q, self.u).to_f64()
    }

    /// The exact value before snapping, at the pixel.
    fn unsnapped(&self) -> f64 {
        let before = [0, 1, 2].map(|i| [0, 1].map(|k| 256 * self.tri[i][k] + self.moved[i][k]));
        let sample = Self::at(self.pixel[0], self.pixel[1]).map(|c| 256 * c);
        let exact = dd::hyperbolic(before, sample, self.q, self.u).to_f64();
        let [least, most] = self.range();
        exact.clamp(least, most)
    }

    /// Whether it counts as large beyond doubt, so that its values are those before snapping: a box of 65 pixels, and
    /// at each vertex 32 subpixels of height for the least q, and as many times as much for a greater one.
    pub(crate) fn is_large(&self) -> bool {
        let before = [0, 1, 2].map(|i| [0, 1].map(|k| 256 * self.tri[i][k] + self.moved[i][k]));
        let q = self.q.map(f64::from);
        let least = q.into_iter().fold(f64::INFINITY, f64::min);
        let area: f64 = weights(before, before[0]).iter().map(|&e| e as f64).sum();
        let high = |i: usize| {
            let [a, b] = [before[(i + 1) % 3], before[(i + 2) % 3]];
            let edge = ((a[0] - b[0]).abs() + (a[1] - b[1]).abs()) as f64;
            area.abs() >= 32.01 * 256.0 * edge * q[i] / least
        };
        self.pixels() >= 65.0 && (0..3).all(high)
    }

    /// The least and the greatest value of the vertices.
    fn range(&self) -> [f64; 2] {
        [f32::min, f32::max].map(|pick| f64::from(self.u.into_iter().reduce(pick).unwrap_or(0.0)))
    }

    /// The greatest difference between two vertices.
    pub(crate) fn spread(&self) -> f64 {
        let [least, most] = self.range();
        most - least
    }

    /// The scale of rounding: the greatest magnitude.
    pub(crate) fn largest(&self) -> f64 {
        self.u.iter().fold(0.0, |largest, u| f64::max(largest, f64::from(u.abs())))
    }

    /// The greatest ratio of q.
    pub(crate) fn ratio(&self) -> f64 {
        let [least, most] =
            [f32::min, f32::max].map(|pick| f64::from(self.q.into_iter().reduce(pick).unwrap_or(1.0)));
        most / least
    }

    /// The longer side of the box, in pixels.
    pub(crate) fn pixels(&self) -> f64 {
        let side = |axis: usize| {
            let at = self.tri.map(|corner| corner[axis]);
            at.iter().max().unwrap_or(&0) - at.iter().min().unwrap_or(&0)
        };
        side(0).max(side(1)) as f64 / f64::from(1 << BITS)
    }

    /// The value and the depth that a policy interpolates at the pixel, in a frame with sides of so many pixels.
    fn drawn(&self, policy: Policy, side: i64) -> Result<Option<[f64; 2]>, Refused> {
        let side = u32::try_from(side).map_err(|_| Refused)?;
        match policy {
            Policy::Exact => self.drawn_by(Exact, side),
            Policy::Planes => self.drawn_by(Planes, side),
            Policy::Floats(division) => self.drawn_by::<Lines>(division.lines(), side),
            Policy::Fixed(division) => self.drawn_by(FixedPoint(division.lines()), side),
        }
    }

    fn drawn_by<P: Interpolation>(&self, interpolation: P, side: u32) -> Result<Option<[f64; 2]>, Refused> {
        let mut vertices = [0, 1, 2].map(|i| Vertex {
            x: Fixed::ZERO,
            y: Fixed::ZERO,
            zs: self.zs[i],
            q: self.q[i],
            varying: self.u[i],
        });
        for (vertex, (place, moved)) in vertices.iter_mut().zip(self.tri.iter().zip(&self.moved)) {
            let at = |k: usize| {
                let snapped = i32::try_from(place[k]).ok().and_then(Fixed::from_subpixels)?;
                Some(Fixed::from_bits(snapped.to_bits().wrapping_add_signed(moved[k] as i32)))
            };
            (vertex.x, vertex.y) = (at(0).ok_or(Refused)?, at(1).ok_or(Refused)?);
        }
        let [column, row] = self.pixel.map(|c| c as i32);
        ROW.with_borrow_mut(|(color, depth)| {
            let places = ..side as usize;
            let (color, depth) =
                (color.get_mut(places).ok_or(Refused)?, depth.get_mut(places).ok_or(Refused)?);
            let found = Cell::new(None);
            let stage = |u: f32| {
                found.set(Some(u));
                Some(u32::MAX)
            };
            let paint = alberti::raster::Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
            let [a, b, c] = &vertices;
            {
                let mut band = Target::band(Rgba8888, Recorded, [side; 2], row.unsigned_abs(), color, depth)
                    .map_err(|_| Refused)?;
                let mut pixel = band.scissor(column..column + 1, row..row + 1);
                paint.triangle(One, &mut pixel, [a, b, c], &mut ());
            }
            Ok(found.get().map(|u| [f64::from(u), f64::from(depth[column as usize])]))
        })
    }

    /// The error of what is carried, in 256ths, beside the policy's bound: texels of a texture with as many a side.
    pub(crate) fn texels(&self, policy: Policy, side: i64) -> Sample {
        const TEXELS: f64 = 256.0;
        match self.drawn(policy, side) {
            Err(Refused) => Sample::REFUSED,
            Ok(None) => Sample::new(f64::INFINITY, 0.0),
            Ok(Some([u, _])) => {
                let moved = self.moved != [[0; 2]; 3];
                let exact = if moved { self.unsnapped() } else { self.hyperbolic(self.pixel[0]) };
                let more = if moved { 4.0 * EPS * self.largest() } else { 0.0 };
                Sample::new(TEXELS * (u - exact), TEXELS * (policy.bound(self) + more))
            }
        }
    }

    /// The error of depth, in steps of 24 bits, beside the policy's bound.
    pub(crate) fn depth_steps(&self, policy: Policy, side: i64) -> Sample {
        match self.drawn(policy, side) {
            Err(Refused) => Sample::REFUSED,
            Ok(None) => Sample::new(f64::INFINITY, 0.0),
            Ok(Some([_, zs])) => {
                let exact = dd::linear(self.tri, Self::at(self.pixel[0], self.pixel[1]), self.zs).to_f64();
                let largest = self.zs.iter().fold(0.0, |largest, zs| f64::max(largest, f64::from(*zs)));
                Sample::new((zs - exact) / EPS, policy.depth_bound(self, exact, largest) / EPS)
            }
        }
    }
}
