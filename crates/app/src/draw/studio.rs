//! The light of a model that has none: one lamp, or a key light with two that make shapes plain.

use super::{AMBIENT, DIFFUSE, frame};
use crate::options::{KeyLight, RenderOptions};
use crate::scene::Camera;
use alberti::glam::{Mat3, Vec3};
use alberti::lanes::Lanes;
use alberti::shaders::{Sunlit, Unlit};
use alberti::{FragmentStage, Fragments, Rgba8, Varying, Vector3};

/// Light that falls everywhere, and white lights, each a unit vector towards it and its strength.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rig {
    pub(crate) ambient: f32,
    /// The key light, which counts alone where the others have no strength; fill light, and rim light.
    pub(crate) lights: [(Vec3, f32); 3],
}

/// Light from everywhere, from the key light, from the other side, and from behind. They are weaker where a
/// surface would get more than 1.
const STUDIO: (f32, [f32; 3]) = (0.2, [0.7, 0.22, 0.2]);

/// The same in amounts of light, of which less makes a byte in the shade.
const LINEAR_STUDIO: (f32, [f32; 3]) = (0.06, [0.8, 0.14, 0.25]);

/// The lamp in amounts of light, with the ambient light.
const LINEAR_LAMP: [f32; 2] = [0.08, 0.92];

/// The directions of fill and rim light: degrees to the right of the key light, and above the horizon.
const BESIDE: [[f32; 2]; 2] = [[85.0, 5.0], [190.0, 35.0]];

impl Rig {
    /// That of a camera.
    pub(super) fn new(camera: &Camera, options: &RenderOptions) -> Self {
        let Self { ambient, lights } = Self::of(camera, options.light.key, options.in_linear_light());
        let factor = options.light.brightness;
        Self { ambient: ambient * factor, lights: lights.map(|(to, strength)| (to, strength * factor)) }
    }

    fn of(camera: &Camera, key: KeyLight, linear: bool) -> Self {
        let none = (Vec3::Y, 0.0);
        let KeyLight::Studio([azimuth, elevation]) = key else {
            let [ambient, lamp] = if linear { LINEAR_LAMP } else { [AMBIENT, DIFFUSE] };
            return Self { ambient, lights: [(super::to_light(camera), lamp), none, none] };
        };
        // Lights stay where they are when the camera leans.
        let camera = camera.upright();
        let axes = frame(&camera).ok().map(|frame| level(&camera, frame.axes()));
        let towards = |azimuth: f32, elevation: f32| {
            let ((right, near), (up, level)) =
                (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
            let to_light = Vec3::new(right * level, up, -near * level);
            axes.map_or(Vec3::Y, |axes| (axes * to_light).normalize())
        };
        let (ambient, [main, fill, rim]) = if linear { LINEAR_STUDIO } else { STUDIO };
        let [[a, b], [c, d]] = BESIDE;
        let to_lights = [towards(azimuth, elevation), towards(azimuth + a, b), towards(azimuth + c, d)];
        // The most that a surface gets is the longest sum of some of the vectors.
        let sum = |subset: u32| {
            let vectors = to_lights.into_iter().zip([main, fill, rim]).zip(0..);
            vectors
                .filter(|(_, k)| subset >> k & 1 != 0)
                .map(|((to, strength), _)| to * strength)
                .sum::<Vec3>()
        };
        let most = (1..8).map(|subset| sum(subset).length()).fold(0.0, f32::max);
        let share = ((1.0 - ambient) / most).min(1.0);
        Self { ambient, lights: [0, 1, 2].map(|k| (to_lights[k], [main, fill, rim][k] * share)) }
    }

    /// The lights that have some strength.
    pub(crate) fn shining(&self) -> impl Iterator<Item = (Vec3, f32)> {
        self.lights.into_iter().filter(|&(_, strength)| strength > 0.0)
    }
}

/// The axes of a camera, turned to the horizon where it looks down: lights above it would leave the walls in the dark.
fn level(camera: &Camera, axes: Mat3) -> Mat3 {
    let up = Vec3::from_array(camera.up).normalize_or(axes.y_axis);
    if axes.z_axis.dot(up) >= 0.0 {
        return axes;
    }
    // Right is across the upward direction already.
    let ahead = axes.x_axis.cross(up);
    let ahead = if axes.x_axis.cross(axes.y_axis).dot(axes.z_axis) < 0.0 { -ahead } else { ahead };
    Mat3::from_cols(axes.x_axis, up, ahead)
}

/// A map in the light of a rig. Of one lamp it is the library's [`Sunlit`], to the bit.
#[derive(Clone, Copy)]
pub(super) struct Lamplit<M> {
    lamp: Sunlit<Unlit<M>>,
    map: Unlit<M>,
    rig: Rig,
    /// Whether there is more than one lamp.
    more: bool,
}

impl<M: Copy> Lamplit<M> {
    pub(super) fn new(map: M, rig: Rig) -> Self {
        let (to_light, strength) = rig.lights[0];
        let lamp = Sunlit::new(Unlit(map), Vector3::new(to_light), rig.ambient, strength);
        Self { lamp, map: Unlit(map), rig, more: rig.shining().count() > 1 }
    }

