//! Errors and costs of policies on a scene.

use super::candidate::Candidate;
use super::machine::{Cost, Costs};
use super::{Off, Wish, Work, texels, work};
use crate::display::stored;
use crate::draw::{Canvas, Counted, Drawing, Studio};
use crate::error::Error;
use crate::measure::{Comparison, MOST, MaxError, percentile, steps};
use crate::options::{Arithmetic, ColorFormat, DepthFormat, Interpolation, RenderOptions};
use crate::probe::{Probes, probe_values};
use crate::render::{any_depth, buffer};
use crate::scene::{Camera, Image, Model};
use alberti::{Rgba8888, Stats, Target};
use std::cell::RefCell;
use std::num::NonZero;
use std::time::Instant;

/// Frames of a first measurement on the host: so many, and more up to so many milliseconds.
const FRAMES: usize = 2;
const MOST_FRAMES: usize = 12;
const ENOUGH: f64 = 10.0;
/// Turns of policies that are timed beside each other: as many as that time allows, in milliseconds.
const TURNS: usize = 7;
const MOST_TURNS: usize = 31;
const PATIENCE: f64 = 500.0;

/// Policies that were tried.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Which.
    pub candidate: Candidate,
    /// The figure in the unit of the budget.
    pub error: f64,
    /// The largest difference of a byte from the right picture.
    pub largest: u8,
    /// The cost. On the host a frame's is the least of some, or what turns beside the most precise policies make of it.
    pub cost: Cost,
    /// The counts for the model of a chip.
    pub(super) work: Work,
    /// The picture.
    pub picture: Image,
}

/// A scene, and its right picture.
pub(super) struct Bench<'a> {
    model: &'a Model,
    camera: &'a Camera,
    options: RenderOptions,
    wish: Wish,
    studio: Studio,
    costs: Costs,
    right: Image,
    /// On the host, where vertices alone are asked for.
    work: Work,
    vertices: u64,
    /// Rows and runs of what was tried.
    counted: RefCell<Vec<(Candidate, Counted)>>,
    /// Of budgets in texels.
    probes: Option<Probes>,
}

impl<'a> Bench<'a> {
    pub(super) fn new(
        model: &'a Model,
        camera: &'a Camera,
        options: &RenderOptions,
        wish: Wish,
    ) -> Result<Self, Error> {
        let mut options = RenderOptions { threads: NonZero::<usize>::MIN, ..*options };
        if wish.machine.is_chip() {
            // As the model's displays have it.
            options.policies.color = ColorFormat::Rgb565;
        }
        let most_precise = Candidate::MOST_PRECISE.options(&options);
        let costs = Costs::new(wish.machine, &options)?;
        let studio = Studio::new(model, camera, &most_precise)?;
        let probes = match wish.budget {
            MaxError::Texel(_) if model.textures.is_empty() && model.heights.is_empty() => {
                return Err(Error::new("a scene without textures", "one with texels")
                    .place("--max-error")
                    .hint("give the budget in lsb, flip or db"));
            }
            MaxError::Texel(_) => Some(probe_values(model, camera, &most_precise)?),
            _ => None,
        };
        let right = Image { width: options.width, height: options.height, texels: vec![] };
        let (vertices, work) = (work::vertices(model), Work::default());
        let counted = RefCell::default();
        let mut bench =
            Self { model, camera, options, wish, studio, costs, right, work, vertices, counted, probes };
        // Several frames, so that the first to be timed finds the machine as warm as the others.
        bench.right = bench.draw(Candidate::MOST_PRECISE, FRAMES + 1)?.0;
        bench.work.vertices = Work::new(vertices, Stats::default(), Counted::default()).vertices;
        Ok(bench)
    }

    /// How far costs are off, of a chip.
    pub(super) fn off(&self) -> Option<Off> {
        self.costs.off()
    }

    /// Whether the machine can draw so.
    pub(super) fn has(&self, candidate: Candidate) -> bool {
        self.costs.has(candidate, &self.options)
    }

    /// Draws, measures, and times a few frames or counts their work.
    pub(super) fn try_out(&self, candidate: Candidate) -> Result<Trial, Error> {
        let options = candidate.options(&self.options);
        let chip = self.wish.machine.is_chip();
        let few = chip || self.wish.thorough;
        let (picture, times, stats) = self.draw(candidate, if few { 1 } else { FRAMES })?;
        let work = if chip { self.count(candidate, stats)? } else { self.work };
        let cost = self.costs.of(candidate, &options, &work).unwrap_or_else(|| Cost {
            frame: times.into_iter().fold(f64::INFINITY, f64::min),
            flash: 0.0,
            ram: self.costs.ram(candidate, &options, &work),
        });
        let differences = steps(&picture, &self.right)?;
        let error = match self.wish.budget {
            MaxError::Lsb(_) => percentile(&differences, MOST).unwrap_or_default().into(),
            MaxError::Flip(_) => Comparison::new(&picture, &self.right)?.measures.flip,
            MaxError::Db(_) => Comparison::new(&picture, &self.right)?.measures.psnr(),
            MaxError::Texel(_) => self.texels(&options)?,
        };
        let largest = differences.iter().copied().max().unwrap_or_default();
        Ok(Trial { candidate, error, largest, cost, work, picture })
    }

    /// The work of a frame with these counts. Of one without a budget, rows and runs do not depend on depths.
    fn count(&self, candidate: Candidate, stats: Stats) -> Result<Work, Error> {
        Ok(Work::new(self.vertices, stats, self.counted(candidate)?))
    }

