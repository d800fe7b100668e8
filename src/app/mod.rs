//! The interface, in the browser and on the desktop.
//!
//! The document (`state`) is what the user edits; everything else on the screen follows from it. Panels draw and emit
//! commands; [`Tautline::logic`](eframe::App::logic) carries them out, sends the document to the engine and
//! takes in its replies.

mod answers;
mod apply;
mod canvas;
mod command;
mod export;
mod fields;
mod files;
mod history;
mod menu;
#[cfg(target_arch = "wasm32")]
mod page;
mod panels;
mod persist;
mod pinned;
mod series;
mod state;
mod studies;
mod theme;
mod windows;

use std::time::Duration;

use eframe::egui::{self, CentralPanel, Panel, Rect, ScrollArea, Ui};

use answers::{Answers, CriticalState};
use command::Command;
use files::Files;
use history::History;
use menu::Possible;
use persist::Keeper;
use pinned::Pinned;
use state::{Document, Page, Settings, UiState};
use studies::{Order, Studies};

use crate::compute::protocol::{Job, Request, Revision, Topic, Update, Which};
use crate::compute::{Compute, Pool};
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::scenario::{Report, Scenario, presets};

#[cfg(target_arch = "wasm32")]
pub use page::take_link;

/// Below this width, in points, the panels go under the canvas.
const NARROW: f32 = 760.0;
/// While studies are at work the pool is looked after at least this often.
const HEARTBEAT: Duration = Duration::from_millis(100);

/// The application.
pub struct Tautline {
    document: Document,
    history: History,
    state: UiState,
    answers: Answers,
    compute: Option<Compute>,
    studies: Studies,
    /// The design to compare with.
    pinned: Option<Pinned>,
    /// The present design is to be pinned as soon as all is known of it.
    pinning: bool,
    pool: Pool,
    files: Files,
    keeper: Keeper,
    /// The settings that have been carried out; at first those of the system.
    applied: Settings,
    /// Whether the plots were drawn in the last frame; a narrow screen may not show them.
    plots_open: bool,
    /// Where things were drawn in the last frame, for pictures of them.
    places: Places,
    /// Pictures made of studies, kept from frame to frame.
    layer: canvas::map::Layer,
    joined: panels::campbell::Modes,
    windows: windows::Runtime,
    revision: Revision,
    notice: Option<Notice>,
    commands: Vec<Command>,
    #[cfg(target_arch = "wasm32")]
    page: page::Page,
}

/// What panels read.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// What is edited.
    pub document: &'a Document,
    /// What is known of the pose.
    pub answers: &'a Answers,
    /// What is known of more than the pose.
    pub studies: &'a Studies,
    /// The design to compare with.
    pub pinned: Option<&'a Pinned>,
    /// Units.
    pub settings: Settings,
}

/// Where things are on the screen.
#[derive(Clone, Copy, Debug)]
struct Places {
    canvas: Rect,
    plot: Rect,
}

/// A line for the user.
#[derive(Clone, Debug)]
struct Notice {
    text: String,
    /// Something went wrong, or was refused.
    fault: bool,
}

/// What is on show at the start.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// This scenario, which must be physical, rather than that of the last time.
    pub scenario: Option<Scenario>,
    /// What this link says, even before that.
    pub link: Option<String>,
}

/// The analysis on show.
#[derive(Clone, Debug, PartialEq)]
pub struct OnShow<'a> {
    /// The last complete analysis.
    pub report: &'a Report,
    /// The document's state that it belongs to.
    pub revision: Revision,
    /// Whether the document is still in that state.
    pub current: bool,
}

