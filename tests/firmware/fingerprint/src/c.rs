//! The fingerprints for whoever is not Rust: a C program, or the host of a WebAssembly module.

#![allow(
    unsafe_code,
    unreachable_pub,
    reason = "functions that C calls by their names, one memory for a program of one thread"
)]

use crate::{Memory, SCENES, fingerprint, machine};

static mut MEMORY: Memory = Memory::EMPTY;

/// The number of scenes.
#[unsafe(no_mangle)]
pub extern "C" fn fingerprint_scenes() -> u32 {
    SCENES
}

/// The upper (1) or lower (0) half of the hash of a scene by the lanes of this machine; 0 where there is none.
#[unsafe(no_mangle)]
pub extern "C" fn fingerprint_half(number: u32, upper: u32) -> u32 {
    // SAFETY: callers have one thread, and nothing else takes the memory.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let hash = machine().and_then(|machine| fingerprint(number, machine, memory)).unwrap_or(0);
    let half = if upper == 0 { hash } else { hash >> 32 };
    #[expect(clippy::cast_possible_truncation, reason = "one half after the other")]
    let half = half as u32;
    half
}

#[cfg(not(test))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
