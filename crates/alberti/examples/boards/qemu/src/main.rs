//! The demo on an emulated Cortex-M, which counts its instructions; on a desktop the same frames, for their bits.
//!
//! One line for each frame and kind of numbers: kind, frame, hash of all that was sent, instructions until the first
//! rows were sent, instructions of the frame without sending. A last line tells the bytes of stack.

#![cfg_attr(target_os = "none", no_std, no_main)]

use alberti::Interpolation;
use alberti_demo::{Demo, FIXED, FLOAT, TURN};
use core::convert::Infallible;
use core::hint::black_box;
use core::ops::Range;
use embassy_futures::block_on;
use panel::Display;

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
use board::{demos, instructions, println, stack_of};

/// The frames of a turn that are drawn.
const FRAMES: u32 = 16;

/// A display that hashes the bytes it is sent, and keeps the time.
struct Sink {
    /// 64-bit FNV-1a.
    hash: u64,
    /// When the first rows of the frame came.
    first: Option<u64>,
    /// What the sending itself took.
    sending: u64,
}

impl Display for Sink {
    type Error = Infallible;

    async fn begin(&mut self) -> Result<(), Infallible> {
        Ok(())
    }

    async fn send(&mut self, columns: Range<u16>, rows: Range<u16>, bytes: &[u8]) -> Result<(), Infallible> {
        let start = instructions();
        self.first.get_or_insert(start);
        let places = [columns.start, columns.end, rows.start, rows.end].map(u16::to_le_bytes);
        // All of it between the two counts.
        let mut hash = black_box(self.hash);
        for byte in places.as_flattened().iter().chain(bytes) {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
        self.hash = black_box(hash);
        self.sending += instructions().wrapping_sub(start);
        Ok(())
    }
}

/// Draws the frames by one kind of numbers.
fn turn(name: &str, demo: &mut Demo, interpolation: impl Interpolation + Copy) {
    let mut sink = Sink { hash: 0xcbf2_9ce4_8422_2325, first: None, sending: 0 };
    for number in 0..FRAMES {
        (sink.first, sink.sending) = (None, 0);
        let start = instructions();
        let Ok(()) = block_on(black_box(&mut *demo).frame(interpolation, &mut sink));
        let all = instructions().wrapping_sub(start + sink.sending);
        let first = sink.first.unwrap_or(start).wrapping_sub(start);
        println!("{name} {number} {:016x} {first} {all}", sink.hash);
        demo.skip(TURN / FRAMES - 1);
    }
}

/// Draws all frames.
fn run() {
    let [fixed, float] = demos();
    turn("fixed", fixed, FIXED);
    turn("float", float, FLOAT);
    let mut sink = Sink { hash: 0, first: None, sending: 0 };
    let stack = stack_of(|| {
        let Ok(()) = block_on(fixed.frame(FIXED, &mut sink));
    });
    println!("stack {stack}");
}

#[cfg(not(target_os = "none"))]
fn main() {
    run();
}

#[cfg(not(target_os = "none"))]
fn demos() -> [&'static mut Demo; 2] {
    [(); 2].map(|()| Box::leak(Box::default()))
}

/// Nobody counts here.
#[cfg(not(target_os = "none"))]
fn instructions() -> u64 {
    0
}

#[cfg(not(target_os = "none"))]
fn stack_of(call: impl FnOnce()) -> usize {
    call();
    0
}
