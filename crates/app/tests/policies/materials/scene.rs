//! The scene: a wavy patch, and two sheets that cut through it, with a texture for each map. Sizes and texels all
//! differ, so that a map that is read in the place of another is seen.

use alberti::glam::{Vec2, Vec3};
use alberti::shaders::material::{Directional, PointLight, SpotLight, Viewer};
use alberti::texture::format::{L16, Normals, Rgba8888, Scalars};
use alberti::texture::surface::{BilinearHeights, Relief};
use alberti::texture::{Bilinear, Clamp, Repeat, Sampler, Texture, Wrap, mipmap};
use alberti::{Eye, Frame, Perspective, Point3, Rgba8, Vector3, View, World, look_at, math::srgb};
use alberti_app::options::{
    Cull, DepthFormat, Filter, LightOptions, Policies, Projection, RenderOptions, Shading, Wrap as AnyWrap,
};
use alberti_app::scene::{
    Camera, Detail, Glow, HeightImage, HeightMap, Image, Light, Map, Model, NormalMap, NormalSpace, Part,
    Relief as Kind, Vertex,
};
use std::num::NonZero;

/// Columns and rows of its pictures.
pub(crate) const SIZE: [u32; 2] = [128, 96];

pub(crate) const COLOR: usize = 0;
pub(crate) const SPECULAR: usize = 1;
pub(crate) const EMISSIVE: usize = 2;
pub(crate) const OCCLUSION: usize = 3;
pub(crate) const WETNESS: usize = 4;
pub(crate) const GLOSS: usize = 5;
pub(crate) const REFLECTION: usize = 6;
pub(crate) const NORMAL: usize = 7;
pub(crate) const LAT_LONG: usize = 8;
pub(crate) const CUBE: usize = 9;
pub(crate) const SPHERE: usize = 10;
/// The longest side is the first one's, and a power of two.
const SIDES: [[u32; 2]; 11] = [
    [64, 64],
    [24, 20],
    [18, 30],
    [32, 32],
    [36, 17],
    [48, 48],
    [40, 24],
    [28, 26],
    [32, 16],
    [6, 36],
    [16, 16],
];
pub(crate) const LONGEST_SIDE: f32 = 64.0;

/// Factors, in bytes.
pub(crate) const DIFFUSE: Rgba8 = Rgba8::new(240, 180, 220, 255);
pub(crate) const SHINE: Rgba8 = Rgba8::new(200, 150, 90, 255);
pub(crate) const GLOW: Rgba8 = Rgba8::new(40, 20, 70, 255);
pub(crate) const WET: Rgba8 = Rgba8::new(170, 170, 170, 255);
pub(crate) const MIRROR: Rgba8 = Rgba8::new(150, 150, 150, 255);
pub(crate) const EXPONENTS: [u32; 2] = [3, 24];
pub(crate) const STRENGTH: f32 = 1.5;
pub(crate) const BACKGROUND: Rgba8 = Rgba8::new(0x20, 0x30, 0x50, 255);

/// The heights' range, and their extent on the surface.
const RANGE: [f32; 2] = [-0.04, 0.06];
const EXTENT: Vec2 = Vec2::new(0.9, 1.3);
/// Columns and rows of heights.
const HEIGHTS: [u32; 2] = [16, 12];

/// A factor as files have it.
pub(crate) fn shares(color: Rgba8) -> [f32; 3] {
    let [r, g, b, _] = color.to_bytes();
    [r, g, b].map(|byte| f32::from(byte) / 255.0)
}

pub(crate) fn point<S: alberti::math::Space>(p: [f32; 3]) -> Point3<S> {
    Point3::new(Vec3::from_array(p))
}

/// A number without a pattern.
fn noise(k: u32) -> u32 {
    let mixed = (k ^ k >> 15).wrapping_mul(0x2c1b_3c6d);
    let mixed = (mixed ^ mixed >> 12).wrapping_mul(0x297a_2d39);
    mixed ^ mixed >> 15
}

