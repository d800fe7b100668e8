//! A path with its timing: where the platform is to be at every time.

use super::path::{Leg, PathPoint, Side};
use super::profile::{Profile, Timing};
use crate::robot::Vec2;

/// A path with its timing.
///
/// A path of several straight legs rests where they meet, and each leg has its own profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    legs: Vec<TimedLeg>,
    rest_to_rest: bool,
}

#[derive(Clone, Debug, PartialEq)]
struct TimedLeg {
    leg: Leg,
    timing: Timing,
    /// When it begins, in s.
    start: f64,
    /// Arc length before it, in m.
    before: f64,
}

/// What a trajectory prescribes at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// t in s.
    pub time: f64,
    /// Arc length s in m.
    pub s: f64,
    /// ṡ in m/s.
    pub v: f64,
    /// s̈ in m/s².
    pub a: f64,
    /// Position, tangent and curvature at s.
    pub point: PathPoint,
}

impl Moment {
    /// ṗ = p' ṡ in m/s.
    pub fn velocity(&self) -> Vec2 {
        self.point.tangent * self.v
    }

    /// p̈ = p' s̈ + p'' ṡ² in m/s².
    pub fn acceleration(&self) -> Vec2 {
        self.point.tangent * self.a + self.point.curvature * (self.v * self.v)
    }
}

impl Trajectory {
    /// Straight from `start` to each of the `points` in turn, at rest in each, all with the same profile. Points that
    /// coincide with the one before are left out; `None` where none is left.
    pub fn straight(start: Vec2, points: &[Vec2], profile: Profile) -> Option<Self> {
        let mut from = start;
        let mut legs = Vec::new();
        for &to in points {
            legs.extend(Leg::straight(from, to));
            from = to;
        }
        Self::of_legs(legs, profile)
    }

    fn of_legs(legs: Vec<Leg>, profile: Profile) -> Option<Self> {
        let (mut start, mut before) = (0.0, 0.0);
        let legs: Vec<TimedLeg> = legs
            .into_iter()
            .map(|leg| {
                let timing = profile.timing(leg.length());
                let timed = TimedLeg { leg, timing, start, before };
                start += timed.timing.duration;
                before += timed.leg.length();
                timed
            })
            .collect();
        (!legs.is_empty()).then_some(Self { legs, rest_to_rest: profile.is_rest_to_rest() })
    }

    /// How long the move takes, in s.
    pub fn duration(&self) -> f64 {
        self.legs.last().map_or(0.0, |last| last.start + last.timing.duration)
    }

    /// The arc length of the whole path, in m.
    pub fn length(&self) -> f64 {
        self.legs.last().map_or(0.0, |last| last.before + last.leg.length())
    }

    /// Whether it begins and ends at rest.
    pub fn is_rest_to_rest(&self) -> bool {
        self.rest_to_rest
    }

    /// The times between 0 and the duration, both left out, at which the acceleration may jump, in rising order.
    pub fn breaks(&self) -> Vec<f64> {
        let of_leg = |leg: &TimedLeg| {
            let start = leg.start;
            let inner: Vec<f64> = leg.timing.breaks().map(|time| start + time).collect();
            std::iter::once(start).chain(inner).collect::<Vec<f64>>()
        };
        self.legs.iter().flat_map(of_leg).filter(|time| *time > 0.0).collect()
    }

    /// What is prescribed at `time` (s). Where the acceleration jumps `side` tells which of the two is meant. After the end
    /// of a move from rest to rest the platform is at rest at the end; before its beginning at the start.
    pub fn at(&self, time: f64, side: Side) -> Moment {
        let left = side == Side::Left;
        let duration = self.duration();
        let over = self.rest_to_rest && (time > duration || (time >= duration && !left));
        let after = self.legs.partition_point(|leg| if left { leg.start < time } else { leg.start <= time });
        let index = after.saturating_sub(1).min(self.legs.len().saturating_sub(1));
        let leg = &self.legs[index];
        let local = (time - leg.start).clamp(0.0, leg.timing.duration);
        let [s, mut v, mut a] = leg.timing.at(local, left);
        if over || time < 0.0 {
            (v, a) = (0.0, 0.0);
        }
        let s = s.clamp(0.0, leg.leg.length());
        Moment { time, s: leg.before + s, v, a, point: leg.leg.at(s) }
    }

    /// The point at arc length `s` (m) of the whole path; at a corner `side` tells which leg is meant.
    pub fn point(&self, s: f64, side: Side) -> PathPoint {
        let left = side == Side::Left;
        let after = self.legs.partition_point(|leg| if left { leg.before < s } else { leg.before <= s });
        let leg = &self.legs[after.saturating_sub(1).min(self.legs.len().saturating_sub(1))];
        leg.leg.at((s - leg.before).clamp(0.0, leg.leg.length()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Durations that an independent program has found.
    #[test]
    fn profiles_take_the_time_that_they_should() {
        let over = |distance: f64, profile| {
            Trajectory::straight(Vec2::zeros(), &[Vec2::new(distance, 0.0)], profile).expect("a path")
        };
        for (distance, profile, duration) in [
            (12.0, Profile::Quintic { speed: 5.0 }, 4.5),
            (8.0, Profile::Constant { speed: 5.0 }, 1.6),
            (12.0, Profile::Trapezoid { speed: 3.0, acceleration: 1.5 }, 6.0),
            (12.0, Profile::SCurve { speed: 4.0, acceleration: 3.0, jerk: 8.0 }, 4.708_333_333_333_33),
            (1.5, Profile::SCurve { speed: 1.5, acceleration: 4.0, jerk: 30.0 }, 1.508_333_333_333_33),
            // Too short for its speed: two ramps of √(D/a).
            (4.0, Profile::Trapezoid { speed: 30.0, acceleration: 1.0 }, 4.0),
        ] {
            let found = over(distance, profile);
            assert!((found.duration() - duration).abs() < 1e-12, "{profile:?}: {}", found.duration());
            for side in [Side::Left, Side::Right] {
                let end = found.at(found.duration(), side);
                assert!((end.s - distance).abs() < 1e-12, "{profile:?}: {end:?}");
            }
        }
    }
}
