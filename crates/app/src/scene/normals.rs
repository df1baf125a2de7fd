//! Normals for vertices that have none.

use std::collections::HashMap;

use crate::error::Error;
use crate::memory;
use crate::scene::{Model, Vertex};
use joined::{Joined, joined};

mod joined;

/// The company in which a triangle's corners are smooth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group(u32);

impl Group {
    /// That of neighbours, across edges that are not sharp.
    pub const BY_ANGLE: Self = Self(u32::MAX);
    /// None: the triangle is flat.
    pub const ALONE: Self = Self(u32::MAX - 1);
    /// The first of those that only one polygon has.
    const POLYGONS: u32 = 1 << 31;

    /// All triangles of that number, sharp edges or not.
    #[must_use]
    pub const fn numbered(number: u32) -> Self {
        Self(number & (Self::POLYGONS - 1))
    }

    /// The triangles of one polygon, which stand together. All of them get one normal if they lie in a plane.
    #[must_use]
    pub const fn polygon(number: u32) -> Self {
        Self(Self::POLYGONS | (number % (Self::POLYGONS - 2)))
    }

    /// Whether neighbours across edges say something of the corners' normals.
    fn has_edges(self) -> bool {
        self == Self::BY_ANGLE || self.0 < Self::POLYGONS
    }
}

/// The creases by which triangles that share a normal turn at most.
const WIDE: f64 = 1.25;

/// The most triangles at a place that are compared with each other.
const MOST_AT_A_PLACE: usize = 128;

/// Normalizes the model's normals, and gives each vertex whose normal is (0, 0, 0) one of its own making. That is the
/// mean of the normals of the triangles there that belong together. Weights are their angles (Thürmer and Wüthrich,
/// Computing vertex normals from polygonal facets, 1998) times the widths of their flat faces. So a large face beside
/// a narrow bevel stays flat, and the bevel is what is round. At edges that turn by 75 degrees and are smooth by a
/// group's number, angles alone are the weights. So the wall of a cylinder is as strong as its lid.
///
/// A flat face is all that is joined across edges at which it turns by less than 1/1000. Its width is four times its
/// area by the length of its outline. Of a square that is the side, and of a rim twice what it is across, however long
/// it is around. The result depends on the surface alone. It is the same however a face was cut, and where a seam in
/// the texture parts two vertices. Triangles of all parts count.
///
/// Triangles belong together that share a number in `groups`, which has one for each triangle, in the parts' order. Of
/// [`Group::BY_ANGLE`], those do that share an edge at which they turn by less than `crease` degrees. So do those that
/// follow from these, unless they turn by a quarter more than that: the sides of a box do not, whatever lies between
/// them. Of more than 128 triangles at a place, such as the tip of a cone, all do. A vertex where several normals meet
/// becomes several.
///
/// Where the mean vanishes, at a vertex of degenerate triangles only or of a folded surface, it is (0, 0, 1).
///
/// # Cost
/// Linear in vertices and triangles, but for sorting the edges at each vertex. While it runs, it takes some 91 bytes a
/// triangle and 40 a vertex. Where no normal is missing it takes nothing.
///
/// # Errors
/// There is no memory for that.
pub fn complete(model: &mut Model, groups: &[Group], crease: f32) -> Result<(), Error> {
    let mut missing = false;
    for vertex in &mut model.vertices {
        let unit = normalize(vertex.normal.map(f64::from)).unwrap_or([0.0; 3]);
        vertex.normal = unit.map(narrow);
        missing |= unit == [0.0; 3];
    }
    if !missing {
        return Ok(());
    }
    let (before, triangles) = (model.vertices.len(), all(model).count());
    let what = "a model without normals";
    memory::need((40 * before + 91 * triangles) as u64, what)?;
    let Joined { mut sets, count, widths, at_sharp } = joined(model, groups, crease);
    memory::need((32 * count + 20 * triangles) as u64, what)?;
    // Of each set the sum of normals, and that of their weights.
    let mut sums = vec![[0.0; 4]; count];
    let mut is_sharp = vec![false; count];
    for (&set, _) in sets.iter().zip(&at_sharp).filter(|(_, at_sharp)| **at_sharp) {
        is_sharp[set as usize] = true;
    }
    for ((triangle, sets), &width) in all(model).zip(sets.chunks_exact(3)).zip(&widths) {
        for (said, &set) in said(model, triangle).into_iter().zip(sets) {
            add(&mut sums[set as usize], said, if is_sharp[set as usize] { 1.0 } else { width });
        }
    }
    part_wide(model, groups, crease, &widths, (&mut sets, &mut sums));
    drop(widths);
    // Vertices that become several are a list that grows by halves, and a table.
    let new = sums.len().saturating_sub(before);
    let grown = if new > 0 { 2 * (size_of::<Vertex>() + 4) * (before + new) + 48 * new } else { 4 * before };
    memory::need(grown as u64, what)?;
    give(model, groups, &sets, &sums);
    Ok(())
}

