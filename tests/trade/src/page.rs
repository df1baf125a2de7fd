//! The page of the trade, for people: a chapter a family.

use crate::family::{Axis, Family};
use crate::scenes::SCENES;
use crate::summary::{Summary, summaries};
use crate::table::Line;
use std::fmt::Write as _;

/// The folder of plots and of the worst places, beside the page.
pub const PICTURES: &str = "pictures/trade";

/// What the figures were measured by.
#[derive(Clone, Copy, Debug)]
pub struct Made<'a> {
    /// The compiler, and the registers of the machine: instructions can be compared where these are the same.
    pub compiler: &'a str,
    /// The table of the boards, if they were asked.
    pub boards: Option<&'a str>,
}

/// Before the name of the compiler in the page.
const COMPILER: &str = "Instructions are those of ";

const HEADING: &str = "\
# The trade: what each approximation costs, and what it loses

Every approximation of this library is a policy with a name and a bound. This page says what each buys. One run draws
every policy of every family on the same scenes, and compares its pictures with those of rays in `f64`, which share no
code with the library. So read a family's paragraph first: it says what to pick. The tables say why.

    cargo xtask trade

* **instructions**: of a frame of 320x240 on x86-64, as multiples of the reference's, the first row; the geometric
  mean of the scenes. They repeat.
* **time**: of a frame of 640x480, which has more pixels a triangle, as a multiple of the reference's in the same run,
  in turns: the median of the scenes, and in brackets the least and the greatest. It does not repeat, and another
  machine has other times.
* **texels**: the error of texture coordinates against those of rays: of the 99.9 % of the pixels that are least off,
  the geometric mean of the scenes; and the worst pixel of any scene.
* **bytes**: that of the picture's channels, 0 to 255: of 99.9 % of the pixels, and of the worst; of the worst scene.
* **PSNR**: of the worst scene, in dB; more is better. **FLIP**: what somebody sees who flips between the picture and
  the right one, 0 to 1; the mean of the scenes, and the worst.
* **★**: no other policy of the family is as cheap and as right, and better in one of the two: the Pareto front of
  instructions and of the error that the plot shows. What differs by less than a hundredth is the same.

The scenes:

";

/// The page.
pub fn page(families: &[Family], lines: &[Line], made: Made<'_>) -> String {
    let mut text = HEADING.to_owned();
    text.push_str("| scene | what it is |\n|---|---|\n");
    for scene in SCENES.iter() {
        let _ = writeln!(text, "| {} | {} |", scene.name, scene.about);
    }
    for family in families {
        chapter(&mut text, family, lines);
    }
    if let Some(boards) = made.boards {
        let _ = write!(text, "{ON_CHIPS}{boards}");
    }
    let _ = write!(
        text,
        "{LAST}The run takes about eleven minutes on two cores, half of them for the boards.\n{COMPILER}{}.\n[trade.csv](trade.csv) has each policy on each scene. `cargo xtask \
         trade --check` measures errors and instructions\nagain, and fails, with the row's name, where one is more than \
         a fiftieth above the table; times are not compared.\n",
        made.compiler
    );
    text
}

/// The titles of the chapters after those of families.
const ON_CHIPS: &str = "\n## On chips\n\n";
const LAST: &str = "\n## How it was made\n\n";

/// A page with another chapter of the boards.
pub fn with_boards(page: &str, boards: &str) -> Option<String> {
    let (before, last) = page.split_once(LAST)?;
    let before = before.split_once(ON_CHIPS).map_or(before, |(before, _)| before);
    Some(format!("{before}{ON_CHIPS}{boards}{LAST}{last}"))
}

/// The compiler that a page names.
pub fn compiler(page: &str) -> Option<&str> {
    page.lines().find_map(|line| line.strip_prefix(COMPILER)?.strip_suffix('.'))
}

fn chapter(text: &mut String, family: &Family, lines: &[Line]) {
    let all = summaries(family, lines);
    let _ = writeln!(text, "\n## {}\n\n{}\n", family.title, family.advice);
    let Family { name, title, .. } = family;
    let _ = writeln!(text, "![{title}: error against cost]({PICTURES}/{name}.svg)\n");
    text.push_str(
        "| policy | ★ | instructions | time | texels | worst | bytes | worst | PSNR | FLIP |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for summary in &all {
        let _ = writeln!(text, "{}", row(summary));
    }
    by_scene(text, family, &all, lines);
    bounded(text, family, lines);
    let wrong: Vec<&Summary> = all.iter().filter(|summary| summary.flip[1] > SEEN).collect();
    if !wrong.is_empty() {
        let _ = write!(text, "\nThe worst place of each, on the left, beside the right picture:\n\n");
        text.push_str("| | |\n|---|---|\n");
        for pair in wrong.chunks(2) {
            let cell = |summary: &Summary| {
                let policy = &summary.policy;
                let scene = worst_scene(name, policy, lines);
                format!("{policy}, on {scene}<br>![{policy}]({PICTURES}/{})", picture(name, policy))
            };
            let cells: Vec<String> = pair.iter().map(|summary| cell(summary)).collect();
            let _ = writeln!(text, "| {} |", cells.join(" | "));
        }
    }
}

/// The scene on which a policy looks the worst.
fn worst_scene(family: &str, policy: &str, lines: &[Line]) -> &'static str {
    let own = lines.iter().filter(|line| line.family == family && line.policy == policy);
    let worst = own.max_by(|a, b| a.errors.picture.flip.total_cmp(&b.errors.picture.flip));
    worst.map_or("", |line| line.scene)
}

