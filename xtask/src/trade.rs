//! The trade: what each approximation costs and loses, measured by `tests/trade`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use crate::command::{self, Outcome, cargo, output};
use crate::{firmware, workspace};

/// The package that measures.
const PACKAGE: &str = "alberti-trade";
/// The functions within which a frame is counted, and at which its count is written, for callgrind's options.
const MEASURED: &str = "*counts::measured*";
const ENDED: &str = "*counts::ended*";
/// The board whose counts are compared with the table.
const CHECKED: &str = "m4f";
/// The option for what repeats alone, and the one for the boards alone.
const CHECK: &str = "--check";
const OF_BOARDS: &str = "--boards";

/// Writes `docs/trade.md` with its table, plots and pictures, or the chapter of the boards alone, or compares what
/// repeats with the table.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    match arguments {
        [] => measure("write"),
        [flag] if flag == CHECK => check(),
        [flag] if flag == OF_BOARDS => boards(),
        _ => Err(format!("expected nothing, `{CHECK}` or `{OF_BOARDS}`, found `{}`", arguments.join(" "))),
    }
}

/// Counts on the boards, and writes their chapter and the prices that `alberti advise` goes by.
fn boards() -> Outcome {
    let program = build()?;
    let file = prices(&program, None, true)?;
    command::run(Command::new(program).arg("boards").arg(workspace::root()).arg("--boards").arg(file))
}

fn build() -> Result<PathBuf, String> {
    command::run(cargo().args(["build", "--release", "--package", PACKAGE]))?;
    Ok(workspace::target_directory().join("release").join(PACKAGE))
}

/// The file of the prices on all boards, or on that of a name; with the sizes of programs if they are `weighed`.
fn prices(program: &Path, board: Option<&str>, weighed: bool) -> Result<PathBuf, String> {
    let scenes = workspace::target_directory().join("trade-scenes");
    command::run(Command::new(program).arg("scenes").arg(&scenes))?;
    let prices = firmware::prices(&scenes, board, weighed)?;
    let file = scenes.join("prices.csv");
    fs::write(&file, prices).map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    Ok(file)
}

/// Compares what `alberti advise` picks with the best of all, and writes `docs/advice.md`.
pub(crate) fn advice() -> Outcome {
    command::run(Command::new(build()?).arg("advice").arg(workspace::root()))
}

/// Compares errors and instructions with those of the table that is committed.
pub(crate) fn check() -> Outcome {
    measure("check")
}

fn measure(what: &str) -> Outcome {
    let program = build()?;
    // Compiling for three boards and thirty sizes takes minutes: a check asks one board for its counts.
    let (board, weighed) = if what == "write" { (None, true) } else { (Some(CHECKED), false) };
    // Valgrind has one thread, and compilers wait for one another: together they take little more than either.
    let (counts, prices) = thread::scope(|scope| {
        let counts = scope.spawn(|| counts(&program));
        let prices = prices(&program, board, weighed);
        (counts.join(), prices)
    });
    let counts = counts.map_err(|_| "counting instructions panicked")??;
    let mut line = Command::new(&program);
    line.arg(what).arg(workspace::root()).args(["--compiler", &compiler()?]);
    match counts {
        Some(folder) => _ = line.arg("--counts").arg(folder),
        None => eprintln!("valgrind is not installed: instructions are not counted (Debian: valgrind)"),
    }
    command::run(line.arg("--boards").arg(prices?))
}

/// The compiler and the registers by which instructions can be compared.
fn compiler() -> Result<String, String> {
    let version = output(Command::new("rustc").arg("--version"))?;
    let version: Vec<&str> = version.split_whitespace().take(2).collect();
    Ok(format!("{}, {}", version.join(" "), registers()))
}

/// The widest registers that the library takes under valgrind, which has none of 512 bits.
fn registers() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    if std::is_x86_feature_detected!("avx2") {
        return "x86-64 with AVX2";
    }
    std::env::consts::ARCH
}

/// Counts every frame's instructions: a folder of callgrind's parts, if valgrind is installed.
fn counts(program: &Path) -> Result<Option<PathBuf>, String> {
    let installed = Command::new("valgrind").arg("--version").stdout(Stdio::null()).status();
    if !installed.is_ok_and(|status| status.success()) {
        return Ok(None);
    }
    let folder = workspace::target_directory().join("trade");
    let failed = |error: std::io::Error| format!("cannot make {} empty: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(&folder).map_err(failed)?;
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--quiet", "--tool=callgrind", "--collect-atstart=no"]);
    valgrind.arg(format!("--toggle-collect={MEASURED}")).arg(format!("--dump-before={ENDED}"));
    valgrind.arg(format!("--callgrind-out-file={}", folder.join("part").display()));
    command::run(valgrind.arg(program).arg("frames"))?;
    Ok(Some(folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_arguments_are_named() {
        assert_eq!(
            run(&["--fast".into()]),
            Err("expected nothing, `--check` or `--boards`, found `--fast`".into())
        );
    }
}
