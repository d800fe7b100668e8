//! The structured solver against a dense one that shares nothing with it, on random robots.
//!
//! `TAUTLINE_ROBOTS=1000 cargo test --release --test structured` checks that many instead of the usual few, and scans
//! the large ones as well; `TAUTLINE_SEED=n` begins with robot n. `-- --nocapture` shows what was left to a scan.

mod common;

use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use common::referee::{Known, Referee};
use common::unmatched;
use nalgebra::Complex;
use tautline::robot::{Cable, Damping, Linearisation, RobotSpec, Strain, TensionLaw, Vec2, paper_spec};
use tautline::stability::{Critical, Kind, Outcome, structured};
use tautline::{Local, Motion, Robot};

/// The usual number of robots.
const ROBOTS: u64 = 30;
/// Up to this speed in m/s the critical speed is searched for.
const LIMIT: f64 = 20.0;
/// The step of the referee's scan in m/s.
const STEP: f64 = 0.05;
/// Beyond this many eigenvalues only a full run scans; else the referee looks at a few speeds.
const USUAL: usize = 100;
const FEW: u32 = 8;
/// Critical speeds agree to this, in m/s, and to the referee's rounding.
const AGREEMENT: f64 = 1e-6;
/// Where the referee's rounding may move a crossing by more than this, in m/s, it is judged by the growth rates so far
/// from it, if they agree.
const CERTAIN: f64 = 1e-2;
/// Without damping, growth rates up to this part of the largest frequency count as zero (docs/theory.md section 8).
const UNDAMPED: f64 = 1e-10;
/// Shares of the kinetic energy nearer than this are a tie.
const TIE: f64 = 1e-6;
/// An eigenvalue that rounding may move by this part of it is judged by its residual as well.
const ILL: f64 = 1e-6;
/// The last step of the iteration for all eigenvalues is at most this part of each.
const CONVERGED: f64 = 1e-9;
/// Seeds of robots that were answered wrongly, or seemed to be, once; of the last two, all modes are overdamped to an
/// extent at which a dense solver may not converge.
const FIXED: [u64; 3] = [5664, 5270, 5949];

/// Robots of which the iteration, mostly begun at another speed's eigenvalues, once gave one close to −1/β that was
/// further off than its last step.
const CROWDED: [u64; 8] = [5, 70, 131, 172, 241, 509, 658, 956];

/// Robots of which an estimate once met an eigenvalue exactly, where elimination ends in a singular pivot, and was kept a
/// little beside it.
const MET: [u64; 7] = [151, 303, 510, 612, 788, 918, 995];

/// A robot with its referee.
struct Drawn {
    robot: Robot,
    local: Local,
    referee: Referee,
}

/// Uniform numbers by `SplitMix64`.
struct Numbers(u64);

impl Numbers {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / 9_007_199_254_740_992.0)
    }

    /// Uniform in the logarithm.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.within(low.ln(), high.ln()).exp()
    }

    fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[usize::try_from(self.bits() % of.len() as u64).unwrap()]
    }
}

