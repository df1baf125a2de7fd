//! A triangle on the screen, its orientation and its box of samples.

use crate::edge::FITS_I32;
use crate::interpolation::{LIMIT, Oriented};
use crate::unsnapped::LARGE;
use alberti_math::{Fixed, LOW_WORDS_ONLY, Q16, Subpixel, Varying, map2, map3, map4, scaled};
use core::cell::RefCell;
use core::fmt;
use core::ops::Range;

/// A vertex on the screen, the hand-over from the view pipeline to the rasterizer. Facing and coverage are those of the
/// snapped positions. What a [large](crate::Interpolation#large-triangles) triangle carries in floats is that of the
/// positions before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex<V> {
    /// Columns from the frame's left edge, snapped.
    pub x: Fixed,
    /// Rows from the frame's top edge downwards, snapped.
    pub y: Fixed,
    /// Screen depth in [0, 1].
    pub zs: f32,
    /// 1/z, greater than 0.
    pub q: f32,
    /// The attributes; finite.
    pub varying: V,
}

/// A vertex in the [numbers](crate::Paint::numbers) of a paint's interpolation, made once for all triangles that
/// share it.
#[derive(Clone, Copy)]
pub struct Corner<V: Varying> {
    /// Columns and rows: the bits of a [`Fixed`], in fixed point subpixels alone.
    pub(crate) place: [i32; 2],
    /// zs.
    pub(crate) zs: u32,
    /// q, an `f32`.
    pub(crate) q: u32,
    /// The components.
    pub(crate) components: V::Of<u32>,
}

/// The numbers of a [`Corner`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// Words of `f32`.
    Float,
    /// Integers: components in units of 2^-16, zs in 2^-31. A step of the depth buffer's integers is 2^(31 - bits) of
    /// these, and half of that is added for rounding.
    Fixed {
        /// The bits of these, see [`DepthFormat::bits`](crate::DepthFormat::bits).
        depth_bits: u32,
    },
}

impl Numbers {
    /// Whether they are integers.
    #[must_use]
    #[inline(always)]
    pub fn are_fixed(self) -> bool {
        self != Self::Float
    }
}

impl<V: Varying> Corner<V> {
    /// No vertex: room for one.
    pub const NONE: Self = Self { place: [0; 2], zs: 0, q: 0, components: V::ZEROS };

    /// The vertex in these numbers.
    #[must_use]
    #[inline(always)]
    pub fn new(numbers: Numbers, vertex: &Vertex<V>) -> Self {
        let components = Self::components(numbers, vertex.varying);
        Self::at([vertex.x, vertex.y], numbers, [vertex.zs, vertex.q], components)
    }

    /// The components of a varying.
    #[inline(always)]
    pub fn components(numbers: Numbers, varying: V) -> V::Of<u32> {
        V::map(&V::gather([varying]), &|[x]: [f32; 1]| match numbers {
            Numbers::Float => x.to_bits(),
            Numbers::Fixed { .. } => within_limit(scaled(x, 16)),
        })
    }

    /// The vertex of integers, where [`Numbers::Fixed`] are asked for: its place in subpixels; zs, rounded, and q, an
    /// `f32`, as words.
    #[must_use]
    #[inline(always)]
    pub fn of_integers(place: [i32; 2], [zs, q]: [u32; 2], components: &V::Of<Q16>) -> Self {
        Self { place, zs, q, components: V::map(components, &|x: Q16| within_limit(x.to_bits())) }
    }

    /// The column and the row, in subpixels, of a corner in numbers that are `fixed`, or floats.
    #[must_use]
    #[inline(always)]
    pub fn place(&self, fixed: bool) -> [i32; 2] {
        if fixed { self.place } else { map2(self.unsnapped(), Fixed::subpixels) }
    }

    /// The column and the row where numbers are floats.
    #[inline(always)]
    pub(crate) fn unsnapped(&self) -> [Fixed; 2] {
        map2(self.place, |bits| Fixed::from_bits(bits.cast_unsigned()))
    }

    /// The same place with other components.
    #[must_use]
    #[inline(always)]
    pub fn with_components_of(&self, other: &Self) -> Self {
        Self { components: other.components, ..*self }
    }

