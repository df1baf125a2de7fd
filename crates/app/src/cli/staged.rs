//! From options to all that a picture is made of: the model with its materials, the camera, and the policies.

use std::num::NonZero;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Command, FromArgMatches as _};

use super::told::{warn, warn_all};
use super::{RenderArgs, partners};
use crate::error::{Error, Warnings, number, quote};
use crate::load::images::Images;
use crate::load::scene_file::{self, SceneFile};
use crate::load::{obj, prepare, seen};
use crate::memory;
use crate::options::values::{Color, MAX_THREADS, Size, Threads, name_of as name_of_value};
use crate::options::{
    Background, CameraTable, ColorFormat, Cull, DEFAULT_BACKGROUND, DEFAULT_OUTPUT, DEFAULT_SIZE,
    DepthFormat, Filter, Fog, GROUND_BACKGROUND, Haze, KeyLight, LightOptions, LightSpace, Profile,
    Projection, RenderOptions, Samples, Shading, Wrap,
};
use crate::output::aov::{self, Beside};
use crate::output::file::{Output, Whole};
use crate::output::stage::{Stage, during};
use crate::output::stats::Source;
use crate::scene::backdrop::Backdrop;
use crate::scene::{Camera, Model, Part, Relief, camera, ground, order, scenes, slide};
use crate::threads::available;

/// The options of pictures alone, which other commands refuse.
pub(super) const OF_PICTURES: [&str; 8] =
    ["output", "output_format", "aov", "aov_format", "samples", "stats", "show", "ground"];

