//! The Campbell diagram: the spectra of successive speeds joined to modes.
//!
//! Each mode's next eigenvalue is predicted from its last two, and the eigenvalues found are given to the modes so that
//! the squares of the errors add up to the least. Modes that come near each other or cross in frequency are told apart
//! by that, where the speeds lie close enough. An overdamped pair is two real eigenvalues: one goes on the pair's
//! line, the other begins a new one, and where two real ones join to a pair, one of their lines ends.

use nalgebra::Complex;

use crate::stability::steps::{finish, step};

type C64 = Complex<f64>;

/// A mode's next eigenvalue differs from the prediction by at most this part of its size …
const NEAR: f64 = 0.25;
/// … and by at most this many times the mode's last step.
const STEPS: f64 = 4.0;
/// Of a mode without a step yet it differs by at most this part of its size.
const NEAR_AT_FIRST: f64 = 0.5;

/// One mode over the speeds at which it exists.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Track {
    /// Speed in m/s and eigenvalue in 1/s, at successive speeds of the study.
    pub points: Vec<(f64, Complex<f64>)>,
}

/// Joins `spectra`, each the eigenvalues (1/s) at a speed (m/s), the speeds rising, to modes.
///
/// Every eigenvalue with Im λ ≥ 0 belongs to exactly one track; those with Im λ < 0 mirror them and are left out. The
/// tracks come in the order in which they begin, at one speed in the order of its spectrum. Nothing is made up: a
/// track ends where no eigenvalue goes on with it, and a speed whose spectrum is not known is best left out.
pub fn track(spectra: &[(f64, Vec<Complex<f64>>)]) -> Vec<Track> {
    finish(track_in_steps(spectra))
}

/// The same in [steps](crate::stability::steps) of one mode at one speed.
pub async fn track_in_steps(spectra: &[(f64, Vec<Complex<f64>>)]) -> Vec<Track> {
    let mut tracks: Vec<Track> = Vec::new();
    // Those that reach the speed before.
    let mut active: Vec<usize> = Vec::new();
    for (speed, eigenvalues) in spectra {
        let values: Vec<C64> = eigenvalues.iter().copied().filter(|value| value.im >= 0.0).collect();
        let heads: Vec<Head> = active.iter().map(|&i| Head::new(&tracks[i], *speed)).collect();
        let successor = join(&heads, &values).await;
        let mut taken: Vec<Option<usize>> = vec![None; values.len()];
        for (&i, value) in active.iter().zip(successor) {
            if let Some(j) = value {
                taken[j] = Some(i);
            }
        }
        active = Vec::with_capacity(values.len());
        for (value, track) in values.into_iter().zip(taken) {
            let i = track.unwrap_or(tracks.len());
            if track.is_none() {
                tracks.push(Track { points: Vec::new() });
            }
            tracks[i].points.push((*speed, value));
            active.push(i);
        }
        step().await;
    }
    tracks
}

/// Where a track is and where it goes.
struct Head {
    real: bool,
    predicted: C64,
    /// How far off the prediction may be, apart from a part of the eigenvalue's size.
    slack: f64,
    near: f64,
}

impl Head {
    fn new(track: &Track, speed: f64) -> Self {
        let Some(&(last_speed, last)) = track.points.last() else {
            return Self { real: false, predicted: C64::new(0.0, 0.0), slack: 0.0, near: 0.0 };
        };
        let real = last.im == 0.0;
        let before = track.points.len().checked_sub(2).map(|i| track.points[i]);
        // Where a pair splits or joins, the slope jumps.
        let before = before.filter(|(before_speed, value)| (value.im == 0.0) == real && *before_speed < last_speed);
        let Some((before_speed, before)) = before else {
            return Self { real, predicted: last, slack: 0.0, near: NEAR_AT_FIRST };
        };
        let step = (last - before) * ((speed - last_speed) / (last_speed - before_speed));
        let mut predicted = last + step;
        // What would cross the real axis meets its mirror image there.
        predicted.im = predicted.im.max(0.0);
        Self { real, predicted, slack: STEPS * step.norm(), near: NEAR }
    }

    /// The square of the prediction's error, and whether it is small enough for `value` to be the next one; beyond
    /// that all are equally far.
    fn cost(&self, value: C64) -> (f64, bool) {
        let reach = self.slack + self.near * self.predicted.norm().max(value.norm());
        let error = (value - self.predicted).norm();
        (error.min(reach).powi(2), error <= reach)
    }
}