/// A random robot that can be at rest in its pose; 3 to 6 cables, the first two at equilibrium and above the platform.
/// One of 16 has no damping.
fn random(seed: u64) -> Drawn {
    let mut numbers = Numbers(seed.wrapping_mul(0x5851_f42d_4c95_7f2d));
    loop {
        let pick = &mut numbers;
        let mut cables = vec![
            Cable {
                anchor: Vec2::new(pick.within(-12.0, -6.0), pick.within(3.0, 8.0)),
                tension: TensionLaw::Equilibrium,
            },
            Cable {
                anchor: Vec2::new(pick.within(6.0, 12.0), pick.within(3.0, 8.0)),
                tension: TensionLaw::Equilibrium,
            },
        ];
        let number = pick.one_of(&[3, 4, 4, 4, 5, 6]);
        while cables.len() < number {
            let side = if cables.len() % 2 == 0 { -1.0 } else { 1.0 };
            let anchor = Vec2::new(side * pick.within(2.0, 12.0), pick.within(-8.0, -3.0));
            let tension = if pick.one_of(&[false, true]) {
                TensionLaw::Constant(pick.decades(20.0, 400.0))
            } else {
                TensionLaw::Hypot {
                    horizontal: [pick.within(20.0, 120.0), pick.within(-5.0, 5.0), pick.within(-2.0, 2.0)],
                    vertical: [pick.within(20.0, 90.0), pick.within(-2.0, 2.0), 0.0],
                }
            };
            cables.push(Cable { anchor, tension });
        }
        let heavy = pick.one_of(&[false, true]);
        let damping = Damping {
            alpha: pick.one_of(&[0.0, 1.0, 1.0, 1.0])
                * if heavy { pick.within(0.5, 8.0) } else { pick.decades(0.01, 0.5) },
            beta: pick.one_of(&[0.0, 1.0, 1.0, 1.0])
                * if heavy { pick.decades(0.005, 0.1) } else { pick.decades(1e-5, 5e-3) },
        };
        let spec = RobotSpec {
            youngs_modulus: pick.decades(1e3, 1e7),
            area: 1.0,
            mass_per_length: pick.decades(0.05, 1.0),
            strain: pick.one_of(&[Strain::Green, Strain::Engineering]),
            platform_mass: pick.decades(0.5, 50.0),
            cables,
            elements: pick.one_of(&[3, 4, 5, 6, 8, 10, 16, 24]),
            damping,
            linearisation: pick.one_of(&[Linearisation::Secant, Linearisation::Tangent]),
            ..paper_spec()
        };
        let position = Vec2::new(pick.within(-6.0, 6.0), pick.within(-2.0, 2.0));
        let oblique = Vec2::new(pick.within(-1.0, 1.0), pick.within(-1.0, 1.0));
        let direction = pick.one_of(&[Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(0.0, -1.0), oblique]);
        let (Ok(robot), Ok(motion)) = (Robot::new(spec), Motion::new(position, direction, 1.0)) else { continue };
        if let Ok(local) = Local::new(&robot, &motion) {
            let referee = Referee::new(&robot, &local.statics, &local.rates);
            return Drawn { robot, local, referee };
        }
    }
}

/// The fixed seeds and those of this run.
fn seeds() -> Vec<u64> {
    let number = |name| std::env::var(name).ok().and_then(|text: String| text.parse().ok());
    let (count, first) = (number("TAUTLINE_ROBOTS").unwrap_or(ROBOTS), number("TAUTLINE_SEED").unwrap_or(0_u64));
    FIXED.into_iter().chain(first..first + count).collect()
}

