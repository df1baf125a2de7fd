//! The vertices that some triangles use: from these a part of a larger model is drawn by as many threads as a whole
//! one.

use crate::scene::Vertex;
use std::borrow::Cow;

/// Triangles, and the vertices that they are made of.
pub(super) struct Used<'a> {
    pub(super) vertices: Cow<'a, [Vertex]>,
    pub(super) triangles: Cow<'a, [[u32; 3]]>,
}

impl<'a> Used<'a> {
    /// Of a model with about as many triangles as vertices, or more, these as they are. Otherwise the vertices that are
    /// used, in the order in which they are, and the triangles by their numbers there.
    pub(super) fn of(vertices: &'a [Vertex], triangles: &'a [[u32; 3]]) -> Self {
        if vertices.len() <= triangles.len() {
            return Self { vertices: vertices.into(), triangles: triangles.into() };
        }
        let indices = triangles.as_flattened();
        let first = indices.iter().copied().min().unwrap_or(0);
        let last = indices.iter().copied().max().unwrap_or(0);
        let mut numbers = vec![None; (last - first) as usize + 1];
        let mut used = Vec::new();
        let mut number = |index: u32| {
            *numbers[(index - first) as usize].get_or_insert_with(|| {
                // One that the model has not is none here either.
                let vertex = vertices.get(index as usize);
                let number = vertex.and_then(|_| u32::try_from(used.len()).ok());
                used.extend(vertex);
                number.unwrap_or(u32::MAX)
            })
        };
        let triangles: Vec<_> = triangles.iter().map(|triangle| triangle.map(&mut number)).collect();
        Self { vertices: used.into(), triangles: triangles.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_keeps_its_corners_and_no_others() {
        let at = |x: u8| Vertex { position: [x.into(), 0.0, 0.0], ..Vertex::default() };
        let vertices: Vec<_> = (0..20).map(at).collect();
        let triangles = [[7, 3, 9], [9, 3, 11], [2, 25, 3]];
        let used = Used::of(&vertices, &triangles);
        assert_eq!(used.vertices.len(), 5);
        let corner = |index: u32| used.vertices.get(index as usize);
        for (found, expected) in used.triangles.iter().zip(triangles) {
            assert_eq!(found.map(corner), expected.map(|index| vertices.get(index as usize)));
        }
        let whole = Used::of(&vertices[..3], &triangles);
        assert!(matches!((whole.vertices, whole.triangles), (Cow::Borrowed(_), Cow::Borrowed(_))));
        let nothing = Used::of(&vertices, &[]);
        assert!(nothing.vertices.is_empty() && nothing.triangles.is_empty());
    }
}
