//! Scene files: objects, materials, lights, a camera and options in TOML. The README describes the format.
//!
//! What a file says of options goes where the command line's words go, unless the command line has said it. An error in
//! such a value, wherever it is found, is put where the file has it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::cli::RenderArgs;
use crate::error::{Error, Warnings};
use crate::load::material::Material;
use crate::scene::Model;

mod lights;
mod materials;
mod objects;
mod source;
mod tables;
mod values;

use source::Source;
use tables::{At, File};
use values::{Named, Number, Numbers, Text};

#[cfg(test)]
mod tests;

/// A scene file without errors in itself. The files that it names have not been read.
#[derive(Debug)]
pub(crate) struct SceneFile {
    source: Source,
    file: File,
    /// Where the values of options stand, under their names and, of files, their paths.
    places: BTreeMap<String, Range<usize>>,
}

/// Whether the name is that of a scene file.
pub(crate) fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

impl SceneFile {
    /// Reads a scene file.
    ///
    /// # Errors
    /// The file cannot be read or has an error, which is named with its line and key.
    pub(crate) fn read(path: &Path) -> Result<Self, Error> {
        let (source, file) = Source::read(path)?;
        let scene = Self { source, file, places: BTreeMap::new() };
        if scene.file.object.is_empty() {
            let error = Error::new("no [[object]]", "at least one").file(path);
            return Err(error.hint("the README of alberti-app describes scene files"));
        }
        scene.check_objects()?;
        Ok(scene)
    }

    /// Gives the command line what it leaves open and the file says.
    ///
    /// # Errors
    /// Something is said twice.
    pub(crate) fn fill(&mut self, arguments: &mut RenderArgs) -> Result<(), Error> {
        let File { size, background, output, camera, projector, render, .. } = &self.file;
        let source = &self.source;
        for (top, within) in [
            (size.is_some(), render.size.as_ref().map(toml::Spanned::span)),
            (background.is_some(), render.background.as_ref().map(toml::Spanned::span)),
            (output.is_some(), render.output.as_ref().map(toml::Spanned::span)),
        ] {
            if let (true, Some(at)) = (top, within) {
                return Err(source.error(&at, "it at the top of the file as well", "one of both"));
            }
        }
        let mut fill = Fill { places: &mut self.places };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
        let sides = |n: &Numbers<2, _>| (n.0[0] as u32, n.0[1] as u32);
        let point = |n: &Numbers<3>| n.0;
        let number = |n: &Number<_>| n.0;
        let beside = |name: &String| source.beside(name);
        fill.option(&mut arguments.size, size, "--size", sides);
        fill.option(&mut arguments.size, &render.size, "--size", sides);
        fill.option(&mut arguments.background, background, "--background", |t| t.0);
        fill.option(&mut arguments.background, &render.background, "--background", |t| t.0);
        fill.file(&mut arguments.output, output, "--output", beside);
        fill.file(&mut arguments.output, &render.output, "--output", beside);
        fill.option(&mut arguments.eye, &camera.eye, "--eye", point);
        fill.option(&mut arguments.target, &camera.target, "--target", point);
        fill.option(&mut arguments.up, &camera.up, "--up", point);
        fill.option(&mut arguments.fov, &camera.fov, "--fov", number);
        fill.option(&mut arguments.near, &camera.near, "--near", number);
        fill.option(&mut arguments.far, &camera.far, "--far", number);
        fill.option(&mut arguments.projection, &camera.projection, "--projection", named);
        fill.option(&mut arguments.view_height, &camera.view_height, "--view-height", number);
        fill.file(&mut arguments.projector, &projector.image, "--projector", beside);
        fill.option(&mut arguments.projector_eye, &projector.eye, "--projector-eye", point);
        fill.option(&mut arguments.projector_target, &projector.target, "--projector-target", point);
        fill.option(&mut arguments.projector_fov, &projector.fov, "--projector-fov", number);
        fill.option(&mut arguments.shading, &render.shading, "--shading", named);
        fill.option(&mut arguments.filter, &render.filter, "--filter", |t| t.0);
        fill.option(&mut arguments.wrap, &render.wrap, "--wrap", named);
        fill.option(&mut arguments.cull, &render.cull, "--cull", named);
        fill.option(&mut arguments.depth, &render.depth, "--depth", named);
        fill.option(&mut arguments.profile, &render.profile, "--profile", named);
        fill.option(&mut arguments.interpolation, &render.interpolation, "--interpolation", |t| t.0);
        fill.option(&mut arguments.numbers, &render.numbers, "--numbers", named);
        fill.option(&mut arguments.color, &render.color_format, "--color", named);
        fill.option(&mut arguments.subpixel, &render.subpixel, "--subpixel", named);
        Ok(())
    }

