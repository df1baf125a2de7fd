//! Vertices in few bytes, and what that loses.

use crate::error::{Error, number};
use crate::scene::Vertex;
use crate::scene::normals::{length, narrow, sub};
use alberti::Octahedral;
use alberti::baked::Attributes;
use alberti::glam::Vec3;

/// A vertex in integers. Attributes that are not asked for are zeros.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Packed {
    /// In units of the grid.
    pub place: [i16; 3],
    /// In steps of the grid, from its origin.
    pub uv: [u16; 2],
    /// An [`Octahedral`].
    pub normal: [i8; 2],
    /// An [`Octahedral`], and the handedness.
    pub tangent: [i8; 3],
    /// sRGB.
    pub color: [u8; 3],
}

/// The numbers that a part's integers stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grids {
    /// The unit of places, in object space: that of all parts.
    pub unit: f32,
    /// 65536ths of a texture, where coordinates of 0 are.
    pub origin: [i32; 2],
    /// The steps of coordinates are 2^shift such parts.
    pub shifts: [u16; 2],
}

/// The greatest differences between vertices and what they are rounded to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Losses {
    /// Of places, on an axis, in object space.
    pub place: f64,
    /// Of normals, in degrees.
    pub normal: f64,
    /// Of tangents, in degrees.
    pub tangent: f64,
    /// Of texture coordinates.
    pub uv: [f64; 2],
}

impl Losses {
    pub(super) fn and(self, other: Self) -> Self {
        let [u, v] = [0, 1].map(|axis| self.uv[axis].max(other.uv[axis]));
        Self {
            place: self.place.max(other.place),
            normal: self.normal.max(other.normal),
            tangent: self.tangent.max(other.tangent),
            uv: [u, v],
        }
    }
}

/// The greatest integer of a place.
const REACH: f64 = 32767.0;
/// 65536ths of the greatest texture coordinate: 4096.
const MAX_UV: f64 = 268_435_456.0;

/// The smallest unit of these vertices' places.
pub(super) fn unit<'a>(vertices: impl Iterator<Item = &'a Vertex>) -> f32 {
    let reach = vertices.flat_map(|v| v.position).map(|c| f64::from(c).abs()).fold(0.0, f64::max);
    let unit = if reach > 0.0 { narrow(reach / REACH) } else { 1.0 };
    unit.max(f32::MIN_POSITIVE)
}

impl Grids {
    /// The finest that hold these vertices of a part.
    ///
    /// # Errors
    /// Texture coordinates are too far from 0.
    pub(super) fn new<'a>(
        unit: f32,
        vertices: impl Iterator<Item = &'a Vertex> + Clone,
        attributes: Attributes,
    ) -> Result<Self, Error> {
        let mut grids = Self { unit, origin: [0; 2], shifts: [0; 2] };
        if !attributes.contains(Attributes::UV) {
            return Ok(grids);
        }
        for axis in 0..2 {
            let all = || vertices.clone().map(|v| f64::from(v.uv[axis]) * 65536.0);
            let (low, high) = (all().fold(f64::MAX, f64::min).floor(), all().fold(f64::MIN, f64::max).ceil());
            if low > high {
                continue;
            }
            let (mut shift, mut steps) = (0, high - low);
            // The end of a whole texture is a step too far, and rounded to the last.
            while steps > 65536.0 {
                (shift, steps) = (shift + 1, steps / 2.0);
            }
            if low < -MAX_UV || high > MAX_UV || shift > 12 {
                let [low, high] = [low, high].map(|c| number(narrow(c / 65536.0)));
                let found = format!("texture coordinates from {low} to {high}");
                let error = Error::new(found, "some from -4096 to 4096, and within 4096 of each other");
                return Err(error.hint("let textures repeat less, or leave out uv by --attributes"));
            }
            #[expect(clippy::cast_possible_truncation, reason = "within 2^28")]
            let origin = low as i32;
            (grids.origin[axis], grids.shifts[axis]) = (origin, shift);
        }
        Ok(grids)
    }

    /// The nearest integers, and what they lose.
    pub(super) fn pack(&self, vertex: &Vertex, attributes: Attributes) -> (Packed, Losses) {
        let has = |attribute| attributes.contains(attribute);
        let (mut packed, mut losses) = (Packed::default(), Losses::default());
        #[expect(clippy::cast_possible_truncation, reason = "these saturate")]
        let place = vertex.position.map(|c| (f64::from(c) / f64::from(self.unit)).round() as i16);
        packed.place = place;
        let off =
            |axis: usize| f64::from(place[axis]) * f64::from(self.unit) - f64::from(vertex.position[axis]);
        losses.place = [0, 1, 2].map(|axis| off(axis).abs()).into_iter().fold(0.0, f64::max);
        if has(Attributes::UV) {
            for axis in 0..2 {
                let (origin, step) = (f64::from(self.origin[axis]), f64::from(1_u32 << self.shifts[axis]));
                let bits = f64::from(vertex.uv[axis]) * 65536.0;
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "these saturate")]
                let steps = ((bits - origin) / step).round() as u16;
                packed.uv[axis] = steps;
                losses.uv[axis] = ((origin + f64::from(steps) * step - bits) / 65536.0).abs();
            }
        }
        if has(Attributes::NORMAL) {
            (packed.normal, losses.normal) = octahedral(vertex.normal);
        }
        if has(Attributes::TANGENT) {
            let [x, y, z, handedness] = vertex.tangent;
            let ([along, up], off) = octahedral([x, y, z]);
            (packed.tangent, losses.tangent) = ([along, up, if handedness < 0.0 { -1 } else { 1 }], off);
        }
        if has(Attributes::COLOR) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "these saturate")]
            let bytes = vertex.color.map(|c| (c * 255.0).round() as u8);
            packed.color = bytes;
        }
        (packed, losses)
    }

    /// The place that integers stand for.
    pub(super) fn place(&self, packed: &Packed) -> Vec3 {
        Vec3::from_array(packed.place.map(|c| f32::from(c) * self.unit))
    }
}

