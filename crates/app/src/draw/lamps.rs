//! Lights, reflectances, environments and parallax maps whose kind is chosen at run time.

use super::{AMBIENT, DIFFUSE};
use crate::scene::{self, Camera, EnvironmentKind, Image, Model};
use alberti::glam::Vec3;
use alberti::lanes::Lanes;
use alberti::shaders::material::{
    BlinnPhong, Directional, Lambert, Light, Phong, PointLight, Reflectance, SpotLight, Viewer,
};
use alberti::texture::environment::{CubeMap, Environment, LatLong, SphereMap, Turned};
use alberti::texture::surface::{
    HeightMap, LimitedParallax, OffsetParallax, ParallaxOcclusion, ParallaxSearch, Relief, SteepParallax,
};
use alberti::{Eye, Frame, Point3, Vector3, World};

/// The lighting of a picture's surfaces, and their viewer.
#[derive(Clone, Debug)]
pub(crate) struct Lamps {
    pub(super) ambient: Vec3,
    pub(super) lights: Vec<Lamp>,
    pub(super) viewer: Viewer,
}

impl Lamps {
    /// The lighting of a model, or else light from the direction `to_light`.
    pub(super) fn new(model: &Model, camera: &Camera, parallel: bool, to_light: Vec3) -> Self {
        let lights: Vec<Lamp> = model.lights.iter().map(Lamp::new).collect();
        let own = lights.is_empty() && model.ambient.is_none();
        let beside = Lamp::Directional(Directional::new(Vector3::new(to_light), Vec3::splat(DIFFUSE)));
        let [eye, target] = [camera.eye, camera.target].map(Vec3::from_array);
        Self {
            ambient: model.ambient.map_or(Vec3::splat(AMBIENT), Vec3::from_array),
            lights: if own { vec![beside] } else { lights },
            viewer: if parallel {
                Viewer::towards(Vector3::new(eye - target))
            } else {
                Viewer::at(Point3::new(eye))
            },
        }
    }
}

/// A light of any kind.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lamp {
    Directional(Directional),
    Point(PointLight),
    Spot(SpotLight),
}

impl Lamp {
    fn new(light: &scene::Light) -> Self {
        let point = |position: [f32; 3], color: [f32; 3], range: f32| PointLight {
            position: Point3::new(Vec3::from_array(position)),
            color: Vec3::from_array(color),
            falloff: [1.0, 0.0, 1.0 / (range * range)],
        };
        match *light {
            scene::Light::Directional { to_light, color } => {
                let to_light = Vector3::new(Vec3::from_array(to_light));
                Self::Directional(Directional::new(to_light, Vec3::from_array(color)))
            }
            scene::Light::Point { position, color, range } => Self::Point(point(position, color, range)),
            scene::Light::Spot { position, direction, color, range, inner, outer } => {
                let axis = Vector3::new(Vec3::from_array(direction));
                let cosines = [inner, outer].map(|angle| angle.to_radians().cos());
                Self::Spot(SpotLight::new(point(position, color, range), axis, cosines))
            }
        }
    }
}

/// An expression over a value of any kind.
macro_rules! of_kind {
    ($this:expr, $kind:ident: $($name:ident)+, |$it:ident| $body:expr) => {
        match $this {
            $($kind::$name($it) => $body,)+
        }
    };
}

impl Light for Lamp {
    #[inline(always)]
    fn fold<L: Lanes, T>(
        &self,
        lanes: L,
        position: [L::Number; 3],
        sum: T,
        and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
    ) -> T {
        of_kind!(self, Self: Directional Point Spot, |light| light.fold(lanes, position, sum, and))
    }
}

/// A reflectance of any kind.
#[derive(Clone, Copy, Debug)]
pub(super) enum AnyReflectance {
    Lambert(Lambert),
    Phong(Phong<[u32; 2]>),
    Blinn(BlinnPhong<[u32; 2]>),
}

