//! Tests of triangulation against the shoelace formula and crossing numbers.

use super::*;

type Outline = Vec<[f64; 2]>;

fn shoelace(outline: &[[f64; 2]]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>() / 2.0
}

/// Whether a point is inside, by the number of edges to its right.
fn inside(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = outline.iter().cycle().skip(1);
    let crossed = outline
        .iter()
        .zip(next)
        .filter(|(a, b)| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    crossed.count() % 2 == 1
}

fn of(radius: f64, turns: f64) -> [f64; 2] {
    let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
    [radius * cos, radius * sin]
}

/// `n` points on a circle, from the first to the first again.
fn circle(n: u32, radius: f64) -> Outline {
    (0..=n).map(|i| of(radius, f64::from(i) / f64::from(n))).collect()
}

fn star(points: u32, inner: f64) -> Outline {
    (0..2 * points)
        .map(|i| of(if i % 2 == 0 { 1.0 } else { inner }, f64::from(i) / f64::from(2 * points)))
        .collect()
}

fn band(steps: u32, turns: f64, radius: impl Fn(f64) -> f64, width: f64) -> Outline {
    let at = |i: u32, out: f64| {
        of(radius(f64::from(i) / f64::from(steps)) + out, turns * f64::from(i) / f64::from(steps))
    };
    (0..=steps).map(|i| at(i, width)).chain((0..=steps).rev().map(|i| at(i, 0.0))).collect()
}

fn ring(outer: u32, inner: u32) -> Outline {
    circle(outer, 2.0).into_iter().chain(circle(inner, 1.0).into_iter().rev()).collect()
}

/// A rectangle with rectangular holes in a row, each bridged to its lower side.
fn holes(count: u32) -> Outline {
    let width = f64::from(count) * 3.0 + 1.0;
    let mut outline = vec![[0.0, 4.0], [0.0, 0.0]];
    for i in 0..count {
        let (x, y) = (1.0 + 3.0 * f64::from(i), 1.0 + f64::from(i % 2));
        outline.push([x, 0.0]);
        outline.extend([[x, y], [x, y + 1.0], [x + 2.0, y + 1.0], [x + 2.0, y], [x, y]]);
        outline.push([x, 0.0]);
    }
    outline.extend([[width, 0.0], [width, 4.0]]);
    outline
}

fn comb(teeth: u32) -> Outline {
    let mut outline: Outline = (0..teeth)
        .flat_map(|i| {
            let x = f64::from(2 * i);
            [[x, 0.1], [x, 5.0], [x + 1.0, 5.0], [x + 1.0, 0.1]]
        })
        .collect();
    outline.extend([[f64::from(2 * teeth), 0.0], [-1.0, 0.0]]);
    outline.reverse();
    outline
}

fn samples() -> Vec<(&'static str, Outline)> {
    let l = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    let collinear =
        vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]];
    let mut doubled: Outline = star(5, 0.4).into_iter().flat_map(|point| [point; 2]).collect();
    doubled.push(doubled[0]);
    vec![
        ("square", vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
        ("dart", vec![[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]]),
        ("l", l),
        ("collinear", collinear),
        ("doubled", doubled),
        ("star", star(5, 0.3)),
        ("sharp star", star(40, 0.05)),
        ("c", band(30, 0.8, |_| 0.6, 0.4)),
        ("spiral", band(400, 5.0, |t| 1.0 + 5.0 * t, 0.5)),
        ("ring", ring(24, 24)),
        ("uneven ring", ring(7, 61)),
        ("thin ring", { circle(50, 1.0).into_iter().chain(circle(50, 0.999).into_iter().rev()).collect() }),
        ("one hole", holes(1)),
        ("four holes", holes(4)),
        ("comb", comb(30)),
        // Out to a point and back by the same way.
        ("antenna", vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [3.0, 2.0], [1.0, 1.0], [0.0, 1.0]]),
        ("slit", vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 4.0], [2.0, 1.0], [2.0, 4.0], [0.0, 4.0]]),
    ]
}

