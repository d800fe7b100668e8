//! The critical speed: the smallest speed at which an eigenvalue's real part becomes positive.
//!
//! The growth rate against speed is not monotone, so the *first* crossing is wanted. The structured search finds it
//! without a scan; without damping it asks first whether the modes at rest grow with the speed. Where that leaves doubt
//! the speed is raised in steps to
//! the first unstable one, as in the paper, and the crossing before it is then refined. A crossing and its return
//! within one step are not seen; docs/theory.md section 8 says so.

use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::mechanics::Vibration;
use crate::stability::crossing::{FirstCrossing, Search};
use crate::stability::modes::responsible_cable;
use crate::stability::rest::{AtRest, FromRest};
use crate::stability::{Doubt, Eigenproblem, NotConverged, Polarisation, Spectra, Spectrum, mode};

/// The paper's step of the speed, in m/s.
pub const SCAN_STEP: f64 = 0.1;
/// The highest speed in m/s up to which a critical speed is searched for. A robot one of whose cables moves at the speed of
/// its waves is no longer stable, give or take a few times that, and in no cable waves are faster than some 2000 m/s.
pub const LARGEST_LIMIT: f64 = 10_000.0;
/// What the limit of a search may be.
pub const ALLOWED_LIMIT: &str = "a number of m/s greater than 0, at most 10000, as no wave in a cable is faster";
/// The crossing is refined to this many m/s.
const REFINED_TO: f64 = 1e-9;
/// Growth rates below this part of the largest frequency are rounding.
const ROUNDING: f64 = 1e-10;
/// So far from a crossing, in m/s, the growth rate must be larger than its rounding.
const CERTAIN: f64 = 1e-3;
/// Without damping, the search begins at this speed in m/s where all modes decay from rest on.
const ABOVE_REST: f64 = 1e-3;
/// Without damping, the fraction of a step at which the growing mode is looked at in place of v = 0.
const NEAR_ZERO: f64 = 1e-3;

/// Without damping, growth by this part of the threshold at half the speed has begun at rest. Rounding is a hundred times
/// smaller yet.
const FROM_REST: f64 = 0.0625;

/// How stability is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Instability {
    /// An oscillation grows.
    Flutter,
    /// A displacement grows without oscillating.
    Divergence,
}

/// The first crossing.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Critical {
    /// The critical speed in m/s.
    pub speed: f64,
    /// The eigenvalue that crosses, with Im λ ≥ 0, in 1/s.
    pub eigenvalue: Complex<f64>,
    /// Flutter, or divergence where Im λ = 0.
    pub kind: Instability,
    /// The cable with the largest share of the mode's kinetic energy, 0-based.
    pub cable: usize,
}

impl Critical {
    /// |Im λ|/2π of the crossing eigenvalue in Hz; 0 for divergence.
    pub fn frequency_hz(&self) -> f64 {
        match self.kind {
            Instability::Flutter => self.eigenvalue.im.abs() / TAU,
            Instability::Divergence => 0.0,
        }
    }
}

/// One speed that the search looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// In m/s.
    pub speed: f64,
    /// The largest Re λ there, in 1/s.
    pub growth_rate: f64,
}

/// How a search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A crossing was found.
    Found(Critical),
    /// Every speed up to the limit (m/s) is stable.
    NoneUpTo(f64),
}

impl Outcome {
    /// The first crossing, where one was found.
    pub fn critical(&self) -> Option<&Critical> {
        match self {
            Self::Found(critical) => Some(critical),
            Self::NoneUpTo(_) => None,
        }
    }
}

/// How the critical speed is searched for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// By structure, at a cost that grows with the number of elements; where that leaves doubt, by a
    /// scan like the dense one, with the eigenvalues of [`Spectra`].
    #[default]
    Structured,
    /// By all eigenvalues at speeds [`SCAN_STEP`] apart, then bisection.
    Dense,
}

/// What gives the scan its eigenvalues.
#[derive(Debug)]
enum ScanSolver {
    Structured(Box<Spectra>),
    Dense(Box<Eigenproblem>),
}

