//! Materials of a scene file.

use toml::Spanned;

use super::tables::{self, At};
use super::values::{MapEntry, Named, Text};
use super::{SceneFile, named};
use crate::error::Error;
use crate::load::images::MapFile;
use crate::load::material::Material;
use crate::scene::shares;

impl SceneFile {
    /// The material of that name.
    ///
    /// # Errors
    /// There is none, or a key of it needs another.
    pub(super) fn material(&self, name: &Spanned<String>) -> Result<Material, Error> {
        let Some(table) = self.file.material.get(name.get_ref()) else {
            let known: Vec<_> = self.file.material.keys().map(String::as_str).collect();
            let expected = match known.as_slice() {
                [] => format!("a table [material.{}]", name.get_ref()),
                known => format!("one of {}", known.join(", ")),
            };
            let found = format!("the unknown material {}", crate::error::quote(name.get_ref().as_bytes()));
            return Err(self.source.error(&name.span(), found, expected));
        };
        self.convert(table.get_ref())
    }

    /// Checks all materials, used or not.
    ///
    /// # Errors
    /// A key needs another.
    pub(super) fn check_materials(&self) -> Result<(), Error> {
        self.file.material.values().try_for_each(|table| self.convert(table.get_ref()).map(|_| ()))
    }

    fn convert(&self, table: &tables::Material) -> Result<Material, Error> {
        let tables::Material { normal_map, height_map, environment, .. } = table;
        self.needs(&table.normal_space, normal_map.is_some(), "normal-map")?;
        self.needs(&table.normal_strength, normal_map.is_some(), "normal-map")?;
        self.needs(&table.relief, height_map.is_some(), "height-map")?;
        self.needs(&table.height_range, height_map.is_some(), "height-map")?;
        self.needs(&table.environment_kind, environment.is_some(), "environment")?;
        self.needs(&table.reflection, environment.is_some(), "environment")?;
        self.needs(&table.reflection_map, environment.is_some(), "environment")?;
        for (map, has_wrap, what) in [
            (height_map, true, "another map, as heights are always read between texels"),
            (environment, false, "another map, as environments are always bilinear, and repeat"),
        ] {
            let Some(MapEntry { filter, wrap, .. }) = map.as_ref().map(Spanned::get_ref) else { continue };
            self.only(filter, false, what)?;
            self.only(wrap, has_wrap, what)?;
        }
        let color = |value: &At<Text<[u8; 3]>>| value.as_ref().map(|color| shares(color.get_ref().0));
        let map = |value: &At<MapEntry>| value.as_ref().map(|map| self.map(map));
        // A texture alone is shown as it is.
        let white = table.color_map.as_ref().map(|_| [1.0; 3]);
        Ok(Material {
            color: color(&table.color).or(white),
            color_map: map(&table.color_map),
            normal_map: map(normal_map),
            normal_space: get(&table.normal_space, named),
            normal_strength: get(&table.normal_strength, |n| n.0),
            height_map: map(height_map),
            relief: get(&table.relief, named),
            height_range: get(&table.height_range, |n| n.0),
            height_scale: None,
            ao_map: map(&table.ao_map),
            wetness: get(&table.wetness, |n| n.0),
            wetness_map: map(&table.wetness_map),
            specular: color(&table.specular),
            specular_map: map(&table.specular_map),
            shininess: get(&table.shininess, |n| n.0),
            shininess_map: map(&table.shininess_map),
            emissive: color(&table.emissive),
            emissive_map: map(&table.emissive_map),
            environment: map(environment),
            environment_kind: get(&table.environment_kind, named),
            reflection: get(&table.reflection, |n| n.0),
            reflection_map: map(&table.reflection_map),
            filter: get(&table.filter, |t| t.0),
            wrap: get(&table.wrap, |Text(Named(wrap))| *wrap),
            uv_scale: get(&table.uv_scale, |n| n.0),
        })
    }

    fn map(&self, entry: &Spanned<MapEntry>) -> MapFile {
        let MapEntry { file, filter, wrap } = entry.get_ref();
        let origin = Some(self.source.origin(file, &entry.span()));
        let (filter, wrap) = (get(filter, |t| t.0), get(wrap, named));
        MapFile { path: self.source.beside(file), origin, filter, wrap }
    }

    /// A key that does nothing without another is a mistake.
    pub(super) fn needs<T>(&self, value: &At<T>, has: bool, partner: &str) -> Result<(), Error> {
        match value {
            Some(value) if !has => {
                let found = format!("it without {partner}");
                Err(self.source.error(&value.span(), found, "both, or neither"))
            }
            _ => Ok(()),
        }
    }
}

fn get<T, U>(value: &At<T>, convert: impl Fn(&T) -> U) -> Option<U> {
    value.as_ref().map(|value| convert(value.get_ref()))
}

/// The files that a material names.
pub(super) fn maps(table: &tables::Material) -> impl Iterator<Item = &str> {
    let maps = [
        &table.color_map,
        &table.normal_map,
        &table.height_map,
        &table.ao_map,
        &table.wetness_map,
        &table.specular_map,
        &table.shininess_map,
        &table.emissive_map,
        &table.environment,
        &table.reflection_map,
    ];
    maps.into_iter().flatten().map(|map| map.get_ref().file.as_str())
}
