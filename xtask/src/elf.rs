//! The part of the Executable and Linkable Format that weighs a program and names its functions: 32 or 64 bits,
//! little-endian.
//!
//! The numbers are those of the System V ABI, chapters "Object Files" and "Symbol Table".

use crate::wasm;

/// Answers about a linked program.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Program {
    /// Bytes of code.
    pub(crate) text: u64,
    /// Bytes of constants.
    pub(crate) rodata: u64,
    /// Bytes of variables, and those among them that begin with another value than zero.
    pub(crate) statics: u64,
    pub(crate) data: u64,
    /// The names of all symbols, mangled, and what they stand for, in the order of the file.
    pub(crate) symbols: Vec<(String, u64)>,
}

/// Offsets of fields and sizes of entries, which depend on the width of addresses alone.
struct Layout {
    /// Bytes of an address, an offset or a size.
    address: u64,
    /// The field with the place of the sections' headers in the file's header.
    sections: u64,
    /// The field with the size of one such header; their number and the number of the one with the names follow it.
    counts: u64,
    /// The fields flags, offset, size and link in a section's header.
    fields: [u64; 4],
    /// Bytes of a symbol, and the field with its value.
    symbol: u64,
    value: u64,
}

const NARROW: Layout =
    Layout { address: 4, sections: 32, counts: 46, fields: [8, 16, 20, 24], symbol: 16, value: 4 };
const WIDE: Layout =
    Layout { address: 8, sections: 40, counts: 58, fields: [8, 24, 32, 40], symbol: 24, value: 8 };

/// One header of a section.
struct Section<'a> {
    name: &'a str,
    kind: u64,
    flags: u64,
    offset: u64,
    size: u64,
    link: u64,
}

const PROGRAM_BITS: u64 = 1;
const SYMBOLS: u64 = 2;
/// The kind of a section that is zero, and not in the file.
const NO_BITS: u64 = 8;
/// The flag of a section that takes room in the program's memory.
const ALLOCATED: u64 = 2;

impl Program {
    /// Reads a linked program, of WebAssembly too. Its symbols must not be stripped.
    pub(crate) fn read(file: &[u8]) -> Result<Program, String> {
        if file.starts_with(wasm::MAGIC) {
            return wasm::read(file);
        }
        let layout = match file.get(..6) {
            Some(b"\x7fELF\x01\x01") => &NARROW,
            Some(b"\x7fELF\x02\x01") => &WIDE,
            _ => return Err("this is not a little-endian ELF file".into()),
        };
        let sections = sections(file, layout).ok_or("this ELF file is not whole")?;
        let size = |kind: u64, prefix: &str| {
            let loaded = sections.iter().filter(|s| s.kind == kind && s.flags & ALLOCATED != 0);
            loaded.filter(|s| s.name.starts_with(prefix)).map(|s| s.size).sum::<u64>()
        };
        let table = sections.iter().find(|s| s.kind == SYMBOLS).ok_or("the symbols are stripped")?;
        let symbols = symbols(file, layout, &sections, table).ok_or("a symbol lies outside of the file")?;
        let [text, rodata, data] = [".text", ".rodata", ".data"].map(|prefix| size(PROGRAM_BITS, prefix));
        Ok(Program { text, rodata, statics: data + size(NO_BITS, ".bss"), data, symbols })
    }

    /// The functions by which the program can panic: those of `core` by their last name, sorted.
    pub(crate) fn panics(&self) -> Vec<String> {
        let names = self.names().filter(|symbol| symbol.contains("panic")).map(path);
        let mut panics: Vec<String> =
            names.map(|name| name.strip_prefix("core::panicking::").unwrap_or(&name).to_string()).collect();
        panics.sort();
        panics.dedup();
        panics
    }

    /// The functions by which compilers compute in `f64` in software: those of Arm's ABI, which the symbols `__aeabi_`
    /// name with the number's kind, and those of others, whose names have it as `df`.
    pub(crate) fn doubles(&self) -> Vec<&str> {
        let double = |symbol: &&str| match (symbol.strip_prefix("__aeabi_"), symbol.strip_prefix("__")) {
            (Some(name), _) => name.starts_with("cd") || name.starts_with('d') || name.ends_with("2d"),
            (None, Some(name)) => name.contains("df"),
            (None, None) => false,
        };
        self.names().filter(double).collect()
    }

    /// The number of compiled instances of a generic function, closures in it aside.
    ///
    /// An instance that was inlined into every caller has no symbol, so the number is honest only for functions that
    /// cannot be, such as recursive ones.
    pub(crate) fn instances(&self, function: &str) -> usize {
        self.names().map(path).filter(|path| path == function).count()
    }

