//! The materials of parts, as layers that are there or not at run time, under lights of any kind. Which they are is
//! asked for the samples that are worked on together; the colours are those of the library's layers.

use super::color;
use super::lamps::{Lamps, environment, parallax};
use super::maps::{AnyHeights, AnyMap, Chains, FlatMap, Scaled, any_heights, any_map, surroundings};
use crate::options::{RenderOptions, Shading};
use crate::scene::{self, Model, NormalSpace, Part};
use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::lanes::Lanes;
use alberti::raster::PerPixel;
use alberti::shaders::material::{
    AnyLight, AnyReflectance, Bump, Color, Emission, Framed, Gloss, Grazing, Layer, Lighting, Material,
    NormalMap, ObjectNormals, Occlusion, Parallax, Reflection, Specular, Surface, Wetness,
};
use alberti::texture::environment::AnyEnvironment;
use alberti::texture::format::Content;
use alberti::texture::surface::{AnyParallax, CentralDifferences, NormalEncoding::Unorm, Relief};
use alberti::{Eye, Frame, Point3, Varying, World};

/// How a surface reflects: highlights have no edge where the light comes from behind.
pub(super) type Shine = Grazing<AnyReflectance>;

/// The layers of a part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Painted<'a> {
    parallax: Option<Parallax<AnyHeights<'a>, AnyParallax>>,
    normal: Facing<'a>,
    color: Color<Scaled<AnyMap<'a>>>,
    /// Whether the vertices' colours, carried instead of the first axis, multiply that.
    colored: bool,
    specular: Option<Specular<Scaled<AnyMap<'a>>>>,
    gloss: Option<Gloss<AnyMap<'a>>>,
    wetness: Option<Wetness<Scaled<AnyMap<'a>>>>,
    occlusion: Option<Occlusion<AnyMap<'a>>>,
    emission: Option<Emission<Scaled<AnyMap<'a>>>>,
    reflection: Option<Reflection<AnyEnvironment, FlatMap<'a>, Scaled<AnyMap<'a>>>>,
}

/// The source of its normals.
#[derive(Clone, Copy, Debug)]
enum Facing<'a> {
    AsVertices,
    Tangent(NormalMap<AnyMap<'a>>),
    Object(ObjectNormals<AnyMap<'a>>),
    Bump(Bump<CentralDifferences<AnyHeights<'a>>>),
}

/// The order of layers with light by vertex: without those that need a place or a frame.
impl Layer<Vec2> for Painted<'_> {
    type Derivatives = PerPixel;

    #[inline(always)]
    fn apply<L: Lanes>(&self, lanes: L, uv: &[L::Number; 2], surface: &mut Surface<L>) {
        Layer::<Vec2>::apply(&self.color, lanes, uv, surface);
        Layer::<Vec2>::apply(&self.specular, lanes, uv, surface);
        Layer::<Vec2>::apply(&self.gloss, lanes, uv, surface);
        Layer::<Vec2>::apply(&self.wetness, lanes, uv, surface);
        Layer::<Vec2>::apply(&self.emission, lanes, uv, surface);
    }
}

impl Layer<Framed> for Painted<'_> {
    type Derivatives = PerPixel;

    #[inline(always)]
    fn apply<L: Lanes>(
        &self,
        lanes: L,
        varyings: &<Framed as Varying>::Of<L::Number>,
        surface: &mut Surface<L>,
    ) {
        Layer::<Framed>::apply(&self.parallax, lanes, varyings, surface);
        match &self.normal {
            Facing::AsVertices => {}
            Facing::Tangent(layer) => Layer::<Framed>::apply(layer, lanes, varyings, surface),
            Facing::Object(layer) => Layer::<Framed>::apply(layer, lanes, varyings, surface),
            Facing::Bump(layer) => Layer::<Framed>::apply(layer, lanes, varyings, surface),
        }
        Layer::<Vec2>::apply(self, lanes, &{ surface.uv }, surface);
        if self.colored {
            let [[r, g, b], ..] = varyings.axes;
            let [red, green, blue] = surface.diffuse;
            surface.diffuse = [red * r, green * g, blue * b];
        }
        Layer::<Framed>::apply(&self.occlusion, lanes, varyings, surface);
        Layer::<Framed>::apply(&self.reflection, lanes, varyings, surface);
    }
}

