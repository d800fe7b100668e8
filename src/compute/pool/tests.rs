//! What the pool does where workers fail, and in which order it serves: with workers and a clock made up here, and
//! with threads that panic.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use super::platform::SharedCore;
use super::scheduler::{Action, Scheduler, WorkerId};
use crate::compute::protocol::{AnsweredBatch, Batch, Revision, StudyJob, StudyNews, Task, Topic};
use crate::compute::robot_study::RobotStudy;
use crate::robot::{Motion, Robot, Vec2};
use crate::scenario::presets;
use crate::study::{Answer, Directions, Grid, Line, Mapped, Study, Verdict};

fn robot() -> (Robot, Motion) {
    presets::PRESETS[0].scenario().to_robot().expect("physical")
}

fn job(revision: Revision, study: Study) -> StudyJob {
    StudyJob { revision, scenario: presets::PRESETS[0].scenario().to_json(), study }
}

fn line(points: usize) -> Study {
    let (robot, motion) = robot();
    Study::Line { line: Line::through(&robot, &motion, points), limit: 40.0 }
}

fn growth_map(nx: usize, ny: usize) -> Study {
    let (robot, motion) = robot();
    let mapped = Mapped::Growth { speed: motion.speed() };
    Study::Map { grid: Grid::of(&robot, nx, ny), directions: Directions::One(motion.direction()), mapped }
}

const ANSWER: Answer = Answer::Growth(Ok(-1.0));
const UNKNOWN: Verdict = Verdict::Unknown;

/// A scheduler with its clock and what its workers have been told.
struct Rehearsal {
    scheduler: Scheduler,
    clock: Duration,
    inboxes: BTreeMap<WorkerId, Vec<Task>>,
    stopped: Vec<WorkerId>,
    /// Workers that have been started; they are ready at once unless `start` is false.
    starts: Vec<WorkerId>,
    start: bool,
}

impl Rehearsal {
    fn new(size: usize) -> Self {
        let scheduler = Scheduler::new(size, true);
        Self {
            scheduler,
            clock: Duration::ZERO,
            inboxes: BTreeMap::new(),
            stopped: Vec::new(),
            starts: Vec::new(),
            start: true,
        }
    }

    fn go_on(&mut self) {
        loop {
            let actions = self.scheduler.plan(self.clock);
            if actions.is_empty() {
                return;
            }
            for action in actions {
                match action {
                    Action::Start(worker) => {
                        self.starts.push(worker);
                        if self.start {
                            self.scheduler.ready(worker);
                        }
                    }
                    Action::Tell(worker, task) => self.inboxes.entry(worker).or_default().push(task),
                    Action::Stop(worker) => {
                        self.inboxes.remove(&worker);
                        self.stopped.push(worker);
                    }
                }
            }
        }
    }

    fn pass(&mut self, seconds: f64) {
        // As a heartbeat does, in small steps.
        for _ in 0..4 {
            self.clock += Duration::from_secs_f64(seconds / 4.0);
            self.go_on();
        }
    }

    /// The batch that a worker is at.
    fn at(&self, worker: WorkerId) -> Option<Batch> {
        self.inboxes.get(&worker)?.iter().find_map(|task| match task {
            Task::Batch(batch) => Some(batch.clone()),
            Task::Study { .. } | Task::Forget(_) => None,
        })
    }

    /// A worker answers the first places of its batch in a number of seconds.
    fn answer(&mut self, worker: WorkerId, places: usize, seconds: f64) {
        let batch = self.at(worker).expect("a batch");
        if let Some(inbox) = self.inboxes.get_mut(&worker) {
            let first = inbox.iter().position(|task| matches!(task, Task::Batch(_))).expect("a batch");
            inbox.drain(..=first);
        }
        let answers = batch.places.iter().take(places).map(|&place| (place, ANSWER)).collect();
        self.scheduler.answered(worker, AnsweredBatch { answers, seconds });
        self.go_on();
    }

