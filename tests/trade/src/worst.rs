//! The worst place of a policy's pictures, magnified, beside the right one.

use crate::errors::Judged;
use alberti_app::scene::Image;
use std::path::Path;

/// Columns and rows of the place.
const PLACE: [usize; 2] = [48, 36];
/// How many times as large it is shown.
const LARGER: usize = 4;
/// Pixels between the two.
const GAP: usize = 8;

/// The place with the most FLIP: its first column and row.
pub fn place(judged: &Judged) -> [usize; 2] {
    let [width, height] = judged.comparison.measures.size.map(|side| side as usize);
    let flip = &judged.comparison.flip;
    let sum = |[left, top]: [usize; 2]| {
        let rows = (top..top + PLACE[1]).map(|row| &flip[row * width + left..][..PLACE[0]]);
        rows.flatten().map(|&error| f64::from(error)).sum::<f64>()
    };
    let tops = (0..=height - PLACE[1]).step_by(6);
    let places = tops.flat_map(|top| (0..=width - PLACE[0]).step_by(8).map(move |left| [left, top]));
    let mut best = ([0, 0], -1.0);
    for place in places {
        let sum = sum(place);
        if sum > best.1 {
            best = (place, sum);
        }
    }
    best.0
}

/// Writes the place of both pictures, the policy's on the left.
///
/// # Errors
/// The file cannot be written.
pub fn write(judged: &Judged, path: &Path) -> Result<(), image::ImageError> {
    let [left, top] = place(judged);
    let [columns, rows] = PLACE.map(|side| side * LARGER);
    let width = 2 * columns + GAP;
    let mut bytes = vec![0; width * rows * 4];
    let side = |picture: &Image, x: usize, y: usize| {
        picture.texels[(top + y / LARGER) * picture.width as usize + left + x / LARGER]
    };
    for (y, row) in bytes.chunks_exact_mut(width * 4).enumerate() {
        for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
            if x < columns {
                pixel.copy_from_slice(&side(&judged.picture, x, y));
            } else if x >= columns + GAP {
                pixel.copy_from_slice(&side(&judged.right, x - columns - GAP, y));
            }
        }
    }
    let [width, rows] = [width, rows].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    image::save_buffer(path, &bytes, width, rows, image::ColorType::Rgba8)
}
