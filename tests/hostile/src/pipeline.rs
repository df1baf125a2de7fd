//! The whole pipeline with any numbers: nothing outside the viewport, nothing that is not a number, and the same pixels
//! however the work is divided.

use crate::bits::Bits;
use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::lanes::{Floating, Machine, One};
use alberti::raster::color::{AnyBlend, Bayer, Blended, Dithered};
use alberti::{
    AnyDepth, AnyProjection, ColorFormat, Cull, DepthFormat, Exact, FixedPoint, Frame, Interpolation, Lines,
    Mesh, Object, Parallel, Pass, Perspective, Planes, Point3, PreparedTriangle, Rgb565Le, Rgba8, Rgba8888,
    Sides, Slot, Subpixel, Target, View, Viewport, World, for_lanes,
};
use alberti_tests::narrow::Narrow;

type Carried = (Vec3, Vec2);
type Vertex = (Vec3, Carried);

/// A mesh in a view, and a frame.
#[derive(Debug)]
struct Case {
    vertices: Vec<Vertex>,
    triangles: Vec<[u16; 3]>,
    frame: Frame<Object, World>,
    view: View<AnyProjection>,
    size: [u32; 2],
    viewport: Viewport,
    sides: Sides,
    cull: Cull,
    subpixel: Subpixel,
    depth: AnyDepth,
    rows: usize,
    slots: usize,
    room: usize,
}

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    let way = bits.below(6);
    let blend = match bits.below(5) {
        0 => AnyBlend::Replace,
        1 => AnyBlend::Constant(bits.byte()),
        2 => AnyBlend::Over,
        3 => AnyBlend::Additive,
        _ => AnyBlend::Multiply,
    };
    let lines = match bits.below(3) {
        0 => Lines::affine(),
        1 => Lines::bounded(bits.float()),
        _ => Lines::bounded(0.25),
    };
    let Some(case) = case(&mut bits) else { return };
    match way {
        0 => case.check(Rgba8888, Exact, 0xdead_beef_u32, u32::MAX),
        1 => case.check(Rgba8888, Planes, 0xdead_beef, u32::MAX),
        2 => case.check(Rgba8888, lines, 0xdead_beef, u32::MAX),
        3 => case.check(Rgba8888, FixedPoint(lines), 0xdead_beef, u32::MAX),
        4 => case.check(Blended { format: Rgba8888, by: blend }, Exact, 0xdead_beef, u32::MAX),
        _ => case.check(Dithered { format: Rgb565Le, by: Bayer }, FixedPoint(lines), 0xbeef_u16, u16::MAX),
    }
}

fn any_frame<A: alberti::math::Space, B: alberti::math::Space>(bits: &mut Bits<'_>) -> Frame<A, B> {
    let [x, y, z, origin] = [(); 4].map(|()| Vec3::from_array(bits.floats()));
    Frame::from_mat3(Mat3::from_cols(x, y, z), Point3::new(origin))
}

fn case(bits: &mut Bits<'_>) -> Option<Case> {
    let size = [1 + bits.below(48) as u32, 1 + bits.below(40) as u32];
    let aspect = size[0] as f32 / size[1] as f32;
    let planes = match bits.byte() & 3 {
        0 => bits.floats(),
        1 => [1e-3, 1e6],
        _ => [0.1, 100.0],
    };
    let projection: AnyProjection = if bits.byte() < 200 {
        let angle = if bits.bit() { 1.0 } else { bits.float() };
        Perspective::new(angle, aspect, planes[0], planes[1]).ok()?.into()
    } else {
        let height = if bits.bit() { 4.0 } else { bits.float() };
        Parallel::new(height, aspect, planes[0], planes[1]).ok()?.into()
    };
    let to_eye =
        if bits.byte() < 160 { Frame::at(Point3::new(Vec3::new(0.0, 0.0, 3.0))) } else { any_frame(bits) };
    let frame = if bits.byte() < 160 { Frame::IDENTITY } else { any_frame(bits) };
    let viewport = if bits.byte() < 128 {
        Viewport::new(0, 0, size[0], size[1])
    } else {
        let [x, y] = [(); 2].map(|()| bits.between(-60, 60) as i32);
        Viewport::new(x, y, 1 + bits.below(90) as u32, 1 + bits.below(90) as u32)
    };
    let depth = bits.pick(&[
        AnyDepth::F32,
        AnyDepth::F32Reversed,
        AnyDepth::D32,
        AnyDepth::D24,
        AnyDepth::D16,
        AnyDepth::NoDepth,
    ]);
    let (rows, slots, room) = (1 + bits.below(12), bits.below(12), bits.below(24));
    let (sides, subpixel) =
        (bits.pick(&[Sides::GuardBand, Sides::Cube]), bits.pick(&[Subpixel::Sub4, Subpixel::Sub8]));
    let cull = bits.pick(&[Cull::None, Cull::Back, Cull::Front]);
    let triangles = (0..1 + bits.below(16)).map(|_| [(); 3].map(|()| bits.below(12) as u16)).collect();
    let vertices = (0..10).map(|_| {
        let place = Vec3::from_array(bits.floats());
        (place, (Vec3::from_array(bits.floats()), Vec2::from_array(bits.floats())))
    });
    let vertices = vertices.collect();
    let view = View::new(to_eye, projection);
    let viewport = viewport.ok()?;
    Some(Case {
        vertices,
        triangles,
        frame,
        view,
        size,
        viewport,
        sides,
        cull,
        subpixel,
        depth,
        rows,
        slots,
        room,
    })
}

