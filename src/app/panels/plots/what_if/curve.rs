//! Critical speed and frequency against one number.

use eframe::egui::{Align2, CursorIcon, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo};

use super::super::axis::{Axis, signed};
use super::super::chart::{self, Chart, Dash, Titles, inner};
use super::super::common::{self, PlotPlace, Slot};
use super::drawing;
use super::numbers::{Number, name};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::series::Against;
use crate::app::studies::Shown;
use crate::app::theme;
use crate::app::what_if::{Range, WhatIfView};
use crate::compute::protocol::Topic;
use crate::stability::{Critical, Instability};
use crate::study::Verdict;

/// So high both plots are together at least, in points, or the lower one is left out.
const BOTH: f32 = 170.0;
/// The least part of a range that is left where a hand pushes its ends together.
const NARROWEST: f64 = 0.02;
/// Half of a handle's width and its height, in points.
const HANDLE: Vec2 = Vec2::new(4.0, 16.0);

/// Draws the plot.
pub fn ui(
    place: PlotPlace,
    view: &mut WhatIfView,
    number: &Number,
    shown: Shown<'_>,
    ui: &mut Ui,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let Some(against) = Against::new(shown.known) else { return };
    let mut number = *number;
    let drag = place.id().with("range that is dragged");
    if let Some(ends) = ui.data(|data| data.get_temp::<[f64; 2]>(drag)) {
        number.range.ends = ends;
    }
    let drawing = Drawing { against: &against, number: &number, current: shown.current, facts };
    // A line in any case, so that nothing moves when it is known.
    let waits = if shown.current { "No critical speed is known here." } else { "Being computed." };
    common::say(ui, drawing.finding().as_deref().unwrap_or(waits));
    let response = drawing::room(ui);
    let x = drawing.ui(ui, &response, commands);
    if place.slot == Slot::Picture {
        return;
    }
    handles(place, view, &number, &x, ui, &response, drag);
}

/// What is drawn.
struct Drawing<'a> {
    against: &'a Against,
    number: &'a Number,
    current: bool,
    facts: Facts<'a>,
}

