//! Smooth silhouettes: the covered part of each pixel against triangles clipped at its sides in rationals, meshes
//! without a seam, and whole pictures against supersampled ones and in bands.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "subpixels are within the guard band, pixels are few"
)]

use alberti::glam::{Mat3, Vec3};
use alberti::lanes::One;
use alberti::raster::color::{Average, resolve};
use alberti::raster::{Corner, Paint};
use alberti::shaders::{Solid, VertexColor};
use alberti::texture::surface::{Grid, Parametric, Torus};
use alberti::{
    Bands, Camera, Cull, D16, Exact, F32, FixedPoint, Interpolation, Mesh, NoDepth, Object, Pass, Point3,
    PreparedTriangle, Rgb565Le, Rgba8, Rgba8888, Silhouette, Slot, Spans16, Sub4, Sub8, Subpixel, Target,
    View, Viewport,
};
use alberti_oracle::area::covered;
use alberti_oracle::cases;
use alberti_oracle::coverage::{Triangle, area2, covers};
use alberti_oracle::rational::{from_int, to_f64};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::probe::{bare, vertex};
use std::ops::Range;

/// What a silhouette knows of a pixel: its part, and whether its centre is covered.
type Word = (u32, bool);

/// The words of these columns and rows, row by row, with all these triangles in the silhouette: the same, whether edges
/// wait for their others, or how many.
fn words(
    triangles: &[Triangle],
    subpixel: Subpixel,
    interpolation: impl Interpolation,
    limits: [Range<i32>; 2],
) -> Vec<Word> {
    let [none, few, many] =
        [0, 3, 200].map(|places| words_by(places, triangles, subpixel, interpolation, limits.clone()));
    assert!(none == few && none == many, "{triangles:?}");
    none
}

fn words_by(
    places: usize,
    triangles: &[Triangle],
    subpixel: Subpixel,
    interpolation: impl Interpolation,
    [columns, rows]: [Range<i32>; 2],
) -> Vec<Word> {
    const WIDTH: u32 = 1 << 14;
    let count = rows.len() * WIDTH as usize;
    let (mut color, mut depth) = (vec![0; count], vec![(); count]);
    let first = rows.start.unsigned_abs();
    let mut band = Target::band(Rgba8888, NoDepth, [WIDTH; 2], first, &mut color, &mut depth).expect("rows");
    let target = band.scissor(columns.clone(), rows.clone());
    let mut cells = vec![77; columns.len() * rows.len() + places * Silhouette::PLACE];
    let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
    let paint = Paint { stage: (), interpolation, subpixel, cull: Cull::None };
    let mut edges = paint.edges(&mut silhouette);
    for triangle in triangles {
        let corners = bare(*triangle).map(|vertex| Corner::new(paint.numbers(NoDepth), &vertex));
        edges.triangle(corners.each_ref());
    }
    edges.finish();
    let coverage = silhouette.coverage();
    let places = rows.flat_map(|row| columns.clone().map(move |column| [column, row]));
    places.map(|place| (coverage.part(place), coverage.has_centre(place))).collect()
}

/// Six columns and rows of the frame about a place in subpixels.
fn window(sample: [i64; 2], bits: u32) -> [Range<i32>; 2] {
    sample.map(|c| {
        let first = ((c >> bits) as i32 - 3).clamp(0, (1 << 14) - 6);
        first..first + 6
    })
}

/// Every pixel of a window within 4.5·2^-16 of the exact area, and its centre as the oracle has it.
fn is_right(triangle: Triangle, subpixel: Subpixel, [columns, rows]: [Range<i32>; 2]) -> f64 {
    let bits = subpixel.bits();
    let found = words(&[triangle], subpixel, Exact, [columns.clone(), rows.clone()]);
    let places = rows.flat_map(|row| columns.clone().map(move |column| [column, row].map(i64::from)));
    let mut worst = 0.0_f64;
    for (place, (part, has_centre)) in places.zip(&found) {
        let exact = covered(triangle, bits, place);
        let off = to_f64(&(from_int((*part).into()) - exact * from_int(1 << 16)));
        assert!(off.abs() <= 4.5, "{triangle:?} {place:?}: {part} is off by {off}");
        let centre = place.map(|c| (c << bits) + (1 << bits >> 1));
        assert_eq!(*has_centre, covers(triangle, centre), "{triangle:?} {place:?}");
        worst = worst.max(off.abs());
    }
    worst
}

