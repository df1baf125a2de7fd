//! Chips whose instructions are those of a chip of the model, times a ratio: their compilers do nearly the same.

use super::Machine;

/// A chip beside those of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kin {
    /// Its name in reports.
    pub name: &'static str,
    /// The chip of the model.
    pub of: Machine,
    /// Its instructions for one of that.
    pub ratio: f64,
    /// How far counts of meshes are from this ratio at most, in percent.
    pub apart: f64,
}

impl Kin {
    /// Those of [`Machine::M4f`] with floating point, and Cortex-M3, which has products and floats in software as
    /// [`Machine::Rv32`] has them.
    pub const ALL: [Self; 3] = [
        Self { name: "m3", of: Machine::Rv32, ratio: 1.0, apart: 12.5 },
        Self { name: "m7", of: Machine::M4f, ratio: 0.99, apart: 5.5 },
        Self { name: "m33", of: Machine::M4f, ratio: 1.01, apart: 6.5 },
    ];

    /// An estimate, and how far it is off in percent, of that of the model's chip.
    #[must_use]
    pub fn estimate(&self, (instructions, off): (f64, f64)) -> (f64, f64) {
        (instructions * self.ratio, ((1.0 + off / 100.0) * (1.0 + self.apart / 100.0) - 1.0) * 100.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    /// Instructions that emulated boards counted.
    const COUNTS: &str = include_str!("../../../../tests/firmware/counts.csv");

    /// Every mesh of triangles that boards draw, of floats and of integers, whole and in bands.
    #[test]
    fn ratios_are_those_of_the_boards_counts() {
        let mut counts = HashMap::new();
        for line in COUNTS.lines() {
            let fields: Vec<&str> = line.split(',').collect();
            if let &[board, scene, "instructions", count] = &fields[..]
                && scene.contains("mesh")
                && !["lines", "points"].iter().any(|other| scene.contains(other))
            {
                counts.insert((board, scene), count.parse::<f64>().expect("a number"));
            }
        }
        for Kin { name, of, ratio, apart } in Kin::ALL {
            let pairs = counts.iter().filter(|((board, _), _)| *board == name);
            let mut off: Vec<f64> = pairs
                .map(|((_, scene), count)| (count / (ratio * counts[&(of.name(), *scene)]) - 1.0) * 100.0)
                .collect();
            off.sort_by(f64::total_cmp);
            let (least, most) = (off[0], off[off.len() - 1]);
            assert!(off.len() >= 30 && least.abs().max(most) <= apart, "{name}: {least} to {most}");
            // The range is no wider than it has to be, and the ratio is in its middle.
            assert!(
                most.max(-least) > 0.8 * apart && (least + most).abs() < 0.3 * apart,
                "{name}: {least} to {most}"
            );
        }
    }
}
