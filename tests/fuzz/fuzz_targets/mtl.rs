//! The fuzz target `mtl`.
#![no_main]

alberti_fuzz::program!(mtl);
