//! Studies: each place has the answer of the analysis of its pose, the order makes a picture finer, modes are joined over
//! the speeds, and the limit of fine meshes is right.

mod common;

use std::collections::HashSet;
use std::f64::consts::TAU;

use common::close;
use common::random::{config, moving_robot};
use nalgebra::Complex;
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;
use tautline::mechanics::{self, CableShape, LengthRates, Material};
use tautline::robot::{Damping, Linearisation, RobotSpec, Vec2, paper, paper_spec};
use tautline::stability::{Critical, Instability, Outcome};
use tautline::study::campbell::{Track, track};
use tautline::study::convergence::{Convergence, Extrapolation, NoLimit, known_order, richardson};
use tautline::study::{
    Answer, Directions, Grid, Line, Mapped, NoEigenvalues, Study, Topic, Verdict, compass, evenly, verdict,
};
use tautline::{LocalProblem, Motion, Robot};

type C64 = Complex<f64>;

const LIMIT: f64 = 40.0;

fn motion(position: Vec2, direction: Vec2) -> Motion {
    Motion::new(position, direction, 0.0).expect("a motion")
}

/// What the analysis of one pose gives.
fn expected(robot: &Robot, position: Vec2, direction: Vec2) -> Verdict {
    let Ok(local) = LocalProblem::new(robot, &motion(position, direction)) else { return Verdict::Infeasible };
    match local.critical_speed(LIMIT) {
        Ok(Outcome::Found(critical)) => Verdict::Critical(critical),
        Ok(Outcome::NoneUpTo(limit)) => Verdict::NoneUpTo(limit),
        Err(_) => Verdict::NotConverged,
    }
}

/// The answer where a critical speed is asked for.
fn critical(study: &Study, robot: &Robot, index: usize) -> (Vec2, Verdict) {
    match study.answer(robot, index) {
        Answer::Critical { direction, verdict, .. } => (direction, verdict),
        other => panic!("{other:?}"),
    }
}

fn speed(verdict: &Verdict) -> Option<f64> {
    verdict.critical().map(|critical| critical.speed)
}

#[test]
fn every_task_is_the_analysis_of_its_pose() {
    let robot = paper().expect("the paper's robot");
    let up_right = Vec2::new(1.0, 1.0);
    let line = Line::through(&robot, &motion(Vec2::new(1.0, 1.0), up_right), 5);
    let grid = Grid::of(&robot, 5, 4);
    let position = Vec2::new(2.0, 1.0);
    let one = Directions::One(up_right);
    let mapped = Mapped::Critical { limit: LIMIT };
    let (mut feasible, mut infeasible) = (0, 0);
    for (study, places) in [
        (Study::Line { line, limit: LIMIT }, (0..5).map(|i| (line.position(i), up_right)).collect::<Vec<_>>()),
        (Study::Map { grid, directions: one, mapped }, (0..20).map(|i| (grid.position(i), up_right)).collect()),
        (Study::Directions { position, count: 7, limit: LIMIT }, (0..7).map(|i| (position, compass(i, 7))).collect()),
    ] {
        assert_eq!(study.len(), places.len());
        for (i, (position, along)) in places.into_iter().enumerate() {
            let (direction, found) = critical(&study, &robot, i);
            assert_eq!(direction, motion(position, along).direction());
            assert_eq!(found, expected(&robot, position, along), "at {position:?} along {along:?}");
            assert_eq!(found, verdict(&robot, &motion(position, along), LIMIT).0);
            if found.feasible() == Some(true) {
                feasible += 1;
            } else {
                infeasible += 1;
            }
        }
    }
    assert!(feasible > 10 && infeasible > 5, "{feasible} {infeasible}");

    let counts = vec![8, 4, 16, 1000];
    let study = Study::Mesh { position, direction: up_right, counts: counts.clone(), limit: LIMIT };
    for (i, &elements) in counts[..3].iter().enumerate() {
        let robot = Robot::new(RobotSpec { elements, ..paper_spec() }).expect("a robot");
        assert_eq!(critical(&study, &robot, i).1, expected(&robot, position, up_right));
    }
    assert_eq!((critical(&study, &robot, 3).1, study.order()), (Verdict::Unknown, vec![1, 0, 2, 3]));
}

