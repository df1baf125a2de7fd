//! A renderer for a chip with little memory: the frame in bands, of which one is drawn while another is sent.

use crate::draws::{mapped_integers, meshlets};
use crate::shapes::{Model, TEXTURE};
use crate::{Camera, HEIGHT, Target, WIDTH};
use alberti::glam::Vec2;
use alberti::lanes::One;
use alberti::shaders::Stored;
use alberti::texture::{Nearest, Repeat};
use alberti::{Counters, D16, FixedPoint, Memory, Pass, PingPong, Rgb565Le, Spans16, Sub4, Turn, View};

/// Rows of a band.
const ROWS: u32 = 8;
/// Pixels of a band.
const BAND: usize = (WIDTH * ROWS) as usize;

/// All memory of it but the stack: 8 rows in RGB565 twice and their depths in 16 bits, 512 vertices with texture
/// coordinates, 2,800 triangles.
pub type Renderer = Memory<Rgb565Le, D16, Vec2, BAND, 512, 2800>;

// Of 48 KB, the rest is for the stack.
const _: () = Renderer::must_fit(43 * 1024);

/// Memory as it is before the start.
pub const EMPTY: Renderer = Renderer::new(0, 0);

/// Draws a frame of a mesh of integers with meshlets, the nearest texel in perspective, in fixed point. Each band's
/// colours are sent when it is drawn.
pub fn frame<K: Counters>(
    memory: &mut Renderer,
    camera: &Camera,
    model: &Model,
    counters: &mut K,
    mut send: impl FnMut(&[u16]),
) {
    let Memory { colors, depths, slots, list } = memory;
    let view = View::new(model.to_eye, camera.perspective);
    #[expect(
        clippy::redundant_closure,
        reason = "a type of its own, or code that scenes share is inlined in neither"
    )]
    let mesh = meshlets(model, |v| mapped_integers(v));
    let stage = Stored(TEXTURE.sampler(Nearest, Repeat));
    let mut pass =
        Pass::new(&view, &mesh, stage).interpolation(FixedPoint(Spans16)).subpixel(Sub4).slots(slots);
    let (mut prepared, _) = pass.count_prepare([WIDTH, HEIGHT], D16, list, counters);
    let colors = colors.each_mut().map(|colors| &mut colors[..]);
    let Ok(mut bands) = PingPong::new(Rgb565Le, D16, [WIDTH, HEIGHT], colors, depths) else { return };
    while let Some(Turn { band, ready }) = bands.turn() {
        if let Some(ready) = ready {
            send(ready.pixels);
        }
        if let Some(mut band) = band {
            band.clear(Target::BACKGROUND);
            prepared.count_by(One, &mut band, counters);
        }
    }
}

/// [`frame`] on the memory of a target, whose colours get what is sent.
pub fn meshlets_renderer<K: Counters>(target: &mut Target, camera: &Camera, model: &Model, counters: &mut K) {
    let Target { color, renderer, .. } = target;
    let mut rest = &mut color[..];
    frame(renderer, camera, model, counters, |band| {
        if let Some((place, below)) = core::mem::take(&mut rest).split_at_mut_checked(band.len()) {
            place.copy_from_slice(band);
            rest = below;
        }
    });
}
