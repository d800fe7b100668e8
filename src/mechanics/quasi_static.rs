//! The quasi-static motion followed from place to place: the statics with their rates, many times faster than from nothing.
//!
//! Every place is solved by Newton's method from where the motion known last leads to. Of each cable the unknowns are its
//! force P on the platform and its length L. With Y = ∂r/∂P and b = ∂r/∂L for its end r, P follows from L, so that
//! no matrix is larger than the platform's: δP = −Y⁻¹ (miss) − G δL, G = Y⁻¹ b. The taut branch is the one where P̂ · G > 0
//! for the prescribed cables, and det [G] has the sign of the straight cables' for those at equilibrium. Where that cannot
//! be had, [`solve`] decides. docs/theory.md sections 5 and 14.

use nalgebra::Matrix2;
use num_dual::Dual2;

use super::cable::{CableModel, prescribed_tension};
use super::statics::{AT_ANCHOR, straight_tensions};
use crate::mechanics::{StaticsError, solve};
use crate::robot::{Robot, TensionLaw, Vec2};

/// Newton's method is given up after this many iterations. It needs one or two.
const ITERATIONS: usize = 8;
/// The last change of the unknowns, as a part of them: the error that is left is about its square.
const SOLVED: f64 = 1e-9;

/// A cable at one time of the quasi-static motion.
#[derive(Clone, Debug, PartialEq)]
pub struct CableMotion {
    /// L in m, L̇ in m/s and L̈ in m/s².
    pub length: [f64; 3],
    /// The force of the cable on the platform in N.
    pub pull: Vec2,
    /// The force of each element from the platform to the winch, in N.
    pub forces: Vec<Vec2>,
    /// The n + 1 nodes from the platform to the winch, in m.
    pub nodes: Vec<Vec2>,
    /// Their velocities in m/s.
    pub velocities: Vec<Vec2>,
}

/// Follows the quasi-static motion of a robot.
#[derive(Clone, Debug)]
pub struct Follower<'a> {
    robot: &'a Robot,
    models: Vec<CableModel<f64>>,
    last: Option<(f64, Vec<Unknowns>)>,
}

/// P in N and L in m of a cable, and their first and second derivatives in time.
type Unknowns = [(Vec2, f64); 3];

/// P and L of all cables, and how their ends answer these.
type Shapes = (Vec<(Vec2, f64)>, Vec<Answer>);

/// How a cable's end answers its unknowns.
#[derive(Clone, Copy)]
struct Answer {
    /// Where it is less the anchor, in m.
    miss: Vec2,
    /// Y⁻¹ in N/m.
    inverse: Matrix2<f64>,
    /// G in N/m.
    pull: Vec2,
}

impl<'a> Follower<'a> {
    /// Of the motion nothing is known yet.
    pub fn new(robot: &'a Robot) -> Self {
        let models = (0..robot.cables.len()).map(|i| CableModel::of(robot, i)).collect();
        Self { robot, models, last: None }
    }

    /// The motion at a `time` (s) when the platform is at `position` (m), with its `velocity` (m/s) and `acceleration`
    /// (m/s²): one per cable. To rounding it is the same whatever was asked for before.
    ///
    /// # Errors
    /// Those of [`solve`], and [`StaticsError::OutOfRange`] where the pose is singular.
    pub fn at(
        &mut self,
        time: f64,
        position: Vec2,
        velocity: Vec2,
        acceleration: Vec2,
    ) -> Result<Vec<CableMotion>, StaticsError> {
        let extrapolated = self.last.take().and_then(|(known, unknowns)| {
            let ahead = time - known;
            let taylor = |[(p, l), (p1, l1), (p2, l2)]: Unknowns| {
                let half = 0.5 * ahead * ahead;
                (p + p1 * ahead + p2 * half, l + l1 * ahead + l2 * half)
            };
            self.newton(position, unknowns.into_iter().map(taylor).collect())
        });
        let (unknowns, answers) = match extrapolated {
            Some(found) => found,
            None => self.anew(position)?,
        };
        let out_of_range = StaticsError::OutOfRange;
        let (rates, motion) = self.rates(&unknowns, &answers, position, velocity, acceleration).ok_or(out_of_range)?;
        self.last = Some((time, rates));
        Ok(motion)
    }

    fn anew(&self, position: Vec2) -> Result<Shapes, StaticsError> {
        let statics = solve(self.robot, position).map_err(|failure| failure.reason)?;
        let pull = |(model, shape): (&CableModel<f64>, &crate::mechanics::CableShape)| {
            (Vec2::from(model.platform_force(shape.t0.into(), shape.length)), shape.length)
        };
        let unknowns: Vec<_> = self.models.iter().zip(&statics.cables).map(pull).collect();
        let answers = self.answers(position, &unknowns).ok_or(StaticsError::OutOfRange)?;
        Ok((unknowns, answers))
    }

