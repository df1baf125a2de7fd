//! Single maps: a grid for looking at filters, marble, hammered metal, brushed stripes, lava, and a slide.

use super::field::Field;
use super::noise::{cell, noise, smooth_step, tile, turn, unit};
use super::picture::{Palette, Picture};

const SEED: u32 = 0x9A77_0000;

/// Every map, under its name.
pub(super) fn maps() -> Vec<(&'static str, Picture)> {
    let lava = Field::new(256, lava_height);
    vec![
        ("grid", grid()),
        ("marble", marble()),
        ("hammered-height", Field::new(256, hammered).grey16(10)),
        ("stripes-shininess", Field::new(256, stripes).grey()),
        ("scratches-specular", Field::new(256, scratches).grey()),
        ("lava-height", lava.grey16(10)),
        ("lava-emissive", lava_glow()),
        ("rose-window", rose_window()),
    ]
}

/// Eight by eight squares with their names, letters to the right and figures upwards, each with a thin frame.
fn grid() -> Picture {
    const SIDE: usize = 256;
    let palette = Palette::new(
        8,
        &[&[0x10_1820, 0x28_3c50], &[0xd8_d0b8, 0xff_faea], &[0x20_6080, 0x40_90b8], &[0xc0_4020, 0xe8_6840]],
    );
    Picture::indexed(SIDE, SIDE, &palette, |uv| {
        let [column, row] = uv.map(|x| (x * 8.0) as usize);
        let [x, y] = uv.map(|x| (x * 256.0) as usize % 32);
        let light = (column + row) % 2 == 1;
        if x == 0 || y == 0 || x == 31 || y == 31 {
            return palette.index(if light { 3 } else { 2 }, 0.6);
        }
        let letter = (8..14).contains(&x) && glyph(column, (x - 8) / 2, y);
        let figure = (18..24).contains(&x) && glyph(8 + row, (x - 18) / 2, y);
        let ink = if letter || figure { 1.0 } else { 0.0 };
        match light {
            true if ink > 0.0 => palette.index(3, 0.2),
            true => palette.index(1, 0.3 + 0.7 * uv[1]),
            false => palette.index(if ink > 0.0 { 2 } else { 0 }, if ink > 0.0 { 1.0 } else { 1.0 - uv[1] }),
        }
    })
}

/// Whether a letter from A to H, or a figure from 1 to 8, has ink in a column of three and a row of five, each two
/// texels high.
fn glyph(index: usize, column: usize, y: usize) -> bool {
    // Rows from the top, three bits each.
    const GLYPHS: [u16; 16] = [
        0b010_101_111_101_101,
        0b110_101_110_101_110,
        0b011_100_100_100_011,
        0b110_101_101_101_110,
        0b111_100_110_100_111,
        0b111_100_110_100_100,
        0b011_100_101_101_011,
        0b101_101_111_101_101,
        0b010_110_010_010_111,
        0b110_001_010_100_111,
        0b110_001_010_001_110,
        0b101_101_111_001_001,
        0b111_100_110_001_110,
        0b011_100_110_101_010,
        0b111_001_010_010_010,
        0b010_101_010_101_010,
    ];
    let Some(row) = (11..21).contains(&y).then(|| (y - 11) / 2) else { return false };
    GLYPHS[index] >> (row * 3 + 2 - column) & 1 == 1
}

/// White stone with grey veins: stripes that turbulence has bent, at its thinnest where the sum crosses zero.
fn marble() -> Picture {
    let palette = Palette::new(128, &[&[0x3a_3c44, 0x8e_8d92, 0xcf_cbc6, 0xec_e8e0, 0xf8_f5ee]]);
    Picture::indexed(256, 256, &palette, |uv| {
        let vein = |bumps, seed| {
            let bent = tile(uv, bumps, 5, SEED + seed);
            1.0 - smooth_step(0.0, 0.11, bent.abs())
        };
        let cloud = 0.5 * tile(uv, 4, 4, SEED + 9);
        palette.index(0, 0.86 + cloud - 0.42 * vein(2, 1) - 0.20 * vein(4, 20))
    })
}

/// Dents that a round hammer has left, side by side: a bowl in each cell.
fn hammered(uv: [f64; 2]) -> f64 {
    let cell = cell(uv.map(|x| x * 10.0), 10, 0.3, SEED + 60);
    let [x, y] = cell.offset;
    let bowl = ((x * x + y * y) * 1.7).min(1.0);
    let lip = smooth_step(0.10, 0.0, cell.border);
    (0.15 + 0.6 * bowl + 0.15 * lip + 0.03 * tile(uv, 32, 2, SEED + 65)).min(1.0)
}

/// Bands from dull to polished, with fine lines along u, as a brush leaves them.
fn stripes([u, v]: [f64; 2]) -> f64 {
    let band = (v * 4.0).floor() as i64 % 2;
    let line = noise([u * 2.0, v * 128.0, 0.5], 128, SEED + 70);
    if band == 0 { 0.95 + 0.05 * line } else { 0.10 + 0.12 * line }
}

