//! The fuzz target `options`.
#![no_main]

alberti_fuzz::program!(options);
