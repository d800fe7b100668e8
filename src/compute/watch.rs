//! Whether a worker is still there. Workers that end or hang say nothing: now and then one is asked for a sign of life.

use std::time::Duration;

/// A worker is asked no more often than this.
const PAUSE: Duration = Duration::from_secs(1);
/// One that has been silent for so long is lost. Its longest step between two looks at its inbox, the eigenvalues of the
/// largest robot, takes a fraction of this.
const PATIENCE: Duration = Duration::from_secs(10);
/// One that has never answered may still be on its way over a slow network.
const START_PATIENCE: Duration = Duration::from_secs(40);
/// Time between two calls counts up to this: a page may sleep, and its worker with it.
const LONGEST_STEP: Duration = Duration::from_secs(1);

/// Watches one worker.
#[derive(Debug, Default)]
pub struct Watch {
    /// When it was called last.
    seen: Duration,
    /// When the worker was asked last.
    asked: Option<Duration>,
    /// For how long the worker has owed an answer, where it does.
    silent: Option<Duration>,
    alive: bool,
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

impl Watch {
    /// The worker has answered.
    pub fn heard(&mut self) {
        self.silent = None;
        self.alive = true;
    }

    /// It is `now`, on a clock that never goes back.
    pub fn go_on(&mut self, now: Duration) -> Sign {
        let step = now.saturating_sub(self.seen).min(LONGEST_STEP);
        self.seen = now;
        if let Some(silent) = &mut self.silent {
            *silent += step;
            let patience = if self.alive { PATIENCE } else { START_PATIENCE };
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
        let mut now = from;
        loop {
            now += TENTH;
            match watch.go_on(now) {
                Sign::Wait => assert!(now < from + Duration::from_secs(100), "nothing happens"),
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
    fn a_page_that_slept_gives_its_worker_time() {
        let mut watch = Watch::default();
        watch.go_on(TENTH);
        watch.heard();
        assert_eq!(watch.go_on(Duration::from_secs(5)), Sign::Ask);
        assert_eq!(watch.go_on(Duration::from_secs(50_000)), Sign::Wait);
    }
}
