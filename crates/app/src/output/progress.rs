//! A progress bar for people who wait.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work that is over sooner shows no bar.
const PATIENCE: Duration = Duration::from_millis(400);

/// The time between two looks at work of unknown length.
const TICK: Duration = Duration::from_millis(100);

/// Whether nobody wants to hear of anything but errors and results. It belongs to the process, as standard error does.
static SILENT: AtomicBool = AtomicBool::new(false);

/// Shows no bars and no warnings from now on, or does.
pub(crate) fn silence(silent: bool) {
    SILENT.store(silent, Ordering::Relaxed);
}

/// Whether bars and warnings are left out.
pub(crate) fn is_silent() -> bool {
    SILENT.load(Ordering::Relaxed)
}

/// Whether a bar is shown, beside which there is no other.
static SHOWN: AtomicBool = AtomicBool::new(false);

/// Whether there is somebody to show a bar to.
fn has_reader() -> bool {
    std::io::stderr().is_terminal() && !is_silent()
}

/// Does work of unknown length, and shows that it is done if that takes long.
pub(crate) fn waiting<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    if !has_reader() {
        return work();
    }
    std::thread::scope(|scope| {
        let (done, over) = mpsc::channel::<()>();
        scope.spawn(move || {
            let goes_on = |time| over.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
            if !goes_on(PATIENCE) || SHOWN.swap(true, Ordering::Relaxed) {
                return;
            }
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{msg} {spinner} {elapsed}");
            let bar =
                bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner())).with_message(what);
            while goes_on(TICK) {
                bar.tick();
            }
            bar.finish_and_clear();
            SHOWN.store(false, Ordering::Relaxed);
        });
        let result = work();
        drop(done);
        result
    })
}

/// A bar on standard error that appears only on a terminal and only for work that takes long. It is gone when
/// this is dropped, so that messages have the terminal to themselves.
#[derive(Debug)]
pub(crate) struct Progress {
    start: Instant,
    what: &'static str,
    terminal: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Nothing is shown yet.
    pub(crate) fn new(what: &'static str) -> Self {
        Self { start: Instant::now(), what, terminal: has_reader(), bar: None }
    }

    /// `done` of `total`, in whatever unit.
    pub(crate) fn set(&mut self, done: u64, total: u64) {
        if !self.terminal || (self.bar.is_none() && self.start.elapsed() < PATIENCE) {
            return;
        }
        let what = self.what;
        SHOWN.store(true, Ordering::Relaxed);
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3}%");
            bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())).with_message(what)
        });
        bar.set_length(total);
        bar.set_position(done);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
            SHOWN.store(false, Ordering::Relaxed);
        }
    }
}
