//! The ways of drawing that are measured: each is one call of [`alberti::draw`] on prepared memory.

use crate::shapes::{FLOOR_MIPMAP, Model, Vertex};
use crate::{Camera, PIXELS, Target, WIDTH};
use alberti::glam::{Vec2, Vec3};
use alberti::raster::{PerSpan, PerTriangle};
use alberti::shaders::material::{Color, Emission, Gouraud};
use alberti::shaders::{Differentiated, Ready565, Solid, Stored, Unlit, VertexColor565};
use alberti::texture::{Bilinear, Minify, Nearest, NearestLevel, Repeat, Trilinear};
use alberti::{
    Affine, Band, Counters, Cull, D16, Exact, FixedPoint, FragmentStage, Interpolation, NoDepth, Object,
    Pass, Point3, Rgb565Le, Sides, Slot, Spans, Sub4, VertexStage, View, draw,
};

/// Defines ways of drawing: a pass of its own for each, into colour and depth.
macro_rules! draws {
    ($($(#[$doc:meta])* $name:ident($model:ident): $interpolation:expr, $vertex_stage:expr, $fragment_stage:expr;)*) => {$(
        $(#[$doc])*
        pub fn $name<K: Counters>(target: &mut Target, camera: &Camera, $model: &Model, counters: &mut K) {
            let pass = pass(camera, $model, $interpolation, $vertex_stage, $fragment_stage);
            let Ok(mut band) = Band::<Rgb565Le, D16>::new(WIDTH, 0, &mut target.color, &mut target.depth) else {
                return;
            };
            draw(&pass, &mut band, &mut [Slot::<Sub4, _>::EMPTY; 0], counters);
        }
    )*};
}

draws! {
    /// One colour for all.
    flat(model): Exact, |v: &Vertex| (place(v), ()), Solid(ORANGE);

    /// The vertices' colours, in perspective.
    gouraud(model): Exact, colored, VertexColor565;

    /// One colour for all, in fixed point.
    flat_fixed(model): FixedPoint(Affine), |v: &Vertex| (place(v), ()), Solid(ORANGE);

    /// The vertices' colours without perspective, in fixed point.
    gouraud_fixed(model): FixedPoint(Affine), colored, VertexColor565;

    /// The nearest texel of the nearest level, one for each triangle.
    mip_nearest(model): Exact, mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler::<NearestMip, Repeat>()));

    /// Four texels of the nearest level, one for each triangle.
    mip_bilinear(model): Exact, mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler::<BilinearMip, Repeat>()));

    /// Between levels, by one level of detail for each triangle.
    trilinear(model): Exact, mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler::<Trilinear, Repeat>()));

    /// Between levels, by one level of detail for each row of a triangle.
    trilinear_spans(model): Exact, mapped,
        Differentiated::by(PerSpan, Unlit(FLOOR_MIPMAP.sampler::<Trilinear, Repeat>()));

    /// The nearest texel of the nearest level, one for each triangle, in fixed point.
    mip_nearest_fixed(model): FixedPoint(Spans::<16>), mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler::<NearestMip, Repeat>()));

    /// Four texels of the nearest level, one for each triangle, in fixed point.
    mip_bilinear_fixed(model): FixedPoint(Spans::<16>), mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler::<BilinearMip, Repeat>()));

    /// Between levels, by one level of detail for each triangle, in fixed point.
    trilinear_fixed(model): FixedPoint(Spans::<16>), mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler::<Trilinear, Repeat>()));

    /// Between levels, by one level of detail for each 16 columns, in fixed point.
    trilinear_spans_fixed(model): FixedPoint(Spans::<16>), mapped,
        Differentiated::by(PerSpan, Unlit(FLOOR_MIPMAP.sampler::<Trilinear, Repeat>()));

    /// The vertices' light on the nearest texel: a material of one map.
    material(model): Exact, lit, Gouraud { layers: Color(model.texture.sampler::<Nearest, Repeat>()) };

    /// The same, with the places of the maps that it has not.
    material_absent(model): Exact, lit, Gouraud {
        layers: ((), Color(model.texture.sampler::<Nearest, Repeat>()), (), ((), ()), ()),
    };

    /// And with one more.
    material_emission(model): Exact, lit, Gouraud {
        layers: (
            Color(model.texture.sampler::<Nearest, Repeat>()),
            Emission(model.texture.sampler::<Nearest, Repeat>()),
        ),
    };

    /// The nearest texel without perspective, in fixed point.
    affine_fixed(model): FixedPoint(Affine), mapped, Stored(model.texture.sampler::<Nearest, Repeat>());
}

/// The nearest texel, in perspective, with depth. Each vertex has a slot of its own.
pub fn textured<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(Exact, target, camera, model, counters);
}

/// The same in fixed point, divided every 16 columns.
pub fn textured_fixed<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(FixedPoint(Spans::<16>), target, camera, model, counters);
}

#[inline]
fn textured_by<P: Interpolation, K: Counters>(
    interpolation: P,
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let sampler = model.texture.sampler::<Nearest, Repeat>();
    let pass = pass(camera, model, interpolation, mapped, Stored(sampler));
    let Ok(mut band) = Band::<Rgb565Le, D16>::new(WIDTH, 0, &mut target.color, &mut target.depth) else {
        return;
    };
    let slots = target.slots.get_mut(..model.vertices.len()).unwrap_or_default();
    draw(&pass, &mut band, slots, counters);
}

/// One colour for all, without depth: later triangles cover earlier ones.
pub fn flat_without_depth<K: Counters>(
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let pass = pass(camera, model, Exact, |v: &Vertex| (place(v), ()), Solid(ORANGE));
    let mut nothing = [(); PIXELS];
    let Ok(mut band) = Band::<Rgb565Le, NoDepth>::new(WIDTH, 0, &mut target.color, &mut nothing) else {
        return;
    };
    draw(&pass, &mut band, &mut [Slot::<Sub4, _>::EMPTY; 0], counters);
}

type NearestMip = Minify<Nearest, NearestLevel>;
type BilinearMip = Minify<Bilinear, NearestLevel>;

const ORANGE: u16 = 0xe405;

/// What all ways have in common.
#[inline]
fn pass<P: Interpolation, Vs: VertexStage<Vertex>, Fs: FragmentStage<Vs::Varying>>(
    camera: &Camera,
    model: &Model,
    interpolation: P,
    vertex_stage: Vs,
    fragment_stage: Fs,
) -> Pass<'static, Vertex, u16, Vs, Fs, P> {
    Pass {
        view: View { to_eye: model.to_eye, projection: camera.perspective, viewport: camera.viewport },
        vertices: model.vertices,
        triangles: model.triangles,
        vertex_stage,
        fragment_stage,
        cull: Cull::Back,
        sides: Sides::GuardBand,
        interpolation,
    }
}

fn place(vertex: &Vertex) -> Point3<Object> {
    Point3::new(Vec3::from_array(vertex.position))
}

fn colored(vertex: &Vertex) -> (Point3<Object>, Ready565) {
    (place(vertex), Ready565::new(Vec3::from_array(vertex.color)))
}

fn mapped(vertex: &Vertex) -> (Point3<Object>, Vec2) {
    (place(vertex), Vec2::from_array(vertex.uv))
}

/// The vertex's colour for the light that is scattered, and none that is mirrored.
fn lit(vertex: &Vertex) -> (Point3<Object>, (Vec3, (Vec3, Vec2))) {
    let (position, uv) = mapped(vertex);
    (position, (Vec3::from_array(vertex.color), (Vec3::ZERO, uv)))
}
