//! What is known of one pose in one direction, or in the worst of several.

use std::f64::consts::FRAC_PI_2;

use crate::mechanics::{self, Failure, Statics};
use crate::robot::{Motion, Robot, Vec2};
use crate::stability::steps::finish;
use crate::stability::{Critical, Outcome, is_lower};
use crate::study::LocalProblem;

/// The critical speed of a pose in one direction, or why there is none.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Verdict {
    /// The pose has no taut equilibrium.
    Infeasible,
    /// The statics could not be computed, or the attempt was lost: nothing is known, not even whether there is an
    /// equilibrium.
    Unknown,
    /// The pose has a taut equilibrium, but the search for its critical speed has failed: not known.
    NotConverged,
    /// Every speed up to this one (m/s) is stable.
    NoneUpTo(f64),
    /// The first crossing.
    Critical(Critical),
}

impl Verdict {
    /// The first crossing, where there is one.
    pub fn critical(&self) -> Option<&Critical> {
        match self {
            Self::Critical(critical) => Some(critical),
            Self::Infeasible | Self::Unknown | Self::NotConverged | Self::NoneUpTo(_) => None,
        }
    }

    /// Whether the pose has a taut equilibrium; `None` where that is not known.
    pub fn feasible(&self) -> Option<bool> {
        match self {
            Self::Infeasible => Some(false),
            Self::Unknown => None,
            Self::NotConverged | Self::NoneUpTo(_) | Self::Critical(_) => Some(true),
        }
    }

    /// How the search ended.
    pub fn status(&self) -> Status {
        match self {
            Self::Infeasible => Status::Infeasible,
            Self::Unknown | Self::NotConverged => Status::Failed,
            Self::NoneUpTo(_) => Status::None,
            Self::Critical(_) => Status::Found,
        }
    }
}

impl From<&Failure> for Verdict {
    fn from(failure: &Failure) -> Self {
        match failure.reason.feasible() {
            Some(false) => Self::Infeasible,
            Some(true) => Self::NotConverged,
            None => Self::Unknown,
        }
    }
}

/// How a search for a critical speed, or for eigenvalues, ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// There is one.
    Found,
    /// There is none up to the limit.
    None,
    /// There is no taut equilibrium to begin with.
    Infeasible,
    /// It could not be computed.
    Failed,
}

/// Why a pose has no eigenvalues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum NoEigenvalues {
    /// It has no taut equilibrium.
    Infeasible,
    /// Its statics or its eigenvalues could not be computed.
    Failed,
}

impl NoEigenvalues {
    /// How the search for the eigenvalues ended.
    pub fn status(self) -> Status {
        match self {
            Self::Infeasible => Status::Infeasible,
            Self::Failed => Status::Failed,
        }
    }
}

impl From<&Failure> for NoEigenvalues {
    fn from(failure: &Failure) -> Self {
        if failure.reason.feasible() == Some(false) { Self::Infeasible } else { Self::Failed }
    }
}

/// The critical speed of `robot` on `motion`, searched up to `limit` (m/s, finite and greater than 0), and its wave limit
/// in m/s where there is one ([`mechanics::wave_limit`]). The motion's speed does not matter.
pub fn verdict(robot: &Robot, motion: &Motion, limit: f64) -> (Verdict, Option<f64>) {
    finish(verdict_in_steps(robot, motion, limit))
}

/// The same in [steps](crate::stability::steps).
pub(super) async fn verdict_in_steps(robot: &Robot, motion: &Motion, limit: f64) -> (Verdict, Option<f64>) {
    match mechanics::solve(robot, motion.position()) {
        Ok(statics) => along(robot, statics, motion.direction(), limit).await,
        Err(failure) => (Verdict::from(&failure), None),
    }
}

fn wave_limit(robot: &Robot, statics: &Statics, direction: Vec2) -> Option<f64> {
    let rates = mechanics::length_rates(robot, statics, direction)?;
    Some(mechanics::wave_limit(robot, statics, &rates)?.speed)
}

/// The lower one, where there is any.
fn lower(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.into_iter().chain(b).min_by(f64::total_cmp)
}

async fn along(robot: &Robot, statics: Statics, direction: Vec2, limit: f64) -> (Verdict, Option<f64>) {
    let local = match LocalProblem::along(robot, statics, direction) {
        Ok(local) => local,
        Err(failure) => return (Verdict::from(&failure), None),
    };
    let verdict = match local.critical_speed_in_steps(limit).await {
        Ok(Outcome::Found(critical)) => Verdict::Critical(critical),
        Ok(Outcome::NoneUpTo(limit)) => Verdict::NoneUpTo(limit),
        Err(_) => Verdict::NotConverged,
    };
    (verdict, local.wave_limit.map(|limit| limit.speed))
}

/// Other directions are searched up to the lowest speed so far and beyond it, by this part of that speed or of 1 m/s. That is
/// more than the 0.0005 m/s that a search looks around a crossing.
const BEYOND: f64 = 1e-3;

/// In which directions the platform moves through a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Directions {
    /// In this one, of any length but zero.
    One(Vec2),
    /// In this many directions, equally spaced and beginning with +x; the worst of them counts.
    Worst(usize),
}

