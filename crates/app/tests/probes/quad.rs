//! A tilted quad of two triangles: texture coordinates, levels of detail and triangles by rays.

use crate::{options, policies};
use alberti_app::options::{Arithmetic, DepthFormat};
use alberti_app::probe::{Probes, probe};
use alberti_app::scene::{Camera, Image, Model, Part, Vertex};

type Vec3 = [f64; 3];

/// Columns and rows of its pictures.
pub(crate) const SIZE: (u32, u32) = (200, 150);
/// Columns and rows of its texture.
pub(crate) const TEXELS: [u32; 2] = [128, 64];

const CORNER: Vec3 = [-2.0, -0.5, 1.5];
const ALONG_U: Vec3 = [4.0, 0.5, -0.75];
const ALONG_V: Vec3 = [0.25, 1.0, -5.0];
const CAMERA: Camera = Camera {
    eye: [0.5, 1.75, 4.0],
    target: [0.25, 0.0, 0.0],
    up: [0.125, 1.0, 0.0],
    roll: 0.0,
    fov: 50.0,
    near: 0.5,
    far: 20.0,
};

fn add(a: Vec3, b: Vec3, factor: f64) -> Vec3 {
    [0, 1, 2].map(|k| a[k] + factor * b[k])
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Vec3) -> Vec3 {
    a.map(|c| c / dot(a, a).sqrt())
}

/// The ray through a place on the picture, in pixels, with a step of 1 forward.
fn ray([x, y]: [f64; 2]) -> [Vec3; 2] {
    let [eye, target, up] = [CAMERA.eye, CAMERA.target, CAMERA.picture_up()].map(|p| p.map(f64::from));
    let forward = unit(add(target, eye, -1.0));
    let right = unit(cross(forward, up));
    let above = cross(right, forward);
    let (width, height) = (f64::from(SIZE.0), f64::from(SIZE.1));
    let half = (f64::from(CAMERA.fov).to_radians() / 2.0).tan();
    let across = (2.0 * x / width - 1.0) * half * width / height;
    [eye, add(add(forward, right, across), above, (1.0 - 2.0 * y / height) * half)]
}

/// u, v and the depth z where the ray through that place meets the plane of the quad.
pub(crate) fn met(place: [f64; 2]) -> [f64; 3] {
    let [eye, direction] = ray(place);
    // corner + u along_u + v along_v = eye + z direction, by Cramer's rule.
    let from = add(eye, CORNER, -1.0);
    let back = direction.map(|c| -c);
    let of = |a: Vec3, b: Vec3, c: Vec3| dot(a, cross(b, c));
    let all = of(ALONG_U, ALONG_V, back);
    [of(from, ALONG_V, back) / all, of(ALONG_U, from, back) / all, of(ALONG_U, ALONG_V, from) / all]
}

/// The middle of a pixel.
pub(crate) fn middle(index: usize) -> [f64; 2] {
    let width = SIZE.0 as usize;
    [(index % width) as f64 + 0.5, (index / width) as f64 + 0.5]
}

/// The quad with a texture, in a part of its own after another that is not seen.
fn model() -> Model {
    let vertex = |[u, v]: [f32; 2]| Vertex {
        position: add(add(CORNER, ALONG_U, u.into()), ALONG_V, v.into()).map(|c| c as f32),
        uv: [u, v],
        ..Vertex::default()
    };
    let behind = Vertex { position: [0.0, 0.0, 90.0], ..Vertex::default() };
    let vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(vertex);
    let vertices = [behind].into_iter().chain(vertices).collect();
    let [width, height] = TEXELS;
    let texture = Image { width, height, texels: vec![[255; 4]; (width * height) as usize] };
    let hidden = Part { triangles: vec![[0, 0, 0]; 3], ..Part::default() };
    let quad = Part { triangles: vec![[1, 2, 3], [1, 3, 4]], texture: Some(0), ..Part::default() };
    Model { vertices, parts: vec![hidden, quad], textures: vec![texture.into()], ..Model::default() }
}

/// Its probes.
pub(crate) fn probed(interpolation: &str, arithmetic: Arithmetic) -> Probes {
    let options = options(SIZE, policies(interpolation, arithmetic), DepthFormat::F32Reversed);
    probe(&model(), &CAMERA, &options).expect("a picture")
}

