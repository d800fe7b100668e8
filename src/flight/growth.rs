//! What a move does to small vibrations: how many times larger any of them can be after it.
//!
//! Along the quasi-static motion small vibrations obey M q̈ + (C + αM + βK) q̇ + (K + `K_dyn`) q = 0 with matrices that change in
//! time, L̈ with all of s̈ in it. Every mode of (K, M) at the beginning is carried to the end, and what comes of it is measured
//! in the modes there: an amplitude ratio. docs/theory.md, growth along a path.

use nalgebra::{Const, DMatrix, DVector, Dyn, OMatrix, SMatrix, SVector, SymmetricEigen};

use super::quasi_static::{Path, QuasiStatic};
use super::sdirk::{GAMMA, STAGES, TIMES};
use crate::flight::{FlightError, Gain};
use crate::mechanics::{Arrow, ArrowVector, Blocks, CableMotion, Element, Material, Stiffness};
use crate::robot::{Linearisation, Robot, Side, Trajectory};
use crate::steps::{finish, step};

/// A move is cut into this many steps at first.
const FIRST_STEPS: usize = 64;
/// Steps are halved until the gains change by less than this part. The method is of order 3, so a seventh of it is left.
const CHANGE: f64 = 3e-4;
/// At most so many times.
const HALVINGS: usize = 10;
/// Modes are enough where twice as many change the gains by less than this part.
const ENOUGH: f64 = 0.01;

/// A vector over the platform and the inner nodes of all cables.
type Nodes<const N: usize> = ArrowVector<f64, N>;

/// How many times larger a vibration of `robot` can be after the move along `trajectory`, from its beginning to its end: the
/// largest singular values of W₁ Φ W₀⁻¹, with W of the modes of (K, M) at both ends.
///
/// Vibrations begin in all modes, or in the lowest `modes` of them, and are measured in all. `None` where K is not positive
/// definite at an end. The robot's linearisation counts: with the secant stiffness x and y are two equal problems. Steps are
/// halved until the gains stay; SDIRK of order 3, one elimination for all vibrations per stage.
///
/// # Errors
/// [`FlightError::Statics`] where the path leads to a pose without a taut equilibrium; [`FlightError::OutOfRange`] where the
/// numbers leave the range of floating point.
pub fn gain(robot: &Robot, trajectory: &Trajectory, modes: Option<usize>) -> Result<Option<Gain>, FlightError> {
    finish(gain_in_steps(robot, trajectory, modes))
}

/// The same, step by step in time.
///
/// # Errors
/// Those of [`gain`].
pub async fn gain_in_steps(
    robot: &Robot,
    trajectory: &Trajectory,
    modes: Option<usize>,
) -> Result<Option<Gain>, FlightError> {
    match robot.linearisation {
        Linearisation::Secant => {
            Growth::<1>::new(robot, trajectory, |e| SMatrix::from_element(e.springs()[1])).gain(modes).await
        }
        Linearisation::Tangent => Growth::<2>::new(robot, trajectory, Element::elastic).gain(modes).await,
    }
}

/// The gain from so few of the lowest modes that twice as many change it by less than a hundredth, and how many these are.
///
/// # Errors
/// Those of [`gain`].
pub async fn gain_of_few_modes_in_steps(
    robot: &Robot,
    trajectory: &Trajectory,
) -> Result<Option<(Gain, usize)>, FlightError> {
    let all = robot.cables.len() * robot.elements * 2;
    let mut modes = 8;
    let Some(mut before) = gain_in_steps(robot, trajectory, Some(modes)).await? else { return Ok(None) };
    while modes < all {
        modes *= 2;
        let Some(more) = gain_in_steps(robot, trajectory, Some(modes)).await? else { return Ok(None) };
        let enough = change(before, more) < ENOUGH;
        before = more;
        if enough {
            break;
        }
    }
    Ok(Some((before, modes)))
}

/// The largest change of a gain, as a part of it.
fn change(before: Gain, after: Gain) -> f64 {
    let part = |before: f64, after: f64| (before / after - 1.0).abs();
    let parts = [
        part(before.action, after.action),
        part(before.energy, after.energy),
        part(before.displacement, after.displacement),
    ];
    parts.into_iter().fold(0.0, f64::max)
}

