//! The resolution of depth buffers: the distance of surfaces that they can tell apart.
//!
//! ```text
//!    1 |                   _ . - '''      equal steps of zs, δ, are short steps of z near the eye
//!      |          . - '                   and long ones far away:
//!   zs |     . '
//!      |   /                              dz = z·δ / (|β|/z + δ)
//!    0 |__/___________________________
//!         A                           B  z
//! ```

use crate::{DepthMap, ViewError};
use alberti_math::Subpixel;
use alberti_math::lanes::{Lanes, One};

/// The values that a depth buffer can hold, under the names of the rasterizer's formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum DepthSteps {
    /// 2^16 values, evenly: `D16`.
    D16,
    /// 2^24 values, evenly: `D24`.
    D24,
    /// 2^32 values, evenly, of which the `f32` that depths are computed in reach a part: `D32`.
    D32,
    /// All `f32`: `F32` with a forward map, `F32Reversed` with a reversed one.
    F32,
}

impl DepthSteps {
    /// The formats that the rasterizer has, the cheapest first, and whether each goes with a reversed map: by the bytes
    /// of a pixel (2, then 4), then integers before floats.
    pub const FORMATS: [(Self, bool); 5] =
        [(Self::D16, false), (Self::D24, false), (Self::D32, false), (Self::F32, false), (Self::F32, true)];

    /// The distance of two neighbours of an even format, on a range of zs of length 1.
    const fn even(self) -> f64 {
        match self {
            Self::D16 => 1.0 / 65_535.0,
            Self::D24 => 1.0 / 16_777_215.0,
            Self::D32 => 1.0 / 4_294_967_295.0,
            Self::F32 => 0.0,
        }
    }
}

impl DepthMap {
    /// The distance that two surfaces need to be told apart, the farther of them at depth `z`: dz = z·δ/(|β|/z + δ),
    /// where zs is one step δ away. For small steps that is z²δ/|β|; it never exceeds z.
    ///
    /// δ is the format's step, or that of the `f32` zs or β/z there, if that is larger.
    ///
    /// ```
    /// use alberti_projection::{DepthMap, DepthSteps};
    ///
    /// // At the far plane, a thousand times as far as the near one: metres, millimetres, a tenth of a millimetre.
    /// let (near, far) = (1.0, 1000.0);
    /// let (forward, reversed) = (DepthMap::forward(near, far)?, DepthMap::reversed(near, far)?);
    /// assert!((forward.resolution(DepthSteps::D16, far) - 15.0).abs() < 0.1);
    /// assert!((forward.resolution(DepthSteps::D24, far) - 0.06).abs() < 0.001);
    /// assert!(reversed.resolution(DepthSteps::F32, far) < 0.0002);
    /// # Ok::<(), alberti_projection::ViewError>(())
    /// ```
    ///
    /// # Precision
    /// Within 4ε (ε = 2^-24) of the formula for the planes, relatively, with δ for zs and β/z as computed.
    ///
    /// The depths that are really stored like `z` extend over between dz/2 and 2dz where 2^-21·z <= dz <= z/4, so that
    /// surfaces 2dz apart are told apart. Finer than that, where z, β/z and zs all round by about as much, they extend
    /// over between dz/4 and 4dz. Depths that share the first or the last stored value are the exception: the planes
    /// cut there.
    #[must_use]
    pub fn resolution(&self, steps: DepthSteps, z: f32) -> f32 {
        let quotient = self.beta() / z;
        let step = self.step(steps).max(spacing(self.zs(z))).max(spacing(quotient));
        narrow(f64::from(z) * step / (f64::from(quotient.abs()) + step))
    }

