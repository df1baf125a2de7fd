//! Lenses, viewports and projectors as values that files and fuzzers give: checked as by their constructors, and found
//! again bit by bit.

#[cfg(feature = "arbitrary")]
use arbitrary::{Arbitrary, Unstructured};

use crate::{Parallel, Perspective, Projector, ViewError, Viewport};
use alberti_math::glam::{Mat3, Vec3};
use alberti_math::{Frame, Point3};

/// A [`Perspective`] or a [`Parallel`].
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Lens {
    /// cot(fov/2), or 2/height.
    scale: f64,
    /// That over the aspect ratio.
    scale_x: f32,
    near: f32,
    far: f32,
}

macro_rules! lenses {
    ($($lens:ident: $of_scale:expr;)*) => {$(
        impl From<$lens> for Lens {
            fn from($lens { scale, scale_x, near, far, .. }: $lens) -> Self {
                Self { scale, scale_x, near, far }
            }
        }

        #[cfg(feature = "defmt")]
        impl defmt::Format for $lens {
            fn format(&self, formatter: defmt::Formatter<'_>) {
                defmt::write!(formatter, "{}", Lens::from(*self));
            }
        }

        impl TryFrom<Lens> for $lens {
            type Error = ViewError;

            fn try_from(Lens { scale, scale_x, near, far }: Lens) -> Result<Self, ViewError> {
                let mut lens: Self = $of_scale(scale, [near, far])?;
                if !(scale_x > 0.0 && scale_x.is_normal()) {
                    return Err(ViewError::Aspect);
                }
                (lens.scale, lens.scale_x) = (scale, scale_x);
                Ok(lens)
            }
        }

        #[cfg(feature = "arbitrary")]
        impl<'a> Arbitrary<'a> for $lens {
            /// Any opening or height, aspect ratio and planes of usual sizes.
            fn arbitrary(bytes: &mut Unstructured<'a>) -> arbitrary::Result<Self> {
                let mut part = || Ok((f32::from(u16::arbitrary(bytes)?) + 1.0) / 65_537.0);
                let [open, width, height, near, depth] = [part()?, part()?, part()?, part()?, part()?];
                let near = 256.0 * near;
                let opening = core::f32::consts::PI * open;
                Self::new(opening, width / height, near, near + 4096.0 * near * depth)
                    .map_err(|_| arbitrary::Error::IncorrectFormat)
            }
        }
    )*};
}
lenses! {
    // Other callers give cotangents of angles below a right one, which are positive.
    Perspective: |scale: f64, planes| match scale > 0.0 {
        true => Perspective::of_scale(scale, 1.0, planes),
        false => Err(ViewError::Angle),
    };
    Parallel: |scale: f64, [near, far]: [f32; 2]| {
        #[expect(clippy::cast_possible_truncation, reason = "the height that the scale was made of")]
        Parallel::new((2.0 / scale) as f32, 1.0, near, far)
    };
}

/// A [`Viewport`].
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Rectangle {
    x: i32,
    y: i32,
    width: u32,
    height: u32,
}

impl From<Viewport> for Rectangle {
    fn from(viewport: Viewport) -> Self {
        let [columns, rows] = viewport.pixels();
        let [width, height] = [&columns, &rows].map(|range| range.end.abs_diff(range.start));
        Self { x: columns.start, y: rows.start, width, height }
    }
}

impl TryFrom<Rectangle> for Viewport {
    type Error = ViewError;

    fn try_from(Rectangle { x, y, width, height }: Rectangle) -> Result<Self, ViewError> {
        Self::new(x, y, width, height)
    }
}

/// A [`Projector`]: its place, and the directions on its image, the first two scaled by its opening.
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Thrown {
    eye: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
}

impl From<Projector> for Thrown {
    fn from(Projector { eye, rows }: Projector) -> Self {
        let Mat3 { x_axis: right, y_axis: up, z_axis: forward } = rows.axes().transpose();
        Self { eye: eye.coords, right, up, forward }
    }
}

impl TryFrom<Thrown> for Projector {
    type Error = ViewError;

    fn try_from(Thrown { eye, right, up, forward }: Thrown) -> Result<Self, ViewError> {
        if ![eye, right, up, forward].into_iter().all(Vec3::is_finite) {
            return Err(ViewError::NotFinite);
        }
        let rows = Mat3::from_cols(right, up, forward).transpose();
        Ok(Self { eye: Point3::new(eye), rows: Frame::from_mat3(rows, Point3::new(Vec3::ZERO)) })
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> Arbitrary<'a> for Projector {
    /// Any place and directions of usual sizes.
    fn arbitrary(bytes: &mut Unstructured<'a>) -> arbitrary::Result<Self> {
        let mut vector = || {
            let [x, y, z] = <[i16; 3]>::arbitrary(bytes)?.map(|c| f32::from(c) / 256.0);
            Ok(Vec3::new(x, y, z))
        };
        let thrown = Thrown { eye: vector()?, right: vector()?, up: vector()?, forward: vector()? };
        Self::try_from(thrown).map_err(|_| arbitrary::Error::IncorrectFormat)
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> Arbitrary<'a> for Viewport {
    fn arbitrary(bytes: &mut Unstructured<'a>) -> arbitrary::Result<Self> {
        const REACH: i32 = 16_384;
        let mut side = || {
            let from = bytes.int_in_range(-REACH..=REACH - 1)?;
            Ok((from, bytes.int_in_range(1..=REACH.abs_diff(from))?))
        };
        let ((x, width), (y, height)) = (side()?, side()?);
        Self::new(x, y, width, height).map_err(|_| arbitrary::Error::IncorrectFormat)
    }
}
