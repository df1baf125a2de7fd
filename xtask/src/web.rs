//! The page of crates/web: a folder that a browser opens from a disk, and the checks of it.
//!
//! ```text
//!   crates/web/src   -> wasm32, without and with simd128 -> base64 -> plain.js, simd128.js  \
//!   crates/web/page  ->                                               the same files         } target/web
//!   docs/theory.md   ->                                               theory.html, pictures /
//! ```
//!
//! Programs are in scripts, because browsers fetch nothing from a disk.

mod theory;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::command::{Outcome, cargo, output, run};
use crate::embedded::{Target, Toolchain};
use crate::{wasm, workspace};

const MANIFEST: &str = "crates/web/Cargo.toml";
const TRIPLE: &str = "wasm32-unknown-unknown";

/// The most bytes of a program.
const MOST: usize = 400_000;

/// Functions are inlined up to a quarter of the usual size, and the linker writes numbers in as few bytes as they need:
/// that saves a tenth of a program, and costs no time that can be told.
const SMALL: &str = "-C llvm-args=--inline-threshold=60 -C link-arg=--compress-relocations";

/// Debian's browser, and the package that has it.
const CHROMIUM: &str = "/usr/bin/chromium";

/// The programs: the name of a script, and the feature of WebAssembly.
const PROGRAMS: [(&str, Option<&str>); 2] = [("plain", None), ("simd128", Some("simd128"))];

/// Builds the page, and checks or times it as the arguments say.
pub(crate) fn web(arguments: &[String]) -> Outcome {
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => build().map(|_| ()),
        ["--check"] => check(),
        ["--speed"] => speed(),
        _ => Err("expected nothing, `--check` or `--speed`".into()),
    }
}

fn folder() -> PathBuf {
    workspace::target_directory().join("web")
}

fn failed(path: &Path) -> impl Fn(std::io::Error) -> String {
    move |error| format!("{}: {error}", path.display())
}

/// Builds the folder, and returns the files of both programs.
fn build() -> Result<Vec<PathBuf>, String> {
    let folder = folder();
    // Nothing is left of an earlier page.
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(failed(&folder))?;
    let mut files = Vec::new();
    let mut sizes = Vec::new();
    for (name, feature) in PROGRAMS {
        let file = compile(name, Target { feature, ..Target::of(TRIPLE) })?;
        let program = fs::read(&file).map_err(failed(&file))?;
        if !program.starts_with(wasm::MAGIC) {
            return Err(format!("{} is not a module of WebAssembly", file.display()));
        }
        let script = folder.join(format!("{name}.js"));
        let text = format!("const {} = \"{}\";\n", name.to_uppercase(), base64(&program));
        fs::write(&script, text).map_err(failed(&script))?;
        sizes.push((name, program.len()));
        files.push(file);
    }
    let page = workspace::root().join("crates/web/page");
    for entry in fs::read_dir(&page).map_err(failed(&page))? {
        let entry = entry.map_err(failed(&page))?;
        fs::copy(entry.path(), folder.join(entry.file_name())).map_err(failed(&entry.path()))?;
    }
    theory::write(&workspace::root().join("docs"), &folder)?;
    for (name, size) in &sizes {
        println!("{name}: {size} bytes of wasm, at most {MOST}");
    }
    println!("open {}", folder.join("index.html").display());
    match sizes.iter().find(|(_, size)| *size > MOST) {
        Some((name, size)) => Err(format!("the program `{name}` has {size} bytes; {MOST} are the most")),
        None => Ok(files),
    }
}

/// Compiles a program, in a directory of its own, since its flags are no other's, and returns its file.
fn compile(name: &str, target: Target) -> Result<PathBuf, String> {
    let toolchain = Toolchain::find(target)?;
    let directory = workspace::target_directory().join("web-wasm").join(name);
    let mut build = toolchain.cargo_in(&directory, "build", target);
    build.args(["--locked", "--release", "--lib", "--manifest-path", MANIFEST]);
    let feature = target.feature.map(|feature| format!(" -C target-feature=+{feature}"));
    build.env("RUSTFLAGS", format!("{SMALL}{}", feature.unwrap_or_default()));
    if let Toolchain::BuildStd { .. } = toolchain {
        // It has an allocator; of two such options the last counts.
        build.args(["-Z", "build-std=core,alloc"]);
    }
    run(&mut build)?;
    Ok(directory.join(TRIPLE).join("release/alberti_web.wasm"))
}

