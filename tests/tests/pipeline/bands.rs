//! The same pixels however the work is divided: into bands, vertex slots, with or without counting, and between the
//! part that is prepared once and the part that is done again for each band.
//!
//! Depth formats are `AnyDepth`, one kernel for each format of colours and each kind of stage.

use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Unlit, VertexColor};
use alberti::texture::{Bilinear, Repeat, Texture};
use alberti::{
    AnyDepth, ColorFormat, Cull, DepthFormat, Frame, Mesh, Pass, Perspective, Prepared, PreparedTriangle,
    Rgb565Be, Rgb565Le, Rgba8, Rgba8888, Sides, Slot, Stats, Target, View, Viewport, clear_by_threads,
    for_lanes, lanes::Machine,
};
use alberti_app::scene::Vertex;
use alberti_app::scenes::{BuiltIn, NAMES, by_name};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::for_widest;
use alberti_tests::reference::view;
use std::num::NonZero;
use std::ops::Range;

pub(super) const WIDTH: u32 = 200;
pub(super) const HEIGHT: u32 = 150;
pub(super) const SIZE: [u32; 2] = [WIDTH, HEIGHT];
const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// Draws a scene into a band, with so many vertex slots.
fn draw_rows<C: ColorFormat>(scene: &BuiltIn, band: &mut Target<'_, C, AnyDepth>, slots: usize) -> Stats {
    let model = &scene.model;
    let image = &model.textures[0];
    let texture = Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture");
    band.clear(Rgba8::from_rgb24(0x30_40_50));
    let vertex = |v: &Vertex| (Vec3::from_array(v.position), Vec2::from_array(v.uv));
    let view = view(&scene.camera).expect("a view");
    let mut sum = Stats::default();
    for part in &model.parts {
        let mesh = Mesh::new(&model.vertices, &part.triangles, vertex);
        let stats = Pass::new(&view, &mesh, Unlit(texture.sampler(Bilinear, Repeat)))
            .cull(Cull::None)
            .slots(&mut vec![Slot::EMPTY; slots])
            .draw_counted(band);
        sum.written += stats.written;
    }
    sum
}