pub(crate) fn image(number: usize, [width, height]: [u32; 2]) -> Image {
    let texel = |k: u32| {
        let bytes = noise(k.wrapping_mul(31).wrapping_add(number as u32 * 7919)).to_le_bytes();
        if number == NORMAL {
            // Slopes up to a half or so.
            let [x, y, z, a] = bytes;
            return [78 + x % 100, 78 + y % 100, 200 + z % 56, a];
        }
        bytes
    };
    Image { width, height, texels: (0..width * height).map(texel).collect() }
}

fn vertex(position: [f32; 3], normal: [f32; 3], uv: [f32; 2], handedness: f32) -> Vertex {
    let normal = Vec3::from_array(normal).normalize();
    let [x, y, z] = (Vec3::X - normal * normal.x).normalize().to_array();
    let color = uv.map(|c| (0.35 + 0.2 * c).clamp(0.0, 1.0));
    Vertex {
        position,
        normal: normal.to_array(),
        uv,
        color: [color[0], color[1], 1.0 - color[0]],
        tangent: [x, y, z, handedness],
    }
}

/// The patch, two cells wide and three deep.
fn patch(model: &mut Model) -> Vec<[u32; 3]> {
    let rows = [[1.3, 0.0], [0.3, 0.25], [-0.9, -0.15], [-2.6, 0.3]];
    for ([z, height], row) in rows.into_iter().zip([0.0, 1.0, 2.0, 3.0]) {
        for column in [0.0_f32, 1.0, 2.0] {
            let bend = 0.3 * (column - 1.0) - 0.2 * row;
            model.vertices.push(vertex(
                [1.6 * (column - 1.0), height * (1.0 - 0.4 * column), z],
                [bend, 1.0, 0.4 - 0.3 * row + 0.2 * column],
                [1.3 * column - 0.4, 0.9 * row - 0.3],
                if column > 1.5 { -1.0 } else { 1.0 },
            ));
        }
    }
    let cells = (0..3).flat_map(|row| (0..2).map(move |column| 3 * row + column));
    cells.flat_map(|a| [[a, a + 1, a + 4], [a, a + 4, a + 3]]).collect()
}

/// The sheets, the nearer one first.
fn sheets(model: &mut Model) -> Vec<[u32; 3]> {
    let mut triangles = vec![];
    for [x, z, lean] in [[-0.9, 0.1, 0.3], [-0.5, -0.5, -0.2]] {
        let first = model.vertices.len() as u32;
        for [across, up] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            model.vertices.push(vertex(
                [x + 1.3 * across, 1.1 * up - 0.4, z + lean * up - 0.5 * across],
                [0.3 - 0.4 * across, 0.3 * up, 1.0],
                [1.7 * across, 1.4 * up - 0.2],
                1.0,
            ));
        }
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    triangles
}

/// A map as the picture's options have it.
pub(crate) fn map(image: usize) -> Option<Map> {
    Some(Map { image, filter: None, wrap: None })
}

/// A model, a camera and options.
#[derive(Clone)]
pub(crate) struct Scene {
    pub(crate) model: Model,
    pub(crate) camera: Camera,
    pub(crate) options: RenderOptions,
}

