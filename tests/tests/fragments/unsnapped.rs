//! Large triangles carry what their vertices have where these were before snapping: against arithmetic of 106 bits on
//! the triangle before, over the same kinds of triangles and values as `attributes.rs`.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "subpixels are within the guard band"
)]

use crate::attributes::{Case, any_case, within};
use alberti_math::{Fixed, Linear, Subpixel};
use alberti_oracle::climb::climb;
use alberti_oracle::coverage::{Triangle, weights};
use alberti_oracle::dd::{self, Dd};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::Vertex;
use alberti_tests::probe::{Probe, Recorded};

/// The documented bounds, in ε of the greatest: of what vertices carry, 4, and of `Exact` and depth besides.
const OF_VALUES: f64 = 4.0 + 9.0;
const OF_DEPTHS: f64 = 4.0 + 6.0;
const EPS: f64 = 1.0 / (1 << 24) as f64;

/// A case whose vertices were moved by snapping.
#[derive(Clone, Copy, Debug)]
struct Moved {
    case: Case,
    moved: [[i64; 2]; 3],
}

impl Moved {
    fn any(subpixel: Subpixel, rng: &mut Rng) -> Self {
        let case = any_case(subpixel, rng);
        Self { case, moved: [(); 3].map(|()| [(); 2].map(|()| rng.range(-128, 127))) }
    }

    fn vertices<V>(&self, varying: impl Fn(f32) -> V) -> [Vertex<V>; 3] {
        let (Case { tri, zs, u, .. }, q) = (self.case, self.case.q());
        [0, 1, 2].map(|i| {
            let at = |k: usize| {
                let parts = 256 * tri[i][k] + 128 + self.moved[i][k];
                Fixed::from_bits((parts as i32).cast_unsigned())
            };
            Vertex { x: at(0), y: at(1), zs: zs[i], q: q[i], varying: varying(u[i]) }
        })
    }

    /// The triangle before snapping, in 256ths of subpixels.
    fn before(&self) -> Triangle {
        [0, 1, 2].map(|i| [0, 1].map(|k| 256 * self.case.tri[i][k] + self.moved[i][k]))
    }

    /// The weights of the three vertices before at one after, over their sum.
    fn shares(&self, corner: usize) -> [f64; 3] {
        let e = weights(self.before(), self.case.tri[corner].map(|c| 256 * c)).map(|e| e as f64);
        e.map(|weight| weight / (e[0] + e[1] + e[2]))
    }

    /// Whether the rule for large triangles holds for this one, by a margin.
    fn is_large(&self, subpixel: Subpixel) -> bool {
        let length = |k: usize| {
            let at = self.case.tri.map(|corner| corner[k]);
            at.iter().max().unwrap() - at.iter().min().unwrap()
        };
        let q = self.case.q().map(f64::from);
        let wide = |corner: usize| {
            let shares = self.shares(corner);
            let terms = [0, 1, 2].map(|i| shares[i] * q[i]);
            let at: f64 = terms.iter().sum();
            let small = |x: f64| x.abs() < 0.0624;
            at > 0.0 && (0..3).filter(|&i| i != corner).all(|i| small(shares[i]) && small(terms[i] / at))
        };
        length(0).max(length(1)) >= 65 << subpixel.bits() && (0..3).all(wide)
    }

    /// The shares of the bounds that a value and a depth make use of.
    fn used(&self, probe: &mut Probe<Recorded>, subpixel: Subpixel, linear: bool) -> [f64; 2] {
        let Case { pixel, u, zs, .. } = self.case;
        let (value, depth) = if linear {
            let found = probe.interpolated(&self.vertices(Linear), pixel);
            found.map(|(Linear(u), zs)| (u, zs)).expect("covered")
        } else {
            probe.interpolated(&self.vertices(|u| u), pixel).expect("covered")
        };
        assert!(within(value, u) && within(depth, zs), "{value} or {depth} outside: {self:?}");
        // On the triangle before, and within the range.
        let (tri, sample, q) = (self.before(), self.case.sample(subpixel).map(|c| 256 * c), self.case.q());
        let share = |found: f32, exact: Dd, values: [f32; 3], bound: f64| {
            let [least, most] =
                [f32::min, f32::max].map(|pick| values.into_iter().reduce(pick).unwrap_or(0.0));
            let scale = f64::from(least.abs().max(most.abs()));
            let exact = exact.to_f64().clamp(least.into(), most.into());
            if scale > 0.0 { (f64::from(found) - exact).abs() / (bound * EPS * scale) } else { 0.0 }
        };
        let exact = if linear { dd::linear(tri, sample, u) } else { dd::hyperbolic(tri, sample, q, u) };
        [share(value, exact, u, OF_VALUES), share(depth, dd::linear(tri, sample, zs), zs, OF_DEPTHS)]
    }
}

fn large_ones(subpixel: Subpixel, stream: u64, linear: bool) {
    let sweep = std::env::var_os("ALBERTI_SWEEP").is_some();
    let mut probe = Probe::new(Recorded, subpixel);
    let (samples, steps) = if sweep { (1_000_000, 500_000) } else { (100_000, 20_000) };
    for which in [0, 1] {
        let mut large = 0;
        let found = climb(run_seed() ^ stream, samples, steps, |rng| {
            let case = Moved::any(subpixel, rng);
            if !case.is_large(subpixel) {
                return 0.0;
            }
            large += 1;
            case.used(&mut probe, subpixel, linear)[which]
        });
        println!("{subpixel:?}, linear: {linear}, {which}: {found:?}, {large} large ones");
        assert!(found.most <= 1.0, "{found:?}");
        assert!(large > samples / 3 && found.most > 0.2, "the bound is not tested: {large}, {found:?}");
    }
}

#[test]
fn in_space_with_eight_bits() {
    large_ones(Subpixel::Sub8, 31, false);
}

#[test]
fn on_the_screen_with_four_bits() {
    large_ones(Subpixel::Sub4, 32, true);
}

#[test]
fn in_space_with_four_bits() {
    large_ones(Subpixel::Sub4, 33, false);
}
