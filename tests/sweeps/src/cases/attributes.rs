//! Values and depths that are interpolated in perspective, against arithmetic of 106 bits.

use super::{ensure, rng};
use crate::Found;
use alberti_math::Subpixel;
use alberti_oracle::climb::climb;
use alberti_oracle::dd;
use alberti_tests::attributes::{Case, any_case, within};
use alberti_tests::probe::{Probe, Recorded};

/// The documented bounds, in units of 2^-24.
const VALUES: f64 = 9.0;
const DEPTHS: f64 = 6.0;

/// Values of a block, one after the other, before the search uphill.
const VALUES_OF_A_BLOCK: u64 = 190_000;

/// The share of the bounds that a case takes.
fn share(probe: &mut Probe<Recorded>, case: &Case, subpixel: Subpixel) -> Result<f64, String> {
    let (u, zs) = probe.interpolated(&case.vertices(), case.pixel).ok_or("a covered sample was not drawn")?;
    ensure!(within(u, case.u) && within(zs, case.zs), "{u} or {zs} is outside: {case:?}");
    let sample = case.sample(subpixel);
    let value = dd::hyperbolic(case.tri, sample, case.q(), case.u).error_in_eps(u, case.largest()).abs();
    let exact = dd::linear(case.tri, sample, case.zs);
    let depth = if exact.to_f64() > 0.0 { exact.error_in_eps(zs, exact.to_f64()).abs() } else { 0.0 };
    ensure!(value <= VALUES && depth <= DEPTHS, "value off by {value}, depth by {depth}: {case:?}");
    Ok(value)
}

/// Random cases, and the worst of some made worse; even blocks on the grid of 256ths, odd ones on that of 16ths.
///
/// # Errors
/// A case beyond a bound.
pub fn block(block: u64, seed: u64) -> Result<Found, String> {
    let subpixel = if block.is_multiple_of(2) { Subpixel::Sub8 } else { Subpixel::Sub4 };
    let (mut rng, mut probe) = (rng(block, seed), Probe::new(Recorded, subpixel));
    let (mut worst, mut case) = (0.0_f64, any_case(subpixel, &mut rng));
    for number in 0..VALUES_OF_A_BLOCK {
        // Finding a place takes longer than drawing it: several sets of values share one.
        case = if number % 4 == 0 { any_case(subpixel, &mut rng) } else { case.with_other_values(&mut rng) };
        worst = worst.max(share(&mut probe, &case, subpixel)?);
    }
    let (samples, steps) = (2_000, 2_000);
    let mut fault = None;
    let climbed = climb(seed ^ !block, samples, steps, |rng| {
        let case = any_case(subpixel, rng);
        share(&mut probe, &case, subpixel).unwrap_or_else(|message| {
            fault.get_or_insert(message);
            0.0
        })
    });
    match fault {
        Some(message) => Err(message),
        None => Ok(Found { cases: VALUES_OF_A_BLOCK + samples + 4 * steps, worst: worst.max(climbed.most) }),
    }
}
