//! Cameras and views: steps 1, 2 and 4 of the pipeline, and the shape of the picture.

use alberti_math::glam::Mat4;
use alberti_math::{Eye, Frame, Object, Point3, Vector3, World};
use alberti_projection::{
    AnyProjection, Handedness, Parallel, Perspective, Projection, ViewError, Viewport, eye_of_matrix, look_at,
};
use core::ops::Range;

/// An observer's place and orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Camera {
    to_eye: Frame<World, Eye>,
}

impl Camera {
    /// The observer at `eye` who looks at `target`, with `up` upwards in the picture.
    ///
    /// # Errors
    /// Those of [`look_at`].
    pub fn look_at(
        eye: impl Into<Point3<World>>,
        target: impl Into<Point3<World>>,
        up: impl Into<Vector3<World>>,
    ) -> Result<Self, ViewError> {
        Ok(Self::at(look_at(eye.into(), target.into(), up.into())?))
    }

    /// The observer in this frame: unit axes to the right, up and forward, at right angles.
    #[must_use]
    pub fn at(frame: Frame<Eye, World>) -> Self {
        Self { to_eye: frame.inverse_orthonormal() }
    }

    /// The observer of a view matrix, such as glam's.
    ///
    /// ```
    /// use alberti::glam::{Vec3, camera::rh};
    /// use alberti::{Camera, ClipSpace, Handedness, Perspective};
    ///
    /// let view = rh::view::look_at_mat4(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y);
    /// let projection = rh::proj::directx::perspective(0.7, 4.0 / 3.0, 0.1, 100.0);
    /// let lens = Perspective::from_matrix(projection, ClipSpace::DirectX)?;
    /// let view = Camera::from_matrix(view, Handedness::Right)?.through(lens);
    /// # Ok::<(), alberti::ViewError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`eye_of_matrix`].
    pub fn from_matrix(view: Mat4, handedness: Handedness) -> Result<Self, ViewError> {
        Ok(Self::at(eye_of_matrix(view, handedness)?))
    }

    /// The view in perspective, with the full vertical opening angle `fov_y` (radians), between the planes z = near and
    /// z = far of `range`. Its aspect ratio is that of the viewport.
    ///
    /// # Errors
    /// Those of [`Perspective::new`].
    pub fn perspective(self, fov_y: f32, range: Range<f32>) -> Result<View, ViewError> {
        let of_aspect = |aspect| Perspective::new(fov_y, aspect, range.start, range.end);
        of_aspect(WIDEST)?;
        Ok(View { to_eye: self.to_eye, projection: of_aspect(1.0 / WIDEST)?, fits: true })
    }

    /// The view through a projection with an aspect ratio of its own, for example a constant. A constant lens is not
    /// computed on the machine that draws, and brings no `f64` into the program.
    ///
    /// ```
    /// use alberti::{Camera, Perspective, glam::Vec3};
    ///
    /// const LENS: Perspective = match Perspective::new(0.7, 320.0 / 240.0, 0.1, 100.0) {
    ///     Ok(lens) => lens,
    ///     Err(_) => panic!("an impossible lens"),
    /// };
    /// let view = Camera::look_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y)?.through(LENS);
    /// # Ok::<(), alberti::ViewError>(())
    /// ```
    #[must_use]
    pub const fn through<Pr: Projection>(self, projection: Pr) -> View<Pr> {
        View::new(self.to_eye, projection)
    }

    /// The view in parallel projection, of the full `height` in units of the world. Its aspect ratio is that of the
    /// viewport.
    ///
    /// # Errors
    /// Those of [`Parallel::new`].
    pub fn parallel(self, height: f32, range: Range<f32>) -> Result<View<Parallel>, ViewError> {
        let of_aspect = |aspect| Parallel::new(height, aspect, range.start, range.end);
        of_aspect(WIDEST)?;
        Ok(View { to_eye: self.to_eye, projection: of_aspect(1.0 / WIDEST)?, fits: true })
    }
}

/// The greatest aspect ratio of a viewport: if this and its inverse are possible, so is any other.
const WIDEST: f32 = 16384.0;

/// The way from the world to the picture: the eye, and the pyramid or box that it sees.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct View<Pr = Perspective> {
    to_eye: Frame<World, Eye>,
    projection: Pr,
    /// Whether the aspect ratio is that of the viewport.
    fits: bool,
}

impl<Pr: Projection> View<Pr> {
    /// The view through a projection with an aspect ratio of its own, for example where pixels are not square.
    #[must_use]
    pub const fn new(to_eye: Frame<World, Eye>, projection: Pr) -> Self {
        Self { to_eye, projection, fits: false }
    }

    /// The frame that leads from the object's to the eye's coordinates, for an object that stands in `frame` in the
    /// world, or in the world's own: step 1.
    #[must_use]
    #[inline]
    pub fn object_to_eye(&self, frame: Option<&Frame<Object, World>>) -> Frame<Object, Eye> {
        match frame {
            Some(frame) => self.to_eye * *frame,
            None => Frame::from_mat3(self.to_eye.axes(), self.to_eye.origin()),
        }
    }

    /// The projection for a viewport: steps 2 and 4.
    #[must_use]
    #[inline]
    pub fn projection(&self, viewport: &Viewport) -> Pr {
        if self.fits { self.projection.with_aspect(viewport.aspect()) } else { self.projection }
    }
}

impl From<View<Perspective>> for View<AnyProjection> {
    fn from(View { to_eye, projection, fits }: View<Perspective>) -> Self {
        Self { to_eye, projection: projection.into(), fits }
    }
}

impl From<View<Parallel>> for View<AnyProjection> {
    fn from(View { to_eye, projection, fits }: View<Parallel>) -> Self {
        Self { to_eye, projection: projection.into(), fits }
    }
}
