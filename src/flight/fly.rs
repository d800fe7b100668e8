//! The flight from the beginning of a trajectory to its end: steps in time, samples, and what is watched in between.

use super::equations::{Equations, Nodes, State, platform, plus};
use super::quasi_static::{Path, QuasiStatic};
use super::sdirk::{self, Stepped};
use super::watch::{Between, Watch};
use crate::flight::{CableSample, Flight, FlightError, FlightOptions, Sample};
use crate::robot::{Robot, Side, Trajectory, Vec2};
use crate::steps::{finish, step};

/// The first step in s.
const FIRST_STEP: f64 = 1e-3;
/// No step is longer, in s.
const LONGEST_STEP: f64 = 0.05;
/// The smallest step, as a part of the flight.
const SHORTEST_STEP: f64 = 1e-9;
/// The path is looked at in this many places before the flight.
const PLACES: usize = 256;
/// At most this many steps.
const MOST_STEPS: usize = 200_000;
/// Stages are solved to this part of the accuracy.
const NEWTON: f64 = 1e-3;
/// The error of the platform over the whole flight is about this times the largest error estimate of its steps. See
/// docs/theory.md section 14.
const ERROR_PER_STEP: f64 = 6.0;

/// How the steps are chosen.
#[derive(Clone, Copy, Debug)]
pub(super) enum Steps {
    /// By the estimated error.
    Adaptive,
    /// Of this many seconds, or a little less so that they end where they have to.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests measure the order of the method"))]
    Fixed(f64),
}

/// Flies `robot` along `trajectory`, from the quasi-static state at its beginning.
///
/// Integrates M r̈ + C ṙ + `K_dyn` r + `f_el`(r; L) = weights − D (ṙ − `ṙ_qs`) with D = αM + β`K_el` of the tangent at the
/// quasi-static shape (kg, m, s, N), all lengths as in the quasi-static motion, whatever the robot's linearisation.
/// docs/theory.md section 14.
///
/// # Errors
/// [`FlightError::Statics`] where the path leads to a pose without a taut equilibrium; [`FlightError::OutOfRange`] where it
/// cannot begin. A flight that could not go on is none: [`Flight::lost`] tells when that was.
pub fn fly(robot: &Robot, trajectory: &Trajectory, options: &FlightOptions) -> Result<Flight, FlightError> {
    finish(fly_in_steps(robot, trajectory, options))
}

/// The same, step by step in time.
///
/// # Errors
/// Those of [`fly`].
pub async fn fly_in_steps(
    robot: &Robot,
    trajectory: &Trajectory,
    options: &FlightOptions,
) -> Result<Flight, FlightError> {
    fly_watched(robot, trajectory, options, Steps::Adaptive, |_| {}).await
}

/// The same, which tells `watch` after each step which part of the time is flown, from 0 to 1.
///
/// # Errors
/// Those of [`fly`].
pub async fn fly_watched_in_steps(
    robot: &Robot,
    trajectory: &Trajectory,
    options: &FlightOptions,
    watch: impl Fn(f64),
) -> Result<Flight, FlightError> {
    fly_watched(robot, trajectory, options, Steps::Adaptive, watch).await
}

#[cfg(test)]
pub(super) async fn fly_by(
    robot: &Robot,
    trajectory: &Trajectory,
    options: &FlightOptions,
    steps: Steps,
) -> Result<Flight, FlightError> {
    fly_watched(robot, trajectory, options, steps, |_| {}).await
}

async fn fly_watched(
    robot: &Robot,
    trajectory: &Trajectory,
    options: &FlightOptions,
    steps: Steps,
    watch: impl Fn(f64),
) -> Result<Flight, FlightError> {
    let equations = Equations::new(robot);
    let mut flying = Flying::new(&equations, robot, trajectory, options)?;
    while flying.time < flying.end {
        if !flying.advance(steps)? {
            break;
        }
        watch(flying.time / flying.end);
        step().await;
    }
    Ok(flying.flight())
}

