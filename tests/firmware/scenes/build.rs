//! Makes the mip map of the floor and the meshlets of the torus before the programs are built, as one does for assets
//! that lie in flash.

#[path = "src/torus.rs"]
#[expect(dead_code, unreachable_pub, reason = "the programs have the rest")]
mod torus;

use alberti::glam::Vec3;
use alberti::texture::format::Rgb565;
use alberti::texture::mipmap;
use alberti::{IntegerMesh, IntegerVertex, Split};
use std::path::Path;
use std::{env, fs};
use torus::{HalfWords, TORUS_IN_HALF_WORDS, TORUS_TRIANGLE_LIST};

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
    fs::write(Path::new(&folder).join("meshlets.rs"), meshlets()).expect("the meshlets are written");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/torus.rs");
}

/// The torus' triangles in the order of meshlets, these, and a ball around them, as the source of a constant.
fn meshlets() -> String {
    let places = TORUS_IN_HALF_WORDS
        .each_ref()
        .map(|v| Vec3::from_array(v.position.map(|c| f32::from(c) * HalfWords::UNIT)));
    let split = Split::new(&places, &TORUS_TRIANGLE_LIST.map(|triangle| triangle.map(u32::from)), 16);
    let stage = |v: &HalfWords| IntegerVertex::<()> { place: v.position, components: () };
    let mesh = IntegerMesh::new(&TORUS_IN_HALF_WORDS, &split.triangles, HalfWords::UNIT, stage);
    let (meshlets, ball) = split.bounds(&mesh);
    let [x, y, z] = ball.center.to_array();
    format!(
        "static TORUS_MESHLETS: ([[u16; 3]; {}], [Meshlet; {}], Ball) = ({:?}, {meshlets:?}, \
         Ball {{ center: Vec3::new({x:?}, {y:?}, {z:?}), radius: {:?} }});",
        split.triangles.len(),
        meshlets.len(),
        split.triangles,
        ball.radius,
    )
}
