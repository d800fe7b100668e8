//! The engine: takes the newest request, works in slices, replies as soon as something is known.
//!
//! The pose (shapes, spectrum, modes) of a new request is always served first: that is what follows the pointer. A
//! search for the critical speed that is under way may finish if it does so soon; otherwise a drag would never show
//! one, since each new position would start it again.

use std::time::Duration;

use nalgebra::Complex;
use web_time::Instant;

use super::places::search_limit;
use super::protocol::{
    CheckAnswer, CriticalAnswer, DrawnShape, Failed, Job, ModeChoice, ModeRow, ModeShape, PoseAnswer, Reply, Request,
    Revision, Update, Which,
};
use crate::mechanics::CableShape;
use crate::robot::{Motion, Robot, Vec2};
use crate::scenario::report::{CriticalReport, SensitivityReport, StatusReport, sentence};
use crate::scenario::{Report, Scenario};
use crate::stability::{self, CriticalSearch, Outcome, Polarisation, Spectrum};
use crate::study::validation::CHECKS;
use crate::study::{Local, sensitivities};

/// A slice of the search ends after this time, so that a newer request is seen soon.
const SLICE: Duration = Duration::from_millis(8);
/// A search that has run for longer is dropped for a newer pose.
const PATIENCE: Duration = Duration::from_millis(400);
/// A curve of growth rates that has taken longer is dropped for a newer pose; others are finished, so that a drag shows
/// curves.
const CURVE_PATIENCE: Duration = Duration::from_millis(100);
/// For so long after a curve the next one is dropped for a newer pose: the critical speed is to follow the pointer.
const CURVE_PAUSE: Duration = Duration::from_millis(500);
/// The curve of growth rates goes on to this multiple of the critical speed and of today's.
const CURVE_MARGIN: f64 = 1.3;
/// The curve's points where the search has left none, and beyond those that it has left.
const CURVE_POINTS: u32 = 60;
const CURVE_POINTS_BEYOND: u32 = 24;
/// A curve is to take about so long: on fine meshes it has fewer points, but at least some.
const CURVE_TIME: Duration = Duration::from_secs(2);
const LEAST_CURVE_POINTS: u32 = 8;

/// Serves requests in slices. Feed it with [`Engine::submit`], then call [`Engine::work`] until it returns `None`.
#[derive(Default)]
pub struct Engine {
    /// The newest job, not begun.
    job: Option<(Job, Instant)>,
    /// A mode choice that came after the job.
    choice: Option<ModeChoice>,
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
    local: Local,
    motion: Motion,
    /// At today's speed, where it could be computed.
    spectrum: Option<Spectrum>,
    /// How long that took.
    effort: Duration,
    /// What is known before the critical speed.
    report: Report,
    choice: ModeChoice,
    limit: f64,
    submitted: Instant,
    stage: Stage,
    /// What the search has found, once it has ended; or why it has failed, as a sentence.
    outcome: Option<Result<Outcome, String>>,
}

enum Stage {
    Searching { search: CriticalSearch, since: Instant },
    Curve { from: f64, next: u32, to: f64, last: u32, points: Vec<[f64; 2]>, since: Instant },
    Sensitivities,
    Done,
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
            self.running = Some(self.waiting.take()?);
            return Some(Vec::new());
        };
        let finished = match &running.stage {
            Stage::Searching { since, .. } => overtaken && since.elapsed() > PATIENCE,
            Stage::Curve { since, .. } => {
                let recent = self.last_curve.is_some_and(|last| last.elapsed() < CURVE_PAUSE);
                overtaken && (recent || since.elapsed() > CURVE_PATIENCE)
            }
            Stage::Sensitivities => overtaken,
            Stage::Done => true,
        };
        if finished {
            let mut next = self.waiting.take()?;
            next.stage = Stage::searching(next.limit);
            self.running = Some(next);
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
                let mut replies = vec![pose.reply(Update::Pose(Box::new(pose.answer())))];
                if job.mode.which != Which::Critical {
                    replies.extend(pose.shape());
                }
                self.waiting = Some(pose);
                replies
            }
            Err(failed) => {
                // Whatever is being searched for belongs to a pose that has been left.
                self.running = None;
                vec![Reply { revision: job.revision, update: Update::Failed(failed) }]
            }
        }
    }
}

impl Stage {
    fn searching(limit: f64) -> Self {
        Self::Searching { search: CriticalSearch::new(limit), since: Instant::now() }
    }

