//! A flight on the canvas: where it would be without deviations, the platform's trace, and what is doubtful.

use eframe::egui::{Pos2, Rect, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo};

use super::labels::{Pen, beside};
use super::model::{Figures, Scene};
use super::paint::trimmed;
use super::view::View;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::flying::{Instant, trace};
use crate::app::meaning::Explain as _;
use crate::app::state::{Movement, Playback};
use crate::study::Flown;

/// The radius of the platform, and of where it would be, in points.
const PLATFORM: f32 = 10.0;
const ON_PATH: f32 = 5.0;
/// Half a cross where a cable goes slack, in points.
const CROSS: f32 = 5.0;
/// Below the legend and the button that fits the view, in points.
pub const UNDER_LEGEND: f32 = 96.0;

/// What is farther from the canvas than this, in points, is not drawn in dashes.
const FAR: f32 = 1e4;

/// A flight at the moment that is on show.
pub struct Shown<'a> {
    flown: &'a Flown,
    /// That moment.
    pub instant: Instant,
    factor: u8,
}

impl<'a> Shown<'a> {
    /// The flight, where it is what moves and has begun: at its beginning the robot stands and can be dragged.
    pub fn new(playback: &Playback, facts: Facts<'a>) -> Option<Self> {
        let begun = playback.playing || facts.flying.time > 0.0;
        let flown = facts.flown().filter(|_| begun && playback.movement == Movement::Fly)?;
        let factor = facts.flying.factor;
        let end = flown.flight.lost.unwrap_or(flown.flight.end);
        let instant = Instant::new(flown, facts.flying.time.min(end), f64::from(factor))?;
        Some(Self { flown, instant, factor })
    }
}

impl Scene {
    /// Puts the robot where the flight has it. What is said of the pose belongs to another place, and is left out.
    pub fn fly(&mut self, instant: &Instant) {
        self.platform = instant.on_path;
        self.speed = instant.speed;
        (self.critical, self.waves, self.trouble, self.unstable) = (None, None, None, false);
        for (line, cable) in self.cables.iter_mut().zip(&instant.cables) {
            line.nodes.clone_from(&cable.nodes);
            line.vibrating.clear();
            line.marked = false;
            let elements = cable.nodes.len().saturating_sub(1);
            let [first, last] = cable.tensions;
            let part = |k: usize| (k as f64 + 0.5) / elements as f64;
            // The doubtful has no colours of tension.
            let elements = if instant.doubtful { 0 } else { elements };
            line.forces = (0..elements).map(|k| first + part(k) * (last - first)).collect();
            line.figures =
                Some(Figures { at_platform: first, at_winch: last, length: cable.length[0], reeling: cable.length[1] });
        }
    }
}

/// Draws what is under the cables: the shape without deviations, and the way that the platform has come.
pub fn under(pen: &mut Pen<'_>, view: &View, shown: &Shown<'_>, time: f64) {
    let (painter, tokens) = (pen.painter, pen.tokens);
    for cable in &shown.instant.cables {
        broken(pen, view, &cable.quasi_static, Stroke::new(1.0, tokens.mute));
        if shown.instant.doubtful {
            broken(pen, view, &cable.nodes, Stroke::new(2.0, tokens.mute));
        }
    }
    let trace = trace(shown.flown, f64::from(shown.factor));
    let doubtful_from = shown.flown.flight.slack.map_or(f64::INFINITY, |slack| slack.time);
    let until = trace.partition_point(|(at, _)| *at <= time);
    let split = trace.partition_point(|(at, _)| *at <= doubtful_from.min(time));
    let points = |range: &[(f64, [f64; 2])]| -> Vec<Pos2> { range.iter().map(|(_, at)| view.pos_in_ui(*at)).collect() };
    let mut sure = points(&trace[..split]);
    if split == until {
        sure.push(view.pos_in_ui(shown.instant.platform));
    }
    painter.add(Shape::line(sure, Stroke::new(1.5, tokens.accent)));
    if split < until {
        let mut doubtful = points(&trace[split.saturating_sub(1)..until]);
        doubtful.push(view.pos_in_ui(shown.instant.platform));
        painter.extend(Shape::dashed_line(&doubtful, Stroke::new(1.5, tokens.mute), 4.0, 3.0));
    }
}

/// Draws what is over the cables: the platform, where it would be, and where a cable goes slack.
pub fn over(pen: &mut Pen<'_>, ui: &Ui, view: &View, rect: Rect, under: f32, shown: &Shown<'_>) {
    let Shown { flown, instant, factor } = shown;
    let (painter, tokens) = (pen.painter, pen.tokens);
    let [on_path, platform] = [instant.on_path, instant.platform].map(|at| view.pos_in_ui(at));
    painter.circle(on_path, ON_PATH, tokens.canvas, Stroke::new(1.5, tokens.mute));
    let colour = if instant.doubtful { tokens.mute } else { tokens.accent };
    painter.circle(platform, PLATFORM, colour, Stroke::new(2.0, tokens.canvas));
    pen.places.keep_free(Rect::from_center_size(platform, Vec2::splat(24.0)));
    if let Some(slack) = flown.flight.slack
        && let Some(there) = Instant::new(flown, slack.time, 1.0)
    {
        let at = view.pos_in_ui(there.on_path);
        let stroke = Stroke::new(2.5, tokens.critical);
        for side in [1.0, -1.0] {
            let corner = Vec2::new(CROSS, side * CROSS);
            pen.painter.line_segment([at - corner, at + corner], stroke);
        }
        pen.places.keep_free(Rect::from_center_size(at, Vec2::splat(2.0 * CROSS)));
        let places = |size| [Vec2::DOWN, Vec2::UP].map(|side| beside(at, side, 10.0, size)).to_vec();
        pen.write(format!("cable {} slack, {:.2} s", slack.cable + 1, slack.time), tokens.critical, places);
    }
    let text = if *factor == 1 {
        "True deviation; dashed: without it".to_owned()
    } else {
        format!("Deviation drawn × {factor}; dashed: without it")
    };
    let places = |size: Vec2| {
        let right = rect.max.x - size.x - 16.0;
        [[right, under], [right, rect.max.y - size.y - 8.0], [rect.min.x + 16.0, rect.max.y - size.y - 8.0]]
            .map(|[x, y]| Rect::from_min_size(Pos2::new(x, y), size))
            .to_vec()
    };
    pen.write(text, tokens.weak, places);
    told(ui, platform, rect, instant);
}

/// Says where the platform is to those who point at it, and to screen readers.
fn told(ui: &Ui, platform: Pos2, rect: Rect, instant: &Instant) {
    let place = Rect::from_center_size(platform, Vec2::splat(24.0)).intersect(rect);
    if !place.is_positive() {
        return;
    }
    let [x, y] = instant.on_path.map(trimmed);
    let off = digits::certain(1e3 * instant.deviation[0].hypot(instant.deviation[1]), None);
    let text = format!("The platform, {off} mm off its path at ({x}, {y}) m");
    let response = ui.interact(place, ui.scope_id().with("flown platform"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &text));
    response.explained_at_rest(text.clone());
}

fn broken(pen: &Pen<'_>, view: &View, nodes: &[[f64; 2]], stroke: Stroke) {
    let points: Vec<Pos2> = nodes.iter().map(|&node| view.pos_in_ui(node)).collect();
    // One line, so that the dashes run on from element to element; far outside the canvas they would be without number.
    if points.iter().all(|point| point.is_finite() && point.to_vec2().length() < FAR) {
        pen.painter.extend(Shape::dashed_line(&points, stroke, 5.0, 4.0));
    }
}