    /// Where a function begins, by its mangled name. The lowest bit, which says Thumb on Arm, is clear.
    pub(crate) fn address(&self, function: &str) -> Option<u64> {
        self.symbols.iter().find(|(name, _)| name == function).map(|(_, value)| value & !1)
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.symbols.iter().map(|(name, _)| name.as_str())
    }
}

/// The bytes in memory of a linked program's sections, those whose names begin with each prefix.
pub(crate) fn sizes<const N: usize>(file: &[u8], prefixes: [&str; N]) -> Result<[u64; N], String> {
    let layout = match file.get(..6) {
        Some(b"\x7fELF\x01\x01") => &NARROW,
        _ => return Err("this is not a little-endian ELF file of 32 bits".into()),
    };
    let sections = sections(file, layout).ok_or("this ELF file is not whole")?;
    let size = |prefix: &str| {
        let loaded = sections.iter().filter(|s| s.flags & ALLOCATED != 0 && s.name.starts_with(prefix));
        loaded.map(|s| s.size).sum()
    };
    Ok(prefixes.map(size))
}

/// The path of a function, without parameters and arguments in either of Rust's manglings; other names as they are.
fn path(symbol: &str) -> String {
    let name = format!("{:#}", rustc_demangle::demangle(symbol));
    // The path of a method of a trait begins with its type in brackets, which stays.
    if name.starts_with('<') {
        return name;
    }
    let mut depth = 0;
    let outside = |c: &char| {
        depth += i32::from(*c == '<');
        let outside = depth == 0;
        depth -= i32::from(*c == '>');
        outside
    };
    name.chars().filter(outside).collect::<String>().trim_end_matches("::").replace("::::", "::")
}

fn sections<'a>(file: &'a [u8], layout: &Layout) -> Option<Vec<Section<'a>>> {
    let table = number(file, layout.sections, layout.address)?;
    let [size, count, names] = [0, 2, 4].map(|offset| number(file, layout.counts + offset, 2));
    let (size, names) = (size?, names?);
    let header = |index: u64| table.checked_add(index.checked_mul(size)?);
    let [flags, offset, length, link] = layout.fields;
    let names = number(file, header(names)?.checked_add(offset)?, layout.address)?;
    (0..count?)
        .map(|index| {
            let at = header(index)?;
            let field = |offset: u64, width: u64| number(file, at.checked_add(offset)?, width);
            Some(Section {
                name: string(file, names.checked_add(field(0, 4)?)?)?,
                kind: field(4, 4)?,
                flags: field(flags, layout.address)?,
                offset: field(offset, layout.address)?,
                size: field(length, layout.address)?,
                link: field(link, 4)?,
            })
        })
        .collect()
}

/// All symbols; their names are in the section of strings to which that of the symbols links.
fn symbols(
    file: &[u8],
    layout: &Layout,
    sections: &[Section<'_>],
    table: &Section<'_>,
) -> Option<Vec<(String, u64)>> {
    let strings = sections.get(usize::try_from(table.link).ok()?)?.offset;
    (0..table.size / layout.symbol)
        .map(|index| {
            let entry = table.offset.checked_add(layout.symbol * index)?;
            let name = string(file, strings.checked_add(number(file, entry, 4)?)?)?;
            Some((name.to_string(), number(file, entry.checked_add(layout.value)?, layout.address)?))
        })
        .collect()
}

/// The unsigned number of `width` bytes, up to eight, at a place.
fn number(file: &[u8], at: u64, width: u64) -> Option<u64> {
    let at = usize::try_from(at).ok()?;
    let bytes = file.get(at..at.checked_add(usize::try_from(width).ok()?)?)?;
    Some(bytes.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte)))
}

