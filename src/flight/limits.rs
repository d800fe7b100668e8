//! The fastest move along a path that keeps to local limits and to the machine's.
//!
//! In b = ṡ² and u = s̈ over the arc length s all limits are linear: b ≤ (κ v)² and b ≤ (L̇/|L'|)², |u| ≤ a and
//! |L' u + L'' b| ≤ L̈. On a grid where u is constant between two places, b grows by 2 Δs u. Backward, the largest b is found
//! from which the end can still be reached at rest; forward, the largest u that stays below it is the fastest.
//! docs/theory.md section 17; Pham and Pham, IEEE Transactions on Robotics 34(3), 2018.

use thiserror::Error;

use crate::mechanics::{self, LengthRates, SlackAcceleration, StaticsError};
use crate::robot::{PathPoint, Robot, Side, Trajectory, Vec2};

/// At least so many intervals a leg has, so that limits are kept between the places too.
pub const INTERVALS: usize = 400;
/// Nothing is this fast, in m²/s²: a larger b is not limited at all.
const UNLIMITED: f64 = 1e12;

/// What acts. A limit that is not given does not act.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct LimitOptions {
    /// κ: the speed keeps below this part of the local limits.
    pub safety: f64,
    /// Whether the critical speeds of the places are local limits.
    pub frozen: bool,
    /// Whether the wave limit is one.
    pub waves: bool,
    /// The acceleration keeps below this part of the slack acceleration.
    pub slack: Option<f64>,
    /// Of the platform along the path, |s̈| in m/s².
    pub acceleration: Option<f64>,
    /// Of every winch, |L̇| in m/s.
    pub winch_speed: Option<f64>,
    /// Of every winch, |L̈| in m/s².
    pub winch_acceleration: Option<f64>,
}

/// What is known of a path at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Arc length of the whole path in m.
    pub s: f64,
    /// In m.
    pub position: Vec2,
    /// Of every cable L in m.
    pub lengths: Vec<f64>,
    /// Of every cable the tension at the platform and at the winch in N, at rest.
    pub tensions: Vec<[f64; 2]>,
    /// Of every cable L' and L'' in the arc length.
    pub rates: Vec<LengthRates>,
    /// In m/s; `None` where no cable moves.
    pub wave_limit: Option<f64>,
    /// In m/s, for the caller to fill in, as flights know no eigenvalues; `None` is no limit.
    pub critical_speed: Option<f64>,
    /// By statics.
    pub slack: Option<SlackAcceleration>,
}

/// The fastest move.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct FastestMove {
    /// At the places, from rest to rest; at a corner, where it rests, the last place of one leg is the first of the next.
    pub rows: Vec<MoveRow>,
}

/// The fastest move at one place.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct MoveRow {
    /// s in m.
    pub s: f64,
    /// t in s.
    pub time: f64,
    /// In m.
    pub position: Vec2,
    /// ṡ in m/s.
    pub v: f64,
    /// s̈ in m/s² from here to the next row; 0 at the end.
    pub a: f64,
    /// Every cable.
    pub cables: Vec<CableRow>,
}

/// A cable at one place of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct CableRow {
    /// L in m.
    pub length: f64,
    /// L̇ in m/s.
    pub rate: f64,
    /// L̈ in m/s².
    pub acceleration: f64,
    /// At the platform in N, at rest.
    pub tension_at_platform: f64,
    /// At the winch in N, at rest.
    pub tension_at_winch: f64,
}

/// Why a path has no fastest move.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LimitsError {
    /// The robot has no statics at a place.
    #[error("at ({:.3}, {:.3}) m, {s:.3} m along the path: {reason}", position.x, position.y)]
    NoStatics {
        /// Arc length in m.
        s: f64,
        /// In m.
        position: Vec2,
        /// Why not.
        reason: StaticsError,
    },
    /// The lengths' rates leave the range of floating point.
    #[error("at ({:.3}, {:.3}) m, {s:.3} m along the path: the pose is singular", position.x, position.y)]
    Singular {
        /// Arc length in m.
        s: f64,
        /// In m.
        position: Vec2,
    },
    /// The local limits allow no speed.
    #[error("at ({:.3}, {:.3}) m, {s:.3} m along the path: the critical speed is 0, so no speed is allowed", position.x, position.y)]
    NoSpeed {
        /// Arc length in m.
        s: f64,
        /// In m.
        position: Vec2,
    },
    /// The platform can neither pass nor leave a place.
    #[error("at ({:.3}, {:.3}) m, {s:.3} m along the path: no acceleration is allowed, so the platform stays there", position.x, position.y)]
    Stuck {
        /// Arc length in m.
        s: f64,
        /// In m.
        position: Vec2,
    },
    /// No limit acts, so nothing is the fastest.
    #[error("no limit acts, so there is no fastest move: give an acceleration or a speed")]
    Unlimited,
    /// A leg of fewer than two places, or places in another order than along the path.
    #[error("a leg needs two places or more in the order of the path")]
    NoPath,
}

