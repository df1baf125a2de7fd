//! Alberti beside all its peers in one run: a line of figures for each scene, size and renderer. Programs of other
//! languages are arguments, `NAME=PATH`: `cargo xtask peers` builds those that the machine can build, and calls this.
//!
//! Each picture is verified before anything is timed. All take turns, so that what slows the machine down for a while
//! slows down all; a time is the least of all frames.
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "numbers of frames")]

use alberti::lanes::Machine;
use alberti_app::options::{Filter, Probes};
use alberti_benches::peers::{Process, scene_bytes};
use alberti_benches::scene_data::{SCENES, Scene};
use alberti_benches::{Renderer, SIZES, Size, ours, pavement, reference, renderers};
use std::error::Error;
use std::fs;
use std::io;
use std::path::Path;
use std::time::Instant;

/// Renderers that `frames` times and this does not.
const LEFT_OUT: [&str; 5] = [ours::WITHOUT_SLOTS, ours::BY_BANDS, "Spans16", "Affine", "App"];
/// The part of all pixels that may be off: enough to tell a picture from a blank, or from one that is upside down.
const OFF: f64 = 0.25;
/// The same of the pavement. Levels of detail are defined by bounds only, but there all take nearly the same.
const OFF_THE_PAVEMENT: f64 = 0.001;
/// Turns of each renderer, and the milliseconds of one.
const TURNS: u32 = 10;
const TURN: f64 = 100.0;

fn main() -> Result<(), Box<dyn Error>> {
    let programs: Vec<[String; 2]> = std::env::args()
        .filter_map(|argument| argument.split_once('=').map(|(name, path)| [name.into(), path.into()]))
        .collect();
    eprintln!("alberti by {:?}", Machine::all().next());
    println!("scene,size,renderer,milliseconds,off");
    // Where texels are smaller than pixels.
    let minified = [Filter::Trilinear, Filter::Anisotropic(Probes::Sixteen)];
    let floors = ["floor-trilinear", "floor-anisotropic"].into_iter().zip(minified);
    let descriptions = SCENES.into_iter().chain(floors.map(|(name, filter)| (name, "floor", filter)));
    let scenes = descriptions.map(Scene::load).chain([Scene::normal_mapped()]);
    let scenes: Vec<_> = scenes.collect();
    for size in SIZES {
        for scene in &scenes {
            let mut all = contestants(scene, size, &programs)?;
            verify(scene, size, &mut all)?;
            take_turns(&mut all)?;
            for Contestant { name, off, least, .. } in all {
                println!("{},{size},{name},{least:.5},{off}", scene.name);
            }
        }
    }
    Ok(())
}

/// Someone who draws a scene.
struct Contestant {
    name: String,
    by: By,
    /// Pixels off.
    off: usize,
    /// Milliseconds.
    least: f64,
}

enum By {
    Renderer(Box<dyn Renderer>),
    Process(Process),
}

impl Contestant {
    fn new(name: &str, by: By) -> Self {
        Self { name: name.into(), by, off: 0, least: f64::INFINITY }
    }

    /// Draws frames.
    fn draw(&mut self, frames: u32) -> io::Result<()> {
        let least = match &mut self.by {
            By::Process(process) => process.milliseconds(frames)?,
            By::Renderer(renderer) => (0..frames).fold(f64::INFINITY, |least, _| {
                let start = Instant::now();
                renderer.render();
                least.min(start.elapsed().as_secs_f64() * 1e3)
            }),
        };
        self.least = self.least.min(least);
        Ok(())
    }

    fn picture(&mut self, size: Size) -> io::Result<Vec<[u8; 4]>> {
        match &mut self.by {
            By::Process(process) => process.picture(&temporary("picture"), size),
            By::Renderer(renderer) => Ok(renderer.pixels().to_vec()),
        }
    }
}

/// A file of this run.
fn temporary(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("peers-{name}-{}", std::process::id()))
}

fn contestants(scene: &Scene, size: Size, programs: &[[String; 2]]) -> io::Result<Vec<Contestant>> {
    let here = renderers(scene, size).into_iter().filter(|(name, _)| !LEFT_OUT.contains(name));
    let mut all: Vec<_> =
        here.map(|(name, renderer)| Contestant::new(name, By::Renderer(renderer))).collect();
    let file = temporary("scene");
    fs::write(&file, scene_bytes(scene, size))?;
    for [name, path] in programs {
        let mut process = Process::start(path.as_ref(), &file, size)?;
        match process.name()? {
            Ok(version) => {
                eprintln!("{}/{size}: {name} is {version}", scene.name);
                all.push(Contestant::new(name, By::Process(process)));
            }
            Err(feature) => eprintln!("{}/{size}: {name} is left out, it has no {feature}", scene.name),
        }
    }
    fs::remove_file(&file)?;
    Ok(all)
}

/// Holds all pictures against rays in `f64`; those of a floor that need a mip map, for which there are no such rays,
/// against each other.
fn verify(scene: &Scene, size: Size, all: &mut [Contestant]) -> io::Result<()> {
    let (mut right, bound) = match (&scene.stones, scene.built_in.filter) {
        (Some(stones), _) => (Some(pavement::picture(scene, stones, size)), OFF_THE_PAVEMENT),
        (None, Filter::Nearest | Filter::Bilinear) => (Some(reference::ideal(scene, size)), OFF),
        (None, Filter::Trilinear | Filter::Anisotropic(_)) => (None, OFF),
    };
    for contestant in all {
        contestant.draw(2)?;
        let picture = contestant.picture(size)?;
        let right = right.get_or_insert_with(|| picture.clone());
        contestant.off = reference::pixels_off(&picture, right);
        let part = reference::part_off(&picture, right);
        let name = &contestant.name;
        assert!(part < bound, "{}/{name}/{size}: wrong picture, {:.0} % are off", scene.name, 100.0 * part);
    }
    Ok(())
}

fn take_turns(all: &mut [Contestant]) -> io::Result<()> {
    for _ in 0..TURNS {
        for contestant in &mut *all {
            contestant.draw((TURN / contestant.least) as u32 + 1)?;
        }
    }
    Ok(())
}
