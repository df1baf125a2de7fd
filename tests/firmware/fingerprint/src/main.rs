//! Prints the number, the kind and the hash of all scenes; fails where two kinds of lanes differ.

use alberti::lanes::Machine;
use fingerprint::{Memory, SCENES, fingerprint, kind};
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut memory = Box::new(Memory::EMPTY);
    let mut differs = false;
    for number in 0..SCENES {
        let mut first = None;
        for machine in Machine::all() {
            let found = fingerprint(number, machine, &mut memory).unwrap_or(0);
            let expected = *first.get_or_insert(found);
            if found != expected {
                eprintln!(
                    "scene {number} ({}): {found:016x} by {machine:?}, {expected:016x} before",
                    kind(number)
                );
                differs = true;
            }
        }
        println!("{number} {} {:016x}", kind(number), first.unwrap_or(0));
    }
    eprintln!("by {:?}", Machine::all().collect::<Vec<_>>());
    if differs { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
