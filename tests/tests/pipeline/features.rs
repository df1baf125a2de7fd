//! Values in terms of other crates: each of the optional features `mint`, `bytemuck`, `serde`, `arbitrary` and `defmt`.

mod files;
mod fuzzers;
mod libraries;
mod logs;
