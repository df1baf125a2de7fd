//! Alberti beside its peers in one run, with those that are no crates and that this machine can build.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::command::{self, Outcome, cargo};
use crate::workspace;

/// A peer of another language: its name in the table, its source, the libraries, and where these come from.
struct Peer {
    name: &'static str,
    source: &'static str,
    libraries: &'static [&'static str],
    needs: &'static str,
}

const PEERS: [Peer; 1] = [Peer {
    name: "llvmpipe",
    source: "benches/peers/osmesa.c",
    libraries: &["-lOSMesa"],
    needs: "a C compiler and Mesa's OSMesa (Debian: libosmesa6-dev)",
}];

/// The flag with which alberti takes AVX-512 too.
const AVX512: &str = "--avx512";

/// Builds the peers, draws all scenes by all, and prints the tables of benches/README.md.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let avx512 = match arguments {
        [] => false,
        [flag] if flag == AVX512 => true,
        _ => return Err(format!("expected nothing or `{AVX512}`, found `{}`", arguments.join(" "))),
    };
    let folder = workspace::target_directory().join("peers");
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let mut bench = cargo();
    bench.args(["bench", "--package", "alberti-benches", "--bench", "peers"]);
    if avx512 {
        bench.args(["--features", "avx512"]);
    }
    bench.arg("--");
    for peer in &PEERS {
        let program = folder.join(peer.name);
        match build(peer, &program) {
            Ok(()) => _ = bench.arg(format!("{}={}", peer.name, program.display())),
            Err(message) => eprintln!("{} is left out: {message}; it needs {}", peer.name, peer.needs),
        }
    }
    command::run(&mut bench)
}

fn build(peer: &Peer, program: &Path) -> Outcome {
    let mut compiler = Command::new("cc");
    compiler.current_dir(workspace::root()).args(["-O3", "-Wall", "-Wextra", "-Werror", peer.source, "-o"]);
    command::run(compiler.arg(program).args(peer.libraries))
}
