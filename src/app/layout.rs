//! Draws the parts of the screen, each where the arrangement has it.

use eframe::egui::{Align, CursorIcon, Frame, Layout, Panel, Pos2, Rect, Role, Sense, Ui, UiBuilder, Vec2, WidgetInfo};

use super::arrangement::{self, Arrangement, Form};
use super::bar::{self, Possible};
use super::command::Command;
use super::facts::Facts;
use super::icons::{Icon, IconButton};
use super::panels::answer;
use super::panels::controls::{self, Groups};
use super::panels::plots::{self, Slot};
use super::state::{Plot, SheetTab, UiState};
use super::{Tautline, canvas, gestures, regions, theme, transport, words};
use crate::app::meaning::Explain as _;

/// More lines at the foot of the window would cover the rest of it.
const MOST_NOTICES: usize = 3;
/// The legend of the canvas with the button below it is as high as this, in points.
const LEGEND: f32 = 84.0;
/// Room between a panel's edge and what is in it, in points.
const MARGIN: f32 = 12.0;

impl Tautline {
    pub(super) fn notice_bar(&mut self, ui: &mut Ui) {
        let lines = self.notices.lines();
        if lines.is_empty() {
            return;
        }
        Panel::bottom("notice").show(ui, |ui| {
            let older = lines.len().saturating_sub(MOST_NOTICES);
            if older > 0 {
                ui.weak(format!("{older} older ones come up when these are dismissed."));
            }
            for (index, line) in lines.iter().enumerate().skip(older) {
                ui.horizontal_wrapped(|ui| {
                    if line.fault.is_some() {
                        ui.colored_label(theme::warning(ui.visuals()), "▲");
                    }
                    ui.label(&line.text);
                    if ui.small_button("Dismiss").clicked() {
                        self.commands.push(Command::DismissNotice(index));
                    }
                });
            }
        });
    }

    /// Draws everything in the window.
    pub(super) fn screen(&mut self, ui: &mut Ui) {
        let window = ui.available_rect_before_wrap();
        let Self { state, session, .. } = self;
        let arrangement =
            arrangement::arrange(window, state.panels, session.embedded, session.present, self.screen.coarse);
        self.screen.plots.clear();
        self.edges(ui, &arrangement, window);
        if let Some(rect) = arrangement.bar {
            self.bar(ui, rect, arrangement.form);
        }
        if let Some(rect) = arrangement.column {
            self.column(ui, rect);
        }
        if let Some(rect) = arrangement.controls {
            self.controls(ui, rect, arrangement.form);
        }
        if let Some(rect) = arrangement.line {
            self.line(ui, rect);
        }
        if let Some(rect) = arrangement.sheet {
            self.sheet(ui, rect, arrangement.form);
        }
        match self.session.large {
            Some(plot) if arrangement.form != Form::Present => {
                self.screen.regions.plot = self.plot(ui, arrangement.centre(), Slot::Large, plot);
            }
            _ => self.centre(ui, &arrangement),
        }
        if let Some(rect) = arrangement.plots {
            let slot = if arrangement.form == Form::Portrait { Slot::Under } else { Slot::Right };
            let plot = if slot == Slot::Under { self.state.dock } else { self.state.plot };
            self.screen.regions.plot = self.plot(ui, rect, slot, plot);
            regions::mark(ui, arrangement.second.map_or(rect, |second| rect.union(second)), "Plots");
        }
        if let Some(rect) = arrangement.second {
            self.plot(ui, rect, Slot::Second, self.state.second);
        }
    }

    /// The robot with what is under it.
    fn centre(&mut self, ui: &mut Ui, arrangement: &Arrangement) {
        self.canvas(ui, arrangement);
        if let Some(rect) = arrangement.strip {
            let plot = UiState::presented(self.present.document.scenario.path.is_some());
            self.show(plot);
            let facts = self.present.facts(self.state.settings, self.session.mode);
            ui.painter().rect_filled(rect, 0.0, theme::tokens(ui.visuals()).canvas);
            if let Some(view) = self.screen.canvas.view {
                plots::strip(&self.state, ui, rect, &view, facts, &mut self.commands);
            }
            regions::mark(ui, rect, "Dock");
        }
        if let Some(rect) = arrangement.dock {
            let slot = match arrangement.form {
                Form::Middle => Slot::Under,
                Form::Present => Slot::Present,
                _ => Slot::Dock,
            };
            let path = self.present.document.scenario.path.is_some();
            let plot = match slot {
                Slot::Present => UiState::presented(path),
                Slot::Dock => self.state.dock_plot(path),
                _ => self.state.dock,
            };
            let place = self.plot(ui, rect, slot, plot);
            if arrangement.plots.is_none() {
                self.screen.regions.plot = place;
            }
            regions::mark(ui, rect, "Dock");
        }
        if let Some(rect) = arrangement.transport {
            let facts = self.present.facts(self.state.settings, self.session.mode);
            let Self { state, session, commands, .. } = self;
            if arrangement.form == Form::Frame {
                frame_row(&mut state.playback, session.mode, ui, rect, facts, commands);
            } else {
                transport::ui(&mut state.playback, session, ui, (rect, arrangement.form), facts, commands);
            }
            regions::mark(ui, rect, "Transport");
        }
    }

