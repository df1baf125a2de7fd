//! Materials, fragment by fragment, against the textbook's formulas in f64; and that only what has mip maps asks for
//! derivatives.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "bytes and bounds are small"
)]

mod hostile;
mod linear;
mod saturation;

use alberti::glam::{DVec3, Vec2, Vec3};
use alberti::raster::{NoDerivatives, PerPixel};
use alberti::shaders::material::{
    BlinnPhong, Color, Directional, Emission, Framed, Gloss, Gouraud, Grazing, Lambert, Lighting, Material,
    NormalMap, ObjectNormals, Occlusion, Phong, Placed, PointLight, Reflectance, Reflection, Specular,
    SpotLight, TwoChannels, Viewer, Wetness,
};
use alberti::texture::environment::LatLong;
use alberti::texture::format::Rgba8888;
use alberti::texture::{Mipmap, Nearest, Repeat, Texture, Trilinear, surface::NormalEncoding::Unorm};
use alberti::{FragmentStage, Frame, Point3, Rgba8, Vector3, World};
use alberti_oracle::material::{
    self as oracle, Angle, Light, Model, Point, Seen, mapped_normal, nearest, numbers, schlick,
};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_oracle::scene;
use std::any::TypeId;

type Sampler<'a> = alberti::texture::Sampler<'a, Rgba8888, Nearest, Repeat>;

/// So many steps of 2^-16 of a byte, for each unit of light: for what is scattered, and for each of the exponent.
const SCATTERED: f64 = 40.0;
const MIRRORED: f64 = 64.0;
/// And for each of the steepness of a spot light's edge.
const EDGE: f64 = 16.0;
const STEP: f64 = 1.0 / 65536.0;

fn wide(v: Vec3) -> [f64; 3] {
    v.as_dvec3().to_array()
}

fn vector(rng: &mut Rng, most: f64) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| rng.uniform(-most, most) as f32))
}

/// A direction of any length between the given ones.
fn direction(rng: &mut Rng, [least, greatest]: [f32; 2]) -> Vec3 {
    loop {
        let v = vector(rng, 1.0);
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize() * rng.log_uniform(least, greatest);
        }
    }
}

/// Texture coordinates: some huge, some tiny, most near the first period.
fn coordinates(rng: &mut Rng) -> Vec2 {
    let mut one = || match rng.index(4) {
        0 => rng.log_uniform(1e-30, 1e9) * if rng.one_in(2) { -1.0 } else { 1.0 },
        _ => rng.uniform(-2.0, 3.0) as f32,
    };
    Vec2::new(one(), one())
}

/// A surface with a frame at right angles, half of them mirrored.
fn framed(rng: &mut Rng) -> Framed {
    let n = direction(rng, [1.0, 1.0]);
    let u = n.any_orthonormal_vector();
    let v = n.cross(u) * if rng.one_in(2) { -1.0 } else { 1.0 };
    Framed { position: vector(rng, 3.0), axes: [u, v, n], uv: coordinates(rng) }
}

/// The same lights twice: as the library's and as the oracle's.
struct Lit {
    lights: (Directional, [PointLight; 2], SpotLight),
    same: [Light; 4],
    viewer: Viewer,
    eye: oracle::Viewer,
    ambient: Vec3,
}

fn lit(rng: &mut Rng) -> Lit {
    let mut color = |most: f64| Vec3::from_array([(); 3].map(|()| rng.uniform(0.0, most) as f32));
    let (ambient, colors) = (color(0.2), [color(0.5), color(0.5), color(0.5), color(0.5)]);
    let to_light = direction(rng, [1e-30, 1e30]);
    let mut point = |color| {
        let mut factor = |most: f64| rng.uniform(0.0, most) as f32;
        let falloff = [factor(0.5) + 0.1, factor(0.3), factor(0.3)];
        PointLight { position: Point3::new(vector(rng, 8.0)), color, falloff }
    };
    let [p, q, spot] = [point(colors[1]), point(colors[2]), point(colors[3])];
    let axis = direction(rng, [1e-30, 1e30]);
    let outer = rng.uniform(-1.0, 0.9) as f32;
    // Some edges are sharp: what is no edge at all counts as the sharpest.
    let inner = outer + if rng.one_in(4) { -0.1 } else { rng.log_uniform(1e-4, 0.1) };
    let edge = f64::max(f64::from(inner) - f64::from(outer), 1.0 / 4096.0);
    let at = |p: PointLight| oracle::Viewer::At(wide(p.position.coords));
    let same = |p: PointLight| Light {
        at: at(p),
        color: wide(p.color),
        falloff: p.falloff.map(f64::from),
        cone: None,
    };
    let sun = Light {
        at: oracle::Viewer::Towards(wide(to_light)),
        color: wide(colors[0]),
        falloff: [1.0, 0.0, 0.0],
        cone: None,
    };
    let cone = Some((wide(axis), [f64::from(outer) + edge, f64::from(outer)]));
    let infinite = rng.one_in(2);
    let place = if infinite { direction(rng, [1e-15, 1e15]) } else { vector(rng, 10.0) };
    Lit {
        lights: (
            Directional::new(Vector3::new(to_light), colors[0]),
            [p, q],
            SpotLight::new(spot, Vector3::new(axis), [inner, outer]),
        ),
        same: [sun, same(p), same(q), Light { cone, ..same(spot) }],
        viewer: if infinite { Viewer::towards(Vector3::new(place)) } else { Viewer::at(Point3::new(place)) },
        eye: if infinite { oracle::Viewer::Towards(wide(place)) } else { oracle::Viewer::At(wide(place)) },
        ambient,
    }
}