fn frame<C: ColorFormat<Pixel: Default>>(
    scene: &BuiltIn,
    format: C,
    depth_format: AnyDepth,
    slots: usize,
) -> Vec<C::Pixel> {
    let mut color = vec![C::Pixel::default(); PIXELS];
    let mut depth = vec![depth_format.farthest(); PIXELS];
    let mut target =
        Target::new(format, depth_format, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    let stats = draw_rows(scene, &mut target, slots);
    assert!(stats.written > 5000, "next to nothing was drawn: {stats:?}");
    color
}

/// The clear, vertices, lists and bands by several threads, with room for all triangles or for some, make the frame of
/// one.
#[test]
fn any_number_of_threads_makes_the_frame() {
    for name in ["mesh", "inside", "gouraud"] {
        let scene = by_name(name).expect("a built-in scene");
        let (model, view) = (&scene.model, view(&scene.camera).expect("a view"));
        let vertex = |v: &Vertex| (Vec3::from_array(v.position), Vec3::from_array(v.color));
        let triangles = model.parts.iter().map(|part| part.triangles.len()).max().expect("parts");
        // A scissor in the middle of the bands' rows.
        let frame = |draw: &dyn Fn(&mut Target<'_, Rgba8888, AnyDepth>, usize) -> Stats| {
            let (mut color, mut depth) = (vec![7; PIXELS], vec![9; PIXELS]);
            let mut whole =
                Target::new(Rgba8888, AnyDepth::D24, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
            let mut target = whole.scissor(3..WIDTH.cast_signed(), 0..HEIGHT.cast_signed() - 5);
            let mut stats = Stats::default();
            (0..model.parts.len()).for_each(|part| stats += draw(&mut target, part));
            (color, depth, stats)
        };
        let pass = |part: usize| Mesh::new(&model.vertices, &model.parts[part].triangles, vertex);
        let slots = || vec![Slot::EMPTY; model.vertices.len()];
        let background = Rgba8::from_rgb24(0x30_40_50);
        let (color, depth, expected) = frame(&|target, part| {
            if part == 0 {
                target.clear(background);
            }
            Pass::new(&view, &pass(part), VertexColor).slots(&mut slots()).draw_counted(target)
        });
        for (threads, room) in
            [(1, triangles), (2, triangles), (3, triangles / 2), (8, triangles + 9), (5, 0)]
        {
            let threads = NonZero::new(threads).expect("some");
            let (found, depths, stats) = frame(&|target, part| {
                let mut room = vec![PreparedTriangle::EMPTY; room];
                let mesh = pass(part);
                let mut slots = slots();
                let mut pass = Pass::new(&view, &mesh, VertexColor).slots(&mut slots);
                if part == 0 {
                    clear_by_threads(threads, target, background);
                }
                let (machine, mut stats) = (Machine::all().next().expect("one"), Stats::default());
                for_lanes!(machine, lanes => {
                    pass.count_by_threads(lanes, threads, &mut room, target, &mut stats);
                });
                stats
            });
            assert!(found == color && depths == depth, "{name} by {threads} threads with room for {room}");
            let once = |s: Stats| [s.submitted, s.dropped, s.clipped, s.fragments, s.written];
            assert_eq!(once(stats), once(expected), "{name} by {threads} threads with room for {room}");
            assert!(stats.drawn >= expected.drawn);
        }
    }
}

#[test]
fn bands_of_any_height_in_any_order_make_the_frame() {
    for name in ["mesh", "inside", "floor"] {
        let scene = by_name(name).expect("a built-in scene");
        let whole = frame(&scene, Rgba8888, AnyDepth::F32, scene.model.vertices.len());
        for height in [1, 7, 64, 149] {
            let mut color = vec![0; PIXELS];
            let mut bands: Vec<(usize, &mut [u32])> =
                color.chunks_mut((WIDTH * height) as usize).enumerate().collect();
            // Odd bands first, from the bottom up: as good an order as any.
            bands.sort_by_key(|(i, _)| (i % 2 == 0, usize::MAX - i));
            for (i, color) in bands {
                let first = u32::try_from(i).expect("few bands") * height;
                let depth = &mut vec![0; color.len()];
                let mut band =
                    Target::band(Rgba8888, AnyDepth::F32, SIZE, first, color, depth).expect("whole rows");
                draw_rows(&scene, &mut band, 0);
            }
            assert!(color == whole, "{name} in bands of {height} rows");
        }
    }
}

#[test]
fn vertex_slots_change_nothing() {
    let scene = by_name("mesh").expect("a built-in scene");
    let whole = frame(&scene, Rgba8888, AnyDepth::F32, scene.model.vertices.len());
    for slots in [0, 1, 31, 1000] {
        assert!(frame(&scene, Rgba8888, AnyDepth::F32, slots) == whole, "{slots} slots");
    }
}

#[test]
fn targets_hold_the_same_colours() {
    let scene = by_name("mesh").expect("a built-in scene");
    let full = frame(&scene, Rgba8888, AnyDepth::D16, 0);
    let little = frame(&scene, Rgb565Le, AnyDepth::D16, 0);
    let big = frame(&scene, Rgb565Be, AnyDepth::D16, 0);
    for ((full, little), big) in full.iter().zip(little).zip(big) {
        let [r, g, b, _] = full.to_ne_bytes().map(f64::from);
        let [low, high] = little.to_ne_bytes();
        assert_eq!(big.to_ne_bytes(), [high, low]);
        let word = u16::from_le_bytes([low, high]);
        let steps = [(r, word >> 11, 31.0), (g, word >> 5 & 63, 63.0), (b, word & 31, 31.0)];
        assert!(steps.iter().all(|&(c, step, of)| (c * of / 255.0 - f64::from(step)).abs() <= 0.5));
    }
    // Without a depth buffer the last triangle drawn is seen, so the picture is another one.
    assert!(frame(&scene, Rgba8888, AnyDepth::NoDepth, 0) != full);
}

/// A mesh whose vertices carry their positions, so that every one has another colour.
pub(super) struct Soup {
    pub(super) name: String,
    view: View,
    viewport: Viewport,
    vertices: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    cull: Cull,
    sides: Sides,
}

pub(super) type Carried<'a> = Mesh<'a, Vec3, u32, fn(&Vec3) -> (Vec3, Vec3)>;
pub(super) type Stage = fn(Vec3) -> Option<Rgba8>;

impl Soup {
    pub(super) fn built_in(name: &str) -> Self {
        let BuiltIn { model, camera, .. } = by_name(name).expect("a built-in scene");
        Self {
            name: name.into(),
            view: view(&camera).expect("a view"),
            viewport: Viewport::new(0, 0, WIDTH, HEIGHT).expect("a viewport"),
            vertices: model.vertices.iter().map(|v| Vec3::from_array(v.position)).collect(),
            triangles: model.parts.iter().flat_map(|part| part.triangles.clone()).collect(),
            cull: Cull::Back,
            sides: Sides::GuardBand,
        }
    }

    /// Triangles large and small all around the viewer, through every plane and beyond the guard band, some of them
    /// with indices or coordinates without a meaning, in any viewport.
    pub(super) fn random(rng: &mut Rng, sides: Sides, [x, y, width, height]: [i32; 4]) -> Self {
        let viewport = Viewport::new(x, y, width.unsigned_abs(), height.unsigned_abs()).expect("a viewport");
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
        let vertices: Vec<_> = (0..400).map(vertex).collect();
        let triangles = (0..400u32).map(|i| [i, i * 7 % 401, i * 11 % 400]).collect();
        let name = format!("random, {sides:?}, {width} x {height} pixels from {x}, {y}");
        let projection = Perspective::new(1.5, 4.0 / 3.0, 0.004, 20.0).expect("a perspective");
        assert!(beyond_guard(&vertices, &projection, &viewport) > 10, "{name}");
        let view = View::new(Frame::IDENTITY, projection);
        Self { name, view, viewport, vertices, triangles, cull: Cull::None, sides }
    }

    pub(super) fn mesh(&self, triangles: Range<usize>) -> Carried<'_> {
        Mesh::new(&self.vertices, &self.triangles[triangles], |&p| (p, p))
    }

    pub(super) fn pass<'a>(
        &'a self,
        mesh: &'a Carried<'a>,
        slots: &'a mut [Slot<Vec3>],
    ) -> Pass<'a, Carried<'a>, Stage> {
        let stage: Stage = |p| {
            let [x, y, z] = p.to_array().map(f32::to_bits);
            let bits = x ^ y.rotate_left(11) ^ z.rotate_left(22);
            (bits % 16 != 0).then_some(Rgba8::from_bits(bits))
        };
        Pass::new(&self.view, mesh, stage)
            .viewport(self.viewport)
            .cull(self.cull)
            .sides(self.sides)
            .slots(slots)
    }
}

