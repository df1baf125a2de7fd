//! The ways of drawing that are measured: each is one call of [`alberti::draw`] on prepared memory.

use crate::shapes::{CHEQUER_PAIRS, GLASS, Model, TEXTURE};
use crate::torus::{HalfWords, TORUS_VERTICES, Vertex};
use crate::{Camera, HEIGHT, PIXELS, Target, WIDTH};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Lanes, One};
use alberti::raster::Fragments;
use alberti::raster::color::{Additive, Blended, Constant, Over};
use alberti::shaders::material::{Color, Emission, Gouraud};
use alberti::shaders::{Ready565, Solid, Stored, StoredAlpha, TexelDither, Unlit, VertexColor565};
use alberti::texture::{Bilinear, Nearest, Repeat};
use alberti::{
    Affine, ColorFormat, Counters, D16, DepthFormat, Exact, FixedPoint, FragmentStage, Geometry, IntegerMesh,
    IntegerVertex, Interpolation, Lines, Mesh, Meshlets, NoDepth, Object, Pass, Planes, Point3, Q16,
    Rgb565Le, Rgba8, Slot, Spans16, Sub4, Sub8, Varying, View,
};

/// Defines ways of drawing: a pass of its own for each, into colour and depth.
macro_rules! draws {
    ($($(#[$doc:meta])* $name:ident($model:ident): $interpolation:expr, $vertex_stage:expr, $stage:expr;)*) => {$(
        $(#[$doc])*
        pub fn $name<K: Counters>(target: &mut Target, camera: &Camera, $model: &Model, counters: &mut K) {
            let mesh = Mesh::new($model.vertices, $model.triangles, $vertex_stage);
            $crate::draws::draw(
                target.with_depth(), camera, $model, &mesh, $stage, $interpolation, &mut [], counters,
            );
        }
    )*};
}

pub(crate) use draws;

draws! {
    /// One colour for all.
    flat(model): Exact, |v: &Vertex| (place(v), ()), Solid(ORANGE);

    /// The vertices' colours, in perspective.
    gouraud(model): Exact, colored, VertexColor565;

    /// One colour for all, in fixed point.
    flat_fixed(model): FixedPoint(Affine), |v: &Vertex| (place(v), ()), Solid(ORANGE);

    /// The vertices' colours without perspective, in fixed point.
    gouraud_fixed(model): FixedPoint(Affine), colored, VertexColor565;

    /// The vertices' light on the nearest texel: a material of one map.
    material(model): Exact, lit, Gouraud { layers: Color(TEXTURE.sampler(Nearest, Repeat)) };

    /// The same, with the places of the maps that it has not.
    material_absent(model): Exact, lit, Gouraud {
        layers: ((), Color(TEXTURE.sampler(Nearest, Repeat)), (), ((), ()), ()),
    };

    /// And with one more.
    material_emission(model): Exact, lit, Gouraud {
        layers: (
            Color(TEXTURE.sampler(Nearest, Repeat)),
            Emission(TEXTURE.sampler(Nearest, Repeat)),
        ),
    };

    /// The nearest texel without perspective, in fixed point.
    affine_fixed(model): FixedPoint(Affine), mapped, Stored(TEXTURE.sampler(Nearest, Repeat));

    /// One of four texels, by the place of the pixel, without perspective, in fixed point.
    dithered_affine_fixed(model): FixedPoint(Affine), mapped,
        TexelDither(TEXTURE.sampler(Bilinear, Repeat));

    /// Four texels in two pairs without perspective, in fixed point.
    pairs_affine_fixed(model): FixedPoint(Affine), mapped, Stored(CHEQUER_PAIRS.sampler(Bilinear, Repeat));

    /// The same as a colour of 8 bits a channel, with an alpha that is not used.
    glass_fixed(model): FixedPoint(Affine), mapped, glass();
}

/// Defines ways of drawing that mix with what is there, without perspective, in fixed point.
macro_rules! blends {
    ($($(#[$doc:meta])* $name:ident($model:ident): $blend:expr, $stage:expr;)*) => {$(
        $(#[$doc])*
        pub fn $name<K: Counters>(target: &mut Target, camera: &Camera, $model: &Model, counters: &mut K) {
            let mesh = Mesh::new($model.vertices, $model.triangles, mapped);
            let Ok(mut pixels) = target.with_depth() else { return };
            let pixels = pixels.with_color(Blended { format: Rgb565Le, by: $blend });
            draw(Ok(pixels), camera, $model, &mesh, $stage, FixedPoint(Affine), &mut [], counters);
        }
    )*};
}

blends! {
    /// The nearest texel, as opaque as 100/255.
    constant_fixed(model): Constant(100), Stored(TEXTURE.sampler(Nearest, Repeat));

    /// The nearest texel, as opaque as it is green.
    over_fixed(model): Over, glass();

    /// The nearest texel, as opaque as it is green, of words for this.
    over_stored_fixed(model): Over, StoredAlpha(GLASS.sampler(Nearest, Repeat));

    /// The nearest texel as light.
    additive_fixed(model): Additive, glass();
}

/// The nearest texel as a colour of 8 bits a channel, as opaque as it is green.
#[inline]
pub(crate) fn glass() -> impl FragmentStage<Vec2, Color = Rgba8> {
    Glass(Unlit(TEXTURE.sampler(Nearest, Repeat)))
}

/// Colours that are as opaque as they are green.
#[derive(Clone, Copy, Debug)]
struct Glass<S>(S);

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> FragmentStage<V> for Glass<S> {
    type Color = Rgba8;
    type Derivatives = S::Derivatives;
    const WIDE: bool = S::WIDE;

    #[inline(always)]
    fn derivatives(&self) -> S::Derivatives {
        self.0.derivatives()
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        let lanes = fragments.lanes;
        let (colors, mask) = self.0.shade(fragments);
        let alpha = lanes.shl(lanes.shr(colors, 8), 24);
        (colors & lanes.word(0x00ff_ffff) | alpha, mask)
    }
}

/// Defines ways of drawing a mesh, each of whose vertices has a slot of its own, without perspective, in fixed point.
macro_rules! meshes {
    ($($(#[$doc:meta])* $name:ident($model:ident) in $slots:ident: $mesh:expr, $stage:expr;)*) => {$(
        $(#[$doc])*
        pub fn $name<K: Counters>(target: &mut Target, camera: &Camera, $model: &Model, counters: &mut K) {
            let mesh = $mesh;
            let Target { color, depth, slots, .. } = target;
            let pixels = alberti::Target::new(Rgb565Le, D16, WIDTH, HEIGHT, color, depth);
            draw(pixels, camera, $model, &mesh, $stage, FixedPoint(Affine), &mut slots.$slots, counters);
        }
    )*};
}

pub(crate) use meshes;

meshes! {
    /// One colour for all.
    flat_mesh(model) in bare: Mesh::new(model.vertices, model.triangles, |v| (place(v), ())), Solid(ORANGE);

    /// The vertices' colours.
    gouraud_mesh(model) in colored: Mesh::new(model.vertices, model.triangles, colored), VertexColor565;

    /// The nearest texel.
    affine_mesh(model) in mapped: Mesh::new(model.vertices, model.triangles, mapped),
        Stored(TEXTURE.sampler(Nearest, Repeat));

    /// One colour for all, on a mesh of integers.
    flat_integers(model) in bare: integers(model, |v| IntegerVertex::<()> { place: v.position, components: () }),
        Solid(ORANGE);

    /// The nearest texel on a mesh of integers.
    affine_integers(model) in mapped: integers(model, mapped_integers),
        Stored(TEXTURE.sampler(Nearest, Repeat));

    /// One colour for all, on a mesh of integers with meshlets.
    flat_meshlets(model) in bare:
        meshlets(model, |v| IntegerVertex::<()> { place: v.position, components: () }), Solid(ORANGE);

    /// The vertices' colours on a mesh of integers with meshlets.
    gouraud_meshlets(model) in colored: meshlets(model, colored_integers), VertexColor565;

    /// The nearest texel on a mesh of integers with meshlets.
    affine_meshlets(model) in mapped: meshlets(model, mapped_integers),
        Stored(TEXTURE.sampler(Nearest, Repeat));
}

/// The nearest texel on a mesh, on the finer grid.
pub fn affine_mesh_sub8<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let mesh = Mesh::new(model.vertices, model.triangles, mapped);
    let view = View::new(model.to_eye, camera.perspective);
    let Target { color, depth, slots, .. } = target;
    if let Ok(mut pixels) = alberti::Target::new(Rgb565Le, D16, WIDTH, HEIGHT, color, depth) {
        let pass = Pass::new(&view, &mesh, Stored(TEXTURE.sampler(Nearest, Repeat)));
        let mut pass = pass.interpolation(FixedPoint(Affine)).subpixel(Sub8).slots(&mut slots.mapped);
        pass.count_by(One, &mut pixels, counters);
    }
}

/// The nearest texel, in perspective, with depth. Each vertex has a slot of its own.
pub fn textured<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(Exact, target, camera, model, counters);
}

/// The same without perspective.
pub fn textured_affine<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(Affine, target, camera, model, counters);
}

/// The same, divided every 16 columns.
pub fn textured_spans<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(Spans16, target, camera, model, counters);
}

/// The same in fixed point, as seldom divided as a quarter of a texel allows.
pub fn textured_bounded<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(FixedPoint(QUARTER_TEXEL), target, camera, model, counters);
}

/// The same from plane equations.
pub fn textured_planes<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(Planes, target, camera, model, counters);
}

