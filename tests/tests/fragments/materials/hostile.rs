//! Surfaces of which something is not known, and what materials declare.

use super::*;

/// Numbers of all kinds.
fn hostile(rng: &mut Rng) -> f32 {
    match rng.index(6) {
        0 => f32::NAN,
        1 => f32::INFINITY,
        2 => f32::NEG_INFINITY,
        3 => 0.0,
        _ => rng.any_f32(),
    }
}

fn hostile_vector(rng: &mut Rng) -> Vec3 {
    Vec3::new(hostile(rng), hostile(rng), hostile(rng))
}

#[test]
fn where_nothing_is_known_there_is_ambient_light() {
    let mut rng = Rng::stream(run_seed(), 5);
    for _ in 0..20_000 {
        let (maps, lit) = (Maps::new(&mut rng), lit(&mut rng));
        let uv = Vec2::new(hostile(&mut rng), hostile(&mut rng));
        let hostile = Framed {
            position: hostile_vector(&mut rng),
            axes: [(); 3].map(|()| hostile_vector(&mut rng)),
            uv,
        };
        let layers = (Color(maps.sampler(0)), Emission(Rgba8::from_rgb24(0x10_20_30)));
        let lighting = lit.lighting(Phong(exponent(&mut rng)));
        let Lighting { viewer, ambient, reflectance, .. } = lighting;
        let dark = Material { layers, lighting: Lighting { lights: (), viewer, ambient, reflectance } };
        let least = dark.shade_one(hostile).expect("a colour").to_bytes();
        let found = Material { layers, lighting }.shade_one(hostile).expect("a colour").to_bytes();
        assert!(found.iter().zip(least).all(|(found, least)| *found >= least), "{found:?} {least:?}");
        if !hostile.axes[2].is_finite() {
            assert_eq!(found, least, "{hostile:?}");
        }
        let bent = NormalMap { map: maps.sampler(1), encoding: Unorm, strength: f32::NAN };
        let found =
            Material { layers: (layers, bent), lighting }.shade_one(hostile).expect("a colour").to_bytes();
        assert!(found.iter().zip(least).all(|(found, least)| *found >= least), "{found:?} {least:?}");

        let [scattered, mirrored] = lighting.at_vertex(
            Point3::new(Vec3::from_array([(); 3].map(|()| rng.finite_f32()))),
            Vector3::new(Vec3::from_array([(); 3].map(|()| rng.finite_f32()))),
        );
        assert!(scattered.is_finite() && mirrored.is_finite());
    }
}

#[test]
fn what_has_no_direction_looks_along_z_and_a_light_in_its_place_is_bright() {
    let at = |normal| Placed { position: Vec3::ONE, normal, uv: Vec2::ZERO };
    let bulb = PointLight { position: Point3::new(Vec3::ONE), color: Vec3::X, falloff: [0.0, 0.0, 1.0] };
    let lighting = |lights| Lighting {
        viewer: Viewer::at(Point3::new(Vec3::ONE)),
        ambient: Vec3::ZERO,
        lights,
        reflectance: BlinnPhong(5),
    };
    let lit = |normal| Material { layers: (), lighting: lighting(bulb) }.shade_one(at(normal));
    let red = Some(Rgba8::from_rgb24(0xff_00_00));
    assert_eq!([lit(Vec3::ZERO), lit(Vec3::Z), lit(Vec3::X)], [red, red, Some(Rgba8::BLACK)]);
    // As bright as 2^14 in its place, on a dark surface.
    let faint = PointLight { color: Vec3::new(0.5 / 16384.0, 0.0, 0.0), ..bulb };
    let stage = Material { layers: (), lighting: lighting(faint) };
    assert_eq!(stage.shade_one(at(Vec3::Z)), Some(Rgba8::from_rgb24(0x80_00_00)));
    // Without a direction there is no light.
    for nowhere in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        let lights = Directional::new(Vector3::new(nowhere), Vec3::ONE);
        let stage = Material {
            layers: (),
            lighting: Lighting {
                viewer: Viewer::at(Point3::new(Vec3::Z)),
                ambient: Vec3::ZERO,
                lights,
                reflectance: Lambert,
            },
        };
        assert_eq!(stage.shade_one(at(Vec3::Z)), Some(Rgba8::BLACK), "{nowhere}");
    }
}

fn derivatives<S: FragmentStage<Framed>>(_: &S) -> TypeId {
    TypeId::of::<S::Derivatives>()
}

/// And a map that is absent takes no room either.
#[test]
fn only_mip_maps_ask_for_derivatives() {
    fn lighting<R: Reflectance>(reflectance: R) -> Lighting<(), R> {
        Lighting {
            viewer: Viewer::at(Point3::<World>::new(Vec3::Z)),
            ambient: Vec3::ONE,
            lights: (),
            reflectance,
        }
    }
    let texels = [[0; 4]; 5];
    let map = Texture::new(Rgba8888, &texels[..4], 2, 2).expect("a texture").sampler(Nearest, Repeat);
    let mip = Mipmap::new(Rgba8888, &texels, 2, 2).expect("a mip map").sampler(Trilinear, Repeat);
    let [none, each] = [TypeId::of::<NoDerivatives>(), TypeId::of::<PerPixel>()];
    let bare = Material { layers: (), lighting: lighting(Lambert) };
    assert_eq!(derivatives(&bare), none);
    assert_eq!(size_of_val(&bare), size_of_val(&lighting(Lambert)));
    let without = (
        Color(map),
        Specular(map),
        Gloss(map),
        NormalMap { map, encoding: Unorm, strength: 1.0 },
        Emission(Rgba8::BLACK),
    );
    assert_eq!(derivatives(&Material { layers: without, lighting: lighting(Phong(3)) }), none);
    let last =
        (Color(map), Specular(map), Gloss(map), NormalMap { map: mip, encoding: Unorm, strength: 1.0 });
    assert_eq!(derivatives(&Material { layers: last, lighting: lighting(Phong([3, 4])) }), each);
    let nested = (Color(map), (Occlusion { map: mip, strength: 1.0 }, ()));
    assert_eq!(derivatives(&Material { layers: nested, lighting: lighting(Lambert) }), each);
}
