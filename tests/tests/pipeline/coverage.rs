//! Which samples a triangle covers: exhaustively on one pixel, adversarially up to the guard band, and at the bound
//! between 32- and 64-bit edge functions. The oracle has no tie rule.
//!
//! The rasterizer draws by one kernel for both grids (`values.rs` compares them with their types); the edge functions
//! alone are tried beside it.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "subpixels are within the guard band, in i32 here and in i64 there"
)]

use alberti_math::{GUARD_PIXELS, Rgba8, Subpixel};
use alberti_oracle::cases;
use alberti_oracle::coverage::{Triangle, area2, covers, weights};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{Cull, Edge, FITS_I32, NoDepth, Outcome, Rgba8888, Span, SpanWalker, Target};
use alberti_tests::probe::{Covered, LARGEST, Probe, bare, draw_widest, steps};
use alberti_tests::sweep::or_swept;

/// All 289^3 ordered triples of 28.4 positions in the closed pixel, each of which is there three times, by its three
/// beginnings: of these so many have positive area, and so many of those the sample exactly on the line of an edge.
const POSITIVE: u32 = 11_791_152 / 3;
const ON_A_LINE: u32 = 744_192 / 3;

#[test]
fn every_triangle_within_a_pixel() {
    const SAMPLE: [i64; 2] = [8; 2];
    let points: Vec<[i64; 2]> = (0..289).map(|i| [i % 17, i / 17]).collect();
    let (mut color, mut depth) = ([0u32], [()]);
    let mut target = Target::new(Rgba8888, NoDepth, 1, 1, &mut color, &mut depth).expect("one pixel");
    let mut draw = |tri: Triangle, cull: Cull| {
        let [a, b, c] = bare(tri);
        let mut count = Covered::default();
        let white = |()| Some(Rgba8::WHITE);
        draw_widest(Subpixel::Sub4, &mut target, [&a, &b, &c], cull, white, &mut count);
        (count.samples, count.outcome)
    };
    let (mut positive, mut on_a_line, mut covered) = (0, 0, 0);
    // Each from its first point.
    for (i, &a) in points.iter().enumerate() {
        for &b in &points[i + 1..] {
            for &c in &points[i + 1..] {
                let tri = [a, b, c];
                if area2(tri) <= 0 {
                    continue;
                }
                positive += 1;
                on_a_line += u32::from(weights(tri, SAMPLE).contains(&0));
                let expected = u64::from(covers(tri, SAMPLE));
                covered += expected;
                assert_eq!(draw(tri, Cull::None).0, expected, "{tri:?}");
                if positive % 17 == 0 {
                    // Clockwise on the screen is a back face; the other way round it is a front face.
                    let reversed = [a, c, b];
                    assert_eq!(draw(tri, Cull::Front).0, expected, "{tri:?}");
                    assert_eq!(draw(reversed, Cull::Back).0, expected, "{reversed:?}");
                    assert_eq!(draw(reversed, Cull::None).0, expected, "{reversed:?}");
                    assert_eq!(draw(tri, Cull::Back), (0, Some(Outcome::Culled)), "{tri:?}");
                    assert_eq!(draw(reversed, Cull::Front), (0, Some(Outcome::Culled)), "{reversed:?}");
                }
            }
        }
    }
    println!("{positive} triangles, {on_a_line} with the sample on a line, {covered} cover it");
    assert_eq!((positive, on_a_line), (POSITIVE, ON_A_LINE));
    assert!(covered > 300_000);
}

#[test]
fn adversarial_samples_with_four_bits() {
    adversarial(Subpixel::Sub4, 4);
}

#[test]
fn adversarial_samples_with_eight_bits() {
    adversarial(Subpixel::Sub8, 8);
}