/// Calls `judge` with these robots, on all cores; what it says, by seed.
fn for_each_robot<T: Send>(seeds: &[u64], judge: impl Fn(&Drawn) -> T + Sync) -> Vec<(u64, T)> {
    let (next, verdicts) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(&seed) = seeds.get(next.fetch_add(1, Ordering::Relaxed)) {
            let verdict = judge(&random(seed));
            verdicts.lock().unwrap().push((seed, verdict));
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let mut verdicts = verdicts.into_inner().unwrap();
    verdicts.sort_by_key(|&(seed, _)| seed);
    verdicts
}

/// Whether all robots are to be scanned.
fn is_full_run() -> bool {
    std::env::var_os("TAUTLINE_ROBOTS").is_some()
}

/// What a comparison tells.
enum Verdict {
    /// The answer is right.
    Right,
    /// The referee's rounding is too large, or it has not converged.
    NotJudged(String),
    Wrong(String),
}

impl Verdict {
    fn no_referee(speed: f64) -> Self {
        Self::NotJudged(format!("not converged at {speed} m/s"))
    }
}

/// The growth rate (1/s) that counts as positive.
fn threshold(drawn: &Drawn) -> f64 {
    let Damping { alpha, beta } = drawn.robot.damping;
    if alpha == 0.0 && beta == 0.0 { UNDAMPED * drawn.referee.scale } else { 0.0 }
}

/// Whether something grows at `speed` whatever the referee's rounding is.
fn surely_grows(drawn: &Drawn, speed: f64) -> Option<bool> {
    let known = drawn.referee.known(speed)?;
    Some(known.iter().any(|k| k.lambda.re - k.error > threshold(drawn)))
}

/// Each cable's share of the kinetic energy of a mode.
fn shares(drawn: &Drawn, known: &Known) -> Vec<f64> {
    let robot = &drawn.robot;
    let directions = known.shape.len() / (1 + robot.cables.len() * (robot.elements - 1));
    let node = |cable: usize, k: usize| match k {
        0 => known.shape.rows(0, directions).into_owned(),
        _ if k == robot.elements => known.shape.rows(0, directions) * Complex::from(0.0),
        _ => known.shape.rows((1 + cable * (robot.elements - 1) + k - 1) * directions, directions).into_owned(),
    };
    let energy = |cable: usize| {
        let of = |k: usize| {
            let (a, b) = (node(cable, k), node(cable, k + 1));
            a.norm_squared() + b.norm_squared() + a.dotc(&b).re
        };
        drawn.local.statics.cables[cable].length * (0..robot.elements).map(of).sum::<f64>()
    };
    let energies: Vec<f64> = (0..robot.cables.len()).map(energy).collect();
    let platform = 3.0 * robot.elements as f64 * robot.platform_mass / robot.mass_per_length
        * known.shape.rows(0, directions).norm_squared();
    let total = platform + energies.iter().sum::<f64>();
    energies.iter().map(|energy| energy / total).collect()
}

/// The referee's opinion of a crossing: how exactly it knows its speed, in m/s, or a verdict.
fn judge_crossing(drawn: &Drawn, critical: &Critical) -> Result<f64, Verdict> {
    let wrong = |what: String| Err(Verdict::Wrong(format!("{critical:?}: {what}")));
    let known = drawn.referee.known(critical.speed).ok_or_else(|| Verdict::no_referee(critical.speed))?;
    let distance = |k: &&Known| (k.lambda - critical.eigenvalue).norm();
    let nearest = known.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("eigenvalues");
    let exact = AGREEMENT + 2.0 * nearest.error / nearest.slope.re.abs();
    let around = |exact: f64| {
        let rate = |speed: f64| drawn.referee.growth_rate(speed).ok_or_else(|| Verdict::no_referee(speed));
        Ok([rate(critical.speed - exact)?, rate(critical.speed + exact)?])
    };
    if exact > CERTAIN {
        let [below, above] = around(CERTAIN)?;
        let agree = below <= 0.0 && above > 0.0;
        let unknown = || Verdict::NotJudged(format!("{critical:?} is known to {exact:e} m/s"));
        return if agree { Ok(CERTAIN) } else { Err(unknown()) };
    }
    if distance(&nearest) > nearest.error + AGREEMENT * nearest.slope.norm() {
        return wrong(format!("the nearest eigenvalue is {nearest:?}"));
    }
    if nearest.slope.re <= 0.0 {
        return wrong(format!("does not cross to the right, but by {}", nearest.slope));
    }
    let [below, above] = around(exact)?;
    if below > threshold(drawn) || above <= 0.0 {
        return wrong(format!("growth {below:e} below and {above:e} above"));
    }
    if (critical.kind == Kind::Flutter) != (nearest.lambda.im.abs() > nearest.error) {
        return wrong(format!("the eigenvalue is {}", nearest.lambda));
    }
    let shares = shares(drawn, nearest);
    if shares.iter().any(|share| *share > shares[critical.cable] + TIE) {
        return wrong(format!("the cables' shares of the kinetic energy are {shares:?}"));
    }
    Ok(exact)
}

/// The crossing between two speeds, by bisection to [`AGREEMENT`].
fn bisect(drawn: &Drawn, mut stable: f64, mut unstable: f64) -> Option<f64> {
    while unstable - stable > 0.1 * AGREEMENT {
        let middle = 0.5 * (stable + unstable);
        let grows = drawn.referee.growth_rate(middle)? > threshold(drawn);
        *(if grows { &mut unstable } else { &mut stable }) = middle;
    }
    Some(unstable)
}

/// Compares the critical speed with the referee's scan: none missed, none false.
fn judge_critical_speed(drawn: &Drawn) -> Verdict {
    let Ok(outcome) = drawn.local.critical_speed(LIMIT) else { return Verdict::Wrong("no answer".into()) };
    let (end, exact) = match &outcome {
        // Without damping, whatever grows does so from rest on.
        Outcome::Found(critical) if critical.speed == 0.0 => {
            return match surely_grows(drawn, STEP) {
                Some(true) => Verdict::Right,
                Some(false) => Verdict::NotJudged("growth just above rest is within rounding".into()),
                None => Verdict::no_referee(STEP),
            };
        }
        Outcome::Found(critical) => match judge_crossing(drawn, critical) {
            Ok(exact) => (critical.speed, exact),
            Err(verdict) => return verdict,
        },
        Outcome::NoneUpTo(limit) => (*limit, 0.0),
    };
    let scan = drawn.referee.size() <= USUAL || is_full_run();
    let step = if scan { STEP } else { end / f64::from(FEW) };
    let mut before = 0.0;
    loop {
        let speed = before + step;
        // A few speeds tell what was missed before the end; only a scan has a crossing of its own to compare.
        if speed > end + (if scan { step } else { 0.0 }) || speed > LIMIT + 0.5 * step {
            return Verdict::Right;
        }
        let Some(rate) = drawn.referee.growth_rate(speed) else { return Verdict::no_referee(speed) };
        let grows = rate > threshold(drawn);
        if grows && speed < end - exact {
            match surely_grows(drawn, speed) {
                Some(true) => return Verdict::Wrong(format!("{outcome:?}, but growth {rate:e} at {speed}")),
                Some(false) => {}
                None => return Verdict::no_referee(speed),
            }
        }
        if grows && speed > end && matches!(outcome, Outcome::Found(_)) {
            let Some(crossing) = bisect(drawn, before, speed) else { return Verdict::no_referee(speed) };
            // A later one is another: the referee has seen a return in between, and judged the earlier one above.
            let missed = crossing < end - exact;
            return if missed { Verdict::Wrong(format!("{outcome:?}, scan {crossing}")) } else { Verdict::Right };
        }
        before = speed;
    }
}

/// Whether the critical speed was left to a scan, and whether without stiffness damping.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    Structured,
    Scan,
    ScanWithoutStiffnessDamping,
    ScanWithoutDamping,
}