    /// A corner with these components.
    #[must_use]
    #[inline(always)]
    pub fn at(place: [Fixed; 2], numbers: Numbers, [zs, q]: [f32; 2], components: V::Of<u32>) -> Self {
        let (place, zs) = match numbers {
            Numbers::Float => (map2(place, |c| c.to_bits().cast_signed()), zs.to_bits()),
            Numbers::Fixed { depth_bits } => {
                let zs = rounded_depth(scaled(zs, 31).max(0).cast_unsigned(), depth_bits);
                (map2(place, Fixed::subpixels), zs)
            }
        };
        Self { place, zs, q: q.to_bits(), components }
    }

    /// The same with other numbers, at the same place.
    #[inline(always)]
    pub(crate) fn with_numbers(&self, [zs, q]: [f32; 2], components: V::Of<u32>) -> Self {
        Self { place: self.place, zs: zs.to_bits(), q: q.to_bits(), components }
    }

    /// The same components at another place.
    #[must_use]
    #[inline(always)]
    pub fn moved(&self, place: [Fixed; 2], numbers: Numbers, depths: [f32; 2]) -> Self {
        Self::at(place, numbers, depths, self.components)
    }

    /// The corner as a vertex: what [`new`](Self::new) has made of one. In fixed point zs has half a step of the depth
    /// buffer in it, components are rounded to 2^-16, and to `f32` beyond 256.
    #[must_use]
    pub fn vertex(&self, numbers: Numbers) -> Vertex<V> {
        let number = |word: u32| match numbers {
            Numbers::Float => f32::from_bits(word),
            Numbers::Fixed { .. } => Q16::from_bits(word.cast_signed()).to_f32(),
        };
        let fixed = |subpixels: i32| Fixed::from_subpixels(subpixels).unwrap_or(Fixed::ZERO);
        let [x, y] = if numbers.are_fixed() { map2(self.place, fixed) } else { self.unsnapped() };
        #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
        let zs = if numbers.are_fixed() { self.zs as f32 / 2_147_483_648.0 } else { self.zs() };
        Vertex { x, y, zs, q: self.q(), varying: V::from_components(&V::map(&self.components, &number)) }
    }

    /// The corners of a triangle as it is drawn: clockwise, from the topmost of them, of two the left one. Those of a
    /// [large](crate::Interpolation#large-triangles) triangle have the values at their subpixels, between which all
    /// policies interpolate. None without an area.
    #[must_use]
    pub fn as_drawn(corners: [&Self; 3], numbers: Numbers, subpixel: Subpixel) -> Option<[Self; 3]> {
        let (bits, fixed) = (subpixel.bits(), numbers.are_fixed());
        let area = doubled_area(&map3(corners, |corner| corner.place(fixed)));
        if area == 0 {
            return None;
        }
        let oriented = Oriented::new(corners, area, bits, fixed);
        let is_large = !fixed && Bounds::of(&oriented.corners).is_large(bits);
        Some(oriented.unsnapped(is_large).unwrap_or(map3(oriented.vertices, |corner| *corner)))
    }

    /// zs where numbers are `f32`.
    #[inline(always)]
    pub(crate) fn zs(&self) -> f32 {
        f32::from_bits(self.zs)
    }

    /// q.
    #[inline(always)]
    pub(crate) fn q(&self) -> f32 {
        f32::from_bits(self.q)
    }
}

/// The word of a component.
#[inline(always)]
fn within_limit(component: i32) -> u32 {
    component.clamp(-LIMIT - 1, LIMIT).cast_unsigned()
}

/// A depth in 2^-31, so that cutting it to `bits` rounds it.
#[inline(always)]
fn rounded_depth(zs: u32, bits: u32) -> u32 {
    if bits < 31 { zs - (zs >> bits) + (1 << (30 - bits)) } else { zs }
}

/// Its words, as their meaning is not known here.
impl<V: Varying> fmt::Debug for Corner<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        struct Words<'a, V: Varying>(&'a V::Of<u32>);
        impl<V: Varying> fmt::Debug for Words<'_, V> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let list = RefCell::new(f.debug_list());
                let _ = V::map(self.0, &|word: u32| {
                    list.borrow_mut().entry(&word);
                });
                list.into_inner().finish()
            }
        }
        let Self { place, zs, q, components } = self;
        let words = Words::<V>(components);
        f.debug_struct("Corner")
            .field("place", place)
            .field("zs", zs)
            .field("q", q)
            .field("components", &words)
            .finish()
    }
}