    fn answers(&self, position: Vec2, unknowns: &[(Vec2, f64)]) -> Option<Vec<Answer>> {
        let answer = |(model, &(pull, length)): (&CableModel<f64>, &(Vec2, f64))| model.answer(position, pull, length);
        self.models.iter().zip(unknowns).map(answer).collect()
    }

    /// The taut shapes near `unknowns`.
    fn newton(&self, position: Vec2, mut unknowns: Vec<(Vec2, f64)>) -> Option<Shapes> {
        let robot = self.robot;
        let tensions: Vec<f64> =
            robot.cables.iter().map(|cable| prescribed_tension(cable.tension, position.into())).collect();
        if robot.prescribed().any(|i| !(tensions[i] > 0.0 && tensions[i].is_finite())) {
            return None;
        }
        let weight = Vec2::new(0.0, robot.platform_mass * robot.gravity);
        let mut answers = self.answers(position, &unknowns)?;
        for _ in 0..ITERATIONS {
            let misses: Vec<Vec2> = answers.iter().map(|answer| answer.miss).collect();
            let excess: Vec<f64> = unknowns.iter().zip(&tensions).map(|((p, _), tension)| p.norm() - tension).collect();
            let force = unknowns.iter().map(|(p, _)| p).sum::<Vec2>() - weight;
            let changes = self.changes(&unknowns, &answers, &misses, &excess, force)?;
            let mut size = 0.0_f64;
            for ((p, l), (dp, dl)) in unknowns.iter_mut().zip(&changes) {
                size = size.max(dp.norm() / p.norm()).max((dl / *l).abs());
                *p += dp;
                *l += dl;
            }
            answers = self.answers(position, &unknowns)?;
            if size < SOLVED {
                return self.is_taut(position, &unknowns, &answers).then_some((unknowns, answers));
            }
        }
        None
    }

    /// What the unknowns have to change by so that each end moves by −`misses`, each prescribed |P| changes by −`excess`,
    /// and the sum of all P by −`force`.
    fn changes(
        &self,
        unknowns: &[(Vec2, f64)],
        answers: &[Answer],
        misses: &[Vec2],
        excess: &[f64],
        force: Vec2,
    ) -> Option<Vec<(Vec2, f64)>> {
        let mut changes = vec![(Vec2::zeros(), 0.0); answers.len()];
        let mut force = force;
        for i in self.robot.prescribed() {
            let Answer { inverse, pull, .. } = answers[i];
            let (direction, moved) = (unknowns[i].0.normalize(), inverse * misses[i]);
            let length = (excess[i] - direction.dot(&moved)) / direction.dot(&pull);
            changes[i] = (-moved - pull * length, length);
            force += changes[i].0;
        }
        let &[a, b] = self.robot.equilibrium() else { return None };
        let moved = [a, b].map(|i| answers[i].inverse * misses[i]);
        let lengths =
            Matrix2::from_columns(&[answers[a].pull, answers[b].pull]).try_inverse()? * (force - moved[0] - moved[1]);
        for (i, moved, length) in [(a, moved[0], lengths.x), (b, moved[1], lengths.y)] {
            changes[i] = (-moved - answers[i].pull * length, length);
        }
        changes.iter().all(|(p, l)| p.sum().is_finite() && l.is_finite()).then_some(changes)
    }

    /// Whether the shapes are those that grow out of straight, weightless cables.
    fn is_taut(&self, position: Vec2, unknowns: &[(Vec2, f64)], answers: &[Answer]) -> bool {
        let robot = self.robot;
        let chords: Vec<Vec2> = robot.cables.iter().map(|cable| cable.anchor - position).collect();
        let &[a, b] = robot.equilibrium() else { return false };
        let directions = [a, b].map(|i| chords[i].normalize());
        let weight = Vec2::new(0.0, robot.platform_mass * robot.gravity);
        let load = robot.prescribed().fold(weight, |load, i| load - unknowns[i].0);
        let turned = answers[a].pull.perp(&answers[b].pull) * directions[0].perp(&directions[1]);
        chords.iter().all(|chord| chord.norm() >= AT_ANCHOR)
            && unknowns.iter().all(|(_, length)| *length > 0.0)
            && robot.prescribed().all(|i| unknowns[i].0.dot(&answers[i].pull) > 0.0)
            && turned > 0.0
            && straight_tensions(robot, &directions, load).is_ok()
    }

