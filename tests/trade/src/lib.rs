//! What each approximation costs and what it loses: every policy of every family on the same scenes, its pictures
//! beside those of rays in `f64`, its time beside that of the family's reference. `docs/trade.md` is made by it.

pub mod counts;
pub mod errors;
pub mod families;
pub mod frame;
pub mod page;
pub mod plot;
pub mod reference;
pub mod row;
pub mod scenes;
pub mod summary;
pub mod table;
pub mod times;
pub mod worst;
