//! The program behind `cargo xtask extremes`.

use alberti_extremes::options::{HELP, Options, Work, parse};
use alberti_extremes::sweep::{Effort, Results, Sweep};
use alberti_extremes::{axes, page, parts};
use std::process::ExitCode;
use std::time::Instant;

/// Shards of a sweep in one process: enough that the last ones do not keep the others waiting.
const SHARDS: u64 = 64;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let options = match parse(&arguments, |name| std::env::var(name).ok()) {
        Ok(Some(options)) => options,
        Ok(None) => {
            print!("{HELP}");
            return ExitCode::SUCCESS;
        }
        Err(message) => return fail(&message, 2),
    };
    match run(&options) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => fail(&message, 2),
    }
}

fn fail(message: &str, status: u8) -> ExitCode {
    eprintln!("extremes: {message}");
    ExitCode::from(status)
}

/// Does the work, and tells whether all bounds hold.
fn run(options: &Options) -> Result<bool, String> {
    let sweep = Sweep { axes: axes::all(), seed: options.seed, effort: options.effort };
    let start = Instant::now();
    match &options.work {
        Work::All => {
            let results = here(&sweep, SHARDS);
            println!("{} rows in {:.1} s", results.len(), start.elapsed().as_secs_f64());
            if sweep.effort == Effort::SMALL && [1, 4].iter().any(|&shards| here(&sweep, shards) != results) {
                return Err(format!("1, 4 and {SHARDS} shards do not give the same results"));
            }
            finish(&sweep, &results, options)
        }
        Work::Part(shard) => {
            let (path, written) = parts::write(&sweep, *shard, &options.out)?;
            let done = if written { "wrote" } else { "there already, and skipped:" };
            println!("shard {shard}: {done} {} ({:.1} s)", path.display(), start.elapsed().as_secs_f64());
            Ok(true)
        }
        Work::Merge(folder, compare) => {
            let anew = |seed, effort| Sweep { axes: axes::all(), seed, effort };
            let (sweep, results) = parts::merged(folder, anew)?;
            if *compare {
                if here(&sweep, SHARDS) != results {
                    return Err(format!(
                        "the parts in {} are not what one process measures",
                        folder.display()
                    ));
                }
                println!("The parts are what one process measures.");
            }
            finish(&sweep, &results, options)
        }
        Work::Replay(row, place) => {
            let found = sweep.replay(row, *place);
            let text = found.ok_or(format!(
                "no sample {}:{} of `{row}`; expected a row and a sample of docs/extremes.csv, and its --seed",
                place.block, place.index
            ))?;
            println!("{text}");
            Ok(true)
        }
    }
}

fn here(sweep: &Sweep, shards: u64) -> Results {
    sweep.all(shards, std::thread::available_parallelism().map_or(1, usize::from))
}

/// Tells of violated bounds, and writes the page of a full sweep.
fn finish(sweep: &Sweep, results: &Results, options: &Options) -> Result<bool, String> {
    let samples: u64 = results.iter().map(|row| row.samples).sum();
    let violations = sweep.violations(results);
    for (row, measured) in &violations {
        let worst = measured.share;
        eprintln!(
            "extremes: {}: an error of {:.6e} {}, where {:.6e} is the bound: {:.3} of it (replay '{}' {}:{} --seed {:#x})",
            row.name(),
            worst.error,
            row.axis.unit,
            worst.bound,
            worst.figure,
            row.name(),
            worst.place.block,
            worst.place.index,
            sweep.seed,
        );
    }
    if sweep.effort == Effort::FULL {
        page::write(sweep, results, &options.docs)?;
        println!("Wrote {}.", options.docs.join(page::PAGE).display());
    }
    let verdict = if violations.is_empty() { "every bound holds" } else { "bounds are violated, see above" };
    println!("{} rows, {samples} samples: {verdict}.", results.len());
    Ok(violations.is_empty())
}