    /// The unknowns with their derivatives, and all that moves.
    fn rates(
        &self,
        unknowns: &[(Vec2, f64)],
        answers: &[Answer],
        position: Vec2,
        velocity: Vec2,
        acceleration: Vec2,
    ) -> Option<(Vec<Unknowns>, Vec<CableMotion>)> {
        let along = [0, 1].map(|j| Dual2::new(position[j], velocity[j], acceleration[j]));
        let tension = |law: TensionLaw| prescribed_tension(law, along);
        let tensions: Vec<Dual2<f64>> = self.robot.cables.iter().map(|cable| tension(cable.tension)).collect();
        let excess: Vec<f64> = tensions.iter().map(|tension| -tension.v1).collect();
        let still = Vec2::zeros();
        let first = self.changes(unknowns, answers, &vec![velocity; answers.len()], &excess, still)?;
        let (mut misses, mut excess, mut motion) = (Vec::new(), Vec::new(), Vec::new());
        for (i, model) in self.models.iter().enumerate() {
            let ((p, _), (p1, _)) = (unknowns[i], first[i]);
            let (moving, curvature) = model.moving([unknowns[i], first[i]], position, velocity);
            motion.push(moving);
            misses.push(curvature + acceleration);
            let across = p1.norm_squared() - p1.dot(&p).powi(2) / p.norm_squared();
            excess.push(across / p.norm() - tensions[i].v2);
        }
        let second = self.changes(unknowns, answers, &misses, &excess, still)?;
        for (cable, (_, acceleration)) in motion.iter_mut().zip(&second) {
            cable.length[2] = *acceleration;
        }
        let all = unknowns.iter().zip(first).zip(second).map(|((&z, z1), z2)| [z, z1, z2]).collect();
        Some((all, motion))
    }
}

impl CableModel<f64> {
    /// The force of each element for P and L, with (k + ½) μ g/n.
    fn forces(&self, pull: Vec2, length: f64) -> impl Iterator<Item = (Vec2, f64)> {
        let n = self.elements;
        let part = self.weight / n as f64;
        (0..n).map(move |k| {
            let weight = part * (k as f64 + 0.5);
            (Vec2::new(pull.x, pull.y + weight * length), weight)
        })
    }

    /// How the end of the cable answers P and L; `None` where that leaves floating point.
    fn answer(&self, position: Vec2, pull: Vec2, length: f64) -> Option<Answer> {
        let n = self.elements as f64;
        let l = length / n;
        let (mut end, mut compliance, mut by_length) = (Vec2::zeros(), Matrix2::zeros(), Vec2::zeros());
        for (t, weight) in self.forces(pull, length) {
            let force = t.norm();
            let stretch = self.material.stretch(force);
            let e = t / force;
            // Y_k = l [(λ/|t|) (I − e eᵀ) + e eᵀ/N'].
            let across = l * stretch / force;
            let along = l / self.material.tangent(stretch);
            let own = Matrix2::from_diagonal_element(across) + e * e.transpose() * (along - across);
            end += e * (l * stretch);
            by_length += e * (stretch / n) + own.column(1) * weight;
            compliance += own;
        }
        let inverse = compliance.try_inverse()?;
        let answer = Answer { miss: end + (position - self.anchor), inverse, pull: inverse * by_length };
        (answer.miss.sum() + answer.pull.sum()).is_finite().then_some(answer)
    }