/// The same in fixed point, divided every 16 columns.
pub fn textured_fixed<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    textured_by(FixedPoint(Spans16), target, camera, model, counters);
}

#[inline]
fn textured_by<P: Interpolation, K: Counters>(
    interpolation: P,
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let stage = Stored(TEXTURE.sampler(Nearest, Repeat));
    mapped_by(interpolation, stage, target, camera, model, counters);
}

/// Four texels by colours of 8 bits a channel, in fixed point.
pub fn bilinear_fixed<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let stage = Unlit(TEXTURE.sampler(Bilinear, Repeat));
    mapped_by(FixedPoint(Spans16), stage, target, camera, model, counters);
}

/// Four texels as they are stored, in fixed point.
pub fn bilinear_stored_fixed<K: Counters>(
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let stage = Stored(TEXTURE.sampler(Bilinear, Repeat));
    mapped_by(FixedPoint(Spans16), stage, target, camera, model, counters);
}

/// Four texels in two pairs, in fixed point.
pub fn bilinear_pairs_fixed<K: Counters>(
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let stage = Stored(CHEQUER_PAIRS.sampler(Bilinear, Repeat));
    mapped_by(FixedPoint(Spans16), stage, target, camera, model, counters);
}

#[inline]
pub(crate) fn mapped_by<F: FragmentStage<Vec2>, P: Interpolation, K: Counters>(
    interpolation: P,
    stage: F,
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let mesh = Mesh::new(model.vertices, model.triangles, mapped);
    let Target { color, depth, slots, .. } = target;
    let pixels = alberti::Target::new(Rgb565Le, D16, WIDTH, HEIGHT, color, depth);
    let slots = slots.mapped.get_mut(..model.vertices.len()).unwrap_or_default();
    draw(pixels, camera, model, &mesh, stage, interpolation, slots, counters);
}

