//! Texels with alpha as they are stored.

use alberti_math::glam::Vec2;
use alberti_math::lanes::Lanes;
use alberti_math::{Gradient, Rgba8, Rgba565};
use alberti_raster::{FragmentStage, Fragments, NoDerivatives, PerTriangle};
use alberti_texture::{Leveled, Nearest, NearestLevel, Sampler, Size, TexelFormat, Wrap};

/// A texture's colours with alpha, for targets of RGB565 that are mixed [`Over`](alberti_raster::color::Over): nearest
/// texels, best of the format [`Rgb565Alpha`](alberti_texture::format::Rgb565Alpha), which is drawn as it is stored. Of
/// a mip map whose levels are chosen once a triangle ([`Leveled`]), those of its level.
///
/// ```
/// use alberti::raster::color::{Blended, Over};
/// use alberti::shaders::StoredAlpha;
/// use alberti::texture::{Nearest, Repeat, Texture, format::Rgb565Alpha};
/// use alberti::{NoDepth, Rgb565Le, Rgba8, Target};
///
/// static PANE: [u32; 1] = Rgb565Alpha::of(&[[0, 0, 255, 128]]);
/// let stage = StoredAlpha(Texture::new(Rgb565Alpha, &PANE, 1, 1)?.sampler(Nearest, Repeat));
/// let (mut color, mut depth) = ([0; 64], [(); 64]);
/// let mut target = Target::new(Rgb565Le, NoDepth, 8, 8, &mut color, &mut depth)?;
/// let mut glass = target.with_color(Blended { format: Rgb565Le, by: Over });
/// # let _ = (stage, &mut glass);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Precision
/// That of [`Rgba565`].
///
/// # Cost
/// On RGB565 that of [`Stored`](super::Stored), and one product of a word. Texels of other formats take three
/// quotients, and so do other targets. Beyond a border there is nothing, whatever its colour.
#[derive(Clone, Copy, Debug)]
pub struct StoredAlpha<S>(
    /// The texture with its wrap mode.
    pub S,
);

impl<F: TexelFormat, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for StoredAlpha<Sampler<'_, F, Nearest, U, V, Z>>
{
    type Color = Rgba565;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        const NOTHING: Rgba565 = Rgba565::new(Rgba8::new(0, 0, 0, 0));
        let Fragments { lanes, varying: [u, v], mask, .. } = *fragments;
        let format = self.0.texture().format();
        let word = |texel: Option<F::Texel>| texel.map_or(NOTHING, |texel| format.rgba565(texel)).to_bits();
        (self.0.stored_lanes(lanes, u, v, word), mask)
    }
}

impl<F: TexelFormat, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for StoredAlpha<Leveled<'_, F, NearestLevel<Nearest>, U, V, Z>>
{
    type Color = Rgba565;
    type Derivatives = PerTriangle;
    const SETTLES: bool = true;

    #[inline(always)]
    fn settled<L: Lanes>(&self, lanes: L, gradient: &Gradient<[L::Number; 2]>) -> Self {
        Self(self.0.settled(lanes, gradient))
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        StoredAlpha(self.0.level()).shade(fragments)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Camera, Exact, FixedPoint, Interpolation, Mesh, NoDepth, Pass, Rgb565Le, Spans16, Target};
    use alberti_math::glam::Vec3;
    use alberti_math::lanes::One;
    use alberti_raster::color::{Blended, Over};
    use alberti_texture::format::{InBytes, Rgb565Alpha, Rgba8888};
    use alberti_texture::{Border, Mipmap, Repeat, Texture};

    const COLORS: [[u8; 4]; 4] = [[255, 0, 0, 255], [0, 255, 40, 128], [10, 20, 250, 40], [9, 9, 9, 0]];
    const WORDS: [u32; 4] = Rgb565Alpha::of(&COLORS);