/// A command without some options in its help.
pub(super) fn hidden(command: Command, ids: &[&'static str]) -> Command {
    ids.iter().fold(command, |command, id| command.mut_arg(id, |option| option.hide(true)))
}

/// Refuses options of `render` that a command has not.
///
/// # Errors
/// One of them stands on the command line.
pub(super) fn refuse(matches: &ArgMatches, name: &str, ids: &[&str], reason: &str) -> Result<(), Error> {
    let given = |id: &&&str| matches.value_source(id) == Some(ValueSource::CommandLine);
    match ids.iter().find(given) {
        None => Ok(()),
        Some(id) => {
            let found = format!("an option that `{name}` has not");
            let error = Error::new(found, "those of `render` that it uses");
            Err(error.place(format!("--{}", id.replace('_', "-"))).hint(format!("leave it out: {reason}")))
        }
    }
}

/// The options, and the scene file that some of them come from.
pub(super) struct Request {
    pub(super) arguments: RenderArgs,
    pub(super) file: Option<SceneFile>,
    /// The eye and the target of the file, if the command line turns its camera.
    orbit: Option<CameraTable>,
}

/// All that a picture is made of.
pub(super) struct Staged {
    pub(super) model: Model,
    pub(super) camera: Camera,
    pub(super) options: RenderOptions,
    pub(super) samples: Samples,
    pub(super) backdrop: Backdrop,
}

impl Request {
    /// The options of a command that has those of [`RenderArgs`].
    ///
    /// # Errors
    /// An option that cannot be understood, here or in the scene file.
    pub(super) fn read(matches: &ArgMatches) -> Result<Self, Error> {
        let refused = |error: clap::Error| Error::new(error.to_string(), "what --help lists");
        let mut arguments = RenderArgs::from_arg_matches(matches).map_err(refused)?;
        let (mut scene_file, mut orbit) = (None, None);
        if let Some(path) = arguments.model.as_deref().filter(|path| scene_file::is_scene(path)) {
            let (file, options) = SceneFile::read(path, matches)?;
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
        if let Some(eye) = last("eye") {
            let CameraTable { azimuth, elevation, view, .. } = &mut arguments.camera;
            azimuth.take_if(|_| last("azimuth") < Some(eye));
            elevation.take_if(|_| last("elevation") < Some(eye));
            view.take_if(|_| last("view") < Some(eye));
        }
        // A texture is shown as it is, whatever the materials' colours.
        arguments.material.whiten();
        memory::begin(arguments.render.memory);
        Ok(Self { arguments, file: scene_file, orbit })
    }

    /// The options of the command line alone.
    ///
    /// # Errors
    /// One that cannot be understood.
    pub(super) fn given(matches: &ArgMatches) -> Result<Self, Error> {
        let refused = |error: clap::Error| Error::new(error.to_string(), "what --help lists");
        RenderArgs::from_arg_matches(matches).map_err(refused).map(|arguments| Self {
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
        partners::check(&self.arguments)
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

    /// The origin of the triangles.
    pub(super) fn source(&self) -> Source<'_> {
        match &self.arguments.model {
            Some(path) => Source::Model(path),
            None => Source::Scene(name_of(&self.arguments)),
        }
    }

    /// Loads everything, and warns of repairs.
    ///
    /// # Errors
    /// A file cannot be used, or options do not suit the model.
    pub(super) fn stage(&self) -> Result<Staged, Error> {
        during(Stage::Load, |progress| self.stage_heard(&mut |done, total| progress.set(done, total)))
    }

    fn stage_heard(&self, hear: &mut dyn FnMut(u64, u64)) -> Result<Staged, Error> {
        let (arguments, file) = (&self.arguments, self.file.as_ref());
        let (policies, depth) = arguments.render.policies(arguments.camera.is_parallel());
        let mut scene = match file {
            Some(file) => load_scene_file(arguments, file, hear)?,
            None => load(arguments, hear)?,
        };
        if file.is_none() {
            put_materials(arguments, &mut scene)?;
        }
        partners::check_maps(arguments, &scene.model)?;
        if let Some(warning) = partners::unused_heights(&scene.model) {
            warn(&warning.to_string());
        }
        if !scene.has_uv && scene.model.parts.iter().any(Part::has_maps) {
            let found = "a model without texture coordinates (`vt` lines)";
            let error = Error::new(found, "some for the texture");
            let error = match (mapped(arguments), &scene.model.source) {
                (None, Some(path)) => error.file(path),
                (option, _) => error.place(option.unwrap_or_default()),
            };
            warn(&error.hint("all of a surface gets the same texel").to_string());
        }
        let origin = scene.model.origin;
        scene.model.slide = slide::load(&arguments.projector, origin)?;

        let Size(width, height) = arguments.render.size.unwrap_or(DEFAULT_SIZE);
        let ball = camera::bounding_sphere(&scene.model);
        let aspect = f64::from(width) / f64::from(height);
        let wishes = arguments.camera.counted_from(origin);
        let base = scene.camera.or(self.orbit.map(|table| camera::orbit(&table.counted_from(origin), ball)));
        let up = || wishes.up.map(<[f32; 3]>::from).or(base.map(|base| base.up)).unwrap_or([0.0, 1.0, 0.0]);
        let shading = arguments.render.shading.unwrap_or(scene.defaults.0);
        let is_seen = arguments.show.is_none() && shading != Shading::VertexColor;
        let grounded = (arguments.render.ground == Some(true) && is_seen).then(up);
        let camera = ground::in_view(&mut scene.model, grounded, |model| {
            camera::frame(&wishes, base.as_ref(), (model, ball), aspect)
        })?;
        order::back_to_front(&mut scene.model, &camera);
        if camera::is_behind(&camera, ball) {
            let error = Error::new("a camera that looks away from the model", "the model in view");
            warn(&error.place("--eye").to_string());
        }
        if let Some(slide) = &scene.model.slide
            && slide::misses(&slide::projector(slide)?, &scene.model)
        {
            let found = "an image that falls nowhere on the model";
            warn(
                &Error::new(found, "the model before the projector").place("--projector-target").to_string(),
            );
        }

        let (shading, filter, wrap, cull, scene_depth) = scene.defaults;
        let shiny = shading == Shading::Lambert && has_highlights(arguments, &scene.model);
        let background = arguments.render.background.as_ref();
        let background = background.and_then(Background::flat).unwrap_or(scene.background);
        let haze = arguments
            .render
            .fog
            .and_then(|Fog(fog)| fog)
            .map(|fog| Haze { fog, color: arguments.render.fog_color.map_or(background, Color::bytes) });
        let options = RenderOptions {
            width,
            height,
            background,
            haze,
            light: LightOptions {
                two_sided: arguments.render.two_sided.unwrap_or(true),
                // Built-in scenes are those of the library's tests, in its light.
                key: arguments.render.light.unwrap_or(if arguments.model.is_some() {
                    KeyLight::STUDIO
                } else {
                    KeyLight::Lamp
                }),
                space: arguments.render.light_space.unwrap_or(LightSpace::Srgb),
            },
            shading: arguments.render.shading.unwrap_or(if shiny { Shading::Blinn } else { shading }),
            filter: arguments.render.filter.unwrap_or(filter),
            wrap: arguments.render.wrap.unwrap_or(wrap),
            cull: arguments.render.cull.unwrap_or(cull),
            depth: depth.unwrap_or(scene_depth),
            projection: projection(arguments, &camera)?,
            threads: threads(arguments),
            policies,
        };
        if options.shading == Shading::Gouraud && scene.model.parts.iter().any(needs_fragments) {
            let found = "gouraud with relief, normals, occlusion or reflections, which are left out";
            warn(&Error::new(found, "phong or blinn for these").place("--shading").to_string());
        }
        if let Some(warning) = partners::unused_light(arguments, &scene.model) {
            warn(&self.relocate(warning).to_string());
        }
        let idle = partners::idle(arguments, &scene.model, &options, &|option| {
            self.file.as_ref().is_some_and(|file| file.has(option))
        });
        for warning in idle.into_iter().chain(partners::empty_layers(arguments, &scene.model)) {
            warn(&self.relocate(warning).to_string());
        }
        let samples = samples(arguments, [width, height])?;
        let backdrop = Backdrop::new(arguments.render.background.as_ref(), &options)?;
        Ok(Staged { model: scene.model, camera, options, samples, backdrop })
    }
}

/// The model, and defaults for options that the command line leaves open.
struct Scene {
    model: Model,
    /// A scene's own camera; models have none.
    camera: Option<Camera>,
    defaults: (Shading, Filter, Wrap, Cull, DepthFormat),
    background: [u8; 3],
    /// Whether a texture has coordinates to follow.
    has_uv: bool,
}

/// As many threads as are asked for, or as the machine runs at once.
pub(super) fn threads(arguments: &RenderArgs) -> NonZero<usize> {
    let most = NonZero::new(MAX_THREADS).unwrap_or(NonZero::<usize>::MIN);
    match arguments.threads {
        Some(Threads(threads)) => threads,
        None => available().min(most),
    }
}

/// Samples a pixel: several unless the picture is as a small display has it.
pub(super) fn samples(arguments: &RenderArgs, [width, height]: [u32; 2]) -> Result<Samples, Error> {
    match arguments.render.samples {
        Some(samples) => samples.check(width, height).map(|()| samples),
        None if is_small(arguments) => Ok(Samples::One),
        None => Ok(Samples::usual(width, height)),
    }
}

fn name_of(arguments: &RenderArgs) -> &str {
    let Some(given) = arguments.scene.as_deref() else {
        return scenes::NAMES.first().copied().unwrap_or_default();
    };
    scenes::NAMES.iter().copied().find(|name| name.eq_ignore_ascii_case(given)).unwrap_or(given)
}

fn load(arguments: &RenderArgs, hear: &mut dyn FnMut(u64, u64)) -> Result<Scene, Error> {
    if let Some(path) = &arguments.model {
        let loaded = obj::load(path, arguments.render.normals, hear)?;
        // Of what an option replaces there is nothing to say.
        let replaced = arguments.material.maps().into_iter();
        let warnings = replaced.fold(loaded.warnings, |warnings, (key, _)| warnings.without(key));
        warn_all(&warnings);
        return Ok(Scene {
            model: loaded.model,
            camera: None,
            defaults: of_models(arguments),
            background: background(arguments),
            has_uv: loaded.has_uv,
        });
    }
    let name = name_of(arguments);
    let scene = scenes::by_name(name).ok_or_else(|| {
        Error::new(quote(name.as_bytes()), format!("one of {}", scenes::NAMES.join(", "))).place("--scene")
    })?;
    Ok(Scene {
        model: scene.model,
        camera: Some(scene.camera),
        defaults: (scene.shading, scene.filter, scene.wrap, scene.cull, scene.depth),
        background: scene.background,
        has_uv: true,
    })
}

/// Defaults of models and scene files. What a small display shows is read in the shortest way, and all else without
/// shimmer.
fn of_models(arguments: &RenderArgs) -> (Shading, Filter, Wrap, Cull, DepthFormat) {
    let filter = if is_small(arguments) { Filter::Bilinear } else { Filter::Trilinear };
    (Shading::default(), filter, Wrap::default(), Cull::default(), DepthFormat::default())
}

/// The colour behind models and scene files.
fn background(arguments: &RenderArgs) -> [u8; 3] {
    if arguments.render.ground == Some(true) { GROUND_BACKGROUND } else { DEFAULT_BACKGROUND }
}

/// Whether a picture is as a small display has it.
fn is_small(arguments: &RenderArgs) -> bool {
    let (policies, _) = arguments.render.policies(arguments.camera.is_parallel());
    policies.color != ColorFormat::Rgba8
        || matches!(arguments.render.profile, Some(Profile::Mcu | Profile::Tiny))
}

/// Whether light by vertex leaves out something of a part.
fn needs_fragments(part: &Part) -> bool {
    let detail = &part.detail;
    let relief = detail.height.is_some_and(|height| height.relief != Relief::Displacement);
    relief || detail.normal.is_some() || detail.occlusion.is_some() || detail.environment.is_some()
}

/// Whether something is said of highlights, beside the faint one that every surface has.
fn has_highlights(arguments: &RenderArgs, model: &Model) -> bool {
    let material = &arguments.material;
    let mapped = |part: &Part| {
        part.detail.shiny || part.detail.specular_map.is_some() || part.detail.shininess_map.is_some()
    };
    material.specular.is_some() || material.shininess.is_some() || model.parts.iter().any(mapped)
}

/// The options of materials replace what all materials of a model say.
fn put_materials(arguments: &RenderArgs, scene: &mut Scene) -> Result<(), Error> {
    let mut images = Images::new();
    images.adopt(&mut scene.model);
    prepare::replace_materials(&mut scene.model, &arguments.material, &mut images)?;
    prepare::unmix(&mut scene.model, &arguments.material, &mut images);
    let mut warnings = Warnings::default();
    let wrap = arguments.render.wrap.unwrap_or(scene.defaults.2);
    prepare::complete(&mut scene.model, &mut images, wrap, &mut warnings);
    warn_all(&warnings);
    images.give(&mut scene.model);
    Ok(())
}

/// The scene of a scene file.
fn load_scene_file(
    arguments: &RenderArgs,
    file: &SceneFile,
    hear: &mut dyn FnMut(u64, u64),
) -> Result<Scene, Error> {
    let mut warnings = Warnings::default();
    let (model, has_uv) = file.build(&arguments.material, arguments, &mut warnings, hear)?;
    warn_all(&warnings);
    Ok(Scene {
        model,
        camera: None,
        defaults: of_models(arguments),
        background: background(arguments),
        has_uv,
    })
}

/// The first option that puts an image on surfaces.
fn mapped(arguments: &RenderArgs) -> Option<String> {
    let maps = arguments.material.maps();
    let (key, _) = maps.into_iter().find(|(key, _)| *key != "environment")?;
    Some(match key {
        "color-map" => "--texture".to_owned(),
        "ao-map" => "--ao".to_owned(),
        key => format!("--{key}"),
    })
}

/// All files that are read, as far as the command line names them.
fn inputs(arguments: &RenderArgs) -> impl Iterator<Item = PathBuf> {
    let maps = arguments.material.maps().into_iter().map(|(_, map)| map.path);
    let background =
        arguments.render.background.clone().and_then(|mut background| background.file().cloned());
    let named = [&arguments.model, &arguments.projector.image].into_iter().flatten().cloned();
    maps.chain(named).chain(background)
}

/// The projection that was asked for; a parallel one shows as much as the perspective one does around its target.
pub(super) fn projection(arguments: &RenderArgs, camera: &Camera) -> Result<Projection, Error> {
    if !arguments.camera.is_parallel() {
        return Ok(Projection::Perspective);
    }
    let height = arguments.camera.view_height.map(f32::from);
    let height =
        height.map_or_else(|| camera::window_height(camera), |height| height / arguments.camera.zoom());
    if !(height > 0.0 && height.is_finite()) {
        let found = format!("a height of {}", number(height));
        return Err(Error::new(found, "a finite number above 0").place("--view-height"));
    }
    Ok(Projection::Parallel { height })
}
