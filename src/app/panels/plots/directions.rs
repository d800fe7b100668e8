//! The critical speed in every direction, as a polar diagram.

use std::f64::consts::TAU;

use eframe::egui::{
    Align2, Button, Color32, Label, Painter, Pos2, Rect, Response, RichText, Role, Sense, Shape, Stroke, Ui, Vec2,
    WidgetInfo,
};

use super::axis::signed;
use super::chart::{self, Chart, Dash, Symbol, quad};
use super::common::{self, PlotPlace, Slot};
use super::range::{self, VisibleRange};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::round::round_step;
use crate::app::series::{self, degrees};
use crate::app::studies::{Shown, StudyResults};
use crate::compute::protocol::Topic;
use crate::stability::Instability;
use crate::study::Verdict;

/// What the plot shows, in plain words.
pub const MEANING: &str = "From the middle outward: the critical speed of a motion through this pose in that direction, \
    right is to the right and up is up. Where the line comes near the middle, the platform must move slowly. Dashed is the \
    present speed, dotted the wave limit. The curve breaks where it jumps and where there is no critical speed. The lowest direction is also on the canvas, as a dashed arrow.";

/// The width of what stands beside the plot, in points.
const BESIDE: f32 = 150.0;
/// A pointer this far from the curve's direction still means it, in points.
const NEAREST: f32 = 12.0;

/// Draws the diagram and what follows from it.
pub fn ui(place: PlotPlace, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(Shown { known, current }) = common::study(Topic::Directions, facts) else {
        common::say(ui, "No answer yet.");
        return;
    };
    let Some(lowest) = series::worst_direction(known) else {
        let none = known.places.iter().flatten().next().is_some();
        common::say(ui, if none { "No critical speed in any direction at this pose." } else { "No answer yet." });
        return;
    };
    let diagram = Diagram { known, current, lowest, facts };
    let room = ui.available_rect_before_wrap();
    if room.width() > room.height() + 0.7 * BESIDE {
        let beside = Rect::from_min_max(Pos2::new(room.right() - BESIDE, room.top()), room.max);
        let response = ui.allocate_rect(room.with_max_x(beside.left() - 8.0), Sense::click_and_drag());
        diagram.ui(place, ui, &response);
        ui.scope_builder(eframe::egui::UiBuilder::new().max_rect(beside), |ui| {
            // A picture has it as its title.
            if place.slot != Slot::Picture {
                ui.label("Critical speed by direction, m/s");
            }
            diagram.words(place, ui, commands);
        });
        return;
    }
    let button = ui.spacing().interact_size.y + ui.spacing().item_spacing.y;
    let rect = room.with_max_y(room.bottom() - button - 3.6 * chart::font(ui).size);
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    diagram.ui(place, ui, &response);
    diagram.words(place, ui, commands);
}

/// What is drawn.
struct Diagram<'a> {
    known: &'a StudyResults,
    current: bool,
    /// The direction with the lowest critical speed, and that in m/s.
    lowest: ([f64; 2], f64),
    facts: Facts<'a>,
}