impl Drawing<'_> {
    /// Draws it within `response`, and gives the horizontal axis.
    fn ui(&self, ui: &Ui, response: &Response, commands: &mut Vec<Command>) -> Axis {
        let Self { against, number, facts, .. } = self;
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, self.told()));
        let outer = response.rect;
        let title = number.title();
        let titles = Titles { x: Some(&title), x_unit: None, y: Some("m/s") };
        let room = inner(ui, outer, titles);
        let both = room.height() >= BOTH;
        let x = number.axis([room.left(), room.right()]);
        let between = 1.1 * chart::font(ui).size;
        let height = if both { (room.height() - between) * 2.0 / 3.0 } else { room.height() };
        let upper = room.with_max_y(room.top() + height);
        let above = if both { Titles { x: None, ..titles } } else { titles };
        let mut speeds = self.speeds(ui, outer, upper, x, above);
        let mut hertz = both.then(|| self.frequencies(ui, outer, room.with_min_y(upper.bottom() + between), x, titles));
        let value = |pos: f32| number.field.unit().to_stored(x.value(pos));
        let nearest = response.hover_pos().and_then(|pointer| against.nearest(value(pointer.x)));
        if let Some(i) = nearest {
            let stroke = Stroke::new(1.0, speeds.tokens.mute);
            for chart in [Some(&mut speeds), hertz.as_mut()].into_iter().flatten() {
                chart.upright(number.shown(against.points[i].0), stroke, Dash::Solid);
            }
        }
        drawing::now(&mut speeds, number);
        if let Some(hertz) = &mut hertz {
            let at = number.shown(number.value);
            hertz.upright(at, Stroke::new(1.5, hertz.tokens.accent), Dash::Dashed);
        }
        if let Some(critical) = self.here() {
            let at = speeds.pos([number.shown(number.value), critical.speed]);
            speeds.painter.circle_filled(at, 6.0, speeds.tokens.panel);
            speeds.painter.circle_filled(at, 4.5, speeds.tokens.critical);
        }
        speeds.finish();
        if let Some(hertz) = &mut hertz {
            hertz.finish();
        }
        if let Some(i) = nearest {
            let (at, verdict) = &against.points[i];
            let speed = verdict.critical().map_or(0.0, |critical| critical.speed);
            speeds.card(speeds.pos([number.shown(*at), speed]), &self.reading(i));
        }
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) {
            let mut scenario = facts.document.scenario.clone();
            number.field.parameter.set(&mut scenario, number.meant(&x, pointer.x));
            commands.push(Command::Edit(Box::new(scenario)));
        }
        x
    }

    fn speeds(&self, ui: &Ui, outer: Rect, rect: Rect, x: Axis, titles: Titles<'_>) -> Chart {
        let Self { against, number, current, facts } = self;
        let points =
            |run: &[[f64; 2]]| -> Vec<[f64; 2]> { run.iter().map(|&[at, speed]| [number.shown(at), speed]).collect() };
        let designs = facts.designs.shown();
        let before: Vec<_> = designs
            .filter_map(|(letter, design)| Some((letter, Against::new(design.study(Topic::WhatIf)?)?)))
            .collect();
        let all = |against: &Against| against.extremes().map_or(0.0, |[_, highest]| highest[1]);
        let highest = before.iter().map(|(_, before)| all(before)).fold(all(against), f64::max);
        let top = 1.14 * highest.max(1e-3);
        let mut chart = Chart::new(ui, outer, rect, [x, Axis::linear([0.0, top], [rect.bottom(), rect.top()])]);
        let tokens = chart.tokens;
        let shade = |colour| if *current { colour } else { tokens.mute };
        self.hatch(&chart);
        for run in against.critical() {
            chart.area(&points(&run), shade(tokens.stable).gamma_multiply(0.09));
        }
        chart.grid(titles);
        for (letter, before) in &before {
            let stroke = Stroke::new(1.5, letter.colour(ui.visuals()));
            for run in before.speeds() {
                chart.curve(&points(&run), stroke, Dash::Design(*letter));
            }
        }
        for run in against.speeds() {
            chart.curve(&points(&run), Stroke::new(2.25, shade(tokens.critical)), Dash::Solid);
        }
        if against.extremes().is_none() {
            chart.label_at("no critical speed here", tokens.weak, rect.center(), Align2::CENTER_CENTER);
        }
        chart
    }

    fn frequencies(&self, ui: &Ui, outer: Rect, rect: Rect, x: Axis, titles: Titles<'_>) -> Chart {
        let Self { against, number, current, facts } = self;
        let (hertz, unit) = facts.settings.hertz();
        let stretches = against.stretches(|critical| critical.frequency_hz() * hertz);
        let highest = stretches.iter().flatten().map(|point| point[1]).fold(0.0, f64::max);
        let top = if highest > 0.0 { 1.25 * highest } else { hertz };
        let mut chart = Chart::new(ui, outer, rect, [x, Axis::linear([0.0, top], [rect.bottom(), rect.top()])]);
        let colour = if *current { chart.tokens.critical } else { chart.tokens.mute };
        self.hatch(&chart);
        chart.grid(Titles { y: Some(unit), ..titles });
        for run in stretches {
            let points: Vec<[f64; 2]> = run.iter().map(|&[at, value]| [number.shown(at), value]).collect();
            chart.curve(&points, Stroke::new(2.0, colour), Dash::Solid);
        }
        chart
    }

    fn hatch(&self, chart: &Chart) {
        for gap in self.against.gaps() {
            chart.hatch(gap.map(|end| self.number.shown(end)));
        }
    }

    /// The critical speed at the present value: that of the pose itself, where it is known.
    fn here(&self) -> Option<&Critical> {
        let Self { number, facts, current, .. } = self;
        let [low, high] = number.range.ends;
        let shown = facts.answers.last_critical().filter(|_| *current && !facts.answers.pose_failed())?;
        shown.critical.as_ref().filter(|_| (low..=high).contains(&number.value))
    }

    /// What is known at a place, in a line or two.
    fn reading(&self, i: usize) -> Vec<String> {
        let Self { against, number, facts, .. } = self;
        let (at, verdict) = &against.points[i];
        let at_value = format!("{} = {}", number.field.symbol, number.text(*at));
        if let Some([first, second]) = reading(verdict, *facts) {
            vec![format!("{at_value}: {first}"), second]
        } else {
            let reason = number.refused(*at, *facts).unwrap_or_else(|| "could not be computed".into());
            vec![at_value, signed(&reason)]
        }
    }

    /// What is to be seen, in a sentence, once all is known.
    fn finding(&self) -> Option<String> {
        let Self { against, number, facts, current } = self;
        if !current {
            return None;
        }
        let [low, high] = against.extremes()?;
        let speed = |at: [f64; 2]| digits::like(at[1], facts.share());
        let (low_speed, high_speed) = (speed(low), speed(high));
        if low_speed == high_speed {
            return Some(format!("The critical speed stays at {low_speed} m/s all along."));
        }
        let [low, high] = [low[0], high[0]].map(|value| number.text(value));
        Some(format!("Critical from {low_speed} m/s at {low} to {high_speed} m/s at {high}."))
    }

    /// The plot in a sentence, for those who do not see it.
    fn told(&self) -> String {
        let Self { against, number, .. } = self;
        let [from, to] = against.range.map(|end| number.text(end));
        let finding = self.finding().unwrap_or_else(|| "No critical speed is known yet.".into());
        let here = against.nearest(number.value).map(|i| self.reading(i).join(", ")).unwrap_or_default();
        let gaps: Vec<String> = against
            .gaps()
            .iter()
            .map(|gap| {
                let [left, right] = gap.map(|end| number.text(end));
                format!("from {left} to {right}")
            })
            .collect();
        let gaps = if gaps.is_empty() {
            String::new()
        } else {
            format!(" No equilibrium or not allowed {}.", gaps.join(" and "))
        };
        format!("What if: {} from {from} to {to}. {finding} Near the present value: {here}.{gaps}", name(&number.field))
    }
}

