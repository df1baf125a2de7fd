//! The part of the WebAssembly binary format that weighs a module and names its functions.
//!
//! The numbers are those of the WebAssembly Core Specification 2.0, chapter 5 and appendix 7.4.1.

use crate::elf::Program;

/// The first bytes of every module, the version among them.
pub(crate) const MAGIC: &[u8] = b"\0asm\x01\0\0\0";

const CUSTOM: u8 = 0;
const CODE: u8 = 10;
const DATA: u8 = 11;
/// The part of the custom section `name` that has the functions.
const FUNCTIONS: u8 = 1;

/// Reads a module: the bytes of its code, of its data as constants, and the functions. What it needs of memory is not
/// told, since a page is 64 KB and the stack is one of the data.
pub(crate) fn read(file: &[u8]) -> Result<Program, String> {
    let mut program = Program { text: 0, rodata: 0, statics: 0, data: 0, symbols: Vec::new() };
    let mut reader = Reader(file.strip_prefix(MAGIC).ok_or("this is not a module of WebAssembly")?);
    while !reader.0.is_empty() {
        let (kind, section) = reader.part().ok_or("this module is not whole")?;
        match kind {
            CODE => program.text = section.0.len() as u64,
            DATA => program.rodata = section.0.len() as u64,
            CUSTOM => named(section, &mut program.symbols).ok_or("the names in this module are not whole")?,
            _ => {}
        }
    }
    if program.symbols.is_empty() { Err("the names are stripped".into()) } else { Ok(program) }
}

/// Adds the functions of a custom section, if it is the one with the names.
fn named(mut section: Reader<'_>, symbols: &mut Vec<(String, u64)>) -> Option<()> {
    if section.name()? != "name" {
        return Some(());
    }
    while !section.0.is_empty() {
        let (kind, mut part) = section.part()?;
        if kind == FUNCTIONS {
            for _ in 0..part.number()? {
                let index = part.number()?;
                symbols.push((part.name()?.to_string(), index));
            }
        }
    }
    Some(())
}

/// The bytes that are left.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn bytes(&mut self, count: u64) -> Option<&'a [u8]> {
        let (bytes, rest) = self.0.split_at_checked(usize::try_from(count).ok()?)?;
        self.0 = rest;
        Some(bytes)
    }

    fn byte(&mut self) -> Option<u8> {
        Some(self.bytes(1)?[0])
    }

    /// An unsigned number of 32 bits in LEB128, so at most five bytes.
    fn number(&mut self) -> Option<u64> {
        let mut number = 0;
        for group in 0..5 {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7f) << (7 * group);
            if byte & 0x80 == 0 {
                return Some(number);
            }
        }
        None
    }

    fn name(&mut self) -> Option<&'a str> {
        let length = self.number()?;
        std::str::from_utf8(self.bytes(length)?).ok()
    }

    /// A part with its kind and its length before it.
    fn part(&mut self) -> Option<(u8, Reader<'a>)> {
        let kind = self.byte()?;
        let length = self.number()?;
        Some((kind, Reader(self.bytes(length)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part: its kind, its length, which is less than 128, and its bytes.
    fn part(kind: u8, bytes: &[u8]) -> Vec<u8> {
        [&[kind, u8::try_from(bytes.len()).unwrap()], bytes].concat()
    }

    /// A module with types, 200 bytes of code, three of data, names of the module and of two functions, and a section
    /// of another tool.
    fn module() -> Vec<u8> {
        // The numbers of functions are 7 and 300.
        let functions = part(FUNCTIONS, b"\x02\x07\x05begin\xac\x02\x0cpanic_bounds");
        let names = [b"\x04name", &part(0, b"\x01m")[..], &functions].concat();
        let code = [&[CODE, 0xc8, 0x01][..], &[0; 200]].concat();
        let sections =
            [part(1, b"\0"), code, part(DATA, b"abc"), part(CUSTOM, b"\x05other?"), part(CUSTOM, &names)];
        [MAGIC.to_vec(), sections.concat()].concat()
    }

    #[test]
    fn a_module_is_weighed_and_its_functions_are_named() {
        let program = Program::read(&module()).unwrap();
        assert_eq!((program.text, program.rodata), (200, 3));
        assert_eq!(program.symbols, [("begin".to_string(), 7), ("panic_bounds".to_string(), 300)]);
        assert_eq!(program.panics(), ["panic_bounds"]);
    }

    #[test]
    fn a_module_cut_off_is_refused() {
        let whole = module();
        assert!((0..whole.len()).all(|length| Program::read(&whole[..length]).is_err()));
    }

    #[test]
    fn a_number_of_more_than_32_bits_is_refused() {
        assert_eq!(Reader(&[0xff, 0xff, 0xff, 0xff, 0x0f]).number(), Some(0xffff_ffff));
        assert_eq!(Reader(&[0xff, 0xff, 0xff, 0xff, 0xff, 0x01]).number(), None);
    }
}
