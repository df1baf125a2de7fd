//! Materials: what lights make of a surface, by the textbook's formulas, in f64.
//!
//! Cosines are quotients of dot products, and no vector is made unit on the way. Colours are numbers, 1 for a full
//! byte, and neither clamped nor rounded.

use crate::scene::Texture;
use crate::vec3::{Vec3, blend, dot, sub};

/// A light: what is `None` has no bearing.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Where it is, or else in which direction.
    pub at: Viewer,
    /// Red, green and blue.
    pub color: Vec3,
    /// For 1/(c + l d + q d²) at the distance d, of a light that is somewhere.
    pub falloff: [f64; 3],
    /// The axis of its cone, and the cosines within which it is whole, and beyond which there is none.
    pub cone: Option<(Vec3, [f64; 2])>,
}

/// A place, or a direction.
#[derive(Clone, Copy, Debug)]
pub enum Viewer {
    /// A place.
    At(Vec3),
    /// What is infinitely far in this direction.
    Towards(Vec3),
}

impl Viewer {
    /// Towards it, of any length.
    fn from(self, position: Vec3) -> Vec3 {
        match self {
            Self::At(place) => sub(place, position),
            Self::Towards(direction) => direction,
        }
    }
}

/// How a surface reflects; with the exponent.
#[derive(Clone, Copy, Debug)]
pub enum Model {
    /// No highlight.
    Lambert,
    /// The angle between the eye and the mirrored light.
    Phong(u32),
    /// The angle between the normal and the direction halfway between light and eye.
    Blinn(u32),
    /// That of Phong or of Blinn, times four times the cosine of the light's angle, at most 1.
    Soft(u32, Angle),
}

/// The angle that a highlight is of.
#[derive(Clone, Copy, Debug)]
pub enum Angle {
    /// As [`Model::Phong`] has it.
    Phong,
    /// As [`Model::Blinn`] has it.
    Blinn,
}

/// What a surface is at a point.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Where.
    pub position: Vec3,
    /// Of any length but zero.
    pub normal: Vec3,
    /// Scattered shares.
    pub diffuse: Vec3,
    /// Mirrored shares.
    pub specular: Vec3,
    /// What it sends out itself.
    pub emission: Vec3,
    /// The share of the ambient light that arrives.
    pub openness: f64,
}

/// A colour, and what its error is measured by.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The colour.
    pub color: Vec3,
    /// How much light arrives in the brightest channel, ambient light and emission included.
    pub light: f64,
    /// The least of what decides between light and none: |cosines|, and of Blinn's the length of l + v.
    pub margin: f64,
    /// The inverse of |l + v|, 1 or more.
    pub opposite: f64,
    /// How much light changes with the cosine at the edges of cones: 0 away from these.
    pub steepness: f64,
}

/// What is seen of a point.
#[must_use]
pub fn seen(point: &Point, lights: &[Light], ambient: Vec3, model: Model, viewer: Viewer) -> Seen {
    let (n, v) = (point.normal, viewer.from(point.position));
    let most = |color: Vec3| color.iter().fold(0.0, |most, c| f64::max(most, c.abs()));
    let mut seen = Seen {
        color: [0, 1, 2].map(|i| point.emission[i] + point.diffuse[i] * ambient[i] * point.openness),
        light: most(ambient) + most(point.emission),
        margin: 1.0,
        opposite: 1.0,
        steepness: 0.0,
    };
    for light in lights {
        let l = light.at.from(point.position);
        let facing = cosine(n, l);
        let [arriving, steepness] = share(light, l);
        let softened = if matches!(model, Model::Soft(..)) { (4.0 * facing).min(1.0) } else { 1.0 };
        let (highlight, sure) = match model {
            Model::Lambert => (0.0, 1.0),
            Model::Phong(exponent) | Model::Soft(exponent, Angle::Phong) => {
                // cos(r, v) of r = 2 (n·l) n − l, for unit vectors.
                let c = 2.0 * facing * cosine(n, v) - cosine(l, v);
                (power(c, exponent), c.abs())
            }
            Model::Blinn(exponent) | Model::Soft(exponent, Angle::Blinn) => {
                // (n·l + n·v)/|l + v|, and |l + v|² = 2 + 2 l·v.
                let length = (2.0 + 2.0 * cosine(l, v)).sqrt();
                let c = (facing + cosine(n, v)) / length;
                seen.opposite = seen.opposite.max(1.0 / length);
                (power(c, exponent), c.abs().min(length))
            }
        };
        seen.margin = seen.margin.min(facing.abs()).min(sure);
        seen.steepness = seen.steepness.max(steepness);
        seen.light += most(light.color) * arriving;
        if facing > 0.0 {
            for i in 0..3 {
                seen.color[i] += light.color[i]
                    * arriving
                    * (point.diffuse[i] * facing + point.specular[i] * highlight * softened);
            }
        }
    }
    seen
}

