//! Displacement maps on meshes: triangles divided until each texel has its vertex, and vertices moved along their
//! normals.

use std::collections::HashMap;

use alberti::glam::Vec3;
use alberti::math::interpolate;
use alberti::texture::surface::Subdivision;

use crate::error::{Error, Warnings};
use crate::load::images::Images;
use crate::options::Wrap;
use crate::scene::normals::{cross, narrow, normalize, sub};
use crate::scene::{HeightImage, HeightMap, Model, Part, Relief, Vertex};

/// The most vertices that dividing makes.
pub(crate) const MAX_VERTICES: u64 = 1 << 20;

/// Divides all triangles of the parts that have a displacement map, each into equally many, and moves their vertices.
///
/// Vertices at one place move to one place, by the mean of their heights along the mean of their normals. So neither a
/// seam in the texture nor a crease in the surface tears open. Normals turn as those of the triangles do, once for
/// vertices that had the same before, so creases stay, and smooth surfaces stay smooth.
///
/// Where that takes more than [`MAX_VERTICES`] vertices, texels go without, with a warning.
pub(crate) fn displace(model: &mut Model, images: &Images, wrap: Wrap, warnings: &mut Warnings) {
    let is_displaced = |part: &Part| map_of(part).is_some();
    let Some(division) = division(model, images, warnings) else { return };
    let mut fine: Vec<Vertex> = Vec::new();
    let mut heights: Vec<f64> = Vec::new();
    for part in model.parts.iter_mut().filter(|part| is_displaced(part)) {
        let Some(map) = map_of(part) else { continue };
        let Some(image) = images.height_image(map.heights) else { continue };
        let wrap = map.wrap.unwrap_or(wrap);
        let mut known: HashMap<[u32; 11], u32> = HashMap::new();
        let mut triangles = Vec::with_capacity(part.triangles.len() * division.triangles());
        for triangle in &part.triangles {
            let corners = triangle.map(|i| model.vertices[i as usize]);
            let count = u32::try_from(division.vertices()).unwrap_or(u32::MAX);
            let indices: Vec<u32> = (0..count)
                .map(|k| {
                    let vertex = between(division.weights(k), corners);
                    *known.entry(key(&vertex)).or_insert_with(|| {
                        let share = height_at(image, wrap, vertex.uv);
                        let [low, high] = map.range.map(f64::from);
                        heights.push(low + (high - low) * share);
                        fine.push(vertex);
                        u32::try_from(fine.len() - 1).unwrap_or(u32::MAX)
                    })
                })
                .collect();
            let count = u32::try_from(division.triangles()).unwrap_or(u32::MAX);
            triangles.extend((0..count).map(|t| division.triangle(t).map(|k| indices[k as usize])));
        }
        part.triangles = triangles;
    }
    let groups = Groups::of(&fine);
    let triangles = || model.parts.iter().filter(|part| is_displaced(part)).flat_map(|part| &part.triangles);
    let flat = groups.normals(&fine, triangles());
    groups.displace(&mut fine, &heights);
    let displaced = groups.normals(&fine, triangles());
    groups.bend_normals(&mut fine, &flat, &displaced);
    // The vertices of the other parts stay in front.
    let first = keep_used(model, is_displaced);
    model.vertices.append(&mut fine);
    for part in model.parts.iter_mut().filter(|part| is_displaced(part)) {
        part.triangles.iter_mut().flatten().for_each(|index| *index += first);
    }
}

fn map_of(part: &Part) -> Option<HeightMap> {
    part.detail.height.filter(|height| height.relief == Relief::Displacement)
}

