//! What local analysis says of a whole move: how near it comes to the wave limit, where the critical speed is least, and what
//! the frozen eigenvalues let grow.

use crate::flight::FlightError;
use crate::mechanics::{self, Failure};
use crate::robot::{PathPoint, Robot, Side, Trajectory};
use crate::stability::steps::step;
use crate::stability::{CriticalSearch, Outcome};
use crate::study::LocalProblem;

/// Parts of a path at whose ends the wave limit is looked at first: it takes statics alone.
const PARTS: usize = 200;
/// The same for the critical speed.
const PARTS_FOR_SPEEDS: usize = 100;
/// Parts of a move's time over which the frozen growth rate is summed up.
const PARTS_IN_TIME: usize = 160;
/// Steps of the golden section: each makes the bracket 0.618 times as long, 40 of them 4e-9 times.
const GOLDEN_STEPS: usize = 40;
/// The same for the critical speed: 3e-4 times.
const GOLDEN_STEPS_FOR_SPEEDS: usize = 17;

/// How near a move comes to the wave limit: the verdict of the move.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct WaveRatio {
    /// ρ, the largest v(s) over the wave limit at s. Below 1 nothing grows without bound.
    pub value: f64,
    /// Where that is, in m of arc length.
    pub s: f64,
    /// The cable whose waves are reached, 0-based.
    pub cable: usize,
    /// Whether it is reeled in.
    pub reeled_in: bool,
}

/// The least of a speed along a path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct LeastSpeed {
    /// In m/s.
    pub speed: f64,
    /// Where that is, in m of arc length.
    pub s: f64,
}

/// What local analysis says of a move as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSummary {
    /// `None` where no cable moves.
    pub wave_ratio: Option<WaveRatio>,
    /// The least wave limit; `None` where no cable moves.
    pub least_wave_limit: Option<LeastSpeed>,
    /// The least frozen critical speed; `None` where there is none up to the limit of the search.
    pub least_critical_speed: Option<LeastSpeed>,
    /// exp ∫ max Re λ dt; `None` where the eigenvalues are not known somewhere.
    pub frozen_growth: Option<f64>,
}

impl PathSummary {
    /// The summary of the move along `trajectory`, with critical speeds searched up to `limit` (m/s), in
    /// [steps](crate::steps). All is by local analysis in the path's arc length, its curvature included.
    ///
    /// # Errors
    /// The first place, of those that are looked at, without a taut equilibrium.
    pub async fn in_steps(robot: &Robot, trajectory: &Trajectory, limit: f64) -> Result<Self, FlightError> {
        let (wave_ratio, least_wave_limit) = wave_ratio_in_steps(robot, trajectory).await?;
        let least_critical_speed = least_critical_speed(robot, trajectory, limit).await?;
        let growth = frozen_growth_in_steps(robot, trajectory).await?;
        let frozen_growth = growth.and_then(|growth| growth.last().map(|last| last[1].exp()));
        Ok(Self { wave_ratio, least_wave_limit, least_critical_speed, frozen_growth })
    }
}

/// Why a place of a path has no answer.
fn failed(s: f64, point: &PathPoint, failure: &Failure) -> FlightError {
    FlightError::Statics { s, position: point.position, reason: failure.reason }
}

/// The wave limit at a point of a path.
fn wave_limit(robot: &Robot, s: f64, point: &PathPoint) -> Result<Option<mechanics::WaveLimit>, FlightError> {
    let statics = mechanics::solve(robot, point.position).map_err(|failure| failed(s, point, &failure))?;
    let rates = mechanics::length_rates(robot, &statics, point.tangent);
    Ok(rates.and_then(|rates| mechanics::wave_limit(robot, &statics, &rates)))
}