    /// The distance that two surfaces need so that the nearer one is seen where they are drawn, the farther of them at
    /// depth `z`. Each may be made of triangles of its own, whose depths are off by something else at each pixel.
    ///
    /// `slope` is the sum of |∂z/∂x| and |∂z/∂y|, from pixel to pixel, over z: 0 for what faces the eye. Of a plane it
    /// is the same everywhere, and about an angle: the tangent of its inclination times that of a pixel.
    ///
    /// ```text
    /// dz = z·δ/(|β|/z + δ),   δ = 2 steps + 2e,   e = ε(8|zs| + 2|β|/z) + slope·snap·|β|/z
    /// ```
    ///
    /// The zs of one surface may be off by e: its vertices' z and zs are rounded, and `Exact` interpolates within 6ε.
    /// And a vertex moves by up to half a subpixel on each axis, `snap`. In large triangles zs are moved with it, and
    /// rounded once more. What moving is off by besides is less than `slope·snap·|β|/z`, which then is not needed.
    ///
    /// ```
    /// use alberti_math::Sub8;
    /// use alberti_projection::{DepthMap, DepthSteps};
    ///
    /// // A reversed map tells a millimetre apart at two kilometres; but not of floors seen under a flat angle.
    /// let map = DepthMap::reversed(0.1, 2000.0)?;
    /// assert!(map.resolution(DepthSteps::F32, 2000.0) < 0.001);
    /// assert!(map.drawn_resolution(DepthSteps::F32, 2000.0, 0.0, Sub8) < 0.005);
    /// assert!(map.drawn_resolution(DepthSteps::F32, 2000.0, 0.02, Sub8) > 0.1);
    /// # Ok::<(), alberti_projection::ViewError>(())
    /// ```
    ///
    /// # Precision
    /// It is a bound for planes between the near and the far one that [`Exact`] draws; others interpolate depth within
    /// 12ε of its greatest value. Surfaces that are stored like one of the ends are the exception.
    ///
    /// [`Exact`]: https://docs.rs/alberti-raster
    #[must_use]
    pub fn drawn_resolution(&self, steps: DepthSteps, z: f32, slope: f32, subpixel: Subpixel) -> f32 {
        const EPSILON: f64 = 1.0 / 16_777_216.0;
        let (zs, quotient) = (f64::from(self.zs(z)), f64::from((self.beta() / z).abs()));
        let snap = 0.5 / f64::from(1_u32 << subpixel.bits());
        let error = EPSILON * (8.0 * zs.abs() + 2.0 * quotient) + f64::from(slope) * snap * quotient;
        let step = 2.0 * self.step(steps).max(spacing(self.zs(z))) + 2.0 * error;
        narrow(f64::from(z) * step / (quotient + step))
    }

    /// The depth, of the farther of two surfaces `gap` apart, where [`resolution`](Self::resolution) reaches `gap`. Up
    /// to a quarter of it their zs are told apart for certain, but for depths stored like one of the planes; farther
    /// away they may fight for the pixel. It may be nearer than the near plane or farther than the far one.
    ///
    /// That is of zs of the two depths, as surfaces have that face the eye, or that are made of the same triangles. Of
    /// others [`drawn_resolution`](Self::drawn_resolution) tells.
    ///
    /// z(z − gap) = gap·|β|/δ, thus z = gap·(1/2 + √(1/4 + |β|/(δ·gap))), and not beyond 2^23·gap, where the spacing
    /// of `f32` is all there is.
    ///
    /// # Precision
    /// With `D16` the resolution there is within 6ε of `gap`, relatively. That is twice what z is off by: half an ε of
    /// β's rounding, half an ε of the radicand's, one of the root's and one of its own. Where the step varies with zs,
    /// as it does for `F32`, the largest is taken. Then the resolution is at most `gap`·(1 + 10ε) up to there, of which
    /// 4ε are its own, and more than `gap` at twice that depth. That is for maps onto [0, 1] or [−1, 1] either way
    /// round, from four times the near plane on.
    #[must_use]
    pub fn separable_until(&self, steps: DepthSteps, gap: f32) -> f32 {
        let [least, most] = self.range();
        // With α <= 0 <= zs, zs is at most β/z, and so is its spacing.
        let fine = self.alpha() <= 0.0 && least >= 0.0;
        let float = if fine { 0.0 } else { spacing(most.max(-least)) };
        let reach = f64::from(self.beta().abs()) / self.step(steps).max(float);
        // More than 2^46 gaps are more than 2^23 after the root; and so is what a gap of 0 makes.
        let gaps = (reach / f64::from(gap)).min(MOST * MOST);
        let root = f64::from(One.sqrt(narrow(0.25 + gaps)));
        narrow(f64::from(gap) * (0.5 + root).min(MOST))
    }

    /// The cheapest of [`DepthSteps::FORMATS`] that tells surfaces `gap` apart at the far plane for certain, and the
    /// map to go with it: [`reversed`](Self::reversed) or [`forward`](Self::forward). None where no format does.
    ///
    /// Of surfaces that face the eye, or are made of the same triangles; of others
    /// [`cheapest_drawn`](Self::cheapest_drawn). That takes a [`resolution`](Self::resolution) of at most half the gap
    /// with `D16`, and of a quarter with the finer formats, where the roundings of `f32` count. Then zs of the far
    /// plane and of all that is `gap` or more before it are stored differently.
    ///
    /// ```
    /// use alberti_projection::{DepthMap, DepthSteps};
    ///
    /// let steps = |far, gap| DepthMap::cheapest(0.1, far, gap).map(|found| found.map(|(steps, _)| steps));
    /// assert_eq!(steps(15.0, 0.1)?, Some(DepthSteps::D16));
    /// assert_eq!(steps(100.0, 0.1)?, Some(DepthSteps::D24));
    /// assert_eq!(steps(2000.0, 0.1)?, Some(DepthSteps::F32));
    /// assert_eq!(steps(2e6, 0.1)?, None);
    /// # Ok::<(), alberti_projection::ViewError>(())
    /// ```
    ///
    /// # Errors
    /// As [`forward`](Self::forward); of an infinite far plane, whose resolution is infinite, there is none to choose.
    pub fn cheapest(near: f32, far: f32, gap: f32) -> Result<Option<(DepthSteps, Self)>, ViewError> {
        Self::first_format(near, far, |steps, map| map.apart(steps, far) <= gap)
    }

