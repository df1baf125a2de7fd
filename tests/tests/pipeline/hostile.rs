//! Any bits in vertices, matrices and indices: no panic, no endless loop, nothing outside the viewport, no NaN in a
//! buffer.
//!
//! Seven kernels, each with another depth format, interpolation and stage: here types stay types.

use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::shaders::{Sunlit, Unlit, VertexColor};
use alberti::texture::{Bilinear, Mirror, Texture};
use alberti::{
    Affine, Cull, D16, D24, D32, DepthFormat, Exact, F32, F32Reversed, FixedPoint, FragmentStage, Frame,
    Interpolation, Lines, Mesh, NoDepth, Pass, Perspective, Planes, Point3, Rgba8, Rgba8888, Sides, Slot,
    Spans16, Sub4, Sub8, Subpixel, Target, Varying, Vector3, View, Viewport,
};
use alberti_tests::for_widest;
use alberti_tests::narrow::Narrow;
use alberti_tests::sweep::or_swept;
use proptest::prelude::*;

const WIDTH: u32 = 40;
const HEIGHT: u32 = 30;
const SENTINEL: u32 = 0xdead_beef;

/// A float of any bits, or one of those that go wrong first.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => any::<u32>().prop_map(f32::from_bits),
        4 => -4.0f32..4.0,
        2 => prop::sample::select(vec![
            0.0, -0.0, 1.0, -1.0, 0.1, 10.0, f32::MAX, f32::MIN, f32::MAX / 16.0, f32::MIN_POSITIVE, 1e-45,
            f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e9, 1e30, 16_777_217.0,
        ]),
    ]
}

fn numbers<const N: usize>() -> impl Strategy<Value = [f32; N]> {
    prop::collection::vec(number(), N).prop_map(|v| v.try_into().expect("N numbers"))
}

type Corner = ([f32; 3], [f32; 5]);

/// A mesh, mostly with a camera that makes sense and sometimes with any matrix at all.
#[derive(Clone, Debug)]
struct Case {
    corners: Vec<Corner>,
    triangles: Vec<[u32; 3]>,
    matrix: Option<[f32; 12]>,
    sides: Sides,
    cull: Cull,
}

fn case() -> impl Strategy<Value = Case> {
    let corner = (numbers::<3>(), numbers::<5>());
    (
        prop::collection::vec(corner, 3..8),
        prop::collection::vec(prop::array::uniform3(0u32..9), 1..6),
        prop::option::weighted(0.3, numbers::<12>()),
        prop::sample::select(vec![Sides::GuardBand, Sides::Cube]),
        prop::sample::select(vec![Cull::Back, Cull::Front, Cull::None]),
    )
        .prop_map(|(corners, triangles, matrix, sides, cull)| Case {
            corners,
            triangles,
            matrix,
            sides,
            cull,
        })
}

fn view(case: &Case, near: f32, far: f32) -> View {
    let to_eye = match case.matrix {
        None => Frame::at(Point3::new(Vec3::new(0.0, 0.0, 3.0))),
        Some(m) => {
            let column = |i: usize| Vec3::new(m[i], m[i + 1], m[i + 2]);
            Frame::from_mat3(Mat3::from_cols(column(0), column(3), column(6)), Point3::new(column(9)))
        }
    };
    View::new(to_eye, Perspective::new(1.0, 4.0 / 3.0, near, far).expect("a pyramid"))
}

/// The policies of a kernel: its depth format, its grid and its interpolation.
#[derive(Clone, Copy)]
struct Policies<D, S, P>(D, S, P);

