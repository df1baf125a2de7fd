//! What the programs need of a board: memory for a frame, and counts of executed instructions and of stack.
//!
//! Boards differ in nothing else, so there is one source for all of them; `boards/` has their memory layouts.

#![no_std]

use core::hint::black_box;
use core::sync::atomic::{AtomicBool, Ordering};
use scenes::Target;
use scenes::policies::{Loaded, Memory};

/// Defines functions that give static memory to the first who asks.
macro_rules! memories {
    ($($(#[$doc:meta])* $name:ident: $type:ty;)*) => {$(
        $(#[$doc])*
        #[must_use]
        pub fn $name() -> Option<&'static mut $type> {
            static TAKEN: AtomicBool = AtomicBool::new(false);
            static mut MEMORY: $type = <$type>::EMPTY;
            // Two steps, since the smallest cores have no atomic swap; there is one thread and no interrupt.
            if TAKEN.load(Ordering::Relaxed) {
                return None;
            }
            TAKEN.store(true, Ordering::Relaxed);
            #[expect(
                unsafe_code,
                reason = "static memory that is too large for a stack; the flag makes this the only borrow"
            )]
            let memory = unsafe { &mut *(&raw mut MEMORY) };
            Some(memory)
        }
    )*};
}

memories! {
    /// A frame's memory.
    target: Target;

    /// That of a frame by any policy.
    memory: Memory;

    /// Room for a scene that is read.
    loaded: Loaded;
}

/// A counter that grows with the executed instructions; `cargo xtask firmware` knows its ticks.
///
/// It is the counter of the MPS2's FPGA, which runs at 25 MHz of the emulated time and wraps after some minutes. The
/// one beside it, of hundredths of a second, tells how often it has.
#[cfg(target_arch = "arm")]
#[must_use]
pub fn ticks() -> u64 {
    const TICKS_OF_A_HUNDREDTH: u64 = 250_000;
    let [hundredths, low] = [0x4002_8014 as *const u32, 0x4002_8018 as *const u32];
    #[expect(unsafe_code, reason = "registers of the board, which may be read at any time")]
    let (hundredths, low) = unsafe { (hundredths.read_volatile(), low.read_volatile()) };
    let nearly = u64::from(hundredths) * TICKS_OF_A_HUNDREDTH;
    #[expect(clippy::cast_possible_truncation, reason = "the low half")]
    let more = low.wrapping_sub(nearly as u32).cast_signed();
    nearly.wrapping_add_signed(more.into())
}

/// A counter that grows with the executed instructions.
#[cfg(target_arch = "riscv32")]
#[must_use]
pub fn ticks() -> u64 {
    riscv::register::minstret::read64()
}

/// Makes a program that calls a function and does nothing else.
#[macro_export]
macro_rules! program {
    ($draw:expr) => {
        #[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
        #[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
        fn main() -> ! {
            $draw();
            loop {
                core::hint::spin_loop();
            }
        }

        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            loop {
                core::hint::spin_loop();
            }
        }
    };
}

/// A place that `cargo xtask trade` hears of when it is passed, for what it counts between two of them.
#[inline(never)]
#[expect(unsafe_code, reason = "the name under which the place is found")]
#[unsafe(no_mangle)]
pub extern "C" fn passed() {
    black_box(());
}

/// The bytes of stack that a call takes, up to 16 KB: it is written full before, and read after.
pub fn stack_of(call: impl FnOnce()) -> usize {
    let bottom = fill();
    call();
    unchanged(bottom)
}

/// Words of the stack that are watched, and what they are filled with.
const WATCHED: usize = 4096;
const FILLED: u32 = 0x5ac3_96e1;

/// Fills the stack below the caller's, and tells where that begins.
#[inline(never)]
fn fill() -> usize {
    let mut words = [0; WATCHED];
    words.fill(black_box(FILLED));
    black_box(&raw const words) as usize
}

/// The bytes above the lowest word that is no longer as it was filled.
#[inline(never)]
fn unchanged(bottom: usize) -> usize {
    let kept = (0..WATCHED).take_while(|word| {
        let place = (bottom + 4 * word) as *const u32;
        #[expect(unsafe_code, reason = "memory of the stack, which is there whatever it holds")]
        let word = unsafe { place.read_volatile() };
        word == FILLED
    });
    4 * (WATCHED - kept.count())
}
