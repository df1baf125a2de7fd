//! The options of a command, those of a scene file among them, and the files that they name.

use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Command, FromArgMatches as _};

use super::told::warn;
use super::{RenderArgs, partners};
use crate::error::{Error, number};
use crate::load::scene_file::{self, SceneFile};
use crate::load::{image_file, seen};
use crate::memory;
use crate::options::values::name_of as name_of_value;
use crate::options::{Background, CameraTable, DEFAULT_OUTPUT};
use crate::output::aov::{self, Beside};
use crate::output::file::{Output, Whole};
use crate::output::stats::Source;
use crate::scene::normals::narrow;
use crate::scene::scenes;

/// The options of pictures alone, which other commands refuse.
pub(super) const OF_PICTURES: [&str; 8] =
    ["output", "output_format", "aov", "aov_format", "samples", "stats", "show", "ground"];

/// A command without some options in its help.
pub(super) fn hidden(command: Command, ids: &[&'static str]) -> Command {
    ids.iter().fold(command, |command, id| command.mut_arg(id, |option| option.hide(true)))
}

/// Refuses options of `render` that a command has not, but for a ground, which is left out: a scene file may have one
/// as well.
///
/// # Errors
/// One of them stands on the command line.
pub(super) fn refuse(matches: &ArgMatches, name: &str, ids: &[&str], reason: &str) -> Result<(), Error> {
    let given = |id: &str| matches.value_source(id) == Some(ValueSource::CommandLine);
    let ground = ids.iter().find(|id| **id == "ground" && given(id));
    if ground.is_some_and(|id| matches.get_one::<bool>(id) == Some(&true)) {
        warn(&ground_left_out(name).to_string());
    }
    match ids.iter().find(|id| **id != "ground" && given(id)) {
        None => Ok(()),
        Some(id) => {
            let found = format!("an option that `{name}` has not");
            let error = Error::new(found, "those of `render` that it uses");
            Err(error.place(format!("--{}", id.replace('_', "-"))).hint(format!("leave it out: {reason}")))
        }
    }
}

/// The warning of a ground that a command has not.
pub(super) fn ground_left_out(name: &str) -> Error {
    let error = Error::new(format!("it with {name}, which has the model alone"), "a picture");
    error.place("--ground").hint("it is left out")
}

fn refused(error: clap::Error) -> Error {
    Error::new(error.to_string(), "what --help lists")
}

/// The options, and the scene file that some of them come from.
pub(super) struct Request {
    pub(super) arguments: RenderArgs,
    pub(super) file: Option<SceneFile>,
    /// The eye and the target of the file, if the command line turns its camera.
    pub(super) orbit: Option<CameraTable>,
    /// The same at some moments of what moves, the first of which is its start.
    pub(super) moments: Vec<Request>,
}

impl Request {
    /// The options of a command that has those of [`RenderArgs`].
    ///
    /// # Errors
    /// An option that cannot be understood, here or in the scene file.
    pub(super) fn read(matches: &ArgMatches) -> Result<Self, Error> {
        let arguments = RenderArgs::from_arg_matches(matches).map_err(refused)?;
        let time = arguments.time.map_or(0.0, |time| <[f64; 1]>::from(time)[0]);
        if time < 0.0 {
            return Err(Error::new(format!("{time}"), "a number of seconds, 0 or more").place("--time"));
        }
        let named = arguments.model.as_deref().filter(|path| scene_file::is_scene(path));
        let file = named.map(|path| SceneFile::read(path, matches, time)).transpose()?;
        if arguments.time.is_some() && file.as_ref().is_none_or(|(file, _)| file.end().is_none()) {
            let error =
                Error::new("it for a scene in which nothing moves", "a scene file with [[animation]]");
            return Err(error.place("--time"));
        }
        let mut request = Self::of(arguments, file, matches)?;
        let moments = request.file.as_ref().map(SceneFile::moments).unwrap_or_default();
        let moments: Result<_, _> = moments.into_iter().map(|time| request.at(matches, time)).collect();
        request.moments = moments?;
        memory::begin(request.arguments.render.memory);
        Ok(request)
    }

    /// The same at another time, as a frame of what begins at the time 0.
    ///
    /// # Errors
    /// A value of the scene file cannot be at that time.
    pub(super) fn at(&self, matches: &ArgMatches, time: f64) -> Result<Self, Error> {
        let file = self.file.as_ref().map(|file| file.at(matches, time)).transpose()?;
        let arguments = RenderArgs::from_arg_matches(matches).map_err(refused)?;
        Self::of(arguments, file, matches)
    }

    fn of(
        mut arguments: RenderArgs,
        file: Option<(SceneFile, RenderArgs)>,
        matches: &ArgMatches,
    ) -> Result<Self, Error> {
        let (mut scene_file, mut orbit) = (None, None);
        if let Some((file, options)) = file {
            scene_file = Some(file);
            let given = arguments.camera;
            // The file's options, and over them those of the command line.
            arguments = options;
            if given.turns() || given.eye.is_some() {
                let before = arguments.camera.forget_place(&given);
                orbit = Some(before).filter(|camera| given.turns() && camera.eye.is_some());
            }
            arguments.update_from_arg_matches(matches).map_err(refused)?;
            let is_given = |id| matches.value_source(id) == Some(ValueSource::CommandLine);
            if is_given("projection") && !arguments.camera.is_parallel() && !is_given("view_height") {
                // The file's is of the projection that it has.
                arguments.camera.view_height = None;
            }
        }
        // A camera that is told, as the summary has it, may follow the options that made it.
        let last = |id: &str| matches.indices_of(id).and_then(Iterator::last);
        let is_told = ["target", "up", "fov", "near", "far"].iter().all(|id| last(id).is_some());
        if let Some(eye) = last("eye").filter(|_| is_told) {
            let CameraTable { azimuth, elevation, view, .. } = &mut arguments.camera;
            azimuth.take_if(|_| last("azimuth") < Some(eye));
            elevation.take_if(|_| last("elevation") < Some(eye));
            view.take_if(|_| last("view") < Some(eye));
        }
        // A texture is shown as it is, whatever the materials' colours.
        arguments.material.whiten();
        Ok(Self { arguments, file: scene_file, orbit, moments: Vec::new() })
    }

    /// The options of the command line alone.
    ///
    /// # Errors
    /// One that cannot be understood.
    pub(super) fn given(matches: &ArgMatches) -> Result<Self, Error> {
        RenderArgs::from_arg_matches(matches).map_err(refused).map(|arguments| Self {
            moments: Vec::new(),
            arguments,
            file: None,
            orbit: None,
        })
    }

    /// Puts an error in the scene file, if its cause is there.
    pub(super) fn relocate(&self, error: Error) -> Error {
        match &self.file {
            Some(file) => file.relocate(error),
            None => error,
        }
    }

    /// # Errors
    /// Options that do not go together.
    pub(super) fn check(&self) -> Result<(), Error> {
        let render = &self.arguments.render;
        let of_profile = render.profile.is_some() && render.arithmetic.is_none();
        let placed = |error: Error| if of_profile { error.place("--profile") } else { error };
        render.policies(self.arguments.camera.is_parallel()).0.check().map_err(placed)?;
        self.arguments.camera.check_numbers()?;
        let (times, written) =
            self.file.as_ref().map(|file| (file.moments(), file.times())).unwrap_or_default();
        let moments = self.moments.iter().zip(times);
        // Of a value that is wrong itself, others on the way to it say nothing.
        let (first, others): (Vec<_>, Vec<_>) = moments.partition(|(_, time)| written.contains(time));
        for (moment, time) in first.into_iter().chain(others) {
            let checked = moment.arguments.camera.check_moving();
            checked.map_err(|error| error.hint(format!("that is at {} s", number(narrow(time)))))?;
        }
        self.check_files()?;
        partners::check(&self.arguments)
    }

    /// # Errors
    /// An image is not there, which is told before a model is loaded.
    fn check_files(&self) -> Result<(), Error> {
        let maps = self.arguments.material.maps().into_iter().map(|(_, map)| map.path);
        let background = self.arguments.render.background.clone();
        let background = background.and_then(|mut background| background.file().cloned());
        let mut missing = maps.chain(background).filter(|path| !path.exists());
        missing.try_for_each(|path| image_file::check(&path))
    }

    /// The picture's file.
    ///
    /// # Errors
    /// It cannot be written, or is one that is also read.
    pub(super) fn output(&self) -> Result<Output, Error> {
        let render = &self.arguments.render;
        let named = render.output.as_deref().unwrap_or(Path::new(DEFAULT_OUTPUT));
        let format = render.output_format.map(name_of_value);
        let output = Output::new(named, format.as_deref())?;
        if render.background == Some(Background::Transparent) {
            output.check_alpha()?;
        }
        self.check_apart(output.name(), |input| output.is(input), "-o")?;
        Ok(output)
    }

    /// The files beside the picture, if there are some.
    ///
    /// # Errors
    /// One cannot be written, or is one that is also read.
    pub(super) fn beside(&self, output: &Output) -> Result<Option<Beside>, Error> {
        let render = &self.arguments.render;
        let Some(aovs) = render.aov.clone() else { return Ok(None) };
        let format = render.aov_format.unwrap_or_default();
        let names = aov::names(output, &aovs, format)?;
        let files = names.iter().map(|name| self.whole(name, "-o")).collect::<Result<Vec<_>, _>>()?;
        Ok(Some(Beside::new(aovs, format, files)))
    }

    /// A file that the command writes, as `option` names it.
    ///
    /// # Errors
    /// It cannot be written, or is one that is also read.
    pub(super) fn writable(&self, path: &Path, option: &str) -> Result<Output, Error> {
        let output = Output::new(path, None)?;
        self.check_apart(output.name(), |input| output.is(input), option)?;
        Ok(output)
    }

    /// The same of a file that is no picture.
    ///
    /// # Errors
    /// It cannot be written, or is one that is also read.
    pub(super) fn whole(&self, path: &Path, option: &'static str) -> Result<Whole, Error> {
        let output = Whole::new(path, option)?;
        self.check_apart(output.name(), |input| output.is(input), option)?;
        Ok(output)
    }

    /// Refuses to write what is also read.
    fn check_apart(&self, name: &Path, is: impl Fn(&Path) -> bool, option: &str) -> Result<(), Error> {
        let named = self.file.as_ref().map(SceneFile::inputs).unwrap_or_default();
        if inputs(&self.arguments).chain(named).any(|input| is(&input)) {
            return Err(seen::refused(name, option));
        }
        Ok(())
    }

    /// Whether the camera stands where all of the model is in view.
    pub(super) fn is_fitted(&self) -> bool {
        let (arguments, camera) = (&self.arguments, &self.arguments.camera);
        arguments.model.is_some() && camera.eye.is_none() && self.orbit.is_none()
    }

    /// The time of a picture of what moves; none where nothing does.
    pub(super) fn moment(&self) -> Option<f64> {
        (!self.moments.is_empty()).then(|| self.arguments.time.map_or(0.0, |time| <[f64; 1]>::from(time)[0]))
    }

    /// The origin of the triangles.
    pub(super) fn source(&self) -> Source<'_> {
        match &self.arguments.model {
            Some(path) => Source::Model(path),
            None => Source::Scene(name_of(&self.arguments)),
        }
    }
}

/// The built-in scene that is asked for.
pub(super) fn name_of(arguments: &RenderArgs) -> &str {
    let Some(given) = arguments.scene.as_deref() else {
        return scenes::NAMES.first().copied().unwrap_or_default();
    };
    scenes::NAMES.iter().copied().find(|name| name.eq_ignore_ascii_case(given)).unwrap_or(given)
}

/// All files that are read, as far as the command line names them.
fn inputs(arguments: &RenderArgs) -> impl Iterator<Item = PathBuf> {
    let maps = arguments.material.maps().into_iter().map(|(_, map)| map.path);
    let background =
        arguments.render.background.clone().and_then(|mut background| background.file().cloned());
    let named = [&arguments.model, &arguments.projector.image].into_iter().flatten().cloned();
    maps.chain(named).chain(background)
}
