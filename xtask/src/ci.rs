//! All checks in one run: what continuous integration calls, and what to call before a commit.

mod passed;

use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{env, fs, io, thread};

use crate::command::Outcome;
use crate::{
    assets, bench, book, checks, extremes, film, firmware, fuzz, gallery, guide, package, seeded, supply,
    tidy, trade, web, window, workspace,
};
use passed::Passed;

/// The name that the summary and a failure use, and the check.
type Step = (&'static str, fn() -> Outcome);

/// A chore of this program by its words, under its first word as name.
type Chore = &'static [&'static str];

const TEST: &str = "test";

/// The chores that build for boards and run there. They have build directories of their own, and much of their time one
/// core waits for the other: so they are done beside the other checks.
const BESIDE: [Chore; 3] = [&["nostd"], &["boards", "check"], &["firmware"]];

/// What is still done where `firmware` stands: one board shows that the table is that of these files.
const SAMPLE: Chore = &["firmware", "--board", "m4f"];

/// The wishes of the caller.
#[derive(Debug, PartialEq, Eq, Default)]
struct Options<'a> {
    /// The caller has just run `cargo test --workspace` on this tree.
    tests_done: bool,
    /// Checks are done that stand, too.
    all: bool,
    /// These checks alone, whether they stand or not.
    named: Vec<&'a str>,
    /// Long checks begin within that time alone: the others are told, and are left to a later run.
    within: Option<Duration>,
}

impl<'a> Options<'a> {
    fn read(arguments: &'a [String]) -> Result<Self, String> {
        let mut options = Self::default();
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            match word.as_str() {
                "--within" => {
                    let minutes = words.next().and_then(|minutes| minutes.parse::<u64>().ok());
                    let minutes = minutes.ok_or("expected minutes after `--within`")?;
                    options.within = Some(Duration::from_secs(60 * minutes));
                }
                "--tests-done" => options.tests_done = true,
                "--all" => options.all = true,
                name if names().any(|known| known == name) => options.named.push(name),
                _ => {
                    let names = names().collect::<Vec<_>>().join(", ");
                    return Err(format!(
                        "expected `--tests-done`, `--all`, `--within MINUTES` or one of {names}, found `{word}`"
                    ));
                }
            }
        }
        Ok(options)
    }

    /// Whether a check is done, where it `stands` or not.
    fn takes(&self, name: &str, stands: bool) -> bool {
        if !self.named.is_empty() {
            return self.named.contains(&name);
        }
        !(self.tests_done && name == TEST) && (self.all || !stands)
    }
}

/// The names of all checks.
fn names() -> impl Iterator<Item = &'static str> {
    STEPS.iter().map(|step| step.0).chain(BESIDE.iter().map(|words| words[0]))
}

/// A chore that was done beside others.
struct Done {
    name: String,
    elapsed: Duration,
    outcome: Outcome,
    printed: String,
}

/// The checks in order, by the price of finding a failure: text first, then one compilation, then the tests, then the
/// builds that start from nothing, which may stand. Little is compiled twice: `docs` and `package` share the metadata
/// of most dependencies with `lint`; `lanes`, `film`, `trade` and `guide` have the app that `gallery` has compiled.
const STEPS: &[Step] = &[
    ("tidy", tidy::run),
    ("assets", assets::check),
    ("seeded-bugs", seeded::check),
    ("fmt", checks::fmt),
    ("lint", checks::lint),
    ("docs", checks::docs),
    (TEST, checks::test),
    ("gallery", gallery::check),
    ("lanes", checks::lanes),
    ("film", film::check),
    ("window", window::check),
    ("web", web::check),
    ("book", book::check),
    ("registers", checks::registers),
    ("extremes", extremes::check),
    ("package", package::run),
    ("supply", supply::check),
    ("bench", bench::check),
    ("trade", trade::check),
    ("guide", guide::run),
    ("fuzz", fuzz::check),
    ("fingerprint", || firmware::fingerprint(&[])),
];

