//! How much of the sky the places of a ground do not see.
//!
//! Over each cell of the ground stands a column of 64 boxes, a bit each: those that a surface passes through. From
//! a texel, columns are looked at outwards in some directions. What stands in a column hides an interval of
//! elevations. Of an elevation e, a ground sees by sin² e: in bits of that, equal parts of its light, hidden ones are
//! joined by `|`.

use super::{CELLS, Ground, SIDE, TEXELS, opacity};
use crate::options::Wrap;
use crate::scene::{Model, Vertex};
use crate::threads::{Task, available, by_threads};

/// A corner over the ground: columns, rows, height, all in cells, and its texture coordinates.
type Corner = [f64; 5];

/// Boxes of a column.
const BOXES: f64 = 64.0;

/// The directions that a cell looks in.
const DIRECTIONS: u8 = 16;

/// So many steps are made of each length, which doubles.
const STEPS: u32 = 20;

/// The boxes over all cells, and over squares of 2, 4, … cells.
pub(super) struct Columns {
    levels: Vec<Vec<u64>>,
    /// The height of a box, in cells.
    height: f64,
}

/// A place outwards of a cell.
struct Step {
    level: usize,
    /// How far away it is, and where it begins and ends.
    along: f64,
    from: f64,
    to: f64,
    /// How much of its shadow is left.
    weight: f64,
}

impl Columns {
    /// Those of what stands on a ground, up to a height in cells.
    pub(super) fn of(model: &Model, ground: &Ground, wrap: Wrap, height: f64) -> Self {
        let height = (height / BOXES).max(f64::MIN_POSITIVE);
        let mut cells = vec![0_u64; SIDE * SIDE];
        for part in &model.parts {
            let alpha = opacity::alpha(model, part, wrap);
            for triangle in &part.triangles {
                let [Some(a), Some(b), Some(c)] = triangle.map(|k| model.vertices.get(k as usize)) else {
                    continue;
                };
                let corner = |v: &Vertex| {
                    let [column, row, height] = ground.cells(v.position.map(f64::from));
                    let [u, v] = v.uv.map(f64::from);
                    [column, row, height, u, v]
                };
                let corners = [a, b, c].map(corner);
                let steps = opacity::steps(corners);
                over_cells(&corners, &mut |[column, row]: [usize; 2], piece: &[Corner]| {
                    let Some(cell) = cells.get_mut(row * SIDE + column).filter(|_| column < SIDE) else {
                        return;
                    };
                    let middle = |k: usize| mean(piece.iter().map(|corner| corner[k]));
                    if alpha([middle(3), middle(4)], steps) > opacity::threshold(column, row) {
                        let heights = piece.iter().map(|corner| corner[2] / height);
                        let least = heights.clone().fold(f64::INFINITY, f64::min);
                        let most = heights.fold(0.0, f64::max);
                        // A box of which half is used, and one at least.
                        let first = least.round().min(BOXES - 1.0);
                        *cell |= bits(first, most.round().max(first + 1.0));
                    }
                });
            }
        }
        let mut levels = vec![cells];
        while let Some(finer) = levels.last().filter(|finer| finer.len() > 1) {
            let side = SIDE >> (levels.len() - 1);
            let square = |k: usize| {
                let (row, column) = (2 * (k / (side / 2)), 2 * (k % (side / 2)));
                let of = |row: usize| finer[row * side + column] | finer[row * side + column + 1];
                of(row) | of(row + 1)
            };
            let coarser = (0..finer.len() / 4).map(square).collect();
            levels.push(coarser);
        }
        Self { levels, height }
    }

    /// The share of the sky's light that each texel does not have, row by row. What is farther than `reach` cells away
    /// darkens none, and what is near it little.
    pub(super) fn darkness(&self, reach: f64) -> Vec<f64> {
        let mut steps = vec![Step { level: 0, along: 0.0, from: 0.0, to: 0.5, weight: 1.0 }];
        let (mut from, mut length, mut level) = (0.5, 1.0, 0);
        while from < reach && level < self.levels.len() {
            for _ in 0..STEPS {
                let along: f64 = from + length / 2.0;
                let left = (1.0 - (along / reach).powi(2)).max(0.0);
                steps.push(Step { level, along, from, to: from + length, weight: left * left });
                from += length;
            }
            (length, level) = (2.0 * length, level + 1);
        }
        steps.retain(|step| step.weight > 0.0);
        let mut dark = vec![0.0; TEXELS * TEXELS];
        let steps = &steps;
        let threads = available();
        let rows = dark.chunks_mut(TEXELS).zip(0_u8..).map(|(texels, row)| {
            Box::new(move || {
                texels
                    .iter_mut()
                    .zip(0_u8..)
                    .for_each(|(dark, column)| *dark = self.dark([column, row], steps));
            }) as Task<'_>
        });
        by_threads(rows.collect(), threads.get());
        dark
    }

