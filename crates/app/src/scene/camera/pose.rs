//! Directions from which a model is seen, as angles around it.

use super::{cross, dot, length, narrow, normalize, sub};
use crate::options::{CameraTable, ViewSide};
use crate::scene::Camera;

/// The azimuth and the elevation of a model that is seen from the front, a third to the right, and a little above.
const USUAL: [f64; 2] = [30.0, 25.0];

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

/// The azimuth and the elevation that are wished for. What is not is that of a `base` from its target, or the usual.
pub(super) fn angles(wishes: &CameraTable, base: Option<&Camera>, up: [f64; 3]) -> [f64; 2] {
    let usual = base.and_then(|base| angles_of(up, base.view().map(|x| -x))).unwrap_or(USUAL);
    let [azimuth, elevation] = wishes.view.map_or(usual, side);
    let given = |angle: Option<f32>, other: f64| angle.map_or(other, f64::from);
    [given(wishes.azimuth.map(f32::from), azimuth), given(wishes.elevation.map(f32::from), elevation)]
}

/// The azimuth and the elevation of a direction.
fn angles_of(up: [f64; 3], away: [f64; 3]) -> Option<[f64; 2]> {
    let (up, away) = (normalize(up)?, normalize(away)?);
    let front = front(up);
    let azimuth = f64::atan2(dot(away, cross(up, front)), dot(away, front));
    Some([azimuth, dot(away, up).clamp(-1.0, 1.0).asin()].map(f64::to_degrees))
}

/// The horizontal unit vector from a model's front towards one who looks at it.
fn front(up: [f64; 3]) -> [f64; 3] {
    normalize(cross([1.0, 0.0, 0.0], up)).unwrap_or([0.0, 0.0, 1.0])
}

/// The unit vector towards the viewer. The front is +z when y is up, and -y when z is up, as modelling programs have
/// it.
pub(super) fn away([azimuth, elevation]: [f64; 2], up: [f64; 3]) -> [f64; 3] {
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
pub(super) fn turn([azimuth, _]: [f64; 2], up: [f64; 3], view: [f64; 3]) -> f64 {
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
        let of = |view| side_of(Some(view), None, Y);
        close(of(ViewSide::Front), [0.0, 0.0, 1.0]);
        close(of(ViewSide::Right), [1.0, 0.0, 0.0]);
        close(of(ViewSide::Back), [0.0, 0.0, -1.0]);
        close(of(ViewSide::Left), [-1.0, 0.0, 0.0]);
        close(of(ViewSide::Top), Y);
        close(of(ViewSide::Bottom), [0.0, -1.0, 0.0]);
        close(of(ViewSide::Iso), [1.0 / 3.0_f64.sqrt(); 3]);
        // Half of a right angle's sine is that of 30 degrees.
        let [x, y, z] = side_of(None, None, Y);
        assert!((x / x.hypot(z) - 0.5).abs() < 1e-9 && (y - 0.422_618_261_740_699_4).abs() < 1e-9);
        // Where z is up, the front is -y.
        close(side_of(Some(ViewSide::Front), None, [0.0, 0.0, 1.0]), [0.0, -1.0, 0.0]);
    }

    /// The direction from which a side is seen, or a base without one.
    fn side_of(view: Option<ViewSide>, base: Option<&Camera>, up: [f64; 3]) -> [f64; 3] {
        away(angles(&CameraTable { view, ..CameraTable::default() }, base, up), up)
    }

    /// A camera that has its place leaves what is not said as it is.
    #[test]
    fn angles_are_those_of_the_base() {
        let camera = |eye: [f32; 3]| Camera {
            eye,
            target: [1.0; 3],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 40.0,
            near: 1.0,
            far: 9.0,
        };
        for eye in [[3.0, 2.0, 5.0], [-3.0, 0.5, 0.0], [1.0, 1.0, -4.0], [-2.0, -3.0, -1.0]] {
            let right = normalize(sub(eye.map(f64::from), [1.0; 3])).unwrap();
            for up in [Y, [0.0, 0.0, 1.0], [1.0, 2.0, -1.0]] {
                close(side_of(None, Some(&camera(eye)), up), right);
                let wishes = CameraTable { azimuth: Some(10.0.into()), ..CameraTable::default() };
                let [azimuth, elevation] = angles(&wishes, Some(&camera(eye)), up);
                let height = dot(right, normalize(up).unwrap());
                assert!(azimuth == 10.0 && (elevation.to_radians().sin() - height).abs() < 1e-9);
            }
        }
        // One that stands in its target has no direction.
        close(side_of(None, Some(&camera([1.0; 3])), Y), side_of(None, None, Y));
    }

    #[test]
    fn up_is_across_the_view() {
        let from = |azimuth: f32, elevation: f32| {
            let wishes = CameraTable {
                azimuth: Some(azimuth.into()),
                elevation: Some(elevation.into()),
                ..CameraTable::default()
            };
            let angles = angles(&wishes, None, Y);
            let view = away(angles, Y).map(|x| -x);
            upwards(Y, view, if is_straight(Y, view) { turn(angles, Y, view) } else { 0.0 })
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
