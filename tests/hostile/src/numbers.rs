//! Numbers and predicates against integers, rationals and `f64`.

use crate::bits::Bits;
use alberti_math::glam::{Vec2, Vec3};
use alberti_math::lanes::{Lanes as _, Machine, One};
use alberti_math::{
    Fixed, Octahedral, Point2, Q16, Subpixel, World, Zone, floor_i32, for_lanes, orientation, reciprocal,
    reciprocal_of_half, reciprocal_signed, round_half_up, scaled, signed_area, srgb,
};
use alberti_oracle::rational::{Rational, from_f32, from_int, to_f64};
use std::cmp::Ordering;

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    match bits.below(6) {
        0 => predicates(&mut bits),
        1 => fixed_point(&mut bits),
        2 => reciprocals(&mut bits),
        3 => conversions(&mut bits),
        4 => colours(&mut bits),
        _ => lanes(&mut bits),
    }
}

/// The doubled area, exactly.
fn doubled(points: [[f32; 2]; 3]) -> Rational {
    let [a, b, c] = points.map(|point| point.map(from_f32));
    let [[abx, aby], [acx, acy]] = [b, c].map(|p| [&p[0] - &a[0], &p[1] - &a[1]]);
    abx * acy - aby * acx
}

fn predicates(bits: &mut Bits<'_>) {
    let points: [[f32; 2]; 4] = [(); 4].map(|()| bits.floats());
    let at = |[x, y]: [f32; 2]| Point2::<World>::new(Vec2::new(x, y));
    let [a, b, c, p] = points.map(at);
    let found = orientation(a, b, c);
    let finite = |points: &[[f32; 2]]| points.iter().flatten().all(|x| x.is_finite());
    if !finite(&points[..3]) {
        assert_eq!(found, None);
        assert!(signed_area(a, b, c).is_nan());
        return;
    }
    let exact = doubled([points[0], points[1], points[2]]);
    assert_eq!(found, Some(exact.cmp(&from_int(0))), "{points:?}");
    let area = signed_area(a, b, c);
    let half = to_f64(&(exact / from_int(2)));
    if half.abs() < f64::from(f32::MAX) {
        let unit = 1.05 * 2f64.powi(-24) * half.abs().max(f64::from(f32::MIN_POSITIVE));
        assert!((f64::from(area) - half).abs() <= unit, "{area} for {half}: {points:?}");
    } else {
        // Rounded to the nearest, it may be the greatest number as well.
        assert!(f64::from(area).abs() >= f64::from(f32::MAX) && !area.is_nan());
    }
    if finite(&points) {
        zones([a, b, c], p, points);
    }
}

fn zones(triangle: [Point2<World>; 3], p: Point2<World>, points: [[f32; 2]; 4]) {
    let [a, b, c, at] = points;
    let sign = |points: [[f32; 2]; 3]| doubled(points).cmp(&from_int(0));
    let facing = sign([a, b, c]);
    let found = Zone::of(p, triangle);
    if facing == Ordering::Equal {
        assert_eq!(found, None);
        return;
    }
    let signs = [sign([b, c, at]), sign([c, a, at]), sign([a, b, at])];
    let signs = signs.map(|sign| if facing == Ordering::Less { sign.reverse() } else { sign });
    let places = |of| [0, 1, 2].into_iter().filter(|&k| signs[k] == of).collect::<Vec<usize>>();
    let (negative, zero) = (places(Ordering::Less), places(Ordering::Equal));
    let expected = match (negative.as_slice(), zero.as_slice()) {
        ([], []) => Zone::Inside,
        ([], [k]) => Zone::OnEdge(*k),
        ([], [k, l]) => Zone::OnVertex(3 - k - l),
        ([k], _) => Zone::BeyondEdge(*k),
        ([k, l], _) => Zone::BeyondVertex(3 - k - l),
        other => unreachable!("{other:?}: {points:?}"),
    };
    assert_eq!(found, Some(expected), "{points:?}");
}

fn fixed_point(bits: &mut Bits<'_>) {
    let [a, b] = [(); 2].map(|()| bits.word().cast_signed());
    let [x, y] = [a, b].map(Q16::from_bits);
    let [wide_a, wide_b] = [a, b].map(i64::from);
    let clamp = |wide: i64| wide.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
    let product = (wide_a * wide_b + (1 << 15)) >> 16;
    assert_eq!((x * y).to_bits(), product as i32);
    assert_eq!(x.saturating_mul(y).to_bits(), clamp(product));
    assert_eq!((x + y).to_bits(), a.wrapping_add(b));
    assert_eq!(x.saturating_sub(y).to_bits(), clamp(wide_a - wide_b));
    let quotient = if b == 0 { 0 } else { clamp((wide_a << 16) / wide_b) };
    assert_eq!((x / y).to_bits(), quotient, "{a} / {b}");
    // Conversions, to the nearest, halves away from 0.
    let float = bits.float();
    let shift = bits.below(40) as i32 - 8;
    let exact = f64::from(float) * 2f64.powi(shift);
    let expected =
        if float.is_nan() { 0 } else { exact.round().clamp(-2_147_483_648.0, 2_147_483_647.0) as i32 };
    assert_eq!(scaled(float, shift), expected, "{float} by 2^{shift}");
    let subpixel = bits.pick(&[Subpixel::Sub4, Subpixel::Sub8]);
    let center = bits.between(-40_000, 40_000) as i32;
    if let Some(snapped) = Fixed::snap(subpixel, center, float) {
        let exact = (f64::from(center) / 2.0 + f64::from(float)) * f64::from(1 << subpixel.bits());
        let off = f64::from(snapped.subpixels()) - exact;
        // Halves to either side; the offset is scaled in one rounding.
        assert!(off.abs() <= 0.5 + exact.abs() * 2f64.powi(-24), "{center} and {float}: {off}");
    }
}

