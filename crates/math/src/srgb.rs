//! Between sRGB bytes and linear light (IEC 61966-2-1): 0 is no light, 65535 the greatest.
//!
//! ```text
//! light = s / 12.92                      for s = byte/255 up to 0.04045
//!         ((s + 0.055) / 1.055)^2.4      above
//! ```

/// The light of a byte.
///
/// # Precision
/// Correctly rounded, and `to_byte(to_light(byte))` is the byte. A step of the byte is 19 steps of light or more.
///
/// # Cost
/// A load from a table of 512 bytes.
#[must_use]
#[inline]
pub const fn to_light(byte: u8) -> u16 {
    LIGHT[byte as usize]
}

/// The byte of a light.
///
/// # Precision
/// Correctly rounded, for all 65536.
///
/// # Cost
/// Up to three comparisons, and two loads from tables of 1,054 bytes.
#[must_use]
#[inline]
pub fn to_byte(light: u16) -> u8 {
    let least = LEAST.get(interval(light)).copied().unwrap_or_default();
    least + u8::from(BEGIN.get(usize::from(least)).is_some_and(|&begin| begin <= light))
}

/// The interval that a light is in. They are wide where steps of the byte are, and narrower than these.
#[inline]
const fn interval(light: u16) -> usize {
    let interval = match light {
        ..2048 => light >> 4,
        2048..16384 => 96 + (light >> 6),
        16384.. => 288 + (light >> 8),
    };
    interval as usize
}

/// The light of a share of sRGB, from 0 to 1, of which 1 is the greatest.
///
/// # Precision
/// Within 10^-15.
///
/// # Cost
/// 33 divisions in `f64`: for colours that are decoded once.
#[must_use]
pub const fn light(s: f64) -> f64 {
    if s <= 0.04045 {
        return s / 12.92;
    }
    let t = (s + 0.055) / 1.055;
    // The fifth root by Newton's iteration, which falls towards it from 1.
    let mut root = 1.0;
    let mut step = 0;
    while step < 16 {
        root -= (root - t / (root * root * root * root)) / 5.0;
        step += 1;
    }
    t * t * root * root
}

/// The light of each byte.
const LIGHT: [u16; 256] = {
    let mut light = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        light[byte] = floor(scaled(byte, 0.0) + 0.5);
        byte += 1;
    }
    light
};

/// The least light of each byte from 1 to 255.
const BEGIN: [u16; 255] = {
    let mut begin = [0; 255];
    let mut byte = 0;
    while byte < 255 {
        // No border between bytes is a whole number.
        begin[byte] = floor(scaled(byte, 0.5)) + 1;
        byte += 1;
    }
    begin
};

/// The byte of the least light in each interval.
const LEAST: [u8; interval(u16::MAX) + 1] = {
    let mut least = [0; interval(u16::MAX) + 1];
    let (mut light, mut byte) = (u16::MAX, 255);
    loop {
        while byte > 0 && light < BEGIN[byte - 1] {
            byte -= 1;
        }
        // The least of them comes last.
        least[interval(light)] = byte.to_le_bytes()[0];
        if light == 0 {
            break least;
        }
        light -= 1;
    }
};

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 65535.5")]
const fn floor(light: f64) -> u16 {
    light as u16
}

/// 65535 times the light of a byte, or of a place beyond it.
#[expect(clippy::cast_precision_loss, reason = "a byte")]
const fn scaled(byte: usize, beyond: f64) -> f64 {
    65535.0 * light((byte as f64 + beyond) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `f64`, by the functions of the platform; that it is not near a tie says that it is precise enough.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 65535")]
    fn nearest(x: f64) -> u32 {
        assert!((x.fract() - 0.5).abs() > 1e-7, "{x} is too near a tie");
        x.round() as u32
    }

    #[test]
    fn all_bytes() {
        for byte in 0..=255u8 {
            let s = f64::from(byte) / 255.0;
            let light = if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) };
            assert!((super::light(s) - light).abs() < 1e-15, "{byte}");
            assert_eq!(u32::from(to_light(byte)), nearest(65535.0 * light), "{byte}");
            assert_eq!(to_byte(to_light(byte)), byte);
        }
    }

    #[test]
    fn all_lights() {
        for light in 0..=u16::MAX {
            let linear = f64::from(light) / 65535.0;
            let s =
                if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
            assert_eq!(u32::from(to_byte(light)), nearest(255.0 * s), "{light}");
        }
    }
}
