//! Tangents, normals, reliefs and displacement of any numbers: unit vectors, and never anything but numbers.

use crate::bits::Bits;
use alberti::glam::{Vec2, Vec3};
use alberti::texture::format::L8;
use alberti::texture::surface::{
    AnyParallax, CentralDifferences, NormalEncoding, Relief, Tangent, frame_of_normal, frame_of_tangent,
    normal, normal_of_two, orthonormal, strengthened, triangle_directions, triangle_frame, vertex_normals,
    vertex_tangents,
};
use alberti::texture::{AnyWrap, Bilinear, Texture};
use alberti::{Object, Point3, Rgba8, Vector3};

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    match bits.below(3) {
        0 => frames(&mut bits),
        1 => meshes(&mut bits),
        _ => reliefs(&mut bits),
    }
}

fn assert_unit(v: Vec3, what: &str) {
    let length = v.as_dvec3().length();
    assert!((length - 1.0).abs() < 1e-5, "{what}: {v} is {length} long");
}

fn frames(bits: &mut Bits<'_>) {
    let corners = [(); 3].map(|()| Point3::<Object>::new(Vec3::from_array(bits.floats())));
    let uv = [(); 3].map(|()| Vec2::from_array(bits.floats()));
    if let Some([u, v]) = triangle_directions(corners, uv) {
        assert_unit(u.coords, "along u");
        assert_unit(v.coords, "along v");
        direction(corners, uv, u.coords);
    }
    if let Some(frame) = triangle_frame(corners, uv) {
        let axes = frame.axes();
        let straight = orthonormal(frame).axes();
        if [axes.x_axis, axes.y_axis, axes.z_axis]
            .iter()
            .all(|axis| axis.is_finite() && axis.length() > 1e-18)
        {
            for axis in [straight.x_axis, straight.y_axis, straight.z_axis] {
                assert_unit(axis, "an axis made straight");
            }
        }
    }
    let [point, across] = [(); 2].map(|()| Vec3::from_array(bits.floats()));
    let axes = frame_of_normal(Point3::new(point), Vector3::new(across)).axes();
    for axis in [axes.x_axis, axes.y_axis, axes.z_axis] {
        assert_unit(axis, "an axis about a normal");
    }
}

/// The direction of growing u, against the same in `f64`, where its numbers are no wider apart than `f64` holds.
fn direction(corners: [Point3<Object>; 3], uv: [Vec2; 3], found: Vec3) {
    let [a, b, c] = corners.map(|corner| corner.coords.as_dvec3());
    let [s, t, w] = uv.map(|uv| uv.as_dvec2());
    let (d1, d2) = (t - s, w - s);
    let area = d1.x * d2.y - d1.y * d2.x;
    let along = ((b - a) * d2.y - (c - a) * d1.y) * area.signum();
    let sizes = [(b - a).length() * d2.y.abs(), (c - a).length() * d1.y.abs()];
    let size = sizes[0].max(sizes[1]);
    // Where two long ones cancel, a direction is no direction.
    let sound =
        area.abs() > 1e-9 * (d1.x * d2.y).abs().max((d1.y * d2.x).abs()) && along.length() > 1e-4 * size;
    let moderate = |x: f64| x == 0.0 || (1e-30..1e30).contains(&x.abs());
    let all = [a, b, c].iter().all(|v| v.to_array().into_iter().all(moderate));
    if sound && all && size > 1e-30 && size < 1e30 && [s, t, w].iter().all(|v| v.abs().max_element() < 1e6) {
        let cosine = found.as_dvec3().dot(along.normalize());
        assert!(cosine > 1.0 - 1e-4, "{found} for {along}: {corners:?} {uv:?}");
    }
}

fn meshes(bits: &mut Bits<'_>) {
    let count = 1 + bits.below(12);
    let positions: Vec<_> = (0..count).map(|_| Vec3::from_array(bits.floats())).collect();
    let uvs: Vec<_> = (0..count).map(|_| Vec2::from_array(bits.floats())).collect();
    let triangles: Vec<[u32; 3]> =
        (0..bits.below(16)).map(|_| [(); 3].map(|()| bits.below(count + 1) as u32)).collect();
    let mut normals = vec![Vec3::ZERO; count];
    vertex_normals(&positions, &triangles, &mut normals).expect("as many normals as positions");
    for normal in &normals {
        assert_unit(*normal, "a vertex's normal");
    }
    let mut tangents = vec![[0.0; 4]; count];
    vertex_tangents(&positions, &normals, &uvs, &triangles, &mut tangents).expect("lengths that agree");
    for (k, &[x, y, z, w]) in tangents.iter().enumerate() {
        let (tangent, normal) = (Vec3::new(x, y, z), normals[k]);
        assert_unit(tangent, "a vertex's tangent");
        assert!([-1.0, 1.0].contains(&w), "{w}");
        assert!(tangent.dot(normal).abs() < 1e-6, "{tangent} along {normal}");
        let axes = frame_of_tangent(Point3::new(positions[k]), Vector3::new(normal), [x, y, z, w]).axes();
        for axis in [axes.x_axis, axes.y_axis, axes.z_axis] {
            assert_unit(axis, "an axis of a vertex");
        }
    }
    assert!(vertex_normals(&positions, &triangles, &mut normals[1..]).is_err());
}

fn reliefs(bits: &mut Bits<'_>) {
    let texel = Rgba8::from_bits(bits.word());
    let encoding = bits.pick(&[NormalEncoding::Unorm, NormalEncoding::Centred]);
    let mapped: Vector3<Tangent> = normal(encoding, texel);
    assert_unit(mapped.coords, "a texel's normal");
    assert_unit(normal_of_two(encoding, texel).coords, "a normal of two channels");
    let strength = bits.float();
    assert_unit(strengthened(mapped, strength).coords, "a stronger normal");
    let bytes: [u8; 12] = bits.bytes();
    let texture = Texture::new(L8, &bytes, 4, 3).expect("a texture");
    let wrap = bits.pick(&[AnyWrap::Repeat, AnyWrap::Clamp, AnyWrap::Mirror]);
    let [low, high] = bits.floats();
    let [uv, extent, step] = [(); 3].map(|()| Vec2::from_array(bits.floats()));
    let view = Vector3::new(Vec3::from_array(bits.floats()));
    let map = texture.sampler(Bilinear, wrap);
    let relief = Relief { map, low, high, extent };
    let height = relief.height(uv);
    if low.is_finite() && high.is_finite() && low.abs() < 1e30 && high.abs() < 1e30 {
        let slack = (low.abs() + high.abs()) * 1e-5;
        let [least, most] = [low.min(high) - slack, low.max(high) + slack];
        assert!(height >= least && height <= most, "{height} is beyond {low} to {high}");
    }
    let layers = bits.below(40) as u32;
    for search in [
        AnyParallax::Offset,
        AnyParallax::Limited,
        AnyParallax::Steep { layers },
        AnyParallax::Occlusion { layers },
    ] {
        let moved = relief.parallax(search, uv, view);
        assert!(moved.is_finite() || !uv.is_finite(), "{moved} from {uv} along {view:?} by {search:?}");
    }
    let differences =
        Relief { map: CentralDifferences { map, step: Vec2::new(0.25, 1.0 / 3.0) }, low, high, extent };
    let bumped = differences.normal(uv, step);
    assert_unit(bumped.coords, "a relief's normal");
}
