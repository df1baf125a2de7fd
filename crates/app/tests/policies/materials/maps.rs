//! Each map alone, and all together by each filter and wrap mode.

use super::Cases;
use super::scene::{
    COLOR, CUBE, DIFFUSE, EMISSIVE, EXPONENTS, GLOSS, GLOW, LAT_LONG, MIRROR, NORMAL, OCCLUSION, REFLECTION,
    SHINE, SPECULAR, SPHERE, STRENGTH, Scene, TEXEL, TURNED, WET, WETNESS, around, bulb, carried, map, point,
    shares, sun, torch,
};
use super::typed::{Picture, framed, painted};
use alberti::glam::{Mat3, Vec3};
use alberti::lanes::Lanes;
use alberti::shaders::material::{
    BlinnPhong, Bump, Color, Emission, Framed, Gloss, Grazing, Layer, Lighting, Map, Material, NormalMap,
    ObjectNormals, Occlusion, Parallax, Reflection, Specular, Surface, Times, Wetness,
};
use alberti::shaders::{AlphaTest, material::Light};
use alberti::texture::environment::{CubeMap, LatLong, SphereMap, Turned};
use alberti::texture::format::Rgba8888;
use alberti::texture::surface::{
    CentralDifferences, HeightMap, LimitedParallax, NormalEncoding::Unorm, OffsetParallax, ParallaxOcclusion,
    Relief, SteepParallax,
};
use alberti::texture::{
    Anisotropic, Bilinear, Clamp, Filter, MipFilter, Mipmap, Mirror, Nearest, Repeat, Trilinear, Wrap,
};
use alberti::{Frame, NoDerivatives, Rgba8, Varying};
use alberti_app::options::{self, Probes};
use alberti_app::scene::{self, Detail, EnvironmentKind, NormalSpace, Vertex};
use std::fmt::Debug;

/// The material of some layers as the scene has it by default: by Blinn, under all lights.
pub(super) fn material<M>(
    scene: &Scene,
    layers: M,
) -> Material<M, impl Light + use<M>, Grazing<BlinnPhong<[u32; 2]>>> {
    let lighting = Lighting {
        viewer: scene.viewer(),
        ambient: around(false),
        lights: (sun(false), bulb(false), torch(false)),
        reflectance: Grazing(BlinnPhong(EXPONENTS)),
    };
    Material { layers, lighting }
}

fn lit(scene: &Scene, layers: impl Layer<Framed>) -> Picture {
    painted(scene, &framed, material(scene, layers))
}

/// Layers without a map.
const BARE: (Color<Rgba8>, Specular<Rgba8>) = (Color(DIFFUSE), Specular(SHINE));

fn times<M>(factor: Rgba8, map: M) -> Times<M> {
    Times { factor, map }
}

fn bump<H: Copy>(relief: Relief<H>) -> Bump<CentralDifferences<H>> {
    let Relief { map, low, high, extent } = relief;
    Bump(Relief { map: CentralDifferences { map, step: TEXEL }, low, high, extent })
}

fn object_normals<M>(map: M) -> ObjectNormals<M> {
    let axes = Mat3::from_cols_array_2d(&TURNED);
    ObjectNormals { map, encoding: Unorm, to_world: Frame::from_mat3(axes, point([0.0; 3])) }
}

/// The vertices' colours on the surface: a layer that the library has not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tint;

impl Layer<Framed> for Tint {
    type Derivatives = NoDerivatives;

    fn apply<L: Lanes>(&self, _: L, varyings: &<Framed as Varying>::Of<L::Number>, surface: &mut Surface<L>) {
        let [tint, ..] = varyings.axes;
        for (channel, factor) in surface.diffuse.iter_mut().zip(tint) {
            *channel = *channel * factor;
        }
    }
}

/// The attributes for that: colours instead of a tangent.
pub(super) fn tinted(v: &Vertex, linear: bool) -> (Vec3, Framed) {
    let (position, whole) = framed(v);
    (position, Framed { axes: [carried(v, linear), Vec3::ZERO, whole.axes[2]], ..whole })
}

