//! Commands carried out, between two frames.

use eframe::egui::{Context, Id, Vec2};

use super::designs::Action;
use super::export::{self, Content};
use super::facts::Present;
use super::files::{self, Clip};
use super::notices::About;
use super::panels::plots;
use super::picture::{self, Format, Frame, Picture};
use super::state::{Document, Plot, SheetTab, UiState};
use super::studies::Owner;
use super::theme::{self, Tokens};
use super::{Command, Tautline, canvas, fields, number, paths, view_link};
use crate::compute::protocol::{Request, Topic};
use crate::scenario::report::sentence;
use crate::scenario::{Parameter, Scenario, link, table};

/// Said where there is nothing to save.
const NOTHING: &str = "There is nothing to save yet: it is not on show, or still being computed.";

impl Tautline {
    #[expect(clippy::too_many_lines)] // One arm for each command.
    pub(super) fn apply(&mut self, context: &Context, command: Command) {
        match command {
            Command::Edit(scenario) => {
                let original = self.present.document.original.clone();
                self.edit(Document { scenario: *scenario, original });
            }
            Command::Load(scenario) => self.open(Document::opened(*scenario)),
            Command::Read(text) if files::is_table(&text) => self.take_cables(&text),
            Command::Read(text) => match files::scenario(&text) {
                Ok(scenario) => {
                    self.open(Document::opened(scenario));
                    if let Some(view) = view_link::part(&text) {
                        view_link::apply(view, &mut self.state, &mut self.session);
                    }
                }
                Err(reason) => self.complain(reason),
            },
            Command::Embed => {
                let text = view_link::embed(&self.link());
                self.files.copy(context, Clip { what: "The embed code", text, more: ".".into() });
            }
            Command::Flight(action) => self.present.flying.act(action),
            Command::Step(steps) if self.flies() => {
                self.state.playback.playing = false;
                if let Some(end) = self.flight_end() {
                    self.present.flying.step(end, steps);
                }
            }
            Command::Step(steps) => canvas::step(&mut self.state.playback, &self.present.answers, steps),
            Command::BackToFeasible => {
                if let Some(position) = self.present.answers.last_feasible() {
                    let mut document = self.present.document.clone();
                    document.scenario.motion.position = position;
                    self.edit(document);
                }
            }
            Command::OpenWhole => {
                let robot = link::encode(&self.present.document.scenario);
                context.open_url(eframe::egui::OpenUrl::new_tab(format!("{}{}{robot}", address(), link::MARK)));
            }
            Command::OpenText => {
                let robot = link::encode(&self.present.document.scenario);
                context.open_url(eframe::egui::OpenUrl::same_tab(format!("text.html{}{robot}", link::MARK)));
            }
            Command::ExplainWord(word) => self.session.word = Some(word),
            Command::Share => self.share(context),
            Command::Undo => {
                if let Some(before) = self.history.undo(&self.present.document) {
                    self.edit(before);
                }
            }
            Command::Redo => {
                if let Some(after) = self.history.redo(&self.present.document) {
                    self.edit(after);
                }
            }
            Command::Reset => self.open(Document::opened(self.present.document.original.clone())),
            Command::Design(action) => self.design(action),
            Command::CopyDesigns => {
                let text = export::designs(self.facts()).tsv();
                self.files.copy(context, Clip { what: "The table of designs", text, more: ".".into() });
            }
            Command::ShowFastest => self.session.windows.fastest = true,
            Command::AddPath => self.add_path(),
            Command::Open => self.files.open(context),
            Command::Save(content) => self.save_content(context, content),
            Command::CopyModes => match export::plot(Plot::Modes, self.facts()) {
                Some(table) => {
                    self.files.copy(context, Clip { what: "The table of modes", text: table.tsv(), more: ".".into() });
                }
                None => self.complain("There are no modes to copy at this pose.".into()),
            },
            Command::CopyCables => {
                let text = table::write(&self.present.document.scenario);
                self.files.copy(context, Clip { what: "The table of cables", text, more: ".".into() });
            }
            Command::Paste => self.files.paste(context),
            Command::ChooseMode(choice) => {
                self.session.mode = choice;
                self.submit(&Request::Shape(choice));
                self.notices.succeed(About::Action);
            }
            Command::Reveal(parameter) => self.reveal(parameter),
            Command::WhatIf(parameter) => self.what_if(parameter),
            Command::Check(index) => self.submit(&Request::Check(index)),
            Command::StopStudy(topic) => {
                let order = self.present.studies.stop(topic);
                self.pool.carry_out(Owner::Present, order);
                self.notices.succeed(About::Action);
            }
            Command::ResumeStudy(topic) => {
                let order = self.present.studies.resume(topic);
                self.pool.carry_out(Owner::Present, order);
                self.notices.succeed(About::Action);
            }
            Command::Done(text) => {
                self.notices.succeed(About::Action);
                if let Some(text) = text {
                    self.notices.tell(text);
                }
            }
            Command::Complain(text) => self.complain(text),
            Command::DismissNotice(index) => self.notices.dismiss(index),
        }
    }

