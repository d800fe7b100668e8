//! The pool of workers: every place of every study once, with the study's own answer; replacing, cancelling, holding.

#![cfg(feature = "compute")]

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, channel};
use std::thread::sleep;
use std::time::{Duration, Instant};

use nalgebra::Complex;
use tautline::compute::Pool;
use tautline::compute::protocol::{Revision, StudyJob, StudyNews, Topic};
use tautline::robot::Vec2;
use tautline::scenario::{Scenario, presets};
use tautline::study::{Answer, Directions, Grid, Line, Mapped, Reach, Study, Varied, WhatIf};

const LIMIT: f64 = 40.0;
const TOO_LONG: Duration = Duration::from_mins(2);

fn paper() -> Scenario {
    let mut scenario = presets::PRESETS[0].scenario();
    scenario.motion.position = [2.0, 0.5];
    scenario.motion.direction = [1.0, 0.5];
    scenario.elements_per_cable = 4;
    scenario
}

fn job(revision: Revision, study: Study) -> StudyJob {
    StudyJob { revision, scenario: paper().to_json(), study }
}

fn map(nx: usize, ny: usize) -> Study {
    let (robot, motion) = paper().to_robot().expect("physical");
    let mapped = Mapped::Critical { limit: LIMIT };
    Study::Map { grid: Grid::of(&robot, nx, ny), directions: Directions::One(motion.direction()), mapped }
}

fn line(count: usize) -> Study {
    let (robot, motion) = paper().to_robot().expect("physical");
    Study::Line { line: Line::through(&robot, &motion, count), limit: LIMIT }
}

/// One of each topic, the map last and in all its ways.
fn studies() -> Vec<Study> {
    let (robot, motion) = paper().to_robot().expect("physical");
    let (position, direction) = (motion.position(), motion.direction());
    let grid = Grid::of(&robot, 5, 4);
    let spectra = (0..5).map(|i| {
        let speed = f64::from(i);
        (speed, vec![Complex::new(-0.1 * speed, 2.0 + speed), Complex::new(-0.2, 9.0 - speed)])
    });
    let mut studies = vec![
        line(11),
        Study::Directions { position, count: 9, limit: LIMIT },
        Study::Campbell { position, direction, to: 12.0, count: 13 },
        Study::Mesh { position, direction, counts: vec![8, 2, 4], limit: LIMIT },
        Study::Modes { spectra: spectra.collect() },
        Study::Border { grid },
    ];
    for mapped in [Mapped::Critical { limit: LIMIT }, Mapped::Growth { speed: motion.speed() }] {
        for directions in [Directions::One(direction), Directions::Worst(Directions::WORST_OF)] {
            studies.push(Study::Map { grid, directions, mapped });
        }
    }
    studies
}

/// The answers of each topic.
#[derive(Default)]
struct Seen {
    answers: BTreeMap<(Topic, Revision), BTreeMap<usize, Answer>>,
    /// In the order in which they came.
    places: Vec<(Topic, usize)>,
    finished: Vec<(Topic, Revision)>,
}

impl Seen {
    fn take_in(&mut self, news: Vec<StudyNews>) {
        for news in news {
            match news {
                StudyNews::Places { topic, revision, answers } => {
                    assert!(!answers.is_empty());
                    for (place, answer) in answers {
                        self.places.push((topic, place));
                        let before = self.answers.entry((topic, revision)).or_default().insert(place, answer);
                        assert_eq!(before, None, "{topic:?} {place} came twice");
                    }
                }
                StudyNews::Part { .. } => {}
                StudyNews::Finished { topic, revision } => self.finished.push((topic, revision)),
                StudyNews::Refused { reason, .. } | StudyNews::Broken(reason) => panic!("{reason}"),
            }
        }
    }
}

struct Watched {
    pool: Pool,
    woken: Receiver<()>,
    seen: Seen,
}

impl Watched {
    fn new() -> Self {
        let (sender, woken) = channel();
        let wake = move || {
            // Nobody listens once the test has ended.
            let _ = sender.send(());
        };
        Self { pool: Pool::new(wake), woken, seen: Seen::default() }
    }

    /// Polls when woken, and only then, until `done`.
    fn until(&mut self, done: impl Fn(&Seen) -> bool) {
        self.seen.take_in(self.pool.poll());
        let begun = Instant::now();
        while !done(&self.seen) {
            let left = TOO_LONG.saturating_sub(begun.elapsed());
            self.woken.recv_timeout(left).expect("to be woken");
            self.seen.take_in(self.pool.poll());
        }
    }

    /// Waits until the batches on their way have come, then fetches their answers.
    fn settle(&mut self) {
        let mut before = usize::MAX;
        while self.seen.places.len() != before {
            before = self.seen.places.len();
            sleep(Duration::from_millis(300));
            self.seen.take_in(self.pool.poll());
        }
    }
}