/// The largest v(s) over the wave limit at s, and the least wave limit, of the move along `trajectory`, in
/// [steps](crate::steps). Both to rounding, unless a second extreme hides between two of 200 places in time and path.
///
/// # Errors
/// The first place, of those that are looked at, without a taut equilibrium.
pub async fn wave_ratio_in_steps(
    robot: &Robot,
    trajectory: &Trajectory,
) -> Result<(Option<WaveRatio>, Option<LeastSpeed>), FlightError> {
    let ratio = |time: f64| -> Result<f64, FlightError> {
        let moment = trajectory.at(time, side(time));
        Ok(wave_limit(robot, moment.s, &moment.point)?.map_or(0.0, |limit| moment.v / limit.speed))
    };
    let (time, _) = largest(trajectory.duration(), PARTS, GOLDEN_STEPS, ratio).await?;
    let moment = trajectory.at(time, side(time));
    let of_ratio = wave_limit(robot, moment.s, &moment.point)?.map(|limit| WaveRatio {
        value: moment.v / limit.speed,
        s: moment.s,
        cable: limit.cable,
        reeled_in: limit.reeled_in,
    });
    let below = |s: f64| -> Result<f64, FlightError> {
        let each = sides(trajectory, s).into_iter().map(|point| wave_limit(robot, s, &point));
        let least = each.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().map(|limit| limit.speed);
        Ok(-least.fold(f64::INFINITY, f64::min))
    };
    let (s, value) = largest(trajectory.length(), PARTS, GOLDEN_STEPS, below).await?;
    Ok((of_ratio, value.is_finite().then_some(LeastSpeed { speed: -value, s })))
}

/// The least frozen critical speed along a path.
async fn least_critical_speed(
    robot: &Robot,
    trajectory: &Trajectory,
    limit: f64,
) -> Result<Option<LeastSpeed>, FlightError> {
    let below = |s: f64| -> Result<f64, FlightError> {
        let mut least = f64::INFINITY;
        for point in sides(trajectory, s) {
            let local = LocalProblem::at(robot, &point).map_err(|failure| failed(s, &point, &failure))?;
            // Of a place that cannot be computed nothing is claimed.
            if let Ok(Outcome::Found(critical)) = CriticalSearch::new(limit).run(&local.vibration) {
                least = least.min(critical.speed);
            }
        }
        Ok(-least)
    };
    let (s, value) = largest(trajectory.length(), PARTS_FOR_SPEEDS, GOLDEN_STEPS_FOR_SPEEDS, below).await?;
    Ok(value.is_finite().then_some(LeastSpeed { speed: -value, s }))
}

/// Time in s and ∫ max Re λ dt from the beginning to there, with eigenvalues at the speed of the moment and without s̈, in
/// [steps](crate::steps). Its exponential is what the frozen rule lets grow. `None` where the eigenvalues are not known
/// somewhere.
///
/// # Errors
/// The first place, of those that are looked at, without a taut equilibrium.
pub async fn frozen_growth_in_steps(
    robot: &Robot,
    trajectory: &Trajectory,
) -> Result<Option<Vec<[f64; 2]>>, FlightError> {
    let duration = trajectory.duration();
    let mut growth = vec![[0.0, 0.0]];
    let mut before: Option<f64> = None;
    for k in 0..=PARTS_IN_TIME {
        let time = duration * k as f64 / PARTS_IN_TIME as f64;
        let moment = trajectory.at(time, side(time));
        let local =
            LocalProblem::at(robot, &moment.point).map_err(|failure| failed(moment.s, &moment.point, &failure))?;
        let Ok(spectrum) = local.spectrum_in_steps(moment.v).await else { return Ok(None) };
        let rate = spectrum.growth_rate();
        if let (Some(before), Some(&[from, sum])) = (before, growth.last()) {
            growth.push([time, sum + 0.5 * (time - from) * (before + rate)]);
        }
        before = Some(rate);
        step().await;
    }
    Ok(Some(growth))
}

/// What has been, but for the beginning.
fn side(time: f64) -> Side {
    if time > 0.0 { Side::Left } else { Side::Right }
}

/// The path at s; at a corner as it comes and as it leaves.
fn sides(trajectory: &Trajectory, s: f64) -> Vec<PathPoint> {
    let [left, right] = [Side::Left, Side::Right].map(|side| trajectory.point(s, side));
    if left == right { vec![left] } else { vec![left, right] }
}

