//! Picks of `alberti advise` beside the best of all combinations: whether they keep the budget, and how much dearer
//! they are. The scenes are none of those that it was tuned on.

use alberti_app::advise::{Candidate, Machine, Trial, Wish, advise, times};
use alberti_app::cli::advise::scene;
use alberti_app::error::Error;
use alberti_app::measure::{Comparison, MaxError};
use alberti_app::options::ColorFormat;
use alberti_app::render::render;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

/// The names of scenes, built-in ones with `--scene` before them.
const SCENES: [&str; 10] = [
    "--scene hero",
    "--scene floor",
    "--scene inside",
    "cobblestones.toml",
    "grazing.toml",
    "lights.toml",
    "normal-map.toml",
    "reflection-sphere.toml",
    "slide.toml",
    "wetness.toml",
];
/// A small display, of which all combinations can be drawn.
const SIZE: &str = "320x240";
const BUDGETS: [MaxError; 2] = [MaxError::Lsb(2.0), MaxError::Texel(0.5)];
const MACHINES: [Machine; 2] = [Machine::Host, Machine::M4f];
/// The most that a pick may cost, as a multiple of the cheapest.
const LIMIT: f64 = 1.1;
/// The cheapest of all that are timed beside the pick.
const TIMED: usize = 12;

/// A scene, a budget and a machine, and what was picked.
#[derive(Clone, Debug)]
pub struct Found {
    /// The scene's name.
    pub scene: &'static str,
    /// The budget.
    pub budget: MaxError,
    /// The machine.
    pub machine: Machine,
    /// The options of the pick.
    pub pick: String,
    /// Its error.
    pub error: f64,
    /// Those of the cheapest within the budget.
    pub best: String,
    /// The pick's cost: milliseconds, or instructions of a chip.
    pub cost: f64,
    /// The same as a multiple of the cheapest.
    pub ratio: f64,
    /// Seconds that the advice took.
    pub seconds: f64,
}

/// Asks for all advice.
///
/// # Errors
/// A scene that cannot be drawn.
pub fn measure(root: &Path) -> Result<Vec<Found>, Error> {
    let mut all = vec![];
    for name in SCENES {
        for machine in MACHINES {
            for budget in BUDGETS {
                let found = ask(root, name, budget, machine)?;
                eprintln!("{name}, {}, {budget}: {:.3}, {:.1} s", machine.name(), found.ratio, found.seconds);
                all.push(found);
            }
        }
    }
    Ok(all)
}

fn ask(root: &Path, name: &'static str, budget: MaxError, machine: Machine) -> Result<Found, Error> {
    let file = root.join("crates/app/scenes").join(name).display().to_string();
    let arguments: Vec<&str> = match name.split_once(' ') {
        Some((option, built_in)) => vec![option, built_in, "--size", SIZE],
        None => vec![&file, "--size", SIZE],
    };
    let (model, camera, options) = scene(&arguments)?;
    let ask =
        |thorough| advise(&model, &camera, &options, Wish { budget, machine, thorough }, &mut |_, _| ());
    let start = Instant::now();
    let quick = ask(false)?;
    let seconds = start.elapsed().as_secs_f64();
    let all = ask(true)?;
    let pick = &quick.trials[quick.pick];
    let error = match budget {
        // From pictures of the command's own, as `render` and `compare` have them.
        MaxError::Lsb(_) => {
            let picture = |candidate: Candidate| {
                let mut options = candidate.options(&options);
                if machine.is_chip() {
                    options.policies.color = ColorFormat::Rgb565;
                }
                render(&model, &camera, &options, &mut |_, _| ()).map(|picture| picture.image)
            };
            let [found, right] = [picture(pick.candidate)?, picture(Candidate::MOST_PRECISE)?];
            Comparison::new(&found, &right)?.measures.most.into()
        }
        _ => pick.error,
    };
    let within = all.trials.iter().filter(|trial| budget.admits(trial.error));
    let candidates: Vec<&Trial> =
        within.take(TIMED).filter(|trial| trial.candidate != pick.candidate).collect();
    let candidates: Vec<&Trial> = [pick].into_iter().chain(candidates).collect();
    let costs = |trials: &[&Trial]| {
        if machine.is_chip() {
            return Ok(trials.iter().map(|trial| trial.cost.frame).collect());
        }
        let candidates: Vec<Candidate> = trials.iter().map(|trial| trial.candidate).collect();
        times(&model, &camera, &options, &candidates)
    };
    let all: Vec<f64> = costs(&candidates)?;
    let cheapest = (0..all.len()).min_by(|a, b| all[*a].total_cmp(&all[*b])).unwrap_or(0);
    let best = candidates[cheapest];
    // Again, as the least of many times owes some of it to luck.
    let pair: Vec<f64> = if cheapest == 0 { vec![all[0]; 2] } else { costs(&[pick, best])? };
    Ok(Found {
        scene: name.trim_start_matches("--scene ").trim_end_matches(".toml"),
        budget,
        machine,
        pick: pick.candidate.command_line(),
        error,
        best: best.candidate.command_line(),
        cost: pair[0],
        ratio: pair[0] / pair[1],
        seconds,
    })
}