/// The text from here to the next zero byte.
fn string(file: &[u8], at: u64) -> Option<&str> {
    let rest = file.get(usize::try_from(at).ok()?..)?;
    std::str::from_utf8(&rest[..rest.iter().position(|&byte| byte == 0)?]).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRINGS: &[u8] = b"\0.text\0.rodata.x\0.symtab\0.debug\0\
        _RNvNtCs4GWT_4core9panicking18panic_bounds_check\0.data\0.bss\0";

    /// A file with a header, seven sections' headers behind it, two symbols (one nameless), and the strings.
    fn file(layout: &Layout) -> Vec<u8> {
        let header = layout.counts + 6;
        let size = layout.fields[3] + 16;
        let symbols = header + 7 * size;
        let names = symbols + 2 * layout.symbol;
        let mut file = vec![0; usize::try_from(names).unwrap()];
        file[..6].copy_from_slice(if layout.address == 4 { b"\x7fELF\x01\x01" } else { b"\x7fELF\x02\x01" });
        file.extend(STRINGS);
        let mut put = |at: u64, width: u64, value: u64| {
            let (at, width) = (usize::try_from(at).unwrap(), usize::try_from(width).unwrap());
            file[at..at + width].copy_from_slice(&value.to_le_bytes()[..width]);
        };
        put(layout.sections, layout.address, header);
        for (place, value) in [(0, size), (2, 7), (4, 4)] {
            put(layout.counts + place, 2, value);
        }
        put(symbols + layout.symbol, 4, 32);
        put(symbols + layout.symbol + layout.value, layout.address, 0x1235);
        // Name, kind, flags, offset, size, link.
        let rows = [
            [1, PROGRAM_BITS, ALLOCATED | 4, 0, 100, 0],
            [7, PROGRAM_BITS, ALLOCATED, 0, 30, 0],
            [25, PROGRAM_BITS, 0, 0, 7000, 0],
            [17, SYMBOLS, 0, symbols, 2 * layout.symbol, 4],
            [0, 3, 0, names, 64, 0],
            [81, PROGRAM_BITS, ALLOCATED | 1, 0, 5, 0],
            [87, NO_BITS, ALLOCATED | 1, 0, 900, 0],
        ];
        for (index, [name, kind, flags, offset, length, link]) in (0..).zip(rows) {
            let at = header + index * size;
            put(at, 4, name);
            put(at + 4, 4, kind);
            let fields = [flags, offset, length, link].into_iter().zip(layout.fields);
            fields.for_each(|(value, field)| put(at + field, 4, value));
        }
        file
    }

    #[test]
    fn programs_of_both_widths_are_weighed() {
        for layout in [&NARROW, &WIDE] {
            let program = Program::read(&file(layout)).unwrap();
            assert_eq!((program.text, program.rodata), (100, 30));
            assert_eq!((program.statics, program.data), (905, 5));
            assert_eq!(program.panics(), ["panic_bounds_check"]);
            assert_eq!(program.address(&program.symbols[1].0), Some(0x1234));
            assert_eq!(program.address("main"), None);
        }
        assert_eq!(sizes(&file(&NARROW), [".text", ".rodata", ".data"]), Ok([100, 30, 5]));
        assert!(sizes(&file(&WIDE), [".text"]).is_err());
    }

    #[test]
    fn functions_of_f64_are_told() {
        let symbols =
            ["__aeabi_dmul", "__aeabi_f2d", "__aeabi_cdcmple", "__muldf3", "__aeabi_fmul", "__divsi3"];
        let others = ["__aeabi_l2f", "__aeabi_idiv", "_RNvCs_5scenes4df32", "memcpy"];
        let symbols = symbols.into_iter().chain(others).map(|name| (name.to_string(), 0)).collect();
        let program = Program { text: 0, rodata: 0, statics: 0, data: 0, symbols };
        assert_eq!(program.doubles(), ["__aeabi_dmul", "__aeabi_f2d", "__aeabi_cdcmple", "__muldf3"]);
    }

    #[test]
    fn a_file_cut_off_is_refused() {
        for whole in [file(&NARROW), file(&WIDE)] {
            for length in 0..whole.len() {
                assert!(Program::read(&whole[..length]).is_err(), "{length}");
            }
        }
    }

    #[test]
    fn other_files_are_refused() {
        let mut big_endian = file(&NARROW);
        big_endian[5] = 2;
        assert!(Program::read(&big_endian).unwrap_err().contains("little-endian"));
        assert!(Program::read(b"#!/bin/sh").is_err());
    }

    #[test]
    fn instances_are_counted_in_both_manglings() {
        let symbols = [
            "_ZN7alberti8pipeline9draw_from17h083f00431fb763deE",
            "_ZN7alberti8pipeline9draw_from17h0a2538f26c1ebbf1E",
            "_ZN7alberti8pipeline9draw_from28_$u7b$$u7b$closure$u7d$$u7d$17h0a2538f26c1ebbf2E",
            "_RINvNtCs123_7alberti8pipeline9draw_fromhmE",
            "_RNvNtCs123_7alberti8pipeline4clip",
            "_ZN14alberti_raster4draw18Paint$LT$F$C$P$GT$10draw_batch17h083f00431fb763deE",
            "main",
        ];
        let program = Program {
            text: 0,
            rodata: 0,
            statics: 0,
            data: 0,
            symbols: symbols.map(|name| (name.to_string(), 0)).to_vec(),
        };
        assert_eq!(program.instances("alberti::pipeline::draw_from"), 3);
        assert_eq!(program.instances("alberti_raster::draw::Paint::draw_batch"), 1);
        assert_eq!(program.instances("main"), 1);
    }
}