    fn dark(&self, texel: [u8; 2], steps: &[Step]) -> f64 {
        // Neighbours look in directions between those of each other.
        let turned = f64::from((texel[0] & 1) * 2 + (texel[1] & 1)) / 4.0;
        let place = texel.map(|k| 2.0 * f64::from(k) + 1.0);
        let mut sum = 0.0;
        for k in 0..DIRECTIONS {
            let angle = (f64::from(k) + turned) / f64::from(DIRECTIONS) * std::f64::consts::TAU;
            let (sin, cos) = angle.sin_cos();
            let mut hidden = 0_u64;
            for step in steps {
                let [x, y] = [place[0] + step.along * cos, place[1] + step.along * sin];
                if !(0.0..CELLS).contains(&x) || !(0.0..CELLS).contains(&y) || hidden == u64::MAX {
                    break;
                }
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "they are cells")]
                let (column, row) = (x as usize >> step.level, y as usize >> step.level);
                let boxes = self.levels[step.level][row * (SIDE >> step.level) + column];
                if boxes != 0 {
                    let now = self.elevations(boxes, step) & !hidden;
                    hidden |= now;
                    sum += f64::from(now.count_ones()) * step.weight;
                }
            }
        }
        sum / (BOXES * f64::from(DIRECTIONS))
    }

    /// The elevations that boxes hide which are so far away.
    fn elevations(&self, mut boxes: u64, step: &Step) -> u64 {
        let mut hidden = 0;
        while boxes != 0 {
            let first = boxes.trailing_zeros();
            let count = (boxes >> first).trailing_ones();
            let share = |boxes: u32, far: f64| {
                let height = f64::from(boxes) * self.height;
                let square = height * height;
                if square > 0.0 { BOXES * square / (square + far * far) } else { 0.0 }
            };
            hidden |= bits(share(first, step.to).round(), share(first + count, step.from).round());
            boxes = boxes.checked_shr(first + count).map_or(0, |rest| rest << (first + count));
        }
        hidden
    }
}

/// The bits from one to another, without that; both whole.
fn bits(from: f64, to: f64) -> u64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    let [from, to] = [from, to].map(|bit| bit.min(BOXES) as u32);
    let below = |bit: u32| u64::MAX.checked_shr(64 - bit).unwrap_or(0);
    below(to) & !below(from)
}

fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().fold(0.0, |count, _| count + 1.0);
    values.sum::<f64>() / f64::max(count, 1.0)
}

/// Hands on the pieces of a triangle over each cell of the ground. One without any area from above has some as well.
fn over_cells(corners: &[Corner; 3], each: &mut impl FnMut([usize; 2], &[Corner])) {
    if !corners.iter().flatten().all(|x| x.is_finite()) {
        return;
    }
    let range = |piece: &[Corner], axis: usize| {
        let least = piece.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min).floor();
        let most = piece.iter().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max).floor();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "they are cells")]
        let [least, most] = [least.max(0.0), most.min(CELLS - 1.0) + 1.0].map(|k| k as usize);
        least..most
    };
    let (columns, rows) = (range(corners, 0), range(corners, 1));
    if columns.len() == 1 && rows.len() == 1 {
        return each([columns.start, rows.start], corners);
    }
    for row in rows {
        let strip = between(corners, 1, row);
        for column in if strip.is_empty() { 0..0 } else { range(&strip, 0) } {
            if columns.len() == 1 {
                each([column, row], &strip);
            } else {
                let piece = between(&strip, 0, column);
                if !piece.is_empty() {
                    each([column, row], &piece);
                }
            }
        }
    }
}

