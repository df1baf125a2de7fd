//! One lane and as many as the machine has, on each kind of vector register that it has, give the same bits.
#![allow(clippy::cast_possible_truncation, reason = "random numbers within the range of what they become")]

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Floating, Machine, One};
use alberti::shaders::{Lambert, Tinted, Unlit, VertexColor};
use alberti::texture::{Bilinear, Filter, Mirror, Nearest, Repeat, Texture, Wrap};
use alberti::{
    Affine, Band, Bounded, Cull, D16, D24, D32, DepthFormat, Exact, F32, F32Reversed, Fixed, FixedPoint,
    FragmentStage, Interpolation, NoDepth, Object, OrEqual, Pass, Plane, Point3, Rgb565Be, Rgba8, Sides,
    Slot, Spans, Store, Sub8, Vector3, VertexStage, draw_by, for_lanes,
};
use alberti_app::draw::view;
use alberti_app::scene::{Image, Vertex};
use alberti_app::scenes::{BuiltIn, NAMES, by_name};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::draw_triangle;

/// A random triangle in or about a small frame, often thin, sometimes a sliver as high as the guard band, with a wide
/// range of depths.
fn triangle(rng: &mut Rng) -> [alberti_raster::Vertex<Sub8, Vec3>; 3] {
    let center = [rng.uniform(-20.0, 120.0), rng.uniform(-20.0, 90.0)];
    let size = f64::from(rng.log_uniform(0.5, 4000.0));
    let size = if rng.one_in(8) { [f64::from(rng.log_uniform(0.3, 20.0)), 30_000.0] } else { [size; 2] };
    std::array::from_fn(|_| {
        let mut at = |axis: usize| {
            let pixels = center[axis] + rng.uniform(-size[axis], size[axis]);
            Fixed::from_subpixels((pixels * 256.0) as i32).expect("within the guard band")
        };
        let (x, y) = (at(0), at(1));
        let mut component = || rng.uniform(-1.0, 1.0) as f32;
        let varying = Vec3::new(component(), component(), component());
        alberti_raster::Vertex { x, y, zs: rng.unit() as f32, q: rng.log_uniform(1e-6, 1e3), varying }
    })
}

/// Random triangles over each other: the colours have every bit of the varying.
fn random_frame<D: DepthFormat<Stored: PartialEq>>(
    interpolation: impl Interpolation,
    lanes: impl Floating,
    seed: u64,
) -> (Vec<u32>, Vec<D::Stored>) {
    let mut color = vec![0; WIDTH * 70];
    let mut depth = vec![D::FARTHEST; color.len()];
    let mut band = Band::<Rgba8, D>::new(WIDTH as u32, 0, &mut color, &mut depth).expect("whole rows");
    band.clear(Rgba8::BLACK);
    draw_random(interpolation, lanes, &mut band, seed);
    (color, depth)
}

fn draw_random<D: DepthFormat>(
    interpolation: impl Interpolation,
    lanes: impl Floating,
    band: &mut Band<'_, Rgba8, D>,
    seed: u64,
) {
    let shader = |v: Vec3| {
        let bits = v.to_array().map(f32::to_bits);
        (bits[0] & 7 != 3)
            .then(|| Rgba8::from_bits(bits[0] ^ bits[1].rotate_left(9) ^ bits[2].rotate_left(21)))
    };
    let mut rng = Rng::new(seed);
    for _ in 0..TRIANGLES {
        let [a, b, c] = &triangle(&mut rng);
        draw_triangle(interpolation, lanes, band, [a, b, c], Cull::None, &shader, &mut ());
    }
}

const TRIANGLES: usize = 1000;
const WIDTH: usize = 101;

fn random_triangles<D: DepthFormat<Stored: PartialEq>>(interpolation: impl Interpolation, stream: u64) {
    // Ten million triangles take some minutes: `cargo xtask sweep`.
    let frames = if std::env::var_os("ALBERTI_SWEEP").is_some() { 2500 } else { 60 };
    for part in 0..frames {
        let seed = run_seed() ^ part ^ stream << 32;
        let one = random_frame::<D>(interpolation, One, seed);
        let drawn = one.0.iter().filter(|&&p| p != Rgba8::BLACK.to_bits().to_le()).count();
        assert!(drawn > 3000, "next to nothing was drawn");
        for machine in Machine::all() {
            let several = for_lanes!(machine, lanes => random_frame::<D>(interpolation, lanes, seed));
            assert!(one == several, "{interpolation:?}, {machine:?}, frame {part}");
        }
    }
}

#[test]
fn random_triangles_with_exact_interpolation() {
    random_triangles::<F32>(Exact, 1);
    random_triangles::<D16>(Exact, 2);
}

#[test]
fn random_triangles_with_planes() {
    random_triangles::<F32Reversed>(Plane, 3);
    random_triangles::<D24>(Plane, 4);
}

#[test]
fn random_triangles_with_straight_lines() {
    random_triangles::<OrEqual<F32>>(Spans::<8>, 5);
    random_triangles::<D32>(Spans::<32>, 6);
    random_triangles::<NoDepth>(Affine, 7);
    random_triangles::<F32>(Bounded { budget: 0.01 }, 12);
}

