//! The bodies of the fuzz targets: functions of any bytes, which panic where an invariant is broken.
//!
//! Each makes a case of its bytes ([`bits::Bits`]) and asserts more than that nothing panics: an answer of
//! `alberti-oracle`, or of the same work done in another way. `tests/fuzz` has the programs that libFuzzer drives;
//! `tests/replay.rs` here runs the same bodies over the corpora, so that what was found once is tried by every
//! `cargo test`.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "cases are made of bits; the bounds stand beside the code"
)]

mod app;
mod baked;
pub mod bits;
mod clip;
mod displacement;
mod mipmap;
mod numbers;
mod pipeline;
mod sampler;
mod surface;
mod triangle;
mod view;

/// A body.
pub type Body = fn(&[u8]);

macro_rules! targets {
    ($($name:ident: $body:path,)*) => {
        $(
            #[doc = concat!("The target `", stringify!($name), "`.")]
            pub fn $name(bytes: &[u8]) {
                $body(bytes);
            }
        )*

        /// All targets: the names of the programs and of the folders of corpora, and what they try.
        pub const TARGETS: &[(&str, Body)] = &[$((stringify!($name), $name)),*];
    };
}

targets! {
    numbers: numbers::run,
    view: view::run,
    clip: clip::run,
    triangle: triangle::run,
    pipeline: pipeline::run,
    sampler: sampler::run,
    mipmap: mipmap::run,
    surface: surface::run,
    displacement: displacement::run,
    baked: baked::run,
    obj: app::obj,
    mtl: app::mtl,
    scene: app::scene,
    image: app::image,
    options: app::options,
}

/// The cases of a target that are kept: a line of hexadecimal digits each.
///
/// # Errors
/// A line that is none.
pub fn cases(text: &str) -> Result<Vec<Vec<u8>>, String> {
    let case = |line: &str| -> Option<Vec<u8>> {
        let digits = line.as_bytes().chunks(2);
        digits
            .map(|pair| {
                u8::from_str_radix(std::str::from_utf8(pair).ok().filter(|pair| pair.len() == 2)?, 16).ok()
            })
            .collect()
    };
    let numbered = text.lines().zip(1..).filter(|(line, _)| !line.is_empty());
    numbered.map(|(line, number)| case(line).ok_or_else(|| format!("line {number} is no case"))).collect()
}