    fn canvas(&mut self, ui: &mut Ui, arrangement: &Arrangement) {
        let rect = arrangement.canvas;
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let wide = matches!(arrangement.form, Form::Wide | Form::Middle | Form::Portrait);
        let card = if wide { answer::size(facts) + Vec2::new(0.0, 24.0) } else { Vec2::ZERO };
        let compact = !wide && arrangement.form != Form::Present;
        // The legend is beside the card, or where the card would be.
        let corner = if wide {
            Rect::from_min_max(
                Pos2::new(rect.min.x + card.x + 40.0, rect.min.y + MARGIN),
                Pos2::new(rect.max.x - 24.0, rect.min.y + card.y),
            )
        } else {
            Rect::from_min_size(rect.min + Vec2::new(MARGIN, 6.0), Vec2::new(rect.width() - 120.0, 46.0))
        };
        let beside = wide && is_beside(rect.size(), card, canvas::frame(&self.present.document.scenario).size().into());
        let top = match arrangement.form {
            Form::Wide | Form::Middle | Form::Portrait if beside => 0.0,
            Form::Wide | Form::Middle | Form::Portrait => card.y,
            Form::Phone | Form::Low => 46.0,
            Form::Frame | Form::Present => 0.0,
        };
        let left = if beside { card.x + 24.0 } else { 0.0 };
        let corner = if beside {
            // Under the card.
            Rect::from_min_max(rect.min + Vec2::new(15.0, card.y), Pos2::new(rect.min.x + card.x, rect.max.y))
        } else {
            corner
        };
        let under = arrangement.dock.or(arrangement.strip).is_some();
        let space = canvas::Space {
            insets: canvas::Insets { top, left, ..canvas::Insets::default() },
            corner,
            compact,
            legend: !matches!(arrangement.form, Form::Frame | Form::Present) && (compact || corner.height() >= LEGEND),
            pose_line: under
                && (arrangement.strip.is_some()
                    || self.state.dock.is_along_a_way()
                    || arrangement.form == Form::Present),
            picture: false,
        };
        let Self { screen, state, session, commands, .. } = self;
        let inside = UiBuilder::new().max_rect(rect).id_salt("canvas");
        screen.regions.canvas = ui
            .scope_builder(inside, |ui| {
                ui.set_clip_rect(rect.intersect(ui.clip_rect()));
                canvas::ui(&mut screen.canvas, state, session, ui, facts, space, commands)
            })
            .inner;
        regions::mark(ui, rect, "Canvas");
        if wide {
            let corner = rect.min + Vec2::new(15.0, MARGIN);
            screen.regions.answer = answer::card(ui, corner, facts, commands);
            regions::mark(ui, screen.regions.answer, "Answer");
        }
        if matches!(arrangement.form, Form::Phone | Form::Low) {
            let button = Rect::from_min_size(rect.right_top() + Vec2::new(-100.0, 6.0), Vec2::new(92.0, 44.0));
            let inside = UiBuilder::new().max_rect(button).layout(Layout::right_to_left(Align::Center));
            ui.scope_builder(inside, |ui| {
                if facts.document.scenario.path.is_some() {
                    transport::fly(&mut state.playback, ui, 44.0);
                } else {
                    transport::let_go(&mut state.playback, session.mode, ui, 44.0, commands);
                }
            });
        }
    }

    /// Says that a plot is on the screen, so that its study is asked for.
    fn show(&mut self, plot: Plot) {
        if !self.screen.plots.contains(&plot) {
            self.screen.plots.push(plot);
        }
    }

