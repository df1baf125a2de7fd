//! From options to all that a picture is made of: the model with its materials, the camera, and the policies.

use std::num::NonZero;
use std::sync::Arc;

use super::request::{Request, name_of};
use super::told::{warn, warn_all};
use super::{RenderArgs, partners};
use crate::error::{Error, Warnings, number, quote};
use crate::load::images::Images;
use crate::load::scene_file::{Gathered, SceneFile};
use crate::load::{obj, prepare};
use crate::options::values::{Color, MAX_THREADS, Size, Threads};
use crate::options::{
    Background, CameraTable, Cull, DEFAULT_BACKGROUND, DEFAULT_SIZE, DepthFormat, Filter, Fog,
    GROUND_BACKGROUND, Haze, KeyLight, LightOptions, LightSpace, Profile, Projection, RenderOptions, Samples,
    Shading, Wrap,
};
use crate::output::stage::{Stage, during};
use crate::scene::backdrop::Backdrop;
use crate::scene::camera::Sight;
use crate::scene::normals::narrow;
use crate::scene::swept::{Reached, Swept};
use crate::scene::{Camera, Image, Model, Part, Relief, camera, ground, order, scenes, slide};
use crate::threads::available;

/// All that has been loaded for a picture, or for the frames of a film.
#[derive(Clone)]
pub(super) struct Cast {
    scene: Loaded,
    /// The projector's image, if it has been read.
    pub(super) slide: Option<Arc<Image>>,
}

#[derive(Clone)]
enum Loaded {
    /// A model, or a built-in scene.
    Scene(Scene),
    /// The objects of a scene file, before they are where they stand.
    Objects(Gathered),
}

/// All frames of what moves together.
#[derive(Default)]
pub(super) struct Motion {
    /// The places that things come to.
    pub(super) swept: Swept,
    /// The camera at the start, without its zoom, and the point that it is counted from.
    still: Option<(Camera, [f64; 3])>,
}

impl Motion {
    /// The camera at the start, counted from another point.
    fn camera(&self, origin: [f64; 3]) -> Option<Camera> {
        let (camera, own) = self.still?;
        let moved = |place: [f32; 3]| [0, 1, 2].map(|k| narrow(f64::from(place[k]) + own[k] - origin[k]));
        Some(Camera { eye: moved(camera.eye), target: moved(camera.target), ..camera })
    }
}

/// All that a picture is made of.
pub(super) struct Staged {
    pub(super) model: Model,
    /// The places that the model comes to, if it moves.
    pub(super) swept: Option<Reached>,
    pub(super) camera: Camera,
    /// The world's upward direction, also of a camera that is turned over.
    pub(super) up: [f32; 3],
    /// The point about which a zoom is, and turns by hand are: the model's middle, or a target that is given.
    pub(super) middle: [f64; 3],
    pub(super) options: RenderOptions,
    pub(super) samples: Samples,
    pub(super) backdrop: Backdrop,
}

impl Request {
    /// Loads everything, and warns of repairs.
    ///
    /// # Errors
    /// A file cannot be used, or options do not suit the model.
    pub(super) fn stage(&self) -> Result<Staged, Error> {
        during(Stage::Load, |progress| self.stage_heard(&mut |done, total| progress.set(done, total)))
    }

    fn stage_heard(&self, hear: &mut dyn FnMut(u64, u64)) -> Result<Staged, Error> {
        let cast = self.cast_heard(hear)?;
        let motion = self.motion(&cast)?;
        self.stage_with(cast, motion.as_ref())
    }

