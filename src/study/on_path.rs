//! A move along a path, place by place and as a whole: what the plots of a path show.

use crate::flight::{self, FlightError, Gain};
use crate::mechanics::WaveLimit;
use crate::robot::{Robot, Side, Trajectory, Vec2};
use crate::stability::Outcome;
use crate::study::{LocalProblem, Verdict, WaveRatio, frozen_growth_in_steps, wave_ratio_in_steps};

/// Builds the trajectory of the scenario's path, with another speed of its profile (m/s) where one is given; `None` where
/// there is no path.
pub type Moves<'a> = dyn Fn(Option<f64>) -> Option<Trajectory> + Send + Sync + 'a;

/// What local analysis finds at one place of a path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Station {
    /// Arc length in m.
    pub s: f64,
    /// Where that is, in m.
    pub position: Vec2,
    /// The frozen critical speed along the path, with its curvature.
    pub verdict: Verdict,
    /// The wave limit, where a cable moves.
    pub wave_limit: Option<WaveLimit>,
    /// L' and L'' of every cable in the path's arc length; none without an equilibrium.
    pub rates: Vec<[f64; 2]>,
}

/// What a move does to vibrations.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct MoveEffect {
    /// The largest of v(s) over the wave limit at s.
    pub wave_ratio: Option<WaveRatio>,
    /// exp ∫ max Re λ dt over the move, with eigenvalues at the speed of the moment.
    pub frozen_growth: Option<f64>,
    /// Time in s and ∫ max Re λ dt from the beginning to there.
    pub growth: Vec<[f64; 2]>,
    /// How many times larger any vibration can be after the move.
    pub gain: Option<Gain>,
}

/// What local analysis finds at arc length `s` (m) of a path, searched up to `limit` (m/s), in
/// [steps](crate::steps).
pub async fn station_in_steps(robot: &Robot, trajectory: &Trajectory, s: f64, limit: f64) -> Station {
    let point = trajectory.point(s, if s > 0.0 { Side::Left } else { Side::Right });
    let station = |verdict, wave_limit, rates| Station { s, position: point.position, verdict, wave_limit, rates };
    match LocalProblem::at(robot, &point) {
        Err(failure) => station(Verdict::from(&failure), None, Vec::new()),
        Ok(local) => {
            let verdict = match local.critical_speed_in_steps(limit).await {
                Ok(Outcome::Found(critical)) => Verdict::Critical(critical),
                Ok(Outcome::NoneUpTo(limit)) => Verdict::NoneUpTo(limit),
                Err(_) => Verdict::NotConverged,
            };
            let rates = local.rates.iter().map(|rates| [rates.first, rates.second]).collect();
            station(verdict, local.wave_limit, rates)
        }
    }
}

/// What the move along `trajectory` does to vibrations, in [steps](crate::steps).
///
/// # Errors
/// Why there is no such move: somewhere on its path the robot cannot rest.
pub async fn effect_in_steps(robot: &Robot, trajectory: &Trajectory) -> Result<MoveEffect, String> {
    let told = |reason: FlightError| reason.to_string();
    let (wave_ratio, _) = wave_ratio_in_steps(robot, trajectory).await.map_err(told)?;
    let growth = frozen_growth_in_steps(robot, trajectory).await.map_err(told)?.unwrap_or_default();
    let frozen_growth = growth.last().map(|last| last[1].exp()).filter(|growth| growth.is_finite());
    let gain = flight::gain_in_steps(robot, trajectory, None).await.ok().flatten();
    Ok(MoveEffect { wave_ratio, frozen_growth, growth, gain })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Profile, paper};
    use crate::stability::steps::finish;

    fn effect(profile: Profile) -> MoveEffect {
        let robot = paper().expect("the paper's robot");
        let [start, end] = [Vec2::new(-6.0, 0.0), Vec2::new(6.0, 0.0)];
        let trajectory = Trajectory::straight(start, &[end], profile).expect("a path");
        finish(effect_in_steps(&robot, &trajectory)).expect("a move")
    }

    #[test]
    fn the_wave_ratio_of_a_quintic_is_largest_where_it_is_fastest() {
        let found = effect(Profile::Quintic { speed: 7.0 });
        let ratio = found.wave_ratio.expect("a cable moves");
        // Nearly 7 m/s around the middle, where the wave limit is 11.57 to 11.87 m/s: two independent programs say 0.59.
        assert!((ratio.value - 0.59).abs() < 5e-3 && (ratio.s - 6.0).abs() < 1.0, "{ratio:?}");
        let (first, last) = (found.growth[0], found.growth[found.growth.len() - 1]);
        assert_eq!(first.map(f64::to_bits), [0; 2]);
        assert!(found.frozen_growth.is_some_and(|growth| (growth.ln() - last[1]).abs() < 1e-12));
    }
}
