//! What programs may ask for besides the scenario, as JSON: how far to search, and where a map looks.

use crate::flight::{FlightOptions, LimitOptions};
use crate::robot::{Fault, Faults, Vec2};
use crate::scenario::reader::{Document, Object, Value};
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::stability::{ALLOWED_LIMIT, is_limit};
use crate::study::Directions;

/// The most points in a row or column of a map.
pub const MOST_POINTS: u32 = 2000;

/// The speed (m/s) up to which to search: `{"maxSpeed": V}`, or `{}` for [`DEFAULT_MAX_SPEED`].
///
/// # Errors
/// All that is wrong, field by field.
pub fn max_speed(text: &str) -> Result<f64, Faults> {
    let document = Document::new("options", text)?;
    let mut faults = Vec::new();
    let speed = read_max_speed(&document.root().object(&["maxSpeed"]), &mut faults);
    checked(&document, faults)?;
    Ok(speed)
}

/// The most samples of a flight.
pub const MOST_SAMPLES: u32 = 1_000_000;
/// The part of the local limits that the fastest move keeps below, unless told otherwise.
pub const SAFETY: f64 = 0.8;

/// What a map is to show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOptions {
    /// Points in a row.
    pub nx: usize,
    /// Rows.
    pub ny: usize,
    /// In which directions; the scenario's own where there are none.
    pub directions: Option<Directions>,
    /// Critical speeds are searched up to this speed in m/s.
    pub limit: f64,
}

impl MapOptions {
    /// Reads `{"nx": N, "ny": N, "direction": …, "maxSpeed": V}`, where the last two may be missing. A direction is
    /// one of the command line's words, `"motion"` for the scenario's own, or a vector `[dx, dy]`.
    ///
    /// # Errors
    /// All that is wrong, field by field.
    pub fn from_json(text: &str) -> Result<Self, Faults> {
        let document = Document::new("options", text)?;
        let mut faults = Vec::new();
        let options = document.root().object(&["nx", "ny", "direction", "maxSpeed"]);
        let [nx, ny] = ["nx", "ny"].map(|name| {
            let allowed = format!("a whole number from 1 to {MOST_POINTS}");
            let points = options.field(name).whole(&allowed);
            if !(1..=MOST_POINTS as usize).contains(&points) {
                faults.push(Fault::new(name, points, allowed));
            }
            points
        });
        let directions = options.optional("direction").and_then(|direction| read_direction(&direction, &mut faults));
        let limit = read_max_speed(&options, &mut faults);
        checked(&document, faults)?;
        Ok(Self { nx, ny, directions, limit })
    }
}

/// What a flight of a scenario's path is asked: `{"kick": [px, py], "samples": N, "accuracy": M}`, each of which may be missing;
/// `hold` (s) is the path's.
///
/// # Errors
/// All that is wrong, field by field.
pub fn flight(text: &str, hold: f64) -> Result<FlightOptions, Faults> {
    let document = Document::new("options", text)?;
    let mut faults = Vec::new();
    let options = document.root().object(&["kick", "samples", "accuracy"]);
    let default = FlightOptions { hold, ..FlightOptions::default() };
    let samples = options.optional("samples").map_or(default.samples, |samples| {
        let allowed = format!("a whole number from 2 to {MOST_SAMPLES}");
        let count = samples.whole(&allowed);
        if !(2..=MOST_SAMPLES as usize).contains(&count) {
            faults.push(Fault::new("samples", count, allowed));
        }
        count
    });
    let accuracy = positive(&options, "accuracy", &mut faults).unwrap_or(default.accuracy);
    let kick = options.optional("kick").map_or(default.kick, |kick| Vec2::from(kick.vector()));
    checked(&document, faults)?;
    Ok(FlightOptions { kick, accuracy, samples, ..default })
}

