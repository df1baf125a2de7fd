//! Filters by which texel a pixel has, not by means: at the price of the nearest texel.

use alberti_math::glam::Vec2;
use alberti_math::lanes::Lanes;
use alberti_raster::{FragmentColor, FragmentStage, Fragments, Gradient, NoDerivatives, PerTriangle};
use alberti_texture::{Bilinear, Leveled, NearestLevel, Sampler, Size, TexelFormat, Trilinear, Wrap};

/// A texture's colours as texels that are stored, one for each pixel, of those that [`Bilinear`] would mix.
///
/// The place of the pixel decides which, so that neighbours have them as often as their shares say. The eye does the
/// mixing, as with other dithers. Of [`Trilinear`] each row is in one of the levels, by its place among four.
///
/// ```
/// use alberti::shaders::TexelDither;
/// use alberti::texture::{Bilinear, Repeat, Texture, format::Rgb565};
///
/// let stripes = Texture::new(Rgb565, &[0x0000, 0xffff], 2, 1)?;
/// let stage = TexelDither(stripes.sampler(Bilinear, Repeat));
/// # Ok::<(), alberti::texture::TextureError>(())
/// ```
///
/// Pixels have four thresholds along each axis, in a square of two by two no two alike. A pixel has the second texel
/// where its share and the threshold add up to one:
///
/// ```text
///            u     v            u     v
/// even row  1/8   3/8          5/8   1/8
/// odd row   3/8   7/8          7/8   5/8
/// ```
///
/// A row has the second level by a threshold of 1/8, 3/8, 7/8 or 5/8, in turns from the top.
///
/// # Precision
/// A pixel's colour is that of a texel. Means of pixels that have the same coordinates are off those of the filter by
/// at most so much of the difference between its texels:
///
/// | pixels | filter | any texels | that differ along u alone | along v alone | by level alone |
/// |---|---|---|---|---|---|
/// | 2 x 2 | [`Bilinear`], [`NearestLevel`] | 11/32 = 0.344 | 1/8 | 1/8 | |
/// | 4 x 4 | [`Trilinear`] | 69/128 = 0.539 | 5/16 | 3/8 | 1/8 |
///
/// Shares are rounded to 256ths, of levels to 32nds, which adds up to 0.003, and 1/64 by level alone. The mean is
/// constant between thresholds, and the filter's is linear in each share. So the worst is at a corner of the box
/// between thresholds, and the bounds are the largest of these. Rows are why 0.539 is more than 0.344: a level that
/// has one of the four rows has two of its four places along u and v. Turns in which the levels alternate row by row
/// would be off by 0.781, as both rows of a level have the same places then.
///
/// # Cost
/// In fixed point on a Cortex-M4F 22 instructions more than [`Nearest`](alberti_texture::Nearest) without perspective.
/// A second level adds less than one, as each row has one of both.
/// [`Stored`](super::Stored) takes 46 more of [`Rgb565Pairs`](alberti_texture::format::Rgb565Pairs) and 60 of others.
/// Texels of any format, as none are mixed: they need not be [packed](alberti_texture::Packed).
#[derive(Clone, Copy, Debug)]
pub struct TexelDither<S>(
    /// The texture with its filter and wrap mode.
    pub S,
);

impl<F: TexelFormat<Texel: FragmentColor>, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for TexelDither<Sampler<'_, F, Bilinear, U, V, Z>>
{
    type Color = F::Texel;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying, mask, place, .. } = *fragments;
        let [u, v] = thresholds(lanes, place);
        let texels = self.0.either_lanes(lanes, varying, [u, v], word(self.0.texture().format()));
        (texels, mask)
    }
}

impl<F: TexelFormat<Texel: FragmentColor>, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for TexelDither<Leveled<'_, F, NearestLevel<Bilinear>, U, V, Z>>
{
    type Color = F::Texel;
    of_levels!();

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        TexelDither(self.0.level()).shade(fragments)
    }
}