#[test]
fn growth_and_spectra_are_those_of_the_pose() {
    let robot = paper().expect("the paper's robot");
    let (position, direction) = (Vec2::new(5.0, 0.0), Vec2::new(0.0, 1.0));
    let local = LocalProblem::new(&robot, &motion(position, direction)).map_err(|f| f.reason).expect("a pose");
    let grid = Grid::of(&robot, 5, 3);
    let growth = |directions, index| {
        let study = Study::Map { grid, directions, mapped: Mapped::Growth { speed: 6.0 } };
        match study.answer(&robot, index) {
            Answer::Growth(growth) => growth,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(grid.position(8), position);
    let spectrum = local.spectrum(6.0).expect("a spectrum");
    assert_eq!(growth(Directions::One(direction), 8), Ok(spectrum.growth_rate()));
    let singles = (0..8).map(|k| growth(Directions::One(compass(k, 8)), 8).expect("a rate"));
    assert_eq!(growth(Directions::Worst(8), 8).ok(), singles.reduce(f64::max));
    let infeasible = Err(NoEigenvalues::Infeasible);
    assert_eq!((growth(Directions::One(direction), 0), growth(Directions::Worst(8), 0)), (infeasible, infeasible));

    let study = Study::Campbell { position, direction, to: 12.0, count: 5 };
    let Answer::Spectrum(Ok(eigenvalues)) = study.answer(&robot, 2) else { panic!("no spectrum") };
    assert_eq!(eigenvalues, spectrum.modes().map(|mode| mode.eigenvalue).collect::<Vec<_>>());
    let nowhere = Study::Campbell { position: Vec2::new(9.0, 0.0), direction, to: 12.0, count: 5 };
    assert_eq!(nowhere.answer(&robot, 2), Answer::Spectrum(Err(NoEigenvalues::Infeasible)));
}

#[test]
fn what_is_no_pose_is_infeasible() {
    let robot = paper().expect("the paper's robot");
    let grid = Grid::of(&robot, 1, 1);
    let mapped = Mapped::Critical { limit: LIMIT };
    let (nowhere, origin) = (Vec2::new(f64::NAN, 0.0), Vec2::zeros());
    for study in [
        Study::Directions { position: nowhere, count: 1, limit: LIMIT },
        Study::Mesh { position: origin, direction: Vec2::zeros(), counts: vec![10], limit: LIMIT },
        Study::Map { grid, directions: Directions::One(nowhere), mapped },
        Study::Map { grid, directions: Directions::Worst(0), mapped },
        Study::Map { grid: Grid { low: nowhere, ..grid }, directions: Directions::Worst(16), mapped },
    ] {
        assert_eq!(critical(&study, &robot, 0).1, Verdict::Infeasible, "{study:?}");
    }
    let study = Study::Campbell { position: origin, direction: Vec2::x(), to: f64::INFINITY, count: 2 };
    assert_eq!(study.answer(&robot, 1), Answer::Spectrum(Err(NoEigenvalues::Infeasible)));
}

/// Within a thousandth of an edge on either side of the border the robot is what it is at that end of the edge.
#[test]
fn the_border_parts_what_is_feasible_from_what_is_not() {
    let robot = paper().expect("the paper's robot");
    let (columns, rows) = (21, 11);
    let grid = Grid::of(&robot, columns, rows);
    let study = Study::Border { grid };
    assert_eq!((study.len(), study.topic()), (rows, Topic::Border));
    let feasible = |at: Vec2| mechanics::solve(&robot, at).is_ok();
    let mut crossings = 0;
    for row in 0..rows {
        let Answer::Border(strip) = study.answer(&robot, row) else { panic!("no border") };
        assert_eq!((strip.feasible.len(), strip.right.len()), (columns, columns - 1));
        assert_eq!(strip.up.len(), if row + 1 < rows { columns } else { 0 });
        for column in 0..columns {
            let at = |row: usize, column: usize| grid.position(row * columns + column);
            let from = at(row, column);
            assert_eq!(strip.feasible[column], Some(feasible(from)), "at {from:?}");
            let edges = [(strip.right.get(column), (row, column + 1)), (strip.up.get(column), (row + 1, column))];
            for (crossing, (row, column)) in edges {
                let Some(crossing) = crossing else { continue };
                let to = at(row, column);
                let on_the_way = |part: f64| feasible(from + (to - from) * part.clamp(0.0, 1.0));
                match crossing {
                    None => assert_eq!(feasible(from), feasible(to), "between {from:?} and {to:?}"),
                    Some(part) => {
                        assert_eq!(on_the_way(part - 1e-3), feasible(from), "{part} between {from:?} and {to:?}");
                        assert_eq!(on_the_way(part + 1e-3), feasible(to), "{part} between {from:?} and {to:?}");
                        crossings += 1;
                    }
                }
            }
        }
    }
    assert!(crossings > 30, "{crossings}");
    assert!(matches!(study.unknown(3), Answer::Border(strip) if strip.feasible == vec![None; columns]));
}

/// Every index comes once. A picture of a quarter of the resolution comes first, then what half the resolution adds, then
/// the rest.
#[test]
fn orders_are_coarse_first() {
    let robot = paper().expect("the paper's robot");
    for (nx, ny) in [(41, 21), (40, 1), (1, 17), (8, 8), (3, 2), (1, 1), (0, 5)] {
        let study = Study::Map {
            grid: Grid::of(&robot, nx, ny),
            directions: Directions::Worst(16),
            mapped: Mapped::Critical { limit: LIMIT },
        };
        let order = study.order();
        assert_eq!((order.len(), order.iter().collect::<HashSet<_>>().len()), (nx * ny, nx * ny));
        assert!(order.iter().all(|&index| index < study.len()));
        for step in [8, 4, 2] {
            let coarse = nx.div_ceil(step) * ny.div_ceil(step);
            let in_it = |index: usize| (index % nx).is_multiple_of(step) && (index / nx).is_multiple_of(step);
            assert!(order[..coarse].iter().all(|&index| in_it(index)), "every {step}th of {nx} × {ny}");
        }
    }
    let study = Study::Directions { position: Vec2::zeros(), count: 12, limit: LIMIT };
    assert_eq!(study.order(), [0, 8, 4, 2, 6, 10, 1, 3, 5, 7, 9, 11]);
}

/// The paper's robot is its own mirror image: its tension laws change places with its cables.
#[test]
fn the_papers_map_is_its_mirror_image() {
    let robot = paper().expect("the paper's robot");
    let grid = Grid::of(&robot, 11, 5);
    let mapped = Mapped::Critical { limit: LIMIT };
    let mut compared = 0;
    for (direction, mirrored) in [([1.0, 0.0], [-1.0, 0.0]), ([0.6, -0.8], [-0.6, -0.8]), ([0.0, 1.0], [0.0, 1.0])] {
        let map = |direction: [f64; 2]| Study::Map { grid, directions: Directions::One(direction.into()), mapped };
        for index in 0..grid.len() {
            let other = index - index % 11 + (10 - index % 11);
            let (a, b) = (critical(&map(direction), &robot, index).1, critical(&map(mirrored), &robot, other).1);
            match (&a, &b) {
                (Verdict::Critical(a), Verdict::Critical(b)) => {
                    close(a.speed, b.speed, 1e-6, format!("{index}: critical speed"));
                    close(a.frequency_hz(), b.frequency_hz(), 1e-6, format!("{index}: frequency"));
                    assert_eq!(a.kind, b.kind, "{index}");
                    // On its way up the middle the robot is its own mirror image; both sides share the mode.
                    if !(index % 11 == 5 && direction[0] == 0.0) {
                        assert_eq!(a.cable, [1, 0, 3, 2][b.cable], "{index}");
                    }
                    compared += 1;
                }
                _ => assert_eq!(a, b, "{index}"),
            }
        }
    }
    assert!(compared > 60, "only {compared}");
}

/// A robot with its cables in another order.
fn reordered(robot: &Robot, order: &[usize]) -> Robot {
    let cables = order.iter().map(|&i| robot.cables[i]).collect();
    Robot::new(RobotSpec { cables, ..(**robot).clone() }).expect("the same robot")
}

/// In a symmetric pose two mirrored directions are critical at the same speed but for rounding, and so are mirrored cables.
/// Rounding differs with the order of the cables, and with it once the answer did.
#[test]
fn of_mirrored_directions_the_first_is_the_worst_however_numbers_are_rounded() {
    let directions = Directions::Worst(Directions::WORST_OF);
    let mapped = Mapped::Critical { limit: LIMIT };
    let mut compared = 0;
    for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
        let robot = Robot::new(RobotSpec { linearisation, ..paper_spec() }).expect("the paper's robot");
        for row in 0..9 {
            let low = Vec2::new(0.0, evenly(-3.0, 3.0, row, 9));
            let map = Study::Map { grid: Grid { low, high: low, nx: 1, ny: 1 }, directions, mapped };
            // Also exchanged pairs, which make of the robot its own mirror image.
            let answers = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0], [0, 3, 1, 2]].map(|order| {
                let (direction, verdict) = critical(&map, &reordered(&robot, &order), 0);
                (direction, verdict.critical().map(|critical| critical.speed))
            });
            let (first, lowest) = answers[0];
            for (direction, speed) in answers {
                assert_eq!(direction, first, "{linearisation:?} at {low:?}: {answers:?}");
                let apart = speed.zip(lowest).map_or(0.0, |(a, b)| (a - b).abs());
                assert!(
                    apart < 1e-7 && speed.is_some() == lowest.is_some(),
                    "{linearisation:?} at {low:?}: {answers:?}"
                );
            }
            // The mirror image is as bad, but comes later.
            if lowest.is_some() {
                let index = (0..16).find(|&k| compass(k, 16) == first).expect("one of them");
                let mirrored = (24 - index) % 16;
                assert!(index <= mirrored, "{linearisation:?} at {low:?}: {index} after {mirrored}");
                compared += 1;
            }
        }
    }
    assert!(compared > 10, "only {compared}");
}

