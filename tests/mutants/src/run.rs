//! Mutants and the tests that pass their switches.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::Options;
use crate::list::Mutant;
use crate::suite::{End, Suite, run as run_test};
use crate::tree::Tree;

/// What became of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// This test failed, or did not end.
    Killed(String),
    /// No test that passes its switch fails.
    Survived,
    /// The quicker tests do not fail; there was no time for the others.
    Unsettled,
    /// No test passes its switch.
    Unreached,
}

impl Verdict {
    fn line(&self, name: &str) -> String {
        match self {
            Self::Killed(test) => format!("{name}\tkilled\t{test}\n"),
            Self::Survived => format!("{name}\tsurvived\t\n"),
            Self::Unsettled => format!("{name}\tunsettled\t\n"),
            Self::Unreached => format!("{name}\tunreached\t\n"),
        }
    }

    fn read(line: &str) -> Option<(&str, Self)> {
        let mut words = line.split('\t');
        let (name, verdict, test) = (words.next()?, words.next()?, words.next()?);
        let verdict = match verdict {
            "killed" => Self::Killed(test.to_owned()),
            "survived" => Self::Survived,
            "unsettled" => Self::Unsettled,
            "unreached" => Self::Unreached,
            _ => return None,
        };
        Some((name, verdict))
    }
}

/// The number of mutants of a file that a test has killed.
#[derive(Default)]
struct Kills(Mutex<HashMap<(PathBuf, String), u32>>);

impl Kills {
    fn add(&self, mutant: &Mutant, verdict: &Verdict) {
        if let Verdict::Killed(test) = verdict {
            let mut kills = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            *kills.entry((mutant.file.clone(), test.clone())).or_default() += 1;
        }
    }

    /// Puts first the tests that kill many of a mutant's file in little time; of the others, the quickest.
    fn order(&self, mutant: &Mutant, suite: &Suite, tests: &mut [usize]) {
        let kills = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        tests.sort_by_cached_key(|&index| {
            let test = &suite.tests[index];
            let count = kills.get(&(mutant.file.clone(), test.name.clone())).copied().unwrap_or_default();
            let rate = f64::from(count) / (test.time.as_secs_f64() + 0.01);
            // As integers, numbers above 0 have the order that they have.
            (std::cmp::Reverse(rate.to_bits()), index)
        });
    }
}

/// Runs the tests of all mutants that have no verdict yet.
pub(crate) fn run(
    tree: &Tree,
    suite: &Suite,
    mutants: &[Mutant],
    alive: &BTreeSet<usize>,
    options: &Options,
) -> Result<BTreeMap<usize, Verdict>, String> {
    let path = tree.folder.join("verdicts.txt");
    let text = fs::read_to_string(&path).unwrap_or_default();
    let known: HashMap<&str, Verdict> = text.lines().filter_map(Verdict::read).collect();
    let wanted = |number: &usize| {
        options.only.as_ref().is_none_or(|only| mutants[*number].name.contains(only.as_str()))
    };
    let mut verdicts = BTreeMap::new();
    let mut left = Vec::new();
    for &number in alive.iter().filter(|number| wanted(number)) {
        match known.get(&*mutants[number].name) {
            Some(verdict @ Verdict::Killed(_)) => _ = verdicts.insert(number, verdict.clone()),
            _ => left.push(number),
        }
    }
    left.sort_by_cached_key(|&number| chance(&mutants[number].name));
    let mut tests_of: HashMap<usize, Vec<usize>> = HashMap::new();
    for (index, test) in suite.tests.iter().enumerate() {
        for &number in &test.reached {
            tests_of.entry(number).or_default().push(index);
        }
    }
    let file = OpenOptions::new().create(true).append(true).open(&path);
    let state = Mutex::new((verdicts, file.map_err(|error| format!("{}: {error}", path.display()))?));
    let kills = Kills::default();
    for (&number, verdict) in &state.lock().map_err(|_| "a thread failed")?.0 {
        kills.add(&mutants[number], verdict);
    }
    let (next, begin) = (AtomicUsize::new(0), Instant::now());
    let work = || -> Result<(), String> {
        while let Some(&number) = left.get(next.fetch_add(1, Ordering::Relaxed)) {
            if begin.elapsed().as_secs_f64() > 60.0 * options.minutes {
                break;
            }
            let mut tests = tests_of.get(&number).cloned().unwrap_or_default();
            kills.order(&mutants[number], suite, &mut tests);
            let verdict = judge(tree, suite, number, &tests, options.seconds)?;
            kills.add(&mutants[number], &verdict);
            let mut state = state.lock().map_err(|_| "another thread failed")?;
            let line = verdict.line(&mutants[number].name);
            state.1.write_all(line.as_bytes()).map_err(|error| error.to_string())?;
            state.0.insert(number, verdict);
            let done = state.0.len();
            if done % 100 == 0 {
                let killed = state.0.values().filter(|verdict| matches!(verdict, Verdict::Killed(_))).count();
                println!("{done} mutants, {killed} of them killed");
            }
        }
        Ok(())
    };
    let threads = thread::available_parallelism().map_or(1, Into::into);
    thread::scope(|scope| {
        let others: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        others.into_iter().try_for_each(|other| other.join().map_err(|_| "a thread failed".to_owned())?)
    })?;
    state.into_inner().map(|(verdicts, _)| verdicts).map_err(|_| "a thread failed".to_owned())
}

/// A number that a name has by chance: FNV-1a, whose high bits are mixed into the low ones.
fn chance(name: &str) -> u64 {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    (hash ^ hash >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

fn judge(
    tree: &Tree,
    suite: &Suite,
    number: usize,
    tests: &[usize],
    seconds: f64,
) -> Result<Verdict, String> {
    if tests.is_empty() {
        return Ok(Verdict::Unreached);
    }
    let (variable, mut spent) = (number.to_string(), 0.0);
    for test in tests.iter().map(|&index| &suite.tests[index]) {
        spent += test.time.as_secs_f64();
        if spent > seconds {
            return Ok(Verdict::Unsettled);
        }
        let most = test.time * 20 + Duration::from_secs(5);
        if run_test(tree, &test.program, &test.name, &[("MUTANT", &variable)], most)? != End::Passed {
            return Ok(Verdict::Killed(test.name.clone()));
        }
    }
    Ok(Verdict::Survived)
}
