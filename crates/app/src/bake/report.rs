//! The report: bytes of flash by item, errors, memory, and the time of a frame.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::binary::length;
use super::missing::as_filed;
use super::texels::Role;
use super::{Asset, Format, restored};
use crate::advise::{Kin, LitAt, Machine, baked_on_chip, depth_bytes, work};
use crate::error::{Error, counted, quote};
use crate::measure::{Comparison, Measures};
use crate::options::values::name_of;
use crate::options::{Arithmetic, ColorFormat, Filter, Policies, Projection, RenderOptions, Shading};
use crate::render::render;
use crate::scene::{Camera, Model, Part, camera};
use alberti::baked::{Attributes, HEADER, PART};
use alberti::{PreparedTriangle, Slot};

/// The report on an asset.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    asset: &'a Asset,
    /// The triangles of the model.
    given: usize,
    size: [u32; 2],
    band: u32,
    color: ColorFormat,
    /// The names of the asset's parts, in brackets, or nothing.
    names: Vec<String>,
    /// Names and bytes of what lies in flash.
    pub items: Vec<(String, usize)>,
    /// Names and bytes of what a renderer in bands has in memory.
    pub memory: [(String, usize); 4],
    /// Frames on chips.
    pub estimates: Vec<Estimate>,
    /// The light that these have.
    light: Option<&'static str>,
    /// The things of the scene that these have not.
    pub unpriced: Vec<String>,
    /// The greatest loss of a place, in pixels at the scene's camera.
    pub pixels: f64,
    /// The greatest loss of texture coordinates, in texels of the largest texture.
    pub texels: f64,
    /// The frame of the file against that of the scene.
    pub measures: Measures,
}

/// A frame on a chip.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// The chip.
    pub chip: &'static str,
    /// Instructions of a frame.
    pub instructions: f64,
    /// Those of one with light at the vertices instead, on the nearest texel, if there is light in fixed point.
    pub at_vertices: Option<f64>,
    /// How far nine tenths of such estimates are off at most, in percent.
    pub off: f64,
}

/// A count that an estimate gives.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "instructions of a frame, which saturate"
)]
fn whole(estimate: f64) -> u64 {
    estimate.round() as u64
}

impl<'a> Report<'a> {
    /// The report on the asset of a scene, and on its file, in bands of so many rows, or those of the frame.
    /// Instructions are those of the options' policies. Frames are compared by the most precise ones, without what the
    /// file has not: blends, holes, fog, and often colours of vertices.
    ///
    /// # Errors
    /// A frame cannot be drawn, or chips are not known to draw so.
    pub fn new(
        asset: &'a Asset,
        file: &[u8],
        (model, camera, options): (&Model, &Camera, &RenderOptions),
        band: u32,
    ) -> Result<Self, Error> {
        let (model, band) = (&*as_filed(model, asset.attributes), band.min(options.height));
        let baked = restored(file, asset, model)?;
        let work = work(&baked, camera, options)?;
        let light = light(asset, options);
        let precise = RenderOptions {
            policies: Policies { color: ColorFormat::Rgba8, ..Policies::default() },
            depth: crate::options::DepthFormat::F32Reversed,
            haze: None,
            ..*options
        };
        let frame = |model| Ok::<_, Error>(render(model, camera, &precise, &mut |_, _| ())?.image);
        let measures = Comparison::new(&frame(&baked)?, &frame(model)?)?.measures;
        let side = asset.textures.iter().flat_map(|texture| texture.size).max().unwrap_or(0);
        Ok(Self {
            asset,
            names: asset.pieces.iter().map(|piece| named(&model.parts[piece.part])).collect(),
            given: model.parts.iter().map(|part| part.triangles.len()).sum(),
            size: [options.width, options.height],
            band,
            color: options.policies.color,
            items: items(asset),
            memory: memory(asset, options, band),
            estimates: estimates(options, light.is_some(), |machine, options, lit| {
                baked_on_chip(machine, options, &work, lit)
            })?,
            pixels: asset.losses.place * 3.0_f64.sqrt() * pixels_a_unit(&baked, camera, options),
            texels: asset.losses.uv[0].max(asset.losses.uv[1]) * f64::from(side),
            measures,
            light,
            unpriced: unpriced(asset, options, band),
        })
    }

    /// All bytes in flash.
    #[must_use]
    pub fn flash(&self) -> usize {
        self.items.iter().map(|(_, bytes)| bytes).sum()
    }

