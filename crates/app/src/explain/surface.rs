//! The steps on the surface: texels, other maps, light, a projector's image, colour.

use super::report::{Block, Cell};
use super::theory::{self, Relation};
use super::{Fragment, Scene, name_of};
use crate::draw::{Light, Look, MapRead};
use crate::options::{Filter, Shading};
use alberti::Rgba8;

impl Scene<'_> {
    /// All of them.
    pub(super) fn on_surface(&self, fragment: &Fragment<'_>, look: &Look) -> Vec<Block> {
        let mut blocks = Vec::new();
        let (color, others) = match look.maps.split_first() {
            Some((first, others)) if first.name == "color-map" => (Some(first), others),
            _ => (None, &look.maps[..]),
        };
        if let Some(map) = color {
            blocks.push(texture(map, look));
        }
        if !others.is_empty() || look.height.is_some() {
            blocks.push(maps(others, look));
        }
        blocks.push(self.light(fragment, look));
        if let Some(slide) = look.slide {
            let title = "the projector's image, divided at the fragment";
            let mut block = Block::new("slide", title, &[theory::SLIDE]);
            block.values("place", "u/q and v/q", slide.place);
            match slide.color {
                Some(color) => block.value("color", "the image there", hex(color)),
                None => block.value("color", "the image there", "none: beside the image or behind it"),
            }
            blocks.push(block);
        }
        blocks
    }

    fn light(&self, fragment: &Fragment<'_>, look: &Look) -> Block {
        let relations: &'static [Relation] = match (&look.light, self.options.shading) {
            (Light::None, Shading::VertexColor) => &[theory::VERTEX_COLOR],
            (Light::None, _) => &[theory::COLOR_MAP],
            (Light::Sun { lights, .. }, _) if lights.len() == 1 => &[theory::SUNLIGHT],
            (Light::Sun { .. }, _) => &[theory::LAMPS],
            (Light::Lamps { .. }, _) => &[theory::LAMPS],
        };
        let mut block = Block::new("light", "light and colour", relations);
        match &look.light {
            Light::None => {
                block.note("none", "no light: colours are as they are");
            }
            Light::Sun { normal, lights, ambient, factor } => {
                let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
                let unit = normal.map(|x| x / length);
                let cosine = |to_light: &[f64; 3]| unit.iter().zip(to_light).map(|(a, b)| a * b).sum::<f64>();
                block.values("normal", "normal, made unit", unit);
                if let [(to_light, diffuse)] = &lights[..] {
                    block.values("to_light", "direction to the light", *to_light);
                    block.value("cosine", "cosine between them", cosine(to_light));
                    block.value("ambient", "ambient", *ambient);
                    block.value("diffuse", "diffuse, of the cosine above 0", *diffuse);
                    block.value("factor", "factor: ambient + diffuse x cosine", *factor);
                } else {
                    let row = |(to_light, diffuse): &([f64; 3], f64)| {
                        let numbers = to_light.iter().copied().chain([cosine(to_light), *diffuse]);
                        numbers.map(Cell::from).collect()
                    };
                    let columns = ["to x", "to y", "to z", "cosine", "diffuse"];
                    block.table("lights", &columns, lights.iter().map(row).collect());
                    block.value("ambient", "ambient", *ambient);
                    block.value("factor", "factor: ambient + sum of diffuse x cosine above 0", *factor);
                }
            }
            lamps @ Light::Lamps { .. } => {
                if self.options.in_linear_light() {
                    let space = "amounts of light, tone-mapped and encoded as sRGB";
                    block.value("space", "colours and lights", space);
                }
                put_lamps(&mut block, lamps);
            }
        }
        if fragment.part.texture.is_none() || look.factor != Rgba8::WHITE {
            block.value("material", "the material's colour", hex(look.factor));
        }
        block.value("color", "the fragment's colour", hex(look.bare));
        if look.color != look.bare {
            block.value("with_slide", "with the projector's image on it", hex(look.color));
        }
        block
    }
}

