//! The same pixels however the work is divided: into bands, vertex slots, with or without counting, and between what is
//! prepared once and what is done again for each band.

use alberti::glam::Vec2;
use alberti::shaders::Unlit;
use alberti::texture::{Bilinear, Repeat, Texture};
use alberti::{
    Band, ColorFormat, Cull, D16, DepthFormat, F32, F32Reversed, Frame, NoDepth, Object, Pass, Perspective,
    Point3, Prepared, Rgb565Be, Rgb565Le, Rgba8, ScreenTriangle, Sides, Slot, Stats, Store, Sub8, View,
    Viewport, draw, glam::Vec3, prepare,
};
use alberti_app::draw::view;
use alberti_app::scene::Vertex;
use alberti_app::scenes::{BuiltIn, NAMES, by_name};
use alberti_oracle::rng::{Rng, run_seed};
use std::ops::Range;

const WIDTH: u32 = 200;
const HEIGHT: u32 = 150;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// One band of a frame: its first row, and its pixels and depths.
struct Rows<'a, C: ColorFormat, D: DepthFormat> {
    first: u32,
    color: &'a mut [C::Pixel],
    depth: &'a mut [D::Stored],
}

/// Draws a scene into a band, with so many vertex slots.
fn draw_rows<C, D>(scene: &BuiltIn, rows: Rows<'_, C, D>, slots: usize) -> Stats
where
    C: Store<Rgba8>,
    D: DepthFormat,
{
    let model = &scene.model;
    let image = &model.textures[0];
    let texture = Texture::<Rgba8>::new(&image.texels, image.width, image.height).expect("a texture");
    let mut band = Band::<C, D>::new(WIDTH, rows.first, rows.color, rows.depth).expect("whole rows");
    band.clear(Rgba8::from_rgb24(0x30_40_50));
    let vertex = |v: &Vertex| (Point3::<Object>::new(Vec3::from_array(v.position)), Vec2::from_array(v.uv));
    let mut stats = Stats::default();
    for part in &model.parts {
        let pass = Pass {
            view: view(&scene.camera, WIDTH, HEIGHT).expect("a view"),
            vertices: &model.vertices,
            triangles: &part.triangles,
            vertex_stage: vertex,
            fragment_stage: Unlit(texture.sampler::<Bilinear, Repeat>()),
            cull: Cull::None,
            sides: Sides::GuardBand,
            interpolation: alberti::Exact,
        };
        draw(&pass, &mut band, &mut vec![Slot::<Sub8, Vec2>::EMPTY; slots], &mut stats);
    }
    stats
}

fn frame<C: Store<Rgba8>, D: DepthFormat>(scene: &BuiltIn, black: C::Pixel, slots: usize) -> Vec<C::Pixel> {
    let (mut color, mut depth) = (vec![black; PIXELS], vec![D::FARTHEST; PIXELS]);
    let stats = draw_rows::<C, D>(scene, Rows { first: 0, color: &mut color, depth: &mut depth }, slots);
    assert!(stats.written > 5000, "next to nothing was drawn: {stats:?}");
    color
}

#[test]
fn bands_of_any_height_in_any_order_make_the_frame() {
    for name in ["mesh", "inside", "floor"] {
        let scene = by_name(name).expect("a built-in scene");
        let whole = frame::<Rgba8, F32>(&scene, 0, scene.model.vertices.len());
        for height in [1, 7, 64, 149] {
            let mut color = vec![0; PIXELS];
            let mut bands: Vec<(usize, &mut [u32])> =
                color.chunks_mut((WIDTH * height) as usize).enumerate().collect();
            // Odd bands first, from the bottom up: as good an order as any.
            bands.sort_by_key(|(i, _)| (i % 2 == 0, usize::MAX - i));
            for (i, color) in bands {
                let first = u32::try_from(i).expect("few bands") * height;
                let depth = &mut vec![0.0; color.len()];
                draw_rows::<Rgba8, F32>(&scene, Rows { first, color, depth }, 0);
            }
            assert!(color == whole, "{name} in bands of {height} rows");
        }
    }
}

#[test]
fn vertex_slots_change_nothing() {
    let scene = by_name("mesh").expect("a built-in scene");
    let whole = frame::<Rgba8, F32>(&scene, 0, scene.model.vertices.len());
    for slots in [0, 1, 31, 1000] {
        assert!(frame::<Rgba8, F32>(&scene, 0, slots) == whole, "{slots} slots");
    }
}

#[test]
fn targets_hold_the_same_colours() {
    let scene = by_name("mesh").expect("a built-in scene");
    let full = frame::<Rgba8, D16>(&scene, 0, 0);
    let little = frame::<Rgb565Le, D16>(&scene, 0, 0);
    let big = frame::<Rgb565Be, D16>(&scene, 0, 0);
    for ((full, little), big) in full.iter().zip(little).zip(big) {
        let [r, g, b, _] = full.to_ne_bytes().map(f64::from);
        let [low, high] = little.to_ne_bytes();
        assert_eq!(big.to_ne_bytes(), [high, low]);
        let word = u16::from_le_bytes([low, high]);
        let steps = [(r, word >> 11, 31.0), (g, word >> 5 & 63, 63.0), (b, word & 31, 31.0)];
        assert!(steps.iter().all(|&(c, step, of)| (c * of / 255.0 - f64::from(step)).abs() <= 0.5));
    }
    // Without a depth buffer the last triangle drawn is seen, so the picture is another one.
    assert!(frame::<Rgba8, NoDepth>(&scene, 0, 0) != full);
}

/// A mesh whose vertices carry their positions, so that every one has another colour.
struct Mesh {
    name: String,
    view: View,
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    cull: Cull,
    sides: Sides,
}

type MeshPass<'a> = Pass<'a, Vec3, u32, fn(&Vec3) -> (Point3<Object>, Vec3), fn(Vec3) -> Option<Rgba8>>;

impl Mesh {
    fn built_in(name: &str) -> Self {
        let BuiltIn { model, camera, .. } = by_name(name).expect("a built-in scene");
        Self {
            name: name.into(),
            view: view(&camera, WIDTH, HEIGHT).expect("a view"),
            vertices: model.vertices.iter().map(|v| Vec3::from_array(v.position)).collect(),
            triangles: model.parts.iter().flat_map(|part| part.triangles.clone()).collect(),
            cull: Cull::Back,
            sides: Sides::GuardBand,
        }
    }

    /// Triangles large and small all around the viewer, through every plane and beyond the guard band, some of them
    /// with indices or coordinates without a meaning, in any viewport.
    fn random(rng: &mut Rng, sides: Sides, [x, y, width, height]: [i32; 4]) -> Self {
        let viewport = Viewport::new(x, y, width.unsigned_abs(), height.unsigned_abs());
        let mut number = || match rng.index(60) {
            0 => rng.any_f32(),
            1..20 => rng.log_uniform(0.001, 100.0) * if rng.one_in(2) { 1.0 } else { -1.0 },
            _ => rng.log_uniform(0.5, 2.0) - 1.25,
        };
        let vertex = |i: usize| match i % 20 {
            0 => Vec3::new(50.0, number(), 0.005),
            1..5 => Vec3::new(number(), number(), number()),
            _ => Vec3::new(number(), number(), number().abs()),
        };
        let vertices = (0..400).map(vertex).collect();
        let triangles = (0..400u32).map(|i| [i, i * 7 % 401, i * 11 % 400]).collect();
        Self {
            name: format!("random, {sides:?}, {width} x {height} pixels from {x}, {y}"),
            view: View {
                to_eye: Frame::at(Point3::new(Vec3::ZERO)),
                projection: Perspective::new(1.5, 4.0 / 3.0, 0.004, 20.0).expect("a perspective"),
                viewport: viewport.expect("a viewport"),
            },
            vertices,
            triangles,
            cull: Cull::None,
            sides,
        }
    }

    fn pass(&self, triangles: Range<usize>) -> MeshPass<'_> {
        Pass {
            view: self.view,
            vertices: &self.vertices,
            triangles: &self.triangles[triangles],
            vertex_stage: |&p| (Point3::new(p), p),
            fragment_stage: |p| {
                let [x, y, z] = p.to_array().map(f32::to_bits);
                let bits = x ^ y.rotate_left(11) ^ z.rotate_left(22);
                (bits % 16 != 0).then_some(Rgba8::from_bits(bits))
            },
            cull: self.cull,
            sides: self.sides,
            interpolation: alberti::Exact,
        }
    }

    /// How many vertices lie between near and far plane, but to the side of all that can be snapped.
    fn beyond_guard(&self) -> usize {
        let View { to_eye, projection, viewport } = self.view;
        let guard = viewport.guard();
        let beyond = |p: &&Vec3| {
            let p = projection.scale(to_eye.to_parent(Point3::new(**p))).coords;
            let between = (projection.near()..projection.far()).contains(&p.z);
            between && (p.x.abs() / p.z > guard.x || p.y.abs() / p.z > guard.y)
        };
        self.vertices.iter().filter(beyond).count()
    }
}

