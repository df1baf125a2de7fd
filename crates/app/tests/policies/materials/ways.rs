//! All maps by each policy of the pipeline.

use super::maps::{full, levels, material};
use super::scene::{LONGEST_SIDE, Scene};
use super::typed::{InBoth, Picture, Sheet, Words, framed};
use super::{Cases, LEAST};
use alberti::shaders::material::Framed;
use alberti::texture::{Repeat, Trilinear};
use alberti::{
    D16, D24, D32, Exact, F32, F32Reversed, FixedPoint, FragmentStage, Interpolation, Lines, NoDepth,
    PerPixel, PerRun, PerTriangle, Planes, Rgba8, Spans16,
};
use alberti_app::options::{Arithmetic, Cull, DepthFormat, Filter, Lod, Subpixel};
use std::num::NonZero;

/// All maps with smaller levels.
fn scene() -> Scene {
    full(Scene::new()).by(|options| options.filter = Filter::Trilinear)
}

/// Its material.
fn stage<'a>(
    scene: &'a Scene,
    chains: &'a [Vec<[u8; 4]>],
) -> impl FragmentStage<Framed, Color = Rgba8> + use<'a> {
    material(scene, levels(scene, chains, Trilinear, Repeat))
}

/// Its picture by other policies.
fn drawn(scene: &Scene, by: impl Interpolation, depth: impl Words) -> Picture {
    let chains = scene.chains();
    let stage = InBoth(stage(scene, &chains));
    Sheet::new(scene, depth).paint_by::<_, PerPixel>((0, &framed), &stage, by).picture()
}

/// The scene with an interpolation of that name.
fn by_name(name: &str, arithmetic: Arithmetic, depth: DepthFormat) -> Scene {
    scene().by(|options| {
        options.policies.interpolation = name.parse().expect("a name");
        (options.policies.arithmetic, options.depth) = (arithmetic, depth);
    })
}

fn spans(length: i32) -> Lines {
    Lines::spans(length).expect("a power of two")
}

#[test]
fn each_interpolation_is_that_of_the_library() {
    let mut cases = Cases::default();
    let all = &scene();
    let bounded = |texels: f32| Lines::bounded(texels / LONGEST_SIDE);
    let mut check = |name: &str, expected: Picture| {
        cases.check(name, &by_name(name, Arithmetic::Float, DepthFormat::F32), &expected);
    };
    check("exact", drawn(all, Exact, F32));
    check("plane", drawn(all, Planes, F32));
    check("spans:4", drawn(all, spans(4), F32));
    check("spans:8", drawn(all, spans(8), F32));
    check("spans:16", drawn(all, Spans16, F32));
    check("spans:32", drawn(all, spans(32), F32));
    check("bounded:4", drawn(all, bounded(4.0), F32));
    check("affine", drawn(all, Lines::affine(), F32));
    let mut check = |name: &str, expected: Picture| {
        let scene = by_name(name, Arithmetic::Fixed, DepthFormat::F32);
        cases.check(&format!("{name} in fixed point"), &scene, &expected);
    };
    check("spans:4", drawn(all, FixedPoint(spans(4)), F32));
    check("spans:8", drawn(all, FixedPoint(spans(8)), F32));
    check("spans:16", drawn(all, FixedPoint(spans(16)), F32));
    check("spans:32", drawn(all, FixedPoint(spans(32)), F32));
    check("bounded:0.5", drawn(all, FixedPoint(bounded(0.5)), F32));
    check("bounded:4", drawn(all, FixedPoint(bounded(4.0)), F32));
    check("affine", drawn(all, FixedPoint(Lines::affine()), F32));
    cases.done(15);
    // A small budget is kept by planes, or in narrow triangles by what is exact.
    let small = by_name("bounded:0.25", Arithmetic::Float, DepthFormat::F32);
    let expected = drawn(all, bounded(0.25), F32);
    assert!(Picture::of(&small) == expected && expected.differing(&drawn(all, bounded(4.0), F32)) > LEAST);
}

