//! Directed search for the worst case: from the worst of many random ones uphill, by small changes.
//!
//! A case is whatever is made of the numbers that a generator gives. These numbers are changed, one or two at a time,
//! so that every test that draws its cases from a [`Rng`] can be climbed as it is.

use crate::rng::Rng;

/// The greatest error of random cases, and of those that were found from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Climbed {
    /// Of the random ones.
    pub random: f64,
    /// Of all.
    pub most: f64,
}

/// The random cases that are climbed from.
const STARTS: usize = 4;

/// Climbs with so many `steps` from each of the worst of so many random `samples`. `error` makes a case of a generator
/// and tells how wrong the answer is; NaN is the worst of all.
///
/// # Panics
/// Without a sample.
pub fn climb(seed: u64, samples: u64, steps: u64, mut error: impl FnMut(&mut Rng) -> f64) -> Climbed {
    assert!(samples > 0, "nowhere to climb from");
    let mut measure = |mut rng: Rng| {
        let error = error(&mut rng);
        (if error.is_nan() { f64::INFINITY } else { error }, rng.into_tape())
    };
    let mut worst: Vec<(f64, Vec<u64>)> = Vec::new();
    for index in 0..samples {
        let found = measure(Rng::replay(Vec::new(), Rng::stream(seed, index)));
        let place = worst.partition_point(|(error, _)| *error >= found.0);
        if place < STARTS {
            worst.insert(place, found);
            worst.truncate(STARTS);
        }
    }
    let random = worst[0].0;
    let mut rng = Rng::stream(seed, samples);
    for (error, tape) in &mut worst {
        for index in 0..steps {
            let mut changed = tape.clone();
            (0..=rng.index(2)).for_each(|_| change(&mut changed, &mut rng));
            let found = measure(Rng::replay(changed, Rng::stream(!seed, index)));
            if found.0 >= *error {
                (*error, *tape) = found;
            }
        }
    }
    Climbed { random, most: worst.iter().fold(random, |most, (error, _)| most.max(*error)) }
}

/// Changes a number: by a step of any size, to another one, or to one that is there already.
fn change(tape: &mut [u64], rng: &mut Rng) {
    if tape.is_empty() {
        return;
    }
    let (at, from) = (rng.index(tape.len()), rng.index(tape.len()));
    tape[at] = match rng.index(8) {
        0 => rng.u64(),
        1 => tape[from],
        kind => {
            let step = rng.u64() >> rng.index(64);
            if kind % 2 == 0 { tape[at].wrapping_add(step) } else { tape[at].wrapping_sub(step) }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A summit of which random cases see the foot: three numbers that must all be near one place.
    #[test]
    fn it_gets_higher_than_chance() {
        let hill = |rng: &mut Rng| {
            let away: f64 = [0.1, 0.7, 0.3].iter().map(|top| (rng.unit() - top).abs()).sum();
            1.0 / (1e-6 + away)
        };
        let Climbed { random, most } = climb(1, 1000, 2000, hill);
        assert!(random < 100.0 && most > 50.0 * random, "{random} {most}");
        assert_eq!(climb(1, 10, 5, |rng| if rng.one_in(2) { f64::NAN } else { 0.0 }).most, f64::INFINITY);
    }
}