    /// All workers answer until nothing is left to do, each place in a number of seconds. Gives the batches in their order.
    fn finish(&mut self, seconds: f64) -> Vec<Batch> {
        let mut done = Vec::new();
        while let Some((worker, batch)) = self.inboxes.keys().find_map(|&worker| Some((worker, self.at(worker)?))) {
            self.answer(worker, batch.places.len(), seconds * batch.places.len() as f64);
            done.push(batch);
        }
        done
    }
}

/// The places answered, in their order, and whether the study has ended.
fn answered(news: Vec<StudyNews>) -> (Vec<(usize, Answer)>, bool) {
    let mut all = Vec::new();
    let mut finished = false;
    for news in news {
        match news {
            StudyNews::Places { answers, .. } => all.extend(answers),
            StudyNews::Part { .. } => {}
            StudyNews::Finished { .. } => finished = true,
            other => panic!("{other:?}"),
        }
    }
    (all, finished)
}

/// That every place was answered once.
fn check_complete(news: Vec<StudyNews>, count: usize) -> Vec<(usize, Answer)> {
    let (mut all, finished) = answered(news);
    assert!(finished);
    all.sort_by_key(|(place, _)| *place);
    let places: Vec<usize> = all.iter().map(|(place, _)| *place).collect();
    assert_eq!(places, (0..count).collect::<Vec<_>>());
    all
}

#[test]
fn workers_start_when_there_is_work_and_hear_of_a_study_once() {
    let mut rehearsal = Rehearsal::new(2);
    rehearsal.go_on();
    assert_eq!(rehearsal.starts, [] as [u64; 0]);
    rehearsal.scheduler.want(job(1, line(1)));
    rehearsal.go_on();
    assert_eq!(rehearsal.starts, [1], "one place is work for one");
    rehearsal.scheduler.want(job(2, line(40)));
    rehearsal.go_on();
    let told: usize =
        rehearsal.inboxes.values().flatten().filter(|task| matches!(task, Task::Study { generation: 2, .. })).count();
    assert_eq!((rehearsal.starts.len(), told), (2, 2));
    rehearsal.finish(0.002);
    let (all, finished) = answered(rehearsal.scheduler.take_news());
    assert!(finished && all.len() == 40, "of the first study nothing has come");
}

#[test]
fn a_worker_is_prepared_once_nothing_is_held() {
    let mut rehearsal = Rehearsal::new(2);
    rehearsal.scheduler.hold(true);
    rehearsal.scheduler.prepare();
    rehearsal.go_on();
    assert_eq!(rehearsal.starts, [] as [u64; 0]);
    rehearsal.scheduler.hold(false);
    rehearsal.go_on();
    rehearsal.go_on();
    assert_eq!(rehearsal.starts, [1], "one, and no more of them without work");
    rehearsal.scheduler.want(job(1, line(1)));
    rehearsal.go_on();
    assert_eq!(rehearsal.starts, [1]);
}

#[test]
fn batches_are_as_long_as_their_time_and_what_is_left_over_comes_first() {
    let mut rehearsal = Rehearsal::new(1);
    rehearsal.scheduler.want(job(1, line(400)));
    rehearsal.go_on();
    for _ in 0..12 {
        let count = rehearsal.at(1).expect("a batch").places.len();
        rehearsal.answer(1, count, 0.000_5 * count as f64);
    }
    let batch = rehearsal.at(1).expect("a batch");
    assert!((15..=22).contains(&batch.places.len()), "{} places for 10 ms of 0.5 ms each", batch.places.len());
    // Suddenly slow: the worker stops after one place, and the others are the next ones but those sent ahead.
    rehearsal.answer(1, 1, 0.030);
    rehearsal.finish(0.030);
    let batch_left: Vec<usize> = batch.places[1..].to_vec();
    let all = answered(rehearsal.scheduler.take_news()).0;
    let at = |place: usize| all.iter().position(|(other, _)| *other == place).expect("an answer");
    let last_left = batch_left.iter().map(|&place| at(place)).max().expect("places left");
    assert!(last_left <= at(batch.places[0]) + 64 + batch_left.len());
    assert_eq!(all.len(), 400);
}

