//! Whether a worker is still there. A worker that ends or hangs says nothing, so now and then it is asked for a sign of
//! life.

use std::time::Duration;

/// The least time between two such questions.
const PAUSE: Duration = Duration::from_secs(1);
/// A worker with a small robot is lost after this silence.
const PATIENCE: Duration = Duration::from_secs(10);
/// With the largest robot (8 cables of 200 elements) it is lost after this time more. A worker usually looks at its inbox
/// every 8 ms; only the dense solver keeps it longer, and its time grows with the robot's size.
const LARGEST_PATIENCE: Duration = Duration::from_mins(5);
const LARGEST: f64 = 1600.0;
/// A worker that has never answered is given this time: its program may still be on its way over a slow network.
const START_PATIENCE: Duration = Duration::from_secs(40);
/// Of the time between two calls no more than this counts: a page may sleep, and its worker with it.
const LONGEST_STEP: Duration = Duration::from_secs(1);

/// Watches one worker.
#[derive(Debug)]
pub struct Watch {
    /// When it was called last.
    seen: Duration,
    /// When the worker was asked last.
    asked: Option<Duration>,
    /// For how long the worker has owed an answer, where it does.
    silent: Option<Duration>,
    alive: bool,
    /// The silence allowed for the robot given last, and for the one that the worker may still be at.
    expected: Duration,
    patience: Duration,
}

/// What to do about the worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Wait.
    Wait,
    /// Ask it for a sign of life.
    Ask,
    /// Give it up.
    Lost,
}

impl Default for Watch {
    fn default() -> Self {
        Self { seen: Duration::ZERO, asked: None, silent: None, alive: false, expected: PATIENCE, patience: PATIENCE }
    }
}

impl Watch {
    /// The worker has answered.
    pub fn heard(&mut self) {
        self.silent = None;
        self.alive = true;
        self.patience = self.expected;
    }

    /// The worker is given a robot with this number of `elements` in all its cables.
    pub fn expect(&mut self, elements: usize) {
        self.expected = PATIENCE + LARGEST_PATIENCE.mul_f64((elements as f64 / LARGEST).min(1.0).powi(2));
        self.patience = self.patience.max(self.expected);
    }

    /// It is `now`, on a clock that never goes back.
    pub fn go_on(&mut self, now: Duration) -> Sign {
        let step = now.saturating_sub(self.seen).min(LONGEST_STEP);
        self.seen = now;
        if let Some(silent) = &mut self.silent {
            *silent += step;
            let patience = if self.alive { self.patience } else { self.patience.max(START_PATIENCE) };
            return if *silent > patience { Sign::Lost } else { Sign::Wait };
        }
        if self.asked.is_some_and(|asked| now.saturating_sub(asked) < PAUSE) {
            return Sign::Wait;
        }
        (self.asked, self.silent) = (Some(now), Some(Duration::ZERO));
        Sign::Ask
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TENTH: Duration = Duration::from_millis(100);

    /// Looks ten times a second from `from` on until there is something to do; when that is, and what.
    fn look(watch: &mut Watch, from: Duration) -> (Duration, Sign) {
        look_for(watch, from, Duration::from_secs(100))
    }

    fn look_for(watch: &mut Watch, from: Duration, longest: Duration) -> (Duration, Sign) {
        let mut now = from;
        loop {
            now += TENTH;
            match watch.go_on(now) {
                Sign::Wait => assert!(now < from + longest, "nothing happens"),
                sign => return (now, sign),
            }
        }
    }

    #[test]
    fn a_worker_that_answers_is_asked_once_a_second() {
        let mut watch = Watch::default();
        let (mut now, mut signs) = (Duration::ZERO, 0);
        while now < Duration::from_mins(1) {
            let (at, sign) = look(&mut watch, now);
            assert_eq!(sign, Sign::Ask);
            watch.heard();
            (now, signs) = (at, signs + 1);
        }
        assert!((55..=61).contains(&signs), "{signs}");
    }

    #[test]
    fn silence_is_a_loss_and_may_last_longer_at_the_start() {
        let mut watch = Watch::default();
        assert_eq!(watch.go_on(TENTH), Sign::Ask);
        let (at, sign) = look(&mut watch, TENTH);
        assert!(sign == Sign::Lost && at > START_PATIENCE, "{sign:?} at {at:?}");

        let mut watch = Watch::default();
        assert_eq!(watch.go_on(TENTH), Sign::Ask);
        watch.heard();
        let (asked, sign) = look(&mut watch, TENTH);
        assert_eq!(sign, Sign::Ask);
        let (at, sign) = look(&mut watch, asked);
        assert!(sign == Sign::Lost && at > asked + PATIENCE && at < asked + 2 * PATIENCE, "{sign:?} at {at:?}");
    }

    #[test]
    fn a_large_robot_takes_longer_and_a_smaller_one_after_it_waits_for_it() {
        let mut watch = Watch::default();
        watch.heard();
        watch.expect(1600);
        assert_eq!(watch.go_on(TENTH), Sign::Ask);
        watch.expect(40);
        let (at, sign) = look_for(&mut watch, TENTH, Duration::from_secs(400));
        assert!(sign == Sign::Lost && at > LARGEST_PATIENCE, "{sign:?} at {at:?}");

        let mut watch = Watch::default();
        watch.expect(1600);
        watch.expect(40);
        watch.heard();
        assert_eq!(watch.go_on(TENTH), Sign::Ask);
        let (at, sign) = look(&mut watch, TENTH);
        assert!(sign == Sign::Lost && at < 2 * PATIENCE, "{sign:?} at {at:?}");
    }

    #[test]
    fn a_page_that_slept_gives_its_worker_time() {
        let mut watch = Watch::default();
        watch.go_on(TENTH);
        watch.heard();
        assert_eq!(watch.go_on(Duration::from_secs(5)), Sign::Ask);
        assert_eq!(watch.go_on(Duration::from_secs(50_000)), Sign::Wait);
    }
}
