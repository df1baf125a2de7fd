//! A texture's colours as they are.

use super::Map;
use alberti_math::glam::Vec2;
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Varying};
use alberti_raster::{
    Differentiation, FragmentColor, FragmentStage, Fragments, Gradient, NoDerivatives, PerPixel, PerTriangle,
};
use alberti_texture::{
    Bilinear, Filter, Leveled, MipSampler, Nearest, NearestLevel, Packed, Sampler, Size, TexelFormat,
    Trilinear, Wrap,
};

/// A map as it is: a texture, read by a [`Sampler`], or by a [`MipSampler`](alberti_texture::MipSampler) for the part
/// of it that a pixel covers.
///
/// The derivatives are those that the map asks for, a mip map for those at each pixel; [`Differentiated`] chooses
/// others. [`FragmentStage::shade_one`], which knows of no other pixel, reads level 0 of a mip map, or the level that
/// its bounds make of it.
#[derive(Clone, Copy, Debug)]
pub struct Unlit<M>(
    /// A [`Map`].
    pub M,
);

impl<M: Map> FragmentStage<Vec2> for Unlit<M> {
    type Color = Rgba8;
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying, gradient, mask, .. } = fragments;
        (self.0.read(*lanes, *varying, gradient), *mask)
    }
}

/// Another stage with the derivatives of its varying by the policy `D`, whatever it would choose itself.
///
/// ```
/// use alberti::raster::PerTriangle;
/// use alberti::shaders::{Differentiated, Unlit};
/// use alberti::texture::{Mipmap, Repeat, Trilinear, format::L8};
///
/// let board = Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2)?;
/// // One level of detail for all of a triangle, found once.
/// let stage = Differentiated::by(PerTriangle, Unlit(board.sampler(Trilinear, Repeat)));
/// # Ok::<(), alberti::texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Differentiated<D, S> {
    policy: D,
    stage: S,
}

impl<D, S> Differentiated<D, S> {
    /// `stage` with this policy.
    #[must_use]
    pub const fn by(policy: D, stage: S) -> Self {
        Self { policy, stage }
    }
}

impl<V: Varying, D: Differentiation, S: FragmentStage<V>> FragmentStage<V> for Differentiated<D, S> {
    type Color = S::Color;
    type Derivatives = D;
    const WIDE: bool = S::WIDE;

    const SETTLES: bool = S::SETTLES;

    #[inline(always)]
    fn derivatives(&self) -> D {
        self.policy
    }

    #[inline(always)]
    fn settled<L: Lanes>(&self, lanes: L, gradient: &Gradient<V::Of<L::Number>>) -> Self {
        Self { policy: self.policy, stage: self.stage.settled(lanes, gradient) }
    }

    const BY_ROWS: bool = S::BY_ROWS;

    #[inline(always)]
    fn in_row(&self, row: i32) -> Self {
        Self { policy: self.policy, stage: self.stage.in_row(row) }
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        self.stage.shade(fragments)
    }
}

/// A texture's colours as texels that are stored, for targets whose pixels are such texels, or for any of four bytes:
/// nothing is decoded nor encoded. Of [`Nearest`] the texel, in any format; of [`Bilinear`], and of mip maps of
/// [`Trilinear`], a mean that is made of [`Packed`] texels. Of a mip map whose levels are chosen once a triangle
/// ([`Leveled`]), those of its filter.
///
/// # Precision
/// Means are those of [`Sampler::packed_lanes`] and [`MipSampler::packed_grad_lanes`]: weights have 5 bits.
///
/// # Cost
/// In fixed point on small cores a third of [`Unlit`]'s, which has colours of 8 bits a channel.
#[derive(Clone, Copy, Debug)]
pub struct Stored<S>(
    /// The texture with its wrap mode.
    pub S,
);

impl<F: Packed, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2> for Stored<Sampler<'_, F, Bilinear, U, V, Z>> {
    type Color = u16;
    type Derivatives = NoDerivatives;
    const DEPTH_FIRST: bool = true;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying: [u, v], mask, .. } = *fragments;
        (self.0.packed_lanes(lanes, u, v), mask)
    }
}

impl<F: Packed, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Stored<MipSampler<'_, F, Trilinear, U, V, Z>>
{
    type Color = u16;
    type Derivatives = PerPixel;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying, gradient, mask, .. } = fragments;
        (self.0.packed_grad_lanes(*lanes, *varying, gradient), *mask)
    }
}

/// Items of a stage of a map in levels that are chosen for each triangle.
macro_rules! of_levels {
    () => {
        type Derivatives = PerTriangle;
        const SETTLES: bool = true;

        #[inline(always)]
        fn settled<L: Lanes>(&self, lanes: L, gradient: &Gradient<[L::Number; 2]>) -> Self {
            Self(self.0.settled(lanes, gradient))
        }
    };
}