/// The modes of (K, M) at one end.
struct Modes<const N: usize> {
    /// ω in rad/s, in rising order.
    frequencies: Vec<f64>,
    /// One column per mode, with Vᵀ M V = 1.
    shapes: DMatrix<f64>,
    /// Vᵀ M.
    measure: DMatrix<f64>,
}

/// A small vibration: displacements and velocities.
#[derive(Clone)]
struct Vibrating<const N: usize> {
    q: Nodes<N>,
    v: Nodes<N>,
}

/// The growth along a trajectory in N directions.
struct Growth<'a, const N: usize> {
    robot: &'a Robot,
    trajectory: &'a Trajectory,
    /// A/l of an element in these directions.
    elastic: fn(&Element) -> SMatrix<f64, N, N>,
}

impl<'a, const N: usize> Growth<'a, N> {
    fn new(robot: &'a Robot, trajectory: &'a Trajectory, elastic: fn(&Element) -> SMatrix<f64, N, N>) -> Self {
        Self { robot, trajectory, elastic }
    }

    async fn gain(&self, modes: Option<usize>) -> Result<Option<Gain>, FlightError> {
        let mut path = Path::new(self.robot, self.trajectory);
        let start = self.elements(&path.at(0.0, Side::Right)?);
        let Some(first) = self.modes(&start) else { return Ok(None) };
        let mut before: Option<Gain> = None;
        let mut steps = FIRST_STEPS;
        for _ in 0..=HALVINGS {
            let mut vibrations = self.initial(&first, modes);
            let mut path = Path::new(self.robot, self.trajectory);
            path.at(0.0, Side::Right)?;
            for [from, to] in self.intervals(steps) {
                self.advance(&mut path, from, to - from, &mut vibrations)?;
                step().await;
            }
            let duration = self.trajectory.duration();
            let end = self.elements(&path.at(duration, Side::Left)?);
            let Some(last) = self.modes(&end) else { return Ok(None) };
            let Some(gain) = measured(&first, &last, &vibrations) else {
                return Err(FlightError::OutOfRange { time: duration });
            };
            if before.is_some_and(|before| change(before, gain) < CHANGE) {
                return Ok(Some(gain));
            }
            before = Some(gain);
            steps *= 2;
        }
        Ok(before)
    }

    /// The move in about so many steps, which end at the breaks of the acceleration.
    fn intervals(&self, steps: usize) -> Vec<[f64; 2]> {
        let duration = self.trajectory.duration();
        let mut stops = vec![0.0];
        stops.extend(self.trajectory.breaks());
        stops.push(duration);
        let cut = |pair: &[f64]| -> Vec<[f64; 2]> {
            let (from, length) = (pair[0], pair[1] - pair[0]);
            let mut parts = 1;
            while length / parts as f64 > duration / steps as f64 {
                parts += 1;
            }
            let at = |k: usize| from + length * k as f64 / parts as f64;
            (0..parts).map(|k| [at(k), if k + 1 == parts { pair[1] } else { at(k + 1) }]).collect()
        };
        stops.windows(2).flat_map(cut).collect()
    }

    /// All elements at one time, whose speed is already in them.
    fn elements(&self, at: &QuasiStatic) -> Vec<Vec<Element>> {
        let n = self.robot.elements as f64;
        let of_cable = |(i, cable): (usize, &CableMotion)| {
            let (mu, material) = (self.robot.material_of(i).mass_per_length, Material::of(self.robot, i));
            let [length, rate, acceleration] = cable.length;
            let of_element = |(k, &force): (usize, &crate::robot::Vec2)| {
                let inflow = |derivative: f64| [derivative * -(k as f64) / n, derivative * -((k + 1) as f64) / n];
                let stiffness = Stiffness::new(material, self.robot.linearisation, force);
                Element::at_rest(mu, length / n, stiffness).with_inflow(inflow(rate), inflow(acceleration))
            };
            cable.forces.iter().enumerate().map(of_element).collect()
        };
        at.cables.iter().enumerate().map(of_cable).collect()
    }

    /// Where a node is in a stacked vector: the platform first, then the inner nodes of each cable.
    fn place(&self, cable: usize, node: usize) -> Option<usize> {
        let inner = self.robot.elements - 1;
        match node {
            0 => Some(0),
            node if node > inner => None,
            node => Some(N * (1 + cable * inner + node - 1)),
        }
    }

