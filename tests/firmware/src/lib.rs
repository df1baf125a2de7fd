//! The board, as the programs see it: memory for a frame, counts of executed instructions and of stack, and a way out.
//!
//! Boards differ in nothing else, so there is one source for all of them; `boards/` has their memory layouts.

#![no_std]

mod console;
mod counts;

pub use console::{exit, line};
pub use counts::{passed, stack_of, ticks};

use core::sync::atomic::{AtomicBool, Ordering};
use scenes::policies::{Loaded, Memory};
use scenes::{Renderer, Target, renderer};

/// Defines functions that give static memory to the first who asks.
macro_rules! memories {
    ($($(#[$doc:meta])* $name:ident: $type:ty = $empty:expr;)*) => {$(
        $(#[$doc])*
        #[must_use]
        pub fn $name() -> Option<&'static mut $type> {
            static TAKEN: AtomicBool = AtomicBool::new(false);
            static mut MEMORY: $type = $empty;
            // Two steps, since the smallest cores have no atomic swap; there is one thread and no interrupt.
            if TAKEN.load(Ordering::Relaxed) {
                return None;
            }
            TAKEN.store(true, Ordering::Relaxed);
            #[expect(
                unsafe_code,
                reason = "static memory that is too large for a stack; the flag makes this the only borrow"
            )]
            let memory = unsafe { &mut *(&raw mut MEMORY) };
            Some(memory)
        }
    )*};
}

memories! {
    /// A frame's memory.
    target: Target = Target::EMPTY;

    /// That of a renderer in bands.
    bands: Renderer = renderer::EMPTY;

    /// That of a frame by any policy.
    memory: Memory = Memory::EMPTY;

    /// That of a small scene.
    small: fingerprint::Memory = fingerprint::Memory::EMPTY;

    /// Room for a scene that is read.
    loaded: Loaded = Loaded::EMPTY;
}

/// Begins a program, which never comes to the end of this.
#[macro_export]
macro_rules! begin {
    ($all:expr) => {
        #[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
        #[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
        #[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
        #[cfg_attr(target_arch = "wasm32", expect(unsafe_code, reason = "the name that the host calls"))]
        fn begin() -> ! {
            $all
        }
    };
}

/// Makes a program that calls a function and does nothing else.
#[macro_export]
macro_rules! program {
    ($draw:expr) => {
        $crate::begin!({
            $draw();
            loop {
                core::hint::spin_loop();
            }
        });

        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            loop {
                core::hint::spin_loop();
            }
        }
    };
}

/// Makes a program that calls a function and ends, with a message if it panics.
#[macro_export]
macro_rules! talking_program {
    ($run:expr) => {
        $crate::begin!($crate::exit($run()));

        #[panic_handler]
        fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
            $crate::line(format_args!("{info}"));
            $crate::exit(1)
        }
    };
}
