//! How far the critical speed on show can be trusted: what the study of meshes says of it.

use crate::app::answers::{Answers, CriticalState};
use crate::app::digits;
use crate::app::series::Meshes;
use crate::app::studies::{Studies, StudyRequest, StudyResults};
use crate::compute::protocol::Topic;
use crate::scenario::Scenario;
use crate::stability::Critical;
use crate::study::Study;
use crate::study::convergence::{Convergence, Extrapolation};

/// What is known of the mesh's error of a design's critical speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Certainty {
    /// Nothing yet: three digits are shown.
    #[default]
    Unknown,
    /// The limit of fine meshes can be told; both numbers are off by this at most.
    Within {
        /// The critical speed, in m/s.
        speed: f64,
        /// Its frequency, in Hz.
        frequency_hz: f64,
        /// What finer meshes lead to.
        limit: Extrapolation,
    },
    /// The meshes looked at do not agree; both numbers are off by this at least.
    NotConverging {
        /// The critical speed, in m/s.
        speed: f64,
        /// Its frequency, in Hz.
        frequency_hz: f64,
    },
}

impl Certainty {
    /// What is known of a design by now.
    pub fn known(scenario: &Scenario, answers: &Answers, studies: &Studies) -> Self {
        let critical = match answers.critical() {
            CriticalState::Current(answer) => answer.critical.as_ref(),
            _ => None,
        };
        let meshes = studies.shown(Topic::Mesh).map(|shown| shown.known);
        critical.zip(meshes).map_or(Self::Unknown, |(critical, meshes)| Self::of(scenario, critical, meshes))
    }

    /// What `known` says of the critical speed of `scenario`, where it is a study of its meshes and complete.
    pub fn of(scenario: &Scenario, critical: &Critical, known: &StudyResults) -> Self {
        let same = match &known.request.study {
            Study::Mesh { counts, .. } => {
                StudyRequest::meshes(scenario, counts.clone()).as_ref() == Some(&known.request)
            }
            _ => false,
        };
        let today = scenario.elements_per_cable;
        let Some(meshes) = Meshes::with(known, today, Some(critical)).filter(|_| same && known.is_complete()) else {
            return Self::Unknown;
        };
        match meshes.limit {
            Convergence::Limit(limit) if limit.error.is_some() => Self::Within {
                speed: (critical.speed - limit.limit).abs() + limit.uncertainty,
                frequency_hz: (critical.frequency_hz() - limit.frequency.limit).abs() + limit.frequency.uncertainty,
                limit,
            },
            _ => {
                let spread = |value: fn(&Critical) -> f64| {
                    let others = meshes.points.iter().filter_map(|(_, verdict)| verdict.critical());
                    others.map(|other| (value(other) - value(critical)).abs()).fold(0.0, f64::max)
                };
                Self::NotConverging { speed: spread(|c| c.speed), frequency_hz: spread(Critical::frequency_hz) }
            }
        }
    }

    /// How far the critical speed may be off, in m/s, where that is known.
    pub fn speed(self) -> Option<f64> {
        match self {
            Self::Unknown => None,
            Self::Within { speed, .. } | Self::NotConverging { speed, .. } => Some(speed),
        }
    }

    /// How far its frequency may be off, in Hz, where that is known.
    pub fn frequency_hz(self) -> Option<f64> {
        match self {
            Self::Unknown => None,
            Self::Within { frequency_hz, .. } | Self::NotConverging { frequency_hz, .. } => Some(frequency_hz),
        }
    }

    /// The same of the speed as a part of it: what to expect of other poses and directions.
    pub fn share(self, critical: &Critical) -> Option<f64> {
        self.speed().map(|speed| speed / critical.speed).filter(|share| share.is_finite())
    }

