//! docs/theory.md as a page: its relations in MathML, its headings with anchors, its pictures beside it.

use std::fs;
use std::path::Path;

use pulldown_cmark::{CodeBlockKind, CowStr, Event, LinkType, Options, Parser, Tag, TagEnd, html};

use super::failed;
use crate::command::Outcome;
use crate::formulas::{self, mathml};

/// Writes theory.html, and the pictures that it shows, into a folder.
pub(super) fn write(docs: &Path, folder: &Path) -> Outcome {
    let source = docs.join("theory.md");
    let text = fs::read_to_string(&source).map_err(failed(&source))?;
    let (body, pictures) = page(&text).map_err(|message| format!("{}: {message}", source.display()))?;
    for picture in pictures {
        let (from, to) = (docs.join(&picture), folder.join(&picture));
        if let Some(parent) = to.parent() {
            fs::create_dir_all(parent).map_err(failed(parent))?;
        }
        fs::copy(&from, &to).map_err(failed(&from))?;
    }
    let page = folder.join("theory.html");
    fs::write(&page, body).map_err(failed(&page))
}

/// The page of a text, and the pictures that lie beside it.
fn page(text: &str) -> Result<(String, Vec<String>), String> {
    let mut pictures = Vec::new();
    let mut events: Vec<Event<'_>> = Vec::new();
    // Whether each open link is left out: files of the repository are not in the folder.
    let mut left_out = Vec::new();
    let mut formula: Option<String> = None;
    let mut heading: Option<(usize, String)> = None;
    for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language)))
                if &*language == formulas::LANGUAGE =>
            {
                formula = Some(String::new());
            }
            Event::Text(text) if formula.is_some() => formula.iter_mut().for_each(|all| all.push_str(&text)),
            Event::End(TagEnd::CodeBlock) if formula.is_some() => {
                events.push(Event::Html(mathml(&formula.take().unwrap_or_default())?.into()));
            }
            Event::Start(Tag::Link { ref dest_url, link_type, .. }) => {
                let leads = dest_url.starts_with('#')
                    || dest_url.starts_with("https://")
                    || link_type == LinkType::Autolink;
                left_out.push(!leads);
                if leads {
                    events.push(event);
                }
            }
            Event::End(TagEnd::Link) => {
                if !left_out.pop().unwrap_or(false) {
                    events.push(event);
                }
            }
            Event::Start(Tag::Image { ref dest_url, .. }) => {
                pictures.push(dest_url.to_string());
                events.push(event);
            }
            Event::Start(Tag::Heading { .. }) => {
                heading = Some((events.len(), String::new()));
                events.push(event);
            }
            Event::End(TagEnd::Heading(_)) => {
                if let Some((begin, words)) = heading.take()
                    && let Some(Event::Start(Tag::Heading { id, .. })) = events.get_mut(begin)
                {
                    *id = Some(CowStr::from(anchor(&words)));
                }
                events.push(event);
            }
            Event::Start(Tag::Table(_)) => {
                events.push(Event::Html("<div class=\"wide\">".into()));
                events.push(event);
            }
            Event::End(TagEnd::Table) => {
                events.push(event);
                events.push(Event::Html("</div>\n".into()));
            }
            event => {
                if let (Some((_, words)), Event::Text(text) | Event::Code(text)) = (&mut heading, &event) {
                    words.push_str(text);
                }
                events.push(event);
            }
        }
    }
    let mut body = String::from(HEAD);
    html::push_html(&mut body, events.into_iter());
    body.push_str("</main>\n</body>\n</html>\n");
    Ok((body, pictures))
}

const HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<meta name=\"color-scheme\" content=\"light dark\">
<title>Theory – alberti</title>
<link rel=\"stylesheet\" href=\"style.css\">
<link rel=\"stylesheet\" href=\"formulas.css\">
</head>
<body>
<header><div class=\"name\"><a href=\"index.html\">alberti</a> <span>a rasterizer to touch</span></div>
<p class=\"more\"><a href=\"index.html\">Back to the stations</a></p></header>
<main class=\"theory\">
";

/// The anchor of a heading, as GitHub makes it.
fn anchor(words: &str) -> String {
    let kept =
        words.trim().to_lowercase().chars().filter(|c| c.is_alphanumeric() || "-_ ".contains(*c)).collect();
    let text: String = kept;
    text.replace(' ', "-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_have_anchors_and_files_of_the_repository_no_links() {
        let text =
            "## The depth map, `zs`\n\n[a] and [b](#x)\n\n![p](pictures/p.png)\n\n[a]: ../tests/a.rs\n";
        let (page, pictures) = page(text).unwrap();
        assert!(page.contains("<h2 id=\"the-depth-map-zs\">"), "{page}");
        assert!(page.contains("<p>a and <a href=\"#x\">b</a></p>"), "{page}");
        assert_eq!(pictures, ["pictures/p.png"]);
    }

    #[test]
    fn formulas_are_mathml_or_a_fault() {
        let (found, _) = page("```math\n\\frac{1}{2}\n```\n").unwrap();
        assert!(found.contains("<mfrac>") && !found.contains("\\frac"), "{found}");
        assert!(page("```math\n\\nosuchcommand{1}\n```\n").is_err());
    }
}
