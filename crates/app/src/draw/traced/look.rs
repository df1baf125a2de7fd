//! The way of a fragment's numbers to a colour: what its maps gave, and its lights.

use super::reads::{Levels, MapRead, Way, read, word};
use super::{Attributes, Dressed, Surface};
use crate::draw::maps::{any_heights, any_map};
use crate::draw::{Drawing, color};
use crate::options::Shading;
use crate::scene::{self, Part, Relief};
use alberti::lanes::Lanes;
use alberti::raster::Gradient;
use alberti::shaders::Map as _;
use alberti::shaders::material::{AnyLight, AnyReflectance, Framed, Light as _, Reflectance as _};
use alberti::texture::format::Content;
use alberti::texture::surface::HeightMap as _;
use alberti::{FragmentStage as _, Fragments, Homogeneous, Rgba8};

/// A fragment on its surface.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    /// Its colour.
    pub(crate) color: Rgba8,
    /// The colour before a projector's image fell on it.
    pub(crate) bare: Rgba8,
    /// The factor of the texture, or the colour without one.
    pub(crate) factor: Rgba8,
    /// The place at which maps are read; beside it is the fragment's own.
    pub(crate) uv: [f64; 2],
    /// The colour map, if there is one, before all others.
    pub(crate) maps: Vec<MapRead>,
    /// The height that its map gives there, from 0 to 1.
    pub(crate) height: Option<f64>,
    pub(crate) light: Light,
    pub(crate) slide: Option<SlideRead>,
}

/// The light on a fragment.
#[derive(Clone, Debug)]
pub(crate) enum Light {
    /// None is asked for: the colours are as they are.
    None,
    /// White light of a model without lights: each one's direction and strength.
    Sun { normal: [f64; 3], lights: Vec<([f64; 3], f64)>, ambient: f64, factor: f64 },
    /// Lights by fragment, or as they were found at the vertices and interpolated.
    Lamps {
        /// The normal and the direction to the viewer; none at the vertices.
        directions: Option<[[f64; 3]; 2]>,
        reflectance: String,
        lights: Vec<LightRead>,
        ambient: [f64; 3],
        openness: f64,
        gloss: f64,
        diffuse: [f64; 3],
        specular: [f64; 3],
        emission: [f64; 3],
        scattered: [f64; 3],
        mirrored: [f64; 3],
    },
}

/// A light as it arrives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightRead {
    pub(crate) kind: &'static str,
    pub(crate) to_light: [f64; 3],
    pub(crate) color: [f64; 3],
    /// The shares that are scattered and mirrored.
    pub(crate) shares: [f64; 2],
}

/// A projector's image as it was read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlideRead {
    /// u/q and v/q.
    pub(crate) place: [f64; 2],
    /// The colour there; none beside the image.
    pub(crate) color: Option<Rgba8>,
}

