//! The critical speed on several meshes, and what infinitely many elements would give.

use eframe::egui::{Pos2, Role, Sense, Stroke, Ui, WidgetInfo};

use super::chart::{Chart, Dash, Symbol, Titles, inner};
use super::common::{self, PlotPlace};
use super::range::{self, VisibleRange};
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::series::Meshes;
use crate::app::studies::Shown;
use crate::compute::protocol::Topic;
use crate::study::convergence::{Convergence, Extrapolation, NoLimit};

/// What the plot shows, in plain words.
pub const MEANING: &str = "A cable of n elements is a chain of straight pieces. With more of them the critical speed comes \
    nearer to that of a smooth cable. The error falls as 1/n² where a vibration grows, but only as 1/n for a divergence, \
    which the last element before the winch decides. The level line is what Richardson's extrapolation says for n without \
    end, from the order that the finest meshes show and the one that is known; the band around it is how far that may be \
    off.";

/// Draws the plot.
pub fn ui(place: PlotPlace, ui: &mut Ui, facts: Facts<'_>) {
    let Facts { document, designs, .. } = facts;
    let now = document.scenario.elements_per_cable;
    let shown = common::study(Topic::Mesh, facts);
    let Some((Shown { known, current }, meshes)) =
        shown.and_then(|shown| Some((shown, Meshes::new(shown.known, now)?)))
    else {
        common::say(ui, "No answer yet.");
        return;
    };
    let limit = match meshes.limit {
        _ if !known.is_complete() => None,
        Convergence::Limit(limit) => Some(limit),
        Convergence::Unknown(_) => None,
    };
    let finding = match (&meshes.limit, limit) {
        (_, Some(limit)) => Some(error(now, &limit)),
        (&Convergence::Unknown(doubt), _) if known.is_complete() => Some(reason(doubt).to_owned()),
        _ => None,
    };
    if let Some(finding) = &finding {
        common::say(ui, finding);
    }
    let stretches = meshes.stretches();
    if stretches.is_empty() {
        common::say(ui, if known.is_complete() { "No critical speed on any mesh." } else { "No answer yet." });
        return;
    }
    let response = ui.allocate_rect(ui.available_rect_before_wrap(), Sense::click_and_drag());
    let outer = response.rect;
    let titles = Titles { x: Some("elements per cable"), x_unit: None, y: Some("critical speed, m/s") };
    let rect = inner(ui, outer, titles);
    let fit = bounds(&stretches, limit.as_ref(), now);
    let axes = Chart::axes(rect, VisibleRange::of(ui.ctx(), place.id()).bounds(fit, fit));
    let mut chart = Chart::new(ui, outer, rect, axes);
    let tokens = chart.tokens;
    let shade = |colour| if current { colour } else { tokens.mute };
    let words = |colour| if current { colour } else { tokens.weak };
    if let Some(Extrapolation { limit, uncertainty, .. }) = limit {
        chart.band([limit - uncertainty, limit + uncertainty], false, tokens.field);
    }
    chart.grid(titles);
    if let Some(Extrapolation { limit, uncertainty, .. }) = limit {
        chart.level(limit, Stroke::new(1.5, shade(tokens.text)), Dash::Dashed);
        let spots = [0.8, 0.5].map(|part| Pos2::new(rect.left() + part * rect.width(), chart.y.pos(limit)));
        chart.label(format!("limit {}", digits::certain(limit, Some(uncertainty))), words(tokens.text), &spots);
    }
    for (letter, design) in designs.shown() {
        let Some(before) = design.study(Topic::Mesh).and_then(|known| Meshes::new(known, now)) else { continue };
        let colour = letter.colour(ui.visuals());
        for stretch in before.stretches() {
            chart.curve(&stretch, Stroke::new(1.5, colour), Dash::Design(letter));
            if let Some(last) = stretch.last() {
                let spot = chart.pos(*last);
                chart.label(letter.name(), colour, &[spot]);
            }
        }
    }
    for stretch in &stretches {
        chart.curve(stretch, Stroke::new(2.25, shade(tokens.critical)), Dash::Solid);
        for &point in stretch {
            chart.mark(chart.pos(point), Symbol::Dot, 4.0, shade(tokens.critical));
        }
    }
    chart.upright(now as f64, Stroke::new(1.5, tokens.accent), Dash::Dashed);
    let x = chart.x.pos(now as f64);
    let spots = [Pos2::new(x, rect.bottom() - 12.0), Pos2::new(x, rect.top() + 12.0)];
    chart.label(format!("now {now}"), tokens.accent, &spots);
    chart.finish();
    range::turn(ui, &response, place.id(), axes, fit, place.turning([true, true]));

    let points = || stretches.iter().flatten().copied();
    if let Some(pointer) = response.hover_pos().filter(|_| !response.dragged()) {
        let distance = |point: [f64; 2]| chart.pos(point).distance(pointer);
        let nearest = points().min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        if let Some(point) = nearest.filter(|point| distance(*point) < 40.0) {
            chart.mark(chart.pos(point), Symbol::Ring, 7.0, tokens.text);
            let speed = digits::certain(point[1], Some(0.0));
            chart.card(chart.pos(point), &[format!("{:.0} elements", point[0]), format!("critical {speed} m/s")]);
        }
    }
    response.widget_info(|| {
        let list: Vec<String> =
            points().map(|[n, speed]| format!("{} m/s with {n:.0} elements", digits::certain(speed, None))).collect();
        let finding = finding.as_deref().unwrap_or("The limit is not known yet.");
        WidgetInfo::labeled(Role::Image, true, format!("Mesh error: {}. {finding}", list.join(", ")))
    });
}

