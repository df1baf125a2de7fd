//! The reader's messages on what is no TOML, in the words of all others.

use crate::error::quote;

const QUOTES: &str = "text has quotes around it, and values in brackets have commas between";

/// A message of the form `found, expected what`, and a remedy. `before` and `after` are the texts around the place.
pub(super) fn mended(message: &str, (before, after): (&str, &str)) -> (String, Option<String>) {
    let (what, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    let remedied = |message: &str, remedy: &str| (message.to_owned(), Some(remedy.to_owned()));
    // The value from its beginning, if the place is in one.
    let line = before.rsplit('\n').next().unwrap_or_default();
    let rest = after.lines().next().unwrap_or_default();
    let begins = line.rfind(['=', '[', ',', ' ']).map_or(0, |at| at + 1);
    let word = format!("{}{}", &line[begins..], rest.split([',', ']', ' ', '#']).next().unwrap_or_default());
    let is_number = |text: &str| text.starts_with(|c: char| c.is_ascii_digit() || c == '-');
    match what {
        _ if ["yes", "no", "on", "off", "true", "false"].contains(&&*word.to_lowercase()) => remedied(
            &format!("{}, expected a value", quote(word.as_bytes())),
            "what is so is true, and what is not is false, without quotes",
        ),
        "string values must be quoted" => remedied("expected a value", QUOTES),
        "invalid boolean" | "invalid value" | "invalid integer" | "invalid float" | "invalid date-time"
            if !word.is_empty() =>
        {
            remedied(&format!("{}, expected a value", quote(word.as_bytes())), QUOTES)
        }
        "invalid literal string" | "invalid basic string" => {
            ("text without its closing quotes, expected these".to_owned(), None)
        }
        what if what.starts_with("invalid multi-line") => {
            ("text without its closing quotes, expected these".to_owned(), None)
        }
        what if what.starts_with("duplicate key") => (
            "a key for the second time, expected it once".to_owned(),
            before.ends_with('[').then(|| {
                "of tables that there may be several of, each begins with two brackets, as [[object]]"
                    .to_owned()
            }),
        ),
        "unexpected leading zero" => remedied("a zero before a number, expected none", "5 is not written 05"),
        "missing escaped value" => remedied(
            "a single \\ in text, expected two of them",
            "folders may have / between them on all systems",
        ),
        "unexpected key or value" | "unexpected content" => {
            let found =
                format!("more after a value: {}, expected the end of the line", quote(rest.as_bytes()));
            let value = line.split_once('=').map(|(_, value)| value.trim());
            let remedy = match value {
                Some(_) if rest.trim_start_matches([',', ' ', ';']).contains('=') => {
                    "each key has a line of its own"
                }
                // Two numbers and a comma may be either.
                Some(value) if is_number(value) && rest.starts_with(',') => {
                    "decimals have a point, as in 1.5, and numbers that belong together stand in brackets, as [1, 2]"
                }
                None if line.starts_with('[') => "a head has as many brackets at its end as at its start",
                _ => return (found, None),
            };
            (found, Some(remedy.to_owned()))
        }
        _ => {
            let found = what.strip_prefix("unexpected ").unwrap_or(what);
            let found = match found.strip_prefix("missing ").filter(|rest| !rest.starts_with("field ")) {
                Some(missing) => format!("no {missing}"),
                None => found.to_owned(),
            };
            let (found, expected) = match expected {
                "" => (found, String::new()),
                "nothing" => (found, ", expected none".to_owned()),
                expected => (found, format!(", expected {expected}")),
            };
            (found + &expected, None)
        }
    }
}
