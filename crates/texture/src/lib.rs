#![no_std]
#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(test, feature = "arbitrary"))]
extern crate std;

mod anisotropic;
mod blend;
mod bounded;
mod coordinate;
pub mod environment;
mod filter;
pub mod format;
mod leveled;
mod minify;
mod mip_sampler;
pub mod mipmap;
#[cfg(any(feature = "serde", feature = "arbitrary", feature = "defmt"))]
mod named;
mod packed;
mod sampler;
mod sealed;
mod size;
pub mod surface;
mod texture;
mod wrap;

pub use alberti_math::Gradient;
pub use alberti_math::srgb;
pub use anisotropic::{Anisotropic, AnyMipFilter, Probes};
pub use bounded::{Bounded, LodBounds};
pub use filter::{AnyFilter, Bilinear, Filter, Nearest};
pub use format::TexelFormat;
pub use leveled::{Leveled, Levels};
pub use minify::{BaseLevel, BetweenLevels, Minify, MipFilter, NearestLevel, Trilinear};
pub use mip_sampler::MipSampler;
pub use mipmap::Mipmap;
pub use packed::Packed;
pub use sampler::Sampler;
pub use size::{AnySize, Known, PowerOfTwo, Size};
pub use texture::{Texture, TextureError};
pub use wrap::{AnyWrap, Border, Clamp, Mirror, Repeat, Wrap};
