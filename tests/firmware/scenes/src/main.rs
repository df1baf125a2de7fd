//! Draws every scene on the host and says what the boards must get, one line each: name, hash, the mesh's triangles,
//! written pixels. A folder as argument also gets the pictures, as PPM files. With `policies` before it, the scenes are
//! the folder's files `00`, `01` and so on, drawn by every policy: scene, number of the policy, its name, hash.

use alberti::Stats;
use scenes::policies::{Loaded, Memory, POLICIES};
use scenes::{HEIGHT, SCENES, Target, WIDTH};
use std::error::Error;
use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args_os().nth(1);
    if let (Some("policies"), Some(files)) =
        (folder.as_ref().and_then(|word| word.to_str()), env::args_os().nth(2))
    {
        return by_policies(Path::new(&files));
    }
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
        // Meshlets that are not seen are not submitted, nor are points; bands without a list, and lines, are several
        // times.
        let submitted = stats.submitted > 0 && stats.submitted.is_multiple_of(triangles);
        let others = scene.name.starts_with("meshlets") || scene.name.ends_with("points");
        if stats.written == 0 || !submitted && !others {
            return Err(format!("{}: not drawn: {stats:?}", scene.name).into());
        }
        println!("frame {} {hash:016x} {triangles} {}", scene.name, stats.written);
        if let Some(folder) = &folder {
            fs::write(Path::new(folder).join(scene.name).with_extension("ppm"), picture(&target))?;
        }
    }
    Ok(())
}

/// Draws the scenes of a folder by every policy.
fn by_policies(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut memory = Box::new(Memory::EMPTY);
    let mut loaded = Box::new(Loaded::EMPTY);
    for number in 0..100 {
        let Ok(file) = fs::read(folder.join(format!("{number:02}"))) else { break };
        let mut words =
            file.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
        let scene = loaded.read(|| words.next()).ok_or_else(|| format!("{number:02} is no scene"))?;
        for (policy, index) in POLICIES.iter().zip(0..) {
            memory.clear(policy);
            (policy.draw)(&mut memory, &scene);
            println!("{number} {index} {:016x} {}", memory.hash(), policy.name);
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
