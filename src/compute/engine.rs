//! The engine: takes the newest request, works in slices, replies as soon as something is known.
//!
//! The pose (shapes, spectrum, modes) of a new request is always served first, since it follows the pointer. If all of its
//! modes take long, the slowest ones are served at once, and all of them after the critical speed. A search for the critical
//! speed that is under way may finish if it does so soon. Otherwise each new position of a drag would start it again, and
//! the drag would never show a critical speed. Everything else that is under way is dropped for a newer pose after any
//! slice.

use std::sync::Arc;
use std::time::Duration;

use nalgebra::Complex;
use web_time::Instant;

use super::protocol::{
    AnalysedPose, CheckResult, DrawnShape, Extent, FailedPose, Job, ModeChoice, ModeRow, ModeShape, Reply, Request,
    Revision, SearchEnd, Update, Which,
};
use super::robot_study::search_limit;
use crate::mechanics::{CableShape, Infeasible, StaticsError};
use crate::robot::{Motion, Robot, Vec2};
use crate::scenario::report::{StatusReport, sentence};
use crate::scenario::{Report, Scenario};
use crate::stability::steps::step;
use crate::stability::{self, CriticalSearch, ModeValue, NotConverged, Outcome, Polarisation, Spectrum, Steps};
use crate::study::validation::CHECKS;
use crate::study::{LocalProblem, Sensitivity, sensitivities_in_steps};

/// A slice ends after this time, so that a newer request is seen soon.
const SLICE: Duration = Duration::from_millis(8);
/// A pose is served with all its modes where they take no longer than this, else with the slowest ones first.
const PROMPT: Duration = Duration::from_millis(50);
/// How many of the slowest modes are served first: more than the table of modes shows at once.
const SLOWEST: usize = 24;
/// A search that has run for longer is dropped for a newer pose.
const PATIENCE: Duration = Duration::from_millis(400);
/// A curve of growth rates that has taken longer is dropped for a newer pose. Shorter ones are finished, so that a drag
/// shows curves.
const CURVE_PATIENCE: Duration = Duration::from_millis(100);
/// A curve that follows within this time of another is dropped for a newer pose, so that the critical speed can follow the
/// pointer.
const CURVE_PAUSE: Duration = Duration::from_millis(500);
/// The curve of growth rates ends at this multiple of the critical speed or of the scenario's, whichever is higher.
const CURVE_MARGIN: f64 = 1.3;
/// How many points a curve gets: where the search has left none; and beyond the last one, where it has left some.
const CURVE_POINTS: u32 = 60;
const CURVE_POINTS_BEYOND: u32 = 24;
/// A curve takes about this time at most. On fine meshes it has fewer points for that, but at least the following number.
const CURVE_TIME: Duration = Duration::from_secs(2);
const LEAST_CURVE_POINTS: u32 = 8;

/// Serves requests in slices. Feed it with [`Engine::submit`], then call [`Engine::work`] until it returns `None`.
#[derive(Default)]
pub struct Engine {
    /// The newest job, not begun.
    job: Option<(Job, Instant)>,
    /// A mode choice that came after the job.
    choice: Option<ModeChoice>,
    /// The pose that is about to be served.
    first: Option<Pose>,
    /// The newest pose; its search has not begun.
    waiting: Option<Pose>,
    /// The pose whose critical speed is being searched for or has been found.
    running: Option<Pose>,
    /// When the last curve of growth rates was complete.
    last_curve: Option<Instant>,
    /// A check to do when all else is done.
    check: Option<usize>,
}

/// A pose under analysis.
struct Pose {
    revision: Revision,
    robot: Robot,
    local: Arc<LocalProblem>,
    motion: Motion,
    /// All modes at today's speed, as long as they are being computed.
    all: Option<Steps<AllModes>>,
    /// Those that are known.
    modes: Vec<ModeRow>,
    extent: Extent,
    /// The eigenvalue with the largest real part, of those that are known.
    rightmost: Option<Complex<f64>>,
    /// How long all modes have taken.
    effort: Duration,
    /// What is known before the critical speed.
    report: Report,
    choice: ModeChoice,
    limit: f64,
    submitted: Instant,
    phase: Phase,
    /// The curve, once its end is known.
    curve: Option<Curve>,
    /// What the search has found, once it has ended; or why it has failed, as a sentence.
    outcome: Option<Result<Outcome, String>>,
}

