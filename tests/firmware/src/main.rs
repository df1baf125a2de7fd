//! Draws every scene and says what the frame is and what it took, one line each: name, hash, ticks.

#![no_std]
#![no_main]

use alberti_firmware::{line, passed, talking_program, target, ticks};
use core::hint::black_box;
use scenes::SCENES;

fn frames() -> u8 {
    let Some(target) = target() else { return 2 };
    for scene in SCENES {
        target.clear();
        passed();
        let start = ticks();
        (scene.draw)(black_box(target), &scene.camera, &scene.model, &mut ());
        let end = ticks();
        passed();
        line(format_args!("frame {} {:016x} {}", scene.name, target.hash(), end.wrapping_sub(start)));
    }
    0
}

talking_program!(frames);
