//! The claims of docs/theory.md hold: its files and tests are there, its functions too, its figures are those of
//! docs/accuracy.md and docs/kernel.md, its table of depths is what the functions give, and each relation that is set
//! has its row.

use alberti_projection::{DepthMap, DepthSteps};
use std::collections::{BTreeSet, HashMap};
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

/// "2.46 of 3.00", or a figure with its unit and a formula, up to what follows the bound.
fn figure(text: &str) -> Option<[&str; 2]> {
    let (max, rest) = text.split_once(" of ")?;
    max.trim_end_matches('ε').parse::<f64>().ok()?;
    let end = [";", ", ", " from ", " + half"].iter().filter_map(|after| rest.find(after)).min();
    Some([max, rest[..end.unwrap_or(rest.len())].trim()])
}

/// The claims of a cell: a name, a region and a figure each. A figure at the start is of the row's first function.
fn claims<'a>(cell: &'a str, function: Option<&'a str>) -> Vec<(&'a str, Option<&'a str>, [&'a str; 2])> {
    let first = function.zip(figure(cell)).map(|(name, figure)| (name, None, figure));
    let named = quoted(cell).filter_map(|(name, after)| {
        let (before, claim) = after.split_once(": ")?;
        let region = if before.is_empty() { None } else { Some(before.strip_prefix(", ")?) };
        Some((name, region, figure(claim)?))
    });
    first.into_iter().chain(named).collect()
}

/// The name of a function without its crate and modules.
fn short(path: &str) -> &str {
    let upper = path.split("::").position(|part| part.starts_with(char::is_uppercase));
    let parts = path.split("::").count();
    let skipped = upper.unwrap_or(parts - 1);
    let length: usize = path.split("::").take(skipped).map(|part| part.len() + 2).sum();
    &path[length..]
}

/// Whether a row of docs/kernel.md has this figure: the measured one at the start of its cell, the bound as a part of
/// its own. None where there is no such policy.
fn in_kernel(kernel: &str, policy: &str, [max, bound]: [&str; 2]) -> Option<bool> {
    let row = kernel.lines().find(|line| line.starts_with(&format!("| `{policy}` | ")))?;
    let cells: Vec<&str> = row.split(" | ").collect();
    let [_, allowed, measured, ..] = cells[..] else { return None };
    let whole = allowed
        .match_indices(bound)
        .any(|(at, _)| !allowed[..at].ends_with(|c: char| c.is_alphanumeric() || c == '.'));
    Some(whole && measured.split([' ', ',']).next() == Some(max))
}

/// The cells of a row of a table, without the bars at its ends.
fn cells(line: &str) -> Option<Vec<&str>> {
    Some(line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ").collect())
}

/// The functions of a cell, which come before its tests. They are of the section's module, unless they have a path.
fn functions(cell: &str, module: &str) -> Vec<String> {
    let of_module = |name: &str| {
        if name.starts_with("alberti") { name.to_owned() } else { format!("{module}::{name}") }
    };
    let (functions, _) = cell.split_once("<br>").unwrap_or_default();
    quoted(functions).map(|(name, _)| of_module(name)).collect()
}

/// The page's files, and the libraries' sources, as they are named.
struct Sources<'a> {
    files: HashMap<&'a str, String>,
    libraries: HashMap<&'static str, String>,
}

impl<'a> Sources<'a> {
    fn of(page: &'a str) -> Self {
        let links = page.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: "));
        let files = links.map(|(name, link)| (name, read(&docs().join(link)))).collect();
        let crates = docs().join("../crates");
        let mut libraries: HashMap<&str, String> = ["math", "projection", "raster", "texture"]
            .map(|name| (name, sources(&crates.join(name).join("src"))))
            .into();
        libraries.insert("", sources(&crates.join("alberti/src")));
        Self { files, libraries }
    }

    fn has(&self, path: &str) -> bool {
        let Some((library, path)) = path.strip_prefix("alberti").and_then(|path| path.split_once("::"))
        else {
            return false;
        };
        let source = self.libraries.get(library.trim_start_matches('_'));
        source.is_some_and(|source| reachable(source, path))
    }

    /// What is wrong with the tests of a cell, each behind the file that has it, and their number.
    fn tests(&self, cell: &str, wrong: &mut Vec<String>) -> usize {
        let mut count = 0;
        for (name, after) in cell.split('[').skip(1).filter_map(|part| part.split_once(']')) {
            if !name.ends_with(".rs") {
                continue;
            }
            let Some(source) = self.files.get(name) else {
                wrong.push(format!("[{name}] leads nowhere"));
                continue;
            };
            for (test, _) in quoted(after) {
                count += 1;
                if !tests(source, test) {
                    wrong.push(format!("[{name}] has no `{test}`"));
                }
            }
        }
        count
    }
}

