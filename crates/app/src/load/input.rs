//! Files as bytes: of a size that fits in memory, and no devices.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::error::Error;

/// The largest OBJ or MTL file that is read, in bytes. It and what is made of it have to fit in memory.
pub const MAX_TEXT_BYTES: u64 = 1 << 30;

/// The contents of a regular file of at most `limit` bytes. `kind` names what was expected, with its article.
///
/// # Errors
/// The file is missing, cannot be read, is a directory or a device, or is too long.
pub fn read(path: &Path, kind: &str, limit: u64) -> Result<Vec<u8>, Error> {
    let unreadable = |error: &io::Error| unreadable(path, kind, error);
    let metadata = fs::metadata(path).map_err(|e| unreadable(&e))?;
    if metadata.is_dir() {
        return Err(Error::new("a directory", kind).file(path).hint("name a file in it"));
    }
    // A device never ends, and a pipe without a writer never begins.
    if !metadata.is_file() {
        return Err(Error::new("a device or a pipe", kind).file(path).hint("save it to a file first"));
    }
    let too_long = |length: u64| {
        Error::new(format!("{length} bytes or more"), format!("{kind} of at most {limit} bytes"))
            .file(path)
            .hint("reduce it")
    };
    if metadata.len() > limit {
        return Err(too_long(metadata.len()));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|e| unreadable(&e))?;
    // The file may grow between the two looks at it.
    let read = file.take(limit + 1).read_to_end(&mut bytes).map_err(|e| unreadable(&e))?;
    if read as u64 > limit {
        return Err(too_long(read as u64));
    }
    Ok(bytes)
}

/// An error of the system while reading, as a message.
pub(crate) fn unreadable(path: &Path, kind: &str, error: &io::Error) -> Error {
    match error.kind() {
        io::ErrorKind::NotFound => {
            Error::new("no such file", kind).file(path).hint("check the path and the current directory")
        }
        io::ErrorKind::PermissionDenied => {
            Error::new("a file that may not be read", kind).file(path).hint("check its permissions")
        }
        _ => Error::new(format!("a file that cannot be read ({error})"), kind).file(path),
    }
}
