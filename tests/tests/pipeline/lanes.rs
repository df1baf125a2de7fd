//! One lane and as many as the machine has, on each kind of vector register that it has, give the same bits.
//!
//! Random triangles are drawn by a kernel for each kind of interpolation and numbers, with `AnyDepth` and `Lines`;
//! `values.rs` compares these with the policies that are types.
#![allow(clippy::cast_possible_truncation, reason = "random numbers within the range of what they become")]

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Floating, Lanes, Machine, One};
use alberti::shaders::{Sunlit, Tinted, Unlit, VertexColor};
use alberti::texture::{Bilinear, Mirror, Nearest, Repeat, Texture};
use alberti::{
    AnyDepth, ColorFormat, Cull, D16, DepthFormat, Exact, F32, Fixed, FixedPoint, FragmentStage, Fragments,
    Interpolation, Lines, Mesh, NoDerivatives, Pass, Planes, Rgb565Be, Rgba8, Rgba8888, Slot, Sub8, Target,
    Varying, Vector3, for_lanes,
};
use alberti_app::scene::{Image, Vertex};
use alberti_app::scenes::{BuiltIn, NAMES, by_name};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{Corner, Paint};
use alberti_tests::random::triangle;
use alberti_tests::reference::view;
use alberti_tests::sweep::or_swept;

/// Random triangles over each other: the colours have every bit of the varying.
fn random_frame<D: DepthFormat<Stored = u32>>(
    format: D,
    interpolation: impl Interpolation,
    lanes: impl Floating,
    triangles: Triangles<'_>,
) -> (Vec<u32>, Vec<u32>) {
    let mut color = vec![0; WIDTH * 70];
    let mut depth = vec![format.farthest(); color.len()];
    let mut target =
        Target::new(Rgba8888, format, WIDTH as u32, 70, &mut color, &mut depth).expect("a frame");
    target.clear(Rgba8::BLACK);
    triangles.draw(interpolation, lanes, &mut target);
    (color, depth)
}

/// A triangle on the screen.
type OnScreen = [alberti_raster::Vertex<Vec3>; 3];

/// Triangles, and the way to draw them.
#[derive(Clone, Copy)]
enum Triangles<'a> {
    OneByOne(&'a [OnScreen]),
    /// In a batch, where these, of so many in turn, have corners that are not kept.
    InBatches(&'a [OnScreen], usize),
}

impl Triangles<'_> {
    fn draw<D: DepthFormat>(
        self,
        interpolation: impl Interpolation,
        lanes: impl Floating,
        target: &mut Target<'_, Rgba8888, D>,
    ) {
        let stage = |v: Vec3| {
            let bits = v.to_array().map(f32::to_bits);
            (bits[0] & 7 != 3)
                .then(|| Rgba8::from_bits(bits[0] ^ bits[1].rotate_left(9) ^ bits[2].rotate_left(21)))
        };
        let paint = Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
        match self {
            Self::OneByOne(triangles) => {
                for [a, b, c] in triangles {
                    paint.triangle(lanes, target, [a, b, c], &mut ());
                }
            }
            Self::InBatches(triangles, passing) => {
                let numbers = paint.numbers(target.depth_format());
                let corners: Vec<_> = triangles
                    .iter()
                    .map(|t| t.each_ref().map(|vertex| Corner::new(numbers, vertex)))
                    .collect();
                let mut batch = paint.batch(lanes, target);
                for (i, [a, b, c]) in corners.iter().enumerate() {
                    if (i + 1) % passing == 0 {
                        let [a, b, c] = [*a, *b, *c];
                        batch.passing([&a, &b, &c], &mut ());
                    } else {
                        batch.triangle([a, b, c], &mut ());
                    }
                }
                batch.finish(&mut ());
            }
        }
    }
}

fn random(seed: u64) -> Vec<OnScreen> {
    let mut rng = Rng::new(seed);
    (0..TRIANGLES).map(|_| triangle(&mut rng)).collect()
}

const TRIANGLES: usize = 1000;
const WIDTH: usize = 101;