    /// All of the cable for P and L with their first derivatives, L̈ left out; and the end's second derivative as far as it
    /// comes from the first ones.
    fn moving(
        &self,
        [(pull, length), (pull_rate, rate)]: [(Vec2, f64); 2],
        position: Vec2,
        velocity: Vec2,
    ) -> (CableMotion, Vec2) {
        let n = self.elements as f64;
        let (l, l1) = (length / n, rate / n);
        let with = |first: Vec2| {
            let mut nodes = Vec::with_capacity(self.elements + 1);
            nodes.push(first);
            nodes
        };
        let (mut nodes, mut velocities) = (with(position), with(velocity));
        let mut forces = Vec::with_capacity(self.elements);
        let (mut r, mut r1, mut r2) = (position, velocity, Vec2::zeros());
        for (t, weight) in self.forces(pull, length) {
            let t1 = Vec2::new(pull_rate.x, pull_rate.y + weight * rate);
            let force = t.norm();
            let e = t / force;
            // |t| and its derivatives, those of λ by N(λ) = |t|, and those of e by |t| e = t.
            let force1 = e.dot(&t1);
            let force2 = (t1.norm_squared() - force1 * force1) / force;
            let stretch = self.material.stretch(force);
            let tangent = self.material.tangent(stretch);
            let stretch1 = force1 / tangent;
            let stretch2 = (force2 - self.material.curvature(stretch) * stretch1 * stretch1) / tangent;
            let e1 = (t1 - e * force1) / force;
            let e2 = -(e1 * (2.0 * force1) + e * force2) / force;
            // λ e and its derivatives.
            let d = e * stretch;
            let d1 = e * stretch1 + e1 * stretch;
            let d2 = e * stretch2 + e1 * (2.0 * stretch1) + e2 * stretch;
            r += d * l;
            r1 += d * l1 + d1 * l;
            r2 += d1 * (2.0 * l1) + d2 * l;
            forces.push(t);
            nodes.push(r);
            velocities.push(r1);
        }
        (CableMotion { length: [length, rate, 0.0], pull, forces, nodes, velocities }, r2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{length_rates_on, node_rates};
    use crate::robot::{OwnMaterial, RobotSpec, Strain, paper_spec};

    fn robots() -> Vec<Robot> {
        let mut mixed = paper_spec();
        mixed.cables[1].own = OwnMaterial { strain: Some(Strain::Engineering), ..OwnMaterial::default() };
        mixed.cables[2].own = OwnMaterial { mass_per_length: Some(0.25), ..OwnMaterial::default() };
        let mut lower = paper_spec();
        lower.cables.swap(0, 2);
        lower.cables.swap(1, 3);
        lower.gravity = 0.0;
        let soft = RobotSpec { elements: 3, ..paper_spec() };
        [paper_spec(), mixed, lower, soft].into_iter().map(|spec| Robot::new(spec).expect("a robot")).collect()
    }

    /// Along a curve through the workspace, and from place to place at random, shapes and rates are those from nothing.
    #[test]
    fn what_is_followed_is_what_is_found_from_nothing() {
        for robot in robots() {
            let (mut follower, mut compared) = (Follower::new(&robot), 0);
            for k in 0..200_u32 {
                // The second half leaps, so that extrapolation is useless.
                let time = if k < 100 { f64::from(k) * 0.02 } else { f64::from(k * 37 % 100) * 0.02 };
                let position = Vec2::new(5.0 * (1.3 * time).sin(), 2.0 * (2.1 * time).cos());
                let velocity = Vec2::new(6.5 * (1.3 * time).cos(), -4.2 * (2.1 * time).sin());
                let acceleration = Vec2::new(-8.45 * (1.3 * time).sin(), -8.82 * (2.1 * time).cos());
                let followed = follower.at(time, position, velocity, acceleration);
                let (found, statics) = match (followed, solve(&robot, position)) {
                    (Ok(found), Ok(statics)) => (found, statics),
                    (followed, from_nothing) => {
                        assert_eq!(followed.err(), from_nothing.err().map(|failure| failure.reason), "{position:?}");
                        continue;
                    }
                };
                compared += 1;
                let rates = length_rates_on(&robot, &statics, velocity, acceleration).expect("rates");
                let nodes = node_rates(&robot, &statics, velocity, acceleration).expect("rates");
                for (i, cable) in found.iter().enumerate() {
                    let shape = &statics.cables[i];
                    let close = |a: f64, b: f64, size: f64| {
                        assert!((a - b).abs() < 1e-11 * size, "{time} s, cable {i}: {a} instead of {b}");
                    };
                    close(cable.length[0], shape.length, shape.length);
                    close(cable.length[1], rates[i].first, 10.0);
                    close(cable.length[2], rates[i].second, 100.0);
                    close(cable.pull.norm(), shape.tension_at_platform, shape.tension_at_platform);
                    assert_eq!(cable.nodes.len(), shape.nodes.len());
                    for (k, node) in shape.nodes.iter().enumerate() {
                        close((cable.nodes[k] - node).norm(), 0.0, 10.0);
                        close((cable.velocities[k] - nodes[i][k][0]).norm(), 0.0, 10.0);
                    }
                    for (force, expected) in cable.forces.iter().zip(&shape.forces) {
                        close((force - expected).norm(), 0.0, expected.norm());
                    }
                }
            }
            assert!(compared > 100, "{compared} feasible");
        }
    }

    /// Step by step out of the feasible region: the border is where it is from nothing, and so is the reason.
    #[test]
    fn a_branch_ends_where_it_does_from_nothing() {
        for robot in robots() {
            for direction in [Vec2::x(), Vec2::y(), -Vec2::y(), Vec2::new(0.8, -0.6)] {
                let mut follower = Follower::new(&robot);
                for k in 0..600 {
                    let time = f64::from(k) * 0.02;
                    let position = direction * time;
                    let followed = follower.at(time, position, direction, Vec2::zeros()).err();
                    let from_nothing = solve(&robot, position).err().map(|failure| failure.reason);
                    assert_eq!(followed, from_nothing, "{position:?}");
                }
            }
        }
    }
}
