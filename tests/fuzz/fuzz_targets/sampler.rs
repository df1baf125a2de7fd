//! The fuzz target `sampler`.
#![no_main]

alberti_fuzz::program!(sampler);
