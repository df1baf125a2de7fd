//! What the programs print about their frames, the comparison, and the table.

/// A frame as the host draws it: `frame NAME HASH TRIANGLES PIXELS`.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Expected {
    name: String,
    /// As it is printed; it is only compared.
    hash: String,
    /// Submitted triangles.
    triangles: u64,
    /// Written pixels, each as often as it is written.
    pixels: u64,
}

/// A frame as a board draws it: `frame NAME HASH TICKS`.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Drawn {
    name: String,
    hash: String,
    /// Of the drawing alone: ticks as printed; the caller turns them into instructions.
    pub(super) cost: u64,
}

/// Reads what the host's program prints.
pub(super) fn expected(text: &str) -> Result<Vec<Expected>, String> {
    let frames = lines(text)?.into_iter().map(|(name, hash, numbers)| match numbers[..] {
        [triangles, pixels] => Ok(Expected { name, hash, triangles, pixels }),
        _ => Err(format!("the host's line of `{name}` has {} numbers, expected 2", numbers.len())),
    });
    let frames = frames.collect::<Result<Vec<_>, _>>()?;
    if frames.is_empty() { Err("the host drew no frames".into()) } else { Ok(frames) }
}

/// Reads what a board prints.
pub(super) fn drawn(text: &str) -> Result<Vec<Drawn>, String> {
    let frames = lines(text)?.into_iter().map(|(name, hash, numbers)| match numbers[..] {
        [cost] => Ok(Drawn { name, hash, cost }),
        _ => Err(format!("the line of `{name}` has {} numbers, expected 1", numbers.len())),
    });
    frames.collect()
}

/// The lines as name, hash and numbers.
fn lines(text: &str) -> Result<Vec<(String, String, Vec<u64>)>, String> {
    let read = |line: &str| {
        let mut words = line.split_whitespace();
        let (Some("frame"), Some(name), Some(hash)) = (words.next(), words.next(), words.next()) else {
            return None;
        };
        let numbers = words.map(|word| word.parse().ok()).collect::<Option<Vec<u64>>>()?;
        Some((name.to_string(), hash.to_string(), numbers))
    };
    text.lines().map(|line| read(line).ok_or_else(|| format!("found `{line}`, expected a frame"))).collect()
}

/// One line for each frame that a board draws otherwise than the host, or not at all.
pub(super) fn differences(board: &str, expected: &[Expected], drawn: &[Drawn]) -> Vec<String> {
    let mut lines = Vec::new();
    for Expected { name, hash, .. } in expected {
        match drawn.iter().find(|frame| frame.name == *name) {
            Some(frame) if frame.hash == *hash => {}
            Some(frame) => lines.push(format!(
                "board {board}, scene {name}: the frame's hash is {}, expected {hash} as on the host",
                frame.hash
            )),
            None => {
                lines.push(format!("board {board}, scene {name}: no frame, expected {hash} as on the host"));
            }
        }
    }
    let unknown = drawn.iter().filter(|frame| expected.iter().all(|known| known.name != frame.name));
    lines.extend(
        unknown.map(|frame| format!("board {board}, scene {}: the host has no such scene", frame.name)),
    );
    lines
}

/// One line for each scene that takes more instructions a written pixel than it may, in tenths.
pub(super) fn excesses(
    board: &str,
    expected: &[Expected],
    drawn: &[Drawn],
    limits: &[(&str, u64)],
) -> Vec<String> {
    let exceeds = |(name, limit): &(&str, u64)| {
        let pixels = expected.iter().find(|scene| scene.name == *name).map_or(1, |scene| scene.pixels.max(1));
        match drawn.iter().find(|frame| frame.name == *name) {
            Some(frame) if frame.cost * 10 <= limit * pixels => None,
            Some(frame) => Some(format!(
                "board {board}, scene {name}: {} instructions for {pixels} pixels, at most {}.{} each are expected",
                frame.cost,
                limit / 10,
                limit % 10
            )),
            None => Some(format!("board {board}: there is a limit for `{name}`, which is no scene")),
        }
    };
    limits.iter().filter_map(exceeds).collect()
}

/// One line for each scene that takes more than a hundredth more instructions than were written down.
pub(super) fn slower(board: &str, drawn: &[Drawn], counts: &[(&str, u64)]) -> Vec<String> {
    let found = |name: &str| drawn.iter().find(|frame| frame.name == name).map(|frame| frame.cost);
    counts
        .iter()
        .filter_map(|&(name, count)| dearer(board, name, "instructions", found(name), count))
        .collect()
}

/// A line if more than a hundredth more was found than was written down, or nothing.
pub(super) fn dearer(board: &str, name: &str, unit: &str, found: Option<u64>, count: u64) -> Option<String> {
    match found {
        Some(found) if found * 100 <= count * 101 => None,
        Some(found) => Some(format!(
            "board {board}, {name}: {found} {unit}, {count} and a hundredth more are expected at most"
        )),
        None => Some(format!("board {board}: there is a count for `{name}`, which is not there")),
    }
}

/// By how many instructions equal costs may seem to differ: a tick is a little more than one.
const TICKS: u64 = 3;

