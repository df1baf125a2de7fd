//! Plain surfaces by the kernels of their own and by the one for all, and what lies on any surface: an image, a fog,
//! holes, mixtures.

use super::Cases;
use super::lights::studio;
use super::maps::{full, layers, material};
use super::scene::{COLOR, DIFFUSE, SPECULAR, Scene, image, point};
use super::typed::{InBoth, Picture, Sheet, framed, normal_uv, painted, place, uv};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::Lanes;
use alberti::raster::color::{Additive, AnyBlend, Constant, Multiply, Over, Premultiplied};
use alberti::shaders::fog::{AnyFog, ExponentialFog, Fog, Fogged, LinearFog, SquaredFog};
use alberti::shaders::material::{Framed, Map, Times};
use alberti::shaders::{AlphaTest, Mix, Slide, Sunlit, Unlit, VertexColor};
use alberti::texture::{Bilinear, Clamp, Mirror, Nearest, Repeat, Texture, format::Rgba8888};
use alberti::{
    F32, FixedPoint, FragmentStage, Fragments, Homogeneous, Lines, Projector, Rgba8, Varying, Vector3,
    look_at,
};
use alberti_app::draw::{AMBIENT, DIFFUSE as LAMP, to_light};
use alberti_app::options::{Arithmetic, Filter, Haze, KeyLight, Shading, Wrap};
use alberti_app::scene::{self, Camera, Part, Vertex};

/// A scene without lights, with a texture or none.
fn plain(shading: Shading, texture: Option<usize>, filter: Filter, wrap: Wrap) -> Scene {
    let mut scene = Scene::new().dark().by(|options| {
        (options.shading, options.filter, options.wrap) = (shading, filter, wrap);
    });
    scene.model.parts[0].texture = texture;
    scene
}

fn lamp<S>(scene: &Scene, surface: S) -> Sunlit<S> {
    Sunlit::new(surface, Vector3::new(to_light(&scene.camera)), AMBIENT, LAMP)
}

fn color(v: &Vertex) -> (Vec3, Vec3) {
    (place(v), Vec3::from_array(v.color))
}

fn fixed(scene: &Scene) -> Scene {
    scene.clone().by(|options| {
        options.policies.interpolation = "spans:8".parse().expect("a name");
        options.policies.arithmetic = Arithmetic::Fixed;
    })
}

/// A scene in floats and in fixed point is what a stage draws.
fn in_both<V: Varying, S: FragmentStage<V, Color = Rgba8>>(
    cases: &mut Cases,
    name: &str,
    scene: &Scene,
    vertex: &dyn Fn(&Vertex) -> (Vec3, V),
    stage: S,
) {
    cases.check(name, scene, &painted(scene, vertex, stage));
    let by = FixedPoint(Lines::spans(8).expect("a power of two"));
    let sheet = Sheet::new(scene, F32).paint_by::<V, S::Derivatives>((0, vertex), &InBoth(stage), by);
    let expected = sheet.picture();
    cases.check(&format!("{name} in fixed point"), &fixed(scene), &expected);
}

/// A plain surface of a map, unlit or beside a lamp, with the holes of the scene.
fn is_of(cases: &mut Cases, name: &str, scene: &Scene, map: impl Map) {
    let shading = scene.options.shading;
    let (name, least) = (format!("{name} {shading:?}"), scene.model.parts[0].detail.alpha_test);
    if shading == Shading::Unlit {
        in_both(cases, &name, scene, &uv, AlphaTest { surface: Unlit(map), least });
    } else {
        in_both(cases, &name, scene, &normal_uv, AlphaTest { surface: lamp(scene, Unlit(map)), least });
    }
}

