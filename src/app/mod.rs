//! The interface, in the browser and on the desktop.
//!
//! The document (`state`) is what the user edits; everything else on the screen follows from it. Panels draw and emit
//! commands; [`Tautline::logic`](eframe::App::logic) carries them out, sends the document to the engine and
//! takes in its replies.

#[cfg(any(test, target_arch = "wasm32"))]
mod announce;
mod answers;
mod apply;
mod arrangement;
mod bar;
mod canvas;
mod certainty;
mod command;
mod comparison;
mod designs;
mod digits;
mod engine;
mod export;
mod facts;
mod fields;
mod files;
mod flying;
mod gestures;
mod history;
mod icons;
mod keys;
mod layout;
mod limits;
mod meaning;
#[cfg(target_arch = "wasm32")]
mod mirror;
mod name;
mod notices;
mod number;
#[cfg(target_arch = "wasm32")]
mod page;
mod panels;
mod paths;
mod persist;
mod picture;
mod regions;
mod round;
mod screen;
mod series;
mod settings;
mod shortcuts;
mod state;
mod studies;
#[cfg(test)]
mod tests;
mod theme;
mod tone;
mod tour;
mod transport;
mod tree;
mod view_link;
mod what_if;
mod windows;
mod words;

use std::time::Duration;

use eframe::egui::{self, Event, Ui};

use answers::{Answers, CriticalState};
use command::Command;
use designs::Designs;
use engine::Engine;
use facts::Present;
use files::Files;
use flying::Flying;
use history::History;
use notices::{About, Notices};
use persist::{Keeper, Keeping, Kept};
use screen::Screen;
use state::{Document, Movement, Session, UiState};
use studies::{Joined, Owner, SharedPool, Studies};

pub use picture::raster;
pub use tree::layout;

use crate::compute::Pool;
use crate::compute::protocol::{Reply, Request, Revision, Topic, Update, Which};
use crate::scenario::{Report, Scenario, presets};

#[cfg(target_arch = "wasm32")]
pub use page::{is_embedded, take_kept, take_link};

/// All texts of a presentation are this much larger.
const PRESENTED: f32 = 1.5;
/// While studies are at work the pool is looked after at least this often.
const HEARTBEAT: Duration = Duration::from_millis(100);
/// While the engine owes an answer it is looked after at least this often.
const ENGINE_HEARTBEAT: Duration = Duration::from_millis(500);

/// The application.
pub struct Tautline {
    /// To wake the interface with.
    context: egui::Context,
    present: Present,
    history: History,
    state: UiState,
    session: Session,
    screen: Screen,
    engine: Engine,
    pool: SharedPool,
    files: Files,
    kept: Kept,
    notices: Notices,
    commands: Vec<Command>,
    #[cfg(target_arch = "wasm32")]
    page: page::Page,
    #[cfg(target_arch = "wasm32")]
    tone: tone::Tone,
}