/// The figures in a sentence.
pub fn summary(all: &[Found]) -> String {
    let kept = all.iter().filter(|found| found.budget.admits(found.error)).count();
    let cheap = all.iter().filter(|found| found.ratio <= LIMIT).count();
    let dearest = all.iter().map(|found| found.ratio).fold(1.0, f64::max);
    let slowest = all.iter().map(|found| found.seconds).fold(0.0, f64::max);
    format!(
        "{kept} of {count} picks are within the budget, {cheap} at most {LIMIT:.2} times as dear as the best of all. The \
         dearest is {dearest:.3} times as dear. The slowest advice took {slowest:.1} s.",
        count = all.len()
    )
}

/// # Errors
/// A pick beyond the budget; or one for a chip, whose costs repeat, that is too dear.
pub fn check(all: &[Found]) -> Result<(), String> {
    let wrong = |found: &&Found| {
        !found.budget.admits(found.error) || (found.machine.is_chip() && found.ratio > LIMIT)
    };
    match all.iter().find(wrong) {
        None => Ok(()),
        Some(Found { scene, budget, machine, pick, error, ratio, .. }) => Err(format!(
            "{scene}, {}, {budget}: `{pick}` has an error of {error} and {ratio:.3} times the least cost",
            machine.name()
        )),
    }
}

const HEADING: &str = "\
# Advice beside the best of all

`alberti advise` tries some of the ways to draw a scene. `--thorough` tries all of them: each interpolation with each
arithmetic, depth format and grid. Here both are asked about ten scenes of 320x240 that the search was not tuned on, and
the pick is compared with the cheapest of all that keep the budget. On the host both are timed in turns, as medians,
which do not repeat: below 1 the pick was the cheaper one after all. Instructions of the m4f are those of the model, and
do. Errors are 99.9 % percentiles. A pick is its interpolation, arithmetic, depth format and bits of subpixels.

    cargo xtask advice

";

/// The page.
pub fn page(all: &[Found]) -> String {
    let mut text = HEADING.to_owned();
    // A sentence a line.
    let _ = writeln!(text, "{}\n", summary(all).replace(". ", ".\n"));
    text.push_str(
        "| scene | target | budget | pick | error | cost | of the best | best, if another | seconds |\n",
    );
    text.push_str("|---|---|---|---|---|---|---|---|---|\n");
    for found in all {
        let &Found { scene, budget, machine, error, cost, ratio, seconds, .. } = found;
        let name = machine.name();
        let cost = if machine.is_chip() { format!("{:.2} M", cost / 1e6) } else { format!("{cost:.2} ms") };
        let excess = if budget.admits(error) { "" } else { ", beyond" };
        let (pick, best) = (short(&found.pick), short(&found.best));
        let best = if best == pick { String::new() } else { best };
        let _ = writeln!(
            text,
            "| {scene} | {name} | {budget} | {pick} | {error:.3}{excess} | {cost} | {ratio:.3} | {best} | {seconds:.1} |"
        );
    }
    text + JSON
}

const JSON: &str = "
## One line of JSON

`alberti advise --json` prints one object on one line:

| key | meaning |
|---|---|
| `max_error` | the budget |
| `target` | the machine: `host`, `m4f`, `m0` or `rv32` |
| `pick` | the cheapest way within the budget, a row as below |
| `rust` | the lines of a program that select it |
| `trials` | all ways that were tried, a row each, the cheapest first |
| `waste` | what the scene pays for nothing, a sentence each |

A row is an object with these keys:

| key | meaning |
|---|---|
| `options` | those of the command line that select it |
| `ms` | milliseconds of a frame; on the host only |
| `instructions` | of a frame, by the model; on chips only |
| `flash` | bytes of code; on chips only |
| `ram` | bytes of both buffers, a slot for each vertex, and on chips the stack |
| `time` | the frame's cost as a share of the most precise policies' |
| `error` | in the budget's unit; `null` if the picture is equal (PSNR) or something else is seen (texels) |
| `largest` | the largest difference of a byte of any pixel |
| `within` | whether the budget is kept |
| `front` | whether no other way is as cheap and as right |
";

/// The values of options without their names.
fn short(options: &str) -> String {
    options.split(' ').skip(1).step_by(2).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(machine: Machine, error: f64, ratio: f64) -> Found {
        Found {
            scene: "floor",
            budget: MaxError::Texel(0.5),
            machine,
            pick: "--interpolation plane --arithmetic float --depth u16 --subpixel 8".to_owned(),
            error,
            best: "--interpolation affine --arithmetic fixed --depth u16 --subpixel 4".to_owned(),
            cost: 2e6,
            ratio,
            seconds: 1.5,
        }
    }

    #[test]
    fn pages_say_what_is_wrong() {
        let all = [found(Machine::M4f, 0.25, 1.0), found(Machine::Host, 0.75, 1.25)];
        let text = page(&all);
        assert!(text.contains("1 of 2 picks are within the budget, 1 at most 1.10 times"), "{text}");
        assert!(text.contains("\nThe dearest is 1.250 times"), "{text}");
        let row = "| floor | m4f | 0.5texel | plane, float, u16, 8 | 0.250 | 2.00 M | 1.000 | affine, fixed, u16, 4 | 1.5 |";
        assert!(text.contains(row), "{text}");
        assert!(text.contains("0.750, beyond"), "{text}");
    }

    #[test]
    fn what_repeats_is_held_to_the_limits() {
        assert!(check(&[found(Machine::Host, 0.5, 1.5), found(Machine::M4f, 0.5, 1.1)]).is_ok());
        assert!(check(&[found(Machine::Host, 0.51, 1.0)]).unwrap_err().contains("an error of 0.51"));
        assert!(check(&[found(Machine::M4f, 0.5, 1.11)]).unwrap_err().contains("1.110 times"));
    }
}