    /// The costs of it on a board, as text: flash, RAM and instructions.
    #[must_use]
    pub fn costs(&self) -> String {
        let Self { size: [width, height], band, .. } = self;
        let mut text = format!("{} bytes of flash:\n\n", self.flash());
        // Writing to a string cannot fail.
        let mut line = |words: String| _ = writeln!(text, "{words}");
        for (name, bytes) in &self.items {
            line(format!("{bytes:>9}  {name}"));
        }
        let ram: usize = self.memory.iter().map(|(_, bytes)| bytes).sum();
        let rows = counted(*band as usize, "row", "rows");
        let columns = counted(*width as usize, "column", "columns");
        line(format!("\n{ram} bytes of RAM, in bands of {rows} of {columns}:\n"));
        for (name, bytes) in &self.memory {
            line(format!("{bytes:>9}  {name}"));
        }
        let light = self.light.unwrap_or("without light");
        // Prices are those of these pixels.
        let format = if self.color == ColorFormat::Rgb565 { "" } else { " in rgb565" };
        let is_alternative = self.estimates.iter().any(|estimate| estimate.at_vertices.is_some());
        let (alternative, heads) = if is_alternative {
            (",\nfound at pixels, or at the vertices and then on the nearest texel", "   pixels vertices")
        } else {
            ("", "    frame")
        };
        line(format!(
            "\nMillions of instructions for a frame of {width}x{height}{format}, {light}{alternative}:\n"
        ));
        line(format!("{heads}  chip  mostly within"));
        for Estimate { chip, instructions, at_vertices, off } in &self.estimates {
            let all = [Some(*instructions), *at_vertices].into_iter().flatten();
            let millions: String = all.map(|count| format!("{:>9.2}", count / 1e6)).collect();
            line(format!("{millions}  {chip:<5}{off:>3.0} %"));
        }
        if !self.unpriced.is_empty() {
            line(format!("\nNot in these: {}.", self.unpriced.join(", ")));
        }
        text
    }

    /// The report as text.
    #[must_use]
    pub fn text(&self) -> String {
        let Self { asset, given, pixels, texels, measures, .. } = self;
        let (triangles, vertices) = (asset.triangles(), counted(asset.vertices(), "vertex", "vertices"));
        let given = counted(*given, "triangle", "triangles");
        let mut text = format!("{triangles} of {given}, {vertices}, {}", self.costs());
        // Writing to a string cannot fail.
        let mut line = |words: String| _ = writeln!(text, "{words}");
        if asset.pieces.len() > 1 {
            let passes = asset.pieces.len();
            line(format!("\n{passes} passes a frame, as docs/bake.md has them under \"Several parts\":\n"));
            for (number, (piece, name)) in asset.pieces.iter().zip(&self.names).enumerate() {
                let surface = match piece.texture {
                    Some(texture) => format!("texture {texture}"),
                    None => "no texture".to_owned(),
                };
                let triangles = counted(piece.triangles.len(), "triangle", "triangles");
                let vertices = counted(piece.vertices.len(), "vertex", "vertices");
                line(format!("{number:>9}  {triangles}, {vertices}, {surface}{name}"));
            }
        }
        line("\nLost at most:\n".to_owned());
        let losses = &asset.losses;
        line(format!("  places    {:.1e} of a unit, {pixels:.3} pixels at this camera", losses.place));
        let has = |attribute| asset.attributes.contains(attribute);
        if has(Attributes::NORMAL) {
            line(format!("  normals   {:.2} degrees", losses.normal));
        }
        if has(Attributes::TANGENT) {
            line(format!("  tangents  {:.2} degrees", losses.tangent));
        }
        if has(Attributes::UV) {
            line(format!("  uv        {texels:.3} texels"));
        }
        if asset.moved() > 0.0 {
            line(format!("  surface   {:.1e} of a unit, by the simplification", asset.moved()));
            let several = asset.pieces.len() > 1;
            for (piece, name) in asset.pieces.iter().zip(&self.names).filter(|_| several) {
                let triangles = counted(piece.triangles.len(), "triangle", "triangles");
                line(format!("            {:.1e}  part {}{name}: {triangles}", piece.moved, piece.part));
            }
        }
        line(format!(
            "  frame     {} of 255 for 99.9 % of the pixels, mean FLIP {:.4}",
            measures.most, measures.flip
        ));
        let order = self.order();
        line(format!(
            "\nA cache of 16 vertices transforms {:.2} a triangle, before {:.2}.",
            order[1], order[0]
        ));
        text
    }

    /// Transformed vertices a triangle with a small cache, before and after.
    fn order(&self) -> [f64; 2] {
        let weighed = |of: fn(&super::Order) -> f32| {
            let all =
                self.asset.pieces.iter().map(|piece| (piece.triangles.len(), f64::from(of(&piece.order))));
            let (count, sum) = all.fold((0, 0.0), |(count, sum), (triangles, acmr)| {
                (count + triangles, sum + acmr * f64::from(u32::try_from(triangles).unwrap_or(u32::MAX)))
            });
            sum / f64::from(u32::try_from(count).unwrap_or(u32::MAX))
        };
        [weighed(|order| order.before), weighed(|order| order.after)]
    }

