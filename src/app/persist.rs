//! What survives a restart: the scenario on show, what its values reset to, and the settings.

use std::time::Duration;

use eframe::Storage;
use web_time::Instant;

use crate::app::state::{Document, UiState};
use crate::scenario::Scenario;

const SCENARIO: &str = "tautline-scenario";
const ORIGINAL: &str = "tautline-original";
const STATE: &str = "tautline-state";
/// While it changes, the scenario is written this often.
const PAUSE: Duration = Duration::from_millis(500);

/// The document that was on show last, where there is one that can still be read.
pub fn document(storage: &dyn Storage) -> Option<Document> {
    let read = |key| Scenario::from_json(&storage.get_string(key)?).ok();
    let scenario = read(SCENARIO)?;
    Some(Document { original: read(ORIGINAL).unwrap_or_else(|| scenario.clone()), scenario })
}

/// How it was looked at.
pub fn state(storage: &dyn Storage) -> Option<UiState> {
    eframe::get_value(storage, STATE)
}

/// Writes down how things are looked at.
pub fn keep_state(storage: &mut dyn Storage, state: &UiState) {
    eframe::set_value(storage, STATE, state);
}

/// Writes the document down soon after each change.
#[derive(Debug)]
pub struct Keeper {
    written: Document,
    at: Instant,
}

impl Keeper {
    /// For a document that need not be written down.
    pub fn new(document: &Document) -> Self {
        Self { written: document.clone(), at: Instant::now() }
    }

    /// Writes the document down where that is due; else says when it will be.
    pub fn keep(&mut self, storage: &mut dyn Storage, document: &Document) -> Option<Duration> {
        if self.written == *document {
            return None;
        }
        let since = self.at.elapsed();
        if since < PAUSE {
            return Some(PAUSE.saturating_sub(since));
        }
        storage.set_string(SCENARIO, document.scenario.to_json());
        storage.set_string(ORIGINAL, document.original.to_json());
        storage.flush();
        (self.written, self.at) = (document.clone(), Instant::now());
        None
    }
}
