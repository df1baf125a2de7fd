//! Says how many bytes of stack each program takes that is weighed, one line each: its name and the bytes. It draws a
//! mesh that crosses all planes of the view, for the ways that take the most.

#![no_std]
#![no_main]

use alberti_firmware::{bands, line, stack_of, talking_program, target};
use core::hint::black_box;
use scenes::shapes::{Model, torus};
use scenes::{
    Camera, Draw, Renderer, flat_fixed, lit_fixed, mip_nearest, renderer, textured_affine, textured_fixed,
    textured_planes, textured_spans, trilinear_spans, trilinear_spans_fixed,
};

/// The programs that draw into a whole frame, with their ways of drawing.
static PROGRAMS: [(&str, &[Draw<()>]); 4] = [
    ("size-flat", &[flat_fixed]),
    ("size-textured", &[textured_fixed]),
    ("size-lit", &[lit_fixed]),
    (
        "size-f32",
        &[
            textured_affine,
            textured_spans,
            textured_planes,
            mip_nearest,
            trilinear_spans,
            trilinear_spans_fixed,
        ],
    ),
];

/// A torus around the eye.
static AROUND: Model = torus(2.0);

fn bands_around(bands: &mut Renderer) {
    renderer::frame(bands, &Camera::STEADY, black_box(&AROUND), &mut (), |band| _ = black_box(band));
}

fn stacks() -> u8 {
    let (Some(target), Some(bands)) = (target(), bands()) else { return 2 };
    for (name, draws) in &PROGRAMS {
        let stack = |draw: &Draw<()>| {
            target.clear();
            stack_of(|| draw(black_box(target), &Camera::STEADY, black_box(&AROUND), &mut ()))
        };
        line(format_args!("stack {name} {}", draws.iter().map(stack).max().unwrap_or(0)));
    }
    // Behind a pointer, as the others are: what is inlined here would be on the stack before it is watched.
    let frame: fn(&mut Renderer) = black_box(bands_around);
    let stack = stack_of(|| frame(black_box(bands)));
    line(format_args!("stack size-bands {stack}"));
    0
}

talking_program!(stacks);