    /// How what has been loaded moves, if it does.
    ///
    /// # Errors
    /// As those of [`stage`](Self::stage).
    pub(super) fn motion(&self, cast: &Cast) -> Result<Option<Motion>, Error> {
        let Some(first) = self.moments.first() else { return Ok(None) };
        let mut motion = Motion::default();
        if let Loaded::Objects(gathered) = &cast.scene {
            let moments = self.moments.iter().filter_map(|moment| moment.file.as_ref());
            motion.swept = SceneFile::swept(gathered, moments);
        }
        let Staged { camera, middle, model, options, .. } = first.stage_with(cast.clone(), Some(&motion))?;
        let mut camera = camera::unzoomed(&camera, middle, first.arguments.camera.zoom());
        // A camera that goes round a model is as far away as all of its views take.
        let turns = |moment: &Self| {
            let CameraTable { azimuth, elevation, roll, view, .. } = moment.arguments.camera;
            (azimuth, elevation, roll, view)
        };
        let places = |moment: &Self| moment.arguments.camera.counted_from(model.origin);
        let goes_round = self.moments.iter().any(|moment| turns(moment) != turns(first));
        if goes_round
            && self
                .moments
                .iter()
                .all(|moment| moment.arguments.camera.eye.is_none() && moment.orbit.is_none())
        {
            let whole = motion.swept.counted_from(model.origin).whole;
            let ball = camera::bounding_sphere(&whole);
            let aspect = f64::from(options.width) / f64::from(options.height);
            let views = self.moments.iter().map(|moment| {
                let wishes = CameraTable { zoom: None, ..places(moment) };
                camera::frame(&wishes, None, (&whole, ball), aspect).map(|camera| (camera, wishes))
            });
            let views = views.collect::<Result<Vec<_>, _>>()?;
            camera = camera::fitted_at_all_times((&whole, ball), &views, aspect).unwrap_or(camera);
        }
        motion.still = Some((camera, model.origin));
        Ok(Some(motion))
    }

    /// Loads what the frames of a film share, and warns of repairs.
    ///
    /// # Errors
    /// A file cannot be used.
    pub(super) fn cast(&self) -> Result<Cast, Error> {
        during(Stage::Load, |progress| self.cast_heard(&mut |done, total| progress.set(done, total)))
    }

    fn cast_heard(&self, hear: &mut dyn FnMut(u64, u64)) -> Result<Cast, Error> {
        let arguments = &self.arguments;
        let scene = match &self.file {
            Some(file) => {
                let mut warnings = Warnings::default();
                let gathered = file.gather(&arguments.material, arguments, &mut warnings, hear)?;
                warn_all(&warnings);
                Loaded::Objects(gathered)
            }
            None => Loaded::Scene(load(arguments, hear)?),
        };
        Ok(Cast { scene, slide: None })
    }