#[test]
fn areas_of_hard_triangles() {
    let mut rng = Rng::stream(run_seed(), 1);
    let mut worst = 0.0_f64;
    for subpixel in [Sub4, Sub8] {
        for _ in 0..1500 {
            let pixels = 2 + rng.log_integer(32_765);
            let case = cases::any(&mut rng, subpixel.bits(), pixels << subpixel.bits());
            worst = worst.max(is_right(case.tri, subpixel, window(case.sample, subpixel.bits())));
        }
    }
    // What happens is a third of the bound.
    assert!(worst > 1.0, "{worst}");
}

#[test]
fn areas_of_small_and_of_flat_triangles() {
    let mut rng = Rng::stream(run_seed(), 2);
    for subpixel in [Sub4, Sub8] {
        let one = 1 << subpixel.bits();
        for _ in 0..700 {
            let side = rng.log_integer(9 * one);
            let [from_x, from_y] = [(); 2].map(|()| rng.range(-one, 7 * one));
            let corner = |rng: &mut Rng, flat: i64| {
                [from_x + rng.range(-side, side), from_y + rng.range(-side, side) / flat]
            };
            let flat = 1 + rng.log_integer(one) * i64::from(rng.one_in(2));
            let triangle = [(); 3].map(|()| corner(&mut rng, flat));
            is_right(triangle, subpixel, [0..6, 0..6]);
            is_right(triangle.map(|[x, y]| [y, x]), subpixel, [0..6, 0..6]);
        }
    }
}

/// Neither the order of the corners, nor the numbers of the policy, nor the columns and rows that are asked for.
#[test]
fn words_depend_on_the_triangle_alone() {
    let mut rng = Rng::stream(run_seed(), 3);
    for subpixel in [Sub4, Sub8] {
        let reach = 60 << subpixel.bits();
        for _ in 0..60 {
            let triangle = [(); 3].map(|()| [(); 2].map(|()| rng.range(-reach / 2, reach)));
            let [a, b, c] = triangle;
            let whole = words(&[triangle], subpixel, Exact, [0..40, 0..40]);
            for order in [[b, c, a], [c, b, a]] {
                assert_eq!(words(&[order], subpixel, Exact, [0..40, 0..40]), whole, "{order:?}");
            }
            assert_eq!(words(&[triangle], subpixel, FixedPoint(Spans16), [0..40, 0..40]), whole);
            let [left, top] = [(); 2].map(|()| rng.range(0, 30) as i32);
            let part = words(&[triangle], subpixel, Exact, [left..left + 9, top..top + 5]);
            let rows = whole.chunks(40).skip(top as usize).take(5);
            let same: Vec<Word> = rows.flat_map(|row| &row[left as usize..][..9]).copied().collect();
            assert_eq!(part, same, "{triangle:?}");
        }
    }
}

