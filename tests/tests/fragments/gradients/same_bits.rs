//! The same derivatives, to the bit, whatever draws them: lanes, pieces of the frame, any order of the vertices, and a
//! policy that is chosen at run time.

use super::spans;
use alberti_math::Sub8;
use alberti_math::lanes::{Floating, One};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{
    AnyDerivatives, Cull, Differentiation, Exact, FixedPoint, Interpolation, Lines, NoDepth, Paint, PerPixel,
    PerRun, PerTriangle, Planes, Rgba8888, Target, Vertex,
};
use alberti_tests::derivatives::{Carried, Listener, carried};
use alberti_tests::for_widest;
use alberti_tests::probe::vertex;

const WIDTH: usize = 101;
const HEIGHT: usize = 70;
const SIZE: [u32; 2] = [WIDTH as u32, HEIGHT as u32];

/// Triangles over each other, often thin, from a pixel to forty frames large. `turn` says from which vertex and in
/// which direction they are given.
fn draw_random(
    differentiation: impl Differentiation,
    interpolation: impl Interpolation,
    lanes: impl Floating,
    target: &mut Target<'_, Rgba8888, NoDepth>,
    seed: u64,
    turn: usize,
) {
    let paint =
        Paint { stage: Listener::by(differentiation), interpolation, subpixel: Sub8, cull: Cull::None };
    let mut rng = Rng::new(seed);
    for _ in 0..300 {
        let center = [rng.uniform(-20.0, 120.0), rng.uniform(-20.0, 90.0)];
        let size = f64::from(rng.log_uniform(0.5, 4000.0));
        let size = if rng.one_in(8) { [f64::from(rng.log_uniform(0.3, 20.0)), 30_000.0] } else { [size; 2] };
        let mut corners: [Vertex<Carried>; 3] = std::array::from_fn(|_| {
            let p = [0, 1].map(|k| ((center[k] + rng.uniform(-size[k], size[k])) * 256.0) as i64);
            let values = [(); 4].map(|()| rng.uniform(-1.0, 1.0) as f32);
            vertex(p, 0.5, rng.log_uniform(1e-3, 1e3), carried(values))
        });
        corners.rotate_left(turn % 3);
        if turn >= 3 {
            corners.swap(0, 1);
        }
        let [a, b, c] = &corners;
        paint.triangle(lanes, target, [a, b, c], &mut ());
    }
}

fn frame(
    differentiation: impl Differentiation,
    policy: impl Interpolation,
    lanes: impl Floating,
    seed: u64,
    turn: usize,
) -> Vec<u32> {
    let (mut color, depth) = (vec![0; WIDTH * HEIGHT], &mut [(); WIDTH * HEIGHT]);
    let [width, height] = SIZE;
    let mut target = Target::new(Rgba8888, NoDepth, width, height, &mut color, depth).expect("a frame");
    draw_random(differentiation, policy, lanes, &mut target, seed, turn);
    color
}

fn same_bits(differentiation: impl Differentiation, policy: impl Interpolation, stream: u64) {
    for part in 0..4 {
        let seed = run_seed() ^ part ^ stream << 32;
        let whole = frame(differentiation, policy, One, seed, 0);
        assert!(whole.iter().filter(|&&p| p != 0).count() > 3000, "next to nothing was drawn");
        for turn in 1..6 {
            assert!(whole == frame(differentiation, policy, One, seed, turn), "{policy:?}, turned {turn}");
        }
        let several = for_widest!(lanes => frame(differentiation, policy, lanes, seed, part as usize));
        assert!(whole == several, "{policy:?}");
        let mut color = vec![0; whole.len()];
        for (piece, rows) in [0..9, 9..10, 10..43, 43..70].into_iter().enumerate() {
            let color = &mut color[rows.start * WIDTH..rows.end * WIDTH];
            let depth = &mut vec![(); color.len()];
            let mut band =
                Target::band(Rgba8888, NoDepth, SIZE, rows.start as u32, color, depth).expect("rows");
            for columns in [[0, 13, 101], [0, 64, 101], [0, 3, 101], [0, 99, 101]][piece].windows(2) {
                let mut scissor = band.scissor(columns[0]..columns[1], 0..i32::MAX);
                if piece == 2 {
                    draw_random(differentiation, policy, One, &mut scissor, seed, 0);
                } else {
                    for_widest!(lanes => draw_random(differentiation, policy, lanes, &mut scissor, seed, 0));
                }
            }
        }
        assert!(whole == color, "{policy:?}, in pieces");
    }
}

#[test]
fn lanes_pieces_and_vertex_order_change_no_bit() {
    same_bits(PerPixel, Exact, 20);
    same_bits(PerPixel, spans(8), 21);
    same_bits(PerRun, Exact, 23);
    same_bits(PerRun, Planes, 24);
    same_bits(PerRun, spans(16), 25);
    same_bits(PerRun, FixedPoint(spans(8)), 26);
    same_bits(PerTriangle, Exact, 27);
    same_bits(PerTriangle, FixedPoint(Lines::affine()), 28);
    same_bits(AnyDerivatives::PerPixel, Exact, 29);
}

#[test]
fn a_policy_chosen_at_run_time_is_the_policy() {
    use AnyDerivatives as Any;
    fn drawn(differentiation: impl Differentiation, policy: impl Interpolation) -> Vec<u32> {
        frame(differentiation, policy, One, run_seed() ^ 30 << 32, 0)
    }
    let fixed = || FixedPoint(spans(8));
    let all = [
        (drawn(Any::PerPixel, Exact), drawn(PerPixel, Exact)),
        (drawn(Any::PerRun, Exact), drawn(PerRun, Exact)),
        (drawn(Any::PerTriangle, Exact), drawn(PerTriangle, Exact)),
        (drawn(Any::PerPixel, fixed()), drawn(PerRun, fixed())),
        (drawn(Any::PerRun, fixed()), drawn(PerRun, fixed())),
        (drawn(Any::PerTriangle, fixed()), drawn(PerTriangle, fixed())),
    ];
    for (k, (chosen, known)) in all.iter().enumerate() {
        assert!(chosen == known, "{k}");
    }
    for (k, a) in [0, 1, 2, 4, 5].into_iter().enumerate() {
        assert!([0, 1, 2, 4, 5][..k].iter().all(|&b| all[a].1 != all[b].1), "{a} draws as another");
    }
}