impl Scene {
    /// One part of a colour with a highlight, under three lights.
    pub(crate) fn new() -> Self {
        let mut model = Model::default();
        let mut triangles = patch(&mut model);
        triangles.extend(sheets(&mut model));
        let mut part = Part { triangles, diffuse: shares(DIFFUSE), ..Part::default() };
        part.detail.specular = shares(SHINE);
        part.detail.shininess = EXPONENTS.map(|exponent| exponent as f32);
        model.parts.push(part);
        model.textures = (0..).zip(SIDES).map(|(number, sides)| image(number, sides).into()).collect();
        let [width, height] = HEIGHTS;
        let heights = (0..width * height).map(|k| noise(k + 77) as u16).collect();
        model.heights.push(HeightImage { width, height, heights }.into());
        model.lights = vec![
            Light::Directional { to_light: TO_SUN.to_array(), color: glow(SUN) },
            Light::Point { position: BULB_AT, color: glow(BULB), range: BULB_RANGE },
            Light::Spot {
                position: TORCH_AT,
                direction: TORCH_AXIS.to_array(),
                color: glow(TORCH),
                range: TORCH_RANGE,
                inner: TORCH_ANGLES[0],
                outer: TORCH_ANGLES[1],
            },
        ];
        model.ambient = Some(glow(AROUND));
        let camera = Camera {
            eye: [0.3, 1.5, 3.1],
            target: [0.1, 0.0, -0.4],
            up: [0.1, 1.0, 0.0],
            roll: 0.0,
            fov: 50.0,
            near: 0.5,
            far: 9.0,
        };
        let [width, height] = SIZE;
        let [r, g, b, _] = BACKGROUND.to_bytes();
        let options = RenderOptions {
            width,
            height,
            background: [r, g, b],
            shading: Shading::Blinn,
            filter: Filter::Bilinear,
            wrap: AnyWrap::Repeat,
            cull: Cull::None,
            depth: DepthFormat::F32,
            projection: Projection::Perspective,
            haze: None,
            light: LightOptions::default(),
            threads: NonZero::<usize>::MIN,
            policies: Policies::default(),
        };
        Self { model, camera, options }
    }

    /// The same with a change of the surface.
    pub(crate) fn with(mut self, change: impl FnOnce(&mut Detail)) -> Self {
        change(&mut self.model.parts[0].detail);
        self
    }

    /// The same with a change of the options.
    pub(crate) fn by(mut self, change: impl FnOnce(&mut RenderOptions)) -> Self {
        change(&mut self.options);
        self
    }

    /// The same with its texture.
    pub(crate) fn textured(mut self) -> Self {
        self.model.parts[0].texture = Some(COLOR);
        self
    }

    /// The same with a relief.
    pub(crate) fn raised(self, relief: Kind) -> Self {
        self.with(|detail| {
            let extent = EXTENT.to_array();
            detail.height = Some(HeightMap { heights: 0, wrap: None, relief, range: RANGE, extent });
        })
    }

    /// The same with a normal map.
    pub(crate) fn bent(self, space: NormalSpace, axes: [[f32; 3]; 3], strength: f32) -> Self {
        let map = Map { image: NORMAL, filter: None, wrap: None };
        self.with(|detail| detail.normal = Some(NormalMap { map, space, strength, axes }))
    }

    /// The same without lights.
    pub(crate) fn dark(mut self) -> Self {
        self.model.lights.clear();
        self.model.ambient = None;
        self
    }

    pub(crate) fn texture(&self, number: usize) -> Texture<'_, Rgba8888> {
        let Image { width, height, texels } = &*self.model.textures[number];
        Texture::new(Rgba8888, texels, *width, *height).expect("a texture")
    }

    /// A map read as by default.
    pub(crate) fn map(&self, number: usize) -> Sampler<'_, Rgba8888, Bilinear, Repeat> {
        self.texture(number).sampler(Bilinear, Repeat)
    }

    /// An image of all directions.
    pub(crate) fn lat_long(&self) -> Sampler<'_, Rgba8888, Bilinear, Repeat, Clamp> {
        self.texture(LAT_LONG).sampler_per_axis(Bilinear, Repeat, Clamp)
    }

    /// The heights.
    pub(crate) fn relief<W: Wrap>(&self, wrap: W) -> Relief<BilinearHeights<'_, L16, W>> {
        let HeightImage { width, height, heights } = &*self.model.heights[0];
        let texture = Texture::new(L16, heights, *width, *height).expect("heights");
        let ([low, high], extent) = (RANGE, EXTENT);
        Relief { map: BilinearHeights::new(texture, wrap), low, high, extent }
    }

    /// All textures with their smaller levels, as colours, numbers or normals.
    pub(crate) fn chains(&self) -> Vec<Vec<[u8; 4]>> {
        let chain = |(number, image): (usize, &Image)| {
            let Image { width, height, texels } = image;
            let mut all = texels.clone();
            all.resize(mipmap::texel_count(*width, *height), [0; 4]);
            match number {
                NORMAL => mipmap::build(Normals(Rgba8888), &mut all, *width, *height),
                OCCLUSION | WETNESS | GLOSS | REFLECTION => {
                    mipmap::build(Scalars(Rgba8888), &mut all, *width, *height)
                }
                _ => mipmap::build(Rgba8888, &mut all, *width, *height),
            }
            .expect("levels");
            all
        };
        self.model.textures.iter().map(AsRef::as_ref).enumerate().map(chain).collect()
    }

    pub(crate) fn place(&self) -> Frame<Eye, World> {
        let Camera { eye, target, up, .. } = self.camera;
        look_at(point(eye), point(target), Vector3::new(Vec3::from_array(up))).expect("a place")
    }

    pub(crate) fn view(&self) -> View<Perspective> {
        let Camera { fov, near, far, .. } = self.camera;
        alberti::Camera::at(self.place()).perspective(fov.to_radians(), near..far).expect("a view")
    }

    pub(crate) fn viewer(&self) -> Viewer {
        Viewer::at(point(self.camera.eye))
    }
}

