//! Parts: the results of one shard in a file, written at once or not at all, and put together again.

use crate::measured::{Measured, Place, Worst};
use crate::shard::Shard;
use crate::sweep::{Effort, Results, Sweep, merge};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The first line of a part: all that parts of one sweep have in common, and which one it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Head {
    /// The seed.
    pub seed: u64,
    /// The effort.
    pub effort: Effort,
    /// The list of rows, see [`Sweep::fingerprint`].
    pub rows: u64,
    /// The shard.
    pub shard: Shard,
}

impl Head {
    /// The head of a shard's part.
    #[must_use]
    pub fn new(sweep: &Sweep, shard: Shard) -> Self {
        Self { seed: sweep.seed, effort: sweep.effort, rows: sweep.fingerprint(), shard }
    }

    /// The name of the file.
    #[must_use]
    pub fn file(&self) -> String {
        format!("part-{}-of-{}.txt", self.shard.number, self.shard.of)
    }

    fn line(&self) -> String {
        let Self { seed, effort, rows, shard } = self;
        format!("extremes seed {seed:#x} effort {} rows {rows:#x} shard {shard}", effort.name)
    }

    fn parse(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split(' ').collect();
        let ["extremes", "seed", seed, "effort", effort, "rows", rows, "shard", shard] = words[..] else {
            return None;
        };
        let number = |text: &str| u64::from_str_radix(text.strip_prefix("0x")?, 16).ok();
        Some(Self {
            seed: number(seed)?,
            effort: Effort::named(effort)?,
            rows: number(rows)?,
            shard: Shard::parse(shard).ok()?,
        })
    }
}

/// Writes the part of a shard into a folder, unless it is there already, and tells whether it has.
///
/// # Errors
/// A part of this name from another sweep, and what the file system says.
pub fn write(sweep: &Sweep, shard: Shard, folder: &Path) -> Result<(PathBuf, bool), String> {
    let head = Head::new(sweep, shard);
    let path = folder.join(head.file());
    match read(&path) {
        Ok((found, _)) if found == head => return Ok((path, false)),
        Ok((found, _)) => {
            return Err(format!(
                "{} has `{}`; expected `{}`: name another folder by --out, or delete this one",
                path.display(),
                found.line(),
                head.line()
            ));
        }
        // Not there, or not whole.
        Err(_) => {}
    }
    fs::create_dir_all(folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let text = text(&head, &sweep.shard(shard));
    // Under a name of this process, so that two that measure the same part do not write into each other's.
    let unfinished = folder.join(format!("{}.{}.tmp", head.file(), std::process::id()));
    fs::write(&unfinished, text)
        .and_then(|()| fs::rename(&unfinished, &path))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok((path, true))
}

/// The results of a folder's parts, whose sweep must be this one but for seed and effort, which are theirs.
///
/// # Errors
/// Parts that are missing, broken, or of more than one sweep.
pub fn merged(folder: &Path, sweep: impl Fn(u64, Effort) -> Sweep) -> Result<(Sweep, Results), String> {
    let place = folder.display();
    let entries = fs::read_dir(folder).map_err(|error| format!("cannot read {place}: {error}"))?;
    let mut parts = BTreeMap::new();
    for entry in entries {
        let path = entry.map_err(|error| format!("cannot read {place}: {error}"))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with("part-") && name.ends_with(".txt") {
            let (head, results) = read(&path)?;
            parts.insert((head.shard.number, name), (head, results));
        }
    }
    let Some(((_, name), (first, _))) = parts.first_key_value() else {
        return Err(format!(
            "no part in {place}; expected files like part-1-of-4.txt, as `--shard 1/4` writes"
        ));
    };
    let of = first.shard.of;
    let common = |head: &Head| Head { shard: Shard { number: 1, of: head.shard.of }, ..*head };
    for ((_, other), (head, _)) in &parts {
        if common(head) != common(first) {
            return Err(format!(
                "{place} has parts of different sweeps: {name} is `{}`, {other} is `{}`; delete those of one",
                first.line(),
                head.line()
            ));
        }
    }
    let there: Vec<u64> = parts.keys().map(|(number, _)| *number).collect();
    let missing: Vec<String> =
        (1..=of).filter(|number| !there.contains(number)).map(|number| number.to_string()).collect();
    if !missing.is_empty() {
        let list = missing.join(", ");
        return Err(format!(
            "{place} has {} of {of} parts; missing: {list}; run `--shard K/{of}` of these",
            there.len()
        ));
    }
    let sweep = sweep(first.seed, first.effort);
    if sweep.fingerprint() != first.rows {
        return Err(format!("{place} is from another version of the list of rows; measure it anew"));
    }
    let all = parts.values().fold(sweep.nothing(), |all, (_, part)| merge(all, part));
    Ok((sweep, all))
}

fn text(head: &Head, results: &Results) -> String {
    let mut text = head.line() + "\n";
    let worst =
        |w: &Worst| format!("{:e} {:e} {:e} {} {}", w.figure, w.error, w.bound, w.place.block, w.place.index);
    for row in results {
        text += &format!("{} {} {} {}\n", row.samples, row.refused, worst(&row.share), worst(&row.error));
    }
    text + &format!("end {}\n", results.len())
}

/// A whole part.
fn read(path: &Path) -> Result<(Head, Results), String> {
    let place = path.display();
    let text = fs::read_to_string(path).map_err(|error| format!("cannot read {place}: {error}"))?;
    let broken = |line: usize, expected: &str| {
        format!("{place}:{line}: not {expected}; delete the file and run its shard again")
    };
    let mut lines = text.lines();
    let head = lines.next().and_then(Head::parse).ok_or_else(|| broken(1, "the head of a part"))?;
    let mut results = Vec::new();
    for (line, row) in (2..).zip(lines.by_ref()) {
        if row == format!("end {}", results.len()) {
            return Ok((head, results));
        }
        results.push(measured(row).ok_or_else(|| broken(line, "a row"))?);
    }
    Err(broken(results.len() + 2, "whole: its last line is missing"))
}

fn measured(line: &str) -> Option<Measured> {
    let words: Vec<&str> = line.split(' ').collect();
    let [samples, refused, rest @ ..] = &words[..] else { return None };
    let worst = |words: &[&str]| {
        let [figure, error, bound, block, index] = words else { return None };
        let number = |text: &str| text.parse::<f64>().ok();
        let place = Place { block: block.parse().ok()?, index: index.parse().ok()? };
        Some(Worst { figure: number(figure)?, error: number(error)?, bound: number(bound)?, place })
    };
    Some(Measured {
        samples: samples.parse().ok()?,
        refused: refused.parse().ok()?,
        share: worst(rest.get(..5)?)?,
        error: worst(rest.get(5..)?)?,
    })
}

#[cfg(test)]
mod tests;
