//! A small seeded generator, so that every random test can be run again from the seed that it printed.

/// The seed of every run that does not ask for another one.
pub const FIXED_SEED: u64 = 0x0A1B_E271_1435_2026;

/// The seed of this run: the environment variable `ALBERTI_SEED` (decimal, or hexadecimal after `0x`), or
/// [`FIXED_SEED`].
///
/// It is printed, so that a failing test shows how to run it again.
///
/// # Panics
/// When the variable is set but is not a number: falling back in silence would run another test than the one asked for.
#[must_use]
pub fn run_seed() -> u64 {
    let seed = match std::env::var("ALBERTI_SEED") {
        Ok(text) => parse_seed(&text)
            .unwrap_or_else(|| panic!("ALBERTI_SEED is {text:?}; expected a u64 such as 42 or 0x2a")),
        Err(_) => FIXED_SEED,
    };
    println!("ALBERTI_SEED={seed:#x}");
    seed
}

/// xoshiro256** of Blackman and Vigna, its state filled by splitmix64.
#[derive(Clone, Debug)]
pub struct Rng {
    state: [u64; 4],
    tape: Option<Tape>,
}

/// What a generator gave, to be given again.
#[derive(Clone, Debug)]
struct Tape {
    numbers: Vec<u64>,
    /// So many of these have been given.
    given: usize,
}

impl Rng {
    /// A generator whose whole sequence follows from `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut mix = seed;
        Self { state: std::array::from_fn(|_| split_mix(&mut mix)), tape: None }
    }

    /// A generator that gives these numbers, and then those of another one. It keeps what it gives.
    #[must_use]
    pub fn replay(numbers: Vec<u64>, then: Self) -> Self {
        Self { tape: Some(Tape { numbers, given: 0 }), ..then }
    }

    /// The numbers that a [replaying](Self::replay) generator has given; none of others.
    #[must_use]
    pub fn into_tape(self) -> Vec<u64> {
        self.tape.map_or_else(Vec::new, |Tape { mut numbers, given }| {
            numbers.truncate(given);
            numbers
        })
    }

    /// A generator for the `index`-th independent piece of work under `seed`.
    #[must_use]
    pub fn stream(seed: u64, index: u64) -> Self {
        let mut mix = index;
        Self::new(seed ^ split_mix(&mut mix))
    }

    /// 64 uniform bits.
    pub fn u64(&mut self) -> u64 {
        let Some(mut tape) = self.tape.take() else { return self.next() };
        if tape.given == tape.numbers.len() {
            tape.numbers.push(self.next());
        }
        let number = tape.numbers[tape.given];
        tape.given += 1;
        self.tape = Some(tape);
        number
    }

    fn next(&mut self) -> u64 {
        let s = &mut self.state;
        let result = s[1].wrapping_mul(5).rotate_left(7).wrapping_mul(9);
        let shifted = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= shifted;
        s[3] = s[3].rotate_left(45);
        result
    }

    /// An integer in `low..=high`, uniform up to a bias of `2^-64` times the number of values.
    ///
    /// # Panics
    /// When `low > high`.
    pub fn range(&mut self, low: i64, high: i64) -> i64 {
        assert!(low <= high, "an empty range: {low}..={high}");
        let count = (i128::from(high) - i128::from(low) + 1) as u128;
        let offset = (u128::from(self.u64()) * count) >> 64;
        (i128::from(low) + offset as i128) as i64
    }

    /// An index below `count`, which must not be zero.
    pub fn index(&mut self, count: usize) -> usize {
        assert!(count > 0, "no index lies below zero");
        self.range(0, count as i64 - 1) as usize
    }

    /// True once in `n` calls on average.
    pub fn one_in(&mut self, n: u64) -> bool {
        self.u64().is_multiple_of(n)
    }

    /// Uniform in `[0, 1)`, a multiple of `2^-53`.
    pub fn unit(&mut self) -> f64 {
        (self.u64() >> 11) as f64 * (-53f64).exp2()
    }

    /// Uniform between `low` and `high`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A positive magnitude whose logarithm is uniform: every scale between `low` and `high` is met equally often.
    pub fn log_uniform(&mut self, low: f32, high: f32) -> f32 {
        assert!(0.0 < low && low <= high, "a logarithmic range is positive");
        let exponent = self.uniform(f64::from(low).ln(), f64::from(high).ln());
        (exponent.exp() as f32).clamp(low, high)
    }

    /// An integer in `1..=high` whose logarithm is about uniform.
    pub fn log_integer(&mut self, high: i64) -> i64 {
        assert!(high >= 1, "no positive integer up to {high}");
        let value = self.uniform(0.0, (high as f64 + 1.0).ln()).exp();
        (value as i64).clamp(1, high)
    }

    /// Any f32 at all: NaN, infinities, subnormals and both zeros included.
    pub fn any_f32(&mut self) -> f32 {
        f32::from_bits(self.u64() as u32)
    }

    /// Any finite f32.
    pub fn finite_f32(&mut self) -> f32 {
        loop {
            let value = self.any_f32();
            if value.is_finite() {
                return value;
            }
        }
    }
}

fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

fn parse_seed(text: &str) -> Option<u64> {
    let text = text.trim();
    match text.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn split_mix_matches_its_published_sequence() {
        // The first outputs of Vigna's splitmix64.c for the seed 1234567.
        let mut state = 1_234_567;
        let got: [u64; 3] = std::array::from_fn(|_| split_mix(&mut state));
        assert_eq!(got, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn xoshiro_matches_its_reference_sequence() {
        // xoshiro256starstar.c from the state 1, 2, 3, 4.
        let mut rng = Rng { state: [1, 2, 3, 4], tape: None };
        let got: [u64; 4] = std::array::from_fn(|_| rng.u64());
        assert_eq!(got, [11_520, 0, 1_509_978_240, 1_215_971_899_390_074_240]);
    }

    #[test]
    fn the_same_seed_gives_the_same_sequence_and_streams_differ() {
        let take = |mut rng: Rng| -> [u64; 8] { std::array::from_fn(|_| rng.u64()) };
        assert_eq!(take(Rng::new(7)), take(Rng::new(7)));
        assert_ne!(take(Rng::new(7)), take(Rng::new(8)));
        assert_ne!(take(Rng::stream(7, 0)), take(Rng::stream(7, 1)));
    }

    #[test]
    fn ranges_reach_both_ends_and_never_leave() {
        let mut rng = Rng::new(FIXED_SEED);
        let mut seen = [0u32; 7];
        for _ in 0..7_000 {
            seen[(rng.range(-3, 3) + 3) as usize] += 1;
        }
        assert!(seen.iter().all(|&n| n > 800), "{seen:?}");
        assert_eq!(rng.range(i64::MIN, i64::MIN), i64::MIN);
        let _ = rng.range(i64::MIN, i64::MAX);
    }

    #[test]
    fn logarithmic_values_meet_every_scale() {
        let mut rng = Rng::new(FIXED_SEED);
        let mut decades = [0u32; 12];
        for _ in 0..12_000 {
            let value = rng.log_uniform(1.0, 1e12);
            assert!((1.0..=1e12).contains(&value));
            decades[(value.log10() as usize).min(11)] += 1;
            assert!((1..=1_000).contains(&rng.log_integer(1_000)));
        }
        assert!(decades.iter().all(|&n| n > 700), "{decades:?}");
    }

    #[test]
    fn seeds_parse_in_both_notations() {
        assert_eq!(parse_seed("42"), Some(42));
        assert_eq!(parse_seed(" 0x2A "), Some(42));
        assert_eq!(parse_seed("forty-two"), None);
    }
}
