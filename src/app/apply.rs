//! Commands carried out, between two frames.

use eframe::egui::Context;

use super::export::{self, Content};
use super::files::{self, Clip};
use super::notices::About;
use super::pinned::Pinned;
use super::state::{Document, Page, Plot};
use super::studies::Owner;
use super::{Command, Tautline, fields, number};
use crate::compute::protocol::Request;
use crate::scenario::report::sentence;
use crate::scenario::{Scenario, link};

impl Tautline {
    pub(super) fn apply(&mut self, context: &Context, command: Command) {
        match command {
            Command::Edit(scenario) => {
                let original = self.present.document.original.clone();
                self.edit(Document { scenario: *scenario, original });
            }
            Command::Load(scenario) => self.open(*scenario),
            Command::Read(text) => match files::scenario(&text) {
                Ok(scenario) => self.open(scenario),
                Err(reason) => self.complain(reason),
            },
            Command::Share => {
                let link = format!("{}{}{}", address(), link::MARK, link::encode(&self.present.document.scenario));
                let use_of_it = if address().is_empty() {
                    ", to be pasted here or put behind the address of a page with Tautline"
                } else {
                    ""
                };
                let more = format!("{use_of_it}: {link}");
                self.files.copy(context, Clip { what: "The link", text: link, more });
            }
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
            Command::Reset => self.open(self.present.document.original.clone()),
            Command::Pin(on) => {
                self.unpin();
                let wake = self.context.clone();
                let present = &self.present;
                let design =
                    || Pinned::new(present.document.scenario.clone(), &present.answers, move || wake.request_repaint());
                match on.then(design).transpose() {
                    Ok(pinned) => {
                        self.present.pinned = pinned;
                        self.notices.succeed(About::Action);
                    }
                    Err(reason) => self.complain(reason),
                }
            }
            Command::Open => self.files.open(context),
            Command::Save(content) => self.save_content(context, content),
            Command::CopyModes => match export::plot(Plot::Modes, self.facts()) {
                Some(table) => {
                    self.files.copy(context, Clip { what: "The table of modes", text: table.tsv(), more: ".".into() });
                }
                None => self.complain("There are no modes to copy at this pose.".into()),
            },
            Command::ChooseMode(choice) => {
                self.session.mode = choice;
                self.submit(&Request::Shape(choice));
                self.notices.succeed(About::Action);
            }
            Command::Reveal(parameter) => {
                self.session.revealed = Some(parameter);
                self.state.page = Page::Controls;
            }
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

    /// Lets the pinned design go, with whatever is being computed for it.
    pub(super) fn unpin(&mut self) {
        let orders = self.present.pinned.take().map(Pinned::release);
        self.pool.carry_out(Owner::Pinned, orders.into_iter().flatten());
    }

    pub(super) fn complain(&mut self, text: String) {
        self.notices.complain(About::Action, text);
    }

    /// Starts from a scenario, as a step of its own.
    fn open(&mut self, scenario: Scenario) {
        self.history.step(&self.present.document);
        self.edit(Document::opened(scenario));
        self.history.step(&self.present.document);
    }

    /// Takes a document over, where it is physical; else says why not and keeps the last good one.
    fn edit(&mut self, document: Document) {
        if let Err(reason) = fields::check(&document.scenario, self.state.settings) {
            self.notices.complain(About::Robot, sentence(&reason));
            return;
        }
        self.notices.succeed(About::Robot);
        let changed = document.scenario != self.present.document.scenario;
        self.present.document = document;
        if changed {
            number::forget_message(&self.context);
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
            Content::Map => ("-map.csv", export::map(facts).map(|table| table.csv())),
            Content::PlotPicture if self.screen.plots_open => {
                return self.files.save_picture(context, &(name + "-plot.png"), self.screen.regions.plot);
            }
            Content::CanvasPicture => {
                return self.files.save_picture(context, &(name + "-canvas.png"), self.screen.regions.canvas);
            }
            Content::PlotPicture => ("", None),
        };
        match text {
            Some(text) => self.files.save(context, &(name + suffix), text.into_bytes()),
            None => self.complain("There is nothing to save yet: it is not on show, or still being computed.".into()),
        }
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
