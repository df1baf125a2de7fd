//! The kinds of scenes: one kernel each, by an interpolation, a format and a stage; all else is a value.

use crate::seed::{CORNERS, Corner, HEIGHT, Memory, PIXELS, SIDE, Seed, TEXELS, WIDTH};
use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::lanes::Machine;
use alberti::raster::color::{AnyBlend, Bayer, Blended, BlueNoise, Dithered, Rgb332, Rgb888, rgb565};
use alberti::shaders::fog::{AnyFog, ExponentialFog, Fog, Fogged, LinearFog, SquaredFog};
use alberti::shaders::material::{
    AnyLight, AnyLightSpace, AnyReflectance, Bump, Color, Directional, Emission, Framed, Gloss, Gouraud,
    InSpace, Lighting, Material, NormalMap, Occlusion, Parallax, Placed, PointLight, Reflection, Specular,
    SpotLight, Viewer, Wetness,
};
use alberti::shaders::{
    AlphaTest, Differentiated, Mix, Ready565, Slide, Solid, Stored, Sunlit, TexelDither, Unlit, VertexColor,
    VertexColor565,
};
use alberti::texture::environment::{AnyEnvironment, CubeMap};
use alberti::texture::format::{L8, Rgb565, Rgba8888 as Texels};
use alberti::texture::surface::{AnyParallax, CentralDifferences, NormalEncoding, Relief};
use alberti::texture::{AnyFilter, Bilinear, Clamp, Mipmap, Nearest, Texture, Trilinear};
use alberti::{
    AnyDerivatives, ColorFormat, DepthFormat, Exact, FixedPoint, FragmentStage, Frame, Interpolation, Lines,
    Mesh, Pass, Planes, Point3, Projector, Rgb565Le, Rgba8, Rgba8888, Slot, Spans16, Target, Varying,
    Vector3, View, for_lanes,
};

/// A kind: its name, and how it is drawn.
pub type Kind = (&'static str, fn(&mut Seed, Machine, &mut Memory) -> Option<()>);

/// All kinds.
pub const KINDS: &[Kind] = &[
    ("nearest", nearest),
    ("bilinear", bilinear),
    ("spans", spans),
    ("bounded", bounded),
    ("fixed", fixed),
    ("mip-mapped", mip_mapped),
    ("fixed-mip-mapped", fixed_mip_mapped),
    ("stored", stored),
    ("leveled", leveled),
    ("texel-dither", texel_dither),
    ("dithered", dithered),
    ("noise", noise),
    ("blended", blended),
    ("gouraud", gouraud),
    ("fixed-gouraud", fixed_gouraud),
    ("solid", solid),
    ("bytes", bytes),
    ("sunlit", sunlit),
    ("fixed-sunlit", fixed_sunlit),
    ("material", material),
    ("relief", relief),
    ("parallax", parallax),
    ("fixed-material", fixed_material),
    ("vertex-light", vertex_light),
    ("slide", slide),
    ("fog", fog),
];

/// Draws a mesh of that seed; `None` where one of its numbers is refused.
fn draw<C: ColorFormat, V: Varying>(
    seed: &mut Seed,
    machine: Machine,
    (format, color, depth): (C, &mut [C::Pixel], &mut [u32]),
    interpolation: impl Interpolation,
    vertex: impl Fn(&Corner) -> V,
    stage: impl FragmentStage<V>,
) -> Option<()> {
    let (corners, triangles) = seed.mesh();
    let view = View::new(Frame::IDENTITY, seed.projection()?);
    let (frame, of_depth, (cull, sides, subpixel)) = (seed.frame(), seed.depth(), seed.shapes());
    depth.fill(of_depth.farthest());
    let mut target = Target::new(format, of_depth, WIDTH, HEIGHT, color, depth).ok()?;
    let mesh = Mesh::new(&corners, &triangles, |corner: &Corner| (corner.place, vertex(corner)));
    let mut slots = [const { Slot::EMPTY }; CORNERS];
    // Some vertices are transformed once, others for each triangle.
    let slots = slots.get_mut(..seed.below(2) as usize * CORNERS)?;
    let mut pass = Pass::new(&view, &mesh, stage)
        .at(frame)
        .cull(cull)
        .sides(sides)
        .subpixel(subpixel)
        .interpolation(interpolation)
        .slots(slots);
    for_lanes!(machine, lanes => pass.draw_by(lanes, &mut target));
    Some(())
}

/// Straight lines of any kind.
fn lines(seed: &mut Seed) -> Option<Lines> {
    let bounded = Lines::bounded(seed.between(0.0, 0.5));
    seed.pick(&[Lines::affine(), bounded, Lines::spans(4)?, Lines::spans(32)?])
}

fn uv(corner: &Corner) -> Vec2 {
    corner.uv
}

/// The texture of a seed.
fn texture<'a>(seed: &mut Seed, texels: &'a mut [[u8; 4]; TEXELS]) -> Option<Texture<'a, Texels>> {
    seed.texels(texels);
    Texture::new(Texels, texels.get(..(SIDE * SIDE) as usize)?, SIDE, SIDE).ok()
}

