//! What is stored: positions in subpixels, and depths.

use super::Family;
use super::perspective::nearest;
use crate::frame::{With, mapped, narrow, places, wide};
use crate::row::{Judge, Row};
use crate::scenes::{Scene, scene};
use alberti::{D16, D24, D32, DepthFormat, Exact, F32, F32Reversed, FixedPoint, Lines, NoDepth, Spans16, Sub4, Sub8, Subpixel};

/// The grid of vertices.
pub(super) const SUBPIXELS: Family =
    Family { name: "subpixels", title: "Subpixels", advice: "", rows: subpixels };

/// The depth buffer.
pub(super) const DEPTHS: Family = Family { name: "depth", title: "Depth formats", advice: "", rows: depths };

fn subpixels(family: &'static str) -> Vec<Row> {
    let float = |name, scene: &'static Scene, subpixel: Subpixel| {
        let with = With { interpolation: Exact, depth: F32Reversed, subpixel };
        let frame = wide(scene, mapped, nearest(scene), with);
        Row::new(family, name, scene, Judge::Rays, frame).with_places(move || places(scene, with))
    };
    let fixed = |name, scene: &'static Scene, subpixel: Subpixel| {
        let with = With { interpolation: FixedPoint(Spans16), depth: F32Reversed, subpixel };
        let frame = narrow(scene, mapped, nearest(scene), with);
        let lines = Lines::spans(16).expect("a power of two");
        let with = With { interpolation: FixedPoint(lines), depth: F32Reversed, subpixel };
        Row::new(family, name, scene, Judge::Rays, frame).with_places(move || places(scene, with))
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

fn depths(family: &'static str) -> Vec<Row> {
    fn row(family: &'static str, name: &str, scene: &'static Scene, depth: impl DepthFormat + 'static) -> Row {
        let with = With { interpolation: Exact, depth, subpixel: Sub8 };
        Row::new(family, name, scene, Judge::Rays, wide(scene, mapped, nearest(scene), with))
    }
    let rows = ["layers", "dense-mesh"].map(scene).map(|scene| {
        [
            row(family, "F32Reversed", scene, F32Reversed).as_reference(),
            row(family, "F32", scene, F32),
            row(family, "D32", scene, D32),
            row(family, "D24", scene, D24),
            row(family, "D16", scene, D16),
            row(family, "NoDepth", scene, NoDepth),
        ]
    });
    rows.into_iter().flatten().collect()
}