#[test]
fn a_maps_first_picture_comes_first_then_small_studies_then_its_details() {
    let mut rehearsal = Rehearsal::new(1);
    let (position, direction) = (Vec2::zeros(), Vec2::x());
    let small = [line(30), Study::Campbell { position, direction, to: 10.0, count: 30 }];
    rehearsal.scheduler.want(job(1, growth_map(41, 21)));
    for study in small {
        rehearsal.scheduler.want(job(1, study));
    }
    rehearsal.go_on();
    let order: Vec<(Topic, usize)> = rehearsal
        .finish(0.001)
        .into_iter()
        .flat_map(|batch| batch.places.into_iter().map(move |p| (batch.topic, p)))
        .collect();
    let coarse = 11 * 6;
    let first_small = order.iter().position(|(topic, _)| *topic != Topic::Map).expect("a small study");
    let last_small = order.iter().rposition(|(topic, _)| *topic != Topic::Map).expect("a small study");
    assert!((coarse..coarse + 64).contains(&first_small), "small studies begin after {first_small} places");
    assert!(last_small < first_small + 60 + 64, "and end after {last_small}");
    let between: Vec<Topic> = order[first_small..=last_small].iter().map(|(topic, _)| *topic).collect();
    let changes = between.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(changes >= 3, "they take turns");
    check_complete(
        rehearsal
            .scheduler
            .take_news()
            .into_iter()
            .filter(|news| match news {
                StudyNews::Places { topic, .. } | StudyNews::Finished { topic, .. } => *topic == Topic::Map,
                other => panic!("{other:?}"),
            })
            .collect(),
        861,
    );
}

#[test]
fn a_first_picture_that_takes_long_gives_way_to_small_studies() {
    let mut rehearsal = Rehearsal::new(1);
    rehearsal.scheduler.want(job(1, growth_map(41, 21)));
    rehearsal.scheduler.want(job(1, line(3)));
    rehearsal.go_on();
    let order: Vec<Topic> = rehearsal.finish(0.1).iter().map(|batch| batch.topic).collect();
    let last_line = order.iter().rposition(|topic| *topic == Topic::Line).expect("a line");
    assert!(last_line < 12, "{order:?}");
}

#[test]
fn a_worker_that_dies_is_replaced_and_its_places_are_done_again() {
    let mut rehearsal = Rehearsal::new(2);
    rehearsal.scheduler.want(job(1, line(20)));
    rehearsal.go_on();
    let (begun, other) = (rehearsal.at(1).expect("a batch"), rehearsal.at(2).expect("a batch"));
    rehearsal.scheduler.lost(1, "unreachable".into());
    rehearsal.go_on();
    assert_eq!((rehearsal.starts.clone(), rehearsal.stopped.clone()), (vec![1, 2, 3], vec![1]));
    // What may have killed it goes alone.
    assert_eq!(rehearsal.at(3).expect("a batch").places, begun.places[..1]);
    assert_ne!(begun.places, other.places);
    // An answer that comes too late counts for nothing.
    let answers = begun.places.iter().map(|&place| (place, ANSWER)).collect();
    rehearsal.scheduler.answered(1, AnsweredBatch { answers, seconds: 0.01 });
    rehearsal.finish(0.002);
    check_complete(rehearsal.scheduler.take_news(), 20);
}

#[test]
fn a_silent_worker_is_lost_after_some_seconds_and_a_slow_place_gets_more() {
    let mut rehearsal = Rehearsal::new(1);
    rehearsal.scheduler.want(job(1, line(3)));
    rehearsal.go_on();
    let first = rehearsal.at(1).expect("a batch").places[0];
    rehearsal.pass(3.9);
    assert_eq!(rehearsal.stopped, [] as [u64; 0]);
    rehearsal.pass(0.2);
    assert_eq!(rehearsal.stopped, [1], "lost after 4 s");
    assert_eq!(rehearsal.at(2).expect("a batch").places, [first]);
    rehearsal.pass(3.9);
    rehearsal.pass(3.9);
    assert_eq!(rehearsal.stopped, [1], "twice the time for the second attempt");
    rehearsal.answer(2, 1, 7.8);
    // What is slow has taught patience.
    rehearsal.pass(3.9);
    rehearsal.pass(3.9);
    rehearsal.finish(0.002);
    assert_eq!(rehearsal.stopped.len(), 1 + usize::from(rehearsal.starts.len() > 2));
    check_complete(rehearsal.scheduler.take_news(), 3);
}