/// The two bytes of a direction, and the angle to it in degrees; 0 for none, which is no direction to miss.
fn octahedral(direction: [f32; 3]) -> ([i8; 2], f64) {
    let found = Octahedral::nearest(Vec3::from_array(direction));
    if direction == [0.0; 3] {
        return (found.0, 0.0);
    }
    let unit = found.to_vec3().to_array().map(f64::from);
    let chord = length(sub(unit, direction.map(f64::from)));
    (found.0, (2.0 * (chord / 2.0).min(1.0).asin()).to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(position: [f32; 3], uv: [f32; 2]) -> Vertex {
        Vertex { position, uv, normal: [0.6, 0.0, -0.8], ..Vertex::default() }
    }

    #[test]
    fn grids_are_as_fine_as_they_can_be() {
        let shape = [vertex([-3.0, 1.0, 0.5], [0.0, -1.25]), vertex([2.0, 0.0, 0.0], [1.0, 2.5])];
        let attributes = Attributes::UV | Attributes::NORMAL;
        let grids = Grids::new(unit(shape.iter()), shape.iter(), attributes).expect("grids");
        assert_eq!((grids.unit, grids.origin, grids.shifts), (3.0 / 32767.0, [0, -81920], [0, 2]));
        let (packed, losses): (Vec<_>, Vec<_>) =
            shape.iter().map(|vertex| grids.pack(vertex, attributes)).unzip();
        let losses = losses.into_iter().fold(Losses::default(), Losses::and);
        assert_eq!(packed[0].place, [-32767, 10922, 5461]);
        // 3.75 · 65536 / 4 steps, and the end of a whole texture.
        assert_eq!((packed[0].uv, packed[1].uv), ([0, 0], [65535, 61440]));
        assert!(losses.place <= f64::from(grids.unit) / 2.0 && losses.place > 0.0);
        assert_eq!(losses.uv, [1.0 / 65536.0, 0.0]);
        assert!(losses.normal <= 0.64 && losses.normal > 0.0);
        assert_eq!(packed[0].color, [0; 3]);
    }

    #[test]
    fn coordinates_have_an_end() {
        let refused = |uv| {
            let shape = [vertex([0.0; 3], uv), vertex([0.0; 3], [0.0; 2])];
            Grids::new(1.0, shape.iter(), Attributes::UV).expect_err("too far").to_string()
        };
        assert!(refused([5000.0, 0.0]).contains("found texture coordinates from 0 to 5000"));
        assert!(refused([0.0, -4097.0]).contains("from -4097 to 0"));
    }
}
