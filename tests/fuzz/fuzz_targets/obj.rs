//! The fuzz target `obj`.
#![no_main]

alberti_fuzz::program!(obj);