/// The same of a mesh of integers with meshlets.
pub fn textured_meshlets<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let stage = Stored(TEXTURE.sampler(Nearest, Repeat));
    let mesh = meshlets(model, mapped_integers);
    let Target { color, depth, slots, .. } = target;
    let pixels = alberti::Target::new(Rgb565Le, D16, WIDTH, HEIGHT, color, depth);
    draw(pixels, camera, model, &mesh, stage, FixedPoint(Spans16), &mut slots.mapped, counters);
}

/// The nearest texel in 15 bands of 16 rows. They lie one after the other, so that together they are the whole frame.
pub fn textured_bands<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let mesh = Mesh::new(model.vertices, model.triangles, mapped);
    bands(FixedPoint(Spans16), target, camera, model, &mesh, ALL, counters);
}

/// The same of a mesh of integers.
pub fn integers_bands<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    bands(FixedPoint(Spans16), target, camera, model, &integers(model, mapped_integers), ALL, counters);
}

/// The same of one with meshlets.
pub fn meshlets_bands<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    bands(FixedPoint(Spans16), target, camera, model, &meshlets(model, mapped_integers), ALL, counters);
}

/// The same with 512 slots, a sixth of its vertices.
pub fn meshlets_cache<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    bands(FixedPoint(Spans16), target, camera, model, &meshlets(model, mapped_integers), 512, counters);
}

/// As many slots as the torus has vertices.
const ALL: usize = TORUS_VERTICES;

/// The bands of [`meshlets_bands`], divided as seldom as a quarter of a texel allows.
pub fn bounded_bands<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    bands(FixedPoint(QUARTER_TEXEL), target, camera, model, &meshlets(model, mapped_integers), ALL, counters);
}

/// Lines that miss by at most so much of the texture, which has 128 texels.
const QUARTER_TEXEL: Lines = Lines::bounded(0.25 / 128.0);

