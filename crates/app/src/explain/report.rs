//! The form of an explanation: blocks of named numbers, which text and JSON are made of alike.

use super::theory::Relation;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;

/// A step of the journey.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Its key in JSON.
    pub(crate) key: &'static str,
    pub(crate) title: String,
    /// The relations that it follows, in docs/theory.md.
    pub(crate) relations: &'static [Relation],
    items: Vec<Item>,
}

#[derive(Clone, Debug)]
enum Item {
    Line { key: &'static str, label: String, cells: Vec<Cell> },
    Table { key: &'static str, columns: Vec<&'static str>, rows: Vec<Vec<Cell>> },
    Note { key: &'static str, text: String },
}

/// A value of a line or a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    /// A number of the pipeline, with as many digits as tell it from its neighbours.
    Single(f32),
    /// A number that is computed for comparison.
    Double(f64),
    Integer(i64),
    Text(String),
    /// A word of memory.
    Word(u32),
    None,
}

impl From<f32> for Cell {
    fn from(x: f32) -> Self {
        Self::Single(x)
    }
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Self::Double(x)
    }
}

impl From<i64> for Cell {
    fn from(x: i64) -> Self {
        Self::Integer(x)
    }
}

impl From<i32> for Cell {
    fn from(x: i32) -> Self {
        Self::Integer(x.into())
    }
}

impl From<u32> for Cell {
    fn from(x: u32) -> Self {
        Self::Integer(x.into())
    }
}

impl From<usize> for Cell {
    fn from(x: usize) -> Self {
        i64::try_from(x).map_or(Self::None, Self::Integer)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(of: Option<T>) -> Self {
        of.map_or(Self::None, Into::into)
    }
}

impl Cell {
    fn text(&self) -> String {
        match self {
            Self::Single(x) => single(*x),
            Self::Double(x) => double(*x),
            Self::Integer(x) => x.to_string(),
            Self::Text(text) => text.clone(),
            Self::Word(word) => format!("{word:#x}"),
            Self::None => "-".to_owned(),
        }
    }

