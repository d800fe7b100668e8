//! What the engine has answered so far, and how much of it is about the document as it is now.

use std::collections::VecDeque;

use web_time::Instant;

use crate::compute::protocol::{AnalysedPose, Extent, FailedPose, ModeShape, Reply, Revision, SearchEnd, Update};
use crate::scenario::Report;
use crate::study::Sensitivity;

/// What each parameter does to the critical speed, or why that cannot be told.
pub type Sensitivities = Result<Vec<Sensitivity>, String>;

/// The newest answers of each kind, each with the revision that it answers.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    /// The document's revision: answers to it are current.
    revision: Revision,
    /// The first revision of the robot that is open.
    opened: Revision,
    pose: Option<(Revision, AnalysedPose)>,
    failed: Option<(Revision, FailedPose)>,
    critical: Option<(Revision, SearchEnd)>,
    curve: Option<(Revision, Vec<[f64; 2]>)>,
    sensitivities: Option<(Revision, Sensitivities)>,
    shape: Option<(Revision, ModeShape)>,
    complete: Option<(Revision, Report)>,
    searching: Option<f64>,
    broken: Option<String>,
    /// When each revision whose answer is not complete was asked for.
    asked: VecDeque<(Revision, Instant)>,
    trail_ms: Option<f64>,
}

