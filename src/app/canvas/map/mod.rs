//! The map under the robot: its picture, its legend and controls, what it says under the pointer, and a click that moves
//! the platform. The border of the feasible region belongs to it, and is shown without it too.

mod contours;
mod legend;
mod lines;
mod paint;
mod picture;
mod region;

use std::time::Duration;

use eframe::egui::{
    Align, Button, ComboBox, Label, Layout, Painter, PopupAnchor, ProgressBar, Rect, Response, RichText, Role, Sense,
    Shape, Stroke, Tooltip, Ui, UiBuilder, Vec2, Visuals, WidgetInfo,
};

pub use lines::Taken;
pub use paint::{colour, corners, hatching};
pub use picture::{Cell, Picture};

use super::View;
use super::range::KeptRange;
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::round::roundest;
use crate::app::settings::Settings;
use crate::app::state::{MapQuantity, MapView};
use crate::app::studies::{Shown, Studies, StudyRequest, StudyResults, StudyStage};
use crate::app::{digits, series, theme};
use crate::compute::protocol::{Revision, Topic};
use crate::robot::Vec2 as WorldVec2;
use crate::scenario::Scenario;
use crate::stability::Instability;
use crate::study::{Answer, Directions, Mapped, NoEigenvalues, Study, Verdict};
use lines::Lines;
use paint::Texture;
use picture::{NO_EQUILIBRIUM, NOT_COMPUTED};
use region::Region;

/// While answers come in, the picture is made anew this often, in seconds.
const RENEWAL: f64 = 0.1;
/// Controls that have less room than this, in points, say less.
const NARROW: f32 = 215.0;
/// The border's width where it is to be seen, in points.
const BORDER: f32 = 2.0;

/// All quantities with their names.
const QUANTITIES: [(MapQuantity, &str, &str); 6] = [
    (MapQuantity::Speed, "Critical speed", "The first speed at which a vibration grows, in m/s"),
    (MapQuantity::Frequency, "Frequency", "The frequency of the vibration that grows first; 0 for divergence"),
    (MapQuantity::Kind, "Instability", "Flutter (a vibration grows) or divergence (a cable bows out)"),
    (MapQuantity::Cable, "Cable", "The cable with most of the kinetic energy of the vibration that grows first"),
    (
        MapQuantity::Growth,
        "Growth rate",
        "The largest growth rate at the present speed, in 1/s; above 0 it is unstable",
    ),
    (MapQuantity::Waves, "Wave limit", "The speed at which a winch reels as fast as waves run along its cable, in m/s"),
];

/// What a picture was made of: the answers, the quantity, whether it is dark, whether it ends at the border, and what its
/// numbers are multiplied with.
type Key = ((Revision, usize), MapQuantity, bool, bool, u64);

/// What the range of the colours is about: a quantity, what its numbers are multiplied with, and the robot as it was opened.
type Coloured = (MapQuantity, u64, Scenario);

/// What is drawn under the robot, made anew only when something of it changes.
#[derive(Default)]
pub struct Layer {
    key: Option<Key>,
    made_at: f64,
    current: bool,
    picture: Option<Picture>,
    texture: Texture,
    colours: KeptRange<Coloured>,
    lines: Lines,
    /// The feasible region, with what it was made of.
    region: Option<((Revision, usize), Option<Region>)>,
    /// Whether it is that of the present robot.
    region_current: bool,
    /// Whether it is that of the picture's robot, so that the picture ends at its border.
    bounded: bool,
}

impl Layer {
    /// One without pictures, whose colours have the same range.
    pub fn for_picture(&self) -> Self {
        Self { colours: self.colours.clone(), ..Self::default() }
    }