macro_rules! textured {
    ($($name:ident: $interpolation:expr, $filter:expr;)+) => {$(
        fn $name(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
            let Memory { color, depth, texels, .. } = memory;
            let texture = texture(seed, texels)?;
            let stage = Unlit(texture.sampler($filter(seed), seed.wrap()));
            let interpolation = $interpolation(seed)?;
            draw(seed, machine, (Rgba8888, color, depth), interpolation, uv, stage)
        }
    )+};
}

textured! {
    nearest: |_: &mut Seed| Some(Exact), |_: &mut Seed| Nearest;
    bilinear: |_: &mut Seed| Some(Planes), |_: &mut Seed| Bilinear;
    spans: |_: &mut Seed| Some(Spans16), |_: &mut Seed| Bilinear;
    bounded: |seed: &mut Seed| lines(seed), |seed: &mut Seed| seed.filter();
    fixed: |seed: &mut Seed| lines(seed).map(FixedPoint), |seed: &mut Seed| seed.filter();
}

fn derivatives(seed: &mut Seed) -> AnyDerivatives {
    use AnyDerivatives::{PerPixel, PerRun, PerTriangle};
    seed.pick(&[PerPixel, PerRun, PerTriangle]).unwrap_or(PerPixel)
}

macro_rules! mip_mapped {
    ($($name:ident: $interpolation:expr;)+) => {$(
        fn $name(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
            let Memory { color, depth, texels, .. } = memory;
            seed.texels(texels);
            let map = Mipmap::new(Texels, texels, SIDE, SIDE).ok()?;
            let sampler = map.sampler(seed.mip_filter(), seed.wrap());
            let stage = Differentiated::by(derivatives(seed), Unlit(sampler));
            let interpolation = $interpolation(seed)?;
            draw(seed, machine, (Rgba8888, color, depth), interpolation, uv, stage)
        }
    )+};
}

mip_mapped! {
    mip_mapped: |_: &mut Seed| Some(Exact);
    fixed_mip_mapped: |seed: &mut Seed| lines(seed).map(FixedPoint);
}

/// Texels of 16 bits, of any bits.
fn words(seed: &mut Seed) -> [u16; TEXELS] {
    [(); TEXELS].map(|()| (seed.word() >> 16).to_le_bytes()).map(|[a, b, ..]| u16::from_le_bytes([a, b]))
}

macro_rules! of_words {
    ($($name:ident: |$map:ident, $wrap:ident| $sampler:expr, |$read:ident| $stage:expr;)+) => {$(
        fn $name(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
            let Memory { half, depth, .. } = memory;
            let words = words(seed);
            let $map = Mipmap::new(Rgb565, &words, SIDE, SIDE).ok()?.power_of_two()?;
            let $wrap = seed.wrap();
            let $read = $sampler;
            let stage = $stage;
            let lines = lines(seed)?;
            draw(seed, machine, (Rgb565Le, half, depth), FixedPoint(lines), uv, stage)
        }
    )+};
}