impl ScanSolver {
    fn new(method: Method, vibration: &Vibration) -> Result<Self, NotConverged> {
        Ok(match method {
            Method::Structured => Self::Structured(Box::new(Spectra::new(vibration)?)),
            Method::Dense => Self::Dense(Box::new(Eigenproblem::new(vibration)?)),
        })
    }

    fn spectrum(&mut self, vibration: &Vibration, speed: f64) -> Result<Spectrum, NotConverged> {
        match self {
            Self::Structured(spectra) => spectra.spectrum(vibration, speed),
            Self::Dense(problem) => problem.spectrum(speed),
        }
    }

    /// About the largest undamped frequency, in rad/s.
    fn scale(&self) -> f64 {
        match self {
            Self::Structured(spectra) => spectra.scale(),
            Self::Dense(problem) => problem.scale(),
        }
    }
}

/// Whether a critical speed can be searched for up to `speed` (m/s): [`ALLOWED_LIMIT`].
pub fn is_limit(speed: f64) -> bool {
    speed > 0.0 && speed <= LARGEST_LIMIT
}

/// A search for the critical speed of one problem in slices, so that it can be watched and abandoned.
///
/// ```
/// use tautline::stability::{CriticalSearch, Outcome};
/// use tautline::{LocalProblem, Motion, robot};
///
/// let motion = Motion::new([0.0, 0.0], [1.0, 0.0], 5.0)?;
/// let local = LocalProblem::new(&robot::paper()?, &motion).map_err(|failure| failure.reason)?;
/// let mut search = CriticalSearch::new(11.0);
/// let outcome = loop {
///     if let Some(outcome) = search.advance(&local.vibration)? {
///         break outcome;
///     }
///     // Here it can be watched, by `search.searched_up_to()`, or abandoned.
/// };
/// assert_eq!(outcome, Outcome::NoneUpTo(11.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CriticalSearch {
    limit: f64,
    method: Method,
    stage: Stage,
    /// Why there is a scan.
    doubt: Option<Doubt>,
    steps: u64,
    samples: Vec<Sample>,
}

/// What a search does next.
#[derive(Debug)]
enum Stage {
    Begin,
    /// Without damping, by structure: whether the modes at rest grow.
    Rest(FromRest),
    /// By structure: strips of speeds.
    Crossing(Box<FirstCrossing>),
    Scan(ScanSolver),
}

impl CriticalSearch {
    /// A search from rest to `limit` (m/s), [`LARGEST_LIMIT`] at most; there is nothing to search where it is not greater
    /// than 0.
    pub fn new(limit: f64) -> Self {
        Self::by(Method::default(), limit)
    }

    /// The same by `method`.
    pub fn by(method: Method, limit: f64) -> Self {
        let limit = if limit > 0.0 { limit.min(LARGEST_LIMIT) } else { 0.0 };
        Self { limit, method, stage: Stage::Begin, doubt: None, steps: 0, samples: Vec::new() }
    }

    /// The speeds the scan has looked at so far, in rising order; none where the structured search has answered.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Why the structured search has left the answer to the scan; `None` where it has answered, or was not asked.
    pub fn doubt(&self) -> Option<Doubt> {
        self.doubt
    }

