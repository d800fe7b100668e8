//! The path of a scenario: where the platform flies, and how fast, as a file holds it.

use serde::Serialize;

use crate::robot::{Allowed, Fault, Profile, Trajectory, Vec2};
use crate::scenario::reader::Value;

/// The most points of a path.
pub const MOST_POINTS: usize = 100;
/// A move takes at least and at most so many seconds: beyond, nobody could look at it.
const DURATIONS: std::ops::RangeInclusive<f64> = 1e-6..=1e6;
/// The acceleration in m/s² where a file gives none.
const ACCELERATION: f64 = 1.0;
/// The jerk in m/s³ where a file gives none.
const JERK: f64 = 10.0;

/// How corners are passed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Corners {
    /// Straight from point to point, at rest in each.
    #[default]
    Stop,
    /// Along a cubic spline through all points, without a rest.
    Smooth,
}

/// A motion profile by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ProfileKind {
    /// From rest to rest, [`Profile::Quintic`].
    #[default]
    Quintic,
    /// From rest to rest, [`Profile::Trapezoid`].
    Trapezoid,
    /// From rest to rest, [`Profile::SCurve`].
    Scurve,
    /// At one speed throughout, [`Profile::Constant`].
    Constant,
}

/// A path from the motion's position, with its motion profile. SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Path {
    /// Where it leads in turn, [x, y] in m; it begins at the motion's position.
    pub points: Vec<[f64; 2]>,
    /// How corners are passed.
    pub corners: Corners,
    /// The profile, of each leg where corners are stops.
    pub profile: ProfileKind,
    /// The peak speed in m/s, or the only one.
    pub speed: f64,
    /// In m/s², of trapezoids and S-curves.
    pub acceleration: f64,
    /// In m/s³, of S-curves.
    pub jerk: f64,
    /// How long a flight goes on after the end, in s.
    pub hold: f64,
}

impl Path {
    /// A quintic at `speed` (m/s) straight to each of the `points` (m) in turn, all else as where a file gives nothing.
    pub fn new(points: Vec<[f64; 2]>, speed: f64) -> Self {
        Self {
            points,
            corners: Corners::default(),
            profile: ProfileKind::default(),
            speed,
            acceleration: ACCELERATION,
            jerk: JERK,
            hold: 0.0,
        }
    }

    /// The profile with its numbers.
    pub fn profile(&self) -> Profile {
        let Self { speed, acceleration, jerk, .. } = *self;
        match self.profile {
            ProfileKind::Quintic => Profile::Quintic { speed },
            ProfileKind::Trapezoid => Profile::Trapezoid { speed, acceleration },
            ProfileKind::Scurve => Profile::SCurve { speed, acceleration, jerk },
            ProfileKind::Constant => Profile::Constant { speed },
        }
    }

    /// The trajectory from `start` (m); `None` where there is none, since points coincide or a spline would
    /// turn back at one of them.
    pub fn trajectory(&self, start: [f64; 2]) -> Option<Trajectory> {
        let points: Vec<Vec2> = self.points.iter().copied().map(Vec2::from).collect();
        match self.corners {
            Corners::Stop => Trajectory::straight(start.into(), &points, self.profile()),
            Corners::Smooth => Trajectory::smooth(start.into(), &points, self.profile()),
        }
    }

