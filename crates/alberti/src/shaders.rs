//! Built-in fragment stages. The last two wrap another, so that a scene pays for what it uses.
//!
//! | stage | varying | colour |
//! |---|---|---|
//! | [`Flat`] | any | one for all |
//! | [`VertexColor`] | `Vec3` | the varying, red, green, blue in [0, 1] |
//! | [`Unlit`] | `Vec2` | the texture at the varying |
//! | [`Tinted`] | the wrapped stage's | the wrapped stage's times a colour |
//! | [`Lambert`] | `(Vec3, V)`: a normal and the wrapped stage's | the wrapped stage's, lit |
//!
//! All arithmetic is on sRGB bytes, as they are stored.

use alberti_math::glam::{Vec2, Vec3};
use alberti_math::{Point3, Rgba8, Space, Vector3, World};
use alberti_raster::FragmentStage;
use alberti_texture::{Filter, Sampler, TexelFormat, Wrap};

/// One colour for everything.
///
/// # Cost
/// Nothing is interpolated.
#[derive(Clone, Copy, Debug)]
pub struct Flat(
    /// The colour.
    pub Rgba8,
);

impl<V> FragmentStage<V> for Flat {
    type Color = Rgba8;

    #[inline]
    fn shade(&self, _: V) -> Option<Rgba8> {
        Some(self.0)
    }
}

/// The interpolated colour of the vertices; components outside [0, 1] are clamped.
///
/// # Precision
/// To the nearest byte.
#[derive(Clone, Copy, Debug)]
pub struct VertexColor;

impl FragmentStage<Vec3> for VertexColor {
    type Color = Rgba8;

    #[inline]
    fn shade(&self, color: Vec3) -> Option<Rgba8> {
        Some(Rgba8::new(byte(color.x * 255.0), byte(color.y * 255.0), byte(color.z * 255.0), 255))
    }
}

/// The texture, read by a [`Sampler`].
#[derive(Clone, Copy, Debug)]
pub struct Unlit<S>(
    /// The texture with its filter and wrap mode.
    pub S,
);

impl<F: TexelFormat, Fl: Filter, U: Wrap, V: Wrap> FragmentStage<Vec2> for Unlit<Sampler<'_, F, Fl, U, V>> {
    type Color = Rgba8;

    #[inline]
    fn shade(&self, uv: Vec2) -> Option<Rgba8> {
        Some(self.0.sample(uv))
    }
}

/// Another stage's colour times a constant one.
///
/// # Precision
/// To the nearest byte; white changes nothing.
#[derive(Clone, Copy, Debug)]
pub struct Tinted<S> {
    /// What is tinted.
    pub surface: S,
    /// The factor, in bytes: 255 is one. The surface's alpha is kept.
    pub tint: Rgba8,
}

impl<V, S: FragmentStage<V, Color = Rgba8>> FragmentStage<V> for Tinted<S> {
    type Color = Rgba8;

    #[inline]
    fn shade(&self, varying: V) -> Option<Rgba8> {
        let [r, g, b, a] = self.surface.shade(varying)?.to_bytes();
        let [tint_r, tint_g, tint_b, _] = self.tint.to_bytes();
        let times = |x: u8, y: u8| {
            #[expect(clippy::cast_possible_truncation, reason = "at most 255")]
            let product = ((u32::from(x) * u32::from(y) + 127) / 255) as u8;
            product
        };
        Some(Rgba8::new(times(r, tint_r), times(g, tint_g), times(b, tint_b), a))
    }
}

/// Another stage's colour under Lambert's cosine law, with one light at infinity:
/// colour · (ambient + diffuse · max(0, n·l)).
///
/// Normals are interpolated and made unit again at each fragment. For facets instead of a smooth surface, give the
/// three vertices of each triangle its [`face_normal`].
///
/// # Precision
/// Within 0.51 of a byte of the formula, from the wrapped stage's bytes, for normals between 1e-18 and 1e18 long. A
/// shorter or longer one has no direction that could be told, and gets a light between the ambient and the full one.
///
/// # Cost
/// A square root, a division and about twenty multiplications and additions a fragment.
#[derive(Clone, Copy, Debug)]
pub struct Lambert<S> {
    surface: S,
    to_light: Vec3,
    ambient: f32,
    diffuse: f32,
}

