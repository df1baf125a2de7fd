//! The keys of a window, and what each does.

/// A place of a picture, from its middle to the right and upwards, in heights of the picture.
pub(super) type Place = [f64; 2];

/// The wish of a key or of the mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Action {
    /// A turn about the pivot: degrees to the right, and upwards.
    Turn([f64; 2]),
    /// A move across the view, in heights of the picture.
    Pan([f64; 2]),
    /// A factor of nearness to what is seen at a place of the picture, or else towards the pivot.
    Zoom(f64, Option<Place>),
    /// The camera of the beginning.
    Fit,
    /// A side of the model.
    View(&'static str),
    /// The next value of an option, or the one before.
    Cycle(&'static Cycle, bool),
    /// A motion that goes on, or stands.
    Play,
    /// So many frames of it, on or back.
    Step(i8),
    /// The picture in a file.
    Picture,
    /// The list of keys, shown or not.
    Help,
    /// All text, shown or not.
    Text,
    /// The end.
    Quit,
}

/// An option whose values a key goes through, from that of the command line on, which is one more if it is not among
/// them.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Cycle {
    key: char,
    pub(super) option: &'static str,
    values: &'static [&'static str],
    pub(super) keeps: Keeps,
}

/// Parts of a scene that stay as they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Keeps {
    /// Mip maps.
    pub(super) maps: bool,
    /// The shadow on the ground.
    pub(super) shadow: bool,
}

/// All of them, and all but the maps.
pub(super) const ALL: Keeps = Keeps { maps: true, shadow: true };
const SHADOW: Keeps = Keeps { maps: false, shadow: true };

/// The cycles, in the order of the list of keys.
pub(super) const CYCLES: [Cycle; 12] = [
    cycle('i', "--interpolation", &["exact", "plane", "spans:16", "bounded:0.0625", "affine"], ALL),
    cycle('f', "--filter", &["nearest", "bilinear", "trilinear", "anisotropic:4", "anisotropic:16"], SHADOW),
    cycle(
        'r',
        "--relief",
        &["bump", "parallax", "steep", "occlusion", "displacement"],
        Keeps { maps: false, shadow: false },
    ),
    // A ground is as far below a model as depths can tell.
    cycle('d', "--depth", &["f32", "f32-reversed", "u24", "u16"], Keeps { maps: true, shadow: false }),
    cycle('v', "--show", &["error", "lod", "depth-step", "overdraw", "triangles", "policy"], ALL),
    cycle('s', "--shading", &["lambert", "gouraud", "phong", "blinn", "unlit"], SHADOW),
    cycle('a', "--samples", &["1", "4", "16"], ALL),
    cycle('c', "--color", &["rgb565", "rgb666", "rgba8"], ALL),
    cycle('t', "--dither", &["bayer", "blue-noise", "none"], ALL),
    cycle('l', "--light-space", &["linear", "srgb"], SHADOW),
    cycle('g', "--ground", &["true", "false"], SHADOW),
    cycle('o', "--projection", &["parallel", "perspective"], ALL),
];

const fn cycle(key: char, option: &'static str, values: &'static [&'static str], keeps: Keeps) -> Cycle {
    Cycle { key, option, values, keeps }
}

impl Cycle {
    /// The value after the chosen one, of which `None` is that of the command line, which is `first`.
    pub(super) fn next(
        &self,
        chosen: Option<&str>,
        first: Option<&str>,
        forwards: bool,
    ) -> Option<&'static str> {
        let place = |value: &str| self.values.iter().position(|other| *other == value);
        let first = first.and_then(place);
        let own = self.values.len();
        let at = chosen.and_then(place).or(first).unwrap_or(own);
        let count = own + usize::from(first.is_none());
        let next = (at + if forwards { 1 } else { count - 1 }) % count;
        self.values.get(next).copied().filter(|_| first != Some(next))
    }
}

/// The degrees of a turn by a key, and the share of the picture's height of a move.
const STEP: [f64; 2] = [7.5, 0.05];

