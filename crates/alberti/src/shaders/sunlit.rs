//! Light that falls off with the cosine.

use super::wide::lit;
use alberti_math::glam::Vec3;
use alberti_math::lanes::Lanes;
use alberti_math::{Point3, Rgba8, Space, Varying, Vector3, World};
use alberti_raster::{FragmentStage, Fragments, Gradient};

/// Another stage's colour under Lambert's cosine law, with one light at infinity:
/// colour · (ambient + diffuse · max(0, n·l)).
///
/// Normals are interpolated and made unit again at each fragment. For facets instead of a smooth surface, give the
/// three vertices of each triangle its [`face_normal`].
///
/// # Precision
/// Within 0.51 of a byte of the formula, from the wrapped stage's bytes, for normals between 1e-18 and 1e18 long. A
/// shorter or longer one has no direction that could be told, and gets a light between the ambient and the full one. In
/// fixed point lengths must be between 0.1 and 100, and the light is within 2^-10 of the formula.
///
/// # Cost
/// A square root, a division and about twenty multiplications and additions a fragment.
#[derive(Clone, Copy, Debug)]
pub struct Sunlit<S> {
    surface: S,
    to_light: Vec3,
    ambient: f32,
    diffuse: f32,
}

impl<S> Sunlit<S> {
    /// Light from the direction `to_light`, from 2^-60 to 2^60 long, in the space in which the normals are given.
    /// `ambient` falls everywhere, `diffuse` where the surface faces the light.
    #[must_use]
    pub fn new(surface: S, to_light: Vector3<World>, ambient: f32, diffuse: f32) -> Self {
        Self { surface, to_light: to_light.coords.normalize_or_zero(), ambient, diffuse }
    }
}

impl<S> Sunlit<S> {
    /// The factor for the channels of a surface with this normal: ambient + diffuse · max(0, n·l).
    #[inline(always)]
    pub fn light<L: Lanes>(&self, lanes: L, [x, y, z]: [L::Number; 3]) -> L::Number {
        let Vec3 { x: lx, y: ly, z: lz } = self.to_light;
        let [lx, ly, lz] = [lanes.splat(lx), lanes.splat(ly), lanes.splat(lz)];
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        let cosine = (x * lx + y * ly + z * lz) / lanes.sqrt(x * x + y * y + z * z);
        // A zero normal gives NaN here, which the comparison takes for no light; one too short may give infinity.
        let facing = lanes.select(lanes.less(zero, cosine), lanes.min(cosine, one), zero);
        lanes.splat(self.ambient) + lanes.splat(self.diffuse) * facing
    }
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> FragmentStage<(Vec3, V)> for Sunlit<S> {
    as_surface!((Vec3, V), |gradient| &gradient.map(|(_, part)| part));

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (Vec3, V)>) -> (L::U32, L::Mask) {
        let (lanes, (normal, _)) = (fragments.lanes, fragments.varying);
        let (surface, mask) = self.surface.shade(&fragments.part(|(_, varying)| *varying));
        (lit(lanes, surface, self.light(lanes, normal)), mask)
    }
}

/// The normal of the plane through three points, towards the side from which they run counter-clockwise. Its length is
/// twice the triangle's area, which fixed point may not hold: normalize it there. Zero where there is none.
#[must_use]
pub fn face_normal<S: Space>([a, b, c]: [Point3<S>; 3]) -> Vector3<S> {
    Vector3::new((b - a).coords.cross((c - a).coords))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;
    use alberti_math::Q16;
    use alberti_math::lanes::OneFixed;

    #[test]
    fn light_falls_off_with_the_cosine() {
        let white = Sunlit::new(Solid(Rgba8::WHITE), Vector3::new(Vec3::new(0.0, 7.0, 0.0)), 0.2, 0.6);
        let gray = |normal: Vec3| white.shade_one((normal, ())).expect("never discards").to_bytes()[0];
        assert_eq!(gray(Vec3::Y * 3.0), 204);
        assert_eq!(gray(Vec3::new(3f32.sqrt(), 1.0, 0.0)), 128);
        assert_eq!(gray(Vec3::X), 51);
        assert_eq!(gray(Vec3::NEG_Y), 51);
        assert_eq!(gray(Vec3::ZERO), 51);
    }

    #[test]
    fn light_in_fixed_point_keeps_its_bound() {
        let to_light = Vec3::new(0.48, 0.6, 0.64);
        let stage = Sunlit::new(Solid(Rgba8::WHITE), Vector3::new(to_light), 0.2, 0.8);
        let mut worst = 0.0f32;
        for step in 0..20_000_u16 {
            let [a, b] = [f32::from(step % 141) * 0.0446, f32::from(step / 141) * 0.0223];
            let length = 0.1 * 1000f32.powf(f32::from(step % 97) / 96.0);
            let unit = Vec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos());
            let light = stage.light(OneFixed, (unit * length).to_array().map(Q16::from_f32)).to_f32();
            worst = worst.max((light - (0.2 + 0.8 * unit.dot(to_light).max(0.0))).abs());
        }
        assert!((0.0002..1.0 / 1024.0).contains(&worst), "{worst}");
    }

    #[test]
    fn faces_look_to_where_they_run_counter_clockwise() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(Point3::<World>::new);
        assert_eq!(face_normal(corners).coords, Vec3::Z);
    }
}
