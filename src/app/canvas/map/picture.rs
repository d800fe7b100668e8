//! What the map shows, in world coordinates and without colours.

use crate::app::state::MapQuantity;
use crate::app::studies::Known;
use crate::robot::{BoundingBox, Vec2};
use crate::stability::{Critical, Instability};
use crate::study::{Answer, Grid, NoEigenvalues, Study, Verdict};

/// Answers come from every so-many-th point of every so-many-th row first.
const COARSEST: usize = 8;
/// So many classes are told apart: a robot has at most eight cables.
pub const CLASSES: usize = 8;
/// A class with fewer points than this is rare.
const RARE: usize = 32;

/// How the map, its legend and its reading call a point without an equilibrium, and one without an answer.
pub const NO_EQUILIBRIUM: &str = "no equilibrium";
pub const NOT_COMPUTED: &str = "could not be computed";

/// What the map shows at one of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// Not known yet.
    Unknown,
    /// No equilibrium.
    Infeasible,
    /// It could not be computed.
    Failed,
    /// No critical speed up to the limit of the search.
    NoneUpTo,
    /// A value, in SI units or Hz.
    Value(f64),
    /// A class: flutter 0, divergence 1; or the cable, 0-based.
    Class(usize),
}

/// The map of one quantity.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Where its points are.
    pub grid: Grid,
    /// What it shows.
    pub quantity: MapQuantity,
    /// By point; what is not known yet shows what a coarser map would.
    pub cells: Vec<Cell>,
    /// The least and the largest value, where there are any. Of growth rates zero is the middle, and those that far exceed
    /// all decay would hide where it begins: they share the end of the range.
    pub range: Option<[f64; 2]>,
    /// Whether some values lie beyond the end of the range.
    pub beyond: bool,
    /// Up to which speed in m/s some points have no critical one, where there are such.
    pub none_up_to: Option<f64>,
}

impl Picture {
    /// The picture of `quantity`, where `known` is a map.
    pub fn new(known: &Known, quantity: MapQuantity) -> Option<Self> {
        let Study::Map { grid, .. } = known.wish.study else { return None };
        let own: Vec<Cell> = known.places.iter().map(|answer| cell(answer.as_ref(), quantity)).collect();
        let cells: Vec<Cell> = (0..own.len()).map(|index| own[coarser(&grid, index, &own)]).collect();
        let range = cells.iter().fold(None, |range: Option<[f64; 2]>, cell| match cell {
            Cell::Value(value) => {
                let [low, high] = range.unwrap_or([*value; 2]);
                Some([low.min(*value), high.max(*value)])
            }
            _ => range,
        });
        let largest = range.map(|[_, high]| high);
        let range = range.map(|[low, high]| match quantity {
            MapQuantity::Growth => {
                let end = if low < 0.0 { high.min(-2.0 * low).max(-low) } else { high };
                [-end, end]
            }
            _ => [low, high],
        });
        let none_up_to = known.places.iter().filter_map(|answer| match answer {
            Some(Answer::Critical { verdict: Verdict::NoneUpTo(speed), .. }) => Some(*speed),
            _ => None,
        });
        let beyond = largest > range.map(|[_, high]| high);
        Some(Self { none_up_to: none_up_to.reduce(f64::max), grid, quantity, cells, range, beyond })
    }

    /// Where a value lies in the range of all, from 0 to 1.
    pub fn part(&self, value: f64) -> f64 {
        match self.range {
            Some([low, high]) if high - low > 1e-9 * high.abs() => (value - low) / (high - low),
            _ => 0.5,
        }
    }

    /// Whether any point shows `cell`.
    pub fn has(&self, cell: Cell) -> bool {
        self.cells.contains(&cell)
    }

    /// Whether something grows there at today's speed; only growth rates tell.
    pub fn grows(&self, cell: Cell) -> bool {
        self.quantity == MapQuantity::Growth && matches!(cell, Cell::Value(rate) if rate > 0.0)
    }

