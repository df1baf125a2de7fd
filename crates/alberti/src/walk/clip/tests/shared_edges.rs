//! Two triangles that share an edge have the same new vertices on it, bit for bit, whatever their third vertices are
//! and whatever else they carry. The edge is cut by the near plane, the far plane or a side of the view.

use super::super::*;
use crate::walk::{Fate, Walk};
use crate::{AnyDepth, Cull, Exact, Linear, Mesh, Pass, Perspective, Sub8, View};
use alberti_math::{Flat, Frame};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::Paint;
use core::f32::consts::FRAC_PI_2;
use core::fmt::Debug;
use std::collections::BTreeSet;
use std::string::String;
use std::{format, println};

const SIZE: [u32; 2] = [4096; 2];
const NEAR: f64 = 1.0;
const FAR: f64 = 9.0;

/// The planes of the view, each as the part of space beyond it.
#[derive(Clone, Copy, Debug)]
enum Plane {
    Near,
    Far,
    Left,
    Right,
    Below,
    Above,
}

const PLANES: [Plane; 6] = [Plane::Near, Plane::Far, Plane::Left, Plane::Right, Plane::Below, Plane::Above];

/// A place within the view, whose sides are |x| = z and |y| = z.
fn within_all(rng: &mut Rng) -> [f64; 3] {
    let z = rng.uniform(NEAR * 1.05, FAR * 0.95);
    [rng.uniform(-0.95, 0.95) * z, rng.uniform(-0.95, 0.95) * z, z]
}

/// A place beyond one plane, as a rule within the others.
fn beyond(rng: &mut Rng, plane: Plane) -> [f64; 3] {
    let [x, y, z] = within_all(rng);
    let side = rng.uniform(1.01, 4.0) * z;
    match plane {
        // Behind the eye as well.
        Plane::Near => [x, y, rng.uniform(-3.0, 0.99) * NEAR],
        Plane::Far => [x, y, rng.uniform(1.01, 3.0) * FAR],
        Plane::Left => [-side, y, z],
        Plane::Right => [side, y, z],
        Plane::Below => [x, -side, z],
        Plane::Above => [x, side, z],
    }
}

/// A vertex: its place, the number that both triangles carry, and two that only one of them does.
type Carried = (Vec3, f32, [f32; 2]);

#[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
fn carried(rng: &mut Rng, place: [f64; 3]) -> Carried {
    let mut number = || rng.uniform(-9.0, 9.0) as f32;
    (Vec3::from_array(place.map(|c| c as f32)), number(), [number(), number()])
}

/// The vertices of all that clipping leaves of a triangle, as printed up to the first number they carry. `None` if it
/// is not clipped, or a part has no area.
fn clipped<V: Varying + Debug>(
    triangle: [Carried; 3],
    sides: Sides,
    varying: impl Fn(f32, [f32; 2]) -> V,
) -> Option<BTreeSet<String>> {
    let projection = Perspective::new(FRAC_PI_2, 1.0, 1.0, 9.0).expect("a pyramid");
    let view = View::new(Frame::IDENTITY, projection);
    let mesh = Mesh::new(&triangle, &[[0u16, 1, 2]], |&(place, u, others)| (place, varying(u, others)));
    let stage = |_: V| Some(0u32);
    let pass = Pass::new(&view, &mesh, stage).cull(Cull::None).sides(sides);
    let screen = pass.screen(SIZE, AnyDepth::D32).expect("pixels");
    let limits = SIZE.map(|pixels| 0..pixels.cast_signed());
    let mut vertices = BTreeSet::new();
    let mut whole = true;
    let paint = Paint { stage: (), interpolation: Exact, subpixel: Sub8, cull: Cull::None };
    let fate = Walk::new(One, &mesh, &screen, &mut [Slot::EMPTY; 3]).triangle([0, 1, 2], |corners| {
        whole &= paint.reach(corners, &limits).is_ok();
        for corner in corners {
            let printed = format!("{corner:?}");
            let (place, carried) = printed.split_once("components: [").expect("a list");
            let (first, _) = carried.split_once(',').expect("more than one");
            vertices.insert(format!("{place}{first}"));
        }
    });
    (fate == Fate::Clipped && whole).then_some(vertices)
}

/// Compares triangles on both sides of an edge, of which one is walked the other way round, from any vertex.
fn compare(rng: &mut Rng, sides: Sides, edge: [Carried; 2]) -> Option<BTreeSet<String>> {
    let [p, q] = edge;
    let thirds = [(); 2].map(|()| {
        let place = within_all(rng);
        carried(rng, place)
    });
    let mut one = [p, q, thirds[0]];
    // The shared vertices carry the same number, and others beside it.
    let mut two = [q, p, thirds[1]].map(|(place, u, others)| (place, u, others.map(|x| 3.0 - x)));
    one.rotate_left(rng.index(3));
    two.rotate_left(rng.index(3));
    let one = clipped(one, sides, |u, [v, w]| (u, (v, Flat(w))))?;
    let two = clipped(two, sides, |u, [v, _]| (u, Linear(v)))?;
    Some(one.intersection(&two).cloned().collect())
}

#[test]
fn an_edge_that_one_plane_cuts_has_one_new_vertex() {
    let mut rng = Rng::stream(run_seed(), 1);
    for plane in PLANES {
        // The guard band is too far away to be cut here, but near and far are.
        for sides in [Sides::Cube, Sides::GuardBand] {
            if sides == Sides::GuardBand && !matches!(plane, Plane::Near | Plane::Far) {
                continue;
            }
            let mut checked = 0;
            for _ in 0..20_000 {
                let places = [within_all(&mut rng), beyond(&mut rng, plane)];
                let edge = places.map(|place| carried(&mut rng, place));
                let Some(common) = compare(&mut rng, sides, edge) else { continue };
                // The vertex inside, and the new one.
                assert_eq!(common.len(), 2, "{plane:?}, {sides:?}: {edge:?} has {common:?}");
                checked += 1;
            }
            println!("{plane:?}, {sides:?}: {checked} edges");
            assert!(checked > 10_000, "{plane:?}: {checked}");
        }
    }
}

#[test]
fn an_edge_that_two_planes_cut_has_two_new_vertices_or_none() {
    let mut rng = Rng::stream(run_seed(), 2);
    let mut checked = [0; 2];
    for i in 0..60_000 {
        let planes = [PLANES[i % 6], PLANES[i / 6 % 6]];
        let edge = planes.map(|plane| {
            let place = beyond(&mut rng, plane);
            carried(&mut rng, place)
        });
        let Some(common) = compare(&mut rng, Sides::Cube, edge) else { continue };
        assert!([0, 2].contains(&common.len()), "{planes:?}: {edge:?} has {common:?}");
        checked[common.len() / 2] += 1;
    }
    println!("edges out of sight, and through it: {checked:?}");
    assert!(checked.iter().all(|&n| n > 5_000), "{checked:?}");
}
