//! The fuzz target `baked`.
#![no_main]

alberti_fuzz::program!(baked);
