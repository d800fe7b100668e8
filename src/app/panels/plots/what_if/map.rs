//! The critical speed over two numbers, as a map.

use eframe::egui::epaint::Mesh;
use eframe::egui::{Color32, Pos2, Rect, Role, Shape, Stroke, Ui, WidgetInfo};

use super::super::axis::{Axis, signed};
use super::super::chart::{Chart, Dash, Symbol, Titles, inner, quad};
use super::super::common;
use super::curve::reading;
use super::drawing;
use super::numbers::{Number, name};
use crate::app::canvas::map::{Cell, Picture, colour, corners, hatching};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::fields;
use crate::app::round::round_step;
use crate::app::state::MapQuantity;
use crate::app::studies::Shown;
use crate::robot::Vec2;
use crate::study::{Answer, Grid, Study};

/// About how many contours a map has.
const CONTOURS: f64 = 6.0;

/// Draws the map.
pub fn ui(numbers: [&Number; 2], shown: Shown<'_>, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Study::WhatIf(what_if) = &shown.known.request.study else { return };
    let [columns, rows] = &what_if.numbers[..] else { return };
    let values = [&columns.values[..], &rows.values[..]];
    let [nx, ny] = values.map(<[f64]>::len);
    // Its points are counted, whatever the values between them are.
    let grid = Grid { low: Vec2::zeros(), high: Vec2::new(last(nx), last(ny)), nx, ny };
    let picture = Picture::of(grid, &shown.known.places, MapQuantity::Speed);
    let finding = finding(&picture, numbers, values, facts).filter(|_| shown.current);
    common::say(
        ui,
        finding.as_deref().unwrap_or(if shown.current { "No critical speed here." } else { "Being computed." }),
    );
    let response = drawing::room(ui);
    let outer = response.rect;
    let [title_x, title_y] = numbers.map(Number::title);
    let titles = Titles { x: Some(&title_x), x_unit: None, y: Some(&title_y) };
    let rect = inner(ui, outer, titles);
    let x = numbers[0].axis([rect.left(), rect.right()]);
    let y = numbers[1].axis([rect.bottom(), rect.top()]);
    let mut chart = Chart::new(ui, outer, rect, [x, y]);
    chart.grid(titles);
    let drawn = Drawn {
        picture: &picture,
        columns: places(&x, numbers[0], values[0]),
        rows: places(&y, numbers[1], values[1]),
    };
    drawn.paint(ui, &mut chart, shown.current);
    let now = Pos2::new(x.pos(numbers[0].shown(numbers[0].value)), y.pos(numbers[1].shown(numbers[1].value)));
    cross(&chart, now);
    chart.finish();

    let answer = |i: usize, j: usize| shown.known.places.get(j * nx + i).and_then(Option::as_ref);
    let told = |i: usize, j: usize| -> Vec<String> {
        let pair = [values[0][i], values[1][j]];
        let texts: Vec<String> = numbers
            .iter()
            .zip(pair)
            .map(|(number, value)| format!("{} = {}", number.field.symbol, number.text(value)))
            .collect();
        let mut lines = vec![texts.join(", ")];
        match answer(i, j) {
            Some(Answer::Critical { verdict, .. }) => {
                lines.extend(reading(verdict, facts).map_or_else(|| vec![why_not(numbers, pair, facts)], Vec::from));
            }
            _ => lines.push("not computed yet".into()),
        }
        lines
    };
    if let Some(pointer) = response.hover_pos().filter(|pointer| rect.contains(*pointer)) {
        let (i, j) = (nearest(&drawn.columns, pointer.x), nearest(&drawn.rows, pointer.y));
        if let (Some(i), Some(j)) = (i, j) {
            let at = Pos2::new(drawn.columns[i], drawn.rows[j]);
            chart.mark(at, Symbol::Ring, 5.0, chart.tokens.text);
            chart.card(at, &told(i, j));
        }
    }
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) {
        let mut scenario = facts.document.scenario.clone();
        numbers[0].field.parameter.set(&mut scenario, numbers[0].meant(&x, pointer.x));
        numbers[1].field.parameter.set(&mut scenario, numbers[1].meant(&y, pointer.y));
        commands.push(Command::Edit(Box::new(scenario)));
    }
    response.widget_info(|| {
        let [a, b] = numbers.map(|number| {
            let [from, to] = number.range.ends.map(|end| number.text(end));
            format!("{} from {from} to {to}", name(&number.field))
        });
        let finding = finding.as_deref().unwrap_or("Not all is known yet.");
        WidgetInfo::labeled(Role::Image, true, format!("What if: the critical speed over {a} and {b}. {finding}"))
    });
}

/// The number of the last of `count` points.
fn last(count: usize) -> f64 {
    count.saturating_sub(1) as f64
}

/// Where values are on the screen.
fn places(axis: &Axis, number: &Number, values: &[f64]) -> Vec<f32> {
    values.iter().map(|value| axis.pos(number.shown(*value))).collect()
}

/// The place that is nearest to a point of the screen.
fn nearest(places: &[f32], at: f32) -> Option<usize> {
    let away = places.iter().map(|place| (place - at).abs()).enumerate();
    away.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
}

/// A map with the places of its columns and rows on the screen.
struct Drawn<'a> {
    picture: &'a Picture,
    columns: Vec<f32>,
    rows: Vec<f32>,
}

