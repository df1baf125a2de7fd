//! Directions from which a model is seen, as angles around it.

use super::{cross, dot, length, narrow, normalize, sub};
use crate::options::{CameraTable, ViewSide};
use crate::scene::Camera;

/// The azimuth and the elevation of a model that is seen from the front, a third to the right, and a little above.
const USUAL: [f64; 2] = [30.963_756_532_073_52, 21.100_196_024_093_02];

impl Camera {
    /// The direction upwards in the picture.
    #[must_use]
    pub fn picture_up(&self) -> [f32; 3] {
        if self.roll == 0.0 && !is_straight(self.up.map(f64::from), self.view()) {
            return self.up;
        }
        upwards(self.up.map(f64::from), self.view(), self.roll).map(narrow)
    }

    /// The same camera, upright; one that looks straight up or down stays as it is.
    pub(crate) fn upright(self) -> Self {
        let straight = is_straight(self.up.map(f64::from), self.view());
        Self { roll: if straight { self.roll } else { 0.0 }, ..self }
    }

    fn view(&self) -> [f64; 3] {
        sub(self.target.map(f64::from), self.eye.map(f64::from))
    }
}

/// The azimuth and the elevation that are wished for.
fn angles(wishes: &CameraTable) -> [f64; 2] {
    let [azimuth, elevation] = wishes.view.map_or(USUAL, side);
    let given = |angle: Option<f32>, other: f64| angle.map_or(other, f64::from);
    [given(wishes.azimuth.map(f32::from), azimuth), given(wishes.elevation.map(f32::from), elevation)]
}

/// The horizontal unit vector from a model's front towards one who looks at it.
fn front(up: [f64; 3]) -> [f64; 3] {
    normalize(cross([1.0, 0.0, 0.0], up)).unwrap_or([0.0, 0.0, 1.0])
}

/// The unit vector towards the viewer. The front is +z when y is up, and -y when z is up, as modelling programs have
/// it.
pub(super) fn away(wishes: &CameraTable, up: [f64; 3]) -> [f64; 3] {
    let [azimuth, elevation] = angles(wishes);
    let up = normalize(up).unwrap_or([0.0, 1.0, 0.0]);
    let front = front(up);
    let right = cross(up, front);
    let ([sin, cos], [above, along]) = (sin_cos(azimuth), sin_cos(elevation));
    let away = [0, 1, 2].map(|k| along * (cos * front[k] + sin * right[k]) + above * up[k]);
    normalize(away).unwrap_or(front)
}

/// Whether two directions are so close that their cross product says nothing in f32, or one of them is 0: a view
/// straight up or down.
pub(super) fn is_straight(up: [f64; 3], view: [f64; 3]) -> bool {
    match (normalize(up), normalize(view)) {
        (Some(up), Some(view)) => length(cross(up, view)) < 2e-5,
        _ => true,
    }
}

/// The roll of a camera that looks straight up or down, and has come there from the azimuth that is wished for.
pub(super) fn turn(wishes: &CameraTable, up: [f64; 3], view: [f64; 3]) -> f64 {
    let [azimuth, _] = angles(wishes);
    // Without zeros that are below 0.
    (if dot(up, view) < 0.0 { -azimuth } else { azimuth }) + 0.0
}

/// The direction upwards in the picture of a camera that leans to the right by `roll` degrees. One that looks straight
/// up or down has come from the front.
pub(super) fn upwards(up: [f64; 3], view: [f64; 3], roll: f64) -> [f64; 3] {
    let upright = if is_straight(up, view) {
        let sign = if dot(up, view) < 0.0 { -1.0 } else { 1.0 };
        front(up).map(|x| sign * x + 0.0)
    } else {
        up
    };
    if roll == 0.0 { upright } else { rolled(upright, view, roll) }
}

/// A direction after a turn to the right about the view.
fn rolled(up: [f64; 3], view: [f64; 3], degrees: f64) -> [f64; 3] {
    let (Some(forward), Some(right)) = (normalize(view), normalize(cross(view, up))) else { return up };
    let upright = cross(right, forward);
    let [sin, cos] = sin_cos(degrees);
    [0, 1, 2].map(|k| cos * upright[k] + sin * right[k])
}

fn side(side: ViewSide) -> [f64; 2] {
    // Along the diagonal of a cube, whose three faces look alike.
    let diagonal = || [45.0, 0.5_f64.sqrt().atan().to_degrees()];
    side.angles().map_or_else(diagonal, |angles| angles.map(f64::from))
}

/// Exact at right angles.
fn sin_cos(degrees: f64) -> [f64; 2] {
    let turn = degrees.rem_euclid(360.0);
    for (at, pair) in [(0.0, [0.0, 1.0]), (90.0, [1.0, 0.0]), (180.0, [0.0, -1.0]), (270.0, [-1.0, 0.0])] {
        if (turn - at).abs() <= 0.0 {
            return pair;
        }
    }
    let (sin, cos) = turn.to_radians().sin_cos();
    [sin, cos]
}

#[cfg(test)]
mod tests {
    use super::*;

    const Y: [f64; 3] = [0.0, 1.0, 0.0];

    fn close(found: [f64; 3], right: [f64; 3]) {
        assert!(found.iter().zip(right).all(|(f, r)| (f - r).abs() < 1e-7), "{found:?} {right:?}");
    }

    #[test]
    fn sides_are_where_they_are_said_to_be() {
        let of = |view| away(&CameraTable { view: Some(view), ..CameraTable::default() }, Y);
        close(of(ViewSide::Front), [0.0, 0.0, 1.0]);
        close(of(ViewSide::Right), [1.0, 0.0, 0.0]);
        close(of(ViewSide::Back), [0.0, 0.0, -1.0]);
        close(of(ViewSide::Left), [-1.0, 0.0, 0.0]);
        close(of(ViewSide::Top), Y);
        close(of(ViewSide::Bottom), [0.0, -1.0, 0.0]);
        close(of(ViewSide::Iso), [1.0 / 3.0_f64.sqrt(); 3]);
        let usual = away(&CameraTable::default(), Y);
        close(usual, normalize([0.6, 0.45, 1.0]).unwrap());
        // Where z is up, the front is -y.
        close(
            away(&CameraTable { view: Some(ViewSide::Front), ..CameraTable::default() }, [0.0, 0.0, 1.0]),
            [0.0, -1.0, 0.0],
        );
    }

    #[test]
    fn up_is_across_the_view() {
        let from = |azimuth: f32, elevation: f32| {
            let wishes = CameraTable {
                azimuth: Some(azimuth.into()),
                elevation: Some(elevation.into()),
                ..CameraTable::default()
            };
            let view = away(&wishes, Y).map(|x| -x);
            upwards(Y, view, if is_straight(Y, view) { turn(&wishes, Y, view) } else { 0.0 })
        };
        close(from(0.0, 90.0), [0.0, 0.0, -1.0]);
        close(from(90.0, 90.0), [-1.0, 0.0, 0.0]);
        close(from(0.0, -90.0), [0.0, 0.0, 1.0]);
        close(from(33.0, 80.0), Y);
        // Looking along -z, a quarter to the right points to +x.
        close(rolled(Y, [0.0, 0.0, -2.0], 90.0), [1.0, 0.0, 0.0]);
        close(rolled(Y, [0.0, -1.0, -1.0], 0.0), normalize([0.0, 1.0, -1.0]).unwrap());
    }
}
