//! A model or a scene in numbers: its size, its materials and their maps, and what it takes here and on boards.

use std::fmt::Write as _;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use serde_json::{Value, json};

use crate::bake::Report;
use crate::error::{Error, counted, decimal, quote};
use crate::options::byte;
use crate::scene::{Image, MapNote, Model, Part, Vertex};

/// Parts and materials that the text lists; JSON has all.
const LISTED: usize = 20;

/// The keys of a baked scene's report that are costs.
const COSTS: [&str; 8] = ["flash", "items", "ram", "band", "memory", "chips", "light", "unpriced"];

/// A model or a scene.
#[derive(Debug)]
pub struct Info<'a> {
    /// The name of its file, or of the built-in scene.
    pub source: &'a str,
    /// All of it.
    pub model: &'a Model,
    /// Its costs on boards, or why there are none.
    pub costs: Result<Report<'a>, Error>,
    /// Things of it that boards do not draw.
    pub left_out: Vec<String>,
    /// Warnings of its files.
    pub warnings: Vec<String>,
}

impl Info<'_> {
    /// The report as text.
    #[must_use]
    pub fn text(&self) -> String {
        let model = self.model;
        let all = model.vertices.len();
        let mut text = String::new();
        // Writing to a string cannot fail.
        let mut line = |words: String| _ = writeln!(text, "{words}");
        let (triangles, vertices) =
            (counted(triangles(model), "triangle", "triangles"), counted(all, "vertex", "vertices"));
        line(format!("{}: {triangles}, {vertices}\n", self.source));
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let [low, high] = extents(model).map(|point| point[axis]);
            // Rounding leaves a little of 0.
            let [from, to] = [low, high].map(|x| if x.abs() < 1e-7 * (high - low) { 0.0 } else { x });
            line(format!("  {name:<9}{} to {}, {}", short(from), short(to), short(high - low)));
        }
        if model.origin != [0.0; 3] {
            line(format!("  origin   counted from {}", model.origin.map(short).join(",")));
        }
        line(format!("  normals  {}", normals(model)));
        line(format!("  uv       {}", yes(has_uv(model))));
        line(format!("  colours  {}", if has_colors(model) { "of vertices" } else { "none of vertices" }));
        let [vertices, triangles, maps] = memory(model);
        let bytes = vertices + triangles + maps;
        line(format!(
            "  memory   {bytes} bytes: {vertices} of vertices, {triangles} of triangles, {maps} of maps"
        ));
        line(format!("\n{}:\n", counted(model.parts.len(), "part", "parts")));
        let mut left = model.parts.len();
        for equal in model.parts.chunk_by(|a, b| told(a) == told(b)).take(LISTED) {
            left -= equal.len();
            let times = if equal.len() > 1 { format!(", {} times", equal.len()) } else { String::new() };
            line(format!("{}{times}", told(&equal[0])));
        }
        if left > 0 {
            line(format!("           and {left} more"));
        }
        let materials = &model.notes.materials;
        if !materials.is_empty() {
            line(format!("\n{}:\n", counted(materials.len(), "material", "materials")));
        }
        for material in materials.iter().take(LISTED) {
            let name = match material.name.as_str() {
                "" => "of the options".to_owned(),
                name => quote(name.as_bytes()),
            };
            line(format!("  {name}{}", if material.maps.is_empty() { ", without maps" } else { "" }));
            for MapNote { key, path, size } in &material.maps {
                let size = size.map_or_else(
                    || if path.exists() { "not usable" } else { "missing" }.to_owned(),
                    |[width, height]| format!("{width}x{height}"),
                );
                line(format!("    {key:<15}{}, {size}", plain(path)));
            }
        }
        if let Some(more) = materials.len().checked_sub(LISTED).filter(|&more| more > 0) {
            line(format!("  and {more} more"));
        }
        line(match &self.costs {
            Ok(report) => format!("\nOn a board, as alberti bake has it: {}", report.costs().trim_end()),
            Err(error) => format!("\nOn a board, not as it is: {error}"),
        });
        for left_out in &self.left_out {
            line(format!("Not on a board: {left_out}."));
        }
        text
    }

    /// The same as one value of JSON.
    #[must_use]
    pub fn json(&self) -> Value {
        let model = self.model;
        let [low, high] = extents(model);
        let [vertices, triangles_bytes, maps] = memory(model);
        let parts = model.parts.iter().map(|part| {
            json!({
                "name": part.name,
                "material": part.material,
                "triangles": part.triangles.len(),
                "color": part.diffuse.map(decimal),
                "specular": part.detail.specular.map(decimal),
                "exponent": exponents(part),
                "look": look(part),
            })
        });
        let materials = model.notes.materials.iter().map(|material| {
            let maps = material.maps.iter().map(|MapNote { key, path, size }| {
                json!({ "key": key, "file": plain(path), "size": size, "found": path.exists() })
            });
            json!({ "name": material.name, "maps": maps.collect::<Vec<_>>() })
        });
        let board = match &self.costs {
            Ok(report) => {
                let all = report.json();
                let costs = COSTS.into_iter().map(|key| (key.to_owned(), all[key].clone()));
                Value::Object(costs.collect())
            }
            Err(error) => json!({ "error": error.to_string() }),
        };
        json!({
            "source": self.source,
            "triangles": triangles(model),
            "vertices": model.vertices.len(),
            "low": low,
            "high": high,
            "origin": model.origin,
            "given_normals": model.notes.normals,
            "uv": has_uv(model),
            "vertex_colors": has_colors(model),
            "bytes": { "vertices": vertices, "triangles": triangles_bytes, "maps": maps },
            "parts": parts.collect::<Vec<_>>(),
            "materials": materials.collect::<Vec<_>>(),
            "board": board,
            "left_out": self.left_out,
            "warnings": self.warnings,
        })
    }
}

