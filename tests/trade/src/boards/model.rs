//! The costs of chips as sums: so much for each vertex, triangle, row, run and pixel, fitted to small scenes.

use super::fit::{Amounts, fit, total};
use super::price::{Policy, Price, Special, policy};
use super::scene_file::{JUDGED, scenes};
use crate::scenes::Scene;
use alberti_app::advise::{Work, work};
use alberti_app::options::Filter;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Columns and rows of the boards' display.
const SIZE: [u32; 2] = [320, 240];

/// A line of the table of prices: what a policy, or its difference from the usual, costs.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The board.
    pub board: String,
    /// Lines, depth, subpixel or filter.
    pub kind: String,
    /// The policy's name, or the part of it.
    pub name: String,
    /// Instructions for each kind of work.
    pub(super) prices: Amounts,
    /// Bytes of code.
    pub code: f64,
    /// Bytes of stack.
    pub stack: f64,
}

/// An estimate beside what was counted.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// The board.
    pub board: String,
    /// The scene.
    pub scene: &'static str,
    /// The policy.
    pub policy: String,
    /// Estimated as a multiple of what was counted.
    pub ratio: f64,
}

/// The prices that an entry is fitted to.
type Group<'a> = Vec<(&'a Price, Policy)>;

/// The table of prices, and how far it is from what was counted on the scenes that it was not fitted to.
pub fn model(prices: &[Price]) -> (Vec<Entry>, Vec<Estimate>) {
    let mut fitting =
        Fitting { scenes: scenes(), works: BTreeMap::new(), entries: vec![], estimates: vec![] };
    let mut boards: Vec<&str> = prices.iter().map(|price| price.board.as_str()).collect();
    boards.dedup();
    for board in boards {
        // By entries, of which that with budgets has several policies. What is usual comes first: the rest is measured
        // by it, light at vertices by integers besides. What is both lit and of integers comes last: it has no entry,
        // and judges the sum of others.
        let order = |special: Option<Special>| match special {
            None => 0,
            Some(Special::Vertex) => 2,
            Some(Special::Baked) => 3,
            Some(_) => 1,
        };
        let mut groups: BTreeMap<_, Group<'_>> = BTreeMap::new();
        for price in prices.iter().filter(|price| price.board == board) {
            let Some(policy) = policy(&price.policy) else { continue };
            let (kind, name) = labelled(&price.policy, policy);
            groups.entry((order(policy.special), kind, name)).or_default().push((price, policy));
        }
        for ((order, kind, name), group) in groups {
            match order {
                3 => fitting.judge_baked(board, &group),
                _ => fitting.entry(board, kind, name, &group),
            }
        }
    }
    (fitting.entries, fitting.estimates)
}

/// What is known so far.
struct Fitting {
    scenes: Vec<&'static Scene>,
    /// The work of policies on scenes: it is the same on every board.
    works: BTreeMap<(usize, String), Amounts>,
    entries: Vec<Entry>,
    estimates: Vec<Estimate>,
}

impl Fitting {
    /// Fits an entry to its prices, and estimates what it was not fitted to.
    fn entry(&mut self, board: &str, kind: String, name: String, group: &[(&Price, Policy)]) {
        let bases = group.first().map_or(vec![], |(price, policy)| {
            let lines = price.policy.split_once(", ").map(|(lines, _)| ("lines", lines));
            let mesh = (policy.special == Some(Special::Vertex)).then_some(("fixed mesh", "integers"));
            lines.into_iter().chain(mesh).collect()
        });
        let bases = bases.iter().filter_map(|base| {
            self.entries.iter().find(|entry| entry.board == board && (&*entry.kind, &*entry.name) == *base)
        });
        let mut base = Amounts::default();
        let (mut base_code, mut base_stack) = (0.0, 0.0);
        for entry in bases {
            base.iter_mut().zip(entry.prices).for_each(|(sum, price)| *sum += price);
            base_code += entry.code;
            base_stack += entry.stack;
        }
        let frames = group.iter().filter_map(|(price, policy)| Some((price.scene?, *price, *policy)));
        let (judged, small): (Vec<_>, Vec<_>) = frames.partition(|(number, ..)| *number < JUDGED.len());
        let rows: Vec<(Amounts, f64)> = small
            .iter()
            .map(|&(number, price, policy)| {
                let amounts = self.work(number, price, policy);
                (amounts, float(price.count) - total(&base, &amounts))
            })
            .collect();
        let scales: Vec<f64> = small.iter().map(|(_, price, _)| float(price.count)).collect();
        let (asked, can_be_cheaper) = asked(&kind);
        // With its base, no work costs less than nothing.
        let least = base.map(|price| if can_be_cheaper { -price } else { 0.0 });
        let fitted = fit(&rows, &scales, asked, &least);
        for (number, price, policy) in judged {
            let amounts = self.work(number, price, policy);
            let estimate = total(&base, &amounts) + total(&fitted, &amounts);
            self.estimates.push(Estimate {
                board: board.to_owned(),
                scene: JUDGED[number],
                policy: price.policy.clone(),
                ratio: estimate / float(price.count),
            });
        }
        let most = |of: fn(&Price) -> Option<u64>| {
            float(group.iter().filter_map(|(price, _)| of(price)).max().unwrap_or_default())
        };
        let code = most(|price| price.scene.is_none().then_some(price.count)) - base_code;
        let stack = most(|price| Some(price.stack)) - base_stack;
        self.entries.push(Entry { board: board.to_owned(), kind, name, prices: fitted, code, stack });
    }

