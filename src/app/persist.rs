//! What survives a restart: the scenario on show, what its values reset to, and the settings.

use std::time::Duration;

use eframe::Storage;
use web_time::Instant;

use crate::app::state::{Document, UiState};
use crate::scenario::Scenario;

const SCENARIO: &str = "tautline-scenario";
const ORIGINAL: &str = "tautline-original";
const STATE: &str = "tautline-state";
/// While it changes, the scenario is written this often. A browser takes it without a file.
const PAUSE: Duration = Duration::from_millis(if cfg!(target_arch = "wasm32") { 100 } else { 500 });

/// The document that was on show last, where there is one that can still be read.
pub fn document(storage: &dyn Storage) -> Option<Document> {
    let read = |key| Scenario::from_json(&storage.get_string(key)?).ok();
    let scenario = read(SCENARIO)?;
    Some(Document { original: read(ORIGINAL).unwrap_or_else(|| scenario.clone()), scenario })
}

/// How it was looked at.
pub fn state(storage: &dyn Storage) -> Option<UiState> {
    serde_json::from_str(&storage.get_string(STATE)?).ok()
}

/// Writes down how things are looked at.
pub fn keep_state(storage: &mut dyn Storage, state: &UiState) {
    if let Ok(text) = serde_json::to_string(state) {
        storage.set_string(STATE, text);
    }
}

/// Writes the document down soon after each change.
#[derive(Debug)]
pub struct Keeper {
    written: Option<Document>,
    at: Instant,
    /// The storage has not taken it; and whether that was told.
    refused: bool,
    told: bool,
}

impl Keeper {
    /// Where this document is written down already.
    pub fn new(written: Option<Document>) -> Self {
        Self { written, at: Instant::now(), refused: false, told: false }
    }

    /// Writes the document down where that is due; else says when it will be.
    pub fn keep(&mut self, storage: &mut dyn Storage, document: &Document) -> Option<Duration> {
        if self.written.as_ref() == Some(document) {
            return None;
        }
        let since = self.at.elapsed();
        if since < PAUSE {
            return Some(PAUSE.saturating_sub(since));
        }
        let json = document.scenario.to_json();
        storage.set_string(SCENARIO, json.clone());
        storage.set_string(ORIGINAL, document.original.to_json());
        storage.flush();
        (self.written, self.at) = (Some(document.clone()), Instant::now());
        // A storage that is full or blocked says nothing.
        self.refused = storage.get_string(SCENARIO) != Some(json);
        None
    }

    /// Whether the storage has begun to take nothing since the last call.
    pub fn is_newly_refused(&mut self) -> bool {
        let told = std::mem::replace(&mut self.told, self.refused);
        self.refused && !told
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::app::state::{FrequencyUnit, Plot};
    use crate::scenario::presets;

    #[derive(Default)]
    struct Memory(HashMap<String, String>);

    impl Storage for Memory {
        fn get_string(&self, key: &str) -> Option<String> {
            self.0.get(key).cloned()
        }

        fn set_string(&mut self, key: &str, value: String) {
            self.0.insert(key.into(), value);
        }

        fn remove_string(&mut self, key: &str) {
            self.0.remove(key);
        }

        fn flush(&mut self) {}
    }

    #[test]
    fn documents_and_settings_come_back_as_they_were() {
        let mut storage = Memory::default();
        assert!(document(&storage).is_none() && state(&storage).is_none());
        let mut edited = Document::opened(presets::PRESETS[1].scenario());
        edited.scenario.motion.position = [0.1 + 0.2, -1.0 / 3.0];
        let mut keeper = Keeper::new(None);
        assert!(keeper.keep(&mut storage, &edited).is_some(), "not more often than twice a second");
        std::thread::sleep(PAUSE);
        assert_eq!(keeper.keep(&mut storage, &edited), None);
        assert!(!keeper.is_newly_refused());
        assert_eq!(document(&storage), Some(edited));
        let mut looked = UiState { plot: Plot::Line, campbell_hz: 7.5, ..UiState::default() };
        looked.settings.frequency = FrequencyUnit::RadiansPerSecond;
        keep_state(&mut storage, &looked);
        let back = state(&storage).expect("a state");
        assert_eq!((back.plot, back.campbell_hz, back.settings), (looked.plot, 7.5, looked.settings));
    }

    /// Takes nothing while it is full.
    struct Full(Memory, bool);

    impl Storage for Full {
        fn get_string(&self, key: &str) -> Option<String> {
            self.0.get_string(key)
        }

        fn set_string(&mut self, key: &str, value: String) {
            if !self.1 {
                self.0.set_string(key, value);
            }
        }

        fn remove_string(&mut self, key: &str) {
            self.0.remove_string(key);
        }

        fn flush(&mut self) {}
    }

    #[test]
    fn a_storage_that_takes_nothing_is_told_once_each_time() {
        let mut storage = Full(Memory::default(), true);
        let mut keeper = Keeper::new(None);
        let mut document = Document::opened(presets::PRESETS[0].scenario());
        for (step, (full, news)) in [(true, true), (true, false), (false, false), (true, true)].into_iter().enumerate()
        {
            storage.1 = full;
            document.scenario.gravity = step as f64;
            std::thread::sleep(PAUSE);
            assert_eq!(keeper.keep(&mut storage, &document), None);
            assert_eq!(keeper.is_newly_refused(), news, "step {step}");
        }
    }

    /// What an earlier or later version has written, or nobody, is no reason not to start.
    #[test]
    fn what_cannot_be_read_is_left_out() {
        let mut storage = Memory::default();
        storage.set_string(SCENARIO, "{}".into());
        storage.set_string(STATE, r#"{"plot": "Ghost"}"#.into());
        assert!(document(&storage).is_none() && state(&storage).is_none());
        storage.set_string(SCENARIO, presets::PRESETS[0].scenario().to_json());
        storage.set_string(ORIGINAL, "no JSON".into());
        storage.set_string(STATE, r#"{"campbell_hz": 9.0}"#.into());
        assert_eq!(document(&storage), Some(Document::opened(presets::PRESETS[0].scenario())));
        // Earlier versions wrote down how wide panels were made by what was in them, not by a person.
        storage.set_string(STATE, r#"{"campbell_hz": 9.0, "widths": [535.0, 340.0]}"#.into());
        assert_eq!(state(&storage).map(|state| state.panels), Some(UiState::default().panels));
        assert_eq!(state(&storage).map(|state| (state.campbell_hz, state.plot)), Some((9.0, Plot::default())));
    }
}
