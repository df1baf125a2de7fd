//! Numbers of pixels in files beside the picture: PNG of 16 bits, or one OpenEXR file.

use std::io::Cursor;
use std::path::PathBuf;

use image::{ExtendedColorType, ImageFormat};

use super::exr::{self, Channel, Kind};
use super::file::{Output, Whole};
use crate::aov::{Layers, Seen};
use crate::error::{Error, number};
use crate::options::values::name_of;
use crate::options::{Aov, AovFormat, Aovs};
use crate::scene::{Camera, Image};

/// z where nothing is seen, in OpenEXR.
const NOWHERE: f32 = 1e10;
/// Steps of a level of detail in 16 bits, and the level whose word is 0.
const LOD: (f32, f32) = (2048.0, -16.0);

/// The files to write.
#[derive(Debug)]
pub struct Beside {
    aovs: Aovs,
    format: AovFormat,
    files: Vec<Whole>,
}

/// The names of the files, for a picture of that name: `x.depth.png` and so on, or `x.exr`.
///
/// # Errors
/// The picture has no name, or one of these.
pub fn names(output: &Output, aovs: &Aovs, format: AovFormat) -> Result<Vec<PathBuf>, Error> {
    if !output.is_file() {
        let error = Error::new("it with a picture that is no file", "one in a file, whose name files have");
        return Err(error.place("--aov").hint("name the picture with -o"));
    }
    let named = output.name();
    let names: Vec<_> = match format {
        AovFormat::Exr => vec![named.with_extension("exr")],
        AovFormat::Png16 => {
            aovs.iter().map(|aov| named.with_extension(format!("{}.png", name_of(aov)))).collect()
        }
    };
    if names.iter().any(|name| name == named) {
        let error = Error::new("the name of the file with --aov", "another name for the picture");
        return Err(error.file(named).hint("choose another with -o"));
    }
    Ok(names)
}

impl Beside {
    /// Refuses files of which one has been read.
    pub(crate) fn check_unread(&self) -> Result<(), Error> {
        self.files.iter().try_for_each(Whole::check_unread)
    }

    /// Files of [`names`].
    #[must_use]
    pub fn new(aovs: Aovs, format: AovFormat, files: Vec<Whole>) -> Self {
        Self { aovs, format, files }
    }

    /// The files with their bytes.
    ///
    /// # Errors
    /// Encoding fails.
    pub fn encoded(
        &self,
        layers: &Layers,
        picture: &Image,
        camera: &Camera,
    ) -> Result<Vec<(&Whole, Vec<u8>)>, Error> {
        let [width, height] = layers.size();
        if self.format == AovFormat::Exr {
            let channels =
                color(picture).into_iter().chain(self.aovs.iter().flat_map(|aov| channels(aov, layers)));
            let file = exr::encode(width, height, channels.collect());
            return Ok(self.files.iter().map(|named| (named, file.clone())).collect());
        }
        let png = |(file, aov): (_, Aov)| {
            let (words, kind) = words(aov, layers, [camera.near, camera.far]);
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
            let mut png = Cursor::new(Vec::new());
            let written =
                image::write_buffer_with_format(&mut png, &bytes, width, height, kind, ImageFormat::Png);
            written.map_err(|error| Error::new(format!("that encoding fails ({error})"), "another size"))?;
            Ok((file, png.into_inner()))
        };
        self.files.iter().zip(self.aovs.iter()).map(png).collect()
    }

    /// A line on each file.
    #[must_use]
    pub fn summary(&self, camera: &Camera) -> String {
        let meaning = |aov| match aov {
            Aov::Depth => {
                let [near, depth] = [camera.near, camera.far - camera.near].map(number);
                format!("z = {near} + {depth} * v / 65535; 65535 where nothing is")
            }
            Aov::Normal => "world space, n = 2 * v / 65535 - 1; 0,0,0 where nothing is".to_owned(),
            Aov::Uv => "u and v without whole parts, v / 65535; blue is 65535 where something is".to_owned(),
            Aov::Id => "object, triangle / 65536, triangle % 65536; 0 where nothing is".to_owned(),
            Aov::Lod => format!("level = v / {} - {}; 0 without a texture", LOD.0, -LOD.1),
        };
        let line = |(file, told): (&Whole, String)| format!("aov: {}: {told}\n", file.name().display());
        if self.format == AovFormat::Exr {
            let all: Vec<_> = self.aovs.iter().flat_map(exr_names).map(|(name, _)| *name).collect();
            let told = format!("RGBA, linear, and {}", all.join(", "));
            return self.files.iter().map(|file| line((file, told.clone()))).collect();
        }
        self.files.iter().zip(self.aovs.iter().map(meaning)).map(line).collect()
    }
}