/// What is on show at the start.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// This scenario, which must be physical, rather than that of the last time.
    pub scenario: Option<Scenario>,
    /// What this link says, even before that.
    pub link: Option<String>,
    /// Whether first visitors are shown around.
    pub tour: bool,
    /// The page is a frame in another page.
    pub embedded: bool,
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
        // A frame in somebody's page keeps nothing: what it shows is the page's, and not the visitor's own.
        let own = if start.embedded { None } else { persist::own() };
        let shared = context.storage.filter(|_| !start.embedded);
        let storages: Vec<&dyn eframe::Storage> = own.as_deref().into_iter().chain(shared).collect();
        let context = &context.egui_ctx;
        theme::install_fonts(context);
        let coarse = coarse_pointer();
        theme::install_style(context, coarse);
        gestures::install(context);
        tree::install(context);
        let wake_for_studies = context.clone();
        // Held until the first answer is there, which comes before all studies.
        let mut pool = Pool::new(move || wake_for_studies.request_repaint());
        pool.hold(true);
        pool.prepare();
        let last = persist::document(&storages);
        let state = persist::state(&storages).unwrap_or_default();
        let first = || presets::PRESETS[0].scenario();
        let mut notices = Notices::default();
        let view = start.link.as_deref().and_then(view_link::part).map(ToOwned::to_owned);
        let linked = start.link.map(|link| {
            files::scenario(&link).unwrap_or_else(|text| {
                notices.complain(About::Action, text);
                first()
            })
        });
        let opened = linked.or(start.scenario).map(Document::opened);
        let is_opened = opened.is_some();
        let document = opened.or_else(|| last.clone()).unwrap_or_else(|| Document::opened(first()));
        let mut history = History::new(last.as_ref().unwrap_or(&document));
        // What was there the last time comes back with undo.
        history.step(&document);
        let mut app = Self {
            context: context.clone(),
            present: Present {
                document,
                answers: Answers::default(),
                studies: Studies::default(),
                joined: Joined::default(),
                flying: Flying::default(),
                designs: if start.embedded { Designs::default() } else { persist::designs(&storages) },
            },
            history,
            state,
            session: Session::default(),
            screen: Screen { coarse, zoom: 1.0, ..Screen::default() },
            engine: Engine::new(context),
            pool: SharedPool::new(pool),
            files: Files::new(context),
            kept: Kept { keeper: Keeper::new(&storages), own },
            notices,
            commands: Vec::new(),
            #[cfg(target_arch = "wasm32")]
            page: page::Page::new(context),
            #[cfg(target_arch = "wasm32")]
            tone: tone::Tone::default(),
        };
        app.session.embedded = start.embedded;
        // A robot that is opened with a path is opened to look at the path.
        if is_opened && app.present.document.scenario.path.is_some() && app.state.dock == state::Plot::Line {
            app.state.dock = state::Plot::Path;
        }
        if start.tour && !app.state.tour_taken && !start.embedded {
            app.session.tour = Some(tour::Tour::default());
        }
        if let Some(view) = view {
            view_link::apply(&view, &mut app.state, &mut app.session);
        }
        if app.state.settings.reduces_motion() {
            app.reduce_motion(context);
        }
        app.analyze();
        app
    }

    /// The scenario on show.
    pub fn scenario(&self) -> &Scenario {
        &self.present.document.scenario
    }

    /// The last complete analysis.
    pub fn analysis(&self) -> Option<OnShow<'_>> {
        self.present.answers.last_complete().map(|(report, revision, current)| OnShow { report, revision, current })
    }

    /// The newest message on the screen, such as that input was refused.
    pub fn notice(&self) -> Option<&str> {
        self.notices.lines().last().map(|notice| notice.text.as_str())
    }

    /// [Re λ, Im λ] of the mode whose shape is on the canvas, in 1/s.
    pub fn mode_on_show(&self) -> Option<[f64; 2]> {
        self.present.answers.shape().map(|shape| shape.eigenvalue)
    }

    /// How far the last complete answer was behind the edit that it answers, in ms.
    pub fn trail_ms(&self) -> Option<f64> {
        self.present.answers.trail_ms()
    }

    /// How far a study has come: places answered, all places, and whether it is finished.
    pub fn study(&self, topic: Topic) -> (usize, usize, bool) {
        let progress = self.present.studies.progress(topic);
        (progress.done, progress.total, progress.stage == studies::StudyStage::Finished)
    }

    /// The designs that are kept, each with its letter and whether all is known of its pose.
    pub fn designs(&self) -> Vec<(&'static str, &Scenario, bool)> {
        let all = self.present.designs.all();
        all.map(|(letter, design)| (letter.name(), &design.document.scenario, design.is_complete())).collect()
    }

    /// The topics that have a study at work, for the present design or a kept one.
    pub fn at_work(&self) -> Vec<Topic> {
        Topic::ALL.into_iter().filter(|topic| self.pool.is_at_work(*topic)).collect()
    }

    /// Has the document analysed as it is now.
    fn analyze(&mut self) {
        let Present { document, answers, .. } = &mut self.present;
        self.engine.analyze(&document.scenario, self.session.mode, answers);
    }

    /// The engine is gone, or does not answer: starts it again, but not for ever.
    fn engine_lost(&mut self, reason: String) {
        self.screen.windows.validation.ask_again();
        if !self.engine.lose() {
            self.present.answers.break_down(reason);
            return;
        }
        self.analyze();
        if self.engine.compute.is_some() {
            self.complain(format!("The computation was lost ({reason}) and has been started again."));
        }
    }

    fn submit(&mut self, request: &Request) {
        self.engine.submit(request, &mut self.present.answers);
    }

    /// Asks for the studies of what is open and takes in what is known of them.
    fn study_on(&mut self) {
        let critical =
            self.present.answers.last_critical().and_then(|answer| answer.critical.as_ref()).map(|c| c.speed);
        // A pose without an answer has no studies of its own: those of the last one stay, grey.
        let has_others = |plot: &state::Plot| matches!(plot, state::Plot::Line | state::Plot::WhatIf);
        let of_pose = |plot: &state::Plot| !has_others(plot) && self.present.answers.pose_failed();
        let plots: Vec<state::Plot> = self.screen.plots.iter().copied().filter(|plot| !of_pose(plot)).collect();
        let plots = plots.as_slice();
        let at_rest = self.present.answers.all_current() && !self.context.input(|input| input.pointer.any_down());
        let mut requests = studies::wanted(&self.present.document.scenario, &self.state, plots, critical, at_rest);
        let limits = self.session.windows.fastest.then_some(&self.state.limits);
        requests.extend(studies::on_path(&self.present.document.scenario, plots, limits, &self.present.studies));
        let flight = self.present.flying.wanted(&self.present.document.scenario);
        // A drag is not disturbed by one that is new; one at work goes on.
        let flight = flight.filter(|flight| at_rest || self.present.studies.has(flight));
        requests.extend(flight);
        let orders = self.present.studies.want(requests);
        let idle = !self.present.studies.is_working();
        // The pool has one study of each topic: the kept designs' go first, to make room for the present one's.
        for (letter, orders) in self.present.designs.want(idle, &self.state, plots) {
            self.pool.carry_out(Owner::Kept(letter as usize), orders);
        }
        self.pool.carry_out(Owner::Present, orders);
        let diagram =
            plots.contains(&state::Plot::Campbell).then(|| self.present.studies.shown(Topic::Campbell)).flatten();
        let order = self.present.joined.want(diagram.map(|shown| shown.known), self.state.campbell_hz);
        self.pool.carry_out(Owner::Present, order);
        // Both want all of the machine; who drags must not wait. Between two poses the studies go on, so that the line
        // follows the drag.
        self.pool.hold(matches!(self.present.answers.critical(), CriticalState::Recomputing { .. }));
        for (owner, news) in self.pool.poll() {
            match owner {
                Owner::Present => {
                    self.present.joined.take(&news);
                    self.present.studies.take(news);
                }
                Owner::Kept(place) => self.present.designs.take(place, news),
            }
        }
        let wake = self.context.clone();
        if let Err(reason) = self.present.designs.go_on(move || wake.request_repaint()) {
            self.complain(reason);
        }
    }

    fn take_replies(&mut self) {
        for reply in self.engine.poll() {
            let reply = match reply {
                Reply { update: Update::Checked(answer), .. } => {
                    self.screen.windows.validation.take(*answer);
                    continue;
                }
                Reply { update: Update::Broken(reason), .. } => {
                    // What else this engine has said, such as that it is lost in another way too, is not about the next one.
                    self.engine_lost(reason);
                    return;
                }
                reply => reply,
            };
            // A chosen mode is followed while the robot changes: the next one wanted is the nearest to this.
            if let (Update::Shape(shape), Which::Near(_)) = (&reply.update, self.session.mode.which)
                && !shape.is_critical
            {
                self.session.mode.which = Which::Near(shape.eigenvalue);
            }
            // An older search may end with its critical mode after another one was chosen.
            let other = matches!(&reply.update, Update::Shape(shape) if shape.is_critical)
                && self.session.mode.which != Which::Critical;
            if !other {
                self.present.answers.take(reply);
            }
        }
    }

    fn animate(&mut self, context: &egui::Context) {
        if !self.state.playback.playing {
            return;
        }
        let seconds = f64::from(context.input(|input| input.stable_dt)).min(0.1);
        if self.flies() {
            if let Some(end) = self.flight_end() {
                self.state.playback.playing = self.present.flying.advance(end, seconds);
                context.request_repaint();
            }
            return;
        }
        if self.present.answers.shape().is_some() {
            canvas::advance(&mut self.state.playback, &self.present.answers, seconds);
            context.request_repaint();
        }
    }

    /// Whether the flight is what moves.
    fn flies(&self) -> bool {
        self.state.playback.movement == Movement::Fly && self.present.document.scenario.path.is_some()
    }

    /// Until when the flight goes that is known, in s.
    fn flight_end(&self) -> Option<f64> {
        self.facts().flown().map(|flown| flown.flight.lost.unwrap_or(flown.flight.end))
    }

    fn reduce_motion(&mut self, context: &egui::Context) {
        self.state.playback.playing = false;
        context.all_styles_mut(|style| style.animation_time = 0.0);
    }

    /// Carries out what has changed in the settings.
    fn apply_settings(&mut self, context: &egui::Context) {
        let settings = self.state.settings;
        if settings.theme != self.screen.applied.theme {
            theme::choose(context, settings.theme);
        }
        if settings.motion != self.screen.applied.motion && settings.reduces_motion() {
            self.reduce_motion(context);
        }
        let present = if self.session.present { PRESENTED } else { 1.0 };
        let zoom = present * 0.01 * f32::from(settings.text_percent);
        if (zoom - self.screen.zoom).abs() > 1e-3 {
            self.screen.zoom = zoom;
            context.set_zoom_factor(zoom);
        }
        self.screen.applied = settings;
    }

    /// Writes down what is to survive a restart.
    fn keep(&mut self, context: &egui::Context, frame: &mut eframe::Frame) {
        if self.session.embedded {
            return;
        }
        // Coming back to a window makes it the one that was used last.
        if context.input(|input| input.events.contains(&Event::WindowFocused(true))) {
            self.kept.keeper.renew();
        }
        let shared = frame.storage_mut().map(|storage| -> &mut dyn eframe::Storage { storage });
        let mut storages = persist::storages(&mut self.kept.own, shared);
        if let Some(wait) = self.kept.keeper.keep(&mut storages, &self.present.document) {
            context.request_repaint_after(wait);
        }
        match self.kept.keeper.news() {
            Some(Keeping::Refused) => self.notices.complain(
                About::Storage,
                "What you do here is not kept when this is closed: its storage is full or blocked. Save the scenario as \
                 a file, or share it as a link."
                    .into(),
            ),
            Some(Keeping::Kept) => self.notices.succeed(About::Storage),
            None => {}
        }
    }
}

