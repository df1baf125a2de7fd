//! Built-in fragment stages. The last two wrap another, so that a scene pays for what it uses.
//!
//! | stage | varying | colour |
//! |---|---|---|
//! | [`Solid`] | any | one for all |
//! | [`VertexColor`] | `Vec3` | the varying, red, green, blue in [0, 1] |
//! | [`VertexColor565`] | [`Ready565`] | the same in 16 bits |
//! | [`Unlit`] | `Vec2` | the texture at the varying |
//! | [`Stored`] | `Vec2` | the same, in the texture's own format |
//! | [`Tinted`] | the wrapped stage's | the wrapped stage's times a colour |
//! | [`Lambert`] | `(Vec3, V)`: a normal and the wrapped stage's | the wrapped stage's, lit |
//!
//! All arithmetic is on sRGB bytes, as they are stored.

use alberti_math::glam::{Vec2, Vec3};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Mode, Point3, Rgba8, Space, Varying, Vector3, World};
use alberti_raster::{Color, FragmentStage};
use alberti_texture::{Filter, Nearest, Sampler, Size, TexelFormat, Wrap};
use core::num::Wrapping;

/// One colour for everything.
///
/// # Cost
/// Nothing is interpolated.
#[derive(Clone, Copy, Debug)]
pub struct Solid<C = Rgba8>(
    /// The colour, of any type that the target can store.
    pub C,
);

impl<V: Varying, C: Color> FragmentStage<V> for Solid<C> {
    type Color = C;

    #[inline(always)]
    fn shade(&self, _: V) -> Option<C> {
        Some(self.0)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(&self, lanes: L, _: &V::Of<L::Number>, mask: L::Mask) -> (L::U32, L::Mask) {
        (lanes.word(self.0.to_word()), mask)
    }
}

/// The interpolated colour of the vertices; components outside [0, 1] are clamped.
///
/// # Precision
/// To the nearest byte.
#[derive(Clone, Copy, Debug)]
pub struct VertexColor;

impl FragmentStage<Vec3> for VertexColor {
    type Color = Rgba8;

    #[inline(always)]
    fn shade(&self, color: Vec3) -> Option<Rgba8> {
        alone(self, color)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(&self, lanes: L, color: &[L::Number; 3], mask: L::Mask) -> (L::U32, L::Mask) {
        let [r, g, b] = *color;
        let [r, g, b] = [lanes.of_unit(r, 255), lanes.of_unit(g, 255), lanes.of_unit(b, 255)];
        (pack(lanes, [r, g, b, lanes.word(255)]), mask)
    }
}

/// [`VertexColor`] for targets of 16 bits, of which the vertices carry [`Ready565`].
///
/// # Precision
/// To the nearest step of each channel.
///
/// # Cost
/// Shifts and masks: clamping and rounding are done at the vertices.
#[derive(Clone, Copy, Debug)]
pub struct VertexColor565;

/// A colour of which the fragments need only take the highest bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ready565(Vec3);

impl Ready565 {
    /// For this colour; components outside [0, 1] are clamped.
    #[must_use]
    #[inline]
    pub fn new(color: Vec3) -> Self {
        // floor(32 x) of these is what is nearest to 31 times the component.
        let steps = Vec3::new(32.0, 64.0, 32.0);
        Self((color.clamp(Vec3::ZERO, Vec3::ONE) * (steps - Vec3::ONE) + Vec3::splat(0.5)) / steps)
    }
}

impl Varying for Ready565 {
    type Of<T: Copy> = [T; 3];

    #[inline(always)]
    fn gather<const N: usize>(values: [Self; N]) -> [[f32; N]; 3] {
        Vec3::gather(values.map(|v| v.0))
    }

    #[inline(always)]
    fn map_by_mode<T: Copy, U: Copy>(bundle: &[T; 3], f: &impl Fn(Mode, T) -> U) -> [U; 3] {
        Vec3::map_by_mode(bundle, f)
    }

    #[inline(always)]
    fn zip<T: Copy, U: Copy>(first: &[T; 3], second: &[U; 3]) -> [(T, U); 3] {
        Vec3::zip(first, second)
    }

    #[inline(always)]
    fn from_components(bundle: &[f32; 3]) -> Self {
        Self(Vec3::from_components(bundle))
    }
}

impl FragmentStage<Ready565> for VertexColor565 {
    type Color = u16;

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "16 bits")]
    fn shade(&self, Ready565(color): Ready565) -> Option<u16> {
        let (word, _) = self.shade_lanes(One, &color.to_array(), true);
        Some(word.0 as u16)
    }