    /// One plot with its tabs in `rect`. Gives where it is.
    fn plot(&mut self, ui: &mut Ui, rect: Rect, slot: Slot, plot: Plot) -> Rect {
        self.show(plot);
        let tokens = theme::tokens(ui.visuals());
        ui.painter().rect_filled(rect, 0.0, if slot == Slot::Present { tokens.canvas } else { tokens.panel });
        if slot != Slot::Present {
            ui.painter().hline(rect.x_range(), rect.min.y + 0.5, (1.0, tokens.line));
            ui.painter().vline(rect.min.x + 0.5, rect.y_range(), (1.0, tokens.line));
        }
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let Self { screen, state, session, commands, .. } = self;
        // Under the robot a study along the line has the robot's x axis.
        let shared = matches!(slot, Slot::Dock | Slot::Present)
            || (slot == Slot::Under && (rect.min.x - screen.regions.canvas.min.x).abs() < 1.0);
        let view = screen.canvas.view.filter(|_| shared);
        let margin = if shared { Vec2::ZERO } else { Vec2::new(MARGIN, 0.0) };
        let mut room = rect.shrink2(margin);
        if matches!(slot, Slot::Right | Slot::Second | Slot::Large) {
            room.min.y += 8.0;
        }
        let inside = UiBuilder::new().max_rect(room).id_salt(("plot", slot));
        let place = ui.scope_builder(inside, |ui| {
            ui.set_clip_rect(rect.intersect(ui.clip_rect()));
            plots::ui(slot, state, session, ui, facts, view.as_ref(), commands)
        });
        place.inner.intersect(rect)
    }

    fn bar(&mut self, ui: &mut Ui, rect: Rect, form: Form) {
        let possible = Possible {
            undo: self.history.can_undo(&self.present.document),
            redo: self.history.can_redo(&self.present.document),
            reset: self.present.document.scenario != self.present.document.original,
        };
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let Self { screen, state, session, commands, .. } = self;
        if let Some(answer) = bar::ui(state, session, ui, (rect, form), possible, facts, commands) {
            screen.regions.answer = answer;
            regions::mark(ui, answer, "Answer");
        }
        regions::mark(ui, rect, "Bar");
    }

    fn controls(&mut self, ui: &mut Ui, rect: Rect, form: Form) {
        let tokens = theme::tokens(ui.visuals());
        ui.painter().rect_filled(rect, 0.0, tokens.panel);
        ui.painter().vline(rect.max.x - 0.5, rect.y_range(), (1.0, tokens.line));
        self.screen.regions.controls = rect;
        if form == Form::Portrait {
            let all = [SheetTab::Move, SheetTab::Robot, SheetTab::Explain];
            self.tabs(ui, rect, form, &all);
        } else {
            self.within(ui, rect, "All", |app, ui| app.groups(ui, Groups::All, app.screen.coarse));
        }
        regions::mark(ui, rect, "Controls");
    }

    /// What is in a panel, which scrolls where it is small.
    fn within(&mut self, ui: &mut Ui, rect: Rect, name: &str, content: impl FnOnce(&mut Self, &mut Ui)) {
        // Each keeps its own place when it is scrolled.
        ui.scope_builder(UiBuilder::new().max_rect(rect).id_salt(name), |ui| {
            ui.set_clip_rect(rect.intersect(ui.clip_rect()));
            gestures::scroll(ui, |ui| {
                // The margin belongs to what scrolls: fingers swipe there, and it has room for the scroll bar.
                Frame::new().inner_margin(Vec2::new(MARGIN, 0.0)).show(ui, |ui| {
                    // A scroll bar that comes and goes changes no widths; one point less, or there would be one for it.
                    ui.set_width(rect.width() - 2.0 * MARGIN - 1.0);
                    content(self, ui);
                });
            });
        });
    }

    fn groups(&mut self, ui: &mut Ui, groups: Groups, touch: bool) {
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let Self { state, session, commands, .. } = self;
        controls::ui(&mut state.sections, session, ui, (groups, touch), facts, commands);
    }

    /// The answer in a line that stays.
    fn line(&mut self, ui: &mut Ui, rect: Rect) {
        let tokens = theme::tokens(ui.visuals());
        ui.painter().rect_filled(rect, 0.0, tokens.panel);
        ui.painter().hline(rect.x_range(), rect.min.y + 0.5, (1.0, tokens.line));
        ui.painter().hline(rect.x_range(), rect.max.y - 0.5, (1.0, tokens.line));
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let inner = rect.shrink2(Vec2::new(MARGIN, 0.0));
        let inside = UiBuilder::new().max_rect(inner).layout(Layout::right_to_left(Align::Center));
        let state = &mut self.state;
        let commands = &mut self.commands;
        ui.scope_builder(inside, |ui| {
            let icon = if state.sheet == SheetTab::Explain { Icon::ChevronDown } else { Icon::ChevronUp };
            let button = IconButton::new(icon, "What this means").height(44.0).show(ui);
            if button.clicked() {
                state.sheet = if state.sheet == SheetTab::Explain { SheetTab::Move } else { SheetTab::Explain };
            }
            if facts.answers.pose_failed()
                && facts.answers.last_feasible().is_some()
                && IconButton::new(Icon::ArrowLeft, "Back to the last feasible pose")
                    .height(44.0)
                    .primary()
                    .show(ui)
                    .clicked()
            {
                commands.push(Command::BackToFeasible);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| answer::line(ui, facts));
        });
        self.screen.regions.answer = rect;
        regions::mark(ui, rect, "Answer");
    }