#[test]
fn the_worst_direction_is_the_lowest_of_all() {
    let robot = paper().expect("the paper's robot");
    let grid = Grid::of(&robot, 9, 5);
    let mapped = Mapped::Critical { limit: LIMIT };
    let directions = Directions::Worst(Directions::WORST_OF);
    let map = Study::Map { grid, directions, mapped };
    let mut compared = 0;
    for index in 0..grid.len() {
        let (direction, worst) = critical(&map, &robot, index);
        let polar = Study::Directions { position: grid.position(index), count: 16, limit: LIMIT };
        let singles: Vec<(Vec2, Verdict)> = (0..16).map(|k| critical(&polar, &robot, k)).collect();
        let lowest = singles.iter().filter_map(|(_, single)| speed(single)).reduce(f64::min);
        match lowest {
            Some(lowest) => {
                close(speed(&worst).expect("a critical speed"), lowest, 1e-8, index);
                let (_, single) = singles.iter().find(|(single, _)| *single == direction).expect("one of the 16");
                close(speed(single).expect("a critical speed"), lowest, 1e-8, index);
                compared += 1;
            }
            None => assert_eq!(worst, singles[0].1),
        }
    }
    assert!(compared > 10, "only {compared}");
    // Where nothing is critical up to the limit, the limit is told, not where a search ended.
    let low = Study::Map { grid, directions, mapped: Mapped::Critical { limit: 0.25 } };
    assert_eq!(critical(&low, &robot, 22).1, Verdict::NoneUpTo(0.25));
}

