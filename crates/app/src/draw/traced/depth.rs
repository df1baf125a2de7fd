//! A depth format that shows every fragment, and remembers how each would have fared in the format that it wraps.

use alberti::lanes::Lanes;
use alberti::{AnyDepth, DepthFormat};

/// The format.
#[derive(Clone, Copy, Debug)]
pub(super) struct TracedDepth(pub(super) AnyDepth);

/// The most fragments of one triangle that can come to a pixel: those of a fan that folds.
const MOST: usize = 8;

/// A fragment's depth test.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Test {
    /// The bits of the depth before it was brought to the format.
    pub(super) zs: u32,
    /// The format's word.
    pub(super) word: u32,
    /// The word that was stored before.
    pub(super) before: u32,
    pub(super) seen: bool,
}

/// The pixel: the word that the format would hold, and the tests since the last look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trace {
    kept: u32,
    /// Of a new depth its own, which is no test yet.
    tests: [Test; MOST],
    count: usize,
}

impl Trace {
    /// The pixel of a cleared buffer.
    pub(super) fn cleared(format: AnyDepth) -> Self {
        Self { kept: format.farthest(), tests: [Test::default(); MOST], count: 0 }
    }

    /// The tests since the last look.
    pub(super) fn take(&mut self) -> impl Iterator<Item = Test> + use<> {
        let count = std::mem::take(&mut self.count);
        self.tests.into_iter().take(count)
    }

    /// A depth on its way to the buffer.
    fn new(zs: u32, word: u32) -> Self {
        let mut tests = [Test::default(); MOST];
        tests[0] = Test { zs, word, ..Test::default() };
        Self { kept: word, tests, count: 0 }
    }

    fn test(&mut self, format: AnyDepth, new: &Self) {
        let [Test { zs, word, .. }, ..] = new.tests;
        let (before, seen) = (self.kept, format.nearer(word, self.kept));
        if seen {
            self.kept = word;
        }
        if let Some(test) = self.tests.get_mut(self.count) {
            *test = Test { zs, word, before, seen };
            self.count += 1;
        }
    }
}

impl DepthFormat for TracedDepth {
    type Stored = Trace;

    fn reversed(self) -> bool {
        self.0.reversed()
    }

    fn farthest(self) -> Trace {
        Trace::cleared(self.0)
    }

    fn bits(self) -> u32 {
        self.0.bits()
    }

    fn encode(self, zs: f32) -> Trace {
        Trace::new(zs.to_bits(), self.0.encode(zs))
    }

    fn encode_integer(self, zs: u32) -> Trace {
        Trace::new(zs, self.0.encode_integer(zs))
    }

    /// All are shaded.
    fn nearer(self, _: Trace, _: Trace) -> bool {
        true
    }

    fn keep<L: Lanes>(self, lanes: L, new: &L::Each<Trace>, mask: L::Mask, stored: &mut L::Each<Trace>) {
        let bits = lanes.bits(mask);
        for (k, (stored, new)) in stored.as_mut().iter_mut().zip(new.as_ref()).enumerate() {
            if bits >> k & 1 != 0 {
                stored.test(self.0, new);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_are_those_of_the_format() {
        let format = TracedDepth(AnyDepth::D16);
        let mut pixel = Trace::cleared(format.0);
        for zs in [0.5, 0.75, 0.25, 0.25] {
            let new = format.encode(zs);
            format.keep(alberti::lanes::One, &[new], true, std::array::from_mut(&mut pixel));
        }
        let tests: Vec<_> = pixel.take().collect();
        assert_eq!(tests.iter().map(|test| test.seen).collect::<Vec<_>>(), [true, false, true, false]);
        assert_eq!(tests.iter().map(|test| test.word).collect::<Vec<_>>(), [0x8000, 0xbfff, 0x4000, 0x4000]);
        assert_eq!(
            tests.iter().map(|test| test.before).collect::<Vec<_>>(),
            [0xffff, 0x8000, 0x8000, 0x4000]
        );
        assert_eq!(pixel.take().count(), 0);
    }
}
