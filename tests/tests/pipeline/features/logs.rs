//! `defmt`: the bytes that are sent, of which the texts are numbers. In this build defmt keeps them for tests.

use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::math::{Frame2, Vector2};
use alberti::raster::color::AnyBlend;
use alberti::shaders::material::{AnyLight, Directional, PointLight, SpotLight};
use alberti::texture::TextureError;
use alberti::texture::environment::{AnyEnvironment, SphereMap, Turned};
use alberti::texture::surface::{Grid, Subdivision};
use alberti::*;

/// The bytes of a value after the number of its format: of enums the variant's number, then fields, little-endian.
fn sent(value: &impl defmt::Format) -> Vec<u8> {
    let _ = defmt::export::fetch_bytes();
    defmt::export::fmt(value);
    let mut bytes = defmt::export::fetch_bytes();
    assert!(bytes.len() >= 2, "the number of a format");
    bytes.drain(..2);
    bytes
}

#[test]
fn errors_are_sent_with_their_numbers() {
    assert_eq!(sent(&ViewError::Aspect), [4]);
    assert_eq!(sent(&TargetError::Size), [0]);
    assert_eq!(sent(&TargetError::Rows { pixels: 0x1_02, width: 5 }), [1, 2, 1, 0, 0, 5, 0, 0, 0]);
    let error = TextureError::ZeroSize { width: 0, height: 3 };
    assert_eq!(sent(&error), [0, 0, 0, 0, 0, 3, 0, 0, 0]);
    // One of three, around the number of its format and its bytes.
    let around = sent(&Error::Target(TargetError::Size));
    assert_eq!((around.len(), around[0], around[3]), (4, 1, 0));
}

#[test]
fn counts_are_sent_as_numbers() {
    let stats = Stats {
        submitted: 1,
        dropped: 2,
        clipped: 3,
        culled: 4,
        missed: 5,
        drawn: 6,
        fragments: 7,
        written: 1 << 40,
    };
    let expected: Vec<u8> =
        [1_u64, 2, 3, 4, 5, 6, 7, 1 << 40].iter().flat_map(|count| count.to_le_bytes()).collect();
    assert_eq!(sent(&stats), expected);
}

#[test]
fn small_values_are_sent() {
    assert_eq!(sent(&AnyDepth::D24), [2]);
    assert_eq!(sent(&AnyBlend::Constant(9)), [2, 9]);
    assert_eq!(sent(&Sub8), [1]);
    assert_eq!(sent(&Rgba8::new(1, 2, 3, 4)), [1, 2, 3, 4]);
    assert_eq!(sent(&Rgba565::from_bits(0x04_03_02_01)), [1, 2, 3, 4]);
    // A name, and after it the numbers of the fields.
    let biased = sent(&Biased { format: OrEqual(D16), constant: 1.0, slope: -2.5, clamp: 0.25 });
    let numbers: Vec<u8> = [1.0_f32, -2.5, 0.25].iter().flat_map(|number| number.to_le_bytes()).collect();
    assert!(biased.ends_with(&numbers), "{biased:?}");
    assert!(!sent(&Exact).is_empty());
}

/// Checks that a value is sent with these numbers in this order, and nothing between and behind but numbers of formats.
fn has(value: &impl defmt::Format, numbers: &[f32]) {
    let bytes = sent(value);
    let (mut rest, mut between) = (&bytes[..], 0);
    for number in numbers {
        let found = rest.windows(4).position(|four| four == number.to_le_bytes());
        let at = found.unwrap_or_else(|| panic!("{number} of {numbers:?} in {bytes:?}"));
        (rest, between) = (&rest[at + 4..], between + at);
    }
    assert!(rest.len() <= 8 && between <= 64 && (rest.len() + between) % 2 == 0, "{numbers:?} in {bytes:?}");
}

