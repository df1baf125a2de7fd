//! Materials in whole pictures: the same bits on every machine, close to them in fixed point, and textures that repeat
//! without a seam.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "bytes and grids are small")]

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Floating, Machine, One};
use alberti::shaders::material::{
    BlinnPhong, Bump, Called, Color, Directional, Emission, Framed, Gloss, Gouraud, Lighting, Material,
    NormalMap, Occlusion, Parallax, Phong, PointLight, Reflection, Specular, SpotLight, Viewer, Wetness,
};
use alberti::texture::environment::LatLong;
use alberti::texture::surface::{
    BilinearHeights, LimitedParallax, NormalEncoding::Unorm, Relief, SteepParallax,
};
use alberti::texture::{Bilinear, Mipmap, Nearest, Repeat, Texture, Trilinear, mipmap::texel_count};
use alberti::{
    Affine, Cull, Exact, F32, FixedPoint, FragmentStage, Frame, Interpolation, Mesh, Object, Parallel, Pass,
    Perspective, Point3, Projection, Rgba8, Rgba8888, Slot, Spans16, Target, Varying, Vector3, View,
    for_lanes,
};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::narrow::Narrow;

const SIDE: usize = 96;

/// A picture of a mesh in front of the eye, in eye space.
fn picture<L: Floating, P: Projection, V: Varying, T: Copy + Sync>(
    lanes: L,
    projection: P,
    interpolation: impl Interpolation,
    (vertices, triangles): (&[T], &[[u16; 3]]),
    vertex_stage: impl Fn(&T) -> (Point3<Object>, V),
    fragment_stage: impl FragmentStage<V, Color = Rgba8>,
) -> Vec<u32> {
    let (mut color, mut depth) = (vec![0; SIDE * SIDE], vec![1.0; SIDE * SIDE]);
    let side = SIDE as u32;
    let mut target = Target::new(Rgba8888, F32, side, side, &mut color, &mut depth).expect("a frame");
    let (view, mesh) = (View::new(Frame::IDENTITY, projection), Mesh::new(vertices, triangles, vertex_stage));
    Pass::new(&view, &mesh, Narrow(fragment_stage))
        .cull(Cull::None)
        .interpolation(interpolation)
        .slots(&mut vec![Slot::EMPTY; vertices.len()])
        .draw_by(lanes, &mut target);
    color
}

/// A hilly sheet that leans back from z = 2 to z = 6, in an eye's space, whose normals point to the eye.
fn sheet() -> (Vec<Framed>, Vec<[u16; 3]>) {
    const N: u16 = 12;
    let vertex = |i: u16, j: u16| {
        let [x, y] = [i, j].map(|k| 2.0 * f32::from(k) / f32::from(N) - 1.0);
        let slope = 0.3 * if i.is_multiple_of(3) { 1.0 } else { -0.5 };
        let n = Vec3::new(slope, 0.9, -0.8).normalize();
        let u = (Vec3::X - n * n.x).normalize();
        Framed {
            position: Vec3::new(2.5 * x, 1.5 * y, 4.0 + 2.0 * y + 0.2 * slope),
            axes: [u, n.cross(u), n],
            uv: 3.0 * Vec2::new(x, y),
        }
    };
    let vertices = (0..=N).flat_map(|j| (0..=N).map(move |i| vertex(i, j))).collect();
    let at = |i, j| j * (N + 1) + i;
    let cell =
        |i, j| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
    (vertices, (0..N).flat_map(|j| (0..N).flat_map(move |i| cell(i, j))).collect())
}

fn given(v: &Framed) -> (Point3<Object>, Framed) {
    (Point3::new(v.position), *v)
}

type Lights = (Directional, [PointLight; 1], SpotLight);

fn lighting<R>(reflectance: R) -> Lighting<Lights, R> {
    let at = |x, y, z| Point3::new(Vec3::new(x, y, z));
    let lamp = PointLight { position: at(1.0, 1.0, 3.0), color: Vec3::splat(0.5), falloff: [0.2, 0.3, 0.3] };
    let spot = PointLight {
        position: at(-1.0, 2.0, 2.5),
        color: Vec3::new(0.7, 0.6, 0.2),
        falloff: [0.5, 0.1, 0.1],
    };
    let axis = Vector3::new(Vec3::new(0.2, -1.0, 0.6));
    Lighting {
        viewer: Viewer::at(at(0.0, 0.0, 0.0)),
        ambient: Vec3::splat(0.1),
        lights: (
            Directional::new(Vector3::new(Vec3::new(0.5, 1.0, -1.0)), Vec3::splat(0.3)),
            [lamp],
            SpotLight::new(spot, axis, [0.85, 0.8]),
        ),
        reflectance,
    }
}

