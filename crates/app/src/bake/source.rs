//! The same as the source of a Rust module: constants that lie in flash, with sizes that are known when compiling.

use std::fmt::{Display, Write as _};

use super::shape::Piece;
use super::texels::Texture;
use super::{Asset, Format};
use alberti::baked::{Attributes, TexelCode};

/// The columns of a line of numbers.
const COLUMNS: usize = 112;
/// The line before what a program may leave unused.
const UNUSED: &str = "#[allow(dead_code, reason = \"a program may need only some\")]\n";

/// The source of an asset that was made of `from`. Paths are whole, so that it may be included anywhere.
#[must_use]
pub fn source(asset: &Asset, from: &str) -> String {
    let from: String = from.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    let mut text = format!(
        "// Made by `alberti bake` of {from}: {} triangles, {} vertices.\n",
        asset.triangles(),
        asset.vertices(),
    );
    for (number, piece) in asset.pieces.iter().enumerate() {
        mesh(&mut text, asset, number, piece);
    }
    for (number, texture) in asset.textures.iter().enumerate() {
        map(&mut text, number, texture);
    }
    text
}

/// An attribute as the source has it: its part of a vertex, and the statement that makes components of that.
struct Carried {
    attribute: Attributes,
    name: &'static str,
    pattern: &'static str,
    stored: &'static str,
    varying: &'static str,
    components: String,
}

/// Those that a part's vertices carry, in the order of the varying.
fn carried(asset: &Asset, piece: &Piece) -> Vec<Carried> {
    let [u, v] = [0, 1].map(|axis| {
        let (origin, shift) = (piece.grids.origin[axis], piece.grids.shifts[axis]);
        let steps = format!("i32::from({})", ["u", "v"][axis]);
        let steps = if shift > 0 { format!("({steps} << {shift})") } else { steps };
        let sum = if origin == 0 { steps } else { format!("{origin} + {steps}") };
        format!("Q16::from_bits({sum})")
    });
    let tangent = "let ([x, y, z], handedness) = (Octahedral([x, y]).components(), i32::from(handedness));\n        \
                   let tangent = [x, y, z, Q16::from_bits(handedness << 16)];";
    let all = [
        (Attributes::TANGENT, "tangent", "[x, y, handedness]", "[i8; 3]", "Vec4", tangent.to_owned()),
        (Attributes::NORMAL, "normal", "normal", "[i8; 2]", "Vec3", {
            "let normal = Octahedral(normal).components();".to_owned()
        }),
        (Attributes::UV, "uv", "[u, v]", "[u16; 2]", "Vec2", format!("let uv = [{u}, {v}];")),
        (Attributes::COLOR, "color", "color", "[u8; 3]", "Vec3", {
            "let color = color.map(|byte: u8| Q16::from_bits(i32::from(byte) * 257));".to_owned()
        }),
    ];
    let all = all.into_iter().map(|(attribute, name, pattern, stored, varying, components)| Carried {
        attribute,
        name,
        pattern,
        stored,
        varying,
        components,
    });
    all.filter(|carried| asset.attributes.contains(carried.attribute)).collect()
}

/// A list as a tuple: one alone is itself.
fn tuple(items: &[&str]) -> String {
    match items {
        [one] => (*one).to_owned(),
        _ => format!("({})", items.join(", ")),
    }
}

/// The names that the body of a mesh's function uses, as one `use`.
fn imports(asset: &Asset, carried: &[Carried], meshlets: bool) -> String {
    let has = |attribute| asset.attributes.contains(attribute);
    let octahedral = has(Attributes::NORMAL) || has(Attributes::TANGENT);
    let bits = has(Attributes::TANGENT) || has(Attributes::UV) || has(Attributes::COLOR);
    let names = [
        ("Ball", meshlets),
        ("IntegerMesh", true),
        ("IntegerVertex", true),
        ("Meshlets", meshlets),
        ("Octahedral", octahedral),
        ("Q16", bits),
    ];
    let names: Vec<_> = names.into_iter().filter_map(|(name, used)| used.then_some(name)).collect();
    let mut vectors: Vec<_> = carried.iter().map(|c| c.varying).chain(meshlets.then_some("Vec3")).collect();
    vectors.sort_unstable();
    vectors.dedup();
    let glam = match &vectors[..] {
        [] => String::new(),
        [one] => format!("    use alberti::glam::{one};\n"),
        _ => format!("    use alberti::glam::{{{}}};\n", vectors.join(", ")),
    };
    format!("{glam}    use alberti::{{{}}};\n", names.join(", "))
}

