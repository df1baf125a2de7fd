//! The fuzz target `triangle`.
#![no_main]

alberti_fuzz::program!(triangle);