/// A path without `.` in it.
fn plain(path: &Path) -> String {
    path.components().filter(|part| *part != Component::CurDir).collect::<PathBuf>().display().to_string()
}

fn triangles(model: &Model) -> usize {
    model.parts.iter().map(|part| part.triangles.len()).sum()
}

/// The least and the greatest coordinates, as the file has them.
fn extents(model: &Model) -> [[f64; 3]; 2] {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for vertex in &model.vertices {
        for axis in 0..3 {
            low[axis] = low[axis].min(vertex.position[axis]);
            high[axis] = high[axis].max(vertex.position[axis]);
        }
    }
    [low, high].map(|point| [0, 1, 2].map(|axis| decimal(point[axis]) + model.origin[axis]))
}

/// A coordinate in six digits, or as many as stand before its point.
fn short(x: f64) -> String {
    let digits = if x == 0.0 { 0.0 } else { x.abs().log10().floor() };
    if !(-5.0..15.0).contains(&digits) {
        return format!("{x:.5e}");
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 10")]
    let decimals = (5.0 - digits).max(0.0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

fn normals(model: &Model) -> String {
    let all = model.vertices.len();
    match model.notes.normals {
        0 => "made".to_owned(),
        given if given == all => "given".to_owned(),
        given => format!("given for {given} of {}, else made", counted(all, "vertex", "vertices")),
    }
}

fn yes(is: bool) -> &'static str {
    if is { "yes" } else { "none" }
}

fn has_uv(model: &Model) -> bool {
    model.vertices.iter().any(|vertex| vertex.uv != [0.0; 2])
}

fn has_colors(model: &Model) -> bool {
    model.vertices.iter().any(|vertex| vertex.color != [1.0; 3])
}

/// Bytes of vertices, of triangles, and of maps without their smaller levels.
fn memory(model: &Model) -> [usize; 3] {
    let texels = |image: &Arc<Image>| size_of_val(image.texels.as_slice());
    let heights: usize = model.heights.iter().map(|image| size_of_val(image.heights.as_slice())).sum();
    let maps = model.textures.iter().map(texels).sum::<usize>() + heights;
    [model.vertices.len() * size_of::<Vertex>(), triangles(model) * size_of::<[u32; 3]>(), maps]
}

/// The line of a part.
fn told(part: &Part) -> String {
    let named = |name: &str, of: &str| (!name.is_empty()).then(|| format!("{of}{}", quote(name.as_bytes())));
    let words = [
        named(&part.name, ""),
        named(&part.material, "material "),
        Some(format!("color {}", hexadecimal(part.diffuse))),
        exponents(part).map(|range| format!("exponent {range}")),
        look(part).map(str::to_owned),
    ];
    let words = words.into_iter().flatten().collect::<Vec<_>>().join(", ");
    format!("{:>9}  {words}", part.triangles.len())
}

/// A colour as options have it.
fn hexadecimal(color: [f32; 3]) -> String {
    color.map(|c| format!("{:02x}", byte(c))).concat()
}

/// The exponent of highlights, or the range of it; nothing where no material says that there are any.
fn exponents(part: &Part) -> Option<String> {
    let [least, greatest] = part.detail.shininess;
    let range = part.detail.shininess_map.map_or_else(String::new, |_| format!("{least} to "));
    let shines = !part.material.is_empty() && part.detail.specular != [0.0; 3];
    shines.then(|| format!("{range}{greatest}"))
}

/// The way in which what is behind a part shows through it, if it does.
fn look(part: &Part) -> Option<&'static str> {
    match (part.detail.is_seen_through(), part.detail.alpha_test) {
        (false, _) => None,
        (true, 0) => Some("blended"),
        (true, _) => Some("cut out"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_six_digits() {
        let shown = [0.0, 1.0, -0.25, 1.0 / 3.0, 123_456.789, 4e6 + 0.25, 1e-7, 1e300, 0.1 + 0.2].map(short);
        let expected =
            ["0", "1", "-0.25", "0.333333", "123457", "4000000", "1.00000e-7", "1.00000e300", "0.3"];
        assert_eq!(shown, expected);
    }
}
