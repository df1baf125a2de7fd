//! Two-sided light: surfaces that are seen from behind are lit as if they faced the viewer.
//!
//! The triangle decides, not the normal at a pixel: along the outline of a round surface, normals that are interpolated
//! point away from the viewer although the front is seen. The front is the side to which the normals of the three
//! vertices point, also where a file winds its triangles the other way.

use crate::options::{Cull, Projection, RenderOptions};
use crate::scene::normals::{cross, dot, sub};
use crate::scene::{Camera, Vertex};
use std::borrow::Cow;

/// The viewer of a picture: a point, or for a parallel projection a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewpoint {
    place: [f64; 3],
    /// 1 for a point, 0 for a direction.
    weight: f64,
}

impl Viewpoint {
    /// That of a picture, if it has two-sided light and shows surfaces from behind.
    pub(super) fn of(camera: &Camera, options: &RenderOptions) -> Option<Self> {
        let shown = options.light.two_sided && options.shading.is_lit() && options.cull != Cull::Back;
        let [eye, target] = [camera.eye, camera.target].map(|point| point.map(f64::from));
        shown.then_some(match options.projection {
            Projection::Perspective => Self { place: eye, weight: 1.0 },
            Projection::Parallel { .. } => Self { place: sub(eye, target), weight: 0.0 },
        })
    }

    /// Whether it sees a triangle with these vertices from behind.
    pub(super) fn is_behind(self, [a, b, c]: [&Vertex; 3]) -> bool {
        let place = |v: &Vertex| v.position.map(f64::from);
        let across = cross(sub(place(b), place(a)), sub(place(c), place(a)));
        let to_viewer = [0, 1, 2].map(|k| self.place[k] - self.weight * place(a)[k]);
        let side = |vector: [f64; 3]| dot(across, vector);
        let normals = [0, 1, 2].map(|k| [a, b, c].iter().map(|v| f64::from(v.normal[k])).sum::<f64>());
        if side(normals) < 0.0 { side(to_viewer) > 0.0 } else { side(to_viewer) < 0.0 }
    }

    /// The same triangles, where those seen from behind have vertices of their own, with their normals turned around.
    pub(super) fn turned<'a>(
        self,
        vertices: Cow<'a, [Vertex]>,
        triangles: Cow<'a, [[u32; 3]]>,
    ) -> (Cow<'a, [Vertex]>, Cow<'a, [[u32; 3]]>) {
        let behind = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|index| vertices.get(index as usize));
            matches!((a, b, c), (Some(a), Some(b), Some(c)) if self.is_behind([a, b, c]))
        };
        let Some(first) = triangles.iter().position(behind) else { return (vertices, triangles) };
        let mut all = vertices.to_vec();
        let mut numbers = vec![None; vertices.len()];
        let mut turned = |index: u32| {
            let Some(slot) = numbers.get_mut(index as usize) else { return index };
            *slot.get_or_insert_with(|| {
                let number = u32::try_from(all.len()).unwrap_or(u32::MAX);
                all.push(turn(&vertices[index as usize]));
                number
            })
        };
        let mut own = triangles.to_vec();
        for triangle in own[first..].iter_mut().filter(|triangle| behind(triangle)) {
            *triangle = triangle.map(&mut turned);
        }
        (all.into(), own.into())
    }
}

/// A vertex seen from behind. The directions of growing u and v stay.
pub(super) fn turn(vertex: &Vertex) -> Vertex {
    let [x, y, z, handedness] = vertex.tangent;
    Vertex { normal: vertex.normal.map(|n| -n), tangent: [x, y, z, -handedness], ..*vertex }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(position: [f32; 3], normal: [f32; 3]) -> Vertex {
        Vertex { position, normal, ..Vertex::default() }
    }

    /// A triangle in the plane z = 0, wound for a viewer at positive z.
    fn triangle(normals: [[f32; 3]; 3]) -> [Vertex; 3] {
        let [a, b, c] = normals;
        [corner([0.0; 3], a), corner([1.0, 0.0, 0.0], b), corner([0.0, 1.0, 0.0], c)]
    }

    fn seen(place: [f64; 3], weight: f64, corners: &[Vertex; 3]) -> bool {
        Viewpoint { place, weight }.is_behind(corners.each_ref())
    }

    #[test]
    fn the_side_of_the_normals_is_the_front() {
        let (up, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
        for (normal, from, behind) in
            [(up, 2.0, false), (up, -2.0, true), (down, 2.0, true), (down, -2.0, false)]
        {
            let corners = triangle([normal; 3]);
            assert_eq!(seen([5.0, 3.0, from], 1.0, &corners), behind);
            assert_eq!(seen([0.0, 0.0, from], 0.0, &corners), behind);
        }
        // One normal that points away from the viewer is none of the triangle's.
        let round = triangle([up, [0.8, 0.0, 0.6], [0.96, 0.0, -0.28]]);
        assert!(!seen([-9.0, 0.0, 0.5], 1.0, &round));
        // Without normals the winding decides.
        let bare = triangle([[0.0; 3]; 3]);
        assert!(!seen([0.0, 0.0, 1.0], 1.0, &bare) && seen([0.0, 0.0, -1.0], 1.0, &bare));
    }

    #[test]
    fn only_what_is_seen_from_behind_gets_vertices_of_its_own() {
        let mut vertices = triangle([[0.0, 0.0, 1.0]; 3]).to_vec();
        vertices.push(corner([1.0, 0.0, -1.0], [-0.6, 0.0, -0.8]));
        let triangles = [[0, 1, 2], [1, 0, 3], [0, 1, 9]];
        let front = Viewpoint { place: [0.2, -9.0, 0.4], weight: 1.0 };
        let (all, own) = front.turned((&vertices[..]).into(), (&triangles[..]).into());
        assert_eq!((all.len(), own[0], own[2]), (vertices.len(), [0, 1, 2], [0, 1, 9]));
        let back = Viewpoint { place: [0.2, -9.0, -0.4], weight: 1.0 };
        let (all, own) = back.turned((&vertices[..]).into(), (&triangles[..]).into());
        assert_eq!((own[0], own[1], own[2]), ([4, 5, 6], [1, 0, 3], [0, 1, 9]));
        assert_eq!(all[..4], vertices[..]);
        assert_eq!(all[4].normal, [0.0, 0.0, -1.0]);
    }
}