    /// Puts a link on the clipboard.
    fn share(&self, context: &Context) {
        let link = self.link();
        let use_of_it = if address().is_empty() {
            ", to be pasted here or put behind the address of a page with Tautline"
        } else {
            ""
        };
        let more = format!("{use_of_it}: {link}");
        self.files.copy(context, Clip { what: "The link", text: link, more });
    }

    /// Does something with the designs that are kept.
    fn design(&mut self, action: Action) {
        let moved = match action {
            Action::WorkOn(letter) | Action::Remove(letter) => [Some(letter), None],
            Action::Exchange(one, other) => [Some(one), Some(other)],
            _ => [None, None],
        };
        for letter in moved.into_iter().flatten() {
            let orders = self.present.designs.rest(letter);
            self.pool.carry_out(Owner::Kept(letter as usize), orders);
        }
        let Present { designs, document, answers, .. } = &mut self.present;
        let mut done = Ok(());
        match action {
            Action::Keep => done = designs.keep(document.clone(), answers),
            Action::WorkOn(letter) => {
                if let Some(document) = designs.swap(letter, document.clone(), answers) {
                    self.open(document);
                }
            }
            Action::Show(letter, shown) => designs.show(letter, shown),
            Action::Rename(letter, name) => designs.rename(letter, name),
            Action::Exchange(one, other) => designs.exchange(one, other),
            Action::Remove(letter) => designs.remove(letter),
        }
        match done {
            Ok(()) => self.notices.succeed(About::Action),
            Err(reason) => self.complain(reason),
        }
    }

    /// Brings the control of a number into view.
    fn reveal(&mut self, parameter: Parameter) {
        self.session.revealed = Some(parameter);
        self.state.sheet = match parameter {
            Parameter::Speed | Parameter::Direction | Parameter::DirectionComponent(_) | Parameter::Position(_) => {
                SheetTab::Move
            }
            _ if parameter.path().starts_with("path.") => SheetTab::Move,
            _ => SheetTab::Robot,
        };
        self.state.panels.left = true;
        self.state.panels.left_where_narrow = true;
        self.session.large = None;
    }

    /// Varies a number in the plot that has shown the sensitivities.
    fn what_if(&mut self, parameter: Parameter) {
        self.state.what_if.choose(parameter);
        let large = self.session.large.iter_mut();
        for plot in [&mut self.state.plot, &mut self.state.second, &mut self.state.dock].into_iter().chain(large) {
            if *plot == Plot::Sensitivities {
                *plot = Plot::WhatIf;
            }
        }
    }

    /// A path to where one usually leads, as a step of its own.
    fn add_path(&mut self) {
        let scenario = &self.present.document.scenario;
        let border = self.present.studies.shown(Topic::Border).map(|shown| shown.known);
        let end = paths::usual_end(scenario, canvas::frame(scenario), border);
        let Some(scenario) = paths::begun(scenario, end) else { return };
        let document = Document { scenario, original: self.present.document.original.clone() };
        self.history.step(&self.present.document);
        self.edit(document);
        self.history.step(&self.present.document);
    }

    /// A link to the robot as it is looked at.
    fn link(&self) -> String {
        let robot = link::encode(&self.present.document.scenario);
        let view = view_link::encode(&self.state, &self.session);
        format!("{}{}{robot}{view}", address(), link::MARK)
    }

    pub(super) fn complain(&mut self, text: String) {
        self.notices.complain(About::Action, text);
    }

    /// Starts from a document, as a step of its own.
    fn open(&mut self, document: Document) {
        self.history.step(&self.present.document);
        self.present.answers.begin(self.engine.revision + 1);
        self.edit(document);
        self.history.step(&self.present.document);
    }

    /// Takes the cables of a table over, as a step of its own. All else of the robot stays.
    fn take_cables(&mut self, text: &str) {
        let mut document = self.present.document.clone();
        match table::read(text, &document.scenario) {
            Ok(cables) => document.scenario.cables = cables,
            Err(reason) => return self.complain(reason),
        }
        let wanted = document.scenario.cables.clone();
        self.history.step(&self.present.document);
        self.edit(document);
        self.history.step(&self.present.document);
        if self.present.document.scenario.cables == wanted {
            self.notices.succeed(About::Action);
            self.notices.tell(format!("{} cables are taken from the table.", wanted.len()));
        }
    }

    /// Takes a document over, where it is physical; else says why not and keeps the last good one.
    fn edit(&mut self, document: Document) {
        if let Err(reason) = fields::check(&document.scenario, self.state.settings) {
            self.notices.complain(About::Robot, sentence(&reason));
            return;
        }
        self.notices.succeed(About::Robot);
        let document = document.called_rightly();
        let changed = document.scenario != self.present.document.scenario;
        let has_path = document.scenario.path.is_some();
        if has_path != self.present.document.scenario.path.is_some()
            && [Plot::Line, Plot::Path].contains(&self.state.dock)
        {
            // A new path is what there is to look at.
            self.state.dock = UiState::presented(has_path);
        }
        // Where the platform flies to changes no answer about where it is.
        let path = document.scenario.path.clone();
        let elsewhere = document.scenario != Scenario { path, ..self.present.document.scenario.clone() };
        self.present.document = document;
        if changed {
            number::forget_message(&self.context);
        }
        if elsewhere {
            self.engine.losses = 0;
            self.analyze();
        }
    }

