//! Times of alberti and its peers, who took turns in one run.

use super::results::{number, rows};

/// The table: least times of frames, and pixels that are off.
pub(super) const PLACE: &str = "benches/results/peers.csv";
const HEADING: &str = "scene,size,renderer,milliseconds,off";

/// The renderer with which all others are compared.
pub(super) const FIRST: &str = "Exact";

/// A line of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Time {
    pub(super) scene: String,
    pub(super) size: String,
    pub(super) renderer: String,
    pub(super) milliseconds: f64,
    /// Pixels that differ from the right picture by more than 8/255 in a channel.
    pub(super) off: u32,
}

/// Reads a table.
pub(super) fn read(text: &str) -> Result<Vec<Time>, String> {
    let row = |(place, [scene, size, renderer, milliseconds, off]): (String, [&str; 5])| {
        let [scene, size, renderer] = [scene, size, renderer].map(str::to_owned);
        let (milliseconds, off) = (number(&place, milliseconds)?, number(&place, off)?);
        Ok(Time { scene, size, renderer, milliseconds, off })
    };
    rows(PLACE, HEADING, text)?.into_iter().map(row).collect()
}

/// All values of a field in the order in which they come first.
pub(super) fn all<'a>(times: &'a [Time], field: impl Fn(&'a Time) -> &'a str) -> Vec<&'a str> {
    let mut all = Vec::new();
    for value in times.iter().map(field) {
        if !all.contains(&value) {
            all.push(value);
        }
    }
    all
}

/// The time of a renderer in a scene of a size, if it draws that, and as a multiple of the first's.
pub(super) fn of<'a>(times: &'a [Time], size: &str, scene: &str, renderer: &str) -> Option<(&'a Time, f64)> {
    let of = |name: &str| {
        times.iter().find(|time| (&*time.size, &*time.scene, &*time.renderer) == (size, scene, name))
    };
    let time = of(renderer)?;
    Some((time, time.milliseconds / of(FIRST)?.milliseconds))
}

/// A table in Markdown for each size.
pub(crate) fn markdown(table: &str) -> Result<String, String> {
    let times = read(table)?;
    let mut text = String::new();
    for size in all(&times, |time| &time.size) {
        let of_size: Vec<_> = times.iter().filter(|time| time.size == size).cloned().collect();
        let names = all(&of_size, |time| &time.renderer);
        text += &format!("| scene, {size} | {} |\n|---|{}\n", names.join(" | "), "---|".repeat(names.len()));
        for scene in all(&of_size, |time| &time.scene) {
            let cells = names.iter().map(|name| of(&of_size, size, scene, name).map_or("-".into(), cell));
            text += &format!("| {scene} | {} |\n", cells.collect::<Vec<_>>().join(" | "));
        }
        text.push('\n');
    }
    Ok(text)
}

/// Milliseconds to three digits, how many times those of the first, and pixels off.
fn cell((time, ratio): (&Time, f64)) -> String {
    let ratio = if time.renderer == FIRST { String::new() } else { format!(" ({ratio:.2})") };
    format!("{}{ratio}, {} off", three_digits(time.milliseconds), time.off)
}

/// A number to three digits.
pub(super) fn three_digits(number: f64) -> String {
    let digits =
        (0_usize..6).find(|&digits| number * 10_f64.powi(i32::try_from(digits).unwrap_or(0)) >= 99.95);
    format!("{number:.0$}", digits.unwrap_or(6))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_ratios() {
        let table = "# here\nscene,size,renderer,milliseconds,off\nfill,8x8,Exact,0.25,0\nfill,8x8,peer,1,3\nmesh,8x8,Exact,123.4,1\n";
        let right = "| scene, 8x8 | Exact | peer |\n|---|---|---|\n| fill | 0.250, 0 off | 1.00 (4.00), 3 off |\n| mesh | 123, 1 off | - |\n\n";
        assert_eq!(markdown(table), Ok(right.to_owned()));
        assert_eq!([0.099_96, 0.1234, 99.94, 99.96].map(three_digits), ["0.100", "0.123", "99.9", "100"]);
    }
}