impl<S> Lambert<S> {
    /// Light from the direction `to_light` (any length but zero), in the space in which the normals are given.
    /// `ambient` falls everywhere, `diffuse` where the surface faces the light.
    #[must_use]
    pub fn new(surface: S, to_light: Vector3<World>, ambient: f32, diffuse: f32) -> Self {
        Self { surface, to_light: to_light.coords.normalize_or_zero(), ambient, diffuse }
    }
}

impl<V, S: FragmentStage<V, Color = Rgba8>> FragmentStage<(Vec3, V)> for Lambert<S> {
    type Color = Rgba8;

    #[inline]
    fn shade(&self, (normal, varying): (Vec3, V)) -> Option<Rgba8> {
        let [r, g, b, a] = self.surface.shade(varying)?.to_bytes();
        let cosine = normal.dot(self.to_light) / normal.length();
        // A zero normal gives NaN here, which the comparison takes for no light; one too short may give infinity.
        let light = self.ambient + self.diffuse * if cosine > 0.0 { cosine.min(1.0) } else { 0.0 };
        let lit = |c: u8| byte(f32::from(c) * light);
        Some(Rgba8::new(lit(r), lit(g), lit(b), a))
    }
}

/// The normal of the plane through three points, towards the side from which they run counter-clockwise. Its length is
/// twice the triangle's area; zero where there is none.
#[must_use]
pub fn face_normal<S: Space>([a, b, c]: [Point3<S>; 3]) -> Vector3<S> {
    Vector3::new((b - a).coords.cross((c - a).coords))
}

/// The nearest byte; 0 below, 255 above, 0 for NaN.
#[inline]
fn byte(x: f32) -> u8 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    let nearest = (x + 0.5) as u8;
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_falls_off_with_the_cosine() {
        let white = Lambert::new(Flat(Rgba8::WHITE), Vector3::new(Vec3::new(0.0, 7.0, 0.0)), 0.2, 0.6);
        let gray = |normal: Vec3| white.shade((normal, ())).expect("never discards").to_bytes()[0];
        assert_eq!(gray(Vec3::Y * 3.0), 204);
        assert_eq!(gray(Vec3::new(3f32.sqrt(), 1.0, 0.0)), 128);
        assert_eq!(gray(Vec3::X), 51);
        assert_eq!(gray(Vec3::NEG_Y), 51);
        assert_eq!(gray(Vec3::ZERO), 51);
    }

    #[test]
    fn a_tint_multiplies_and_white_is_one() {
        for c in 0..=255u8 {
            let tinted = |tint| Tinted { surface: Flat(Rgba8::new(c, c, c, 9)), tint }.shade(());
            assert_eq!(tinted(Rgba8::WHITE), Some(Rgba8::new(c, c, c, 9)));
            let half = (f32::from(c) * 100.0 / 255.0).round();
            let bytes = tinted(Rgba8::new(100, 0, 255, 0)).expect("never discards").to_bytes();
            assert_eq!(bytes.map(f32::from), [half, 0.0, f32::from(c), 9.0]);
        }
    }

    #[test]
    fn vertex_colours_are_rounded_and_clamped() {
        let color = VertexColor.shade(Vec3::new(0.5, -1.0, 2.0));
        assert_eq!(color, Some(Rgba8::new(128, 0, 255, 255)));
    }

    #[test]
    fn faces_look_to_where_they_run_counter_clockwise() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(Point3::<World>::new);
        assert_eq!(face_normal(corners).coords, Vec3::Z);
    }
}
