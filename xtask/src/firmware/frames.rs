//! The lines that the programs print about their frames, and the comparison of these.

/// A frame as the host draws it: `frame NAME HASH TRIANGLES PIXELS`.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Expected {
    pub(super) name: String,
    /// As it is printed; it is only compared.
    hash: String,
    /// Submitted triangles.
    pub(super) triangles: u64,
    /// Written pixels, each as often as it is written.
    pub(super) pixels: u64,
}

/// A frame as a board draws it: `frame NAME HASH TICKS`.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Drawn {
    pub(super) name: String,
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

/// By how many instructions equal costs may seem to differ: a tick is up to one and a half.
const TICKS: u64 = 4;

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

#[cfg(test)]
mod tests {
    use super::*;

    const HOST: &str = "frame flat aa 2 300\nframe mesh bb 4000 100\n";

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
}
