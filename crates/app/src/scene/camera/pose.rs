//! Directions from which a model is seen, as angles around it.

use super::{cross, dot, normalize, parallel};
use crate::options::{CameraTable, ViewSide};

/// The azimuth and the elevation of a model that is seen from the front, a third to the right, and a little above.
const USUAL: [f64; 2] = [30.963_756_532_073_52, 21.100_196_024_093_02];

/// The unit vector towards the viewer. The front is +z when y is up, and -y when z is up, as modelling programs have
/// it.
pub(super) fn away(wishes: &CameraTable, up: [f64; 3]) -> [f64; 3] {
    let [azimuth, elevation] = wishes.view.map_or(USUAL, side);
    let given = |angle: Option<f32>, other: f64| angle.map_or(other, f64::from);
    let azimuth = given(wishes.azimuth.map(f32::from), azimuth);
    let elevation = given(wishes.elevation.map(f32::from), elevation);
    let up = normalize(up).unwrap_or([0.0, 1.0, 0.0]);
    let front = normalize(cross([1.0, 0.0, 0.0], up)).unwrap_or([0.0, 0.0, 1.0]);
    let right = cross(up, front);
    let ([sin, cos], [above, along]) = (sin_cos(azimuth), sin_cos(elevation));
    let away = [0, 1, 2].map(|k| along * (cos * front[k] + sin * right[k]) + above * up[k]);
    normalize(away).unwrap_or(front)
}

/// The direction upwards in the picture of a model whose own is `up`. Seen from above or below, it is that of the
/// azimuth.
pub(super) fn upwards(wishes: &CameraTable, up: [f64; 3], away: [f64; 3]) -> [f64; 3] {
    if normalize(up).is_none() || !parallel(up, away) {
        return up;
    }
    let level = CameraTable { elevation: Some(0.0.into()), view: None, ..*wishes };
    let azimuth = wishes.azimuth.map_or(0.0, f32::from);
    let front = self::away(&CameraTable { azimuth: Some(azimuth.into()), ..level }, up);
    let sign = if dot(up, away) > 0.0 { -1.0 } else { 1.0 };
    // Without zeros that are below 0.
    front.map(|x| sign * x + 0.0)
}

/// A camera's direction upwards after a turn to the right about its view.
pub(super) fn rolled(up: [f64; 3], view: [f64; 3], degrees: f64) -> [f64; 3] {
    let (Some(forward), Some(right)) = (normalize(view), normalize(cross(view, up))) else { return up };
    let upright = cross(right, forward);
    let [sin, cos] = sin_cos(degrees);
    [0, 1, 2].map(|k| cos * upright[k] + sin * right[k])
}

fn side(side: ViewSide) -> [f64; 2] {
    match side {
        ViewSide::Front => [0.0, 0.0],
        ViewSide::Right => [90.0, 0.0],
        ViewSide::Back => [180.0, 0.0],
        ViewSide::Left => [-90.0, 0.0],
        ViewSide::Top => [0.0, 90.0],
        ViewSide::Bottom => [0.0, -90.0],
        // Along the diagonal of a cube, whose three faces look alike.
        ViewSide::Iso => [45.0, 0.5_f64.sqrt().atan().to_degrees()],
    }
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
            upwards(&wishes, Y, away(&wishes, Y))
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