    /// Numbers of the pipeline as the shortest that read back as the same `f32`; infinities and NaN as text.
    fn json(&self) -> Value {
        let number = |x: f64| {
            serde_json::Number::from_f64(x).map_or_else(|| Value::String(x.to_string()), Value::Number)
        };
        match self {
            Self::Single(x) => number(x.to_string().parse().unwrap_or(f64::NAN)),
            Self::Double(x) => number(*x),
            Self::Integer(x) => json!(x),
            Self::Text(text) => json!(text),
            Self::Word(word) => json!(word),
            Self::None => Value::Null,
        }
    }
}

/// The shortest text that reads back as the same number.
fn single(x: f32) -> String {
    if x == 0.0 || (1e-4..1e9).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// Ten digits.
fn double(x: f64) -> String {
    const DIGITS: i32 = 10;
    if x == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e9).contains(&x.abs()) {
        let text = format!("{x:.9e}");
        let Some((digits, exponent)) = text.split_once('e') else { return text };
        return format!("{}e{exponent}", without_zeros(digits));
    }
    #[expect(clippy::cast_possible_truncation, reason = "from -4 to 8")]
    let whole = x.abs().log10().floor() as i32 + 1;
    let decimals = usize::try_from(DIGITS - whole.max(0)).unwrap_or(0);
    without_zeros(&format!("{x:.decimals$}")).to_owned()
}

fn without_zeros(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

impl Block {
    pub(crate) fn new(key: &'static str, title: impl Into<String>, relations: &'static [Relation]) -> Self {
        Self { key, title: title.into(), relations, items: Vec::new() }
    }

    /// A line of one value.
    pub(crate) fn value(&mut self, key: &'static str, label: impl Into<String>, value: impl Into<Cell>) {
        self.items.push(Item::Line { key, label: label.into(), cells: vec![value.into()] });
    }

    /// A line of several values.
    pub(crate) fn values<T: Into<Cell>>(
        &mut self,
        key: &'static str,
        label: impl Into<String>,
        values: impl IntoIterator<Item = T>,
    ) {
        let cells = values.into_iter().map(Into::into).collect();
        self.items.push(Item::Line { key, label: label.into(), cells });
    }

    /// A table with these columns.
    pub(crate) fn table(&mut self, key: &'static str, columns: &[&'static str], rows: Vec<Vec<Cell>>) {
        self.items.push(Item::Table { key, columns: columns.to_vec(), rows });
    }

    /// A sentence.
    pub(crate) fn note(&mut self, key: &'static str, text: impl Into<String>) {
        self.items.push(Item::Note { key, text: text.into() });
    }

    /// Its object.
    pub(crate) fn json(&self) -> Value {
        let mut object = Map::new();
        if !self.relations.is_empty() {
            let theory: Vec<String> = self.relations.iter().map(Relation::name).collect();
            object.insert("theory".to_owned(), json!(theory));
        }
        for item in &self.items {
            let (key, value) = match item {
                Item::Line { key, cells, .. } => match &cells[..] {
                    [cell] => (key, cell.json()),
                    cells => (key, cells.iter().map(Cell::json).collect()),
                },
                Item::Table { key, columns, rows } => {
                    let object = |row: &Vec<Cell>| {
                        let fields = columns.iter().zip(row);
                        let fields = fields.map(|(name, cell)| (name.replace([' ', '-'], "_"), cell.json()));
                        Value::Object(fields.collect())
                    };
                    (key, rows.iter().map(object).collect())
                }
                Item::Note { key, text } => (key, json!(text)),
            };
            object.insert((*key).to_owned(), value);
        }
        Value::Object(object)
    }

    /// Whether it is a step of the journey: neither what holds all along nor where it ends.
    pub(crate) fn is_step(&self) -> bool {
        !matches!(self.key, "policies" | "nothing" | "stored")
    }

    /// Its lines, under its title, which has a number if it is a step.
    pub(crate) fn text(&self, number: Option<u32>) -> String {
        let mut text = number.map(|number| format!("{number}. ")).unwrap_or_default();
        text.push_str(&self.title);
        if !self.relations.is_empty() {
            let names: Vec<String> = self.relations.iter().map(Relation::name).collect();
            let _ = write!(text, "  (theory: {})", names.join("; "));
        }
        text.push('\n');
        let label = |item: &Item| if let Item::Line { label, .. } = item { width(label) } else { 0 };
        let widest = self.items.iter().map(label).max().unwrap_or(0);
        // Lines with as many values stand under each other.
        for item in &self.items {
            match item {
                Item::Line { label, cells, .. } => {
                    let alike = self.items.iter().filter_map(|item| match item {
                        Item::Line { cells: other, .. } if other.len() == cells.len() => Some(other),
                        _ => None,
                    });
                    let widths = widths(alike, cells.len());
                    let _ = write!(text, "  {label}{}", " ".repeat(widest - width(label)));
                    put(&mut text, cells, if cells.len() == 1 { &[0] } else { &widths });
                }
                Item::Table { columns, rows, .. } => {
                    let head: Vec<Cell> = columns.iter().map(|&name| name.into()).collect();
                    let widths = widths(rows.iter().chain([&head]), columns.len());
                    put(&mut text, &head, &widths);
                    rows.iter().for_each(|row| put(&mut text, row, &widths));
                }
                Item::Note { text: note, .. } => {
                    let _ = writeln!(text, "  {note}");
                }
            }
        }
        text
    }
}

/// The widths of columns.
fn widths<'a>(rows: impl Iterator<Item = &'a Vec<Cell>> + Clone, columns: usize) -> Vec<usize> {
    let of = |k: usize| rows.clone().filter_map(|row| row.get(k)).map(|cell| width(&cell.text())).max();
    (0..columns).map(|k| of(k).unwrap_or(0)).collect()
}

/// A line of values, to the right; the last one, if it is text, to the left.
fn put(text: &mut String, cells: &[Cell], widths: &[usize]) {
    let mut line = String::new();
    for (k, (cell, columns)) in cells.iter().zip(widths).enumerate() {
        let value = cell.text();
        let room = " ".repeat(columns.saturating_sub(width(&value)));
        let left = matches!(cell, Cell::Text(_)) && k + 1 == cells.len();
        let _ = if left { write!(line, "  {value}") } else { write!(line, "  {room}{value}") };
    }
    text.push_str(line.trim_end());
    text.push('\n');
}

fn width(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_count() {
        assert_eq!([0.1, 1e-7, 3e10, -0.0, 12.5].map(single), ["0.1", "1e-7", "3e10", "-0", "12.5"]);
        assert_eq!([0.1, 1.0 / 3.0, 2e5 / 3.0].map(double), ["0.1", "0.3333333333", "66666.66667"]);
        assert_eq!([1.25e-7, -4e12, 0.0].map(double), ["1.25e-7", "-4e12", "0"]);
        assert_eq!(Cell::Single(0.1).json().to_string(), "0.1");
        assert_eq!(Cell::Single(f32::NAN).json(), json!("NaN"));
    }

    #[test]
    fn lines_stand_under_each_other() {
        let mut block = Block::new("a", "title", &[]);
        block.values("b", "first", [1, 20]);
        block.values("c", "the other", [300, 4]);
        block.value("d", "one", "word");
        let lines = "title\n  first        1  20\n  the other  300   4\n  one        word\n";
        assert_eq!(block.text(None), lines);
        assert_eq!(block.text(Some(3)), format!("3. {lines}"));
        assert_eq!(block.json(), json!({ "b": [1, 20], "c": [300, 4], "d": "word" }));
    }
}
