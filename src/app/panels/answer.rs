//! The answer first: the critical speed in large figures and what belongs to it, as a card, as a line, or as the column of
//! a presentation.

use std::f64::consts::LN_2;

use eframe::egui::{
    Align, Align2, Color32, FontId, Label, Layout, Pos2, Rect, Response, RichText, Role, Sense, Shape, Spinner, Stroke,
    StrokeKind, Ui, UiBuilder, Vec2, WidgetInfo,
};

use crate::app::answers::CriticalState;
use crate::app::certainty::Certainty;
use crate::app::command::Command;
use crate::app::designs::{Design, Letter};
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::panels::moving;
use crate::app::theme::{self, Tokens};
use crate::app::words::{self, Word};
use crate::compute::protocol::{FailedPose, SearchEnd};
use crate::scenario::Scenario;
use crate::stability::{Critical, Instability};

/// The card's width and height in points; a line more for each design that is compared.
const CARD: Vec2 = Vec2::new(324.0, 152.0);
/// The height of the line about a kept design.
const DESIGN: f32 = 20.0;

/// What the criterion means; also the tooltip of the figure.
const FROZEN_TIME: &str = "The critical speed of this method is where an eigenvalue of the robot, frozen at this moment \
    of its motion, gets a positive real part. A cable that is being reeled in looks unstable at any speed unless damping \
    hides it, so the figure tells where reeling-in overcomes damping, or where the flow of cable reaches its wave speed, \
    whichever comes first.";

/// How the answer stands, in a word and a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Stable,
    Unstable,
    Open,
    None,
    Waits,
}

impl Sign {
    fn of(facts: Facts<'_>) -> Self {
        match facts.answers.critical() {
            CriticalState::Broken(_) | CriticalState::Failed(_) => Self::None,
            _ => match facts.answers.pose().and_then(|pose| pose.report.stable) {
                _ if undecided(facts) => Self::Open,
                Some(true) => Self::Stable,
                Some(false) => Self::Unstable,
                None => Self::Waits,
            },
        }
    }

