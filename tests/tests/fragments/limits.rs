//! Scissors, viewports and parts of a target with few rows or columns, or none: whatever is within shows the pixels of
//! the whole frame, and nothing beside it is touched.

use crate::divisions::{Arithmetic, Canvas, Division, Memory, Scene, all_arithmetic, picture};
use alberti::glam::Vec3;
use alberti::{AnyDepth, Camera, DepthFormat, Lines, Rgba8, Sides, Viewport};
use alberti_oracle::rng::{Rng, run_seed};
use std::ops::Range;

const WIDTH: i32 = 70;
const HEIGHT: i32 = 53;
const FRAME: ([u32; 2], AnyDepth) = ([WIDTH.unsigned_abs(), HEIGHT.unsigned_abs()], AnyDepth::D24);
const UNIT: f32 = 1.0 / 4096.0;

/// Triangles over each other, large and small, some through the planes.
#[expect(clippy::cast_possible_truncation, reason = "random f64 become f32")]
fn soup(rng: &mut Rng) -> Scene {
    let mut vertices = Vec::new();
    for _ in 0..60 {
        let size = f64::from(rng.log_uniform(0.05, 4.0));
        let center = [rng.uniform(-2.0, 2.0), rng.uniform(-1.5, 1.5), rng.uniform(-4.0, 0.2)];
        for _ in 0..3 {
            let place = center.map(|c| (c + rng.uniform(-size, size)) as f32);
            let carried = [(); 3].map(|()| rng.uniform(-9.0, 9.0) as f32);
            vertices.push((Vec3::from_array(place), Vec3::from_array(carried)));
        }
    }
    let view =
        Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y).expect("a direction").perspective(1.1, 0.3..5.0);
    Scene::new(vertices, (0..60).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(), view.expect("a pyramid"))
}

/// Divisions into parts above, in and below any scissor.
fn divisions() -> [Division; 6] {
    let bands = [0, 1, 20, usize::MAX].map(Division::bands);
    [Division::WHOLE, bands[0], bands[1], bands[2], bands[3], Division::threads(3)]
}

/// The columns or rows that are within.
fn is_within([columns, rows]: &[Range<i32>; 2], [x, y]: [i32; 2]) -> bool {
    columns.contains(&x) && rows.contains(&y)
}

/// What the scissor leaves of a picture, on what there was before.
fn cut(whole: &Memory, scissor: &[Range<i32>; 2]) -> Memory {
    let mut rest = Memory::new(FRAME.0, FRAME.0[0] as usize, FRAME.1);
    let pixels = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| [x, y]));
    for (i, _) in pixels.enumerate().filter(|(_, pixel)| is_within(scissor, *pixel)) {
        (rest.color[i], rest.depth[i]) = (whole.color[i], whole.depth[i]);
    }
    rest
}

#[test]
fn a_scissor_leaves_its_pixels_of_the_frame() {
    let mut rng = Rng::stream(run_seed(), 1);
    #[expect(clippy::reversed_empty_ranges, reason = "nothing is in them")]
    let mut scissors = vec![
        // Without pixels: in the frame, beside it on each side, the wrong way round, and at the ends of all numbers.
        [20..20, 0..HEIGHT],
        [0..WIDTH, 17..17],
        [WIDTH..WIDTH + 9, 0..HEIGHT],
        [-9..0, 0..HEIGHT],
        [0..WIDTH, HEIGHT..HEIGHT + 9],
        [0..WIDTH, -9..0],
        [40..10, 30..20],
        [i32::MAX..i32::MIN, i32::MAX..i32::MIN],
        [i32::MIN..i32::MIN, i32::MAX..i32::MAX],
        [i32::MIN..i32::MAX, i32::MIN..i32::MAX],
        // Parts of the frame, the frame's edges among them.
        [-5..1, -5..1],
        [WIDTH - 1..WIDTH + 1, HEIGHT - 1..i32::MAX],
        [9..60, 19..41],
        [0..WIDTH, 20..40],
    ];
    for x in [0, 1, 7, 8, 33, WIDTH - 1] {
        scissors.push([x..x + 1, 0..HEIGHT]);
    }
    for y in [0, 1, 19, 20, 33, HEIGHT - 1] {
        scissors.push([0..WIDTH, y..y + 1]);
    }
    let mut drawn = 0;
    for turn in 0..4 {
        let scene = soup(&mut rng);
        for kind in all_arithmetic(UNIT) {
            let (whole, _) = picture(&scene, kind, Division::WHOLE, FRAME);
            for scissor in &scissors {
                let expected = cut(&whole, scissor);
                drawn += expected.drawn();
                for division in divisions() {
                    let mut found = Memory::new(FRAME.0, FRAME.0[0] as usize, FRAME.1);
                    let [columns, rows] = scissor.clone();
                    let stats = scene.draw(kind, division, &mut found.target(FRAME.1).scissor(columns, rows));
                    assert!(found == expected, "{turn}: {scissor:?}, {kind:?}, {division:?}");
                    assert!(stats.written >= expected.drawn());
                }
            }
        }
    }
    assert!(drawn > 50_000, "{drawn}");
}