fn mesh(text: &mut String, asset: &Asset, number: usize, piece: &Piece) {
    let carried = carried(asset, piece);
    let list = |first: &[&'static str], of: fn(&Carried) -> &'static str| {
        tuple(&first.iter().copied().chain(carried.iter().map(of)).collect::<Vec<_>>())
    };
    let (stored, pattern) = (list(&["[i16; 3]"], |c| c.stored), list(&["place"], |c| c.pattern));
    let (varying, components) = (list(&[], |c| c.varying), list(&[], |c| c.name));
    let whole: Vec<_> = carried.iter().map(|c| format!("alberti::glam::{}", c.varying)).collect();
    let whole = tuple(&whole.iter().map(String::as_str).collect::<Vec<_>>());
    let [vertices, triangles, meshlets] = [piece.vertices.len(), piece.triangles.len(), piece.meshlets.len()];
    let unit = asset.unit;
    let texture = piece.texture.map_or(String::new(), |texture| format!(", of `TEXTURE_{texture}`"));
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "\n/// The mesh of part {number}: {vertices} vertices, {triangles} triangles, meshlets: {meshlets}{texture}.\n\
         {UNUSED}pub fn mesh_{number}() -> impl alberti::Geometry<Varying = {whole}> {{\n{}    \
         let stage = |&{pattern}: &{stored}| {{\n",
        imports(asset, &carried, meshlets > 0),
    );
    for Carried { components, .. } in &carried {
        let _ = writeln!(text, "        {components}");
    }
    let _ =
        write!(text, "        IntegerVertex::<{varying}> {{ place, components: {components} }}\n    }};\n");
    let mesh = format!("IntegerMesh::new(&VERTICES_{number}, &TRIANGLES_{number}, {unit:?}, stage)");
    let _ = if meshlets == 0 {
        write!(text, "    {mesh}\n}}\n")
    } else {
        let [x, y, z] = piece.ball.center.to_array();
        write!(
            text,
            "    let mesh = {mesh};\n    \
             let ball = Ball {{ center: Vec3::new({x:?}, {y:?}, {z:?}), radius: {:?} }};\n    \
             Meshlets {{ mesh, meshlets: &MESHLETS_{number}, ball }}\n}}\n",
            piece.ball.radius
        )
    };
    let _ = write!(
        text,
        "\n/// The colour of part {number}, or a factor of its texture's.\n\
         {UNUSED}pub const COLOR_{number}: alberti::Rgba8 = alberti::Rgba8::from_bits({:#010x});\n\n",
        piece.color.to_bits()
    );
    let has = |attribute| asset.attributes.contains(attribute);
    let vertex = |v: &super::Packed| {
        let mut items = vec![format!("{:?}", v.place)];
        items.extend(has(Attributes::TANGENT).then(|| format!("{:?}", v.tangent)));
        items.extend(has(Attributes::NORMAL).then(|| format!("{:?}", v.normal)));
        items.extend(has(Attributes::UV).then(|| format!("{:?}", v.uv)));
        items.extend(has(Attributes::COLOR).then(|| format!("{:?}", v.color)));
        tuple(&items.iter().map(String::as_str).collect::<Vec<_>>())
    };
    array(text, &format!("VERTICES_{number}"), &stored, piece.vertices.iter().map(vertex));
    array(text, &format!("TRIANGLES_{number}"), "[u16; 3]", piece.triangles.iter().map(|t| format!("{t:?}")));
    if meshlets > 0 {
        let all = piece.meshlets.iter().map(|m| {
            let alberti::Meshlet { triangles, center, radius, axis, squared_sine, depths } = m;
            format!(
                "alberti::Meshlet {{\n        triangles: {triangles:?}, center: {center:?}, radius: {radius},\n        \
                 axis: {axis:?}, squared_sine: {squared_sine}, depths: {depths:?},\n    }}"
            )
        });
        array(text, &format!("MESHLETS_{number}"), "alberti::Meshlet", all);
    }
}

