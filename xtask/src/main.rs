//! The chores of this repository: `cargo xtask help` lists them.
//!
//! People and the continuous-integration script call the same commands, so "it passes here" and "it passes there"
//! mean the same thing. The program uses no crate of this workspace, and few others: it must build quickly and before
//! anything else works.

mod accuracy;
mod assets;
mod bench;
mod boards;
mod book;
mod build_cost;
mod checks;
mod ci;
mod command;
mod coverage;
mod elf;
mod embedded;
mod extremes;
mod film;
mod firmware;
mod formulas;
mod fuzz;
mod gallery;
mod golden;
mod growth;
mod guide;
mod nostd;
mod package;
mod peers;
mod seeded;
mod supply;
mod tidy;
mod tool;
mod trade;
mod wasm;
mod web;
mod window;
mod workspace;

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use build_cost::compilation;
use command::Outcome;

/// One line of `cargo xtask help`, and what that line runs.
struct Chore {
    name: &'static str,
    /// The arguments as the help shows them; empty for a chore that takes none.
    arguments: &'static str,
    about: &'static str,
    run: fn(&[String]) -> Outcome,
}

/// All chores, in the order in which the help lists them.
const CHORES: &[Chore] = &[
    Chore {
        name: "ci",
        arguments: "[--tests-done] [--all] [--within MINUTES] [CHECK...]",
        about: "the checks below, or those named, up to the first failure",
        run: ci::run,
    },
    Chore {
        name: "tidy",
        arguments: "",
        about: "test the repository itself: names, sizes, dependency arrows",
        run: |_| tidy::run(),
    },
    Chore {
        name: "fmt",
        arguments: "",
        about: "check the formatting (`cargo fmt --all` repairs it)",
        run: |_| checks::fmt(),
    },
    Chore {
        name: "lint",
        arguments: "",
        about: "clippy on all targets, warnings are errors",
        run: |_| checks::lint(),
    },
    Chore {
        name: "docs",
        arguments: "",
        about: "build the documentation, warnings are errors",
        run: |_| checks::docs(),
    },
    Chore { name: "test", arguments: "", about: "`cargo test --workspace`", run: |_| checks::test() },
    Chore {
        name: "package",
        arguments: "",
        about: "check the crates as they would be published",
        run: |_| package::run(),
    },
    Chore {
        name: "nostd",
        arguments: "",
        about: "check the libraries for Cortex-M0 and Cortex-M4F",
        run: |_| nostd::run(),
    },
    Chore {
        name: "firmware",
        arguments: "[--board b] [--write]",
        about: "run scenes on emulated cores: same bits as here, instructions, flash and RAM as in the table",
        run: firmware::run,
    },
    Chore {
        name: "fingerprint",
        arguments: "[machine...]",
        about: "draw small scenes on all machines that can be had here: the same bits on each",
        run: firmware::fingerprint,
    },
    Chore {
        name: "boards",
        arguments: "[board | qemu | check]",
        about: "build the programs of crates/alberti/examples/boards, or one, or run the demo in an emulator, or all",
        run: boards::run,
    },
    Chore {
        name: "guide",
        arguments: "",
        about: "follow docs/firmware.md word for word, up to the picture and a board's program",
        run: |_| guide::run(),
    },
    Chore { name: "golden", arguments: "[test]", about: "write the golden images anew", run: golden::run },
    Chore {
        name: "accuracy",
        arguments: "",
        about: "measure every function's error, and write docs/accuracy.md",
        run: |_| accuracy::run(),
    },
    Chore {
        name: "assets",
        arguments: "[--check]",
        about: "write the textures of crates/app/scenes, which code makes, or check that they are the same",
        run: assets::run,
    },
    Chore {
        name: "gallery",
        arguments: "[scene|--check]",
        about: "render the scenes of crates/app/scenes, and write docs/gallery.md, or check that all is current",
        run: gallery::run,
    },
    Chore {
        name: "film",
        arguments: "",
        about: "draw a film by four processes, one of which fails at first, and compare it with that of one",
        run: |_| film::check(),
    },
    Chore {
        name: "window",
        arguments: "",
        about: "open `alberti view` in an X server without a screen, press keys, and compare its pictures",
        run: |_| window::check(),
    },
    Chore {
        name: "web",
        arguments: "[--check | --speed]",
        about: "build the page of crates/web, and look at it in a browser, or time its pictures",
        run: web::web,
    },
    Chore {
        name: "book",
        arguments: "",
        about: "make one book of docs/ and the pages beside it, which can be searched, and follow its links",
        run: |_| book::check(),
    },
    Chore {
        name: "sweep",
        arguments: "[name] [--shard K/N] [--seed S] [--time SECONDS]",
        about: "look at every case, or at as many hard ones as there is time for; goes on where it was stopped",
        run: checks::sweep,
    },
    Chore {
        name: "fuzz",
        arguments: "[target...] [--time S] [--jobs N] [--shard K/N] [--address] [--keep]",
        about: "fuzz the targets of tests/hostile, guided by coverage; --address has a sanitizer, of nightly; --keep adds cases",
        run: fuzz::fuzz,
    },
    Chore {
        name: "mutants",
        arguments: "[--seconds S] [--only TEXT]",
        about: "have the tests meet the mutants of cargo-mutants, all in one program; goes on where it was stopped",
        run: checks::mutants,
    },
    Chore {
        name: "coverage",
        arguments: "[--list]",
        about: "run the tests with counters: lines of the libraries that ran (--list: those that did not)",
        run: coverage::coverage,
    },
    Chore {
        name: "supply",
        arguments: "",
        about: "check dependencies by deny.toml, and that the oldest compiler of the manifests is enough",
        run: |_| supply::check(),
    },
    Chore {
        name: "semver",
        arguments: "[commit]",
        about: "compare the libraries' interfaces with those of the last version, or of a commit",
        run: supply::semver,
    },
    Chore {
        name: "seeded-bugs",
        arguments: "[--apply] [NAME...]",
        about: "put the bugs of tests/seeded into a copy one by one: a test must notice each (--apply: only look)",
        run: seeded::run,
    },
    Chore {
        name: "build-cost",
        arguments: "[part] [--check]",
        about: "measure building from nothing beside its goals (parts: command, tests, edit)",
        run: build_cost::run,
    },
    Chore {
        name: "bench",
        arguments: "[counts | --check] [--raylib dir]",
        about: "measure instructions, times and peers, and write docs/benchmarks.md (--check: instructions alone)",
        run: bench::run,
    },
    Chore {
        name: "peers",
        arguments: "[--avx512] [--raylib dir]",
        about: "time all scenes beside all peers in one run, with those in C that can be built here",
        run: peers::run,
    },
    Chore {
        name: "growth",
        arguments: "",
        about: "time frames of 64x64 to 8192x8192 pixels and of 10^2 to 10^7 triangles, and write docs/growth.md",
        run: |_| growth::run(),
    },
    Chore {
        name: "trade",
        arguments: "[--check] [--boards]",
        about: "measure every policy's error and cost, and write docs/trade.md (or its chapter of boards), or compare",
        run: trade::run,
    },
    Chore {
        name: "advice",
        arguments: "",
        about: "compare what `alberti advise` picks with the best of all policies, and write docs/advice.md",
        run: |_| trade::advice(),
    },
    Chore {
        name: "extremes",
        arguments: "[--small | --check | ...]",
        about: "hold every policy to its bounds at the ends of its parameters, and write docs/extremes.md (--help: more)",
        run: extremes::measure,
    },
];

