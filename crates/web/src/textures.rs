//! The textures of the stations, all of them computed, once each.

use crate::numbers::{byte, float};
use alberti::glam::{Vec2, Vec3};
use alberti::texture::format::{Normals, Rgba8888, TexelFormat};
use alberti::texture::{Mipmap, TextureError, mipmap};
use alloc::vec;
use alloc::vec::Vec;

/// A texel's bytes.
pub(crate) type Texel = [u8; 4];

/// The side of the board, in texels.
pub(crate) const BOARD: u32 = 128;
/// The side of the wall, in texels.
pub(crate) const WALL: u32 = 128;
/// The size of the slide, in texels.
pub(crate) const SLIDE: [u32; 2] = [96, 64];

/// A mip map's texels, level after level, and the size of the first. Whatever their means are of, they are read as
/// colours, so that one filter in the program samples all.
#[derive(Debug)]
pub(crate) struct Levels {
    texels: Vec<Texel>,
    size: [u32; 2],
}

impl Levels {
    /// The mip map of a texture, its first row the top one.
    pub(crate) fn build(
        format: impl TexelFormat<Texel = Texel>,
        largest: &[Texel],
        size: [u32; 2],
    ) -> Result<Self, TextureError> {
        let [width, height] = size;
        let mut texels = vec![[0; 4]; mipmap::texel_count(width, height)];
        if let Some(level) = texels.get_mut(..largest.len()) {
            level.copy_from_slice(largest);
        }
        mipmap::build(format, &mut texels, width, height)?;
        Ok(Self { texels, size })
    }

    /// The mip map.
    pub(crate) fn mipmap(&self) -> Result<Mipmap<'_, Rgba8888>, TextureError> {
        Mipmap::new(Rgba8888, &self.texels, self.size[0], self.size[1])
    }

    /// The colours of each level replaced by one.
    fn painted(mut self, colors: &[Texel]) -> Self {
        let [mut width, mut height] = self.size;
        let mut rest = &mut self.texels[..];
        for color in colors.iter().chain(core::iter::repeat(&colors[colors.len() - 1])) {
            let area = (width * height) as usize;
            let Some((level, smaller)) = core::mem::take(&mut rest).split_at_mut_checked(area) else { break };
            for texel in level {
                // The pattern stays visible.
                let light = u16::from(texel[0]) / 2 + 127;
                for (channel, &of) in texel.iter_mut().zip(color).take(3) {
                    *channel = u8::try_from(u16::from(of) * light / 255).unwrap_or(u8::MAX);
                }
            }
            if smaller.is_empty() {
                break;
            }
            rest = smaller;
            (width, height) = ((width / 2).max(1), (height / 2).max(1));
        }
        self
    }
}

/// The maps of the brick wall.
#[derive(Debug)]
pub(crate) struct Wall {
    pub(crate) colors: Levels,
    pub(crate) normals: Levels,
    /// Heights from 0 to 255 in each channel.
    pub(crate) heights: Vec<Texel>,
}

/// The textures that have been asked for.
#[derive(Debug)]
pub(crate) struct Textures {
    board: Option<Levels>,
    levels: Option<Levels>,
    wall: Option<Wall>,
    slide: Option<Vec<Texel>>,
}

impl Textures {
    pub(crate) const fn new() -> Self {
        Self { board: None, levels: None, wall: None, slide: None }
    }

    /// A board of 8 x 8 fields, with a thin line in each, so that its sides can be told apart.
    pub(crate) fn board(&mut self) -> Result<&Levels, TextureError> {
        kept(&mut self.board, || Levels::build(Rgba8888, &board(), [BOARD; 2]))
    }

    /// The same board, each level of its mip map in a colour of its own.
    pub(crate) fn levels(&mut self) -> Result<&Levels, TextureError> {
        const COLORS: [Texel; 8] = [
            [255, 255, 255, 255],
            [235, 90, 70, 255],
            [245, 165, 60, 255],
            [235, 220, 80, 255],
            [110, 200, 100, 255],
            [80, 190, 210, 255],
            [90, 120, 235, 255],
            [190, 100, 220, 255],
        ];
        kept(&mut self.levels, || Ok(Levels::build(Rgba8888, &board(), [BOARD; 2])?.painted(&COLORS)))
    }

    /// The brick wall.
    pub(crate) fn wall(&mut self) -> Result<&Wall, TextureError> {
        kept(&mut self.wall, || {
            let [colors, normals, heights] = wall();
            Ok(Wall {
                colors: Levels::build(Rgba8888, &colors, [WALL; 2])?,
                normals: Levels::build(Normals(Rgba8888), &normals, [WALL; 2])?,
                heights,
            })
        })
    }

