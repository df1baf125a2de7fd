//! Draws a mesh in one colour, with depth, and does nothing else: its size is that of the code a program needs for it.

#![no_std]
#![no_main]

use alberti_firmware::target;
use core::hint::{black_box, spin_loop};
use core::panic::PanicInfo;
use scenes::{Camera, PROBE, flat_fixed};

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    if let Some(target) = target() {
        // The compiler must not know what is drawn, nor that nobody looks.
        flat_fixed(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        black_box(target);
    }
    loop {
        spin_loop();
    }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {
        spin_loop();
    }
}
