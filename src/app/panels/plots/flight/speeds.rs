//! The speed on the path: what is flown, and the limits it meets, under the robot on its own horizontal axis.

use eframe::egui::{Pos2, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo};

use super::time;
use crate::app::canvas::View;
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::limits::LimitsAsked;
use crate::app::panels::plots::axis::{Axis, signed};
use crate::app::panels::plots::chart::{self, Chart, Dash, Symbol, Titles};
use crate::app::panels::plots::common::{self, PlotPlace, Slot};
use crate::app::panels::plots::line::label_curve;
use crate::app::panels::plots::range::{self, VisibleRange};
use crate::app::series::{Abscissa, Stations, Way, fastest, of_the_move};
use crate::app::state::Plot;
use crate::compute::protocol::Topic;
use crate::robot::{Side, Trajectory};
use crate::study::Station;

/// A plot with less height than this, in points, has no room for long words.
const LOW: f32 = 80.0;

/// What the plot shows, in plain words.
pub fn meaning(facts: Facts<'_>) -> String {
    let finding = of_the_move(facts).map_or_else(String::new, |finding| format!(" {finding}"));
    signed(&format!(
        "The speed that this move has at every place of its path, and two limits there. Whole: the frozen critical speed, \
         where some vibration would grow if lengths and rates stayed as they are at that moment. Passing it for a while \
         means little: of the paper's robot it is 4.88 m/s at x = −6 m, yet flown rest to rest at peaks of 5, 8, even \
         11 m/s, every vibration ends smaller than it began. Dotted: the wave limit, where a winch reels as fast as waves \
         run along its cable. In all robots tried, growth without bound began only beyond it, so stay below it. A cross \
         marks where a cable goes slack.{finding}"
    ))
}

/// What the plot is told besides the facts.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The view of the robot whose horizontal axis it shares, where the path is horizontal.
    pub view: Option<&'a View>,
    /// The time in the flight that is on show, in s.
    pub now: Option<f64>,
    /// The machine's limits.
    pub limits: &'a LimitsAsked,
}

/// Draws the plot in all the room there is.
pub fn ui(place: PlotPlace, asked: Asked<'_>, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(trajectory) = super::trajectory(ui, facts, commands) else { return };
    if !place.slot.is_under_the_robot()
        && !matches!(place.slot, Slot::Sheet | Slot::Picture)
        && let Some(finding) = of_the_move(facts)
    {
        common::say(ui, &signed(&finding));
    }
    let response = ui.allocate_rect(ui.available_rect_before_wrap(), Sense::click_and_drag());
    Drawing::new(&trajectory, asked, facts).ui(place, ui, &response);
}

/// Draws it as a mere strip under the robot, without a header; nothing without a path.
pub fn strip(ui: &mut Ui, rect: Rect, asked: Asked<'_>, facts: Facts<'_>) {
    let Some(trajectory) = facts.document.scenario.trajectory() else { return };
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    let place = PlotPlace { slot: Slot::Under, plot: Plot::Path, wheel: false };
    Drawing::new(&trajectory, asked, facts).ui(place, ui, &response);
}

struct Drawing<'a> {
    way: Way<'a>,
    trajectory: &'a Trajectory,
    asked: Asked<'a>,
    facts: Facts<'a>,
}

impl<'a> Drawing<'a> {
    fn new(trajectory: &'a Trajectory, asked: Asked<'a>, facts: Facts<'a>) -> Self {
        Self { way: Way::new(trajectory), trajectory, asked, facts }
    }

