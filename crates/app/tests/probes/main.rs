//! Numbers of pixels against answers from elsewhere: rays in f64 at a tilted quad, layers that are known, the counters
//! of the pipeline, and its depth buffer.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "pixels within a frame")]

mod counts;
mod quad;
mod runs;

use alberti_app::options::{
    Arithmetic, Cull, DepthFormat, Filter, Interpolation, LightOptions, Policies, Projection, RenderOptions,
    Shading, Wrap,
};
use std::num::NonZero;

/// Plain options for pictures of this size.
fn options((width, height): (u32, u32), policies: Policies, depth: DepthFormat) -> RenderOptions {
    RenderOptions {
        width,
        height,
        background: [9, 9, 9],
        shading: Shading::Unlit,
        filter: Filter::Nearest,
        wrap: Wrap::Repeat,
        cull: Cull::None,
        depth,
        projection: Projection::Perspective,
        haze: None,
        light: LightOptions::default(),
        threads: NonZero::new(3).expect("three"),
        policies,
    }
}

/// The policies of these names.
fn policies(interpolation: &str, arithmetic: Arithmetic) -> Policies {
    let interpolation: Interpolation = interpolation.parse().expect("a name");
    Policies { interpolation, arithmetic, ..Policies::default() }
}