enum Phase {
    /// All modes, as long as that is prompt.
    Prompt,
    /// The slowest ones first.
    Slowest(Steps<Vec<ModeRow>>),
    Searching {
        search: Arc<CriticalSearch>,
        steps: Steps<Result<Outcome, NotConverged>>,
        since: Instant,
    },
    /// The rest of the modes.
    All,
    Curve {
        steps: Steps<Vec<[f64; 2]>>,
        since: Instant,
    },
    Sensitivities(Steps<Result<Vec<Sensitivity>, String>>),
    Done,
}

/// All modes of a pose with its spectrum; `None` where that could not be computed.
type AllModes = Option<(Spectrum, Vec<ModeRow>)>;

/// The curve of growth rates that is to be computed: a scan has left the `points` up to the speed `from`.
struct Curve {
    points: Vec<[f64; 2]>,
    from: f64,
    to: f64,
}

/// What a slice of work gives: replies, possibly none, while there is more to do.
type Slice = Vec<Reply>;

impl Engine {
    /// Takes a request; a newer one takes the place of an older one that has not begun.
    pub fn submit(&mut self, request: Request) {
        match request {
            Request::Analyze(job) => {
                self.choice = None;
                self.job = Some((job, Instant::now()));
            }
            Request::Shape(choice) => self.choice = Some(choice),
            Request::Check(index) => self.check = Some(index),
        }
    }

    /// Does one slice of work; `None` when there is nothing left to do.
    pub fn work(&mut self) -> Option<Slice> {
        self.analyse().or_else(|| self.check.take().map(check))
    }

    fn analyse(&mut self) -> Option<Slice> {
        if self.first.is_some() {
            return Some(self.serve_first());
        }
        if let Some((job, submitted)) = self.job.take() {
            return Some(self.begin(&job, submitted));
        }
        if let Some(choice) = self.choice.take() {
            // An older search under way must not show another mode than the one chosen now.
            let poses = [self.running.as_mut(), self.waiting.as_mut()];
            return Some(poses.into_iter().flatten().map(|pose| pose.choose(choice)).last().unwrap_or_default());
        }
        let overtaken = self.waiting.is_some();
        let Some(running) = self.running.as_mut() else {
            self.running = Some(self.waiting.take()?.searching());
            return Some(Vec::new());
        };
        let finished = match &running.phase {
            Phase::Searching { since, .. } => overtaken && since.elapsed() > PATIENCE,
            Phase::Curve { since, .. } => {
                let recent = self.last_curve.is_some_and(|last| last.elapsed() < CURVE_PAUSE);
                overtaken && (recent || since.elapsed() > CURVE_PATIENCE)
            }
            Phase::Prompt | Phase::Slowest(_) | Phase::All | Phase::Sensitivities(_) => overtaken,
            Phase::Done => true,
        };
        if finished {
            self.running = Some(self.waiting.take()?.searching());
            return Some(Vec::new());
        }
        let slice = running.slice();
        if slice.iter().any(|reply| matches!(reply.update, Update::Curve(_))) {
            self.last_curve = Some(Instant::now());
        }
        Some(slice)
    }

    /// Serves the pose of a new job.
    fn begin(&mut self, job: &Job, submitted: Instant) -> Slice {
        self.waiting = None;
        match Pose::new(job, submitted) {
            Ok(pose) => {
                self.first = Some(pose);
                self.serve_first()
            }
            Err(failed) => {
                // Whatever is being searched for belongs to a pose that has been left.
                self.running = None;
                vec![Reply { revision: job.revision, update: Update::Failed(failed) }]
            }
        }
    }
}

impl Engine {
    /// Goes on with the pose that is about to be served. A newer one does not stop that: the slowest modes are there soon,
    /// and a drag has to show something.
    fn serve_first(&mut self) -> Slice {
        let Some(pose) = &mut self.first else { return Vec::new() };
        if !pose.first_slice() {
            return Vec::new();
        }
        let replies = pose.serve();
        self.waiting = self.first.take();
        replies
    }
}

