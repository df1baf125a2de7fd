//! `sweep NAME [--shard K/N] [--seed S] [--time SECONDS] [--folder F]`: see `cargo xtask sweep`.

use alberti_sweeps::SWEEPS;
use alberti_sweeps::run::{Wish, run};
use std::process::ExitCode;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words.is_empty() {
        SWEEPS.iter().for_each(|sweep| println!("{:<12}{}", sweep.name, sweep.about));
        return ExitCode::SUCCESS;
    }
    match Wish::read(&words).and_then(|wish| run(&wish)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("sweep: {message}");
            ExitCode::FAILURE
        }
    }
}
