//! The programs that draw one thing and do nothing else: their flash, their memory, and what must not be in them.

use std::fs;
use std::path::Path;

use super::boards::Board;
use super::emulator::Machine;
use super::table::{Row, Unit};
use crate::elf::Program;
use crate::embedded::Toolchain;

/// The programs that are weighed, which must do without functions of `f64`.
pub(super) const WEIGHED: [&str; 5] = ["size-flat", "size-textured", "size-lit", "size-f32", RENDERER];
/// The one whose memory is a renderer's. The others have memory for every scene.
pub(super) const RENDERER: &str = "size-bands";
/// The program that tells how much stack each takes.
const STACK: &str = "stack";
/// The feature of programs that have to fit.
const SMALL_CODE: &str = "small-code";

/// The most bytes that the renderer in bands may take of RAM, and of these for its stack.
pub(super) const MOST_RAM: u64 = 48 * 1024;
pub(super) const MOST_STACK: u64 = 4 * 1024 + 256;

/// Builds the programs for a board and weighs them: the rows of the table, and what is wrong.
pub(super) fn weigh(board: &Board, toolchain: &Toolchain) -> Result<(Vec<Row>, Vec<String>), String> {
    let mut names = WEIGHED.to_vec();
    let is_counted = board.machine != Machine::Node;
    names.extend(is_counted.then_some(STACK));
    let folder = board.build_with(toolchain, "small", &names, &[SMALL_CODE], None)?;
    let mut rows = Vec::new();
    let mut failures = Vec::new();
    let mut add = |name: &str, unit, figure| {
        rows.push(Row { board: board.name, name: name.to_string(), unit, figure });
    };
    let mut statics = 0;
    for name in WEIGHED {
        let program = read_program(&board.image(&folder, name))?;
        add(name, Unit::Code, program.text);
        add(name, Unit::Constants, program.rodata + program.data);
        if name == RENDERER && is_counted {
            statics = program.statics;
            add(name, Unit::Statics, statics);
        }
        failures.extend(forbidden(&program).map(|fault| board.says(format!("{name} {fault}"))));
    }
    if is_counted {
        let printed =
            board.machine.run(&board.image(&folder, STACK)).map_err(|message| board.says(message))?;
        for (name, stack) in stacks(&printed).map_err(|message| board.says(message))? {
            add(name, Unit::Stack, stack);
            if name == RENDERER {
                failures.extend(over_budget(statics, stack).map(|fault| board.says(fault)));
            }
        }
    }
    Ok((rows, failures))
}

/// The functions that a program must not have, by kind.
fn forbidden(program: &Program) -> impl Iterator<Item = String> {
    let say =
        |what: &str, names: &[&str]| (!names.is_empty()).then(|| format!("{what}: {}", names.join(", ")));
    let panics = program.panics();
    let panics: Vec<&str> = panics.iter().map(String::as_str).collect();
    [say("can panic", &panics), say("computes in f64", &program.doubles())].into_iter().flatten()
}

/// The lines `stack NAME BYTES`, one for each program.
fn stacks(printed: &str) -> Result<Vec<(&str, u64)>, String> {
    let read = |line: &str| match line.split(' ').collect::<Vec<_>>()[..] {
        ["stack", name, bytes] => {
            Some((WEIGHED.into_iter().find(|known| *known == name)?, bytes.parse().ok()?))
        }
        _ => None,
    };
    let found = printed.lines().map(|line| {
        read(line).ok_or_else(|| format!("found `{line}`, expected `stack`, a program and its bytes"))
    });
    let found = found.collect::<Result<Vec<_>, _>>()?;
    if found.len() == WEIGHED.len() {
        Ok(found)
    } else {
        Err(format!("the stack of {} programs was told, expected {}", found.len(), WEIGHED.len()))
    }
}

/// The budgets of the renderer that are exceeded.
fn over_budget(statics: u64, stack: u64) -> impl Iterator<Item = String> {
    let over = |what: &str, found, most| {
        (found > most).then(|| format!("{RENDERER} takes {found} bytes of {what}, {most} at most"))
    };
    [over("RAM", statics + stack, MOST_RAM), over("stack", stack, MOST_STACK)].into_iter().flatten()
}

/// Reads a linked program.
pub(super) fn read_program(path: &Path) -> Result<Program, String> {
    let file = fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    Program::read(&file).map_err(|message| format!("{}: {message}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_program_tells_its_stack() {
        let all: String = WEIGHED.iter().map(|name| format!("stack {name} 100\n")).collect();
        assert_eq!(stacks(&all).unwrap()[1], ("size-textured", 100));
        assert_eq!(stacks("stack size-flat 7\n"), Err("the stack of 1 programs was told, expected 5".into()));
        assert_eq!(
            stacks("stack size-none 7\n"),
            Err("found `stack size-none 7`, expected `stack`, a program and its bytes".into())
        );
    }

    #[test]
    fn the_renderer_has_budgets() {
        assert_eq!(over_budget(MOST_RAM - MOST_STACK, MOST_STACK).count(), 0);
        assert_eq!(
            over_budget(MOST_RAM - MOST_STACK, MOST_STACK + 1).collect::<Vec<_>>(),
            [
                "size-bands takes 49153 bytes of RAM, 49152 at most",
                "size-bands takes 4353 bytes of stack, 4352 at most"
            ]
        );
    }

    #[test]
    fn panics_and_doubles_are_faults() {
        let symbols = ["__aeabi_dmul", "core_panic_fmt", "memcpy"].map(|name| (name.to_string(), 0)).to_vec();
        let program = Program { text: 1, rodata: 0, statics: 0, data: 0, symbols };
        assert_eq!(
            forbidden(&program).collect::<Vec<_>>(),
            ["can panic: core_panic_fmt", "computes in f64: __aeabi_dmul"]
        );
    }
}