impl Lit {
    fn lighting<R>(&self, reflectance: R) -> Lighting<(Directional, [PointLight; 2], SpotLight), R> {
        Lighting { viewer: self.viewer, ambient: self.ambient, lights: self.lights, reflectance }
    }
}

/// The greatest error in bytes, that with an exponent up to 100, and how many fragments were judged.
#[derive(Default)]
struct Worst {
    error: f64,
    usual: f64,
    judged: u32,
}

impl Worst {
    fn judge(&mut self, found: Rgba8, point: &Point, lit: &Lit, model: Model, case: &str) {
        let seen = oracle::seen(point, &lit.same, wide(lit.ambient), model, lit.eye);
        let Seen { color, light, margin, opposite, steepness } = seen;
        let exponent = match model {
            Model::Lambert => 0,
            Model::Phong(exponent) | Model::Blinn(exponent) | Model::Soft(exponent, _) => exponent,
        };
        if margin < 1e-5 {
            return;
        }
        let steps = SCATTERED + EDGE * steepness + MIRRORED * f64::from(exponent) * opposite;
        let bound = 0.5 + steps * STEP * light.max(1.0);
        for (found, exact) in found.to_bytes().into_iter().zip(color) {
            let error = (f64::from(found) - (255.0 * exact).clamp(0.0, 255.0)).abs();
            assert!(
                error <= bound,
                "{case}: {error} of {bound}: {found} for {color:?} by {model:?}, {point:?}"
            );
            self.error = self.error.max(error);
            if exponent <= 100 {
                self.usual = self.usual.max(error);
            }
        }
        self.judged += 1;
    }

    fn done(&self, what: &str) {
        let Self { error, usual, judged } = self;
        println!("{what}: {error:.5} of a byte, {usual:.5} up to an exponent of 100, in {judged} fragments");
        assert!(self.judged > 1000);
    }
}

/// White and matt.
fn plain(position: Vec3, normal: Vec3) -> Point {
    Point {
        position: wide(position),
        normal: wide(normal),
        diffuse: [1.0; 3],
        specular: [0.0; 3],
        emission: [0.0; 3],
        openness: 1.0,
    }
}

/// An exponent from 0 to 2^16, of any scale.
fn exponent(rng: &mut Rng) -> u32 {
    u32::try_from(rng.log_integer(65537) - 1).expect("up to 2^16")
}