    /// The modes of (K, M); `None` where K is not positive definite.
    fn modes(&self, elements: &[Vec<Element>]) -> Option<Modes<N>> {
        let size = N * (1 + elements.len() * (self.robot.elements - 1));
        let (mut mass, mut stiffness) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
        for i in 0..N {
            mass[(i, i)] = self.robot.platform_mass;
        }
        for (cable, elements) in elements.iter().enumerate() {
            for (k, element) in elements.iter().enumerate() {
                let (of_mass, elastic) = (element.mass(), (self.elastic)(element));
                for (i, row) in [k, k + 1].into_iter().enumerate() {
                    for (j, column) in [k, k + 1].into_iter().enumerate() {
                        let (Some(row), Some(column)) = (self.place(cable, row), self.place(cable, column)) else {
                            continue;
                        };
                        let sign = if i == j { 1.0 } else { -1.0 };
                        let add = |matrix: &mut DMatrix<f64>, block: SMatrix<f64, N, N>| {
                            let mut view = matrix.view_mut((row, column), (N, N));
                            view += block;
                        };
                        add(&mut mass, SMatrix::from_diagonal_element(of_mass[(i, j)]));
                        add(&mut stiffness, elastic * sign);
                    }
                }
            }
        }
        // K v = ω² M v with M = L Lᵀ: L⁻¹ K L⁻ᵀ w = ω² w, v = L⁻ᵀ w.
        let lower = mass.clone().cholesky()?.unpack();
        let half = lower.solve_lower_triangular(&stiffness)?;
        let reduced = lower.solve_lower_triangular(&half.transpose())?;
        let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(0.5 * (&reduced + reduced.transpose()));
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by(|a, b| eigenvalues[*a].total_cmp(&eigenvalues[*b]));
        let sorted = DMatrix::from_columns(&order.iter().map(|&i| eigenvectors.column(i)).collect::<Vec<_>>());
        let shapes = lower.tr_solve_lower_triangular(&sorted)?;
        let frequencies: Vec<f64> = order.iter().map(|&i| eigenvalues[i].sqrt()).collect();
        let positive = frequencies.iter().all(|frequency| *frequency > 0.0);
        positive.then(|| Modes { frequencies, measure: shapes.tr_mul(&mass), shapes })
    }

    /// Each mode with a displacement of 1 and at rest, then each with a velocity of 1.
    fn initial(&self, modes: &Modes<N>, count: Option<usize>) -> Vec<Vibrating<N>> {
        let count = count.map_or(modes.frequencies.len(), |count| count.clamp(1, modes.frequencies.len()));
        let zero = self.unstacked(&DVector::zeros(modes.shapes.nrows()));
        let shape = |mode: usize| self.unstacked(&modes.shapes.column(mode).into_owned());
        let displaced = (0..count).map(|mode| Vibrating { q: shape(mode), v: zero.clone() });
        let moving = (0..count).map(|mode| Vibrating { q: zero.clone(), v: shape(mode) });
        displaced.chain(moving).collect()
    }

    fn unstacked(&self, stacked: &DVector<f64>) -> Nodes<N> {
        let at = |place: usize| SVector::<f64, N>::from_fn(|i, _| stacked[place + i]);
        let chain =
            |cable: usize| (1..self.robot.elements).filter_map(|node| self.place(cable, node)).map(at).collect();
        Nodes { hub: DVector::from_fn(N, |i, _| stacked[i]), chains: (0..self.robot.cables.len()).map(chain).collect() }
    }

