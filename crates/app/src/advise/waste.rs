//! Parts of a scene that it pays for and that change no pixel of its picture.

use super::candidate::{Candidate, depth_name};
use super::machine::{Cost, Costs, Machine, texels};
use super::{Advice, Work, work};
use crate::draw::{Drawing, Studio};
use crate::error::Error;
use crate::measure::Comparison;
use crate::options::{Arithmetic, Filter, Probes as FilterProbes, RenderOptions};
use crate::probe::probe;
use crate::render::{any_depth, buffer};
use crate::scene::{Camera, Detail, Model, camera};
use alberti::{Rgba8888, Target};
use std::num::NonZero;
use std::time::Instant;

/// The mean FLIP below which nobody tells two pictures apart.
const INVISIBLE: f64 = 0.002;

/// Something that could be left out, in one line, with what that saves.
#[derive(Clone, Debug, PartialEq)]
pub struct Waste {
    /// The line.
    pub line: String,
}

/// A picture and the milliseconds that it took.
type Drawn = (crate::scene::Image, f64);

/// Looks for what can be left out of a scene, from its camera and from `turns - 1` more around its target.
///
/// # Errors
/// The scene cannot be drawn.
pub fn waste(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    advice: &Advice,
    turns: u32,
) -> Result<Vec<Waste>, Error> {
    let options =
        Candidate::MOST_PRECISE.options(&RenderOptions { threads: NonZero::<usize>::MIN, ..*options });
    let mut lines = vec![];
    triangles(model, camera, &options, turns, &mut lines)?;
    let whole = draw(model, camera, &options)?;
    let bill = Bill::new(advice.wish.machine, model, camera, &options)?;
    maps(model, camera, &options, (&whole, &bill), &mut lines)?;
    filters(model, camera, &options, (&whole, &bill), &mut lines)?;
    policies(advice, &bill, camera, &mut lines);
    Ok(lines.into_iter().map(|line| Waste { line }).collect())
}

/// Triangles that are never seen, and fragments that others cover.
fn triangles(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    turns: u32,
    lines: &mut Vec<String>,
) -> Result<(), Error> {
    let total: usize = model.parts.iter().map(|part| part.triangles.len()).sum();
    let mut seen = vec![false; total];
    let (mut shaded, mut covered, mut pixels) = (0_u64, 0_u64, 0_u64);
    for turn in 0..turns {
        let probes = probe(model, &camera::turned(camera, turn, turns), options)?;
        for index in 0..probes.pixels() {
            shaded += u64::from(probes.shaded(index));
            covered += u64::from(probes.covered(index));
            if let Some(point) = probes.seen(index) {
                pixels += 1;
                if let Some(seen) = seen.get_mut(point.triangle as usize) {
                    *seen = true;
                }
            }
        }
    }
    let unseen = seen.iter().filter(|&&seen| !seen).count();
    let from =
        if turns == 1 { "from this camera".to_owned() } else { format!("from {turns} cameras around it") };
    if unseen > 0 {
        lines.push(format!(
            "triangles: {unseen} of {total} ({:.0} %) show in no pixel {from}",
            percent(unseen as u64, total as u64)
        ));
    }
    // A hundredth is not worth an order.
    if shaded * 100 > pixels * 101 {
        let (shaded, covered) = (percent(shaded, pixels) / 100.0, percent(covered, pixels) / 100.0);
        lines.push(format!(
            "overdraw: {shaded:.2} fragments are shaded and {covered:.2} tested for each pixel that is covered; front \
             to back it would be 1.00 shaded"
        ));
    }
    Ok(())
}

fn percent(part: u64, whole: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let percent = 100.0 * part as f64 / whole.max(1) as f64;
    percent
}