/// The parts are the rows of the scissor, each once and in order, and those above it without rows.
#[test]
fn parts_of_a_target_are_its_rows() {
    let mut memory = Memory::new(FRAME.0, FRAME.0[0] as usize, FRAME.1);
    let mut target = memory.target(FRAME.1);
    for rows in [0..HEIGHT, 0..0, 0..1, 5..6, 20..41, 40..HEIGHT, HEIGHT..HEIGHT, 30..30] {
        let mut scissor: Canvas<'_> = target.scissor(3..9, rows.clone());
        for height in [0, 1, 2, 5, 20, 53, 54, usize::MAX] {
            let (mut seen, mut empty) = (Vec::new(), 0);
            for mut part in scissor.split(height) {
                let [columns, its] = part.limits();
                assert_eq!(columns, 3..9);
                assert!(its.len() <= height.max(1) && part.size() == FRAME.0);
                part.clear(Rgba8::WHITE);
                empty += usize::from(its.is_empty());
                seen.extend(its);
            }
            assert_eq!(seen, rows.clone().collect::<Vec<_>>(), "parts of {height} rows");
            let [first, end] = [rows.start, rows.end].map(|row| usize::try_from(row).expect("a row"));
            let height = height.max(1);
            let above = if rows.is_empty() { end.div_ceil(height) } else { first / height };
            assert_eq!(empty, above, "parts of {height} rows above {rows:?}");
        }
    }
    let white = (0..WIDTH * HEIGHT).map(|i| (3..9).contains(&(i % WIDTH)));
    assert!(memory.color.iter().map(|&pixel| pixel != 0).eq(white));
}

/// The part of the viewport's picture that lies in the frame. Straight lines restart where columns are multiples of
/// 64, and move along by as many.
#[test]
fn a_viewport_may_lie_anywhere() {
    let mut rng = Rng::stream(run_seed(), 2);
    let (mut drawn, mut without) = (0, 0);
    for _ in 0..8 {
        let [w, h] = [rng.range(1, 90), rng.range(1, 80)].map(|n| i32::try_from(n).expect("small"));
        let across = [-16_384, -w, 1 - w, -w / 2, 0, WIDTH / 2, WIDTH - 1, WIDTH, 16_384 - w];
        let down = [-16_384, -h, 1 - h, -h / 3, 0, HEIGHT / 2, HEIGHT - 1, HEIGHT, 16_384 - h];
        // The guard band does not move along.
        let scene = Scene { sides: Sides::Cube, ..soup(&mut rng) };
        let lines = [Lines::spans(16).expect("a power of two"), Lines::bounded(0.01)];
        for kind in all_arithmetic(UNIT).into_iter().chain(lines.map(Arithmetic::Fixed)) {
            let at = |x, y| {
                let viewport = Viewport::new(x, y, w.unsigned_abs(), h.unsigned_abs()).expect("a viewport");
                Scene { viewport: Some(viewport), ..scene.clone() }
            };
            let size = [w.unsigned_abs(), h.unsigned_abs()];
            let (whole, _) = picture(&at(0, 0), kind, Division::WHOLE, (size, FRAME.1));
            for (&x, &y) in across.iter().zip(&down).chain(across.iter().zip(down.iter().rev())) {
                let x = if matches!(kind, Arithmetic::Floats(_)) { x } else { (x & !63).max(-16_384) };
                let mut expected = Memory::new(FRAME.0, FRAME.0[0] as usize, FRAME.1);
                for i in 0..WIDTH * HEIGHT {
                    let [column, row] = [i % WIDTH - x, i / WIDTH - y];
                    if is_within(&[0..w, 0..h], [column, row]) {
                        let [to, from] = [i, row * w + column].map(|i| usize::try_from(i).expect("a pixel"));
                        (expected.color[to], expected.depth[to]) = (whole.color[from], whole.depth[from]);
                    }
                }
                drawn += expected.drawn();
                without += u32::from(expected.drawn() == 0);
                for division in divisions() {
                    let (found, _) = picture(&at(x, y), kind, division, FRAME);
                    assert!(found == expected, "{w} x {h} at {x}, {y}: {kind:?}, {division:?}");
                }
            }
        }
    }
    assert!(drawn > 10_000 && without > 100, "{drawn} pixels, {without} empty frames");
}

/// A depth that the frame had before stays where nothing is drawn, and is cleared where the scissor says.
#[test]
fn clearing_stays_within_the_scissor() {
    for scissor in [[5..6, 0..HEIGHT], [0..WIDTH, 7..8], [9..9, 0..HEIGHT], [30..200, -4..11]] {
        let mut memory = Memory::new(FRAME.0, FRAME.0[0] as usize, FRAME.1);
        memory.depth.fill(7);
        let [columns, rows] = scissor.clone();
        memory.target(FRAME.1).scissor(columns, rows).clear(Rgba8::WHITE);
        for i in 0..WIDTH * HEIGHT {
            let at = usize::try_from(i).expect("a pixel");
            let within = is_within(&scissor, [i % WIDTH, i / WIDTH]);
            let expected = if within { (u32::MAX, FRAME.1.farthest()) } else { (0, 7) };
            assert_eq!((memory.color[at], memory.depth[at]), expected, "{scissor:?}: pixel {i}");
        }
    }
}
