//! The picture of the depth buffer's resolution.

use super::legend::{Legend, Number, Step, paint, short};
use super::{Of, nothing};
use crate::colormap::viridis;
use crate::error::Error;
use crate::options::values::name_of;
use crate::options::{DepthFormat, Projection};
use crate::probe::probe;
use crate::scene::Image;
use alberti::projection::{DepthMap, DepthSteps};

/// Steps of the scale to ten times as much.
const PER_DECADE: f32 = 2.0;
/// The decades that the colours span, of the share of the distance between the planes; and the one where they end.
const DECADES: [f32; 2] = [8.0, -1.0];

/// The resolution at a depth zs.
enum Resolution {
    Perspective(DepthMap, [f32; 2]),
    /// The same everywhere, but for the steps of `f32`.
    Parallel(f32),
}

impl Resolution {
    fn at(&self, steps: DepthSteps, zs: f32) -> f32 {
        match self {
            Self::Perspective(map, [near, far]) => map.resolution(steps, map.z(zs).clamp(*near, *far)),
            Self::Parallel(depth) => {
                let format = match steps {
                    DepthSteps::D16 => 1.0 / 65_535.0,
                    DepthSteps::D24 => 1.0 / 16_777_215.0,
                    DepthSteps::D32 | DepthSteps::F32 => 0.0,
                };
                depth * (zs.next_up() - zs).max(format)
            }
        }
    }
}

/// The distance that surfaces need to be told apart.
pub(super) fn depth_step((model, camera, options): Of<'_>) -> Result<(Image, Legend), Error> {
    let steps_of = match options.depth {
        DepthFormat::U16 => DepthSteps::D16,
        DepthFormat::U24 => DepthSteps::D24,
        DepthFormat::U32 => DepthSteps::D32,
        DepthFormat::F32 | DepthFormat::F32Reversed | DepthFormat::None => DepthSteps::F32,
    };
    let planes @ [near, far] = [camera.near, camera.far];
    let resolution = match options.projection {
        Projection::Perspective => {
            let reversed = options.depth == DepthFormat::F32Reversed;
            let map = if reversed { DepthMap::reversed(near, far) } else { DepthMap::forward(near, far) };
            let map =
                map.map_err(|e| Error::new(e.to_string(), "planes that can be drawn").place("--near"))?;
            Resolution::Perspective(map, planes)
        }
        Projection::Parallel { .. } => Resolution::Parallel(far - near),
    };
    let probes = probe(model, camera, options)?;

    // Steps at powers of ten and halfway between, so that pictures can be compared; all that `f32` can be.
    let log = |dz: f32| (dz.log10() * PER_DECADE).floor();
    let (lowest, highest) = (-90.0_f32, 76.0_f32);
    let power = |step: f32| 10.0_f32.powf(step / PER_DECADE);
    let mut steps = vec![nothing()];
    let mut step = lowest;
    while step < highest {
        let share = (step + 0.5) / PER_DECADE - (far - near).log10();
        let meaning = format!("{} to {}", short(power(step)), short(power(step + 1.0)));
        steps.push(Step::new(viridis((share - DECADES[1]) / DECADES[0] + 1.0), meaning));
        step += 1.0;
    }
    let name = name_of(options.depth);
    let title = format!(
        "depth-step: distance that surfaces need to be told apart by {name} between planes at {} and {}",
        short(near),
        short(far)
    );
    let (image, mut legend) = paint(options, [&title, "distance of a pixel"], steps, |index| {
        #[expect(clippy::cast_possible_truncation, reason = "a map of f32")]
        let Some(zs) = probes.seen(index).and_then(|seen| seen.zs).map(|zs| zs as f32) else {
            return Number::none(0);
        };
        let dz = resolution.at(steps_of, zs);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few steps")]
        let step = 1 + (log(dz).clamp(lowest, highest - 1.0) - lowest) as usize;
        Number::new(step, dz)
    })?;
    if let (1.., [_, _, greatest]) = legend.numbers {
        let share = short(100.0 * greatest / (far - near));
        legend.notes.push(format!("the greatest is {share} % of the distance between the planes"));
    }
    Ok((image, legend))
}
