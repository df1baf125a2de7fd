//! Memory that a run may take in all: asked for before it is allocated.
//!
//! Each need is an estimate of the most that is held at a time. It comes from what is known before: the size of a
//! picture, the headers of images, the numbers of a model as they are read.

use std::cell::Cell;
use std::fmt;
use std::fs;
use std::str::FromStr;

use crate::error::Error;
use crate::options::values::words;

/// The allowance where the system does not say what it has.
const UNKNOWN: u64 = 4 << 30;

/// A number of bytes, such as `512M`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory(pub u64);

impl FromStr for Memory {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // As 512M, 512MB or 512MiB.
        let lower = text.to_ascii_lowercase();
        let unit = lower.find(|c: char| !c.is_ascii_digit()).unwrap_or(lower.len());
        let (digits, unit) = lower.split_at(unit);
        let shift = match unit {
            "" | "b" => 0,
            "k" | "kb" | "kib" => 10,
            "m" | "mb" | "mib" => 20,
            "g" | "gb" | "gib" => 30,
            _ => u32::MAX,
        };
        let bytes = digits.parse().ok().and_then(|number: u64| number.checked_mul(1_u64.checked_shl(shift)?));
        let bytes = bytes.filter(|&bytes| bytes > 0);
        bytes
            .map(Self)
            .ok_or_else(|| "a whole number of bytes from 1 to 2^64 - 1, such as 512M or 2G".to_owned())
    }
}

words!(str::parse: Memory);

/// In the largest unit of which there is one.
impl fmt::Display for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (shift, unit) = match self.0 {
            1 => return f.write_str("1 byte"),
            0..0x400 => return write!(f, "{} bytes", self.0),
            0x400..0x10_0000 => (10, "KiB"),
            0x10_0000..0x4000_0000 => (20, "MiB"),
            _ => (30, "GiB"),
        };
        // Tenths, rounded up: what is told to be needed is enough.
        let tenths = (u128::from(self.0) * 10).div_ceil(1 << shift);
        write!(f, "{}.{} {unit}", tenths / 10, tenths % 10)
    }
}

/// The allowance of a run, and what it holds of that.
#[derive(Clone, Copy, Debug)]
struct Ledger {
    allowed: u64,
    held: u64,
    /// Whether the user said how much is allowed.
    said: bool,
}

thread_local! {
    /// That of the run on this thread, which asks for all of its memory. Without a run all is allowed.
    static LEDGER: Cell<Ledger> = const { Cell::new(Ledger { allowed: u64::MAX, held: 0, said: false }) };
}

/// Begins a run, which holds nothing yet. It may have so much, or else what the machine has.
pub(crate) fn begin(allowed: Option<Memory>) {
    let said = allowed.is_some();
    let allowed = allowed.map_or_else(of_machine, |Memory(bytes)| bytes);
    LEDGER.set(Ledger { allowed, held: 0, said });
}

/// Asks for bytes that are held until the run ends, for something with its article.
///
/// # Errors
/// There is not so much left.
pub(crate) fn hold(bytes: u64, what: impl fmt::Display) -> Result<(), Error> {
    need(bytes, what)?;
    let ledger = LEDGER.get();
    LEDGER.set(Ledger { held: ledger.held.saturating_add(bytes), ..ledger });
    Ok(())
}

/// Asks for bytes that are held for a while, beside those that are held until the run ends.
///
/// # Errors
/// There is not so much left.
pub(crate) fn need(bytes: u64, what: impl fmt::Display) -> Result<(), Error> {
    let Ledger { allowed, held, said } = LEDGER.get();
    if held.saturating_add(bytes) <= allowed {
        return Ok(());
    }
    let beside = if held > 0 { format!(" beside {}", Memory(held)) } else { String::new() };
    let who = if said { "as --memory says" } else { "which are free" };
    let found = format!("{what} that takes {} of memory{beside}", Memory(bytes));
    let error = Error::new(found, format!("at most {} in all, {who}", Memory(allowed)));
    Err(error.hint("make it smaller, or allow more with --memory"))
}

/// Does work after which nothing of what it asks for is held.
pub(crate) fn for_once<T>(work: impl FnOnce() -> T) -> T {
    let before = LEDGER.get();
    let result = work();
    LEDGER.set(before);
    result
}

/// The bytes that there are to ask for.
pub(crate) fn left() -> u64 {
    let Ledger { allowed, held, .. } = LEDGER.get();
    allowed.saturating_sub(held)
}

/// The memory that is free, as far as Linux tells: no more than the limits of this process and of its group.
fn of_machine() -> u64 {
    let machine = read("/proc/meminfo");
    let free = field(&machine, "MemAvailable:")
        .map(|free| free.saturating_add(field(&machine, "SwapFree:").unwrap_or(0)));
    // Allocators reserve more addresses than they use, and halves of lists are free.
    let space = addresses().map(|space| space / 2);
    let number = |file: &str| read(file).trim().parse::<u64>().ok();
    let group = number("/sys/fs/cgroup/memory.max").map(|most| {
        let used = number("/sys/fs/cgroup/memory.current").unwrap_or(0);
        most.saturating_sub(used)
    });
    [free, space, group].into_iter().flatten().min().unwrap_or(UNKNOWN)
}

/// The addresses that this process may still have, if they are limited.
pub(crate) fn addresses() -> Option<u64> {
    let limits = read("/proc/self/limits");
    let space = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let space: u64 = space.split_whitespace().next()?.parse().ok()?;
    Some(space.saturating_sub(field(&read("/proc/self/status"), "VmSize:").unwrap_or(0)))
}

fn read(file: &str) -> String {
    fs::read_to_string(file).unwrap_or_default()
}

/// The bytes of a field, which are in KiB.
fn field(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse::<u64>().ok()?.checked_mul(1 << 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_read_and_told() {
        for (text, bytes) in
            [("1", 1), ("9k", 9 << 10), ("512M", 512 << 20), ("512mb", 512 << 20), ("2GiB", 2 << 30)]
        {
            assert_eq!(text.parse(), Ok(Memory(bytes)), "{text}");
        }
        for text in ["", "0", "0G", "G", "-1", "+1", "1.5G", "2T", "99999999999G", "1 M", "é"] {
            assert!(text.parse::<Memory>().is_err(), "{text}");
        }
        let told = [5, 1 << 10, 1_048_577, 3 << 29].map(|bytes| Memory(bytes).to_string());
        assert_eq!(told, ["5 bytes", "1.0 KiB", "1.1 MiB", "1.5 GiB"]);
    }

    #[test]
    fn what_is_held_counts() {
        // Without a run.
        assert_eq!(need(u64::MAX, "a sky"), Ok(()));
        begin(Some(Memory(100)));
        assert_eq!((hold(60, "a map"), need(40, "a sky"), need(40, "a sky")), (Ok(()), Ok(()), Ok(())));
        let message = hold(41, "a sky").unwrap_err().to_string();
        assert_eq!(
            message,
            "found a sky that takes 41 bytes of memory beside 60 bytes, expected at most 100 bytes in all, as --memory \
             says; make it smaller, or allow more with --memory"
        );
        begin(Some(Memory(100)));
        assert_eq!(hold(100, "a sky"), Ok(()));
        assert!(need(1, "a star").is_err());
        assert_eq!(left(), 0);
        begin(None);
        assert_eq!(need(1, "a star"), Ok(()));
    }
}
