//! What the text version of the page asks, and the answers: JSON text in and out, computed at one stretch.
//!
//! | request | `ok` in the answer |
//! |---|---|
//! | `{"id": 1, "analyze": SCENARIO, "max_speed": V}` | the analysis, [`Report`]; without `max_speed` the search ends at [`DEFAULT_MAX_SPEED`] |
//! | `{"id": 1, "encode": SCENARIO}` | the robot as a link, the text after `#s=` |
//! | `{"id": 1, "decode": "LINK"}` | the scenario of such a text, as in its file |
//! | `{"id": 1, "example": "NAME"}` | a built-in scenario |
//! | `{"id": 1, "examples": true}` | all of them: `[{"name", "title", "description"}]` |
//!
//! An answer is `{"id": 1, "ok": …}`. What is wrong with the input is told by `{"id": 1, "faults": [{"path", "value",
//! "allowed", "message"}]}`, and what is wrong with a link or with the request by `{"id": 1, "error": "…"}`.
//!
//! ```
//! use tautline::scenario::messages::answer;
//!
//! assert!(answer(r#"{"id": 7, "example": "paper"}"#).starts_with(r#"{"id":7.0,"ok":{"schema":"tautline/scenario/1","#));
//! ```

use serde::Serialize;

use crate::robot::{Fault, Faults};
use crate::scenario::Scenario;
use crate::scenario::layout::compact;
use crate::scenario::link::{self, LinkError};
use crate::scenario::presets::{self, PRESETS};
use crate::scenario::reader::{Document, Object, Value};
use crate::scenario::report::{DEFAULT_MAX_SPEED, Report};
use crate::stability::{ALLOWED_LIMIT, is_limit};

const FIELDS: [&str; 7] = ["id", "analyze", "max_speed", "encode", "decode", "example", "examples"];

/// Answers a request; see the [module](self). A request that is no JSON object, or has no number `id`, is answered with
/// `"id": 0`.
pub fn answer(request: &str) -> String {
    let document = match Document::new("request", request) {
        Ok(document) => document,
        Err(faults) => return written(0.0, Err(Refusal::Faults(faults))),
    };
    let request = document.root().object(&FIELDS);
    let id = request.field("id").number();
    let answered = document.check().map_err(Refusal::from).and_then(|()| answer_one(&document, &request));
    written(id, answered)
}

/// Why there is no answer.
enum Refusal {
    Faults(Faults),
    Other(String),
}

impl From<Faults> for Refusal {
    fn from(faults: Faults) -> Self {
        Self::Faults(faults)
    }
}

impl From<LinkError> for Refusal {
    fn from(error: LinkError) -> Self {
        match error {
            LinkError::NotPhysical(faults) => Self::Faults(faults),
            LinkError::Damaged | LinkError::Newer => Self::Other(error.to_string()),
        }
    }
}

/// The answer as JSON.
fn answer_one(document: &Document, request: &Object) -> Result<String, Refusal> {
    if let Some(scenario) = request.optional("analyze") {
        return analyze(document, request, scenario.json());
    }
    if let Some(scenario) = request.optional("encode") {
        return Ok(compact(&link::encode(&Scenario::from_json(scenario.json())?)));
    }
    if let Some(text) = request.optional("decode") {
        let text = text.text();
        document.check()?;
        return Ok(compact(&link::decode(&text)?));
    }
    if let Some(name) = request.optional("example") {
        let name = name.text();
        document.check()?;
        let preset =
            presets::find(&name).ok_or_else(|| Refusal::Other(format!("There is no built-in robot {name:?}.")))?;
        return Ok(compact(&preset.scenario()));
    }
    if request.optional("examples").is_some() {
        let listed = |preset: &presets::Preset| Listed {
            name: preset.name,
            title: preset.title,
            description: preset.description,
        };
        return Ok(compact(&PRESETS.iter().map(listed).collect::<Vec<_>>()));
    }
    Err(Refusal::Other("The request asks for nothing.".into()))
}

fn analyze(document: &Document, request: &Object, scenario: &str) -> Result<String, Refusal> {
    let given = request.optional("max_speed");
    let limit = given.as_ref().map_or(DEFAULT_MAX_SPEED, Value::number);
    let mut checked = document.check();
    if let Some(speed) = given.filter(|_| checked.is_ok() && !is_limit(limit)) {
        checked = Err(Fault::new("max_speed", speed.json(), ALLOWED_LIMIT).into());
    }
    // All faults at once.
    let (robot, motion) = match (Scenario::from_json(scenario).and_then(|scenario| scenario.to_robot()), checked) {
        (Ok(both), Ok(())) => both,
        (Err(faults), Err(others)) => return Err(faults.and(others).into()),
        (Err(faults), Ok(())) | (Ok(_), Err(faults)) => return Err(faults.into()),
    };
    Ok(compact(&Report::analyze(&robot, &motion, limit)))
}

fn written(id: f64, answered: Result<String, Refusal>) -> String {
    let (name, content) = match answered {
        Ok(content) => ("ok", content),
        Err(Refusal::Faults(faults)) => {
            let told = |fault: &Fault| Told {
                path: fault.path.clone(),
                value: fault.value.clone(),
                allowed: fault.allowed.to_string(),
                message: fault.to_string(),
            };
            ("faults", compact(&faults.list().iter().map(told).collect::<Vec<_>>()))
        }
        Err(Refusal::Other(reason)) => ("error", compact(&reason)),
    };
    format!(r#"{{"id":{id:?},"{name}":{content}}}"#)
}

/// A built-in robot in a list.
#[derive(Serialize)]
struct Listed {
    name: &'static str,
    title: &'static str,
    description: &'static str,
}

/// A fault in the words of a [`Fault`].
#[derive(Serialize)]
struct Told {
    path: String,
    value: String,
    allowed: String,
    message: String,
}