/// Triangles around a point within a larger one cover the same, word for word; and a grid without gaps all of it.
#[test]
fn triangles_that_share_edges_leave_no_seam() {
    let mut rng = Rng::stream(run_seed(), 4);
    for subpixel in [Sub4, Sub8] {
        let one = 1_i64 << subpixel.bits();
        for _ in 0..300 {
            let reach = rng.log_integer(300 * one) + 3;
            let mut point = || [rng.range(-reach, reach), rng.range(-reach, reach)].map(|c| c + 10 * one);
            let ([a, b, c], p) = ([point(), point(), point()], point());
            let parts = [[a, b, p], [b, c, p], [c, a, p]];
            let areas = parts.map(area2);
            if areas.iter().any(|area| area.signum() != area2([a, b, c]).signum()) {
                continue;
            }
            let whole = words(&[[a, b, c]], subpixel, Exact, [0..20, 0..20]);
            assert_eq!(words(&parts, subpixel, Exact, [0..20, 0..20]), whole, "{a:?} {b:?} {c:?} {p:?}");
        }
        // Points moved by less than a third of the distance between them.
        let grid: Vec<[i64; 2]> = (0..12 * 12)
            .map(|k| {
                let at = |c: i64, rng: &mut Rng| (c - 1) * 2 * one + rng.range(-one / 2, one / 2);
                [at(k % 12, &mut rng), at(k / 12, &mut rng)]
            })
            .collect();
        let mut triangles = vec![];
        for (row, column) in (0..11).flat_map(|row| (0..11).map(move |column| (row, column))) {
            let [a, b, c, d] = [0, 1, 12, 13].map(|k| grid[row * 12 + column + k]);
            triangles.extend([[a, b, d], [a, d, c]]);
        }
        assert!(triangles.iter().all(|triangle| area2(*triangle) > 0));
        assert!(
            words(&triangles, subpixel, Exact, [0..17, 0..17]).iter().all(|word| *word == (1 << 16, true))
        );
    }
}

#[test]
fn hostile_corners_are_harmless() {
    let ends = [i32::MIN, i32::MIN + 1, -(1 << 23) - 1, -(1 << 23), -1, 0, 1, 300, 1 << 23, i32::MAX];
    let (mut color, mut depth, mut cells) = ([0; 12], [(); 12], [0; 12]);
    let mut target = Target::new(Rgba8888, NoDepth, 4, 3, &mut color, &mut depth).expect("a frame");
    let mut rng = Rng::stream(run_seed(), 5);
    for subpixel in [Sub4, Sub8] {
        let stage = |()| Some(Rgba8::WHITE);
        let paint = Paint { stage, interpolation: FixedPoint(Spans16), subpixel, cull: Cull::None };
        for _ in 0..20_000 {
            let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
            let corners = [(); 3].map(|()| {
                let place = [(); 2].map(|()| ends[rng.index(ends.len())]);
                Corner::of_integers(place, [0, 1.0_f32.to_bits()], &())
            });
            paint.cover(&mut silhouette, corners.each_ref());
            let coverage = silhouette.coverage();
            paint.fringe(&mut target, &coverage, corners.each_ref(), &mut ());
            coverage.resolve(&mut target, Average::Bytes, |_| Rgba8::BLACK);
        }
    }
    // 511 surfaces over one another are the whole, and more do no harm.
    for (layers, part) in [(511, 1 << 16), (512, 0), (1030, 1 << 16)] {
        let all = vec![[[0, 0], [64, 0], [0, 64]]; layers];
        assert_eq!(words(&all, Sub4, Exact, [0..1, 0..1])[0].0, part, "{layers}");
    }
}

