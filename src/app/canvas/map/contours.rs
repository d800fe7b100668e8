//! Lines of equal value through a grid, by marching squares: cell by cell it is told which edges the line crosses, and the
//! pieces are joined to long lines.

use std::collections::{BTreeMap, BTreeSet};

use crate::robot::Vec2;
use crate::study::Grid;

/// A line through the cells of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// Its corners in m, each on an edge of the grid.
    pub points: Vec<[f64; 2]>,
    /// Whether the last corner is joined to the first.
    pub closed: bool,
}

/// An edge of the grid: the numbers of its two points, the smaller one first.
type Edge = [usize; 2];

/// The lines between the points of `grid` that are inside and those that are not. A cell has no line
/// where one of its corners is not known. `crossing` tells where the line crosses an edge between two such points. Where
/// opposite corners are alike and neighbours are not, `middle` tells whether the middle of the cell is inside, by its
/// corners from the lower left one round.
pub fn trace(
    grid: &Grid,
    inside: impl Fn(usize) -> Option<bool>,
    crossing: impl Fn(Edge) -> Option<Vec2>,
    middle: impl Fn([usize; 4]) -> bool,
) -> Vec<Polyline> {
    let mut pieces: Vec<[Edge; 2]> = Vec::new();
    for corners in cells(grid) {
        let [Some(a), Some(b), Some(c), Some(d)] = corners.map(&inside) else { continue };
        let sides = [a, b, c, d];
        let edge = |side: usize| {
            let [from, to] = [corners[side], corners[(side + 1) % 4]];
            [from.min(to), from.max(to)]
        };
        let crossed: Vec<usize> = (0..4).filter(|&side| sides[side] != sides[(side + 1) % 4]).collect();
        match crossed[..] {
            [from, to] => pieces.push([edge(from), edge(to)]),
            // A saddle: the two corners that are like the middle belong together, the line goes around the others.
            [..] if crossed.len() == 4 => {
                let first_with_middle = middle(corners) == a;
                let around = if first_with_middle { [[0, 1], [2, 3]] } else { [[3, 0], [1, 2]] };
                pieces.extend(around.map(|ends| ends.map(edge)));
            }
            _ => {}
        }
    }
    let placed = |(edges, closed): (Vec<Edge>, bool)| {
        let points = edges.into_iter().filter_map(&crossing).map(<[f64; 2]>::from).collect();
        Polyline { points, closed }
    };
    joined(&pieces).into_iter().map(placed).collect()
}

/// The cells of a grid, each by its corners from the lower left one round.
pub fn cells(grid: &Grid) -> impl Iterator<Item = [usize; 4]> + use<> {
    let Grid { nx, ny, .. } = *grid;
    let lower_left =
        (0..ny.saturating_sub(1)).flat_map(move |row| (0..nx.saturating_sub(1)).map(move |column| row * nx + column));
    lower_left.map(move |first| [first, first + 1, first + nx + 1, first + nx])
}

/// Pieces that share an edge put together, each line with whether it is closed. No edge is in more than two pieces.
fn joined(pieces: &[[Edge; 2]]) -> Vec<(Vec<Edge>, bool)> {
    let mut neighbours: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    for &[from, to] in pieces {
        neighbours.entry(from).or_default().push(to);
        neighbours.entry(to).or_default().push(from);
    }
    // What has an end begins there; what is left then goes round.
    let (inner, ends): (Vec<Edge>, Vec<Edge>) = neighbours.keys().copied().partition(|edge| neighbours[edge].len() > 1);
    let mut seen = BTreeSet::new();
    let mut lines = Vec::new();
    for (starts, closed) in [(ends, false), (inner, true)] {
        for start in starts {
            let mut line = Vec::new();
            let mut next = Some(start).filter(|edge| !seen.contains(edge));
            while let Some(edge) = next {
                seen.insert(edge);
                line.push(edge);
                next = neighbours[&edge].iter().copied().find(|edge| !seen.contains(edge));
            }
            if line.len() > 1 {
                lines.push((line, closed));
            }
        }
    }
    lines
}

/// A quantity at the points of a grid, where it has a value there.
#[derive(Clone, Debug)]
pub struct Field {
    /// The points.
    pub grid: Grid,
    /// By point.
    pub values: Vec<Option<f64>>,
}