#[test]
fn heavy_places_get_more_time_and_time_asleep_does_not_count() {
    let mut rehearsal = Rehearsal::new(1);
    let (position, direction) = (Vec2::zeros(), Vec2::x());
    rehearsal.scheduler.want(job(1, Study::Mesh { position, direction, counts: vec![40], limit: 40.0 }));
    rehearsal.go_on();
    for _ in 0..10 {
        rehearsal.pass(4.0);
    }
    assert_eq!(rehearsal.stopped, [] as [u64; 0], "16 times the paper's work");
    rehearsal.finish(30.0);
    rehearsal.scheduler.want(job(2, line(1)));
    rehearsal.go_on();
    rehearsal.clock += Duration::from_hours(1);
    rehearsal.go_on();
    assert_eq!(rehearsal.stopped, [] as [u64; 0]);
    rehearsal.finish(0.002);
}

#[test]
fn a_place_that_kills_three_workers_is_given_up_alone() {
    let mut rehearsal = Rehearsal::new(1);
    rehearsal.scheduler.want(job(1, line(10)));
    rehearsal.go_on();
    let deadly = 8;
    let mut dead = 0;
    while let Some((&worker, batch)) = rehearsal.inboxes.keys().find_map(|w| Some((w, rehearsal.at(*w)?))) {
        if batch.places.contains(&deadly) {
            dead += 1;
            rehearsal.scheduler.lost(worker, "unreachable".into());
            rehearsal.go_on();
        } else {
            rehearsal.answer(worker, batch.places.len(), 0.002);
        }
    }
    assert_eq!(dead, 3);
    let all = check_complete(rehearsal.scheduler.take_news(), 10);
    let direction = Vec2::x();
    for (place, answer) in all {
        let expected =
            if place == deadly { Answer::Critical { direction, verdict: UNKNOWN, wave_limit: None } } else { ANSWER };
        assert_eq!(answer, expected, "at {place}");
    }
}

#[test]
fn without_any_worker_the_studies_end_with_the_reason_until_one_is_wanted_again() {
    let mut rehearsal = Rehearsal::new(2);
    rehearsal.start = false;
    rehearsal.scheduler.want(job(1, line(10)));
    rehearsal.go_on();
    while let Some(worker) = rehearsal.starts.iter().copied().find(|worker| !rehearsal.stopped.contains(worker)) {
        rehearsal.scheduler.lost(worker, format!("no worker {worker}"));
        rehearsal.go_on();
    }
    let news = rehearsal.scheduler.take_news();
    assert!(matches!(&news[..], [StudyNews::Broken(reason)] if reason.starts_with("no worker")), "{news:?}");
    assert_eq!(rehearsal.scheduler.progress(Topic::Line), None);
    rehearsal.start = true;
    rehearsal.scheduler.want(job(2, line(10)));
    rehearsal.go_on();
    rehearsal.finish(0.002);
    check_complete(rehearsal.scheduler.take_news(), 10);
}

#[test]
fn a_worker_that_never_starts_is_lost_and_one_that_starts_is_enough() {
    let mut rehearsal = Rehearsal::new(2);
    rehearsal.start = false;
    rehearsal.scheduler.want(job(1, line(400)));
    rehearsal.go_on();
    rehearsal.scheduler.ready(1);
    rehearsal.go_on();
    for _ in 0..40 {
        rehearsal.pass(2.0);
        while let Some(batch) = rehearsal.at(1) {
            rehearsal.answer(1, batch.places.len(), 0.002);
        }
        rehearsal.scheduler.want(job(1, line(400)));
        rehearsal.go_on();
    }
    assert!(rehearsal.stopped.len() >= 3 && !rehearsal.stopped.contains(&1), "{:?}", rehearsal.stopped);
    assert!(!rehearsal.scheduler.take_news().iter().any(|news| matches!(news, StudyNews::Broken(_))));
}