#[test]
fn lights_on_a_bare_surface() {
    let mut rng = Rng::stream(run_seed(), 1);
    let mut worst = [(); 5].map(|()| Worst::default());
    for _ in 0..20_000 {
        let lit = lit(&mut rng);
        let surface = Placed {
            position: vector(&mut rng, 3.0),
            normal: direction(&mut rng, [1e-17, 1e17]),
            uv: Vec2::ZERO,
        };
        let layers = (Color(Rgba8::from_rgb24(0xff_a0_33)), Specular(Rgba8::from_rgb24(0x50_ff_99)));
        let point = Point {
            diffuse: numbers([0xff, 0xa0, 0x33, 255]),
            specular: numbers([0x50, 0xff, 0x99, 255]),
            ..plain(surface.position, surface.normal)
        };
        let e = exponent(&mut rng);
        let of = |stage: &dyn Fn() -> Option<Rgba8>| stage().expect("nothing is discarded");
        let found = of(&|| Material { layers, lighting: lit.lighting(Lambert) }.shade_one(surface));
        worst[0].judge(found, &point, &lit, Model::Lambert, "Lambert");
        let found = of(&|| Material { layers, lighting: lit.lighting(Phong(e)) }.shade_one(surface));
        worst[1].judge(found, &point, &lit, Model::Phong(e), "Phong");
        let found = of(&|| Material { layers, lighting: lit.lighting(BlinnPhong(e)) }.shade_one(surface));
        worst[2].judge(found, &point, &lit, Model::Blinn(e), "BlinnPhong");
        let (phong, blinn) = (lit.lighting(Grazing(Phong(e))), lit.lighting(Grazing(BlinnPhong(e))));
        let found = of(&|| Material { layers, lighting: phong }.shade_one(surface));
        worst[3].judge(found, &point, &lit, Model::Soft(e, Angle::Phong), "soft Phong");
        let found = of(&|| Material { layers, lighting: blinn }.shade_one(surface));
        worst[4].judge(found, &point, &lit, Model::Soft(e, Angle::Blinn), "soft BlinnPhong");
    }
    for (worst, name) in worst.iter().zip(["Lambert", "Phong", "BlinnPhong", "soft Phong", "soft BlinnPhong"])
    {
        worst.done(name);
    }
}

/// Before any rounding to bytes, and where highlights are: half of the eyes are about where a light is mirrored.
fn shine<R: Reflectance>(name: &str, stream: u64, reflectance: fn(u32) -> R, model: fn(u32) -> Model) {
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut scattered_worst, mut mirrored_worst, mut highlights) = (0.0, 0.0, 0);
    for _ in 0..30_000 {
        let mut lit = lit(&mut rng);
        let e = exponent(&mut rng);
        let (position, normal) = (vector(&mut rng, 3.0), direction(&mut rng, [1e-17, 1e17]));
        if rng.one_in(2) {
            let l = match lit.same[rng.index(4)].at {
                oracle::Viewer::At(place) => [0, 1, 2].map(|i| place[i] - wide(position)[i]),
                oracle::Viewer::Towards(direction) => direction,
            };
            let l = DVec3::from_array(l).normalize();
            let n = normal.as_dvec3().normalize();
            let aside = vector(&mut rng, 1.0).as_dvec3() / f64::from(e + 1).sqrt();
            let v = (n * (2.0 * n.dot(l)) - l + aside).as_vec3();
            lit.viewer = Viewer::towards(Vector3::new(v));
            lit.eye = oracle::Viewer::Towards(wide(v));
        }
        let found = lit.lighting(reflectance(e)).at_vertex(Point3::new(position), Vector3::new(normal));
        let white = plain(position, normal);
        let exact = [[1.0, 0.0], [0.0, 1.0]].map(|[diffuse, specular]| {
            let point = Point { diffuse: [diffuse; 3], specular: [specular; 3], ..white };
            oracle::seen(&point, &lit.same, wide(lit.ambient), model(e), lit.eye)
        });
        let Seen { light, margin, opposite, steepness, .. } = exact[0];
        if margin < 1e-5 {
            continue;
        }
        let unit = 2f64.powi(-24) * light;
        let bounds =
            [0.0, MIRRORED * f64::from(e) * opposite].map(|more| SCATTERED + EDGE * steepness + more);
        for (k, worst) in [&mut scattered_worst, &mut mirrored_worst].into_iter().enumerate() {
            for (found, exact) in found[k].to_array().into_iter().zip(exact[k].color) {
                let error = (f64::from(found) - exact).abs();
                assert!(error <= bounds[k] * unit, "{name}: {error:e} of {:e}, {e}", bounds[k] * unit);
                *worst = f64::max(*worst, error / (bounds[k] * unit));
            }
        }
        highlights += u32::from(exact[1].color[0] > 0.05);
    }
    println!(
        "{name}: scattered {scattered_worst:.3}, mirrored {mirrored_worst:.3} of the bound, {highlights} highlights"
    );
    assert!(highlights > 3000 || name == "Lambert");
}

#[test]
fn light_at_vertices() {
    shine("Lambert", 6, |_| Lambert, |_| Model::Lambert);
    shine("Phong", 7, Phong::<u32>, Model::Phong);
    shine("BlinnPhong", 8, BlinnPhong::<u32>, Model::Blinn);
    shine("soft Phong", 9, |e| Grazing(Phong(e)), |e| Model::Soft(e, Angle::Phong));
    shine("soft BlinnPhong", 10, |e| Grazing(BlinnPhong(e)), |e| Model::Soft(e, Angle::Blinn));
}

