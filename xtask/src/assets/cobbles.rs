//! Wet cobblestones: one field of heights, and six maps that agree with it.

use super::field::Field;
use super::noise::{Cell, cell, smooth_step, tile, unit};
use super::picture::{Palette, Picture};

/// Texels a side.
const SIDE: usize = 512;

/// Stones a side; even.
const STONES: i64 = 8;

const SEED: u32 = 0x0C0B_B1E5;

/// How far the ground sags, as a share of all heights.
const DEPTH_OF_SAG: f64 = 0.3;

/// How deep the joints are, as a share of the tile's width. Scenes whose tile is one unit wide use it as the height's
/// range.
const RELIEF: f64 = 0.055;

/// Every map of the material, under its name.
pub(super) fn maps() -> Vec<(&'static str, Picture)> {
    let dry = Field::new(SIDE, height);
    let wetness = Field::new(SIDE, |uv| {
        let level = water(uv);
        // Above the water there is a film, more of it near by.
        let film = 0.28 + 0.16 * tile(uv, 6, 1, SEED + 60);
        film + (1.0 - film) * smooth_step(level + 0.09, level - 0.01, dry.look_up(uv))
    });
    // The water's surface is flat.
    let surface = Field::new(SIDE, |uv| dry.look_up(uv).max(water(uv)));
    let polish = Field::new(SIDE, |uv| {
        let worn = smooth_step(0.5, 0.9, dry.look_up(uv));
        let grain = 0.5 + 0.8 * tile(uv, 40, 1, SEED + 40);
        (0.06 + 0.55 * worn * grain).max(smooth_step(0.5, 0.95, wetness.look_up(uv)))
    });
    vec![
        ("cobbles-color", color(&dry)),
        ("cobbles-height", surface.grey16(11)),
        ("cobbles-normal", surface.normals(RELIEF)),
        ("cobbles-wetness", wetness.grey()),
        ("cobbles-ao", dry.openness(2.6).grey()),
        ("cobbles-shininess", polish.grey()),
    ]
}

/// The stone at a place, whose border is a little crooked.
fn stone(uv: [f64; 2]) -> Cell {
    let crooked = |seed| 0.10 * tile(uv, 16, 2, SEED + seed);
    let [x, y] = uv.map(|x| x * STONES as f64);
    cell([x + crooked(1), y + crooked(2)], STONES, 0.17, SEED)
}

/// How far the ground has sunk, from 0 to 1.
fn sag(uv: [f64; 2]) -> f64 {
    smooth_step(-0.16, 0.26, tile(uv, 2, 2, SEED + 30))
}

/// Stones with round shoulders, no two alike, in sand.
fn height(uv: [f64; 2]) -> f64 {
    let stone = stone(uv);
    let own = |shift: u32| unit(stone.word.rotate_left(shift));
    let inside = ((stone.border - 0.03) / 0.30).clamp(0.0, 1.0);
    let shoulder = (inside * (2.0 - inside)).sqrt();
    let tilt = 0.25 * ((own(7) - 0.5) * stone.offset[0] + (own(13) - 0.5) * stone.offset[1]);
    let chips = 0.09 * tile(uv, 24, 2, SEED + 10) + 0.06 * tile(uv, 12, 2, SEED + 15);
    let sand = 0.09 + 0.08 * tile(uv, 48, 2, SEED + 20);
    let height = (0.12 + shoulder * (0.68 + 0.18 * own(19) + tilt + chips)).max(sand);
    DEPTH_OF_SAG * (1.0 - sag(uv)) + (1.0 - DEPTH_OF_SAG) * height
}

/// How high the water stands: over the joints everywhere, and over the lowest stones where the ground has sunk.
fn water(uv: [f64; 2]) -> f64 {
    let sag = sag(uv);
    DEPTH_OF_SAG * (1.0 - sag) + (1.0 - DEPTH_OF_SAG) * (0.15 + 0.63 * sag)
}

/// Granite of several quarries in brown sand.
fn color(height: &Field) -> Picture {
    let palette = Palette::new(
        36,
        &[
            &[0x17_1410, 0x4a_3d2e, 0x86_7355],
            &[0x22_2224, 0x6a_6866, 0xb6_b2aa],
            &[0x20_2226, 0x60_646a, 0xa6_aaae],
            &[0x24_201c, 0x74_6a60, 0xbc_b0a2],
            &[0x26_1e1c, 0x76_6460, 0xba_a8a2],
            &[0x1e_1e1e, 0x58_5855, 0x9e_9c96],
        ],
    );
    Picture::indexed(SIDE, SIDE, &palette, |uv| {
        let (stone, height) = (stone(uv), height.look_up(uv));
        let speckle = 0.34 * tile(uv, 90, 2, SEED + 50) + 0.22 * tile(uv, 20, 3, SEED + 55);
        let above = (height - DEPTH_OF_SAG * (1.0 - sag(uv))) / (1.0 - DEPTH_OF_SAG);
        if above < 0.24 {
            return palette.index(0, 0.42 + 1.2 * (above - 0.15) + speckle);
        }
        let own = unit(stone.word.rotate_left(25));
        let ramp = [1, 1, 1, 2, 2, 3, 3, 4, 5, 5][(own * 9.99) as usize];
        let light = 0.28 + 0.26 * unit(stone.word.rotate_left(3));
        palette.index(ramp, light + 0.25 * (above - 0.5) + speckle)
    })
}
