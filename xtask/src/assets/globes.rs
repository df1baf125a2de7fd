//! Maps that wrap around a sphere once: u around the axis y, 0 towards z and growing eastwards, v from the south pole
//! to the north. They are made in space, so they have no seam, and no pinch at the poles.

use super::field::word;
use super::noise::{dot, fractal, normalized, smooth_step, turn};
use super::picture::{Palette, Picture, Pixels, places};

const SEED: u32 = 0x6106_0000;

/// Every map, under its name.
pub(super) fn maps() -> Vec<(&'static str, Picture)> {
    vec![
        ("golf-ball-normal", golf_ball()),
        ("planet-color", planet_color()),
        ("planet-height", planet_height()),
    ]
}

/// The direction from the centre.
fn direction([u, v]: [f64; 2]) -> [f64; 3] {
    let ([cos, sin], [out, up]) = (turn(u), turn((v - 0.5) / 2.0));
    [sin * out, up, cos * out]
}

/// Dimples on a ball, as normals in object space: at the points of a spiral that turns by the golden angle from each to
/// the next, which spreads them evenly.
fn golf_ball() -> Picture {
    const DIMPLES: i32 = 330;
    const GOLDEN: f64 = 0.381_966_011_250_105;
    /// The cosine at a dimple's rim, and how steep the rim is.
    const RIM: f64 = 0.994_6;
    let dimples: Vec<[f64; 3]> = (0..DIMPLES)
        .map(|index| {
            let up = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(DIMPLES);
            let ([cos, sin], out) = (turn(GOLDEN * f64::from(index)), (1.0 - up * up).sqrt());
            [sin * out, up, cos * out]
        })
        .collect();
    Picture::rgb(384, 192, |uv| {
        let d = direction(uv);
        let (mut cosine, mut centre) = (-1.0, d);
        for &dimple in &dimples {
            let product = dot(d, dimple);
            if product > cosine {
                (cosine, centre) = (product, dimple);
            }
        }
        // A bowl: it leans towards its centre, more so further out, up to a soft rim.
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let out = sine / (1.0 - RIM * RIM).sqrt();
        let lean = 0.55 * out * smooth_step(1.0, 0.86, out);
        let towards: [f64; 3] = std::array::from_fn(|i| (centre[i] - cosine * d[i]) / sine.max(1e-9));
        let normal = normalized(std::array::from_fn(|i| d[i] + lean * towards[i]));
        normal.map(|x| x * 0.5 + 0.5)
    })
}

/// Heights of land and sea, from 0 to 1: the sea lies at 0.35.
fn altitude(uv: [f64; 2]) -> f64 {
    let d = direction(uv);
    let at = |scale: f64, octaves, seed| fractal(d.map(|x| x * scale + 8.0), 64, octaves, SEED + seed);
    let continents = at(1.3, 6, 1);
    // Ridges where noise crosses zero, on land.
    let ridges = 1.0 - 3.2 * at(2.6, 5, 20).abs();
    let land = smooth_step(0.0, 0.35, continents);
    0.37 + 0.65 * continents + 0.42 * land * ridges.max(0.0)
}

const SEA: f64 = 0.35;

fn planet_height() -> Picture {
    let heights = places(512, 256).map(|uv| word(altitude(uv).max(SEA), 10)).collect();
    Picture { width: 512, pixels: Pixels::Grey16(heights) }
}

fn planet_color() -> Picture {
    let palette = Palette::new(
        64,
        &[
            &[0x06_1a3a, 0x0c_3a6c, 0x1a_6a98, 0x48_a8b8],
            &[0xc8_b888, 0x6a_8a3c, 0x3a_6a2e, 0x6e_6040, 0x8c_8070, 0xf4_f4f4],
            &[0xd0_d8e0, 0xff_ffff],
        ],
    );
    Picture::indexed(512, 256, &palette, |uv| {
        let (d, height) = (direction(uv), altitude(uv));
        let rough = fractal(d.map(|x| x * 9.0 + 8.0), 64, 4, SEED + 40);
        // Ice reaches from the poles as far as it is cold.
        let cold = d[1].abs() + 0.25 * rough + 0.3 * (height - SEA).max(0.0);
        match () {
            () if cold > 0.93 => palette.index(2, 0.7 + rough),
            () if height < SEA => palette.index(0, 1.0 - (SEA - height) * 4.0),
            () => palette.index(1, (height - SEA) * 1.75 + 0.22 * rough),
        }
    })
}
