//! The time of kinds of work that are spread over others.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// A kind of work.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Work {
    /// Reading and decoding images.
    Maps,
    /// Making their smaller levels.
    MipMaps,
}

/// Nanoseconds of each kind, since the process began.
static SPENT: [AtomicU64; 2] = [AtomicU64::new(0), AtomicU64::new(0)];

/// Does work, and adds its time to its kind.
pub(crate) fn timed<T>(kind: Work, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    let nanos = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX);
    SPENT[kind as usize].fetch_add(nanos, Ordering::Relaxed);
    result
}

/// The time of a kind of work so far.
pub(crate) fn spent(kind: Work) -> Duration {
    Duration::from_nanos(SPENT[kind as usize].load(Ordering::Relaxed))
}
