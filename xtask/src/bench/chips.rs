//! Instructions on emulated cores, as `cargo xtask firmware` counts them.

use super::results::{number, rows};

/// The table.
pub(super) const PLACE: &str = "tests/firmware/counts.csv";

/// Instructions of a scene's frame on a board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Count {
    pub(super) board: String,
    pub(super) scene: String,
    pub(super) instructions: u64,
}

/// Reads the table, of which figures of other units are left out.
pub(super) fn read(text: &str) -> Result<Vec<Count>, String> {
    let mut counts = Vec::new();
    for (place, [board, scene, unit, figure]) in rows(PLACE, "board,name,unit,figure", text)? {
        if unit == "instructions" {
            let [board, scene] = [board, scene].map(str::to_owned);
            counts.push(Count { board, scene, instructions: number(&place, figure)? });
        }
    }
    Ok(counts)
}
