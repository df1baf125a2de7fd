//! The meshes of parts: fewer triangles, vertices in integers, and the order of both.

use meshoptimizer_rs::{
    Attributes as Weighed, Positions, SimplifyOptions, SimplifySettings, Workspace, analyze_vertex_cache,
    optimize_vertex_cache, simplify_scale, simplify_sloppy, simplify_with_attributes,
};
use std::collections::HashMap;

use super::packed::{Grids, Losses, Packed, unit};
use super::report::named;
use super::texels::Texture;
use super::{Asset, Wish};
use crate::error::{Error, number};
use crate::scene::normals::narrow;
use crate::scene::{Model, Part, Vertex};
use alberti::baked::{Attributes, MAX_VERTICES};
use alberti::glam::Vec3;
use alberti::{Ball, IntegerMesh, IntegerVertex, Meshlet, Rgba8, Split};

/// The mesh of a part, as it lies in flash.
#[derive(Clone, Debug)]
pub struct Piece {
    /// The number of the part in its model.
    pub part: usize,
    /// The numbers that its vertices stand for.
    pub grids: Grids,
    /// Its vertices, in the order in which triangles use them.
    pub vertices: Vec<Packed>,
    /// Its triangles, those of a meshlet one after the other.
    pub triangles: Vec<[u16; 3]>,
    /// Its meshlets.
    pub meshlets: Vec<Meshlet>,
    /// The ball around it.
    pub ball: Ball,
    /// The surface's colour.
    pub color: Rgba8,
    /// The number of its texture among the asset's.
    pub texture: Option<usize>,
    /// The most that simplification has moved its surface, in object space.
    pub moved: f32,
    /// How often a cache has to transform a vertex.
    pub order: Order,
}

/// Transformed vertices a triangle, with a cache of 16 vertices, in the order of the model and in that of the asset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Order {
    /// Of the model.
    pub before: f32,
    /// Of the asset.
    pub after: f32,
}

/// The vertices of a cache without slots for all.
const CACHE: u32 = 16;
/// The weight of a unit normal's components, and of texture coordinates, against the size of a model.
const WEIGHT: f32 = 0.5;

/// The error of a simplification that only a number of triangles limits.
const NO_LIMIT: f32 = 1e6;

/// The triangles down to which a part is simplified for a distance: those of the least closed surface.
const LEAST: usize = 4;

/// A way to simplify, the most careful first.
#[derive(Clone, Copy)]
enum Way {
    /// Borders do not move, so that parts stay joined.
    Locked,
    /// They do.
    Free,
    /// Seams move as well.
    Permissive,
    /// By a grid, without regard to seams, normals and texture coordinates.
    Sloppy,
}

impl Way {
    const ALL: [Self; 4] = [Self::Locked, Self::Free, Self::Permissive, Self::Sloppy];

    fn options(self) -> Option<SimplifyOptions> {
        match self {
            Self::Locked => Some(SimplifyOptions::LOCK_BORDER),
            Self::Free => Some(SimplifyOptions::EMPTY),
            Self::Permissive => Some(SimplifyOptions::PERMISSIVE),
            Self::Sloppy => None,
        }
    }
}

/// The vertices and triangles of a part alone.
struct Alone {
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
}

impl Alone {
    fn new(model: &Model, part: &Part) -> Self {
        let mut numbers = HashMap::new();
        let mut vertices = vec![];
        let mut number = |index: u32| {
            *numbers.entry(index).or_insert_with(|| {
                vertices.push(model.vertices[index as usize]);
                small(vertices.len() - 1)
            })
        };
        let triangles = part.triangles.iter().map(|triangle| triangle.map(&mut number)).collect();
        Self { vertices, triangles }
    }

