#![no_std]
#![doc = include_str!("../README.md")]

mod color;

pub use color::Rgba8;
