//! Pictures beyond their scenes: a ground, and warnings.

use super::partners;
use super::staged::{Request, Staged, warn};
use crate::error::Error;
use crate::options::values::name_of;
use crate::options::{CameraTable, ColorFormat, Dither, Interpolation, Shading};
use crate::scene::{ground, order};

impl Request {
    /// [`stage`](Self::stage) for a picture: warns of colours that are not seen.
    ///
    /// # Errors
    /// As those of [`stage`](Self::stage).
    pub(super) fn stage_picture(&self) -> Result<Staged, Error> {
        let staged = self.stage()?;
        let of_file = self.file.is_none() && self.arguments.model.is_some() && self.arguments.show.is_none();
        let unseen = || partners::unseen_colors(&staged.model, staged.options.shading);
        if let Some(warning) = of_file.then(unseen).flatten() {
            warn(&warning.to_string());
        }
        Ok(staged)
    }

    /// Puts a ground under the model of a picture, if that is asked for.
    pub(super) fn add_ground(&self, staged: &mut Staged) {
        if self.arguments.render.ground != Some(true) {
            return;
        }
        let left_out = |found: &str, expected: &str| {
            let error = Error::new(found, expected).place("--ground");
            warn(&error.hint("it is left out").to_string());
        };
        if self.arguments.show.is_some() {
            return left_out("it with --show, which has the model alone", "a picture in true colours");
        }
        if staged.options.shading == Shading::VertexColor {
            return left_out("it with vertex-color, which has no shadows", "another shading");
        }
        let Staged { model, camera, options, .. } = staged;
        let CameraTable { near, far, .. } = self.arguments.camera;
        let affine = options.policies.interpolation == Interpolation::Affine;
        if !ground::add(model, camera, [near.is_some(), far.is_some()], affine) {
            return left_out("a camera below the model's lowest point", "one above the ground");
        }
        if options.policies.color != ColorFormat::Rgba8 && options.policies.dither == Dither::None {
            let found = format!("a shadow in {} without a dither", name_of(options.policies.color));
            let error = Error::new(found, "a smooth one").place("--ground");
            warn(&error.hint("--dither blue-noise leaves no rings").to_string());
        }
        order::back_to_front(model, camera);
    }
}
