//! A ball as the guide's model, and its picture by rays in `f64`.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::command::Outcome;

/// Parts of the way from pole to pole, and around.
const RINGS: u32 = 24;
const SECTORS: u32 = 48;
/// The color of its texture, and the one of the display behind it in five and six bits.
const COLOR: [u8; 3] = [230, 180, 120];
const BACKGROUND: [u8; 3] = [32, 36, 40];
/// The display.
const SIZE: [u16; 2] = [320, 240];
/// Half of the lens's angle, and the distance of the eye from the middle.
const HALF_ANGLE: f64 = 0.35;
const DISTANCE: f64 = 3.0;

/// Writes `model.obj` and `model.png`.
pub(super) fn write(folder: &Path) -> Outcome {
    let texture = folder.join("model.png");
    let file =
        fs::File::create(&texture).map_err(|error| format!("cannot write {}: {error}", texture.display()))?;
    let mut encoder = png::Encoder::new(file, 8, 8);
    encoder.set_color(png::ColorType::Rgb);
    let image = encoder.write_header().and_then(|mut writer| writer.write_image_data(&COLOR.repeat(64)));
    image.map_err(|error| format!("cannot write {}: {error}", texture.display()))?;
    let model = folder.join("model.obj");
    fs::write(&model, object()).map_err(|error| format!("cannot write {}: {error}", model.display()))
}

/// The ball of radius 2 around (1, 0, 0), as OBJ.
fn object() -> String {
    let mut text = String::new();
    for ring in 0..=RINGS {
        for sector in 0..=SECTORS {
            let (v, u) = (f64::from(ring) / f64::from(RINGS), f64::from(sector) / f64::from(SECTORS));
            let ((sin, y), (z, x)) =
                ((v * std::f64::consts::PI).sin_cos(), (u * std::f64::consts::TAU).sin_cos());
            let normal = [sin * x, y, -sin * z];
            let [x, y, z] = [1.0 + 2.0 * normal[0], 2.0 * normal[1], 2.0 * normal[2]];
            writeln!(text, "v {x} {y} {z}\nvt {u} {}", 1.0 - v).expect("strings grow");
            writeln!(text, "vn {} {} {}", normal[0], normal[1], normal[2]).expect("strings grow");
        }
    }
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let first = ring * (SECTORS + 1) + sector + 1;
            let [a, b, c, d] = [first, first + SECTORS + 1, first + SECTORS + 2, first + 1];
            writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c} {d}/{d}/{d}").expect("strings grow");
        }
    }
    text
}

/// Compares a picture with the ball as rays see it under the guide's light.
///
/// A thousand flat triangles lie up to 0.012 within the ball, so its border is left out: no ray that passes the middle
/// by 0.96 to 1.01 radii is looked at.
pub(super) fn compare(picture: &[u8]) -> Outcome {
    let pixels = picture
        .strip_prefix(b"P6 320 240 255\n")
        .filter(|pixels| pixels.len() == usize::from(SIZE[0]) * usize::from(SIZE[1]) * 3)
        .ok_or("the picture is not one of 320x240 in PPM")?;
    let places = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]));
    for ([column, row], pixel) in places.zip(pixels.chunks_exact(3)) {
        let Some(expected) = expected(column, row) else { continue };
        if pixel.iter().zip(expected).any(|(&found, expected)| found.abs_diff(expected) > TOLERANCE) {
            return Err(format!("pixel ({column}, {row}) is {pixel:?}, and rays have {expected:?}"));
        }
    }
    Ok(())
}

/// Steps of 255 that a channel may be off: 8 for five bits, and as many for light that is interpolated from vertices.
const TOLERANCE: u8 = 16;

/// The color that a ray through the middle of a pixel finds; none near the border.
fn expected(column: u16, row: u16) -> Option<[u8; 3]> {
    let [width, height] = SIZE.map(f64::from);
    let scale = HALF_ANGLE.tan() / (height / 2.0);
    let x = (f64::from(column) + 0.5 - width / 2.0) * scale;
    let y = (height / 2.0 - f64::from(row) - 0.5) * scale;
    let length = (x * x + y * y + 1.0).sqrt();
    let [x, y, z] = [x / length, y / length, -1.0 / length];
    // The distance of the ray's nearest point to the middle, and of that from the eye.
    let along = -DISTANCE * z;
    let missed = (DISTANCE * DISTANCE - along * along).sqrt();
    if missed > 1.01 {
        return Some(BACKGROUND);
    }
    if missed > 0.96 {
        return None;
    }
    let distance = along - (1.0 - missed * missed).sqrt();
    let normal = [x * distance, y * distance, DISTANCE + z * distance];
    let cosine = -0.5 * normal[0] + 0.6 * normal[1] + 0.6 * normal[2];
    let light = 0.3 + 0.7 * cosine.max(0.0);
    Some(COLOR.map(|channel| lit(channel, light)))
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "light is from 0 to 1")]
fn lit(channel: u8, light: f64) -> u8 {
    (f64::from(channel) * light) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_meet_the_ball_where_it_is() {
        assert_eq!(expected(0, 0), Some(BACKGROUND));
        // The middle is lit by 0.3 + 0.7 * 0.6.
        let middle = expected(160, 120).unwrap();
        assert!(middle.iter().zip(COLOR).all(|(&c, full)| c.abs_diff(lit(full, 0.72)) <= 1));
        let seen = (0..SIZE[0]).filter(|&column| expected(column, 120) != Some(BACKGROUND)).count();
        // The sine of the ball's half angle is a third.
        let half = 120.0 * (1.01 / 3.0_f64).asin().tan() / 0.35_f64.tan();
        assert!((f64::from(u16::try_from(seen).unwrap()) - 2.0 * half).abs() <= 2.0, "{seen}");
    }

    #[test]
    fn a_picture_of_nothing_is_refused() {
        let empty = [b"P6 320 240 255\n".to_vec(), BACKGROUND.repeat(320 * 240)].concat();
        assert!(compare(&empty).unwrap_err().contains("rays have"));
        assert!(compare(&empty[1..]).unwrap_err().contains("320x240"));
    }
}
