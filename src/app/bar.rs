//! The bar at the top: the robot with its name, what is done with it, and what is open.

use eframe::egui::{
    Align, Atom, Button, Color32, KeyboardShortcut, Layout, Popup, PopupCloseBehavior, Rect, Response, RichText, Role,
    Sense, Ui, UiBuilder, Vec2, WidgetInfo, WidgetText,
};

use crate::app::arrangement::Form;
use crate::app::command::Command;
use crate::app::designs::Action;
use crate::app::export::Content;
use crate::app::facts::Facts;
use crate::app::icons::{self, Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::name;
use crate::app::panels::answer;
use crate::app::picture::Format;
use crate::app::shortcuts::{OPEN, REDO, SAVE};
use crate::app::state::{Camera, Document, Plot, Session, UiState};
use crate::app::theme;
use crate::app::words::Word;
use crate::scenario::presets;

/// What can be done, as far as it depends on more than the interface's state.
#[derive(Clone, Copy, Debug)]
pub struct Possible {
    /// There is a step to undo.
    pub undo: bool,
    /// There is a step to redo.
    pub redo: bool,
    /// A value differs from what it was when the scenario was opened.
    pub reset: bool,
}

/// Draws the bar in `rect`. Gives where the answer is in it, if it is there.
pub fn ui(
    state: &mut UiState,
    session: &mut Session,
    ui: &mut Ui,
    (rect, form): (Rect, Form),
    possible: Possible,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) -> Option<Rect> {
    let tokens = theme::tokens(ui.visuals());
    ui.painter().rect_filled(rect, 0.0, tokens.panel);
    ui.painter().hline(rect.x_range(), rect.max.y - 0.5, (1.0, tokens.line));
    let inner = rect.shrink2(Vec2::new(8.0, 0.0));
    let touch = form.is_touch();
    let height = if touch { 44.0 } else { 28.0 };
    // Where there is room for them, these are buttons of their own, and have words beside their pictures.
    let words = rect.width() >= 760.0;
    let named = rect.width() >= 880.0;
    // What is at the right comes first: the name takes the room that is left.
    let right = UiBuilder::new().max_rect(inner).layout(Layout::right_to_left(Align::Center));
    let left = ui.scope_builder(right.id_salt("right"), |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let wide = matches!(form, Form::Wide | Form::Middle);
        if wide {
            folding(&mut state.panels, form, ui);
            ui.separator();
        }
        if form != Form::Frame {
            more(state, session, ui, height, (form, !words, possible), facts.document, commands);
        }
        let text = |text| if named { text } else { "" };
        if wide {
            let button = IconButton::new(Icon::Present, "Present").text(text("Present")).height(height);
            if button.show(ui).explained("Robot, answer and one plot, large (F)").clicked() {
                session.present = true;
            }
        }
        if words {
            let button = IconButton::new(Icon::Share, "Share").text(text("Share")).height(height).show(ui);
            share(&button.explained("A link to this robot as you see it"), commands);
            designs(&mut session.windows.designs, ui, height, text("Keep"), commands);
        }
        let button = IconButton::new(Icon::Map, "Map").text(text("Map")).height(height).selected(state.map.on);
        let meaning = "Colours the workspace under the robot, point by point. A click on it moves the platform. (M)";
        if button.show(ui).explained(meaning).clicked() {
            state.map.on = !state.map.on;
        }
        if form != Form::Frame {
            if !wide && words {
                step(ui, Icon::Redo, "Redo", height, possible.redo, Command::Redo, commands);
            }
            if !wide {
                step(ui, Icon::Undo, "Undo", height, possible.undo, Command::Undo, commands);
            }
        }
        ui.min_rect().min.x
    });
    let rest = Rect::from_min_max(inner.min, eframe::egui::Pos2::new(left.inner - 8.0, inner.max.y));
    let rest = UiBuilder::new().max_rect(rest).layout(Layout::left_to_right(Align::Center));
    ui.scope_builder(rest.id_salt("left"), |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        if matches!(form, Form::Wide | Form::Middle) {
            let open = if form == Form::Wide { &mut state.panels.left } else { &mut state.panels.left_where_narrow };
            fold(open, ui, Icon::PanelLeft, "Controls");
        }
        if form != Form::Frame {
            let most = if form == Form::Low { 150.0 } else { 260.0 };
            let new_robot = &mut session.windows.new_robot;
            robot(new_robot, ui, height, (most, possible.reset), facts.document, commands);
        }
        if matches!(form, Form::Wide | Form::Middle) {
            ui.separator();
            step(ui, Icon::Undo, "Undo", height, possible.undo, Command::Undo, commands);
            step(ui, Icon::Redo, "Redo", height, possible.redo, Command::Redo, commands);
        }
        matches!(form, Form::Low | Form::Frame).then(|| {
            let begin = ui.cursor().min.x;
            answer::line(ui, facts);
            Rect::from_x_y_ranges(begin..=ui.min_rect().max.x, rect.y_range())
        })
    })
    .inner
}

