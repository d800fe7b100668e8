//! Studies over many poses: which are wanted, what is known of them, how far they have come.
//!
//! Nothing here computes or waits: [`Studies::want`] says what the pool of workers is to be told, and
//! [`Studies::take`] takes in what it has found. A study begins anew only where something has changed that it depends
//! on ([`StudyRequest`]). Until a first picture of the new one is there, the last one stays on show and is marked as old.

mod joined;
mod on_path;
mod request;
mod shared;
mod varied;

pub use joined::Joined;
pub use on_path::on_path;
pub use request::{StudyRequest, wanted};
pub use shared::{KEPT, Owner, SharedPool};

use std::collections::VecDeque;

use crate::compute::protocol::{Revision, StudyJob, StudyNews, Topic};
use crate::study::Answer;

/// So many finished studies of each topic are remembered, for undone changes and tabs that are opened again.
const REMEMBERED: usize = 4;

/// What the pool is to be told.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// Begin this study in the place of its topic's.
    Want(StudyJob),
    /// End the topic's study.
    Cancel(Topic),
}

/// How a topic's study stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StudyStage {
    /// Nobody wants one.
    #[default]
    Idle,
    /// It is being computed.
    Working,
    /// All is known.
    Finished,
    /// The user has stopped it.
    Stopped,
    /// It could not be done.
    Failed,
}

/// What is known of one study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyResults {
    /// The study.
    pub request: StudyRequest,
    /// The answers by place.
    pub places: Vec<Option<Answer>>,
    /// Changes with every answer, and is never the same for two studies of one owner.
    pub version: (Revision, usize),
}

impl StudyResults {
    fn new(request: StudyRequest, revision: Revision) -> Self {
        Self { places: vec![None; request.study.len()], request, version: (revision, 0) }
    }

    /// How many places are answered.
    pub fn answered(&self) -> usize {
        self.places.iter().flatten().count()
    }

    /// Whether all places are answered.
    pub fn is_complete(&self) -> bool {
        self.places.iter().all(Option::is_some)
    }

    fn is_picture(&self) -> bool {
        self.answered() >= self.request.first_picture()
    }
}

/// What is on show of a topic.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// The answers.
    pub known: &'a StudyResults,
    /// Whether they belong to what is wanted now; else they are an earlier state's.
    pub current: bool,
}

/// How far a topic's study has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Places answered since it began.
    pub done: usize,
    /// All places.
    pub total: usize,
    /// How much of its only place is done, in percent; 0 where that is not told.
    pub percent: u16,
    /// How it stands.
    pub stage: StudyStage,
    /// Which one it is.
    pub revision: Revision,
}

#[derive(Debug, Default)]
struct Subject {
    stage: StudyStage,
    revision: Revision,
    done: usize,
    percent: u16,
    newest: Option<StudyResults>,
    /// The last study that had a picture.
    earlier: Option<StudyResults>,
    finished: VecDeque<StudyResults>,
}

/// The studies of all topics but one: the joining of modes is kept apart, in [`Joined`].
#[derive(Debug, Default)]
pub struct Studies {
    revision: Revision,
    subjects: [Subject; Topic::ALL.len()],
    broken: Option<String>,
}

fn place(topic: Topic) -> usize {
    Topic::ALL.iter().position(|other| *other == topic).unwrap_or_default()
}

impl Studies {
    /// Notes what is wanted now, at most one study of each topic, and says what is to be done for it.
    pub fn want(&mut self, mut requests: Vec<StudyRequest>) -> Vec<Order> {
        let mut orders = Vec::new();
        for topic in Topic::ALL {
            let request = requests.iter().position(|request| request.topic() == topic).map(|i| requests.swap_remove(i));
            let subject = &self.subjects[place(topic)];
            let known = subject.newest.as_ref().map(|known| &known.request);
            match request {
                None if subject.stage == StudyStage::Working => {
                    orders.push(Order::Cancel(topic));
                    self.subjects[place(topic)].stage = StudyStage::Idle;
                }
                None => self.subjects[place(topic)].stage = StudyStage::Idle,
                Some(request) if known == Some(&request) && subject.stage != StudyStage::Idle => {}
                Some(request) => orders.extend(self.begin(request)),
            }
        }
        orders
    }