of_words! {
    stored: |map, wrap| map.level(0).sampler(Nearest, wrap), |sampler| Stored(sampler);
    leveled: |map, wrap| map.sampler(Trilinear, wrap), |sampler| Stored(sampler.leveled());
    texel_dither: |map, wrap| map.level(0).sampler(Bilinear, wrap), |sampler| TexelDither(sampler);
}

fn dithered(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { half, depth, texels, .. } = memory;
    let stage = Unlit(texture(seed, texels)?.sampler(Bilinear, seed.wrap()));
    draw(seed, machine, (Dithered { format: Rgb565Le, by: Bayer }, half, depth), Exact, uv, stage)
}

fn noise(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { half, depth, .. } = memory;
    let format = Dithered { format: Rgb565Le, by: BlueNoise };
    draw(seed, machine, (format, half, depth), Planes, |corner| corner.color, VertexColor)
}

fn blended(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { color, depth, texels, .. } = memory;
    let surface = Unlit(texture(seed, texels)?.sampler(seed.filter(), seed.wrap()));
    let [constant, least, ..] = seed.word().to_le_bytes();
    let ways = [
        AnyBlend::Replace,
        AnyBlend::Constant(constant),
        AnyBlend::Over,
        AnyBlend::Additive,
        AnyBlend::Multiply,
    ];
    let by = seed.pick(&ways)?;
    let stage = AlphaTest { surface, least };
    draw(seed, machine, (Blended { format: Rgba8888, by }, color, depth), Exact, uv, stage)
}

fn gouraud(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { color, depth, .. } = memory;
    draw(seed, machine, (Rgba8888, color, depth), Exact, |corner| corner.color, VertexColor)
}

fn fixed_gouraud(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { half, depth, .. } = memory;
    let (lines, ready) = (FixedPoint(lines(seed)?), |corner: &Corner| Ready565::new(corner.color));
    draw(seed, machine, (Rgb565Le, half, depth), lines, ready, VertexColor565)
}

fn solid(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { half, depth, .. } = memory;
    let color = rgb565(Rgba8::from_bits(seed.word()));
    draw(seed, machine, (Rgb565Le, half, depth), FixedPoint(Lines::affine()), |_| (), Solid(color))
}

fn bytes(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { bytes, depth, texels, .. } = memory;
    if seed.below(2) == 0 {
        let stage = Unlit(texture(seed, texels)?.sampler(Nearest, seed.wrap()));
        return draw(seed, machine, (Rgb888, bytes, depth), Exact, uv, stage);
    }
    let single = bytes.as_flattened_mut().get_mut(..PIXELS)?;
    draw(seed, machine, (Rgb332, single, depth), Exact, |corner| corner.color, VertexColor)
}

macro_rules! sunlit {
    ($($name:ident: $interpolation:expr;)+) => {$(
        fn $name(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
            let Memory { color, depth, texels, .. } = memory;
            let surface = Unlit(texture(seed, texels)?.sampler(Nearest, seed.wrap()));
            let stage = Sunlit::new(surface, Vector3::new(seed.vector(-1.0, 1.0)), 0.2, 0.8);
            let interpolation = $interpolation(seed)?;
            draw(seed, machine, (Rgba8888, color, depth), interpolation, |corner| (corner.normal, corner.uv), stage)
        }
    )+};
}

sunlit! {
    sunlit: |_: &mut Seed| Some(Exact);
    fixed_sunlit: |seed: &mut Seed| lines(seed).map(FixedPoint);
}

