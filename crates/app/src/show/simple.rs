//! The pictures whose numbers need no more than a scale: differences, levels of detail, fragments, triangles.

use super::legend::{Legend, Number, Step, paint, three};
use super::{NOTHING, Of, nothing};
use crate::colormap::viridis;
use crate::error::Error;
use crate::options::{DepthFormat, Policies, RenderOptions};
use crate::probe::{Probes, probe};
use crate::render::render;
use crate::scene::Image;
use std::collections::HashMap;

/// A colour of so many along the map.
#[expect(clippy::cast_precision_loss, reason = "few steps")]
fn along(k: usize, count: usize) -> [u8; 3] {
    viridis(k as f32 / (count - 1).max(1) as f32)
}

/// Powers of two from 1 to `last`, each with the numbers up to the next: "1", "2 to 3", "4 to 7", ...
fn doubling(last: u32) -> impl Iterator<Item = String> {
    (0..=last.ilog2()).map(|k| match (1u32 << k, (2u32 << k) - 1) {
        (1, _) => "1".to_owned(),
        (from, to) => format!("{from} to {to}"),
    })
}

/// The greatest difference of a channel to the picture by the most precise policies.
pub(super) fn error(
    (model, camera, options): Of<'_>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(Image, Legend), Error> {
    let precise =
        RenderOptions { policies: Policies::default(), depth: DepthFormat::F32Reversed, ..*options };
    let found = render(model, camera, options, progress)?.image.texels;
    let expected = render(model, camera, &precise, progress)?.image.texels;
    // Things that only one of the two has are differences as well.
    let [of_found, of_expected] = [probe(model, camera, options)?, probe(model, camera, &precise)?];
    // The least difference is seen beside none.
    let mut steps = vec![nothing(), Step::new(along(0, 11), "0, the same")];
    steps.extend(doubling(128).enumerate().map(|(k, meaning)| Step::new(along(k + 3, 11), meaning)));
    let title = "error of each pixel: greatest difference of a channel to exact, float, f32-reversed, rgba8, \
                 subpixel 8, in steps of 1/255";
    paint(options, [title, "difference of a pixel"], steps, |index| {
        if of_found.shaded(index) + of_expected.shaded(index) == 0 {
            return Number::none(0);
        }
        let difference = |k: usize| found[index][k].abs_diff(expected[index][k]);
        let greatest = difference(0).max(difference(1)).max(difference(2));
        Number::new(greatest.checked_ilog2().map_or(1, |log| log as usize + 2), greatest.into())
    })
}

/// The level of detail of the surface's texture.
pub(super) fn lod((model, camera, options): Of<'_>) -> Result<(Image, Legend), Error> {
    /// The greys of magnification, and the λ down to which each goes.
    const GREYS: [([u8; 3], f32, &str); 4] = [
        ([0xd0; 3], -1.0, "-1 to 0, magnified"),
        ([0xac; 3], -2.0, "-2 to -1, magnified"),
        ([0x88; 3], -4.0, "-4 to -2, magnified"),
        ([0x64; 3], f32::NEG_INFINITY, "below -4, magnified"),
    ];
    const UNTEXTURED: [u8; 3] = [0xf4, 0xcc, 0xd8];
    let probes = probe(model, camera, options)?;
    let sides = model.parts.iter().filter_map(|part| model.textures.get(part.texture?));
    let levels = sides.map(|image| image.width.max(image.height).ilog2().max(1)).max().unwrap_or(1) as usize;
    let mut steps = vec![nothing(), Step::new(UNTEXTURED, "no texture")];
    steps.extend(GREYS.iter().rev().map(|(grey, _, meaning)| Step::new(*grey, *meaning)));
    let first = steps.len();
    steps.extend((1..levels).map(|k| Step::new(along(k - 1, levels), format!("{} to {k}", k - 1))));
    steps.push(Step::new(
        along(levels - 1, levels),
        format!("{} and more; the last level is {levels}", levels - 1),
    ));
    let title = "lod: level of detail of the surface's texture, 1 for two texels a pixel, 2 for four, ...";
    paint(options, [title, "level of a pixel"], steps, |index| {
        let Some(seen) = probes.seen(index) else { return Number::none(0) };
        let Some(lod) = seen.lod else { return Number::none(1) };
        let grey = GREYS.iter().position(|(_, down_to, _)| lod > *down_to).unwrap_or(GREYS.len() - 1);
        let step = match lod {
            lod if lod <= 0.0 => first - 1 - grey,
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 64")]
            lod => first + (lod.ceil() as usize - 1).min(levels - 1),
        };
        Number::new(step, lod)
    })
}