    fn word(self, facts: Facts<'_>) -> &'static str {
        match self {
            Self::Stable => "stable now",
            Self::Unstable => "unstable now",
            Self::Open => "not decided",
            Self::None if facts.answers.failed().is_some_and(|failed| failed.report.feasible == Some(false)) => {
                "no equilibrium"
            }
            Self::None => "no answer",
            Self::Waits => "being computed",
        }
    }

    fn colour(self, tokens: &Tokens) -> Color32 {
        match self {
            Self::Stable => tokens.stable,
            Self::Unstable | Self::None | Self::Open => tokens.critical,
            Self::Waits => tokens.weak,
        }
    }

    /// A shape of its own for each, so that nothing is told by colour alone.
    fn paint(self, ui: &Ui, at: Pos2, colour: Color32) {
        let painter = ui.painter();
        let corners = |points: [[f32; 2]; 3]| points.map(|[x, y]| at + Vec2::new(x, y)).to_vec();
        match self {
            Self::Stable => _ = painter.circle_filled(at, 5.0, colour),
            Self::Unstable => {
                let triangle = corners([[-5.5, 4.5], [0.0, -5.0], [5.5, 4.5]]);
                painter.add(Shape::convex_polygon(triangle, colour, Stroke::NONE));
            }
            Self::None => {
                let stroke = Stroke::new(2.5, colour);
                painter.line_segment([at - Vec2::splat(4.5), at + Vec2::splat(4.5)], stroke);
                painter.line_segment([at + Vec2::new(-4.5, 4.5), at + Vec2::new(4.5, -4.5)], stroke);
            }
            Self::Open | Self::Waits => _ = painter.circle_stroke(at, 4.5, Stroke::new(1.5, colour)),
        }
    }
}

/// Whether the mesh leaves open on which side of the critical speed the present one is.
fn undecided(facts: Facts<'_>) -> bool {
    let Some(critical) = facts.answers.last_critical().and_then(|answer| answer.critical.as_ref()) else {
        return false;
    };
    let margin = (critical.speed - facts.document.scenario.motion.speed).abs();
    critical.speed > 0.0 && facts.certainty.speed().is_some_and(|off| off >= margin)
}

/// The size of the card.
pub fn size(facts: Facts<'_>) -> Vec2 {
    if facts.document.scenario.path.is_some() {
        return moving::CARD;
    }
    CARD + facts.designs.shown().map(|_| Vec2::new(0.0, DESIGN)).fold(Vec2::ZERO, std::ops::Add::add)
}

/// Draws the card with its upper left corner at `corner`. Gives where it is.
pub fn card(ui: &mut Ui, corner: Pos2, facts: Facts<'_>, commands: &mut Vec<Command>) -> Rect {
    if let Some(path) = &facts.document.scenario.path {
        return moving::card(ui, corner, path, facts, commands);
    }
    let tokens = theme::tokens(ui.visuals());
    let rect = Rect::from_min_size(corner, size(facts));
    // The card keeps the pointer from what is under it.
    ui.interact(rect, ui.scope_id().with("answer card"), Sense::click());
    ui.painter().rect(rect, 8.0, tokens.card, Stroke::new(1.0, tokens.line), StrokeKind::Inside);
    let inner = rect.shrink2(Vec2::new(15.0, 10.0));
    ui.scope_builder(UiBuilder::new().max_rect(inner).layout(Layout::top_down(Align::Min)), |ui| {
        ui.spacing_mut().item_spacing = Vec2::new(4.0, 1.0);
        ui.spacing_mut().interact_size.y = 16.0;
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        heading(ui, facts, commands);
        body(ui, facts, Form::Card, commands);
    });
    rect
}

/// The column of a presentation, in all the room there is.
pub fn column(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing = Vec2::new(4.0, 6.0);
    if let Some(path) = &facts.document.scenario.path {
        moving::column(ui, path, facts, commands);
        return;
    }
    ui.label(RichText::new("Critical speed here").color(theme::tokens(ui.visuals()).weak));
    body(ui, facts, Form::Column, commands);
}

/// How the answer is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// In a card: what belongs to the figure stands beside it.
    Card,
    /// In a column: it stands beneath.
    Column,
}

/// What it is, and how it stands.
fn heading(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let tokens = theme::tokens(ui.visuals());
    let sign = Sign::of(facts);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label(RichText::new("Critical speed here,").size(theme::CAPTION).color(tokens.weak));
        words::link(ui, Word::FrozenTime, "frozen time", commands);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let colour = sign.colour(tokens);
            let word = ui.label(RichText::new(sign.word(facts)).size(theme::CAPTION).color(colour));
            sign.paint(ui, word.rect.left_center() - Vec2::new(11.0, 0.0), colour);
            if matches!(facts.answers.critical(), CriticalState::Recomputing { .. }) {
                ui.add_space(20.0);
                ui.add(Spinner::new().size(11.0));
            }
        });
    });
}

fn body(ui: &mut Ui, facts: Facts<'_>, form: Form, commands: &mut Vec<Command>) {
    match facts.answers.critical() {
        CriticalState::Broken(reason) => {
            title(ui, "The analysis does not run");
            ui.label(reason);
        }
        CriticalState::Failed(failed) => failure(ui, facts, failed, commands),
        CriticalState::Current(answer) => figures(ui, facts, answer, true, form, commands),
        CriticalState::Recomputing { last: Some(answer), .. } => figures(ui, facts, answer, false, form, commands),
        CriticalState::Recomputing { last: None, searched_up_to } => {
            title(ui, "…");
            ui.label(recomputing(searched_up_to));
        }
    }
    differences(ui, facts);
}

fn title(ui: &mut Ui, text: &str) {
    ui.add_space(4.0);
    ui.add(Label::new(RichText::new(text).size(20.0)).truncate());
    ui.add_space(2.0);
}

fn recomputing(searched_up_to: Option<f64>) -> String {
    match searched_up_to {
        Some(speed) => format!("Recomputing, stable up to {speed:.1} m/s so far"),
        None => "Recomputing".into(),
    }
}