/// A switch that opens a panel and folds it.
fn fold(open: &mut bool, ui: &mut Ui, icon: Icon, name: &str) {
    let meaning = if *open { "Folds this panel" } else { "Opens this panel" };
    if IconButton::new(icon, name).selected(*open).show(ui).explained(meaning).clicked() {
        *open = !*open;
    }
}

fn folding(panels: &mut crate::app::state::Panels, form: Form, ui: &mut Ui) {
    if form == Form::Wide {
        fold(&mut panels.right, ui, Icon::PanelRight, "Plots");
    }
    fold(&mut panels.dock, ui, Icon::PanelBottom, "Dock");
}

fn step(ui: &mut Ui, icon: Icon, name: &str, height: f32, can: bool, command: Command, commands: &mut Vec<Command>) {
    let button = ui.add_enabled_ui(can, |ui| IconButton::new(icon, name).height(height).show(ui)).inner;
    if button.explained(name).clicked() {
        commands.push(command);
    }
}

/// What keeps the present design, and what opens the window of all that are kept.
fn designs(open: &mut bool, ui: &mut Ui, height: f32, text: &str, commands: &mut Vec<Command>) {
    // From the right to the left.
    let button = IconButton::new(Icon::ChevronDown, "Designs").height(height).selected(*open).show(ui);
    if button.explained("The designs that are kept, and what differs between them").clicked() {
        *open = !*open;
    }
    let meaning = "Keeps this design as A to D: answers and plots then show the difference to it";
    let button = IconButton::new(Icon::Pin, "Keep").text(text).height(height).show(ui);
    if button.explained(meaning).clicked() {
        commands.push(Command::Design(Action::Keep));
    }
}

/// A menu under a button, as wide as this at least.
fn menu(button: &Response, width: f32, content: impl FnOnce(&mut Ui)) {
    Popup::menu(button).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_min_width(width);
        content(ui);
    });
}

/// An entry with the keys that do the same. A click on it closes the menu.
fn entry(ui: &mut Ui, name: &str, keys: Option<KeyboardShortcut>, enabled: bool) -> bool {
    let button = match keys {
        Some(keys) => Button::new(name).shortcut_text(ui.ctx().format_shortcut(&keys)),
        // On the left as well.
        None => Button::new((name, Atom::grow())),
    };
    let button = button.fill(Color32::TRANSPARENT).min_size(Vec2::new(ui.available_width(), 0.0));
    let clicked = ui.add_enabled(enabled, button).clicked();
    if clicked {
        ui.close();
    }
    clicked
}

fn share(button: &Response, commands: &mut Vec<Command>) {
    menu(button, 200.0, |ui| {
        if entry(ui, "Copy link", None, true) {
            commands.push(Command::Share);
        }
        if entry(ui, "Copy embed code", None, true) {
            commands.push(Command::Embed);
        }
    });
}

/// The robot's name; a click opens what can be done with the robot as a whole.
fn robot(
    new_robot: &mut bool,
    ui: &mut Ui,
    height: f32,
    (most, can_reset): (f32, bool),
    document: &Document,
    commands: &mut Vec<Command>,
) {
    let name = name::shown(document.scenario.name.as_deref());
    let tokens = theme::tokens(ui.visuals());
    let room = (ui.available_width() - 28.0).clamp(40.0, most);
    let text = RichText::new(name).size(theme::TITLE);
    let font = eframe::egui::FontId::proportional(theme::TITLE);
    let wrap = Some(eframe::egui::TextWrapMode::Truncate);
    let galley = WidgetText::from(text).into_galley(ui, wrap, room, font);
    let (rect, response) = ui.allocate_exact_size(Vec2::new(galley.size().x + 30.0, height), Sense::click());
    response.widget_info(|| WidgetInfo {
        label: Some("Robot".into()),
        current_text_value: Some(name.into()),
        ..WidgetInfo::new(Role::ComboBox)
    });
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, tokens.field);
    }
    let at = Rect::from_min_size(rect.left_center() + Vec2::new(6.0, -0.5 * galley.size().y), galley.size());
    ui.painter().galley(at.min, galley, tokens.text);
    icons::paint(ui.painter(), Icon::ChevronDown, rect.right_center() - Vec2::new(11.0, 0.0), tokens.weak);
    let response = response.explained("Another robot, another name, files");
    menu(&response, 270.0, |ui| {
        rename(ui, document, commands);
        ui.separator();
        ui.label(RichText::new("Start from").small().weak());
        for preset in presets::PRESETS {
            let chosen = document.scenario.name.as_deref() == Some(preset.title);
            if ui.selectable_label(chosen, preset.title).explained(preset.description).clicked() {
                commands.push(Command::Load(Box::new(preset.scenario())));
                ui.close();
            }
        }
        if entry(ui, "New robot …", None, true) {
            *new_robot = true;
        }
        ui.separator();
        if entry(ui, "Open …", Some(OPEN), true) {
            commands.push(Command::Open);
        }
        if entry(ui, "Save scenario", Some(SAVE), true) {
            commands.push(Command::Save(Content::Scenario));
        }
        if entry(ui, "Reset all values", None, can_reset) {
            commands.push(Command::Reset);
        }
    });
}

