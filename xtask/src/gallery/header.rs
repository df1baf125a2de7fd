//! What a scene file says of itself: the comments above its first key.
//!
//! ```text
//! # The title
//! #
//! # What is to be seen, in one paragraph or more.
//! #
//! # With `--filter nearest`: what these options change, for another picture.
//! ```

/// A scene's title, and for each picture of it the options of the command line, and the text in Markdown.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) title: String,
    /// First the scene as it is, with no options.
    pub(super) pictures: Vec<(String, String)>,
}

impl Header {
    /// # Errors
    /// There is no title, or no text.
    pub(super) fn read(file: &str) -> Result<Header, String> {
        let comments = file.lines().map_while(|line| line.strip_prefix('#'));
        let text = comments.map(str::trim).collect::<Vec<_>>().join("\n");
        let mut paragraphs = text.split("\n\n").map(str::trim).filter(|paragraph| !paragraph.is_empty());
        let title = paragraphs.next().ok_or("a comment with the title was expected first")?;
        if title.contains('\n') {
            return Err(format!("an empty comment was expected below the title, found `{title}`"));
        }
        let mut pictures: Vec<(String, String)> = Vec::new();
        for paragraph in paragraphs {
            match (options(paragraph), pictures.last_mut()) {
                (Some(_), None) => return Err("a text was expected before other options".to_string()),
                (Some(options), _) => pictures.push((options.to_string(), paragraph.to_string())),
                (None, None) => pictures.push((String::new(), paragraph.to_string())),
                (None, Some((_, text))) => text.push_str(&format!("\n\n{paragraph}")),
            }
        }
        if pictures.is_empty() {
            return Err("a text was expected below the title".to_string());
        }
        Ok(Header { title: title.to_string(), pictures })
    }
}

/// The options that a paragraph opens with.
fn options(paragraph: &str) -> Option<&str> {
    let (options, _) = paragraph.strip_prefix("With `")?.split_once("`:")?;
    options.starts_with("--").then_some(options)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_title_text_and_variations() {
        let file = "# Tea\n#\n# Hot,\n# and black.\n#\n# Strong.\n#\n# With `--wrap clamp`: cold.\n\nkey = 1\n# no\n";
        let header = Header::read(file).unwrap();
        assert_eq!(header.title, "Tea");
        let plain = (String::new(), "Hot,\nand black.\n\nStrong.".to_string());
        let cold = ("--wrap clamp".to_string(), "With `--wrap clamp`: cold.".to_string());
        assert_eq!(header.pictures, [plain, cold]);
    }

    #[test]
    fn what_is_missing_is_named() {
        assert!(Header::read("size = [1, 1]\n").unwrap_err().contains("title"));
        assert!(Header::read("# Tea\n\nkey = 1\n").unwrap_err().contains("text"));
        assert!(Header::read("# Tea\n# Hot.\n").unwrap_err().contains("Hot"));
        assert!(Header::read("# Tea\n#\n# With `--wrap clamp`: a\n").unwrap_err().contains("before"));
    }
}
