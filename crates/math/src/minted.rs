//! Points, vectors and frames as those of other libraries, by way of mint. It has no names of spaces: a value that
//! comes from there is in the space that is asked for.

use crate::frame::Frame;
use crate::frame2::Frame2;
use crate::space::{Point, Point2, Point3, Space, Vector, Vector2, Vector3};
use core::array::from_fn;
use core::fmt;
use glam::{Mat2, Mat3, Vec2, Vec3};

macro_rules! coordinates {
    ($($ours:ident: $kind:ident<$glam:ty> = $mint:ident;)*) => {$(
        impl<S: Space> From<mint::$mint<f32>> for $ours<S> {
            fn from(other: mint::$mint<f32>) -> Self {
                Self::new(<$glam>::from_array(other.into()))
            }
        }

        impl<S: Space> From<$ours<S>> for mint::$mint<f32> {
            fn from(own: $ours<S>) -> Self {
                own.coords.to_array().into()
            }
        }

        impl<S: Space> mint::IntoMint for $kind<$glam, S> {
            type MintType = mint::$mint<f32>;
        }
    )*};
}
coordinates! {
    Point2: Point<Vec2> = Point2;
    Point3: Point<Vec3> = Point3;
    Vector2: Vector<Vec2> = Vector2;
    Vector3: Vector<Vec3> = Vector3;
}

/// A matrix whose last row is not that of a frame: 0, …, 0, 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NotAffine;

impl fmt::Display for NotAffine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the last row of a frame's matrix must be 0, ..., 0, 1")
    }
}

impl core::error::Error for NotAffine {}

/// The columns of a frame: its axes and its origin.
macro_rules! frames {
    ($($frame:ident::$of_axes:ident, $mat:ty, $vec:ty: $columns:ident, $whole:ident { $($axis:ident)* | $origin:ident };)*) => {$(
        /// The axes are the first columns, the origin the last.
        impl<L: Space, P: Space> From<mint::$columns<f32>> for $frame<L, P> {
            fn from(matrix: mint::$columns<f32>) -> Self {
                let column = |column| <$vec>::from_array(<_>::from(column));
                let axes = <$mat>::from_cols($(column(matrix.$axis)),*);
                Self::$of_axes(axes, Point::new(column(matrix.$origin)))
            }
        }

        /// The axes are the first columns, the origin the last.
        impl<L: Space, P: Space> From<$frame<L, P>> for mint::$columns<f32> {
            fn from(frame: $frame<L, P>) -> Self {
                let [$($axis),*] = frame.axes().to_cols_array_2d().map(Into::into);
                Self { $($axis,)* $origin: frame.origin().coords.to_array().into() }
            }
        }

        impl<L: Space, P: Space> mint::IntoMint for $frame<L, P> {
            type MintType = mint::$columns<f32>;
        }

        /// A homogeneous matrix, such as other libraries have for transforms.
        ///
        /// # Errors
        /// [`NotAffine`] unless its last row is 0, ..., 0, 1.
        impl<L: Space, P: Space> TryFrom<mint::$whole<f32>> for $frame<L, P> {
            type Error = NotAffine;

            fn try_from(matrix: mint::$whole<f32>) -> Result<Self, NotAffine> {
                #[expect(clippy::float_cmp, reason = "exact in every library")]
                let is_affine = $(last_of(matrix.$axis.into()) == 0.0 &&)* last_of(matrix.$origin.into()) == 1.0;
                let column = |column| <$vec>::from_array(first_of(<_>::from(column)));
                let axes = <$mat>::from_cols($(column(matrix.$axis)),*);
                is_affine.then(|| Self::$of_axes(axes, Point::new(column(matrix.$origin)))).ok_or(NotAffine)
            }
        }

        /// The last row is 0, ..., 0, 1.
        impl<L: Space, P: Space> From<$frame<L, P>> for mint::$whole<f32> {
            fn from(frame: $frame<L, P>) -> Self {
                let [$($axis),*] = frame.axes().to_cols_array_2d().map(|axis| with_last(axis, 0.0).into());
                Self { $($axis,)* $origin: with_last(frame.origin().coords.to_array(), 1.0).into() }
            }
        }
    )*};
}
frames! {
    Frame::from_mat3, Mat3, Vec3: ColumnMatrix3x4, ColumnMatrix4 { x y z | w };
    Frame2::from_mat2, Mat2, Vec2: ColumnMatrix2x3, ColumnMatrix3 { x y | z };
}

fn first_of<const N: usize, const M: usize>(column: [f32; N]) -> [f32; M] {
    with_last(column, 0.0)
}

fn last_of<const N: usize>(column: [f32; N]) -> f32 {
    column.last().copied().unwrap_or(0.0)
}

/// The first components, and `last` where there are no more.
fn with_last<const N: usize, const M: usize>(column: [f32; N], last: f32) -> [f32; M] {
    from_fn(|k| column.get(k).copied().unwrap_or(last))
}
