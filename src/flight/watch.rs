//! What is watched between the ends of the steps: how far the platform is from its path, and whether an element pushes.

use super::equations::{Equations, Nodes, State, add, platform, plus};
use crate::flight::Slack;
use crate::robot::{Side, Trajectory, Vec2};

/// The platform is looked at no more coarsely than this, in s.
const GRID: f64 = 1e-3;
/// The elements' forces are, in s.
const FORCE_GRID: f64 = 5e-3;
/// How often the time is halved in which an element begins to push.
const HALVINGS: usize = 30;

/// The motion during a step, as the cubics that have the values and the rates of both ends.
pub(super) struct Between<'a> {
    /// In s.
    pub times: [f64; 2],
    /// The states there.
    pub states: [&'a State; 2],
    /// L in m and L̇ in m/s of every cable there.
    pub lengths: [&'a [[f64; 2]]; 2],
}

/// The cubic at x of 0 to 1 is these parts of its values at both ends, and of its slopes in x there.
fn cubic(x: f64) -> [f64; 4] {
    let y = 1.0 - x;
    [y * y * (1.0 + 2.0 * x), x * x * (1.0 + 2.0 * y), x * y * y, -x * x * y]
}

impl Between<'_> {
    fn step(&self) -> f64 {
        self.times[1] - self.times[0]
    }

    /// All positions at the part x of the step.
    fn positions(&self, x: f64) -> Nodes {
        let ([w0, w1, d0, d1], h) = (cubic(x), self.step());
        let [from, to] = self.states;
        let mut sum = plus(&from.positions, w0 - 1.0, &from.positions);
        add(&mut sum, w1, &to.positions);
        add(&mut sum, h * d0, &from.velocities);
        add(&mut sum, h * d1, &to.velocities);
        sum
    }

    fn platform(&self, x: f64) -> Vec2 {
        let ([w0, w1, d0, d1], h) = (cubic(x), self.step());
        let [from, to] = self.states;
        let rates = platform(&from.velocities) * d0 + platform(&to.velocities) * d1;
        platform(&from.positions) * w0 + platform(&to.positions) * w1 + rates * h
    }

    /// L of cable `i` at the part x of the step.
    fn length(&self, i: usize, x: f64) -> f64 {
        let ([w0, w1, d0, d1], h) = (cubic(x), self.step());
        let [[from, from_rate], [to, to_rate]] = self.lengths.map(|lengths| lengths[i]);
        w0 * from + w1 * to + h * (d0 * from_rate + d1 * to_rate)
    }

    /// The least force of all elements at the part x of the step, and its cable.
    fn least_force(&self, equations: &Equations, x: f64) -> (f64, usize) {
        let positions = self.positions(x);
        let mut least = (f64::INFINITY, 0);
        for i in 0..equations.cables.len() {
            let l = self.length(i, x) / equations.elements as f64;
            for span in equations.spans(i, &positions) {
                let force = equations.force(i, span, l);
                if force < least.0 {
                    least = (force, i);
                }
            }
        }
        least
    }
}

/// How many equal parts of `h`, a step in s, are no longer than `grid`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, and a step is short")]
fn parts(h: f64, grid: f64) -> u32 {
    (h / grid).ceil().max(1.0) as u32
}

/// What has been seen so far.
#[derive(Debug, Default)]
pub(super) struct Watch {
    /// How long the move takes, in s.
    duration: f64,
    /// The largest distance of the platform from its path, in m.
    pub max_deviation: f64,
    /// The same since the end of the move.
    pub residual: f64,
    /// Where an element has begun to push.
    pub slack: Option<Slack>,
}

impl Watch {
    /// For a move of this `duration` in s.
    pub fn new(duration: f64) -> Self {
        Self { duration, ..Self::default() }
    }

    /// Looks at a step, the beginning left out unless the move has ended there.
    pub fn step(&mut self, equations: &Equations, trajectory: &Trajectory, between: &Between) {
        let h = between.step();
        let after_the_move = between.times[0] >= self.duration * (1.0 - 1e-9);
        let parts = self::parts(h, GRID);
        for k in u32::from(!after_the_move)..=parts {
            let x = f64::from(k) / f64::from(parts);
            let path = trajectory.at(between.times[0] + x * h, Side::Left).point.position;
            let deviation = (between.platform(x) - path).norm();
            self.max_deviation = self.max_deviation.max(deviation);
            if after_the_move {
                self.residual = self.residual.max(deviation);
            }
        }
        let parts = self::parts(h, FORCE_GRID);
        for k in 1..=parts {
            let x = f64::from(k) / f64::from(parts);
            let (force, cable) = between.least_force(equations, x);
            if let Some(slack) = &mut self.slack {
                slack.force = slack.force.min(force);
            } else if force < 0.0 {
                let (mut taut, mut pushing) = (f64::from(k - 1) / f64::from(parts), (x, cable));
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (taut + pushing.0);
                    match between.least_force(equations, middle) {
                        (least, cable) if least < 0.0 => pushing = (middle, cable),
                        _ => taut = middle,
                    }
                }
                let (x, cable) = pushing;
                self.slack = Some(Slack { time: between.times[0] + x * h, cable, force });
            }
        }
    }
}