/// Part of a material, and how to leave it out.
type Map = (&'static str, fn(&Detail) -> bool, fn(&mut Detail));

const MAPS: [Map; 8] = [
    ("normal maps", |d| d.normal.is_some(), |d| d.normal = None),
    ("height maps", |d| d.height.is_some(), |d| d.height = None),
    ("ambient occlusion maps", |d| d.occlusion.is_some(), |d| d.occlusion = None),
    ("specular maps", |d| d.specular_map.is_some(), |d| d.specular_map = None),
    ("shininess maps", |d| d.shininess_map.is_some(), |d| d.shininess_map = None),
    ("wetness", |d| d.wetness > 0.0, |d| (d.wetness, d.wetness_map) = (0.0, None)),
    ("emission", |d| d.emissive != [0.0; 3], |d| (d.emissive, d.emissive_map) = ([0.0; 3], None)),
    ("reflections", |d| d.environment.is_some(), |d| d.environment = None),
];

fn maps(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    (whole, bill): (&Drawn, &Bill),
    lines: &mut Vec<String>,
) -> Result<(), Error> {
    for (name, is_there, remove) in MAPS {
        if !model.parts.iter().any(|part| is_there(&part.detail)) {
            continue;
        }
        let mut without = model.clone();
        for part in &mut without.parts {
            remove(&mut part.detail);
        }
        let drawn = draw(&without, camera, options)?;
        let change = Comparison::new(&drawn.0, &whole.0)?.measures;
        let saves = bill.saves(bill.maps(whole.1 - drawn.1, texels(model) - texels(&without)));
        if change.largest == 0 {
            lines.push(format!("{name}: they change no pixel; to leave them out {saves}"));
        } else if change.flip < INVISIBLE {
            lines.push(format!(
                "{name}: nobody sees them (mean FLIP {:.4}); to leave them out {saves}",
                change.flip
            ));
        }
    }
    Ok(())
}

/// Filters that are cheaper and look the same.
fn filters(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    (whole, bill): (&Drawn, &Bill),
    lines: &mut Vec<String>,
) -> Result<(), Error> {
    const FILTERS: [(&str, Filter); 4] = [
        ("nearest", Filter::Nearest),
        ("bilinear", Filter::Bilinear),
        ("trilinear", Filter::Trilinear),
        ("anisotropic:2", Filter::Anisotropic(FilterProbes::Two)),
    ];
    if model.textures.is_empty() {
        return Ok(());
    }
    for (name, filter) in FILTERS {
        if filter == options.filter {
            break;
        }
        let drawn = draw(model, camera, &RenderOptions { filter, ..*options })?;
        let flip = Comparison::new(&drawn.0, &whole.0)?.measures.flip;
        if flip < INVISIBLE {
            let saves = bill.saves(bill.filter(whole.1 - drawn.1, options, filter));
            lines.push(format!("filter: {name} looks the same (mean FLIP {flip:.4}); it {saves}"));
            break;
        }
    }
    Ok(())
}

/// Policies that give the same picture, of each kind: the cheapest, and of depth formats the smallest.
fn policies(advice: &Advice, bill: &Bill, camera: &Camera, lines: &mut Vec<String>) {
    let Advice { trials, reference, .. } = advice;
    let alike = |is: fn(Candidate) -> bool, key: fn(&Cost) -> f64| {
        let same = trials.iter().filter(|trial| trial.largest == 0 && is(trial.candidate));
        let least = same.min_by(|a, b| key(&a.cost).total_cmp(&key(&b.cost)))?;
        let saved = |of: fn(&Cost) -> f64| of(&reference.cost) - of(&least.cost);
        let saved = Cost { frame: saved(|c| c.frame), flash: saved(|c| c.flash), ram: saved(|c| c.ram) };
        let saves = bill.saves(saved);
        (least.candidate != Candidate::MOST_PRECISE).then_some((least.candidate, saves))
    };
    if let Some((candidate, saves)) = alike(Candidate::is_interpolation, |cost| cost.frame) {
        let name = candidate.interpolation;
        let arithmetic = match candidate.arithmetic {
            Arithmetic::Float => "float",
            Arithmetic::Fixed => "fixed",
        };
        lines.push(format!(
            "interpolation: `{name}` in {arithmetic} gives the same picture as exact; it {saves}"
        ));
    }
    if let Some((candidate, saves)) = alike(Candidate::is_depth, |cost| cost.ram) {
        let (name, near, far) = (depth_name(candidate.depth), camera.near, camera.far);
        lines.push(format!(
            "depth: between {near} and {far} `{name}` gives the same picture as f32-reversed; it {saves}"
        ));
    }
    if let Some((_, saves)) = alike(Candidate::is_grid, |cost| cost.frame) {
        lines.push(format!(
            "subpixels: 4 bits give the same picture as 8; they {}",
            saves.replacen("saves", "save", 1).replacen("and costs", "and cost", 1)
        ));
    }
}

/// Prices on the machine that is advised for.
struct Bill {
    machine: Machine,
    costs: Costs,
    /// The work under the most precise policies.
    work: Work,
}

impl Bill {
    fn new(machine: Machine, model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Self, Error> {
        Ok(Self { machine, costs: Costs::new(machine, options)?, work: work(model, camera, options)? })
    }

    /// The saving of so many milliseconds on the host, which a chip has no model of, and of so many texels.
    fn maps(&self, time: f64, texels: f64) -> Cost {
        let bytes = texels * self.costs.texel();
        if self.machine.is_chip() {
            Cost { flash: bytes, ..Cost::default() }
        } else {
            Cost { frame: time, ram: bytes, ..Cost::default() }
        }
    }

    /// The saving of another filter instead of the options'.
    fn filter(&self, time: f64, options: &RenderOptions, filter: Filter) -> Cost {
        let at = |filter| {
            self.costs.of(Candidate::MOST_PRECISE, &RenderOptions { filter, ..*options }, &self.work)
        };
        match (at(options.filter), at(filter)) {
            (Some(whole), Some(other)) => Cost {
                frame: whole.frame - other.frame,
                flash: whole.flash - other.flash,
                ram: whole.ram - other.ram,
            },
            _ => Cost { frame: time, ..Cost::default() },
        }
    }

    /// A saving in words, and what it costs in time.
    fn saves(&self, saved: Cost) -> String {
        let bytes = |bytes: f64, of: &str| {
            let text = if bytes < 10240.0 {
                format!("{bytes:.0} bytes")
            } else {
                format!("{:.0} KB", bytes / 1024.0)
            };
            (bytes >= 0.5).then(|| format!("{text} of {of}"))
        };
        let frame = |frame: f64| {
            if self.machine.is_chip() {
                (frame >= 500.0).then(|| format!("{:.3} M instructions a frame", frame / 1e6))
            } else {
                (frame >= 0.005).then(|| format!("{frame:.2} ms a frame"))
            }
        };
        let memory = if self.machine.is_chip() { "RAM" } else { "memory" };
        let parts: Vec<String> = [frame(saved.frame), bytes(saved.flash, "flash"), bytes(saved.ram, memory)]
            .into_iter()
            .flatten()
            .collect();
        let saves = match parts.split_last() {
            None => "saves nothing".to_owned(),
            Some((last, [])) => format!("saves {last}"),
            Some((last, first)) => format!("saves {} and {last}", first.join(", ")),
        };
        match frame(-saved.frame) {
            None => saves,
            Some(dearer) => format!("{saves}, and costs {dearer}"),
        }
    }
}

/// The picture, and the least time of two.
fn draw(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Drawn, Error> {
    let studio = Studio::new(model, camera, options)?;
    let (mut pixels, mut depth) = (buffer(options, 0)?, buffer(options, 0)?);
    let RenderOptions { width, height, .. } = *options;
    let mut target = Target::new(Rgba8888, any_depth(options.depth), width, height, &mut pixels, &mut depth)
        .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
    let mut time = f64::INFINITY;
    for _ in 0..2 {
        let drawing = Drawing::new(model, camera, options, &studio)?;
        let start = Instant::now();
        drawing.draw_all(&mut target, &mut |_, _| ());
        time = time.min(start.elapsed().as_secs_f64() * 1e3);
    }
    let texels = pixels.iter().map(|pixel: &u32| pixel.to_ne_bytes()).collect();
    Ok((crate::scene::Image { width, height, texels }, time))
}