impl Tautline {
    /// The application. Where it is not told what to show, it shows what it showed when it ended, else the paper's robot.
    pub fn new(context: &eframe::CreationContext<'_>, start: Start) -> Self {
        let storage = context.storage;
        let context = &context.egui_ctx;
        theme::install_fonts(context);
        let (wake, wake_for_studies) = (context.clone(), context.clone());
        let mut answers = Answers::default();
        let compute = match Compute::start(move || wake.request_repaint()) {
            Ok(compute) => Some(compute),
            Err(reason) => {
                answers.break_down(reason);
                None
            }
        };
        // Held until the first answer is there, which comes before all studies.
        let mut pool = Pool::new(move || wake_for_studies.request_repaint());
        pool.hold(true);
        pool.prepare();
        let last = storage.and_then(persist::document);
        let first = || presets::PRESETS[0].scenario();
        let (linked, notice) = match start.link.map(|link| apply::read(&link)) {
            Some(Ok(scenario)) => (Some(scenario), None),
            Some(Err(text)) => (Some(first()), Some(Notice { text, fault: true })),
            None => (None, None),
        };
        let opened = linked.or(start.scenario).map(Document::opened);
        let document = opened.or_else(|| last.clone()).unwrap_or_else(|| Document::opened(first()));
        let mut history = History::new(last.as_ref().unwrap_or(&document));
        // What was there the last time comes back with undo.
        history.step(&document);
        let mut app = Self {
            keeper: Keeper::new(last),
            document,
            history,
            state: storage.and_then(persist::state).unwrap_or_default(),
            answers,
            compute,
            studies: Studies::default(),
            pinned: None,
            pinning: false,
            pool,
            files: Files::default(),
            applied: Settings::default(),
            plots_open: false,
            places: Places { canvas: Rect::NOTHING, plot: Rect::NOTHING },
            layer: canvas::map::Layer::default(),
            joined: panels::campbell::Modes::default(),
            windows: windows::Runtime::default(),
            revision: 0,
            notice,
            commands: Vec::new(),
            #[cfg(target_arch = "wasm32")]
            page: page::Page::new(context),
        };
        app.analyze();
        app
    }

    /// The scenario on show.
    pub fn scenario(&self) -> &Scenario {
        &self.document.scenario
    }

