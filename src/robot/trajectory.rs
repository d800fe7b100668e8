//! A path with its timing: where the platform is to be at every time.

use super::path::{Leg, PathPoint, Side};
use super::profile::{Profile, Timing};
use super::spline::{Ends, Spline};
use crate::robot::Vec2;

/// A spline in time rests where it is slower than this part of its acceleration times its duration.
const AT_REST: f64 = 1e-9;

/// A path with its timing.
///
/// A path of several straight legs rests where they meet, and each leg has its own profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    course: Course,
}

#[derive(Clone, Debug, PartialEq)]
enum Course {
    /// At least one leg.
    Legs { legs: Vec<TimedLeg>, rest_to_rest: bool },
    /// A spline in time, in s, at rest at both ends.
    Timed(Spline),
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

    /// Along the cubic spline through `start` and the `points`, natural at its ends and by the lengths of the chords, with one
    /// profile over its whole length. `None` where two successive points coincide, or where the spline turns back at a point.
    pub fn smooth(start: Vec2, points: &[Vec2], profile: Profile) -> Option<Self> {
        let all: Vec<Vec2> = std::iter::once(start).chain(points.iter().copied()).collect();
        Self::of_legs(vec![Leg::smooth(&all)?], profile)
    }

    /// Through `points` (m) at `times` (s), on the cubic spline in time that is at rest at both ends. The trajectory begins
    /// at 0 s. `None` where times do not rise, there are fewer than two, or all points coincide.
    pub fn timed(times: &[f64], points: &[Vec2]) -> Option<Self> {
        let first = *times.first()?;
        let times = times.iter().map(|time| time - first).collect();
        let spline = Spline::new(times, points.to_vec(), Ends::AtRest)?;
        let moves = spline.length() > 0.0 && spline.length().is_finite();
        moves.then_some(Self { course: Course::Timed(spline) })
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
        let course = Course::Legs { legs, rest_to_rest: profile.is_rest_to_rest() };
        (before > 0.0).then_some(Self { course })
    }

    /// How long the move takes, in s.
    pub fn duration(&self) -> f64 {
        match &self.course {
            Course::Legs { legs, .. } => legs.last().map_or(0.0, |last| last.start + last.timing.duration),
            Course::Timed(spline) => spline.end(),
        }
    }

    /// The arc length of the whole path, in m.
    pub fn length(&self) -> f64 {
        match &self.course {
            Course::Legs { legs, .. } => legs.last().map_or(0.0, |last| last.before + last.leg.length()),
            Course::Timed(spline) => spline.length(),
        }
    }

    /// Whether it begins and ends at rest.
    pub fn is_rest_to_rest(&self) -> bool {
        match &self.course {
            Course::Legs { rest_to_rest, .. } => *rest_to_rest,
            Course::Timed(_) => true,
        }
    }

    /// The times between 0 and the duration, both left out, at which the acceleration may jump, in rising order.
    pub fn breaks(&self) -> Vec<f64> {
        let Course::Legs { legs, .. } = &self.course else { return Vec::new() };
        let of_leg = |leg: &TimedLeg| {
            let start = leg.start;
            let inner: Vec<f64> = leg.timing.breaks().map(|time| start + time).collect();
            std::iter::once(start).chain(inner).collect::<Vec<f64>>()
        };
        legs.iter().flat_map(of_leg).filter(|time| *time > 0.0).collect()
    }

    /// The arc lengths in m at which the platform rests at a corner, both ends of the path left out.
    pub fn corners(&self) -> Vec<f64> {
        let Course::Legs { legs, .. } = &self.course else { return Vec::new() };
        legs.iter().skip(1).map(|leg| leg.before).collect()
    }

