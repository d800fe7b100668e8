//! The map under the robot: its controls, its picture, what it says under the pointer, and a click that moves the
//! platform.

mod paint;
mod picture;

use eframe::egui::{
    Align, ComboBox, Label, Layout, Painter, PopupAnchor, ProgressBar, Rect, Response, Tooltip, Ui, UiBuilder, Vec2,
    WidgetInfo,
};

pub use picture::Picture;

use super::View;
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::round::roundest;
use crate::app::settings::Settings;
use crate::app::state::{Camera, MapQuantity, MapView};
use crate::app::studies::{Known, Shown, Stage, Studies};
use crate::app::{digits, series};
use crate::compute::protocol::{Revision, Topic};
use crate::robot::Vec2 as WorldVec2;
use crate::stability::Instability;
use crate::study::{Answer, Directions, Mapped, NoEigenvalues, Study, Verdict};
use paint::Texture;
use picture::{NO_EQUILIBRIUM, NOT_COMPUTED};

/// While answers come in, the picture is made anew this often, in seconds.
const RENEWAL: f64 = 0.1;

/// All quantities with their names.
const QUANTITIES: [(MapQuantity, &str, &str); 5] = [
    (MapQuantity::Speed, "Critical speed", "The first speed at which a vibration grows, in m/s"),
    (MapQuantity::Frequency, "Frequency", "The frequency of the vibration that grows first; 0 for divergence"),
    (MapQuantity::Kind, "Instability", "Flutter (a vibration grows) or divergence (a cable bows out)"),
    (MapQuantity::Cable, "Cable", "The cable with most of the kinetic energy of the vibration that grows first"),
    (MapQuantity::Growth, "Growth rate", "The largest growth rate at today's speed, in 1/s; above 0 it is unstable"),
];

/// What the picture was made of.
type Key = ((Revision, usize), MapQuantity, bool);

/// The picture on show, made anew only when something of it changes.
#[derive(Default)]
pub struct Layer {
    key: Option<Key>,
    made_at: f64,
    current: bool,
    picture: Option<Picture>,
    texture: Texture,
}

impl Layer {
    /// Makes the picture anew where there are other answers, another quantity or other colours.
    pub fn update(&mut self, ui: &Ui, studies: &Studies, view: MapView) {
        let Some(Shown { known, current }) = studies.shown(Topic::Map).filter(|_| view.on) else {
            (self.key, self.picture) = (None, None);
            return;
        };
        // The study of another quantity may still be the one on show.
        let quantity = match (asks_growth(known), view.quantity) {
            (true, _) => MapQuantity::Growth,
            (false, MapQuantity::Growth) => MapQuantity::Speed,
            (false, quantity) => quantity,
        };
        self.current = current;
        let key = (known.version, quantity, ui.visuals().dark_mode);
        if self.key == Some(key) {
            return;
        }
        let now = ui.input(|input| input.time);
        let more_to_come = studies.progress(Topic::Map).stage == Stage::Working;
        let same_look = self.key.is_some_and(|(_, quantity, dark)| (quantity, dark) == (key.1, key.2));
        if more_to_come && same_look && now < self.made_at + RENEWAL {
            ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(RENEWAL));
            return;
        }
        (self.key, self.made_at) = (Some(key), now);
        self.picture = Picture::new(known, quantity);
        if let Some(picture) = &self.picture {
            self.texture.make(ui, picture);
        }
    }

    /// Draws the picture.
    pub fn paint(&self, painter: &Painter, ui: &Ui, view: &View) {
        if let Some(picture) = &self.picture {
            self.texture.paint(painter, view, picture, self.current);
            paint::patterns(painter, ui.visuals(), view, picture);
        }
    }

    /// Draws what the colours and patterns mean, in the canvas's lower left corner.
    pub fn legend(&self, painter: &Painter, ui: &Ui, rect: Rect, facts: Facts<'_>) {
        if let Some(picture) = &self.picture {
            paint::legend(painter, ui.visuals(), rect, picture, self.current, facts);
        }
    }
}

fn asks_growth(known: &Known) -> bool {
    matches!(known.wish.study, Study::Map { mapped: Mapped::Growth { .. }, .. })
}

