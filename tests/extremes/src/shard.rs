//! Shards: the part K of N of a sweep, from the command line or from what a scheduler sets.

use std::fmt;

/// Part `number` of `of`, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// K.
    pub number: u64,
    /// N.
    pub of: u64,
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// The shard of a text like `3/8`.
    ///
    /// # Errors
    /// Anything but 1 <= K <= N.
    pub fn parse(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        let Some((number, of)) = parts else {
            return Err(format!("a shard of `{text}`; expected K/N, as in `--shard 3/8`"));
        };
        Self::checked(number, of)
            .ok_or_else(|| format!("a shard of `{text}`; expected 1 <= K <= N: shards count from 1"))
    }

    fn checked(number: u64, of: u64) -> Option<Self> {
        (1 <= number && number <= of).then_some(Self { number, of })
    }

    /// The shard that a scheduler asks for by its variables, if one does: a Slurm array, whatever number it begins at
    /// and in whatever steps, or else a Kubernetes Indexed Job, whose manifest must set `JOB_COMPLETIONS` too.
    ///
    /// # Errors
    /// A variable that is missing beside another, or is no number, or does not fit the others.
    pub fn of_scheduler(variable: impl Fn(&str) -> Option<String>) -> Result<Option<Self>, String> {
        let number = |name: &str| match variable(name) {
            None => Ok(None),
            Some(text) => match text.trim().parse::<u64>() {
                Ok(number) => Ok(Some(number)),
                Err(_) => Err(format!("{name} is `{text}`; expected a number, or `--shard K/N` instead")),
            },
        };
        let needed = |name: &str, beside: &str| {
            number(name)?.ok_or(format!("{beside} is set and {name} is not; set it, or give `--shard K/N`"))
        };
        let wrong = |what: String| format!("{what} do not fit together; give `--shard K/N` instead");
        if let Some(id) = number("SLURM_ARRAY_TASK_ID")? {
            let count = needed("SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_ID")?;
            let least = needed("SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_ID")?;
            let step = number("SLURM_ARRAY_TASK_STEP")?.unwrap_or(1).max(1);
            let index = id.checked_sub(least).filter(|index| index.is_multiple_of(step));
            let shard = index.and_then(|index| Self::checked(index / step + 1, count));
            return shard.map(Some).ok_or_else(|| {
                wrong(format!(
                    "SLURM_ARRAY_TASK_ID {id}, _COUNT {count}, _MIN {least} and _STEP {step} (an array with gaps?)"
                ))
            });
        }
        if let Some(index) = number("JOB_COMPLETION_INDEX")? {
            let count = needed("JOB_COMPLETIONS", "JOB_COMPLETION_INDEX")?;
            let shard = index.checked_add(1).and_then(|number| Self::checked(number, count));
            return shard.map(Some).ok_or_else(|| {
                wrong(format!(
                    "JOB_COMPLETION_INDEX {index}, which counts from 0, and JOB_COMPLETIONS {count}"
                ))
            });
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scheduler(variables: &[(&str, &str)]) -> Result<Option<Shard>, String> {
        let find = |name: &str| variables.iter().find(|(key, _)| *key == name).map(|(_, v)| v.to_string());
        Shard::of_scheduler(find)
    }

    fn shard(number: u64, of: u64) -> Result<Option<Shard>, String> {
        Ok(Some(Shard { number, of }))
    }

    #[test]
    fn a_shard_is_one_of_so_many() {
        assert_eq!(Shard::parse("3/8"), Ok(Shard { number: 3, of: 8 }));
        for text in ["0/8", "9/8", "3", "3/", "a/b", "-1/8", "1/0", ""] {
            let message = Shard::parse(text).unwrap_err();
            assert!(message.contains(&format!("`{text}`")) && message.contains("K"), "{message}");
        }
    }

    #[test]
    fn slurm_arrays_begin_anywhere() {
        const ID: &str = "SLURM_ARRAY_TASK_ID";
        const COUNT: (&str, &str) = ("SLURM_ARRAY_TASK_COUNT", "4");
        let min = |least| ("SLURM_ARRAY_TASK_MIN", least);
        assert_eq!(scheduler(&[(ID, "0"), COUNT, min("0")]), shard(1, 4));
        assert_eq!(scheduler(&[(ID, "3"), COUNT, min("0")]), shard(4, 4));
        assert_eq!(scheduler(&[(ID, "1"), COUNT, min("1")]), shard(1, 4));
        assert_eq!(scheduler(&[(ID, "4"), COUNT, min("1")]), shard(4, 4));
        assert_eq!(scheduler(&[(ID, "26"), COUNT, min("20"), ("SLURM_ARRAY_TASK_STEP", "2")]), shard(4, 4));
        // Beyond the array, before it, between its steps, and without a count.
        assert!(scheduler(&[(ID, "5"), COUNT, min("1")]).unwrap_err().contains("gaps"));
        assert!(scheduler(&[(ID, "0"), COUNT, min("1")]).is_err());
        assert!(scheduler(&[(ID, "21"), COUNT, min("20"), ("SLURM_ARRAY_TASK_STEP", "2")]).is_err());
        assert!(scheduler(&[(ID, "0")]).unwrap_err().contains("SLURM_ARRAY_TASK_COUNT"));
        assert!(scheduler(&[(ID, "0"), COUNT]).unwrap_err().contains("SLURM_ARRAY_TASK_MIN"));
        assert!(scheduler(&[(ID, "x"), COUNT, min("0")]).unwrap_err().contains("`x`"));
    }

    #[test]
    fn indexed_jobs_count_from_0() {
        const COUNT: (&str, &str) = ("JOB_COMPLETIONS", "4");
        assert_eq!(scheduler(&[("JOB_COMPLETION_INDEX", "0"), COUNT]), shard(1, 4));
        assert_eq!(scheduler(&[("JOB_COMPLETION_INDEX", "3"), COUNT]), shard(4, 4));
        assert!(scheduler(&[("JOB_COMPLETION_INDEX", "4"), COUNT]).is_err());
        assert!(scheduler(&[("JOB_COMPLETION_INDEX", "0")]).unwrap_err().contains("JOB_COMPLETIONS"));
        assert_eq!(scheduler(&[]), Ok(None));
    }
}
