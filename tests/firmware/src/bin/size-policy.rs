//! Draws one scene by one policy, and does nothing else: its size is that of the code a program needs for it. The
//! policy's number is in the variable `ALBERTI_POLICY` when it is compiled.

#![no_std]
#![no_main]

use alberti_firmware::{loaded, memory, program};
use core::hint::black_box;
use scenes::Camera;
use scenes::policies::{POLICIES, Policy};

/// The policy: without a number the first.
const POLICY: Policy = POLICIES[number(match option_env!("ALBERTI_POLICY") {
    Some(text) => text,
    None => "0",
})];

const fn number(text: &str) -> usize {
    match usize::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => panic!("ALBERTI_POLICY is the number of a policy"),
    }
}

fn draw() {
    if let (Some(memory), Some(loaded)) = (memory(), loaded()) {
        // The compiler must not know what is drawn, nor that nobody looks.
        let [vertices, triangles] = [4, 2].map(black_box);
        if let Some(scene) = loaded.scene(Camera::STEADY.view(), vertices, triangles, black_box(64)) {
            (POLICY.draw)(black_box(&mut *memory), black_box(&scene));
        }
        black_box(memory);
    }
}

program!(draw);