/// Vectors of glam, which has no way into logs, go as arrays.
#[test]
fn vectors_are_sent_as_their_numbers() {
    let [a, b] = [Vec3::new(1.0, -2.5, 3.0), Vec3::new(0.25, 6.0, -7.0)];
    has(&Point3::<World>::new(a), &[1.0, -2.5, 3.0]);
    has(&Vector3::<Eye>::new(b), &[0.25, 6.0, -7.0]);
    has(&Vector2::<Object>::new(Vec2::new(8.0, 9.0)), &[8.0, 9.0]);
    let axes = Mat3::from_cols(a, b, Vec3::splat(4.5));
    let frame = Frame::<World, Eye>::from_mat3(axes, Point3::new(Vec3::new(10.0, 11.0, 12.0)));
    let numbers = [1.0, -2.5, 3.0, 0.25, 6.0, -7.0, 4.5, 4.5, 4.5, 10.0, 11.0, 12.0];
    has(&frame, &numbers);
    has(&Frame2::<Object, World>::IDENTITY, &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    let turned = Turned { environment: SphereMap, axes };
    has(&turned, &numbers[..9]);
    assert!(sent(&AnyEnvironment::SphereMap(turned)).len() > 36);
    has(&Ball { center: a, radius: 2.0 }, &[1.0, -2.5, 3.0, 2.0]);

    let sun = Directional::new(Vector3::new(Vec3::NEG_Y), b);
    has(&sun, &[0.0, -1.0, 0.0, 0.25, 6.0, -7.0]);
    let bulb = PointLight { position: Point3::new(a), color: b, falloff: [1.0, 0.5, 0.125] };
    let of_bulb = [1.0, -2.5, 3.0, 0.25, 6.0, -7.0, 1.0, 0.5, 0.125];
    has(&bulb, &of_bulb);
    let spot = SpotLight::new(bulb, Vector3::new(Vec3::X), [0.875, 0.75]);
    has(&spot, &[&of_bulb[..], &[1.0, 0.0, 0.0, 0.875, 0.75]].concat());
    assert_eq!(sent(&AnyLight::Directional(sun))[0], 0);
    assert_eq!(sent(&AnyLight::Spot(spot))[0], 2);
}

#[test]
fn views_are_sent_as_their_numbers() {
    let lens = Perspective::new(core::f32::consts::FRAC_PI_2, 2.0, 0.5, 20.0).expect("a lens");
    // The scale, 1 but for the rounding of the angle, and the planes.
    let bytes = sent(&lens);
    let scales = bytes.windows(8).filter_map(|eight| Some(f64::from_le_bytes(eight.try_into().ok()?)));
    assert_eq!(scales.filter(|scale| (scale - 1.0).abs() < 1e-6).count(), 1, "{bytes:?}");
    let numbers: Vec<u8> = [0.5_f32, 20.0].into_iter().flat_map(f32::to_le_bytes).collect();
    let has = |bytes: &[u8]| bytes.windows(numbers.len()).any(|some| some == numbers);
    assert!(has(&bytes) && has(&sent(&AnyProjection::Perspective(lens))), "{bytes:?}");
    let camera = Camera::look_at(Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y).expect("a direction");
    let view = camera.perspective(1.0, 0.5..20.0).expect("a view");
    // Five before the eye.
    let five = 5.0_f32.to_le_bytes();
    assert!([sent(&camera), sent(&view)].iter().all(|bytes| bytes.windows(4).any(|four| four == five)));
    assert!(has(&sent(&view)));
    let place = look_at(Point3::new(Vec3::Y), Point3::new(Vec3::ZERO), Vector3::new(Vec3::Z));
    let projector = Projector::new(place.expect("a place"), 1.0, 1.0).expect("a projector");
    assert!(sent(&projector).windows(12).any(|twelve| twelve == [0, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 0]));
}

#[test]
fn parts_of_meshes_are_sent() {
    assert_eq!(sent(&Subdivision::new(9)), [9, 0, 0, 0]);
    assert_eq!(sent(&Grid::of_texels(5, 4)), [4, 0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0]);
    assert!(sent(&Octahedral([3, -1])).ends_with(&[3, 255]));
}