/// Bright metal with dark scratches, each a thin line that ends.
fn scratches(uv: [f64; 2]) -> f64 {
    let mut bright: f64 = 0.85 + 0.3 * tile(uv, 6, 4, SEED + 80);
    for index in 0..40 {
        let own = |shift: u32| unit(super::noise::hash([index, 7, 0], SEED).rotate_left(shift));
        let [cos, sin] = turn(own(3) * 0.1 + if index % 3 == 0 { 0.2 } else { 0.0 });
        // The nearest of the line's images on the tiles around.
        let [x, y] = [uv[0] - own(9), uv[1] - own(17)].map(|x| x - x.round());
        let (along, across) = (x * cos + y * sin, y * cos - x * sin);
        let length = 0.1 + 0.25 * own(25);
        if along.abs() < length && across.abs() < 0.004 * (1.0 - along.abs() / length) {
            bright = 0.12;
        }
    }
    bright
}

/// Plates of cooled rock, with glowing cracks between.
fn lava_cracks(uv: [f64; 2]) -> f64 {
    let bent = |seed| 0.5 * tile(uv, 8, 3, SEED + seed);
    let cell = cell([uv[0] * 6.0 + bent(90), uv[1] * 6.0 + bent(95)], 6, 0.4, SEED + 99);
    cell.border + 0.10 * tile(uv, 24, 3, SEED + 100)
}

fn lava_height(uv: [f64; 2]) -> f64 {
    0.75 * smooth_step(0.0, 0.22, lava_cracks(uv)) + 0.15 + 0.25 * tile(uv, 16, 4, SEED + 110)
}

fn lava_glow() -> Picture {
    let palette = Palette::new(64, &[&[0x00_0000, 0x50_0600, 0xc0_2800, 0xff_7a10, 0xff_d060]]);
    Picture::indexed(256, 256, &palette, |uv| {
        let heat = 0.75 + 0.9 * tile(uv, 3, 2, SEED + 120);
        palette.index(0, heat * smooth_step(0.16, -0.03, lava_cracks(uv)))
    })
}

/// A rose window, of sixteen equal parts: panes in rings between bars of lead, with clear glass around.
fn rose_window() -> Picture {
    const GLASS: [&[u32]; 8] = [
        &[0, 0x1c_3fa8, 0x6a_90f0],
        &[0, 0xc8_1e2c, 0xff_6a60],
        &[0, 0xf0_b020, 0xff_f090],
        &[0, 0x1a_8a5a, 0x60_d8a0],
        &[0, 0x7a_2a9a, 0xc0_78e0],
        &[0, 0x20_90c8, 0x80_d8f8],
        &[0, 0xe8_6018, 0xff_b068],
        &[0, 0xff_ffff],
    ];
    let palette = Palette::new(32, &GLASS);
    Picture::indexed(256, 256, &palette, |uv| {
        let mut point = uv.map(|x| 2.0 * x - 1.0);
        let mut part = 0;
        // Halves, quarters, eighths and sixteenths, each mirrored onto the first.
        point = point.map(f64::abs);
        for angle in [1.0 / 8.0, 1.0 / 16.0] {
            let [cos, sin] = turn(angle);
            let above = point[1] * cos - point[0] * sin;
            if above > 0.0 {
                point = [point[0] + 2.0 * above * sin, point[1] - 2.0 * above * cos];
                part += 1;
            }
        }
        let [x, y] = point;
        let radius = (x * x + y * y).sqrt();
        let circle = |cx: f64, r: f64| ((x - cx) * (x - cx) + y * y).sqrt() - r;
        // The distances to the leads, and the pane between them.
        let rings = [0.13, 0.20, 0.52, 0.60, 0.93];
        let mut lead = rings.iter().map(|ring| (radius - ring).abs()).fold(f64::INFINITY, f64::min);
        let ring = rings.iter().filter(|&&ring| radius > ring).count();
        let [cos, sin] = turn(1.0 / 16.0);
        let spoke = (y * cos - x * sin).abs();
        let mut pane = ring * 2 + part;
        match ring {
            1 | 3 => lead = lead.min(spoke.min(y.abs())),
            2 => {
                lead = lead.min(spoke).min(circle(0.40, 0.085).abs());
                pane = if circle(0.40, 0.085) < 0.0 { 2 } else { 5 + part };
            }
            4 => {
                lead = lead.min(spoke).min(circle(0.76, 0.125).abs()).min(circle(0.76, 0.05).abs());
                pane = match () {
                    () if circle(0.76, 0.05) < 0.0 => 2,
                    () if circle(0.76, 0.125) < 0.0 => 1 + 3 * part,
                    () => 7 + 5 * part,
                };
            }
            _ => {}
        }
        let light = 0.5 + 0.5 * tile(uv, 12, 3, SEED + 130);
        let clear = smooth_step(0.008, 0.016, lead);
        // Clear beyond the window.
        if ring == 5 { palette.index(7, clear) } else { palette.index(pane % 7, light * clear) }
    })
}
