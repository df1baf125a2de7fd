//! Draws every scene on the host and says what the boards must get, one line each: name, hash, the mesh's triangles,
//! written pixels. A folder as argument also gets the pictures, as PPM files.

use alberti::Stats;
use scenes::{HEIGHT, SCENES, Target, WIDTH};
use std::error::Error;
use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args_os().nth(1);
    let mut target = Box::new(Target::EMPTY);
    for scene in SCENES {
        target.clear();
        (scene.draw)(&mut target, &scene.camera, &scene.model, &mut ());
        let hash = target.hash();

        target.clear();
        let mut stats = Stats::default();
        (scene.count)(&mut target, &scene.camera, &scene.model, &mut stats);
        if target.hash() != hash {
            return Err(format!("{}: counting changes the frame", scene.name).into());
        }
        let triangles = scene.model.triangles.len() as u64;
        // Meshlets that are not seen are not submitted.
        if stats.written == 0 || stats.submitted != triangles && !scene.name.starts_with("meshlets") {
            return Err(format!("{}: not drawn: {stats:?}", scene.name).into());
        }
        println!("frame {} {hash:016x} {triangles} {}", scene.name, stats.written);
        if let Some(folder) = &folder {
            fs::write(Path::new(folder).join(scene.name).with_extension("ppm"), picture(&target))?;
        }
    }
    Ok(())
}

/// The frame as a file in the Portable Pixmap format.
fn picture(target: &Target) -> Vec<u8> {
    let mut file = format!("P6\n{WIDTH} {HEIGHT}\n255\n").into_bytes();
    for &pixel in target.color() {
        let pixel = u16::from_le(pixel);
        for (field, greatest) in [(pixel >> 11, 31), (pixel >> 5 & 63, 63), (pixel & 31, 31)] {
            file.push(u8::try_from(field * 255 / greatest).unwrap_or(u8::MAX));
        }
    }
    file
}