/// The picture in linear light, multiplied by its alpha.
fn color(picture: &Image) -> [Channel; 4] {
    let linear = |byte: u8| {
        let x = f32::from(byte) / 255.0;
        if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    };
    let of = |k: usize| {
        let word = |texel: &[u8; 4]| {
            let alpha = f32::from(texel[3]) / 255.0;
            if k == 3 { alpha } else { linear(texel[k]) * alpha }
        };
        picture.texels.iter().map(|texel| word(texel).to_bits()).collect()
    };
    let channel = |(name, k)| Channel { name, kind: Kind::Float, words: of(k) };
    [("R", 0), ("G", 1), ("B", 2), ("A", 3)].map(channel)
}

/// The names that programs know: Z alone is the depth, and layers have a dot.
fn exr_names(aov: Aov) -> &'static [(&'static str, Kind)] {
    match aov {
        Aov::Depth => &[("Z", Kind::Float)],
        Aov::Normal => &[("N.X", Kind::Float), ("N.Y", Kind::Float), ("N.Z", Kind::Float)],
        Aov::Uv => &[("UV.U", Kind::Float), ("UV.V", Kind::Float)],
        Aov::Id => &[("id.object", Kind::Uint), ("id.triangle", Kind::Uint)],
        Aov::Lod => &[("lod.V", Kind::Float)],
    }
}

fn channels(aov: Aov, layers: &Layers) -> Vec<Channel> {
    let of = |seen: Option<Seen>| -> [u32; 3] {
        let bits = |x: f32| x.to_bits();
        match (aov, seen) {
            (Aov::Depth, seen) => [bits(seen.map_or(NOWHERE, |seen| seen.depth)), 0, 0],
            (_, None) => [0; 3],
            (Aov::Normal, Some(seen)) => seen.normal.map(bits),
            (Aov::Uv, Some(Seen { uv: [u, v], .. })) => [bits(u), bits(v), 0],
            (Aov::Id, Some(seen)) => [seen.object, seen.triangle, 0],
            (Aov::Lod, Some(seen)) => [bits(seen.lod.unwrap_or(0.0)), 0, 0],
        }
    };
    let names = exr_names(aov).iter().enumerate();
    names
        .map(|(k, &(name, kind))| Channel {
            name,
            kind,
            words: layers.pixels().map(|seen| of(seen)[k]).collect(),
        })
        .collect()
}

/// The words of a PNG, and how many a pixel has.
fn words(aov: Aov, layers: &Layers, [near, far]: [f32; 2]) -> (Vec<u16>, ExtendedColorType) {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    let rounded = |x: f32| (x + 0.5) as u16;
    let low = |x: u32| u16::try_from(x & 0xffff).unwrap_or(0);
    let one =
        |word: &dyn Fn(Option<Seen>) -> u16| (layers.pixels().map(word).collect(), ExtendedColorType::L16);
    let three = |words: &dyn Fn(Seen) -> [u16; 3]| {
        let all = layers.pixels().flat_map(|seen| seen.map_or([0; 3], words));
        (all.collect(), ExtendedColorType::Rgb16)
    };
    match aov {
        Aov::Depth => {
            let word = |seen: Seen| rounded((seen.depth - near) / (far - near) * 65535.0);
            one(&|seen| seen.map_or(u16::MAX, word))
        }
        Aov::Normal => three(&|seen| seen.normal.map(|x| rounded((x * 0.5 + 0.5) * 65535.0))),
        Aov::Uv => three(&|seen| {
            let [u, v] = seen.uv.map(|x| rounded((x - x.floor()) * 65535.0));
            [u, v, u16::MAX]
        }),
        Aov::Id => three(&|seen| {
            [u16::try_from(seen.object).unwrap_or(u16::MAX), low(seen.triangle >> 16), low(seen.triangle)]
        }),
        Aov::Lod => {
            let word = |lod: f32| rounded((lod - LOD.1) * LOD.0).max(1);
            one(&|seen| seen.and_then(|seen| seen.lod).map_or(0, word))
        }
    }
}
