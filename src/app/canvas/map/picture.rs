//! What the map shows, in world coordinates and without colours.

use super::contours::Field;
use crate::app::state::MapQuantity;
use crate::app::studies::StudyResults;
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
    /// The least and the largest value, where there are any.
    pub found: Option<[f64; 2]>,
    /// The range of the colours. To begin with it is the one that fits the values: of growth rates zero is the middle, and
    /// those that far exceed all decay would hide where it begins, so they share the end of the range.
    pub range: Option<[f64; 2]>,
    /// The points with the least and the largest of the values that are known, with these.
    pub extremes: Option<[(usize, f64); 2]>,
    /// Every so-many-th point of every so-many-th row is known; `None` where not even the coarsest map is.
    pub finest: Option<usize>,
    /// Up to which speed in m/s some points have no critical one, where there are such.
    pub none_up_to: Option<f64>,
}

impl Picture {
    /// The picture of `quantity`, where `known` is a map.
    pub fn new(known: &StudyResults, quantity: MapQuantity) -> Option<Self> {
        let Study::Map { grid, .. } = known.request.study else { return None };
        Some(Self::of(grid, &known.places, quantity))
    }

    /// The picture of `quantity` where `places` are the answers at the points of `grid`.
    pub fn of(grid: Grid, places: &[Option<Answer>], quantity: MapQuantity) -> Self {
        let own: Vec<Cell> = places.iter().map(|answer| cell(answer.as_ref(), quantity)).collect();
        let cells: Vec<Cell> = (0..own.len()).map(|index| own[coarser(&grid, index, &own)]).collect();
        let found = cells.iter().fold(None, |range: Option<[f64; 2]>, cell| match cell {
            Cell::Value(value) => {
                let [low, high] = range.unwrap_or([*value; 2]);
                Some([low.min(*value), high.max(*value)])
            }
            _ => range,
        });
        let range = found.map(|[low, high]| match quantity {
            MapQuantity::Growth => {
                let end = if low < 0.0 { high.min(-2.0 * low).max(-low) } else { high };
                [-end, end]
            }
            _ => [low, high],
        });
        let none_up_to = places.iter().filter_map(|answer| match answer {
            Some(Answer::Critical { verdict: Verdict::NoneUpTo(speed), .. }) => Some(*speed),
            _ => None,
        });
        let none_up_to = none_up_to.reduce(f64::max);
        let (extremes, finest) = (extremes(&own), finest(&grid, places));
        Self { grid, quantity, cells, found, range, extremes, finest, none_up_to }
    }

