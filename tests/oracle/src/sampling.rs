//! Textures: from a point `(u, v)` to a colour, by the definition, in f64.

use crate::scene::{Filter, Texture, Wrap};

/// The colour of `texture` at `uv`, in units of a byte and not rounded.
///
/// Row 0 of the texels is the top of the image and `v` points up: the point lies in column `u W` and row `(1 - v) H`.
/// Bilinear weights are exact up to f64 rounding; pipelines with 8-bit weights differ by up to 0.95 for full contrast.
#[must_use]
pub fn sample(texture: &Texture<'_>, uv: [f64; 2], filter: Filter, wrap: Wrap) -> [f64; 3] {
    let x = uv[0] * f64::from(texture.width);
    let y = (1.0 - uv[1]) * f64::from(texture.height);
    match filter {
        Filter::Nearest => texel(texture, x.floor() as i64, y.floor() as i64, wrap),
        Filter::Bilinear => {
            let (x, y) = (x - 0.5, y - 0.5);
            let (column, row) = (x.floor(), y.floor());
            let (fx, fy) = (x - column, y - row);
            let (column, row) = (column as i64, row as i64);
            let mut sum = [0.0; 3];
            for (dx, dy, weight) in [
                (0, 0, (1.0 - fx) * (1.0 - fy)),
                (1, 0, fx * (1.0 - fy)),
                (0, 1, (1.0 - fx) * fy),
                (1, 1, fx * fy),
            ] {
                let tap = texel(texture, column.saturating_add(dx), row.saturating_add(dy), wrap);
                for (sum, tap) in sum.iter_mut().zip(tap) {
                    *sum += weight * tap;
                }
            }
            sum
        }
    }
}

/// The index within `0..size` that stands for `index`.
///
/// # Panics
/// When `size` is zero.
#[must_use]
pub fn wrap_index(index: i64, size: u32, wrap: Wrap) -> u32 {
    let size = i64::from(size);
    let wrapped = match wrap {
        Wrap::Repeat => index.rem_euclid(size),
        Wrap::Clamp => index.clamp(0, size - 1),
        Wrap::Mirror => {
            let folded = index.rem_euclid(2 * size);
            folded.min(2 * size - 1 - folded)
        }
    };
    wrapped as u32
}

fn texel(texture: &Texture<'_>, column: i64, row: i64, wrap: Wrap) -> [f64; 3] {
    let column = wrap_index(column, texture.width, wrap);
    let row = wrap_index(row, texture.height, wrap);
    let [r, g, b, _] = texture.texels[row as usize * texture.width as usize + column as usize];
    [r, g, b].map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXELS: [[u8; 4]; 6] = [
        [0, 0, 0, 255],
        [100, 0, 0, 255],
        [200, 0, 0, 255],
        [0, 50, 0, 255],
        [0, 150, 0, 255],
        [0, 250, 0, 255],
    ];
    const TEXTURE: Texture<'_> = Texture { width: 3, height: 2, texels: &TEXELS };

    #[test]
    fn the_first_row_is_the_top() {
        let at = |u, v| sample(&TEXTURE, [u, v], Filter::Nearest, Wrap::Repeat);
        assert_eq!(at(0.5, 0.9), [100.0, 0.0, 0.0]);
        assert_eq!(at(0.9, 0.1), [0.0, 250.0, 0.0]);
        assert_eq!(at(-0.1, 0.9), [200.0, 0.0, 0.0]);
        assert_eq!(at(0.1, 1.1), [0.0, 50.0, 0.0]);
    }

    #[test]
    fn bilinear_meets_the_texels_at_their_centres_and_the_mean_between() {
        let at =
            |u, v, wrap| sample(&TEXTURE, [u, v], Filter::Bilinear, wrap).map(|c| (c * 1e6).round() / 1e6);
        assert_eq!(at(0.5, 0.75, Wrap::Clamp), [100.0, 0.0, 0.0]);
        assert_eq!(at(1.0 / 3.0, 0.75, Wrap::Clamp), [50.0, 0.0, 0.0]);
        assert_eq!(at(0.5, 0.5, Wrap::Clamp), [50.0, 75.0, 0.0]);
        assert_eq!(at(0.0, 0.75, Wrap::Clamp), [0.0, 0.0, 0.0]);
        assert_eq!(at(0.0, 0.75, Wrap::Mirror), [0.0, 0.0, 0.0]);
        assert_eq!(at(0.0, 0.75, Wrap::Repeat), [100.0, 0.0, 0.0]);
    }

    #[test]
    fn wraps_repeat_clamp_and_reflect() {
        let row = |wrap| (-4..7).map(|i| wrap_index(i, 3, wrap)).collect::<Vec<_>>();
        assert_eq!(row(Wrap::Repeat), [2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0]);
        assert_eq!(row(Wrap::Clamp), [0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2]);
        assert_eq!(row(Wrap::Mirror), [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]);
        assert_eq!(wrap_index(i64::MIN, 5, Wrap::Clamp), 0);
    }

    #[test]
    fn hostile_coordinates_stay_inside() {
        for u in [f64::NAN, f64::INFINITY, -1e300, 1e300] {
            for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                for filter in [Filter::Nearest, Filter::Bilinear] {
                    let _ = sample(&TEXTURE, [u, -u], filter, wrap);
                }
            }
        }
    }
}
