//! The share of a surface that has a shadow: glass little, and holes none.

use crate::options::Wrap;
use crate::scene::{Image, Model, Part};
use alberti::raster::color::AnyBlend;

/// The least area of a triangle from above that has steps, in cells.
const LEAST: f64 = 1e-9;

/// Places on each side of a cell of which the opacity is the mean: nets are finer than cells.
const PLACES: [f64; 6] = [-5.0, -3.0, -1.0, 1.0, 3.0, 5.0];

/// The mean opacity of a part, from 0 to 1, over the cell around texture coordinates. These go by `across` to the next
/// cell in a row, and by `along` to the next row.
pub(super) fn alpha<'a>(
    model: &'a Model,
    part: &'a Part,
    wrap: Wrap,
) -> impl Fn([f64; 2], [[f64; 2]; 2]) -> f64 + 'a {
    let image =
        part.texture.filter(|_| part.detail.is_seen_through()).and_then(|index| model.textures.get(index));
    let wrap = part.detail.wrap.unwrap_or(wrap);
    let texel = move |image: &Image, [u, v]: [f64; 2]| {
        let at = |c: f64, side: u32| {
            let within = match wrap {
                Wrap::Repeat => c.rem_euclid(1.0),
                Wrap::Clamp => c.clamp(0.0, 1.0),
                Wrap::Mirror => 1.0 - (c.rem_euclid(2.0) - 1.0).abs(),
            };
            let share = within * f64::from(side);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
            let texel = share as usize;
            texel.min(side as usize - 1)
        };
        let (column, row) = (at(u, image.width), at(1.0 - v, image.height));
        image.texels.get(row * image.width as usize + column).map_or(255, |[.., alpha]| *alpha)
    };
    move |[u, v], [across, along]| {
        let mean = |of: &dyn Fn(u8) -> f64| {
            let Some(image) = image else { return 1.0 };
            let offsets = PLACES.iter().flat_map(|x| PLACES.iter().map(move |y| [x / 12.0, y / 12.0]));
            let places =
                offsets.map(|[x, y]| [u + x * across[0] + y * along[0], v + x * across[1] + y * along[1]]);
            places.map(|place| of(texel(image, place))).sum::<f64>() / 36.0
        };
        match (part.detail.blend, part.detail.alpha_test) {
            (AnyBlend::Constant(_), _) => 1.0,
            (AnyBlend::Replace, least) => mean(&|alpha| f64::from(u8::from(alpha >= least))),
            (AnyBlend::Over, _) => mean(&|alpha| f64::from(alpha) / 255.0),
            // Light that is added or taken away is no shadow.
            _ => 0.0,
        }
    }
}

/// How far texture coordinates go from one cell to the next, and from one row of cells to the next. Corners are a
/// column, a row, a height and texture coordinates.
pub(super) fn steps([a, b, c]: [[f64; 5]; 3]) -> [[f64; 2]; 2] {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if area.abs() <= LEAST || !area.is_finite() {
        return [[0.0; 2]; 2];
    }
    let along = |k: usize| {
        let [p, q] = [b[k] - a[k], c[k] - a[k]];
        [(p * (c[1] - a[1]) - q * (b[1] - a[1])) / area, (q * (b[0] - a[0]) - p * (c[0] - a[0])) / area]
    };
    let [[ux, uy], [vx, vy]] = [along(3), along(4)];
    [[ux, vx], [uy, vy]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Detail;

    #[test]
    fn opacity_is_that_of_the_texture_or_of_the_blend() {
        let texels = vec![[0, 0, 0, 0], [0, 0, 0, 255], [0, 0, 0, 51], [0, 0, 0, 128]];
        let model =
            Model { textures: vec![Image { width: 2, height: 2, texels }.into()], ..Model::default() };
        let of = |blend: AnyBlend, alpha_test: u8| {
            let mut part = Part { texture: Some(0), ..Part::default() };
            (part.detail.blend, part.detail.alpha_test) = (blend, alpha_test);
            // The upper row, then the lower, and once around.
            [[0.2, 0.9], [0.7, 0.9], [0.2, 0.1], [-0.2, 1.1]]
                .map(|uv| (alpha(&model, &part, Wrap::Repeat)(uv, [[0.0; 2]; 2]) * 255.0).round())
        };
        assert_eq!(of(AnyBlend::Replace, 0), [255.0; 4]);
        assert_eq!(of(AnyBlend::Replace, 100), [0.0, 255.0, 0.0, 255.0]);
        assert_eq!(of(AnyBlend::Over, 0), [0.0, 255.0, 51.0, 128.0]);
        assert_eq!(of(AnyBlend::Constant(51), 0), [255.0; 4]);
        assert_eq!(of(AnyBlend::Additive, 0), [0.0; 4]);
    }

    #[test]
    fn textures_continue_as_on_the_surface() {
        let texels = vec![[0, 0, 0, 0], [0, 0, 0, 255]];
        let model =
            Model { textures: vec![Image { width: 2, height: 1, texels }.into()], ..Model::default() };
        let mut part = Part { texture: Some(0), ..Part::default() };
        part.detail.blend = AnyBlend::Over;
        for (wrap, expected) in [
            (Wrap::Repeat, [0.0, 1.0, 0.0, 1.0]),
            (Wrap::Clamp, [0.0, 1.0, 1.0, 1.0]),
            (Wrap::Mirror, [0.0, 1.0, 1.0, 0.0]),
        ] {
            let found = [0.25, 0.75, 1.25, 1.75].map(|u| alpha(&model, &part, wrap)([u, 0.5], [[0.0; 2]; 2]));
            assert_eq!(found.map(f64::round), expected, "{wrap:?}");
            // The part's own goes before.
            let own = Part { detail: Detail { wrap: Some(wrap), ..part.detail }, ..part.clone() };
            let found =
                [0.25, 0.75, 1.25, 1.75].map(|u| alpha(&model, &own, Wrap::Repeat)([u, 0.5], [[0.0; 2]; 2]));
            assert_eq!(found.map(f64::round), expected, "{wrap:?}");
        }
    }

    /// A net of threads of which each second is none, below and above the size of cells.
    #[test]
    fn a_fine_net_is_its_mean_and_a_coarse_one_is_not() {
        let texels = vec![[0, 0, 0, 0], [0, 0, 0, 255]];
        let model =
            Model { textures: vec![Image { width: 2, height: 1, texels }.into()], ..Model::default() };
        let mut part = Part { texture: Some(0), ..Part::default() };
        (part.detail.blend, part.detail.alpha_test) = (AnyBlend::Replace, 128);
        let alpha = alpha(&model, &part, Wrap::Repeat);
        for start in [0.0, 0.1, 0.37, 0.5, 0.81] {
            for cell in [[[1.0, 0.0], [0.0, 1.0]], [[0.0, 1.0], [1.0, 0.0]], [[5.0, 0.3], [-0.3, 2.0]]] {
                let found = alpha([start, 0.4], cell);
                assert!((found - 0.5).abs() < 0.1, "{found} {start} {cell:?}");
            }
        }
        let cell = [[0.1, 0.0], [0.0, 0.1]];
        let ends = [0.25, 0.75].map(|u| alpha([u, 0.4], cell));
        assert!(ends[0] == 0.0 && ends[1] > 0.999, "{ends:?}");
    }
}