/// The number of vertices between near and far plane, but to the side of all that can be snapped.
fn beyond_guard(vertices: &[Vec3], projection: &Perspective, viewport: &Viewport) -> usize {
    let guard = viewport.guard();
    let beyond = |p: &&Vec3| {
        let p = projection.scale((**p).into()).coords;
        let between = (projection.near()..projection.far()).contains(&p.z);
        between && (p.x.abs() / p.z > guard.x || p.y.abs() / p.z > guard.y)
    };
    vertices.iter().filter(beyond).count()
}

/// Colours and depths of a frame.
pub(super) struct Picture {
    format: AnyDepth,
    pub(super) color: Vec<u32>,
    pub(super) depth: Vec<u32>,
}

impl Picture {
    pub(super) fn new(format: AnyDepth) -> Self {
        Self { format, color: vec![0; PIXELS], depth: vec![format.farthest(); PIXELS] }
    }

    /// Bands of these heights, over and over, from the lowest one upwards.
    pub(super) fn bands(
        &mut self,
        heights: &[u32],
        mut draw: impl FnMut(&mut Target<'_, Rgba8888, AnyDepth>),
    ) {
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
            draw(&mut Target::band(Rgba8888, self.format, SIZE, top, color, depth).expect("whole rows"));
            bottom = top;
        }
    }
}