/// Runs the checks and stops at the first that fails. Long ones stand if they have passed on the same files before.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let options = Options::read(arguments)?;
    let mut passed = Passed::read()?;
    let takes = |name: &str| options.takes(name, passed.stands(name));
    let steps: Vec<Step> = STEPS.iter().filter(|step| takes(step.0)).copied().collect();
    let mut beside: Vec<Chore> = BESIDE.into_iter().filter(|words| takes(words[0])).collect();
    let standing: Vec<_> = names().filter(|name| passed.stands(name) && !takes(name)).collect();
    if options.named.is_empty() && !standing.is_empty() {
        println!("{} passed on these files ({}): `--all` repeats them", standing.join(", "), passed::PLACE);
        beside.extend(standing.contains(&SAMPLE[0]).then_some(SAMPLE));
    }
    let end = options.within.map(|time| Instant::now() + time);
    let is_late = |name: &str| passed::is_long(name) && end.is_some_and(|end| Instant::now() > end);
    let (mut done, outcome) = run_steps(&steps, &beside, chore, &is_late);
    // A sample is not the whole.
    done.retain(|name| takes(name));
    let late: Vec<_> = names().filter(|name| takes(name) && !done.iter().any(|done| done == name)).collect();
    passed.keep(&done)?;
    if outcome.is_ok() && !late.is_empty() {
        println!("\nNOT CHECKED on these files, for want of time: {}", late.join(", "));
        println!("    cargo xtask ci {}", late.join(" "));
    }
    outcome
}

/// Runs the steps, and chores beside them, of which is told at the end: the names of those that passed, and the first
/// failure. What is late is left out.
fn run_steps(
    steps: &[Step],
    beside: &[Chore],
    chore: fn(&[&str]) -> Result<String, String>,
    is_late: &(dyn Fn(&str) -> bool + Sync),
) -> (Vec<String>, Outcome) {
    let start = Instant::now();
    let failed = AtomicBool::new(false);
    let ((mut passed, outcome), done) = thread::scope(|scope| {
        let others = scope.spawn(|| run_beside(beside, chore, &failed, is_late));
        let own = in_order(steps, &failed, is_late);
        (own, others.join())
    });
    let Ok(done) = done else { return (Vec::new(), Err("a chore beside the others panicked".to_owned())) };
    let mut outcomes = vec![outcome];
    for Done { name, elapsed, outcome, printed } in done {
        println!("\n==> {name}, beside the others\n{printed}");
        println!(
            "==> {name} {} {}",
            if outcome.is_ok() { "passed in" } else { "failed after" },
            seconds(elapsed)
        );
        outcomes.push(outcome.map_err(|message| format!("step `{name}`: {message}")));
        if outcomes.last().is_some_and(Result::is_ok) {
            passed.push((name, elapsed));
        }
    }
    let outcome = outcomes.into_iter().collect::<Outcome>();
    if outcome.is_ok() {
        println!("\nxtask ci: all {} steps passed in {}", passed.len(), seconds(start.elapsed()));
        passed.iter().for_each(|(name, elapsed)| println!("    {name:<12}{:>9}", seconds(*elapsed)));
    }
    (passed.into_iter().map(|(name, _)| name).collect(), outcome)
}

/// Runs steps up to the first that fails, or after which another has: those that passed, and the outcome.
fn in_order(
    steps: &[Step],
    failed: &AtomicBool,
    is_late: &dyn Fn(&str) -> bool,
) -> (Vec<(String, Duration)>, Outcome) {
    let mut passed = Vec::new();
    for (index, (name, step)) in steps.iter().enumerate() {
        if failed.load(Ordering::Relaxed) {
            break;
        }
        if is_late(name) {
            continue;
        }
        println!("\n==> {name} ({} of {})", index + 1, steps.len());
        let start = Instant::now();
        let outcome = step();
        let elapsed = start.elapsed();
        if let Err(message) = outcome {
            failed.store(true, Ordering::Relaxed);
            println!("==> {name} failed after {}", seconds(elapsed));
            return (passed, Err(format!("step `{name}`: {message}")));
        }
        println!("==> {name} passed in {}", seconds(elapsed));
        passed.push(((*name).to_owned(), elapsed));
    }
    (passed, Ok(()))
}

