//! Draws scenes, files `00`, `01` and so on of the folder in which the emulator was started, by every policy. One line
//! each: scene, number of the policy, hash, ticks, bytes of stack.

#![no_std]
#![no_main]

use alberti_firmware::{line, loaded, memory, passed, stack_of, talking_program, ticks};
use core::ffi::CStr;
use core::hint::black_box;
use scenes::policies::POLICIES;
use semihosting::fs::File;
use semihosting::io::Read;

/// The scenes whose stack is told: one that is clipped, which takes the most, and one that is not.
const WATCHED: [u8; 2] = [1, 3];

fn frames() -> u8 {
    let (Some(memory), Some(loaded)) = (memory(), loaded()) else { return 2 };
    for number in 0..100 {
        let name = [b'0' + number / 10, b'0' + number % 10, 0];
        let Ok(Ok(file)) = CStr::from_bytes_with_nul(&name).map(File::open) else { break };
        let Some(scene) = loaded.read(words(file)) else { return 3 };
        for (policy, index) in POLICIES.iter().zip(0..) {
            let draw = policy.draw;
            memory.clear(policy);
            passed();
            let start = ticks();
            draw(black_box(memory), black_box(&scene));
            let end = ticks();
            passed();
            let hash = memory.hash();
            let mut stack = 0;
            if WATCHED.contains(&number) {
                memory.clear(policy);
                stack = stack_of(|| draw(black_box(memory), black_box(&scene)));
            }
            line(format_args!("{number} {index} {hash:016x} {} {stack}", end.wrapping_sub(start)));
        }
    }
    0
}

/// A file's words, low byte first.
fn words(mut file: File) -> impl FnMut() -> Option<u32> {
    let mut buffer = [0; 1024];
    let (mut at, mut end) = (0, 0);
    move || {
        if at == end {
            (at, end) = (0, file.read(&mut buffer).ok()? & !3);
        }
        let word = buffer.get(at..at + 4).filter(|_| at < end)?;
        at += 4;
        Some(u32::from_le_bytes(word.try_into().ok()?))
    }
}

talking_program!(frames);