/// The field with the robot's name.
fn rename(ui: &mut Ui, document: &Document, commands: &mut Vec<Command>) {
    if let Some(name) = name::field(ui, "Robot's name", document.scenario.name.as_deref(), 254.0) {
        let name = Some(name).filter(|name| !name.is_empty());
        commands.push(Command::Edit(Box::new(crate::scenario::Scenario { name, ..document.scenario.clone() })));
    }
}

/// All that has no button of its own.
fn more(
    state: &mut UiState,
    session: &mut Session,
    ui: &mut Ui,
    height: f32,
    (form, small, possible): (Form, bool, Possible),
    document: &Document,
    commands: &mut Vec<Command>,
) {
    let button = IconButton::new(Icon::More, "More").height(height).show(ui).explained("Files, settings, help");
    menu(&button, 230.0, |ui| {
        // As high as its entries, where the window is: egui would cut it off at 400 points.
        let height = ui.ctx().content_rect().height() - 90.0;
        let scroll = eframe::egui::ScrollArea::vertical().max_height(height).min_scrolled_height(height);
        scroll.show(ui, |ui| {
            if small {
                if entry(ui, "Copy link", None, true) {
                    commands.push(Command::Share);
                }
                if entry(ui, "Copy embed code", None, true) {
                    commands.push(Command::Embed);
                }
                if entry(ui, "Keep this design", None, true) {
                    commands.push(Command::Design(Action::Keep));
                }
                if entry(ui, "Designs", None, true) {
                    session.windows.designs = true;
                }
                if entry(ui, "Redo", Some(REDO), possible.redo) {
                    commands.push(Command::Redo);
                }
                ui.separator();
            }
            let contents = [
                ("Save analysis as JSON", Content::Analysis),
                ("Save modes as CSV", Content::Plot(Plot::Modes)),
                ("Save the map as CSV", Content::Map),
                ("Robot as PNG", Content::CanvasPicture(Format::Png)),
                ("Robot as SVG", Content::CanvasPicture(Format::Svg)),
            ];
            for (name, content) in contents {
                if entry(ui, name, None, true) {
                    commands.push(Command::Save(content));
                }
            }
            if entry(ui, "Copy the table of modes", None, true) {
                commands.push(Command::CopyModes);
            }
            ui.separator();
            if entry(ui, "Show the whole robot", None, true) {
                session.camera = Camera::default();
            }
            if !matches!(form, Form::Wide | Form::Middle) && entry(ui, "Present", None, true) {
                session.present = true;
            }
            if document.scenario.motion.speed > 0.0 && entry(ui, "Turn the motion round", None, true) {
                commands.push(turned(document));
            }
            if entry(ui, "Settings", None, true) {
                session.windows.settings = true;
            }
            ui.separator();
            if entry(ui, "Tour", None, true) {
                state.map.on = false;
                session.tour = Some(crate::app::tour::Tour::default());
            }
            if entry(ui, "Words", None, true) {
                session.word = Some(Word::CriticalSpeed);
            }
            let windows = &mut session.windows;
            for (name, open) in [
                ("Keyboard shortcuts", &mut windows.shortcuts),
                ("Theory", &mut windows.theory),
                ("Validation", &mut windows.validation),
            ] {
                if entry(ui, name, None, true) {
                    *open = true;
                }
            }
            // On the desktop there is no page, and its controls have names for screen readers.
            if cfg!(target_arch = "wasm32") && entry(ui, "Text version", None, true) {
                commands.push(Command::OpenText);
            }
        });
    });
}

/// The motion in the opposite direction.
pub fn turned(document: &Document) -> Command {
    let mut scenario = document.scenario.clone();
    // No minus before zero.
    scenario.motion.direction = scenario.motion.direction.map(|component| 0.0 - component);
    Command::Edit(Box::new(scenario))
}
