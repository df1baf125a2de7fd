//! A pavement of stones: its maps, and the colours that filters ought to show of them, in `f64`.

use alberti::glam::DVec2;
use alberti::texture::format::{Normals, Rgba8888, Scalars, TexelFormat};
use alberti::texture::mipmap;

/// The side of each map, in texels.
pub const SIDE: u32 = 512;

/// The maps, each but the heights with all its levels.
#[derive(Clone, Debug)]
pub struct Stones {
    /// A hue that tells where one is.
    pub color: Vec<[u8; 4]>,
    /// Normals in the tangent frame, [`Unorm`](alberti::texture::surface::NormalEncoding::Unorm).
    pub normal: Vec<[u8; 4]>,
    /// Numbers: the heights, and two ramps.
    pub other: Vec<[u8; 4]>,
    /// Heights, level 0 alone.
    pub height: Vec<u8>,
}

impl Stones {
    /// Stones with joints.
    ///
    /// # Panics
    /// Never: the buffers are as long as they must be.
    #[must_use]
    pub fn new() -> Self {
        let height = |x: u32, y: u32| {
            let [x, y] = [x % 64, y % 64].map(|c| (f64::from(c) - 31.5) / 32.0);
            (1.0 - x.powi(8).max(y.powi(8))).max(0.0)
        };
        let (mut color, mut normal, mut other, mut heights) = (vec![], vec![], vec![], vec![]);
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let h = height(x, y);
            let stone = (x / 64 * 5 + y / 64 * 11) % 8;
            let level = 60 + 20 * stone;
            color.push([level * h as u32 + 40, (x ^ y) % 256, 255 - level, 255].map(|c| c.min(255) as u8));
            let slope =
                [height(x + 1, y) - h, height(x, (y + 1) % SIDE) - h].map(|d| (-4.0 * d).clamp(-1.0, 1.0));
            let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
            let [r, g, b] =
                [slope[0], -slope[1], 1.0].map(|c| ((c / length * 0.5 + 0.5) * 255.0).round() as u8);
            normal.push([r, g, b, 255]);
            other.push([(255.0 * h) as u8, (x % 256) as u8, (y % 256) as u8, 255]);
            heights.push((255.0 * h).round() as u8);
        }
        Self {
            color: levels(Rgba8888, color),
            normal: levels(Normals(Rgba8888), normal),
            other: levels(Scalars(Rgba8888), other),
            height: heights,
        }
    }
}

impl Default for Stones {
    fn default() -> Self {
        Self::new()
    }
}

/// A map with its levels.
fn levels<F: TexelFormat<Texel = [u8; 4]>>(format: F, mut texels: Vec<[u8; 4]>) -> Vec<[u8; 4]> {
    texels.resize(mipmap::texel_count(SIDE, SIDE), [0; 4]);
    mipmap::build(format, &mut texels, SIDE, SIDE).expect("levels");
    texels
}

/// A texel of a level, repeated.
fn texel(texels: &[[u8; 4]], level: u32, [x, y]: [i64; 2]) -> [f64; 3] {
    let begin: u32 = (0..level).map(|k| (SIDE >> k) * (SIDE >> k)).sum();
    let side = i64::from(SIDE >> level);
    // Rows run from the top, v from the bottom.
    let [x, y] = [x.rem_euclid(side), (side - 1 - y).rem_euclid(side)];
    let [r, g, b, _] = texels[begin as usize + (y * side + x) as usize];
    [r, g, b].map(f64::from)
}

/// The texel of level 0 at a place.
#[must_use]
pub fn nearest(texels: &[[u8; 4]], uv: DVec2) -> [f64; 3] {
    let at = uv * f64::from(SIDE);
    texel(texels, 0, [at.x.floor() as i64, at.y.floor() as i64])
}

/// The mean of the four texels of a level about a place.
#[must_use]
pub fn bilinear(texels: &[[u8; 4]], level: u32, uv: DVec2) -> [f64; 3] {
    let at = uv * f64::from(SIDE >> level) - 0.5;
    let (floor, part) = (at.floor(), at - at.floor());
    let read = |dx, dy| texel(texels, level, [floor.x as i64 + dx, floor.y as i64 + dy]);
    let [a, b, c, d] = [read(0, 0), read(1, 0), read(0, 1), read(1, 1)];
    std::array::from_fn(|k| {
        let (low, high) = (a[k] + (b[k] - a[k]) * part.x, c[k] + (d[k] - c[k]) * part.x);
        low + (high - low) * part.y
    })
}

/// The mean of two levels at a place, for a level of detail of λ.
#[must_use]
pub fn trilinear(texels: &[[u8; 4]], uv: DVec2, lambda: f64) -> [f64; 3] {
    let lambda = lambda.clamp(0.0, f64::from(SIDE.ilog2()));
    let near = lambda.floor();
    let [a, b] = [near as u32, (near as u32 + 1).min(SIDE.ilog2())].map(|level| bilinear(texels, level, uv));
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * (lambda - near))
}
