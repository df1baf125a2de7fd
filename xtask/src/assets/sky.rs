//! One surrounding, an evening over fields, in the three shapes in which environment maps come.

use super::noise::{dot, fractal, mix, normalized, smooth_step, turn};
use super::picture::{Picture, html};

const SEED: u32 = 0x5C1E_0000;

/// Places in a texel, by column and by row: borders of fields and hills are thinner than a texel.
const SIDE: usize = 3;

/// The three maps, under their names.
pub(super) fn maps() -> Vec<(&'static str, Picture)> {
    vec![("sky-lat-long", lat_long()), ("sky-cube", cube()), ("sky-sphere", sphere())]
}

/// The light that comes from a unit direction, y up, sRGB from 0 to 1.
fn light([x, y, z]: [f64; 3]) -> [f64; 3] {
    let far = fractal([x * 6.0 + 8.0, 4.5, z * 6.0 + 8.0], 64, 4, SEED);
    let hills = 0.035 + 0.10 * far.max(-0.3);
    let land = smooth_step(hills + 0.007, hills - 0.007, y);
    if land == 1.0 {
        return ground([x, y, z], hills);
    }
    // Where the direction meets the clouds, a layer at height 1.
    let reach = 1.0 / (y + 0.12);
    let cloud = fractal([x * reach + 32.0, 0.5, z * reach * 1.6 + 32.0], 64, 5, SEED + 20);
    let sun = dot([x, y, z], normalized([0.55, 0.36, 0.75]));
    let glow = smooth_step(0.55, 1.0, sun);
    let above = mix(html(0xf6_d8b0), html(0x8f_bce0), smooth_step(0.0, 0.28, y));
    let above = mix(above, html(0x24_569c), smooth_step(0.2, 0.95, y));
    let above = mix(above, html(0xff_e8b8), 0.75 * glow * glow);
    let lit = mix(html(0xb0_aab4), html(0xff_f4e2), smooth_step(0.02, 0.30, cloud) * (0.6 + 0.4 * glow));
    let color = mix(above, lit, smooth_step(-0.02, 0.16, cloud) * smooth_step(0.02, 0.2, y));
    let color = mix(color, [1.0, 1.0, 0.94], smooth_step(0.985, 0.992, sun));
    mix(color, ground([x, y, z], hills), land)
}

/// Hills against the sky, and in front of them strips of field.
fn ground([x, y, z]: [f64; 3], hills: f64) -> [f64; 3] {
    if y > -0.015 {
        let shade = smooth_step(-0.015, hills, y);
        return mix(html(0x5a_6a58), html(0x3c_5064), shade);
    }
    let reach = 1.0 / (0.02 - y);
    let (along, across) = (x * reach, z * reach);
    let strip = (across * 0.9 + 0.4 * fractal([along * 0.3 + 32.0, 2.5, 9.0], 64, 2, SEED + 30)).floor();
    let kind = strip.rem_euclid(3.0);
    let field = match () {
        () if kind < 0.5 => html(0x7c_8a3a),
        () if kind < 1.5 => html(0xa8_8c48),
        () => html(0x4e_6a30),
    };
    let grain = 1.0 + 0.5 * fractal([along * 3.0 + 32.0, 1.5, across * 3.0 + 32.0], 4096, 2, SEED + 40);
    let near = mix(html(0x5e_5444), field, smooth_step(0.95, 0.55, -y));
    mix(near.map(|c| c * grain), html(0x8c_9078), smooth_step(-0.10, -0.015, y))
}

/// All around, and from straight down to straight up: u grows to the right as one looks at the horizon, v upwards, and
/// -z is in the middle.
fn lat_long() -> Picture {
    Picture::averaged(1024, 512, SIDE, |[u, v]| {
        let ([cos, sin], [out, up]) = (turn(u), turn((v - 0.5) / 2.0));
        light([-sin * out, up, cos * out])
    })
}

