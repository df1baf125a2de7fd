//! The table of numbers: a line for each policy on each scene, as text that programs read.

use crate::errors::{Errors, Texels};
use crate::times::Time;
use std::fmt::Write as _;

/// A line of the table.
#[derive(Clone, Debug)]
pub struct Line {
    /// The family.
    pub family: &'static str,
    /// The scene.
    pub scene: &'static str,
    /// The policy.
    pub policy: String,
    /// Whether the others of its scene are measured by this one.
    pub reference: bool,
    /// Its errors.
    pub errors: Errors,
    /// The instructions of a frame, where they were counted.
    pub instructions: Option<u64>,
    /// The time of a frame, where it was taken.
    pub time: Option<Time>,
}

/// The columns: names, then errors, the instructions, and what does not repeat.
const COLUMNS: &str = "family,scene,policy,reference,texels_largest,texels_999,byte_largest,byte_999,off,psnr,flip,\
                       instructions,ms,time_quartile_1,time,time_quartile_3";

/// Of these, the errors that are compared: more is worse.
const ERRORS: [&str; 5] = ["texels_largest", "texels_999", "byte_largest", "byte_999", "flip"];

/// The table as comma-separated values, with a heading.
pub fn csv(lines: &[Line]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for line in lines {
        let picture = line.errors.picture;
        let texels = |of: fn(Texels) -> f64| line.errors.texels.map_or_else(String::new, |t| short(of(t)));
        let [first, median, third] =
            line.time.map_or_else(Default::default, |time| time.ratio.map(|ratio| format!("{ratio:.3}")));
        let fields = [
            line.family.to_owned(),
            line.scene.to_owned(),
            quoted(&line.policy),
            u8::from(line.reference).to_string(),
            texels(|t| t.largest),
            texels(|t| t.most),
            picture.largest.to_string(),
            picture.most.to_string(),
            picture.outliers.to_string(),
            if picture.mse == 0.0 { "inf".to_owned() } else { format!("{:.2}", picture.psnr()) },
            short(picture.flip),
            line.instructions.map_or_else(String::new, |count| count.to_string()),
            line.time.map_or_else(String::new, |time| format!("{:.3}", time.least)),
            first,
            median,
            third,
        ];
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", fields.join(","));
    }
    text
}

/// Four digits, whatever the size.
fn short(number: f64) -> String {
    if number == 0.0 { "0".to_owned() } else { format!("{number:.3e}") }
}

fn quoted(text: &str) -> String {
    if text.contains(',') { format!("\"{text}\"") } else { text.to_owned() }
}

/// A line as it is written, by columns.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut inside = false;
    for c in line.chars() {
        match c {
            '"' => inside = !inside,
            ',' if !inside => fields.push(String::new()),
            c => fields.last_mut().expect("one to begin with").push(c),
        }
    }
    fields
}

/// What is worse in `found` than in the table that is committed: an error or, if they can be compared, the
/// instructions, by more than a fiftieth; a row that is missing or new. A line for each, with the row's name.
pub fn worse(found: &str, committed: &str, instructions: bool) -> Vec<String> {
    let columns: Vec<&str> = COLUMNS.split(',').collect();
    let index = |name: &str| columns.iter().position(|column| *column == name).unwrap_or(usize::MAX);
    let name = |fields: &[String]| fields.iter().take(3).cloned().collect::<Vec<_>>().join("/");
    let rows = |text: &str| text.lines().skip(1).map(fields).collect::<Vec<_>>();
    let (found, committed) = (rows(found), rows(committed));
    let mut complaints = vec![];
    for old in &committed {
        let Some(new) = found.iter().find(|new| name(new) == name(old)) else {
            complaints.push(format!("{}: it is in the table, and was not measured", name(old)));
            continue;
        };
        let compared = ERRORS.iter().copied().chain(instructions.then_some("instructions"));
        for column in compared {
            let number = |row: &[String]| row.get(index(column)).and_then(|field| field.parse::<f64>().ok());
            let (Some(before), Some(after)) = (number(old), number(new)) else { continue };
            // Figures are rounded to a thousandth of themselves, bytes to whole ones.
            if after > before * 1.02 {
                complaints.push(format!("{}: {column} rose from {before} to {after}", name(old)));
            }
        }
    }
    let known = |new: &Vec<String>| committed.iter().any(|old| name(old) == name(new));
    for new in found.iter().filter(|new| !known(new)) {
        complaints.push(format!("{}: it was measured, and is not in the table", name(new)));
    }
    complaints
}

#[cfg(test)]
mod tests {
    use super::*;

    const OLD: &str = "head\na,b,\"c, d\",0,1.000e0,5.000e-1,9,3,0,40.00,1.000e-2,1000,1,1,1,1\n";

    fn changed(from: &str, to: &str) -> Vec<String> {
        worse(&OLD.replace(from, to), OLD, true)
    }

    #[test]
    fn what_is_worse_is_named() {
        assert!(worse(OLD, OLD, true).is_empty());
        assert_eq!(changed("1.000e-2", "1.021e-2"), ["a/b/c, d: flip rose from 0.01 to 0.01021"]);
        assert!(changed("1.000e-2", "1.019e-2").is_empty());
        assert!(changed("1.000e-2", "9.000e-3").is_empty());
        assert_eq!(changed(",3,", ",4,"), ["a/b/c, d: byte_999 rose from 3 to 4"]);
        assert_eq!(changed(",1000,", ",1021,"), ["a/b/c, d: instructions rose from 1000 to 1021"]);
        assert!(worse(&OLD.replace(",1000,", ",1021,"), OLD, false).is_empty());
        assert_eq!(changed("a,b", "a,x").len(), 2);
    }

    #[test]
    fn quotes_hold_commas_together() {
        assert_eq!(fields("a,\"b, c\",d"), ["a", "b, c", "d"]);
        assert_eq!(quoted("b, c"), "\"b, c\"");
    }
}
