//! Window-viewport and snapping.

use crate::{Row, Sample, Table};
use alberti_math::{Fixed, GUARD_PIXELS, Subpixel};
use alberti_oracle::rational::{Rational, from_f32, from_int, to_f64};
use alberti_oracle::rng::Rng;
use alberti_projection::Viewport;

/// How far out points lie, given the guard band.
type Reach = fn(f32) -> f32;

pub(crate) fn tables() -> Vec<Table> {
    let mut rows = Vec::new();
    let regions: [(&str, Reach); 3] = [
        ("within the window", |_| 1.0),
        ("to the guard band", |guard| guard),
        ("next to the middle", |_| 1e-30),
    ];
    for (region, reach) in regions {
        rows.push(Row::new("Viewport::to_screen(Sub4)", region, 1.0, move |rng| {
            to_screen(Subpixel::Sub4, rng, reach)
        }));
        rows.push(Row::new("Viewport::to_screen(Sub8)", region, 1.0, move |rng| {
            to_screen(Subpixel::Sub8, rng, reach)
        }));
    }
    rows.push(Row::new("Viewport::guard", "any viewport", 1.0, |rng| {
        let ([x, y, width, height], viewport) = any(rng);
        let bounds = viewport.guard();
        // The outermost pixel on the side to which the viewport lies.
        let outermost = |bound: f32, from: i32, length: i32| {
            let half = Rational::new(length.into(), 2.into());
            let center = from_int(i128::from(from)) + &half;
            let reached = from_f32(bound) * half + if center < from_int(0) { -center } else { center };
            let allowed = from_int(i128::from(GUARD_PIXELS) - 1);
            let eps = to_f64(&((reached - &allowed) / allowed)) * 2f64.powi(24);
            Sample { eps: eps.abs(), ulp: eps.abs() / 2.0 }
        };
        outermost(bounds.x, x, width).worst(outermost(bounds.y, y, height))
    }));
    vec![Table {
        title: "Viewport",
        about: "`to_screen` against the window translated by (1, 1) and scaled by (W/2, H/2), y downwards; its errors \
                are shares of the documented ε·|offset| + half a subpixel, in ULP of a subpixel count. `guard` in ε of \
                the guard band less a pixel.",
        rows,
    }]
}

/// Left, top, width and height of a viewport, and the viewport.
fn any(rng: &mut Rng) -> ([i32; 4], Viewport) {
    let [width, height] = [(); 2].map(|()| rng.log_integer(16_384) as i32);
    let [x, y] = [width, height].map(|length| rng.range(-16_384, i64::from(16_384 - length)) as i32);
    let viewport = Viewport::new(x, y, width.unsigned_abs(), height.unsigned_abs());
    ([x, y, width, height], viewport.expect("within reach"))
}

fn to_screen(subpixel: Subpixel, rng: &mut Rng, reach: Reach) -> Sample {
    let ([left, top, width, height], viewport) = any(rng);
    let guard = viewport.guard();
    let [xs, ys] = [guard.x, guard.y].map(|guard| rng.uniform(-1.0, 1.0) as f32 * reach(guard));
    let got = viewport.to_screen(subpixel, xs, ys).expect("within the guard band").map(Fixed::subpixels);
    // Translated by (1, 1), scaled by (W/2, H/2); rows count from the top.
    let one = from_int(1);
    let x = (from_f32(xs) + &one) * half(width) + from_int(i128::from(left));
    let y = from_int(i128::from(top + height)) - (from_f32(ys) + one) * half(height);
    share(subpixel, got[0], &x, xs, width).worst(share(subpixel, got[1], &y, ys, height))
}

fn half(length: i32) -> Rational {
    Rational::new(length.into(), 2.into())
}

/// The error as a share of the documented bound.
fn share(subpixel: Subpixel, got: i32, exact: &Rational, offset: f32, length: i32) -> Sample {
    let one = f64::from(1 << subpixel.bits());
    let error = to_f64(&(from_int(i128::from(got)) / from_int(1 << subpixel.bits()) - exact)).abs();
    let offset = f64::from(offset).abs() * f64::from(length) / 2.0;
    let allowed = offset / 2f64.powi(24) + 0.5 / one;
    Sample { eps: error / allowed, ulp: error * one }
}
