//! Policies named at run time draw what the library draws with the types of those names, bit for bit.

mod materials;

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::One;
use alberti::shaders::{Mix, Slide, Sunlit, Unlit};
use alberti::texture::{Bilinear, Clamp, Nearest, Repeat, TexelFormat as _, Texture, format};
use alberti::{
    Affine, ColorFormat as Pixels, D16, D24, D32, DESKTOP, DepthFormat as Depths, Exact, F32, FixedPoint,
    FragmentStage, Lines, MCU, Mesh, NoDepth, Pass, Planes, Point3, Profile, Projector, REFERENCE, Rgb565Le,
    Rgba8, Rgba8888, Sub4, Sub8, TINY, Target, Varying, Vector3, look_at,
};
use alberti_app::draw::{AMBIENT, DIFFUSE, to_light, view};
use alberti_app::options::{
    self, Arithmetic, ColorFormat, DepthFormat, Filter, Interpolation, LightOptions, Lod, Policies,
    RenderOptions, Shading, SpanLength, Subpixel, Wrap,
};
use alberti_app::render::render;
use alberti_app::scene::{self, Vertex};
use alberti_app::scenes::{self, BuiltIn};
use std::num::NonZero;

const SIZE: (u32, u32) = (160, 120);

/// A pixel in memory, and the colour that a display shows of it.
trait Shown: Copy {
    const BLANK: Self;
    fn shown(self, big_endian: bool) -> [u8; 4];
}

impl Shown for u32 {
    const BLANK: Self = 0;
    fn shown(self, _: bool) -> [u8; 4] {
        self.to_ne_bytes()
    }
}

impl Shown for u16 {
    const BLANK: Self = 0;
    fn shown(self, big_endian: bool) -> [u8; 4] {
        let word = if big_endian { Self::from_be(self) } else { Self::from_le(self) };
        format::Rgb565.decode(word).to_bytes()
    }
}

/// The scene's one part by the library.
fn by_library<V: Varying>(
    profile: Profile<impl alberti::Interpolation, impl Pixels<Pixel: Shown>, impl Depths>,
    scene: &BuiltIn,
    vertex_stage: impl Fn(&Vertex) -> (Vec3, V),
    stage: impl FragmentStage<V, Color = Rgba8>,
    big_endian: bool,
) -> Vec<[u8; 4]> {
    let (width, height) = SIZE;
    let pixels = (width * height) as usize;
    let (mut color, mut depth) = (vec![Shown::BLANK; pixels], vec![profile.depth.farthest(); pixels]);
    let mut target = profile.target(width, height, &mut color, &mut depth).expect("fits");
    let [r, g, b] = scene.background;
    target.clear(Rgba8::new(r, g, b, 255));
    let view = view(&scene.camera).expect("a view");
    let mesh = Mesh::new(&scene.model.vertices, &scene.model.parts[0].triangles, vertex_stage);
    Pass::new(&view, &mesh, stage).with(profile).draw_by(One, &mut target);
    color.into_iter().map(|pixel| pixel.shown(big_endian)).collect()
}

/// The same by names.
fn by_name(
    scene: &BuiltIn,
    shading: Shading,
    filter: Filter,
    choice: (Policies, DepthFormat),
) -> Vec<[u8; 4]> {
    let options = options(scene, shading, filter, choice);
    render(&scene.model, &scene.camera, &options, &mut |_, _| {}).expect("a picture").image.texels
}

fn options(
    scene: &BuiltIn,
    shading: Shading,
    filter: Filter,
    (policies, depth): (Policies, DepthFormat),
) -> RenderOptions {
    let (width, height) = SIZE;
    RenderOptions {
        width,
        height,
        background: scene.background,
        shading,
        filter,
        wrap: Wrap::Repeat,
        cull: options::Cull::Back,
        depth,
        projection: options::Projection::Perspective,
        haze: None,
        light: LightOptions::default(),
        threads: NonZero::<usize>::MIN,
        policies,
    }
}

