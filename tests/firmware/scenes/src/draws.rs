//! The ways of drawing that are measured: each is one call of [`alberti::draw`] on prepared memory.

use crate::shapes::{Model, Vertex};
use crate::{Camera, PIXELS, Target, WIDTH};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Flat, Unlit, VertexColor};
use alberti::texture::{Nearest, Repeat};
use alberti::{
    Band, Counters, Cull, D16, Exact, FragmentStage, NoDepth, Object, Pass, Point3, Rgb565Le, Rgba8, Sides,
    Slot, Sub4, VertexStage, View, draw,
};

/// One colour for all, with depth.
pub fn flat<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let pass = pass(camera, model, |v: &Vertex| (place(v), ()), Flat(ORANGE));
    let Ok(mut band) = Band::<Rgb565Le, D16>::new(WIDTH, 0, &mut target.color, &mut target.depth) else {
        return;
    };
    draw(&pass, &mut band, &mut [Slot::<Sub4, _>::EMPTY; 0], counters);
}

/// One colour for all, without depth: later triangles cover earlier ones.
pub fn flat_without_depth<K: Counters>(
    target: &mut Target,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
) {
    let pass = pass(camera, model, |v: &Vertex| (place(v), ()), Flat(ORANGE));
    let mut nothing = [(); PIXELS];
    let Ok(mut band) = Band::<Rgb565Le, NoDepth>::new(WIDTH, 0, &mut target.color, &mut nothing) else {
        return;
    };
    draw(&pass, &mut band, &mut [Slot::<Sub4, _>::EMPTY; 0], counters);
}

/// The vertices' colours, in perspective, with depth.
pub fn gouraud<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let pass = pass(camera, model, |v: &Vertex| (place(v), Vec3::from_array(v.color)), VertexColor);
    let Ok(mut band) = Band::<Rgb565Le, D16>::new(WIDTH, 0, &mut target.color, &mut target.depth) else {
        return;
    };
    draw(&pass, &mut band, &mut [Slot::<Sub4, _>::EMPTY; 0], counters);
}

/// The nearest texel, in perspective, with depth. Each vertex has a slot of its own.
pub fn textured<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let vertex_stage = |v: &Vertex| (place(v), Vec2::from_array(v.uv));
    let pass = pass(camera, model, vertex_stage, Unlit(model.texture.sampler::<Nearest, Repeat>()));
    let Ok(mut band) = Band::<Rgb565Le, D16>::new(WIDTH, 0, &mut target.color, &mut target.depth) else {
        return;
    };
    let slots = target.slots.get_mut(..model.vertices.len()).unwrap_or_default();
    draw(&pass, &mut band, slots, counters);
}

const ORANGE: Rgba8 = Rgba8::new(230, 130, 40, 255);

/// What all ways have in common.
#[inline]
fn pass<Vs: VertexStage<Vertex>, Fs: FragmentStage<Vs::Varying>>(
    camera: &Camera,
    model: &Model,
    vertex_stage: Vs,
    fragment_stage: Fs,
) -> Pass<'static, Vertex, u16, Vs, Fs> {
    Pass {
        view: View { to_eye: model.to_eye, perspective: camera.perspective, viewport: camera.viewport },
        vertices: model.vertices,
        triangles: model.triangles,
        vertex_stage,
        fragment_stage,
        cull: Cull::Back,
        sides: Sides::GuardBand,
        interpolation: Exact,
    }
}

fn place(vertex: &Vertex) -> Point3<Object> {
    Point3::new(Vec3::from_array(vertex.position))
}
