//! Films: pictures of one size, one after the other.

pub(crate) mod format;
pub(crate) mod names;
mod palette;
mod webp;
mod y4m;

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError, mpsc};
use std::thread::{self, Builder};

use crate::draw::Chains;
use crate::error::Error;
use crate::options::{Projection, RenderOptions, Samples};
use crate::render::Picture;
use crate::samples::supersampled_with;
use crate::scene::backdrop::Backdrop;
use crate::scene::normals::sub;
use crate::scene::{Camera, Image, Model, order};

/// Frames that a thread may be ahead of those that are handed on.
pub(crate) const EARLY: usize = 2;

/// All of a film but its cameras.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Set<'a> {
    pub(crate) model: &'a Model,
    pub(crate) options: &'a RenderOptions,
    pub(crate) samples: Samples,
    pub(crate) backdrop: &'a Backdrop,
}

impl Set<'_> {
    /// Draws a frame for each camera, and hands them on in order. A thread draws a frame: the pictures are those of
    /// [`supersampled_with`], whatever their number.
    ///
    /// # Errors
    /// A frame cannot be drawn, or `take` fails.
    pub(crate) fn draw(
        self,
        cameras: &[Camera],
        take: &mut dyn FnMut(usize, Image) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let chains = Arc::new(Chains::new(self.model, self.options)?);
        let alone = RenderOptions { threads: NonZero::<usize>::MIN, ..*self.options };
        let threads = self.options.threads.get().min(cameras.len()).max(1);
        let next = AtomicUsize::new(0);
        let (handed, more) = (Mutex::new(0), Condvar::new());
        let frames = |hand: &mut dyn FnMut(usize, Result<Picture, Error>) -> bool| {
            let mut own = order::counts(self.model).then(|| self.model.clone());
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                // Frames that are early wait in memory, so none may be earlier than that.
                let is_early = |handed: &mut usize| number >= handed.saturating_add(EARLY * threads);
                let count = handed.lock().unwrap_or_else(PoisonError::into_inner);
                drop(more.wait_while(count, is_early));
                let Some(camera) = cameras.get(number) else { break };
                let model = own.as_mut().map(|own| self.ordered(own, camera)).unwrap_or(self.model);
                let (samples, backdrop) = (self.samples, self.backdrop);
                let drawn =
                    supersampled_with(&chains, (model, camera), &alone, samples, backdrop, &mut |_, _| ());
                if !hand(number, drawn) {
                    break;
                }
            }
        };
        let hand_on = |count: usize| {
            *handed.lock().unwrap_or_else(PoisonError::into_inner) = count;
            more.notify_all();
        };
        let (done, arrived) = mpsc::sync_channel(threads);
        thread::scope(|scope| {
            let work = |done: mpsc::SyncSender<_>| {
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
        })
    }

    /// A copy of the model whose surfaces that are seen through are in the order of a camera.
    fn ordered<'m>(&self, own: &'m mut Model, camera: &Camera) -> &'m Model {
        own.parts.clone_from(&self.model.parts);
        let (eye, target) = (camera.eye.map(f64::from), camera.target.map(f64::from));
        let is_perspective = self.options.projection == Projection::Perspective;
        order::shells(own, camera, if is_perspective { Ok(eye) } else { Err(sub(eye, target)) });
        own
    }
}
