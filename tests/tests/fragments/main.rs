//! Tests of fragments across crates: how their components go over a triangle, what their depths are compared with, what
//! they read, and how they are lit. A module's tests have its name: `cargo test -p alberti-tests materials::`.

mod afterwards;
mod attributes;
mod budget;
mod depth;
mod divisions;
mod gradients;
mod level_of_detail;
mod limits;
mod material_draws;
mod materials;
mod minification;
mod modes;
mod parallel;
mod planes;
mod policies;
mod profiles;
mod projector;
mod reliefs;
mod texel_dither;
mod threads;
mod unsnapped;
mod unsound;
mod values;