#[test]
fn each_map_of_colours_and_numbers_is_its_layer() {
    let mut cases = Cases::default();
    let plain = Scene::new();
    let all = &plain.clone();
    let mut check = |name: &str, scene: Scene, expected: Picture| cases.check(name, &scene, &expected);
    check("nothing", plain.clone(), lit(all, BARE));
    let painted_on = Color(times(DIFFUSE, all.map(COLOR)));
    check("colour", plain.clone().textured(), lit(all, (painted_on, Specular(SHINE))));
    let with = |change: &dyn Fn(&mut Detail)| plain.clone().with(change);

    let layer = Specular(times(SHINE, all.map(SPECULAR)));
    check("specular", with(&|d| d.specular_map = map(SPECULAR)), lit(all, (Color(DIFFUSE), layer)));
    check("gloss", with(&|d| d.shininess_map = map(GLOSS)), lit(all, (BARE, Gloss(all.map(GLOSS)))));
    check("wet", with(&|d| d.wetness = shares(WET)[0]), lit(all, (BARE, Wetness(WET))));
    let wet = |d: &mut Detail| (d.wetness, d.wetness_map) = (shares(WET)[0], map(WETNESS));
    check("wetness", with(&wet), lit(all, (BARE, Wetness(times(WET, all.map(WETNESS))))));
    let drying = (Gloss(all.map(GLOSS)), Wetness(times(WET, all.map(WETNESS))));
    let both = plain.clone().with(wet).with(|d| d.shininess_map = map(GLOSS));
    check("gloss and wetness", both, lit(all, (BARE, drying)));
    let open = Occlusion { map: all.map(OCCLUSION), strength: 1.0 };
    check("occlusion", with(&|d| d.occlusion = map(OCCLUSION)), lit(all, (BARE, open)));
    check("glow", with(&|d| d.emissive = shares(GLOW)), lit(all, (BARE, Emission(GLOW))));
    let glowing = Emission(times(GLOW, all.map(EMISSIVE)));
    let glow = |d: &mut Detail| (d.emissive, d.emissive_map) = (shares(GLOW), map(EMISSIVE));
    check("emission", with(&glow), lit(all, (BARE, glowing)));

    let colored = with(&|d| d.colored = true);
    check("colours", colored, painted(all, &|v| tinted(v, false), material(all, (BARE, Tint))));
    let holes = plain.clone().textured().with(|d| d.alpha_test = 100);
    let stage = AlphaTest { surface: material(all, (painted_on, Specular(SHINE))), least: 100 };
    check("holes", holes, painted(all, &framed, stage));
    cases.done(12);
}