    /// In a few words, for screen readers; nothing while nothing is known.
    #[cfg(any(test, target_arch = "wasm32"))]
    pub fn note(self, critical: &Critical) -> Option<String> {
        match self {
            Self::Unknown => None,
            // Of a speed that is 0 on every mesh there is no doubt.
            Self::Within { speed, .. } if critical.speed == 0.0 && speed < 1e-6 => None,
            Self::Within { speed, .. } => Some(format!("± {} by the mesh", digits::margin(critical.speed, speed))),
            Self::NotConverging { .. } => Some("not yet converging".into()),
        }
    }

    /// The exact number and what is behind it, for those who ask.
    pub fn explained(self, critical: &Critical, elements: usize) -> String {
        let exact = format!("{} m/s with {elements} elements per cable.", critical.speed);
        match self {
            Self::Unknown => {
                format!("{exact} How far off that is by the mesh is not known yet; three digits are shown.")
            }
            Self::Within { limit, .. } => format!(
                "{exact} Finer meshes lead to {} ± {} m/s.",
                digits::certain(limit.limit, Some(limit.uncertainty)),
                digits::margin(limit.limit, limit.uncertainty)
            ),
            Self::NotConverging { speed, .. } => format!(
                "{exact} Not yet converging: other meshes differ by {} m/s or more, or have no critical speed.",
                digits::certain(speed, Some(0.4 * speed))
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Vec2;
    use crate::scenario::presets;
    use crate::stability::Instability;
    use crate::study::{Answer, Verdict};
    use nalgebra::Complex;
    use std::f64::consts::TAU;

    fn found(speed: f64, kind: Instability) -> Critical {
        let frequency_hz = if kind == Instability::Flutter { 0.27 } else { 0.0 };
        Critical { speed, eigenvalue: Complex::new(0.0, frequency_hz * TAU), kind, cable: 3 }
    }

    fn known(kinds: [Instability; 3], speeds: [f64; 3]) -> (Scenario, StudyResults) {
        let scenario = presets::PRESETS[0].scenario();
        let request = StudyRequest::meshes(&scenario, vec![10, 20, 40]).expect("physical");
        let place = |(speed, kind)| Answer::Critical {
            direction: Vec2::x(),
            verdict: Verdict::Critical(found(speed, kind)),
            wave_limit: None,
        };
        let places = speeds.into_iter().zip(kinds).map(|pair| Some(place(pair))).collect();
        (scenario, StudyResults { request, places, version: (1, 0) })
    }

    #[test]
    fn a_figure_is_as_certain_as_the_meshes_say() {
        let flutter = [Instability::Flutter; 3];
        let (scenario, study) = known(flutter, [11.299, 11.074, 11.014]);
        let critical = found(11.299, Instability::Flutter);
        let certainty = Certainty::of(&scenario, &critical, &study);
        let Certainty::Within { speed, .. } = certainty else { panic!("{certainty:?}") };
        assert!((speed - 0.306).abs() < 0.01, "{speed}");
        assert_eq!(digits::certain(critical.speed, certainty.speed()), "11.3");
        assert!(certainty.explained(&critical, 10).starts_with("11.299 m/s with 10 elements per cable. Finer meshes"));
        // Of another design nothing is known, nor before all meshes are answered.
        let mut other = scenario.clone();
        other.platform.mass = 3.0;
        assert_eq!(Certainty::of(&other, &critical, &study), Certainty::Unknown);
        let mut part = study;
        part.places[2] = None;
        assert_eq!(Certainty::of(&scenario, &critical, &part), Certainty::Unknown);
    }

    #[test]
    fn what_does_not_converge_is_told_without_a_limit() {
        use Instability::{Divergence, Flutter};
        let (scenario, study) = known([Flutter, Flutter, Divergence], [11.299, 11.074, 10.5]);
        let critical = found(11.299, Flutter);
        let certainty = Certainty::of(&scenario, &critical, &study);
        assert!(matches!(certainty, Certainty::NotConverging { .. }), "{certainty:?}");
        assert!(certainty.note(&critical).is_some_and(|note| note == "not yet converging"));
        // The speeds differ by 0.8: that is the least that is in doubt.
        assert_eq!(digits::certain(critical.speed, certainty.speed()), "11");
    }
}
