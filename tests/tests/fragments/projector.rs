//! The image of a projector on a scene, against rays in f64: from the eye through a pixel's centre to the surface, from
//! there into the projector's pyramid.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and texels are few"
)]

use alberti::glam::Vec3;
use alberti::lanes::{Floating, Lanes, Machine, One, OneFixed};
use alberti::shaders::{Mix, Slide, Solid};
use alberti::texture::{Bilinear, Clamp, Filter, Nearest, Texture};
use alberti::{
    Cull, Eye, Frame, Homogeneous, Mesh, NoDepth, Pass, Perspective, Point3, Projector, Q16, Rgba8, Rgba8888,
    Stats, Target, Vector3, View, World, for_lanes, look_at,
};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::narrow::Narrow;

const WIDTH: usize = 160;
const HEIGHT: usize = 120;
/// Texels of the image, each of its own colour.
const IMAGE: [usize; 2] = [8, 4];
const SURFACE: Rgba8 = Rgba8::WHITE;

type Vector = [f64; 3];

fn sub(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Vector) -> Vector {
    a.map(|c| c / dot(a, a).sqrt())
}

/// An eye, or a projector: the same pyramid.
#[derive(Clone, Copy, Debug)]
struct Pyramid {
    eye: Vector,
    target: Vector,
    fov: f64,
    aspect: f64,
}

impl Pyramid {
    fn axes(&self) -> [Vector; 3] {
        let forward = unit(sub(self.target, self.eye));
        let right = unit(cross(forward, [0.0, 1.0, 0.0]));
        [right, cross(right, forward), forward]
    }

    fn scale(&self) -> [f64; 2] {
        let cot = 1.0 / (self.fov / 2.0).tan();
        [cot / self.aspect, cot]
    }

    /// (u q, v q, q) of a point.
    fn project(&self, point: Vector) -> Vector {
        let ([right, up, forward], [x, y]) = (self.axes(), self.scale());
        let p = sub(point, self.eye);
        [x * dot(p, right), y * dot(p, up), dot(p, forward)]
    }

    /// The point of the plane through `triangle` that is seen at (u, v), and its depth.
    fn hit(&self, [u, v]: [f64; 2], [a, b, c]: [Vector; 3]) -> (Vector, f64) {
        let ([right, up, forward], [x, y]) = (self.axes(), self.scale());
        let ray = [0, 1, 2].map(|k| right[k] * u / x + up[k] * v / y + forward[k]);
        let normal = cross(sub(b, a), sub(c, a));
        let z = dot(sub(a, self.eye), normal) / dot(ray, normal);
        ([0, 1, 2].map(|k| self.eye[k] + z * ray[k]), z)
    }

    fn place(&self) -> Frame<Eye, World> {
        let at = |p: Vector| Point3::new(narrow(p));
        look_at(at(self.eye), at(self.target), Vector3::new(Vec3::Y)).expect("a place")
    }

    fn projector(&self) -> Projector {
        Projector::new(self.place(), self.fov as f32, self.aspect as f32).expect("a projector")
    }

    fn view(&self) -> View {
        let projection = Perspective::new(self.fov as f32, self.aspect as f32, NEAR, 1000.0);
        View::new(self.place().inverse_orthonormal(), projection.expect("a pyramid"))
    }
}

const NEAR: f32 = 0.01;

fn narrow(p: Vector) -> Vec3 {
    Vec3::from_array(p.map(|c| c as f32))
}

fn color(texel: usize) -> [u8; 4] {
    [texel as u8, 200 - texel as u8, 7 * texel as u8, 255]
}

fn texels() -> Vec<[u8; 4]> {
    (0..IMAGE[0] * IMAGE[1]).map(color).collect()
}

/// One triangle, seen from `camera`, with the image of `projector` on it; black where it is not.
fn shot(
    filter: impl Filter,
    lanes: impl Floating,
    triangle: &[Vector; 3],
    camera: &Pyramid,
    place: impl Fn(Vec3) -> Homogeneous,
) -> (Vec<[u8; 4]>, Stats) {
    let texels = texels();
    let image = Texture::new(Rgba8888, &texels, IMAGE[0] as u32, IMAGE[1] as u32).expect("texels");
    let vertices = triangle.map(narrow);
    let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |&p| (p, (place(p), ())));
    let stage = Slide { surface: Solid(SURFACE), image: image.sampler(filter, Clamp), mix: Mix::Modulate };
    let (mut color, mut depth) = (vec![0; WIDTH * HEIGHT], vec![(); WIDTH * HEIGHT]);
    let (width, height) = (WIDTH as u32, HEIGHT as u32);
    let mut target = Target::new(Rgba8888, NoDepth, width, height, &mut color, &mut depth).expect("a frame");
    let (view, mut stats) = (camera.view(), Stats::default());
    Pass::new(&view, &mesh, Narrow(stage)).cull(Cull::None).count_by(lanes, &mut target, &mut stats);
    (color.into_iter().map(u32::to_ne_bytes).collect(), stats)
}

