//! Materials on parts, whether from the command line, a scene file or a material library.

use crate::error::Error;
use crate::load::images::Images;
use crate::options::values::{Color, Shininess};
use crate::options::{Blend, DEFAULT_HEIGHT, DEFAULT_REFLECTION, MapFile, Material, byte};
use crate::scene::{
    Detail, Environment, EnvironmentKind, HeightMap, Map, NormalMap, NormalSpace, Part, Relief,
};

/// The answer to an image that cannot be used: the error again, or nothing, and the surface goes without.
pub(crate) type OnError<'a> = &'a mut dyn FnMut(Error) -> Result<(), Error>;

impl Material {
    /// Gives this material to a part of a model of this radius.
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
        let mut texture = |map: &Option<MapFile>, about: &'static str| match map {
            None => Ok(None),
            Some(map) => {
                read(images.texture(map).map_err(|error| error.about(about)), on_error).map(|image| {
                    image.map(|image| Map {
                        image,
                        filter: map.filter.or(self.filter),
                        wrap: map.wrap.or(self.wrap),
                    })
                })
            }
        };
        if let Some(map) = texture(&self.color_map, "color-map")? {
            part.texture = Some(map.image);
            (part.detail.filter, part.detail.wrap) = (map.filter, map.wrap);
        }
        let detail = &mut part.detail;
        if let Some(map) = texture(&self.normal_map, "normal-map")? {
            // The settings of the map that was there are kept for this one.
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
            *slot = texture(map, "")?.or(*slot);
        }
        for (map, given, slot, constant) in [
            (&self.specular_map, self.specular, &mut detail.specular_map, &mut detail.specular),
            (&self.emissive_map, self.emissive, &mut detail.emissive_map, &mut detail.emissive),
        ] {
            if let Some(map) = texture(map, "")? {
                *slot = Some(map);
                *constant = given.map_or([1.0; 3], |Color(color)| color);
            }
        }
        if let Some(map) = texture(&self.environment, "environment")? {
            if detail.environment.is_none() {
                detail.reflection = self.reflection.map_or(DEFAULT_REFLECTION, f32::from);
            }
            let kind = detail.environment.map(|before| before.kind).unwrap_or_default();
            detail.environment = Some(Environment { image: map.image, kind });
        }
        if let Some(map) = &self.height_map
            && let Some(heights) = read(images.heights(map), on_error)?
        {
            let before = detail.height;
            let relief = self.relief.or(before.map(|height| height.relief)).unwrap_or_default();
            let scale = DEFAULT_HEIGHT * radius * self.height_scale.unwrap_or(1.0);
            let range = before
                .map_or(self.height_range.map(Into::into), |height| Some(height.range))
                .unwrap_or(match relief {
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

    /// Changes the settings of maps that are there.
    fn change_maps(&self, detail: &mut Detail) {
        if let Some(normal) = &mut detail.normal {
            normal.space = self.normal_space.unwrap_or(normal.space);
            normal.strength = self.normal_strength.map_or(normal.strength, f32::from);
        }
        if let Some(height) = &mut detail.height {
            height.relief = self.relief.unwrap_or(height.relief);
            height.range = self.height_range.map_or(height.range, Into::into);
        }
        if let Some(environment) = &mut detail.environment {
            environment.kind = self.environment_kind.unwrap_or(environment.kind);
        }
    }

    fn set_constants(&self, part: &mut Part) {
        if let Some(Color(color)) = self.color {
            part.diffuse = color;
        }
        let Detail {
            wetness,
            specular,
            shininess,
            emissive,
            reflection,
            blend,
            alpha_test,
            is_share,
            shiny,
            ..
        } = &mut part.detail;
        let none = self.specular == Some(Color([0.0; 3]));
        *shiny = !none && (*shiny || self.specular.is_some() || self.shininess.is_some());
        // A map alone says all.
        let mapped = if self.wetness_map.is_some() { 1.0 } else { *wetness };
        *wetness = self.wetness.map_or(mapped, f32::from);
        *specular = self.specular.map_or(*specular, |Color(color)| color);
        *shininess = self.shininess.map_or(*shininess, |Shininess(pair)| pair);
        *emissive = self.emissive.map_or(*emissive, |Color(color)| color);
        *reflection = self.reflection.map_or(*reflection, f32::from);
        *blend = self.blend.map_or(*blend, |Blend(blend)| blend);
        *is_share &= self.alpha_test.is_none();
        *alpha_test = self.alpha_test.map_or(*alpha_test, |least| byte(least.into()));
    }
}

fn read(image: Result<Option<usize>, Error>, on_error: OnError<'_>) -> Result<Option<usize>, Error> {
    image.or_else(|error| on_error(error).map(|()| None))
}