    /// Makes anew what there are other answers for, another quantity or other colours.
    pub fn update(&mut self, ui: &Ui, facts: Facts<'_>, view: MapView) {
        let Facts { document, studies, .. } = facts;
        let border = studies.shown(Topic::Border);
        self.update_region(border);
        let Some(Shown { known, current }) = studies.shown(Topic::Map).filter(|_| view.on) else {
            (self.key, self.picture) = (None, None);
            self.lines.renew(None, 1.0);
            return;
        };
        // The study of another quantity may still be the one on show.
        let quantity = match (asks_growth(known), view.quantity) {
            (true, _) => MapQuantity::Growth,
            (false, MapQuantity::Growth) => MapQuantity::Speed,
            (false, quantity) => quantity,
        };
        self.current = current;
        // The map's robot would have the same border.
        let same = |border: &StudyResults| {
            StudyRequest::new(&known.request.scenario, border.request.study.clone()) == border.request
        };
        self.bounded = border.is_some_and(|border| same(border.known));
        let (unit, _) = legend::unit(quantity, facts);
        let key = (known.version, quantity, ui.visuals().dark_mode, self.bounds().is_some(), unit.to_bits());
        if self.key != Some(key) && self.is_due(ui, studies, key) {
            self.key = Some(key);
            self.picture = Picture::new(known, quantity).map(|mut picture| {
                let growth = quantity == MapQuantity::Growth;
                let fitting = picture.range.map(|range| legend::round_range(range, unit, growth));
                let about = (quantity, unit.to_bits(), document.original.clone());
                picture.range = self.colours.update(&about, fitting, known.is_complete());
                picture
            });
            // What goes on beyond the border is covered there.
            let spread = self.picture.as_ref().filter(|_| self.bounds().is_some()).map(Picture::spread);
            let drawn = spread.as_ref().or(self.picture.as_ref());
            if let Some(drawn) = drawn {
                self.texture.make(ui, drawn);
            }
            self.lines.renew(drawn, unit);
        }
        if self.picture.as_ref().is_some_and(|picture| picture.quantity == MapQuantity::Speed) {
            self.lines.at_speed(document.scenario.motion.speed);
        }
    }

    /// Whether it is time for another picture: while answers come in, not in every frame.
    fn is_due(&mut self, ui: &Ui, studies: &Studies, key: Key) -> bool {
        let now = ui.input(|input| input.time);
        let more_to_come = studies.progress(Topic::Map).stage == StudyStage::Working;
        let same_look = self.key.is_some_and(|before| (before.1, before.2, before.4) == (key.1, key.2, key.4));
        if more_to_come && same_look && now < self.made_at + RENEWAL {
            ui.ctx().request_repaint_after(Duration::from_secs_f64(RENEWAL));
            return false;
        }
        self.made_at = now;
        true
    }

    fn update_region(&mut self, shown: Option<Shown<'_>>) {
        self.region_current = shown.is_some_and(|shown| shown.current && shown.known.is_complete());
        let Some(Shown { known, .. }) = shown else {
            self.region = None;
            return;
        };
        if self.region.as_ref().is_none_or(|(version, _)| *version != known.version) {
            self.region = Some((known.version, Region::new(known)));
        }
    }

    /// The region at whose border the picture ends.
    fn bounds(&self) -> Option<&Region> {
        self.region.as_ref()?.1.as_ref().filter(|_| self.bounded)
    }

    /// Draws the map, where it is on. Labels of contours keep clear of what is `taken`.
    pub fn paint(&mut self, painter: &Painter, ui: &Ui, view: &View, taken: &Taken) {
        let Some(picture) = &self.picture else { return };
        let visuals = ui.visuals();
        self.texture.paint(painter, view, picture, self.current);
        self.lines.paint(painter, visuals, view, self.current);
        paint::patterns(painter, visuals, view, picture, self.bounds());
        if self.current {
            self.lines.label(painter, visuals, view, taken);
            paint::extremes(painter, visuals, view, picture);
        }
    }

    /// Draws the border of the feasible region, as far as it is known, and hatches what lies outside, unless the map has
    /// done so. That of an earlier robot is grey.
    pub fn border(&self, painter: &Painter, visuals: &Visuals, view: &View) {
        let Some((_, Some(region))) = &self.region else { return };
        if self.picture.is_none() {
            paint::outside(painter, visuals, view, region);
        }
        let tokens = theme::tokens(visuals);
        let colour = if self.region_current { tokens.stable } else { tokens.mute };
        paint::border(painter, view, region, Stroke::new(BORDER, colour));
    }
}

fn asks_growth(known: &StudyResults) -> bool {
    matches!(known.request.study, Study::Map { mapped: Mapped::Growth { .. }, .. })
}

