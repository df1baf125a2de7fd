//! The copy with all mutants that can be compiled together.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::list::Mutant;
use crate::rewrite::{Rewritten, rewrite};
use crate::tree::{Tree, write};

/// The packages whose tests are run.
const TESTED: [&str; 8] =
    ["-math", "-projection", "-raster", "-texture", "", "-tests", "-accuracy", "-hostile"];

/// Programs of tests that are not run: this one runs examples. With all switches, `fragments` takes a quarter of an
/// hour to compile, and reaches what no other does.
const LEFT_OUT: [&str; 1] = ["pictures"];

/// The most times that it is compiled: each time, a few more mutants are left out.
const MOST: u32 = 60;

/// The tests with the mutants in them.
pub(crate) struct Compiled {
    /// The mutants that have a switch.
    pub(crate) alive: BTreeSet<usize>,
    /// The others, each with the reason: the compiler's, or that none has been looked for.
    pub(crate) left_out: BTreeMap<usize, String>,
    pub(crate) programs: Vec<PathBuf>,
}

/// Compiles the tests, without the mutants that do not compile.
pub(crate) fn compile(tree: &Tree, mutants: &[Mutant]) -> Result<Compiled, String> {
    let mut left_out = known(tree, mutants);
    for pass in 0..MOST {
        let files = rewrite_all(tree, mutants, &left_out)?;
        let build = pass > 0 && left_out.len() == known(tree, mutants).len();
        let messages = cargo(tree, build)?;
        let faults: Vec<_> = messages.iter().filter_map(fault).collect();
        if faults.is_empty() {
            if build {
                let in_files = files.values().flat_map(|file| &file.regions).flat_map(|(_, all)| all);
                let alive: BTreeSet<usize> = in_files.copied().collect();
                for number in (0..mutants.len()).filter(|number| !alive.contains(number)) {
                    left_out.entry(number).or_insert_with(|| "of a form that has no switch".to_owned());
                }
                return Ok(Compiled { alive, left_out, programs: programs(&messages) });
            }
            continue;
        }
        let before = left_out.len();
        for fault in &faults {
            let numbers = blamed(tree, &files, fault);
            if numbers.is_empty() {
                eprintln!("nothing is to blame for: {}", fault.message);
            }
            for number in numbers {
                left_out.entry(number).or_insert_with(|| fault.message.clone());
            }
        }
        println!("{} mutants do not compile so far", left_out.len());
        if left_out.len() == before {
            return Err(format!("it does not compile: {}", faults[0].message));
        }
        keep(tree, mutants, &left_out)?;
    }
    Err("it does not compile".to_owned())
}

/// Those of earlier runs, by their names.
fn known(tree: &Tree, mutants: &[Mutant]) -> BTreeMap<usize, String> {
    let text = fs::read_to_string(tree.folder.join("left-out.txt")).unwrap_or_default();
    let reasons: HashMap<&str, &str> = text.lines().filter_map(|line| line.split_once('\t')).collect();
    let named = mutants.iter().enumerate();
    named.filter_map(|(k, mutant)| Some((k, (*reasons.get(&*mutant.name)?).to_owned()))).collect()
}

fn keep(tree: &Tree, mutants: &[Mutant], left_out: &BTreeMap<usize, String>) -> Result<(), String> {
    let lines = left_out.iter().map(|(&number, reason)| format!("{}\t{reason}\n", mutants[number].name));
    write(&tree.folder.join("left-out.txt"), lines.collect::<String>().as_bytes())
}

fn rewrite_all(
    tree: &Tree,
    mutants: &[Mutant],
    left_out: &BTreeMap<usize, String>,
) -> Result<BTreeMap<PathBuf, Rewritten>, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut by_file: BTreeMap<PathBuf, Vec<(usize, &Mutant)>> = BTreeMap::new();
    for (number, mutant) in mutants.iter().enumerate() {
        let of_file = by_file.entry(mutant.file.clone()).or_default();
        if !left_out.contains_key(&number) {
            of_file.push((number, mutant));
        }
    }
    let mut files = BTreeMap::new();
    for (name, of_file) in by_file {
        let path = root.join(&name);
        let source = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let rewritten = rewrite(&source, &of_file).map_err(|error| format!("{}: {error}", name.display()))?;
        write(&tree.root.join(&name), rewritten.text.as_bytes())?;
        files.insert(name, rewritten);
    }
    Ok(files)
}

