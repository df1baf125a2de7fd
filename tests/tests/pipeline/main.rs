//! Tests of the pipeline across crates: vertices, clipping, coverage, bands and whole pictures. Each kernel is compiled
//! once for all that draw by it. A module's tests have its name: `cargo test -p alberti-tests bands::`.

mod afterwards;
mod bands;
mod clipping;
mod coverage;
mod displays;
mod drivers;
mod features;
mod frames;
mod golden;
mod handed_on;
mod hostile;
mod images;
mod invariance;
mod lanes;
mod lines;
mod parts;
mod resolution;
mod rows;
mod silhouettes;
mod small;
mod touched;
mod watertight;
mod windows;
