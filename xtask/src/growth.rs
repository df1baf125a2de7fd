//! The page of times against pixels and triangles, with its plots.

use std::process::Stdio;

use crate::command::{Outcome, cargo, output};
use crate::workspace;

/// The page that the chore writes, and the folder of its plots.
const PAGE: &str = "docs/growth.md";
const PICTURES: &str = "docs/pictures";

/// What stands above the tables.
const HEADING: &str = "\
# Growth: the time of a frame against its pixels and its triangles

A frame takes time in proportion to its pixels, from 64x64 to 8192x8192, and in proportion to its triangles, from where
they and not the pixels are the load, up to 10^7. Rows whose length is a power of two are no exception. Beyond the
caches a pixel that is drawn to many times takes up to half as long again, because colours and depths come from memory;
by bands, which share the depths of some rows (`Bands`), less is to be fetched, and large frames are faster. Without
slots vertices are transformed again, some of them for each triangle. Bands have a list of at most 2^20 triangles: of
more, each band walks the rest anew, so that few bands are best.

![Nanoseconds a pixel against pixels](pictures/growth_pixels.svg)

![Nanoseconds a triangle against triangles](pictures/growth_triangles.svg)

*Pixels* are those of the scene `fill`, 16 textured layers over the whole picture. *Triangles* are those of closed
meshes with colours at their vertices, at 1280x720. Each time is a whole frame on one thread, cleared first, in the
thread's own processor time: the least of eight turns. Each picture is compared with rays in `f64` before it is timed.
This page is made by

    cargo xtask growth

";

/// Writes the page anew.
pub(crate) fn run() -> Outcome {
    let mut bench = cargo();
    bench.args(["bench", "--quiet", "--package", "alberti-benches", "--bench", "growth", "--"]);
    bench.arg(workspace::root().join(PICTURES)).stderr(Stdio::inherit());
    let tables = output(&mut bench)?;
    let path = workspace::root().join(PAGE);
    std::fs::write(&path, format!("{HEADING}{tables}"))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("Wrote {PAGE}.");
    Ok(())
}
