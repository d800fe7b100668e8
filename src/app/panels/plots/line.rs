//! Critical speed and frequency along the motion: the paper's Fig. 3, under the robot on its own horizontal axis.

use eframe::egui::{Align2, Pos2, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo};

use super::axis::{Axis, signed};
use super::chart::{self, Chart, Dash, Titles};
use super::common::{self, PlotPlace, Slot};
use super::range::{self, VisibleRange};
use crate::app::canvas::View;
use crate::app::command::Command;
use crate::app::designs::Letter;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::round::roundest;
use crate::app::series::{Abscissa, Along};
use crate::app::settings::Settings;
use crate::compute::protocol::Topic;
use crate::stability::{Critical, Instability};
use crate::study::Verdict;

/// So high both plots are together at least, in points, or the lower one is left out.
const BOTH: f32 = 120.0;

/// What the plot shows, in plain words.
pub fn meaning(facts: Facts<'_>) -> String {
    let findings = shown(facts).filter(|(_, current)| *current).and_then(|(along, _)| along.findings());
    format!(
        "The platform passes every point of the straight line on which it moves. Above: the speed at which a vibration \
         would begin to grow there, and dotted the wave limit, where a cable flows as fast as its waves. Below: that \
         vibration's frequency; divergence has none. The upper curve breaks where it jumps, the lower one where another \
         mode comes first; hatched, there is no equilibrium. Click to move the platform there. {}",
        signed(&findings.unwrap_or_default())
    )
}

/// The study on show and whether it is of the present line.
fn shown(facts: Facts<'_>) -> Option<(Along, bool)> {
    let shown = common::study(Topic::Line, facts)?;
    Some((Along::new(shown.known)?, shown.current))
}

/// Draws the plots in all the room there is. With a `view`, and where the motion is horizontal, they are on its axis.
pub fn ui(place: PlotPlace, view: Option<&View>, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Some((along, current)) = shown(facts) else {
        common::say(ui, "The study along the line has no answer yet.");
        return;
    };
    // Those who have no room for them find them in the explanation.
    if !place.slot.is_under_the_robot()
        && !matches!(place.slot, Slot::Sheet | Slot::Picture)
        && current
        && let Some(findings) = along.findings()
    {
        common::say(ui, &signed(&findings).replace(" = ", "\u{a0}=\u{a0}"));
    }
    let response = ui.allocate_rect(ui.available_rect_before_wrap(), Sense::click_and_drag());
    let drawing = Drawing { along: &along, current, facts, settings: facts.settings };
    let view = view.filter(|_| place.slot.is_under_the_robot() && along.abscissa == Abscissa::X);
    drawing.ui(Some(place), view, ui, &response, commands);
}

/// Draws the study along the line as a mere strip under the robot: without a header, and with the critical speed alone.
pub fn strip(ui: &mut Ui, rect: Rect, view: &View, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Some((along, current)) = shown(facts) else { return };
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    let drawing = Drawing { along: &along, current, facts, settings: facts.settings };
    drawing.ui(None, Some(view).filter(|_| along.abscissa == Abscissa::X), ui, &response, commands);
}

/// What is drawn.
struct Drawing<'a> {
    along: &'a Along,
    current: bool,
    facts: Facts<'a>,
    settings: Settings,
}