fn random_triangles<D: DepthFormat<Stored = u32>>(format: D, interpolation: impl Interpolation, stream: u64) {
    // Ten million triangles take some minutes: `cargo xtask sweep`.
    let frames = or_swept(40, 2500);
    for part in 0..frames {
        let triangles = random(run_seed() ^ part ^ stream << 32);
        let one = random_frame(format, interpolation, One, Triangles::OneByOne(&triangles));
        let drawn = one.0.iter().filter(|&&p| p != Rgba8::BLACK.to_bits().to_le()).count();
        assert!(drawn > 3000, "next to nothing was drawn");
        // Batches of as many as there are lanes, or of fewer where one passes, down to one.
        let passing = [usize::MAX, 23, 5, 2][part as usize / 2 % 4];
        let several = if part % 2 == 0 {
            Triangles::OneByOne(&triangles)
        } else {
            Triangles::InBatches(&triangles, passing)
        };
        for machine in Machine::all() {
            let several = for_lanes!(machine, lanes => random_frame(format, interpolation, lanes, several));
            assert!(one == several, "{interpolation:?}, {machine:?}, frame {part}");
        }
    }
}

#[test]
fn random_triangles_with_exact_interpolation() {
    random_triangles(AnyDepth::F32, Exact, 1);
    random_triangles(AnyDepth::D16, Exact, 2);
}

#[test]
fn random_triangles_with_planes() {
    random_triangles(AnyDepth::F32Reversed, Planes, 3);
    random_triangles(AnyDepth::D24, Planes, 4);
}

#[test]
fn random_triangles_with_straight_lines() {
    random_triangles(AnyDepth::F32, spans(8), 5);
    random_triangles(AnyDepth::D32, spans(32), 6);
    random_triangles(AnyDepth::NoDepth, Lines::affine(), 7);
    random_triangles(AnyDepth::F32, Lines::bounded(0.01), 12);
}

/// One sample at a time whatever the machine has.
#[test]
fn random_triangles_in_fixed_point() {
    random_triangles(AnyDepth::D16, FixedPoint(spans(16)), 13);
    random_triangles(AnyDepth::D32, FixedPoint(Lines::bounded(0.01)), 14);
    random_triangles(AnyDepth::F32, FixedPoint(Lines::affine()), 15);
}

/// The frame in pieces: bands of some rows, each in scissors of some columns, which begin in the middle of runs.
#[test]
fn pieces_of_a_frame_are_the_frame() {
    pieces(Exact, 8);
    pieces(Planes, 9);
    pieces(spans(16), 10);
    pieces(Lines::affine(), 11);
    pieces(Lines::bounded(0.01), 16);
    pieces(FixedPoint(spans(8)), 17);
    pieces(FixedPoint(Lines::bounded(0.01)), 18);
    pieces(FixedPoint(Lines::affine()), 19);
}

/// Boxes of every size in pixels, from parts of one to thousands: below and above the widths and heights from which
/// triangles are filled in another way.
#[test]
fn boxes_of_all_sizes() {
    let sizes = || (0..=40).chain([63, 64, 65, 127, 128, 129, 255, 257, 511, 513, 1025, 2047, 4000]);
    let (mut drawn, mut rng) = (0, Rng::stream(run_seed(), 20));
    for (w, h) in sizes().flat_map(|w| sizes().map(move |h| (w, h))) {
        let triangles: Vec<_> = (0..or_swept(3, 400)).map(|_| boxed(&mut rng, [w, h])).collect();
        let frame = |lanes: &dyn Fn(&mut Target<'_, Rgba8888, AnyDepth>)| {
            // The upper left corner of large ones, or a strip through their middle.
            let (size, first) = ([WIDTH as u32, 4200], if h > 200 { h.unsigned_abs() / 2 } else { 0 });
            let (mut color, mut depth) = (vec![0; WIDTH * 70], vec![AnyDepth::F32.farthest(); WIDTH * 70]);
            let band = Target::band(Rgba8888, AnyDepth::F32, size, first, &mut color, &mut depth);
            lanes(&mut band.expect("rows"));
            (color, depth)
        };
        let one = frame(&|target| Triangles::OneByOne(&triangles).draw(Exact, One, target));
        drawn += u32::from(one.0.iter().any(|&pixel| pixel != 0));
        for machine in Machine::all() {
            let several = Triangles::InBatches(&triangles, if h % 2 == 0 { usize::MAX } else { 3 });
            let several = frame(&|target| {
                for_lanes!(machine, lanes => several.draw(Exact, lanes, target));
            });
            assert!(one == several, "boxes of {w} x {h}: {machine:?}");
        }
    }
    assert!(drawn > 2000, "{drawn} sizes drawn");
}

