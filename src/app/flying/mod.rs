//! The flight along the document's path: what is asked for, what is known of it, and at which moment it is looked at.

mod instant;

pub use instant::{Instant, trace};

use crate::app::studies::StudyRequest;
use crate::flight::FlightOptions;
use crate::robot::Vec2;
use crate::scenario::Scenario;
use crate::study::{Flown, Study};

/// Samples per second of a flight.
const SAMPLES: f64 = 60.0;
/// The least and the most samples of a flight.
const SAMPLE_RANGE: [f64; 2] = [121.0, 1200.0];
/// The platform's error in m: far below what a screen shows, also where deviations are drawn twenty times larger.
const ACCURACY: f64 = 1e-5;
/// The impulse of a kick, in N s, straight up.
const KICK: [f64; 2] = [0.0, 1.0];
/// One step of a flight that is looked at step by step, in s.
const STEP: f64 = 0.05;

/// How a flight is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flying {
    /// The moment on show, in s of the flight.
    pub time: f64,
    /// Seconds of the flight per second of the screen, one of [`Self::TEMPOS`].
    pub tempo: f64,
    /// How many times larger deviations are drawn, one of [`Self::FACTORS`].
    pub factor: u8,
    /// Whether the platform gets a kick at the beginning.
    pub kicked: bool,
}

impl Default for Flying {
    fn default() -> Self {
        Self { time: 0.0, tempo: 1.0, factor: 5, kicked: false }
    }
}

/// What panels do to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Look at this moment, in s.
    Seek(f64),
    /// Go on at this tempo.
    Tempo(f64),
    /// Draw deviations so many times larger.
    Factor(u8),
    /// Kick the platform, or do not.
    Kick(bool),
}

impl Flying {
    /// The tempos with their names.
    pub const TEMPOS: [(f64, &'static str); 3] = [(0.25, "× ¼"), (0.5, "× ½"), (1.0, "× 1")];
    /// How many times larger deviations can be drawn.
    pub const FACTORS: [u8; 5] = [1, 2, 5, 10, 20];

    /// Does what a panel asks for.
    pub fn act(&mut self, action: Action) {
        match action {
            Action::Seek(time) => self.time = time.max(0.0),
            Action::Tempo(tempo) => self.tempo = tempo,
            Action::Factor(factor) => self.factor = factor,
            Action::Kick(kicked) => (self.kicked, self.time) = (kicked, 0.0),
        }
    }

    /// Lets some seconds of the screen pass in a flight up to `end` (s). Whether it goes on: it stops at its end, and begins
    /// anew from there.
    pub fn advance(&mut self, end: f64, seconds: f64) -> bool {
        let begin = if self.time >= end { 0.0 } else { self.time };
        self.time = (begin + seconds * self.tempo).min(end);
        self.time < end
    }

    /// Goes on by so many steps, or back, in a flight up to `end` (s).
    pub fn step(&mut self, end: f64, steps: f64) {
        self.time = (self.time + STEP * steps).clamp(0.0, end);
    }

    /// The flight that is wanted of `scenario`; `None` where there is no path.
    pub fn wanted(&self, scenario: &Scenario) -> Option<StudyRequest> {
        let path = scenario.path.as_ref()?;
        let trajectory = scenario.trajectory().filter(|_| scenario.to_robot().is_ok())?;
        let [least, most] = SAMPLE_RANGE;
        let samples = (SAMPLES * (trajectory.duration() + path.hold)).ceil() + 1.0;
        // Within a small range; a number that is none becomes the least.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let samples = samples.max(least).min(most) as usize;
        let kick = if self.kicked { Vec2::from(KICK) } else { Vec2::zeros() };
        let options = FlightOptions { kick, hold: path.hold, accuracy: ACCURACY, samples, nodes: true };
        Some(StudyRequest::new(scenario, Study::Flight { options }))
    }
}

/// Where the first slack of a flight is, in a sentence.
pub fn slack_text(flown: &Flown) -> Option<String> {
    let slack = flown.flight.slack?;
    Some(format!("Cable {} slack at {:.2} s: doubtful from there.", slack.cable + 1, slack.time))
}

#[cfg(test)]
mod tests {
    // Round numbers.
    #![expect(clippy::float_cmp)]

    use super::*;
    use crate::scenario::{Corners, Path, ProfileKind, presets};

    fn with_path() -> Scenario {
        let path = Path {
            points: vec![[6.0, 0.0]],
            corners: Corners::Stop,
            profile: ProfileKind::Quintic,
            speed: 5.0,
            acceleration: 1.0,
            jerk: 10.0,
            hold: 1.0,
        };
        Scenario { path: Some(path), ..presets::PRESETS[0].scenario() }
    }

    #[test]
    fn a_flight_stops_at_its_end_and_begins_anew_from_there() {
        let mut flying = Flying { tempo: 0.5, ..Flying::default() };
        assert!(flying.advance(2.0, 1.0) && flying.time == 0.5);
        assert!(!flying.advance(2.0, 9.0) && flying.time == 2.0);
        assert!(flying.advance(2.0, 1.0) && flying.time == 0.5);
        flying.step(2.0, -1.0);
        assert_eq!(flying.time, 0.45);
        flying.step(2.0, -100.0);
        assert_eq!(flying.time, 0.0);
        flying.step(2.0, 1000.0);
        assert_eq!(flying.time, 2.0);
        flying.act(Action::Kick(true));
        assert!(flying.kicked && flying.time == 0.0);
    }

    #[test]
    fn a_flight_depends_on_robot_path_and_kick_alone() {
        let scenario = with_path();
        let flying = Flying::default();
        let request = |scenario: &Scenario| flying.wanted(scenario);
        let changes = |edit: &dyn Fn(&mut Scenario)| {
            let mut after = scenario.clone();
            edit(&mut after);
            request(&after) != request(&scenario)
        };
        assert!(!changes(&|s| s.motion.speed = 9.0) && !changes(&|s| s.motion.direction = [0.0, 1.0]));
        assert!(!changes(&|s| s.name = Some("Other".into())));
        assert!(!changes(&|s| s.linearisation = crate::robot::Linearisation::Tangent), "flights are always tangent");
        assert!(changes(&|s| s.motion.position = [-6.0, 0.0]) && changes(&|s| s.damping.alpha *= 2.0));
        assert!(changes(&|s| s.path.as_mut().expect("a path").speed = 4.0));
        assert!(Flying { kicked: true, ..flying }.wanted(&scenario) != request(&scenario));
        let looked_at = Flying { time: 1.0, tempo: 0.25, factor: 20, ..flying };
        assert!(looked_at.wanted(&scenario) == request(&scenario), "how it is looked at changes nothing");
        assert!(flying.wanted(&Scenario { path: None, ..scenario.clone() }).is_none());
        // 6 m at a peak of 5 m/s last 15 · 6/(8 · 5) = 2.25 s, and one more.
        let Some(Study::Flight { options }) = request(&scenario).map(|request| request.study) else { panic!("none") };
        assert_eq!((options.samples, options.hold), (196, 1.0));
    }
}
