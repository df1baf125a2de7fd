//! Vertices at a plane, an ulp to each side of it, and in doubt about it: near, far, sides and guard band, for floats
//! and integers. The fan around such vertices has neither a hole nor a pixel that is drawn twice, and ends where exact
//! integers say.
//!
//! ```text
//!       1 ----- 0         ring vertices and the hub are on planes or beside them
//!      /  \   /  \
//!     2 --- hub -- 5      a pixel on a spoke belongs to one of two triangles
//!      \  /   \  /
//!       3 ----- 4         the outline is where the ring or a plane cuts the fan off
//! ```
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and lattice positions are small; f64 become the f32 that are drawn"
)]

use crate::divisions::{Arithmetic, Division, Memory, Scene, all_arithmetic, picture};
use alberti::glam::Vec3;
use alberti::{
    AnyDepth, AnyProjection, Frame, Parallel, Perspective, Point3, Projection, Sides, Subpixel, View,
    Viewport,
};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::sweep::or_swept;
use std::f64::consts::TAU;

/// Columns and rows of the frame.
const SIDE: i32 = 64;
/// The step of half words, and the one of places that half words and a frame make together: an ulp below 8.
const UNIT: f32 = 1.0 / 4096.0;
const ULP: f32 = 1.0 / 2_097_152.0;
/// The step of the exact integers: an ulp from 1/2 on.
const LATTICE: f64 = 16_777_216.0;
const PLANES: [f32; 2] = [1.0, 4.0];

/// A plane, about which the vertices of a fan are in doubt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    Near,
    Far,
    Sides,
    Guard,
}

/// A fan in space: the hub is vertex 0.
#[derive(Debug)]
struct Fan {
    at: At,
    projection: AnyProjection,
    viewport: [i32; 4],
    sides: Sides,
    subpixel: Subpixel,
    /// The frame's origin.
    origin: Vec3,
    /// Before the frame.
    vertices: Vec<Vec3>,
}

impl Fan {
    fn any(rng: &mut Rng, at: At, integers: bool) -> Self {
        let viewport = match (at, rng.index(3)) {
            (At::Guard, _) | (_, 0) => [-990, -1003, 2048, 2048],
            (_, 1) => [5, 3, 41, 52],
            _ => [0, 0, SIDE, SIDE],
        };
        // At the guard band of integers, whose x is at most 8, depths are small.
        let planes = if at == At::Guard { [0.125, 4.0] } else { PLANES };
        let projection: AnyProjection = if rng.one_in(3) && !(integers && at == At::Guard) {
            Parallel::new(2.0, 1.0, planes[0], planes[1]).expect("a box").into()
        } else {
            Perspective::new(std::f32::consts::FRAC_PI_2, 1.0, planes[0], planes[1])
                .expect("a pyramid")
                .into()
        };
        let doubt = |rng: &mut Rng| {
            let size = [0, 1, 2, rng.log_integer(300)][rng.index(4)];
            (if rng.one_in(2) { size } else { -size }) as f32 * ULP
        };
        let mut origin = Vec3::ZERO;
        if integers {
            let z = doubt(rng);
            // So that x is z, or an ulp beside it.
            origin = Vec3::new(z + doubt(rng).clamp(-ULP, ULP), -z, z);
        }
        let mut fan = Self {
            at,
            projection,
            viewport,
            sides: if at == At::Sides || rng.one_in(4) { Sides::Cube } else { Sides::GuardBand },
            subpixel: if rng.one_in(2) { Subpixel::Sub4 } else { Subpixel::Sub8 },
            origin,
            vertices: Vec::new(),
        };
        let corners = 5 + rng.index(4);
        let middle = fan.cube([SIDE / 2; 2].map(f64::from));
        let half = f64::from(SIDE) / f64::from(viewport[2]);
        let hub = middle.map(|c| c + half * rng.uniform(-0.3, 0.3));
        fan.add(rng, hub, integers, false);
        for corner in 0..corners {
            let angle = (corner as f64 + rng.uniform(-0.25, 0.25)) / corners as f64 * TAU;
            let direction = [angle.cos(), angle.sin()];
            let mut away = f64::from(rng.log_uniform(0.3, 3.0)) * half;
            let bound = fan.bound();
            let beside = bound.is_finite() && rng.one_in(2);
            if beside {
                let axis = usize::from(direction[1].abs() > direction[0].abs());
                away = (bound.copysign(direction[axis]) - hub[axis]) / direction[axis];
            }
            fan.add(rng, [0, 1].map(|k| hub[k] + direction[k] * away), integers, beside);
        }
        fan
    }

    /// The place on the cube of a pixel's corner.
    fn cube(&self, pixel: [f64; 2]) -> [f64; 2] {
        let [x, y, width, height] = self.viewport.map(f64::from);
        [(pixel[0] - x) * 2.0 / width - 1.0, 1.0 - (pixel[1] - y) * 2.0 / height]
    }

