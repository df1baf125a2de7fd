//! Kinds of scenes without a frame: functions of numbers of any bits, whose results are hashed.

use crate::seed::{Hash, Seed};
use alberti::glam::{Vec2, Vec3};
use alberti::math::srgb;
use alberti::texture::format::L8;
use alberti::texture::surface::{
    Parametric, Relief, Sphere, Torus, displaced, frame_of_normal, triangle_frame, vertex_normals,
    vertex_tangents,
};
use alberti::texture::{Bilinear, Texture};
use alberti::{AnyDepth, DepthFormat, Object, Octahedral, Point3, Vector3};

/// A kind: its name, and the hash that it comes to.
pub type Kind = (&'static str, fn(&mut Seed) -> u64);

/// All kinds.
pub const KINDS: &[Kind] =
    &[("numbers", numbers), ("views", views), ("meshes", meshes), ("surfaces", surfaces)];

fn vector(hash: &mut Hash, v: Vec3) {
    v.to_array().into_iter().for_each(|x| hash.number(x));
}

/// Any three floats.
fn any(seed: &mut Seed) -> Vec3 {
    Vec3::new(seed.float(), seed.float(), seed.float())
}

fn numbers(seed: &mut Seed) -> u64 {
    let mut hash = Hash::new();
    for _ in 0..200 {
        let share = seed.between(-0.1, 1.1);
        let [low, high, ..] = seed.word().to_le_bytes();
        hash.add(u32::from(srgb::to_light(low)));
        hash.add(u32::from(srgb::to_byte(u16::from_le_bytes([low, high]))));
        let direction = Octahedral::nearest(any(seed));
        vector(&mut hash, direction.to_vec3());
        for format in [AnyDepth::F32, AnyDepth::F32Reversed, AnyDepth::D32, AnyDepth::D24, AnyDepth::D16] {
            hash.add(format.encode(share.clamp(0.0, 1.0)));
        }
    }
    hash.value()
}

fn views(seed: &mut Seed) -> u64 {
    use alberti::{Parallel, Perspective, Projection as _, look_at};
    let mut hash = Hash::new();
    for _ in 0..100 {
        let [near, far] = [seed.between(0.01, 2.0), seed.between(2.5, 2000.0)];
        let point = Point3::new(seed.vector(-9.0, 9.0));
        if let Ok(view) = Perspective::new(seed.between(0.01, 3.1), seed.between(0.2, 4.0), near, far) {
            vector(&mut hash, view.scale(point).coords);
        }
        if let Ok(view) = Parallel::new(seed.between(0.1, 100.0), seed.between(0.2, 4.0), near, far) {
            vector(&mut hash, view.scale(point).coords);
        }
        let [eye, target, up] = [any(seed), any(seed), any(seed)];
        if let Ok(frame) = look_at(Point3::new(eye), Point3::new(target), Vector3::new(up)) {
            let axes = frame.axes();
            [axes.x_axis, axes.y_axis, axes.z_axis].into_iter().for_each(|axis| vector(&mut hash, axis));
        }
    }
    hash.value()
}

fn meshes(seed: &mut Seed) -> u64 {
    let mut hash = Hash::new();
    let (corners, triangles) = seed.mesh();
    let triangles = triangles.map(|triangle| triangle.map(u32::from));
    let (positions, uvs) = (corners.map(|corner| corner.place), corners.map(|corner| corner.uv));
    let mut normals = corners.map(|corner| corner.normal);
    if vertex_normals(&positions, &triangles, &mut normals).is_err() {
        return hash.value();
    }
    let mut tangents = [[0.0; 4]; crate::seed::CORNERS];
    if vertex_tangents(&positions, &normals, &uvs, &triangles, &mut tangents).is_err() {
        return hash.value();
    }
    normals.into_iter().for_each(|normal| vector(&mut hash, normal));
    tangents.into_iter().flatten().for_each(|x| hash.number(x));
    for _ in 0..40 {
        let corners = [(); 3].map(|()| Point3::<Object>::new(any(seed)));
        let uv = [(); 3].map(|()| Vec2::new(seed.float(), seed.float()));
        if let Some(frame) = triangle_frame(corners, uv) {
            let axes = frame.axes();
            [axes.x_axis, axes.y_axis, axes.z_axis].into_iter().for_each(|axis| vector(&mut hash, axis));
        }
        let axes = frame_of_normal(Point3::new(Vec3::ZERO), Vector3::new(any(seed))).axes();
        [axes.x_axis, axes.y_axis, axes.z_axis].into_iter().for_each(|axis| vector(&mut hash, axis));
    }
    hash.value()
}

fn surfaces(seed: &mut Seed) -> u64 {
    let mut hash = Hash::new();
    let bytes = [(); 16].map(|()| (seed.word() >> 24).to_le_bytes()[0]);
    let Ok(map) = Texture::new(L8, &bytes, 4, 4) else { return 0 };
    let relief = Relief { map: map.sampler(Bilinear, seed.wrap()), low: -0.1, high: 0.3, extent: Vec2::ONE };
    let [sphere, torus] = [Sphere { radius: 1.5 }, Sphere { radius: 0.1 }];
    let ring = Torus { major: 2.0, minor: 0.5 };
    for _ in 0..100 {
        let uv = Vec2::new(seed.between(-1.0, 2.0), seed.between(0.0, 1.0));
        for frame in [sphere.orthonormal_frame(uv), torus.orthonormal_frame(uv), ring.orthonormal_frame(uv)] {
            let normal = Vector3::new(frame.axes().z_axis);
            vector(&mut hash, displaced(frame.origin(), normal, relief.height(uv)).coords);
            vector(&mut hash, normal.coords);
        }
    }
    hash.value()
}
