//! Scenes as files that the boards read: words, the low byte first.

use crate::calibration::CALIBRATION;
use crate::scenes::{Scene, scene};
use alberti::glam::Vec3;
use alberti::texture::format::Rgb565;
use alberti::texture::mipmap;
use std::path::Path;

/// The scenes of the trade that the boards draw: estimates are held against these.
pub const JUDGED: [&str; 5] = ["near-flat", "floor", "close-up", "dense-mesh", "layers"];

/// All scenes of the boards, in the order of their files.
pub fn scenes() -> Vec<&'static Scene> {
    JUDGED.into_iter().map(scene).chain(CALIBRATION.iter()).collect()
}

/// Writes the files into a folder.
///
/// # Errors
/// A file cannot be written.
pub fn write(folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    for (number, scene) in scenes().into_iter().enumerate() {
        let bytes: Vec<u8> = words(scene).into_iter().flat_map(u32::to_le_bytes).collect();
        std::fs::write(folder.join(format!("{number:02}")), bytes)?;
    }
    Ok(())
}

/// Numbers of vertices, triangles and texels along a side; axes and origin of the world before the eye, opening angle,
/// near and far plane; vertices; indices; texels of all levels.
fn words(scene: &Scene) -> Vec<u32> {
    let count = |length: usize| u32::try_from(length).expect("small scenes");
    let [side, other] = scene.sides();
    assert!(side == other && side.is_power_of_two(), "{}: the boards have square textures", scene.name);
    let vertices = &scene.model.vertices;
    let mut words = vec![count(vertices.len()), count(scene.triangles().len()), side];
    let mut floats = |floats: &[f32]| words.extend(floats.iter().map(|float| float.to_bits()));
    let to_eye = scene.view().object_to_eye(None);
    floats(&to_eye.axes().to_cols_array());
    floats(&Vec3::to_array(&to_eye.origin().coords));
    floats(&[scene.camera.fov.to_radians(), scene.camera.near, scene.camera.far]);
    for vertex in vertices {
        floats(&vertex.position);
        floats(&vertex.uv);
    }
    words.extend(scene.triangles().iter().flatten());
    words.extend(levels(scene, side).into_iter().map(u32::from));
    words
}

/// The texture in 16 bits, and its mip map.
fn levels(scene: &Scene, side: u32) -> Vec<u16> {
    let texel =
        |&[r, g, b, _]: &[u8; 4]| u16::from(r >> 3) << 11 | u16::from(g >> 2) << 5 | u16::from(b >> 3);
    let mut texels: Vec<u16> = scene.model.textures[0].texels.iter().map(texel).collect();
    texels.resize(mipmap::texel_count(side, side), 0);
    mipmap::build(Rgb565, &mut texels, side, side).expect("a texture");
    texels
}
