//! What screen readers are told, and when: the control with the focus as a sentence, and results once they rest.

use crate::app::tree::{Item, Value};

/// Gives a thing on once it has not changed for a while: what changes with every frame of a drag would be told without end.
#[derive(Debug)]
pub struct Rest<T> {
    /// How long it is to rest, in seconds.
    seconds: f64,
    told: Option<T>,
    /// What is to be told, and since when it has been so.
    waiting: Option<(T, f64)>,
}

impl<T: Clone + PartialEq> Rest<T> {
    /// Nothing has been told yet.
    pub fn new(seconds: f64) -> Self {
        Self { seconds, told: None, waiting: None }
    }

    /// Takes in what is so at the time `now`, in seconds; gives it where it is new and has been so for long enough. What
    /// is not known has nothing to tell.
    pub fn take(&mut self, thing: Option<T>, now: f64) -> Option<T> {
        let Some(thing) = thing.filter(|thing| self.told.as_ref() != Some(thing)) else {
            self.waiting = None;
            return None;
        };
        let since = match &self.waiting {
            Some((waiting, since)) if *waiting == thing => *since,
            _ => now,
        };
        if now - since >= self.seconds {
            (self.told, self.waiting) = (Some(thing.clone()), None);
            return Some(thing);
        }
        self.waiting = Some((thing, since));
        None
    }

    /// Has the same told once more when it comes back.
    pub fn forget(&mut self) {
        self.told = None;
    }

    /// Whether there is something to be told.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }
}

/// What is said of a control: its name, what it is, what it is set to. `all` is what is on the screen with it.
pub fn sentence(item: &Item, all: &[Item]) -> String {
    // A slider's number is written in the field beside it, with its unit.
    let written = || all.iter().find(|other| other.label == item.label && matches!(other.value, Some(Value::Text(_))));
    let value = match &item.value {
        Some(Value::Number(_)) => written().and_then(|other| other.value.as_ref()).or(item.value.as_ref()),
        value => value.as_ref(),
    };
    let what = match (item.role, value) {
        ("button", Some(Value::Is(_))) => "switch",
        ("spinbutton", _) => "number field",
        ("textbox", _) => "text field",
        ("combobox", _) => "list",
        ("img" | "figure", _) => "picture",
        ("menuitem", _) => "menu entry",
        ("radio", _) => "radio button",
        ("generic", _) => "",
        (role, _) => role,
    };
    let value = match value {
        Some(Value::Text(text)) => text.clone(),
        Some(Value::Number(number)) => number.to_string(),
        Some(Value::Is(on)) => match (item.role, on) {
            ("tab" | "radio" | "option", true) => "chosen".into(),
            ("tab" | "radio" | "option", false) => String::new(),
            (_, true) => "on".into(),
            (_, false) => "off".into(),
        },
        None => String::new(),
    };
    let unavailable = if item.enabled { "" } else { "not available" };
    let parts = [&item.label, what, &value, unavailable];
    parts.iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(", ")
}

/// The sentences that stand at plots, and what their pictures are called: findings as text.
pub fn findings(all: &[Item]) -> Vec<String> {
    let plots: Vec<_> = all.iter().filter(|it| it.role == "region" && matches!(&*it.label, "Plots" | "Dock")).collect();
    let at_plots = all.iter().filter(|it| plots.iter().any(|region| region.rect.contains(it.rect.center())));
    let told = at_plots.filter_map(|it| match (it.role, &it.value) {
        ("img" | "figure", Some(Value::Text(text))) => Some(format!("{}: {text}", it.label)),
        ("img" | "figure" | "text", _) => Some(it.label.clone()),
        _ => None,
    });
    let mut sentences: Vec<String> = Vec::new();
    for sentence in told.filter(|words| words.split_whitespace().count() > 3) {
        if !sentences.contains(&sentence) {
            sentences.push(sentence);
        }
    }
    sentences
}

#[cfg(test)]
mod tests {
    use eframe::egui::accesskit::NodeId;
    use eframe::egui::{Pos2, Rect, Vec2};

    use super::*;

    fn item(label: &str, role: &'static str, value: Option<Value>) -> Item {
        let rect = Rect::from_min_size(Pos2::new(10.0, 10.0), Vec2::splat(20.0));
        Item { node: NodeId(1), label: label.into(), role, rect, whole: rect, value, enabled: true, focusable: true }
    }

    #[test]
    fn a_drag_is_told_once_after_it() {
        let mut rest = Rest::new(0.7);
        // A second of frames, each with another answer, some of them still being computed.
        let told: Vec<_> =
            (0..60).filter_map(|frame| rest.take((frame % 3 != 0).then_some(frame), f64::from(frame) / 60.0)).collect();
        assert!(told.is_empty(), "{told:?}");
        assert!(rest.is_waiting());
        assert_eq!([1.2, 1.6, 1.8, 2.6].map(|now| rest.take(Some(59), now)), [None, None, Some(59), None]);
        assert!(!rest.is_waiting());
        // The same again is no news; something that came and went is none either.
        assert_eq!([(60, 3.0), (59, 3.2), (59, 9.0)].map(|(thing, now)| rest.take(Some(thing), now)), [None; 3]);
        rest.forget();
        assert_eq!([10.0, 10.8].map(|now| rest.take(Some(59), now)), [None, Some(59)]);
    }

    #[test]
    fn a_control_is_told_with_its_value_as_it_is_written() {
        let slider = item("Speed v", "slider", Some(Value::Number(5.0)));
        let field = item("Speed v", "spinbutton", Some(Value::Text("5.00 m/s".into())));
        let all = [item("Speed v", "text", None), slider.clone(), field.clone()];
        assert_eq!(sentence(&slider, &all), "Speed v, slider, 5.00 m/s");
        assert_eq!(sentence(&field, &all), "Speed v, number field, 5.00 m/s");
        assert_eq!(sentence(&item("Map", "button", Some(Value::Is(true))), &[]), "Map, switch, on");
        assert_eq!(sentence(&item("Modes", "tab", Some(Value::Is(true))), &[]), "Modes, tab, chosen");
        assert_eq!(
            sentence(&Item { enabled: false, ..item("Undo", "button", None) }, &[]),
            "Undo, button, not available"
        );
    }

    #[test]
    fn what_plots_say_is_found_in_words() {
        let mut dock = item("Dock", "region", None);
        dock.rect = Rect::from_min_size(Pos2::ZERO, Vec2::splat(100.0));
        let mut elsewhere = item("A sentence that stands somewhere else.", "text", None);
        elsewhere.rect = elsewhere.rect.translate(Vec2::splat(500.0));
        let picture = item("Along the line", "img", Some(Value::Text("least at x = 6.0 m".into())));
        let finding = item("The critical speed falls towards the edge.", "text", None);
        let all = [dock, elsewhere, picture, finding.clone(), finding, item("Fit", "button", None)];
        let expected = ["Along the line: least at x = 6.0 m", "The critical speed falls towards the edge."];
        assert_eq!(findings(&all), expected);
    }
}
