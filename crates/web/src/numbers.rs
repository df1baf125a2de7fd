//! Numbers of one type as those of another, and the functions that have to be the same on every machine.

/// A count as a number: exact up to 2^24.
#[expect(clippy::cast_precision_loss, reason = "counts of pixels, vertices and texels are below 2^24")]
pub(crate) const fn float(count: usize) -> f32 {
    count as f32
}

/// A result of `f64` for display.
#[expect(clippy::cast_possible_truncation, reason = "rounded to be displayed")]
pub(crate) const fn narrow(x: f64) -> f32 {
    x as f32
}

/// A number as the nearest byte, from 0 to 255.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
pub(crate) const fn byte(x: f32) -> u8 {
    (x + 0.5) as u8
}

/// A control's position as a whole number: the nearest, from 0 to `greatest`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a range of u32")]
pub(crate) const fn whole(position: f32, greatest: u32) -> u32 {
    let number = (position + 0.5) as u32;
    if number < greatest { number } else { greatest }
}

/// An index as a number of 32 bits: those of meshes here are below 2^24.
#[expect(clippy::cast_possible_truncation, reason = "below 2^24")]
pub(crate) const fn index(k: usize) -> u32 {
    k as u32
}

/// The cosine and the sine of an angle in degrees.
pub(crate) fn turn(degrees: f32) -> [f32; 2] {
    let radians = degrees.to_radians();
    [libm::cosf(radians), libm::sinf(radians)]
}

/// The number whose logarithm to the base 10 is this.
pub(crate) fn power_of_ten(exponent: f32) -> f32 {
    narrow(libm::exp10(f64::from(exponent)))
}
