//! Maps, attributes, filters and levels of detail that a scene shows as well without.

use super::super::machine::texels;
use super::bill::Bill;
use crate::draw::{Drawing, Studio};
use crate::error::Error;
use crate::measure::Comparison;
use crate::options::{Filter, Lod, Probes as FilterProbes, RenderOptions};
use crate::render::{any_depth, buffer};
use crate::scene::{Camera, Detail, Image, Model, Relief, Vertex};
use alberti::{Rgba8888, Target};
use std::time::Instant;

/// The mean FLIP below which nobody tells two pictures apart.
const INVISIBLE: f64 = 0.002;

/// The FLIP of a pixel above which it looks another, and the number of pixels of which one may.
const SEEN: f32 = 0.1;
const FEW: usize = 5000;

/// A picture and the milliseconds that it took.
type Drawn = (Image, f64);

/// A scene as it is, to be compared with less of it.
pub(super) struct Look<'a> {
    model: &'a Model,
    camera: &'a Camera,
    options: &'a RenderOptions,
    bill: &'a Bill,
    whole: Drawn,
}

/// A map of a material, and how to leave it out.
type Map = (&'static str, fn(&Detail) -> bool, fn(&mut Detail));

const MAPS: [Map; 8] = [
    ("normal maps", |d| d.normal.is_some(), |d| d.normal = None),
    ("height maps", has_relief, |d| {
        d.height = d.height.filter(|height| height.relief == Relief::Displacement);
    }),
    ("ambient occlusion maps", |d| d.occlusion.is_some(), |d| d.occlusion = None),
    ("specular maps", |d| d.specular_map.is_some(), |d| d.specular_map = None),
    ("shininess maps", |d| d.shininess_map.is_some(), |d| d.shininess_map = None),
    ("wetness", |d| d.wetness > 0.0, |d| (d.wetness, d.wetness_map) = (0.0, None)),
    ("emission", |d| d.emissive != [0.0; 3], |d| (d.emissive, d.emissive_map) = ([0.0; 3], None)),
    ("reflections", |d| d.environment.is_some(), |d| d.environment = None),
];

/// Whether heights are read when it is drawn. Of a displacement map the surface has been made before.
fn has_relief(detail: &Detail) -> bool {
    detail.height.is_some_and(|height| height.relief != Relief::Displacement)
}

/// An attribute of vertices, its bytes as floats, and how to leave it out.
type Attribute = (&'static str, f64, fn(&mut Vertex));

const ATTRIBUTES: [Attribute; 4] = [
    ("normals", 12.0, |v| v.normal = [0.0, 0.0, 1.0]),
    ("texture coordinates", 8.0, |v| v.uv = [0.0; 2]),
    ("vertex colours", 12.0, |v| v.color = [1.0; 3]),
    ("tangents", 16.0, |v| v.tangent = [0.0; 4]),
];

impl<'a> Look<'a> {
    /// # Errors
    /// The scene cannot be drawn.
    pub(super) fn new(
        model: &'a Model,
        camera: &'a Camera,
        options: &'a RenderOptions,
        bill: &'a Bill,
    ) -> Result<Self, Error> {
        let whole = draw(model, camera, options)?;
        Ok(Self { model, camera, options, bill, whole })
    }

    /// All that is not seen.
    ///
    /// # Errors
    /// The scene cannot be drawn.
    pub(super) fn lines(&self, lines: &mut Vec<String>) -> Result<(), Error> {
        lines.extend(self.colors()?);
        for (name, is_there, remove) in MAPS {
            if self.model.parts.iter().any(|part| is_there(&part.detail)) {
                let mut without = self.model.clone();
                without.parts.iter_mut().for_each(|part| remove(&mut part.detail));
                lines.extend(self.without_maps(name, "to leave them out", &without)?);
            }
        }
        lines.extend(self.attributes()?);
        lines.extend(self.filter()?);
        lines.extend(self.lod()?);
        Ok(())
    }

    /// Textures of which the mean colour would do.
    fn colors(&self) -> Result<Option<String>, Error> {
        let mut without = self.model.clone();
        for part in &mut without.parts {
            if let Some(image) = part.texture.take().and_then(|index| self.model.textures.get(index)) {
                let mean = mean(image);
                part.diffuse.iter_mut().zip(mean).for_each(|(diffuse, mean)| *diffuse *= mean);
            }
        }
        if without == *self.model {
            return Ok(None);
        }
        self.without_maps("colour maps", "to take each one's mean colour instead", &without)
    }

    fn without_maps(&self, name: &str, action: &str, without: &Model) -> Result<Option<String>, Error> {
        let drawn = draw(without, self.camera, self.options)?;
        let bytes = (texels(self.model) - texels(without)) * self.bill.texel();
        let saves = self.bill.saves(self.bill.data(self.whole.1 - drawn.1, bytes));
        Ok(self.seen(&drawn)?.map(|seen| format!("{name}: {seen}; {action} {saves}")))
    }

    /// Data of vertices. What heights have moved is not known to need any of it, so nothing is said of these.
    fn attributes(&self) -> Result<Vec<String>, Error> {
        let mut lines = vec![];
        let heights = self.model.parts.iter().filter_map(|part| part.detail.height);
        if heights.into_iter().any(|height| height.relief == Relief::Displacement) {
            return Ok(lines);
        }
        for (name, bytes, remove) in ATTRIBUTES {
            let mut without = self.model.clone();
            without.vertices.iter_mut().for_each(remove);
            if without.vertices == self.model.vertices {
                continue;
            }
            let count = u32::try_from(without.vertices.len()).map_or(f64::INFINITY, f64::from);
            let saves = self.bill.saves(self.bill.data(0.0, bytes * count));
            let drawn = draw(&without, self.camera, self.options)?;
            lines.extend(self.seen(&drawn)?.map(|seen| {
                format!("{name}: {seen}; to leave them out of the vertices, as floats, {saves}")
            }));
        }
        Ok(lines)
    }

    /// The change of the picture in words, if it is none that anybody sees.
    fn seen(&self, (picture, _): &Drawn) -> Result<Option<String>, Error> {
        let change = Comparison::new(picture, &self.whole.0)?;
        let flip = change.measures.flip;
        Ok(match change.measures.largest {
            0 => Some("they change no pixel".to_owned()),
            _ if is_unseen(&change) => Some(format!("nobody sees them (mean FLIP {flip:.4})")),
            _ => None,
        })
    }

    /// The first filter that is cheaper and looks the same.
    fn filter(&self) -> Result<Option<String>, Error> {
        const FILTERS: [(&str, Filter); 4] = [
            ("nearest", Filter::Nearest),
            ("bilinear", Filter::Bilinear),
            ("trilinear", Filter::Trilinear),
            ("anisotropic:2", Filter::Anisotropic(FilterProbes::Two)),
        ];
        if self.model.textures.is_empty() {
            return Ok(None);
        }
        for (name, filter) in FILTERS {
            if filter == self.options.filter {
                break;
            }
            let other = RenderOptions { filter, ..*self.options };
            if let Some((flip, saves)) = self.reads_as_well(&other)? {
                return Ok(Some(format!("filter: {name} looks the same (mean FLIP {flip:.4}); it {saves}")));
            }
        }
        Ok(None)
    }

    /// The first places for levels of detail that are cheaper and look the same.
    fn lod(&self) -> Result<Option<String>, Error> {
        const PLACES: [(&str, Lod); 2] = [("one a triangle", Lod::Triangle), ("one a run", Lod::Run)];
        let mipmapped = !matches!(self.options.filter, Filter::Nearest | Filter::Bilinear);
        if self.model.textures.is_empty() || !mipmapped {
            return Ok(None);
        }
        for (name, lod) in PLACES {
            let mut other = *self.options;
            if lod == other.policies.lod {
                break;
            }
            other.policies.lod = lod;
            if let Some((flip, saves)) = self.reads_as_well(&other)? {
                let line =
                    format!("levels of detail: {name} looks the same (mean FLIP {flip:.4}); it {saves}");
                return Ok(Some(line));
            }
        }
        Ok(None)
    }

    /// The mean FLIP of textures that are read so, and what that saves, if nobody sees it.
    fn reads_as_well(&self, other: &RenderOptions) -> Result<Option<(f64, String)>, Error> {
        let drawn = draw(self.model, self.camera, other)?;
        let change = Comparison::new(&drawn.0, &self.whole.0)?;
        let saved = self.bill.reading(self.whole.1 - drawn.1, self.options, other);
        Ok(is_unseen(&change).then(|| (change.measures.flip, self.bill.saves(saved))))
    }
}

/// Whether a picture looks like another: all in all, and in its parts, as small as they may be.
fn is_unseen(change: &Comparison) -> bool {
    let seen = change.flip.iter().filter(|flip| **flip > SEEN).count();
    let most = change.flip.len() / FEW;
    change.measures.flip < INVISIBLE && seen <= most
}

/// The mean colour of an image, by bytes, as a mip map has it.
fn mean(image: &Image) -> [f32; 3] {
    let mut sums = [0_u64; 3];
    for texel in &image.texels {
        sums.iter_mut().zip(texel).for_each(|(sum, byte)| *sum += u64::from(*byte));
    }
    let count = image.texels.len().max(1) as u64;
    #[expect(clippy::cast_possible_truncation, reason = "from 0 to 1")]
    sums.map(|sum| (u32::try_from(sum / count).map_or(0.0, f64::from) / 255.0) as f32)
}

/// The picture, and the least time of two.
pub(super) fn draw(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Drawn, Error> {
    let studio = Studio::new(model, camera, options)?;
    let (mut pixels, mut depth) = (buffer(options, 0)?, buffer(options, 0)?);
    let RenderOptions { width, height, .. } = *options;
    let mut target = Target::new(Rgba8888, any_depth(options.depth), width, height, &mut pixels, &mut depth)
        .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
    let mut time = f64::INFINITY;
    for _ in 0..2 {
        let drawing = Drawing::new(model, camera, options, &studio)?;
        let start = Instant::now();
        drawing.draw_all(&mut target, &mut |_, _| ());
        time = time.min(start.elapsed().as_secs_f64() * 1e3);
    }
    let texels = pixels.iter().map(|pixel: &u32| pixel.to_ne_bytes()).collect();
    Ok((Image { width, height, texels }, time))
}