impl Drawing<'_> {
    /// Draws it within `response`; without a place it is the strip.
    fn ui(
        &self,
        place: Option<PlotPlace>,
        view: Option<&View>,
        ui: &Ui,
        response: &Response,
        commands: &mut Vec<Command>,
    ) {
        let Self { along, facts, .. } = self;
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, self.told()));
        let outer = response.rect;
        let size = chart::font(ui).size;
        // On the screen the curves say what they are; a picture has titles at its axes, too.
        let alone = place.is_some_and(|place| place.slot == Slot::Picture);
        let frequency = format!("frequency, {}", self.settings.hertz().1);
        let title = |text| Some(text).filter(|_| alone);
        let titles = Titles {
            x: title(self.along.abscissa.title()),
            x_unit: Some("m").filter(|_| !alone),
            y: title(frequency.as_str()),
        };
        let of_speeds = Titles { y: title("critical speed, m/s"), ..titles };
        let mut room = chart::inner(ui, outer, titles);
        let both = place.is_some() && room.height() >= BOTH;
        let id = place.map(PlotPlace::id);
        let x = match (view, id) {
            (Some(view), _) => {
                // The same points of the screen as the robot has.
                let ends = along.range.map(|at| view.pos_in_ui([at, 0.0]).x);
                room.min.x = ends[0].clamp(room.left(), room.right() - 1.0);
                room.max.x = ends[1].clamp(room.left() + 1.0, room.right());
                Axis::linear(along.range, ends)
            }
            (None, Some(id)) => {
                let fit = [along.range, [0.0, 1.0]];
                let [range, _] = VisibleRange::of(ui.ctx(), id).bounds(fit, fit);
                Axis::linear(range, [room.left(), room.right()])
            }
            (None, None) => Axis::linear(along.range, [room.left(), room.right()]),
        };
        let between = 1.1 * size;
        let height = if both { (room.height() - between) * 2.0 / 3.0 } else { room.height() };
        let upper = room.with_max_y(room.top() + height);
        let now = along.place(facts.document.scenario.motion.position);
        let mut speeds = self.speeds(
            ui,
            outer,
            upper,
            x,
            if both { Titles { y: of_speeds.y, ..Titles::default() } } else { of_speeds },
        );
        let mut hertz = both.then(|| {
            let lower = room.with_min_y(upper.bottom() + between);
            self.frequencies(ui, outer, lower, x, titles)
        });

        let reading = response.hover_pos().filter(|_| !response.dragged()).map(|pointer| x.value(pointer.x));
        let nearest = reading.and_then(|at| along.nearest(at));
        if let Some(i) = nearest {
            let at = along.points[i].0;
            let stroke = Stroke::new(1.0, speeds.tokens.mute);
            for chart in [Some(&mut speeds), hertz.as_mut()].into_iter().flatten() {
                chart.upright(at, stroke, Dash::Solid);
            }
        }
        let pose_line = Stroke::new(1.5, speeds.tokens.accent);
        if room.x_range().expand(0.5).contains(x.pos(now)) {
            // From the robot, or from the top, to the bottom.
            let line = vec![Pos2::new(x.pos(now), outer.top()), Pos2::new(x.pos(now), room.bottom())];
            chart::draw_line(&ui.painter_at(outer), line, pose_line, Dash::Dashed);
        }
        let hertz_of = |critical: &Critical| critical.frequency_hz() * self.settings.hertz().0;
        if let Some(critical) = self.here() {
            let dot = |chart: &Chart, value: f64, radius: f32| {
                chart.painter.circle_filled(chart.pos([now, value]), radius + 1.5, chart.tokens.panel);
                chart.painter.circle_filled(chart.pos([now, value]), radius, chart.tokens.critical);
            };
            dot(&speeds, critical.speed, 4.5);
            if let Some(hertz) = hertz.as_ref().filter(|_| critical.frequency_hz() > 0.0) {
                dot(hertz, hertz_of(critical), 3.0);
            }
        }
        speeds.finish();
        if let Some(hertz) = &mut hertz {
            hertz.finish();
        }
        if let Some(i) = nearest {
            let value = along.points[i].1.critical().map_or(0.0, |critical| critical.speed);
            speeds.card(speeds.pos([along.points[i].0, value]), &self.reading(i));
        }
        if let (None, Some(place)) = (view, place) {
            let fit = [along.range, [0.0, 1.0]];
            let axes = [x, Axis::linear([0.0, 1.0], [upper.bottom(), upper.top()])];
            range::turn(ui, response, place.id(), axes, fit, place.turning([true, false]));
        } else {
            crate::app::gestures::scrolls_or_turns(response);
        }
        // On the robot's axis a drag takes the platform along; on an axis of its own it moves the axis.
        let taken = response.clicked() || (view.is_some() && response.dragged());
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| taken) {
            let at = roundest(x.value(pointer.x), x.per_point()).clamp(along.range[0], along.range[1]);
            let mut scenario = facts.document.scenario.clone();
            scenario.motion.position = along.moved(scenario.motion.position, at);
            commands.push(Command::Edit(Box::new(scenario)));
        }
    }

    /// The upper plot: critical speed, wave limit, and the speed now.
    fn speeds(&self, ui: &Ui, outer: Rect, rect: Rect, x: Axis, titles: Titles<'_>) -> Chart {
        let Self { along, current, facts, .. } = self;
        let now = facts.document.scenario.motion.speed;
        let (critical, waves) = (along.critical(), along.waves());
        let highest = |runs: &[Vec<[f64; 2]>]| runs.iter().flatten().map(|point| point[1]).fold(0.0, f64::max);
        let of_critical = highest(&critical).max(1e-3);
        // Waves may be far above all else.
        let top = 1.14 * of_critical.max(highest(&waves).min(1.3 * of_critical)).max(now.min(3.0 * of_critical));
        let mut chart = Chart::new(ui, outer, rect, [x, Axis::linear([0.0, top], [rect.bottom(), rect.top()])]);
        let tokens = chart.tokens;
        // Grey is what belongs to an earlier state. The study does not depend on where on the line the pose is. So it
        // stays current, and keeps its colours, where the pose has no equilibrium.
        let shade = |colour| if *current { colour } else { tokens.mute };
        let words = |colour| if *current { colour } else { tokens.weak };
        self.hatch(&chart);
        for run in &critical {
            chart.area(run, shade(tokens.stable).gamma_multiply(0.09));
        }
        chart.grid(titles);
        for run in &waves {
            chart.curve(run, Stroke::new(1.75, shade(tokens.waves)), Dash::Dotted);
        }
        for (letter, before) in self.kept() {
            let colour = letter.colour(ui.visuals());
            for stretch in before.speeds() {
                chart.curve(&stretch, Stroke::new(1.5, colour), Dash::Design(letter));
            }
            label_curve(&mut chart, letter.name(), colour, &before.critical());
        }
        for stretch in along.speeds() {
            chart.curve(&stretch, Stroke::new(2.25, shade(tokens.critical)), Dash::Solid);
        }
        chart.level(now, Stroke::new(1.5, shade(tokens.accent)), Dash::Dashed);
        let at = along.place(facts.document.scenario.motion.position);
        let here = along.nearest(at).and_then(|i| along.points.get(i));
        if let Some(critical) = self.here() {
            let point = chart.pos([at, critical.speed]);
            chart.keep_free(point, 7.0);
        } else if here.is_some_and(|(_, verdict)| *verdict == Verdict::Infeasible) && *current {
            chart.label("no equilibrium", tokens.weak, &[Pos2::new(chart.x.pos(at), rect.top() + 14.0)]);
        }
        let spots = [0.65, 0.3, 0.85, 0.12].map(|part| Pos2::new(rect.left() + part * rect.width(), chart.y.pos(now)));
        // Above its line or below, not at its ends.
        chart.label(format!("now {now:.2}"), words(tokens.accent), &spots);
        label_curve(&mut chart, "critical, m/s", words(tokens.critical), &critical);
        label_curve(&mut chart, "waves", words(tokens.waves), &waves);
        if critical.is_empty() {
            let text = if along.points.iter().all(|(_, verdict)| *verdict == Verdict::Infeasible) {
                "no equilibrium on this line"
            } else {
                "no critical speed on this line"
            };
            chart.label_at(text, tokens.weak, rect.center(), Align2::CENTER_CENTER);
        }
        chart
    }

    /// The lower plot: the frequency at the critical speed.
    fn frequencies(&self, ui: &Ui, outer: Rect, rect: Rect, x: Axis, titles: Titles<'_>) -> Chart {
        let Self { along, current, settings, .. } = self;
        let (hertz, unit) = settings.hertz();
        let value = |critical: &Critical| critical.frequency_hz() * hertz;
        let all =
            || along.points.iter().filter_map(|(_, verdict)| verdict.critical()).map(value).filter(|hz| *hz > 0.0);
        let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
        let [low, high] = if low < high { [0.75 * low, 1.35 * high] } else { [0.1 * hertz, 10.0 * hertz] };
        let y = Axis { range: [low, high], ends: [rect.bottom(), rect.top()], logarithmic: true };
        let mut chart = Chart::new(ui, outer, rect, [x, y]);
        let tokens = chart.tokens;
        let colour = if *current { tokens.critical } else { tokens.mute };
        self.hatch(&chart);
        chart.grid(titles);
        // A divergence does not oscillate: it lies on the bottom.
        let floor = chart.y.value(rect.bottom() - 1.5);
        let mut diverges = false;
        for stretch in along.stretches(value) {
            diverges |= stretch.iter().any(|point| point[1] < low);
            let stretch: Vec<[f64; 2]> = stretch.iter().map(|&[at, hz]| [at, hz.max(floor)]).collect();
            chart.curve(&stretch, Stroke::new(2.0, colour), Dash::Solid);
        }
        for (letter, before) in self.kept() {
            let stroke = Stroke::new(1.5, letter.colour(ui.visuals()));
            for stretch in before.stretches(value) {
                chart.curve(&stretch, stroke, Dash::Design(letter));
            }
        }
        let corner = Pos2::new(rect.left() + 0.06 * rect.width(), rect.top() + 0.4 * rect.height());
        chart.label_at(unit, tokens.weak, corner, Align2::CENTER_CENTER);
        if diverges {
            let at = Pos2::new(rect.right() - 2.0, rect.bottom() - 4.0);
            chart.label_at("bottom: divergence", tokens.weak, at, Align2::RIGHT_BOTTOM);
        }
        chart
    }

    /// The critical speed at the present pose, where the line goes through it.
    fn here(&self) -> Option<&Critical> {
        let Self { along, facts, current, .. } = self;
        let at = along.place(facts.document.scenario.motion.position);
        let on_the_line = along.points.get(along.nearest(at)?)?.1.critical().filter(|_| *current)?;
        // That of the pose itself, rather than of a place near it.
        let shown = facts.answers.last_critical().and_then(|answer| answer.critical.as_ref());
        Some(shown.filter(|_| !facts.answers.pose_failed()).unwrap_or(on_the_line))
    }

    fn hatch(&self, chart: &Chart) {
        for stretch in self.along.infeasible() {
            chart.hatch(stretch);
        }
    }

    /// The same of the kept designs.
    fn kept(&self) -> impl Iterator<Item = (Letter, Along)> {
        let shown = self.facts.designs.shown();
        shown.filter_map(|(letter, design)| Some((letter, Along::new(design.study(Topic::Line)?)?)))
    }

    /// What is known at a place, in a line or two.
    fn reading(&self, i: usize) -> Vec<String> {
        let (at, verdict) = &self.along.points[i];
        let at = signed(&self.along.abscissa.place(*at, 2));
        let waves = self.along.wave_limits.get(i).copied().flatten();
        let waves = waves.map_or_else(String::new, |limit| format!("waves {} m/s", digits::like(limit, None)));
        let join = |text: String| if waves.is_empty() { text } else { format!("{text}; {waves}") };
        let lines = match verdict {
            Verdict::Infeasible => vec![format!("{at}: no equilibrium")],
            Verdict::Unknown | Verdict::NotConverged => vec![format!("{at}: not known")],
            Verdict::NoneUpTo(limit) => vec![format!("{at}: stable up to {limit} m/s"), waves],
            Verdict::Critical(critical) => {
                let speed = digits::like(critical.speed, self.facts.share());
                let kind = match critical.kind {
                    Instability::Flutter => {
                        format!("flutter {}", self.settings.frequency_text(critical.frequency_hz(), None))
                    }
                    Instability::Divergence => "divergence".into(),
                };
                vec![format!("{at}: critical {speed} m/s"), join(format!("{kind}, cable {}", critical.cable + 1))]
            }
        };
        lines.into_iter().filter(|line| !line.is_empty()).collect()
    }

    /// The plot in a sentence, for those who do not see it.
    fn told(&self) -> String {
        let Self { along, facts, current, .. } = self;
        let at = along.place(facts.document.scenario.motion.position);
        let here = along.nearest(at).map(|i| self.reading(i).join(", ")).unwrap_or_default();
        let speeds =
            || along.points.iter().filter_map(|(_, verdict)| verdict.critical()).map(|critical| critical.speed);
        let [low, high] = [speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max)]
            .map(|speed| digits::like(speed, facts.share()));
        let range = if speeds().next().is_some() {
            format!("Along the line: the critical speed is between {low} and {high} m/s")
        } else {
            "Along the line: no critical speed".into()
        };
        let [from, to] = along.range;
        let gaps: Vec<String> = along
            .infeasible()
            .iter()
            .map(|&[left, right]| {
                let [left, right] = [left, right].map(|at| signed(&along.abscissa.place(at, 1)));
                format!("from {left} to {right}")
            })
            .collect();
        let gaps = if gaps.is_empty() { String::new() } else { format!(" No equilibrium {}.", gaps.join(" and ")) };
        let findings =
            along.findings().filter(|_| *current).map_or_else(String::new, |found| format!(" {}", signed(&found)));
        let [from, to] = [from, to].map(|at| signed(&along.abscissa.place(at, 1)));
        format!("{range}, from {from} to {to}. Here: {here}.{gaps}{findings}")
    }
}

/// Writes a curve's name where it covers least.
pub(super) fn label_curve(chart: &mut Chart, name: &str, colour: eframe::egui::Color32, runs: &[Vec<[f64; 2]>]) {
    let Some(longest) = runs.iter().max_by_key(|run| run.len()) else { return };
    let spots: Vec<Pos2> = [0.5, 0.3, 0.7, 0.4, 0.6, 0.25, 0.75, 0.2, 0.8, 0.35, 0.65, 0.1, 0.9]
        .into_iter()
        .filter_map(|part| {
            // A part of a list's length.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let i = (part * longest.len() as f64) as usize;
            longest.get(i).map(|&point| chart.pos(point))
        })
        .filter(|at| chart.rect.contains(*at))
        .collect();
    chart.label(name, colour, &spots);
}