    /// The speed up to which the search has come, in m/s.
    pub fn searched_up_to(&self) -> f64 {
        match &self.stage {
            Stage::Begin | Stage::Rest(_) => 0.0,
            Stage::Crossing(search) => search.searched_up_to(),
            Stage::Scan(_) => self.samples.last().map_or(0.0, |sample| sample.speed),
        }
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// [`NotConverged`] where an eigenvalue problem could not be solved.
    pub fn run(mut self, vibration: &Vibration) -> Result<Outcome, NotConverged> {
        loop {
            if let Some(outcome) = self.advance(vibration)? {
                return Ok(outcome);
            }
        }
    }

    /// Searches a part of the next strip of speeds by structure, or looks at the scan's next speed, of the same `vibration`; `None`
    /// while the search goes on.
    ///
    /// # Errors
    /// [`NotConverged`] where an eigenvalue problem could not be solved.
    pub fn advance(&mut self, vibration: &Vibration) -> Result<Option<Outcome>, NotConverged> {
        if matches!(self.stage, Stage::Begin) && self.method == Method::Dense {
            self.stage = Stage::Scan(ScanSolver::new(Method::Dense, vibration)?);
        }
        if let Stage::Scan(_) = self.stage {
            return self.scan(vibration);
        }
        match self.by_structure(vibration) {
            Ok(outcome) => Ok(outcome),
            Err(doubt) => {
                self.doubt = Some(doubt);
                self.stage = Stage::Scan(ScanSolver::new(Method::Structured, vibration)?);
                Ok(None)
            }
        }
    }

    /// The next step of the search by structure.
    fn by_structure(&mut self, vibration: &Vibration) -> Result<Option<Outcome>, Doubt> {
        let limit = self.limit;
        if limit == 0.0 {
            return Ok(Some(Outcome::NoneUpTo(limit)));
        }
        match &mut self.stage {
            Stage::Begin if is_undamped(vibration) => {
                self.stage = Stage::Rest(FromRest::new(vibration).map_err(|NotConverged| Doubt::Undamped)?);
                Ok(None)
            }
            Stage::Begin => {
                self.stage = Stage::Crossing(Box::new(FirstCrossing::new(vibration, 0.0, limit)?));
                Ok(None)
            }
            Stage::Rest(modes) => match modes.advance(vibration) {
                None => Ok(None),
                Some(AtRest::Grows(critical)) => Ok(Some(Outcome::Found(critical))),
                Some(AtRest::Neutral) => Err(Doubt::Undamped),
                Some(AtRest::Decays) => {
                    let mut search = FirstCrossing::new(vibration, ABOVE_REST, limit)?;
                    if !search.begins_stable(vibration) {
                        return Err(Doubt::Undamped);
                    }
                    self.stage = Stage::Crossing(Box::new(search));
                    Ok(None)
                }
            },
            Stage::Crossing(search) => Ok(search.advance(vibration)?.map(|found| match found {
                Search::NoneUpTo => Outcome::NoneUpTo(limit),
                Search::Crossing { omega, speed } => {
                    let eigenvalue = Complex::new(0.0, omega);
                    let mode = mode(vibration, speed, eigenvalue, Polarisation::default());
                    let kind = if omega > 0.0 { Instability::Flutter } else { Instability::Divergence };
                    Outcome::Found(Critical { speed, eigenvalue, kind, cable: responsible_cable(vibration, &mode) })
                }
            })),
            Stage::Scan(_) => Ok(None),
        }
    }

    /// Looks at the scan's next speed.
    fn scan(&mut self, vibration: &Vibration) -> Result<Option<Outcome>, NotConverged> {
        let Stage::Scan(solver) = &mut self.stage else { return Ok(None) };
        let scale = solver.scale();
        let mut spectrum = |speed: f64| solver.spectrum(vibration, speed);
        let speed = (self.steps as f64 * SCAN_STEP).min(self.limit);
        let here = spectrum(speed)?;
        let growth_rate = here.growth_rate();
        self.steps += 1;
        self.samples.push(Sample { speed, growth_rate });
        // At rest nothing grows: without damping the real parts are zero but for rounding.
        if speed == 0.0 {
            return Ok((self.limit == 0.0).then_some(Outcome::NoneUpTo(0.0)));
        }
        // What a growth rate must exceed to count as positive: zero; without damping, rounding.
        let threshold = if is_undamped(vibration) { ROUNDING * scale } else { 0.0 };
        // Growth that rounding hides decides nothing. It is hidden at a crossing, which may be just here, and no longer
        // beyond it.
        let (above, growth_rate) = if threshold == 0.0 && is_hidden(&here) {
            let beyond = spectrum(speed + CERTAIN)?;
            if is_hidden(&beyond) {
                return Err(NotConverged);
            }
            (speed + CERTAIN, beyond.growth_rate())
        } else {
            (speed, growth_rate)
        };
        if growth_rate > threshold {
            let before = self.samples[self.samples.len() - 2].speed;
            // Without damping nearly everything that grows at the first step has grown from rest on: look just above it.
            let near_zero = NEAR_ZERO * SCAN_STEP;
            let undamped = threshold > 0.0 && before == 0.0;
            // Undamped, every real part is zero at rest: the mode that grows is seen just above.
            let (critical, seen_at) = if undamped && spectrum(near_zero)?.growth_rate() > threshold {
                (0.0, near_zero)
            } else {
                let crossing = refine(&mut spectrum, threshold, if undamped { near_zero } else { before }, above)?;
                if crossing > self.limit {
                    return Ok(Some(Outcome::NoneUpTo(self.limit)));
                }
                // It must be growth that changes its sign there, and not rounding.
                for (near, sign) in [((crossing - CERTAIN).max(0.0), -1.0), (crossing + CERTAIN, 1.0)] {
                    let spectrum = spectrum(near)?;
                    if threshold == 0.0 && (is_hidden(&spectrum) || spectrum.growth_rate() * sign < 0.0) {
                        return Err(NotConverged);
                    }
                }
                // Where frequencies are high, growth from rest on meets the threshold late. It tells itself by what is left
                // at half the speed: a half if it is proportional to the speed, a quarter if to its square.
                let from_rest = threshold > 0.0 && spectrum(0.5 * crossing)?.growth_rate() > FROM_REST * threshold;
                (if from_rest { 0.0 } else { crossing }, crossing)
            };
            let eigenvalue = spectrum(seen_at)?.rightmost();
            let mode = mode(vibration, seen_at, eigenvalue, Polarisation::default());
            let kind = if eigenvalue.im > ROUNDING * scale { Instability::Flutter } else { Instability::Divergence };
            let critical = Critical { speed: critical, eigenvalue, kind, cable: responsible_cable(vibration, &mode) };
            return Ok(Some(Outcome::Found(critical)));
        }
        Ok((speed >= self.limit).then_some(Outcome::NoneUpTo(self.limit)))
    }
}

/// The first crossing by structure, up to `limit` (m/s), without a scan.
///
/// # Errors
/// [`Doubt`] where a scan must decide.
pub fn structured(vibration: &Vibration, limit: f64) -> Result<Outcome, Doubt> {
    let mut search = CriticalSearch::new(limit);
    loop {
        if let Some(outcome) = search.by_structure(vibration)? {
            return Ok(outcome);
        }
    }
}

/// Whether the growth rate may be rounding.
fn is_hidden(spectrum: &Spectrum) -> bool {
    spectrum.growth_rate().abs() <= spectrum.rounding(spectrum.rightmost())
}

fn is_undamped(vibration: &Vibration) -> bool {
    vibration.damping.alpha == 0.0 && vibration.damping.beta == 0.0
}

/// The crossing between a stable and an unstable speed, by bisection.
fn refine(
    spectrum: &mut impl FnMut(f64) -> Result<Spectrum, NotConverged>,
    threshold: f64,
    mut stable: f64,
    mut unstable: f64,
) -> Result<f64, NotConverged> {
    // Far from zero two neighbouring numbers may be further apart than that.
    while unstable - stable > REFINED_TO.max(4.0 * f64::EPSILON * unstable) {
        let middle = 0.5 * (stable + unstable);
        if spectrum(middle)?.growth_rate() > threshold {
            unstable = middle;
        } else {
            stable = middle;
        }
    }
    Ok(0.5 * (stable + unstable))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Cable, Damping, Linearisation, Motion, Robot, RobotSpec, TensionLaw, Vec2, paper_spec};
    use crate::study::LocalProblem;

