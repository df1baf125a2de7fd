//! Station 1: the same tilted board, on the left by a policy of straight lines, on the right by [`Exact`].
//!
//! ```text
//!   parameters  0 w ratio   1 span, an index of SPANS   2 turn of the tilt, degrees   3 whether the left is the error
//!               4 5 the pointer, in pixels
//!   results     0 greatest error   1 mean   2 3 the place of the greatest   4 greatest of Exact   5 6 both at the
//!               pointer, or -1   7 the bound of a straight line along an edge   8.. errors of the left along the row
//!               of the greatest, or -1
//! ```
//!
//! Errors are in texels: the distance of the coordinate that a kernel carries to a pixel from that of the ray through
//! the pixel's centre, in `f64`.

use crate::canvas::Canvas;
use crate::numbers::{float, narrow, turn, whole};
use crate::shading::{QUAD, plain};
use crate::textures::{BOARD, Textures};
use crate::{Drawn, Fault, Parameters};
use alberti::glam::{DVec2, DVec3, Vec2, Vec3};
use alberti::lanes::One;
use alberti::texture::format::Rgba8888 as Texels;
use alberti::texture::{Nearest, Repeat, Sampler};
use alberti::*;
use alloc::vec::Vec;
use core::f32::consts::FRAC_PI_2;

/// The columns of a span; 0 for lines along the whole triangle.
const SPANS: [i32; 7] = [2, 4, 8, 16, 32, 64, 0];

/// The error, in texels, that is drawn brightest.
const BRIGHTEST: f64 = 16.0;

pub(crate) fn draw(
    canvas: &mut Canvas,
    results: &mut Vec<f32>,
    textures: &mut Textures,
    parameters: &Parameters,
) -> Drawn {
    let [ratio, span, degrees, shows_error, x, y, ..] = *parameters;
    let board = Board::new(ratio.clamp(1.0, 64.0), degrees)?;
    let length = SPANS[whole(span, 6) as usize];
    let policy = Lines::spans(length).unwrap_or(Lines::affine());
    let [width, height] = canvas.size();
    let (half, rows) = (width / 2, height);
    let [left, right] = [0, half.cast_signed()].map(|x| Viewport::new(x, 0, half, rows));
    let (left, right) = (left?, right?);

    let texture = textures.board()?.mipmap()?;
    let sampler = texture.level(0).sampler(Nearest, Repeat);
    let carried = board.carried(canvas, &left, policy, sampler)?;
    let exact = board.carried(canvas, &left, Exact, sampler)?;
    let places: Vec<_> = canvas.places().collect();
    let truth = board.truth([half, rows]);
    let error = |(carried, place): (&Vec2, [u32; 2])| {
        (!carried.x.is_nan()).then(|| (carried.as_dvec2() - truth(place)).length() * f64::from(BOARD))
    };
    let errors: Vec<Option<f64>> = carried.iter().zip(places.iter().copied()).map(error).collect();
    let of_exact = exact.iter().zip(places.iter().copied()).filter_map(error).fold(0.0, f64::max);

    let mut target = canvas.flat()?;
    board.draw(&mut target, &left, policy, (sampler, Shown::Colors))?;
    board.draw(&mut target, &right, Exact, (sampler, Shown::Colors))?;
    if shows_error > 0.5 {
        for (pixel, error) in canvas.pixels_mut().iter_mut().zip(&errors) {
            if let Some(error) = error {
                *pixel = heat(error / BRIGHTEST).to_bits();
            }
        }
    }

    let found = || errors.iter().zip(&places).filter_map(|(error, place)| Some((error.as_ref()?, place)));
    let (greatest, at) = found().fold(
        (-1.0, [0, 0]),
        |most, (&error, &place)| {
            if error > most.0 { (error, place) } else { most }
        },
    );
    let (sum, count) = found().fold((0.0, 0.0), |(sum, count), (error, _)| (sum + error, count + 1.0));
    // The pointer is on either half.
    let pointer = (x >= 0.0 && y >= 0.0).then(|| (whole(y, rows) * width + whole(x, width) % half) as usize);
    let at_pointer = |of: Option<f64>| narrow(of.unwrap_or(-1.0));
    results.extend([
        narrow(greatest),
        narrow(sum / f64::max(count, 1.0)),
        float(at[0] as usize),
        float(at[1] as usize),
        narrow(of_exact),
        at_pointer(pointer.and_then(|k| *errors.get(k)?)),
        at_pointer(pointer.and_then(|k| error((exact.get(k)?, *places.get(k)?)))),
        narrow(board.bound()),
    ]);
    let row = errors.chunks(width as usize).nth(at[1] as usize).unwrap_or_default();
    results.extend(row.iter().take(half as usize).map(|error| at_pointer(*error)));
    Ok(())
}

/// The board's colours.
type Checkers<'a> = Sampler<'a, Texels, Nearest, Repeat>;

/// The number that a pixel shows.
#[derive(Clone, Copy, Debug)]
enum Shown {
    Colors,
    U,
    V,
}

/// The board in eye space: corners and coordinates in turn, from the near left one on.
struct Board {
    corners: [(Vec3, Vec2); 4],
}

