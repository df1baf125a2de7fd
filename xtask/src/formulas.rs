//! Formulas of LaTeX, as browsers draw them.

use std::convert::Infallible;

use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

/// The language of the code blocks that are formulas, as on GitHub.
pub(crate) const LANGUAGE: &str = "math";

/// A block of MathML.
///
/// # Errors
/// The formula is no LaTeX.
pub(crate) fn mathml(formula: &str) -> Result<String, String> {
    let storage = Storage::new();
    // Faults would be part of the page otherwise.
    let events: Vec<_> = Parser::new(formula, &storage)
        .collect::<Result<_, _>>()
        .map_err(|error| format!("a formula that is no LaTeX: {error}"))?;
    let mut text = String::from("<div class=\"formulas\">");
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    let events = events.into_iter().map(Ok::<_, Infallible>);
    push_mathml(&mut text, events, config).map_err(|error| error.to_string())?;
    text.push_str("</div>\n");
    Ok(MENDED.iter().fold(text, |text, (from, to)| text.replace(from, to)))
}

/// What pulldown-latex 0.8 writes wrong: the name of a space, signs that are marks of HTML, and attributes without a
/// space between them.
const MENDED: [(&str, &str); 4] = [
    ("&amp;nbsp;", "&#160;"),
    ("<mo><</mo>", "<mo>&lt;</mo>"),
    ("<mo>></mo>", "<mo>&gt;</mo>"),
    ("\"minsize=", "\" minsize="),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_are_no_marks() {
        let found = mathml("a < b > \\bigl( c~d \\bigr)").unwrap();
        assert!(found.contains("<mo>&lt;</mo>") && found.contains("<mo>&gt;</mo>"), "{found}");
        assert!(!found.contains("<<") && !found.contains("\"minsize") && !found.contains("&amp;"), "{found}");
    }
}
