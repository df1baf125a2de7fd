//! All tests across crates, but for those of surfaces, in one binary: each kernel is compiled once for all that draw by
//! it. A module's tests have its name: `cargo test -p alberti-tests bands::`.

mod attributes;
mod bands;
mod clipping;
mod coverage;
mod depth;
mod frames;
mod golden;
mod hostile;
mod images;
mod invariance;
mod lanes;
mod modes;
mod parallel;
mod pictures;
mod policies;
mod profiles;
mod resolution;
mod small;
mod values;
mod watertight;
