//! A page of the repository as a chapter: its links, and its formulas.

use std::collections::BTreeSet;
use std::ops::Range;

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

use super::DOCS;
use crate::formulas;

/// A chapter, and the files of the repository that it shows or leads to.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Page {
    pub(super) text: String,
    pub(super) files: Vec<String>,
}

/// The pages that a page leads to. Paths begin in the repository's root.
pub(super) fn linked(text: &str, page: &str) -> Vec<String> {
    let links = Parser::new(text).filter_map(|event| match event {
        Event::Start(Tag::Link { dest_url, .. }) => resolve(page, &dest_url),
        _ => None,
    });
    links.collect()
}

/// A link that has begun.
struct Link {
    /// Its place in the text.
    all: Range<usize>,
    /// Where it leads in the book; none if it does not.
    to: Option<String>,
    /// The place of its words.
    words: Option<Range<usize>>,
}

/// Makes a chapter of a page of the repository.
///
/// # Errors
/// A formula is no LaTeX, or a picture is missing.
pub(super) fn make(
    text: &str,
    page: &str,
    chapters: &BTreeSet<String>,
    exists: &dyn Fn(&str) -> bool,
) -> Result<Page, String> {
    let mut files = Vec::new();
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    let mut formula: Option<String> = None;
    let mut open: Vec<Link> = Vec::new();
    for (event, range) in Parser::new_ext(text, Options::ENABLE_TABLES).into_offset_iter() {
        let is_end = matches!(event, Event::End(TagEnd::Link));
        if let (false, Some(Link { words, .. })) = (is_end, open.last_mut()) {
            let begin = words.as_ref().map_or(range.start, |words| words.start);
            *words = Some(begin..range.end);
        }
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language)))
                if &*language == formulas::LANGUAGE =>
            {
                formula = Some(String::new());
            }
            Event::Text(text) if formula.is_some() => formula.iter_mut().for_each(|all| all.push_str(&text)),
            Event::End(TagEnd::CodeBlock) => {
                if let Some(formula) = formula.take() {
                    edits.push((range, formulas::mathml(&formula)?));
                }
            }
            Event::Start(Tag::Image { dest_url, .. }) => {
                let file = resolve(page, &dest_url).filter(|file| exists(file));
                let file = file.ok_or_else(|| format!("there is no picture {dest_url}"))?;
                let at = text[range.clone()].rfind(&*dest_url).ok_or("pictures take `![words](path)`")?;
                edits.push((range.start + at..range.start + at + dest_url.len(), lead(page, &file)));
                files.push(file);
            }
            Event::Start(Tag::Link { dest_url, .. }) => {
                let outside = dest_url.starts_with('#') || dest_url.contains("://");
                let target = resolve(page, &dest_url);
                let chapter = target.as_ref().and_then(|target| {
                    let readme = format!("{}/README.md", target.trim_end_matches('/'));
                    [target.clone(), readme].into_iter().find(|target| chapters.contains(target))
                });
                let beside = target.filter(|target| target.starts_with(DOCS) && exists(target));
                let to = if outside {
                    Some(dest_url.to_string())
                } else if let Some(chapter) = chapter {
                    let anchor = dest_url.find('#').map_or("", |at| &dest_url[at..]);
                    Some(lead(page, &chapter) + anchor)
                } else {
                    files.extend(beside.clone());
                    beside.map(|file| lead(page, &file))
                };
                open.push(Link { all: range, to, words: None });
            }
            Event::End(TagEnd::Link) => {
                if let Some(Link { all, to, words: Some(words) }) = open.pop() {
                    let (before, after) = match to {
                        Some(to) => ("[", format!("]({to})")),
                        None => ("", String::new()),
                    };
                    edits.push((all.start..words.start, before.to_owned()));
                    edits.push((words.end..all.end, after));
                }
            }
            _ => {}
        }
    }
    Ok(Page { text: edited(text, edits), files })
}

/// A text with other words in some ranges, of which none overlap.
fn edited(text: &str, mut edits: Vec<(Range<usize>, String)>) -> String {
    edits.sort_by_key(|(range, _)| range.start);
    let (mut out, mut at) = (String::with_capacity(text.len()), 0);
    for (range, new) in edits {
        out.push_str(&text[at..range.start]);
        out.push_str(&new);
        at = range.end;
    }
    out + &text[at..]
}