/// Draws the case and looks at every pixel.
fn check<D: DepthFormat, V: Varying>(
    case: &Case,
    Policies(format, subpixel, interpolation): Policies<D, Subpixel, impl Interpolation>,
    planes: (f32, f32),
    varying: impl Fn(&[f32; 5]) -> V,
    fragment_stage: impl FragmentStage<V, Color = Rgba8>,
    sound: impl Fn(D::Stored) -> bool,
) {
    let mut color = vec![SENTINEL; (WIDTH * HEIGHT) as usize];
    let mut depth = vec![format.farthest(); color.len()];
    let mut target = Target::new(Rgba8888, format, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    let view = view(case, planes.0, planes.1);
    // Away from the frame's edges, so that pixels written outside show.
    let viewport = Viewport::new(5, 6, WIDTH - 12, HEIGHT - 11).expect("a viewport");
    let [columns, rows] = viewport.pixels();
    let place = |(p, v): &Corner| (Vec3::from_array(*p), varying(v));
    let mesh = Mesh::new(&case.corners, &case.triangles, place);
    let mut slots = [Slot::EMPTY; 4];
    let mut pass = Pass::new(&view, &mesh, Narrow(fragment_stage))
        .viewport(viewport)
        .cull(case.cull)
        .sides(case.sides)
        .interpolation(interpolation)
        .subpixel(subpixel)
        .slots(&mut slots);
    for_widest!(lanes => pass.draw_by(lanes, &mut target));
    let places = (0i32..).flat_map(|y| (0i32..).take(WIDTH as usize).map(move |x| (x, y)));
    for ((x, y), (&pixel, &stored)) in places.zip(color.iter().zip(&depth)) {
        assert!(sound(stored), "a depth of {stored:?} at {x}, {y}");
        assert!(
            pixel == SENTINEL || columns.contains(&x) && rows.contains(&y),
            "a pixel outside the viewport at {x}, {y}"
        );
    }
}

fn check_all(case: &Case) {
    let texels = [[1u8, 2, 3, 255], [200, 100, 50, 255], [9, 99, 199, 255]];
    let texture = Texture::new(Rgba8888, &texels, 3, 1).expect("a texture");
    let unlit = || Unlit(texture.sampler(Bilinear, Mirror));
    let uv = |v: &[f32; 5]| Vec2::new(v[0], v[1]);
    let unit = |d: f32| (0.0..=1.0).contains(&d);
    check(case, Policies(F32, Sub8, Exact), (0.1, 100.0), uv, unlit(), unit);
    check(case, Policies(F32Reversed, Sub4, Planes), (1e-3, 1e6), uv, unlit(), unit);
    check(
        case,
        Policies(D24, Sub8, FixedPoint(Spans16)),
        (1.0, 1.5),
        |v| Vec3::new(v[2], v[3], v[4]),
        VertexColor,
        |d| d <= D24.farthest(),
    );
    check(
        case,
        Policies(D16, Sub4, Lines::bounded(1e-3)),
        (1e-20, 8e17),
        |v| (Vec3::new(v[2], v[3], v[4]), uv(v)),
        Sunlit::new(unlit(), Vector3::new(Vec3::Y), 0.1, 0.9),
        |_| true,
    );
    check(
        case,
        Policies(D16, Sub4, FixedPoint(Lines::bounded(1e-3))),
        (1e-3, 1e3),
        |v| (Vec3::new(v[2], v[3], v[4]), uv(v)),
        Sunlit::new(unlit(), Vector3::new(Vec3::Y), 0.1, 0.9),
        |_| true,
    );
    check(
        case,
        Policies(D32, Sub8, FixedPoint(Affine)),
        (0.1, 1e9),
        |v| v[0],
        |x: f32| Some(Rgba8::from_bits(x.to_bits())),
        |_| true,
    );
    check(case, Policies(NoDepth, Sub8, Exact), (0.5, 3.4e37), |_| (), |()| Some(Rgba8::WHITE), |()| true);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: or_swept(25_000, 100_000), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_mesh_is_drawn_within_its_viewport_or_not_at_all(case in case()) {
        check_all(&case);
    }
}

/// Half of the random meshes above may be dropped whole; this one is not, which shows that the check can see pixels.
#[test]
fn a_sound_mesh_fills_the_viewport() {
    let far_out = |x: f32, y: f32| ([x, y, 0.0], [0.5; 5]);
    let case = Case {
        corners: vec![far_out(-1e4, -1e4), far_out(1e4, -1e4), far_out(0.0, 1e5)],
        triangles: vec![[0, 1, 2]],
        matrix: None,
        sides: Sides::GuardBand,
        cull: Cull::None,
    };
    check_all(&case);
    let count = std::cell::Cell::new(0);
    let counting = |(): ()| {
        count.set(count.get() + 1);
        Some(Rgba8::WHITE)
    };
    check(&case, Policies(NoDepth, Sub8, Exact), (0.5, 10.0), |_| (), counting, |()| true);
    assert_eq!(count.get(), (WIDTH - 12) * (HEIGHT - 11));
}
