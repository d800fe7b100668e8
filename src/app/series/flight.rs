//! What plots of a flight show, as points and sentences.

use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::series::effect;
use crate::flight::{Flight, Sample};

/// The sample that is nearest to a time in s.
pub fn nearest_sample(flight: &Flight, time: f64) -> Option<&Sample> {
    flight.samples.iter().min_by(|a, b| (a.time - time).abs().total_cmp(&(b.time - time).abs()))
}

/// The tension of every cable at the platform, as points (s, N).
pub fn tensions(flight: &Flight) -> Vec<Vec<[f64; 2]>> {
    let cables = flight.samples.first().map_or(0, |sample| sample.cables.len());
    let of_cable = |i: usize| flight.samples.iter().filter_map(move |s| Some([s.time, s.cables.get(i)?.tension]));
    (0..cables).map(|i| of_cable(i).collect()).collect()
}

/// The first swing of the platform after the beginning, as time (s) and size (mm): the first largest distance from the path.
pub fn first_swing(flight: &Flight) -> Option<[f64; 2]> {
    let sizes: Vec<[f64; 2]> =
        flight.samples.iter().map(|sample| [sample.time, 1e3 * sample.deviation.norm()]).collect();
    sizes
        .windows(3)
        .find(|three| three[1][1] > 0.0 && three[0][1] <= three[1][1] && three[1][1] > three[2][1])
        .map(|three| three[1])
}

/// What frozen time predicts of a kick's first swing, as points (s, mm) times `sign`; nothing of a flight without a kick, and
/// where the growth rates along the path are not known.
pub fn envelope(facts: Facts<'_>, flight: &Flight, sign: f64) -> Vec<[f64; 2]> {
    let Some((effect, true)) = effect(facts) else { return Vec::new() };
    let kicked = flight.samples.first().is_some_and(|first| first.deviation_velocity.norm() > 0.0);
    let Some([begin, size]) = first_swing(flight).filter(|_| kicked) else { return Vec::new() };
    let growth = &effect.growth;
    let at = |time: f64| {
        let after = growth.partition_point(|point| point[0] < time).clamp(1, growth.len().saturating_sub(1).max(1));
        let (Some(a), Some(b)) = (growth.get(after - 1), growth.get(after)) else { return 0.0 };
        let part = if b[0] > a[0] { ((time - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0) } else { 0.0 };
        a[1] + part * (b[1] - a[1])
    };
    let from = at(begin);
    let later = growth.iter().filter(|point| point[0] > begin).map(|point| [point[0], point[1] - from]);
    std::iter::once([begin, 0.0]).chain(later).map(|[time, log]| [time, sign * size * log.exp()]).collect()
}

/// The part of a curve before it leaves `range` for the first time.
pub fn kept_within(curve: &[[f64; 2]], [low, high]: [f64; 2]) -> Vec<[f64; 2]> {
    let reach = 2.0 * (high - low);
    curve.iter().copied().take_while(|point| (low - reach..=high + reach).contains(&point[1])).collect()
}

/// How far the platform is off its path, in a sentence.
pub fn wobble(flight: &Flight) -> String {
    let largest = digits::certain(1e3 * flight.max_deviation, None);
    let after = flight.residual.map_or_else(String::new, |residual| {
        format!(", {} mm at most after the stop", digits::certain(1e3 * residual, None))
    });
    format!("the platform is off its path by {largest} mm at most{after}.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Vec2;

    fn flight(deviations: &[f64]) -> Flight {
        let sample = |(i, x): (usize, &f64)| Sample {
            time: i as f64,
            s: 0.0,
            v: 0.0,
            a: 0.0,
            position: Vec2::zeros(),
            deviation: Vec2::new(*x, 0.0),
            deviation_velocity: Vec2::zeros(),
            smallest_element_force: 1.0,
            cables: Vec::new(),
        };
        let samples: Vec<Sample> = deviations.iter().enumerate().map(sample).collect();
        let end = samples.len() as f64 - 1.0;
        Flight {
            duration: end,
            end,
            max_deviation: 0.0102,
            residual: Some(0.0034),
            slack: None,
            lost: None,
            steps: 1,
            samples,
        }
    }

    #[test]
    fn the_first_swing_is_the_first_largest_distance_on_either_side() {
        assert_eq!(first_swing(&flight(&[0.0, -0.004, -0.001, 0.009, 0.0])), Some([1.0, 4.0]));
        assert_eq!(first_swing(&flight(&[0.0, 0.001, 0.002])), None);
        assert_eq!(nearest_sample(&flight(&[0.0; 5]), 3.4).map(|sample| sample.s), Some(0.0));
        assert_eq!(nearest_sample(&flight(&[0.0, 0.1, 0.2]), 1.6).map(|sample| sample.time), Some(2.0));
    }

    #[test]
    fn curves_end_where_they_leave_the_picture() {
        let curve = [[0.0, 1.0], [1.0, 2.0], [2.0, 90.0], [3.0, 1.0]];
        assert_eq!(kept_within(&curve, [0.0, 3.0]), curve[..2]);
    }

    #[test]
    fn deviations_are_told_in_millimetres() {
        assert_eq!(
            wobble(&flight(&[0.0])),
            "the platform is off its path by 10.2 mm at most, 3.40 mm at most after the stop."
        );
    }
}