/// Whether the pointer is a finger. Desktop systems do not tell.
fn coarse_pointer() -> bool {
    #[cfg(target_arch = "wasm32")]
    let coarse = web_sys::window()
        .and_then(|window| window.match_media("(pointer: coarse)").ok().flatten())
        .is_some_and(|query| query.matches());
    #[cfg(not(target_arch = "wasm32"))]
    let coarse = false;
    coarse
}

impl eframe::App for Tautline {
    fn logic(&mut self, context: &egui::Context, frame: &mut eframe::Frame) {
        keys::carry_out(&mut self.state, &mut self.session, context, &mut self.commands);
        self.commands.extend(self.files.poll(context));
        #[cfg(target_arch = "wasm32")]
        self.commands.extend(self.page.news());
        self.notices.drag(context.input(|input| input.pointer.any_down()));
        for command in std::mem::take(&mut self.commands) {
            self.apply(context, command);
        }
        self.history.watch(context, &self.present.document);
        self.take_replies();
        let awaited = self.present.answers.are_awaited() || self.present.designs.are_awaited();
        if awaited || self.screen.windows.validation.is_waiting() {
            context.request_repaint_after(ENGINE_HEARTBEAT);
        }
        self.study_on();
        self.keep(context, frame);
        let working = self.present.studies.is_working() || self.present.joined.is_working();
        if working || self.present.designs.are_studied() {
            context.request_repaint_after(HEARTBEAT);
        }
        self.animate(context);
        #[cfg(target_arch = "wasm32")]
        self.tone.sound(
            self.present
                .answers
                .shape()
                .filter(|_| self.session.sound)
                .map(|shape| shape.eigenvalue[1].abs() / std::f64::consts::TAU),
        );
        self.apply_settings(context);
        #[cfg(target_arch = "wasm32")]
        {
            let facts = self.present.facts(self.state.settings, self.session.mode);
            self.page.publish(facts, frame.info().cpu_usage);
            let lines: Vec<&str> = self.notices.lines().iter().map(|line| line.text.as_str()).collect();
            let notice = number::message(context).or_else(|| (!lines.is_empty()).then(|| lines.join(" ")));
            self.page.tell(
                notice.or_else(|| tour::text(&self.session)).or_else(|| self.screen.windows.text(self.session.windows)),
            );
        }
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.notice_bar(ui);
        self.screen(ui);
        let Self { screen, session, state, commands, present, .. } = self;
        let facts = present.facts(state.settings, session.mode);
        windows::ui(&mut screen.windows, &mut session.windows, state, ui.ctx(), facts, commands);
        files::announce_drop(ui.ctx());
        words::ui(&mut self.session.word, ui.ctx());
        let facts = self.present.facts(self.state.settings, self.session.mode);
        tour::ui(&mut self.state, &mut self.session, ui.ctx(), &self.screen.regions, facts);
        // A browser lets a page use the clipboard only while it handles the click that asks for it.
        for command in self.commands.extract_if(.., |command| command.uses_clipboard()).collect::<Vec<_>>() {
            self.apply(ui.ctx(), command);
        }
        // Commands are carried out before the next frame; without one nothing would be seen of them.
        if !self.commands.is_empty() {
            ui.ctx().request_repaint();
        }
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        if self.session.embedded {
            return;
        }
        let mut storages = persist::storages(&mut self.kept.own, Some(storage));
        persist::keep_state(&mut storages, &self.state);
        persist::keep_designs(&mut storages, &self.present.designs);
    }

    fn auto_save_interval(&self) -> Duration {
        Duration::from_secs(2)
    }
}
