//! Textures in few bytes.

use super::palette::Palette;
use super::{Format, Wish, is_mipmapped};
use crate::error::Error;
use crate::options::{Dither, RenderOptions};
use crate::scene::{HeightImage, Image, Map, Model, Part};
use alberti::baked::{Attributes, TexelCode};
use alberti::raster::ColorFormat as _;
use alberti::raster::color::{Grey8, Pattern as _};
use alberti::texture::format::{L16, Normals, Rgb565, Rgb565Pairs, Rgba8888, Scalars, TexelFormat};
use alberti::texture::{TextureError, mipmap};
use alberti::{Rgba8, Rgba565};

/// A texture as it lies in flash.
#[derive(Clone, Debug)]
pub struct Texture {
    /// Its meaning.
    pub role: Role,
    /// The index of its image, or of its heights, in the model.
    pub image: usize,
    /// The format.
    pub format: Format,
    /// Columns and rows of level 0.
    pub size: [u16; 2],
    /// The colours of indices.
    pub palette: Vec<[u8; 4]>,
    /// The bytes of each level.
    pub levels: Vec<Vec<u8>>,
}

/// The meaning of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// The surface's colour.
    Color,
    /// The highlight's colour.
    Specular,
    /// Light of its own.
    Emissive,
    /// The mirrored surroundings.
    Environment,
    /// Directions.
    Normals,
    /// Light that arrives.
    Occlusion,
    /// Wetness.
    Wetness,
    /// The highlight's exponent.
    Shininess,
    /// The mirrored share.
    Reflection,
    /// Heights.
    Heights,
}

impl Role {
    /// Its name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Color => "colour",
            Self::Specular => "specular",
            Self::Emissive => "emissive",
            Self::Environment => "environment",
            Self::Normals => "normals",
            Self::Occlusion => "occlusion",
            Self::Wetness => "wetness",
            Self::Shininess => "shininess",
            Self::Reflection => "reflection",
            Self::Heights => "heights",
        }
    }

    /// The format of its texels: colours are as the user wishes, what is not seen by itself is kept.
    fn format(self, wish: Format) -> Format {
        match self {
            Self::Color | Self::Specular | Self::Emissive | Self::Environment => wish,
            Self::Normals => Format::Rgb888,
            Self::Heights => Format::Grey16,
            Self::Occlusion | Self::Wetness | Self::Shininess | Self::Reflection => Format::Grey8,
        }
    }
}

/// The textures that a picture with these attributes reads, and the number of each part's own.
pub(super) fn textures(
    model: &Model,
    options: &RenderOptions,
    attributes: Attributes,
    wish: &Wish,
) -> Result<(Vec<Texture>, Vec<Option<usize>>), Error> {
    let mut textures: Vec<Texture> = vec![];
    let mut of_parts = vec![None; model.parts.len()];
    let drawn = || model.parts.iter().enumerate().filter(|(_, part)| !part.triangles.is_empty());
    if !attributes.contains(Attributes::UV) {
        return Ok((textures, of_parts));
    }
    let own = |part: &Part| part.texture.map(|image| Map { image, filter: part.detail.filter, wrap: None });
    // An image has mip maps if any that reads it has a filter for them.
    let mipmapped: Vec<_> = drawn()
        .flat_map(|(_, part)| own(part).map(|map| (Role::Color, map)).into_iter().chain(others(part)))
        .filter(|(_, map)| is_mipmapped(map.filter.unwrap_or(options.filter)))
        .map(|(role, map)| (role, map.image))
        .collect();
    let mut number = |role, map: Map| {
        let known = textures.iter().position(|texture| (texture.role, texture.image) == (role, map.image));
        Ok::<_, Error>(match known {
            Some(number) => number,
            None => {
                let mips = mipmapped.contains(&(role, map.image));
                textures.push(texture(model, role, map.image, mips, wish)?);
                textures.len() - 1
            }
        })
    };
    // Numbers of surfaces' colours first.
    for (k, part) in drawn() {
        of_parts[k] = own(part).map(|map| number(Role::Color, map)).transpose()?;
    }
    for (_, part) in drawn() {
        for (role, map) in others(part) {
            number(role, map)?;
        }
    }
    Ok((textures, of_parts))
}

