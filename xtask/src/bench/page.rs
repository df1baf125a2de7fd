//! The page of all that is tracked, and its plots: what the tables make.

use super::ratios::{FIRST, three_digits};
use super::{bars, chips, counts, frames, ratios, results};

/// The page.
pub(super) const PAGE: &str = "docs/benchmarks.md";

/// The boards of the page, and the scenes there: one of each kind.
const BOARDS: [&str; 6] = ["m0", "m3", "m4f", "m7", "m33", "rv32"];
const SCENES: [&str; 8] =
    ["flat", "gouraud", "textured", "mesh", "mesh-affine", "mesh-spans", "mesh-planes", "mesh-eighth"];

const HEADING: &str = "\
# Benchmarks: the numbers that are tracked

This page and its plots are made of the tables in [benches/results](../benches/results) and of the
[counts on cores](../tests/firmware/counts.csv). All of it is measured and written by

    cargo xtask bench                    # ten minutes; --raylib FOLDER for rlsw too
    cargo xtask bench counts             # instructions alone, a minute
    cargo xtask bench --check            # these against the table: more than 2 % above it is an error

[benches/README.md](../benches/README.md) has the scenes, the peers, and what is timed; [growth.md](growth.md) has times
against pixels and triangles. Each picture is held against rays in `f64` before its frame is timed or counted.

";

const RATIOS: &str = "\
## Beside other rasterizers

Least milliseconds of a frame on one thread, but for `two threads`; in brackets how many times as long as `Exact`; and
pixels that differ by more than 8/255 from rays in `f64`. All take turns in one run. Bars to the right of 1 are slower
than alberti.

