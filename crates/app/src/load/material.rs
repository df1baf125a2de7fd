//! What is said of a material, by the command line, a scene file or a material library, and how it comes to a part.

use crate::cli::MaterialArgs;
use crate::error::Error;
use crate::load::images::{Images, MapFile};
use crate::options::{Filter, Wrap};
use crate::scene::{
    Detail, Environment, EnvironmentKind, HeightMap, Map, NormalMap, NormalSpace, Part, Relief,
};

/// The share of an environment that is mirrored, unless it is said.
const REFLECTION: f32 = 0.5;

/// The height of white, as a share of the model's radius, unless it is said.
pub(crate) const HEIGHT: f32 = 0.02;

/// What is said; the rest is left as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Material {
    /// sRGB in 0..=1, as are the other colours.
    pub(crate) color: Option<[f32; 3]>,
    pub(crate) color_map: Option<MapFile>,
    pub(crate) normal_map: Option<MapFile>,
    pub(crate) normal_space: Option<NormalSpace>,
    pub(crate) normal_strength: Option<f32>,
    pub(crate) height_map: Option<MapFile>,
    pub(crate) relief: Option<Relief>,
    pub(crate) height_range: Option<[f32; 2]>,
    /// Multiplies the range, where that is not said.
    pub(crate) height_scale: Option<f32>,
    pub(crate) ao_map: Option<MapFile>,
    pub(crate) wetness: Option<f32>,
    pub(crate) wetness_map: Option<MapFile>,
    pub(crate) specular: Option<[f32; 3]>,
    pub(crate) specular_map: Option<MapFile>,
    pub(crate) shininess: Option<[f32; 2]>,
    pub(crate) shininess_map: Option<MapFile>,
    pub(crate) emissive: Option<[f32; 3]>,
    pub(crate) emissive_map: Option<MapFile>,
    pub(crate) environment: Option<MapFile>,
    pub(crate) environment_kind: Option<EnvironmentKind>,
    pub(crate) reflection: Option<f32>,
    pub(crate) reflection_map: Option<MapFile>,
    pub(crate) filter: Option<Filter>,
    pub(crate) wrap: Option<Wrap>,
    pub(crate) uv_scale: Option<[f32; 2]>,
}

/// What to do about an image that cannot be used: the error again, or nothing, and the surface goes without.
pub(crate) type OnError<'a> = &'a mut dyn FnMut(Error) -> Result<(), Error>;

impl Material {
    /// What the command line says of every material.
    pub(crate) fn given(arguments: &MaterialArgs) -> Self {
        let map = |path: &Option<std::path::PathBuf>| path.as_deref().map(MapFile::given);
        Self {
            normal_map: map(&arguments.normal_map),
            normal_space: arguments.normal_space,
            normal_strength: arguments.normal_strength,
            height_map: map(&arguments.height_map),
            relief: arguments.relief,
            height_range: arguments.height_range,
            ao_map: map(&arguments.ao),
            wetness_map: map(&arguments.wetness_map),
            specular: arguments.specular.map(crate::scene::shares),
            shininess: arguments.shininess,
            shininess_map: map(&arguments.shininess_map),
            environment: map(&arguments.environment),
            environment_kind: arguments.environment_kind,
            reflection: arguments.reflection,
            ..Self::default()
        }
    }