impl Curve {
    /// Its points, each of which takes about the time `effort`.
    fn steps(self, local: Arc<LocalProblem>, effort: Duration) -> Steps<Vec<[f64; 2]>> {
        let Self { mut points, from, to } = self;
        let (first, most) = if points.is_empty() { (0, CURVE_POINTS) } else { (1, CURVE_POINTS_BEYOND) };
        let affordable = CURVE_TIME.as_micros() / effort.as_micros().max(1);
        let last = u32::try_from(affordable).unwrap_or(most).clamp(LEAST_CURVE_POINTS, most);
        Steps::new(async move {
            let mut spectra = local.spectra.clone();
            for next in (first..=last).take_while(|_| to > from) {
                let speed = from + (to - from) * f64::from(next) / f64::from(last);
                // The answer stands without a point of its curve.
                if let Ok(spectrum) = spectra.spectrum_in_steps(&local.vibration, speed).await {
                    points.push([speed, spectrum.growth_rate()]);
                }
                step().await;
            }
            points
        })
    }
}

/// All modes of a pose at `speed` (m/s), in steps.
async fn all_modes(local: Arc<LocalProblem>, speed: f64, polarisation: Polarisation) -> AllModes {
    let spectrum = local.spectra.clone().spectrum_in_steps(&local.vibration, speed).await.ok()?;
    let values = spectrum.modes().collect();
    let rows = rows(&local, speed, values, polarisation).await;
    Some((spectrum, rows))
}

/// The slowest modes of a pose at `speed` (m/s), in steps.
async fn slowest_modes(local: Arc<LocalProblem>, speed: f64, polarisation: Polarisation) -> Vec<ModeRow> {
    let values = local.spectra.slowest_in_steps(speed, SLOWEST).await;
    rows(&local, speed, values, polarisation).await
}

/// Rows of the table of modes.
async fn rows(local: &LocalProblem, speed: f64, values: Vec<ModeValue>, polarisation: Polarisation) -> Vec<ModeRow> {
    let mut rows = Vec::with_capacity(values.len());
    for value in values {
        let mode = stability::mode(&local.vibration, speed, value.eigenvalue, polarisation);
        rows.push(ModeRow {
            eigenvalue: [value.eigenvalue.re, value.eigenvalue.im],
            multiplicity: value.multiplicity,
            frequency_hz: value.frequency_hz(),
            damping_ratio: value.damping_ratio(),
            cable_share: mode.cable_share,
            platform_share: mode.platform_share,
        });
        step().await;
    }
    rows
}

impl Pose {
    fn new(job: &Job, submitted: Instant) -> Result<Self, Box<FailedPose>> {
        let limit = search_limit(job.max_speed);
        let searched_up_to = limit.clone().unwrap_or_default();
        let refused = |reason: &str| {
            let status = Some(StatusReport::Failed);
            let report = Report { status, searched_up_to, ..Report::unknown(reason, 0.0) };
            Box::new(FailedPose { report, cable: None, push: None, shapes: Vec::new() })
        };
        let limit = limit.map_err(|reason| refused(&sentence(&reason)))?;
        let parsed = Scenario::from_json(&job.scenario).and_then(|scenario| scenario.to_robot());
        let (robot, motion) = parsed.map_err(|faults| refused(&faults.to_string()))?;
        let local = LocalProblem::new(&robot, &motion).map_err(|failure| {
            Box::new(FailedPose {
                report: Report::without_pose(&failure, motion.speed(), limit),
                cable: failure.reason.cable(),
                push: push(&failure.reason),
                shapes: failure.cables.iter().map(|shape| shape.as_ref().map(drawn)).collect(),
            })
        })?;
        let local = Arc::new(local);
        Ok(Self {
            revision: job.revision,
            all: Some(Steps::new(all_modes(local.clone(), motion.speed(), polarisation(job.mode)))),
            modes: Vec::new(),
            extent: Extent::SlowestSoFar,
            rightmost: None,
            effort: Duration::ZERO,
            report: Report::unknown("", motion.speed()),
            robot,
            local,
            motion,
            choice: job.mode,
            limit,
            submitted,
            phase: Phase::Prompt,
            curve: None,
            outcome: None,
        })
    }

