//! `alberti view`: a window on a scene, whose picture follows keys, the mouse and the files.
//!
//! Its picture is that of a command line: of the words that it was opened with, of options that keys have chosen, and
//! of the camera as options. A picture that is kept is therefore one of `render`, with options that can be typed.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{ArgMatches, ValueEnum as _};

use super::bake::name as stem;
use super::request::Request;
use super::run::{draw, print};
use super::staged::{Cast, Staged};
use crate::error::Error;
use crate::load::scene_file::SceneFile;
use crate::load::{input, seen};
use crate::options::values::name_of;
use crate::options::{CameraTable, Projection, ProjectionKind};
use crate::output::stats::Source;
use crate::scene::camera::{self, Sight, as_options};
use crate::scene::normals::narrow;
use crate::scene::{Camera, Image};
use crate::show::Show;

mod keys;
mod line;
mod orbit;
mod overlay;
mod scene;
mod window;

use keys::{ALL, Action, Cycle, Keeps, Place};
use line::{Chosen, end_of_options, matches_of, typed, unused, words_of};
use orbit::Orbit;
use scene::{Kept, Scene, Seen, wishes_of};

pub(super) const HELP: &str = "\
Examples:
  alberti view cow.obj --texture cow.png      a window: drag turns, the wheel zooms, H lists the keys
  alberti view wet.toml --ground              drawn again whenever wet.toml, a model or an image changes
  alberti view clock.toml                     Space plays what [[animation]] moves
  alberti view --scene floor -o floor.png     P keeps the picture in floor.png instead of in floor-1.png,
                                              floor-2.png and so on, and prints its command";

/// The size of a window for which none is asked, nor one in the scene file, on a display whose scale is 1.
const SIZE: [u32; 2] = [960, 640];

/// Opens a window, until it is closed.
///
/// # Errors
/// The scene cannot be used, or there is no display.
pub(super) fn run(matches: &ArgMatches, words: &[OsString]) -> Result<(), Error> {
    let given = Request::given(matches)?.arguments;
    if given.model.as_deref() == Some(Path::new(input::STDIN)) {
        let error = Error::new("standard input", "a file to look at").hint("it is read but once");
        return Err(error);
    }
    if given.render.output.as_deref() == Some(Path::new(input::STDIN)) {
        let error = Error::new("standard output", "a file for pictures that are kept").place("--output");
        return Err(error);
    }
    let request = Request::read(matches)?;
    if given.render.output.is_some() {
        // Before the window, and not with the first picture that is kept.
        request.output().map_err(|error| request.relocate(error))?;
    }
    let asked = request.arguments.render.size.map(|size| [size.0, size.1]);
    let mut viewer = Viewer::new(words.get(2..).unwrap_or_default(), asked.unwrap_or(SIZE))?;
    viewer.output = given.render.output;
    window::open(viewer, asked.is_none())
}

/// A scene that is looked at.
struct Viewer {
    /// The command line, without the program and the command.
    words: Vec<OsString>,
    /// Options that keys have chosen, which go over those.
    chosen: Vec<(&'static str, &'static str)>,
    /// The values of the command line, in the order of the cycles.
    first: Vec<Option<String>>,
    /// The file of the command line for pictures that are kept.
    output: Option<PathBuf>,
    /// The camera and its pivot, once it has been moved.
    moved: Option<(Camera, [f64; 3])>,
    /// The time, once it is not that of the command line.
    time: Option<f64>,
    size: [u32; 2],
    cast: Cast,
    scene: Scene,
    /// Those of the last ground, also while it is not shown.
    shadows: Vec<Arc<Image>>,
}

/// Steps of time that words have: a thousandth of a second.
const TICKS: f64 = 1e3;

