//! The path of the document: how people change it, and what it comes to in figures. Pure.

use crate::app::round::roundest;
use crate::app::studies::StudyResults;
use crate::robot::{BoundingBox, Side, Trajectory, Vec2};
use crate::scenario::{Corners, Path, Scenario};
use crate::study::{Answer, Study};

/// The speed of a new path in m/s where the motion has none.
const SPEED: f64 = 1.0;
/// How long a flight goes on after a new path, in s: what is left of vibrations is to be seen.
const HOLD: f64 = 2.0;
/// A mirrored point is an end where it is farther away than this part of the robot's width.
const FAR: f64 = 0.2;
/// Else the end is at this part of the way to the edge of the robot.
const PART: f64 = 0.6;
/// Coordinates of a new end are rounded to this part of the robot's width.
const ROUND: f64 = 0.01;
/// Straight pieces in which a smooth path is drawn, and at least so many times at which its figures are looked for.
const PIECES: usize = 200;

/// The scenario with a path straight to `end` (m); nothing where that is where the platform is.
pub fn begun(scenario: &Scenario, end: [f64; 2]) -> Option<Scenario> {
    let Scenario { motion, .. } = scenario;
    let speed = if motion.speed > 0.0 { motion.speed } else { SPEED };
    let path = Some(Path { hold: HOLD, ..Path::new(vec![end], speed) });
    let elsewhere = motion.position.iter().zip(end).any(|(start, end)| start.total_cmp(&end).is_ne());
    elsewhere.then(|| Scenario { path, ..scenario.clone() })
}

/// Where a new path leads: to the point opposite of the platform, as seen from the middle of `frame`, the box that the winches
/// span; from the middle in the direction of the motion. It is taken back into the feasible region where that is known.
pub fn usual_end(scenario: &Scenario, frame: BoundingBox, border: Option<&StudyResults>) -> [f64; 2] {
    let [position, direction] = [scenario.motion.position, scenario.motion.direction].map(Vec2::from);
    let (middle, size) = (frame.middle(), frame.size());
    let mirrored = middle * 2.0 - position;
    let way = if (mirrored - position).norm() > FAR * size.x {
        mirrored - position
    } else {
        let direction = direction.try_normalize(0.0).unwrap_or_else(Vec2::x);
        let room = |i: usize| {
            let edge = if direction[i] > 0.0 { frame.high[i] } else { frame.low[i] };
            if direction[i] == 0.0 { f64::INFINITY } else { (edge - position[i]) / direction[i] }
        };
        direction * (PART * room(0).min(room(1)))
    };
    let ends = (2..=10_u8).rev().map(|tenths| position + way * (0.1 * f64::from(tenths)));
    let ends = ends.map(|end| [0, 1].map(|i| roundest(end[i], ROUND * size.x)));
    let ends: Vec<[f64; 2]> = ends.collect();
    let allowed = |end: &&[f64; 2]| border.and_then(|known| feasible(known, **end)) != Some(false);
    ends.iter().find(allowed).or(ends.last()).copied().unwrap_or(middle.into())
}

/// Whether the robot can rest near a place (m), where `border` knows it.
fn feasible(border: &StudyResults, place: [f64; 2]) -> Option<bool> {
    let Study::Border { grid } = &border.request.study else { return None };
    let away = |i: &usize| (grid.position(*i) - Vec2::from(place)).norm_squared();
    let nearest = (0..grid.nx * grid.ny).min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let Some(Answer::Border(strip)) = border.places.get(nearest / grid.nx)? else { return None };
    strip.feasible.get(nearest % grid.nx).copied().flatten()
}

/// The scenario with one more point (m) on its path, between those where it makes the way longest by the least.
pub fn with_point(scenario: &Scenario, point: [f64; 2]) -> Scenario {
    let mut edited = scenario.clone();
    let Some(path) = &mut edited.path else { return edited };
    let corners = corners(scenario);
    let way = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let longer = |i: &usize| {
        let [from, to] = [corners[*i], corners[*i + 1]];
        way(from, point) + way(point, to) - way(from, to)
    };
    let leg = (0..path.points.len()).min_by(|a, b| longer(a).total_cmp(&longer(b))).unwrap_or(0);
    path.points.insert(leg, point);
    edited
}

