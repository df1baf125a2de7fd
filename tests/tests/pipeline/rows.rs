//! A stage for each row: all ways of drawing ask for it before the row's fragments.
#![allow(clippy::cast_possible_truncation, reason = "vertices are few")]

use alberti::glam::Vec3;
use alberti::lanes::{Lanes, Machine, One};
use alberti::raster::Fragments;
use alberti::{
    Camera, Cull, Exact, F32, FixedPoint, FragmentStage, Interpolation, Mesh, NoDerivatives, Pass, Rgba8,
    Rgba8888, Spans16, Sub4, Target, for_lanes,
};
use alberti_oracle::rng::{Rng, run_seed};

const SIZE: usize = 64;

/// White where it was asked for the fragment's row, black elsewhere.
#[derive(Clone, Copy)]
struct OfRow(i32);

impl FragmentStage<()> for OfRow {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;
    const BY_ROWS: bool = true;

    fn in_row(&self, row: i32) -> Self {
        Self(row)
    }

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, ()>) -> (L::U32, L::Mask) {
        let Fragments { lanes, mask, place: [_, row], .. } = *fragments;
        let color = if row == self.0 { Rgba8::WHITE } else { Rgba8::BLACK };
        (lanes.word(color.to_bits()), mask)
    }
}

fn check(corners: [Vec3; 3], interpolation: impl Interpolation) {
    let indices = [[0_u16, 1, 2]];
    let mesh = Mesh::new(&corners, &indices, |v: &Vec3| (*v, ()));
    let camera = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y).expect("a camera");
    let view = camera.perspective(1.2, 0.25..30.0).expect("a view");
    let pass = Pass::new(&view, &mesh, OfRow(-1)).interpolation(interpolation).subpixel(Sub4);
    let mut pass = pass.cull(Cull::None);
    for way in 0..4 {
        let (mut color, mut depth) = ([7; SIZE * SIZE], [1.0; SIZE * SIZE]);
        let side = SIZE as u32;
        let mut target = Target::new(Rgba8888, F32, side, side, &mut color, &mut depth).expect("a frame");
        match way {
            0 => pass.draw_by(One, &mut target),
            1 => {
                let widest = Machine::all().next().expect("a machine");
                for_lanes!(widest, lanes => pass.draw_by(lanes, &mut target));
            }
            2 => pass.draw_lines(&mut target, [[0, 1], [1, 2]]),
            _ => pass.draw_points(&mut target, 0..3, 5),
        }
        let drawn: Vec<u32> = color.into_iter().filter(|word| *word != 7).collect();
        assert!(drawn.iter().all(|word| *word == u32::MAX), "way {way} of {corners:?}");
    }
}

#[test]
fn a_stage_is_that_of_its_row() {
    let mut rng = Rng::stream(run_seed(), 3);
    for k in 0..300 {
        let far = [0.3, 2.0, 9.0][k % 3];
        let corners = [(); 3].map(|()| {
            let [x, y] = [(); 2].map(|()| rng.uniform(-far, far) as f32);
            Vec3::new(x, y, -3.0)
        });
        check(corners, Exact);
        check(corners, FixedPoint(Spans16));
    }
}
