//! What stands around a plot: groups and tabs to choose it by, Fit, enlarge, and what can be done with it.

use eframe::egui::{
    Align, Align2, Color32, ComboBox, Context, FontId, Id, Label, Layout, Popup, PopupCloseBehavior, Rect, Response,
    RichText, Role, Sense, Shape, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo,
};

use super::axis::signed;
use super::common::{self, PlotPlace, Slot};
use super::flight;
use super::range::VisibleRange;
use crate::app::canvas;
use crate::app::command::Command;
use crate::app::export::Content;
use crate::app::facts::Facts;
use crate::app::icons::{Icon, IconButton, focus_ring};
use crate::app::meaning::Explain as _;
use crate::app::picture::Format;
use crate::app::state::{Camera, Plot, PlotGroup};
use crate::app::theme;

/// From this width on, in points, groups and tools stand in one row.
const WIDE: f32 = 430.0;

/// The least room around the name of a group in large letters, in points.
const LEAST_AROUND: f32 = 10.0;

/// What a header may change.
pub struct Header<'a> {
    /// The plot on show.
    pub open: &'a mut Plot,
    /// The plot that has the place of the robot.
    pub large: &'a mut Option<Plot>,
    /// What the robot's horizontal axis follows, which the dock's study along the line shares.
    pub camera: &'a mut Camera,
    /// What the plot explains itself with.
    pub explanation: &'a dyn Fn(Plot) -> String,
}

/// Whether a plot's explanation is open.
pub fn explains(context: &Context, place: PlotPlace) -> bool {
    context.data(|data| data.get_temp(explanation_id(place))).unwrap_or_default()
}

fn explanation_id(place: PlotPlace) -> Id {
    place.id().with("explanation")
}

fn toggle_explanation(context: &Context, place: PlotPlace) {
    let open = !explains(context, place);
    context.data_mut(|data| data.insert_temp(explanation_id(place), open));
}

