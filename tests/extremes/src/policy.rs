//! The policies of interpolation, and the bounds that their documentation states.

use crate::EPS;
use crate::case::Case;
use alberti::Lines;

/// A division of rows into straight lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Division {
    /// [`Lines::spans`].
    Spans(i32),
    /// [`Lines::bounded`].
    Bounded(f32),
    /// [`Lines::affine`].
    Affine,
}

/// A policy of interpolation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Policy {
    /// [`alberti::Exact`].
    Exact,
    /// [`alberti::Planes`].
    Planes,
    /// [`alberti::Lines`] in `f32`.
    Floats(Division),
    /// [`alberti::FixedPoint`].
    Fixed(Division),
}

use Division::{Affine, Bounded, Spans};
use Policy::{Exact, Fixed, Floats, Planes};

/// The budget of `Bounded`: a 16th of a texel of a texture with 256 a side.
pub(crate) const BUDGET: f32 = 1.0 / 4096.0;

/// The policies, in the order of the tables.
pub(crate) const ALL: [Policy; 13] = [
    Exact,
    Planes,
    Floats(Spans(4)),
    Floats(Spans(8)),
    Floats(Spans(16)),
    Floats(Spans(32)),
    Floats(Bounded(BUDGET)),
    Floats(Affine),
    Fixed(Spans(4)),
    Fixed(Spans(8)),
    Fixed(Spans(16)),
    Fixed(Bounded(BUDGET)),
    Fixed(Affine),
];

/// One of each kind.
pub(crate) const KINDS: [Policy; 8] = [
    Exact,
    Planes,
    Floats(Spans(16)),
    Floats(Bounded(BUDGET)),
    Floats(Affine),
    Fixed(Spans(16)),
    Fixed(Bounded(BUDGET)),
    Fixed(Affine),
];

impl Division {
    pub(crate) fn lines(self) -> Lines {
        match self {
            Spans(length) => Lines::spans(length).expect("a power of two up to 64"),
            Bounded(budget) => Lines::bounded(budget),
            Affine => Lines::affine(),
        }
    }

    /// The greatest miss of its lines.
    fn missed(self, case: &Case) -> f64 {
        match self {
            Spans(length) => missed_by_run(case, i64::from(length)),
            Bounded(budget) => budget.into(),
            Affine => case.spread() * share(case.ratio()),
        }
    }

    /// Rounding in `f32`, in ε of the greatest value.
    fn rounded(self) -> f64 {
        match self {
            Spans(_) => 15.0,
            Bounded(_) => 19.0,
            Affine => 12.0,
        }
    }

    /// Steps of rounding in fixed point that are not in the budget.
    fn steps(self) -> f64 {
        match self {
            Spans(length) => f64::from(length + 3),
            Bounded(_) => 0.0,
            Affine => 64.0 + 3.0,
        }
    }

    fn name(self) -> String {
        match self {
            Spans(16) => "Spans16".into(),
            Spans(length) => format!("Lines::spans({length})"),
            Bounded(_) => "Lines::bounded".into(),
            Affine => "Affine".into(),
        }
    }
}

impl Policy {
    /// The name, as a user writes it.
    pub(crate) fn name(self) -> String {
        match self {
            Exact => "Exact".into(),
            Planes => "Planes".into(),
            Floats(division) => division.name(),
            Fixed(division) => format!("FixedPoint({})", division.name()),
        }
    }

    /// The greatest error at the case's pixel, as `docs/kernel.md` and the policy's documentation state it; infinite
    /// where they state none.
    pub(crate) fn bound(self, case: &Case) -> f64 {
        let largest = EPS * case.largest();
        match self {
            Exact => 9.0 * largest,
            Planes => {
                let column = case.pixel[0];
                let [first, last] = run(case, 64);
                // The last column of a run, not the first of the next one.
                let last = last.min(column | 63);
                let ratio = f64::midpoint(case.q_at(first), case.q_at(last)) / case.q_at(column);
                (15.0 * ratio + 5.0) * largest
            }
            Floats(division) => division.missed(case) + division.rounded() * largest,
            // Beyond ±4096 or a ratio of 2^20 nothing is stated.
            Fixed(_) if case.largest() > 4096.0 || case.ratio() > 1_048_576.0 => f64::INFINITY,
            Fixed(division) => {
                let columns = case.covered();
                let row = (columns.end - columns.start) as f64;
                let slopes = 2f64.powi(-17) + case.ratio() * (row + 4.0) * 3.0 * 2f64.powi(-29);
                let missed = division.missed(case).max(missed_by_one_run(division, case));
                let policy = missed + division.rounded() * largest;
                // A closure gets f32.
                policy + division.steps() / 65536.0 + case.spread() * slopes + largest
            }
        }
    }

    /// The same for depth, whose exact value and greatest one these are.
    pub(crate) fn depth_bound(self, case: &Case, exact: f64, largest: f64) -> f64 {
        match self {
            Exact => 6.0 * EPS * exact,
            Planes | Floats(_) => 12.0 * EPS * largest,
            Fixed(_) => {
                let columns = case.covered();
                ((columns.end - columns.start) as f64 + 8.0) * 2f64.powi(-31) + EPS
            }
        }
    }
}

/// (√r − 1)/(√r + 1).
fn share(ratio: f64) -> f64 {
    let root = ratio.sqrt();
    (root - 1.0) / (root + 1.0)
}

/// The first and the last sample of the run of `length` columns that the pixel is in, and whose values count for it.
fn run(case: &Case, length: i64) -> [i64; 2] {
    let covered = case.covered();
    let first = case.pixel[0] & !(length - 1);
    [first.max(covered.start), (first + length).min(covered.end - 1)]
}

/// The greatest miss of a straight line between the ends of that run.
fn missed_by_run(case: &Case, length: i64) -> f64 {
    let [first, last] = run(case, length);
    let [q0, q1] = [case.q_at(first), case.q_at(last)];
    let difference = case.hyperbolic(last) - case.hyperbolic(first);
    difference.abs() * share(f64::max(q0, q1) / f64::min(q0, q1))
}

/// The greatest miss of a straight line over a whole small triangle, where fixed point may draw it so.
fn missed_by_one_run(division: Division, case: &Case) -> f64 {
    let pixels = case.pixels().max(1.0);
    let long = matches!(division, Spans(length) if length >= 16);
    let level = case.ratio() < 1.0 + 1.001 / pixels;
    if long && pixels < 16.0 && level { case.spread() / (4.0 * pixels) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of two thousand columns, found by climbing: two thirds of the term for slopes do not hold them.
    #[test]
    fn slopes_in_fixed_point_count_in_the_divisor_too() {
        let policy = Fixed(Bounded(BUDGET));
        let steep = Case {
            q: [0.0001, 0.000_102_404_796, 1.0],
            u: [0.954_041_5, 1.0, 0.0],
            ..Case::new([[455_770, -231_373], [-276_033, 480_130], [-290_355, -402_988]], [643, 201])
        };
        let wide = Case {
            q: [0.101_857_1, 1.0, 0.1],
            u: [0.0, 0.0, 1024.0],
            ..Case::new([[-275_287, 254_737], [-301_821, 255_067], [258_671, 254_869]], [672, 995])
        };
        for case in [steep, wide] {
            let sample = case.texels(policy, crate::case::LARGEST);
            assert!(0.66 < sample.share() && sample.share() < 1.0, "{sample:?} of {case:?}");
        }
    }
}