    /// Carries all vibrations from time `from` through a step of `h` seconds.
    fn advance(&self, path: &mut Path, from: f64, h: f64, vibrations: &mut [Vibrating<N>]) -> Result<(), FlightError> {
        let g = GAMMA * h;
        let mut stages = Vec::with_capacity(TIMES.len());
        for part in TIMES {
            // The end of the step has what has been, since its acceleration may jump there.
            let elements = self.elements(&path.at(from + part * h, Side::Left)?);
            stages.push(Stage::new(self, &elements, g));
        }
        for vibration in vibrations {
            // What stands at each stage before its own q̈ is added.
            let mut bases = [vibration.clone(), vibration.clone(), vibration.clone()];
            for (i, stage) in stages.iter().enumerate() {
                let base = &mut bases[i];
                // q = base + g q̇, q̇ = base + g q̈.
                add(&mut base.q, g, &base.v.clone());
                let acceleration = stage.arrow.solve(&stage.load(base));
                add(&mut base.q, g * g, &acceleration);
                add(&mut base.v, g, &acceleration);
                let done = base.clone();
                for (j, later) in bases.iter_mut().enumerate().skip(i + 1) {
                    add(&mut later.q, h * STAGES[j][i], &done.v);
                    add(&mut later.v, h * STAGES[j][i], &acceleration);
                }
            }
            // The last stage is the end of the step.
            let [_, _, end] = bases;
            *vibration = end;
        }
        Ok(())
    }
}

/// The equations at one stage, eliminated.
struct Stage<const N: usize> {
    /// C + αM + βK and K + `K_dyn` of each element.
    chains: Vec<Vec<[Blocks<f64, N>; 2]>>,
    /// α m.
    hub: f64,
    /// M + g (C + αM + βK) + g² (K + `K_dyn`).
    arrow: Arrow<f64, N>,
}

impl<const N: usize> Stage<N> {
    fn new(growth: &Growth<'_, N>, elements: &[Vec<Element>], g: f64) -> Self {
        let (alpha, beta) = (growth.robot.damping.alpha, growth.robot.damping.beta);
        let of_element = |element: &Element| -> [Blocks<f64, N>; 2] {
            let (mass, transfer, flow) = (element.mass(), element.transfer(), element.flow_stiffness());
            let elastic = (growth.elastic)(element);
            let blocks = |scalar: &dyn Fn(usize, usize) -> f64, part: f64| {
                [0, 1].map(|i| {
                    [0, 1].map(|j| {
                        let sign = if i == j { part } else { -part };
                        SMatrix::from_diagonal_element(scalar(i, j)) + elastic * sign
                    })
                })
            };
            [blocks(&|i, j| transfer[(i, j)] + alpha * mass[(i, j)], beta), blocks(&|i, j| flow[(i, j)], 1.0)]
        };
        let chains: Vec<Vec<[Blocks<f64, N>; 2]>> =
            elements.iter().map(|chain| chain.iter().map(of_element).collect()).collect();
        let mass = growth.robot.platform_mass;
        let hub = DMatrix::from_diagonal_element(N, N, mass * (1.0 + g * alpha));
        let joint = OMatrix::<f64, Const<N>, Dyn>::identity_generic(Const, Dyn(N));
        // Each element with its matrices, so that it is made of them once.
        let pairs: Vec<Vec<_>> =
            elements.iter().zip(&chains).map(|(elements, blocks)| elements.iter().zip(blocks).collect()).collect();
        let arrow = Arrow::factor(
            hub,
            pairs.iter().map(|pairs| (pairs.as_slice(), joint.clone())),
            |(element, [c, k]): &(&Element, &[Blocks<f64, N>; 2])| {
                let of_mass = element.mass();
                [0, 1].map(|i| {
                    [0, 1].map(|j| SMatrix::from_diagonal_element(of_mass[(i, j)]) + c[i][j] * g + k[i][j] * (g * g))
                })
            },
        );
        Self { chains, hub: alpha * mass, arrow }
    }

    /// −(C + αM + βK) v − (K + `K_dyn`) q.
    fn load(&self, at: &Vibrating<N>) -> Nodes<N> {
        let mut load = at.q.clone();
        let platform = |nodes: &Nodes<N>| SVector::<f64, N>::from_fn(|i, _| nodes.hub[i]);
        let (hub_q, hub_v) = (platform(&at.q), platform(&at.v));
        let mut on_hub = hub_v * -self.hub;
        for (i, chain) in self.chains.iter().enumerate() {
            let (q, v) = (&at.q.chains[i], &at.v.chains[i]);
            let load = &mut load.chains[i];
            let (mut q0, mut v0) = (hub_q, hub_v);
            let mut carried = SVector::<f64, N>::zeros();
            for (k, [c, stiffness]) in chain.iter().enumerate() {
                let q1 = q.get(k).copied().unwrap_or_else(SVector::zeros);
                let v1 = v.get(k).copied().unwrap_or_else(SVector::zeros);
                let force =
                    |row: usize| c[row][0] * v0 + c[row][1] * v1 + stiffness[row][0] * q0 + stiffness[row][1] * q1;
                let inner = carried - force(0);
                match k {
                    0 => on_hub += inner,
                    k => load[k - 1] = inner,
                }
                carried = -force(1);
                (q0, v0) = (q1, v1);
            }
        }
        load.hub = DVector::from_column_slice(on_hub.as_slice());
        load
    }
}