#[test]
fn what_the_page_names_is_there() {
    let [page, accuracy, kernel] =
        ["theory.md", "accuracy.md", "kernel.md"].map(|name| read(&docs().join(name)));
    // A section's module, too, where its line is broken.
    let page = page.replace("Functions are those of\n", "Functions are those of ");
    let sources = Sources::of(&page);
    let (mut wrong, mut checked) = (Vec::new(), [0; 3]);
    let (mut module, mut policies) = ("", BTreeSet::new());
    for line in page.lines() {
        if let Some((_, after)) = line.split_once("Functions are those of `") {
            module = after.split('`').next().unwrap_or("");
        }
        let row = cells(line).filter(|cells| cells.len() == 3);
        let all = row.clone().unwrap_or_else(|| vec![line]);
        checked[0] += all.iter().map(|cell| sources.tests(cell, &mut wrong)).sum::<usize>();
        let paths = row.as_ref().map(|cells| functions(cells[1], module)).unwrap_or_default();
        let elsewhere = all.iter().flat_map(|cell| quoted(cell)).map(|(name, _)| name.to_owned());
        let elsewhere = elsewhere.filter(|name| name.starts_with("alberti") && name.contains("::"));
        for path in paths.iter().cloned().chain(elsewhere).collect::<BTreeSet<_>>() {
            checked[1] += 1;
            if !sources.has(&path) {
                wrong.push(format!("there is no `{path}`"));
            }
        }
        let Some(row) = row else { continue };
        for (name, region, found) in claims(row[2], paths.first().map(|path| short(path))) {
            checked[2] += 1;
            let right = in_kernel(&kernel, name, found).unwrap_or_else(|| {
                figures(&accuracy, name, region).is_some_and(|[max, bound]| [max.as_str(), &bound] == found)
            });
            if !right {
                wrong.push(format!("`{name}` {region:?}: {found:?} is in neither table"));
            }
            policies.extend(in_kernel(&kernel, name, found).map(|_| name.to_owned()));
        }
    }
    println!("{checked:?} tests, functions, figures");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(checked.iter().all(|&n| n > 60), "{checked:?}");
    assert_eq!(
        policies,
        ["Affine", "Exact", "Lines::bounded", "Planes", "Spans16"].map(str::to_owned).into()
    );
}

/// A label each, in the order of the page: those of the relations that are set, and those of the rows.
#[test]
fn each_relation_that_is_set_has_its_row() {
    let page = read(&docs().join("theory.md"));
    let (mut set, mut rows, mut inside) = (Vec::new(), Vec::new(), false);
    for line in page.lines() {
        if line.starts_with("```") {
            inside = line == "```math";
        } else if let (true, Some(label)) = (inside, line.strip_prefix("\\text{")) {
            let (label, _) = label.split_once('}').expect("a label's end");
            set.extend(label.split(", "));
        } else if let Some(label) = line.strip_prefix("| **").and_then(|rest| rest.split_once("**")) {
            rows.extend(label.0.split(", "));
        }
    }
    println!("{} relations", set.len());
    let unique: BTreeSet<&str> = set.iter().copied().collect();
    assert_eq!(unique.len(), set.len(), "a label is given twice");
    assert_eq!(set, rows);
    assert!(set.len() > 60, "{}", set.len());
}

/// The table of what the formats tell apart, by the planes and distances of the example that draws its picture.
#[test]
fn the_table_of_depths_is_what_the_functions_give() {
    let page = read(&docs().join("theory.md"));
    let example = read(&docs().join("../crates/alberti/examples/depth_precision.rs"));
    let number = |text: &str| text.replace([',', '_'], "").parse::<f32>().expect("a number");
    let constant = |name: &str| {
        let (_, after) = example.split_once(&format!("const {name}: f32 = ")).expect("a constant");
        number(after.split(';').next().unwrap_or(""))
    };
    let [near, far] = ["NEAR", "FAR"].map(constant);
    let distances: Vec<f32> = {
        let header = page.lines().find(|line| line.starts_with("| format | ")).expect("the table");
        let cells = cells(header).expect("a row");
        cells[1..cells.len() - 1].iter().map(|text| number(text)).collect()
    };
    for (name, steps, reversed) in [
        ("D16", DepthSteps::D16, false),
        ("D24", DepthSteps::D24, false),
        ("F32", DepthSteps::F32, false),
        ("F32Reversed", DepthSteps::F32, true),
    ] {
        let map = if reversed { DepthMap::reversed(near, far) } else { DepthMap::forward(near, far) };
        let map = map.expect("0 < near < far");
        let apart = distances.iter().map(|&z| format!("{:.1e}", map.resolution(steps, z)));
        let until = format!("{:.0}", map.separable_until(steps, 1.0));
        let expected: Vec<String> = [format!("`{name}`")].into_iter().chain(apart).chain([until]).collect();
        let row = page.lines().find(|line| line.starts_with(&format!("| `{name}` | "))).expect("a row");
        assert_eq!(cells(row).expect("a row"), expected);
    }
    assert!(page.contains("A = 1 and B = 200,000") && [near, far] == [1.0, 200_000.0]);
}