impl Viewer {
    /// # Errors
    /// The scene cannot be used.
    fn new(words: &[OsString], size: [u32; 2]) -> Result<Self, Error> {
        seen::begin();
        let words = words.to_vec();
        let matches = matches_of(words_of(&words, &Chosen::default(), size))?;
        let request = Request::read(&matches)?;
        let cast = request.cast().map_err(|error| request.relocate(error))?;
        let scene = Scene::new((wishes_of(&request, &matches)?, request), &cast, Kept::default())?;
        let shadows = scene.ground.as_ref().map(|ground| ground.shadows.clone()).unwrap_or_default();
        let first = keys::CYCLES.iter().map(|cycle| scene.value(cycle.option)).collect();
        let chosen = Vec::new();
        let (output, moved, time) = (None, None, None);
        Ok(Self { words, chosen, first, output, moved, time, size, cast, scene, shadows })
    }

    /// The name of the scene, without the way to it.
    fn name(&self) -> String {
        match self.scene.request.source() {
            Source::Model(path) => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            scene @ Source::Scene(_) => scene.name(),
        }
    }

    /// The options beside those of the command line, as they are typed.
    fn options(&self) -> Vec<String> {
        self.chosen.iter().map(|(option, value)| format!("{option}={value}")).collect()
    }

    /// The words of a picture of this size.
    fn all_words(&self) -> Vec<OsString> {
        words_of(&self.words, &self.chosen(&self.chosen, true), self.size)
    }

    /// Words beside those of the command line, with or without a camera that has been moved.
    fn chosen(&self, options: &[(&'static str, &'static str)], with_camera: bool) -> Chosen {
        let camera = self.camera_words().filter(|_| with_camera);
        // It says where it is, and how it projects.
        let is_said = |option: &str| camera.is_some() && ["--projection", "--view"].contains(&option);
        Chosen {
            options: options.iter().copied().filter(|(option, _)| !is_said(option)).collect(),
            camera,
            time: self.time,
        }
    }

    fn camera_words(&self) -> Option<String> {
        let Scene { request, staged, .. } = &self.scene;
        let projection = staged.options.projection;
        self.moved.map(|(camera, _)| {
            as_options(&camera, staged.model.origin, projection, &request.arguments.camera, false)
        })
    }

    /// Has the scene as it is with other words, or leaves all as it was.
    ///
    /// # Errors
    /// An option cannot be used with this scene.
    fn restage(&mut self, chosen: Vec<(&'static str, &'static str)>, keeps: Keeps) -> Result<(), Error> {
        let requests = self.requests(&chosen)?;
        let chains = keeps.maps.then(|| self.scene.chains.clone());
        let shadows = if keeps.shadow { self.shadows.clone() } else { Vec::new() };
        self.take(Scene::new(requests, &self.cast, Kept { chains, shadows, ..Kept::default() })?);
        self.chosen = chosen;
        Ok(())
    }

    /// Has another scene, with a camera that has been moved where it was.
    fn take(&mut self, scene: Scene) {
        let (before, now) = (self.scene.staged.model.origin, scene.staged.model.origin);
        self.moved = self.moved.map(|(_, pivot)| {
            let pivot = [0, 1, 2].map(|k| pivot[k] + before[k] - now[k]);
            (scene.staged.camera, pivot)
        });
        if let Some(ground) = &scene.ground {
            self.shadows.clone_from(&ground.shadows);
        }
        self.scene = scene;
    }

    /// Reads all files again. What keys have chosen is let go where the scene cannot have it any more.
    ///
    /// # Errors
    /// One cannot be used; the scene stays as it was.
    fn reload(&mut self) -> Result<(), Error> {
        let outcome = self.reload_with(self.chosen.clone());
        let (chosen, time) = (self.chosen.clone(), self.time);
        let Err(mut error) = outcome else { return Ok(()) };
        let without = |k: usize| {
            let kept = chosen.iter().enumerate().filter(|(other, _)| *other != k);
            kept.map(|(_, option)| *option).collect::<Vec<_>>()
        };
        // The time, an option, or all of them.
        let alone = (0..chosen.len()).map(|k| (time, without(k)));
        for (time, chosen) in std::iter::once((None, chosen.clone())).chain(alone).chain([(None, Vec::new())])
        {
            if (time, &chosen) != (self.time, &self.chosen) {
                let before = std::mem::replace(&mut self.time, time);
                match self.reload_with(chosen) {
                    Ok(()) => return Ok(()),
                    // The last is that of the files alone.
                    Err(other) => error = other,
                }
                self.time = before;
            }
        }
        Err(error)
    }

