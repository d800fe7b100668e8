//! What survives a restart: the scenario on show, what its values reset to, the designs that are kept, and the settings.

use std::time::Duration;

use eframe::Storage;
use web_time::Instant;

use crate::app::designs::{Designs, Letter};
use crate::app::state::{Document, UiState};
use crate::scenario::Scenario;

const SCENARIO: &str = "tautline-scenario";
const ORIGINAL: &str = "tautline-original";
const STATE: &str = "tautline-state";
const DESIGNS: &str = "tautline-designs";
/// Whether a design is on show, as it is written down.
const SHOWN: &str = "shown";
const HIDDEN: &str = "hidden";
/// While it changes, the scenario is written this often. A browser takes it without a file.
const PAUSE: Duration = Duration::from_millis(if cfg!(target_arch = "wasm32") { 100 } else { 500 });

/// Where a browser keeps what belongs to this tab alone, as long as it is open, also when it is loaded again.
pub fn own() -> Option<Box<dyn Storage>> {
    #[cfg(target_arch = "wasm32")]
    return super::page::own_storage();
    #[cfg(not(target_arch = "wasm32"))]
    None
}

/// All storages, in the order in which they are read: this tab's own, then the one that all share, which a new tab begins
/// with. Both are written to.
pub fn storages<'a>(
    own: &'a mut Option<Box<dyn Storage>>,
    shared: Option<&'a mut dyn Storage>,
) -> Vec<&'a mut dyn Storage> {
    let own = own.as_deref_mut().map(|own| -> &mut dyn Storage { own });
    own.into_iter().chain(shared).collect()
}

/// The document that was on show last, where there is one that can still be read.
pub fn document(storages: &[&dyn Storage]) -> Option<Document> {
    storages.iter().find_map(|storage| document_in(*storage))
}

fn document_in(storage: &dyn Storage) -> Option<Document> {
    let read = |key| Scenario::from_json(&storage.get_string(key)?).ok();
    let scenario = read(SCENARIO)?;
    Some(Document { original: read(ORIGINAL).unwrap_or_else(|| scenario.clone()), scenario })
}

/// How it was looked at.
pub fn state(storages: &[&dyn Storage]) -> Option<UiState> {
    storages.iter().find_map(|storage| serde_json::from_str(&storage.get_string(STATE)?).ok())
}

/// Writes down how things are looked at.
pub fn keep_state(storages: &mut [&mut dyn Storage], state: &UiState) {
    if let Ok(text) = serde_json::to_string(state) {
        for storage in storages {
            storage.set_string(STATE, text.clone());
        }
    }
}

/// The designs that were kept. One that cannot be read is left out.
pub fn designs(storages: &[&dyn Storage]) -> Designs {
    let mut designs = Designs::default();
    let text = storages.iter().find_map(|storage| storage.get_string(DESIGNS)).unwrap_or_default();
    let written: Vec<[String; 4]> = serde_json::from_str(&text).unwrap_or_default();
    for [name, scenario, original, shown] in &written {
        let letter = Letter::ALL.into_iter().find(|letter| letter.name() == name);
        if let (Some(letter), Ok(scenario)) = (letter, Scenario::from_json(scenario)) {
            let original = Scenario::from_json(original).unwrap_or_else(|_| scenario.clone());
            designs.restore(letter, Document { scenario, original }, shown != HIDDEN);
        }
    }
    designs
}

/// Writes down which designs are kept: of each its letter, scenario and original, and whether it is on show.
pub fn keep_designs(storages: &mut [&mut dyn Storage], designs: &Designs) {
    let written = designs.all().map(|(letter, design)| {
        let Document { scenario, original } = &design.document;
        let shown = if design.shown { SHOWN } else { HIDDEN };
        [letter.name().to_owned(), scenario.to_json(), original.to_json(), shown.to_owned()]
    });
    if let Ok(text) = serde_json::to_string(&written.collect::<Vec<_>>()) {
        for storage in storages {
            storage.set_string(DESIGNS, text.clone());
        }
    }
}

/// Whether what is done is written down where the next start finds it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keeping {
    /// It is.
    Kept,
    /// The storage is full or blocked.
    Refused,
}

/// Where things are kept, and what is known to be there.
pub struct Kept {
    /// Where a browser keeps what belongs to this tab alone.
    pub own: Option<Box<dyn Storage>>,
    /// What has been written.
    pub keeper: Keeper,
}

/// Writes the document down soon after each change.
#[derive(Debug)]
pub struct Keeper {
    written: Option<Document>,
    at: Instant,
    now: Keeping,
    told: Keeping,
}