#[test]
fn each_depth_format_is_that_of_the_library() {
    let mut cases = Cases::default();
    let all = &scene();
    let mut check = |depth, expected: Picture| {
        cases.check(&format!("{depth:?}"), &by_name("exact", Arithmetic::Float, depth), &expected);
    };
    check(DepthFormat::F32, drawn(all, Exact, F32));
    check(DepthFormat::F32Reversed, drawn(all, Exact, F32Reversed));
    check(DepthFormat::U16, drawn(all, Exact, D16));
    check(DepthFormat::U24, drawn(all, Exact, D24));
    check(DepthFormat::U32, drawn(all, Exact, D32));
    check(DepthFormat::None, drawn(all, Exact, NoDepth));
    let by = FixedPoint(spans(8));
    let mut check = |depth, expected: Picture| {
        let scene = by_name("spans:8", Arithmetic::Fixed, depth);
        cases.check(&format!("{depth:?} in fixed point"), &scene, &expected);
    };
    check(DepthFormat::F32Reversed, drawn(all, by, F32Reversed));
    check(DepthFormat::U16, drawn(all, by, D16));
    check(DepthFormat::U24, drawn(all, by, D24));
    check(DepthFormat::U32, drawn(all, by, D32));
    check(DepthFormat::None, drawn(all, by, NoDepth));
    cases.done(11);
}

#[test]
fn so_are_grids_faces_and_places_of_detail() {
    let mut cases = Cases::default();
    let all = &scene();
    let chains = &all.chains();
    cases.check("all", all, &drawn(all, Exact, F32));
    let sub4 = scene().by(|options| options.policies.subpixel = Subpixel::Sub4);
    cases.check("coarse", &sub4, &drawn(&sub4, Exact, F32));
    let coarse = by_name("spans:8", Arithmetic::Fixed, DepthFormat::F32);
    let coarse = coarse.by(|options| options.policies.subpixel = Subpixel::Sub4);
    cases.check("coarse in fixed point", &coarse, &drawn(&coarse, FixedPoint(spans(8)), F32));
    // Both from a place where both sides are seen.
    for (name, cull) in [("fronts", Cull::Back), ("backs", Cull::Front)] {
        let mut scene = scene().by(|options| options.cull = cull);
        scene.camera.eye = [0.2, -1.1, 2.6];
        cases.check(name, &scene, &drawn(&scene, Exact, F32));
    }
    let differing = |lod, arithmetic| {
        let name = if arithmetic == Arithmetic::Fixed { "spans:8" } else { "exact" };
        by_name(name, arithmetic, DepthFormat::F32).by(|options| options.policies.lod = lod)
    };
    let stage = &InBoth(stage(all, chains));
    let sheet = || Sheet::new(all, F32);
    let by_run = sheet().paint_by::<_, PerRun>((0, &framed), stage, Exact).picture();
    cases.check("by run", &differing(Lod::Run, Arithmetic::Float), &by_run);
    let by_triangle = sheet().paint_by::<_, PerTriangle>((0, &framed), stage, Exact).picture();
    cases.check("by triangle", &differing(Lod::Triangle, Arithmetic::Float), &by_triangle);
    let by = FixedPoint(spans(8));
    let by_triangle = sheet().paint_by::<_, PerTriangle>((0, &framed), stage, by).picture();
    cases.check("by triangle, in fixed point", &differing(Lod::Triangle, Arithmetic::Fixed), &by_triangle);
    let by_run = sheet().paint_by::<_, PerRun>((0, &framed), stage, by).picture();
    cases.check("by run, in fixed point", &differing(Lod::Run, Arithmetic::Fixed), &by_run);
    cases.done(9);
    let several = scene().by(|options| options.threads = NonZero::new(3).expect("three"));
    assert!(Picture::of(&several) == drawn(all, Exact, F32));
}
