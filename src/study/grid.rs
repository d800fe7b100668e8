//! Where studies look: points of the workspace, of a line through it, of an interval; and in which order.

use crate::robot::{BoundingBox, Motion, Robot, Vec2};

/// Every so-many-th point of a row or column comes first.
const COARSEST: usize = 8;

/// The `index`-th of `count` numbers, equally spaced from `from` to `to`, both included; the middle where there is but
/// one.
pub fn evenly(from: f64, to: f64, index: usize, count: usize) -> f64 {
    let last = count.saturating_sub(1);
    if last == 0 {
        return 0.5 * from + 0.5 * to;
    }
    if index == 0 {
        return from;
    }
    if index >= last {
        return to;
    }
    // One rounding where the products are exact, so that 0, 0.1, 0.2 … are what they look like; and seen in a mirror
    // the same numbers.
    let (before, after, last) = (index as f64, (last - index) as f64, last as f64);
    let middle = (from * after + to * before) / last;
    let middle = if middle.is_finite() { middle } else { from * (after / last) + to * (before / last) };
    middle.max(from.min(to)).min(from.max(to))
}

/// The workspace: the bounding box of all anchors, its lower left and upper right corner in m. Where all anchors are
/// in a line along an axis, it has some width all the same.
pub fn workspace(robot: &Robot) -> [Vec2; 2] {
    let first = robot.cables[0].anchor;
    let around = BoundingBox::of(robot.cables.iter().map(|cable| cable.anchor));
    let BoundingBox { low, high } = around.unwrap_or(BoundingBox { low: first, high: first }).with_area();
    [low, high]
}

/// The indices of `columns` × `rows` points, row by row, those of a coarse picture first: every 8th of every 8th row,
/// then every 4th, every 2nd, all. Each index once.
pub(super) fn coarse_first(columns: usize, rows: usize) -> Vec<usize> {
    let mut order = Vec::with_capacity(columns * rows);
    let mut step = COARSEST;
    while step > 0 {
        for row in (0..rows).step_by(step) {
            for column in (0..columns).step_by(step) {
                let earlier = step < COARSEST && row % (2 * step) == 0 && column % (2 * step) == 0;
                if !earlier {
                    order.push(row * columns + column);
                }
            }
        }
        step /= 2;
    }
    order
}

/// The same for points in a row.
pub(super) fn coarse_first_in_a_row(count: usize) -> Vec<usize> {
    coarse_first(count, 1)
}

/// Equally spaced points of a rectangle, the border included.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Grid {
    /// The lower left corner in m.
    pub low: Vec2,
    /// The upper right corner in m.
    pub high: Vec2,
    /// Points in a row.
    pub nx: usize,
    /// Rows.
    pub ny: usize,
}

impl Grid {
    /// `nx` × `ny` points of the [`workspace`].
    pub fn of(robot: &Robot, nx: usize, ny: usize) -> Self {
        let [low, high] = workspace(robot);
        Self { low, high, nx, ny }
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.nx.saturating_mul(self.ny)
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The `index`-th point in m: along the rows, from the lowest one up. With one point in a dimension it is in the
    /// middle.
    pub fn position(&self, index: usize) -> Vec2 {
        let (column, row) = (index % self.nx.max(1), index / self.nx.max(1));
        let [x, y] =
            [(0, column, self.nx), (1, row, self.ny)].map(|(i, at, n)| evenly(self.low[i], self.high[i], at, n));
        Vec2::new(x, y)
    }

    /// All indices, each once, coarse to fine: every 8th point of every 8th row first, then every 4th, every 2nd, all.
    pub fn coarse_first(&self) -> Vec<usize> {
        coarse_first(self.nx, self.ny)
    }
}

/// Equally spaced points along a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Line {
    /// Where it begins, in m.
    pub from: Vec2,
    /// Where it ends, in m.
    pub to: Vec2,
    /// The unit vector of the motion, from the one to the other.
    pub direction: Vec2,
    /// How many points.
    pub count: usize,
}

