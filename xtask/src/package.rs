//! Building the crates from the files that would be published.
//!
//! `cargo package` can verify crates that depend on one another before any of them is published, but it unpacks
//! them into the cache of registry sources, keyed by version only. The second run on a machine therefore checks a
//! crate against *yesterday's* copies of its dependencies. So cargo only makes the archives here; they are unpacked
//! below the target directory and built as a workspace of their own, patched to one another.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{self, Outcome, cargo};
use crate::workspace;

/// Packages every published crate, unpacks the archives and checks that they build with one another.
pub(crate) fn run() -> Outcome {
    let archives = workspace::target_directory().join("package");
    for old in archives_in(&archives)? {
        fs::remove_file(archives.join(&old)).map_err(|error| format!("cannot remove {old}: {error}"))?;
    }

    // The tree may hold changes that are not committed; a check before a commit is the purpose.
    let mut package = cargo();
    package.args(["package", "--quiet", "--no-verify", "--allow-dirty"]);
    for name in workspace::published() {
        package.args(["--package", name]);
    }
    command::run(&mut package)?;

    let unpacked = workspace::target_directory().join("unpacked");
    if unpacked.exists() {
        fs::remove_dir_all(&unpacked)
            .map_err(|error| format!("cannot empty {}: {error}", unpacked.display()))?;
    }
    fs::create_dir_all(&unpacked)
        .map_err(|error| format!("cannot create {}: {error}", unpacked.display()))?;
    let mut members = Vec::new();
    for archive in archives_in(&archives)? {
        // `-m`: new times for the files. Cargo gives all that it packs the same time in 2006, and would take a
        // changed file for one that it has checked before.
        command::run(Command::new("tar").arg("-xzmf").arg(archives.join(&archive)).arg("-C").arg(&unpacked))?;
        members.push(archive.trim_end_matches(".crate").to_string());
    }
    for member in &members {
        of_its_own(&unpacked.join(member))?;
    }
    let count = workspace::published().count();
    if members.len() != count {
        return Err(format!("{} archives in {}, expected {count}", members.len(), archives.display()));
    }

    write(&unpacked.join("Cargo.toml"), &manifest(&members)?)?;
    // The versions that the tests ran with, not the newest of today.
    let lock = workspace::root().join("Cargo.lock");
    fs::copy(&lock, unpacked.join("Cargo.lock"))
        .map_err(|error| format!("cannot copy {}: {error}", lock.display()))?;
    let mut check = cargo();
    check
        .args(["check", "--workspace", "--lib", "--bins", "--manifest-path"])
        .arg(unpacked.join("Cargo.toml"));
    // The same target directory as the repository's own builds: the dependencies are compiled there already.
    command::run(check.arg("--target-dir").arg(workspace::target_directory()))
}

/// Checks that a package has all that its page shows: both licences, and a README whose links lead somewhere without a
/// repository around it.
fn of_its_own(package: &Path) -> Outcome {
    let read = |name: &str| {
        let path = package.join(name);
        fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))
    };
    for (name, words) in [("LICENSE-MIT", "MIT License"), ("LICENSE-APACHE", "Apache License")] {
        if !read(name)?.contains(words) {
            return Err(format!("{}/{name} is not that licence", package.display()));
        }
    }
    match dead_link(&read("README.md")?, |link| package.join(link).exists()) {
        Some(link) => Err(format!(
            "{}/README.md: found a link to `{link}`, expected a whole address, or a file of the package",
            package.display()
        )),
        None => Ok(()),
    }
}

/// The first link of a text in Markdown that is neither a whole address nor a file that is there.
fn dead_link(markdown: &str, is_there: impl Fn(&str) -> bool) -> Option<&str> {
    let links = markdown.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    links.into_iter().find(|link| !link.starts_with("https://") && !link.starts_with('#') && !is_there(link))
}

/// The names of the archives in `folder`, sorted; none where there is no such folder.
fn archives_in(folder: &Path) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    if folder.exists() {
        let entries =
            fs::read_dir(folder).map_err(|error| format!("cannot list {}: {error}", folder.display()))?;
        names.extend(entries.flatten().filter_map(|entry| entry.file_name().into_string().ok()));
        names.retain(|name| PathBuf::from(name).extension().is_some_and(|extension| extension == "crate"));
    }
    names.sort();
    Ok(names)
}

/// The manifest of the workspace of unpacked crates: they replace the registry's crates of the same names.
fn manifest(members: &[String]) -> Result<String, String> {
    let mut text = format!("[workspace]\nresolver = \"3\"\nmembers = {members:?}\n\n[patch.crates-io]\n");
    for member in members {
        let (name, _version) =
            member.rsplit_once('-').ok_or_else(|| format!("no version in the archive name `{member}`"))?;
        text.push_str(&format!("{name} = {{ path = {member:?} }}\n"));
    }
    Ok(text)
}

fn write(path: &Path, text: &str) -> Outcome {
    fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_somewhere() {
        let dead = |text| dead_link(text, |link| link == "README.md");
        assert_eq!(dead("[a](https://docs.rs) [b](#part) [c](README.md) (d)"), None);
        assert_eq!(dead("[a](https://docs.rs), [b](../alberti) and [c](x)"), Some("../alberti"));
    }

    #[test]
    fn the_unpacked_crates_replace_one_another() {
        let text = manifest(&["alberti-0.1.0".into(), "alberti-math-0.1.0".into()]).unwrap();
        assert!(text.contains("members = [\"alberti-0.1.0\", \"alberti-math-0.1.0\"]\n"), "{text}");
        assert!(text.contains("\nalberti = { path = \"alberti-0.1.0\" }\n"), "{text}");
        assert!(text.contains("\nalberti-math = { path = \"alberti-math-0.1.0\" }\n"), "{text}");
    }
}