/// A triangle whose box has these sides, up to a pixel, with its upper left corner in the frame or to the left of it.
fn boxed(rng: &mut Rng, size: [i32; 2]) -> OnScreen {
    let sides = size.map(|pixels| pixels * 256 + rng.range(-255, 255).max(-i64::from(pixels) * 256) as i32);
    let left = rng.range(-256 * i64::from(size[0].min(60)), 256 * 90) as i32;
    let corner = [left, rng.range(0, 256 * 40) as i32];
    let along = sides.map(|side| [(); 2].map(|()| rng.range(0, side.into()) as i32));
    let [[x, _], [y, z]] = along;
    // Each side of the box has a corner of the triangle: two are in corners of the box, or each is somewhere on a side.
    let mut places = if rng.one_in(2) { [[0, 0], sides, [x, y]] } else { [[0, y], [sides[0], z], [x, 0]] };
    if places[2][1] == 0 {
        places[rng.index(2)][1] = sides[1];
    }
    places.rotate_left(rng.index(3));
    places.map(|place| {
        let [x, y] =
            [0, 1].map(|k| Fixed::from_subpixels(corner[k] + place[k]).expect("within the guard band"));
        let varying = Vec3::from_array([(); 3].map(|()| rng.uniform(-1.0, 1.0) as f32));
        alberti_raster::Vertex { x, y, zs: rng.unit() as f32, q: rng.log_uniform(1e-3, 1e3), varying }
    })
}

fn spans(length: i32) -> Lines {
    Lines::spans(length).expect("a power of two")
}

fn pieces(interpolation: impl Interpolation, stream: u64) {
    let machine = Machine::all().next().expect("every machine has lanes");
    for part in 0..20 {
        let triangles = random(run_seed() ^ part ^ stream << 32);
        let whole = random_frame(AnyDepth::F32, interpolation, One, Triangles::OneByOne(&triangles));
        let (mut color, mut depth) = (vec![0; whole.0.len()], vec![0; whole.0.len()]);
        for (piece, rows) in [0..9, 9..10, 10..43, 43..70].into_iter().enumerate() {
            let range = rows.start * WIDTH..rows.end * WIDTH;
            let (color, depth) = (&mut color[range.clone()], &mut depth[range]);
            let (size, first) = ([WIDTH as u32, 70], rows.start as u32);
            let mut band = Target::band(Rgba8888, AnyDepth::F32, size, first, color, depth).expect("rows");
            band.clear(Rgba8::BLACK);
            for columns in [[0, 13, 101], [0, 64, 101], [0, 3, 101], [0, 99, 101]][piece].windows(2) {
                let mut scissor = band.scissor(columns[0]..columns[1], 0..i32::MAX);
                let several = Triangles::InBatches(&triangles, 23);
                for_lanes!(machine, lanes => several.draw(interpolation, lanes, &mut scissor));
            }
        }
        assert!(whole == (color, depth), "{interpolation:?}, frame {part}");
    }
}

/// One mesh of a built-in scene, drawn with given lanes, shading and format.
struct Shot<'a> {
    scene: &'a BuiltIn,
    triangles: &'a [[u32; 3]],
}

impl Shot<'_> {
    fn take<C, D, V, F>(
        &self,
        formats: (C, D),
        lanes: impl Floating,
        interpolation: impl Interpolation,
        vertex_stage: impl Fn(&Vertex) -> (Vec3, V),
        fragment_stage: F,
    ) -> (Vec<C::Pixel>, Vec<D::Stored>)
    where
        C: ColorFormat<Pixel: Default + PartialEq>,
        D: DepthFormat<Stored: PartialEq>,
        V: Varying,
        F: FragmentStage<V, Color = Rgba8>,
    {
        let (width, height) = (253, 190);
        let vertices = &self.scene.model.vertices;
        let mut color = vec![C::Pixel::default(); (width * height) as usize];
        let mut depth = vec![formats.1.farthest(); color.len()];
        let mut target =
            Target::new(formats.0, formats.1, width, height, &mut color, &mut depth).expect("a frame");
        let (view, mesh) =
            (view(&self.scene.camera).expect("a view"), Mesh::new(vertices, self.triangles, vertex_stage));
        Pass::new(&view, &mesh, fragment_stage)
            .cull(Cull::None)
            .interpolation(interpolation)
            .slots(&mut vec![Slot::EMPTY; vertices.len()])
            .draw_by(lanes, &mut target);
        (color, depth)
    }

    fn coloured(&self, lanes: impl Floating) -> (Vec<u16>, Vec<f32>) {
        let vertex = |v: &Vertex| (position(v), Vec3::from_array(v.color));
        self.take((Rgb565Be, F32), lanes, Planes, vertex, VertexColor)
    }

    /// Every wide stage at once: lit, tinted, textured.
    fn lit(
        &self,
        texels: impl FragmentStage<Vec2, Color = Rgba8>,
        lanes: impl Floating,
    ) -> (Vec<u32>, Vec<u16>) {
        let vertex = |v: &Vertex| (position(v), (Vec3::from_array(v.normal), Vec2::from_array(v.uv)));
        let light = Vector3::new(Vec3::new(0.3, 0.8, -0.5));
        let surface = Tinted { surface: texels, tint: Rgba8::new(250, 130, 70, 255) };
        self.take((Rgba8888, D16), lanes, Exact, vertex, Sunlit::new(surface, light, 0.2, 0.8))
    }

    fn mirrored(&self, lanes: impl Floating, image: &Image) -> (Vec<u32>, Vec<u16>) {
        self.lit(Unlit(texture(image).sampler(Nearest, Mirror)), lanes)
    }

    fn filtered(&self, lanes: impl Floating, image: &Image) -> (Vec<u32>, Vec<u16>) {
        let texture = texture(image);
        match texture.power_of_two() {
            Some(texture) => self.lit(Unlit(texture.sampler(Bilinear, Repeat)), lanes),
            None => self.lit(Unlit(texture.sampler(Bilinear, Repeat)), lanes),
        }
    }
}

