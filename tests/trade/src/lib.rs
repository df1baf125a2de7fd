//! Every policy of every family on the same scenes, as frames that can be drawn, timed and judged.
//!
//! The program of this package measures what each costs and what it loses, and makes `docs/trade.md`. It is apart from
//! the kernels, which take long to compile.

pub mod families;
pub mod frame;
pub mod row;
pub mod scenes;
