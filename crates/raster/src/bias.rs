//! Depths that are moved a little, so that what lies in a surface is seen on it.

use crate::depth::DepthFormat;
use crate::triangle::{Corner, Corners};
use alberti_math::lanes::Lanes;

use alberti_math::{Varying, high_signed, map3};

/// A depth format with a bias for each triangle (Direct3D 11, 15.10), for
/// [`Target::with_depth`](crate::Target::with_depth): decals and outlines on a surface take a negative one, shadow maps
/// a positive.
///
/// ```text
/// bias = constant · step + slope · max(|∂zs/∂x|, |∂zs/∂y|)
/// ```
///
/// A step is 2^-16 or 2^-24 of integers of as many bits; of other formats that of an `f32` as great as the triangle's
/// greatest zs, 2^(e − 23). Derivatives are by pixels. Positive is farther, whatever the format's direction.
///
/// # Precision
/// That of three `f32` operations on zs. In fixed point a 16,384th of the bias, and of steps of 2^-31 twice the
/// slope's factor and 1.5; slopes are at most 2 a pixel there, and factors 32,767. Corners stay between the near and
/// the far plane.
///
/// # Cost
/// A triangle that faces the right way: a copy of its corners, two divisions and some twenty operations in `f32`. In
/// fixed point it is a division of 32 bits, seven products of 64 bits and some sixty operations. These are 570
/// instructions on a Cortex-M4F, and 1,550 on a Cortex-M0+. With several lanes it waits for others as a copy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Biased<D> {
    /// The format.
    pub format: D,
    /// Steps.
    pub constant: f32,
    /// The factor of the slope.
    pub slope: f32,
    /// The most that a bias moves either way, as a zs of either sign; 0 for no limit. Direct3D limits one way alone.
    pub clamp: f32,
}

impl<D: DepthFormat> DepthFormat for Biased<D> {
    type Stored = D::Stored;
    const BIASED: bool = true;

    fn bias(self, slope: f32, greatest: f32) -> f32 {
        let step = match self.bits() {
            bits @ 0..31 => f32::from_bits((127 - bits) << 23),
            // The exponent alone, 23 less.
            _ => f32::from_bits((greatest.to_bits() & 0x7f80_0000).saturating_sub(23 << 23)),
        };
        let farther = self.constant * step + self.slope * slope;
        let clamp = self.clamp.abs();
        let most = if clamp > 0.0 { clamp } else { 1.0 };
        let farther = farther.max(-most).min(most);
        self.format.bias(slope, greatest) + if self.reversed() { -farther } else { farther }
    }

    fn bias_steps(self, slope: u32, greatest: u32) -> i64 {
        let step = match self.bits() {
            bits @ 0..31 => 31 - bits.cast_signed(),
            _ => 8 - greatest.leading_zeros().cast_signed(),
        };
        let constant = i64::from(scaled(self.constant, 8));
        let constant = if step >= 8 { constant << (step - 8) } else { constant >> (8 - step) };
        let farther = constant + (wide(scaled(self.slope, 16), (slope >> 1).cast_signed()) >> 15);
        let clamp = i64::from(scaled(self.clamp.abs(), 31));
        let most = if clamp > 0 { clamp } else { 1 << 31 };
        let farther = farther.clamp(-most, most);
        self.format.bias_steps(slope, greatest) + if self.reversed() { -farther } else { farther }
    }

    #[inline(always)]
    fn reversed(self) -> bool {
        self.format.reversed()
    }

    #[inline(always)]
    fn farthest(self) -> D::Stored {
        self.format.farthest()
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.format.bits()
    }

    #[inline]
    fn encode(self, zs: f32) -> D::Stored {
        self.format.encode(zs)
    }

    #[inline]
    fn encode_integer(self, zs: u32) -> D::Stored {
        self.format.encode_integer(zs)
    }

    #[inline(always)]
    fn encode_lanes<L: Lanes>(self, lanes: L, zs: L::Depth) -> L::Each<D::Stored> {
        self.format.encode_lanes(lanes, zs)
    }

    #[inline]
    fn nearer(self, new: D::Stored, old: D::Stored) -> bool {
        self.format.nearer(new, old)
    }

    #[inline(always)]
    fn seen<L: Lanes>(
        self,
        lanes: L,
        new: &L::Each<D::Stored>,
        old: &L::Each<D::Stored>,
        mask: L::Mask,
    ) -> L::Mask {
        self.format.seen(lanes, new, old, mask)
    }

    #[inline(always)]
    fn keep<L: Lanes>(
        self,
        lanes: L,
        new: &L::Each<D::Stored>,
        mask: L::Mask,
        stored: &mut L::Each<D::Stored>,
    ) {
        self.format.keep(lanes, new, mask, stored);
    }
}

