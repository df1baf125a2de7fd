//! Two triangles that share an edge have the same new vertices on it, bit for bit, when it is cut by the near plane, by
//! the far plane or by a side of the view: whatever their third vertices are, and whatever else they carry.
//!
//! The clipper's vertices are those of [`ScreenTriangle`]s, which print all their numbers so that each is read back as
//! the same `f32`. No kernel is needed: nothing is painted.

use alberti::glam::Vec3;
use alberti::{
    AnyDepth, Cull, Flat, Frame, Linear, Mesh, Pass, Perspective, ScreenTriangle, Sides, Stats, Varying,
    View, Viewport,
};
use alberti_oracle::rng::{Rng, run_seed};
use std::collections::BTreeSet;
use std::fmt::Debug;

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
fn inside(rng: &mut Rng) -> [f64; 3] {
    let z = rng.uniform(NEAR * 1.05, FAR * 0.95);
    [rng.uniform(-0.95, 0.95) * z, rng.uniform(-0.95, 0.95) * z, z]
}

/// A place beyond one plane, as a rule within the others.
fn beyond(rng: &mut Rng, plane: Plane) -> [f64; 3] {
    let [x, y, z] = inside(rng);
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
type Corner = (Vec3, f32, [f32; 2]);

#[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
fn corner(rng: &mut Rng, place: [f64; 3]) -> Corner {
    let mut number = || rng.uniform(-9.0, 9.0) as f32;
    (Vec3::from_array(place.map(|c| c as f32)), number(), [number(), number()])
}

/// The vertices of all that clipping leaves of a triangle, as printed up to the first number they carry; `None` if a
/// part is too small to be kept.
fn clipped<V: Varying + Debug>(
    triangle: [Corner; 3],
    sides: Sides,
    varying: impl Fn(f32, [f32; 2]) -> V,
) -> Option<BTreeSet<String>> {
    let projection = Perspective::new(std::f32::consts::FRAC_PI_2, 1.0, 1.0, 9.0).expect("a pyramid");
    let view = View::new(Frame::IDENTITY, projection);
    let mesh = Mesh::new(&triangle, &[[0u16, 1, 2]], |&(place, u, others)| (place, varying(u, others)));
    let mut room = [ScreenTriangle::EMPTY; 7];
    let mut stats = Stats::default();
    let viewport = Viewport::new(0, 0, SIZE[0], SIZE[1]).expect("a viewport");
    let stage = |_: V| Some(0u32);
    let mut pass = Pass::new(&view, &mesh, stage).cull(Cull::None).sides(sides).viewport(viewport);
    let kept = pass.count_prepare(SIZE, AnyDepth::D32, &mut room, &mut stats).0.kept();
    if stats.culled + stats.missed > 0 || stats.clipped == 0 {
        return None;
    }
    let mut vertices = BTreeSet::new();
    for triangle in &room[..kept] {
        let printed = format!("{triangle:?}");
        for vertex in printed.split("Corner { ").skip(1) {
            let (place, carried) = vertex.split_once("components: [").expect("a list");
            let (first, _) = carried.split_once(',').expect("more than one");
            vertices.insert(format!("{place}{first}"));
        }
    }
    Some(vertices)
}

/// Compares triangles on both sides of an edge, of which one is walked the other way round, from any vertex.
fn compare(rng: &mut Rng, sides: Sides, edge: [Corner; 2]) -> Option<BTreeSet<String>> {
    let [p, q] = edge;
    let thirds = [(); 2].map(|()| {
        let place = inside(rng);
        corner(rng, place)
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
                let places = [inside(&mut rng), beyond(&mut rng, plane)];
                let edge = places.map(|place| corner(&mut rng, place));
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
            corner(&mut rng, place)
        });
        let Some(common) = compare(&mut rng, Sides::Cube, edge) else { continue };
        assert!([0, 2].contains(&common.len()), "{planes:?}: {edge:?} has {common:?}");
        checked[common.len() / 2] += 1;
    }
    println!("edges out of sight, and through it: {checked:?}");
    assert!(checked.iter().all(|&n| n > 5_000), "{checked:?}");
}
