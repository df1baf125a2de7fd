//! All checks in one run: what continuous integration calls, and what to call before a commit.

use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{env, fs, io, thread};

use crate::command::Outcome;
use crate::{assets, checks, extremes, gallery, guide, package, tidy, trade, workspace};

/// The name that the summary and a failure use, and the check.
type Step = (&'static str, fn() -> Outcome);

const TEST: Step = ("test", checks::test);

/// The chores that build for boards and run there, by their words. They have build directories of their own, and much
/// of their time one core waits for the other: so they are done beside the other checks.
const BESIDE: [&[&str]; 3] = [&["nostd"], &["boards", "check"], &["firmware"]];

/// A chore that was done beside others.
struct Done {
    name: String,
    elapsed: Duration,
    outcome: Outcome,
    printed: String,
}

/// Runs every check in order and stops at the first that fails.
///
/// The order is by the price of finding a failure: text first, then one compilation, then the tests, then the builds
/// that start from nothing. Little is compiled twice: `docs` and `package` share the metadata of most dependencies with
/// `lint`, and `trade` has the libraries that `gallery` has compiled.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let tests_done = match arguments {
        [] => false,
        [flag] if flag == "--tests-done" => true,
        _ => return Err(format!("expected nothing or `--tests-done`, found `{}`", arguments.join(" "))),
    };
    run_steps(&steps(tests_done), &BESIDE, chore)
}

/// The checks in order, without `test` where the caller has just run `cargo test --workspace` on this tree.
fn steps(tests_done: bool) -> Vec<Step> {
    let mut steps: Vec<Step> = vec![
        ("tidy", tidy::run),
        ("assets", assets::check),
        ("fmt", checks::fmt),
        ("lint", checks::lint),
        ("docs", checks::docs),
        TEST,
        ("gallery", gallery::check),
        ("trade", trade::check),
        ("registers", checks::registers),
        ("extremes", extremes::check),
        ("package", package::run),
        ("guide", guide::run),
    ];
    steps.retain(|(name, _)| !(tests_done && *name == TEST.0));
    steps
}

/// Runs the steps, and chores beside them, of which is told at the end.
fn run_steps(steps: &[Step], beside: &[&[&str]], chore: fn(&[&str]) -> Result<String, String>) -> Outcome {
    let start = Instant::now();
    let failed = AtomicBool::new(false);
    let ((mut summary, outcome), done) = thread::scope(|scope| {
        let others = scope.spawn(|| run_beside(beside, chore, &failed));
        let own = in_order(steps, &failed);
        (own, others.join())
    });
    let done = done.map_err(|_| "a chore beside the others panicked".to_owned())?;
    let mut outcomes = vec![outcome];
    for Done { name, elapsed, outcome, printed } in done {
        let elapsed = seconds(elapsed);
        println!("\n==> {name}, beside the others\n{printed}");
        println!("==> {name} {} {elapsed}", if outcome.is_ok() { "passed in" } else { "failed after" });
        summary.push_str(&format!("    {name:<12}{elapsed:>9}\n"));
        outcomes.push(outcome.map_err(|message| format!("step `{name}`: {message}")));
    }
    outcomes.into_iter().collect::<Outcome>()?;
    let all = steps.len() + beside.len();
    println!("\nxtask ci: all {all} steps passed in {}\n{summary}", seconds(start.elapsed()));
    Ok(())
}

/// Runs steps up to the first that fails, or after which another has: lines of the summary, and the outcome.
fn in_order(steps: &[Step], failed: &AtomicBool) -> (String, Outcome) {
    let mut summary = String::new();
    for (index, (name, step)) in steps.iter().enumerate() {
        if failed.load(Ordering::Relaxed) {
            break;
        }
        println!("\n==> {name} ({} of {})", index + 1, steps.len());
        let start = Instant::now();
        let outcome = step();
        let elapsed = seconds(start.elapsed());
        if let Err(message) = outcome {
            failed.store(true, Ordering::Relaxed);
            println!("==> {name} failed after {elapsed}");
            return (summary, Err(format!("step `{name}`: {message}")));
        }
        println!("==> {name} passed in {elapsed}");
        summary.push_str(&format!("    {name:<12}{elapsed:>9}\n"));
    }
    (summary, Ok(()))
}

fn run_beside(
    chores: &[&[&str]],
    chore: fn(&[&str]) -> Result<String, String>,
    failed: &AtomicBool,
) -> Vec<Done> {
    let mut all = Vec::new();
    for words in chores {
        if failed.load(Ordering::Relaxed) {
            break;
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
        assert_eq!(run_steps(&steps, &[], |_| Ok(String::new())), Err("step `bad`: no".into()));
    }

    #[test]
    fn a_failure_beside_the_others_is_named_and_ends_the_run() {
        let chore = |words: &[&str]| match words[0] {
            "good" => Ok(String::new()),
            "bad" => Err("no".to_owned()),
            _ => panic!("a chore after the failure ran"),
        };
        let outcome = run_steps(&[], &[&["good"], &["bad", "check"], &["never"]], chore);
        assert_eq!(outcome, Err("step `bad`: see above".into()));
        let wait = || {
            std::thread::sleep(Duration::from_millis(200));
            Ok(())
        };
        let steps: [Step; 2] = [("wait", wait), ("never", || panic!("a step after the failure ran"))];
        assert_eq!(run_steps(&steps, &[&["bad"]], chore), Err("step `bad`: see above".into()));
    }

    #[test]
    fn what_is_done_beside_is_a_chore() {
        for words in BESIDE {
            assert!(crate::CHORES.iter().any(|chore| chore.name == words[0]), "{words:?}");
        }
    }

    #[test]
    fn only_the_test_step_depends_on_the_flag() {
        let names = |done| steps(done).iter().map(|step| step.0).collect::<Vec<_>>();
        let (mut all, without) = (names(false), names(true));
        all.retain(|name| *name != "test");
        assert_eq!((all, without.len() + 1), (without.clone(), steps(false).len()));
    }

    #[test]
    fn an_unknown_flag_is_refused() {
        assert!(run(&["--fast".to_string()]).unwrap_err().contains("`--fast`"));
    }
}
