//! The machines that run programs, QEMU's and Node, as one function from a program to what it prints.

use std::io::{ErrorKind, Read};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::command::{Outcome, describe};
use crate::workspace;

/// The Debian packages that have the emulators.
const PACKAGES: &str = "qemu-system-arm qemu-system-misc";

/// A program that hangs must not hang the caller; the slowest takes a fifth of this on a slow machine.
const LONGEST: Duration = Duration::from_secs(1500);

/// The program that runs modules of WebAssembly, its package, and the file that tells it how.
const NODE: &str = "node";
const NODE_PACKAGE: &str = "nodejs";
const NODE_SCRIPT: &str = "tests/firmware/boards/node.js";

/// A machine that runs programs.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Machine {
    Qemu(Qemu),
    Node,
}

/// A machine of one of QEMU's programs.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Qemu {
    pub(super) program: &'static str,
    /// The arguments that choose the machine.
    pub(super) arguments: &'static [&'static str],
    /// Each instruction takes 2^shift ns of the machine's time: this makes every count repeatable.
    pub(super) shift: u32,
    /// A tick of `alberti_firmware::ticks` is so many instructions: a fraction.
    pub(super) instructions_per_tick: (u64, u64),
}

impl Machine {
    /// Says what to install if the program is missing.
    pub(super) fn find(&self) -> Outcome {
        match self {
            Self::Qemu(qemu) => find(qemu.program, PACKAGES, "QEMU's system emulators for Arm and RISC-V"),
            Self::Node => find(NODE, NODE_PACKAGE, "Node.js"),
        }
    }

    /// Runs the program to its end, and returns what it prints.
    pub(super) fn run(&self, image: &Path) -> Result<String, String> {
        self.run_in(Path::new("."), &[], image)
    }

    /// The same where the program finds the files of a folder, with more arguments.
    pub(super) fn run_in(&self, folder: &Path, arguments: &[String], image: &Path) -> Result<String, String> {
        let mut command = match self {
            Self::Qemu(qemu) => qemu.command(),
            Self::Node => Command::new(NODE),
        };
        command.current_dir(folder).args(arguments);
        match self {
            Self::Qemu(_) => command.arg("-kernel"),
            Self::Node => command.arg(workspace::root().join(NODE_SCRIPT)),
        };
        let line = describe(command.arg(image));
        println!("$ {line}");
        let (status, printed, errors) =
            finish(&mut command, LONGEST).map_err(|error| format!("`{line}` {error}"))?;
        if status.success() {
            Ok(printed)
        } else {
            Err(format!("`{line}` failed ({status}):\n{printed}{}", errors.trim_end()))
        }
    }
}

impl Qemu {
    /// A number of ticks in instructions.
    pub(super) fn instructions(&self, ticks: u64) -> u64 {
        let (numerator, denominator) = self.instructions_per_tick;
        ticks * numerator / denominator
    }

    fn command(&self) -> Command {
        let mut command = Command::new(self.program);
        command.args(self.arguments).args(["-nographic", "-monitor", "none", "-serial", "none"]);
        command.args(["-semihosting-config", "enable=on,target=native", "-icount"]);
        command.arg(format!("shift={},sleep=off", self.shift));
        command
    }
}

/// Says which package has a program that is missing, on Debian and as people call it.
fn find(program: &str, packages: &str, name: &str) -> Outcome {
    let outcome = Command::new(program).arg("--version").stdout(Stdio::null()).status();
    outcome.map(|_| ()).map_err(|error| match error.kind() {
        ErrorKind::NotFound => format!(
            "`{program}` is not installed. On Debian and Ubuntu `apt-get install {packages}`, elsewhere the package of \
             {name}; then run this again"
        ),
        _ => format!("cannot start `{program}`: {error}"),
    })
}

/// Runs `command` and returns its status and both outputs; kills it if it takes too long.
fn finish(command: &mut Command, longest: Duration) -> Result<(ExitStatus, String, String), String> {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(|error| format!("does not start: {error}"))?;
    // Read while it runs: a full pipe would stop it.
    let (printed, errors) = (collect(child.stdout.take()), collect(child.stderr.take()));
    let status = wait(&mut child, longest);
    let text = |reader: thread::JoinHandle<String>| reader.join().unwrap_or_default();
    let (printed, errors) = (text(printed), text(errors));
    match status? {
        Some(status) => Ok((status, printed, errors)),
        None => Err(format!("did not end within {} s. It printed:\n{printed}{errors}", longest.as_secs())),
    }
}

/// Waits for the end, which is forced after `longest`: then there is no status.
fn wait(child: &mut Child, longest: Duration) -> Result<Option<ExitStatus>, String> {
    let start = Instant::now();
    while start.elapsed() < longest {
        if let Some(status) = child.try_wait().map_err(|error| format!("cannot be waited for: {error}"))? {
            return Ok(Some(status));
        }
        thread::sleep(Duration::from_millis(20));
    }
    child.kill().and_then(|()| child.wait()).map_err(|error| format!("cannot be stopped: {error}"))?;
    Ok(None)
}

/// All that comes out of a pipe, as text.
fn collect(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        // What came before an error is what there is.
        let _ = pipe.map(|mut pipe| pipe.read_to_end(&mut bytes));
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_emulator_names_the_packages() {
        let message = find("no-such-emulator-here", PACKAGES, "an emulator").unwrap_err();
        assert!(message.contains("`no-such-emulator-here`"), "{message}");
        assert!(message.contains("apt-get install qemu-system-arm qemu-system-misc"), "{message}");
    }

    #[test]
    fn both_outputs_and_the_status_come_back() {
        let mut command = Command::new("sh");
        command.args(["-c", "echo out; echo err >&2; exit 3"]);
        let (status, printed, errors) = finish(&mut command, LONGEST).unwrap();
        assert_eq!((status.code(), printed.as_str(), errors.as_str()), (Some(3), "out\n", "err\n"));
    }

    #[test]
    fn what_hangs_is_stopped() {
        let mut command = Command::new("sleep");
        let message = finish(command.arg("60"), Duration::from_millis(50)).unwrap_err();
        assert!(message.contains("did not end"), "{message}");
    }
}