    /// The same counts again for ways of drawing in which they are the same.
    fn counted(&self, candidate: Candidate) -> Result<Counted, Error> {
        let key = match (candidate.interpolation, candidate.arithmetic) {
            (Interpolation::Bounded(_), _) => candidate,
            (_, Arithmetic::Fixed) if !work::is_shallow(candidate.depth) => candidate,
            _ => Candidate { depth: DepthFormat::None, ..candidate },
        };
        let known =
            self.counted.borrow().iter().find(|(known, _)| *known == key).map(|(_, counted)| *counted);
        let counted = match known {
            Some(counted) => counted,
            None => work::counted(self.model, self.camera, &candidate.options(&self.options))?,
        };
        if known.is_none() {
            self.counted.borrow_mut().push((key, counted));
        }
        Ok(counted)
    }

    /// The cost that a combination promises by those of its parts, as a share of the most precise policies' cost.
    pub(super) fn promise(
        &self,
        candidate: Candidate,
        [lines, depth, grid]: [&Trial; 3],
        whole: &Trial,
    ) -> Result<f64, Error> {
        let share = |trial: &Trial| trial.cost.frame / whole.cost.frame;
        if !self.wish.machine.is_chip() {
            return Ok(share(lines) * share(depth) * share(grid));
        }
        // Which triangles are small depends on all three, but of depths only on whether they are deep.
        let alike =
            if work::is_shallow(candidate.depth) { DepthFormat::None } else { DepthFormat::F32Reversed };
        let Work { submitted, clipped, .. } = lines.work;
        let work = Work {
            submitted,
            clipped,
            written: depth.work.written,
            ..self.count(Candidate { depth: alike, ..candidate }, Stats::default())?
        };
        let known = self.costs.of(candidate, &self.options, &work);
        Ok(known.map_or(f64::INFINITY, |cost| cost.frame / whole.cost.frame))
    }

    /// Times policies in turns with the most precise ones, and corrects their times. All that were tried stay multiples
    /// of one time, the least of the most precise.
    pub(super) fn time_together(&self, candidates: &[Candidate], trials: &mut [Trial]) -> Result<(), Error> {
        let of = |trials: &[Trial], candidate| trials.iter().position(|trial| trial.candidate == candidate);
        let Some(precise) = of(trials, Candidate::MOST_PRECISE).and_then(|at| trials.get(at)) else {
            return Ok(());
        };
        let least = precise.cost.frame;
        let all: Vec<Candidate> = [&[Candidate::MOST_PRECISE], candidates].concat();
        let medians = self.medians(&all)?;
        for (candidate, median) in all.iter().zip(&medians).skip(1) {
            if let Some(trial) = of(trials, *candidate).and_then(|at| trials.get_mut(at)) {
                trial.cost.frame = least * median / medians[0];
            }
        }
        Ok(())
    }

    /// The median times of policies in turns, in milliseconds.
    pub(super) fn medians(&self, candidates: &[Candidate]) -> Result<Vec<f64>, Error> {
        let mut taken = vec![vec![]; candidates.len()];
        let start = Instant::now();
        for turn in 0..MOST_TURNS {
            if turn >= TURNS && start.elapsed().as_secs_f64() * 1e3 > PATIENCE {
                break;
            }
            // Another one begins each turn.
            for k in (0..candidates.len()).map(|k| (k + turn) % candidates.len()) {
                taken[k].extend(self.draw(candidates[k], 1)?.1);
            }
        }
        let median = |mut times: Vec<f64>| {
            times.sort_by(f64::total_cmp);
            times.get(times.len() / 2).copied().unwrap_or(f64::INFINITY)
        };
        Ok(taken.into_iter().map(median).collect())
    }

    /// The picture, and the milliseconds of so many frames of it, or a few more if they are short.
    fn draw(&self, candidate: Candidate, frames: usize) -> Result<(Image, Vec<f64>, Stats), Error> {
        let options = candidate.options(&self.options);
        let (mut pixels, mut depth) = (buffer(&options, 0)?, buffer(&options, 0)?);
        let (width, height, format) = (options.width, options.height, any_depth(options.depth));
        let mut target: Canvas<'_> = Target::new(Rgba8888, format, width, height, &mut pixels, &mut depth)
            .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
        let (mut times, mut stats): (Vec<f64>, _) = (vec![], Stats::default());
        while times.len() < frames
            || frames > 1 && times.len() < MOST_FRAMES && times.iter().sum::<f64>() < ENOUGH
        {
            let drawing = Drawing::new(self.model, self.camera, &options, &self.studio)?;
            let start = Instant::now();
            stats = drawing.draw_all(&mut target, &mut |_, _| ());
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        let places = (0..height.cast_signed())
            .flat_map(|row| (0..width.cast_signed()).map(move |column| [column, row]));
        let texels = places.zip(&pixels);
        let texels = texels
            .map(|(place, pixel): (_, &u32)| stored(&options.policies, place, pixel.to_ne_bytes()).color);
        Ok((Image { width, height, texels: texels.collect() }, times, stats))
    }

    fn texels(&self, options: &RenderOptions) -> Result<f64, Error> {
        let Some(right) = &self.probes else { return Ok(0.0) };
        Ok(texels::error(self.model, right, &probe_values(self.model, self.camera, options)?))
    }
}