    // What is interpolated stays between what vertices carry, and so does not leave the channels.
    #[inline(always)]
    fn shade_lanes<L: Lanes>(&self, lanes: L, color: &[L::Number; 3], mask: L::Mask) -> (L::U32, L::Mask) {
        let [r, g, b] = *color;
        let [r, g, b] = [lanes.floor_scaled(r, 5), lanes.floor_scaled(g, 6), lanes.floor_scaled(b, 5)];
        (lanes.shl(r, 11) | (lanes.shl(g, 5) | b), mask)
    }
}

/// The texture, read by a [`Sampler`].
#[derive(Clone, Copy, Debug)]
pub struct Unlit<S>(
    /// The texture with its filter and wrap mode.
    pub S,
);

impl<F: TexelFormat, Fl: Filter, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Unlit<Sampler<'_, F, Fl, U, V, Z>>
{
    type Color = Rgba8;

    #[inline(always)]
    fn shade(&self, uv: Vec2) -> Option<Rgba8> {
        Some(self.0.sample(uv))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(&self, lanes: L, &[u, v]: &[L::Number; 2], mask: L::Mask) -> (L::U32, L::Mask) {
        (self.0.sample_lanes(lanes, u, v), mask)
    }
}

/// The texture's nearest texel as it is stored, for targets of the same format: nothing is decoded nor encoded.
#[derive(Clone, Copy, Debug)]
pub struct Stored<S>(
    /// The texture with its wrap mode.
    pub S,
);

impl<F: TexelFormat<Texel: Color>, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Stored<Sampler<'_, F, Nearest, U, V, Z>>
{
    type Color = F::Texel;

