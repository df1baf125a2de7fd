//! After the fragment: blends, and holes.

use super::perspective::{nearest, with};
use crate::frame::{colored, mapped};
use alberti::raster::color::{Bayer, Blended, BlueNoise, Constant, InLight, Over, Premultiplied};
use alberti::shaders::{AlphaDither, AlphaTest};
use alberti::{Exact, Rgba8888};
use alberti_trade::family::{Axis, Family};
use alberti_trade::row::{Judge, Row};
use alberti_trade::scenes::scene;

/// What becomes of a colour on its way into a pixel.
pub(super) const BLENDS: Family = Family {
    name: "blend",
    title: "Blends and holes",
    advice: "\
The prices of surfaces whose texels are opaque, so that all show the same: that is tested bit by bit. Take `Over`, or
`Premultiplied` for colours that are multiplied by their alpha already. `InLight` is right for light, by tables, one
sample after the other: for what is blended now and then. Holes by `AlphaTest` or `AlphaDither` need no order of the
triangles, and next to nothing.",
    axis: Axis::Flip,
};

pub(super) fn blends(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    let rows = ["near-flat", "layers"].map(scene).map(|scene| {
        macro_rules! row {
            ($name:literal, $format:expr, $stage:expr) => {{
                let frame = colored(scene, mapped, $stage, $format, with(Exact, size));
                Row::new(family, $name, scene, Judge::Reference, (size, frame))
            }};
        }
        let stage = nearest(scene);
        let format = Rgba8888;
        [
            row!("replace", format, stage).as_reference(),
            row!("Over", Blended { format, by: Over }, stage),
            row!("Constant(255)", Blended { format, by: Constant(255) }, stage),
            row!("Premultiplied", Blended { format, by: Premultiplied }, stage),
            row!("InLight(Over)", Blended { format, by: InLight(Over) }, stage),
            row!("AlphaTest", format, AlphaTest { surface: stage, least: 128 }),
            row!("AlphaDither(Bayer)", format, AlphaDither { surface: stage, by: Bayer }),
            row!("AlphaDither(BlueNoise)", format, AlphaDither { surface: stage, by: BlueNoise }),
        ]
    });
    rows.into_iter().flatten().collect()
}