/// Half of the 10^7 samples of a sweep: through the edge functions wherever the sample lies, and through the rasterizer
/// wherever a frame can have it.
fn adversarial(subpixel: Subpixel, stream: u64) {
    let samples = or_swept(1_000_000, 5_000_000);
    let (bits, guard) = (subpixel.bits(), i64::from(GUARD_PIXELS) << subpixel.bits());
    let mut rng = Rng::stream(run_seed(), stream);
    let mut probe = Probe::new(NoDepth, subpixel);
    let (mut ties, mut covered, mut spans, mut drawn, mut drawn_ties) = (0, 0, 0, 0, 0);
    for _ in 0..samples {
        let case = cases::any(&mut rng, bits, guard);
        let (expected, tie) = (covers(case.tri, case.sample), on_a_line(case.tri, case.sample));
        assert_eq!(inside(subpixel, case.tri, case.sample), expected, "{case:?}");
        let walked = in_span(subpixel, &mut rng, case.tri, case.sample);
        assert_eq!(walked.unwrap_or(false), expected, "{case:?}");
        spans += u64::from(walked.is_some());
        ties += u64::from(tie);
        covered += u64::from(expected);

        // A frame has rows and columns from 0 on: mirrored there, the case is another one and as hard.
        let mirror = case.sample.map(|c| c.signum());
        let flip = |p: [i64; 2]| [p[0] * mirror[0], p[1] * mirror[1]];
        let (tri, sample) = (case.tri.map(flip), flip(case.sample));
        let [column, row] = sample.map(|c| (c >> bits) as i32);
        if column >= LARGEST || row >= LARGEST {
            continue;
        }
        drawn += 1;
        drawn_ties += u64::from(on_a_line(tri, sample));
        let columns = (column - 1).max(0)..(column + 2).min(LARGEST);
        let found = probe.covered(tri, columns.clone(), row);
        for (column, &pixel) in columns.zip(found) {
            let sample = cases::pixel_centre(i64::from(column), i64::from(row), bits);
            assert_eq!(pixel != 0, covers(tri, sample), "{tri:?} at {sample:?}");
        }
    }
    println!(
        "{samples} samples, {ties} ties, {covered} covered, {spans} spans; {drawn} drawn, {drawn_ties} ties"
    );
    assert!(ties * 20 >= samples && drawn_ties * 20 >= drawn, "too few ties: {ties}, {drawn_ties}");
    assert!(covered * 10 >= samples && spans * 4 >= samples && drawn * 4 >= samples * 3);
}

fn on_a_line(tri: Triangle, sample: [i64; 2]) -> bool {
    weights(tri, sample).contains(&0)
}

/// The verdict of the edge functions in i64, without the rasterizer around them.
fn inside(subpixel: Subpixel, tri: Triangle, sample: [i64; 2]) -> bool {
    let (sample, one) = (sample.map(|c| c as i32), 1 << subpixel.bits());
    let edges = ends(tri).map(|[from, to]| Edge::<i64>::new(from, to, sample, one));
    edges.iter().all(|e| e.value + e.bias >= 0)
}

/// Whether the sample lies in the span of its row, walked to from some rows above and columns to the left; `None`
/// beside the triangle's box.
fn in_span(subpixel: Subpixel, rng: &mut Rng, tri: Triangle, sample: [i64; 2]) -> Option<bool> {
    let [column, row] = sample.map(|c| (c >> subpixel.bits()) as i32);
    let [columns, rows] = [0, 1].map(|axis| samples(subpixel, tri, axis));
    if !columns.contains(&column) || !rows.contains(&row) {
        return None;
    }
    let left = column - within(rng, &(0..1 + (column - columns.start).min(12)));
    let top = row - within(rng, &(0..1 + (row - rows.start).min(12)));
    let first = center(subpixel, [left, top]);
    let edges = ends(tri).map(|[from, to]| Edge::<i64>::new(from, to, first, 1 << subpixel.bits()));
    let mut walker = SpanWalker::new(&edges, columns.end - left, [above(subpixel, tri, top), rows.end - top]);
    if row - top >= walker.rows() {
        return Some(false);
    }
    for _ in top..row {
        walker.next_row();
    }
    let span = walker.span();
    Some((span.start..span.end).contains(&(column - left)))
}

/// The number of rows from `top` on whose samples lie above the middle vertex.
fn above(subpixel: Subpixel, tri: Triangle, top: i32) -> i32 {
    let mut heights = tri.map(|[_, y]| y);
    heights.sort_unstable();
    let [one, half] = steps(subpixel);
    -(half - heights[1]).div_euclid(one) as i32 - top
}

/// The centre of a pixel.
fn center(subpixel: Subpixel, pixel: [i32; 2]) -> [i32; 2] {
    pixel.map(|i| (i << subpixel.bits()) + (1 << (subpixel.bits() - 1)))
}

