//! Six faces of a cube.

use super::{Environment, finite_or_zero};
use crate::surface::{absolute_lanes, has_range};
use alberti_math::lanes::Lanes;

/// The six faces of a cube about the place, one below the other in one image of w x 6w texels: +x, −x, +y, −y, +z, −z.
///
/// Each face is as OpenGL and Vulkan store it, its first row on top; seen from inside the cube, it is mirrored. With
/// the greatest component as the axis, and s to the right, t downwards from 0 to 1 on the face:
///
/// ```text
/// axis   s             t                   +------+
/// +x     (1 − z/x)/2   (1 − y/x)/2         |  +x  |  v from 5/6 to 1
/// −x     (1 − z/x)/2   (1 + y/x)/2         +------+
/// +y     (1 + x/y)/2   (1 + z/y)/2         |  −x  |
/// −y     (1 − x/y)/2   (1 + z/y)/2         +------+
/// +z     (1 + x/z)/2   (1 − y/z)/2         |  ..  |      u = s
/// −z     (1 + x/z)/2   (1 + y/z)/2         |      |      v = 1 − (face + t)/6
/// ```
///
/// Of equal components, the first is the axis. A direction that is zero or not finite is as +x.
///
/// u and v stay half a texel away from the sides of the face, so that a bilinear filter never reads another face. An
/// error remains at the seams, as the filter does not blend across the edge. The outer half of the texels at it is
/// flat, and both faces end with colours that are up to a texel apart. Do not build mip levels
/// of this image: their filters read beyond a face, as half a texel of a smaller level is more than this one's.
///
/// Source: OpenGL 4.6 core specification, 8.13, table 8.19.
///
/// # Precision
/// Before that limit, u is within 1ε and v within 2ε (ε = 2^-24), in fixed point within 1.6·2^-16 and 2·2^-16. The
/// limit lies 2^-20 (in fixed point 2^-12) of the face further in than half a texel.
///
/// # Cost
/// Three divisions, one of them by a constant, and some 30 operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CubeMap {
    /// w, the side of a face in texels: at least 1.
    pub side: u32,
}

impl Environment for CubeMap {
    #[inline(always)]
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2] {
        let [x, y, z] = finite_or_zero(lanes, direction);
        let (zero, half) = (lanes.splat(0.0), lanes.splat(0.5));
        let (across, up, along) =
            (absolute_lanes(lanes, x), absolute_lanes(lanes, y), absolute_lanes(lanes, z));
        let (is_y, level) = (lanes.less(across, up), lanes.max(across, up));
        let (is_z, axis) = (lanes.less(level, along), lanes.max(level, along));
        let behind = [lanes.less(x, zero), lanes.less(y, zero), lanes.less(z, zero)];
        let [back, down, left] = [zero - z, zero - y, zero - x];

        // On the faces of each axis; then on those of the greatest.
        let right = [lanes.select(behind[0], z, back), x, lanes.select(behind[2], left, x)];
        let below = lanes.select(behind[1], back, z);
        let right = lanes.select(is_z, right[2], lanes.select(is_y, right[1], right[0]));
        let below = lanes.select(is_z, down, lanes.select(is_y, below, down));
        let first = lanes.select(is_z, lanes.splat(4.0), lanes.select(is_y, lanes.splat(2.0), zero));
        let sign = lanes.select(is_z, z, lanes.select(is_y, y, x));
        let face = lanes.select(lanes.less(sign, zero), first + lanes.splat(1.0), first);

        let axis = lanes.select(lanes.less(zero, axis), axis, lanes.splat(1.0));
        #[expect(clippy::cast_precision_loss, reason = "rounding of half a texel")]
        let margin = 0.5 / self.side.max(1) as f32 + if has_range(lanes) { FINE } else { COARSE };
        let ends = [lanes.splat(margin.min(0.5)), lanes.splat(1.0 - margin.min(0.5))];
        let s = lanes.min(lanes.max(half + half * (right / axis), ends[0]), ends[1]);
        let t = lanes.min(lanes.max(half + half * (below / axis), ends[0]), ends[1]);
        [s, lanes.splat(1.0) - (face + t) / lanes.splat(6.0)]
    }
}

/// The margin beyond the rounding of v, in heights of a face: in `f32`, and in fixed point.
const FINE: f32 = 1.0 / 1_048_576.0;
const COARSE: f32 = 1.0 / 4096.0;
