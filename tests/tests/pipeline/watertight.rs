//! Meshes without gaps and without double pixels: every sample of a frame belongs to exactly one triangle of a mesh
//! that covers it, whether the mesh is drawn as it is or clipped on the way.
//!
//! As many fragments as pixels, and every pixel written, is every pixel exactly once. Both grids are drawn by one
//! kernel.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "indices and lattice positions are small"
)]

use alberti::glam::Vec3;
use alberti::{
    Affine, Camera, Cull, FixedPoint, Frame, IntegerMesh, IntegerVertex, Mesh, NoDepth, Pass, Perspective,
    Rgba8, Rgba8888, Sides, Slot, Stats, Subpixel, Target, View,
};
use alberti_oracle::coverage::{area2, weights};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::probe::{bare, draw_widest, steps};
use std::collections::HashMap;
use std::f64::consts::PI;

const WIDTH: usize = 640;
const HEIGHT: usize = 480;

/// A frame in which every pixel is to be written once.
struct Frame640 {
    color: Vec<u32>,
    depth: Vec<()>,
}

impl Frame640 {
    fn new() -> Self {
        Self { color: vec![0; WIDTH * HEIGHT], depth: vec![(); WIDTH * HEIGHT] }
    }

    fn target(&mut self) -> Target<'_, Rgba8888, NoDepth> {
        self.color.fill(0);
        let (width, height) = (WIDTH as u32, HEIGHT as u32);
        Target::new(Rgba8888, NoDepth, width, height, &mut self.color, &mut self.depth).expect("a frame")
    }

    /// Each pixel was written exactly once, by `fragments` fragments.
    fn assert_once(&self, fragments: u64, what: &dyn Fn() -> String) {
        let empty = self.color.iter().position(|&pixel| pixel == 0);
        if let Some(pixel) = empty {
            panic!("a hole at {}, {} in {}", pixel % WIDTH, pixel / WIDTH, what());
        }
        assert_eq!(fragments, (WIDTH * HEIGHT) as u64, "pixels drawn twice in {}", what());
    }
}

/// Where the vertices of a triangulation may lie, in subpixels.
#[derive(Clone, Copy, Debug)]
enum Lattice {
    /// Anywhere.
    Fine,
    /// On the sixteenths of a pixel.
    Sixteenths,
    /// On half pixels, where the samples are.
    Halves,
}

#[test]
fn jittered_grids_with_four_bits() {
    grids(Subpixel::Sub4, 4);
}

#[test]
fn jittered_grids_with_eight_bits() {
    grids(Subpixel::Sub8, 8);
}

fn grids(subpixel: Subpixel, stream: u64) {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut frame = Frame640::new();
    let [one, half] = steps(subpixel);
    let (mut triangles, mut at_vertices, mut on_edges) = (0u64, 0u64, 0u64);
    for i in 0..210 {
        let lattice = [Lattice::Fine, Lattice::Sixteenths, Lattice::Halves][i % 3];
        let cell = rng.range(4, 20);
        let stretched = i % 2 == 0;
        let mesh = grid(subpixel, &mut rng, cell, lattice, stretched);
        let mut stats = Stats::default();
        let mut target = frame.target();
        for &tri in &mesh {
            // A triangulation whose triangles all run the same way round does not fold.
            assert!(area2(tri) > 0, "{tri:?}");
            let [a, b, c] = bare(tri);
            let white = |()| Some(Rgba8::WHITE);
            draw_widest(subpixel, &mut target, [&a, &b, &c], Cull::None, white, &mut stats);
            let sample = tri[1].map(|c| c.div_euclid(one) * one + half);
            at_vertices += u64::from(tri[1] == sample);
            on_edges += u64::from(tri[1] != sample && weights(tri, sample).contains(&0));
        }
        triangles += mesh.len() as u64;
        frame.assert_once(stats.fragments, &|| format!("grid {i}: {lattice:?} cells of {cell}"));
    }
    println!("{triangles} triangles, {at_vertices} corners on a sample, {on_edges} edges through one");
    assert!(at_vertices * 20 > triangles && on_edges * 50 > triangles);
}