impl Keeper {
    /// Where these storages hold what they do. A tab that holds nothing of its own yet is written to at once: what it
    /// has begun with may be changed by another one.
    pub fn new(storages: &[&dyn Storage]) -> Self {
        let written = storages.first().and_then(|storage| document_in(*storage));
        Self { written, at: Instant::now(), now: Keeping::Kept, told: Keeping::Kept }
    }

    /// Has the document written down again, though it has not changed: another tab may have written since.
    pub fn renew(&mut self) {
        self.written = None;
    }

    /// Writes the document down where that is due; else says when it will be.
    pub fn keep(&mut self, storages: &mut [&mut dyn Storage], document: &Document) -> Option<Duration> {
        if self.written.as_ref() == Some(document) {
            return None;
        }
        // Only the last one is still there when the tab is closed.
        let lasting = storages.len().checked_sub(1)?;
        let since = self.at.elapsed();
        if since < PAUSE {
            return Some(PAUSE.saturating_sub(since));
        }
        let json = document.scenario.to_json();
        for storage in &mut *storages {
            storage.set_string(SCENARIO, json.clone());
            storage.set_string(ORIGINAL, document.original.to_json());
            storage.flush();
        }
        (self.written, self.at) = (Some(document.clone()), Instant::now());
        // A storage that is full or blocked says nothing.
        let kept = storages[lasting].get_string(SCENARIO) == Some(json);
        self.now = if kept { Keeping::Kept } else { Keeping::Refused };
        None
    }

    /// How it is now, where that has changed since the last call.
    pub fn news(&mut self) -> Option<Keeping> {
        let before = std::mem::replace(&mut self.told, self.now);
        (self.now != before).then_some(self.now)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::app::settings::FrequencyUnit;
    use crate::app::state::Plot;
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
        assert!(document(&[&storage]).is_none() && state(&[&storage]).is_none());
        let mut edited = Document::opened(presets::PRESETS[1].scenario());
        edited.scenario.motion.position = [0.1 + 0.2, -1.0 / 3.0];
        let mut keeper = Keeper::new(&[&storage]);
        assert!(keeper.keep(&mut [&mut storage], &edited).is_some(), "not more often than twice a second");
        std::thread::sleep(PAUSE);
        assert_eq!(keeper.keep(&mut [&mut storage], &edited), None);
        assert_eq!(keeper.news(), None);
        assert_eq!(document(&[&storage]), Some(edited));
        let mut looked = UiState { plot: Plot::Line, campbell_hz: 7.5, ..UiState::default() };
        looked.settings.frequency = FrequencyUnit::RadiansPerSecond;
        keep_state(&mut [&mut storage], &looked);
        let back = state(&[&storage]).expect("a state");
        assert_eq!((back.plot, back.campbell_hz, back.settings), (looked.plot, 7.5, looked.settings));
    }

    #[test]
    fn kept_designs_come_back_with_letter_name_and_original() {
        let mut storage = Memory::default();
        assert_eq!(designs(&[&storage]).all().count(), 0);
        let mut kept = Designs::default();
        let mut document = Document::opened(presets::PRESETS[1].scenario());
        document.scenario.name = Some("Heavier \"B\", 重".into());
        document.scenario.platform.mass = 0.1 + 0.2;
        kept.restore(Letter::B, document.clone(), true);
        kept.restore(Letter::D, Document::opened(presets::PRESETS[0].scenario()), false);
        keep_designs(&mut [&mut storage], &kept);
        let back = designs(&[&storage]);
        let shown: Vec<_> = back.all().map(|(letter, design)| (letter, design.shown)).collect();
        assert_eq!(shown, [(Letter::B, true), (Letter::D, false)]);
        assert_eq!(back.get(Letter::B).map(|design| &design.document), Some(&document));
        // Nothing that is written there keeps the app from starting.
        for text in ["no JSON", "[[\"A\"]]", "[[\"A\",\"{}\",\"\",\"\"]]", "[[\"Z\",\"\",\"\",\"\"]]"] {
            storage.set_string(DESIGNS, text.into());
            assert_eq!(designs(&[&storage]).all().count(), 0, "{text}");
        }
        keep_designs(&mut [&mut storage], &Designs::default());
        assert_eq!(designs(&[&storage]).all().count(), 0, "all were removed");
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
        // What a tab keeps of its own is gone when it is closed.
        let (mut own, mut storage) = (Memory::default(), Full(Memory::default(), true));
        let mut keeper = Keeper::new(&[&own, &storage]);
        let mut document = Document::opened(presets::PRESETS[0].scenario());
        let (refused, kept) = (Some(Keeping::Refused), Some(Keeping::Kept));
        for (step, (full, news)) in
            [(true, refused), (true, None), (false, kept), (false, None), (true, refused)].into_iter().enumerate()
        {
            storage.1 = full;
            document.scenario.gravity = step as f64;
            std::thread::sleep(PAUSE);
            assert_eq!(keeper.keep(&mut [&mut own, &mut storage], &document), None);
            assert_eq!(keeper.news(), news, "step {step}");
        }
    }