    /// Begins `request`, or remembers its answers.
    fn begin(&mut self, request: StudyRequest) -> Option<Order> {
        let topic = request.topic();
        let subject = &mut self.subjects[place(topic)];
        let working = subject.stage == StudyStage::Working;
        let again = subject.newest.as_ref().is_some_and(|known| known.request == request);
        if !again && let Some(known) = subject.newest.take().filter(StudyResults::is_picture) {
            subject.earlier = Some(known);
        }
        if let Some(known) = subject.finished.iter().find(|known| known.request == request) {
            (subject.stage, subject.done) = (StudyStage::Finished, known.places.len());
            subject.newest = Some(known.clone());
            return working.then_some(Order::Cancel(topic));
        }
        self.revision += 1;
        let revision = self.revision;
        // An answer depends on the request alone: what an earlier try has found stays.
        let known = subject.newest.get_or_insert_with(|| StudyResults::new(request, revision));
        (subject.stage, subject.revision, subject.done, subject.percent) = (StudyStage::Working, revision, 0, 0);
        Some(Order::Want(StudyJob {
            revision,
            scenario: known.request.scenario.to_json(),
            study: known.request.study.clone(),
        }))
    }

    /// Whether this very study is at work, or ended while it was wanted.
    pub fn has(&self, request: &StudyRequest) -> bool {
        let subject = &self.subjects[place(request.topic())];
        subject.stage != StudyStage::Idle && subject.newest.as_ref().is_some_and(|known| known.request == *request)
    }

    /// Stops a topic's study; what is known of it stays on show.
    pub fn stop(&mut self, topic: Topic) -> Option<Order> {
        let subject = &mut self.subjects[place(topic)];
        (subject.stage == StudyStage::Working).then(|| {
            subject.stage = StudyStage::Stopped;
            Order::Cancel(topic)
        })
    }

    /// Begins a study anew that was stopped.
    pub fn resume(&mut self, topic: Topic) -> Option<Order> {
        let subject = &self.subjects[place(topic)];
        let stopped = matches!(subject.stage, StudyStage::Stopped | StudyStage::Failed);
        let request = subject.newest.as_ref().filter(|_| stopped)?.request.clone();
        self.begin(request)
    }

    /// Takes in what the pool has found. News of studies that are not wanted any more say nothing.
    pub fn take(&mut self, news: StudyNews) {
        match news {
            StudyNews::Places { topic, revision, answers } => {
                let Some(subject) = self.at_work(topic, revision) else { return };
                let Some(known) = &mut subject.newest else { return };
                subject.done += answers.len();
                for (place, answer) in answers {
                    if let Some(known) = known.places.get_mut(place) {
                        *known = Some(answer);
                    }
                }
                known.version = (revision, subject.done);
            }
            StudyNews::Part { topic, revision, percent } => {
                if let Some(subject) = self.at_work(topic, revision) {
                    subject.percent = percent;
                }
            }
            StudyNews::Finished { topic, revision } => {
                let Some(subject) = self.at_work(topic, revision) else { return };
                subject.stage = StudyStage::Finished;
                subject.earlier = None;
                if let Some(known) = subject.newest.clone().filter(StudyResults::is_complete) {
                    subject.finished.push_front(known);
                    subject.finished.truncate(REMEMBERED);
                }
            }
            StudyNews::Refused { topic, revision, .. } => {
                if let Some(subject) = self.at_work(topic, revision) {
                    subject.stage = StudyStage::Failed;
                }
            }
            StudyNews::Broken(reason) => {
                self.broken = Some(reason);
                for subject in &mut self.subjects {
                    if subject.stage == StudyStage::Working {
                        subject.stage = StudyStage::Failed;
                    }
                }
            }
        }
    }

    fn at_work(&mut self, topic: Topic, revision: Revision) -> Option<&mut Subject> {
        let subject = &mut self.subjects[place(topic)];
        (subject.stage == StudyStage::Working && subject.revision == revision).then_some(subject)
    }

