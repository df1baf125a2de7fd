//! Perspective takes lines to lines and planes to planes: what is a mean in space is one on the screen.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "small integers, and the one rounding of a point"
)]

use alberti_math::Point3;
use alberti_math::glam::Vec3;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::{DepthMap, EyeVertex, EyeWeights, Perspective, ProjectedVertex};

const EPS: f64 = 1.0 / (1 << 24) as f64;

/// Weights that sum to 1 exactly, in 1024ths.
fn weights<const N: usize>(rng: &mut Rng) -> [f32; N] {
    let mut left = 1024;
    let mut weights = [(); N].map(|()| {
        let part = rng.range(0, left);
        left -= part;
        part as f32 / 1024.0
    });
    weights[N - 1] += left as f32 / 1024.0;
    weights
}

/// A map of depth, of any α, and of β of either sign.
fn any_map(rng: &mut Rng, near: f32, far: f32) -> DepthMap {
    let map = match rng.index(4) {
        0 => DepthMap::forward(near, far),
        1 => DepthMap::reversed(near, far),
        2 => DepthMap::reversed(near, f32::INFINITY),
        _ => DepthMap::onto([(); 2].map(|()| rng.uniform(-2.0, 2.0) as f32), near, far),
    };
    map.expect("planes and ends that differ")
}

/// The greatest shares of the bounds that xs, ys and zs make use of, for a mean of N points.
fn worst<const N: usize>(stream: u64) -> [f64; 3] {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut worst = [0f64; 3];
    for _ in 0..200_000 {
        let near = rng.log_uniform(1e-3, 10.0);
        let far = near * rng.log_uniform(1.5, 1e6);
        let view = Perspective::new(1.0, 1.0, near, far).expect("a pyramid");
        let map = any_map(&mut rng, near, far);
        let project = |place: [f32; 3]| {
            let ProjectedVertex { x, y, zs, .. } =
                view.project(&map, &EyeVertex { position: Point3::new(Vec3::from(place)), varying: () });
            [x, y, zs].map(f64::from)
        };
        let points = [(); N].map(|()| {
            let z = rng.log_uniform(near, far).clamp(near, far);
            let [x, y] = [(); 2].map(|()| (rng.uniform(-1.5, 1.5) * f64::from(z)) as f32);
            [x, y, z]
        });
        let in_space = weights::<N>(&mut rng);
        let on_screen = EyeWeights(in_space).to_screen(points.map(|[.., z]| z)).0.map(f64::from);

        // Products of 34 bits: but for the last rounding all is exact.
        let mean = |k: usize| (0..N).map(|i| f64::from(in_space[i]) * f64::from(points[i][k])).sum::<f64>();
        let z = mean(2);
        let found = project([0, 1, 2].map(|k| mean(k) as f32));
        let projected = points.map(project);
        for k in 0..3 {
            let of = |f: fn(f64) -> f64| (0..N).map(|i| on_screen[i] * f(projected[i][k])).sum::<f64>();
            let depths = f64::from(map.alpha()).abs() + f64::from(map.beta()).abs() / z;
            let bound = EPS * if k < 2 { 5.1 * of(f64::abs) } else { 6.1 * depths };
            let error = (found[k] - of(|c| c)).abs();
            assert!(error <= bound, "{k}: {error:e} of {bound:e}: {in_space:?} of {points:?}, {map:?}");
            worst[k] = worst[k].max(error / bound.max(f64::MIN_POSITIVE));
        }
    }
    worst
}

/// By three roundings of a point's component, two of each end's, and one of its weight; of zs those of z, of β/z and of
/// the sum.
#[test]
fn lines_go_to_lines_and_planes_to_planes() {
    for (worst, of) in [(worst::<2>(1), "segments"), (worst::<3>(2), "triangles")] {
        println!("{of}: {worst:.2?} of the bounds");
        assert!(worst.iter().all(|share| (0.2..1.0).contains(share)), "{of}: {worst:?}");
    }
}
