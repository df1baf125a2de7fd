//! Straight lines as a value that files and fuzzers give: one of their constructors.

use super::{Course, Lines};
use core::fmt;

#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Form {
    /// [`Lines::affine`].
    Affine,
    /// [`Lines::spans`].
    Spans(i32),
    /// [`Lines::bounded`].
    Bounded(f32),
}

impl From<Lines> for Form {
    fn from(lines: Lines) -> Self {
        match lines {
            Lines { budget: Some(budget), .. } => Self::Bounded(budget),
            Lines { course: Course::Perspective, length, .. } => Self::Spans(length),
            Lines { course: Course::Screen | Course::Parabola, .. } => Self::Affine,
        }
    }
}

/// A length that is none of spans.
pub(super) struct Length(i32);

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "spans of {} columns, expected a power of two from 1 to {}", self.0, Lines::LONGEST)
    }
}

impl TryFrom<Form> for Lines {
    type Error = Length;

    fn try_from(form: Form) -> Result<Self, Length> {
        match form {
            Form::Affine => Ok(Self::affine()),
            Form::Spans(length) => Self::spans(length).ok_or(Length(length)),
            Form::Bounded(budget) => Ok(Self::bounded(budget)),
        }
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> arbitrary::Arbitrary<'a> for Lines {
    fn arbitrary(bytes: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
        let form = match bytes.int_in_range(0..=2)? {
            0 => Form::Affine,
            1 => Form::Spans(1 << bytes.int_in_range(0..=6)?),
            _ => Form::Bounded(bytes.arbitrary()?),
        };
        Self::try_from(form).map_err(|Length(_)| arbitrary::Error::IncorrectFormat)
    }
}
