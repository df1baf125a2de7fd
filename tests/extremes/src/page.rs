//! The page: tables in Markdown, all rows as CSV, and a plot of each axis.

use crate::axis::{Axis, Series};
use crate::measured::Measured;
use crate::plot;
use crate::sweep::{Results, Sweep};
use std::fs;
use std::path::Path;

/// The name of the page, and that of all rows.
pub const PAGE: &str = "extremes.md";
const ROWS: &str = "extremes.csv";

/// What stands above the tables.
const HEADING: &str = include_str!("heading.md");

/// The most columns of points in a table.
const COLUMNS: usize = 9;

/// Writes page, rows and plots into a folder, the plots into `pictures` in it.
///
/// # Errors
/// What the file system says.
pub fn write(sweep: &Sweep, results: &Results, docs: &Path) -> Result<(), String> {
    let put = |name: &str, text: String| {
        let path = docs.join(name);
        fs::write(&path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
    };
    for (axis, rows) in axes(sweep, results) {
        let path = docs.join("pictures").join(picture(axis));
        plot::draw(axis, rows, &path).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    }
    put(ROWS, csv(sweep, results))?;
    put(PAGE, markdown(sweep, results))
}

/// The axes, each with its part of the results.
fn axes<'a>(sweep: &'a Sweep, results: &'a Results) -> impl Iterator<Item = (&'a Axis, &'a [Measured])> {
    let mut rest = &results[..];
    sweep.axes.iter().map(move |axis| {
        let (rows, others) = rest.split_at(axis.series.len() * axis.points.len());
        rest = others;
        (axis, rows)
    })
}

fn picture(axis: &Axis) -> String {
    format!("extremes_{}.svg", axis.name.replace('-', "_"))
}

/// The policies of an axis, each with its results at the points.
pub(crate) fn series<'a>(
    axis: &'a Axis,
    rows: &'a [Measured],
) -> impl Iterator<Item = (&'a Series, &'a [Measured])> {
    axis.series.iter().zip(rows.chunks(axis.points.len()))
}

fn markdown(sweep: &Sweep, results: &Results) -> String {
    let mut text = HEADING.replace("{seed}", &format!("{:#x}", sweep.seed));
    let samples: u64 = results.iter().map(|row| row.samples).sum();
    text = text
        .replace("{samples}", &format!("{:.1}", samples as f64 / 1e6))
        .replace("{rows}", &results.len().to_string());
    for (axis, rows) in axes(sweep, results) {
        text += &section(axis, rows);
    }
    text
}

fn section(axis: &Axis, rows: &[Measured]) -> String {
    let Axis { title, about, parameter, unit, .. } = axis;
    let mut text = format!("\n## {title}\n\n{}\n\n", wrapped(about));
    text += &format!("![{title}: error and share of the bound](pictures/{})\n\n", picture(axis));
    let stride = axis.points.len().div_ceil(COLUMNS);
    // The ends, and every so many between.
    let last = axis.points.len() - 1;
    let shown: Vec<usize> = (0..=last).filter(|i| i % stride == 0 || *i == last).collect();
    text += &wrapped(&format!(
        "The greatest error in {unit} by {parameter}, and in brackets the greatest share of the bound; – where none \
         is stated."
    ));
    text += &format!(
        "\n\n| policy |{}\n",
        shown.iter().map(|&i| format!(" {} |", axis.points[i].1)).collect::<String>()
    );
    text += &format!("|---|{}\n", "---:|".repeat(shown.len()));
    for (series, rows) in series(axis, rows) {
        let cells = shown.iter().map(|&i| format!(" {} |", cell(&rows[i])));
        text += &format!("| {} |{}\n", quoted(&series.policy), cells.collect::<String>());
    }
    text + "\n" + &breaks(axis, rows)
}

fn cell(row: &Measured) -> String {
    if row.samples == 0 {
        return "refused".into();
    }
    let share = if row.is_unbounded() { "–".into() } else { format!("{:.2}", row.share.figure) };
    format!("{} ({share})", digits(row.error.error))
}