/// The corners of a triangle with the format's bias, in numbers that are `fixed` or floats, on a grid of so many bits.
#[inline(never)]
pub(crate) fn biased<V: Varying>(
    corners: [&Corner<V>; 3],
    (fixed, bits): (bool, u32),
    format: impl DepthFormat,
) -> [Corner<V>; 3] {
    let places = map3(corners, |corner| corner.place(fixed));
    if fixed {
        let depths = map3(corners, |corner| corner.zs);
        let greatest = depths[0].max(depths[1]).max(depths[2]);
        let steps = format.bias_steps(slope_in_steps(&places, depths, bits), greatest);
        let moved = |corner: &Corner<V>| {
            let zs = (i64::from(corner.zs) + steps).clamp(0, (1 << 31) - 1).unsigned_abs();
            #[expect(clippy::cast_possible_truncation, reason = "31 bits")]
            let zs = zs as u32;
            Corner { zs, ..*corner }
        };
        return map3(corners, moved);
    }
    let depths = map3(corners, Corner::zs);
    let bias = format.bias(slope(&places, depths, bits), depths[0].max(depths[1]).max(depths[2]));
    // Factors that are no numbers move nothing.
    let bias = if bias.is_finite() { bias } else { 0.0 };
    map3(corners, |corner: &Corner<V>| Corner {
        zs: (corner.zs() + bias).clamp(0.0, 1.0).to_bits(),
        ..*corner
    })
}

/// The same of a line, whose slope is along it.
#[inline(never)]
pub(crate) fn biased_line<V: Varying>(
    corners: [&Corner<V>; 2],
    (fixed, bits): (bool, u32),
    format: impl DepthFormat,
) -> [Corner<V>; 2] {
    let [a, b] = corners;
    let [[ax, ay], [bx, by]] = corners.map(|corner| corner.place(fixed));
    // A triangle beside it, along whose other side nothing changes.
    let third =
        Corner { place: [bx.wrapping_sub(by.wrapping_sub(ay)), by.wrapping_add(bx.wrapping_sub(ax))], ..*b };
    let [a, b, _] = biased([a, b, &third], (fixed, bits), format);
    [a, b]
}

/// The greatest change of a depth from a pixel to the next, by column or by row; 0 without an area.
#[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
fn slope([a, b, c]: &Corners, [za, zb, zc]: [f32; 3], bits: u32) -> f32 {
    let apart = |p: &[i32; 2]| [(p[0] - a[0]) as f32, (p[1] - a[1]) as f32];
    let ([ux, uy], [vx, vy]) = (apart(b), apart(c));
    let (u, v) = (zb - za, zc - za);
    let area = ux * vy - uy * vx;
    let [by_column, by_row] = [u * vy - v * uy, v * ux - u * vx].map(|numerator| (numerator / area).abs());
    let slope = by_column.max(by_row) * (1 << bits) as f32;
    if slope.is_finite() { slope } else { 0.0 }
}

/// The same in steps of 2^-31, by integers; at most 2.
fn slope_in_steps([a, b, c]: &Corners, [za, zb, zc]: [u32; 3], bits: u32) -> u32 {
    let apart = |p: &[i32; 2]| [p[0].wrapping_sub(a[0]), p[1].wrapping_sub(a[1])];
    let ([ux, uy], [vx, vy]) = (apart(b), apart(c));
    // In steps of 2^-30, whose differences have 31 bits.
    let [u, v] = [zb, zc].map(|z| (z >> 1).cast_signed().wrapping_sub((za >> 1).cast_signed()));
    let across =
        |[px, py]: [i32; 2], [qx, qy]: [i32; 2]| wide(px, qy).wrapping_sub(wide(py, qx)).unsigned_abs();
    let most = across([u, uy], [v, vy]).max(across([ux, u], [vx, v]));
    let area = across([ux, uy], [vx, vy]);
    if area == 0 || most == 0 {
        return 0;
    }
    // The quotient of 31 bits and 16, so that 32 are enough on every core.
    let (most, up) = leading(most);
    let (area, down) = leading(area);
    let area = ((area >> 15) + 1) >> 1;
    let quotient = ((most >> 1) + (area >> 1)) / area;
    match up - down - 14 + bits.cast_signed() {
        power @ 0.. if quotient.leading_zeros().cast_signed() >= power => quotient << power,
        0.. => u32::MAX,
        power => quotient.checked_shr(power.unsigned_abs()).unwrap_or(0),
    }
}

/// The highest 32 bits of a number that is not 0, and the power of two that they are to be multiplied by.
fn leading(x: u64) -> (u32, i32) {
    let zeros = x.leading_zeros();
    let leading = (x << zeros >> 32) as u32;
    (leading, 32 - zeros.cast_signed())
}

