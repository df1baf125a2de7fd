//! A surface beyond its colour and its texture: relief, highlights, reflections.

use clap::ValueEnum;

use crate::options::values::{one_of, words};
use crate::options::{Filter, Wrap};
use crate::scene::normals::narrow;
use alberti::math::srgb;
use alberti::raster::color::AnyBlend;

/// An image on a surface, and how it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Map {
    /// Index into [`Model::textures`](super::Model::textures).
    pub image: usize,
    /// `None`: the picture's.
    pub filter: Option<Filter>,
    /// `None`: the picture's.
    pub wrap: Option<Wrap>,
}

/// All of a surface but its colour and its texture. The default is a surface without relief, with a faint highlight
/// where the shading has highlights.
///
/// Where there is a map, the constant beside it is multiplied by the map: by its colour, or, for a single number, by
/// its red channel from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// The texture's filter; `None`: that of the picture.
    pub filter: Option<Filter>,
    /// The texture's wrap mode; `None`: that of the picture.
    pub wrap: Option<Wrap>,
    /// The normals.
    pub normal: Option<NormalMap>,
    /// The heights.
    pub height: Option<HeightMap>,
    /// The share of the surroundings' light that arrives: the red channel.
    pub occlusion: Option<Map>,
    /// From 0, dry, to 1.
    pub wetness: f32,
    /// Multiplies `wetness`.
    pub wetness_map: Option<Map>,
    /// The highlight's colour, sRGB in 0..=1.
    pub specular: [f32; 3],
    /// Multiplies `specular`.
    pub specular_map: Option<Map>,
    /// The highlight's exponent where the map is 0 and where it is 1; without a map it is the second.
    pub shininess: [f32; 2],
    /// From the first to the second of `shininess`.
    pub shininess_map: Option<Map>,
    /// Light of its own, sRGB in 0..=1.
    pub emissive: [f32; 3],
    /// Multiplies `emissive`.
    pub emissive_map: Option<Map>,
    /// The mirrored image.
    pub environment: Option<Environment>,
    /// The mirrored share, from 0 to 1.
    pub reflection: f32,
    /// Multiplies `reflection`.
    pub reflection_map: Option<Map>,
    /// The mixture with what is behind it; those that are mixed are drawn last, and hide nothing.
    pub blend: AnyBlend,
    /// The least alpha that is drawn, a byte: 0 for all.
    pub alpha_test: u8,
    /// Whether that is so of the image alone, and not of its smaller levels, whose alpha is a share of texels. Of those
    /// as large a share of the samples is drawn, so that narrow things do not vanish from afar.
    pub(crate) is_share: bool,
    /// Whether its file says something of highlights.
    pub shiny: bool,
    /// Whether the vertices' colours multiply its own.
    pub colored: bool,
    /// Factors by which its coordinates are still to be multiplied, and terms to be added then.
    pub(crate) placed: Option<[[f32; 2]; 2]>,
}

impl Default for Detail {
    fn default() -> Self {
        Self {
            filter: None,
            wrap: None,
            normal: None,
            height: None,
            occlusion: None,
            wetness: 0.0,
            wetness_map: None,
            specular: [0.25; 3],
            specular_map: None,
            shininess: [1.0, 32.0],
            shininess_map: None,
            emissive: [0.0; 3],
            emissive_map: None,
            environment: None,
            reflection: 0.0,
            reflection_map: None,
            blend: AnyBlend::Replace,
            alpha_test: 0,
            is_share: false,
            shiny: false,
            colored: false,
            placed: None,
        }
    }
}

impl Detail {
    /// Whether what is behind it is seen through it, everywhere or through holes.
    #[must_use]
    pub fn is_seen_through(&self) -> bool {
        self.blend != AnyBlend::Replace || self.alpha_test > 0
    }

    /// Whether the vertices' colours show: where a map needs tangents, there is no room for them.
    #[must_use]
    pub fn carries_colors(&self) -> bool {
        self.colored && !self.needs_tangents()
    }

    /// Whether it needs the vertices' tangents.
    #[must_use]
    pub fn needs_tangents(&self) -> bool {
        self.normal.is_some_and(|normal| normal.space == NormalSpace::Tangent)
            || self.height.is_some_and(|height| height.relief != Relief::Displacement)
    }

    /// Whether it has images that lie on the surface, beside the surface's own.
    pub(crate) fn has_maps(&self) -> bool {
        let maps = [
            self.occlusion,
            self.wetness_map,
            self.specular_map,
            self.shininess_map,
            self.emissive_map,
            self.reflection_map,
        ];
        self.normal.is_some() || self.height.is_some() || maps.iter().any(Option::is_some)
    }