    /// The curve of growth rates up to the speed `to`, of which a scan has left the `points` up to the speed `from`.
    /// One of its points takes about the time `effort`.
    fn curve(points: Vec<[f64; 2]>, from: f64, to: f64, effort: Duration) -> Self {
        let (next, most) = if points.is_empty() { (0, CURVE_POINTS) } else { (1, CURVE_POINTS_BEYOND) };
        let affordable = CURVE_TIME.as_micros() / effort.as_micros().max(1);
        let last = u32::try_from(affordable).unwrap_or(most).clamp(LEAST_CURVE_POINTS, most);
        Self::Curve { from, next, to, last, points, since: Instant::now() }
    }
}

impl Pose {
    fn new(job: &Job, submitted: Instant) -> Result<Self, Box<Failed>> {
        let limit = search_limit(job.max_speed);
        let searched_up_to = limit.clone().unwrap_or_default();
        let refused = |reason: &str| {
            let status = Some(StatusReport::Failed);
            let report = Report { status, searched_up_to, ..Report::unknown(reason, 0.0) };
            Box::new(Failed { report, cable: None, shapes: Vec::new() })
        };
        let limit = limit.map_err(|reason| refused(&sentence(&reason)))?;
        let parsed = Scenario::from_json(&job.scenario).and_then(|scenario| scenario.to_robot());
        let (robot, motion) = parsed.map_err(|faults| refused(&faults.to_string()))?;
        let local = Local::new(&robot, &motion).map_err(|failure| {
            Box::new(Failed {
                report: Report::without_pose(&failure, motion.speed(), limit),
                cable: failure.reason.cable(),
                shapes: failure.cables.iter().map(|shape| shape.as_ref().map(drawn)).collect(),
            })
        })?;
        let begun = Instant::now();
        let spectrum = local.spectrum(motion.speed()).ok();
        Ok(Self {
            revision: job.revision,
            effort: begun.elapsed(),
            report: Report::of_pose(&local, motion.speed(), spectrum.as_ref()),
            robot,
            local,
            motion,
            spectrum,
            choice: job.mode,
            limit,
            submitted,
            stage: Stage::searching(limit),
            outcome: None,
        })
    }

    fn reply(&self, update: Update) -> Reply {
        Reply { revision: self.revision, update }
    }

    fn answer(&self) -> PoseAnswer {
        let modes = self.spectrum.iter().flat_map(Spectrum::modes).map(|value| {
            let mode = self.mode(self.motion.speed(), value.eigenvalue);
            ModeRow {
                eigenvalue: [value.eigenvalue.re, value.eigenvalue.im],
                multiplicity: value.multiplicity,
                frequency_hz: value.frequency_hz(),
                damping_ratio: value.damping_ratio(),
                cable_share: mode.cable_share,
                platform_share: mode.platform_share,
            }
        });
        PoseAnswer {
            report: self.report.clone(),
            axial_forces: self.local.statics.cables.iter().map(axial_forces).collect(),
            modes: modes.collect(),
        }
    }

    fn mode(&self, speed: f64, eigenvalue: Complex<f64>) -> stability::Mode {
        let polarisation = if self.choice.along_x { Polarisation::X } else { Polarisation::Y };
        stability::mode(&self.local.vibration, speed, eigenvalue, polarisation)
    }