/// The product of two numbers.
fn wide(a: i32, b: i32) -> i64 {
    i64::from(high_signed(a, b)) << 32 | i64::from(a.wrapping_mul(b).cast_unsigned())
}

/// The number times a power of two, towards 0, and at most 2^31 - 1 either way; 0 of what is none.
fn scaled(x: f32, power: i32) -> i32 {
    let bits = x.to_bits();
    let (exponent, mantissa) = ((bits >> 23 & 255).cast_signed(), bits & 0x7f_ffff | 0x80_0000);
    // 2^(exponent - 127) mantissas of 2^-23.
    let size = match exponent - 150 + power {
        _ if exponent == 0 || x.is_nan() => 0,
        shift @ 0..8 => mantissa << shift,
        8.. => i32::MAX.cast_unsigned(),
        shift => mantissa.checked_shr(shift.unsigned_abs()).unwrap_or(0),
    };
    if x.is_sign_negative() { -size.cast_signed() } else { size.cast_signed() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnyDepth, D16, D24, Equal, F32, F32Reversed, Numbers, Vertex};
    use alberti_math::Fixed;

    fn corner(numbers: Numbers, x: i32, y: i32, zs: f32) -> Corner<()> {
        let at = |k: i32| Fixed::from_subpixels(k * 256).expect("small");
        Corner::new(numbers, &Vertex { x: at(x), y: at(y), zs, q: 1.0, varying: () })
    }

    /// A triangle whose zs grows by 0.01 a column and 0.002 a row.
    fn moved(numbers: Numbers, format: impl DepthFormat) -> [f32; 3] {
        let corners =
            [(10, 20, 0.3), (30, 20, 0.5), (10, 40, 0.34)].map(|(x, y, zs)| corner(numbers, x, y, zs));
        let moved = biased(corners.each_ref(), (numbers.are_fixed(), 8), format);
        [0, 1, 2].map(|k| moved[k].vertex(numbers).zs - corners[k].vertex(numbers).zs)
    }

    fn all_are(found: [f32; 3], expected: f32) {
        // In fixed point half a step of the buffer's is in zs, and its slope is 2^-16 less, and within 2^-14.
        let allowed = 1.3e-7 + expected.abs() / 21_000.0;
        assert!(found.iter().all(|found| (found - expected).abs() < allowed), "{found:?} {expected}");
    }

    #[test]
    fn a_bias_is_steps_and_slopes() {
        let of = |constant, slope| Biased { format: D16, constant, slope, clamp: 0.0 };
        for numbers in [Numbers::Float, Numbers::Fixed { depth_bits: 16 }] {
            all_are(moved(numbers, of(3.0, 0.0)), 3.0 / 65536.0);
            all_are(moved(numbers, of(0.0, 2.0)), 0.02);
            all_are(moved(numbers, of(-3.0, -2.0)), -0.02 - 3.0 / 65536.0);
            all_are(moved(numbers, Equal(of(0.0, 2.0))), 0.02);
            for clamp in [0.005, -0.005] {
                all_are(moved(numbers, Biased { clamp, ..of(0.0, -2.0) }), -0.005);
                all_are(moved(numbers, Biased { clamp, ..of(0.0, 2.0) }), 0.005);
            }
            all_are(moved(numbers, Biased { format: of(0.0, 2.0), ..of(0.0, 1.0).with(of(0.0, 2.0)) }), 0.03);
        }
    }

    impl<D: Copy> Biased<D> {
        fn with<E>(self, format: E) -> Biased<E> {
            let Self { constant, slope, clamp, .. } = self;
            Biased { format, constant, slope, clamp }
        }
    }

    #[test]
    fn steps_are_the_formats() {
        let steps = |format| Biased { format, constant: 4096.0, slope: 0.0, clamp: 0.0 };
        all_are(moved(Numbers::Float, steps(D16).with(AnyDepth::D24)), 4096.0 / 16_777_216.0);
        all_are(moved(Numbers::Float, steps(D16).with(D24)), 4096.0 / 16_777_216.0);
        // The greatest is 0.5, whose step is 2^-24; reversed ones fall with distance.
        all_are(moved(Numbers::Float, steps(D16).with(F32)), 4096.0 / 16_777_216.0);
        all_are(moved(Numbers::Float, steps(D16).with(F32Reversed)), -4096.0 / 16_777_216.0);
    }

    /// Triangles of all sizes and slopes, by the formula in `f64`.
    #[test]
    fn random_biases_are_the_formula() {
        let mut state = 0x2545_f491_4f6c_dd1d_u64;
        let mut random = |below: u32| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            u32::try_from(state >> 33).expect("31 bits") % below
        };
        let (mut moved_far, mut large) = (0, 0);
        for k in 0..40_000 {
            let extent = 1 << (4 + k % 18);
            let depths = 1 << (8 + random(16));
            let zs = random((1 << 24) - depths);
            let places = [(); 3].map(|()| [(); 2].map(|()| random(extent).cast_signed()));
            let zs = [(); 3].map(|()| zs + random(depths));
            #[expect(clippy::cast_precision_loss, reason = "whole numbers below 2^24")]
            let [zs, [constant, slope, clamp]] =
                [zs, [random(4000), random(1000), random(3)]].map(|all| all.map(|x| x as f32));
            let (constant, slope, clamp) = (constant - 2000.0, (slope - 500.0) / 128.0, clamp / 1024.0);
            let format = Biased { format: D24, constant, slope, clamp };
            for numbers in [Numbers::Float, Numbers::Fixed { depth_bits: 24 }] {
                let at = |k: i32| Fixed::from_subpixels(k).expect("small");
                let corners = [0, 1, 2].map(|i| {
                    let [x, y] = places[i].map(at);
                    let zs = zs[i] / 16_777_216.0;
                    Corner::<()>::new(numbers, &Vertex { x, y, zs, q: 1.0, varying: () })
                });
                let moved = biased(corners.each_ref(), (numbers.are_fixed(), 8), format);
                let depth = |corner: &Corner<()>| {
                    if numbers.are_fixed() {
                        f64::from(corner.zs) / 2.0_f64.powi(31)
                    } else {
                        corner.zs().into()
                    }
                };
                let [a, b, c] = [0, 1, 2].map(|i| places[i].map(f64::from));
                let (u, v) =
                    (depth(&corners[1]) - depth(&corners[0]), depth(&corners[2]) - depth(&corners[0]));
                let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                if area == 0.0 {
                    continue;
                }
                let terms = [1, 0].map(|axis| [u * (c[axis] - a[axis]), v * (b[axis] - a[axis])]);
                let steep = terms.map(|[u, v]| (u - v).abs() / area.abs() * 256.0);
                let steep = steep[0].max(steep[1]);
                if steep > 1.99 {
                    continue;
                }
                let exact = f64::from(constant) / 16_777_216.0 + f64::from(slope) * steep;
                let most = if clamp > 0.0 { f64::from(clamp) } else { 1.0 };
                let exact = exact.clamp(-most, most);
                // Of floats: what sums of terms that nearly cancel may be off.
                let rough = terms.iter().flatten().fold(0.0_f64, |sum, term| sum + term.abs() / area.abs());
                let thin = ((b[0] - a[0]) * (c[1] - a[1])).abs() + ((b[1] - a[1]) * (c[0] - a[0])).abs();
                let factor = f64::from(slope.abs());
                let off = match numbers.are_fixed() {
                    true => {
                        (exact.abs() + factor * steep) / 16_384.0 + (1.5 + 2.0 * factor) / 2.0_f64.powi(31)
                    }
                    false => {
                        (factor * (256.0 * rough + steep * thin / area.abs()) + 1.0) * 3.0 / 16_777_216.0
                    }
                };
                for (moved, corner) in moved.iter().zip(&corners) {
                    let wanted = (depth(corner) + exact).clamp(0.0, 1.0);
                    let found = depth(moved);
                    assert!(
                        (found - wanted).abs() <= off,
                        "{places:?} {zs:?} {format:?}: {found} {wanted} {off}"
                    );
                }
                moved_far += u32::from(exact.abs() > 1e-4);
                large += u32::from(steep > 0.01);
            }
        }
        assert!(moved_far > 5000 && large > 5000, "{moved_far} {large}");
    }

    #[test]
    fn corners_stay_between_the_planes() {
        let far = Biased { format: D16, constant: 0.0, slope: 1000.0, clamp: 0.0 };
        let corners = [(0, 0, 0.1), (9, 0, 0.9), (0, 9, 0.5)];
        for numbers in [Numbers::Float, Numbers::Fixed { depth_bits: 16 }] {
            let corners = corners.map(|(x, y, zs)| corner(numbers, x, y, zs));
            for (slope, expected) in [(1000.0, 1.0), (-1000.0, 0.0)] {
                let moved = biased(corners.each_ref(), (numbers.are_fixed(), 8), Biased { slope, ..far });
                assert!(moved.iter().all(|corner| (corner.vertex(numbers).zs - expected).abs() < 1e-6));
            }
            // Without an area there is no slope.
            let thin = [corners[0], corners[1], corners[1]];
            let moved = biased(thin.each_ref(), (numbers.are_fixed(), 8), far);
            assert!(moved.iter().zip(thin).all(|(moved, thin)| moved.zs == thin.zs));
        }
    }
}
