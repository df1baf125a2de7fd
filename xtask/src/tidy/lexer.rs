//! Just enough of Rust's lexical grammar to search code without finding comments, strings or test code.
//!
//! Everything here keeps the length of the text and its line breaks, so a position in the result is the same position
//! in the file.

/// `text` with comments and the contents of string and character literals blanked out.
pub(super) fn code_only(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut code = bytes.to_vec();
    let mut at = 0;
    while at < bytes.len() {
        let end = match bytes[at] {
            b'/' if bytes[at..].starts_with(b"//") => find(bytes, at, b"\n"),
            b'/' if bytes[at..].starts_with(b"/*") => end_of_block_comment(bytes, at),
            b'"' => end_of_quoted(bytes, at, b'"'),
            b'\'' => match text[at + 1..].chars().next() {
                Some('\\') => end_of_quoted(bytes, at, b'\''),
                Some(char) if bytes.get(at + 1 + char.len_utf8()) == Some(&b'\'') => at + 2 + char.len_utf8(),
                // A lifetime.
                _ => {
                    at += 1;
                    continue;
                }
            },
            byte if is_word(byte) => {
                let end = end_of_word(bytes, at);
                let raw = matches!(&bytes[at..end], b"r" | b"br" | b"cr");
                let hashes = bytes[end..].iter().take_while(|&&byte| byte == b'#').count();
                at = end;
                if !raw || bytes.get(end + hashes) != Some(&b'"') {
                    continue;
                }
                let terminator = [b"\"".as_slice(), &vec![b'#'; hashes]].concat();
                (find(bytes, end + hashes + 1, &terminator) + terminator.len()).min(bytes.len())
            }
            _ => {
                at += 1;
                continue;
            }
        };
        blank(&mut code[at..end]);
        at = end;
    }
    String::from_utf8(code).expect("whole characters were replaced by spaces")
}

/// `code`, as [`code_only`] returns it, with the items blanked out that are compiled only for tests or with std.
///
/// `text` is the same file with its strings: a feature's name is one.
pub(super) fn without_gated_items(text: &str, code: &str) -> String {
    let mut result = code.as_bytes().to_vec();
    for (start, _) in code.match_indices("#[cfg(").chain(code.match_indices("#![cfg(")) {
        let Some(length) = code[start..].find(']') else { continue };
        let attribute_end = start + length + 1;
        let predicate = &text[start..attribute_end];
        let gated = predicate.contains("test") || predicate.contains("\"std\"");
        if !gated || predicate.contains("not(") {
            continue;
        }
        let end = if predicate.starts_with("#!") { code.len() } else { end_of_item(code, attribute_end) };
        blank(&mut result[start..end]);
    }
    String::from_utf8(result).expect("whole characters were replaced by spaces")
}

/// Where `word` stands in `code` as a whole word.
pub(super) fn words<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    let bytes = code.as_bytes();
    code.match_indices(word).map(|(at, _)| at).filter(move |&at| {
        let before = at.checked_sub(1).map(|before| bytes[before]);
        let after = bytes.get(at + word.len()).copied();
        !before.is_some_and(is_word) && !after.is_some_and(is_word)
    })
}

/// The line of a position, counted from 1.
pub(super) fn line_of(text: &str, at: usize) -> usize {
    text.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count() + 1
}

/// The end of the item, statement or field that begins at `start`: its first semicolon, the end of its first block,
/// or the end of the block that surrounds it.
fn end_of_item(code: &str, start: usize) -> usize {
    let mut braces = 0;
    let mut others = 0;
    for (offset, byte) in code.as_bytes()[start..].iter().enumerate() {
        match byte {
            b'(' | b'[' => others += 1,
            b')' | b']' => others -= 1,
            b'{' => braces += 1,
            b'}' if braces <= 1 => return start + offset + usize::from(braces == 1),
            b'}' => braces -= 1,
            b';' if braces == 0 && others == 0 => return start + offset + 1,
            _ => {}
        }
    }
    code.len()
}

fn end_of_block_comment(bytes: &[u8], start: usize) -> usize {
    let mut depth = 0;
    let mut at = start;
    while at < bytes.len() {
        if bytes[at..].starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if bytes[at..].starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    bytes.len()
}

fn end_of_quoted(bytes: &[u8], start: usize, quote: u8) -> usize {
    let mut at = start + 1;
    while at < bytes.len() && bytes[at] != quote {
        at += if bytes[at] == b'\\' { 2 } else { 1 };
    }
    (at + 1).min(bytes.len())
}

fn end_of_word(bytes: &[u8], start: usize) -> usize {
    start + bytes[start..].iter().take_while(|&&byte| is_word(byte)).count()
}

/// Where `pattern` next stands, or the end.
fn find(bytes: &[u8], start: usize, pattern: &[u8]) -> usize {
    let found = bytes[start..].windows(pattern.len()).position(|window| window == pattern);
    found.map_or(bytes.len(), |offset| start + offset)
}

fn blank(bytes: &mut [u8]) {
    bytes.iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
}

/// Whether the byte can be part of an identifier; bytes of letters outside ASCII count.
fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || !byte.is_ascii()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `code_only`, with runs of blanks shortened.
    fn code(text: &str) -> String {
        let code = code_only(text);
        assert_eq!((code.len(), code.lines().count()), (text.len(), text.lines().count()));
        code.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn comments_and_literals_go() {
        assert_eq!(code("a // b\nc /* d /* e */ f */ g"), "a c g");
        assert_eq!(code(r#"a "b \" c" d 'e' f '\'' g 'ä' h"#), "a d f g h");
        assert_eq!(code("a r\"b\\\" c br##\"d \"# e\"## f"), "a r c br f");
    }

    #[test]
    fn lifetimes_and_raw_names_stay() {
        assert_eq!(code("fn a<'b>(c: &'b str) { r#type }"), "fn a<'b>(c: &'b str) { r#type }");
    }

    fn ungated(text: &str) -> String {
        without_gated_items(text, &code_only(text)).split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn gated_items_go() {
        assert_eq!(ungated("a;\n#[cfg(test)]\n#[path = \"x\"]\nmod t { fn b() {} }\nc;"), "a; c;");
        assert_eq!(ungated("#[cfg(feature = \"std\")] extern crate std;\nc;"), "c;");
        assert_eq!(ungated("#[cfg(test)] fn f(a: [u8; 2]) { b } c;"), "c;");
        assert_eq!(ungated("#![cfg(test)] use std::vec;"), "");
    }

    #[test]
    fn other_items_stay() {
        for text in ["#[cfg(not(test))] a;", "#[cfg(feature = )] a;", "#[cfg(not(feature = \"std\"))] a;"] {
            assert!(ungated(text).contains("a;"), "{text}");
        }
    }

    #[test]
    fn words_are_whole() {
        assert_eq!(words("std no_std std2 std::a", "std").collect::<Vec<_>>(), [0, 16]);
        assert_eq!(line_of("a\nb\nc", 4), 3);
    }
}
