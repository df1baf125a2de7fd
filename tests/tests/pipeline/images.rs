//! The application's pictures against an independent renderer in f64.
//!
//! Two references: the ideal one, which casts rays at the triangles as they are, and the snapped one, whose vertices
//! lie where the rasterizer's snapping puts them. Colours are held against the ideal one. So is coverage, but for a
//! horizon that snapping moves.

use alberti_app::options::{DepthFormat, Filter, RenderOptions, Shading};
use alberti_app::render::render;
use alberti_app::scene::{Camera, Model};
use alberti_app::scenes::by_name;
use alberti_app::{image_file, obj};
use alberti_oracle::ideal::render_ideal;
use alberti_oracle::image::{compare, compare_coverage};
use alberti_oracle::snapped::render_snapped;
use alberti_tests::reference::{options, with_scene};
use std::path::Path;

/// A channel may differ by this much before a pixel counts as off.
const TOLERANCE: u8 = 8;
/// The pixels in a million that may be off.
const OFF_PER_MILLION: usize = 100;
/// The pixels whose coverage may differ.
const COVERAGE: usize = 4;

/// Which reference a scene's coverage must meet.
#[derive(Clone, Copy, PartialEq)]
enum Measure {
    Ideal,
    Snapped,
}

fn check(name: &str, model: &Model, camera: &Camera, options: &RenderOptions, measure: Measure) {
    let picture = render(model, camera, options, &mut |_, _| {}).expect("a scene that can be drawn");
    let (ideal, snapped) = with_scene(model, camera, options, |s| (render_ideal(s), render_snapped(s, 8)));
    let pixels = ideal.pixels.len();
    let off = |reference: &alberti_oracle::image::Image| {
        compare(&picture.image.texels, &reference.pixels, TOLERANCE).differing
    };
    let coverage = coverage(model, camera, options);
    let [uncovered_ideal, uncovered_snapped] =
        [&ideal, &snapped].map(|r| compare_coverage(&coverage, &r.covered).differing());
    println!(
        "{name} {}x{} {:?} {:?} {:?}: off {} of the ideal image, {} of the snapped one; coverage {uncovered_ideal}, \
         {uncovered_snapped}; {pixels} pixels",
        options.width,
        options.height,
        options.shading,
        options.filter,
        options.depth,
        off(&ideal),
        off(&snapped)
    );
    assert!(coverage.iter().filter(|&&c| c).count() > pixels / 20, "{name}: next to nothing to compare");
    let uncovered = match measure {
        Measure::Ideal => uncovered_ideal,
        Measure::Snapped => uncovered_snapped,
    };
    let off = off(&ideal);
    assert!(uncovered <= COVERAGE, "{name}: coverage differs on {uncovered} pixels");
    assert!(off * 1_000_000 <= OFF_PER_MILLION * pixels, "{name}: {off} of {pixels} pixels are off");
}

/// Which pixels the model covers, from its white silhouette on black.
fn coverage(model: &Model, camera: &Camera, options: &RenderOptions) -> Vec<bool> {
    let mut white = model.clone();
    for part in &mut white.parts {
        part.texture = None;
        part.diffuse = [1.0; 3];
    }
    let options = RenderOptions { background: [0; 3], shading: Shading::Unlit, ..*options };
    let picture = render(&white, camera, &options, &mut |_, _| {}).expect("a scene that can be drawn");
    picture.image.texels.iter().map(|t| t[0] == 255).collect()
}

fn check_scene(name: &str, size: (u32, u32), measure: Measure, change: impl FnOnce(&mut RenderOptions)) {
    let scene = by_name(name).expect("a built-in scene");
    let mut options = options(&scene, size.0, size.1);
    change(&mut options);
    check(name, &scene.model, &scene.camera, &options, measure);
}

const DISPLAY: (u32, u32) = (320, 240);
const SMALL: (u32, u32) = (640, 480);
const LARGE: (u32, u32) = (1280, 720);

#[test]
fn sixteen_layers() {
    check_scene("fill", LARGE, Measure::Ideal, |o| o.filter = Filter::Nearest);
    check_scene("fill", SMALL, Measure::Ideal, |o| o.filter = Filter::Bilinear);
}

#[test]
fn a_textured_mesh() {
    check_scene("mesh", LARGE, Measure::Ideal, |o| o.filter = Filter::Nearest);
    check_scene("mesh", SMALL, Measure::Ideal, |o| {
        o.filter = Filter::Bilinear;
        o.shading = Shading::Lambert;
    });
}

#[test]
fn a_gouraud_mesh() {
    check_scene("gouraud", LARGE, Measure::Ideal, |_| {});
}

#[test]
fn a_floor_to_the_horizon() {
    check_scene("floor", LARGE, Measure::Snapped, |o| o.filter = Filter::Nearest);
    check_scene("floor", SMALL, Measure::Snapped, |o| o.filter = Filter::Bilinear);
    check_scene("floor", DISPLAY, Measure::Snapped, |o| o.filter = Filter::Nearest);
}

#[test]
fn the_colour_cube() {
    check_scene("cube", SMALL, Measure::Ideal, |_| {});
}

#[test]
fn from_within_across_all_six_planes() {
    check_scene("inside", SMALL, Measure::Ideal, |_| {});
}

#[test]
fn the_default_picture() {
    check_scene("hero", SMALL, Measure::Ideal, |_| {});
}

#[test]
fn every_depth_format_that_resolves_the_scene() {
    for depth in [DepthFormat::F32, DepthFormat::F32Reversed, DepthFormat::U24] {
        check_scene("mesh", SMALL, Measure::Ideal, |o| o.depth = depth);
    }
}

/// A scanned and textured model from beside the repository, where there is one.
#[test]
fn a_real_model_from_three_cameras() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/models/spot");
    if !folder.is_dir() {
        eprintln!("SKIPPED: no model in {}", folder.display());
        return;
    }
    let loaded = obj::load(&folder.join("spot_triangulated.obj"), None, &mut |_, _| {}).expect("a model");
    let mut model = loaded.model;
    model.textures = vec![
        image_file::load(&folder.join("spot_texture.png"), image_file::MAX_TEXELS).expect("a texture").into(),
    ];
    for part in &mut model.parts {
        part.texture = Some(0);
        part.diffuse = [1.0; 3];
    }
    let scene = by_name("mesh").expect("a built-in scene");
    let options =
        RenderOptions { filter: Filter::Bilinear, shading: Shading::Lambert, ..options(&scene, 640, 480) };
    for eye in [[2.0, 1.0, -2.5], [-1.5, 2.0, 2.0], [0.0, 0.3, -1.2]] {
        let camera = Camera {
            eye,
            target: [0.0, 0.1, 0.0],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 50.0,
            near: 0.1,
            far: 10.0,
        };
        check("spot", &model, &camera, &options, Measure::Ideal);
    }
}
