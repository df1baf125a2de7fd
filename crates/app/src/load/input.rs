//! Files as bytes: of a size that fits in memory, and no devices. Text may be compressed, and what the user names may
//! come from a pipe or from standard input.

use std::cell::Cell;
use std::fs::{self, File};
use std::io::{self, BufRead as _, BufReader, IsTerminal as _, Read};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use flate2::bufread::MultiGzDecoder;

use crate::cli::words::nearest;
use crate::error::{Error, MEANT};
use crate::load::seen;
use crate::memory;

/// The largest OBJ file that is read, in bytes, decompressed. Its model has to fit in memory: about as many bytes, or
/// six times as many where numbers are as short as can be.
pub const MAX_TEXT_BYTES: u64 = 1 << 31;

/// The name that stands for standard input.
pub const STDIN: &str = "-";

/// The first bytes of a gzip file.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// The contents of a regular file of at most `limit` bytes. `kind` names what was expected, with its article.
///
/// # Errors
/// The file is missing, cannot be read, is a directory or a device, or is too long.
pub fn read(path: &Path, kind: &'static str, limit: u64) -> Result<Vec<u8>, Error> {
    read_all(open(path, kind)?, path, kind, limit)
}

/// The same of a file that the user names, which may be a pipe, or [`STDIN`].
///
/// # Errors
/// Those of [`read`].
pub(crate) fn read_given(path: &Path, kind: &'static str, limit: u64) -> Result<Vec<u8>, Error> {
    read_all(open_given(path, kind)?, shown(path), kind, limit)
}

fn read_all(
    (file, length): (impl Read, u64),
    path: &Path,
    kind: &'static str,
    limit: u64,
) -> Result<Vec<u8>, Error> {
    if length > limit {
        return Err(too_long(path, kind, length, limit, ""));
    }
    memory::need(length, kind).map_err(|error| error.file(path))?;
    let mut bytes = Vec::new();
    // The file may grow between the two looks at it.
    let read = file.take(limit + 1).read_to_end(&mut bytes).map_err(|e| unreadable(path, kind, &e))?;
    if read as u64 > limit {
        return Err(too_long(path, kind, read as u64, limit, ""));
    }
    Ok(bytes)
}

/// The contents of a file of text, which may be compressed by gzip. `limit` is that of [`Stream::open`].
///
/// # Errors
/// Those of a [`Stream`].
pub(crate) fn read_text(path: &Path, kind: &'static str, limit: u64) -> Result<Vec<u8>, Error> {
    let mut stream = Stream::open(path, kind, limit)?;
    let mut bytes = Vec::new();
    while !stream.fill(&mut bytes, usize::MAX)? {}
    Ok(bytes)
}

/// Whether a file can be opened.
///
/// # Errors
/// It is missing, cannot be read, or is a directory or a device.
pub(crate) fn check(path: &Path, kind: &str) -> Result<(), Error> {
    open(path, kind).map(|_| ())
}

/// The name of a file of text in messages.
pub(crate) fn shown(path: &Path) -> &Path {
    if path == Path::new(STDIN) { Path::new("standard input") } else { path }
}

/// The folder in which files are that a file names: of what has no folder of its own, the current one.
pub(crate) fn folder(path: &Path) -> &Path {
    let is_command = ["/dev/fd", "/proc/self/fd"].iter().any(|of_pipes| path.starts_with(of_pipes));
    path.parent().filter(|_| !is_command).unwrap_or(Path::new(""))
}

/// A text that is read piece by piece: a regular file, or standard input. One that begins as gzip files do is
/// decompressed, whatever its name.
pub(crate) struct Stream {
    reader: Box<dyn Read>,
    /// Bytes read of the file as it is, and how many it has, 0 if that is not known.
    done: Rc<Cell<u64>>,
    total: u64,
    /// Bytes given, and how many may be.
    given: u64,
    limit: u64,
    compressed: bool,
    path: PathBuf,
    kind: &'static str,
}