/// Why there is no answer, and the way back.
fn failure(ui: &mut Ui, facts: Facts<'_>, failed: &FailedPose, commands: &mut Vec<Command>) {
    let infeasible = failed.report.feasible == Some(false);
    match failed.cable {
        Some(cable) if infeasible => title(ui, &format!("Cable {} would push", cable + 1)),
        _ if infeasible => title(ui, "No equilibrium"),
        _ => title(ui, "Not computed"),
    }
    let reason = failed.report.reason.as_deref().unwrap_or("This pose could not be analysed.");
    ui.add(Label::new(reason).wrap());
    ui.add_space(4.0);
    if let Some([x, y]) = facts.answers.last_feasible() {
        ui.horizontal(|ui| {
            let text = format!("Back to ({x:.2}, {y:.2})");
            let button = IconButton::new(Icon::ArrowLeft, &text).text(&text).primary().show(ui);
            if button.explained("The last pose that had an equilibrium").clicked() {
                commands.push(Command::BackToFeasible);
            }
        });
    }
}

/// One critical speed with what belongs to it.
fn figures(ui: &mut Ui, facts: Facts<'_>, answer: &SearchEnd, current: bool, form: Form, commands: &mut Vec<Command>) {
    let Facts { document, answers, .. } = facts;
    let tokens = theme::tokens(ui.visuals());
    // An old figure is weak, and the last line says that it is being recomputed.
    let shade = |colour| if current { colour } else { tokens.weak };
    if let Some(reason) = &answer.failure {
        title(ui, "Not known");
        ui.add(Label::new(reason).wrap());
        return;
    }
    let Some(critical) = &answer.critical else {
        title(ui, "None found");
        ui.label(format!("Stable up to {} m/s, the limit of the search.", answer.searched_up_to));
        ui.label(RichText::new(sentence(facts, None)).color(shade(tokens.text)));
        return;
    };
    // What is certain belongs to the answer on show, not to an old one.
    let certainty = if current { facts.certainty } else { Certainty::Unknown };
    let exact = certainty.explained(critical, document.scenario.elements_per_cable);
    let rate = answers.pose().and_then(|pose| pose.report.cables.get(critical.cable)).map(|c| c.length_rate);
    let size = if form == Form::Card { theme::FIGURE } else { 43.0 };
    let figure = figure(&digits::certain(critical.speed, certainty.speed()), size, shade(tokens.text));
    let meaning = format!("{exact}\n\n{FROZEN_TIME}");
    match form {
        Form::Card => {
            ui.horizontal(|ui| {
                ui.add(Label::new(figure)).explained(meaning);
                ui.vertical(|ui| {
                    ui.add_space(2.0);
                    let right = Layout::right_to_left(Align::Center);
                    ui.horizontal(|ui| ui.with_layout(right, |ui| kind(ui, facts, critical, certainty, commands)));
                    ui.horizontal(|ui| {
                        ui.with_layout(right, |ui| responsible(ui, rate, critical, shade(tokens.critical)));
                    });
                });
            });
        }
        Form::Column => {
            ui.add(Label::new(figure)).explained(meaning);
            ui.horizontal(|ui| {
                kind(ui, facts, critical, certainty, commands);
                ui.label(RichText::new(format!("cable {}", critical.cable + 1)).color(shade(tokens.critical)));
            });
        }
    }
    scale(ui, facts, critical, certainty, current);
    let last = match answers.critical() {
        CriticalState::Recomputing { searched_up_to, .. } => recomputing(searched_up_to),
        _ => at_rest(critical, &document.scenario).map_or_else(|| sentence(facts, Some(critical)), ToOwned::to_owned),
    };
    let text = RichText::new(&last).color(shade(tokens.text));
    match form {
        Form::Card => _ = ui.add(Label::new(text).truncate()).explained_at_rest(&last),
        Form::Column => {
            let sign = Sign::of(facts);
            ui.horizontal(|ui| {
                let (mark, _) = ui.allocate_exact_size(Vec2::splat(16.0), Sense::hover());
                sign.paint(ui, mark.center(), sign.colour(tokens));
                ui.label(RichText::new(sign.word(facts)).color(sign.colour(tokens)));
            });
            ui.add(Label::new(text).wrap());
        }
    }
}