/// Textures of sides that are a power of two, and that are not.
struct Maps {
    bytes: [Vec<[u8; 4]>; 3],
}

const SIDES: [[u32; 2]; 3] = [[8, 8], [5, 3], [1, 4]];

impl Maps {
    fn new(rng: &mut Rng) -> Self {
        let mut texels = |[w, h]: [u32; 2]| (0..w * h).map(|_| (rng.u64() as u32).to_le_bytes()).collect();
        Self { bytes: SIDES.map(&mut texels) }
    }

    fn sampler(&self, k: usize) -> Sampler<'_> {
        let [width, height] = SIDES[k];
        let texture = Texture::new(Rgba8888, &self.bytes[k], width, height).expect("a texture");
        texture.sampler(Nearest, Repeat)
    }

    fn texel(&self, k: usize, uv: Vec2) -> [u8; 4] {
        let [width, height] = SIDES[k];
        nearest(&scene::Texture { width, height, texels: &self.bytes[k] }, uv.as_dvec2().to_array())
    }
}

/// An exponent between two, and whether it is sure which: halves may go either way.
fn between(gloss: f64, [least, greatest]: [u32; 2]) -> (u32, bool) {
    let exact = f64::from(least) + gloss * (f64::from(greatest) - f64::from(least));
    let sure = ((exact - exact.floor()) - 0.5).abs() > 1e-2;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "exponents are not negative")]
    (exact.round() as u32, sure)
}

const WETNESS: [f64; 2] = [0.7, 1.5];

#[test]
fn all_layers_together() {
    let mut rng = Rng::stream(run_seed(), 2);
    let mut worst = Worst::default();
    for _ in 0..8_000 {
        let (maps, lit, surface) = (Maps::new(&mut rng), lit(&mut rng), framed(&mut rng));
        let range = [exponent(&mut rng) / 64, exponent(&mut rng) / 64];
        let strength = rng.uniform(0.2, 2.0) as f32;
        let occlusion = rng.unit() as f32;
        let map = |k: usize| maps.sampler(k);
        let stage = Material {
            layers: (
                Color(map(0)),
                Specular(map(1)),
                Gloss(map(2)),
                Wetness(map(1)),
                Occlusion { map: map(0), strength: occlusion },
                NormalMap { map: map(1), encoding: Unorm, strength },
                Emission(map(2)),
            ),
            lighting: lit.lighting(BlinnPhong(range)),
        };
        let texels = [0, 1, 2].map(|k| maps.texel(k, surface.uv));
        let [a, b, c] = texels.map(numbers);
        let gloss = f64::min(c[0] * (1.0 + WETNESS[1] * b[0]), 1.0);
        let point = Point {
            normal: mapped_normal(texels[1], false, f64::from(strength), surface.axes.map(wide)),
            diffuse: a.map(|share| share * (1.0 - WETNESS[0] * b[0])),
            specular: b,
            emission: c,
            openness: 1.0 + f64::from(occlusion) * (a[0] - 1.0),
            ..plain(surface.position, Vec3::Z)
        };
        let found = stage.shade_one(surface).expect("nothing is discarded");
        assert_eq!(found.to_bytes()[3], texels[0][3], "alpha is the colour's");
        let (exponent, sure) = between(gloss, range);
        if sure {
            worst.judge(found, &point, &lit, Model::Blinn(exponent), "all layers");
        }
    }
    worst.done("all layers");
}