#[test]
fn compass_directions_are_equally_spaced_unit_vectors() {
    for count in [1, 2, 3, 4, 16, 36] {
        for k in 0..count {
            let direction = compass(k, count);
            let angle = TAU * k as f64 / count as f64;
            assert!((direction - Vec2::new(angle.cos(), angle.sin())).norm() < 1e-14, "{k} of {count}");
        }
    }
    let axes = [0, 4, 8, 12].map(|k| compass(k, 16));
    assert_eq!(axes, [Vec2::x(), Vec2::y(), -Vec2::x(), -Vec2::y()]);
}

/// The paper's two findings, docs/theory.md section 10: towards the border the critical speed falls and the frequency
/// rises.
#[test]
fn towards_the_border_the_critical_speed_falls_and_the_frequency_rises() {
    let robot = paper().expect("the paper's robot");
    let line = Line::through(&robot, &motion(Vec2::new(3.0, 0.0), Vec2::x()), 41);
    let study = Study::Line { line, limit: LIMIT };
    let at = |x: f64| {
        let index = (0..study.len()).find(|&i| line.position(i) == Vec2::new(x, 0.0)).expect("a point of the line");
        critical(&study, &robot, index).1
    };
    let figures = [
        (0.0, 11.2990, 0.27155, 3),
        (2.0, 10.8539, 0.32172, 3),
        (4.0, 10.5393, 0.97313, 3),
        (6.0, 10.0125, 1.31195, 3),
        (7.0, 2.7584, 2.7113, 0),
    ];
    let mut before: Option<Critical> = None;
    for (x, speed, frequency, cable) in figures {
        let Verdict::Critical(critical) = at(x) else { panic!("nothing critical at x = {x}") };
        close(critical.speed, speed, 1e-4, format!("critical speed at x = {x}"));
        close(critical.frequency_hz(), frequency, 1e-4, format!("frequency at x = {x}"));
        assert_eq!((critical.cable, critical.kind), (cable, Instability::Flutter), "at x = {x}");
        if let Some(before) = before {
            assert!(critical.speed < before.speed && critical.frequency_hz() > before.frequency_hz(), "at x = {x}");
        }
        before = Some(critical);
    }
    assert_eq!((at(-10.0), at(7.5)), (Verdict::Infeasible, Verdict::Infeasible));
    // While one mode stays the first to cross, from the middle to x = 2.5, both are monotone from point to point.
    for x in [0.0, 0.5, 1.0, 1.5, 2.0] {
        let (Verdict::Critical(here), Verdict::Critical(there)) = (at(x), at(x + 0.5)) else { panic!("at x = {x}") };
        assert!(there.speed < here.speed && there.frequency_hz() > here.frequency_hz(), "at x = {x}");
    }
}

/// Fails unless every eigenvalue with Im λ ≥ 0 of every speed belongs to exactly one track, each track to successive
/// speeds.
fn check_tracks(spectra: &[(f64, Vec<C64>)], tracks: &[Track]) {
    let bits = |value: C64| (value.re.to_bits(), value.im.to_bits());
    for (k, (speed, values)) in spectra.iter().enumerate() {
        let mut given: Vec<_> = values.iter().filter(|value| value.im >= 0.0).map(|&value| bits(value)).collect();
        let points = tracks.iter().flat_map(|track| &track.points);
        let mut tracked: Vec<_> =
            points.filter(|(at, _)| at.to_bits() == speed.to_bits()).map(|&(_, value)| bits(value)).collect();
        given.sort_unstable();
        tracked.sort_unstable();
        assert_eq!(tracked, given, "at speed {k}");
    }
    for track in tracks {
        let first = spectra
            .iter()
            .position(|(speed, _)| speed.to_bits() == track.points[0].0.to_bits())
            .expect("a speed of the study");
        for ((speed, _), (at, _)) in track.points.iter().zip(&spectra[first..]) {
            assert_eq!(at.to_bits(), speed.to_bits());
        }
    }
}

/// A mode whose eigenvalue is a polynomial in the speed.
#[derive(Clone, Copy, Debug)]
struct Smooth {
    at_rest: C64,
    slope: C64,
    curvature: C64,
}

impl Smooth {
    fn at(self, v: f64) -> C64 {
        self.at_rest + self.slope * v + self.curvature * (v * v)
    }
}

fn smooth() -> impl Strategy<Value = Smooth> {
    ((-5.0..0.0, 15.0..70.0), (-1.0..1.0, -1.5..1.5), (-0.05..0.05, -0.05..0.05)).prop_map(
        |((a, b), (c, d), (e, f))| Smooth { at_rest: C64::new(a, b), slope: C64::new(c, d), curvature: C64::new(e, f) },
    )
}