    /// The place on the cube where the plane is.
    fn bound(&self) -> f64 {
        match self.at {
            At::Near | At::Far => f64::INFINITY,
            At::Sides => 1.0,
            At::Guard => {
                let [x, y, width, height] = self.viewport;
                f64::from(Viewport::new(x, y, width as u32, height as u32).expect("a viewport").guard().x)
            }
        }
    }

    /// Adds the vertex that is seen at a place of the cube.
    fn add(&mut self, rng: &mut Rng, [x, y]: [f64; 2], integers: bool, beside: bool) {
        let plane = match self.at {
            At::Near => PLANES[0],
            At::Far => PLANES[1],
            At::Sides => rng.uniform(1.1, 3.9) as f32,
            At::Guard => rng.uniform(0.14, 0.24) as f32,
        };
        let nudged = |rng: &mut Rng, c: f32| [c.next_down(), c, c.next_up()][rng.index(3)];
        let apart = matches!(self.at, At::Near | At::Far) && rng.one_in(3);
        let depth = if apart { plane * rng.uniform(0.75, 1.4) as f32 } else { nudged(rng, plane) };
        let on_grid = |c: f32| (c / UNIT).round() * UNIT;
        let depth = if integers { on_grid(depth) } else { depth };
        let [scale_x, scale_y, _] = self.projection.scale(Point3::new(Vec3::ONE)).coords.to_array();
        let w = if self.projection.is_perspective() { f64::from(depth + self.origin.z) } else { 1.0 };
        let [x, y] = [(x, scale_x, self.origin.x), (y, scale_y, self.origin.y)].map(|(c, scale, origin)| {
            let c = (c * w / f64::from(scale)) as f32;
            if integers {
                return on_grid(c - origin).clamp(-32768.0 * UNIT, 32767.0 * UNIT);
            }
            let c = if beside { nudged(rng, c) } else { c };
            ((f64::from(c) * LATTICE).round() / LATTICE) as f32
        });
        self.vertices.push(Vec3::new(x, y, depth));
    }

    /// The triangles around the hub, those without area left out.
    fn scene(&self) -> Scene {
        let corners = self.vertices.len() as u16 - 1;
        let colored = |&place: &Vec3| (place, Vec3::ONE);
        let triangles = (1..=corners).map(|i| [0, i, i % corners + 1]).collect();
        let [x, y, width, height] = self.viewport;
        let view = View::new(Frame::at(Point3::new(self.origin)), self.projection);
        Scene {
            viewport: Some(Viewport::new(x, y, width as u32, height as u32).expect("a viewport")),
            sides: self.sides,
            subpixel: self.subpixel,
            ..Scene::new(self.vertices.iter().map(colored).collect(), triangles, view)
        }
    }

    /// The triangles by exact integers: scaled, and in units of the lattice.
    fn parts(&self) -> Vec<Part> {
        let exact = |c: f32| (f64::from(c) * LATTICE).round() as i128;
        let perspective = self.projection.is_perspective();
        let corners: Vec<_> = self
            .vertices
            .iter()
            .map(|&place| {
                let [x, y, z] =
                    self.projection.scale(Point3::new(place + self.origin)).coords.to_array().map(exact);
                Corner { place: [x, y, if perspective { z } else { LATTICE as i128 }], z }
            })
            .collect();
        let planes = [self.projection.near(), self.projection.far()].map(exact);
        let count = corners.len() - 1;
        (1..=count)
            .map(|i| Part::new([0, i, i % count + 1].map(|k| corners[k]), planes, self.viewport))
            .collect()
    }
}

/// A vertex before the division: x, y and w, and z.
#[derive(Clone, Copy)]
struct Corner {
    place: [i128; 3],
    z: i128,
}

/// A function of the pixels that is linear, and positive where a triangle is.
struct Bound {
    at: i128,
    steps: [i128; 2],
}

impl Bound {
    /// The values in the middles of the first pixel, of the one to its right, and of the one below it.
    fn new([at, right, below]: [i128; 3]) -> Self {
        Self { at, steps: [right - at, below - at] }
    }

    /// The pixels from a pixel's middle to where it ends.
    fn distance(&self, [x, y]: [i32; 2]) -> f64 {
        let value = self.at + self.steps[0] * i128::from(x) + self.steps[1] * i128::from(y);
        let slope = (self.steps[0] as f64).hypot(self.steps[1] as f64);
        // Of a plane that is level with the picture all is on one side.
        if slope == 0.0 {
            if value >= 0 { f64::INFINITY } else { f64::NEG_INFINITY }
        } else {
            value as f64 / slope
        }
    }
}

/// The bounds of a triangle.
struct Part {
    spokes: [Bound; 2],
    /// The ring's edge, the near plane and the far one.
    others: [Bound; 3],
}