    fn reply(&self, update: Update) -> Reply {
        Reply { revision: self.revision, update }
    }

    /// Does a slice of the pose, which is served first; tells whether it is complete.
    fn first_slice(&mut self) -> bool {
        let begun = Instant::now();
        while begun.elapsed() < SLICE {
            match &mut self.phase {
                Phase::Prompt => {
                    self.go_on_with_all(begun);
                    if self.all.is_none() && self.extent == Extent::All {
                        return true;
                    }
                    if self.all.is_none() || self.effort > PROMPT {
                        let polarisation = polarisation(self.choice);
                        let slowest = slowest_modes(self.local.clone(), self.motion.speed(), polarisation);
                        self.phase = Phase::Slowest(Steps::new(slowest));
                    }
                }
                Phase::Slowest(steps) => {
                    if let Some(rows) = steps.advance() {
                        self.modes = rows;
                        let values = self.modes.iter().map(|row| Complex::new(row.eigenvalue[0], row.eigenvalue[1]));
                        self.rightmost = values.max_by(|a, b| a.re.total_cmp(&b.re));
                        if self.all.is_some() {
                            self.report = Report::without_eigenvalues(&self.local, self.motion.speed());
                        }
                        return true;
                    }
                }
                _ => return true,
            }
        }
        false
    }

    /// Computes all modes for the rest of a slice that has `begun`.
    fn go_on_with_all(&mut self, begun: Instant) {
        let from = Instant::now();
        let mut found = None;
        while let (None, Some(steps)) = (&found, &mut self.all)
            && begun.elapsed() < SLICE
        {
            found = steps.advance();
        }
        self.effort += from.elapsed();
        let Some(found) = found else { return };
        self.all = None;
        let speed = self.motion.speed();
        self.report = Report::of_pose(&self.local, speed, found.as_ref().map(|(spectrum, _)| spectrum));
        match found {
            Some((spectrum, rows)) => {
                self.rightmost = Some(spectrum.rightmost());
                (self.modes, self.extent) = (rows, Extent::All);
            }
            None => self.extent = Extent::SlowestAlone,
        }
    }

    /// The pose as far as it is known, with the shape of a chosen mode.
    fn serve(&mut self) -> Slice {
        let mut replies = vec![self.reply(Update::Pose(Box::new(AnalysedPose {
            report: self.report.clone(),
            axial_forces: self.local.statics.cables.iter().map(axial_forces).collect(),
            modes: self.modes.clone(),
            extent: self.extent,
        })))];
        if self.choice.which != Which::Critical {
            replies.extend(self.shape());
        }
        replies
    }

    /// The same pose, whose search begins.
    fn searching(mut self) -> Self {
        let search = Arc::new(CriticalSearch::new(self.limit));
        let (watched, local) = (Arc::clone(&search), Arc::clone(&self.local));
        let steps = Steps::new(async move { search.run_in_steps(&local.vibration).await });
        self.phase = Phase::Searching { search: watched, steps, since: Instant::now() };
        self
    }

    fn mode(&self, speed: f64, eigenvalue: Complex<f64>) -> stability::Mode {
        stability::mode(&self.local.vibration, speed, eigenvalue, polarisation(self.choice))
    }

    /// The chosen mode's shape: the critical one at its speed, others at the scenario's.
    fn shape(&self) -> Option<Reply> {
        if let (Which::Critical, Some(Ok(Outcome::Found(critical)))) = (self.choice.which, &self.outcome) {
            let mode = self.mode(critical.speed, critical.eigenvalue);
            return Some(self.reply(Update::Shape(Box::new(ModeShape::new(&mode, critical.speed, true)))));
        }
        let wanted = match self.choice.which {
            Which::Critical | Which::Present => self.rightmost?,
            Which::Near([re, im]) => Complex::new(re, im.abs()),
        };
        let distance = |l: &Complex<f64>| (l - wanted).norm_sqr();
        let modes = self.modes.iter().map(|row| Complex::new(row.eigenvalue[0], row.eigenvalue[1]));
        let nearest = modes.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let speed = self.motion.speed();
        Some(self.reply(Update::Shape(Box::new(ModeShape::new(&self.mode(speed, nearest), speed, false)))))
    }

