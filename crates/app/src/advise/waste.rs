//! Parts of a scene that it pays for and that change no pixel of its picture.

mod bill;
mod look;

use super::Advice;
use super::candidate::{Candidate, arithmetic_name, depth_name};
use super::machine::Cost;
use crate::error::{Error, number};
use crate::options::RenderOptions;
use crate::probe::probe;
use crate::scene::normals::narrow;
use crate::scene::{Camera, Model, camera};
use bill::Bill;
use look::Look;
use std::num::NonZero;

/// Something that could be left out, in one line, with what that saves.
#[derive(Clone, Debug, PartialEq)]
pub struct Waste {
    /// The line.
    pub line: String,
}

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
    let bill = Bill::new(advice, &options)?;
    triangles((model, camera, &options), turns, &bill, &mut lines)?;
    Look::new(model, camera, &options, &bill)?.lines(&mut lines)?;
    policies(advice, &bill, camera, &mut lines);
    Ok(lines.into_iter().map(|line| Waste { line }).collect())
}

/// Triangles that are never seen, and fragments that others cover.
fn triangles(
    (model, camera, options): (&Model, &Camera, &RenderOptions),
    turns: u32,
    bill: &Bill,
    lines: &mut Vec<String>,
) -> Result<(), Error> {
    let total: usize = model.parts.iter().map(|part| part.triangles.len()).sum();
    let mut seen = vec![false; total];
    let (mut shaded, mut covered, mut pixels) = (0_u64, 0_u64, 0_u64);
    for turn in 0..turns {
        let mut turned = camera::turned(camera, None, 360.0 * f64::from(turn) / f64::from(turns.max(1)));
        if turn > 0 {
            // From there something may be nearer.
            let nearest = narrow(0.99 * camera::nearest(model, &turned));
            turned.near = turned.near.min(nearest.max(turned.far / 1000.0));
        }
        let probes = probe(model, &turned, options)?;
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
            "triangles: {unseen} of {total} ({:.0} %) show in no pixel {from}; to leave them out {}",
            percent(unseen as u64, total as u64),
            bill.saves(bill.triangles(model, camera, options, &seen)?)
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
        let arithmetic = arithmetic_name(candidate.arithmetic);
        lines.push(format!(
            "interpolation: `{name}` in {arithmetic} gives the same picture as exact; it {saves}"
        ));
    }
    if let Some((candidate, saves)) = alike(Candidate::is_depth, |cost| cost.ram) {
        let (name, near, far) = (depth_name(candidate.depth), short(camera.near), short(camera.far));
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

/// A number to four digits.
fn short(x: f32) -> String {
    number(format!("{x:.3e}").parse().unwrap_or(x))
}