/// The scenario with one more point in the middle of the longest leg of its path.
pub fn with_another(scenario: &Scenario) -> Scenario {
    let corners = corners(scenario);
    let length = |ends: &&[[f64; 2]]| (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
    match corners.windows(2).max_by(|a, b| length(a).total_cmp(&length(b))) {
        Some(ends) => with_point(scenario, [0, 1].map(|i| 0.5 * (ends[0][i] + ends[1][i]))),
        None => scenario.clone(),
    }
}

/// The scenario without a point (0-based) of its path; without the path where that was its only one.
pub fn without_point(scenario: &Scenario, point: usize) -> Scenario {
    let mut edited = scenario.clone();
    if let Some(path) = &mut edited.path {
        if point < path.points.len() {
            path.points.remove(point);
        }
        if path.points.len() < 2 {
            // A straight way has no corners.
            path.corners = Corners::Stop;
        }
    }
    edited.path = edited.path.filter(|path| !path.points.is_empty());
    edited
}

/// What a point (0-based) of a path of so many points is called.
pub fn name(point: usize, count: usize) -> String {
    if point + 1 == count { "To".into() } else { format!("Point {}", point + 1) }
}

/// The start and the points of its path, in m.
fn corners(scenario: &Scenario) -> Vec<[f64; 2]> {
    let points = scenario.path.iter().flat_map(|path| path.points.iter().copied());
    std::iter::once(scenario.motion.position).chain(points).collect()
}

/// What a move comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// How long it takes, in s.
    pub duration: f64,
    /// The highest speed that is reached, in m/s.
    pub speed: f64,
    /// The largest acceleration of the platform, in m/s²: along the path and across it.
    pub acceleration: f64,
}

/// The figures of a move, looked for between its breaks.
pub fn figures(trajectory: &Trajectory) -> Figures {
    let duration = trajectory.duration();
    let mut breaks = trajectory.breaks();
    breaks.insert(0, 0.0);
    breaks.push(duration);
    let pieces = (PIECES / breaks.len()).max(8);
    let (mut speed, mut acceleration) = (0.0_f64, 0.0_f64);
    for ends in breaks.windows(2) {
        for i in 0..=pieces {
            let time = ends[0] + (ends[1] - ends[0]) * i as f64 / pieces as f64;
            let side = if i == pieces { Side::Left } else { Side::Right };
            let moment = trajectory.at(time, side);
            speed = speed.max(moment.v);
            acceleration = acceleration.max(moment.acceleration().norm());
        }
    }
    Figures { duration, speed, acceleration }
}

