//! Spectra and critical speeds judged by the [`Referee`]: right, wrong, or beyond what its own rounding lets it know.

use nalgebra::{Complex, DMatrix, DVector};
use tautline::robot::Damping;
use tautline::stability::{Critical, Instability, Outcome, Solver, Spectrum};
use tautline::{LocalProblem, Robot};

use super::dense::Parts;
use super::hung::mass_per_length;
use super::referee::{Known, Referee};
use super::unmatched;

type C64 = Complex<f64>;

/// The step of the referee's scan in m/s.
const STEP: f64 = 0.05;
/// A referee that does not scan looks at this many speeds.
const FEW: u32 = 8;
/// Critical speeds agree to this plus the referee's rounding, in m/s.
const AGREEMENT: f64 = 1e-6;
/// If the referee's rounding may move a crossing by more than this, in m/s, the growth rates at this distance from the
/// crossing judge it, if they agree.
const CERTAIN: f64 = 1e-2;
/// Without damping, growth rates up to this part of the largest frequency count as zero (docs/theory.md section 8).
const UNDAMPED: f64 = 1e-10;
/// Shares of the kinetic energy nearer than this are a tie.
const TIE: f64 = 1e-6;
/// An eigenvalue that rounding may move by this part of itself is judged by its residual as well.
const ILL: f64 = 1e-6;
/// A crossing is looked at from this part of its speed below and above.
const ASIDE: f64 = 1e-4;
/// The eigenvalue that crosses is followed in this many steps.
const STEPS: u32 = 8;
/// The last step of the iteration for all eigenvalues is at most this part of each, where rounding is small.
const CONVERGED: f64 = 1e-9;
/// The relative error that is promised for an extreme robot's eigenvalues.
const PROMISED: f64 = 1e-6;

/// A robot with its referee.
pub struct Drawn {
    pub robot: Robot,
    pub local: LocalProblem,
    pub referee: Referee,
}

impl Drawn {
    /// A robot at rest on its way.
    pub fn new(robot: Robot, local: LocalProblem) -> Self {
        let referee = Referee::new(&robot, &local.statics, &local.rates);
        Self { robot, local, referee }
    }
}

/// The result of a comparison.
pub enum Verdict {
    /// The answer is right.
    Right,
    /// The referee's rounding is too large, or it has not converged.
    NotJudged(String),
    Wrong(String),
}

impl Verdict {
    pub fn no_referee(speed: f64) -> Self {
        Self::NotJudged(format!("not converged at {speed} m/s"))
    }
}

/// The growth rate (1/s) that counts as positive.
pub fn threshold(drawn: &Drawn) -> f64 {
    let Damping { alpha, beta } = drawn.robot.damping;
    if alpha == 0.0 && beta == 0.0 { UNDAMPED * drawn.referee.scale } else { 0.0 }
}

/// Whether something grows at `speed` whatever the referee's rounding is.
fn surely_grows(drawn: &Drawn, speed: f64) -> Option<bool> {
    let known = drawn.referee.known(speed)?;
    Some(known.iter().any(|k| k.lambda.re - k.error > threshold(drawn)))
}

/// Whether nothing grows at `speed` whatever the referee's rounding is.
fn surely_stable(drawn: &Drawn, speed: f64) -> Option<bool> {
    let known = drawn.referee.known(speed)?;
    Some(known.iter().all(|k| k.lambda.re + k.error <= threshold(drawn)))
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
        let mass = mass_per_length(robot, cable) * drawn.local.statics.cables[cable].length;
        mass * (0..robot.elements).map(of).sum::<f64>()
    };
    let energies: Vec<f64> = (0..robot.cables.len()).map(energy).collect();
    let platform = 3.0 * robot.elements as f64 * robot.platform_mass * known.shape.rows(0, directions).norm_squared();
    let total = platform + energies.iter().sum::<f64>();
    energies.iter().map(|energy| energy / total).collect()
}

