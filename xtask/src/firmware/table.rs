//! The table of counts that is committed: `tests/firmware/counts.csv`, a line for each board, name and unit.

use std::fmt::Write as _;

use super::boards::BOARDS;

/// Its place in the repository.
pub(super) const PLACE: &str = "tests/firmware/counts.csv";

/// Its first line.
const HEADING: &str = "board,name,unit,figure";

/// The kinds of figures: those of a scene, then those of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unit {
    /// Executed instructions of a frame.
    Instructions,
    /// Divisions of a frame.
    Divides,
    /// Bytes of code of a program.
    Code,
    /// Bytes of its constants, and of the values with which its variables begin.
    Constants,
    /// Bytes of its variables.
    Statics,
    /// The most bytes of stack that it takes.
    Stack,
}

impl Unit {
    const ALL: [(Self, &'static str); 6] = [
        (Self::Instructions, "instructions"),
        (Self::Divides, "divides"),
        (Self::Code, "code"),
        (Self::Constants, "constants"),
        (Self::Statics, "statics"),
        (Self::Stack, "stack"),
    ];

    /// Whether it is one of programs, not of frames.
    pub(super) fn is_of_programs(self) -> bool {
        !matches!(self, Self::Instructions | Self::Divides)
    }

    /// The word in the table.
    fn word(self) -> &'static str {
        Self::ALL.iter().find(|(unit, _)| *unit == self).map_or("", |(_, word)| word)
    }
}

/// One line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) board: &'static str,
    /// A scene's or a program's.
    pub(super) name: String,
    pub(super) unit: Unit,
    pub(super) figure: u64,
}

impl Row {
    /// Whether both are about the same.
    fn is_about(&self, other: &Self) -> bool {
        (self.board, self.unit) == (other.board, other.unit) && self.name == other.name
    }
}

/// Reads the table.
pub(super) fn read(text: &str) -> Result<Vec<Row>, String> {
    let mut rows: Vec<Row> = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let wrong = |found: &str, expected: &str| {
            Err(format!("{PLACE}:{number}: found `{found}`, expected {expected}"))
        };
        if number == 1 {
            if line != HEADING {
                return wrong(line, &format!("`{HEADING}`"));
            }
            continue;
        }
        let [board, name, unit, figure] = line.split(',').collect::<Vec<_>>()[..] else {
            return wrong(line, "four fields");
        };
        let Some(board) = BOARDS.iter().map(|known| known.name).find(|known| *known == board) else {
            return wrong(board, "the name of a board");
        };
        let Some((unit, _)) = Unit::ALL.into_iter().find(|(_, word)| *word == unit) else {
            return wrong(unit, &format!("one of {}", Unit::ALL.map(|(_, word)| word).join(", ")));
        };
        let Ok(figure) = figure.parse() else { return wrong(figure, "a whole number") };
        let row = Row { board, name: name.to_string(), unit, figure };
        if rows.iter().any(|other| other.is_about(&row)) {
            return wrong(line, "no second line about the same");
        }
        rows.push(row);
    }
    if text.is_empty() { Err(format!("{PLACE}:1: found nothing, expected `{HEADING}`")) } else { Ok(rows) }
}

/// The table as text.
pub(super) fn write(rows: &[Row]) -> String {
    let mut text = format!("{HEADING}\n");
    for Row { board, name, unit, figure } in rows {
        let _ = writeln!(text, "{board},{name},{},{figure}", unit.word());
    }
    text
}

/// The figure of a board, name and unit.
pub(super) fn figure(rows: &[Row], board: &str, name: &str, unit: Unit) -> Option<u64> {
    rows.iter().find(|row| row.board == board && row.name == name && row.unit == unit).map(|row| row.figure)
}

/// A line for each figure of a board that is more than a hundredth above the committed one, or stands in one of both
/// alone. Units that were not counted are left out.
pub(super) fn rises(
    board: &str,
    committed: &[Row],
    found: &[Row],
    counted: impl Fn(Unit) -> bool,
) -> Vec<String> {
    let mut lines = Vec::new();
    for row in found.iter().filter(|row| row.board == board) {
        let Row { name, unit, figure, .. } = row;
        let word = unit.word();
        match committed.iter().find(|known| known.is_about(row)) {
            Some(known) if figure * 100 <= known.figure * 101 => {}
            Some(Row { figure: known, .. }) => lines.push(format!(
                "board {board}, {name}: {figure} {word}, {known} in {PLACE}: more than a hundredth above it"
            )),
            None => lines.push(format!("board {board}, {name}: {figure} {word}, and no line in {PLACE}")),
        }
    }
    let stale = |row: &&Row| {
        row.board == board && counted(row.unit) && !found.iter().any(|other| other.is_about(row))
    };
    lines.extend(committed.iter().filter(stale).map(|Row { name, unit, .. }| {
        format!("board {board}, {name}: {PLACE} has {} for it, which were not found", unit.word())
    }));
    lines
}

/// The number of figures that are more than a hundredth below the committed ones.
pub(super) fn falls(committed: &[Row], found: &[Row]) -> usize {
    let below = |row: &&Row| {
        let known = committed.iter().find(|known| known.is_about(row));
        known.is_some_and(|known| row.figure * 100 < known.figure * 99)
    };
    found.iter().filter(below).count()
}

