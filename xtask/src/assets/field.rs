//! Heights on a square tile, and the maps that follow from them.

use super::picture::{Picture, Pixels, byte};

/// Numbers from 0 to 1 on a square tile that repeats, rows from the top.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) side: usize,
    values: Vec<f64>,
}

impl Field {
    /// Of `side * side` numbers, each made from its (u, v), v up.
    pub(super) fn new(side: usize, mut value: impl FnMut([f64; 2]) -> f64) -> Field {
        let centre = |index: usize| (index as f64 + 0.5) / side as f64;
        let values = (0..side * side)
            .map(|index| value([centre(index % side), 1.0 - centre(index / side)]).clamp(0.0, 1.0))
            .collect();
        Field { side, values }
    }

    /// The number at a column and a row of the endless tiling.
    fn at(&self, column: usize, row: usize) -> f64 {
        self.values[row % self.side * self.side + column % self.side]
    }

    /// The number nearest to (u, v), which lie from 0 to 1.
    pub(super) fn look_up(&self, [u, v]: [f64; 2]) -> f64 {
        let side = self.side as f64;
        let [column, row] = [u, 1.0 - v].map(|x| (x * side) as usize);
        self.at(column, row)
    }

    /// The numbers as a picture of bytes.
    pub(super) fn grey(&self) -> Picture {
        let values = self.values.iter().map(|&value| byte(value)).collect();
        Picture { width: self.side, pixels: Pixels::Grey(values) }
    }

    /// The numbers as a picture of 16 bits, of which the last 16 - `bits` repeat the first: noise below what can be
    /// seen would only fill the file.
    pub(super) fn grey16(&self, bits: u32) -> Picture {
        let values = self.values.iter().map(|&value| word(value, bits)).collect();
        Picture { width: self.side, pixels: Pixels::Grey16(values) }
    }

    /// The normals in the tangent frame of a tile that is `relief` times as wide as its heights go from 0 to 1: by
    /// central differences, x to the right and y up, stored as 255 (n + 1) / 2.
    pub(super) fn normals(&self, relief: f64) -> Picture {
        let side = self.side;
        let scale = relief * side as f64 / 2.0;
        let mut normals = Vec::new();
        for row in 0..side {
            for column in 0..side {
                let rise = |a: f64, b: f64| (b - a) * scale;
                let along_u = rise(self.at(column + side - 1, row), self.at(column + 1, row));
                let along_v = rise(self.at(column, row + 1), self.at(column, row + side - 1));
                let normal = super::noise::normalized([-along_u, -along_v, 1.0]);
                normals.push(normal.map(|x| byte(x * 0.5 + 0.5)));
            }
        }
        Picture { width: side, pixels: Pixels::Rgb(normals) }
    }

    /// How open each place is: 1 on what stands out, less in what lies lower than its surroundings, judged by means
    /// over squares from small to large.
    pub(super) fn openness(&self, strength: f64) -> Field {
        let mut values = vec![1.0; self.values.len()];
        for share in [64, 32, 16] {
            let around = self.blurred(self.side / share).blurred(self.side / share);
            for (value, (mean, own)) in values.iter_mut().zip(around.values.iter().zip(&self.values)) {
                *value -= strength / 3.0 * (mean - own).max(0.0);
            }
        }
        values.iter_mut().for_each(|value| *value = value.clamp(0.0, 1.0));
        Field { side: self.side, values }
    }

    /// The means of squares that reach `radius` to each side.
    fn blurred(&self, radius: usize) -> Field {
        self.along_rows(radius).transposed().along_rows(radius).transposed()
    }

    fn along_rows(&self, radius: usize) -> Field {
        let count = (2 * radius + 1) as f64;
        let mean = |index: usize| {
            let (row, column) = (index / self.side, index % self.side + self.side - radius);
            (0..=2 * radius).map(|step| self.at(column + step, row)).sum::<f64>() / count
        };
        Field { side: self.side, values: (0..self.values.len()).map(mean).collect() }
    }

    fn transposed(&self) -> Field {
        let values = (0..self.values.len()).map(|index| self.at(index / self.side, index % self.side));
        Field { side: self.side, values: values.collect() }
    }
}

/// A number from 0 to 1 as 16 bits, of which `bits` are free.
pub(super) fn word(value: f64, bits: u32) -> u16 {
    let greatest = f64::from((1_u32 << bits) - 1);
    let step = (value.clamp(0.0, 1.0) * greatest + 0.5) as u32;
    let high = step << (16 - bits);
    (high | high >> bits) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_has_the_normal_of_its_slope() {
        // Up to the right by 1/8 a tile, but for where the tile ends: (-1/8, 0, 1) made unit.
        let normals = Field::new(16, |[u, _]| u).normals(0.125);
        let Pixels::Rgb(pixels) = normals.pixels else { panic!() };
        assert_eq!(pixels[5 * 16 + 8], [112, 128, 254]);
        let normals = Field::new(16, |[_, v]| v).normals(0.125);
        let Pixels::Rgb(pixels) = normals.pixels else { panic!() };
        assert_eq!(pixels[5 * 16 + 8], [128, 112, 254]);
    }

    #[test]
    fn a_plain_is_open_and_a_pit_is_not() {
        let open = Field::new(64, |[u, v]| if (u - 0.5).abs() + (v - 0.5).abs() < 0.04 { 0.0 } else { 1.0 });
        let open = open.openness(1.0);
        assert!(open.look_up([0.5, 0.5]) < 0.6 && open.look_up([0.0, 0.0]) == 1.0);
    }

    #[test]
    fn sixteen_bits_reach_from_0_to_65535() {
        assert_eq!([0.0, 1.0].map(|x| word(x, 12)), [0, 65535]);
        assert_eq!(word(0.5, 16), 32768);
    }
}
