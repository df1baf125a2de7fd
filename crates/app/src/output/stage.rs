//! The stages of a run. Each has its own time, without those within it, and is shown to people who wait.

use std::cell::RefCell;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A stage of the work, in the order of a summary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Reading a model, or making it.
    Load,
    /// Reading and decoding images.
    Maps,
    /// Making their smaller levels.
    MipMaps,
    /// Drawing the numbers beside a picture.
    Numbers,
    /// Drawing the shadow on a ground.
    Shadow,
    /// Drawing a picture.
    Draw,
    /// Drawing it once more, by one thread, to count.
    Count,
    /// Encoding and writing files.
    Encode,
    /// Making an asset.
    Bake,
    /// Trying policies.
    Try,
    /// Following a pixel.
    Explain,
    /// Comparing pictures.
    Compare,
}

/// The name of each stage, and what is said while it goes on.
const WORDS: [(&str, &str); 12] = [
    ("load", "loading"),
    ("maps", "reading maps"),
    ("mip_maps", "making mip maps"),
    ("numbers", "drawing numbers"),
    ("shadow", "drawing the shadow"),
    ("draw", "drawing"),
    ("count", "counting"),
    ("encode", "encoding"),
    ("bake", "baking"),
    ("try", "trying policies"),
    ("explain", "following the pixel"),
    ("compare", "comparing"),
];

/// The stages that pictures have.
const OF_PICTURES: usize = 8;

/// Work that is over sooner shows nothing.
const PATIENCE: Duration = Duration::from_millis(400);

/// The time between two looks at it.
const TICK: Duration = Duration::from_millis(100);

/// Whether nobody wants to hear of anything but errors and results. It belongs to the process, as standard error does.
static SILENT: AtomicBool = AtomicBool::new(false);

/// Shows no stages and no warnings from now on, or does.
pub(crate) fn silence(silent: bool) {
    SILENT.store(silent, Ordering::Relaxed);
}

/// Whether stages and warnings are left out.
pub(crate) fn is_silent() -> bool {
    SILENT.load(Ordering::Relaxed)
}

thread_local! {
    /// The stages of this thread, which are those of a command: its helpers begin none.
    static RUN: RefCell<Run> = RefCell::default();
}

#[derive(Default)]
struct Run {
    spent: [Duration; WORDS.len()],
    /// The stages that go on, the innermost last.
    within: Vec<Stage>,
    /// The time at which the innermost one began, or went on.
    since: Option<Instant>,
    /// The line that somebody sees of it.
    shown: Option<Shown>,
    /// Whether it is another thread's that is seen.
    is_hidden: bool,
}

impl Run {
    /// Adds the time of the innermost stage so far.
    fn count(&mut self) {
        let now = Instant::now();
        if let (Some(since), Some(&stage)) = (self.since, self.within.last()) {
            self.spent[stage as usize] += now - since;
        }
        self.since = Some(now);
    }
}

/// Begins a run, whose stages have taken no time.
pub(crate) fn begin() {
    RUN.with_borrow_mut(|run| run.spent = [Duration::ZERO; WORDS.len()]);
}

/// Divides the time of stages that went on at once by the work that threads did in each of several.
pub(crate) fn divide(at_once: [Stage; 2], works: [(Stage, Duration); 3]) {
    let all: f64 = works.iter().map(|(_, work)| work.as_secs_f64()).sum();
    if all <= 0.0 {
        return;
    }
    RUN.with_borrow_mut(|run| {
        let whole: Duration =
            at_once.into_iter().map(|stage| std::mem::take(&mut run.spent[stage as usize])).sum();
        for (stage, work) in works {
            run.spent[stage as usize] += whole.mul_f64(work.as_secs_f64() / all);
        }
    });
}

/// The time of a stage since [`begin`].
pub(crate) fn time(stage: Stage) -> Duration {
    RUN.with_borrow(|run| run.spent[stage as usize])
}

