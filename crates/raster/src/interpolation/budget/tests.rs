//! The ways against their bounds, in `f64`: each is taken up to its budget, and no further.

use super::*;
use crate::Vertex;
use crate::interpolation::lines::Runs;
use crate::triangle::{Numbers, doubled_area};
use alberti_math::Fixed;
use std::vec::Vec;

/// A corner in pixels; q, and what it carries.
type Given = ([f64; 2], f32, f32);

/// Numbers from 0 to 1.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        f64::from(u32::try_from(self.0 >> 32).expect("32 bits")) / f64::from(u32::MAX)
    }

    #[expect(clippy::cast_possible_truncation, reason = "any will do")]
    fn triangle(&mut self, steepest: f64) -> [Given; 3] {
        [(); 3].map(|()| {
            // Subpixels hold these places.
            let place = [(); 2].map(|()| (self.next() * 4000.0).round() / 16.0);
            let q = (0.3 * (1.0 + (steepest - 1.0) * self.next())) as f32;
            (place, q, (4.0 * self.next() - 2.0) as f32)
        })
    }

    /// Triangles of some area, whose q differ by a factor up to the steepest.
    fn triangles(&mut self, steepest: f64) -> Vec<[Given; 3]> {
        let all = std::iter::repeat_with(|| self.triangle(steepest));
        all.filter(|[(a, ..), (b, ..), (c, ..)]| cross(sub(*b, *a), sub(*c, *a)).abs() > 4000.0)
            .take(400)
            .collect()
    }
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The increment by column of the plane through these values.
fn by_column([a, b, c]: [[f64; 2]; 3], [f, g, h]: [f64; 3]) -> f64 {
    let ([b, c], area) = ([sub(b, a), sub(c, a)], cross(sub(b, a), sub(c, a)));
    ((g - f) * c[1] - (h - f) * b[1]) / area
}

/// The answer of a way to a triangle in numbers of 8 bits below the pixel.
fn with<T>(triangle: &[Given; 3], numbers: Numbers, way: impl Fn(&Oriented<'_, f32>) -> T) -> T {
    let corners = triangle.map(|([x, y], q, varying)| {
        #[expect(clippy::cast_possible_truncation, reason = "they are few pixels")]
        let fixed = |x: f64| Fixed::wrapping((x * 256.0) as i32);
        Corner::new(numbers, &Vertex { x: fixed(x), y: fixed(y), zs: 0.5, q, varying })
    });
    let fixed = numbers.are_fixed();
    let area = doubled_area(&corners.each_ref().map(|corner| corner.place(fixed)));
    way(&Oriented::new(corners.each_ref(), area, 8, fixed))
}

fn least_and_most(values: [f64; 3]) -> [f64; 2] {
    let [a, b, c] = values;
    [a.min(b).min(c), a.max(b).max(c)]
}

/// A little less than a number, and a little more.
#[expect(clippy::cast_possible_truncation, reason = "a part in a thousand")]
fn around(x: f64) -> [f32; 2] {
    [(x * 0.999) as f32, (x * 1.001) as f32]
}

#[test]
fn parabolas_are_taken_up_to_their_budget() {
    let mut taken = 0;
    for triangle in Chance(1).triangles(1.25) {
        let [q, u] = [triangle.map(|given| f64::from(given.1)), triangle.map(|given| f64::from(given.2))];
        let ([low, high], [least, most]) = (least_and_most(q), least_and_most(u));
        let share = (high - low) / (high + low);
        let [less, more] = around((most - least) * share * share / 5.0);
        let is_taken =
            |budget| with(&triangle, Numbers::Float, |triangle| over_all(budget, &triangle.vertices));
        assert!(!is_taken(less), "{triangle:?}");
        assert_eq!(is_taken(more), high <= 1.125 * low, "{triangle:?}");
        taken += u32::from(is_taken(more));
    }
    assert!((100..300).contains(&taken), "{taken}");
}

#[test]
fn planes_are_taken_up_to_their_rounding() {
    for triangle in Chance(2).triangles(3.0) {
        let [low, high] = least_and_most(triangle.map(|given| f64::from(given.1)));
        let [_, most] = least_and_most(triangle.map(|given| f64::from(given.2).abs()));
        let rounding = (15.0 * high / low + 5.0) * most / f64::from(1 << 24);
        let taken = around(rounding)
            .map(|budget| with(&triangle, Numbers::Float, |triangle| in_planes(budget, triangle)));
        assert_eq!(taken, [false, true], "{triangle:?}");
    }
}

#[test]
fn lines_are_taken_up_to_their_budget() {
    for triangle in Chance(3).triangles(3.0) {
        let places = triangle.map(|given| given.0);
        let [q, u] = [triangle.map(|given| f64::from(given.1)), triangle.map(|given| f64::from(given.2))];
        let of_q = by_column(places, q);
        let of_product = by_column(places, [0, 1, 2].map(|k| q[k] * u[k]));
        let [_, steepest] = least_and_most(u.map(|u| (of_product - u * of_q).abs()));
        let [low, _] = least_and_most(q);
        let [less, more] = around(1024.0 * steepest * of_q.abs() / (low * low));
        let taken = [less, more]
            .map(|budget| with(&triangle, Numbers::Float, |triangle| along_rows(budget, triangle)));
        assert_eq!(taken, [false, true], "{triangle:?}");
    }
}

/// The longest runs for which the budget has room, or half as long, or none.
#[test]
fn runs_on_the_screen_are_as_long_as_their_budget_allows() {
    let mut lengths = std::collections::BTreeMap::new();
    let mut chance = Chance(4);
    let triangles = [1.5, 1.000_3].map(|steepest| chance.triangles(steepest));
    for triangle in triangles.into_iter().flatten() {
        let [low, high] = least_and_most(triangle.map(|given| f64::from(given.1)));
        let [least, most] = least_and_most(triangle.map(|given| f64::from(given.2)));
        let missed = 65536.0 * (most - least) * (high - low) / (high + 3.0 * low);
        for room in [missed * 0.999, missed * 1.001, missed * 8.0 * chance.next(), 40.0, 20.0] {
            for length in [8, 16, 32, 64] {
                // A column takes a unit, and the ends three.
                #[expect(clippy::cast_possible_truncation, reason = "they are few")]
                let budget = room as i32 + length + 3;
                let longest = [64, 32, 16].into_iter().find(|length| budget - length - 3 >= 0).unwrap_or(8);
                let has_room = |length: i32| f64::from(budget - length - 3) - missed;
                let candidates = [longest, longest / 2].into_iter().filter(|length| *length >= 8);
                // Within a unit it may be either.
                if candidates.clone().any(|length| has_room(length).abs() < 1.0 + missed * 1e-6) {
                    continue;
                }
                let right = candidates.clone().find(|&length| has_room(length) > 0.0);
                let found = with(&triangle, Numbers::Fixed { depth_bits: 16 }, |triangle| {
                    on_screen(budget, triangle).map(Runs::length)
                });
                assert_eq!(found, right, "{budget} of {missed}: {triangle:?}");
                *lengths.entry(found).or_insert(0) += 1;
            }
        }
    }
    // None of 8, 16, 32 and 64 columns, or none at all, is left out.
    assert!(lengths.len() == 5 && lengths.values().all(|count| *count > 20), "{lengths:?}");
}

#[test]
fn budgets_are_in_units_of_fixed_point() {
    for (budget, right) in [(0.0, 0), (-1.0, 0), (0.5, 32768), (3.0, 196_608), (1e9, LIMIT / 2)] {
        assert_eq!(units(budget), right);
    }
}
