//! The border of the feasible region: on its one side the robot can rest, on the other it has no equilibrium.
//!
//! Statics alone decide. They are solved at the points of a grid. Between two neighbours of which one is feasible the edge
//! is halved again and again, so that the border is known far better than the grid is fine.

use crate::mechanics;
use crate::robot::{Robot, Vec2};
use crate::stability::bisect;
use crate::stability::steps::step;
use crate::study::Grid;

/// An edge is halved so many times: the border is known to a thousandth of it.
const HALVINGS: usize = 10;

/// The feasible region between one row of a grid's points and the next one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Strip {
    /// By point of the row: whether there is an equilibrium. `None` where that is not known.
    pub feasible: Vec<Option<bool>>,
    /// By point but the last: where the border crosses the edge to the point on the right, as a part of that edge.
    pub right: Vec<Option<f64>>,
    /// By point: the same on the edge to the point above. Empty in the last row.
    pub up: Vec<Option<f64>>,
    /// By point but the last: whether there is an equilibrium in the middle of the cell above and to the right. Only where
    /// opposite corners are alike and neighbours are not, so that the corners leave two ways to draw the border. Empty in
    /// the last row.
    pub middle: Vec<Option<bool>>,
}

impl Strip {
    /// A strip of `columns` points of which nothing is known.
    pub(super) fn unknown(columns: usize) -> Self {
        Self { feasible: vec![None; columns], right: Vec::new(), up: Vec::new(), middle: Vec::new() }
    }

    /// The strip of `grid` that begins with this row.
    pub(super) async fn new(robot: &Robot, grid: &Grid, row: usize) -> Self {
        let at = |row: usize, column: usize| grid.position(row * grid.nx + column);
        let mut feasible = Vec::with_capacity(grid.nx);
        let mut above = Vec::new();
        for column in 0..grid.nx {
            feasible.push(is_feasible(robot, at(row, column)));
            if row + 1 < grid.ny {
                above.push(is_feasible(robot, at(row + 1, column)));
            }
            step().await;
        }
        let mut strip = Self { right: Vec::new(), up: Vec::new(), middle: Vec::new(), feasible };
        for column in 0..grid.nx.saturating_sub(1) {
            let ends = [at(row, column), at(row, column + 1)];
            strip.right.push(crossing(robot, ends, [strip.feasible[column], strip.feasible[column + 1]]));
            step().await;
        }
        for (column, &upper) in above.iter().enumerate() {
            let ends = [at(row, column), at(row + 1, column)];
            strip.up.push(crossing(robot, ends, [strip.feasible[column], upper]));
            step().await;
        }
        for column in 0..above.len().saturating_sub(1) {
            let [a, b] = [strip.feasible[column], strip.feasible[column + 1]];
            let [d, c] = [above[column], above[column + 1]];
            let saddle = a == c && b == d && a != b && a.is_some() && b.is_some();
            let middle = 0.5 * (at(row, column) + at(row + 1, column + 1));
            strip.middle.push(if saddle { is_feasible(robot, middle) } else { None });
        }
        strip
    }
}

/// Whether the robot has an equilibrium at `position`; `None` where that is not known.
fn is_feasible(robot: &Robot, position: Vec2) -> Option<bool> {
    if !position.iter().all(|coordinate| coordinate.is_finite()) {
        return Some(false);
    }
    match mechanics::solve(robot, position) {
        Ok(_) => Some(true),
        Err(failure) => failure.reason.feasible(),
    }
}

/// Where the border crosses an edge from one end to the other, of which is known whether they are feasible.
fn crossing(robot: &Robot, [from, to]: [Vec2; 2], feasible: [Option<bool>; 2]) -> Option<f64> {
    let [Some(first), Some(last)] = feasible else { return None };
    (first != last).then(|| {
        let is_like_first = |part: f64| is_feasible(robot, from + (to - from) * part) == Some(first);
        let [low, high] = bisect([0.0, 1.0], HALVINGS, is_like_first);
        0.5 * (low + high)
    })
}
