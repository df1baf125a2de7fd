//! A film by four processes, one of which fails at first, is the film of one process.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::command::{Outcome, cargo, run};
use crate::extremes::gnu_parallel;
use crate::workspace;

/// The film, without its output.
const FILM: [&str; 8] = ["turntable", "--scene", "mesh", "--frames", "10", "--size", "160x120", "--quiet"];

/// The shares of it.
const SHARDS: [&str; 4] = ["0", "1", "2", "3"];

/// The share that fails as long as there is a file of that name.
const LATE: &str = "2.late";

/// The frames, for messages of the program as well.
const FRAMES: &str = "frames/%03d.png";

/// Draws it both ways, and compares the files.
pub(crate) fn check() -> Outcome {
    gnu_parallel()?;
    run(cargo().args(["build", "--release", "--package", "alberti-app"]))?;
    let program = workspace::target_directory().join("release/alberti");
    let folder = workspace::target_directory().join("film-check");
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(&folder).map_err(failed)?;
    fs::write(folder.join(LATE), "").map_err(failed)?;
    if run(&mut shards(&program, &folder)).is_ok() {
        return Err("a share that fails was not told".into());
    }
    let count = || fs::read_dir(folder.join("frames")).map_or(0, Iterator::count);
    let (before, late) = (count(), folder.join(LATE));
    fs::remove_file(late).map_err(failed)?;
    run(&mut shards(&program, &folder))?;
    println!("{before} frames at first, {} when what failed was run again", count());
    if before == 0 || before >= count() {
        return Err("the share that failed is not that which was run again".into());
    }
    for name in ["film.gif", "film.webp"] {
        run(Command::new(&program).current_dir(&folder).args(["assemble", FRAMES, "-q", "-o", name]))?;
        let one = format!("one-{name}");
        run(Command::new(&program).current_dir(&folder).args(FILM).args(["-o", &one]))?;
        let [all, one] = [name, &one].map(|name| fs::read(folder.join(name)));
        if all.map_err(failed)? != one.map_err(failed)? {
            return Err(format!("{name} of four processes is not that of one, in {}", folder.display()));
        }
    }
    Ok(())
}

/// Four shares side by side. A share that failed is run again by the same command, one that is done is not.
fn shards(program: &Path, folder: &Path) -> Command {
    let mut parallel = Command::new("parallel");
    parallel.current_dir(folder);
    parallel.args(["--joblog", "joblog", "--resume-failed", "--will-cite", "--quote"]);
    let draw = "test ! -e \"$1.late\" && shift && exec \"$@\"";
    parallel.args(["sh", "-c", draw, "sh", "{}"]).arg(program).args(FILM);
    parallel.args(["-o", FRAMES, "--shard", "{}/4", ":::"]).args(SHARDS);
    parallel
}
