//! The policies whose prices are measured, on scenes that a program reads: a textured mesh in RGB565, not lit unless
//! the name says so. A lit one has normals as if it were about the origin.
//!
//! Each is a name and a function of its own, so that a program which draws by one contains no other.

use crate::{HEIGHT, PIXELS, WIDTH};
use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::lanes::One;
use alberti::raster::{PerRun, PerTriangle};
use alberti::shaders::{Differentiated, Light, Lit565, Stored, Sunlit, Unlit};
use alberti::texture::mipmap::texel_count;
use alberti::texture::{Bilinear, Mipmap, Nearest, PowerOfTwo, Repeat, Texture, Trilinear, format::Rgb565};
use alberti::{
    Affine, D16, D24, D32, DepthFormat, Exact, F32, F32Reversed, FixedPoint, FragmentStage, Frame, Geometry,
    IntegerMesh, IntegerVertex, Interpolation, Lines, Mesh, NoDepth, Octahedral, Pass, Perspective, Planes,
    Point3, Q16, Rgb565Le, Slot, Spans16, Staged, Sub4, Sub8, Subpixel, Varying, Vector3, View,
};

/// A vertex with a texture.
#[derive(Clone, Copy, Debug)]
pub struct Mapped {
    /// In the world.
    pub position: [f32; 3],
    /// In textures: 1 is a whole one.
    pub uv: [f32; 2],
    /// Of length 1.
    pub normal: Vec3,
}

/// The same as `alberti bake` has it in flash.
#[derive(Clone, Copy, Debug)]
pub struct Packed {
    place: [i16; 3],
    uv: [u16; 2],
    normal: [i8; 2],
}

/// Something to draw.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// From where.
    pub view: View,
    /// The mesh.
    pub vertices: &'a [Mapped],
    /// The mesh in integers, with the unit of places and the shift of texture coordinates.
    pub packed: (&'a [Packed], f32, u32),
    /// Three indices each.
    pub triangles: &'a [[u16; 3]],
    /// The texture.
    pub texture: Texture<'a, Rgb565, PowerOfTwo>,
    /// All its levels.
    pub levels: Mipmap<'a, Rgb565, PowerOfTwo>,
}