impl Field {
    /// Only every `step`-th point of every `step`-th row.
    pub fn thinned(&self, step: usize) -> Self {
        let fine = self.grid;
        let [nx, ny] = [fine.nx, fine.ny].map(|count| count.saturating_sub(1) / step + 1);
        let index = |i: usize| i / nx * step * fine.nx + i % nx * step;
        let grid = Grid { nx, ny, high: fine.position(index(nx * ny - 1)), ..fine };
        Self { grid, values: (0..nx * ny).map(|i| self.values.get(index(i)).copied().flatten()).collect() }
    }

    /// One pass of the 3 × 3 binomial filter, 1 2 1 in both directions. Where one of two opposite neighbours has no value,
    /// neither counts, so that a plane stays what it is up to its end.
    pub fn smoothed(&self) -> Self {
        let Grid { nx, ny, .. } = self.grid;
        let at = |row: Option<usize>, column: Option<usize>| {
            let (row, column) = (row.filter(|row| *row < ny)?, column.filter(|column| *column < nx)?);
            self.values[row * nx + column]
        };
        let smooth = |(i, value): (usize, &Option<f64>)| {
            let own = (*value)?;
            let (row, column) = (i / nx, i % nx);
            let (above, below) = (Some(row + 1), row.checked_sub(1));
            let (right, left) = (Some(column + 1), column.checked_sub(1));
            let (row, column) = (Some(row), Some(column));
            let pairs = [
                (2.0, at(row, left), at(row, right)),
                (2.0, at(below, column), at(above, column)),
                (1.0, at(below, left), at(above, right)),
                (1.0, at(below, right), at(above, left)),
            ];
            let sum: f64 = pairs
                .map(|(weight, one, other)| weight * one.zip(other).map_or(2.0 * own, |(one, other)| one + other))
                .iter()
                .sum();
            Some((4.0 * own + sum) / 16.0)
        };
        Self { grid: self.grid, values: self.values.iter().enumerate().map(smooth).collect() }
    }

    /// Where the quantity is `level`, linearly between points. Cells with a corner that has no value have no line.
    pub fn contour(&self, level: f64) -> Vec<Polyline> {
        let value = |i: usize| self.values.get(i).copied().flatten();
        let crossing = |[from, to]: Edge| {
            let (low, high) = (value(from)?, value(to)?);
            let [from, to] = [from, to].map(|i| self.grid.position(i));
            Some(from + (to - from) * ((level - low) / (high - low)))
        };
        let middle =
            |corners: [usize; 4]| corners.iter().filter_map(|&i| value(i)).map(|v| v - level).sum::<f64>() > 0.0;
        trace(&self.grid, |i| Some(value(i)? > level), crossing, middle)
    }