/// Two modes as near each other as this at one of the speeds cannot be told apart for certain.
fn nearest(modes: &[Smooth], speeds: &[f64]) -> f64 {
    let pairs = (0..modes.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let gap = |(i, j): (usize, usize)| {
        speeds.iter().map(|&v| (modes[i].at(v) - modes[j].at(v)).norm()).fold(f64::INFINITY, f64::min)
    };
    pairs.map(gap).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(config(200))]

    /// Modes that cross in frequency, given in any order, are told apart.
    #[test]
    fn smooth_modes_are_found_again(
        modes in prop::collection::vec(smooth(), 1..25),
        seed in 0_usize..1000,
    ) {
        let speeds: Vec<f64> = (0..61).map(|i| evenly(0.0, 6.0, i, 61)).collect();
        // From rest on no slope is known yet.
        prop_assume!(nearest(&modes, &speeds[..1]) > 0.5 && nearest(&modes, &speeds) > 0.05);
        let spectra: Vec<(f64, Vec<C64>)> = speeds
            .iter()
            .enumerate()
            .map(|(k, &v)| {
                let mut values: Vec<C64> = modes.iter().map(|mode| mode.at(v)).collect();
                values.rotate_left((seed + 7 * k) % modes.len());
                // Their mirror images are left out.
                let mirrored: Vec<C64> = values.iter().map(Complex::conj).collect();
                (v, [values, mirrored].concat())
            })
            .collect();
        prop_assume!(spectra.iter().flat_map(|(_, values)| &values[..modes.len()]).all(|value| value.im > 0.5));
        let tracks = track(&spectra);
        check_tracks(&spectra, &tracks);
        prop_assert_eq!(tracks.len(), modes.len());
        for track in &tracks {
            let mode = modes.iter().find(|mode| mode.at_rest == track.points[0].1).expect("a mode");
            for &(v, value) in &track.points {
                prop_assert_eq!(value, mode.at(v));
            }
        }
    }
}

proptest! {
    #![proptest_config(config(30))]

    /// Nothing is lost or doubled, and looking more closely changes hardly anything.
    #[test]
    fn tracks_of_random_robots_are_whole((robot, motion) in moving_robot(2..12)) {
        let study = Study::Campbell { position: motion.position(), direction: motion.direction(), to: 6.0, count: 121 };
        let answers = (0..study.len()).map(|i| match study.answer(&robot, i) {
            Answer::Spectrum(spectrum) => spectrum.ok().map(|values| (evenly(0.0, 6.0, i, 121), values)),
            other => panic!("{other:?}"),
        });
        let fine: Option<Vec<(f64, Vec<C64>)>> = answers.collect();
        prop_assume!(fine.is_some());
        let fine = fine.unwrap_or_default();
        let coarse: Vec<(f64, Vec<C64>)> = fine.iter().step_by(2).cloned().collect();
        let (of_fine, of_coarse) = (track(&fine), track(&coarse));
        check_tracks(&fine, &of_fine);
        check_tracks(&coarse, &of_coarse);
        let kept: HashSet<u64> = coarse.iter().map(|(speed, _)| speed.to_bits()).collect();
        let links = |tracks: &[Track]| -> HashSet<[u64; 6]> {
            let bits = |(v, value): (f64, C64)| [v, value.re, value.im].map(f64::to_bits);
            tracks
                .iter()
                .flat_map(|track| {
                    let points: Vec<_> =
                        track.points.iter().copied().filter(|(v, _)| kept.contains(&v.to_bits())).collect();
                    points.windows(2).map(|w| (bits(w[0]), bits(w[1]))).collect::<Vec<_>>()
                })
                .map(|([a, b, c], [d, e, f])| [a, b, c, d, e, f])
                .collect()
        };
        let (of_fine, of_coarse) = (links(&of_fine), links(&of_coarse));
        let same = of_fine.intersection(&of_coarse).count();
        prop_assert!(100 * same >= 97 * of_coarse.len(), "{same} of {}", of_coarse.len());
    }
}

/// λ² + 2 c λ + 1 = 0: a pair up to c = 1, two real eigenvalues beyond.
fn oscillator(c: f64, scale: f64) -> Vec<C64> {
    let square = c * c - 1.0;
    if square < 0.0 {
        vec![C64::new(-c, (-square).sqrt()) * scale]
    } else {
        vec![C64::new(-c + square.sqrt(), 0.0) * scale, C64::new(-c - square.sqrt(), 0.0) * scale]
    }
}

#[test]
fn an_overdamped_pair_goes_on_as_two_real_tracks_and_back() {
    // A second pair far away and real eigenvalues nearby do not matter.
    let others = |v: f64| vec![C64::new(-0.2, 9.0 + v), C64::new(-0.1 - 0.05 * v, 0.0), C64::new(-30.0 + v, 0.0)];
    let speeds = |count| (0..count).map(move |i| evenly(0.0, 2.0, i, count));
    for count in [22, 40, 201] {
        let there: Vec<(f64, Vec<C64>)> =
            speeds(count).map(|v| (v, [oscillator(v, 3.0), others(v)].concat())).collect();
        let tracks = track(&there);
        check_tracks(&there, &tracks);
        let lengths: Vec<usize> = tracks.iter().map(|track| track.points.len()).collect();
        let real = there.iter().filter(|(v, _)| *v >= 1.0).count();
        assert_eq!(lengths, [count, count, count, count, real]);
        assert!(tracks[0].points[0].1.im > 2.9 && tracks[0].points[count - 1].1.im == 0.0);

        let back: Vec<(f64, Vec<C64>)> =
            speeds(count).map(|v| (v, [oscillator(2.0 - v, 3.0), others(v)].concat())).collect();
        let tracks = track(&back);
        check_tracks(&back, &tracks);
        let mut lengths: Vec<usize> = tracks.iter().map(|track| track.points.len()).collect();
        lengths.sort_unstable();
        let real = back.iter().filter(|(_, values)| values.len() == 5).count();
        assert_eq!(lengths, [real, count, count, count, count]);
    }
}

