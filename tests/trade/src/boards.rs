//! The policies' prices on microcontrollers, which emulators count.

mod fit;
pub mod model;
pub mod page;
pub mod price;
pub mod scene_file;
pub mod table;
