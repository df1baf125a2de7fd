//! Lights, environments and parallax maps whose kind is chosen at run time.

use super::AMBIENT;
use super::studio::Rig;
use crate::options::{Projection, RenderOptions};
use crate::scene::{self, Camera, EnvironmentKind, Glow, Image, Model};
use alberti::glam::Vec3;
use alberti::shaders::material::{AnyLight, Directional, PointLight, SpotLight, Viewer};
use alberti::texture::environment::{AnyEnvironment, CubeMap, SphereMap, Turned};
use alberti::texture::surface::AnyParallax;
use alberti::{Eye, Frame, Point3, Vector3, World};

/// The lighting of a picture's surfaces, and their viewer.
#[derive(Clone, Debug)]
pub(crate) struct Lamps {
    pub(super) ambient: Vec3,
    pub(super) lights: Vec<AnyLight>,
    pub(super) viewer: Viewer,
}

impl Lamps {
    /// The lighting of a model, or else of a rig.
    pub(super) fn new(model: &Model, camera: &Camera, options: &RenderOptions, rig: &Rig) -> Self {
        let amount =
            |glow: Glow| Vec3::from_array(glow.factors(options.in_linear_light())) * options.light.brightness;
        let lights: Vec<AnyLight> = model.lights.iter().map(|light| lamp(light, &amount)).collect();
        let own = lights.is_empty() && model.ambient.is_none();
        let beside = |(to_light, strength)| {
            AnyLight::Directional(Directional::new(Vector3::new(to_light), Vec3::splat(strength)))
        };
        let ambient = model.ambient.unwrap_or(Glow { color: [AMBIENT; 3], intensity: 1.0 });
        let [eye, target] = [camera.eye, camera.target].map(Vec3::from_array);
        Self {
            ambient: if own { Vec3::splat(rig.ambient) } else { amount(ambient) },
            lights: if own { rig.shining().map(beside).collect() } else { lights },
            viewer: if options.projection != Projection::Perspective {
                Viewer::towards(Vector3::new(eye - target))
            } else {
                Viewer::at(Point3::new(eye))
            },
        }
    }
}

/// A model's light.
fn lamp(light: &scene::Light, amount: &dyn Fn(Glow) -> Vec3) -> AnyLight {
    let point = |position: [f32; 3], color: Glow, range: f32| PointLight {
        position: Point3::new(Vec3::from_array(position)),
        color: amount(color),
        falloff: [1.0, 0.0, 1.0 / (range * range)],
    };
    match *light {
        scene::Light::Directional { to_light, color } => {
            let to_light = Vector3::new(Vec3::from_array(to_light));
            AnyLight::Directional(Directional::new(to_light, amount(color)))
        }
        scene::Light::Point { position, color, range } => AnyLight::Point(point(position, color, range)),
        scene::Light::Spot { position, direction, color, range, inner, outer } => {
            let axis = Vector3::new(Vec3::from_array(direction));
            let cosines = [inner, outer].map(|angle| angle.to_radians().cos());
            AnyLight::Spot(SpotLight::new(point(position, color, range), axis, cosines))
        }
    }
}

/// The layers in which steep heights are searched: as many as show the technique, terraces and all.
const STEEP_LAYERS: u32 = 16;

/// The layers between which a line is drawn: as many as hide them, with an error that is a quarter with twice as many.
const OCCLUSION_LAYERS: u32 = 32;

/// The search of a parallax map, if heights are one.
pub(super) fn parallax(relief: scene::Relief) -> Option<AnyParallax> {
    match relief {
        scene::Relief::Bump | scene::Relief::Displacement => None,
        scene::Relief::Parallax => Some(AnyParallax::Offset),
        scene::Relief::ParallaxLimited => Some(AnyParallax::Limited),
        scene::Relief::Steep => Some(AnyParallax::Steep { layers: STEEP_LAYERS }),
        scene::Relief::Occlusion => Some(AnyParallax::Occlusion { layers: OCCLUSION_LAYERS }),
    }
}

/// The layout of an image of all directions, for a camera that stands so.
pub(super) fn environment(kind: EnvironmentKind, image: &Image, camera: Frame<Eye, World>) -> AnyEnvironment {
    match kind {
        EnvironmentKind::LatLong => AnyEnvironment::LatLong,
        EnvironmentKind::Cube => AnyEnvironment::CubeMap(CubeMap { side: image.width }),
        EnvironmentKind::Sphere => {
            AnyEnvironment::SphereMap(Turned { environment: SphereMap, axes: camera.axes() })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti::glam::Vec2;
    use alberti::texture::surface::Relief;

    /// The place that is read for (0, 0), on a plain half a unit above the surface, seen at a slant of 3.
    fn shift(relief: scene::Relief) -> Option<Vec2> {
        let plain = Relief { map: |_: Vec2| 0.5, low: 0.0, high: 1.0, extent: Vec2::ONE };
        let view = Vector3::new(Vec3::new(3.0, 0.0, 1.0));
        parallax(relief).map(|policy| plain.parallax(policy, Vec2::ZERO, view))
    }

    #[test]
    fn each_relief_is_the_policy_of_its_name() {
        use scene::Relief::{Bump, Displacement, Occlusion, Parallax, ParallaxLimited, Steep};
        // h Vx/Vz, and h Vx of the unit vector V.
        let (offset, limited) = (1.5, 0.5 * 3.0 / 10.0_f32.sqrt());
        for (relief, wanted) in
            [(Parallax, offset), (ParallaxLimited, limited), (Steep, offset), (Occlusion, offset)]
        {
            let found = shift(relief).unwrap();
            assert!((found.x - wanted).abs() < 1e-5 && found.y.abs() <= 0.0, "{relief:?} {found}");
        }
        assert_eq!([Bump, Displacement].map(shift), [None; 2]);
    }
}
