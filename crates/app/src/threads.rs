//! Work that is divided between threads, as many of them as the system gives.

use std::num::NonZero;
use std::sync::{Mutex, PoisonError};
use std::thread;

use crate::memory;

/// Addresses of a thread: what allocators reserve for it as it begins, twice.
const RESERVED: u64 = 256 << 20;

/// The threads that run at once; fewer where addresses are limited, whose end no allocator tells in time.
pub(crate) fn available() -> NonZero<usize> {
    let threads = thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let room = memory::addresses().map(|left| usize::try_from(left / RESERVED).unwrap_or(usize::MAX));
    room.map_or(threads, |room| threads.min(NonZero::new(room).unwrap_or(NonZero::<usize>::MIN)))
}

/// Work for a thread.
pub(crate) type Task<'a> = Box<dyn FnOnce() + Send + 'a>;

/// Does all of the work by so many threads, each of which takes what comes next. This thread is one of them, so that
/// all is done where the system has no more.
pub(crate) fn by_threads(work: Vec<Task<'_>>, threads: usize) {
    let threads = threads.min(work.len());
    let work = Mutex::new(work.into_iter());
    // None is held while a task runs, so none is poisoned.
    let next = || work.lock().unwrap_or_else(PoisonError::into_inner).next();
    let worker = || {
        while let Some(task) = next() {
            task();
        }
    };
    thread::scope(|scope| {
        (1..threads).for_each(|_| _ = thread::Builder::new().spawn_scoped(scope, worker));
        worker();
    });
}