#[test]
fn nonsense_from_a_worker_is_not_taken_for_an_answer() {
    for answers in [vec![], vec![(9999, ANSWER)], vec![(0, ANSWER); 100]] {
        let mut rehearsal = Rehearsal::new(1);
        rehearsal.scheduler.want(job(1, line(5)));
        rehearsal.go_on();
        rehearsal.scheduler.answered(1, AnsweredBatch { answers, seconds: 0.001 });
        rehearsal.go_on();
        assert_eq!(rehearsal.stopped, [1]);
        rehearsal.finish(0.002);
        check_complete(rehearsal.scheduler.take_news(), 5);
    }
}

/// Polls a pool until it has nothing at work.
fn wait(shared: &SharedCore) -> Vec<StudyNews> {
    let begun = Instant::now();
    let mut news = Vec::new();
    while !matches!(news.last(), Some(StudyNews::Finished { .. } | StudyNews::Broken(_))) {
        assert!(begun.elapsed() < Duration::from_mins(1), "{news:?}");
        news.extend(shared.with(|core| core.scheduler.take_news()));
        std::thread::sleep(Duration::from_millis(1));
    }
    news
}

/// A place's answer, all at once.
fn finish(places: &Arc<RobotStudy>, place: usize) -> Answer {
    let mut steps = places.answer(place);
    loop {
        if let Some(answer) = steps.advance() {
            return answer;
        }
    }
}

/// A place may take a minute. Whoever is at one is free for what is wanted instead, or for nothing, at once.
#[test]
fn workers_hear_that_the_study_they_are_at_is_no_longer_wanted() {
    let mut rehearsal = Rehearsal::new(2);
    rehearsal.scheduler.want(job(1, line(1)));
    rehearsal.go_on();
    rehearsal.scheduler.want(job(2, line(1)));
    rehearsal.go_on();
    let told = |rehearsal: &Rehearsal, worker: WorkerId| -> Vec<&'static str> {
        let name = |task: &Task| match task {
            Task::Study { .. } => "study",
            Task::Batch(_) => "batch",
            Task::Forget(Topic::Line) => "forget",
            Task::Forget(_) => "forget another",
        };
        rehearsal.inboxes.get(&worker).into_iter().flatten().map(name).collect()
    };
    let begun = told(&rehearsal, 1);
    assert!(begun.starts_with(&["study", "batch", "forget"]), "{begun:?}");
    rehearsal.scheduler.cancel(Topic::Line);
    rehearsal.go_on();
    let forgets =
        |rehearsal: &Rehearsal| [1, 2].map(|worker| told(rehearsal, worker).iter().filter(|&&t| t == "forget").count());
    assert_eq!(forgets(&rehearsal).iter().sum::<usize>(), 2, "who was at the second study hears it too");
    rehearsal.scheduler.cancel(Topic::Line);
    rehearsal.go_on();
    assert_eq!(forgets(&rehearsal).iter().sum::<usize>(), 2, "once");
}

#[test]
fn a_thread_that_panics_is_replaced_and_its_places_are_done_again() {
    let (accidents, wakes) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
    let woken = wakes.clone();
    let wake = move || {
        woken.fetch_add(1, Ordering::Relaxed);
    };
    let answer = move |places: &Arc<RobotStudy>, place: usize| {
        assert!(place != 3, "this place is deadly");
        assert!(!place.is_multiple_of(5) || accidents.fetch_add(1, Ordering::Relaxed) > 1, "an accident");
        places.answer(place)
    };
    let shared = SharedCore::by(2, wake, answer);
    let wanted = job(1, line(12));
    let places = Arc::new(RobotStudy::new(&wanted).expect("a study"));
    shared.with(|core| {
        core.scheduler.want(wanted);
        core.go_on();
    });
    let all = check_complete(wait(&shared), 12);
    for (place, answer) in all {
        assert_eq!(answer, if place == 3 { places.unknown(place) } else { finish(&places, place) });
    }
    assert!(wakes.load(Ordering::Relaxed) > 0);
}
