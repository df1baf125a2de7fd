//! Committed pictures: every bit of them, on every machine.
//!
//! They say that the output has not changed, not that it is right; `images.rs` says that. `cargo xtask golden` writes
//! them anew, from the whole-frame renderer only, and then fails, so that no run both writes and passes.

use alberti_app::render::render;
use alberti_app::scene::Image;
use alberti_app::scenes::{NAMES, by_name};
use alberti_tests::reference::options;
use std::path::{Path, PathBuf};

const WIDTH: u32 = 160;
const HEIGHT: u32 = 120;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(format!("{name}.png"))
}

fn picture(name: &str) -> Image {
    let scene = by_name(name).expect("a built-in scene");
    let options = options(&scene, WIDTH, HEIGHT);
    render(&scene.model, &scene.camera, &options, &mut |_, _| {}).expect("a scene that can be drawn").image
}

#[test]
fn every_scene_is_what_it_was() {
    let update = std::env::var_os("ALBERTI_UPDATE_GOLDEN").is_some();
    let mut changed = Vec::new();
    for &name in NAMES {
        let new = picture(name);
        let bytes = new.texels.as_flattened();
        let old = image::open(file(name)).ok().map(|old| old.to_rgba8());
        let same = old
            .as_ref()
            .is_some_and(|old| (old.width(), old.height()) == (WIDTH, HEIGHT) && old.as_raw() == bytes);
        if same {
            continue;
        }
        if update {
            image::save_buffer(file(name), bytes, WIDTH, HEIGHT, image::ColorType::Rgba8).expect("a file");
        }
        let off = old.map(|old| old.as_raw().iter().zip(bytes).filter(|(a, b)| a != b).count());
        changed.push(match off {
            Some(off) => format!("{name} ({off} bytes)"),
            None => format!("{name} (no picture of this size)"),
        });
    }
    let what = if update { "written anew" } else { "not what is committed; see `cargo xtask golden`" };
    assert!(changed.is_empty(), "{}: {what}", changed.join(", "));
}
