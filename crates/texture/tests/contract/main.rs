//! What the crate promises, against answers that are found another way: exact integers and real numbers instead
//! of fixed point, definitions instead of shortcuts.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "small integers to floats and back, and coordinates that may be rounded"
)]

mod anisotropic;
mod any;
mod bilinear;
mod border;
mod bounds;
mod hostile;
mod lod;
mod minify;
mod mipmap;
mod nearest;
mod oracle;
mod texture;
mod together;
mod wrap;
