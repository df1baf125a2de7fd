//! A frame of a scene by the library's own types: what is measured is what a program that names them gets.

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::One;
use alberti::{
    ColorFormat, DepthFormat, Flat, FragmentStage, Interpolation, Mesh, Pass, Rgba8, Rgba8888, Slot,
    Subpixel, Target, Varying, View,
};
use alberti_app::scene::Vertex;
use alberti_tests::for_widest;
use alberti_trade::row::{Frame, Places, pixels};
use alberti_trade::scenes::Scene;
use std::cell::RefCell;

/// The policies of a frame that every scene has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct With<P, D> {
    /// From vertices to pixels.
    pub(crate) interpolation: P,
    /// The depth buffer.
    pub(crate) depth: D,
    /// The grid of vertices.
    pub(crate) subpixel: Subpixel,
    /// Columns and rows.
    pub(crate) size: [u32; 2],
}

/// A frame by the widest lanes that there are.
pub(crate) fn wide<V, S, P, D>(
    scene: &'static Scene,
    vertex_stage: impl Fn(&Vertex) -> (Vec3, V) + 'static,
    stage: S,
    with: With<P, D>,
) -> Frame
where
    V: Varying + 'static,
    S: FragmentStage<V, Color = Rgba8> + 'static,
    P: Interpolation,
    D: DepthFormat + 'static,
{
    colored(scene, vertex_stage, stage, Rgba8888, with)
}

/// The same whose colours are stored in another way.
pub(crate) fn colored<V, S, C, P, D>(
    scene: &'static Scene,
    vertex_stage: impl Fn(&Vertex) -> (Vec3, V) + 'static,
    stage: S,
    format: C,
    with: With<P, D>,
) -> Frame
where
    V: Varying + 'static,
    S: FragmentStage<V, Color = Rgba8> + 'static,
    C: ColorFormat<Pixel = u32>,
    P: Interpolation,
    D: DepthFormat + 'static,
{
    let mut memory = Memory::new(scene, with.depth, with.size);
    Box::new(move |words| {
        let Memory { view, slots, depth } = &mut memory;
        let mesh = Mesh::new(&scene.model.vertices, scene.triangles(), &vertex_stage);
        let mut target = target((words, depth), with.depth, with.size, scene);
        let pass = Pass::new(view, &mesh, stage).interpolation(with.interpolation).subpixel(with.subpixel);
        let mut pass = pass.slots(slots);
        let mut target = target.with_color(format);
        for_widest!(lanes => pass.draw_by(lanes, &mut target));
    })
}

/// A frame by one lane, as [`FixedPoint`](alberti::FixedPoint) has it on every machine.
pub(crate) fn narrow<V, S, P, D>(
    scene: &'static Scene,
    vertex_stage: impl Fn(&Vertex) -> (Vec3, V) + 'static,
    stage: S,
    with: With<P, D>,
) -> Frame
where
    V: Varying + 'static,
    S: FragmentStage<V, Color = Rgba8> + 'static,
    P: Interpolation,
    D: DepthFormat + 'static,
{
    let mut memory = Memory::new(scene, with.depth, with.size);
    Box::new(move |words| {
        let Memory { view, slots, depth } = &mut memory;
        let mesh = Mesh::new(&scene.model.vertices, scene.triangles(), &vertex_stage);
        let mut target = target((words, depth), with.depth, with.size, scene);
        let pass = Pass::new(view, &mesh, stage).interpolation(with.interpolation).subpixel(with.subpixel);
        pass.slots(slots).draw_by(One, &mut target);
    })
}

/// What a frame needs beside its pixels.
struct Memory<V: Varying, D: DepthFormat> {
    view: View,
    slots: Vec<Slot<V>>,
    depth: Vec<D::Stored>,
}

impl<V: Varying, D: DepthFormat> Memory<V, D> {
    fn new(scene: &Scene, depth: D, size: [u32; 2]) -> Self {
        let slots = vec![Slot::EMPTY; scene.model.vertices.len()];
        Self { view: scene.view(), slots, depth: vec![depth.farthest(); pixels(size)] }
    }
}

fn target<'a, D: DepthFormat>(
    (words, depth): (&'a mut [u32], &'a mut [D::Stored]),
    format: D,
    [width, height]: [u32; 2],
    scene: &Scene,
) -> Target<'a, Rgba8888, D> {
    let mut target = Target::new(Rgba8888, format, width, height, words, depth).expect("buffers that fit");
    target.clear(scene.background());
    target
}

/// The texture coordinates that are seen at each pixel, bit for bit those of [`wide`].
///
/// # Panics
/// For a scene of more triangles than its numbers can tell apart: 2^20.
pub(crate) fn places<P: Interpolation, D: DepthFormat>(scene: &Scene, with: With<P, D>) -> Places {
    /// Numbers stay small enough for fixed point.
    const BASE: u32 = 1024;
    // Each triangle has vertices of its own, which carry its number.
    let vertices: Vec<(Vertex, [f32; 2])> = (0..)
        .zip(scene.triangles())
        .flat_map(|(number, triangle)| {
            let digits = [number % BASE, number / BASE].map(|digit: u32| {
                f32::from(u16::try_from(digit).ok().filter(|&digit| digit < 1024).expect("few triangles"))
            });
            triangle.map(|index| (scene.model.vertices[index as usize], digits))
        })
        .collect();
    let triangles: Vec<[u32; 3]> =
        (0..).step_by(3).map(|k| [k, k + 1, k + 2]).take(vertices.len() / 3).collect();
    let mesh = Mesh::new(&vertices, &triangles, |(v, number)| {
        (position(v), (uv(v), Flat(Vec2::from_array(*number))))
    });
    let seen = RefCell::new(vec![]);
    let stage = |(uv, Flat(number)): (Vec2, Flat<Vec2>)| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "digits from 0 to 1023")]
        let number = number.x as u32 + BASE * number.y as u32;
        let mut seen = seen.borrow_mut();
        seen.push((number, uv.to_array()));
        u32::try_from(seen.len()).ok()
    };
    let mut words = vec![0; pixels(with.size)];
    let mut depth = vec![with.depth.farthest(); words.len()];
    let ([width, height], view) = (with.size, scene.view());
    let mut target =
        Target::new(Rgba8888, with.depth, width, height, &mut words, &mut depth).expect("buffers that fit");
    let pass = Pass::new(&view, &mesh, &stage).interpolation(with.interpolation).subpixel(with.subpixel);
    { pass }.draw_by(One, &mut target);
    let seen = seen.into_inner();
    words.iter().map(|&word| (word != 0).then(|| seen[u32::from_le(word) as usize - 1])).collect()
}

/// The place of a vertex.
pub(crate) fn position(v: &Vertex) -> Vec3 {
    Vec3::from_array(v.position)
}

/// Its texture coordinates.
pub(crate) fn uv(v: &Vertex) -> Vec2 {
    Vec2::from_array(v.uv)
}

/// Both, for a vertex stage.
pub(crate) fn mapped(v: &Vertex) -> (Vec3, Vec2) {
    (position(v), uv(v))
}
