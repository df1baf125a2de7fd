//! The links of a folder of HTML.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// The links and pictures of a folder's pages that lead nowhere, each after its page.
///
/// # Errors
/// A file cannot be read.
pub(super) fn dead(folder: &Path) -> Result<Vec<String>, String> {
    let mut pages = BTreeMap::new();
    gather(folder, Path::new(""), &mut pages)?;
    let mut dead = Vec::new();
    for (page, text) in &pages {
        for link in values(text, "href").chain(values(text, "src")) {
            // Elsewhere, or the root of a site.
            if link.contains(':') || link.starts_with('/') {
                continue;
            }
            let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = if path.is_empty() { page.clone() } else { join(page, path) };
            let is_there = match pages.get(&target) {
                Some(text) => anchor.is_empty() || values(text, "id").any(|id| id == anchor),
                None => folder.join(&target).is_file(),
            };
            if !is_there {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    Ok(dead)
}

/// Reads the pages below a folder.
fn gather(folder: &Path, within: &Path, pages: &mut BTreeMap<PathBuf, String>) -> Result<(), String> {
    let io = |error: std::io::Error| format!("{}: {error}", folder.join(within).display());
    for entry in fs::read_dir(folder.join(within)).map_err(io)? {
        let entry = entry.map_err(io)?;
        let path = within.join(entry.file_name());
        if entry.path().is_dir() {
            gather(folder, &path, pages)?;
        } else if path.extension().is_some_and(|extension| extension == "html") {
            let text = fs::read_to_string(entry.path()).map_err(io)?;
            pages.insert(path, text);
        }
    }
    Ok(())
}

/// The values of an attribute in double quotes.
fn values<'a>(text: &'a str, attribute: &str) -> impl Iterator<Item = &'a str> {
    let begin = format!(" {attribute}=\"");
    let parts: Vec<_> =
        text.split(begin.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect();
    parts.into_iter()
}

/// The path that leads from a page.
fn join(page: &Path, link: &str) -> PathBuf {
    let mut target = page.parent().map(Path::to_path_buf).unwrap_or_default();
    for part in Path::new(link).components() {
        match part {
            Component::ParentDir => _ = target.pop(),
            Component::Normal(name) => target.push(name),
            _ => {}
        }
    }
    target
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dead_links_are_told() {
        let folder = std::env::temp_dir().join(format!("alberti-links-{}", std::process::id()));
        fs::create_dir_all(folder.join("in")).unwrap();
        let page = "<a href=\"in/b.html#x\">b</a><a href=\"#here\" id=\"here\">c</a><img src=\"p.png\">\
            <a href=\"in/b.html#y\">d</a><a href=\"https://x.y\">e</a>";
        fs::write(folder.join("a.html"), page).unwrap();
        fs::write(
            folder.join("in/b.html"),
            "<h1 id=\"x\">b</h1><a href=\"../a.html\">a</a><a href=\"../c.html\">c</a>",
        )
        .unwrap();
        let found = dead(&folder);
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(found.unwrap(), ["a.html: in/b.html#y", "a.html: p.png", "in/b.html: ../c.html"]);
    }
}
