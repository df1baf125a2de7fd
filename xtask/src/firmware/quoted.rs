//! Figures of the committed table on other pages: each column that is headed by a board, in tables with a column
//! `scene`, which names the scene or the program of a line. Two names with a minus between them are a difference, and
//! with a stroke a ratio.

use super::boards::BOARDS;
use super::table::{PLACE, Row, Unit, figure};

/// The heading of the column of names.
const SCENE: &str = "scene";

/// The headings of the table of scenes on the page of counts.
pub(super) const COUNTED: [&str; 3] = [SCENE, "triangles", "pixels"];

/// Pixels of a frame, per which some figures are where not all are written.
const FRAME: u64 = 320 * 240;

/// A table of a page in Markdown: the cells of its heading, and of its lines with their numbers.
struct Table<'a> {
    heading: Vec<&'a str>,
    lines: Vec<(usize, Vec<&'a str>)>,
}

/// The tables of a page.
fn tables(page: &str) -> Vec<Table<'_>> {
    let mut tables: Vec<Table<'_>> = Vec::new();
    let mut inside = false;
    for (number, line) in (1..).zip(page.lines()) {
        let Some(line) = line.strip_prefix('|') else {
            inside = false;
            continue;
        };
        let cells: Vec<&str> = line.trim_end_matches('|').split('|').map(str::trim).collect();
        match tables.last_mut() {
            Some(table) if inside => table.lines.push((number, cells)),
            _ => tables.push(Table { heading: cells, lines: vec![] }),
        }
        inside = true;
    }
    tables
}

/// The words between backticks of a cell, and those between these.
fn code(cell: &str) -> Vec<&str> {
    cell.split('`').skip(1).map(str::trim).take_while(|words| !words.is_empty()).collect()
}

/// A number with commas, and half a unit of its last digit.
fn number(cell: &str) -> Option<(f64, f64)> {
    let digits = cell.replace(',', "");
    let places = digits.split_once('.').map_or(0, |(_, places)| places.len());
    Some((digits.parse().ok()?, 0.5 / 10_f64.powi(i32::try_from(places).ok()?)))
}

/// Triangles and pixels of a scene, as the page of counts has them.
fn scene(counts: &str, name: &str) -> Option<[u64; 2]> {
    let table = tables(counts).into_iter().find(|table| table.heading == COUNTED)?;
    let (_, cells) = table.lines.into_iter().find(|(_, cells)| cells[0] == name)?;
    let count = |cell: &str| cell.replace(',', "").parse().ok();
    Some([count(cells.get(1)?)?, count(cells.get(2)?)?])
}

/// Figures as people write them: per pixel, per triangle and in millions of a scene, bytes and KB of a program. The
/// page's text says which.
#[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
fn readings(rows: &[Row], counts: &str, board: &str, names: &[&str]) -> Option<Vec<f64>> {
    let of = |name: &str, unit| figure(rows, board, name, unit).map(|figure| figure as f64);
    let instructions = match *names {
        [name] | [name, "-", _] => match of(name, Unit::Code) {
            Some(code) => {
                let [constants, statics, stack] = [Unit::Constants, Unit::Statics, Unit::Stack]
                    .map(|unit| of(name, unit).unwrap_or_default());
                let bytes = [code, code + constants, stack, statics + stack];
                return Some(bytes.into_iter().chain(bytes.map(|bytes| bytes / 1024.0)).collect());
            }
            None => of(name, Unit::Instructions)?,
        },
        [name, "/", by] => return Some(vec![of(name, Unit::Instructions)? / of(by, Unit::Instructions)?]),
        _ => return None,
    };
    let less = if let [_, _, less] = *names { of(less, Unit::Instructions)? } else { 0.0 };
    let [triangles, pixels] = scene(counts, names[0])?;
    let units = [triangles, pixels, FRAME, 1_000_000];
    Some(units.map(|unit| (instructions - less) / unit.max(1) as f64).to_vec())
}

/// The faults of a page, by line: figures that are more than a hundredth off. The figures of a line have one reading,
/// that in which most of them are right, and of such the nearest.
pub(super) fn faults(page: &str, rows: &[Row], counts: &str) -> Vec<(usize, String)> {
    let mut faults = Vec::new();
    for Table { heading, lines } in tables(page) {
        let Some(place) = heading.iter().position(|cell| *cell == SCENE) else { continue };
        let boards: Vec<(usize, &str)> = (heading.iter().enumerate())
            .filter_map(|(column, cell)| {
                let known = |board: &&super::Board| code(cell) == [board.name];
                BOARDS.iter().find(known).map(|board| (column, board.name))
            })
            .collect();
        for (line, cells) in lines {
            let names = code(cells.get(place).unwrap_or(&""));
            // A line of another source.
            if !names.is_empty() {
                let of_boards =
                    boards.iter().map(|&(column, board)| (board, *cells.get(column).unwrap_or(&"")));
                let of_line = of_line(&names, of_boards.filter(|(_, cell)| !cell.is_empty()), rows, counts);
                faults.extend(of_line.into_iter().map(|told| (line, told)));
            }
        }
    }
    faults
}

