//! Tests of what fragments read and how they are lit, across crates. A module's tests have its name: `cargo test -p
//! alberti-tests materials::`.

mod gradients;
mod level_of_detail;
mod material_draws;
mod materials;
mod minification;
mod projector;
mod reliefs;
