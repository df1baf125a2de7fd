//! Meshes and textures in one file, read in place: the files that `alberti bake` writes.
//!
//! Everything is little-endian, and nothing is aligned. So a file can be anywhere in flash, and is read on any machine.
//!
//! ```text
//! header     32 bytes  [`MAGIC`], [`VERSION`], counts, the unit of places
//! places      6 bytes a vertex, three i16           vertices of all parts, each kind of attribute for itself,
//! coordinates 4 bytes, two u16                      and only those that [`Attributes`] name
//! normals     2 bytes, an [`Octahedral`]
//! tangents    3 bytes, an [`Octahedral`] and the handedness
//! colours     3 bytes, sRGB
//! triangles   6 bytes a triangle, three u16         numbers of vertices within the part
//! meshlets   28 bytes each                          numbers of triangles within the part
//! parts      60 bytes each                          ranges of the above, a ball, a colour, a texture's number, and
//!                                                   the grid of texture coordinates
//! textures   16 bytes each                          format, size, place of the palette and of the texels behind it
//! texels                                            level after level
//! ```

mod attributes;
mod error;
mod mesh;
mod sections;
#[cfg(test)]
mod tests;
mod texels;

pub use attributes::{Attribute, Attributes, Color, Normal, Tangent, Uv, Vertices};
pub use error::{BakedError, Fault};
pub use mesh::BakedMesh;
pub use texels::{TexelCode, Texels};

use crate::meshlets::Ball;
use alberti_math::Rgba8;
use alberti_math::glam::Vec3;
use attributes::Grid;
use core::marker::PhantomData;
use sections::{Sections, float, half, word};

/// The first bytes of a file.
pub const MAGIC: [u8; 4] = *b"ALBK";
/// The version of the format that is read. Files of version 1, in which all parts had one grid, are to be baked again.
pub const VERSION: u16 = 2;
/// The bytes of the header.
pub const HEADER: usize = 32;
/// The bytes of a part.
pub const PART: usize = 60;
/// The most vertices of a part, whose numbers are `u16`.
pub const MAX_VERTICES: u32 = 1 << 16;

/// The greatest distance of texture coordinates from 0, and the most that a grid spans: 2^12.
const MAX_UV: u32 = 1 << 28;
const MAX_SHIFT: u16 = 12;
/// The number of no texture.
const NONE: u16 = u16::MAX;

/// A file of `alberti bake`, checked once, and read in place after that.
///
/// ```
/// use alberti::baked::{Baked, Normal, Texels, Uv};
/// use alberti::shaders::{Sunlit, Unlit};
/// use alberti::texture::{Bilinear, Repeat};
/// use alberti::{Error, Pass, Target, View, Vector3, glam::Vec3};
///
/// fn draw(file: &[u8], view: &View, target: &mut Target<'_, alberti::Rgb565Be, alberti::D16>) -> Result<(), Error> {
///     let baked = Baked::read(file)?;
///     for part in baked.parts() {
///         let Some(Texels::Rgb565(map)) = part.texture().and_then(|number| baked.texture(number)) else { continue };
///         let stage = Unlit(map.level(0).sampler(Bilinear, Repeat));
///         let stage = Sunlit::new(stage, Vector3::new(Vec3::ONE), 0.3, 0.7);
///         Pass::new(view, &part.mesh::<(Normal, Uv)>()?, stage).draw(target);
///     }
///     Ok(())
/// }
/// // A fault says where it is: here the first bytes are no file of this kind.
/// assert_eq!(Baked::read(&[0; 64]).unwrap_err().offset, 0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Baked<'a> {
    bytes: &'a [u8],
    attributes: Attributes,
    unit: f32,
    vertices: Vertices<'a>,
    triangles: &'a [[u8; 6]],
    meshlets: &'a [[u8; 28]],
    parts: &'a [[u8; PART]],
    textures: &'a [[u8; 16]],
}

