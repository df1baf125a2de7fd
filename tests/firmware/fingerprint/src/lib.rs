//! Small scenes of any kind, each of which is one number: the hash of its frame, the same on every machine.
//!
//! A scene is its number: from it come the mesh, textures, lights and all policies that are values ([`seed`]). Its
//! kind, which is `number % KINDS`, says which kernel draws it ([`kinds`]) or which functions are called
//! ([`functions`]). Nothing of it depends on a platform's mathematical library.

#![no_std]

#[cfg(feature = "c")]
mod c;
pub mod functions;
pub mod kinds;
pub mod seed;

use alberti::lanes::Machine;
pub use seed::Memory;
use seed::Seed;

/// The number of scenes.
pub const SCENES: u32 = 320;

/// The hash of a scene, by lanes of this kind; `None` beyond the last scene.
pub fn fingerprint(number: u32, machine: Machine, memory: &mut Memory) -> Option<u64> {
    if number >= SCENES {
        return None;
    }
    let mut seed = Seed::new(number);
    let kinds = u32::try_from(kinds::KINDS.len()).unwrap_or(1);
    let all = kinds + u32::try_from(functions::KINDS.len()).unwrap_or(0);
    let kind = (number % all) as usize;
    memory.clear();
    if let Some((_, draw)) = kinds::KINDS.get(kind) {
        draw(&mut seed, machine, memory)?;
        return Some(memory.hash());
    }
    let (_, call) = functions::KINDS.get(kind - kinds::KINDS.len())?;
    Some(call(&mut seed))
}

/// The lanes of a machine that are used first.
#[must_use]
pub fn machine() -> Option<Machine> {
    Machine::all().next()
}

/// The name of a scene's kind.
#[must_use]
pub fn kind(number: u32) -> &'static str {
    let names =
        kinds::KINDS.iter().map(|(name, _)| *name).chain(functions::KINDS.iter().map(|(name, _)| *name));
    let all = kinds::KINDS.len() + functions::KINDS.len();
    names.into_iter().nth(number as usize % all.max(1)).unwrap_or_default()
}