impl Way {
    fn of(drawn: &Drawn) -> Self {
        match drawn.robot.damping {
            _ if structured(&drawn.local.vibration, LIMIT).is_some() => Self::Structured,
            Damping { alpha: 0.0, beta: 0.0 } => Self::ScanWithoutDamping,
            Damping { beta: 0.0, .. } => Self::ScanWithoutStiffnessDamping,
            Damping { .. } => Self::Scan,
        }
    }
}

#[test]
fn the_critical_speed_is_that_of_the_dense_scan() {
    let verdicts = for_each_robot(&seeds(), |drawn| (Way::of(drawn), judge_critical_speed(drawn), drawn.robot.damping));
    // The fixed ones are there for being difficult.
    let drawn = || verdicts.iter().filter(|(seed, _)| !FIXED.contains(seed));
    let by = |way| -> Vec<u64> { drawn().filter(|(_, (by, ..))| *by == way).map(|(seed, _)| *seed).collect() };
    let (count, scanned) = (verdicts.len(), by(Way::Scan));
    let (mut wrong, mut not_judged) = (String::new(), 0);
    for (seed, (_, verdict, damping)) in &verdicts {
        match verdict {
            Verdict::Right => {}
            Verdict::NotJudged(why) => {
                not_judged += 1;
                println!("seed {seed} ({damping:?}) not judged: {why}");
            }
            Verdict::Wrong(why) => writeln!(wrong, "seed {seed} ({damping:?}): {why}").expect("a string"),
        }
    }
    println!(
        "{count} robots; left to a scan: {scanned:?}, {} with mass damping alone, {} without damping",
        by(Way::ScanWithoutStiffnessDamping).len(),
        by(Way::ScanWithoutDamping).len()
    );
    assert!(wrong.is_empty(), "of {count}:\n{wrong}");
    assert!(scanned.len() * 50 <= count.max(50), "{scanned:?} left to a scan");
    assert!(not_judged * 50 <= count.max(100), "{not_judged} of {count} not judged");
}