/// Columns and rows of heights in a texel, as shares of the whole.
pub(crate) const TEXEL: Vec2 = Vec2::new(1.0 / HEIGHTS[0] as f32, 1.0 / HEIGHTS[1] as f32);

/// The axes of an object that was turned and stretched.
pub(crate) const TURNED: [[f32; 3]; 3] = [[0.0, 0.0, -0.5], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];

/// A colour and its strength.
type Amount = ([f32; 3], f32);
const SUN: Amount = ([1.0, 0.75, 0.5], 0.5);
const BULB: Amount = ([0.5, 1.0, 0.25], 0.7);
const TORCH: Amount = ([0.75, 0.5, 1.0], 1.25);
const AROUND: Amount = ([0.25, 0.5, 1.0], 0.4);
const TO_SUN: Vec3 = Vec3::new(0.48, 0.6, 0.64);
const BULB_AT: [f32; 3] = [-0.9, 0.8, 0.6];
const BULB_RANGE: f32 = 1.25;
const TORCH_AT: [f32; 3] = [1.2, 1.6, 1.0];
const TORCH_AXIS: Vec3 = Vec3::new(-0.48, -0.6, -0.64);
const TORCH_RANGE: f32 = 3.0;
const TORCH_ANGLES: [f32; 2] = [15.0, 40.0];

fn glow((color, intensity): Amount) -> Glow {
    Glow { color, intensity }
}

/// A colour's factors in a space of light.
fn amount((color, intensity): Amount, linear: bool) -> Vec3 {
    let light = |share: f32| if linear { srgb::light(share.into()) as f32 } else { share };
    Vec3::from_array(color.map(light)) * intensity
}

pub(crate) fn around(linear: bool) -> Vec3 {
    amount(AROUND, linear)
}

pub(crate) fn sun(linear: bool) -> Directional {
    Directional::new(Vector3::new(TO_SUN), amount(SUN, linear))
}

pub(crate) fn bulb(linear: bool) -> PointLight {
    let falloff = [1.0, 0.0, 1.0 / (BULB_RANGE * BULB_RANGE)];
    PointLight { position: point(BULB_AT), color: amount(BULB, linear), falloff }
}

pub(crate) fn torch(linear: bool) -> SpotLight {
    let falloff = [1.0, 0.0, 1.0 / (TORCH_RANGE * TORCH_RANGE)];
    let point = PointLight { position: point(TORCH_AT), color: amount(TORCH, linear), falloff };
    SpotLight::new(point, Vector3::new(TORCH_AXIS), TORCH_ANGLES.map(|angle| angle.to_radians().cos()))
}

/// The colour of a vertex in a space of light.
pub(crate) fn carried(v: &Vertex, linear: bool) -> Vec3 {
    amount((v.color, 1.0), linear)
}