    /// The multiples of `step` between two values. Where more than two fifths of all values lie between
    /// two neighbouring ones there is one more in their middle, so that a plain has a line too.
    pub fn levels(&self, step: f64, [low, high]: [f64; 2]) -> Vec<f64> {
        let values: Vec<f64> = self.values.iter().flatten().copied().collect();
        let (first, last) = ((low / step).ceil(), (high / step).floor());
        // Not more lines than can be told apart, and none of what has no value.
        if !(step > 0.0 && last - first < 50.0) {
            return Vec::new();
        }
        let mut levels = Vec::new();
        let mut at = first - 1.0;
        while at <= last {
            let (lower, upper) = (at * step, (at + 1.0) * step);
            if low < lower && lower < high {
                levels.push(lower);
            }
            let between = values.iter().filter(|value| (lower..upper).contains(value)).count();
            let middle = 0.5 * (lower + upper);
            if 5 * between > 2 * values.len() && low < middle && middle < high {
                levels.push(middle);
            }
            at += 1.0;
        }
        levels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(nx: usize, ny: usize, value: impl Fn(f64, f64) -> Option<f64>) -> Field {
        let grid = Grid { low: Vec2::new(-2.0, -1.0), high: Vec2::new(2.0, 1.0), nx, ny };
        let values = (0..nx * ny).map(|i| grid.position(i)).map(|at| value(at.x, at.y)).collect();
        Field { grid, values }
    }

    #[test]
    fn the_contour_of_a_plane_is_straight_and_smoothing_leaves_it() {
        let plane = field(9, 5, |x, y| Some(x + 2.0 * y));
        for field in [plane.clone(), plane.smoothed().smoothed(), plane.thinned(2)] {
            let [line] = &field.contour(0.3)[..] else { panic!("one line") };
            assert!(!line.closed && line.points.len() > 3, "{line:?}");
            assert!(line.points.iter().all(|[x, y]| (x + 2.0 * y - 0.3).abs() < 1e-12), "{line:?}");
            // From border to border.
            let ends = [line.points[0], line.points[line.points.len() - 1]];
            let at_the_border = |[x, y]: &[f64; 2]| (x.abs() - 2.0).abs().min((y.abs() - 1.0).abs()) < 1e-12;
            assert!(ends.iter().all(at_the_border), "{ends:?}");
        }
        let thin = plane.thinned(3).grid;
        assert_eq!((thin.nx, thin.ny, thin.high), (3, 2, Vec2::new(1.0, 0.5)));
    }

    #[test]
    fn the_contour_of_a_cone_is_a_circle() {
        let cone = field(81, 41, |x, y| Some(x.hypot(y)));
        for radius in [0.3, 0.71, 0.9] {
            let [circle] = &cone.contour(radius)[..] else { panic!("one circle") };
            assert!(circle.closed);
            for [x, y] in &circle.points {
                // The chord of a cell of 0.05 is that far from the circle.
                assert!((x.hypot(*y) - radius).abs() < 0.05_f64.powi(2) / radius, "{x} {y}");
            }
            let next = circle.points.iter().skip(1).chain(&circle.points[..1]);
            let round: f64 = circle.points.iter().zip(next).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
            assert!((round / (std::f64::consts::TAU * radius) - 1.0).abs() < 0.01, "{round}");
        }
    }

    #[test]
    fn a_saddle_is_parted_by_what_its_middle_is() {
        let saddle = field(2, 2, |x, y| Some(if x * y > 0.0 { 1.0 } else { -2.0 }));
        // The middle, −0.5, is low: a line around each of the two high corners.
        let lines = saddle.contour(0.0);
        assert_eq!(lines.len(), 2);
        for line in lines {
            let [[x0, y0], [x1, y1]] = line.points[..] else { panic!("two ends: {line:?}") };
            assert!((x0 + x1) * (y0 + y1) > 0.0, "{line:?}");
        }
        // Below it the low corners are the lone ones.
        for line in saddle.contour(-1.0) {
            let [[x0, y0], [x1, y1]] = line.points[..] else { panic!("two ends: {line:?}") };
            assert!((x0 + x1) * (y0 + y1) < 0.0, "{line:?}");
        }
    }

    #[test]
    fn lines_end_where_there_is_no_value() {
        let gap = field(41, 21, |x, y| (x.abs() > 0.31 || y > 0.0).then_some(y));
        let lines = gap.contour(-0.42);
        assert_eq!(lines.len(), 2, "one on each side");
        assert!(lines.iter().flat_map(|line| &line.points).all(|[x, y]| x.abs() > 0.31 && (y + 0.42).abs() < 1e-12));
        assert!(gap.smoothed().values.iter().zip(&gap.values).all(|(a, b)| a.is_some() == b.is_some()));
        let [through] = &gap.contour(0.42)[..] else { panic!("one line") };
        assert_eq!(through.points.len(), 41);
    }

    #[test]
    fn smoothing_is_the_binomial_filter() {
        let mut lone = field(7, 7, |_, _| Some(0.0));
        lone.values[24] = Some(16.0);
        let smooth = lone.smoothed().values;
        let around: Vec<f64> = [16, 17, 18, 23, 24, 25, 30, 31, 32].map(|i| smooth[i].expect("a value")).into();
        assert_eq!(around, [1.0, 2.0, 1.0, 2.0, 4.0, 2.0, 1.0, 2.0, 1.0]);
        assert!((smooth.iter().flatten().sum::<f64>() - 16.0).abs() < 1e-12);
    }

    #[test]
    fn levels_are_round_and_a_plain_has_one_more() {
        let ramp = field(41, 3, |x, _| Some(7.0 + 4.0 * x));
        assert_eq!(ramp.levels(4.0, [-1.0, 15.0]), [0.0, 4.0, 8.0, 12.0]);
        let plain = field(41, 3, |x, _| Some(if x < 0.0 { 7.0 + 4.0 * x } else { 9.0 + x }));
        assert_eq!(plain.levels(4.0, [-1.0, 11.0]), [0.0, 4.0, 8.0, 10.0]);
        assert!(
            field(3, 3, |_, _| None).levels(1.0, [0.0, 1.0]).is_empty() && ramp.levels(1e-9, [-1.0, 15.0]).is_empty()
        );
        assert!(field(3, 3, |_, _| Some(5.0)).levels(1.0, [5.0, 5.0]).is_empty());
    }
}