/// The part of a convex outline in a row or a column of cells.
fn between(outline: &[Corner], axis: usize, cell: usize) -> Vec<Corner> {
    let least = u32::try_from(cell).map_or(0.0, f64::from);
    let mut kept = outline.to_vec();
    for (limit, sign) in [(least, 1.0), (least + 1.0, -1.0)] {
        let inside = |corner: &Corner| sign * (corner[axis] - limit);
        if kept.iter().all(|corner| inside(corner) >= 0.0) {
            continue;
        }
        let mut cut = Vec::with_capacity(kept.len() + 1);
        for (k, a) in kept.iter().enumerate() {
            let b = &kept[(k + 1) % kept.len()];
            let [of_a, of_b] = [a, b].map(inside);
            if of_a >= 0.0 {
                cut.push(*a);
            }
            if (of_a >= 0.0) != (of_b >= 0.0) {
                let share = of_a / (of_a - of_b);
                cut.push([0, 1, 2, 3, 4].map(|k: usize| a[k] + share * (b[k] - a[k])));
            }
        }
        kept = cut;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Part;
    use crate::scene::normals::narrow;
    use std::f64::consts::{PI, TAU};

    const GROUND: Ground =
        Ground { up: (1, 1.0), corner: [-2.0, -2.0], side: 4.0, low: 0.0, height: 2.0, reach: 4.0 };

    /// The share that a place on the ground does not see of the sky, of a model under which nothing is left out.
    fn dark(model: &Model, [x, z]: [f64; 2]) -> f64 {
        let columns = Columns::of(model, &GROUND, Wrap::Repeat, CELLS / 2.0);
        let dark = columns.darkness(f64::INFINITY);
        let [column, row, _] = GROUND.cells([x, 0.0, z]);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
        let [column, row] = [column, row].map(|cell| cell as usize / 2);
        // With the neighbours, which look between its directions.
        let square = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(a, b)| dark[(row + a) * TEXELS + column + b]);
        mean(square.into_iter())
    }

    fn model(places: &[[f64; 3]], triangles: Vec<[u32; 3]>) -> Model {
        let vertex = |place: &[f64; 3]| Vertex { position: place.map(narrow), ..Vertex::default() };
        let part = Part { triangles, ..Part::default() };
        Model { vertices: places.iter().map(vertex).collect(), parts: vec![part], ..Model::default() }
    }

    /// A ball of radius r whose middle is h above a place hides (r / h)² of its sky.
    #[test]
    fn a_ball_hides_the_square_of_its_sine() {
        for (radius, height) in [(0.5, 1.0), (0.3, 1.5), (0.9, 1.0)] {
            let place = |k: u32| {
                let [across, down] = [k % 64, k / 64].map(|k| f64::from(k) * TAU / 64.0);
                let ring = radius * (down / 2.0).sin();
                [ring * across.cos(), height + radius * (down / 2.0).cos(), ring * across.sin()]
            };
            let places: Vec<_> = (0..65 * 64).map(place).collect();
            let square = |k: u32| {
                let next = k / 64 * 64 + (k + 1) % 64;
                [[k, next, k + 64], [next, next + 64, k + 64]]
            };
            let ball = model(&places, (0..64 * 64).flat_map(square).collect());
            let (found, right) = (dark(&ball, [0.0, 0.0]), (radius / height).powi(2));
            assert!((found - right).abs() < 0.04, "{radius} {height}: {found}, not {right}");
            // Beside it, the part of that direction counts.
            let away = f64::hypot(1.5, height);
            let right = (radius / away).powi(2) * height / away;
            let found = dark(&ball, [1.5, 0.0]);
            assert!((found - right).abs() < 0.03, "{radius} {height}: {found}, not {right}");
        }
    }

    /// The view factor of an upright rectangle for a place before its middle.
    #[test]
    fn a_wall_hides_its_view_factor() {
        for (width, height, away) in [(3.8, 1.0, 0.5), (3.8, 1.9, 0.25), (1.0, 0.3, 0.3), (2.0, 0.5, 1.5)] {
            let half = width / 2.0;
            let corners = [[0.0, 0.0, -half], [0.0, 0.0, half], [0.0, height, half], [0.0, height, -half]];
            let wall = model(&corners, vec![[0, 1, 2], [0, 2, 3]]);
            let slant = f64::hypot(height, away);
            let right = ((half / away).atan() - away / slant * (half / slant).atan()) / PI;
            for (at, side) in [([-away, 0.0], "left"), ([away, 0.0], "right")] {
                let found = dark(&wall, at);
                assert!((found - right).abs() < 0.03, "{width} {height} {away} {side}: {found}, not {right}");
            }
        }
    }

    /// A plate with a hole is none over the hole, and as much as a plate beside it.
    #[test]
    fn a_low_plate_hides_all_and_its_hole_nothing() {
        let corners = [-1.0, 1.0].map(|x| [-1.0, -0.5, 0.5, 1.0].map(|z| [x, 0.02, z])).concat();
        let plates = vec![[0, 1, 5], [0, 5, 4], [2, 3, 7], [2, 7, 6]];
        let plate = model(&corners, plates);
        assert!(dark(&plate, [0.0, 0.75]) > 0.97 && dark(&plate, [0.0, -0.75]) > 0.97);
        assert!(dark(&plate, [0.0, 0.0]) < 0.03);
    }

    #[test]
    fn what_is_not_finite_or_beside_the_ground_hides_nothing() {
        let far =
            [[f64::NAN, 1.0, 0.0], [1e30, 1.0, 1.0], [-1.0, 1.0, 1e30], [5.0, 1.0, 5.0], [6.0, 1.0, 5.0]];
        let none = model(&far, vec![[0, 1, 2], [3, 4, 4], [0, 0, 0], [9, 1, 2]]);
        assert!(dark(&none, [0.0, 0.0]).abs() < f64::EPSILON);
    }
}
