//! How much of the sky the places of a ground do not see.
//!
//! Over each cell of the ground stands a column of 64 boxes, a bit each: those that a surface passes through. From
//! a texel, columns are looked at outwards in some directions. What stands in a column hides an interval of
//! elevations. Of an elevation e, a ground sees by sin² e: in bits of that, equal parts of its light, hidden ones are
//! joined by `|`.
//!
//! A surface that is narrower than a cell, or full of holes, has as many of its boxes as it has area. Glass has
//! columns of its own, and lets through what it is said to.

use super::{Ground, floor, opacity};
use crate::options::Wrap;
use crate::scene::normals::{cross, length, narrow};
use crate::scene::{Model, Part, Vertex};
use crate::threads::{Task, available, by_threads};
use alberti::raster::color::AnyBlend;
use rays::Rays;

mod rays;

/// A corner over the ground: columns, rows, height, all in cells, and its texture coordinates.
type Corner = [f64; 5];

/// Boxes of a column.
const COUNT: u8 = 64;
const BOXES: f64 = COUNT as f64;

/// The directions that a texel looks in.
const DIRECTIONS: u8 = 16;

/// The height in boxes up to which a surface is on the ground.
const FLAT: f64 = 0.25;

/// The texels below a surface on the ground that are seen at its rim, by blur and filter.
const RIM: u32 = 4;

/// The heights in boxes below which a surface touches the ground, and is low over all of a cell: too low for boxes.
const TOUCHING: f64 = 0.5;
const LOW: f64 = 2.0;

/// The share of the area of a surface through a cell from which on it counts as whole.
const WHOLE: f64 = 0.4;

/// All that hides the sky of a ground.
pub(super) struct Sky {
    layers: Vec<Layer>,
    /// The cells on which a surface lies.
    covered: Vec<bool>,
    /// Cells along a side.
    side: usize,
    /// The height of a box, in cells.
    height: f64,
}

/// Surfaces that hide the same share.
struct Layer {
    opacity: f64,
    /// The boxes over all cells, and over squares of 2, 4, … cells.
    levels: Vec<Vec<u64>>,
}

impl Sky {
    /// That over a ground, of what stands on it up to a height in cells.
    pub(super) fn over(ground: &Ground, model: &Model, wrap: Wrap, height: f64) -> Self {
        let height = (height / BOXES).max(f64::MIN_POSITIVE);
        let mut alphas: Vec<u8> = model.parts.iter().map(alpha_of).collect();
        alphas.sort_unstable();
        alphas.dedup();
        let side = ground.cells as usize;
        let mut covered = vec![false; side * side];
        let layer = |&alpha: &u8| {
            let parts = model.parts.iter().filter(|part| alpha_of(part) == alpha);
            let cells = columns(ground, parts, (model, wrap), height, &mut covered);
            Layer { opacity: f64::from(alpha) / 255.0, levels: pyramid(cells, side) }
        };
        Self { layers: alphas.iter().map(layer).collect(), covered, side, height }
    }

    /// The share of the sky's light that each texel of two by two cells does not have, row by row. What is farther than
    /// `reach` cells away darkens none, and what is near it little.
    pub(super) fn darkness(&self, reach: f64) -> Vec<f64> {
        let rays = &Rays::new(reach, self.height, self.side);
        let texels = self.side / 2;
        let covered: Vec<bool> =
            (0..texels * texels).map(|k| self.is_covered([k % texels, k / texels])).collect();
        // Dark texels stay below what lies on the ground, farther in than its rim.
        let mut dark = vec![1.0; texels * texels];
        let rows = dark.chunks_mut(texels).zip(covered.chunks(texels)).zip(0_u32..);
        let rows = rows.map(|((texels, covered), row)| {
            Box::new(move || {
                let open = texels.iter_mut().zip(covered).zip(0_u32..).filter(|((_, covered), _)| !**covered);
                for ((dark, _), column) in open {
                    let light = self.layers.iter().map(|layer| {
                        let is_empty = layer.is_empty([column, row], reach, self.side);
                        1.0 - layer.opacity
                            * if is_empty { 0.0 } else { layer.dark([column, row], rays, self.side) }
                    });
                    *dark = 1.0 - light.product::<f64>();
                }
            }) as Task<'_>
        });
        by_threads(rows.collect(), available().get());
        self.go_on_below(&mut dark, &covered);
        dark
    }

    /// Whether surfaces lie on most cells of a texel.
    fn is_covered(&self, [column, row]: [usize; 2]) -> bool {
        let [first, second] = [0, 1].map(|below| (2 * row + below) * self.side + 2 * column);
        let cells = [first, first + 1, second, second + 1];
        cells.into_iter().filter(|&cell| self.covered[cell]).count() > 1
    }