#[test]
fn each_relief_is_its_layers() {
    let mut cases = Cases::default();
    let all = &Scene::new();
    let textured = Scene::new().textured();
    let skin = (Color(times(DIFFUSE, all.map(COLOR))), Specular(SHINE));
    let mut check = |name: &str, scene: Scene, expected: Picture| cases.check(name, &scene, &expected);

    check("smooth", textured.clone().raised(scene::Relief::Displacement), lit(all, skin));
    let normals = |strength| NormalMap { map: all.map(NORMAL), encoding: Unorm, strength };
    for strength in [1.0, STRENGTH] {
        let bent = textured.clone().bent(NormalSpace::Tangent, scene::NormalMap::UNTURNED, strength);
        check(&format!("normals {strength}"), bent, lit(all, (normals(strength), skin)));
    }
    let object = textured.clone().bent(NormalSpace::Object, TURNED, 1.0);
    check("object's normals", object.clone(), lit(all, (object_normals(all.map(NORMAL)), skin)));
    let tint = |v: &Vertex| tinted(v, false);
    let colored = object.with(|d| d.colored = true);
    let layers = (object_normals(all.map(NORMAL)), skin, Tint);
    check("object's normals with colours", colored, painted(all, &tint, material(all, layers)));

    let relief = all.relief(Repeat);
    let raised = |kind| textured.clone().raised(kind);
    check("bump", raised(scene::Relief::Bump), lit(all, (bump(relief), skin)));
    let by = Parallax { relief, policy: OffsetParallax };
    check("offset", raised(scene::Relief::Parallax), lit(all, (by, bump(relief), skin)));
    let by = Parallax { relief, policy: LimitedParallax };
    check("limited", raised(scene::Relief::ParallaxLimited), lit(all, (by, bump(relief), skin)));
    let by = Parallax { relief, policy: SteepParallax { layers: 16 } };
    check("steep", raised(scene::Relief::Steep), lit(all, (by, bump(relief), skin)));
    let by = Parallax { relief, policy: ParallaxOcclusion { layers: 32 } };
    check("occluding", raised(scene::Relief::Occlusion), lit(all, (by, bump(relief), skin)));
    // Its own normals are those of a surface that has both.
    let both =
        raised(scene::Relief::Occlusion).bent(NormalSpace::Tangent, scene::NormalMap::UNTURNED, STRENGTH);
    check("occluding with normals", both, lit(all, (by, normals(STRENGTH), skin)));
    let both = raised(scene::Relief::Bump).bent(NormalSpace::Object, TURNED, 1.0);
    // Where a relief needs tangents, vertices carry no colours.
    let both = both.with(|d| d.colored = true);
    let expected = lit(all, (object_normals(all.map(NORMAL)), skin));
    assert!(Picture::of(&both) == expected);
    let mirrored = raised(scene::Relief::Bump).with(|d| {
        d.height.as_mut().expect("heights").wrap = Some(options::Wrap::Mirror);
    });
    check("bump, mirrored", mirrored, lit(all, (bump(all.relief(Mirror)), skin)));
    cases.done(12);
}

fn mirror<E, I, M>(environment: E, image: I, strength: M) -> Reflection<E, I, M> {
    Reflection { environment, image, strength, facing: 1.0 }
}

#[test]
fn each_environment_is_its_layer() {
    let mut cases = Cases::default();
    let all = &Scene::new();
    let around = |image, kind, map| {
        Scene::new().with(|d| {
            d.environment = Some(scene::Environment { image, kind });
            (d.reflection, d.reflection_map) = (shares(MIRROR)[0], map);
        })
    };
    let (round, square) = (all.lat_long(), |number| all.texture(number).sampler(Bilinear, Clamp));
    let ball = Turned { environment: SphereMap, axes: all.place().axes() };
    let cube = CubeMap { side: 6 };
    let shares = times(MIRROR, all.map(REFLECTION));
    let mut check = |name: &str, scene: Scene, expected: Picture| cases.check(name, &scene, &expected);

    let image = |kind| match kind {
        EnvironmentKind::LatLong => LAT_LONG,
        EnvironmentKind::Cube => CUBE,
        EnvironmentKind::Sphere => SPHERE,
    };
    let scenes = |map| {
        let of = |kind| around(image(kind), kind, map);
        [of(EnvironmentKind::LatLong), of(EnvironmentKind::Cube), of(EnvironmentKind::Sphere)]
    };
    let [a, b, c] = scenes(None);
    check("panorama", a, lit(all, (BARE, mirror(LatLong, round, MIRROR))));
    check("cube", b, lit(all, (BARE, mirror(cube, square(CUBE), MIRROR))));
    check("ball", c, lit(all, (BARE, mirror(ball, square(SPHERE), MIRROR))));
    let [a, b, c] = scenes(map(REFLECTION));
    check("panorama by a map", a, lit(all, (BARE, mirror(LatLong, round, shares))));
    check("cube by a map", b, lit(all, (BARE, mirror(cube, square(CUBE), shares))));
    check("ball by a map", c, lit(all, (BARE, mirror(ball, square(SPHERE), shares))));
    // The bent normal mirrors, and what is mirrored is neither darkened by water nor occluded.
    let [scene, ..] = scenes(map(REFLECTION));
    let scene = scene.bent(NormalSpace::Tangent, scene::NormalMap::UNTURNED, 1.0).with(|d| {
        (d.wetness, d.occlusion, d.emissive) = (super::scene::shares(WET)[0], map(OCCLUSION), [0.2; 3]);
    });
    let normals = NormalMap { map: all.map(NORMAL), encoding: Unorm, strength: 1.0 };
    let open = Occlusion { map: all.map(OCCLUSION), strength: 1.0 };
    let own = (Wetness(WET), Emission(Rgba8::new(51, 51, 51, 255)));
    let layers = (normals, BARE, own, open, mirror(LatLong, round, shares));
    check("panorama on a wet relief", scene, lit(all, layers));
    cases.done(7);
}

