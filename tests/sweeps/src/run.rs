//! Running a sweep: blocks side by side, in order, kept in a file so that it can go on.

use crate::{Found, SWEEPS, Sweep};
use std::io::{IsTerminal as _, Write as _};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{fs, thread};

/// The wishes of the caller.
#[derive(Clone, Debug)]
pub struct Wish {
    sweep: Sweep,
    /// One of so many machines, from 1.
    shard: [u64; 2],
    seed: u64,
    /// The longest that it may take.
    time: Option<Duration>,
    folder: PathBuf,
}

impl Wish {
    /// # Errors
    /// Words that are none of these.
    pub fn read(words: &[String]) -> Result<Self, String> {
        let names = || SWEEPS.iter().map(|sweep| sweep.name).collect::<Vec<_>>().join(", ");
        let mut words = words.iter().map(String::as_str);
        let name = words.next().unwrap_or_default();
        let sweep = SWEEPS.iter().find(|sweep| sweep.name == name).copied();
        let sweep = sweep.ok_or_else(|| format!("expected one of {}, found `{name}`", names()))?;
        let mut wish = Self { sweep, shard: [1, 1], seed: 1, time: None, folder: PathBuf::from(".") };
        while let Some(word) = words.next() {
            let value = words.next().unwrap_or_default();
            let wrong = |expected: &str| format!("expected {expected} after `{word}`, found `{value}`");
            match word {
                "--shard" => {
                    let pair =
                        value.split_once('/').and_then(|(k, n)| Some([k.parse().ok()?, n.parse().ok()?]));
                    let within =
                        pair.filter(|&[k, n]: &[u64; 2]| (1..=n).contains(&k) && n <= wish.sweep.blocks);
                    wish.shard = within.ok_or_else(|| wrong("K/N, such as 2/8"))?;
                }
                "--seed" => wish.seed = value.parse().map_err(|_| wrong("a whole number"))?,
                "--time" => {
                    let seconds = value.parse().map_err(|_| wrong("seconds"))?;
                    wish.time = Some(Duration::from_secs(seconds));
                }
                "--folder" => wish.folder = value.into(),
                _ => return Err(format!("expected --shard, --seed or --time, found `{word}`")),
            }
        }
        Ok(wish)
    }

    /// The file of what is done.
    fn file(&self) -> PathBuf {
        let [k, n] = self.shard;
        self.folder.join(format!("{}-{k}-of-{n}-seed-{}.txt", self.sweep.name, self.seed))
    }

    /// The blocks of the shard, from the first.
    fn blocks(&self) -> impl Iterator<Item = u64> {
        let [k, n] = self.shard;
        std::iter::successors(Some(k - 1), move |block| Some(block + n))
            .take_while(|block| *block < self.sweep.blocks)
    }
}

/// Runs a sweep up to its end, or to the end of its time.
///
/// # Errors
/// A case that breaks a promise, or a file that cannot be written.
pub fn run(wish: &Wish) -> Result<(), String> {
    let file = wish.file();
    let (mut done, mut found) = read(&file)?;
    let all = wish.blocks().count() as u64;
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    println!("{}: {}", wish.sweep.name, wish.sweep.about);
    if done > 0 {
        println!("goes on after {done} of {all} blocks ({})", file.display());
    }
    let start = Instant::now();
    let blocks: Vec<u64> = wish.blocks().skip(usize::try_from(done).unwrap_or(usize::MAX)).collect();
    for together in blocks.chunks(threads) {
        if wish.time.is_some_and(|time| start.elapsed() >= time) {
            break;
        }
        let outcomes = thread::scope(|scope| {
            let work = |&block: &u64| scope.spawn(move || (wish.sweep.block)(block, wish.seed));
            let started: Vec<_> = together.iter().map(work).collect();
            let joined =
                started.into_iter().map(|one| one.join().unwrap_or_else(|_| Err("it panicked".into())));
            joined.collect::<Vec<_>>()
        });
        for (block, outcome) in together.iter().zip(outcomes) {
            found = found.and(outcome.map_err(|message| format!("block {block}: {message}"))?);
            done += 1;
        }
        write(&file, done, found)?;
        progress(done, all, start);
    }
    let Found { cases, worst } = found;
    let whole = if done == all { String::new() } else { format!(", {done} of {all} blocks") };
    let worst = if wish.sweep.unit.is_empty() {
        String::new()
    } else {
        format!(", worst {worst:.3} {}", wish.sweep.unit)
    };
    println!("\r{}: {cases} cases{worst}{whole}; {} s this time", wish.sweep.name, start.elapsed().as_secs());
    Ok(())
}

/// Blocks, cases and the greatest error.
fn read(file: &Path) -> Result<(u64, Found), String> {
    let Ok(text) = fs::read_to_string(file) else { return Ok((0, Found::default())) };
    let words: Vec<&str> = text.split_whitespace().collect();
    let numbers = match words[..] {
        [done, cases, worst] => done.parse().ok().zip(cases.parse().ok()).zip(worst.parse().ok()),
        _ => None,
    };
    let ((done, cases), worst) = numbers
        .ok_or_else(|| format!("{}: expected blocks, cases and the greatest error", file.display()))?;
    Ok((done, Found { cases, worst }))
}

/// Whole or not at all.
fn write(file: &Path, done: u64, Found { cases, worst }: Found) -> Result<(), String> {
    let new = file.with_extension("new");
    let written =
        fs::write(&new, format!("{done} {cases} {worst:?}\n")).and_then(|()| fs::rename(&new, file));
    written.map_err(|error| format!("{}: {error}", file.display()))
}

#[expect(clippy::cast_precision_loss, reason = "for people")]
fn progress(done: u64, all: u64, start: Instant) {
    let mut out = std::io::stdout().lock();
    if out.is_terminal() {
        let share = 100.0 * done as f64 / all as f64;
        let _ = write!(out, "\r{done} of {all} blocks, {share:.2} %, {} s ", start.elapsed().as_secs());
        let _ = out.flush();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wish(words: &str) -> Result<Wish, String> {
        Wish::read(&words.split(' ').map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn shards_are_the_whole() {
        let all: u64 = wish("clip").unwrap().blocks().count() as u64;
        let parts: Vec<u64> = (1..=3)
            .flat_map(|k| wish(&format!("clip --shard {k}/3 --seed 5")).unwrap().blocks().collect::<Vec<_>>())
            .collect();
        assert_eq!(parts.len() as u64, all);
        assert!((0..all).all(|block| parts.contains(&block)));
        for wrong in ["clop", "clip --shard 0/3", "clip --shard 4/3", "clip --seed x", "clip --fast 1"] {
            assert!(wish(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn what_is_done_is_kept() {
        let folder = std::env::temp_dir().join(format!("sweeps-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let file = folder.join("a.txt");
        let found = Found { cases: 12, worst: 0.5 };
        assert_eq!(read(&file), Ok((0, Found::default())));
        write(&file, 3, found).unwrap();
        assert_eq!(read(&file), Ok((3, found)));
        fs::write(&file, "three").unwrap();
        assert!(read(&file).is_err());
        fs::remove_dir_all(&folder).unwrap();
    }

    /// Each sweep looks at something.
    #[test]
    fn first_blocks_hold() {
        for sweep in SWEEPS.iter().filter(|sweep| ["clip", "tangents"].contains(&sweep.name)) {
            let found = (sweep.block)(0, 7).unwrap();
            assert!(found.cases > 1000, "{}: {found:?}", sweep.name);
        }
    }
}