    /// Takes triangles away, down to so many, as far as the surface is then wrong by at most `error`, in object space.
    /// Returns how far it has moved at most.
    ///
    /// The first of these ways that leaves no more is taken, else the one that leaves fewest. Something is left.
    fn simplify(
        &mut self,
        most: usize,
        error: f32,
        ways: &[Way],
        attributes: Attributes,
    ) -> Result<f32, Error> {
        let positions: Vec<[f32; 3]> = self.vertices.iter().map(|v| v.position).collect();
        let weighed = |v: &Vertex| {
            let normal = if attributes.contains(Attributes::NORMAL) { v.normal } else { [0.0; 3] };
            let [u, v] = if attributes.contains(Attributes::UV) { v.uv } else { [0.0; 2] };
            [normal[0], normal[1], normal[2], u, v]
        };
        let values: Vec<f32> = self.vertices.iter().flat_map(weighed).collect();
        let places = Positions::from_packed(&positions);
        let values = Weighed::from_interleaved(&values, positions.len(), 5, 5, 0).map_err(not_ordered)?;
        let indices = self.triangles.as_flattened();
        let scale = simplify_scale(places).map_err(not_ordered)?;
        let target_error = (error / scale).min(NO_LIMIT);
        let mut workspace = Workspace::default();
        let mut best = (indices.to_vec(), 0.0);
        for way in ways {
            if best.0.len() <= 3 * most {
                break;
            }
            let simplified = match way.options() {
                Some(options) => {
                    let settings = SimplifySettings { target_index_count: 3 * most, target_error, options };
                    let weights = [WEIGHT; 5];
                    simplify_with_attributes(
                        indices,
                        places,
                        values,
                        &weights,
                        None,
                        settings,
                        &mut workspace,
                    )
                }
                None => simplify_sloppy(indices, places, None, 3 * most, target_error, &mut workspace),
            };
            let simplified = simplified.map_err(not_ordered)?;
            if (1..best.0.len()).contains(&simplified.indices.len()) {
                best = (simplified.indices.to_vec(), simplified.error);
            }
        }
        let (indices, error) = best;
        self.triangles = indices.as_chunks().0.to_vec();
        Ok(error * scale)
    }

    /// The vertices that triangles use, one after the other.
    fn corners(&self) -> impl Iterator<Item = &Vertex> + Clone {
        self.triangles.iter().flatten().map(|&index| &self.vertices[index as usize])
    }

    /// The vertices in integers, those that are equal as one, and the triangles that are left between them.
    fn pack(&self, grids: &Grids, attributes: Attributes) -> (Vec<Packed>, Vec<[u32; 3]>, Losses) {
        let mut losses = Losses::default();
        // Each vertex once, though six triangles may share it.
        let mut packed: Vec<Option<Packed>> = vec![None; self.vertices.len()];
        for &index in self.triangles.as_flattened() {
            packed[index as usize].get_or_insert_with(|| {
                let (packed, lost) = grids.pack(&self.vertices[index as usize], attributes);
                losses = losses.and(lost);
                packed
            });
        }
        let (mut of_packed, mut numbers, mut vertices) = (HashMap::new(), vec![None; packed.len()], vec![]);
        let mut number = |index: u32, packed: Packed| {
            *numbers[index as usize].get_or_insert_with(|| {
                *of_packed.entry(packed).or_insert_with(|| {
                    vertices.push(packed);
                    small(vertices.len() - 1)
                })
            })
        };
        let corners = self
            .triangles
            .iter()
            .map(|triangle| triangle.map(|index| (index, packed[index as usize].unwrap_or_default())));
        let areas = corners.filter(|corners| !is_flat(corners.map(|(_, packed)| packed.place)));
        let triangles = areas.map(|corners| corners.map(|(index, packed)| number(index, packed))).collect();
        (vertices, triangles, losses)
    }
}

/// A part's number, its mesh, and how far simplification has moved its surface.
type Simplified = (usize, Alone, f32);

/// The parts that have triangles.
///
/// All may be wrong by the same angle as seen from `eye`, the least that keeps the budget, in the first way that can.
/// If none can, each gets its share of what is left, the largest last: these make up for small ones that cannot do with
/// theirs. So does a part alone, whose share is all.
fn simplified(
    model: &Model,
    eye: [f32; 3],
    wish: &Wish,
    attributes: Attributes,
) -> Result<Vec<Simplified>, Error> {
    let parts = || model.parts.iter().enumerate().filter(|(_, part)| !part.triangles.is_empty());
    let alone = || parts().map(|(number, part)| (number, Alone::new(model, part), 0.0)).collect::<Vec<_>>();
    let total: usize = parts().map(|(_, part)| part.triangles.len()).sum();
    let Some(most) = wish.triangles.filter(|&most| most < total) else { return Ok(alone()) };
    let mut ways = &Way::ALL[1..];
    if parts().count() > 1 {
        ways = &Way::ALL;
        for way in [Way::Locked, Way::Free, Way::Permissive] {
            if let Some(found) = equally_wrong(&alone, eye, most, way, attributes)? {
                return Ok(found);
            }
        }
    }
    let mut meshes = alone();
    meshes.sort_by_key(|(_, mesh, _)| mesh.triangles.len());
    let (mut left, mut given) = (most, total);
    for (_, mesh, moved) in &mut meshes {
        let before = mesh.triangles.len();
        *moved = mesh.simplify((left * before / given).max(1), f32::INFINITY, ways, attributes)?;
        (left, given) = (left.saturating_sub(mesh.triangles.len()), given - before);
    }
    meshes.sort_by_key(|&(number, ..)| number);
    Ok(meshes)
}