/// Legend, quantity, direction, ways to the lowest and the highest place, and progress, in `corner` of the canvas; nothing
/// where the map is off.
pub fn controls(
    layer: &mut Layer,
    map: &mut MapView,
    ui: &mut Ui,
    corner: Rect,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    if !map.on {
        return;
    }
    // A zoomed map may lie under the corner.
    let ground = ui.painter().add(Shape::Noop);
    let layout = Layout::top_down(Align::Min);
    // A click on the legend is none on the map.
    let room = UiBuilder::new().max_rect(corner).layout(layout).sense(Sense::CLICK);
    let inner = ui.scope_builder(room, |ui| {
        ui.spacing_mut().item_spacing = Vec2::new(8.0, 6.0);
        let picture = layer.picture.as_ref();
        legend::ui(ui, map.quantity, picture, layer.current, facts);
        choices(map, ui, facts.document.scenario.motion.direction);
        // In one row, since what is under the pointer is not to move when a study begins or ends.
        if matches!(facts.studies.progress(Topic::Map).stage, StudyStage::Idle | StudyStage::Finished) {
            if let Some(picture) = picture {
                ui.add_enabled_ui(layer.current, |ui| extremes(picture, ui, facts, commands));
            }
        } else {
            ui.horizontal(|ui| progress(ui, Topic::Map, facts.studies, commands));
        }
        if let Some(picture) = picture {
            legend::entries(ui, picture);
        }
        if layer.colours.could_fit() && layer.picture.as_ref().is_some_and(|picture| picture.range.is_some()) {
            let text =
                "The colours keep their range while numbers change. This takes the range of the values there are.";
            if ui.button("Fit colours").explained(text).clicked() {
                layer.colours.fit();
                layer.key = None;
            }
        }
    });
    let colour = theme::tokens(ui.visuals()).canvas.gamma_multiply(0.92);
    ui.painter().set(ground, Shape::rect_filled(inner.response.rect.expand(4.0), 6.0, colour));
}

/// What a picture's colours and patterns mean, in `corner` of the canvas: nothing to press.
pub fn key(layer: &Layer, map: MapView, ui: &mut Ui, corner: Rect, facts: Facts<'_>) {
    let room = UiBuilder::new().max_rect(corner).layout(Layout::top_down(Align::Min));
    ui.scope_builder(room, |ui| {
        ui.spacing_mut().item_spacing = Vec2::new(8.0, 6.0);
        legend::ui(ui, map.quantity, layer.picture.as_ref(), layer.current, facts);
        let way = way(facts.document.scenario.motion.direction);
        let text = if map.worst { "in the worst of 16 directions".into() } else { format!("moving {way}") };
        ui.label(RichText::new(text).small().weak());
        if let Some(picture) = &layer.picture {
            legend::entries(ui, picture);
        }
    });
}

/// What the map shows, and in which direction each point is passed.
fn choices(map: &mut MapView, ui: &mut Ui, direction: [f64; 2]) {
    let way = way(direction);
    let narrow = ui.available_width() < NARROW;
    let names = if narrow { [way, "worst".into()] } else { [format!("moving {way}"), "worst direction".into()] };
    let name = |worst| names[usize::from(worst)].as_str();
    let title = |quantity| QUANTITIES.iter().find(|(other, ..)| *other == quantity).map_or("", |(_, name, _)| name);
    ui.horizontal(|ui| {
        // Both lists fit side by side.
        let spacing = ui.spacing_mut();
        (spacing.item_spacing.x, spacing.button_padding.x, spacing.icon_width) = (4.0, 6.0, 10.0);
        let list = ComboBox::from_id_salt("map quantity").width(0.0).selected_text(title(map.quantity));
        let list = list.show_ui(ui, |ui| {
            for (quantity, name, text) in QUANTITIES {
                ui.selectable_value(&mut map.quantity, quantity, name).explained(text);
            }
        });
        named(&list.response, "Map quantity", title(map.quantity));
        let list = ComboBox::from_id_salt("map direction").truncate().width(ui.available_width());
        let list = list.selected_text(name(map.worst)).show_ui(ui, |ui| {
            let text = "Every point is passed in the motion's direction.";
            ui.selectable_value(&mut map.worst, false, name(false)).explained(text);
            let text = "At every point the worst of 16 directions counts. This takes longer.";
            ui.selectable_value(&mut map.worst, true, name(true)).explained(text);
        });
        named(&list.response, "Map direction", name(map.worst));
    });
}

