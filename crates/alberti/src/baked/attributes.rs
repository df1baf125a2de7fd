//! The attributes of vertices, as files have them and as vertices carry them.

use super::error::BakedError;
use super::sections::{Sections, half};
use super::within;
use alberti_math::glam::{Vec2, Vec3, Vec4};
use alberti_math::{Octahedral, Q16, Varying};
use core::ops::BitOr;

/// A set of attributes, beside places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Attributes(u16);

impl Attributes {
    /// Texture coordinates.
    pub const UV: Self = Self(1);
    /// Normals.
    pub const NORMAL: Self = Self(2);
    /// Tangents.
    pub const TANGENT: Self = Self(4);
    /// Colours.
    pub const COLOR: Self = Self(8);
    /// No attribute.
    pub const NONE: Self = Self(0);
    /// Every attribute.
    pub const ALL: Self = Self(15);

    /// The set of a file's bits, if they are known.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Option<Self> {
        if bits & !Self::ALL.0 == 0 { Some(Self(bits)) } else { None }
    }

    /// The bits of a file.
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// Whether all of another set are in this.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Those of both sets.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOr for Attributes {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        self.with(other)
    }
}

/// The places of a part's texture coordinates: `origin + (c << shift)` 65536ths.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Grid {
    pub(super) origin: [i32; 2],
    pub(super) shifts: [u16; 2],
}

/// Vertices of a file, by numbers. Those that are not there, and attributes that the file lacks, are zeros.
#[derive(Clone, Copy, Debug)]
pub struct Vertices<'a> {
    pub(super) places: &'a [[u8; 6]],
    uvs: &'a [[u8; 4]],
    normals: &'a [[u8; 2]],
    tangents: &'a [[u8; 3]],
    colors: &'a [[u8; 3]],
    grid: Grid,
}

impl<'a> Vertices<'a> {
    /// Those of a file, so many.
    pub(super) fn read(
        sections: &mut Sections<'a>,
        attributes: Attributes,
        (stated, all): (usize, u32),
    ) -> Result<Self, BakedError> {
        let some = |attribute| (stated, if attributes.contains(attribute) { all } else { 0 });
        Ok(Self {
            places: sections.take((stated, all))?,
            uvs: sections.take(some(Attributes::UV))?,
            normals: sections.take(some(Attributes::NORMAL))?,
            tangents: sections.take(some(Attributes::TANGENT))?,
            colors: sections.take(some(Attributes::COLOR))?,
            grid: Grid::default(),
        })
    }

    /// Those of a part, on its grid.
    pub(super) fn part(&self, range: [u32; 2], grid: Grid) -> Self {
        Self {
            places: within(self.places, range),
            uvs: within(self.uvs, range),
            normals: within(self.normals, range),
            tangents: within(self.tangents, range),
            colors: within(self.colors, range),
            grid,
        }
    }

    /// The place of a vertex, in the file's unit.
    #[inline(always)]
    pub(super) fn place(&self, number: usize) -> Option<[i16; 3]> {
        let place = self.places.get(number)?;
        Some([0, 2, 4].map(|at| half(place, at).cast_signed()))
    }

    /// Texture coordinates.
    #[must_use]
    #[inline(always)]
    pub fn uv(&self, number: usize) -> [Q16; 2] {
        let uv = self.uvs.get(number).copied().unwrap_or_default();
        let Grid { origin: [left, low], shifts: [along, up] } = self.grid;
        let at = |origin: i32, at: usize, shift: u16| {
            Q16::from_bits(origin.wrapping_add(i32::from(half(&uv, at)).wrapping_shl(shift.into())))
        };
        [at(left, 0, along), at(low, 2, up)]
    }

    /// The normal, a unit vector.
    #[must_use]
    #[inline(always)]
    pub fn normal(&self, number: usize) -> [Q16; 3] {
        let place = self.normals.get(number).copied().unwrap_or_default();
        Octahedral(place.map(u8::cast_signed)).components()
    }

    /// The tangent, a unit vector along which u grows, and the handedness, 1 or -1.
    #[must_use]
    #[inline(always)]
    pub fn tangent(&self, number: usize) -> [Q16; 4] {
        let [along, up, handedness] = self.tangents.get(number).copied().unwrap_or_default();
        let [x, y, z] = Octahedral([along, up].map(u8::cast_signed)).components();
        [x, y, z, if handedness.cast_signed() < 0 { -Q16::ONE } else { Q16::ONE }]
    }

    /// Red, green and blue, from 0 to 1.
    #[must_use]
    #[inline(always)]
    pub fn color(&self, number: usize) -> [Q16; 3] {
        let color = self.colors.get(number).copied().unwrap_or_default();
        // 255 is 65535 of 65536.
        color.map(|byte| Q16::from_bits(i32::from(byte) * 257))
    }
}

/// The attributes that vertices of a [`BakedMesh`](super::BakedMesh) carry: [`Uv`], [`Normal`], [`Tangent`], [`Color`],
/// a tuple of such, or `()` for none.
pub trait Attribute {
    /// Their varying.
    type Varying: Varying;

    /// The attributes that a file must have for it.
    const NEEDS: Attributes;

    /// The components of a vertex.
    fn components(vertices: &Vertices<'_>, number: usize) -> <Self::Varying as Varying>::Of<Q16>;
}

macro_rules! attributes {
    ($($(#[$doc:meta])* $Name:ident: $Varying:ty, $needs:ident, $read:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $Name;

        impl Attribute for $Name {
            type Varying = $Varying;

            const NEEDS: Attributes = Attributes::$needs;

            #[inline(always)]
            fn components(vertices: &Vertices<'_>, number: usize) -> <$Varying as Varying>::Of<Q16> {
                vertices.$read(number)
            }
        }
    )*};
}
attributes! {
    /// Texture coordinates.
    Uv: Vec2, UV, uv;
    /// Normals.
    Normal: Vec3, NORMAL, normal;
    /// Tangents, with the handedness as the last component.
    Tangent: Vec4, TANGENT, tangent;
    /// Colours, red, green and blue from 0 to 1.
    Color: Vec3, COLOR, color;
}

impl Attribute for () {
    type Varying = ();

    const NEEDS: Attributes = Attributes::NONE;

    #[inline(always)]
    fn components(_: &Vertices<'_>, _: usize) {}
}

macro_rules! tuples {
    ($(($($Name:ident)+))+) => {$(
        impl<$($Name: Attribute),+> Attribute for ($($Name,)+) {
            type Varying = ($($Name::Varying,)+);

            const NEEDS: Attributes = Attributes::NONE$(.with($Name::NEEDS))+;

            #[inline(always)]
            fn components(vertices: &Vertices<'_>, number: usize) -> <Self::Varying as Varying>::Of<Q16> {
                ($($Name::components(vertices, number),)+)
            }
        }
    )+};
}
tuples! { (A B) (A B C) (A B C D) }