    #[test]
    fn words_are_those_of_their_texels() {
        let bytes = WORDS.map(u32::to_le_bytes);
        let of_words = Texture::new(Rgb565Alpha, &WORDS, 2, 2).expect("2 x 2").sampler(Nearest, Repeat);
        let of_bytes =
            Texture::new(InBytes(Rgb565Alpha), &bytes, 2, 2).expect("2 x 2").sampler(Nearest, Repeat);
        let of_colors = Texture::new(Rgba8888, &COLORS, 2, 2).expect("2 x 2").sampler(Nearest, Repeat);
        for (k, uv) in [(2, [0.2, 0.2]), (3, [0.7, 0.2]), (0, [1.2, -0.2]), (1, [0.7, 1.7])] {
            let word = Some(Rgba565::from_bits(WORDS[k]));
            assert_eq!(StoredAlpha(of_words).shade_one(uv.into()), word);
            assert_eq!(StoredAlpha(of_bytes).shade_one(uv.into()), word);
            assert_eq!(StoredAlpha(of_colors).shade_one(uv.into()), word);
        }
        // Beyond a border there is nothing: all of the pixel stays.
        let framed = of_words.texture().sampler(Nearest, Border(Rgba8::WHITE));
        let outside = StoredAlpha(framed).shade_one(Vec2::new(1.5, 0.5)).expect("a word");
        assert_eq!(outside.to_rgba8(), Rgba8::new(0, 0, 0, 0));
    }

    /// The single texel of the last level, of a triangle whose pixels are larger than the texture.
    #[test]
    fn levels_are_those_of_the_triangle() {
        let mut chain = [WORDS[0], WORDS[0], WORDS[0], WORDS[0], 0];
        alberti_texture::mipmap::build(Rgb565Alpha, &mut chain, 2, 2).expect("2 x 2");
        chain[4] = WORDS[1];
        let map = Mipmap::new(Rgb565Alpha, &chain, 2, 2).expect("two levels");
        let sampler = map.sampler(NearestLevel(Nearest), Repeat);
        let stage = StoredAlpha(sampler.leveled());
        for (size, word) in [(0.01, WORDS[0]), (2.0, WORDS[1])] {
            let gradient = Gradient { dx: [size, 0.0], dy: [0.0, size] };
            let settled = stage.settled(One, &gradient);
            assert_eq!(settled.shade_one(Vec2::new(0.3, 0.3)), Some(Rgba565::from_bits(word)));
        }
    }

    /// A wall of four colours before one: each pixel is the mean of its texel and what was there.
    #[test]
    fn texels_are_drawn_over_what_is_there() {
        fn drawn(interpolation: impl Interpolation) -> [u16; 64 * 64] {
            let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
            let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            let mesh = Mesh::new(&corners, &[[0_u16, 1, 2], [0, 2, 3]], |&v| (v, v.truncate() * 0.5 + 0.5));
            let camera = Camera::look_at(Vec3::Z, Vec3::ZERO, Vec3::Y).expect("a direction");
            let view = camera.parallel(2.0, 0.1..2.0).expect("a view");
            let texture = Texture::new(Rgb565Alpha, &WORDS, 2, 2).expect("2 x 2");
            let stage = StoredAlpha(texture.sampler(Nearest, Repeat));
            let (mut color, mut depth) = ([0; 64 * 64], [(); 64 * 64]);
            let mut target = Target::new(Rgb565Le, NoDepth, 64, 64, &mut color, &mut depth).expect("64 x 64");
            target.clear(Rgba8::from_rgb24(0x84_82_84));
            let mut glass = target.with_color(Blended { format: Rgb565Le, by: Over });
            Pass::new(&view, &mesh, stage).interpolation(interpolation).draw(&mut glass);
            color
        }
        let pixels = drawn(Exact);
        assert_eq!(pixels, drawn(FixedPoint(Spans16)));
        for (k, pixel) in pixels.into_iter().enumerate() {
            let [column, row] = [k % 64 / 32, k / 64 / 32];
            let [color @ .., alpha] = COLORS[column + 2 * row].map(f64::from);
            let levels = [pixel >> 11, pixel >> 5 & 63, pixel & 31].map(f64::from);
            for (channel, (greatest, before)) in
                [(31.0, 16.0), (63.0, 32.0), (31.0, 16.0)].into_iter().enumerate()
            {
                let (a, new) = (alpha / 255.0, color[channel] / 255.0 * greatest);
                let off = (levels[channel] - (new * a + before * (1.0 - a))).abs();
                assert!(off < [1.5, 2.0, 1.5][channel], "{column}, {row}: {levels:?}");
            }
        }
    }
}