#[test]
fn tracks_of_nothing_and_of_gaps() {
    assert!(track(&[]).is_empty());
    let value = C64::new(-1.0, 2.0);
    let spectra = [(0.0, vec![value, value]), (1.0, vec![]), (2.0, vec![value, value.conj()])];
    let tracks = track(&spectra);
    check_tracks(&spectra, &tracks);
    assert_eq!(tracks.len(), 3);
}

/// Isotropic problems give every eigenvalue twice; the distinct ones are tracked.
#[test]
fn double_eigenvalues_are_tracked_once() {
    let spectrum = |linearisation| {
        let robot = Robot::new(RobotSpec { linearisation, ..paper_spec() }).expect("a robot");
        let study = Study::Campbell { position: Vec2::zeros(), direction: Vec2::x(), to: 4.0, count: 2 };
        match study.answer(&robot, 1) {
            Answer::Spectrum(Ok(values)) => {
                values.iter().map(|value| if value.im > 0.0 { 2 } else { 1 }).sum::<usize>()
            }
            other => panic!("{other:?}"),
        }
    };
    assert_eq!((spectrum(Linearisation::Secant), spectrum(Linearisation::Tangent)), (74, 148));
}

fn flutter(speed: f64, frequency: f64, cable: usize) -> Verdict {
    let eigenvalue = C64::new(0.0, TAU * frequency);
    Verdict::Critical(Critical { speed, eigenvalue, kind: Instability::Flutter, cable })
}

fn limit(meshes: &[(usize, Verdict)], today: usize) -> Extrapolation {
    match richardson(meshes, today) {
        Convergence::Limit(extrapolation) => extrapolation,
        other @ Convergence::Unknown(_) => panic!("{other:?}"),
    }
}

fn divergence(speed: f64) -> Verdict {
    Verdict::Critical(Critical { speed, eigenvalue: C64::new(0.0, 0.0), kind: Instability::Divergence, cable: 3 })
}

/// The limit is between the one that the order seen promises and the one that the known order promises.
fn holds(found: &Extrapolation, limit: f64) -> bool {
    (found.limit - limit).abs() <= found.uncertainty
}

#[test]
fn richardson_finds_order_and_limit() {
    // Powers of 1/n: the order is found; the known one, 2 or 1, pulls at the limit, within its uncertainty.
    for (order, verdict) in [
        (1.2, (|v| flutter(v, 0.3, 3)) as fn(f64) -> Verdict),
        (2.0, |v| flutter(v, 0.3, 3)),
        (2.7, |v| flutter(v, 0.3, 3)),
        (0.8, divergence),
        (1.0, divergence),
        (2.0, divergence),
    ] {
        let law = |n: usize| 10.0 + 3.0 * (n as f64).powf(-order);
        let meshes: Vec<_> = [80, 10, 20, 40, 14].map(|n| (n, verdict(law(n)))).into();
        let found = limit(&meshes, 10);
        assert!(found.estimated && holds(&found, 10.0), "order {order}: {found:?}");
        close(found.order, order, 1e-6, "order");
        let known = known_order(meshes[0].1.critical().expect("critical").kind);
        if (order - known).abs() < 1e-12 {
            close(found.limit, 10.0, 1e-8, "limit");
        }
        // If the orders agree within a third, the uncertainty is less than all that extrapolation adds.
        let added = (law(80) - found.limit).abs();
        assert!((order / known - 1.0).abs() > 0.1 || found.uncertainty < 0.3 * added, "order {order}: {found:?}");
        close(found.error.expect("an error"), law(10) - found.limit, 1e-12, "error");
        assert_eq!(limit(&meshes, 12).error, None);
    }
    // A second power beside the first: the two promises are on either side of the limit.
    for (lead, next, verdict) in [
        (2, 3, (|v| flutter(v, 0.3, 3)) as fn(f64) -> Verdict),
        (2, 4, |v| flutter(v, 0.3, 3)),
        (1, 2, divergence),
        (1, 3, divergence),
    ] {
        for share in [-3.0, -0.5, 0.5, 3.0] {
            let law = |n: usize| 10.0 + (n as f64).powi(-lead) + share * (n as f64).powi(-next);
            let found = limit(&[10, 20, 40].map(|n| (n, verdict(law(n)))), 10);
            let sides = [found.limit - found.uncertainty, found.limit + found.uncertainty];
            assert!(sides[0] < 10.0 && 10.0 < sides[1], "powers {lead}, {next}, share {share}: {found:?}");
        }
    }
    // Without three meshes in a doubling ratio the order is the known one, and all that is added is in doubt.
    let law = |n: f64| 5.0 - 7.0 / (n * n);
    let found = limit(&[(10, flutter(law(10.0), 0.3, 3)), (14, flutter(law(14.0), 0.3, 3))], 14);
    assert!(!found.estimated);
    close(found.limit, 5.0, 1e-12, "limit");
    close(found.uncertainty, 7.0 / 196.0, 1e-12, "uncertainty");
    let found = limit(&[(10, divergence(5.7)), (14, divergence(5.5))], 14);
    close(found.limit, 5.0, 1e-12, "limit");
    // Nothing left to gain.
    let same = [(10, flutter(4.0, 0.3, 3)), (20, flutter(4.0, 0.3, 3)), (40, flutter(4.0, 0.3, 3))];
    let found = limit(&same, 10);
    assert_eq!((found.limit, found.order, found.estimated, found.error), (4.0, 2.0, false, Some(0.0)));
    assert!(found.uncertainty > 0.0 && found.uncertainty < 1e-6, "{found:?}");
    // The same holds for the frequency.
    let meshes = [10, 20, 40].map(|n| (n, flutter(4.0 + 1.0 / (n * n) as f64, 0.3 - 0.5 / (n * n) as f64, 3)));
    let frequency = limit(&meshes, 10).frequency;
    close(frequency.limit, 0.3, 1e-9, "frequency");
    assert!(frequency.uncertainty < 1e-4, "{frequency:?}");
}

