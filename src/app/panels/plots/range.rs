//! Which part of a chart is on show, and how wheel, drags and fingers change it.

use eframe::egui::{Context, Id, InputState, Response, Ui, Vec2};

use super::axis::Axis;
use crate::app::gestures;

/// The least and the most that can be shown, as multiples of what matters.
const ZOOM: [f64; 2] = [1e-6, 1e3];

/// Which part of a chart is on show.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum VisibleRange {
    /// What matters.
    #[default]
    Fit,
    /// All there is.
    All,
    /// What a person has chosen: from and to on the horizontal and on the vertical axis.
    Own([[f64; 2]; 2]),
}

impl VisibleRange {
    /// That of the chart with this name.
    pub fn of(context: &Context, chart: Id) -> Self {
        context.data(|data| data.get_temp(chart)).unwrap_or_default()
    }

    /// Makes it that of the chart with this name.
    pub fn show(self, context: &Context, chart: Id) {
        context.data_mut(|data| data.insert_temp(chart, self));
    }

    /// From and to on both axes.
    pub fn bounds(self, fit: [[f64; 2]; 2], all: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        match self {
            Self::Fit => fit,
            Self::All => all,
            Self::Own(bounds) => bounds,
        }
    }
}

/// How a chart may be turned.
#[derive(Clone, Copy, Debug)]
pub struct Turning {
    /// Whether the wheel zooms; else it scrolls what the chart is in.
    pub wheel: bool,
    /// Which axes can be zoomed and panned.
    pub axes: [bool; 2],
}

/// Zooms by wheel and pinch about the pointer, pans by a drag of the mouse or of two fingers, and shows what matters
/// again after a double click. One finger scrolls the page.
pub fn turn(ui: &Ui, response: &Response, chart: Id, axes: [Axis; 2], fit: [[f64; 2]; 2], turning: Turning) {
    gestures::scrolls_or_turns(response);
    if response.double_clicked() {
        VisibleRange::Fit.show(ui.ctx(), chart);
        return;
    }
    let touch = ui.input(InputState::multi_touch).filter(|touch| response.rect.contains(touch.center_pos));
    let fingers = ui.input(InputState::any_touches);
    let moved = match touch {
        Some(touch) => touch.translation_delta,
        None if response.dragged() && !fingers => response.drag_delta(),
        None => Vec2::ZERO,
    };
    let pointer = touch.map(|touch| touch.center_pos).or(response.hover_pos().filter(|_| response.contains_pointer()));
    let wheel = turning.wheel && touch.is_none();
    let factor = ui.input(|input| {
        let wheel = if wheel { (f64::from(input.smooth_scroll_delta().y) / 300.0).exp() } else { 1.0 };
        f64::from(input.zoom_delta()) * wheel
    });
    let zooms = pointer.is_some() && (factor - 1.0).abs() > 1e-9;
    if zooms && wheel {
        // What the chart has taken does not scroll the panel as well.
        ui.input_mut(|input| input.smooth_scroll_delta = Vec2::ZERO);
    }
    if !zooms && moved == Vec2::ZERO {
        return;
    }
    let mut bounds = axes.map(|axis| axis.range);
    let factor = if zooms { factor } else { 1.0 };
    for (i, axis) in axes.iter().enumerate().filter(|(i, _)| turning.axes[*i]) {
        let range = turned(axis, pointer.map(|pointer| pointer[i]), factor, moved[i]);
        let part = (range[1] - range[0]) / (fit[i][1] - fit[i][0]);
        if (ZOOM[0]..=ZOOM[1]).contains(&part) {
            bounds[i] = range;
        }
    }
    VisibleRange::Own(bounds).show(ui.ctx(), chart);
}

/// What an axis shows once it has been magnified about a point of the screen, and moved by `moved` points.
fn turned(axis: &Axis, fixed: Option<f32>, factor: f64, moved: f32) -> [f64; 2] {
    #[expect(clippy::cast_possible_truncation)] // Screen coordinates are f32.
    let scale = (1.0 / factor) as f32;
    axis.ends.map(|end| {
        let fixed = fixed.unwrap_or(end);
        axis.value(fixed + (end - fixed) * scale - moved)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_under_the_pointer_stays_there() {
        let axis = Axis::linear([-10.0, 10.0], [100.0, 500.0]);
        let near = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
        // At 400 points is 5.
        assert!(near(turned(&axis, Some(400.0), 2.0, 0.0), [-2.5, 7.5]));
        assert!(near(turned(&axis, Some(400.0), 0.5, 0.0), [-25.0, 15.0]));
        // A drag to the right shows more of what is on the left; upward on the screen y falls.
        assert!(near(turned(&axis, None, 1.0, 40.0), [-12.0, 8.0]));
        let upward = Axis::linear([0.0, 10.0], [300.0, 100.0]);
        assert!(near(turned(&upward, None, 1.0, 20.0), [1.0, 11.0]));
    }

    #[test]
    fn a_range_is_remembered_until_it_is_fitted() {
        let (context, chart) = (Context::default(), Id::unique("a chart"));
        let (fit, all) = ([[0.0, 1.0]; 2], [[0.0, 9.0]; 2]);
        assert_eq!(VisibleRange::of(&context, chart).bounds(fit, all), fit);
        VisibleRange::All.show(&context, chart);
        assert_eq!(VisibleRange::of(&context, chart).bounds(fit, all), all);
        let own = [[0.2, 0.4], [0.1, 0.3]];
        VisibleRange::Own(own).show(&context, chart);
        assert_eq!(VisibleRange::of(&context, chart).bounds(fit, all), own);
        VisibleRange::Fit.show(&context, chart);
        assert_eq!(VisibleRange::of(&context, chart), VisibleRange::Fit);
    }
}