    /// The sheet of a phone: four tabs and what is under them.
    fn sheet(&mut self, ui: &mut Ui, rect: Rect, form: Form) {
        let tokens = theme::tokens(ui.visuals());
        ui.painter().rect_filled(rect, 0.0, tokens.panel);
        ui.painter().vline(rect.min.x + 0.5, rect.y_range(), (1.0, tokens.line));
        self.screen.regions.controls = rect;
        self.tabs(ui, rect, form, &SheetTab::ALL.map(|(sheet, _)| sheet));
        regions::mark(ui, rect, "Sheet");
    }

    fn tabs(&mut self, ui: &mut Ui, rect: Rect, form: Form, all: &[SheetTab]) {
        let tokens = theme::tokens(ui.visuals());
        let height = if form == Form::Low { 44.0 } else { 48.0 };
        let (head, body) = rect.split_top_bottom_at_y(rect.min.y + height);
        let width = head.width() / all.len() as f32;
        let chosen = if all.contains(&self.state.sheet) { self.state.sheet } else { SheetTab::Move };
        ui.painter().hline(head.x_range(), head.max.y - 0.5, (1.0, tokens.line));
        for (i, sheet) in all.iter().enumerate() {
            let name = SheetTab::ALL.iter().find(|(other, _)| other == sheet).map_or("", |(_, name)| name);
            let place = Rect::from_min_size(head.min + Vec2::new(i as f32 * width, 0.0), Vec2::new(width, height));
            let response = ui.interact(place, ui.scope_id().with(("sheet", name)), Sense::click());
            let on = chosen == *sheet;
            response.widget_info(|| WidgetInfo::selected(Role::Tab, true, on, name));
            let font = eframe::egui::TextStyle::Body.resolve(ui.style());
            let colour = if on { tokens.text } else { tokens.weak };
            ui.painter().text(place.center(), eframe::egui::Align2::CENTER_CENTER, name, font, colour);
            if on {
                ui.painter().hline(place.x_range(), place.max.y - 1.0, (2.0, tokens.accent));
            }
            if response.has_focus() {
                let stroke = eframe::egui::Stroke::new(2.0, tokens.accent);
                ui.painter().rect_stroke(place.shrink(2.0), 4.0, stroke, eframe::egui::StrokeKind::Inside);
            }
            if response.clicked() {
                self.state.sheet = *sheet;
            }
        }
        match chosen {
            SheetTab::Plots => self.screen.regions.plot = self.plot(ui, body, Slot::Sheet, self.state.plot),
            SheetTab::Move => self.within(ui, body, "Move", |app, ui| {
                ui.add_space(6.0);
                app.groups(ui, Groups::Motion, true);
                ui.add_space(6.0);
                app.motion_buttons(ui);
            }),
            SheetTab::Robot => self.within(ui, body, "Robot", |app, ui| app.groups(ui, Groups::Robot, true)),
            SheetTab::Explain => self.within(ui, body, "Explain", |app, ui| {
                ui.add_space(8.0);
                let facts = app.present.facts(app.state.settings, app.session.mode);
                words::explain(&mut app.session, ui, facts, &mut app.commands);
            }),
        }
    }

