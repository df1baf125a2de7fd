//! Tests of the camera: what it shows, and what it refuses.

use super::*;
use crate::options::ProjectionKind;
use crate::scene::Vertex;

const BALL: Sphere = Sphere { center: [1.0, 2.0, 3.0], radius: 2.0 };

/// The ball as a model: nothing else is known of one without vertices.
fn model() -> Model {
    Model::default()
}

fn of(wishes: CameraTable) -> Camera {
    frame(&wishes, None, (&model(), BALL), 4.0 / 3.0).unwrap()
}

fn refused(wishes: CameraTable) -> String {
    frame(&wishes, None, (&model(), BALL), 1.0).unwrap_err().to_string()
}

/// Whether the ball lies between all six planes.
fn contains(camera: &Camera, aspect: f64) -> bool {
    let eye = camera.eye.map(f64::from);
    let view = normalize(sub(camera.target.map(f64::from), eye)).unwrap();
    let right = normalize(cross(view, camera.picture_up().map(f64::from))).unwrap();
    let up = cross(right, view);
    let to = sub(BALL.center, eye);
    let half = f64::from(camera.fov).to_radians() / 2.0;
    let sides = [(up, half), (right, (half.tan() * aspect).atan())];
    let fits = |(axis, half): ([f64; 3], f64)| {
        dot(to, view) * half.sin() - dot(to, axis).abs() * half.cos() >= BALL.radius
    };
    let depth = dot(to, view);
    sides.into_iter().all(fits)
        && f64::from(camera.near) <= depth - BALL.radius
        && f64::from(camera.far) >= depth + BALL.radius
}

#[test]
fn the_automatic_camera_shows_the_whole_ball() {
    for aspect in [0.1, 0.5, 1.0, 16.0 / 9.0, 8.0] {
        for fov in [1.0, 40.0, 100.0] {
            for up in [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 1.0, -1.0]] {
                let wishes =
                    CameraTable { fov: Some(fov.into()), up: Some(up.into()), ..CameraTable::default() };
                let camera = frame(&wishes, None, (&model(), BALL), aspect).unwrap();
                assert!(contains(&camera, aspect), "{aspect} {camera:?}");
            }
        }
    }
    let camera = of(CameraTable::default());
    assert_eq!((camera.target, camera.up, camera.fov), ([1.0, 2.0, 3.0], [0.0, 1.0, 0.0], DEFAULT_FOV));
    // Beyond 16:9 the angle narrows, so that pictures are no wider.
    let wide = |aspect| frame(&CameraTable::default(), None, (&model(), BALL), aspect).unwrap();
    let half = |camera: Camera| (f64::from(camera.fov).to_radians() / 2.0).tan();
    assert_eq!(wide(16.0 / 9.0).fov, DEFAULT_FOV);
    assert!((half(wide(32.0 / 9.0)) - half(camera) / 2.0).abs() < 1e-6 && contains(&wide(4.0), 4.0));
    let from = CameraTable { eye: Some([5.0, 2.0, 9.0].into()), ..CameraTable::default() };
    assert_eq!(frame(&from, None, (&model(), BALL), 4.0).unwrap().fov, DEFAULT_FOV);
    let zoomed = of(CameraTable { zoom: Some(2.0.into()), ..CameraTable::default() });
    assert_eq!((zoomed.eye, zoomed.target), (camera.eye, camera.target));
    // A point beside the target is where it was in the picture, by similar triangles.
    let (before, after) = (camera, zoomed_about(&zoomed, [1.5, 2.5, 2.0], 2.0));
    let seen = |camera: Camera| {
        let wide = |v: [f32; 3]| v.map(f64::from);
        let forward = normalize(sub(wide(camera.target), wide(camera.eye))).unwrap();
        let right = normalize(cross(forward, wide(camera.up))).unwrap();
        let to = sub([1.5, 2.5, 2.0], wide(camera.eye));
        let half = dot(to, forward) * (f64::from(camera.fov).to_radians() / 2.0).tan();
        [dot(to, right) / half, dot(to, cross(right, forward)) / half, dot(to, forward)]
    };
    let places = [seen(before), seen(after)];
    assert!(places[0].iter().zip(places[1]).all(|(a, b)| (a - b).abs() < 1e-5), "{places:?}");
    assert!(places[0][0].hypot(places[0][1]) > 0.1 && before.eye != after.eye);
    // A smaller model is seen from where it was.
    assert_eq!(zoomed_about(&camera, [1.5, 2.5, 2.0], 0.3), camera);
    let back = unzoomed(&after, [1.5, 2.5, 2.0], 2.0);
    let pairs = [(back.eye, before.eye), (back.target, before.target)];
    assert!(pairs.iter().all(|(a, b)| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5)), "{back:?}");
    assert!((back.fov - before.fov).abs() < 1e-4);
    let tangents = [camera, zoomed].map(|camera| (f64::from(camera.fov).to_radians() / 2.0).tan());
    assert!((tangents[0] / tangents[1] - 2.0).abs() < 1e-6);
    assert!(camera.eye[0] > 1.0 && camera.eye[1] > 2.0 && camera.eye[2] > 3.0);
}

