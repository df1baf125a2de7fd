//! The origin of a model that is far from its file's own.
//!
//! An f32 has 24 bits, of which coordinates like 4,000,000 leave the third decimal nothing. So positions that are far
//! away, as in maps, are counted from a point among them before they become f32.

/// Coordinates that are at most so many times as large as the model are left as they are: they cost it 4 bits of 24.
const FAR: f64 = 16.0;

/// The point from which to count these positions. It is 0 where that is near enough. Otherwise, it is their middle, to
/// whole multiples of a power of two of about their extent: short numbers stay short.
pub(crate) fn of(positions: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in positions {
        low = [0, 1, 2].map(|axis| low[axis].min(point[axis]));
        high = [0, 1, 2].map(|axis| high[axis].max(point[axis]));
    }
    let extent = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let reach = low.iter().chain(&high).map(|x| x.abs()).fold(0.0, f64::max);
    // Neither of no positions, nor of a single point.
    if !(extent > 0.0 && extent.is_finite() && reach > FAR * extent) {
        return [0.0; 3];
    }
    let unit = extent.log2().floor().exp2();
    [0, 1, 2].map(|axis| (f64::midpoint(low[axis], high[axis]) / unit).round() * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_box(middle: [f64; 3], half: f64) -> [f64; 3] {
        of([-half, half].into_iter().map(|d| middle.map(|x| x + d)))
    }

    #[test]
    fn ordinary_models_keep_their_origin() {
        for middle in [[0.0; 3], [31.0, 0.0, 0.0], [0.0, -31.0, 20.0]] {
            assert_eq!(of_box(middle, 1.0), [0.0; 3]);
        }
        assert_eq!(of([[5e6, 1.0, 1.0]; 2].into_iter()), [0.0; 3]);
        assert_eq!(of(std::iter::empty()), [0.0; 3]);
    }

    #[test]
    fn far_ones_get_a_round_one_among_them() {
        assert_eq!(of_box([500_000.0, 120.0, -4e6], 1.0), [500_000.0, 120.0, -4e6]);
        assert_eq!(of_box([500_000.3, 119.2, -4e6], 2.9), [500_000.0, 120.0, -4e6]);
        assert_eq!(of_box([1.125, 0.0, 0.0], 0.01), [1.125, 0.0, 0.0]);
        for half in [0.001, 0.7, 30.0, 5000.0] {
            let middle = [123_456.789, -1e9, 0.1];
            let origin = of_box(middle, half);
            assert!((0..3).all(|axis| (origin[axis] - middle[axis]).abs() <= half), "{half} {origin:?}");
        }
    }
}
