//! A material as an MTL file says it, and as it is drawn.

use crate::error::Error;
use crate::load::images::{DIELECTRIC, Images, Mirroring};
use crate::options::values::{Color, MAX_SHININESS, Shininess};
use crate::options::{MapFile, Material, byte};
use crate::scene::{Detail, Map, MaterialNote, Part};
use alberti::raster::color::AnyBlend;

/// The greatest exponent of a roughness map without a `Pr`.
const POLISHED: f32 = 256.0;

/// A material of a library.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Entry {
    /// Its name.
    pub(crate) name: String,
    /// The lines that say what a scene file can say.
    pub(crate) material: Material,
    /// `d`.
    pub(crate) opacity: Option<f32>,
    /// `Tr`, which counts where there is no `d`.
    pub(crate) transparency: Option<f32>,
    /// `map_d`.
    pub(crate) alpha_map: Option<MapFile>,
    /// `illum`.
    pub(crate) illumination: Option<f32>,
    /// `Pr`, `Pm` and their maps.
    pub(crate) roughness: Option<f32>,
    pub(crate) metallic: Option<f32>,
    pub(crate) roughness_map: Option<MapFile>,
    pub(crate) metallic_map: Option<MapFile>,
    /// `-s` and `-o` of its first texture, or of that of `Kd`: factors of coordinates, and terms added then.
    pub(crate) placed: Option<[[f32; 2]; 2]>,
}

/// Coordinates as they are.
pub(super) const UNPLACED: [[f32; 2]; 2] = [[1.0; 2], [0.0; 2]];

impl Entry {
    /// The material that is drawn: with highlights where the file has such.
    pub(crate) fn drawn(&self) -> Material {
        let mut drawn = self.material.clone();
        if drawn.color_map.is_some() && self.has_grey() {
            // Exporters write their own default, such as 0.8, 0.64, 0.588 or 0, and mean the image.
            drawn.color = Some(Color([1.0; 3]));
        }
        let matt = self.is_matt();
        // Where a map says it, `complete` has the rest.
        let metal = self.metallic.filter(|_| self.metallic_map.is_none()).unwrap_or(0.0);
        if let Some(roughness) = self.roughness.filter(|_| drawn.shininess.is_none()) {
            // The exponent of Blinn's highlight that is as wide as that of a microfacet surface.
            let alpha = (roughness * roughness).max(0.001);
            let exponent = (2.0 / (alpha * alpha) - 2.0).clamp(0.0, MAX_SHININESS);
            drawn.shininess = Some(Shininess([0.0, exponent]));
        } else if self.roughness_map.is_some() && drawn.shininess.is_none() {
            drawn.shininess = Some(Shininess([0.0, POLISHED]));
        }
        let physical = self.roughness.is_some()
            || self.metallic.is_some()
            || self.roughness_map.is_some()
            || self.metallic_map.is_some();
        let exponent = drawn.shininess.map(|Shininess([_, greatest])| greatest);
        if matt {
            (drawn.specular, drawn.specular_map) = (Some(Color([0.0; 3])), None);
        } else if drawn.specular.is_none() && drawn.specular_map.is_none() {
            let Color(color) = drawn.color.unwrap_or(Color([0.8; 3]));
            let height = height(exponent.unwrap_or(32.0));
            let mirrored = |c: f32| ((DIELECTRIC + (c - DIELECTRIC) * metal) * height).clamp(0.0, 1.0);
            drawn.specular = Some(Color(if physical { color.map(mirrored) } else { [0.0; 3] }));
        }
        if metal > 0.0 {
            let Color(color) = drawn.color.unwrap_or(Color([0.8; 3]));
            drawn.color = Some(Color(color.map(|c| c * (1.0 - 0.5 * metal))));
            if drawn.environment.is_some() && drawn.reflection.is_none() {
                drawn.reflection = Some(metal.into());
            }
        }
        if let Some(map) = self.metallic_map.as_ref().filter(|_| drawn.environment.is_some()) {
            drawn.reflection_map = Some(map.clone());
            drawn.reflection = drawn.reflection.or(Some(self.metallic.unwrap_or(1.0).into()));
        }
        drawn
    }

    /// Whether its colour has no hue, or it has none.
    pub(crate) fn has_grey(&self) -> bool {
        self.material.color.is_none_or(|Color([r, g, b])| r.max(g).max(b) - r.min(g).min(b) < 0.004)
    }

    /// Whether it says that there are no highlights.
    fn is_matt(&self) -> bool {
        self.illumination.is_some_and(|model| model < 2.0)
    }

    /// The share of light that does not go through: `d` before `Tr`.
    pub(crate) fn opacity(&self) -> f32 {
        self.opacity.or(self.transparency.map(|share| 1.0 - share)).unwrap_or(1.0)
    }

    /// Its name and maps, once these have been read.
    pub(crate) fn note(&self, images: &Images) -> MaterialNote {
        let mut maps = self.material.maps();
        for (key, map) in [
            ("alpha-map", &self.alpha_map),
            ("roughness-map", &self.roughness_map),
            ("metallic-map", &self.metallic_map),
        ] {
            maps.extend(map.clone().map(|map| (key, map)));
        }
        MaterialNote { name: self.name.clone(), maps: images.notes(maps) }
    }