    #[inline(always)]
    fn shade(&self, uv: Vec2) -> Option<F::Texel> {
        let (word, _) = self.shade_lanes(One, &uv.to_array(), true);
        Some(Color::from_word(word.0))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(&self, lanes: L, &[u, v]: &[L::Number; 2], mask: L::Mask) -> (L::U32, L::Mask) {
        let words = self.0.stored_lanes(lanes, u, v, |texel| texel.map_or(0, Color::to_word));
        (words, mask)
    }
}

/// Another stage's colour times a constant one.
///
/// # Precision
/// To the nearest byte; white changes nothing.
#[derive(Clone, Copy, Debug)]
pub struct Tinted<S> {
    /// What is tinted.
    pub surface: S,
    /// The factor, in bytes: 255 is one. The surface's alpha is kept.
    pub tint: Rgba8,
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> FragmentStage<V> for Tinted<S> {
    type Color = Rgba8;

    #[inline(always)]
    fn shade(&self, varying: V) -> Option<Rgba8> {
        let surface = self.surface.shade(varying)?;
        let tinted = times(One, unpack(One, Wrapping(surface.to_bits())), self.tint);
        Some(Rgba8::from_bits(tinted.0))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        varyings: &V::Of<L::Number>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let (surface, mask) = self.surface.shade_lanes(lanes, varyings, mask);
        (times(lanes, unpack(lanes, surface), self.tint), mask)
    }
}

/// A colour's channels times a constant's, to the nearest byte; alpha is kept.
#[inline(always)]
fn times<L: Lanes>(lanes: L, [r, g, b, a]: [L::U32; 4], tint: Rgba8) -> L::U32 {
    let [tint_r, tint_g, tint_b, _] = tint.to_bytes();
    // x / 255 to the nearest is (x + 128) * 257 >> 16, for products of bytes.
    let products = [
        r * lanes.word(tint_r.into()) + lanes.word(128),
        g * lanes.word(tint_g.into()) + lanes.word(128),
        b * lanes.word(tint_b.into()) + lanes.word(128),
    ];
    let [r, g, b] = products;
    let [r, g, b] = [r + lanes.shr(r, 8), g + lanes.shr(g, 8), b + lanes.shr(b, 8)];
    pack(lanes, [lanes.shr(r, 8), lanes.shr(g, 8), lanes.shr(b, 8), a])
}

/// Another stage's colour under Lambert's cosine law, with one light at infinity:
/// colour · (ambient + diffuse · max(0, n·l)).
///
/// Normals are interpolated and made unit again at each fragment. For facets instead of a smooth surface, give the
/// three vertices of each triangle its [`face_normal`].
///
/// # Precision
/// Within 0.51 of a byte of the formula, from the wrapped stage's bytes, for normals between 1e-18 and 1e18 long. A
/// shorter or longer one has no direction that could be told, and gets a light between the ambient and the full one. In
/// fixed point lengths must be between 0.1 and 100, and the light is within 2^-10 of the formula.
///
/// # Cost
/// A square root, a division and about twenty multiplications and additions a fragment.
#[derive(Clone, Copy, Debug)]
pub struct Lambert<S> {
    surface: S,
    to_light: Vec3,
    ambient: f32,
    diffuse: f32,
}

impl<S> Lambert<S> {
    /// Light from the direction `to_light` (any length but zero), in the space in which the normals are given.
    /// `ambient` falls everywhere, `diffuse` where the surface faces the light.
    #[must_use]
    pub fn new(surface: S, to_light: Vector3<World>, ambient: f32, diffuse: f32) -> Self {
        Self { surface, to_light: to_light.coords.normalize_or_zero(), ambient, diffuse }
    }
}

impl<S> Lambert<S> {
    /// What the channels of a surface with this normal are multiplied by.
    #[inline(always)]
    fn light<L: Lanes>(&self, lanes: L, [x, y, z]: [L::Number; 3]) -> L::Number {
        let Vec3 { x: lx, y: ly, z: lz } = self.to_light;
        let [lx, ly, lz] = [lanes.splat(lx), lanes.splat(ly), lanes.splat(lz)];
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        let cosine = (x * lx + y * ly + z * lz) / lanes.sqrt(x * x + y * y + z * z);
        // A zero normal gives NaN here, which the comparison takes for no light; one too short may give infinity.
        let facing = lanes.select(lanes.less(zero, cosine), lanes.min(cosine, one), zero);
        lanes.splat(self.ambient) + lanes.splat(self.diffuse) * facing
    }
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> FragmentStage<(Vec3, V)> for Lambert<S> {
    type Color = Rgba8;

    #[inline(always)]
    fn shade(&self, (normal, varying): (Vec3, V)) -> Option<Rgba8> {
        let surface = self.surface.shade(varying)?;
        let light = self.light(One, normal.to_array());
        let lit = lit(One, unpack(One, Wrapping(surface.to_bits())), [light; 3]);
        Some(Rgba8::from_bits(lit.0))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        (normal, varyings): &([L::Number; 3], V::Of<L::Number>),
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let (surface, mask) = self.surface.shade_lanes(lanes, varyings, mask);
        (lit(lanes, unpack(lanes, surface), [self.light(lanes, *normal); 3]), mask)
    }
}

/// A colour's channels times `light`, to the nearest byte; alpha is kept.
#[inline(always)]
fn lit<L: Lanes>(lanes: L, [r, g, b, a]: [L::U32; 4], light: [L::Number; 3]) -> L::U32 {
    let r = lanes.nearest_byte(lanes.to_numbers(r) * light[0]);
    let g = lanes.nearest_byte(lanes.to_numbers(g) * light[1]);
    let b = lanes.nearest_byte(lanes.to_numbers(b) * light[2]);
    pack(lanes, [r, g, b, a])
}

/// The normal of the plane through three points, towards the side from which they run counter-clockwise. Its length is
/// twice the triangle's area, which fixed point may not hold: normalize it there. Zero where there is none.
#[must_use]
pub fn face_normal<S: Space>([a, b, c]: [Point3<S>; 3]) -> Vector3<S> {
    Vector3::new((b - a).coords.cross((c - a).coords))
}

/// One sample's colour, by way of the code for several.
#[inline(always)]
fn alone<V: Varying>(stage: &impl FragmentStage<V, Color = Rgba8>, varying: V) -> Option<Rgba8> {
    let components = V::map(&V::gather([varying]), &|[x]: [f32; 1]| x);
    let (word, kept) = stage.shade_lanes(One, &components, true);
    kept.then_some(Rgba8::from_bits(word.0))
}

/// The channels of colours.
#[inline(always)]
fn unpack<L: Lanes>(lanes: L, color: L::U32) -> [L::U32; 4] {
    let byte = lanes.word(255);
    [color & byte, lanes.shr(color, 8) & byte, lanes.shr(color, 16) & byte, lanes.shr(color, 24)]
}

/// Colours of these channels, which are bytes.
#[inline(always)]
fn pack<L: Lanes>(lanes: L, [r, g, b, a]: [L::U32; 4]) -> L::U32 {
    (r | lanes.shl(g, 8)) | (lanes.shl(b, 16) | lanes.shl(a, 24))
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::Q16;
    use alberti_math::lanes::OneFixed;
    use alberti_texture::format::Rgb565;
    use alberti_texture::{Clamp, Mirror, Repeat, Texture};

    #[test]
    fn light_falls_off_with_the_cosine() {
        let white = Lambert::new(Solid(Rgba8::WHITE), Vector3::new(Vec3::new(0.0, 7.0, 0.0)), 0.2, 0.6);
        let gray = |normal: Vec3| white.shade((normal, ())).expect("never discards").to_bytes()[0];
        assert_eq!(gray(Vec3::Y * 3.0), 204);
        assert_eq!(gray(Vec3::new(3f32.sqrt(), 1.0, 0.0)), 128);
        assert_eq!(gray(Vec3::X), 51);
        assert_eq!(gray(Vec3::NEG_Y), 51);
        assert_eq!(gray(Vec3::ZERO), 51);
    }

    #[test]
    fn light_in_fixed_point_keeps_its_bound() {
        let to_light = Vec3::new(0.48, 0.6, 0.64);
        let stage = Lambert::new(Solid(Rgba8::WHITE), Vector3::new(to_light), 0.2, 0.8);
        let mut worst = 0.0f32;
        for step in 0..20_000_u16 {
            let [a, b] = [f32::from(step % 141) * 0.0446, f32::from(step / 141) * 0.0223];
            let length = 0.1 * 1000f32.powf(f32::from(step % 97) / 96.0);
            let unit = Vec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos());
            let light = stage.light(OneFixed, (unit * length).to_array().map(Q16::from_f32)).to_f32();
            worst = worst.max((light - (0.2 + 0.8 * unit.dot(to_light).max(0.0))).abs());
        }
        assert!((0.0002..1.0 / 1024.0).contains(&worst), "{worst}");
    }