/// The points at which each policy is beyond the limit, and those at which a constructor refuses.
fn breaks(axis: &Axis, rows: &[Measured]) -> String {
    let (limit, name) = axis.limit;
    let (mut never, mut lines) = (Vec::new(), String::new());
    let mut refused: Vec<(String, Vec<String>)> = Vec::new();
    for (series, rows) in series(axis, rows) {
        let policy = quoted(&series.policy);
        let broken: Vec<bool> = rows.iter().map(|row| row.samples > 0 && row.error.error > limit).collect();
        let there: Vec<bool> = rows.iter().map(|row| row.samples > 0).collect();
        match spelled(axis, &broken, &there) {
            Some(points) => lines += &format!("{}\n", wrapped(&format!("* {policy}: {points}"))),
            None => never.push(policy.clone()),
        }
        let at: Vec<bool> = rows.iter().map(|row| row.refused > 0).collect();
        if let Some(points) = spelled(axis, &at, &[]) {
            let line = format!("{points}, by {}", series.refuses);
            match refused.iter_mut().find(|(other, _)| *other == line) {
                Some((_, policies)) => policies.push(policy),
                None => refused.push((line, vec![policy])),
            }
        }
    }
    let mut text = if lines.is_empty() {
        format!("Nothing here is ever more than {name}.\n")
    } else {
        let rest = if never.is_empty() {
            String::new()
        } else {
            format!("{}\n", wrapped(&format!("* {}: never", never.join(", "))))
        };
        format!("Where it breaks, with more than {name}, by {}:\n\n{lines}{rest}", axis.parameter)
    };
    for (line, policies) in &refused {
        let whose = if policies.len() == axis.series.len() {
            String::new()
        } else {
            format!(" ({})", policies.join(", "))
        };
        text += &format!("\n{}\n", wrapped(&format!("Refused{whose}: {line}.")));
    }
    text
}

/// The chosen points: everywhere where there is an answer, up to one, from one on, or each by its name.
fn spelled(axis: &Axis, chosen: &[bool], there: &[bool]) -> Option<String> {
    let points: Vec<usize> = (0..chosen.len()).filter(|&i| chosen[i]).collect();
    let name = |i: usize| axis.points[i].1.as_str();
    let (&first, &last) = (points.first()?, points.last()?);
    let answers: Vec<usize> = (0..there.len()).filter(|&i| there[i]).collect();
    let from = answers.iter().filter(|&&i| i >= first).count() == points.len();
    let to = answers.iter().filter(|&&i| i <= last).count() == points.len();
    Some(match (from, to) {
        (true, true) => "everywhere".into(),
        (true, false) => format!("from {} on", name(first)),
        (false, true) => format!("up to {}", name(last)),
        (false, false) => points.iter().map(|&i| name(i)).collect::<Vec<_>>().join(", "),
    })
}

/// Every row, with the identities of its worst samples.
fn csv(sweep: &Sweep, results: &Results) -> String {
    let mut text = format!("# seed {:#x}\n", sweep.seed);
    text += "row,unit,samples,refused,greatest_error,bound_there,sample,greatest_share,error_there,its_bound,sample\n";
    for (row, measured) in sweep.rows().zip(results) {
        let Measured { samples, refused, share, error } = measured;
        text += &format!(
            "\"{}\",{},{samples},{refused},{:.6e},{:.6e},{}:{},{:.4},{:.6e},{:.6e},{}:{}\n",
            row.name(),
            row.axis.unit,
            error.error,
            error.bound,
            error.place.block,
            error.place.index,
            share.figure.max(0.0),
            share.error,
            share.bound,
            share.place.block,
            share.place.index,
        );
    }
    text
}

/// Code, where a policy is a name of the library; words as they are.
fn quoted(policy: &str) -> String {
    let is_code = !policy.contains(' ') && policy.chars().next().is_some_and(char::is_uppercase);
    if is_code { format!("`{policy}`") } else { policy.to_string() }
}

/// Three digits at most.
pub(crate) fn digits(x: f64) -> String {
    match x {
        0.0 => "0".into(),
        x if x.is_infinite() => "∞".into(),
        x if (0.01..100.0).contains(&x) => {
            let places = (2 - x.log10().floor() as i32).clamp(0, 4) as usize;
            let text = format!("{x:.places$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
        }
        x if (100.0..10_000.0).contains(&x) => format!("{x:.0}"),
        x => format!("{x:.0e}"),
    }
}

/// Words in lines of up to 120 columns.
fn wrapped(words: &str) -> String {
    let (mut text, mut width) = (String::new(), 0);
    for word in words.split_whitespace() {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > 120 {
            text.push('\n');
            width = 0;
        } else if width > 0 {
            text.push(' ');
            width += 1;
        }
        text += word;
        width += length;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let texts = [0.0, 0.5, 0.0123, 1.0, 12.34, 99.96, 256.0, 4.2e-5, 1.234e7, f64::INFINITY].map(digits);
        assert_eq!(texts, ["0", "0.5", "0.0123", "1", "12.3", "100", "256", "4e-5", "1e7", "∞"]);
    }

    #[test]
    fn prose_is_wrapped() {
        let text = wrapped(&"word ".repeat(100));
        assert!(text.lines().all(|line| line.len() <= 120) && text.lines().count() == 5, "{text}");
    }
}