/// What the meshes span, with the limit and the present mesh.
fn bounds(stretches: &[Vec<[f64; 2]>], limit: Option<&Extrapolation>, now: usize) -> [[f64; 2]; 2] {
    let points = || stretches.iter().flatten();
    let most = points().map(|point| point[0]).fold(now as f64, f64::max);
    let limits =
        limit.map_or(Vec::new(), |limit| vec![limit.limit - limit.uncertainty, limit.limit + limit.uncertainty]);
    let speeds = || points().map(|point| point[1]).chain(limits.iter().copied().filter(|speed| speed.is_finite()));
    let (low, high) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(f64::NEG_INFINITY, f64::max));
    let span = (high - low).max(1e-3 * high.abs()).max(1e-9);
    [[0.0, 1.06 * most], [low - 0.12 * span, high + 0.12 * span]]
}

/// How wrong the present mesh is, in a sentence.
fn error(today: usize, extrapolation: &Extrapolation) -> String {
    let &Extrapolation { limit, error, order, estimated, uncertainty, .. } = extrapolation;
    let order = if estimated {
        format!("order {order:.1} seen")
    } else {
        format!("order {order:.0}, too few meshes to see it")
    };
    let [value, margin] = [digits::certain(limit, Some(uncertainty)), digits::margin(limit, uncertainty)];
    let limit_text = format!("{value} ± {margin} m/s in the limit ({order})");
    let Some(error) = error else {
        return format!("The critical speed is {limit_text}; with {today} elements another mode comes first, or none.");
    };
    let percent = |part: f64| digits::certain(100.0 * part / limit, Some(100.0 * uncertainty / limit));
    if error.abs() <= uncertainty {
        let within = digits::at_most(100.0 * (error.abs() + uncertainty) / limit);
        return format!("With {today} elements the critical speed is right within {within} %: {limit_text}.");
    }
    let way = if error < 0.0 { "low" } else { "high" };
    format!("With {today} elements the critical speed is {} % too {way}: {limit_text}.", percent(error.abs()))
}

/// Why there is no limit, in a sentence.
fn reason(doubt: NoLimit) -> &'static str {
    match doubt {
        NoLimit::NoneCritical => "The finest mesh has no critical speed, so there is no limit to tell.",
        NoLimit::TooFew => "Only one mesh has a critical speed, so its error cannot be told.",
        NoLimit::Changes => "Not yet converging: the finest meshes do not agree on the mode that comes first.",
        NoLimit::Unsettled => {
            "Not yet converging: from mesh to mesh the critical speed changes in no order that is known."
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::convergence::Estimate;

    #[test]
    fn errors_are_told_in_percent_with_their_sign_and_no_more_digits_than_are_certain() {
        let of = |error| told(error, 0.011);
        assert_eq!(
            of(Some(0.253)),
            "With 10 elements the critical speed is 2.3 % too high: 11.00 ± 0.011 m/s in the limit (order 2.0 seen)."
        );
        assert!(of(Some(-0.11)).starts_with("With 10 elements the critical speed is 1.0 % too low: "));
        assert!(of(Some(1e-5)).contains("right within 0.2 %: 11.00 ± 0.011 m/s"), "{}", of(Some(1e-5)));
        assert!(of(None).ends_with("with 10 elements another mode comes first, or none."));
        // Nothing is right to more digits than that.
        assert!(told(Some(0.25), 0.3).contains("right within 5 %: 11.0 ± 0.30 m/s"), "{}", told(Some(0.25), 0.3));
    }

    #[test]
    fn where_meshes_disagree_no_number_is_told() {
        for doubt in [NoLimit::Changes, NoLimit::Unsettled] {
            let text = reason(doubt);
            assert!(text.starts_with("Not yet converging") && !text.contains(|c: char| c.is_ascii_digit()), "{text}");
        }
    }

    fn told(error: Option<f64>, uncertainty: f64) -> String {
        let frequency = Estimate { limit: 1.0, uncertainty: 0.1 };
        super::error(10, &Extrapolation { limit: 11.0, uncertainty, frequency, order: 2.0, estimated: true, error })
    }
}