#[test]
fn planes_follow_the_eye() {
    let camera = of(CameraTable { eye: Some([1.0, 2.0, 13.0].into()), ..CameraTable::default() });
    assert!((camera.near - 7.98).abs() < 1e-5 && (camera.far - 12.02).abs() < 1e-5, "{camera:?}");
    let inside = of(CameraTable { eye: Some([1.0, 2.0, 4.0].into()), ..CameraTable::default() });
    assert!(inside.near > 0.0 && inside.far > 3.0);
    let behind = CameraTable {
        eye: Some([1.0, 2.0, 13.0].into()),
        target: Some([1.0, 2.0, 20.0].into()),
        ..CameraTable::default()
    };
    assert!(is_behind(&of(behind), BALL) && !is_behind(&camera, BALL) && !is_behind(&inside, BALL));
    let all =
        CameraTable { near: Some((-20.0).into()), projection: Some(ProjectionKind::Parallel), ..behind };
    assert!(
        !is_behind(&of(all), BALL) && is_behind(&of(CameraTable { near: Some((-7.0).into()), ..all }), BALL)
    );
    let kept = of(CameraTable { near: Some(0.5.into()), far: Some(99.0.into()), ..CameraTable::default() });
    assert_eq!((kept.near, kept.far), (0.5, 99.0));
}

/// A long wall, with the eye before its middle: within its ball, and far from all of it.
#[test]
fn near_is_just_before_what_is_nearest() {
    let wall = faces(&[[[-10.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 1.0, 0.0]]]);
    let seen = |eye: [f32; 3], near: Option<f32>| {
        let near = near.map(Into::into);
        let wishes = CameraTable { eye: Some(eye.into()), near, ..CameraTable::default() };
        cleared(&wall, &wishes, 1e5)
    };
    let (camera, _) = seen([0.0, 0.5, 5.0], None);
    assert!((4.8..5.0).contains(&camera.near) && camera.far > 5.0, "{camera:?}");
    assert_eq!(seen([0.0, 0.5, 5.0], Some(0.25)).0.near, 0.25);
    // Along the wall, part of which is behind the eye, the ray at the picture's edge meets it first.
    let (within, _) = seen([1.0, 0.5, 0.1], None);
    let ray = 0.1 / (10_f64.atan() - 20_f64.to_radians()).cos();
    let depth = ray * 20_f64.to_radians().cos();
    assert!((0.95..0.995).contains(&(f64::from(within.near) / depth)), "{within:?}");
}

/// A floor far larger than all else, on which the eye stands: a tree before it is seen.
#[test]
fn near_is_before_what_is_in_the_picture() {
    let floor = [[-1e4, 0.0, -1e4], [1e4, 0.0, -1e4], [0.0, 0.0, 1e4]];
    let tree = [[-0.5, 1.0, -3.0], [0.5, 1.0, -3.0], [0.0, 2.5, -3.0]];
    let beside = [[90.0, 1.0, -1e-3], [91.0, 1.0, -1e-3], [90.0, 2.0, -1e-3]];
    let behind = tree.map(|[x, y, z]: [f32; 3]| [x, y, -z]);
    let model = faces(&[floor, tree, beside, behind]);
    let ahead = |eye: [f32; 3]| {
        let target = Some([eye[0], eye[1], -10.0].into());
        CameraTable { eye: Some(eye.into()), target, fov: Some(60.0.into()), ..CameraTable::default() }
    };
    let (camera, cut) = cleared(&model, &ahead([0.0, 1.5, 0.0]), 1e5);
    // The floor comes into the picture 30 degrees below its middle, the tree is 3 away.
    let floor = 1.5 / 30.0_f64.to_radians().tan();
    assert!((0.95..0.995).contains(&(f64::from(camera.near) / floor)) && cut.is_none(), "{camera:?}");
    assert!(camera.far > 1e4);
    let (camera, cut) = cleared(&model, &ahead([0.0, 9.0, 0.0]), 1e5);
    assert!((f64::from(camera.near) / (6.0 * floor) - 0.98).abs() < 0.02 && cut.is_none(), "{camera:?}");
    // A floor that depths cannot resolve is told.
    let (camera, cut) = cleared(&model, &ahead([0.0, 1.5, 0.0]), 1e3);
    assert!((camera.far / camera.near - 1000.0).abs() < 0.1, "{camera:?}");
    assert!(cut.is_some_and(|depth| (depth / floor - 0.98).abs() < 0.02), "{cut:?}");
    // A face in whose plane the eye is is not seen.
    let (_, cut) = cleared(&model, &ahead([0.0, 0.0, 0.0]), 1e3);
    assert!(cut.is_some_and(|depth| (depth - 3.0).abs() < 1e-9), "{cut:?}");
}