/// The ends of the three edges, clockwise on the screen; the last one begins at the topmost vertex.
fn ends(tri: Triangle) -> [[[i32; 2]; 2]; 3] {
    let [a, b, c] = tri.map(|p| p.map(|c| c as i32));
    let mut corners = if area2(tri) > 0 { [a, b, c] } else { [a, c, b] };
    let topmost = (0..3).min_by_key(|&k| (corners[k][1], corners[k][0])).expect("three");
    corners.rotate_left(topmost);
    let [a, b, c] = corners;
    [[b, c], [c, a], [a, b]]
}

#[test]
fn both_widths_of_edge_functions_agree_at_the_bound_with_four_bits() {
    widths_agree(Subpixel::Sub4, 14);
}

#[test]
fn both_widths_of_edge_functions_agree_at_the_bound_with_eight_bits() {
    widths_agree(Subpixel::Sub8, 18);
}

/// The spans of so many rows, going down past the last as the rasterizer does.
macro_rules! walk {
    ($int:ty, $edges:expr, $width:expr, $rows:expr) => {{
        let mut edges: [Edge<$int>; 3] = $edges;
        let mut walker = SpanWalker::new(&edges, $width, $rows);
        (0..walker.rows())
            .map(|_| {
                let span = walker.span();
                for edge in &mut edges {
                    // What a fragment's weights are made of.
                    let _ = edge.value + edge.step_x * <$int>::from(span.start.max(span.end));
                    edge.value += edge.step_y;
                }
                walker.next_row();
                span
            })
            .collect::<Vec<Span>>()
    }};
}

/// Boxes whose area, with a pixel more on each side, is the largest that 32 bits hold. An overflow would panic.
fn widths_agree(subpixel: Subpixel, stream: u64) {
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut largest, mut spans, mut covered) = (0i64, 0u64, 0u64);
    for _ in 0..120_000 {
        let size = largest_box(subpixel, &mut rng);
        let tri = spanning(subpixel, &mut rng, size);
        // The samples of the box, of which a band and a scissor may leave any part.
        let [columns, rows] = [0, 1].map(|axis| samples(subpixel, tri, axis));
        if columns.is_empty() || rows.is_empty() {
            continue;
        }
        let left = if rng.one_in(2) { columns.start } else { within(&mut rng, &columns) };
        let right = if rng.one_in(2) { columns.end } else { within(&mut rng, &(left..columns.end)) + 1 };
        let top = if rng.one_in(3) { rows.start } else { within(&mut rng, &rows) };
        let count = (rows.end - top).min(24);
        // The last rows of the box, every other time.
        let top = if rng.one_in(2) { rows.end - count } else { top };
        let first = center(subpixel, [left, top]);
        let (ends, one) = (ends(tri), 1 << subpixel.bits());
        let (width, rows) = (right - left, [above(subpixel, tri, top), count]);
        let narrow = walk!(i32, ends.map(|[from, to]| Edge::new(from, to, first, one)), width, rows);
        let wide = walk!(i64, ends.map(|[from, to]| Edge::new(from, to, first, one)), width, rows);
        assert_eq!(narrow, wide, "{tri:?} from {first:?}");
        spans += narrow.len() as u64;
        covered += narrow.iter().filter(|s| s.start < s.end).count() as u64;
        let area = area2(tri).abs() as i64;
        largest = largest.max(area);
    }
    println!("{spans} spans, {covered} not empty, largest area {:.6} of the bound", ratio(largest));
    assert!(spans > 1_000_000 && covered > 300_000 && ratio(largest) > 0.98);
}

fn ratio(area: i64) -> f64 {
    f64::from(area as i32) / f64::from(FITS_I32 as i32)
}

/// At the bound and one subpixel beyond, the row that is drawn is the row of the oracle.
#[test]
fn rows_are_exact_on_both_sides_of_the_bound() {
    let mut rng = Rng::stream(run_seed(), 3);
    let runs = [Subpixel::Sub4, Subpixel::Sub8].map(|subpixel| rows_exact(subpixel, &mut rng));
    println!("rows with a run: {runs:?}");
    assert!(runs.into_iter().flatten().all(|n| n > 1_000), "{runs:?}");
}