    /// Where growth rates are zero: lines from [x, y] to [x, y] in m, each within one rectangle of four neighbours. Where one
    /// of the four has no value there is none.
    pub fn zero_line(&self) -> Vec<[[f64; 2]; 2]> {
        let Grid { nx, ny, .. } = self.grid;
        let mut lines = Vec::new();
        if self.quantity != MapQuantity::Growth {
            return lines;
        }
        for (row, column) in (0..ny.saturating_sub(1)).flat_map(|row| (0..nx.saturating_sub(1)).map(move |c| (row, c)))
        {
            // Around the rectangle.
            let corners = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(up, right)| (row + up) * nx + column + right);
            let rates = corners.map(|index| match self.cells[index] {
                Cell::Value(rate) => Some(rate),
                _ => None,
            });
            let [Some(a), Some(b), Some(c), Some(d)] = rates else { continue };
            let rates = [a, b, c, d];
            let crossing = |side: usize| {
                let (from, to) = (side, (side + 1) % 4);
                ((rates[from] > 0.0) != (rates[to] > 0.0)).then(|| {
                    let part = rates[from] / (rates[from] - rates[to]);
                    let [from, to] = [from, to].map(|corner| self.grid.position(corners[corner]));
                    <[f64; 2]>::from(from + (to - from) * part)
                })
            };
            match [crossing(0), crossing(1), crossing(2), crossing(3)] {
                [Some(a), Some(b), Some(c), Some(d)] => {
                    // A saddle: the value in the middle tells which corners belong together.
                    let together = (rates.iter().sum::<f64>() > 0.0) == (rates[0] > 0.0);
                    lines.extend(if together { [[a, b], [c, d]] } else { [[d, a], [b, c]] });
                }
                some => {
                    let ends: Vec<[f64; 2]> = some.into_iter().flatten().collect();
                    if let [from, to] = ends[..] {
                        lines.push([from, to]);
                    }
                }
            }
        }
        lines
    }

    /// What is to be seen at `pos_in_world`: between points with values the value in between, else what the nearest
    /// point shows.
    pub fn at(&self, pos_in_world: Vec2) -> Cell {
        let Some(nearest) = nearest(&self.grid, pos_in_world) else { return Cell::Unknown };
        let Cell::Value(own) = self.cells[nearest] else { return self.cells[nearest] };
        let [(left, right, x), (low, high, y)] = neighbours(&self.grid, pos_in_world);
        let mut sum = 0.0;
        let mut weights = 0.0;
        for (column, part) in [(left, 1.0 - x), (right, x)] {
            for (row, other) in [(low, 1.0 - y), (high, y)] {
                if let Cell::Value(value) = self.cells[row * self.grid.nx + column] {
                    sum += part * other * value;
                    weights += part * other;
                }
            }
        }
        Cell::Value(if weights > 0.0 { sum / weights } else { own })
    }

    /// Rectangles that cover what lies nearest to points showing `wanted`.
    pub fn areas(&self, wanted: Cell) -> Vec<BoundingBox> {
        let Grid { nx, ny, .. } = self.grid;
        let mut areas = Vec::new();
        for row in 0..ny {
            let mut column = 0;
            while column < nx {
                let run = (column..nx).take_while(|&at| self.cells[row * nx + at] == wanted).count();
                if run > 0 {
                    let (first, last) = (self.area(column, row), self.area(column + run - 1, row));
                    areas.push(BoundingBox { low: first.low, high: last.high });
                }
                column += run + 1;
            }
        }
        areas
    }

    /// What lies nearest to a point.
    fn area(&self, column: usize, row: usize) -> BoundingBox {
        let here = self.grid.position(row * self.grid.nx + column);
        let half = 0.5 * step(&self.grid);
        BoundingBox { low: (here - half).sup(&self.grid.low), high: (here + half).inf(&self.grid.high) }
    }

    /// Points that are labelled, each with what it shows: classes and growth above zero. Only some, so that the picture
    /// stays calm, but every second one of a class that is rare.
    pub fn labels(&self) -> Vec<([f64; 2], Cell)> {
        let mut counts = [0_usize; CLASSES];
        for cell in &self.cells {
            if let Cell::Class(class) = cell {
                counts[class % CLASSES] += 1;
            }
        }
        let mut seen = [0_usize; CLASSES];
        let mut labels = Vec::new();
        for (index, &cell) in self.cells.iter().enumerate() {
            let (column, row) = (index % self.grid.nx, index / self.grid.nx);
            let one_in_sixteen = column % 4 == 2 && row % 4 == 2;
            let wanted = match cell {
                Cell::Class(class) if counts[class % CLASSES] < RARE => {
                    seen[class % CLASSES] += 1;
                    seen[class % CLASSES] % 2 == 1
                }
                Cell::Class(_) => one_in_sixteen,
                _ => one_in_sixteen && self.grows(cell),
            };
            if wanted {
                labels.push((self.grid.position(index).into(), cell));
            }
        }
        labels
    }
}

