//! `array::map`, inlined: in programs that are made for size, that of `core` becomes a loop through memory. Closures
//! inlined: what works on vectors is only compiled for them where it is in line.

/// The closure as it is: an argument may say `#[inline(always)]`, which a reference to a closure cannot.
#[inline(always)]
pub fn in_line<F>(closure: F) -> F {
    closure
}

/// Both mapped.
#[inline(always)]
pub fn map2<T, U>([a, b]: [T; 2], f: impl Fn(T) -> U) -> [U; 2] {
    [f(a), f(b)]
}

/// All three mapped.
#[inline(always)]
pub fn map3<T, U>([a, b, c]: [T; 3], f: impl Fn(T) -> U) -> [U; 3] {
    [f(a), f(b), f(c)]
}

/// All four mapped.
#[inline(always)]
pub fn map4<T, U>([a, b, c, d]: [T; 4], f: impl Fn(T) -> U) -> [U; 4] {
    [f(a), f(b), f(c), f(d)]
}

/// All mapped, however many: the results take the places of `nothing`.
#[inline(always)]
pub fn each<T: Copy, U: Copy, const N: usize>(values: [T; N], nothing: U, f: impl Fn(T) -> U) -> [U; N] {
    let mut found = [nothing; N];
    for (found, value) in found.iter_mut().zip(&values) {
        *found = f(*value);
    }
    found
}

/// All pairs of one of each mapped: [`each`] of two.
#[inline(always)]
pub fn each_pair<S: Copy, T: Copy, U: Copy, const N: usize>(
    first: [S; N],
    second: [T; N],
    nothing: U,
    f: impl Fn(S, T) -> U,
) -> [U; N] {
    let mut found = [nothing; N];
    for ((found, first), second) in found.iter_mut().zip(&first).zip(&second) {
        *found = f(*first, *second);
    }
    found
}