impl<'a> Baked<'a> {
    /// The view of a file, which must end where the file does.
    ///
    /// # Errors
    /// The bytes are no such file, or one of another version; or a length, a range, an index or a size is not within
    /// the file's. Then nothing is read that is not there. What is not checked is the meaning: bounds of meshlets that
    /// are too small leave out triangles.
    ///
    /// # Cost
    /// A few instructions a triangle, a part and a texture. No memory but the value itself.
    pub fn read(bytes: &'a [u8]) -> Result<Self, BakedError> {
        let header = bytes.first_chunk::<HEADER>().ok_or(BakedError {
            fault: Fault::Length,
            offset: 0,
            found: count(bytes.len()),
            expected: count(HEADER),
        })?;
        let check = |holds: bool, fault: Fault, offset: u32, found: u32, expected: u32| {
            if holds { Ok(()) } else { Err(BakedError { fault, offset, found, expected }) }
        };
        let (magic, version, length) = (word(header, 0), half(header, 4).into(), word(header, 8));
        check(header.starts_with(&MAGIC), Fault::Magic, 0, magic, u32::from_le_bytes(MAGIC))?;
        check(version == VERSION.into(), Fault::Version, 4, version, VERSION.into())?;
        let (bits, all) = (half(header, 6), Attributes::ALL.bits().into());
        let unknown = BakedError { fault: Fault::Attributes, offset: 6, found: bits.into(), expected: all };
        let attributes = Attributes::from_bits(bits).ok_or(unknown)?;
        check(length as usize == bytes.len(), Fault::Length, 8, length, count(bytes.len()))?;
        let unit = float(header, 28);
        check(unit > 0.0 && unit.is_finite(), Fault::Number, 28, unit.to_bits(), 0)?;

        let [vertices, triangles, meshlets, parts, textures] = [12, 16, 20, 24, 26].map(|at| {
            let number = if at < 24 { word(header, at) } else { half(header, at).into() };
            (at, number)
        });
        let mut sections = Sections { bytes, at: HEADER };
        let vertices = Vertices::read(&mut sections, attributes, vertices)?;
        let baked = Self {
            bytes,
            attributes,
            unit,
            vertices,
            triangles: sections.take(triangles)?,
            meshlets: sections.take(meshlets)?,
            parts: sections.take(parts)?,
            textures: sections.take(textures)?,
        };
        baked.check_parts()?;
        for entry in baked.textures {
            Texels::read(bytes, entry, || baked.offset(entry))?;
        }
        Ok(baked)
    }

    /// Checks the ranges of all parts, and what is in them.
    fn check_parts(&self) -> Result<(), BakedError> {
        let wrong = |fault, bytes: &[u8], found: u32, expected: u32| {
            Err(BakedError { fault, offset: self.offset(bytes), found, expected })
        };
        for part in self.parts {
            let ranges = [0, 8, 16].map(|at| [word(part, at), word(part, at + 4)]);
            let whole = [self.vertices.places.len(), self.triangles.len(), self.meshlets.len()];
            for ([start, length], whole) in ranges.into_iter().zip(whole.map(count)) {
                if start > whole || length > whole - start {
                    return wrong(Fault::Range, part, start.saturating_add(length), whole);
                }
            }
            let [[_, vertices], [first, triangles], [meshlet, meshlets]] = ranges;
            if vertices > MAX_VERTICES {
                return wrong(Fault::Range, part, vertices, MAX_VERTICES);
            }
            let texture = half(part, 44);
            if texture != NONE && usize::from(texture) >= self.textures.len() {
                return wrong(Fault::Texture, part, texture.into(), count(self.textures.len()));
            }
            let Grid { origin, shifts } = grid(part);
            for (origin, shift) in origin.into_iter().map(i32::unsigned_abs).zip(shifts) {
                if origin > MAX_UV {
                    return wrong(Fault::Grid, part, origin, MAX_UV);
                }
                if shift > MAX_SHIFT {
                    return wrong(Fault::Grid, part, shift.into(), MAX_SHIFT.into());
                }
            }
            let ball = self.ball(part);
            if !(ball.center.is_finite() && ball.radius.is_finite() && ball.radius >= 0.0) {
                return wrong(Fault::Number, part, ball.radius.to_bits(), 0);
            }
            for triangle in within(self.triangles, [first, triangles]) {
                for index in [0, 2, 4].map(|at| u32::from(half(triangle, at))) {
                    if index >= vertices {
                        return wrong(Fault::Index, triangle, index, vertices);
                    }
                }
            }
            let mut last = 0;
            for meshlet in within(self.meshlets, [meshlet, meshlets]) {
                let [start, end] = [word(meshlet, 0), word(meshlet, 4)];
                if start < last || end < start || end > triangles {
                    return wrong(Fault::Range, meshlet, end, triangles);
                }
                last = end;
            }
        }
        Ok(())
    }

