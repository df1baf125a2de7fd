//! The fuzz target `mipmap`.
#![no_main]

alberti_fuzz::program!(mipmap);