impl Diagram<'_> {
    /// What the curve says of the present speed, and the button that goes to its lowest point.
    fn words(&self, place: PlotPlace, ui: &mut Ui, commands: &mut Vec<Command>) {
        ui.add(Label::new(RichText::new(self.finding()).weak()).wrap());
        if place.slot == Slot::Picture {
            return;
        }
        let button = ui.add(Button::new("Turn to lowest"));
        if button.explained("Sets the direction of the motion").clicked() {
            let mut scenario = self.facts.document.scenario.clone();
            scenario.motion.direction = self.lowest.0;
            commands.push(Command::Edit(Box::new(scenario)));
        }
    }

    fn critical_speeds(&self) -> impl Iterator<Item = f64> {
        let verdicts = series::directions(self.known).into_iter().filter_map(|(_, verdict)| verdict);
        verdicts.filter_map(Verdict::critical).map(|critical| critical.speed)
    }

    /// Whether the present speed is below the critical one everywhere.
    fn finding(&self) -> String {
        let now = self.facts.document.scenario.motion.speed;
        let below = self.critical_speeds().filter(|speed| *speed <= now).count();
        let so_far = if self.known.is_complete() { "" } else { " so far" };
        match below {
            0 => format!("Every direction{so_far} is above the present {now:.2} m/s (dashed)."),
            some if some == self.critical_speeds().count() => {
                format!("Every direction{so_far} is below the present {now:.2} m/s (dashed).")
            }
            _ => format!("Some directions{so_far} are below the present {now:.2} m/s (dashed)."),
        }
    }

    /// The lowest speed and its direction in a few words.
    fn lowest_text(&self) -> String {
        let (direction, speed) = self.lowest;
        let speed = digits::like(speed, self.facts.share());
        signed(&format!("lowest {speed} at {:.0}°", degrees(direction) + 0.0))
    }

    fn ui(&self, place: PlotPlace, ui: &Ui, response: &Response) {
        let Self { known, current, lowest, facts } = self;
        let now = facts.document.scenario.motion.speed;
        response.widget_info(|| {
            let text = format!(
                "Directions: the critical speed by direction in m/s, {}. {}",
                self.lowest_text(),
                self.finding()
            );
            WidgetInfo::labeled(Role::Image, true, signed(&text))
        });
        let outer = response.rect;
        let size = chart::font(ui).size;
        let side = (outer.width() - 2.0 * size).min(outer.height() - size).max(40.0);
        let rect = Rect::from_center_size(outer.center(), Vec2::splat(side));
        let largest = self.critical_speeds().fold(1e-3, f64::max);
        // Room for what is now, unless it is far beyond all else.
        let (step, count) = steps(largest);
        let outermost = f64::from(count) * step;
        let reach = 1.18 * outermost.max(if now < 2.0 * largest { now } else { 0.0 });
        let fit = [[-reach, reach]; 2];
        let axes = Chart::axes(rect, VisibleRange::of(ui.ctx(), place.id()).bounds(fit, fit));
        let mut chart = Chart::new(ui, outer, outer, axes);
        let tokens = chart.tokens;
        let shade = |colour| if *current { colour } else { tokens.mute };
        let words = |colour| if *current { colour } else { tokens.weak };

        let curves = series::around(known);
        fan(&chart, &curves, shade(tokens.stable).gamma_multiply(0.09));
        rings(&mut chart, ui, step, count);
        for (letter, design) in facts.designs.shown() {
            let Some(before) = design.study(Topic::Directions) else { continue };
            let (colour, before) = (letter.colour(ui.visuals()), series::around(before));
            for stretch in &before {
                chart.curve(stretch, Stroke::new(1.5, colour), Dash::Design(letter));
            }
            if let Some(point) = before.first().and_then(|stretch| stretch.get(stretch.len() / 5)) {
                let spot = chart.pos(*point);
                chart.label(letter.name(), colour, &[spot]);
            }
        }
        for run in series::waves_around(known) {
            chart.curve(&run, Stroke::new(1.75, shade(tokens.waves)), Dash::Dotted);
        }
        for stretch in &curves {
            chart.curve(stretch, Stroke::new(2.25, shade(tokens.critical)), Dash::Solid);
        }
        chart.curve(&circle(now), Stroke::new(1.5, tokens.accent), Dash::Dashed);
        let [x, y] = facts.document.scenario.motion.direction;
        let length = x.hypot(y);
        let [x, y] = [x / length, y / length];
        let (middle, tip) = (chart.pos([0.0, 0.0]), chart.pos([now * x, now * y]));
        arrow(&chart.painter, middle, tip, Stroke::new(2.5, tokens.accent));

        let (direction, speed) = *lowest;
        let at = chart.pos([speed * direction[0], speed * direction[1]]);
        chart.keep_free(at, 5.0);
        chart.label(self.lowest_text(), words(tokens.critical), &[at]);
        let spots = [[0.0, -now], [-now, 0.0], [0.0, now]].map(|point| chart.pos(point));
        chart.label(format!("now {now:.2}"), tokens.accent, &spots);
        if let Some(point) =
            series::waves_around(known).iter().max_by_key(|run| run.len()).and_then(|run| run.get(run.len() / 3))
        {
            let spot = chart.pos(*point);
            chart.label("waves", words(tokens.waves), &[spot]);
        }
        chart.finish();
        chart.mark(at, Symbol::Dot, 4.5, shade(tokens.critical));
        range::turn(ui, response, place.id(), axes, fit, place.turning([true, true]));
        if let Some(pointer) = response.hover_pos().filter(|_| !response.dragged()) {
            self.read(&chart, pointer);
        }
    }

    /// Says what is known in the direction in which the pointer is.
    fn read(&self, chart: &Chart, pointer: Pos2) {
        let [x, y] = [chart.x.value(pointer.x), chart.y.value(pointer.y)];
        if chart.pos([0.0, 0.0]).distance(pointer) < NEAREST {
            return;
        }
        let away = |direction: [f64; 2]| -(direction[0] * x + direction[1] * y);
        let known = series::directions(self.known).into_iter().filter_map(|(at, verdict)| Some((at, verdict?)));
        let nearest = known.min_by(|a, b| away(a.0).total_cmp(&away(b.0)));
        let Some((direction, verdict)) = nearest else { return };
        let angle = signed(&format!("{:.0}°", degrees(direction) + 0.0));
        let (at, lines) = match verdict {
            Verdict::Critical(critical) => {
                let speed = digits::like(critical.speed, self.facts.share());
                let kind = match critical.kind {
                    Instability::Flutter => {
                        format!("flutter {}", self.facts.settings.frequency_text(critical.frequency_hz(), None))
                    }
                    Instability::Divergence => "divergence".into(),
                };
                let at = chart.pos([critical.speed * direction[0], critical.speed * direction[1]]);
                chart.mark(at, Symbol::Ring, 6.0, chart.tokens.text);
                (at, vec![format!("{angle}: critical {speed} m/s"), format!("{kind}, cable {}", critical.cable + 1)])
            }
            Verdict::NoneUpTo(limit) => (pointer, vec![format!("{angle}: stable up to {limit} m/s")]),
            Verdict::Infeasible => (pointer, vec![format!("{angle}: no equilibrium")]),
            Verdict::Unknown | Verdict::NotConverged => (pointer, vec![format!("{angle}: not known")]),
        };
        chart.card(at, &lines);
    }
}

