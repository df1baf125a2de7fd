//! Least squares: the price of each kind of work, from the prices of frames.

use alberti_app::advise::Work;

/// Kinds of work, the frame itself first.
pub(super) const KINDS: usize = Work::NAMES.len();

/// How much work of each kind there is.
pub(super) type Amounts = [f64; KINDS];

/// Passes over all kinds. More change no digit.
const PASSES: usize = 20_000;

/// The prices by which amounts add up to totals, each total weighing the same: the squares of relative errors are
/// least. `scales` are the totals that errors are relative to. Only kinds that are `asked` have prices, and none is
/// below its `least`.
///
/// Each kind in turn takes its best price, until none changes. A little is asked for prices near 0, so that kinds which
/// no frame tells apart share evenly.
pub(super) fn fit(
    rows: &[(Amounts, f64)],
    scales: &[f64],
    asked: impl Fn(&str) -> bool,
    least: &Amounts,
) -> Amounts {
    let rows: Vec<(Amounts, f64)> = rows
        .iter()
        .zip(scales)
        .map(|((amounts, total), scale)| (amounts.map(|amount| amount / scale), total / scale))
        .collect();
    let norms: Amounts = std::array::from_fn(|kind| {
        rows.iter().map(|(amounts, _)| amounts[kind] * amounts[kind]).sum::<f64>().sqrt()
    });
    let mut prices = [0.0; KINDS];
    let mut rest: Vec<f64> = rows.iter().map(|(_, total)| *total).collect();
    for _ in 0..PASSES {
        for kind in 0..KINDS {
            if norms[kind] == 0.0 || !asked(Work::NAMES[kind]) {
                continue;
            }
            let slope: f64 = rows.iter().zip(&rest).map(|((amounts, _), rest)| amounts[kind] * rest).sum();
            let square = norms[kind] * norms[kind];
            let price = ((slope + square * prices[kind]) / (square * (1.0 + EVEN))).max(least[kind]);
            let change = price - prices[kind];
            prices[kind] = price;
            for ((amounts, _), rest) in rows.iter().zip(&mut rest) {
                *rest -= change * amounts[kind];
            }
        }
    }
    prices
}

/// The share by which prices are pulled to 0.
const EVEN: f64 = 1e-4;

/// The price of amounts.
pub(super) fn total(prices: &Amounts, amounts: &Amounts) -> f64 {
    prices.iter().zip(amounts).map(|(price, amount)| price * amount).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_prices_are_found_again() {
        let known = [900.0, 12.0, 30.0, 0.0, 400.0, 70.0, 25.0, 8.0, 20.0, 7.0, 0.0, 3.0, 90.0, 11.0, 2.0];
        // Amounts without a pattern, from 0 to 99.
        let amount = |row: usize, kind: usize| {
            let mixed = (row * 31 + kind * 17 + row * row * 7 + row * kind * 13) % 100;
            f64::from(u32::try_from(mixed).expect("small"))
        };
        let rows: Vec<(Amounts, f64)> = (0..60)
            .map(|row| {
                let amounts = std::array::from_fn(|kind| if kind == 0 { 1.0 } else { amount(row, kind) });
                (amounts, total(&known, &amounts))
            })
            .collect();
        let scales: Vec<f64> = rows.iter().map(|(_, total)| *total).collect();
        let found = fit(&rows, &scales, |_| true, &[0.0; KINDS]);
        for (amounts, total_known) in &rows {
            assert!((total(&found, amounts) / total_known - 1.0).abs() < 2e-3);
        }
        assert!((found[4] / known[4] - 1.0).abs() < 0.05, "{found:?}");
    }

    #[test]
    fn no_price_is_below_its_least() {
        let amounts =
            |vertices| std::array::from_fn(|kind| [1.0, vertices].get(kind).copied().unwrap_or(0.0));
        let rows = [(amounts(1.0), 1.0), (amounts(2.0), 0.5)];
        assert!(fit(&rows, &[1.0, 1.0], |_| true, &[0.0; KINDS])[1] >= 0.0);
        assert!(fit(&rows, &[1.0, 1.0], |_| true, &[-1.0; KINDS])[1] < -0.4);
    }
}