/// The normals of a triangle at its three corners, times its angles there, and these.
fn said(model: &Model, triangle: [u32; 3]) -> [[f64; 4]; 3] {
    let points = triangle.map(|i| model.vertices[i as usize].position.map(f64::from));
    [0, 1, 2].map(|i| {
        let to_next = sub(points[(i + 1) % 3], points[i]);
        let to_last = sub(points[(i + 2) % 3], points[i]);
        let across = cross(to_next, to_last);
        let Some([x, y, z]) = normalize(across) else { return [0.0; 4] };
        let angle = length(across).atan2(dot(to_next, to_last));
        [x * angle, y * angle, z * angle, angle]
    })
}

fn add(sum: &mut [f64; 4], other: [f64; 4], weight: f64) {
    sum.iter_mut().zip(other).for_each(|(sum, other)| *sum += weight * other);
}

/// Parts the sets in which triangles turn by [`WIDE`] creases or more, although each edge between is smooth. There a
/// corner gets the mean of those that do not turn so far from its own.
fn part_wide(
    model: &Model,
    groups: &[Group],
    crease: f32,
    widths: &[f64],
    (sets, sums): (&mut [u32], &mut Vec<[f64; 4]>),
) {
    let most = (WIDE * f64::from(crease)).min(180.0).to_radians();
    let turn = |a: [f64; 3], b: [f64; 3]| length(cross(a, b)).atan2(dot(a, b));
    // All that are within a half of that from the mean are within all of it from each other.
    let mut wide: HashMap<u32, Vec<u32>> = HashMap::new();
    let corners = all(model).zip(groups).zip((0_u32..).step_by(3));
    for ((triangle, _), first) in corners.filter(|((_, group), _)| **group == Group::BY_ANGLE) {
        let Some(own) = normalize(across(model, triangle)) else { continue };
        for corner in first..first + 3 {
            let set = sets[corner as usize];
            let [x, y, z, _] = sums[set as usize];
            if normalize([x, y, z]).is_none_or(|mean| turn(own, mean) >= most / 2.0) {
                wide.entry(set).or_default();
            }
        }
    }
    for (corner, set) in (0_u32..).zip(sets.iter()) {
        if let Some(corners) = wide.get_mut(set) {
            corners.push(corner);
        }
    }
    let triangles: Vec<[u32; 3]> = if wide.is_empty() { Vec::new() } else { all(model).collect() };
    let mut wide: Vec<_> = wide.into_iter().filter(|(_, corners)| corners.len() <= MOST_AT_A_PLACE).collect();
    wide.sort_unstable_by_key(|&(set, _)| set);
    for (set, corners) in wide {
        let of = |corner: u32| triangles[corner as usize / 3];
        let normals: Vec<_> = corners.iter().map(|&corner| normalize(across(model, of(corner)))).collect();
        // The corners that count for others, a bit for each; those with equal ones share a normal.
        let mut known: Vec<(u128, u32)> = Vec::new();
        for (&corner, own) in corners.iter().zip(&normals) {
            let counts = |other: &Option<[f64; 3]>| own.zip(*other).is_some_and(|(a, b)| turn(a, b) < most);
            let bits = normals.iter().zip(0..).filter(|(other, _)| counts(other));
            let bits = bits.fold(0_u128, |bits, (_, k)| bits | 1 << k);
            let new = match known.iter().find(|(other, _)| *other == bits) {
                Some(&(_, new)) => new,
                None => {
                    let mut sum = [0.0; 4];
                    for (&other, _) in corners.iter().zip(0..).filter(|(_, k)| bits >> k & 1 == 1) {
                        let said = said(model, of(other))[other as usize % 3];
                        add(&mut sum, said, widths[other as usize / 3]);
                    }
                    let new = if known.is_empty() { set } else { narrowed(sums.len()) };
                    if known.is_empty() {
                        sums[set as usize] = sum;
                    } else {
                        sums.push(sum);
                    }
                    known.push((bits, new));
                    new
                }
            };
            sets[corner as usize] = new;
        }
    }
}