/// A way of drawing a scene.
#[derive(Clone, Copy, Debug)]
pub struct Policy {
    /// By what it is called in the tables.
    pub name: &'static str,
    /// One frame. The memory has been cleared.
    pub draw: fn(&mut Memory, &Scene<'_>),
}

/// Defines the policies: numbers and interpolation, depth, grid, and how the texture is read.
macro_rules! policies {
    (@ $memory:ident, $scene:ident, $ways:ident, $stage:expr) => {
        draw($memory, $scene, &mapped($scene), $ways, $stage)
    };
    (@lambert $memory:ident, $scene:ident, $ways:ident, $stage:expr) => {
        draw($memory, $scene, &normals($scene), $ways, sunlit($stage))
    };
    (@integers $memory:ident, $scene:ident, $ways:ident, $stage:expr) => {
        draw($memory, $scene, &integers($scene), $ways, $stage)
    };
    (@vertex $memory:ident, $scene:ident, $ways:ident, $stage:expr) => {
        draw($memory, $scene, &lit_vertices($scene), $ways, Lit565 { surface: $stage })
    };
    (@baked $memory:ident, $scene:ident, $ways:ident, $stage:expr) => {
        draw($memory, $scene, &baked($scene), $ways, sunlit($stage))
    };
    ($($name:literal: $interpolation:expr, $depth:expr, $subpixel:expr, $stage:ident $(, $kind:ident)?;)*) => {
        /// All of them.
        pub const POLICIES: &[Policy] = &[$(Policy {
            name: $name,
            draw: |memory, scene| {
                let ways = (($interpolation)(scene), $depth, $subpixel);
                policies!(@$($kind)? memory, scene, ways, $stage(scene));
            },
        },)*];
    };
}

policies! {
    "float exact": |_| Exact, D16, Sub4, nearest;
    "float plane": |_| Planes, D16, Sub4, nearest;
    "float spans:4": |_| spans(4), D16, Sub4, nearest;
    "float spans:8": |_| spans(8), D16, Sub4, nearest;
    "float spans:16": |_| Spans16, D16, Sub4, nearest;
    "float spans:32": |_| spans(32), D16, Sub4, nearest;
    "float bounded:0.0625": |scene| bounded(0.0625, scene), D16, Sub4, nearest;
    "float bounded:0.25": |scene| bounded(0.25, scene), D16, Sub4, nearest;
    "float affine": |_| Affine, D16, Sub4, nearest;
    "fixed spans:4": |_| FixedPoint(spans(4)), D16, Sub4, nearest;
    "fixed spans:8": |_| FixedPoint(spans(8)), D16, Sub4, nearest;
    "fixed spans:16": |_| FixedPoint(Spans16), D16, Sub4, nearest;
    "fixed spans:32": |_| FixedPoint(spans(32)), D16, Sub4, nearest;
    "fixed bounded:0.0625": |scene| FixedPoint(bounded(0.0625, scene)), D16, Sub4, nearest;
    "fixed bounded:0.25": |scene| FixedPoint(bounded(0.25, scene)), D16, Sub4, nearest;
    "fixed affine": |_| FixedPoint(Affine), D16, Sub4, nearest;
    "fixed spans:16, none": |_| FixedPoint(Spans16), NoDepth, Sub4, nearest;
    "fixed spans:16, u24": |_| FixedPoint(Spans16), D24, Sub4, nearest;
    "fixed spans:16, u32": |_| FixedPoint(Spans16), D32, Sub4, nearest;
    "fixed spans:16, f32": |_| FixedPoint(Spans16), F32, Sub4, nearest;
    "fixed spans:16, f32-reversed": |_| FixedPoint(Spans16), F32Reversed, Sub4, nearest;
    "float exact, none": |_| Exact, NoDepth, Sub4, nearest;
    "float exact, u24": |_| Exact, D24, Sub4, nearest;
    "float exact, u32": |_| Exact, D32, Sub4, nearest;
    "float exact, f32": |_| Exact, F32, Sub4, nearest;
    "float exact, f32-reversed": |_| Exact, F32Reversed, Sub4, nearest;
    "fixed spans:16, 8": |_| FixedPoint(Spans16), D16, Sub8, nearest;
    "float exact, 8": |_| Exact, D16, Sub8, nearest;
    "fixed spans:16, bilinear": |_| FixedPoint(Spans16), D16, Sub4, bilinear;
    "fixed spans:16, trilinear:run": |_| FixedPoint(Spans16), D16, Sub4, trilinear_per_run;
    "fixed spans:16, trilinear:triangle": |_| FixedPoint(Spans16), D16, Sub4, trilinear_per_triangle;
    "float exact, bilinear": |_| Exact, D16, Sub4, bilinear;
    "float exact, trilinear:pixel": |_| Exact, D16, Sub4, trilinear_per_pixel;
    "float exact, trilinear:run": |_| Exact, D16, Sub4, trilinear_per_run;
    "float exact, trilinear:triangle": |_| Exact, D16, Sub4, trilinear_per_triangle;
    "fixed spans:16, lambert": |_| FixedPoint(Spans16), D16, Sub4, colors, lambert;
    "fixed spans:16, integers": |_| FixedPoint(Spans16), D16, Sub4, nearest, integers;
    "fixed spans:16, integers vertex": |_| FixedPoint(Spans16), D16, Sub4, nearest, vertex;
    "fixed spans:16, integers lambert": |_| FixedPoint(Spans16), D16, Sub4, colors, baked;
    "float exact, lambert": |_| Exact, D16, Sub4, colors, lambert;
}

#[inline]
fn spans(length: i32) -> Lines {
    Lines::spans(length).unwrap_or(Lines::affine())
}

/// Lines that miss by at most so many texels.
#[inline]
fn bounded(texels: f32, scene: &Scene<'_>) -> Lines {
    let [width, height] = [scene.texture.width(), scene.texture.height()];
    Lines::bounded_texels(texels, u16::try_from(width.max(height)).unwrap_or(u16::MAX))
}

#[inline]
fn nearest<'a>(scene: &Scene<'a>) -> impl FragmentStage<Vec2, Color = u16> + use<'a> {
    Stored(scene.texture.sampler(Nearest, Repeat))
}