impl Part {
    fn new(corners: [Corner; 3], [near, far]: [i128; 2], viewport: [i32; 4]) -> Self {
        let [left, top, width, height] = viewport.map(i128::from);
        // The ray through a pixel's middle, times the viewport's sides.
        let ray = |[x, y]: [i128; 2]| {
            [(2 * (x - left) + 1 - width) * height, (height - 2 * (y - top) - 1) * width, width * height]
        };
        let rays = [[0, 0], [1, 0], [0, 1]].map(ray);
        let [a, b, c] = corners.map(|corner| corner.place);
        let side = determinant([a, b, c]).signum();
        assert!(side != 0, "a triangle without area");
        // Shares of the three corners in the point that is seen, up to a common factor.
        let shares = rays.map(|ray| [[ray, b, c], [a, ray, c], [a, b, ray]].map(|m| side * determinant(m)));
        let share = |k: usize| Bound::new(shares.map(|shares| shares[k]));
        let beyond = |plane: i128, sign: i128| {
            Bound::new(shares.map(|s| (0..3).map(|k| s[k] * (corners[k].z - plane) * sign).sum()))
        };
        Self { spokes: [share(1), share(2)], others: [share(0), beyond(near, 1), beyond(far, -1)] }
    }
}

fn determinant([a, b, c]: [[i128; 3]; 3]) -> i128 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

#[derive(Debug, Default)]
struct Counts {
    drawn: u64,
    empty: u64,
    doubtful: u64,
    /// Pixels so near to a spoke that snapping decides which triangle they belong to.
    on_spokes: u64,
    clipped: u64,
    /// Fans with a pixel that is drawn twice, next to a plane.
    folded: u64,
}

/// Looks at every pixel of the frame.
fn check(fan: &Fan, arithmetic: Arithmetic, counts: &mut Counts) {
    let divisions = [Division::WHOLE, Division { slots: 9, ..Division::WHOLE }, Division::bands(11)];
    let frame = ([SIDE.unsigned_abs(); 2], AnyDepth::NoDepth);
    let scene = fan.scene();
    let (found, stats) = picture(&scene, arithmetic, divisions[0], frame);
    for division in &divisions[1..] {
        let (other, _) = picture(&scene, arithmetic, *division, frame);
        assert!(other == found, "{division:?}: {arithmetic:?}, {fan:?}");
    }
    // Of one pixel alone, if some are drawn twice: what is cut to less than a step may be turned over by snapping.
    let once = stats.fragments == found.drawn();
    let times = |[x, y]: [i32; 2]| {
        let mut memory = Memory::new(frame.0, frame.0[0] as usize, frame.1);
        let mut pixel = memory.target(frame.1);
        scene.draw(arithmetic, divisions[0], &mut pixel.scissor(x..x + 1, y..y + 1)).fragments
    };
    counts.folded += u64::from(!once);
    counts.clipped += stats.clipped;

    // What snapping and rounding move: a vertex by half a step on each axis, and by a quarter of one of integers.
    let moved = 2.0 / f64::from(1 << fan.subpixel.bits());
    let parts = fan.parts();
    let [left, top, width, height] = fan.viewport;
    for (i, &pixel) in (0i32..).zip(&found.color) {
        let at = [i % SIDE, i / SIDE];
        let visible = (left..left + width).contains(&at[0]) && (top..top + height).contains(&at[1]);
        let near: Vec<_> =
            parts.iter().filter(|part| part.spokes.iter().all(|spoke| spoke.distance(at) > -moved)).collect();
        let least =
            |part: &&Part| part.others.iter().map(|bound| bound.distance(at)).fold(f64::INFINITY, f64::min);
        let within = near.iter().map(least);
        let covered = !near.is_empty() && within.clone().all(|distance| distance > moved);
        let beside = within.clone().all(|distance| distance < -moved);
        let what = || format!("pixel {at:?}: {arithmetic:?}, {fan:?}");
        if !visible || beside {
            assert_eq!(pixel, 0, "{}", what());
            counts.empty += u64::from(visible);
        } else if covered {
            assert_ne!(pixel, 0, "a hole at {}", what());
            assert!(once || times(at) == 1, "drawn twice: {}", what());
            counts.drawn += 1;
            counts.on_spokes += u64::from(near.len() > 1);
        } else {
            counts.doubtful += 1;
        }
    }
}

fn fans(at: At, stream: u64, enough: [u64; 3]) {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut counts = Counts::default();
    for _ in 0..or_swept(80, 2_000) {
        for arithmetic in all_arithmetic(UNIT) {
            let fan = Fan::any(&mut rng, at, matches!(arithmetic, Arithmetic::Integers(..)));
            check(&fan, arithmetic, &mut counts);
        }
    }
    println!("{at:?}: {counts:?}");
    let Counts { drawn, empty, doubtful, on_spokes, clipped, folded } = counts;
    assert!(drawn > enough[0] && on_spokes > enough[1] && clipped > enough[2], "{at:?}: {counts:?}");
    assert!(empty > 10_000 && doubtful * 10 < drawn + empty && folded * 50 < clipped, "{at:?}: {counts:?}");
}

#[test]
fn at_the_near_plane() {
    fans(At::Near, 1, [100_000, 1000, 500]);
}

#[test]
fn at_the_far_plane() {
    fans(At::Far, 2, [100_000, 1000, 500]);
}

#[test]
fn at_the_sides() {
    fans(At::Sides, 3, [100_000, 1000, 200]);
}

#[test]
fn at_the_guard_band() {
    fans(At::Guard, 4, [100_000, 1000, 200]);
}