    /// Also by the scan, which undamped robots are left to.
    #[test]
    fn a_search_up_to_no_speed_ends_at_once() {
        for damping in [paper_spec().damping, Damping { alpha: 0.0, beta: 0.0 }] {
            let robot = Robot::new(RobotSpec { damping, ..paper_spec() }).unwrap();
            let local = LocalProblem::new(&robot, &Motion::new([0.0, 0.0], [1.0, 0.0], 5.0).unwrap()).unwrap();
            for limit in [0.0, -1.0, f64::NAN] {
                for method in [Method::Structured, Method::Dense] {
                    let outcome = CriticalSearch::by(method, limit).run(&local.vibration);
                    assert_eq!(outcome, Ok(Outcome::NoneUpTo(0.0)), "{method:?} up to {limit}");
                }
            }
        }
    }

    /// The scan looks every 0.1 m/s; it says how far it has come and why it was asked.
    #[test]
    fn a_search_tells_how_far_it_has_come_and_why_it_scans() {
        let local = |damping| {
            let robot = Robot::new(RobotSpec { damping, ..paper_spec() }).unwrap();
            LocalProblem::new(&robot, &Motion::new([0.0, 0.0], [1.0, 0.0], 5.0).unwrap()).unwrap()
        };
        let damped = local(paper_spec().damping);
        let mut scan = CriticalSearch::by(Method::Dense, 0.25);
        assert_eq!((scan.searched_up_to(), scan.doubt()), (0.0, None));
        for (speed, outcome) in [(0.0, None), (0.1, None), (0.2, None), (0.25, Some(Outcome::NoneUpTo(0.25)))] {
            assert_eq!(scan.advance(&damped.vibration), Ok(outcome), "{speed}");
            assert!((scan.searched_up_to() - speed).abs() < 1e-12, "{} instead of {speed}", scan.searched_up_to());
        }
        assert_eq!(scan.doubt(), None);
        let growth: Vec<f64> = scan.samples().iter().map(|sample| sample.growth_rate).collect();
        assert!(growth.len() == 4 && growth.iter().all(|&rate| rate < 0.0), "{growth:?}");
        // The search by structure goes on in strips and samples nothing.
        let mut structured = CriticalSearch::new(40.0);
        let mut reached = vec![structured.searched_up_to()];
        let critical = loop {
            match structured.advance(&damped.vibration).unwrap() {
                None => reached.push(structured.searched_up_to()),
                Some(Outcome::Found(critical)) => break critical,
                Some(Outcome::NoneUpTo(_)) => panic!("no critical speed"),
            }
        };
        assert_eq!((structured.samples(), structured.doubt()), (&[][..], None));
        assert!(reached.len() > 4 && reached.is_sorted() && reached.iter().all(|&v| v < critical.speed), "{reached:?}");
        let undamped = local(Damping { alpha: 0.0, beta: 0.0 });
        let mut left_to_the_scan = CriticalSearch::new(5.0);
        while left_to_the_scan.doubt().is_none() {
            assert_eq!(left_to_the_scan.advance(&undamped.vibration), Ok(None));
        }
        assert_eq!(left_to_the_scan.doubt(), Some(Doubt::Undamped));
    }