/// What limits the fastest move: `{"safety": K, "by": "frozen" | "wave" | "both", "acceleration": A, "winchSpeed": V,
/// "winchAcceleration": A, "slack": K}`, each of which may be missing: a limit that is not given does not act.
///
/// # Errors
/// All that is wrong, field by field.
pub fn limits(text: &str) -> Result<LimitOptions, Faults> {
    let document = Document::new("options", text)?;
    let mut faults = Vec::new();
    let options = document.root().object(&["safety", "by", "acceleration", "winchSpeed", "winchAcceleration", "slack"]);
    let choices = [("frozen", [true, false]), ("wave", [false, true]), ("both", [true, true])];
    let [frozen, waves] = (options.optional("by"))
        .and_then(|by| by.choice(&choices, r#""frozen", "wave" or "both""#))
        .unwrap_or([true, true]);
    let mut number = |name| positive(&options, name, &mut faults);
    let options = LimitOptions {
        safety: number("safety").unwrap_or(SAFETY),
        frozen,
        waves,
        slack: number("slack"),
        acceleration: number("acceleration"),
        winch_speed: number("winchSpeed"),
        winch_acceleration: number("winchAcceleration"),
    };
    checked(&document, faults)?;
    Ok(options)
}

/// A number that has to be greater than 0, where it is given.
fn positive(options: &Object, name: &'static str, faults: &mut Vec<Fault>) -> Option<f64> {
    let number = options.optional(name)?.number();
    if number <= 0.0 {
        faults.push(Fault::new(name, number, "a finite number greater than 0"));
    }
    Some(number)
}

fn read_max_speed(options: &Object, faults: &mut Vec<Fault>) -> f64 {
    let speed = options.optional("maxSpeed").map_or(DEFAULT_MAX_SPEED, |speed| speed.number());
    if !is_limit(speed) {
        faults.push(Fault::new("maxSpeed", speed, ALLOWED_LIMIT));
    }
    speed
}

fn read_direction(direction: &Value, faults: &mut Vec<Fault>) -> Option<Directions> {
    if direction.is_list() {
        let vector = Vec2::from(direction.vector());
        if vector == Vec2::zeros() {
            faults.push(Fault::new("direction", "[0, 0]", "a vector that is not zero"));
        }
        return Some(Directions::One(vector));
    }
    let words = Directions::WORDS.map(|(word, directions)| (word, Some(directions)));
    let choices = [&words[..], &[("motion", None)]].concat();
    let quoted: Vec<String> = choices.iter().map(|(word, _)| format!("{word:?}")).collect();
    direction.choice(&choices, &format!("{} or a list of 2 numbers", quoted.join(", "))).flatten()
}

/// Faults in reading come first; they may well be the reason for the others.
fn checked(document: &Document, faults: Vec<Fault>) -> Result<(), Faults> {
    document.check()?;
    Faults::check(faults).map_err(|faults| document.quoted(faults))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        MapOptions::from_json(text).expect_err(text).to_string()
    }

    #[test]
    fn options_are_read_with_their_defaults() {
        assert_eq!([max_speed("{}"), max_speed(r#"{"maxSpeed": 12.5}"#)], [Ok(DEFAULT_MAX_SPEED), Ok(12.5)]);
        let plain = MapOptions { nx: 5, ny: 2000, directions: None, limit: DEFAULT_MAX_SPEED };
        assert_eq!(MapOptions::from_json(r#"{"nx": 5, "ny": 2e3}"#), Ok(plain));
        let with = |direction: &str| {
            let text = format!(r#"{{"nx": 1, "ny": 1, "direction": {direction}, "maxSpeed": 1}}"#);
            MapOptions::from_json(&text).map(|options| options.directions)
        };
        assert_eq!(with(r#""motion""#), Ok(None));
        assert_eq!(with(r#""worst""#), Ok(Some(Directions::Worst(16))));
        assert_eq!(with(r#""-y""#), Ok(Some(Directions::One(Vec2::new(0.0, -1.0)))));
        assert_eq!(with("[-3, 4e0]"), Ok(Some(Directions::One(Vec2::new(-3.0, 4.0)))));
    }

    #[test]
    fn options_of_flights_and_limits_are_read() {
        let found = flight(r#"{"kick": [0, -1], "samples": 5}"#, 2.0);
        assert_eq!(
            found,
            Ok(FlightOptions { kick: Vec2::new(0.0, -1.0), samples: 5, hold: 2.0, ..FlightOptions::default() })
        );
        let message = |text| flight(text, 0.0).expect_err(text).to_string();
        assert!(message(r#"{"samples": 1}"#).starts_with("samples: 1 is not allowed; allowed: a whole number from 2"));
        assert!(
            message(r#"{"accuracy": 0}"#).starts_with("accuracy: 0 is not allowed; allowed: a finite number greater")
        );
        let found = limits(r#"{"by": "wave", "acceleration": 6}"#).expect("limits");
        assert!((found.safety - 0.8).abs() < 1e-15 && !found.frozen && found.waves && found.acceleration == Some(6.0));
        assert_eq!((found.slack, found.winch_speed, found.winch_acceleration), (None, None, None));
        let message = |text| limits(text).expect_err(text).to_string();
        assert!(message(r#"{"by": "luck"}"#).starts_with("by: \"luck\" is not allowed; allowed: \"frozen\""));
        assert!(message(r#"{"winchSpeed": -1}"#).starts_with("winchSpeed: -1 is not allowed"));
    }

    #[test]
    fn faults_tell_the_option_the_value_and_what_is_allowed() {
        let points = "is not allowed; allowed: a whole number from 1 to 2000";
        assert_eq!(message(r#"{"nx": 0, "ny": 2001.0}"#), format!("nx: 0 {points}\nny: 2001.0 {points}"));
        assert_eq!(
            message(r#"{"nx": 1.5}"#),
            format!("nx: 1.5 {points}\nny: missing; allowed: a whole number from 1 to 2000")
        );
        for (options, start) in [
            (r#""direction": "left""#, "direction: \"left\" is not allowed; allowed: \"worst\", \"+x\""),
            (r#""direction": [0, 0.0]"#, "direction: [0, 0.0] is not allowed; allowed: a vector that is not zero"),
            (r#""direction": [1]"#, "direction: [1] is not allowed; allowed: a list of 2 numbers"),
            (r#""direction": 7"#, "direction: 7 is not allowed"),
            (
                r#""maxSpeed": -1e0"#,
                "maxSpeed: -1e0 is not allowed; allowed: a number of m/s greater than 0, at most 10000",
            ),
            (
                r#""maxSpeed": 1e9"#,
                "maxSpeed: 1e9 is not allowed; allowed: a number of m/s greater than 0, at most 10000",
            ),
            (r#""maxSpeed": "NaN""#, "maxSpeed: \"NaN\" is not allowed; allowed: a finite number"),
            (r#""max_speed": 3"#, "max_speed: an unknown field (3) is not allowed; allowed: the fields nx, ny"),
        ] {
            let message = message(&format!(r#"{{"nx": 2, "ny": 2, {options}}}"#));
            assert!(message.starts_with(start), "{message}");
        }
        assert!(message("[]").starts_with("options: [] is not allowed; allowed: an object with the fields nx"));
        assert!(max_speed(r#"{"nx": 2}"#).expect_err("a fault").to_string().starts_with("nx: an unknown field"));
    }
}