/// A direction in a word or in degrees.
fn way(direction: [f64; 2]) -> String {
    let degrees = series::degrees(direction);
    let near = |angle: f64| (degrees - angle).abs() < 0.05;
    match degrees {
        _ if near(0.0) => "+x".into(),
        _ if near(90.0) => "+y".into(),
        _ if near(180.0) || near(-180.0) => "−x".into(),
        _ if near(-90.0) => "−y".into(),
        _ if (degrees - degrees.round()).abs() < 0.05 => format!("{degrees:.0}°"),
        _ => format!("{degrees:.1}°"),
    }
}

/// Buttons that move the platform to the lowest and to the highest place.
fn extremes(picture: &Picture, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(places) = picture.extremes else { return };
    let (unit, _) = legend::unit(picture.quantity, facts);
    let width = 0.5 * (ui.available_width() - ui.spacing().item_spacing.x);
    let height = ui.spacing().interact_size.y;
    ui.horizontal(|ui| {
        for ((index, value), [mark, word, name]) in
            places.into_iter().zip([["▼", "Lowest", "Go to the lowest"], ["▲", "Highest", "Go to the highest"]])
        {
            let value = short(value * unit, facts.share());
            let text = if 2.0 * width < NARROW { format!("{mark} {value}") } else { format!("{mark} {word} {value}") };
            let button = ui.add_sized([width, height], Button::new(text));
            button.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
            let at = picture.grid.position(index);
            let text = format!("Moves the platform there, to ({:.2}, {:.2}) m", at.x, at.y);
            if button.explained(text).clicked() {
                move_to(at.into(), facts, commands);
            }
        }
    });
}

/// A value with no more digits than a button has room for.
fn short(value: f64, share: Option<f64>) -> String {
    let text = digits::like(value, share);
    let long = text.split_once('.').is_some_and(|(_, decimals)| decimals.len() > 2);
    if long && value.abs() >= 0.01 { format!("{value:.2}") } else { text }
}

fn move_to(position: [f64; 2], facts: Facts<'_>, commands: &mut Vec<Command>) {
    let mut scenario = facts.document.scenario.clone();
    scenario.motion.position = position;
    commands.push(Command::Edit(Box::new(scenario)));
}

/// A list's name for those who do not see it.
pub fn named(list: &Response, name: &str, value: &str) {
    list.widget_info(|| WidgetInfo {
        label: Some(name.into()),
        current_text_value: Some(value.into()),
        ..WidgetInfo::new(Role::ComboBox)
    });
}

/// How far a study has come, with a button that stops it or goes on; nothing where all is known.
pub fn progress(ui: &mut Ui, topic: Topic, studies: &Studies, commands: &mut Vec<Command>) {
    let progress = studies.progress(topic);
    #[expect(clippy::cast_possible_truncation)] // A part of one.
    let part = (progress.done as f64 / progress.total.max(1) as f64) as f32;
    match progress.stage {
        StudyStage::Working => {
            if ui.button("Cancel").explained("Stops this study; what is known of it stays").clicked() {
                commands.push(Command::StopStudy(topic));
            }
            let text = format!("{} of {}", progress.done, progress.total);
            ui.scope(|ui| {
                // The bar's own ground is the canvas's.
                ui.visuals_mut().extreme_bg_color = ui.visuals().widgets.inactive.weak_bg_fill;
                let response = ui.add(ProgressBar::new(part).desired_width(120.0).text(text));
                response.explained("Points computed so far");
            });
        }
        StudyStage::Stopped => {
            if ui.button("Resume").clicked() {
                commands.push(Command::ResumeStudy(topic));
            }
            ui.weak("Stopped");
        }
        StudyStage::Failed => {
            if ui.button("Try again").clicked() {
                commands.push(Command::ResumeStudy(topic));
            }
            ui.weak(studies.broken().unwrap_or("This could not be computed."));
        }
        StudyStage::Idle | StudyStage::Finished => {}
    }
}

