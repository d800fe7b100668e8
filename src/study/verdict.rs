//! What is known of one pose in one direction, or in the worst of several.

use std::f64::consts::FRAC_PI_2;

use crate::mechanics::{self, Statics};
use crate::robot::{Motion, Robot, Vec2};
use crate::stability::{Critical, Outcome};
use crate::study::Local;

/// The critical speed of a pose in one direction, or why there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The pose has no taut equilibrium that could be computed.
    Infeasible,
    /// The eigenvalues could not be computed: not known.
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
            Self::Infeasible | Self::NotConverged | Self::NoneUpTo(_) => None,
        }
    }

    /// Whether the pose has a taut equilibrium.
    pub fn is_feasible(&self) -> bool {
        *self != Self::Infeasible
    }
}

/// The critical speed of `robot` on `motion`, searched up to `limit` (m/s, finite and greater than 0). The motion's
/// speed does not matter.
pub fn verdict(robot: &Robot, motion: &Motion, limit: f64) -> Verdict {
    match mechanics::solve(robot, motion.position()) {
        Ok(statics) => along(robot, statics, motion.direction(), limit),
        Err(_) => Verdict::Infeasible,
    }
}

fn along(robot: &Robot, statics: Statics, direction: Vec2, limit: f64) -> Verdict {
    let Ok(local) = Local::along(robot, statics, direction) else { return Verdict::Infeasible };
    match local.critical_speed(limit) {
        Ok(Outcome::Found(critical)) => Verdict::Critical(critical),
        Ok(Outcome::NoneUpTo(limit)) => Verdict::NoneUpTo(limit),
        Err(_) => Verdict::NotConverged,
    }
}

/// In which directions the platform moves through a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Directions {
    /// In this one, of any length but zero.
    One(Vec2),
    /// In so many directions, equally spaced and beginning with +x, of which the worst counts.
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

    /// The lowest critical speed at `position` up to `limit` (m/s) and its direction; the first direction where no
    /// speed is critical. Where one direction is without an answer, so is the worst.
    pub(super) fn verdict(self, robot: &Robot, position: Vec2, limit: f64) -> (Vec2, Verdict) {
        let directions = self.each();
        let mut worst = (directions.first().copied().unwrap_or(Vec2::x()), Verdict::Infeasible);
        let Some(statics) = statics(robot, position) else { return worst };
        // A direction matters only where it is critical below the lowest speed so far.
        let mut searched = limit;
        for (k, direction) in directions.into_iter().enumerate() {
            match along(robot, statics.clone(), direction, searched) {
                Verdict::Critical(critical) => {
                    if worst.1.critical().is_none_or(|lowest| critical.speed < lowest.speed) {
                        searched = critical.speed;
                        worst = (direction, Verdict::Critical(critical));
                    }
                }
                Verdict::NoneUpTo(_) if k == 0 => worst = (direction, Verdict::NoneUpTo(limit)),
                Verdict::NoneUpTo(_) => {}
                unknown => return (direction, unknown),
            }
            // Nothing is lower than a speed at which everything grows.
            if searched <= 0.0 {
                break;
            }
        }
        worst
    }

    /// The largest growth rate max Re λ (1/s) at `position` and `speed` (m/s) over the directions; `None` where it is
    /// not known.
    pub(super) fn growth(self, robot: &Robot, position: Vec2, speed: f64) -> Option<f64> {
        let statics = statics(robot, position)?;
        let growth = |direction| {
            let local = Local::along(robot, statics.clone(), direction).ok()?;
            Some(local.spectrum(speed).ok()?.growth_rate())
        };
        let rates: Option<Vec<f64>> = self.each().into_iter().map(growth).collect();
        rates?.into_iter().max_by(f64::total_cmp)
    }
}

fn statics(robot: &Robot, position: Vec2) -> Option<Statics> {
    position.iter().all(|coordinate| coordinate.is_finite()).then(|| mechanics::solve(robot, position).ok())?
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
