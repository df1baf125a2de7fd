//! The plot of a family: error against cost, with the front. Its colours are readable on white and on black.

use crate::family::{Axis, Family};
use crate::summary::Summary;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Text and lines: as far from white as from black.
const INK: RGBColor = RGBColor(0x80, 0x86, 0x8f);
/// What nothing beats.
const FRONT: RGBColor = RGBColor(0xd9, 0x7a, 0x1f);
/// What something beats.
const BEHIND: RGBColor = RGBColor(0x4a, 0x90, 0xc2);
/// No error at all is drawn at so much.
const NOTHING: [f64; 2] = [1e-5, 1e-4];

/// Draws the plot into a file.
///
/// # Errors
/// The file cannot be written.
pub fn draw(family: &Family, summaries: &[Summary], path: &Path) -> Result<(), Box<dyn Error>> {
    let (name, least) = match family.axis {
        Axis::Texels => ("error, texels (99.9 % of pixels, mean of scenes)", NOTHING[0]),
        Axis::Flip => ("error, mean FLIP of the scenes", NOTHING[1]),
    };
    let point = |summary: &Summary| (summary.cost(), summary.error(family.axis).max(least));
    let points: Vec<(f64, f64)> = summaries.iter().map(point).collect();
    // Room for labels, of which more are above a point than below.
    let range = |of: fn(&(f64, f64)) -> f64, [below, above]: [f64; 2]| {
        let [low, high] = points
            .iter()
            .map(of)
            .fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], x| [low.min(x), high.max(x)]);
        low / below..high * above
    };
    let root = SVGBackend::new(path, (760, 460)).into_drawing_area();
    let text = |size| ("sans-serif", size).into_font().color(&INK);
    let mut chart = ChartBuilder::on(&root)
        .margin(12)
        .caption(family.title, text(20))
        .x_label_area_size(44)
        .y_label_area_size(74)
        .build_cartesian_2d(
            range(|p| p.0, [1.25, 1.25]).log_scale(),
            range(|p| p.1, [5.0, 2.0]).log_scale(),
        )?;
    chart
        .configure_mesh()
        .bold_line_style(INK.mix(0.35))
        .light_line_style(TRANSPARENT)
        .axis_style(INK)
        .label_style(text(13))
        .x_labels(12)
        .x_desc(if summaries.iter().all(|summary| summary.instructions.is_some()) {
            "instructions of 320x240, multiples of the reference"
        } else {
            "time, multiples of the reference"
        })
        .y_desc(name)
        .x_label_formatter(&|x| if is_round(*x) { format!("{x:.2}") } else { String::new() })
        .y_label_formatter(&|y| if *y <= least { "none".to_owned() } else { format!("{y:.0e}") })
        .draw()?;
    let mut on_front: Vec<(f64, f64)> =
        summaries.iter().zip(&points).filter(|(summary, _)| summary.front).map(|(_, point)| *point).collect();
    on_front.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart.draw_series(LineSeries::new(on_front, FRONT.stroke_width(2)))?;
    let mut labels: Vec<(i32, i32)> = vec![];
    for (summary, &(x, y)) in summaries.iter().zip(&points) {
        let color = if summary.front { FRONT } else { BEHIND };
        chart.draw_series([Circle::new((x, y), 5, color.filled())])?;
        let at = chart.backend_coord(&(x, y));
        let place = label(at, &summary.policy, &mut labels);
        let style = text(12).color(&color);
        chart.draw_series([EmptyElement::at((x, y)) + Text::new(summary.policy.clone(), place, style)])?;
    }
    root.present()?;
    Ok(())
}

/// Whether a number is 1, 2 or 5 times a power of ten: those of a logarithmic axis that have room beside each other.
fn is_round(x: f64) -> bool {
    let mantissa = x / 10_f64.powf((x.log10() + 1e-9).floor());
    [1.0, 2.0, 5.0].iter().any(|round| (mantissa / round - 1.0).abs() < 1e-3)
}

/// The place of a label from its point: on the right, or on the left where the picture ends, and below labels that are
/// there already.
fn label(at: (i32, i32), policy: &str, labels: &mut Vec<(i32, i32)>) -> (i32, i32) {
    const HEIGHT: i32 = 13;
    let width = 7 * i32::try_from(policy.len()).unwrap_or(0);
    let dx = if at.0 + width > 740 { -width - 8 } else { 8 };
    let mut dy = -14;
    while labels.iter().any(|(x, y)| (x - at.0 - dx).abs() < 150 && (y - at.1 - dy).abs() < HEIGHT) {
        dy += HEIGHT;
    }
    labels.push((at.0 + dx, at.1 + dy));
    (dx, dy)
}