/// Pixels beside the centres of a triangle carry a point of it that is in the pixel.
#[test]
fn fringes_carry_what_the_pixel_has_of_the_triangle() {
    let mut rng = Rng::stream(run_seed(), 6);
    let (mut fringes, mut all) = (0, 0);
    for k in 0..600 {
        let subpixel = [Sub4, Sub8][k % 2];
        let one = 1 << subpixel.bits();
        let triangle = [(); 3].map(|()| [(); 2].map(|()| rng.range(-4 * one, 20 * one)));
        // Planes of the screen, in steps of 2^-10, from 1 on.
        let slope = [(); 2].map(|()| rng.uniform(-1.0, 1.0));
        let plane = |[x, y]: [f64; 2]| 100.0 + x * slope[0] + y * slope[1];
        let carried = |p: [i64; 2]| plane(p.map(|c| c as f64 / one as f64)) as f32;
        let stage = |u: f32| Some(Rgba8::from_bits((u * 1024.0 + 0.5) as u32));
        let vertices = triangle.map(|p| vertex(p, 0.5, 1.0, carried(p)));
        let (mut color, mut depth, mut cells) = ([0; 256], [(); 256], [0; 256]);
        let mut target = Target::new(Rgba8888, NoDepth, 16, 16, &mut color, &mut depth).expect("a frame");
        let mut words = vec![];
        macro_rules! by {
            ($interpolation:expr) => {{
                let paint = Paint { stage, interpolation: $interpolation, subpixel, cull: Cull::None };
                let corners = vertices.map(|vertex| Corner::new(paint.numbers(NoDepth), &vertex));
                let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
                paint.cover(&mut silhouette, corners.each_ref());
                let coverage = silhouette.coverage();
                paint.fringe(&mut target, &coverage, corners.each_ref(), &mut ());
                for place in (0..16).flat_map(|row| (0..16).map(move |column| [column, row])) {
                    words.push((place, coverage.part(place), coverage.has_centre(place)));
                }
            }};
        }
        if k % 4 < 2 {
            by!(Exact);
        } else {
            by!(FixedPoint(Spans16));
        }
        for ([column, row], part, has_centre) in words {
            let pixel = u32::from_le(color[(row * 16 + column) as usize]);
            all += 1;
            // Less than half of a 255th is nothing.
            if has_centre || part < 129 {
                assert_eq!(pixel, 0, "{triangle:?}");
                continue;
            }
            fringes += 1;
            let middle = plane([column, row].map(|c| f64::from(c) + 0.5));
            // A subpixel more, and a step.
            let most = (slope[0].abs() + slope[1].abs()) * (0.5 + 1.0 / one as f64) + 2.0 / 1024.0;
            let off = f64::from(pixel) / 1024.0 - middle;
            assert!(off.abs() <= most, "{triangle:?} {column} {row}: {off}, {most}");
        }
    }
    assert!(fringes > 5000, "{fringes} of {all}");
}

const WIDTH: u32 = 160;
const HEIGHT: u32 = 120;
/// A pixel beside a window.
const BESIDE: u16 = 0xf81f;

/// A torus, with its normals as colours.
fn torus() -> (Vec<(Vec3, Vec3)>, Vec<[u32; 3]>) {
    let (torus, grid) = (Torus { major: 1.0, minor: 0.42 }, Grid::new(36, 18));
    let turned = Mat3::from_rotation_x(0.9) * Mat3::from_rotation_z(0.3);
    let point = |k| {
        let frame = torus.orthonormal_frame(grid.uv(k));
        let position: Point3<Object> = frame.origin();
        (turned * position.coords, frame.axes().z_axis * 0.3 + 0.6)
    };
    let triangles = (0..grid.triangles() as u32).map(|k| grid.triangle(k)).collect();
    ((0..grid.vertices() as u32).map(point).collect(), triangles)
}

fn view(distance: f32) -> View {
    let camera = Camera::look_at(Vec3::new(0.2, 0.1, distance), Vec3::ZERO, Vec3::Y).expect("a camera");
    camera.perspective(0.66, 0.5..10.0).expect("a view")
}

/// The list that bands share: none, or one with room for so many triangles, with or without those between samples.
#[derive(Clone, Copy, Debug)]
enum Shared {
    Nothing,
    Smooth(usize),
    Plain(usize),
}

