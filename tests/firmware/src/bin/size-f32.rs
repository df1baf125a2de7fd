//! Draws textured meshes in `f32` by all policies that are set up once a triangle or a run, with derivatives once a
//! triangle and once a run, and does nothing else. It tells whether any of them needs functions of `f64`.

#![no_std]
#![no_main]

use alberti_firmware::{program, target};
use core::hint::black_box;
use scenes::{
    Camera, PROBE, mip_nearest, textured_affine, textured_planes, textured_spans, trilinear_spans,
    trilinear_spans_fixed,
};

fn draw() {
    if let Some(target) = target() {
        // The compiler must not know what is drawn, nor that nobody looks.
        textured_affine(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        textured_spans(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        textured_planes(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        mip_nearest(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        trilinear_spans(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        trilinear_spans_fixed(black_box(&mut *target), &Camera::STEADY, black_box(&PROBE), &mut ());
        black_box(target);
    }
}

program!(draw);