/// Draws a mesh, prepared in different amounts of room, into bands of these heights.
fn check_prepared(format: AnyDepth, soup: &Soup, heights: &[&[u32]]) {
    let mesh = soup.mesh(0..soup.triangles.len());
    let slots = |count: usize| vec![Slot::EMPTY; count];
    let (mut whole, mut expected) = (Picture::new(format), Stats::default());
    whole.bands(&[HEIGHT], |band| {
        expected = soup.pass(&mesh, &mut slots(soup.vertices.len())).draw_counted(band);
    });
    assert!(expected.written > 5000 && expected.drawn > 1, "{}: {expected:?}", soup.name);

    let plenty = &mut vec![PreparedTriangle::EMPTY; soup.triangles.len()];
    let enough = soup.pass(&mesh, &mut []).count_prepare(SIZE, format, plenty, &mut ()).0.listed();
    let most = expected.submitted - expected.dropped;
    assert!(enough as u64 <= most && enough as u64 + 6 * expected.clipped >= expected.drawn);
    for (i, size) in [enough, enough + 9, enough - 1, enough / 2, 1, 0].into_iter().enumerate() {
        let room = &mut vec![PreparedTriangle::EMPTY; size];
        let case = format!("{}, room for {size} of {enough}", soup.name);
        let mut once = Stats::default();
        let slots = &mut slots([soup.vertices.len(), 0, 5][i % 3]);
        let mut pass = soup.pass(&mesh, slots);
        let (mut prepared, _) = pass.count_prepare(SIZE, format, room, &mut once);
        assert_eq!(prepared.listed(), size.min(enough), "{case}");
        assert_eq!(prepared.remaining() == 0, prepared.listed() == enough, "{case}");
        for heights in heights {
            let (mut picture, mut stats) = (Picture::new(format), once);
            picture.bands(heights, |band| {
                for_widest!(lanes => prepared.count_by(lanes, band, &mut stats));
            });
            assert!(picture.color == whole.color, "{case}: colours in bands of {heights:?} rows");
            assert!(picture.depth == whole.depth, "{case}: depths in bands of {heights:?} rows");
            assert_eq!([stats.fragments, stats.written], [expected.fragments, expected.written], "{case}");
            if heights == &[HEIGHT] {
                // Rows of the viewport that the frame does not have are never heard of.
                let [_, rows] = soup.viewport.pixels();
                let missed = if rows.end.unsigned_abs() > HEIGHT { stats.missed } else { expected.missed };
                assert_eq!(stats, Stats { missed, ..expected }, "{case}");
            } else if prepared.remaining() == 0 {
                let once = |s: &Stats| [s.submitted, s.dropped, s.clipped];
                assert_eq!(once(&stats), once(&expected), "{case}");
                // Of a clipped triangle that is drawn, some part may not be: each band hears that.
                let again = stats.culled - expected.culled;
                assert!(again == 0 || expected.clipped > 0, "{case}");
            }
        }
    }
}

#[test]
fn what_is_prepared_makes_the_frame_in_any_room_and_any_bands() {
    for name in NAMES {
        let soup = Soup::built_in(name);
        let all: [&[u32]; 5] = [&[HEIGHT], &[16], &[1, 40, 3, 61, 45], &[7], &[1]];
        let few = if soup.triangles.len() > 10_000 { 3 } else { 5 };
        check_prepared(AnyDepth::D16, &soup, &all[..few]);
        check_prepared(AnyDepth::F32Reversed, &soup, &all[2..3]);
    }
}

#[test]
fn what_is_clipped_is_prepared_like_the_rest() {
    let mut rng = Rng::stream(run_seed(), 1);
    for sides in [Sides::GuardBand, Sides::Cube] {
        for pixels in [[0, 0, 200, 150], [13, 21, 170, 100], [-30, -40, 300, 260]] {
            let soup = Soup::random(&mut rng, sides, pixels);
            let heights: [&[u32]; 4] = [&[HEIGHT], &[16], &[9, 70, 2], &[1]];
            check_prepared(AnyDepth::D16, &soup, &heights);
            check_prepared(AnyDepth::F32Reversed, &soup, &heights[2..3]);
        }
    }
}