/// Colours and depths of a frame.
struct Picture<D: DepthFormat> {
    color: Vec<u32>,
    depth: Vec<D::Stored>,
}

impl<D: DepthFormat> Picture<D> {
    fn new() -> Self {
        Self { color: vec![0; PIXELS], depth: vec![D::FARTHEST; PIXELS] }
    }

    /// Bands of these heights, over and over, from the lowest one upwards.
    fn bands(&mut self, heights: &[u32], mut draw: impl FnMut(&mut Band<'_, Rgba8, D>)) {
        let mut tops = vec![0];
        for height in heights.iter().cycle() {
            match tops[tops.len() - 1] + height {
                top if top < HEIGHT => tops.push(top),
                _ => break,
            }
        }
        let mut bottom = HEIGHT;
        for top in tops.into_iter().rev() {
            let pixels = (top * WIDTH) as usize..(bottom * WIDTH) as usize;
            let (color, depth) = (&mut self.color[pixels.clone()], &mut self.depth[pixels]);
            draw(&mut Band::new(WIDTH, top, color, depth).expect("whole rows"));
            bottom = top;
        }
    }
}

/// Draws a mesh, prepared in different amounts of room, into bands of these heights.
fn check_prepared<D: DepthFormat<Stored: PartialEq>>(mesh: &Mesh, heights: &[&[u32]]) {
    let pass = mesh.pass(0..mesh.triangles.len());
    let slots = |count: usize| vec![Slot::<Sub8, Vec3>::EMPTY; count];
    let (mut whole, mut expected) = (Picture::<D>::new(), Stats::default());
    whole.bands(&[HEIGHT], |band| draw(&pass, band, &mut slots(mesh.vertices.len()), &mut expected));
    assert!(expected.written > 5000 && expected.drawn > 1, "{}: {expected:?}", mesh.name);

    let plenty = &mut vec![ScreenTriangle::<Sub8, Vec3>::EMPTY; 7 * mesh.triangles.len()];
    let enough = prepare::<D, _, _, _, _, _, _, _, _>(&pass, plenty, &mut slots(0), &mut ()).0.kept();
    assert!(enough as u64 >= expected.drawn && enough as u64 <= expected.drawn + expected.missed);
    for (i, size) in [enough, enough + 9, enough - 1, enough / 2, 1, 0].into_iter().enumerate() {
        let room = &mut vec![ScreenTriangle::EMPTY; size];
        let case = format!("{}, room for {size} of {enough}", mesh.name);
        let mut once = Stats::default();
        let slots = &mut slots([mesh.vertices.len(), 0, 5][i % 3]);
        let (prepared, _) = prepare(&pass, room, slots, &mut once);
        // A clipped triangle is kept as a whole or not at all.
        assert!(prepared.kept() <= size && prepared.kept() + 7 > size.min(enough), "{case}");
        assert_eq!(prepared.remaining() == 0, prepared.kept() == enough, "{case}");
        for heights in heights {
            let (mut picture, mut stats) = (Picture::<D>::new(), once);
            picture.bands(heights, |band| prepared.draw(band, slots, &mut stats));
            assert!(picture.color == whole.color, "{case}: colours in bands of {heights:?} rows");
            assert!(picture.depth == whole.depth, "{case}: depths in bands of {heights:?} rows");
            assert_eq!([stats.fragments, stats.written], [expected.fragments, expected.written], "{case}");
            if heights == &[HEIGHT] {
                // What lies in rows of the viewport that the frame does not have is never heard of.
                let [_, rows] = mesh.view.viewport.pixels();
                let missed = if rows.end.unsigned_abs() > HEIGHT { stats.missed } else { expected.missed };
                assert_eq!(stats, Stats { missed, ..expected }, "{case}");
            } else if prepared.remaining() == 0 {
                let once = |s: &Stats| [s.submitted, s.dropped, s.clipped, s.culled];
                assert_eq!(once(&stats), once(&expected), "{case}");
            }
        }
    }
}

#[test]
fn what_is_prepared_makes_the_frame_in_any_room_and_any_bands() {
    for name in NAMES {
        let mesh = Mesh::built_in(name);
        let all: [&[u32]; 5] = [&[HEIGHT], &[16], &[1, 40, 3, 61, 45], &[7], &[1]];
        let few = if mesh.triangles.len() > 10_000 { 3 } else { 5 };
        check_prepared::<D16>(&mesh, &all[..few]);
        check_prepared::<F32Reversed>(&mesh, &all[..few]);
    }
}

#[test]
fn what_is_clipped_is_prepared_like_the_rest() {
    let mut rng = Rng::stream(run_seed(), 1);
    for sides in [Sides::GuardBand, Sides::Cube] {
        for pixels in [[0, 0, 200, 150], [13, 21, 170, 100], [-30, -40, 300, 260]] {
            let mesh = Mesh::random(&mut rng, sides, pixels);
            assert!(mesh.beyond_guard() > 10, "{}", mesh.name);
            let heights: [&[u32]; 4] = [&[HEIGHT], &[16], &[9, 70, 2], &[1]];
            check_prepared::<D16>(&mesh, &heights);
            check_prepared::<F32Reversed>(&mesh, &heights);
        }
    }
}

#[test]
fn passes_share_room() {
    let mesh = Mesh::built_in("mesh");
    let count = mesh.triangles.len();
    let slots = &mut [Slot::EMPTY; 64];
    let mut whole = Picture::<D16>::new();
    whole.bands(&[HEIGHT], |band| draw(&mesh.pass(0..count), band, slots, &mut ()));
    let passes = [0..count / 3, count / 3..count / 2, count / 2..count].map(|range| mesh.pass(range));
    for room in [0, 700, 2100, 9000] {
        let mut rest = &mut vec![ScreenTriangle::<Sub8, _>::EMPTY; room][..];
        let prepared = passes.each_ref().map(|pass| {
            let (prepared, left) = prepare(pass, std::mem::take(&mut rest), slots, &mut ());
            rest = left;
            prepared
        });
        let mut picture = Picture::<D16>::new();
        picture.bands(&[16], |band| prepared.iter().for_each(|pass| pass.draw(band, slots, &mut ())));
        assert!(picture.color == whole.color && picture.depth == whole.depth, "room for {room}");
        let kept: usize = prepared.iter().map(Prepared::kept).sum();
        assert_eq!(kept + rest.len(), room);
        assert_eq!(prepared.iter().all(|pass| pass.remaining() == 0), room == 9000);
    }
}
