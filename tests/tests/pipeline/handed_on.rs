//! What the traits say of a type that says no more than it must, and what one type hands on to another.

use core::fmt::Debug;

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{One, OneFixed};
use alberti::math::{Vector2, Vector3};
use alberti::raster::Samples;
use alberti::raster::color::{Blend, InLight, Over};
use alberti::texture::format::L8;
use alberti::texture::surface::BilinearHeights;
use alberti::texture::{
    AnyFilter, Bilinear, Filter, Known, Mipmap, Nearest, Repeat, Size, Texture, Trilinear,
};
use alberti::{
    ColorFormat, FragmentColor, FragmentStage, Fragments, Gradient, Lanes, NoDerivatives, Object, Q16,
    Rgb565Be, Rgba8, Rgba565, Rgba8888, Varying,
};
use alberti_oracle::rng::{Rng, run_seed};

/// A stage of one word for all samples, that says no more than it must.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plain<C>(C);

impl<C: FragmentColor> FragmentStage<f32> for Plain<C> {
    type Color = C;
    type Derivatives = NoDerivatives;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, f32>) -> (L::U32, L::Mask) {
        (fragments.lanes.word(self.0.to_word()), fragments.mask)
    }
}

/// Colours of each kind are shown by formats as what they stand for. Stages that say nothing of triangles and rows are
/// the same in all.
#[test]
fn a_plain_stage_is_the_same_everywhere() {
    fn same<C: FragmentColor + PartialEq + Debug>(color: C, shown: [u8; 4]) {
        let [r, g, b, a] = shown;
        let rgba = Rgba8::new(r, g, b, a);
        let word = color.to_word();
        assert_eq!(C::from_word(word), color);
        assert_eq!(C::color(Rgba8888, word), rgba.to_bits());
        assert_eq!(C::pixel(Rgba8888, word), Rgba8888.pixel(rgba));
        assert_eq!(C::pixel(Rgb565Be, word), Rgb565Be.pixel(rgba));
        let stage = Plain(color);
        assert_eq!(stage.shade_one(0.5), Some(color));
        let gradient = Gradient { dx: 1.0, dy: 2.0 };
        assert_eq!((stage.settled(One, &gradient), stage.in_row(7)), (stage, stage));
    }
    same(Rgba8::new(1, 2, 3, 255), [1, 2, 3, 255]);
    same([1, 2, 3, 255], [1, 2, 3, 255]);
    // Full channels: they are the same in five and six bits.
    same(Rgba565::new(Rgba8::new(255, 0, 255, 255)), [255, 0, 255, 255]);
}

/// Fragments and samples tell where they are.
#[test]
fn samples_tell_where_they_are() {
    let gradient = Gradient { dx: 0.0, dy: 0.0 };
    let fragments = Fragments::<One, f32> { lanes: One, varying: 0.5, gradient, mask: true, place: [3, 4] };
    assert_eq!(format!("{fragments:?}"), "Fragments { place: [3, 4], mask: 1, .. }");
    assert_eq!(Clone::clone(&fragments).place, [3, 4]);
    let (weights, values) = ([0.25, 0.25, 0.5], 0.5);
    let samples = Samples::<One, f32> { column: 5, weights: &weights, values: &values, reciprocal: None };
    assert_eq!(format!("{samples:?}"), "Samples { column: 5, .. }");
}

/// A blend of light has the channels and the alpha of the blend that it is made of.
#[test]
fn light_is_blended_as_numbers_are() {
    let mut rng = Rng::stream(run_seed(), 11);
    for _ in 0..1_000 {
        let [new, old, alpha] = [(); 3].map(|()| u32::try_from(rng.index(256)).expect("a byte"));
        let mean = (i64::from(new) * i64::from(alpha) + i64::from(old) * i64::from(255 - alpha)) * 2;
        let channel = InLight(Over).channel(new, old, alpha, 255);
        assert!((i64::from(channel) * 510 - mean).abs() <= 255, "{new} over {old} by {alpha}: {channel}");
        // What is behind shows through by what the source lets through.
        let both = 255 * 255 - i64::from(255 - alpha) * i64::from(255 - old);
        let found = InLight(Over).alpha(alpha, old);
        assert!((i64::from(found) * 255 - both).abs() <= 255, "{alpha} over {old}: {found}");
    }
}

/// Texels of a map of 8 x 4 bytes.
fn texels() -> [u8; 32] {
    core::array::from_fn(|k| u8::try_from(k * 37 % 256).expect("a byte"))
}

/// A filter that is picked at run time has the sums of the one that it names, and these are those of reals.
#[test]
fn sums_are_those_of_the_filter() {
    let texels = texels();
    let texture = Texture::new(L8, &texels, 8, 4).expect("8 x 4");
    let wraps = (Repeat, Repeat);
    let at = |column: i32, row: i32| {
        // Rows are stored from the top, v goes up.
        let (column, row) = (column.rem_euclid(8) as usize, 3 - row.rem_euclid(4) as usize);
        f64::from(texels[row * 8 + column])
    };
    let mut rng = Rng::stream(run_seed(), 12);
    for _ in 0..500 {
        #[expect(clippy::cast_possible_truncation, reason = "any number")]
        let uv = [(); 2].map(|()| rng.uniform(-2.0, 2.0) as f32);
        let near = AnyFilter::Nearest.sums(One, &texture, wraps, uv);
        assert_eq!(near, Nearest.sums(One, &texture, wraps, uv));
        let blended = AnyFilter::Bilinear.sums(One, &texture, wraps, uv);
        assert_eq!(blended, Bilinear.sums(One, &texture, wraps, uv));
        let [x, y] = [f64::from(uv[0]) * 8.0, f64::from(uv[1]) * 4.0];
        let red = |sums: [[_; 4]; 1]| f64::from(One.store_words(sums[0][0])[0]) / 65_536.0;
        #[expect(clippy::cast_possible_truncation, reason = "some texels")]
        let [column, row] = [x, y].map(|place| place.floor() as i32);
        assert_eq!(red(near), at(column, row), "{uv:?}");
        #[expect(clippy::cast_possible_truncation, reason = "some texels")]
        let [left, low] = [x, y].map(|place| (place - 0.5).floor() as i32);
        let [s, t] = [x - 0.5 - f64::from(left), y - 0.5 - f64::from(low)];
        let row = |row| at(left, row) * (1.0 - s) + at(left + 1, row) * s;
        let exact = row(low) * (1.0 - t) + row(low + 1) * t;
        // Shares are 256ths, and so each axis may be off by half of one.
        assert!((red(blended) - exact).abs() <= 255.0 / 256.0, "{uv:?}: {} of {exact}", red(blended));
    }
}