/// The triangles that are left out, by their orientation on the screen after snapping.
///
/// A front face is one whose vertices run counter-clockwise as seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Leave out back faces.
    #[default]
    Back,
    /// Leave out front faces.
    Front,
    /// Draw both.
    None,
}

impl Cull {
    /// Whether a triangle with this doubled area (positive when clockwise on the screen) is left out.
    #[inline]
    pub(crate) fn drops(self, area: i64) -> bool {
        match self {
            Self::Back => area >= 0,
            Self::Front => area <= 0,
            Self::None => area == 0,
        }
    }
}

/// The fate of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Outcome {
    /// Left out: it faces the wrong way, or has no area after snapping.
    Culled,
    /// Without a sample of the band.
    Missed,
    /// Drawn: it covers samples of the band, whether or not they were seen.
    Drawn,
}

/// Snapped positions in subpixels.
pub(crate) type Corners = [[i32; 2]; 3];

/// The facing and the box of a triangle of which samples may be covered.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// Twice the signed area, positive when the vertices run clockwise on the screen.
    area: i64,
    columns: [i32; 2],
    rows: [i32; 2],
    fits_i32: bool,
    is_large: bool,
}

impl Reach {
    #[inline(always)]
    pub(crate) fn new<V: Varying>(
        vertices: [&Corner<V>; 3],
        (bits, fixed): (u32, bool),
        cull: Cull,
        [limits, rows]: &[Range<i32>; 2],
    ) -> Result<Self, Outcome> {
        let corners = map3(vertices, |corner| corner.place(fixed));
        let area = doubled_area(&corners);
        if cull.drops(area) {
            return Err(Outcome::Culled);
        }
        let bounds = Bounds::of(&corners);
        let Some([columns, rows]) = bounds.within(bits, [limits.clone(), rows.clone()]) else {
            return Err(Outcome::Missed);
        };
        let (columns, rows) = ([columns.start, columns.end], [rows.start, rows.end]);
        Ok(Self { area, columns, rows, fits_i32: bounds.fits_i32(bits), is_large: bounds.is_large(bits) })
    }

    /// The columns whose samples lie in the box.
    #[must_use]
    #[inline(always)]
    pub fn columns(&self) -> Range<i32> {
        self.columns[0]..self.columns[1]
    }

    /// The rows among the limits whose samples lie in the box; at least one.
    #[must_use]
    #[inline(always)]
    pub fn rows(&self) -> Range<i32> {
        self.rows[0]..self.rows[1]
    }

    /// Twice the signed area.
    #[inline(always)]
    pub(crate) fn area(&self) -> i64 {
        self.area
    }

    /// Whether the triangle is [large](LARGE).
    #[inline(always)]
    pub(crate) fn is_large(&self) -> bool {
        self.is_large
    }

    /// Whether edge functions fit `i32` everywhere in the box.
    #[inline(always)]
    pub(crate) fn fits_i32(&self) -> bool {
        self.fits_i32
    }
}

/// The box around three corners, in subpixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    min: [i32; 2],
    max: [i32; 2],
}

impl Bounds {
    #[inline]
    pub(crate) fn of(&[a, b, c]: &Corners) -> Self {
        let min = |axis: usize| a[axis].min(b[axis]).min(c[axis]);
        let max = |axis: usize| a[axis].max(b[axis]).max(c[axis]);
        Self { min: [min(0), min(1)], max: [max(0), max(1)] }
    }

    /// Whether edge functions fit `i32` everywhere in the box and in the pixel around it, see [`FITS_I32`].
    #[inline]
    pub(crate) fn fits_i32(&self, bits: u32) -> bool {
        let side = |axis: usize, more: i32| i64::from(self.max[axis] - self.min[axis] + more);
        side(0, 2 << bits) * side(1, 1 << bits) <= FITS_I32
    }

    /// Whether a triangle in this box is [large](LARGE), on a grid with so many bits.
    #[inline]
    pub(crate) fn is_large(&self, bits: u32) -> bool {
        let side = |axis: usize| self.max[axis] - self.min[axis];
        side(0).max(side(1)) >= LARGE << bits
    }

    /// Its width in subpixels.
    #[inline(always)]
    pub(crate) fn width(&self) -> i32 {
        self.max[0] - self.min[0]
    }