/// The area of each triangle, which must be turned as the outline is and cover what it does.
fn check(name: &str, outline: &[[f64; 2]]) {
    let points: Vec<_> = outline.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let mut triangles = Vec::new();
    assert!(triangulate(&points, &mut triangles), "{name}");
    assert_eq!(triangles.len(), points.len() - 2, "{name}");
    let whole = shoelace(outline);
    let pieces: Vec<Outline> = triangles.iter().map(|t| t.map(|i| outline[i as usize]).to_vec()).collect();
    let areas: Vec<f64> = pieces.iter().map(|piece| shoelace(piece)).collect();
    assert!(areas.iter().all(|area| area * whole > -1e-12), "{name} {areas:?}");
    assert!((areas.iter().sum::<f64>() - whole).abs() < 1e-9 * whole.abs(), "{name}");
    let mut state = 0x2545_f491_u32;
    let mut random = |low: f64, high: f64| {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        low + (high - low) * f64::from(state) / f64::from(u32::MAX)
    };
    let bound = |axis: usize, f: fn(f64, f64) -> f64| outline.iter().map(|p| p[axis]).reduce(f).unwrap();
    for _ in 0..500 {
        let point =
            [random(bound(0, f64::min), bound(0, f64::max)), random(bound(1, f64::min), bound(1, f64::max))];
        let covering = pieces.iter().filter(|piece| inside(piece, point)).count();
        assert_eq!(covering, usize::from(inside(outline, point)), "{name} at {point:?}");
    }
}

#[test]
fn triangles_cover_the_polygon_once() {
    for (name, outline) in samples() {
        check(name, &outline);
        let mirrored: Outline = outline.iter().map(|&[x, y]| [-x, y]).collect();
        check(name, &mirrored);
        // From any corner on.
        for shift in 1..outline.len().min(12) {
            let mut turned = outline.clone();
            turned.rotate_left(shift);
            check(name, &turned);
        }
    }
}

#[test]
fn random_outlines_are_covered_once() {
    let mut state = 0x9e37_79b9_u32;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        f64::from(state) / f64::from(u32::MAX)
    };
    for corners in 4_u32..200 {
        // Seen from the middle, corners are in order, so edges cannot cross.
        let outline: Outline = (0..corners)
            .map(|i| of(0.1 + random(), (f64::from(i) + 0.5 * random()) / f64::from(corners)))
            .collect();
        check("random", &outline);
    }
}

#[test]
fn convex_polygons_are_fans() {
    for corners in 3_u32..20 {
        let mut outline = circle(corners, 1.0);
        outline.pop();
        let points: Vec<_> = outline.iter().map(|&[x, y]| [y, 5.0, x]).collect();
        let mut triangles = Vec::new();
        assert!(triangulate(&points, &mut triangles));
        assert_eq!(triangles, (1..corners - 1).map(|i| [0, i, i + 1]).collect::<Vec<_>>());
    }
}

#[test]
fn planes_may_be_tilted_and_far_away() {
    let axes = [[1.0, 2.0, 3.0], [-1.0, 0.1, 0.2], [0.3, -5.0, 0.1], [0.0, 0.0, -1.0], [1.0, -1.0, 0.0]];
    for (name, outline) in samples() {
        for axis in axes {
            let normal = normalize(axis).unwrap();
            let u = normalize(cross(normal, [0.31, 0.87, 0.12])).unwrap();
            let v = cross(normal, u);
            for origin in [[0.0; 3], [5e5, 120.0, -4e6]] {
                let place = |&[x, y]: &[f64; 2]| [0, 1, 2].map(|k| origin[k] + u[k] * x + v[k] * y);
                let points: Vec<_> = outline.iter().map(place).collect();
                let mut triangles = Vec::new();
                // Rounding moves the ends of slits and of thin rings.
                let exact = origin[0] < 1.0 && !["slit", "antenna", "collinear"].contains(&name);
                assert!(triangulate(&points, &mut triangles) || !exact, "{name}");
                let area = |t: &[u32; 3]| {
                    let [a, b, c] = t.map(|i| points[i as usize]);
                    let across = cross(sub(b, a), sub(c, a));
                    (dot(across, normal) / 2.0, length(across) / 2.0)
                };
                let (signed, unsigned) =
                    triangles.iter().map(area).fold((0.0, 0.0), |sum, area| (sum.0 + area.0, sum.1 + area.1));
                let whole = shoelace(&outline);
                assert!((signed - whole).abs() < 1e-6 * whole.abs(), "{name} {signed} {whole}");
                assert!((unsigned - whole.abs()).abs() < 1e-6 * whole.abs(), "{name} {unsigned} {whole}");
            }
        }
    }
}