    /// What a finger wants of the motion: back to the beginning, and round.
    fn motion_buttons(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let document = &self.present.document;
            let home = document.original.motion.position;
            let now = document.scenario.motion.position;
            let is_there = now.iter().zip(home).all(|(now, home)| now.total_cmp(&home).is_eq());
            let button = IconButton::new(Icon::Home, "Home pose").text("Home pose").height(44.0).framed();
            let button = ui.add_enabled_ui(!is_there, |ui| button.show(ui)).inner;
            if button.explained("Where the platform was when the robot was opened").clicked() {
                let mut scenario = document.scenario.clone();
                scenario.motion.position = home;
                self.commands.push(Command::Edit(Box::new(scenario)));
            }
            let button = IconButton::new(Icon::Turn, "Turn round").text("Turn round").height(44.0).framed().show(ui);
            if button.explained("Moves in the opposite direction").clicked() {
                self.commands.push(bar::turned(document));
            }
        });
    }

    /// The left column of a presentation.
    fn column(&mut self, ui: &mut Ui, rect: Rect) {
        let tokens = theme::tokens(ui.visuals());
        ui.painter().rect_filled(rect, 0.0, tokens.canvas);
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let inner = rect.shrink2(Vec2::new(20.0, 16.0));
        let (upper, lower) = inner.split_top_bottom_at_y(inner.max.y - 104.0);
        let Self { state, session, commands, .. } = self;
        ui.scope_builder(UiBuilder::new().max_rect(upper), |ui| {
            ui.set_clip_rect(upper.intersect(ui.clip_rect()));
            answer::column(ui, facts, commands);
        });
        self.screen.regions.answer = upper;
        ui.scope_builder(UiBuilder::new().max_rect(lower), |ui| {
            controls::speed(ui, facts, commands);
            ui.horizontal(|ui| {
                if facts.document.scenario.path.is_some() {
                    transport::fly(&mut state.playback, ui, 32.0);
                } else {
                    transport::let_go(&mut state.playback, session.mode, ui, 32.0, commands);
                }
                let button = IconButton::new(Icon::Map, "Map").text("Map").height(32.0).selected(state.map.on).framed();
                if button.show(ui).clicked() {
                    state.map.on = !state.map.on;
                }
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let button = IconButton::new(Icon::Close, "End the presentation").height(32.0).show(ui);
                    if button.explained("Esc does the same").clicked() {
                        session.present = false;
                    }
                });
            });
        });
        self.screen.regions.controls = lower;
        regions::mark(ui, rect, "Answer");
    }

    /// The edges of panels, to be dragged.
    fn edges(&mut self, ui: &mut Ui, arrangement: &Arrangement, window: Rect) {
        for (edge, name, rect) in arrangement.edges() {
            let upright = rect.height() > rect.width();
            let cursor = if upright { CursorIcon::ResizeHorizontal } else { CursorIcon::ResizeVertical };
            let layer = eframe::egui::LayerId::new(eframe::egui::Order::Middle, ui.scope_id().with(name));
            // Above the panels, which are drawn after it.
            let response = ui
                .scope_builder(UiBuilder::new().layer_id(layer).max_rect(rect), |ui| {
                    ui.interact(rect, ui.scope_id().with(name), Sense::drag())
                })
                .inner;
            response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, name));
            let response = response.on_hover_and_drag_cursor(cursor);
            if response.dragged()
                && let Some(to) = response.interact_pointer_pos()
            {
                arrangement.resize(&mut self.state.panels, edge, to, window);
            }
        }
    }

    /// What panels read.
    pub(super) fn facts(&self) -> Facts<'_> {
        self.present.facts(self.state.settings, self.session.mode)
    }
}

/// Whether the robot is shown larger beside the card than below it. `frame` is the size of its workspace in m.
fn is_beside(canvas: Vec2, card: Vec2, frame: [f64; 2]) -> bool {
    const NUMBERS: Vec2 = Vec2::new(68.0, 48.0);
    #[expect(clippy::cast_possible_truncation)] // Two sizes are compared.
    let [width, height] = frame.map(|side| side as f32);
    let scale = |room: Vec2| (room.x / width).min(room.y / height);
    let below = scale(canvas - NUMBERS - Vec2::new(0.0, card.y));
    // On the other side as much room is left as the winches' numbers need.
    let beside = scale(canvas - NUMBERS - Vec2::new(card.x + 24.0, 0.0));
    beside > 1.15 * below
}

/// The one row of a frame: let go, speed, and the whole program.
fn frame_row(
    playback: &mut super::state::Playback,
    mode: crate::compute::protocol::ModeChoice,
    ui: &mut Ui,
    rect: Rect,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let tokens = theme::tokens(ui.visuals());
    ui.painter().rect_filled(rect, 0.0, tokens.panel);
    ui.painter().hline(rect.x_range(), rect.min.y + 0.5, (1.0, tokens.line));
    let inside = UiBuilder::new().max_rect(rect.shrink2(Vec2::new(MARGIN, 0.0)));
    ui.scope_builder(inside.layout(Layout::left_to_right(Align::Center)), |ui| {
        if facts.document.scenario.path.is_some() {
            transport::fly(playback, ui, 32.0);
        } else {
            transport::let_go(playback, mode, ui, 32.0, commands);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let text = if rect.width() > 500.0 { "Open in Tautline" } else { "" };
            if IconButton::new(Icon::Open, "Open in Tautline").text(text).show(ui).clicked() {
                commands.push(Command::OpenWhole);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| controls::speed_in_a_row(ui, facts, commands));
        });
    });
}