    /// The same for surfaces as they are drawn, with this greatest `slope`: the cheapest format whose
    /// [`drawn_resolution`](Self::drawn_resolution) at the far plane is at most the gap.
    ///
    /// # Errors
    /// As [`cheapest`](Self::cheapest).
    pub fn cheapest_drawn(
        [near, far]: [f32; 2],
        gap: f32,
        slope: f32,
        subpixel: Subpixel,
    ) -> Result<Option<(DepthSteps, Self)>, ViewError> {
        Self::first_format(near, far, |steps, map| map.drawn_resolution(steps, far, slope, subpixel) <= gap)
    }

    /// The cheapest format that will do, and its map.
    fn first_format(
        near: f32,
        far: f32,
        will_do: impl Fn(DepthSteps, &Self) -> bool,
    ) -> Result<Option<(DepthSteps, Self)>, ViewError> {
        let (forward, falling) = (Self::forward(near, far)?, Self::reversed(near, far)?);
        Ok(DepthSteps::FORMATS
            .map(|(steps, reversed)| (steps, if reversed { falling } else { forward }))
            .into_iter()
            .find(|(steps, map)| will_do(*steps, map)))
    }

    /// The distance of surfaces that are stored apart for certain, the farther of them at depth `z`, be it the far
    /// plane: twice the resolution. It is four times the resolution where `f32` is hardly finer than the format. Its
    /// roundings count then: of α, which may shift the depths stored like the far plane, of β/z and of zs.
    fn apart(&self, steps: DepthSteps, z: f32) -> f32 {
        let float = spacing(self.zs(z)).max(spacing(self.beta() / z));
        let dz = self.resolution(steps, z);
        let factor = if self.step(steps) < 8.0 * float || dz < z / 2_097_152.0 { 4.0 } else { 2.0 };
        factor * dz
    }

    /// The step of zs of an even format, which divides the range; 0 for `f32`.
    fn step(&self, steps: DepthSteps) -> f64 {
        let [least, most] = self.range();
        (f64::from(most) - f64::from(least)) * steps.even()
    }
}

/// The most steps of an `f32` that a depth is away from 0, as far as gaps of one step are told apart.
const MOST: f64 = 8_388_608.0;

/// The distance from `x` to the next `f32` towards 0.
fn spacing(x: f32) -> f64 {
    let x = x.abs();
    // Of 0 the next one is as far as that after it.
    f64::from(if x == 0.0 { x.next_up() } else { x - x.next_down() })
}

#[expect(clippy::cast_possible_truncation, reason = "the one rounding that counts")]
fn narrow(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of an endless view from z = 1 on, zs = 1 − 1/z: at z = 65535 one step of D16 is all that is left.
    #[test]
    fn one_step_nearer_is_half_as_far_where_one_step_is_left() {
        for range in [[0.0, 1.0], [-1.0, 1.0], [1.0, -1.0]] {
            let map = DepthMap::onto(range, 1.0, f32::INFINITY).expect("valid");
            assert_eq!(map.resolution(DepthSteps::D16, 65_535.0), 32_767.5);
            let until = map.separable_until(DepthSteps::D16, 32_767.5);
            assert!((until - 65_535.0).abs() < 0.02, "{until}");
            assert_eq!(map.resolution(DepthSteps::D16, f32::INFINITY), f32::INFINITY);
        }
    }

    /// 1/dz − 1/z is |β|/(z² δ), and |β| is A without a far plane, AB/(B − A) with one: up to twice that.
    #[test]
    fn the_near_plane_makes_the_resolution() {
        let finest = |near: f32, far: f32| {
            let map = DepthMap::forward(near, far).expect("0 < near < far");
            let dz = f64::from(map.resolution(DepthSteps::D16, 16.0));
            1.0 / dz - 1.0 / 16.0
        };
        let is = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-5;
        for near in [0.25, 1.0, 4.0] {
            let endless = finest(near, f32::INFINITY);
            assert!(is(finest(2.0 * near, f32::INFINITY) / endless, 2.0), "{near}");
            for ratio in [2.0, 4.0, 128.0] {
                let far = (near * ratio).max(16.0);
                let [a, b] = [near, far].map(f64::from);
                assert!(is(finest(near, far) / endless, b / (b - a)), "{near} {far}");
            }
        }
    }

    #[test]
    fn a_reversed_float_is_as_fine_as_f32_itself() {
        let map = DepthMap::reversed(1.0, f32::INFINITY).expect("valid");
        for z in [1.0, 1024.0, 1e30] {
            let resolution = map.resolution(DepthSteps::F32, z);
            assert!(resolution > z / 33_554_432.0 && resolution <= z / 8_388_608.0, "{resolution} at {z}");
        }
        assert_eq!(map.separable_until(DepthSteps::F32, 0.25), 2_097_152.0);
        assert_eq!(map.separable_until(DepthSteps::F32, 0.0), 0.0);
    }
}
