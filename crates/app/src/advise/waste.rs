//! Parts of a scene that it pays for and that change no pixel of its picture.

use super::Trial;
use super::candidate::{Candidate, depth_name};
use crate::draw::{Drawing, Studio};
use crate::error::Error;
use crate::measure::Comparison;
use crate::options::{Filter, Probes as FilterProbes, RenderOptions};
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
    trials: &[Trial],
    turns: u32,
) -> Result<Vec<Waste>, Error> {
    let options =
        Candidate::MOST_PRECISE.options(&RenderOptions { threads: NonZero::<usize>::MIN, ..*options });
    let mut lines = vec![];
    triangles(model, camera, &options, turns, &mut lines)?;
    let whole = draw(model, camera, &options)?;
    maps(model, camera, &options, &whole, &mut lines)?;
    filters(model, camera, &options, &whole, &mut lines)?;
    depths(trials, camera, &options, &mut lines);
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
    lines.push(format!(
        "triangles: {unseen} of {total} ({:.0} %) show in no pixel {from}",
        percent(unseen as u64, total as u64)
    ));
    if pixels > 0 {
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
    whole: &Drawn,
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
        let saves = format!("without them a frame takes {:.1} ms instead of {:.1}", drawn.1, whole.1);
        if change.largest == 0 {
            lines.push(format!("{name}: they change no pixel; {saves}"));
        } else if change.flip < INVISIBLE {
            lines.push(format!("{name}: nobody sees them (mean FLIP {:.4}); {saves}", change.flip));
        }
    }
    Ok(())
}

/// Filters that are cheaper and look the same.
fn filters(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    whole: &Drawn,
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
            lines.push(format!(
                "filter: {name} looks the same (mean FLIP {flip:.4}); with it a frame takes {:.1} ms instead of {:.1}",
                drawn.1, whole.1
            ));
            break;
        }
    }
    Ok(())
}

/// Depth formats and grids that give the same picture.
fn depths(trials: &[Trial], camera: &Camera, options: &RenderOptions, lines: &mut Vec<String>) {
    let same = |trial: &&Trial| trial.largest == 0;
    let smaller = trials.iter().filter(same).filter(|trial| trial.candidate.is_depth());
    let pixels = options.width as usize * options.height as usize;
    if let Some(trial) = smaller.min_by_key(|trial| trial.candidate.depth_bytes()) {
        let (name, bytes) = (depth_name(trial.candidate.depth), trial.candidate.depth_bytes());
        lines.push(format!(
            "depth: between {} and {} `{name}` gives the same picture, in {} KB where 4 bytes a pixel take {} KB",
            camera.near,
            camera.far,
            bytes * pixels / 1024,
            4 * pixels / 1024
        ));
    }
    if trials.iter().filter(same).any(|t| t.candidate.is_grid() && t.candidate != Candidate::MOST_PRECISE) {
        lines.push("subpixels: 4 bits give the same picture as 8".to_owned());
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
