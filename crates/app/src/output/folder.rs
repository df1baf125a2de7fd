//! Folders for results, which go again where there are none.

use std::fs;
use std::path::Path;

use super::file::temporary_files;
use crate::error::Error;

/// Makes a folder, and those that it is in, for work within. Those that are new go after a failure or a signal, as long
/// as they are empty. `option` names it.
///
/// # Errors
/// The folder cannot be made, or the work fails.
pub(crate) fn in_folder<T>(
    folder: &Path,
    option: &str,
    work: impl FnOnce() -> Result<T, Error>,
) -> Result<T, Error> {
    if folder.exists() && !folder.is_dir() {
        let hint = format!("choose another with {option}");
        return Err(Error::new("a file", "a folder").file(folder).hint(hint));
    }
    let is_missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
    let missing: Vec<_> = folder.ancestors().take_while(is_missing).map(Path::to_owned).collect();
    if !missing.is_empty() {
        let mut files = temporary_files();
        files.extend(missing.iter().rev().cloned());
        fs::create_dir_all(folder).map_err(|error| {
            let found = format!("a folder that cannot be made ({error})");
            Error::new(found, "one that can be written").file(folder)
        })?;
    }
    let outcome = work();
    if outcome.is_err() {
        // The deepest first. If one cannot be removed, that is no error of the work.
        missing.iter().for_each(|folder| _ = fs::remove_dir(folder));
    }
    outcome
}