#[inline]
fn bands<K: Counters>(
    interpolation: impl Interpolation,
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    mesh: &impl Geometry<Varying = Vec2>,
    slots_used: usize,
    counters: &mut K,
) {
    const BAND: usize = PIXELS / 15;
    let stage = Stored(TEXTURE.sampler(Nearest, Repeat));
    let view = View::new(model.to_eye, camera.perspective);
    let Target { color, depth, slots, listed, .. } = target;
    let mut pass = Pass::new(&view, mesh, stage)
        .interpolation(interpolation)
        .subpixel(Sub4)
        .slots(slots.mapped.get_mut(..slots_used).unwrap_or_default());
    let (mut prepared, _) = pass.count_prepare([WIDTH, HEIGHT], D16, listed, counters);
    let bands = color.chunks_mut(BAND).zip(depth.chunks_mut(BAND));
    for ((color, depth), top) in bands.zip((0..HEIGHT).step_by(16)) {
        if let Ok(mut band) = alberti::Target::band(Rgb565Le, D16, [WIDTH, HEIGHT], top, color, depth) {
            prepared.count_by(One, &mut band, counters);
        }
    }
}

/// A model's mesh of integers.
#[inline]
fn integers<V: Varying, F: Fn(&HalfWords) -> IntegerVertex<V>>(
    model: &Model,
    vertex_stage: F,
) -> IntegerMesh<'static, HalfWords, u16, F> {
    IntegerMesh::new(model.integers, model.triangles, HalfWords::UNIT, vertex_stage)
}

/// The same with meshlets.
#[inline]
pub(crate) fn meshlets<V: Varying, F: Fn(&HalfWords) -> IntegerVertex<V>>(
    model: &Model,
    vertex_stage: F,
) -> Meshlets<'static, IntegerMesh<'static, HalfWords, u16, F>> {
    let (triangles, meshlets, ball) = model.meshlets;
    let mesh = IntegerMesh::new(model.integers, triangles, HalfWords::UNIT, vertex_stage);
    Meshlets { mesh, meshlets, ball }
}

#[inline]
fn colored_integers(v: &HalfWords) -> IntegerVertex<Ready565> {
    let components = Ready565::of_integers(v.color.map(|c| Q16::from_bits(i32::from(c) * 257)));
    IntegerVertex { place: v.position, components }
}

#[inline]
pub(crate) fn mapped_integers(v: &HalfWords) -> IntegerVertex<Vec2> {
    IntegerVertex { place: v.position, components: v.uv.map(|c| Q16::from_bits(i32::from(c) << 4)) }
}

/// One colour for all, without depth: later triangles cover earlier ones.
pub fn flat_without_depth<K: Counters>(
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let mesh = Mesh::new(model.vertices, model.triangles, |v: &Vertex| (place(v), ()));
    let mut nothing = [(); PIXELS];
    let pixels = alberti::Target::new(Rgb565Le, NoDepth, WIDTH, HEIGHT, &mut target.color, &mut nothing);
    draw(pixels, camera, model, &mesh, Solid(ORANGE), Exact, &mut [], counters);
}

pub(crate) const ORANGE: u16 = 0xe405;

/// The pass that all ways have in common.
#[inline]
#[expect(clippy::too_many_arguments, reason = "all that differs")]
pub(crate) fn draw<C, D, M, F, P, K>(
    target: Result<alberti::Target<'_, C, D>, alberti::TargetError>,
    camera: &Camera,
    model: &Model,
    mesh: &M,
    stage: F,
    interpolation: P,
    slots: &mut [Slot<M::Varying>],
    counters: &mut K,
) where
    C: ColorFormat,
    D: DepthFormat,
    M: Geometry,
    F: FragmentStage<M::Varying>,
    P: Interpolation,
    K: Counters,
{
    let Ok(mut target) = target else { return };
    let view = View::new(model.to_eye, camera.perspective);
    let pass = Pass::new(&view, mesh, stage).interpolation(interpolation).subpixel(Sub4);
    pass.slots(slots).count_by(One, &mut target, counters);
}

impl Target {
    /// Colour and depth.
    #[inline]
    pub(crate) fn with_depth(&mut self) -> Result<alberti::Target<'_, Rgb565Le, D16>, alberti::TargetError> {
        alberti::Target::new(Rgb565Le, D16, WIDTH, HEIGHT, &mut self.color, &mut self.depth)
    }
}

pub(crate) fn place(vertex: &Vertex) -> Point3<Object> {
    Point3::new(Vec3::from_array(vertex.position))
}

fn colored(vertex: &Vertex) -> (Point3<Object>, Ready565) {
    (place(vertex), Ready565::new(Vec3::from_array(vertex.color)))
}

pub(crate) fn mapped(vertex: &Vertex) -> (Point3<Object>, Vec2) {
    (place(vertex), Vec2::from_array(vertex.uv))
}

/// The vertex's colour for the light that is scattered, and none that is mirrored.
fn lit(vertex: &Vertex) -> (Point3<Object>, (Vec3, (Vec3, Vec2))) {
    let (position, uv) = mapped(vertex);
    (position, (Vec3::from_array(vertex.color), (Vec3::ZERO, uv)))
}