impl Place {
    /// What is known at the arc length `s` (m), where the path is at `point`; the critical speed is left to the caller.
    ///
    /// # Errors
    /// A pose without statics, or a singular one.
    pub fn at(robot: &Robot, s: f64, point: &PathPoint) -> Result<Self, LimitsError> {
        let position = point.position;
        let statics = mechanics::solve(robot, position).map_err(|failure| LimitsError::NoStatics {
            s,
            position,
            reason: failure.reason,
        })?;
        let rates = mechanics::length_rates_on(robot, &statics, point.tangent, point.curvature)
            .ok_or(LimitsError::Singular { s, position })?;
        Ok(Self {
            s,
            position,
            lengths: statics.cables.iter().map(|shape| shape.length).collect(),
            tensions: statics.cables.iter().map(|shape| [shape.tension_at_platform, shape.tension_at_winch]).collect(),
            wave_limit: mechanics::wave_limit(robot, &statics, &rates).map(|limit| limit.speed),
            critical_speed: None,
            slack: mechanics::slack_acceleration(robot, &statics, point.tangent),
            rates,
        })
    }
}

/// The places of each leg of a path, `intervals` + 1 of them, as arc length and point. A leg ends where the platform rests.
pub fn legs(trajectory: &Trajectory, intervals: usize) -> Vec<Vec<(f64, PathPoint)>> {
    let intervals = intervals.max(1);
    let place = |from: f64, to: f64, i: usize| {
        let s = if i == intervals { to } else { from + (to - from) * i as f64 / intervals as f64 };
        (s, trajectory.point(s, if i == 0 { Side::Right } else { Side::Left }))
    };
    let mut corners = vec![0.0];
    corners.extend(trajectory.corners());
    corners.push(trajectory.length());
    let leg = |ends: &[f64]| (0..=intervals).map(|i| place(ends[0], ends[1], i)).collect();
    corners.windows(2).map(leg).collect()
}

/// The fastest move over the places of each leg, at rest at the ends of each.
///
/// The limits are kept at every place with the acceleration that begins there. Up to the next place they are kept to the
/// order Δs, by which L', L'' and b change with the same acceleration. Where the acceleration alone acts, the time 2 √(D/a)
/// is exact for an even number of intervals.
///
/// # Errors
/// Why there is none, with the place.
pub fn limits(legs: &[Vec<Place>], options: &LimitOptions) -> Result<FastestMove, LimitsError> {
    let mut rows: Vec<MoveRow> = Vec::new();
    for places in legs {
        let start = rows.pop().map_or(0.0, |last| last.time);
        rows.extend(options.leg(places, start)?);
    }
    if rows.is_empty() { Err(LimitsError::NoPath) } else { Ok(FastestMove { rows }) }
}

impl FastestMove {
    /// How long it takes, in s.
    pub fn duration(&self) -> f64 {
        self.rows.last().map_or(0.0, |row| row.time)
    }

    /// Its highest speed in m/s.
    pub fn peak(&self) -> f64 {
        self.rows.iter().map(|row| row.v).fold(0.0, f64::max)
    }
}

/// A range of accelerations: empty where the first is above the last.
type Range = [f64; 2];

impl LimitOptions {
    /// The largest b that the limits of speed allow at a place; infinite where none acts.
    fn highest(&self, place: &Place) -> Result<f64, LimitsError> {
        let local = [self.frozen.then_some(place.critical_speed), self.waves.then_some(place.wave_limit)];
        let local = local.into_iter().flatten().flatten().map(|speed| self.safety * speed);
        let of_winch = |rate: f64| place.rates.iter().map(move |own| rate / own.first.abs());
        let speed = local.chain(self.winch_speed.into_iter().flat_map(of_winch)).fold(f64::INFINITY, f64::min);
        let (s, position) = (place.s, place.position);
        if speed > 0.0 { Ok(speed * speed) } else { Err(LimitsError::NoSpeed { s, position }) }
    }

