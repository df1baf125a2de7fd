//! A progress bar for people who wait.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work that is over sooner shows no bar.
const PATIENCE: Duration = Duration::from_millis(400);

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
        Self { start: Instant::now(), what, terminal: std::io::stderr().is_terminal(), bar: None }
    }

    /// `done` of `total`, in whatever unit.
    pub(crate) fn set(&mut self, done: u64, total: u64) {
        if !self.terminal || (self.bar.is_none() && self.start.elapsed() < PATIENCE) {
            return;
        }
        let what = self.what;
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
        }
    }
}
