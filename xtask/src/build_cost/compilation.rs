//! A compiler that notes its cost: this program in the place of rustc, and the file that it writes.
//!
//! Cargo starts `xtask rustc arguments…` instead of `rustc arguments…` where `RUSTC_WRAPPER` says so. Each compilation
//! becomes one line of the file that the variable [`LOG`] names: microseconds of the processor, bytes of memory at the
//! peak, the crate, the package's folder, with tabs between them.

use std::ffi::OsString;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Duration;

use super::usage;

/// The variable with the path of the file. Where it is set, this program is a compiler.
pub(crate) const LOG: &str = "ALBERTI_COMPILATIONS";

/// The cost of one compiler, its linker included.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Compilation {
    cpu: Duration,
    pub(super) peak_bytes: u64,
    /// The crate's name, with underscores; those of build scripts begin with `build_script`.
    pub(super) name: String,
    /// The folder of the package's manifest.
    folder: PathBuf,
}

/// Runs the compiler that the arguments name, notes its cost, and exits as it does.
pub(crate) fn wrap(log: &Path, arguments: &[OsString]) -> ExitCode {
    let Some((compiler, arguments)) = arguments.split_first() else {
        eprintln!(
            "xtask: `{LOG}` is set, so that the arguments must be those of a compiler, but there are none"
        );
        return ExitCode::from(2);
    };
    let status = match Command::new(compiler).args(arguments).status() {
        Ok(status) => status,
        Err(error) => {
            eprintln!("xtask: cannot start {}: {error}", compiler.display());
            return ExitCode::FAILURE;
        }
    };
    // Without a crate's name it is a question, such as that for the version.
    if let (Some(name), Some(usage)) = (crate_name(arguments), usage::of_children()) {
        let folder = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default().into();
        let compilation = Compilation { cpu: usage.cpu, peak_bytes: usage.peak_bytes, name, folder };
        if let Err(error) = append(log, &compilation) {
            eprintln!("xtask: cannot write {}: {error}", log.display());
            return ExitCode::FAILURE;
        }
    }
    status.code().and_then(|code| u8::try_from(code).ok()).map_or(ExitCode::FAILURE, ExitCode::from)
}

/// The value of `--crate-name`, but not the one that cargo makes up to ask for the compiler's settings.
fn crate_name(arguments: &[OsString]) -> Option<String> {
    let at = arguments.iter().position(|argument| argument == "--crate-name")?;
    arguments.get(at + 1)?.to_str().filter(|name| *name != "___").map(str::to_string)
}

/// Compilers run side by side: a line is written at once, at the end of the file.
fn append(log: &Path, compilation: &Compilation) -> std::io::Result<()> {
    let Compilation { cpu, peak_bytes, name, folder } = compilation;
    let line = format!("{}\t{peak_bytes}\t{name}\t{}\n", cpu.as_micros(), folder.display());
    OpenOptions::new().create(true).append(true).open(log)?.write_all(line.as_bytes())
}

/// The compilations that the file tells of; none where there is no file.
pub(super) fn read(log: &Path) -> Result<Vec<Compilation>, String> {
    if !log.exists() {
        return Ok(Vec::new());
    }
    let text = fs::read_to_string(log).map_err(|error| format!("cannot read {}: {error}", log.display()))?;
    let lines = text.lines().enumerate();
    lines
        .map(|(index, line)| {
            parse(line).ok_or_else(|| {
                format!("{}:{}: expected a compilation, found `{line}`", log.display(), index + 1)
            })
        })
        .collect()
}

fn parse(line: &str) -> Option<Compilation> {
    let mut fields = line.splitn(4, '\t');
    Some(Compilation {
        cpu: Duration::from_micros(fields.next()?.parse().ok()?),
        peak_bytes: fields.next()?.parse().ok()?,
        name: fields.next()?.to_string(),
        folder: fields.next()?.into(),
    })
}

/// The processor's time for the packages in a folder and its folders.
pub(super) fn total_below(compilations: &[Compilation], folder: &Path) -> Duration {
    // Cargo resolves links in its own paths.
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.into());
    compilations.iter().filter(|each| each.folder.starts_with(&folder)).map(|each| each.cpu).sum()
}

/// The compilation that held the most memory.
pub(super) fn largest(compilations: &[Compilation]) -> Option<&Compilation> {
    compilations.iter().max_by_key(|each| each.peak_bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINES: [&str; 3] = [
        "2000000\t300\tlibc\t/home/a/registry/libc-0.2",
        "1500000\t100\talberti_math\t/home/a/alberti/crates/math",
        "250000\t200\talberti\t/home/a/alberti/crates/app",
    ];

    fn compilations() -> Vec<Compilation> {
        LINES.map(|line| parse(line).unwrap()).to_vec()
    }

    #[test]
    fn costs_are_summed_by_folder() {
        let total = total_below(&compilations(), Path::new("/home/a/alberti"));
        assert_eq!(total, Duration::from_millis(1750));
        assert_eq!(total_below(&compilations(), Path::new("/home/a/alb")), Duration::ZERO);
    }

    #[test]
    fn the_largest_is_known_by_name() {
        assert_eq!(largest(&compilations()).unwrap().name, "libc");
        assert_eq!(largest(&[]), None);
    }

    #[test]
    fn lines_are_read_as_they_were_written() {
        let log = std::env::temp_dir().join(format!("alberti-compilations-{}", std::process::id()));
        assert_eq!(read(&log), Ok(Vec::new()));
        for compilation in &compilations() {
            append(&log, compilation).unwrap();
        }
        assert_eq!(read(&log), Ok(compilations()));
        fs::write(&log, "2000000\tlibc\n").unwrap();
        assert!(read(&log).unwrap_err().ends_with(":1: expected a compilation, found `2000000\tlibc`"));
        fs::remove_file(&log).unwrap();
    }

    #[test]
    fn questions_have_no_crate_name() {
        let name = |words: &[&str]| crate_name(&words.iter().map(OsString::from).collect::<Vec<_>>());
        assert_eq!(name(&["--crate-name", "alberti", "--edition=2024"]), Some("alberti".into()));
        assert_eq!(name(&["-", "--crate-name", "___", "--print=cfg"]), None);
        assert_eq!(name(&["-vV"]), None);
    }
}
