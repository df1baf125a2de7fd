//! Ways of reading the floor's mip map, and one on a mesh.

use crate::draws::{draw, draws, mapped, mapped_by, meshes};
use crate::shapes::{FLOOR_MIPMAP, FLOOR_PAIRS, Model};
use crate::torus::Vertex;
use crate::{Camera, HEIGHT, Target, WIDTH};
use alberti::glam::Vec2;
use alberti::math::Gradient;
use alberti::math::lanes::Lanes;
use alberti::raster::{Differentiation, FragmentStage, Fragments, NoDerivatives, PerRun, PerTriangle};
use alberti::shaders::{Differentiated, Light, Lit565, Stored, TexelDither, Unlit};
use alberti::texture::format::{Rgb565, Rgb565Pairs};
use alberti::texture::{
    BaseLevel, Bilinear, Minify, MipSampler, Nearest, NearestLevel, PowerOfTwo, Repeat, Trilinear,
};
use alberti::{Affine, Counters, D16, Exact, FixedPoint, Mesh, Object, Point3, Rgb565Le, Spans16};
use core::hint::black_box;

draws! {
    /// The nearest texel of the nearest level, one for each triangle.
    mip_nearest(model): Exact, mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler(NEAREST_MIP, Repeat)));

    /// Four texels of the nearest level, one for each triangle.
    mip_bilinear(model): Exact, mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler(BILINEAR_MIP, Repeat)));

    /// Between levels, by one level of detail for each triangle.
    trilinear(model): Exact, mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler(Trilinear, Repeat)));

    /// Between levels, by one level of detail for each row of a triangle.
    trilinear_spans(model): Exact, mapped,
        Differentiated::by(PerRun, Unlit(FLOOR_MIPMAP.sampler(Trilinear, Repeat)));

    /// The nearest texel of the nearest level, one for each triangle, in fixed point.
    mip_nearest_fixed(model): FixedPoint(Spans16), mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler(NEAREST_MIP, Repeat)));

    /// Four texels of the nearest level, one for each triangle, in fixed point.
    mip_bilinear_fixed(model): FixedPoint(Spans16), mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler(BILINEAR_MIP, Repeat)));

    /// Between levels, by one level of detail for each triangle, in fixed point.
    trilinear_fixed(model): FixedPoint(Spans16), mapped,
        Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler(Trilinear, Repeat)));

    /// Between levels, by one level of detail for each 16 columns, in fixed point.
    trilinear_spans_fixed(model): FixedPoint(Spans16), mapped,
        Differentiated::by(PerRun, Unlit(FLOOR_MIPMAP.sampler(Trilinear, Repeat)));

    /// Between levels, by one level of detail for each triangle, in fixed point, of texels as they are stored.
    trilinear_stored_fixed(model): FixedPoint(Spans16), mapped,
        Differentiated::by(PerTriangle, Stored(FLOOR_MIPMAP.sampler(Trilinear, Repeat)));

    /// The same by one for each 16 columns.
    trilinear_stored_spans_fixed(model): FixedPoint(Spans16), mapped,
        Differentiated::by(PerRun, Stored(FLOOR_MIPMAP.sampler(Trilinear, Repeat)));

    /// The nearest texel of the nearest level, found once for each triangle, in fixed point.
    leveled_nearest_fixed(model): FixedPoint(Spans16), mapped,
        Stored(NEAREST_OF_FLOOR.leveled());

    /// The same in one level, which compilers do not know.
    one_level_fixed(model): FixedPoint(Spans16), mapped,
        OneLevel(NoDerivatives, Stored(black_box(NEAREST_OF_FLOOR.leveled())));

    /// The same with the derivatives of each triangle, which nothing uses.
    derived_fixed(model): FixedPoint(Spans16), mapped,
        OneLevel(PerTriangle, Stored(black_box(NEAREST_OF_FLOOR.leveled())));

    /// That of a level for each triangle under the light of the vertices: all that a small display shows of a model.
    lit_fixed(model): FixedPoint(Spans16), shone_on, Lit565 { surface: Stored(NEAREST_OF_FLOOR.leveled()) };

    /// Four texels of a level.
    leveled_bilinear_fixed(model): FixedPoint(Spans16), mapped,
        Stored(BILINEAR_OF_FLOOR.leveled());

    /// Between two levels that are found once for each triangle.
    leveled_trilinear_fixed(model): FixedPoint(Spans16), mapped,
        Stored(TRILINEAR_OF_FLOOR.leveled());

    /// Four texels of a level, in two pairs.
    pairs_bilinear_fixed(model): FixedPoint(Spans16), mapped,
        Stored(BILINEAR_OF_PAIRS.leveled());

    /// Between two levels, in four pairs.
    pairs_trilinear_fixed(model): FixedPoint(Spans16), mapped,
        Stored(TRILINEAR_OF_PAIRS.leveled());

    /// One of four texels of a level, by the place of the pixel.
    dithered_bilinear_fixed(model): FixedPoint(Spans16), mapped,
        TexelDither(BILINEAR_OF_FLOOR.leveled());

    /// One of eight texels of two levels.
    dithered_trilinear_fixed(model): FixedPoint(Spans16), mapped,
        TexelDither(TRILINEAR_OF_FLOOR.leveled());
}

