//! Pictures in false colours: one number of each pixel, with a legend.
//!
//! More is lighter, and pixels without a number are white, so that they can be read in print and by the colour-blind.
//! The numbers are those of [`probe`](crate::probe), or the difference of two pictures.

use clap::ValueEnum;

use crate::error::Error;
use crate::options::{DepthFormat, Interpolation, RenderOptions, Shading};
use crate::render::Picture;
use crate::scene::{Camera, Model};
use alberti::Stats;

mod depth_step;
mod legend;
mod policy;
mod simple;

pub use legend::{Legend, Step};

/// The number that a false-colour picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum Show {
    /// Difference to the most precise policies (exact, float, f32-reversed, rgba8, 8), in steps of 1/255.
    Error,
    /// Level of detail that a mip map of the texture is read at: 1 for two texels a pixel; grey where it is magnified.
    Lod,
    /// Distance that surfaces need to be told apart by the depth buffer, in units of the scene.
    DepthStep,
    /// Fragments that are shaded, one over the other.
    Overdraw,
    /// Triangles, each in a colour of its own.
    Triangles,
    /// Runs of pixels between two divisions, in shades that alternate, over the dimmed picture.
    Policy,
}

impl Show {
    /// Whether it can be shown of that model with these options, or a warning that it can, but tells little.
    ///
    /// # Errors
    /// There is nothing that it could show.
    pub(crate) fn check(self, model: &Model, options: &RenderOptions) -> Result<Option<Error>, Error> {
        let wrong = |found: String, expected: &str| Error::new(found, expected).place("--show");
        let textured = || model.parts.iter().any(|part| part.texture.is_some());
        match self {
            Self::DepthStep if options.depth == DepthFormat::None => {
                let error = wrong("depth-step without a depth buffer".to_owned(), "one");
                Err(error.hint("choose a format with --depth"))
            }
            Self::Lod if options.shading == Shading::VertexColor => {
                let error = wrong("lod with --shading vertex-color".to_owned(), "one that reads textures");
                Err(error.hint("choose another with --shading"))
            }
            Self::Lod if !textured() => {
                let error = wrong("lod of a model without a texture".to_owned(), "a model with one");
                Err(error.hint("give it one with --texture"))
            }
            Self::Policy
                if matches!(options.policies.interpolation, Interpolation::Exact | Interpolation::Plane) =>
            {
                let found = format!("policy with --interpolation {}", options.policies.interpolation);
                Ok(Some(wrong(found, "spans:N or bounded:TEXELS").hint("every pixel is a run of its own")))
            }
            _ => Ok(None),
        }
    }
}

/// A picture in false colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// The picture. Of the counts there are the triangles only.
    pub picture: Picture,
    /// The meaning of its colours.
    pub legend: Legend,
    /// The reason why it tells less than it could.
    pub warning: Option<Error>,
}

/// Draws the model in false colours; `progress` as for [`render`](crate::render::render).
///
/// # Errors
/// Those of [`render`](crate::render::render), and where there is nothing to show.
pub fn show(
    what: Show,
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Shown, Error> {
    let warning = what.check(model, options)?;
    let of = (model, camera, options);
    let (image, legend) = match what {
        Show::Error => simple::error(of, progress),
        Show::Lod => simple::lod(of),
        Show::Overdraw => simple::overdraw(of),
        Show::Triangles => simple::triangles(of),
        Show::DepthStep => depth_step::depth_step(of),
        Show::Policy => policy::policy(of, progress),
    }?;
    let submitted = model.parts.iter().map(|part| part.triangles.len() as u64).sum();
    let picture = Picture { image, stats: Stats { submitted, ..Stats::default() } };
    Ok(Shown { picture, legend, warning })
}

/// The sources of a false-colour picture.
type Of<'a> = (&'a Model, &'a Camera, &'a RenderOptions);

/// The colour of pixels without a number.
const NOTHING: [u8; 3] = [255; 3];

/// Its step.
fn nothing() -> Step {
    Step::new(NOTHING, "nothing drawn")
}