![Times of 1280x720 as multiples of alberti's](pictures/benchmarks_1280x720.svg)

![Times of 320x240 as multiples of alberti's](pictures/benchmarks_320x240.svg)

";

const FRAMES: &str = "\
## Policies and ways

Medians of Criterion in milliseconds, each with the interval in which it is with a confidence of 95 %, and as a multiple
of the time of `Exact`. `two threads` is `Exact` by two; `Exact-without-slots` transforms vertices when triangles need
them; `Exact-by-bands` has depths for some rows; `App` is `Exact` by the kernels of the `alberti` command, whose
policies are chosen at run time. `Spans16` and `Affine` save divisions, which a desktop has to spare. These follow one
another, so that a busy neighbour shows; where both have a figure, that of those who take turns is the better one.

";

const COUNTS: &str = "\
## Instructions on a desktop

Instructions by valgrind, which are the same on every run: of frames of 320x240, in AVX2, and of parts alone, 4096 calls
of each; mip maps are those of 512x512 texels. With another compiler they differ a little.

| what | instructions |
|---|---:|
";

const CHIPS: &str = "\
## Instructions on chips

Millions of instructions for a frame of 320x240 on emulated cores; [firmware-counts.md](firmware-counts.md) has all
scenes, divisions, flash and RAM.

";

const GROWTH: &str = "\
## Growth

![Nanoseconds a pixel against pixels](pictures/growth_pixels.svg)

![Nanoseconds a triangle against triangles](pictures/growth_triangles.svg)

## Following them

Times of different machines or runs cannot be compared, so a change is measured beside what was before, on one machine:

    git stash; cargo bench -p alberti-benches --bench frames -- --save-baseline before
    git stash pop; cargo bench -p alberti-benches --bench frames -- --save-baseline after
    cargo install critcmp; critcmp before after

`cargo xtask bench` also writes `target/bench/metrics.json` in the Bencher Metric Format: `latency` in nanoseconds with
its interval, `ratio` to `Exact`, and `instructions` on the desktop and on boards. `bencher run --adapter json --file
target/bench/metrics.json` sends it to a server that draws them over time. A profile of each count is in
`target/bench/gungraun`, for `callgrind_annotate`.
";

/// The page and its plots, by their places.
pub(super) fn files() -> Result<Vec<(&'static str, String)>, String> {
    let peers = results::read(ratios::PLACE)?;
    let times = ratios::read(&peers)?;
    let timed = results::read(frames::PLACE)?;
    let mut page = HEADING.to_owned();
    page += RATIOS;
    page += &format!("{}.\n\n{}", results::machine(&peers), ratios::markdown(&peers)?);
    page += FRAMES;
    page += &format!("{}.\n\n{}", results::machine(&timed), of_policies(&frames::read(&timed)?));
    page += COUNTS;
    for counts::Count { name, instructions } in counts::read(&results::read(counts::PLACE)?)? {
        page += &format!("| {name} | {} |\n", grouped(instructions));
    }
    page.push('\n');
    page += CHIPS;
    page += &on_chips(&chips::read(&results::read(chips::PLACE)?)?);
    page += GROWTH;
    let plots = [
        ("docs/pictures/benchmarks_1280x720.svg", "1280x720"),
        ("docs/pictures/benchmarks_320x240.svg", "320x240"),
    ];
    let plots = plots.into_iter().map(|(place, size)| (place, bars::plot(&times, size)));
    Ok([(PAGE, page)].into_iter().chain(plots).collect())
}

/// A table for each size: policies across.
fn of_policies(frames: &[frames::Frame]) -> String {
    let mut text = String::new();
    let mut policies: Vec<&str> = frames.iter().map(|frame| &*frame.renderer).collect();
    policies.sort_by_key(|name| (*name != FIRST, *name));
    policies.dedup();
    policies.retain(|name| !PEERS.contains(name));
    let values = |of: fn(&frames::Frame) -> &str| {
        let mut values: Vec<&str> = frames.iter().map(of).collect();
        values.sort_unstable();
        values.dedup();
        values
    };
    for size in values(|frame| &frame.size) {
        text += &format!(
            "| scene, {size} | {} |\n|---|{}\n",
            policies.join(" | "),
            "---|".repeat(policies.len())
        );
        for scene in values(|frame| &frame.scene) {
            let of = |name: &str| {
                frames.iter().find(|f| (&*f.scene, &*f.size, &*f.renderer) == (scene, size, name))
            };
            let cell = |name: &&str| {
                let (Some(frame), Some(first)) = (of(name), of(FIRST)) else { return "-".to_owned() };
                let [low, high] = frame.interval.map(|nanoseconds| three_digits(nanoseconds / 1e6));
                let ratio = frame.median / first.median;
                let ratio = if *name == FIRST { String::new() } else { format!(", {ratio:.2}") };
                format!("{} ({low} to {high}){ratio}", three_digits(frame.median / 1e6))
            };
            let cells: Vec<_> = policies.iter().map(cell).collect();
            text += &format!("| {scene} | {} |\n", cells.join(" | "));
        }
        text.push('\n');
    }
    text
}

/// Those who are not alberti, in the benchmarks of frames.
const PEERS: [&str; 3] = ["euc", "retrofire", "retrofire-masked"];

fn on_chips(counts: &[chips::Count]) -> String {
    let mut text = format!("| scene | {} |\n|---|{}\n", BOARDS.join(" | "), "---:|".repeat(BOARDS.len()));
    for scene in SCENES {
        let cells = BOARDS.map(|board| {
            let count = counts.iter().find(|count| (&*count.board, &*count.scene) == (board, scene));
            count.map_or("-".into(), |count| three_digits(results::real(count.instructions) / 1e6))
        });
        text += &format!("| {scene} | {} |\n", cells.join(" | "));
    }
    text.push('\n');
    text
}

/// A number with commas.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_in_groups() {
        assert_eq!([0, 999, 1000, 1_234_567].map(grouped), ["0", "999", "1,000", "1,234,567"]);
    }

    #[test]
    fn policies_are_compared_with_the_exact_one() {
        let frame = |renderer: &str, median: f64| frames::Frame {
            scene: "mesh".into(),
            size: "8x8".into(),
            renderer: renderer.into(),
            median,
            interval: [median / 2.0, median],
        };
        let text = of_policies(&[frame("App", 3e6), frame("Exact", 2e6), frame("euc", 9e6)]);
        let right = "| scene, 8x8 | Exact | App |\n|---|---|---|\n\
            | mesh | 2.00 (1.00 to 2.00) | 3.00 (1.50 to 3.00), 1.50 |\n\n";
        assert_eq!(text, right);
    }

    /// The page is that of its tables: the check of instructions says so too, but only where there is valgrind.
    #[test]
    fn the_page_is_current() {
        for (place, text) in files().unwrap() {
            assert!(results::read(place).unwrap() == text, "{place}");
        }
    }
}
