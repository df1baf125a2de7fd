//! Instructions of frames, as valgrind's callgrind counts them.
//!
//! Under callgrind the program draws each row's frame once more within [`measured`], which is all that is collected. At
//! `ended` a part of the profile is written: part n is that of row n.

use crate::row::Row;
use std::path::Path;

/// Draws a frame that is counted.
#[inline(never)]
pub fn measured(row: &mut Row, words: &mut [u32]) {
    std::hint::black_box(&mut row.frame)(words);
    ended(words);
}

/// The end of it. A function of its own, since the last call of one may be a jump.
#[inline(never)]
fn ended(words: &[u32]) {
    std::hint::black_box(words);
}

/// The counts of all parts that callgrind left in a folder, in order. Parts are files whose names end in their number.
///
/// # Errors
/// The folder cannot be read, or a part has no sum.
pub fn read(folder: &Path) -> Result<Vec<u64>, String> {
    let failed = |error: std::io::Error| format!("cannot read {}: {error}", folder.display());
    let mut parts = vec![];
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let number = path.extension().and_then(|end| end.to_str()).and_then(|end| end.parse::<u32>().ok());
        let Some(number) = number else { continue };
        let text = std::fs::read_to_string(&path).map_err(failed)?;
        parts.push((number, sum(&text).ok_or_else(|| format!("no sum in {}", path.display()))?));
    }
    parts.sort_unstable();
    Ok(parts.into_iter().map(|(_, count)| count).filter(|&count| count > 0).collect())
}

/// The sum that a part of a profile states.
fn sum(text: &str) -> Option<u64> {
    text.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_found() {
        assert_eq!(sum("version: 1\nsummary: 12\n\nfn=(1)\n1 2\ntotals: 12\n"), Some(12));
        assert_eq!(sum("version: 1\n"), None);
    }
}