impl Drawing<'_> {
    /// The way of numbers to a colour on a surface.
    pub(super) fn look_by<L: Lanes>(
        &self,
        lanes: L,
        part: &Part,
        dressed: &Dressed<'_>,
        fragments: &Fragments<L, Attributes>,
    ) -> Look {
        let framed = fragments.part::<Framed>(|(_, framed)| *framed);
        let shown = &dressed.shown;
        let (bare, _) = shown.surface.shade(&framed);
        let (all, _) = shown.shade(fragments);
        let gradient = framed.gradient.map(|framed| framed.uv);
        let (uv, light) = self.light(lanes, dressed, &framed);
        Look {
            color: Rgba8::from_bits(word(lanes, all)),
            bare: Rgba8::from_bits(word(lanes, bare)),
            factor: color(part.diffuse),
            uv: uv.map(|x| number(lanes, x)),
            maps: self.maps(lanes, part, dressed, (uv, gradient)),
            height: self.height(lanes, part, dressed, uv),
            light,
            slide: shown.image.map(|image| {
                let ([u, v], inside) = Homogeneous::divide_lanes(lanes, &fragments.varying.0);
                let half = lanes.splat(0.5);
                let texel = image.sample_lanes(lanes, u * half + half, v * half + half);
                let inside = lanes.bits(inside) & 1 != 0;
                let color = inside.then(|| Rgba8::from_bits(word(lanes, texel)));
                SlideRead { place: [u, v].map(|x| number(lanes, x)), color }
            }),
        }
    }

    /// The maps that the surface reads, the colour's first.
    fn maps<L: Lanes>(
        &self,
        lanes: L,
        part: &Part,
        dressed: &Dressed<'_>,
        at: ([L::Number; 2], Gradient<[L::Number; 2]>),
    ) -> Vec<MapRead> {
        let (uv, gradient) = at;
        let options = self.options;
        let way = |name, map: scene::Map| Way {
            name,
            filter: map.filter.unwrap_or(options.filter),
            wrap: map.wrap.unwrap_or(options.wrap),
        };
        match &dressed.shown.surface {
            Surface::Colors => Vec::new(),
            Surface::Unlit(_) | Surface::Lit(_) => {
                let skin = self.skin(part);
                let read = |map: super::super::maps::FlatMap<'_>| {
                    let value = Rgba8::from_bits(word(lanes, map.read(lanes, uv, &gradient)));
                    let way = Way { name: "color-map", filter: options.filter, wrap: options.wrap };
                    read(lanes, way, Levels::Flat(map.0.texture()), at, value)
                };
                skin.map.map(read).into_iter().collect()
            }
            surface => {
                let by_vertex = matches!(surface, Surface::ByVertex(_));
                let read = |(name, map, content): (&'static str, Option<scene::Map>, Content)| {
                    let of = any_map(self.model, &self.studio.chains, options, map?, content)?;
                    let value = Rgba8::from_bits(word(lanes, of.read(lanes, uv, &gradient)));
                    Some(read(lanes, way(name, map?), Levels::Mipmap(*of.0.mipmap()), at, value))
                };
                used_maps(part, options.shading, by_vertex).into_iter().filter_map(read).collect()
            }
        }
    }

    /// The height that its map gives.
    fn height<L: Lanes>(
        &self,
        lanes: L,
        part: &Part,
        dressed: &Dressed<'_>,
        uv: [L::Number; 2],
    ) -> Option<f64> {
        let height = part.detail.height.filter(|height| height.relief != Relief::Displacement)?;
        let Surface::ByFragment(_) = &dressed.shown.surface else { return None };
        let image = self.model.heights.get(height.heights)?;
        let (map, _) = any_heights(image, height.wrap.unwrap_or(self.options.wrap))?;
        Some(number(lanes, map.height_lanes(lanes, uv)))
    }

    /// The light, and the place at which maps are read.
    fn light<L: Lanes>(
        &self,
        lanes: L,
        dressed: &Dressed<'_>,
        framed: &Fragments<L, Framed>,
    ) -> ([L::Number; 2], Light) {
        let three = |v: [L::Number; 3]| v.map(|x| number(lanes, x));
        let (uv, axes) = (framed.varying.uv, framed.varying.axes);
        match &dressed.shown.surface {
            Surface::Colors | Surface::Unlit(_) => (uv, Light::None),
            Surface::Lit(sunlit) => {
                let light = Light::Sun {
                    normal: three(axes[2]),
                    lights: self
                        .rig
                        .shining()
                        .map(|(to, strength)| (to.as_dvec3().normalize_or_zero().to_array(), strength.into()))
                        .collect(),
                    ambient: self.rig.ambient.into(),
                    factor: number(lanes, sunlit.light(lanes, axes[2])),
                };
                (uv, light)
            }
            Surface::ByFragment(material) => {
                let surface = material.surface(framed);
                let lighting = &material.surface.lighting;
                let shine = |light: &AnyLight| {
                    let arrives = light.fold(lanes, surface.position, None, |_, to, color| Some((to, color)));
                    let (to_light, color) = arrives?;
                    let shares = lighting.reflectance.shares(
                        lanes,
                        surface.normal,
                        to_light,
                        surface.to_viewer,
                        surface.gloss,
                    );
                    Some(LightRead {
                        kind: kind(light),
                        to_light: three(to_light),
                        color: three(color),
                        shares: shares.map(|x| number(lanes, x)),
                    })
                };
                let lights: Vec<LightRead> = lighting.lights.iter().filter_map(shine).collect();
                let sum = |share: usize| {
                    let of = |k: usize| lights.iter().map(|light| light.color[k] * light.shares[share]).sum();
                    [of(0), of(1), of(2)]
                };
                let light = Light::Lamps {
                    directions: Some([three(surface.normal), three(surface.to_viewer)]),
                    reflectance: name(lighting.reflectance.0),
                    ambient: lighting.ambient.as_dvec3().to_array(),
                    openness: number(lanes, surface.openness),
                    gloss: number(lanes, surface.gloss),
                    diffuse: three(surface.diffuse),
                    specular: three(surface.specular),
                    emission: three(surface.emission),
                    scattered: sum(0),
                    mirrored: sum(1),
                    lights,
                };
                (surface.uv, light)
            }
            Surface::ByVertex(gouraud) => {
                let surface = gouraud.surface(&framed.part(|framed| {
                    let [scattered, mirrored, _] = framed.axes;
                    (scattered, (mirrored, framed.uv))
                }));
                let light = Light::Lamps {
                    directions: None,
                    reflectance: "at the vertices".to_owned(),
                    lights: Vec::new(),
                    ambient: [0.0; 3],
                    openness: 1.0,
                    gloss: number(lanes, surface.gloss),
                    diffuse: three(surface.diffuse),
                    specular: three(surface.specular),
                    emission: three(surface.emission),
                    scattered: three(axes[0]),
                    mirrored: three(axes[1]),
                };
                (surface.uv, light)
            }
        }
    }
}