#[inline]
fn bilinear<'a>(scene: &Scene<'a>) -> impl FragmentStage<Vec2, Color = alberti::Rgba8> + use<'a> {
    Unlit(scene.texture.sampler(Bilinear, Repeat))
}

#[inline]
fn trilinear_per_pixel<'a>(scene: &Scene<'a>) -> impl FragmentStage<Vec2, Color = alberti::Rgba8> + use<'a> {
    Unlit(scene.levels.sampler(Trilinear, Repeat))
}

#[inline]
fn trilinear_per_run<'a>(scene: &Scene<'a>) -> impl FragmentStage<Vec2, Color = alberti::Rgba8> + use<'a> {
    Differentiated::by(PerRun, trilinear_per_pixel(scene))
}

#[inline]
fn trilinear_per_triangle<'a>(
    scene: &Scene<'a>,
) -> impl FragmentStage<Vec2, Color = alberti::Rgba8> + use<'a> {
    Differentiated::by(PerTriangle, trilinear_per_pixel(scene))
}

/// The nearest texel as a colour of 8 bits a channel.
#[inline]
fn colors<'a>(scene: &Scene<'a>) -> impl FragmentStage<Vec2, Color = alberti::Rgba8> + use<'a> {
    Unlit(scene.texture.sampler(Nearest, Repeat))
}

/// A stage in light from one direction.
#[inline]
fn sunlit<S>(stage: S) -> Sunlit<S> {
    Sunlit::new(stage, Vector3::new(Vec3::new(-0.45, 0.6, 1.0)), 0.3, 0.7)
}

#[inline]
fn mapped<'a>(scene: &Scene<'a>) -> impl Geometry<Varying = Vec2> + use<'a> {
    Mesh::new(scene.vertices, scene.triangles, |v: &Mapped| {
        (Point3::new(Vec3::from_array(v.position)), Vec2::from_array(v.uv))
    })
}

#[inline]
fn normals<'a>(scene: &Scene<'a>) -> impl Geometry<Varying = (Vec3, Vec2)> + use<'a> {
    Mesh::new(scene.vertices, scene.triangles, |v: &Mapped| {
        (Point3::new(Vec3::from_array(v.position)), (v.normal, Vec2::from_array(v.uv)))
    })
}

#[inline]
fn integers<'a>(scene: &Scene<'a>) -> impl Geometry<Varying = Vec2> + use<'a> {
    let (vertices, unit, shift) = scene.packed;
    IntegerMesh::new(vertices, scene.triangles, unit, move |v: &Packed| IntegerVertex::<Vec2> {
        place: v.place,
        components: v.uv.map(|c| Q16::from_bits(i32::from(c) << shift)),
    })
}

#[inline]
fn baked<'a>(scene: &Scene<'a>) -> impl Geometry<Varying = (Vec3, Vec2)> + use<'a> {
    let (vertices, unit, shift) = scene.packed;
    IntegerMesh::new(vertices, scene.triangles, unit, move |v: &Packed| {
        let uv = v.uv.map(|c| Q16::from_bits(i32::from(c) << shift));
        IntegerVertex::<(Vec3, Vec2)> { place: v.place, components: (Octahedral(v.normal).components(), uv) }
    })
}

/// The same with light at the vertices.
#[inline]
fn lit_vertices<'a>(scene: &Scene<'a>) -> impl Geometry<Varying = (Light, Vec2)> + use<'a> {
    let to_light = [-0.36, 0.48, 0.8].map(Q16::from_f32);
    Staged::new(baked(scene), move |IntegerVertex { place, components: (normal, uv) }| {
        let [x, y, z] = to_light;
        let cosine = normal[0] * x + normal[1] * y + normal[2] * z;
        let light = Q16::from_f32(0.3) + cosine.max(Q16::ZERO) * Q16::from_f32(0.7);
        IntegerVertex::<(Light, Vec2)> { place, components: (Light::of_integer(light), uv) }
    })
}