    fn ui(&self, place: PlotPlace, ui: &Ui, response: &Response) {
        let Self { way, asked, facts, .. } = self;
        let view = asked.view.filter(|_| place.slot.is_under_the_robot() && way.abscissa == Abscissa::X);
        let shown = facts.studies.shown(Topic::Path);
        let stations = shown.and_then(|shown| Some((Stations::new(shown.known)?, shown.current)));
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, self.told(stations.as_ref())));
        let outer = response.rect;
        let alone = !place.slot.is_under_the_robot();
        let titles = Titles {
            x: Some(way.abscissa.title()).filter(|_| alone),
            x_unit: Some("m").filter(|_| !alone),
            y: Some("speed, m/s").filter(|_| alone),
        };
        let mut room = chart::inner(ui, outer, titles);
        let fit = [self.range(view.is_some()), [0.0, self.top(stations.as_ref())]];
        let shows = VisibleRange::of(ui.ctx(), place.id()).bounds(fit, fit);
        let x = match view {
            Some(view) => {
                // The same points of the screen as the robot has.
                let ends = fit[0].map(|at| view.pos_in_ui([at, 0.0]).x);
                room.min.x = ends[0].clamp(room.left(), room.right() - 1.0);
                room.max.x = ends[1].clamp(room.left() + 1.0, room.right());
                Axis::linear(fit[0], ends)
            }
            None => Axis::linear(shows[0], [room.left(), room.right()]),
        };
        let y = Axis::linear(shows[1], [room.bottom(), room.top()]);
        let mut chart = Chart::new(ui, outer, room, [x, y]);
        if let Some((stations, _)) = &stations {
            for stretch in stations.infeasible(way) {
                chart.hatch(stretch);
            }
        }
        let flown = way.flown();
        chart.area(&flown, chart.tokens.accent_fill);
        chart.grid(titles);
        if let Some((stations, current)) = &stations {
            self.limits(&mut chart, stations, *current);
        }
        chart.curve(&flown, Stroke::new(2.25, chart.tokens.accent), Dash::Solid);
        let top = flown.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]));
        if let Some([at, speed]) = top {
            let below = chart.pos([at, 0.6 * speed]);
            chart.label("flown", chart.tokens.accent, &[below, chart.pos([at, speed])]);
        }
        self.now(&mut chart, ui, outer);
        self.slack(&mut chart);
        chart.finish();
        self.hovered(&chart, response, stations.as_ref());
        if view.is_none() {
            range::turn(ui, response, place.id(), [x, y], fit, place.turning([true, true]));
        } else {
            crate::app::gestures::scrolls_or_turns(response);
        }
    }

    /// Frozen critical speed, wave limit, and what winches allow where that is given.
    fn limits(&self, chart: &mut Chart, stations: &Stations<'_>, current: bool) {
        let tokens = chart.tokens;
        let shade = |colour| if current { colour } else { tokens.mute };
        let words = |colour| if current { colour } else { tokens.weak };
        let (waves, frozen) = (stations.waves(&self.way), stations.frozen(&self.way));
        for run in &waves {
            chart.curve(run, Stroke::new(1.75, shade(tokens.waves)), Dash::Dotted);
        }
        for run in &frozen {
            chart.curve(run, Stroke::new(2.25, shade(tokens.critical)), Dash::Solid);
        }
        if let Some(rate) = self.asked.limits.winch_speed {
            let winches = stations.winches(&self.way, rate);
            for run in &winches {
                chart.curve(run, Stroke::new(1.5, shade(tokens.text)), Dash::Pattern(1));
            }
            label_curve(chart, "winches", words(tokens.text), &winches);
        }
        if let Some((Ok(fastest), true)) = fastest(self.facts) {
            let points: Vec<[f64; 2]> = fastest.found.rows.iter().map(|row| [self.way.at(row.s), row.v]).collect();
            chart.curve(&points, Stroke::new(1.75, shade(tokens.stable)), Dash::Pattern(1));
            label_curve(chart, "fastest allowed", words(tokens.stable), &[points]);
        }
        // A strip has room for short words alone.
        let [of_waves, of_frozen] =
            if chart.rect.height() < LOW { ["waves", "frozen"] } else { ["wave limit", "frozen critical, m/s"] };
        label_curve(chart, of_waves, words(tokens.waves), &waves);
        label_curve(chart, of_frozen, words(tokens.critical), &frozen);
    }

    /// The platform's place: in the flight while one is on show, else at the beginning.
    fn now(&self, chart: &mut Chart, ui: &Ui, outer: Rect) {
        let Self { way, trajectory, asked, .. } = self;
        let moment = trajectory.at(asked.now.unwrap_or(0.0), Side::Right);
        let at = chart.pos([way.at(moment.s), moment.v]);
        let tokens = chart.tokens;
        if chart.rect.x_range().expand(0.5).contains(at.x) {
            let line = vec![Pos2::new(at.x, outer.top()), Pos2::new(at.x, chart.rect.bottom())];
            chart::draw_line(&ui.painter_at(outer), line, Stroke::new(1.5, tokens.accent), Dash::Dashed);
            if asked.now.is_some() {
                chart.painter.circle_filled(at, 6.0, tokens.panel);
                chart.painter.circle_filled(at, 4.5, tokens.accent);
                chart.keep_free(at, 6.0);
            }
        }
    }

    /// Where a cable goes slack in the flight.
    fn slack(&self, chart: &mut Chart) {
        let Ok(flown) = time::flown(self.facts) else { return };
        let Some(slack) = flown.flight.slack else { return };
        let moment = self.trajectory.at(slack.time, Side::Right);
        let at = chart.pos([self.way.at(moment.s), moment.v]);
        let tokens = chart.tokens;
        let (colour, words) =
            if flown.current { (tokens.critical, tokens.critical) } else { (tokens.mute, tokens.weak) };
        chart.mark(at, Symbol::Cross, 5.0, colour);
        chart.keep_free(at, 6.0);
        chart.label(format!("cable {} slack", slack.cable + 1), words, &[at]);
    }

    /// What is known under the pointer.
    fn hovered(&self, chart: &Chart, response: &Response, stations: Option<&(Stations<'_>, bool)>) {
        let Some(pointer) = response.hover_pos().filter(|_| !response.dragged()) else { return };
        let s = self.way.s(chart.x.value(pointer.x));
        let station = stations.and_then(|(stations, _)| stations.nearest(s));
        let s = station.map_or(s, |station| station.s);
        let place = chart.pos([self.way.at(s), self.way.speed_at(s)]);
        let line = [Pos2::new(place.x, chart.rect.top()), Pos2::new(place.x, chart.rect.bottom())];
        chart.painter.line_segment(line, Stroke::new(1.0, chart.tokens.mute));
        chart.mark(place, Symbol::Ring, 5.0, chart.tokens.text);
        chart.card(place, &self.reading(s, station));
    }

    /// What is known at arc length `s`, line by line.
    fn reading(&self, s: f64, station: Option<&Station>) -> Vec<String> {
        let speed = |value| digits::certain(value, None);
        let at = signed(&self.way.abscissa.place(self.way.at(s), 2));
        let mut lines = vec![format!("{at}: {} m/s at {:.2} s", speed(self.way.speed_at(s)), self.way.time_at(s))];
        let Some(station) = station else { return lines };
        if station.verdict.feasible() == Some(false) {
            lines.push("no equilibrium".into());
        }
        if let Some(critical) = station.verdict.critical() {
            lines.push(format!("frozen critical {} m/s, cable {}", speed(critical.speed), critical.cable + 1));
        }
        if let Some(limit) = station.wave_limit {
            let reels = if limit.reeled_in { "in" } else { "out" };
            lines.push(format!("wave limit {} m/s, cable {} {reels}", speed(limit.speed), limit.cable + 1));
        }
        lines
    }

    /// The plot in sentences, for those who do not see it.
    fn told(&self, stations: Option<&(Stations<'_>, bool)>) -> String {
        let speed = |value| digits::certain(value, None);
        let place = |s: f64| self.way.abscissa.place(self.way.at(s), 1);
        let peak = speed(self.way.peak());
        let mut sentences = vec![format!("Speed on the path: up to {peak} m/s.")];
        if let Some((stations, _)) = stations {
            if let Some((least, station)) = stations.least_frozen() {
                let (least, at) = (speed(least), place(station.s));
                sentences.push(format!("The frozen critical speed is at least {least} m/s, {at}."));
            }
            if let Some((least, station)) = stations.least_waves() {
                let (least, at) = (speed(least.speed), place(station.s));
                sentences.push(format!("The wave limit is at least {least} m/s, {at}."));
            }
        }
        sentences.extend(of_the_move(self.facts));
        if let Ok(flown) = time::flown(self.facts)
            && let Some(slack) = flown.flight.slack
        {
            sentences.push(format!("Cable {} goes slack at {:.2} s.", slack.cable + 1, slack.time));
        }
        signed(&sentences.join(" "))
    }

    /// What the horizontal axis spans, in m: with the robot's axis all that the winches span.
    fn range(&self, shared: bool) -> [f64; 2] {
        let [low, high] = self.way.range();
        if shared {
            let anchors = || self.facts.document.scenario.cables.iter().map(|cable| cable.anchor[0]);
            return [anchors().fold(low, f64::min), anchors().fold(high, f64::max)];
        }
        let room = 0.03 * (high - low);
        [low - room, high + room]
    }

    /// The highest speed on show, in m/s. Limits far above the speed flown are out of sight.
    fn top(&self, stations: Option<&(Stations<'_>, bool)>) -> f64 {
        let flown = self.way.peak();
        let limits = stations.map_or(0.0, |(stations, _)| {
            let frozen = stations.all.iter().filter_map(|station| Some(station.verdict.critical()?.speed));
            let waves = stations.all.iter().filter_map(|station| Some(station.wave_limit?.speed));
            frozen.chain(waves).fold(0.0, f64::max)
        });
        1.14 * flown.max(limits.min(5.0 * flown)).max(1e-3)
    }
}
