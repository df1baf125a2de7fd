//! What happens to a fragment after it has its colour, and smooth edges and lines: all in fixed point.

use crate::draws::{ORANGE, draw, draws, glass, mapped, place};
use crate::shapes::{Model, TEXTURE};
use crate::torus::Vertex;
use crate::{Camera, HEIGHT, PIXELS, Target, WIDTH};
use alberti::glam::Vec2;
use alberti::lanes::One;
use alberti::raster::color::{
    Average, Bayer, Blended, BlueNoise, Dithered, InLight, Multiply, Over, Premultiplied, resolve, rgb565,
};
use alberti::shaders::fog::{ExponentialFog, Fog, Fogged, LinearFog, SquaredFog};
use alberti::shaders::{AlphaDither, AlphaTest, ColorKey, Solid, Stored, Unlit};
use alberti::texture::{Nearest, Repeat};
use alberti::{
    Affine, Biased, Counters, D16, FixedPoint, Geometry, Mesh, Object, Pass, Point3, Rgb565Le, Rgba8,
    Silhouette, Sub4, View,
};

const FOG: ExponentialFog = ExponentialFog { density: 0.3 };
const SOFT: SquaredFog = SquaredFog { density: 0.3 };
const HAZE: LinearFog = LinearFog { start: 1.0, end: 8.0 };
const MIST: Rgba8 = Rgba8::new(150, 160, 170, 255);

draws! {
    /// The nearest texel as a colour of 8 bits a channel in a fog that leaves half of it every 2.3 units.
    fogged(model): FixedPoint(Affine), |v: &Vertex| misty(v, FOG),
        Fogged { surface: Unlit(TEXTURE.sampler(Nearest, Repeat)), fog: FOG, color: MIST };

    /// The same in one that grows as the distance.
    hazy(model): FixedPoint(Affine), |v: &Vertex| misty(v, HAZE),
        Fogged { surface: Unlit(TEXTURE.sampler(Nearest, Repeat)), fog: HAZE, color: MIST };

    /// The same in one that begins softly.
    squared(model): FixedPoint(Affine), |v: &Vertex| misty(v, SOFT),
        Fogged { surface: Unlit(TEXTURE.sampler(Nearest, Repeat)), fog: SOFT, color: MIST };

    /// The nearest texel as it is stored in a fog that grows as the distance.
    hazy_stored(model): FixedPoint(Affine), |v: &Vertex| misty(v, HAZE),
        Fogged { surface: Stored(TEXTURE.sampler(Nearest, Repeat)), fog: HAZE, color: rgb565(MIST) };

    /// The nearest texel as it is stored, but for one in 500.
    keyed(model): FixedPoint(Affine), mapped,
        ColorKey { surface: Stored(TEXTURE.sampler(Nearest, Repeat)), key: 0x100d };

    /// The nearest texel where it is green enough.
    alpha_tested(model): FixedPoint(Affine), mapped,
        AlphaTest { surface: glass(), least: 100 };

    /// On as many pixels as it is green.
    alpha_dithered(model): FixedPoint(Affine), mapped, AlphaDither { surface: glass(), by: Bayer };
}

/// A vertex of a model that is placed before the eye.
#[inline]
fn misty(vertex: &Vertex, fog: impl Fog) -> (Point3<Object>, (f32, Vec2)) {
    let (position, uv) = mapped(vertex);
    (position, (fog.coordinate(position.coords.z), uv))
}

