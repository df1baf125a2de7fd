//! How far each public function is from exact, by region of its inputs, against rationals.
//!
//! A [`Row`] is one function over one region, and the bound that the function's documentation states. The test `bounds`
//! runs every row and enforces its bound; the example `tables` prints the tables of `docs/accuracy.md`, from more
//! samples of the same rows. So a figure in the documentation, the test that holds it and the table that shows it
//! cannot tell three stories.
//!
//! A new function gets its rows in the module of its area.
#![allow(
    clippy::cast_possible_truncation,
    reason = "random f64 and i64 become the f32 and i32 that are tested"
)]

use alberti_oracle::rational::{Rational, error_in_eps, error_in_ulp, to_f64};
use alberti_oracle::rng::Rng;
use std::fmt;

mod affine;
mod camera;
mod clip;
mod depth;
mod perspective;
mod projector;
mod relations;
mod viewport;

/// Rows that belong together, under one heading.
#[derive(Debug)]
pub struct Table {
    /// The heading.
    pub title: &'static str,
    /// What an error is relative to, and what else a reader must know; a sentence or two of Markdown.
    pub about: &'static str,
    /// The functions and regions.
    pub rows: Vec<Row>,
}

/// One function over one region of its inputs.
pub struct Row {
    /// The function's name, as a user writes it: `DepthMap::zs`.
    pub function: &'static str,
    /// The region, in a few words.
    pub region: String,
    /// What the documentation promises there: the largest error in ε = 2^-24 of the table's scale; infinite where it
    /// promises nothing, and the row shows why.
    pub bound: f64,
    /// Draws inputs from the region, calls the function, and judges the answer.
    pub measure: Box<dyn Fn(&mut Rng) -> Sample>,
}

impl Row {
    /// A row whose inputs, call and judgement are `measure`.
    pub fn new(
        function: &'static str,
        region: impl Into<String>,
        bound: f64,
        measure: impl Fn(&mut Rng) -> Sample + 'static,
    ) -> Self {
        Self { function, region: region.into(), bound, measure: Box::new(measure) }
    }

    /// The number of this row's stream of samples: from its names (FNV-1a), so that its figures stay the same wherever
    /// it stands and whatever rows come and go.
    #[must_use]
    pub fn stream(&self) -> u64 {
        let bytes = self.function.bytes().chain(self.region.bytes());
        bytes
            .fold(0xCBF2_9CE4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3))
    }
}

impl fmt::Debug for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}) <= {}ε", self.function, self.region, self.bound)
    }
}

/// The smallest normal `f32`.
const SMALLEST: f64 = f32::MIN_POSITIVE as f64;

/// The error of one answer.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// In ε of the table's scale.
    pub eps: f64,
    /// In units in the last place of the exact answer; NaN where that is 0, which has no last place, and the answer
    /// not.
    pub ulp: f64,
}

impl Sample {
    /// The error of `got`, in ε of `scale`.
    #[must_use]
    pub fn new(got: f32, exact: &Rational, scale: f64) -> Self {
        let ulp = match error_in_ulp(got, exact).abs() {
            error if error.is_nan() => f64::INFINITY,
            error if error > 0.0 && error.is_finite() && to_f64(exact) == 0.0 => f64::NAN,
            error => error,
        };
        Self { eps: error_in_eps(got, exact, scale).abs(), ulp }
    }

    /// The error of `got`, in ε of the exact answer itself, or of the smallest normal number if that is larger: below
    /// it the spacing of `f32` no longer shrinks.
    #[must_use]
    pub fn relative(got: f32, exact: &Rational) -> Self {
        Self::new(got, exact, to_f64(exact).abs().max(SMALLEST))
    }

    /// The larger error in each unit: for answers of several components.
    #[must_use]
    pub fn worst(self, other: Self) -> Self {
        // A NaN must win, and `f64::max` would drop it.
        let larger = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) };
        Self { eps: larger(self.eps, other.eps), ulp: larger(self.ulp, other.ulp) }
    }
}

/// A number in a region's name: as it is, or as a power of ten where there are many digits.
fn brief(x: f32) -> String {
    if (0.01..1000.0).contains(&x) { x.to_string() } else { format!("{x:e}") }
}

/// Every table, in the order in which a triangle meets the functions.
#[must_use]
pub fn tables() -> Vec<Table> {
    let mut tables = Vec::new();
    tables.extend(affine::tables());
    tables.extend(camera::tables());
    tables.extend(clip::tables());
    tables.extend(perspective::tables());
    tables.extend(depth::tables());
    tables.extend(relations::tables());
    tables.extend(viewport::tables());
    tables.extend(projector::tables());
    tables
}

/// Maximum, 99.9 % and median of one unit of a row's errors.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    /// The largest; infinite if an answer was infinite or NaN where it should not have been. Of units in the last
    /// place, NaN if there were none, as of an exact answer of 0: that counts as the largest of all.
    pub max: f64,
    /// What 99.9 % of the errors do not exceed.
    pub high: f64,
    /// What half of them do not exceed.
    pub median: f64,
}

impl Spread {
    fn of(mut errors: Vec<f64>) -> Self {
        // NaN comes last, as here it always has its sign from `abs`.
        errors.sort_by(f64::total_cmp);
        let at = |thousandths: usize| errors[(errors.len() - 1) * thousandths / 1000];
        Self { max: at(1000), high: at(999), median: at(500) }
    }
}

/// The spread of `samples` errors of a row, in ε and in units in the last place. The same seed gives the same figures.
///
/// # Panics
/// When `samples` is 0.
#[must_use]
pub fn run(row: &Row, samples: usize, rng: &mut Rng) -> [Spread; 2] {
    assert!(samples > 0, "a row without samples measures nothing");
    let not_nan = |eps: f64| if eps.is_nan() { f64::INFINITY } else { eps };
    let (eps, ulp) = (0..samples).map(|_| (row.measure)(rng)).map(|s| (not_nan(s.eps), s.ulp)).unzip();
    [Spread::of(eps), Spread::of(ulp)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_oracle::rational::from_int;

    #[test]
    fn beside_an_exact_zero_there_are_no_last_places_to_count() {
        let [zero, one] = [0, 1].map(from_int);
        assert!(Sample::new(1e-9, &zero, 1.0).ulp.is_nan());
        assert_eq!(Sample::new(0.0, &zero, 1.0).ulp, 0.0);
        assert_eq!(Sample::new(1.0f32.next_up(), &one, 1.0).ulp, 1.0);
        assert_eq!(Sample::new(f32::NAN, &one, 1.0).ulp, f64::INFINITY);
        let row = Row::new("zero", "half of the samples", 1.0, move |rng| {
            Sample::new(if rng.one_in(2) { 1e-9 } else { 0.0 }, &zero, 1.0)
        });
        let [eps, ulp] = run(&row, 100, &mut Rng::stream(1, 1));
        assert!(eps.max < 0.02 && ulp.max.is_nan() && ulp.high.is_nan(), "{eps:?} {ulp:?}");
    }
}
