//! The map's contours on the screen, each with its value on it.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, Vec2, Visuals};

use super::contours::{Field, Polyline};
use super::paint::polyline;
use super::picture::Picture;
use crate::app::canvas::View;
use crate::app::round::round_step;
use crate::app::state::MapQuantity;
use crate::app::theme;

/// The step of contours of speeds in m/s, where it makes neither too few nor too many.
const SPEED_STEP: f64 = 4.0;
const SPEEDS: std::ops::RangeInclusive<f64> = 6.0..=40.0;
/// So many passes of a filter make contours calm.
const SMOOTHING: usize = 2;
/// About how many contours other quantities have.
const CONTOURS: f64 = 5.0;
/// A label keeps this far from lines and from other labels, in points.
const CLEAR: f32 = 5.0;
/// More room than this, in points, makes no place for a label better.
const AMPLE: f32 = 24.0;
/// A contour has a label where it is this many times as long.
const LONG_ENOUGH: f32 = 2.0;

/// What labels keep clear of, on the screen.
#[derive(Clone, Debug, Default)]
pub struct Taken {
    /// Lines, such as cables.
    pub lines: Vec<Vec<Pos2>>,
    /// Areas, such as cards.
    pub areas: Vec<Rect>,
}

/// The contours of a map.
#[derive(Default)]
pub struct Lines {
    field: Option<Field>,
    contours: Vec<Contour>,
    /// At the present speed, or where growth begins.
    bold: Option<Contour>,
}

/// The lines of one value.
struct Contour {
    level: f64,
    text: String,
    lines: Vec<Polyline>,
    /// By line: the corner that has the label, so that it stays where it is.
    labels: Vec<Option<usize>>,
}

impl Contour {
    fn new(level: f64, text: String, lines: Vec<Polyline>) -> Self {
        Self { level, text, labels: vec![None; lines.len()], lines }
    }
}

impl Lines {
    /// Makes the contours of a picture, whose numbers are shown times `unit`.
    pub fn renew(&mut self, picture: Option<&Picture>, unit: f64) {
        *self = Self::default();
        let Some((picture, field)) = picture.and_then(|picture| Some((picture, picture.field(SMOOTHING)?))) else {
            return;
        };
        let Some([low, high]) = picture.found else { return };
        // Of growth rates, what lies beyond the end of the range has no colours either.
        let high = picture.range.map_or(high, |range| high.min(range[1].max(low)));
        let width = (high - low) * unit;
        let of_speeds = matches!(picture.quantity, MapQuantity::Speed | MapQuantity::Waves);
        let step = if of_speeds && SPEEDS.contains(&width) { SPEED_STEP } else { round_step(width / CONTOURS) };
        if !(step > 0.0 && step.is_finite()) {
            return;
        }
        let growth = picture.quantity == MapQuantity::Growth;
        let level = |level: f64| {
            let shown = level * unit;
            let whole = (shown / step - (shown / step).round()).abs() < 1e-6;
            let decimals = decimals(if whole { step } else { 0.5 * step });
            // No minus before zero.
            Contour::new(level, format!("{:.decimals$}", shown + 0.0), field.contour(level))
        };
        let levels = field.levels(step / unit, [low, high]).into_iter().filter(|at| !growth || *at != 0.0);
        self.contours = levels.map(level).collect();
        if growth {
            // As exact as the values are: growth begins all of a sudden, and a filter would move where.
            self.bold = picture.field(0).map(|exact| Contour::new(0.0, "0".into(), exact.contour(0.0)));
        }
        self.field = Some(field);
    }

    /// Makes the contour at the present speed, of a map whose values are speeds.
    pub fn at_speed(&mut self, speed: f64) {
        let known = self.bold.as_ref().is_some_and(|bold| bold.level.to_bits() == speed.to_bits());
        if let Some(field) = self.field.as_ref().filter(|_| !known) {
            self.bold = Some(Contour::new(speed, format!("{speed:.2}"), field.contour(speed)));
        }
    }

    /// Draws them, old ones faint.
    pub fn paint(&self, painter: &Painter, visuals: &Visuals, view: &View, current: bool) {
        let tokens = theme::tokens(visuals);
        let strength = if current { 1.0 } else { 0.4 };
        for line in self.contours.iter().flat_map(|contour| &contour.lines) {
            polyline(painter, view, line, Stroke::new(2.5, Color32::from_black_alpha(110).gamma_multiply(strength)));
        }
        for line in self.contours.iter().flat_map(|contour| &contour.lines) {
            polyline(painter, view, line, Stroke::new(1.0, Color32::WHITE.gamma_multiply(strength)));
        }
        for line in self.bold.iter().flat_map(|contour| &contour.lines) {
            polyline(painter, view, line, Stroke::new(6.0, tokens.canvas.gamma_multiply(0.9 * strength)));
            polyline(painter, view, line, Stroke::new(3.0, tokens.accent.gamma_multiply(strength)));
        }
    }

