//! Times of a thing against how many there are: as a table, and as a plot with logarithmic axes.

use crate::digits;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Series over the same counts.
pub(crate) struct Plot {
    pub(crate) title: &'static str,
    /// The horizontal axis.
    pub(crate) across: &'static str,
    /// The series.
    pub(crate) names: Vec<&'static str>,
    /// The table's first cell, the count, and the seconds that all together take by each series; NaN where there is
    /// none.
    pub(crate) rows: Vec<(String, f64, Vec<f64>)>,
}

/// Columns and rows of a plot.
const SIZE: (u32, u32) = (760, 420);
/// Text and axes: as far from white as from black.
const GREY: RGBColor = RGBColor(128, 128, 128);
/// The series, each to be seen on either.
const COLORS: [RGBColor; 3] = [RGBColor(31, 136, 206), RGBColor(217, 106, 20), RGBColor(44, 160, 90)];

impl Plot {
    /// Milliseconds of a frame, and after them nanoseconds of each of the things that it consists of.
    pub(crate) fn markdown(&self, first: &str, thing: &str) -> String {
        let heads = self.names.iter().map(|name| format!(" {name}, ms | ns a {thing} |"));
        let mut text = format!("| {first} |{}\n", heads.collect::<String>());
        text += &format!("|---:|{}\n", "---:|".repeat(2 * self.names.len()));
        for (name, count, times) in &self.rows {
            text += &format!("| {name} |");
            for time in times {
                text += &if time.is_nan() {
                    " - | - |".to_owned()
                } else {
                    format!(" {} | {} |", digits(time * 1e3), digits(time * 1e9 / count))
                };
            }
            text.push('\n');
        }
        text
    }

    /// The least and the greatest time of a thing where there are at least so many.
    pub(crate) fn spread(&self, thing: &str, least: f64) -> String {
        let many: Vec<_> = self.rows.iter().filter(|(_, count, _)| *count >= least).collect();
        let from = many.first().map_or("", |(name, ..)| name);
        let spreads = self.names.iter().enumerate().map(|(i, name)| {
            let times = many.iter().map(|(_, count, times)| times[i] * 1e9 / count);
            let (low, high) = times.fold((f64::INFINITY, 0.0_f64), |(l, h), time| (l.min(time), h.max(time)));
            format!("* {name}: {} to {}\n", digits(low), digits(high))
        });
        format!("Nanoseconds of a {thing} from {from} on:\n\n{}", spreads.collect::<String>())
    }

    /// Writes the plot, without a background: for light pages and dark ones.
    pub(crate) fn draw(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let series: Vec<Vec<(f64, f64)>> = (0..self.names.len())
            .map(|i| {
                let points = self.rows.iter().map(|(_, count, times)| (*count, times[i] * 1e9 / count));
                points.filter(|(_, time)| !time.is_nan()).collect()
            })
            .collect();
        let bounds = |axis: fn(&(f64, f64)) -> f64, room: f64| {
            let all = series.iter().flatten().map(axis);
            let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
            low / room..high * room
        };
        let (across, up) = (bounds(|point| point.0, 1.3), bounds(|point| point.1, 1.6));

        let root = SVGBackend::new(path, SIZE).into_drawing_area();
        let text = |size: i32| ("sans-serif", size).into_font().color(&GREY);
        let mut chart = ChartBuilder::on(&root)
            .caption(format!("{}, ns", self.title), text(22))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(56)
            .build_cartesian_2d(across.log_scale(), up.log_scale())?;
        chart
            .configure_mesh()
            .axis_style(GREY)
            .bold_line_style(GREY.mix(0.35))
            .light_line_style(TRANSPARENT)
            .label_style(text(18))
            .axis_desc_style(text(18))
            .x_desc(self.across)
            .x_label_formatter(&|x| count(*x))
            .y_label_formatter(&|y| digits(*y))
            .draw()?;
        for ((points, name), color) in series.into_iter().zip(&self.names).zip(COLORS) {
            let line = LineSeries::new(points, color.stroke_width(2)).point_size(3);
            chart
                .draw_series(line)?
                .label(*name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .label_font(text(18))
            .border_style(TRANSPARENT)
            .draw()?;
        root.present()?;
        Ok(())
    }
}

/// A power of ten, or what lies between two.
fn count(number: f64) -> String {
    let power = number.log10();
    if (power - power.round()).abs() < 1e-9 { format!("10^{power:.0}") } else { digits(number) }
}