    /// A browser's tab with its own storage, beside the one that all share.
    struct Tab {
        own: Memory,
        keeper: Keeper,
        document: Document,
    }

    impl Tab {
        fn open(own: Memory, shared: &Memory) -> Self {
            let document = document(&[&own, shared]);
            let document = document.unwrap_or_else(|| Document::opened(presets::PRESETS[0].scenario()));
            Self { keeper: Keeper::new(&[&own, shared]), own, document }
        }

        fn keep(&mut self, shared: &mut Memory) {
            std::thread::sleep(PAUSE);
            assert_eq!(self.keeper.keep(&mut [&mut self.own, shared], &self.document), None);
        }

        fn change(&mut self, gravity: f64, shared: &mut Memory) {
            self.document.scenario.gravity = gravity;
            self.keep(shared);
        }

        fn reload(&mut self, shared: &Memory) -> f64 {
            *self = Self::open(std::mem::take(&mut self.own), shared);
            self.document.scenario.gravity
        }
    }

    #[test]
    fn each_tab_keeps_its_own_robot_and_a_new_one_begins_with_the_last_one_used() {
        let mut shared = Memory::default();
        let mut first = Tab::open(Memory::default(), &shared);
        first.change(1.0, &mut shared);
        let mut second = Tab::open(Memory::default(), &shared);
        assert_eq!(second.document, first.document, "a new tab begins with what was used last");
        // One that nobody touches is its own as well.
        second.keep(&mut shared);
        first.change(2.0, &mut shared);
        assert_eq!((first.reload(&shared), second.reload(&shared)), (2.0, 1.0));
        second.change(3.0, &mut shared);
        assert_eq!((first.reload(&shared), second.reload(&shared)), (2.0, 3.0));
        assert_eq!(Tab::open(Memory::default(), &shared).document, second.document);
        // Looked at again, without a change.
        first.keeper.renew();
        first.keep(&mut shared);
        assert_eq!(Tab::open(Memory::default(), &shared).document, first.document);
        assert_eq!((first.reload(&shared), second.reload(&shared)), (2.0, 3.0));
    }

    #[test]
    fn each_tab_keeps_how_it_is_looked_at() {
        let (mut first, mut second, mut shared) = (Memory::default(), Memory::default(), Memory::default());
        let looked = |plot| UiState { plot, ..UiState::default() };
        keep_state(&mut [&mut first, &mut shared], &looked(Plot::Line));
        keep_state(&mut [&mut second, &mut shared], &looked(Plot::Mesh));
        let plots = [&[&first as &dyn Storage, &shared][..], &[&second, &shared], &[&shared]];
        let plots = plots.map(|storages| state(storages).expect("a state").plot);
        assert_eq!(plots, [Plot::Line, Plot::Mesh, Plot::Mesh]);
    }

    /// What an earlier or later version has written, or nobody, is no reason not to start.
    #[test]
    fn what_cannot_be_read_is_left_out() {
        let mut storage = Memory::default();
        storage.set_string(SCENARIO, "{}".into());
        storage.set_string(STATE, r#"{"plot": "Ghost"}"#.into());
        assert!(document(&[&storage]).is_none() && state(&[&storage]).is_none());
        storage.set_string(SCENARIO, presets::PRESETS[0].scenario().to_json());
        storage.set_string(ORIGINAL, "no JSON".into());
        storage.set_string(STATE, r#"{"campbell_hz": 9.0}"#.into());
        assert_eq!(document(&[&storage]), Some(Document::opened(presets::PRESETS[0].scenario())));
        // Earlier versions wrote down how wide panels were made by what was in them, not by a person.
        storage.set_string(STATE, r#"{"campbell_hz": 9.0, "widths": [535.0, 340.0]}"#.into());
        assert_eq!(state(&[&storage]).map(|state| state.panels), Some(UiState::default().panels));
        assert_eq!(state(&[&storage]).map(|state| (state.campbell_hz, state.plot)), Some((9.0, Plot::default())));
    }
}