    /// All that is wrong with a path from `start` (m).
    pub(super) fn faults(&self, start: [f64; 2]) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut check = |path: String, value: f64, ok: bool, allowed: Allowed| {
            if !(ok && value.is_finite()) {
                faults.push(Fault::number(path, value, allowed));
            }
        };
        for (i, point) in self.points.iter().enumerate() {
            for (j, &coordinate) in point.iter().enumerate() {
                check(format!("path.points[{i}][{j}]"), coordinate, true, Allowed::Finite);
            }
        }
        for (name, value) in [("speed", self.speed), ("acceleration", self.acceleration), ("jerk", self.jerk)] {
            check(format!("path.{name}"), value, value > 0.0, Allowed::Positive);
        }
        check("path.hold".into(), self.hold, self.hold >= 0.0, Allowed::NotNegative { instead: "" });
        if self.points.is_empty() || self.points.len() > MOST_POINTS {
            let allowed = format!("a list of 1 to {MOST_POINTS} points");
            faults.push(Fault::new("path.points", format!("a list of {}", self.points.len()), allowed));
        }
        if self.profile == ProfileKind::Constant && self.hold > 0.0 {
            let allowed = "0 with the profile \"constant\", which does not come to rest";
            faults.push(Fault::number("path.hold", self.hold, Allowed::from(allowed)));
        }
        if !faults.is_empty() {
            return faults;
        }
        match self.trajectory(start) {
            None => faults.push(self.without_trajectory(start)),
            Some(trajectory) => {
                let duration = trajectory.duration() + self.hold;
                if !DURATIONS.contains(&duration) {
                    let allowed = format!("what makes a move of {:e} to {:e} s", DURATIONS.start(), DURATIONS.end());
                    let (name, value) =
                        if self.hold > *DURATIONS.end() { ("hold", self.hold) } else { ("speed", self.speed) };
                    faults.push(Fault::number(format!("path.{name}"), value, Allowed::from(allowed)));
                }
            }
        }
        faults
    }

    /// Why finite points give no path.
    fn without_trajectory(&self, start: [f64; 2]) -> Fault {
        let mut before = start;
        for (i, &point) in self.points.iter().enumerate() {
            let same = before.iter().zip(&point).all(|(a, b)| a.total_cmp(b).is_eq());
            if same && (self.corners == Corners::Smooth || i + 1 == self.points.len()) {
                let other = if i == 0 { "motion.position".into() } else { format!("path.points[{}]", i - 1) };
                let value = format!("[{:?}, {:?}]", point[0], point[1]);
                return Fault::new(format!("path.points[{i}]"), value, format!("another point than {other}"));
            }
            before = point;
        }
        Fault::new("path.corners", "\"smooth\"", "\"stop\" for these points, at one of which a spline would turn back")
    }

    /// Reads a path; `speed` is that of the motion, which counts where none is given.
    pub(super) fn read(path: &Value, speed: f64) -> Self {
        let path = path.object(&["points", "corners", "profile", "speed", "acceleration", "jerk", "hold"]);
        let number = |name, default| path.optional(name).map_or(default, |number| number.number());
        let allowed = format!("a list of 1 to {MOST_POINTS} points [x, y]");
        let corners = [("stop", Corners::Stop), ("smooth", Corners::Smooth)];
        let profiles = [
            ("quintic", ProfileKind::Quintic),
            ("trapezoid", ProfileKind::Trapezoid),
            ("scurve", ProfileKind::Scurve),
            ("constant", ProfileKind::Constant),
        ];
        Self {
            points: path.field("points").list(&allowed).iter().map(Value::vector).collect(),
            corners: (path.optional("corners"))
                .and_then(|corner| corner.choice(&corners, r#""stop" or "smooth""#))
                .unwrap_or_default(),
            profile: (path.optional("profile"))
                .and_then(|profile| profile.choice(&profiles, r#""quintic", "trapezoid", "scurve" or "constant""#))
                .unwrap_or_default(),
            speed: number("speed", speed),
            acceleration: number("acceleration", ACCELERATION),
            jerk: number("jerk", JERK),
            hold: number("hold", 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Faults;
    use crate::scenario::{Scenario, presets};

    fn with(path: &str) -> Result<Scenario, Faults> {
        let text = presets::PRESETS[0].scenario().to_json();
        let text = text.trim_end().trim_end_matches('}').trim_end().to_owned();
        let text = text.replace("scenario/1", "scenario/2");
        Scenario::from_json(&format!("{text}, \"path\": {path} }}"))
    }

    #[test]
    fn what_is_missing_has_its_default() {
        let scenario = with(r#"{"points": [[6, 0], [6, 2]]}"#).expect("a scenario");
        assert_eq!(scenario.path, Some(Path::new(vec![[6.0, 0.0], [6.0, 2.0]], 5.0)));
        let trajectory = scenario.trajectory().expect("a trajectory");
        assert!((trajectory.length() - 8.0).abs() < 1e-12 && trajectory.corners() == [6.0]);
        let whole = r#"{"points": [[6, 0]], "corners": "smooth", "profile": "scurve", "speed": 4, "acceleration": 3, "jerk": 8, "hold": 2}"#;
        let path = with(whole).expect("a scenario").path.expect("a path");
        let expected = Path {
            corners: Corners::Smooth,
            profile: ProfileKind::Scurve,
            acceleration: 3.0,
            jerk: 8.0,
            hold: 2.0,
            ..Path::new(vec![[6.0, 0.0]], 4.0)
        };
        assert_eq!(path, expected);
        assert_eq!(path.profile(), Profile::SCurve { speed: 4.0, acceleration: 3.0, jerk: 8.0 });
    }

    #[test]
    fn a_scenario_with_a_path_is_written_and_read_again() {
        let plain = presets::PRESETS[0].scenario();
        let mut path = Path::new(vec![[6.0, 0.1], [1.0, -2.0]], 4.0);
        (path.profile, path.corners, path.hold) = (ProfileKind::Trapezoid, Corners::Smooth, 1.5);
        let scenario = Scenario { path: Some(path), ..plain.clone() };
        assert!(scenario.to_json().contains("tautline/scenario/2") && plain.to_json().contains("tautline/scenario/1"));
        assert_eq!(Scenario::from_json(&scenario.to_json()), Ok(scenario));
        assert!(!plain.to_json().contains("path"));
    }

    #[test]
    fn faults_name_the_field_the_value_and_what_is_allowed() {
        for (path, expected) in [
            (r#"{"points": []}"#, "path.points: a list of 0 is not allowed; allowed: a list of 1 to 100 points"),
            ("{}", "path.points: missing; allowed: a list of 1 to 100 points [x, y]"),
            (
                r#"{"points": [[0, 0]]}"#,
                "path.points[0]: [0, 0] is not allowed; allowed: another point than motion.position",
            ),
            (
                r#"{"points": [[1, 0], [1, 0], [2, 1]], "corners": "smooth"}"#,
                "path.points[1]: [1, 0] is not allowed; allowed: another point than path.points[0]",
            ),
            (
                r#"{"points": [[4, 0], [1, 0]], "corners": "smooth"}"#,
                "path.corners: \"smooth\" is not allowed; allowed: \"stop\"",
            ),
            (
                r#"{"points": [[4, 0]], "speed": 0}"#,
                "path.speed: 0 is not allowed; allowed: a finite number greater than 0",
            ),
            (
                r#"{"points": [[4, 0]], "speed": 1e-9}"#,
                "path.speed: 1e-9 is not allowed; allowed: what makes a move of",
            ),
            (
                r#"{"points": [[4, 0]], "hold": -1}"#,
                "path.hold: -1 is not allowed; allowed: a finite number, 0 or more",
            ),
            (
                r#"{"points": [[4, 0]], "profile": "constant", "hold": 1}"#,
                "path.hold: 1 is not allowed; allowed: 0 with",
            ),
            (
                r#"{"points": [[4, 0]], "profile": "cubic"}"#,
                "path.profile: \"cubic\" is not allowed; allowed: \"quintic\"",
            ),
            (r#"{"points": [[4, 0]], "length": 1}"#, "path.length: an unknown field (1) is not allowed"),
            (r#"{"points": [[4]]}"#, "path.points[0]: [4] is not allowed"),
        ] {
            let message = with(path).expect_err(path).to_string();
            assert!(message.starts_with(expected), "{path}: {message}");
        }
        let first = presets::PRESETS[0].scenario().to_json().trim_end().trim_end_matches('}').to_owned();
        let message = Scenario::from_json(&format!(r#"{first}, "path": {{"points": [[6, 0]]}} }}"#));
        assert!(
            message.expect_err("of the first version").to_string().starts_with("path: a field of tautline/scenario/2")
        );
        // A point that is there already is passed over where the platform stops anyway.
        assert!(with(r#"{"points": [[0, 0], [1, 0]]}"#).is_ok());
    }
}
