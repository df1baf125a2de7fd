//! Makes the mip map of the floor before the programs are built, as one does for a texture that lies in flash.

use alberti_texture::format::Rgb565;
use alberti_texture::mipmap;
use std::path::Path;
use std::{env, fs};

/// The sides of level 0.
const SIDE: u16 = 64;

fn main() {
    let side = u32::from(SIDE);
    let mut texels = vec![0; mipmap::texel_count(side, side)];
    for (texel, at) in texels.iter_mut().zip(0..SIDE * SIDE) {
        let [x, y] = [at % SIDE, at / SIDE];
        // Chequers with a light joint around each, and a hue that tells where they are.
        let joint = x % 16 == 0 || y % 16 == 0;
        let dark = (x / 16 + y / 16) % 2;
        let (red, green, blue) = if joint { (28, 56, 24) } else { (x / 2, y, 31 - (x ^ y) / 2) };
        *texel = (red >> dark) << 11 | (green >> dark) << 5 | blue >> dark;
    }
    mipmap::build(Rgb565, &mut texels, side, side).expect("a square and room for its levels");
    let folder = env::var_os("OUT_DIR").expect("cargo sets the folder for output");
    fs::write(Path::new(&folder).join("floor.rs"), format!("{texels:?}")).expect("the texels are written");
    println!("cargo::rerun-if-changed=build.rs");
}