/// A path as a line to draw: arc length in m and place in m. Straight legs have their ends alone.
pub fn line(scenario: &Scenario, trajectory: &Trajectory) -> Vec<(f64, [f64; 2])> {
    let smooth = scenario.path.as_ref().is_some_and(|path| path.corners == Corners::Smooth && path.points.len() > 1);
    let length = trajectory.length();
    if smooth {
        let s = (0..=PIECES).map(|i| length * i as f64 / PIECES as f64);
        return s.map(|s| (s, trajectory.point(s, Side::Left).position.into())).collect();
    }
    let mut s = 0.0;
    let corners = corners(scenario);
    let mut line: Vec<(f64, [f64; 2])> = corners.first().map(|start| (0.0, *start)).into_iter().collect();
    for ends in corners.windows(2) {
        s += (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
        line.push((s, ends[1]));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::canvas;
    use crate::robot::Profile;
    use crate::scenario::presets;

    fn paper() -> Scenario {
        presets::PRESETS[0].scenario()
    }

    fn end(scenario: &Scenario) -> [f64; 2] {
        usual_end(scenario, canvas::frame(scenario), None)
    }

    fn points(scenario: &Scenario) -> Vec<[f64; 2]> {
        scenario.path.clone().map(|path| path.points).unwrap_or_default()
    }

    fn is(found: [f64; 2], expected: [f64; 2]) {
        assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-12), "{found:?}, not {expected:?}");
    }

    #[test]
    fn a_new_path_leads_across_the_robot_or_from_its_middle_along_the_motion() {
        let mut scenario = paper();
        is(end(&scenario), [6.0, 0.0]);
        scenario.motion.direction = [0.0, -1.0];
        is(end(&scenario), [0.0, -3.0]);
        scenario.motion.position = [-6.0, 2.0];
        is(end(&scenario), [6.0, -2.0]);
        // Whatever the robot, it leads somewhere.
        for preset in presets::PRESETS {
            let scenario = preset.scenario();
            let with = begun(&scenario, end(&scenario)).expect("a path");
            assert!(with.to_robot().is_ok() && with.trajectory().is_some(), "{}", preset.name);
        }
        assert_eq!(begun(&paper(), paper().motion.position), None);
        // A path needs a speed.
        scenario.motion.speed = 0.0;
        assert!(begun(&scenario, [1.0, 0.0]).is_some_and(|with| with.to_robot().is_ok()));
    }

    #[test]
    fn points_come_between_those_that_they_are_between() {
        let scenario = begun(&paper(), [6.0, 0.0]).expect("a path");
        let scenario = with_another(&scenario);
        assert_eq!(points(&scenario), [[3.0, 0.0], [6.0, 0.0]]);
        let scenario = with_point(&scenario, [5.0, 0.5]);
        assert_eq!(points(&scenario), [[3.0, 0.0], [5.0, 0.5], [6.0, 0.0]]);
        let scenario = with_point(&scenario, [1.0, -0.5]);
        assert_eq!(points(&scenario), [[1.0, -0.5], [3.0, 0.0], [5.0, 0.5], [6.0, 0.0]]);
        assert_eq!(points(&without_point(&scenario, 3)), [[1.0, -0.5], [3.0, 0.0], [5.0, 0.5]]);
        assert_eq!([name(0, 4), name(3, 4), name(0, 1)], ["Point 1", "To", "To"]);
        let mut alone = begun(&paper(), [6.0, 0.0]).expect("a path");
        alone = without_point(&alone, 0);
        assert_eq!(alone, paper());
        assert_eq!(with_another(&alone), alone);
    }

    /// By hand: a quintic has its peak acceleration 10/√3 D/T² at τ = (1 − 1/√3)/2, with T = 15 D/(8 v).
    #[test]
    fn figures_of_profiles_that_are_known_by_hand() {
        let over = |profile| Trajectory::straight(Vec2::zeros(), &[Vec2::new(12.0, 0.0)], profile).expect("a path");
        let quintic = figures(&over(Profile::Quintic { speed: 5.0 }));
        let expected = 10.0 / 3.0_f64.sqrt() * 12.0 / (4.5 * 4.5);
        assert!((quintic.duration - 4.5).abs() < 1e-12 && (quintic.speed - 5.0).abs() < 1e-3, "{quintic:?}");
        // Looked for at 100 times: off by at most a thousandth, where the curve is flat.
        assert!((quintic.acceleration / expected - 1.0).abs() < 1e-3, "{quintic:?} {expected}");
        let trapezoid = figures(&over(Profile::Trapezoid { speed: 30.0, acceleration: 3.0 }));
        assert!((trapezoid.speed - 6.0).abs() < 1e-9 && (trapezoid.acceleration - 3.0).abs() < 1e-9, "{trapezoid:?}");
    }

    #[test]
    fn a_line_ends_where_the_path_does() {
        let mut scenario = with_point(&begun(&paper(), [6.0, 0.0]).expect("a path"), [3.0, 2.0]);
        let straight = line(&scenario, &scenario.trajectory().expect("a path"));
        assert_eq!(straight.iter().map(|point| point.1).collect::<Vec<_>>(), [[0.0, 0.0], [3.0, 2.0], [6.0, 0.0]]);
        assert!((straight[2].0 - 2.0 * 13.0_f64.sqrt()).abs() < 1e-12);
        if let Some(path) = &mut scenario.path {
            path.corners = Corners::Smooth;
        }
        let trajectory = scenario.trajectory().expect("a path");
        let smooth = line(&scenario, &trajectory);
        assert_eq!(smooth.len(), PIECES + 1);
        is(smooth[PIECES].1, [6.0, 0.0]);
        // Symmetric, so that the middle is the point between.
        assert!((smooth[PIECES / 2].1[0] - 3.0).abs() < 1e-9 && (smooth[PIECES / 2].1[1] - 2.0).abs() < 1e-9);
    }
}