    /// The accelerations that are allowed at a place that is passed with b.
    fn accelerations(&self, place: &Place, b: f64) -> Range {
        let mut range = [f64::NEG_INFINITY, f64::INFINITY];
        let mut keep = |low: f64, high: f64| range = [range[0].max(low), range[1].min(high)];
        if let Some(most) = self.acceleration {
            keep(-most, most);
        }
        if let Some((share, slack)) = self.slack.zip(place.slack) {
            let of = |limit: Option<mechanics::SlackLimit>| limit.map_or(f64::INFINITY, |limit| share * limit.value);
            keep(-of(slack.braking), of(slack.accelerating));
        }
        if let Some(most) = self.winch_acceleration {
            for LengthRates { first, second } in &place.rates {
                let rest = second * b;
                let ends = [(-most - rest) / first, (most - rest) / first];
                if ends.iter().all(|end| end.is_finite()) {
                    keep(ends[0].min(ends[1]), ends[0].max(ends[1]));
                } else if rest.abs() > most {
                    // L' = 0: no acceleration helps.
                    keep(f64::INFINITY, f64::NEG_INFINITY);
                }
            }
        }
        range
    }

    /// The accelerations with which an interval can be passed that begins with b, and ends with no more than `most`.
    fn passing(&self, ends: [&Place; 2], b: f64, most: f64) -> Range {
        let gain = 2.0 * (ends[1].s - ends[0].s);
        let [low, high] = self.accelerations(ends[0], b);
        [low.max(-b / gain), high.min((most - b) / gain)]
    }

    /// The rows of one leg that begins at the time `start`.
    fn leg(&self, places: &[Place], start: f64) -> Result<Vec<MoveRow>, LimitsError> {
        let intervals = || places.windows(2).map(|ends| [&ends[0], &ends[1]]);
        if places.len() < 2 || intervals().any(|[from, to]| from.s >= to.s) {
            return Err(LimitsError::NoPath);
        }
        let mut reach: Vec<f64> = places.iter().map(|place| self.highest(place)).collect::<Result<_, _>>()?;
        if let Some(last) = reach.last_mut() {
            *last = 0.0;
        }
        for (i, ends) in intervals().enumerate().rev() {
            let most = reach[i + 1];
            reach[i] = largest(reach[i].min(UNLIMITED), |b| {
                let [low, high] = self.passing(ends, b, most);
                low <= high
            });
        }
        let (mut b, mut time) = (0.0_f64, start);
        let mut rows = Vec::with_capacity(places.len());
        for (i, ends) in intervals().enumerate() {
            let [from, to] = ends;
            let gain = 2.0 * (to.s - from.s);
            let next = (b + gain * self.passing(ends, b, reach[i + 1])[1]).clamp(0.0, reach[i + 1]);
            if next >= UNLIMITED {
                return Err(LimitsError::Unlimited);
            }
            rows.push(row(from, time, b, (next - b) / gain));
            let took = gain / (b.sqrt() + next.sqrt());
            if !took.is_finite() {
                return Err(LimitsError::Stuck { s: from.s, position: from.position });
            }
            (time, b) = (time + took, next);
        }
        rows.extend(places.last().map(|place| row(place, time, 0.0, 0.0)));
        Ok(rows)
    }
}

fn row(place: &Place, time: f64, b: f64, a: f64) -> MoveRow {
    let v = b.sqrt();
    let cables = place.lengths.iter().zip(&place.tensions).zip(&place.rates);
    let cables = cables.map(|((&length, &[tension_at_platform, tension_at_winch]), rates)| CableRow {
        length,
        rate: rates.first * v,
        acceleration: rates.first * a + rates.second * b,
        tension_at_platform,
        tension_at_winch,
    });
    MoveRow { s: place.s, time, position: place.position, v, a, cables: cables.collect() }
}

/// The largest number up to `most` that is allowed, to the last bit, where 0 is and what is below an allowed one.
fn largest(most: f64, allowed: impl Fn(f64) -> bool) -> f64 {
    if allowed(most) {
        return most;
    }
    let [mut low, mut high] = [0.0, most];
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return low;
        }
        *(if allowed(middle) { &mut low } else { &mut high }) = middle;
    }
}
