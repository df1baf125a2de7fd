//! The sweeps to the ends of parameters: in one process, in shards, and in shards that GNU parallel starts.

use std::path::Path;
use std::process::Command;

use crate::command::{Outcome, cargo, output, run};
use crate::workspace;

/// The package, and its program.
const PACKAGE: &str = "alberti-extremes";

/// The shards that continuous integration divides the small sweep into.
const SHARDS: [&str; 4] = ["1/4", "2/4", "3/4", "4/4"];

/// Runs the program with these arguments: without any, it measures everything and writes the page. Only `--check` is of
/// this chore: the step of continuous integration.
pub(crate) fn measure(arguments: &[String]) -> Outcome {
    if arguments == ["--check"] {
        return check();
    }
    run(cargo().args(["run", "--quiet", "--release", "--package", PACKAGE, "--"]).args(arguments))
}

/// The small sweep, in shards that GNU parallel starts, put together and compared with one process.
pub(crate) fn check() -> Outcome {
    gnu_parallel()?;
    run(cargo().args(["build", "--release", "--package", PACKAGE]))?;
    let program = workspace::target_directory().join("release").join(PACKAGE);
    let folder = workspace::target_directory().join("extremes-check");
    // Parts of another build would be taken for those of this one.
    if folder.exists() {
        std::fs::remove_dir_all(&folder)
            .map_err(|error| format!("cannot delete {}: {error}", folder.display()))?;
    }
    std::fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    run(&mut parallel(&program, &folder))?;
    run(Command::new(&program).arg("merge").arg(&folder).arg("--compare"))
}

/// Four shards side by side. What failed is run again by the same command, what is done is not.
fn parallel(program: &Path, folder: &Path) -> Command {
    let mut parallel = Command::new("parallel");
    parallel.current_dir(workspace::root());
    parallel.arg("--joblog").arg(folder.join("joblog")).args(["--resume-failed", "--will-cite"]);
    parallel.arg(program).args(["--small", "--out"]).arg(folder).args(["--shard", "{}", ":::"]).args(SHARDS);
    parallel
}

/// Whether the `parallel` that would be started is GNU's: moreutils has another one.
pub(crate) fn gnu_parallel() -> Outcome {
    let version = output(Command::new("parallel").arg("--version"));
    if version.is_ok_and(|version| version.contains("GNU parallel")) {
        return Ok(());
    }
    Err("GNU parallel is not here, which runs shards of a sweep or a film side by side; install it, on Debian \
         and Ubuntu by `apt-get install parallel`, on macOS by `brew install parallel`"
        .into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::describe;

    #[test]
    fn shards_are_logged_and_resumed() {
        let line = describe(&parallel(Path::new("/t/extremes"), Path::new("/t/out")));
        assert!(line.contains("--joblog /t/out/joblog --resume-failed"), "{line}");
        assert!(line.ends_with("--shard {} ::: 1/4 2/4 3/4 4/4"), "{line}");
    }
}
