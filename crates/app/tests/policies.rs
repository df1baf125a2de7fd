//! Policies named at run time draw what the library draws with the types of those names, bit for bit.

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::One;
use alberti::shaders::{Lambert, Modulate, Slide, Unlit};
use alberti::texture::{Bilinear, Clamp, Nearest, Repeat, TexelFormat as _, Texture, format};
use alberti::{
    Affine, Band, BandOf, Bounded, Cull, D16, D24, D32, DepthFormat as _, Exact, F32, FixedPoint,
    FragmentStage, Interpolated, Mcu, NoDepth, Parallel, Pass, PixelOf, Plane, Point3, Profile, Projector,
    Reference, Rgb565Le, Rgba8, Sides, Slot, SlotOf, Spans, Sub4, Sub8, Tiny, Varying, Vector3, VertexStage,
    View, draw, draw_by, look_at,
};
use alberti_app::draw::{AMBIENT, DIFFUSE, to_light, view};
use alberti_app::options::{
    self, ColorFormat, DepthFormat, Filter, Interpolation, Numbers, Policies, RenderOptions, Shading,
    SpanLength, Subpixel, Wrap,
};
use alberti_app::render::render;
use alberti_app::scene::{self, Vertex};
use alberti_app::scenes::{self, BuiltIn};

const SIZE: (u32, u32) = (160, 120);

/// What a display shows of a pixel in memory.
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
        format::Rgb565::decode(word).to_bytes()
    }
}

/// The scene's one part by the library.
fn by_library<P, V>(
    scene: &BuiltIn,
    vertex_stage: impl VertexStage<Vertex, Varying = V>,
    fragment_stage: impl FragmentStage<V, Color = Rgba8>,
    big_endian: bool,
) -> Vec<[u8; 4]>
where
    P: Profile,
    PixelOf<P>: Shown,
    V: Varying,
{
    let (width, height) = SIZE;
    let pixels = (width * height) as usize;
    let (mut color, mut depth) = (vec![PixelOf::<P>::BLANK; pixels], vec![P::Depth::FARTHEST; pixels]);
    let mut band: BandOf<'_, P> = Band::new(width, 0, &mut color, &mut depth).expect("fits");
    let [r, g, b] = scene.background;
    band.clear(Rgba8::new(r, g, b, 255));
    let pass = Pass {
        view: view(&scene.camera, width, height).expect("a view"),
        vertices: &scene.model.vertices,
        triangles: &scene.model.parts[0].triangles,
        vertex_stage,
        fragment_stage,
        cull: Cull::Back,
        sides: Sides::GuardBand,
        interpolation: P::INTERPOLATION,
    };
    let mut slots = vec![SlotOf::<P, V>::EMPTY; scene.model.vertices.len()];
    draw_by(One, &pass, &mut band, &mut slots, &mut ());
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
        policies,
    }
}

/// A texture as it is, of the nearest texel, on the floor.
fn unlit<P: Profile>(choice: (Policies, DepthFormat), big_endian: bool)
where
    PixelOf<P>: Shown,
{
    let scene = scenes::by_name("floor").expect("a scene");
    let image = &scene.model.textures[0];
    let texture = Texture::<Rgba8>::new(&image.texels, image.width, image.height).expect("a texture");
    let vertex = |v: &Vertex| (Point3::new(Vec3::from_array(v.position)), Vec2::from_array(v.uv));
    let expected =
        by_library::<P, _>(&scene, vertex, Unlit(texture.sampler::<Nearest, Repeat>()), big_endian);
    assert!(by_name(&scene, Shading::Unlit, Filter::Nearest, choice) == expected, "{choice:?}");
}

/// A filtered texture with light, on the knot.
fn lit<P: Profile>(choice: (Policies, DepthFormat), big_endian: bool)
where
    PixelOf<P>: Shown,
{
    let scene = scenes::by_name("mesh").expect("a scene");
    let image = &scene.model.textures[0];
    let texture = Texture::<Rgba8>::new(&image.texels, image.width, image.height).expect("a texture");
    let vertex = |v: &Vertex| {
        let carried = (Vec3::from_array(v.normal), Vec2::from_array(v.uv));
        (Point3::new(Vec3::from_array(v.position)), carried)
    };
    let surface = Unlit(texture.sampler::<Bilinear, Repeat>());
    let stage = Lambert::new(surface, Vector3::new(to_light(&scene.camera)), AMBIENT, DIFFUSE);
    let expected = by_library::<P, _>(&scene, vertex, stage, big_endian);
    assert!(by_name(&scene, Shading::Lambert, Filter::Bilinear, choice) == expected, "{choice:?}");
}