    /// The chosen mode's shape: the critical one at its speed, others at the scenario's.
    fn shape(&self) -> Option<Reply> {
        if let (Which::Critical, Some(Ok(Outcome::Found(critical)))) = (self.choice.which, &self.outcome) {
            let mode = self.mode(critical.speed, critical.eigenvalue);
            return Some(self.reply(Update::Shape(Box::new(ModeShape::new(&mode, critical.speed, true)))));
        }
        let spectrum = self.spectrum.as_ref()?;
        let wanted = match self.choice.which {
            Which::Critical => spectrum.rightmost(),
            Which::Near([re, im]) => Complex::new(re, im.abs()),
        };
        let distance = |l: &Complex<f64>| (l - wanted).norm_sqr();
        let modes = spectrum.modes().map(|mode| mode.eigenvalue);
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
    fn sensitivities(&self) -> Result<Vec<SensitivityReport>, String> {
        let critical = match &self.outcome {
            Some(Ok(Outcome::Found(critical))) => critical,
            Some(Err(_)) => return Err("The critical speed is not known.".into()),
            Some(Ok(Outcome::NoneUpTo(_))) | None => {
                return Err(format!("There is no critical speed up to {} m/s.", self.limit));
            }
        };
        let found = sensitivities(&self.robot, &self.motion, critical);
        Ok(found.map_err(|reason| sentence(&reason.to_string()))?.iter().map(SensitivityReport::from).collect())
    }

    /// One slice of the search, of the curve or of what follows.
    fn slice(&mut self) -> Slice {
        let begun = Instant::now();
        let mut replies = loop {
            let replies = self.step();
            if !replies.is_empty() || begun.elapsed() >= SLICE || matches!(self.stage, Stage::Done) {
                break replies;
            }
        };
        if let (Stage::Searching { search, .. }, true) = (&self.stage, replies.is_empty()) {
            replies.push(self.reply(Update::Searching(search.searched_up_to())));
        }
        replies
    }

    /// One eigenvalue problem of the search or of the curve, or all that follows.
    fn step(&mut self) -> Slice {
        match &mut self.stage {
            Stage::Done => Vec::new(),
            Stage::Searching { search, .. } => {
                // Where only the search fails, the pose with its eigenvalues stands, and so do curve and modes.
                let outcome = match search.advance(&self.local.vibration) {
                    Ok(None) => return Vec::new(),
                    Ok(Some(outcome)) => Ok(outcome),
                    Err(error) => Err(sentence(&error.to_string())),
                };
                let scan: Vec<[f64; 2]> = search.samples().iter().map(|s| [s.speed, s.growth_rate]).collect();
                let scanned = scan.last().map_or(0.0, |point| point[0]);
                let mut replies = vec![self.reply(Update::Critical(CriticalAnswer {
                    critical: outcome.as_ref().ok().and_then(CriticalReport::of),
                    failure: outcome.as_ref().err().cloned(),
                    searched_up_to: if outcome.is_ok() { self.limit } else { scanned },
                    elapsed_ms: 1e3 * self.submitted.elapsed().as_secs_f64(),
                }))];
                let end = match &outcome {
                    Ok(Outcome::Found(critical)) => CURVE_MARGIN * critical.speed.max(self.motion.speed()).max(scanned),
                    Ok(Outcome::NoneUpTo(limit)) => scanned.max(*limit),
                    Err(_) => CURVE_MARGIN * self.motion.speed().max(scanned),
                };
                self.outcome = Some(outcome);
                if self.choice.which == Which::Critical {
                    replies.extend(self.shape());
                }
                self.stage = if self.spectrum.is_some() {
                    Stage::curve(scan, scanned, end, self.effort)
                } else {
                    // Nor would the eigenvalues be found at other speeds.
                    replies.push(self.reply(Update::Curve(Vec::new())));
                    Stage::Sensitivities
                };
                replies
            }
            Stage::Curve { from, next, to, last, points, .. } => {
                if *next <= *last && *to > *from {
                    let speed = *from + (*to - *from) * f64::from(*next) / f64::from(*last);
                    // The answer stands without a point of its curve.
                    if let Ok(spectrum) = self.local.spectra.spectrum(&self.local.vibration, speed) {
                        points.push([speed, spectrum.growth_rate()]);
                    }
                    *next += 1;
                    return Vec::new();
                }
                let points = std::mem::take(points);
                self.stage = Stage::Sensitivities;
                vec![self.reply(Update::Curve(points))]
            }
            Stage::Sensitivities => {
                self.stage = Stage::Done;
                vec![self.reply(Update::Sensitivities(self.sensitivities()))]
            }
        }
    }
}

/// Does a check; there is nothing to say where there is no such check.
fn check(index: usize) -> Slice {
    let answer = CHECKS.get(index).map(|check| CheckAnswer {
        index,
        count: CHECKS.len(),
        name: check.name.into(),
        source: check.source.into(),
        unit: check.unit.into(),
        outcome: (check.run)()
            .map(|outcome| [outcome.expected, outcome.got, outcome.tolerance])
            .map_err(|reason| sentence(&reason.to_string())),
    });
    answer.map(|answer| Reply { revision: 0, update: Update::Checked(Box::new(answer)) }).into_iter().collect()
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
        // The search's own matrices; the pose has been computed from the others.
        let waiting = engine.waiting.as_mut().expect("a pose");
        waiting.local.vibration.chains[1].elements_mut()[2].elastic *= f64::NAN;
        (pose.report, std::iter::from_fn(|| engine.work()).flatten().collect())
    }

    /// Cables, eigenvalues and modes stay; the curve and what follows from the pose alone comes, too.
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