/// Six faces one below the other, +x, -x, +y, -y, +z, -z, each as section 8.13 of the OpenGL 4.6 specification lays it.
fn cube() -> Picture {
    Picture::averaged(256, 6 * 256, SIDE, |[u, v]| {
        // t grows downwards: OpenGL counts an image's rows as they lie in memory.
        let down = (1.0 - v) * 6.0;
        let face = down.floor();
        let (s, t) = (2.0 * u - 1.0, 2.0 * (down - face) - 1.0);
        light(normalized(match face as u8 {
            0 => [1.0, -t, -s],
            1 => [-1.0, -t, s],
            2 => [s, 1.0, t],
            3 => [s, -1.0, -t],
            4 => [s, -t, 1.0],
            _ => [-s, -t, -1.0],
        }))
    })
}

/// A mirror ball seen from far away along -z, as section 12.1 of the OpenGL 1.3 specification maps reflected rays: the
/// middle shows what is behind the eye, the rim what is in front of it.
fn sphere() -> Picture {
    Picture::averaged(512, 512, SIDE, |uv| {
        let [x, y] = uv.map(|x| 2.0 * x - 1.0);
        let square = x * x + y * y;
        // Beyond the rim, what is on it.
        let shrink = if square > 0.999 { (0.999 / square).sqrt() } else { 1.0 };
        let (x, y) = (x * shrink, y * shrink);
        let z = (1.0 - x * x - y * y).sqrt();
        // (0, 0, -1) mirrored by the normal (x, y, z).
        light([2.0 * z * x, 2.0 * z * y, 2.0 * z * z - 1.0])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assets::picture::Pixels;

    /// The texel at (s, t), t from the top, from 0 to 1.
    fn texel(picture: &Picture, [s, t]: [f64; 2]) -> [f64; 3] {
        let Pixels::Rgb(pixels) = &picture.pixels else { panic!() };
        let height = pixels.len() / picture.width;
        let index = |x: f64, side: usize| ((x * side as f64) as usize).min(side - 1);
        pixels[index(t, height) * picture.width + index(s, picture.width)].map(f64::from)
    }

    /// Where OpenGL looks for a direction in a cube map: table 8.19 of the specification.
    fn place_on_cube([x, y, z]: [f64; 3]) -> [f64; 2] {
        let [ax, ay, az] = [x, y, z].map(f64::abs);
        let (face, s, t, major) = if ax >= ay && ax >= az {
            if x > 0.0 { (0.0, -z, -y, ax) } else { (1.0, z, -y, ax) }
        } else if ay >= az {
            if y > 0.0 { (2.0, x, z, ay) } else { (3.0, x, -z, ay) }
        } else if z > 0.0 {
            (4.0, x, -y, az)
        } else {
            (5.0, -x, -y, az)
        };
        [(s / major + 1.0) / 2.0, (face + (t / major + 1.0) / 2.0) / 6.0]
    }

    #[test]
    fn the_three_maps_show_the_same() {
        let maps: Vec<Picture> = maps().into_iter().map(|(_, map)| map).collect();
        let (mut differences, mut count) = ([0.0; 2], 0.0);
        for step in 0..2000 {
            let t = (f64::from(step) + 0.5) / 2000.0;
            let (up, [cos, sin]) = (1.0 - 2.0 * t, turn(t * 618.0));
            let out = (1.0 - up * up).sqrt();
            let d @ [x, y, z] = [sin * out, up, cos * out];
            let latitude = y.asin() / std::f64::consts::PI;
            let longitude = x.atan2(-z) / std::f64::consts::TAU;
            let truth = texel(&maps[0], [0.5 + longitude, 0.5 - latitude]);
            let m = 2.0 * (x * x + y * y + (z + 1.0) * (z + 1.0)).sqrt();
            let places = [place_on_cube(d), [x / m + 0.5, 0.5 - y / m]];
            for (index, place) in places.into_iter().enumerate() {
                let found = texel(&maps[index + 1], place);
                differences[index] += (0..3).map(|i| (found[i] - truth[i]).abs()).sum::<f64>() / 3.0;
            }
            count += 1.0;
        }
        // Texels are of different sizes; one face of the six that is mirrored makes it 6.
        assert!(differences.iter().all(|sum| sum / count < 4.5), "{:?}", differences.map(|sum| sum / count));
    }
}
