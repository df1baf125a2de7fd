//! Draws a textured mesh of integers in bands, and does nothing else: its memory is a renderer's.

#![no_std]
#![no_main]

use alberti_firmware::{bands, program};
use core::hint::black_box;
use scenes::shapes::{Model, torus};
use scenes::{Camera, renderer};

static MODEL: Model = torus(1.0);

fn draw() {
    if let Some(bands) = bands() {
        // The compiler must not know what is drawn, nor that nobody looks.
        renderer::frame(black_box(bands), &Camera::STEADY, black_box(&MODEL), &mut (), |band| {
            _ = black_box(band)
        });
    }
}

program!(draw);