/// The referee's opinion of a crossing: how exactly it knows its speed, in m/s, or a verdict.
fn judge_crossing(drawn: &Drawn, critical: &Critical) -> Result<f64, Verdict> {
    let wrong = |what: String| Err(Verdict::Wrong(format!("{critical:?}: {what}")));
    let known = drawn.referee.known(critical.speed).ok_or_else(|| Verdict::no_referee(critical.speed))?;
    let distance = |k: &&Known| (k.lambda - critical.eigenvalue).norm();
    let nearest = known.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("eigenvalues");
    // A divergence is at λ = 0 whatever the rounding, which moves its speed alone.
    if critical.kind == Instability::Flutter && nearest.error > 0.1 * nearest.lambda.norm() {
        return Err(Verdict::NotJudged(format!("{critical:?} crosses by what is known to {:e} alone", nearest.error)));
    }
    let exact = AGREEMENT + 2.0 * nearest.error / nearest.slope.re.abs();
    let around = |exact: f64| {
        let rate = |speed: f64| drawn.referee.growth_rate(speed).ok_or_else(|| Verdict::no_referee(speed));
        // Backwards a robot is another one.
        Ok([rate((critical.speed - exact).max(0.0))?, rate(critical.speed + exact)?])
    };
    if exact > CERTAIN {
        let [below, above] = around(CERTAIN)?;
        let agree = below <= 0.0 && above > 0.0;
        let unknown = || Verdict::NotJudged(format!("{critical:?} is known to {exact:e} m/s"));
        return if agree { Ok(CERTAIN) } else { Err(unknown()) };
    }
    if distance(&nearest) > nearest.error + CONVERGED * nearest.lambda.norm() + AGREEMENT * nearest.slope.norm() {
        return wrong(format!("the nearest eigenvalue is {nearest:?}"));
    }
    if nearest.slope.re <= 0.0 {
        return wrong(format!("does not cross to the right, but by {}", nearest.slope));
    }
    let [below, above] = around(exact)?;
    if below > threshold(drawn) || above <= 0.0 {
        let what = format!("growth {below:e} below and {above:e} above");
        let rounding = surely_grows(drawn, (critical.speed - exact).max(0.0)) == Some(false)
            && surely_stable(drawn, critical.speed + exact) == Some(false);
        return if rounding { Err(Verdict::NotJudged(what)) } else { wrong(what) };
    }
    if (critical.kind == Instability::Flutter) != (nearest.lambda.im.abs() > nearest.error) {
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
        if grows {
            unstable = middle;
        } else {
            stable = middle;
        }
    }
    Some(unstable)
}

