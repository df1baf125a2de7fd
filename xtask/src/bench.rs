//! Numbers that are tracked: instructions with a gate, times of policies, ratios to peers. They are tables in
//! `benches/results`, a page with plots, and one file of metrics.

mod bars;
mod chips;
mod counts;
mod frames;
mod metrics;
mod page;
pub(crate) mod ratios;
mod results;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::command::{Outcome, output};
use crate::{peers, workspace};

/// The option for instructions alone, compared with those that are committed.
const CHECK: &str = "--check";
/// The word for these alone, written.
const COUNTS: &str = "counts";

/// Measures all and writes it, or instructions alone, or compares these.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    match arguments {
        [flag] if flag == CHECK => check(),
        [word] if word == COUNTS => {
            results::write(counts::PLACE, &counts::measure()?)?;
            write_page()
        }
        [first, ..] if first == CHECK || first == COUNTS => {
            Err(format!("expected nothing after `{first}`, found `{}`", arguments[1]))
        }
        others => all(others),
    }
}

fn all(arguments: &[String]) -> Outcome {
    let options = peers::Options::parse(arguments)
        .map_err(|error| format!("{error}; or `{COUNTS}` or `{CHECK}` alone"))?;
    results::write(counts::PLACE, &counts::measure()?)?;
    let machine = machine()?;
    results::write(ratios::PLACE, &format!("{machine}{}", peers::measure(&options)?))?;
    results::write(frames::PLACE, &format!("{machine}{}", frames::measure()?))?;
    write_page()?;
    let path = workspace::target_directory().join("bench/metrics.json");
    fs::write(&path, metrics::json()?)
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("Wrote {}, in the Bencher Metric Format.", path.display());
    Ok(())
}

/// Compares instructions with those that are committed, and the page with what its tables make.
pub(crate) fn check() -> Outcome {
    counts::compare(&results::read(counts::PLACE)?, &counts::measure()?)?;
    for (place, text) in page::files()? {
        if results::read(place)? != text {
            return Err(format!(
                "{place} is not what its tables make: `cargo xtask bench {COUNTS}` writes it"
            ));
        }
    }
    println!("Instructions are those of {}, and {} is that of its tables.", counts::PLACE, page::PAGE);
    Ok(())
}

fn write_page() -> Outcome {
    for (place, text) in page::files()? {
        results::write(place, &text)?;
        println!("Wrote {place}.");
    }
    Ok(())
}

/// A line about the machine, its compiler, and the day.
fn machine() -> Result<String, String> {
    let model = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = model.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let model = model.map_or(std::env::consts::ARCH, |(_, model)| model.trim());
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let compiler = output(Command::new("rustc").current_dir(workspace::root()).arg("-V"))?;
    let compiler = compiler.split(' ').nth(1).unwrap_or("?").to_owned();
    let day = output(Command::new("date").args(["-u", "+%Y-%m-%d"]))?;
    Ok(format!("# {model}, {threads} threads, Rust {compiler}, {}\n", day.trim()))
}

/// A folder of its own for what a run leaves.
fn folder(name: &str) -> Result<PathBuf, String> {
    let folder = workspace::target_directory().join("bench").join(name);
    // There may be none.
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    Ok(folder)
}