/// Calls `check` with the index of each pixel on the quad that is not at its border; these are many.
fn inside(probes: &Probes, mut check: impl FnMut(usize)) {
    let mut found = 0;
    for index in 0..probes.pixels() {
        let [u, v, z] = met(middle(index));
        let [within, beyond] = [0.02, -0.02].map(|margin: f64| {
            let range = margin..1.0 - margin;
            range.contains(&u) && range.contains(&v) && z > 0.0
        });
        if within {
            found += 1;
            check(index);
        } else if !beyond {
            assert_eq!(probes.seen(index), None, "{index}");
        }
    }
    assert!(found > probes.pixels() / 4, "{found}");
}

/// The greatest error of u and v.
fn error(interpolation: &str, arithmetic: Arithmetic) -> [f64; 2] {
    let probes = probed(interpolation, arithmetic);
    let mut worst = [0.0_f64; 2];
    inside(&probes, |index| {
        let [u, v, _] = met(middle(index));
        let found = probes.seen(index).and_then(|seen| seen.uv).expect("a texture there");
        worst = [worst[0].max((found[0] - u).abs()), worst[1].max((found[1] - v).abs())];
    });
    worst
}

#[test]
fn texture_coordinates_are_those_of_rays() {
    for policy in ["exact", "plane"] {
        let worst = error(policy, Arithmetic::Float);
        assert!(worst.iter().all(|error| *error < 4e-6), "{policy}: {worst:?}");
    }
    // In fixed point positions are snapped to 1/512 pixel, and numbers to 2^-16; from pixel to pixel v changes by up to
    // a fortieth.
    let rounded = 1.0 / 512.0 / 40.0 * 2.0 + 8.0 / 65536.0;
    for texels in [0.125, 1.0] {
        let budget = texels / f64::from(TEXELS[0]);
        for (arithmetic, more) in [(Arithmetic::Float, 4e-6), (Arithmetic::Fixed, rounded)] {
            let worst = error(&format!("bounded:{texels}"), arithmetic);
            let largest = worst[0].max(worst[1]);
            assert!(largest <= budget + more, "bounded:{texels} {arithmetic:?}: {worst:?}");
            // In floats these triangles are exact, as nothing cheaper keeps the budget.
            let straight = arithmetic == Arithmetic::Fixed;
            assert!(
                !straight || largest > budget / 8.0,
                "bounded:{texels}: {worst:?} is not of straight lines"
            );
        }
    }
    assert!(error("affine", Arithmetic::Float)[1] > 0.05);
}

#[test]
fn levels_of_detail_are_those_of_rays() {
    for (policy, arithmetic, bound) in
        [("exact", Arithmetic::Float, 1.0 / 256.0), ("spans:4", Arithmetic::Fixed, 0.0625)]
    {
        let probes = probed(policy, arithmetic);
        let (mut worst, mut magnified, mut minified) = (0.0_f64, 0, 0);
        inside(&probes, |index| {
            const STEP: f64 = 1e-4;
            let [x, y] = middle(index);
            let length = |[dx, dy]: [f64; 2]| {
                let [before, after] = [-STEP, STEP].map(|s| met([x + s * dx, y + s * dy]));
                let along = |k: usize| (after[k] - before[k]) / (2.0 * STEP) * f64::from(TEXELS[k]);
                along(0).hypot(along(1))
            };
            let lod = length([1.0, 0.0]).max(length([0.0, 1.0])).log2();
            let found = probes.seen(index).and_then(|seen| seen.lod).expect("a texture there");
            worst = worst.max((f64::from(found) - lod).abs());
            *(if lod > 0.0 { &mut minified } else { &mut magnified }) += 1;
        });
        assert!(worst < bound, "{policy}: {worst}");
        assert!(magnified > 1000 && minified > 1000, "{magnified} {minified}");
    }
}

#[test]
fn triangles_and_depths_are_those_of_rays() {
    let probes = probed("exact", Arithmetic::Float);
    let mut counts = [0; 2];
    inside(&probes, |index| {
        let [u, v, z] = met(middle(index));
        let seen = probes.seen(index).expect("the quad");
        // Reversed: A/B-A times B/z - 1.
        let (near, far) = (f64::from(CAMERA.near), f64::from(CAMERA.far));
        let zs = near / (far - near) * (far / z - 1.0);
        assert!((seen.zs.expect("a depth buffer") - zs).abs() < 1e-6, "{index}");
        assert_eq!(seen.zs.map(|zs| (zs as f32).to_bits()), Some(!probes.depth(index)));
        assert_eq!(seen.part, 1);
        // The diagonal is u = v; three triangles are before these.
        if (u - v).abs() > 0.02 {
            let upper = u < v;
            assert_eq!(seen.triangle, 3 + u32::from(upper), "{index}");
            counts[usize::from(upper)] += 1;
        }
    });
    assert!(counts.iter().all(|count| *count > 1000), "{counts:?}");
}
