//! Meshlets: parts of a mesh that are left out as a whole where nothing of them can be seen. In object space, before
//! any vertex is transformed.

#[cfg(feature = "std")]
mod split;

use crate::geometry::{Geometry, IntegerVertex};
use crate::screen::Screen;
use alberti_math::glam::{Mat3, Vec3};
use alberti_math::lanes::One;
use alberti_math::{Eye, Frame, Object, Point3, logged, map3, scaled};
use alberti_projection::Projection;
use alberti_raster::Cull;
use core::mem::take;
use core::ops::Range;

#[cfg(feature = "std")]
pub use split::Split;

/// A ball in object space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Ball {
    /// The centre.
    pub center: Vec3,
    /// The radius.
    pub radius: f32,
}

logged! {
    [] Ball: "Ball {{ center: {}, radius: {} }}", |ball| ball.center.to_array(), ball.radius;
}

impl Ball {
    /// The ball that holds everything.
    pub const EVERYTHING: Self = Self { center: Vec3::ZERO, radius: f32::INFINITY };

    /// A ball around points.
    fn around(points: impl Iterator<Item = Vec3> + Clone) -> Self {
        let (mut least, mut greatest) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for point in points.clone() {
            (least, greatest) = (least.min(point), greatest.max(point));
        }
        let center = (least + greatest) / 2.0;
        Self { center, radius: points.map(|point| point.distance(center)).fold(0.0, f32::max) }
    }

    /// A ball around all vertices of a mesh's triangles.
    #[must_use]
    pub fn of(mesh: &impl Geometry) -> Self {
        Self::around((0..mesh.triangles()).flat_map(|number| corners(mesh, number)).flatten())
    }
}

/// The places of a triangle's vertices.
fn corners(mesh: &impl Geometry, number: usize) -> Option<[Vec3; 3]> {
    let place = |index: usize| mesh.vertex(index).map(|(point, _)| point.coords);
    let [a, b, c] = mesh.triangle(number)?;
    // Triangles without a place are not drawn.
    let [a, b, c] = [place(a)?, place(b)?, place(c)?];
    (a.is_finite() && b.is_finite() && c.is_finite()).then_some([a, b, c])
}

/// Triangles that follow each other in a mesh, and bounds of what they are: where, and which way they face.
///
/// Places are in units of 2^-13 of the radius of a ball around the whole mesh, from its centre. Made by
/// [`Meshlet::new`]; the fields are for meshes that are constants of a program. Bounds that are too small leave out
/// what could be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Meshlet {
    /// The number of the first triangle, and the one after the last.
    pub triangles: [u32; 2],
    /// The centre and the radius of a ball around the triangles.
    pub center: [i16; 3],
    /// The radius.
    pub radius: u16,
    /// The mean of the normals, of length 2^14.
    pub axis: [i16; 3],
    /// The square of the sine of the greatest angle between a normal and the axis, in 2^-16; the greatest number for
    /// angles that are too large.
    pub squared_sine: u16,
    /// How far the ball's centre has to go against the axis to be behind the planes of all triangles, and how far along
    /// it to be before them.
    pub depths: [i16; 2],
}

/// Units of a mesh's radius.
const RADIUS: f32 = 8192.0;
/// The length of an axis.
const AXIS: f32 = 16384.0;

