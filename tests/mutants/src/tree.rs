//! A copy of the repository, and the switch in it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::LIBRARIES;
use crate::list::Mutant;
use crate::tables::STD;

/// The folder of a copy.
pub(crate) struct Tree {
    pub(crate) root: PathBuf,
    /// The folder of what is compiled, and of the state.
    pub(crate) folder: PathBuf,
}

/// What the crate with the switch begins with: a constant's value cannot depend on the variable.
const FEATURES: &str = "#![feature(core_intrinsics, const_eval_select)]\n#![allow(internal_features)]\n";

/// The switch. Its variable is set before `main`, by the environment. With `record` it notes which switches are passed,
/// in the file that `MUTANT_REACHED` names. No mutant is alive in what is computed while compiling.
const SWITCH: &str = r#"
#[doc(hidden)]
#[allow(missing_docs, clippy::all, reason = "not of the library")]
pub mod mutant_switch {
    use core::ffi::{c_char, c_int, c_void};
    const RECORD: u32 = u32::MAX;
    const MOST: usize = 1 << 15;
    static mut ALIVE: u32 = u32::MAX - 1;
    static mut REACHED: [u8; MOST] = [0; MOST];
    unsafe extern "C" {
        fn getenv(name: *const c_char) -> *const c_char;
        fn atoi(text: *const c_char) -> c_int;
        fn atexit(end: extern "C" fn()) -> c_int;
        fn fopen(name: *const c_char, mode: *const c_char) -> *mut c_void;
        fn fwrite(bytes: *const u8, size: usize, count: usize, file: *mut c_void) -> usize;
        fn fclose(file: *mut c_void) -> c_int;
    }
    #[inline(always)]
    pub const fn mutant(number: u32) -> bool {
        core::intrinsics::const_eval_select((number,), while_compiling, while_running)
    }
    const fn while_compiling(_: u32) -> bool {
        false
    }
    #[inline(always)]
    fn while_running(number: u32) -> bool {
        unsafe {
            if ALIVE == RECORD {
                (&raw mut REACHED).cast::<u8>().add(number as usize).write(1);
            }
            ALIVE == number
        }
    }
    extern "C" fn end() {
        unsafe {
            let name = getenv(c"MUTANT_REACHED".as_ptr());
            if name.is_null() {
                return;
            }
            let file = fopen(name, c"wb".as_ptr());
            fwrite((&raw const REACHED).cast(), 1, MOST, file);
            fclose(file);
        }
    }
    extern "C" fn begin() {
        unsafe {
            if !getenv(c"MUTANT_REACHED".as_ptr()).is_null() {
                ALIVE = RECORD;
                atexit(end);
                return;
            }
            let alive = getenv(c"MUTANT".as_ptr());
            if !alive.is_null() {
                ALIVE = atoi(alive) as u32;
            }
        }
    }
    #[used]
    #[unsafe(link_section = ".init_array")]
    static BEGIN: extern "C" fn() = begin;
}
#[doc(hidden)]
pub use mutant_switch::mutant;
"#;

impl Tree {
    /// Copies what git knows of the repository, as it is in the folder, and puts in the switch. Files with mutants are
    /// written later, so that they change only if their mutants do.
    pub(crate) fn new(from: &Path, folder: &Path, mutants: &[Mutant]) -> Result<Self, String> {
        let failed = |what: &Path, error: std::io::Error| format!("{}: {error}", what.display());
        fs::create_dir_all(folder).map_err(|error| failed(folder, error))?;
        let folder = folder.canonicalize().map_err(|error| failed(folder, error))?;
        let root = folder.join("tree");
        let listed = Command::new("git")
            .current_dir(from)
            .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
            .output();
        let listed = listed.map_err(|error| format!("cannot run git: {error}"))?;
        for name in String::from_utf8_lossy(&listed.stdout).split('\0').filter(|name| !name.is_empty()) {
            if mutants.iter().any(|mutant| mutant.file == Path::new(name)) {
                continue;
            }
            let (source, target) = (from.join(name), root.join(name));
            let Ok(bytes) = fs::read(&source) else { continue };
            write(&target, &with_switch(name, bytes))?;
        }
        Ok(Self { root, folder })
    }

    /// A command in the copy, with its own folder of what is compiled.
    pub(crate) fn cargo(&self) -> Command {
        let mut cargo = Command::new("cargo");
        cargo.current_dir(&self.root).env("CARGO_TARGET_DIR", self.folder.join("target"));
        // The pieces between switches look odd to the compiler.
        cargo.env("RUSTFLAGS", "--cap-lints allow").env("RUSTC_BOOTSTRAP", "1");
        cargo
    }
}

/// A file of the copy: the roots of the libraries have the switch.
fn with_switch(name: &str, bytes: Vec<u8>) -> Vec<u8> {
    let changed = |change: &dyn Fn(&str) -> String| change(&String::from_utf8_lossy(&bytes)).into_bytes();
    let library = name.strip_prefix("crates/").and_then(|name| name.strip_suffix("/src/lib.rs"));
    match library.filter(|library| LIBRARIES.contains(library)) {
        _ if name == "Cargo.toml" => {
            changed(&|text| text.replace("unsafe_code = \"forbid\"", "unsafe_code = \"allow\""))
        }
        None => bytes,
        Some(library) => changed(&|text| {
            let text = text.replace("#![forbid(unsafe_code)]", "");
            match library {
                "math" => format!("{FEATURES}{text}{STD}{SWITCH}"),
                _ => format!("{text}{STD}#[doc(hidden)]\npub use alberti_math::mutant_switch::mutant;\n"),
            }
        }),
    }
}

/// Writes a file, unless it is so already: what has not changed is not compiled again.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    if fs::read(path).is_ok_and(|before| before == bytes) {
        return Ok(());
    }
    let made = path.parent().map_or(Ok(()), fs::create_dir_all);
    made.and_then(|()| fs::write(path, bytes)).map_err(|error| format!("{}: {error}", path.display()))
}