/// A texture as it is, of the nearest texel, on the floor.
fn unlit(
    profile: Profile<impl alberti::Interpolation, impl Pixels<Pixel: Shown>, impl Depths>,
    choice: (Policies, DepthFormat),
    big_endian: bool,
) {
    let scene = scenes::by_name("floor").expect("a scene");
    let image = &scene.model.textures[0];
    let texture = Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture");
    let vertex = |v: &Vertex| (Vec3::from_array(v.position), Vec2::from_array(v.uv));
    let stage = Unlit(texture.sampler(Nearest, Repeat));
    let expected = by_library(profile, &scene, vertex, stage, big_endian);
    assert!(by_name(&scene, Shading::Unlit, Filter::Nearest, choice) == expected, "{choice:?}");
}

/// A filtered texture with light, on the knot.
fn lit(
    profile: Profile<impl alberti::Interpolation, impl Pixels<Pixel: Shown>, impl Depths>,
    choice: (Policies, DepthFormat),
    big_endian: bool,
) {
    let scene = scenes::by_name("mesh").expect("a scene");
    let image = &scene.model.textures[0];
    let texture = Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture");
    let vertex =
        |v: &Vertex| (Vec3::from_array(v.position), (Vec3::from_array(v.normal), Vec2::from_array(v.uv)));
    let surface = Unlit(texture.sampler(Bilinear, Repeat));
    let stage = Sunlit::new(surface, Vector3::new(to_light(&scene.camera)), AMBIENT, DIFFUSE);
    let expected = by_library(profile, &scene, vertex, stage, big_endian);
    assert!(by_name(&scene, Shading::Lambert, Filter::Bilinear, choice) == expected, "{choice:?}");
}

/// A slide on a textured floor, in parallel projection: types that only this test names.
#[test]
fn projections_and_projectors_are_those_of_the_library() {
    let scene = scenes::by_name("floor").expect("a scene");
    let (width, height) = SIZE;
    let image = &scene.model.textures[0];
    let texture =
        Texture::new(format::Rgba8888, &image.texels, image.width, image.height).expect("a texture");
    let projector = scene::Camera { eye: [1.0, 3.0, 0.5], fov: 60.0, ..scene.camera };
    let place = look_at(
        Point3::new(Vec3::from_array(projector.eye)),
        Point3::new(Vec3::from_array(projector.target)),
        Vector3::new(Vec3::from_array(projector.picture_up())),
    );
    let thrown = Projector::new(place.expect("a place"), 60f32.to_radians(), 1.0).expect("a projector");
    let scene::Camera { near, far, .. } = scene.camera;
    let point = |p: [f32; 3]| Point3::new(Vec3::from_array(p));
    let up = Vector3::new(Vec3::from_array(scene.camera.picture_up()));
    let camera = alberti::Camera::look_at(point(scene.camera.eye), point(scene.camera.target), up);
    let parallel = camera.expect("a camera").parallel(4.0, near..far).expect("a box");
    let mesh = Mesh::new(&scene.model.vertices, &scene.model.parts[0].triangles, |v: &Vertex| {
        let position = Vec3::from_array(v.position);
        (position, (thrown.project(Point3::new(position)), Vec2::from_array(v.uv)))
    });
    let stage = Slide {
        surface: Unlit(texture.sampler(Nearest, Repeat)),
        image: texture.sampler(Nearest, Clamp),
        mix: Mix::Modulate,
    };
    let (mut color, mut depth) = (vec![0; (width * height) as usize], vec![1.0; (width * height) as usize]);
    let mut target = Target::new(Rgba8888, F32, width, height, &mut color, &mut depth).expect("fits");
    let [r, g, b] = scene.background;
    target.clear(Rgba8::new(r, g, b, 255));
    Pass::new(&parallel, &mesh, stage).interpolation(Affine).draw(&mut target);

    let policies = Policies { interpolation: Interpolation::Affine, ..Policies::default() };
    let plain = options(&scene, Shading::Unlit, Filter::Nearest, (policies, DepthFormat::F32));
    let projection = options::Projection::Parallel { height: 4.0 };
    let slide = Some(scene::Slide { image: image.clone(), projector });
    let lit = scene::Model { slide, ..scene.model.clone() };
    let drawn = |model: &scene::Model, options: RenderOptions| {
        render(model, &scene.camera, &options, &mut |_, _| {}).expect("a picture").image.texels
    };
    let expected: Vec<_> = color.into_iter().map(u32::to_ne_bytes).collect();
    let parallel = RenderOptions { projection, ..plain };
    assert!(drawn(&lit, parallel) == expected);
    // Neither without the other, and not without both.
    for (model, options) in [(&scene.model, parallel), (&lit, plain), (&scene.model, plain)] {
        let other = drawn(model, options);
        let differ = other.iter().zip(&expected).filter(|(a, b)| a != b).count();
        assert!(differ > expected.len() / 20, "{differ} pixels");
    }
}

