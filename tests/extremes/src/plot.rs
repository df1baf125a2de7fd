//! Plots of an axis: errors, and shares of the bounds, side by side over the points.

use crate::axis::Axis;
use crate::measured::Measured;
use crate::page::{digits, series};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Columns and rows of the two panels, and the rows of a line of the legend.
const SIZE: (u32, u32) = (960, 400);
const LINE: u32 = 24;
/// Entries of a line of the legend.
const ENTRIES: usize = 3;
/// Text and axes: as far from white as from black.
const GREY: RGBColor = RGBColor(128, 128, 128);
/// The policies, each to be seen on either.
const COLORS: [RGBColor; 8] = [
    RGBColor(31, 136, 206),
    RGBColor(217, 106, 20),
    RGBColor(44, 160, 90),
    RGBColor(206, 62, 74),
    RGBColor(148, 103, 205),
    RGBColor(150, 130, 30),
    RGBColor(214, 92, 170),
    RGBColor(30, 160, 165),
];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Writes the plot of an axis, without a background: for light pages and dark ones.
///
/// # Errors
/// What the file system says.
pub fn draw(axis: &Axis, rows: &[Measured], path: &Path) -> Result<(), Box<dyn Error>> {
    let lines = axis.series.len().div_ceil(ENTRIES) as u32;
    let root = SVGBackend::new(path, (SIZE.0, SIZE.1 + LINE * lines + 8)).into_drawing_area();
    let (panels, legend) = root.split_vertically(SIZE.1);
    let halves = panels.split_evenly((1, 2));
    errors(axis, rows, &halves[0])?;
    shares(axis, rows, &halves[1])?;
    for (i, series) in axis.series.iter().enumerate() {
        let (x, y) = (60 + (i % ENTRIES) as i32 * 300, 12 + (i / ENTRIES) as i32 * LINE as i32);
        let style = style(i);
        legend.draw(&PathElement::new([(x, y), (x + 26, y)], style))?;
        mark(i, (x + 13, y), &legend)?;
        legend.draw(&Text::new(series.policy.clone(), (x + 34, y - 8), text(16)))?;
    }
    root.present()?;
    Ok(())
}

fn text(size: i32) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&GREY)
}

fn style(i: usize) -> ShapeStyle {
    COLORS[i % COLORS.len()].stroke_width(2)
}

/// The mark of a policy: filled, and hollow where colours come again.
fn mark(i: usize, at: (i32, i32), area: &Area<'_>) -> Result<(), Box<dyn Error>> {
    let color = COLORS[i % COLORS.len()];
    let style = if i < COLORS.len() { color.filled() } else { color.stroke_width(1) };
    area.draw(&Circle::new(at, 4, style))?;
    Ok(())
}

/// The greatest errors, on a logarithmic scale.
fn errors(axis: &Axis, rows: &[Measured], area: &Area<'_>) -> Result<(), Box<dyn Error>> {
    let all = rows.iter().filter(|row| row.samples > 0).map(|row| row.error.error);
    let seen = all.filter(|error| *error > 0.0 && error.is_finite());
    let (least, most) = seen.fold((axis.limit.0, axis.limit.0), |(l, m), e| (l.min(e), m.max(e)));
    let values = |row: &Measured| (row.error.error > 0.0).then_some(row.error.error);
    let caption = format!("{}, {}", "Greatest error", axis.unit);
    let room = least / 3.0..most * 3.0;
    let mut chart = ChartBuilder::on(area)
        .caption(caption, text(20))
        .margin(10)
        .margin_right(18)
        .x_label_area_size(44)
        .y_label_area_size(58)
        .build_cartesian_2d(range(axis), room.log_scale())?;
    chart
        .configure_mesh()
        .axis_style(GREY)
        .bold_line_style(GREY.mix(0.3))
        .light_line_style(TRANSPARENT)
        .label_style(text(15))
        .axis_desc_style(text(16))
        .x_desc(axis.parameter)
        .x_labels(axis.points.len().min(8))
        .x_label_formatter(&|x| label(axis, *x))
        .y_label_formatter(&|y| digits(*y))
        .draw()?;
    let [left, right] = ends(axis);
    chart.draw_series(DashedLineSeries::new(
        [(left, axis.limit.0), (right, axis.limit.0)],
        6,
        4,
        GREY.into(),
    ))?;
    for (i, (_, rows)) in series(axis, rows).enumerate() {
        for run in runs(rows, values) {
            let color = COLORS[i % COLORS.len()];
            chart.draw_series(LineSeries::new(run.iter().copied(), style(i)))?;
            let filled = if i < COLORS.len() { color.filled() } else { color.stroke_width(1) };
            chart.draw_series(run.iter().map(|&point| Circle::new(point, 3, filled)))?;
        }
    }
    Ok(())
}

/// The greatest shares of the bounds.
fn shares(axis: &Axis, rows: &[Measured], area: &Area<'_>) -> Result<(), Box<dyn Error>> {
    let values = |row: &Measured| (!row.is_unbounded()).then_some(row.share.figure.min(1.2));
    let mut chart = ChartBuilder::on(area)
        .caption("Greatest share of the bound", text(20))
        .margin(10)
        .margin_right(18)
        .x_label_area_size(44)
        .y_label_area_size(46)
        .build_cartesian_2d(range(axis), 0.0..1.05)?;
    chart
        .configure_mesh()
        .axis_style(GREY)
        .bold_line_style(GREY.mix(0.3))
        .light_line_style(TRANSPARENT)
        .label_style(text(15))
        .axis_desc_style(text(16))
        .x_desc(axis.parameter)
        .x_labels(axis.points.len().min(8))
        .y_labels(6)
        .x_label_formatter(&|x| label(axis, *x))
        .y_label_formatter(&|y| format!("{y:.1}"))
        .draw()?;
    let [left, right] = ends(axis);
    chart.draw_series(DashedLineSeries::new([(left, 1.0), (right, 1.0)], 6, 4, GREY.into()))?;
    for (i, (_, rows)) in series(axis, rows).enumerate() {
        for run in runs(rows, values) {
            let color = COLORS[i % COLORS.len()];
            chart.draw_series(LineSeries::new(run.iter().copied(), style(i)))?;
            let filled = if i < COLORS.len() { color.filled() } else { color.stroke_width(1) };
            chart.draw_series(run.iter().map(|&point| Circle::new(point, 3, filled)))?;
        }
    }
    Ok(())
}

/// Neighbouring points that have a value.
fn runs(rows: &[Measured], value: impl Fn(&Measured) -> Option<f64>) -> Vec<Vec<(f64, f64)>> {
    let mut runs = vec![Vec::new()];
    for (i, row) in rows.iter().enumerate() {
        match value(row).filter(|value| row.samples > 0 && value.is_finite()) {
            Some(value) => runs.last_mut().expect("never empty").push((i as f64, value)),
            None => runs.push(Vec::new()),
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

/// Points are as far apart as their neighbours, whatever their values.
fn ends(axis: &Axis) -> [f64; 2] {
    [-0.3, axis.points.len() as f64 - 0.7]
}

fn range(axis: &Axis) -> std::ops::Range<f64> {
    let [left, right] = ends(axis);
    left..right
}

fn label(axis: &Axis, x: f64) -> String {
    let whole = (x - x.round()).abs() < 1e-6 && x > -0.5;
    let point = whole.then(|| axis.points.get(x.round() as usize)).flatten();
    point.map_or(String::new(), |(_, name)| name.clone())
}