    /// The same as one value of JSON.
    #[must_use]
    pub fn json(&self) -> Value {
        let asset = self.asset;
        let bytes = |items: &[(String, usize)]| -> Vec<Value> {
            items.iter().map(|(name, bytes)| json!({ "name": name, "bytes": bytes })).collect()
        };
        let chips = self.estimates.iter().map(|estimate| {
            let Estimate { chip, instructions, at_vertices, off } = estimate;
            json!({
                "chip": chip,
                "instructions": whole(*instructions),
                "instructions_lit_at_vertices": at_vertices.map(whole),
                "off_percent": (off * 100.0).round() / 100.0,
            })
        });
        let [before, after] = self.order();
        json!({
            "triangles": asset.triangles(),
            "triangles_given": self.given,
            "vertices": asset.vertices(),
            "flash": self.flash(),
            "items": bytes(&self.items),
            "ram": self.memory.iter().map(|(_, bytes)| bytes).sum::<usize>(),
            "band": self.band,
            "memory": bytes(&self.memory),
            "chips": chips.collect::<Vec<_>>(),
            "light": self.light,
            "unpriced": self.unpriced,
            "unit": asset.unit,
            "lost": {
                "place": asset.losses.place,
                "pixels": self.pixels,
                "normal_degrees": asset.losses.normal,
                "tangent_degrees": asset.losses.tangent,
                "uv": asset.losses.uv,
                "texels": self.texels,
                "surface": asset.moved(),
                "frame": self.measures.most,
                "frame_largest": self.measures.largest,
                "flip": self.measures.flip,
            },
            "surfaces": asset.pieces.iter().map(|piece| {
                json!({
                    "part": piece.part,
                    "triangles": piece.triangles.len(),
                    "vertices": piece.vertices.len(),
                    "texture": piece.texture,
                    "moved": piece.moved,
                })
            }).collect::<Vec<_>>(),
            "cache_before": before,
            "cache_after": after,
        })
    }
}

/// Estimates for chips of the model and their kin, by family and size, of frames with light or without.
fn estimates(
    options: &RenderOptions,
    is_lit: bool,
    of: impl Fn(Machine, &RenderOptions, LitAt) -> Result<(f64, f64), Error>,
) -> Result<Vec<Estimate>, Error> {
    let nearest = RenderOptions { filter: Filter::Nearest, ..*options };
    let has_vertices = is_lit && options.policies.arithmetic == Arithmetic::Fixed;
    let mut all = vec![];
    for machine in [Machine::M0, Machine::M4f, Machine::Rv32] {
        let lit = if is_lit { LitAt::Pixels } else { LitAt::Nowhere };
        let own = of(machine, &priced(options), lit)?;
        let at_vertices = has_vertices.then(|| of(machine, &nearest, LitAt::Vertices)).transpose()?;
        all.push(Estimate {
            chip: machine.name(),
            instructions: own.0,
            at_vertices: at_vertices.map(|(instructions, _)| instructions),
            off: own.1,
        });
        all.extend(Kin::ALL.into_iter().filter(|kin| kin.of == machine).map(|kin| {
            let (instructions, off) = kin.estimate(own);
            let at_vertices = at_vertices.map(|of_kin| kin.estimate(of_kin).0);
            Estimate { chip: kin.name, instructions, at_vertices, off }
        }));
    }
    all.sort_by_key(|estimate| ORDER.iter().position(|&chip| chip == estimate.chip));
    Ok(all)
}

/// The chips in the order of the table: what is not among them comes first.
const ORDER: [&str; 6] = ["m0", "m3", "m4f", "m7", "m33", "rv32"];

/// The light that estimates of frames have, in words; `None` where normals are not read. Highlights and maps beside the
/// surface's colour are not in them.
fn light(asset: &Asset, options: &RenderOptions) -> Option<&'static str> {
    let is_lit = options.shading.is_lit() && asset.attributes.contains(Attributes::NORMAL);
    is_lit.then_some(match options.shading {
        Shading::Lambert => "in light from one direction",
        _ => "in diffuse light from one direction, without highlights",
    })
}

/// The options that estimates are for: with one probe of an anisotropic filter.
fn priced(options: &RenderOptions) -> RenderOptions {
    let filter = match options.filter {
        Filter::Anisotropic(_) => Filter::Trilinear,
        other => other,
    };
    RenderOptions { filter, ..*options }
}