/// Switch, quantity, direction and progress, in the canvas's upper right corner.
pub fn controls(
    map: &mut MapView,
    camera: &mut Camera,
    ui: &mut Ui,
    rect: Rect,
    studies: &Studies,
    commands: &mut Vec<Command>,
) {
    let room = Rect::from_min_max(rect.min + Vec2::new(8.0, 6.0), rect.max - Vec2::new(8.0, 6.0));
    let layout = Layout::top_down(Align::Max);
    ui.scope_builder(UiBuilder::new().max_rect(room).layout(layout), |ui| {
        ui.allocate_ui_with_layout(Vec2::new(room.width(), 20.0), Layout::right_to_left(Align::Center), |ui| {
            let text = "Colours the workspace under the robot, point by point. A click on it moves the platform.";
            ui.toggle_value(&mut map.on, "Map").explained(text);
            if map.on {
                choices(map, ui);
            }
            if *camera != Camera::default() && ui.button("Show all").clicked() {
                *camera = Camera::default();
            }
        });
        if map.on {
            let row = Vec2::new(room.width(), 20.0);
            ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
                progress(ui, Topic::Map, studies, commands);
            });
        }
    });
}

fn choices(map: &mut MapView, ui: &mut Ui) {
    let name = |worst| if worst { "Worst direction" } else { "Motion's direction" };
    let list = ComboBox::from_id_salt("map direction").width(126.0).selected_text(name(map.worst));
    let list = list.show_ui(ui, |ui| {
        let text = "Every point is passed in the motion's direction.";
        ui.selectable_value(&mut map.worst, false, name(false)).explained(text);
        let text = "At every point the worst of 16 directions counts. This takes longer.";
        ui.selectable_value(&mut map.worst, true, name(true)).explained(text);
    });
    named(&list.response, "Map direction", name(map.worst));
    let title = |quantity| QUANTITIES.iter().find(|(other, ..)| *other == quantity).map_or("", |(_, name, _)| name);
    let list = ComboBox::from_id_salt("map quantity").width(104.0).selected_text(title(map.quantity));
    let list = list.show_ui(ui, |ui| {
        for (quantity, name, text) in QUANTITIES {
            ui.selectable_value(&mut map.quantity, quantity, name).explained(text);
        }
    });
    named(&list.response, "Map quantity", title(map.quantity));
}

/// A list's name for those who do not see it.
pub fn named(list: &Response, name: &str, value: &str) {
    list.widget_info(|| WidgetInfo {
        label: Some(name.into()),
        current_text_value: Some(value.into()),
        ..WidgetInfo::new(eframe::egui::Role::ComboBox)
    });
}

/// How far a study has come, with a button that stops it or goes on; nothing where all is known.
pub fn progress(ui: &mut Ui, topic: Topic, studies: &Studies, commands: &mut Vec<Command>) {
    let progress = studies.progress(topic);
    #[expect(clippy::cast_possible_truncation)] // A part of one.
    let part = (progress.done as f64 / progress.total.max(1) as f64) as f32;
    match progress.stage {
        Stage::Working => {
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
        Stage::Stopped => {
            if ui.button("Resume").clicked() {
                commands.push(Command::ResumeStudy(topic));
            }
            ui.weak("Stopped");
        }
        Stage::Failed => {
            if ui.button("Try again").clicked() {
                commands.push(Command::ResumeStudy(topic));
            }
            ui.weak(studies.broken().unwrap_or("This could not be computed."));
        }
        Stage::Idle | Stage::Finished => {}
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
    let Facts { document, studies, settings, .. } = facts;
    let Some(Shown { known, current }) = studies.shown(Topic::Map) else { return };
    let Study::Map { grid, .. } = &known.wish.study else { return };
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
            let mut scenario = document.scenario.clone();
            scenario.motion.position = to.map(|coordinate| roundest(coordinate, 1.0 / view.scale));
            commands.push(Command::Edit(Box::new(scenario)));
        }
    }
}

/// What is known at one of a map's points, in words.
fn reading(known: &Known, index: usize, at: WorldVec2, settings: Settings, share: Option<f64>) -> String {
    let place = format!("At ({:.2}, {:.2}) m", at.x, at.y);
    let said = match known.places.get(index).and_then(Option::as_ref) {
        None => "not computed yet".into(),
        Some(Answer::Growth(Ok(rate))) => {
            let word = if *rate > 0.0 { "grows" } else { "dies out" };
            format!("{word}, growth rate {} 1/s", digits::certain(*rate, None))
        }
        Some(Answer::Growth(Err(NoEigenvalues::Infeasible))) => NO_EQUILIBRIUM.into(),
        Some(Answer::Growth(Err(NoEigenvalues::Failed)) | Answer::Spectrum(_) | Answer::Modes(_)) => {
            NOT_COMPUTED.into()
        }
        Some(Answer::Critical { direction, verdict, .. }) => match verdict {
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
                let worst = match known.wish.study {
                    Study::Map { directions: Directions::Worst(_), .. } => {
                        format!("\nin the direction {:.1}°", series::degrees((*direction).into()))
                    }
                    _ => String::new(),
                };
                let speed = digits::like(critical.speed, share);
                format!("critical speed {speed} m/s{worst}\n{kind}, cable {}", critical.cable + 1)
            }
        },
    };
    format!("{place}:\n{said}")
}
