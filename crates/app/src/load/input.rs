//! Files as bytes, and their lines: what the OBJ and the MTL check have in common.

use std::borrow::Cow;
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

/// The reason why these bytes are not lines of text, if they are not: `found` for a message.
pub(crate) fn not_text(bytes: &[u8]) -> Option<String> {
    if bytes.is_empty() {
        return Some("an empty file".to_owned());
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Some("UTF-16 text".to_owned());
    }
    bytes.iter().position(|&b| b == 0).map(|at| format!("a binary file (a zero byte at offset {at})"))
}

/// The logical lines of a text, each with the number of its first physical line.
///
/// Lines end with LF, CR LF or CR. A UTF-8 byte order mark is skipped. A line that ends with `\` goes on in the
/// next, as after a space; a comment does not, since paths in comments end so too. Comments and blank lines are
/// left out. No assumption is made about the encoding.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    /// The lines of `bytes`.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), number: 0 }
    }

    /// Bytes that no line returned so far has touched.
    pub(crate) fn remaining(&self) -> usize {
        self.rest.len()
    }

    /// Physical lines read so far.
    pub(crate) fn count_so_far(&self) -> usize {
        self.number
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let Some(end) = self.rest.iter().position(|&b| b == b'\n' || b == b'\r') else {
            return Some(std::mem::take(&mut self.rest).trim_ascii());
        };
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest.strip_prefix(b"\r\n").unwrap_or(&rest[1..]);
        Some(line.trim_ascii())
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let line = self.physical()?;
            if line.is_empty() || line[0] == b'#' {
                continue;
            }
            let first = self.number;
            let Some(start) = line.strip_suffix(b"\\") else {
                return Some((first, Cow::Borrowed(line)));
            };
            let mut joined = start.to_vec();
            while let Some(next) = self.physical() {
                joined.push(b' ');
                let start = next.strip_suffix(b"\\");
                joined.extend_from_slice(start.unwrap_or(next));
                if start.is_none() {
                    break;
                }
            }
            let joined = joined.trim_ascii();
            if !joined.is_empty() {
                return Some((first, Cow::Owned(joined.to_vec())));
            }
        }
    }
}

/// The words of a line, without a comment at its end.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty()).take_while(|w| w[0] != b'#')
}

/// The first word of a line and what follows it, trimmed: for names, which may hold spaces and `#`.
pub(crate) fn keyword(line: &[u8]) -> (&[u8], &[u8]) {
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    let (word, rest) = line.split_at(end);
    (word, rest.trim_ascii())
}

/// A finite number, as both the check and the reader behind it understand it.
pub(crate) fn number(word: &[u8]) -> Option<f32> {
    let value: f32 = std::str::from_utf8(word).ok()?.parse().ok()?;
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &[u8]) -> Vec<(usize, String)> {
        Lines::new(text).map(|(n, l)| (n, String::from_utf8_lossy(&l).into_owned())).collect()
    }

    fn expect(text: &[u8], wanted: &[(usize, &str)]) {
        let wanted: Vec<_> = wanted.iter().map(|(n, l)| (*n, (*l).to_owned())).collect();
        assert_eq!(lines(text), wanted);
    }

    #[test]
    fn every_line_ending_ends_a_line() {
        expect(b"a\nb\r\nc\rd", &[(1, "a"), (2, "b"), (3, "c"), (4, "d")]);
        expect(b"\xef\xbb\xbfa\n\n\r\n\tb \n", &[(1, "a"), (4, "b")]);
        expect(b"", &[]);
    }

    #[test]
    fn a_backslash_goes_on_in_the_next_line() {
        expect(b"f 1 2 \\\n 3\\\r\n4\nv", &[(1, "f 1 2  3 4"), (4, "v")]);
        expect(b"f 1 \\", &[(1, "f 1")]);
        expect(b"\\\n\\\nx", &[(1, "x")]);
    }

    #[test]
    fn a_comment_does_not_go_on() {
        expect(b"# from C:\\models\\\nv 1 2 3", &[(2, "v 1 2 3")]);
    }

    #[test]
    fn words_end_at_a_comment_and_names_do_not() {
        assert_eq!(words(b"v 1\t2  3 # 4").count(), 4);
        assert_eq!(keyword(b"usemtl\tMat #1"), (&b"usemtl"[..], &b"Mat #1"[..]));
    }

    #[test]
    fn numbers_are_finite() {
        assert_eq!(number(b"-1.5e3"), Some(-1500.0));
        for bad in [&b"nan"[..], b"inf", b"1e400", b"1,5", b"", b"\xff", b"0x10"] {
            assert_eq!(number(bad), None);
        }
    }
}