    /// Gives texels below surfaces on the ground, which see what they cannot see from there, the mean of those beside
    /// them: no rim is lighter than what is around it.
    fn go_on_below(&self, dark: &mut [f64], covered: &[bool]) {
        let side = self.side / 2;
        let mut unknown: Vec<usize> = (0..dark.len()).filter(|&k| covered[k]).collect();
        let mut is_known: Vec<bool> = covered.iter().map(|covered| !covered).collect();
        for _ in 0..RIM {
            let beside = |&k: &usize| {
                let (column, row) = (k % side, k / side);
                let around = |k: usize| k.saturating_sub(1)..=(k + 1).min(side - 1);
                let all = around(row).flat_map(|row| around(column).map(move |column| row * side + column));
                let known = all.filter(|&other| is_known[other]).map(|other| dark[other]);
                known.clone().next().map(|_| (k, mean(known)))
            };
            let found: Vec<_> = unknown.iter().filter_map(beside).collect();
            for (k, value) in found {
                (dark[k], is_known[k]) = (value, true);
            }
            unknown.retain(|&k| !is_known[k]);
        }
    }
}

/// The share that a part hides: of glass less than all.
fn alpha_of(part: &Part) -> u8 {
    if let AnyBlend::Constant(alpha) = part.detail.blend { alpha } else { u8::MAX }
}

/// The boxes that these parts pass through, over each cell; cells on which they lie are `covered`, if they are opaque.
fn columns<'a>(
    ground: &Ground,
    parts: impl Iterator<Item = &'a Part>,
    (model, wrap): (&Model, Wrap),
    height: f64,
    covered: &mut [bool],
) -> Vec<u64> {
    let side = ground.cells as usize;
    let mut cells = vec![(0_u64, 0.0_f32, 0.0_f32); side * side];
    // All that stands on a floor is a quarter of `near` below its ground.
    let lowest = -ground.near / 2.0 * f64::from(ground.cells) / ground.side;
    for part in parts {
        let alpha = opacity::alpha(model, part, wrap);
        for triangle in &part.triangles {
            let [Some(a), Some(b), Some(c)] = triangle.map(|k| model.vertices.get(k as usize)) else {
                continue;
            };
            if ground.on_floor && floor::floor_of(model, ground, triangle).is_some() {
                continue;
            }
            let corner = |v: &Vertex| {
                let [column, row, height] = ground.cells(v.position.map(f64::from));
                let [u, v] = v.uv.map(f64::from);
                [column, row, height, u, v]
            };
            let corners = [a, b, c].map(corner);
            let steps = opacity::steps(corners);
            over_cells(&corners, side, &mut |[column, row]: [usize; 2], piece: &[Corner]| {
                let Some((boxes, seen, lying)) = cells.get_mut(row * side + column).filter(|_| column < side)
                else {
                    return;
                };
                let middle = |k: usize| mean(piece.iter().map(|corner| corner[k]));
                let opaque = alpha([middle(3), middle(4)], steps) * area(piece);
                // The lower side of a slab, or a foot in the floor, is below it.
                if opaque > 0.0 && piece.iter().any(|corner| corner[2] >= lowest) {
                    let heights = piece.iter().map(|corner| corner[2] / height);
                    let least = heights.clone().fold(f64::INFINITY, f64::min);
                    let most = heights.fold(0.0, f64::max);
                    if least < TOUCHING && most < LOW && alpha_of(part) == u8::MAX {
                        *lying += narrow(opaque);
                    }
                    // It lies on the ground, and hides what it darkens.
                    if most < FLAT {
                        return;
                    }
                    // A box of which half is used, and one at least.
                    let first = least.round().min(BOXES - 1.0);
                    *boxes |= bits(first, most.round().max(first + 1.0));
                    *seen += narrow(opaque);
                }
            });
        }
    }
    for (covered, (.., lying)) in covered.iter_mut().zip(&cells) {
        *covered |= f64::from(*lying) > WHOLE;
    }
    let kept = |(index, (boxes, seen, _)): (usize, (u64, f32, f32))| {
        if boxes == 0 {
            return 0;
        }
        // A level surface has the area of its cell, and a wall its height.
        let whole = (f64::from(boxes.count_ones()) * height).max(1.0);
        let share = f64::from(seen) / (WHOLE * whole);
        if share >= 1.0 { boxes } else { boxes & some([index % side, index / side], share) }
    };
    cells.into_iter().enumerate().map(kept).collect()
}

