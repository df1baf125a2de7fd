//! Counts of executed instructions and of bytes of stack.

use core::hint::black_box;

/// The registers of the MPS2's FPGA: hundredths of a second, and the counter beside it. With the image AN505 they are
/// elsewhere, and the counter is slower.
#[cfg(target_arch = "arm")]
const REGISTERS: [usize; 2] = if V8M { [0x5030_2014, 0x5030_2018] } else { [0x4002_8014, 0x4002_8018] };
#[cfg(target_arch = "arm")]
const TICKS_OF_A_HUNDREDTH: u64 = if V8M { 200_000 } else { 250_000 };
#[cfg(target_arch = "arm")]
const V8M: bool = cfg!(armv8m);

/// A counter that grows with the executed instructions; `cargo xtask firmware` knows its ticks.
///
/// It is the counter of the MPS2's FPGA, which runs at 25 or 20 MHz of the emulated time and wraps after some minutes.
/// The one beside it, of hundredths of a second, tells how often it has.
#[cfg(target_arch = "arm")]
#[must_use]
pub fn ticks() -> u64 {
    let [hundredths, low] = REGISTERS.map(|place| place as *const u32);
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

/// No counter: Node tells none.
#[cfg(target_arch = "wasm32")]
#[must_use]
pub fn ticks() -> u64 {
    0
}

/// A place that `cargo xtask` hears of when it is passed, for what it counts between two of them.
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