/// The texel that is stored at a place in 65536ths of a side, as fixed point has it, and as floats have.
fn stored<Z: Size>(texture: Texture<'_, L8, Z>, [u, v]: [i32; 2]) -> [u32; 2] {
    let sampler = texture.sampler(Nearest, Repeat);
    let word = |texel: Option<u8>| texel.map_or(1 << 20, u32::from);
    let [u, v] = [u, v].map(Q16::from_bits);
    let fixed = sampler.stored_lanes(OneFixed, u, v, word);
    let float = sampler.stored_lanes(One, u.to_f32(), v.to_f32(), word);
    [fixed.0, float.0]
}

/// A texture whose sides are known has the texels of any, in floats and in fixed point, and so have powers of two.
#[test]
fn known_sides_change_no_texel() {
    let texels = texels();
    let any = Texture::new(L8, &texels, 8, 4).expect("8 x 4");
    let known: Texture<'_, L8, Known<8, 4>> = any.known().expect("8 x 4");
    let powers = any.power_of_two().expect("powers of two");
    assert!(any.known::<4, 8>().is_none() && any.known::<8, 8>().is_none());
    let mut rng = Rng::stream(run_seed(), 13);
    for _ in 0..500 {
        let place = [(); 2].map(|()| i32::try_from(rng.index(1 << 18)).expect("18 bits") - (1 << 17));
        let [column, row] = [(place[0], 8), (place[1], 4)].map(|(x, side)| {
            usize::try_from((x.rem_euclid(65_536) * side) >> 16).expect("a column or a row")
        });
        let texel = u32::from(texels[(3 - row) * 8 + column]);
        assert_eq!(stored(any, place), [texel; 2], "{place:?}");
        assert_eq!(stored(known, place), [texel; 2], "{place:?}");
        assert_eq!(stored(powers, place), [texel; 2], "{place:?}");
    }
    // A level of a known size is one of any power of two.
    let (level, _) = Size::level(Known::<8, 4>, &texels);
    assert_eq!(level, texels);
}

/// Differences, opposites and multiples of vectors, and points that triangles carry, are those of their coordinates.
#[test]
fn vectors_are_what_their_coordinates_are() {
    let [a, b] = [Vec3::new(1.0, -2.0, 4.0), Vec3::new(0.5, 0.25, -3.0)].map(Vector3::<Object>::new);
    assert_eq!((a - b).coords, Vec3::new(0.5, -2.25, 7.0));
    assert_eq!(((-a).coords, (a * 0.5).coords), (Vec3::new(-1.0, 2.0, -4.0), Vec3::new(0.5, -1.0, 2.0)));
    let flat = Vector2::<Object>::new(Vec2::new(3.0, -1.0));
    assert_eq!((flat - flat * 2.0).coords, Vec2::new(-3.0, 1.0));
    type Carried = Vector2<Object>;
    let three = Carried::gather([flat, -flat, flat * 3.0]);
    let of = |k: usize| Carried::from_components(&Carried::map(&three, &|each: [f32; 3]| each[k]));
    assert_eq!([of(0), of(1), of(2)].map(|v| v.coords), [flat, -flat, flat * 3.0].map(|v| v.coords));
}

/// Maps of heights, and mip maps of which the level is chosen, tell what they are of.
#[test]
fn maps_tell_what_they_are_of() {
    let texels = texels();
    let heights = BilinearHeights::new(Texture::new(L8, &texels, 8, 4).expect("8 x 4"), Repeat);
    let told = format!("{heights:?}");
    assert!(told.starts_with("BilinearHeights { texture: Texture") && told.contains("Repeat"), "{told}");
    let levels = [0_u8; 16 + 4 + 1];
    let map = Mipmap::new(L8, &levels, 4, 4).expect("three levels");
    let sampler = map.sampler(Trilinear, Repeat);
    let leveled = sampler.leveled();
    assert_eq!(leveled.format(), L8);
    assert!(format!("{leveled:?}").starts_with("Leveled { near: Texture"), "{leveled:?}");
    // Two texels a pixel: the level between the first and the second, and nothing of the one after.
    let gradient = Gradient { dx: [0.5, 0.0], dy: [0.0, 0.5] };
    let told = format!("{:?}", leveled.settled(One, &gradient));
    assert!(told.contains("width: 2") && told.contains("along: 0"), "{told}");
    let between = leveled.settled(One, &Gradient { dx: [0.375, 0.0], dy: [0.0, 0.375] });
    let told = format!("{between:?}");
    // log2 1.5 is 0.585, and 18.7 32nds.
    assert!(
        told.contains("width: 4") && (told.contains("along: 18") || told.contains("along: 19")),
        "{told}"
    );
}