impl Meshlet {
    /// The triangles of a mesh with these numbers, and the ball around the whole mesh.
    #[must_use]
    pub fn new(mesh: &impl Geometry, ball: &Ball, triangles: Range<u32>) -> Self {
        let all = || triangles.clone().filter_map(|number| corners(mesh, usize::try_from(number).ok()?));
        let Ball { center, radius } = Ball::around(all().flatten());
        let sides = || all().filter_map(|[a, b, c]| Some((a, (b - a).cross(c - a).try_normalize()?)));
        let axis = sides().map(|(_, normal)| normal).sum::<Vec3>().normalize_or_zero();
        // A little less, for the roundings here.
        let cosine = sides().map(|(_, normal)| normal.dot(axis)).fold(1.0, f32::min) - 1.0 / 512.0;
        let height = |(place, normal): (Vec3, Vec3)| normal.dot(place - center) / normal.dot(axis);
        let [behind, before] =
            [-1.0, 1.0].map(|sign| sides().map(|side| sign * height(side)).fold(0.0, f32::max));
        let per_unit = RADIUS / ball.radius.max(f32::MIN_POSITIVE);
        // Farther by what rounding may add.
        let [behind, before] = [behind, before].map(|depth| depth * per_unit + 4.0 / cosine.max(0.01));
        let facing = cosine > 0.05 && behind.max(before) < 16384.0;
        let [behind, before, _] = half_words(Vec3::new(behind, before, 0.0));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "these saturate")]
        let [radius, squared_sine] =
            [radius * per_unit + 3.0, (1.0 - cosine * cosine) * 65536.0].map(|x| x as u16);
        Self {
            triangles: [triangles.start, triangles.end],
            center: half_words((center - ball.center) * per_unit),
            radius,
            axis: half_words(axis * AXIS),
            squared_sine: if facing { squared_sine } else { u16::MAX },
            depths: [behind, before],
        }
    }
}

/// To the nearest.
fn half_words(v: Vec3) -> [i16; 3] {
    #[expect(clippy::cast_possible_truncation, reason = "these saturate")]
    v.round().to_array().map(|c| c as i16)
}

/// A mesh with meshlets. Only those that may be seen are drawn: not those outside of the view, nor those of which all
/// triangles face the way that is left out.
///
/// They are in the order of their triangles. Triangles of no meshlet are drawn as without any. Where snapping turns a
/// triangle, the facing that counts is that of before: so a silhouette may lack pixels that are there without
/// meshlets. Counters do not hear of those that are left out.
///
/// # Cost
/// Some hundred instructions a meshlet, all of integers, and more at the edge of the view. Of a closed mesh of
/// 6,000 triangles, meshlets of 16 leave out two fifths of the triangles, and a third of the vertices. They are for one
/// lane. With several all vertices are transformed, and a triangle's facing costs next to nothing: there is no gain.
#[derive(Clone, Copy, Debug)]
pub struct Meshlets<'a, M> {
    /// The mesh.
    pub mesh: M,
    /// Its parts.
    pub meshlets: &'a [Meshlet],
    /// The ball around the mesh with which they were made.
    pub ball: Ball,
}

impl<M: Geometry> Geometry for Meshlets<'_, M> {
    type Varying = M::Varying;

    #[inline]
    fn triangles(&self) -> usize {
        self.mesh.triangles()
    }

    #[inline]
    fn vertices(&self) -> usize {
        self.mesh.vertices()
    }

    #[inline]
    fn triangle(&self, number: usize) -> Option<[usize; 3]> {
        self.mesh.triangle(number)
    }

    #[inline]
    fn vertex(&self, number: usize) -> Option<(Point3<Object>, M::Varying)> {
        self.mesh.vertex(number)
    }

    const INTEGERS: bool = M::INTEGERS;

    #[inline]
    fn unit(&self) -> f32 {
        self.mesh.unit()
    }

    #[inline]
    fn integers(&self, number: usize) -> Option<IntegerVertex<M::Varying>> {
        self.mesh.integers(number)
    }

    const MESHLETS: bool = true;

    #[inline]
    fn meshlet(&self, number: usize) -> Option<Meshlet> {
        self.meshlets.get(number).copied()
    }

    #[inline]
    fn ball(&self) -> Ball {
        self.ball
    }
}

/// The part of object space that is seen, and from where, in the units of meshlets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    /// Half spaces in which all is that can be seen: a normal of length 2^14, and the distance of the origin.
    volume: [([i16; 3], i32); 6],
    /// The number of those that the mesh reaches out of.
    crossed: usize,
    away: Option<Away>,
}