/// One sample at a time whatever the machine has: this is about what bands and other machines may not change.
#[test]
fn random_triangles_in_fixed_point() {
    random_triangles::<D16>(FixedPoint(Spans::<16>), 13);
    random_triangles::<D32>(FixedPoint(Bounded { budget: 0.01 }), 14);
    random_triangles::<F32>(FixedPoint(Affine), 15);
}

/// The frame in pieces: bands of some rows, each in scissors of some columns, which begin in the middle of runs.
#[test]
fn pieces_of_a_frame_are_the_frame() {
    pieces(Exact, 8);
    pieces(Plane, 9);
    pieces(Spans::<16>, 10);
    pieces(Affine, 11);
    pieces(Bounded { budget: 0.01 }, 16);
    pieces(FixedPoint(Spans::<8>), 17);
    pieces(FixedPoint(Bounded { budget: 0.01 }), 18);
    pieces(FixedPoint(Affine), 19);
}

fn pieces(interpolation: impl Interpolation, stream: u64) {
    let machine = Machine::all().next().expect("every machine has lanes");
    for part in 0..20 {
        let seed = run_seed() ^ part ^ stream << 32;
        let whole = random_frame::<F32>(interpolation, One, seed);
        let (mut color, mut depth) = (vec![0; whole.0.len()], vec![1.0; whole.0.len()]);
        for (piece, rows) in [0..9, 9..10, 10..43, 43..70].into_iter().enumerate() {
            let range = rows.start * WIDTH..rows.end * WIDTH;
            let (color, depth) = (&mut color[range.clone()], &mut depth[range]);
            let mut band =
                Band::<Rgba8, F32>::new(WIDTH as u32, rows.start as u32, color, depth).expect("rows");
            band.clear(Rgba8::BLACK);
            for columns in [[0, 13, 101], [0, 64, 101], [0, 3, 101], [0, 99, 101]][piece].windows(2) {
                let mut scissor = band.scissor(columns[0]..columns[1], 0..i32::MAX);
                for_lanes!(machine, lanes => draw_random(interpolation, lanes, &mut scissor, seed));
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
    fn take<C, D, F, Vs>(
        &self,
        lanes: impl Floating,
        interpolation: impl Interpolation,
        vertex_stage: Vs,
        fragment_stage: F,
    ) -> (Vec<C::Pixel>, Vec<D::Stored>)
    where
        C: Store<Rgba8, Pixel: Default + PartialEq>,
        D: DepthFormat<Stored: PartialEq>,
        Vs: VertexStage<Vertex>,
        F: FragmentStage<Vs::Varying, Color = Rgba8>,
    {
        let (width, height) = (253, 190);
        let vertices = &self.scene.model.vertices;
        let mut color = vec![C::Pixel::default(); (width * height) as usize];
        let mut depth = vec![D::FARTHEST; color.len()];
        let mut band = Band::<C, D>::new(width, 0, &mut color, &mut depth).expect("whole rows");
        let pass = Pass {
            view: view(&self.scene.camera, width, height).expect("a view"),
            vertices,
            triangles: self.triangles,
            vertex_stage,
            fragment_stage,
            cull: Cull::None,
            sides: Sides::GuardBand,
            interpolation,
        };
        draw_by(lanes, &pass, &mut band, &mut vec![Slot::<Sub8, _>::EMPTY; vertices.len()], &mut ());
        (color, depth)
    }

    fn coloured(&self, lanes: impl Floating) -> (Vec<u16>, Vec<f32>) {
        let vertex = |v: &Vertex| (position(v), Vec3::from_array(v.color));
        self.take::<Rgb565Be, F32, _, _>(lanes, Plane, vertex, VertexColor)
    }

    /// Every wide stage at once: lit, tinted, textured.
    fn textured<Fl: Filter, W: Wrap>(&self, lanes: impl Floating, image: &Image) -> (Vec<u32>, Vec<u16>) {
        let texture = Texture::<Rgba8>::new(&image.texels, image.width, image.height).expect("a texture");
        let vertex = |v: &Vertex| (position(v), (Vec3::from_array(v.normal), Vec2::from_array(v.uv)));
        let light = Vector3::new(Vec3::new(0.3, 0.8, -0.5));
        let tint = Rgba8::new(250, 130, 70, 255);
        match texture.power_of_two() {
            Some(texture) => {
                let surface = Tinted { surface: Unlit(texture.sampler::<Fl, W>()), tint };
                self.take::<Rgba8, D16, _, _>(lanes, Exact, vertex, Lambert::new(surface, light, 0.2, 0.8))
            }
            None => {
                let surface = Tinted { surface: Unlit(texture.sampler::<Fl, W>()), tint };
                self.take::<Rgba8, D16, _, _>(lanes, Exact, vertex, Lambert::new(surface, light, 0.2, 0.8))
            }
        }
    }
}

fn position(v: &Vertex) -> Point3<Object> {
    Point3::new(Vec3::from_array(v.position))
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
            let one = (
                shot.coloured(One),
                shot.textured::<Nearest, Mirror>(One, &odd),
                shot.textured::<Bilinear, Repeat>(One, image),
            );
            for machine in Machine::all() {
                let several = for_lanes!(machine, lanes => (
                    shot.coloured(lanes),
                    shot.textured::<Nearest, Mirror>(lanes, &odd),
                    shot.textured::<Bilinear, Repeat>(lanes, image),
                ));
                assert!(one == several, "{name}, {machine:?}");
                shots += 1;
            }
        }
    }
    assert!(shots >= 7);
}
