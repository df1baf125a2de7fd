//! Scene files: objects, materials, lights, a camera and options in TOML. The README describes the format.
//!
//! A file's options are read into the fields that the command line's words go over. An error in such an option,
//! wherever it is found, is put where the file has it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::ArgMatches;

use crate::cli::RenderArgs;
use crate::error::{Error, Warnings, number, quote};
use crate::options::{Background, Material, Shading, shared};
use crate::scene::normals::narrow;
use crate::scene::{Glow, Model};

mod animation;
mod lights;
mod materials;
mod objects;
mod source;
mod syntax;
mod tables;

use animation::Track;
pub(crate) use objects::Gathered;
pub(crate) use source::KIND;
use source::Source;
use tables::File;

#[cfg(test)]
mod tests;

/// A scene file without errors in itself. The files that it names have not been read.
#[derive(Debug)]
pub(crate) struct SceneFile {
    source: Source,
    /// As it is at a time, if something moves.
    file: File,
    tracks: Vec<Track>,
    /// The keys of options that the command line leaves to the file, by the options' names and, of files, their paths.
    keys: BTreeMap<String, String>,
}

/// Whether the name is that of a scene file.
pub(crate) fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

impl SceneFile {
    /// Reads a scene file, and its options, at a time in seconds. Those of the command line, `matches`, go over them
    /// later.
    ///
    /// # Errors
    /// The file cannot be read or has an error, which is named with its line and key.
    pub(crate) fn read(path: &Path, matches: &ArgMatches, time: f64) -> Result<(Self, RenderArgs), Error> {
        let (mut source, file) = Source::read(path)?;
        if file.object.is_empty() {
            let error = Error::new("no [[object]]", "at least one").file(path);
            return Err(error.hint("see alberti help scene-files"));
        }
        let tracks = animation::tracks(&source, &file)?;
        for (track, index) in tracks.iter().zip(0..) {
            source.stand_for(track.path(), &format!("animation[{index}].values"));
        }
        let scene = Self { source, file, tracks, keys: BTreeMap::new() };
        if scene.tracks.is_empty() { scene.complete(matches) } else { scene.at(matches, time) }
    }

    /// The same file at another time.
    ///
    /// # Errors
    /// A value of that time cannot be.
    pub(crate) fn at(&self, matches: &ArgMatches, time: f64) -> Result<(Self, RenderArgs), Error> {
        let file = self.source.changed(|file| self.tracks.iter().for_each(|track| track.write(time, file)));
        let file = file.map_err(|error| {
            let is_wrong = |track: &Track| self.source.changed(|file| track.write(time, file)).is_err();
            let index = self.tracks.iter().position(is_wrong).unwrap_or_default();
            let error = self.source.refused_at(&error, &format!("animation[{index}].values"));
            error.hint(format!("that is at {} s, by its easing", number(narrow(time))))
        })?;
        let (source, tracks) = (self.source.clone(), self.tracks.clone());
        Self { source, file, tracks, keys: BTreeMap::new() }.complete(matches)
    }

    /// # Errors
    /// Keys that do not go together.
    fn complete(mut self, matches: &ArgMatches) -> Result<(Self, RenderArgs), Error> {
        self.complete_materials()?;
        self.lights([0.0; 3])?;
        self.check_objects()?;
        let options = self.options(matches)?;
        Ok((self, options))
    }

    /// The options of the file.
    ///
    /// # Errors
    /// One is there twice.
    fn options(&mut self, matches: &ArgMatches) -> Result<RenderArgs, Error> {
        for option in shared() {
            let top = option.at_top();
            if top.is_some_and(|top| self.source.has(top)) && self.source.has(&option.key) {
                let found = "it at the top of the file as well";
                return Err(self.source.error(&option.key, found, "one of both"));
            }
            let key = top.filter(|top| self.source.has(top)).unwrap_or(&option.key);
            if self.source.has(key) && !matches.contains_id(&option.id) {
                self.keys.insert(option.option.clone(), key.to_owned());
            }
        }
        let File { size, background, output, camera, projector, render, .. } = &self.file;
        let (mut render, mut projector) = (render.clone(), projector.clone());
        render.size = render.size.or(*size);
        render.background = render.background.or_else(|| background.clone());
        render.output = render.output.or(output.as_ref().map(PathBuf::from));
        let behind = render.background.as_mut().and_then(Background::file);
        for (option, path) in [
            ("--output", render.output.as_mut()),
            ("--projector", projector.image.as_mut()),
            ("--background", behind),
        ] {
            let Some(path) = path else { continue };
            *path = self.source.beside(&path);
            if let Some(key) = self.keys.get(option).cloned() {
                self.keys.insert(path.display().to_string(), key);
            }
        }
        Ok(RenderArgs { camera: *camera, projector, render, ..RenderArgs::default() })
    }

    /// The time at which the last thing stops, if something moves.
    pub(crate) fn end(&self) -> Option<f64> {
        self.tracks.iter().map(Track::end).reduce(f64::max)
    }