    /// Has a part's highlights follow its maps of roughness and of metal, unless the file says what they are.
    fn mirror(&self, part: &mut Part, gloss: Option<usize>, metal: Option<usize>, images: &mut Images) {
        let highlights = self.material.specular.is_some() || self.material.specular_map.is_some();
        if highlights || self.is_matt() {
            return;
        }
        let share = self.metallic.unwrap_or(if metal.is_some() { 1.0 } else { 0.0 });
        // The colour before `drawn` made it darker.
        let scattered = if metal.is_some() { 1.0 } else { 1.0 - 0.5 * share };
        let exponents = part.detail.shininess;
        let exponents = if gloss.is_some() { exponents } else { [exponents[1]; 2] };
        let mirroring = images.mirroring(
            Mirroring {
                colors: (part.texture, part.diffuse.map(|c| byte(c / scattered))),
                metal: (metal, byte(share)),
                gloss: (gloss, exponents.map(f32::to_bits)),
            },
            height,
        );
        if let Some(image) = mirroring {
            part.detail.specular_map = Some(Map { image, filter: None, wrap: part.detail.wrap });
            part.detail.specular = [1.0; 3];
        }
    }

    /// Gives a part what goes beyond a scene file's materials.
    ///
    /// # Errors
    /// Those that `warn` passes on.
    pub(crate) fn complete(
        &self,
        part: &mut Part,
        images: &mut Images,
        warn: &mut dyn FnMut(Error) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut read = |map: &Option<MapFile>, images: &mut Images| match map {
            None => Ok(None),
            Some(map) => images.texture(map).or_else(|error| warn(error).map(|()| None)),
        };
        let rough = read(&self.roughness_map, images)?.filter(|_| part.detail.shininess_map.is_none());
        let gloss = rough.map(|image| images.inverted(image));
        if let Some(image) = gloss {
            let wrap = self.roughness_map.as_ref().and_then(|map| map.wrap);
            part.detail.shininess_map = Some(Map { image, filter: None, wrap });
        }
        let metal = read(&self.metallic_map, images)?;
        if gloss.is_some() || metal.is_some() {
            self.mirror(part, gloss, metal, images);
        }
        if let Some(image) = metal {
            let dull = images.dull(part.texture, (image, byte(self.metallic.unwrap_or(1.0))));
            part.texture = dull.or(part.texture);
        }
        let alpha = read(&self.alpha_map, images)?;
        if let Some(alpha) = alpha {
            if part.texture.is_none() {
                part.detail.wrap = self.alpha_map.as_ref().and_then(|map| map.wrap);
            }
            part.texture = images.with_alpha(part.texture, alpha).or(part.texture);
        }
        see_through(part, self.opacity(), images);
        part.detail.placed = self.placed.filter(|placed| *placed != UNPLACED);
        Ok(())
    }
}

/// The height of a highlight that keeps its light as it narrows.
fn height(exponent: f32) -> f32 {
    (exponent + 8.0) / 8.0
}

/// Has what is behind a part show through it: where it is glass, or where its texture has holes.
///
/// A texture whose alpha is all or nothing, but for narrow rims, is cut out, in any order and with depths. Others are
/// mixed with what is behind them, from the back to the front.
pub(crate) fn see_through(part: &mut Part, opacity: f32, images: &mut Images) {
    let alpha = part.texture.map_or(Alpha::Opaque, |image| images.alpha(image));
    let byte = byte(opacity);
    let Detail { blend, alpha_test, is_share, .. } = &mut part.detail;
    match (alpha, byte) {
        (Alpha::Opaque, 255) => {}
        (Alpha::Opaque, _) => *blend = AnyBlend::Constant(byte),
        (Alpha::Holes, 255) => (*alpha_test, *is_share) = (128, true),
        (_, 255) => *blend = AnyBlend::Over,
        (_, _) => {
            part.texture = part.texture.map(|image| images.faded(image, byte));
            *blend = AnyBlend::Over;
        }
    }
}

/// The alpha of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Alpha {
    /// 255 everywhere; or 0 everywhere, where it means nothing.
    Opaque,
    /// All or nothing, but for the rims.
    Holes,
    /// Anything between.
    Shades,
}

impl Alpha {
    /// Of these texels, rows of so many: holes, if at most a tenth of those that show are between, and at most a
    /// fiftieth have none but such around them. Rims are narrow.
    pub(crate) fn of(texels: &[[u8; 4]], width: usize) -> Self {
        let count = |is: &dyn Fn(u8) -> bool| texels.iter().filter(|&&[.., alpha]| is(alpha)).count();
        let (shown, least) = (count(&|alpha| alpha >= 8), count(&|alpha| alpha < 255));
        if shown == 0 || least == 0 {
            return Self::Opaque;
        }
        let is_between = |&[.., alpha]: &[u8; 4]| (8..248).contains(&alpha);
        let between = texels.iter().filter(|texel| is_between(texel)).count();
        let all = |texels: Option<&[[u8; 4]]>| texels.is_some_and(|texels| texels.iter().all(is_between));
        let is_inner = |at: usize| {
            let across = all(at.checked_sub(1).and_then(|left| texels.get(left..left + 3)));
            let rows = [at.checked_sub(width), at.checked_add(width)];
            across && rows.into_iter().all(|at| all(at.and_then(|at| texels.get(at..=at))))
        };
        let inner = (0..texels.len()).filter(|&at| is_inner(at)).count();
        if 10 * between > shown || 50 * inner > shown {
            Self::Shades
        } else if between == 0 && shown == texels.len() {
            Self::Opaque
        } else {
            Self::Holes
        }
    }
}
