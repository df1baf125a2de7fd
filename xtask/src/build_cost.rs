//! The cost of building, from nothing and after an edit, beside its goals.
//!
//! Every build has a target folder of its own, emptied before and removed afterwards, and the registry's sources are
//! there before the clock starts. Compilers are started through this program (`RUSTC_WRAPPER`), which notes the
//! processor's time and the memory of each: see [`compilation`].

pub(crate) mod compilation;
mod table;
mod usage;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use crate::command::{self, Outcome, cargo};
use crate::elf::Program;
use crate::workspace;
use compilation::Compilation;
use table::{Figure, Figures};

/// The command's binary, by its name.
const BINARY: &str = "alberti";

/// The source file that the edit touches.
const EDITED: &str = "crates/raster/src/lib.rs";

/// The functions of which every combination of stages, policies and lanes has one instance, for several lanes and for
/// one; too long to be inlined.
const KERNELS: [&str; 2] =
    ["alberti_raster::draw::Paint::draw_alike", "alberti_raster::draw::Paint::draw_alone"];

/// The variable of cargo with the folder of its outputs.
const TARGET: &str = "CARGO_TARGET_DIR";

/// A group of measurements that can be asked for alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Command,
    Tests,
    Edit,
}

/// All parts by the names of their arguments, in the order of measuring.
const PARTS: [(&str, Part); 3] = [("command", Part::Command), ("tests", Part::Tests), ("edit", Part::Edit)];

/// The arguments, understood.
#[derive(Debug, PartialEq, Eq)]
struct Request {
    parts: Vec<Part>,
    /// Whether a goal that is missed is a failure.
    check: bool,
    /// Another workspace than this one, with the same names of folders: for the tests of this program.
    root: Option<PathBuf>,
}

/// Measures the parts that the arguments name, or all, and prints the table.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let request = request(arguments)?;
    let root = request.root.unwrap_or_else(workspace::root);
    let wants = |part| request.parts.contains(&part);
    command::run(cargo().current_dir(&root).arg("fetch"))?;
    let mut figures = Figures::default();
    if wants(Part::Command) || wants(Part::Edit) {
        let build = Build::new(&root, "command")?;
        let cost = build.run(&["build", "--release", "--bin", BINARY])?;
        if wants(Part::Command) {
            figures_of_command(&build, &cost, &mut figures)?;
        }
        if wants(Part::Edit) {
            let touched = Touched::new(&root.join(EDITED))?;
            let cost = build.run(&["build", "--release", "--bin", BINARY])?;
            drop(touched);
            figures.add_seconds(Figure::EditWall, cost.wall);
        }
    }
    if wants(Part::Tests) {
        figures_of_tests(&Build::new(&root, "tests")?, &mut figures)?;
    }
    let cores = thread::available_parallelism().map_or(1, usize::from);
    println!("\nMeasured on {cores} cores.\n\n{}", table::markdown(&figures));
    if cfg!(not(unix)) {
        println!("The processor's time and memory of compilers cannot be measured on this system.");
    }
    let missed = table::missed(&figures);
    match (request.check, missed.is_empty()) {
        (true, false) => Err(format!("goals are missed: {}", missed.join("; "))),
        _ => Ok(()),
    }
}

fn request(arguments: &[String]) -> Result<Request, String> {
    let mut request = Request { parts: Vec::new(), check: false, root: None };
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--check" => request.check = true,
            "--of" => request.root = Some(arguments.next().ok_or("expected a folder behind `--of`")?.into()),
            name => {
                let known = PARTS.iter().find(|(known, _)| *known == name);
                let names = PARTS.map(|(name, _)| format!("`{name}`")).join(", ");
                let (_, part) = known
                    .ok_or(format!("there is no part `{name}`, only {names}, and the flag `--check`"))?;
                request.parts.push(*part);
            }
        }
    }
    if request.parts.is_empty() {
        request.parts = PARTS.map(|(_, part)| part).to_vec();
    }
    Ok(request)
}

fn figures_of_command(build: &Build<'_>, cost: &Cost, figures: &mut Figures) -> Outcome {
    figures.add_seconds(Figure::CommandWall, cost.wall);
    if let Some(cpu) = cost.cpu {
        figures.add_seconds(Figure::CommandCpu, cpu);
    }
    let compilations = build.compilations()?;
    if let Some(largest) = compilation::largest(&compilations) {
        figures.add_seconds(Figure::CommandOwnCpu, compilation::total_below(&compilations, build.root));
        figures.add_memory(Figure::CommandMemory, largest);
    }
    let path = build.folder.join("release").join(format!("{BINARY}{}", std::env::consts::EXE_SUFFIX));
    let file = fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    figures.add(Figure::BinaryBytes, file.len() as u64);
    // A program that is stripped, or of another system than Linux, tells nothing of its functions.
    if let Ok(program) = Program::read(&file) {
        let kernels: usize = KERNELS.iter().map(|kernel| program.instances(kernel)).sum();
        if kernels > 0 {
            figures.add(Figure::Kernels, kernels as u64);
        }
    }
    Ok(())
}