#[test]
fn plain_surfaces_are_those_of_the_library() {
    let mut cases = Cases::default();
    let all = &Scene::new();
    let own = plain(Shading::VertexColor, Some(COLOR), Filter::Bilinear, Wrap::Repeat);
    in_both(&mut cases, "vertices' colours", &own, &color, VertexColor);
    for shading in [Shading::Unlit, Shading::Lambert] {
        let white = |mut scene: Scene| {
            scene.model.parts[0].diffuse = [1.0; 3];
            scene
        };
        let smooth = plain(shading, None, Filter::Bilinear, Wrap::Repeat);
        is_of(&mut cases, "colour", &smooth, DIFFUSE);
        // Of these texels there is a shorter way.
        let tiles = white(plain(shading, Some(COLOR), Filter::Nearest, Wrap::Repeat));
        is_of(&mut cases, "tiles", &tiles, all.texture(COLOR).sampler(Nearest, Repeat));
        let tinted = plain(shading, Some(COLOR), Filter::Nearest, Wrap::Repeat);
        let map = all.texture(COLOR).sampler(Nearest, Repeat);
        is_of(&mut cases, "tinted tiles", &tinted, Times { factor: DIFFUSE, map });
        let odd = white(plain(shading, Some(SPECULAR), Filter::Nearest, Wrap::Mirror));
        is_of(&mut cases, "mirrored", &odd, all.texture(SPECULAR).sampler(Nearest, Mirror));
        let smooth = plain(shading, Some(SPECULAR), Filter::Bilinear, Wrap::Clamp);
        let map = all.texture(SPECULAR).sampler(Bilinear, Clamp);
        is_of(&mut cases, "smooth", &smooth, Times { factor: DIFFUSE, map });
        let holes = plain(shading, Some(COLOR), Filter::Bilinear, Wrap::Repeat);
        let map = Times { factor: DIFFUSE, map: all.map(COLOR) };
        is_of(&mut cases, "holes", &holes.with(|d| d.alpha_test = 120), map);
    }
    // Three lights, whose sum is divided by the normal's length at once.
    let direction = [-35.0, 50.0];
    let scene = plain(Shading::Lambert, Some(COLOR), Filter::Bilinear, Wrap::Repeat)
        .by(|options| options.light.key = KeyLight::Studio(direction));
    let map = Unlit(Times { factor: DIFFUSE, map: all.map(COLOR) });
    let (ambient, lights) = studio(&scene, direction);
    in_both(&mut cases, "studio", &scene, &normal_uv, InStudio { map, ambient, lights });
    cases.done(28);
}

/// A map under the three lights of a studio: a stage that the library has not.
#[derive(Clone, Copy)]
struct InStudio<S> {
    map: S,
    ambient: f32,
    lights: [(Vec3, f32); 3],
}

impl<S: FragmentStage<Vec2, Color = Rgba8>> FragmentStage<(Vec3, Vec2)> for InStudio<S> {
    type Color = Rgba8;
    type Derivatives = S::Derivatives;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (Vec3, Vec2)>) -> (L::U32, L::Mask) {
        let (lanes, ([x, y, z], _)) = (fragments.lanes, fragments.varying);
        let (color, mask) = self.map.shade(&fragments.part(|(_, uv)| *uv));
        let zero = lanes.splat(0.0);
        let sum = self.lights.iter().fold(zero, |sum, &(to_light, strength)| {
            let [a, b, c] = (to_light * strength).to_array().map(|c| lanes.splat(c));
            sum + lanes.max(x * a + y * b + z * c, zero)
        });
        let arriving = sum / lanes.sqrt(x * x + y * y + z * z);
        let light = lanes.splat(self.ambient) + lanes.select(lanes.less(zero, sum), arriving, zero);
        let lit = |shift| {
            let channel = lanes.to_numbers(lanes.shr(color, shift) & lanes.word(255));
            lanes.shl(lanes.nearest_byte(channel * light), shift)
        };
        (lit(0) | lit(8) | lit(16) | (color & lanes.word(0xff00_0000)), mask)
    }
}

/// The varying of a surface under a projector.
type Thrown = (Homogeneous, Framed);

/// A stage for the frame alone.
#[derive(Clone, Copy)]
struct Lit<S>(S);

impl<S: FragmentStage<(Vec3, Vec2), Color = Rgba8>> FragmentStage<Framed> for Lit<S> {
    type Color = Rgba8;
    type Derivatives = S::Derivatives;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Framed>) -> (L::U32, L::Mask) {
        self.0.shade(&fragments.part(|framed| (framed.axes[2], framed.uv)))
    }
}

/// A fog whose distance is found at each fragment, as it is linear in space.
#[derive(Clone, Copy)]
struct Hazy<S, F> {
    surface: S,
    fog: F,
    color: Rgba8,
    slope: Vec3,
    origin: f32,
}