/// The division that is as fine as the finest texture asks for, or as is affordable.
fn division(model: &Model, images: &Images, warnings: &mut Warnings) -> Option<Subdivision> {
    let (mut wanted, mut triangles) = (1, 0_u64);
    for part in &model.parts {
        let Some(map) = map_of(part) else { continue };
        let [width, height] = images.height_image(map.heights).map(|i| [i.width, i.height])?;
        triangles += part.triangles.len() as u64;
        for triangle in &part.triangles {
            let [a, b, c] = triangle.map(|i| model.vertices[i as usize].uv.map(f64::from));
            let texels = [(a, b), (b, c), (c, a)].into_iter().fold(0.0_f64, |most, (a, b)| {
                let [du, dv] =
                    [(b[0] - a[0]).abs() * f64::from(width), (b[1] - a[1]).abs() * f64::from(height)];
                most.max(du).max(dv)
            });
            // Coordinates are rounded.
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "saturation is wanted"
            )]
            let parts = (texels - 1e-3).ceil() as u64;
            wanted = wanted.max(parts);
        }
    }
    // Each of n² triangles a triangle has half a vertex of its own, nearly.
    let affordable = (2 * MAX_VERTICES / triangles.max(1)).isqrt().clamp(1, Subdivision::MAX_PARTS.into());
    if wanted > affordable {
        let found = format!("{wanted} texels of heights along an edge of a triangle");
        let expected = format!("at most {affordable} for {triangles} triangles");
        warnings.push(Error::new(found, expected).hint("the relief is coarser than its map"));
    }
    Some(Subdivision::new(u32::try_from(wanted.min(affordable)).unwrap_or(1)))
}

fn between(weights: [f32; 3], corners: [Vertex; 3]) -> Vertex {
    let mean = |of: fn(&Vertex) -> [f32; 3]| {
        interpolate(weights, corners.each_ref().map(|v| Vec3::from_array(of(v)))).to_array()
    };
    let [u, v, _] = mean(|v| [v.uv[0], v.uv[1], 0.0]);
    Vertex {
        position: mean(|v| v.position),
        normal: mean(|v| v.normal),
        uv: [u, v],
        color: mean(|v| v.color),
        tangent: [0.0; 4],
    }
}

/// Adding 0 makes -0 and 0 the same.
fn bits<const N: usize>(values: [f32; N]) -> [u32; N] {
    values.map(|x| (x + 0.0).to_bits())
}

fn key(v: &Vertex) -> [u32; 11] {
    let ([a, b, c], [d, e, f], [g, h], [i, j, k]) =
        (bits(v.position), bits(v.normal), bits(v.uv), bits(v.color));
    [a, b, c, d, e, f, g, h, i, j, k]
}

/// The height from 0 to 1: a weighted mean of the four texels around the point.
fn height_at(image: &HeightImage, wrap: Wrap, [u, v]: [f32; 2]) -> f64 {
    let taps = |t: f64, count: u32| {
        let at = t * f64::from(count) - 0.5;
        let first = at.floor();
        #[expect(clippy::cast_possible_truncation, reason = "saturation is wanted")]
        let index = |k: f64| wrapped(k as i64, count, wrap);
        (at - first, [index(first), index(first + 1.0)])
    };
    let ((x, columns), (y, rows)) = (taps(u.into(), image.width), taps(1.0 - f64::from(v), image.height));
    let texel = |row: usize, column: usize| {
        f64::from(image.heights.get(row * image.width as usize + column).copied().unwrap_or_default())
    };
    let [above, below] = rows.map(|row| texel(row, columns[0]) * (1.0 - x) + texel(row, columns[1]) * x);
    (above * (1.0 - y) + below * y) / 65535.0
}

fn wrapped(index: i64, count: u32, wrap: Wrap) -> usize {
    let count = i64::from(count);
    let found = match wrap {
        Wrap::Repeat => index.rem_euclid(count),
        Wrap::Clamp => index.clamp(0, count - 1),
        Wrap::Mirror => {
            let at = index.rem_euclid(2 * count);
            at.min(2 * count - 1 - at)
        }
    };
    usize::try_from(found).unwrap_or_default()
}

/// The vertices of one place, and those of one normal among them.
struct Groups {
    place: Vec<usize>,
    smooth: Vec<usize>,
    places: usize,
    smooths: usize,
}