fn cell(answer: Option<&Answer>, quantity: MapQuantity) -> Cell {
    match answer {
        Some(Answer::Critical { verdict, .. }) => match verdict {
            Verdict::Infeasible => Cell::Infeasible,
            Verdict::Unknown | Verdict::NotConverged => Cell::Failed,
            Verdict::NoneUpTo(_) => Cell::NoneUpTo,
            Verdict::Critical(critical) => show(critical, quantity),
        },
        Some(Answer::Growth(Ok(rate))) if quantity == MapQuantity::Growth => Cell::Value(*rate),
        Some(Answer::Growth(Err(NoEigenvalues::Infeasible))) => Cell::Infeasible,
        Some(Answer::Growth(Err(NoEigenvalues::Failed))) => Cell::Failed,
        Some(Answer::Growth(_) | Answer::Spectrum(_) | Answer::Modes(_)) | None => Cell::Unknown,
    }
}

fn show(critical: &Critical, quantity: MapQuantity) -> Cell {
    match quantity {
        MapQuantity::Speed => Cell::Value(critical.speed),
        MapQuantity::Frequency => Cell::Value(critical.frequency_hz()),
        MapQuantity::Kind => Cell::Class(usize::from(critical.kind == Instability::Divergence)),
        MapQuantity::Cable => Cell::Class(critical.cable),
        MapQuantity::Growth => Cell::Unknown,
    }
}

/// The point that stands in for `index`: itself, or the nearest one of a coarser map.
fn coarser(grid: &Grid, index: usize, own: &[Cell]) -> usize {
    let (column, row) = (index % grid.nx, index / grid.nx);
    let mut step = 1;
    while step <= COARSEST {
        let snap = |at: usize, count: usize| {
            let near = (at + step / 2) / step * step;
            if near < count { near } else { near - step }
        };
        let stand_in = snap(row, grid.ny) * grid.nx + snap(column, grid.nx);
        if own[stand_in] != Cell::Unknown {
            return stand_in;
        }
        step *= 2;
    }
    index
}

fn step(grid: &Grid) -> Vec2 {
    let size = grid.high - grid.low;
    Vec2::new(size.x / intervals(grid.nx), size.y / intervals(grid.ny))
}

fn intervals(points: usize) -> f64 {
    points.saturating_sub(1).max(1) as f64
}

/// The index of the grid's point nearest to `pos_in_world`; none outside of the workspace.
pub fn nearest(grid: &Grid, pos_in_world: Vec2) -> Option<usize> {
    let inside = (0..2).all(|i| (grid.low[i]..=grid.high[i]).contains(&pos_in_world[i]));
    let [(left, right, x), (low, high, y)] = neighbours(grid, pos_in_world);
    let (column, row) = (if x < 0.5 { left } else { right }, if y < 0.5 { low } else { high });
    (inside && !grid.is_empty()).then_some(row * grid.nx + column)
}

