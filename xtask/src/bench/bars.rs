//! A plot of ratios: a bar for each renderer of each scene, on a logarithmic axis, as SVG.

use super::ratios::{FIRST, Time, all, of};
use super::results::real;

/// The room for names, the axis, and figures, in pixels.
const NAMES: f64 = 130.0;
const AXIS: f64 = 430.0;
const FIGURES: f64 = 50.0;

/// The height of a bar, and of what is between scenes.
const BAR: f64 = 13.0;
const GAP: f64 = 12.0;

/// The ends of the axis.
const ENDS: [f64; 2] = [0.5, 20.0];
const TICKS: [f64; 6] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0];

/// Colours that people with any sight tell apart, after Okabe and Ito.
const COLORS: [&str; 7] = ["#0072b2", "#e69f00", "#d55e00", "#cc79a7", "#009e73", "#56b4e9", "#888888"];

/// The place of a ratio on the axis; of one beyond, its end.
fn place(ratio: f64) -> f64 {
    let [low, high] = ENDS.map(f64::ln);
    NAMES + AXIS * ((ratio.ln() - low) / (high - low)).clamp(0.0, 1.0)
}

/// The plot of one size.
pub(super) fn plot(times: &[Time], size: &str) -> String {
    let of_size: Vec<_> = times.iter().filter(|time| time.size == size).cloned().collect();
    let others: Vec<_> =
        all(&of_size, |time| &time.renderer).into_iter().filter(|&name| name != FIRST).collect();
    let mut bars = String::new();
    let mut y = 40.0;
    let text = |x: f64, y: f64, anchor: &str, words: &str| {
        format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>\n")
    };
    for scene in all(&of_size, |time| &time.scene) {
        bars += &text(NAMES - 8.0, y + BAR - 2.0, "end", scene);
        for (name, color) in others.iter().zip(COLORS.iter().cycle()) {
            let Some((_, ratio)) = of(&of_size, size, scene, name) else { continue };
            let (from, to) = (place(ratio.min(1.0)), place(ratio.max(1.0)));
            let (width, height) = ((to - from).max(1.0), BAR - 2.0);
            bars += &format!(
                "<rect x=\"{from:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height}\" fill=\"{color}\"><title>{name}</title></rect>\n"
            );
            bars += &text(to + 4.0, y + BAR - 3.0, "start", &format!("{ratio:.2}"));
            y += BAR;
        }
        y += GAP;
    }
    let mut axis = String::new();
    for tick in TICKS {
        let (x, color) = (place(tick), if tick == 1.0 { "#000" } else { "#ccc" });
        axis += &format!("<path d=\"M{x:.1} 32V{y:.1}\" stroke=\"{color}\"/>\n");
        axis += &text(x, y + 14.0, "middle", &tick.to_string());
    }
    let mut legend = String::new();
    let mut x = 8.0;
    for (name, color) in others.iter().zip(COLORS.iter().cycle()) {
        legend += &format!("<rect x=\"{x:.1}\" y=\"9\" width=\"10\" height=\"10\" fill=\"{color}\"/>\n");
        legend += &text(x + 14.0, 18.0, "start", name);
        x += 26.0 + 6.0 * real(name.len() as u64);
    }
    let (width, height) = (NAMES + AXIS + FIGURES, y + 24.0);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height:.0}\" viewBox=\"0 0 {width} {height:.0}\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <title>Time of a frame of {size} as a multiple of alberti's</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{axis}{bars}{legend}</svg>\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::ratios::read;

    #[test]
    fn bars_are_as_long_as_their_ratios() {
        assert_eq!([ENDS[0], ENDS[1], 1000.0].map(place), [NAMES, NAMES + AXIS, NAMES + AXIS]);
        assert!((place(10.0) - place(5.0) - (place(2.0) - place(1.0))).abs() < 1e-9);
        let times =
            read("scene,size,renderer,milliseconds,off\nfill,8x8,Exact,1,0\nfill,8x8,peer,4,0\n").unwrap();
        let svg = plot(&times, "8x8");
        let width = place(4.0) - place(1.0);
        assert!(svg.contains(&format!("width=\"{width:.1}\"")) && svg.contains(">4.00<"), "{svg}");
        assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count());
    }
}