    /// The slide.
    pub(crate) fn slide(&mut self) -> &[Texel] {
        self.slide.get_or_insert_with(slide)
    }
}

/// The value in a place, which is made if it is not there.
fn kept<T>(
    place: &mut Option<T>,
    make: impl FnOnce() -> Result<T, TextureError>,
) -> Result<&T, TextureError> {
    let value = match place.take() {
        Some(value) => value,
        None => make()?,
    };
    Ok(place.insert(value))
}

/// Texels of a square, row by row.
fn square(side: u32, texel: impl Fn(i32, i32) -> Vec3) -> Vec<Texel> {
    let side = side.cast_signed();
    let at = |k| {
        let [r, g, b] = texel(k % side, k / side).to_array().map(byte);
        [r, g, b, 255]
    };
    (0..side * side).map(at).collect()
}

fn board() -> Vec<Texel> {
    square(BOARD, |x, y| {
        let dark = (x / 16 + y / 16) % 2 == 0;
        let (i, j) = (x % 16, y % 16);
        match (dark, (6..10).contains(&i) && (6..10).contains(&j)) {
            (true, false) => Vec3::new(52.0, 64.0, 88.0),
            (true, true) => Vec3::new(120.0, 140.0, 175.0),
            (false, false) => Vec3::new(232.0, 228.0, 214.0),
            (false, true) => Vec3::new(196.0, 120.0, 84.0),
        }
    })
}

/// The height of a texel, from 0 in the mortar to 1 on a brick, and the brick's number.
fn brick(x: i32, y: i32) -> (f32, i32) {
    let side = WALL.cast_signed();
    let (y, row) = (y.rem_euclid(side) % 32, y.rem_euclid(side) / 32);
    let x = (x + 32 * (row % 2)).rem_euclid(side);
    let inside = (x % 64).min(63 - x % 64).min(y).min(31 - y);
    let rise = float((inside - 1).clamp(0, 5).unsigned_abs() as usize) / 5.0;
    (rise * (2.0 - rise), 2 * row + x / 64)
}

/// How far bricks stand out, for normals, as a share of the wall's side.
pub(crate) const RISE: f32 = 0.06;

/// Colours, normals and heights.
fn wall() -> [Vec<Texel>; 3] {
    const BRICKS: [Vec3; 3] =
        [Vec3::new(170.0, 80.0, 60.0), Vec3::new(190.0, 100.0, 70.0), Vec3::new(150.0, 70.0, 62.0)];
    let color = |x, y| match brick(x, y) {
        (height, _) if height < 0.5 => Vec3::new(150.0, 145.0, 135.0),
        (_, k) => BRICKS[k.rem_euclid(3).unsigned_abs() as usize],
    };
    // v is up, and rows go down.
    let normal = |x, y| {
        let rise = |a: (f32, i32), b: (f32, i32)| (a.0 - b.0) * RISE * float(WALL as usize) / 2.0;
        let slope = Vec2::new(rise(brick(x + 1, y), brick(x - 1, y)), rise(brick(x, y - 1), brick(x, y + 1)));
        (-slope).extend(1.0).normalize() * 127.0 + 128.0
    };
    [square(WALL, color), square(WALL, normal), square(WALL, |x, y| Vec3::splat(brick(x, y).0 * 255.0))]
}

/// A test card: coloured fields, a white frame, and an arrow that points up and is longer to the right.
fn slide() -> Vec<Texel> {
    let [width, height] = SLIDE.map(u32::cast_signed);
    let texel = |x: i32, y: i32| {
        let (left, top) = (x.min(width - 1 - x), y.min(height - 1 - y));
        let (dx, dy) = (x - width / 2, y - 12);
        let head = (0..18).contains(&dy) && dx.abs() <= dy;
        let shaft = (18..38).contains(&dy) && (-5..5).contains(&dx);
        let foot = (30..38).contains(&dy) && (0..24).contains(&dx);
        if left < 2 || top < 2 || head || shaft || foot {
            return [210, 210, 200, 255];
        }
        let dark = (x / 8 + y / 8) % 2 == 0;
        let ramp = |c: i32, length: i32| u8::try_from(20 + 160 * c / length).unwrap_or(u8::MAX);
        let [r, g, b] = [ramp(x, width), ramp(height - y, height), ramp(width - x, width)];
        if dark { [r / 3, g / 3, b / 3, 255] } else { [r, g, b, 255] }
    };
    (0..height).flat_map(|y| (0..width).map(move |x| texel(x, y))).collect()
}
