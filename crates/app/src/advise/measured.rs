//! Errors and times of policies on a scene.

use super::candidate::Candidate;
use crate::draw::{Canvas, Drawing, Studio};
use crate::error::Error;
use crate::measure::{Comparison, MOST, MaxError, percentile, steps};
use crate::options::RenderOptions;
use crate::probe::{Probes, probe};
use crate::render::{any_depth, buffer, shown};
use crate::scene::{Camera, Image, Model};
use alberti::{Rgba8888, Target};
use std::num::NonZero;
use std::time::Instant;

/// Frames of a first measurement, and turns of one beside others.
const FRAMES: usize = 3;
const TURNS: usize = 7;

/// Policies that were tried.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Which.
    pub candidate: Candidate,
    /// The figure in the unit of the budget.
    pub error: f64,
    /// The largest difference of a byte from the right picture.
    pub largest: u8,
    /// Milliseconds of a frame on one thread: the least of some, and of finalists the median of turns.
    pub time: f64,
    /// The picture.
    pub picture: Image,
}

/// A scene, and its right picture.
pub(super) struct Bench<'a> {
    model: &'a Model,
    camera: &'a Camera,
    options: RenderOptions,
    budget: MaxError,
    studio: Studio,
    right: Image,
    /// Of budgets in texels.
    probes: Option<Probes>,
}

impl<'a> Bench<'a> {
    pub(super) fn new(
        model: &'a Model,
        camera: &'a Camera,
        options: &RenderOptions,
        budget: MaxError,
    ) -> Result<Self, Error> {
        let options = RenderOptions { threads: NonZero::<usize>::MIN, ..*options };
        let most_precise = Candidate::MOST_PRECISE.options(&options);
        let studio = Studio::new(model, camera, &most_precise)?;
        let probes = match budget {
            MaxError::Texel(_) => Some(probe(model, camera, &most_precise)?),
            _ => None,
        };
        let right = Image { width: options.width, height: options.height, texels: vec![] };
        let mut bench = Self { model, camera, options, budget, studio, right, probes };
        bench.right = bench.draw(Candidate::MOST_PRECISE, 1)?.0;
        Ok(bench)
    }

    /// Draws, measures, and times a few frames.
    pub(super) fn try_out(&self, candidate: Candidate) -> Result<Trial, Error> {
        let (picture, times) = self.draw(candidate, FRAMES)?;
        let time = times.into_iter().fold(f64::INFINITY, f64::min);
        let differences = steps(&picture, &self.right)?;
        let error = match self.budget {
            MaxError::Lsb(_) => percentile(&differences, MOST).unwrap_or_default().into(),
            MaxError::Flip(_) => Comparison::new(&picture, &self.right)?.measures.flip,
            MaxError::Db(_) => Comparison::new(&picture, &self.right)?.measures.psnr(),
            MaxError::Texel(_) => self.texels(candidate)?,
        };
        let largest = differences.iter().copied().max().unwrap_or_default();
        Ok(Trial { candidate, error, largest, time, picture })
    }

    /// Times policies in turns, and puts the medians in.
    pub(super) fn time_together(&self, trials: &mut [Trial]) -> Result<(), Error> {
        let mut taken = vec![vec![]; trials.len()];
        for _ in 0..TURNS {
            for (trial, taken) in trials.iter().zip(&mut taken) {
                taken.extend(self.draw(trial.candidate, 1)?.1);
            }
        }
        for (trial, mut taken) in trials.iter_mut().zip(taken) {
            taken.sort_by(f64::total_cmp);
            trial.time = taken.get(taken.len() / 2).copied().unwrap_or(trial.time);
        }
        Ok(())
    }

    /// The picture, and the milliseconds of so many frames of it.
    fn draw(&self, candidate: Candidate, frames: usize) -> Result<(Image, Vec<f64>), Error> {
        let options = candidate.options(&self.options);
        let (mut pixels, mut depth) = (buffer(&options, 0)?, buffer(&options, 0)?);
        let (width, height, format) = (options.width, options.height, any_depth(options.depth));
        let mut target: Canvas<'_> = Target::new(Rgba8888, format, width, height, &mut pixels, &mut depth)
            .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
        let mut times = vec![];
        for _ in 0..frames {
            let drawing = Drawing::new(self.model, self.camera, &options, &self.studio)?;
            let start = Instant::now();
            drawing.draw_all(&mut target, &mut |_, _| ());
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        let texels = pixels.iter().map(|pixel: &u32| shown(options.policies.color, pixel.to_ne_bytes()));
        Ok((Image { width, height, texels: texels.collect() }, times))
    }

    /// The 99.9 % percentile of the distance between texture coordinates, where both see the same triangle: in texels
    /// of its part's texture, or of 256 where it has none.
    fn texels(&self, candidate: Candidate) -> Result<f64, Error> {
        let Some(right) = &self.probes else { return Ok(0.0) };
        let found = probe(self.model, self.camera, &candidate.options(&self.options))?;
        let sides: Vec<[f64; 2]> = self.model.parts.iter().map(|part| self.sides(part.texture)).collect();
        let pairs = (0..right.pixels()).filter_map(|index| Some((right.seen(index)?, found.seen(index)?)));
        let errors: Vec<f64> = pairs
            .filter(|(a, b)| a.triangle == b.triangle)
            .filter_map(|(a, b)| {
                let ([u0, v0], [u1, v1], [width, height]) = (a.uv?, b.uv?, *sides.get(a.part)?);
                Some(((u1 - u0).abs() * width).max((v1 - v0).abs() * height))
            })
            .collect();
        Ok(percentile(&errors, MOST).unwrap_or_default())
    }

    fn sides(&self, texture: Option<usize>) -> [f64; 2] {
        let image = texture.and_then(|index| self.model.textures.get(index));
        image.map_or([256.0; 2], |image| [image.width, image.height].map(f64::from))
    }
}
