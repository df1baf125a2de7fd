//! Pictures beyond their scenes: a ground, and warnings.

use super::partners;
use super::request::Request;
use super::staged::{Staged, samples, threads};
use super::told::{told, warn};
use crate::error::{Error, counted};
use crate::film::{EARLY, ordered};
use crate::memory;
use crate::options::values::{Size, name_of};
use crate::options::{
    AovFormat, Background, CameraTable, ColorFormat, Cull, DEFAULT_SIZE, Dither, Interpolation, Projection,
    Samples, Shading,
};
use crate::output::stage::{Stage, during};
use crate::samples::bytes;
use crate::scene::Camera;
use crate::scene::camera::Sight;
use crate::scene::ground::{self, Shadows, Stood};
use alberti::Stats;

/// Words of warnings that say why nothing is in a picture.
const WHY_NOTHING: [&str; 2] = ["there is nothing to see", "a camera that looks away from the model"];

/// Bytes a pixel to encode: the colours, and twice as many where nothing is packed and the list has grown by halves.
const ENCODED: u64 = 9;
/// The same of numbers beside the picture: those of all pixels, and of a file at a time.
const NUMBERS: u64 = 52;
/// And of each kind where all are in one file.
const NUMBERS_EACH: u64 = 14;
/// The same of a picture of numbers in false colours.
const SHOWN: u64 = 48;

impl Request {
    /// Asks for the memory of the picture, before anything is read.
    ///
    /// # Errors
    /// There is less.
    pub(super) fn hold_picture(&self) -> Result<(), Error> {
        let render = &self.arguments.render;
        let Size(width, height) = render.size.unwrap_or(DEFAULT_SIZE);
        let samples = samples(&self.arguments, [width, height])?;
        let kinds = render.aov.as_ref().map_or(0, |aovs| aovs.iter().count() as u64);
        let numbers = match render.aov_format.unwrap_or_default() {
            _ if kinds == 0 => 0,
            AovFormat::Png16 => NUMBERS,
            AovFormat::Exr => NUMBERS + NUMBERS_EACH * kinds,
        };
        let pixels = u64::from(width) * u64::from(height);
        let (drawn, what) = match self.arguments.show {
            Some(_) => (SHOWN * pixels, format!("a picture of {width}x{height}")),
            None => {
                let transparent = render.background == Some(Background::Transparent);
                let count = (samples.side() * samples.side()) as usize;
                let what = format!(
                    "a picture of {width}x{height} with {} a pixel",
                    counted(count, "sample", "samples")
                );
                (bytes([width, height], samples, transparent), what)
            }
        };
        let option = if render.size.is_none() && render.memory.is_some() { "--memory" } else { "--size" };
        memory::hold(drawn + (ENCODED + numbers) * pixels, what).map_err(|error| error.place(option))
    }

    /// Asks for the memory of a film's frames that are drawn at a time, before anything is read.
    ///
    /// # Errors
    /// There is less.
    pub(super) fn hold_film(&self, transparent: bool) -> Result<(), Error> {
        let Size(width, height) = self.arguments.render.size.unwrap_or(DEFAULT_SIZE);
        let samples = samples(&self.arguments, [width, height])?;
        let threads = threads(&self.arguments).get() as u64;
        let pixels = u64::from(width) * u64::from(height);
        let each = bytes([width, height], samples, transparent) + (ENCODED + 4 * EARLY as u64) * pixels;
        let what = format!("frames of {width}x{height} by {threads} threads");
        memory::hold(threads * each, what).map_err(|error| error.place("--size"))
    }

    /// [`stage`](Self::stage) for a picture: warns of colours that are not seen, and has glass in glass in order.
    ///
    /// # Errors
    /// As those of [`stage`](Self::stage).
    pub(super) fn stage_picture(&self) -> Result<Staged, Error> {
        during(Stage::Load, |_| self.stage_ordered())
    }

    fn stage_ordered(&self) -> Result<Staged, Error> {
        let mut staged = self.stage()?;
        let Staged { model, camera, options, .. } = &mut staged;
        ordered(model, camera, options.projection);
        let of_file = self.file.is_none() && self.arguments.model.is_some() && self.arguments.show.is_none();
        let unseen = || partners::unseen_colors(&staged.model, staged.options.shading);
        if let Some(warning) = of_file.then(unseen).flatten() {
            warn(&warning.to_string());
        }
        let Size(width, height) = self.arguments.render.size.unwrap_or(DEFAULT_SIZE);
        if Samples::usual(width, height) == Samples::One && self.arguments.render.samples.is_none() {
            let found = format!("a picture of {width}x{height}, too large for 4 samples a pixel");
            warn(
                &Error::new(found, "at most 8192 a side")
                    .place("--size")
                    .hint("edges are not smooth")
                    .to_string(),
            );
        }
        Ok(staged)
    }

