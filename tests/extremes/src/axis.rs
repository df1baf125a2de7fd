//! Axes: a parameter with its points, and the policies that are tried at each.

use crate::measured::Sample;
use alberti_oracle::rng::Rng;
use std::fmt;

/// A note of the case behind a sample, which is only written where somebody reads it.
#[derive(Debug, Default)]
pub struct Note {
    /// Whether somebody does.
    pub wanted: bool,
    /// The case.
    pub text: String,
}

impl Note {
    /// Takes the case down.
    pub fn take(&mut self, case: impl FnOnce() -> String) {
        if self.wanted {
            self.text = case();
        }
    }
}

/// A function that makes a case of a point and a generator's numbers, and judges the answer.
pub type Measure = Box<dyn Fn(f64, &mut Rng, &mut Note) -> Sample + Send + Sync>;

/// A policy along an axis.
pub struct Series {
    /// The name, as a user writes it.
    pub policy: String,
    /// The constructor that refuses, where one does.
    pub refuses: &'static str,
    /// The cases and their judge.
    pub measure: Measure,
}

impl Series {
    /// A policy that nothing refuses.
    pub fn new(
        policy: impl Into<String>,
        measure: impl Fn(f64, &mut Rng, &mut Note) -> Sample + Send + Sync + 'static,
    ) -> Self {
        Self { policy: policy.into(), refuses: "", measure: Box::new(measure) }
    }

    /// The same with the constructor that refuses.
    #[must_use]
    pub fn refused_by(self, refuses: &'static str) -> Self {
        Self { refuses, ..self }
    }
}

impl fmt::Debug for Series {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.policy)
    }
}

/// A parameter that is swept.
#[derive(Debug)]
pub struct Axis {
    /// The short name, for files.
    pub name: &'static str,
    /// The heading.
    pub title: &'static str,
    /// A short paragraph: the cases, and the reading of the figures.
    pub about: &'static str,
    /// The parameter's name.
    pub parameter: &'static str,
    /// Its values with their names, in order.
    pub points: Vec<(f64, String)>,
    /// The unit of errors.
    pub unit: &'static str,
    /// The error from which on a policy counts as broken, and its name.
    pub limit: (f64, &'static str),
    /// The number by which samples are divided, as they take so much longer.
    pub dear: u64,
    /// The policies.
    pub series: Vec<Series>,
}

/// Points with their shortest names.
#[must_use]
pub fn named(values: &[f64]) -> Vec<(f64, String)> {
    values.iter().map(|&value| (value, name(value))).collect()
}

/// Powers of ten, from and to these.
#[must_use]
pub fn decades(from: i32, to: i32) -> Vec<(f64, String)> {
    named(&(from..=to).map(|power| format!("1e{power}").parse().unwrap_or(f64::NAN)).collect::<Vec<f64>>())
}

/// A number as it is read best: as it is, or as a power of ten.
#[must_use]
pub fn name(value: f64) -> String {
    let power = format!("{value:e}");
    let short = value == 0.0 || (1e-3..1e6).contains(&value.abs());
    if short && (value < 1e4 || power.contains('.')) { value.to_string() } else { power }
}
