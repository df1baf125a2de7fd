//! When frames begin.

use embassy_time::{Duration, Instant, Timer, with_timeout};
use embedded_hal_async::digital::Wait;

/// A ticker of frames that none catches up with, and the display's tearing-effect pin.
///
/// Frames are due a period apart. One that is late is due at once, and those after it are counted from there. Each
/// begins as the pin rises after that, which tells that the display begins to read its memory anew.
#[derive(Debug)]
pub struct Pace<T> {
    period: Duration,
    due: Instant,
    tearing: T,
    /// False once the pin has not risen in time: then no frame waits for it again.
    is_wired: bool,
}

impl<T: Wait> Pace<T> {
    /// Frames a `period` apart, counted from the board's start. Within a period the pin has to rise, as it does every
    /// 17 ms on most displays.
    pub const fn new(period: Duration, tearing: T) -> Self {
        Self { period, due: Instant::MIN, tearing, is_wired: true }
    }

    /// Waits until the next frame may begin.
    pub async fn next(&mut self) {
        self.due = self.due.saturating_add(self.period).max(Instant::now());
        Timer::at(self.due).await;
        if self.is_wired {
            let risen = with_timeout(self.period, self.tearing.wait_for_rising_edge()).await;
            self.is_wired = matches!(risen, Ok(Ok(())));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::Rising;
    use core::future::{Future, pending};
    use core::pin::pin;
    use core::task::{Context, Waker};
    use embassy_time::MockDriver;
    use std::sync::{Mutex, PoisonError};
    use std::vec::Vec;

    extern crate std;

    /// The clock, of which there is one for all tests.
    static CLOCK: Mutex<()> = Mutex::new(());
    /// The clock's steps, and the time between frames: microseconds.
    const STEP: u64 = 10;
    const PERIOD: u64 = 33_300;

    /// A pin that never rises.
    fn absent() -> Rising<impl AsyncFnMut()> {
        Rising(async || pending().await)
    }

    /// A pin that rises at multiples of so many microseconds.
    fn rising(every: u64) -> Rising<impl AsyncFnMut()> {
        Rising(async move || {
            let next = (Instant::now().as_micros() / every + 1) * every;
            Timer::at(Instant::from_micros(next)).await;
        })
    }

    /// When each frame begins, in microseconds, if drawing them takes so long. The first begins at a multiple of
    /// `every`.
    fn begins(every: u64, pin: impl Wait, drawing: &[u64]) -> Vec<u64> {
        let _alone = CLOCK.lock().unwrap_or_else(PoisonError::into_inner);
        let advance = |time| MockDriver::get().advance(Duration::from_micros(time));
        let now = Instant::now().as_micros();
        // The clock begins at 0, and frames are due a period after that at the earliest.
        advance(((now + PERIOD) / every + 1) * every - now);
        let mut pace = Pace::new(Duration::from_micros(PERIOD), pin);
        let start = Instant::now().as_micros();
        let mut begins = Vec::new();
        for &time in drawing {
            let mut next = pin!(pace.next());
            let mut context = Context::from_waker(Waker::noop());
            // Timers yield once even where they are due: what is due now takes two polls, with a pin three.
            while (0..3).all(|_| next.as_mut().poll(&mut context).is_pending()) {
                advance(STEP);
                assert!(Instant::now().as_micros() < start + 10_000_000, "a frame does not begin");
            }
            begins.push(Instant::now().as_micros() - start);
            advance(time);
        }
        begins
    }

    #[test]
    fn frames_are_a_period_apart() {
        // The first finds out that there is no pin, and the second is late for that.
        let times = begins(STEP, absent(), &[10_000; 6]);
        let first = PERIOD + 10_000;
        let expected =
            [PERIOD, first, first + PERIOD, first + 2 * PERIOD, first + 3 * PERIOD, first + 4 * PERIOD];
        assert_eq!(times, expected);
    }

    #[test]
    fn late_frames_begin_at_once_and_none_catches_up() {
        let times = begins(STEP, absent(), &[50_000, 0, 0, 120_000, 5_000, 40_000, 0, 0]);
        let second = PERIOD + 50_000;
        let late = second + 2 * PERIOD + 120_000;
        let later = late + PERIOD + 40_000;
        let expected = [PERIOD, second, second + PERIOD, second + 2 * PERIOD, late, late + PERIOD, later];
        assert_eq!(times[..7], expected);
        assert_eq!(times[7], later + PERIOD);
    }

    /// A display's time for a frame.
    const SHOWN: u64 = 16_700;

    #[test]
    fn quick_frames_begin_with_the_display_after_they_are_due() {
        let times = begins(SHOWN, rising(SHOWN), &[10_000; 40]);
        let expected: Vec<u64> = (0..40).map(|frame| (frame * PERIOD / SHOWN + 1) * SHOWN).collect();
        assert_eq!(times, expected);
    }

    /// Of so many frames displayed one is new.
    #[test]
    fn slow_frames_begin_with_the_next_of_the_display() {
        for (drawing, displayed) in [(32_000, 2), (34_000, 3), (45_000, 3), (51_000, 4)] {
            let times = begins(SHOWN, rising(SHOWN), &[drawing; 40]);
            let expected: Vec<u64> = (0..40).map(|frame| SHOWN * (1 + frame * displayed)).collect();
            assert_eq!(times, expected, "{drawing}");
        }
    }

    /// A pin that is as slow as frames is one that is not there.
    #[test]
    fn a_pin_that_does_not_rise_is_waited_for_once() {
        let times = begins(PERIOD * 2, rising(PERIOD * 2), &[1000; 5]);
        let first = PERIOD + 1000;
        assert_eq!(times, [PERIOD, first, first + PERIOD, first + 2 * PERIOD, first + 3 * PERIOD]);
    }
}
