//! A brick wall in running bond: colour, height, normal and ambient occlusion.

use super::field::Field;
use super::noise::{hash, smooth_step, tile, unit};
use super::picture::{Palette, Picture};

/// Texels a side.
const SIDE: usize = 512;

/// Bricks along, and courses up, which is even.
const BRICKS: [f64; 2] = [4.0, 10.0];

const SEED: u32 = 0xB41C_0000;

/// How deep the joints are, as a share of the tile's width.
const RELIEF: f64 = 0.05;

/// Every map of the material, under its name.
pub(super) fn maps() -> Vec<(&'static str, Picture)> {
    let heights = Field::new(SIDE, height);
    vec![
        ("bricks-color", color()),
        ("bricks-height", heights.grey16(10)),
        ("bricks-normal", heights.normals(RELIEF)),
        ("bricks-ao", heights.openness(1.5).grey()),
    ]
}

/// How far inside its brick a place lies, in tiles, less than 0 in the mortar, and the brick's random word.
fn brick(uv: [f64; 2]) -> (f64, u32) {
    let ragged = |seed| 0.006 * tile(uv, 24, 3, SEED + seed);
    let course = (uv[1] * BRICKS[1] + ragged(1) * BRICKS[1]).rem_euclid(BRICKS[1]);
    let stagger = if course.floor() % 2.0 == 0.0 { 0.0 } else { 0.5 };
    let along = (uv[0] * BRICKS[0] + stagger + ragged(5) * BRICKS[0]).rem_euclid(BRICKS[0]);
    let word = hash([along as i64, course as i64, 0], SEED);
    let margin = |x: f64, count: f64| (0.5 - (x - x.floor() - 0.5).abs()) / count - 0.0075;
    (margin(along, BRICKS[0]).min(margin(course, BRICKS[1])), word)
}

fn height(uv: [f64; 2]) -> f64 {
    let (inside, word) = brick(uv);
    let own = |shift: u32| unit(word.rotate_left(shift)) - 0.5;
    let edge = smooth_step(-0.002, 0.007, inside);
    let dents = 0.10 * tile(uv, 24, 2, SEED + 10);
    // Pores that fire has left.
    let pores = 0.5 * smooth_step(0.26, 0.42, tile(uv, 40, 2, SEED + 30));
    let mortar = 0.16 + 0.10 * tile(uv, 48, 1, SEED + 20);
    mortar + edge * (0.78 + 0.16 * own(5) + dents - pores - mortar)
}

fn color() -> Picture {
    let palette = Palette::new(
        42,
        &[
            &[0x55_4f48, 0x9c_948a, 0xcf_c8bc],
            &[0x2c_100b, 0x7c_3020, 0xc0_6a4c],
            &[0x34_1810, 0x8e_4128, 0xcb_8460],
            &[0x24_0f10, 0x66_2a26, 0xa6_5c50],
            &[0x3a_2010, 0x9a_5a34, 0xd4_a078],
            &[0x1c_1214, 0x4c_2e2e, 0x8a_6460],
        ],
    );
    Picture::indexed(SIDE, SIDE, &palette, |uv| {
        let (inside, word) = brick(uv);
        let grain = 0.30 * tile(uv, 80, 2, SEED + 40) + 0.25 * tile(uv, 16, 3, SEED + 45);
        if inside < 0.002 {
            return palette.index(0, 0.52 + grain);
        }
        let ramp = [1, 1, 2, 2, 3, 1, 4, 5][(word >> 13 & 7) as usize];
        palette.index(ramp, 0.42 + 0.24 * unit(word.rotate_left(9)) + grain)
    })
}