    fn save_content(&mut self, context: &Context, content: Content) {
        let name = file_name(self.present.document.scenario.name.as_deref());
        let facts = self.facts();
        let (suffix, text) = match content {
            Content::Scenario => (".json", Some(facts.document.scenario.to_json() + "\n")),
            Content::Analysis => ("-analysis.json", export::analysis(facts)),
            Content::Plot(plot) => (export::suffix(plot), export::plot(plot, facts).map(|table| table.csv())),
            Content::Fastest => ("-fastest.csv", export::fastest(facts).map(|table| table.csv())),
            Content::Map => ("-map.csv", export::map(facts).map(|table| table.csv())),
            Content::PlotPicture(plot, chart, format) => {
                let name = [&name, "-", plot.name(), format.ending()].concat();
                return self.save_picture(context, &name, self.plot_picture(plot, chart, format));
            }
            Content::CanvasPicture(format) => {
                let name = [&name, "-canvas", format.ending()].concat();
                return self.save_picture(context, &name, Some(self.canvas_picture(format)));
            }
        };
        match text {
            Some(text) => self.files.save(context, &(name + suffix), text.into_bytes()),
            None => self.complain(NOTHING.into()),
        }
    }
}

/// Pictures of what is on the screen.
impl Tautline {
    fn save_picture(&mut self, context: &Context, name: &str, file: Option<Result<Vec<u8>, String>>) {
        match file {
            Some(Ok(bytes)) => self.files.save(context, name, bytes),
            Some(Err(reason)) => self.complain(format!("{name} could not be made: {reason}.")),
            None => self.complain(NOTHING.into()),
        }
    }

    /// A plot as the content of a file; nothing where there is nothing to see yet.
    pub(super) fn plot_picture(&self, plot: Plot, chart: Id, format: Format) -> Option<Result<Vec<u8>, String>> {
        let facts = self.facts();
        // Where the pose has no equilibrium, what is known of an earlier one is on show.
        if export::plot(plot, facts).is_none() && !facts.answers.pose_failed() {
            return None;
        }
        let (title, caption) = (plots::picture_title(plot, facts), picture::caption(facts));
        let size = plots::picture_size(plot, facts);
        let frame = Frame { margins: true, ground: self.tokens().panel, ..self.frame(&title, &caption, size) };
        let mut state = self.state.clone();
        let picture = Picture::new(frame, &mut |ui| {
            plots::picture(plot, &self.context, chart, &mut state, ui, facts);
        });
        Some(picture.file(format))
    }

    /// The canvas as the content of a file.
    pub(super) fn canvas_picture(&self, format: Format) -> Result<Vec<u8>, String> {
        let facts = self.facts();
        let (title, caption) = (picture::name(facts), picture::caption(facts));
        let on_screen = self.screen.regions.canvas.size();
        let shape = if on_screen.min_elem() > 0.0 { on_screen.y / on_screen.x } else { 0.5 };
        // Whole points, so that the pixels are exactly two to each.
        let height = (picture::PLOT.x * shape).clamp(350.0, 1000.0).round() + 150.0;
        let size = Vec2::new(picture::PLOT.x, height);
        let mut runtime = self.screen.canvas.for_picture();
        let picture = Picture::new(self.frame(&title, &caption, size), &mut |ui| {
            canvas::picture(&mut runtime, &self.state, &self.session, ui, facts);
        });
        picture.file(format)
    }

    fn tokens(&self) -> &'static Tokens {
        theme::tokens(&self.context.global_style().visuals)
    }

    fn frame<'a>(&self, title: &'a str, caption: &'a str, size: Vec2) -> Frame<'a> {
        let (theme, time) = (self.context.theme(), self.context.input(|input| input.time));
        Frame { title, caption, size, theme, ground: self.tokens().canvas, margins: false, time }
    }
}

/// The page's address without its fragment; empty on the desktop.
fn address() -> String {
    #[cfg(target_arch = "wasm32")]
    return super::page::address();
    #[cfg(not(target_arch = "wasm32"))]
    String::new()
}

/// A scenario's name as that of a file, without what file systems do not like.
fn file_name(name: Option<&str>) -> String {
    let kept = |c: char| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let name: String = name.unwrap_or_default().chars().map(kept).take(60).collect();
    let parts: Vec<&str> = name.split('-').filter(|part| !part.is_empty()).collect();
    if parts.is_empty() { "robot".into() } else { parts.join("-") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_names_of_files() {
        let names =
            [Some("Paper robot, tangent stiffness"), Some("../..\\etc"), Some("  "), None, Some("Seilroboter Größe 1")];
        let files = ["paper-robot-tangent-stiffness", "etc", "robot", "robot", "seilroboter-größe-1"];
        assert_eq!(names.map(file_name), files);
    }
}