    /// The factor for the colours of a surface with this normal.
    #[inline(always)]
    pub(super) fn light<L: Lanes>(&self, lanes: L, normal: [L::Number; 3]) -> L::Number {
        if self.more { self.sum(lanes, normal) } else { self.lamp.light(lanes, normal) }
    }

    /// The same of three lights: ambient + Σ strength · max(0, n·l).
    #[inline(always)]
    fn sum<L: Lanes>(&self, lanes: L, [x, y, z]: [L::Number; 3]) -> L::Number {
        let zero = lanes.splat(0.0);
        let mut sum = zero;
        for (to_light, strength) in self.rig.lights {
            let Vec3 { x: lx, y: ly, z: lz } = to_light * strength;
            let along = x * lanes.splat(lx) + y * lanes.splat(ly) + z * lanes.splat(lz);
            sum = sum + lanes.max(along, zero);
        }
        // All are divided by the normal's length at once. As in `Sunlit`, one without a direction takes none.
        let arriving = sum / lanes.sqrt(x * x + y * y + z * z);
        lanes.splat(self.rig.ambient) + lanes.select(lanes.less(zero, sum), arriving, zero)
    }
}

impl<V: Varying, M: Copy> FragmentStage<(Vec3, V)> for Lamplit<M>
where
    Unlit<M>: FragmentStage<V, Color = Rgba8>,
{
    type Color = Rgba8;
    type Derivatives = <Unlit<M> as FragmentStage<V>>::Derivatives;
    const WIDE: bool = <Unlit<M> as FragmentStage<V>>::WIDE;

    fn derivatives(&self) -> Self::Derivatives {
        self.map.derivatives()
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (Vec3, V)>) -> (L::U32, L::Mask) {
        if !self.more {
            return self.lamp.shade(fragments);
        }
        let (lanes, (normal, _)) = (fragments.lanes, fragments.varying);
        let (color, mask) = self.map.shade(&fragments.part(|(_, varying)| *varying));
        let light = self.sum(lanes, normal);
        let [red, green, blue] =
            [lit(lanes, color, 0, light), lit(lanes, color, 8, light), lit(lanes, color, 16, light)];
        (red | green | blue | (color & lanes.word(0xff00_0000)), mask)
    }
}

/// The channel at that bit of a colour, times the light.
#[inline(always)]
fn lit<L: Lanes>(lanes: L, color: L::U32, shift: u32, light: L::Number) -> L::U32 {
    let channel = lanes.to_numbers(lanes.shr(color, shift) & lanes.word(255));
    lanes.shl(lanes.nearest_byte(channel * light), shift)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Camera = Camera {
        eye: [0.0, 0.0, 5.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 40.0,
        near: 1.0,
        far: 9.0,
    };

    fn light(rig: &Rig, normal: Vec3) -> f32 {
        rig.shining()
            .fold(rig.ambient, |sum, (to_light, strength)| sum + strength * normal.dot(to_light).max(0.0))
    }

    /// Whatever is white stays below white, and no side is as dark as the ambient light but from below and behind.
    #[test]
    fn nothing_is_clipped() {
        for key in [
            KeyLight::Lamp,
            KeyLight::STUDIO,
            KeyLight::Studio([120.0, -20.0]),
            KeyLight::Studio([0.0, 90.0]),
        ] {
            let rigs = [false, true].map(|linear| Rig::of(&CAMERA, key, linear));
            let mut most = [0.0_f32; 2];
            for k in 0..20_000_u16 {
                let (z, turn) = (f32::from(k) / 10_000.0 - 1.0, f32::from(k) * 2.399_963);
                let around = (1.0 - z * z).max(0.0).sqrt();
                let normal = Vec3::new(around * turn.cos(), around * turn.sin(), z);
                for (most, rig) in most.iter_mut().zip(&rigs) {
                    *most = most.max(light(rig, normal));
                }
            }
            assert!(most.iter().all(|most| (0.85..1.000_01).contains(most)), "{key:?} {most:?}");
        }
    }

    /// The sides of a box that a camera sees from a corner differ by a tenth of white at least.
    #[test]
    fn the_sides_of_a_box_differ() {
        // However high the camera is.
        for height in [0.5, 2.25, 6.0, 20.0] {
            let camera = Camera { eye: [3.0, height, 5.0], ..CAMERA };
            let rig = Rig::of(&camera, KeyLight::STUDIO, false);
            let [right, top, front] = [Vec3::X, Vec3::Y, Vec3::Z].map(|normal| light(&rig, normal));
            for (a, b) in [(right, top), (top, front), (front, right)] {
                assert!((a - b).abs() > 0.1, "{right} {top} {front}");
            }
            assert!(right.min(front) > 0.35, "{right} {front}");
        }
    }

    /// Lights stay where they are when a camera leans, or comes to look straight down.
    #[test]
    fn lights_are_those_of_the_level_camera() {
        let directions =
            |camera: Camera| Rig::of(&camera, KeyLight::STUDIO, false).lights.map(|(to_light, _)| to_light);
        let down = Camera { eye: [0.0, 5.0, 0.0], roll: -40.0, ..CAMERA };
        let (sin, cos) = 40.0_f32.to_radians().sin_cos();
        let nearly = Camera { eye: [0.01 * sin, 5.0, 0.01 * cos], ..CAMERA };
        for (one, other) in [
            (CAMERA, Camera { roll: 77.0, ..CAMERA }),
            (
                Camera { eye: [1.0, -3.0, 5.0], ..CAMERA },
                Camera { eye: [1.0, -3.0, 5.0], roll: -20.0, ..CAMERA },
            ),
            (nearly, down),
        ] {
            for (a, b) in directions(one).into_iter().zip(directions(other)) {
                assert!((a - b).length() < 1e-4, "{a} {b} {other:?}");
            }
        }
    }

    /// A stage of one sample, and of a key light in the direction that is asked for.
    #[test]
    fn fragments_get_the_sum() {
        let rig = Rig::of(&CAMERA, KeyLight::Studio([90.0, 0.0]), false);
        assert!((rig.lights[0].0 - Vec3::X).length() < 1e-6);
        for rig in [rig, Rig::of(&CAMERA, KeyLight::Lamp, false)] {
            let stage = Lamplit::new(Rgba8::new(200, 100, 50, 77), rig);
            for normal in [Vec3::X, Vec3::new(0.3, 3.0, -0.5), Vec3::new(-1.0, 0.2, 0.4)] {
                let expected = light(&rig, normal.normalize());
                let color =
                    stage.shade_one((normal, alberti::glam::Vec2::ZERO)).expect("a colour").to_bytes();
                for (found, of) in color.into_iter().zip([200.0, 100.0, 50.0]) {
                    assert!((f32::from(found) - of * expected).abs() < 0.51, "{color:?} {expected}");
                }
                assert_eq!(color[3], 77);
            }
        }
    }
}