    /// The indices of all textures but the surface's own.
    pub(crate) fn images_mut(&mut self) -> impl Iterator<Item = &mut usize> {
        let maps = [
            self.normal.as_mut().map(|normal| &mut normal.map),
            self.occlusion.as_mut(),
            self.wetness_map.as_mut(),
            self.specular_map.as_mut(),
            self.shininess_map.as_mut(),
            self.emissive_map.as_mut(),
            self.reflection_map.as_mut(),
        ];
        let environment = self.environment.as_mut().map(|environment| &mut environment.image);
        maps.into_iter().flatten().map(|map| &mut map.image).chain(environment)
    }
}

/// A normal in each texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// Red, green and blue are x, y and z, from -1 to 1.
    pub map: Map,
    /// Between which axes.
    pub space: NormalSpace,
    /// Steepness, 0 to 100: 0 makes the surface smooth, 1 leaves the map as it is.
    pub strength: f32,
    /// The object's x, y and z in the model's space, each divided by its scale, as normals are, for
    /// [`NormalSpace::Object`]: other than [`UNTURNED`](Self::UNTURNED) where a scene has placed it.
    pub axes: [[f32; 3]; 3],
}

impl NormalMap {
    /// The axes of an object that stands as it was made.
    pub const UNTURNED: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
}

/// Between which axes a map's normals are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum NormalSpace {
    /// Those of the texture on the surface: one map serves for all surfaces.
    #[default]
    Tangent,
    /// The object's own.
    Object,
}

/// A height in each texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightMap {
    /// Index into [`Model::heights`](super::Model::heights).
    pub heights: usize,
    /// The heights' wrap mode; `None`: that of the picture.
    pub wrap: Option<Wrap>,
    /// Their effect.
    pub relief: Relief,
    /// The heights of black and white along the normal, in units of object space.
    pub range: [f32; 2],
    /// The lengths of a unit of u and of v on the surface, in units of object space.
    pub extent: [f32; 2],
}

/// The effect of heights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Relief {
    /// Normals: light and shade as of the heights, on a surface that stays as it is.
    #[default]
    Bump,
    /// Normals, and textures moved by one step along the view: breaks at grazing angles.
    Parallax,
    /// The same with a step no longer than the height: does not break, but is flat at grazing angles.
    ParallaxLimited,
    /// Normals, and a march along the view to the first height below it, in 16 layers.
    Steep,
    /// The same with 32 layers and a line between the last two: smoother.
    Occlusion,
    /// Vertices moved along their normals, on a mesh that is fine enough: right up to the outline.
    Displacement,
}

/// The surroundings that a surface mirrors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Environment {
    /// Index into [`Model::textures`](super::Model::textures).
    pub image: usize,
    /// The image's layout.
    pub kind: EnvironmentKind,
}

/// The layout of an image of all directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum EnvironmentKind {
    /// Longitude to the right, latitude upwards; -z is in the middle.
    #[default]
    LatLong,
    /// Six squares, one below the other: +x, -x, +y, -y, +z, -z, each as OpenGL stores it.
    Cube,
    /// A mirror ball, as the camera sees it from the front.
    Sphere,
}

words!(one_of: NormalSpace, Relief, EnvironmentKind);

/// Heights in memory: rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeightImage {
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` heights, black 0 to white 65535.
    pub heights: Vec<u16>,
}

/// Light of a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    /// sRGB in 0..=1.
    pub color: [f32; 3],
    /// A factor, not limited to 1.
    pub intensity: f32,
}

impl Glow {
    /// The factors of what a white surface sends back: bytes, or amounts of light.
    #[must_use]
    pub fn factors(self, linear: bool) -> [f32; 3] {
        let share = |share: f32| if linear { narrow(srgb::light(share.into())) } else { share };
        self.color.map(|color| share(color) * self.intensity)
    }
}

/// A light in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// From so far away that it comes from one direction.
    Directional {
        /// Towards the light, unit length.
        to_light: [f32; 3],
        /// The light that arrives where it is whole.
        color: Glow,
    },
    /// From a point.
    Point {
        /// The place.
        position: [f32; 3],
        /// The light that arrives where it is whole.
        color: Glow,
        /// The distance at which it is half as strong: 1 / (1 + (d / range)²). Infinite: no weaker anywhere.
        range: f32,
    },
    /// From a point, within a cone.
    Spot {
        /// The place.
        position: [f32; 3],
        /// The direction, of unit length.
        direction: [f32; 3],
        /// The light that arrives where it is whole.
        color: Glow,
        /// As of a point.
        range: f32,
        /// Degrees from the axis up to which it is full.
        inner: f32,
        /// Degrees from the axis from which there is none; not below `inner`.
        outer: f32,
    },
}
