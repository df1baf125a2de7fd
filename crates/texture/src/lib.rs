#![no_std]
#![doc = include_str!("../README.md")]

#[cfg(test)]
extern crate std;

mod blend;
mod coordinate;
mod filter;
pub mod format;
mod sampler;
mod size;
pub mod surface;
mod texture;
mod wrap;

pub use filter::{Bilinear, Filter, Nearest};
pub use format::TexelFormat;
pub use sampler::Sampler;
pub use size::{AnySize, Known, PowerOfTwo, Size};
pub use texture::{Texture, TextureError};
pub use wrap::{Border, Clamp, Mirror, Repeat, Wrap};
