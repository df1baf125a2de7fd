//! Rules on manifests: lints, the arrows of dependency, and features.
//!
//! Cargo reads the manifests (`cargo metadata`), so that a dependency counts in every form in which it can be written.

use serde_json::Value;

use super::Problem;
use crate::command::{cargo, output};
use crate::workspace::{APPLICATIONS, EXTERNAL, LIBRARIES, Library, OPTIONAL, TESTS};

/// The library that hands the features of all others on.
const FACADE: &str = "alberti";

/// Features that the host's builds leave out: without `default` nothing is lost, `libm` is for targets without std,
/// `avx512` and `sse2` have a step of their own, and `small-code` takes a way that tests take by its name.
const NOT_ASKED: [&str; 5] = ["default", "libm", "avx512", "sse2", "small-code"];

/// Lints that the workspace's manifest must set, because a rule rests on them alone: no unsafe code, nothing unfinished
/// or left over from debugging.
const LINTS: [&str; 4] =
    ["unsafe_code = \"forbid\"", "dbg_macro = \"warn\"", "todo = \"warn\"", "unimplemented = \"warn\""];

/// Cargo's description of this workspace's packages.
pub(super) fn metadata() -> Result<Value, String> {
    let text = output(cargo().args(["metadata", "--no-deps", "--format-version", "1"]))?;
    serde_json::from_str(&text)
        .map_err(|error| format!("cannot read the output of `cargo metadata`: {error}"))
}

/// Checks the lints in one manifest.
pub(super) fn lints(file: &str, text: &str) -> Vec<Problem> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let mut problems = Vec::new();
    let is_package = lines.contains(&"[package]");
    let inherits = lines.windows(2).any(|pair| pair == ["[lints]", "workspace = true"]);
    // A package that others use by its path from elsewhere has none of a workspace's.
    let alone = lines.contains(&"[lints.rust]") && lines.contains(&LINTS[0]);
    if is_package && !inherits && !alone {
        problems.push(Problem::new(file, 1, "`[lints]` and below it `workspace = true` are missing"));
    }
    if file == "Cargo.toml" {
        let missing = LINTS.iter().filter(|lint| !lines.contains(lint));
        problems
            .extend(missing.map(|lint| Problem::new(file, 1, format!("`{lint}` is missing in the lints"))));
    }
    problems
}

/// Checks the arrows between packages, the features of the libraries, and that `cargo run` knows its program.
pub(super) fn packages(metadata: &Value) -> Vec<Problem> {
    let mut problems = Vec::new();
    let programs = programs(metadata);
    if programs.len() != 1 {
        let message = format!("`cargo run` needs one program among the default members, found {programs:?}");
        problems.push(Problem::new("Cargo.toml", 1, message));
    }
    for library in LIBRARIES {
        let file = format!("crates/{}/Cargo.toml", library.folder);
        let Some(package) = package(metadata, library.package) else {
            problems.push(Problem::new(&file, 1, format!("`{}` is no member", library.package)));
            continue;
        };
        let breaches = dependencies(package).filter_map(|dependency| breach(library, dependency));
        problems.extend(breaches.map(|message| Problem::new(&file, 1, message)));
        problems.extend(untested(metadata, package).map(|message| Problem::new(&file, 1, message)));
    }
    problems
}

/// The reason why `library` must not depend on `dependency`, if so.
fn breach(library: &Library, dependency: &Value) -> Option<String> {
    let name = dependency["name"].as_str()?;
    if library.terms.contains(&name) {
        let optional = dependency["optional"] == true;
        return (!optional)
            .then(|| format!("`{}` must depend on `{name}` by a feature only", library.package));
    }
    let optional = OPTIONAL.contains(&(library.package, name));
    if EXTERNAL.contains(&name) || library.may_use.contains(&name) || optional {
        return None;
    }
    let mut allowed: Vec<&str> = library.may_use.to_vec();
    allowed.extend(EXTERNAL);
    Some(format!("`{}` must not depend on `{name}`, only on {}", library.package, allowed.join(", ")))
}

/// The packages that this one needs to be built, on any target. Development dependencies are free.
fn dependencies(package: &Value) -> impl Iterator<Item = &Value> {
    list(&package["dependencies"]).filter(|dependency| dependency["kind"] != "dev")
}

/// Complaints about features that neither clippy nor the tests would see. Both build all members at once, with what
/// any of them asks for, so the application or the tests must ask the facade for everything.
fn untested(metadata: &Value, library: &Value) -> impl Iterator<Item = String> {
    let features = library["features"].as_object().into_iter().flatten().map(|(name, _)| name.as_str());
    let asked: Vec<&str> = APPLICATIONS
        .iter()
        .map(|&(application, _)| application)
        .chain([TESTS])
        .filter_map(|name| package(metadata, name))
        .flat_map(|package| list(&package["dependencies"]))
        .filter(|dependency| dependency["name"] == FACADE)
        .flat_map(|facade| list(&facade["features"]))
        .filter_map(Value::as_str)
        .collect();
    let missed = features.filter(move |feature| !NOT_ASKED.contains(feature) && !asked.contains(feature));
    missed.map(|feature| {
        format!("no test sees the feature `{feature}`: let crates/app or tests ask `{FACADE}` for it, under this name")
    })
}

/// The programs among the default members, by their names.
fn programs(metadata: &Value) -> Vec<&str> {
    let members: Vec<&Value> = list(&metadata["workspace_default_members"]).collect();
    let packages = list(&metadata["packages"]).filter(|package| members.contains(&&package["id"]));
    let targets = packages.flat_map(|package| list(&package["targets"]));
    let programs = targets.filter(|target| list(&target["kind"]).any(|kind| kind == "bin"));
    programs.filter_map(|target| target["name"].as_str()).collect()
}