    /// Changes the chosen mode.
    fn choose(&mut self, choice: ModeChoice) -> Slice {
        self.choice = choice;
        // Before the search has ended the critical mode is not known; its end gives the shape.
        let known = choice.which != Which::Critical || self.outcome.is_some();
        if known { self.shape().into_iter().collect() } else { Vec::new() }
    }

    /// What each parameter does to the critical speed that was found, or why that cannot be told.
    fn sensitivities(&self) -> Steps<Result<Vec<Sensitivity>, String>> {
        let critical = match &self.outcome {
            Some(Ok(Outcome::Found(critical))) => Ok(critical.clone()),
            Some(Err(_)) => Err("The critical speed is not known.".into()),
            Some(Ok(Outcome::NoneUpTo(_))) | None => {
                Err(format!("There is no critical speed up to {} m/s.", self.limit))
            }
        };
        let (robot, motion) = (self.robot.clone(), self.motion);
        Steps::new(async move {
            let found = sensitivities_in_steps(&robot, &motion, &critical?).await;
            found.map_err(|reason| sentence(&reason.to_string()))
        })
    }

    /// Goes on to the curve once all modes are known; where they cannot be computed, to the sensitivities.
    fn curve(&mut self) -> Slice {
        if let (Extent::All, Some(curve)) = (self.extent, self.curve.take()) {
            self.phase = Phase::Curve { steps: curve.steps(self.local.clone(), self.effort), since: Instant::now() };
            return Vec::new();
        }
        // Where the eigenvalues could not be found at one speed, they would not be at others: no curve.
        self.phase = Phase::Sensitivities(self.sensitivities());
        vec![self.reply(Update::Curve(Vec::new()))]
    }

    /// One slice of the search, or of the work that follows it.
    fn slice(&mut self) -> Slice {
        let begun = Instant::now();
        let mut replies = loop {
            let replies = self.step(begun);
            if !replies.is_empty() || begun.elapsed() >= SLICE || matches!(self.phase, Phase::Done) {
                break replies;
            }
        };
        if let (Phase::Searching { search, .. }, true) = (&self.phase, replies.is_empty()) {
            replies.push(self.reply(Update::Searching(search.searched_up_to())));
        }
        replies
    }

    /// One step of a slice that has `begun`.
    fn step(&mut self, begun: Instant) -> Slice {
        match &mut self.phase {
            Phase::Done | Phase::Prompt | Phase::Slowest(_) => Vec::new(),
            Phase::Searching { search, steps, .. } => {
                let Some(outcome) = steps.advance() else { return Vec::new() };
                // Where only the search fails, the pose with its eigenvalues stands, and so do curve and modes.
                let outcome = outcome.map_err(|error| sentence(&error.to_string()));
                let points: Vec<[f64; 2]> = search.samples().iter().map(|s| [s.speed, s.growth_rate]).collect();
                let scanned = points.last().map_or(0.0, |point| point[0]);
                let mut replies = vec![self.reply(Update::Critical(SearchEnd {
                    critical: outcome.as_ref().ok().and_then(Outcome::critical).cloned(),
                    failure: outcome.as_ref().err().cloned(),
                    searched_up_to: if outcome.is_ok() { self.limit } else { scanned },
                    elapsed_ms: 1e3 * self.submitted.elapsed().as_secs_f64(),
                }))];
                let to = match &outcome {
                    Ok(Outcome::Found(critical)) => CURVE_MARGIN * critical.speed.max(self.motion.speed()).max(scanned),
                    Ok(Outcome::NoneUpTo(limit)) => scanned.max(*limit),
                    Err(_) => CURVE_MARGIN * self.motion.speed().max(scanned),
                };
                self.curve = Some(Curve { points, from: scanned, to });
                self.outcome = Some(outcome);
                if self.choice.which == Which::Critical {
                    replies.extend(self.shape());
                }
                self.phase = Phase::All;
                replies
            }
            Phase::All => {
                if self.all.is_none() {
                    return self.curve();
                }
                self.go_on_with_all(begun);
                if self.all.is_none() { self.serve() } else { Vec::new() }
            }
            Phase::Curve { steps, .. } => {
                let Some(points) = steps.advance() else { return Vec::new() };
                self.phase = Phase::Sensitivities(self.sensitivities());
                vec![self.reply(Update::Curve(points))]
            }
            Phase::Sensitivities(steps) => {
                let Some(found) = steps.advance() else { return Vec::new() };
                self.phase = Phase::Done;
                vec![self.reply(Update::Sensitivities(found))]
            }
        }
    }
}