/// The critical speed on show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CriticalState<'a> {
    /// It belongs to the document as it is.
    Current(&'a SearchEnd),
    /// It is being computed; the last one, if any, belongs to an earlier state. The search has come to this speed.
    Recomputing {
        /// The last answer.
        last: Option<&'a SearchEnd>,
        /// In m/s, where the search has begun.
        searched_up_to: Option<f64>,
    },
    /// The pose has no answer.
    Failed(&'a FailedPose),
    /// The engine does not work.
    Broken(&'a str),
}

impl Answers {
    /// Notes that from this revision on it is another robot's document: the poses before are none of its own.
    pub fn begin(&mut self, revision: Revision) {
        self.opened = revision;
    }

    /// Notes that the document has changed.
    pub fn expect(&mut self, revision: Revision) {
        self.revision = revision;
        self.searching = None;
        self.asked.push_back((revision, Instant::now()));
    }

    /// Takes in a reply.
    pub fn take(&mut self, Reply { revision, update }: Reply) {
        match update {
            Update::Pose(pose) => {
                self.failed = None;
                self.pose = Some((revision, *pose));
                self.complete(revision);
            }
            Update::Failed(failed) => {
                self.complete = Some((revision, failed.report.clone()));
                self.failed = Some((revision, *failed));
            }
            Update::Searching(speed) => self.searching = (revision == self.revision).then_some(speed),
            Update::Critical(answer) => self.take_critical(revision, answer),
            Update::Curve(points) => self.curve = Some((revision, points)),
            Update::Sensitivities(found) => self.sensitivities = Some((revision, found)),
            Update::Shape(shape) => self.shape = Some((revision, *shape)),
            Update::Checked(_) => {} // says nothing about the document
            Update::Broken(reason) => self.break_down(reason),
        }
    }

    fn take_critical(&mut self, revision: Revision, answer: SearchEnd) {
        self.critical = Some((revision, answer));
        self.complete(revision);
        while let Some((asked, at)) = self.asked.pop_front_if(|(asked, _)| *asked <= revision) {
            if asked == revision {
                self.trail_ms = Some(1e3 * at.elapsed().as_secs_f64());
            }
        }
    }

    /// Puts the analysis of a revision together, where all of it is there. The pose may be newer: a search that was under way
    /// was allowed to finish.
    fn complete(&mut self, revision: Revision) {
        let (Some((of_pose, pose)), Some((of_search, answer))) = (&self.pose, &self.critical) else { return };
        if (*of_pose, *of_search) == (revision, revision) && pose.extent != Extent::SlowestSoFar {
            self.complete = Some((revision, answer.completed(pose.report.clone())));
        }
    }

    /// How far the last complete answer was behind the document: from the edit that it answers until it was here, in ms.
    pub fn trail_ms(&self) -> Option<f64> {
        self.trail_ms
    }

    /// Marks the engine as not working.
    pub fn break_down(&mut self, reason: String) {
        self.broken = Some(reason);
    }

    /// Marks the engine as working again.
    pub fn mend(&mut self) {
        self.broken = None;
    }

    /// Whether there is more to come of the document as it is.
    pub fn are_awaited(&self) -> bool {
        self.broken.is_none() && !self.pose_failed() && !self.all_current()
    }

    /// The newest pose, unless a newer one failed.
    pub fn pose(&self) -> Option<&AnalysedPose> {
        self.failed.is_none().then_some(self.pose.as_ref()).flatten().map(|(_, pose)| pose)
    }

    /// The newest pose that could be analysed, also after a newer one of the same robot failed, and whether it is the
    /// document's as it is.
    pub fn last_pose(&self) -> Option<(&AnalysedPose, bool)> {
        let own = self.pose.as_ref().filter(|(revision, _)| self.failed.is_none() || *revision >= self.opened);
        own.map(|(revision, pose)| (pose, *revision == self.revision))
    }

    /// Where the platform was in the newest pose that could be analysed, in m.
    pub fn last_feasible(&self) -> Option<[f64; 2]> {
        // Every cable begins at the platform.
        self.last_pose()?.0.report.cables.first()?.nodes.first().copied()
    }

    /// Whether the document as it is has no answer.
    pub fn pose_failed(&self) -> bool {
        self.failed.as_ref().is_some_and(|(revision, _)| *revision == self.revision)
    }

    /// Whether [`Self::pose`] belongs to the document as it is.
    pub fn pose_is_current(&self) -> bool {
        self.pose.as_ref().is_some_and(|(revision, _)| *revision == self.revision)
    }

    /// The newest growth rates against speed, and whether they belong to the document as it is.
    pub fn curve(&self) -> Option<(&[[f64; 2]], bool)> {
        self.curve.as_ref().map(|(revision, points)| (points.as_slice(), *revision == self.revision))
    }

    /// The newest sensitivities of the critical speed, and whether they belong to the document as it is.
    pub fn sensitivities(&self) -> Option<(&Sensitivities, bool)> {
        self.sensitivities.as_ref().map(|(revision, found)| (found, *revision == self.revision))
    }

    /// Why the newest pose has no answer, where it has none.
    pub fn failed(&self) -> Option<&FailedPose> {
        self.failed.as_ref().map(|(_, failed)| failed)
    }

    /// The newest mode shape, where the pose can be drawn and has such modes.
    pub fn shape(&self) -> Option<&ModeShape> {
        let pose = self.pose()?;
        self.shape.as_ref().map(|(_, shape)| shape).filter(|shape| shape.is_critical || !pose.modes.is_empty())
    }

    /// The critical speed on show.
    pub fn critical(&self) -> CriticalState<'_> {
        if let Some(reason) = &self.broken {
            return CriticalState::Broken(reason);
        }
        if let Some((revision, failed)) = &self.failed
            && *revision == self.revision
        {
            return CriticalState::Failed(failed);
        }
        match &self.critical {
            Some((revision, answer)) if *revision == self.revision => CriticalState::Current(answer),
            last => CriticalState::Recomputing {
                last: last.as_ref().map(|(_, answer)| answer),
                searched_up_to: self.searching,
            },
        }
    }

    /// The last critical speed, current or not, also after a pose without an answer.
    pub fn last_critical(&self) -> Option<&SearchEnd> {
        let works = self.broken.is_none();
        self.critical.as_ref().map(|(_, answer)| answer).filter(|_| works)
    }

    /// The state of the document that the last critical speed belongs to.
    pub fn critical_revision(&self) -> Option<Revision> {
        self.critical.as_ref().map(|(revision, _)| *revision)
    }

    /// Whether everything, to the sensitivities, belongs to the document as it is.
    pub fn all_current(&self) -> bool {
        let current = |revision: Option<Revision>| revision == Some(self.revision);
        self.failed.is_none()
            && current(self.critical.as_ref().map(|(revision, _)| *revision))
            && current(self.curve.as_ref().map(|(revision, _)| *revision))
            && current(self.sensitivities.as_ref().map(|(revision, _)| *revision))
    }

    /// The last complete analysis, its revision, and whether it belongs to the document as it is.
    pub fn last_complete(&self) -> Option<(&Report, Revision, bool)> {
        self.complete.as_ref().map(|(revision, report)| (report, *revision, *revision == self.revision))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::Engine;
    use crate::compute::protocol::{Job, ModeChoice, Request, Which};
    use crate::scenario::presets;

    /// What is known of the paper's robot after it has been at these places on the line y = 0, one after the other.
    fn after(places: &[f64]) -> Answers {
        let (mut engine, mut answers) = (Engine::default(), Answers::default());
        for (&x, revision) in places.iter().zip(1..) {
            let mut scenario = presets::PRESETS[0].scenario();
            scenario.motion.position = [x, 0.0];
            let mode = ModeChoice { which: Which::Present, along_x: false };
            answers.expect(revision);
            engine.submit(Request::Analyze(Job { revision, scenario: scenario.to_json(), max_speed: 40.0, mode }));
            while let Some(replies) = engine.work() {
                for reply in replies {
                    answers.take(reply);
                }
            }
        }
        answers
    }

    #[test]
    fn the_last_pose_that_could_rest_stays_known_after_one_that_cannot() {
        let answers = after(&[6.0]);
        assert_eq!(answers.last_feasible(), Some([6.0, 0.0]));
        assert!(answers.last_pose().is_some_and(|(_, current)| current) && answers.pose().is_some());
        let speed = |answers: &Answers| answers.last_critical().and_then(|end| end.critical.as_ref()).map(|c| c.speed);
        let before = speed(&answers);
        // No equilibrium there.
        let answers = after(&[6.0, 8.0]);
        assert!(answers.pose_failed() && answers.pose().is_none() && answers.shape().is_none());
        assert_eq!(answers.last_feasible(), Some([6.0, 0.0]));
        assert!(answers.last_pose().is_some_and(|(_, current)| !current));
        assert!(before.is_some() && speed(&answers) == before);
        assert!(matches!(answers.critical(), CriticalState::Failed(_)));
        // And back.
        let answers = after(&[6.0, 8.0, 5.0]);
        assert_eq!(answers.last_feasible(), Some([5.0, 0.0]));
        assert!(!answers.pose_failed() && answers.shape().is_some());
        assert_eq!(after(&[8.0]).last_feasible(), None);
    }
}