    fn reload_with(&mut self, chosen: Vec<(&'static str, &'static str)>) -> Result<(), Error> {
        seen::begin();
        if let Some(model) = &self.scene.request.arguments.model {
            seen::see(model);
        }
        let (wishes, request) = self.requests(&chosen)?;
        let cast = request.cast().map_err(|error| request.relocate(error))?;
        self.take(Scene::new((wishes, request), &cast, Kept::default())?);
        (self.cast, self.chosen) = (cast, chosen);
        Ok(())
    }

    /// The request of a picture with these options, and the camera's options without one that has been moved.
    fn requests(&self, chosen: &[(&'static str, &'static str)]) -> Result<(CameraTable, Request), Error> {
        let read = |with_camera| {
            let matches = matches_of(words_of(&self.words, &self.chosen(chosen, with_camera), self.size))?;
            let request = Request::read(&matches)?;
            Ok((wishes_of(&request, &matches)?, request))
        };
        let (wishes, first) = read(false)?;
        Ok((wishes, if self.moved.is_some() { read(true)?.1 } else { first }))
    }

    /// The end of what moves, and the time.
    fn motion(&self) -> Option<[f64; 2]> {
        let Request { arguments, file, .. } = &self.scene.request;
        let end = file.as_ref().and_then(SceneFile::end).filter(|end| *end > 0.0)?;
        let first = arguments.time.map_or(0.0, |time| <[f64; 1]>::from(time)[0]);
        Some([end, self.time.unwrap_or(first)])
    }

    /// Has the scene so many seconds later, of a motion that goes round. In haste its shadows are coarse.
    ///
    /// # Errors
    /// Nothing moves, or a frame cannot be; all is as it was.
    fn advance(&mut self, seconds: f64, is_hasty: bool) -> Result<bool, Error> {
        let Some([end, now]) = self.motion() else {
            return Err(Error::new("a scene in which nothing moves", "one with [[animation]]"));
        };
        let before = self.time.replace(((now + seconds).rem_euclid(end) * TICKS).round() / TICKS);
        let outcome = self.stage_at_time(is_hasty);
        if outcome.is_err() {
            self.time = before;
        }
        outcome.map(|()| true)
    }

    /// Stages the scene at its time: as a frame of a film, with all that its frames share.
    fn stage_at_time(&mut self, is_hasty: bool) -> Result<(), Error> {
        let time = self.time.unwrap_or_default();
        let of = |words| {
            let matches = matches_of(words)?;
            let request = self.scene.request.at(&matches, time)?;
            Ok((wishes_of(&request, &matches)?, request))
        };
        let (_, request) = of(self.all_words())?;
        let own = self.chosen(&self.chosen, false);
        let (wishes, _) = of(words_of(&self.words, &own, self.size))?;
        // A ground's shadow is a map of its own.
        let chains = self.scene.bare.is_none().then(|| self.scene.chains.clone());
        let motion = self.scene.motion.clone();
        let stands = motion.as_ref().is_some_and(|motion| !motion.swept.moves());
        let shadows = if stands { self.shadows.clone() } else { Vec::new() };
        let mut scene =
            Scene::new((wishes, request), &self.cast, Kept { chains, motion, shadows, is_hasty })?;
        scene.request.moments = std::mem::take(&mut self.scene.request.moments);
        self.take(scene);
        Ok(())
    }