/// A picture with smooth edges, by a policy, in bands of so many rows, with so many slots. Bands are of a window with
/// pixels beside it, which stay, unless there is one band.
fn smooth(
    distance: f32,
    (interpolation, subpixel): (impl Interpolation, Subpixel),
    rows: u32,
    (slots, shared): (usize, Shared),
    viewport: Viewport,
) -> Vec<u16> {
    let (vertices, triangles) = torus();
    let mesh = Mesh::new(&vertices, &triangles, |v: &(Vec3, Vec3)| *v);
    let pixels = (WIDTH * rows) as usize;
    let (mut depth, mut cells) = (vec![0; pixels], vec![0; pixels]);
    let beside = if rows == HEIGHT { 0 } else { 3 };
    let stride = WIDTH as usize + beside;
    let mut picture = vec![BESIDE; stride * HEIGHT as usize];
    let place = &mut picture[beside / 2..];
    let mut bands = Bands::window(Rgb565Le, D16, [WIDTH, HEIGHT], stride, place, &mut depth).expect("bands");
    let (mut slots, view) = (vec![Slot::EMPTY; slots], view(distance));
    let sky = |[column, row]: [i32; 2]| Rgba8::new(0, column as u8, row as u8, 255);
    let mut pass = Pass::new(&view, &mesh, VertexColor).interpolation(interpolation).subpixel(subpixel);
    pass = pass.slots(&mut slots).viewport(viewport);
    let mut room = vec![PreparedTriangle::EMPTY; 2 * triangles.len()];
    // The three steps by a pass, or by what it has listed.
    macro_rules! draw {
        ($way:expr) => {
            while let Some(mut band) = bands.next_band() {
                let [columns, rows] = band.limits();
                for [column, row] in rows.flat_map(|row| columns.clone().map(move |column| [column, row])) {
                    band.scissor(column..column + 1, row..row + 1).clear(sky([column, row]));
                }
                $way.draw(&mut band);
                let mut silhouette = Silhouette::new(&band, &mut cells).expect("enough words");
                $way.cover(&mut silhouette);
                let coverage = silhouette.coverage();
                $way.draw_fringe(&mut band, &coverage);
                coverage.resolve(&mut band, Average::Light, sky);
            }
        };
    }
    let size = [WIDTH, HEIGHT];
    match shared {
        Shared::Nothing => draw!(pass),
        Shared::Smooth(count) => {
            let (mut prepared, _) = pass.prepare_smooth(size, D16, &mut room[..count], &mut ());
            draw!(prepared);
        }
        Shared::Plain(count) => {
            let (mut prepared, _) = pass.count_prepare(size, D16, &mut room[..count], &mut ());
            draw!(prepared);
        }
    }
    let columns = beside / 2..beside / 2 + WIDTH as usize;
    let outside = |(place, pixel)| (!columns.contains(&(place % stride))).then_some(pixel);
    assert!(picture.iter().enumerate().filter_map(outside).all(|&pixel| pixel == BESIDE), "pixels beside");
    picture.chunks(stride).flat_map(|row| &row[columns.clone()]).copied().collect()
}

#[test]
fn bands_and_slots_make_the_frame() {
    let whole = Viewport::new(0, 0, WIDTH, HEIGHT).expect("a viewport");
    // In sight, cut by the near plane and at all sides, and in a part of the frame.
    let part = Viewport::new(37, -11, 80, 90).expect("a viewport");
    for (distance, viewport) in [(4.2, whole), (1.9, whole), (1.3, part)] {
        macro_rules! by {
            ($policy:expr) => {{
                let frame = smooth(distance, $policy, HEIGHT, (0, Shared::Nothing), viewport);
                for (rows, slots, shared) in [
                    (1, 0, Shared::Nothing),
                    (7, 700, Shared::Nothing),
                    (50, 33, Shared::Nothing),
                    (1, 0, Shared::Smooth(2000)),
                    (7, 700, Shared::Smooth(2000)),
                    (HEIGHT, 33, Shared::Smooth(2000)),
                    (50, 700, Shared::Smooth(300)),
                    (50, 33, Shared::Plain(2000)),
                ] {
                    let found = smooth(distance, $policy, rows, (slots, shared), viewport);
                    assert!(found == frame, "{rows} rows, {slots} slots, {shared:?}");
                }
            }};
        }
        by!((Exact, Sub8));
        by!((FixedPoint(Spans16), Sub4));
    }
}