impl Line {
    /// `count` points of the line on which `motion` goes, from border to border of the [`workspace`], which is
    /// stretched to the platform where that is outside.
    pub fn through(robot: &Robot, motion: &Motion, count: usize) -> Self {
        let (position, direction) = (motion.position(), motion.direction());
        let [low, high] = workspace(robot);
        let (low, high) = (low.inf(&position), high.sup(&position));
        // The nearest border behind and ahead. A coordinate that does not change meets none; along one that hardly
        // does, a quotient may leave the range of numbers, and the other coordinate's border is nearer.
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        for i in 0..2 {
            if direction[i] != 0.0 {
                let [a, b] = [low, high].map(|border| (border[i] - position[i]) / direction[i]);
                from = from.max(a.min(b));
                to = to.min(a.max(b));
            }
        }
        let at = |s: f64| (position + s * direction).sup(&low).inf(&high);
        Self { from: at(from), to: at(to), direction, count }
    }

    /// The `index`-th point in m.
    pub fn position(&self, index: usize) -> Vec2 {
        let [x, y] = [0, 1].map(|i| evenly(self.from[i], self.to[i], index, self.count));
        Vec2::new(x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{paper, paper_spec};

    #[test]
    fn numbers_are_spaced_as_one_would_write_them() {
        let tenths: Vec<f64> = (0..11).map(|i| evenly(0.0, 1.0, i, 11)).collect();
        assert_eq!(tenths, [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]);
        assert_eq!((evenly(1.0, 4.0, 0, 1), evenly(0.1, 0.1, 1, 3)), (2.5, 0.1));
        for i in 0..7 {
            // To the last bit, and without a minus before zero.
            let sum = evenly(-0.3, 0.3, i, 7) + evenly(-0.3, 0.3, 6 - i, 7);
            assert_eq!(sum.to_bits(), 0);
        }
        let far = vec![evenly(-1e308, 1e308, 1, 5), evenly(1e308, 1.5e308, 1, 3)];
        assert_eq!(far, [-0.5e308, 1.25e308]);
    }

    #[test]
    fn the_grid_spans_the_anchors() {
        let robot = paper().expect("the paper's robot");
        let grid = Grid::of(&robot, 41, 21);
        let at = |column: usize, row: usize| grid.position(row * 41 + column);
        assert_eq!((grid.len(), at(0, 0), at(40, 20)), (861, Vec2::new(-10.0, -5.0), Vec2::new(10.0, 5.0)));
        assert_eq!((at(24, 10), at(40, 0)), (Vec2::new(2.0, 0.0), Vec2::new(10.0, -5.0)));
        assert_eq!(Grid::of(&robot, 1, 1).position(0), Vec2::zeros());
        assert!(Grid::of(&robot, 0, 3).is_empty());
        let mut flat = paper_spec();
        for (i, cable) in flat.cables.iter_mut().enumerate() {
            cable.anchor = Vec2::new(10.0 * i as f64, 3.0);
        }
        let flat = Robot::new(flat).expect("a robot");
        assert_eq!(workspace(&flat), [Vec2::new(0.0, 0.0), Vec2::new(30.0, 6.0)]);
    }

    #[test]
    fn lines_go_from_border_to_border() {
        let robot = paper().expect("the paper's robot");
        let ends = |position: [f64; 2], direction: [f64; 2]| {
            let line = Line::through(&robot, &Motion::new(position, direction, 1.0).expect("a motion"), 3);
            [line.position(0), line.position(2)].map(|p| [p.x, p.y])
        };
        assert_eq!(ends([2.0, 1.0], [1.0, 0.0]), [[-10.0, 1.0], [10.0, 1.0]]);
        assert_eq!(ends([2.0, 1.0], [-3.0, 0.0]), [[10.0, 1.0], [-10.0, 1.0]]);
        assert_eq!(ends([2.0, 1.0], [0.0, -1.0]), [[2.0, 5.0], [2.0, -5.0]]);
        let [from, to] = ends([0.0, 0.0], [1.0, 1.0]);
        for (end, at) in [(from, -5.0), (to, 5.0)] {
            assert!(end.iter().all(|coordinate| (coordinate - at).abs() < 1e-12), "{end:?}");
        }
        // Outside, and in a direction that hardly leaves an axis.
        assert_eq!(ends([12.0, 0.0], [1.0, 0.0]), [[-10.0, 0.0], [12.0, 0.0]]);
        assert_eq!(ends([12.0, 5.0], [0.0, 1.0]), [[12.0, -5.0], [12.0, 5.0]]);
        let [from, to] = ends([0.0, 0.0], [1.0, 1e-320]);
        assert_eq!((from[0], to[0]), (-10.0, 10.0));
        assert!(ends([10.0, 5.0], [1.0, -1.0]).iter().flatten().all(|c| c.is_finite()));
    }
}
