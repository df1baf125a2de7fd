//! Policies without values: their names in files and logs.

use crate::environment::{LatLong, SphereMap};
use crate::format::{L8, L16, La8, Normals, Rgb8, Rgb565, Rgba4444, Scalars};
use crate::surface::{LimitedParallax, OffsetParallax};
use crate::{BaseLevel, BetweenLevels, Bilinear, Clamp, Mirror, Nearest, NearestLevel, Repeat, Trilinear};
use alberti_math::named;

named!(Repeat, Clamp, Mirror);
named!(Nearest, Bilinear, Trilinear);
named!(BaseLevel(F: filter), NearestLevel(F: filter), BetweenLevels(F: filter));
named!(Rgb8, Rgb565, Rgba4444, L8, La8, L16, Scalars(F: format), Normals(F: format));
named!(OffsetParallax, LimitedParallax, LatLong, SphereMap);