    /// Draws their labels where nothing is `taken`.
    pub fn label(&mut self, painter: &Painter, visuals: &Visuals, view: &View, taken: &Taken) {
        let tokens = theme::tokens(visuals);
        let room = painter.clip_rect().intersect(view.rect).shrink(2.0);
        let mut obstacles = Obstacles::new(room, taken);
        // The bold one first: it has the best place.
        for (contour, colour) in self
            .bold
            .iter_mut()
            .map(|bold| (bold, tokens.accent))
            .chain(self.contours.iter_mut().map(|c| (c, tokens.text)))
        {
            let galley = painter.layout_no_wrap(contour.text.clone(), FontId::proportional(theme::CAPTION), colour);
            let size = galley.size() + Vec2::new(8.0, 2.0);
            for (line, label) in contour.lines.iter().zip(&mut contour.labels) {
                let points: Vec<Pos2> = line.points.iter().map(|&point| view.pos_in_ui(point)).collect();
                *label = obstacles.place(&points, size, *label);
                let Some(&at) = label.and_then(|at| points.get(at)) else { continue };
                let pill = Rect::from_center_size(at, size);
                obstacles.areas.push(pill);
                painter.rect_filled(pill, 4.0, tokens.card);
                painter.text(at, Align2::CENTER_CENTER, &contour.text, FontId::proportional(theme::CAPTION), colour);
            }
        }
    }
}

/// How many decimals a step has, so that its multiples are told apart.
pub fn decimals(step: f64) -> usize {
    let whole = |decimals: &i32| {
        let scaled = step * 10.0_f64.powi(*decimals);
        (scaled - scaled.round()).abs() <= 1e-6 * scaled.abs()
    };
    usize::try_from((0..9).find(whole).unwrap_or(9)).unwrap_or_default()
}

/// What is in the way of labels.
struct Obstacles {
    room: Rect,
    /// Points along lines, closer than a label is high.
    dots: Vec<Pos2>,
    areas: Vec<Rect>,
}

impl Obstacles {
    fn new(room: Rect, taken: &Taken) -> Self {
        const STEP: f32 = 6.0;
        let mut dots = Vec::new();
        for ends in taken.lines.iter().flat_map(|line| line.windows(2)) {
            let way = ends[1] - ends[0];
            let count = (way.length() / STEP).ceil().clamp(1.0, 400.0);
            let mut step = 0.0;
            while step <= count {
                dots.push(ends[0] + way * (step / count));
                step += 1.0;
            }
        }
        dots.retain(|dot| room.expand(AMPLE).contains(*dot));
        Self { room, dots, areas: taken.areas.clone() }
    }

    /// How far a label is from what is in its way; nothing where it is outside of the room.
    fn clearance(&self, label: Rect) -> Option<f32> {
        let to_dots = self.dots.iter().map(|dot| label.distance_to_pos(*dot));
        let to_areas = self.areas.iter().map(|area| {
            let apart = (area.min - label.max).max(label.min - area.max).max(Vec2::ZERO);
            apart.length()
        });
        self.room.contains_rect(label).then(|| to_dots.chain(to_areas).fold(AMPLE, f32::min))
    }

    /// The corner of a line that is the best place for a label of this size: where it was `before`, while that is clear, else
    /// the clearest, and of equally clear ones the one nearest to the line's middle.
    fn place(&self, points: &[Pos2], size: Vec2, before: Option<usize>) -> Option<usize> {
        let length: f32 = points.windows(2).map(|ends| (ends[1] - ends[0]).length()).sum();
        if length < LONG_ENOUGH * size.x {
            return None;
        }
        let clear = |corner: usize| {
            self.clearance(Rect::from_center_size(*points.get(corner)?, size)).filter(|clear| *clear >= CLEAR)
        };
        if before.is_some_and(|corner| clear(corner).is_some()) {
            return before;
        }
        let from_the_middle = |corner: usize| corner.abs_diff(points.len() / 2);
        let places = (0..points.len()).filter_map(|corner| Some((corner, clear(corner)?)));
        let best = places.min_by(|a, b| b.1.total_cmp(&a.1).then(from_the_middle(a.0).cmp(&from_the_middle(b.0))));
        best.map(|(corner, _)| corner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_have_the_decimals_that_they_need() {
        assert_eq!([4.0, 2.5, 0.5, 0.25, 20.0, 0.02, 0.0].map(decimals), [0, 1, 1, 2, 0, 2, 0]);
    }

    #[test]
    fn labels_stay_on_their_line_within_the_room_and_away_from_all_else() {
        let room = Rect::from_min_size(Pos2::ZERO, Vec2::new(400.0, 200.0));
        let line: Vec<Pos2> = (-5..46_i16).map(|i| Pos2::new(10.0 * f32::from(i), 100.0)).collect();
        let size = Vec2::new(30.0, 16.0);
        let free = Obstacles::new(room, &Taken::default());
        assert_eq!(free.place(&line, size, None), Some(25), "the middle");
        assert_eq!(free.place(&line, size, Some(12)), Some(12), "where it was");
        assert_eq!(free.place(&line[..6], size, None), None, "outside, or too short");
        let cable = vec![Pos2::new(200.0, -50.0), Pos2::new(200.0, 300.0)];
        let card = Rect::from_min_max(Pos2::ZERO, Pos2::new(180.0, 200.0));
        let taken = Taken { lines: vec![cable], areas: vec![card] };
        let obstacles = Obstacles::new(room, &taken);
        let place = obstacles.place(&line, size, Some(12)).map(|corner| line[corner].x);
        assert!(place.is_some_and(|x| x - 15.0 >= 200.0 + CLEAR && x + 15.0 <= 400.0), "{place:?}");
        let crowded = Taken { areas: vec![card, Rect::from_min_max(Pos2::new(230.0, 0.0), room.max)], ..taken };
        assert_eq!(Obstacles::new(room, &crowded).place(&line, size, None), None);
    }
}
