//! Light by vertex.

use super::{alone, pack, unpack};
use alberti_math::glam::Vec3;
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Varying};
use alberti_raster::{FragmentStage, Gradient};

/// Another stage's colour under lights that are interpolated between vertices:
/// colour · diffuse + specular · mirrored.
///
/// The varying is (diffuse, (mirrored, the wrapped stage's)): the two that
/// [`Lighting::at_vertex`](super::material::Lighting::at_vertex) gives.
///
/// Source: Gouraud, "Continuous shading of curved surfaces", IEEE Transactions on Computers 20 (1971).
///
/// # Precision
/// Within 0.51 of a byte of the formula, from the wrapped stage's bytes. Highlights smaller than triangles are lost, or
/// flicker as their vertices turn; [`Material`](super::material::Material) lights each fragment.
///
/// # Cost
/// Six components to interpolate, six multiplications and additions and a rounding for each channel; no root and no
/// division.
#[derive(Clone, Copy, Debug)]
pub struct Gouraud<S> {
    /// What is lit.
    pub surface: S,
    /// The specular colour.
    pub specular: Rgba8,
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> FragmentStage<(Vec3, (Vec3, V))> for Gouraud<S> {
    type Color = Rgba8;
    type Derivatives = S::Derivatives;

    #[inline(always)]
    fn shade(&self, varying: (Vec3, (Vec3, V))) -> Option<Rgba8> {
        alone(self, varying)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        (diffuse, (mirrored, varyings)): &([L::Number; 3], ([L::Number; 3], V::Of<L::Number>)),
        gradient: &Gradient<([L::Number; 3], ([L::Number; 3], V::Of<L::Number>))>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let gradient = gradient.map(|(_, (_, of_surface))| of_surface);
        let (surface, mask) = self.surface.shade_lanes(lanes, varyings, &gradient, mask);
        let [r, g, b, a] = unpack(lanes, surface);
        let specular = self.specular.to_bytes();
        let channel = |own: L::U32, k: usize| {
            let shine = lanes.splat(specular[k].into()) * mirrored[k];
            lanes.nearest_byte(lanes.to_numbers(own) * diffuse[k] + shine)
        };
        (pack(lanes, [channel(r, 0), channel(g, 1), channel(b, 2), a]), mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;

    #[test]
    fn light_multiplies_and_shine_is_added() {
        let stage =
            Gouraud { surface: Solid(Rgba8::new(200, 100, 50, 7)), specular: Rgba8::new(100, 255, 0, 0) };
        let shade =
            |diffuse, mirrored| stage.shade((diffuse, (mirrored, ()))).expect("never discards").to_bytes();
        assert_eq!(shade(Vec3::splat(0.5), Vec3::ZERO), [100, 50, 25, 7]);
        assert_eq!(shade(Vec3::new(1.0, 0.1, 2.0), Vec3::new(0.1, 0.2, 0.3)), [210, 61, 100, 7]);
        assert_eq!(shade(Vec3::splat(9.0), Vec3::ONE), [255, 255, 255, 7]);
    }
}
