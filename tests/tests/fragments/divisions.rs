//! Coloured triangles in floats, in fixed point and of integers, drawn whole, in bands and by threads: one stage and
//! one kind of pixels, whose kernels the tests of vertices, planes, limits and threads share.

use alberti::glam::Vec3;
use alberti::lanes::{Floating, Machine, One};
use alberti::{
    AnyDepth, AnyProjection, Cull, DepthFormat, Exact, FixedPoint, Frame, Geometry, IntegerMesh,
    IntegerVertex, Interpolation, Lines, Mesh, Object, Pass, PreparedTriangle, Q16, Rgba8, Rgba8888, Sides,
    Slot, Stats, Subpixel, Target, View, Viewport, World, for_lanes,
};
use alberti_tests::narrow::Narrow;
use rayon_core::{ThreadPool, ThreadPoolBuilder};
use std::num::NonZero;
use std::sync::LazyLock;

/// A place, and the three numbers that it carries.
pub(crate) type Vertex = (Vec3, Vec3);

/// A mesh in floats.
type Floats<'a> = Mesh<'a, Vertex, u16, fn(&Vertex) -> Vertex>;

/// A mesh of integers.
type Integers<'a> =
    IntegerMesh<'a, IntegerVertex<Vec3>, u16, fn(&IntegerVertex<Vec3>) -> IntegerVertex<Vec3>>;

/// The target of all of these tests.
pub(crate) type Canvas<'a> = Target<'a, Rgba8888, AnyDepth>;

/// A colour of a fragment's numbers.
pub(crate) type Stage = fn(Vec3) -> Option<Rgba8>;

/// A colour of every bit, never 0. No fragment has numbers that are not finite.
#[expect(clippy::unnecessary_wraps, reason = "a stage")]
pub(crate) fn every_bit(v: Vec3) -> Option<Rgba8> {
    assert!(v.is_finite(), "{v} in a fragment");
    let bits = v.to_array().map(f32::to_bits);
    Some(Rgba8::from_bits(bits[0] ^ bits[1].rotate_left(9) ^ bits[2].rotate_left(21) | 1))
}

/// The numbers in which a scene is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arithmetic {
    /// Floats, as many at a time as this machine takes, exact.
    Floats(Machine),
    /// Vertices in floats, pixels in fixed point.
    Fixed(Lines),
    /// Vertices in integers of this unit.
    Integers(Lines, f32),
}

/// Each of them, with straight lines in fixed point.
pub(crate) fn all_arithmetic(unit: f32) -> Vec<Arithmetic> {
    let fixed = [Arithmetic::Fixed(Lines::affine()), Arithmetic::Integers(Lines::affine(), unit)];
    Machine::all().map(Arithmetic::Floats).chain(fixed).collect()
}

/// More threads than most machines have cores.
pub(crate) static POOL: LazyLock<ThreadPool> =
    LazyLock::new(|| ThreadPoolBuilder::new().num_threads(12).build().expect("threads"));

/// The way in which a frame is divided.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Way {
    Whole,
    /// Prepared once, and drawn in parts of so many rows.
    Bands(usize),
    Threads(NonZero<usize>),
}

/// The division of the work, and the memory for it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Division {
    pub(crate) way: Way,
    pub(crate) slots: usize,
    pub(crate) room: usize,
}

impl Division {
    /// None, and no memory.
    pub(crate) const WHOLE: Self = Self { way: Way::Whole, slots: 0, room: 0 };

    /// By threads, with room for everything.
    pub(crate) fn threads(count: usize) -> Self {
        Self { way: Way::Threads(NonZero::new(count).expect("some")), slots: 1 << 16, room: 1 << 16 }
    }

    /// In bands, with room for everything.
    pub(crate) fn bands(rows: usize) -> Self {
        Self { way: Way::Bands(rows), slots: 1 << 16, room: 1 << 16 }
    }
}

/// A mesh in a view.
#[derive(Clone)]
pub(crate) struct Scene {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) triangles: Vec<[u16; 3]>,
    pub(crate) frame: Frame<Object, World>,
    pub(crate) view: View<AnyProjection>,
    pub(crate) viewport: Option<Viewport>,
    pub(crate) sides: Sides,
    pub(crate) subpixel: Subpixel,
    pub(crate) stage: Stage,
}

