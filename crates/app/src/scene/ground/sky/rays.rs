//! The ways in which texels look outwards, and the elevations that boxes hide from there.

use super::{BOXES, COUNT, DIRECTIONS, below};
use std::f64::consts::TAU;

/// So many steps are made of each length, which doubles.
const STEPS: u32 = 20;

/// The elevations of so many boxes, from none to all.
type Elevations = [u8; COUNT as usize + 1];

/// The steps that all texels make, each in its directions.
pub(super) struct Rays {
    pub(super) steps: Vec<Step>,
    /// Those of two by two texels, in which neighbours look between each other's. Of each the columns and rows of
    /// steps from a texel's middle, in cells.
    directions: [Vec<Vec<[i32; 2]>>; 4],
}

/// A place outwards of a texel.
pub(super) struct Step {
    pub(super) level: usize,
    /// How much of its shadow is left.
    pub(super) weight: f64,
    /// The elevations that boxes reach which are as far away as its end, and as its beginning.
    far: Elevations,
    near: Elevations,
    /// Whether it is over the texel itself, where a surface hides all that is higher.
    is_over: bool,
}

impl Rays {
    /// Those through a side of so many cells, under boxes of this height. What is farther than `reach` cells away
    /// darkens none.
    pub(super) fn new(reach: f64, height: f64, side: usize) -> Self {
        let mut ways = vec![(0, [0.25, 0.5])];
        let (mut from, mut length, mut level) = (0.5, 1.0, 0);
        while from < reach && side >> level > 0 {
            // Near by, a ray of whole steps would pass between the cells of a wall that stands aslant.
            let parts = if level == 0 { 2 } else { 1 };
            for _ in 0..parts * STEPS {
                let to = from + length / f64::from(parts);
                ways.push((level, [from, to]));
                from = to;
            }
            (length, level) = (2.0 * length, level + 1);
        }
        let along = |k: usize, [from, to]: [f64; 2]| if k == 0 { from } else { f64::midpoint(from, to) };
        let places = ways.iter().enumerate().map(|(k, (_, between))| along(k, *between));
        let places: Vec<f64> = places.take_while(|along| *along < reach).collect();
        let step = |(k, (&along, &(level, [from, to]))): (usize, (&f64, &(usize, [f64; 2])))| {
            let left = if k == 0 { 1.0 } else { 1.0 - (along / reach).powi(2) };
            let [far, near] = [to, from].map(|far| elevations(height, far));
            Step { level, weight: left * left, far, near, is_over: k == 0 }
        };
        let steps = places.iter().zip(&ways).enumerate().map(step).collect();
        let direction = |turned: f64| {
            let (sin, cos) = (turned / f64::from(DIRECTIONS) * TAU).sin_cos();
            #[expect(clippy::cast_possible_truncation, reason = "the cast saturates")]
            let cells = |along: &f64| [along * cos, along * sin].map(|apart| apart.floor() as i32);
            places.iter().map(cells).collect()
        };
        let of = |turned: f64| (0..DIRECTIONS).map(|k| direction(f64::from(k) + turned)).collect();
        Self { steps, directions: [0.0, 0.25, 0.5, 0.75].map(of) }
    }

    /// The directions of a texel.
    pub(super) fn of(&self, [column, row]: [u32; 2]) -> &[Vec<[i32; 2]>] {
        &self.directions[((column & 1) * 2 + (row & 1)) as usize]
    }
}

impl Step {
    /// The elevations that boxes hide which stand there.
    pub(super) fn hidden(&self, mut boxes: u64) -> u64 {
        let mut hidden = 0;
        while boxes != 0 {
            let first = boxes.trailing_zeros();
            let count = (boxes >> first).trailing_ones();
            let end = first + count;
            let to = if self.is_over && first > 0 { COUNT.into() } else { self.near[end as usize].into() };
            hidden |= below(to) & !below(self.far[first as usize].into());
            boxes = boxes.checked_shr(end).map_or(0, |rest| rest << end);
        }
        hidden
    }
}

/// The elevations that boxes of this height reach at a distance.
fn elevations(height: f64, far: f64) -> Elevations {
    std::array::from_fn(|boxes| {
        let square = (u32::try_from(boxes).map_or(BOXES, f64::from) * height).powi(2);
        let share = if square > 0.0 { BOXES * square / (square + far * far) } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most all")]
        let bits = share.round() as u8;
        bits
    })
}
