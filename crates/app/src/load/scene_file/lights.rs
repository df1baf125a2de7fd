//! Lights of a scene file.

use std::ops::Range;

use super::tables::{self, At, LightKind};
use super::values::{Numbers, Place, Text};
use super::{SceneFile, named};
use crate::error::Error;
use crate::scene::normals::{narrow, normalize, sub};
use crate::scene::{Light, shares};

/// Degrees from a spot's axis up to which it is full, and from which there is none.
const ANGLE: [f32; 2] = [20.0, 30.0];

impl SceneFile {
    /// The lights.
    ///
    /// # Errors
    /// A key is missing, or is none of that kind of light, or a direction is none.
    pub(super) fn lights(&self) -> Result<Vec<Light>, Error> {
        self.file.light.iter().map(|light| self.light(light.get_ref(), &light.span())).collect()
    }

    /// The light from everywhere.
    pub(super) fn ambient(&self) -> Option<[f32; 3]> {
        let tables::Ambient { color, intensity } = self.file.ambient.as_ref()?;
        Some(factors(color.as_ref(), intensity.as_ref().map(|n| n.get_ref().0)))
    }

    fn light(&self, light: &tables::Light, at: &Range<usize>) -> Result<Light, Error> {
        let Some(kind) = &light.kind else {
            return Err(self.source.error(at, "a light without kind", "directional, point or spot"));
        };
        let kind = named(kind.get_ref());
        let of = |kinds: &str| format!("a {kinds} light");
        let spot = kind == LightKind::Spot;
        self.only(&light.angle, spot, &of("spot"))?;
        self.only(&light.range, kind != LightKind::Directional, &of("point or spot"))?;
        self.only(&light.direction, kind != LightKind::Point, &of("directional or spot"))?;
        self.only(&light.target, kind != LightKind::Point, &of("directional or spot"))?;
        let color = factors(light.color.as_ref(), light.intensity.as_ref().map(|n| n.get_ref().0));
        let range = light.range.as_ref().map_or(f32::INFINITY, |range| range.get_ref().0);
        let position = || match &light.position {
            Some(position) => Ok(position.get_ref().0),
            None => Err(self.source.error(at, "a light without position", "the point where it is")),
        };
        Ok(match kind {
            LightKind::Directional => {
                Light::Directional { to_light: self.direction(light, at)?.map(|x| -x), color }
            }
            LightKind::Point => Light::Point { position: position()?, color, range },
            LightKind::Spot => {
                let position = position()?;
                let [inner, outer] = light.angle.as_ref().map_or(ANGLE, |angle| angle.get_ref().0);
                if let (true, Some(angle)) = (inner > outer, &light.angle) {
                    let found = format!("{inner} and {outer} degrees");
                    return Err(self.source.error(&angle.span(), found, "the inner angle first"));
                }
                Light::Spot { position, direction: self.direction(light, at)?, color, range, inner, outer }
            }
        })
    }

    /// From where the light is: its direction, or from its position to its target.
    fn direction(&self, light: &tables::Light, at: &Range<usize>) -> Result<[f32; 3], Error> {
        let wide =
            |value: &At<Numbers<3, Place>>| value.as_ref().map(|p| (p.get_ref().0.map(f64::from), p.span()));
        let (along, place) = match (wide(&light.direction), wide(&light.position), wide(&light.target)) {
            (Some(_), _, Some((_, at))) => {
                return Err(self.source.error(&at, "a target and a direction", "one of both"));
            }
            (Some((direction, at)), _, None) => (direction, at),
            (None, Some((from, _)), Some((to, at))) => (sub(to, from), at),
            (None, _, _) => {
                let found = "a light that points nowhere";
                return Err(self.source.error(at, found, "direction, or position and target"));
            }
        };
        let unit = normalize(along).ok_or_else(|| {
            self.source.error(&place, "no direction: all differences are 0", "a direction other than 0")
        })?;
        Ok(unit.map(narrow))
    }

    /// A key that this kind has no use for is a mistake.
    pub(super) fn only<T>(&self, value: &At<T>, has: bool, what: &str) -> Result<(), Error> {
        match value {
            Some(value) if !has => Err(self.source.error(&value.span(), "a key that has no use here", what)),
            _ => Ok(()),
        }
    }
}

fn factors(color: Option<&toml::Spanned<Text<[u8; 3]>>>, intensity: Option<f32>) -> [f32; 3] {
    let color = color.map_or([1.0; 3], |color| shares(color.get_ref().0));
    color.map(|share| share * intensity.unwrap_or(1.0))
}