    /// Whether all is at the end as it was at the start, so that a film of it goes round.
    pub(crate) fn goes_round(&self) -> bool {
        let end = self.end().unwrap_or_default();
        self.tracks.iter().all(|track| track.is_same(0.0, end))
    }

    /// The times of all values of what moves.
    pub(crate) fn times(&self) -> Vec<f64> {
        self.tracks.iter().flat_map(Track::times).collect()
    }

    /// Times at which what moves is far out: those of its values, and some between. None where nothing moves.
    pub(crate) fn moments(&self) -> Vec<f64> {
        const BETWEEN: u32 = 16;
        const MOST: usize = 64;
        let Some(end) = self.end() else { return Vec::new() };
        let between = (0..=BETWEEN).map(|k| end * f64::from(k) / f64::from(BETWEEN));
        let mut times: Vec<_> = between.chain(self.times()).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let step = times.len().div_ceil(MOST);
        times.into_iter().step_by(step).collect()
    }

    /// Whether an object is a model, and not only surfaces are.
    pub(crate) fn has_models(&self) -> bool {
        self.file.object.iter().any(|object| object.model.is_some())
    }

    /// Whether an option stands here, and not on the command line.
    pub(crate) fn has(&self, option: &str) -> bool {
        self.keys.contains_key(option)
    }

    /// Puts an error that names an option, or a file of the options, where this file has it.
    pub(crate) fn relocate(&self, error: Error) -> Error {
        let together = [
            &["--near", "--far"][..],
            &["--eye", "--target", "--up"],
            &["--projector", "--projector-eye", "--projector-target", "--projector-fov"],
            &["--projection", "--view-height"],
            &["--arithmetic", "--interpolation", "--profile"],
        ];
        let place = error.place_name().unwrap_or_default();
        let partners = together.iter().filter(|group| group.contains(&place)).copied().flatten().copied();
        match std::iter::once(place).chain(partners).find_map(|name| self.keys.get(name)) {
            // A file is told by its name.
            Some(key) if !place.starts_with("--") => {
                let named = format!("the image {}", self.source.shown(key));
                self.source.place(error.reworded(in_keys).of(&named), key)
            }
            Some(key) => self.source.place(error.reworded(in_keys), key),
            None => error,
        }
    }

    /// All objects with their materials. `over` is what the command line says of these.
    ///
    /// # Errors
    /// A file cannot be used.
    pub(crate) fn gather(
        &self,
        over: &Material,
        arguments: &RenderArgs,
        warnings: &mut Warnings,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<Gathered, Error> {
        let render = &arguments.render;
        let normals = render.normals.filter(|_| !self.keys.contains_key("--normals"));
        let gathered = self.objects(over, (render.wrap.unwrap_or_default(), normals), warnings, progress)?;
        // In all of the light a flat picture is meant.
        let is_dim = |glow: Glow| glow.intensity < 1.0;
        if render.shading != Some(Shading::Unlit)
            && self.file.light.is_empty()
            && self.ambient().is_some_and(is_dim)
        {
            let keys = ["ambient", "ambient.intensity", "ambient.color"];
            let key = keys.into_iter().find(|key| self.source.has(key)).unwrap_or_default();
            let warning = self.source.error(key, "it without a [[light]]", "a [[light]] as well");
            warnings.push(warning.hint("all sides of a surface are as bright"));
        }
        for name in self.unused_materials() {
            let path = format!("material.{name}");
            let warning = self.source.error(&path, "a material of no object", "one that an object names");
            warnings.push(
                warning.hint(format!("an [[object]] takes it by material = {}", quote(name.as_bytes()))),
            );
        }
        Ok(gathered)
    }

    /// The objects where they stand, and the lights.
    ///
    /// # Errors
    /// There are too many vertices.
    pub(crate) fn build(&self, gathered: Gathered) -> Result<Model, Error> {
        let mut model = self.placed(gathered)?;
        model.source = Some(self.source.path().to_owned());
        model.lights = self.lights(model.origin)?;
        model.ambient = self.ambient();
        Ok(model)
    }

    /// The files that it names, and itself.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        let models = self.file.object.iter().filter_map(|object| object.model.as_ref());
        let models = models.map(|name| self.source.beside(name));
        let maps = self.file.material.values().flat_map(Material::maps).map(|(_, map)| map.path);
        std::iter::once(self.source.path().to_owned()).chain(models).chain(maps).collect()
    }
}

/// A message with keys for options.
fn in_keys(message: &str) -> String {
    let options = shared();
    let is_name = |c: char| c == '-' || c.is_ascii_alphanumeric();
    let reworded = |word: &str| {
        let start = word.find(is_name).unwrap_or(word.len());
        let (before, rest) = word.split_at(start);
        let (name, after) = rest.split_at(rest.find(|c| !is_name(c)).unwrap_or(rest.len()));
        let long = if name == "-o" { "--output" } else { name };
        let option = options.iter().find(|option| option.option == long);
        let key = option.map_or(name, |option| option.at_top().unwrap_or(&option.key));
        format!("{before}{key}{after}")
    };
    message.split(' ').map(reworded).collect::<Vec<_>>().join(" ")
}