    /// The place of bytes of the file.
    fn offset(&self, bytes: &[u8]) -> u32 {
        count((bytes.as_ptr() as usize).wrapping_sub(self.bytes.as_ptr() as usize))
    }

    fn ball(&self, part: &[u8; PART]) -> Ball {
        let [x, y, z, radius] = [24, 28, 32, 36].map(|at| float(part, at));
        Ball { center: Vec3::new(x, y, z), radius }
    }

    /// The attributes of its vertices.
    #[must_use]
    pub fn attributes(&self) -> Attributes {
        self.attributes
    }

    /// The unit of places, in object space. They are integers from -32767 to 32767.
    #[must_use]
    pub fn unit(&self) -> f32 {
        self.unit
    }

    /// The parts, of one material each, in the order in which they are to be drawn.
    pub fn parts(&self) -> impl Iterator<Item = BakedPart<'a>> {
        let baked = *self;
        self.parts.iter().map(move |bytes| BakedPart { baked, bytes })
    }

    /// A texture; `None` from the number of textures on.
    #[must_use]
    pub fn texture(&self, number: usize) -> Option<Texels<'a>> {
        let entry = self.textures.get(number)?;
        Texels::read(self.bytes, entry, || 0).ok()
    }
}

/// The triangles of one material.
#[derive(Clone, Copy, Debug)]
pub struct BakedPart<'a> {
    baked: Baked<'a>,
    bytes: &'a [u8; PART],
}

impl<'a> BakedPart<'a> {
    /// The colour: of the surface, or a factor of its texture's.
    #[must_use]
    pub fn color(&self) -> Rgba8 {
        Rgba8::from_bits(word(self.bytes, 40))
    }

    /// The number of the texture, if it has one.
    #[must_use]
    pub fn texture(&self) -> Option<usize> {
        Some(half(self.bytes, 44)).filter(|&number| number != NONE).map(usize::from)
    }

    /// The mesh, whose vertices carry these attributes: `()`, [`Uv`], `(Normal, Uv)` and so on. Meshlets are those of
    /// the file.
    ///
    /// # Errors
    /// The file has not all of them.
    pub fn mesh<A: Attribute>(&self) -> Result<BakedMesh<'a, A>, BakedError> {
        let Self { baked, bytes } = *self;
        if !baked.attributes.contains(A::NEEDS) {
            let [found, expected] = [baked.attributes, A::NEEDS].map(|set| set.bits().into());
            return Err(BakedError { fault: Fault::Attributes, offset: 6, found, expected });
        }
        let range = |at: usize| [word(bytes, at), word(bytes, at + 4)];
        Ok(BakedMesh {
            vertices: baked.vertices.part(range(0), grid(bytes)),
            triangles: within(baked.triangles, range(8)),
            meshlets: within(baked.meshlets, range(16)),
            ball: baked.ball(bytes),
            unit: baked.unit,
            attributes: PhantomData,
        })
    }
}

/// The grid of a part's texture coordinates.
fn grid(part: &[u8; PART]) -> Grid {
    Grid {
        origin: [48, 52].map(|at| word(part, at).cast_signed()),
        shifts: [56, 58].map(|at| half(part, at)),
    }
}

/// So many things from a place on; none where there are not so many.
fn within<T>(things: &[T], [start, length]: [u32; 2]) -> &[T] {
    let start = start as usize;
    things.get(start..start.saturating_add(length as usize)).unwrap_or_default()
}

/// A length in a file, none of which is as long as 4 GiB.
fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}
