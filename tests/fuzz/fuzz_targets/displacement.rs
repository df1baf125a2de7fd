//! The fuzz target `displacement`.
#![no_main]

alberti_fuzz::program!(displacement);