/// The images of a part beside the surface's colour, and its heights.
fn others(part: &Part) -> impl Iterator<Item = (Role, Map)> {
    let detail = &part.detail;
    let plain = |image| Map { image, filter: Some(crate::options::Filter::Bilinear), wrap: None };
    let all = [
        (Role::Specular, detail.specular_map),
        (Role::Emissive, detail.emissive_map),
        (Role::Environment, detail.environment.map(|environment| plain(environment.image))),
        (Role::Normals, detail.normal.map(|normal| normal.map)),
        (Role::Occlusion, detail.occlusion),
        (Role::Wetness, detail.wetness_map),
        (Role::Shininess, detail.shininess_map),
        (Role::Reflection, detail.reflection_map),
        (Role::Heights, detail.height.map(|height| plain(height.heights))),
    ];
    all.into_iter().filter_map(|(role, map)| Some((role, map?)))
}

/// An image of the model in its format.
fn texture(model: &Model, role: Role, image: usize, mips: bool, wish: &Wish) -> Result<Texture, Error> {
    let format = role.format(wish.format);
    let broken = |error: TextureError| Error::new(error.to_string(), "textures that can be drawn");
    let texture = |size: [u32; 2], palette, levels| Texture {
        role,
        image,
        format,
        size: size.map(|side| u16::try_from(side).unwrap_or(u16::MAX)),
        palette,
        levels,
    };
    if role == Role::Heights {
        let HeightImage { width, height, heights } = &*model.heights[image];
        let levels = chain(L16, heights, [*width, *height]).map_err(broken)?;
        let levels = kept(levels, false, wish.texture_size);
        let bytes = levels.iter().map(|level| level.texels.iter().flat_map(|h| h.to_le_bytes()).collect());
        return Ok(texture(levels[0].size, vec![], bytes.collect()));
    }
    let Image { width, height, texels } = &*model.textures[image];
    let size = [*width, *height];
    // Numbers are what no wish changes.
    let numbers = role.format(Format::Rgb565) != Format::Rgb565;
    let levels = match role {
        Role::Normals => chain(Normals(Rgba8888), texels, size),
        _ if numbers => chain(Scalars(Rgba8888), texels, size),
        _ => chain(Rgba8888, texels, size),
    };
    let levels = kept(levels.map_err(broken)?, mips, wish.texture_size);
    let Level { size: [width, height], texels } = &levels[0];
    let largest = Image { width: *width, height: *height, texels: texels.clone() };
    let palette = match format {
        Format::Grey1 => Some(Palette::ramp(2)),
        Format::Grey2 => Some(Palette::ramp(4)),
        Format::Grey4 => Some(Palette::ramp(16)),
        Format::Indexed1 => Some(Palette::new(&largest, 2)?),
        Format::Indexed2 => Some(Palette::new(&largest, 4)?),
        Format::Indexed4 => Some(Palette::new(&largest, 16)?),
        Format::Indexed8 => Some(Palette::new(&largest, 256)?),
        _ => None,
    };
    let bytes =
        levels.iter().map(|level| encoded(level, format.code(), palette.as_ref(), (wish.dither, numbers)));
    let bytes = bytes.collect();
    Ok(texture([*width, *height], palette.map_or(vec![], |palette| palette.colors), bytes))
}

/// A level of a mip map.
struct Level<T> {
    size: [u32; 2],
    texels: Vec<T>,
}

/// All levels of a texture.
fn chain<F: TexelFormat>(
    format: F,
    texels: &[F::Texel],
    [width, height]: [u32; 2],
) -> Result<Vec<Level<F::Texel>>, TextureError> {
    let mut all = texels.to_vec();
    if let Some(&first) = texels.first() {
        all.resize(mipmap::texel_count(width, height), first);
    }
    mipmap::build(format, &mut all, width, height)?;
    let mut rest = &all[..];
    let levels = (0..mipmap::level_count(width, height)).map(|level| {
        let size = [width, height].map(|side| (side >> level).max(1));
        let (texels, below) = rest.split_at((size[0] * size[1]) as usize);
        rest = below;
        Level { size, texels: texels.to_vec() }
    });
    Ok(levels.collect())
}

