//! Curves of several modes, cut where one mode ends and another begins.

use std::ops::Range;

use crate::stability::Instability;

/// What is known at one place of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The place on the abscissa.
    pub at: f64,
    /// What is drawn there, of one quantity or of two.
    pub values: [f64; 2],
    /// How stability is lost and the responsible cable, where it is about that.
    pub mode: Option<(Instability, usize)>,
}

/// A step is a jump where it is this many times what steps near it are usually like, and this part of the whole range
/// besides.
const UNUSUAL: f64 = 6.0;
const OF_RANGE: f64 = 0.03;
/// Steps that far away are near.
const NEAR: usize = 4;

/// Stretches of places between which nothing jumps, in rising order; no place is in two. Places where there is nothing
/// to draw are in none.
///
/// Neighbours belong together unless the mode changes (its kind or its cable), or a value changes by far more than it
/// does from place to place nearby.
pub fn segments(samples: &[Option<Sample>]) -> Vec<Range<usize>> {
    let ranges = [0, 1].map(|i| {
        let values = || samples.iter().flatten().map(|sample| sample.values[i]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    });
    let mut segments: Vec<Range<usize>> = Vec::new();
    for (i, sample) in samples.iter().enumerate() {
        if sample.is_none() {
            continue;
        }
        match segments.last_mut() {
            Some(last) if last.end == i && !jumps(samples, i - 1, ranges) => last.end = i + 1,
            _ => segments.push(i..i + 1),
        }
    }
    segments
}

/// Whether something jumps between this place and the next.
fn jumps(samples: &[Option<Sample>], i: usize, ranges: [f64; 2]) -> bool {
    let (Some(here), Some(next)) = (samples[i], samples[i + 1]) else { return true };
    if here.mode != next.mode {
        return true;
    }
    let near = i.saturating_sub(NEAR)..(i + NEAR + 1).min(samples.len() - 1);
    (0..2).any(|k| {
        // Places need not be equally far apart.
        let slopes = near.clone().filter(|&j| j != i).filter_map(|j| slope(samples, j, k));
        let mut slopes: Vec<f64> = slopes.collect();
        if slopes.len() < 2 {
            return false;
        }
        slopes.sort_by(f64::total_cmp);
        let usual = slopes[slopes.len() / 2] * (next.at - here.at).abs();
        (next.values[k] - here.values[k]).abs() > UNUSUAL * usual + OF_RANGE * ranges[k]
    })
}

/// How steep a value is between a place and the next, where both show the same mode.
fn slope(samples: &[Option<Sample>], i: usize, k: usize) -> Option<f64> {
    let (here, next) = (samples[i]?, samples[i + 1]?);
    let slope = ((next.values[k] - here.values[k]) / (next.at - here.at)).abs();
    (here.mode == next.mode && slope.is_finite()).then_some(slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(at: f64, value: f64) -> Sample {
        Sample { at, values: [value, 0.0], mode: Some((Instability::Flutter, 4)) }
    }

    fn curve(points: usize, value: impl Fn(f64) -> f64) -> Vec<Option<Sample>> {
        (0..points).map(|i| i as f64 / (points - 1) as f64).map(|at| Some(sample(at, value(at)))).collect()
    }

    #[test]
    fn smooth_curves_stay_whole_and_jumps_break_them() {
        for points in [21, 41, 161] {
            for smooth in [
                (|x: f64| (7.0 * x).sin()) as fn(f64) -> f64,
                |x| x.sqrt(),
                |x| (1.0 - x).sqrt(),
                |x| 1.0 / (0.1 + x),
                |x| (-8.0 * x).exp(),
                |_| 3.0,
                |x| x * x * x,
            ] {
                assert_eq!(segments(&curve(points, smooth)).as_slice(), std::slice::from_ref(&(0..points)));
            }
            for at in [3, points / 2, points - 4] {
                let jump = at as f64 / (points - 1) as f64;
                let broken = curve(points, |x| (3.0 * x).sin() + if x >= jump { 1.0 } else { 0.0 });
                assert_eq!(segments(&broken), [0..at, at..points], "{points} places");
            }
        }
        // A single place of another mode stands alone, also where kind and cable are the same.
        let mut spike = curve(41, |x| x);
        spike[20] = Some(sample(0.5, 3.0));
        assert_eq!(segments(&spike), [0..20, 20..21, 21..41]);
    }

    #[test]
    fn another_cable_or_kind_and_gaps_break_a_curve() {
        let mut samples = curve(21, |x| x);
        for sample in samples.iter_mut().skip(8).flatten() {
            sample.mode = Some((Instability::Flutter, 3));
        }
        for sample in samples.iter_mut().skip(12).flatten() {
            sample.mode = Some((Instability::Divergence, 3));
        }
        samples[16] = None;
        assert_eq!(segments(&samples), [0..8, 8..12, 12..16, 17..21]);
        assert!(segments(&[]).is_empty() && segments(&[None]).is_empty());
    }
}
