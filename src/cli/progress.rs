//! A line on standard error that says how far long work is, where that is a terminal.

use std::io::{self, IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// How many signs a full bar has.
const WIDTH: usize = 30;

/// The line, which comes up only when the work takes long.
pub(super) struct Progress {
    begun: Instant,
    next: Option<Instant>,
    shown: bool,
}

impl Progress {
    const PATIENCE: Duration = Duration::from_secs(1);
    const REFRESH: Duration = Duration::from_millis(100);

    /// Nothing is shown where standard error is no terminal.
    pub(super) fn new() -> Self {
        let begun = Instant::now();
        let next = io::stderr().is_terminal().then(|| begun + Self::PATIENCE);
        Self { begun, next, shown: false }
    }

    /// Never shows anything.
    pub(super) fn hidden() -> Self {
        Self { begun: Instant::now(), next: None, shown: false }
    }

    /// Shows `line` in place of the last one, where that is due.
    pub(super) fn show(&mut self, line: impl FnOnce() -> String) {
        let now = Instant::now();
        if self.next.is_some_and(|next| now >= next) {
            let _ = write!(io::stderr(), "\r{}\u{1b}[K", line());
            self.next = Some(now + Self::REFRESH);
            self.shown = true;
        }
    }

    /// Shows a bar: `done` of `all`, and how long the rest will take at this pace.
    pub(super) fn show_bar(&mut self, done: usize, all: usize, what: &str) {
        let elapsed = self.begun.elapsed();
        self.show(|| {
            let part = if all == 0 { 1.0 } else { done as f64 / all as f64 };
            let full = WIDTH * done / all.max(1);
            let bar: String = (0..WIDTH).map(|i| if i < full { '█' } else { '░' }).collect();
            let left = if done == 0 {
                String::new()
            } else {
                format!(", {} left", duration(elapsed.as_secs_f64() * (1.0 - part) / part))
            };
            format!("{bar} {done} of {all} {what}{left} ")
        });
    }

    /// Takes the line away.
    pub(super) fn clear(&mut self) {
        if std::mem::take(&mut self.shown) {
            let _ = write!(io::stderr(), "\r\u{1b}[K");
        }
    }
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 99.5 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::duration;

    #[test]
    fn durations_are_short() {
        assert_eq!([0.3, 99.0, 100.0, 5399.0, 36_000.0].map(duration), ["0 s", "99 s", "2 min", "90 min", "10.0 h"]);
    }
}