/// L and L̇ of every cable.
fn lengths(at: &QuasiStatic) -> Vec<[f64; 2]> {
    at.cables.iter().map(|cable| [cable.length[0], cable.length[1]]).collect()
}

/// A flight that goes on.
struct Flying<'a> {
    equations: &'a Equations,
    trajectory: &'a Trajectory,
    path: Path<'a>,
    options: &'a FlightOptions,
    /// Where a step has to end, in rising order: at breaks, at samples, and at the end.
    stops: Vec<f64>,
    duration: f64,
    end: f64,
    time: f64,
    state: State,
    accelerations: Nodes,
    /// L and L̇ of every cable.
    lengths: Vec<[f64; 2]>,
    /// What the estimate of the error asks for, in s.
    wanted: f64,
    taken: usize,
    lost: Option<f64>,
    watch: Watch,
    samples: Vec<Sample>,
}

impl<'a> Flying<'a> {
    fn new(
        equations: &'a Equations,
        robot: &'a Robot,
        trajectory: &'a Trajectory,
        options: &'a FlightOptions,
    ) -> Result<Self, FlightError> {
        let duration = trajectory.duration();
        let hold = if trajectory.is_rest_to_rest() { options.hold.max(0.0) } else { 0.0 };
        let end = duration + hold;
        let last = options.samples.max(2) - 1;
        let mut stops: Vec<f64> = (1..last).map(|i| end * i as f64 / last as f64).collect();
        stops.extend(trajectory.breaks());
        stops.extend([duration, end]);
        stops.sort_by(f64::total_cmp);
        // Two that are the same but for rounding are one.
        stops.dedup_by(|later, earlier| *later - *earlier < 1e-12 * end);
        if let Some(last) = stops.last_mut() {
            *last = end;
        }
        let mut path = Path::new(robot, trajectory);
        // A flight may be lost before it comes to where there is no equilibrium.
        path.check(duration, PLACES)?;
        let at = path.at(0.0, Side::Right)?;
        let mut state = equations.start(&at);
        let accelerations = plus(&state.velocities, -1.0, &state.velocities);
        if options.kick != Vec2::zeros() {
            let kicked = equations.at(&at).kicked(&state.positions, options.kick);
            state.velocities = plus(&state.velocities, 1.0, &kicked);
        }
        let mut flying = Self {
            equations,
            trajectory,
            path,
            options,
            stops,
            duration,
            end,
            time: 0.0,
            state,
            accelerations,
            lengths: lengths(&at),
            wanted: FIRST_STEP,
            taken: 0,
            lost: None,
            watch: Watch::new(duration),
            samples: Vec::with_capacity(last + 1),
        };
        flying.sample(0, &at);
        Ok(flying)
    }

    /// Takes one step; whether the flight can go on.
    fn advance(&mut self, steps: Steps) -> Result<bool, FlightError> {
        let stop = self.stops.iter().copied().find(|stop| *stop > self.time).unwrap_or(self.end);
        loop {
            let wanted = match steps {
                Steps::Adaptive => self.wanted.min(LONGEST_STEP),
                Steps::Fixed(h) => h,
            };
            if wanted < SHORTEST_STEP * self.end || self.taken >= MOST_STEPS {
                self.lost = Some(self.time);
                return Ok(false);
            }
            // Equal steps up to the next stop.
            let left = stop - self.time;
            let count = (left / wanted * (1.0 - 1e-9)).ceil().max(1.0);
            let h = left / count;
            let to = if count > 1.0 { self.time + h } else { stop };
            let mut quasi_static = Vec::with_capacity(3);
            for part in sdirk::TIMES {
                let time = if part < 1.0 { self.time + part * h } else { to };
                quasi_static.push(self.path.at(time, Side::Left)?);
            }
            let [first, second, third] = &quasi_static[..] else { return Ok(false) };
            let stages = [first, second, third].map(|at| self.equations.at(at));
            let tolerance = NEWTON * self.options.accuracy;
            let Some(next) = sdirk::step(&self.state, h, &stages, &self.accelerations, tolerance) else {
                if matches!(steps, Steps::Fixed(_)) {
                    self.lost = Some(self.time);
                    return Ok(false);
                }
                self.wanted = 0.25 * h;
                continue;
            };
            if matches!(steps, Steps::Adaptive) {
                let ratio = ERROR_PER_STEP * self.equations.size(&next.error, |i| third.cables[i].length[0])
                    / self.options.accuracy;
                self.wanted = h * (0.9 * ratio.cbrt().recip()).clamp(0.2, 2.0);
                if ratio > 1.0 {
                    continue;
                }
            }
            self.accept(to, next, third)?;
            return Ok(true);
        }
    }