/// All triangles, in the parts' order.
fn all(model: &Model) -> impl Iterator<Item = [u32; 3]> {
    model.parts.iter().flat_map(|part| part.triangles.iter().copied())
}

/// The normal of a triangle, as long as twice its area.
fn across(model: &Model, triangle: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = triangle.map(|i| model.vertices[i as usize].position.map(f64::from));
    cross(sub(b, a), sub(c, a))
}

/// The number of a triangle.
fn narrowed(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

/// Gives the corners without normals those of their sets.
fn give(model: &mut Model, groups: &[Group], sets: &[u32], sums: &[[f64; 4]]) {
    const NONE: u32 = u32::MAX;
    let Model { vertices, parts, .. } = model;
    let missing = |normal: [f32; 3]| normal.iter().all(|x| x.abs() <= 0.0);
    // The set of each vertex that lacked a normal, and the vertices that it became for others.
    let mut set_of = vec![NONE; vertices.len()];
    let mut others: HashMap<(u32, u32), u32> = HashMap::new();
    let corners = parts.iter_mut().flat_map(|part| part.triangles.iter_mut());
    for ((triangle, sets), &group) in corners.zip(sets.chunks_exact(3)).zip(groups) {
        // A corner of a degenerate triangle has no say.
        let [a, b, c] = triangle.map(|i| vertices[i as usize].position.map(f64::from));
        if normalize(cross(sub(b, a), sub(c, a))).is_none() {
            continue;
        }
        for (index, &set) in triangle.iter_mut().zip(sets) {
            let vertex = vertices[*index as usize];
            let set_here = &mut set_of[*index as usize];
            if !missing(vertex.normal) || *set_here == set {
                continue;
            }
            if *set_here == NONE {
                *set_here = set;
                continue;
            }
            let mut new = || {
                set_of.push(set);
                vertices.push(vertex);
                u32::try_from(vertices.len() - 1).unwrap_or(NONE)
            };
            // The set of a flat triangle has no other corner there.
            *index = match group {
                Group::ALONE => new(),
                _ => *others.entry((*index, set)).or_insert_with(new),
            };
        }
    }
    for (vertex, &set) in vertices.iter_mut().zip(&set_of) {
        if missing(vertex.normal) {
            let [x, y, z, weight] = sums.get(set as usize).copied().unwrap_or_default();
            vertex.normal =
                normalize([x, y, z].map(|sum| sum / weight)).unwrap_or([0.0, 0.0, 1.0]).map(narrow);
        }
    }
}

pub(crate) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector in the direction of `a`, unless it has none.
pub(crate) fn normalize(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = length(a);
    // Sums of opposite unit normals leave a residue of rounding, which has no direction worth keeping; vectors of
    // this length do not come from f32 input otherwise, except as products of two tiny edges.
    (length > 1e-30 && length.is_finite()).then(|| a.map(|x| x / length))
}

/// The nearest f32.
#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is the purpose")]
pub(crate) fn narrow(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests;
