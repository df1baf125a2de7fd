//! Draws a mesh that has a mip map under the light of its vertices, with depth, and does nothing else: its size is that
//! of the code a program needs for it, and of the 10,922 bytes of its texture.

#![no_std]
#![no_main]

use alberti_firmware::{program, target};
use core::hint::black_box;
use scenes::{Camera, PROBE, lit_fixed};

fn draw() {
    if let Some(target) = target() {
        // The compiler must not know what is drawn, nor that nobody looks.
        lit_fixed(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        black_box(target);
    }
}

program!(draw);
