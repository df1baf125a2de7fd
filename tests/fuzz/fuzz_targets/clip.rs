//! The fuzz target `clip`.
#![no_main]

alberti_fuzz::program!(clip);
