//! How much a test looks at: some, or with `cargo xtask sweep` as much as has been asked for once.

/// The second of two, with `cargo xtask sweep`.
#[must_use]
pub fn or_swept<T>(some: T, all: T) -> T {
    if std::env::var_os("ALBERTI_SWEEP").is_some() { all } else { some }
}
