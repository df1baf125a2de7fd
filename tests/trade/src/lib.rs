//! What each approximation costs and what it loses: every policy of every family on the same scenes, its pictures
//! beside those of rays in `f64`, its time beside that of the family's reference. `docs/trade.md` is made by it.

pub mod families;
pub mod frame;
pub mod reference;
pub mod row;
pub mod scenes;