    /// Looks at another model or scene file, with what keys have chosen.
    ///
    /// # Errors
    /// It cannot be used; the scene stays as it was.
    fn open(&mut self, path: PathBuf) -> Result<(), Error> {
        let mut other = Self::new(&[path.into()], self.size)?;
        // Options that the other scene cannot have are left out.
        _ = other.restage(self.chosen.clone(), Keeps { maps: false, shadow: false });
        *self = other;
        Ok(())
    }

    /// # Errors
    /// No picture of that size can be drawn.
    fn resize(&mut self, size: [u32; 2]) -> Result<(), Error> {
        let before = self.size;
        self.size = size;
        let outcome = self.restage(self.chosen.clone(), ALL);
        if outcome.is_err() {
            self.size = before;
        }
        outcome
    }

    /// Draws the picture: with one sample a pixel if it is a draft.
    ///
    /// # Errors
    /// It cannot be drawn with these options.
    fn picture(&self, is_draft: bool) -> Result<Seen, Error> {
        self.scene.picture(&self.camera(), is_draft)
    }

    fn camera(&self) -> Camera {
        self.moved.map_or(self.scene.staged.camera, |(camera, _)| camera)
    }

    /// The point about which the camera turns.
    fn pivot(&self) -> [f64; 3] {
        self.moved.map_or(self.scene.staged.middle, |(_, pivot)| pivot)
    }

    /// Writes the picture as `render` does, and prints the command that does. It returns the file: that of the command
    /// line, or one more in the current folder.
    ///
    /// # Errors
    /// It cannot be written.
    fn keep(&self) -> Result<PathBuf, Error> {
        let mut words = self.all_words();
        let format = self.scene.request.arguments.render.output_format;
        let extension = &*format.map_or("png".to_owned(), name_of);
        let file = self.output.clone().unwrap_or_else(|| unused(&stem(&self.scene.request), extension));
        if self.output.is_none() {
            let end = end_of_options(&words);
            words.splice(end..end, ["-o".into(), file.clone().into_os_string()]);
        }
        let typed: Vec<_> = words.iter().map(|word| typed(word)).collect();
        draw(&matches_of(words)?)?;
        print(&format!("command: {}\n", typed.join(" ")))?;
        Ok(file)
    }

    /// Does what a key or the mouse asks for, but for the window's part: it says whether there is a new picture.
    ///
    /// # Errors
    /// An option cannot be used with this scene; all is as it was.
    fn act(&mut self, action: Action) -> Result<bool, Error> {
        match action {
            Action::Turn(degrees) => self.move_to(self.orbit().turned(degrees)),
            Action::Pan(heights) => self.move_to(self.orbit().panned(heights)),
            Action::Zoom(factor, place) => self.zoom(factor, place),
            Action::Fit => self.look_from(None),
            Action::View(side) => self.look_from(Some(side)),
            Action::Cycle(cycle, forwards) => self.go_through(cycle, forwards),
            Action::Step(frames) => self.advance(f64::from(frames) / keys::FRAMES, false),
            Action::Picture | Action::Play | Action::Help | Action::Text | Action::Quit => Ok(false),
        }
    }

    /// Looks from a side, or as the command line does, or leaves all as it was.
    fn look_from(&mut self, side: Option<&'static str>) -> Result<bool, Error> {
        let moved = self.moved.take();
        let outcome = self.choose("--view", side, ALL);
        if outcome.is_err() {
            self.moved = moved;
        }
        outcome
    }

