//! The fuzz target `scene`.
#![no_main]

alberti_fuzz::program!(scene);