/// The errors that the plot shows, scene by scene, where there are several.
fn by_scene(text: &mut String, family: &Family, all: &[Summary], lines: &[Line]) {
    let lines: Vec<&Line> = lines.iter().filter(|line| line.family == family.name).collect();
    let mut scenes: Vec<&str> = lines.iter().map(|line| line.scene).collect();
    scenes.dedup();
    if scenes.len() < 2 || !differ(family, all) {
        return;
    }
    let what = match family.axis {
        Axis::Texels => "texels, of 99.9 % of the pixels",
        Axis::Flip => "FLIP",
    };
    let _ = writeln!(text, "\n| {what} | {} |", scenes.join(" | "));
    let _ = writeln!(text, "|---{}|", "|---".repeat(scenes.len()));
    for Summary { policy, .. } in all {
        let cells = scenes.iter().map(|scene| {
            let line = lines.iter().find(|line| line.scene == *scene && line.policy == *policy);
            line.map_or_else(String::new, |line| match family.axis {
                Axis::Texels => line.errors.texels.map_or_else(String::new, |texels| digits(texels.most)),
                Axis::Flip => digits(line.errors.picture.flip),
            })
        });
        let _ = writeln!(text, "| `{policy}` | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
}

/// The price of a budget, where it is the least and where it is the most, in a sentence.
fn bounded(text: &mut String, family: &Family, lines: &[Line]) {
    const POLICY: &str = "Lines::bounded(1/16)";
    let line = |scene: &str, policy: &str| {
        lines.iter().find(|line| (line.family, line.scene, &*line.policy) == (family.name, scene, policy))
    };
    let against = |scene: &str, other: &str| {
        let [own, other] = [line(scene, POLICY)?, line(scene, other)?];
        #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
        let instructions = own.instructions? as f64 / other.instructions? as f64;
        Some((instructions, own.time?.ratio[1] / other.time?.ratio[1]))
    };
    if let (Some((flat, flat_time)), Some((steep, steep_time))) =
        (against("near-flat", "Affine"), against("close-up", "Exact"))
    {
        let _ = write!(
            text,
            "\n`{POLICY}` takes {flat:.3} times the instructions of `Affine` on near-flat ({flat_time:.2} times its \
             time), and\n{steep:.3} times those of `Exact` on close-up, the steepest ({steep_time:.2}).\n"
        );
    }
}

/// FLIP from which on a policy's worst place is shown.
pub const SEEN: f64 = 1e-3;

/// The file of a policy's worst place.
pub fn picture(family: &str, policy: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let name: String = policy.chars().map(plain).collect();
    let parts: Vec<&str> = name.split('-').filter(|part| !part.is_empty()).collect();
    format!("{family}-{}.png", parts.join("-"))
}

/// Whether there are policies of different errors.
fn differ(family: &Family, summaries: &[Summary]) -> bool {
    let mut errors = summaries.iter().map(|summary| summary.error(family.axis));
    let first = errors.next().unwrap_or_default();
    errors.any(|error| (error - first).abs() > 1e-6)
}

fn row(summary: &Summary) -> String {
    let Summary { policy, instructions, time, texels, bytes, psnr, flip, front } = summary;
    let [texels_mean, texels_worst] = match texels {
        Some(texels) => texels.map(digits),
        None => ["".into(), "".into()],
    };
    format!(
        "| `{policy}` | {} | {} | {} | {texels_mean} | {texels_worst} | {} | {} | {} | {} ({}) |",
        if *front { "★" } else { "" },
        instructions.map_or_else(String::new, |ratio| format!("{ratio:.2}")),
        time.map_or_else(String::new, |[least, median, greatest]| {
            format!("{median:.2} ({least:.2} to {greatest:.2})")
        }),
        bytes[1],
        bytes[0],
        if psnr.is_finite() { format!("{psnr:.1}") } else { "∞".to_owned() },
        digits(flip[0]),
        digits(flip[1]),
    )
}

/// Two digits that count.
fn digits(number: f64) -> String {
    match number {
        0.0 => "0".to_owned(),
        x if x >= 10.0 => format!("{x:.0}"),
        x if x >= 1.0 => format!("{x:.1}"),
        x if x >= 0.1 => format!("{x:.2}"),
        x if x >= 0.01 => format!("{x:.3}"),
        x if x >= 0.001 => format!("{x:.4}"),
        x => format!("{x:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_compiler_is_found_again() {
        let page = page(&[], &[], Made { compiler: "rustc 1.95.0, AVX2", boards: None });
        assert_eq!(compiler(&page), Some("rustc 1.95.0, AVX2"));
    }

    #[test]
    fn the_chapter_of_the_boards_is_exchanged() {
        let made = |boards| page(&[], &[], Made { compiler: "rustc 1.95.0, AVX2", boards });
        assert_eq!(with_boards(&made(None), "new\n"), Some(made(Some("new\n"))));
        assert_eq!(with_boards(&made(Some("old\n")), "new\n"), Some(made(Some("new\n"))));
    }

    #[test]
    fn files_have_plain_names() {
        assert_eq!(picture("a", "Lines::bounded(1/16)"), "a-lines-bounded-1-16.png");
        assert_eq!(picture("light", "fragments, Lambert"), "light-fragments-lambert.png");
    }
}