/// A colour of every bit of what comes. None of it is anything but a finite number.
fn shade((normal, uv): Carried) -> Option<Rgba8> {
    assert!(normal.is_finite() && uv.is_finite(), "{normal} {uv} in a fragment");
    let [a, b, c] = normal.to_array().map(f32::to_bits);
    let word = a ^ b.rotate_left(9) ^ c.rotate_left(21) ^ uv.x.to_bits().rotate_left(5) ^ uv.y.to_bits();
    (word & 15 != 3).then(|| Rgba8::from_bits(word))
}

/// The memory of a frame, with pixels before and behind it.
struct Memory<P> {
    color: Vec<P>,
    depth: Vec<u32>,
}

/// Pixels around the frame.
const AROUND: usize = 70;

impl Case {
    fn check<C: ColorFormat>(
        &self,
        format: C,
        interpolation: impl Interpolation,
        before: C::Pixel,
        around: C::Pixel,
    ) where
        C::Pixel: PartialEq,
    {
        let one = self.drawn(One, format, interpolation, [before, around], false);
        self.look(&one, [before, around]);
        let machine = Machine::all().next().expect("every machine has lanes");
        for bands in [false, true] {
            let several = for_lanes!(machine, lanes => self.drawn(lanes, format, interpolation, [before, around], bands));
            assert!(several.color == one.color, "lanes or bands ({bands}) draw other pixels: {self:?}");
            assert!(several.depth == one.depth, "lanes or bands ({bands}) have other depths: {self:?}");
        }
    }

    fn drawn<L: Floating, C: ColorFormat>(
        &self,
        lanes: L,
        format: C,
        interpolation: impl Interpolation,
        [before, around]: [C::Pixel; 2],
        bands: bool,
    ) -> Memory<C::Pixel> {
        let count = (self.size[0] * self.size[1]) as usize;
        let mut memory =
            Memory { color: vec![around; count + 2 * AROUND], depth: vec![0; count + 2 * AROUND] };
        let (color, depth) = (&mut memory.color[AROUND..][..count], &mut memory.depth[AROUND..][..count]);
        color.fill(before);
        depth.fill(self.depth.farthest());
        let mut target =
            Target::new(format, self.depth, self.size[0], self.size[1], color, depth).expect("a frame");
        let mesh = Mesh::new(&self.vertices, &self.triangles, |v: &Vertex| *v);
        let mut slots = vec![Slot::EMPTY; self.slots];
        let mut room = vec![PreparedTriangle::EMPTY; self.room];
        let mut pass = Pass::new(&self.view, &mesh, Narrow(shade))
            .at(self.frame)
            .viewport(self.viewport)
            .sides(self.sides)
            .cull(self.cull)
            .subpixel(self.subpixel)
            .interpolation(interpolation)
            .slots(&mut slots);
        if bands {
            let (mut prepared, _) = pass.count_prepare(self.size, self.depth, &mut room, &mut ());
            for mut band in target.split(self.rows) {
                prepared.draw_by(lanes, &mut band);
            }
        } else {
            pass.draw_by(lanes, &mut target);
        }
        memory
    }

    /// Nothing outside the viewport or the frame is written, and depths are numbers of their format.
    fn look<P: Copy + PartialEq>(&self, memory: &Memory<P>, [before, around]: [P; 2]) {
        let [width, height] = self.size;
        let count = (width * height) as usize;
        let outside = |of: &[P]| of.iter().all(|pixel| *pixel == around);
        assert!(outside(&memory.color[..AROUND]) && outside(&memory.color[AROUND + count..]));
        let outside = |of: &[u32]| of.iter().all(|depth| *depth == 0);
        assert!(outside(&memory.depth[..AROUND]) && outside(&memory.depth[AROUND + count..]));
        let [columns, rows] = self.viewport.pixels();
        let pixels = memory.color[AROUND..].iter().zip(&memory.depth[AROUND..]).take(count);
        for (k, (&pixel, &depth)) in (0i32..).zip(pixels) {
            let at = [k % width as i32, k / width as i32];
            let inside = columns.contains(&at[0]) && rows.contains(&at[1]);
            assert!(
                inside || (pixel == before && depth == self.depth.farthest()),
                "a pixel at {at:?}: {self:?}"
            );
            let unit = |word: u32| (0.0..=1.0).contains(&f32::from_bits(word));
            let sound = match self.depth {
                AnyDepth::F32 => unit(depth),
                AnyDepth::F32Reversed => unit(!depth),
                AnyDepth::D24 => depth <= AnyDepth::D24.farthest(),
                AnyDepth::D16 => depth <= AnyDepth::D16.farthest(),
                _ => true,
            };
            assert!(sound, "a depth of {depth:#x} at {at:?}: {self:?}");
        }
    }
}
