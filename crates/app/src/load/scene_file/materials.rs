//! Materials of a scene file.

use super::SceneFile;
use crate::error::{Error, quote};
use crate::options::Material;

impl SceneFile {
    /// The material of that name, which stands at this path.
    ///
    /// # Errors
    /// There is none.
    pub(super) fn material(&self, name: &str, path: &str) -> Result<&Material, Error> {
        self.file.material.get(name).ok_or_else(|| {
            let known: Vec<_> = self.file.material.keys().map(String::as_str).collect();
            let expected = match known.as_slice() {
                [] => format!("a table [material.{name}]"),
                known => format!("one of {}", known.join(", ")),
            };
            self.source.error(path, format!("the unknown material {}", quote(name.as_bytes())), expected)
        })
    }

    /// The names of materials that no object has.
    pub(super) fn unused_materials(&self) -> impl Iterator<Item = &str> {
        let is_used =
            |name: &str| self.file.object.iter().any(|object| object.material.as_deref() == Some(name));
        self.file.material.keys().map(String::as_str).filter(move |name| !is_used(name))
    }

    /// The warning of a texture's alpha that its material does nothing with.
    pub(super) fn unused_alpha(&self, name: &str) -> Error {
        let path = format!("material.{name}.color-map");
        let found = "an image with alpha, which is left out";
        self.source.error(&path, found, "blend = \"over\" or alpha-test = 0.5 in the material as well")
    }

    /// Checks all materials, used or not, and finds the files that they name.
    ///
    /// # Errors
    /// A key needs another, or means nothing for its map.
    pub(super) fn complete_materials(&mut self) -> Result<(), Error> {
        // Models may have textures of their own.
        let models = self.file.object.iter().filter(|object| object.model.is_some());
        let of_models: Vec<_> = models.filter_map(|object| object.material.clone()).collect();
        for (name, material) in &mut self.file.material {
            let path = |key: &str| format!("material.{name}.{key}");
            if let Some(key) = material.unmapped_alpha().filter(|_| !of_models.contains(name)) {
                let expected = "color-map as well, whose alpha counts, or blend = \"constant:0.5\"";
                return Err(self.source.error(&path(key), "it without color-map", expected));
            }
            if let Some((key, partner)) = material.lonely() {
                let found = format!("it without {partner}");
                return Err(self.source.error(&path(key), found, format!("{partner} as well")));
            }
            for (key, what) in [
                ("height-map.filter", "another map, as heights are always read between texels"),
                ("environment.filter", "another map, as environments are always bilinear, and repeat"),
                ("environment.wrap", "another map, as environments are always bilinear, and repeat"),
            ] {
                self.source.only(&path(key), false, what)?;
            }
            for (key, map) in material.maps_mut() {
                let text = map.path.display().to_string();
                map.path = self.source.beside(&map.path);
                map.origin = Some(self.source.origin(&path(key), text));
            }
            material.whiten();
        }
        Ok(())
    }
}
