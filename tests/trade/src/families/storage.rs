//! What is stored: positions in subpixels, and depths.

use super::perspective::nearest;
use crate::frame::{With, mapped, narrow, places, wide};
use alberti::{
    D16, D24, D32, DepthFormat, Exact, F32, F32Reversed, FixedPoint, Lines, NoDepth, Spans16, Sub4, Sub8,
    Subpixel,
};
use alberti_trade::family::{Axis, Family};
use alberti_trade::row::{Judge, Row};
use alberti_trade::scenes::{Scene, scene};

/// The grid of vertices.
pub(super) const SUBPIXELS: Family = Family {
    name: "subpixels",
    title: "Subpixels",
    advice: "\
Take `Sub8` unless a small core draws small triangles in fixed point, which `Sub4` was made for. The grid moves an
edge by up to 1/32 pixel then, and a texture in fixed point with it; in floats only small triangles move their
texture.",
    axis: Axis::Texels,
};

/// The depth buffer.
pub(super) const DEPTHS: Family = Family {
    name: "depth",
    title: "Depth formats",
    advice: "\
Take `F32Reversed` on a desktop: it is right at any ratio of the planes, and the cheapest together with `F32`. `D16`
is half the memory; between these planes, A = 0.02 and B = 2000, surfaces that cross are ragged.
`DepthMap::cheapest_drawn` tells which format a pair of planes needs. On vector registers integers make a frame that
does little else two thirds dearer in instructions and more than twice in time, since they are rounded correctly; in
fixed point they are a shift. Without a depth buffer the order of the
triangles decides.",
    axis: Axis::Flip,
};

pub(super) fn subpixels(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    let float = |name, scene: &'static Scene, subpixel: Subpixel| {
        let with = With { interpolation: Exact, depth: F32Reversed, subpixel, size };
        let frame = wide(scene, mapped, nearest(scene), with);
        Row::new(family, name, scene, Judge::Rays, (size, frame)).with_places(move || places(scene, with))
    };
    let fixed = |name, scene: &'static Scene, subpixel: Subpixel| {
        let with = With { interpolation: FixedPoint(Spans16), depth: F32Reversed, subpixel, size };
        let frame = narrow(scene, mapped, nearest(scene), with);
        let lines = Lines::spans(16).expect("a power of two");
        let with = With { interpolation: FixedPoint(lines), depth: F32Reversed, subpixel, size };
        Row::new(family, name, scene, Judge::Rays, (size, frame)).with_places(move || places(scene, with))
    };
    let rows = ["near-flat", "floor", "dense-mesh"].map(scene).map(|scene| {
        [
            float("Exact, Sub8", scene, Sub8).as_reference(),
            float("Exact, Sub4", scene, Sub4),
            fixed("FixedPoint(Spans16), Sub8", scene, Sub8),
            fixed("FixedPoint(Spans16), Sub4", scene, Sub4),
        ]
    });
    rows.into_iter().flatten().collect()
}

pub(super) fn depths(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    fn row(
        family: &'static str,
        name: &str,
        (scene, size): (&'static Scene, [u32; 2]),
        depth: impl DepthFormat + 'static,
    ) -> Row {
        let with = With { interpolation: Exact, depth, subpixel: Sub8, size };
        Row::new(family, name, scene, Judge::Rays, (size, wide(scene, mapped, nearest(scene), with)))
    }
    let rows = ["layers", "dense-mesh"].map(scene).map(|scene| {
        [
            row(family, "F32Reversed", (scene, size), F32Reversed).as_reference(),
            row(family, "F32", (scene, size), F32),
            row(family, "D32", (scene, size), D32),
            row(family, "D24", (scene, size), D24),
            row(family, "D16", (scene, size), D16),
            row(family, "NoDepth", (scene, size), NoDepth),
        ]
    });
    rows.into_iter().flatten().collect()
}
