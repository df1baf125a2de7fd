mod shared_edges;

use super::*;
use alberti_math::{Flat, blend2};

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
            weighted(c, [a, b, c], Vec3::new(wa, wb, 0.0)),
            weighted(c, [b, other, a], Vec3::new(wb, 0.0, wa)),
            weighted(c, [c, a, b], Vec3::new(0.0, wa, wb)),
        ] {
            assert_eq!(found.to_bits(), blended.to_bits());
        }
        assert_eq!(weighted(Flat(c), [a, b, c].map(Flat), Vec3::new(wa, wb, 0.0)), Flat(c));
    }
}