    /// Gives a part of a model of this radius what is said.
    ///
    /// # Errors
    /// Those that `on_error` passes on.
    pub(crate) fn apply(
        &self,
        part: &mut Part,
        radius: f32,
        images: &mut Images,
        on_error: OnError<'_>,
    ) -> Result<(), Error> {
        self.set_constants(part);
        let mut texture = |map: &Option<MapFile>| match map {
            None => Ok(None),
            Some(map) => read(images.texture(map), on_error).map(|image| {
                image.map(|image| Map {
                    image,
                    filter: map.filter.or(self.filter),
                    wrap: map.wrap.or(self.wrap),
                })
            }),
        };
        if let Some(map) = texture(&self.color_map)? {
            part.texture = Some(map.image);
            (part.detail.filter, part.detail.wrap) = (map.filter, map.wrap);
        }
        let detail = &mut part.detail;
        if let Some(map) = texture(&self.normal_map)? {
            // What is said of the one that was there is said of this one.
            let before = detail.normal.unwrap_or(NormalMap {
                map,
                space: NormalSpace::default(),
                strength: 1.0,
                axes: NormalMap::UNTURNED,
            });
            let (filter, wrap) = (map.filter.or(before.map.filter), map.wrap.or(before.map.wrap));
            detail.normal = Some(NormalMap { map: Map { filter, wrap, ..map }, ..before });
        }
        for (map, slot) in [
            (&self.ao_map, &mut detail.occlusion),
            (&self.wetness_map, &mut detail.wetness_map),
            (&self.shininess_map, &mut detail.shininess_map),
            (&self.reflection_map, &mut detail.reflection_map),
        ] {
            *slot = texture(map)?.or(*slot);
        }
        for (map, given, slot, constant) in [
            (&self.specular_map, self.specular, &mut detail.specular_map, &mut detail.specular),
            (&self.emissive_map, self.emissive, &mut detail.emissive_map, &mut detail.emissive),
        ] {
            if let Some(map) = texture(map)? {
                *slot = Some(map);
                *constant = given.unwrap_or([1.0; 3]);
            }
        }
        if let Some(map) = texture(&self.environment)? {
            if detail.environment.is_none() {
                detail.reflection = self.reflection.unwrap_or(REFLECTION);
            }
            let kind = detail.environment.map(|before| before.kind).unwrap_or_default();
            detail.environment = Some(Environment { image: map.image, kind });
        }
        if let Some(map) = &self.height_map
            && let Some(heights) = read(images.heights(map), on_error)?
        {
            let before = detail.height;
            let relief = self.relief.or(before.map(|height| height.relief)).unwrap_or_default();
            let scale = HEIGHT * radius * self.height_scale.unwrap_or(1.0);
            let range =
                before.map_or(self.height_range, |height| Some(height.range)).unwrap_or(match relief {
                    Relief::Bump | Relief::Displacement => [0.0, scale],
                    Relief::Parallax | Relief::ParallaxLimited | Relief::Steep | Relief::Occlusion => {
                        [-scale, 0.0]
                    }
                });
            let wrap = map.wrap.or(self.wrap).or(before.and_then(|height| height.wrap));
            detail.height = Some(HeightMap { heights, wrap, relief, range, extent: [1.0; 2] });
        }
        self.change_maps(detail);
        match detail.environment {
            Some(environment) => self.check_shape(environment, images).or_else(on_error),
            None => Ok(()),
        }
    }

    /// # Errors
    /// A cube that is none, if it is this material that says so.
    fn check_shape(&self, Environment { image, kind }: Environment, images: &Images) -> Result<(), Error> {
        let Some([width, height]) = images.size(image) else { return Ok(()) };
        let said = self.environment.is_some() || self.environment_kind.is_some();
        if !said || kind != EnvironmentKind::Cube || u64::from(height) == 6 * u64::from(width) {
            return Ok(());
        }
        let found = format!("an image of {width}x{height} texels for a cube");
        let error = Error::new(found, "six squares, one below the other, such as 64x384");
        Err(match &self.environment {
            Some(map) => map.place(error),
            None => error.place("--environment-kind"),
        })
    }

    /// Changes what is said of maps that are there.
    fn change_maps(&self, detail: &mut Detail) {
        if let Some(normal) = &mut detail.normal {
            normal.space = self.normal_space.unwrap_or(normal.space);
            normal.strength = self.normal_strength.unwrap_or(normal.strength);
        }
        if let Some(height) = &mut detail.height {
            height.relief = self.relief.unwrap_or(height.relief);
            height.range = self.height_range.unwrap_or(height.range);
        }
        if let Some(environment) = &mut detail.environment {
            environment.kind = self.environment_kind.unwrap_or(environment.kind);
        }
    }

    fn set_constants(&self, part: &mut Part) {
        if let Some(color) = self.color {
            part.diffuse = color;
        }
        let Detail { wetness, specular, shininess, emissive, reflection, .. } = &mut part.detail;
        // A map alone says all.
        *wetness = self.wetness.or(self.wetness_map.as_ref().map(|_| 1.0)).unwrap_or(*wetness);
        *specular = self.specular.unwrap_or(*specular);
        *shininess = self.shininess.unwrap_or(*shininess);
        *emissive = self.emissive.unwrap_or(*emissive);
        *reflection = self.reflection.unwrap_or(*reflection);
    }
}

fn read(image: Result<Option<usize>, Error>, on_error: OnError<'_>) -> Result<Option<usize>, Error> {
    image.or_else(|error| on_error(error).map(|()| None))
}
