//! Decimal numbers as OBJ files have them, quickly.

/// The powers of ten that an f64 holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// A number that is finite as an f32 too, correctly rounded to an f64.
///
/// Digits with a point, as long as they fit 53 bits, are an exact integer and an exact power of ten. So one division
/// rounds once (Clinger, How to read floating point numbers accurately, 1990). All else is left to `str::parse`.
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    simple(word).or_else(|| any(word))
}

fn simple(word: &[u8]) -> Option<f64> {
    let (negative, digits) = match word.split_first()? {
        (b'-', rest) => (true, rest),
        _ => (false, word),
    };
    // 18 digits and the point cannot overflow 64 bits.
    if digits.len() > 19 {
        return None;
    }
    let (mut mantissa, mut count, mut point) = (0_u64, 0_usize, None);
    for &byte in digits {
        match byte {
            b'0'..=b'9' => {
                mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
                count += 1;
            }
            b'.' if point.is_none() => point = Some(count),
            _ => return None,
        }
    }
    if count == 0 || count > 18 || mantissa > 1 << 53 {
        return None;
    }
    #[expect(clippy::cast_precision_loss, reason = "at most 53 bits")]
    let value = mantissa as f64 / POWERS.get(count - point.unwrap_or(count))?;
    Some(if negative { -value } else { value })
}

fn any(word: &[u8]) -> Option<f64> {
    let value: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    // The largest numbers round to an infinity in f32.
    crate::scene::normals::narrow(value).is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_standard_library() {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        for _ in 0..20_000 {
            let (digits, places) = (random() >> (random() % 60), usize::try_from(random() % 22).unwrap());
            let mut word = format!("{digits:0>width$}", width = places + 1);
            word.insert(word.len() - places, '.');
            if random() & 1 == 1 {
                word.insert(0, '-');
            }
            let wanted: f64 = word.parse().unwrap();
            assert_eq!(number(word.as_bytes()).map(f64::to_bits), Some(wanted.to_bits()), "{word}");
        }
        for (word, wanted) in
            [("-0", -0.0), ("7", 7.0), (".5", 0.5), ("5.", 5.0), ("+1e3", 1000.0), ("-1E-2", -0.01)]
        {
            assert_eq!(number(word.as_bytes()).map(f64::to_bits), Some(f64::to_bits(wanted)), "{word}");
        }
    }

    #[test]
    fn what_is_no_finite_number_is_none() {
        for bad in
            ["", "-", ".", "-.", "nan", "inf", "1e400", "1e39", "-1e39", "1,5", "0x10", "1.2.3", "--1", "1-"]
        {
            assert_eq!(number(bad.as_bytes()), None, "{bad}");
        }
        assert_eq!(number(b"\xff"), None);
    }
}