/// Defines ways of drawing colours of 8 bits a channel into a format, without perspective.
macro_rules! formats {
    ($($(#[$doc:meta])* $name:ident: $format:expr, $stage:expr;)*) => {$(
        $(#[$doc])*
        pub fn $name<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
            let mesh = Mesh::new(model.vertices, model.triangles, mapped);
            let Ok(mut pixels) = target.with_depth() else { return };
            let pixels = pixels.with_color($format);
            draw(Ok(pixels), camera, model, &mesh, $stage, FixedPoint(Affine), &mut [], counters);
        }
    )*};
}

formats! {
    /// The nearest texel in a pattern of eight by eight.
    dithered: Dithered { format: Rgb565Le, by: Bayer }, Unlit(TEXTURE.sampler(Nearest, Repeat));

    /// In a pattern without a weave.
    noisy: Dithered { format: Rgb565Le, by: BlueNoise }, Unlit(TEXTURE.sampler(Nearest, Repeat));

    /// The nearest texel over what is there, from which its green is taken.
    premultiplied: Blended { format: Rgb565Le, by: Premultiplied }, glass();

    /// The nearest texel as opaque as it is green, in light.
    in_light: Blended { format: Rgb565Le, by: InLight(Over) }, glass();

    /// The nearest texel as a filter of what is there.
    multiplied: Blended { format: Rgb565Le, by: Multiply }, glass();
}

/// The nearest texel on a mesh that is nearer than it is.
pub fn biased<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let mesh = Mesh::new(model.vertices, model.triangles, mapped);
    let Target { color, depth, slots, .. } = target;
    let format = Biased { format: D16, constant: -2.0, slope: -1.0, clamp: 0.0 };
    let pixels = alberti::Target::new(Rgb565Le, format, WIDTH, HEIGHT, color, depth);
    let stage = Stored(TEXTURE.sampler(Nearest, Repeat));
    draw(pixels, camera, model, &mesh, stage, FixedPoint(Affine), &mut slots.mapped, counters);
}

/// The edges of a mesh's triangles, a pixel wide.
pub fn wireframe<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let mesh = Mesh::new(model.vertices, model.triangles, |v: &Vertex| (place(v), ()));
    let view = View::new(model.to_eye, camera.perspective);
    let Target { color, depth, slots, .. } = target;
    let Ok(mut pixels) = alberti::Target::new(Rgb565Le, D16, WIDTH, HEIGHT, color, depth) else { return };
    let pass = Pass::new(&view, &mesh, Solid(ORANGE)).interpolation(FixedPoint(Affine)).subpixel(Sub4);
    pass.slots(&mut slots.bare).count_lines(&mut pixels, mesh.edges(), counters);
}

/// The same in bands of 8 rows.
pub fn wireframe_bands<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let mesh = Mesh::new(model.vertices, model.triangles, |v: &Vertex| (place(v), ()));
    let view = View::new(model.to_eye, camera.perspective);
    let Target { color, depth, slots, .. } = target;
    let pass = Pass::new(&view, &mesh, Solid(ORANGE)).interpolation(FixedPoint(Affine)).subpixel(Sub4);
    let mut pass = pass.slots(&mut slots.bare);
    let (mut prepared, _) = pass.count_prepare([WIDTH, HEIGHT], D16, &mut [], &mut ());
    let pixels = 8 * WIDTH as usize;
    let bands = color.chunks_mut(pixels).zip(depth.chunks_mut(pixels));
    for ((color, depth), top) in bands.zip((0..HEIGHT).step_by(8)) {
        let band = alberti::Target::band(Rgb565Le, D16, [WIDTH, HEIGHT], top, color, depth);
        let Ok(mut band) = band else { continue };
        prepared.count_lines(&mut band, mesh.edges(), counters);
    }
}

/// The corners of a mesh's triangles as points of three pixels a side.
pub fn cloud<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let mesh = Mesh::new(model.vertices, model.triangles, |v: &Vertex| (place(v), ()));
    let view = View::new(model.to_eye, camera.perspective);
    let Target { color, depth, slots, .. } = target;
    let Ok(mut pixels) = alberti::Target::new(Rgb565Le, D16, WIDTH, HEIGHT, color, depth) else { return };
    let pass = Pass::new(&view, &mesh, Solid(ORANGE)).interpolation(FixedPoint(Affine)).subpixel(Sub4);
    let corners = mesh.edges().map(|[corner, _]| corner);
    pass.slots(&mut slots.bare).count_points(&mut pixels, corners, 3, counters);
}

