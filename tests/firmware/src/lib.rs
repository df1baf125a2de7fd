//! What the programs need of a board: memory for a frame, and a count of executed instructions.
//!
//! Boards differ in nothing else, so there is one source for all of them; `boards/` has their memory layouts.

#![no_std]

use core::sync::atomic::{AtomicBool, Ordering};
use scenes::Target;

/// The frame's memory, for the first who asks.
#[must_use]
pub fn target() -> Option<&'static mut Target> {
    static TAKEN: AtomicBool = AtomicBool::new(false);
    static mut TARGET: Target = Target::EMPTY;
    // Two steps, since the smallest cores have no atomic swap; there is one thread and no interrupt.
    if TAKEN.load(Ordering::Relaxed) {
        return None;
    }
    TAKEN.store(true, Ordering::Relaxed);
    #[expect(
        unsafe_code,
        reason = "static memory that is too large for a stack; the flag makes this the only borrow"
    )]
    let target = unsafe { &mut *(&raw mut TARGET) };
    Some(target)
}

/// A counter that grows with the executed instructions and wraps; `cargo xtask firmware` knows its ticks.
///
/// It is the counter of the MPS2's FPGA, which runs at 25 MHz of the emulated time.
#[cfg(target_arch = "arm")]
#[must_use]
pub fn ticks() -> u32 {
    let counter = 0x4002_8018 as *const u32;
    #[expect(unsafe_code, reason = "a register of the board, which may be read at any time")]
    let ticks = unsafe { counter.read_volatile() };
    ticks
}

/// A counter that grows with the executed instructions and wraps.
#[cfg(target_arch = "riscv32")]
#[must_use]
pub fn ticks() -> u32 {
    #[expect(clippy::cast_possible_truncation, reason = "the low half is enough for a difference")]
    let ticks = riscv::register::minstret::read() as u32;
    ticks
}
