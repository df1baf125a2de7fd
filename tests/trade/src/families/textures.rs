//! Reading textures: filters, derivatives for levels of detail, and the way from coordinates to texels.

use super::perspective::{TEXELS, nearest, with};
use crate::frame::{mapped, wide};
use alberti::glam::Vec2;
use alberti::raster::{PerPixel, PerRun, PerTriangle};
use alberti::shaders::{Differentiated, Unlit};
use alberti::texture::{
    Anisotropic, BaseLevel, Bilinear, Clamp, Minify, MipFilter, Mipmap, Mirror, Nearest, NearestLevel,
    PowerOfTwo, Repeat, Texture, Trilinear, format::Rgba8888,
};
use alberti::{Exact, FragmentStage, Rgba8};
use alberti_trade::family::{Axis, Family};
use alberti_trade::row::Frame;
use alberti_trade::row::{Judge, Row};
use alberti_trade::scenes::{Scene, scene};

/// How a texel is made of several.
pub(super) const FILTERS: Family = Family {
    name: "filter",
    title: "Filters",
    advice: "\
The right picture here is the mean light of 64 rays a pixel, which a filter can only come near to. Magnified, take
`Bilinear`; squeezed, a mip map: `NearestLevel(Bilinear)` has most of what `Trilinear` has, at two thirds of its
price, but shows where levels change. `Anisotropic(2)` or `(4)` are sharper on what is seen at a flat angle. More
probes gain little here: they average bytes, not light, and the farther they reach, the more that shows as a darker
tone.",
    axis: Axis::Flip,
};

/// Where levels of detail come from.
pub(super) const DERIVATIVES: Family = Family {
    name: "derivatives",
    title: "Levels of detail",
    advice: "\
`PerPixel` on vector registers, where the others save little. On a small core `PerTriangle`, if triangles are small on
the screen: on a floor of two triangles one level for all is wrong nearly everywhere. `PerRun` lies between the two.
Without a mip map (`BaseLevel`) the distance shimmers. The right picture is that of `PerPixel`.",
    axis: Axis::Flip,
};

/// How coordinates come to texels.
pub(super) const ADDRESSES: Family = Family {
    name: "addresses",
    title: "Wrap modes and sides",
    advice: "\
All show the same; that is tested bit by bit. Give textures sides that are powers of two and say so
(`Texture::power_of_two`). `Known` sides are for textures that are part of a program on a small core.",
    axis: Axis::Flip,
};

/// A scene and the size of its picture.
type Sized = (&'static Scene, [u32; 2]);

fn frame(
    (scene, size): Sized,
    stage: impl FragmentStage<Vec2, Color = Rgba8> + 'static,
) -> ([u32; 2], Frame) {
    (size, wide(scene, mapped, stage, with(Exact, size)))
}

fn levels(scene: &'static Scene) -> Mipmap<'static, Rgba8888, PowerOfTwo> {
    let [width, height] = scene.sides();
    let levels = Mipmap::new(Rgba8888, &scene.levels, width, height).expect("a texture");
    levels.power_of_two().expect("sides that are powers of two")
}

fn base(scene: &'static Scene) -> Texture<'static, Rgba8888, PowerOfTwo> {
    let image = &scene.model.textures[0];
    let texture = Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture");
    texture.power_of_two().expect("sides that are powers of two")
}

pub(super) fn filters(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    fn mip(family: &'static str, name: &str, (scene, size): Sized, filter: impl MipFilter + 'static) -> Row {
        Row::new(
            family,
            name,
            scene,
            Judge::Area,
            frame((scene, size), Unlit(levels(scene).sampler(filter, Repeat))),
        )
    }
    let rows = ["near-flat", "minified", "floor"].map(scene).map(|scene| {
        let of = |name: &str, frame| Row::new(family, name, scene, Judge::Area, frame);
        let anisotropic = |probes| {
            mip(
                family,
                &format!("Anisotropic({probes})"),
                (scene, size),
                Anisotropic { probes, filter: Trilinear },
            )
        };
        [
            of("Nearest", frame((scene, size), nearest(scene))).as_reference(),
            of("Bilinear", frame((scene, size), Unlit(base(scene).sampler(Bilinear, Repeat)))),
            mip(
                family,
                "NearestLevel(Nearest)",
                (scene, size),
                Minify { min: NearestLevel(Nearest), mag: Nearest },
            ),
            mip(
                family,
                "NearestLevel(Bilinear)",
                (scene, size),
                Minify { min: NearestLevel(Bilinear), mag: Bilinear },
            ),
            mip(family, "Trilinear", (scene, size), Trilinear),
            anisotropic(2),
            anisotropic(4),
            anisotropic(8),
            anisotropic(16),
        ]
    });
    rows.into_iter().flatten().collect()
}

pub(super) fn derivatives(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    let rows = ["minified", "floor", "dense-mesh"].map(scene).map(|scene| {
        let of = |name: &str, frame| Row::new(family, name, scene, Judge::Reference, frame);
        let map = Unlit(levels(scene).sampler(Trilinear, Repeat));
        [
            of("PerPixel", frame((scene, size), Differentiated::by(PerPixel, map))).as_reference(),
            of("PerRun", frame((scene, size), Differentiated::by(PerRun, map))),
            of("PerTriangle", frame((scene, size), Differentiated::by(PerTriangle, map))),
            of(
                "none: BaseLevel",
                frame((scene, size), Unlit(levels(scene).sampler(BaseLevel(Bilinear), Repeat))),
            ),
        ]
    });
    rows.into_iter().flatten().collect()
}

pub(super) fn addresses(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    // Where coordinates are in 0..1 all modes give one picture.
    let rows = ["close-up"].map(scene).map(|scene| {
        let of = |name: &str, frame| Row::new(family, name, scene, Judge::Rays, frame);
        let image = &scene.model.textures[0];
        let any = Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture");
        let known = any.known::<TEXELS, TEXELS>().expect("sides that are known");
        [
            of("Repeat, PowerOfTwo", frame((scene, size), nearest(scene))).as_reference(),
            of("Repeat, Known", frame((scene, size), Unlit(known.sampler(Nearest, Repeat)))),
            of("Repeat, AnySize", frame((scene, size), Unlit(any.sampler(Nearest, Repeat)))),
            of("Clamp, PowerOfTwo", frame((scene, size), Unlit(base(scene).sampler(Nearest, Clamp)))),
            of("Mirror, PowerOfTwo", frame((scene, size), Unlit(base(scene).sampler(Nearest, Mirror)))),
        ]
    });
    rows.into_iter().flatten().collect()
}
