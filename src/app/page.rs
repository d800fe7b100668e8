//! `window.tautline`: what the page's scripts and tests see, and the text mirror for screen readers.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use eframe::egui;
use js_sys::{Array, JSON, Object, Reflect};
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

use crate::app::announce::{self, Rest};
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::mirror;
use crate::app::regions;
use crate::app::studies::{Studies, StudyResults, StudyStage};
use crate::app::tree;
use crate::compute::protocol::{Revision, Topic};
use crate::scenario::report::{CriticalReport, StatusReport};
use crate::scenario::{Scenario, link};
use crate::study::{Answer, Study};

/// The element that mirrors the main results as text.
const SUMMARY: &str = "tautline-summary";
/// The list that goes on from there.
const DETAILS: &str = "tautline-details";
/// What the line at the foot of the window says.
const NOTICE: &str = "tautline-notice";
/// What has the keyboard's focus.
const FOCUS: &str = "tautline-focus";
/// Results are told after they have rested so long, in seconds, and what has the focus after this.
const RESULTS_REST: f64 = 0.7;
const FOCUS_RESTS: f64 = 0.3;
/// What is told is looked at this often, in seconds.
const LOOK: f64 = 0.1;
/// The same for egui, with a little more, so that the time has come then.
const LOOK_AGAIN: f32 = 0.11;
/// So many frames' times are kept.
const FRAMES: usize = 120;

/// The page's side of the application.
pub struct Page {
    shared: Rc<RefCell<ScriptState>>,
    context: egui::Context,
    /// When it was looked last whether there is something to tell, in seconds.
    looked: f64,
    summary: Rest<String>,
    details: Rest<Vec<String>>,
    /// What has the focus, and the region that it is in.
    focus: Rest<(String, String)>,
    region: String,
    notice: String,
    /// What the page was called at first, and what it is called now.
    titles: [String; 2],
}

#[derive(Default)]
struct ScriptState {
    scenario: String,
    loaded: Option<Scenario>,
    link: Option<String>,
    analysis: Option<String>,
    analysis_key: Option<(Revision, bool)>,
    frame_ms: Option<f64>,
    frames_ms: VecDeque<f64>,
    studies: Value,
    /// The map's rows are written only for those who have asked for studies.
    asked: bool,
    map: Option<((Revision, usize), bool, String)>,
    analysis_ms: Option<f64>,
    trail_ms: Option<f64>,
}

/// The page's address without its fragment.
pub fn address() -> String {
    let location = web_sys::window().map(|window| window.location());
    let href = location.and_then(|location| location.href().ok()).unwrap_or_default();
    href.split('#').next().unwrap_or_default().to_owned()
}

/// Whether the page is a frame in another page.
pub fn is_embedded() -> bool {
    let Some(window) = web_sys::window() else { return false };
    window.parent().ok().flatten().is_some_and(|parent| parent != window)
}

/// The link in the page's address, if it has one: the robot and how it is looked at. It is taken out of the address: what
/// is done from then on must not be undone by loading the page again.
pub fn take_link() -> Option<String> {
    let window = web_sys::window()?;
    let hash = window.location().hash().ok().filter(|hash| hash.starts_with(link::MARK))?;
    let _ = window.history().ok()?.replace_state_with_url(&JsValue::NULL, "", Some(&address()));
    Some(hash)
}

/// The scenario that the page was reloaded with after a fault. It counts once.
pub fn take_kept() -> Option<Scenario> {
    let history = web_sys::window()?.history().ok()?;
    let kept = Reflect::get(&history.state().ok()?, &"scenario".into()).ok()?.as_string()?;
    let _ = history.replace_state_with_url(&JsValue::NULL, "", None);
    Scenario::from_json(&kept).ok().filter(|scenario| scenario.to_robot().is_ok())
}

/// What the browser keeps for this tab alone, where it keeps anything.
pub fn own_storage() -> Option<Box<dyn eframe::Storage>> {
    let storage = web_sys::window()?.session_storage().ok()??;
    Some(Box::new(Own(storage)))
}