/// Rows of a band of [`smooth`], and the words for its silhouette, with 256 places for edges that wait.
const ROWS: usize = 16;
pub(crate) const CELLS: usize = PIXELS * ROWS / HEIGHT as usize + 256 * Silhouette::PLACE;
/// Of what a frame is cleared to.
const BACKGROUND: Rgba8 = Rgba8::from_rgb24(0x21_20_21);

/// One colour for all with smooth edges, in bands.
pub fn smooth<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    cover(target, (camera, model), Average::Bytes, counters);
}

/// The same, whose means are of light.
pub fn smooth_in_light<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    cover(target, (camera, model), Average::Light, counters);
}

#[inline]
fn cover<K: Counters>(
    target: &mut Target,
    (camera, model): (&Camera, &Model),
    average: Average,
    counters: &mut K,
) {
    let mesh = Mesh::new(model.vertices, model.triangles, |v: &Vertex| (place(v), ()));
    let view = View::new(model.to_eye, camera.perspective);
    let Target { color, depth, slots, cells, listed, .. } = target;
    let pass = Pass::new(&view, &mesh, Solid(ORANGE)).interpolation(FixedPoint(Affine)).subpixel(Sub4);
    let mut pass = pass.slots(&mut slots.bare);
    let (mut prepared, _) = pass.prepare_smooth([WIDTH, HEIGHT], D16, listed, counters);
    let columns = WIDTH as usize;
    let bands = color.chunks_mut(ROWS * columns).zip(depth.chunks_mut(ROWS * columns));
    for ((color, depth), top) in bands.zip((0..HEIGHT).step_by(ROWS)) {
        let band = alberti::Target::band(Rgb565Le, D16, [WIDTH, HEIGHT], top, color, depth);
        let Ok(mut band) = band else { continue };
        prepared.count_by(One, &mut band, counters);
        let Ok(mut silhouette) = Silhouette::new(&band, cells) else { continue };
        prepared.cover(&mut silhouette);
        let coverage = silhouette.coverage();
        prepared.draw_fringe(&mut band, &coverage);
        coverage.resolve(&mut band, average, |_| BACKGROUND);
    }
}

/// Samples of a band of [`sampled`], 640 x 16.
pub(crate) const SAMPLES: usize = PIXELS * 4 / 30;

/// The same with four samples a pixel, in bands.
pub fn sampled<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    sample(target, (camera, model), Average::Bytes, counters);
}

/// The same, whose means are of light.
pub fn sampled_in_light<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    sample(target, (camera, model), Average::Light, counters);
}

#[inline]
fn sample<K: Counters>(
    target: &mut Target,
    (camera, model): (&Camera, &Model),
    average: Average,
    counters: &mut K,
) {
    const SIZE: [u32; 2] = [2 * WIDTH, 2 * HEIGHT];
    let mesh = Mesh::new(model.vertices, model.triangles, |v: &Vertex| (place(v), ()));
    let view = View::new(model.to_eye, camera.perspective);
    let Target { color, slots, samples: (samples, depths), listed, .. } = target;
    let pass = Pass::new(&view, &mesh, Solid(ORANGE)).interpolation(FixedPoint(Affine)).subpixel(Sub4);
    let mut pass = pass.slots(&mut slots.bare);
    let (mut prepared, _) = pass.count_prepare(SIZE, D16, listed, counters);
    for (own, first) in color.chunks_mut(SAMPLES / 4).zip((0..).step_by(8)) {
        let Ok(mut band) = alberti::Target::band(Rgb565Le, D16, SIZE, 2 * first, samples, depths) else {
            return;
        };
        band.clear(BACKGROUND);
        prepared.count_by(One, &mut band, counters);
        let (from, first) = ((Rgb565Le, band.pixels()), first.cast_signed());
        resolve(from, (Rgb565Le, own), WIDTH as usize, first, 2, average);
    }
}
