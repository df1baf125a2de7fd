//! What the crates' `Cargo.toml` files say: lints, and the arrows of dependency.

use super::Problem;
use crate::workspace::{self, EXTERNAL, LIBRARIES, Library, OPTIONAL};

/// Checks one manifest; those outside `crates/` are free.
pub(super) fn check(file: &str, text: &str) -> Vec<Problem> {
    let mut problems = Vec::new();
    let folder = file.strip_prefix("crates/").and_then(|rest| rest.strip_suffix("/Cargo.toml"));
    let Some(folder) = folder.filter(|folder| workspace::crate_folders().any(|known| known == *folder))
    else {
        return problems;
    };
    if !inherits_lints(text) {
        problems.push(Problem::new(file, 1, "`[lints]` with `workspace = true` is missing"));
    }
    if let Some(library) = LIBRARIES.iter().find(|library| library.folder == folder) {
        for (line, dependency) in dependencies(text) {
            if let Some(message) = breach(library, &dependency) {
                problems.push(Problem::new(file, line, message));
            }
        }
    }
    problems
}

/// Why `library` must not depend on `dependency`, if so.
fn breach(library: &Library, dependency: &str) -> Option<String> {
    let optional = OPTIONAL.contains(&(library.package, dependency));
    if EXTERNAL.contains(&dependency) || library.may_use.contains(&dependency) || optional {
        return None;
    }
    let mut allowed: Vec<&str> = library.may_use.to_vec();
    allowed.extend(EXTERNAL);
    Some(format!("`{}` must not depend on `{dependency}`, only on {}", library.package, allowed.join(", ")))
}

fn inherits_lints(text: &str) -> bool {
    let mut section = "";
    for line in text.lines().map(without_comment) {
        if let Some(name) = header(line) {
            section = name;
        }
        let compact: String = line.split_whitespace().collect();
        if compact == "lints.workspace=true" && section.is_empty()
            || compact == "workspace=true" && section == "lints"
        {
            return true;
        }
    }
    false
}

/// The packages that this one needs to be built, each with its line: normal and build dependencies of any target.
/// Development dependencies are free.
fn dependencies(text: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    // What the section that is being read holds.
    let mut lists_dependencies = false;
    let mut describes_dependency = false;
    for (index, line) in text.lines().map(without_comment).enumerate() {
        if let Some(name) = header(line) {
            lists_dependencies = ends_in_dependencies(name);
            // `[dependencies.glam]`: the last part is the name.
            let (table, last) = name.rsplit_once('.').unwrap_or(("", name));
            describes_dependency = ends_in_dependencies(table);
            if describes_dependency {
                found.push((index + 1, unquote(last)));
            }
        } else if let Some((key, value)) = line.split_once('=') {
            // `glam = …` and `glam.workspace = true` name the package first; `g = { package = "glam" }` does not.
            if lists_dependencies {
                let name = unquote(key.split('.').next().unwrap_or(key));
                found.push((index + 1, renamed(value).unwrap_or(name)));
            } else if let (true, "package", Some(last)) = (describes_dependency, key.trim(), found.last_mut())
            {
                last.1 = unquote(value);
            }
        }
    }
    found
}

fn ends_in_dependencies(table: &str) -> bool {
    let last = table.rsplit('.').next().unwrap_or(table);
    matches!(last, "dependencies" | "build-dependencies")
}

/// The value of `package` in an inline table.
fn renamed(table: &str) -> Option<String> {
    let fields = table.trim().strip_prefix('{')?.strip_suffix('}')?;
    let field = fields
        .split(',')
        .filter_map(|field| field.split_once('='))
        .find(|(key, _)| key.trim() == "package")?;
    Some(unquote(field.1))
}

fn header(line: &str) -> Option<&str> {
    Some(line.strip_prefix('[')?.strip_suffix(']')?.trim())
}

fn without_comment(line: &str) -> &str {
    // No value in these manifests holds a hash sign.
    line.split('#').next().unwrap_or(line).trim()
}

fn unquote(word: &str) -> String {
    word.trim().trim_matches(['"', '\'']).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINTS: &str = "[lints]\nworkspace = true\n";

    fn found(file: &str, text: &str) -> Vec<String> {
        check(file, text).iter().map(Problem::to_string).collect()
    }

    fn names(text: &str) -> Vec<String> {
        dependencies(text).into_iter().map(|(_, name)| name).collect()
    }

    #[test]
    fn every_form_of_a_dependency_is_read() {
        assert_eq!(names("[dependencies]\nglam.workspace = true # why\n\"libm\" = '1'\n"), ["glam", "libm"]);
        assert_eq!(names("[dependencies]\ng = { version = \"1\", package = \"glam\" }\n"), ["glam"]);
        assert_eq!(names("[dependencies.g]\nversion = \"1\"\npackage = \"glam\"\n"), ["glam"]);
        assert_eq!(names("[target.'cfg(unix)'.dependencies]\nlibc = \"0.2\"\n"), ["libc"]);
        assert_eq!(names("[target.'cfg(unix)'.dependencies.libc]\nversion = \"0.2\"\n"), ["libc"]);
        assert_eq!(names("[build-dependencies]\ncc = \"1\"\n"), ["cc"]);
    }

    #[test]
    fn other_sections_are_not_dependencies() {
        assert_eq!(
            names("[dev-dependencies]\nproptest = \"1\"\n[features]\nstd = [\"glam/std\"]\n"),
            [""; 0]
        );
    }

    #[test]
    fn arrows_point_down_only() {
        let text = format!("[dependencies]\nglam = \"1\"\nalberti-raster = \"1\"\n{LINTS}");
        assert_eq!(
            found("crates/math/Cargo.toml", &text),
            [
                "crates/math/Cargo.toml:3: `alberti-math` must not depend on `alberti-raster`, only on fearless_simd, glam, libm"
            ]
        );
        assert_eq!(found("crates/texture/Cargo.toml", &text).len(), 1);
        assert_eq!(found("crates/alberti/Cargo.toml", &text), [""; 0]);
        assert_eq!(found("crates/app/Cargo.toml", &text), [""; 0]);
    }

    #[test]
    fn a_library_takes_no_other_crates() {
        let text = format!("[dependencies]\nserde = \"1\"\n{LINTS}");
        let message =
            "`alberti-raster` must not depend on `serde`, only on alberti-math, fearless_simd, glam, libm";
        assert_eq!(
            found("crates/raster/Cargo.toml", &text),
            [format!("crates/raster/Cargo.toml:2: {message}")]
        );
    }

    #[test]
    fn one_library_may_use_what_others_may_not() {
        let text =
            format!("[dependencies]\nbevy_mikktspace = {{ version = \"1\", optional = true }}\n{LINTS}");
        assert_eq!(found("crates/texture/Cargo.toml", &text), [""; 0]);
        assert_eq!(found("crates/raster/Cargo.toml", &text).len(), 1);
    }

    #[test]
    fn the_lints_are_inherited() {
        assert_eq!(found("crates/app/Cargo.toml", LINTS), [""; 0]);
        assert_eq!(found("crates/app/Cargo.toml", "lints.workspace = true\n"), [""; 0]);
        assert_eq!(found("crates/app/Cargo.toml", "[lints]\n[dependencies]\nworkspace = true\n").len(), 1);
    }
}
