//! Makes the object before the program is built, as one does with assets that lie in flash: a knot in a thousand
//! triangles, a texture with all its levels, and a turn's sines.

use alberti::glam::{Quat, Vec3};
use alberti::texture::format::Rgb565;
use alberti::texture::mipmap;
use std::f32::consts::TAU;
use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

/// Cells of the tube, along and around; each is two triangles.
const CELLS: [u16; 2] = [63, 8];
/// The texture is on it so many times.
const TIMES: [u16; 2] = [12, 2];
/// The sides of the texture.
const SIDE: u32 = 64;

fn main() {
    let mut source = String::new();
    vertices(&mut source);
    triangles(&mut source);
    texels(&mut source);
    let sines: Vec<f32> = (0..256).map(|k| (TAU * k as f32 / 256.0).sin()).collect();
    writeln!(source, "static SINES: [f32; 256] = {sines:?};").expect("a string");
    let folder = env::var_os("OUT_DIR").expect("cargo sets the folder for output");
    fs::write(Path::new(&folder).join("object.rs"), source).expect("the object is written");
    println!("cargo::rerun-if-changed=build.rs");
}

/// Places in 2^-14, normals in 127ths, texture coordinates in 4096ths.
fn vertices(source: &mut String) {
    let [along, around] = CELLS;
    let mut vertices = vec![];
    for i in 0..=along {
        let [at, ahead] = [i as f32, i as f32 + 0.01].map(|i| middle(TAU * i / f32::from(along)));
        let forward = (ahead - at).normalize();
        let side = forward.cross(at).normalize();
        for j in 0..=around {
            let turn = Quat::from_axis_angle(forward, TAU * f32::from(j) / f32::from(around));
            let normal = turn * side;
            let place = (at + normal * 0.30) * 0.44;
            let [place, normal] = [(place, 16384.0), (normal, 127.0)]
                .map(|(v, scale)| (v * scale).round().to_array().map(|c| c as i16));
            let uv = [(i, along, TIMES[0]), (j, around, TIMES[1])]
                .map(|(k, of, times)| u32::from(k) * u32::from(times) * 4096 / u32::from(of));
            vertices.push(format!("Vertex {{ place: {place:?}, normal: {normal:?}, uv: {uv:?} }}"));
        }
    }
    writeln!(source, "static VERTICES: [Vertex; {}] = [{}];", vertices.len(), vertices.join(", "))
        .expect("a string");
}

/// The middle of the tube: a trefoil.
fn middle(angle: f32) -> Vec3 {
    let (sin, cos) = (2.0 * angle).sin_cos();
    let out = 1.0 + 0.40 * (3.0 * angle).cos();
    Vec3::new(out * cos, out * sin, 0.55 * (3.0 * angle).sin())
}

fn triangles(source: &mut String) {
    let [along, around] = CELLS;
    let mut triangles = vec![];
    for first in (0..along).flat_map(|i| (0..around).map(move |j| i * (around + 1) + j)) {
        let next = first + around + 1;
        triangles.push([first, next + 1, next]);
        triangles.push([first, first + 1, next + 1]);
    }
    writeln!(source, "pub(crate) static TRIANGLES: [[u16; 3]; {}] = {triangles:?};", triangles.len())
        .expect("a string");
}

/// Scales, each lighter towards its edge, in rows that are half a scale apart.
fn texels(source: &mut String) {
    let mut texels = vec![0; mipmap::texel_count(SIDE, SIDE)];
    for (k, texel) in (0..SIDE * SIDE).zip(&mut texels) {
        let [x, y] = [k % SIDE, k / SIDE].map(|c| (c as f32 + 0.5) / 32.0);
        // The nearest of the scales that hang from above covers this place.
        let (distance, row) = [0.0, 1.0, 2.0]
            .map(|up| {
                let row = (2.0 * y).floor() - up;
                let shift = if row.rem_euclid(2.0) > 0.5 { 0.5 } else { 0.0 };
                let across = (x - shift).rem_euclid(1.0) - 0.5;
                (across.hypot(y - row / 2.0), row)
            })
            .into_iter()
            .find(|(distance, _)| *distance < 0.56)
            .unwrap_or((0.56, 0.0));
        let hue = if row.rem_euclid(2.0) > 0.5 { [0.10, 0.55, 0.62] } else { [0.13, 0.42, 0.60] };
        let edge = ((distance - 0.40) / 0.16).clamp(0.0, 1.0);
        let light = 0.75 + 0.45 * distance;
        let [r, g, b] = hue.map(|c| (c * light * (1.0 - edge) + 0.95 * edge).min(1.0));
        *texel = ((r * 31.0) as u16) << 11 | ((g * 63.0) as u16) << 5 | (b * 31.0) as u16;
    }
    mipmap::build(Rgb565, &mut texels, SIDE, SIDE).expect("a square and room for its levels");
    writeln!(source, "const SIDE: u32 = {SIDE};\nstatic TEXELS: [u16; {}] = {texels:?};", texels.len())
        .expect("a string");
}