    /// What is prescribed at `time` (s). Where the acceleration jumps `side` tells which of the two is meant. After the end
    /// of a move from rest to rest the platform is at rest at the end; before its beginning at the start.
    pub fn at(&self, time: f64, side: Side) -> Moment {
        let left = side == Side::Left;
        let duration = self.duration();
        let over = time > duration || (time >= duration && !left);
        let mut moment = match &self.course {
            Course::Timed(spline) => on_spline(spline, time.clamp(0.0, duration), side),
            Course::Legs { legs, .. } => {
                let after = legs.partition_point(|leg| if left { leg.start < time } else { leg.start <= time });
                let leg = &legs[after.saturating_sub(1)];
                let [s, v, a] = leg.timing.at((time - leg.start).clamp(0.0, leg.timing.duration), left);
                let s = s.clamp(0.0, leg.leg.length());
                Moment { time, s: leg.before + s, v, a, point: leg.leg.at(s) }
            }
        };
        moment.time = time;
        if self.is_rest_to_rest() && (over || time < 0.0) {
            (moment.v, moment.a) = (0.0, 0.0);
        }
        moment
    }

    /// The point at arc length `s` (m) of the whole path; at a corner `side` tells which leg is meant.
    pub fn point(&self, s: f64, side: Side) -> PathPoint {
        match &self.course {
            Course::Timed(spline) => {
                let time = spline.parameter(s.clamp(0.0, spline.length()));
                let side = if time <= spline.start() {
                    Side::Right
                } else if time >= spline.end() {
                    Side::Left
                } else {
                    side
                };
                on_spline(spline, time, side).point
            }
            Course::Legs { legs, .. } => {
                let left = side == Side::Left;
                let after = legs.partition_point(|leg| if left { leg.before < s } else { leg.before <= s });
                let leg = &legs[after.saturating_sub(1)];
                leg.leg.at((s - leg.before).clamp(0.0, leg.leg.length()))
            }
        }
    }
}