    /// All columns, and the rows within the limits, whose samples lie within the box, with so many bits of subpixels;
    /// `None` if the limits hold no sample.
    #[inline]
    pub(crate) fn within(&self, bits: u32, [limits, rows]: [Range<i32>; 2]) -> Option<[Range<i32>; 2]> {
        let (columns, rows) = (self.samples(bits, 0, i32::MIN..i32::MAX), self.samples(bits, 1, rows));
        let none = rows.is_empty() || columns.start.max(limits.start) >= columns.end.min(limits.end);
        (!none).then_some([columns, rows])
    }

    /// The columns or rows, within `limits`, whose sample lies within the box, with so many bits of subpixels.
    #[inline]
    pub(crate) fn samples(&self, bits: u32, axis: usize, limits: Range<i32>) -> Range<i32> {
        // Sample i lies at i + 1/2 pixels: the first at or after the minimum, the last at or before the maximum.
        let half = 1 << (bits - 1);
        let first = (self.min[axis] + half - 1) >> bits;
        let end = ((self.max[axis] - half) >> bits) + 1;
        first.max(limits.start)..end.min(limits.end)
    }
}

/// Twice the signed area, positive when the corners run clockwise on the screen.
#[inline]
pub(crate) fn doubled_area(&[a, b, c]: &Corners) -> i64 {
    let sides = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
    if LOW_WORDS_ONLY {
        let [ux, uy, vx, vy] = sides;
        let far = |side: i32| (side + (1 << 14)).cast_unsigned();
        if far(ux) | far(uy) | far(vx) | far(vy) < 1 << 15 {
            return (ux * vy - uy * vx).into();
        }
    }
    let [ux, uy, vx, vy] = map4(sides, i64::from);
    ux * vy - uy * vx
}

/// The corners, and an item of each, in the order in which they are taken: clockwise, from the topmost (of two, the
/// left one). The same for every order in which the triangle could be given, so that no bit depends on that.
#[inline(always)]
pub(crate) fn in_order<T: Copy>(corners: Corners, items: [T; 3], area: i64) -> (Corners, [T; 3]) {
    // As numbers, and without branches: those would be tosses of a coin.
    let key = |[x, y]: [i32; 2]| i64::from(y) << 32 | i64::from(x.cast_unsigned() ^ 1 << 31);
    let clockwise = area > 0;
    let swapped = |[a, b, c]: [T; 3]| if clockwise { [a, b, c] } else { [a, c, b] };
    let ([a, b, c], [x, y, z]) =
        if clockwise { (corners, items) } else { ([corners[0], corners[2], corners[1]], swapped(items)) };
    let [ka, kb, kc] = [key(a), key(b), key(c)];
    let (b_first, c_first) = ((kb < ka) & (kb <= kc), (kc < ka) & (kc < kb));
    let (p, q, r, u, v, w) = if b_first { (b, c, a, y, z, x) } else { (a, b, c, x, y, z) };
    if c_first { ([c, a, b], [z, x, y]) } else { ([p, q, r], [u, v, w]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_does_not_depend_on_how_a_triangle_is_given() {
        let [a, b, c] = [[5, 9], [1, 2], [8, 2]];
        for corners in [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]] {
            let ordered = in_order(corners, corners, doubled_area(&corners));
            assert_eq!(ordered, ([b, c, a], [b, c, a]));
        }
    }

    #[test]
    fn facing_is_told_by_the_area() {
        let clockwise = doubled_area(&[[0, 0], [16, 0], [0, 16]]);
        assert_eq!(clockwise, 256);
        assert!(Cull::Back.drops(clockwise) && !Cull::Front.drops(clockwise) && !Cull::None.drops(clockwise));
        assert!(!Cull::Back.drops(-1) && Cull::Front.drops(-1) && !Cull::None.drops(-1));
        assert!(Cull::Back.drops(0) && Cull::Front.drops(0) && Cull::None.drops(0));
    }

    #[test]
    fn boxes_hold_the_samples_between_their_sides() {
        let samples = |low, high| Bounds { min: [low; 2], max: [high; 2] }.samples(4, 0, -9..9);
        assert_eq!(samples(8, 8), 0..1);
        assert_eq!(samples(9, 23), 1..1);
        assert_eq!(samples(-8, 24), -1..2);
        assert_eq!(samples(-1000, 1000), -9..9);
    }
}
