//! The list of axes.

mod depths;
mod fields;
mod shapes;
mod values;

use crate::axis::Axis;

/// All axes, in the order of the page.
#[must_use]
pub fn all() -> Vec<Axis> {
    vec![
        values::ratios(),
        values::repeats(),
        shapes::slivers(),
        shapes::areas(),
        shapes::depths(),
        shapes::targets(),
        shapes::offsets(),
        depths::stored(),
        depths::gaps(),
        depths::layers(),
        fields::angles(),
        fields::scales(),
        fields::distances(),
    ]
}
