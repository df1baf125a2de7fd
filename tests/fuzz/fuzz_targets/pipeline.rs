//! The fuzz target `pipeline`.
#![no_main]

alberti_fuzz::program!(pipeline);