/// The names of a picture's stages, and the time of each since [`begin`].
pub(crate) fn times() -> [(&'static str, Duration); OF_PICTURES] {
    RUN.with_borrow(|run| std::array::from_fn(|k| (WORDS[k].0, run.spent[k])))
}

/// Those that take time, in words for the end of a line.
pub(crate) fn summary(times: &[(&'static str, Duration)]) -> String {
    let times = times.iter().map(|(name, time)| (name.replace('_', " "), time.as_secs_f64() * 1e3));
    let seen = times.filter(|(_, time)| *time >= 0.05).map(|(name, time)| format!("{name} {time:.1} ms"));
    let words = seen.collect::<Vec<_>>().join(", ");
    if words.is_empty() { words } else { format!("; {words}") }
}

/// Does the work of a stage, which says how far it is where it knows.
pub(crate) fn during<T>(stage: Stage, work: impl FnOnce(&Progress) -> T) -> T {
    let bar = RUN.with_borrow_mut(|run| {
        run.count();
        run.within.push(stage);
        if run.shown.is_none() && !run.is_hidden && has_reader() {
            run.shown = Shown::new();
        }
        run.shown.as_ref().map(|shown| shown.bar.clone())
    });
    let progress = Progress(bar);
    let before = progress.turn_to(stage);
    let result = work(&progress);
    let over = RUN.with_borrow_mut(|run| {
        run.count();
        run.within.pop();
        run.shown.take_if(|_| run.within.is_empty())
    });
    if over.is_none() {
        progress.turn_back(before);
    }
    result
}

/// Does work that counts as a stage while another one is shown, of which it is a part.
pub(crate) fn counted_as<T>(stage: Stage, work: impl FnOnce() -> T) -> T {
    let turn = |change: &dyn Fn(&mut Run)| {
        RUN.with_borrow_mut(|run| {
            run.count();
            change(run);
        });
    };
    turn(&|run| run.within.push(stage));
    let result = work();
    turn(&|run| _ = run.within.pop());
    result
}

/// Shows no stages of this thread, which works for another one's.
pub(crate) fn hide() {
    RUN.with_borrow_mut(|run| run.is_hidden = true);
}

/// Prints something while a stage is shown.
pub(crate) fn aside(print: impl FnOnce()) {
    match RUN.with_borrow(|run| run.shown.as_ref().map(|shown| shown.bar.clone())) {
        Some(bar) => bar.suspend(print),
        None => print(),
    }
}

/// Whether there is somebody to show a stage to.
fn has_reader() -> bool {
    std::io::stderr().is_terminal() && !is_silent()
}

/// How far a stage is.
#[derive(Debug)]
pub(crate) struct Progress(Option<ProgressBar>);

/// The words, the position and the length of a bar.
type Look = (String, u64, Option<u64>);

impl Progress {
    /// `done` of `total`, in whatever unit.
    pub(crate) fn set(&self, done: u64, total: u64) {
        if let Some(bar) = &self.0 {
            bar.set_length(total);
            bar.set_position(done);
        }
    }

    fn turn_to(&self, stage: Stage) -> Option<Look> {
        let bar = self.0.as_ref()?;
        let before = (bar.message(), bar.position(), bar.length());
        show(bar, (WORDS[stage as usize].1.to_owned(), 0, None));
        Some(before)
    }

    fn turn_back(&self, before: Option<Look>) {
        if let Some((bar, before)) = self.0.as_ref().zip(before) {
            show(bar, before);
        }
    }
}

fn show(bar: &ProgressBar, (words, position, length): Look) {
    match length {
        Some(length) => bar.set_length(length),
        None => bar.unset_length(),
    }
    bar.set_position(position);
    bar.set_message(words);
}

/// A line on standard error that appears if stages take long, and is gone when this is dropped.
struct Shown {
    bar: ProgressBar,
    over: Option<Sender<()>>,
    painter: Option<JoinHandle<()>>,
}

impl Shown {
    /// Nothing is shown yet. None where there is no thread to show it.
    fn new() -> Option<Self> {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        let (over, is_over) = mpsc::channel();
        let painted = bar.clone();
        let painter = Builder::new().spawn(move || paint(&painted, &is_over)).ok()?;
        Some(Self { bar, over: Some(over), painter: Some(painter) })
    }
}

impl Drop for Shown {
    fn drop(&mut self) {
        drop(self.over.take());
        // The painter does not panic; if it did, the work would be done all the same.
        let _ = self.painter.take().map(JoinHandle::join);
    }
}

/// Shows a bar after a while: how far it is, or that it goes on where that is not known, or all is counted.
fn paint(bar: &ProgressBar, over: &Receiver<()>) {
    let goes_on = |time| over.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
    if !goes_on(PATIENCE) {
        return;
    }
    let style = |template| {
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner())
    };
    let counted = |bar: &ProgressBar| bar.length().is_some_and(|length| bar.position() < length);
    let mut was = None;
    bar.set_draw_target(ProgressDrawTarget::stderr());
    loop {
        let is = counted(bar);
        if was != Some(is) {
            bar.set_style(style(if is {
                "{msg} {wide_bar} {percent:>3}%"
            } else {
                "{msg} {spinner} {elapsed}"
            }));
            was = Some(is);
        }
        bar.tick();
        if !goes_on(TICK) {
            break;
        }
    }
    bar.finish_and_clear();
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread::sleep;

    /// Time that passes while threads draw and one of them encodes: a quarter, a half, and a quarter of it.
    #[test]
    fn stages_at_once_share_their_time() {
        begin();
        let seconds = Duration::from_secs;
        RUN.with_borrow_mut(|run| {
            run.spent[Stage::Shadow as usize] = seconds(1);
            (run.spent[Stage::Draw as usize], run.spent[Stage::Encode as usize]) = (seconds(1), seconds(7));
        });
        let works = [(Stage::Draw, seconds(3)), (Stage::Shadow, seconds(6)), (Stage::Encode, seconds(3))];
        divide([Stage::Draw, Stage::Encode], works);
        assert_eq!([Stage::Draw, Stage::Shadow, Stage::Encode].map(time), [2, 5, 2].map(seconds));
        // Without any work nothing is known of it.
        divide([Stage::Draw, Stage::Encode], works.map(|(stage, _)| (stage, Duration::ZERO)));
        assert_eq!([Stage::Draw, Stage::Shadow, Stage::Encode].map(time), [2, 5, 2].map(seconds));
    }

    #[test]
    fn parts_of_a_stage_have_their_own_time() {
        begin();
        let nap = Duration::from_millis(20);
        during(Stage::Draw, |_| {
            sleep(nap);
            counted_as(Stage::Encode, || sleep(3 * nap));
        });
        assert!(time(Stage::Draw) >= nap && time(Stage::Encode) >= 3 * nap);
        assert!(time(Stage::Draw) < time(Stage::Encode));
    }

    #[test]
    fn a_stage_has_its_own_time() {
        begin();
        let nap = Duration::from_millis(20);
        let start = Instant::now();
        let told = during(Stage::Load, |progress| {
            progress.set(1, 2);
            sleep(nap);
            let within = during(Stage::Maps, |_| {
                sleep(2 * nap);
                7
            });
            sleep(nap);
            within
        });
        let whole = start.elapsed();
        assert_eq!(told, 7);
        let of = |name| times().into_iter().find(|&(other, _)| other == name).expect("a stage").1;
        assert!(of("load") >= 2 * nap && of("maps") >= 2 * nap);
        assert!(of("load") + of("maps") <= whole);
        assert!(times().iter().filter(|(_, time)| !time.is_zero()).count() == 2);
        begin();
        assert!(times().iter().all(|(_, time)| time.is_zero()));
    }

    #[test]
    fn words_are_those_of_the_stages() {
        assert_eq!(WORDS[Stage::Compare as usize].0, "compare");
        assert_eq!(WORDS[Stage::Encode as usize].0, "encode");
        assert_eq!(Stage::Encode as usize + 1, OF_PICTURES);
    }
}