    fn accept(&mut self, to: f64, next: Stepped, at: &QuasiStatic) -> Result<(), FlightError> {
        let lengths = lengths(at);
        let between =
            Between { times: [self.time, to], states: [&self.state, &next.state], lengths: [&self.lengths, &lengths] };
        self.watch.step(self.equations, self.trajectory, &between);
        self.lengths = lengths;
        self.time = to;
        self.state = next.state;
        self.accelerations = next.accelerations;
        self.taken += 1;
        let last = self.options.samples.max(2) - 1;
        let due = self.end * self.samples.len() as f64 / last as f64;
        if (self.time - due).abs() <= 1e-12 * self.end {
            // A break has the quasi-static motion that follows it.
            let at = self.path.at(self.time, Side::Right)?;
            self.sample(self.samples.len(), &at);
        }
        Ok(())
    }

    fn sample(&mut self, index: usize, at: &QuasiStatic) {
        let last = self.options.samples.max(2) - 1;
        let positions = &self.state.positions;
        let (platform, velocity) = (platform(positions), platform(&self.state.velocities));
        let n = self.equations.elements;
        let mut smallest = f64::INFINITY;
        let cables = at.cables.iter().enumerate().map(|(i, cable)| {
            let [length, rate, acceleration] = cable.length;
            let l = length / n as f64;
            let pulls: Vec<(f64, Vec2)> = self
                .equations
                .spans(i, positions)
                .map(|span| {
                    let force = self.equations.force(i, span, l);
                    (force, span * (force / span.norm()))
                })
                .collect();
            smallest = pulls.iter().fold(smallest, |least, (force, _)| least.min(*force));
            let half = Vec2::new(0.0, 0.5 * l * self.equations.cables[i].mass_per_length * self.equations.gravity);
            let (_, inner) = pulls.first().copied().unwrap_or_default();
            let (winch_element_force, outer) = pulls.last().copied().unwrap_or_default();
            let nodes = if self.options.nodes {
                let chain = &positions.chains[i];
                let all = std::iter::once(&platform).chain(chain).chain([&self.equations.cables[i].anchor]);
                #[expect(clippy::cast_possible_truncation, reason = "for a picture")]
                all.map(|node| [node.x as f32, node.y as f32]).collect()
            } else {
                Vec::new()
            };
            CableSample {
                length,
                rate,
                acceleration,
                tension: (inner - half).norm(),
                winch_tension: (outer + half).norm(),
                winch_element_force,
                nodes,
            }
        });
        let cables = cables.collect();
        let moment = at.moment;
        self.samples.push(Sample {
            time: self.end * index as f64 / last as f64,
            s: moment.s,
            v: moment.v,
            a: moment.a,
            position: moment.point.position,
            deviation: platform - moment.point.position,
            deviation_velocity: velocity - moment.velocity(),
            smallest_element_force: smallest,
            cables,
        });
    }

    fn flight(self) -> Flight {
        let Self { duration, end, taken, lost, watch, samples, .. } = self;
        let residual = (end > duration).then_some(watch.residual);
        Flight {
            duration,
            end,
            max_deviation: watch.max_deviation,
            residual,
            slack: watch.slack,
            lost,
            steps: taken,
            samples,
        }
    }
}
