//! Dirty rectangles: what a frame has changed lies in them, and they lie in the frame.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "pixels and vertices are few"
)]

use alberti::glam::Vec3;
use alberti::lanes::{Machine, One};
use alberti::raster::color::Average;
use alberti::shaders::Solid;
use alberti::{
    Bands, Camera, Cull, D16, Exact, FixedPoint, Interpolation, Mesh, Pass, PreparedTriangle, Rgb565Le,
    Rgba8, Silhouette, Spans16, Sub4, Sub8, Subpixel, Target, Touched, View, for_lanes,
};
use alberti_oracle::rng::{Rng, run_seed};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 48;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
/// Rows of a band.
const ROWS: u32 = 12;
const SKY: Rgba8 = Rgba8::BLACK;

fn view() -> View {
    let camera = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y).expect("a camera");
    camera.perspective(1.2, 0.25..30.0).expect("a view")
}

/// A triangle whose corners are up to `far` from the middle of the view.
fn triangle(rng: &mut Rng, far: f64) -> [Vec3; 3] {
    [(); 3].map(|()| {
        let [x, y] = [(); 2].map(|()| rng.uniform(-far, far));
        Vec3::new(x as f32, y as f32, -3.0)
    })
}

/// Asserts that all pixels of a frame that are not the sky are within, and that the frame has all columns and rows.
fn check(frame: &[u16], touched: &Touched, what: &str) {
    let changed = |k: &usize| frame[*k] != 0;
    for k in (0..PIXELS).filter(changed) {
        let [column, row] = [k % WIDTH as usize, k / WIDTH as usize].map(|c| c as i32);
        let inside = touched.columns().contains(&column) && touched.rows().contains(&row);
        assert!(inside, "{what}: the pixel at {column}, {row} is not in {touched:?}");
    }
    let [columns, rows] = [touched.columns(), touched.rows()];
    let within =
        columns.start >= 0 && columns.end <= WIDTH as i32 && rows.start >= 0 && rows.end <= HEIGHT as i32;
    assert!(within, "{what}: {touched:?} is not in the frame");
    assert_eq!(touched.is_empty(), !(0..PIXELS).any(|k| changed(&k)), "{what}: {touched:?}");
}

/// Asserts that no column and no row is a pixel or more outside the triangle, whose places on the screen are in `f64`.
fn check_tight(corners: [Vec3; 3], touched: &Touched) {
    let half = f64::from(HEIGHT) / 2.0 / f64::from(1.2_f32 / 2.0).tan();
    let places = corners.map(|corner| {
        let [x, y, z] = corner.to_array().map(f64::from);
        [f64::from(WIDTH) / 2.0 - x / z * half, f64::from(HEIGHT) / 2.0 + y / z * half]
    });
    for (axis, range) in [touched.columns(), touched.rows()].into_iter().enumerate() {
        let ends =
            [f64::min, f64::max].map(|of| places.map(|place| place[axis]).into_iter().reduce(of).unwrap());
        let within = f64::from(range.start) > ends[0] - 1.0 && f64::from(range.end) < ends[1] + 1.0;
        assert!(touched.is_empty() || within, "{touched:?} of a triangle at {places:?}");
    }
}

/// Draws one triangle in one frame, in one lane and in all.
fn plain(corners: [Vec3; 3], (interpolation, subpixel): (impl Interpolation, Subpixel)) {
    let (view, indices) = (view(), [[0_u16, 1, 2]]);
    let mesh = Mesh::new(&corners, &indices, |v: &Vec3| (*v, ()));
    let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE)).interpolation(interpolation);
    pass = pass.subpixel(subpixel).cull(Cull::None);
    let mut draw = |one: bool| {
        let (mut color, mut depth) = (vec![0; PIXELS], vec![u16::MAX; PIXELS]);
        let mut target = Target::new(Rgb565Le, D16, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
        let mut touched = Touched::default();
        if one {
            pass.count_by(One, &mut target, &mut touched);
        } else {
            let widest = Machine::all().next().expect("a machine");
            for_lanes!(widest, lanes => pass.count_by(lanes, &mut target, &mut touched));
        }
        check(&color, &touched, "a triangle");
        check_tight(corners, &touched);
    };
    draw(true);
    draw(false);
}

/// Draws one triangle with smooth edges in bands, by what is listed.
fn smooth(corners: [Vec3; 3], (interpolation, subpixel): (impl Interpolation, Subpixel), room: usize) {
    let (view, indices) = (view(), [[0_u16, 1, 2]]);
    let mesh = Mesh::new(&corners, &indices, |v: &Vec3| (*v, ()));
    let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE)).interpolation(interpolation);
    pass = pass.subpixel(subpixel).cull(Cull::None);
    const BAND: usize = (WIDTH * ROWS) as usize;
    let (mut color, mut depth, mut cells) = ([0; BAND], [0; BAND], [0; BAND]);
    let mut bands = Bands::new(Rgb565Le, D16, WIDTH, HEIGHT, &mut color, &mut depth).expect("bands");
    let mut list = [PreparedTriangle::EMPTY; 1];
    let (mut prepared, _) = pass.prepare_smooth([WIDTH, HEIGHT], D16, &mut list[..room], &mut ());
    let (mut frame, mut touched) = (vec![], Touched::default());
    while let Some(mut band) = bands.next_band() {
        band.clear(SKY);
        prepared.count_by(One, &mut band, &mut touched);
        let mut silhouette = Silhouette::new(&band, &mut cells).expect("enough words");
        prepared.cover(&mut silhouette);
        let coverage = silhouette.coverage();
        prepared.count_fringe(&mut band, &coverage, &mut touched);
        coverage.resolve(&mut band, Average::Light, |_| SKY);
        frame.extend_from_slice(band.pixels());
    }
    // A fringe that is covered too little for a step of the colour is counted, but not seen.
    let seen = frame.iter().any(|word| *word != 0);
    let counted = if seen { touched } else { Touched::default() };
    check(&frame, &counted, "smooth edges");
}

#[test]
fn triangles_change_what_they_touch() {
    let mut rng = Rng::stream(run_seed(), 0);
    for k in 0..600 {
        // Some are of a few pixels, some reach far out of the view.
        let corners = triangle(&mut rng, [0.4, 2.0, 9.0][k % 3]);
        plain(corners, (Exact, Sub8));
        plain(corners, (FixedPoint(Spans16), Sub4));
    }
}

#[test]
fn smooth_edges_change_what_they_touch() {
    let mut rng = Rng::stream(run_seed(), 1);
    for k in 0..300 {
        let corners = triangle(&mut rng, [0.4, 2.0, 9.0][k % 3]);
        smooth(corners, (Exact, Sub8), k % 2);
        smooth(corners, (FixedPoint(Spans16), Sub4), k % 2);
    }
}

#[test]
fn points_change_what_they_touch() {
    let mut rng = Rng::stream(run_seed(), 2);
    for size in 1..200 {
        let corners = triangle(&mut rng, 2.5);
        let (view, indices) = (view(), [[0_u16, 1, 2]]);
        let mesh = Mesh::new(&corners, &indices, |v: &Vec3| (*v, ()));
        let (mut color, mut depth) = (vec![0; PIXELS], vec![u16::MAX; PIXELS]);
        let mut target = Target::new(Rgb565Le, D16, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
        let mut touched = Touched::default();
        let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE));
        pass.count_points(&mut target, 0..1, size / 8 + 1, &mut touched);
        check(&color, &touched, "a point");
    }
}