    /// Whether some values lie below the range of the colours, and whether some lie above it.
    pub fn beyond(&self) -> [bool; 2] {
        let ends = self.found.zip(self.range);
        ends.map_or([false; 2], |([least, largest], [low, high])| [least < low, largest > high])
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

    /// The values at the points that are known. They have gone through `passes` of a filter, or through fewer while only a
    /// coarser map is known. Classes have no values.
    pub fn field(&self, passes: usize) -> Option<Field> {
        let finest = self.finest.filter(|_| self.found.is_some())?;
        let value = |cell: &Cell| if let Cell::Value(value) = cell { Some(self.limited(*value)) } else { None };
        let all = Field { grid: self.grid, values: self.cells.iter().map(value).collect() };
        Some((0..passes / finest).fold(all.thinned(finest), |field, _| field.smoothed()))
    }

    /// A value as it counts among its neighbours: growth beyond the end of the range would drown all that is around it.
    fn limited(&self, value: f64) -> f64 {
        match self.range.filter(|_| self.quantity == MapQuantity::Growth) {
            Some([low, high]) => value.max(low).min(high),
            None => value,
        }
    }

    /// The same with points that have no equilibrium showing what their neighbours let expect, so that colours and contours
    /// go on up to the border of the feasible region and somewhat beyond.
    pub fn spread(&self) -> Self {
        let spread =
            |(index, &cell): (usize, &Cell)| if cell == Cell::Infeasible { self.expected(index) } else { cell };
        Self { cells: self.cells.iter().enumerate().map(spread).collect(), ..self.clone() }
    }

    /// What a point without an equilibrium would show: values go on as they do towards it.
    fn expected(&self, index: usize) -> Cell {
        let (column, row) = (index % self.grid.nx, index / self.grid.nx);
        // The point so many steps away.
        let at = |[right, up]: [isize; 2], steps: isize| {
            let column = column.checked_add_signed(steps * right).filter(|column| *column < self.grid.nx)?;
            let row = row.checked_add_signed(steps * up).filter(|row| *row < self.grid.ny)?;
            Some(self.cells[row * self.grid.nx + column])
        };
        let around = [[1, 0], [0, 1], [-1, 0], [0, -1], [1, 1], [-1, 1], [-1, -1], [1, -1]];
        let values: Vec<f64> = around
            .into_iter()
            .filter_map(|way| match (at(way, 1), at(way, 2)) {
                (Some(Cell::Value(near)), Some(Cell::Value(far))) => Some(2.0 * self.limited(near) - self.limited(far)),
                (Some(Cell::Value(near)), _) => Some(self.limited(near)),
                _ => None,
            })
            .collect();
        if values.is_empty() {
            let other = around.into_iter().filter_map(|way| at(way, 1)).find(|cell| *cell != Cell::Infeasible);
            return other.unwrap_or(Cell::Infeasible);
        }
        Cell::Value(self.limited(values.iter().sum::<f64>() / values.len() as f64))
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

/// The least and the largest value, each with its place.
fn extremes(cells: &[Cell]) -> Option<[(usize, f64); 2]> {
    let values = || {
        let value = |(index, cell): (usize, &Cell)| if let Cell::Value(v) = cell { Some((index, *v)) } else { None };
        cells.iter().enumerate().filter_map(value)
    };
    let lowest = values().min_by(|a, b| a.1.total_cmp(&b.1))?;
    // The first of equal ones, as below.
    let highest = values().reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    Some([lowest, highest])
}

/// The least step at which all points of a coarser map are known.
fn finest(grid: &Grid, places: &[Option<Answer>]) -> Option<usize> {
    [1, 2, 4, COARSEST].into_iter().find(|&step| {
        let mut rows = (0..grid.ny).step_by(step);
        !grid.is_empty()
            && rows.all(|row| (0..grid.nx).step_by(step).all(|column| places[row * grid.nx + column].is_some()))
    })
}

fn cell(answer: Option<&Answer>, quantity: MapQuantity) -> Cell {
    match answer {
        Some(Answer::Critical { verdict, wave_limit, .. }) => match verdict {
            Verdict::Infeasible => Cell::Infeasible,
            // Statics are enough for it.
            _ if quantity == MapQuantity::Waves => wave_limit.map_or(Cell::Failed, Cell::Value),
            Verdict::Unknown | Verdict::NotConverged => Cell::Failed,
            Verdict::NoneUpTo(_) => Cell::NoneUpTo,
            Verdict::Critical(critical) => show(critical, quantity),
        },
        Some(Answer::Growth(Ok(rate))) if quantity == MapQuantity::Growth => Cell::Value(*rate),
        Some(Answer::Growth(Err(NoEigenvalues::Infeasible))) => Cell::Infeasible,
        Some(Answer::Growth(Err(NoEigenvalues::Failed))) => Cell::Failed,
        _ => Cell::Unknown,
    }
}

fn show(critical: &Critical, quantity: MapQuantity) -> Cell {
    match quantity {
        MapQuantity::Speed => Cell::Value(critical.speed),
        MapQuantity::Frequency => Cell::Value(critical.frequency_hz()),
        MapQuantity::Kind => Cell::Class(usize::from(critical.kind == Instability::Divergence)),
        MapQuantity::Cable => Cell::Class(critical.cable),
        MapQuantity::Growth | MapQuantity::Waves => Cell::Unknown,
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
    use crate::app::studies::StudyRequest;
    use crate::scenario::presets;
    use crate::study::{Directions, Mapped};
    use nalgebra::Complex;
    use std::f64::consts::TAU;

    fn known(answer: impl Fn(usize, usize) -> Option<Answer>) -> StudyResults {
        let scenario = presets::PRESETS[0].scenario();
        let (robot, motion) = scenario.to_robot().expect("physical");
        let directions = Directions::One(motion.direction());
        let study = Study::Map { grid: Grid::of(&robot, 41, 21), directions, mapped: Mapped::Critical { limit: 40.0 } };
        let request = StudyRequest::new(&scenario, study);
        let places = (0..41 * 21).map(|index| answer(index % 41, index / 41)).collect();
        StudyResults { request, places, version: (1, 1) }
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
        assert_eq!((picture.range, picture.beyond()), (Some([-0.4, 0.4]), [false, true]));
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
        let [line] = &picture.field(0).expect("values").contour(0.0)[..] else { panic!("one line") };
        assert!(line.closed && line.points.len() > 40, "{line:?}");
        assert!(line.points.iter().all(|&[x, y]| rate(x, y).abs() < 2e-3), "{line:?}");
        // All of one sign, or with gaps: no line, and zero in the middle all the same.
        for sign in [-1.0, 1.0] {
            let one_sign = known(|column, row| (column != 7).then_some(Answer::Growth(Ok(sign * (0.1 + row as f64)))));
            let picture = Picture::new(&one_sign, MapQuantity::Growth).expect("a map");
            assert!(picture.field(0).expect("values").contour(0.0).is_empty() && middle(&picture));
        }
    }

    #[test]
    fn lowest_and_highest_are_those_of_the_known_points_and_lines_need_all_of_a_coarse_map() {
        let bowl = |column: usize, row: usize| critical((column as f64 - 12.0).hypot(row as f64 - 8.0), 0);
        let all = Picture::new(&known(|column, row| Some(bowl(column, row))), MapQuantity::Speed).expect("a map");
        let far = 28.0_f64.hypot(12.0);
        assert_eq!((all.extremes, all.finest), (Some([(8 * 41 + 12, 0.0), (20 * 41 + 40, far)]), Some(1)));
        assert_eq!((all.found, all.beyond()), (Some([0.0, far]), [false; 2]));
        let coarse = known(|column, row| (column % 4 == 0 && row % 4 == 0).then(|| bowl(column, row)));
        let coarse = Picture::new(&coarse, MapQuantity::Speed).expect("a map");
        assert_eq!((coarse.extremes, coarse.finest), (all.extremes, Some(4)));
        assert_eq!(coarse.field(2).map(|field| (field.grid.nx, field.grid.ny)), Some((11, 6)));
        let one = Picture::new(&known(|column, _| (column == 3).then(|| bowl(3, 0))), MapQuantity::Speed);
        assert!(one.expect("a map").field(2).is_none());
        assert!(Picture::new(&known(|_, _| Some(infeasible())), MapQuantity::Speed).expect("a map").extremes.is_none());
    }

    #[test]
    fn wave_limits_are_known_wherever_there_are_statics() {
        let waves = known(|column, _| {
            let verdict = if column < 20 { Verdict::NotConverged } else { Verdict::NoneUpTo(40.0) };
            Some(Answer::Critical { direction: Vec2::x(), verdict, wave_limit: Some(12.5) })
        });
        let picture = Picture::new(&waves, MapQuantity::Waves).expect("a map");
        assert!(picture.cells.iter().all(|cell| *cell == Cell::Value(12.5)));
        let at = super::super::reading(&waves, 30, Vec2::zeros(), Settings::default(), None);
        assert!(at.contains("no critical speed up to 40 m/s") && at.contains("wave limit 12.5 m/s"), "{at}");
        let nothing = Picture::new(&known(|_, _| Some(infeasible())), MapQuantity::Waves).expect("a map");
        assert!(nothing.cells.iter().all(|cell| *cell == Cell::Infeasible));
    }

    #[test]
    fn colours_go_on_beyond_the_last_point_of_the_region() {
        let half = known(|column, _| Some(if column < 20 { infeasible() } else { critical(column as f64, 0) }));
        let picture = Picture::new(&half, MapQuantity::Speed).expect("a map").spread();
        // Speeds rise by one from column to column, the first one being the 20th.
        assert_eq!(picture.at(Vec2::new(-0.5, 0.0)), Cell::Value(19.0));
        assert_eq!(picture.at(Vec2::new(-1.0, 0.0)), Cell::Infeasible);
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
