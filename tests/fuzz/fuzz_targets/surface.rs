//! The fuzz target `surface`.
#![no_main]

alberti_fuzz::program!(surface);
