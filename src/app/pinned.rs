//! A design that is kept beside the present one, to see the difference.

use crate::app::answers::Answers;
use crate::app::state::UiState;
use crate::app::studies::{self, Known, Order, Studies};
use crate::compute::protocol::{CriticalAnswer, PoseAnswer, StudyNews, Topic};
use crate::scenario::Scenario;
use crate::scenario::report::{CriticalReport, SensitivityReport};

/// A design with what is known of it.
#[derive(Debug)]
pub struct Pinned {
    /// The design.
    pub scenario: Scenario,
    answers: Answers,
    studies: Studies,
}

impl Pinned {
    /// Pins a design whose answers are complete.
    pub fn new(scenario: Scenario, answers: Answers) -> Self {
        Self { scenario, answers, studies: Studies::apart() }
    }

    /// Its pose and modes.
    pub fn pose(&self) -> Option<&PoseAnswer> {
        self.answers.pose()
    }

    /// Its growth rates against speed.
    pub fn curve(&self) -> Option<&[[f64; 2]]> {
        self.answers.curve().map(|(points, _)| points)
    }

    /// By how much the present critical speed is higher, in m/s, where both have one.
    pub fn difference(&self, now: &Answers) -> Option<f64> {
        let now = now.last_critical()?.critical.as_ref()?;
        Some(now.speed - self.critical()?.speed)
    }

    /// How its critical speed depends on each parameter.
    pub fn sensitivities(&self) -> Option<&[SensitivityReport]> {
        self.answers.sensitivities().and_then(|(found, _)| found.as_deref().ok())
    }

    /// The end of its search for a critical speed.
    pub fn search(&self) -> Option<&CriticalAnswer> {
        self.answers.last_critical()
    }

    /// Its critical speed.
    pub fn critical(&self) -> Option<&CriticalReport> {
        self.search()?.critical.as_ref()
    }

    /// What is known of a study of it, once there is a picture.
    pub fn study(&self, topic: Topic) -> Option<&Known> {
        self.studies.shown(topic).filter(|shown| shown.current).map(|shown| shown.known)
    }

    /// Asks for the studies of the plot on show, while `idle`: the present design comes first.
    pub fn want(&mut self, idle: bool, state: &UiState, plot: Option<crate::app::state::Plot>) -> Vec<Order> {
        let critical = self.critical().map(|critical| critical.speed);
        let mut wishes = studies::wanted(&self.scenario, state, plot.filter(|_| idle), critical);
        // The map shows one design.
        wishes.retain(|wish| wish.topic() != Topic::Map);
        self.studies.want(wishes)
    }

    /// Takes in what the pool has found.
    pub fn take(&mut self, news: StudyNews) {
        self.studies.take(news);
    }

    /// Whether anything is being computed.
    pub fn is_working(&self) -> bool {
        self.studies.is_working()
    }
}