    /// Texels in fixed point, against the definition in integers: u is k / 65536, v is half a row up.
    #[test]
    fn stored_texels_are_those_of_their_cells_in_fixed_point() {
        let texels: [u16; 16] = core::array::from_fn(|i| 1000 + u16::try_from(i).expect("small"));
        let texture = Texture::<Rgb565>::new(&texels, 8, 2).expect("8 x 2").known::<8, 2>().expect("8 x 2");
        let v = Q16::from_f32(0.25);
        for k in (-300_000..300_000_i32).step_by(97).chain([-65_536, -1, 0, 65_535, 65_536]) {
            let at = [Q16::from_bits(k), v];
            let [repeat, mirror] = [k.rem_euclid(65_536) * 8 / 65_536, k.rem_euclid(131_072) * 8 / 65_536];
            let texel = |column: i32| 1008 + column.unsigned_abs();
            let stored = |(word, _): (Wrapping<u32>, bool)| word.0;
            let wrapped = Stored(texture.sampler::<Nearest, Repeat>()).shade_lanes(OneFixed, &at, true);
            assert_eq!(stored(wrapped), texel(repeat), "repeat {k}");
            let folded = Stored(texture.sampler::<Nearest, Mirror>()).shade_lanes(OneFixed, &at, true);
            assert_eq!(stored(folded), texel(mirror.min(15 - mirror)), "mirror {k}");
            let clamped = Stored(texture.sampler::<Nearest, Clamp>()).shade_lanes(OneFixed, &at, true);
            assert_eq!(stored(clamped), texel((k.clamp(0, 65_535)) * 8 / 65_536), "clamp {k}");
        }
    }

    #[test]
    fn a_tint_multiplies_and_white_is_one() {
        for c in 0..=255u8 {
            let tinted = |tint| Tinted { surface: Solid(Rgba8::new(c, c, c, 9)), tint }.shade(());
            assert_eq!(tinted(Rgba8::WHITE), Some(Rgba8::new(c, c, c, 9)));
            let half = (f32::from(c) * 100.0 / 255.0).round();
            let bytes = tinted(Rgba8::new(100, 0, 255, 0)).expect("never discards").to_bytes();
            assert_eq!(bytes.map(f32::from), [half, 0.0, f32::from(c), 9.0]);
        }
    }

    #[test]
    fn vertex_colours_are_rounded_and_clamped() {
        let color = VertexColor.shade(Vec3::new(0.5, -1.0, 2.0));
        assert_eq!(color, Some(Rgba8::new(128, 0, 255, 255)));
    }

    #[test]
    fn colours_of_16_bits_are_the_nearest() {
        for step in -100..1100_i16 {
            let c = f32::from(step) / 1000.0;
            let nearest = |steps: f32| (c.clamp(0.0, 1.0) * steps + 0.5).floor();
            let packed = VertexColor565.shade(Ready565::new(Vec3::splat(c))).expect("never discards");
            assert_eq!(f32::from(packed >> 11), nearest(31.0), "red of {c}");
            assert_eq!(f32::from(packed >> 5 & 63), nearest(63.0), "green of {c}");
            assert_eq!(f32::from(packed & 31), nearest(31.0), "blue of {c}");
        }
    }

    #[test]
    fn faces_look_to_where_they_run_counter_clockwise() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(Point3::<World>::new);
        assert_eq!(face_normal(corners).coords, Vec3::Z);
    }
}