/// How stability is lost, in the direction of the layout.
fn kind(ui: &mut Ui, facts: Facts<'_>, critical: &Critical, certainty: Certainty, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.x = 4.0;
    let mut link = |ui: &mut Ui, word, text| _ = words::link(ui, word, text, commands);
    match critical.kind {
        Instability::Flutter => {
            let frequency = facts.settings.frequency_text(critical.frequency_hz(), certainty.frequency_hz());
            if ui.layout().prefer_right_to_left() {
                ui.label(frequency);
                link(ui, Word::Flutter, "flutter");
            } else {
                link(ui, Word::Flutter, "flutter");
                ui.label(frequency);
            }
        }
        Instability::Divergence => link(ui, Word::Divergence, "divergence"),
    }
}

/// The cable that the answer names, from right to left. `rate` is L' of it.
fn responsible(ui: &mut Ui, rate: Option<f64>, critical: &Critical, colour: Color32) {
    ui.spacing_mut().item_spacing.x = 0.0;
    if let Some(rate) = rate {
        ui.label(if rate < 0.0 { ", being reeled in" } else { ", being paid out" });
    }
    ui.label(RichText::new(format!("cable {}", critical.cable + 1)).color(colour));
}

/// The figure with its unit, as one text.
fn figure(number: &str, size: f32, colour: Color32) -> eframe::egui::text::LayoutJob {
    let mut job = eframe::egui::text::LayoutJob::default();
    let format = |size: f32| eframe::egui::TextFormat {
        font_id: FontId::proportional(size),
        color: colour,
        valign: Align::BOTTOM,
        ..Default::default()
    };
    job.append(number, 0.0, format(size));
    job.append(" m/s", 0.0, format((0.56 * size).max(13.0)));
    job
}

/// How far the present speed is from the critical one, in percent of it and a word.
fn margin(facts: Facts<'_>, critical: &Critical) -> Option<String> {
    let speed = facts.document.scenario.motion.speed;
    if critical.speed <= 0.0 {
        return None;
    }
    let percent = 100.0 * (critical.speed - speed) / critical.speed;
    let word = if percent > 0.0 { "below" } else { "above" };
    let size = percent.abs();
    Some(if size < 1000.0 { format!("{size:.0} % {word}") } else { format!("far {word}") })
}

/// What happens to a disturbance now, in halving or doubling times.
fn sentence(facts: Facts<'_>, critical: Option<&Critical>) -> String {
    if undecided(facts) {
        return "The mesh leaves open whether now is below or above.".into();
    }
    let margin = critical.and_then(|critical| margin(facts, critical)).map(|margin| margin + ". ");
    let growth = facts.answers.pose().and_then(|pose| pose.report.max_growth_rate);
    let what = match growth {
        Some(growth) if growth < 0.0 => {
            format!("A disturbance halves every {} s.", digits::certain(LN_2 / -growth, None))
        }
        Some(growth) if growth > 0.0 => {
            format!("A disturbance doubles every {} s.", digits::certain(LN_2 / growth, None))
        }
        Some(_) => "A disturbance neither grows nor dies out.".into(),
        None => String::new(),
    };
    margin.unwrap_or_default() + &what
}

