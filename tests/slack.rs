//! The slack acceleration against statics under the inertia's forces, solved densely here, and against straight cables.

use nalgebra::{DMatrix, DVector, Matrix2};
use tautline::mechanics::{self, Material, SlackAcceleration, Statics};
use tautline::robot::{Robot, RobotSpec, Vec2, paper_spec};

fn statics(robot: &Robot, at: Vec2) -> Statics {
    mechanics::solve(robot, at).map_err(|failure| failure.reason).expect("statics")
}

/// The robot's nodes: the platform, then the inner nodes of each cable.
struct Loaded<'a> {
    robot: &'a Robot,
    rest: Statics,
    /// M r' + (∂`K_dyn/∂s`̈) r, per unit s̈.
    inertia: DVector<f64>,
}

impl<'a> Loaded<'a> {
    /// r' and L' are central differences of statics, h² = 1e-8 of their third derivatives off.
    fn new(robot: &'a Robot, at: Vec2, direction: Vec2) -> Self {
        let h = 1e-4;
        let rest = statics(robot, at);
        let [before, after] = [-h, h].map(|h| statics(robot, at + direction * h));
        let n = robot.elements;
        let mut inertia = DVector::zeros(2 + 2 * (n - 1) * robot.cables.len());
        for j in 0..2 {
            inertia[j] += robot.platform_mass * direction[j];
        }
        for (i, shape) in rest.cables.iter().enumerate() {
            let mu = robot.material_of(i).mass_per_length;
            let l = shape.length / n as f64;
            let rate = (after.cables[i].length - before.cables[i].length) / (2.0 * h) / n as f64;
            let velocity = |k: usize| (after.cables[i].nodes[k] - before.cables[i].nodes[k]) / (2.0 * h);
            for k in 0..n {
                // ∫ N μ (l N·r' + ẇ N'·r) dξ by Simpson's rule, which is exact here; w = −(k + ξ) l̇.
                for (xi, weight) in [(0.0, 1.0 / 6.0), (0.5, 4.0 / 6.0), (1.0, 1.0 / 6.0)] {
                    let w = -(k as f64 + xi) * rate;
                    let span = shape.nodes[k + 1] - shape.nodes[k];
                    let material = (velocity(k) * (1.0 - xi) + velocity(k + 1) * xi) * l + span * w;
                    for (node, shape) in [(k, 1.0 - xi), (k + 1, xi)] {
                        if let Some(row) = row(n, i, node) {
                            for j in 0..2 {
                                inertia[row + j] += weight * mu * shape * material[j];
                            }
                        }
                    }
                }
            }
        }
        Self { robot, rest, inertia }
    }

    fn node(&self, x: &DVector<f64>, i: usize, k: usize) -> Vec2 {
        let rest = self.rest.cables[i].nodes[k];
        row(self.robot.elements, i, k).map_or(rest, |row| rest + Vec2::new(x[row], x[row + 1]))
    }

    /// The force N of an element where the nodes are displaced by x, and its direction.
    fn force(&self, x: &DVector<f64>, i: usize, k: usize) -> (f64, Vec2) {
        let span = self.node(x, i, k + 1) - self.node(x, i, k);
        let l = self.rest.cables[i].length / self.robot.elements as f64;
        (Material::of(self.robot, i).force(span.norm() / l), span.normalize())
    }

    /// What is out of balance at s̈: the elements' forces changed since rest, and the inertia.
    fn residual(&self, x: &DVector<f64>, acceleration: f64) -> DVector<f64> {
        let n = self.robot.elements;
        let mut sum = &self.inertia * acceleration;
        let rest = DVector::zeros(x.len());
        for i in 0..self.robot.cables.len() {
            for k in 0..n {
                let ((now, along), (before, at_rest)) = (self.force(x, i, k), self.force(&rest, i, k));
                let change = along * now - at_rest * before;
                for (node, sign) in [(k, -1.0), (k + 1, 1.0)] {
                    if let Some(row) = row(n, i, node) {
                        for j in 0..2 {
                            sum[row + j] += sign * change[j];
                        }
                    }
                }
            }
        }
        sum
    }

