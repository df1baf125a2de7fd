//! The list of cargo-mutants.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::LIBRARIES;

/// A change of a source file.
#[derive(Clone, Debug)]
pub(crate) struct Mutant {
    pub(crate) name: String,
    /// From the root of the repository.
    pub(crate) file: PathBuf,
    pub(crate) genre: Genre,
    /// The text for the one that is there.
    pub(crate) replacement: String,
    /// The line, and the letter in it, of the first letter that is replaced, from 1.
    pub(crate) place: (usize, usize),
}

/// The kinds of changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Genre {
    Value,
    Binary,
    Unary,
    Arm,
    Guard,
    Field,
}

/// All mutants of the libraries, in the order of files and lines.
pub(crate) fn mutants(root: &Path) -> Result<Vec<Mutant>, String> {
    let packages = LIBRARIES.iter().flat_map(|library| ["-p".to_owned(), format!("alberti-{library}")]);
    let output = Command::new("cargo")
        .current_dir(root)
        .args(["mutants", "--list", "--json"])
        .args(packages)
        .output()
        .map_err(|error| format!("cannot run cargo: {error}"))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!(
            "cargo mutants failed; `cargo install --locked cargo-mutants` installs it\n{said}"
        ));
    }
    let list: Value = serde_json::from_slice(&output.stdout).map_err(|error| format!("the list: {error}"))?;
    let list = list.as_array().ok_or("the list of cargo-mutants is none")?;
    list.iter().map(|value| read(value).ok_or_else(|| format!("a mutant of another form: {value}"))).collect()
}

fn read(value: &Value) -> Option<Mutant> {
    let text = |key: &str| value.get(key).and_then(Value::as_str).map(str::to_owned);
    let start = value.get("span")?.get("start")?;
    let number = |key: &str| usize::try_from(start.get(key)?.as_u64()?).ok();
    Some(Mutant {
        name: text("name")?,
        file: text("file")?.into(),
        genre: match text("genre")?.as_str() {
            "FnValue" => Genre::Value,
            "BinaryOperator" => Genre::Binary,
            "UnaryOperator" => Genre::Unary,
            "MatchArm" => Genre::Arm,
            "MatchArmGuard" => Genre::Guard,
            "StructField" => Genre::Field,
            _ => return None,
        },
        replacement: text("replacement")?,
        place: (number("line")?, number("column")?),
    })
}
