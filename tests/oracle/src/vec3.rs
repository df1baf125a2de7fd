//! The few vector operations that the renderers need.

/// A vector or a point.
pub(crate) type Vec3 = [f64; 3];

pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Exactly antisymmetric: swapping the factors negates every rounded component.
pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|i| a[i] - b[i])
}

/// The direction of `a`, or zero when it has none.
pub(crate) fn normalize(a: Vec3) -> Vec3 {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|c| c / length) } else { [0.0; 3] }
}

/// The sum of `values` weighted by `weights`.
pub(crate) fn blend<const N: usize>(weights: Vec3, values: [[f64; N]; 3]) -> [f64; N] {
    std::array::from_fn(|i| (0..3).map(|k| weights[k] * values[k][i]).sum())
}