fn reciprocals(bits: &mut Bits<'_>) {
    let short = |found: u64, dividend: u128, x: u128, share: i32| {
        let exact = dividend as f64 / x as f64;
        assert!(u128::from(found) * x <= dividend, "{found} is too much for {x}");
        assert!(exact - found as f64 <= exact * 2f64.powi(share), "{found} is too little for {x}");
    };
    let word = bits.word();
    let x = word | 1 << 31;
    short(reciprocal::<1>(x).into(), 1 << 63, x.into(), -17);
    // At the lower end the quotient itself is one more than fits.
    short(reciprocal::<2>(x).into(), 1 << 63, x.into(), -29 + i32::from(x < (1 << 31) + 4));
    let half = (word >> 1 & 0x3fff_ffff) | 1 << 30;
    short(reciprocal_signed(half.cast_signed()).cast_unsigned().into(), 1 << 61, half.into(), -28);
    let small = (word & 0x7fff) | 1 << 15;
    short(reciprocal_of_half(small).into(), 1 << 32, small.into(), -15);
}

fn conversions(bits: &mut Bits<'_>) {
    let x = bits.float();
    let wide = f64::from(x);
    let within = |x: f64| if x.is_nan() { 0 } else { x.clamp(-2_147_483_648.0, 2_147_483_647.0) as i32 };
    assert_eq!(floor_i32(x), within(wide.floor()), "{x}");
    assert_eq!(round_half_up(x), within((wide + 0.5).floor()), "{x}");
    let direction = Vec3::from_array(bits.floats());
    let stored = Octahedral::nearest(direction);
    let back = stored.to_vec3();
    // Components are within a 16384th.
    assert!((back.as_dvec3().length() - 1.0).abs() < 1.1e-4, "{direction}: {back}");
    let exact = direction.as_dvec3();
    if direction.is_finite() && direction != Vec3::ZERO {
        let cosine = back.as_dvec3().normalize().dot(exact / exact.length());
        assert!(cosine >= 0.65_f64.to_radians().cos(), "{direction}: {back}");
    }
    let fixed = stored.components().map(|c| f64::from(c.to_bits()) / 65536.0);
    for (fixed, float) in fixed.into_iter().zip(back.to_array()) {
        assert!((fixed - f64::from(float)).abs() < 1e-4, "{direction}: {fixed} and {float}");
    }
}

fn colours(bits: &mut Bits<'_>) {
    let byte = bits.byte();
    assert_eq!(srgb::to_byte(srgb::to_light(byte)), byte);
    let light = bits.word() as u16;
    let exact = f64::from(light) / 65535.0;
    let encoded = if exact <= 0.003_130_8 { 12.92 * exact } else { 1.055 * exact.powf(1.0 / 2.4) - 0.055 };
    // Between bytes it is the light that decides, whose steps are the smaller ones.
    assert!((f64::from(srgb::to_byte(light)) - 255.0 * encoded).abs() <= 0.56, "{light}");
}

/// One lane and several have the same bits, for any numbers.
fn lanes(bits: &mut Bits<'_>) {
    // Of other numbers some operations promise nothing.
    let floats: [f32; 16] = bits.floats::<16>().map(|x| if x.abs() < 4e6 { x } else { 1.5 });
    let words: [u32; 16] = [(); 16].map(|()| bits.word());
    let shift = bits.below(32) as u32;
    let machine = Machine::all().next().expect("every machine has lanes");
    for_lanes!(machine, lanes => {
        let each = |k: usize| floats[k & 15];
        let numbers = lanes.load(&lanes.each(each));
        let others = lanes.load(&lanes.each(|k| floats[(k + 5) & 15]));
        let integers = lanes.load_words(&lanes.each(|k| words[k & 15]));
        let results = [
            lanes.store_words(lanes.floor_scaled(numbers, 8)),
            lanes.store_words(lanes.nearest_byte(numbers)),
            lanes.store_words(lanes.shr(integers, shift)),
            lanes.store_words(lanes.shl(integers, shift)),
            lanes.store_words(lanes.min_words(integers, lanes.word(words[0]))),
        ];
        let floating = [
            lanes.store(lanes.min(numbers, others)),
            lanes.store(lanes.max(numbers, others)),
            lanes.store(lanes.sqrt(numbers)),
            lanes.store(numbers / others),
            lanes.store(lanes.select(lanes.less(numbers, others), numbers, others)),
        ];
        for k in 0..results[0].as_ref().len() {
            let (a, b, word) = (each(k), each(k + 5), std::num::Wrapping(words[k & 15]));
            let expected = [
                One.floor_scaled(a, 8),
                One.nearest_byte(a),
                One.shr(word, shift),
                One.shl(word, shift),
                One.min_words(word, std::num::Wrapping(words[0])),
            ];
            for (found, expected) in results.iter().zip(expected) {
                assert_eq!(found.as_ref()[k], expected.0, "{a} {word}");
            }
            let expected =
                [One.min(a, b), One.max(a, b), One.sqrt(a), a / b, One.select(One.less(a, b), a, b)];
            for (found, expected) in floating.iter().zip(expected) {
                let found = found.as_ref()[k];
                assert!(found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(), "{a} {b}");
            }
        }
    });
}