fn put_lamps(block: &mut Block, lamps: &Light) {
    let Light::Lamps {
        directions,
        reflectance,
        lights,
        ambient,
        openness,
        gloss,
        diffuse,
        specular,
        emission,
        scattered,
        mirrored,
    } = lamps
    else {
        return;
    };
    block.value("reflectance", "reflectance", reflectance.as_str());
    if let Some([normal, to_viewer]) = directions {
        block.values("normal", "normal, after all maps", *normal);
        block.values("to_viewer", "direction to the viewer", *to_viewer);
        let row = |light: &crate::draw::LightRead| {
            let [scattered, mirrored] = light.shares;
            let vectors = light.to_light.into_iter().chain(light.color).chain([scattered, mirrored]);
            [Cell::from(light.kind)].into_iter().chain(vectors.map(Cell::from)).collect()
        };
        let columns =
            ["light", "to x", "to y", "to z", "red", "green", "blue", "share scattered", "share mirrored"];
        if !lights.is_empty() {
            block.table("lights", &columns, lights.iter().map(row).collect());
        }
        block.values("ambient", "ambient", *ambient);
        block.value("openness", "share of the ambient that arrives", *openness);
    }
    block.values("scattered", "scattered light", *scattered);
    block.values("mirrored", "mirrored light", *mirrored);
    block.values("diffuse", "diffuse colour, after all maps", *diffuse);
    block.values("specular", "specular colour", *specular);
    block.value("gloss", "gloss, between the exponents", *gloss);
    block.values("emission", "emission and reflection", *emission);
}

/// The colour map, texel by texel.
fn texture(map: &MapRead, look: &Look) -> Block {
    let relations: &'static [Relation] = match map.filter {
        Filter::Nearest => &[theory::TEXTURE, theory::NEAREST],
        Filter::Bilinear => &[theory::TEXTURE, theory::BILINEAR],
        Filter::Trilinear | Filter::Anisotropic(_) => &[theory::TEXTURE, theory::LEVEL, theory::TRILINEAR],
    };
    let mut block = Block::new("texture", "the texture", relations);
    let [width, height] = map.size;
    block.values("size", "columns and rows", map.size);
    block.value("filter", "filter", filter(map.filter));
    block.value("wrap", "wrap", name_of(map.wrap));
    block.values("uv", "u and v", look.uv);
    block.values("place", "u W and v H", [look.uv[0] * f64::from(width), look.uv[1] * f64::from(height)]);
    if let Some(lambda) = map.lambda {
        block.value("lambda", "level of detail at which it is read", lambda);
        let probes = map.probes.len();
        block.value("probes", "places along the pixel's longer axis", probes);
        if probes > 1 {
            let row = |(number, probe): (usize, &crate::draw::ProbeRead)| {
                let [u, v] = probe.uv;
                vec![number.into(), u.into(), v.into()]
            };
            block.table("places", &["place", "u", "v"], map.probes.iter().enumerate().map(row).collect());
        }
    }
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for (number, probe) in map.probes.iter().enumerate() {
        for level in &probe.levels {
            for texel in &level.texels {
                rows.push(vec![
                    number.into(),
                    level.level.into(),
                    format!("{}x{}", level.size[0], level.size[1]).into(),
                    level.weight.into(),
                    texel.column.into(),
                    texel.row.into(),
                    texel.weight.into(),
                    hex(texel.color).into(),
                ]);
            }
        }
    }
    let columns = [
        "place",
        "level",
        "size",
        "256ths of level",
        "column",
        "row from the top",
        "65536ths of texel",
        "color",
    ];
    block.table("texels", &columns, rows);
    block.value("value", "their mean", hex(map.value));
    block
}

/// The values of the other maps.
fn maps(others: &[MapRead], look: &Look) -> Block {
    let mut block = Block::new("maps", "other maps, at the same place", &[theory::TEXTURE]);
    let row = |map: &MapRead| {
        let [width, height] = map.size;
        vec![
            map.name.into(),
            format!("{width}x{height}").into(),
            filter(map.filter).into(),
            map.lambda.into(),
            hex(map.value).into(),
        ]
    };
    let columns = ["map", "size", "filter", "level of detail", "value"];
    block.table("maps", &columns, others.iter().map(row).collect());
    if let Some(height) = look.height {
        block.value("height", "height, of 0 to 1", height);
    }
    block
}

fn filter(filter: Filter) -> String {
    match filter {
        Filter::Nearest => "nearest".to_owned(),
        Filter::Bilinear => "bilinear".to_owned(),
        Filter::Trilinear => "trilinear".to_owned(),
        Filter::Anisotropic(probes) => format!("anisotropic:{}", probes.count()),
    }
}

/// Red, green, blue and alpha.
fn hex(color: Rgba8) -> String {
    let [r, g, b, a] = color.to_bytes();
    format!("#{r:02x}{g:02x}{b:02x}{a:02x}")
}
