//! Milliseconds a frame: `scene/policy/size`, for alberti's policies and for its peers.
//!
//! Before anything is timed, every renderer's picture is held against the reference: a renderer that draws the wrong
//! thing, or nothing, stops the run.

use alberti_benches::scene_data::{SCENES, Scene};
use alberti_benches::{Renderer, SIZES, Size, ours, reference, renderers};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;

/// The part of all pixels that alberti may have off: edges and texels within rounding of a pixel's centre.
const OURS: f64 = 0.001;
/// The same for peers. They are not on trial; this tells a picture from a blank.
const PEERS: f64 = 0.25;

fn frames(criterion: &mut Criterion) {
    for description in SCENES {
        let scene = Scene::load(description);
        let mut group = criterion.benchmark_group(scene.name);
        for size in SIZES {
            let right = reference::ideal(&scene, size);
            group.throughput(throughput(&scene, size));
            for (policy, mut renderer) in renderers(&scene, size) {
                verify(&scene, policy, size, renderer.as_mut(), &right);
                group.bench_function(BenchmarkId::new(policy, size), |bencher| {
                    bencher.iter(|| renderer.render());
                });
            }
        }
        group.finish();
    }
}

/// Small triangles are counted, large ones are measured by their pixels.
fn throughput(scene: &Scene, size: Size) -> Throughput {
    let (triangles, pixels) = (scene.triangles.len() as u64, size.pixels() as u64);
    Throughput::Elements(if triangles > 1000 { triangles } else { pixels })
}

/// Holds a picture against the right one.
fn verify(scene: &Scene, policy: &str, size: Size, renderer: &mut dyn Renderer, right: &[[u8; 4]]) {
    // Twice, as a frame must not depend on the one before.
    renderer.render();
    renderer.render();
    let part = reference::part_off(renderer.pixels(), right);
    let off = reference::pixels_off(renderer.pixels(), right);
    let name = scene.name;
    eprintln!(
        "{name}/{policy}/{size}: {} triangles, {off} pixels off by more than {}/255 ({:.3} %)",
        scene.triangles.len(),
        reference::TOLERANCE,
        100.0 * part
    );
    let bound = if ours::is_right(policy) { OURS } else { PEERS };
    assert!(part < bound, "{name}/{policy}/{size}: wrong picture, {off} pixels are off");
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3));
    targets = frames
}
criterion_main!(benches);