struct Own(web_sys::Storage);

impl eframe::Storage for Own {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get_item(key).ok()?
    }

    fn set_string(&mut self, key: &str, value: String) {
        // One that is full is found out by reading.
        let _ = self.0.set_item(key, &value);
    }

    fn remove_string(&mut self, key: &str) {
        let _ = self.0.remove_item(key);
    }

    fn flush(&mut self) {}
}

impl Page {
    /// Sets `window.tautline`.
    pub fn new(context: &egui::Context) -> Self {
        let shared = Rc::new(RefCell::new(ScriptState::default()));
        // A page without a window has nobody to tell.
        if let Some(window) = web_sys::window() {
            let _ = Reflect::set(&window, &"tautline".into(), &interface(&shared, context));
            let (state, context) = (shared.clone(), context.clone());
            let went = Closure::<dyn Fn()>::new(move || {
                state.borrow_mut().link = take_link();
                context.request_repaint();
            });
            let _ = window.add_event_listener_with_callback("hashchange", went.into_js_value().unchecked_ref());
        }
        let title = document().map_or_else(String::new, |document| document.title());
        Self {
            shared,
            context: context.clone(),
            looked: 0.0,
            summary: Rest::new(RESULTS_REST),
            details: Rest::new(RESULTS_REST),
            focus: Rest::new(FOCUS_RESTS),
            region: String::new(),
            notice: String::new(),
            titles: [title.clone(), title],
        }
    }

    /// What a script has loaded since the last call, and the link that the user has gone to.
    pub fn news(&self) -> Vec<Command> {
        let mut shared = self.shared.borrow_mut();
        let loaded = shared.loaded.take().map(|scenario| Command::Load(Box::new(scenario)));
        loaded.into_iter().chain(shared.link.take().map(Command::Read)).collect()
    }

    /// Makes the state of this frame visible.
    pub fn publish(&mut self, facts: Facts<'_>, frame_seconds: Option<f32>) {
        let Facts { document, answers, studies, .. } = facts;
        let mut shared = self.shared.borrow_mut();
        if shared.loaded.is_none() {
            shared.scenario = document.scenario.to_json();
        }
        shared.frame_ms = frame_seconds.map(|seconds| 1e3 * f64::from(seconds));
        let frame = shared.frame_ms;
        shared.frames_ms.extend(frame);
        while shared.frames_ms.len() > FRAMES {
            shared.frames_ms.pop_front();
        }
        shared.publish_studies(studies);
        shared.trail_ms = answers.trail_ms();
        shared.analysis_ms = answers.last_critical().map(|answer| answer.elapsed_ms);
        if let Some((report, revision, current)) = answers.last_complete()
            && shared.analysis_key != Some((revision, current))
        {
            shared.analysis_key = Some((revision, current));
            shared.analysis = serde_json::to_value(report).ok().map(|mut analysis| {
                analysis["revision"] = revision.into();
                analysis["current"] = current.into();
                analysis.to_string()
            });
        }
        drop(shared);
        self.name(document.scenario.name.as_deref());
        self.announce(facts);
    }

    /// Calls the page by the robot's name, in the browser's tabs and bookmarks.
    fn name(&mut self, robot: Option<&str>) {
        let [first, now] = &mut self.titles;
        let title = robot.map_or_else(|| first.clone(), |robot| format!("{robot} – {first}"));
        if title != *now {
            if let Some(document) = document() {
                document.set_title(&title);
            }
            *now = title;
        }
    }

