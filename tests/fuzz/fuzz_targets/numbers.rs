//! The fuzz target `numbers`.
#![no_main]

alberti_fuzz::program!(numbers);
