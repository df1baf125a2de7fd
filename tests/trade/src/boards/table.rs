//! The table of the boards' prices, as text that programs read, and its comparison with an older one.

use super::price::Price;
use super::scene_file::JUDGED;
use std::fmt::Write as _;

/// Its first line.
const HEADING: &str = "board,scene,policy,count,divides,stack";

/// The table: instructions of a frame, divisions and bytes of stack of the scenes of the trade, the latter of one that
/// is clipped and one that is not; with `code` for the scene, bytes of code.
pub fn csv(prices: &[Price]) -> String {
    let mut text = format!("{HEADING}\n");
    for Price { board, scene, policy, count, divides, stack } in prices {
        let scene = match scene {
            None => "code",
            Some(number) if *number < JUDGED.len() => JUDGED[*number],
            Some(_) => continue,
        };
        let stack = if *stack == 0 { String::new() } else { stack.to_string() };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{board},{scene},\"{policy}\",{count},{divides},{stack}");
    }
    text
}

/// What is worse in `found` than in the table that is committed, by more than a fiftieth; rows that are not there. Of
/// the table only boards and kinds of rows that were measured are compared. A line for each, with the row's name.
pub fn worse(found: &str, committed: &str) -> Vec<String> {
    let rows = |text: &str| text.lines().skip(1).filter_map(row).collect::<Vec<_>>();
    let (found, committed) = (rows(found), rows(committed));
    let measured = |name: &str| {
        let kind = |name: &str| {
            let mut words = name.split(',');
            (words.next().map(str::to_owned), words.next() == Some("code"))
        };
        found.iter().any(|(other, _)| kind(other) == kind(name))
    };
    let mut complaints = vec![];
    for (name, old) in committed.iter().filter(|(name, _)| measured(name)) {
        let Some((_, new)) = found.iter().find(|(other, _)| other == name) else {
            complaints.push(format!("{name}: it is in the table, and was not measured"));
            continue;
        };
        for ((what, before), after) in ["count", "divides", "stack"].iter().zip(old).zip(new) {
            if after * 50 > before * 51 {
                complaints.push(format!("{name}: {what} rose from {before} to {after}"));
            }
        }
    }
    for (name, _) in found.iter().filter(|(name, _)| committed.iter().all(|(old, _)| old != name)) {
        complaints.push(format!("{name}: it was measured, and is not in the table"));
    }
    complaints
}

/// A row's name and its numbers.
fn row(line: &str) -> Option<(String, [u64; 3])> {
    let (name, numbers) = line.split_once("\",")?;
    let number = |number: &str| if number.is_empty() { Some(0) } else { number.parse().ok() };
    let numbers: Vec<u64> = numbers.split(',').map(number).collect::<Option<_>>()?;
    Some((name.replace('"', ""), numbers.try_into().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_worse_is_named() {
        let old = "head\nm0,floor,\"a, b\",1000,50,8\nm0,code,\"a, b\",400,0,0\nm4f,floor,\"a\",10,1,8\n";
        let found = "head\nm0,floor,\"a, b\",1020,50,8\n";
        assert!(worse(found, old).is_empty());
        assert_eq!(
            worse(&found.replace("1020", "1021"), old),
            ["m0,floor,a, b: count rose from 1000 to 1021"]
        );
        assert_eq!(worse(&found.replace(",50,", ",52,"), old), ["m0,floor,a, b: divides rose from 50 to 52"]);
        assert_eq!(worse(&found.replace("a, b", "c"), old).len(), 2);
    }

    #[test]
    fn small_scenes_are_left_out() {
        let price =
            |scene| Price { board: "m0".into(), scene, policy: "a".into(), count: 7, divides: 2, stack: 0 };
        let text = csv(&[price(Some(1)), price(Some(JUDGED.len())), price(None)]);
        assert_eq!(text, format!("{HEADING}\nm0,floor,\"a\",7,2,\nm0,code,\"a\",7,2,\n"));
    }
}