/// Where now, critical and waves are on a bar from rest.
fn scale(ui: &mut Ui, facts: Facts<'_>, critical: &Critical, certainty: Certainty, current: bool) {
    let tokens = theme::tokens(ui.visuals());
    let (place, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), 50.0), Sense::hover());
    let now = facts.document.scenario.motion.speed;
    let waves = facts.answers.pose().and_then(|pose| pose.report.wave_limit.as_ref()).map(|limit| limit.speed);
    let [critical_text, now_text] = [digits::certain(critical.speed, certainty.speed()), format!("{now:.2}")];
    let waves_text = waves.map(|waves| digits::certain(waves, None));
    response.widget_info(|| {
        let waves = waves_text.as_ref().map(|waves| format!(", waves {waves}")).unwrap_or_default();
        WidgetInfo::labeled(Role::Image, true, format!("Now {now_text}, critical {critical_text}{waves} m/s"))
    });
    let bar =
        Rect::from_min_size(Pos2::new(place.min.x + 6.0, place.min.y + 21.0), Vec2::new(place.width() - 12.0, 6.0));
    let marks = Marks { now, critical: critical.speed, waves };
    track(ui, bar, marks, current);
    let at = |speed: f64| bar.min.x + bar.width() * marks.part(speed);
    let font = FontId::proportional(theme::CAPTION);
    let unstable = now >= critical.speed;
    let above = [
        (at(now), format!("now {now_text}"), if unstable { tokens.critical } else { tokens.accent }),
        (at(critical.speed), format!("critical {critical_text}"), tokens.critical),
    ];
    row(ui, place, bar.min.y - 3.0, Align2::CENTER_BOTTOM, &above, &font);
    let mut below = vec![(bar.min.x, "0".to_owned(), tokens.numbers)];
    if let (Some(waves), Some(text)) = (waves, waves_text) {
        let beyond = if marks.part(waves) >= 1.0 { " ▶" } else { "" };
        below.push((at(waves), format!("waves {text}{beyond}"), tokens.waves));
    }
    row(ui, place, bar.max.y + 3.0, Align2::CENTER_TOP, &below, &font);
}

/// Labels at their places in a row, pushed apart where they would meet.
fn row(ui: &Ui, within: Rect, y: f32, align: Align2, labels: &[(f32, String, Color32)], font: &FontId) {
    let mut labels: Vec<&(f32, String, Color32)> = labels.iter().collect();
    labels.sort_by(|a, b| a.0.total_cmp(&b.0));
    let painter = ui.painter();
    let galleys: Vec<_> =
        labels.iter().map(|(_, text, colour)| painter.layout_no_wrap(text.clone(), font.clone(), *colour)).collect();
    let widths: Vec<f32> = galleys.iter().map(|galley| galley.size().x).collect();
    let places = apart(&labels.iter().map(|(x, ..)| *x).collect::<Vec<f32>>(), &widths, within.min.x, within.max.x);
    for ((galley, x), (_, _, colour)) in galleys.into_iter().zip(places).zip(labels) {
        let rect = align.anchor_size(Pos2::new(x, y), galley.size());
        painter.galley(rect.min, galley, *colour);
    }
}

/// The middles of labels with these widths, as near to their places, in rising order, as they can be within `low` to
/// `high` without meeting.
fn apart(at: &[f32], widths: &[f32], low: f32, high: f32) -> Vec<f32> {
    const GAP: f32 = 6.0;
    let mut middles: Vec<f32> = at.to_vec();
    for _ in 0..2 {
        let mut least = low;
        for (middle, width) in middles.iter_mut().zip(widths) {
            *middle = middle.max(least + 0.5 * width);
            least = *middle + 0.5 * width + GAP;
        }
        let mut most = high;
        for (middle, width) in middles.iter_mut().zip(widths).rev() {
            *middle = middle.min(most - 0.5 * width);
            most = *middle - 0.5 * width - GAP;
        }
        // Two labels that meet part to both sides alike.
        for i in 1..middles.len() {
            let overlap = 0.5 * (widths[i - 1] + widths[i]) + GAP - (middles[i] - middles[i - 1]);
            if overlap > 0.0 {
                middles[i - 1] -= 0.5 * overlap;
                middles[i] += 0.5 * overlap;
            }
        }
    }
    middles
}

/// The speeds on a bar, in m/s.
#[derive(Clone, Copy, Debug)]
struct Marks {
    now: f64,
    critical: f64,
    waves: Option<f64>,
}

impl Marks {
    /// Where a speed is on the bar, from 0 to 1.
    fn part(self, speed: f64) -> f32 {
        let waves = self.waves.unwrap_or(0.0).min(1.3 * self.critical);
        let end = 1.25 * self.critical.max(waves).max(self.now.min(2.5 * self.critical)).max(1e-9);
        #[expect(clippy::cast_possible_truncation)] // A part of one.
        let part = (speed / end).clamp(0.0, 1.0) as f32;
        part
    }
}