#[test]
fn every_study_gives_at_every_place_what_it_gives_alone() {
    let (robot, _) = paper().to_robot().expect("physical");
    let mut watched = Watched::new();
    assert!((1..=8).contains(&watched.pool.size()));
    for (revision, study) in (1..).zip(studies()) {
        let topic = study.topic();
        watched.pool.want(job(revision, study.clone()));
        // What is small may have ended already.
        assert!(watched.pool.progress(topic).is_none_or(|(_, all)| all == study.len()));
        watched.until(|seen| seen.finished.contains(&(topic, revision)));
        assert_eq!(watched.pool.progress(topic), None);
        let expected: BTreeMap<usize, Answer> =
            (0..study.len()).map(|place| (place, study.answer(&robot, place))).collect();
        assert_eq!(watched.seen.answers[&(topic, revision)], expected);
    }
}

#[test]
fn all_topics_are_answered_side_by_side_and_a_map_starves_none() {
    let mut watched = Watched::new();
    watched.pool.want(job(1, map(33, 17)));
    for study in studies().into_iter().take(6) {
        watched.pool.want(job(1, study));
    }
    watched.until(|seen| seen.finished.len() == 7);
    assert_eq!(watched.seen.finished.last(), Some(&(Topic::Map, 1)));
    let of_the_map: Vec<usize> =
        watched.seen.places.iter().filter(|(topic, _)| *topic == Topic::Map).map(|(_, place)| *place).collect();
    assert_eq!(of_the_map.len(), 33 * 17);
    // Every 4th point of every 4th row comes first, but for what is on its way at the same time.
    let coarse = |place: usize| (place % 33).is_multiple_of(4) && (place / 33).is_multiple_of(4);
    let last_coarse = of_the_map.iter().rposition(|&place| coarse(place)).expect("a coarse place");
    let most_ahead = 2 * 64 * watched.pool.size();
    assert!(last_coarse < 9 * 5 + most_ahead, "the coarse picture is there after {last_coarse} places");
    let last_small = watched.seen.places.iter().rposition(|(topic, _)| *topic != Topic::Map).expect("a small study");
    assert!(last_small < watched.seen.places.len() / 2, "small studies end after {last_small} places");
}

#[test]
fn a_study_takes_the_place_of_its_topics_older_one() {
    let mut watched = Watched::new();
    watched.pool.want(job(1, map(33, 17)));
    watched.until(|seen| !seen.places.is_empty());
    // Both have the same places, so places alone would not tell them apart.
    let Study::Map { grid, mapped, .. } = map(33, 17) else { panic!("a map") };
    let other = Study::Map { grid, directions: Directions::One(Vec2::y()), mapped };
    watched.pool.want(job(2, other));
    watched.pool.want(job(3, line(3)));
    let old = watched.seen.answers[&(Topic::Map, 1)].len();
    watched.until(|seen| seen.finished.len() == 2);
    assert_eq!(watched.seen.answers[&(Topic::Map, 1)].len(), old, "more of what is wanted no longer");
    assert_eq!(watched.seen.answers[&(Topic::Map, 2)].len(), 33 * 17);
    assert!(!watched.seen.finished.contains(&(Topic::Map, 1)));
    for answer in watched.seen.answers[&(Topic::Map, 2)].values() {
        assert!(
            matches!(answer, Answer::Critical { direction, .. } if direction.y.to_bits() == 1.0_f64.to_bits()),
            "{answer:?}"
        );
    }
}

#[test]
fn nothing_more_comes_of_a_cancelled_study() {
    let mut watched = Watched::new();
    watched.pool.want(job(1, map(41, 21)));
    watched.until(|seen| !seen.places.is_empty());
    watched.pool.cancel(Topic::Map);
    assert_eq!(watched.pool.progress(Topic::Map), None);
    sleep(Duration::from_millis(100));
    assert_eq!(watched.pool.poll(), []);
}

#[test]
fn nothing_is_begun_while_held() {
    let mut watched = Watched::new();
    watched.pool.hold(true);
    watched.pool.want(job(1, map(41, 21)));
    watched.settle();
    assert_eq!((watched.seen.places.len(), watched.pool.progress(Topic::Map)), (0, Some((0, 861))));
    watched.pool.hold(false);
    watched.until(|seen| !seen.places.is_empty());
    watched.pool.hold(true);
    watched.settle();
    let held = watched.pool.progress(Topic::Map);
    assert!(held.is_some_and(|(answered, _)| answered < 861), "{held:?}");
    sleep(Duration::from_millis(100));
    assert_eq!((watched.pool.poll(), watched.pool.progress(Topic::Map)), (Vec::new(), held));
    watched.pool.hold(false);
    watched.until(|seen| seen.finished == [(Topic::Map, 1)]);
    assert_eq!(watched.seen.places.len(), 861);
}