    /// A cable across the motion of light and very taut cables: waves are so fast that it is stable far beyond what is
    /// searched. Strips grow with the speed, so that they are few; a speed that is no limit is none.
    #[test]
    fn a_search_far_beyond_all_that_moves_ends_soon() {
        let cable = |x, y, tension| Cable { anchor: Vec2::new(x, y), tension };
        let robot = Robot::new(RobotSpec {
            youngs_modulus: 1e13,
            area: 1e-4,
            mass_per_length: 1e-4,
            platform_mass: 1e6,
            cables: vec![
                cable(-5.0, 5.0, TensionLaw::Equilibrium),
                cable(5.5, 4.5, TensionLaw::Equilibrium),
                cable(0.6, 7.0, TensionLaw::Constant(2.5e6)),
            ],
            damping: Damping { alpha: 1e-3, beta: 0.0 },
            ..paper_spec()
        })
        .unwrap();
        let local = LocalProblem::new(&robot, &Motion::new([0.2, -0.5], [0.1, -1.0], 5.0).unwrap()).unwrap();
        for limit in [1e4, 1e9, f64::INFINITY] {
            let mut search = CriticalSearch::new(limit);
            let mut slices = 0;
            let outcome = loop {
                slices += 1;
                assert!(slices < 1000, "{slices} slices, at {} m/s", search.searched_up_to());
                if let Some(outcome) = search.advance(&local.vibration).unwrap() {
                    break outcome;
                }
            };
            assert_eq!((outcome, search.doubt()), (Outcome::NoneUpTo(LARGEST_LIMIT), None));
            assert!(slices > 50, "{slices} slices: not a long search");
        }
        for (speed, legal) in [(1e-3, true), (LARGEST_LIMIT, true), (1.0001 * LARGEST_LIMIT, false), (0.0, false)] {
            assert_eq!(is_limit(speed), legal, "{speed}");
        }
        assert!(!is_limit(f64::NAN) && !is_limit(f64::INFINITY) && ALLOWED_LIMIT.contains(&LARGEST_LIMIT.to_string()));
    }