/// The parts with at most so many triangles together, all simplified up to one part of their distance from `eye`;
/// `None` if none is enough.
fn equally_wrong(
    alone: &dyn Fn() -> Vec<Simplified>,
    eye: [f32; 3],
    most: usize,
    way: Way,
    attributes: Attributes,
) -> Result<Option<Vec<Simplified>>, Error> {
    let distance = |vertex: &Vertex| Vec3::from_array(vertex.position).distance(Vec3::from_array(eye));
    let parts = alone();
    let farthest = parts.iter().flat_map(|(_, mesh, _)| &mesh.vertices).map(distance).fold(0.0, f32::max);
    // A part around the eye is not without an error.
    let nearest =
        |mesh: &Alone| mesh.vertices.iter().map(distance).fold(farthest, f32::min).max(farthest / 64.0);
    let distances: Vec<f32> = parts.iter().map(|(_, mesh, _)| nearest(mesh)).collect();
    // A power of two of it. Triangles are about as one over the error, so between two of them a line of logarithms is
    // near the curve.
    let log = |count: usize| narrow(f64::from(small(count)).log2()) - narrow(f64::from(small(most)).log2());
    let total: usize = parts.iter().map(|(_, mesh, _)| mesh.triangles.len()).sum();
    let (mut lower, mut upper) = ((-24.0_f32, log(total)), (4.0_f32, 0.0));
    let mut found = None;
    let mut exponent = upper.0;
    for _ in 0..12 {
        let mut meshes = alone();
        for ((_, mesh, moved), distance) in meshes.iter_mut().zip(&distances) {
            *moved = mesh.simplify(LEAST, distance * exponent.exp2(), &[way], attributes)?;
        }
        let count = meshes.iter().map(|(_, mesh, _)| mesh.triangles.len()).sum::<usize>();
        if count <= most {
            (found, upper) = (Some(meshes), (exponent, log(count)));
        } else if found.is_none() {
            return Ok(None);
        } else {
            lower = (exponent, log(count));
        }
        // A fiftieth of the triangles, or a hundredth of the error.
        if (count <= most && 50 * (most - count) <= most) || upper.0 - lower.0 < 0.014 {
            break;
        }
        let share = (lower.1 / (lower.1 - upper.1)).clamp(0.1, 0.9);
        exponent = lower.0 + share * (upper.0 - lower.0);
    }
    Ok(found)
}

/// The asset of a model with these textures, of which each part has one or none.
pub(super) fn asset(
    (model, eye): (&Model, [f32; 3]),
    wish: &Wish,
    attributes: Attributes,
    textures: Vec<Texture>,
    of_parts: &[Option<usize>],
) -> Result<Asset, Error> {
    let alone = simplified(model, eye, wish, attributes)?;
    let unit = unit(alone.iter().flat_map(|(_, mesh, _)| mesh.corners()));
    let (mut pieces, mut lost_parts, mut losses) = (vec![], vec![], Losses::default());
    for (k, mesh, moved) in alone {
        let part = &model.parts[k];
        let grids = Grids::new(unit, mesh.corners(), attributes)?;
        let (vertices, triangles, lost) = mesh.pack(&grids, attributes);
        losses = losses.and(lost);
        if vertices.len() > MAX_VERTICES as usize {
            let found = format!("{} vertices of a part{}", vertices.len(), named(part));
            let error = Error::new(found, format!("at most {MAX_VERTICES}"));
            return Err(error.hint("alberti bake --triangles makes fewer"));
        }
        let before = transformed(&mesh.triangles, mesh.vertices.len())?;
        if triangles.is_empty() {
            lost_parts.push(k);
        } else {
            let color = crate::draw::color(part.diffuse);
            let texture = of_parts[k];
            let piece = ordered(k, (vertices, triangles), grids, wish.meshlets, (color, texture), before)?;
            pieces.push(Piece { moved, ..piece });
        }
    }
    if pieces.is_empty() {
        let area = |model: &Model, triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|index| Vec3::from_array(model.vertices[index as usize].position));
            (b - a).cross(c - a).length_squared() > 0.0
        };
        let mut triangles = model.parts.iter().flat_map(|part| &part.triangles);
        if !triangles.any(|triangle| area(model, triangle)) {
            return Err(Error::new("no triangle with an area", "some"));
        }
        let found = format!("no triangle with an area in steps of {}", number(unit));
        return Err(
            Error::new(found, "some").hint("leave out what lies far from it: the farthest is 32767 steps")
        );
    }
    Ok(Asset { attributes, unit, pieces, lost_parts, textures, losses })
}

