//! The time of a frame against its pixels and against its triangles, as tables in Markdown. Plots go to the folder that
//! is the argument: `cargo xtask growth` writes docs/growth.md from both.
//!
//! Each picture is held against rays in `f64` before anything is timed. Those of one row take turns, so that what slows
//! the machine down for a while slows down all. A time is the least of all frames, in the processor's time of the
//! thread, which does not count that of neighbours.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "numbers of frames, pixels and triangles"
)]

mod clock;
mod plot;

use alberti::lanes::Machine;
use alberti_app::options::Filter;
use alberti_app::scenes::gouraud;
use alberti_benches::Size;
use alberti_benches::ours::{self, BY_BANDS, WITHOUT_SLOTS};
use alberti_benches::reference::Sparse;
use alberti_benches::scene_data::Scene;
use clock::seconds;
use plot::Plot;
use std::error::Error;
use std::path::PathBuf;

/// Sides of the pictures in pixels: powers of two, and others beside them.
const SIDES: [u32; 18] =
    [64, 100, 128, 256, 500, 512, 528, 1000, 1024, 1040, 2000, 2048, 2064, 4000, 4096, 4112, 8176, 8192];
/// Cells along the sides of the meshes, which have 12 triangles for the square of it: 10^2 to 10^7.
const CELLS: [u32; 11] = [3, 5, 9, 16, 29, 51, 91, 161, 289, 513, 913];
/// The picture of the meshes.
const SCREEN: Size = Size { width: 1280, height: 720 };
/// The pictures in which bands are compared with whole frames.
const SCREENS: [Size; 3] = [SCREEN, Size { width: 1920, height: 1080 }, Size { width: 3840, height: 2160 }];

/// The pixels that may be looked at.
const RAYS: usize = 1 << 17;
/// The part of them that may be off: edges and texels within rounding of a pixel's centre.
const OFF: f64 = 0.001;
/// Turns of each renderer, and the seconds of one.
const TURNS: u32 = 8;
const TURN: f64 = 0.05;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo says `--bench`.
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with('-')).map(PathBuf::from);
    let machine = Machine::all().next().ok_or("no lanes")?;
    let registers = format!("{machine:?}");
    println!("Registers: {}.\n", registers.split('(').next().unwrap_or(&registers));

    let policies = ["Exact", BY_BANDS];
    let pixels = Plot {
        title: "Time of a pixel",
        across: "pixels of the picture",
        names: ["whole frame", "by bands"].into(),
        rows: SIDES
            .map(|side| {
                let size = Size { width: side, height: side };
                let scene = Scene::load(("fill", "fill", Filter::Nearest));
                (size.to_string(), size.pixels() as f64, times(&scene, size, &policies))
            })
            .into(),
    };
    print!("## Pixels\n\n{}\n{}", pixels.markdown("picture", "pixel"), pixels.spread("pixel", 65_536.0));

    let policies = ["Exact", WITHOUT_SLOTS, BY_BANDS];
    let triangles = Plot {
        title: "Time of a triangle",
        across: "triangles of the mesh",
        names: ["slots for all vertices", "without slots", "by bands"].into(),
        rows: CELLS
            .map(|cells| {
                let scene = Scene::new("gouraud", gouraud(cells));
                let count = scene.triangles.len();
                (count.to_string(), count as f64, times(&scene, SCREEN, &policies))
            })
            .into(),
    };
    print!(
        "\n## Triangles\n\n{}\n{}",
        triangles.markdown("triangles", "triangle"),
        triangles.spread("triangle", 99_000.0)
    );

    let policies = ["Exact", BY_BANDS, WITHOUT_SLOTS];
    println!("\n## Bands, and no slots\n");
    println!(
        "| scene | whole frame, ms | by bands | ratio | without slots | ratio |\n|---|---:|---:|---:|---:|---:|"
    );
    for name in ["mesh", "gouraud", "fill"] {
        let scene = Scene::load((name, name, Filter::Nearest));
        for size in SCREENS {
            let found = times(&scene, size, &policies);
            let cells = found[1..].iter().map(|time| {
                if time.is_nan() {
                    " - | - |".to_owned()
                } else {
                    format!(" {} | {:.2} |", digits(time * 1e3), time / found[0])
                }
            });
            println!("| {name}, {size} | {} |{}", digits(found[0] * 1e3), cells.collect::<String>());
        }
    }
    if let Some(folder) = folder {
        pixels.draw(&folder.join("growth_pixels.svg"))?;
        triangles.draw(&folder.join("growth_triangles.svg"))?;
    }
    Ok(())
}

/// Seconds of a frame by each policy; NaN for those that do not draw such a scene.
fn times(scene: &Scene, size: Size, policies: &[&str]) -> Vec<f64> {
    let name = format!("{} of {} triangles, {size}", scene.name, scene.triangles.len());
    let right = Sparse::new(scene, size, RAYS);
    let mut all: Vec<_> = policies.iter().map(|policy| ours::renderer(policy, scene, size)).collect();
    let mut least = vec![f64::NAN; all.len()];
    for ((policy, renderer), least) in policies.iter().zip(&mut all).zip(&mut least) {
        let Some(renderer) = renderer else { continue };
        // Twice, as a frame must not depend on the one before.
        renderer.render();
        *least = seconds(|| renderer.render());
        let off = right.part_off(renderer.pixels());
        assert!(off < OFF, "{name} by {policy}: wrong picture, {:.2} % are off", 100.0 * off);
    }
    for _ in 0..TURNS {
        for (renderer, least) in all.iter_mut().zip(&mut least) {
            let Some(renderer) = renderer else { continue };
            for _ in 0..(TURN / *least) as u32 + 1 {
                *least = least.min(seconds(|| renderer.render()));
            }
        }
    }
    let shown: Vec<_> = least.iter().map(|&time| digits(time * 1e3)).collect();
    eprintln!("{name}: {} ms", shown.join(", "));
    least
}

/// Three digits.
fn digits(number: f64) -> String {
    let decimals = (2.0 - number.log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{number:.decimals$}")
}
