//! What a small disturbance becomes when the robot is let go: it dies out, swings up or runs away, again and again.
//!
//! A mode with the eigenvalue λ moves as e^(λ t). What is slow is shown faster and what is fast is shown slower, so that
//! each time takes some seconds of the screen.

use std::f64::consts::TAU;

use crate::app::state::Playback;

/// Faster than this, in Hz, 60 frames per second show no movement but flicker.
const FASTEST: f64 = 6.0;
/// What dies out has done so at this part of where it began.
const DIED_OUT: f64 = 0.02;
/// What dies out begins at this many times the size that is chosen, so that it is seen.
const LARGE: f64 = 2.0;
/// What grows begins at this part of the size that is chosen.
const SMALL: f64 = 0.2;
/// What grows ends at this part of the robot's width.
const GROWN: f64 = 0.25;
/// What grows is computed as if it began at this part of the robot's width at least.
const LEAST_START: f64 = 1e-3;
/// What dies out is looked at for this many seconds of the robot; of a fast one, which is shown slower, for as many of the
/// screen.
const LOOK: [f64; 2] = [4.0, 20.0];
/// Each time takes at most this many seconds of the screen, at the usual tempo.
const LONGEST: f64 = 8.0;
/// Nothing is over before this many seconds of the screen.
const SHORTEST: f64 = 1.0;
/// Seconds of the screen before it begins anew.
const PAUSE: f64 = 0.8;
/// Steps in one oscillation when it is looked at step by step.
const STEPS: f64 = 24.0;
/// No time is longer than this, in seconds of the robot.
const FOR_EVER: f64 = 1e9;

/// How a mode moves once it is let go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// Re λ and Im λ in 1/s.
    eigenvalue: [f64; 2],
    /// The largest displacement at first, as a part of the robot's width.
    start: f64,
    /// How long it moves, in seconds of the robot.
    span: f64,
    /// Seconds of the robot per second of the screen.
    pub tempo: f64,
}

impl Release {
    /// A mode with the eigenvalue [Re λ, Im λ] in 1/s, in the size and at the tempo of `playback`.
    pub fn new([growth, angular]: [f64; 2], playback: &Playback) -> Self {
        let grows = growth > 0.0;
        let start = if grows { (SMALL * playback.amplitude).min(GROWN) } else { LARGE * playback.amplitude };
        // How many times e it becomes larger or smaller, and how long that takes.
        let change = if grows { (GROWN / start.max(LEAST_START)).ln() } else { -DIED_OUT.ln() };
        let lasts = if growth == 0.0 { FOR_EVER } else { (change / growth.abs()).min(FOR_EVER) };
        // The highest tempo at which it can be followed.
        let flicker = if angular == 0.0 { f64::INFINITY } else { TAU * FASTEST / angular.abs() };
        let highest = flicker.min(lasts / SHORTEST);
        let usual = highest.min(1.0);
        let span = if grows { lasts } else { lasts.max(LOOK[0] * usual).min(LOOK[1] * usual) };
        // What can be shown neither fast enough nor to its end is broken off.
        let span = span.min(LONGEST * highest);
        let tempo = (playback.slow_motion * (span / LONGEST).max(1.0)).min(highest);
        Self { eigenvalue: [growth, angular], start, span, tempo }
    }

    /// Where `since`, the seconds of the robot since it was let go, is after some seconds of the screen.
    pub fn after(&self, since: f64, seconds: f64) -> f64 {
        let next = since + seconds * self.tempo;
        // A number that is not one begins anew as well.
        if next < self.span + PAUSE * self.tempo { next } else { 0.0 }
    }

    /// A twenty-fourth of an oscillation in seconds of the robot; of all the time where it does not oscillate.
    pub fn step(&self) -> f64 {
        let whole = if self.eigenvalue[1] == 0.0 { self.span } else { (TAU / self.eigenvalue[1].abs()).min(self.span) };
        whole / STEPS
    }

    /// Where `since` is that many of [these steps](Self::step) later, or earlier.
    pub fn stepped(&self, since: f64, steps: f64) -> f64 {
        let next = since + steps * self.step();
        if next >= 0.0 && next <= self.span { next } else { 0.0 }
    }