    /// The last complete analysis.
    pub fn analysis(&self) -> Option<OnShow<'_>> {
        self.answers.complete().map(|(report, revision, current)| OnShow { report, revision, current })
    }

    /// The message on the screen, such as that input was refused.
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_ref().map(|notice| notice.text.as_str())
    }

    /// [Re λ, Im λ] of the mode whose shape is on the canvas, in 1/s.
    pub fn mode_on_show(&self) -> Option<[f64; 2]> {
        self.answers.shape().map(|shape| shape.eigenvalue)
    }

    /// How far the last complete answer was behind the edit that it answers, in ms.
    pub fn trail_ms(&self) -> Option<f64> {
        self.answers.trail_ms()
    }

    /// How far a study has come: places answered, all places, and whether it is finished.
    pub fn study(&self, topic: Topic) -> (usize, usize, bool) {
        let progress = self.studies.progress(topic);
        (progress.done, progress.total, progress.stage == studies::Stage::Finished)
    }

    /// Sends the document to the engine.
    fn analyze(&mut self) {
        self.revision += 1;
        self.answers.expect(self.revision);
        let job = Job {
            revision: self.revision,
            scenario: self.document.scenario.to_json(),
            max_speed: DEFAULT_MAX_SPEED,
            mode: self.state.mode,
        };
        self.submit(&Request::Analyze(job));
    }

    fn submit(&mut self, request: &Request) {
        if let Some(Err(reason)) = self.compute.as_mut().map(|compute| compute.submit(request)) {
            self.answers.break_down(reason);
        }
    }

    fn carry_out(&mut self, orders: impl IntoIterator<Item = Order>) {
        for order in orders {
            match order {
                Order::Want(job) => self.pool.want(job),
                Order::Cancel(topic) => self.pool.cancel(topic),
            }
        }
    }

    /// Asks for the studies of what is open and takes in what is known of them.
    fn study_on(&mut self) {
        let critical = self.answers.last_critical().and_then(|answer| answer.critical.as_ref()).map(|c| c.speed);
        let plot = self.plots_open.then_some(self.state.plot);
        let wishes = studies::wanted(&self.document.scenario, &self.state, plot, critical);
        let orders = self.studies.want(wishes);
        let idle = !self.studies.is_working();
        // The pool has one study of each topic: the pinned design's go first, to make room for the present one's.
        let for_pinned = self.pinned.as_mut().map(|pinned| pinned.want(idle, &self.state, plot));
        self.carry_out(for_pinned.into_iter().flatten().chain(orders));
        // Both want all of the machine; who drags must not wait. Between two poses the studies go on, so that the line
        // follows the drag.
        self.pool.hold(matches!(self.answers.critical(), CriticalState::Recomputing { .. }));
        for news in self.pool.poll() {
            if let Some(pinned) = &mut self.pinned {
                pinned.take(news.clone());
            }
            self.studies.take(news);
        }
        if self.pinning && self.answers.all_current() {
            self.pinning = false;
            self.pinned = Some(Pinned::new(self.document.scenario.clone(), self.answers.clone()));
        }
    }

    fn take_replies(&mut self) {
        let replies = self.compute.as_mut().map(Compute::poll).unwrap_or_default();
        for reply in replies {
            // A chosen mode is followed while the robot changes: the next one wanted is the nearest to this.
            if let (Update::Shape(shape), Which::Near(_)) = (&reply.update, self.state.mode.which)
                && !shape.is_critical
            {
                self.state.mode.which = Which::Near(shape.eigenvalue);
            }
            // An older search may end with its critical mode after another one was chosen.
            let other = matches!(&reply.update, Update::Shape(shape) if shape.is_critical)
                && self.state.mode.which != Which::Critical;
            if !other {
                self.answers.take(reply);
            }
        }
    }

    fn animate(&mut self, context: &egui::Context) {
        if !self.state.playback.playing {
            return;
        }
        if let Some(shape) = self.answers.shape() {
            let seconds = f64::from(context.input(|input| input.stable_dt)).min(0.1);
            let advance = canvas::phase_advance(shape, &self.state.playback, seconds);
            self.state.playback.phase = (self.state.playback.phase + advance) % std::f64::consts::TAU;
            context.request_repaint();
        }
    }

    fn notice_bar(&mut self, ui: &mut Ui) {
        let Some(notice) = &self.notice else { return };
        Panel::bottom("notice").show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                if notice.fault {
                    ui.colored_label(theme::warning(ui.visuals()), "▲");
                }
                ui.label(&notice.text);
                if ui.small_button("Dismiss").clicked() {
                    self.commands.push(Command::DismissNotice);
                }
            });
        });
    }

    fn wide(&mut self, ui: &mut Ui) {
        Panel::left("controls").default_size(380.0).min_size(340.0).show(ui, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                self.controls(ui);
            });
        });
        Panel::right("answer").default_size(340.0).min_size(280.0).show(ui, |ui| {
            ui.add_space(6.0);
            panels::answer::ui(ui, self.facts());
            ui.separator();
            self.plots(ui);
        });
        CentralPanel::no_frame().show(ui, |ui| self.canvas(ui));
    }

    fn narrow(&mut self, ui: &mut Ui) {
        let height = ui.available_height();
        Panel::top("canvas").exact_size(0.4 * height).resizable(false).frame(egui::Frame::NONE).show(ui, |ui| {
            self.canvas(ui);
        });
        CentralPanel::default().show(ui, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                panels::answer::ui(ui, self.facts());
                ui.separator();
                ui.horizontal(|ui| {
                    ui.selectable_value(&mut self.state.page, Page::Controls, "Controls");
                    ui.selectable_value(&mut self.state.page, Page::Plots, "Plots");
                });
                match self.state.page {
                    Page::Controls => {
                        self.controls(ui);
                    }
                    Page::Plots => self.plots(ui),
                }
            });
        });
    }

    fn facts(&self) -> Facts<'_> {
        let Self { document, answers, studies, pinned, state, .. } = self;
        Facts { document, answers, studies, pinned: pinned.as_ref(), settings: state.settings }
    }

    fn controls(&mut self, ui: &mut Ui) {
        let Self { state, document, answers, studies, pinned, commands, .. } = self;
        let facts = Facts { document, answers, studies, pinned: pinned.as_ref(), settings: state.settings };
        panels::controls::ui(&mut state.unlocked, ui, facts, commands);
    }

    fn plots(&mut self, ui: &mut Ui) {
        self.plots_open = true;
        let Self { joined, state, document, answers, studies, pinned, commands, .. } = self;
        let facts = Facts { document, answers, studies, pinned: pinned.as_ref(), settings: state.settings };
        self.places.plot = panels::plots::ui(joined, state, ui, facts, commands);
    }

    fn canvas(&mut self, ui: &mut Ui) {
        let Self { layer, state, document, answers, studies, pinned, commands, .. } = self;
        let facts = Facts { document, answers, studies, pinned: pinned.as_ref(), settings: state.settings };
        self.places.canvas = canvas::ui(layer, state, ui, facts, commands);
    }

    fn menu(&mut self, ui: &mut Ui) {
        let possible = Possible {
            undo: self.history.can_undo(&self.document),
            redo: self.history.can_redo(&self.document),
            reset: self.document.scenario != self.document.original,
            unpin: self.pinned.is_some() || self.pinning,
        };
        menu::ui(ui, &mut self.state, possible, &mut self.commands);
    }

    /// Carries out what has changed in the settings.
    fn apply_settings(&mut self, context: &egui::Context) {
        let settings = self.state.settings;
        if settings.theme != self.applied.theme {
            theme::choose(context, settings.theme);
        }
        if settings.motion != self.applied.motion && settings.reduces_motion() {
            self.state.playback.playing = false;
            context.all_styles_mut(|style| style.animation_time = 0.0);
        }
        self.applied = settings;
    }

    /// Writes down what is to survive a restart.
    fn keep(&mut self, context: &egui::Context, frame: &mut eframe::Frame) {
        if let Some(storage) = frame.storage_mut()
            && let Some(wait) = self.keeper.keep(storage, &self.document)
        {
            context.request_repaint_after(wait);
        }
    }
}

