//! One more vertex stage for a mesh that has one.

use crate::geometry::{Geometry, IntegerVertex};
use crate::meshlets::{Ball, Meshlet};
use alberti_math::{Object, Point3, Varying};
use core::fmt;

/// A mesh of integers whose vertices go through another stage: for light at the vertices of a mesh whose own stage is
/// closed, such as one that `alberti bake` made.
///
/// Places have to stay where they are, as meshlets know nothing of the stage.
///
/// ```
/// use alberti::shaders::Light;
/// use alberti::{Geometry, IntegerMesh, IntegerVertex, Q16, Staged, glam::Vec3};
///
/// // A mesh with normals, here the same for all.
/// let places = [[0_i16, 0, 0], [1000, 0, 0], [0, 1000, 0]];
/// let mesh = IntegerMesh::new(&places, &[[0_u16, 1, 2]], 0.001, |&place| IntegerVertex::<Vec3> {
///     place,
///     components: [Q16::ZERO, Q16::ZERO, Q16::ONE],
/// });
/// // It has light from the direction (0, 0.6, 0.8) instead.
/// let [y, z] = [0.6, 0.8].map(Q16::from_f32);
/// let lit = Staged::new(mesh, |IntegerVertex { place, components: normal }| {
///     let light = normal[1] * y + normal[2] * z;
///     IntegerVertex::<Light> { place, components: Light::of_integer(light) }
/// });
/// assert_eq!(lit.vertices(), 3);
/// ```
///
/// # Cost
/// That of the stage, for each vertex that is transformed.
#[derive(Clone, Copy)]
pub struct Staged<M, F> {
    mesh: M,
    stage: F,
}

impl<M: Geometry, F> Staged<M, F> {
    /// A mesh of integers, and the stage behind its own; a mesh of floats does not compile.
    #[inline]
    pub const fn new<V: Varying>(mesh: M, stage: F) -> Self
    where
        F: Fn(IntegerVertex<M::Varying>) -> IntegerVertex<V>,
    {
        const { assert!(M::INTEGERS, "Staged: the mesh must be one of integers") };
        Self { mesh, stage }
    }
}

impl<M, F, V> Geometry for Staged<M, F>
where
    M: Geometry,
    F: Fn(IntegerVertex<M::Varying>) -> IntegerVertex<V>,
    V: Varying,
{
    type Varying = V;

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
    fn vertex(&self, number: usize) -> Option<(Point3<Object>, V)> {
        self.integers(number).map(|vertex| vertex.to_floats(self.unit()))
    }

    const INTEGERS: bool = true;

    #[inline]
    fn unit(&self) -> f32 {
        self.mesh.unit()
    }

    #[inline]
    fn integers(&self, number: usize) -> Option<IntegerVertex<V>> {
        self.mesh.integers(number).map(&self.stage)
    }

    const MESHLETS: bool = M::MESHLETS;

    #[inline]
    fn meshlet(&self, number: usize) -> Option<Meshlet> {
        self.mesh.meshlet(number)
    }

    #[inline]
    fn ball(&self) -> Ball {
        self.mesh.ball()
    }
}

impl<M: fmt::Debug, F> fmt::Debug for Staged<M, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Staged").field("mesh", &self.mesh).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::{Light, Lit565, Stored};
    use crate::{Affine, Camera, D16, Exact, FixedPoint, IntegerMesh, Pass, Rgb565Le, Rgba8, Target};
    use alberti_math::Q16;
    use alberti_math::glam::{Vec2, Vec3};
    use alberti_texture::format::Rgb565;
    use alberti_texture::{Nearest, Repeat, Texture};

    /// A place, a normal in 127ths, and texture coordinates.
    type Stored3 = ([i16; 3], [i8; 3], [u16; 2]);

    const VERTICES: [Stored3; 4] = [
        ([-900, -900, 0], [0, 0, 127], [0, 0]),
        ([900, -900, 200], [90, 0, 90], [60_000, 0]),
        ([900, 900, 0], [0, -90, 90], [60_000, 60_000]),
        ([-900, 900, -200], [-127, 0, 0], [0, 60_000]),
    ];

    fn normal(normal: [i8; 3]) -> [Q16; 3] {
        normal.map(|c| Q16::from_bits(i32::from(c) * 516))
    }

    fn light([_, y, z]: [Q16; 3]) -> [Q16; 1] {
        Light::of_integer(y * Q16::from_f32(0.6) + z * Q16::from_f32(0.8))
    }

    fn uv(uv: [u16; 2]) -> [Q16; 2] {
        uv.map(|c| Q16::from_bits(c.into()))
    }

    /// Two stages are as one that does both, in integers and in floats, and in the clipper.
    #[test]
    fn two_stages_are_one() {
        let triangles = [[0_u16, 1, 2], [0, 2, 3]];
        let carrying =
            IntegerMesh::new(&VERTICES, &triangles, 0.001, |&(place, n, at): &Stored3| IntegerVertex::<(
                Vec3,
                Vec2,
            )> {
                place,
                components: (normal(n), uv(at)),
            });
        let staged =
            Staged::new(carrying, |IntegerVertex { place, components: (normal, uv) }| IntegerVertex::<(
                Light,
                Vec2,
            )> {
                place,
                components: (light(normal), uv),
            });
        let at_once =
            IntegerMesh::new(&VERTICES, &triangles, 0.001, |&(place, n, at): &Stored3| IntegerVertex::<(
                Light,
                Vec2,
            )> {
                place,
                components: (light(normal(n)), uv(at)),
            });
        let texels = [0xffff_u16, 0x1234, 0xf800, 0x07e0];
        let texture = Texture::new(Rgb565, &texels, 2, 2).expect("2 x 2");
        let stage = Lit565 { surface: Stored(texture.sampler(Nearest, Repeat)) };
        let camera = Camera::look_at(Vec3::new(0.2, 0.1, 1.2), Vec3::ZERO, Vec3::Y).expect("a view");
        let view = camera.perspective(1.4, 1.1..4.0).expect("a lens");
        macro_rules! drawn {
            ($mesh:expr, $interpolation:expr) => {{
                let (mut color, mut depth) = (std::vec![0_u16; 64 * 48], std::vec![0_u16; 64 * 48]);
                let target = Target::new(Rgb565Le, D16, 64, 48, &mut color, &mut depth);
                let mut target = target.expect("buffers that fit");
                target.clear(Rgba8::BLACK);
                let mut pass = Pass::new(&view, $mesh, stage).interpolation($interpolation);
                let stats = pass.draw_counted(&mut target);
                assert!(stats.clipped > 0, "{stats:?}");
                color
            }};
        }
        assert!(drawn!(&staged, FixedPoint(Affine)) == drawn!(&at_once, FixedPoint(Affine)));
        let exact = drawn!(&staged, Exact);
        assert!(exact == drawn!(&at_once, Exact) && exact.iter().filter(|&&pixel| pixel != 0).count() > 500);
    }
}
