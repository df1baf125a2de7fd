//! Axes of the view and of the world: opening angles, scales, distances from the origin.

use crate::axis::{Axis, Series, decades, named};
use crate::pipeline::{Scene, displaced, projected, rounded};

/// Half a pixel, which is what makes a picture wrong.
const HALF_A_PIXEL: (f64, &str) = (0.5, "half a pixel");

/// A scene of middling size.
const SCENE: Scene = Scene { degrees: 57.0, distance: 10.0, offset: 0.0, unit: None };

/// A pass over scenes that depend on the point.
fn pass(name: &str, scene: impl Fn(f64) -> Scene + Send + Sync + 'static) -> Series {
    Series::new(name, move |point, rng, note| displaced(&scene(point), rng, note))
        .refused_by("`Camera::look_at` or `perspective`")
}

/// Opening angles.
pub(super) fn angles() -> Axis {
    let lens = |name: &str, snapped: bool| {
        Series::new(name, move |degrees, rng, note| projected(degrees, snapped, rng, note))
            .refused_by("`Perspective::new`")
    };
    Axis {
        name: "angles",
        title: "Opening angles",
        about: "A vertex from eye space to the screen by `Perspective` and `Viewport`, in a picture of 16384 pixels \
                a side, on the subpixel (1/256) to which it is snapped, and as large triangles keep it. Then a whole \
                pass in 1024 pixels, whose camera is 10 units from the middle of the mesh: through a narrow angle the \
                rounding of camera and coordinates is seen enlarged, as it would be through a telescope.",
        parameter: "full angle, degrees",
        points: named(&[
            0.0, 1e-3, 1e-2, 0.1, 1.0, 10.0, 45.0, 90.0, 120.0, 150.0, 170.0, 179.0, 179.9, 179.999, 180.0,
        ]),
        unit: "pixels",
        limit: HALF_A_PIXEL,
        dear: 1,
        series: vec![
            lens("snapped to 1/256 pixel", true),
            lens("kept to 2^-16 pixel", false),
            pass("Pass", |degrees| Scene { degrees, offset: 10.0, ..SCENE }),
        ],
    }
}

/// Scales of the world.
pub(super) fn scales() -> Axis {
    let mut points = named(&[1e-40, 1e-30]);
    points.extend(decades(-6, 6));
    points.extend(named(&[1e30, 1e40]));
    Axis {
        name: "scales",
        title: "Scales of the world and of meshes",
        about: "A pass in 1024 pixels, against the same in `f64`. A world that is larger or smaller as a whole, camera \
                and planes with it, is the same picture. So is a mesh in a unit of its own, whose frame scales it \
                back. What ends it are the planes, which have to be normal `f32`.",
        parameter: "scale",
        points,
        unit: "pixels",
        limit: HALF_A_PIXEL,
        dear: 1,
        series: vec![
            pass("world and camera scaled", |scale| Scene {
                distance: 10.0 * scale,
                offset: 10.0 * scale,
                ..SCENE
            }),
            pass("object scaled, its frame scales back", |scale| Scene {
                offset: 10.0,
                unit: Some(scale),
                ..SCENE
            })
            .refused_by("dropping what is beyond `f32`"),
        ],
    }
}

/// Distances from the world's origin.
pub(super) fn distances() -> Axis {
    let mut points = named(&[0.0]);
    points.extend(decades(0, 6));
    points.extend(named(&[4e6, 1e8]));
    Axis {
        name: "distances",
        title: "Distances from the world's origin",
        about: "A mesh so many units from the origin, and a camera 10 units from it, in 1024 pixels. 4 million units \
                away neighbouring `f32` are 0.25 apart, which is 24 pixels here. A frame of its own keeps a mesh in \
                shape, but where it stands is rounded all the same, as the camera is. The last row is the rounding of \
                the coordinates alone, all else being exact. The remedy is known: subtract the camera's place from \
                the frames' origins in `f64`, and let the camera stand at the origin, which is the first column.",
        parameter: "units from the origin",
        points,
        unit: "pixels",
        limit: HALF_A_PIXEL,
        dear: 1,
        series: vec![
            pass("world coordinates", |offset| Scene { offset, ..SCENE }),
            pass("a frame of its own", |offset| Scene { offset, unit: Some(1.0), ..SCENE }),
            Series::new("coordinates rounded to f32", |offset, rng, note| {
                rounded(&Scene { offset, ..SCENE }, rng, note)
            }),
        ],
    }
}