/// The way from the eye: from a point p it is (p + `eye`) / 2^`shift`, within 2^14. In parallel projection it is `eye`.
/// Triangles are left out whose normals look along it, or against it.
#[derive(Clone, Copy, Debug)]
struct Away {
    eye: [i32; 3],
    parallel: bool,
    shift: u32,
    along: bool,
}

impl Sight {
    #[inline(never)]
    pub(crate) fn new<Pr: Projection>(screen: &Screen<Pr>, cull: Cull, ball: &Ball) -> Self {
        let (to_eye, projection) = (&screen.to_eye, &screen.projection);
        let [scale_x, scale_y, _] = projection.scale_lanes(One, [1.0; 3]);
        let rows = to_eye.axes().transpose();
        let center = to_eye.to_parent(Point3::new(ball.center)).coords;
        let (x, y, z) = (rows.x_axis * scale_x, rows.y_axis * scale_y, rows.z_axis);
        let (at_x, at_y, at_z) = (center.x * scale_x, center.y * scale_y, center.z);
        let (side, at_side) = if projection.is_perspective() { (z, at_z) } else { (Vec3::ZERO, 1.0) };
        let all = [
            (z, at_z - projection.near()),
            (-z, projection.far() - at_z),
            (side + x, at_side + at_x),
            (side - x, at_side - at_x),
            (side + y, at_side + at_y),
            (side - y, at_side - at_y),
        ];
        let (mut volume, mut crossed) = ([([0; 3], 0); 6], 0);
        for (normal, distance) in all {
            let length = normal.length() * ball.radius;
            let distance = distance / length * RADIUS;
            // Not so too where there is no number.
            if length > 0.0
                && distance < 2.0 * RADIUS
                && let Some(half) = volume.get_mut(crossed)
            {
                let unit = normal * (ball.radius / length * AXIS);
                *half = (half_words(unit), scaled(distance.max(-4.0 * RADIUS), 0));
                crossed += 1;
            }
        }
        Self { volume, crossed, away: Away::new(to_eye, projection.is_perspective(), cull, ball) }
    }

    /// Whether something of a meshlet may be seen.
    #[inline(never)]
    pub(crate) fn sees(&self, meshlet: &Meshlet) -> bool {
        if self.away.as_ref().is_some_and(|away| away.leaves_out(meshlet)) {
            return false;
        }
        let center = meshlet.center.map(i32::from);
        // For the roundings of normal and distance, of which those of the centre are in the radius.
        let reach = i32::from(meshlet.radius) + 3;
        let outside =
            |(normal, distance): &([i16; 3], i32)| dot(normal.map(i32::from), center) + distance < -reach;
        !self.volume.iter().take(self.crossed).any(outside)
    }
}

/// The product with a direction of length 2^14, over that.
#[inline(always)]
fn dot([x, y, z]: [i32; 3], [a, b, c]: [i32; 3]) -> i32 {
    (x * a + y * b + z * c) >> 14
}

