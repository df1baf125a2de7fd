//! Peers that are programs of other languages, each a process that draws one scene at one size when it is asked to.

use crate::Size;
use crate::pavement::{AMBIENT, LIGHT, TO_LIGHT};
use crate::scene_data::Scene;
use alberti::Rgba8888;
use alberti::texture::mipmap;
use alberti_app::options::Filter;
use std::ffi::OsStr;
use std::fs;
use std::io::{self, BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// The bytes of a scene at a size, words and numbers in the machine's order.
///
/// ```text
/// f32 matrix from world to clip space, row by row (16)      f32 background (4)
/// u32 filter: 0 nearest, 1 bilinear, 2 trilinear       u32 probes of it: above 1 it is anisotropic
/// u32 vertices, and for each  f32 place (3), texture coordinates from the top left corner (2), colour (3)
/// u32 triangles, and for each  u32 vertices (3)
/// u32 columns and rows of the texture, or 0, and its levels, and for each texel  u8 red, green, blue, alpha
/// u32 1 for a normal map of that size, or 0: then its texels, as u8 x, y, z, 255;
///     f32 direction to the light (3), light, ambient light; for each vertex  f32 normal (3), tangent and sign (4)
/// ```
///
/// # Panics
/// Never: a scene's texture has levels.
#[must_use]
pub fn scene_bytes(scene: &Scene, size: Size) -> Vec<u8> {
    let model = &scene.built_in.model;
    let mut words: Vec<u32> = Vec::new();
    let matrix = scene.clip_from_world(size);
    let background = scene.background().map(|c| f32::from(c) / 255.0);
    words.extend(matrix.iter().flatten().chain(&background).map(|x| x.to_bits()));
    let filter = match scene.built_in.filter {
        Filter::Nearest => [0, 1],
        Filter::Bilinear => [1, 1],
        Filter::Trilinear => [2, 1],
        Filter::Anisotropic(probes) => [2, probes.count()],
    };
    words.extend(filter);
    words.push(model.vertices.len() as u32);
    for v in &model.vertices {
        let uv = [v.uv[0], 1.0 - v.uv[1]];
        words.extend(v.position.iter().chain(&uv).chain(&v.color).map(|x| x.to_bits()));
    }
    words.push(scene.triangles.len() as u32);
    words.extend(scene.triangles.iter().flatten());
    let Some(texture) = &scene.texture else {
        words.extend([0; 4]);
        return bytemuck::cast_slice(&words).to_vec();
    };
    let [width, height] = [texture.width(), texture.height()];
    let mut texels = texture.data().to_vec();
    let mut levels = 1;
    if filter[0] == 2 {
        texels.resize(mipmap::texel_count(width, height), [0; 4]);
        mipmap::build(Rgba8888, &mut texels, width, height).expect("a texture");
        levels = mipmap::level_count(width, height) as u32;
    }
    words.extend([width, height, levels]);
    let mut bytes = [bytemuck::cast_slice(&words), bytemuck::cast_slice(&texels)].concat();
    let Some(stones) = &scene.stones else {
        bytes.extend(0u32.to_ne_bytes());
        return bytes;
    };
    bytes.extend(1u32.to_ne_bytes());
    bytes.extend(stones.normal.as_flattened());
    let light = TO_LIGHT.to_array().into_iter().chain([LIGHT, AMBIENT]);
    let axes = model.vertices.iter().flat_map(|v| v.normal.into_iter().chain(v.tangent));
    bytes.extend(light.chain(axes).flat_map(f32::to_ne_bytes));
    bytes
}

/// A program that draws a scene: see the top of `peers/peer.h` for its side.
#[derive(Debug)]
pub struct Process {
    child: Child,
    to: Option<ChildStdin>,
    from: BufReader<ChildStdout>,
    path: String,
}

impl Process {
    /// Starts a program on a scene that is in a file.
    ///
    /// # Errors
    /// If it does not start.
    pub fn start(program: &OsStr, scene: &Path, size: Size) -> io::Result<Self> {
        let mut child = Command::new(program)
            .arg(scene)
            .args([size.width.to_string(), size.height.to_string()])
            .env("LP_NUM_THREADS", "0")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| io::Error::other(format!("cannot start {}: {error}", program.display())))?;
        let to = child.stdin.take();
        let from = BufReader::new(child.stdout.take().ok_or(io::ErrorKind::BrokenPipe)?);
        Ok(Self { child, to, from, path: program.display().to_string() })
    }

    fn ask(&mut self, line: &str) -> io::Result<String> {
        let to = self.to.as_mut().ok_or(io::ErrorKind::BrokenPipe)?;
        writeln!(to, "{line}")?;
        to.flush()?;
        let mut answer = String::new();
        if self.from.read_line(&mut answer)? == 0 {
            return Err(io::Error::other(format!("{} ended at `{line}`", self.path)));
        }
        Ok(answer.trim_end().to_owned())
    }

    /// Its name and version, or else the feature that it lacks to draw the scene.
    ///
    /// # Errors
    /// If the program has ended.
    pub fn name(&mut self) -> io::Result<Result<String, String>> {
        let answer = self.ask("name")?;
        Ok(match answer.strip_prefix("lacks ") {
            Some(feature) => Err(feature.into()),
            None => Ok(answer),
        })
    }

    /// Draws frames: the least milliseconds of one.
    ///
    /// # Errors
    /// If the program has ended, or answers anything but a number.
    pub fn milliseconds(&mut self, frames: u32) -> io::Result<f64> {
        let answer = self.ask(&format!("frames {frames}"))?;
        answer
            .parse()
            .map_err(|_| io::Error::other(format!("{} answers `{answer}`, expected milliseconds", self.path)))
    }

    /// The last frame, by a file that is removed again.
    ///
    /// # Errors
    /// If the program has ended, or has not written that many pixels.
    pub fn picture(&mut self, file: &Path, size: Size) -> io::Result<Vec<[u8; 4]>> {
        self.ask(&format!("picture {}", file.display()))?;
        let bytes = fs::read(file)?;
        fs::remove_file(file)?;
        let (pixels, rest) = bytes.as_chunks();
        if pixels.len() != size.pixels() || !rest.is_empty() {
            return Err(io::Error::other(format!("{} wrote {} bytes for {size}", self.path, bytes.len())));
        }
        Ok(pixels.to_vec())
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // The end of its input ends it.
        self.to = None;
        let _ = self.child.wait();
    }
}