impl Stream {
    /// Opens a text of at most `limit` bytes, decompressed.
    ///
    /// # Errors
    /// Those of [`read`].
    pub(crate) fn open(path: &Path, kind: &'static str, limit: u64) -> Result<Self, Error> {
        let (file, total) = open_given(path, kind)?;
        let path = shown(path);
        let done = Rc::new(Cell::new(0));
        let mut file = BufReader::with_capacity(1 << 18, Counted { inner: file, done: done.clone() });
        // A pipe may give its first byte alone.
        let first = file.fill_buf().map_err(|error| unreadable(path, kind, &error))?;
        let compressed = first.starts_with(&GZIP) || (first.len() == 1 && first[0] == GZIP[0]);
        if !compressed && total > limit {
            return Err(too_long(path, kind, total, limit, ""));
        }
        let reader: Box<dyn Read> =
            if compressed { Box::new(MultiGzDecoder::new(file)) } else { Box::new(file) };
        Ok(Self { reader, done, total, given: 0, limit, compressed, path: path.to_owned(), kind })
    }

    /// Reads until there are `wanted` bytes in the buffer, or some part of that. Whether the text has ended.
    ///
    /// # Errors
    /// It cannot be read, is damaged, or is longer than allowed.
    pub(crate) fn fill(&mut self, bytes: &mut Vec<u8>, wanted: usize) -> Result<bool, Error> {
        let room = (wanted.saturating_sub(bytes.len()) as u64).min(self.limit + 1 - self.given);
        let before = bytes.len();
        let read = self.reader.by_ref().take(room).read_to_end(bytes);
        self.given += (bytes.len() - before) as u64;
        if let Err(error) = read {
            if self.compressed {
                let found = format!("a gzip file that cannot be decompressed ({error})");
                return Err(Error::new(found, self.kind).file(&self.path).hint("compress it again"));
            }
            return Err(unreadable(&self.path, self.kind, &error));
        }
        if self.given > self.limit {
            let how = if self.compressed { ", decompressed" } else { "" };
            return Err(too_long(&self.path, self.kind, self.given, self.limit, how));
        }
        Ok(((bytes.len() - before) as u64) < room)
    }

    /// Bytes read of the file as it is, and how many it has, or as many where that is not known.
    pub(crate) fn progress(&self) -> (u64, u64) {
        (self.done.get(), self.total.max(self.done.get()))
    }
}

/// A reader that counts the bytes that it has given.
struct Counted<R> {
    inner: R,
    done: Rc<Cell<u64>>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let bytes = self.inner.read(buffer)?;
        self.done.set(self.done.get() + bytes as u64);
        Ok(bytes)
    }
}

/// A file that the user names, and its length, 0 where that is not known: a regular one, a pipe, or standard input.
fn open_given(path: &Path, kind: &str) -> Result<(Box<dyn Read>, u64), Error> {
    if path == Path::new(STDIN) {
        if io::stdin().is_terminal() {
            let error = Error::new("a terminal as standard input", kind).file(shown(path));
            return Err(error.hint("name a file, or pipe one in"));
        }
        return Ok((Box::new(io::stdin()), 0));
    }
    if is_pipe(path) {
        return Ok((Box::new(File::open(path).map_err(|error| unreadable(path, kind, &error))?), 0));
    }
    let (file, length) = open(path, kind)?;
    Ok((Box::new(file), length))
}

/// Whether a file is a pipe with a name, such as a shell makes of a command.
#[cfg(unix)]
fn is_pipe(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    fs::metadata(path).is_ok_and(|metadata| metadata.file_type().is_fifo())
}

#[cfg(not(unix))]
fn is_pipe(_: &Path) -> bool {
    false
}

/// A regular file and its length.
fn open(path: &Path, kind: &str) -> Result<(File, u64), Error> {
    seen::see(path);
    let unreadable = |error: &io::Error| unreadable(path, kind, error);
    let metadata = fs::metadata(path).map_err(|e| unreadable(&e))?;
    if metadata.is_dir() {
        return Err(Error::new("a directory", kind).file(path).hint("name a file in it"));
    }
    // A device never ends, and a pipe without a writer never begins.
    if !metadata.is_file() {
        return Err(Error::new("a device or a pipe", kind).file(path).hint("save it to a file first"));
    }
    Ok((File::open(path).map_err(|e| unreadable(&e))?, metadata.len()))
}