/// The things of a scene that estimates of frames do not have, in words: prices are those of a whole frame, of pixels
/// and texels in RGB565.
fn unpriced(asset: &Asset, options: &RenderOptions, band: u32) -> Vec<String> {
    let mut all = vec![];
    let color = options.policies.color;
    if color != ColorFormat::Rgb565 {
        all.push(format!("pixels of {}", name_of(color)));
    }
    if let Filter::Anisotropic(_) = options.filter {
        all.push("all but one of the probes of the anisotropic filter".to_owned());
    }
    let of_colors = asset.textures.iter().find(|texture| texture.role == Role::Color);
    if let Some(texture) = of_colors.filter(|texture| texture.format != Format::Rgb565) {
        all.push(format!("texels of {}", texture.format.name()));
    }
    if band < options.height {
        all.push("setting up triangles again that reach into further bands".to_owned());
    }
    all
}

/// All that lies in flash, but for code.
fn items(asset: &Asset) -> Vec<(String, usize)> {
    let (vertices, triangles) = (asset.vertices(), asset.triangles());
    let meshlets: usize = asset.pieces.iter().map(|piece| piece.meshlets.len()).sum();
    let mut items = vec![
        ("header and parts".to_owned(), HEADER + PART * asset.pieces.len() + 16 * asset.textures.len()),
        (format!("places of {}", counted(vertices, "vertex", "vertices")), 6 * vertices),
    ];
    for (attribute, name, bytes) in [
        (Attributes::UV, "texture coordinates", 4),
        (Attributes::NORMAL, "normals", 2),
        (Attributes::TANGENT, "tangents", 3),
        (Attributes::COLOR, "colours", 3),
    ] {
        if asset.attributes.contains(attribute) {
            items.push((name.to_owned(), bytes * vertices));
        }
    }
    items.push((format!("indices of {}", counted(triangles, "triangle", "triangles")), 6 * triangles));
    items.push((format!("meshlets: {meshlets}"), 28 * meshlets));
    for (number, texture) in asset.textures.iter().enumerate() {
        let [width, height] = texture.size;
        let (role, format) = (texture.role.name(), texture.format.name());
        let levels = counted(texture.levels.len(), "level", "levels");
        items.push((
            format!("texture {number}, {role}: {width}x{height} {format}, {levels}"),
            length(texture),
        ));
    }
    items
}

/// The name of a part in brackets, after a space, if it has one.
pub(super) fn named(part: &Part) -> String {
    if part.name.is_empty() { String::new() } else { format!(" ({})", quote(part.name.as_bytes())) }
}
/// The memory of a renderer in bands, as [`alberti::Memory`] has it, with the options' colours and depths.
fn memory(asset: &Asset, options: &RenderOptions, band: u32) -> [(String, usize); 4] {
    let pixels = (options.width * band) as usize;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0, 2 or 4")]
    let depth = depth_bytes(options.depth) as usize;
    let color = options.policies.color;
    [
        (format!("colours of two bands, {}", name_of(color)), 2 * color.bytes() * pixels),
        ("depths of a band".to_owned(), depth * pixels),
        ("transformed vertices".to_owned(), asset.vertices() * slot(asset.attributes)),
        ("list of triangles".to_owned(), asset.triangles() * size_of::<PreparedTriangle>()),
    ]
}

/// The bytes of a transformed vertex with these attributes.
fn slot(attributes: Attributes) -> usize {
    let numbers =
        [(Attributes::UV, 2), (Attributes::NORMAL, 3), (Attributes::TANGENT, 4), (Attributes::COLOR, 3)];
    let carried: usize =
        numbers.into_iter().filter(|(attribute, _)| attributes.contains(*attribute)).map(|(_, n)| n).sum();
    size_of::<Slot<()>>() + 4 * carried
}

/// The most pixels that a unit of object space is wide.
fn pixels_a_unit(model: &Model, camera: &Camera, options: &RenderOptions) -> f64 {
    let rows = f64::from(options.height);
    if let Projection::Parallel { height } = options.projection {
        return rows / f64::from(height);
    }
    let away = camera::nearest(model, camera).max(f64::from(camera.near));
    rows / 2.0 / (f64::from(camera.fov).to_radians() / 2.0).tan() / away
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti::glam::{Vec2, Vec3, Vec4};

    #[test]
    fn slots_are_as_large_as_the_librarys() {
        let all = Attributes::UV | Attributes::NORMAL | Attributes::TANGENT;
        assert_eq!(slot(Attributes::NONE), size_of::<Slot<()>>());
        assert_eq!(slot(Attributes::UV), size_of::<Slot<Vec2>>());
        assert_eq!(slot(Attributes::UV | Attributes::NORMAL), size_of::<Slot<(Vec3, Vec2)>>());
        assert_eq!(slot(all), size_of::<Slot<(Vec4, Vec3, Vec2)>>());
    }
}