/// How many rows had covered samples, at the bound and beyond it.
fn rows_exact(subpixel: Subpixel, rng: &mut Rng) -> [u32; 2] {
    let mut probe = Probe::new(NoDepth, subpixel);
    let mut runs = [0; 2];
    for i in 0..12_000 {
        let beyond = i % 2;
        let [width, height] = largest_box(subpixel, rng);
        let tri = spanning(subpixel, rng, [width, height + beyond as i64]);
        let [across, rows] = [0, 1].map(|axis| samples(subpixel, tri, axis));
        let rows = rows.start.max(0)..rows.end.min(LARGEST);
        if rows.is_empty() {
            continue;
        }
        let row = within(rng, &rows);
        let found = probe.covered(tri, 0..LARGEST, row);
        let covered = |column: i32| covers(tri, center(subpixel, [column, row]).map(i64::from));
        let count = found.iter().filter(|&&pixel| pixel != 0).count() as i32;
        if let Some(start) = found.iter().position(|&pixel| pixel != 0) {
            // What a row covers is an interval, so its ends tell all.
            let (start, end) = (start as i32, start as i32 + count);
            assert!(
                found[start as usize..end as usize].iter().all(|&pixel| pixel != 0),
                "a gap: {tri:?} {row}"
            );
            assert!(covered(start) && covered(end - 1), "{tri:?} in row {row}: {start}..{end}");
            assert!(start == 0 || !covered(start - 1), "{tri:?} in row {row}: {start}..{end}");
            assert!(end == LARGEST || !covered(end), "{tri:?} in row {row}: {start}..{end}");
            runs[beyond] += 1;
        } else {
            let [left, right] = [across.start, across.end].map(|c| c.clamp(0, LARGEST));
            assert!((left..right).take(64).all(|column| !covered(column)), "{tri:?} in row {row}: nothing");
            for _ in 0..64 {
                let column = within(rng, &(0..LARGEST));
                assert!(!covered(column), "{tri:?} in row {row}: nothing at {column}");
            }
        }
    }
    runs
}

/// Width and height of a box, in subpixels, for which a subpixel more in height would be too much for 32 bits.
fn largest_box(subpixel: Subpixel, rng: &mut Rng) -> [i64; 2] {
    let [one, _] = steps(subpixel);
    let longest = (i64::from(GUARD_PIXELS) * one).min(FITS_I32 / (2 * one));
    let shortest = FITS_I32 / longest + 1;
    let long = (shortest as f64 * ((longest as f64 / shortest as f64).ln() * rng.unit()).exp()) as i64;
    let width = long.clamp(shortest, longest);
    let height = FITS_I32 / width;
    assert!(width * height <= FITS_I32 && width * (height + 1) > FITS_I32);
    [width - one, height - one]
}

/// A triangle that touches all four sides of a box of this size, somewhere that a frame can show at least in part.
fn spanning(subpixel: Subpixel, rng: &mut Rng, [width, height]: [i64; 2]) -> Triangle {
    let guard = i64::from(GUARD_PIXELS) << subpixel.bits();
    loop {
        let mut any = |length: i64| match rng.index(6) {
            0 => 0,
            1 => length,
            2 => rng.range(0, length.min(3)),
            3 => length - rng.range(0, length.min(3)),
            _ => rng.range(0, length),
        };
        let opposite = [any(width), any(height)];
        let two_corners = [[0, 0], [width, height], opposite];
        let one_corner = [[0, 0], [width, opposite[1]], [opposite[0], height]];
        let tri = if rng.one_in(2) { two_corners } else { one_corner };
        let mirror = [rng.one_in(2), rng.one_in(2)];
        let from = [width, height]
            .map(|length| rng.range((-length / 2).max(-guard), (guard - length).min(guard / 2)));
        let place =
            |c: i64, axis: usize| from[axis] + if mirror[axis] { [width, height][axis] - c } else { c };
        let tri = tri.map(|[x, y]| [place(x, 0), place(y, 1)]);
        if area2(tri) != 0 {
            return tri;
        }
    }
}

/// The columns or rows whose samples lie within the triangle's box.
fn samples(subpixel: Subpixel, tri: Triangle, axis: usize) -> std::ops::Range<i32> {
    let (mut low, mut high) = (i64::MAX, i64::MIN);
    for p in tri {
        (low, high) = (low.min(p[axis]), high.max(p[axis]));
    }
    let [one, half] = steps(subpixel);
    let ceil = |n: i64| -(-n).div_euclid(one);
    ceil(low - half) as i32..((high - half).div_euclid(one) + 1) as i32
}

fn within(rng: &mut Rng, range: &std::ops::Range<i32>) -> i32 {
    rng.range(i64::from(range.start), i64::from(range.end) - 1) as i32
}