    /// Tells screen readers what is new, once it rests.
    fn announce(&mut self, facts: Facts<'_>) {
        let now = self.context.input(|input| input.time);
        if (0.0..LOOK).contains(&(now - self.looked)) {
            self.context.request_repaint_after_secs(LOOK_AGAIN);
            return;
        }
        self.looked = now;
        let items = tree::items(&self.context);
        let summary = mirror::summary(facts);
        let details = summary.is_some().then(|| {
            let mut details = mirror::details(facts);
            details.extend(announce::findings(&items));
            details
        });
        if let Some(summary) = self.summary.take(summary, now) {
            write(SUMMARY, &summary);
        }
        if let Some(details) = self.details.take(details, now) {
            list(DETAILS, &details);
        }
        let focused = tree::focused(&self.context);
        let focused = items.iter().find(|item| Some(item.node) == focused).map(|item| {
            let region = regions::around(item, &items).map_or_else(String::new, |index| items[index].label.clone());
            (announce::sentence(item, &items), region)
        });
        if focused.is_none() {
            self.focus.forget();
        }
        if let Some((sentence, region)) = self.focus.take(focused, now) {
            let entered =
                if region == self.region || region.is_empty() { String::new() } else { format!("{region}: ") };
            write(FOCUS, &format!("{entered}{sentence}"));
            self.region = region;
        }
        if self.summary.is_waiting() || self.details.is_waiting() || self.focus.is_waiting() {
            self.context.request_repaint_after_secs(LOOK_AGAIN);
        }
    }

    /// Writes a line for the user into the document.
    pub fn tell(&mut self, notice: Option<String>) {
        let notice = notice.unwrap_or_default();
        if notice != self.notice {
            write(NOTICE, &notice);
            self.notice = notice;
        }
    }
}

impl ScriptState {
    fn publish_studies(&mut self, studies: &Studies) {
        self.studies = Topic::ALL
            .into_iter()
            .map(|topic| {
                let progress = studies.progress(topic);
                let finished = progress.stage == StudyStage::Finished;
                let current = studies.shown(topic).is_some_and(|shown| shown.current);
                let state = json!({
                    "done": progress.done, "total": progress.total, "finished": finished,
                    "revision": progress.revision, "current": current,
                });
                (topic.name().to_owned(), state)
            })
            .collect();
        // Not while answers come in: they would be written in every frame.
        let at_rest = studies.progress(Topic::Map).stage != StudyStage::Working;
        if let Some(shown) = studies.shown(Topic::Map).filter(|_| self.asked && at_rest) {
            let known = shown.known;
            let newest = self
                .map
                .as_ref()
                .is_some_and(|(version, current, _)| (*version, *current) == (known.version, shown.current));
            if !newest {
                let rows = json!({ "current": shown.current, "rows": rows(known) }).to_string();
                self.map = Some((known.version, shown.current, rows));
            }
        }
    }
}

fn write(element: &str, text: &str) {
    if let Some(element) = document().and_then(|document| document.get_element_by_id(element)) {
        element.set_text_content(Some(text));
    }
}

/// The answered points of a map, each [x, y, feasible, critical speed, frequency, kind, cable, wave limit, status] with
/// null where there is none, or [x, y, growth rate, status].
fn rows(known: &StudyResults) -> Vec<Value> {
    let Study::Map { grid, .. } = &known.request.study else { return Vec::new() };
    let row = |(index, answer): (usize, &Option<Answer>)| {
        let at = grid.position(index);
        match answer.as_ref()? {
            Answer::Critical { verdict, wave_limit, .. } => {
                let (feasible, status) = (verdict.feasible(), StatusReport::from(verdict.status()));
                Some(match verdict.critical().map(CriticalReport::from) {
                    Some(CriticalReport { speed, frequency_hz, kind, cable }) => {
                        json!([at.x, at.y, feasible, speed, frequency_hz, kind, cable, wave_limit, status])
                    }
                    None => json!([at.x, at.y, feasible, null, null, null, null, wave_limit, status]),
                })
            }
            Answer::Growth(Ok(rate)) => Some(json!([at.x, at.y, rate, StatusReport::Found])),
            Answer::Growth(Err(reason)) => Some(json!([at.x, at.y, null, StatusReport::from(reason.status())])),
            _ => None,
        }
    };
    known.places.iter().enumerate().filter_map(row).collect()
}