fn faces(faces: &[[[f32; 3]; 3]]) -> Model {
    let vertices = faces.iter().flatten().map(|&position| Vertex { position, ..Vertex::default() });
    let triangles = (0_u32..).step_by(3).map(|k| [k, k + 1, k + 2]).take(faces.len()).collect();
    let part = crate::scene::Part { triangles, ..crate::scene::Part::default() };
    Model { vertices: vertices.collect(), parts: vec![part], ..Model::default() }
}

fn cleared(model: &Model, wishes: &CameraTable, reach: f64) -> (Camera, Option<f64>) {
    let mut camera = frame(wishes, None, (model, bounding_sphere(model)), 1.0).unwrap();
    let cut = clear(&mut camera, model, wishes, None, Sight { aspect: 1.0, reach });
    (camera, cut)
}

#[test]
fn a_window_is_as_high_as_its_angle_says() {
    let camera = of(CameraTable {
        eye: Some([1.0, 2.0, 13.0].into()),
        fov: Some(90.0.into()),
        ..CameraTable::default()
    });
    assert!((window_height(&camera) - 20.0).abs() < 1e-5);
}

#[test]
fn a_projector_is_a_camera_under_other_names() {
    assert_eq!(
        projector([0.0, 9.0, 0.0], [0.0; 3], 30.0, [0.0; 3]).map(|c| c.picture_up()),
        Ok([0.0, 0.0, -1.0])
    );
    assert_eq!(
        projector([1.0, 9.0, 0.0], [0.0; 3], 30.0, [0.0; 3]).map(|c| c.picture_up()),
        Ok([0.0, 1.0, 0.0])
    );
    for (eye, fov, start) in [
        (
            [0.0; 3],
            30.0,
            "--projector-eye: found the eye and its target both at 0,0,0, expected two points; move --projector-eye or",
        ),
        ([f32::NAN; 3], 30.0, "--projector-eye: found NaN,NaN,NaN"),
        ([1.0; 3], 180.0, "--projector-fov: found 180 degrees"),
    ] {
        let message = projector(eye, [0.0; 3], fov, [0.0; 3]).unwrap_err().to_string();
        assert!(message.starts_with(start), "{message}");
    }
}

#[test]
fn looking_down_needs_no_up() {
    let camera = of(CameraTable { eye: Some([1.0, 20.0, 3.0].into()), ..CameraTable::default() });
    assert_eq!((camera.up, camera.picture_up()), ([0.0, 1.0, 0.0], [0.0, 0.0, -1.0]));
}

/// A camera that leans, or looks down, leaves the world's upward direction as it is, and its picture is a turn of the
/// upright one's.
#[test]
fn up_is_that_of_the_world() {
    for (azimuth, elevation) in [(0.0, 0.0), (31.0, 20.0), (0.0, 90.0), (40.0, 90.0), (40.0, -90.0)] {
        let view = |roll: Option<f32>| {
            of(CameraTable {
                azimuth: Some(azimuth.into()),
                elevation: Some(elevation.into()),
                roll: roll.map(Into::into),
                ..CameraTable::default()
            })
        };
        let upright = view(None);
        assert_eq!(view(Some(0.0)), upright);
        let wide = |v: [f32; 3]| v.map(f64::from);
        let forward = normalize(sub(wide(upright.target), wide(upright.eye))).unwrap();
        let across = |up: [f64; 3]| normalize(cross(forward, up)).unwrap();
        for degrees in [30.0_f32, -100.0] {
            let camera = view(Some(degrees));
            assert_eq!(camera.up, [0.0, 1.0, 0.0]);
            let [level, leaning] = [upright, camera].map(|camera| across(wide(camera.picture_up())));
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            // Leaning to the right turns the right downwards.
            assert!((dot(level, leaning) - cos).abs() < 1e-6, "{azimuth} {elevation}");
            assert!((dot(cross(level, forward), leaning) + sin).abs() < 1e-6, "{azimuth} {elevation}");
        }
    }
    // From nearly above and from above it looks the same.
    let up = |elevation: f32| {
        let (azimuth, elevation) = (Some(40.0.into()), Some(elevation.into()));
        of(CameraTable { azimuth, elevation, ..CameraTable::default() })
    };
    for (near, at) in [(89.99, 90.0), (-89.99, -90.0)] {
        let [near, at] = [near, at].map(|elevation| {
            let camera = up(elevation);
            let view = sub(camera.target.map(f64::from), camera.eye.map(f64::from));
            normalize(cross(view, camera.picture_up().map(f64::from))).unwrap()
        });
        assert!(dot(near, at) > 0.999_999, "{near:?} {at:?}");
    }
}