/// The faults of a line with these names, by boards and cells.
fn of_line<'a>(
    names: &[&str],
    cells: impl Iterator<Item = (&'a str, &'a str)>,
    rows: &[Row],
    counts: &str,
) -> Vec<String> {
    let names_of = names.join(" ");
    // For each reading how far off it is, and the faults.
    let (mut faults, mut by_reading) = (vec![], Vec::<(f64, Vec<String>)>::new());
    for (board, cell) in cells {
        match (readings(rows, counts, board, names), number(cell)) {
            (None, _) => faults.push(format!("{PLACE} has no figures of `{names_of}` on {board}")),
            (_, None) => faults.push(format!("found `{cell}`, expected a number")),
            (Some(readings), Some((found, half))) => {
                by_reading.resize(readings.len(), (0.0, vec![]));
                for (figure, (off, faults)) in readings.into_iter().zip(&mut by_reading) {
                    *off += (found / figure).ln().abs();
                    if (found - figure).abs() > half + figure.abs() / 100.0 {
                        let told =
                            format!("found {cell} for `{names_of}` on {board}, {PLACE} has {figure:.5}");
                        faults.push(told);
                    }
                }
            }
        }
    }
    let worse = |a: &(f64, Vec<String>), b: &(f64, Vec<String>)| {
        (a.1.len().cmp(&b.1.len())).then(a.0.total_cmp(&b.0))
    };
    faults.extend(by_reading.into_iter().min_by(worse).unwrap_or_default().1);
    faults
}

#[cfg(test)]
mod tests {
    use super::super::table;
    use super::*;

    const COUNTS: &str =
        "| scene | triangles | pixels |\n|---|---|---|\n| a | 2 | 1,000 |\n| b | 2 | 1,000 |\n";

    fn told(lines: &str) -> Vec<(usize, String)> {
        let rows = table::read(
            "board,name,unit,figure\nm0,a,instructions,43210\nm0,b,instructions,3210\nm4f,a,instructions,5000000\n\
             m0,size-x,code,20480\nm0,size-x,constants,1024\nm0,size-x,stack,512\n",
        );
        faults(
            &format!("Text.\n\n| scene | is | `m0` | `m4f` |\n|---|---|---|---|\n{lines}"),
            &rows.unwrap(),
            COUNTS,
        )
    }

    #[test]
    fn figures_are_of_the_table() {
        let right = "| `a` | | 43.2 | 5,000 |\n| `a` | | 21,600 | |\n| `a` - `b` | | 40 | |\n| `a` / `b` | | 13.5 | |\n| `size-x` | | 21.0 | |\n";
        assert_eq!(told(right), []);
        assert_eq!(told("| another source | | 7 | 8 |\n"), []);
        assert!(faults("| scene | ms |\n|---|---|\n| `a` | 7 |\n", &[], COUNTS).is_empty());
    }

    #[test]
    fn a_figure_that_is_a_hundredth_off_is_told_by_its_line() {
        let [(5, message)] = &told("| `a` | | 44.0 | 5,000 |\n")[..] else { panic!("one fault") };
        assert!(message.starts_with("found 44.0 for `a` on m0, ") && message.contains("43.210"), "{message}");
        assert_eq!(told("| `a` | | 43.6 | 5,060 |\n").len(), 1);
        assert_eq!(told("| `a` - `b` | | 43.2 | |\n| `b` / `a` | | 13.5 | |\n").len(), 2);
    }

    #[test]
    fn figures_of_a_line_have_one_reading() {
        let [(5, message)] = &told("| `a` | | 43.2 | 2,500,000 |\n")[..] else { panic!("one fault") };
        assert!(message.contains("for `a` on m"), "{message}");
    }

    #[test]
    fn names_and_numbers_are_known() {
        let found = told("| `c` | | 1 | |\n| `a` | | many | |\n");
        let messages: Vec<&str> = found.iter().map(|(_, message)| message.as_str()).collect();
        assert_eq!(
            messages,
            ["tests/firmware/counts.csv has no figures of `c` on m0", "found `many`, expected a number"]
        );
    }
}
