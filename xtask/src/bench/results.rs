//! The tables that are committed: comma-separated values, perhaps below a line about the machine.

use std::fs;

use crate::command::Outcome;
use crate::workspace;

/// The text of a file of the repository.
pub(super) fn read(place: &str) -> Result<String, String> {
    fs::read_to_string(workspace::root().join(place)).map_err(|error| format!("cannot read {place}: {error}"))
}

pub(super) fn write(place: &str, text: &str) -> Outcome {
    fs::write(workspace::root().join(place), text).map_err(|error| format!("cannot write {place}: {error}"))
}

/// What a table says of the machine.
pub(super) fn machine(text: &str) -> &str {
    text.lines().next().and_then(|line| line.strip_prefix("# ")).unwrap_or("an unknown machine")
}

/// The fields of all lines below the heading, each with the place for a message.
pub(super) fn rows<'a, const N: usize>(
    place: &str,
    heading: &str,
    text: &'a str,
) -> Result<Vec<(String, [&'a str; N])>, String> {
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.starts_with('#'));
    match lines.next() {
        Some((_, line)) if line == heading => {}
        other => {
            let (number, found) = other.unwrap_or((1, "nothing"));
            return Err(format!("{place}:{number}: found `{found}`, expected `{heading}`"));
        }
    }
    let row = |(number, line): (u32, &'a str)| {
        let fields: Vec<_> = line.split(',').collect();
        let fields = <[&str; N]>::try_from(fields);
        let fields = fields.map_err(|_| format!("{place}:{number}: found `{line}`, expected `{heading}`"))?;
        Ok((format!("{place}:{number}"), fields))
    };
    lines.map(row).collect()
}

/// A number of a table.
pub(super) fn number<T: std::str::FromStr>(place: &str, field: &str) -> Result<T, String> {
    field.parse().map_err(|_| format!("{place}: found `{field}`, expected a number"))
}

/// A count as a number that can be divided.
#[expect(clippy::cast_precision_loss, reason = "counts below 2^53")]
pub(super) fn real(count: u64) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_have_their_lines() {
        let text = "# some machine\nname,figure\na,1\nb,2\n";
        let read = rows::<2>("x.csv", "name,figure", text).unwrap();
        assert_eq!(read, [("x.csv:3".to_owned(), ["a", "1"]), ("x.csv:4".to_owned(), ["b", "2"])]);
        assert_eq!(machine(text), "some machine");
        let error = rows::<2>("x.csv", "name,figure", "name,figure\na,1,2\n").unwrap_err();
        assert_eq!(error, "x.csv:2: found `a,1,2`, expected `name,figure`");
        let error = rows::<2>("x.csv", "name,figure", "").unwrap_err();
        assert_eq!(error, "x.csv:1: found `nothing`, expected `name,figure`");
        assert_eq!(number::<u64>("x.csv:2", "1.5").unwrap_err(), "x.csv:2: found `1.5`, expected a number");
    }
}
