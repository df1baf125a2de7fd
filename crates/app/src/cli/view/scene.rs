//! A scene in a window, staged for its pictures.

use std::rc::Rc;
use std::sync::Arc;

use clap::ArgMatches;

use crate::cli::request::Request;
use crate::cli::staged::{Cast, Motion, Staged};
use crate::draw::Chains;
use crate::error::Error;
use crate::film::{Set, ordered};
use crate::options::values::name_of;
use crate::options::{CameraTable, Projection, Samples};
use crate::render::Picture;
use crate::samples::supersampled_with;
use crate::scene::ground::{Shadows, Stood};
use crate::scene::{Camera, Image, Model};
use crate::show::{Shown, show};
use alberti::Stats;

/// All that a picture takes.
pub(super) struct Scene {
    pub(super) request: Request,
    /// The options of a camera that is moved, but for its place.
    pub(super) wishes: CameraTable,
    pub(super) staged: Staged,
    /// The model without its ground, for cameras below that, and that ground.
    pub(super) bare: Option<Model>,
    pub(super) ground: Option<Stood>,
    /// Whether its shadows are.
    pub(super) is_coarse: bool,
    pub(super) chains: Arc<Chains>,
    pub(super) motion: Option<Rc<Motion>>,
}

/// A picture, and lines on it: what its false colours mean, and what is not in it.
pub(super) struct Seen {
    pub(super) image: Image,
    pub(super) stats: Stats,
    pub(super) legend: Vec<String>,
}

/// Parts of a scene that another has as well.
#[derive(Default)]
pub(super) struct Kept {
    pub(super) chains: Option<Arc<Chains>>,
    pub(super) motion: Option<Rc<Motion>>,
    /// The images of the shadows on the ground.
    pub(super) shadows: Vec<Arc<Image>>,
    /// Whether others may be coarse.
    pub(super) is_hasty: bool,
}

impl Scene {
    /// # Errors
    /// It cannot be staged with these words.
    pub(super) fn new(
        (wishes, request): (CameraTable, Request),
        cast: &Cast,
        Kept { chains, mut motion, shadows, is_hasty }: Kept,
    ) -> Result<Self, Error> {
        let staged = request.check().and_then(|()| {
            if motion.is_none() {
                motion = request.motion(cast)?.map(Rc::new);
            }
            request.stage_with(cast.clone(), motion.as_deref())
        });
        let mut staged = staged.map_err(|error| request.relocate(error))?;
        ordered(&mut staged.model, &staged.camera, staged.options.projection);
        let bare = (request.arguments.render.ground == Some(true)).then(|| staged.model.clone());
        let is_coarse = is_hasty && shadows.is_empty();
        let shadows = if is_coarse { Shadows::Coarse } else { Shadows::Kept(&shadows) };
        let ground = request.add_ground(&mut staged, shadows);
        let is_coarse = is_coarse && ground.is_some();
        let chains = match chains {
            Some(chains) => chains,
            None => Arc::new(Chains::new(&staged.model, &staged.options)?),
        };
        Ok(Self { request, wishes, staged, bare, ground, is_coarse, chains, motion })
    }

    /// Draws what a camera sees: with one sample a pixel if it is a draft.
    ///
    /// # Errors
    /// It cannot be drawn with these options.
    pub(super) fn picture(&self, camera: &Camera, is_draft: bool) -> Result<Seen, Error> {
        let Self { request, staged, chains, .. } = self;
        let Staged { options, samples, backdrop, .. } = staged;
        let (model, is_below) = self.drawn(camera);
        let shot = Set { model, options, samples: *samples, backdrop }.shot(*camera);
        if let Some(what) = request.arguments.show {
            let Shown { picture, legend, .. } =
                show(what, &shot.model, &shot.camera, options, &mut |_, _| ())?;
            let legend = legend.text(false).lines().map(str::to_owned).collect();
            return Ok(Seen { image: picture.image, stats: picture.stats, legend });
        }
        let samples = if is_draft { Samples::One } else { *samples };
        let of = (&*shot.model, &shot.camera);
        let Picture { image, stats, .. } =
            supersampled_with(chains, of, options, samples, backdrop, &mut |_, _| ())?;
        let below = is_below.then(|| "from below there is no ground".to_owned());
        let empty =
            (stats.written == 0).then(|| "nothing is in the picture; 0 looks at all of it".to_owned());
        Ok(Seen { image, stats, legend: below.into_iter().chain(empty).collect() })
    }

    /// The model as a camera sees it, and whether that is below its ground, which is left out then.
    pub(super) fn drawn(&self, camera: &Camera) -> (&Model, bool) {
        let is_below = |_: &&Model| self.ground.as_ref().is_some_and(|ground| !ground.is_below(camera));
        let below = self.bare.as_ref().filter(is_below);
        (below.unwrap_or(&self.staged.model), below.is_some())
    }

    /// The value that an option has, as it is typed, if it is one for the whole scene.
    pub(super) fn value(&self, option: &str) -> Option<String> {
        let Staged { options, samples, .. } = &self.staged;
        let policies = &options.policies;
        Some(match option {
            "--interpolation" => policies.interpolation.to_string(),
            "--filter" => options.filter.to_string(),
            "--depth" => name_of(options.depth),
            "--shading" => name_of(options.shading),
            "--samples" => name_of(*samples),
            "--color" => name_of(policies.color),
            "--dither" => name_of(policies.dither),
            "--light-space" => name_of(options.light.space),
            "--show" => name_of(self.request.arguments.show?),
            "--ground" => self.bare.is_some().to_string(),
            "--projection" => match options.projection {
                Projection::Parallel { .. } => "parallel".to_owned(),
                Projection::Perspective => "perspective".to_owned(),
            },
            _ => return None,
        })
    }
}

/// The options of a camera that is moved by hand, but for its place. The planes of a scene file are those of its own
/// camera, and do not count.
pub(super) fn wishes_of(request: &Request, matches: &ArgMatches) -> Result<CameraTable, Error> {
    let CameraTable { near, far, .. } = Request::given(matches)?.arguments.camera;
    Ok(CameraTable { near, far, ..request.arguments.camera })
}
