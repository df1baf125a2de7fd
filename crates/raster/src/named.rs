//! Policies without values: their names in files and logs.

use crate::color::{
    Additive, Bayer, BlueNoise, Grey1, Grey2, Grey4, Grey8, InLight, Multiply, Over, Premultiplied, Rgb444,
    Rgb666, Rgb888, Xrgb8888,
};
use crate::{
    Affine, Always, D16, D24, D32, Equal, Exact, F32, F32Reversed, Farther, FixedPoint, NoDepth,
    NoDerivatives, OrEqual, PerPixel, PerRun, PerTriangle, Planes, ReadOnly, Spans16,
};
use alberti_math::named;

named!(Exact, Planes, Spans16, Affine, FixedPoint(R: runs));
named!(NoDerivatives, PerPixel, PerRun, PerTriangle);
named!(NoDepth, D16, D24, D32, F32, F32Reversed);
named!(OrEqual(D: format), Equal(D: format), Farther(D: format), Always(D: format), ReadOnly(D: format));
named!(Rgb444, Rgb666, Rgb888, Xrgb8888, Grey1, Grey2, Grey4, Grey8);
named!(Bayer, BlueNoise, Over, Premultiplied, Additive, Multiply, InLight(B: blend));
