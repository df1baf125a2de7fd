//! Which triangle is seen at each pixel: the depth test, with shading put off until all is known.

use crate::image::Image;
use crate::scene::{Cull, Scene};
use crate::shading::shade;
use crate::vec3::{Vec3, blend};

/// The nearest hit of every pixel so far.
#[derive(Debug)]
pub(crate) struct Visibility {
    width: usize,
    depth: Vec<f64>,
    hits: Vec<Option<Hit>>,
}

/// A point of a triangle.
#[derive(Clone, Copy, Debug)]
struct Hit {
    part: u32,
    triangle: u32,
    weights: Vec3,
}

/// A point that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The number of its triangle, counted over all parts in drawing order.
    pub triangle: u32,
    /// The texture coordinates there.
    pub uv: [f64; 2],
}

/// The place of a triangle in a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) part: u32,
    pub(crate) triangle: u32,
}

impl Visibility {
    pub(crate) fn new(scene: &Scene<'_>) -> Self {
        let pixels = scene.width as usize * scene.height as usize;
        Self { width: scene.width as usize, depth: vec![f64::INFINITY; pixels], hits: vec![None; pixels] }
    }

    /// Offers a point at the distance `z`: the nearest one wins, and of equals the first one.
    pub(crate) fn offer(&mut self, [x, y]: [usize; 2], z: f64, place: Place, weights: impl FnOnce() -> Vec3) {
        let index = y * self.width + x;
        if z < self.depth[index] {
            self.depth[index] = z;
            self.hits[index] = Some(Hit { part: place.part, triangle: place.triangle, weights: weights() });
        }
    }

    /// The picture.
    pub(crate) fn resolve(self, scene: &Scene<'_>) -> Image {
        let color = |hit: &Option<Hit>| {
            let [r, g, b] = hit.map_or(scene.background, |hit| {
                let part = &scene.parts[hit.part as usize];
                shade(scene, part, hit.triangle as usize, hit.weights)
            });
            [r, g, b, 255]
        };
        Image {
            width: scene.width,
            height: scene.height,
            pixels: self.hits.iter().map(color).collect(),
            covered: self.hits.iter().map(Option::is_some).collect(),
            depth: self.depth,
        }
    }

    /// The point that is seen at each pixel.
    pub(crate) fn points(self, scene: &Scene<'_>) -> Vec<Option<Seen>> {
        let mut first = vec![0];
        first.extend(scene.parts.iter().scan(0, |sum, part| {
            *sum += part.triangles.len() as u32;
            Some(*sum)
        }));
        let point = |hit: Hit| {
            let vertices = scene.parts[hit.part as usize].triangles[hit.triangle as usize];
            let uvs = vertices.map(|i| {
                let [u, v] = scene.vertices[i as usize].uv;
                [u, v, 0.0]
            });
            let [u, v, _] = blend(hit.weights, uvs);
            Seen { triangle: first[hit.part as usize] + hit.triangle, uv: [u, v] }
        };
        self.hits.into_iter().map(|hit| hit.map(point)).collect()
    }
}

/// All triangles of a scene in drawing order, with their vertices' positions in the world.
pub(crate) fn triangles<'a>(scene: &Scene<'a>) -> impl Iterator<Item = (Place, [Vec3; 3])> + 'a {
    let vertices = scene.vertices;
    scene.parts.iter().enumerate().flat_map(move |(part, p)| {
        p.triangles.iter().enumerate().map(move |(triangle, tri)| {
            let place = Place { part: part as u32, triangle: triangle as u32 };
            (place, tri.map(|i| vertices[i as usize].position))
        })
    })
}

/// Whether a face is dropped, given a number that is positive for counter-clockwise ones as seen.
pub(crate) fn culled(cull: Cull, counter_clockwise: f64) -> bool {
    match cull {
        Cull::Back => counter_clockwise < 0.0,
        Cull::Front => counter_clockwise > 0.0,
        Cull::None => false,
    }
}

/// The indices below `size` of the pixels whose centres lie between `low` and `high`; all of them when in doubt.
pub(crate) fn pixels_between(low: f64, high: f64, size: u32) -> std::ops::Range<usize> {
    if !(low.is_finite() && high.is_finite()) {
        return 0..size as usize;
    }
    let size = f64::from(size);
    let first = (low - 0.5).ceil().clamp(0.0, size);
    let end = ((high - 0.5).floor() + 1.0).clamp(first, size);
    first as usize..end as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixel_ranges_hold_the_centres() {
        assert_eq!(pixels_between(0.5, 2.5, 10), 0..3);
        assert_eq!(pixels_between(0.51, 2.49, 10), 1..2);
        assert_eq!(pixels_between(-7.0, 70.0, 10), 0..10);
        assert!(pixels_between(-7.0, -3.0, 10).is_empty());
        assert!(pixels_between(30.0, 40.0, 10).is_empty());
        assert_eq!(pixels_between(f64::NAN, 1.0, 10), 0..10);
    }

    #[test]
    fn culling_follows_the_side_that_is_seen() {
        assert!(culled(Cull::Back, -1.0) && !culled(Cull::Back, 1.0));
        assert!(culled(Cull::Front, 1.0) && !culled(Cull::Front, -1.0));
        assert!(!culled(Cull::None, 1.0) && !culled(Cull::None, -1.0));
    }
}
