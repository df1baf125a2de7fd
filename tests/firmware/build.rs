//! Lays the memory of the board out: its file of `boards/` is what the linker scripts of the runtime crates include.
//! WebAssembly has no layout of its own.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let target = env::var("TARGET").expect("cargo sets the target");
    let (board, scripts): (&str, &[&str]) = match target.split('-').next().unwrap_or_default() {
        "wasm32" => return,
        "thumbv8m.main" => {
            println!("cargo::rustc-cfg=armv8m");
            ("boards/an505.x", &["link.x"])
        }
        thumb if thumb.starts_with("thumb") => ("boards/mps2.x", &["link.x"]),
        "riscv32imc" => ("boards/virt.x", &["memory.x", "link.x"]),
        _ => panic!("there is no board of the target `{target}`"),
    };
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets the folder for output"));
    fs::copy(board, folder.join("memory.x")).expect("the board's file is copied");
    println!("cargo::rerun-if-changed={board}");
    println!("cargo::rustc-link-search={}", folder.display());
    for script in scripts {
        println!("cargo::rustc-link-arg-bins=-T{script}");
    }
}