/// How far from each of the referee's eigenvalues its partner may be, and whether that says little.
///
/// With e = 4 n ε ‖A‖ κ, κ the eigenvalue's condition, a backward stable solver's rounding moves an eigenvalue by e to first
/// order and to second order by at most Σ e eₖ/|λ − λₖ| over the others. Where this is below e, 2 e is allowed. In a
/// crowd it is not: there discs with the radius n e hold the eigenvalues (Bauer and Fike).
fn allowed(known: &[Known]) -> Vec<(f64, bool)> {
    let one = |j: usize| {
        let others = known.iter().enumerate().filter(|&(k, _)| k != j);
        let second: f64 = others.map(|(_, other)| other.error / (other.lambda - known[j].lambda).norm()).sum();
        // Not a number where two are the same.
        let apart = second <= 1.0;
        let allowed = known[j].error * if apart { 2.0 } else { known.len() as f64 };
        (allowed, !apart || allowed > ILL * known[j].lambda.norm())
    };
    (0..known.len()).map(one).collect()
}

/// Compares all eigenvalues at one speed.
///
/// Each has its own partner among the referee's, no further from it than rounding explains. With stiffness damping the
/// stiffest modes have eigenvalues that crowd together at −1/β, where that says little: there Q(λ, v) has to be singular
/// but for rounding and for the iteration's last step as well.
fn judge_eigenvalues(drawn: &Drawn, speed: f64, found: &[Complex<f64>]) -> Verdict {
    let referee = &drawn.referee;
    let Some(known) = referee.known(speed) else { return Verdict::no_referee(speed) };
    let expected: Vec<_> = known.iter().map(|k| k.lambda).collect();
    let (allowed, ill): (Vec<_>, Vec<_>) = allowed(&known).into_iter().unzip();
    if found.len() != expected.len() {
        return Verdict::Wrong(format!("{} eigenvalues at {speed} m/s, not {}", found.len(), expected.len()));
    }
    if let Some(j) = unmatched(found, &expected, &allowed) {
        return Verdict::Wrong(format!("none left for {} ± {:e} at {speed} m/s", expected[j], allowed[j]));
    }
    for &lambda in found.iter().filter(|lambda| lambda.im >= 0.0) {
        let distance = |j: &usize| (expected[*j] - lambda).norm();
        let nearest = (0..expected.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if nearest.is_some_and(|j| ill[j]) {
            let (residual, slope) = referee.distance_from_singular(speed, lambda);
            let allowed = referee.size() as f64 * f64::EPSILON + CONVERGED * slope;
            if residual.is_nan() || residual > allowed {
                return Verdict::Wrong(format!("residual {residual:e} of {lambda} at {speed} m/s, not {allowed:e}"));
            }
        }
    }
    Verdict::Right
}

/// Compares all eigenvalues at a few speeds, each found from those before, as a scan and a curve of growth rates do.
fn check_eigenvalues(seeds: &[u64]) {
    let verdicts = for_each_robot(seeds, |drawn| {
        let mut spectra = drawn.local.spectra.clone();
        [1.0, 1.5, 6.0, 0.0].map(|speed| {
            let spectrum = spectra.iterate(speed)?;
            let found: Vec<_> = spectrum.eigenvalues().step_by(drawn.referee.multiplicity).collect();
            Some(judge_eigenvalues(drawn, speed, &found))
        })
    });
    let (mut wrong, mut undecided, mut not_judged) = (String::new(), Vec::new(), 0);
    for (seed, verdicts) in &verdicts {
        for verdict in verdicts {
            match verdict {
                // The fixed ones are there for being difficult.
                None if FIXED.contains(seed) => {}
                None => undecided.push(seed),
                Some(Verdict::Right) => {}
                Some(Verdict::NotJudged(why)) => {
                    not_judged += 1;
                    println!("seed {seed} not judged: {why}");
                }
                Some(Verdict::Wrong(why)) => writeln!(wrong, "seed {seed}: {why}").expect("a string"),
            }
        }
    }
    let asked = 4 * verdicts.len();
    println!("{asked} spectra; left to the dense solver: {undecided:?}");
    assert!(wrong.is_empty(), "{wrong}");
    assert!(undecided.len() * 20 <= asked.max(20), "{undecided:?} left to the dense solver");
    assert!(not_judged * 100 <= asked, "{not_judged} of {asked} not judged");
}

#[test]
fn all_eigenvalues_are_those_of_the_dense_solver() {
    check_eigenvalues(&seeds());
}

#[test]
fn eigenvalues_are_as_exact_where_they_crowd() {
    check_eigenvalues(&CROWDED);
}

#[test]
fn eigenvalues_that_are_met_exactly_are_kept() {
    check_eigenvalues(&MET);
}
