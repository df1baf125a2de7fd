//! The lines of OBJ and MTL files, read once: what their two checks have in common.

use std::borrow::Cow;

/// The reason why these bytes, which come after so many of the file, are not lines of text, if they are not: `found`
/// for a message.
pub(crate) fn not_text(bytes: &[u8], before: u64) -> Option<String> {
    if before == 0 && bytes.is_empty() {
        return Some("an empty file".to_owned());
    }
    if before == 0 && (bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff])) {
        return Some("UTF-16 text".to_owned());
    }
    let zero = bytes.iter().position(|&b| b == 0)?;
    Some(format!("a binary file (a zero byte at offset {})", before + zero as u64))
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

/// A line: its first word, and what follows it. Checks of OBJ and MTL files match the first and take the rest as names
/// or numbers, once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Statement<'a> {
    /// From 1.
    pub(crate) line: usize,
    pub(crate) word: &'a [u8],
    /// Trimmed.
    pub(crate) rest: &'a [u8],
}

impl<'a> Statement<'a> {
    /// Splits a line.
    pub(crate) fn new(line: usize, text: &'a [u8]) -> Self {
        let (word, rest) = keyword(text);
        Self { line, word, rest }
    }

    /// The first word as text.
    pub(crate) fn keyword(&self) -> Cow<'a, str> {
        String::from_utf8_lossy(self.word)
    }

    /// The rest as a name, which may hold spaces and `#`.
    pub(crate) fn name(&self) -> String {
        String::from_utf8_lossy(self.rest).trim().to_owned()
    }

    /// The words of the rest, without a comment at its end.
    pub(crate) fn words(&self) -> impl Iterator<Item = &'a [u8]> {
        self.rest.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty()).take_while(|w| w[0] != b'#')
    }

    /// The words of the rest as numbers, 0 for those that are missing, and how many there are, perhaps more than `N`.
    ///
    /// # Errors
    /// The first word that is no finite number.
    pub(crate) fn numbers<const N: usize>(&self) -> Result<([f32; N], usize), &'a [u8]> {
        let mut numbers = [0.0; N];
        let mut n = 0;
        for word in self.words() {
            let x = number(word).ok_or(word)?;
            if let Some(slot) = numbers.get_mut(n) {
                *slot = x;
            }
            n += 1;
        }
        Ok((numbers, n))
    }
}

/// The first word of a text and what follows it, trimmed.
pub(crate) fn keyword(text: &[u8]) -> (&[u8], &[u8]) {
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    let (word, rest) = text.split_at(end);
    (word, rest.trim_ascii())
}

/// A finite number.
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
        let numbers = Statement::new(1, b"v 1\t2  3 # 4");
        assert_eq!((numbers.words().count(), numbers.numbers()), (3, Ok(([1.0, 2.0, 3.0, 0.0], 3))));
        let name = Statement::new(1, b"usemtl\tMat #1");
        assert_eq!((name.word, name.name()), (&b"usemtl"[..], "Mat #1".to_owned()));
    }

    #[test]
    fn numbers_are_finite() {
        assert_eq!(number(b"-1.5e3"), Some(-1500.0));
        for bad in [&b"nan"[..], b"inf", b"1e400", b"1,5", b"", b"\xff", b"0x10"] {
            assert_eq!(number(bad), None);
        }
    }
}
