//! The feasible region as it is drawn: its border in long lines, and what lies outside of it in convex pieces. World
//! coordinates, no colours.

use super::contours::{Polyline, cells, trace};
use crate::app::studies::StudyResults;
use crate::robot::Vec2;
use crate::study::{Answer, Grid, Strip, Study};

/// The feasible region of a robot.
#[derive(Clone, Debug)]
pub struct Region {
    /// Its border.
    pub border: Vec<Polyline>,
    /// Convex pieces that cover what lies outside of it; corners in m, one after the other round the piece.
    pub outside: Vec<Vec<[f64; 2]>>,
}

impl Region {
    /// The region, where `known` is a border that is known everywhere.
    pub fn new(known: &StudyResults) -> Option<Self> {
        let Study::Border { grid } = &known.request.study else { return None };
        let strips: Option<Vec<&Strip>> = known
            .places
            .iter()
            .map(|answer| match answer {
                Some(Answer::Border(strip)) => Some(strip),
                _ => None,
            })
            .collect();
        let found = Found { grid, strips: strips? };
        let border = trace(grid, |i| found.feasible(i), |edge| found.crossing(edge), |corners| found.middle(corners));
        Some(Self { border, outside: found.outside() })
    }
}

/// The answers of a border, by the points of its grid.
struct Found<'a> {
    grid: &'a Grid,
    strips: Vec<&'a Strip>,
}