fn too_long(path: &Path, kind: &str, length: u64, limit: u64, how: &str) -> Error {
    Error::new(format!("{length} bytes or more{how}"), format!("{kind} of at most {limit} bytes"))
        .file(path)
        .hint("reduce it")
}

/// The file in the same folder, and with the same extension, that is named most like a missing one, if one is at all.
fn similar(path: &Path) -> Option<String> {
    /// Names that are looked at.
    const MOST: usize = 4096;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let extension = path.extension()?;
    let alike = |file: &PathBuf| file.extension().is_some_and(|other| other.eq_ignore_ascii_case(extension));
    let files = fs::read_dir(folder).ok()?.take(MOST).filter_map(|file| Some(file.ok()?.path()));
    let stems: Vec<(String, PathBuf)> = files
        .filter(|file| alike(file) && file.is_file())
        .filter_map(|file| Some((file.file_stem()?.to_str()?.to_owned(), file)))
        .collect();
    let stem = nearest(path.file_stem()?.to_str()?, stems.iter().map(|(stem, _)| stem.as_str()))?;
    let (_, file) = stems.iter().find(|(other, _)| other == stem)?;
    Some(path.with_file_name(file.file_name()?).display().to_string())
}

/// An error of the system while reading, as a message.
pub(crate) fn unreadable(path: &Path, kind: &str, error: &io::Error) -> Error {
    match error.kind() {
        io::ErrorKind::NotFound => {
            let hint = similar(path).map_or("check its path".to_owned(), |name| format!("{MEANT}{name}?"));
            Error::new("no such file", kind).file(path).hint(hint)
        }
        io::ErrorKind::PermissionDenied => {
            Error::new("a file that may not be read", kind).file(path).hint("check its permissions")
        }
        _ => Error::new(format!("a file that cannot be read ({error})"), kind).file(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write as _;

    const KIND: &str = "a text";

    fn gzip(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    fn text_of(bytes: &[u8], limit: u64) -> Result<Vec<u8>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t");
        fs::write(&path, bytes).unwrap();
        let prefix = format!("{}/", folder.path().display());
        read_text(&path, KIND, limit).map_err(|error| error.to_string().replace(&prefix, ""))
    }

    #[test]
    fn compressed_text_is_the_text() {
        let text = b"v 1 2 3\n".repeat(10_000);
        assert_eq!(text_of(&text, 80_000).unwrap(), text);
        assert_eq!(text_of(&gzip(&text), 80_000).unwrap(), text);
        // Members one after the other are one text.
        let twice = [gzip(&text[..8]), gzip(&text[8..])].concat();
        assert_eq!(text_of(&twice, 80_000).unwrap(), text);
        assert_eq!(text_of(&gzip(b""), 10).unwrap(), b"");
        assert_eq!(text_of(b"", 10).unwrap(), b"");
    }

    #[test]
    fn limits_are_of_the_text() {
        let text = b"v 1 2 3\n".repeat(10_000);
        let found = "t: found 80000 bytes or more, expected a text of at most 79999 bytes; reduce it";
        assert_eq!(text_of(&text, 79_999), Err(found.to_owned()));
        let bomb = gzip(&vec![b'\n'; 1 << 24]);
        assert!(bomb.len() < 20_000);
        let found =
            "t: found 100001 bytes or more, decompressed, expected a text of at most 100000 bytes; reduce it";
        assert_eq!(text_of(&bomb, 100_000), Err(found.to_owned()));
    }

    #[test]
    fn damaged_compression_is_an_error() {
        let text = gzip(&b"v 1 2 3\n".repeat(100));
        for bad in [&text[..text.len() - 9], &text[..1], &text[..12]] {
            let message = text_of(bad, 1 << 20).unwrap_err();
            assert!(message.starts_with("t: found a gzip file that cannot be decompressed ("), "{message}");
        }
        let mut flipped = text.clone();
        let middle = flipped.len() / 2;
        flipped[middle] ^= 0x55;
        assert!(text_of(&flipped, 1 << 20).is_err());
    }
}
