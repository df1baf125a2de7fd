//! The same pixels however the work is divided: into bands, vertex slots, and with or without counting.

use alberti::glam::Vec2;
use alberti::shaders::Unlit;
use alberti::texture::{Bilinear, Repeat, Texture};
use alberti::{
    Band, ColorFormat, Cull, D16, DepthFormat, F32, NoDepth, Object, Pass, Point3, Rgb565Be, Rgb565Le, Rgba8,
    Sides, Slot, Stats, Store, Sub8, draw, glam::Vec3,
};
use alberti_app::draw::view;
use alberti_app::scene::Vertex;
use alberti_app::scenes::{BuiltIn, by_name};

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