impl Header<'_> {
    /// Draws what is above a plot.
    pub fn ui(&mut self, slot: Slot, wheel: bool, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
        match slot {
            Slot::Dock => {
                ui.horizontal(|ui| {
                    self.tabs(ui, &under_the_robot(facts));
                    let place = PlotPlace { slot, plot: *self.open, wheel };
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        self.more(place, ui, facts, commands);
                        self.tools(place, ui);
                        ui.add_space(6.0);
                        caption(place, ui, facts, commands);
                    });
                });
            }
            Slot::Sheet | Slot::Under => {
                ui.horizontal_wrapped(|ui| {
                    self.group_list(ui);
                    self.tabs(ui, self.open.group().plots());
                });
            }
            Slot::Right | Slot::Second | Slot::Large if ui.available_width() >= WIDE => {
                ui.horizontal(|ui| {
                    self.groups(ui);
                    let place = PlotPlace { slot, plot: *self.open, wheel };
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        self.more(place, ui, facts, commands);
                        self.tools(place, ui);
                    });
                });
                ui.horizontal(|ui| {
                    self.tabs(ui, self.open.group().plots());
                    let place = PlotPlace { slot, plot: *self.open, wheel };
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| caption(place, ui, facts, commands));
                });
            }
            Slot::Right | Slot::Second | Slot::Large | Slot::Present | Slot::Picture => {
                ui.horizontal(|ui| {
                    let place = PlotPlace { slot, plot: *self.open, wheel };
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        self.more(place, ui, facts, commands);
                        self.groups(ui);
                    });
                });
                ui.horizontal_wrapped(|ui| self.tabs(ui, self.open.group().plots()));
                ui.horizontal(|ui| {
                    let place = PlotPlace { slot, plot: *self.open, wheel };
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        self.tools(place, ui);
                        ui.with_layout(Layout::left_to_right(Align::Center), |ui| caption(place, ui, facts, commands));
                    });
                });
            }
        }
        // The line under the tabs.
        let line = ui.available_rect_before_wrap();
        let colour = theme::tokens(ui.visuals()).line;
        ui.painter().hline(line.x_range(), line.top() - 0.5 * ui.spacing().item_spacing.y, Stroke::new(1.0, colour));
    }

    /// Draws what is below a plot: what it means, and on a phone the tools.
    pub fn foot(&mut self, place: PlotPlace, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            explainer(place, ui);
            if place.slot.is_sheet() {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    self.more(place, ui, facts, commands);
                    self.tools(place, ui);
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| caption(place, ui, facts, commands));
                });
            }
        });
    }

    /// The groups beside each other, as one switch.
    fn groups(&mut self, ui: &mut Ui) {
        let tokens = theme::tokens(ui.visuals());
        let height = ui.spacing().interact_size.y.max(28.0);
        let width = ui.available_width().min(290.0);
        let (rect, ground) = ui.allocate_exact_size(Vec2::new(width, height), Sense::hover());
        ui.painter().rect_filled(rect, 6.0, tokens.field);
        // As wide as their words, with the same room around each; in small letters where there is little.
        let lengths = |font: &FontId| {
            PlotGroup::ALL.map(|(_, name, _)| {
                ui.painter().layout_no_wrap(name.to_owned(), font.clone(), Color32::PLACEHOLDER).size().x
            })
        };
        #[expect(clippy::cast_precision_loss)] // Four.
        let around = |lengths: &[f32]| (rect.width() - lengths.iter().sum::<f32>()) / lengths.len() as f32;
        let [large, small] = [TextStyle::Button, TextStyle::Small].map(|style| style.resolve(ui.style()));
        let font = if around(&lengths(&large)) < LEAST_AROUND { small } else { large };
        let lengths = lengths(&font);
        let around = around(&lengths);
        let mut right = rect.left();
        for ((group, name, plots), length) in PlotGroup::ALL.into_iter().zip(lengths) {
            let left = right;
            right += length + around;
            let part = Rect::from_x_y_ranges(left..=right, rect.y_range());
            let chosen = self.open.group() == group;
            let response = ui.interact(part, ground.id.with(name), Sense::click());
            response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, chosen, name));
            if chosen {
                ui.painter().rect_filled(part.shrink(2.0), 5.0, tokens.card);
                let stroke = Stroke::new(1.0, tokens.line);
                ui.painter().rect_stroke(part.shrink(2.0), 5.0, stroke, StrokeKind::Inside);
            }
            focus_ring(ui, &response, part.shrink(1.0));
            let colour = if chosen || response.hovered() { tokens.text } else { tokens.weak };
            ui.painter().text(part.center(), Align2::CENTER_CENTER, name, font.clone(), colour);
            if response.clicked() && !chosen {
                self.choose(plots.first().copied());
            }
        }
    }

    /// The groups as a list, where there is no room for all.
    fn group_list(&mut self, ui: &mut Ui) {
        let now = PlotGroup::ALL.into_iter().find(|(group, ..)| *group == self.open.group());
        let name = now.map_or("", |(_, name, _)| name);
        let list = ComboBox::from_id_salt("plot group").selected_text(name).width(70.0).show_ui(ui, |ui| {
            for (group, name, plots) in PlotGroup::ALL {
                let chosen = group == self.open.group();
                if ui.selectable_label(chosen, name).clicked() && !chosen {
                    self.choose(plots.first().copied());
                }
            }
        });
        canvas::named(&list.response, "Plot group", name);
    }

    fn choose(&mut self, plot: Option<Plot>) {
        *self.open = plot.unwrap_or(*self.open);
    }

    /// Plots as words with a line under the one on show.
    fn tabs(&mut self, ui: &mut Ui, plots: &[Plot]) {
        // Smaller words, closer together, rather than a second row.
        let [large, small] = [TextStyle::Button, TextStyle::Small].map(|style| style.resolve(ui.style()));
        let width = |plot: &Plot| {
            ui.painter().layout_no_wrap(plot.title().to_owned(), large.clone(), Color32::PLACEHOLDER).size().x
        };
        let (between, closer) = (14.0, 8.0);
        let widths: f32 = plots.iter().map(|plot| width(plot) + 2.0 + between).sum();
        let fits = widths - between <= ui.available_width();
        let (font, between) = if fits { (large, between) } else { (small, closer) };
        ui.spacing_mut().item_spacing.x = between;
        for &plot in plots {
            if tab(ui, plot.title(), &font, *self.open == plot).clicked() {
                *self.open = plot;
            }
        }
    }

    /// What else can be done with the plot.
    fn more(&self, place: PlotPlace, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
        let more = tool(ui, Icon::More, "", &format!("More for {}", place.plot.title())).show(ui);
        Popup::menu(&more).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
            self.menu(place, ui, facts, commands);
        });
    }

    /// Fit, all and enlarge, from right to left.
    fn tools(&mut self, place: PlotPlace, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.x = 2.0;
        let title = place.plot.title();
        if place.slot == Slot::Large {
            if tool(ui, Icon::Shrink, "", "Back to size").selected(true).show(ui).explained("Back to size").clicked() {
                *self.large = None;
            }
        } else if tool(ui, Icon::Enlarge, "", &format!("Enlarge {title}")).show(ui).explained("Enlarge").clicked() {
            *self.large = Some(place.plot);
        }
        if !can_be_turned(place.plot) {
            return;
        }
        let range = VisibleRange::of(ui.ctx(), place.id());
        if place.plot == Plot::Eigenvalues {
            let name = "All eigenvalues";
            if tool(ui, Icon::None, "All", name)
                .selected(range == VisibleRange::All)
                .show(ui)
                .explained("Shows all of them")
                .clicked()
            {
                VisibleRange::All.show(ui.ctx(), place.id());
            }
        }
        // In the dock the line is as wide as the robot.
        let shared = place.slot.is_under_the_robot() && place.plot.is_along_a_way();
        let fits = if shared { *self.camera == Camera::default() } else { range == VisibleRange::Fit };
        let fit = tool(ui, Icon::Fit, "Fit", &format!("Fit {title}")).selected(fits).show(ui);
        if fit.explained("Shows what matters").clicked() {
            if shared {
                *self.camera = Camera::default();
            }
            VisibleRange::Fit.show(ui.ctx(), place.id());
        }
    }

    fn menu(&self, place: PlotPlace, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
        let mut save = |ui: &mut Ui, name: &str, content: Content| {
            if ui.button(name).clicked() {
                commands.push(Command::Save(content));
                ui.close();
            }
        };
        save(ui, "Save as CSV", Content::Plot(place.plot));
        save(ui, "Picture (PNG)", Content::PlotPicture(place.plot, place.id(), Format::Png));
        save(ui, "Picture (SVG)", Content::PlotPicture(place.plot, place.id(), Format::Svg));
        if place.plot == Plot::Modes && facts.answers.pose().is_some() && ui.button("Copy the table").clicked() {
            commands.push(Command::CopyModes);
            ui.close();
        }
        if place.plot == Plot::Path && ui.button("Fastest allowed…").clicked() {
            commands.push(Command::ShowFastest);
            ui.close();
        }
        if ui.button("What am I seeing?").clicked() {
            toggle_explanation(ui.ctx(), place);
            if place.slot != Slot::Dock {
                ui.close();
            }
        }
        // The dock has no room for it.
        if place.slot == Slot::Dock && explains(ui.ctx(), place) {
            ui.set_max_width(320.0);
            ui.add(Label::new((self.explanation)(place.plot)).wrap());
        }
    }
}

