//! Prints the tables of `docs/accuracy.md`; `cargo xtask accuracy` writes the file.

use alberti_accuracy::{Spread, run, tables};
use alberti_oracle::rng::{FIXED_SEED, Rng};

/// Errors to a row: enough that 99.9 % has twenty beyond it.
const SAMPLES: usize = 20_000;

fn main() {
    for table in tables() {
        println!("\n## {}\n\n{}\n", table.title, table.about);
        println!("| function | region | bound, ε | max, ε | 99.9 % | median | max, ULP | 99.9 % | median |");
        println!("|---|---|---|---|---|---|---|---|---|");
        for row in &table.rows {
            let [eps, ulp] = run(row, SAMPLES, &mut Rng::stream(FIXED_SEED, row.stream())).map(cells);
            println!("| `{}` | {} | {} | {eps} | {ulp} |", row.function, row.region, number(row.bound));
        }
    }
}

fn cells(spread: Spread) -> String {
    [spread.max, spread.high, spread.median].map(number).join(" | ")
}

/// Two decimals where they tell something, powers of ten where there are many digits; a dash for what there is not.
fn number(x: f64) -> String {
    match x {
        _ if x.is_nan() => "–".to_owned(),
        _ if x.is_infinite() => "∞".to_owned(),
        _ if x >= 1000.0 => format!("{x:.1e}"),
        _ => format!("{x:.2}"),
    }
}
