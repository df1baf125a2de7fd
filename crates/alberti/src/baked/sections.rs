//! Numbers and arrays in bytes.

use super::count;
use super::error::{BakedError, Fault};

/// A walk over the sections of a file.
pub(super) struct Sections<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Sections<'a> {
    /// The next section, of so many elements. The first number is where the header has theirs.
    pub(super) fn take<const N: usize>(
        &mut self,
        (stated, elements): (usize, u32),
    ) -> Result<&'a [[u8; N]], BakedError> {
        let length = (elements as usize).checked_mul(N);
        let end = length.and_then(|length| self.at.checked_add(length));
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        match end.and_then(|end| self.bytes.get(self.at..end).map(|section| (section, end))) {
            Some((section, end)) => {
                self.at = end;
                Ok(section.as_chunks().0)
            }
            None => Err(BakedError {
                fault: Fault::Count,
                offset: count(stated),
                found: elements,
                expected: count(rest.len() / N),
            }),
        }
    }
}

/// `N` bytes from a place on; zeros beyond the end.
#[inline(always)]
fn bytes<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    bytes.get(at..).and_then(|rest| rest.first_chunk()).copied().unwrap_or([0; N])
}

/// Two bytes as a number.
#[inline(always)]
pub(super) fn half(of: &[u8], at: usize) -> u16 {
    u16::from_le_bytes(bytes(of, at))
}

/// Four bytes as a number.
#[inline(always)]
pub(super) fn word(of: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes(of, at))
}

/// Four bytes as a float.
#[inline(always)]
pub(super) fn float(of: &[u8], at: usize) -> f32 {
    f32::from_le_bytes(bytes(of, at))
}
