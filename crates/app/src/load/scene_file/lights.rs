//! Lights of a scene file.

use super::SceneFile;
use super::tables::{self, LightKind};
use crate::error::Error;
use crate::options::values::{Color, Intensity, Number, Place, Tuple};
use crate::scene::normals::{narrow, normalize, sub};
use crate::scene::{Glow, Light};

/// Degrees from a spot's axis up to which it is full, and from which there is none.
const ANGLE: [f32; 2] = [20.0, 30.0];

impl SceneFile {
    /// The lights, with their places counted from `origin`.
    ///
    /// # Errors
    /// A key is missing, or is none of that kind of light, or a direction is none.
    pub(super) fn lights(&self, origin: [f64; 3]) -> Result<Vec<Light>, Error> {
        let lights = self.file.light.iter().enumerate();
        lights.map(|(index, light)| self.light(light, &format!("light[{index}]"), origin)).collect()
    }

    /// The light from everywhere.
    pub(super) fn ambient(&self) -> Option<Glow> {
        self.file.ambient.as_ref().map(|ambient| glow(ambient.color, ambient.intensity))
    }

    fn light(&self, light: &tables::Light, path: &str, origin: [f64; 3]) -> Result<Light, Error> {
        let Some(kind) = light.kind else {
            return Err(self.source.error(path, "a light without kind", "directional, point or spot"));
        };
        for (key, has, what) in [
            ("angle", kind == LightKind::Spot, "a spot light"),
            ("range", kind != LightKind::Directional, "a point or spot light"),
            ("direction", kind != LightKind::Point, "a directional or spot light"),
            ("target", kind != LightKind::Point, "a directional or spot light"),
        ] {
            self.source.only(&format!("{path}.{key}"), has, what)?;
        }
        let color = glow(light.color, light.intensity);
        let range = light.range.map_or(f32::INFINITY, f32::from);
        let position = || match light.position {
            Some(position) => Ok(sub(position.into(), origin).map(narrow)),
            None => Err(self.source.error(path, "a light without position", "the point where it is")),
        };
        Ok(match kind {
            LightKind::Directional => {
                Light::Directional { to_light: self.direction(light, path)?.map(|x| -x), color }
            }
            LightKind::Point => Light::Point { position: position()?, color, range },
            LightKind::Spot => {
                let position = position()?;
                let [inner, outer] = light.angle.map_or(ANGLE, Into::into);
                if inner > outer {
                    let found = format!("{inner} and {outer} degrees");
                    return Err(self.source.error(&format!("{path}.angle"), found, "the inner angle first"));
                }
                Light::Spot { position, direction: self.direction(light, path)?, color, range, inner, outer }
            }
        })
    }

    /// From where the light is: its direction, or from its position to its target.
    fn direction(&self, light: &tables::Light, path: &str) -> Result<[f32; 3], Error> {
        let wide = |value: Tuple<3, Place>| <[f64; 3]>::from(value);
        let (along, key) = match (light.direction, light.position, light.target) {
            (Some(_), _, Some(_)) => {
                return Err(self.source.error(
                    &format!("{path}.target"),
                    "a target and a direction",
                    "one of both",
                ));
            }
            (Some(_), Some(_), None) if light.kind == Some(LightKind::Directional) => {
                let (place, found) = (format!("{path}.position"), "a position and a direction");
                return Err(self.source.error(&place, found, "one of both"));
            }
            (Some(direction), _, None) => (wide(direction), "direction"),
            (None, Some(from), Some(to)) => (sub(wide(to), wide(from)), "target"),
            (None, _, _) => {
                let found = "a light that points nowhere";
                return Err(self.source.error(path, found, "direction, or position and target"));
            }
        };
        let unit = normalize(along).ok_or_else(|| {
            let found = "no direction: all differences are 0";
            self.source.error(&format!("{path}.{key}"), found, "a direction other than 0")
        })?;
        Ok(unit.map(narrow))
    }
}

fn glow(color: Option<Color>, intensity: Option<Number<Intensity>>) -> Glow {
    let Color(color) = color.unwrap_or(Color([1.0; 3]));
    Glow { color, intensity: intensity.map_or(1.0, f32::from) }
}
