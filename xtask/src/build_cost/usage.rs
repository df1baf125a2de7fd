//! The processor's time and the memory of processes that were waited for.

use std::time::Duration;

/// Both for all processes that this one started and waited for, and for those that they waited for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Usage {
    pub(super) cpu: Duration,
    /// The most memory that one of them held at a time.
    pub(super) peak_bytes: u64,
}

/// The usage up to now, where the system tells it.
#[cfg(unix)]
pub(super) fn of_children() -> Option<Usage> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeVal;

    let duration = |time: TimeVal| {
        let seconds = u64::try_from(time.tv_sec()).ok()?;
        let micros = u64::try_from(time.tv_usec()).ok()?;
        Some(Duration::from_secs(seconds) + Duration::from_micros(micros))
    };
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN).ok()?;
    // Apple counts bytes, the others kibibytes.
    let unit = if cfg!(target_vendor = "apple") { 1 } else { 1024 };
    Some(Usage {
        cpu: duration(usage.user_time())? + duration(usage.system_time())?,
        peak_bytes: u64::try_from(usage.max_rss()).ok()? * unit,
    })
}

/// The usage up to now: not told by this system in a way that needs no unsafe code.
#[cfg(not(unix))]
pub(super) fn of_children() -> Option<Usage> {
    None
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_child_counts_after_it_was_waited_for() {
        let before = of_children().unwrap();
        let program = std::env::current_exe().unwrap();
        assert!(std::process::Command::new(program).arg("--list").output().unwrap().status.success());
        let after = of_children().unwrap();
        assert!(after.cpu > before.cpu && after.peak_bytes > 1 << 16, "{before:?} {after:?}");
    }
}