fn texture(image: &Image) -> Texture<'_, Rgba8888> {
    Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture")
}

fn position(v: &Vertex) -> Vec3 {
    Vec3::from_array(v.position)
}

/// A colour for all samples, asked for or not.
#[derive(Clone, Copy)]
struct Everywhere;

impl FragmentStage<()> for Everywhere {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, ()>) -> (L::U32, L::Mask) {
        let Fragments { lanes, mask, .. } = *fragments;
        (lanes.word(Rgba8::WHITE.to_bits()), mask | !mask)
    }
}

/// A stage that keeps more than it is asked for draws no more.
#[test]
fn stages_cannot_paint_beside_their_masks() {
    let corners = [Vec3::new(-0.9, -0.7, 0.0), Vec3::new(0.8, -0.9, 0.0), Vec3::new(0.1, 0.9, 0.0)];
    let mesh = Mesh::new(&corners, &[[0u16, 1, 2]], |&corner| (corner, ()));
    let camera = alberti::Camera::look_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y).expect("a camera");
    let view = camera.perspective(1.0, 0.1..10.0).expect("a view");
    let drawn = |lanes: &dyn Fn(&mut Target<'_, Rgba8888, F32>)| {
        let (mut color, mut depth) = (vec![0; 64 * 48], vec![1.0; 64 * 48]);
        lanes(&mut Target::new(Rgba8888, F32, 64, 48, &mut color, &mut depth).expect("a frame"));
        (color, depth.into_iter().map(f32::to_bits).collect::<Vec<_>>())
    };
    let modest = |(): ()| Some(Rgba8::WHITE);
    let expected = drawn(&|target| Pass::new(&view, &mesh, modest).draw_by(One, target));
    assert!(expected.0.iter().filter(|&&pixel| pixel != 0).count() > 500);
    for machine in Machine::all() {
        for_lanes!(machine, lanes => {
            let found = drawn(&|target| Pass::new(&view, &mesh, Everywhere).draw_by(lanes, target));
            assert!(found == expected, "{lanes:?}");
        });
    }
}

#[test]
fn all_scenes() {
    // A texture whose sides are no powers of two, for the scenes that have none or others.
    let mut rng = Rng::new(7);
    let texels = (0..37 * 50).map(|_| (rng.u64() as u32).to_le_bytes()).collect();
    let odd = Image { texels, width: 37, height: 50 };
    let mut shots = 0;
    for name in NAMES {
        let scene = by_name(name).expect("a built-in scene");
        for part in &scene.model.parts {
            let shot = Shot { scene: &scene, triangles: &part.triangles };
            let image = part.texture.map_or(&odd, |t| &scene.model.textures[t]);
            let one = (shot.coloured(One), shot.mirrored(One, &odd), shot.filtered(One, image));
            for machine in Machine::all() {
                let several = for_lanes!(machine, lanes => (
                    shot.coloured(lanes),
                    shot.mirrored(lanes, &odd),
                    shot.filtered(lanes, image),
                ));
                assert!(one == several, "{name}, {machine:?}");
                shots += 1;
            }
        }
    }
    assert!(shots >= 7);
}
