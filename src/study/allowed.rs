//! The fastest move along a path that keeps to the machine's limits and below the local ones, and how much faster or slower
//! another profile has to be to keep to the same limits.

use crate::flight::{FastestMove, INTERVALS, LimitOptions, Place, legs, limits};
use crate::robot::{Robot, Side, Trajectory};
use crate::stability::steps::step;

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Allowed {
    /// The limits that act.
    pub options: LimitOptions,
    /// Frozen critical speeds along the path, as arc length (m) and speed (m/s) in rising order of arc length; empty where
    /// they are no limit.
    pub frozen: Vec<(f64, Option<f64>)>,
}

/// What comes of it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Fastest {
    /// The fastest move.
    pub found: FastestMove,
    /// By which factor the present profile can be faster, or has to be slower, so that it keeps to the same limits.
    pub scale: f64,
}

impl Allowed {
    /// The fastest move along the path of `trajectory`, and the factor of its profile, in [steps](crate::steps).
    ///
    /// # Errors
    /// Why there is none, with the place: see [`limits`].
    pub async fn fastest_in_steps(&self, robot: &Robot, trajectory: &Trajectory) -> Result<Fastest, String> {
        let mut places = Vec::new();
        for leg in legs(trajectory, INTERVALS) {
            let mut of_leg = Vec::with_capacity(leg.len());
            for (s, point) in leg {
                let place = Place::at(robot, s, &point).map_err(|reason| reason.to_string())?;
                of_leg.push(Place { critical_speed: self.frozen_at(s), ..place });
                step().await;
            }
            places.push(of_leg);
        }
        let found = limits(&places, &self.options).map_err(|reason| reason.to_string())?;
        let scale = places.iter().map(|places| self.scale(trajectory, places)).fold(f64::INFINITY, f64::min);
        Ok(Fastest { found, scale })
    }

    /// The frozen critical speed at arc length `s`: between two places that are known the lower one of them.
    fn frozen_at(&self, s: f64) -> Option<f64> {
        let after = self.frozen.partition_point(|(at, _)| *at < s);
        let around = self.frozen.get(after.saturating_sub(1)..(after + 1).min(self.frozen.len()))?;
        around.iter().filter_map(|(_, speed)| *speed).min_by(f64::total_cmp)
    }

    /// By which factor the profile of `trajectory` can be faster over the places of a leg: time t becomes t/factor, so that
    /// v grows by the factor, and s̈ and L̈ by its square.
    fn scale(&self, trajectory: &Trajectory, places: &[Place]) -> f64 {
        let (Some(first), Some(last)) = (places.first(), places.last()) else { return f64::INFINITY };
        let samples = 8 * INTERVALS;
        let mut scale = f64::INFINITY;
        for i in 0..=samples {
            for side in [Side::Left, Side::Right] {
                let moment = trajectory.at(trajectory.duration() * i as f64 / samples as f64, side);
                if moment.s < first.s || moment.s > last.s {
                    continue;
                }
                let next = places.partition_point(|place| place.s < moment.s).min(places.len() - 1);
                for place in [&places[next.saturating_sub(1)], &places[next]] {
                    scale = scale.min(self.scale_at(place, moment.v, moment.a));
                }
            }
        }
        scale
    }

    /// The same of one place that is passed with the speed v (m/s) and the acceleration a (m/s²).
    fn scale_at(&self, place: &Place, v: f64, a: f64) -> f64 {
        let LimitOptions { safety, frozen, waves, slack, acceleration, winch_speed, winch_acceleration } = self.options;
        // What it is limited to over what it is, where it is anything.
        let ratio = |limit: Option<f64>, value: f64| {
            limit.filter(|_| value.abs() > 0.0).map_or(f64::INFINITY, |limit| limit / value.abs())
        };
        let local = [place.wave_limit.filter(|_| waves), place.critical_speed.filter(|_| frozen)];
        let mut of_speed =
            local.map(|limit| ratio(limit.map(|limit| safety * limit), v)).into_iter().fold(f64::INFINITY, f64::min);
        let of_slack = place.slack.and_then(|slack| if a < 0.0 { slack.braking } else { slack.accelerating });
        let of_slack = slack.zip(of_slack).map(|(share, limit)| share * limit.value);
        let mut of_acceleration = ratio(acceleration, a).min(ratio(of_slack, a));
        for rates in &place.rates {
            of_speed = of_speed.min(ratio(winch_speed, rates.first * v));
            of_acceleration = of_acceleration.min(ratio(winch_acceleration, rates.first * a + rates.second * v * v));
        }
        of_speed.min(of_acceleration.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Profile, Vec2, paper};
    use crate::stability::steps::finish;

    fn asked() -> Allowed {
        let options = LimitOptions {
            safety: 0.8,
            frozen: false,
            waves: true,
            slack: None,
            acceleration: Some(6.0),
            winch_speed: None,
            winch_acceleration: None,
        };
        Allowed { options, frozen: Vec::new() }
    }

    fn across(speed: f64) -> Trajectory {
        let (start, end) = (Vec2::new(-6.0, 0.0), Vec2::new(6.0, 0.0));
        Trajectory::straight(start, &[end], Profile::Quintic { speed }).expect("a path")
    }

    fn fastest(allowed: &Allowed) -> Fastest {
        let robot = paper().expect("the paper's robot");
        finish(allowed.fastest_in_steps(&robot, &across(5.0))).expect("a move")
    }

    /// Where only the acceleration acts, the way D takes 2 √(D/a) with a peak of √(a D). The quintic's largest acceleration
    /// is 10 D/(√3 T²): that of 5 m/s, in 4.5 s, is 3.4212 m/s².
    #[test]
    fn half_the_way_is_sped_up_and_half_braked() {
        let options = LimitOptions { waves: false, acceleration: Some(3.0), ..asked().options };
        let Fastest { found, scale } = fastest(&Allowed { options, ..asked() });
        assert!((found.duration() - 4.0).abs() < 1e-9 && (found.peak() - 6.0).abs() < 1e-9, "{}", found.duration());
        assert!((scale - (3.0_f64 / 3.4212).sqrt()).abs() < 1e-4, "{scale}");
    }

    /// A quintic with a peak of 7 m/s is at 0.59 of the wave limit at most, by two independent programs: 0.8 of it allow 9.49 m/s.
    /// No acceleration acts.
    #[test]
    fn a_profile_is_scaled_to_the_wave_limit_where_that_acts_first() {
        let options = LimitOptions { acceleration: None, ..asked().options };
        let found = fastest(&Allowed { options, ..asked() });
        assert!((5.0 * found.scale / (0.8 * 7.0 / 0.59) - 1.0).abs() < 0.01, "{}", found.scale);
    }

    #[test]
    fn where_no_speed_is_stable_there_is_no_move() {
        let robot = paper().expect("the paper's robot");
        let frozen = vec![(0.0, Some(4.0)), (6.0, Some(0.0)), (12.0, None)];
        let options = LimitOptions { frozen: true, ..asked().options };
        let refused = finish(Allowed { options, frozen }.fastest_in_steps(&robot, &across(5.0)));
        assert!(refused.is_err_and(|reason| reason.contains("the critical speed is 0")));
    }
}