/// The bar itself with its marks.
fn track(ui: &Ui, bar: Rect, marks: Marks, current: bool) {
    let tokens = theme::tokens(ui.visuals());
    let painter = ui.painter();
    let at = |speed: f64| bar.min.x + bar.width() * marks.part(speed);
    let limit = at(marks.critical);
    let fade = |colour: Color32| if current { colour } else { tokens.mute };
    painter.rect_filled(bar, 3.0, fade(tokens.stable).gamma_multiply(0.25));
    let beyond = Rect::from_min_max(Pos2::new(limit, bar.min.y), bar.max);
    painter.rect_filled(beyond, 3.0, tokens.panel);
    painter.rect_filled(beyond, 3.0, fade(tokens.critical).gamma_multiply(0.28));
    if let Some(waves) = marks.waves {
        let x = at(waves);
        let line = [Pos2::new(x, bar.min.y - 5.0), Pos2::new(x, bar.max.y + 5.0)];
        painter.extend(Shape::dashed_line(&line, Stroke::new(1.75, fade(tokens.waves)), 2.0, 2.0));
    }
    painter.vline(limit, bar.min.y - 5.0..=bar.max.y + 5.0, Stroke::new(3.0, fade(tokens.critical)));
    let now = Pos2::new(at(marks.now), bar.center().y);
    if marks.now < marks.critical {
        painter.circle(now, 6.0, tokens.accent, Stroke::new(1.5, tokens.card));
    } else {
        let corners = [[0.0, -7.0], [7.0, 0.0], [0.0, 7.0], [-7.0, 0.0]].map(|[x, y]| now + Vec2::new(x, y)).to_vec();
        painter.add(Shape::convex_polygon(corners, tokens.critical, Stroke::new(1.5, tokens.card)));
    }
}

/// The answer in one line.
pub fn line(ui: &mut Ui, facts: Facts<'_>) -> Response {
    if let Some(path) = &facts.document.scenario.path {
        return moving::line(ui, path, facts);
    }
    let tokens = theme::tokens(ui.visuals());
    let sign = Sign::of(facts);
    let (mark, _) = ui.allocate_exact_size(Vec2::new(18.0, 18.0), Sense::hover());
    sign.paint(ui, mark.center(), sign.colour(tokens));
    let waits = matches!(facts.answers.critical(), CriticalState::Recomputing { .. });
    let critical = facts.answers.last_critical().and_then(|answer| answer.critical.as_ref());
    let shade = if waits { tokens.weak } else { tokens.text };
    let words = match (sign, critical) {
        (Sign::None, _) => facts.answers.failed().map_or_else(
            || "The analysis does not run".to_owned(),
            |failed| match failed.cable.filter(|_| failed.report.feasible == Some(false)) {
                Some(cable) => format!("No equilibrium · cable {} would push", cable + 1),
                None => "Not computed".into(),
            },
        ),
        (_, Some(critical)) => {
            let figure = figure(&digits::certain(critical.speed, facts.certainty.speed()), 19.0, shade);
            ui.add(Label::new(figure)).explained(FROZEN_TIME);
            let kind = match critical.kind {
                Instability::Flutter => "flutter",
                Instability::Divergence => "divergence",
            };
            margin(facts, critical).map_or_else(|| format!("· {kind}"), |margin| format!("· {kind} · {margin}"))
        }
        (_, None) => match facts.answers.last_critical() {
            Some(answer) if answer.failure.is_some() => "Critical speed not known".into(),
            Some(answer) => format!("None up to {} m/s", answer.searched_up_to),
            None => "Being computed".into(),
        },
    };
    let response = ui.add(Label::new(RichText::new(words).color(shade)).truncate());
    if let Some(critical) = critical.filter(|_| sign != Sign::None)
        && ui.available_width() > 60.0
    {
        let (place, _) = ui.allocate_exact_size(Vec2::new(ui.available_width().min(140.0), 20.0), Sense::hover());
        let bar = Rect::from_center_size(place.center(), Vec2::new(place.width() - 14.0, 6.0));
        let waves = facts.answers.pose().and_then(|pose| pose.report.wave_limit.as_ref()).map(|limit| limit.speed);
        let marks = Marks { now: facts.document.scenario.motion.speed, critical: critical.speed, waves };
        track(ui, bar, marks, !waits);
    }
    response
}