/// One line for each pair of scenes that do not take the same instructions or whose frames differ.
pub(super) fn unequal(board: &str, drawn: &[Drawn], pairs: &[[&str; 2]]) -> Vec<String> {
    let find = |name: &str| drawn.iter().find(|frame| frame.name == name);
    let differs = |pair: &[&str; 2]| match pair.map(find) {
        [Some(a), Some(b)] if a.hash == b.hash && a.cost.abs_diff(b.cost) <= TICKS => None,
        [Some(a), Some(b)] => Some(format!(
            "board {board}: {} takes {} instructions, {} {}; the same are expected, and the same frame",
            a.name, a.cost, b.name, b.cost
        )),
        _ => {
            Some(format!("board {board}: {} and {} are compared, one of which is no scene", pair[0], pair[1]))
        }
    };
    pairs.iter().filter_map(differs).collect()
}

/// The frames with their costs in instructions.
pub(super) fn table(expected: &[Expected], drawn: &[Drawn]) -> String {
    let mut text = format!(
        "    {:<28}{:>10}{:>17}{:>12}{:>15}\n",
        "scene", "bits", "instructions", "per pixel", "per triangle"
    );
    for scene in expected {
        let name = &scene.name;
        let Some(frame) = drawn.iter().find(|frame| frame.name == *name) else {
            text.push_str(&format!("    {name:<28}{:>10}\n", "MISSING"));
            continue;
        };
        let bits = if frame.hash == scene.hash { "equal" } else { "DIFFERENT" };
        let tenths = 10 * frame.cost / scene.pixels.max(1);
        text.push_str(&format!(
            "    {name:<28}{bits:>10}{:>17}{:>12}{:>15}\n",
            grouped(frame.cost),
            format!("{}.{}", grouped(tenths / 10), tenths % 10),
            grouped(frame.cost / scene.triangles.max(1)),
        ));
    }
    text
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
    use super::*;

    const HOST: &str = "frame flat aa 2 300\nframe mesh bb 4000 100\n";

    #[test]
    fn limits_are_kept_or_told() {
        let drawn = drawn("frame flat aa 1200\nframe mesh bb 401\n").unwrap();
        let told = |limits: &[(&str, u64)]| excesses("m0", &expected(HOST).unwrap(), &drawn, limits);
        assert!(told(&[("flat", 40), ("mesh", 41)]).is_empty());
        assert_eq!(
            told(&[("flat", 39), ("mesh", 40), ("none", 1)]),
            [
                "board m0, scene flat: 1200 instructions for 300 pixels, at most 3.9 each are expected",
                "board m0, scene mesh: 401 instructions for 100 pixels, at most 4.0 each are expected",
                "board m0: there is a limit for `none`, which is no scene",
            ]
        );
    }

    #[test]
    fn more_by_a_hundredth_is_told() {
        let drawn = drawn("frame flat aa 1010\nframe mesh bb 1011\n").unwrap();
        assert_eq!(slower("m0", &drawn, &[("flat", 1000)]), [""; 0]);
        assert_eq!(
            slower("m0", &drawn, &[("mesh", 1000), ("none", 1)]),
            [
                "board m0, mesh: 1011 instructions, 1000 and a hundredth more are expected at most",
                "board m0: there is a count for `none`, which is not there",
            ]
        );
    }

    fn compare(board: &str) -> Vec<String> {
        differences("m0", &expected(HOST).unwrap(), &drawn(board).unwrap())
    }

    #[test]
    fn equal_frames_pass_in_any_order() {
        assert_eq!(compare("frame mesh bb 7\nframe flat aa 8\n"), [""; 0]);
    }

    #[test]
    fn a_difference_names_board_scene_found_and_expected() {
        assert_eq!(
            compare("frame flat aa 8\nframe mesh cc 7\n"),
            ["board m0, scene mesh: the frame's hash is cc, expected bb as on the host"]
        );
    }

    #[test]
    fn pairs_that_differ_are_told() {
        let frames = drawn("frame a aa 8\nframe b aa 8\nframe c aa 80\nframe d bb 8\n").unwrap();
        assert_eq!(unequal("m0", &frames, &[["a", "b"]]), [""; 0]);
        assert_eq!(
            unequal("m0", &frames, &[["a", "c"]]),
            ["board m0: a takes 8 instructions, c 80; the same are expected, and the same frame"]
        );
        assert_eq!(unequal("m0", &frames, &[["a", "d"], ["a", "e"]]).len(), 2);
    }

    #[test]
    fn missing_and_unknown_frames_are_found() {
        assert_eq!(
            compare("frame flat aa 8\nframe new dd 7\n"),
            [
                "board m0, scene mesh: no frame, expected bb as on the host",
                "board m0, scene new: the host has no such scene"
            ]
        );
        assert_eq!(compare("").len(), 2);
    }

    #[test]
    fn lines_of_another_form_are_refused() {
        assert_eq!(drawn("hello\n"), Err("found `hello`, expected a frame".into()));
        assert!(drawn("frame flat aa x\n").is_err());
        assert_eq!(drawn("frame flat aa\n"), Err("the line of `flat` has 0 numbers, expected 1".into()));
        assert!(expected("frame flat aa 1\n").is_err());
        assert_eq!(expected(""), Err("the host drew no frames".into()));
    }

    #[test]
    fn the_table_divides() {
        let text = table(&expected(HOST).unwrap(), &drawn("frame flat aa 1234567\n").unwrap());
        let words: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(words[1], ["flat", "equal", "1,234,567", "4,115.2", "617,283"]);
        assert_eq!(words[2], ["mesh", "MISSING"]);
    }
}
