//! The tests of accuracy, in one binary: `cargo test -p alberti-accuracy bounds::`.

mod barycentric;
mod bounds;
mod relations;
mod theory;