meshes! {
    /// The nearest texel of the nearest level, found once for each triangle, on a mesh.
    leveled_mesh(model) in mapped: Mesh::new(model.vertices, model.triangles, mapped),
        Stored(NEAREST_OF_FLOOR.leveled());

    /// The same in one level.
    one_level_mesh(model) in mapped: Mesh::new(model.vertices, model.triangles, mapped),
        OneLevel(NoDerivatives, Stored(black_box(NEAREST_OF_FLOOR.leveled())));
}

/// The nearest texel of the nearest level, one for each triangle, of a mesh.
pub fn mesh_mip_nearest<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let stage = Differentiated::by(PerTriangle, Unlit(FLOOR_MIPMAP.sampler(NEAREST_MIP, Repeat)));
    mapped_by(Exact, stage, target, camera, model, counters);
}

/// The same of the finest level, without derivatives.
pub fn mesh_base_nearest<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let stage = Unlit(FLOOR_MIPMAP.sampler(BaseLevel(Nearest), Repeat));
    mapped_by(Exact, stage, target, camera, model, counters);
}

/// A stage that stays in the level that it has: as long a way for each pixel as where that is found. Derivatives are
/// found, if the policy is one that does, and not used.
#[derive(Clone, Copy)]
struct OneLevel<D, S>(D, S);

impl<D: Differentiation, S: FragmentStage<Vec2>> FragmentStage<Vec2> for OneLevel<D, S> {
    type Color = S::Color;
    type Derivatives = D;
    const SETTLES: bool = D::EVERYWHERE;

    #[inline(always)]
    fn settled<L: Lanes>(&self, _: L, gradient: &Gradient<[L::Number; 2]>) -> Self {
        // Each as a value: nothing has to lie in memory.
        let Gradient { dx, dy } = *gradient;
        let _ = (dx.map(black_box), dy.map(black_box));
        *self
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec2>) -> (L::U32, L::Mask) {
        self.1.shade(fragments)
    }
}

/// As much light as the vertex is red.
fn shone_on(vertex: &Vertex) -> (Point3<Object>, (Light, Vec2)) {
    let (position, uv) = mapped(vertex);
    (position, (Light::new(vertex.color[0]), uv))
}

/// Samplers of the floor's mip map, to which those refer whose levels are found once a triangle.
static NEAREST_OF_FLOOR: OfFloor<NearestLevel<Nearest>> = FLOOR_MIPMAP.sampler(NearestLevel(Nearest), Repeat);
static BILINEAR_OF_FLOOR: OfFloor<NearestLevel<Bilinear>> =
    FLOOR_MIPMAP.sampler(NearestLevel(Bilinear), Repeat);
static TRILINEAR_OF_FLOOR: OfFloor<Trilinear> = FLOOR_MIPMAP.sampler(Trilinear, Repeat);
type OfFloor<M> = MipSampler<'static, Rgb565, M, Repeat, Repeat, PowerOfTwo>;

type OfPairs<M> = MipSampler<'static, Rgb565Pairs, M, Repeat, Repeat, PowerOfTwo>;
static BILINEAR_OF_PAIRS: OfPairs<NearestLevel<Bilinear>> =
    FLOOR_PAIRS.sampler(NearestLevel(Bilinear), Repeat);
static TRILINEAR_OF_PAIRS: OfPairs<Trilinear> = FLOOR_PAIRS.sampler(Trilinear, Repeat);

const NEAREST_MIP: Minify<NearestLevel<Nearest>, Nearest> =
    Minify { min: NearestLevel(Nearest), mag: Nearest };
const BILINEAR_MIP: Minify<NearestLevel<Bilinear>, Bilinear> =
    Minify { min: NearestLevel(Bilinear), mag: Bilinear };