    /// Warns of a picture in which nothing of the model is seen, and why.
    pub(super) fn warn_of_nothing(&self, stats: &Stats, (camera, cull): (&Camera, Cull)) {
        // Other warnings have said why.
        let is_why = |line: &String| WHY_NOTHING.iter().any(|why| line.contains(why));
        if stats.written > 0 || self.arguments.show.is_some() || told().iter().any(is_why) {
            return;
        }
        let hint = if camera.near > 0.0 && camera.near < 1e-7 * camera.far {
            "from so near a front plane on, depths have no bits left: see --near"
        } else if stats.dropped >= stats.submitted {
            "all of it is outside the view: see --eye, --target, --zoom, --near and --far"
        } else if cull != Cull::None && stats.culled + stats.dropped >= stats.submitted {
            "its faces are left out by --cull"
        } else {
            "its faces are seen edge-on, or are smaller than pixels, or are outside the picture"
        };
        warn(&Error::new("nothing of the model in the picture", "some of it").hint(hint).to_string());
    }

    /// Puts a ground under the model of a picture, if that is asked for.
    pub(super) fn add_ground(&self, staged: &mut Staged, shadows: Shadows<'_>) -> Option<Stood> {
        let mut camera = staged.camera;
        let stood = self.add_ground_for(staged, std::slice::from_mut(&mut camera), shadows);
        staged.camera = camera;
        stood
    }

    /// Whether each of these cameras sees a ground from above, which is drawn for it; all do where there is none.
    pub(super) fn above_ground(&self, staged: &Staged, cameras: &[Camera]) -> Vec<bool> {
        let Staged { model, swept, up, options, .. } = staged;
        match ground::above(model, (swept.as_ref(), *up), cameras, options.depth) {
            Some(above) if self.arguments.render.ground == Some(true) => above,
            _ => vec![true; cameras.len()],
        }
    }

    /// The same as [`add_ground`](Self::add_ground) for these cameras, but those below it.
    pub(super) fn add_ground_for(
        &self,
        staged: &mut Staged,
        cameras: &mut [Camera],
        shadows: Shadows<'_>,
    ) -> Option<Stood> {
        if self.arguments.render.ground != Some(true) {
            return None;
        }
        let left_out = |found: &str, expected: &str| {
            let error = Error::new(found, expected).place("--ground");
            warn(&self.relocate(error.hint("it is left out")).to_string());
            None
        };
        if self.arguments.show.is_some() {
            return left_out("it with --show, which has the model alone", "a picture in true colours");
        }
        if staged.options.shading == Shading::VertexColor {
            return left_out("it with vertex-color, which has no shadows", "another shading");
        }
        let above = self.above_ground(staged, cameras);
        let Staged { model, swept, up, options, .. } = staged;
        if ground::above(model, (swept.as_ref(), *up), cameras, options.depth).is_none() {
            return left_out(
                "it under a flat model, beside which there is no shadow",
                "one that stands on it",
            );
        }
        let CameraTable { near, far, .. } = self.arguments.camera;
        let affine = options.policies.interpolation == Interpolation::Affine;
        let fixed = [near.is_some(), far.is_some()];
        let sight = matches!(options.projection, Projection::Perspective).then(|| Sight::of(options));
        let (depth, wrap) = (options.depth, options.wrap);
        let manner = ground::Manner { fixed, sight, affine, depth, wrap, shadows };
        let stood = during(Stage::Shadow, |_| ground::add(model, (swept.as_ref(), *up), cameras, manner));
        if stood.is_none() {
            return left_out("a camera below the model's lowest point", "one above the ground");
        }
        let below = above.iter().filter(|above| !**above).count();
        warn_of_frames_below(below, above.len());
        if options.policies.color != ColorFormat::Rgba8 && options.policies.dither == Dither::None {
            let found = format!("a shadow in {} without a dither", name_of(options.policies.color));
            let error = Error::new(found, "a smooth one").place("--ground");
            warn(&error.hint("--dither blue-noise leaves no rings").to_string());
        }
        stood
    }
}

/// Warns of frames that have no ground.
pub(super) fn warn_of_frames_below(below: usize, all: usize) {
    if below > 0 {
        let found = format!("{below} of {all} frames from below the model's lowest point");
        let error = Error::new(found, "views from above the ground").place("--ground");
        warn(&error.hint("it is left out of those").to_string());
    }
}
