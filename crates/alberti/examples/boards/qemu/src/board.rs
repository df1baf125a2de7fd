//! The emulated board: memory, counts of instructions and of stack, and a way out.

use alberti_demo::Demo;
use core::hint::black_box;
use core::panic::PanicInfo;
use semihosting::{eprintln, process};
use static_cell::ConstStaticCell;

pub(crate) use semihosting::println;

#[cortex_m_rt::entry]
fn main() -> ! {
    super::run();
    process::exit(0)
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    eprintln!("{info}");
    process::exit(1)
}

/// One demo for each kind of numbers.
pub(crate) fn demos() -> [&'static mut Demo; 2] {
    static DEMOS: [ConstStaticCell<Demo>; 2] = [const { ConstStaticCell::new(Demo::new()) }; 2];
    DEMOS.each_ref().map(ConstStaticCell::take)
}

/// A count of executed instructions, where each takes 32 ns of the emulated time: the board's counter of 25 MHz, which
/// wraps after some minutes, and the one of hundredths of a second, which tells how often it has.
pub(crate) fn instructions() -> u64 {
    const TICKS_OF_A_HUNDREDTH: u64 = 250_000;
    let [hundredths, low] = [0x4002_8014 as *const u32, 0x4002_8018 as *const u32];
    #[expect(unsafe_code, reason = "registers of the board, which may be read at any time")]
    let (hundredths, low) = unsafe { (hundredths.read_volatile(), low.read_volatile()) };
    let nearly = u64::from(hundredths) * TICKS_OF_A_HUNDREDTH;
    let more = low.wrapping_sub(nearly as u32).cast_signed();
    nearly.wrapping_add_signed(more.into()) * 5 / 4
}

/// Words of the stack that are watched, and what they are filled with.
const WATCHED: usize = 4096;
const FILLED: u32 = 0x5ac3_96e1;

/// The bytes of stack that a call takes, up to 16 KB: it is written full before, and read after.
pub(crate) fn stack_of(call: impl FnOnce()) -> usize {
    let bottom = fill();
    call();
    let kept = (0..WATCHED).take_while(|word| {
        let place = (bottom + 4 * word) as *const u32;
        #[expect(unsafe_code, reason = "memory of the stack, which is there whatever it holds")]
        let word = unsafe { place.read_volatile() };
        word == FILLED
    });
    4 * (WATCHED - kept.count())
}

/// Fills the stack below the caller's, and tells where that begins.
#[inline(never)]
fn fill() -> usize {
    let mut words = [0; WATCHED];
    words.fill(black_box(FILLED));
    black_box(&raw const words) as usize
}