/// What a spline in time prescribes. Where it rests, its tangent is the direction in which it leaves, or on the left side that
/// in which it came: so p̈ = p' s̈ there as well.
fn on_spline(spline: &Spline, time: f64, side: Side) -> Moment {
    let [position, velocity, acceleration] = spline.at(time);
    let v = velocity.norm();
    let least = AT_REST * acceleration.norm() * spline.end();
    let (tangent, curvature, v) = if v > least {
        let tangent = velocity / v;
        (tangent, (acceleration - tangent * tangent.dot(&acceleration)) / (v * v), v)
    } else {
        let leaves = acceleration.try_normalize(0.0).unwrap_or(Vec2::x());
        (if side == Side::Left { -leaves } else { leaves }, Vec2::zeros(), 0.0)
    };
    let point = PathPoint { position, tangent, curvature };
    Moment { time, s: spline.arc_length(time), v, a: tangent.dot(&acceleration), point }
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

    /// Velocity and acceleration are the derivatives of the position, on every kind of trajectory, at rest as well.
    #[test]
    fn moments_are_derivatives_of_the_position() {
        let points = [[1.0, 2.0], [3.0, 1.0], [2.0, -1.0]].map(Vec2::from);
        let start = Vec2::new(-0.5, 0.25);
        let all: Vec<Vec2> = std::iter::once(start).chain(points).collect();
        let quintic = Profile::Quintic { speed: 2.0 };
        let scurve = Profile::SCurve { speed: 2.0, acceleration: 3.0, jerk: 9.0 };
        for (name, trajectory) in [
            ("straight", Trajectory::straight(start, &points, quintic)),
            ("smooth", Trajectory::smooth(start, &points, quintic)),
            ("smooth with an S-curve", Trajectory::smooth(start, &points, scurve)),
            ("timed", Trajectory::timed(&[3.0, 4.0, 5.5, 6.5], &all)),
        ] {
            let trajectory = trajectory.expect(name);
            let (duration, h) = (trajectory.duration(), 1e-5);
            let position = |time: f64| trajectory.at(time, Side::Right).point.position;
            assert!(
                (position(0.0) - start).norm() < 1e-12 && (position(duration) - points[2]).norm() < 1e-12,
                "{name}"
            );
            for part in [0.11, 0.31, 0.5, 0.77, 0.93] {
                let time = part * duration;
                let moment = trajectory.at(time, Side::Right);
                let [before, here, after] = [time - h, time, time + h].map(position);
                let velocity = (after - before) / (2.0 * h);
                assert!((velocity - moment.velocity()).norm() < 1e-6, "{name} {part}: {velocity} {moment:?}");
                let acceleration = (after - here * 2.0 + before) / (h * h);
                assert!(
                    (acceleration - moment.acceleration()).norm() < 1e-3,
                    "{name} {part}: {acceleration} {moment:?}"
                );
                let point = trajectory.point(moment.s, Side::Right);
                assert!(
                    (point.position - here).norm() < 1e-10 && (point.tangent - moment.point.tangent).norm() < 1e-8,
                    "{name}"
                );
                assert!(
                    (point.tangent.norm() - 1.0).abs() < 1e-14 && point.tangent.dot(&point.curvature).abs() < 1e-12
                );
            }
            for (time, side) in [(0.0, Side::Right), (duration, Side::Left)] {
                let moment = trajectory.at(time, side);
                assert!(moment.v.abs() < 1e-9 && moment.velocity().norm() < 1e-9, "{name}: {moment:?}");
            }
            let after = trajectory.at(duration + 1.0, Side::Right);
            assert!(after.velocity().norm() + after.acceleration().norm() == 0.0, "{name}");
            assert!((after.s - trajectory.length()).abs() < 1e-12, "{name}");
        }
        // p̈ of the spline at its beginning, where it rests: from differences.
        let timed = Trajectory::timed(&[0.0, 1.0, 2.5, 3.5], &all).expect("a trajectory");
        let near = timed.at(1e-6, Side::Right).acceleration();
        assert!((timed.at(0.0, Side::Right).acceleration() - near).norm() < 1e-4);
    }

    /// Straight legs rest at their corners, where the direction changes at once; a spline does not.
    #[test]
    fn corners_are_where_legs_meet() {
        let points = [[3.0, 0.0], [3.0, 4.0]].map(Vec2::from);
        let profile = Profile::Trapezoid { speed: 1.0, acceleration: 1.0 };
        let straight = Trajectory::straight(Vec2::zeros(), &points, profile).expect("a path");
        assert_eq!((straight.corners(), straight.duration(), straight.length()), (vec![3.0], 9.0, 7.0));
        assert_eq!(straight.breaks(), [1.0, 3.0, 4.0, 5.0, 8.0]);
        let [before, after] = [Side::Left, Side::Right].map(|side| straight.at(4.0, side));
        assert!((before.acceleration() - Vec2::new(-1.0, 0.0)).norm() < 1e-15);
        assert!((after.acceleration() - Vec2::new(0.0, 1.0)).norm() < 1e-15);
        assert_eq!(straight.point(3.0, Side::Left).tangent, Vec2::x());
        assert_eq!(straight.point(3.0, Side::Right).tangent, Vec2::y());
        let smooth = Trajectory::smooth(Vec2::zeros(), &points, profile).expect("a path");
        assert!(smooth.corners().is_empty() && smooth.length() > 5.0 && smooth.length() < 7.5);
        // Backwards it is the same curve, and a mirror image has a mirror image's curvature.
        let mirrored = points.map(|p| Vec2::new(p.x, -p.y));
        let mirrored = Trajectory::smooth(Vec2::zeros(), &mirrored, profile).expect("a path");
        let (a, b) = (smooth.point(2.5, Side::Right), mirrored.point(2.5, Side::Right));
        assert!((a.curvature.y + b.curvature.y).abs() < 1e-14 && a.curvature.norm() > 0.1, "{a:?} {b:?}");
    }
}