/// A cosine's power; 0 from behind, also for an exponent of 0.
fn power(cosine: f64, exponent: u32) -> f64 {
    if cosine > 0.0 { cosine.powf(f64::from(exponent)) } else { 0.0 }
}

/// How much of a light arrives at the end of a vector towards it, and how steep the edge of its cone is there.
fn share(light: &Light, l: Vec3) -> [f64; 2] {
    let Viewer::At(_) = light.at else { return [1.0, 0.0] };
    let [c, linear, quadratic] = light.falloff;
    let distance = dot(l, l).sqrt();
    let falloff = 1.0 / (c + distance * (linear + distance * quadratic));
    let Some((axis, [inner, outer])) = light.cone else { return [falloff, 0.0] };
    let inside = -cosine(l, axis) - outer;
    let edge = (-1e-6..inner - outer + 1e-6).contains(&inside);
    let steepness = if edge { 1.0 / (inner - outer) } else { 0.0 };
    [falloff * (inside / (inner - outer)).clamp(0.0, 1.0), steepness]
}

fn cosine(a: Vec3, b: Vec3) -> f64 {
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

/// The nearest texel of a texture that repeats, at any finite `uv`: (0, 0) is the lower left corner of the image.
#[must_use]
pub fn nearest(texture: &Texture<'_>, [u, v]: [f64; 2]) -> [u8; 4] {
    let index = |c: f64, side: u32| (c * f64::from(side)).floor().rem_euclid(f64::from(side)) as u32;
    let (column, row) = (index(u, texture.width), texture.height - 1 - index(v, texture.height));
    texture.texels[(row * texture.width + column) as usize]
}

/// Red, green and blue as numbers.
#[must_use]
pub fn numbers([r, g, b, _]: [u8; 4]) -> Vec3 {
    [r, g, b].map(|c| f64::from(c) / 255.0)
}

/// The normal of a texel in a frame: 2c − 1 for each channel, the first two times `strength`; of `two` channels the
/// third is what is left of length 1.
#[must_use]
pub fn mapped_normal(texel: [u8; 4], two: bool, strength: f64, axes: [Vec3; 3]) -> Vec3 {
    let [x, y, z] = numbers(texel).map(|c| 2.0 * c - 1.0);
    let z = if two { f64::max(1.0 - x * x - y * y, 0.0).sqrt() } else { z };
    blend([strength * x, strength * y, z], axes)
}

/// The share of its surroundings that a surface mirrors, by Schlick.
#[must_use]
pub fn schlick(facing: f64, normal: Vec3, to_viewer: Vec3) -> f64 {
    facing + (1.0 - facing) * (1.0 - cosine(normal, to_viewer).clamp(0.0, 1.0)).powi(5)
}

/// The amount of light of sRGB, by IEC 61966-2-1, for each channel from 0 to 1.
#[must_use]
pub fn light(color: Vec3) -> Vec3 {
    color.map(|s| if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) })
}

/// What a screen shows of amounts of light, as sRGB from 0 to 1: beyond a brightest channel of 0.8, compressed and
/// paler, as Khronos' neutral tone mapper has it.
#[must_use]
pub fn on_screen(light: Vec3) -> Vec3 {
    let peak = light.into_iter().fold(0.0, f64::max);
    let mapped = if peak > 0.8 {
        // The hyperbola that goes on from the line of slope 1 at 0.8, and comes near to 1.
        let new = 0.8 + (peak - 0.8) * 0.2 / (0.2 + (peak - 0.8));
        let own = 1.0 / (0.15 * (peak - new) + 1.0);
        light.map(|c| own * c * (new / peak) + (1.0 - own) * new)
    } else {
        light
    };
    mapped.map(|c| if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_sends_the_whole_light_to_the_eye() {
        let point = Point {
            position: [0.0; 3],
            normal: [0.0, 0.0, 7.0],
            diffuse: [0.0; 3],
            specular: [0.5; 3],
            emission: [0.25, 0.0, 0.0],
            openness: 1.0,
        };
        let light = |x| Light {
            at: Viewer::At([x, 0.0, 2.0]),
            color: [1.0, 2.0, 4.0],
            falloff: [0.0, 0.0, 0.125],
            cone: None,
        };
        let viewer = Viewer::Towards([1.0, 0.0, 1.0]);
        for model in [Model::Phong(40), Model::Blinn(40)] {
            let Seen { color, .. } = seen(&point, &[light(-2.0)], [9.0; 3], model, viewer);
            for (found, expected) in color.into_iter().zip([0.75, 1.0, 2.0]) {
                assert!((found - expected).abs() < 1e-9, "{color:?}");
            }
            let [_, aside, _] = seen(&point, &[light(2.0)], [9.0; 3], model, viewer).color;
            assert!(aside < 0.01, "{aside}");
        }
    }
}
