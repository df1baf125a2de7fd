//! All mutants of cargo-mutants in one program, of which a variable says the one that is alive.
//!
//! `cargo mutants --list` names small changes of the libraries: an operator for another, a function that returns a
//! constant, a match without one of its arms. To compile each on its own would take days. Here a copy of the libraries
//! has all of them at once, each behind a switch, so that they are compiled once:
//!
//! ```text
//! a + b    becomes    match (a, b) { (l, r) => if mutant(17) { l - r } else if mutant(18) { l * r } else { l + r } }
//! ```
//!
//! Tables that a program computes while it is compiled are made when it runs, where nothing needs them before.
//!
//! Each test is run once on its own, and says which switches it passes. Then each mutant meets the tests that pass its
//! switch, until one of them fails: first those that have killed others of its file, then the quickest. The state is
//! kept in a file: a run that was stopped goes on. Mutants come in an order of chance, so that those of a part of a run
//! stand for all.

mod compile;
mod list;
mod report;
mod rewrite;
mod run;
mod suite;
mod tables;
mod tree;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The libraries whose mutants are looked at.
pub(crate) const LIBRARIES: [&str; 4] = ["math", "projection", "raster", "texture"];

/// What the command line says.
struct Options {
    /// Below it lie the copy and the state.
    folder: PathBuf,
    /// Seconds of tests that a mutant meets at most, each of which takes as long as without it.
    seconds: f64,
    /// A part of names; the mutants with others are left out.
    only: Option<String>,
    /// Minutes after which no other mutant is begun.
    minutes: f64,
}

fn main() -> ExitCode {
    match options().and_then(|options| all(&options)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("mutants: {message}");
            ExitCode::FAILURE
        }
    }
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        folder: PathBuf::from("target/mutants"),
        seconds: 60.0,
        only: None,
        minutes: f64::INFINITY,
    };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let value = words.next().ok_or_else(|| format!("expected a value after `{word}`"))?;
        match word.as_str() {
            "--folder" => options.folder = value.into(),
            "--only" => options.only = Some(value),
            "--seconds" => options.seconds = above_0(&word, &value)?,
            "--minutes" => options.minutes = above_0(&word, &value)?,
            _ => return Err(format!("expected --folder, --seconds, --minutes or --only, found `{word}`")),
        }
    }
    Ok(options)
}

fn above_0(option: &str, value: &str) -> Result<f64, String> {
    let number = value.parse().ok().filter(|number| *number > 0.0);
    number.ok_or_else(|| format!("expected {option} above 0, found `{value}`"))
}

fn all(options: &Options) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mutants = list::mutants(&root)?;
    println!("{} mutants", mutants.len());
    let tree = tree::Tree::new(&root, &options.folder, &mutants)?;
    let compiled = compile::compile(&tree, &mutants)?;
    println!("{} of them are in the program", compiled.alive.len());
    let suite = suite::Suite::measured(&tree, &compiled.programs, mutants.len())?;
    println!("{} tests, {:.1} s in all", suite.tests.len(), suite.seconds());
    let verdicts = run::run(&tree, &suite, &mutants, &compiled.alive, options)?;
    print!("{}", report::report(&mutants, &compiled.left_out, &verdicts));
    Ok(())
}
