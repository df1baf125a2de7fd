//! The way out of a board: lines of text, and the end of the program.

#[cfg(not(target_arch = "wasm32"))]
mod way {
    use core::fmt::Arguments;

    /// Writes a line.
    pub fn line(text: Arguments<'_>) {
        semihosting::println!("{text}");
    }

    /// Ends the program with a status.
    pub fn exit(status: u8) -> ! {
        semihosting::process::exit(status.into())
    }
}

/// Two functions of `boards/node.js`.
#[cfg(target_arch = "wasm32")]
mod way {
    use core::fmt::{self, Arguments, Write};

    #[expect(unsafe_code, reason = "the host's functions, which only read the bytes that they are given")]
    #[link(wasm_import_module = "env")]
    unsafe extern "C" {
        safe fn write(text: *const u8, length: usize);
        safe fn end(status: i32) -> !;
    }

    struct Host;

    impl Write for Host {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            write(text.as_ptr(), text.len());
            Ok(())
        }
    }

    /// Writes a line.
    pub fn line(text: Arguments<'_>) {
        // The host takes every line.
        let _ = writeln!(Host, "{text}");
    }

    /// Ends the program with a status.
    pub fn exit(status: u8) -> ! {
        end(status.into())
    }
}

pub use way::{exit, line};