#[test]
fn passes_share_room() {
    let soup = Soup::built_in("mesh");
    let count = soup.triangles.len();
    let mut whole = Picture::new(AnyDepth::D16);
    let mesh = soup.mesh(0..count);
    whole.bands(&[HEIGHT], |band| soup.pass(&mesh, &mut [Slot::EMPTY; 64]).draw(band));
    let meshes = [0..count / 3, count / 3..count / 2, count / 2..count].map(|range| soup.mesh(range));
    for room in [0, 700, 2100, 9000] {
        let mut slots = [[Slot::EMPTY; 64]; 3];
        let mut passes: Vec<_> =
            meshes.iter().zip(&mut slots).map(|(mesh, slots)| soup.pass(mesh, slots)).collect();
        let mut rest = &mut vec![PreparedTriangle::EMPTY; room][..];
        let mut prepared = Vec::new();
        for pass in &mut passes {
            let (one, left) = pass.count_prepare(SIZE, AnyDepth::D16, std::mem::take(&mut rest), &mut ());
            prepared.push(one);
            rest = left;
        }
        let mut picture = Picture::new(AnyDepth::D16);
        picture.bands(&[16], |band| prepared.iter_mut().for_each(|pass| pass.draw(band)));
        assert!(picture.color == whole.color && picture.depth == whole.depth, "room for {room}");
        let kept: usize = prepared.iter().map(Prepared::listed).sum();
        assert_eq!(kept + rest.len(), room);
        assert_eq!(prepared.iter().all(|pass| pass.remaining() == 0), room == 9000);
    }
}

/// Colours and depths of a target of that size, of all rows.
fn picture_of(
    format: AnyDepth,
    size: [u32; 2],
    draw: impl FnOnce(&mut Target<'_, Rgba8888, AnyDepth>),
) -> (Vec<u32>, Vec<u32>) {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![format.farthest(); PIXELS]);
    let band = Target::band(Rgba8888, format, size, 0, &mut color, &mut depth);
    draw(&mut band.expect("whole rows"));
    (color, depth)
}

#[test]
fn what_is_prepared_for_depths_in_another_unit_is_drawn_anew() {
    let soup = Soup::built_in("mesh");
    let mesh = soup.mesh(0..soup.triangles.len());
    let room = &mut vec![PreparedTriangle::EMPTY; soup.triangles.len()];
    let slots = &mut [Slot::EMPTY; 64];
    let mut pass = soup.pass(&mesh, slots);
    let format = AnyDepth::F32Reversed;
    let anew = picture_of(format, SIZE, |target| pass.draw(target));
    let (mut prepared, _) = pass.count_prepare(SIZE, AnyDepth::D16, &mut room[..], &mut ());
    assert!(prepared.listed() > 0);
    assert!(picture_of(format, SIZE, |target| prepared.draw(target)) == anew);
    assert!(anew.0.iter().any(|&color| color != 0));
}

/// Targets of another size than the frame show what they have of it.
#[test]
fn what_is_prepared_for_another_frame_is_cut_off() {
    let soup = Soup::built_in("mesh");
    let mesh = soup.mesh(0..soup.triangles.len());
    let room = &mut vec![PreparedTriangle::EMPTY; soup.triangles.len()];
    let slots = &mut [Slot::EMPTY; 64];
    let mut pass = soup.pass(&mesh, slots);
    let whole = picture_of(AnyDepth::D16, SIZE, |target| pass.draw(target));
    let (mut prepared, _) = pass.count_prepare(SIZE, AnyDepth::D16, &mut room[..], &mut ());
    let turned = [HEIGHT, WIDTH];
    let found = picture_of(AnyDepth::D16, turned, |target| prepared.draw(target));
    let mut seen = 0;
    for place in 0..PIXELS {
        let [column, row] = [place % turned[0] as usize, place / turned[0] as usize];
        let is_shown = column < WIDTH as usize && row < HEIGHT as usize;
        let at = row * WIDTH as usize + column;
        let expected = if is_shown { (whole.0[at], whole.1[at]) } else { (0, AnyDepth::D16.farthest()) };
        assert_eq!((found.0[place], found.1[place]), expected, "{column}, {row}");
        seen += usize::from(is_shown && expected.0 != 0);
    }
    assert!(seen > 100, "{seen}");
}