/// Any lights, a viewer at the origin, and any reflectance.
fn lighting(seed: &mut Seed) -> Option<Lighting<[AnyLight; 2], AnyReflectance>> {
    let mut light = || {
        let color = seed.vector(0.0, 1.5);
        let falloff = [1.0, seed.between(0.0, 0.5), seed.between(0.0, 0.2)];
        let point = PointLight { position: Point3::new(seed.vector(-4.0, 4.0)), color, falloff };
        let towards = Vector3::new(seed.vector(-1.0, 1.0));
        let ways = [
            AnyLight::Directional(Directional::new(towards, color)),
            AnyLight::Point(point),
            AnyLight::Spot(SpotLight::new(point, towards, [0.9, 0.5])),
        ];
        seed.pick(&ways)
    };
    let lights = [light()?, light()?];
    let exponents = [1 + seed.below(8), 1 + seed.below(200)];
    let ways =
        [AnyReflectance::Lambert, AnyReflectance::Phong(exponents), AnyReflectance::BlinnPhong(exponents)];
    let (reflectance, ambient) = (seed.pick(&ways)?, seed.vector(0.0, 0.5));
    Some(Lighting { viewer: Viewer::at(Point3::new(Vec3::ZERO)), ambient, lights, reflectance })
}

fn placed(corner: &Corner) -> Placed {
    Placed { position: corner.place, normal: corner.normal, uv: corner.uv }
}

fn framed(corner: &Corner) -> Framed {
    let axes = [Vec3::X, Vec3::Y, corner.normal];
    Framed { position: corner.place, axes, uv: corner.uv }
}

fn space(seed: &mut Seed) -> AnyLightSpace {
    seed.pick(&[AnyLightSpace::Srgb, AnyLightSpace::Linear]).unwrap_or(AnyLightSpace::Srgb)
}

fn environment(seed: &mut Seed) -> AnyEnvironment {
    use alberti::texture::environment::{SphereMap, Turned};
    let axes = Mat3::from_cols(Vec3::X, Vec3::NEG_Z, Vec3::Y);
    let sphere = AnyEnvironment::SphereMap(Turned { environment: SphereMap, axes });
    seed.pick(&[AnyEnvironment::LatLong, sphere, AnyEnvironment::CubeMap(CubeMap { side: 2 })])
        .unwrap_or(AnyEnvironment::LatLong)
}

macro_rules! materials {
    ($($name:ident: $interpolation:expr;)+) => {$(
        fn $name(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
            let Memory { color, depth, texels, .. } = memory;
            let texture = texture(seed, texels)?;
            let map = texture.sampler(AnyFilter::Bilinear, seed.wrap());
            let layers = (
                Color(map),
                Specular(Rgba8::from_bits(seed.word())),
                Gloss(map),
                Wetness(Rgba8::from_bits(seed.word())),
                Occlusion { map, strength: seed.between(0.0, 1.0) },
                Emission(Rgba8::from_bits(seed.word() & 0x3f3f_3f3f)),
                Reflection {
                    environment: environment(seed),
                    image: texture.sampler(Bilinear, Clamp),
                    strength: Rgba8::from_bits(seed.word()),
                    facing: seed.between(0.0, 1.0),
                },
            );
            let surface = Material { layers, lighting: lighting(seed)? };
            let stage = InSpace { surface, space: space(seed) };
            let interpolation = $interpolation(seed)?;
            draw(seed, machine, (Rgba8888, color, depth), interpolation, placed, stage)
        }
    )+};
}

materials! {
    material: |_: &mut Seed| Some(Exact);
    fixed_material: |seed: &mut Seed| lines(seed).map(FixedPoint);
}

/// Heights of any bytes.
fn heights(seed: &mut Seed) -> [u8; 64] {
    [(); 64].map(|()| (seed.word() >> 24).to_le_bytes()[0])
}

