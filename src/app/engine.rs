//! The engine that answers the document: started where there is none, and again where it is lost.

use eframe::egui::Context;

use crate::app::answers::Answers;
use crate::compute::Compute;
use crate::compute::protocol::{Job, ModeChoice, Reply, Request, Revision};
use crate::scenario::Scenario;
use crate::scenario::report::DEFAULT_MAX_SPEED;

/// An engine that is lost so often over one state of the document is not started again before the next one.
const MOST_LOSSES: u32 = 2;

/// The engine of the present design.
pub struct Engine {
    /// To wake the interface with.
    context: Context,
    /// None before the first start, and where it is lost.
    pub compute: Option<Compute>,
    /// The document's state that was sent last.
    pub revision: Revision,
    /// How often the engine was lost over the document as it is.
    pub losses: u32,
}

impl Engine {
    /// Not started yet.
    pub fn new(context: &Context) -> Self {
        Self { context: context.clone(), compute: None, revision: 0, losses: 0 }
    }

    /// Sends a new state of the document to the engine, which is started where there is none.
    pub fn analyze(&mut self, scenario: &Scenario, mode: ModeChoice, answers: &mut Answers) {
        self.revision += 1;
        if self.compute.is_none() {
            let wake = self.context.clone();
            match Compute::start(move || wake.request_repaint()) {
                Ok(compute) => {
                    self.compute = Some(compute);
                    answers.mend();
                }
                Err(reason) => answers.break_down(reason),
            }
        }
        answers.expect(self.revision);
        let scenario = scenario.to_json();
        let job = Job { revision: self.revision, scenario, max_speed: DEFAULT_MAX_SPEED, mode };
        self.submit(&Request::Analyze(job), answers);
    }

    /// Sends a request to the engine, where there is one.
    pub fn submit(&mut self, request: &Request, answers: &mut Answers) {
        if let Some(Err(reason)) = self.compute.as_mut().map(|compute| compute.submit(request)) {
            answers.break_down(reason);
        }
    }

    /// The replies since the last call.
    pub fn poll(&mut self) -> Vec<Reply> {
        self.compute.as_mut().map(Compute::poll).unwrap_or_default()
    }

    /// Lets go of an engine that is gone, or does not answer; says whether another one may be tried.
    pub fn lose(&mut self) -> bool {
        self.compute = None;
        self.losses += 1;
        self.losses <= MOST_LOSSES
    }
}