impl<'a> Painted<'a> {
    /// The layers of a part, in a picture with these options, seen from a frame with these axes.
    pub(super) fn new(
        part: &Part,
        model: &'a Model,
        chains: &'a Chains,
        options: &RenderOptions,
        camera: Frame<Eye, World>,
    ) -> Self {
        let detail = &part.detail;
        let map = |map: scene::Map, content| any_map(model, chains, options, map, content);
        let numbers = |of: Option<scene::Map>| of.and_then(|of| map(of, Content::Scalars));
        let colors = |of: Option<scene::Map>| of.and_then(|of| map(of, Content::Srgb));
        let scaled = |factor: [f32; 3], map| Scaled { factor: color(factor), map };

        let relief = detail.height.and_then(|height| {
            let image = model.heights.get(height.heights)?;
            let [low, high] = height.range;
            let (map, texel) = any_heights(image, height.wrap.unwrap_or(options.wrap))?;
            Some((height.relief, texel, Relief { map, low, high, extent: Vec2::from_array(height.extent) }))
        });
        let parallax =
            relief.and_then(|(kind, _, relief)| Some(Parallax { relief, policy: parallax(kind)? }));
        let own = detail.normal.and_then(|normal| {
            let map = map(normal.map, Content::Normals)?;
            Some(match normal.space {
                NormalSpace::Tangent => {
                    Facing::Tangent(NormalMap { map, encoding: Unorm, strength: normal.strength })
                }
                NormalSpace::Object => Facing::Object(ObjectNormals {
                    map,
                    encoding: Unorm,
                    to_world: Frame::from_mat3(
                        Mat3::from_cols_array_2d(&normal.axes),
                        Point3::new(Vec3::ZERO),
                    ),
                }),
            })
        });
        let bump = relief.filter(|(kind, ..)| *kind != scene::Relief::Displacement);
        let normal = own.or(bump.map(|(_, step, relief)| {
            // Over a texel: the heights' own slopes jump between texels, which shows where these are large.
            let map = CentralDifferences { map: relief.map, step };
            Facing::Bump(Bump(Relief { map, low: relief.low, high: relief.high, extent: relief.extent }))
        }));
        let reflection = detail.environment.and_then(|of| {
            let image = model.textures.get(of.image)?;
            Some(Reflection {
                environment: environment(of.kind, image, camera),
                image: surroundings(of.kind, image)?,
                strength: scaled([detail.reflection; 3], numbers(detail.reflection_map)),
                facing: 1.0,
            })
        });
        let highlights = matches!(options.shading, Shading::Phong | Shading::Blinn | Shading::Gouraud);
        Self {
            parallax,
            normal: normal.unwrap_or(Facing::AsVertices),
            color: Color(scaled(part.diffuse, colors(part.color_map()))),
            colored: detail.carries_colors() && options.shading != Shading::Gouraud,
            specular: highlights.then(|| Specular(scaled(detail.specular, colors(detail.specular_map)))),
            gloss: numbers(detail.shininess_map).map(Gloss),
            wetness: (detail.wetness > 0.0)
                .then(|| Wetness(scaled([detail.wetness; 3], numbers(detail.wetness_map)))),
            occlusion: numbers(detail.occlusion).map(|map| Occlusion { map, strength: 1.0 }),
            emission: (detail.emissive != [0.0; 3])
                .then(|| Emission(scaled(detail.emissive, colors(detail.emissive_map)))),
            reflection,
        }
    }

    /// Under a picture's lights.
    pub(super) fn lit(
        self,
        shading: Shading,
        exponents: [f32; 2],
        lamps: &'a Lamps,
    ) -> Material<Self, &'a [AnyLight], Shine> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
        let exponents = exponents.map(|exponent| (exponent + 0.5) as u32);
        let reflectance = match shading {
            Shading::Phong => AnyReflectance::Phong(exponents),
            Shading::Blinn | Shading::Gouraud => AnyReflectance::BlinnPhong(exponents),
            _ => AnyReflectance::Lambert,
        };
        let (ambient, lights) = match shading {
            Shading::Unlit | Shading::VertexColor => (Vec3::ONE, &[][..]),
            _ => (lamps.ambient, &lamps.lights[..]),
        };
        Material {
            layers: self,
            lighting: Lighting { viewer: lamps.viewer, ambient, lights, reflectance: Grazing(reflectance) },
        }
    }
}