#[test]
fn what_crosses_itself_is_told() {
    let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let pentagram: Vec<_> = (0..5).map(|i| of(1.0, 0.4 * f64::from(i))).collect();
    let fish = [[0.0, 0.0], [4.0, 3.0], [4.0, 0.0], [0.0, 1.0]];
    for outline in [&bow[..], &pentagram, &fish] {
        let points: Vec<_> = outline.iter().map(|&[x, y]| [x, y, 1.0]).collect();
        let mut triangles = Vec::new();
        assert!(!triangulate(&points, &mut triangles), "{outline:?}");
        assert_eq!(triangles.len(), points.len() - 2);
    }
}

#[test]
fn what_has_no_area_gets_as_many_triangles() {
    for points in [vec![[1.0; 3]; 7], (0..9).map(|i| [f64::from(i), 2.0, 0.0]).collect()] {
        let mut triangles = Vec::new();
        assert!(triangulate(&points, &mut triangles));
        assert_eq!(triangles.len(), points.len() - 2);
    }
}

#[test]
fn large_polygons_end() {
    let small_hole = circle(50_000, 2.0).into_iter().chain(circle(50_000, 0.01).into_iter().rev()).collect();
    for outline in [
        comb(25_000),
        band(50_000, 20.0, |t| 1.0 + 20.0 * t, 0.5),
        ring(50_000, 50_000),
        small_hole,
        ring(100, 90_000),
        star(50_000, 0.9),
    ] {
        let points: Vec<_> = outline.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        let mut triangles = Vec::new();
        assert!(triangulate(&points, &mut triangles));
        let area = |t: &[u32; 3]| shoelace(&t.map(|i| outline[i as usize]));
        let whole = shoelace(&outline);
        assert!(
            (triangles.iter().map(area).map(f64::abs).sum::<f64>() - whole.abs()).abs() < 1e-6 * whole.abs()
        );
    }
    // Random corners cross each other everywhere.
    let mut state = 1_u32;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        f64::from(state)
    };
    let points: Vec<_> = (0..30_000).map(|_| [random(), random(), 0.0]).collect();
    let mut triangles = Vec::new();
    assert!(!triangulate(&points, &mut triangles));
    assert_eq!(triangles.len(), points.len() - 2);
}

/// A skew quad of a rough field, whose outline crosses itself on the plane of y and z alone.
#[test]
fn four_corners_out_of_a_plane_are_two_triangles() {
    let quad = [[0.0, 0.0, 5.0], [1.0, 0.0, 0.0], [1.0, 1.0, 2.0], [0.0, 1.0, 1.0]];
    for turned in 0..4 {
        let mut corners = quad;
        corners.rotate_left(turned);
        let mut triangles = Vec::new();
        assert!(triangulate(&corners, &mut triangles));
        // Seen from above it is a square, and both face upwards.
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|k| corners[k as usize]);
            cross(sub(b, a), sub(c, a))[2] / 2.0
        };
        assert_eq!(triangles.iter().map(area).collect::<Vec<_>>(), [0.5, 0.5], "{triangles:?}");
    }
    // A bow tie in a plane is one, however it lies.
    let bow = [[0.0, 0.0, 1.0], [1.0, 1.0, 3.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    assert!(!triangulate(&bow, &mut Vec::new()));
}