    /// Where rounding hides on which side of the crossing the limit is, the crossing's place decides.
    #[test]
    fn a_crossing_beyond_the_limit_is_not_found() {
        let robot = Robot::new(RobotSpec { elements: 2, ..paper_spec() }).unwrap();
        let local = LocalProblem::new(&robot, &Motion::new([0.0, 0.0], [1.0, 0.0], 5.0).unwrap()).unwrap();
        let Ok(Outcome::Found(Critical { speed, .. })) = structured(&local.vibration, 30.0) else {
            panic!("no critical speed")
        };
        for aside in [2.0, 20.0].map(|part| part * REFINED_TO) {
            let up_to = |limit| CriticalSearch::by(Method::Dense, limit).run(&local.vibration).unwrap();
            assert_eq!(up_to(speed - aside), Outcome::NoneUpTo(speed - aside));
            assert!(matches!(up_to(speed + aside), Outcome::Found(_)), "{aside}");
        }
    }

    /// With any damping there is no scan, nor without where the modes at rest grow or decay; both methods tell the same.
    ///
    /// The paper's robot is its own mirror image at x = 0, and its cables change places when it turns round: backwards
    /// eigenvalues are the negative ones, so that moving along x without damping they stay on the axis until two meet.
    #[test]
    fn only_symmetric_robots_without_any_damping_are_left_to_the_scan() {
        for (alpha, beta, x, scan) in [
            (0.0, 0.0, 0.0, true),
            (0.0, 0.0, 0.5, false),
            (0.1, 0.0, 0.0, false),
            (0.0, 0.002, 0.0, false),
            (0.1, 0.002, 0.0, false),
        ] {
            let robot = Robot::new(RobotSpec { damping: Damping { alpha, beta }, ..paper_spec() }).unwrap();
            let local = LocalProblem::new(&robot, &Motion::new([x, 0.0], [1.0, 0.0], 5.0).unwrap()).unwrap();
            let structured = structured(&local.vibration, 15.0);
            assert_eq!(structured == Err(Doubt::Undamped), scan, "{structured:?}");
            let dense = CriticalSearch::by(Method::Dense, 15.0).run(&local.vibration).unwrap();
            if let (Ok(structured), Outcome::Found(b)) = (structured, dense) {
                let Outcome::Found(a) = structured else { panic!("{structured:?}") };
                assert!((a.speed - b.speed).abs() < 1e-6, "{a:?} {b:?}");
                assert_eq!((a.kind, b.kind), (Instability::Flutter, Instability::Flutter));
                assert!(a.speed == 0.0 || a.cable == b.cable, "{a:?} {b:?}");
            }
        }
    }

    /// What the modes at rest say is what all eigenvalues do a little above rest.
    #[test]
    fn without_damping_growth_from_rest_on_decides() {
        let damping = Damping { alpha: 0.0, beta: 0.0 };
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            for (at, towards) in [([2.0, 0.5], [1.0, 0.0]), ([-3.0, 1.0], [0.3, 1.0]), ([0.0, 0.0], [0.0, 1.0])] {
                let robot = Robot::new(RobotSpec { damping, linearisation, elements: 5, ..paper_spec() }).unwrap();
                let local = LocalProblem::new(&robot, &Motion::new(at, towards, 5.0).unwrap()).unwrap();
                let Ok(Outcome::Found(critical)) = structured(&local.vibration, 15.0) else { panic!("no growth") };
                assert_eq!((critical.speed, critical.eigenvalue.re), (0.0, 0.0));
                // The fastest growth, and in the mode that is named.
                let speed = 1e-3;
                let spectrum = Eigenproblem::new(&local.vibration).unwrap().spectrum(speed).unwrap();
                let named = spectrum.eigenvalues().min_by(|a, b| {
                    let distance = |l: &Complex<f64>| (l - critical.eigenvalue).norm();
                    distance(a).total_cmp(&distance(b))
                });
                let (growth, named) = (spectrum.growth_rate(), named.unwrap().re);
                assert!(growth > 0.0 && named > 0.9 * growth, "{growth:e}, {named:e} of the mode named");
            }
        }
    }
}
