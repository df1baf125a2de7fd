//! The page as a list of what its reader does: lines that are typed, and files that are written.

use crate::command::Outcome;

/// One block of the page.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// Lines for a shell.
    Typed(Vec<String>),
    /// A file, whose path counts from where the reader is.
    Written { path: String, text: String },
}

/// The steps of a page in Markdown. A block of a shell is typed; any other is the file that the paragraph before it
/// names first.
pub(super) fn steps(page: &str) -> Result<Vec<Step>, String> {
    let mut steps = vec![];
    let mut named: Option<String> = None;
    let mut lines = page.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        let Some(language) = line.strip_prefix("```") else {
            // The name stands at the beginning of its line.
            if let Some((path, _)) = line.strip_prefix('`').and_then(|rest| rest.split_once('`')) {
                named = Some(path.to_string());
            } else if let Some((path, _)) = line.strip_prefix("and `").and_then(|rest| rest.split_once('`')) {
                named = Some(path.to_string());
            }
            continue;
        };
        let mut block = String::new();
        loop {
            let (_, line) =
                lines.next().ok_or_else(|| format!("line {}: the block has no end", number + 1))?;
            if line == "```" {
                break;
            }
            block += line;
            block.push('\n');
        }
        steps.push(if language == "sh" {
            Step::Typed(joined(&block))
        } else {
            let path =
                named.take().ok_or_else(|| format!("line {}: no file is named for the block", number + 1))?;
            Step::Written { path, text: block }
        });
    }
    Ok(steps)
}

/// The lines of a block, with those that end in a backslash joined to the next.
fn joined(block: &str) -> Vec<String> {
    block.replace("\\\n", "").lines().map(str::to_string).collect()
}

/// Fails unless each of the words begins a line that is typed: what the page no longer says cannot be followed.
pub(super) fn must_type(steps: &[Step], words: &[&str]) -> Outcome {
    for word in words {
        let typed =
            |step: &Step| matches!(step, Step::Typed(lines) if lines.iter().any(|l| l.starts_with(word)));
        if !steps.iter().any(typed) {
            return Err(format!("no line of the page begins with `{word}`"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_files_and_lines() {
        let page = "Text.\n\n`a/b.rs`, which `c` knows:\n\n```rust\nfn f() {}\n```\n\n```sh\ncd a \\\n    b\nls\n```\n";
        let written = Step::Written { path: "a/b.rs".into(), text: "fn f() {}\n".into() };
        let typed = Step::Typed(vec!["cd a     b".into(), "ls".into()]);
        assert_eq!(steps(page), Ok(vec![written, typed]));
        assert!(must_type(&steps(page).unwrap(), &["cd", "ls"]).is_ok());
        assert!(must_type(&steps(page).unwrap(), &["cargo"]).unwrap_err().contains("`cargo`"));
    }

    #[test]
    fn what_is_wrong_is_told_by_its_line() {
        assert_eq!(steps("\n```toml\n```\n"), Err("line 2: no file is named for the block".into()));
        assert_eq!(steps("`a`:\n```toml\n"), Err("line 2: the block has no end".into()));
    }
}