/// The share of a projector in a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shown {
    Behind,
    Beside,
    Texel(usize),
}

/// That at a place of the screen, in pixels.
fn shown(at: [f64; 2], triangle: &[Vector; 3], camera: &Pyramid, projector: &Pyramid) -> Shown {
    let window = [2.0 * at[0] / WIDTH as f64 - 1.0, 1.0 - 2.0 * at[1] / HEIGHT as f64];
    let (point, _) = camera.hit(window, *triangle);
    let [u, v, q] = projector.project(point);
    if q <= 0.0 {
        Shown::Behind
    } else if u.abs() >= q || v.abs() >= q {
        Shown::Beside
    } else {
        // Rows from the top.
        let column = ((u / q + 1.0) / 2.0 * IMAGE[0] as f64) as usize;
        let row = ((1.0 - v / q) / 2.0 * IMAGE[1] as f64) as usize;
        Shown::Texel(row * IMAGE[0] + column)
    }
}

/// How many pixels were compared that show no image for being behind, for being beside it, and that show one.
#[derive(Debug, Default)]
struct Count {
    behind: usize,
    beside: usize,
    lit: usize,
    /// So close to a border, of a texel or of the image, that snapped vertices may show either side.
    open: usize,
    wrong: usize,
}

fn compare(
    picture: &[[u8; 4]],
    triangle: &[Vector; 3],
    camera: &Pyramid,
    projector: &Pyramid,
    count: &mut Count,
) {
    /// Eight times the most that snapping may move a vertex by.
    const MOVED: f64 = 1.0 / 64.0;
    for (i, &pixel) in picture.iter().enumerate().filter(|(_, p)| p[3] != 0) {
        let centre = [(i % WIDTH) as f64 + 0.5, (i / WIDTH) as f64 + 0.5];
        let at = |dx: f64, dy: f64| shown([centre[0] + dx, centre[1] + dy], triangle, camera, projector);
        let here = at(0.0, 0.0);
        let around = [(-MOVED, -MOVED), (MOVED, -MOVED), (-MOVED, MOVED), (MOVED, MOVED)];
        if around.iter().any(|&(dx, dy)| at(dx, dy) != here) {
            count.open += 1;
            // Even so, nothing behind the projector is lit.
            let behind = around.iter().all(|&(dx, dy)| at(dx, dy) == Shown::Behind);
            assert!(!behind || pixel == SURFACE.to_bytes());
            continue;
        }
        let expected = match here {
            Shown::Behind => {
                count.behind += 1;
                SURFACE.to_bytes()
            }
            Shown::Beside => {
                count.beside += 1;
                SURFACE.to_bytes()
            }
            Shown::Texel(texel) => {
                count.lit += 1;
                color(texel)
            }
        };
        count.wrong += usize::from(pixel != expected);
    }
}

/// A floor that goes on under the eye and behind it, and under the projector and behind that: the planes of both cut
/// its triangle, and where the projector would show its image upside down in its back, it stays dark.
#[test]
fn a_floor_under_the_camera_and_behind_the_projector() {
    let floor = [[-40.0, 0.0, -30.0], [45.0, 0.0, -35.0], [3.0, 0.0, 50.0]];
    // Towards the projector, which throws its image at the feet of the camera.
    let camera = Pyramid { eye: [0.0, 2.0, 4.0], target: [0.3, 0.2, 0.0], fov: 1.2, aspect: 4.0 / 3.0 };
    let projector = Pyramid { eye: [0.5, 1.0, 0.5], target: [0.0, 0.2, 2.0], fov: 1.0, aspect: 2.0 };
    for (seer, name) in [(&camera, "camera"), (&projector, "projector")] {
        let before = floor.iter().filter(|p| seer.project(**p)[2] > 0.0).count();
        assert!(before == 1 || before == 2, "the plane of the {name} cuts the floor");
    }
    let thrown = projector.projector();
    let (picture, stats) = shot(Nearest, One, &floor, &camera, |p| thrown.project(Point3::new(p)));
    let mut count = Count::default();
    compare(&picture, &floor, &camera, &projector, &mut count);
    println!("{count:?} {stats:?}");
    assert_eq!((stats.clipped, count.wrong), (1, 0));
    assert!(count.lit > 1000 && count.behind > 1000 && count.beside > 1000 && count.open < 1000);

    // Divided before it is interpolated, the image is elsewhere, and behind the projector as well.
    let early = |p: Vec3| {
        let Homogeneous { u, v, q } = thrown.project(Point3::new(p));
        Homogeneous { u: u / q, v: v / q, q: 1.0 }
    };
    let mut count = Count::default();
    compare(&shot(Nearest, One, &floor, &camera, early).0, &floor, &camera, &projector, &mut count);
    println!("divided too early: {count:?}");
    assert!(count.wrong > 1000);
}

