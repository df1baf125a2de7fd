//! The fuzz target `view`.
#![no_main]

alberti_fuzz::program!(view);