fn run_beside(
    chores: &[Chore],
    chore: fn(&[&str]) -> Result<String, String>,
    failed: &AtomicBool,
    is_late: &dyn Fn(&str) -> bool,
) -> Vec<Done> {
    let mut all = Vec::new();
    for words in chores {
        if failed.load(Ordering::Relaxed) {
            break;
        }
        if is_late(words[0]) {
            continue;
        }
        let start = Instant::now();
        let (printed, outcome) = match chore(words) {
            Ok(printed) => (printed, Ok(())),
            Err(printed) => (printed, Err("see above".to_owned())),
        };
        failed.fetch_or(outcome.is_err(), Ordering::Relaxed);
        all.push(Done { name: words[0].to_owned(), elapsed: start.elapsed(), outcome, printed });
    }
    all
}

/// Runs a chore of this program as a process of its own: what it prints, an error if it fails.
fn chore(words: &[&str]) -> Result<String, String> {
    let run = || -> io::Result<(bool, String)> {
        let path = workspace::target_directory().join(format!("ci-{}.log", words[0]));
        let file = fs::File::create(&path)?;
        let mut command = Command::new(env::current_exe()?);
        command.args(words).stdin(Stdio::null()).stderr(file.try_clone()?).stdout(file);
        let status = command.status()?;
        Ok((status.success(), fs::read_to_string(path)?))
    };
    match run() {
        Ok((true, printed)) => Ok(printed),
        Ok((false, printed)) => Err(printed),
        Err(error) => Err(format!("`{}` cannot be run: {error}", words.join(" "))),
    }
}

fn seconds(duration: Duration) -> String {
    format!("{:.1} s", duration.as_secs_f32())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_is_named_and_ends_the_run() {
        let steps: [Step; 3] = [
            ("good", || Ok(())),
            ("bad", || Err("no".into())),
            ("never", || panic!("a step after the failure ran")),
        ];
        let (passed, outcome) = run_steps(&steps, &[], |_| Ok(String::new()), &|_| false);
        assert_eq!((passed, outcome), (vec!["good".to_owned()], Err("step `bad`: no".into())));
    }

    #[test]
    fn a_failure_beside_the_others_is_named_and_ends_the_run() {
        let chore = |words: &[&str]| match words[0] {
            "good" => Ok(String::new()),
            "bad" => Err("no".to_owned()),
            _ => panic!("a chore after the failure ran"),
        };
        let (passed, outcome) =
            run_steps(&[], &[&["good"], &["bad", "check"], &["never"]], chore, &|_| false);
        assert_eq!((passed, outcome), (vec!["good".to_owned()], Err("step `bad`: see above".into())));
        let wait = || {
            std::thread::sleep(Duration::from_millis(200));
            Ok(())
        };
        let steps: [Step; 2] = [("wait", wait), ("never", || panic!("a step after the failure ran"))];
        assert_eq!(run_steps(&steps, &[&["bad"]], chore, &|_| false).1, Err("step `bad`: see above".into()));
    }

    #[test]
    fn what_is_late_is_left_out() {
        let steps: [Step; 2] = [("short", || Ok(())), ("long", || panic!("a late step ran"))];
        let (passed, outcome) =
            run_steps(&steps, &[&["long", "check"]], |_| panic!("a late chore ran"), &|name| name == "long");
        assert_eq!((passed, outcome), (vec!["short".to_owned()], Ok(())));
        let within = |text: &str| {
            let words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
            Options::read(&words).map(|options| options.within)
        };
        assert_eq!(within("--within 30"), Ok(Some(Duration::from_secs(1800))));
        assert_eq!(within("lint"), Ok(None));
        assert!(within("--within").is_err() && within("--within soon").is_err());
    }

    #[test]
    fn what_is_done_beside_is_a_chore() {
        for words in BESIDE.into_iter().chain([SAMPLE]) {
            assert!(crate::CHORES.iter().any(|chore| chore.name == words[0]), "{words:?}");
        }
    }

    #[test]
    fn checks_are_left_out_or_named() {
        let taken = |text: &str, name, stands| {
            let words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
            Options::read(&words).unwrap().takes(name, stands)
        };
        assert!(taken("", "test", false) && !taken("--tests-done", "test", false));
        assert!(!taken("--tests-done", "boards", true) && taken("--all", "boards", true));
        assert!(taken("boards lint", "boards", true) && !taken("boards lint", "test", false));
    }

    #[test]
    fn an_unknown_word_is_refused() {
        let refused = run(&["--fast".to_string()]).unwrap_err();
        assert!(refused.contains("`--fast`") && refused.contains("tidy, assets"), "{refused}");
    }
}
