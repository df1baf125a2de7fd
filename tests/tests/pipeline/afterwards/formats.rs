//! Formats of displays in lanes: levels in integers, and the bits that a display's data sheet has.

use alberti::raster::color::{
    Bayer, BlueNoise, Dithered, Grey1, Grey2, Grey4, Grey8, Levels, Pattern, Rgb332, Rgb444, Rgb666, Rgb888,
    Xrgb8888,
};
use alberti::{ColorFormat, Rgb565Be, Rgb565Le, Rgba8};
use alberti_math::lanes::{Lanes, One};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::for_widest;

/// Pixels of colours in a row of a target, of which every fifth is left as it was.
fn stored<C: ColorFormat, L: Lanes>(
    format: C,
    lanes: L,
    colors: &[u32],
    [column, row]: [i32; 2],
    before: C::Pixel,
) -> Vec<C::Pixel> {
    let groups = (0..).step_by(L::COUNT).zip(colors.chunks_exact(L::COUNT));
    let group = |(first, colors): (usize, &[u32])| {
        let words = lanes.load_words(&lanes.each(|k| colors[k]));
        let bits = (0..L::COUNT).map(|k| u32::from(is_drawn(first + k)) << k).sum();
        let mut pixels = lanes.each(|_| before);
        let place = [column + first as i32, row];
        format.store::<L, Rgba8>(lanes, words, lanes.mask(bits), place, &mut pixels);
        pixels.as_ref().to_vec()
    };
    groups.flat_map(group).collect()
}

fn is_drawn(k: usize) -> bool {
    k % 5 != 3
}

/// Holds a format to its levels, rounded and by both patterns: `channels` are the bytes that they are made of,
/// `greatest` the greatest levels, and `pixel` puts levels together.
fn has_levels<C: Levels<Pixel: PartialEq>, const N: usize>(
    format: C,
    channels: fn([u32; 4]) -> [u32; N],
    greatest: [u32; N],
    pixel: fn([u32; N]) -> C::Pixel,
) {
    let mut rng = Rng::stream(run_seed(), 41);
    let colors: Vec<u32> = (0..16 * 64).map(|_| rng.u64() as u32).collect();
    let before = pixel([0; N]);
    for place in [[0, 0], [37, 11], [-13, 250]] {
        let holds = |what: &str, threshold: &dyn Fn([i32; 2]) -> u32, found: Vec<C::Pixel>| {
            assert_eq!(found.len(), colors.len());
            for (k, (&color, found)) in colors.iter().zip(found).enumerate() {
                let more = threshold([place[0] + k as i32, place[1]]);
                let bytes = channels(color.to_le_bytes().map(u32::from));
                let levels = std::array::from_fn(|c| (bytes[c] * greatest[c] + more) / 255);
                let expected = if is_drawn(k) { pixel(levels) } else { before };
                assert!(found == expected, "{format:?}, {what}: {color:08x} at {k} of {place:?}: {found:?}");
            }
        };
        let (bayer, noise) = (Dithered { format, by: Bayer }, Dithered { format, by: BlueNoise });
        holds("one lane", &|_| 127, stored(format, One, &colors, place, before));
        for_widest!(lanes => {
            holds("rounded", &|_| 127, stored(format, lanes, &colors, place, before));
            holds("Bayer", &|at| Bayer.threshold(at), stored(bayer, lanes, &colors, place, before));
            holds("noise", &|at| BlueNoise.threshold(at), stored(noise, lanes, &colors, place, before));
        });
    }
}

#[test]
fn formats_have_their_levels_in_all_lanes() {
    fn rgb([r, g, b, _]: [u32; 4]) -> [u32; 3] {
        [r, g, b]
    }
    fn grey([r, g, b, _]: [u32; 4]) -> [u32; 1] {
        [(77 * r + 150 * g + 29 * b + 128) / 256]
    }
    has_levels(Rgb565Le, rgb, [31, 63, 31], |[r, g, b]| ((r << 11 | g << 5 | b) as u16).to_le());
    has_levels(Rgb565Be, rgb, [31, 63, 31], |[r, g, b]| ((r << 11 | g << 5 | b) as u16).to_be());
    has_levels(Rgb444, rgb, [15; 3], |[r, g, b]| [r as u8, (g << 4 | b) as u8]);
    has_levels(Rgb666, rgb, [63; 3], |levels| levels.map(|level| (level << 2) as u8));
    has_levels(Rgb888, rgb, [255; 3], |levels| levels.map(|level| level as u8));
    has_levels(Xrgb8888, rgb, [255; 3], |[r, g, b]| (r << 16 | g << 8 | b).to_le());
    has_levels(Rgb332, rgb, [7, 7, 3], |[r, g, b]| (r << 5 | g << 2 | b) as u8);
    has_levels(Grey8, grey, [255], |[level]| level as u8);
    has_levels(Grey4, grey, [15], |[level]| level as u8);
    has_levels(Grey2, grey, [3], |[level]| level as u8);
    has_levels(Grey1, grey, [1], |[level]| level as u8);
}