impl<S, F> Hazy<S, F> {
    /// A fog of a coordinate that is `scale` times the distance from `start` on.
    fn new(scene: &Scene, surface: S, fog: F, color: Rgba8, [scale, start]: [f64; 2]) -> Self {
        let (forward, eye) =
            (scene.place().axes().z_axis.as_dvec3(), scene.place().origin().coords.as_dvec3());
        let origin = (-(forward.dot(eye) + start) * scale) as f32;
        Self { surface, fog, color, slope: (forward * scale).as_vec3(), origin }
    }
}

impl<S: FragmentStage<Thrown, Color = Rgba8>, F: Fog> FragmentStage<Thrown> for Hazy<S, F> {
    type Color = Rgba8;
    type Derivatives = S::Derivatives;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Thrown>) -> (L::U32, L::Mask) {
        let (lanes, (color, mask)) = (fragments.lanes, self.surface.shade(fragments));
        let Vec3 { x, y, z } = self.slope;
        let [a, b, c] = fragments.varying.1.position;
        let term = |c, slope| lanes.saturating_mul(c, lanes.splat(slope));
        let along = lanes.saturating_add(lanes.splat(self.origin), term(a, x));
        let along = lanes.saturating_add(lanes.saturating_add(along, term(b, y)), term(c, z));
        let fogged = Fogged { surface: (), fog: self.fog, color: self.color };
        (fogged.on(lanes, along, color), mask)
    }
}

/// A stage beside the projector's image.
#[derive(Clone, Copy)]
struct Beside<S>(S);

impl<S: FragmentStage<Framed, Color = Rgba8>> FragmentStage<Thrown> for Beside<S> {
    type Color = Rgba8;
    type Derivatives = S::Derivatives;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Thrown>) -> (L::U32, L::Mask) {
        self.0.shade(&fragments.part(|(_, framed)| *framed))
    }
}

fn beside(v: &Vertex) -> (Vec3, Thrown) {
    let (place, framed) = framed(v);
    (place, (Homogeneous::default(), framed))
}

#[test]
fn images_fogs_and_holes_are_those_of_the_library() {
    let cases = &mut Cases::default();
    let all = &full(Scene::new());
    let whole = material(all, layers(|number| all.map(number), all.relief(Repeat), all.lat_long()));
    let simple = &plain(Shading::Lambert, Some(COLOR), Filter::Bilinear, Wrap::Repeat);
    let skin = Lit(lamp(simple, Unlit(Times { factor: DIFFUSE, map: simple.map(COLOR) })));

    let color = Rgba8::new(200, 190, 210, 255);
    let fogged = |scene: &Scene, fog| {
        let [r, g, b, _] = color.to_bytes();
        scene.clone().by(|options| options.haze = Some(Haze { fog, color: [r, g, b] }))
    };
    let [start, end] = [1.5, 5.0];
    let linear = LinearFog { start, end };
    let parts = [1.0 / (f64::from(end) - f64::from(start)), start.into()];
    let near = fogged(all, AnyFog::Linear(linear));
    in_both(cases, "linear", &near, &beside, Hazy::new(all, Beside(whole), linear, color, parts));
    let near = fogged(simple, AnyFog::Linear(linear));
    in_both(cases, "linear, plain", &near, &beside, Hazy::new(all, Beside(skin), linear, color, parts));
    let density = 0.375;
    let fog = ExponentialFog { density };
    let stage = Hazy::new(all, Beside(whole), fog, color, [density.into(), 0.0]);
    in_both(cases, "exponential", &fogged(all, AnyFog::Exponential(fog)), &beside, stage);
    let fog = SquaredFog { density };
    let stage = Hazy::new(all, Beside(whole), fog, color, [density.into(), 0.0]);
    in_both(cases, "squared", &fogged(all, AnyFog::Squared(fog)), &beside, stage);

    let slide = image(99, [24, 18]);
    let thrower = Camera { eye: [-1.2, 1.9, 1.6], fov: 45.0, up: [0.0, 1.0, 0.0], ..all.camera };
    let place = look_at(point(thrower.eye), point(thrower.target), Vector3::new(Vec3::Y)).expect("a place");
    let projector = Projector::new(place, 45_f32.to_radians(), 24.0 / 18.0).expect("a projector");
    let texture = Texture::new(Rgba8888, &slide.texels, 24, 18).expect("a texture");
    let thrown = |v: &Vertex| {
        let (place, framed) = framed(v);
        (place, (projector.project(point(v.position)), framed))
    };
    let with = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.model.slide = Some(scene::Slide { image: slide.clone().into(), projector: thrower });
        scene
    };
    let (image, mix) = (texture.sampler(Bilinear, Clamp), Mix::Modulate);
    in_both(cases, "slide", &with(all), &thrown, Slide { surface: whole, image, mix });
    in_both(cases, "slide, plain", &with(simple), &thrown, Slide { surface: skin, image, mix });
    let nearest = with(all).by(|options| options.filter = Filter::Nearest);
    let maps = |number| all.texture(number).sampler(Nearest, Repeat);
    let surface = material(all, layers(maps, all.relief(Repeat), all.lat_long()));
    let sharp = texture.sampler(Nearest, Clamp);
    in_both(cases, "sharp slide", &nearest, &thrown, Slide { surface, image: sharp, mix });
    // Holes first, then the image, and the fog before both.
    let everything = fogged(&with(all), AnyFog::Linear(linear)).with(|d| d.alpha_test = 90);
    let surface = Slide { surface: AlphaTest { surface: whole, least: 90 }, image, mix };
    let stage = Hazy::new(all, surface, linear, color, parts);
    in_both(cases, "fog before a slide with holes", &everything, &thrown, stage);
    cases.done(16);
}