/// Why the critical speed is zero, where it is.
pub fn at_rest(critical: &Critical, scenario: &Scenario) -> Option<&'static str> {
    let undamped = scenario.damping.alpha == 0.0 && scenario.damping.beta == 0.0;
    (critical.speed == 0.0).then_some(if undamped {
        "Without damping every cable that is reeled in looks unstable at any speed, however low: the criterion freezes \
         time, and nothing stands against it. Give α or β a value."
    } else {
        "It is unstable at rest already."
    })
}

/// A line for each kept design that is shown.
fn differences(ui: &mut Ui, facts: Facts<'_>) {
    for (letter, design) in facts.designs.shown() {
        let text = RichText::new(against(letter, design, facts)).color(letter.colour(ui.visuals()));
        ui.add(Label::new(text).truncate());
    }
}

/// A kept design's critical speed, and how far the present one is from it.
pub fn against(letter: Letter, design: &Design, facts: Facts<'_>) -> String {
    let answer = match facts.answers.critical() {
        CriticalState::Current(answer) => Some(answer),
        _ => None,
    };
    let now = answer.and_then(|answer| answer.critical.as_ref());
    let not_known = |answer: Option<&SearchEnd>| answer.is_some_and(|answer| answer.failure.is_some());
    let of_design = |critical: &Critical| digits::certain(critical.speed, design.certainty().speed());
    let text = match (design.critical(), now) {
        _ if !design.is_complete() => "being computed".into(),
        _ if design.answers().pose_failed() => "no equilibrium".into(),
        (Some(before), None) if not_known(answer) => format!("{} m/s. Now not known", of_design(before)),
        (None, _) if not_known(design.search()) => "not known".into(),
        (Some(before), Some(now)) => {
            let (hertz, unit) = facts.settings.hertz();
            let frequency = (now.frequency_hz() - before.frequency_hz()) * hertz;
            let difference = now.speed - before.speed;
            // What the mesh does to both it does to their difference in proportion.
            let share = facts.share();
            let [speed, frequency] = [difference, frequency].map(|value| digits::change_like(value, share));
            let part = if before.speed > 0.0 {
                let percent = 100.0 * difference / before.speed;
                format!(" ({} %)", digits::change_like(percent, share))
            } else {
                String::new()
            };
            format!("{} m/s. Now {speed} m/s{part}, {frequency} {unit}", of_design(before))
        }
        (Some(before), None) => format!("{} m/s. Now none", of_design(before)),
        (None, Some(_)) => "no critical speed found".into(),
        (None, None) => "none found either".into(),
    };
    format!("{}: {text}", letter.name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_part_where_they_would_meet_and_stay_within() {
        assert_eq!(apart(&[50.0, 150.0], &[40.0, 40.0], 0.0, 300.0), [50.0, 150.0]);
        let met = apart(&[100.0, 110.0], &[60.0, 60.0], 0.0, 300.0);
        assert!(met[1] - met[0] >= 65.9 && met[0] >= 30.0 && met[1] <= 270.0, "{met:?}");
        let end = apart(&[280.0, 295.0], &[60.0, 60.0], 0.0, 300.0);
        assert!(end[1] <= 270.1 && end[1] - end[0] >= 65.9, "{end:?}");
    }

    #[test]
    fn marks_are_on_the_bar_in_their_order() {
        let marks = Marks { now: 5.0, critical: 11.3, waves: Some(11.9) };
        let [now, critical, waves] = [5.0, 11.3, 11.9].map(|speed| marks.part(speed));
        assert!(0.3 < now && now < critical && critical < waves && waves < 0.9, "{now} {critical} {waves}");
        // A present speed or a wave limit far beyond leaves the critical speed where it can be seen.
        let far = Marks { now: 1e4, critical: 11.3, waves: Some(1e3) };
        assert!(far.part(11.3) > 0.25 && far.part(1e4) > 0.999);
        let rest = Marks { now: 0.0, critical: 0.0, waves: None };
        assert!(rest.part(0.0) == 0.0);
    }
}