#[test]
fn profiles_are_those_of_the_library() {
    let choice = options::Profile::policies;
    lit(REFERENCE, choice(options::Profile::Reference), false);
    lit(DESKTOP, choice(options::Profile::Desktop), false);
    lit(MCU, choice(options::Profile::Mcu), true);
    lit(TINY, choice(options::Profile::Tiny), true);
    unlit(MCU, choice(options::Profile::Mcu), true);
    unlit(TINY, choice(options::Profile::Tiny), true);
}

/// Those by their places.
const fn profile<P, C, D>(
    interpolation: P,
    subpixel: alberti::Subpixel,
    color: C,
    depth: D,
) -> Profile<P, C, D>
where
    P: Copy,
    C: Copy,
    D: Copy,
{
    Profile { interpolation, subpixel, color, depth }
}

#[test]
fn so_is_each_policy() {
    use {Arithmetic::*, Interpolation as I, Subpixel as S};
    let policies = |interpolation, arithmetic, color, subpixel| {
        let lod = Lod::default();
        Policies { interpolation, arithmetic, color, subpixel, lod, ..Policies::default() }
    };
    let (rgba, small) = (ColorFormat::Rgba8, ColorFormat::Rgb565);
    let bounded = I::Bounded(0.25);
    let long = I::Spans(SpanLength::ThirtyTwo);
    let (budget, lines) = (Lines::bounded(0.25 / 256.0), Lines::spans(32).expect("a power of two"));
    let fixed = FixedPoint(budget);
    let choice = |interpolation, arithmetic, color, subpixel, depth| {
        (policies(interpolation, arithmetic, color, subpixel), depth)
    };
    unlit(
        profile(Planes, Sub8, Rgba8888, D24),
        choice(I::Plane, Float, rgba, S::Sub8, DepthFormat::U24),
        false,
    );
    unlit(
        profile(Exact, Sub4, Rgb565Le, D16),
        choice(I::Exact, Float, small, S::Sub4, DepthFormat::U16),
        false,
    );
    unlit(profile(lines, Sub4, Rgba8888, D32), choice(long, Float, rgba, S::Sub4, DepthFormat::U32), false);
    unlit(
        profile(Affine, Sub8, Rgba8888, NoDepth),
        choice(I::Affine, Float, rgba, S::Sub8, DepthFormat::None),
        false,
    );
    unlit(
        profile(budget, Sub8, Rgba8888, F32),
        choice(bounded, Float, rgba, S::Sub8, DepthFormat::F32),
        false,
    );
    unlit(
        profile(fixed, Sub8, Rgb565Le, D32),
        choice(bounded, Fixed, small, S::Sub8, DepthFormat::U32),
        false,
    );
    lit(profile(budget, Sub8, Rgba8888, F32), choice(bounded, Float, rgba, S::Sub8, DepthFormat::F32), false);
}