#[test]
fn richardson_says_when_it_cannot_tell() {
    let f = |n: usize, speed: f64| (n, flutter(speed, 0.3, 3));
    for (meshes, doubt) in [
        (vec![], NoLimit::NoneCritical),
        (vec![f(10, 9.0), (20, Verdict::NoneUpTo(40.0))], NoLimit::NoneCritical),
        (vec![f(10, 9.0)], NoLimit::TooFew),
        (vec![(10, Verdict::Infeasible), f(20, 9.0)], NoLimit::TooFew),
        (vec![f(10, 9.0), (20, Verdict::NotConverged)], NoLimit::TooFew),
        // Another kind, cable or mode on any of the meshes that are used, or on a finer one.
        (vec![f(10, 9.0), f(20, 8.9), (40, divergence(8.8))], NoLimit::Changes),
        (vec![f(10, 9.0), f(20, 8.9), (40, flutter(8.8, 0.3, 1))], NoLimit::Changes),
        (vec![f(10, 9.0), f(20, 8.9), (40, flutter(8.8, 0.5, 3))], NoLimit::Changes),
        (vec![(10, divergence(9.0)), f(20, 8.9), f(40, 8.87)], NoLimit::Changes),
        (vec![f(10, 9.0), (20, Verdict::NoneUpTo(40.0)), f(40, 8.87)], NoLimit::Changes),
        (vec![f(10, 9.4), f(20, 9.1), f(40, 9.0), (56, divergence(8.8))], NoLimit::Changes),
        // No order, or one that no mode has.
        (vec![f(10, 9.0), f(20, 8.9), f(40, 8.7)], NoLimit::Unsettled),
        (vec![f(10, 9.0), f(20, 8.9), f(40, 9.0)], NoLimit::Unsettled),
        (vec![f(10, 9.0), f(20, 8.9), f(40, 8.93)], NoLimit::Unsettled),
        (vec![f(10, 9.0), f(20, 8.9), f(40, 8.8999)], NoLimit::Unsettled),
        (vec![(10, divergence(9.0)), (20, divergence(8.9)), (40, divergence(8.82))], NoLimit::Unsettled),
    ] {
        assert_eq!(richardson(&meshes, 10), Convergence::Unknown(doubt), "{meshes:?}");
    }
    // A coarser mesh with another mode does not count, and has no error to tell.
    let meshes = [(8, flutter(12.0, 1.0, 0)), f(10, 9.0), f(20, 8.25)];
    let found = limit(&meshes, 8);
    close(found.limit, 8.0, 1e-12, "limit");
    assert_eq!(found.error, None);
    // A mesh beside the doubled ones does not count either.
    let found = limit(&[f(10, 9.0), f(20, 8.25), f(40, 8.0625), f(48, 8.05)], 10);
    close(found.limit, 8.0, 1e-9, "limit");
}

/// The meshes of a robot and its motion, each with its verdict.
fn meshes(robot: &Robot, motion: &Motion, counts: &[usize]) -> Vec<(usize, Verdict)> {
    let (position, direction) = (motion.position(), motion.direction());
    let study = Study::Mesh { position, direction, counts: counts.to_vec(), limit: LIMIT };
    counts.iter().enumerate().map(|(i, &n)| (n, critical(&study, robot, i).1)).collect()
}

/// The speed at which the flow in a cable reaches the speed of waves, in a cable without a mesh: with secant stiffness
/// a divergence has no other place (docs/theory.md section 10). The shapes are those of 200 elements.
fn wave_limit(robot: &Robot, motion: &Motion) -> f64 {
    let robot = Robot::new(RobotSpec { elements: 200, ..(**robot).clone() }).expect("a robot");
    let local = LocalProblem::new(&robot, motion).expect("a pose");
    let of_cable = |(cable, (shape, rates)): (usize, (&CableShape, &LengthRates))| {
        let (law, mu) = (Material::of(&robot, cable), robot.material_of(cable).mass_per_length);
        let weight = mu * robot.gravity;
        let at_platform = shape.t0 - Vec2::new(0.0, 0.5 * weight * shape.length / 200.0);
        let at = |part: f64| {
            let force = (at_platform + Vec2::new(0.0, weight * shape.length * part)).norm();
            let waves = (force / law.stretch(force) / mu).sqrt();
            waves / (rates.first.abs() * part)
        };
        (1..=10_000).map(|i| at(f64::from(i) / 10_000.0)).fold(f64::INFINITY, f64::min)
    };
    local.statics.cables.iter().zip(&local.rates).enumerate().map(of_cable).fold(f64::INFINITY, f64::min)
}