impl Board {
    /// A board whose far edge has `ratio` times the depth of its near one, and recedes upwards, or to the right if it
    /// is turned by 90°.
    fn new(ratio: f32, degrees: f32) -> Result<Self, ViewError> {
        let [cos, sin] = turn(degrees);
        let (along, across) = (Vec2::new(sin, cos), Vec2::new(cos, -sin));
        let corner = |side: f32, z: f32| {
            // Seen at -0.85 and 0.75 of the half picture, whatever the depth.
            let place = if z > 1.0 { 0.75 * z } else { -0.85 };
            (across * side * 0.95 + along * place).extend(z)
        };
        // With a ratio of 1 the two edges have one depth.
        let far = f32::max(ratio, 1.000_001);
        let corners = [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, far), corner(-1.0, far)];
        let uv = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| (corners[k], uv[k]));
        Ok(Self { corners: [a, b, c, d] })
    }

    /// Draws the board by a policy.
    fn draw(
        &self,
        target: &mut Target<'_, Rgba8888, NoDepth>,
        viewport: &Viewport,
        policy: impl Interpolation,
        (sampler, shown): (Checkers<'_>, Shown),
    ) -> Result<(), ViewError> {
        // The corners are those of the eye's space, and the window is 2 wide and high at the depth 1.
        let view = View::new(Frame::IDENTITY, Perspective::new(FRAC_PI_2, 1.0, 0.5, 128.0)?);
        let mesh = plain(&self.corners, &QUAD);
        // One stage for all, so that the numbers are those of the picture's kernel.
        let stage = move |uv: Vec2| match shown {
            Shown::Colors => Some(sampler.sample(uv)),
            Shown::U => Some(Rgba8::from_bits(uv.x.to_bits())),
            Shown::V => Some(Rgba8::from_bits(uv.y.to_bits())),
        };
        let pass = Pass::new(&view, &mesh, stage).viewport(*viewport).cull(Cull::None);
        pass.interpolation(policy).draw_by(One, target);
        Ok(())
    }

    /// The coordinates that a policy carries to each pixel; NaN where there is no board. They come out of the kernel as
    /// the bits of colours.
    fn carried(
        &self,
        canvas: &mut Canvas,
        viewport: &Viewport,
        policy: impl Interpolation,
        sampler: Checkers<'_>,
    ) -> Result<Vec<Vec2>, Fault> {
        let mut component = |shown| -> Result<Vec<u32>, Fault> {
            let mut target = canvas.flat()?;
            // The bits of white are those of a NaN.
            target.clear(Rgba8::WHITE);
            self.draw(&mut target, viewport, policy, (sampler, shown))?;
            Ok(canvas.kept())
        };
        let (u, v) = (component(Shown::U)?, component(Shown::V)?);
        let both = u.iter().zip(&v);
        Ok(both.map(|(u, v)| Vec2::new(f32::from_bits(*u), f32::from_bits(*v))).collect())
    }

    /// The coordinates that the ray through a pixel's centre meets, in `f64`. With the corner o and the edges a and b,
    /// o + u a + v b is along the ray r where u = −(o × b)·r/(a × b)·r, and v = (o × a)·r/(a × b)·r.
    fn truth(&self, size: [u32; 2]) -> impl Fn([u32; 2]) -> DVec2 + use<> {
        let [o, a, _, b] = self.corners.map(|(corner, _)| corner.as_dvec3());
        let (a, b) = (a - o, b - o);
        let (along_u, along_v, normal) = (b.cross(o), o.cross(a), a.cross(b));
        let [width, height] = size.map(f64::from);
        move |[x, y]| {
            let [x, y] = [(x, width), (y, height)].map(|(k, count)| (2.0 * f64::from(k) + 1.0) / count - 1.0);
            let ray = DVec3::new(x, -y, 1.0);
            DVec2::new(along_u.dot(ray), along_v.dot(ray)) / normal.dot(ray)
        }
    }

    /// |Δu| (√r − 1)/(√r + 1) in texels, of the edge that has the ratio r.
    fn bound(&self) -> f64 {
        let root = libm::sqrt(f64::from(self.corners[2].0.z / self.corners[0].0.z));
        f64::from(BOARD) * (root - 1.0) / (root + 1.0)
    }
}

/// A colour for an error, from 0 to 1.
fn heat(share: f64) -> Rgba8 {
    const COLORS: [Vec3; 4] = [
        Vec3::new(24.0, 36.0, 72.0),
        Vec3::new(60.0, 120.0, 160.0),
        Vec3::new(240.0, 170.0, 70.0),
        Vec3::new(255.0, 245.0, 220.0),
    ];
    // Small errors are seen too.
    let place = 3.0 * narrow(libm::sqrt(share.clamp(0.0, 1.0)));
    let k = whole(place - 0.5, 2) as usize;
    let color = COLORS[k].lerp(COLORS[k + 1], place - float(k));
    let [r, g, b] = color.to_array().map(crate::numbers::byte);
    Rgba8::new(r, g, b, 255)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Page, Station};

    /// Results of a board with this ratio and span.
    fn results(ratio: f32, span: f32) -> Vec<f32> {
        let mut page = Page::new();
        let mut parameters = [0.0; crate::PARAMETERS];
        parameters[..6].copy_from_slice(&[ratio, span, 35.0, 0.0, -1.0, -1.0]);
        page.draw(Station::Affine, [320, 160], &parameters).unwrap();
        page.results
    }

    #[test]
    fn exact_is_exact_and_affine_reaches_near_its_bound() {
        let found = results(4.0, 6.0);
        // Two components, and the diagonal of the board.
        let [greatest, bound, exact] = [found[0], found[7], found[4]];
        assert!(greatest > 0.8 * bound && greatest < 1.5 * bound, "{greatest} of {bound}");
        assert!(exact < 0.05, "{exact}");
    }

    #[test]
    fn longer_spans_have_larger_errors() {
        let greatest: Vec<f32> = (0..7).map(|span| results(6.0, crate::numbers::float(span))[0]).collect();
        assert!(greatest.is_sorted(), "{greatest:?}");
        assert!(results(1.0, 6.0)[0] < 0.05);
    }
}