/// The path that a link of a page leads to, without its anchor. None for those that lead elsewhere.
fn resolve(page: &str, link: &str) -> Option<String> {
    let link = link.split('#').next().unwrap_or_default();
    if link.is_empty() || link.contains("://") {
        return None;
    }
    let mut folders: Vec<&str> = page.split('/').collect();
    folders.pop();
    for word in link.split('/') {
        match word {
            ".." => _ = folders.pop()?,
            "." | "" => {}
            word => folders.push(word),
        }
    }
    Some(folders.join("/"))
}

/// The place of a file of the repository in the book: docs/ is its root, and a page that stands for its folder is the
/// folder's index.
pub(super) fn place(path: &str) -> String {
    let path = path.strip_prefix(DOCS).map_or(path, |path| path.trim_start_matches('/'));
    path.strip_suffix("README.md").map_or(path.to_owned(), |folder| format!("{folder}index.md"))
}

/// The way from one page to another file, in the book.
fn lead(page: &str, to: &str) -> String {
    "../".repeat(place(page).matches('/').count()) + &place(to)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(text: &str, page: &str) -> Result<Page, String> {
        let chapters = ["README.md", "docs/a.md", "crates/app/README.md"].map(str::to_owned);
        make(text, page, &chapters.into(), &|path| path.starts_with("docs/pictures/") || path == "docs/t.csv")
    }

    #[test]
    fn links_lead_to_chapters_or_are_words() {
        let text = "[the *a*](docs/a.md#so), [`app`](crates/app), [code](crates/a.rs), [out](https://x.y), [own](#z)\n";
        let right = "[the *a*](a.md#so), [`app`](crates/app/index.md), code, [out](https://x.y), [own](#z)\n";
        assert_eq!(made(text, "README.md").unwrap().text, right);
        let text = "[up](../../README.md) [x], [t](../../docs/t.csv)\n\n[x]: ../../docs/a.md\n";
        let page = made(text, "crates/app/README.md").unwrap();
        assert_eq!(
            page.text,
            "[up](../../index.md) [x](../../a.md), [t](../../t.csv)\n\n[x]: ../../docs/a.md\n"
        );
        assert_eq!(page.files, ["docs/t.csv"]);
    }

    #[test]
    fn pictures_are_taken_along_even_within_links() {
        let page =
            made("![p](docs/pictures/p.png) [![q](docs/pictures/q.png)](docs/a.md)\n", "README.md").unwrap();
        assert_eq!(page.text, "![p](pictures/p.png) [![q](pictures/q.png)](a.md)\n");
        assert_eq!(page.files, ["docs/pictures/p.png", "docs/pictures/q.png"]);
        assert!(made("![p](missing.png)\n", "README.md").unwrap_err().contains("missing.png"));
    }

    #[test]
    fn formulas_are_mathml_or_a_fault() {
        let page = made("a\n\n```math\n\\frac{1}{2}\n```\n\nb `[x](y)`\n", "docs/a.md").unwrap();
        assert!(page.text.contains("<mfrac>") && !page.text.contains("```"), "{}", page.text);
        assert!(
            page.text.starts_with("a\n\n<div") && page.text.ends_with("\n\nb `[x](y)`\n"),
            "{}",
            page.text
        );
        assert!(made("```math\n\\nosuchcommand{1}\n```\n", "docs/a.md").is_err());
    }

    #[test]
    fn the_summary_names_pages_that_are_there() {
        let root = crate::workspace::root();
        let summary = std::fs::read_to_string(root.join("docs/SUMMARY.md")).unwrap();
        let pages = linked(&summary, "docs/SUMMARY.md");
        assert!(pages.iter().all(|page| root.join(page).is_file()), "{pages:?}");
        // Each page of docs/ is in it.
        for entry in std::fs::read_dir(root.join(DOCS)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let is_page = name.ends_with(".md") && name != "SUMMARY.md";
            assert!(!is_page || pages.contains(&format!("{DOCS}/{name}")), "{name}");
        }
    }
}