/// The frames of a motion that there are in a second.
pub(super) const FRAMES: f64 = 30.0;

/// The factor of a zoom by a key.
pub(super) const NEARER: f64 = 1.15;

/// The wish of a letter.
pub(super) fn of_letter(letter: &str, shift: bool) -> Option<Action> {
    let letter = letter.chars().next()?.to_ascii_lowercase();
    Some(match letter {
        '+' | '=' => Action::Zoom(NEARER, None),
        '-' | '_' => Action::Zoom(1.0 / NEARER, None),
        '0' => Action::Fit,
        '1' => Action::View("front"),
        '2' => Action::View("back"),
        '3' => Action::View("right"),
        '4' => Action::View("left"),
        '5' => Action::View("top"),
        '6' => Action::View("bottom"),
        '7' => Action::View("iso"),
        ' ' => Action::Play,
        ',' | '<' => Action::Step(-1),
        '.' | '>' => Action::Step(1),
        'p' => Action::Picture,
        'h' | '?' => Action::Help,
        'q' => Action::Quit,
        letter => Action::Cycle(CYCLES.iter().find(|cycle| cycle.key == letter)?, !shift),
    })
}

/// The wish of an arrow in this direction, to the right and upwards. The camera goes there.
pub(super) fn of_arrow([right, upwards]: [f64; 2], shift: bool) -> Action {
    if shift {
        Action::Pan([right * STEP[1], upwards * STEP[1]])
    } else {
        Action::Turn([right * STEP[0], upwards * STEP[0]])
    }
}

/// The list of keys.
pub(super) fn list() -> Vec<String> {
    let mut lines: Vec<String> = [
        "drag, arrows         turn",
        "right drag, shift    move across",
        "wheel                nearer to what is under the mouse, farther",
        "+ -                  nearer, farther",
        "0, Home              the first camera",
        "1 2 3 4 5 6 7        front back right left top bottom iso",
        "Space , .            plays what moves, a frame back, on",
    ]
    .map(str::to_owned)
    .to_vec();
    for Cycle { key, option, values, .. } in &CYCLES {
        lines.push(format!("{}  {:<18}{}", key.to_ascii_uppercase(), &option[2..], values.join(" ")));
    }
    lines.push("shift goes back through these".to_owned());
    lines.push("P  the picture in a file, its command on standard output".to_owned());
    lines.push("Tab  without text     H  this list     Q, Esc  the end".to_owned());
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycles_come_back_to_the_command_line() {
        for cycle in &CYCLES {
            for forwards in [true, false] {
                let all = |first: Option<&str>| {
                    let from = |value| cycle.next(value, first, forwards);
                    let values = std::iter::successors(from(None), |value| from(Some(value)));
                    // As many as would be too many.
                    let mut seen: Vec<_> = values.take(cycle.values.len() + 1).collect();
                    if !forwards {
                        seen.reverse();
                    }
                    seen
                };
                for first in [None, Some("of another kind")] {
                    assert_eq!(all(first), cycle.values, "{}", cycle.option);
                }
                // From one of them on, the others follow.
                for k in 0..cycle.values.len() {
                    let (before, after) = cycle.values.split_at(k);
                    assert_eq!(all(Some(after[0])), [&after[1..], before].concat(), "{}", cycle.option);
                }
            }
        }
    }

    #[test]
    fn each_letter_has_one_meaning() {
        let letters: Vec<char> =
            CYCLES.iter().map(|cycle| cycle.key).chain("+-01234567 ,.phq".chars()).collect();
        for (k, letter) in letters.iter().enumerate() {
            assert!(!letters[..k].contains(letter), "{letter}");
            let text = letter.to_string();
            assert!(of_letter(&text, false).is_some());
            assert_eq!(of_letter(&text.to_uppercase(), false), of_letter(&text, false));
        }
        assert_eq!(of_letter("z", false), None);
        // The list has them all.
        let list = list().join("\n");
        for cycle in &CYCLES {
            assert!(list.contains(&cycle.option[2..]), "{}", cycle.option);
        }
    }
}