impl Groups {
    fn of(vertices: &[Vertex]) -> Self {
        let (mut places, mut smooths) = (HashMap::new(), HashMap::new());
        let (mut place, mut smooth) = (Vec::new(), Vec::new());
        for vertex in vertices {
            let (at, normal) = (bits(vertex.position), bits(vertex.normal));
            let next = places.len();
            place.push(*places.entry(at).or_insert(next));
            let next = smooths.len();
            smooth.push(*smooths.entry((at, normal)).or_insert(next));
        }
        Self { place, smooth, places: places.len(), smooths: smooths.len() }
    }

    fn displace(&self, vertices: &mut [Vertex], heights: &[f64]) {
        let mut sums = vec![([0.0; 3], 0.0, 0.0); self.places];
        for ((vertex, height), &at) in vertices.iter().zip(heights).zip(&self.place) {
            let normal = normalize(vertex.normal.map(f64::from)).unwrap_or([0.0; 3]);
            let (sum, total, count) = &mut sums[at];
            *sum = [0, 1, 2].map(|axis| sum[axis] + normal[axis]);
            *total += height;
            *count += 1.0;
        }
        for (vertex, &at) in vertices.iter_mut().zip(&self.place) {
            let (normals, total, count) = sums[at];
            let normal = normalize(normals).unwrap_or([0.0; 3]);
            let height = total / count;
            let position = vertex.position.map(f64::from);
            vertex.position = [0, 1, 2].map(|axis| narrow(position[axis] + normal[axis] * height));
        }
    }

    /// The mean of the triangles' normals, weighted by area, for each normal that vertices have; `None` where there is
    /// no area.
    fn normals<'t>(
        &self,
        vertices: &[Vertex],
        triangles: impl Iterator<Item = &'t [u32; 3]>,
    ) -> Vec<Option<[f64; 3]>> {
        let mut sums = vec![[0.0; 3]; self.smooths];
        for triangle in triangles {
            let [a, b, c] = triangle.map(|i| vertices[i as usize].position.map(f64::from));
            let across = cross(sub(b, a), sub(c, a));
            for &i in triangle {
                let sum = &mut sums[self.smooth[i as usize]];
                *sum = [0, 1, 2].map(|axis| sum[axis] + across[axis]);
            }
        }
        sums.into_iter().map(normalize).collect()
    }

    /// Bends normals as those of the triangles have turned, so that a model whose few triangles look smooth still does.
    fn bend_normals(
        &self,
        vertices: &mut [Vertex],
        flat: &[Option<[f64; 3]>],
        displaced: &[Option<[f64; 3]>],
    ) {
        for (vertex, &at) in vertices.iter_mut().zip(&self.smooth) {
            let own = normalize(vertex.normal.map(f64::from)).unwrap_or([0.0, 0.0, 1.0]);
            let turned = flat[at].zip(displaced[at]).map(|(flat, displaced)| sub(displaced, flat));
            let bent = turned.and_then(|turned| normalize([0, 1, 2].map(|axis| own[axis] + turned[axis])));
            vertex.normal = bent.unwrap_or(own).map(narrow);
        }
    }
}

/// Drops the vertices that only displaced parts had, and tells how many there are left.
fn keep_used(model: &mut Model, is_displaced: impl Fn(&Part) -> bool) -> u32 {
    let mut index = vec![None; model.vertices.len()];
    let mut kept = Vec::new();
    for part in model.parts.iter_mut().filter(|part| !is_displaced(part)) {
        for i in part.triangles.iter_mut().flatten() {
            let vertex = model.vertices[*i as usize];
            *i = *index[*i as usize].get_or_insert_with(|| {
                kept.push(vertex);
                u32::try_from(kept.len() - 1).unwrap_or(u32::MAX)
            });
        }
    }
    model.vertices = kept;
    u32::try_from(model.vertices.len()).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests;