/// Triangles anywhere, often across the planes of the camera and of the projector.
#[test]
fn any_triangle_under_any_projector() {
    let mut rng = Rng::stream(run_seed(), 1);
    let (mut count, mut across) = (Count::default(), 0);
    for _ in 0..200 {
        let mut anywhere = |most: f64| [(); 3].map(|()| f64::from(rng.uniform(-most, most) as f32));
        let camera = Pyramid { eye: anywhere(3.0), target: anywhere(1.0), fov: 1.1, aspect: 4.0 / 3.0 };
        let mut projector = Pyramid { eye: anywhere(3.0), target: anywhere(1.0), fov: 0.0, aspect: 0.0 };
        (projector.fov, projector.aspect) = (rng.uniform(0.2, 2.5), rng.uniform(0.5, 2.0));
        let mut anywhere = |most: f64| [(); 3].map(|()| f64::from(rng.uniform(-most, most) as f32));
        let triangle = [(); 3].map(|()| anywhere(8.0));
        // Seen from the side, a hundredth of a pixel is far on the surface.
        let normal = unit(cross(sub(triangle[1], triangle[0]), sub(triangle[2], triangle[0])));
        if dot(sub(triangle[0], camera.eye), normal).abs() < 0.5 {
            continue;
        }
        let thrown = projector.projector();
        let (picture, _) = shot(Nearest, One, &triangle, &camera, |p| thrown.project(Point3::new(p)));
        compare(&picture, &triangle, &camera, &projector, &mut count);
        let cut = |seer: &Pyramid| {
            (1..3).contains(&triangle.iter().filter(|p| seer.project(**p)[2] > f64::from(NEAR)).count())
        };
        across += usize::from(cut(&camera) && cut(&projector));
    }
    println!("{count:?}, {across} triangles across both planes");
    assert_eq!(count.wrong, 0);
    assert!(count.lit > 20_000 && count.behind > 20_000 && across > 20);
    assert!(count.open * 5 < count.lit, "{count:?}");
}

/// The same bits, however many samples are shaded at a time.
#[test]
fn one_lane_and_several() {
    let mut rng = Rng::stream(run_seed(), 2);
    for _ in 0..60 {
        let mut anywhere = |most: f64| [(); 3].map(|()| f64::from(rng.uniform(-most, most) as f32));
        let camera = Pyramid { eye: anywhere(3.0), target: anywhere(1.0), fov: 1.1, aspect: 4.0 / 3.0 };
        let projector =
            Pyramid { eye: anywhere(3.0), target: anywhere(1.0), fov: 1.0, aspect: 1.5 }.projector();
        let triangle = [(); 3].map(|()| anywhere(8.0));
        let place = |p| projector.project(Point3::new(p));
        let one = shot(Bilinear, One, &triangle, &camera, place);
        for machine in Machine::all() {
            let several = for_lanes!(machine, lanes => shot(Bilinear, lanes, &triangle, &camera, place));
            assert!(one == several, "{machine:?}: {triangle:?}");
        }
    }
}

/// In fixed point the same samples have an image, and the quotients are those of integers.
#[test]
fn fixed_point_divides_the_same() {
    let mut rng = Rng::stream(run_seed(), 3);
    let (mut inside, mut samples) = (0, 0);
    for _ in 0..100_000 {
        // Exact in both kinds of numbers; now and then on the border, or 0.
        let bits = |rng: &mut Rng, most: i64| rng.range(-most, most) as i32;
        let q = if rng.one_in(50) { 0 } else { bits(&mut rng, 1 << 23) };
        let mut within = || if rng.one_in(10) { q } else { bits(&mut rng, 1 << 23) };
        let place = [within(), within(), q];
        let ([u, v], there) = Homogeneous::divide_lanes(OneFixed, &place.map(Q16::from_bits));
        let [x, y, z] = place.map(|bits| bits as f32 / 65536.0);
        let float = Homogeneous { u: x, v: y, q: z }.divide();
        assert_eq!(float.is_some(), there, "{place:?}");
        let [p, r, s] = place.map(i64::from);
        assert_eq!(there, p.abs() < s && r.abs() < s, "{place:?}");
        if there {
            assert_eq!([u, v].map(|c| i64::from(c.to_bits())), [p * 65536 / s, r * 65536 / s]);
            inside += 1;
        }
        samples += usize::from(One.less(0.0, z));
    }
    assert!(inside > 5_000 && samples > 30_000, "{inside} {samples}");
}