/// Compiles the native program, and runs it.
fn native(what: &str) -> Result<String, String> {
    let directory = workspace::target_directory().join("web-native");
    let mut build = cargo();
    build.args(["build", "--locked", "--release", "--bin", "native", "--manifest-path", MANIFEST]);
    run(build.arg("--target-dir").arg(&directory))?;
    output(Command::new(directory.join("release/native")).arg(what))
}

/// A program that has to be here, and the Debian package that has it.
fn need(program: &str, package: &str) -> Outcome {
    let found = Command::new("which").arg(program).stdout(Stdio::null()).status();
    match found {
        Ok(status) if status.success() => Ok(()),
        _ => Err(format!("{program} is not here; install it, on Debian with `apt-get install {package}`")),
    }
}

/// The programs of all drivers.
fn need_all() -> Outcome {
    let programs = [(CHROMIUM, "chromium"), ("node", "nodejs"), ("npm", "npm")];
    programs.into_iter().try_for_each(|(program, package)| need(program, package))
}

/// Opens the page in a browser, and compares its pictures with native ones.
pub(crate) fn check() -> Outcome {
    need_all()?;
    build()?;
    let screenshots = workspace::target_directory().join("web-check");
    _ = fs::remove_dir_all(&screenshots);
    fs::create_dir_all(&screenshots).map_err(failed(&screenshots))?;
    let hashes = screenshots.join("hashes");
    fs::write(&hashes, native("hashes")?).map_err(failed(&hashes))?;
    run(driver("driver.js")?.arg(folder()).arg(hashes).arg(&screenshots))?;
    println!("screenshots are in {}", screenshots.display());
    Ok(())
}

/// A script that drives the browser.
fn driver(script: &str) -> Result<Command, String> {
    let mut driver = Command::new("node");
    driver.current_dir(workspace::root()).env("NODE_PATH", playwright()?);
    driver.arg(Path::new("crates/web/driver").join(script)).arg(CHROMIUM);
    Ok(driver)
}

/// Installs the driver's one package, as its lock file says, and returns where it is.
fn playwright() -> Result<PathBuf, String> {
    let source = workspace::root().join("crates/web/driver");
    let directory = workspace::target_directory().join("web-driver");
    let modules = directory.join("node_modules");
    let lock = "package-lock.json";
    let read = |folder: &Path| fs::read(folder.join(lock)).ok();
    // npm leaves its own list there when all is in place.
    if modules.join(".package-lock.json").exists() && read(&source) == read(&directory) {
        return Ok(modules);
    }
    fs::create_dir_all(&directory).map_err(failed(&directory))?;
    for name in ["package.json", lock] {
        fs::copy(source.join(name), directory.join(name)).map_err(failed(&source.join(name)))?;
    }
    run(Command::new("npm").current_dir(&directory).args(["ci", "--no-audit", "--no-fund"]))?;
    Ok(modules)
}

/// Times pictures in Node beside those of native code, one sample at a time, and those of the page in a browser.
fn speed() -> Outcome {
    need_all()?;
    let programs = build()?;
    let times = workspace::target_directory().join("web-times");
    fs::write(&times, native("times")?).map_err(failed(&times))?;
    let mut node = Command::new("node");
    node.current_dir(workspace::root()).arg("crates/web/driver/speed.js").args(programs);
    run(node.stdin(fs::File::open(&times).map_err(failed(&times))?))?;
    run(driver("frames.js")?.arg(folder()))
}

/// Bytes in base64, as RFC 4648 has it.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let word = (0..3).fold(0, |word, k| word << 8 | u32::from(group.get(k).copied().unwrap_or(0)));
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k) & 63) as usize];
            text.push(if k <= group.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_rfc() {
        let texts = ["", "f", "fo", "foo", "foob", "fooba", "foobar"].map(|text| base64(text.as_bytes()));
        assert_eq!(texts, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
        assert_eq!(base64(&[0xff, 0xfe, 0xfd]), "//79");
    }

    #[test]
    fn a_missing_program_is_named_with_its_package() {
        let message = need("no-such-program-here", "some-package").unwrap_err();
        assert!(message.contains("no-such-program-here") && message.contains("apt-get install some-package"));
        assert!(web(&["--fast".into()]).is_err());
    }
}