/// The plots that can be under the robot: that of the path only where there is one.
fn under_the_robot(facts: Facts<'_>) -> Vec<Plot> {
    let path = facts.document.scenario.path.is_some();
    Plot::UNDER_THE_ROBOT.into_iter().filter(|plot| path || *plot != Plot::Path).collect()
}

/// Whether a plot has a part that can be out of sight.
fn can_be_turned(plot: Plot) -> bool {
    !matches!(plot, Plot::Modes | Plot::Sensitivities)
}

/// What is to be said first of a plot: how far its study has come, from when it is, or what a click does.
fn caption(place: PlotPlace, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Facts { answers, studies, document, .. } = facts;
    if common::progress(ui, place.plot, studies, commands) {
        return;
    }
    let kept = common::kept_from(answers).map(|from| format!("Grey: from {from}"));
    // A phone has room for what has to be said, not for hints.
    if place.slot.is_sheet() && (kept.is_none() || place.plot == Plot::Line) {
        return;
    }
    let text = match place.plot {
        Plot::Line => line_of(document.scenario.motion.position, document.scenario.motion.direction),
        Plot::Mesh => kept.unwrap_or_default(),
        Plot::Directions => kept.unwrap_or_else(|| {
            let [x, y] = document.scenario.motion.position;
            signed(&format!("at ({x:.2}, {y:.2}) m"))
        }),
        Plot::Campbell => kept.unwrap_or_else(|| "Click to set the speed.".into()),
        Plot::Eigenvalues | Plot::Modes => kept.unwrap_or_else(|| "Click one: its mode moves.".into()),
        Plot::Growth => kept.unwrap_or_else(|| "Above zero something grows.".into()),
        Plot::Sensitivities => kept.unwrap_or_else(|| "Click one to turn it.".into()),
        Plot::WhatIf => "Click to set the value.".into(),
        Plot::Path | Plot::Gain | Plot::Deviation | Plot::Tensions => flight::caption(place.plot, facts),
    };
    ui.add(Label::new(RichText::new(text).weak().small()).truncate());
}