impl Directions {
    /// How many directions the worst is sought among, unless told otherwise.
    pub const WORST_OF: usize = 16;
    /// Those that have a word for it.
    pub const WORDS: [(&'static str, Self); 5] = [
        ("worst", Self::Worst(Self::WORST_OF)),
        ("+x", Self::One(Vec2::new(1.0, 0.0))),
        ("-x", Self::One(Vec2::new(-1.0, 0.0))),
        ("+y", Self::One(Vec2::new(0.0, 1.0))),
        ("-y", Self::One(Vec2::new(0.0, -1.0))),
    ];

    /// The unit vectors; none for a vector that has no direction.
    fn each(self) -> Vec<Vec2> {
        match self {
            Self::One(direction) => unit(direction).into_iter().collect(),
            Self::Worst(count) => (0..count).map(|k| compass(k, count)).collect(),
        }
    }

    /// The lowest critical speed at `position` up to `limit` (m/s) with its direction, and the lowest wave limit of all
    /// directions; of directions that are critical at the same speed but for rounding the first one, and the first of all where no speed is critical. Where one direction is without an answer, so is the
    /// worst.
    pub(super) async fn verdict(self, robot: &Robot, position: Vec2, limit: f64) -> (Vec2, Verdict, Option<f64>) {
        let directions = self.each();
        let mut worst = (directions.first().copied().unwrap_or(Vec2::x()), Verdict::Infeasible);
        let statics = match statics(robot, position) {
            Ok(statics) => statics,
            Err(verdict) => return (worst.0, verdict, None),
        };
        let mut waves: Option<f64> = None;
        // Those of directions that are not searched.
        let not_searched = |from: usize| {
            let rest = directions.iter().skip(from);
            rest.filter_map(|direction| wave_limit(robot, &statics, *direction)).min_by(f64::total_cmp)
        };
        // A direction matters only where it is critical below the lowest speed so far. The search goes on a little beyond:
        // that is where mirrored directions are critical, and at its very limit rounding would decide what is found.
        let (mut searched, mut lowest) = (limit, limit);
        for (k, &direction) in directions.iter().enumerate() {
            let (verdict, wave_limit) = along(robot, statics.clone(), direction, searched).await;
            waves = lower(waves, wave_limit);
            match verdict {
                Verdict::Critical(critical) => {
                    if worst.1.critical().is_none_or(|lowest| is_lower(critical.speed, lowest.speed)) {
                        lowest = critical.speed;
                        searched = limit.min(lowest + BEYOND * lowest.max(1.0));
                        worst = (direction, Verdict::Critical(critical));
                    }
                }
                Verdict::NoneUpTo(_) if k == 0 => worst = (direction, Verdict::NoneUpTo(limit)),
                Verdict::NoneUpTo(_) => {}
                unknown => return (direction, unknown, lower(waves, not_searched(k + 1))),
            }
            // Nothing is lower than a speed at which everything grows.
            if lowest <= 0.0 {
                waves = lower(waves, not_searched(k + 1));
                break;
            }
        }
        (worst.0, worst.1, waves)
    }

    /// The largest growth rate max Re λ (1/s) at `position` and `speed` (m/s) over the directions.
    ///
    /// # Errors
    /// Why it is not known.
    pub(super) async fn growth(self, robot: &Robot, position: Vec2, speed: f64) -> Result<f64, NoEigenvalues> {
        let no_answer =
            |verdict| if verdict == Verdict::Infeasible { NoEigenvalues::Infeasible } else { NoEigenvalues::Failed };
        let statics = statics(robot, position).map_err(no_answer)?;
        let mut rates = Vec::new();
        for direction in self.each() {
            let local = LocalProblem::along(robot, statics.clone(), direction)
                .map_err(|failure| NoEigenvalues::from(&failure))?;
            rates.push(local.spectrum_in_steps(speed).await.map_err(|_| NoEigenvalues::Failed)?.growth_rate());
        }
        rates.into_iter().max_by(f64::total_cmp).ok_or(NoEigenvalues::Infeasible)
    }
}

/// The statics at `position`, or the verdict where there are none.
fn statics(robot: &Robot, position: Vec2) -> Result<Statics, Verdict> {
    if !position.iter().all(|coordinate| coordinate.is_finite()) {
        return Err(Verdict::Infeasible);
    }
    mechanics::solve(robot, position).map_err(|failure| Verdict::from(&failure))
}

fn unit(direction: Vec2) -> Option<Vec2> {
    Motion::new(Vec2::zeros(), direction, 0.0).ok().map(|motion| motion.direction())
}

/// The `index`-th of `count` directions, equally spaced, counterclockwise from +x. Those along the axes are exact.
pub fn compass(index: usize, count: usize) -> Vec2 {
    let count = count.max(1);
    let (quarter, rest) = (4 * (index % count) / count, 4 * (index % count) % count);
    let (sine, cosine) = (FRAC_PI_2 * rest as f64 / count as f64).sin_cos();
    match quarter {
        0 => Vec2::new(cosine, sine),
        1 => Vec2::new(-sine, cosine),
        2 => Vec2::new(-cosine, -sine),
        _ => Vec2::new(sine, -cosine),
    }
}
