//! A design that is kept beside the present one, to see the difference.

use crate::app::answers::Answers;
use crate::app::certainty::Certainty;
use crate::app::state::{Plot, UiState};
use crate::app::studies::{self, Order, Studies, StudyResults};
use crate::compute::Compute;
use crate::compute::protocol::{
    AnalysedPose, Job, ModeChoice, Reply, Request, SearchEnd, StudyNews, Topic, Update, Which,
};
use crate::scenario::Scenario;
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::stability::Critical;
use crate::study::Sensitivity;

/// Why a design cannot be pinned.
const NO_ANSWER: &str = "A pose without an answer cannot be pinned.";
/// The only revision of a pinned design's own engine.
const OWN: u64 = 1;

/// A design with what is known of it.
pub struct Pinned {
    /// The design.
    pub scenario: Scenario,
    answers: Answers,
    studies: Studies,
    /// At work until its answers are complete.
    engine: Option<Compute>,
}

impl std::fmt::Debug for Pinned {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Pinned").field("scenario", &self.scenario).finish_non_exhaustive()
    }
}

impl Pinned {
    /// Pins a design with its answers. Where they are not complete it gets an engine of its own, since the other one goes
    /// on with whatever the present design becomes; that one calls `wake` when there is news.
    ///
    /// # Errors
    /// Where there is no answer to the design, or no engine to be had.
    pub fn new(scenario: Scenario, answers: &Answers, wake: impl Fn() + Send + 'static) -> Result<Self, String> {
        if answers.pose_failed() {
            return Err(NO_ANSWER.into());
        }
        let mut pinned = Self { scenario, answers: answers.clone(), studies: Studies::default(), engine: None };
        if !answers.all_current() {
            let mut engine = Compute::start(wake)?;
            pinned.answers = Answers::default();
            pinned.answers.expect(OWN);
            engine.submit(&Request::Analyze(Job {
                revision: OWN,
                scenario: pinned.scenario.to_json(),
                max_speed: DEFAULT_MAX_SPEED,
                mode: ModeChoice { which: Which::Critical, along_x: false },
            }))?;
            pinned.engine = Some(engine);
        }
        Ok(pinned)
    }

    /// Takes in what its own engine has found, and lets that go once all is known.
    ///
    /// # Errors
    /// Where there is no answer to the design.
    pub fn go_on(&mut self) -> Result<(), String> {
        let Some(engine) = &mut self.engine else { return Ok(()) };
        for reply in engine.poll() {
            match reply {
                Reply { update: Update::Broken(reason), .. } => {
                    return Err(format!("The design could not be pinned: {reason}."));
                }
                reply => self.answers.take(reply),
            }
        }
        if self.answers.pose_failed() {
            return Err(NO_ANSWER.into());
        }
        if self.answers.all_current() {
            self.engine = None;
        }
        Ok(())
    }

    /// Whether all is known of its pose.
    pub fn is_complete(&self) -> bool {
        self.engine.is_none()
    }

    /// What the pool is to be told when the design is let go.
    pub fn release(mut self) -> Vec<Order> {
        self.studies.want(Vec::new())
    }

    /// Its pose and modes.
    pub fn pose(&self) -> Option<&AnalysedPose> {
        self.answers.pose()
    }

    /// Its growth rates against speed.
    pub fn curve(&self) -> Option<&[[f64; 2]]> {
        self.answers.curve().map(|(points, _)| points)
    }

    /// By how much the present critical speed is higher, in m/s, where both have one.
    #[cfg(target_arch = "wasm32")] // The mirror for screen readers tells it.
    pub fn difference(&self, now: &Answers) -> Option<f64> {
        let now = now.last_critical()?.critical.as_ref()?;
        Some(now.speed - self.critical()?.speed)
    }

    /// How its critical speed depends on each parameter.
    pub fn sensitivities(&self) -> Option<&[Sensitivity]> {
        self.answers.sensitivities().and_then(|(found, _)| found.as_deref().ok())
    }

    /// The end of its search for a critical speed.
    pub fn search(&self) -> Option<&SearchEnd> {
        self.answers.last_critical()
    }

    /// Its critical speed.
    pub fn critical(&self) -> Option<&Critical> {
        self.search()?.critical.as_ref()
    }

    /// How far its critical speed can be trusted.
    pub fn certainty(&self) -> Certainty {
        Certainty::known(&self.scenario, &self.answers, &self.studies)
    }

    /// What is known of a study of it, once there is a picture.
    pub fn study(&self, topic: Topic) -> Option<&StudyResults> {
        self.studies.shown(topic).filter(|shown| shown.current).map(|shown| shown.known)
    }

    /// Asks for the studies of the plots on show, while `idle`: the present design comes first.
    pub fn want(&mut self, idle: bool, state: &UiState, plots: &[Plot]) -> Vec<Order> {
        let critical = self.critical().map(|critical| critical.speed);
        let idle = idle && self.is_complete();
        let plots = if idle { plots } else { &[] };
        let mut requests = studies::wanted(&self.scenario, state, plots, critical, idle);
        // The map and the border of the feasible region show one design.
        requests.retain(|request| !matches!(request.topic(), Topic::Map | Topic::Border));
        self.studies.want(requests)
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
