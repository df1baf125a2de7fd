//! Names of a film's frames, such as `frames/%04d.png`, and shares of a film.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::error::Error;

/// The most digits of a number.
const DIGITS: usize = 9;

/// A name with a number in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Names {
    before: String,
    digits: usize,
    after: String,
}

impl Names {
    /// The names that a path stands for whose file has `%d` or `%04d` in its name, the last of which counts; none if it
    /// has neither.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let text = path.to_str()?;
        let folder = text.len() - path.file_name()?.len();
        let at = |(start, _): (usize, &str)| {
            let (digits, after) = text[start + 1..].split_once('d')?;
            let is_number = digits.is_empty() || digits.starts_with('0');
            let digits = if digits.is_empty() { 1 } else { digits.parse().ok()? };
            let names = Self { before: text[..start].to_owned(), digits, after: after.to_owned() };
            (start >= folder && is_number && (1..=DIGITS).contains(&digits)).then_some(names)
        };
        text.rmatch_indices('%').find_map(at)
    }

    /// The name of a frame.
    pub(crate) fn name(&self, frame: u32) -> PathBuf {
        let Self { before, digits, after } = self;
        format!("{before}{frame:0digits$}{after}").into()
    }
}

/// One of so many shares of a film, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u32,
    count: u32,
}

impl Shard {
    /// All of a film.
    pub(crate) const ALL: Self = Self { index: 0, count: 1 };

    /// Its frames of so many: shares differ by one at most.
    pub(crate) fn frames(self, frames: u32) -> std::ops::Range<u32> {
        let end = |index: u32| u64::from(frames) * u64::from(index) / u64::from(self.count);
        let [start, end] = [self.index, self.index + 1].map(|k| u32::try_from(end(k)).unwrap_or(frames));
        start..end
    }

    /// Whether it is less than all.
    pub(crate) fn is_part(self) -> bool {
        self.count > 1
    }

    /// The share that Slurm gives this process, by its variables: tasks of an array may have any numbers in even steps.
    ///
    /// # Errors
    /// The variables are no numbers, or out of range.
    pub(crate) fn of_job(variable: &dyn Fn(&str) -> Option<String>) -> Result<Option<Self>, Error> {
        let number = |name: &str| {
            let Some(text) = variable(name) else { return Ok(None) };
            let number = text.trim().parse::<u32>().map(Some);
            number.map_err(|_| Error::new(format!("\"{text}\""), "a whole number").place(name))
        };
        let Some(id) = number("SLURM_ARRAY_TASK_ID")? else { return Ok(None) };
        let first = number("SLURM_ARRAY_TASK_MIN")?.unwrap_or(0);
        let Some(count) = number("SLURM_ARRAY_TASK_COUNT")? else { return Ok(None) };
        let step = number("SLURM_ARRAY_TASK_STEP")?.unwrap_or(1).max(1);
        let last = number("SLURM_ARRAY_TASK_MAX")?
            .unwrap_or_else(|| first.saturating_add((count.max(1) - 1) * step));
        let place =
            |task: u32| task.checked_sub(first).filter(|past| past % step == 0).map(|past| past / step);
        let index = place(id).filter(|&index| index < count && place(last) == Some(count - 1));
        let gaps = || {
            let error =
                Error::new(format!("task {id} of an array of {count} with gaps"), "tasks in even steps");
            error.place("SLURM_ARRAY_TASK_ID").hint("say the share by --shard K/N")
        };
        index.map(|index| Some(Self { index, count })).ok_or_else(gaps)
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

/// K/N, from 0/N on, or /N for the index that Kubernetes gives a job's process.
impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "K/N with K from 0 to N - 1, or /N where JOB_COMPLETION_INDEX says K".to_owned();
        let (index, count) = text.split_once('/').ok_or_else(expected)?;
        let index = if index.is_empty() {
            std::env::var("JOB_COMPLETION_INDEX").map_err(|_| expected())?
        } else {
            index.to_owned()
        };
        let (index, count) = (index.trim().parse().ok(), count.parse().ok());
        let shard = index.zip(count).map(|(index, count)| Self { index, count });
        shard.filter(|shard| shard.index < shard.count).ok_or_else(expected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_digits() {
        let name = |path: &str, frame| Names::of(Path::new(path)).map(|names| names.name(frame));
        assert_eq!(name("f/%04d.png", 7), Some("f/0007.png".into()));
        assert_eq!(name("%d.png", 12), Some("12.png".into()));
        assert_eq!(name("a%02d", 123), Some("a123".into()));
        assert_eq!(name("50%/5%done/%b%02d.%d.x", 3), Some("50%/5%done/%b%02d.3.x".into()));
        for other in ["%02d/x.png", "a.png", "%4d.png", "%00d.png", "%x.png", "%099d.png", "100%", "%-1d"] {
            assert_eq!(name(other, 0), None, "{other}");
        }
    }

    #[test]
    fn shards_are_all_frames_once() {
        for (frames, count) in [(60, 4), (7, 3), (2, 5), (0, 2), (u32::MAX, 7)] {
            let ranges: Vec<_> = (0..count).map(|index| Shard { index, count }.frames(frames)).collect();
            assert_eq!((ranges[0].start, ranges[ranges.len() - 1].end), (0, frames));
            assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start));
            let lengths = || ranges.iter().map(|range| range.end - range.start);
            assert!(lengths().max().unwrap() - lengths().min().unwrap() <= 1);
        }
        assert_eq!(Shard::ALL.frames(9), 0..9);
        assert_eq!("2/4".parse(), Ok(Shard { index: 2, count: 4 }));
        for bad in ["", "4", "4/4", "-1/4", "1/0", "a/b", "1/2/3"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }

    #[test]
    fn tasks_of_arrays_are_shards() {
        let of = |variables: &[(&str, &str)]| {
            let variable = |name: &str| {
                variables.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned())
            };
            Shard::of_job(&variable).map_err(|error| error.to_string())
        };
        assert_eq!(of(&[]), Ok(None));
        let third = Ok(Some(Shard { index: 2, count: 4 }));
        assert_eq!(of(&[("SLURM_ARRAY_TASK_ID", "2"), ("SLURM_ARRAY_TASK_COUNT", "4")]), third);
        let from_one = [
            ("SLURM_ARRAY_TASK_ID", "11"),
            ("SLURM_ARRAY_TASK_COUNT", "4"),
            ("SLURM_ARRAY_TASK_MIN", "1"),
            ("SLURM_ARRAY_TASK_STEP", "5"),
        ];
        assert_eq!(of(&from_one), third);
        let gaps = [
            ("SLURM_ARRAY_TASK_ID", "7"),
            ("SLURM_ARRAY_TASK_COUNT", "2"),
            ("SLURM_ARRAY_TASK_MIN", "3"),
            ("SLURM_ARRAY_TASK_MAX", "7"),
        ];
        assert!(of(&gaps).is_err_and(|told| told.contains("--shard K/N")));
        let first_of_gaps = [("SLURM_ARRAY_TASK_ID", "3"), gaps[1], gaps[2], gaps[3]];
        assert!(of(&first_of_gaps).is_err());
        assert!(of(&[("SLURM_ARRAY_TASK_ID", "4"), ("SLURM_ARRAY_TASK_COUNT", "4")]).is_err());
        assert!(of(&[("SLURM_ARRAY_TASK_ID", "x"), ("SLURM_ARRAY_TASK_COUNT", "4")]).is_err());
    }
}
