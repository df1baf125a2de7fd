//! A fog before any surface. Its distance is found at each fragment, from the place on the surface.

use super::Drawing;
use crate::options::Haze;
use alberti::Rgba8;
use alberti::glam::Vec3;
use alberti::lanes::Lanes;
use alberti::raster::color::AnyBlend;
use alberti::shaders::fog::{AnyFog, Fogged, LinearFog};

/// A fog: its coordinate is linear in space, and so in the place of a fragment.
#[derive(Clone, Copy)]
pub(super) struct Hazy {
    fogged: Fogged<(), AnyFog>,
    /// The gradient of the coordinate, and its value at the origin of the world.
    slope: Vec3,
    origin: f32,
}

impl Hazy {
    /// Colours at these places of the world behind the fog.
    #[inline(always)]
    pub(super) fn on<L: Lanes>(&self, lanes: L, place: [L::Number; 3], surface: L::U32) -> L::U32 {
        let mut coordinate = lanes.splat(self.origin);
        for (c, slope) in place.into_iter().zip(self.slope.to_array()) {
            coordinate = lanes.saturating_add(coordinate, lanes.saturating_mul(c, lanes.splat(slope)));
        }
        self.fogged.on(lanes, coordinate, surface)
    }
}

impl Drawing<'_> {
    /// The fog of the options, if they have one, before surfaces that are mixed so. What is added or multiplied fades
    /// into what changes nothing, as the fog is on what is behind it already.
    pub(super) fn hazy(&self, blend: AnyBlend) -> Option<Hazy> {
        let Haze { fog, color } = self.options.haze?;
        let [r, g, b] = match blend {
            AnyBlend::Additive => [0; 3],
            AnyBlend::Multiply => [255; 3],
            _ => color,
        };
        // A coordinate is `scale` times the distance from `start` on.
        let (scale, start) = match fog {
            AnyFog::Linear(LinearFog { start, end }) => (1.0 / (f64::from(end) - f64::from(start)), start),
            AnyFog::Exponential(fog) => (fog.density.into(), 0.0),
            AnyFog::Squared(fog) => (fog.density.into(), 0.0),
        };
        let forward = self.camera.axes().z_axis.as_dvec3();
        let eye = self.camera.origin().coords.as_dvec3();
        #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
        let origin = (-(forward.dot(eye) + f64::from(start)) * scale) as f32;
        let color = Rgba8::new(r, g, b, 255);
        Some(Hazy { fogged: Fogged { surface: (), fog, color }, slope: (forward * scale).as_vec3(), origin })
    }
}
