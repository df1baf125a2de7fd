mod folds;
mod shared_edges;

use super::*;
use alberti_math::{Flat, blend2};
use alberti_oracle::coverage::{area2, covers};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::clip_near_far;
use core::cell::Cell;
use std::vec::Vec;

#[test]
fn any_rotation_becomes_the_same_one() {
    let v = |x, y, z| Point3::new(Vec3::new(x, y, z));
    for [a, b, c] in [
        [v(0.0, 0.0, 1.0), v(1.0, 0.0, 2.0), v(0.0, 1.0, 3.0)],
        [v(0.0, 0.0, 1.0), v(1.0, 0.0, 1.0), v(0.0, 1.0, 1.0)],
        [v(0.0, 0.0, 3.0), v(1.0, 0.0, 1.0), v(0.0, 1.0, 2.0)],
    ] {
        let canonical = |triangle| rotated(triangle, first_of(triangle));
        assert_eq!(canonical([a, b, c]), canonical([b, c, a]));
        assert_eq!(canonical([a, b, c]), canonical([c, a, b]));
    }
}

/// On an edge the third vertex plays no part, wherever it stands in the order, and neither does the direction.
#[test]
fn edges_know_nothing_of_the_third_vertex() {
    let mut noise = 1u32;
    let mut next = || {
        noise = noise.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        f32::from_bits(0x3f80_0000 | noise >> 9) - 1.0
    };
    for _ in 0..100_000 {
        let [a, b, c, other, t] = [(); 5].map(|()| next() * 100.0 - 50.0);
        let t = (t / 100.0).abs();
        let [wa, wb] = [t, 1.0 - t];
        let blended = blend2([wa, wb], [a, b]);
        for found in [
            weighted(c, &[a, b, c], Vec3::new(wa, wb, 0.0)),
            weighted(c, &[b, other, a], Vec3::new(wb, 0.0, wa)),
            weighted(c, &[c, a, b], Vec3::new(0.0, wa, wb)),
            weighted(Linear(c), &[a, b, c].map(Linear), (Vec3::Z, Linear(Vec3::new(wa, wb, 0.0)))).0,
        ] {
            assert_eq!(found.to_bits(), blended.to_bits());
        }
        assert_eq!(weighted(Flat(c), &[a, b, c].map(Flat), Vec3::new(wa, wb, 0.0)), Flat(c));
        // Ends that carry the same are held to it, whatever the third vertex carries.
        for found in [
            weighted(c, &[a, a, c], Vec3::new(wa, wb, 0.0)),
            weighted(c, &[a, other, a], Vec3::new(wb, 0.0, wa)),
            weighted(c, &[c, a, a], Vec3::new(0.0, wa, wb)),
        ] {
            assert_eq!(found.to_bits(), a.to_bits());
        }
    }
}

/// Polygons with a corner on the line between its neighbours, but for the step to which it is snapped. Their fans have
/// no sample twice; those around the first vertex often would.
#[test]
fn fans_are_not_turned_over() {
    let mut rng = Rng::stream(run_seed(), 9);
    // The rest of a triangle with one corner behind a plane.
    let [a, b, c] = [(0.0, -2.0), (1.0, 2.0), (2.0, 2.0)].map(|(x, z)| Point3::new(Vec3::new(x, 0.0, z)));
    let four = clip_near_far([a, b, c].map(|position| EyeVertex { position, varying: () }), 1.0, 9.0);
    assert_eq!(four.vertices().len(), 4);
    let (mut folded, mut crossed) = (0, 0);
    for _ in 0..3_000 {
        let mut corner = || [(); 2].map(|()| rng.range(0, 60));
        let [a, b, c] = [corner(), corner(), corner()];
        let share = rng.range(0, 8);
        let between = [0, 1].map(|k| (b[k] * share + c[k] * (8 - share)) / 8 + rng.range(-1, 1));
        let mut corners = [a, b, between, c];
        corners.rotate_left(rng.index(4));
        let number = Cell::new(0);
        let places = four.map(|_| {
            let corner = corners.get(number.replace(number.get() + 1)).copied().unwrap_or_default();
            corner.map(|c| i32::try_from(c).expect("small"))
        });
        let parts = |number| -> Vec<[[i64; 2]; 3]> {
            places.fan_around(number).map(|fan| fan.map(|corner| corner.map(i64::from))).collect()
        };
        let is_folded = |number| {
            let signs: Vec<_> = parts(number).into_iter().map(|part| area2(part).signum()).collect();
            signs.contains(&1) && signs.contains(&-1)
        };
        if (0..4).all(is_folded) {
            // Two sides cross, so that it is no polygon.
            crossed += 1;
            continue;
        }
        folded += u32::from(is_folded(0));
        let parts = parts(unfolded(&places));
        for sample in (0..61 * 61).map(|i| [i % 61, i / 61]) {
            let times = parts.iter().filter(|part| covers(**part, sample)).count();
            assert!(times <= 1, "{corners:?} at {sample:?}");
        }
    }
    assert!(folded > 400 && crossed < folded, "{folded} around the first, {crossed} crossed");
}