fn main() -> ExitCode {
    if let Some(log) = std::env::var_os(compilation::LOG) {
        let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
        return compilation::wrap(Path::new(&log), &arguments);
    }
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((name, rest)) = arguments.split_first() else {
        print!("{}", help());
        return ExitCode::from(2);
    };
    if matches!(name.as_str(), "help" | "--help" | "-h") {
        print!("{}", help());
        return ExitCode::SUCCESS;
    }
    let Some(chore) = CHORES.iter().find(|chore| chore.name == name) else {
        eprintln!("xtask: there is no command `{name}`; `cargo xtask help` lists the commands");
        return ExitCode::from(2);
    };
    if let (true, Some(extra)) = (chore.arguments.is_empty(), rest.first()) {
        eprintln!("xtask: `{name}` takes no arguments, found `{extra}`");
        return ExitCode::from(2);
    }
    match (chore.run)(rest) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask {name}: {message}");
            ExitCode::FAILURE
        }
    }
}

fn help() -> String {
    let mut text = String::from("usage: cargo xtask <command>\n\n");
    for chore in CHORES {
        let call = format!("{} {}", chore.name, chore.arguments);
        text.push_str(&format!("  {call:<31}  {}\n", chore.about));
    }
    text.push_str(
        "\n`ci --tests-done` leaves out `cargo test --workspace`: the caller has just run it on this tree. Long checks are
left out, but for a sample, where they have passed on the same files, of which .ci/passed keeps the digests;
`--all` does all.\n",
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_lists_every_chore_once() {
        let text = help();
        for chore in CHORES {
            let lines = text.lines().filter(|line| line.split_whitespace().next() == Some(chore.name));
            assert_eq!(lines.count(), 1, "{}", chore.name);
        }
    }
}
