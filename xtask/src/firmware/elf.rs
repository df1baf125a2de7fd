//! Just enough of the Executable and Linkable Format to weigh a program: 32 bits, little-endian.
//!
//! The numbers are those of the System V ABI, chapters "Object Files" and "Symbol Table".

/// What is asked of a program.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Program {
    /// Bytes of code.
    pub(super) text: u32,
    /// Bytes of constants.
    pub(super) rodata: u32,
    /// The functions by which the program can panic: those of `core` by their last name, sorted.
    pub(super) panics: Vec<String>,
}

/// One header of a section.
struct Section<'a> {
    name: &'a str,
    kind: u32,
    flags: u32,
    offset: u32,
    size: u32,
    link: u32,
}

const PROGRAM_BITS: u32 = 1;
const SYMBOLS: u32 = 2;
/// The flag of what takes room in the program's memory.
const ALLOCATED: u32 = 2;

impl Program {
    /// Reads a linked program. Its symbols must not be stripped.
    pub(super) fn read(file: &[u8]) -> Result<Program, String> {
        let sections = sections(file).ok_or("this is not a whole 32-bit little-endian ELF file")?;
        let size = |prefix: &str| {
            let loaded = sections.iter().filter(|s| s.kind == PROGRAM_BITS && s.flags & ALLOCATED != 0);
            loaded.filter(|s| s.name.starts_with(prefix)).map(|s| s.size).sum()
        };
        let symbols = sections.iter().find(|s| s.kind == SYMBOLS).ok_or("the symbols are stripped")?;
        let names = symbol_names(file, &sections, symbols).ok_or("a symbol lies outside of the file")?;
        let mut panics: Vec<String> =
            names.iter().filter(|name| name.contains("panic")).map(|name| last_name(name)).collect();
        panics.sort();
        panics.dedup();
        Ok(Program { text: size(".text"), rodata: size(".rodata"), panics })
    }
}

fn sections(file: &[u8]) -> Option<Vec<Section<'_>>> {
    // Magic, 32 bits, little-endian.
    if file.get(..6)? != b"\x7fELF\x01\x01" {
        return None;
    }
    let (table, size) = (word(file, 32)?, half(file, 46)?);
    let (count, names) = (half(file, 48)?, half(file, 50)?);
    let header = |index: u32| table.checked_add(index.checked_mul(size)?);
    let names = word(file, header(names)?.checked_add(16)?)?;
    (0..count)
        .map(|index| {
            let at = header(index)?;
            let field = |k: u32| word(file, at.checked_add(4 * k)?);
            let name = string(file, names.checked_add(field(0)?)?)?;
            Some(Section {
                name,
                kind: field(1)?,
                flags: field(2)?,
                offset: field(4)?,
                size: field(5)?,
                link: field(6)?,
            })
        })
        .collect()
}

/// The names of all symbols; they are in the section of strings to which that of the symbols links.
fn symbol_names<'a>(file: &'a [u8], sections: &[Section<'a>], symbols: &Section<'a>) -> Option<Vec<&'a str>> {
    let strings = sections.get(usize::try_from(symbols.link).ok()?)?.offset;
    (0..symbols.size / 16)
        .map(|index| {
            let entry = symbols.offset.checked_add(16 * index)?;
            string(file, strings.checked_add(word(file, entry)?)?)
        })
        .collect()
}

/// `panic_fmt` of a mangled `core::panicking::panic_fmt`; other names as they are.
fn last_name(symbol: &str) -> String {
    match symbol.rsplit_once("panicking") {
        // Mangled names have their lengths before them.
        Some((_, name)) => name.trim_start_matches(|c: char| c.is_ascii_digit()).to_string(),
        None => symbol.to_string(),
    }
}

fn word(file: &[u8], at: u32) -> Option<u32> {
    let at = usize::try_from(at).ok()?;
    Some(u32::from_le_bytes(file.get(at..at.checked_add(4)?)?.try_into().ok()?))
}

fn half(file: &[u8], at: u32) -> Option<u32> {
    let at = usize::try_from(at).ok()?;
    Some(u32::from(u16::from_le_bytes(file.get(at..at.checked_add(2)?)?.try_into().ok()?)))
}

/// The text from here to the next zero byte.
fn string(file: &[u8], at: u32) -> Option<&str> {
    let rest = file.get(usize::try_from(at).ok()?..)?;
    std::str::from_utf8(rest.split(|&byte| byte == 0).next()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file with a header, five sections' headers from byte 52 on, one symbol, and the strings.
    fn file() -> Vec<u8> {
        let strings = b"\0.text\0.rodata.x\0.symtab\0.debug\0_R9panicking18panic_bounds_check\0";
        let (headers, symbols) = (52_u32, 52 + 5 * 40);
        let names = symbols + 32;
        let mut file = b"\x7fELF\x01\x01".to_vec();
        file.resize(32, 0);
        file.extend(headers.to_le_bytes());
        file.extend([0; 10]);
        for field in [40_u16, 5, 4] {
            file.extend(field.to_le_bytes());
        }
        // Name, kind, flags, address, offset, size, link; then what nobody reads.
        let rows: [[u32; 7]; 5] = [
            [1, PROGRAM_BITS, ALLOCATED | 4, 0, 0, 100, 0],
            [7, PROGRAM_BITS, ALLOCATED, 0, 0, 30, 0],
            [25, PROGRAM_BITS, 0, 0, 0, 7000, 0],
            [17, SYMBOLS, 0, 0, symbols, 32, 4],
            [0, 3, 0, 0, names, 64, 0],
        ];
        for row in rows {
            row.iter().for_each(|field| file.extend(field.to_le_bytes()));
            file.extend([0; 12]);
        }
        file.extend([0; 16]);
        file.extend(32_u32.to_le_bytes());
        file.extend([0; 12]);
        file.extend(strings);
        file
    }

    #[test]
    fn a_program_is_weighed() {
        let program = Program { text: 100, rodata: 30, panics: vec!["panic_bounds_check".into()] };
        assert_eq!(Program::read(&file()), Ok(program));
    }

    #[test]
    fn what_is_cut_off_is_refused() {
        let whole = file();
        for length in 0..whole.len() - 40 {
            assert!(Program::read(&whole[..length]).is_err(), "{length}");
        }
    }

    #[test]
    fn other_files_are_refused() {
        let mut wide = file();
        wide[4] = 2;
        assert!(Program::read(&wide).unwrap_err().contains("32-bit"));
        assert!(Program::read(b"#!/bin/sh").is_err());
    }

    #[test]
    fn names_of_panics() {
        assert_eq!(last_name("_RNvNtCs4GWT_4core9panicking9panic_fmt"), "panic_fmt");
        assert_eq!(last_name("my_panic"), "my_panic");
    }
}
