//! A triangle on the screen, and its functions at the pixel in `f64`.

use crate::draw::{COMPONENTS, Piece, components};
use alberti::glam::Vec3;
use alberti::raster::Edge;
use alberti::{Subpixel, Varying};

/// The triangle about a pixel's sample.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    /// The snapped corners, in subpixels.
    pub(super) corners: [[i32; 2]; 3],
    /// Twice the signed area, in subpixels squared: positive if the corners run clockwise on the screen.
    pub(super) area: i64,
    /// The edges, each opposite the corner whose weight it is, clockwise, with their values at the sample.
    pub(super) edges: [Edge<i64>; 3],
    /// The sample, in subpixels.
    pub(super) sample: [i32; 2],
    pub(super) subpixel: Subpixel,
    pub(super) q: [f64; 3],
    pub(super) zs: [f64; 3],
    /// The values at the corners' subpixels, and those that were given.
    values: [[f64; COMPONENTS]; 3],
    given: [[f64; COMPONENTS]; 3],
    /// The weights of the whole triangle's vertices at the corners.
    whole: [Vec3; 3],
}

impl Shape {
    pub(super) fn new(piece: &Piece, pixel: [u32; 2], subpixel: Subpixel) -> Self {
        let corners = piece.given.map(|corner| [corner.x.subpixels(), corner.y.subpixels()]);
        let [a, b, c] = corners;
        let side =
            |p: [i32; 2], q: [i32; 2]| [i64::from(q[0]) - i64::from(p[0]), i64::from(q[1]) - i64::from(p[1])];
        let [[ux, uy], [vx, vy]] = [side(a, b), side(a, c)];
        let area = ux * vy - uy * vx;
        let one = 1 << subpixel.bits();
        let sample = pixel.map(|at| at.cast_signed() * one + one / 2);
        let edge = |from, to| {
            let (from, to) = if area > 0 { (from, to) } else { (to, from) };
            Edge::new(from, to, sample, one)
        };
        let of = |corner: &crate::draw::Corner3| {
            let bundle = Varying::gather([corner.varying]);
            components(&bundle).map(|[x]: [f32; 1]| f64::from(x))
        };
        Self {
            corners,
            area,
            edges: [edge(b, c), edge(c, a), edge(a, b)],
            sample,
            subpixel,
            q: piece.drawn.map(|corner| corner.q.into()),
            zs: piece.drawn.map(|corner| corner.zs.into()),
            values: piece.drawn.each_ref().map(of),
            given: piece.given.each_ref().map(of),
            whole: piece.weights,
        }
    }

    /// Whether its corners are the triangle's own vertices, in their order.
    pub(super) fn is_whole(&self) -> bool {
        self.whole == [Vec3::X, Vec3::Y, Vec3::Z]
    }

    /// Whether the sample belongs to it.
    pub(super) fn covers(&self) -> bool {
        self.covers_beside(0)
    }

    /// The same of the sample so many columns farther.
    fn covers_beside(&self, columns: i32) -> bool {
        let inside = |edge: &Edge<i64>| edge.value + edge.step_x * i64::from(columns) + edge.bias >= 0;
        self.area != 0 && self.edges.iter().all(inside)
    }

    /// The first and the last covered column of the row, from the pixel's.
    pub(super) fn span(&self) -> [i32; 2] {
        let walk = |by: i32| {
            let beyond = (1..1 << 17).find(|&columns| !self.covers_beside(by * columns));
            by * (beyond.unwrap_or(1) - 1)
        };
        [walk(-1), walk(1)]
    }

    /// The screen's weights of the corners, so many columns farther.
    pub(super) fn screen_beside(&self, columns: i32) -> [f64; 3] {
        let value = |edge: &Edge<i64>| number(edge.value + edge.step_x * i64::from(columns));
        self.edges.each_ref().map(|edge| value(edge) / number(self.area.abs()))
    }

    /// The screen's weights of the corners.
    pub(super) fn screen(&self) -> [f64; 3] {
        self.screen_beside(0)
    }

    /// The change of these by column, or by row.
    fn slope(&self, by_row: bool) -> [f64; 3] {
        let step = |edge: &Edge<i64>| number(if by_row { edge.step_y } else { edge.step_x });
        self.edges.each_ref().map(|edge| step(edge) / number(self.area.abs()))
    }

    /// The weights in space that those of the screen stand for.
    fn in_space(&self, screen: [f64; 3]) -> [f64; 3] {
        let q = sum(screen, self.q);
        [0, 1, 2].map(|k| screen[k] * self.q[k] / q)
    }

    /// The weights in space of the corners.
    pub(super) fn space(&self) -> [f64; 3] {
        self.in_space(self.screen())
    }

    /// The weights in space of the whole triangle's vertices.
    pub(super) fn space_of_whole(&self) -> [f64; 3] {
        let space = self.space();
        let corner = self.whole.map(|weights| weights.as_dvec3().to_array());
        [0, 1, 2].map(|k| (0..3).map(|j| space[j] * corner[j][k]).sum())
    }

    /// q so many columns farther.
    pub(super) fn q_beside(&self, columns: i32) -> f64 {
        sum(self.screen_beside(columns), self.q)
    }

    /// zs on the triangle's plane.
    pub(super) fn depth(&self) -> f64 {
        sum(self.screen(), self.zs)
    }

    /// The change of z from pixel to pixel over z, |∂z/∂x| + |∂z/∂y|: that of q over q.
    pub(super) fn slope_of_z(&self) -> f64 {
        let q = self.q_beside(0);
        [false, true].map(|by_row| (sum(self.slope(by_row), self.q) / q).abs()).iter().sum()
    }

    /// A component's values at the corners.
    pub(super) fn corners_of(&self, component: usize) -> [f64; 3] {
        self.values.map(|values| values[component])
    }

    /// The hyperbolic mean of a component so many columns farther, within what was given.
    pub(super) fn hyperbolic_beside(&self, component: usize, columns: i32) -> f64 {
        let mean = sum(self.in_space(self.screen_beside(columns)), self.corners_of(component));
        self.within(component, mean)
    }

    /// The affine one at the sample.
    pub(super) fn affine(&self, component: usize) -> f64 {
        self.within(component, sum(self.screen(), self.corners_of(component)))
    }

    fn within(&self, component: usize, x: f64) -> f64 {
        let [a, b, c] = self.given.map(|values| values[component]);
        x.clamp(a.min(b).min(c), a.max(b).max(c))
    }

    /// A component's derivatives by column and row: (∂U/∂x − u ∂Q/∂x)/Q.
    pub(super) fn derivatives(&self, component: usize) -> [f64; 2] {
        let (q, corners) = (self.q_beside(0), self.corners_of(component));
        let u = sum(self.space(), corners);
        [false, true].map(|by_row| {
            let slope = self.slope(by_row);
            let of_product = sum(slope, [0, 1, 2].map(|k| corners[k] * self.q[k]));
            (of_product - u * sum(slope, self.q)) / q
        })
    }

    /// The longer side of its box, in pixels.
    pub(super) fn extent(&self) -> f64 {
        let side = |axis: usize| {
            let [a, b, c] = self.corners.map(|corner| corner[axis]);
            a.max(b).max(c) - a.min(b).min(c)
        };
        f64::from(side(0).max(side(1))) / f64::from(1 << self.subpixel.bits())
    }
}

fn sum(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Edge functions are below 2^53.
#[expect(clippy::cast_precision_loss, reason = "exact below 2^53")]
fn number(x: i64) -> f64 {
    x as f64
}