/// Says what is known at the map's point nearest to the pointer, marks it, and moves the platform on a click.
pub fn point(
    ui: &Ui,
    painter: &Painter,
    background: &Response,
    view: &View,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let Facts { studies, settings, .. } = facts;
    let Some(Shown { known, current }) = studies.shown(Topic::Map) else { return };
    let Study::Map { grid, .. } = &known.request.study else { return };
    let pointer = background.hover_pos().filter(|_| background.hovered() && !background.dragged());
    if let Some(pointer) = pointer
        && let Some(nearest) = picture::nearest(grid, view.pos_in_world(pointer).into())
    {
        let at = grid.position(nearest);
        painter.circle_stroke(view.pos_in_ui(at.into()), 4.0, (1.5, ui.visuals().strong_text_color()));
        let mut text = reading(known, nearest, at, settings, facts.share());
        if !current {
            text.push_str("\nOf an earlier state, being recomputed");
        }
        let id = background.id.with("reading");
        Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), id, PopupAnchor::Pointer).gap(14.0).show(|ui| {
            ui.add(Label::new(text).extend());
        });
    }
    let clicked = background.interact_pointer_pos().filter(|_| background.clicked());
    if let Some(clicked) = clicked {
        let to = view.pos_in_world(clicked);
        if picture::nearest(grid, to.into()).is_some() {
            move_to(to.map(|coordinate| roundest(coordinate, 1.0 / view.scale)), facts, commands);
        }
    }
}

/// What is known at one of a map's points, in words.
fn reading(known: &StudyResults, index: usize, at: WorldVec2, settings: Settings, share: Option<f64>) -> String {
    let place = format!("At ({:.2}, {:.2}) m", at.x, at.y);
    let said = match known.places.get(index).and_then(Option::as_ref) {
        None => "not computed yet".into(),
        Some(Answer::Growth(Ok(rate))) => {
            let word = if *rate > 0.0 { "grows" } else { "dies out" };
            format!("{word}, growth rate {} 1/s", digits::certain(*rate, None))
        }
        Some(Answer::Growth(Err(NoEigenvalues::Infeasible))) => NO_EQUILIBRIUM.into(),
        Some(Answer::Critical { direction, verdict, wave_limit }) => {
            let said = found(known, *direction, verdict, settings, share);
            // It is as far off as the critical speed, which comes from the same mesh.
            let waves = wave_limit.map(|speed| format!("\nwave limit {} m/s", digits::like(speed, share)));
            said + &waves.unwrap_or_default()
        }
        Some(_) => NOT_COMPUTED.into(),
    };
    format!("{place}:\n{said}")
}

/// What a search for the critical speed has found, in words.
fn found(
    known: &StudyResults,
    direction: WorldVec2,
    verdict: &Verdict,
    settings: Settings,
    share: Option<f64>,
) -> String {
    match verdict {
        Verdict::Infeasible => NO_EQUILIBRIUM.into(),
        Verdict::Unknown => NOT_COMPUTED.into(),
        Verdict::NotConverged => format!("critical speed {NOT_COMPUTED}"),
        Verdict::NoneUpTo(speed) => format!("no critical speed up to {speed:.0} m/s"),
        Verdict::Critical(critical) => {
            let kind = match critical.kind {
                Instability::Flutter => {
                    let (hertz, unit) = settings.hertz();
                    format!("flutter at {} {unit}", digits::like(critical.frequency_hz() * hertz, share))
                }
                Instability::Divergence => "divergence".into(),
            };
            let worst = match known.request.study {
                Study::Map { directions: Directions::Worst(_), .. } => {
                    format!("\nin the direction {:.1}°", series::degrees(direction.into()))
                }
                _ => String::new(),
            };
            let speed = digits::like(critical.speed, share);
            format!("critical speed {speed} m/s{worst}\n{kind}, cable {}", critical.cable + 1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_have_words_and_buttons_short_figures() {
        let ways = [[1.0, 0.0], [0.0, 2.0], [-1.0, 0.0], [-1.0, -0.0], [0.0, -1.0], [3.0, 3.0]].map(way);
        assert_eq!(ways, ["+x", "+y", "−x", "−x", "−y", "45°"]);
        assert_eq!(way([2.0, 1.0]), "26.6°");
        let figures = [0.041_234, 15.0432, 0.001_234, -0.2049, 0.0].map(|value| short(value, None));
        assert_eq!(figures, ["0.04", "15.0", "0.00123", "-0.20", "0"]);
    }
}