/// The limits that coarse meshes of random robots promise, with their uncertainty, hold the better known value. For a
/// divergence that is the speed at which the flow reaches the waves; for flutter it is the limit of finer meshes. If modes
/// change between meshes there is no promise.
#[test]
fn error_bars_hold_the_limit() {
    let mut runner = TestRunner::new(config(1));
    let mut counts = [0; 2];
    let enough = 20;
    while counts.iter().any(|count| *count < enough) {
        let (robot, motion) = moving_robot(10..11).new_tree(&mut runner).expect("a robot").current();
        // Heavy damping makes divergence as frequent as flutter; its place is known with secant stiffness.
        let wanted = usize::from(counts[0] >= counts[1]);
        let alpha = if wanted == 1 { 40.0 } else { robot.damping.alpha };
        let damping = Damping { alpha, ..robot.damping };
        let robot = Robot::new(RobotSpec { damping, linearisation: Linearisation::Secant, ..(*robot).clone() });
        let robot = robot.expect("a robot");
        let (first, _) = verdict(&robot, &motion, LIMIT);
        let kind = first.critical().filter(|critical| critical.speed > 0.0).map(|critical| critical.kind);
        if kind != Some([Instability::Flutter, Instability::Divergence][wanted]) {
            continue;
        }
        let Convergence::Limit(found) = richardson(&meshes(&robot, &motion, &[8, 16, 32]), 8) else { continue };
        let (expected, more) = match kind {
            Some(Instability::Divergence) => (wave_limit(&robot, &motion), 0.0),
            _ => match richardson(&meshes(&robot, &motion, &[16, 32, 64]), 16) {
                Convergence::Limit(fine) => (fine.limit, fine.uncertainty),
                Convergence::Unknown(_) => continue,
            },
        };
        let off = (found.limit - expected).abs();
        assert!(off <= found.uncertainty + more, "{expected} m/s is not in {found:?}: {robot:?} {motion:?}");
        // An error bar as wide as the finest mesh's error would tell nothing.
        let finest = found.error.expect("an error").abs();
        assert!(found.uncertainty < 0.5 * finest + 1e-6 * expected, "{found:?}");
        counts[wanted] += 1;
    }
}

/// The paper's robot with heavy damping diverges where the flow reaches the waves', 8 % below what 10 elements give.
#[test]
fn the_limit_of_a_divergence_is_the_speed_of_waves() {
    let robot =
        Robot::new(RobotSpec { damping: Damping { alpha: 50.0, beta: 0.005 }, ..paper_spec() }).expect("a robot");
    let motion = motion(Vec2::zeros(), Vec2::x());
    let expected = wave_limit(&robot, &motion);
    for counts in [[10, 20, 40], [20, 40, 80]] {
        let found = meshes(&robot, &motion, &counts);
        let v = speed(&found[0].1).expect("a critical speed");
        let told = limit(&found, counts[0]);
        assert!(holds(&told, expected), "{expected} {told:?}");
        assert!(told.uncertainty < 0.1 * (v - expected), "{told:?}");
        if counts[0] == 10 {
            close(v, 12.838, 1e-3, "critical speed with 10 elements");
            close(v / expected, 1.08, 0.005, "critical speed with 10 elements in parts of the limit");
        }
    }
}

/// docs/theory.md section 10. The limit that meshes up to 80 elements promise is where one of 160 elements is going.
#[test]
fn the_papers_robot_converges() {
    let robot = paper().expect("the paper's robot");
    let meshes = |x: f64, counts: &[usize]| meshes(&robot, &motion(Vec2::new(x, 0.0), Vec2::x()), counts);
    let at_origin = meshes(0.0, &[10, 20, 40, 80, 160]);
    for ((n, found), expected) in at_origin.iter().zip([11.2990, 11.0743, 11.0141, 10.9986]) {
        close(speed(found).expect("a critical speed"), expected, 1e-4, format!("critical speed with {n} elements"));
    }
    let found = limit(&at_origin[..4], 10);
    assert!(found.estimated);
    close(found.order, 1.96, 0.01, "order");
    assert!(holds(&found, 10.9932) && found.uncertainty < 2e-3, "{found:?}");
    close(found.error.expect("an error"), 0.306, 1e-3, "error with 10 elements");
    let [at_80, at_160] = [3, 4].map(|i| speed(&at_origin[i].1).expect("a critical speed"));
    close(at_160, found.limit + (at_80 - found.limit) / 4.0, 3e-4, "critical speed with 160 elements");

    // Close to the border meshes disagree on the mode.
    for (x, n, cable, kind) in [
        (6.0, 28, 3, Instability::Flutter),
        (6.0, 40, 0, Instability::Divergence),
        (7.0, 10, 0, Instability::Flutter),
        (7.0, 14, 0, Instability::Divergence),
    ] {
        let found = meshes(x, &[n]);
        let critical = found[0].1.critical().expect("a critical speed");
        assert_eq!((critical.cable, critical.kind), (cable, kind), "{n} elements at x = {x}");
    }
    assert_eq!(richardson(&meshes(6.0, &[20, 28, 40]), 28), Convergence::Unknown(NoLimit::Changes));
}
