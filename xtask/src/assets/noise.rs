//! Randomness and angles from integers and basic operations alone, so that every machine makes the same pictures.

use std::f64::consts::FRAC_PI_2;

/// A random word for a place: the finalizer of MurmurHash3, once for each number.
pub(super) fn hash(place: [i64; 3], seed: u32) -> u32 {
    let mut word = seed;
    for number in place {
        let mut bits = word.wrapping_mul(0x9E37_79B9) ^ number as u32;
        bits = (bits ^ (bits >> 16)).wrapping_mul(0x85EB_CA6B);
        bits = (bits ^ (bits >> 13)).wrapping_mul(0xC2B2_AE35);
        word = bits ^ (bits >> 16);
    }
    word
}

/// A word as a number from 0 to below 1.
pub(super) fn unit(word: u32) -> f64 {
    f64::from(word) / 4_294_967_296.0
}

/// From 0 at `low` to 1 at `high`, level at both; `low` may be the greater one.
pub(super) fn smooth_step(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// `a` at 0, `b` at 1.
pub(super) fn mix<const N: usize>(a: [f64; N], b: [f64; N], t: f64) -> [f64; N] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

/// Perlin's improved gradient noise, about -1 to 1, that repeats after `period` along each axis.
///
/// Source: Perlin, "Improving noise", SIGGRAPH 2002, with a hash in the place of its table.
pub(super) fn noise(point: [f64; 3], period: i64, seed: u32) -> f64 {
    let low = point.map(f64::floor);
    let corner = low.map(|x| x as i64);
    let within: [f64; 3] = std::array::from_fn(|i| point[i] - low[i]);
    let fade = within.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
    let mut sum = 0.0;
    for index in 0..8 {
        let step = [index & 1, index >> 1 & 1, index >> 2];
        let place = std::array::from_fn(|i| (corner[i] + step[i]).rem_euclid(period));
        let mut weight = 1.0;
        let mut away = [0.0; 3];
        for i in 0..3 {
            weight *= if step[i] == 1 { fade[i] } else { 1.0 - fade[i] };
            away[i] = if step[i] == 1 { within[i] - 1.0 } else { within[i] };
        }
        sum += weight * along_gradient(hash(place, seed), away);
    }
    sum
}

/// The product with one of the vectors from a cube's centre to the middles of its edges.
fn along_gradient(word: u32, [x, y, z]: [f64; 3]) -> f64 {
    let (a, b) = match word >> 4 & 3 {
        0 => (x, y),
        1 => (y, z),
        _ => (z, x),
    };
    (if word & 1 == 0 { a } else { -a }) + if word & 2 == 0 { b } else { -b }
}

/// Octaves of [`noise`], each twice as fine and half as strong as the one before.
pub(super) fn fractal(point: [f64; 3], period: i64, octaves: u32, seed: u32) -> f64 {
    let (mut sum, mut scale, mut share, mut period) = (0.0, 1.0, 0.5, period);
    for octave in 0..octaves {
        sum += share * noise(point.map(|x| x * scale), period, seed.wrapping_add(octave));
        (scale, share, period) = (scale * 2.0, share / 2.0, period * 2);
    }
    sum
}

/// [`fractal`] on a tile from (0, 0) to (1, 1), with so many bumps along each side of it.
pub(super) fn tile([x, y]: [f64; 2], bumps: i64, octaves: u32, seed: u32) -> f64 {
    let scale = bumps as f64;
    fractal([x * scale, y * scale, 0.5], bumps, octaves, seed)
}

/// Where a point lies in a field of irregular cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// The distance to the nearest border, less in corners: they are rounded by a harmonic sum of fourth powers.
    pub(super) border: f64,
    /// From the cell's centre.
    pub(super) offset: [f64; 2],
    /// The cell's own random word.
    pub(super) word: u32,
}

/// The Voronoi cell of a point, of centres that stand about one apart, every other row by a half further on, and leave
/// that place by at most `jitter`; the field repeats after `period`, which is even.
pub(super) fn cell([x, y]: [f64; 2], period: i64, jitter: f64, seed: u32) -> Cell {
    let (column, row) = (x.floor() as i64, y.floor() as i64);
    let mut centres = [([0.0; 2], 0); 25];
    for (slot, step) in centres.iter_mut().zip(0_i64..) {
        let (i, j) = (column + step % 5 - 2, row + step / 5 - 2);
        let word = hash([i.rem_euclid(period), j.rem_euclid(period), 0], seed);
        let shift = [word & 0xFFFF, word >> 16].map(|half| (f64::from(half) / 32_768.0 - 1.0) * jitter);
        let stagger = if j.rem_euclid(2) == 0 { 0.25 } else { 0.75 };
        let centre = [i as f64 + stagger + shift[0], j as f64 + 0.5 + shift[1]];
        *slot = ([centre[0] - x, centre[1] - y], hash([word.into(), 1, 0], seed));
    }
    let square = |[x, y]: [f64; 2]| x * x + y * y;
    let mut nearest = centres[0];
    for centre in centres {
        if square(centre.0) < square(nearest.0) {
            nearest = centre;
        }
    }
    let own = nearest.0;
    let mut near = 0.0;
    for (other, _) in centres {
        let apart = [other[0] - own[0], other[1] - own[1]];
        let length = square(apart).sqrt();
        if length > 1e-9 {
            // To the line halfway between the two centres.
            let to_middle = [f64::midpoint(own[0], other[0]), f64::midpoint(own[1], other[1])];
            let border = ((to_middle[0] * apart[0] + to_middle[1] * apart[1]) / length).max(1e-9);
            near += 1.0 / (border * border * border * border);
        }
    }
    Cell { border: 1.0 / f64::sqrt(f64::sqrt(near)), offset: [-own[0], -own[1]], word: nearest.1 }
}

/// The cosine and the sine of an angle in turns, by Taylor's series.
pub(super) fn turn(t: f64) -> [f64; 2] {
    let quarter = (4.0 * t).round();
    let angle = (4.0 * t - quarter) * FRAC_PI_2;
    let square = angle * angle;
    let series = |first: f64| {
        let (mut sum, mut n) = (1.0, first);
        while n > first - 16.0 {
            sum = 1.0 - sum * square / (n * (n - 1.0));
            n -= 2.0;
        }
        sum
    };
    let (cos, sin) = (series(16.0), angle * series(17.0));
    match quarter as i64 & 3 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// The vector made unit.
pub(super) fn normalized(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_have_their_cosines_and_sines() {
        for step in -1000..1000 {
            let t = f64::from(step) / 500.0;
            let [cos, sin] = turn(t);
            let (sine, cosine) = (t * std::f64::consts::TAU).sin_cos();
            assert!((cos - cosine).abs() < 1e-14 && (sin - sine).abs() < 1e-14, "{t}: {cos} {sin}");
        }
    }

    #[test]
    fn noise_and_cells_repeat() {
        for step in 0..200 {
            let t = f64::from(step) / 16.0;
            let (a, b) = ([t, 0.375, 2.5], [t + 8.0, -7.625, 10.5]);
            assert_eq!(noise(a, 8, 5), noise(b, 8, 5));
            let (a, b) = (cell([t, 1.25], 8, 0.25, 5), cell([t - 8.0, 9.25], 8, 0.25, 5));
            assert_eq!((a.border, a.offset, a.word), (b.border, b.offset, b.word));
        }
    }
}