impl<F: TexelFormat<Texel: FragmentColor>, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for TexelDither<Leveled<'_, F, Trilinear, U, V, Z>>
{
    type Color = F::Texel;
    of_levels!();
    const BY_ROWS: bool = true;

    #[inline(always)]
    fn in_row(&self, row: i32) -> Self {
        Self(self.0.either(match row & 3 {
            0 => 4,
            1 => 12,
            2 => 28,
            _ => 20,
        }))
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        TexelDither(self.0.level()).shade(fragments)
    }
}

/// The word of a texel, or of none.
fn word<F: TexelFormat<Texel: FragmentColor>>(format: F) -> impl Fn(Option<F::Texel>) -> u32 {
    move |texel| texel.map_or(0, |texel| format.native(texel).to_word())
}

/// The thresholds of pixels along u and along v, in 256ths.
#[inline(always)]
fn thresholds<L: Lanes>(lanes: L, [column, row]: [i32; 2]) -> [L::U32; 2] {
    let [column, row] = [column.cast_unsigned(), row.cast_unsigned()];
    let odd = row & 1;
    let [row_u, row_v] = [32 + 64 * odd, 96 + 128 * odd];
    let at = |column: u32| {
        let odd = column & 1;
        [row_u + 128 * odd, row_v - 64 * odd]
    };
    if const { L::COUNT == 1 } {
        return at(column).map(|threshold| lanes.word(threshold));
    }
    let mut k = column;
    let each = lanes.each(|_| {
        k = k.wrapping_add(1);
        at(k.wrapping_sub(1))
    });
    [0, 1].map(|axis| {
        lanes.load_words(&lanes.each(|k| each.as_ref().get(k).map_or(0, |at: &[u32; 2]| at[axis])))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, Mesh, Pass, Perspective, Point3, View};
    use alberti_math::Q16;
    use alberti_math::glam::Vec3;
    use alberti_math::lanes::{One, OneFixed};
    use alberti_raster::color::Grey8;
    use alberti_raster::{Affine, Exact, FixedPoint, FragmentStage, Interpolation, NoDepth, Spans16, Target};
    use alberti_texture::format::{L8, Rgba8888};
    use alberti_texture::{Border, Clamp, Mipmap, Mirror, Repeat, Texture};
    use std::vec::Vec;

    fn at<L: Lanes<Mask = bool>>(lanes: L, varying: [L::Number; 2], place: [i32; 2]) -> Fragments<L, Vec2> {
        let none = [lanes.splat(0.0); 2];
        Fragments { lanes, varying, gradient: Gradient { dx: none, dy: none }, mask: true, place }
    }

    /// The word of a pixel at a place in its row.
    fn shaded(stage: impl FragmentStage<Vec2>, uv: [f32; 2], place: [i32; 2]) -> u32 {
        stage.in_row(place[1]).shade(&at(One, uv, place)).0.0
    }

    fn square(side: i32, [column, row]: [i32; 2]) -> impl Iterator<Item = [i32; 2]> {
        (0..side * side).map(move |k| [column + k % side, row + k / side])
    }

    /// Texels of 0 and 255 in turns, by the filter in f64.
    #[test]
    fn the_mean_of_a_square_is_near_the_filters() {
        let texels: Vec<[u8; 4]> = [[0; 4], [255; 4], [255; 4], [0; 4]].to_vec();
        let texture = Texture::new(Rgba8888, &texels, 2, 2).expect("2 x 2");
        let stage = TexelDither(texture.sampler(Bilinear, Repeat));
        let (mut worst, mut along_an_axis) = (0.0_f64, 0.0_f64);
        for (i, j) in (0..128).flat_map(|i| (0..128).map(move |j| (i, j))) {
            // From one centre to the next.
            let shares = [i, j].map(|k| f64::from(k) / 128.0);
            let uv = [i, j].map(|k: u8| 0.25 + f32::from(k) / 256.0);
            for corner in [[0, 0], [7, 4], [-3, 5], [2, 9]] {
                let mean: f64 = square(2, corner)
                    .map(|place| f64::from(stage.shade(&at(One, uv, place)).0.0 & 255) / (4.0 * 255.0))
                    .sum();
                // From below the rows are 255, 0 and 0, 255.
                let [s, t] = shares;
                let right = (1.0 - s) * (1.0 - t) + s * t;
                worst = worst.max((mean - right).abs());
                if j == 0 {
                    along_an_axis = along_an_axis.max((mean - right).abs());
                }
            }
        }
        assert!((0.2..=11.0 / 32.0).contains(&worst), "{worst}");
        assert!((0.1..=1.0 / 8.0).contains(&along_an_axis), "{along_an_axis}");
    }

    /// The texel of each pixel, by its definition in f64, in all wraps and for sides of all kinds.
    #[test]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers")]
    fn a_pixel_has_one_of_four_texels_by_its_place() {
        // An index by an index's definition, or none.
        type Index = fn(i64, i64) -> Option<i64>;
        fn check<W: Wrap>(wrap: W, index: Index) {
            // Eighths.
            const THRESHOLDS: [[[f64; 2]; 2]; 2] = [[[1.0, 3.0], [5.0, 1.0]], [[3.0, 7.0], [7.0, 5.0]]];
            for [width, height] in [[8, 4], [5, 7], [1, 2]] {
                let texels: Vec<[u8; 4]> = (0..width * height).map(|k| [k as u8 + 1, 0, 0, 0]).collect();
                let texture = Texture::new(Rgba8888, &texels, width, height).expect("sides");
                let stage = TexelDither(texture.sampler(Bilinear, wrap));
                for k in 0..4000_i32 {
                    // 256ths of a texel and a part of one, half for sides of which that is a float: shares are
                    // rounded to 256ths, halves up.
                    let part = if width == 8 { 0.5 } else { 0.25 };
                    let way = [k * 37 % 3001, k * 53 % 2003].map(|way| f64::from(way - 1000) + part);
                    let sides = [f64::from(width), f64::from(height)];
                    let uv = [0, 1].map(|axis| ((way[axis] / 256.0 + 0.5) / sides[axis]) as f32);
                    let place = [k % 9 - 4, k % 7];
                    let thresholds =
                        THRESHOLDS[place[1].rem_euclid(2) as usize][place[0].rem_euclid(2) as usize];
                    let cell = [0, 1].map(|axis| {
                        ((way[axis] + 0.5).floor() / 256.0 + thresholds[axis] / 8.0).floor() as i64
                    });
                    let found = stage.shade(&at(One, uv, place)).0.0;
                    let right = match (index(cell[0], width.into()), index(cell[1], height.into())) {
                        (Some(column), Some(row)) => {
                            ((i64::from(height) - 1 - row) * i64::from(width) + column + 1) as u32
                        }
                        _ => 0,
                    };
                    assert_eq!(found, right, "{wrap:?}, {width} x {height}, {uv:?}, {place:?}");
                    if width == 8 {
                        let fixed = uv.map(Q16::from_f32);
                        let found = stage.shade(&at(OneFixed, fixed, place)).0.0;
                        assert_eq!(found, right, "{wrap:?} in fixed point, {uv:?}, {place:?}");
                    }
                }
            }
        }
        check(Repeat, |i, size| Some(i.rem_euclid(size)));
        check(Clamp, |i, size| Some(i.clamp(0, size - 1)));
        check(Mirror, |i, size| Some(i.rem_euclid(2 * size)).map(|i| i.min(2 * size - 1 - i)));
        check(Border(alberti_math::Rgba8::from_bits(0)), |i, size| (0..size).contains(&i).then_some(i));
    }

    /// Of two levels any four rows have each as its share says.
    #[test]
    fn levels_are_as_frequent_as_their_shares() {
        const SIDE: u32 = 8;
        let mut texels = std::vec![0_u8; alberti_texture::mipmap::texel_count(SIDE, SIDE)];
        texels[(SIDE * SIDE) as usize..].fill(1);
        let map = Mipmap::new(L8, &texels, SIDE, SIDE).expect("levels").sampler(Trilinear, Repeat);
        let (mut seen, mut worst) = (0, 0.0_f64);
        for k in 0..=64_u8 {
            let share = f64::from(k) / 64.0;
            #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
            let step = (share.exp2() / f64::from(SIDE)) as f32;
            let gradient = Gradient { dx: [step, 0.0], dy: [0.0, step] };
            let settled = TexelDither(map.leveled()).settled(One, &gradient);
            for corner in [[0, 0], [4, 8], [1, 2], [-5, 3]] {
                let far: u32 = square(4, corner).map(|place| shaded(settled, [0.3, 0.7], place)).sum();
                worst = worst.max((f64::from(far) / 16.0 - share).abs());
                seen += far;
            }
        }
        assert!(worst <= 0.125 + 1.0 / 64.0 && worst > 0.1 && seen > 1000, "{worst}, {seen}");
    }

    /// Every kernel asks for a row's stage: large triangles and small ones, one sample at a time and several.
    #[test]
    fn rows_are_drawn_in_one_of_two_levels() {
        fn check(interpolation: impl Interpolation, cells: u16, share: f32) {
            const SIDE: u32 = 64;
            let mut texels = std::vec![0_u8; alberti_texture::mipmap::texel_count(SIDE, SIDE)];
            texels[(SIDE * SIDE) as usize..].fill(1);
            let map = Mipmap::new(L8, &texels, SIDE, SIDE).expect("levels").sampler(Trilinear, Repeat);
            // A square that fills 40 x 40 pixels, of which each is so many texels wide.
            let along = share.exp2() * 40.0 / 64.0;
            let side = cells + 1;
            let vertices: Vec<[f32; 2]> = (0..side * side)
                .map(|k| [k % side, k / side].map(|k| f32::from(k) / f32::from(cells)))
                .collect();
            let triangles: Vec<[u16; 3]> = (0..cells * cells)
                .map(|k| k / cells * side + k % cells)
                .flat_map(|k| [[k, k + 1, k + side + 1], [k, k + side + 1, k + side]])
                .collect();
            let mesh = Mesh::new(&vertices, &triangles, |&[x, y]: &[f32; 2]| {
                (Point3::new(Vec3::new(2.0 * x - 1.0, 2.0 * y - 1.0, 1.0)), Vec2::new(x, y) * along)
            });
            let lens = Perspective::new(core::f32::consts::FRAC_PI_2, 1.0, 0.5, 2.0).expect("a lens");
            let view = View::new(Frame::IDENTITY, lens);
            let (mut color, mut depth) = ([9_u8; 1600], [(); 1600]);
            let mut target = Target::new(Grey8, NoDepth, 40, 40, &mut color, &mut depth).expect("a frame");
            Pass::new(&view, &mesh, TexelDither(map.leveled()))
                .interpolation(interpolation)
                .draw(&mut target);
            for (row, pixels) in color.chunks(40).enumerate() {
                let far = share + [1.0, 3.0, 7.0, 5.0][row % 4] / 8.0 >= 1.0;
                let right = [u8::from(far); 40];
                assert_eq!(pixels, right, "row {row}, {cells} cells, {interpolation:?}");
            }
        }
        for cells in [1, 4, 16] {
            for share in [0.05, 0.2, 0.45, 0.7, 0.95] {
                check(Exact, cells, share);
                check(Spans16, cells, share);
                check(FixedPoint(Affine), cells, share);
                check(FixedPoint(Spans16), cells, share);
            }
        }
    }
}