    /// Estimates frames that are lit and of integers by the sum of both.
    fn judge_baked(&mut self, board: &str, group: &[(&Price, Policy)]) {
        for (price, policy) in group {
            let Some(number) = price.scene.filter(|&number| number < JUDGED.len()) else { continue };
            let amounts = self.work(number, price, *policy);
            let lines = price.policy.split(", ").next().unwrap_or_default();
            let parts = [("lines", lines), ("fixed mesh", "integers"), ("fixed light", "lambert")];
            let own = self.entries.iter().filter(|entry| entry.board == board);
            let own = own.filter(|entry| parts.contains(&(&entry.kind, &entry.name)));
            let estimate: f64 = own.map(|entry| total(&entry.prices, &amounts)).sum();
            self.estimates.push(Estimate {
                board: board.to_owned(),
                scene: JUDGED[number],
                policy: price.policy.clone(),
                ratio: estimate / float(price.count),
            });
        }
    }

    fn work(&mut self, number: usize, price: &Price, policy: Policy) -> Amounts {
        let scene = self.scenes[number];
        *self.works.entry((number, price.policy.clone())).or_insert_with(|| {
            let options = policy.candidate.options(&scene.options(SIZE, Filter::Nearest));
            work(&scene.model, &scene.camera, &options).expect("a scene that can be drawn").counts()
        })
    }
}

/// The kinds of work that a kind of policy has a say in, and whether it can be cheaper than what is usual.
fn asked(kind: &str) -> (fn(&str) -> bool, bool) {
    match kind {
        "lines" => (|_| true, false),
        // What is found once a run is found once a row there.
        "float filter" => (|work| !["frame", "vertex", "submitted", "clipped", "run"].contains(&work), false),
        "fixed filter" => (|work| ["small", "wide", "run", "written"].contains(&work), false),
        "fixed light" | "float light" => (|work| !["frame", "submitted"].contains(&work), false),
        "fixed mesh" => (|work| ["vertex", "submitted", "clipped"].contains(&work), true),
        _ => (|work| !["frame", "vertex", "submitted", "clipped", "run"].contains(&work), true),
    }
}

/// The kind of a policy's line in the table, and its name there.
fn labelled(name: &str, policy: Policy) -> (String, String) {
    let (lines, special) = name.split_once(", ").unwrap_or((name, ""));
    let arithmetic = lines.split(' ').next().unwrap_or(lines);
    match policy.special {
        None => ("lines".to_owned(), name.split(":0.").next().unwrap_or(name).to_owned()),
        Some(Special::Depth) => (format!("{arithmetic} depth"), special.to_owned()),
        Some(Special::Subpixel) => (format!("{arithmetic} subpixel"), special.to_owned()),
        Some(Special::Filter) => (format!("{arithmetic} filter"), special.to_owned()),
        Some(Special::Light) => (format!("{arithmetic} light"), special.to_owned()),
        Some(Special::Vertex) => (format!("{arithmetic} light"), "vertex".to_owned()),
        Some(Special::Mesh | Special::Baked) => (format!("{arithmetic} mesh"), special.to_owned()),
    }
}

pub(super) fn float(count: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let float = count as f64;
    float
}

/// How far a board's estimates are off in percent, by shares of them in percent.
pub(super) fn off(estimates: &[&Estimate], shares: [usize; 3]) -> [f64; 3] {
    let mut off: Vec<f64> = estimates.iter().map(|estimate| (estimate.ratio - 1.0).abs() * 100.0).collect();
    off.sort_by(f64::total_cmp);
    shares.map(|share| off.get((off.len().max(1) - 1) * share / 100).copied().unwrap_or_default())
}

/// The table as the command reads it.
pub fn csv(entries: &[Entry], estimates: &[Estimate]) -> String {
    let mut text = format!("target,kind,name,{},flash,stack\n", Work::NAMES.join(","));
    for Entry { board, kind, name, prices, code, stack } in entries {
        let prices: Vec<String> = prices.iter().map(|price| format!("{price:.2}")).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{board},{kind},{name},{},{code},{stack}", prices.join(","));
    }
    let mut boards: Vec<&str> = entries.iter().map(|entry| entry.board.as_str()).collect();
    boards.dedup();
    for board in boards {
        let of = |holds: fn(Special) -> bool, usual| -> Vec<&Estimate> {
            let own = estimates.iter().filter(|estimate| estimate.board == board);
            let special = |estimate: &&Estimate| policy(&estimate.policy).map(|policy| policy.special);
            own.filter(|estimate| special(estimate).is_some_and(|special| special.map_or(usual, holds)))
                .collect()
        };
        let asked = off(&of(|special| !special.is_of_baked(), true), [50, 90, 100]);
        let [baked, ..] =
            off(&of(|special| matches!(special, Special::Vertex | Special::Baked), false), [100; 3]);
        let [median, most, worst] = asked;
        for (name, off) in [("median", median), ("most", most), ("worst", worst), ("baked", baked)] {
            let _ = writeln!(text, "{board},off,{name},{off:.1}{}", ",0".repeat(Work::NAMES.len() + 1));
        }
    }
    text
}