/// Compares the critical speed up to `limit` (m/s) with the referee's scan: none missed, none false. Without a `scan` it
/// looks at a few speeds on the way.
pub fn judge_critical_speed(drawn: &Drawn, limit: f64, scan: bool) -> Verdict {
    let Ok(outcome) = drawn.local.critical_speed(limit) else { return Verdict::Wrong("no answer".into()) };
    let (end, exact) = match &outcome {
        // Without damping, a mode that grows does so from rest on.
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
    let step = if scan { STEP } else { end / f64::from(FEW) };
    let mut before = 0.0;
    loop {
        let speed = before + step;
        // A few speeds tell what was missed before the end; only a scan has a crossing of its own to compare.
        if speed > end + (if scan { step } else { 0.0 }) || speed > limit + 0.5 * step {
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
            // A later crossing is another one: the referee has seen a return in between, and judged the earlier one above.
            let missed = crossing < end - exact;
            return if missed { Verdict::Wrong(format!("{outcome:?}, scan {crossing}")) } else { Verdict::Right };
        }
        before = speed;
    }
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
        // This is NaN if two eigenvalues are the same.
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
/// but for rounding and for the iteration's last step as well. The solver's own `rounding` (1/s) of each is
/// allowed.
pub fn judge_eigenvalues(
    drawn: &Drawn,
    speed: f64,
    found: &[Complex<f64>],
    rounding: impl Fn(Complex<f64>) -> f64,
) -> Verdict {
    let referee = &drawn.referee;
    let Some(known) = referee.known(speed) else { return Verdict::no_referee(speed) };
    let expected: Vec<_> = known.iter().map(|k| k.lambda).collect();
    let (allowed, ill): (Vec<_>, Vec<_>) =
        allowed(&known).into_iter().zip(&expected).map(|((error, ill), &l)| (error + rounding(l), ill)).unzip();
    if found.len() != expected.len() {
        return Verdict::Wrong(format!("{} eigenvalues at {speed} m/s, not {}", found.len(), expected.len()));
    }
    if let Some(j) = unmatched(found, &expected, &allowed) {
        let gap = found.iter().map(|l| (l - expected[j]).norm()).fold(f64::INFINITY, f64::min);
        let [value, allowed] = [expected[j].to_string(), format!("{:e}", allowed[j])];
        return Verdict::Wrong(format!(
            "none left for {value} ± {allowed} at {speed} m/s, the nearest is off by {gap:e}"
        ));
    }
    for &lambda in found.iter().filter(|lambda| lambda.im >= 0.0) {
        let distance = |j: &usize| (expected[*j] - lambda).norm();
        let nearest = (0..expected.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if nearest.is_some_and(|j| ill[j]) {
            let (residual, slope) = referee.distance_from_singular(speed, lambda);
            let relative = CONVERGED + rounding(lambda) / lambda.norm();
            // As the referee's own backward error.
            let allowed = 4.0 * referee.size() as f64 * f64::EPSILON + relative * slope;
            if residual.is_nan() || residual > allowed {
                return Verdict::Wrong(format!("residual {residual:e} of {lambda} at {speed} m/s, not {allowed:e}"));
            }
        }
    }
    Verdict::Right
}

/// Compares all eigenvalues at one speed with the problem itself, each on its own scale: also of robots whose fastest
/// modes are so much faster than their slowest ones that a dense solver knows nothing of these.
///
/// Of the iteration's, every λ is as near to an eigenvalue as is promised, or as the rounding of Q's entries explains
/// ([`Near`]), and none is missing or there twice: Σ 1/(z − λⱼ) is tr Q⁻¹ Q′ at places z of all magnitudes. The dense
/// solver's are compared with the referee's, and rounding relative to the largest is allowed as it is to that.
pub fn judge_spectrum(drawn: &Drawn, speed: f64, spectrum: &Spectrum) -> Verdict {
    let all: Vec<C64> = spectrum.eigenvalues().collect();
    let nodes = 1 + drawn.robot.cables.len() * (drawn.robot.elements - 1);
    if all.len() != 4 * nodes || !all.iter().all(|l| l.re.is_finite() && l.im.is_finite()) {
        return Verdict::Wrong(format!("{} eigenvalues at {speed} m/s of {nodes} nodes", all.len()));
    }
    let found: Vec<C64> = all.into_iter().step_by(drawn.referee.multiplicity).collect();
    if spectrum.solver() == Solver::Dense {
        let rounding = |lambda: C64| spectrum.rounding(lambda) + PROMISED * lambda.norm();
        return judge_eigenvalues(drawn, speed, &found, rounding);
    }
    let problem = Problem::new(drawn, speed);
    let mut errors = Vec::with_capacity(found.len());
    for &lambda in &found {
        let Some(near) = problem.near(lambda) else {
            return Verdict::NotJudged(format!("{lambda} leaves the range of floating point"));
        };
        let allowed = PROMISED * lambda.norm() + near.rounding;
        // One step is an estimate, worse where other eigenvalues are near. If the referee's are nearer, two solvers agree.
        let far = |distance: f64| distance.is_nan() || distance > allowed;
        if far(near.distance) && far(problem.follow(lambda).map_or(f64::NAN, |(exact, _)| (exact - lambda).norm())) {
            let referee = drawn.referee.eigenvalues(speed);
            let nearest = referee.iter().flatten().map(|known| (known - lambda).norm()).fold(f64::NAN, f64::min);
            if far(nearest) {
                let off = near.distance;
                return Verdict::Wrong(format!("{lambda} at {speed} m/s is off by {off:e}, not {allowed:e}"));
            }
        }
        errors.push(allowed);
    }
    let sizes = || found.iter().map(|l| l.norm()).filter(|size| *size > 0.0);
    let (smallest, largest) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    let mut size = 0.5 * smallest;
    while size < 2.0 * largest {
        for z in [C64::from(size), C64::from_polar(size, 1.0)] {
            let Some((sum, rounding)) = problem.sum(z) else { continue };
            let total: C64 = found.iter().map(|l| (z - l).inv()).sum();
            let moved: f64 = found.iter().zip(&errors).map(|(l, error)| error / (z - l).norm_sqr()).sum();
            if (sum - total).norm() > rounding + moved {
                let off = (sum - total).norm() * size;
                return Verdict::Wrong(format!("at {speed} m/s eigenvalues near |λ| = {size:e} are missing: {off:e}"));
            }
        }
        size *= 10.0;
    }
    Verdict::Right
}

/// Whether the eigenvalue that crosses is left of the axis a little below the critical speed and right of it above, on its
/// own scale, as [`judge_spectrum`] has it.
pub fn judge_crossing_closely(drawn: &Drawn, critical: &Critical) -> Verdict {
    if critical.speed == 0.0 {
        return Verdict::NotJudged("at rest".into());
    }
    let mut moves = Vec::new();
    for side in [-1.0, 1.0] {
        let speed = (critical.speed * (1.0 + ASIDE * side) + AGREEMENT * side).max(0.0);
        // Followed in small steps: others may be near.
        let mut parts =
            (1..=STEPS).map(|k| critical.speed + (speed - critical.speed) * f64::from(k) / f64::from(STEPS));
        let followed = parts.try_fold((critical.eigenvalue, None), |last, speed| {
            let (lambda, near) = Problem::new(drawn, speed).follow(last.0)?;
            Some((lambda, Some(near)))
        });
        let Some((lambda, Some(near))) = followed else {
            return Verdict::NotJudged("the eigenvalue that crosses cannot be followed".into());
        };
        moves.push(lambda - critical.eigenvalue);
        // Through a crossing it moves on; what turns back there is another one.
        if let [below, above] = moves[..]
            && (above + below).norm() > 0.5 * (above - below).norm()
        {
            return Verdict::NotJudged("the eigenvalue that crosses cannot be followed".into());
        }
        let threshold = threshold(drawn);
        let growth = lambda.re - threshold;
        if (0.25 * threshold..4.0 * threshold).contains(&lambda.re) {
            return Verdict::NotJudged(format!("{lambda} at {speed} m/s is about the largest that counts as zero"));
        }
        if near.distance > 1e-3 * growth.abs() {
            return Verdict::NotJudged(format!("{lambda} at {speed} m/s is known to {:e}", near.distance));
        }
        if growth.abs() <= near.rounding + near.distance {
            return Verdict::NotJudged(format!("{lambda} at {speed} m/s is known to {:e}", near.rounding));
        }
        if growth * side < 0.0 {
            return Verdict::Wrong(format!("{critical:?}, but {lambda} ± {:e} at {speed} m/s", near.rounding));
        }
    }
    Verdict::Right
}

/// Q(λ) at one speed as a full matrix.
struct Problem {
    /// The factors of λ², λ and 1, and the sizes of what they are sums of.
    parts: [DMatrix<f64>; 3],
    sizes: [DMatrix<f64>; 3],
}

/// How far λ is from the nearest eigenvalue to first order, yᵀ Q x/yᵀ Q′ x with Q's smallest vectors x and y, and how far
/// it may be since Q's entries have rounding: 8 n ε |y|ᵀ |Q| |x|/|yᵀ Q′ x|, |Q| the sum of the sizes of their terms.
struct Near {
    /// From the eigenvalue to λ.
    step: C64,
    distance: f64,
    rounding: f64,
}

impl Problem {
    fn new(drawn: &Drawn, speed: f64) -> Self {
        let parts = Parts::new(&drawn.robot, &drawn.local.statics, &drawn.local.rates);
        let parts =
            if drawn.referee.multiplicity == 2 { parts.one_direction().expect("equal problems") } else { parts };
        let Damping { alpha, beta } = parts.damping;
        let (mass, flow, elastic, dynamic) =
            (parts.mass, parts.flow * speed, parts.elastic, parts.dynamic * speed.powi(2));
        let size = DMatrix::abs;
        let sizes =
            [size(&mass), size(&flow) + size(&mass) * alpha + size(&elastic) * beta, size(&elastic) + size(&dynamic)];
        Self { sizes, parts: [mass.clone(), flow + mass * alpha + &elastic * beta, elastic + dynamic] }
    }

    /// Q, Q′ and |Q|, rows and columns scaled so that |Q| has ones on its diagonal.
    fn scaled(&self, lambda: C64) -> [DMatrix<C64>; 3] {
        let n = self.parts[0].nrows();
        let of = |parts: &[DMatrix<f64>; 3], l: [C64; 3]| {
            DMatrix::from_fn(n, n, |i, j| (0..3).map(|k| l[k] * parts[k][(i, j)]).sum::<C64>())
        };
        let (one, zero) = (C64::from(1.0), C64::from(0.0));
        let size = of(&self.sizes, [lambda.norm_sqr().into(), lambda.norm().into(), one]);
        let scale: Vec<f64> = (0..n).map(|i| size[(i, i)].re.sqrt()).collect();
        let value = of(&self.parts, [lambda * lambda, lambda, one]);
        let slope = of(&self.parts, [lambda * 2.0, one, zero]);
        [value, slope, size].map(|m| DMatrix::from_fn(n, n, |i, j| m[(i, j)] / (scale[i] * scale[j])))
    }

    fn near(&self, lambda: C64) -> Option<Near> {
        let [q, slope, size] = self.scaled(lambda);
        let n = q.nrows();
        let smallest = |q: &DMatrix<C64>| {
            // Without symmetry; an exactly singular Q is moved by its rounding.
            let mut x = DVector::from_fn(n, |i, _| C64::new(1.0, 0.5 + (i as f64 * 0.618_033_988_749_895).fract()));
            let moved = q + DMatrix::identity(n, n) * C64::from(f64::EPSILON);
            let (factors, spare) = (q.clone().lu(), moved.lu());
            for _ in 0..3 {
                let next = factors.solve(&x).filter(|x| x.iter().all(|c| c.norm().is_finite()));
                x = next.or_else(|| spare.solve(&x))?;
                x /= C64::from(x.camax());
            }
            Some(x)
        };
        let (x, y) = (smallest(&q)?, smallest(&q.transpose())?);
        let by_slope = y.dot(&(slope * &x));
        let sizes = |v: &DVector<C64>| v.map(|c| C64::from(c.norm()));
        let step = y.dot(&(q * &x)) / by_slope;
        let rounding = 8.0 * n as f64 * f64::EPSILON * (sizes(&y).dot(&(size * sizes(&x))) / by_slope).norm();
        let near = Near { step, distance: step.norm(), rounding };
        near.rounding.is_finite().then_some(near)
    }

    /// The eigenvalue near `lambda` by Newton's method: `None` where a step is not smaller than half the one before, unless it
    /// is rounding, for then it may have gone to another one.
    fn follow(&self, mut lambda: C64) -> Option<(C64, Near)> {
        let mut near = self.near(lambda)?;
        for _ in 0..6 {
            lambda -= near.step;
            let next = self.near(lambda)?;
            if next.distance > (0.5 * near.distance).max(next.rounding) {
                return None;
            }
            near = next;
        }
        Some((lambda, near))
    }

    /// tr Q⁻¹ Q′ = Σ 1/(z − λⱼ), and its rounding: n ε |Q⁻¹| |Q| |Q⁻¹| |Q′| at most.
    fn sum(&self, z: C64) -> Option<(C64, f64)> {
        let [q, slope, size] = self.scaled(z);
        let inverse = q.try_inverse()?;
        let sizes = |m: &DMatrix<C64>| m.map(C64::norm);
        let (a, b) = (sizes(&inverse), sizes(&size));
        let rounding = (&a * b * &a * sizes(&slope)).trace() * f64::EPSILON * 8.0;
        let sum = (inverse * slope).trace();
        (sum.norm().is_finite() && rounding.is_finite()).then_some((sum, rounding * a.nrows() as f64))
    }
}