/// A share of the boxes of a column: of boxes side by side in all directions, as many as it says.
fn some([column, row]: [usize; 2], share: f64) -> u64 {
    let [column, row] = [column, row].map(|k| u32::try_from(k).map_or(0.0, f64::from));
    // Fractions of multiples of three numbers that are as far as can be from any ratio.
    let start = 0.819_172_513_396 * column + 0.671_043_606_704 * row;
    let is_kept = |k: u32| (start + 0.549_700_477_902 * f64::from(k)).fract() < share;
    (0..64).filter(|&k| is_kept(k)).fold(0, |boxes, k| boxes | 1 << k)
}

/// The boxes over squares of cells that are larger by two.
fn pyramid(cells: Vec<u64>, side: usize) -> Vec<Vec<u64>> {
    let mut levels = vec![cells];
    while let Some(finer) = levels.last().filter(|finer| finer.len() > 1) {
        let side = side >> (levels.len() - 1);
        let square = |k: usize| {
            let (row, column) = (2 * (k / (side / 2)), 2 * (k % (side / 2)));
            let of = |row: usize| finer[row * side + column] | finer[row * side + column + 1];
            of(row) | of(row + 1)
        };
        let coarser = (0..finer.len() / 4).map(square).collect();
        levels.push(coarser);
    }
    levels
}

impl Layer {
    /// Whether nothing is within reach of a texel.
    fn is_empty(&self, texel: [u32; 2], reach: f64, side: usize) -> bool {
        let far = |level: &usize| f64::from(1_u32 << *level) >= reach;
        let level = (0..self.levels.len()).find(far).unwrap_or(self.levels.len() - 1);
        let [column, row] = texel.map(|k| (2 * k as usize + 1) >> level);
        let last = (side >> level) - 1;
        let around = |k: usize| k.saturating_sub(1)..=(k + 1).min(last);
        around(row).all(|row| around(column).all(|column| self.levels[level][row * (last + 1) + column] == 0))
    }

    fn dark(&self, texel: [u32; 2], rays: &Rays, side: usize) -> f64 {
        let levels: Vec<&[u64]> = rays.steps.iter().map(|step| &self.levels[step.level][..]).collect();
        let mut sum = 0.0;
        for ray in rays.of(texel) {
            let mut hidden = 0_u64;
            for ((step, level), apart) in rays.steps.iter().zip(&levels).zip(ray) {
                let [x, y] = [0, 1].map(|k| (2 * texel[k] + 1).wrapping_add_signed(apart[k]) as usize);
                if x >= side || y >= side || hidden == u64::MAX {
                    break;
                }
                let boxes = level[(y >> step.level) * (side >> step.level) + (x >> step.level)];
                if boxes != 0 {
                    let now = step.hidden(boxes) & !hidden;
                    hidden |= now;
                    sum += f64::from(now.count_ones()) * step.weight;
                }
            }
        }
        sum / (BOXES * f64::from(DIRECTIONS))
    }
}

/// The bits from one to another, without that; both whole.
fn bits(from: f64, to: f64) -> u64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    let [from, to] = [from, to].map(|bit| bit.min(BOXES) as u32);
    below(to) & !below(from)
}

/// So many bits from the lowest on, at most 64.
fn below(count: u32) -> u64 {
    u64::MAX.checked_shr(64 - count).unwrap_or(0)
}

fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().fold(0.0, |count, _| count + 1.0);
    values.sum::<f64>() / f64::max(count, 1.0)
}

/// The area of a flat outline, in cells.
fn area(piece: &[Corner]) -> f64 {
    let from = |k: usize, corner: &Corner| corner[k] - piece[0][k];
    let pairs = piece.iter().skip(1).zip(piece.iter().skip(2));
    let crossed = pairs.fold([0.0; 3], |sum, (a, b)| {
        let [a, b] = [a, b].map(|corner| [0, 1, 2].map(|k| from(k, corner)));
        let cross = cross(a, b);
        [0, 1, 2].map(|k| sum[k] + cross[k])
    });
    length(crossed) / 2.0
}

/// Hands on the pieces of a triangle over each cell of a ground of so many a side. One without any area from above has
/// some as well.
fn over_cells(corners: &[Corner; 3], side: usize, each: &mut impl FnMut([usize; 2], &[Corner])) {
    if !corners.iter().flatten().all(|x| x.is_finite()) {
        return;
    }
    let range = |piece: &[Corner], axis: usize| {
        let least = piece.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min).floor();
        let most = piece.iter().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max).floor();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "they are cells")]
        let [least, most] = [least.max(0.0), (most + 1.0).max(0.0)].map(|k| k as usize);
        least..most.min(side)
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
mod tests;
