#![no_std]
#![doc = include_str!("../README.md")]

#[cfg(test)]
extern crate std;

mod anisotropic;
mod blend;
mod coordinate;
pub mod environment;
mod filter;
pub mod format;
mod lod;
mod minify;
mod mip_sampler;
pub mod mipmap;
mod sampler;
mod sealed;
mod size;
pub mod srgb;
pub mod surface;
mod texture;
mod wrap;

pub use anisotropic::{Anisotropic, AnyMipFilter};
pub use filter::{AnyFilter, Bilinear, Filter, Nearest};
pub use format::TexelFormat;
pub use lod::{Derivatives, LodBounds, LodPolicy};
pub use minify::{BaseLevel, BetweenLevels, Levels, Minify, MipFilter, NearestLevel, Trilinear};
pub use mip_sampler::MipSampler;
pub use mipmap::Mipmap;
pub use sampler::Sampler;
pub use size::{AnySize, Known, LevelSize, PowerOfTwo, Size};
pub use texture::{Texture, TextureError};
pub use wrap::{AnyWrap, Border, Clamp, Mirror, Repeat, Wrap};