/// The committed table with what was found in the place of what it had, board by board. Those that did not run keep
/// their lines, and so do, of scenes that are still there, units that were not counted.
pub(super) fn merged(committed: &[Row], found: &[Row], counted: impl Fn(Unit) -> bool) -> Vec<Row> {
    let mut rows = Vec::new();
    for board in BOARDS.iter().map(|board| board.name) {
        let of = |rows: &[Row]| rows.iter().filter(|row| row.board == board).cloned().collect::<Vec<_>>();
        let (old, new) = (of(committed), of(found));
        if new.is_empty() {
            rows.extend(old);
            continue;
        }
        let is_there = |row: &Row| new.iter().any(|other| other.name == row.name);
        let kept: Vec<Row> = old.into_iter().filter(|row| !counted(row.unit) && is_there(row)).collect();
        rows.extend(new.into_iter().chain(kept));
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str =
        "board,name,unit,figure\nm0,flat,instructions,1000\nm0,flat,divides,0\nm4f,size-flat,code,200\n";

    fn all(_: Unit) -> bool {
        true
    }

    fn without_divides(unit: Unit) -> bool {
        unit != Unit::Divides
    }

    #[test]
    fn the_table_is_written_as_it_is_read() {
        let rows = read(TEXT).unwrap();
        assert_eq!(rows[0], Row { board: "m0", name: "flat".into(), unit: Unit::Instructions, figure: 1000 });
        assert_eq!((rows.len(), write(&rows)), (3, TEXT.to_string()));
        assert_eq!(figure(&rows, "m4f", "size-flat", Unit::Code), Some(200));
        assert_eq!(figure(&rows, "m0", "size-flat", Unit::Code), None);
    }

    #[test]
    fn wrong_lines_are_told_with_file_line_found_and_expected() {
        let after = |line: &str| read(&format!("{TEXT}{line}\n")).unwrap_err();
        assert_eq!(read("").unwrap_err(), format!("{PLACE}:1: found nothing, expected `{HEADING}`"));
        assert_eq!(read("a,b\n").unwrap_err(), format!("{PLACE}:1: found `a,b`, expected `{HEADING}`"));
        assert_eq!(after("m0,flat"), format!("{PLACE}:5: found `m0,flat`, expected four fields"));
        assert_eq!(after("m1,flat,code,7"), format!("{PLACE}:5: found `m1`, expected the name of a board"));
        assert_eq!(
            after("m0,flat,bytes,7"),
            format!(
                "{PLACE}:5: found `bytes`, expected one of instructions, divides, code, constants, statics, stack"
            )
        );
        assert_eq!(after("m0,flat,code,-7"), format!("{PLACE}:5: found `-7`, expected a whole number"));
        assert_eq!(
            after("m0,flat,divides,7"),
            format!("{PLACE}:5: found `m0,flat,divides,7`, expected no second line about the same")
        );
    }

    /// The lines about these figures of `m0`'s flat scene.
    fn told(instructions: u64, divides: u64) -> Vec<String> {
        let row = |unit, figure| Row { board: "m0", name: "flat".into(), unit, figure };
        let found = [row(Unit::Instructions, instructions), row(Unit::Divides, divides)];
        rises("m0", &read(TEXT).unwrap(), &found, all)
    }

    #[test]
    fn more_than_a_hundredth_is_told_of_a_board_that_ran() {
        assert_eq!(told(1010, 0), [""; 0]);
        assert_eq!(told(1, 0), [""; 0]);
        assert_eq!(
            told(1011, 1),
            [
                format!("board m0, flat: 1011 instructions, 1000 in {PLACE}: more than a hundredth above it"),
                format!("board m0, flat: 1 divides, 0 in {PLACE}: more than a hundredth above it"),
            ]
        );
    }

    #[test]
    fn figures_without_a_line_and_lines_without_a_figure_are_told() {
        let new = [Row { board: "m0", name: "new".into(), unit: Unit::Instructions, figure: 5 }];
        let committed = read(TEXT).unwrap();
        assert_eq!(
            rises("m0", &committed, &new, without_divides),
            [
                format!("board m0, new: 5 instructions, and no line in {PLACE}"),
                format!("board m0, flat: {PLACE} has instructions for it, which were not found"),
            ]
        );
        assert_eq!(rises("m0", &committed, &new, all).len(), 3);
    }

    #[test]
    fn falls_are_counted() {
        let committed = read(TEXT).unwrap();
        let mut found = committed.clone();
        found[0].figure = 990;
        assert_eq!(falls(&committed, &found), 0);
        found[0].figure = 989;
        found[2].figure = 100;
        assert_eq!(falls(&committed, &found), 2);
    }

    #[test]
    fn writing_keeps_boards_that_did_not_run_and_units_that_were_not_counted() {
        let committed = read(TEXT).unwrap();
        let found = [Row { figure: 7, ..committed[0].clone() }];
        let rows = merged(&committed, &found, without_divides);
        assert_eq!(write(&rows), TEXT.replace("1000", "7"));
        assert_eq!(
            write(&merged(&committed, &found, all)),
            TEXT.replace("1000", "7").replace("m0,flat,divides,0\n", "")
        );
        // A scene that is no more takes its divisions along.
        let found = [Row { name: "new".into(), ..found[0].clone() }];
        let rows = merged(&committed, &found, without_divides);
        assert_eq!(rows.iter().map(|row| row.name.as_str()).collect::<Vec<_>>(), ["new", "size-flat"]);
    }
}
