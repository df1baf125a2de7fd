//! A false-colour picture with its legend: the meaning of each colour, and the share of the picture that has it.

use crate::error::{Error, number};
use crate::options::RenderOptions;
use crate::render::buffer;
use crate::scene::Image;
use std::fmt::Write as _;

/// Colours with their meanings, and the numbers of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// The quantity, and its unit.
    pub title: String,
    /// In rising order.
    pub steps: Vec<Step>,
    /// The name of each number: a quantity of something.
    pub counted: String,
    /// The count of numbers; and the least, the median and the greatest.
    pub numbers: (usize, [f32; 3]),
    /// Lines after these.
    pub notes: Vec<String>,
}

/// A colour of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The colour, or none if it is not a single one.
    pub color: Option<[u8; 3]>,
    /// The meaning.
    pub meaning: String,
    /// The pixels that have it.
    pub pixels: u64,
}

impl Step {
    /// A step that no pixel has.
    pub(super) fn new(color: [u8; 3], meaning: impl Into<String>) -> Self {
        Self { color: Some(color), meaning: meaning.into(), pixels: 0 }
    }

    /// The same without a colour of its own.
    pub(super) fn colorless(meaning: impl Into<String>) -> Self {
        Self { color: None, meaning: meaning.into(), pixels: 0 }
    }
}

/// The number that is shown of a pixel.
pub(super) struct Number {
    /// The index of its step.
    pub(super) step: usize,
    /// The colour, if it is not the step's.
    pub(super) color: Option<[u8; 3]>,
    /// None for pixels on which nothing is drawn.
    pub(super) value: Option<f32>,
}

impl Number {
    /// With the colour of a step.
    pub(super) fn new(step: usize, value: f32) -> Self {
        Self { step, color: None, value: Some(value) }
    }

    /// A step for pixels that have no number.
    pub(super) fn none(step: usize) -> Self {
        Self { step, color: None, value: None }
    }
}

/// Paints each pixel's number, and counts them into a legend.
pub(super) fn paint(
    options: &RenderOptions,
    [title, counted]: [&str; 2],
    mut steps: Vec<Step>,
    mut of: impl FnMut(usize) -> Number,
) -> Result<(Image, Legend), Error> {
    let (width, height) = (options.width, options.height);
    let mut texels = buffer(options, [0, 0, 0, 255])?;
    let mut values: Vec<f32> = buffer(options, 0.0)?;
    values.clear();
    for (index, texel) in texels.iter_mut().enumerate() {
        let Number { step, color, value } = of(index);
        values.extend(value);
        let Some(step) = steps.get_mut(step) else { continue };
        step.pixels += 1;
        let [r, g, b] = color.or(step.color).unwrap_or_default();
        *texel = [r, g, b, 255];
    }
    let numbers = (values.len(), three(&mut values));
    let [title, counted] = [title, counted].map(str::to_owned);
    Ok((Image { width, height, texels }, Legend { title, steps, counted, numbers, notes: Vec::new() }))
}

/// The least, the median (the lower of two) and the greatest.
pub(super) fn three(values: &mut [f32]) -> [f32; 3] {
    values.sort_unstable_by(f32::total_cmp);
    let at = |index: usize| values.get(index).copied().unwrap_or_default();
    let last = values.len().saturating_sub(1);
    [at(0), at(last / 2), at(last)]
}

/// A number in three significant digits.
pub(super) fn short(x: f32) -> String {
    number(format!("{x:.2e}").parse().unwrap_or(x))
}

impl Legend {
    /// Lines, of the steps that the picture has; with patches of colour for terminals that show them.
    #[must_use]
    pub fn text(&self, patches: bool) -> String {
        let mut text = format!("{}\n", self.title);
        let total: u64 = self.steps.iter().map(|step| step.pixels).sum();
        let seen = || self.steps.iter().filter(|step| step.pixels > 0);
        let wide = seen().map(|step| step.meaning.chars().count()).max().unwrap_or(0);
        for Step { color, meaning, pixels } in seen() {
            let color = match color {
                Some([r, g, b]) if patches => {
                    format!("\x1b[48;2;{r};{g};{b}m    \x1b[0m {r:02x}{g:02x}{b:02x}")
                }
                Some([r, g, b]) => format!("{r:02x}{g:02x}{b:02x}"),
                None if patches => "           ".to_owned(),
                None => "      ".to_owned(),
            };
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {color}  {meaning:<wide$}  {:>7}", percent(*pixels, total));
        }
        let (count, [least, median, greatest]) = self.numbers;
        if count > 0 {
            let [least, median, greatest] = [least, median, greatest].map(short);
            let numbers = format!("least {least}, median {median}, greatest {greatest}, of {count}");
            let _ = writeln!(text, "  {}: {numbers}", self.counted);
        }
        for note in &self.notes {
            let _ = writeln!(text, "  {note}");
        }
        text
    }
}

/// A share in percent: only nothing is 0, and only all is 100.
#[expect(clippy::cast_precision_loss, reason = "two digits are shown")]
fn percent(part: u64, of: u64) -> String {
    let share = 100.0 * part as f64 / of.max(1) as f64;
    match share {
        _ if part == of => "100 %".to_owned(),
        share if share < 0.01 => "<0.01 %".to_owned(),
        share => format!("{:.2} %", share.min(99.99)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_do_not_hide_single_pixels() {
        let all = [(1, 1), (1, 3), (1, 1_000_000), (999_999, 1_000_000)].map(|(part, of)| percent(part, of));
        assert_eq!(all, ["100 %", "33.33 %", "<0.01 %", "99.99 %"]);
    }

    #[test]
    fn the_three_numbers_are_those_of_the_sorted_ones() {
        assert_eq!(three(&mut [3.0, -1.0, 2.0, 9.0]), [-1.0, 2.0, 9.0]);
        assert_eq!(three(&mut [3.0, -1.0, 2.0]), [-1.0, 2.0, 3.0]);
        assert_eq!(three(&mut []), [0.0; 3]);
    }

    #[test]
    fn only_what_is_there_is_listed() {
        let step = |color, meaning: &str, pixels| Step { color, meaning: meaning.to_owned(), pixels };
        let steps = vec![step(Some([1, 2, 255]), "one", 3), step(None, "two", 0), step(None, "three", 1)];
        let numbers = (4, [0.0, 0.012_345, 1e-7]);
        let legend =
            Legend { title: "T".into(), steps, counted: "x of y".into(), numbers, notes: vec!["N".into()] };
        let expected = "T\n  0102ff  one    75.00 %\n          three  25.00 %\n  \
                        x of y: least 0, median 0.0123, greatest 1e-7, of 4\n  N\n";
        assert_eq!(legend.text(false), expected);
        assert!(legend.text(true).contains("\x1b[48;2;1;2;255m    \x1b[0m 0102ff  one"));
    }
}