impl Away {
    /// A triangle of eye space is seen counter-clockwise if n·p > 0, where its normal is n = cof(A) n' in the frame
    /// A p' + o: if det(A) n'·p' + n'·adj(A) o > 0. In parallel projection, if n.z > 0.
    fn new(to_eye: &Frame<Object, Eye>, perspective: bool, cull: Cull, ball: &Ball) -> Option<Self> {
        let axes = to_eye.axes();
        let Mat3 { x_axis: x, y_axis: y, z_axis: z } = axes;
        let adjugate = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y)).transpose();
        let (eye, greatest, positive) = if perspective {
            let determinant = axes.determinant();
            let center = to_eye.to_parent(Point3::new(ball.center)).coords;
            let eye = adjugate * center / determinant * (RADIUS / ball.radius);
            (eye, eye.abs().max_element(), determinant > 0.0)
        } else {
            let way = adjugate * Vec3::Z;
            (way * (AXIS / 2.0 / way.abs().max_element()), 0.0, true)
        };
        let along = match cull {
            Cull::Back => !positive,
            Cull::Front => positive,
            Cull::None => return None,
        };
        // Points are within 2^16.
        let reach = (greatest < 1.0e8).then(|| scaled(greatest, 0) + (1 << 16))?;
        let shift = if perspective { (reach >> 14).max(1).ilog2() + 1 } else { 0 };
        Some(Self { eye: eye.to_array().map(|c| scaled(c, 0)), parallel: !perspective, shift, along })
    }

    /// Whether all of a meshlet's triangles are left out. The way leads to a point behind them, or before them, so that
    /// a way to a point of theirs looks even more the same way as their normals.
    #[inline(always)]
    fn leaves_out(&self, meshlet: &Meshlet) -> bool {
        let Self { eye, parallel, shift, along } = *self;
        let Meshlet { center, axis, squared_sine, depths: [behind, before], .. } = *meshlet;
        let depth = i32::from(if along { -behind } else { before });
        let apex = |k: usize| i32::from(center[k]) + ((i32::from(axis[k]) * depth) >> 14);
        let way = if parallel { eye } else { map3([0, 1, 2], |k: usize| (apex(k) + eye[k]) >> shift) };
        // The way is within two on each axis, and the product within eight: two for each of them, of the axis too.
        let product = dot(axis.map(i32::from), way);
        let product = if along { product } else { -product } - 8;
        let squares = map3(way, |c| (c.unsigned_abs() + 2).pow(2));
        let squared = squares[0] + squares[1] + squares[2];
        // The sines' last bit, and the square's last ones, which go.
        let bound = (((squared >> 15) + 1) * (u32::from(squared_sine) + 1)) >> 1;
        squared_sine < u16::MAX && product > 0 && product.unsigned_abs().pow(2) >= bound
    }
}

/// The numbers of a mesh's triangles, in parts, without those of meshlets that are not seen.
pub(crate) struct Seen<'a, M> {
    mesh: &'a M,
    sight: Option<Sight>,
    /// Those that are left.
    rest: Range<usize>,
    /// The next meshlet.
    meshlet: usize,
}

impl<'a, M: Geometry> Seen<'a, M> {
    /// Those among `numbers`.
    #[inline(always)]
    pub(crate) fn new<Pr: Projection>(
        mesh: &'a M,
        screen: &Screen<Pr>,
        cull: Cull,
        numbers: Range<usize>,
    ) -> Self {
        let sight = const { M::MESHLETS }.then(|| Sight::new(screen, cull, &mesh.ball()));
        Self { mesh, sight, rest: numbers, meshlet: 0 }
    }

    #[inline(never)]
    fn next_of_meshlets(&mut self) -> Option<Range<usize>> {
        while !self.rest.is_empty() {
            let Some(meshlet) = self.mesh.meshlet(self.meshlet) else {
                return Some(take(&mut self.rest));
            };
            let [start, end] = meshlet.triangles.map(|number| number as usize);
            let first = self.rest.start;
            if start > first {
                self.rest.start = start.min(self.rest.end);
                return Some(first..self.rest.start);
            }
            self.meshlet += 1;
            if end > first {
                self.rest.start = end.min(self.rest.end);
                if self.sight.as_ref().is_none_or(|sight| sight.sees(&meshlet)) {
                    return Some(first..self.rest.start);
                }
            }
        }
        None
    }
}

impl<M: Geometry> Iterator for Seen<'_, M> {
    type Item = Range<usize>;

    #[inline(always)]
    fn next(&mut self) -> Option<Range<usize>> {
        if const { M::MESHLETS } {
            return self.next_of_meshlets();
        }
        (!self.rest.is_empty()).then(|| take(&mut self.rest))
    }
}

#[cfg(test)]
mod tests;
