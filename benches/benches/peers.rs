//! Alberti beside peers that are programs of their own, a table in Markdown: `cargo xtask peers` builds them and calls
//! this with their names and paths.
//!
//! Each picture is verified before it is timed. All take turns, so that what slows the machine down for a while slows
//! down all; the time is the least of all frames.

use alberti_app::options::{Filter, Probes};
use alberti_benches::peers::{Process, scene_bytes};
use alberti_benches::scene_data::{SCENES, Scene};
use alberti_benches::{Renderer, SIZES, Size, ours, reference};
use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::Instant;

/// The part of all pixels that may be off: it tells a picture from a blank, or from one that is upside down.
const OFF: f64 = 0.25;
/// The turns of each renderer, and the milliseconds of one.
const ROUNDS: u32 = 8;
const TURN: f64 = 100.0;

fn main() -> Result<(), Box<dyn Error>> {
    let programs: Vec<(String, String)> = std::env::args()
        .skip(1)
        .filter_map(|argument| argument.split_once('=').map(|(name, path)| (name.into(), path.into())))
        .collect();
    if programs.is_empty() {
        println!("There is no peer: `cargo xtask peers` builds them.");
        return Ok(());
    }
    let floor = |filter| ("floor", "floor", filter);
    let sixteen = Probes::Sixteen;
    let minified = [floor(Filter::Trilinear), floor(Filter::Anisotropic(sixteen))];
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for description in SCENES.into_iter().chain(minified) {
        let scene = Scene::load(description);
        for size in SIZES {
            let file = folder.join("peers-scene.bin");
            fs::write(&file, scene_bytes(&scene, size))?;
            let mut ours = ours::renderer("Exact", &scene, size).ok_or("no renderer")?;
            let _ = (&mut ours, &programs);
            row(&scene, size, ours.as_mut(), &programs, &file)?;
            fs::remove_file(&file)?;
        }
    }
    Ok(())
}

fn row(
    scene: &Scene,
    size: Size,
    ours: &mut dyn Renderer,
    programs: &[(String, String)],
    file: &Path,
) -> Result<(), Box<dyn Error>> {
    ours.render();
    let right = match scene.built_in.filter {
        Filter::Nearest | Filter::Bilinear => reference::ideal(scene, size),
        _ => ours.pixels().to_vec(),
    };
    let mut peers = Vec::new();
    for (name, path) in programs {
        let mut process = Process::start(path.as_ref(), file, size)?;
        process.milliseconds(2)?;
        let picture = process.picture(&file.with_extension("raw"), size)?;
        let off = reference::part_off(&picture, &right);
        assert!(
            off < OFF,
            "{}/{name}/{size}: wrong picture, {} % of the pixels are off",
            scene.name,
            100.0 * off
        );
        peers.push((name, process, off, f64::INFINITY));
    }
    let mut best = f64::INFINITY;
    let mut time = |frames: u32| {
        let mut least = f64::INFINITY;
        for _ in 0..frames {
            let start = Instant::now();
            ours.render();
            least = least.min(start.elapsed().as_secs_f64() * 1e3);
        }
        least
    };
    for _ in 0..ROUNDS {
        let frames = if best.is_finite() { (TURN / best) as u32 + 1 } else { 3 };
        best = best.min(time(frames));
        for (_, process, _, least) in &mut peers {
            let frames = if least.is_finite() { (TURN / *least) as u32 + 1 } else { 3 };
            *least = least.min(process.milliseconds(frames)?);
        }
    }
    let filter = format!("{:?}", scene.built_in.filter);
    for (name, _, off, least) in &peers {
        println!(
            "{} {filter} {size}: ours {best:.3} {name} {least:.3} ratio {:.2} off {:.3} %",
            scene.name,
            least / best,
            100.0 * off
        );
    }
    Ok(())
}