/// For each coordinate the index below, the one above, and how far the point lies from the one to the other.
fn neighbours(grid: &Grid, pos_in_world: Vec2) -> [(usize, usize, f64); 2] {
    let step = step(grid);
    [(0, grid.nx), (1, grid.ny)].map(|(i, count)| {
        let last = count.saturating_sub(1);
        let at = ((pos_in_world[i] - grid.low[i]) / step[i]).clamp(0.0, last as f64);
        // Not negative, and at most the last index.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let below = (at as usize).min(last.saturating_sub(1));
        (below, (below + 1).min(last), at - below as f64)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::settings::Settings;
    use crate::app::studies::Wish;
    use crate::scenario::presets;
    use crate::study::{Directions, Mapped};
    use nalgebra::Complex;
    use std::f64::consts::TAU;

    fn known(answer: impl Fn(usize, usize) -> Option<Answer>) -> Known {
        let scenario = presets::PRESETS[0].scenario();
        let (robot, motion) = scenario.to_robot().expect("physical");
        let directions = Directions::One(motion.direction());
        let study = Study::Map { grid: Grid::of(&robot, 41, 21), directions, mapped: Mapped::Critical { limit: 40.0 } };
        let wish = Wish::new(&scenario, study);
        let places = (0..41 * 21).map(|index| answer(index % 41, index / 41)).collect();
        Known { wish, places, version: (1, 1) }
    }

    fn critical(speed: f64, cable: usize) -> Answer {
        let critical = Critical { speed, eigenvalue: Complex::new(0.0, TAU), kind: Instability::Flutter, cable };
        Answer::Critical { direction: Vec2::x(), verdict: Verdict::Critical(critical), wave_limit: None }
    }

    fn infeasible() -> Answer {
        Answer::Critical { direction: Vec2::x(), verdict: Verdict::Infeasible, wave_limit: None }
    }

    #[test]
    fn values_lie_between_those_of_the_points() {
        let plane = known(|column, row| Some(critical(column as f64 + 100.0 * row as f64, 3)));
        let picture = Picture::new(&plane, MapQuantity::Speed).expect("a map");
        assert_eq!(picture.range, Some([0.0, 2040.0]));
        for (x, y) in [(-10.0, -5.0), (-9.8, -4.7), (0.0, 0.0), (10.0, 5.0)] {
            let Cell::Value(value) = picture.at(Vec2::new(x, y)) else { panic!("no value at {x}, {y}") };
            let expected = (x + 10.0) / 0.5 + 100.0 * (y + 5.0) / 0.5;
            assert!((value - expected).abs() < 1e-9, "{value} in place of {expected}");
        }
        assert_eq!(picture.at(Vec2::new(10.1, 0.0)), Cell::Unknown);
        let cables = Picture::new(&plane, MapQuantity::Cable).expect("a map");
        assert_eq!(cables.at(Vec2::new(3.3, 2.2)), Cell::Class(3));
        assert!(cables.labels().len() > 20 && cables.labels().iter().all(|(_, cell)| *cell == Cell::Class(3)));
    }

    #[test]
    fn coarse_answers_stand_in_for_what_is_not_known_yet() {
        let coarse = known(|column, row| (column % 8 == 0 && row % 8 == 0).then(|| critical(column as f64, 0)));
        let picture = Picture::new(&coarse, MapQuantity::Speed).expect("a map");
        assert!(!picture.has(Cell::Unknown), "the whole picture is there at once");
        assert_eq!(picture.at(Vec2::new(-8.5, -5.0)), Cell::Value(0.0));
        assert_eq!(picture.at(Vec2::new(-7.5, -5.0)), Cell::Value(8.0));
        let nothing = Picture::new(&known(|_, _| None), MapQuantity::Speed).expect("a map");
        assert!(nothing.cells.iter().all(|cell| *cell == Cell::Unknown) && nothing.range.is_none());
    }

    #[test]
    fn rare_classes_are_labelled_and_fast_growth_does_not_hide_where_it_begins() {
        let lone = known(|column, row| Some(critical(1.0, if (column, row) == (3, 3) { 0 } else { 3 })));
        let labels = Picture::new(&lone, MapQuantity::Cable).expect("a map").labels();
        assert_eq!(labels.iter().filter(|(_, cell)| *cell == Cell::Class(0)).count(), 1);

        let rates = known(|column, _| Some(Answer::Growth(Ok(if column > 30 { 200.0 } else { -0.2 }))));
        let picture = Picture::new(&rates, MapQuantity::Growth).expect("a map");
        assert_eq!((picture.range, picture.beyond), (Some([-0.4, 0.4]), true));
        assert!(picture.labels().iter().all(|(_, cell)| *cell == Cell::Value(200.0)) && !picture.labels().is_empty());
    }

    /// They are drawn, read and explained in another way than those without equilibrium, on every kind of map.
    #[test]
    fn what_could_not_be_computed_is_no_infeasible_pose() {
        let verdict = |verdict| Answer::Critical { direction: Vec2::x(), verdict, wave_limit: None };
        let growth = Answer::Growth;
        for (failed, infeasible, quantity) in [
            (verdict(Verdict::Unknown), verdict(Verdict::Infeasible), MapQuantity::Speed),
            (verdict(Verdict::NotConverged), verdict(Verdict::Infeasible), MapQuantity::Cable),
            (growth(Err(NoEigenvalues::Failed)), growth(Err(NoEigenvalues::Infeasible)), MapQuantity::Growth),
        ] {
            let half = known(|column, _| Some(if column < 20 { failed.clone() } else { infeasible.clone() }));
            let picture = Picture::new(&half, quantity).expect("a map");
            assert_eq!(
                (picture.at(Vec2::new(-5.0, 0.0)), picture.at(Vec2::new(5.0, 0.0))),
                (Cell::Failed, Cell::Infeasible)
            );
            let at = |index| super::super::reading(&half, index, Vec2::zeros(), Settings::default(), None);
            assert!(at(0).contains("could not be computed") && !at(0).contains("equilibrium"), "{}", at(0));
            assert!(at(40).contains("no equilibrium"), "{}", at(40));
        }
    }

    /// Zero is the middle of the scale whatever the values are, and the line at zero is where what is seen is zero.
    #[test]
    fn the_line_at_zero_parts_what_grows_from_what_dies_out() {
        let rate = |x: f64, y: f64| 0.1 * (x * x / 30.0 + y * y / 8.0 - 1.0);
        let at = |column: usize, row: usize| (column as f64 * 0.5 - 10.0, row as f64 * 0.5 - 5.0);
        let round = known(|column, row| {
            let (x, y) = at(column, row);
            Some(Answer::Growth(Ok(rate(x, y))))
        });
        let picture = Picture::new(&round, MapQuantity::Growth).expect("a map");
        let Some([low, high]) = picture.range else { panic!("no range") };
        let middle = |picture: &Picture| (picture.part(0.0) - 0.5).abs() < 1e-12;
        assert!((low + high).abs() < 1e-12 && middle(&picture), "{low} {high}");
        assert!(picture.part(0.01) > 0.5 && picture.part(-0.01) < 0.5);
        let lines = picture.zero_line();
        assert!(lines.len() > 40, "{}", lines.len());
        for end in lines.iter().flatten() {
            let Cell::Value(seen) = picture.at(Vec2::from(*end)) else { panic!("no value on the line") };
            assert!(seen.abs() < 1e-12, "{seen} at {end:?}");
            assert!(rate(end[0], end[1]).abs() < 2e-3, "{end:?}");
        }
        // Every end but those at the border belongs to two lines.
        for end in lines.iter().flatten().filter(|end| end[1].abs() < 4.999) {
            let near = |other: &&[f64; 2]| (other[0] - end[0]).hypot(other[1] - end[1]) < 1e-9;
            assert_eq!(lines.iter().flatten().filter(near).count(), 2, "{end:?}");
        }
        // All of one sign, or with gaps: no line, and zero in the middle all the same.
        for sign in [-1.0, 1.0] {
            let one_sign = known(|column, row| (column != 7).then_some(Answer::Growth(Ok(sign * (0.1 + row as f64)))));
            let picture = Picture::new(&one_sign, MapQuantity::Growth).expect("a map");
            assert!(picture.zero_line().is_empty() && middle(&picture));
        }
    }

    #[test]
    fn infeasible_points_are_covered_by_areas_and_take_no_part_in_values() {
        let half = known(|column, _| Some(if column < 20 { infeasible() } else { critical(7.0, 0) }));
        let picture = Picture::new(&half, MapQuantity::Speed).expect("a map");
        let areas = picture.areas(Cell::Infeasible);
        assert_eq!(areas.len(), 21);
        let corners = |area: BoundingBox| [area.low, area.high].map(<[f64; 2]>::from);
        assert_eq!(corners(areas[0]), [[-10.0, -5.0], [-0.25, -4.75]]);
        assert_eq!(corners(areas[20]), [[-10.0, 4.75], [-0.25, 5.0]]);
        assert_eq!(picture.at(Vec2::new(-0.3, 0.0)), Cell::Infeasible);
        assert_eq!(picture.at(Vec2::new(-0.2, 0.0)), Cell::Value(7.0));
    }
}