fn polarisation(choice: ModeChoice) -> Polarisation {
    if choice.along_x { Polarisation::X } else { Polarisation::Y }
}

/// Does a check; there is nothing to say where there is no such check.
fn check(index: usize) -> Slice {
    let answer = CHECKS.get(index).map(|check| CheckResult {
        index,
        count: CHECKS.len(),
        name: check.name.into(),
        source: check.source.into(),
        unit: check.unit.into(),
        comparison: (check.run)().map_err(|reason| sentence(&reason.to_string())),
    });
    answer.map(|answer| Reply { revision: 0, update: Update::Checked(Box::new(answer)) }).into_iter().collect()
}

/// With how much a cable would have to push, in N, where one would.
fn push(reason: &StaticsError) -> Option<f64> {
    match *reason {
        StaticsError::Infeasible(Infeasible::WouldPush { tension, .. }) if tension < 0.0 => Some(-tension),
        _ => None,
    }
}

fn axial_forces(shape: &CableShape) -> Vec<f64> {
    shape.forces.iter().map(Vec2::norm).collect()
}

fn drawn(shape: &CableShape) -> DrawnShape {
    let nodes = shape.nodes.iter().map(|node| [node.x, node.y]).collect();
    DrawnShape { nodes, axial_forces: axial_forces(shape) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::presets;

    /// The engine at a pose whose search is about to fail, and all that it says from then on.
    fn replies_of_a_search_that_fails() -> (Report, Vec<Reply>) {
        let scenario = presets::PRESETS[0].scenario();
        let mode = ModeChoice { which: Which::Critical, along_x: false };
        let job = Job { revision: 3, scenario: scenario.to_json(), max_speed: 40.0, mode };
        let mut engine = Engine::default();
        engine.submit(Request::Analyze(job));
        let replies = engine.work().expect("work");
        let Some(Update::Pose(pose)) = replies.into_iter().map(|reply| reply.update).next() else { panic!("no pose") };
        // Only the search sees this copy of the matrices: the pose has been computed already.
        let waiting = engine.waiting.as_mut().expect("a pose");
        let mut local = LocalProblem::clone(&waiting.local);
        local.vibration.chains[1].elements_mut()[2].stiffness.across = f64::NAN;
        waiting.local = Arc::new(local);
        (pose.report, std::iter::from_fn(|| engine.work()).flatten().collect())
    }

    /// Cables, eigenvalues and modes stay, and the curve still comes.
    #[test]
    fn where_only_the_search_fails_the_pose_stays_and_the_reason_is_told() {
        let (pose, replies) = replies_of_a_search_that_fails();
        let answer = replies.iter().find_map(|reply| match &reply.update {
            Update::Critical(answer) => Some(answer),
            Update::Failed(failed) => panic!("{failed:?}"),
            _ => None,
        });
        let answer = answer.expect("the end of the search");
        let report = answer.completed(pose.clone());
        assert_eq!((answer.critical.as_ref(), report.status), (None, Some(StatusReport::Failed)));
        assert_eq!(report.reason.as_deref(), Some("The eigenvalues could not be computed."));
        assert!(report.searched_up_to < 40.0, "as far as it has come");
        let kept =
            |report: &Report| (report.cables.clone(), report.eigenvalues.clone(), report.stable, report.feasible);
        assert!(!report.eigenvalues.is_empty() && kept(&report) == kept(&pose));
        let curve = replies.iter().find_map(|reply| match &reply.update {
            Update::Curve(points) => Some(points),
            _ => None,
        });
        assert!(curve.is_some_and(|points| points.len() >= LEAST_CURVE_POINTS as usize), "{curve:?}");
        let last = replies.last().map(|reply| &reply.update);
        assert!(
            matches!(last, Some(Update::Sensitivities(Err(reason))) if reason == "The critical speed is not known.")
        );
    }
}
