//! Starting other programs.

use std::env;
use std::process::Command;

/// What a chore returns: nothing, or one message that says what failed and, where that helps, what to do.
pub(crate) type Outcome = Result<(), String>;

/// The cargo that runs this program, in the root of the repository.
pub(crate) fn cargo() -> Command {
    // Cargo names itself in this variable, so a `cargo +toolchain xtask` keeps its toolchain all the way down.
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(crate::workspace::root());
    command
}

/// Runs `command` with its output on the terminal.
pub(crate) fn run(command: &mut Command) -> Outcome {
    let line = describe(command);
    println!("$ {line}");
    let status = command.status().map_err(|error| format!("cannot start `{line}`: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("`{line}` failed ({status})")) }
}

/// Runs `command` and returns what it wrote to its standard output.
pub(crate) fn output(command: &mut Command) -> Result<String, String> {
    let line = describe(command);
    let output = command.output().map_err(|error| format!("cannot start `{line}`: {error}"))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`{line}` failed ({}): {}", output.status, errors.trim_end()));
    }
    String::from_utf8(output.stdout).map_err(|_| format!("`{line}` wrote text that is not UTF-8"))
}

/// The command as a person would type it: the variables that were set for it, the program's bare name, the arguments.
pub(crate) fn describe(command: &Command) -> String {
    let mut words = Vec::new();
    for (name, value) in command.get_envs() {
        if let Some(value) = value {
            words.push(format!("{}={}", name.to_string_lossy(), quote(&value.to_string_lossy())));
        }
    }
    let program = std::path::Path::new(command.get_program());
    words.push(program.file_stem().unwrap_or(program.as_os_str()).to_string_lossy().into_owned());
    words.extend(command.get_args().map(|argument| quote(&argument.to_string_lossy())));
    words.join(" ")
}

fn quote(word: &str) -> String {
    if word.is_empty() || word.contains(' ') { format!("\"{word}\"") } else { word.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_reads_as_typed() {
        let mut command = Command::new("/some/where/cargo");
        command.env("RUSTDOCFLAGS", "-D warnings").args(["doc", "--lib"]);
        assert_eq!(describe(&command), "RUSTDOCFLAGS=\"-D warnings\" cargo doc --lib");
    }

    #[test]
    fn a_program_that_is_missing_is_named() {
        let message = run(&mut Command::new("no-such-program-here")).unwrap_err();
        assert!(message.contains("`no-such-program-here`"), "{message}");
    }
}