fn relief(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { color, depth, texels, .. } = memory;
    let texture = texture(seed, texels)?;
    let encoding = seed.pick(&[NormalEncoding::Unorm, NormalEncoding::Centred])?;
    let normals = texture.sampler(Bilinear, seed.wrap());
    let map = NormalMap { map: normals, encoding, strength: seed.between(0.0, 2.0) };
    let heights = heights(seed);
    let heights = Texture::new(L8, &heights, 8, 8).ok()?.sampler(Bilinear, seed.wrap());
    let map_of = CentralDifferences { map: heights, step: Vec2::splat(0.125) };
    let bump = Bump(Relief { map: map_of, low: 0.0, high: seed.between(-0.3, 0.3), extent: Vec2::ONE });
    let color_of = Color(Rgba8::from_bits(seed.word()));
    let lighting = lighting(seed)?;
    if seed.below(2) == 0 {
        let stage = Material { layers: (map, color_of), lighting };
        return draw(seed, machine, (Rgba8888, color, depth), Exact, framed, stage);
    }
    let stage = Material { layers: (bump, color_of), lighting };
    draw(seed, machine, (Rgba8888, color, depth), Planes, framed, stage)
}

fn parallax(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { color, depth, texels, .. } = memory;
    let texture = texture(seed, texels)?;
    let heights = heights(seed);
    let map = Texture::new(L8, &heights, 8, 8).ok()?.sampler(Bilinear, seed.wrap());
    let layers = 2 + seed.below(20);
    let ways = [
        AnyParallax::Offset,
        AnyParallax::Limited,
        AnyParallax::Steep { layers },
        AnyParallax::Occlusion { layers },
    ];
    let relief = Relief { map, low: -seed.between(0.0, 0.2), high: 0.0, extent: Vec2::ONE };
    let layers =
        (Parallax { relief, policy: seed.pick(&ways)? }, Color(texture.sampler(Nearest, seed.wrap())));
    let stage = Material { layers, lighting: lighting(seed)? };
    draw(seed, machine, (Rgba8888, color, depth), Exact, framed, stage)
}

fn vertex_light(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { color, depth, texels, .. } = memory;
    let map = texture(seed, texels)?.sampler(Bilinear, seed.wrap());
    let lighting = lighting(seed)?;
    let vertex = move |corner: &Corner| {
        let [diffuse, specular] = lighting.at_vertex(Point3::new(corner.place), Vector3::new(corner.normal));
        (diffuse, (specular, corner.uv))
    };
    let stage = Gouraud { layers: (Color(map), Specular(Rgba8::from_bits(seed.word()))) };
    draw(seed, machine, (Rgba8888, color, depth), Exact, vertex, stage)
}

fn slide(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { color, depth, texels, .. } = memory;
    let image = texture(seed, texels)?.sampler(AnyFilter::Bilinear, Clamp);
    let place = Frame::from_mat3(Mat3::IDENTITY, Point3::new(seed.vector(-1.0, 4.0)));
    let projector = Projector::new(place, seed.between(0.3, 1.5), 1.0).ok()?;
    let mix = seed.pick(&[Mix::Modulate, Mix::Add])?;
    let stage = Slide { surface: VertexColor, image, mix };
    let vertex = move |corner: &Corner| (projector.project(Point3::new(corner.place)), corner.color);
    draw(seed, machine, (Rgba8888, color, depth), Exact, vertex, stage)
}

fn fog(seed: &mut Seed, machine: Machine, memory: &mut Memory) -> Option<()> {
    let Memory { color, depth, .. } = memory;
    let density = seed.between(0.05, 0.5);
    let start = seed.between(0.0, 2.0);
    let ways = [
        AnyFog::Linear(LinearFog { start, end: start + 6.0 }),
        AnyFog::Exponential(ExponentialFog { density }),
        AnyFog::Squared(SquaredFog { density }),
    ];
    let fog = seed.pick(&ways)?;
    let stage = Fogged { surface: VertexColor, fog, color: Rgba8::from_bits(seed.word()) };
    let vertex = move |corner: &Corner| (fog.coordinate(4.0 + corner.place.z), corner.color);
    draw(seed, machine, (Rgba8888, color, depth), Exact, vertex, stage)
}
