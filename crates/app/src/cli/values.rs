//! How the words of the command line become values.

use crate::options::MAX_SIDE;

pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    sides
        .filter(|(w, h)| (1..=MAX_SIDE).contains(w) && (1..=MAX_SIDE).contains(h))
        .ok_or_else(|| format!("WIDTHxHEIGHT with 1 to {MAX_SIDE} pixels each, such as 640x480"))
}

pub(super) fn point(text: &str) -> Result<[f32; 3], String> {
    let expected = || "three finite numbers X,Y,Z without spaces, such as 0,1.5,-3".to_owned();
    let numbers: Vec<f32> = text.split(',').map(finite).collect::<Option<_>>().ok_or_else(expected)?;
    numbers.try_into().map_err(|_| expected())
}

pub(super) fn number(text: &str) -> Result<f32, String> {
    finite(text).ok_or_else(|| "a finite number".to_owned())
}

/// Two numbers.
pub(super) fn range(text: &str) -> Result<[f32; 2], String> {
    let pair = text.split_once(',').and_then(|(low, high)| Some([finite(low)?, finite(high)?]));
    pair.ok_or_else(|| "two finite numbers LO,HI without spaces, such as -0.05,0".to_owned())
}

/// The highlight's exponents; one stands for both.
pub(super) fn shininess(text: &str) -> Result<[f32; 2], String> {
    let pair = match text.split_once(',') {
        Some(_) => range(text).ok(),
        None => finite(text).map(|both| [both; 2]),
    };
    pair.filter(is_shininess).ok_or_else(|| format!("{SHININESS}, without spaces, such as 8,64"))
}

/// See [`is_shininess`].
pub(crate) const SHININESS: &str = "a number from 0 to 65536, or a least and a greatest";

/// The greatest exponent of a highlight: that of the library, 2^16.
pub(crate) const MAX_SHININESS: f32 = 65536.0;

/// Whether these are exponents of a highlight.
pub(crate) fn is_shininess([least, greatest]: &[f32; 2]) -> bool {
    least <= greatest && *least >= 0.0 && *greatest <= MAX_SHININESS
}

/// From 0 to 1.
pub(super) fn share(text: &str) -> Result<f32, String> {
    finite(text).filter(|x| (0.0..=1.0).contains(x)).ok_or_else(|| "a number from 0 to 1".to_owned())
}

/// How steep.
pub(super) fn strength(text: &str) -> Result<f32, String> {
    finite(text).filter(|x| (0.0..=100.0).contains(x)).ok_or_else(|| "a number from 0 to 100".to_owned())
}

fn finite(text: &str) -> Option<f32> {
    text.trim().parse().ok().filter(|x: &f32| x.is_finite())
}

pub(crate) fn color(text: &str) -> Result<[u8; 3], String> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let value = u32::from_str_radix(digits, 16).ok();
    // from_str_radix takes a sign as well.
    let value = value.filter(|_| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit()));
    let [_, r, g, b] = value.ok_or("six hexadecimal digits RRGGBB, such as 20242c")?.to_be_bytes();
    Ok([r, g, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert_eq!(size("16384X1"), Ok((16384, 1)));
        assert_eq!(point("-1,2.5,3e2"), Ok([-1.0, 2.5, 300.0]));
        assert_eq!(color("20242c"), Ok([0x20, 0x24, 0x2c]));
        assert_eq!(color("#FFffFF"), Ok([255; 3]));
        assert_eq!(range("-0.5,1"), Ok([-0.5, 1.0]));
        assert_eq!(shininess("8"), Ok([8.0, 8.0]));
        assert_eq!(shininess("8,64"), Ok([8.0, 64.0]));
        assert_eq!(shininess("65536"), Ok([65536.0; 2]));
    }

    #[test]
    fn what_is_no_value_is_refused() {
        for text in ["", "640", "0x480", "640x0", "100000x100000", "16385x1", "-1x5", "axb", "1x2x3"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "inf,0,0", "1e400,0,0"] {
            assert!(point(text).is_err(), "{text}");
        }
        for text in ["", "fff", "gggggg", "+12345", "-12345", "1234567", "ééé"] {
            assert!(color(text).is_err(), "{text}");
        }
        for text in ["", "1", "1,2,3", "nan,1", "1, "] {
            assert!(range(text).is_err(), "{text}");
        }
        for text in ["", "-1", "9,8", "1,2,3", "65537"] {
            assert!(shininess(text).is_err(), "{text}");
        }
        assert!(share("1.5").is_err() && share("-0.1").is_err() && strength("101").is_err());
        assert!(number("nan").is_err() && number("1e400").is_err());
    }
}
