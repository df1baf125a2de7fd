//! The committed table for people: `docs/firmware-counts.md`.

use std::fmt::Write as _;

use super::boards::{BOARDS, Board};
use super::frames::Expected;
use super::programs::{MOST_RAM, MOST_STACK, RENDERER, WEIGHED};
use super::quoted::COUNTED;
use super::table::{PLACE, Row, Unit, figure};

/// Its place in the repository.
pub(super) const PAGE: &str = "docs/firmware-counts.md";

/// The page of a table, with the host's triangles and pixels of each scene.
pub(super) fn page(rows: &[Row], expected: &[Expected]) -> String {
    let mut text = format!(
        "# Counts on cores\n\n\
         `cargo xtask firmware --write` writes this page and [its numbers](../{PLACE}).\n\
         Without `--write` it compares, and fails where a number is more than 1 % higher; sizes on `m3`, `m7` and\n\
         `m33`, which are like another board's, by `--board` alone.\n\
         [tests/firmware](../tests/firmware) says what the scenes and the numbers are.\n\n\
         ## Memory of a renderer\n\n{}\n## Scenes\n\n{}",
        renderer(rows),
        counted(expected)
    );
    for board in BOARDS.iter().filter(|board| rows.iter().any(|row| row.board == board.name)) {
        let _ = write!(text, "\n## {}\n\n{}.\n\n", heading(board), board.core);
        text += &scenes(board, rows, expected);
        text += &programs(board, rows);
    }
    text
}

/// The names of a board.
fn heading(board: &Board) -> String {
    let names = [board.name].into_iter().chain(board.also.iter().copied());
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" and ")
}

/// The memory of the renderer in bands on each board that tells it.
fn renderer(rows: &[Row]) -> String {
    let mut text = format!(
        "`{RENDERER}` draws a textured mesh of integers with meshlets in bands: 320x240, RGB565, 16-bit depth, in fixed\n\
         point. All its RAM is to be at most {} bytes, its stack at most {} of these.\n\n\
         | board | statics | stack | RAM | code | constants |\n|---|---|---|---|---|---|\n",
        grouped(MOST_RAM),
        grouped(MOST_STACK)
    );
    for board in BOARDS {
        let of = |unit| figure(rows, board.name, RENDERER, unit);
        let (Some(statics), Some(stack)) = (of(Unit::Statics), of(Unit::Stack)) else { continue };
        let cells = [Some(statics), Some(stack), Some(statics + stack), of(Unit::Code), of(Unit::Constants)];
        let _ = writeln!(text, "| {} | {} |", heading(board), joined(&cells));
    }
    text
}

/// Submitted triangles and written pixels of each scene.
fn counted(expected: &[Expected]) -> String {
    let mut text = format!("| {} |\n|---|---|---|\n", COUNTED.join(" | "));
    for Expected { name, triangles, pixels, .. } in expected {
        let _ = writeln!(text, "| {name} | {} | {} |", grouped(*triangles), grouped(*pixels));
    }
    text
}

/// The scenes of a board; nothing if their instructions are not counted.
fn scenes(board: &Board, rows: &[Row], expected: &[Expected]) -> String {
    let mut text = String::new();
    for Expected { name, triangles, pixels, .. } in expected {
        let of = |unit| figure(rows, board.name, name, unit);
        let Some(instructions) = of(Unit::Instructions) else { continue };
        let tenths = 10 * instructions / (*pixels).max(1);
        let _ = writeln!(
            text,
            "| {name} | {} | {}.{} | {} | {} |",
            grouped(instructions),
            grouped(tenths / 10),
            tenths % 10,
            grouped(instructions / (*triangles).max(1)),
            cell(of(Unit::Divides)),
        );
    }
    if text.is_empty() {
        return text;
    }
    format!(
        "| scene | instructions | per pixel | per triangle | divisions |\n|---|---|---|---|---|\n{text}\n"
    )
}

/// The programs of a board.
fn programs(board: &Board, rows: &[Row]) -> String {
    let mut text = "| program | code | constants | flash | stack |\n|---|---|---|---|---|\n".to_string();
    for name in WEIGHED {
        let of = |unit| figure(rows, board.name, name, unit);
        let (code, constants) = (of(Unit::Code), of(Unit::Constants));
        let flash = code.zip(constants).map(|(code, constants)| code + constants);
        let _ = writeln!(text, "| {name} | {} |", joined(&[code, constants, flash, of(Unit::Stack)]));
    }
    text
}

fn joined(cells: &[Option<u64>]) -> String {
    cells.iter().map(|number| cell(*number)).collect::<Vec<_>>().join(" | ")
}

/// A number, or a dash for one that is not told.
fn cell(number: Option<u64>) -> String {
    number.map_or_else(|| "–".to_string(), grouped)
}

/// The number with a comma after each group of three digits.
fn grouped(number: u64) -> String {
    if number < 1000 {
        return number.to_string();
    }
    format!("{},{:03}", grouped(number / 1000), number % 1000)
}

#[cfg(test)]
mod tests {
    use super::super::{frames, table};
    use super::*;

    #[test]
    fn the_page_divides_and_adds() {
        let expected = frames::expected("frame flat aa 2 300\n").unwrap();
        let rows = table::read(
            "board,name,unit,figure\nm0,flat,instructions,1234567\nm4f,flat,instructions,1\nm4f,flat,divides,0\n\
             m0,size-bands,code,1000\nm0,size-bands,constants,23\nm0,size-bands,statics,47000\nm0,size-bands,stack,1500\n",
        );
        let page = page(&rows.unwrap(), &expected);
        let has = |line: &str| assert!(page.lines().any(|found| found == line), "no `{line}` in:\n{page}");
        has("## `m0` and `m0plus`");
        has("| flat | 1,234,567 | 4,115.2 | 617,283 | – |");
        has("| flat | 1 | 0.0 | 0 | 0 |");
        has("| `m0` and `m0plus` | 47,000 | 1,500 | 48,500 | 1,000 | 23 |");
        has("| size-bands | 1,000 | 23 | 1,023 | 1,500 |");
        has("| size-flat | – | – | – | – |");
        has("| flat | 2 | 300 |");
        assert_eq!(page.matches("| scene |").count(), 3);
    }
}