/// The object with `scenario()`, `load(json)`, `analysis()`, `layout()`, `studies()` and `timings()`.
fn interface(shared: &Rc<RefCell<ScriptState>>, context: &egui::Context) -> Object {
    let object = Object::new();
    let set = |name: &str, function: JsValue| {
        // Setting a property of a fresh object does not fail.
        let _ = Reflect::set(&object, &name.into(), &function);
    };
    let state = shared.clone();
    set("scenario", Closure::<dyn Fn() -> JsValue>::new(move || parsed(&state.borrow().scenario)).into_js_value());
    let state = shared.clone();
    let analysis = move || state.borrow().analysis.as_deref().map_or(JsValue::NULL, parsed);
    set("analysis", Closure::<dyn Fn() -> JsValue>::new(analysis).into_js_value());
    let state = shared.clone();
    let timings = move || {
        let timings = Object::new();
        let number = |value: Option<f64>| value.map_or(JsValue::NULL, JsValue::from_f64);
        let _ = Reflect::set(&timings, &"frame_ms".into(), &number(state.borrow().frame_ms));
        let _ = Reflect::set(&timings, &"analysis_ms".into(), &number(state.borrow().analysis_ms));
        let _ = Reflect::set(&timings, &"trail_ms".into(), &number(state.borrow().trail_ms));
        let frames: Array = state.borrow().frames_ms.iter().map(|ms| JsValue::from_f64(*ms)).collect();
        let _ = Reflect::set(&timings, &"frames_ms".into(), &frames);
        JsValue::from(timings)
    };
    set("timings", Closure::<dyn Fn() -> JsValue>::new(timings).into_js_value());
    let screen = context.clone();
    let layout = move || parsed(&tree::layout(&screen).to_string());
    set("layout", Closure::<dyn Fn() -> JsValue>::new(layout).into_js_value());
    let (state, repaint) = (shared.clone(), context.clone());
    let studies = move || {
        let mut state = state.borrow_mut();
        if !state.asked {
            state.asked = true;
            repaint.request_repaint();
        }
        let studies = parsed(&state.studies.to_string());
        if let Some((_, _, map)) = &state.map {
            let _ = Reflect::set(&studies, &"map_values".into(), &parsed(map));
        }
        studies
    };
    set("studies", Closure::<dyn FnMut() -> JsValue>::new(studies).into_js_value());
    let (state, context) = (shared.clone(), context.clone());
    let load = move |json: JsValue| -> Result<(), JsValue> {
        // An object is as good as its text.
        let text = json.as_string().or_else(|| JSON::stringify(&json).ok()?.as_string()).unwrap_or_default();
        let scenario = Scenario::from_json(&text).map_err(|faults| js_sys::Error::new(&faults.to_string()))?;
        let mut state = state.borrow_mut();
        state.scenario = scenario.to_json();
        // The analysis on show belongs to the scenario before.
        state.analysis =
            state.analysis.take().map(|analysis| analysis.replace("\"current\":true", "\"current\":false"));
        state.analysis_key = None;
        state.loaded = Some(scenario);
        context.request_repaint();
        Ok(())
    };
    set("load", Closure::<dyn Fn(JsValue) -> Result<(), JsValue>>::new(load).into_js_value());
    object
}

fn parsed(json: &str) -> JsValue {
    JSON::parse(json).unwrap_or(JsValue::NULL)
}

fn document() -> Option<web_sys::Document> {
    web_sys::window()?.document()
}

/// Writes these lines into a list.
fn list(element: &str, lines: &[String]) {
    let Some(document) = document() else { return };
    let Some(list) = document.get_element_by_id(element) else { return };
    list.set_text_content(None);
    for line in lines {
        if let Ok(item) = document.create_element("li") {
            item.set_text_content(Some(line));
            let _ = list.append_child(&item);
        }
    }
}