/// The images of a part that its layers read, and what their texels stand for.
fn used_maps(
    part: &Part,
    shading: Shading,
    by_vertex: bool,
) -> [(&'static str, Option<scene::Map>, Content); 8] {
    let detail = &part.detail;
    let if_so = |used: bool, map: Option<scene::Map>| map.filter(|_| used);
    let highlights = matches!(shading, Shading::Phong | Shading::Blinn | Shading::Gouraud);
    [
        ("color-map", part.color_map(), Content::Srgb),
        ("normal-map", if_so(!by_vertex, detail.normal.map(|normal| normal.map)), Content::Normals),
        ("specular-map", if_so(highlights, detail.specular_map), Content::Srgb),
        ("shininess-map", detail.shininess_map, Content::Scalars),
        ("wetness-map", if_so(detail.wetness > 0.0, detail.wetness_map), Content::Scalars),
        ("ao-map", if_so(!by_vertex, detail.occlusion), Content::Scalars),
        ("emissive-map", if_so(detail.emissive != [0.0; 3], detail.emissive_map), Content::Srgb),
        (
            "reflection-map",
            if_so(!by_vertex && detail.environment.is_some(), detail.reflection_map),
            Content::Scalars,
        ),
    ]
}

fn kind(light: &AnyLight) -> &'static str {
    match light {
        AnyLight::Directional(_) => "directional",
        AnyLight::Point(_) => "point",
        AnyLight::Spot(_) => "spot",
    }
}

fn name(reflectance: AnyReflectance) -> String {
    match reflectance {
        AnyReflectance::Lambert => "lambert".to_owned(),
        AnyReflectance::Phong([least, greatest]) => format!("phong, exponent {least} to {greatest}"),
        AnyReflectance::BlinnPhong([least, greatest]) => format!("blinn, exponent {least} to {greatest}"),
    }
}

/// The first of numbers, exactly.
pub(super) fn number<L: Lanes>(lanes: L, x: L::Number) -> f64 {
    if L::FIXED {
        return f64::from(word(lanes, lanes.floor_scaled(x, 16)).cast_signed()) / 65536.0;
    }
    lanes.store(x).as_ref().first().map_or(0.0, |x: &f32| f64::from(*x))
}
