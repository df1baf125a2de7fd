//! The files that a picture is made of, as they were just before they were opened: a change after that is noticed,
//! however soon it comes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

/// A file as it was; `None` for one that was not there.
type Stamp = Option<(Option<SystemTime>, u64, u64)>;

/// Files by their paths. `None`: nobody asks.
static SEEN: Mutex<Option<BTreeMap<PathBuf, Stamp>>> = Mutex::new(None);

fn all() -> MutexGuard<'static, Option<BTreeMap<PathBuf, Stamp>>> {
    SEEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Remembers files from now on, and forgets those of before.
pub(crate) fn begin() {
    *all() = Some(BTreeMap::new());
}

/// Remembers a file that is about to be opened, if that is asked for. Of several times the first counts.
pub(crate) fn see(path: &Path) {
    if let Some(seen) = &mut *all() {
        seen.entry(path.to_owned()).or_insert_with(|| stamp(path));
    }
}

/// Whether the files are no longer as they were.
pub(crate) fn changed() -> bool {
    all().iter().flatten().any(|(path, then)| stamp(path) != *then)
}

/// All files as they are.
pub(crate) fn now() -> Vec<Stamp> {
    all().iter().flatten().map(|(path, _)| stamp(path)).collect()
}

fn stamp(path: &Path) -> Stamp {
    let metadata = fs::metadata(path).ok()?;
    // A file that another one has been renamed to may have its time and length.
    #[cfg(unix)]
    let number = std::os::unix::fs::MetadataExt::ino(&metadata);
    #[cfg(not(unix))]
    let number = 0;
    Some((metadata.modified().ok(), metadata.len(), number))
}
