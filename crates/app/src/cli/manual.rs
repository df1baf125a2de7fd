//! Parts of the manual as pages of help: Markdown made plain, 80 columns wide.

/// The columns of a page.
const WIDTH: usize = 80;

/// The columns that the text of a row of a table is moved in.
const INDENT: usize = 6;

/// The manual.
const MANUAL: &str = include_str!("../../README.md");

/// The section under this heading of the second level, if there is one.
pub(super) fn section(heading: &str) -> String {
    let start = format!("## {heading}\n");
    let part = MANUAL.split_once(&start).map_or("", |(_, part)| part);
    plain(part.split("\n## ").next().unwrap_or(part).trim())
}

/// Markdown as plain text: code is moved in, and of a table each row is a word with a paragraph.
fn plain(markdown: &str) -> String {
    let mut text = String::new();
    let mut in_code = false;
    let mut lines = markdown.lines().peekable();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            in_code = !in_code;
        } else if in_code {
            text.push_str(format!("  {line}").trim_end());
            text.push('\n');
        } else if line.starts_with("|---") || lines.peek().is_some_and(|next| next.starts_with("|---")) {
            // The head of a table says nothing that its rows do not.
        } else if let Some(row) = line.strip_prefix("| ") {
            let cells: Vec<_> =
                row.trim_end_matches('|').split(" | ").map(|cell| bare(cell.trim())).collect();
            let [key, rest @ ..] = cells.as_slice() else { continue };
            text.push_str(&format!("  {key}\n"));
            let said = match rest {
                [value, default] if !default.is_empty() => format!("{value} [default: {default}]"),
                [value, ..] => value.clone(),
                [] => String::new(),
            };
            wrap(&said, INDENT, &mut text);
        } else if line.is_empty() {
            text.push('\n');
        } else {
            // A paragraph, up to what is none.
            let mut words = line.to_owned();
            let is_of_it =
                |next: &&str| !next.is_empty() && !next.starts_with('|') && !next.starts_with("```");
            while let Some(next) = lines.next_if(is_of_it) {
                words.push(' ');
                words.push_str(next);
            }
            wrap(&bare(&words), 0, &mut text);
        }
    }
    text
}

/// A text without marks, and of links the words.
fn bare(markdown: &str) -> String {
    let mut text = String::new();
    let mut rest = markdown;
    while let Some((before, after)) = rest.split_once("](") {
        let (before, words) = before.rsplit_once('[').unwrap_or((before, ""));
        text.push_str(before);
        text.push_str(words);
        rest = after.split_once(')').map_or("", |(_, behind)| behind);
    }
    text.push_str(rest);
    text.replace(['`', '*'], "")
}

fn wrap(text: &str, indent: usize, into: &mut String) {
    let mut column = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > WIDTH {
            into.push('\n');
            column = 0;
        }
        let room = if column == 0 { indent } else { 1 };
        into.extend(std::iter::repeat_n(' ', room));
        into.push_str(word);
        column += room + length;
    }
    into.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markdown_becomes_plain() {
        let markdown = "See [the *rest*](#rest) of\n`it`,\nand more.\n\n```toml\na = 1\n```\n\n| key | value | default |\n|---|---|---|\n| `b` | a [link](x) | `2` |\n| `c` | none | |\n";
        let expected =
            "See the rest of it, and more.\n\n  a = 1\n\n  b\n      a link [default: 2]\n  c\n      none\n";
        assert_eq!(plain(markdown), expected);
        let long = plain(&"word ".repeat(40));
        assert!(long.lines().all(|line| line.len() <= WIDTH) && long.lines().count() == 3);
        assert_eq!(section("No such heading"), "");
    }
}
