//! Says the hash of every small scene: its number, and the hash.

#![no_std]
#![no_main]

use alberti_firmware::{line, passed, small, talking_program};
use fingerprint::{SCENES, fingerprint, machine};

fn all() -> u8 {
    let (Some(memory), Some(machine)) = (small(), machine()) else { return 2 };
    for number in 0..SCENES {
        passed();
        let Some(hash) = fingerprint(number, machine, memory) else { return 3 };
        line(format_args!("{number} {hash:016x}"));
    }
    0
}

talking_program!(all);
