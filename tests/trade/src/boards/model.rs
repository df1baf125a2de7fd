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

/// The work of policies on scenes: it is the same on every board.
#[derive(Debug, Default)]
struct Works(BTreeMap<(usize, String), Amounts>);

impl Works {
    fn of(&mut self, number: usize, scene: &Scene, name: &str, policy: Policy) -> Amounts {
        *self.0.entry((number, name.to_owned())).or_insert_with(|| {
            let options = policy.candidate.options(&scene.options(SIZE, Filter::Nearest));
            let work = work(&scene.model, &scene.camera, &options).expect("a scene that can be drawn");
            if std::env::var_os("SHOW").is_some() {
                eprintln!("W {} {name} {:?}", scene.name, work.counts());
            }
            work.counts()
        })
    }
}

/// The table of prices, and how far it is from what was counted on the scenes that it was not fitted to.
pub fn model(prices: &[Price]) -> (Vec<Entry>, Vec<Estimate>) {
    let scenes = scenes();
    let mut works = Works::default();
    let mut boards: Vec<&str> = prices.iter().map(|price| price.board.as_str()).collect();
    boards.dedup();
    let (mut entries, mut estimates) = (vec![], vec![]);
    for board in boards {
        let own: Vec<&Price> = prices.iter().filter(|price| price.board == board).collect();
        let mut names: Vec<&str> = own.iter().map(|price| price.policy.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        let first = entries.len();
        // What is usual comes first: the rest is measured by it.
        let (special, usual): (Vec<&str>, Vec<&str>) = names.into_iter().partition(|name| name.contains(','));
        for name in usual.into_iter().chain(special) {
            let Some(policy) = policy(name) else { continue };
            let (kind, label) = labelled(name, policy);
            let own: Vec<&Price> = own
                .iter()
                .copied()
                .filter(|price| {
                    super::price::policy(&price.policy)
                        .is_some_and(|other| labelled(&price.policy, other) == (kind.clone(), label.clone()))
                })
                .collect();
            let known = &entries[first..];
            if known.iter().any(|entry: &Entry| entry.name == label && entry.kind == kind) {
                continue;
            }
            let base =
                name.split_once(", ").and_then(|(lines, _)| known.iter().find(|entry| entry.name == lines));
            let base = base.cloned();
            let (mut rows, mut scales) = (vec![], vec![]);
            for price in &own {
                let Some(number) = price.scene.filter(|&number| number >= JUDGED.len()) else { continue };
                let amounts = works.of(
                    number,
                    scenes[number],
                    &price.policy,
                    super::price::policy(&price.policy).expect("a policy"),
                );
                let count = float(price.count);
                rows.push((amounts, count - base.as_ref().map_or(0.0, |base| total(&base.prices, &amounts))));
                scales.push(count);
            }
            let (asked, positive) = asked(&kind);
            let fitted = fit(&rows, &scales, asked, positive);
            let most = |of: fn(&Price) -> u64, code: bool| {
                own.iter()
                    .filter(|price| price.scene.is_none() == code)
                    .map(|price| of(price))
                    .max()
                    .unwrap_or(0)
            };
            let [code, stack] =
                [float(most(|price| price.count, true)), float(most(|price| price.stack, false))];
            let entry = Entry {
                board: board.to_owned(),
                kind,
                name: label,
                prices: fitted,
                code: code - base.as_ref().map_or(0.0, |base| base.code),
                stack: stack - base.as_ref().map_or(0.0, |base| base.stack),
            };
            for price in &own {
                let Some(number) = price.scene.filter(|&number| number < JUDGED.len()) else { continue };
                let amounts = works.of(
                    number,
                    scenes[number],
                    &price.policy,
                    super::price::policy(&price.policy).expect("a policy"),
                );
                let estimate = total(&entry.prices, &amounts)
                    + base.as_ref().map_or(0.0, |base| total(&base.prices, &amounts));
                estimates.push(Estimate {
                    board: board.to_owned(),
                    scene: JUDGED[number],
                    policy: price.policy.clone(),
                    ratio: estimate / float(price.count),
                });
            }
            entries.push(entry);
        }
    }
    (entries, estimates)
}

/// The kinds of work that a kind of policy has a say in, and whether it can only cost more.
fn asked(kind: &str) -> (fn(&str) -> bool, bool) {
    match kind {
        "lines" => (|_| true, true),
        "filter" => (|work| ["small", "narrow", "wide", "run", "written"].contains(&work), true),
        _ => (|work| !["frame", "vertex", "submitted", "clipped", "run"].contains(&work), false),
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
        Some(Special::Filter) => ("filter".to_owned(), special.to_owned()),
    }
}

fn float(count: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let float = count as f64;
    float
}

/// The table as the command reads it.
pub fn csv(entries: &[Entry]) -> String {
    let mut text = format!("target,kind,name,{},flash,stack\n", Work::NAMES.join(","));
    for Entry { board, kind, name, prices, code, stack } in entries {
        let prices: Vec<String> = prices.iter().map(|price| format!("{price:.2}")).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{board},{kind},{name},{},{code},{stack}", prices.join(","));
    }
    text
}
