//! The faults of files.

use super::MAGIC;
use core::fmt;

/// The first fault of a file: where it is, what was found there, and what was expected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BakedError {
    /// The kind of fault.
    pub fault: Fault,
    /// The byte of the file where it is.
    pub offset: u32,
    /// The number that was found.
    pub found: u32,
    /// The number that was expected, or the limit.
    pub expected: u32,
}

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Fault {
    /// It does not begin with [`MAGIC`].
    Magic,
    /// It has another [`VERSION`](super::VERSION).
    Version,
    /// It has attributes that are not known, or lacks some that are asked for.
    Attributes,
    /// It is longer or shorter than it says.
    Length,
    /// There are more elements of a kind than the rest of the file has room for.
    Count,
    /// A number is not finite, or negative, or a unit that is 0.
    Number,
    /// The grid of a part's texture coordinates is too wide.
    Grid,
    /// A part or a meshlet reaches beyond what there is.
    Range,
    /// A triangle has a vertex that its part has not.
    Index,
    /// A part has a texture that is not there.
    Texture,
    /// A texture's format is not known.
    Format,
    /// A texture's palette and texels are not as many as its size takes, or not in the file.
    Texels,
}

impl fmt::Display for BakedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { fault, offset, found, expected } = *self;
        write!(f, "byte {offset} of a baked file: ")?;
        match fault {
            Fault::Magic => {
                let [found, expected] = [found.to_le_bytes(), MAGIC];
                write!(f, "found \"{}\", expected \"{}\"", found.escape_ascii(), expected.escape_ascii())
            }
            Fault::Version => write!(f, "found version {found}, expected {expected}"),
            Fault::Attributes => write!(f, "found attributes {found:#b}, expected {expected:#b}"),
            Fault::Length => write!(f, "found {found} bytes, expected {expected}"),
            Fault::Count => write!(f, "found {found} elements, expected at most {expected}"),
            Fault::Number => write!(f, "found {:e}, expected a finite number above 0", f32::from_bits(found)),
            Fault::Grid => write!(f, "found a grid of {found}, expected at most {expected}"),
            Fault::Range => write!(f, "found a range up to {found}, expected at most {expected}"),
            Fault::Index => write!(f, "found vertex {found}, expected one below {expected}"),
            Fault::Texture => write!(f, "found texture {found}, expected one below {expected}"),
            Fault::Format => write!(f, "found texels of format {found}, expected one from 1 to {expected}"),
            Fault::Texels => write!(f, "found {found} bytes of texels, expected {expected}"),
        }
    }
}

impl core::error::Error for BakedError {}
