//! From vertices to pixels: perspective, and the numbers in which it is computed.

use crate::frame::{With, mapped, narrow, places, wide};
use alberti::shaders::Unlit;
use alberti::texture::{Nearest, PowerOfTwo, Repeat, Sampler, Texture, format::Rgba8888};
use alberti::{Affine, Exact, F32Reversed, FixedPoint, Interpolation, Lines, Planes, Spans16, Sub8};
use alberti_trade::family::{Axis, Family};
use alberti_trade::row::{Judge, Row};
use alberti_trade::scenes::{SIDE, Scene, scene};

/// Which way attributes take across a triangle.
pub(super) const PERSPECTIVE: Family = Family {
    name: "perspective",
    title: "Perspective",
    advice: "\
On a machine with vector registers take `Exact`, or `Lines::bounded` with the texels that it may miss: it draws each
triangle by a parabola, by straight lines, as `Planes` or as `Exact`, the first of these that keeps the budget, so it is
never dearer by more than the choice. `Planes` is as right until q falls steeply, and cheaper but on meshes of small
triangles, where it is a third dearer.
`Affine` is right where all of a triangle is equally far, and as wrong as the table says elsewhere: on a mesh of small
triangles by a fraction of a texel, on a floor by the whole texture. The 21 texels of `Exact` are at the horizon of that
floor, where a pixel covers tens of thousands. Runs of a fixed length, `Spans16` and its kin, promise nothing: steep
perspective breaks them. They are for cores on which a division is slow; what they cost there is told by
[kernel.md](kernel.md).",
    axis: Axis::Texels,
};

/// In which numbers.
pub(super) const NUMBERS: Family = Family {
    name: "numbers",
    title: "Numbers",
    advice: "\
On one sample at a time, as a core without vector registers works. Where there are no floats take `FixedPoint`: with
`Spans16` it takes two thirds of the instructions of `Exact` in floats and less than half of its time; a budget costs
about as much as those. It is as right as the lines that it draws, as long as coordinates are small. Its steps are
2^-16, so a texture that is repeated hundreds of times across a triangle, as on the floor, is tens of texels off at the
horizon. Divide such triangles.",
    axis: Axis::Texels,
};

const SCENES: [&str; 5] = ["near-flat", "floor", "close-up", "dense-mesh", "layers"];

/// Its first texture, read in the shortest way.
pub(super) fn nearest(
    scene: &'static Scene,
) -> Unlit<Sampler<'static, Rgba8888, Nearest, Repeat, Repeat, PowerOfTwo>> {
    let image = &scene.model.textures[0];
    let texture = Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture");
    Unlit(texture.power_of_two().expect("sides that are powers of two").sampler(Nearest, Repeat))
}

pub(super) fn with<P>(interpolation: P, size: [u32; 2]) -> With<P, F32Reversed> {
    With { interpolation, depth: F32Reversed, subpixel: Sub8, size }
}

/// A row of floats, as its type and for its texture coordinates as another that has the same bits.
fn float(
    family: &'static str,
    name: &str,
    (scene, size): (&'static Scene, [u32; 2]),
    interpolation: impl Interpolation,
    same: impl Interpolation,
) -> Row {
    let frame = wide(scene, mapped, nearest(scene), with(interpolation, size));
    Row::new(family, name, scene, Judge::Rays, (size, frame))
        .with_places(move || places(scene, with(same, size)))
}

fn fixed(
    family: &'static str,
    name: &str,
    (scene, size): (&'static Scene, [u32; 2]),
    interpolation: impl Interpolation,
    lines: Lines,
) -> Row {
    let frame = narrow(scene, mapped, nearest(scene), with(interpolation, size));
    let places = move || places(scene, with(FixedPoint(lines), size));
    Row::new(family, name, scene, Judge::Rays, (size, frame)).with_places(places)
}

fn spans(length: i32) -> Lines {
    Lines::spans(length).expect("a power of two")
}

fn bounded(scene: &Scene, texels: f32) -> Lines {
    let [width, height] = scene.sides();
    Lines::bounded_texels(texels, u16::try_from(width.max(height)).unwrap_or(u16::MAX))
}

pub(super) fn perspective(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    let rows = SCENES.map(scene).map(|scene| {
        let lines = |name: &str, lines: Lines| float(family, name, (scene, size), lines, lines);
        [
            float(family, "Exact", (scene, size), Exact, Exact).as_reference(),
            float(family, "Planes", (scene, size), Planes, Planes),
            lines("Lines::spans(4)", spans(4)),
            lines("Lines::spans(8)", spans(8)),
            float(family, "Spans16", (scene, size), Spans16, spans(16)),
            lines("Lines::spans(32)", spans(32)),
            lines("Lines::bounded(1/16)", bounded(scene, 1.0 / 16.0)),
            lines("Lines::bounded(1/4)", bounded(scene, 0.25)),
            lines("Lines::bounded(1)", bounded(scene, 1.0)),
            float(family, "Affine", (scene, size), Affine, Lines::affine()),
        ]
    });
    rows.into_iter().flatten().collect()
}

pub(super) fn numbers(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    let rows = SCENES.map(scene).map(|scene| {
        let sixteenth = bounded(scene, 1.0 / 16.0);
        [
            {
                let frame = narrow(scene, mapped, nearest(scene), with(Exact, size));
                Row::new(family, "f32, Exact", scene, Judge::Rays, (size, frame))
                    .with_places(move || places(scene, with(Exact, size)))
                    .as_reference()
            },
            {
                let frame = narrow(scene, mapped, nearest(scene), with(Spans16, size));
                Row::new(family, "f32, Spans16", scene, Judge::Rays, (size, frame))
                    .with_places(move || places(scene, with(spans(16), size)))
            },
            fixed(family, "FixedPoint(Spans16)", (scene, size), FixedPoint(Spans16), spans(16)),
            fixed(
                family,
                "FixedPoint(Lines::bounded(1/16))",
                (scene, size),
                FixedPoint(sixteenth),
                sixteenth,
            ),
            fixed(family, "FixedPoint(Affine)", (scene, size), FixedPoint(Affine), Lines::affine()),
        ]
    });
    rows.into_iter().flatten().collect()
}

/// Sides of all textures that are made here, for those that ask for a constant.
pub(super) const TEXELS: usize = SIDE as usize;