/// The sheets as a part of their own.
fn apart(scene: Scene, blend: AnyBlend) -> Scene {
    let mut scene = scene;
    let part = &mut scene.model.parts[0];
    let sheets = part.triangles.split_off(12);
    let mut second = Part { triangles: sheets, ..part.clone() };
    second.detail.blend = blend;
    scene.model.parts.push(second);
    scene
}

#[test]
fn mixtures_are_those_of_the_library() {
    let mut cases = Cases::default();
    let all = &full(Scene::new());
    let whole = material(all, layers(|number| all.map(number), all.relief(Repeat), all.lat_long()));
    let whole = Beside(whole);
    let patch = |scene| Sheet::new(scene, F32).paint(0, &beside, whole);
    macro_rules! check {
        ($name:literal, $any:expr, $blend:expr) => {
            let scene = apart(all.clone(), $any);
            let expected = patch(&scene).mix(1, &beside, whole, $blend).picture();
            cases.check($name, &scene, &expected);
        };
    }
    let solid = apart(all.clone(), AnyBlend::Replace);
    let expected = patch(&solid).paint(1, &beside, whole).picture();
    cases.check("solid", &solid, &expected);
    check!("over", AnyBlend::Over, Over);
    check!("constant", AnyBlend::Constant(100), Constant(100));
    check!("premultiplied", AnyBlend::Premultiplied, Premultiplied);
    check!("additive", AnyBlend::Additive, Additive);
    check!("multiply", AnyBlend::Multiply, Multiply);

    // Before what is added a fog is black, and before what multiplies white.
    let fog = LinearFog { start: 1.0, end: 4.0 };
    let haze = Haze { fog: AnyFog::Linear(fog), color: [210, 200, 190] };
    let before = |color| Hazy::new(all, whole, fog, color, [1.0 / 3.0, 1.0]);
    let color = Rgba8::new(210, 200, 190, 255);
    let patch = |scene| Sheet::new(scene, F32).paint(0, &beside, before(color));
    macro_rules! check {
        ($name:literal, $any:expr, $blend:expr, $color:expr) => {
            let scene = apart(all.clone(), $any).by(|options| options.haze = Some(haze));
            let expected = patch(&scene).mix(1, &beside, before($color), $blend).picture();
            cases.check($name, &scene, &expected);
        };
    }
    check!("over, in fog", AnyBlend::Over, Over, color);
    check!("additive, in fog", AnyBlend::Additive, Additive, Rgba8::new(0, 0, 0, 255));
    check!("multiply, in fog", AnyBlend::Multiply, Multiply, Rgba8::WHITE);
    cases.done(9);
}

#[test]
fn pictures_are_compared() {
    let scene = Scene::new();
    let (one, other) = (Picture::of(&scene), Picture::of(&scene.clone().textured()));
    assert!(one.differing(&one) == 0 && one.differing(&other) > 3000);
}
