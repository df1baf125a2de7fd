//! Meshes of files, as the pipeline takes them.

use super::attributes::{Attribute, Vertices};
use super::sections::{half, word};
use crate::geometry::{Geometry, IntegerVertex};
use crate::meshlets::{Ball, Meshlet};
use alberti_math::{Object, Point3};
use core::fmt;
use core::marker::PhantomData;

/// The mesh of a part of a file, read in place: as a [`Meshlets`](crate::Meshlets) of an
/// [`IntegerMesh`](crate::IntegerMesh).
///
/// # Cost
/// That of an `IntegerMesh`, and where numbers may not be loaded from any address, that of making them of bytes. A
/// normal takes a square root and a division of integers.
pub struct BakedMesh<'a, A> {
    pub(super) vertices: Vertices<'a>,
    pub(super) triangles: &'a [[u8; 6]],
    pub(super) meshlets: &'a [[u8; 28]],
    pub(super) ball: Ball,
    pub(super) unit: f32,
    pub(super) attributes: PhantomData<A>,
}

impl<A: Attribute> Geometry for BakedMesh<'_, A> {
    type Varying = A::Varying;

    #[inline]
    fn triangles(&self) -> usize {
        self.triangles.len()
    }

    #[inline]
    fn vertices(&self) -> usize {
        self.vertices.places.len()
    }

    #[inline]
    fn triangle(&self, number: usize) -> Option<[usize; 3]> {
        let triangle = self.triangles.get(number)?;
        let index = |at: usize| usize::from(half(triangle, at));
        Some([index(0), index(2), index(4)])
    }

    #[inline]
    fn vertex(&self, number: usize) -> Option<(Point3<Object>, A::Varying)> {
        self.integers(number).map(|vertex| vertex.to_floats(self.unit))
    }

    const INTEGERS: bool = true;

    #[inline]
    fn unit(&self) -> f32 {
        self.unit
    }

    #[inline]
    fn integers(&self, number: usize) -> Option<IntegerVertex<A::Varying>> {
        let place = self.vertices.place(number)?;
        Some(IntegerVertex { place, components: A::components(&self.vertices, number) })
    }

    const MESHLETS: bool = true;

    #[inline]
    fn meshlet(&self, number: usize) -> Option<Meshlet> {
        let bytes = self.meshlets.get(number)?;
        let place = |at: usize| [0, 2, 4].map(|axis| half(bytes, at + axis).cast_signed());
        Some(Meshlet {
            triangles: [word(bytes, 0), word(bytes, 4)],
            center: place(8),
            radius: half(bytes, 14),
            axis: place(16),
            squared_sine: half(bytes, 22),
            depths: [24, 26].map(|at| half(bytes, at).cast_signed()),
        })
    }

    #[inline]
    fn ball(&self) -> Ball {
        self.ball
    }
}

impl<A> Clone for BakedMesh<'_, A> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<A> Copy for BakedMesh<'_, A> {}

impl<A> fmt::Debug for BakedMesh<'_, A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BakedMesh")
            .field("vertices", &self.vertices.places.len())
            .field("triangles", &self.triangles.len())
            .finish_non_exhaustive()
    }
}