impl Drawn<'_> {
    /// Draws colours, patterns and contours.
    fn paint(&self, ui: &Ui, chart: &mut Chart, current: bool) {
        let Self { picture, columns, rows } = self;
        let visuals = ui.visuals();
        let faint = |colour: Color32| if current { colour } else { colour.gamma_multiply(0.45) };
        let mut mesh = Mesh::default();
        let mut gaps = Vec::new();
        let nx = picture.grid.nx;
        for (j, &y) in rows.iter().enumerate() {
            for (i, &x) in columns.iter().enumerate() {
                let area = Rect::from_two_pos(
                    Pos2::new(half_way(columns, i, x, false), half_way(rows, j, y, false)),
                    Pos2::new(half_way(columns, i, x, true), half_way(rows, j, y, true)),
                );
                match picture.cells.get(j * nx + i) {
                    Some(Cell::Infeasible | Cell::Failed) => gaps.push(corners(area)),
                    Some(cell) => {
                        let fill = faint(colour(picture, *cell, visuals));
                        let [a, b, c, d] = [area.left_top(), area.right_top(), area.right_bottom(), area.left_bottom()];
                        quad(&mut mesh, [a, b, c, d], fill);
                    }
                    None => {}
                }
            }
        }
        chart.painter.add(Shape::mesh(mesh));
        hatching(&chart.painter, visuals, chart.rect.min, &gaps);
        self.contours(chart, faint(chart.tokens.text));
    }

    /// Lines of equal critical speed, each with its speed.
    fn contours(&self, chart: &mut Chart, colour: Color32) {
        let Some((field, [low, high])) = self.picture.field(0).zip(self.picture.found) else { return };
        let step = round_step((high - low) / CONTOURS);
        if !(step > 0.0 && step.is_finite()) {
            return;
        }
        let between = |places: &[f32], at: f64| {
            // A place between two neighbours: small and not negative.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let below = (at.max(0.0) as usize).min(places.len().saturating_sub(1));
            let next = (below + 1).min(places.len().saturating_sub(1));
            #[expect(clippy::cast_possible_truncation)]
            let part = (at - below as f64) as f32;
            places[below] + part * (places[next] - places[below])
        };
        for level in field.levels(step, [low, high]) {
            for line in field.contour(level) {
                let on_screen = |[x, y]: &[f64; 2]| Pos2::new(between(&self.columns, *x), between(&self.rows, *y));
                let mut points: Vec<Pos2> = line.points.iter().map(on_screen).collect();
                if line.closed {
                    points.extend(points.first().copied());
                }
                let spots: Vec<Pos2> = points.get(points.len() / 2).copied().into_iter().collect();
                super::super::chart::draw_line(&chart.painter, points, Stroke::new(1.0, colour), Dash::Solid);
                chart.label(digits::certain(level, Some(0.05 * step)), colour, &spots);
            }
        }
    }
}

/// Half-way from a place to the next one, or to the one before; at the ends the place itself.
fn half_way(places: &[f32], i: usize, own: f32, next: bool) -> f32 {
    let other = if next { places.get(i + 1) } else { i.checked_sub(1).and_then(|before| places.get(before)) };
    other.map_or(own, |other| 0.5 * (own + other))
}

/// The mark of the present pair.
fn cross(chart: &Chart, at: Pos2) {
    let painter = &chart.painter;
    for (width, colour) in [(4.0, chart.tokens.panel), (2.0, chart.tokens.accent)] {
        let stroke = Stroke::new(width, colour);
        painter.hline(at.x - 8.0..=at.x + 8.0, at.y, stroke);
        painter.vline(at.x, at.y - 8.0..=at.y + 8.0, stroke);
    }
}

/// Why a pair of values has no answer.
fn why_not(numbers: [&Number; 2], pair: [f64; 2], facts: Facts<'_>) -> String {
    let mut scenario = facts.document.scenario.clone();
    for (number, value) in numbers.iter().zip(pair) {
        number.field.parameter.set(&mut scenario, value);
    }
    fields::check(&scenario, facts.settings).err().map_or_else(|| "could not be computed".into(), |why| signed(&why))
}

/// What is to be seen, in a sentence.
fn finding(picture: &Picture, numbers: [&Number; 2], values: [&[f64]; 2], facts: Facts<'_>) -> Option<String> {
    let at = |(place, speed): (usize, f64)| {
        let [a, b] = [(0, place % picture.grid.nx.max(1)), (1, place / picture.grid.nx.max(1))].map(|(k, i)| {
            let value = values[k].get(i).copied().unwrap_or_default();
            format!("{} = {}", numbers[k].field.symbol, numbers[k].text(value))
        });
        format!("{} m/s at {a}, {b}", digits::like(speed, facts.share()))
    };
    let [low, high] = picture.extremes?.map(at);
    Some(format!("Critical from {low} to {high}."))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Verdict;

    #[test]
    fn a_pointer_finds_the_nearest_place_and_areas_meet_half_way() {
        let places = [10.0, 20.0, 40.0];
        assert_eq!((nearest(&places, 29.0), nearest(&places, 31.0), nearest(&[], 0.0)), (Some(1), Some(2), None));
        let near = |a: f32, b: f32| (a - b).abs() < 1e-5;
        assert!(near(half_way(&places, 1, 20.0, true), 30.0) && near(half_way(&places, 1, 20.0, false), 15.0));
        assert!(near(half_way(&places, 0, 10.0, false), 10.0) && near(half_way(&places, 2, 40.0, true), 40.0));
    }

    #[test]
    fn a_picture_over_two_numbers_tells_what_is_known_at_each_pair() {
        let grid = Grid { low: Vec2::zeros(), high: Vec2::new(1.0, 0.0), nx: 2, ny: 1 };
        let answer = |verdict| Some(Answer::Critical { direction: Vec2::x(), verdict, wave_limit: None });
        let places = [answer(Verdict::Infeasible), answer(Verdict::NoneUpTo(40.0))];
        let picture = Picture::of(grid, &places, MapQuantity::Speed);
        assert_eq!(picture.cells, [Cell::Infeasible, Cell::NoneUpTo]);
        assert_eq!(picture.extremes, None);
    }
}