#[test]
fn a_scene_keeps_its_own_planes_unless_the_view_changes() {
    let base = Camera {
        eye: [9.0; 3],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 50.0,
        near: 0.1,
        far: 77.0,
    };
    assert_eq!(frame(&CameraTable::default(), Some(&base), (&model(), BALL), 1.0).unwrap(), base);
    let moved = CameraTable { eye: Some([0.0, 0.0, 50.0].into()), ..CameraTable::default() };
    assert!(frame(&moved, Some(&base), (&model(), BALL), 1.0).unwrap().near > 40.0);
}

#[test]
fn what_is_not_a_camera_is_refused() {
    let none = CameraTable::default();
    let nan = f32::NAN;
    for (wishes, start) in [
        (
            CameraTable { near: Some(0.0.into()), ..none },
            "--near: found near 0, expected a finite number above 0; try --near",
        ),
        (
            CameraTable { near: Some(nan.into()), projection: Some(ProjectionKind::Parallel), ..none },
            "--near: found near NaN, expected a finite number;",
        ),
        (
            CameraTable {
                near: Some((-1.0).into()),
                far: Some((-2.0).into()),
                projection: Some(ProjectionKind::Parallel),
                ..none
            },
            "--far: found near -1 and far -2",
        ),
        (CameraTable { near: Some(nan.into()), ..none }, "--near: found near NaN, expected"),
        (
            CameraTable { near: Some(5.0.into()), far: Some(5.0.into()), ..none },
            "--far: found near 5 and far 5, expected near < far",
        ),
        (CameraTable { near: Some(1e9.into()), ..none }, "--near: found near 1000000000 and far"),
        (CameraTable { far: Some(f32::INFINITY.into()), ..none }, "--far: found"),
        (
            CameraTable { eye: Some([1.0, 2.0, 3.0].into()), ..none },
            "--eye: found the eye and its target both at 1,2,3",
        ),
        (CameraTable { eye: Some([nan, 2.0, 3.0].into()), ..none }, "--eye: found NaN,2,3"),
        (CameraTable { up: Some([0.0; 3].into()), ..none }, "--up: found 0,0,0"),
        (CameraTable { fov: Some(180.0.into()), ..none }, "--fov: found 180 degrees"),
        (CameraTable { fov: Some(0.0.into()), ..none }, "--fov: found 0 degrees"),
        (CameraTable { fov: Some(nan.into()), ..none }, "--fov: found NaN degrees"),
    ] {
        let message = refused(wishes);
        assert!(message.starts_with(start), "{message}");
    }
    assert!(frame(&CameraTable { fov: Some(1e-38.into()), ..none }, None, (&model(), BALL), 1.0).is_err());
    // The advice can be taken.
    let message = refused(CameraTable { near: Some(1e9.into()), eye: Some([1.0, 2.0, 13.0].into()), ..none });
    assert!(message.ends_with("; try --near 7.98 --far 12.02"), "{message}");
}

#[test]
fn spheres_of_nothing_and_of_a_point_have_a_size() {
    let mut model = Model::default();
    assert_eq!(bounding_sphere(&model).radius.to_bits(), 1.0_f64.to_bits());
    let vertex = Vertex { position: [5.0; 3], ..Vertex::default() };
    model.vertices.push(vertex);
    assert_eq!(bounding_sphere(&model), Sphere { center: [5.0; 3], radius: 1.0 });
    model.vertices.push(Vertex { position: [5.0, 5.0, 9.0], ..vertex });
    assert_eq!(bounding_sphere(&model), Sphere { center: [5.0, 5.0, 7.0], radius: 2.0 });
}