/// Fills what is between the middle and the curves.
fn fan(chart: &Chart, curves: &[Vec<[f64; 2]>], fill: Color32) {
    let middle = chart.pos([0.0, 0.0]);
    let mut mesh = eframe::egui::epaint::Mesh::default();
    for pair in curves.iter().flat_map(|curve| curve.windows(2)) {
        quad(&mut mesh, [middle, chart.pos(pair[0]), chart.pos(pair[1]), middle], fill);
    }
    chart.painter.add(Shape::mesh(mesh));
}

/// A circle of one speed.
fn circle(speed: f64) -> Vec<[f64; 2]> {
    let point = |k: u8| {
        let (sine, cosine) = (TAU * f64::from(k) / 120.0).sin_cos();
        [speed * cosine, speed * sine]
    };
    (0..=120).map(point).collect()
}

/// A round step between circles, and how many of them enclose all up to `largest`.
fn steps(largest: f64) -> (f64, u8) {
    let step = round_step(largest / 3.2);
    let count = (1..=4_u8).find(|count| f64::from(*count) * step >= largest).unwrap_or(4);
    (step, count)
}

/// Circles of equal speed, spokes every 45°, and their numbers.
fn rings(chart: &mut Chart, ui: &Ui, step: f64, count: u8) {
    let tokens = chart.tokens;
    let stroke = Stroke::new(1.0, tokens.line);
    let outermost = f64::from(count) * step;
    for spoke in 0..8_u8 {
        let (sine, cosine) = (TAU * f64::from(spoke) / 8.0).sin_cos();
        let end = chart.pos([outermost * cosine, outermost * sine]);
        chart.painter.line_segment([chart.pos([0.0, 0.0]), end], stroke);
        if spoke % 2 == 0 {
            let beyond = chart.pos([outermost * cosine, outermost * sine]) + 14.0 * spoke_way(cosine, sine);
            let text = format!("{}°", u16::from(spoke) * 45);
            let painter = ui.painter_at(chart.painter.clip_rect());
            painter.text(beyond, Align2::CENTER_CENTER, text, chart::font(ui), tokens.numbers);
            chart.keep_free(beyond, 12.0);
        }
    }
    for i in 1..=count {
        let radius = f64::from(i) * step;
        let points: Vec<Pos2> = circle(radius).into_iter().map(|point| chart.pos(point)).collect();
        chart.painter.line(points, stroke);
        // Between two spokes, where directions of interest are rare.
        let (sine, cosine) = (-TAU / 16.0).sin_cos();
        let text = digits::certain(radius, Some(0.5 * step));
        chart.label_at(text, tokens.numbers, chart.pos([radius * cosine, radius * sine]), Align2::CENTER_CENTER);
    }
}

/// A direction of the world on the screen, where y points down.
#[expect(clippy::cast_possible_truncation)] // Of a unit vector.
fn spoke_way(cosine: f64, sine: f64) -> Vec2 {
    Vec2::new(cosine as f32, -sine as f32)
}

/// An arrow; too short a one has no head.
fn arrow(painter: &Painter, from: Pos2, to: Pos2, stroke: Stroke) {
    let way = to - from;
    if way.length() < 6.0 {
        return;
    }
    let (along, across) = (way.normalized(), way.normalized().rot90());
    let neck = to - 9.0 * along;
    painter.line_segment([from, neck], stroke);
    let head = vec![to, neck + 5.0 * across, neck - 5.0 * across];
    painter.add(Shape::convex_polygon(head, stroke.color, Stroke::NONE));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outermost_circle_encloses_the_curve() {
        for (largest, step, count) in [(14.0, 5.0, 3), (9.0, 5.0, 2), (0.3, 0.1, 3), (40.0, 20.0, 2)] {
            let (found, circles) = steps(largest);
            assert!((found / step - 1.0).abs() < 1e-9 && circles == count, "{largest}: {found} {circles}");
        }
    }
}