    /// Has the next value of a cycle that can be used with this scene. If none can, it tells why the first cannot.
    fn go_through(&mut self, cycle: &Cycle, forwards: bool) -> Result<bool, Error> {
        let at = keys::CYCLES.iter().position(|other| other == cycle);
        let first = at.and_then(|at| self.first.get(at)).cloned().flatten();
        let now = self.chosen_value(cycle.option);
        let (mut value, mut refused) = (now, None);
        loop {
            value = cycle.next(value, first.as_deref(), forwards);
            if value == now {
                return refused.map_or(Ok(false), Err);
            }
            if value.is_some_and(|value| !self.has(cycle.option, value)) {
                continue;
            }
            let before = (self.moved, self.scene.staged.options.projection);
            let is_parallel = value.or(first.as_deref()) == Some("parallel");
            let outcome = match self.moved {
                Some(_) if cycle.option == "--projection" => {
                    self.move_to(self.orbit().projected(is_parallel))
                }
                _ => Ok(true),
            };
            match outcome.and_then(|_| self.choose(cycle.option, value, cycle.keeps)) {
                Ok(is_new) => return Ok(is_new),
                Err(error) => refused = refused.or(Some(error)),
            }
            (self.moved, self.scene.staged.options.projection) = before;
        }
    }

    /// Whether the model has what a value shows of it.
    fn has(&self, option: &str, value: &str) -> bool {
        let show = Show::from_str(value, true).ok().filter(|_| option == "--show");
        let Staged { model, options, .. } = &self.scene.staged;
        show.is_none_or(|show| show.check(model, options).is_ok())
    }

    fn chosen_value(&self, option: &str) -> Option<&'static str> {
        self.chosen.iter().find(|(other, _)| *other == option).map(|(_, value)| *value)
    }

    fn choose(
        &mut self,
        option: &'static str,
        value: Option<&'static str>,
        keeps: Keeps,
    ) -> Result<bool, Error> {
        let mut chosen = self.chosen.clone();
        chosen.retain(|(other, _)| *other != option);
        chosen.extend(value.map(|value| (option, value)));
        self.restage(chosen, keeps).map(|()| true)
    }

    fn orbit(&self) -> Orbit {
        let projection = self.scene.staged.options.projection;
        Orbit { camera: self.camera(), pivot: self.pivot(), projection }
    }

    /// Nearer by a factor to what is seen at a place, or larger where there is no nearness.
    fn zoom(&mut self, factor: f64, place: Option<Place>) -> Result<bool, Error> {
        let (model, _) = self.scene.drawn(&self.camera());
        let radius = camera::bounding_sphere(&self.scene.staged.model).radius;
        let cull = self.scene.staged.options.cull;
        let nearer = self.orbit().nearer((model, radius), cull, (factor, place));
        self.move_to(nearer)
    }

    /// Has the camera there, with planes around the model unless the command line has others.
    fn move_to(&mut self, Orbit { camera: place, pivot, projection }: Orbit) -> Result<bool, Error> {
        let Scene { wishes, staged, bare, ground, .. } = &mut self.scene;
        let mut wishes = wishes.counted_from(staged.model.origin);
        let Camera { eye, target, up, roll, fov, .. } = place;
        (wishes.eye, wishes.target, wishes.up) = (Some(eye.into()), Some(target.into()), Some(up.into()));
        let roll = (roll != 0.0).then(|| narrow(roll).into());
        (wishes.fov, wishes.roll, wishes.zoom) = (Some(fov.into()), roll, None);
        (wishes.azimuth, wishes.elevation, wishes.view) = (None, None, None);
        wishes.projection = Some(match projection {
            Projection::Parallel { .. } => ProjectionKind::Parallel,
            Projection::Perspective => ProjectionKind::Perspective,
        });
        let Staged { model, options, .. } = staged;
        let aspect = Sight::of(options).aspect;
        // As a picture of the command line has them: first those of the model, then for its ground.
        let model = bare.as_ref().unwrap_or(model);
        let mut camera = camera::frame(&wishes, None, (model, camera::bounding_sphere(model)), aspect)?;
        camera::clear(&mut camera, model, &wishes, None, Sight::of(options));
        if let Some(ground) = ground {
            ground.stretch(&mut camera);
        }
        options.projection = projection;
        self.moved = Some((camera, pivot));
        Ok(true)
    }
}

#[cfg(test)]
mod tests;
