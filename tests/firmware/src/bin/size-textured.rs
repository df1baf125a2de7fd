//! Draws a textured mesh in perspective, with depth, and does nothing else: its size is that of the code a program
//! needs for it.

#![no_std]
#![no_main]

use alberti_firmware::{program, target};
use core::hint::black_box;
use scenes::{Camera, PROBE, textured_fixed};

fn draw() {
    if let Some(target) = target() {
        // The compiler must not know what is drawn, nor that nobody looks.
        textured_fixed(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        black_box(target);
    }
}

program!(draw);
