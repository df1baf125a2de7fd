//! Links by the script of the hardware layer, which has the chip's memory.

fn main() {
    println!("cargo::rustc-link-arg-bins=-Tlinkall.x");
}