/// For each head the index of its next value, if any.
async fn join(heads: &[Head], values: &[C64]) -> Vec<Option<usize>> {
    let mut successor = vec![None; heads.len()];
    let mut free = vec![true; values.len()];
    // Pairs go on as pairs; what is left over has met the real axis or comes from there.
    for pairs_only in [true, false] {
        let rows: Vec<usize> =
            (0..heads.len()).filter(|&i| successor[i].is_none() && !(pairs_only && heads[i].real)).collect();
        let columns: Vec<usize> =
            (0..values.len()).filter(|&j| free[j] && !(pairs_only && values[j].im == 0.0)).collect();
        let cost = |row: usize, column: usize| heads[rows[row]].cost(values[columns[column]]);
        let pairs = assign(rows.len(), columns.len(), &|row, column| cost(row, column).0).await;
        for (row, column) in pairs {
            if cost(row, column).1 {
                successor[rows[row]] = Some(columns[column]);
                free[columns[column]] = false;
            }
        }
    }
    successor
}

/// Pairs (row, column), as many as there are of the fewer, each row and column at most once, at the least sum of costs;
/// in steps of one row or column.
async fn assign(rows: usize, columns: usize, cost: &(impl Fn(usize, usize) -> f64 + Sync)) -> Vec<(usize, usize)> {
    if rows <= columns {
        return assign_rows(rows, columns, cost).await;
    }
    let transposed = assign_rows(columns, rows, &|column, row| cost(row, column)).await;
    transposed.into_iter().map(|(column, row)| (row, column)).collect()
}

/// The same where there are no more rows than columns.
async fn assign_rows(rows: usize, columns: usize, cost: &(impl Fn(usize, usize) -> f64 + Sync)) -> Vec<(usize, usize)> {
    // The Hungarian method: row by row, the shortest path through costs reduced by potentials to a free column. The
    // column beyond the last stands for the row that is being added.
    let (none, start) = (rows, columns);
    let mut row_potential = vec![0.0; rows];
    let mut column_potential = vec![0.0; columns + 1];
    let mut row_of = vec![none; columns + 1];
    for added in 0..rows {
        row_of[start] = added;
        let mut shortest = vec![f64::INFINITY; columns];
        let mut from = vec![start; columns];
        let mut done = vec![false; columns + 1];
        let mut at = start;
        while row_of[at] != none {
            done[at] = true;
            let row = row_of[at];
            let mut nearest = (f64::INFINITY, start);
            for column in (0..columns).filter(|&column| !done[column]) {
                let reduced = cost(row, column) - row_potential[row] - column_potential[column];
                if reduced < shortest[column] {
                    shortest[column] = reduced;
                    from[column] = at;
                }
                if nearest.1 == start || shortest[column] < nearest.0 {
                    nearest = (shortest[column], column);
                }
            }
            for column in (0..=columns).filter(|&column| done[column]) {
                row_potential[row_of[column]] += nearest.0;
                column_potential[column] -= nearest.0;
            }
            for column in (0..columns).filter(|&column| !done[column]) {
                shortest[column] -= nearest.0;
            }
            at = nearest.1;
        }
        // Along the path each row moves on by one column.
        while at != start {
            let before = from[at];
            row_of[at] = row_of[before];
            at = before;
        }
        step().await;
    }
    (0..columns).filter(|&column| row_of[column] != none).map(|column| (row_of[column], column)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::steps::finish_watched;

    #[test]
    fn assignments_have_the_least_sum() {
        // All costs of three rows and four columns, against every choice.
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 24)
        };
        for _ in 0..200 {
            let costs: Vec<f64> = (0..12).map(|_| random()).collect();
            let mut least = f64::INFINITY;
            for a in 0..4 {
                for b in (0..4).filter(|b| *b != a) {
                    for c in (0..4).filter(|c| *c != a && *c != b) {
                        least = least.min(costs[a] + costs[4 + b] + costs[8 + c]);
                    }
                }
            }
            let wide = finish(assign(3, 4, &|row, column| costs[4 * row + column]));
            let tall = finish(assign(4, 3, &|row, column| costs[4 * column + row]));
            for (sum, pairs) in [
                (wide.iter().map(|&(row, column)| costs[4 * row + column]).sum::<f64>(), &wide),
                (tall.iter().map(|&(row, column)| costs[4 * column + row]).sum(), &tall),
            ] {
                assert_eq!((sum, pairs.len()), (least, 3));
            }
        }
        for (rows, columns) in [(0, 3), (3, 0)] {
            assert!(finish(assign(rows, columns, &|_, _| 1.0)).is_empty());
        }
    }

    /// Joining one speed's modes takes up to the cube of their number.
    #[test]
    fn modes_are_joined_in_steps_of_one_mode() {
        let (speeds, modes) = (4, 7);
        let spectrum = |k: i32| (1..=modes).map(|j| C64::new(-0.1, f64::from(j) + 0.01 * f64::from(k))).collect();
        let spectra: Vec<(f64, Vec<C64>)> = (0..speeds).map(|k| (f64::from(k), spectrum(k))).collect();
        let mut steps = 0;
        let tracks = finish_watched(track_in_steps(&spectra), || steps += 1);
        assert_eq!((tracks.len(), tracks[0].points.len()), (7, 4));
        // None of the first speed's modes has anything to be joined to.
        assert_eq!(steps, speeds + (speeds - 1) * modes);
    }
}