#[inline]
fn draw<D: Kept, G: Geometry<Varying: Slotted>>(
    memory: &mut Memory,
    scene: &Scene<'_>,
    mesh: &G,
    (interpolation, depth, subpixel): (impl Interpolation, D, Subpixel),
    stage: impl FragmentStage<G::Varying>,
) {
    let Memory { color, depths, slots } = memory;
    let target = alberti::Target::new(Rgb565Le, depth, WIDTH, HEIGHT, color, D::within(depths));
    if let Ok(mut target) = target {
        let slots = G::Varying::within(slots).get_mut(..scene.vertices.len()).unwrap_or_default();
        let pass = Pass::new(&scene.view, mesh, stage).interpolation(interpolation).subpixel(subpixel);
        pass.slots(slots).draw_by(One, &mut target);
    }
}

/// The most vertices and triangles of a scene, and texels along a side of its texture and in all levels of it.
pub const MOST: usize = 8192;
const SIDE: u32 = 256;
const TEXELS: usize = texel_count(SIDE, SIDE);

/// The memory of a frame.
#[derive(Debug)]
pub struct Memory {
    color: [u16; PIXELS],
    depths: Depths,
    slots: Slots,
}

/// Transformed vertices: not lit, with their light, and with normals.
#[derive(Debug)]
struct Slots {
    plain: [Slot<Vec2>; MOST],
    shaded: [Slot<(Light, Vec2)>; MOST],
    lit: [Slot<(Vec3, Vec2)>; MOST],
}

/// A varying that has slots in the memory.
trait Slotted: Varying + Sized {
    fn within(slots: &mut Slots) -> &mut [Slot<Self>];
}

impl Slotted for Vec2 {
    #[inline]
    fn within(slots: &mut Slots) -> &mut [Slot<Self>] {
        &mut slots.plain
    }
}

impl Slotted for (Light, Vec2) {
    #[inline]
    fn within(slots: &mut Slots) -> &mut [Slot<Self>] {
        &mut slots.shaded
    }
}

impl Slotted for (Vec3, Vec2) {
    #[inline]
    fn within(slots: &mut Slots) -> &mut [Slot<Self>] {
        &mut slots.lit
    }
}

/// Depths of every format.
#[derive(Debug)]
struct Depths {
    nothing: [(); PIXELS],
    half: [u16; PIXELS],
    word: [u32; PIXELS],
    float: [f32; PIXELS],
}

/// A depth format that has its place in the memory.
trait Kept: DepthFormat {
    fn within(depths: &mut Depths) -> &mut [Self::Stored];
}

macro_rules! kept {
    ($($format:ty: $field:ident;)*) => {$(
        impl Kept for $format {
            #[inline]
            fn within(depths: &mut Depths) -> &mut [Self::Stored] {
                &mut depths.$field
            }
        }
    )*};
}

kept! {
    NoDepth: nothing;
    D16: half;
    D24: word;
    D32: word;
    F32: float;
    F32Reversed: float;
}

impl Memory {
    /// As it is before the start.
    pub const EMPTY: Self = Self {
        color: [0; PIXELS],
        depths: Depths { nothing: [(); PIXELS], half: [0; PIXELS], word: [0; PIXELS], float: [0.0; PIXELS] },
        slots: Slots { plain: [Slot::EMPTY; MOST], shaded: [Slot::EMPTY; MOST], lit: [Slot::EMPTY; MOST] },
    };

    /// Makes all pixels dark grey and as far away as can be: where depths are reversed, the format's name says so.
    pub fn clear(&mut self, policy: &Policy) {
        let Self { color, depths, slots } = self;
        color.fill(0x2104_u16.to_le());
        depths.half.fill(D16.farthest());
        depths.word.fill(if policy.name.ends_with("u24") { D24.farthest() } else { D32.farthest() });
        let reversed = policy.name.ends_with("reversed");
        depths.float.fill(if reversed { F32Reversed.farthest() } else { F32.farthest() });
        slots.plain.fill(Slot::EMPTY);
        slots.shaded.fill(Slot::EMPTY);
        slots.lit.fill(Slot::EMPTY);
    }

    /// The 64-bit FNV-1a hash of the colour's bytes.
    #[must_use]
    pub fn hash(&self) -> u64 {
        let bytes = self.color.iter().flat_map(|pixel| pixel.to_ne_bytes());
        bytes
            .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }
}

/// Room for a scene that a program reads.
#[derive(Debug)]
pub struct Loaded {
    vertices: [Mapped; MOST],
    packed: [Packed; MOST],
    unit: f32,
    shift: u32,
    triangles: [[u16; 3]; MOST],
    texels: [u16; TEXELS],
}