/// All maps.
pub(super) fn full(scene: Scene) -> Scene {
    let scene = scene.textured().raised(scene::Relief::Occlusion);
    scene.bent(NormalSpace::Tangent, scene::NormalMap::UNTURNED, STRENGTH).with(|d| {
        (d.specular_map, d.shininess_map) = (map(SPECULAR), map(GLOSS));
        (d.wetness, d.wetness_map) = (shares(WET)[0], map(WETNESS));
        (d.emissive, d.emissive_map) = (shares(GLOW), map(EMISSIVE));
        d.occlusion = map(OCCLUSION);
        d.environment = Some(scene::Environment { image: LAT_LONG, kind: EnvironmentKind::LatLong });
        (d.reflection, d.reflection_map) = (shares(MIRROR)[0], map(REFLECTION));
    })
}

type Flat<M> = (Color<Times<M>>, Specular<Times<M>>, Gloss<M>, Wetness<Times<M>>, Emission<Times<M>>);

/// The layers of all maps that need neither a place nor a frame.
pub(super) fn flat<M: Map>(of: impl Fn(usize) -> M) -> Flat<M> {
    (
        Color(times(DIFFUSE, of(COLOR))),
        Specular(times(SHINE, of(SPECULAR))),
        Gloss(of(GLOSS)),
        Wetness(times(WET, of(WETNESS))),
        Emission(times(GLOW, of(EMISSIVE))),
    )
}

/// The layers of all maps.
pub(super) fn layers<M: Map>(
    of: impl Fn(usize) -> M,
    relief: Relief<impl HeightMap + Copy + Debug>,
    image: impl Map,
) -> impl Layer<Framed> {
    (
        Parallax { relief, policy: ParallaxOcclusion { layers: 32 } },
        NormalMap { map: of(NORMAL), encoding: Unorm, strength: STRENGTH },
        flat(&of),
        Occlusion { map: of(OCCLUSION), strength: 1.0 },
        mirror::<LatLong, _, _>(LatLong, image, times(MIRROR, of(REFLECTION))),
    )
}

/// The layers of all maps, of one level.
fn one_level<W: Wrap>(scene: &Scene, filter: impl Filter, wrap: W) -> impl Layer<Framed> {
    layers(move |number| scene.texture(number).sampler(filter, wrap), scene.relief(wrap), scene.lat_long())
}

/// The same, with smaller ones.
pub(super) fn levels<W: Wrap>(
    scene: &Scene,
    chains: &[Vec<[u8; 4]>],
    filter: impl MipFilter,
    wrap: W,
) -> impl Layer<Framed> {
    let of = move |number: usize| {
        let image = &scene.model.textures[number];
        let all = Mipmap::new(Rgba8888, &chains[number], image.width, image.height);
        all.expect("levels").sampler(filter, wrap)
    };
    layers(of, scene.relief(wrap), scene.lat_long())
}