fn figures_of_tests(build: &Build<'_>, figures: &mut Figures) -> Outcome {
    let compiled = build.run(&["test", "--workspace", "--no-run"])?;
    let ran = build.run(&["test", "--workspace", "--quiet"])?;
    figures.add_seconds(Figure::TestsWall, compiled.wall + ran.wall);
    figures.add_seconds(Figure::TestsCompilingWall, compiled.wall);
    figures.add_seconds(Figure::TestsRunningWall, ran.wall);
    if let (Some(compiled), Some(ran)) = (compiled.cpu, ran.cpu) {
        figures.add_seconds(Figure::TestsCpu, compiled + ran);
        figures.add_seconds(Figure::TestsCompilingCpu, compiled);
        figures.add_seconds(Figure::TestsRunningCpu, ran);
    }
    if let Some(largest) = compilation::largest(&build.compilations()?) {
        figures.add_memory(Figure::TestsMemory, largest);
    }
    Ok(())
}

/// The cost of one call of cargo.
struct Cost {
    wall: Duration,
    /// Of cargo and all that it waited for: compilers, linkers, build scripts, tests.
    cpu: Option<Duration>,
}

/// A workspace, and the empty folder that it is built into. The folder goes with this value.
struct Build<'a> {
    root: &'a Path,
    folder: PathBuf,
}

impl<'a> Build<'a> {
    fn new(root: &'a Path, name: &str) -> Result<Build<'a>, String> {
        // On the disk of other builds, and removed by `cargo clean` where this program was interrupted.
        let target = workspace::target_directory();
        let folder = target.join(format!("build-cost-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder)
            .map_err(|error| format!("cannot create {}: {error}", folder.display()))?;
        Ok(Build { root, folder })
    }

    fn run(&self, arguments: &[&str]) -> Result<Cost, String> {
        let this = std::env::current_exe().map_err(|error| format!("cannot name this program: {error}"))?;
        let mut command: Command = cargo();
        command.current_dir(self.root).args(arguments).env(TARGET, &self.folder);
        command.env("RUSTC_WRAPPER", this).env(compilation::LOG, self.log());
        let before = usage::of_children();
        let start = Instant::now();
        command::run(&mut command)?;
        let wall = start.elapsed();
        let cpu =
            usage::of_children().zip(before).map(|(after, before)| after.cpu.saturating_sub(before.cpu));
        Ok(Cost { wall, cpu })
    }

    /// Everything that was compiled so far.
    fn compilations(&self) -> Result<Vec<Compilation>, String> {
        compilation::read(&self.log())
    }

    fn log(&self) -> PathBuf {
        self.folder.join("compilations.txt")
    }
}

impl Drop for Build<'_> {
    fn drop(&mut self) {
        if let Err(error) = fs::remove_dir_all(&self.folder) {
            eprintln!("xtask: cannot remove {}: {error}", self.folder.display());
        }
    }
}

/// A file that looks as if it had just been edited, until this value goes: other target folders need no new build.
struct Touched {
    file: File,
    before: SystemTime,
}

impl Touched {
    fn new(path: &Path) -> Result<Touched, String> {
        let failed = |error| format!("cannot touch {}: {error}", path.display());
        let file = File::options().write(true).open(path).map_err(failed)?;
        let before = file.metadata().and_then(|metadata| metadata.modified()).map_err(failed)?;
        file.set_modified(SystemTime::now()).map_err(failed)?;
        Ok(Touched { file, before })
    }
}

impl Drop for Touched {
    fn drop(&mut self) {
        // A failure costs a build in other target folders, no more.
        let _ = self.file.set_modified(self.before);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn requested(arguments: &[&str]) -> Result<Request, String> {
        request(&arguments.iter().map(|argument| argument.to_string()).collect::<Vec<_>>())
    }

    #[test]
    fn all_parts_or_some() {
        let all = vec![Part::Command, Part::Tests, Part::Edit];
        assert_eq!(requested(&[]), Ok(Request { parts: all.clone(), check: false, root: None }));
        assert_eq!(requested(&["--check"]), Ok(Request { parts: all, check: true, root: None }));
        assert_eq!(requested(&["edit"]).unwrap().parts, [Part::Edit]);
        assert_eq!(requested(&["--of", "a", "tests"]).unwrap().root, Some("a".into()));
    }

    #[test]
    fn wrong_arguments_are_named() {
        let message = "there is no part `test`, only `command`, `tests`, `edit`, and the flag `--check`";
        assert_eq!(requested(&["test"]), Err(message.into()));
        assert!(requested(&["--of"]).unwrap_err().contains("`--of`"));
    }
}