    /// Start times e^(λ t), as its real and its imaginary part, in parts of the robot's width. It stops at its end.
    pub fn swing(&self, since: f64) -> [f64; 2] {
        let [growth, angular] = self.eigenvalue;
        let since = since.clamp(0.0, self.span);
        let size = (self.start * (growth * since).exp()).min(GROWN.max(self.start));
        let (sine, cosine) = (angular * since).sin_cos();
        [size * cosine, size * sine]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn release(eigenvalue: [f64; 2]) -> Release {
        Release::new(eigenvalue, &Playback::default())
    }

    /// The sizes of one time, from letting go to the next, at 60 frames per second, and how long it takes on the screen.
    fn watched(release: &Release) -> (Vec<f64>, f64) {
        let (mut sizes, mut since) = (Vec::new(), 0.0);
        loop {
            let [x, y] = release.swing(since);
            sizes.push(x.hypot(y));
            let next = release.after(since, 1.0 / 60.0);
            if next < since || sizes.len() > 10_000 {
                break;
            }
            since = next;
        }
        let seconds = sizes.len() as f64 / 60.0;
        (sizes, seconds)
    }

    /// The paper's robot at 5 m/s: −0.26 + 1.98 i. In the end 2 % are left of it: after 15.0 s, which are shown in 8.
    #[test]
    fn what_is_stable_comes_to_rest() {
        let (sizes, seconds) = watched(&release([-0.26, 1.98]));
        assert!((sizes[0] - 0.06).abs() < 1e-12 && sizes.windows(2).all(|pair| pair[1] <= pair[0]), "{sizes:?}");
        let last = sizes[sizes.len() - 1];
        assert!((last / sizes[0] - 0.02).abs() < 1e-6, "{last}");
        assert!((seconds - 8.8).abs() < 0.1, "{seconds}");
        assert!((release([-0.26, 1.98]).tempo - 50_f64.ln() / 0.26 / 8.0).abs() < 1e-9);
        // In real time where there is no need to hurry: 2 % are left after 5.6 s.
        assert!((release([-0.7, 3.0]).tempo - 1.0).abs() < 1e-12);
        assert!((watched(&release([-0.7, 3.0])).1 - 5.59 - 0.8).abs() < 0.1);
        // Four seconds at least.
        assert!((watched(&release([-2.0, 3.0])).1 - 4.8).abs() < 0.1);
    }

    /// The paper's robot at 12 m/s doubles every 8.9 s. From 0.6 % to 25 % of its width it is 48 s, which are shown in 8.
    #[test]
    fn flutter_swings_up() {
        let flutter = release([0.078, 1.36]);
        let (sizes, seconds) = watched(&flutter);
        assert!((sizes[0] - 0.006).abs() < 1e-12 && sizes.windows(2).all(|pair| pair[1] >= pair[0]));
        assert!((sizes[sizes.len() - 1] - 0.25).abs() < 1e-9 && (seconds - 8.8).abs() < 0.1, "{seconds}");
        // It swings: its real part goes through zero again and again.
        let signs: Vec<bool> = (0..480).map(|i| flutter.swing(f64::from(i) * 0.1)[0] > 0.0).collect();
        assert!(signs.windows(2).filter(|pair| pair[0] != pair[1]).count() > 15);
    }

    #[test]
    fn divergence_runs_away_without_swinging() {
        let divergence = release([0.5, 0.0]);
        let places: Vec<[f64; 2]> = (0..200).map(|i| divergence.swing(f64::from(i) * 0.05)).collect();
        assert!(places.iter().all(|place| place[1] == 0.0));
        assert!(places.windows(2).all(|pair| pair[1][0] >= pair[0][0]) && places[0][0] > 0.0);
        assert!((places[199][0] - 0.25).abs() < 1e-9);
        // Also where it is over in a moment.
        assert!((1.5..2.0).contains(&watched(&release([900.0, 0.0])).1));
    }

    /// Whatever the eigenvalue, size and tempo: bounded, on the screen for some seconds, without flicker, and numbers.
    #[test]
    fn every_mode_can_be_watched() {
        let rates = [0.0, 1e-300, 1e-12, 1e-3, 0.1, 3.0, 1e3, 1e9];
        for growth in rates.into_iter().flat_map(|rate| [rate, -rate]) {
            for angular in [0.0, 1e-9, 0.2, 1.98, 40.0, 6e4, 1e12] {
                for (amplitude, slow_motion) in [(0.03, 1.0), (0.0, 1.0), (0.1, 2.0), (0.03, 0.02)] {
                    let playback = Playback { amplitude, slow_motion, ..Playback::default() };
                    let release = Release::new([growth, angular], &playback);
                    let what = format!("{growth}, {angular}, {amplitude}, {slow_motion}: {release:?}");
                    assert!(release.tempo > 0.0 && release.tempo.is_finite() && release.step() > 0.0, "{what}");
                    assert!(release.tempo * angular <= TAU * 6.000_001, "{what}");
                    for part in 0..=20 {
                        let swing = release.swing(release.span * f64::from(part) / 19.0);
                        assert!(swing[0].hypot(swing[1]) <= 0.250_001, "{what}: {swing:?}");
                    }
                    if slow_motion >= 1.0 {
                        let on_screen = release.span / release.tempo;
                        assert!(on_screen <= 8.000_001 && on_screen > 0.45, "{on_screen} s: {what}");
                    }
                    assert!(release.after(f64::NAN, 0.1) == 0.0, "{what}");
                }
            }
        }
    }

    #[test]
    fn steps_go_to_and_fro() {
        let flutter = release([0.078, 1.36]);
        let one = TAU / 1.36 / 24.0;
        assert!((flutter.stepped(1.0, 2.0) - 1.0 - 2.0 * one).abs() < 1e-12);
        assert!((flutter.stepped(1.0, -2.0) - 1.0 + 2.0 * one).abs() < 1e-12);
        assert!((flutter.stepped(0.1, -9.0), flutter.stepped(1e6, 1.0)) == (0.0, 0.0));
    }
}