    /// What there is to see of a topic: the newest study once it makes a picture, until then the one before.
    pub fn shown(&self, topic: Topic) -> Option<Shown<'_>> {
        let Subject { newest, earlier, .. } = &self.subjects[place(topic)];
        let newest = newest.as_ref();
        if let Some(known) = earlier.as_ref().filter(|_| !newest.is_some_and(StudyResults::is_picture)) {
            return Some(Shown { known, current: false });
        }
        newest.map(|known| Shown { known, current: true })
    }

    /// How far a topic's study has come.
    pub fn progress(&self, topic: Topic) -> Progress {
        let Subject { stage, revision, done, percent, newest, .. } = &self.subjects[place(topic)];
        let total = newest.as_ref().map_or(0, |known| known.places.len());
        Progress { done: *done, total, percent: *percent, stage: *stage, revision: *revision }
    }

    /// Whether anything is being computed.
    pub fn is_working(&self) -> bool {
        self.subjects.iter().any(|subject| subject.stage == StudyStage::Working)
    }

    /// Why no study can be done, where none can.
    pub fn broken(&self) -> Option<&str> {
        self.broken.as_deref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Vec2;
    use crate::scenario::presets;
    use crate::study::Study;

    fn request(position: [f64; 2]) -> StudyRequest {
        let study = Study::Directions { position: Vec2::from(position), count: 8, limit: 40.0 };
        StudyRequest::new(&presets::PRESETS[0].scenario(), study)
    }

    fn places(revision: Revision, places: std::ops::Range<usize>) -> StudyNews {
        #[expect(clippy::cast_precision_loss)]
        let answers = places.map(|i| (i, Answer::Growth(Ok(i as f64)))).collect();
        StudyNews::Places { topic: Topic::Directions, revision, answers }
    }

    fn begun(orders: &[Order]) -> Revision {
        let [Order::Want(job)] = orders else { panic!("{orders:?}") };
        job.revision
    }

    #[test]
    fn a_study_begins_once_and_again_where_it_changes() {
        let mut studies = Studies::default();
        let first = begun(&studies.want(vec![request([0.0, 0.0])]));
        assert!(studies.want(vec![request([0.0, 0.0])]).is_empty() && studies.is_working());
        studies.take(places(first, 0..8));
        studies.take(StudyNews::Finished { topic: Topic::Directions, revision: first });
        assert!(studies.want(vec![request([0.0, 0.0])]).is_empty() && !studies.is_working());

        // The old one stays until a quarter of the new one is there.
        let second = begun(&studies.want(vec![request([1.0, 0.0])]));
        let shown = |studies: &Studies| studies.shown(Topic::Directions).map(|s| (s.current, s.known.answered()));
        assert_eq!(shown(&studies), Some((false, 8)));
        studies.take(places(first, 0..8));
        assert_eq!(studies.progress(Topic::Directions).done, 0, "news of an older study");
        studies.take(places(second, 0..2));
        assert_eq!(shown(&studies), Some((true, 2)));

        // Back again: nothing to compute.
        assert_eq!(studies.want(vec![request([0.0, 0.0])]), [Order::Cancel(Topic::Directions)]);
        assert_eq!(shown(&studies), Some((true, 8)));
        assert_eq!(studies.progress(Topic::Directions).stage, StudyStage::Finished);
    }

    #[test]
    fn a_stopped_study_waits_for_the_user_or_for_a_change() {
        let mut studies = Studies::default();
        let first = begun(&studies.want(vec![request([0.0, 0.0])]));
        studies.take(places(first, 0..3));
        assert_eq!(studies.stop(Topic::Directions), Some(Order::Cancel(Topic::Directions)));
        assert_eq!(studies.stop(Topic::Directions), None);
        assert!(studies.want(vec![request([0.0, 0.0])]).is_empty());
        studies.take(places(first, 3..4));
        assert_eq!(studies.shown(Topic::Directions).map(|s| s.known.answered()), Some(3));
        let resumed = begun(&Vec::from_iter(studies.resume(Topic::Directions)));
        assert!(resumed > first && studies.resume(Topic::Directions).is_none());
        assert_eq!(studies.shown(Topic::Directions).map(|s| s.known.answered()), Some(3), "what is known stays");

        studies.stop(Topic::Directions);
        assert!(begun(&studies.want(vec![request([1.0, 0.0])])) > resumed);
    }

    #[test]
    fn nobody_looking_ends_it() {
        let mut studies = Studies::default();
        begun(&studies.want(vec![request([0.0, 0.0])]));
        assert_eq!(studies.want(Vec::new()), [Order::Cancel(Topic::Directions)]);
        assert!(studies.want(Vec::new()).is_empty() && !studies.is_working());
        let again = begun(&studies.want(vec![request([0.0, 0.0])]));
        studies.take(StudyNews::Broken("no threads".into()));
        assert_eq!(
            (studies.broken(), studies.progress(Topic::Directions).stage),
            (Some("no threads"), StudyStage::Failed)
        );
        assert!(studies.want(vec![request([0.0, 0.0])]).is_empty(), "not again and again after {again}");
    }
}