/// Adds factor y to x.
fn add<const N: usize>(x: &mut Nodes<N>, factor: f64, y: &Nodes<N>) {
    x.hub.axpy(factor, &y.hub, 1.0);
    for (x, y) in x.chains.iter_mut().flatten().zip(y.chains.iter().flatten()) {
        *x += y * factor;
    }
}

/// The largest singular values of W₁ Φ W₀⁻¹, given what has become of the lowest modes; `None` where they are not finite.
fn measured<const N: usize>(first: &Modes<N>, last: &Modes<N>, vibrations: &[Vibrating<N>]) -> Option<Gain> {
    let stacked = |nodes: &Nodes<N>| {
        let inner = nodes.chains.iter().flatten().flat_map(|node| node.iter());
        DVector::from_iterator(last.measure.ncols(), nodes.hub.iter().chain(inner).copied())
    };
    let columns = |of: fn(&Vibrating<N>) -> &Nodes<N>| {
        let columns: Vec<DVector<f64>> = vibrations.iter().map(|vibration| stacked(of(vibration))).collect();
        &last.measure * DMatrix::from_columns(&columns)
    };
    let (eta, rate) = (columns(|vibration| &vibration.q), columns(|vibration| &vibration.v));
    let (rows, count) = (last.frequencies.len(), vibrations.len() / 2);
    // W = diag(a, b) of η and η̇ for each power of ω in a; b has one power less.
    let largest = |power: f64| {
        let weighted = DMatrix::from_fn(2 * rows, 2 * count, |i, j| {
            let (mode, of_rate) = (i % rows, i >= rows);
            let value = if of_rate { rate[(mode, j)] } else { eta[(mode, j)] };
            let to = last.frequencies[mode].powf(power - if of_rate { 1.0 } else { 0.0 });
            let from = first.frequencies[j % count].powf(power - if j >= count { 1.0 } else { 0.0 });
            value * to / from
        });
        let finite = weighted.iter().all(|value| value.is_finite());
        finite.then(|| SymmetricEigen::new(weighted.tr_mul(&weighted)).eigenvalues.max().max(0.0).sqrt())
    };
    Some(Gain { action: largest(0.5)?, energy: largest(1.0)?, displacement: largest(0.0)? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Profile, RobotSpec, Vec2, paper_spec};

    fn across(linearisation: Linearisation, profile: Profile) -> Gain {
        let robot = Robot::new(RobotSpec { linearisation, ..paper_spec() }).expect("a robot");
        let trajectory = Trajectory::straight(Vec2::new(-6.0, 0.0), &[Vec2::new(6.0, 0.0)], profile).expect("a path");
        gain(&robot, &trajectory, None).expect("a path").expect("modes")
    }

    /// By an independent dense propagation, to its last digit.
    #[test]
    fn the_paper_robot_at_constant_speed() {
        for (speed, energy, action) in [(5.0, 0.829, 0.630), (11.0, 1.660, 1.221)] {
            let found = across(Linearisation::Secant, Profile::Constant { speed });
            assert!((found.energy - energy).abs() < 6e-4 && (found.action - action).abs() < 6e-4, "{speed}: {found:?}");
        }
    }

    #[test]
    fn the_paper_robot_from_rest_to_rest() {
        let found = across(Linearisation::Secant, Profile::Quintic { speed: 5.0 });
        for (found, expected) in
            [(found.energy, 0.414_148_722), (found.action, 0.353_986_141), (found.displacement, 0.418_077_567)]
        {
            assert!((found - expected).abs() < 1e-4 * expected, "{found} {expected}");
        }
    }
}
