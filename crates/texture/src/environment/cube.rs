//! Six faces of a cube.

use super::{Environment, finite_or_zero};
use crate::surface::{absolute, has_range};
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
/// Of equal components, the first is the axis. What is zero or not finite is as +x.
///
/// u and v stay half a texel away from the sides of the face, so that a bilinear filter never reads another face. What
/// remains at the seams: the filter does not blend across the edge, so that the outer half of the texels at it is
/// flat, and both faces end with colours that are up to a texel apart. Mip levels need faces of their own; do not
/// build them from this image, as levels beyond the first average over two faces.
///
/// Source: OpenGL 4.6 core specification, 8.13, table 8.19.
///
/// # Precision
/// Before that limit, which is 2^-20 (in fixed point 2^-12) of the face more than half a texel, u is within 1ε, v
/// within 2ε (ε = 2^-24); in fixed point within 1.6·2^-16 and 2·2^-16.
///
/// # Cost
/// Two divisions, one by a constant, and some 30 operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cube {
    /// w, the side of a face in texels: at least 1.
    pub side: u32,
}

impl Environment for Cube {
    #[inline(always)]
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2] {
        let [x, y, z] = finite_or_zero(lanes, direction);
        let (zero, half) = (lanes.splat(0.0), lanes.splat(0.5));
        // Positive and negative: the face, to the right and downwards, times the axis.
        let face = |axis, positive: [L::Number; 3], negative: [L::Number; 3]| {
            let mask = lanes.less(axis, zero);
            [0, 1, 2].map(|k| lanes.select(mask, negative[k], positive[k]))
        };
        let [back, down, left] = [z, y, x].map(|component| zero - component);
        let number = |k| lanes.int_to_number(lanes.int(k));
        let faces = [
            face(x, [number(0), back, down], [number(1), z, down]),
            face(y, [number(2), x, z], [number(3), x, back]),
            face(z, [number(4), x, down], [number(5), left, down]),
        ];
        let [across, up, along] = [x, y, z].map(|component| absolute(lanes, component));
        let (is_y, level) = (lanes.less(across, up), lanes.max(across, up));
        let is_z = lanes.less(level, along);
        let chosen =
            [0, 1, 2].map(|k| lanes.select(is_z, faces[2][k], lanes.select(is_y, faces[1][k], faces[0][k])));

        let axis = lanes.max(level, along);
        let axis = lanes.select(lanes.less(zero, axis), axis, lanes.splat(1.0));
        #[expect(clippy::cast_precision_loss, reason = "rounding of half a texel")]
        let margin = 0.5 / self.side.max(1) as f32 + if has_range(lanes) { FINE } else { COARSE };
        let (least, greatest) = (lanes.splat(margin.min(0.5)), lanes.splat(1.0 - margin.min(0.5)));
        let on_face = |component| {
            let place = half + half * (component / axis);
            lanes.min(lanes.max(place, least), greatest)
        };
        let (s, t) = (on_face(chosen[1]), on_face(chosen[2]));
        [s, lanes.splat(1.0) - (chosen[0] + t) / lanes.splat(6.0)]
    }
}

/// More than what rounding moves v, of the height of a face: in `f32`, and in fixed point.
const FINE: f32 = 1.0 / 1_048_576.0;
const COARSE: f32 = 1.0 / 4096.0;