/// A white torus over black is as bright as its mean over 256 samples a pixel.
#[test]
fn pictures_are_those_of_many_samples() {
    const FACTOR: u32 = 16;
    const PIXELS: usize = (WIDTH * HEIGHT) as usize;
    let (vertices, triangles) = torus();
    let mesh = Mesh::new(&vertices, &triangles, |v: &(Vec3, Vec3)| (v.0, ()));
    for distance in [4.2, 1.9] {
        let view = view(distance);
        let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE));
        let (mut color, mut depth, mut cells) = (vec![0; PIXELS], vec![1.0; PIXELS], vec![0; PIXELS]);
        let mut target = Target::new(Rgba8888, F32, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
        target.clear(Rgba8::BLACK);
        pass.draw(&mut target);
        let plain: Vec<u32> = target.pixels().to_vec();
        let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
        pass.cover(&mut silhouette);
        let coverage = silhouette.coverage();
        pass.draw_fringe(&mut target, &coverage);
        coverage.resolve(&mut target, Average::Bytes, |_| Rgba8::BLACK);

        let samples = (WIDTH * FACTOR * 4 * FACTOR) as usize;
        let (mut large, mut depth) = (vec![0; samples], vec![0.0; samples]);
        let [width, height] = [WIDTH, HEIGHT].map(|side| side * FACTOR);
        let mut bands = Bands::new(Rgba8888, F32, width, height, &mut large, &mut depth).expect("bands");
        let mut many = vec![0; PIXELS];
        bands.draw(Rgba8::BLACK, |band| {
            pass.draw(band);
            let first = band.limits()[1].start / FACTOR as i32;
            let own = &mut many[(first * WIDTH as i32) as usize..];
            resolve((Rgba8888, band.pixels()), (Rgba8888, own), WIDTH as usize, first, 16, Average::Bytes);
        });
        let red = |pixel: u32| f64::from(pixel.to_ne_bytes()[0]);
        let far = |from: &[u32]| -> Vec<f64> {
            from.iter().zip(&many).map(|(a, b)| red(*a) - red(*b)).filter(|off| *off != 0.0).collect()
        };
        let (smooth, rough) = (far(&color), far(&plain));
        let mean = |off: &[f64]| off.iter().map(|off| off.abs()).sum::<f64>() / rough.len() as f64;
        assert!(rough.len() > 300, "{} pixels on the silhouette", rough.len());
        // Where two surfaces end in a pixel, which is seldom, areas are added: too much, never too little.
        let wrong = smooth.iter().filter(|off| off.abs() > 16.0).count();
        assert!(wrong * 40 < rough.len(), "{wrong} of {}", rough.len());
        assert!(smooth.iter().all(|off| *off > -16.0));
        let [smooth, rough] = [mean(&smooth), mean(&rough)];
        assert!(smooth < 2.0 && rough > 40.0, "{smooth} and without {rough}");
    }
}

/// A needle that is a third of a pixel wide is drawn in all rows that it passes, as bright as it is wide.
#[test]
fn what_is_narrower_than_a_pixel_is_thin() {
    let (mut color, mut depth, mut cells) = ([0; 32 * 32], [(); 32 * 32], [0; 32 * 32]);
    let mut target = Target::new(Rgba8888, NoDepth, 32, 32, &mut color, &mut depth).expect("a frame");
    let paint =
        Paint { stage: |()| Some(Rgba8::WHITE), interpolation: Exact, subpixel: Sub8, cull: Cull::None };
    let [a, b, c, d] = [[700, 0], [785, 0], [5000, 32 * 256], [5085, 32 * 256]];
    let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
    let parts = [[a, b, c], [b, d, c]]
        .map(|triangle| bare(triangle).map(|vertex| Corner::new(paint.numbers(NoDepth), &vertex)));
    parts.iter().for_each(|corners| paint.cover(&mut silhouette, corners.each_ref()));
    let coverage = silhouette.coverage();
    for triangle in [[a, b, c], [b, d, c]] {
        paint.triangle(One, &mut target, bare(triangle).each_ref(), &mut ());
    }
    for corners in &parts {
        paint.fringe(&mut target, &coverage, corners.each_ref(), &mut ());
    }
    coverage.resolve(&mut target, Average::Bytes, |_| Rgba8::new(0, 0, 0, 0));
    for row in color.chunks(32) {
        let sum: u32 = row.iter().map(|pixel| u32::from(pixel.to_ne_bytes()[0])).sum();
        // 85 of 256 subpixels.
        assert!(sum.abs_diff(85) <= 2, "{sum}");
    }
}
