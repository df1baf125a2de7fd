//! Draws every scene and says what the frame is and what it took, one line each: name, hash, ticks.

#![no_std]
#![no_main]

use alberti_firmware::{target, ticks};
use core::hint::black_box;
use core::panic::PanicInfo;
use scenes::SCENES;
use semihosting::{eprintln, println, process};

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let Some(target) = target() else { process::exit(2) };
    for scene in SCENES {
        target.clear();
        let start = ticks();
        (scene.draw)(black_box(target), &scene.camera, &scene.model, &mut ());
        let end = ticks();
        println!("frame {} {:016x} {}", scene.name, target.hash(), end.wrapping_sub(start));
    }
    process::exit(0)
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    eprintln!("{info}");
    process::exit(1)
}