impl Reflectance for AnyReflectance {
    #[inline(always)]
    fn shares<L: Lanes>(
        &self,
        lanes: L,
        normal: [L::Number; 3],
        to_light: [L::Number; 3],
        to_viewer: [L::Number; 3],
        gloss: L::Number,
    ) -> [L::Number; 2] {
        of_kind!(self, Self: Lambert Phong Blinn, |it| it.shares(lanes, normal, to_light, to_viewer, gloss))
    }
}

/// A way of reading a parallax map.
#[derive(Clone, Copy, Debug)]
pub(super) enum AnyParallax {
    Offset(OffsetParallax),
    Limited(LimitedParallax),
    Steep(SteepParallax),
    Occlusion(ParallaxOcclusion),
}

/// The layers in which steep heights are searched: as many as show the technique, terraces and all.
const STEEP_LAYERS: u32 = 16;

/// The layers between which a line is drawn: as many as hide them, with an error that is a quarter with twice as many.
const OCCLUSION_LAYERS: u32 = 32;

impl AnyParallax {
    /// The search for a relief, if that is a parallax map.
    pub(super) fn of(relief: scene::Relief) -> Option<Self> {
        match relief {
            scene::Relief::Bump | scene::Relief::Displacement => None,
            scene::Relief::Parallax => Some(Self::Offset(OffsetParallax)),
            scene::Relief::ParallaxLimited => Some(Self::Limited(LimitedParallax)),
            scene::Relief::Steep => Some(Self::Steep(SteepParallax { layers: STEEP_LAYERS })),
            scene::Relief::Occlusion => Some(Self::Occlusion(ParallaxOcclusion { layers: OCCLUSION_LAYERS })),
        }
    }
}

impl ParallaxSearch for AnyParallax {
    #[inline(always)]
    fn meet<H: HeightMap, L: Lanes>(
        self,
        lanes: L,
        relief: &Relief<H>,
        uv: [L::Number; 2],
        slant: [L::Number; 2],
    ) -> [L::Number; 2] {
        of_kind!(self, Self: Offset Limited Steep Occlusion, |policy| policy.meet(lanes, relief, uv, slant))
    }
}

/// The layout of an image of all directions.
#[derive(Clone, Copy, Debug)]
pub(super) enum AnyEnvironment {
    LatLong(Upright),
    Cube(CubeMap),
    Sphere(Turned<SphereMap>),
}

impl AnyEnvironment {
    /// The layout of this image, for a camera that stands so.
    pub(super) fn new(kind: EnvironmentKind, image: &Image, camera: Frame<Eye, World>) -> Self {
        match kind {
            EnvironmentKind::LatLong => Self::LatLong(Upright { rows: image.height }),
            EnvironmentKind::Cube => Self::Cube(CubeMap { side: image.width }),
            EnvironmentKind::Sphere => Self::Sphere(Turned { environment: SphereMap, axes: camera.axes() }),
        }
    }
}

impl Environment for AnyEnvironment {
    #[inline(always)]
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2] {
        of_kind!(self, Self: LatLong Cube Sphere, |environment| environment.place(lanes, direction))
    }
}

/// [`LatLong`] for images that repeat in both directions: the poles stay in their rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Upright {
    rows: u32,
}

impl Environment for Upright {
    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2] {
        let [u, v] = LatLong.place(lanes, direction);
        let half = 0.5 / self.rows.max(1) as f32;
        [u, lanes.min(lanes.max(v, lanes.splat(half)), lanes.splat(1.0 - half))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti::glam::Vec2;

    /// Where the place (0, 0) is looked up, on a plain half a unit above the surface, seen at a slant of 3.
    fn shift(relief: scene::Relief) -> Option<Vec2> {
        let plain = Relief { map: |_: Vec2| 0.5, low: 0.0, high: 1.0, extent: Vec2::ONE };
        let view = Vector3::new(Vec3::new(3.0, 0.0, 1.0));
        AnyParallax::of(relief).map(|policy| plain.parallax(policy, Vec2::ZERO, view))
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