/// Checks the tests, or builds them, and hands on what cargo says.
fn cargo(tree: &Tree, build: bool) -> Result<Vec<Value>, String> {
    let mut cargo = tree.cargo();
    // Only `cargo test` makes programs of the tests within libraries.
    cargo.args(if build { ["test", "--no-run"] } else { ["check", "--keep-going"] });
    cargo.args(["--lib", "--profile", "test", "--message-format=json"]);
    cargo.args(tests(tree)?.iter().flat_map(|name| ["--test", name]));
    cargo.args(TESTED.iter().flat_map(|package| ["-p".to_owned(), format!("alberti{package}")]));
    let output = cargo.output().map_err(|error| format!("cannot run cargo: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let messages: Vec<Value> = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    if !output.status.success() && messages.iter().all(|message| fault(message).is_none()) {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(messages)
}

/// The names of the programs of tests in folders of their own.
fn tests(tree: &Tree) -> Result<Vec<String>, String> {
    let mut cargo = tree.cargo();
    let output = cargo.args(["metadata", "--no-deps", "--format-version", "1"]).output();
    let output = output.map_err(|error| format!("cannot run cargo: {error}"))?;
    let told: Value =
        serde_json::from_slice(&output.stdout).map_err(|error| format!("the packages: {error}"))?;
    let all =
        |value: &Value, key: &str| value.get(key).and_then(Value::as_array).cloned().unwrap_or_default();
    let text = |value: &Value| value.get("name").and_then(Value::as_str).unwrap_or_default().to_owned();
    let packages = all(&told, "packages").into_iter();
    let packages = packages.filter(|package| TESTED.contains(&text(package).trim_start_matches("alberti")));
    let targets = packages.flat_map(|package| all(&package, "targets"));
    let targets = targets.filter(|target| all(target, "kind").iter().any(|kind| kind == "test"));
    Ok(targets.map(|target| text(&target)).filter(|name| !LEFT_OUT.contains(&name.as_str())).collect())
}

fn programs(messages: &[Value]) -> Vec<PathBuf> {
    let program = |message: &Value| message.get("executable").and_then(Value::as_str).map(PathBuf::from);
    let mut programs: Vec<_> = messages.iter().filter_map(program).collect();
    programs.sort();
    programs.dedup();
    programs
}

/// An error of the compiler.
struct Fault {
    message: String,
    /// Files and bytes in them, the first place first.
    places: Vec<(PathBuf, usize)>,
}

fn fault(message: &Value) -> Option<Fault> {
    let message = message.get("message")?;
    if message.get("level")?.as_str()? != "error" {
        return None;
    }
    let text = message.get("message")?.as_str()?.lines().next().unwrap_or_default().to_owned();
    let mut places = Vec::new();
    let children = message.get("children").and_then(Value::as_array).into_iter().flatten();
    for part in std::iter::once(message).chain(children) {
        let spans = part.get("spans").and_then(Value::as_array).into_iter().flatten();
        let (first, others): (Vec<&Value>, Vec<_>) =
            spans.partition(|span| span.get("is_primary").and_then(Value::as_bool) == Some(true));
        for span in first.into_iter().chain(others) {
            let file = span.get("file_name").and_then(Value::as_str);
            let at = span.get("byte_start").and_then(Value::as_u64).and_then(|at| usize::try_from(at).ok());
            places.extend(file.map(PathBuf::from).zip(at));
        }
    }
    if places.is_empty() {
        return None;
    }
    Some(Fault { message: text, places })
}

/// The mutants of the smallest switch around the first place that is in one.
fn blamed(tree: &Tree, files: &BTreeMap<PathBuf, Rewritten>, fault: &Fault) -> BTreeSet<usize> {
    for (file, at) in &fault.places {
        let name = file.strip_prefix(&tree.root).unwrap_or(file);
        let Some(rewritten) = files.get(name) else { continue };
        let around = rewritten.regions.iter().filter(|(range, _)| range.contains(at));
        let around = around.min_by_key(|(range, _)| range.len());
        // A match that is not complete is told where it begins: its arms come next.
        let next = || {
            let after = rewritten.regions.iter().filter(|(range, _)| range.start >= *at);
            after.min_by_key(|(range, _)| range.start).filter(|_| fault.message.starts_with("non-exhaustive"))
        };
        let Some((_, numbers)) = around.or_else(next) else { continue };
        return numbers.iter().copied().collect();
    }
    BTreeSet::new()
}
