//! A copy of the working tree, into which bugs are put.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Outcome, output};
use crate::{tidy, workspace};

/// The copy. Files that are as they were keep their times, so that cargo does not compile them again.
pub(super) struct Tree {
    root: PathBuf,
}

impl Tree {
    /// Makes a folder the copy of all files that git tracks or would add.
    pub(super) fn new(root: &Path) -> Result<Self, String> {
        let tree = Self { root: root.to_path_buf() };
        fs::create_dir_all(root).map_err(|error| format!("cannot create {}: {error}", root.display()))?;
        let files = tidy::tracked_files()?;
        tree.restore(&files)?;
        tree.remove_others(root, &files.iter().map(|file| root.join(file)).collect())?;
        Ok(tree)
    }

    /// The folder.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// Puts a patch in.
    pub(super) fn apply(&self, patch: &Path) -> Outcome {
        // The copy may lie in the repository, whose root git would take for that of the patch.
        let above = self.root.parent().unwrap_or(&self.root);
        let mut git = Command::new("git");
        git.current_dir(&self.root).env("GIT_CEILING_DIRECTORIES", above).arg("apply").arg(patch);
        output(&mut git).map(|_| ())
    }

    /// Makes these files what they are in the working tree.
    pub(super) fn restore(&self, files: &[String]) -> Outcome {
        for file in files {
            let (from, to) = (workspace::root().join(file), self.root.join(file));
            let failed = |error| format!("cannot copy {file} to {}: {error}", to.display());
            let bytes = fs::read(&from).map_err(failed)?;
            if fs::read(&to).is_ok_and(|known| known == bytes) {
                continue;
            }
            to.parent()
                .map_or(Ok(()), fs::create_dir_all)
                .and_then(|()| fs::write(&to, bytes))
                .map_err(failed)?;
        }
        Ok(())
    }

    /// Removes all files of a folder but those to be kept.
    fn remove_others(&self, folder: &Path, kept: &BTreeSet<PathBuf>) -> Outcome {
        let failed = |error| format!("cannot clear {}: {error}", folder.display());
        for entry in fs::read_dir(folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.is_dir() {
                self.remove_others(&path, kept)?;
            } else if !kept.contains(&path) {
                fs::remove_file(&path).map_err(failed)?;
            }
        }
        Ok(())
    }
}
