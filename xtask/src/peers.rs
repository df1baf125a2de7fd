//! Alberti beside its peers in one run, with those that are no crates and that this machine can build.

use std::fs;
use std::path::{self, Path, PathBuf};
use std::process::{Command, Stdio};

use crate::bench::ratios;
use crate::command::{self, Outcome, cargo, output};
use crate::workspace;

/// The flag with which alberti takes AVX-512 too.
const AVX512: &str = "--avx512";
/// The flag before the folder of raylib.
const RAYLIB: &str = "--raylib";
/// Of that folder, the one that has rlsw, and rlsw there.
const EXTERNAL: &str = "src/external";
const HEADER: &str = "rlsw.h";

/// Draws all scenes by all peers, and prints a table for each size.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    print!("{}", ratios::markdown(&measure(&Options::parse(arguments)?)?)?);
    Ok(())
}

/// Builds the peers and draws all scenes by all: lines of figures.
pub(crate) fn measure(options: &Options) -> Result<String, String> {
    let rlsw = options.raylib.as_deref().map(rlsw).transpose()?;
    let folder = workspace::target_directory().join("peers");
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let mut bench = cargo();
    bench.args(["bench", "--package", "alberti-benches", "--bench", "peers"]);
    if options.avx512 {
        bench.args(["--features", "avx512"]);
    }
    bench.arg("--");
    let rlsw = rlsw.map(|peer| peer.build(&folder)).transpose();
    let rlsw = rlsw.map_err(|message| format!("cannot build rlsw: {message}"))?;
    match llvmpipe().build(&folder) {
        Ok(argument) => _ = bench.arg(argument),
        Err(message) => eprintln!(
            "llvmpipe is left out: {message}; it needs a C compiler and Mesa's OSMesa (Debian: libosmesa6-dev)"
        ),
    }
    output(bench.args(rlsw).stderr(Stdio::inherit()))
}

/// The wishes of the caller.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Options {
    avx512: bool,
    /// The folder of raylib that the user names.
    raylib: Option<PathBuf>,
}

impl Options {
    pub(crate) fn parse(arguments: &[String]) -> Result<Self, String> {
        let mut options = Self::default();
        let mut rest = arguments.iter();
        while let Some(flag) = rest.next() {
            let again = match flag.as_str() {
                AVX512 => std::mem::replace(&mut options.avx512, true),
                RAYLIB => {
                    let folder = match rest.next() {
                        None => Err("nothing".into()),
                        Some(other) if other.is_empty() || other.starts_with("--") => {
                            Err(format!("`{other}`"))
                        }
                        Some(folder) => Ok(folder),
                    };
                    let folder = folder.map_err(|found| {
                        format!("expected a folder of raylib after `{RAYLIB}`, found {found}")
                    })?;
                    options.raylib.replace(folder.into()).is_some()
                }
                _ => return Err(format!("expected `{AVX512}` or `{RAYLIB} FOLDER`, found `{flag}`")),
            };
            if again {
                return Err(format!("expected `{flag}` once, found it twice"));
            }
        }
        Ok(options)
    }
}

/// A peer of another language: its name in the table, and what the compiler is given.
struct Peer {
    name: &'static str,
    source: &'static str,
    flags: Vec<PathBuf>,
    libraries: &'static [&'static str],
}

fn llvmpipe() -> Peer {
    let flags = vec!["-Werror".into()];
    Peer { name: "llvmpipe", source: "benches/peers/osmesa.c", flags, libraries: &["-lOSMesa"] }
}

/// The software renderer of raylib. Its warnings, which are those of the version that the user has, are no errors.
fn rlsw(raylib: &Path) -> Result<Peer, String> {
    // The compiler runs in another folder.
    let external = path::absolute(raylib)
        .map_err(|error| format!("cannot find {}: {error}", raylib.display()))?
        .join(EXTERNAL);
    if !external.join(HEADER).is_file() {
        let found = if raylib.is_dir() { "a folder without it" } else { "no folder" };
        let raylib = raylib.display();
        return Err(format!("expected raylib with {EXTERNAL}/{HEADER} in `{raylib}`, found {found}"));
    }
    let mut flags = vec!["-DRLSW_USE_SIMD_INTRINSICS".into(), "-idirafter".into(), external];
    if cfg!(target_arch = "x86_64") {
        // It does not ask the machine what it has.
        flags.push("-march=native".into());
    }
    Ok(Peer { name: "rlsw", source: "benches/peers/rlsw.c", flags, libraries: &["-lm"] })
}

impl Peer {
    /// Compiles it: the argument by which the benchmark knows it.
    fn build(&self, folder: &Path) -> Result<String, String> {
        let program = folder.join(self.name);
        let mut compiler = Command::new("cc");
        compiler.current_dir(workspace::root()).args(["-O3", "-Wall", "-Wextra"]).args(&self.flags);
        command::run(compiler.args([self.source, "-o"]).arg(&program).args(self.libraries))?;
        Ok(format!("{}={}", self.name, program.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(line: &str) -> Result<Options, String> {
        Options::parse(&line.split_whitespace().map(String::from).collect::<Vec<_>>())
    }

    #[test]
    fn options_come_in_any_order() {
        let both = Options { avx512: true, raylib: Some("some/raylib".into()) };
        assert_eq!(parse("--avx512 --raylib some/raylib").as_ref(), Ok(&both));
        assert_eq!(parse("--raylib some/raylib --avx512"), Ok(both));
        assert_eq!(parse(""), Ok(Options::default()));
    }

    #[test]
    fn wrong_options_are_named() {
        for (line, expected) in [
            ("--raylip x", "expected `--avx512` or `--raylib FOLDER`, found `--raylip`"),
            ("--raylib", "expected a folder of raylib after `--raylib`, found nothing"),
            ("--raylib --avx512", "expected a folder of raylib after `--raylib`, found `--avx512`"),
            ("--avx512 --avx512", "expected `--avx512` once, found it twice"),
            ("--raylib a --raylib b", "expected `--raylib` once, found it twice"),
        ] {
            assert_eq!(parse(line), Err(expected.into()));
        }
    }

    #[test]
    fn a_folder_without_the_header_is_named() {
        for (folder, found) in [(".", "a folder without it"), ("no/such/folder", "no folder")] {
            let message = rlsw(Path::new(folder)).err().expect("there is no header");
            assert_eq!(
                message,
                format!("expected raylib with src/external/rlsw.h in `{folder}`, found {found}")
            );
        }
    }
}