/// The levels from the first on whose sides are within a limit: all, or that one.
fn kept<T>(mut levels: Vec<Level<T>>, mips: bool, most: Option<u32>) -> Vec<Level<T>> {
    let fits = |level: &Level<T>| most.is_none_or(|most| level.size.into_iter().max() <= Some(most));
    let first = levels.iter().position(fits).unwrap_or(levels.len() - 1);
    levels.drain(..first);
    levels.truncate(if mips { usize::MAX } else { 1 });
    levels
}

/// The bytes of a level. Numbers are those of the red channel, and not dithered.
fn encoded(
    level: &Level<[u8; 4]>,
    code: TexelCode,
    palette: Option<&Palette>,
    (dither, numbers): (Dither, bool),
) -> Vec<u8> {
    let width = level.size[0] as usize;
    let threshold =
        |column: usize, row: usize| dither.threshold([column, row].map(|k| i32::try_from(k).unwrap_or(0)));
    // A level of the channel, of which the fraction is compared with the threshold.
    let channel = |byte: u8, greatest: u32, threshold: u32| (u32::from(byte) * greatest + threshold) / 255;
    let row = |(row, texels): (usize, &[[u8; 4]])| -> Vec<u8> {
        let each = || texels.iter().enumerate().map(|(column, &texel)| (texel, threshold(column, row)));
        let index = |(texel, t)| palette.map_or(0, |palette| palette.index(texel, t));
        // Indices of so many bits from the highest bits of a byte on.
        let digits = |bits: u8| -> Vec<u8> {
            let indices = each().map(index).collect::<Vec<_>>();
            let byte = |few: &[u8]| (1..).zip(few).fold(0, |byte, (k, index)| byte | index << (8 - k * bits));
            indices.chunks(usize::from(8 / bits)).map(byte).collect()
        };
        let word565 = |([r, g, b, _], t): ([u8; 4], u32)| {
            half(channel(r, 31, t) << 11 | channel(g, 63, t) << 5 | channel(b, 31, t))
        };
        match code {
            TexelCode::Rgb565 => each().flat_map(word565).collect(),
            TexelCode::Rgb565Pairs => {
                let own = |texel| Rgb565Pairs.encode(Rgb565.decode(texel));
                let mut pairs: Vec<u32> =
                    each().map(word565).map(|bytes| own(u16::from_le_bytes(bytes))).collect();
                Rgb565Pairs::link(&mut pairs, level.size[0], 1);
                pairs.into_iter().flat_map(u32::to_le_bytes).collect()
            }
            TexelCode::Rgb565Alpha => each()
                .map(|(texel, t)| {
                    // Of a dithered one the levels of its colour.
                    let own =
                        |[low, high]: [u8; 2]| Rgb565.decode(u16::from_le_bytes([low, high])).to_bytes();
                    let [r, g, b, _] = if dither == Dither::None { texel } else { own(word565((texel, t))) };
                    Rgba565::new(Rgba8::new(r, g, b, texel[3])).to_bits()
                })
                .flat_map(u32::to_le_bytes)
                .collect(),
            TexelCode::Rgb565Be => each().map(word565).flat_map(|[low, high]| [high, low]).collect(),
            TexelCode::Rgb332 => each()
                .map(|([r, g, b, _], t)| {
                    half(channel(r, 7, t) << 5 | channel(g, 7, t) << 2 | channel(b, 3, t))[0]
                })
                .collect(),
            TexelCode::Rgba4444 => each()
                .flat_map(|([r, g, b, a], t)| {
                    let [r, g, b] = [r, g, b].map(|c| channel(c, 15, t));
                    half(r << 12 | g << 8 | b << 4 | channel(a, 15, 127))
                })
                .collect(),
            TexelCode::L8 if numbers => texels.iter().map(|texel| texel[0]).collect(),
            TexelCode::L8 => texels.iter().map(|&[r, g, b, a]| Grey8.pixel(Rgba8::new(r, g, b, a))).collect(),
            TexelCode::Rgb8 => texels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect(),
            TexelCode::Rgba8888 | TexelCode::L16 => texels.as_flattened().to_vec(),
            TexelCode::Indexed8 => each().map(index).collect(),
            TexelCode::Indexed4 => digits(4),
            TexelCode::Indexed2 => digits(2),
            TexelCode::Indexed1 => digits(1),
        }
    };
    level.texels.chunks(width).enumerate().flat_map(row).collect()
}