#[test]
fn what_cannot_be_begun_is_refused_and_what_is_empty_is_finished() {
    let mut watched = Watched::new();
    let mut unphysical = job(1, map(3, 3));
    unphysical.scenario = unphysical.scenario.replace("\"mass\": 2", "\"mass\": -2");
    watched.pool.want(unphysical);
    let (position, direction) = (Vec2::zeros(), Vec2::x());
    watched.pool.want(job(2, Study::Directions { position, count: 4, limit: f64::NAN }));
    watched.pool.want(job(3, Study::Mesh { position, direction, counts: Vec::new(), limit: LIMIT }));
    let news = watched.pool.poll();
    let [
        StudyNews::Refused { topic: Topic::Map, revision: 1, reason: first },
        StudyNews::Refused { topic: Topic::Directions, revision: 2, reason: second },
        StudyNews::Finished { topic: Topic::Mesh, revision: 3 },
    ] = &news[..]
    else {
        panic!("{news:?}")
    };
    assert!(first.contains("platform.mass") && second.contains("NaN"), "{first} {second}");
    // A refusal takes the older study's place too.
    watched.pool.want(job(4, map(41, 21)));
    watched.pool.want(StudyJob { scenario: String::new(), ..job(5, map(3, 3)) });
    assert_eq!(watched.pool.progress(Topic::Map), None);
}

/// A message may hold any numbers. What no page asks for is refused, whoever asks: a worker has nothing else to go by.
#[test]
fn numbers_that_are_not_allowed_are_refused() {
    let (position, direction) = (Vec2::zeros(), Vec2::x());
    let nowhere = Vec2::new(f64::NAN, 0.0);
    let (count, limit) = (4, LIMIT);
    let grid = Grid { low: Vec2::zeros(), high: Vec2::new(1.0, 1.0), nx: 3, ny: 3 };
    let through = Line { from: Vec2::zeros(), to: Vec2::new(1.0, 0.0), direction, count };
    let (ahead, mapped) = (Directions::One(direction), Mapped::Critical { limit });
    let map = |grid, directions, mapped| Study::Map { grid, directions, mapped };
    let varied = |path: &str, value: f64| Varied { path: path.into(), values: vec![value] };
    let what_if = |numbers: Vec<Varied>, limit: f64| Study::WhatIf(WhatIf { numbers, limit });
    let refused = [
        Study::Line { line: Line { to: nowhere, ..through }, limit },
        Study::Line { line: Line { direction: Vec2::zeros(), ..through }, limit },
        Study::Line { line: Line { count: usize::MAX, ..through }, limit },
        Study::Line { line: through, limit: -1.0 },
        map(Grid { low: nowhere, ..grid }, ahead, mapped),
        map(Grid { nx: usize::MAX, ny: usize::MAX, ..grid }, ahead, mapped),
        map(grid, Directions::One(nowhere), mapped),
        map(grid, Directions::Worst(usize::MAX), mapped),
        map(grid, ahead, Mapped::Critical { limit: f64::INFINITY }),
        map(grid, ahead, Mapped::Growth { speed: f64::NAN }),
        Study::Border { grid: Grid { high: nowhere, ..grid } },
        Study::Border { grid: Grid { nx: usize::MAX, ..grid } },
        Study::Directions { position: nowhere, count, limit },
        Study::Campbell { position, direction, to: f64::NAN, count },
        Study::Campbell { position, direction: nowhere, to: 9.0, count },
        Study::Mesh { position: nowhere, direction, counts: vec![2], limit },
        what_if(vec![varied("gravity", f64::NAN)], limit),
        what_if(vec![varied("gravity", 1.0)], f64::NAN),
        what_if(Vec::new(), limit),
        what_if(vec![varied("gravity", 1.0); 2], limit),
        what_if(vec![varied("cable.colour", 1.0)], limit),
        Study::Reach(Reach { number: varied("gravity", 1.0), target: 0.0, limit }),
        Study::Reach(Reach { number: varied("gravity", 1.0), target: 2.0 * limit, limit }),
        Study::Modes { spectra: vec![(f64::NAN, Vec::new())] },
        Study::Modes { spectra: vec![(1.0, vec![Complex::new(0.0, f64::INFINITY)])] },
    ];
    let mut watched = Watched::new();
    for study in refused {
        watched.pool.want(job(1, study.clone()));
        let news = watched.pool.poll();
        assert!(matches!(news[..], [StudyNews::Refused { revision: 1, .. }]), "{study:?}: {news:?}");
    }
}