/// The fragments that are shaded.
pub(super) fn overdraw((model, camera, options): Of<'_>) -> Result<(Image, Legend), Error> {
    /// The least number of each step.
    const FROM: [u32; 7] = [1, 2, 3, 4, 6, 10, 20];
    let probes = probe(model, camera, options)?;
    let mut steps = vec![nothing()];
    let next = FROM[1..].iter().map(Some).chain([None]);
    steps.extend(FROM.iter().zip(next).enumerate().map(|(k, (from, next))| {
        let meaning = match next {
            Some(next) if next - from == 1 => from.to_string(),
            Some(next) => format!("{from} to {}", next - 1),
            None => format!("{from} and more"),
        };
        Step::new(along(k, FROM.len()), meaning)
    }));
    let title = "overdraw: fragments that are shaded, of which the last is seen";
    let (image, mut legend) =
        paint(options, [title, "fragments of a pixel"], steps, |index| match probes.shaded(index) {
            0 => Number::none(0),
            #[expect(clippy::cast_precision_loss, reason = "for a legend")]
            shaded => Number::new(FROM.partition_point(|from| *from <= shaded), shaded as f32),
        })?;
    legend.notes.push(sums(&probes));
    Ok((image, legend))
}

/// The fragments of a picture.
fn sums(probes: &Probes) -> String {
    let sum = |of: &dyn Fn(usize) -> u32| (0..probes.pixels()).map(|index| u64::from(of(index))).sum::<u64>();
    let (shaded, seen) = (sum(&|index| probes.shaded(index)), sum(&|index| probes.shaded(index).min(1)));
    let hidden = sum(&|index| probes.covered(index)) - shaded;
    format!("{shaded} fragments shaded for {seen} pixels, {hidden} more hidden by the depth test")
}

/// Each triangle in a colour of its own.
pub(super) fn triangles((model, camera, options): Of<'_>) -> Result<(Image, Legend), Error> {
    let probes = probe(model, camera, options)?;
    let mut sizes: HashMap<u32, u32> = HashMap::new();
    for seen in (0..probes.pixels()).filter_map(|index| probes.seen(index)) {
        *sizes.entry(seen.triangle).or_default() += 1;
    }
    let greatest = sizes.values().copied().max().unwrap_or(1);
    let mut steps = vec![nothing()];
    let plural = |meaning: &str| if meaning == "1" { "" } else { "s" };
    let unit = |meaning: String| format!("triangles of {meaning} pixel{}", plural(&meaning));
    steps.extend(doubling(greatest).map(|meaning| Step::colorless(unit(meaning))));
    let title = "triangles: each in a colour of its own, made of its number";
    let (image, mut legend) =
        paint(options, [title, "pixels of a triangle"], steps, |index| match probes.seen(index) {
            None => Number::none(0),
            Some(seen) => {
                let size = sizes.get(&seen.triangle).copied().unwrap_or(1);
                Number { color: Some(color(seen.triangle)), ..Number::none(1 + size.ilog2() as usize) }
            }
        })?;
    #[expect(clippy::cast_precision_loss, reason = "for a legend")]
    let mut sizes: Vec<_> = sizes.into_values().map(|size| size as f32).collect();
    legend.numbers = (sizes.len(), three(&mut sizes));
    let all: usize = model.parts.iter().map(|part| part.triangles.len()).sum();
    legend.notes.push(format!("{} of {all} triangles are seen", sizes.len()));
    Ok((image, legend))
}

/// A colour for each number below 2^24: steps that can be undone, so that no two are the same. Those of neighbours
/// differ in lightness too.
fn color(number: u32) -> [u8; 3] {
    const MASK: u32 = 0xff_ffff;
    let mix = |x: u32, factor: u32| {
        let x = x.wrapping_mul(factor) & MASK;
        x ^ x >> 12
    };
    let [_, r, g, b] = mix(mix(number.wrapping_add(1), 0x9e_3779), 0x85_ebcb).to_be_bytes();
    if [r, g, b] == NOTHING { [0; 3] } else { [r, g, b] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn colours_of_triangles_are_their_own() {
        let colors: HashSet<_> = (0..1 << 20).map(color).collect();
        assert_eq!(colors.len(), 1 << 20);
    }

    #[test]
    fn powers_of_two_have_no_gaps() {
        let all: Vec<_> = doubling(8).collect();
        assert_eq!(all, ["1", "2 to 3", "4 to 7", "8 to 15"]);
    }
}