/// The two bytes of a texel, the low one first.
fn half(texel: u32) -> [u8; 2] {
    let [low, high, ..] = texel.to_le_bytes();
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti::texture::format::Rgba4444;

    fn level(texels: Vec<[u8; 4]>, width: u32) -> Level<[u8; 4]> {
        let height = u32::try_from(texels.len()).expect("few") / width;
        Level { size: [width, height], texels }
    }

    /// Every byte, against the library's nearest texel.
    #[test]
    fn texels_are_the_nearest() {
        let texels: Vec<_> = (0..=255).map(|c: u8| [c, c / 2 + 60, 255 - c, c]).collect();
        let of = |code| encoded(&level(texels.clone(), 16), code, None, (Dither::None, false));
        let halves =
            |bytes: Vec<u8>| bytes.as_chunks().0.iter().map(|&b| u16::from_le_bytes(b)).collect::<Vec<_>>();
        let nearest = texels.iter().map(|&[r, g, b, a]| Rgba8::new(r, g, b, a));
        assert_eq!(
            halves(of(TexelCode::Rgb565)),
            nearest.clone().map(|c| Rgb565.encode(c)).collect::<Vec<_>>()
        );
        assert_eq!(halves(of(TexelCode::Rgba4444)), nearest.map(|c| Rgba4444.encode(c)).collect::<Vec<_>>());
        assert_eq!(of(TexelCode::Rgba8888), texels.as_flattened());
        assert_eq!(
            of(TexelCode::Rgb8),
            texels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect::<Vec<_>>()
        );
        // In the order in which they are sent, and the levels by their steps in reals.
        let mut swapped = of(TexelCode::Rgb565);
        swapped.as_chunks_mut::<2>().0.iter_mut().for_each(|bytes| bytes.reverse());
        assert_eq!(of(TexelCode::Rgb565Be), swapped);
        let bytes = of(TexelCode::Rgb332);
        assert_eq!(bytes.len(), texels.len());
        for (byte, [r, g, b, _]) in bytes.into_iter().zip(texels) {
            for (level, channel, greatest) in
                [(byte >> 5, r, 7.0), (byte >> 2 & 7, g, 7.0), (byte & 3, b, 3.0)]
            {
                let off = f64::from(level) * 255.0 / greatest - f64::from(channel);
                assert!(off.abs() <= 127.5 / greatest, "{level} for {channel}");
            }
        }
    }

    /// A grey between two levels, whose mean is kept by the pattern.
    #[test]
    fn dithered_texels_have_the_mean_of_the_colour() {
        let grey = level(vec![[100; 4]; 32 * 32], 32);
        for dither in [Dither::Bayer, Dither::BlueNoise] {
            let bytes = encoded(&grey, TexelCode::Rgb565, None, (dither, false));
            let reds = bytes.as_chunks().0.iter().map(|&b| f64::from(u16::from_le_bytes(b) >> 11));
            let mean = reds.sum::<f64>() / 1024.0;
            assert!((mean - 100.0 * 31.0 / 255.0).abs() < 0.01, "{mean}");
        }
    }

    /// The same of a few greys, which are all there is in their bits.
    #[test]
    fn dithered_greys_have_the_mean_of_the_luminance() {
        // 77 · 90 + 150 · 120 + 29 · 30 = 25800, and 256 of it is 100.8.
        let color = level(vec![[90, 120, 30, 255]; 32 * 32], 32);
        for (bits, code) in [(1, TexelCode::Indexed1), (2, TexelCode::Indexed2), (4, TexelCode::Indexed4)] {
            let greatest = (1_u8 << bits) - 1;
            let ramp = Palette::ramp(greatest + 1);
            for (k, grey) in ramp.colors.iter().enumerate() {
                let right = f64::from(u8::try_from(k).expect("few")) * 255.0 / f64::from(greatest);
                assert!(grey[..3].iter().all(|&c| f64::from(c) == right) && grey[3] == 255, "{grey:?}");
            }
            for dither in [Dither::Bayer, Dither::BlueNoise] {
                let bytes = encoded(&color, code, Some(&ramp), (dither, false));
                let levels =
                    bytes.iter().flat_map(|byte| (0..8 / bits).map(move |k| byte >> (k * bits) & greatest));
                let mean = levels.map(f64::from).sum::<f64>() / 1024.0;
                let right = 101.0 * f64::from(greatest) / 255.0;
                assert!((mean - right).abs() < 0.01, "{bits}: {mean} for {right}");
            }
        }
    }

    /// Fields of words, by hand: those of a texel, and of the next in its row.
    #[test]
    fn pairs_have_the_next_of_their_row() {
        let colors = [[248, 4, 16, 255], [8, 252, 248, 255], [16, 8, 8, 255]];
        let levels = [[30, 1, 2], [1, 62, 30], [2, 2, 1_u32]];
        let bytes = encoded(&level(colors.to_vec(), 3), TexelCode::Rgb565Pairs, None, (Dither::None, false));
        let words: Vec<u32> = bytes.as_chunks().0.iter().map(|&word| u32::from_le_bytes(word)).collect();
        let pair = |own: usize, next: usize| {
            let ([r, g, b], [red, green, blue]) = (levels[own], levels[next]);
            red << 27 | g << 21 | blue << 16 | r << 11 | green << 5 | b
        };
        assert_eq!(words, [pair(0, 1), pair(1, 2), pair(2, 0)]);
    }

    /// Words with alpha, of which those that are dithered have the levels of `rgb565` where they are opaque.
    #[test]
    fn words_have_alpha() {
        let colors = vec![[200, 100, 30, 255], [200, 100, 30, 90], [7, 8, 9, 0]];
        let words = |dither| -> Vec<Rgba565> {
            let of = |code| encoded(&level(colors.clone(), 3), code, None, (dither, false));
            let alpha = of(TexelCode::Rgb565Alpha);
            let words: Vec<u32> = alpha.as_chunks().0.iter().map(|&word| u32::from_le_bytes(word)).collect();
            let opaque = u16::from_le_bytes(*of(TexelCode::Rgb565).first_chunk().expect("a texel"));
            assert_eq!(words[0], Rgba565::new(Rgb565.decode(opaque)).to_bits());
            words.into_iter().map(Rgba565::from_bits).collect()
        };
        let own = |[r, g, b, a]: [u8; 4]| Rgba565::new(Rgba8::new(r, g, b, a));
        assert_eq!(words(Dither::None), [own(colors[0]), own(colors[1]), own(colors[2])]);
        let [_, half, none] = words(Dither::Bayer)[..] else { panic!("three") };
        assert_eq!(none, own(colors[2]));
        let [r, g, b, a] = half.to_rgba8().to_bytes();
        assert!(a.abs_diff(90) < 5 && r.abs_diff(200) < 30 && g.abs_diff(100) < 20 && b.abs_diff(30) < 30);
    }

    #[test]
    fn indices_fill_bytes_row_by_row() {
        let (red, blue) = ([255, 0, 0, 255], [0, 0, 255, 255]);
        let flag = level(vec![red, blue, red, blue, blue, red], 3);
        let image = Image { width: 3, height: 2, texels: flag.texels.clone() };
        let palette = Palette::new(&image, 16).expect("a palette");
        let bytes = encoded(&flag, TexelCode::Indexed4, Some(&palette), (Dither::None, false));
        let of = |color| palette.index(color, 127);
        let (r, b) = (of(red), of(blue));
        assert_eq!(bytes, [r << 4 | b, r << 4, b << 4 | b, r << 4]);
        // The leftmost in the highest bits, as the library reads them.
        let bytes = encoded(&flag, TexelCode::Indexed2, Some(&palette), (Dither::None, false));
        assert_eq!(bytes, [r << 6 | b << 4 | r << 2, b << 6 | b << 4 | r << 2]);
        let bytes = encoded(&flag, TexelCode::Indexed1, Some(&palette), (Dither::None, false));
        assert_eq!(bytes, [r << 7 | b << 6 | r << 5, b << 7 | b << 6 | r << 5]);
    }

    #[test]
    fn levels_are_halved_until_they_fit() {
        let sizes = |mips, most| {
            let levels = chain(Rgba8888, &[[9; 4]; 20 * 6], [20, 6]).expect("levels");
            kept(levels, mips, most).iter().map(|level| level.size).collect::<Vec<_>>()
        };
        assert_eq!(sizes(false, None), [[20, 6]]);
        assert_eq!(sizes(false, Some(10)), [[10, 3]]);
        assert_eq!(sizes(true, Some(9)), [[5, 1], [2, 1], [1, 1]]);
        assert_eq!(sizes(false, Some(1)), [[1, 1]]);
    }
}