fn package<'a>(metadata: &'a Value, name: &str) -> Option<&'a Value> {
    list(&metadata["packages"]).find(|package| package["name"] == name)
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    const NONE: [&str; 0] = [];

    /// A workspace with all libraries, in which one has a dependency and a feature.
    fn found(library: &str, dependency: Value, feature: &str) -> Vec<String> {
        let libraries = LIBRARIES.iter().map(|each| {
            if each.package == library {
                json!({ "name": library, "dependencies": [dependency], "features": { feature: [] } })
            } else {
                json!({ "name": each.package, "dependencies": [], "features": {} })
            }
        });
        let facade = json!({ "name": FACADE, "kind": null, "features": ["std", "simd"] });
        let application = json!({
            "name": APPLICATIONS[0].0,
            "id": "app",
            "dependencies": [facade],
            "features": {},
            "targets": [{ "name": "alberti", "kind": ["bin"] }, { "name": "alberti_app", "kind": ["lib"] }],
        });
        let packages: Vec<Value> = libraries.chain([application]).collect();
        let metadata = json!({ "packages": packages, "workspace_default_members": ["app"] });
        super::packages(&metadata).iter().map(Problem::to_string).collect()
    }

    fn on(name: &str) -> Value {
        json!({ "name": name, "kind": null })
    }

    #[test]
    fn arrows_point_down_only() {
        let message = "crates/math/Cargo.toml:1: `alberti-math` must not depend on `alberti-raster`, only on \
                       fearless_simd, glam, libm";
        assert_eq!(found("alberti-math", on("alberti-raster"), "std"), [message]);
        assert_eq!(found("alberti-texture", on("alberti-raster"), "std").len(), 1);
        assert_eq!(found("alberti", on("alberti-raster"), "std"), NONE);
    }

    #[test]
    fn a_library_takes_no_other_crates() {
        let message = "crates/raster/Cargo.toml:1: `alberti-raster` must not depend on `clap`, only on \
                       alberti-math, fearless_simd, glam, libm";
        assert_eq!(found("alberti-raster", on("clap"), "std"), [message]);
        assert_eq!(found("alberti-raster", json!({ "name": "cc", "kind": "build" }), "std").len(), 1);
        assert_eq!(found("alberti-raster", json!({ "name": "proptest", "kind": "dev" }), "std"), NONE);
        assert_eq!(found("alberti-raster", on("glam"), "std"), NONE);
    }

    #[test]
    fn one_library_may_use_what_others_may_not() {
        assert_eq!(found("alberti-texture", on("bevy_mikktspace"), "std"), NONE);
        assert_eq!(found("alberti-raster", on("bevy_mikktspace"), "std").len(), 1);
    }

    #[test]
    fn terms_of_others_are_optional() {
        let message = "crates/raster/Cargo.toml:1: `alberti-raster` must depend on `serde` by a feature only";
        assert_eq!(found("alberti-raster", on("serde"), "std"), [message]);
        let optional = json!({ "name": "serde", "kind": null, "optional": true });
        assert_eq!(found("alberti-raster", optional, "std"), NONE);
        assert_eq!(found("alberti-raster", on("mint"), "std").len(), 1);
    }

    #[test]
    fn every_feature_is_asked_for() {
        assert_eq!(found("alberti-texture", on("glam"), "libm"), NONE);
        let message = "crates/texture/Cargo.toml:1: no test sees the feature `tangents`: let crates/app or \
                       tests ask `alberti` for it, under this name";
        assert_eq!(found("alberti-texture", on("glam"), "tangents"), [message]);
    }

    #[test]
    fn missing_members_are_found() {
        let problems = super::packages(&json!({ "packages": [] }));
        assert_eq!(problems.len(), 1 + LIBRARIES.len());
        assert_eq!(problems[1].to_string(), "crates/math/Cargo.toml:1: `alberti-math` is no member");
    }

    #[test]
    fn one_program_is_meant_by_cargo_run() {
        let package = |id: &str| json!({ "id": id, "targets": [{ "name": id, "kind": ["bin"] }] });
        let metadata = |members: &[&str]| json!({ "packages": [package("a"), package("b"), package("c")], "workspace_default_members": members });
        assert_eq!(programs(&metadata(&["b"])), ["b"]);
        assert_eq!(programs(&metadata(&["a", "b"])), ["a", "b"]);
        let message =
            "Cargo.toml:1: `cargo run` needs one program among the default members, found [\"a\", \"c\"]";
        assert_eq!(super::packages(&metadata(&["a", "c"]))[0].to_string(), message);
    }

    #[test]
    fn the_lints_are_inherited() {
        let inherited = "[package]\nname = \"a\"\n[lints]\nworkspace = true\n";
        assert_eq!(lints("crates/app/Cargo.toml", inherited), []);
        assert_eq!(lints("crates/app/Cargo.toml", "[package]\n[lints]\n[a]\nworkspace = true\n").len(), 1);
        let alone = "[package]\n[lints.rust]\n";
        assert_eq!(lints("crates/app/Cargo.toml", alone).len(), 1);
        assert_eq!(lints("crates/app/Cargo.toml", &format!("{alone}unsafe_code = \"forbid\"\n")), []);
    }

    #[test]
    fn the_workspace_sets_the_lints_that_rules_rest_on() {
        let all = LINTS.join("\n");
        assert_eq!(lints("Cargo.toml", &all), []);
        assert_eq!(lints("Cargo.toml", &all.replace("forbid", "deny")).len(), 1);
        assert_eq!(lints("Cargo.toml", "").len(), LINTS.len());
    }
}
