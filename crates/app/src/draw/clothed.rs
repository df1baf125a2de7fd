//! The triangles of a part with the attributes that its surface asks for.

use super::erased::Attributes;
use super::general::Surface;
use super::painted::Shine;
use super::position;
use crate::scene::{Glow, Vertex};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::material::{AnyLight, Framed, Lighting};
use alberti::{Geometry, Homogeneous, Object, Point3, Projector, Vector3};

/// A part's surface, and all that its attributes are made of.
pub(super) struct Clothed<'a> {
    pub(super) surface: Surface<'a>,
    /// The lights that fall on it.
    pub(super) lighting: Lighting<&'a [AnyLight], Shine>,
    /// Whether colours are amounts of light.
    pub(super) linear: bool,
    /// Whether the vertices' colours multiply its own.
    pub(super) colored: bool,
    /// Whether it has texture coordinates.
    pub(super) textured: bool,
    /// Whether its fragments have places in the world, whatever the surface.
    pub(super) placed: bool,
    /// Of the image that falls on it.
    pub(super) projector: Option<Projector>,
}

impl Clothed<'_> {
    /// The place of a vertex, and its attributes but for those of the projector's image.
    pub(super) fn vertex(&self, v: &Vertex) -> (Point3<Object>, Framed) {
        (position(v), framed(self, v))
    }

    /// Its colour, in the space of the surface's light.
    fn color(&self, v: &Vertex) -> Vec3 {
        Vec3::from_array(Glow { color: v.color, intensity: 1.0 }.factors(self.linear))
    }

    /// Its place on the projector's image.
    pub(super) fn on_image(&self, v: &Vertex) -> Homogeneous {
        // The model stands in the world where it was made.
        let world = Point3::new(Vec3::from_array(v.position));
        self.projector.map_or(Homogeneous::default(), |projector| projector.project(world))
    }
}

/// The attributes of a vertex for a surface. Components without a use are constant, so that they have no part in how
/// far a straight line may go. Lights at vertices are carried instead of the first two axes, colours instead of the
/// third, or of the first where they multiply a lit surface's.
fn framed(clothed: &Clothed<'_>, v: &Vertex) -> Framed {
    let [x, y, z, handedness] = v.tangent;
    let (place, normal) = (Vec3::from_array(v.position), Vec3::from_array(v.normal));
    let uv = if clothed.textured { Vec2::from_array(v.uv) } else { Vec2::ZERO };
    let seen = if clothed.placed { place } else { Vec3::ZERO };
    let flat = |third| Framed { position: seen, axes: [Vec3::ZERO, Vec3::ZERO, third], uv };
    match clothed.surface {
        Surface::Colors => flat(Vec3::from_array(v.color)),
        Surface::Unlit(_) => flat(Vec3::ZERO),
        Surface::Lit(_) => flat(normal),
        Surface::ByFragment(_) => {
            if clothed.colored {
                return Framed { position: place, axes: [clothed.color(v), Vec3::ZERO, normal], uv };
            }
            let tangent = Vec3::new(x, y, z);
            Framed { position: place, axes: [tangent, normal.cross(tangent) * handedness, normal], uv }
        }
        Surface::ByVertex(_) => {
            let [scattered, mirrored] = clothed.lighting.at_vertex(Point3::new(place), Vector3::new(normal));
            let color = if clothed.colored { clothed.color(v) } else { Vec3::ONE };
            Framed { position: place, axes: [scattered * color, mirrored, normal], uv }
        }
    }
}

/// Triangles of a part, as the pipeline takes them.
#[derive(Clone, Copy)]
pub(super) struct Triangles<'t, 'a> {
    pub(super) clothed: &'t Clothed<'a>,
    pub(super) vertices: &'t [Vertex],
    pub(super) triangles: &'t [[u32; 3]],
    /// The number of the first triangle, where each is to carry its [`Number`] instead of a place on an image.
    pub(super) numbers: Option<u32>,
    /// Whether they carry texture coordinates alone, and constants for all else.
    pub(super) bare: bool,
}

impl Geometry for Triangles<'_, '_> {
    type Varying = Attributes;

    fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Vertices that carry a triangle's number belong to that alone.
    fn vertices(&self) -> usize {
        if self.numbers.is_some() { 3 * self.triangles.len() } else { self.vertices.len() }
    }

    fn triangle(&self, number: usize) -> Option<[usize; 3]> {
        let indices = self.triangles.get(number)?;
        Some(if self.numbers.is_some() {
            [0, 1, 2].map(|corner| 3 * number + corner)
        } else {
            indices.map(|index| index as usize)
        })
    }

    fn vertex(&self, number: usize) -> Option<(Point3<Object>, Attributes)> {
        let Some(first) = self.numbers else {
            let v = self.vertices.get(number)?;
            let (place, framed) = self.clothed.vertex(v);
            if self.bare {
                let Framed { uv, .. } = framed;
                let bare = Framed { position: Vec3::ZERO, axes: [Vec3::ZERO; 3], uv };
                return Some((place, (Homogeneous::default(), bare)));
            }
            return Some((place, (self.clothed.on_image(v), framed)));
        };
        let index = self.triangles.get(number / 3)?[number % 3];
        let (place, framed) = self.clothed.vertex(self.vertices.get(index as usize)?);
        let triangle = first + u32::try_from(number / 3).ok()?;
        Some((place, (Number::carried(triangle), framed)))
    }
}

/// A triangle's number in two components: a constant is one at all pixels, by any policy.
pub(super) struct Number;

impl Number {
    /// Numbers from here on cannot be carried.
    pub(super) const LIMIT: u32 = 1 << (2 * Self::BITS);
    /// The bits that a component carries. It is an odd multiple of 2^-16 below 1, so that an error of as much as such a
    /// step is none, neither in floats nor in fixed point.
    pub(super) const BITS: u32 = 15;

    #[expect(clippy::cast_precision_loss, reason = "16 bits")]
    fn carried(number: u32) -> Homogeneous {
        let part = |bits: u32| (2 * (bits & ((1 << Self::BITS) - 1)) + 1) as f32 / 65536.0;
        Homogeneous { u: part(number), v: part(number >> Self::BITS), q: 0.0 }
    }

    /// The number of the words that [`floor_scaled`](alberti::Lanes::floor_scaled) by [`BITS`](Self::BITS) made.
    pub(super) fn of([low, high]: [u32; 2]) -> u32 {
        low | high << Self::BITS
    }
}
