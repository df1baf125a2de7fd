//! Which files and folders there are.

use super::Problem;
use crate::workspace;

/// What the top level may hold, besides names that begin with a dot.
const TOP_LEVEL: &[&str] = &[
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "CONVENTIONS.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "SECURITY.md",
    "benches",
    "crates",
    "deny.toml",
    "docs",
    "target",
    "tests",
    "xtask",
];

/// The crates that are workspaces of their own, and are not published.
const APART: [&str; 1] = ["web"];

/// Checks the top level, and that each crate's folder is known and complete.
pub(super) fn check(files: &[String]) -> Vec<Problem> {
    let mut problems = Vec::new();
    let mut reported = "";
    for file in files {
        let top = file.split('/').next().unwrap_or(file);
        if !(top.starts_with('.') || TOP_LEVEL.contains(&top)) && top != reported {
            problems.push(Problem::new(
                file,
                1,
                format!("`{top}` is not one of the names that the top level holds"),
            ));
            reported = top;
        }
    }

    let mut reported = "";
    for file in files {
        let Some((folder, _)) = file.strip_prefix("crates/").and_then(|rest| rest.split_once('/')) else {
            continue;
        };
        if folder != reported
            && !APART.contains(&folder)
            && !workspace::crate_folders().any(|known| known == folder)
        {
            problems.push(Problem::new(
                file,
                1,
                format!("the crate `{folder}` is missing in xtask/src/workspace.rs"),
            ));
            reported = folder;
        }
    }
    for folder in workspace::crate_folders() {
        for name in ["Cargo.toml", "README.md", "src/lib.rs"] {
            let path = format!("crates/{folder}/{name}");
            if !files.contains(&path) {
                problems.push(Problem::new(&path, 1, "this file is missing"));
            }
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A complete repository, to which `extra` is added and from which `without` is taken.
    fn files(extra: &[&str], without: &str) -> Vec<String> {
        let crates = workspace::crate_folders().flat_map(|folder| {
            ["Cargo.toml", "README.md", "src/lib.rs"].map(|name| format!("crates/{folder}/{name}"))
        });
        let extra = extra.iter().map(|file| file.to_string());
        crates.chain(extra).filter(|file| file != without).collect()
    }

    fn messages(files: &[String]) -> Vec<String> {
        check(files).iter().map(Problem::to_string).collect()
    }

    #[test]
    fn a_complete_repository_passes() {
        assert_eq!(messages(&files(&["Cargo.toml", ".ci/run", "docs/a.md"], "")), Vec::<String>::new());
    }

    #[test]
    fn a_stray_top_level_name_is_reported_once() {
        let found = messages(&files(&["scratch/a.txt", "scratch/b.txt"], ""));
        assert_eq!(found, ["scratch/a.txt:1: `scratch` is not one of the names that the top level holds"]);
    }

    #[test]
    fn an_unknown_crate_is_reported_once() {
        let found = messages(&files(&["crates/extra/Cargo.toml", "crates/extra/src/lib.rs"], ""));
        assert_eq!(
            found,
            ["crates/extra/Cargo.toml:1: the crate `extra` is missing in xtask/src/workspace.rs"]
        );
    }

    #[test]
    fn a_crate_without_readme_is_reported() {
        let found = messages(&files(&[], "crates/raster/README.md"));
        assert_eq!(found, ["crates/raster/README.md:1: this file is missing"]);
    }
}
