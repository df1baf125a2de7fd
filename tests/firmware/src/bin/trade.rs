//! Draws scenes, files `00`, `01` and so on of the folder in which the emulator was started, by every policy. One line
//! each: scene, number of the policy, hash, ticks, bytes of stack.

#![no_std]
#![no_main]

use alberti_firmware::{loaded, memory, passed, stack_of, ticks};
use core::ffi::CStr;
use core::hint::black_box;
use core::panic::PanicInfo;
use scenes::policies::POLICIES;
use semihosting::fs::File;
use semihosting::io::Read;
use semihosting::{eprintln, println, process};

/// The scenes whose stack is told: one that is clipped, which takes the most, and one that is not.
const WATCHED: [u8; 2] = [1, 3];

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let (Some(memory), Some(loaded)) = (memory(), loaded()) else { process::exit(2) };
    for number in 0..100 {
        let name = [b'0' + number / 10, b'0' + number % 10, 0];
        let Ok(Ok(file)) = CStr::from_bytes_with_nul(&name).map(File::open) else { break };
        let Some(scene) = loaded.read(words(file)) else { process::exit(3) };
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
            println!("{number} {index} {hash:016x} {} {stack}", end.wrapping_sub(start));
        }
    }
    process::exit(0)
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

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    eprintln!("{info}");
    process::exit(1)
}
