//! All checks in one run: what continuous integration calls, and what to call before a commit.

use std::time::{Duration, Instant};

use crate::command::Outcome;
use crate::{assets, boards, checks, extremes, firmware, gallery, guide, nostd, package, tidy, trade};

/// The name that the summary and a failure use, and the check.
type Step = (&'static str, fn() -> Outcome);

const TEST: Step = ("test", checks::test);

/// Runs every check in order and stops at the first that fails.
///
/// The order is by the price of finding a failure: text first, then one compilation, then the tests, then the builds
/// that start from nothing, and the emulator last. Little is compiled twice: `docs` and `package` share the
/// metadata of most dependencies with `lint`, and `nostd` makes no machine code of the libraries.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let tests_done = match arguments {
        [] => false,
        [flag] if flag == "--tests-done" => true,
        _ => return Err(format!("expected nothing or `--tests-done`, found `{}`", arguments.join(" "))),
    };
    run_steps(&steps(tests_done))
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
        ("registers", checks::registers),
        ("extremes", extremes::check),
        ("trade", trade::check),
        ("package", package::run),
        ("nostd", nostd::run),
        ("boards", boards::check),
        ("guide", guide::run),
        ("firmware", || firmware::run(&[])),
    ];
    steps.retain(|(name, _)| !(tests_done && *name == TEST.0));
    steps
}

fn run_steps(steps: &[Step]) -> Outcome {
    let start = Instant::now();
    let mut summary = String::new();
    for (index, (name, step)) in steps.iter().enumerate() {
        println!("\n==> {name} ({} of {})", index + 1, steps.len());
        let step_start = Instant::now();
        let outcome = step();
        let elapsed = seconds(step_start.elapsed());
        if let Err(message) = outcome {
            println!("==> {name} failed after {elapsed}");
            return Err(format!("step `{name}`: {message}"));
        }
        println!("==> {name} passed in {elapsed}");
        summary.push_str(&format!("    {name:<12}{elapsed:>9}\n"));
    }
    println!("\nxtask ci: all {} steps passed in {}\n{summary}", steps.len(), seconds(start.elapsed()));
    Ok(())
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
        assert_eq!(run_steps(&steps), Err("step `bad`: no".into()));
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
