//! The files that a picture is made of, as they were just before they were opened: a change after that is noticed,
//! however soon it comes. None of them is written.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

use crate::error::Error;

/// A file as it was; `None` for one that was not there.
type Stamp = Option<(Option<SystemTime>, u64, u64)>;

/// Files by their paths.
static SEEN: Mutex<BTreeMap<PathBuf, Stamp>> = Mutex::new(BTreeMap::new());

fn all() -> MutexGuard<'static, BTreeMap<PathBuf, Stamp>> {
    SEEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Forgets the files of before.
pub(crate) fn begin() {
    all().clear();
}

/// Remembers a file that is about to be opened. Of several times the first counts.
pub(crate) fn see(path: &Path) {
    all().entry(path.to_owned()).or_insert_with(|| stamp(path));
}

/// Whether one of the files that were there is such.
pub(crate) fn any(is: impl Fn(&Path) -> bool) -> bool {
    all().iter().any(|(path, then)| then.is_some() && is(path))
}

/// The error of a name under which one of them would be written; `option` names another.
pub(crate) fn refused(name: &Path, option: &str) -> Error {
    let error = Error::new("a file that is also read", "another").file(name);
    error.hint(format!("choose another with {option}"))
}

/// Whether the files are no longer as they were.
pub(crate) fn changed() -> bool {
    all().iter().any(|(path, then)| stamp(path) != *then)
}

/// All files as they are.
pub(crate) fn now() -> Vec<Stamp> {
    all().keys().map(|path| stamp(path)).collect()
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
