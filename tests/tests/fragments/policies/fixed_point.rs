//! The bounds of `FixedPoint`, which takes no notice of what snapping has moved.

use super::{Case, EPS, climbs, each_sample, lines};
use alberti_raster::{FixedPoint, Interpolation, Lines};

impl Case {
    /// The most that a straight line over the whole triangle misses, where `FixedPoint` may draw it as one run.
    fn missed_by_one_run(&self) -> f64 {
        let side = |axis: usize| {
            let at = self.tri.map(|corner| corner[axis]);
            at.iter().max().unwrap() - at.iter().min().unwrap()
        };
        let pixels = side(0).max(side(1)) as f64 / 256.0;
        let most = 1.0 + 1.001 / pixels.max(1.0);
        if pixels < 16.0 && self.ratio() < most { self.spread() / (4.0 * pixels.max(1.0)) } else { 0.0 }
    }

    /// The share of fixed point in the bound of a policy, of which so many steps are rounding.
    fn fixed_point(&self, steps: i32) -> f64 {
        const UNIT: f64 = 1.0 / 65536.0;
        let columns = f64::from(self.covered.end - self.covered.start);
        let slopes = self.ratio() * (columns + 4.0) * 3.0 * 2f64.powi(-29);
        // A closure gets f32.
        f64::from(steps) * UNIT + self.spread() * (2f64.powi(-17) + slopes) + EPS * self.largest()
    }
}

/// A unit of depth in fixed point.
const DEPTH_UNIT: f64 = 1.0 / (1u32 << 31) as f64;

fn fixed_point(
    policy: impl Interpolation,
    stream: u64,
    steps: i32,
    policy_bound: impl Fn(&Case, i32) -> [f64; 2],
) {
    let (mut worst, mut worst_depth, mut near) = (0.0, 0.0, 0);
    each_sample(policy, stream, 300_000, |case, column, u, zs| {
        let [exact, missed] = policy_bound(case, column);
        let fixed = case.fixed_point(steps);
        let error = (u - exact).abs();
        // Half a step for each vertex's rounding, and the rounding of an f32.
        let outside = f64::max(case.range()[0] - u, u - case.range()[1]);
        assert!(
            outside <= 0.51 / 65536.0 + EPS * case.largest(),
            "{u} is {outside:e} outside of {:?}",
            case.u
        );
        worst = f64::max(worst, error / (missed + fixed));
        near += u64::from(error > 0.25 * (missed + fixed));
        let depth = case.linear_at(Case::sample(column), case.zs);
        let row = f64::from(case.covered.end - case.covered.start);
        let depth_bound = (row + 8.0) * DEPTH_UNIT + EPS;
        worst_depth = f64::max(worst_depth, (zs - depth).abs() / depth_bound);
    });
    println!("{policy:?}: {worst:.3} of the bound, depth {worst_depth:.3}; {near} samples near it");
    assert!(worst <= 1.0 && worst_depth <= 1.0);
    assert!(near > 100, "the bound is not tested");
    climbs(policy, stream, |case, column, u| {
        let [exact, missed] = policy_bound(case, column);
        (u - exact).abs() / (missed + case.fixed_point(steps))
    });
}

#[test]
fn lines_in_fixed_point() {
    fixed_point(FixedPoint(lines(16)), 7, 16 + 3, |case, column| {
        [case.hyperbolic(column), case.missed(case.run(column, 16)).max(case.missed_by_one_run())]
    });
    fixed_point(FixedPoint(lines(1)), 8, 1 + 3, |case, column| {
        [case.hyperbolic(column), case.missed(case.run(column, 1))]
    });
    let straight = |case: &Case, column: i32| [case.straight(column), 0.0];
    fixed_point(FixedPoint(Lines::affine()), 9, 64 + 3, straight);
    let budget = 1.0 / 256.0;
    let within = |case: &Case, column: i32| [case.hyperbolic(column), f64::from(budget)];
    // Rounding is part of the budget.
    fixed_point(FixedPoint(Lines::bounded(budget)), 10, 0, within);
    // One that is smaller than that cannot be kept: runs are of one column then.
    let step = 1.0 / 65536.0;
    fixed_point(FixedPoint(Lines::bounded(step)), 13, 1 + 3, |case, column| [case.hyperbolic(column), 0.0]);
}