impl eframe::App for Tautline {
    fn logic(&mut self, context: &egui::Context, frame: &mut eframe::Frame) {
        menu::keys(context, &mut self.state, &mut self.commands);
        self.commands.extend(self.files.poll(context));
        #[cfg(target_arch = "wasm32")]
        self.commands.extend(self.page.news());
        for command in std::mem::take(&mut self.commands) {
            self.apply(context, command);
        }
        self.history.watch(context, &self.document);
        self.take_replies();
        self.study_on();
        self.keep(context, frame);
        if self.studies.is_working() || self.pinned.as_ref().is_some_and(Pinned::is_working) {
            context.request_repaint_after(HEARTBEAT);
        }
        self.animate(context);
        self.apply_settings(context);
        #[cfg(target_arch = "wasm32")]
        self.page.publish(&self.document.scenario, &self.answers, &self.studies, frame.info().cpu_usage);
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.menu(ui);
        self.notice_bar(ui);
        self.plots_open = false;
        if ui.available_width() < NARROW {
            self.narrow(ui);
        } else {
            self.wide(ui);
        }
        windows::ui(ui.ctx(), &mut self.state, &mut self.windows);
        files::announce_drop(ui.ctx());
        // Commands are carried out before the next frame; without one nothing would be seen of them.
        if !self.commands.is_empty() {
            ui.ctx().request_repaint();
        }
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        persist::keep_state(storage, &self.state);
    }

    fn auto_save_interval(&self) -> Duration {
        Duration::from_secs(2)
    }
}
