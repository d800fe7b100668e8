//! What programs may ask for besides the scenario, as JSON: how far to search, and where a map looks.

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
