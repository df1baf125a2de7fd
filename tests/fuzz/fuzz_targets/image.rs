//! The fuzz target `image`.
#![no_main]

alberti_fuzz::program!(image);
