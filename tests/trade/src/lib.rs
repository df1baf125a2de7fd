//! What each approximation costs and what it loses: scenes, references and times, errors and counts, and the page that
//! they make, `docs/trade.md`.
//!
//! The frames of all policies are in the program of this package, apart from what has tests: they take long to compile.

pub mod advice;
pub mod boards;
pub mod calibration;
pub mod counts;
pub mod errors;
pub mod family;
pub mod page;
pub mod plot;
pub mod reference;
pub mod row;
pub mod scenes;
pub mod summary;
pub mod table;
pub mod times;
pub mod worst;
