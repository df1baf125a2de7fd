//! Times of alberti's policies, by Criterion.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::results::{number, rows};
use crate::command::{self, cargo};

/// The table: medians of frames, and the interval in which they are with a confidence of 95 %.
pub(super) const PLACE: &str = "benches/results/frames.csv";
const HEADING: &str = "scene,size,renderer,nanoseconds,low,high";

/// A line of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) scene: String,
    pub(super) size: String,
    pub(super) renderer: String,
    /// Nanoseconds.
    pub(super) median: f64,
    pub(super) interval: [f64; 2],
}

/// Reads a table.
pub(super) fn read(text: &str) -> Result<Vec<Frame>, String> {
    let row = |(place, [scene, size, renderer, median, low, high]): (String, [&str; 6])| {
        let [scene, size, renderer] = [scene, size, renderer].map(str::to_owned);
        let interval = [number(&place, low)?, number(&place, high)?];
        Ok(Frame { scene, size, renderer, median: number(&place, median)?, interval })
    };
    rows(PLACE, HEADING, text)?.into_iter().map(row).collect()
}

/// Times all: the table.
pub(super) fn measure() -> Result<String, String> {
    let folder = super::folder("criterion")?;
    let mut bench = cargo();
    bench.args(["bench", "--package", "alberti-benches", "--bench", "frames", "--"]);
    bench.args(["--warm-up-time", "0.5", "--measurement-time", "1.5"]);
    command::run(bench.env("CRITERION_HOME", &folder))?;
    let mut lines = Vec::new();
    for scene in inner(&folder)? {
        for renderer in inner(&folder.join(&scene))? {
            for size in inner(&folder.join(&scene).join(&renderer))? {
                let path = folder.join(&scene).join(&renderer).join(&size).join("new/estimates.json");
                // Folders of reports have none.
                let Ok(text) = fs::read_to_string(&path) else { continue };
                let [median, low, high] =
                    estimated(&text).ok_or_else(|| format!("{}: another form", path.display()))?;
                lines.push(format!("{scene},{size},{renderer},{median:.0},{low:.0},{high:.0}\n"));
            }
        }
    }
    lines.sort();
    Ok(format!("{HEADING}\n{}", lines.concat()))
}

/// The names in a folder.
fn inner(folder: &Path) -> Result<Vec<String>, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let entries = fs::read_dir(folder).map_err(failed)?;
    let name = |entry: std::io::Result<fs::DirEntry>| {
        entry.map(|entry| entry.file_name().to_string_lossy().into_owned()).map_err(failed)
    };
    entries.map(name).collect()
}

/// The median of Criterion's estimates, and its interval.
fn estimated(text: &str) -> Option<[f64; 3]> {
    let estimates: Value = serde_json::from_str(text).ok()?;
    let median = &estimates["median"];
    let interval = &median["confidence_interval"];
    Some([
        median["point_estimate"].as_f64()?,
        interval["lower_bound"].as_f64()?,
        interval["upper_bound"].as_f64()?,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_have_their_intervals() {
        let text = r#"{"mean":{},"median":{"confidence_interval":{"confidence_level":0.95,"lower_bound":1.5,"upper_bound":3.0},"point_estimate":2.0}}"#;
        assert_eq!(estimated(text), Some([2.0, 1.5, 3.0]));
        assert_eq!(estimated("{}"), None);
        let read = read("# here\nscene,size,renderer,nanoseconds,low,high\nmesh,8x8,Exact,2,1,3\n").unwrap();
        assert!(read.len() == 1 && read[0].interval == [1.0, 3.0] && read[0].renderer == "Exact");
    }
}
