//! Lays the memory of the board out: its file of `boards/` is what the linker scripts of the runtime crates include.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let arch = env::var("CARGO_CFG_TARGET_ARCH").expect("cargo sets the architecture");
    let (board, scripts): (&str, &[&str]) = match arch.as_str() {
        "arm" => ("boards/mps2.x", &["link.x"]),
        "riscv32" => ("boards/virt.x", &["memory.x", "link.x"]),
        other => panic!("there is no board with the architecture `{other}`"),
    };
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets the folder for output"));
    fs::copy(board, folder.join("memory.x")).expect("the board's file is copied");
    println!("cargo::rerun-if-changed={board}");
    println!("cargo::rustc-link-search={}", folder.display());
    for script in scripts {
        println!("cargo::rustc-link-arg-bins=-T{script}");
    }
}
