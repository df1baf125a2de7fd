//! The claims of docs/theory.md hold: its files and tests are there, its functions too, and its figures are those of
//! docs/accuracy.md.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What stands between backquotes, each with what follows up to the next.
fn quoted(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let (_, after) = rest.split_once('`')?;
        let (inside, after) = after.split_once('`')?;
        rest = after;
        Some((inside, after.split('`').next().unwrap_or("")))
    })
}

/// Whether an item of this name is declared.
fn declares(source: &str, kinds: &[&str], name: &str) -> bool {
    kinds.iter().any(|kind| {
        let declaration = format!("{kind} {name}");
        source.match_indices(&declaration).any(|(at, _)| {
            let after = source[at + declaration.len()..].chars().next();
            !after.is_some_and(|c| c.is_alphanumeric() || c == '_')
        })
    })
}

/// Whether there is a test of this name: a function under the attribute.
fn tests(source: &str, name: &str) -> bool {
    let lines: Vec<&str> = source.lines().map(str::trim).collect();
    let attribute = |line: &&&str| line.starts_with("#[") && !line.starts_with("#[test]");
    lines.iter().enumerate().any(|(i, line)| {
        let above = lines[..i].iter().rev().find(|line| !attribute(line));
        declares(line, &["fn"], name) && above.is_some_and(|line| line.starts_with("#[test]"))
    })
}

/// Whether what is at this path is declared: an item, or a function in an `impl` or `trait` of its type.
fn reachable(source: &str, path: &str) -> bool {
    const ITEMS: [&str; 5] = ["pub fn", "pub struct", "pub enum", "pub trait", "pub mod"];
    let Some((of, function)) = path.rsplit_once("::") else { return declares(source, &ITEMS, path) };
    let of = of.rsplit("::").next().unwrap_or(of);
    if of.starts_with(char::is_lowercase) {
        return declares(source, &["pub mod", "mod"], of) && declares(source, &ITEMS, function);
    }
    let mut inside = false;
    source.lines().any(|line| {
        if line.starts_with("impl") || line.starts_with("pub trait") {
            inside = line.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == of);
        }
        inside && declares(line, &["fn"], function)
    })
}

/// The files of a folder and of those in it, one after the other.
fn sources(folder: &Path) -> String {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a readable folder").path());
    paths.map(|path| if path.is_dir() { sources(&path) } else { read(&path) }).collect()
}

/// The largest error and the bound, as printed, of a function's rows: of all, or of those of one region.
fn figures(accuracy: &str, function: &str, region: Option<&str>) -> Option<[String; 2]> {
    let rows = accuracy.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split(" | ").collect();
        let [name, of, bound, max, ..] = cells[..] else { return None };
        let wanted = name == format!("| `{function}`") && region.is_none_or(|region| region == of);
        wanted.then_some([max, bound])
    });
    let larger = |a: &str, b: &str| {
        let number = |x: &str| if x == "∞" { f64::INFINITY } else { x.parse().expect("a number") };
        if number(a) < number(b) { b.to_owned() } else { a.to_owned() }
    };
    rows.map(|row| row.map(str::to_owned)).reduce(|[a, b], [c, d]| [larger(&a, &c), larger(&b, &d)])
}

/// "2.46 of 3.00" at the start of what follows a name and a colon, or a comma, a region and a colon.
fn claim(after: &str) -> Option<(Option<&str>, [&str; 2])> {
    let (before, claim) = after.split_once(": ")?;
    let region = if before.is_empty() { None } else { Some(before.strip_prefix(", ")?) };
    let (max, rest) = claim.split_once(" of ")?;
    max.parse::<f64>().ok()?;
    Some((region, [max, rest.split([' ', ';']).next()?]))
}

#[test]
fn what_the_page_names_is_there() {
    let (page, accuracy) = (read(&docs().join("theory.md")), read(&docs().join("accuracy.md")));
    let links: HashMap<&str, &str> =
        page.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: ")).collect();
    let files: HashMap<&str, String> =
        links.iter().map(|(&name, link)| (name, read(&docs().join(link)))).collect();
    let crates = docs().join("../crates");
    let mut libraries: HashMap<&str, String> = ["math", "projection", "raster", "texture"]
        .map(|name| (name, sources(&crates.join(name).join("src"))))
        .into();
    libraries.insert("", sources(&crates.join("alberti/src")));

    let (mut wrong, mut checked) = (Vec::new(), [0; 3]);
    for cell in page.lines().flat_map(|line| line.split(" | ")) {
        // Tests, behind the file that has them.
        for part in cell.split('[').skip(1) {
            let Some((name, after)) = part.split_once(']') else { continue };
            if !name.ends_with(".rs") {
                continue;
            }
            let Some(source) = files.get(name) else {
                wrong.push(format!("[{name}] leads nowhere"));
                continue;
            };
            for (test, _) in quoted(after) {
                checked[0] += 1;
                if !tests(source, test) {
                    wrong.push(format!("[{name}] has no `{test}`"));
                }
            }
        }
        for (name, after) in quoted(cell) {
            if let Some(path) = name.strip_prefix("alberti").filter(|path| path.contains("::")) {
                checked[1] += 1;
                let (library, path) = path.split_once("::").expect("a path");
                let source = libraries.get(library.trim_start_matches('_'));
                if !source.is_some_and(|source| reachable(source, path)) {
                    wrong.push(format!("there is no `{name}`"));
                }
            } else if let Some((region, [max, bound])) = claim(after) {
                checked[2] += 1;
                let found = figures(&accuracy, name, region);
                if found.as_ref().is_none_or(|[m, b]| m != max || b != bound) {
                    wrong.push(format!("`{name}` {region:?}: {max} of {bound}, found {found:?}"));
                }
            }
        }
    }
    println!("{checked:?} tests, functions, figures");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(checked.iter().all(|&n| n > 40), "{checked:?}");
}