/// The same with lamps so far away that squares of distances do not fit, without falloff, and a blinding one.
fn far_and_bright<R>(reflectance: R) -> Lighting<Lights, R> {
    let far = |x, y, z, color| PointLight {
        position: Point3::new(Vec3::new(x, y, z)),
        color,
        falloff: [1.0, 0.0, 0.0],
    };
    let lit = lighting(reflectance);
    let spot = far(-300.0, 900.0, -1000.0, Vec3::new(0.2, 0.6, 3000.0));
    let axis = Vector3::new(Vec3::new(0.3, -0.9, 1.0));
    Lighting {
        viewer: Viewer::at(Point3::new(Vec3::new(0.0, 0.0, -1e4))),
        lights: (
            lit.lights.0,
            [far(200.0, 500.0, -400.0, Vec3::splat(0.4))],
            SpotLight::new(spot, axis, [0.5, 0.3]),
        ),
        ..lit
    }
}

fn perspective() -> Perspective {
    Perspective::new(1.0, 1.0, 0.5, 20.0).expect("a pyramid")
}

/// Noise that is smooth enough for normals and heights.
fn texels(stream: u64, side: u32) -> Vec<[u8; 4]> {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut byte = |least: i64, greatest: i64| u8::try_from(rng.range(least, greatest)).expect("a byte");
    (0..texel_count(side, side))
        .map(|_| [byte(90, 165), byte(90, 165), byte(200, 255), byte(0, 255)])
        .collect()
}

/// One machine after the other, and one sample at a time.
macro_rules! equal_bits {
    ($name:literal, $policy:expr, $mesh:expr, $vertex:expr, $stage:expr) => {{
        let (vertices, triangles) = $mesh;
        let mesh = (vertices.as_slice(), triangles.as_slice());
        let alone = picture(One, perspective(), $policy, mesh, $vertex, $stage);
        let covered = alone.iter().filter(|c| **c != 0).count();
        assert!(covered > SIDE * SIDE / 3, "{}: {covered}", $name);
        let colors: std::collections::BTreeSet<_> = alone.iter().collect();
        assert!(colors.len() > 300, "{}: {} colours", $name, colors.len());
        for machine in Machine::all() {
            let wide =
                for_lanes!(machine, lanes => picture(lanes, perspective(), $policy, mesh, $vertex, $stage));
            assert!(wide == alone, "{}: {machine:?} differs", $name);
        }
    }};
}

#[test]
fn every_machine_draws_the_same_bits() {
    let (texels, mesh) = (texels(1, 16), sheet());
    let texture = Texture::new(Rgba8888, &texels[..256], 16, 16).expect("a texture");
    let smooth = texture.sampler(Bilinear, Repeat);
    let sharp = texture.sampler(Nearest, Repeat);
    let mip = Mipmap::new(Rgba8888, &texels, 16, 16).expect("a mip map").sampler(Trilinear, Repeat);
    let extent = Vec2::splat(0.8);

    // Of maps that are read in place the pictures below have one or two each.
    let (color, number) = (Called(mip), Called(smooth));
    let all = Material {
        layers: (
            Parallax {
                relief: Relief { map: smooth, low: -0.1, high: 0.1, extent },
                policy: SteepParallax { layers: 9 },
            },
            Color(color),
            (Specular(number), Gloss(Called(sharp)), Wetness(number)),
            Occlusion { map: color, strength: 0.8 },
            NormalMap { map: color, encoding: Unorm, strength: 1.0 },
            Emission(Rgba8::from_rgb24(0x08_04_00)),
            Reflection { environment: LatLong, image: number, strength: Called(sharp), facing: 0.04 },
        ),
        lighting: lighting(BlinnPhong([1, 300])),
    };
    equal_bits!("all", Exact, &mesh, given, all);

    let heights = BilinearHeights::new(texture, Repeat);
    let bumpy = Material {
        layers: (Color(sharp), Bump(Relief { map: heights, low: 0.0, high: 0.1, extent })),
        lighting: lighting(Phong(40)),
    };
    equal_bits!("bump, in spans", Spans16, &mesh, given, bumpy);

    let by_vertex = |v: &Framed| {
        let lit = lighting(Phong(7)).at_vertex(Point3::new(v.position), Vector3::new(v.axes[2]));
        (Point3::new(v.position), (lit[0], (lit[1], v.uv)))
    };
    equal_bits!("Gouraud", Exact, &mesh, by_vertex, Gouraud { layers: (Color(mip), Specular(sharp)) });
}