/// A slide on a textured floor, in parallel projection: types that only this test names.
#[test]
fn projections_and_projectors_are_those_of_the_library() {
    let scene = scenes::by_name("floor").expect("a scene");
    let (width, height) = SIZE;
    let image = &scene.model.textures[0];
    let texture = Texture::<Rgba8>::new(&image.texels, image.width, image.height).expect("a texture");
    let projector = scene::Camera { eye: [1.0, 3.0, 0.5], fov: 60.0, ..scene.camera };
    let place = look_at(
        Point3::new(Vec3::from_array(projector.eye)),
        Point3::new(Vec3::from_array(projector.target)),
        Vector3::new(Vec3::from_array(projector.up)),
    );
    let thrown = Projector::new(place.expect("a place"), 60f32.to_radians(), 1.0).expect("a projector");
    let View { to_eye, viewport, .. } = view(&scene.camera, width, height).expect("a view");
    let scene::Camera { near, far, .. } = scene.camera;
    let parallel = Parallel::new(4.0, 4.0 / 3.0, near, far).expect("a box");
    let pass = Pass {
        view: View { to_eye, projection: parallel, viewport },
        vertices: &scene.model.vertices,
        triangles: &scene.model.parts[0].triangles,
        vertex_stage: |v: &Vertex| {
            let position = Vec3::from_array(v.position);
            (Point3::new(position), (thrown.project(Point3::new(position)), Vec2::from_array(v.uv)))
        },
        fragment_stage: Slide {
            surface: Unlit(texture.sampler::<Nearest, Repeat>()),
            image: texture.sampler::<Nearest, Clamp>(),
            mix: Modulate,
        },
        cull: Cull::Back,
        sides: Sides::GuardBand,
        interpolation: Parallel::INTERPOLATION,
    };
    let (mut color, mut depth) = (vec![0; (width * height) as usize], vec![1.0; (width * height) as usize]);
    let mut band = Band::<Rgba8, F32>::new(width, 0, &mut color, &mut depth).expect("whole rows");
    let [r, g, b] = scene.background;
    band.clear(Rgba8::new(r, g, b, 255));
    draw(&pass, &mut band, &mut [Slot::<Sub8, _>::EMPTY; 16], &mut ());

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
    lit::<Reference>(choice(options::Profile::Reference), false);
    lit::<alberti::Desktop>(choice(options::Profile::Desktop), false);
    lit::<Mcu>(choice(options::Profile::Mcu), true);
    lit::<Tiny>(choice(options::Profile::Tiny), true);
    unlit::<Mcu>(choice(options::Profile::Mcu), true);
    unlit::<Tiny>(choice(options::Profile::Tiny), true);
}

/// A profile for a test: its name and types.
macro_rules! profile {
    ($name:ident: $interpolation:ty = $value:expr, $depth:ty, $color:ty, $subpixel:ty) => {
        #[derive(Clone, Copy, Debug)]
        enum $name {}

        impl Profile for $name {
            type Interpolation = $interpolation;
            const INTERPOLATION: $interpolation = $value;
            type Depth = $depth;
            type Color = $color;
            type Subpixel = $subpixel;
        }
    };
}
profile!(Planes: Plane = Plane, D24, Rgba8, Sub8);
profile!(Coarse: Exact = Exact, D16, Rgb565Le, Sub4);
profile!(Long: Spans<32> = Spans, D32, Rgba8, Sub4);
profile!(Straight: Affine = Affine, NoDepth, Rgba8, Sub8);
profile!(Budget: Bounded = Bounded { budget: 0.25 / 256.0 }, F32, Rgba8, Sub8);
profile!(FixedBudget: FixedPoint<Bounded> = FixedPoint(Bounded { budget: 0.25 / 256.0 }), D32, Rgb565Le, Sub8);

#[test]
fn so_is_each_policy() {
    use {Interpolation as I, Numbers::*, Subpixel as S};
    let policies =
        |interpolation, numbers, color, subpixel| Policies { interpolation, numbers, color, subpixel };
    let (rgba, small) = (ColorFormat::Rgba8, ColorFormat::Rgb565);
    let bounded = I::Bounded(0.25);
    let long = I::Spans(SpanLength::ThirtyTwo);
    unlit::<Planes>((policies(I::Plane, Float, rgba, S::Sub8), DepthFormat::U24), false);
    unlit::<Coarse>((policies(I::Exact, Float, small, S::Sub4), DepthFormat::U16), false);
    unlit::<Long>((policies(long, Float, rgba, S::Sub4), DepthFormat::U32), false);
    unlit::<Straight>((policies(I::Affine, Float, rgba, S::Sub8), DepthFormat::None), false);
    unlit::<Budget>((policies(bounded, Float, rgba, S::Sub8), DepthFormat::F32), false);
    unlit::<FixedBudget>((policies(bounded, Fixed, small, S::Sub8), DepthFormat::U32), false);
    lit::<Budget>((policies(bounded, Float, rgba, S::Sub8), DepthFormat::F32), false);
}
