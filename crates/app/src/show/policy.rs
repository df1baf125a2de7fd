//! The picture of the divisions: runs of straight lines in shades that alternate.

use super::legend::{Legend, Number, Step, paint};
use super::{Of, nothing};
use crate::colormap::{luma, viridis};
use crate::error::Error;
use crate::options::{Arithmetic, Interpolation};
use crate::probe::{Run, Seen, probe};
use crate::render::render;
use crate::scene::Image;

/// The classes of runs by their columns: 1, 2, up to 4, 8, ... 64.
const CLASSES: u8 = 7;
/// The colour of triangles without a division.
const UNDIVIDED: [u8; 3] = [0xb4; 3];
/// The darker of two shades.
const DARKER: f32 = 0.7;
/// The share of a run's colour; the rest is the picture's grey.
const TINT: f32 = 0.65;

/// A run: its class, and which of the two shades it has.
struct Shade {
    class: usize,
    dark: bool,
}

impl Shade {
    fn of(seen: &Seen, column: u32, divided: bool) -> Self {
        match seen.run {
            None => Self { class: 0, dark: column & 1 != 0 },
            Some(Run::Columns { start, length }) if divided => {
                // Runs lie at multiples of a power of two; ends of rows cut them. Those of one length alternate.
                let cell = (start ^ (start + length - 1)).checked_ilog2().map_or(0, |log| log + 1);
                let class = (length.max(1) - 1).checked_ilog2().map_or(0, |log| log + 1);
                Self { class: class as usize, dark: start >> cell & 1 != 0 }
            }
            Some(_) => Self { class: CLASSES.into(), dark: seen.triangle & 1 != 0 },
        }
    }
}

/// The runs of straight lines, over the picture.
pub(super) fn policy(
    (model, camera, options): Of<'_>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(Image, Legend), Error> {
    let picture = render(model, camera, options, progress)?.image.texels;
    let probes = probe(model, camera, options)?;
    let tint = |class: u8| viridis(1.0 - f32::from(class) / f32::from(CLASSES - 1));
    let policies = options.policies;
    let divided = policies.interpolation != Interpolation::Affine;
    let mut steps = vec![nothing()];
    steps.extend((0..CLASSES).map(|class| {
        let meaning = match class {
            0 => "1 column, a division each".to_owned(),
            1 => "2 columns".to_owned(),
            class => format!("{} to {} columns", (1 << (class - 1)) + 1, 1 << class),
        };
        Step::new(tint(class), meaning)
    }));
    steps.push(Step::new(UNDIVIDED, "triangle without a division in it"));
    let arithmetic = match policies.arithmetic {
        Arithmetic::Float => "float",
        Arithmetic::Fixed => "fixed",
    };
    let title = format!(
        "policy: columns between two divisions by {} in {arithmetic}; neighbours in two shades, over the picture",
        policies.interpolation
    );
    let width = options.width as usize;
    let mut runs = 0.0;
    let (image, mut legend) = paint(options, [&title, "columns of a pixel's run"], steps, |index| {
        let Some(seen) = probes.seen(index) else { return Number::none(0) };
        let column = u32::try_from(index % width).unwrap_or(0);
        let Shade { class, dark } = Shade::of(&seen, column, divided);
        let [r, g, b, _] = picture[index];
        let (grey, factor) = (luma([r, g, b]), if dark { DARKER } else { 1.0 });
        let full = u8::try_from(class).ok().filter(|class| *class < CLASSES).map_or(UNDIVIDED, tint);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 255")]
        let color = full.map(|c| ((grey + (f32::from(c) - grey) * TINT) * factor) as u8);
        let length = match seen.run {
            Some(Run::Columns { length, .. }) if divided => length,
            Some(_) => return Number { color: Some(color), ..Number::none(1 + class) },
            None => 1,
        };
        runs += 1.0 / f64::from(length);
        #[expect(clippy::cast_precision_loss, reason = "at most 64")]
        let value = length as f32;
        Number { color: Some(color), ..Number::new(1 + class, value) }
    })?;
    let (count, _) = legend.numbers;
    if count > 0 {
        #[expect(clippy::cast_precision_loss, reason = "for a legend")]
        let apart = count as f64 / runs;
        legend.notes.push(format!("a division for every {apart:.2} pixels of these"));
    }
    Ok((image, legend))
}
