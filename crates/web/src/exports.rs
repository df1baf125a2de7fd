//! The functions that the page calls. It writes parameters and files into this memory, and reads pixels, results and
//! messages from it; every address is that of a buffer that is here.
#![expect(unsafe_code, reason = "a name that is not mangled counts as unsafe; all else is safe")]

use crate::{Fault, PARAMETERS, Page, Parameters, Station, model};
use alloc::format;
use alloc::string::{String, ToString};
use spin::Mutex;

#[cfg(target_arch = "wasm32")]
#[global_allocator]
static ALLOCATOR: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

static PAGE: Mutex<Page> = Mutex::new(Page::new());

/// The controls' positions, which the page writes.
static CONTROLS: Mutex<Parameters> = Mutex::new([0.0; PARAMETERS]);

/// The address of the parameters, [`PARAMETERS`] numbers.
#[unsafe(no_mangle)]
pub extern "C" fn parameters() -> *const f32 {
    CONTROLS.lock().as_ptr()
}

/// Draws a station, and returns the address of its pixels, or 0 and a message.
#[unsafe(no_mangle)]
pub extern "C" fn pixels(station: u32, width: u32, height: u32) -> *const u32 {
    rows(station, width, height, 0, height)
}

/// Draws some rows of a station, and returns the address of their pixels, or 0 and a message.
#[unsafe(no_mangle)]
pub extern "C" fn rows(station: u32, width: u32, height: u32, first: u32, end: u32) -> *const u32 {
    let page = &mut *PAGE.lock();
    let drawn = match Station::ALL.get(station as usize) {
        Some(station) => page
            .draw_rows(*station, ([width, height], first..end), &CONTROLS.lock())
            .map_err(|Fault(words)| words),
        None => Err(format!("there is no station {station}")),
    };
    match drawn {
        Ok(()) => {
            page.message = String::new();
            page.canvas.drawn().as_ptr()
        }
        Err(message) => {
            page.message = message;
            core::ptr::null()
        }
    }
}

/// The address of the numbers that belong to the last picture.
#[unsafe(no_mangle)]
pub extern "C" fn results() -> *const f32 {
    PAGE.lock().results.as_ptr()
}

/// The number of them.
#[unsafe(no_mangle)]
pub extern "C" fn result_count() -> usize {
    PAGE.lock().results.len()
}

/// The address of the message, in UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn message() -> *const u8 {
    PAGE.lock().message.as_ptr()
}

/// The bytes of the message: 0 if all went well.
#[unsafe(no_mangle)]
pub extern "C" fn message_length() -> usize {
    PAGE.lock().message.len()
}

/// Makes room for a file of so many bytes, and returns its address, or 0 and a message.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(bytes: usize) -> *mut u8 {
    let page = &mut *PAGE.lock();
    match page.model().reserve(bytes) {
        Ok(room) => {
            let address = room.as_mut_ptr();
            page.message = String::new();
            address
        }
        Err(error) => {
            page.message = error.to_string();
            core::ptr::null_mut()
        }
    }
}

/// Takes the file in the room as a mesh (0), as colours (1) or as normals (2) of this size. Returns 1, or 0 and a
/// message.
#[unsafe(no_mangle)]
pub extern "C" fn load(kind: u32, width: u32, height: u32) -> u32 {
    let page = &mut *PAGE.lock();
    let loaded = match kind {
        0 => page.model().load_mesh(),
        1 => page.model().load_map(model::Kind::Colors, [width, height]),
        2 => page.model().load_map(model::Kind::Normals, [width, height]),
        _ => page.model().forget(),
    };
    page.message = loaded.err().map(|error| error.to_string()).unwrap_or_default();
    u32::from(page.message.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One test, since there is one page.
    #[test]
    fn faults_have_a_message_and_pictures_have_none() {
        assert!(pixels(8, 64, 48).is_null());
        assert_eq!(PAGE.lock().message, "there is no station 8");
        assert!(pixels(0, 641, 480).is_null());
        assert!(message_length() > 0 && !message().is_null());
        CONTROLS.lock()[0] = 4.0;
        assert!(!pixels(0, 64, 48).is_null() && !parameters().is_null());
        assert_eq!(message_length(), 0);
        assert!(rows(0, 64, 48, 48, 50).is_null() && message_length() > 0);
        assert!(!rows(3, 64, 48, 40, 50).is_null());
        assert!(!pixels(0, 64, 48).is_null());
        assert!(result_count() > 8 && !results().is_null());
        assert!(reserve(model::MAX_BYTES + 1).is_null());
        assert!(!reserve(8).is_null());
        assert_eq!((load(1, 3, 1), load(1, 2, 1), load(0, 0, 0), load(3, 0, 0)), (0, 0, 0, 1));
    }
}
