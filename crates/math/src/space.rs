//! Points and vectors that know which space they are in.
//!
//! A point is a place, a vector a displacement. The difference of two points is a vector, a point plus a vector is a
//! point, and two points cannot be added. The space is a type parameter without size, so that an eye-space point cannot
//! be handed to code that wants an object-space one.

use crate::varying::{Mode, Varying};
use core::fmt;
use core::marker::PhantomData;
use core::ops::{Add, Mul, Neg, Sub};
use glam::{Vec2, Vec3};

/// A name for a space: a type without values, such as [`World`], or one of yours.
pub trait Space: Copy + PartialEq + fmt::Debug + 'static {}

impl Space for Object {}
impl Space for World {}
impl Space for Eye {}
impl Space for Cube {}

/// The space a model is described in: right-handed, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Object {}

/// The space a scene is assembled in: right-handed, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum World {}

/// The observer's space: x right, y up, z forward and positive in front of the eye (left-handed, therefore).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eye {}

/// The space after perspective with depth: the pyramid's frustum has become the box [-1, 1] x [-1, 1] x [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cube {}

/// A place in space `S`, with coordinates `V`.
///
/// Two places have no sum; a place and a displacement have:
///
/// ```compile_fail,E0308
/// use alberti_math::{Point3, World, glam::Vec3};
///
/// let p = Point3::<World>::new(Vec3::ONE);
/// let sum = p + p;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "bytemuck", transparent(V), zeroable(bound = "V: bytemuck::Zeroable"))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
#[cfg_attr(feature = "serde", serde(bound(serialize = "V: serde::Serialize")))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "V: serde::Deserialize<'de>")))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "arbitrary", arbitrary(bound = "V: arbitrary::Arbitrary<'arbitrary>, S: Space"))]
#[repr(transparent)]
pub struct Point<V, S: Space> {
    /// The coordinates with respect to the origin and axes of `S`.
    pub coords: V,
    #[cfg_attr(feature = "serde", serde(skip))]
    space: PhantomData<S>,
}

/// A displacement in space `S`, with components `V`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "bytemuck", transparent(V), zeroable(bound = "V: bytemuck::Zeroable"))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
#[cfg_attr(feature = "serde", serde(bound(serialize = "V: serde::Serialize")))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "V: serde::Deserialize<'de>")))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "arbitrary", arbitrary(bound = "V: arbitrary::Arbitrary<'arbitrary>, S: Space"))]
#[repr(transparent)]
pub struct Vector<V, S: Space> {
    /// The components along the axes of `S`.
    pub coords: V,
    #[cfg_attr(feature = "serde", serde(skip))]
    space: PhantomData<S>,
}

/// A place in the plane.
pub type Point2<S> = Point<Vec2, S>;
/// A place in space.
pub type Point3<S> = Point<Vec3, S>;
/// A displacement in the plane.
pub type Vector2<S> = Vector<Vec2, S>;
/// A displacement in space.
pub type Vector3<S> = Vector<Vec3, S>;

logged! {
    [S: Space] Point2<S>: "Point2({})", |point| point.coords.to_array();
    [S: Space] Point3<S>: "Point3({})", |point| point.coords.to_array();
    [S: Space] Vector2<S>: "Vector2({})", |vector| vector.coords.to_array();
    [S: Space] Vector3<S>: "Vector3({})", |vector| vector.coords.to_array();
}

impl<V, S: Space> Point<V, S> {
    /// The point with these coordinates.
    #[must_use]
    pub const fn new(coords: V) -> Self {
        Self { coords, space: PhantomData }
    }
}

impl<V, S: Space> Vector<V, S> {
    /// The vector with these components.
    #[must_use]
    pub const fn new(coords: V) -> Self {
        Self { coords, space: PhantomData }
    }
}

/// The point with these coordinates, in the space that is asked for.
impl<S: Space> From<Vec3> for Point3<S> {
    #[inline]
    fn from(coords: Vec3) -> Self {
        Self::new(coords)
    }
}

/// The vector with these components, in the space that is asked for.
impl<S: Space> From<Vec3> for Vector3<S> {
    #[inline]
    fn from(coords: Vec3) -> Self {
        Self::new(coords)
    }
}

impl<V: Sub<Output = V>, S: Space> Sub for Point<V, S> {
    type Output = Vector<V, S>;
    fn sub(self, other: Self) -> Self::Output {
        Vector::new(self.coords - other.coords)
    }
}

impl<V: Add<Output = V>, S: Space> Add<Vector<V, S>> for Point<V, S> {
    type Output = Self;
    fn add(self, by: Vector<V, S>) -> Self {
        Self::new(self.coords + by.coords)
    }
}

impl<V: Sub<Output = V>, S: Space> Sub<Vector<V, S>> for Point<V, S> {
    type Output = Self;
    fn sub(self, by: Vector<V, S>) -> Self {
        Self::new(self.coords - by.coords)
    }
}

impl<V: Add<Output = V>, S: Space> Add for Vector<V, S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.coords + other.coords)
    }
}

impl<V: Sub<Output = V>, S: Space> Sub for Vector<V, S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.coords - other.coords)
    }
}

impl<V: Mul<f32, Output = V>, S: Space> Mul<f32> for Vector<V, S> {
    type Output = Self;
    fn mul(self, by: f32) -> Self {
        Self::new(self.coords * by)
    }
}

impl<V: Neg<Output = V>, S: Space> Neg for Vector<V, S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.coords)
    }
}

macro_rules! varyings {
    ($($name:ident),*) => {$(
        impl<V: Varying, S: Space> Varying for $name<V, S> {
            type Of<T: Copy> = V::Of<T>;
            const ZEROS: V::Of<u32> = V::ZEROS;

            #[inline(always)]
            fn gather<const N: usize>(values: [Self; N]) -> V::Of<[f32; N]> {
                V::gather(values.map(|value| value.coords))
            }

            #[inline(always)]
            fn map_by_mode<T: Copy, U: Copy>(bundle: &V::Of<T>, f: &impl Fn(Mode, T) -> U) -> V::Of<U> {
                V::map_by_mode(bundle, f)
            }

            #[inline(always)]
            fn zip<T: Copy, U: Copy>(first: &V::Of<T>, second: &V::Of<U>) -> V::Of<(T, U)> {
                V::zip(first, second)
            }

            #[inline(always)]
            fn from_components(bundle: &V::Of<f32>) -> Self {
                Self::new(V::from_components(bundle))
            }
        }
    )*};
}
varyings!(Point, Vector);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_plus_the_difference_to_another_is_the_other() {
        let p = Point3::<World>::new(Vec3::new(1.0, 2.0, 3.0));
        let q = Point3::<World>::new(Vec3::new(-4.0, 0.5, 8.0));
        assert_eq!(p + (q - p), q);
        assert_eq!(q - (q - p), p);
        assert_eq!((q - p) + (p - q), Vector3::new(Vec3::ZERO));
        assert_eq!(-(q - p), (p - q) * 1.0);
    }
}