    /// Puts an error that names an option, or a file of the options, where this file has it.
    pub(crate) fn relocate(&self, error: Error) -> Error {
        let together = [
            &["--near", "--far"][..],
            &["--eye", "--target", "--up"],
            &["--projector", "--projector-eye", "--projector-target", "--projector-fov"],
            &["--projection", "--view-height"],
            &["--numbers", "--interpolation", "--profile"],
        ];
        let place = error.place_name().unwrap_or_default();
        let partners = together.iter().filter(|group| group.contains(&place)).copied().flatten().copied();
        match std::iter::once(place).chain(partners).find_map(|name| self.places.get(name)) {
            Some(at) => self.source.place(error.reworded(in_keys), at),
            None => error,
        }
    }

    /// All objects with their materials, where they stand, and the lights. `over` is what the command line says of
    /// materials.
    ///
    /// # Errors
    /// A file cannot be used.
    pub(crate) fn build(
        &self,
        over: &Material,
        arguments: &RenderArgs,
        warnings: &mut Warnings,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<(Model, bool), Error> {
        let (mut model, has_uv) =
            self.objects(over, arguments.wrap.unwrap_or_default(), warnings, progress)?;
        model.source = Some(self.source.path().to_owned());
        model.lights = self.lights()?;
        model.ambient = self.ambient();
        Ok((model, has_uv))
    }

    /// The files that it names, and itself.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        let models = self.file.object.iter().filter_map(|object| object.get_ref().model.as_ref());
        let maps = self.file.material.values().flat_map(|material| materials::maps(material.get_ref()));
        let names = models.map(|name| name.get_ref().as_str()).chain(maps);
        std::iter::once(self.source.path().to_owned())
            .chain(names.map(|name| self.source.beside(name)))
            .collect()
    }
}

/// What the file calls options that messages name.
const KEYS: [(&str, &str); 18] = [
    ("--projector-target", "projector.target"),
    ("--projector-eye", "projector.eye"),
    ("--projector-fov", "projector.fov"),
    ("--projector", "projector.image"),
    ("--view-height", "camera.view-height"),
    ("--projection", "camera.projection"),
    ("--target", "camera.target"),
    ("--eye", "camera.eye"),
    ("--up", "camera.up"),
    ("--fov", "camera.fov"),
    ("--near", "camera.near"),
    ("--far", "camera.far"),
    ("--interpolation", "render.interpolation"),
    ("--numbers", "render.numbers"),
    ("--profile", "render.profile"),
    ("--size", "size"),
    ("--output", "output"),
    ("-o", "output"),
];

/// A message with keys for options.
fn in_keys(message: &str) -> String {
    let is_name = |c: char| c == '-' || c.is_ascii_alphanumeric();
    let reworded = |word: &str| {
        let start = word.find(is_name).unwrap_or(word.len());
        let (before, rest) = word.split_at(start);
        let (name, after) = rest.split_at(rest.find(|c| !is_name(c)).unwrap_or(rest.len()));
        let key = KEYS.iter().find(|(option, _)| *option == name).map_or(name, |(_, key)| key);
        format!("{before}{key}{after}")
    };
    message.split(' ').map(reworded).collect::<Vec<_>>().join(" ")
}

fn named<T: Copy>(Text(Named(value)): &Text<Named<T>>) -> T {
    *value
}

/// Fills the command line's gaps.
struct Fill<'a> {
    places: &'a mut BTreeMap<String, Range<usize>>,
}

impl Fill<'_> {
    fn option<T, U>(&mut self, slot: &mut Option<U>, value: &At<T>, name: &str, convert: impl Fn(&T) -> U) {
        if let (None, Some(value)) = (&slot, value) {
            *slot = Some(convert(value.get_ref()));
            self.places.insert(name.to_owned(), value.span());
        }
    }

    fn file(
        &mut self,
        slot: &mut Option<PathBuf>,
        value: &At<String>,
        name: &str,
        beside: impl Fn(&String) -> PathBuf,
    ) {
        if let (None, Some(value)) = (&slot, value) {
            let path = beside(value.get_ref());
            self.places.insert(path.display().to_string(), value.span());
            self.places.insert(name.to_owned(), value.span());
            *slot = Some(path);
        }
    }
}