/// A verdict in two lines; `None` where nothing is known.
pub fn reading(verdict: &Verdict, facts: Facts<'_>) -> Option<[String; 2]> {
    Some(match verdict {
        Verdict::Infeasible => ["no equilibrium".into(), "A cable would have to push.".into()],
        Verdict::Unknown | Verdict::NotConverged => return None,
        Verdict::NoneUpTo(limit) => ["no critical speed".into(), format!("Stable up to {limit} m/s.")],
        Verdict::Critical(critical) => {
            let speed = digits::like(critical.speed, facts.share());
            let kind = match critical.kind {
                Instability::Flutter => {
                    format!("flutter {}", facts.settings.frequency_text(critical.frequency_hz(), None))
                }
                Instability::Divergence => "divergence".into(),
            };
            [format!("critical {speed} m/s"), format!("{kind}, cable {}", critical.cable + 1)]
        }
    })
}

/// The handles at both ends of the horizontal axis. While one is dragged the range is kept apart, under `drag`, and the
/// study begins once it is let go.
fn handles(
    place: PlotPlace,
    view: &mut WhatIfView,
    number: &Number,
    x: &Axis,
    ui: &mut Ui,
    response: &Response,
    drag: eframe::egui::Id,
) {
    let parameter = number.field.parameter;
    let tokens = theme::tokens(ui.visuals());
    let bottom = response.rect.bottom() - 3.1 * chart::font(ui).size;
    let reach = ui.spacing().interact_size.y.max(24.0);
    for (i, word) in ["Lower", "Upper"].into_iter().enumerate() {
        let at = Pos2::new(x.ends[i], bottom);
        let handle = ui.interact(Rect::from_center_size(at, Vec2::splat(reach)), place.id().with(word), Sense::DRAG);
        let handle = handle.on_hover_cursor(CursorIcon::ResizeHorizontal);
        let label = format!("{word} end of the range of {}", name(&number.field));
        handle.widget_info(|| WidgetInfo::slider(true, number.shown(number.range.ends[i]), &label));
        let colour = if handle.hovered() || handle.dragged() { tokens.accent } else { tokens.weak };
        let drawn = Rect::from_center_size(at, Vec2::new(2.0 * HANDLE.x, HANDLE.y));
        ui.painter().rect_filled(drawn, 3.0, tokens.panel);
        ui.painter().rect_stroke(drawn, 3.0, Stroke::new(1.5, colour), StrokeKind::Inside);
        if handle.dragged()
            && let Some(first) = view.range(parameter)
            && let Some((origin, pointer)) =
                ui.input(|input| input.pointer.press_origin().zip(input.pointer.interact_pos()))
        {
            let moved = pointer.x - origin.x;
            let before = Number { range: first, ..*number };
            let axis = before.axis(x.ends);
            let mut ends = first.ends;
            let room = NARROWEST * (ends[1] - ends[0]);
            let value = number.meant(&axis, axis.ends[i] + moved);
            ends[i] = if i == 0 { value.min(ends[1] - room) } else { value.max(ends[0] + room) };
            if ends.iter().all(|end| end.is_finite()) {
                ui.data_mut(|data| data.insert_temp(drag, ends));
            }
        }
        if handle.drag_stopped()
            && let Some(ends) = ui.data_mut(|data| data.remove_temp::<[f64; 2]>(drag))
        {
            view.set_range(parameter, Range { ends, own: true });
        }
        if !handle.dragged() {
            handle.explained(format!("{label}: drag it, or type it above."));
        }
    }
}
