//! Films: pictures of one size, one after the other.

pub(crate) mod format;
pub(crate) mod names;
mod palette;
pub(crate) mod rate;
mod webp;
mod y4m;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError, mpsc};
use std::thread::{self, Builder};
use std::time::{Duration, Instant};

use crate::draw::Chains;
use crate::error::Error;
use crate::options::{Projection, RenderOptions, Samples};
use crate::output::stage;
use crate::render::Picture;
use crate::samples::supersampled_with;
use crate::scene::backdrop::Backdrop;
use crate::scene::normals::sub;
use crate::scene::{Camera, Image, Model, order};

/// Frames that a thread may be ahead of those that are handed on.
pub(crate) const EARLY: usize = 2;

/// The common part of all frames of a film: textures and materials of a model, wherever its vertices are, and options.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Set<'a> {
    pub(crate) model: &'a Model,
    pub(crate) options: &'a RenderOptions,
    pub(crate) samples: Samples,
    pub(crate) backdrop: &'a Backdrop,
}

/// Sums over the frames of a film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Drawn {
    /// The time of all threads together.
    pub(crate) work: Duration,
    /// Frames in which nothing of the model is.
    pub(crate) empty: usize,
}

/// The rest of a frame.
pub(crate) struct Shot<'a> {
    pub(crate) model: Cow<'a, Model>,
    pub(crate) camera: Camera,
    pub(crate) projection: Projection,
}

impl<'a> Set<'a> {
    /// Draws so many frames, and hands them on in order. A thread draws a frame: the pictures are those of
    /// [`supersampled_with`], whatever their number.
    ///
    /// # Errors
    /// A frame cannot be drawn, or `take` fails.
    pub(crate) fn draw(
        self,
        count: usize,
        shot: &(dyn Fn(usize) -> Result<Shot<'a>, Error> + Sync),
        take: &mut dyn FnMut(usize, Image) -> Result<(), Error>,
    ) -> Result<Drawn, Error> {
        let chains = Arc::new(Chains::new(self.model, self.options)?);
        let alone = RenderOptions { threads: NonZero::<usize>::MIN, ..*self.options };
        let threads = self.options.threads.get().min(count).max(1);
        let next = AtomicUsize::new(0);
        let (handed, more) = (Mutex::new(0), Condvar::new());
        let sums = Mutex::new(Drawn::default());
        let drawn = |number: usize| {
            let begin = Instant::now();
            let Shot { model, camera, projection } = shot(number)?;
            let (options, of) = (RenderOptions { projection, ..alone }, (&*model, &camera));
            let picture =
                supersampled_with(&chains, of, &options, self.samples, self.backdrop, &mut |_, _| ())?;
            let mut sums = sums.lock().unwrap_or_else(PoisonError::into_inner);
            sums.work += begin.elapsed();
            sums.empty += usize::from(picture.stats.written == 0);
            Ok(picture)
        };
        let frames = |hand: &mut dyn FnMut(usize, Result<Picture, Error>) -> bool| {
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                // Frames that are early wait in memory, so none may be earlier than that.
                let is_early = |handed: &mut usize| number >= handed.saturating_add(EARLY * threads);
                let before = handed.lock().unwrap_or_else(PoisonError::into_inner);
                drop(more.wait_while(before, is_early));
                if number >= count || !hand(number, drawn(number)) {
                    break;
                }
            }
        };
        let hand_on = |count: usize| {
            *handed.lock().unwrap_or_else(PoisonError::into_inner) = count;
            more.notify_all();
        };
        let (done, arrived) = mpsc::sync_channel(threads);
        let outcome = thread::scope(|scope| {
            let work = |done: mpsc::SyncSender<_>| {
                stage::hide();
                frames(&mut |number, drawn| done.send((number, drawn)).is_ok());
            };
            let started = (0..threads).filter(|_| {
                let done = done.clone();
                Builder::new().spawn_scoped(scope, move || work(done)).is_ok()
            });
            let started = started.count();
            drop(done);
            if started == 0 {
                // The system has no threads to give.
                let mut outcome = Ok(());
                frames(&mut |number, drawn| {
                    outcome = drawn.and_then(|picture| take(number, picture.image));
                    hand_on(number + 1);
                    outcome.is_ok()
                });
                return outcome;
            }
            let (mut early, mut wanted) = (BTreeMap::new(), 0);
            let mut outcome = Ok(());
            for (number, drawn) in arrived.iter() {
                outcome = drawn.map(|picture| _ = early.insert(number, picture.image));
                while let (true, Some(image)) = (outcome.is_ok(), early.remove(&wanted)) {
                    outcome = take(wanted, image);
                    wanted += 1;
                    hand_on(wanted);
                }
                if outcome.is_err() {
                    break;
                }
            }
            // After a failure, threads that wait go on, and end at the closed channel.
            drop(arrived);
            hand_on(usize::MAX);
            outcome
        });
        outcome.map(|()| sums.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// The model before a camera, with what is seen through in its order.
    pub(crate) fn shot(self, camera: Camera) -> Shot<'a> {
        let projection = self.options.projection;
        let mut model = Cow::Borrowed(self.model);
        if order::counts(self.model) {
            ordered(model.to_mut(), &camera, projection);
        }
        Shot { model, camera, projection }
    }
}

/// Has surfaces that are seen through in the order of a camera.
pub(crate) fn ordered(model: &mut Model, camera: &Camera, projection: Projection) {
    let (eye, target) = (camera.eye.map(f64::from), camera.target.map(f64::from));
    let is_perspective = projection == Projection::Perspective;
    order::shells(model, camera, if is_perspective { Ok(eye) } else { Err(sub(eye, target)) });
}