/// The line on which the platform moves, and which way.
pub fn line_of([x, y]: [f64; 2], [dx, dy]: [f64; 2]) -> String {
    let number = |value: f64| {
        let text = format!("{value:.2}");
        signed(text.trim_end_matches('0').trim_end_matches('.'))
    };
    let way = |value: f64| if value < 0.0 { '−' } else { '+' };
    if dy == 0.0 {
        format!("y = {} m, moving {}x", number(y + 0.0), way(dx))
    } else if dx == 0.0 {
        format!("x = {} m, moving {}y", number(x + 0.0), way(dy))
    } else {
        format!("through ({}, {}) m at {}°", number(x), number(y), number(dy.atan2(dx).to_degrees().round() + 0.0))
    }
}

/// A word with a line under it where it is chosen.
fn tab(ui: &mut Ui, title: &str, font: &FontId, chosen: bool) -> Response {
    let tokens = theme::tokens(ui.visuals());
    let galley = ui.painter().layout_no_wrap(title.to_owned(), font.clone(), tokens.text);
    let size = Vec2::new(galley.size().x + 2.0, ui.spacing().interact_size.y.max(32.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Tab, true, chosen, title));
    let colour = if chosen || response.hovered() { tokens.text } else { tokens.weak };
    let at = rect.center() - 0.5 * galley.size();
    ui.painter().galley_with_override_text_color(at, galley, colour);
    if chosen {
        ui.painter().hline(rect.x_range(), rect.bottom() - 1.0, Stroke::new(2.0, tokens.accent));
    }
    focus_ring(ui, &response, rect);
    response
}

/// A text that looks like what it is: something that opens an explanation.
fn explainer(place: PlotPlace, ui: &mut Ui) {
    let tokens = theme::tokens(ui.visuals());
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap("What am I seeing?".into(), font, tokens.accent_text);
    let size = Vec2::new(galley.size().x, ui.spacing().interact_size.y.max(24.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let open = explains(ui.ctx(), place);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, open, "What am I seeing?"));
    let text = Align2::LEFT_CENTER.align_size_within_rect(galley.size(), rect);
    let line = [text.left_bottom(), text.right_bottom()];
    ui.painter().galley(text.min, galley, tokens.accent_text);
    ui.painter().extend(Shape::dotted_line(&line, tokens.accent_text, 3.0, 0.7));
    focus_ring(ui, &response, rect);
    if response.clicked() {
        toggle_explanation(ui.ctx(), place);
    }
}

/// A small button above a plot.
fn tool<'a>(ui: &Ui, icon: Icon, word: &'a str, name: &'a str) -> IconButton<'a> {
    IconButton::new(icon, name).text(word).height(ui.spacing().interact_size.y.max(28.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_named_by_what_stays_and_by_the_way() {
        assert_eq!(line_of([3.0, 0.0], [1.0, 0.0]), "y = 0 m, moving +x");
        assert_eq!(line_of([3.0, -3.0], [-2.0, 0.0]), "y = −3 m, moving −x");
        assert_eq!(line_of([1.5, 0.0], [0.0, 1.0]), "x = 1.5 m, moving +y");
        assert_eq!(line_of([1.0, 0.0], [1.0, 1.0]), "through (1, 0) m at 45°");
    }
}