impl Loaded {
    /// Nothing yet.
    pub const EMPTY: Self = Self {
        vertices: [Mapped { position: [0.0; 3], uv: [0.0; 2], normal: Vec3::Z }; MOST],
        packed: [Packed { place: [0; 3], uv: [0; 2], normal: [0; 2] }; MOST],
        unit: 1.0,
        shift: 0,
        triangles: [[0; 3]; MOST],
        texels: [0; TEXELS],
    };

    /// Reads a scene from words: the numbers of vertices, of triangles, and of texels along a side; the three axes and
    /// the origin of the world before the eye, the opening angle, the near and the far plane; vertices; indices; texels
    /// of all levels.
    ///
    /// `None` if words are missing, or if it is too large.
    pub fn read(&mut self, mut next: impl FnMut() -> Option<u32>) -> Option<Scene<'_>> {
        let [vertices, triangles] =
            [next()?, next()?].map(|count| usize::try_from(count).unwrap_or(usize::MAX));
        let side = next()?.min(SIDE);
        let mut floats = [0.0; 15];
        for float in &mut floats {
            *float = f32::from_bits(next()?);
        }
        let [x, y, z, origin, [angle, near, far]] =
            [0, 3, 6, 9, 12].map(|at| [floats[at], floats[at + 1], floats[at + 2]]);
        let axes = Mat3::from_cols(Vec3::from_array(x), Vec3::from_array(y), Vec3::from_array(z));
        let to_eye = Frame::from_mat3(axes, Point3::new(Vec3::from_array(origin)));
        let view = View::new(to_eye, Perspective::new(angle, crate::shapes::ASPECT, near, far).ok()?);
        let Self { vertices: all, triangles: faces, texels, .. } = self;
        for Mapped { position, uv, normal } in all.get_mut(..vertices)? {
            for float in position.iter_mut().chain(uv) {
                *float = f32::from_bits(next()?);
            }
            *normal = Vec3::from_array(*position).normalize_or(Vec3::Z);
        }
        for index in faces.get_mut(..triangles)?.iter_mut().flatten() {
            *index = u16::try_from(next()?).ok()?;
        }
        for texel in texels.get_mut(..texel_count(side, side))? {
            *texel = u16::try_from(next()?).ok()?;
        }
        self.pack(vertices)?;
        self.scene(view, vertices, triangles, side)
    }

    /// Rounds vertices to integers; texture coordinates are not negative.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "rounded, and in range"
    )]
    fn pack(&mut self, count: usize) -> Option<()> {
        let all = self.vertices.get(..count)?;
        let greatest = |of: fn(&Mapped) -> f32| all.iter().map(of).fold(0.0, f32::max);
        self.unit = greatest(|v| Vec3::from_array(v.position).abs().max_element()).max(1e-9) / 32767.0;
        let reach = greatest(|v| v.uv[0].max(v.uv[1]));
        self.shift = (0..12).find(|shift| reach * 65536.0 < (65535_u32 << shift) as f32).unwrap_or(12);
        let step = (1_u32 << self.shift) as f32 / 65536.0;
        for (packed, v) in self.packed.iter_mut().zip(all) {
            *packed = Packed {
                place: v.position.map(|c| (c / self.unit + if c < 0.0 { -0.5 } else { 0.5 }) as i16),
                uv: v.uv.map(|c| (c / step + 0.5) as u16),
                normal: Octahedral::nearest(v.normal).0,
            };
        }
        Some(())
    }

    /// The scene of what is there.
    #[must_use]
    pub fn scene(&self, view: View, vertices: usize, triangles: usize, side: u32) -> Option<Scene<'_>> {
        let levels = self.texels.get(..texel_count(side, side))?;
        let base = levels.get(..(side * side) as usize)?;
        Some(Scene {
            view,
            vertices: self.vertices.get(..vertices)?,
            packed: (self.packed.get(..vertices)?, self.unit, self.shift),
            triangles: self.triangles.get(..triangles)?,
            texture: Texture::new(Rgb565, base, side, side).ok()?.power_of_two()?,
            levels: Mipmap::new(Rgb565, levels, side, side).ok()?.power_of_two()?,
        })
    }
}