/// A texture, and the arrays that it refers to.
fn map(text: &mut String, number: usize, texture: &Texture) {
    let [width, height] = texture.size;
    let halves =
        |bytes: &Vec<u8>| bytes.as_chunks().0.iter().map(|&b| u16::from_le_bytes(b).to_string()).collect();
    let words =
        |bytes: &Vec<u8>| bytes.as_chunks().0.iter().map(|&b| u32::from_le_bytes(b).to_string()).collect();
    let each = |bytes: &Vec<u8>| bytes.iter().map(u8::to_string).collect();
    let chunks = |bytes: &Vec<u8>, n: usize| bytes.chunks(n).map(|chunk| format!("{chunk:?}")).collect();
    let all: Vec<u8> = texture.levels.concat();
    let (format, element, texels): (&str, &str, Vec<String>) = match texture.format.code() {
        TexelCode::Rgb565 => ("Rgb565", "u16", halves(&all)),
        TexelCode::Rgba4444 => ("Rgba4444", "u16", halves(&all)),
        TexelCode::L16 => ("L16", "u16", halves(&all)),
        TexelCode::L8 => ("L8", "u8", each(&all)),
        TexelCode::Rgb565Be => ("Rgb565Be", "[u8; 2]", chunks(&all, 2)),
        TexelCode::Rgb565Pairs => ("Rgb565Pairs", "u32", words(&all)),
        TexelCode::Rgb565Alpha => ("Rgb565Alpha", "u32", words(&all)),
        TexelCode::Rgb332 => ("Rgb332", "u8", each(&all)),
        TexelCode::Indexed1 => ("Indexed1", "u8", each(&all)),
        TexelCode::Indexed2 => ("Indexed2", "u8", each(&all)),
        TexelCode::Indexed4 => ("Indexed4", "u8", each(&all)),
        TexelCode::Indexed8 => ("Indexed8", "u8", each(&all)),
        TexelCode::Rgba8888 => ("Rgba8888", "[u8; 4]", chunks(&all, 4)),
        TexelCode::Rgb8 => ("Rgb8", "[u8; 3]", chunks(&all, 3)),
    };
    let format = format!("alberti::texture::format::{format}");
    let indexed = !texture.palette.is_empty();
    let (kind, value) = if indexed {
        (format!("{format}<'static>"), format!("{format} {{ palette: &PALETTE_{number} }}"))
    } else if texture.format == Format::Rgb565be {
        let in_bytes = "alberti::texture::format::InBytes";
        (format!("{in_bytes}<{format}>"), format!("{in_bytes}({format})"))
    } else {
        (format.clone(), format)
    };
    let known = texture.size.iter().all(|side| side.is_power_of_two()) && !indexed;
    let (view, of_size, found) = match (texture.levels.len(), known) {
        (1, true) => {
            let of_size = format!(", alberti::texture::Known<{width}, {height}>");
            ("Texture", of_size, "map.known().expect(\"the sides of its type\")")
        }
        (1, false) => ("Texture", String::new(), "map"),
        _ => ("Mipmap", String::new(), "map"),
    };
    let levels = if texture.levels.len() == 1 {
        "1 level".to_owned()
    } else {
        format!("{} levels", texture.levels.len())
    };
    let _ = write!(
        text,
        "\n/// Texture {number}, {}: {width} x {height} texels, {levels}.\n\
         {UNUSED}pub static TEXTURE_{number}: alberti::texture::{view}<\n    'static,\n    {kind}{of_size},\n> = {{\n    \
         let format = {value};\n    \
         match alberti::texture::{view}::new(format, &TEXELS_{number}, {width}, {height}) {{\n        \
         Ok(map) => {found},\n        Err(_) => panic!(\"as many texels as that takes\"),\n    }}\n}};\n\n",
        texture.role.name(),
    );
    array(text, &format!("TEXELS_{number}"), element, texels.into_iter());
    if indexed {
        let colors = texture
            .palette
            .iter()
            .map(|&color| format!("alberti::Rgba8::from_bits({:#010x})", u32::from_le_bytes(color)));
        array(text, &format!("PALETTE_{number}"), "alberti::Rgba8", colors);
    }
}

/// An array, several elements a line.
fn array(
    text: &mut String,
    name: &str,
    element: &str,
    elements: impl ExactSizeIterator<Item = impl Display>,
) {
    let _ = writeln!(text, "{UNUSED}static {name}: [{element}; {}] = [", elements.len());
    let mut line = String::new();
    for element in elements {
        let element = format!("{element},");
        if !line.is_empty() && line.len() + element.len() > COLUMNS {
            let _ = writeln!(text, "   {line}");
            line.clear();
        }
        line.push(' ');
        line.push_str(&element);
    }
    let _ = writeln!(text, "   {line}\n];");
}