#[test]
fn each_layer_alone() {
    let mut rng = Rng::stream(run_seed(), 3);
    let mut worst = Worst::default();
    for _ in 0..3_000 {
        let (maps, lit, surface) = (Maps::new(&mut rng), lit(&mut rng), framed(&mut rng));
        let map = maps.sampler(1);
        let texel = maps.texel(1, surface.uv);
        let [x, _, _] = numbers(texel);
        let white = plain(surface.position, surface.axes[2]);
        let e = exponent(&mut rng);
        macro_rules! alone {
            ($layer:expr, $($field:ident: $value:expr),*) => {{
                let found = Material { layers: $layer, lighting: lit.lighting(Phong(e)) }.shade_one(surface);
                let point = Point { $($field: $value,)* ..white };
                let found = found.expect("nothing is discarded");
                worst.judge(found, &point, &lit, Model::Phong(e), stringify!($layer));
            }};
        }
        alone!((),);
        alone!(Color(map), diffuse: numbers(texel));
        alone!(Specular(map), specular: numbers(texel));
        alone!(Gloss(map),);
        alone!(Wetness(map), diffuse: [1.0 - WETNESS[0] * x; 3]);
        alone!(Occlusion { map, strength: 0.5 }, openness: 0.5 + 0.5 * x);
        alone!(Emission(map), emission: numbers(texel));
        alone!((Emission(map), Emission(map)), emission: numbers(texel).map(|c| 2.0 * c));
        let axes = surface.axes.map(wide);
        alone!(NormalMap { map, encoding: Unorm, strength: 1.0 }, normal: mapped_normal(texel, false, 1.0, axes));
        alone!(TwoChannels { map, encoding: Unorm, strength: 1.0 }, normal: mapped_normal(texel, true, 1.0, axes));
        let [a, b, c] = surface.axes.map(|axis| Vector3::new(axis * 3.0));
        let frame = Frame::new(Point3::new(Vec3::ONE), a, b, c);
        alone!(ObjectNormals { map, encoding: Unorm, to_world: frame }, normal: mapped_normal(texel, false, 1.0, axes));

        // All around is of one colour, so that the share alone matters.
        let sky = Rgba8::from_rgb24(0x40_80_c0);
        let facing = rng.unit() as f32;
        let mirror = Reflection { environment: LatLong, image: sky, strength: map, facing };
        let to_eye = match lit.eye {
            oracle::Viewer::At(place) => [0, 1, 2].map(|i| place[i] - white.position[i]),
            oracle::Viewer::Towards(direction) => direction,
        };
        let share = x * schlick(f64::from(facing), white.normal, to_eye);
        // What is mirrored is not scattered.
        let emission = numbers(sky.to_bytes()).map(|c| c * share);
        alone!(mirror, emission: emission, diffuse: [1.0 - share; 3]);
    }
    worst.done("each layer alone");
}

#[test]
fn lit_by_vertex_is_lit_by_fragment_at_the_vertices() {
    let mut rng = Rng::stream(run_seed(), 4);
    for _ in 0..3_000 {
        let (maps, lit, surface) = (Maps::new(&mut rng), lit(&mut rng), framed(&mut rng));
        let placed = Placed { position: surface.position, normal: surface.axes[2], uv: surface.uv };
        let layers = (Color(maps.sampler(0)), Specular(maps.sampler(1)), Emission(maps.sampler(2)));
        let lighting = lit.lighting(BlinnPhong(exponent(&mut rng)));
        let [scattered, mirrored] =
            lighting.at_vertex(Point3::new(placed.position), Vector3::new(placed.normal));
        let by_vertex = Gouraud { layers }.shade_one((scattered, (mirrored, placed.uv)));
        assert_eq!(by_vertex, Material { layers, lighting }.shade_one(placed));
    }
}

#[test]
fn lights_that_are_given() {
    let mut rng = Rng::stream(run_seed(), 12);
    let mut worst = 0.0f64;
    for _ in 0..100_000 {
        let [color, specular, emission] = [(); 3].map(|()| (rng.u64() as u32).to_le_bytes());
        let most = [1.0, 4.0][usize::from(rng.u64() & 1 == 1)];
        let [scattered, mirrored] = [(); 2].map(|()| vector(&mut rng, most).abs());
        let map = |[r, g, b, a]: [u8; 4]| Rgba8::new(r, g, b, a);
        let layers = (Color(map(color)), Specular(map(specular)), Emission(map(emission)));
        let found = Gouraud { layers }
            .shade_one((scattered, (mirrored, Vec2::ZERO)))
            .expect("never discards")
            .to_bytes();
        assert_eq!(found[3], color[3]);
        for k in 0..3 {
            let own = |bytes: [u8; 4]| f64::from(bytes[k]);
            let (s, m) = (f64::from(scattered[k]), f64::from(mirrored[k]));
            let exact = own(emission) + own(color) * s + own(specular) * m;
            let sum = f64::max(1.0, 1.0 + s + m);
            let off = (f64::from(found[k]) - exact.min(255.0)).abs();
            assert!(off <= 0.5 + 6.0 * STEP * sum, "{off} of {exact}");
            worst = worst.max(off);
        }
    }
    println!("Gouraud: at most {worst:.5} of a byte off");
    assert!(worst > 0.49);
}