/// Triangles, clockwise on the screen, over a frame and a margin. `stretched` pulls the outermost vertices far away.
fn grid(
    subpixel: Subpixel,
    rng: &mut Rng,
    cell: i64,
    lattice: Lattice,
    stretched: bool,
) -> Vec<[[i64; 2]; 3]> {
    let [one, _] = steps(subpixel);
    let step = match lattice {
        Lattice::Fine => 1,
        Lattice::Sixteenths => (one / 16).max(1),
        Lattice::Halves => one / 2,
    };
    let [columns, rows] = [WIDTH, HEIGHT].map(|n| n as i64 / cell + 5);
    // A jitter below a quarter of a cell keeps every quadrilateral convex, so both of its diagonals are inside.
    let most = (cell * one / 4 - 1) / step;
    let mut points = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let mut at = |i: i64| (i - 2) * cell * one + rng.range(-most, most) * step;
            let mut p = [at(column), at(row)];
            if stretched && (column % columns == 0 || row % rows == 0) {
                let center = [WIDTH, HEIGHT].map(|n| n as i64 * one / 2);
                let plain = [(column - 2) * cell * one, (row - 2) * cell * one];
                p = [0, 1].map(|k| center[k] + (plain[k] - center[k]) * 40);
            }
            points.push(p);
        }
    }
    let at = |column: i64, row: i64| points[(row * (columns + 1) + column) as usize];
    let mut triangles = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [at(column, row), at(column + 1, row)];
            let [d, c] = [at(column, row + 1), at(column + 1, row + 1)];
            triangles.extend(if rng.one_in(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    triangles
}

/// A closed surface around the origin, seen from there: each direction meets it once.
struct Shell {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Shell {
    /// A cube's surface with `n` x `n` cells a side, jittered along the surface and in its distance by `bumps`.
    fn new(rng: &mut Rng, n: i64, bumps: f64) -> Self {
        let mut shell = Self { vertices: Vec::new(), triangles: Vec::new() };
        let mut known = HashMap::new();
        for axis in 0..3 {
            for side in [0, n] {
                for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
                    let mut at = |i: i64, j: i64| {
                        let mut lattice = [0; 3];
                        (lattice[axis], lattice[(axis + 1) % 3], lattice[(axis + 2) % 3]) = (side, i, j);
                        *known.entry(lattice).or_insert_with(|| {
                            shell.vertices.push(jittered(rng, lattice, n, bumps));
                            shell.vertices.len() as u32 - 1
                        })
                    };
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    let diagonal =
                        if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                    shell.triangles.extend(diagonal);
                }
            }
        }
        shell
    }
}

fn jittered(rng: &mut Rng, lattice: [i64; 3], n: i64, bumps: f64) -> Vec3 {
    let on_cube = lattice.map(|i| {
        let inner = i % n != 0;
        let jitter = if inner { rng.uniform(-0.2, 0.2) } else { 0.0 };
        (2.0 * (i as f64 + jitter) / n as f64 - 1.0) as f32
    });
    Vec3::from_array(on_cube) * rng.uniform(1.0 - bumps, 1.0 + bumps) as f32
}

#[test]
fn closed_shells_clipped_at_the_guard_band() {
    shells(Subpixel::Sub8, Sides::GuardBand, 21, draw_floats);
    shells(Subpixel::Sub4, Sides::GuardBand, 22, draw_floats);
}

#[test]
fn closed_shells_clipped_at_the_sides() {
    shells(Subpixel::Sub8, Sides::Cube, 23, draw_floats);
    shells(Subpixel::Sub4, Sides::Cube, 24, draw_floats);
}

/// Clipped vertices come from floats, the others from integers: edges between the two must not part.
#[test]
fn closed_shells_of_integers() {
    for (sides, stream) in [(Sides::GuardBand, 25), (Sides::Cube, 26)] {
        shells(Subpixel::Sub8, sides, stream, draw_integers);
        shells(Subpixel::Sub4, sides, stream + 2, draw_integers);
    }
}

fn draw_floats(
    shell: &Shell,
    view: &View,
    (subpixel, sides): (Subpixel, Sides),
    target: &mut Target<'_, Rgba8888, NoDepth>,
) -> Stats {
    let mesh = Mesh::new(&shell.vertices, &shell.triangles, |&p| (p, ()));
    let pass = Pass::new(view, &mesh, |()| Some(Rgba8::WHITE));
    pass.cull(Cull::None).sides(sides).subpixel(subpixel).draw_counted(target)
}

fn draw_integers(
    shell: &Shell,
    view: &View,
    (subpixel, sides): (Subpixel, Sides),
    target: &mut Target<'_, Rgba8888, NoDepth>,
) -> Stats {
    let unit = 1.0 / 16384.0;
    let mesh = IntegerMesh::new(&shell.vertices, &shell.triangles, unit, |&p: &Vec3| IntegerVertex::<()> {
        place: p.to_array().map(|c| (c / unit).round() as i16),
        components: (),
    });
    let pass = Pass::new(view, &mesh, |()| Some(Rgba8::WHITE)).interpolation(FixedPoint(Affine));
    pass.cull(Cull::None).sides(sides).subpixel(subpixel).draw_counted(target)
}

/// A way to draw.
type Draw = fn(&Shell, &View, (Subpixel, Sides), &mut Target<'_, Rgba8888, NoDepth>) -> Stats;

fn shells(subpixel: Subpixel, sides: Sides, stream: u64, draw: Draw) {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut frame = Frame640::new();
    let mut all = Stats::default();
    for i in 0..400 {
        // A bumpy shell hides nothing from its middle, a plain cube nothing from anywhere within. Close to a wall its
        // triangles reach from far beside the eye, through the near plane and the guard band, to far before it.
        let bumpy = i % 4 == 0;
        let n = if bumpy { [1, 2, 3, 5, 16][i / 4 % 5] } else { 1 + i as i64 % 2 };
        let (bumps, roam) = if bumpy { (0.3, 0.0) } else { (0.0, 0.96) };
        let shell = Shell::new(&mut rng, n, bumps);
        let view = any_view(&mut rng, roam);
        let stats = draw(&shell, &view, (subpixel, sides), &mut frame.target());
        frame.assert_once(stats.fragments, &|| format!("shell {i} of {n}: {stats:?}, {view:?}"));
        all.submitted += stats.submitted;
        all.clipped += stats.clipped;
        all.dropped += stats.dropped;
        all.drawn += stats.drawn;
        all.fragments += stats.fragments;
        all.written += stats.written;
    }
    println!("{sides:?}, {} bits: {all:?}", subpixel.bits());
    assert!(all.clipped > 600 && all.dropped > 10_000 && all.drawn > 10_000, "{all:?}");
}

/// From within `roam` of the origin in any direction; the near plane so close that what is seen lies beyond it.
fn any_view(rng: &mut Rng, roam: f64) -> View {
    let mut any = |size: f64| Vec3::from_array([(); 3].map(|()| rng.uniform(-size, size) as f32));
    let (eye, toward, up) = (any(roam), any(1.0), any(1.0));
    let near = rng.log_uniform(1e-6, 0.01);
    let angle = rng.uniform(PI / 6.0, PI / 1.8) as f32;
    let camera = Camera::look_at(eye, eye + toward, up).expect("a direction");
    camera.perspective(angle, near..10.0).expect("a pyramid")
}

/// Two triangles on either side of an edge that ends within a pixel of the guard band's: one of them is cut there
/// because of its third vertex, and the edge must be cut alike in the other.
#[test]
fn an_edge_that_ends_at_the_guard_band_is_cut_in_both_triangles_or_in_neither() {
    let mut rng = Rng::stream(run_seed(), 77);
    let projection = Perspective::new(std::f32::consts::FRAC_PI_2, 4.0 / 3.0, 1.0, 100.0);
    let view = View::new(Frame::IDENTITY, projection.expect("a pyramid"));
    let mut covered = 0;
    for i in 0..4000 {
        // At depth 2, a scaled x of 0.75 x and a viewport of 640 columns about 320.
        let at_column = |column: f64| ((column - 320.0) / 320.0 * 2.0 / 0.75) as f32;
        let end = Vec3::new(at_column(rng.uniform(32766.5, 32768.5)), rng.uniform(-90.0, 90.0) as f32, 2.0);
        let start = Vec3::new(rng.uniform(-2.6, 2.6) as f32, rng.uniform(-2.0, 2.0) as f32, 2.0);
        let above = end + Vec3::new(230.0, 170.0, 0.0);
        let below = end - Vec3::new(1.0, 125.0, 0.0);
        let mut frame = Frame640::new();
        let vertices = [end, start, above, below];
        let mesh = Mesh::new(&vertices, &[[0u16, 1, 2], [1, 0, 3]], |&p| (p, ()));
        let mut slots = [Slot::EMPTY; 4];
        let stats = Pass::new(&view, &mesh, |()| Some(Rgba8::WHITE))
            .cull(Cull::None)
            .slots(&mut slots)
            .draw_counted(&mut frame.target());
        let pixels = frame.color.iter().filter(|&&pixel| pixel != 0).count() as u64;
        assert_eq!(stats.fragments, pixels, "pixels drawn twice in pair {i}: {end} {start} {above} {below}");
        covered += pixels;
    }
    assert!(covered > 10_000_000, "next to nothing was drawn");
}
