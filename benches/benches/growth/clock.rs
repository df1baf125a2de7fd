//! The time of the thread that draws.

use std::time::Duration;

/// Seconds that some work takes.
pub(crate) fn seconds(work: impl FnOnce()) -> f64 {
    let start = now();
    work();
    (now() - start).as_secs_f64()
}

/// The processor's time of this thread: neighbours on a busy machine do not count.
#[cfg(unix)]
fn now() -> Duration {
    let now = nix::time::clock_gettime(nix::time::ClockId::CLOCK_THREAD_CPUTIME_ID);
    now.expect("a clock of threads").into()
}

/// The time of the clock.
#[cfg(not(unix))]
fn now() -> Duration {
    static START: std::sync::LazyLock<std::time::Instant> = std::sync::LazyLock::new(std::time::Instant::now);
    START.elapsed()
}