impl<F: Packed, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Stored<Leveled<'_, F, Trilinear, U, V, Z>>
{
    type Color = u16;
    of_levels!();

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying, mask, .. } = *fragments;
        (self.0.packed_lanes(lanes, varying), mask)
    }
}

impl<'a, F, Fl, U, V, Z> FragmentStage<Vec2> for Stored<Leveled<'a, F, NearestLevel<Fl>, U, V, Z>>
where
    F: TexelFormat,
    Fl: Filter,
    U: Wrap,
    V: Wrap,
    Z: Size,
    Stored<Sampler<'a, F, Fl, U, V, Z::Level>>: FragmentStage<Vec2>,
{
    type Color = <Stored<Sampler<'a, F, Fl, U, V, Z::Level>> as FragmentStage<Vec2>>::Color;
    of_levels!();

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        Stored(self.0.level()).shade(fragments)
    }
}

impl<F: TexelFormat<Texel: FragmentColor>, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Stored<Sampler<'_, F, Nearest, U, V, Z>>
{
    type Color = F::Texel;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying: [u, v], mask, .. } = *fragments;
        let format = self.0.texture().format();
        let words =
            self.0.stored_lanes(lanes, u, v, |texel| texel.map_or(0, |texel| format.native(texel).to_word()));
        (words, mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::{Called, Solid, Times, Tinted};
    use crate::{Affine, Camera, D16, Exact, FixedPoint, Mesh, Pass, Spans16, Sub4, Target};
    use alberti_math::Q16;
    use alberti_math::glam::Vec3;
    use alberti_math::lanes::{One, OneFixed};
    use alberti_raster::{Gradient, Rgb565Be, Rgb565Le};
    use alberti_texture::format::{InBytes, L8, Rgb565, Rgba8888};
    use alberti_texture::{Bounded, Clamp, LodBounds, Mipmap, Mirror, NearestLevel, Repeat, Texture};
    use core::num::Wrapping;

    /// A fragment alone.
    fn of<L: Lanes<Mask = bool>>(
        lanes: L,
        varying: [L::Number; 2],
        gradient: Gradient<[L::Number; 2]>,
    ) -> Fragments<L, Vec2> {
        Fragments { lanes, varying, gradient, mask: true, place: [0; 2] }
    }

    /// A constant is [`Solid`], a map times a constant [`Tinted`], and a mip map what its sampler says, bounded or not,
    /// in place or by a call.
    #[test]
    fn all_maps_are_unlit_alike() {
        let board = Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2).expect("2 x 2, and 1 x 1");
        let factor = Rgba8::new(200, 100, 50, 9);
        let nearest = board.level(0).sampler(Nearest, Repeat);
        let trilinear = board.sampler(Trilinear, Repeat);
        let bounds = LodBounds { bias: 0.25, ..LodBounds::default() };
        let softer = board.sampler(Bounded { filter: Trilinear, bounds }, Repeat);
        let mut seen = 0;
        for (k, [u, v]) in (0..64u8).map(|k| (k, [f32::from(k) / 16.0, f32::from(k % 8) / 8.0])) {
            let uv = Vec2::new(u, v);
            assert_eq!(Unlit(factor).shade_one(uv), Solid(factor).shade_one(uv));
            assert_eq!(Unlit(nearest).shade_one(uv), Some(nearest.sample(uv)));
            let tinted = Tinted { surface: Unlit(nearest), tint: factor };
            assert_eq!(Unlit(Times { map: nearest, factor }).shade_one(uv), tinted.shade_one(uv));

            let [dx, dy] = [[f32::from(k) / 64.0, 0.0], [0.0, 0.25]];
            let gradient = Gradient { dx, dy };
            let (word, _) = Unlit(trilinear).shade(&of(One, [u, v], gradient));
            assert_eq!(Rgba8::from_bits(word.0), trilinear.sample_grad(uv, gradient));
            let (bounded, _) = Unlit(softer).shade(&of(One, [u, v], gradient));
            assert_eq!(Rgba8::from_bits(bounded.0), softer.sample_grad(uv, gradient));
            seen += u32::from(bounded != word);
            let (called, _) = Unlit(Called(softer)).shade(&of(One, [u, v], gradient));
            assert_eq!(called, bounded);
        }
        assert!(seen > 10, "{seen}");
    }

    /// Texels in fixed point, against the definition in integers: u is k / 65536, v is half a row up.
    #[test]
    fn stored_texels_are_those_of_their_cells_in_fixed_point() {
        let texels: [u16; 16] = core::array::from_fn(|i| 1000 + u16::try_from(i).expect("small"));
        let texture = Texture::new(Rgb565, &texels, 8, 2).expect("8 x 2").known::<8, 2>().expect("8 x 2");
        let v = Q16::from_f32(0.25);
        for k in (-300_000..300_000_i32).step_by(97).chain([-65_536, -1, 0, 65_535, 65_536]) {
            let at = [Q16::from_bits(k), v];
            let steady = Gradient { dx: [Q16::ZERO; 2], dy: [Q16::ZERO; 2] };
            let [repeat, mirror] = [k.rem_euclid(65_536) * 8 / 65_536, k.rem_euclid(131_072) * 8 / 65_536];
            let texel = |column: i32| 1008 + column.unsigned_abs();
            let stored = |(word, _): (Wrapping<u32>, bool)| word.0;
            let wrapped = Stored(texture.sampler(Nearest, Repeat)).shade(&of(OneFixed, at, steady));
            assert_eq!(stored(wrapped), texel(repeat), "repeat {k}");
            let folded = Stored(texture.sampler(Nearest, Mirror)).shade(&of(OneFixed, at, steady));
            assert_eq!(stored(folded), texel(mirror.min(15 - mirror)), "mirror {k}");
            let clamped = Stored(texture.sampler(Nearest, Clamp)).shade(&of(OneFixed, at, steady));
            assert_eq!(stored(clamped), texel((k.clamp(0, 65_535)) * 8 / 65_536), "clamp {k}");
        }
    }

    /// A red and a blue texel in either order of bytes, on targets of either order: in memory, what these want.
    #[test]
    fn stored_texels_have_the_order_of_their_target() {
        let bytes = [[0xf8, 0x01], [0x00, 0x1f]];
        let words = bytes.map(u16::from_ne_bytes);
        let of_bytes = Texture::new(InBytes(Rgb565Be), &bytes, 2, 1).expect("2 x 1");
        let of_words = Texture::new(Rgb565Be, &words, 2, 1).expect("2 x 1");
        for (u, [high, low]) in [0.25, 0.75].into_iter().zip(bytes) {
            let steady = Gradient { dx: [0.0; 2], dy: [0.0; 2] };
            let fragments = of(One, [u, 0.5], steady);
            let stored = Stored(of_bytes.sampler(Nearest, Repeat)).shade(&fragments).0.0;
            assert_eq!(stored, Stored(of_words.sampler(Nearest, Repeat)).shade(&fragments).0.0);
            assert_eq!(stored, Stored(of_bytes.sampler(Bilinear, Repeat)).shade(&fragments).0.0);
            for pixel in [<[u8; 2]>::pixel(Rgb565Be, stored), u16::pixel(Rgb565Be, stored)] {
                assert_eq!(pixel.to_ne_bytes(), [high, low]);
            }
            assert_eq!(<[u8; 2]>::pixel(Rgb565Le, stored).to_ne_bytes(), [low, high]);
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "any bits")]
    fn noise(k: usize) -> u16 {
        (k.wrapping_mul(0x9e37_79b1) >> 13) as u16
    }

    /// Levels are those nearest to the logarithm in f64; between two, the texel is that of the filter for each sample.
    #[test]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers")]
    fn levels_are_chosen_once_for_a_triangle() {
        const SIDE: u32 = 32;
        let mut texels = std::vec![0_u16; alberti_texture::mipmap::texel_count(SIDE, SIDE)];
        texels.iter_mut().enumerate().for_each(|(k, texel)| *texel = noise(k));
        let map = Mipmap::new(Rgb565, &texels, SIDE, SIDE).expect("all levels");
        let trilinear = map.sampler(Trilinear, Repeat);
        let nearest = map.sampler(NearestLevel(Nearest), Repeat);
        let nearest = Stored(nearest.leveled());
        let mut levels = [0; 6];
        for k in 0..4000_u16 {
            let [u, v] = [f32::from(k % 61) / 61.0, f32::from(k % 97) / 97.0];
            let size = 2_f32.powf(f32::from(k % 89) / 12.0 - 1.0) / 32.0;
            let gradient = Gradient { dx: [size, 0.0], dy: [0.0, size * 0.75] };

            let fragments = of(One, [u, v], gradient);
            let settled = Stored(trilinear.leveled()).settled(One, &gradient);
            let once = settled.shade(&fragments).0;
            assert_eq!(once, Stored(trilinear).shade(&fragments).0, "{size}");
            let fixed = gradient.map(|of| of.map(Q16::from_f32));
            let fragments = of(OneFixed, [u, v].map(Q16::from_f32), fixed);
            let once = Stored(trilinear.leveled()).settled(OneFixed, &fixed).shade(&fragments).0;
            assert_eq!(once, Stored(trilinear).shade(&fragments).0, "{size} in fixed point");

            let lambda = (f64::from(size) * 32.0).log2();
            if (lambda - lambda.floor() - 0.5).abs() > 0.01 {
                let level = lambda.round().clamp(0.0, 5.0) as usize;
                let right = map
                    .level(level)
                    .sampler(Nearest, Repeat)
                    .stored_lanes(One, u, v, |texel| texel.map_or(0, u32::from));
                assert_eq!(
                    nearest.settled(One, &gradient).shade(&of(One, [u, v], gradient)).0,
                    right,
                    "{lambda}"
                );
                levels[level] += 1;
            }
        }
        assert!(levels.iter().all(|&count| count > 100), "{levels:?}");
        // Without a triangle, the largest level.
        assert_eq!(nearest.shade_one(Vec2::ZERO), Some(noise(31 * 32)));
    }

    /// Triangles of all sizes, in floats and in fixed point: levels found before them are those of each sample.
    #[test]
    fn drawn_triangles_have_the_levels_of_their_samples() {
        const SIDE: u32 = 64;
        let mut texels = std::vec![0_u16; alberti_texture::mipmap::texel_count(SIDE, SIDE)];
        texels.iter_mut().enumerate().for_each(|(k, texel)| *texel = noise(k));
        let map = Mipmap::new(Rgb565, &texels, SIDE, SIDE).expect("all levels").sampler(Trilinear, Repeat);
        let view = Camera::look_at(Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y).expect("a view");
        let view = view.perspective(0.8, 0.1..10.0).expect("a lens");
        for size in [0.05, 0.12, 0.3, 0.9_f32] {
            let corner =
                |k: u8| Vec3::new(f32::from(k % 2), f32::from(k / 2) * 0.8, f32::from(k % 2) * 0.2) * size;
            let corners = [0, 1, 3, 2].map(|k| {
                (corner(k) - Vec3::splat(size * 0.4), Vec2::new(f32::from(k % 2), f32::from(k / 2)) * 1.7)
            });
            let mesh = Mesh::new(&corners, &[[0_u8, 1, 2], [0, 2, 3]], |&corner| corner);
            let draw = |stage: &dyn Fn(&mut Target<'_, Rgb565Le, D16>)| {
                let (mut color, mut depth) = (std::vec![0; 160 * 120], std::vec![0; 160 * 120]);
                let target = Target::new(Rgb565Le, D16, 160, 120, &mut color, &mut depth);
                let mut target = target.expect("buffers that fit");
                target.clear(Rgba8::BLACK);
                stage(&mut target);
                color
            };
            macro_rules! alike {
                ($interpolation:expr) => {{
                    let by =
                        |stage| Pass::new(&view, &mesh, stage).interpolation($interpolation).subpixel(Sub4);
                    let found = draw(&|target| by(Stored(map.leveled())).draw(target));
                    let by =
                        |stage| Pass::new(&view, &mesh, stage).interpolation($interpolation).subpixel(Sub4);
                    let right = draw(&|target| by(Differentiated::by(PerTriangle, Stored(map))).draw(target));
                    assert!(found == right, "{size}, {}", stringify!($interpolation));
                    assert!(found.iter().any(|&pixel| pixel != 0), "{size}: nothing is seen");
                }};
            }
            alike!(Exact);
            alike!(FixedPoint(Affine));
            alike!(FixedPoint(Spans16));
        }
    }

    #[test]
    fn stored_texels_of_four_bytes_are_colours_for_any_target() {
        let texels = [[10, 20, 30, 40], [255, 0, 128, 7]];
        let stage = Stored(Texture::new(Rgba8888, &texels, 2, 1).expect("2 x 1").sampler(Nearest, Repeat));
        let (mut pixels, mut packed) = ([0; 2], [0; 2]);
        for (k, [r, g, b, a]) in texels.into_iter().enumerate() {
            let color = stage.shade_one(Vec2::new(0.25 + 0.5 * f32::from(k == 1), 0.5)).expect("a colour");
            assert_eq!(color, [r, g, b, a]);
            let word = color.to_word();
            (pixels[k], packed[k]) =
                (<[u8; 4]>::pixel(alberti_raster::Rgba8888, word), <[u8; 4]>::pixel(Rgb565Le, word));
            assert_eq!(pixels[k].to_ne_bytes(), [r, g, b, a]);
            assert_eq!(u16::from_le(packed[k]), alberti_raster::rgb565(Rgba8::new(r, g, b, a)));
        }
    }
}