#[test]
fn all_maps_have_the_filter_and_the_wrap_mode_of_the_picture() {
    let mut cases = Cases::default();
    let all = &full(Scene::new());
    let chains = &all.chains();
    let mut check = |name: &str, filter: &str, wrap, expected: Picture| {
        let filter = filter.parse().expect("a filter");
        let scene = all.clone().by(|options| (options.filter, options.wrap) = (filter, wrap));
        cases.check(name, &scene, &expected);
    };
    let wraps = [options::Wrap::Repeat, options::Wrap::Clamp, options::Wrap::Mirror];
    let [repeat, clamp, mirror] = wraps;
    check("nearest", "nearest", repeat, lit(all, one_level(all, Nearest, Repeat)));
    check("bilinear", "bilinear", repeat, lit(all, one_level(all, Bilinear, Repeat)));
    check("trilinear", "trilinear", repeat, lit(all, levels(all, chains, Trilinear, Repeat)));
    let probing = |probes| Anisotropic { probes, filter: Trilinear };
    for probes in [2, 4, 8, 16] {
        let expected = lit(all, levels(all, chains, probing(probes), Repeat));
        // Few pixels are squeezed more than four times, none sixteen times.
        if probes == 16 {
            let most = options::Filter::Anisotropic(Probes::Sixteen);
            assert!(Picture::of(&all.clone().by(|options| options.filter = most)) == expected);
        } else {
            check(&format!("{probes} probes"), &format!("anisotropic:{probes}"), repeat, expected);
        }
    }
    check("nearest, clamped", "nearest", clamp, lit(all, one_level(all, Nearest, Clamp)));
    check("nearest, mirrored", "nearest", mirror, lit(all, one_level(all, Nearest, Mirror)));
    check("trilinear, clamped", "trilinear", clamp, lit(all, levels(all, chains, Trilinear, Clamp)));
    check("trilinear, mirrored", "trilinear", mirror, lit(all, levels(all, chains, Trilinear, Mirror)));
    cases.done(10);
}

#[test]
fn each_map_may_have_a_filter_and_a_wrap_mode_of_its_own() {
    let all = &full(Scene::new());
    let chains = &all.chains();
    let one = |number: usize| all.texture(number);
    let several = |number: usize| {
        let image = &all.model.textures[number];
        Mipmap::new(Rgba8888, &chains[number], image.width, image.height).expect("levels")
    };
    let layers = (
        Parallax { relief: all.relief(Mirror), policy: ParallaxOcclusion { layers: 32 } },
        NormalMap { map: several(NORMAL).sampler(Trilinear, Clamp), encoding: Unorm, strength: STRENGTH },
        Color(times(DIFFUSE, one(COLOR).sampler(Nearest, Mirror))),
        (
            Specular(times(SHINE, several(SPECULAR).sampler(Trilinear, Mirror))),
            Gloss(one(GLOSS).sampler(Nearest, Clamp)),
            Wetness(times(WET, one(WETNESS).sampler(Bilinear, Mirror))),
            Emission(times(GLOW, one(EMISSIVE).sampler(Bilinear, Clamp))),
        ),
        Occlusion { map: several(OCCLUSION).sampler(Trilinear, Repeat), strength: 1.0 },
        mirror(
            LatLong,
            all.lat_long(),
            times(MIRROR, several(REFLECTION).sampler(Anisotropic { probes: 8, filter: Trilinear }, Repeat)),
        ),
    );
    let expected = lit(all, layers);
    let scene = all.clone().with(|d| {
        use options::{Filter, Wrap};
        let own = |image, filter, wrap| scene::Map { image, filter: Some(filter), wrap: Some(wrap) };
        d.height.as_mut().expect("heights").wrap = Some(Wrap::Mirror);
        d.normal.as_mut().expect("normals").map = own(NORMAL, Filter::Trilinear, Wrap::Clamp);
        (d.filter, d.wrap) = (Some(Filter::Nearest), Some(Wrap::Mirror));
        d.specular_map = Some(own(SPECULAR, Filter::Trilinear, Wrap::Mirror));
        d.shininess_map = Some(own(GLOSS, Filter::Nearest, Wrap::Clamp));
        d.wetness_map = Some(own(WETNESS, Filter::Bilinear, Wrap::Mirror));
        d.emissive_map = Some(own(EMISSIVE, Filter::Bilinear, Wrap::Clamp));
        // These have the picture's.
        d.reflection_map = Some(scene::Map {
            filter: Some(Filter::Anisotropic(Probes::Eight)),
            ..map(REFLECTION).expect("a map")
        });
        d.occlusion = Some(scene::Map { filter: Some(Filter::Trilinear), ..map(OCCLUSION).expect("a map") });
    });
    let mut cases = Cases::default();
    cases.check("all", &scene, &expected);
    cases.check("those of the picture", all, &lit(all, one_level(all, Bilinear, Repeat)));
    cases.done(2);
}