/// Triangles in an order that suits a cache.
fn cached(triangles: &[[u32; 3]], vertices: usize) -> Result<Vec<[u32; 3]>, Error> {
    let ordered = optimize_vertex_cache(triangles.as_flattened(), vertices, &mut Workspace::default());
    Ok(ordered.map_err(not_ordered)?.as_chunks().0.to_vec())
}

/// The same of a few triangles, whose vertices have numbers of all the mesh: it takes as long as these are many.
fn cached_alone(triangles: &[[u32; 3]]) -> Result<Vec<[u32; 3]>, Error> {
    let mut used = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let own = |index: u32| small(used.binary_search(&index).unwrap_or_default());
    let alone: Vec<_> = triangles.iter().map(|triangle| triangle.map(own)).collect();
    let ordered = cached(&alone, used.len())?;
    Ok(ordered.into_iter().map(|triangle| triangle.map(|index| used[index as usize])).collect())
}

/// A piece with its triangles in the order of meshlets, or of a cache, and its vertices in the order of their use.
fn ordered(
    part: usize,
    (vertices, triangles): (Vec<Packed>, Vec<[u32; 3]>),
    grids: Grids,
    most: usize,
    (color, texture): (Rgba8, Option<usize>),
    before: f32,
) -> Result<Piece, Error> {
    // Meshlets grow from the first triangles that are left, in this order.
    let mut triangles = cached(&triangles, vertices.len())?;
    let mut ranges = vec![];
    if most > 0 {
        let places: Vec<_> = vertices.iter().map(|vertex| grids.place(vertex)).collect();
        let split = Split::new(&places, &triangles, most);
        triangles.clear();
        for range in &split.meshlets {
            triangles.extend(cached_alone(&split.triangles[range.start as usize..range.end as usize])?);
        }
        ranges = split.meshlets;
    }
    let mut numbers = vec![None; vertices.len()];
    let mut used = vec![];
    let mut number = |index: u32| {
        *numbers[index as usize].get_or_insert_with(|| {
            used.push(vertices[index as usize]);
            u16::try_from(used.len() - 1).unwrap_or(u16::MAX)
        })
    };
    let triangles: Vec<[u16; 3]> = triangles.into_iter().map(|triangle| triangle.map(&mut number)).collect();
    let stage = |vertex: &Packed| IntegerVertex::<()> { place: vertex.place, components: () };
    let mesh = IntegerMesh::new(&used, &triangles, grids.unit, stage);
    let ball = Ball::of(&mesh);
    let meshlets = ranges.into_iter().map(|range| Meshlet::new(&mesh, &ball, range)).collect();
    let wide: Vec<[u32; 3]> = triangles.iter().map(|triangle| triangle.map(u32::from)).collect();
    let order = Order { before, after: transformed(&wide, used.len())? };
    Ok(Piece { moved: 0.0, part, grids, vertices: used, triangles, meshlets, ball, color, texture, order })
}

/// Transformed vertices a triangle, with a small cache.
fn transformed(triangles: &[[u32; 3]], vertices: usize) -> Result<f32, Error> {
    let indices = triangles.as_flattened();
    let found = analyze_vertex_cache(indices, vertices, CACHE, 0, 0, &mut Workspace::default());
    Ok(found.map_err(not_ordered)?.acmr)
}

fn not_ordered(error: meshoptimizer_rs::Error) -> Error {
    Error::new(format!("a mesh that cannot be ordered ({error})"), "triangles with finite places")
}

/// Whether the triangle between these places has no area: they are on one line.
fn is_flat(places: [[i16; 3]; 3]) -> bool {
    let [a, b, c] = places.map(|place| place.map(i64::from));
    let [ab, ac] = [b, c].map(|end| [0, 1, 2].map(|axis| end[axis] - a[axis]));
    // Sides have 17 bits, products 33.
    (0..3).all(|axis| {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        ab[j] * ac[k] == ab[k] * ac[j]
    })
}

/// A number that is below that of a model's corners, of which there are fewer than 2^32.
fn small(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_on_a_line_have_no_area() {
        assert!(is_flat([[0, 0, 0], [1, 2, 3], [-2, -4, -6]]));
        assert!(is_flat([[-32767; 3], [32767; 3], [0; 3]]));
        assert!(is_flat([[7, 8, 9], [7, 8, 9], [1, 0, 0]]));
        assert!(!is_flat([[0, 0, 0], [1, 2, 3], [-2, -4, -5]]));
        assert!(!is_flat([[-32767, -32767, 0], [32767, 32767, 0], [32767, 32766, 0]]));
    }
}
