//! The command line.

use crate::measured::Place;
use crate::shard::Shard;
use crate::sweep::Effort;
use alberti_oracle::rng::FIXED_SEED;
use std::path::PathBuf;

/// The work that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Work {
    /// All shards, here.
    All,
    /// One shard, to a part.
    Part(Shard),
    /// The parts of a folder, put together; and compared with all shards, here.
    Merge(PathBuf, bool),
    /// One sample of a row, in words.
    Replay(String, Place),
}

/// The work and its circumstances.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The work.
    pub work: Work,
    /// The seed.
    pub seed: u64,
    /// The effort.
    pub effort: Effort,
    /// The folder of parts.
    pub out: PathBuf,
    /// The folder of the page.
    pub docs: PathBuf,
}

/// The help.
pub const HELP: &str = "\
Measures every policy at the ends of its parameters, and holds it to its bounds.

usage: cargo xtask extremes [--small] [--seed S]                       all, here; writes docs/extremes.md
       cargo xtask extremes [--small] [--seed S] --shard K/N [--out D] one shard of N, to a part in D
       cargo xtask extremes merge D [--compare]                        the parts in D, put together
       cargo xtask extremes replay ROW BLOCK:INDEX [--seed S]          one sample, in words
       cargo xtask extremes --check                                    --small in four shards, by GNU parallel

  --small     the size for a check: seconds; writes no page, but compares one shard with four
  --shard     K counts from 1; without it, that of a Slurm array (SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _STEP) or of a
              Kubernetes Indexed Job (JOB_COMPLETION_INDEX, and JOB_COMPLETIONS, which you set)
  --seed      a number, or one in hexadecimal after 0x
  --out       the folder of parts: target/extremes
  --compare   the same rows measured by one process must give the same results
  --docs      the folder of the page and of pictures/: docs
A row and its sample are named as in docs/extremes.csv.
";

/// The options of a command line; `None` where it asks for help. `variable` is the environment.
///
/// # Errors
/// What is not understood.
pub fn parse(
    arguments: &[String],
    variable: impl Fn(&str) -> Option<String>,
) -> Result<Option<Options>, String> {
    let (mut shard, mut small, mut compare, mut named) = (None, false, false, Vec::new());
    let (mut seed, mut out, mut docs) = (FIXED_SEED, PathBuf::from("target/extremes"), PathBuf::from("docs"));
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let mut value =
            |of: &str| rest.next().cloned().ok_or(format!("{argument} without a value; expected {of}"));
        match argument.as_str() {
            "--help" | "-h" => return Ok(None),
            "--small" => small = true,
            "--compare" => compare = true,
            "--shard" => shard = Some(Shard::parse(&value("K/N")?)?),
            "--seed" => seed = seed_of(&value("a number")?)?,
            "--out" => out = value("a folder")?.into(),
            "--docs" => docs = value("a folder")?.into(),
            option if option.starts_with('-') => {
                return Err(format!("the option `{option}` is not known; `--help` lists all"));
            }
            word => named.push(word.to_string()),
        }
    }
    let words: Vec<&str> = named.iter().map(String::as_str).collect();
    let work = match words[..] {
        [] => match shard {
            Some(shard) => Work::Part(shard),
            None => Shard::of_scheduler(variable)?.map_or(Work::All, Work::Part),
        },
        ["merge", folder] => Work::Merge(folder.into(), compare),
        ["merge"] => return Err("`merge` without a folder; expected `merge DIR`".into()),
        ["replay", row, place] => Work::Replay(row.into(), place_of(place)?),
        _ => {
            return Err(format!(
                "found `{}`; expected nothing, `merge DIR` or `replay ROW BLOCK:INDEX`",
                words.join(" ")
            ));
        }
    };
    if compare && !matches!(work, Work::Merge(..)) {
        return Err("--compare goes with `merge DIR`".into());
    }
    let effort = if small { Effort::SMALL } else { Effort::FULL };
    Ok(Some(Options { work, seed, effort, out, docs }))
}

fn seed_of(text: &str) -> Result<u64, String> {
    let number = match text.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16),
        None => text.parse(),
    };
    number.map_err(|_| format!("a seed of `{text}`; expected a number such as 42 or 0x2a"))
}

fn place_of(text: &str) -> Result<Place, String> {
    let place = text
        .split_once(':')
        .and_then(|(block, index)| Some(Place { block: block.parse().ok()?, index: index.parse().ok()? }));
    place.ok_or(format!("a sample of `{text}`; expected BLOCK:INDEX, as in 2:1047"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str, variables: &[(&str, &str)]) -> Result<Options, String> {
        let arguments: Vec<String> = line.split_whitespace().map(str::to_string).collect();
        let find = |name: &str| variables.iter().find(|(key, _)| *key == name).map(|(_, v)| v.to_string());
        parse(&arguments, find).map(|options| options.expect("no help"))
    }

    #[test]
    fn a_scheduler_counts_where_no_shard_is_named() {
        const JOB: [(&str, &str); 2] = [("JOB_COMPLETION_INDEX", "2"), ("JOB_COMPLETIONS", "8")];
        let work = |line: &str, job: &[(&str, &str)]| parsed(line, job).map(|options| options.work);
        assert_eq!(work("", &[]), Ok(Work::All));
        assert_eq!(work("", &JOB), Ok(Work::Part(Shard { number: 3, of: 8 })));
        assert_eq!(work("--shard 1/2", &JOB), Ok(Work::Part(Shard { number: 1, of: 2 })));
        assert_eq!(work("merge d --compare", &JOB), Ok(Work::Merge("d".into(), true)));
        let place = Place { block: 2, index: 17 };
        assert_eq!(work("replay a/b/1 2:17", &[]), Ok(Work::Replay("a/b/1".into(), place)));
    }

    #[test]
    fn seeds_and_folders_are_taken() {
        let options = parsed("--small --seed 0x2a --out a --docs b", &[]).expect("options");
        assert_eq!((options.seed, options.effort), (42, Effort::SMALL));
        assert_eq!((options.out, options.docs), ("a".into(), "b".into()));
    }

    #[test]
    fn errors_name_what_was_found() {
        for (line, part) in [
            ("--shard", "--shard without a value"),
            ("--shard 5/4", "`5/4`"),
            ("--seed x", "`x`"),
            ("--fast", "`--fast`"),
            ("merge", "`merge DIR`"),
            ("merge a b", "`merge a b`"),
            ("replay a 3", "`3`"),
            ("--compare", "`merge DIR`"),
        ] {
            let message = parsed(line, &[]).expect_err(line);
            assert!(message.contains(part), "{line}: {message}");
        }
    }
}