impl Found<'_> {
    /// The strip and the column of a point.
    fn strip(&self, point: usize) -> Option<(&Strip, usize)> {
        Some((self.strips.get(point / self.grid.nx)?, point % self.grid.nx))
    }

    fn feasible(&self, point: usize) -> Option<bool> {
        let (strip, column) = self.strip(point)?;
        strip.feasible.get(column).copied().flatten()
    }

    fn crossing(&self, [from, to]: [usize; 2]) -> Option<Vec2> {
        let (strip, column) = self.strip(from)?;
        let edges = if to == from + 1 { &strip.right } else { &strip.up };
        let part = edges.get(column).copied().flatten()?;
        let [from, to] = [from, to].map(|point| self.grid.position(point));
        Some(from + (to - from) * part)
    }

    /// Whether the middle of a cell is feasible; where that is not known, it is taken to be not.
    fn middle(&self, [first, ..]: [usize; 4]) -> bool {
        let known = self.strip(first).and_then(|(strip, column)| strip.middle.get(column).copied().flatten());
        known == Some(true)
    }

    /// What of each cell lies outside. Cells of a row that are so as a whole make one piece.
    fn outside(&self) -> Vec<Vec<[f64; 2]>> {
        let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
        // The last cell of the last piece, where it is a whole one.
        let mut last_whole = None;
        for corners in cells(self.grid) {
            let [Some(a), Some(b), Some(c), Some(d)] = corners.map(|corner| self.feasible(corner)) else { continue };
            let sides = [a, b, c, d];
            let at = corners.map(|corner| <[f64; 2]>::from(self.grid.position(corner)));
            if sides == [false; 4] {
                let goes_on = last_whole == Some(corners[0].wrapping_sub(1)) && corners[0] % self.grid.nx > 0;
                match pieces.last_mut().filter(|_| goes_on) {
                    Some(piece) => (piece[1], piece[2]) = (at[1], at[2]),
                    None => pieces.push(at.to_vec()),
                }
                last_whole = Some(corners[0]);
                continue;
            }
            let crossing = |side: usize| {
                let [from, to] = [corners[side], corners[(side + 1) % 4]];
                self.crossing([from.min(to), from.max(to)]).map(<[f64; 2]>::from)
            };
            // Two opposite corners outside, and the middle not: each is a piece of its own.
            let saddle = a == c && b == d && a != b;
            if saddle && self.middle(corners) {
                let lone = (0..4).filter(|&corner| !sides[corner]);
                pieces.extend(
                    lone.filter_map(|corner| Some(vec![crossing((corner + 3) % 4)?, at[corner], crossing(corner)?])),
                );
                continue;
            }
            let mut piece = Vec::new();
            for side in 0..4 {
                piece.extend((!sides[side]).then_some(at[side]));
                piece.extend(crossing(side));
            }
            if piece.len() > 2 {
                pieces.push(piece);
            }
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::studies::StudyRequest;
    use crate::scenario::presets;

    /// The border of a region that is told by the sign of `height`, which is linear along each edge.
    fn known(grid: Grid, height: impl Fn(Vec2) -> f64) -> StudyResults {
        let at = |row: usize, column: usize| grid.position(row * grid.nx + column);
        let crossing = |from: Vec2, to: Vec2| {
            let [low, high] = [from, to].map(&height);
            ((low > 0.0) != (high > 0.0)).then(|| low / (low - high))
        };
        let strip = |row: usize| Strip {
            feasible: (0..grid.nx).map(|column| Some(height(at(row, column)) > 0.0)).collect(),
            right: (1..grid.nx).map(|column| crossing(at(row, column - 1), at(row, column))).collect(),
            up: (0..grid.nx * usize::from(row + 1 < grid.ny))
                .map(|column| crossing(at(row, column), at(row + 1, column)))
                .collect(),
            middle: (1..grid.nx)
                .map(|column| Some(height(0.5 * (at(row, column - 1) + at(row + 1, column))) > 0.0))
                .collect(),
        };
        let places = (0..grid.ny).map(|row| Some(Answer::Border(strip(row)))).collect();
        let request = StudyRequest::new(&presets::PRESETS[0].scenario(), Study::Border { grid });
        StudyResults { request, places, version: (1, 1) }
    }

    fn area(piece: &[[f64; 2]]) -> f64 {
        let next = piece.iter().skip(1).chain(&piece[..1]);
        0.5 * piece.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
    }

    #[test]
    fn border_and_outside_are_those_of_a_rhombus() {
        let grid = Grid { low: Vec2::new(-4.0, -4.0), high: Vec2::new(4.0, 4.0), nx: 17, ny: 17 };
        let region = Region::new(&known(grid, |at| 3.2 - at.x.abs() - at.y.abs())).expect("a border");
        let [border] = &region.border[..] else { panic!("one line") };
        assert!(border.closed);
        assert!(border.points.iter().all(|[x, y]| (x.abs() + y.abs() - 3.2).abs() < 1e-12), "{border:?}");
        // Every piece is convex and goes round in the same way, and together they are all but the rhombus.
        assert!(region.outside.iter().all(|piece| area(piece) > 0.0));
        let total: f64 = region.outside.iter().map(|piece| area(piece)).sum();
        assert!((total - (64.0 - 2.0 * 3.2 * 3.2)).abs() < 1e-9, "{total}");
        for piece in &region.outside {
            for i in 0..piece.len() {
                let [a, b, c] = [i, i + 1, i + 2].map(|j| piece[j % piece.len()]);
                assert!((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > -1e-12, "{piece:?}");
            }
        }
        // The first row is one piece.
        assert!((area(&region.outside[0]) - 8.0 * 0.5).abs() < 1e-12);
    }

    #[test]
    fn saddles_and_gaps() {
        let grid = Grid { low: Vec2::new(-1.0, -1.0), high: Vec2::new(1.0, 1.0), nx: 2, ny: 2 };
        for (shift, pieces) in [(0.1, 2), (-0.1, 1)] {
            // Feasible where x y > −shift: with shift > 0 the middle is.
            let region = Region::new(&known(grid, |at| at.x * at.y + shift)).expect("a border");
            assert_eq!((region.border.len(), region.outside.len()), (2, pieces));
            let total: f64 = region.outside.iter().map(|piece| area(piece)).sum();
            // Either two triangles with legs of 0.9 are outside, or two such triangles are all that is inside.
            let expected = if shift > 0.0 { 0.81 } else { 4.0 - 0.81 };
            assert!((total - expected).abs() < 1e-12, "{total} {expected}");
        }
        let mut gap = known(grid, |at| at.x);
        gap.places[1] = None;
        assert!(Region::new(&gap).is_none());
        let mut unknown = known(grid, |at| at.x);
        let strip = Strip { feasible: vec![None; 2], right: vec![None], up: vec![None; 2], middle: vec![None] };
        unknown.places[0] = Some(Answer::Border(strip));
        let region = Region::new(&unknown).expect("a border");
        assert!(region.border.is_empty() && region.outside.is_empty());
    }
}