    /// [`stage`](Self::stage) of what has been loaded. Without an eye, a camera stands where it stood at the start of a
    /// motion, which sees all of it.
    ///
    /// # Errors
    /// Options do not suit the model.
    pub(super) fn stage_with(
        &self,
        Cast { scene, slide }: Cast,
        motion: Option<&Motion>,
    ) -> Result<Staged, Error> {
        let (arguments, file) = (&self.arguments, self.file.as_ref());
        let (policies, depth) = arguments.render.policies(arguments.camera.is_parallel());
        let mut scene = match (scene, file) {
            (Loaded::Objects(gathered), Some(file)) => of_file(arguments, file, gathered)?,
            (Loaded::Scene(mut scene), _) => {
                if arguments.model.is_some() {
                    // It may have been loaded for other options.
                    (scene.defaults, scene.background) = (of_models(arguments), background(arguments));
                }
                put_materials(arguments, &mut scene)?;
                scene
            }
            (Loaded::Objects(_), None) => return Err(Error::new("objects without a scene file", "one")),
        };
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
        scene.model.slide = slide::load(&arguments.projector, slide, origin)?;

        let Size(width, height) = arguments.render.size.unwrap_or(DEFAULT_SIZE);
        let mut swept = motion.map(|motion| motion.swept.counted_from(origin));
        let ball = camera::bounding_sphere(swept.as_ref().map_or(&scene.model, |swept| &swept.whole));
        let aspect = f64::from(width) / f64::from(height);
        let mut wishes = arguments.camera.counted_from(origin);
        let orbit = self.orbit.map(|table| camera::orbit(&table.counted_from(origin), ball));
        let still = motion.filter(|_| wishes.eye.is_none()).and_then(|motion| motion.camera(origin));
        let is_free = (wishes.eye, wishes.target, scene.camera, orbit) == (None, None, None, None);
        if !wishes.turns() {
            wishes.eye = wishes.eye.or(still.map(|still| still.eye.into()));
        }
        let base = scene.camera.or(orbit).or(still);
        let up = wishes.up.map(<[f32; 3]>::from).or(base.map(|base| base.up)).unwrap_or([0.0, 1.0, 0.0]);
        let shading = arguments.render.shading.unwrap_or(scene.defaults.0);
        // Numbers and false colours, which have no ground, are those of the picture with it.
        let is_lit = shading != Shading::VertexColor;
        let grounded = (arguments.render.ground == Some(true) && is_lit).then_some(up);
        // A shadow on a floor does not reach beyond it.
        let grounded = grounded.filter(|up| !ground::has_floor(&scene.model, swept.as_ref(), *up));
        let whole = swept.as_mut().map_or(&mut scene.model, |swept| &mut swept.whole);
        let camera = ground::in_view(whole, grounded, |model| {
            camera::frame(&wishes, base.as_ref(), (model, ball), aspect)
        })?;
        let middle = if is_free { ball.center } else { camera.target.map(f64::from) };
        let mut camera = camera::zoomed_about(&camera, middle, wishes.zoom());
        // All places are in view, and planes are around what is there.
        if swept.is_some() {
            let now = camera::bounding_sphere(&scene.model);
            camera = camera::planed(camera, &wishes, base.as_ref(), (&scene.model, now))?;
        }
        order::back_to_front(&mut scene.model, &camera);
        if camera::is_behind(&camera, ball) {
            let error = Error::new("a camera that looks away from the model", "the model in view");
            warn(&self.relocate(error.place("--eye")).to_string());
        }
        if let Some(slide) = &scene.model.slide
            && slide::misses(&slide::projector(slide)?, &scene.model)
        {
            let error =
                Error::new("an image that falls nowhere on the model", "the model before the projector");
            warn(&self.relocate(error.place("--projector-target")).to_string());
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
                brightness: arguments.render.brightness.map_or(1.0, f32::from),
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
        let sight = Sight::of(&options);
        if let Some(nearest) = camera::clear(&mut camera, &scene.model, &wishes, base.as_ref(), sight) {
            let [nearest, near] = [narrow(0.99 * nearest), camera.near].map(number);
            let found = format!("what is as near as {nearest}, and cut away up to {near}");
            let reversed = if options.depth == DepthFormat::F32 { ", or --depth f32-reversed" } else { "" };
            let hint = format!("--near {nearest} shows it, with depths that are coarser far away{reversed}");
            let error = Error::new(found, "an eye farther from what it sees").place("--eye");
            warn(&self.relocate(error.hint(hint)).to_string());
        }
        if options.shading == Shading::Gouraud && scene.model.parts.iter().any(needs_fragments) {
            let found = "gouraud with relief, normals, occlusion or reflections, which are left out";
            warn(&Error::new(found, "phong or blinn for these").place("--shading").to_string());
        }
        if arguments.render.normals.is_some() && file.is_some_and(|file| !file.has_models()) {
            let error =
                Error::new("it in a scene without a model", "a model: surfaces have normals of their own");
            warn(&self.relocate(error.place("--normals").hint("nothing changes")).to_string());
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
        Ok(Staged { model: scene.model, swept, camera, up, middle, options, samples, backdrop })
    }
}

/// The model, and defaults for options that the command line leaves open.
#[derive(Clone)]
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
    matches!(arguments.render.profile, Some(Profile::Mcu | Profile::Tiny))
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
fn of_file(arguments: &RenderArgs, file: &SceneFile, gathered: Gathered) -> Result<Scene, Error> {
    let has_uv = gathered.has_uv;
    Ok(Scene {
        model: file.build(gathered)?,
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
