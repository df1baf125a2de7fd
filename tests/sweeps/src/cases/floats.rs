//! All floats through functions of one: the texel that a coordinate names, and the nearest byte of a share.

use super::ensure;
use crate::Found;
use alberti::glam::Vec2;
use alberti::lanes::{Lanes as _, One};
use alberti_texture::format::L8;
use alberti_texture::{AnyWrap, Nearest, Texture};

/// Floats of a block.
const FLOATS: u64 = 1 << 20;

/// The texels of a row are their own numbers.
const TEXELS: [u8; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// The column of a texture so wide that `u` is in, by exact integers; nothing where `u` is no number.
fn column(wrap: AnyWrap, u: f32, width: i128) -> Option<i128> {
    if !u.is_finite() {
        return None;
    }
    // u = significand · 2^exponent.
    let (field, low) = (u.to_bits() >> 23 & 0xff, i128::from(u.to_bits() & 0x007f_ffff));
    let (magnitude, exponent) =
        if field == 0 { (low, -149) } else { (low | 0x0080_0000, field.cast_signed() - 150) };
    let significand = if u < 0.0 { -magnitude } else { magnitude };
    // ⌊u · width⌋ modulo twice the width: whole multiples of 2 do not count.
    let floor = if exponent >= 0 {
        // From 2^24 on all are even, and before, the product is small.
        if exponent > 40 { 0 } else { ((significand << exponent) * width).rem_euclid(2 * width) }
    } else if exponent < -100 {
        if significand < 0 { -1 } else { 0 }
    } else {
        (significand * width) >> -exponent
    };
    Some(match wrap {
        AnyWrap::Clamp if u >= 1.0 => width - 1,
        AnyWrap::Clamp if u < 0.0 => 0,
        AnyWrap::Clamp => floor,
        AnyWrap::Mirror => {
            let place = floor.rem_euclid(2 * width);
            if place < width { place } else { 2 * width - 1 - place }
        }
        _ => floor.rem_euclid(width),
    })
}

/// A part of all floats.
///
/// # Errors
/// A float with another texel, or another byte, than it should have.
pub fn block(block: u64, _: u64) -> Result<Found, String> {
    let mut cases = 0;
    for bits in block * FLOATS..(block + 1) * FLOATS {
        let u = f32::from_bits(bits as u32);
        for width in [16_u8, 7] {
            let texture = Texture::new(L8, &TEXELS[..usize::from(width)], width.into(), 1);
            let Ok(texture) = texture else { return Err("no texture".to_owned()) };
            for wrap in [AnyWrap::Repeat, AnyWrap::Mirror, AnyWrap::Clamp] {
                let found = texture.sampler(Nearest, wrap).sample(Vec2::new(u, 0.5)).to_bytes()[0];
                let expected = column(wrap, u, width.into());
                let fits = expected.is_none_or(|column| i128::from(found) == column);
                ensure!(
                    fits && found < width,
                    "{u:?} ({bits:#x}) of {width} texels, {wrap:?}: {found}, not {expected:?}"
                );
                cases += 1;
            }
        }
        for most in [255, 63, 31] {
            let found = One.of_unit(u, most).0;
            // Products of 32 bits and 8 are exact. The lane's is rounded before its half is.
            let exact = f64::from(u) * f64::from(most);
            let off = (f64::from(found) - exact.clamp(0.0, f64::from(most))).abs();
            ensure!(
                u.is_nan() && found <= u32::from(most) || off <= 0.5 + f64::from(most) / 16_777_216.0,
                "{u:?} of {most}: {found}"
            );
            cases += 1;
        }
    }
    Ok(Found { cases, worst: 0.0 })
}
