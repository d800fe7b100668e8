//! A drag ends with the answers that a start in its last pose gives: they do not depend on earlier computations.
//!
//! The engine is fed as the interface feeds it: some poses are dropped for newer ones, some are answered in full, some
//! are infeasible.

#![cfg(feature = "compute")]

mod common;

use common::random::{config, moving_robot};
use proptest::prelude::*;
use tautline::compute::Engine;
use tautline::compute::protocol::{Extent, Job, ModeChoice, Reply, Request, Revision, Update, Which};
use tautline::mechanics;
use tautline::robot::Vec2;
use tautline::scenario::Scenario;
use tautline::{Motion, Robot};

/// The critical speed is searched up to this speed, in m/s.
const LIMIT: f64 = 15.0;
/// The last pose's number.
const LAST: Revision = 1000;

/// One place on the way.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// From the last pose of the drag, in m.
    offset: [f64; 2],
    /// How much of its work the engine may do before the pointer moves on.
    slices: usize,
    /// Whether another mode is chosen here.
    chooses: bool,
}

/// A dozen or more places around the last pose; the engine does nothing at some, all of its work at others.
fn way() -> impl Strategy<Value = Vec<Place>> {
    let slices = prop_oneof![Just(0_usize), 1..4_usize, Just(usize::MAX)];
    let place = (-3.0..3.0, -3.0..3.0, slices, any::<bool>()).prop_map(|(x, y, slices, chooses)| Place {
        offset: [x, y],
        slices,
        chooses,
    });
    prop::collection::vec(place, 12..36)
}

/// The replies to the last pose, without reports of progress and without times. If a spectrum takes long, the slowest modes
/// come before it, and the curve of growth rates has fewer points, each found from the one before. So what comes before
/// the spectrum is left out, and of the curve only the beginning and the end are compared.
fn answers(replies: Vec<Reply>) -> Vec<Update> {
    let last = replies.into_iter().filter(|reply| reply.revision == LAST).map(|reply| reply.update);
    let preliminary = |update: &Update| match update {
        Update::Searching(_) => true,
        Update::Pose(pose) => pose.extent == Extent::SlowestSoFar,
        _ => false,
    };
    let kept = last.filter(|update| !preliminary(update));
    let timeless = |update| match update {
        Update::Critical(mut answer) => {
            answer.elapsed_ms = 0.0;
            Update::Critical(answer)
        }
        Update::Curve(points) => {
            let end = points.last().map(|point| [point[0], 0.0]);
            Update::Curve(points.into_iter().take(1).chain(end).collect())
        }
        other => other,
    };
    kept.map(timeless).collect()
}

/// Submits a pose and works at most so many slices.
fn submit(engine: &mut Engine, revision: Revision, robot: &Robot, motion: Motion, slices: usize) -> Vec<Reply> {
    let mode = ModeChoice { which: Which::Critical, along_x: false };
    let scenario = Scenario::new(robot, &motion).to_json();
    engine.submit(Request::Analyze(Job { revision, scenario, max_speed: LIMIT, mode }));
    std::iter::from_fn(|| engine.work()).take(slices).flatten().collect()
}

/// A mode that is chosen after the analysis, as by a click.
fn choose(engine: &mut Engine, along_x: bool) -> Vec<Reply> {
    engine.submit(Request::Shape(ModeChoice { which: Which::Near([-0.5, 4.0]), along_x }));
    std::iter::from_fn(|| engine.work()).flatten().collect()
}

proptest! {
    #![proptest_config(config(48))]

    #[test]
    fn a_drag_ends_where_a_start_does((robot, motion) in moving_robot(2..8), way in way()) {
        let feasible = |at: Vec2| mechanics::solve(&robot, at).is_ok();
        let places: Vec<Vec2> = way.iter().map(|place| motion.position() + Vec2::from(place.offset)).collect();
        // An answer at the end, and both kinds of pose on the way there.
        let kinds = [true, false].map(|kind| places.iter().filter(|&&at| feasible(at) == kind).count());
        prop_assume!(feasible(motion.position()) && kinds[0] >= 3 && kinds[1] >= 2);

        let mut cold = Engine::default();
        let mut expected = submit(&mut cold, LAST, &robot, motion, usize::MAX);
        expected.extend(choose(&mut cold, true));
        let expected = answers(expected);
        let has = |what: fn(&Update) -> bool| expected.iter().any(what);
        prop_assert!(has(|update| matches!(update, Update::Pose(_))), "{expected:?}");
        prop_assert!(has(|update| matches!(update, Update::Critical(_))), "{expected:?}");
        prop_assert!(has(|update| matches!(update, Update::Shape(_))), "{expected:?}");
        prop_assert!(has(|update| matches!(update, Update::Curve(_))), "{expected:?}");

        let mut engine = Engine::default();
        for (revision, (&at, place)) in (1..).zip(places.iter().zip(&way)) {
            let through = Motion::new(at, motion.direction(), motion.speed()).expect("a motion");
            submit(&mut engine, revision, &robot, through, place.slices);
            if place.chooses {
                engine.submit(Request::Shape(ModeChoice { which: Which::Near([0.0, 9.0]), along_x: place.slices == 0 }));
            }
        }
        let mut found = submit(&mut engine, LAST, &robot, motion, usize::MAX);
        found.extend(choose(&mut engine, true));
        prop_assert_eq!(answers(found), expected);
    }
}