impl Scene {
    /// The scene in a view, with everything else as it is without a choice.
    pub(crate) fn new(
        vertices: Vec<Vertex>,
        triangles: Vec<[u16; 3]>,
        view: impl Into<View<AnyProjection>>,
    ) -> Self {
        Self {
            vertices,
            triangles,
            frame: Frame::IDENTITY,
            view: view.into(),
            viewport: None,
            sides: Sides::GuardBand,
            subpixel: Subpixel::Sub8,
            stage: every_bit,
        }
    }

    /// Draws it, back faces too.
    pub(crate) fn draw(&self, arithmetic: Arithmetic, division: Division, target: &mut Canvas<'_>) -> Stats {
        let floats: Floats<'_> = Mesh::new(&self.vertices, &self.triangles, |v| *v);
        match arithmetic {
            Arithmetic::Floats(machine) => {
                for_lanes!(machine, lanes => self.divided(lanes, Exact, &floats, division, target))
            }
            Arithmetic::Fixed(lines) => self.divided(One, FixedPoint(lines), &floats, division, target),
            Arithmetic::Integers(lines, unit) => {
                let vertices = self.integers(unit);
                let mesh: Integers<'_> = IntegerMesh::new(&vertices, &self.triangles, unit, |v| *v);
                self.divided(One, FixedPoint(lines), &mesh, division, target)
            }
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
    fn integers(&self, unit: f32) -> Vec<IntegerVertex<Vec3>> {
        let vertex = |(place, components): &Vertex| IntegerVertex {
            place: place.to_array().map(|c| (c / unit).round() as i16),
            components: components.to_array().map(Q16::from_f32),
        };
        self.vertices.iter().map(vertex).collect()
    }

    fn divided<M: Geometry<Varying = Vec3> + Sync>(
        &self,
        lanes: impl Floating,
        interpolation: impl Interpolation,
        mesh: &M,
        Division { way, slots, room }: Division,
        target: &mut Canvas<'_>,
    ) -> Stats {
        let mut stats = Stats::default();
        let mut slots = vec![Slot::EMPTY; slots.min(self.vertices.len())];
        let mut room = vec![PreparedTriangle::EMPTY; room.min(self.triangles.len())];
        let pass =
            Pass::new(&self.view, mesh, Narrow(self.stage)).at(self.frame).interpolation(interpolation);
        let pass = pass.cull(Cull::None).sides(self.sides).subpixel(self.subpixel).slots(&mut slots);
        let mut pass = if let Some(viewport) = self.viewport { pass.viewport(viewport) } else { pass };
        match way {
            Way::Whole => pass.count_by(lanes, target, &mut stats),
            Way::Bands(rows) => {
                let (size, format) = (target.size(), target.depth_format());
                let (mut prepared, _) = pass.count_prepare(size, format, &mut room, &mut stats);
                for mut band in target.split(rows) {
                    prepared.count_by(lanes, &mut band, &mut stats);
                }
            }
            Way::Threads(count) => POOL.install(|| {
                pass.count_by_threads(lanes, count, &mut room, target, &mut stats);
            }),
        }
        stats
    }
}

/// The memory of a frame, whose rows of colours may be longer than it is wide.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Memory {
    size: [u32; 2],
    stride: usize,
    pub(crate) color: Vec<u32>,
    pub(crate) depth: Vec<u32>,
}

impl Memory {
    /// The farthest depth everywhere, and pixels without a colour.
    pub(crate) fn new([width, height]: [u32; 2], stride: usize, format: AnyDepth) -> Self {
        let (color, depth) = (vec![0; stride * height as usize], (width * height) as usize);
        Self { size: [width, height], stride, color, depth: vec![format.farthest(); depth] }
    }

    pub(crate) fn target(&mut self, format: AnyDepth) -> Canvas<'_> {
        Target::window(
            Rgba8888,
            format,
            self.size,
            0..self.size[1],
            self.stride,
            &mut self.color,
            &mut self.depth,
        )
        .expect("a window")
    }

    /// The number of pixels that were drawn.
    pub(crate) fn drawn(&self) -> u64 {
        self.color.iter().map(|&pixel| u64::from(pixel != 0)).sum()
    }
}

/// A frame of its own.
pub(crate) fn picture(
    scene: &Scene,
    arithmetic: Arithmetic,
    division: Division,
    (size, format): ([u32; 2], AnyDepth),
) -> (Memory, Stats) {
    let mut memory = Memory::new(size, size[0] as usize, format);
    let stats = scene.draw(arithmetic, division, &mut memory.target(format));
    (memory, stats)
}