    /// The displacements at s̈, by Newton's iteration with a dense Jacobian of differences.
    fn solve(&self, acceleration: f64) -> DVector<f64> {
        let size = self.inertia.len();
        let mut x = DVector::zeros(size);
        let h = 1e-6;
        let columns: Vec<DVector<f64>> = (0..size)
            .map(|j| {
                let step = DVector::from_fn(size, |i, _| if i == j { h } else { 0.0 });
                (self.residual(&step, 0.0) - self.residual(&-step, 0.0)) / (2.0 * h)
            })
            .collect();
        let jacobian = DMatrix::from_columns(&columns).lu();
        for _ in 0..8 {
            x -= jacobian.solve(&self.residual(&x, acceleration)).expect("a regular Jacobian");
        }
        x
    }
}

fn row(n: usize, cable: usize, node: usize) -> Option<usize> {
    match node {
        0 => Some(0),
        _ if node == n => None,
        _ => Some(2 + 2 * ((n - 1) * cable + node - 1)),
    }
}

/// By the referee: forces as linear in s̈, from small accelerations of both signs.
fn referee(robot: &Robot, at: Vec2, direction: Vec2) -> SlackAcceleration {
    let loaded = Loaded::new(robot, at, direction);
    let small = 1e-2;
    let [less, more] = [-small, small].map(|a| loaded.solve(a));
    let mut limits = [None::<mechanics::SlackLimit>; 2];
    for cable in 0..robot.cables.len() {
        for k in 0..robot.elements {
            let rest = loaded.rest.cables[cable].forces[k].norm();
            let change = (loaded.force(&more, cable, k).0 - loaded.force(&less, cable, k).0) / (2.0 * small);
            let (value, side) = ((rest / change).abs(), usize::from(change > 0.0));
            if limits[side].is_none_or(|limit| value < limit.value * (1.0 - 1e-6)) {
                limits[side] = Some(mechanics::SlackLimit { value, cable });
            }
        }
    }
    let platform = (more.rows(0, 2) - less.rows(0, 2)) / (2.0 * small);
    let [accelerating, braking] = limits;
    SlackAcceleration { accelerating, braking, deviation_per_acceleration: platform.norm() }
}

fn found(robot: &Robot, at: Vec2, direction: Vec2) -> SlackAcceleration {
    mechanics::slack_acceleration(robot, &statics(robot, at), direction).expect("a regular pose")
}

/// Differences of s̈ = ±0.01 m/s² leave (s̈/slack)² ≈ 1e-6 of the change, those of the motion and of the Jacobian less.
#[test]
fn it_is_what_statics_under_the_inertia_give() {
    let own = |mut spec: RobotSpec| {
        spec.elements = 4;
        Robot::new(spec).expect("a robot")
    };
    let paper = own(paper_spec());
    for (at, direction) in [
        (Vec2::new(-6.0, 0.0), Vec2::x()),
        (Vec2::new(2.0, 1.5), Vec2::new(0.6, -0.8)),
        (Vec2::new(0.5, -2.0), Vec2::y()),
        (Vec2::new(6.0, 0.0), -Vec2::x()),
    ] {
        let (ours, theirs) = (found(&paper, at, direction), referee(&paper, at, direction));
        for (ours, theirs) in [(ours.accelerating, theirs.accelerating), (ours.braking, theirs.braking)] {
            // Upwards no cable goes slack: the inertia of sagging cables tightens them.
            assert_eq!(ours.map(|limit| limit.cable), theirs.map(|limit| limit.cable), "{at} {direction}");
            let (Some(ours), Some(theirs)) = (ours, theirs) else { continue };
            assert!((ours.value / theirs.value - 1.0).abs() < 1e-5, "{ours:?} {theirs:?}");
        }
        let part = ours.deviation_per_acceleration / theirs.deviation_per_acceleration;
        assert!((part - 1.0).abs() < 1e-5, "{part}");
    }
}