/// Where a function of 0 … `end` is largest, and its value there: the largest of equally spaced places, and from there by
/// golden section between its neighbours.
async fn largest(
    end: f64,
    parts: usize,
    steps: usize,
    function: impl Fn(f64) -> Result<f64, FlightError>,
) -> Result<(f64, f64), FlightError> {
    let place = |k: usize| end * k as f64 / parts as f64;
    let mut best = (0, function(0.0)?);
    for k in 1..=parts {
        let value = function(place(k))?;
        if value > best.1 {
            best = (k, value);
        }
        step().await;
    }
    let mut found = (place(best.0), best.1);
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (place(best.0.saturating_sub(1)), place((best.0 + 1).min(parts)));
    let mut inner = [high - golden * (high - low), low + golden * (high - low)];
    let mut values = [function(inner[0])?, function(inner[1])?];
    for _ in 0..steps {
        if values[0] > values[1] {
            high = inner[1];
            inner = [high - golden * (high - low), inner[0]];
            values = [function(inner[0])?, values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + golden * (high - low)];
            values = [values[1], function(inner[1])?];
        }
        step().await;
    }
    for (place, value) in inner.into_iter().zip(values) {
        if value > found.1 {
            found = (place, value);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Profile, Vec2, paper};
    use crate::stability::steps::finish;

    fn across(profile: Profile) -> Trajectory {
        Trajectory::straight(Vec2::new(-6.0, 0.0), &[Vec2::new(6.0, 0.0)], profile).expect("a path")
    }

    /// docs/theory.md, growth along a path: the least wave limit, 9.16 m/s, and the least critical speed, 4.88 m/s, are at
    /// the ends of the path; at constant speed ρ is v over the former.
    #[test]
    fn the_paper_robot_across_its_workspace() {
        let robot = paper().expect("a robot");
        let found =
            finish(PathSummary::in_steps(&robot, &across(Profile::Constant { speed: 5.0 }), 40.0)).expect("a path");
        let waves = found.least_wave_limit.expect("a wave limit");
        assert!((waves.speed - 9.16).abs() < 5e-3 && (waves.s < 1e-6 || waves.s > 12.0 - 1e-6), "{waves:?}");
        let ratio = found.wave_ratio.expect("a ratio");
        assert!((ratio.value - 5.0 / waves.speed).abs() < 1e-9, "{ratio:?}");
        let critical = found.least_critical_speed.expect("a critical speed");
        assert!((critical.speed - 4.88).abs() < 5e-3 && critical.s < 1e-6, "{critical:?}");
        assert!((found.frozen_growth.expect("growth") - 0.66).abs() < 5e-3, "{found:?}");
    }

    /// exp ∫ max Re λ dt of two independent integrators, to their last digit.
    #[test]
    fn frozen_growth_at_constant_speed() {
        let robot = paper().expect("a robot");
        for (speed, growth) in [(2.0, 0.23), (8.0, 0.92), (11.0, 1.12)] {
            let found = finish(frozen_growth_in_steps(&robot, &across(Profile::Constant { speed }))).expect("a path");
            let found = found.expect("growth").last().expect("an end")[1].exp();
            assert!((found - growth).abs() < 5.5e-3, "{speed}: {found}");
        }
    }

    #[test]
    fn an_extreme_is_found_between_places() {
        let peak = |x: f64| Ok(-(x - 0.123_456).powi(2));
        let (at, value) = finish(largest(1.0, 20, GOLDEN_STEPS, peak)).expect("a function");
        assert!((at - 0.123_456).abs() < 1e-8 && value > -1e-15, "{at} {value}");
        for end in [0.0, 1.0] {
            let edge = |x: f64| Ok(-(x - end).abs());
            let (at, _) = finish(largest(1.0, 20, GOLDEN_STEPS, edge)).expect("a function");
            assert!((at - end).abs() < 1e-15, "{at}");
        }
    }
}