/// Each channel within so many steps of a byte of what `f32` draws, but for a share of the pixels at edges: of
/// triangles, texels, and where light comes in at right angles.
#[test]
fn fixed_point_draws_nearly_the_same() {
    let (texels, mesh) = (texels(2, 4), sheet());
    let texture = Texture::new(Rgba8888, &texels[..16], 4, 4).expect("a texture");
    let smooth = texture.sampler(Bilinear, Repeat);
    let extent = Vec2::splat(0.8);
    let heights = BilinearHeights::new(texture, Repeat);
    let relief = Relief { map: smooth, low: -0.02, high: 0.02, extent };
    macro_rules! compare {
        ($name:literal, $most:literal, $stage:expr) => {{
            let mesh = (mesh.0.as_slice(), mesh.1.as_slice());
            let float = picture(One, perspective(), Spans16, mesh, given, $stage);
            let fixed = picture(One, perspective(), FixedPoint(Spans16), mesh, given, $stage);
            let differ = |(a, b): (&u32, &u32)| {
                let bytes = a.to_le_bytes().into_iter().zip(b.to_le_bytes());
                bytes.map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
            };
            let mut steps: Vec<_> = float.iter().zip(&fixed).map(differ).collect();
            steps.sort_unstable();
            let worst = steps[steps.len() * 999 / 1000];
            println!(
                "{}: within {worst} for all but a thousandth, {} at worst",
                $name,
                steps[steps.len() - 1]
            );
            assert!(worst <= $most, "{}: {worst}", $name);
        }};
    }
    compare!(
        "Lambert",
        1,
        Material { layers: Color(smooth), lighting: lighting(alberti::shaders::material::Lambert) }
    );
    compare!(
        "Phong 20",
        3,
        Material { layers: (Color(smooth), Specular(smooth)), lighting: lighting(Phong(20)) }
    );
    compare!(
        "Blinn 80",
        3,
        Material { layers: (Color(smooth), Specular(smooth)), lighting: lighting(BlinnPhong(80)) }
    );
    compare!(
        "Blinn 80, far and bright",
        3,
        Material { layers: (Color(smooth), Specular(smooth)), lighting: far_and_bright(BlinnPhong(80)) }
    );
    compare!(
        "maps",
        4,
        Material {
            layers: (
                Parallax { relief, policy: LimitedParallax },
                Color(smooth),
                (Specular(smooth), Gloss(smooth), Wetness(smooth)),
                Occlusion { map: smooth, strength: 0.5 },
                NormalMap { map: smooth, encoding: Unorm, strength: 0.5 },
            ),
            lighting: lighting(BlinnPhong([1, 80])),
        }
    );
    compare!(
        "bump",
        4,
        Material {
            layers: (Color(smooth), Bump(Relief { map: heights, low: 0.0, high: 0.05, extent })),
            lighting: lighting(Phong(20)),
        }
    );
}

/// A wall of n by n quads, each with the whole texture, or of one with it repeated.
fn wall(n: u16, repeated: bool) -> (Vec<(Vec3, Vec2)>, Vec<[u16; 3]>) {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let cells = if repeated { 1 } else { n };
    let step = 4.0 / f32::from(cells);
    let times = if repeated { f32::from(n) } else { 1.0 };
    for (i, j) in (0..cells).flat_map(|j| (0..cells).map(move |i| (i, j))) {
        let first = u16::try_from(vertices.len()).expect("few cells");
        let corner = |(a, b): (f32, f32)| {
            let (x, y) = (-2.0 + step * (f32::from(i) + a), -2.0 + step * (f32::from(j) + b));
            (Vec3::new(x, y, 2.0 - 0.5 * y), times * Vec2::new(a, b))
        };
        vertices.extend([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(corner));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    (vertices, triangles)
}

/// How many pixels of a tiled wall differ from one with a texture that repeats, and by how much at most.
fn seams<P: Projection>(projection: P, interpolation: impl Interpolation, n: u16) -> (usize, u8) {
    let mut rng = Rng::stream(run_seed(), 9);
    let texels: Vec<[u8; 4]> = (0..64).map(|_| (rng.u64() as u32).to_le_bytes()).collect();
    let map = Texture::new(Rgba8888, &texels, 8, 8).expect("a texture").sampler(Bilinear, Repeat);
    let stage = Gouraud { layers: (Color(map), Emission(map)) };
    let vertex = |v: &(Vec3, Vec2)| (Point3::new(v.0), (Vec3::splat(0.5), (Vec3::ZERO, v.1)));
    let [tiled, whole] = [false, true].map(|repeated| {
        let (vertices, triangles) = wall(n, repeated);
        picture(One, projection, interpolation, (&vertices, &triangles), vertex, stage)
    });
    assert!(whole.iter().filter(|c| **c != 0).count() > SIDE * SIDE / 2);
    let bytes =
        |a: u32, b: u32| a.to_le_bytes().into_iter().zip(b.to_le_bytes()).map(|(a, b)| a.abs_diff(b)).max();
    let differ = tiled.iter().zip(&whole).filter(|(a, b)| a != b);
    let worst = differ.clone().filter_map(|(a, b)| bytes(*a, *b)).max();
    (differ.count(), worst.unwrap_or(0))
}

#[test]
fn repeated_textures_have_no_seam() {
    // All steps are dyadic: 96 pixels show 3 units, four tiles of 8 texels are a unit each.
    let parallel = Parallel::new(3.0, 1.0, 0.0, 8.0).expect("a box");
    assert_eq!(seams(parallel, Affine, 4), (0, 0));
    assert_eq!(seams(parallel, Exact, 8), (0, 0));
    // In perspective the inner corners are snapped, by half of 1/256 pixel: a weight may be another step of 256, along
    // either axis. A seam would be one of up to 255.
    let (pixels, worst) = seams(perspective(), Exact, 4);
    println!("{pixels} pixels differ, by {worst}");
    assert!(worst <= 4, "{pixels} {worst}");
}