/// Cables without weight are straight springs N'/L along and N/(λ L) across. The platform alone has inertia then.
#[test]
fn straight_cables_without_weight_have_a_closed_form() {
    let mut spec = paper_spec();
    spec.material.mass_per_length = 1e-9;
    let robot = Robot::new(spec).expect("a robot");
    let (at, direction) = (Vec2::new(3.0, 1.0), Vec2::new(0.8, 0.6));
    let rest = statics(&robot, at);
    let springs: Vec<(Vec2, f64, f64, f64)> = (0..4)
        .map(|i| {
            let shape = &rest.cables[i];
            let span = robot.cables[i].anchor - at;
            let stretch = span.norm() / shape.length;
            let material = Material::of(&robot, i);
            (
                span.normalize(),
                material.force(stretch),
                material.tangent(stretch) / shape.length,
                shape.length * stretch,
            )
        })
        .collect();
    let stiffness: Matrix2<f64> = springs
        .iter()
        .map(|(e, force, along, span)| {
            let axial = e * e.transpose();
            axial * *along + (Matrix2::identity() - axial) * (force / span)
        })
        .sum();
    let delta = stiffness.try_inverse().expect("held") * -direction * robot.platform_mass;
    let slack: Vec<f64> = springs.iter().map(|(e, force, along, _)| force / (along * e.dot(&delta))).collect();
    let least = |sign: f64| {
        let of_sign = slack.iter().enumerate().filter(|(_, value)| sign * **value > 0.0);
        of_sign.map(|(cable, value)| (value.abs(), cable)).min_by(|a, b| a.0.total_cmp(&b.0)).expect("one")
    };
    let ours = found(&robot, at, direction);
    for (limit, sign) in [(ours.accelerating, 1.0), (ours.braking, -1.0)] {
        let (limit, (value, cable)) = (limit.expect("a limit"), least(sign));
        // μ is not 0, but 1e-8 of the platform's mass.
        assert!((limit.value / value - 1.0).abs() < 1e-6 && limit.cable == cable, "{limit:?} {value} {cable}");
    }
    assert!((ours.deviation_per_acceleration / delta.norm() - 1.0).abs() < 1e-6);
}

/// The published robot is its own mirror image, and a reversed motion exchanges speeding up and braking.
#[test]
fn a_reversed_motion_exchanges_the_two() {
    let robot = Robot::new(paper_spec()).expect("a robot");
    let near = |a: Option<mechanics::SlackLimit>, b: Option<mechanics::SlackLimit>| {
        (a.expect("a limit").value / b.expect("a limit").value - 1.0).abs() < 1e-9
    };
    for x in [0.0, 2.5, 6.0] {
        let right = found(&robot, Vec2::new(x, 0.0), Vec2::x());
        let back = found(&robot, Vec2::new(x, 0.0), -Vec2::x());
        let mirrored = found(&robot, Vec2::new(-x, 0.0), -Vec2::x());
        assert!(near(right.accelerating, back.braking) && near(right.braking, back.accelerating), "{right:?} {back:?}");
        assert!(near(right.accelerating, mirrored.accelerating) && near(right.braking, mirrored.braking));
    }
}

/// Flown, a quintic move of the published robot from x = −6 m to 6 m goes slack from a peak speed of 7 m/s, 6.7 m/s², as an
/// independent program has found. Statics are optimistic: they allow more, and at most twice that acceleration.
#[test]
fn flown_slack_comes_earlier() {
    let robot = Robot::new(paper_spec()).expect("a robot");
    let (distance, peak): (f64, f64) = (12.0, 7.0);
    let duration = 15.0 * distance / (8.0 * peak);
    // The share of the allowed acceleration that is used at most.
    let used = (0..=200).map(|i| {
        let tau = f64::from(i) / 200.0;
        let s = distance * tau.powi(3) * (10.0 - 15.0 * tau + 6.0 * tau * tau);
        let a = distance / (duration * duration) * 60.0 * tau * (1.0 - 3.0 * tau + 2.0 * tau * tau);
        let slack = found(&robot, Vec2::new(s - 6.0, 0.0), Vec2::x());
        let limit = if a >= 0.0 { slack.accelerating } else { slack.braking };
        a.abs() / limit.expect("a limit").value
    });
    let used = used.fold(0.0, f64::max);
    assert!((0.5..1.0).contains(&used), "{used}");
}
