//! The table of costs and goals.

use std::fmt::Write;
use std::time::Duration;

use super::compilation::Compilation;

/// A number that is measured; each is one row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Figure {
    CommandWall,
    CommandCpu,
    CommandOwnCpu,
    CommandMemory,
    BinaryBytes,
    Kernels,
    EditWall,
    TestsWall,
    TestsCpu,
    TestsMemory,
    TestsCompilingWall,
    TestsCompilingCpu,
    TestsRunningWall,
    TestsRunningCpu,
}

#[derive(Debug, Clone, Copy)]
enum Unit {
    Millis,
    Bytes,
    Count,
}

struct Row {
    figure: Figure,
    name: &'static str,
    unit: Unit,
    /// The most that it should be, on two cores.
    goal: Option<u64>,
}

const fn row(figure: Figure, name: &'static str, unit: Unit, goal: Option<u64>) -> Row {
    Row { figure, name, unit, goal }
}

/// All rows in their order, with the goals.
const ROWS: &[Row] = &[
    row(Figure::CommandWall, "command, release, from nothing: time", Unit::Millis, Some(90_000)),
    row(Figure::CommandCpu, "– processor", Unit::Millis, Some(150_000)),
    row(Figure::CommandOwnCpu, "– processor, crates of this workspace", Unit::Millis, Some(60_000)),
    row(Figure::CommandMemory, "– largest compiler", Unit::Bytes, Some(1_500_000_000)),
    row(Figure::BinaryBytes, "– binary", Unit::Bytes, Some(10_000_000)),
    row(
        Figure::Kernels,
        "– kernels, for all machines (instances of `Paint::draw_alike` and `draw_alone`)",
        Unit::Count,
        Some(32),
    ),
    row(
        Figure::EditWall,
        "command, release, after an edit in `crates/raster`: time",
        Unit::Millis,
        Some(30_000),
    ),
    row(Figure::TestsWall, "`cargo test --workspace` from nothing: time", Unit::Millis, Some(360_000)),
    row(Figure::TestsCpu, "– processor", Unit::Millis, Some(660_000)),
    row(Figure::TestsMemory, "– largest compiler", Unit::Bytes, Some(1_500_000_000)),
    row(Figure::TestsCompilingWall, "– compiling: time", Unit::Millis, None),
    row(Figure::TestsCompilingCpu, "– compiling: processor", Unit::Millis, None),
    row(Figure::TestsRunningWall, "– running: time", Unit::Millis, None),
    row(Figure::TestsRunningCpu, "– running: processor", Unit::Millis, None),
];

/// The numbers measured so far.
#[derive(Debug, Default)]
pub(super) struct Figures(Vec<(Figure, u64, String)>);

impl Figures {
    pub(super) fn add(&mut self, figure: Figure, value: u64) {
        self.0.push((figure, value, String::new()));
    }

    pub(super) fn add_seconds(&mut self, figure: Figure, time: Duration) {
        self.add(figure, u64::try_from(time.as_millis()).unwrap_or(u64::MAX));
    }

    /// The memory of the largest compiler, with the name of its crate.
    pub(super) fn add_memory(&mut self, figure: Figure, largest: &Compilation) {
        self.0.push((figure, largest.peak_bytes, format!(" (`{}`)", largest.name)));
    }

    fn get(&self, figure: Figure) -> Option<(u64, &str)> {
        self.0.iter().find(|each| each.0 == figure).map(|(_, value, note)| (*value, note.as_str()))
    }
}

/// The rows that were measured, as a table for docs/build.md.
pub(super) fn markdown(figures: &Figures) -> String {
    let mut text = String::from("| building | goal | measured |\n|---|---:|---:|\n");
    for row in ROWS {
        let Some((value, note)) = figures.get(row.figure) else { continue };
        let over = if exceeds(row, value) { ", over" } else { "" };
        let value = write_value(row.unit, value);
        let _ = writeln!(text, "{}{value}{note}{over} |", row.beginning());
    }
    text
}

/// The rows whose goals are missed, with both numbers.
pub(super) fn missed(figures: &Figures) -> Vec<String> {
    let values = ROWS.iter().filter_map(|row| Some((row, figures.get(row.figure)?.0, row.goal?)));
    let missed = values.filter(|(row, value, _)| exceeds(row, *value));
    missed
        .map(|(row, value, goal)| {
            let [value, goal] = [value, goal].map(|number| write_value(row.unit, number));
            format!("{:?} is {value}, goal {goal}", row.figure)
        })
        .collect()
}

impl Row {
    /// The row up to the measured value.
    fn beginning(&self) -> String {
        let goal = self.goal.map_or(String::new(), |goal| write_value(self.unit, goal));
        format!("| {} | {goal} | ", self.name)
    }
}

fn exceeds(row: &Row, value: u64) -> bool {
    row.goal.is_some_and(|goal| value > goal)
}

/// The value in the unit that people use, with the digits that mean something.
fn write_value(unit: Unit, value: u64) -> String {
    // Rounded to the nearest in steps of a size, and then with a point before some of its digits.
    let steps = |size: u64| (value + size / 2) / size;
    match unit {
        Unit::Millis if value < 9_950 => format!("{}.{} s", steps(100) / 10, steps(100) % 10),
        Unit::Millis => format!("{} s", steps(1000)),
        Unit::Bytes if value < 999_950_000 => {
            format!("{}.{} MB", steps(100_000) / 10, steps(100_000) % 10)
        }
        Unit::Bytes => format!("{}.{:02} GB", steps(10_000_000) / 100, steps(10_000_000) % 100),
        Unit::Count => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_beside_their_goals() {
        let mut figures = Figures::default();
        figures.add(Figure::Kernels, 13);
        figures.add(Figure::BinaryBytes, 10_000_001);
        figures.add_seconds(Figure::CommandWall, Duration::from_millis(89_900));
        let table = "| building | goal | measured |\n|---|---:|---:|\n\
            | command, release, from nothing: time | 90 s | 90 s |\n\
            | – binary | 10.0 MB | 10.0 MB, over |\n\
            | – kernels, for all machines (instances of `Paint::draw_alike` and `draw_alone`) | 32 | 13 |\n";
        assert_eq!(markdown(&figures), table);
        assert_eq!(missed(&figures), ["BinaryBytes is 10.0 MB, goal 10.0 MB"]);
    }

    #[test]
    fn values_are_short() {
        assert_eq!(write_value(Unit::Millis, 8_040), "8.0 s");
        assert_eq!(write_value(Unit::Bytes, 1_234_000_000), "1.23 GB");
        assert_eq!(write_value(Unit::Bytes, 999_950_000), "1.00 GB");
        assert_eq!(write_value(Unit::Millis, 9_960), "10 s");
    }

    /// The page repeats the goals, so that they can be read without measuring.
    #[test]
    fn the_page_has_every_row() {
        let page = std::fs::read_to_string(crate::workspace::root().join("docs/build.md")).unwrap();
        let mut rest = page.as_str();
        for row in ROWS {
            let beginning = row.beginning();
            let at =
                rest.find(&beginning).unwrap_or_else(|| panic!("docs/build.md lacks `{beginning}` here"));
            rest = &rest[at + 1..];
        }
    }
}
